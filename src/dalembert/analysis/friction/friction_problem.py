"""Data of the friction problem at a block of positions: senses of slip, the response of reactions to friction, and the
forces of one solution.

Mechanics: docs/theory.md 6.2.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.result.force_arrays import Friction, SolvedForces, forces_of
from dalembert.analysis.result.reaction_axes import uniqueness
from dalembert.arrays import Array, Flags, Index, Ints, at, put
from dalembert.core.constraints import rates
from dalembert.core.equilibrium import (
    UNIQUE,
    Equilibrium,
    Known,
    LinkMotions,
    Statement,
    check_equilibrium,
    reactions,
    statement,
)
from dalembert.core.forcing import Forcing, WrenchSource, pair, total_wrench
from dalembert.core.friction.contact_equations import (
    ContactResponse,
    Contacts,
    SlipState,
    repeat,
    response,
    senses,
    under,
)
from dalembert.core.friction.friction_solver import FrictionSolution, solve_friction, without_friction
from dalembert.core.friction.losses import by_joint, friction_arrays, power_reversed
from dalembert.core.friction.rod_spin import SpinningRods, follow_branch_with_spin, solve_spins, spinning_rods
from dalembert.core.friction.unpowered_loads import ThroughFriction, solve_unpowered
from dalembert.core.layout import ConstraintRows, Pose
from dalembert.core.linear import Factor, PseudoInverse
from dalembert.core.rank import singular_below

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
    moving: LinkMotions
    rows: ConstraintRows
    solver: Factor
    sources: dict[str, WrenchSource]

    def statement(self, *left_out: str) -> Statement:
        """Statement of the equilibrium, under all loads except those of some kinds."""
        w = self._wrench(*left_out)
        return statement(self.c.layout, self.known, self.pose, self.rows, self.solver, w)

    def _wrench(self, *left_out: str) -> Array:
        """Total wrenches of all loads but those of some kinds."""
        layout = self.c.layout
        w = total_wrench(layout, *(source for kind, source in self.sources.items() if kind not in left_out))
        return np.broadcast_to(w, (len(self.pose.point), *w.shape[1:]))

    @cached_property
    def stated(self) -> Statement:
        """Under all loads."""
        return self.statement()

    @cached_property
    def _response(self) -> tuple[ConstraintRows, ContactResponse]:
        s = self.stated
        return response(self.c.layout, self.contacts, self.pose, s.forces, s.w, self.moving.twist)

    @property
    def along(self) -> ConstraintRows:
        """Directions along which the contacts act."""
        return self._response[0]

    @cached_property
    def r(self) -> ContactResponse:
        """Response of reactions and arguments to friction at each position; none where it is not unique."""
        r, loads = repeat(self._response[1], len(self.stated.w)), self.through_friction
        if loads is not None:
            r = put(r, self.unpowered, at(loads.response, self.unpowered))
        return r._replace(y=np.where(self.blocked[:, None, None], np.nan, r.y))

    @cached_property
    def blocked(self) -> Flags:
        """Positions where a reaction that friction follows is not unique."""
        read = np.flatnonzero(np.abs(self.contacts.read).max(axis=(0, 1), initial=0.0))
        if self.free is None:
            return np.zeros(len(self.stated.w), bool)
        return np.asarray(np.abs(self.free[..., read, :]).max(axis=(-2, -1), initial=0.0) > UNIQUE)

    @cached_property
    def free(self) -> Array | None:
        """Projector on multipliers that load nothing; that of constraints and drives where loads act by friction."""
        forces, solver = self.stated.forces, self.solver
        if not isinstance(forces, PseudoInverse):
            return None
        null = np.broadcast_to(forces.null, (len(self.stated.w), *forces.null.shape[-2:]))
        if not (self.unpowered.any() and isinstance(solver, PseudoInverse)):
            return null
        count, requested = self.c.layout.constraints.count, self.known.requested
        kept = np.concatenate([np.arange(count), count + np.flatnonzero(requested)])
        free = np.zeros_like(null)
        free[:, : len(kept), : len(kept)] = solver.null[..., kept[:, None], kept]
        return np.where(self.unpowered[:, None, None], free, null)

    @cached_property
    def unpowered(self) -> Flags:
        """Positions where the unknown loads have no power and contacts slip: friction alone can settle them."""
        limit, count = singular_below(self.c.layout), len(self.stated.w)
        if not self.known.link.size or self.c.passive:
            return np.zeros(count, bool)
        singular = (self.stated.forces.rcond < limit) & (self.solver.rcond >= limit)
        return np.broadcast_to(singular, count) & ~self._state_of_motion.open.any(axis=-1)

    @cached_property
    def through_friction(self) -> ThroughFriction | None:
        """Unknown loads at these positions."""
        if not self.unpowered.any():
            return None
        common = (self.c.layout, self.contacts, self.known, self.pose, self.rows, self.solver)
        return solve_unpowered(*common, self._wrench(), self.moving.twist, self._state_of_motion)

    @property
    def _state_of_motion(self) -> SlipState:
        return self._slipping(self.moving.twist, EVERY, None)

    @cached_property
    def bare(self) -> Array:
        """Multipliers without friction."""
        return without_friction(self.contacts, self.r)

    @cached_property
    def bare_balance(self) -> Equilibrium:
        """Equilibrium without friction."""
        return self._check(self.bare, self.stated.w)

    def _check(self, x: Array, w: Array) -> Equilibrium:
        c, arguments = self.c.layout, (self.forcing, self.known, self.pose, self.moving, self.stated)
        return check_equilibrium(c, *arguments, x, w)

    def solution(
        self, r: ContactResponse, side: SlipState | None = None, where: Index = EVERY
    ) -> tuple[FrictionSolution, SpinningRods | None]:
        """Friction from the response at some positions, on one ``side`` of them; with rods that spin the branch is
        followed with them where it ends or leaves a moment."""
        contacts = self.contacts
        state, rods = self._state(r, side, where)
        solved = solve_friction(contacts, r, state)
        if rods is None:
            return solved, None
        left = np.abs(solved.x[..., rods.row]).max(axis=-1) > SAME * np.abs(solved.x).max(axis=-1)
        some = np.flatnonzero(~state.open.any(axis=-1) & (np.isfinite(solved.critical) | left))
        if some.size:
            here = at(repeat(r, len(state.open)), some)
            branch = follow_branch_with_spin(contacts, here, state.open[some], rods.at(some))
            on = branch.critical != 0
            solved = put(solved, some[on], at(branch, on))
        return solved, rods

    def _state(
        self, r: ContactResponse, side: SlipState | None, where: Index
    ) -> tuple[SlipState, SpinningRods | None]:
        """Senses of the contacts; rods between balls spin as the balls' friction lets them."""
        layout, contacts, pose = self.c.layout, self.contacts, self.pose.at(where)
        along, twist = self.along.at(where), self.moving.twist[where]

        def state(twist: Array) -> SlipState:
            return self._slipping(twist, where, side)

        rods = spinning_rods(layout, pose, along, twist, state) if self.c.passive else None
        if rods is None:
            return state(twist), None

        def moment(phi: Array) -> Array:
            return np.nan_to_num(solve_friction(contacts, r, rods.senses(phi)).x[..., rods.row])

        return rods.senses(solve_spins(rods.rate.shape, moment)), rods

    def _slipping(self, twist: Array, where: Index, side: SlipState | None) -> SlipState:
        """Senses of the contacts at some positions, from twists and from what is given of them."""
        spins, slip = (
            self.c.schedule.parts,
            senses(self.c.layout, self.contacts, self.along.at(where), twist),
        )
        if spins is not None:
            known = slip.open & np.isfinite(spins[self.part][where])
            sense = np.where(known, spins[self.part][where], slip.sense)
            slip = slip._replace(sense=sense, open=slip.open & ~known)
        if side is None:
            return slip
        sense = np.where(side.open, slip.sense, side.sense)
        return slip._replace(sense=sense, open=slip.open & side.open)

    def with_self_locking(
        self, solution: FrictionSolution, side: SlipState | None = None
    ) -> FrictionSolution:
        """The solution, with where friction turns the power of the unknowns round, also without inertia."""
        locked = self._power_reversed(self.stated, self.bare, solution)
        if "inertia" in self.sources and locked.any():
            still, rate = self.statement("inertia"), rates(self.along, self.moving.twist)
            r = under(self.c.layout, self.contacts, self.pose, still.forces, still.w, rate, self.r)
            bare = without_friction(self.contacts, r)
            locked = locked & self._power_reversed(still, bare, self.solution(r, side)[0])
        return solution._replace(locked=locked & ~self.unpowered)

    def _power_reversed(self, stated: Statement, bare: Array, solution: FrictionSolution) -> Flags:
        twist = self.moving.twist
        return np.asarray(power_reversed(self.c.layout, stated.unknown, twist, stated.w, solution.x, bare))

    def forces(self, solution: FrictionSolution, reversing: Flags | None = None) -> SolvedForces:
        """Reactions, efforts and what friction does, of one solution."""
        layout, cz = self.c.layout, solution.c * solution.z
        balance = self._check(solution.x, self.stated.w + total_wrench(layout, pair(self.along, cz)))
        balance = balance._replace(free=self.free, rcond=self._rcond(balance.rcond))
        force, couple = reactions(layout, self.pose, self.rows, balance)
        known_by = uniqueness(self.c, self.pose, self.rows, balance.free)
        friction = self._friction(solution, cz, reversing)
        force = force + friction.force + friction.viscous_force
        moment = couple.reshape(friction.moment.shape) + friction.moment + friction.viscous_moment
        return forces_of(balance, force, moment, known_by, friction)

    def _rcond(self, rcond: Array) -> Array:
        """Reciprocal condition at each position; of loads that friction settles how much of an effort they change."""
        loads = self.through_friction
        if loads is None:
            return rcond
        return np.where(self.unpowered & (loads.solved | loads.jammed), loads.rcond, rcond)

    def _friction(self, solution: FrictionSolution, cz: Array, reversing: Flags | None) -> Friction:
        layout, contacts, state = self.c.layout, self.contacts, solution.state
        arrays = friction_arrays(
            layout, contacts, self.pose, self.moving.twist, self.along, self.r, state, cz
        )
        gaps = by_joint(contacts.joint, layout.joints, 0.0 * arrays["cz"])[..., None]  # NaN without a number
        arrays["force"] = arrays["force"] + gaps
        arrays["moment"] = (arrays["moment"].reshape((*gaps.shape[:-1], -1)) + gaps).reshape(
            arrays["moment"].shape
        )
        return Friction(
            **arrays,
            determinant=solution.determinant,
            critical=solution.critical,
            single=solution.single & ~self.unpowered,
            open=state.open,
            reversing=np.zeros_like(state.open) if reversing is None else reversing,
            blocked=self.blocked,
            locked=solution.locked,
            bare_effort=self._without(self.bare_balance.effort),
            bare_load=self._without(self.bare_balance.load),
            holding=np.full((len(cz), len(self.unknowns), 2), np.nan),
        )

    def _without(self, bare: Array) -> Array:
        """Unknowns without friction; none where friction alone settles them."""
        return np.where(self.unpowered[:, None], np.nan, bare)

    @property
    def unknowns(self) -> range:
        """Multipliers of the unknown efforts and loads."""
        return range(self.c.layout.constraints.count, self.bare.shape[-1])
