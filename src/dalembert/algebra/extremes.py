"""Least values of functions of one number, many at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from dalembert.arrays import Array

PARTS = 64
"""Parts of an interval at whose ends a function is evaluated."""
CLOSE = 1e-9
"""Width of an interval that is not divided again."""


def least_within(of: Callable[[Array], Array], low: Array, high: Array) -> tuple[Array, Array]:
    """Least values (K,) of a function within K intervals that have one minimum each, and their places (K,).

    ``of`` takes places (N,) and gives values (N,). Each interval is divided evenly, and then the two parts beside the
    least value: one call of ``of`` for all of them, until they are narrower than ``CLOSE``. NaN where no value is one.

    >>> value, place = least_within(lambda x: (x * x - 2.0) ** 2, np.array([-2.0, 1.0]), np.array([-1.0, 2.0]))
    >>> value.round(12), place.round(6)
    (array([0., 0.]), array([-1.414214,  1.414214]))
    """
    low, high = np.array(low, float), np.array(high, float)
    value, place, each = np.full(len(low), np.nan), np.full(len(low), np.nan), np.arange(len(low))
    while len(low):
        x = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, PARTS + 1)
        y = of(x.ravel()).reshape(x.shape)
        k = np.argmin(np.where(np.isnan(y), np.inf, y), axis=1)
        better = ~(y[each, k] >= value)
        value, place = np.where(better, y[each, k], value), np.where(better, x[each, k], place)
        if not (high - low > CLOSE).any():
            break
        low, high = x[each, np.maximum(k - 1, 0)], x[each, np.minimum(k + 1, PARTS)]
    return value, place
