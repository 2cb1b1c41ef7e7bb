"""Outcome of each position: runs that are not solved, both sides of reversals, the largest of all."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from dalembert.arrays import Array, first_largest
from dalembert.errors import SOLVED, STATUSES

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def problems(r: Result) -> list[tuple[str, str, str]]:
    """Runs of positions that are not solved: which ("3" or "3-7", counted from 1), status, sentence."""
    out: list[tuple[str, str, str]] = []
    start = 0
    for k in range(1, len(r.status) + 1):
        status, reason = r.status[start], r.reasons[start]
        if k < len(r.status) and (r.status[k], r.reasons[k]) == (status, reason):
            continue
        if status not in SOLVED:
            which = str(start + 1) if k == start + 1 else f"{start + 1}-{k}"
            out.append((which, status, reason or STATUSES[status].sentence))
        start = k
    return out


def span(r: Result, read: Callable[[Result], Array]) -> tuple[Array, Array]:
    """Low and high, number by number, of what is read of the results just before and just after reversals.

    >>> import dalembert as da
    >>> r = da.statics(da.four_bar())
    >>> low, high = span(r, lambda side: side.effort("O2"))
    >>> bool((low == high).all())
    True
    """
    values = [read(side) for side in r.sides]
    return np.minimum(values[0], values[-1]), np.maximum(values[0], values[-1])


def worst(r: Result, quantity: str, of: str) -> tuple[float, int]:
    """Largest magnitude of an effort, reaction or moment, and its position; NaN and -1 where none is known."""
    read: dict[str, Callable[[Result], Array]] = {
        "effort": lambda side: side.effort(of),
        "reaction": lambda side: side.reaction(of),
        "moment": lambda side: side.reaction_moment(of),
    }
    values = np.fmax.reduce([size(read[quantity](side)) for side in r.sides])
    if np.isnan(values).all():
        return float("nan"), -1
    return float(np.nanmax(values)), first_largest(values)


def size(values: Array) -> Array:
    """Magnitudes (P,) of numbers (P,) or vectors (P, d)."""
    return np.asarray(np.abs(values) if values.ndim == 1 else np.linalg.norm(values, axis=-1))
