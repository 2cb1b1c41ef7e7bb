"""A slip in one value of a sheet, and the chance that a wrong number lies near a value.

Mechanics: docs/theory.md 12.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.arrays import Array, Tree
from dalembert.errors import DalembertError
from dalembert.grading.figure import StudentValue, values_of
from dalembert.grading.value_errors import Hypothesis, of_units, of_value
from dalembert.model import GROUND

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

SMALL = 0.03
"""Relative difference up to which a figure is nearly right."""

MUCH = 5
"""Factor by which a mistake must be nearer than the right value to explain a figure that is nearly right."""

POSSIBLE = 0.3
"""Expected coincidences up to which a mistake, or a slip, is possible."""

FINEST = 2e-4
"""Relative width below which no figure is trusted."""

SLIPS = 30
"""Slips of one value that are tried."""


class ValueSlip(NamedTuple):
    """A slip of one value: in words, its kind, the value that it leads to, and the expected coincidences."""

    sentence: str
    kind: str
    value: Array
    chance: float


def density(d: float) -> float:
    """Probability density of a wrong number at a relative distance d from the right one, per unit of distance: slips
    that are small are more frequent.

    >>> density(0.0) > density(0.3) > density(3.0)
    True
    """
    return 0.93 * math.exp(-((d / 0.3) ** 2) / 2) + 0.075 / (1 + d) ** 2


def distance(f: StudentValue, values: Sequence[Array]) -> float | None:
    """Distance of a figure from the nearest of some values that explain it, 0 if it is one of them rounded."""
    offs = [0.0 if f.close.is_rounded(v) else f.close.off(v) for v in values if explains(f, v)]
    return min(offs, default=None)


def explains(f: StudentValue, value: Array) -> bool:
    """True if a value explains a figure: one that is itself nearly right only by a value that comes much nearer."""
    return f.close.off(value) <= f.off / MUCH if f.off <= SMALL else f.close.holds(value)


def width(f: StudentValue, off: float) -> float:
    """Relative room within which a figure speaks for a value: its distance, its last digit, its tolerance."""
    return max(off, _last_digit(f), FINEST, f.close.near if f.close.stated else 0.0)


def coincidence(f: StudentValue, value: Array, off: float) -> float:
    """Chance that a wrong number lies as near to a value as the figure does."""
    right = f.right[0]
    size = float(np.linalg.norm(right)) or 1.0
    angle = f.series.kind == "angle"
    away = f.close.off(value) or 0.1 if angle else float(np.linalg.norm(value - right)) / size
    return min(1.0, 2 * width(f, off) * density(away))


def _last_digit(f: StudentValue) -> float:
    """Half a unit of the last digit of a figure, relative."""
    size = float(np.linalg.norm(f.given.value)) or 1.0
    if f.series.kind == "angle" or not f.close.halves:
        return 0.005
    if f.given.polar:
        return max(f.close.halves[0] / size, min(f.close.halves[1], 0.01))
    return max(f.close.halves) / size


def slip_of(f: StudentValue, values: Sequence[Array], result: Result | None, place: int) -> ValueSlip | None:
    """The slip that leads from some values, or from those of something else, to a figure, where chance does not.

    Of slips that lead to the same value the simplest counts: a sense, an axis, a unit before another joint or axes.
    """
    best: ValueSlip | None = None
    for h in _hypotheses(f, values, result, place):
        off = distance(f, (h.value,))
        if off is None:
            continue
        numbers = 1 if h.single else max(h.value.size, 1)
        chance = SLIPS * coincidence(f, h.value, off) ** numbers
        if chance > POSSIBLE or (best is not None and alike(f, best.value, h.value)):
            continue
        if best is None or chance < best.chance:
            best = ValueSlip(h.sentence, h.kind, h.value, chance)
    return best


def alike(f: StudentValue, one: Array, other: Array) -> bool:
    """True if a figure does not distinguish two values."""
    size = float(np.linalg.norm(f.given.value)) or 1.0
    return float(np.linalg.norm(one - other)) <= 2 * width(f, 0.0) * size


def _hypotheses(
    f: StudentValue, values: Sequence[Array], result: Result | None, place: int
) -> Iterator[Hypothesis]:
    """Slips of a figure from some values, and values of something else."""
    for value in values:
        yield from of_value(f.series, value)
        yield from of_units(f.series, value)
    if result is None:
        return
    for change, sentence in others(result, f):
        try:
            of_other, _ = values_of(result, f.answer.model_copy(update=change), place)
        except (DalembertError, IndexError):
            continue
        for value in of_other:
            if value.shape == f.right[0].shape:
                yield Hypothesis(sentence, value)


def others(result: Result, f: StudentValue) -> Iterator[tuple[Tree, str]]:
    """The right value of something else: another joint, component, or axes."""
    answer = f.answer
    if answer.quantity in ("reaction", "moment"):
        for joint in result.joints:
            if joint != answer.of:
                yield {"of": joint, "on": None, "by": None}, f"this is joint {joint}"
        for link in result.mechanism.joints[str(answer.of)].links if answer.of in result.joints else ():
            if link == GROUND:
                continue
            change = {"axes": "link", "on": link, "by": None}
            yield change, f"components are along and across link {link}, not ground axes"
    if answer.component in ("x", "y"):
        other = "y" if answer.component == "x" else "x"
        yield {"component": other}, "the angle is counted from the other axis: x for y"
        yield {"component": "magnitude"}, "this is the magnitude, not the component"
    if answer.quantity in ("angle", "speed", "acceleration", "center_acceleration", "center"):
        for link in result.links:
            if link != answer.of:
                yield {"of": link}, f"this is link {link}"
