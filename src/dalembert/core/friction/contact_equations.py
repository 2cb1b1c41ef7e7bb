"""Dry friction by Coulomb's law as one more load on the linear system of equilibrium: the equations of its contacts.

The friction of a contact is its strength (a coefficient, or the radius of a friction circle) times its bearing force,
against the slip. The bearing force is a piecewise smooth function of the reactions, which depend on friction in turn.
Elimination of everything else leaves one equation a contact, for semi-smooth Newton (Qi and Sun, 1993). Besides,
the separating force of gear teeth is such a contact, with a fixed sense. Mechanics: docs/theory.md 6 and 5.4.

A contact e acts along one row with c z, so that  A x + w + B c z = 0  and  z = -s S(y),  y = Y x.  With A factored
once, x = x0 - A^-1 B c z leaves a small system in z at every position, solved for all of them at once.

S   bearing force (..., E): of a pin |F|, of a guide max(|N|, |2M - (l2 - l1) N| / (l1 + l2))
s   sense (..., E): sign of the relative rate of j against i; between -1 and 1 where that is zero
c   strength (..., E): lever of a couple or coefficient of a force; it grows with the friction scale
y   arguments (..., 3, E): two forces at a right angle, and the tilting one of a guide
H   change of y with c z (..., 3, E, E): -Y A^-1 B
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.core import branchless
from dalembert.core.branchless import above, hypot, larger, root, top, unit, where
from dalembert.core.constraints import drift, measure, rates, system
from dalembert.core.elements.cam_rows import effort_sizes
from dalembert.core.elements.rope_bends import bend_factor
from dalembert.core.forcing import Resistances, WrenchSource, total_wrench
from dalembert.core.friction.capstan import capstan
from dalembert.core.layout import ConstraintRows, Layout, Pose, Rows
from dalembert.core.linear import Factor

STILL = 1e-9
"""A relative rate below this part of the fastest one of the machine counts as zero."""


NOTHING = 1e-14
"""A force below this fraction of the largest is rounding error; its direction is meaningless."""

TINY = 1e-150
"""Offset added to values that may be zero; its square is representable."""


@dataclass(frozen=True)
class Contacts:
    """The E contacts of a planar or spatial mechanism.

    rows        freedom that each acts along: a turn, a slide, the line of centres of two wheels
    kind (E,)   pin, guide, faces, mesh, separation, collar, ball, thread, sleeve
    joint (E,)  the joint it belongs to
    read (3, E, K)  Y: its arguments of the constraints' multipliers
    lever (E,)  strength at a coefficient of one; radius of a pin
    coefficient, resting (E,)  of friction in motion and at rest
    circle (E,) strength lever sin(atan(mu)), else lever mu
    signed (E,) S is the first force with its sign: the couple of the two faces of a guide
    ball (E,)   its three arguments are the components of one force
    fixed (E,)  not friction: strength is the lever whatever the scale, sense -1
    led (E,)    contact whose rate gives its sense: itself, or the slide to which a couple of faces belongs
    reach (E,)  where positive: its first force holds at this distance of the centres and falls as it grows
    group (E,)  contacts with the same number share a slip vector; each takes its component of it, with ``reckoned``
                (E,), the length that turns its rate into a speed
    around (E,) true in a group that slips along and around an axis, with friction circles of R sin(phi)
    wound (E,)  a band, rope or belt round a drum by the angle ``wrap`` (E,), with ``blocks`` (E,) on it, 0 of a
                continuous lining: S is the mean of its two tensions, and its friction their difference
    bends (E, 2), way (E,)  of a rope round a wheel by exact tangents: its strands before and behind, by their places
                in their family, and 1 where it turns counter-clockwise; -1 of a wrap that is given. ``wrap`` is then
                a reference, by whose strength S is divided
    given (E,)  force that presses it whatever the reactions, a part of its first argument
    carried (E,)  contact whose friction it also carries, as its second force: the slide of a block on a pin; -1 for
    none viscous (E,)  damping of that slide, whose force it carries with it
    own (E,)    part of its friction that is added to the first argument
    link, at (joints,), (joints, d)  link j of each joint of the mechanism, and the arm of the joint's point on it
    damping     viscous friction of the joints beside
    """

    rows: Rows
    kind: tuple[str, ...]
    joint: Ints
    read: Array
    lever: Array
    coefficient: Array
    resting: Array
    circle: Flags
    signed: Flags
    ball: Flags
    fixed: Flags
    leader: Ints
    reach: Array
    group: Ints
    reckoned: Array
    around: Flags
    wound: Flags
    wrap: Array
    blocks: Array
    bends: Ints
    way: Ints
    given: Array
    carried: Ints
    viscous: Array
    own: Array
    link: Ints
    at: Array
    damping: Resistances

    @property
    def count(self) -> int:
        """Number of contacts, E."""
        return len(self.joint)

    @cached_property
    def grouped(self) -> bool:
        """True if some contacts share a slip vector."""
        return len(np.unique(self.group)) < self.count


class SlipState(NamedTuple):
    """Sense of each contact, 0 where ``open`` (no relative rate determines it); rate (..., E) of each."""

    sense: Array
    open: Flags
    rate: Array


class ContactResponse(NamedTuple):
    """x without contacts (..., X), its change with c z (..., X, E), and the same of the arguments: y, H."""

    x: Array
    change: Array
    y: Array
    h: Array


def senses(layout: Layout, contacts: Contacts, along: ConstraintRows, twist: Array) -> SlipState:
    """Senses of the contacts from the twists of all links (..., L+1, n)."""
    rate = rates(along, twist)
    return _senses(contacts, rate, _below(layout, contacts, rate, STILL * fastest(layout, twist)))


def next_senses(
    layout: Layout, contacts: Contacts, along: ConstraintRows, pose: Pose, twist: Array, acceleration: Array
) -> SlipState:
    """Senses of the second rates: those just behind a place where the first are zero, and the opposite just before."""
    second = rates(along, acceleration) + drift(layout.algebra, contacts.rows, pose, twist)
    speed = fastest(layout, twist)
    size = larger(fastest(layout, acceleration), speed * speed * (1 / layout.length))
    return _senses(contacts, second, _below(layout, contacts, second, STILL * size))


def zero_crossings(layout: Layout, contacts: Contacts, twist: Array, rate: Array, second: Array) -> Flags:
    """Contacts (..., E) whose rate passes through zero at the position: within ``STILL`` of the time in which the
    fastest link moves by the characteristic length."""
    speed, size = fastest(layout, twist) / (STILL * layout.length), np.abs(second)
    if contacts.grouped:
        return ~above(speed * _slip(contacts, rate), _slip(contacts, second))
    return np.asarray((~above(speed * np.abs(rate), size) & ~contacts.fixed)[..., contacts.leader])


def fastest(layout: Layout, twist: Array) -> Array:
    """The largest component (..., 1) of twists, turns times the characteristic length."""
    return top(np.abs(twist / layout.wrench_scale), 2)[..., None]


def _below(layout: Layout, contacts: Contacts, rate: Array, least: Array) -> Flags:
    """Contacts (..., E) whose rate, or that of the one they are led by, is below a speed (..., 1)."""
    scaled = np.abs(rate) * np.where(contacts.rows.angular, layout.length, 1.0)
    return np.asarray((above(least + TINY, scaled) & ~contacts.fixed)[..., contacts.leader])


def _senses(contacts: Contacts, rate: Array, still: Flags) -> SlipState:
    """Senses of rates (..., E) of the contacts, some of which are ``still``."""
    holds = above(strength(contacts, 1.0, True), 0.0)
    if contacts.grouped:
        part, still = _along_slip(contacts, rate, still)
        return SlipState(part, still & holds, rate)
    sense = np.where(contacts.fixed, -1.0, where(still, 0.0, branchless.sign(rate)[..., contacts.leader]))
    return SlipState(sense, still & holds, rate)


def _along_slip(contacts: Contacts, rate: Array, still: Flags) -> tuple[Array, Flags]:
    """Component of each contact in the direction of its group's slip, and the groups that do not slip at all."""
    part = sign(contacts, rate * contacts.reckoned, still)
    return part, ~group_moves(contacts, ~still)


def _slip(contacts: Contacts, rate: Array) -> Array:
    """Speed (..., E) of the slip vector of each contact's group."""
    value = rate * contacts.reckoned
    return np.asarray(np.sqrt((value * value) @ _together(contacts)))


def sign(contacts: Contacts, value: Array, none: Flags) -> Array:
    """Sign of each value (..., E), 0 where ``none``; for a group of contacts its direction, a unit vector."""
    value = where(none, 0.0, value)
    if not contacts.grouped:
        return branchless.sign(value)
    size = root((value * value) @ _together(contacts))
    return np.asarray(value / where(above(size, 0.0), size, 1.0))


def group_moves(contacts: Contacts, moves: Flags) -> Flags:
    """True where a contact (..., E), or another of its group, moves."""
    if not contacts.grouped:
        return moves
    return above(moves @ _together(contacts), 0.0)


def _together(contacts: Contacts) -> Array:
    """1 where two contacts (E, E) are of one group."""
    return np.asarray((contacts.group[:, None] == contacts.group).astype(float))


def impending_senses(contacts: Contacts, g: Array, moves: Flags) -> Array:
    """Part of each contact (..., E) in the impending slip of rates -g."""
    if not contacts.grouped:
        return np.where(moves, -np.sign(g)[..., contacts.leader], 0.0)
    return _along_slip(contacts, -g, ~moves)[0]


def strength(
    contacts: Contacts, scale: Array | float, resting: Array | bool = False, sense: Array | None = None
) -> Array:
    """c (..., E) at a scale of all coefficients; ``resting`` contacts take the coefficient at rest.

    Where a group has friction circles of R sin(phi), its reaction includes the part s of the friction that goes around
    the axis, of the direction ``sense``: c is divided by sqrt(1 + (mu s)^2).
    """
    mu = scale * np.where(resting, contacts.resting, contacts.coefficient)
    friction = np.where(contacts.circle, mu / root(1 + mu * mu), mu)
    if contacts.wound.any():
        friction = np.where(contacts.wound, capstan(mu, contacts.wrap, contacts.blocks), friction)
    if sense is not None and contacts.around.any():
        turning = (mu * sense * (contacts.around & contacts.rows.angular)) ** 2 @ _together(contacts)
        friction = friction / root(1 + turning)
    return np.asarray(contacts.lever * np.where(contacts.fixed, 1.0, friction))


def response(
    layout: Layout, contacts: Contacts, pose: Pose, forces: Factor, w: Array, twist: Array
) -> tuple[ConstraintRows, ContactResponse]:
    """Rows that the contacts act along; x and y without contacts and per unit of each, from the factored A.

    twist (..., L+1, n) gives the viscous forces that some contacts carry.
    """
    along = system(layout.algebra, contacts.rows, pose)
    change = [_multipliers(forces, _unit(layout, along, e)) for e in range(contacts.count)]
    by_contact = np.stack(np.broadcast_arrays(*change), axis=-2)  # (..., E, X)
    rate = rates(along, twist)
    still = _below(layout, contacts, rate, STILL * fastest(layout, twist))
    near = _near(layout, contacts, pose, still)
    read = np.swapaxes(_read_arguments(contacts, by_contact, near[..., None, :]), -2, -3)
    h = np.swapaxes(np.ascontiguousarray(read), -1, -2)
    for e, slide in _carrying(contacts):
        h[..., 1, e, slide] += 1.0
    for k in np.flatnonzero(contacts.own):
        h[..., 0, k, k] += contacts.own[k]
    x = _multipliers(forces, w)
    y = _read(contacts, x, near, rates(along, twist))
    return along, ContactResponse(x, np.swapaxes(by_contact, -1, -2), y, h)


def under(
    layout: Layout,
    contacts: Contacts,
    pose: Pose,
    forces: Factor,
    w: Array,
    rate: Array,
    like: ContactResponse,
) -> ContactResponse:
    """The response under other wrenches w (..., L, n), at rates (..., E) of the contacts."""
    x = _multipliers(forces, w)
    near = _near(layout, contacts, pose, _below(layout, contacts, rate, np.zeros(1)))
    return like._replace(x=x, y=_read(contacts, x, near, rate))


def repeat(r: ContactResponse, count: int) -> ContactResponse:
    """A response common to all positions, repeated ``count`` times."""
    return ContactResponse(*(np.broadcast_to(a, (count, *a.shape[1:])) for a in r))


def _read(contacts: Contacts, x: Array, near: Array, rate: Array) -> Array:
    """y of multipliers x, with the viscous forces at rates (..., E) of the contacts."""
    y = _read_arguments(contacts, x, near)
    y[..., 0, :] = y[..., 0, :] + contacts.given
    for e, slide in _carrying(contacts):
        y[..., 1, e] = y[..., 1, e] - contacts.viscous[e] * rate[..., slide]
    return y


def _carrying(contacts: Contacts) -> list[tuple[int, int]]:
    """Contacts that carry the force of another one, with that one."""
    return [(e, int(slide)) for e, slide in enumerate(contacts.carried) if slide >= 0]


def _multipliers(forces: Factor, wrench: Array) -> Array:
    return forces.forces(-wrench.reshape((*wrench.shape[:-2], -1)))


def _near(layout: Layout, contacts: Contacts, pose: Pose, still: Flags) -> Array:
    """Factor (..., E) on the forces of contacts that fall as the centres go apart, follow a rope's angle of wrap, or
    are those of a follower whose gap is a freedom."""
    distance = measure(layout.algebra, contacts.rows, pose)
    near, falls = np.ones_like(distance), contacts.reach > 0
    near[..., falls] = contacts.reach[falls] / distance[..., falls]
    bent = np.flatnonzero(contacts.bends[:, 0] >= 0)
    if bent.size:
        mu = where(still, contacts.resting, contacts.coefficient)[..., bent]
        at = contacts.bends[bent], contacts.way[bent], contacts.wrap[bent]
        near[..., bent] = bend_factor(layout, pose, mu, *at)
    for rows, size in effort_sizes(layout, contacts.rows, contacts.joint, pose):
        near[..., rows] = size
    return near


def _unit(layout: Layout, along: ConstraintRows, e: int) -> Array:
    """Wrenches on the links of a unit of contact e."""
    link = np.array([along.i[e], along.j[e]])
    return total_wrench(
        layout, WrenchSource(link, np.stack([along.on_i[..., e, :], along.on_j[..., e, :]], axis=-2))
    )


def _read_arguments(contacts: Contacts, x: Array, near: Array) -> Array:
    """y (..., 3, E) of multipliers x (..., X)."""
    count = contacts.read.shape[-1]
    y = (x[..., :count] @ contacts.read.reshape(-1, count).T).reshape(
        *x.shape[:-1], *contacts.read.shape[:-1]
    )
    y[..., 0, :] = y[..., 0, :] * near
    return np.asarray(y)


def bearing(contacts: Contacts, y: Array) -> Array:
    """S (..., E) of arguments (..., 3, E)."""
    force = hypot(y[..., 0, :], y[..., 1, :])
    if contacts.ball.any():
        return np.where(contacts.ball, hypot(force, y[..., 2, :]), force)
    return np.where(contacts.signed, y[..., 0, :], larger(force, np.abs(y[..., 2, :])))


def slope(contacts: Contacts, y: Array, largest: Array) -> tuple[Array, Array]:
    """Derivative of S after y (..., 3, E), one of its branches where two meet, and S (..., E).

    Almost 0 where a contact's load is negligible next to the ``largest`` (...) of all arguments.
    """
    least = NOTHING * largest[..., None] + TINY
    if contacts.ball.any():
        return _round_slope(contacts, y, least)
    first, second, force = unit(y[..., 0, :], y[..., 1, :], least)
    tilt, _, tilting = unit(y[..., 2, :], np.zeros_like(y[..., 2, :]), least)
    tilted = above(tilting, force) & ~contacts.signed
    plain = ~tilted & ~contacts.signed
    parts = [np.where(contacts.signed, 1.0, plain * first), plain * second, tilted * tilt]
    return np.stack(parts, axis=-2), np.where(contacts.signed, y[..., 0, :], larger(force, tilting))


def _round_slope(contacts: Contacts, y: Array, least: Array) -> tuple[Array, Array]:
    """Derivative of the size of a force of two or three components, and the size."""
    y = y * np.where(np.arange(3)[:, None] < 2, True, contacts.ball)
    size = root((y * y).sum(axis=-2))
    return y / larger(size, least)[..., None, :], size


def argument(r: ContactResponse, cz: Array) -> Array:
    """y with contacts c z (..., E), or z where H is after z."""
    return np.asarray(r.y + (r.h @ cz[..., None, :, None])[..., 0])


def multiplier(r: ContactResponse, cz: Array) -> Array:
    """x with contacts c z."""
    return np.asarray(r.x + (r.change @ cz[..., None])[..., 0])


def with_strength(r: ContactResponse, c: Array) -> ContactResponse:
    """The response with H after z itself, for strengths c (..., E)."""
    return r._replace(h=r.h * c[..., None, None, :])


def jacobian(r: ContactResponse, steep: Array, sense: Array) -> Array:
    """Derivative of z + s S(y) after z (..., E, E) from the slope of S and H after z; its determinant is
    det(A + J) / det(A)."""
    change = ((sense[..., None, :] * steep)[..., None] * r.h).sum(axis=-3)
    return np.asarray(np.eye(sense.shape[-1]) + change)


def correction(
    r: ContactResponse, steep: Array, sense: Array, off: Array, solve: Callable[[Array, Array], Array]
) -> Array:
    """Newton's step where z + s S is ``off`` (..., E), from the slope of S and H after z."""
    return np.asarray(solve(jacobian(r, steep, sense), -off))
