"""Sizes of numbers and vectors over the positions of a cycle."""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array, first_largest


def rms(values: Array) -> float:
    """Root of the mean square of numbers (P,) or of the lengths of vectors (P, d)."""
    return float(np.sqrt((np.reshape(values, (len(values), -1)) ** 2).sum(axis=1).mean()))


def greatest(values: Array) -> tuple[float, int]:
    """Largest size of numbers (P,) or vectors (P, d), and the position (from 0) of it."""
    sizes = np.sqrt((np.reshape(values, (len(values), -1)) ** 2).sum(axis=1))
    k = first_largest(sizes) if np.isfinite(sizes).any() else 0
    return float(sizes[k]), k
