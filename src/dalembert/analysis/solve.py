"""From a description to every joint force: kinematics, statics, dynamics over a schedule."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dalembert.analysis.compile import Compiled, compiled
from dalembert.analysis.mobility import check_knowns
from dalembert.analysis.positions import Positions, drive_text, open_sentence, positions
from dalembert.analysis.result import Result
from dalembert.core.equilibrium import balance, known_sources, motion, reactions, unique
from dalembert.core.follow import BLOCK
from dalembert.core.forcing import summed
from dalembert.core.layout import Pose
from dalembert.core.rank import singular_below
from dalembert.errors import AnalysisError, ModelError
from dalembert.model import Mechanism, Schedule

Array = NDArray[Any]

UNBALANCED = 1e-6
"""Residual above which a position has no equilibrium."""


def kinematics(m: Mechanism, positions: int | None = None, strict: bool = False) -> Result:
    """Positions, velocities and accelerations; no forces (efforts and reactions are NaN)."""
    return _analysed(m, positions, strict, inertia=True, forces=False)


def statics(m: Mechanism, positions: int | None = None, strict: bool = False) -> Result:
    """Joint forces and efforts without inertia; springs, weights and, at the drives' speeds, dampers act."""
    return _analysed(m, positions, strict, inertia=False, forces=True)


def dynamics(m: Mechanism, positions: int | None = None, strict: bool = False) -> Result:
    """Joint forces and efforts that keep the prescribed motion, by D'Alembert: A x + w - inertia = 0."""
    return _analysed(m, positions, strict, inertia=True, forces=True)


def solve(m: Mechanism, static: bool = False, positions: int | None = None, strict: bool = False) -> Result:
    """What the command ``dalembert solve`` does: with inertia when the file has speeds, unless ``static``."""
    if static or not m.has_speeds:
        return statics(m, positions, strict)
    return dynamics(m, positions, strict)


def _analysed(m: Mechanism, count: int | None, strict: bool, inertia: bool, forces: bool) -> Result:
    try:
        schedule = m.schedule(count)
        if schedule.unknown is not None:
            from dalembert.analysis.equilibria import equilibria

            result = equilibria(m, schedule, inertia)
        else:
            result = at_schedule(m, schedule, inertia, forces)
    except ModelError as error:
        raise error.located(m.source) from None
    if strict and not result.ok.all():
        raise AnalysisError("; ".join(f"position {which}: {text}" for which, _, text in result.problems()))
    return result


def at_schedule(m: Mechanism, schedule: Schedule, inertia: bool, forces: bool = True) -> Result:
    """Analysis at the positions of a schedule."""
    c = compiled(m, schedule)
    if forces:
        check_knowns(c)
    followed = positions(c)
    if followed.path is None:
        return _nothing(followed, inertia)
    parts = [
        _block(followed.compiled, followed.path.pose, slice(k, k + BLOCK), inertia, forces)
        for k in range(0, len(c.targets), BLOCK)
    ]
    return _result(
        followed, _Arrays(*(_concatenated(column) for column in zip(*parts, strict=True))), inertia, forces
    )


class _Arrays(NamedTuple):
    """Arrays of a block of positions, ground left out."""

    point: Array
    turn: Array
    twist: Array
    acceleration: Array
    force: Array
    moment: Array
    effort: Array
    load: Array
    residual: Array
    power_balance: Array
    rcond: Array
    force_rcond: Array
    unique: Array | None
    unique_unknowns: Array | None


def _concatenated(parts: tuple[Any, ...]) -> Any:
    return None if parts[0] is None else parts[0] if len(parts) == 1 else np.concatenate(parts)


def _block(c: Compiled, whole: Pose, part: slice, inertia: bool, forces: bool) -> _Arrays:
    """Motion and forces of some positions."""
    layout, pose, schedule = c.layout, whole.at(part), c.schedule
    with np.errstate(all="ignore"):
        moving, rows, solver = motion(layout, pose, schedule.speed[part], schedule.acceleration[part])
        count = len(pose.turn)
        if not forces:
            nan = np.full((count, layout.joints, 2), np.nan)
            empty = np.full((count, len(layout.driven)), np.nan)
            zero, load = np.zeros(count), np.full((count, len(c.unknown_loads)), np.nan)
            found: tuple[Any, ...] = (
                nan,
                nan[..., 0],
                empty,
                load,
                zero,
                zero,
                moving.rcond,
                moving.rcond,
                None,
                None,
            )
        else:
            found = _forces(c, pose, part, moving, rows, solver, inertia)
    moved = (pose.point, pose.turn, moving.twist, moving.acceleration)
    return _Arrays(*(a[:, :-1] for a in moved), *found)


def _forces(
    c: Compiled, pose: Pose, part: slice, moving: Any, rows: Any, solver: Any, inertia: bool
) -> tuple[Any, ...]:
    layout = c.layout
    forcing, known = _sliced(c, part)
    sources = known_sources(layout, forcing, pose, moving, inertia)
    w = summed(layout, *sources.values())
    w = np.broadcast_to(w, (len(pose.turn), *w.shape[1:]))
    found = balance(layout, forcing, known, pose, moving, rows, solver, w)
    force, couple = reactions(layout, rows, found)
    marks: tuple[Any, Any] = (None, None)
    if found.free is not None:
        marks = unique(layout, rows, found.free, layout.joints)
    checks = (found.residual, found.power_balance, moving.rcond, found.rcond)
    return (force, couple[..., 0], found.effort, found.load, *checks, *marks)


def _sliced(c: Compiled, part: slice) -> tuple[Any, Any]:
    """Loads and given efforts of some positions."""
    from dataclasses import replace

    f, k = c.forcing, c.known
    forces = replace(f.forces, value=f.forces.value[part])
    couples = replace(f.couples, value=f.couples.value[part])
    return replace(f, forces=forces, couples=couples), replace(k, effort=k.effort[part])


def _result(followed: Positions, a: _Arrays, inertia: bool, forces: bool) -> Result:
    c = followed.compiled
    assert followed.path is not None
    status, reasons = _statuses(followed, a, forces)
    lost = np.array([s not in ("ok", "redundant") for s in status])
    open_ = ~followed.path.reached
    _blank(open_, a.point, a.turn)
    _blank(lost, a.twist, a.acceleration, a.force, a.moment, a.effort, a.load, a.residual, a.power_balance)
    if not forces:
        a = a._replace(residual=np.full(len(lost), np.nan), power_balance=np.full(len(lost), np.nan))
    fields = a[:10]
    return Result(c, inertia, followed.mobility, followed.mode, status, reasons, *fields, *a[12:])


def _blank(where: NDArray[np.bool_], *arrays: Array) -> None:
    for array in arrays:
        array[where] = np.nan


def _statuses(
    followed: Positions, a: _Arrays, forces: bool
) -> tuple[tuple[str, ...], tuple[str | None, ...]]:
    """Status and sentence of each position: the first that applies."""
    c, path = followed.compiled, followed.path
    assert path is not None
    limit = singular_below(c.layout)
    unbalanced = (a.force_rcond < limit) | ~(a.residual <= UNBALANCED)
    partial = a.unique is not None and not a.unique.all()
    checks: list[tuple[str, Any, Callable[[Any], str]]] = [
        ("not_assembled", ~path.reached, lambda k: open_sentence(c, path, k)),
        ("singular", ~(a.rcond >= limit), lambda k: _singular_sentence(c, k)),
        ("no_balance", unbalanced, lambda k: _no_balance_sentence(c)),
        ("redundant", np.full(len(a.rcond), partial), lambda k: _redundant_sentence(followed)),
    ]
    status = np.full(len(a.rcond), "ok", dtype=object)
    reasons = np.full(len(a.rcond), None, dtype=object)
    for code, mask, sentence in checks if forces else checks[:2]:
        where = np.flatnonzero(mask & (status == "ok"))
        status[where] = code
        for run in np.split(where, np.flatnonzero(np.diff(where) > 1) + 1):
            if run.size:
                reasons[run] = sentence(run)
    return tuple(status), tuple(reasons)


def _singular_sentence(c: Compiled, where: NDArray[np.intp]) -> str:
    at = [f"{n} = {drive_text(c, int(where[0]), k)}" for k, n in enumerate(c.schedule.names)]
    here = f" at {' and '.join(at)}" if at else ""
    return f"Dead centre or change point{here}: drive another joint, or step over this position."


def _no_balance_sentence(c: Compiled) -> str:
    given = ", ".join(n for n, asked in zip(c.schedule.names, c.known.asked, strict=True) if not asked)
    unknown = ", ".join(c.unknown_loads)
    if unknown:
        return f"The unknown {unknown} cannot balance the given effort of {given}: it has no power here."
    return "The loads have no equilibrium here."


def _redundant_sentence(followed: Positions) -> str:
    m = followed.mobility
    assert m is not None
    many = "constraints are" if m.redundant > 1 else "constraint is"
    return (
        f"{m.redundant} {many} redundant among joints {', '.join(m.redundant_joints)}: "
        "reactions that are not unique are left out, their least-norm values given beside."
    )


def _nothing(followed: Positions, inertia: bool) -> Result:
    """No position closes."""
    c = followed.compiled
    count, links, joints = len(c.targets), len(c.links), len(c.joints)

    def nan(*shape: int) -> Array:
        return np.full((count, *shape), np.nan)

    sentence = open_sentence(c, None, np.arange(count))
    arrays = (nan(links, 2), nan(links), nan(links, 3), nan(links, 3), nan(joints, 2), nan(joints))
    unknowns = (nan(len(c.schedule.names)), nan(len(c.unknown_loads)), nan(), nan())
    status = ("not_assembled",) * count
    return Result(c, inertia, None, None, status, (sentence,) * count, *arrays, *unknowns)
