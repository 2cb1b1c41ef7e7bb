"""When a student's figure is right: near the computed value, or rounded from it to the digits that were written.

Mechanics: docs/theory.md 12.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import ModelError, errors_at
from dalembert.unit_names import unit
from dalembert.units import NUMBER, Units, quantity
from dalembert.wording import quote_value

if TYPE_CHECKING:
    from dalembert.model import StatedAnswer


NEAR = 0.005
"""Relative difference (of angles: radians) up to which a figure is right, or a mistake explains it."""

COARSE = 0.01
"""Relative difference up to which rounding to the digits written excuses a figure: two digits at least."""

DIRECTION = math.radians(0.5)
"""The same for an angle: one rounded to degrees is excused, one to tens of degrees is not."""

MOST_PERCENT = 50
"""The largest tolerance: beyond it a figure says nothing."""

EDGE = 1 + 1e-9
"""A figure half a unit of its last digit away is rounded."""


class Target(NamedTuple):
    """A published value: SI number or vector, the unit and the form it was written in."""

    value: Array
    unit: str
    polar: bool


def half_unit(number: str) -> float:
    """Half a unit of the last digit of a number as it is written.

    >>> half_unit("155"), half_unit("0.20"), half_unit("1.55e3")
    (0.5, 0.005, 5.0)
    """
    digits, _, exponent = number.lower().partition("e")
    decimals = len(digits.partition(".")[2])
    return float(0.5 * 10.0 ** (int(exponent or 0) - decimals))


@dataclass(frozen=True)
class Closeness:
    """Allowed distance of a value from a figure: within a relative ``near``, or where no tolerance was stated within
    ``halves`` units of its last digits (of each component; of a polar figure of its size and its direction).

    ``stated``: a tolerance is given, so that rounding is not excused; ``floor``: rounding level beside the other
    forces, or rates, of the machine.
    """

    given: Array
    kind: str
    near: float
    halves: tuple[float, ...]
    polar: bool
    stated: bool = False
    floor: float = 0.0

    def off(self, value: Array) -> float:
        """Relative difference; of an angle the difference over one radian."""
        difference = (value - self.given).ravel()
        if self.kind == "angle":
            return max(abs(math.remainder(d, math.tau)) for d in difference.tolist())
        away = math.hypot(*difference.tolist())
        size = self._size or math.hypot(*value.ravel().tolist()) or 1.0
        return 0.0 if away <= self.floor else away / size

    @cached_property
    def _size(self) -> float:
        return math.hypot(*self.given.ravel().tolist())

    def holds(self, value: Array) -> bool:
        """True if a value is the figure."""
        rounded = not self.stated and bool(self.halves) and self._rounds(value, self.near)
        return rounded or self.off(value) <= self.near

    def is_rounded(self, value: Array) -> bool:
        """True if the figure is the value rounded to its digits, without any further tolerance."""
        return bool(self.halves) and self._rounds(value, 0.0)

    def _rounds(self, value: Array, near: float) -> bool:
        if self.kind == "angle":
            return self.off(value) <= EDGE * min(self.halves[0], DIRECTION)
        size = self._size

        def room(half: float) -> float:
            return EDGE * max(near * size, min(half, COARSE * size))

        if self.polar:
            (x, y), (a, b) = value.tolist(), self.given.tolist()
            turned = abs(math.remainder(math.atan2(y, x) - math.atan2(b, a), math.tau))
            straight = turned <= EDGE * max(near, min(self.halves[1], DIRECTION))
            return straight and abs(math.hypot(x, y) - size) <= room(self.halves[0])
        distances = np.abs(value - self.given).ravel().tolist()
        return all(d <= room(h) for d, h in zip(distances, self.halves, strict=True))


def closeness(
    answer: StatedAnswer,
    target: Target,
    kind: str,
    units: Units,
    tolerance: object = None,
    floor: float = 0.0,
) -> Closeness:
    """Allowed distance of a value from an answer: by its tolerance, or that of the sheet, if one is given, else by its
    digits."""
    stated = answer.tolerance if answer.tolerance is not None else tolerance
    halves = _halves(answer.value, target, kind, units)
    if stated is None:
        return Closeness(target.value, kind, NEAR, halves, target.polar, floor=floor)
    size = math.hypot(*target.value.ravel().tolist())
    return Closeness(
        target.value, kind, relative(stated, size, kind, units), halves, target.polar, True, floor
    )


def relative(tolerance: object, size: float, kind: str, units: Units) -> float:
    """A tolerance in percent, or as a quantity of the same kind, over a size; of an angle in radians.

    >>> relative("3 %", 200.0, "force", Units()), relative("6 N", 200.0, "force", Units())
    (0.03, 0.03)
    """
    if isinstance(tolerance, str) and tolerance.strip().endswith("%"):
        return percent(tolerance)
    with errors_at("tolerance"):
        allowed = quantity(tolerance, kind, units)
        if allowed < 0:
            raise ModelError(
                f"{quote_value(tolerance)} is below 0", "write one of 0 or more, for example 3 %"
            )
    return allowed if kind == "angle" else allowed / (size or 1.0)


def percent(tolerance: object, key: str = "tolerance", most: float | None = MOST_PERCENT) -> float:
    """A tolerance in percent as a fraction: 0 to 50 %.

    >>> percent("3 %")
    0.03
    """
    number = re.fullmatch(rf"({NUMBER})\s*%", str(tolerance).strip())
    if number is None or not 0 <= float(number[1]) <= (most or math.inf):
        what = f"{quote_value(tolerance)} is not a tolerance in percent"
        remedy = f"write one from 0 to {most} %, for example 3 %" if most else "write one, for example 0.3 %"
        raise ModelError(what, remedy, (key,))
    return float(number[1]) / 100


def _halves(value: object, target: Target, kind: str, units: Units) -> tuple[float, ...]:
    """Half units of the last digits in SI: of each component, or of a size and a direction."""
    if target.value.ndim > 1:
        return ()
    if target.polar:
        size, _, direction = str(value).partition("@")
        size_half = _in_si(size, float(np.hypot(*target.value)))
        return (size_half, _angle_half(direction, str(value), units))
    if kind == "angle":
        return (_angle_half(str(value), str(value), units),)
    parts = value if isinstance(value, (list, tuple)) else [value]
    return tuple(_in_si(str(p), float(v)) for p, v in zip(parts, np.atleast_1d(target.value), strict=True))


def _in_si(text: str, value: float) -> float:
    """Half a unit of the last digit of a text whose number represents a value; 0 where that is 0."""
    match = re.search(NUMBER, text)
    if match is None or not float(match[0]):
        return 0.0
    return half_unit(match[0]) * value / float(match[0])


def _angle_half(text: str, unit_text: str, units: Units) -> float:
    match = re.search(NUMBER, text)
    if match is None:
        return 0.0
    return radians(half_unit(match[0]), unit_text, units)


def radians(angle: float, text: str, units: Units) -> float:
    """An angle in a text, in radians: in the text's unit, or else the file's.

    >>> radians(180.0, "155 @ 180 deg", Units(angle="rad")) == radians(math.pi, "155 @ 3.14", Units(angle="rad"))
    True
    """
    named = re.search(r"\b(deg|rad)\b", text)
    return unit(named[1] if named else units.angle).si(angle)
