"""From metres of the machine to millimetres of paper, and round scales."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from dalembert.arrays import Array
from dalembert.views.paper.scene import Point

STEPS = (1.0, 2.0, 2.5, 5.0, 10.0)
FINE = (1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)


@dataclass(frozen=True)
class PaperFrame:
    """Metres per millimetre of paper, about a centre."""

    per_mm: float
    middle: Point = (0.0, 0.0)

    def __call__(self, p: Point | Array) -> Point:
        """A place of the machine (metres) on paper."""
        return (
            (float(p[0]) - self.middle[0]) / self.per_mm,
            (float(p[1]) - self.middle[1]) / self.per_mm,
        )

    def line(self, path: Array) -> tuple[Point, ...]:
        """Places of the machine (N, 2) on paper."""
        return tuple(map(tuple, ((path - self.middle) / self.per_mm).tolist()))

    def length(self, metres: float) -> float:
        """A length on paper."""
        return metres / self.per_mm


def fit_frame(
    points: Iterable[Point | Array], width: float, height: float, factor: float = 1.0
) -> PaperFrame:
    """The frame that shows all points (metres) in a space on paper; scale in round numbers of the reader's unit.

    ``factor`` is the size of that unit in metres.
    """
    p = np.array([*points], float).reshape(-1, 2)
    p = p[np.isfinite(p).all(axis=1)]
    if not len(p):
        return PaperFrame(1.0)
    low, high = p.min(axis=0), p.max(axis=0)
    need = max((high[0] - low[0]) / width, (high[1] - low[1]) / height)
    if need <= 0:
        return PaperFrame(0.001, (float(low[0]), float(low[1])))
    middle = (low + high) / 2
    return PaperFrame(round_up(need / factor, FINE) * factor, (float(middle[0]), float(middle[1])))


def round_up(value: float, steps: Sequence[float] = STEPS) -> float:
    """The next of 1, 2, 2.5, 5 (or of other steps) times a power of ten.

    >>> round_up(0.031), round_up(1.0), round_up(730.0)
    (0.05, 1.0, 1000.0)
    """
    if not value > 0 or not math.isfinite(value):
        return 1.0
    power = math.floor(math.log10(value) + 1e-12)
    for step in steps:
        if step * 10.0**power >= value * (1 - 1e-12):
            return float(f"{step * 10.0**power:.6g}")
    return float(f"{10.0 ** (power + 1):.6g}")


def force_scale(sizes: Sequence[float], longest: float, factor: float = 1.0) -> float:
    """SI units per millimetre so that the largest arrow is at most ``longest`` mm, in round numbers."""
    largest = max((s for s in sizes if math.isfinite(s)), default=0.0)
    return round_up(largest / longest / factor, FINE) * factor if largest > 0 else factor
