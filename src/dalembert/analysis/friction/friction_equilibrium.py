"""Equilibrium with dry friction at a block of positions: senses of slip, the friction forces, losses, rest.

If all contacts slip, their senses follow from the motion, and friction is the solution of one system of equations per
position. If a rate is zero for an instant only (a dead centre) there are two solutions, just before and just after.
If a contact stays at rest every unknown lies in an interval; at its ends motion impends.
Mechanics: docs/theory.md 6.2.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.friction_problem import FrictionProblem
from dalembert.analysis.result.force_arrays import SolvedForces
from dalembert.arrays import Flags, Ints, Tree, at, put
from dalembert.core.friction.contact_equations import (
    ContactResponse,
    Contacts,
    SlipState,
    argument,
    bearing,
)
from dalembert.core.friction.friction_solver import FrictionSolution
from dalembert.core.friction.holding_range import holding
from dalembert.core.friction.impending_motion import extreme
from dalembert.core.friction.reversal import Driven, sides
from dalembert.core.friction.rod_spin import SpinningRods

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled


SAME = 1e-11
"""A contact that carries less than this part of the largest force carries nothing."""


def friction_equilibrium(p: FrictionProblem) -> SolvedForces:
    """Forces with friction; with both sides of reversals and both ends of what friction leaves open."""
    solution, rods = p.solution(p.r)
    open_ = solution.state.open.any(axis=-1)
    solution.x[open_], solution.z[open_], solution.critical[open_] = np.nan, np.nan, np.nan
    solution = p.with_self_locking(solution)
    return _open(p, solution, np.flatnonzero(open_), rods) if open_.any() else p.forces(solution)


def _open(
    p: FrictionProblem, solution: FrictionSolution, open_: Ints, rods: SpinningRods | None
) -> SolvedForces:
    """Both sides of the positions where the machine moves and contacts only reverse; both ends of every unknown where
    contacts stay at rest."""
    before, after = _sides(p, solution, open_, rods)
    rest = solution.state.open[open_] & before.open
    turns: Flags = np.asarray(~before.open.all(axis=-1))
    both = _both_sides(p, solution, open_, (before, after), turns)
    if rest[turns].any():
        loaded = put(np.zeros_like(solution.state.open), open_[turns], rest[turns])
        idle = [_idle(p.contacts, p.r, side, loaded)[open_[turns]] for side in both]
        turns[turns] = np.all(idle, axis=0)
        both = _both_sides(p, solution, open_, (before, after), turns)
    turn, stay = open_[turns], open_[~turns]
    reversing = None
    if turn.size:
        solution, behind = both
        known = put(np.zeros_like(solution.state.open), turn, ~before.open[turns])
        same = _idle(p.contacts, p.r, solution, known)[:, None]
        reversing = known & (solution.state.sense != behind.state.sense) & ~same
    forces = _with_ends(p, solution, stay, rods, reversing) if stay.size else p.forces(solution, reversing)
    if reversing is None or not reversing.any():
        return forces
    return forces._replace(after=_after(forces, p.forces(behind, reversing), turn))


def _after(forces: SolvedForces, behind: SolvedForces, turn: Ints) -> SolvedForces:
    """Forces and friction just after reversals; those of other positions are unchanged, at rest or not."""
    names = ["force", "moment", "effort", "load", "residual", "power_balance", "rcond", "friction"]
    numbers: Tree = {n: put(getattr(forces, n), turn, at(getattr(behind, n), turn)) for n in names}
    return behind._replace(**numbers)


def _both_sides(
    p: FrictionProblem,
    solution: FrictionSolution,
    open_: Ints,
    both: tuple[SlipState, SlipState],
    turns: Flags,
) -> list[FrictionSolution]:
    """Friction just before and just after some of the open positions; contacts that stay at rest carry no friction."""
    turn, out = open_[turns], []
    for side in (at(side, turns) for side in both) if turn.size else ():
        rest = solution.state.open[turn] & side.open
        known = side._replace(sense=np.where(rest, 0.0, side.sense), open=side.open & ~rest)
        turned, _ = p.solution(at(p.r, turn), known, turn)
        everywhere = solution.state._replace(open=np.ones_like(solution.state.open))
        out.append(p.with_self_locking(put(solution, turn, turned), put(everywhere, turn, known)))
    return out


def _sides(
    p: FrictionProblem, solution: FrictionSolution, open_: Ints, rods: SpinningRods | None
) -> tuple[SlipState, SlipState]:
    """Senses of the open contacts before and after; all are open where the machine does not move."""
    c, part = p.c, p.part
    spun = np.zeros(p.contacts.count, bool) if rods is None else np.asarray(rods.touched.any(axis=0))
    driven = Driven(c.targets[part], c.schedule.speed[part], c.schedule.acceleration[part])
    here = p.along.at(open_), p.pose.at(open_), at(p.moving, open_), at(driven, open_)
    still = ~c.schedule.moves[part][open_][:, None]
    if still.all():
        state = at(solution.state, open_)
        return (state._replace(open=np.ones_like(state.open)),) * 2
    both = sides(c.layout, p.contacts, *here, at(solution.state, open_), spun)
    before, after = (side._replace(open=side.open | still) for side in both)
    return before, after


def _with_ends(
    p: FrictionProblem,
    solution: FrictionSolution,
    open_: Ints,
    rods: SpinningRods | None,
    reversing: Flags | None,
) -> SolvedForces:
    """Both ends of every unknown at the open positions; where all are one, the number itself."""
    contacts, part, known = p.contacts, at(p.r, open_), at(solution.state, open_)
    spinning = None if rods is None else rods.at(open_)
    ends = [
        extreme(p.c.layout, contacts, part, known, unknown, end, spinning)
        for unknown in p.unknowns
        for end in (-1.0, 1.0)
    ]
    if not ends:
        return p.forces(solution, reversing)
    one = _idle(contacts, part, ends[0], known.open)
    at_rest = known._replace(open=known.open & ~one[:, None])
    number = at(ends[0]._replace(state=at_rest), one)
    solutions = [
        put(solution, open_, end._replace(state=at_rest._replace(sense=end.state.sense))) for end in ends
    ]
    solved = p.forces(put(solution, open_[one], number), reversing)
    assert solved.friction is not None
    if rods is None:
        x = np.stack([end.x[:, k] for end, k in zip(ends, np.repeat(p.unknowns, 2), strict=True)], axis=-1)
        solved.friction.holding[open_] = holding(contacts, part, known, x.reshape((len(x), -1, 2)))
    return solved._replace(ends=tuple(p.forces(end, reversing) for end in solutions))


def _idle(contacts: Contacts, r: ContactResponse, solution: FrictionSolution, open_: Flags) -> Flags:
    """True for contacts of unknown sense that carry no force, so that the sense does not matter."""
    y = argument(r, solution.c * np.nan_to_num(solution.z))
    carried = np.where(open_ & (solution.c != 0), np.abs(bearing(contacts, y)), 0.0).max(axis=-1, initial=0.0)
    return np.asarray(carried <= SAME * np.abs(y).max(axis=(-2, -1), initial=0.0))


def block_size(c: Compiled, most: int) -> int:
    """Positions at once, so that the matrices H of all stay below a few hundred MB."""
    if c.contacts is None:
        return most
    return max(1, min(most, 10**7 // (c.contacts.count**2 * 3 + 1)))
