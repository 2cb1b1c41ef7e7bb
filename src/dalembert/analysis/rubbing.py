"""Equilibrium with friction at a block of positions: senses, the friction forces, what they cost, the ends at rest."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dalembert.analysis.wrenches import marks
from dalembert.core.constraints import rates
from dalembert.core.equilibrium import (
    UNIQUE,
    Known,
    Motion,
    Statement,
    checked,
    reactions,
    statement,
)
from dalembert.core.forcing import Forcing, Source, pair, summed
from dalembert.core.friction import (
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
from dalembert.core.holding import holding
from dalembert.core.layout import Pose, System
from dalembert.core.linear import Factor, PseudoInverse
from dalembert.core.losses import by_joint, in_joints, turned, viscous
from dalembert.core.rest import extreme
from dalembert.core.slip import Slip, slipping, without_friction
from dalembert.core.spinning import Spins, raised, rods, settled, spun

if TYPE_CHECKING:
    from dalembert.analysis.compile import Compiled

Array = NDArray[Any]
Flags = NDArray[np.bool_]

SAME = 1e-11
"""A contact that carries less than this part of the largest force carries nothing."""


class Friction(NamedTuple):
    """What friction does at each position.

    force (P, joints, 2), moment (P, joints): dry friction on j, moment about j's point; viscous beside it
    dry_loss, viscous_loss (P, joints): power
    cz, sense, rate (P, E), argument (P, 3, E) of each contact
    determinant, critical, iterations, single (P,): of the solution (core.slip)
    open (P, E): contacts whose sense no rate tells; blocked (P,): their reactions are not unique
    locked (P,): the unknowns' power has the other sign than without friction, with and without inertia
    bare_effort (P, D), bare_load (P, U): without friction
    holding (P, unknowns, 2): low and high that friction can hold at rest for some history (core.holding)
    """

    force: Array
    moment: Array
    viscous_force: Array
    viscous_moment: Array
    dry_loss: Array
    viscous_loss: Array
    cz: Array
    sense: Array
    rate: Array
    argument: Array
    determinant: Array
    critical: Array
    iterations: NDArray[np.intp]
    single: Flags
    open: Flags
    blocked: Flags
    locked: Flags
    bare_effort: Array
    bare_load: Array
    holding: Array

    def known(self, position: int) -> bool:
        """Whether every contact has its numbers at a position."""
        return bool(np.isfinite(self.cz[position]).all())


class Forces(NamedTuple):
    """Forces of some positions; ``ends``: the low and high end of each unknown where friction leaves it open."""

    force: Array
    moment: Array
    effort: Array
    load: Array
    residual: Array
    power_balance: Array
    rcond: Array
    unique: Array | None
    unique_unknowns: Array | None
    friction: Friction | None = None
    ends: tuple[Forces, ...] = ()
    unique_in: Array | None = None


class Setting(NamedTuple):
    """A block of positions before its friction is known, and what loads it by kind."""

    c: Compiled
    contacts: Contacts
    forcing: Forcing
    known: Known
    pose: Pose
    moving: Motion
    rows: System
    solver: Factor
    sources: dict[str, Source]


def rubbing(s: Setting, w: Array) -> Forces:
    """Forces with friction under the loads w (P, L, n)."""
    layout, contacts = s.c.layout, s.contacts
    stated = statement(layout, s.known, s.pose, s.rows, s.solver, w)
    along, r = response(layout, contacts, s.pose, stated.forces, stated.w, s.moving.twist)
    blocked = _blocked(contacts, stated)
    r = r._replace(y=np.where(blocked[:, None, None], np.nan, r.y))
    told, spins, slip = _slipped(s, along, r)
    open_ = np.flatnonzero(told.open.any(axis=-1))
    if open_.size:
        slip.x[open_], slip.z[open_], slip.critical[open_] = np.nan, np.nan, np.nan
    locked = _locked(s, stated, along, r, slip)
    made = _Made(s, stated, along, told, blocked, locked, without_friction(contacts, r))
    if not open_.size:
        return made.forces(r, slip, told.sense)
    return _with_ends(made, r, slip, told, open_, spins)


def _slipped(s: Setting, along: System, r: Response) -> tuple[Senses, Spins | None, Slip]:
    """Senses and friction; with rods that spin the branch is followed with them where it ends or leaves a moment."""
    contacts = s.contacts
    told, spins = _told(s, along, r)
    slip = slipping(contacts, r, told.sense, told.open)
    if spins is None:
        return told, None, slip
    left = np.abs(slip.x[..., spins.rods.row]).max(axis=-1) > SAME * np.abs(slip.x).max(axis=-1)
    some = np.flatnonzero(~told.open.any(axis=-1) & (np.isfinite(slip.critical) | left))
    if not some.size:
        return told, spins, slip
    here = Response(*(np.broadcast_to(a, (len(told.sense), *a.shape[1:]))[some] for a in r))
    found = raised(contacts, here, told.open[some], spins.at(some))
    new, on = found.scale > 0, some[found.scale > 0]
    told = Senses(*(_with(a, on, b[new]) for a, b in zip(told, spins.at(some).told(found.phi), strict=True)))
    z = np.where(found.scale < 1, np.nan, found.z.T).T[new]
    c = strength(contacts, 1.0, told.open[on], told.sense[on])
    slip = slip._replace(
        z=_with(slip.z, on, z),
        c=_with(slip.c, on, c),
        x=_with(slip.x, on, multiplier(Response(*(a[new] for a in here)), c * z)),
        determinant=_with(slip.determinant, on, found.determinant[new]),
        critical=_with(slip.critical, on, np.where(found.scale < 1, found.scale, np.nan)[new]),
        single=_with(slip.single, on, False),
    )
    return told, spins, slip


def _with(whole: Array, on: NDArray[np.intp], part: Any) -> Array:
    """A copy with other values at some positions."""
    out = np.array(whole)
    out[on] = part
    return out


def _told(s: Setting, along: System, r: Response) -> tuple[Senses, Spins | None]:
    """Senses of the contacts; rods between balls spin as the balls' friction lets them."""
    layout, contacts = s.c.layout, s.contacts
    told = senses(layout, contacts, along, s.moving.twist)
    found = rods(layout, contacts, s.pose, along, told.rate) if s.c.passive else None
    if found is None:
        return told, None

    def told_at(phi: Array) -> Senses:
        return senses(layout, contacts, along, spun(s.moving.twist, found, phi))

    def moment(phi: Array) -> Array:
        now = told_at(phi)
        return np.nan_to_num(slipping(contacts, r, now.sense, now.open).x[..., found.row])

    return told_at(settled(found.rate.shape, moment)), Spins(found, told_at)


def _blocked(contacts: Contacts, stated: Statement) -> Flags:
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


def _locked(s: Setting, stated: Statement, along: System, r: Response, slip: Slip) -> Flags:
    """Where friction turns the power of the unknowns round, also without inertia."""
    locked = _turned(s, stated, r, slip)
    if "inertia" not in s.sources or not locked.any():
        return locked
    w = summed(s.c.layout, *(source for kind, source in s.sources.items() if kind != "inertia"))
    w = np.broadcast_to(w, stated.w.shape)
    still = statement(s.c.layout, s.known, s.pose, s.rows, s.solver, w)
    rate = rates(along, s.moving.twist)
    r = under(s.c.layout, s.contacts, s.pose, still.forces, still.w, rate, r)
    return locked & _turned(s, still, r, _slipped(s, along, r)[2])


def _turned(s: Setting, stated: Statement, r: Response, slip: Slip) -> Flags:
    bare = without_friction(s.contacts, r)
    return np.asarray(turned(s.c.layout, stated.unknown, s.moving.twist, stated.w, slip.x, bare))


def _with_ends(
    made: _Made, r: Response, slip: Slip, told: Senses, open_: NDArray[np.intp], spins: Spins | None
) -> Forces:
    """Both ends of every unknown at the open positions; where all are one, the number itself."""
    s, contacts = made.s, made.s.contacts
    unknowns = range(s.c.layout.constraints.count, r.x.shape[-1])
    part = Response(*(a[open_] for a in r))
    known = Senses(*(a[open_] for a in told))
    ends = [
        extreme(s.c.layout, contacts, part, known, unknown, end, spins and spins.at(open_))
        for unknown in unknowns
        for end in (-1.0, 1.0)
    ]
    if not ends:
        return made.forces(r, slip, told.sense)
    one = _idle(contacts, part, ends[0].slip, known)
    made.told.open[open_[one]] = False
    main = _put(slip, open_[one], ends[0].slip, one)
    whole = [
        made.forces(r, _put(slip, open_, end.slip, slice(None)), _filled(told.sense, open_, end.sense))
        for end in ends
    ]
    found = made.forces(r, main, told.sense)
    assert found.friction is not None
    if spins is None:
        values = np.stack(
            [end.slip.x[:, k] for end, k in zip(ends, np.repeat(unknowns, 2), strict=True)], axis=-1
        )
        found.friction.holding[open_] = holding(contacts, part, known, values.reshape((len(values), -1, 2)))
    return found._replace(ends=tuple(whole))


def _idle(contacts: Contacts, r: Response, slip: Slip, known: Senses) -> Flags:
    """Where the contacts of unknown sense carry nothing, so that it does not matter."""
    y = argument(r, slip.c * np.nan_to_num(slip.z))
    carried = np.where(known.open, np.abs(bearing(contacts, y)), 0.0).max(axis=-1, initial=0.0)
    return np.asarray(carried <= SAME * np.abs(y).max(axis=(-2, -1), initial=0.0))


def _put(whole: Slip, where: NDArray[np.intp], part: Slip, which: Any) -> Slip:
    return Slip(*(_filled(a, where, b[which]) for a, b in zip(whole, part, strict=True)))


def _filled(whole: Array, where: NDArray[np.intp], part: Array) -> Array:
    out = np.array(whole)
    out[where] = part
    return out


class _Made(NamedTuple):
    """What does not depend on the senses taken."""

    s: Setting
    stated: Statement
    along: System
    told: Senses
    blocked: Flags
    locked: Flags
    bare: Array

    def forces(self, r: Response, slip: Slip, sense: Array) -> Forces:
        """Reactions, efforts and what friction does, of one solution."""
        s, layout = self.s, self.s.c.layout
        cz = slip.c * slip.z
        total = self.stated.w + summed(layout, pair(self.along, cz))
        found = checked(layout, s.forcing, s.known, s.pose, s.moving, self.stated, slip.x, total)
        bare = checked(layout, s.forcing, s.known, s.pose, s.moving, self.stated, self.bare, self.stated.w)
        force, couple = reactions(layout, s.pose, s.rows, found)
        friction = self._friction(r, slip, sense, cz, bare.effort, bare.load)
        known_by = marks(s.c, s.pose, s.rows, found.free)
        force = force + friction.force + friction.viscous_force
        moment = couple.reshape(friction.moment.shape) + friction.moment + friction.viscous_moment
        checks = (found.residual, found.power_balance, found.rcond)
        return Forces(
            force,
            moment,
            found.effort,
            found.load,
            *checks,
            *known_by[:2],
            friction,
            unique_in=known_by.inside,
        )

    def _friction(
        self, r: Response, slip: Slip, sense: Array, cz: Array, effort: Array, load: Array
    ) -> Friction:
        s, contacts, told = self.s, self.s.contacts, self.told
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
            sense,
            told.rate,
            argument(r, cz),
            *(slip.determinant, slip.critical, slip.iterations, slip.single),
            told.open,
            self.blocked,
            self.locked,
            effort,
            load,
            np.full((len(cz), slip.x.shape[-1] - s.c.layout.constraints.count, 2), np.nan),
        )


def joined(parts: list[Forces]) -> Forces:
    """Blocks of positions one after the other."""
    if len(parts) == 1:
        return parts[0]
    count = max(len(p.ends) for p in parts)
    ends = tuple(joined([p.ends[k] if p.ends else p for p in parts]) for k in range(count))
    friction = [p.friction for p in parts if p.friction is not None]
    whole = Friction(*(np.concatenate(a) for a in zip(*friction, strict=True))) if friction else None
    arrays = (None if a[0] is None else np.concatenate(a) for a in zip(*(p[:9] for p in parts), strict=True))
    inside = [p.unique_in for p in parts if p.unique_in is not None]
    made: Any = Forces._make([*arrays, whole, ends, np.concatenate(inside) if inside else None])
    return made  # type: ignore[no-any-return]


def block_size(c: Compiled, most: int) -> int:
    """Positions at once, so that the matrices H of all stay below a few hundred MB."""
    if c.contacts is None:
        return most
    return max(1, min(most, 10**7 // (c.contacts.count**2 * 3 + 1)))


__all__ = ["Forces", "Friction", "Setting", "block_size", "joined", "rubbing"]
