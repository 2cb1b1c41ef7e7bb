"""When a student's figure is right: near the computed value, or rounded from it to the digits that were written."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.arrays import Array
from dalembert.unit_names import unit
from dalembert.units import NUMBER, Units

if TYPE_CHECKING:
    from dalembert.model import Answer


NEAR = 0.005
"""Relative difference (of angles: radians) up to which a figure is right, or a mistake explains it."""

COARSE = 0.01
"""Relative difference up to which rounding to the digits written excuses a figure: two digits at least."""

DIRECTION = math.radians(0.5)
"""The same of an angle: one in whole degrees is excused, one in tens of degrees is not."""

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
    """How far from a figure a value may be: within a relative ``near``, or where no tolerance was stated within
    ``halves`` units of its last digits (of each component; of a polar figure of its size and its direction)."""

    given: Array
    kind: str
    near: float
    halves: tuple[float, ...]
    polar: bool

    def off(self, value: Array) -> float:
        """Relative difference; of an angle the difference over one radian."""
        difference = np.atleast_1d(value - self.given)
        if self.kind == "angle":
            return float(np.abs(np.angle(np.exp(1j * difference))).max())
        size = float(np.linalg.norm(np.atleast_1d(self.given)))
        size = size or float(np.linalg.norm(np.atleast_1d(value))) or 1.0
        return float(np.linalg.norm(difference)) / size

    def holds(self, value: Array) -> bool:
        """Whether a value is the figure."""
        return self.off(value) <= self.near or (bool(self.halves) and self._rounds(value))

    def _rounds(self, value: Array) -> bool:
        """Whether the figure is the value rounded to the digits written, if they are not too few."""
        if self.kind == "angle":
            return self.off(value) <= EDGE * min(self.halves[0], DIRECTION)
        size = float(np.linalg.norm(np.atleast_1d(self.given)))
        if self.polar:
            (x, y), (a, b) = value, self.given
            turned = abs(math.remainder(math.atan2(y, x) - math.atan2(b, a), math.tau))
            straight = turned <= EDGE * max(self.near, min(self.halves[1], DIRECTION))
            return straight and abs(math.hypot(x, y) - size) <= self._room(self.halves[0], size)
        apart = np.abs(np.atleast_1d(value - self.given)).ravel()
        return all(d <= self._room(h, size) for d, h in zip(apart, self.halves, strict=True))

    def _room(self, half: float, size: float) -> float:
        return EDGE * max(self.near * size, min(half, COARSE * size))


def closeness(answer: Answer, given: Target, kind: str, units: Units) -> Closeness:
    """How near a value must be to an answer: by its tolerance in percent if it states one, else by its digits."""
    text = str(answer.tolerance or "").strip()
    if text.endswith("%"):
        return Closeness(given.value, kind, float(text.removesuffix("%")) / 100, (), given.polar)
    return Closeness(given.value, kind, NEAR, _halves(answer.value, given, kind, units), given.polar)


def _halves(value: object, given: Target, kind: str, units: Units) -> tuple[float, ...]:
    """Half units of the last digits in SI: of each component, or of a size and a direction."""
    if given.value.ndim > 1:
        return ()
    if given.polar:
        size, _, direction = str(value).partition("@")
        size_half = _in_si(size, float(np.hypot(*given.value)))
        return (size_half, _angle_half(direction, str(value), units))
    if kind == "angle":
        return (_angle_half(str(value), str(value), units),)
    parts = value if isinstance(value, (list, tuple)) else [value]
    return tuple(_in_si(str(p), float(v)) for p, v in zip(parts, np.atleast_1d(given.value), strict=True))


def _in_si(text: str, value: float) -> float:
    """Half a unit of the last digit of a text whose number stands for a value; 0 where that is 0."""
    found = re.search(NUMBER, text)
    if found is None or not float(found[0]):
        return 0.0
    return half_unit(found[0]) * abs(value / float(found[0]))


def _angle_half(text: str, whole: str, units: Units) -> float:
    found = re.search(NUMBER, text)
    if found is None:
        return 0.0
    return radians(half_unit(found[0]), whole, units)


def radians(angle: float, text: str, units: Units) -> float:
    """An angle that stands in a text, in radians: in the text's own unit, or else the file's.

    >>> radians(180.0, "155 @ 180 deg", Units(angle="rad")) == radians(math.pi, "155 @ 3.14", Units(angle="rad"))
    True
    """
    named = re.search(r"\b(deg|rad)\b", text)
    return unit(named[1] if named else units.angle).si(angle)
