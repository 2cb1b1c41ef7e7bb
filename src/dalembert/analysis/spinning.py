"""Rods between two balls with friction: the spin at which the balls' couples about the rod's line vanish.

A rod that could spin about the line of its two ball joints is set to no spin. Friction in the balls decides it: their
couples, against the relative angular velocities, must leave nothing about the line, which nothing else holds. That
moment falls as the spin grows, so there is one spin, or none where the loads turn the rod more than friction holds.

s   spin, tan(phi) times the fastest rate of the rod's balls
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dalembert.core.friction import Contacts
from dalembert.core.geometry import arm
from dalembert.core.layout import Idle, Layout, Pose, System

Array = NDArray[Any]

STEPS = 60
"""Halvings and secants after which the last spin is taken."""

STEEPEST = 1.56
"""Largest phi: a spin 90 times faster than the balls, where their couples have all but turned into it."""

SETTLED = 1e-14
"""Change of phi at which it has arrived."""


class Rods(NamedTuple):
    """Rows, links and directions (P, k, 3) of rods that spin in balls with friction, and the balls' rates (P, k)."""

    row: NDArray[np.intp]
    link: NDArray[np.intp]
    line: Array
    rate: Array


def rods(layout: Layout, contacts: Contacts, pose: Pose, along: System, rate: Array) -> Rods | None:
    """The rods whose balls rub; None without any."""
    for f in layout.constraints.families:
        if isinstance(f, Idle):
            touched = (along.i == f.j[:, None]) | (along.j == f.j[:, None])
            which = np.flatnonzero(touched.any(axis=1))
            if which.size:
                fastest = np.where(touched[which], np.abs(rate)[..., None, :], 0.0).max(axis=-1)
                line = arm(layout.algebra, pose, f.j, f.p)[..., which, :]
                return Rods(f.row[which], f.j[which], line, fastest)
    return None


def spun(twist: Array, found: Rods, phi: Array) -> Array:
    """The twists (P, L+1, 6) with the rods spinning at phi (P, k)."""
    out = twist.copy()
    out[..., found.link, 3:] += (found.rate * np.tan(phi))[..., None] * found.line
    return out


def settled(found: Rods, moment: Callable[[Array], Array]) -> Array:
    """phi (P, k) at which the moments (P, k) about the lines vanish: a bracket, closed by secants and halvings."""
    low, high = np.full(found.rate.shape, -STEEPEST), np.full(found.rate.shape, STEEPEST)
    at_low, at_high = moment(low), moment(high)
    none = ~(at_low * at_high < 0)
    for k in range(STEPS):
        with np.errstate(all="ignore"):
            secant = low - at_low * (high - low) / (at_high - at_low)
        middle = (low + high) / 2
        new = np.where((k % 3 == 2) | ~(np.abs(secant - middle) <= (high - low) / 2), middle, secant)
        new = np.where(none, 0.0, new)
        here = moment(new)
        left = here * at_low > 0
        low, at_low = np.where(left, new, low), np.where(left, here, at_low)
        high, at_high = np.where(left, high, new), np.where(left, at_high, here)
        if (none | (high - low < SETTLED) | (here == 0)).all():
            break
    return np.where(none, 0.0, np.where(np.abs(at_low) < np.abs(at_high), low, high))
