"""Reductions over the positions: their parts inside the kernel, what is made of them, and the same in numpy."""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.kernel.emit.reductions import PLACED

PARTS: dict[str, tuple[str, ...]] = {
    "peak": ("peak",),
    "mean": ("sum",),
    "rms": ("square",),
    "envelope": ("min", "max"),
    "argpeak": ("argpeak",),
    "norm8": ("power8",),
}
"""Largest magnitude; mean; root mean square; (least, largest); place of the largest magnitude, from 0; and the smooth
stand-in of the peak, the eighth root of the mean of the eighth powers."""


def check(reduce: str | None) -> None:
    if reduce is not None and reduce not in PARTS:
        raise ModelError(f"there is no reduction {reduce!r}", "there are: " + ", ".join(PARTS))


def with_places(reduce: str) -> tuple[str, ...]:
    """The parts with the places where they are taken, for gradients."""
    return tuple("arg" + p if "arg" + p in PLACED else p for p in PARTS[reduce])


def finish_reduction(reduce: str, parts: list[Array], count: int) -> Array:
    """The reduction from its parts (design, ...); the envelope with a last axis (least, largest)."""
    if reduce == "envelope":
        return np.stack(parts, axis=-1)
    if reduce == "mean":
        return parts[0] / count
    if reduce == "rms":
        return np.asarray(np.sqrt(parts[0] / count))
    if reduce == "norm8":
        return np.asarray((parts[0] / count) ** 0.125)
    return np.asarray(parts[0])


def reduce_positions(reduce: str, values: Array) -> Array:
    """The reduction of values over their first axis."""
    size = np.abs(values)
    if reduce == "peak":
        return np.asarray(size.max(axis=0))
    if reduce == "argpeak":
        return np.asarray(size.argmax(axis=0).astype(float))
    if reduce == "envelope":
        return np.stack([values.min(axis=0), values.max(axis=0)], axis=-1)
    if reduce == "mean":
        return np.asarray((values / len(values)).sum(axis=0))
    power = 2 if reduce == "rms" else 8
    largest = np.where((peak := size.max(axis=0)) > 0, peak, 1.0)  # so that no power overflows
    mean: Array = ((values / largest) ** power).mean(axis=0)
    return np.asarray(largest * mean ** (1 / power))


def slope(reduce: str, values: Array, rates: Array) -> Array:
    """Derivatives (component[, side of the envelope], number) of the reduction of values (position, component), from
    theirs (position, component, number)."""
    if reduce == "mean":
        return np.asarray(rates.mean(axis=0))
    if reduce in ("rms", "norm8"):
        power = 2 if reduce == "rms" else 8
        size = reduce_positions(reduce, values)
        size[~rates.any(axis=(0, 2))] = 1.0  # always zero
        with np.errstate(all="ignore"):
            return np.asarray(((values / size)[..., None] ** (power - 1) * rates).mean(axis=0))
    each = np.arange(values.shape[1])
    if reduce == "envelope":
        return np.stack(
            [rates[place, each] for place in (values.argmin(axis=0), values.argmax(axis=0))], axis=1
        )
    place = np.abs(values).argmax(axis=0)
    return np.asarray(np.sign(values[place, each])[:, None] * rates[place, each])
