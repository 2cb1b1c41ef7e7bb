"""One pass from a description to every joint force, over a schedule of positions (docs/theory.md 5)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Literal, NamedTuple

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled, compile_mechanism
from dalembert.analysis.compile.elements.turning_plane import frame_at
from dalembert.analysis.degree_of_freedom import check_knowns
from dalembert.analysis.elements.turning_speeds import at_speed, with_speed
from dalembert.analysis.engine.force_program import ForceBlock
from dalembert.analysis.engine.quick_pass import quick_answer
from dalembert.analysis.engine.structures import known_forces
from dalembert.analysis.friction.friction_equilibrium import block_size, friction_equilibrium
from dalembert.analysis.friction.friction_problem import FrictionProblem
from dalembert.analysis.positions import Positions, positions
from dalembert.analysis.result.force_arrays import SolvedForces, at_places, concatenate_blocks, forces_of
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.analysis.result.reaction_axes import uniqueness
from dalembert.analysis.result.result import Result
from dalembert.analysis.status.acceleration_jumps import both_sides, jump_marks, jumping, just_after
from dalembert.analysis.status.closure_failure import open_sentence
from dalembert.analysis.status.overflow import size_sentence
from dalembert.analysis.status.statuses import KEPT, UNBALANCED, statuses
from dalembert.arrays import Array, Flags, Index, Ints, at
from dalembert.core.equilibrium import Known, balance, known_sources, motion, reactions
from dalembert.core.forcing import Forcing, WrenchSource, total_wrench
from dalembert.core.layout import Pose
from dalembert.core.position.motion_path import BLOCK, Path
from dalembert.model import Mechanism, Schedule

Method = Literal["auto", "careful"]
"""``auto``: by the structure's kept program where every position is surely ok; ``careful``: never so."""


def at_schedule(
    m: Mechanism, schedule: Schedule, inertia: bool, forces: bool = True, method: Method = "auto"
) -> Result:
    """Analysis at the positions of a schedule. What overflows or has no value becomes a status, not a warning."""
    with np.errstate(all="ignore"):
        c = compile_mechanism(m, schedule)
        if forces:
            check_knowns(c)
        beyond = size_sentence(c)
        if beyond is not None:
            return _nothing(Positions(c, None, None, None), inertia, "overflow", beyond)
        quick = quick_answer(c, inertia, forces) if method == "auto" else None
        if isinstance(quick, Result):
            return quick
        followed = quick or positions(c)
        if followed.path is None:
            return _nothing(
                followed, inertia, "not_assembled", open_sentence(c, None, np.arange(len(c.targets)))
            )
        return _along(followed, followed.path, inertia, forces, method)


def at_poses(c: Compiled, like: Result, which: Index, inertia: bool) -> Result:
    """Analysis at some positions of another result's, in its poses: of a mechanism that differs from that one in loads,
    masses, friction or rates, not in its geometry."""
    with np.errstate(all="ignore"):
        pose = full_pose(like, which)
        reached: Flags = np.asarray(np.isfinite(pose.point).all(axis=(1, 2)))
        path = Path(pose, reached, np.zeros(len(reached), np.intp))
        followed = Positions(some_positions(c, which), path, like.mobility, like.mode)
        return _along(followed, path, inertia, True)


def some_positions(c: Compiled, which: Index) -> Compiled:
    """The mechanism at some positions of its schedule."""
    s = c.schedule
    time, parts, after = (None if x is None else x[which] for x in (s.time, s.parts, s.after))
    rates = {name: getattr(s, name)[which] for name in ("position", "speed", "acceleration")}
    loads, known = slice_forcing(c, which)
    beyond = tuple(replace(b, at=b.at[which]) for b in c.beyond)
    some = replace(s, time=time, parts=parts, after=after, **rates)
    return replace(c, schedule=some, forcing=loads, known=known, beyond=beyond)


def _along(followed: Positions, path: Path, inertia: bool, forces: bool, method: Method = "auto") -> Result:
    """Rates, forces and statuses where the poses are known."""
    c, pose = followed.compiled, path.pose
    program = known_forces(c, pose, inertia) if forces and method == "auto" else None
    moved, solved = (
        _blocks(c, pose, inertia, forces) if program is None else _with_careful(c, pose, inertia, program)
    )
    moved, solved, behind, jumps = _with_jumps(c, pose, inertia, forces, moved, solved)
    status, reasons = statuses(
        followed, moved.twist, moved.acceleration, moved.rcond, solved, forces, inertia, jumps
    )
    _blank_without_answer(~path.reached, status, moved, solved)
    return _result(followed, moved, solved, inertia, status, reasons, behind)


def _with_jumps(
    c: Compiled, pose: Pose, inertia: bool, forces: bool, moved: _Moved, solved: SolvedForces
) -> tuple[_Moved, SolvedForces, _Moved, Flags]:
    """Motion and forces with those just before jumps of a prescribed acceleration, and just after, where it counts."""
    marks = jump_marks(c, pose, np.pad(moved.twist, ((0, 0), (0, 1), (0, 0))))
    marks = marks if inertia or not forces else np.zeros_like(marks)
    behind = moved
    for where, *sides in both_sides(c, marks):
        (first, f), (last, g) = (_blocks(side, pose, inertia, forces, where) for side in sides)
        rest = np.setdiff1d(np.arange(len(marks)), where)
        order = np.argsort(np.concatenate([rest, where]))
        kept, after = at_places(solved._replace(after=None), rest), at_places(solved.after or solved, rest)
        moved, behind = (
            at(_concatenate([at(some, rest), part]), order) for some, part in ((moved, first), (behind, last))
        )
        joined = concatenate_blocks([after._replace(after=None), (g.after or g)._replace(after=None)])
        solved = concatenate_blocks([kept, f._replace(after=None)])
        solved = at_places(solved, order)._replace(after=at_places(joined, order))
    return moved, solved, behind, jumping(marks)


class _Moved(NamedTuple):
    """Motion of a block of positions, ground left out."""

    point: Array
    turn: Array
    rotation: Array
    twist: Array
    acceleration: Array
    rcond: Array


def _blocks(
    c: Compiled, pose: Pose, inertia: bool, forces: bool, where: Ints | None = None
) -> tuple[_Moved, SolvedForces]:
    """Motion and forces (of some positions), in blocks of positions that fit the processor's cache."""
    size, count = block_size(c, BLOCK), len(c.targets) if where is None else len(where)
    places = [slice(k, k + size) for k in range(0, count, size)]
    parts = [_block(c, pose, p if where is None else where[p], inertia, forces) for p in places]
    return _concatenate([m for m, _ in parts]), concatenate_blocks([f for _, f in parts])


def _concatenate(parts: list[_Moved]) -> _Moved:
    return _Moved(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def _with_careful(c: Compiled, pose: Pose, inertia: bool, program: ForceBlock) -> tuple[_Moved, SolvedForces]:
    """Answer of a program where it is certain, and of the careful path elsewhere."""
    places = np.ones(len(program.sure))
    moved = _Moved(*_stands(c, pose), program.twist, program.acceleration, places)
    doubt = np.flatnonzero(~program.sure)
    if not doubt.size:
        return moved, program.forces
    sure = np.flatnonzero(program.sure)
    careful, careful_forces = _blocks(c, pose, inertia, forces=True, where=doubt)
    order = np.argsort(np.concatenate([sure, doubt]))
    forces = concatenate_blocks([at_places(program.forces, sure), careful_forces])
    return at(_concatenate([at(moved, sure), careful]), order), at_places(forces, order)


def _block(
    c: Compiled, poses: Pose, part: slice | Ints, inertia: bool, forces: bool
) -> tuple[_Moved, SolvedForces]:
    """Motion J v = rates, J a = rates - drift; forces A x + w = 0 with or without friction."""
    layout, pose, schedule = c.layout, poses.at(part), c.schedule
    moving, rows, solver = motion(layout, pose, schedule.speed[part], schedule.acceleration[part])
    moved = _Moved(*_stands(c, pose), moving.twist[:, :-1], moving.acceleration[:, :-1], moving.rcond)
    if not forces:
        return moved, _no_forces(c, len(pose.point))
    forcing, known = slice_forcing(c, part)
    sources = known_sources(layout, forcing, pose, moving, inertia)

    def solve(forcing: Forcing, sources: Mapping[str, WrenchSource]) -> SolvedForces:
        if c.contacts is not None:
            values = (c, c.contacts, part, forcing, known, pose, moving, rows, solver)
            return friction_equilibrium(FrictionProblem(*values, dict(sources)))
        w = total_wrench(layout, *sources.values())
        w = np.broadcast_to(w, (len(pose.point), *w.shape[1:]))
        equilibrium = balance(layout, forcing, known, pose, moving, rows, solver, w)
        force, couple = reactions(layout, pose, rows, equilibrium)
        moment = couple.reshape((*couple.shape[:-1], *_couple_shape(c)))
        return forces_of(equilibrium, force, moment, uniqueness(c, pose, rows, equilibrium.free))

    return moved, at_speed(solve, layout, known, forcing, pose, moving, sources)


def _stands(c: Compiled, pose: Pose) -> tuple[Array, Array, Array]:
    """Points, turns and rotations, ground left out."""
    return pose.point[:, :-1], c.layout.algebra.without_ground(pose.turn), pose.rotation[:, :-1]


def _no_forces(c: Compiled, count: int) -> SolvedForces:
    layout = c.layout
    return SolvedForces(
        force=_nan(count, layout.joints, layout.algebra.d),
        moment=_nan(count, layout.joints, *_couple_shape(c)),
        effort=_nan(count, len(layout.driven)),
        load=_nan(count, len(c.unknown_loads)),
        residual=_nan(count),
        power_balance=_nan(count),
        rcond=_nan(count),
        unique=None,
        unique_unknowns=None,
    )


def _nan(*shape: int) -> Array:
    return np.full(shape, np.nan)


def _couple_shape(c: Compiled) -> tuple[int, ...]:
    """A moment is one number in the plane, three in space."""
    return () if c.layout.algebra.d == 2 else (3,)


def slice_forcing(c: Compiled, part: Index) -> tuple[Forcing, Known]:
    """Loads and given efforts of some positions."""
    f, k = c.forcing, c.known
    forces = replace(f.forces, value=f.forces.value[part])
    couples = replace(f.couples, value=f.couples.value[part])
    turns = f.resistances.turns
    resistances = replace(f.resistances, turns=turns[part] if turns.ndim > 1 else turns)
    loads = replace(
        f, forces=forces, couples=couples, resistances=resistances, turning=frame_at(f.turning, part)
    )
    return loads, replace(k, effort=k.effort[part])


def _blank_without_answer(open_: Flags, status: tuple[str, ...], moved: _Moved, f: SolvedForces) -> None:
    """NaN where a position has no pose, no rates or no forces."""
    blank = ("undefined_load", "contact_lost", "slips", "slack")
    kinds = [(s not in KEPT, s in blank, s in ("jammed", "redundant")) for s in status]
    lost, undirected, unsolved = np.array(kinds).T
    _blank(open_, moved.point, moved.turn, moved.rotation)
    _blank(lost, moved.twist, moved.acceleration)
    for part in (f, *f.ends, *((f.after,) if f.after else ())):
        none = lost | undirected | (part.residual > UNBALANCED)
        _blank(none, part.force, part.moment, part.effort, part.load, part.residual, part.power_balance)
        _blank(none, *(a for a in part.friction or () if a.dtype.kind == "f"))
        _blank(unsolved & np.isnan(part.residual), part.effort)  # those given in the file too
        if part.friction is not None:
            part.friction.reversing[lost | undirected] = False


def _blank(where: Flags, *arrays: Array) -> None:
    for array in arrays:
        array[where] = np.nan


def _result(
    followed: Positions,
    moved: _Moved,
    f: SolvedForces,
    inertia: bool,
    status: tuple[str, ...],
    reasons: tuple[str | None, ...],
    behind: _Moved,
) -> Result:
    """The answer, with a separate one for either end of an interval and for the other side of reversals and jumps."""

    def result_of(e: SolvedForces, moved: _Moved = moved, c: Compiled = followed.compiled) -> Result:
        return Result(
            compiled=with_speed(c, e.square),
            inertia=inertia,
            mobility=followed.mobility,
            mode=followed.mode,
            status=status,
            reasons=reasons,
            point_array=moved.point,
            turn_array=moved.turn,
            rotation_array=moved.rotation,
            twist_array=moved.twist,
            acceleration_array=moved.acceleration,
            force_array=e.force,
            moment_array=e.moment,
            effort_array=e.effort,
            load_array=e.load,
            residual=e.residual,
            power_balance=e.power_balance,
            unique_array=e.unique,
            unique_unknowns=e.unique_unknowns,
            unique_in=e.unique_in,
            friction=e.friction,
        )

    ends = [result_of(e) for e in f.ends]
    after = result_of(f.after, behind, just_after(followed.compiled)) if f.after else None
    return replace(result_of(f), ends=tuple(zip(ends[::2], ends[1::2], strict=True)), after=after)


def _nothing(followed: Positions, inertia: bool, status: str, sentence: str) -> Result:
    """No position has an answer."""
    c = followed.compiled
    g, count, links = c.layout.algebra, len(c.targets), len(c.links)
    turn, rotation = g.reference_rotation(count, links)
    counted = max((int(f.count.max()) + 1 for f in c.layout.counted if f.count.size), default=0)
    turn, rotation = _nan(count, max(turn.shape[1], counted)), np.full_like(rotation, np.nan)
    none = _no_forces(c, count)[:6]
    motion = (_nan(count, links, g.d), turn, rotation, _nan(count, links, g.n), _nan(count, links, g.n))
    return Result(c, inertia, None, None, (status,) * count, (sentence,) * count, *motion, *none)
