"""Equilibrium with friction at a block of positions: senses, the friction forces, what they cost, the ends at rest."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from dalembert.analysis.result.force_arrays import Forces, Friction
from dalembert.analysis.result.reaction_axes import marks
from dalembert.arrays import Array, Flags, Ints
from dalembert.core.constraints import rates
from dalembert.core.equilibrium import (
    UNIQUE,
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
    Senses,
    argument,
    bearing,
    multiplier,
    response,
    senses,
    strength,
    under,
)
from dalembert.core.friction.friction_solver import Slip, slipping, without_friction
from dalembert.core.friction.holding_range import holding
from dalembert.core.friction.impending_motion import extreme
from dalembert.core.friction.losses import by_joint, in_joints, power_reversed, viscous
from dalembert.core.friction.reversal import Driven, Sides, sides
from dalembert.core.friction.rod_spin import Spins, follow_branch_with_spin, rods, solve_spins, with_spin
from dalembert.core.layout import Pose, System
from dalembert.core.linear import Factor, PseudoInverse

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled


SAME = 1e-11
"""A contact that carries less than this part of the largest force carries nothing."""


class Setting(NamedTuple):
    """A block of positions before its friction is known, what loads it by kind, what drives it, and where it moves."""

    c: Compiled
    contacts: Contacts
    forcing: Forcing
    known: Known
    pose: Pose
    moving: Motion
    rows: System
    solver: Factor
    sources: dict[str, Source]
    driven: Driven
    moves: Flags


def rubbing(s: Setting, w: Array) -> Forces:
    """Forces with friction under the loads w (P, L, n)."""
    layout, contacts = s.c.layout, s.contacts
    stated = statement(layout, s.known, s.pose, s.rows, s.solver, w)
    along, r = response(layout, contacts, s.pose, stated.forces, stated.w, s.moving.twist)
    blocked = _undetermined(contacts, stated)
    r = r._replace(y=np.where(blocked[:, None, None], np.nan, r.y))
    r = Response(*(a if len(a) == len(w) else np.repeat(a, len(w), axis=0) for a in r))
    told, spins, slip = _solve_slip(s, along, r)
    made = _Made(s, stated, along, r, blocked, without_friction(contacts, r))
    open_ = told.open.any(axis=-1)
    slip.x[open_], slip.z[open_], slip.critical[open_] = np.nan, np.nan, np.nan
    found = Solved(slip, told, made.find_self_locking(slip))
    return made.forces(found) if not open_.any() else _open(made, found, np.flatnonzero(open_), spins)


def _solve_slip(
    s: Setting, along: System, r: Response, side: Side | None = None
) -> tuple[Senses, Spins | None, Slip]:
    """Senses and friction; with rods that spin the branch is followed with them where it ends or leaves a moment."""
    contacts = s.contacts
    told, spins = _contact_senses(s, along, r, side)
    slip = slipping(contacts, r, told.sense, told.open)
    if spins is None:
        return told, None, slip
    left = np.abs(slip.x[..., spins.rods.row]).max(axis=-1) > SAME * np.abs(slip.x).max(axis=-1)
    some = np.flatnonzero(~told.open.any(axis=-1) & (np.isfinite(slip.critical) | left))
    if not some.size:
        return told, spins, slip
    here = Response(*(np.broadcast_to(a, (len(told.sense), *a.shape[1:]))[some] for a in r))
    found = follow_branch_with_spin(contacts, here, told.open[some], spins.at(some))
    new, on = found.scale > 0, some[found.scale > 0]
    told = Senses(
        *(_scatter_field(a, on, b[new]) for a, b in zip(told, spins.at(some).told(found.phi), strict=True))
    )
    z = np.where(found.scale < 1, np.nan, found.z.T).T[new]
    c = strength(contacts, 1.0, told.open[on], told.sense[on])
    slip = slip._replace(
        z=_scatter_field(slip.z, on, z),
        c=_scatter_field(slip.c, on, c),
        x=_scatter_field(slip.x, on, multiplier(Response(*(a[new] for a in here)), c * z)),
        determinant=_scatter_field(slip.determinant, on, found.determinant[new]),
        critical=_scatter_field(slip.critical, on, np.where(found.scale < 1, found.scale, np.nan)[new]),
        single=_scatter_field(slip.single, on, False),
    )
    return told, spins, slip


class Side(NamedTuple):
    """One side of the positions: the senses (P, E) there of contacts whose rates do not tell, and which those are."""

    sense: Array
    known: Flags

    def of(self, told: Senses) -> Senses:
        """The senses that rates tell, and these where they do not."""
        sense = np.where(self.known, self.sense, told.sense)
        return Senses(sense, told.open & ~self.known, told.rate)


def _contact_senses(s: Setting, along: System, r: Response, side: Side | None) -> tuple[Senses, Spins | None]:
    """Senses of the contacts; rods between balls spin as the balls' friction lets them."""
    layout, contacts = s.c.layout, s.contacts

    def senses_of(twist: Array) -> Senses:
        told = senses(layout, contacts, along, twist)
        return told if side is None else side.of(told)

    told = senses_of(s.moving.twist)
    found = rods(layout, contacts, s.pose, along, told.rate) if s.c.passive else None
    if found is None:
        return told, None

    def senses_at(phi: Array) -> Senses:
        return senses_of(with_spin(s.moving.twist, found, phi))

    def moment(phi: Array) -> Array:
        now = senses_at(phi)
        return np.nan_to_num(slipping(contacts, r, now.sense, now.open).x[..., found.row])

    return senses_at(solve_spins(found.rate.shape, moment)), Spins(found, senses_at)


def _undetermined(contacts: Contacts, stated: Statement) -> Flags:
    """Positions where a reaction that friction follows is not unique."""
    count = stated.w.shape[0]
    if not isinstance(stated.forces, PseudoInverse):
        return np.zeros(count, bool)
    if contacts.read is not None:
        read = np.flatnonzero(np.abs(contacts.read).max(axis=(0, 1), initial=0.0))
    else:
        read = np.concatenate([contacts.first, contacts.second, contacts.couple])
        read = np.unique(read[read >= 0])
    return np.asarray(np.abs(stated.forces.null[..., read, :]).max(axis=(-2, -1), initial=0.0) > UNIQUE)


def _open(made: _Made, found: Solved, open_: Ints, spins: Spins | None) -> Forces:
    """Both sides of the positions where the machine moves and contacts only reverse; both ends of every unknown where
    contacts stay at rest."""
    told = found.told
    at_side = _sides(made, told, open_, spins)
    rest = told.open[open_] & ~at_side.known
    turns: Flags = np.asarray(at_side.known.any(axis=-1))
    both = _both_sides(made, found, open_[turns], at_side.at(turns), rest[turns])
    if rest[turns].any():
        loaded = np.zeros_like(told.open)
        loaded[open_[turns]] = rest[turns]
        idle = [_idle(made.s.contacts, made.r, side.slip, loaded)[open_[turns]] for side in both]
        turns[turns] = np.all(idle, axis=0)
        both = _both_sides(made, found, open_[turns], at_side.at(turns), rest[turns])
    turn, stay = open_[turns], open_[~turns]
    reversing = None
    if turn.size:
        before, behind = both
        found = before
        known = _scatter_field(np.zeros_like(told.open), turn, at_side.known[turns])
        same = _idle(made.s.contacts, made.r, before.slip, known)[:, None]
        reversing = known & (before.told.sense != behind.told.sense) & ~same
    whole = _with_ends(made, found, stay, spins, reversing) if stay.size else made.forces(found, reversing)
    if reversing is None or not reversing.any():
        return whole
    return whole._replace(after=_scatter_forces(whole, turn, made.forces(behind, reversing)))


def _scatter_forces(whole: Forces, where: Ints, part: Forces) -> Forces:
    """Forces and friction of another solution at some positions; elsewhere they stay, found at rest or not."""
    assert whole.friction is not None
    assert part.friction is not None
    pairs = zip((*whole[:7], *whole.friction), (*part[:7], *part.friction), strict=True)
    made: Any = [_scatter_field(a, where, b[where]) for a, b in pairs]
    return Forces._make([*made[:7], *part[7:9], Friction(*made[7:]), (), part.unique_in, None])


def _both_sides(made: _Made, found: Solved, turn: Ints, at_side: Sides, rest: Flags) -> list[Solved]:
    """Friction just before and just after some positions; contacts that stay at ``rest`` there carry nothing."""
    if not turn.size:
        return []
    told, known = found.told, np.zeros_like(found.told.open)
    known[turn] = at_side.known | rest
    senses_ = (np.where(rest, 0.0, sense) for sense in (at_side.before, at_side.after))
    sides_ = (Side(_scatter_field(told.sense, turn, sense), known) for sense in senses_)
    return [made.on_side(found.slip, told, turn, side) for side in sides_]


def _sides(made: _Made, told: Senses, open_: Ints, spins: Spins | None) -> Sides:
    """Senses of the open contacts before and after; none is known where the machine does not move."""
    s = made.s
    moving = Motion(*(a[open_] for a in s.moving))
    driven = Driven(*(a[open_] for a in s.driven))
    known = Senses(*(a[open_] for a in told))
    spun_: Flags = np.zeros(s.contacts.count, bool)
    if spins is not None:
        spun_ = np.asarray(spins.rods.touched.any(axis=0))
    here = _at(made.along, open_), s.pose.at(open_), moving, driven
    found = sides(s.c.layout, s.contacts, *here, known, spun_)
    return found._replace(known=found.known & s.moves[open_][:, None])


def _at(along: System, where: Ints) -> System:
    """The rows at some positions."""
    return along._replace(on_i=along.on_i[where], on_j=along.on_j[where])


def _with_ends(
    made: _Made, found: Solved, open_: Ints, spins: Spins | None, reversing: Flags | None
) -> Forces:
    """Both ends of every unknown at the open positions; where all are one, the number itself."""
    s, contacts = made.s, made.s.contacts
    unknowns = range(s.c.layout.constraints.count, made.r.x.shape[-1])
    part = Response(*(a[open_] for a in made.r))
    known = Senses(*(a[open_] for a in found.told))
    ends = [
        extreme(s.c.layout, contacts, part, known, unknown, end, spins and spins.at(open_))
        for unknown in unknowns
        for end in (-1.0, 1.0)
    ]
    if not ends:
        return made.forces(found, reversing)
    one = _idle(contacts, part, ends[0].slip, known.open)
    told = found.told._replace(
        open=_scatter_field(found.told.open, open_[one], np.zeros_like(known.open[one]))
    )
    main = Solved(_scatter(found.slip, open_[one], ends[0].slip, one), told, found.locked)
    whole = [
        made.forces(
            Solved(
                _scatter(found.slip, open_, end.slip, slice(None)),
                told._replace(sense=_scatter_field(told.sense, open_, end.sense)),
                found.locked,
            ),
            reversing,
        )
        for end in ends
    ]
    solved = made.forces(main, reversing)
    assert solved.friction is not None
    if spins is None:
        values = np.stack(
            [end.slip.x[:, k] for end, k in zip(ends, np.repeat(unknowns, 2), strict=True)], axis=-1
        )
        solved.friction.holding[open_] = holding(contacts, part, known, values.reshape((len(values), -1, 2)))
    return solved._replace(ends=tuple(whole))


def _idle(contacts: Contacts, r: Response, slip: Slip, open_: Flags) -> Flags:
    """Where contacts of unknown sense carry nothing, so that it does not matter."""
    y = argument(r, slip.c * np.nan_to_num(slip.z))
    carried = np.where(open_ & (slip.c != 0), np.abs(bearing(contacts, y)), 0.0).max(axis=-1, initial=0.0)
    return np.asarray(carried <= SAME * np.abs(y).max(axis=(-2, -1), initial=0.0))


def _scatter(whole: Slip, where: Ints, part: Slip, which: Any) -> Slip:
    return Slip(*(_scatter_field(a, where, b[which]) for a, b in zip(whole, part, strict=True)))


def _scatter_field(whole: Array, where: Ints, part: Any) -> Array:
    """A copy with other values at some positions."""
    out = np.array(whole)
    out[where] = part
    return out


class Solved(NamedTuple):
    """Friction under some senses of the contacts; ``locked`` (P,) as in ``Friction``."""

    slip: Slip
    told: Senses
    locked: Flags


class _Made(NamedTuple):
    """What does not depend on the senses taken."""

    s: Setting
    stated: Statement
    along: System
    r: Response
    blocked: Flags
    bare: Array

    def on_side(self, slip: Slip, told: Senses, turn: Ints, side: Side) -> Solved:
        """Friction with the senses of a side at the positions ``turn``, as it is elsewhere."""
        s = self.s
        here = s._replace(pose=s.pose.at(turn), moving=Motion(*(a[turn] for a in s.moving)))
        r, own = Response(*(a[turn] for a in self.r)), Side(*(a[turn] for a in side))
        found, _, part = _solve_slip(here, _at(self.along, turn), r, own)
        slip = _scatter(slip, turn, part, slice(None))
        told = Senses(*(_scatter_field(a, turn, b) for a, b in zip(told, found, strict=True)))
        return Solved(slip, told, self.find_self_locking(slip, side))

    def find_self_locking(self, slip: Slip, side: Side | None = None) -> Flags:
        """Where friction turns the power of the unknowns round, also without inertia."""
        s = self.s
        locked = self._power_reversed(self.stated, self.r, slip)
        if "inertia" not in s.sources or not locked.any():
            return locked
        w = total_wrench(s.c.layout, *(source for kind, source in s.sources.items() if kind != "inertia"))
        w = np.broadcast_to(w, self.stated.w.shape)
        still = statement(s.c.layout, s.known, s.pose, s.rows, s.solver, w)
        rate = rates(self.along, s.moving.twist)
        r = under(s.c.layout, s.contacts, s.pose, still.forces, still.w, rate, self.r)
        return locked & self._power_reversed(still, r, _solve_slip(s, self.along, r, side)[2])

    def _power_reversed(self, stated: Statement, r: Response, slip: Slip) -> Flags:
        s, bare = self.s, without_friction(self.s.contacts, r)
        return np.asarray(power_reversed(s.c.layout, stated.unknown, s.moving.twist, stated.w, slip.x, bare))

    def forces(self, found: Solved, reversing: Flags | None = None) -> Forces:
        """Reactions, efforts and what friction does, of one solution."""
        s, layout, slip = self.s, self.s.c.layout, found.slip
        cz = slip.c * slip.z
        total = self.stated.w + total_wrench(layout, pair(self.along, cz))
        whole = check_equilibrium(layout, s.forcing, s.known, s.pose, s.moving, self.stated, slip.x, total)
        force, couple = reactions(layout, s.pose, s.rows, whole)
        friction = self._friction(found, cz, reversing)
        known_by = marks(s.c, s.pose, s.rows, whole.free)
        force = force + friction.force + friction.viscous_force
        moment = couple.reshape(friction.moment.shape) + friction.moment + friction.viscous_moment
        checks = (whole.residual, whole.power_balance, whole.rcond)
        return Forces(
            force,
            moment,
            whole.effort,
            whole.load,
            *checks,
            *known_by[:2],
            friction,
            unique_in=known_by.inside,
        )

    def _friction(self, found: Solved, cz: Array, reversing: Flags | None) -> Friction:
        s, contacts, slip, told = self.s, self.s.contacts, found.slip, found.told
        bare = check_equilibrium(
            s.c.layout, s.forcing, s.known, s.pose, s.moving, self.stated, self.bare, self.stated.w
        )
        dry = np.where(contacts.fixed, 0.0, cz)
        joints, link = s.c.layout.joints, s.c.second
        force, moment = in_joints(s.c.layout, s.pose, self.along, contacts.joint, link, s.c.joint_at, dry)
        own = viscous(s.c.layout, s.c.damping, s.pose, s.moving.twist, link, s.c.joint_at)
        return Friction(
            force,
            moment,
            *own[:2],
            by_joint(contacts.joint, joints, -dry * told.rate),
            own[2],
            dry,
            told.sense,
            told.rate,
            argument(self.r, cz),
            *(slip.determinant, slip.critical, slip.iterations, slip.single),
            told.open,
            np.zeros_like(told.open) if reversing is None else reversing,
            self.blocked,
            found.locked,
            bare.effort,
            bare.load,
            np.full((len(cz), slip.x.shape[-1] - s.c.layout.constraints.count, 2), np.nan),
        )


def block_size(c: Compiled, most: int) -> int:
    """Positions at once, so that the matrices H of all stay below a few hundred MB."""
    if c.contacts is None:
        return most
    return max(1, min(most, 10**7 // (c.contacts.count**2 * 3 + 1)))
