"""Equilibrium with dry friction at a block of positions: senses of slip, the friction forces, what they cost, rest.

Where all contacts slip their senses follow from the motion, and friction is the solution of one system of equations a
position. Where a rate is zero for an instant only (a dead centre) there are two solutions, just before and just after.
Where a contact stays at rest every unknown lies in an interval; at its ends motion impends.
Mechanics: docs/theory.md 6.2.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.result.force_arrays import Forces, Friction, forces_of
from dalembert.analysis.result.reaction_axes import marks
from dalembert.arrays import Array, Flags, Index, Ints, Tree, at, put
from dalembert.core.constraints import rates
from dalembert.core.equilibrium import (
    UNIQUE,
    Balance,
    Known,
    Motion,
    Statement,
    check_equilibrium,
    reactions,
    statement,
)
from dalembert.core.forcing import Forcing, Source, pair, total_wrench
from dalembert.core.friction.contact_equations import (
    Contacts,
    Response,
    SlipState,
    argument,
    bearing,
    repeat,
    response,
    senses,
    under,
)
from dalembert.core.friction.friction_solver import FrictionSolution, solve_friction, without_friction
from dalembert.core.friction.holding_range import holding
from dalembert.core.friction.impending_motion import extreme
from dalembert.core.friction.losses import by_joint, dry_wrenches, power_reversed, viscous_wrenches
from dalembert.core.friction.reversal import Driven, sides
from dalembert.core.friction.rod_spin import SpinningRods, follow_branch_with_spin, solve_spins, spinning_rods
from dalembert.core.layout import Pose, System
from dalembert.core.linear import Factor, PseudoInverse

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled


SAME = 1e-11
"""A contact that carries less than this part of the largest force carries nothing."""

EVERY = slice(None)


@dataclass(frozen=True)
class FrictionProblem:
    """A block of positions (a ``part`` of all) before its friction is known, and what loads it by kind."""

    c: Compiled
    contacts: Contacts
    part: slice | Ints
    forcing: Forcing
    known: Known
    pose: Pose
    moving: Motion
    rows: System
    solver: Factor
    sources: dict[str, Source]

    def statement(self, *left_out: str) -> Statement:
        """What is asked of the equilibrium, under all loads but those of some kinds."""
        layout = self.c.layout
        w = total_wrench(layout, *(source for kind, source in self.sources.items() if kind not in left_out))
        w = np.broadcast_to(w, (len(self.pose.point), *w.shape[1:]))
        return statement(layout, self.known, self.pose, self.rows, self.solver, w)

    @cached_property
    def stated(self) -> Statement:
        """Under all loads."""
        return self.statement()

    @cached_property
    def _response(self) -> tuple[System, Response]:
        s = self.stated
        return response(self.c.layout, self.contacts, self.pose, s.forces, s.w, self.moving.twist)

    @property
    def along(self) -> System:
        """What the contacts act along."""
        return self._response[0]

    @cached_property
    def r(self) -> Response:
        """Response of reactions and arguments to friction at each position; none where it is not unique."""
        r = self._response[1]
        r = r._replace(y=np.where(self.blocked[:, None, None], np.nan, r.y))
        return repeat(r, len(self.stated.w))

    @cached_property
    def blocked(self) -> Flags:
        """Positions where a reaction that friction follows is not unique."""
        forces, read = self.stated.forces, np.abs(self.contacts.read).max(axis=(0, 1), initial=0.0)
        if not isinstance(forces, PseudoInverse):
            return np.zeros(len(self.stated.w), bool)
        free = np.abs(forces.null[..., np.flatnonzero(read), :])
        return np.asarray(free.max(axis=(-2, -1), initial=0.0) > UNIQUE)

    @cached_property
    def bare(self) -> Array:
        """Multipliers without friction."""
        return without_friction(self.contacts, self.r)

    @cached_property
    def bare_balance(self) -> Balance:
        """Equilibrium without friction."""
        return self._check(self.bare, self.stated.w)

    def _check(self, x: Array, w: Array) -> Balance:
        c, given = self.c.layout, (self.forcing, self.known, self.pose, self.moving, self.stated)
        return check_equilibrium(c, *given, x, w)

    def solution(
        self, r: Response, side: SlipState | None = None, where: Index = EVERY
    ) -> tuple[FrictionSolution, SpinningRods | None]:
        """Friction from the response at some positions, on one ``side`` of them; with rods that spin the branch is
        followed with them where it ends or leaves a moment."""
        contacts = self.contacts
        state, rods = self._state(r, side, where)
        found = solve_friction(contacts, r, state)
        if rods is None:
            return found, None
        left = np.abs(found.x[..., rods.row]).max(axis=-1) > SAME * np.abs(found.x).max(axis=-1)
        some = np.flatnonzero(~state.open.any(axis=-1) & (np.isfinite(found.critical) | left))
        if some.size:
            here = at(repeat(r, len(state.open)), some)
            branch = follow_branch_with_spin(contacts, here, state.open[some], rods.at(some))
            on = branch.critical != 0
            found = put(found, some[on], at(branch, on))
        return found, rods

    def _state(
        self, r: Response, side: SlipState | None, where: Index
    ) -> tuple[SlipState, SpinningRods | None]:
        """Senses of the contacts; rods between balls spin as the balls' friction lets them."""
        layout, contacts, pose = self.c.layout, self.contacts, self.pose.at(where)
        along, twist = self.along.at(where), self.moving.twist[where]
        given = self.c.schedule.parts

        def state(twist: Array) -> SlipState:
            found = senses(layout, contacts, along, twist)
            if given is not None:
                known = found.open & np.isfinite(given[self.part][where])
                sense = np.where(known, given[self.part][where], found.sense)
                found = found._replace(sense=sense, open=found.open & ~known)
            if side is None:
                return found
            sense = np.where(side.open, found.sense, side.sense)
            return found._replace(sense=sense, open=found.open & side.open)

        rods = spinning_rods(layout, pose, along, twist, state) if self.c.passive else None
        if rods is None:
            return state(twist), None

        def moment(phi: Array) -> Array:
            return np.nan_to_num(solve_friction(contacts, r, rods.senses(phi)).x[..., rods.row])

        return rods.senses(solve_spins(rods.rate.shape, moment)), rods

    def with_self_locking(self, found: FrictionSolution, side: SlipState | None = None) -> FrictionSolution:
        """The solution, with where friction turns the power of the unknowns round, also without inertia."""
        locked = self._power_reversed(self.stated, self.bare, found)
        if "inertia" in self.sources and locked.any():
            still, rate = self.statement("inertia"), rates(self.along, self.moving.twist)
            r = under(self.c.layout, self.contacts, self.pose, still.forces, still.w, rate, self.r)
            bare = without_friction(self.contacts, r)
            locked = locked & self._power_reversed(still, bare, self.solution(r, side)[0])
        return found._replace(locked=locked)

    def _power_reversed(self, stated: Statement, bare: Array, found: FrictionSolution) -> Flags:
        twist = self.moving.twist
        return np.asarray(power_reversed(self.c.layout, stated.unknown, twist, stated.w, found.x, bare))

    def forces(self, found: FrictionSolution, reversing: Flags | None = None) -> Forces:
        """Reactions, efforts and what friction does, of one solution."""
        layout, cz = self.c.layout, found.c * found.z
        whole = self._check(found.x, self.stated.w + total_wrench(layout, pair(self.along, cz)))
        force, couple = reactions(layout, self.pose, self.rows, whole)
        known_by = marks(self.c, self.pose, self.rows, whole.free)
        friction = self._friction(found, cz, reversing)
        force = force + friction.force + friction.viscous_force
        moment = couple.reshape(friction.moment.shape) + friction.moment + friction.viscous_moment
        return forces_of(whole, force, moment, known_by, friction)

    def _friction(self, found: FrictionSolution, cz: Array, reversing: Flags | None) -> Friction:
        layout, contacts, state = self.c.layout, self.contacts, found.state
        dry = np.where(contacts.fixed, 0.0, cz)
        force, moment = dry_wrenches(layout, contacts, self.pose, self.along, dry)
        viscous_force, viscous_moment, viscous_loss = viscous_wrenches(
            layout, contacts, self.pose, self.moving.twist
        )
        without = by_joint(
            contacts.joint, layout.joints, 0.0 * dry
        )  # NaN, wholly, where a contact has no number
        return Friction(
            force=force + without[..., None],
            moment=moment + without.reshape((*without.shape, *(1,) * (moment.ndim - 2))),
            viscous_force=viscous_force,
            viscous_moment=viscous_moment,
            dry_loss=by_joint(contacts.joint, layout.joints, -dry * state.rate),
            viscous_loss=viscous_loss,
            cz=dry,
            sense=state.sense,
            rate=state.rate,
            argument=argument(self.r, cz),
            determinant=found.determinant,
            critical=found.critical,
            single=found.single,
            open=state.open,
            reversing=np.zeros_like(state.open) if reversing is None else reversing,
            blocked=self.blocked,
            locked=found.locked,
            bare_effort=self.bare_balance.effort.copy(),
            bare_load=self.bare_balance.load.copy(),
            holding=np.full((len(cz), len(self.unknowns), 2), np.nan),
        )

    @property
    def unknowns(self) -> range:
        """Multipliers of the efforts and loads that are asked for."""
        return range(self.c.layout.constraints.count, self.bare.shape[-1])


def friction_equilibrium(p: FrictionProblem) -> Forces:
    """Forces with friction; with both sides of reversals and both ends of what friction leaves open."""
    found, rods = p.solution(p.r)
    open_ = found.state.open.any(axis=-1)
    found.x[open_], found.z[open_], found.critical[open_] = np.nan, np.nan, np.nan
    found = p.with_self_locking(found)
    return _open(p, found, np.flatnonzero(open_), rods) if open_.any() else p.forces(found)


def _open(p: FrictionProblem, found: FrictionSolution, open_: Ints, rods: SpinningRods | None) -> Forces:
    """Both sides of the positions where the machine moves and contacts only reverse; both ends of every unknown where
    contacts stay at rest."""
    before, after = _sides(p, found, open_, rods)
    rest = found.state.open[open_] & before.open
    turns: Flags = np.asarray(~before.open.all(axis=-1))
    both = _both_sides(p, found, open_, (before, after), turns)
    if rest[turns].any():
        loaded = put(np.zeros_like(found.state.open), open_[turns], rest[turns])
        idle = [_idle(p.contacts, p.r, side, loaded)[open_[turns]] for side in both]
        turns[turns] = np.all(idle, axis=0)
        both = _both_sides(p, found, open_, (before, after), turns)
    turn, stay = open_[turns], open_[~turns]
    reversing = None
    if turn.size:
        found, behind = both
        known = put(np.zeros_like(found.state.open), turn, ~before.open[turns])
        same = _idle(p.contacts, p.r, found, known)[:, None]
        reversing = known & (found.state.sense != behind.state.sense) & ~same
    whole = _with_ends(p, found, stay, rods, reversing) if stay.size else p.forces(found, reversing)
    if reversing is None or not reversing.any():
        return whole
    return whole._replace(after=_after(whole, p.forces(behind, reversing), turn))


def _after(whole: Forces, behind: Forces, turn: Ints) -> Forces:
    """Forces and friction just after reversals; at other positions they stay, found at rest or not."""
    names = ["force", "moment", "effort", "load", "residual", "power_balance", "rcond", "friction"]
    numbers: Tree = {n: put(getattr(whole, n), turn, at(getattr(behind, n), turn)) for n in names}
    return behind._replace(**numbers)


def _both_sides(
    p: FrictionProblem, found: FrictionSolution, open_: Ints, both: tuple[SlipState, SlipState], turns: Flags
) -> list[FrictionSolution]:
    """Friction just before and just after some of the open positions; contacts that stay at rest there carry
    nothing."""
    turn, out = open_[turns], []
    for side in (at(side, turns) for side in both) if turn.size else ():
        rest = found.state.open[turn] & side.open
        known = side._replace(sense=np.where(rest, 0.0, side.sense), open=side.open & ~rest)
        there, _ = p.solution(at(p.r, turn), known, turn)
        everywhere = found.state._replace(open=np.ones_like(found.state.open))
        out.append(p.with_self_locking(put(found, turn, there), put(everywhere, turn, known)))
    return out


def _sides(
    p: FrictionProblem, found: FrictionSolution, open_: Ints, rods: SpinningRods | None
) -> tuple[SlipState, SlipState]:
    """Senses of the open contacts before and after; all are open where the machine does not move."""
    c, part = p.c, p.part
    spun = np.zeros(p.contacts.count, bool) if rods is None else np.asarray(rods.touched.any(axis=0))
    driven = Driven(c.targets[part], c.schedule.speed[part], c.schedule.acceleration[part])
    here = p.along.at(open_), p.pose.at(open_), at(p.moving, open_), at(driven, open_)
    still = ~c.schedule.moves[part][open_][:, None]
    if still.all():
        state = at(found.state, open_)
        return (state._replace(open=np.ones_like(state.open)),) * 2
    both = sides(c.layout, p.contacts, *here, at(found.state, open_), spun)
    before, after = (side._replace(open=side.open | still) for side in both)
    return before, after


def _with_ends(
    p: FrictionProblem,
    found: FrictionSolution,
    open_: Ints,
    rods: SpinningRods | None,
    reversing: Flags | None,
) -> Forces:
    """Both ends of every unknown at the open positions; where all are one, the number itself."""
    contacts, part, known = p.contacts, at(p.r, open_), at(found.state, open_)
    spinning = None if rods is None else rods.at(open_)
    ends = [
        extreme(p.c.layout, contacts, part, known, unknown, end, spinning)
        for unknown in p.unknowns
        for end in (-1.0, 1.0)
    ]
    if not ends:
        return p.forces(found, reversing)
    one = _idle(contacts, part, ends[0], known.open)
    at_rest = known._replace(open=known.open & ~one[:, None])
    number = at(ends[0]._replace(state=at_rest), one)
    whole = [put(found, open_, end._replace(state=at_rest._replace(sense=end.state.sense))) for end in ends]
    solved = p.forces(put(found, open_[one], number), reversing)
    assert solved.friction is not None
    if rods is None:
        x = np.stack([end.x[:, k] for end, k in zip(ends, np.repeat(p.unknowns, 2), strict=True)], axis=-1)
        solved.friction.holding[open_] = holding(contacts, part, known, x.reshape((len(x), -1, 2)))
    return solved._replace(ends=tuple(p.forces(end, reversing) for end in whole))


def _idle(contacts: Contacts, r: Response, found: FrictionSolution, open_: Flags) -> Flags:
    """Where contacts of unknown sense carry nothing, so that it does not matter."""
    y = argument(r, found.c * np.nan_to_num(found.z))
    carried = np.where(open_ & (found.c != 0), np.abs(bearing(contacts, y)), 0.0).max(axis=-1, initial=0.0)
    return np.asarray(carried <= SAME * np.abs(y).max(axis=(-2, -1), initial=0.0))


def block_size(c: Compiled, most: int) -> int:
    """Positions at once, so that the matrices H of all stay below a few hundred MB."""
    if c.contacts is None:
        return most
    return max(1, min(most, 10**7 // (c.contacts.count**2 * 3 + 1)))
