"""Dead centres: senses of friction just before and just after a position where a contact's rate passes through zero.

The slider of an engine is at rest for an instant while the crank turns on. Its rate is opposite to its second rate
before the instant and along it afterwards, and friction changes sense. Where the second rate is zero too, positions
slightly before and after give the sense; a contact that is at rest then too stays at rest.

Mechanics: docs/theory.md 6.3.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags, at
from dalembert.core.branchless import where
from dalembert.core.constraints import system
from dalembert.core.equilibrium import LinkMotions, motion
from dalembert.core.friction.contact_equations import (
    Contacts,
    SlipState,
    next_senses,
    senses,
    sign,
    zero_crossings,
)
from dalembert.core.layout import ConstraintRows, Layout, Pose
from dalembert.core.position.newton import CLOSED, close_loops, displace

ASIDE = 0.01
"""Offset before and after a reversal: radians, or characteristic lengths, of the fastest link."""


class Crossing(NamedTuple):
    """Contacts (..., E) whose rates pass through zero ``here``, and slow ones that do not, ``slow``, with their senses
    just before and just after; ``turning``: senses of the second rates."""

    here: Flags
    slow: Flags
    before: Array
    after: Array
    turning: SlipState


class Driven(NamedTuple):
    """Targets (P, K + D), and speeds and accelerations of the drives (P, D), at each position."""

    target: Array
    speed: Array
    acceleration: Array


def sides(
    layout: Layout,
    contacts: Contacts,
    along: ConstraintRows,
    pose: Pose,
    moving: LinkMotions,
    driven: Driven,
    now: SlipState,
    spun: Flags,
) -> tuple[SlipState, SlipState]:
    """Senses just before and just after positions where some contact is open: for it, and for all contacts that pass
    through zero with it; the others are open.

    spun (E,): contacts of rods that spin, whose second rates are not those of the motion.
    """
    here, slow, before, after, turning = crossing(layout, contacts, along, pose, moving, now, ~spun)
    known, rest = here | slow, now.open & turning.open
    some = np.flatnonzero(rest.any(axis=-1))
    if some.size:
        where = pose.at(some), at(moving, some), at(driven, some)
        last, next_ = (_aside(layout, contacts, *where, sign) for sign in (-1.0, 1.0))
        for side, near in ((before, last), (after, next_)):
            side[some] = np.where(rest[some], near.sense, side[some])
        known[some] |= rest[some] & ~last.open & ~next_.open
    open_ = ~known | contacts.fixed
    return SlipState(before, open_, now.rate), SlipState(after, open_, now.rate)


def crossing(
    layout: Layout,
    contacts: Contacts,
    along: ConstraintRows,
    pose: Pose,
    moving: LinkMotions,
    now: SlipState,
    follows: Flags,
) -> Crossing:
    """Contacts whose rates pass through zero, by the second rates; follows (E,): contacts whose second rates are the
    motion's."""
    turning = next_senses(layout, contacts, along, pose, moving.twist, moving.acceleration)
    passes = zero_crossings(layout, contacts, moving.twist, now.rate, turning.rate) & ~turning.open
    here = passes & ~(~now.open & ~follows)
    slow = now.open & ~here & ~turning.open  # slow, but moving, and for some time
    slowly = _sign(contacts, now.rate)
    before, after = (where(slow, slowly, side) for side in (-turning.sense, turning.sense))
    return Crossing(here, slow, before, after, turning)


def _sign(contacts: Contacts, rate: Array) -> Array:
    """Senses of rates that determine them, however small."""
    return sign(contacts, rate * contacts.reckoned, rate == 0)[..., contacts.leader]


def _aside(
    layout: Layout, contacts: Contacts, pose: Pose, moving: LinkMotions, driven: Driven, sign: float
) -> SlipState:
    """Senses slightly before (sign -1) or after the positions; open where the linkage does not close."""
    dt = _moment(layout, moving)[:, None]
    ahead, bent = sign * dt, dt * dt / 2
    target = driven.target.copy()
    target[:, layout.constraints.count :] += ahead * driven.speed + bent * driven.acceleration
    step = ahead[..., None] * moving.twist + bent[..., None] * moving.acceleration
    nearby, missing = close_loops(layout, displace(layout, pose, step[:, :-1]), target)
    twist = motion(layout, nearby, driven.speed + ahead * driven.acceleration, driven.acceleration)[0].twist
    slip = senses(layout, contacts, system(layout.algebra, contacts.rows, nearby), twist)
    return slip._replace(open=slip.open | (missing > CLOSED * layout.length)[:, None])


def _moment(layout: Layout, moving: LinkMotions) -> Array:
    """Time (P,) in which the fastest link moves by ``ASIDE``."""
    travel = ASIDE * layout.length
    speed, rate = (
        np.abs(a / layout.wrench_scale).max(axis=(-2, -1)) for a in (moving.twist, moving.acceleration)
    )
    with np.errstate(divide="ignore"):
        return np.asarray(np.minimum(travel / speed, np.sqrt(2 * travel / rate)))
