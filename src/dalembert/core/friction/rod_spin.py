"""Spin of rods between two ball joints with friction: the root of the balls' moment about the rod's line.

A rod that could spin about the line of its two ball joints is first given zero spin. Friction in the balls determines
it: their couples, against the relative angular velocities, must have zero moment about the line, since nothing else
resists there. That moment decreases as the spin grows, so there is one spin, or none where the loads' moment exceeds
friction. It is computed by secants and bisection, for several rods in turn and then by Newton; where friction has
several solutions, by continuation from no friction. Inertia of the spin about the line is neglected.

s   spin, tan(phi) times the fastest rate of the rod's balls

Mechanics: docs/theory.md 6.1.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags, Ints, at, put
from dalembert.core.friction.contact_equations import (
    ContactResponse,
    Contacts,
    SlipState,
    multiplier,
    strength,
)
from dalembert.core.friction.friction_solver import LONGEST, FrictionSolution, NewtonResult, newton
from dalembert.core.geometry import arm
from dalembert.core.layout import ConstraintRows, Idle, Layout, Pose
from dalembert.core.linear import solve_square

STEPS = 60
"""Bisections and secants after which the last spin is accepted."""

STEEPEST = 1.56
"""Largest phi: a spin 90 times faster than the balls, where their couples are almost opposite to the spin."""

SETTLED = 1e-14
"""Change of phi at which the search has converged."""

SWEEPS = 8
"""Sweeps in which each rod is solved with the spins of the others fixed: its couples change the others'
forces little."""

FIRST, ENDED = 0.01, 1e-8
"""First step of the scale of friction of a branch with spinning rods, and the one below which it has ended."""

SPUN, FAR, ALMOST, CLOSE = 8, 0.3, 1e-9, 1e-7
"""Newton's steps on the spins, their largest change, the change at convergence, and the step of the differences."""


class SpinningRods(NamedTuple):
    """Rods that spin in balls with friction: rows, directions (P, k, 3), whose contacts (k, E), rates (P, k) of the
    fastest of the rod's balls, and the state of the contacts for spins phi (P, k)."""

    row: Ints
    line: Array
    touched: Flags
    rate: Array
    senses: Callable[[Array], SlipState]

    def at(self, some: Ints) -> SpinningRods:
        """The same rods at some of the positions."""

        def senses(phi: Array) -> SlipState:
            return at(self.senses(put(np.zeros(self.rate.shape), some, phi)), some)

        return self._replace(line=self.line[some], rate=self.rate[some], senses=senses)

    def spin_rates(self, r: ContactResponse, rate: Array, phi: Array) -> Array:
        """Rates (P, E) that spins at phi add to an impending motion: a unit of spin turns each contact as far as the
        contact's couple turns the rod."""
        unit = r.change[..., self.row, :]
        return np.asarray(((_fastest(self.touched, rate) * np.tan(phi))[..., None] * unit).sum(axis=-2))


def _fastest(touched: Flags, rate: Array) -> Array:
    """The fastest rate (..., k) of the contacts of each rod (k, E), from rates (..., E)."""
    return np.asarray(np.where(touched, np.abs(rate)[..., None, :], 0.0).max(axis=-1))


def spinning_rods(
    layout: Layout, pose: Pose, along: ConstraintRows, twist: Array, senses: Callable[[Array], SlipState]
) -> SpinningRods | None:
    """The rods whose balls have friction; None without any. ``senses``: of the contacts at a twist of the links."""
    idle = [f for f in layout.constraints.families if isinstance(f, Idle)]
    if not idle:
        return None
    f = idle[0]
    touched = (along.i == f.j[:, None]) | (along.j == f.j[:, None])
    which = np.flatnonzero(touched.any(axis=1))
    if not which.size:
        return None
    line = arm(layout.algebra, pose, f.j, f.p)[..., which, :]
    rate = _fastest(touched[which], senses(twist).rate)

    def spun(phi: Array) -> SlipState:
        """Slip state with the rods spinning at phi."""
        turning = twist.copy()
        turning[..., f.j[which], 3:] += (rate * np.tan(phi))[..., None] * line
        return senses(turning)

    return SpinningRods(f.row[which], line, touched[which], rate, spun)


def solve_spins(shape: tuple[int, ...], moment: Callable[[Array], Array]) -> Array:
    """phi (P, k) of a shape at which the moments (P, k) about the lines vanish: rod after rod, then all together."""
    phi: Array = np.zeros(shape)
    for _ in range(SWEEPS if phi.shape[-1] > 1 else 1):
        for n in range(phi.shape[-1]):
            phi[..., n] = _bracket_root(_of_one(moment, phi, n), phi[..., n].shape)
        if phi.shape[-1] > 1:
            phi, arrived = _together(moment, phi)
            if arrived.all():
                break
    return phi


def _together(moment: Callable[[Array], Array], phi: Array) -> tuple[Array, Flags]:
    """All rods at once by Newton from a nearby start, and a flag where it converges; elsewhere the start."""
    new, change, _ = _newton(moment, phi)
    arrived = np.asarray(((np.abs(change) < ALMOST) & (np.abs(new) < STEEPEST)).all(axis=-1))
    return np.where(arrived[..., None], new, phi), arrived


def _newton(moment: Callable[[Array], Array], phi: Array) -> tuple[Array, Array, Array]:
    """Spins by Newton on their moments, the last change, and the derivatives (..., k, k), by finite differences."""
    for _ in range(SPUN):
        here = moment(phi)
        steep = np.stack([(moment(phi + CLOSE * e) - here) / CLOSE for e in np.eye(phi.shape[-1])], axis=-1)
        change = solve_square(steep, -here)
        phi = phi + np.nan_to_num(np.clip(change, -FAR, FAR))
        if not (np.abs(change) >= SETTLED).any():  # NaN where no spin changes a moment
            break
    return phi, change, steep


def _of_one(moment: Callable[[Array], Array], phi: Array, n: int) -> Callable[[Array], Array]:
    """Moment about the line of rod n as a function of its phi, with the others' fixed."""

    def single(value: Array) -> Array:
        tried = phi.copy()
        tried[..., n] = value
        return moment(tried)[..., n]

    return single


def _bracket_root(moment: Callable[[Array], Array], shape: tuple[int, ...]) -> Array:
    """phi at which a moment vanishes, by secants and bisection of a bracket; 0 where it does not change sign."""
    low, high = np.full(shape, -STEEPEST), np.full(shape, STEEPEST)
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


def follow_branch_with_spin(
    contacts: Contacts, r: ContactResponse, resting: Flags, rods: SpinningRods
) -> FrictionSolution:
    """The branch from no friction, with the rods at their equilibrium spin throughout. It is followed like the one
    without spin: it ends where no step of the friction scale succeeds, at a critical scale of 0 where none does.
    """

    def moment(scale: Array, z: Array, phi: Array) -> tuple[NewtonResult, Array]:
        """Friction from z on where the rods spin at phi, and the moments (P, k) about their lines that it leaves."""
        sense = rods.senses(phi).sense
        c = strength(contacts, scale[:, None], resting, sense)
        solution = newton(contacts, r, sense, c, z, most=12)
        return solution, np.nan_to_num(multiplier(r, c * solution.z)[..., rods.row])

    largest = np.abs(r.x).max(axis=-1)
    z, count = np.zeros(resting.shape), len(resting)
    step = np.full(count, FIRST)
    phi = solve_spins((count, len(rods.row)), lambda phi: moment(step, z, phi)[1])
    scale, sign, determinant = np.zeros(count), np.zeros(count), np.ones(count)
    while ((scale < 1) & (step > ENDED)).any():
        aim = np.where(step > ENDED, np.minimum(scale + step, 1.0), scale)
        new, turned, orientation = _nested_newton(partial(moment, aim, z), phi, largest)
        near = (np.abs(turned - phi) < FAR).all(axis=-1)
        good = new.arrived & near & (new.determinant > 0) & (orientation * sign >= 0) & (aim > scale)
        phi = np.where(good[:, None], turned, phi)
        z, determinant = np.where(good[:, None], new.z, z), np.where(good, new.determinant, determinant)
        sign, scale = np.where(good, orientation, sign), np.where(good, aim, scale)
        step = np.where(good, np.minimum(2 * step, LONGEST), step / 2)
    ended, state = scale < 1, rods.senses(phi)
    z, critical = np.where(ended[:, None], np.nan, z), np.where(ended, scale, np.nan)
    c = strength(contacts, 1.0, resting, state.sense)
    x, none = multiplier(r, c * z), np.zeros(count, bool)
    return FrictionSolution(state, z, c, x, determinant, critical, none, none)


def _nested_newton(
    moment: Callable[[Array], tuple[NewtonResult, Array]], phi: Array, largest: Array
) -> tuple[NewtonResult, Array, Array]:
    """Newton on friction within Newton on the spins, whose derivatives are finite differences; sign of their
    determinant."""
    phi, change, steep = _newton(lambda phi: moment(phi)[1], phi)
    solution, left = moment(phi)
    balanced = np.abs(left).max(axis=-1) <= ALMOST * largest
    arrived = solution.arrived & balanced & (np.abs(change).max(axis=-1) < ALMOST)
    return solution._replace(arrived=arrived), phi, np.sign(np.linalg.det(steep))
