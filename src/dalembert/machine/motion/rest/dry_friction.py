"""Dry friction of a moving machine: accelerations and friction of its contacts together, for known senses.

Equilibrium with inertia is linear in accelerations a and friction c z alike:

    effort = e + M a + G c z,    y = y0 + Ya a + H c z,    rates of the contacts' rates = d - G^T a

With a put in from the first, where efforts are given, the second is that of contacts at known accelerations, with other
numbers: the same solver finds z = -s S(y), the same determinant shows that the solution is unique. A contact that
sticks has the rate of its rate equal to 0 instead of that law, and its friction is the force that this needs.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.core.friction.contact_equations import (
    ContactResponse,
    Contacts,
    SlipState,
    argument,
    bearing,
    multiplier,
    sign,
    strength,
)
from dalembert.core.friction.friction_solver import newton, solve_friction

SIDED = ("guide", "mesh", "separation")
"""Kinds of plane contacts that bear on one of two sides."""


class Linear(NamedTuple):
    """Inverse dynamics in accelerations and friction: G (D, E), y0 (3, E), Ya (3, E, D), H (3, E, E), d (E,)."""

    push: Array
    y: Array
    ahead: Array
    h: Array
    drift: Array


class Contacted(NamedTuple):
    """Accelerations and efforts (D,), and of the contacts (E,): the rates of their rates, friction c z, how much more
    those that stick could take, friction as a part of its limit in motion against the sense, and what their limits at
    rest would make of the rates' rates; ``margins`` (2K,) of the K that bear on one of two sides."""

    a: Array
    effort: Array
    second: Array
    cz: Array
    room: Array
    part: Array
    size: Array
    margins: Array


def sided(contacts: Contacts) -> Ints:
    """Contacts (K,) whose bearing force max(|y1|, |y3|) has corners where they change sides."""
    plane = contacts.at.shape[-1] == 2
    kinds = zip(contacts.kind, contacts.signed, strict=True)
    return np.array(
        [e for e, (kind, signed) in enumerate(kinds) if plane and kind in SIDED and not signed], int
    )


def side_margins(contacts: Contacts, y: Array) -> Array:
    """y1 + y3 and y1 - y3 (2K,) of arguments y (3, E), N: each passes 0 at a corner."""
    part = y[:, sided(contacts)]
    return np.concatenate([part[0] + part[2], part[0] - part[2]])


@dataclass
class DryFriction:
    """The contacts of a machine; ``own``: those that slip independently, whose senses are given. ``last``: z of the
    last state, the start for the next one."""

    contacts: Contacts
    own: Ints
    last: Array | None = None

    def senses(self, rates: Array, chosen: Array) -> Array:
        """Part of each contact (E,) in the direction of its slip; ``chosen``: senses of the independent ones."""
        c = self.contacts
        sense = sign(c, rates * c.reckoned, (c.group == c.group[:, None]).sum(axis=0) == 1)
        sense[self.own] = chosen
        return np.where(c.fixed, -1.0, sense[c.leader])

    def solve(
        self, f: Linear, a: Array, effort: Array, change: Array, sense: Array, stuck: Flags
    ) -> Contacted | None:
        """The solution, from that without friction (a, effort) and the ``change`` (2D, E) of both with c z; None where
        it does not exist, or is not reached on the path from no friction."""
        d = len(a)
        x = np.concatenate([a, effort, f.drift - f.push.T @ a])
        r = ContactResponse(
            x, np.vstack([change, -f.push.T @ change[:d]]), f.y + f.ahead @ a, f.h + f.ahead @ change[:d]
        )
        held = np.flatnonzero(stuck)
        part = _sticking(r, 2 * d + held, held)
        sense = np.where(stuck, 0.0, sense)
        c = strength(self.contacts, 1.0, sense=sense)
        z = self._slip(part, sense, c)
        if z is None:
            return None
        cz = np.where(stuck, 0.0, c * z)
        x, y = multiplier(part, cz), argument(part, cz)
        if len(held):
            cz[held] = np.linalg.solve(r.change[2 * d + held][:, held], (x - multiplier(r, cz))[2 * d + held])
        size = np.abs(bearing(self.contacts, y))
        limit, least = (
            strength(self.contacts, 1.0, True) * size,
            np.where(stuck & (c * size > 0), c * size, 1.0),
        )
        room, pushed = np.where(stuck, limit - np.abs(cz), 0.0), limit * r.change[2 * d :].diagonal()
        parts = np.where(stuck, -cz / least, sense)
        margins = side_margins(self.contacts, argument(r, cz))
        return Contacted(x[:d], x[d : 2 * d], x[2 * d :], cz, room, parts, pushed, margins)

    def _slip(self, r: ContactResponse, sense: Array, c: Array) -> Array | None:
        """z of those that slip: near the last one, else on the path from no friction."""
        batch = ContactResponse(*(x[None] for x in r))
        if self.last is not None:
            solution = newton(self.contacts, batch, sense[None], c[None], self.last[None])
            if solution.arrived[0] and solution.determinant[0] > 0:
                self.last = np.asarray(solution.z[0])
                return self.last
        state = SlipState(sense[None], np.zeros((1, len(sense)), bool), sense[None])
        z = np.asarray(solve_friction(self.contacts, batch, state).z[0])
        self.last = z if np.isfinite(z).all() else None
        return self.last


def _sticking(r: ContactResponse, rows: Ints, held: Ints) -> ContactResponse:
    """The response where friction of some contacts keeps some multipliers at 0: it follows from the others'."""
    if not len(held):
        return r
    inverse = np.linalg.inv(r.change[rows][:, held])
    base, others = -inverse @ r.x[rows], -inverse @ r.change[rows]
    others[:, held] = 0.0
    change, h = r.change.copy(), r.h.copy()
    change[:, held] = h[..., held] = 0.0
    return ContactResponse(
        r.x + r.change[:, held] @ base,
        change + r.change[:, held] @ others,
        r.y + r.h[..., held] @ base,
        h + r.h[..., held] @ others,
    )
