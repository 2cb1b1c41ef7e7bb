"""A straight elastic beam by finite elements (Hermite's cubics): stiffness, mass, and its natural frequencies.

Between masses at points the elements are exact; with mass along the beam the error of a frequency falls with the fourth
power of their length.

Source: Bathe, Finite Element Procedures, section 4.2; docs/theory.md 10.4.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from dalembert.arrays import Array


@dataclass(frozen=True)
class PointMass:
    """A disc at a place: mass, kg, and moments of inertia about a diameter and about the shaft, kg m2."""

    place: float
    mass: float
    diametral: float = 0.0
    polar: float = 0.0


@dataclass(frozen=True)
class SpreadMass:
    """Mass per length, kg/m, from one place to another, with the inertia per length of the section, kg m."""

    start: float
    end: float
    density: float
    diametral: float = 0.0
    polar: float = 0.0


@dataclass(frozen=True)
class Beam:
    """A beam from 0 to ``length``, held in place at ``pins`` and clamped at ``clamps``; ``steps``: ends of its pieces,
    and their stiffness E I, N m2."""

    length: float
    steps: Sequence[tuple[float, float]]
    pins: Sequence[float]
    clamps: Sequence[float] = ()
    points: Sequence[PointMass] = ()
    spread: Sequence[SpreadMass] = ()

    def nodes(self, count: int) -> Array:
        """Ends of about ``count`` elements, among them all places where something begins."""
        fixed = [0.0, self.length, *self.pins, *self.clamps, *(p.place for p in self.points)]
        fixed += [x for m in self.spread for x in (m.start, m.end)]
        fixed += [end for end, _ in self.steps[:-1]]
        some = np.unique(np.round(np.array(fixed) / self.length, 12)) * self.length
        parts = [np.linspace(a, b, 2 + int(count * (b - a) / self.length))[:-1] for a, b in pairwise(some)]
        return np.concatenate([*parts, some[-1:]])

    def stiffness_at(self, s: float) -> float:
        """E I at a place."""
        return next((of for end, of in self.steps if s <= end), self.steps[-1][1])


@dataclass(frozen=True)
class BeamModel:
    """Stiffness, and masses that move (``carried``) and that tilt with the gyroscopic effect of synchronous whirl, over
    deflection and slope at each node (2 N); ``free``: those that no bearing holds."""

    beam: Beam
    nodes: Array
    stiffness: Array
    carried: Array
    tilting: Array
    free: Array

    def modes(self, mass: Array, count: int) -> tuple[Array, Array]:
        """The lowest ``count`` angular frequencies, rad/s, and shapes (2 N, count), of a mass matrix."""
        from scipy.linalg import eigh

        solver: Any = eigh
        inside = np.ix_(self.free, self.free)
        squares, shapes = solver(mass[inside], self.stiffness[inside])
        order = np.argsort(squares)[::-1]
        order = order[squares[order] > 1e-12 * max(squares.max(), 0.0)][:count]
        out = np.zeros((len(mass), len(order)))
        out[self.free] = shapes[:, order]
        return 1 / np.sqrt(squares[order]), out

    def pushed(self, force: Array) -> Array:
        """Deflections and slopes (2 N) under forces and couples (2 N) at the nodes."""
        out = np.zeros(len(force))
        out[self.free] = np.linalg.solve(self.stiffness[np.ix_(self.free, self.free)], force[self.free])
        return out


def beam_model(beam: Beam, count: int) -> BeamModel:
    """A beam in about ``count`` elements."""
    x = beam.nodes(count)
    n = 2 * len(x)
    stiffness, carried, tilting = (np.zeros((n, n)) for _ in range(3))
    for k, (a, b) in enumerate(pairwise(x)):
        h, at = b - a, slice(2 * k, 2 * k + 4)
        stiffness[at, at] += beam.stiffness_at((a + b) / 2) / h**3 * _bent(h)
        for m in beam.spread:
            if m.start <= (a + b) / 2 <= m.end:
                carried[at, at] += m.density * h / 420 * _moved(h)
                tilting[at, at] += (m.diametral - m.polar) / (30 * h) * _tilted(h)
    for p in beam.points:
        k = 2 * int(np.argmin(np.abs(x - p.place)))
        carried[k, k] += p.mass
        tilting[k + 1, k + 1] += p.diametral - p.polar
    held = [2 * int(np.argmin(np.abs(x - s))) for s in (*beam.pins, *beam.clamps)]
    held += [2 * int(np.argmin(np.abs(x - s))) + 1 for s in beam.clamps]
    return BeamModel(beam, x, stiffness, carried, tilting, np.setdiff1d(np.arange(n), held))


def _bent(h: float) -> Array:
    return np.array(
        [
            [12, 6 * h, -12, 6 * h],
            [6 * h, 4 * h * h, -6 * h, 2 * h * h],
            [-12, -6 * h, 12, -6 * h],
            [6 * h, 2 * h * h, -6 * h, 4 * h * h],
        ]
    )


def _moved(h: float) -> Array:
    return np.array(
        [
            [156, 22 * h, 54, -13 * h],
            [22 * h, 4 * h * h, 13 * h, -3 * h * h],
            [54, 13 * h, 156, -22 * h],
            [-13 * h, -3 * h * h, -22 * h, 4 * h * h],
        ]
    )


def _tilted(h: float) -> Array:
    return np.array(
        [
            [36, 3 * h, -36, 3 * h],
            [3 * h, 4 * h * h, -3 * h, -h * h],
            [-36, -3 * h, 36, -3 * h],
            [3 * h, -h * h, -3 * h, 4 * h * h],
        ]
    )
