"""Every position of an analysis from its structure's kept program; none where the careful path has to look."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.analysis.compile.pose_loads import with_pose_loads
from dalembert.analysis.compile.torsion_turns import wound
from dalembert.analysis.degree_of_freedom import Mobility
from dalembert.analysis.engine.structures import BLOCK, Ready, ready
from dalembert.analysis.engine.walk import STEP, count_turns, is_steady, walk_through, with_between
from dalembert.analysis.positions import Positions
from dalembert.analysis.result.result import Result
from dalembert.analysis.status.cylinder_strokes import out_of_stroke
from dalembert.analysis.status.freewheeling import grip_margins, released_joints
from dalembert.analysis.status.statuses import UNBALANCED
from dalembert.arrays import Array
from dalembert.core.layout import Pose
from dalembert.core.position.motion_path import Path


def quick_answer(c: Compiled, inertia: bool, forces: bool) -> Result | Positions | None:
    """Answer of a planar mechanism with every position ok; its motion where no forces are requested, or where its
    program gives none; None where some position may not be ok."""
    slip = any(margin < 0 for margin in grip_margins(c.mechanism))
    jumps = c.schedule.after is not None and (inertia or not forces)
    special = slip or jumps or out_of_stroke(c).any() or released_joints(c.mechanism)
    program = None if special else ready(c, inertia)
    if program is None:
        return None
    known = not (c.pose_names or c.beyond or set(c.unknown_loads) & set(c.joints))
    complete = program.program.complete and c.contacts is None and c.layout.compliance is None and known
    outputs = _follow(program, c, pose_only=not (forces and complete))
    if outputs is None:
        return None
    return _result(program, c, outputs, inertia) if forces and complete else _positions(program, c, outputs)


def _positions(program: Ready, c: Compiled, outputs: _Outputs) -> Positions:
    k, count = program.program, c.schedule.count
    out = outputs.out[:, :count]
    turned = c.layout.algebra.with_ground(k.part("turn", out), k.part("rotation", out).swapaxes(1, 2))
    pose = Pose(np.pad(k.part("point", out), ((0, 0), (0, 1), (0, 0))), *turned)
    path = Path(pose, np.ones(count, bool), np.zeros(count, np.intp))
    c = with_pose_loads(wound(c, (0, pose.at(0)), path), path)
    return Positions(c, path, _mobility(c), program.first.mode)


class _Outputs(NamedTuple):
    """Outputs (N, P) that an answer keeps, residual and power balance (P,), of all places."""

    out: Array
    residual: Array
    power: Array


def _follow(r: Ready, c: Compiled, pose_only: bool) -> _Outputs | None:
    """The positions of a list, and in between as close as it takes to be sure that the motion is one."""
    k = r.program
    for step in (STEP, STEP / 8, STEP / 64):
        walk = walk_through(c, step)
        if walk is None:
            return None
        outputs = _evaluate(r, c, with_between(k, r.columns, walk), pose_only)
        if outputs is None:
            return None
        if count_turns(k, outputs.out, walk, r.first.turn) and is_steady(k, outputs.out, walk):
            return outputs
    return None


def _evaluate(r: Ready, c: Compiled, columns: Array, pose_only: bool) -> _Outputs | None:
    """All outputs, and their checks; None where one fails. Overflow does not warn (``at_schedule``)."""
    k, count = r.program, columns.shape[1] if len(columns) else c.schedule.count
    run, size, kept = (k.run_pose, k.pose, k.pose) if pose_only else (k.run, k.size, k.kept)
    residual, power = np.zeros(count), np.zeros(count)
    work = np.empty((size, min(count, BLOCK)))
    out = work[:kept] if count <= BLOCK else np.empty((kept, count))
    for start in range(0, count, BLOCK):
        part = slice(start, start + BLOCK)
        here = work[:, : min(BLOCK, count - start)]
        try:
            run([*r.single, *_at(columns, part), *r.first.branches], here, one=count == 1)
        except (ArithmeticError, ValueError):
            return None
        if not (np.isfinite(here.sum()) and (here[k.rows["closure"]] >= 0).all()):
            return None
        if not pose_only:
            residual[part], power[part] = k.balance(c.layout, here)
            if not (k.sure(here) & (residual[part] <= UNBALANCED)).all():
                return None
        if count > BLOCK:
            out[:, part] = here[:kept]
    return _Outputs(out, residual, power)


def _at(columns: Array, part: slice) -> list[Array] | list[float]:
    """Columns at some positions; of one position single numbers, which are quicker to compute with."""
    return list(columns[:, part]) if columns.shape[1] > 1 else columns[:, 0].tolist()


def _mobility(c: Compiled) -> Mobility:
    """As many freedoms as drives: J is square and regular."""
    freedoms = c.layout.unknowns - c.layout.constraints.count
    return Mobility(freedoms, len(c.schedule.names), 0, (), c.passive)


def _result(r: Ready, c: Compiled, outputs: _Outputs, inertia: bool) -> Result:
    k = r.program
    count = c.schedule.count
    out = outputs.out[:, :count]
    names = ("point", "turn", "twist", "acceleration", "force", "moment", "effort", "load")
    arrays: dict[str, Any] = {f"{name}_array": k.part(name, out) for name in names}
    return Result(
        compiled=c,
        inertia=inertia,
        mobility=_mobility(c),
        mode=r.first.mode,
        status=("ok",) * count,
        reasons=(None,) * count,
        rotation_array=k.part("rotation", out).swapaxes(1, 2),
        residual=outputs.residual[:count],
        power_balance=outputs.power[:count],
        **arrays,
    )
