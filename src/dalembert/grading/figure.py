"""One figure of a sheet beside what is computed: a number, both sides of a reversal, or at rest two ends.

Mechanics: docs/theory.md 12.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.grading.file_answers import (
    computed_text,
    describe_answer,
    position_of,
    read,
    reason_at,
    sides_of,
    target,
    value_text,
)
from dalembert.grading.quantities import Series, component
from dalembert.grading.tolerance import Closeness, Target, closeness
from dalembert.unit_names import unit
from dalembert.units import KINDS, NUMBER, Units, file_units

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import StatedAnswer

NOTHING = 1e-9
"""Part of the machine's largest force, or rate, below which a computed one is zero."""


@dataclass(frozen=True)
class StudentValue:
    """A figure as given, and the values (SI) that are right: of an interval its two ends."""

    answer: StatedAnswer
    series: Series
    position: int
    given: Target
    close: Closeness
    right: tuple[Array, ...]
    interval: bool
    computed: str
    reason: str

    @property
    def judged(self) -> bool:
        """True if there is a value to compare with."""
        return bool(self.right)

    @cached_property
    def met(self) -> bool:
        """True if the figure is right."""
        if self.impossible:
            return False
        if self.interval:
            low, high = sorted(float(v) for v in self.right)
            if low <= float(self.given.value) <= high:
                return True
        return self.holds(self.right)

    def holds(self, values: tuple[Array, ...]) -> bool:
        """True if the figure is one of some values."""
        return any(self.close.holds(v) for v in values)

    @cached_property
    def off(self) -> float:
        """Relative difference from the nearest right value; 0 within an interval."""
        if self.met and self.interval:
            return 0.0
        return min((self.close.off(v) for v in self.right), default=np.nan)

    @property
    def impossible(self) -> str:
        """Why no computation can give the figure."""
        if self.answer.component == "magnitude" and float(self.given.value) < 0:
            return "a magnitude is never negative; the direction or the components give the sense"
        if self.given.polar and str(self.answer.value).lstrip().startswith("-"):
            return "a magnitude is never negative: the opposite sense is a direction turned by 180 deg"
        return ""

    @property
    def words(self) -> str:
        """Description of the figure."""
        return describe_answer(self.answer)

    @property
    def written(self) -> str:
        """The figure as it was given."""
        return value_text(self.answer.value)


def figure(result: Result, answer: StatedAnswer, tolerance: object = None) -> StudentValue:
    """A student's figure beside the computed values; ModelError where it cannot be read."""
    series = read(sides_of(result, answer)[0], answer)
    units = file_units(result.mechanism.units)
    position = position_of(result, answer, series)
    student = target(answer.value, series, units, "value")
    if not np.isfinite(student.value).all():
        raise ModelError(f"{value_text(answer.value)!r} is not a finite number", "write one", ("value",))
    close = closeness(answer, student, series.kind, units, tolerance, floor(result, series.kind))
    right, interval = values_of(result, answer, position)
    shown = [computed_text(v, student, series.kind, units, answer.value) for v in right]
    text = (" to " if interval else " or ").join(dict.fromkeys(shown)) or "-"
    return StudentValue(
        answer,
        series,
        position,
        student,
        close,
        right,
        interval,
        text,
        "" if right else why(result, position),
    )


def figure_of_key(answer: StatedAnswer, right: StatedAnswer, tolerance: object = None) -> StudentValue:
    """A student's figure beside the value of a key alone; the unit of that value gives its kind."""
    units = Units()
    kind = _kind_of(right.value)
    vector = right.component is None and (isinstance(right.value, tuple) or "@" in str(right.value))
    size = len(right.value) if isinstance(right.value, tuple) else 2
    series = Series(kind, np.zeros((1, size)) if vector else np.zeros(1))
    known = target(right.value, series, units, "value").value
    if answer.component != right.component:
        known_series = component(Series(kind, known[None]), answer.component)
        series, known = Series(known_series.kind, np.zeros(1)), np.asarray(known_series.values[0])
    student = target(answer.value, series, units, "value")
    close = closeness(answer, student, series.kind, units, tolerance)
    text = computed_text(known, student, series.kind, units, answer.value)
    return StudentValue(answer, series, 0, student, close, (known,), False, text, "")


def _kind_of(value: object) -> str:
    """The kind of a number by its unit; a moment before an energy."""
    first = value[0] if isinstance(value, tuple) else str(value).partition("@")[0]
    name = re.sub(rf"^\s*(?>{NUMBER})", "", str(first)).strip()
    dimension = unit(name).dimension if name else KINDS["number"].dimension
    return next((k for k, kind in KINDS.items() if kind.dimension == dimension), "number")


def why(result: Result, position: int) -> str:
    """Reason why a position has no number."""
    return reason_at(result, position) or "it depends on the elasticity of the links"


def values_of(result: Result, answer: StatedAnswer, position: int) -> tuple[tuple[Array, ...], bool]:
    """Right values of an answer at a position, without missing ones: one value, two at a reversal, at rest those of
    both ends; and whether everything between the two is right as well."""
    if answer.extreme is not None:
        extremes = [read(side, answer) for side in sides_of(result, answer)]
        return _numbers([s.values[position_of(result, answer, s)] for s in extremes]), False
    some = _numbers([read(side, answer).values[position] for side in sides_of(result, answer)])
    if some or not result.ends:
        return some, False
    if answer.quantity in ("effort", "unknown_load"):
        ends = component(Series("", result.interval(str(answer.of))[position]), answer.component)
        numbers = _numbers(list(ends.values))
        return numbers, answer.component is None and len(numbers) == 2
    return _numbers([read(end, answer).values[position] for pair in result.ends for end in pair]), False


def _numbers(values: list[Array]) -> tuple[Array, ...]:
    arrays = [np.asarray(v, dtype=float) for v in values]
    finite = [v for v in arrays if np.isfinite(v).all()]
    return tuple(v for k, v in enumerate(finite) if not any(np.array_equal(v, w) for w in finite[:k]))


def floor(result: Result, kind: str) -> float:
    """Rounding level of a kind, beside the largest force or rate of the machine."""
    g, length = result.compiled.layout.algebra, result.compiled.layout.length

    def largest(*arrays: Array) -> float:
        return max((float(np.nanmax(np.abs(a))) for a in arrays if np.isfinite(a).any()), default=0.0)

    def rate(a: Array) -> float:
        return max(largest(a[..., : g.d]) / length, largest(a[..., g.d :]))

    if kind in ("force", "moment"):
        force = max(largest(result.force_array, result.load_array), largest(result.moment_array) / length)
        return NOTHING * force * (length if kind == "moment" else 1.0)
    speed = rate(result.twist_array)
    sizes = {"length": length, "speed": speed * length, "angular_speed": speed}
    if kind.endswith("acceleration"):
        fastest = max(rate(result.acceleration_array), speed * speed)
        return NOTHING * fastest * (1.0 if kind.startswith("angular") else length)
    return NOTHING * sizes.get(kind, 0.0)
