"""Reductions over the positions: their parts inside the kernel, what is made of them, and the same in numpy."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.errors import ModelError
from dalembert.kernel.emit.reductions import PLACED, TIE

PARTS: dict[str, tuple[str, ...]] = {
    "peak": ("peak",),
    "mean": ("sum",),
    "rms": ("square",),
    "envelope": ("min", "max"),
    "argpeak": ("argpeak",),
    "norm8": ("power8",),
    "refined_peak": ("argpeak",),
    "refined_place": ("argpeak",),
    "squares": ("square",),
}
"""Largest magnitude; mean; root mean square; (least, largest); place of the largest magnitude, from 0; a smooth
approximation of the peak, the eighth root of the mean of the eighth powers; and the peak between the positions, by a
parabola through the largest magnitude and its neighbours, and its place; the sum of squares, of the differences to a
target if one is given."""

POWER = {"rms": 2, "norm8": 8}
"""Reductions that are means of powers, with their root taken."""
SUMS = {"mean": 1, "squares": 2, **POWER}
"""Reductions that are made of sums of powers."""
REFINED = ("refined_peak", "refined_place")
PLACES = ("argpeak", "refined_place")
"""Reductions that are places among the positions."""


def check(reduce: str | None) -> None:
    if reduce is not None and reduce not in PARTS:
        raise ModelError(f"unknown reduction {reduce!r}", "use one of " + ", ".join(PARTS))


def with_places(reduce: str) -> tuple[str, ...]:
    """The parts with the places where they are taken, for gradients."""
    return tuple("arg" + p if "arg" + p in PLACED else p for p in PARTS[reduce])


def finish_reduction(reduce: str, parts: list[Array], count: int) -> Array:
    """The reduction from its parts (design, ...); the envelope with a last axis (least, largest)."""
    if reduce == "envelope":
        return np.stack(parts, axis=-1)
    if reduce == "mean":
        return parts[0] / count
    if reduce in POWER:
        return np.asarray((parts[0] / count) ** (1 / POWER[reduce]))
    return np.asarray(parts[0])


def is_cycle(position: Array, turns: Sequence[bool]) -> bool:
    """True if positions (P, D) form a cycle: the step after the last leads to the first, full turns away where a
    drive turns. Raises ModelError where they are not evenly spaced, because a parabola through neighbours needs even
    steps."""
    if len(position) < 3:
        return False
    steps = np.diff(position, axis=0)
    size = np.abs(steps).max(axis=0)
    if (np.ptp(steps, axis=0) > 1e-6 * size).any():
        raise ModelError(
            "the positions are not evenly spaced, and a peak is refined between even ones", 'reduce by "peak"'
        )
    advance = len(position) * steps.mean(axis=0)
    over = np.where(turns, advance - 2 * np.pi * np.rint(advance / (2 * np.pi)), advance)
    return bool((np.abs(over) <= 1e-6 * np.maximum(size, 1e-300)).all())


class Parabola(NamedTuple):
    """Parabola through three values, side by side: place of its vertex from the middle one, Lagrange's weights at it
    (also the derivatives of the vertex), and derivatives of the place; first axis the three values."""

    place: Array
    weights: Array
    place_slope: Array


def parabola(values: Array, inner: Flags) -> Parabola:
    """Parabola of values (3, ...), the middle one the largest or the least; the middle itself where not ``inner``."""
    before, middle, after = values
    bend = before - 2 * middle + after
    flat = ~inner | (bend == 0) | ~np.isfinite(bend)
    bend = np.where(flat, 1.0, bend)
    rise = np.where(flat, 0.0, after - before)
    x = np.clip(-rise / (2 * bend), -0.5, 0.5)
    weights = np.stack([x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2])
    slope = np.stack([(1 - 2 * x) / (2 * bend), 2 * x / bend, -(1 + 2 * x) / (2 * bend)])
    return Parabola(x, weights, np.where(flat, 0.0, slope))


def neighbours(place: Ints, count: int, cycle: bool) -> tuple[Ints, Flags]:
    """Places (3, ...) before, at and behind some, and whether there are such."""
    three = place + np.array([-1, 0, 1]).reshape(-1, *(1,) * place.ndim)
    inner = (three >= 0).all(axis=0) & (three < count).all(axis=0) | (cycle and count > 2)
    return three % count, inner


def refine(reduce: str, place: Array, values: Array, inner: Flags, count: int) -> Array:
    """The refined peak, or its place, from values (3, ...) at a place and its neighbours."""
    peak = parabola(values, inner)
    if reduce == "refined_peak":
        return np.asarray(np.abs((peak.weights * values).sum(axis=0)))
    return np.asarray((place + peak.place) % count)


def refined_slope(reduce: str, values: Array, rates: Array, inner: Flags) -> Array:
    """Derivatives (..., number) of that, from those of the values (3, ..., number)."""
    peak = parabola(values, inner)
    if reduce == "refined_peak":
        return np.asarray(np.sign(values[1])[..., None] * (peak.weights[..., None] * rates).sum(axis=0))
    return np.asarray((peak.place_slope[..., None] * rates).sum(axis=0))


def _refined(reduce: str, values: Array, cycle: bool) -> tuple[Ints, Array, Flags]:
    """Places (3, component) about the peaks of values (position, component), the values at them, and which are
    inner."""
    peaks = _first_largest(np.nan_to_num(np.abs(values)))
    three, inner = neighbours(peaks, len(values), cycle)
    return three, values[three, np.arange(values.shape[1])], inner


def _first_largest(values: Array) -> Ints:
    """Places (...) of the largest of values (position, ...): of equal ones the first, as in the kernel."""
    largest = values.max(axis=0)
    return np.asarray((values >= largest - TIE * np.abs(largest)).argmax(axis=0))


def reduce_positions(reduce: str, values: Array, cycle: bool = False) -> Array:
    """The reduction of values (position, ...) over their first axis; ``cycle``: behind the last position is the
    first. Raises ModelError for an unknown one."""
    check(reduce)
    if reduce in REFINED:
        table = values.reshape(len(values), -1)
        three, near, inner = _refined(reduce, table, cycle)
        reduced = refine(reduce, three[1], near, inner, len(values))
        return np.where(np.isnan(table).any(axis=0), np.nan, reduced).reshape(values.shape[1:])
    size = np.abs(values)
    if reduce == "peak":
        return np.asarray(size.max(axis=0))
    if reduce == "argpeak":
        return _first_largest(size).astype(float)
    if reduce == "envelope":
        return np.stack([values.min(axis=0), values.max(axis=0)], axis=-1)
    if reduce == "mean":
        return np.asarray((values / len(values)).sum(axis=0))
    if reduce == "squares":
        return np.asarray((values**2).sum(axis=0))
    power = POWER[reduce]
    largest = np.where((peak := size.max(axis=0)) > 0, peak, 1.0)  # so that no power overflows
    mean: Array = ((values / largest) ** power).mean(axis=0)
    return np.asarray(largest * mean ** (1 / power))


def reduce_sides(reduce: str, sides: Sequence[Array], cycle: bool = False) -> Array:
    """The reduction of values just before reversals and just after them, or of the same ones; of places among the
    positions. No parabola goes from one side to the other; of squares each side has half."""
    if reduce in REFINED:
        return reduce_positions(reduce, larger_side(sides, sides), cycle)
    reduced = reduce_positions(reduce, np.concatenate(sides))
    if reduce == "squares":
        return reduced / len(sides)
    return reduced % len(sides[0]) if reduce == "argpeak" else reduced


def larger_side(by: Sequence[Array], sides: Sequence[Array]) -> Array:
    """The one of one or two arrays whose place in ``by`` has the larger magnitude; these may have fewer axes."""
    if len(sides) == 1:
        return sides[0]
    second = np.abs(by[1]) > np.abs(by[0])
    return np.where(second.reshape(second.shape + (1,) * (sides[0].ndim - second.ndim)), sides[1], sides[0])


EXTREMES = {"least": (1.0, 0.0), "greatest": (0.0, 1.0), "range": (-1.0, 1.0)}
"""Reductions that are sums of both ends of the envelope, with their factors."""


def reduce_cycle(word: str, values: Array) -> Array:
    """A reduction of expressions, a word of `REDUCTIONS`, over the first axis; a single number is a cycle of one."""
    values = np.atleast_1d(values)
    if word == "final":
        return np.asarray(values[-1])
    if word in EXTREMES:
        return np.asarray(reduce_positions("envelope", values) @ np.array(EXTREMES[word]))
    return reduce_positions(word, values)


def cycle_slope(word: str, values: Array, rates: Array) -> Array:
    """Derivatives (component, number) of that, from those of values (position, component); of a peak, a range and an
    extreme at the position where it is now, which is one-sided where two positions are equal."""
    if word == "final":
        return np.asarray(rates[-1])
    if word in EXTREMES:
        return np.asarray(np.einsum("cen,e->cn", slope("envelope", values, rates), EXTREMES[word]))
    return slope(word, values, rates)


def slope(reduce: str, values: Array, rates: Array, cycle: bool = False) -> Array:
    """Derivatives (component[, side of the envelope], number) of the reduction of values (position, component), from
    theirs (position, component, number)."""
    if reduce in REFINED:
        three, near, inner = _refined(reduce, values, cycle)
        return refined_slope(reduce, near, rates[three, np.arange(values.shape[1])], inner)
    if reduce == "mean":
        return np.asarray(rates.mean(axis=0))
    if reduce == "squares":
        return np.asarray(2 * (values[..., None] * rates).sum(axis=0))
    if reduce in POWER:
        size = reduce_positions(reduce, values)
        size[~rates.any(axis=(0, 2))] = 1.0  # always zero
        with np.errstate(all="ignore"):
            return np.asarray(((values / size)[..., None] ** (POWER[reduce] - 1) * rates).mean(axis=0))
    each = np.arange(values.shape[1])
    if reduce == "envelope":
        return np.stack([rates[_first_largest(end), each] for end in (-values, values)], axis=1)
    place = _first_largest(np.abs(values))
    return np.asarray(np.sign(values[place, each])[:, None] * rates[place, each])
