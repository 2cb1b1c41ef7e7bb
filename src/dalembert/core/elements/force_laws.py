"""Forces of springs by tables and of gas springs, and the record of a plane that turns.

Mechanics: docs/theory.md 4.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from dalembert.arrays import Array
from dalembert.core.branchless import larger


@dataclass(frozen=True)
class TurningFrame:
    """A plane that turns about a line in it: ``axis`` (d,) along the line, unit vector, ``at`` (d,) a point of it.

    square (P,)  of the speed; ``moments`` (L, 3): int x x, y y, x y dm about the mass centres in link axes.
    effort (P,)  of drive number ``driven``, given where the speed is unknown; -1: the speed is known
    """

    axis: Array
    at: Array
    square: Array
    moments: Array
    effort: Array
    driven: int


def by_tables(springs: Any, which: int, at: Array) -> Array:
    """Tension (..., k) of the tables over the change of length (0) or its rate (1)."""
    out = springs.start[which] + 0.0 * at
    for bend, slope in zip(springs.bends[which], springs.slopes[which], strict=True):
        out = out + slope * larger(at - bend, 0.0)
    return np.asarray(out)


def gas_push(springs: Any, length: Array) -> Array:
    """Force (..., k) of gas springs that pushes their points apart, 0 of others."""
    gas = np.flatnonzero(springs.area != 0)
    out = 0.0 * length
    for k in gas:
        area, volume = springs.area[k], springs.volume[k]
        ratio = volume / (volume - area * (springs.length[k] - length[..., k]))
        out[..., k] = area * (springs.pressure[k] * ratio ** springs.exponent[k] - springs.outside[k])
    return out
