"""One pass from a description to every joint force, over a schedule of positions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from dalembert.analysis.closure_failure import drive_text, open_sentence
from dalembert.analysis.compile.compiled_mechanism import Compiled, compile_mechanism
from dalembert.analysis.degree_of_freedom import check_knowns
from dalembert.analysis.friction.friction_equilibrium import Setting, block_size, rubbing
from dalembert.analysis.friction.friction_status import (
    alone,
    friction_checks,
    reversal_checks,
)
from dalembert.analysis.positions import Positions, positions
from dalembert.analysis.result.force_arrays import Forces, concatenate_blocks
from dalembert.analysis.result.overflow import fast, not_finite, overflow_sentence, strong
from dalembert.analysis.result.reaction_axes import marks
from dalembert.analysis.result.result import Result
from dalembert.analysis.undefined_springs import find_undefined_springs, undefined_sentence
from dalembert.arrays import Array, Flags, Ints
from dalembert.core.equilibrium import balance, known_sources, motion, reactions
from dalembert.core.forcing import total_wrench
from dalembert.core.friction.reversal import Driven
from dalembert.core.layout import Pose
from dalembert.core.position.motion_path import BLOCK
from dalembert.core.rank import singular_below
from dalembert.errors import NUMBERED
from dalembert.model import Mechanism, Schedule

UNBALANCED = 1e-6
"""Residual above which a position has no equilibrium."""


def at_schedule(m: Mechanism, schedule: Schedule, inertia: bool, forces: bool = True) -> Result:
    """Analysis at the positions of a schedule. What overflows or has no value becomes a status, not a warning."""
    with np.errstate(all="ignore"):
        return _at_schedule(m, schedule, inertia, forces)


def _at_schedule(m: Mechanism, schedule: Schedule, inertia: bool, forces: bool) -> Result:
    c = compile_mechanism(m, schedule)
    if forces:
        check_knowns(c)
    followed = positions(c)
    if followed.path is None:
        return _nothing(followed, inertia)
    c, pose = followed.compiled, followed.path.pose
    size = block_size(c, BLOCK)
    parts = [_block(c, pose, slice(k, k + size), inertia, forces) for k in range(0, len(c.targets), size)]
    moved = _Moved(*(np.concatenate(column) for column in zip(*(m for m, _ in parts), strict=True)))
    return _result(followed, moved, concatenate_blocks([f for _, f in parts]), inertia, forces)


class _Moved(NamedTuple):
    """Motion of a block of positions, ground left out."""

    point: Array
    turn: Array
    rotation: Array
    twist: Array
    acceleration: Array
    rcond: Array


def _block(c: Compiled, whole: Pose, part: slice, inertia: bool, forces: bool) -> tuple[_Moved, Forces]:
    """Motion and forces of some positions."""
    layout, pose, schedule = c.layout, whole.at(part), c.schedule
    with np.errstate(all="ignore"):
        moving, rows, solver = motion(layout, pose, schedule.speed[part], schedule.acceleration[part])
        found = (
            _forces(c, pose, part, moving, rows, solver, inertia)
            if forces
            else _no_forces(c, len(pose.point))
        )
    point, rotation, twist, acceleration = (
        a[:, :-1] for a in (pose.point, pose.rotation, moving.twist, moving.acceleration)
    )
    turn = layout.algebra.without_ground(pose.turn)
    return _Moved(point, turn, rotation, twist, acceleration, moving.rcond), found


def _no_forces(c: Compiled, count: int) -> Forces:
    def nan(*shape: int) -> Array:
        return np.full((count, *shape), np.nan)

    layout, unknown = c.layout, len(c.unknown_loads)
    reactions = nan(layout.joints, layout.algebra.d), nan(layout.joints, *_couple_shape(c))
    return Forces(*reactions, nan(len(layout.driven)), nan(unknown), nan(), nan(), nan(), None, None)


def _couple_shape(c: Compiled) -> tuple[int, ...]:
    """A moment is one number in the plane, three in space."""
    return () if c.layout.algebra.d == 2 else (3,)


def _forces(
    c: Compiled, pose: Pose, part: slice, moving: Any, rows: Any, solver: Any, inertia: bool
) -> Forces:
    layout = c.layout
    forcing, known = slice_forcing(c, part)
    sources = known_sources(layout, forcing, pose, moving, inertia)
    w = total_wrench(layout, *sources.values())
    w = np.broadcast_to(w, (len(pose.point), *w.shape[1:]))
    if c.contacts is not None:
        driven = Driven(c.targets[part], c.schedule.speed[part], c.schedule.acceleration[part])
        moves = c.schedule.moves[part]
        setting = (c, c.contacts, forcing, known, pose, moving, rows, solver, sources, driven, moves)
        return rubbing(Setting(*setting), w)
    found = balance(layout, forcing, known, pose, moving, rows, solver, w)
    force, couple = reactions(layout, pose, rows, found)
    known_by = marks(c, pose, rows, found.free)
    checks = (found.residual, found.power_balance, found.rcond)
    moment = couple.reshape((*couple.shape[:-1], *_couple_shape(c)))
    return Forces(force, moment, found.effort, found.load, *checks, *known_by[:2], unique_in=known_by.inside)


def slice_forcing(c: Compiled, part: Any) -> tuple[Any, Any]:
    """Loads and given efforts of some positions."""
    f, k = c.forcing, c.known
    forces = replace(f.forces, value=f.forces.value[part])
    couples = replace(f.couples, value=f.couples.value[part])
    turns = f.resistances.turns
    resistances = replace(f.resistances, turns=turns[part] if turns.ndim > 1 else turns)
    loads = replace(f, forces=forces, couples=couples, resistances=resistances)
    return loads, replace(k, effort=k.effort[part])


KEPT = (*NUMBERED, "redundant", "jammed", "at_rest", "undefined_load")
"""Statuses whose motion stands, and what numbers there are of the forces."""


def _result(followed: Positions, moved: _Moved, f: Forces, inertia: bool, forces: bool) -> Result:
    c = followed.compiled
    assert followed.path is not None
    status, reasons = _statuses(followed, moved, f, forces)
    kinds = [(s not in KEPT, s == "undefined_load", s in ("jammed", "redundant")) for s in status]
    lost, undirected, unsolved = np.array(kinds).T
    open_ = ~followed.path.reached
    _blank(open_, moved.point, moved.turn, moved.rotation)
    _blank(lost, moved.twist, moved.acceleration)
    others = (*f.ends, *((f.after,) if f.after else ()))
    for part in (f, *others):
        none = lost | undirected | (part.residual > UNBALANCED)
        _blank(none, *part[:6], *(a for a in part.friction or () if a.dtype.kind == "f"))
        _blank(unsolved & np.isnan(part.residual), part.effort)  # those given in the file too
        if part.friction is not None:
            part.friction.reversing[lost | undirected] = False
    made = (c, inertia, followed.mobility, followed.mode, status, reasons, *moved[:5])

    def result_of(e: Forces) -> Result:
        return Result(*made, *e[:6], *e[7:9], friction=e.friction, unique_in=e.unique_in)

    result, ends = result_of(f), [result_of(e) for e in f.ends]
    after = result_of(f.after) if f.after else None
    return replace(result, ends=tuple(zip(ends[::2], ends[1::2], strict=True)), after=after)


def _blank(where: Flags, *arrays: Array) -> None:
    for array in arrays:
        array[where] = np.nan


def _statuses(
    followed: Positions, moved: _Moved, f: Forces, forces: bool
) -> tuple[tuple[str, ...], tuple[str | None, ...]]:
    """Status and sentence of each position: the first that applies."""
    c, path = followed.compiled, followed.path
    assert path is not None
    limit = singular_below(c.layout)
    unbalanced = (f.rcond < limit) | ~(f.residual <= UNBALANCED)
    unheld = np.array([e.residual for e in f.ends] or [np.zeros(len(f.rcond))]) > UNBALANCED
    partial = f.unique is not None and not f.unique.all()
    checks: list[tuple[str, Any, Callable[[Any], str]]] = [
        ("not_assembled", ~path.reached, lambda k: open_sentence(c, path, k)),
        ("singular", ~(moved.rcond >= limit), lambda k: _singular_sentence(c, k)),
    ]
    racing = fast(moved.twist, moved.acceleration)
    rates = "rates or accelerations"
    checks += [("overflow", racing.any(axis=1), lambda k: overflow_sentence(c, rates, c.links, racing, k))]
    if forces:
        loaded, held = strong(f), f.rcond >= limit
        pushing = find_undefined_springs(c, path.pose)
        checks += [("undefined_load", pushing.any(axis=-1), lambda k: undefined_sentence(c, pushing, k))]
        checks += [("no_balance", unheld.all(axis=0), lambda k: _no_balance_sentence(c))]
        checks += friction_checks(c, f, held)
        checks += [
            ("overflow", not_finite(f) & held, lambda k: overflow_sentence(c, "forces", c.joints, loaded, k)),
            ("no_balance", unbalanced, lambda k: _no_balance_sentence(c)),
            ("redundant", np.full(len(f.rcond), partial), lambda k: _redundant_sentence(followed)),
            *reversal_checks(c, f),
        ]
    status = np.full(len(moved.rcond), "ok", dtype=object)
    reasons = np.full(len(moved.rcond), None, dtype=object)
    single = alone(f)
    for code, mask, sentence in checks:
        where = np.flatnonzero(mask & (status == "ok"))
        status[where] = code
        apart = (np.diff(where) > 1) | single[where[1:]] | single[where[:-1]]
        for run in np.split(where, np.flatnonzero(apart) + 1):
            if run.size:
                reasons[run] = sentence(run)
    return tuple(status), tuple(reasons)


def _singular_sentence(c: Compiled, where: Ints) -> str:
    at = [f"{n} = {drive_text(c, int(where[0]), k)}" for k, n in enumerate(c.schedule.names)]
    here = f" at {' and '.join(at)}" if at else ""
    return f"Dead centre or change point{here}: drive another joint, or step over this position."


def _no_balance_sentence(c: Compiled) -> str:
    given = ", ".join(n for n, asked in zip(c.schedule.names, c.known.asked, strict=True) if not asked)
    unknown = ", ".join(c.unknown_loads)
    if c.passive:
        links = " or ".join(c.passive)
        holds = "which nothing holds" if c.contacts is None else "more than friction holds"
        return (
            f"The loads have no equilibrium here: they turn {links} about the line of two ball joints, {holds}. "
            "Put a universal joint in place of one of them, or bring the mass centre onto the line."
        )
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
    g, count, links, joints = c.layout.algebra, len(c.targets), len(c.links), len(c.joints)

    def nan(*shape: int) -> Array:
        return np.full((count, *shape), np.nan)

    sentence = open_sentence(c, None, np.arange(count))
    turn, rotation = (np.full_like(a, np.nan) for a in g.reference_rotation(count, links))
    reactions = nan(joints, g.d), nan(joints, *_couple_shape(c))
    arrays = (nan(links, g.d), turn, rotation, nan(links, g.n), nan(links, g.n), *reactions)
    unknowns = (nan(len(c.schedule.names)), nan(len(c.unknown_loads)), nan(), nan())
    status = ("not_assembled",) * count
    return Result(c, inertia, None, None, status, (sentence,) * count, *arrays, *unknowns)
