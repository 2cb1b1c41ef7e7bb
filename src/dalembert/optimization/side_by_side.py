"""Quasi-Newton steps (BFGS) of many starts in a box at once: one call of the function per step of all of them.

Nocedal and Wright, Numerical Optimization, chapter 6; at its bounds a start moves along them, by projection.

Mechanics: docs/theory.md 11.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from dalembert.arrays import Array
from dalembert.optimization.design_problem import AimValue

STEPS = 150
"""Most steps of a start."""
ENOUGH = 1e-4
"""Fraction of the decrease predicted by the slope that a step must achieve."""
FIRST = 0.1
"""Longest first step, as a fraction of the box."""
SMALLEST = 1e-9
"""A step below this part of the box ends a start; so does a gain below it."""


def minimize(
    of: Callable[[Array], AimValue],
    u: Array,
    steps: int = STEPS,
    progress: Callable[[int], object] | None = None,
) -> tuple[Array, Array]:
    """Points (start, number) and values, from solvable starts in the unit box."""
    u, answer = u.copy(), of(u)
    value, slope = answer.value.copy(), answer.slope.copy()
    n = u.shape[1]
    inverse = np.broadcast_to(np.eye(n), (len(u), n, n)).copy()
    fresh, length, tries = np.ones(len(u), bool), np.ones(len(u)), np.zeros(len(u), int)
    going = np.isfinite(value)
    for step in range(steps):
        k = np.flatnonzero(going)
        if not k.size:
            break
        direction = _direction(u[k], slope[k], inverse[k])
        unit = np.where(fresh[k], FIRST / np.maximum(np.abs(direction).max(axis=1), 1e-300), 1.0)
        trial = np.clip(u[k] + (unit * length[k])[:, None] * direction, 0.0, 1.0)
        moved = trial - u[k]
        new = of(trial)
        promised = (slope[k] * moved).sum(axis=1)
        better = new.value <= value[k] + ENOUGH * promised
        gain = value[k] - new.value
        _update(inverse, fresh, k[better], moved[better], (new.slope - slope[k])[better])
        small = np.abs(moved).max(axis=1) < SMALLEST
        done = small | (better & (gain < SMALLEST * np.maximum(np.abs(value[k]), SMALLEST)) & ~fresh[k])
        b = k[better]
        u[b], value[b], slope[b] = trial[better], new.value[better], new.slope[better]
        length[k] = np.where(better, 1.0, 0.3 * length[k])
        tries[k] = np.where(better, 0, tries[k] + 1)
        again = k[~better & (tries[k] == 6)]
        inverse[again], fresh[again], length[again] = np.eye(n), True, 1e-2
        going[k[done | (tries[k] > 12)]] = False
        if progress is not None:
            progress(step + 1)
    return u, value


def _direction(u: Array, slope: Array, inverse: Array) -> Array:
    """Descent directions (start, number), zero through a bound where the slope pushes against it."""
    held = ((u <= 0) & (slope > 0)) | ((u >= 1) & (slope < 0))
    free = np.where(held, 0.0, slope)
    direction = -np.einsum("sij,sj->si", inverse, free)
    direction = np.where(held, 0.0, direction)
    uphill = (direction * free).sum(axis=1) >= 0
    return np.where(uphill[:, None], -free, direction)


def _update(inverse: Array, fresh: Array, k: Array, s: Array, y: Array) -> None:
    """The inverse Hessians after steps s with changes y of the gradient, where the curvature is positive."""
    sy = (s * y).sum(axis=1)
    good = sy > 1e-12 * np.linalg.norm(s, axis=1) * np.linalg.norm(y, axis=1)
    k, s, y, sy = k[good], s[good], y[good], sy[good]
    if not k.size:
        return
    start = fresh[k]
    size = np.where(start, sy / np.maximum((y * y).sum(axis=1), 1e-300), 1.0)
    h = np.where(start[:, None, None], np.eye(s.shape[1]) * size[:, None, None], inverse[k])
    hy = np.einsum("sij,sj->si", h, y)
    factor = (1 + (y * hy).sum(axis=1) / sy) / sy
    cross = np.einsum("si,sj->sij", hy, s) / sy[:, None, None]
    inverse[k] = h + factor[:, None, None] * np.einsum("si,sj->sij", s, s) - cross - cross.swapaxes(1, 2)
    fresh[k] = False
