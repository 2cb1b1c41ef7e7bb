"""Every position of an analysis from its structure's kept program; none where the careful path has to look."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.analysis.compile.pose_loads import with_pose_loads
from dalembert.analysis.compile.torsion_turns import wound
from dalembert.analysis.degree_of_freedom import Mobility
from dalembert.analysis.engine.kept_program import KeptProgram
from dalembert.analysis.engine.structures import Ready, ready
from dalembert.analysis.engine.walk import STEP, count_turns, is_steady, walk_through, with_between
from dalembert.analysis.positions import Positions
from dalembert.analysis.result.result import Result
from dalembert.analysis.status.statuses import UNBALANCED
from dalembert.arrays import Array
from dalembert.core.layout import Pose
from dalembert.core.position.motion_path import Path

BLOCK = 1024
"""Positions computed at once: their values stay in the cache."""


def quick_answer(c: Compiled, inertia: bool, forces: bool) -> Result | Positions | None:
    """The answer of a mechanism of the plane, every position ok; its motion where no forces are asked for, or where its
    program gives none; None where some position may not be ok."""
    found = ready(c, inertia)
    if found is None:
        return None
    whole = found.program.whole and c.contacts is None and c.layout.compliance is None and not c.pose_names
    outputs = _follow(found, c, pose_only=not (forces and whole))
    if outputs is None:
        return None
    return _result(found, c, outputs, inertia) if forces and whole else _positions(found, c, outputs)


def _positions(found: Ready, c: Compiled, outputs: _Outputs) -> Positions:
    k, count = found.program, c.schedule.count
    out = outputs.out[:, :count]
    turned = c.layout.algebra.with_ground(k.part("turn", out), k.part("rotation", out).swapaxes(1, 2))
    pose = Pose(np.pad(k.part("point", out), ((0, 0), (0, 1), (0, 0))), *turned)
    path = Path(pose, np.ones(count, bool), np.zeros(count, np.intp))
    c = with_pose_loads(wound(c, (0, pose.at(0)), path), path)
    return Positions(c, path, _mobility(c), found.first.mode)


class _Outputs(NamedTuple):
    """What an answer keeps (N, P), residual and power balance (P,), of all places."""

    out: Array
    residual: Array
    power: Array


def _follow(r: Ready, c: Compiled, pose_only: bool) -> _Outputs | None:
    """The positions of a list, and in between as close as it takes to be sure that the motion is one."""
    k = r.program
    for step in (STEP, STEP / 8, STEP / 64):
        way = walk_through(c, step)
        if way is None:
            return None
        found = _evaluate(r, c, with_between(k, r.columns, way), pose_only)
        if found is None:
            return None
        if count_turns(k, found.out, way, r.first.turn) and is_steady(k, found.out, way):
            return found
    return None


def _evaluate(r: Ready, c: Compiled, columns: Array, pose_only: bool) -> _Outputs | None:
    """All outputs, and the checks of them; None where one fails."""
    k, count = r.program, columns.shape[1] if len(columns) else c.schedule.count
    run, size, kept = (k.run_pose, k.pose, k.pose) if pose_only else (k.run, k.size, k.kept)
    residual, power = np.zeros(count), np.zeros(count)
    work = np.empty((size, min(count, BLOCK)))
    out = work[:kept] if count <= BLOCK else np.empty((kept, count))
    with np.errstate(all="ignore"):
        for start in range(0, count, BLOCK):
            part = slice(start, start + BLOCK)
            here = work[:, : min(BLOCK, count - start)]
            try:
                run([*r.single, *_at(columns, part), *r.first.ways], here)
            except (ArithmeticError, ValueError):
                return None
            if not (np.isfinite(here.sum()) and (here[k.rows["closure"]] >= 0).all()):
                return None
            if not pose_only:
                residual[part], power[part] = _checks(k, c, here)
                if not (_sure(k, here) and (residual[part] <= UNBALANCED).all()):
                    return None
            if count > BLOCK:
                out[:, part] = here[:kept]
    return _Outputs(out, residual, power)


def _at(columns: Array, part: slice) -> list[Any]:
    """Columns at some positions; of one position single numbers, which are quicker to compute with."""
    return list(columns[:, part]) if columns.shape[1] > 1 else columns[:, 0].tolist()


def _sure(k: KeptProgram, out: Array) -> bool:
    """Whether the squares of rates are numbers, and nothing says that a position is in doubt."""
    rates = out[k.rows["twist"]]
    return bool(np.isfinite((rates * rates).sum()) and (out[k.rows["margin"]] >= 0).all())


def _checks(k: KeptProgram, c: Compiled, out: Array) -> tuple[Array, Array]:
    """Residual over the largest force, and virtual power over force times velocity, at each place."""
    per_length = c.layout.wrench_scale[:, None]
    forces = np.abs(out[k.rows["force"].start : k.rows["loads"].stop])
    forces[k.moments] /= c.layout.length
    largest = forces.max(axis=0, initial=0.0)
    left = np.abs(out[k.rows["unbalanced"]]).reshape(*k.nodes["unbalanced"].shape, out.shape[1]) * per_length
    residual = left.max(axis=(0, 1), initial=0.0) / np.where(largest > 0, largest, 1.0)
    speeds = np.abs(out[k.rows["virtual"]]).reshape(*k.nodes["virtual"].shape, out.shape[1]) / per_length
    reference = largest * speeds.max(axis=(1, 2), initial=0.0)
    balance = np.abs(out[k.rows["power"]]) / np.where(reference > 0, reference, 1.0)
    return residual, balance.max(axis=0, initial=0.0)


def _mobility(c: Compiled) -> Mobility:
    """As many freedoms as drives: J is square and regular."""
    freedoms = c.layout.unknowns - c.layout.constraints.count
    return Mobility(freedoms, len(c.schedule.names), 0, (), c.passive)


def _result(r: Ready, c: Compiled, found: _Outputs, inertia: bool) -> Result:
    k = r.program
    count = c.schedule.count
    out = found.out[:, :count]
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
        residual=found.residual[:count],
        power_balance=found.power[:count],
        **arrays,
    )
