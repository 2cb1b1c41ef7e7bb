"""Quantities of motions side by side whose change of sign is an event.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from dalembert.arrays import Array, Ints

ROOTS = 60
"""Trials that locate the instant of an event, at most."""


@dataclass(frozen=True)
class Guards:
    """``kind`` of each and ``which``; ``column``: its place in the state, what is watched, and the time."""

    kind: Array
    which: Ints
    column: Ints

    @classmethod
    def of(cls, rows: list[tuple[str, int, int]]) -> Guards:
        """From kind, number and column of each."""
        kinds, which, columns = zip(*rows, strict=True) if rows else ((), (), ())
        return cls(np.array(kinds, object), np.array(which, int), np.array(columns, int))

    def __len__(self) -> int:
        return len(self.kind)

    def those(self, *kinds: str) -> Ints:
        """Numbers of the guards of some kinds."""
        return np.flatnonzero(np.isin(self.kind.astype(str), kinds))


def first_root(value: Callable[[Array, Ints], Array], low: Array, high: Array, least: Array) -> Array:
    """Zeros (K,) between ``low``, where values are positive, and ``high``, where they are negative, within ``least``
    (K,) beside rounding: times on the far side, but ``low`` where the value is not positive there.

    ``value(t, k)``: values at times of the functions k. Chandrupatla, Advances in Engineering Software 28, 1997.

    >>> first_root(lambda t, k: 2 - t * t, np.array([0.0]), np.array([3.0]), np.array([0.0])).round(9)
    array([1.41421356])
    """
    every = np.arange(len(low))
    a, b = high.copy(), low.copy()
    fa, fb = value(a, every), value(b, every)
    begun, live = fb <= 0, (fb > 0) & (fa < 0)
    c, fc, part = a.copy(), fa.copy(), np.full(len(low), 0.5)
    for _ in range(ROOTS):
        k = np.flatnonzero(live)
        if not len(k):
            break
        t = a[k] + part[k] * (b[k] - a[k])
        f = value(t, k)
        same = np.sign(f) == np.sign(fa[k])
        c[k], fc[k] = np.where(same, a[k], b[k]), np.where(same, fa[k], fb[k])
        b[k], fb[k] = np.where(same, b[k], a[k]), np.where(same, fb[k], fa[k])
        a[k], fa[k] = t, f
        with np.errstate(all="ignore"):
            near = (least[k] + 4e-16 * np.abs(t)) / np.abs(b[k] - a[k])
            x, y = (a[k] - b[k]) / (c[k] - b[k]), (fa[k] - fb[k]) / (fc[k] - fb[k])
            inner = fa[k] / (fb[k] - fa[k]) * fc[k] / (fb[k] - fc[k])
            inner += (c[k] - a[k]) / (b[k] - a[k]) * fa[k] / (fc[k] - fa[k]) * fb[k] / (fc[k] - fb[k])
        live[k] = (f != 0) & (near <= 0.5)
        bends = (y**2 < x) & ((1 - y) ** 2 < 1 - x) & np.isfinite(inner)
        part[k] = np.clip(np.where(bends, inner, 0.5), near, np.maximum(1 - near, near))
    return np.asarray(np.where(begun, low, np.where(fa <= 0, a, b)))
