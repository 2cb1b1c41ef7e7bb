"""Curves over a period as pieces of Legendre polynomials, halved until they are true: kinks and jumps included.

On a panel [a, b] the values at Gauss's points give coefficients c_k of P_k, exact integrals from a, and zeros. A panel
is halved while its last coefficients say that it is not resolved, and its width that it matters.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.polynomial import legendre

from dalembert.arrays import Array
from dalembert.errors import AnalysisError

POINTS = 12
"""Points of Gauss a panel."""
RESOLVED = 1e-13
"""Error of the integral over a panel that is let be, of that of the curve's size over the period."""
MOST_HALVINGS, MOST_PANELS = 45, 10_000
ROUNDING = 1e-15
"""Part of a series' largest coefficient below which its highest are left out."""

ENDS = np.array([-1.0, 1.0])
NODES, _ = legendre.leggauss(POINTS)
TO_COEFFICIENTS = np.linalg.inv(legendre.legvander(NODES, POINTS - 1))


@dataclass(frozen=True)
class Panels:
    """Panels [low, low + width] (K,) that follow each other, and the points in them (K, n)."""

    low: Array
    width: Array

    @cached_property
    def points(self) -> Array:
        """Gauss's points of every panel."""
        return self.low[:, None] + self.width[:, None] * (NODES + 1) / 2

    @property
    def period(self) -> float:
        """Their length together."""
        return float(self.width.sum())

    def coefficients(self, values: Array) -> Array:
        """Legendre coefficients (n, K) of values at the points (K, n)."""
        return np.asarray(TO_COEFFICIENTS @ values.T)

    def integrals(self, values: Array) -> Array:
        """Integral over each panel (K,)."""
        return np.asarray(self.width * self.coefficients(values)[0])

    def mean(self, values: Array) -> float:
        """Mean over the period."""
        return float(self.integrals(values).sum() / self.period)

    def antiderivative(self, values: Array) -> tuple[Array, Array]:
        """Integral from the period's begin at the points (K, n), and at the panels' begins and the end (K + 1,)."""
        c = self.coefficients(values)
        inside = legendre.legval(NODES, legendre.legint(c, lbnd=-1)) * self.width[:, None] / 2
        starts = np.concatenate([[0.0], np.cumsum(self.integrals(values))])
        return starts[:-1, None] + inside, starts

    def derivative(self, values: Array) -> Array:
        """Derivative at the points (K, n)."""
        return np.asarray(legendre.legval(NODES, legendre.legder(self.coefficients(values)))) * (
            2 / self.width[:, None]
        )

    def turning_points(self, values: Array, floor: float = 0.0) -> tuple[Array, Array]:
        """Turning points of the integral of a curve of mean 0, alternately greatest and least, and the integral from
        the start of the period to them; an integral that changes by less than the ``floor`` and returns has no turning
        point.

        It turns at zeros within the panels and at their edges, where the curve may jump: all are tried, so that
        rounding at an edge neither loses a zero nor counts it twice.
        """
        c, starts = self.coefficients(values), self.antiderivative(values)[1]
        at, area = [*self.low], [*starts[:-1]]
        for k in _may_vanish(c):
            real, integral = _roots(c[:, k]), legendre.legint(c[:, k], lbnd=-1)
            at += [*self._at(k, real)]
            area += [*(starts[k] + legendre.legval(real, integral) * self.width[k] / 2)]
        order = np.argsort(at, kind="stable")
        place, reached = np.array(at)[order], np.array(area)[order]
        turns = _turns(reached, floor)
        return place[turns], reached[turns]

    def extremes(self, values: Array) -> tuple[tuple[float, float], tuple[float, float]]:
        """Least and greatest value with where they are, on the curve itself."""
        c = self.coefficients(values)
        ends = np.stack([self.low, self.low + self.width], axis=1)
        pairs = ((values, self.points), (legendre.legval(ENDS, c), ends))
        candidates = [z for y, x in pairs for z in zip(y.ravel().tolist(), x.ravel().tolist(), strict=True)]
        slopes = legendre.legder(c)
        for k in _may_vanish(slopes):
            x = _roots(slopes[:, k])
            candidates += zip(legendre.legval(x, c[:, k]).tolist(), self._at(k, x).tolist(), strict=True)
        return min(candidates), max(candidates)

    def _at(self, k: Any, x: Array) -> Array:
        """Places from -1 to 1 of a panel along the period."""
        return np.asarray(self.low[k] + self.width[k] * (x + 1) / 2)


def _may_vanish(c: Array) -> Array:
    """Panels on which a Legendre series (n, K) may vanish: elsewhere c_0 is beyond all others, as |P_k| <= 1."""
    return np.flatnonzero((np.abs(c[0]) <= np.abs(c[1:]).sum(axis=0)) & c.any(axis=0))


def _roots(c: Array) -> Array:
    """Real roots of a Legendre series from -1 to 1; what is rounding of the highest coefficients makes none."""
    roots = legendre.legroots(legendre.legtrim(c, ROUNDING * float(np.abs(c).max())))
    return np.sort(roots.real[(np.abs(roots.imag) < 1e-6) & (np.abs(roots.real) <= 1)])


def _turns(values: Array, floor: float) -> list[int]:
    """Indices, rising, at which values over a period are greatest and least by turns, by more than a floor."""
    start = int(np.argmax(values))
    best, side, indices = start, 1.0, list[int]()  # side: 1 until the values have fallen and rise again
    for k in (np.arange(1, len(values) + 1) + start) % len(values):
        if side * (values[k] - values[best]) < 0:
            best = int(k)
        elif side * (values[k] - values[best]) > floor:
            indices, best, side = [*indices, best], int(k), -side
    return sorted([*indices, start] if indices else [])


def resolve(curve: Callable[[Array], Array], edges: Array, floor: float = 0.0) -> tuple[Panels, Array]:
    """Panels between edges (K + 1,), halved until a curve is resolved on each, and its values at their points.

    What is below the ``floor`` is rounding. Raises AnalysisError for a curve too rough to be followed.
    """
    low, width = edges[:-1], np.diff(edges)
    period, kept, size, count = float(width.sum()), list[tuple[Array, Array, Array]](), 0.0, 0
    for depth in range(MOST_HALVINGS + 1):
        panels = Panels(low, width)
        values = curve(panels.points.ravel()).reshape(panels.points.shape)
        size = max(size, float(np.abs(values).max(initial=0.0)))
        tail = np.abs(panels.coefficients(values)[-3:]).max(axis=0)
        true = (tail * width / period <= RESOLVED * size) | (tail <= floor) | (depth == MOST_HALVINGS)
        kept.append((low[true], width[true], values[true]))
        count += int(true.sum())
        half = width[~true] / 2
        low, width = np.concatenate([low[~true], low[~true] + half]), np.concatenate([half, half])
        if not len(low):
            break
        if count + len(low) > MOST_PANELS:
            raise AnalysisError(
                f"the effort is too rough over the cycle: over {MOST_PANELS} pieces do not resolve it"
            )
    low, width, values = (np.concatenate(x) for x in zip(*kept, strict=True))
    order = np.argsort(low)
    return Panels(low[order], width[order]), values[order]
