"""The range of an effort that friction can hold at rest, whatever the history: successive linear programming.

At rest friction may have any value within its limits, which depend on the reactions; the range consists of the efforts
that it can balance. The limits are not convex, so each step maximizes the effort in a convex part of them about the
last state (inner approximation: Marks and Wright, 1978).

A state of rest is t = c z with |t_e| <= c_e S_e(y0 + H t) for every contact. S is convex: with its slope s at a state
y, s . y0 + s H t is never more than S, and equal to S at it. So |t_e| <= c_e s_e . (y0 + H t) allows only states of
rest, including y itself, and the one with the largest effort solves a linear programme. The next programme takes the
slope at that state; the iteration ends when the effort no longer increases. Every iterate can be reached from the
frictionless state through states of rest. An unbounded programme shows a wedge: friction holds any value.

t   friction forces and couples (..., E), in units of each that make values near one

Mechanics: docs/theory.md 6.3.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags, Index, Ints, at
from dalembert.core.friction.contact_equations import (
    ContactResponse,
    Contacts,
    SlipState,
    argument,
    bearing,
    slope,
    strength,
    with_strength,
)
from dalembert.core.friction.friction_solver import newton
from dalembert.core.friction.linear_programmes import furthest
from dalembert.core.friction.spectral_bound import levers
from dalembert.core.linear import inverses

ROUNDS = 40
"""Linear programmes after which the current state is accepted."""

GAIN = 1e-12
"""Relative increase of the unknown, by its size and by the change that friction can make in it, that counts as zero."""

SAME = 1e-9
"""Relative distance from the effort at which motion impends; a smaller excess is the rounding error of the search."""

UNLOADED = 1e-9
"""Bearing force over the largest force below which a contact may change sides."""

SINGLE = 16
"""Contacts up to which the search also starts from the extremes of each."""

MOST = 10**6
"""Numbers in the tableaux of the positions solved at once."""


class _Rest(NamedTuple):
    """Contacts, and a response whose t are scaled to values near one; c (E,) on the same scale; contacts that have
    friction (F,)."""

    contacts: Contacts
    r: ContactResponse
    c: Array
    active: Ints

    def at(self, which: Index) -> _Rest:
        return self._replace(r=at(self.r, which))


def holding(contacts: Contacts, r: ContactResponse, known: SlipState, ends: Array) -> Array:
    """Low and high (P, U, 2) of the last U multipliers, whose ``ends`` (P, U, 2) at impending motion are known.

    Infinite where unbounded. NaN where a contact moves (its friction is at its limit, whatever its history), and where
    the friction of one contact has several directions.
    """
    active = np.asarray(~contacts.fixed & (strength(contacts, 1.0, True) > 0))
    if len(np.unique(contacts.group[active])) < active.sum():
        return np.full(ends.shape, np.nan)
    free = np.asarray((known.open | ~active).all(axis=-1) & np.isfinite(r.y).all(axis=(-2, -1)))
    out = np.where(free[:, None, None], ends, np.nan)
    rest = _scale(contacts, r)
    gains = rest.r.change[:, -ends.shape[1] :, :]
    open_ = np.flatnonzero(free & ~_monotonic(rest, gains))
    outward, n = _outward(rest), len(rest.active)
    size = max(1, MOST // (2 * ends.shape[1] * (len(outward) + 3) * (2 * n + 1) * (n + 1)))
    for some in np.split(open_, range(size, len(open_), size)) if open_.size else ():
        best = _best(rest.at(some), np.concatenate([gains, -gains], axis=1)[some], outward)
        x = r.x[some][:, -ends.shape[1] :]
        sought = np.stack([x - best[:, ends.shape[1] :], x + best[:, : ends.shape[1]]], axis=-1)
        room = SAME * np.nan_to_num(np.abs(ends[some])).max(axis=-1)[..., None]
        out[some] = np.where((sought - ends[some]) * [-1.0, 1.0] > room, sought, ends[some])
    unheld = np.isnan(ends) & free[:, None, None]
    return np.where(unheld, [-np.inf, np.inf], out)


def _monotonic(rest: _Rest, gains: Array) -> Flags:
    """True where (P,) every unknown is proved to be monotonic in each contact's fraction of its limit, whatever the
    others are: then the extremes are the ends at which motion impends.

    The change a of an unknown with t, the other contacts following, is a = g - (f S' H)^T a for parts f. With a bound M
    of the size of S' H:  |a - g| <= M^T (1 - M^T)^-1 |g|,  where the inverse has no negative entry.
    """
    contacts, h = rest.contacts, rest.r.h
    lever = np.where(rest.c[:, None] != 0, levers(contacts, h), 0.0)
    follow = np.swapaxes(lever, -1, -2)
    inverse = inverses(np.eye(h.shape[-1]) - follow)
    most = np.abs(gains) @ np.swapaxes(inverse, -1, -2)
    least = np.abs(gains) - most @ np.swapaxes(follow, -1, -2)
    faces = np.flatnonzero(contacts.signed)
    least[..., contacts.leader[faces]] -= most[..., faces]
    proved = (inverse >= 0).all(axis=(-2, -1)) & (least[..., rest.active] > 0).all(axis=(-2, -1))
    return np.asarray(proved)


def _best(rest: _Rest, ends: Array, outward: Array) -> Array:
    """Largest q . t (P, Q) over the computed states, for gains q (P, Q, E)."""
    count, many = ends.shape[:2]
    seen = _extreme_states(
        rest, np.concatenate([np.broadcast_to(outward, (count, *outward.shape)), ends], axis=1)
    )
    starts = seen.shape[1]
    every = np.repeat(np.arange(count), starts * many)
    q = np.repeat(ends[:, None], starts, axis=1).reshape(len(every), -1)
    t, unbounded = _furthest(rest.at(every), q, np.repeat(seen.reshape(count * starts, -1), many, axis=0))
    value = np.where(unbounded, np.inf, (q * t).sum(axis=-1))
    return np.asarray(value.reshape(count, starts, many).max(axis=1))


def _scale(contacts: Contacts, r: ContactResponse) -> _Rest:
    """t by the strength of each contact and the largest force."""
    c = strength(contacts, 1.0, True)
    size = np.abs(r.y).max(axis=(-2, -1), initial=0.0)
    size = np.where(size > 0, size, 1.0)
    unit = np.where(c != 0, c, 1.0)
    part = r._replace(y=r.y / size[:, None, None], change=r.change * unit * size[:, None, None])
    active = np.flatnonzero(~contacts.fixed & ~contacts.signed & (c > 0))
    return _Rest(
        contacts, with_strength(part, np.broadcast_to(unit, (len(size), len(unit)))), c / unit, active
    )


def _bare(rest: _Rest) -> Array:
    """t (P, E) without friction: the separation of gear teeth alone."""
    c = np.where(rest.contacts.fixed, rest.c, 0.0)
    return _at_parts(rest, np.where(rest.contacts.fixed, -1.0, 0.0), c, np.zeros(rest.r.y.shape[::2]))[0]


def _at_parts(rest: _Rest, part: Array, c: Array, t: Array) -> tuple[Array, Flags]:
    """State near t (B, E) in which every contact has the same fraction of its limit, and a flag where it exists."""
    part, c = np.broadcast_to(part, t.shape), np.broadcast_to(c, t.shape)
    solution = newton(rest.contacts, rest.r, part, c, c * t)
    return np.where(solution.arrived[:, None], c * solution.z, t), solution.arrived


def _outward(rest: _Rest) -> Array:
    """Gains (K, E) from whose extreme states the search also starts: each contact's friction, in both senses."""
    unit = np.eye(rest.contacts.count)[rest.active if len(rest.active) <= SINGLE else []]
    return np.concatenate([unit, -unit])


def _extreme_states(rest: _Rest, q: Array) -> Array:
    """States (P, K + 1, E): the frictionless one, and the one of largest gain q (P, K, E) reached from it."""
    bare = _bare(rest)
    every = np.repeat(np.arange(len(bare)), q.shape[1])
    t, _ = _furthest(rest.at(every), q.reshape(len(every), -1), bare[every])
    return np.concatenate([bare[:, None], t.reshape(q.shape)], axis=1)


def _furthest(rest: _Rest, q: Array, t: Array) -> tuple[Array, Flags]:
    """States with the largest q . t reached from t (B, E), and a flag where q . t is unbounded (B,)."""
    t, open_ = t.copy(), np.zeros(len(t), bool)
    on, idle, sides = np.arange(len(t)), np.zeros(len(t), int), None
    size = np.abs(q).sum(axis=-1)
    for _ in range(ROUNDS):
        part = rest.at(on)
        sides = _slopes(part, t[on], sides)
        directions, g, h = _limits(part, t[on], sides)
        combination, unbounded = furthest(g, h, (q[on, None, :] @ directions)[:, 0])
        new = _exact(part, t[on] + (directions @ combination[..., None])[..., 0])
        gain = ((new - t[on]) * q[on]).sum(axis=-1)
        gained = gain > GAIN * size[on]
        t[on] = np.where((gained | unbounded)[:, None], new, t[on])
        open_[on[unbounded]] = True
        idle[on] = np.where(gained, 0, idle[on] + 1)
        kept = ~unbounded & (idle[on] < 2)
        on, sides = on[kept], sides[kept]
        if not on.size:
            break
    return t, open_


def _slopes(rest: _Rest, t: Array, before: Array | None) -> Array:
    """Slope (B, 3, E) of the bearing forces; for an unloaded contact, of the side opposite to the previous one."""
    y = argument(rest.r, t)
    largest = np.abs(y).max(axis=(-2, -1), initial=0.0)
    steep, size = slope(rest.contacts, y, largest)
    unloaded = np.abs(size) <= UNLOADED * largest[:, None]
    if before is None:
        before = np.zeros(steep.shape)
        before[:, 0] = -1.0
    return np.where(unloaded[:, None, :], -before, steep)


def _exact(rest: _Rest, t: Array) -> Array:
    """t with the couples of guides' faces corrected to the fractions of friction in the guides."""
    contacts = rest.contacts
    if not contacts.signed.any():
        return t
    bears = bearing(contacts, argument(rest.r, t))
    part = np.where(bears > 0, -t / np.where(bears > 0, bears, 1.0), 0.0)
    part = np.where(contacts.fixed, -1.0, np.clip(part, -1.0, 1.0))[:, contacts.leader]
    return _at_parts(rest, part, rest.c, t)[0]


def _limits(rest: _Rest, t: Array, steep: Array) -> tuple[Array, Array, Array]:
    """Linear limits on changes of t, with the bearing forces linearized: directions (B, E, F) of t with those of the
    contacts' friction; g (B, M, F) times a change of these is at most h (B, M)."""
    contacts, active, c = rest.contacts, rest.active, rest.c
    count, each = t.shape
    bears = (steep * argument(rest.r, t)).sum(axis=-2)
    turn = (steep[..., None] * rest.r.h).sum(axis=-3)
    directions: Array = np.zeros((count, each, len(active)))
    directions[:, active, np.arange(len(active))] = 1.0
    for face in np.flatnonzero(contacts.signed & (c > 0)):
        guide = contacts.leader[face]
        ratio = bears[:, face] / np.where(bears[:, guide] > 0, bears[:, guide], 1.0)
        directions[:, face] = ratio[:, None] * directions[:, guide]
    fixed = np.flatnonzero(contacts.fixed)
    follows = np.zeros((count, each, each))
    follows[:, fixed] = c[fixed, None] * turn[:, fixed]
    directions = np.asarray(np.linalg.solve(np.eye(each) - follows, directions))
    mine, turned, limit = directions[:, active], turn[:, active] @ directions, bears[:, active]
    g = np.concatenate([mine - turned, -mine - turned, -(turn[:, fixed] @ directions)], axis=1)
    h = np.concatenate([limit - t[:, active], limit + t[:, active], bears[:, fixed]], axis=1)
    return directions, g, np.maximum(h, 0.0)
