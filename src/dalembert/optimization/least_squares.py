"""Least squares of many starts at once: outputs against targets, by Levenberg's and Marquardt's method within bounds.

Mechanics: docs/theory.md 11.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from dalembert.analysis.batch.batch_result import BatchResult
from dalembert.analysis.batch.checked_input import numbers as checked
from dalembert.analysis.batch.compiled_kernel import Kernel
from dalembert.arrays import Array, Flags
from dalembert.errors import ModelError

STEPS = 100
"""Largest number of iterations."""
SMALLEST = 1e-13
"""A gain below this part of the error, and a damping of the step above its inverse, end a start."""
BETWEEN = 8
"""Subdivisions of the step between two positions at whose ends a design has to close."""


def wanted(k: Kernel, targets: Mapping[str, ArrayLike], count: int | None) -> tuple[Array, Array]:
    """Targets (P, component) side by side, and the spread of each; as many as for the first one if no count is
    given."""
    columns, spreads = list[Array](), list[Array]()
    for name, values in targets.items():
        value, width = checked(f"targets of {name}", values), len(k.nodes[name])
        count = len(value) if count is None and value.ndim else count
        shapes = [(count, width), (count,)][: 2 if width == 1 else 1]
        if value.shape not in shapes or not value.size or not np.isfinite(value).all():
            raise ModelError(
                f"targets of {name} have shape {value.shape}, or are not all finite",
                f"give {count} positions" + (f" of {width} components" if width > 1 else ""),
            )
        value = value.reshape(-1, width)
        spread = float(np.linalg.norm(np.ptp(value, axis=0))) or float(np.abs(value).max()) or 1.0
        columns.append(value)
        spreads.append(np.full(value.shape, spread))
    return np.concatenate(columns, axis=1), np.concatenate(spreads, axis=1)


class Errors(NamedTuple):
    """Half the sum of squares of many designs, infinite where unsolved; their errors; the derivatives of these."""

    cost: Array
    error: Array
    slope: Array


@dataclass(frozen=True)
class TargetErrors:
    """Errors over the spread of the targets, as a function of points in the unit box."""

    kernel: Kernel
    low: Array
    span: Array
    target: Array
    spread: Array
    positions: Array | None

    def __call__(self, x: Array) -> Errors:
        r, n = self._at(x, self.positions), len(self.span)
        names, shape = self.kernel.outputs, (len(x), len(self.target), -1)
        value = np.concatenate([r.value(name).reshape(shape) for name in names], axis=2)
        slope = np.concatenate([r.gradient(name).reshape(*shape, n) for name in names], axis=2)
        return self.errors(value, slope * self.span)

    def errors(self, value: Array, slope: Array) -> Errors:
        """Errors of outputs (design, P, component), with derivatives by the unknowns in a last axis."""
        error, slope = (value - self.target) / self.spread, slope / self.spread[..., None]
        error, slope = error.reshape(len(error), -1), slope.reshape(len(error), -1, slope.shape[-1])
        ok: Flags = np.asarray(np.isfinite(error).all(axis=1) & np.isfinite(slope).all(axis=(1, 2)))
        error, slope = np.where(ok[:, None], error, 0.0), np.where(ok[:, None, None], slope, 0.0)
        return Errors(np.where(ok, (error**2).sum(axis=1) / 2, np.inf), error, slope)

    def _at(self, x: Array, positions: Array | None) -> BatchResult:
        return self.kernel(self.low + x[:, : len(self.low)] * self.span, positions, redo=False)

    def answers(self, u: Array) -> Flags:
        """True for points that can serve as starts."""
        return np.isfinite(self(u).cost)

    def begin(self, u: Array) -> Array:
        """Unknowns of points in the box."""
        return u

    def held(self, x: Array, down: Array) -> Flags:
        """True for unknowns at a bound that the slope ``down`` pushes against."""
        return np.asarray(((x <= 0) & (down > 0)) | ((x >= 1) & (down < 0)))

    def moved(self, x: Array, step: Array) -> Array:
        """A step that stays within the bounds."""
        return np.asarray(np.clip(x + step, 0.0, 1.0))

    def places(self, x: Array) -> Array | None:
        """The drives' positions at the targets, of one design."""
        return self.positions

    def moves(self, x: Array) -> Flags:
        """True for designs that also close between the positions."""
        schedule = self.kernel.course(self.positions).schedule
        if any(np.ptp(rate, axis=0).any() for rate in (schedule.speed, schedule.acceleration)):
            return np.ones(len(x), bool)  # laws of motion: only at their positions
        q, part = schedule.position, np.arange(1, BETWEEN)[:, None] / BETWEEN
        if len(q) < 2:
            return np.ones(len(x), bool)
        between = np.concatenate([a + part * (b - a) for a, b in pairwise(q)])
        return np.asarray(self._at(x, between).ok.all(axis=1))


def least_squares(f: TargetErrors, x: Array) -> tuple[Array, Array]:
    """Points (start, number) and costs from solvable starts; damped steps within the bounds."""
    x, (cost, error, slope) = x.copy(), f(x)
    damping, going = np.full(len(x), 1e-2), np.ones(len(x), bool)
    for _ in range(STEPS):
        k = np.flatnonzero(going)
        if not k.size:
            break
        down = np.einsum("sri,sr->si", slope[k], error[k])
        held = f.held(x[k], down)
        free = np.where(held[:, None, :], 0.0, slope[k])
        square = np.einsum("sri,srj->sij", free, free)
        size = np.einsum("sii->si", square)
        size = np.maximum(size, 1e-12 * np.maximum(size.max(axis=1, keepdims=True), 1e-300))
        square += (damping[k, None] * size)[:, :, None] * np.eye(x.shape[1])
        trial = f.moved(x[k], -np.linalg.solve(square, np.where(held, 0.0, down)[..., None])[..., 0])
        new = f(trial)
        better = new.cost < cost[k]
        gain = cost[k] - new.cost
        damping[k] = np.where(better, np.maximum(damping[k] / 5, 1e-15), damping[k] * 4)
        going[k] = np.where(better, gain > SMALLEST * cost[k], damping[k] < 1 / SMALLEST)
        b = k[better]
        x[b], cost[b], error[b], slope[b] = (a[better] for a in (trial, *new))
    return x, cost
