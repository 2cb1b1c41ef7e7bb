"""Sentences on positions where a linkage does not close: the gaps of its joints, as lengths or angles."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.arrays import Array, Ints, first_largest
from dalembert.core.layout import Perpendicular, Pose
from dalembert.core.position.assur_plan import plan
from dalembert.core.position.first_pose_plane import Guess, without_phase
from dalembert.core.position.newton import displace, least_gap
from dalembert.units import file_units

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled
    from dalembert.core.position.motion_path import Path


SHUT = 1e-6
"""A joint that is open by less than this, radians or characteristic lengths, is not spoken of."""

ALIKE = 0.98
"""Joints that are open by at least this much of the widest are open alike."""

ASIDE = 0.05
"""Radians by which links are turned before the least gap is looked for."""


OPEN = "{verdict} {span}{gap}. Change {datum} or the assembly{drives}."
"""Sentence of positions that do not close; ``span`` says where, ``gap`` what stays open and how far, if known."""
UNFOLLOWED = (
    "The linkage closes {span}, but the motion could not be followed: it meets a dead centre, or two "
    "branches are too close to be distinguished. Solve these positions separately, with an assembly, or "
    "change a length."
)
ONE = "the {what} of joint {joint} remain {figure} {how}"
SEVERAL = "the {what} of its joints remain {total} {how} in total, {where}"
ALL_ALIKE, MOST = "equally at {joints}", "mostly at {joint} ({figure})"
WORDS = {"length": {"what": "points", "how": "apart"}, "angle": {"what": "axes", "how": "out of line"}}
"""Words for a joint's gap, by its kind."""


def open_sentence(c: Compiled, path: Path | None, where: Ints) -> str:
    """Why a run of positions does not close: what stays open in the middle of it at least, where, and how far."""
    middle = int(where[len(where) // 2])
    shift, turn = _openings(c, path, middle)
    lengths = _most(c, shift, "length", c.layout.length)
    parts = [part for part in (lengths, _most(c, turn, "angle", 1.0)) if part]
    if path is not None and not parts:
        return UNFOLLOWED.format(span=_span(c, where))
    place = f"at {_values(c, middle)} " if len(where) > 1 and c.schedule.names else ""
    gap = f": {place}{' and '.join(parts)}" if parts else ""
    datum = "a length" if lengths or not parts else "a direction"
    return open_template(c).format(span=_span(c, where), gap=gap, datum=datum)


def open_template(c: Compiled) -> str:
    """The sentence with what depends on the positions left open."""
    drives = f", or give {' and '.join(c.schedule.names)} another range" if c.schedule.names else ""
    verdict = (
        "The linkage does not close"
        if _every_branch_is_known(c)
        else "No pose of the linkage could be computed"
    )
    return OPEN.format(verdict=verdict, drives=drives, span="{span}", gap="{gap}", datum="{datum}")


def _every_branch_is_known(c: Compiled) -> bool:
    """True if closed forms decide where the linkage closes; else poses are sought from starts, which may miss some."""
    if not isinstance(c.guess, Guess):
        return False
    groups = plan(without_phase(c.layout, c.targets[0], c.guess, hold=True)[0])
    return groups is not None and groups.closed


def _openings(c: Compiled, path: Path | None, position: int) -> tuple[Array, Array]:
    """Least squares of what is missing at a position: of each joint its points apart (m), its axes turned (rad)."""
    reached = np.flatnonzero(path.reached) if path is not None else np.zeros(0, np.intp)
    if path is None or not reached.size:
        start = c.guess.start(c.layout, c.targets[position])
    else:
        start = path.pose.at(reached[np.argmin(np.abs(reached - position))])
    rows = c.layout.constraints
    missing = least_gap(c.layout, _aside(c, start), c.targets[position])[: rows.count]
    angle = np.where(rows.angular, missing / c.layout.length, 0.0)
    for family in rows.families:
        if isinstance(family, Perpendicular):  # its measure is the sine of what is missing to the right angle
            angle[family.row] = np.arcsin(np.clip(angle[family.row], -1, 1))
    square = np.zeros((2, len(c.joints)))
    held = rows.joint >= 0
    np.add.at(square[0], rows.joint[held], np.where(rows.angular, 0.0, missing**2)[held])
    np.add.at(square[1], rows.joint[held], angle[held] ** 2)
    shift, turn = np.sqrt(square)
    return shift, turn


def _aside(c: Compiled, pose: Pose) -> Pose:
    """A pose with its links turned a little, each by a different angle: links in one line would stay in it."""
    g = c.layout.algebra
    dq = np.zeros((1, c.layout.links, g.n))
    dq[..., g.d :] = ASIDE * np.cos(np.arange(dq[..., g.d :].size)).reshape(dq[..., g.d :].shape)
    return displace(c.layout, pose.at(None), dq).at(0)


def _most(c: Compiled, open_: Array, kind: str, size: float) -> str:
    """'the points of joint B remain 12 mm apart', or of several the sum and the widest; nothing where all are shut."""
    wide = np.flatnonzero(open_ > SHUT * size)
    if not wide.size:
        return ""
    most = first_largest(open_)
    figure = quantity_text(c, kind, float(open_[most]), 3)
    if wide.size == 1:
        return ONE.format(joint=c.joints[most], figure=figure, **WORDS[kind])
    total = quantity_text(c, kind, float(open_.sum()), 3)
    alike = open_[wide].min() > ALIKE * open_[most]
    names = ", ".join(c.joints[k] for k in wide)
    where = ALL_ALIKE.format(joints=names) if alike else MOST.format(joint=c.joints[most], figure=figure)
    return SEVERAL.format(total=total, where=where, **WORDS[kind])


AS_DESCRIBED = "as it is described"
"""Place in the sentence of a mechanism without drives that does not close."""


def _span(c: Compiled, where: Ints) -> str:
    """'between 212 deg and 238 deg of O2'."""
    if not c.schedule.names:
        return AS_DESCRIBED
    if len(where) == 1:
        return f"at {_values(c, int(where[0]))}"
    ends = [[drive_text(c, int(where[e]), k) for e in (0, -1)] for k in range(len(c.schedule.names))]
    return "between " + ", ".join(
        f"{a} and {b} of {n}" for n, (a, b) in zip(c.schedule.names, ends, strict=True)
    )


def _values(c: Compiled, position: int) -> str:
    """'O2 = 60 deg and guide = 20 mm'."""
    return " and ".join(f"{n} = {drive_text(c, position, k)}" for k, n in enumerate(c.schedule.names))


def drive_text(c: Compiled, position: int, drive: int) -> str:
    """A drive's position as a person writes it."""
    turns = c.layout.freedoms.angular[c.layout.driven[drive]]
    return quantity_text(c, "angle" if turns else "length", float(c.schedule.position[position, drive]))


def quantity_text(c: Compiled, kind: str, value: float, figures: int = 6) -> str:
    """A number of SI with its unit, in the units of the mechanism's file (without: SI and degrees).

    >>> from dalembert.analysis.compile.compiled_mechanism import compile_mechanism
    >>> from dalembert.model.library import four_bar
    >>> m = four_bar()
    >>> quantity_text(compile_mechanism(m, m.schedule()), "angle", 1.0471975511965976)
    '60 deg'
    """
    units = file_units(c.mechanism.units)
    return f"{units.unit(kind).of_si(value):.{figures}g} {units.text(kind)}"
