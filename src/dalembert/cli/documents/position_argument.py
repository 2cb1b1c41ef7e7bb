"""The option --at: the analysis with the position that it names, or that position alone."""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.analysis import Result
    from dalembert.arrays import Tree
    from dalembert.model import Mechanism

OK, SOME_NOT_OK = 0, 1
"""Exit statuses."""

TURNS = 100
"""Turns through which a drive is followed from the file's position to another one."""


def solve_at(m: Mechanism, at: str | None, static: bool, positions: int | None) -> tuple[Result, str | None]:
    """The result and the position asked for; a drive's value that the file has not is gone to from its first one, and
    an extreme of a file with one position is sought over a full turn."""
    from dalembert.analysis import solve
    from dalembert.analysis.result.position_lookup import EXTREMES
    from dalembert.machine.whole_cycle import over_a_turn

    if at is not None and at.split()[:1] and at.split()[0].partition("(")[0] in EXTREMES:
        return solve(m, static=static, positions=over_a_turn(m, positions)), at

    if at is None or at.strip().isdigit() or positions is not None or len(m.drives) != 1:
        return solve(m, static=static, positions=positions), at
    values = _path_to(m, at)
    if values is None:
        return solve(m, static=static), at
    return solve(_at_last_position(m, values), static=static), None


def position_alone(r: Result, at: str | None) -> tuple[Result, str]:
    """The answer at one position alone, in the pose it has among the others, and the sentence that names it, empty
    without others."""
    import numpy as np

    from dalembert.analysis.one_pass import at_poses
    from dalembert.analysis.result.position_lookup import position_at, position_sentence

    k = position_at(r, at)
    if len(r.status) == 1:
        return r, ""
    return at_poses(r.compiled, r, np.array([k]), r.inertia), position_sentence(r, k, at)


def announce(result: Result, output: Path, at: str | None) -> int:
    """Say what was written, the position if sought, and those that are not ok with their reasons; the exit status."""
    from dalembert.analysis.output.summary.printed_answer import problems_text
    from dalembert.analysis.output.summary.printed_units import print_scale
    from dalembert.analysis.result.position_lookup import extreme, position_at, position_sentence

    print(f"Written: {output}", file=sys.stderr)
    if at is not None and extreme(result, at) is not None:
        print(position_sentence(result, position_at(result, at), at), file=sys.stderr)
    if result.ok.all():
        return OK
    print(problems_text(result, print_scale(result, "file")), file=sys.stderr)
    return SOME_NOT_OK


def _at_last_position(m: Mechanism, values: list[float]) -> Mechanism:
    """The mechanism at the last of some positions of its drive, in the assembly mode that leads to it."""
    from dalembert.analysis import kinematics

    path = f"drives.{next(iter(m.drives))}.position"
    r = kinematics(m.with_values({path: values}))
    changes: Tree = {path: values[-1]}
    if all(map(math.isfinite, r.point_array[-1].ravel())):
        changes["assembly"] = {link: _pose(r, link) for link in r.links}
    return m.with_values(changes)


def _pose(r: Result, link: str) -> object:
    """Pose of a link at the last position, in the form of an assembly."""
    if r.mechanism.dimension == 2:
        return float(r.angle(link)[-1])
    from dalembert.algebra import space

    x, y, z, w = (float(q) for q in space.quaternion(r.rotation(link)[-1].ravel()))
    size = math.hypot(x, y, z)
    position = [float(p) for p in r.position(link)[-1]]
    return {"position": position, "axis": [x, y, z] if size else [0, 0, 1], "angle": 2 * math.atan2(size, w)}


def _path_to(m: Mechanism, at: str) -> list[float] | None:
    """Positions in small steps from the file's only one to a value of its drive; None where the file has more."""
    import numpy as np

    from dalembert.units import file_units, quantity

    schedule = m.schedule()
    if schedule.position.shape != (1, 1) or schedule.unknown is not None:
        return None
    drive = m.drives[schedule.names[0]]
    slides = (
        not drive.turns
        if drive.freedom
        else m.joints[drive.joint or schedule.names[0]].freedoms[0] == "slide"
    )
    start = float(schedule.position[0, 0])
    end = quantity(at, "length" if slides else "angle", file_units(m.units))
    if abs(end - start) < 1e-9:
        return None
    if not slides and abs(end - start) > 2 * np.pi * TURNS:
        what = (
            f"position {at} is more than {TURNS} turns from that of drive {schedule.names[0]!r} in the file"
        )
        raise ModelError(what, "give one within a turn of it")
    count = 40 if slides else max(2, int(np.ceil(abs(end - start) / 0.05)) + 1)
    return [float(v) for v in np.linspace(start, end, count)]
