"""``da.synthesize``: dimensions with which outputs take given values at given positions of the drives.

A point's path with given timing, a function (angle against angle), a motion (a point and an angle): one problem of
least squares. All starts go side by side by Levenberg's and Marquardt's method with exact derivatives, within bounds.

Mechanics: docs/theory.md 11.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from dalembert.analysis.batch.checked_input import numbers as checked
from dalembert.analysis.batch.compiled_kernel import Kernel, compile  # noqa: A004
from dalembert.arrays import Array, Flags
from dalembert.errors import ModelError
from dalembert.model import Mechanism
from dalembert.optimization.optimizing import Bounds, bounds_of, random_places
from dalembert.printing import number, table

STEPS = 100
"""Most iterations."""
EXACT = 1e-6
"""Rms error over the spread of the targets below which a design is said to meet them."""
SMALLEST = 1e-13
"""A gain below this part of the error, and a damping of the step above its inverse, end a start."""


@dataclass(frozen=True)
class Synthesis:
    """The mechanism found; ``error`` its rms error over the spread of the targets, ``exact`` how many of ``started``
    designs meet them to a millionth. ``values`` (number,) in SI in the order of ``numbers``."""

    mechanism: Mechanism
    numbers: tuple[str, ...]
    values: Array
    nominal: Array
    error: float
    exact: int
    started: int
    found: dict[str, Array] = field(repr=False)  # outputs of the design at the targets' positions

    def save(self, path: str | os.PathLike[str], overwrite: bool = False) -> None:
        """Write the mechanism found as a model file."""
        self.mechanism.save(path, overwrite)

    def __str__(self) -> str:
        """Numbers before and after, SI."""
        before, after = ([number(float(x)) for x in of] for of in (self.nominal, self.values))
        rows = [list(row) for row in zip(self.numbers, before, after, strict=True)]
        error = number(self.error, 3)
        words = f"Rms error {error} of the targets' spread; of {self.started} starts {self.exact} are exact."
        return table(["SI", "before", "after"], rows) + "\n\n" + words


def synthesize(
    mechanism: Mechanism,
    vary: Bounds,
    targets: Mapping[str, ArrayLike],
    positions: ArrayLike | None = None,
    starts: int = 1000,
    seed: int = 0,
) -> Synthesis:
    """Numbers within bounds with which outputs come nearest to targets, by least squares over the targets' spread.

    targets: output or expression (`da.compile`) -> its values (P,), of a vector (P, 2), SI and radians, at the
    ``positions`` of the drives (P,) or (P, D), default the file's. The assembly mode is that of the mechanism.
    Raises ModelError where shapes do not fit, and where no design in the bounds closes at all positions.

    >>> import dalembert as da
    >>> m, turned = da.four_bar(), [0.2, 0.9, 1.7, 2.5]
    >>> wanted = [1.65, 1.72, 1.95, 2.27]
    >>> found = da.synthesize(m, {"links.crank.points.A.0": (0.06, 0.12)}, {"angle.rocker": wanted}, turned, starts=4)
    >>> found.error < 0.5
    True
    """
    found, low, high, steps = bounds_of(mechanism, vary)
    if not np.isnan(steps).all():
        raise ModelError("a synthesis takes no steps", "give (low, high)")
    if not targets:
        raise ModelError("there are no targets", 'give targets={"point.coupler.P": [[x, y], ...]}')
    k = compile(mechanism, tuple(vary), list(targets), derivatives=True, static=True)
    f = _Misfit(k, low, high - low, *_wanted(k, targets, positions))
    own = np.clip((k.nominal - low) / np.where(high > low, high - low, 1.0), 0, 1)
    u = random_places(lambda u: np.isfinite(f(u).cost), own, starts, seed)
    u, cost = least_squares(f, u)
    best = int(np.argmin(cost))
    values = low + u[best] * (high - low)
    error = np.sqrt(2 * cost / len(f.target))
    r = k(values, f.positions)
    return Synthesis(
        mechanism=mechanism.with_values({n.path: float(v) for n, v in zip(found, values, strict=True)}),
        numbers=k.numbers,
        values=values,
        nominal=k.nominal,
        error=float(error[best]),
        exact=int((error < EXACT).sum()),
        started=len(u),
        found={name: r.value(name)[0] for name in targets},
    )


def _wanted(
    k: Kernel, targets: Mapping[str, ArrayLike], positions: ArrayLike | None
) -> tuple[Array, Array, Array | None]:
    """Targets and their spreads in one row each, and the positions."""
    place = None if positions is None else checked("positions", positions)
    count = len(k.course(place).schedule.position)
    rows, spreads = list[Array](), list[Array]()
    for name, given in targets.items():
        value, width = checked(f"targets of {name}", given), len(k.nodes[name])
        shapes = [(count, width), (count,)][: 2 if width == 1 else 1]
        if value.shape not in shapes or not np.isfinite(value).all():
            raise ModelError(
                f"targets of {name} have shape {value.shape}, or are not all finite",
                f"give {count} positions" + (f" of {width} components" if width > 1 else ""),
            )
        value = value.reshape(count, width)
        spread = float(np.linalg.norm(np.ptp(value, axis=0))) or float(np.abs(value).max()) or 1.0
        rows.append(value.ravel())
        spreads.append(np.full(value.size, spread))
    return np.concatenate(rows), np.concatenate(spreads), place


class _Errors(NamedTuple):
    """Of many places: half the sum of squares, infinite where there is no answer; errors; their derivatives."""

    cost: Array
    error: Array
    slope: Array


class _Misfit(NamedTuple):
    """Errors over the spread of the targets, as a function of places in the unit box."""

    kernel: Kernel
    low: Array
    span: Array
    target: Array
    spread: Array
    positions: Array | None

    def __call__(self, u: Array) -> _Errors:
        r = self.kernel(self.low + u * self.span, self.positions, redo=False)
        names, n = self.kernel.outputs, len(self.span)
        value = np.concatenate([r.value(name).reshape(len(u), -1) for name in names], axis=1)
        slope = np.concatenate([r.gradient(name).reshape(len(u), -1, n) for name in names], axis=1)
        error, slope = (value - self.target) / self.spread, slope * self.span / self.spread[:, None]
        ok: Flags = np.asarray(np.isfinite(error).all(axis=1) & np.isfinite(slope).all(axis=(1, 2)))
        error, slope = np.where(ok[:, None], error, 0.0), np.where(ok[:, None, None], slope, 0.0)
        return _Errors(np.where(ok, (error**2).sum(axis=1) / 2, np.inf), error, slope)


def least_squares(f: _Misfit, u: Array) -> tuple[Array, Array]:
    """Places (start, number) and costs from starts that have an answer; damped steps, none out of the box."""
    u, (cost, error, slope) = u.copy(), f(u)
    damping, going = np.full(len(u), 1e-2), np.ones(len(u), bool)
    for _ in range(STEPS):
        k = np.flatnonzero(going)
        if not k.size:
            break
        down = np.einsum("sri,sr->si", slope[k], error[k])
        held = ((u[k] <= 0) & (down > 0)) | ((u[k] >= 1) & (down < 0))
        free = np.where(held[:, None, :], 0.0, slope[k])
        square = np.einsum("sri,srj->sij", free, free)
        size = np.einsum("sii->si", square)
        size = np.maximum(size, 1e-12 * np.maximum(size.max(axis=1, keepdims=True), 1e-300))
        square += (damping[k, None] * size)[:, :, None] * np.eye(u.shape[1])
        step = -np.linalg.solve(square, np.where(held, 0.0, down)[..., None])[..., 0]
        trial = np.clip(u[k] + step, 0.0, 1.0)
        new = f(trial)
        better = new.cost < cost[k]
        gain = cost[k] - new.cost
        damping[k] = np.where(better, np.maximum(damping[k] / 5, 1e-15), damping[k] * 4)
        going[k] = np.where(better, gain > SMALLEST * cost[k], damping[k] < 1 / SMALLEST)
        b = k[better]
        u[b], cost[b], error[b], slope[b] = (a[better] for a in (trial, *new))
    return u, cost
