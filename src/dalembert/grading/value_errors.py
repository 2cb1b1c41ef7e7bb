"""Slips in a value itself: sense, axis, component, unit.

Mechanics: docs/theory.md 12.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array
from dalembert.grading.quantities import Series


class Hypothesis(NamedTuple):
    """A mistake in words, the value (SI) that it leads to, and of which kind it is: sign, unit or another."""

    sentence: str
    value: Array
    kind: str = "named"

    @property
    def single(self) -> bool:
        """True if only one number of a vector speaks for it: the others are right, or scaled with it."""
        return self.kind in ("sign", "unit")


def of_value(series: Series, right: Array) -> Iterator[Hypothesis]:
    """Senses, axes and components."""
    if series.kind == "angle":
        yield from _angles(right)
        return
    opposite = "the sense is opposite"
    if series.kind in ("force", "moment"):
        opposite += ": action mistaken for reaction"
    yield Hypothesis(opposite, -right, "sign")
    if right.ndim == 0:
        return
    if right.shape == (3,):
        yield from _in_space(right)
    if right.shape != (2,):
        return
    x, y = (float(c) for c in right)
    yield Hypothesis("the angle is counted from the other axis: x and y are exchanged", np.array([y, x]))
    yield Hypothesis("the angle is counted clockwise: y has the wrong sign", np.array([x, -y]), "sign")
    yield Hypothesis("x has the wrong sign", np.array([-x, y]), "sign")
    yield Hypothesis("x and y are exchanged, one with the wrong sign", np.array([-y, x]))
    yield Hypothesis("x and y are exchanged, one with the wrong sign", np.array([y, -x]))
    size, angle = math.hypot(x, y), math.atan2(y, x)
    turned = math.degrees(angle)
    yield Hypothesis(
        "degrees are mistaken for radians in sine and cosine",
        size * np.array([math.cos(turned), math.sin(turned)]),
    )


def _in_space(right: Array) -> Iterator[Hypothesis]:
    for k, name in enumerate("xyz"):
        yield Hypothesis(f"{name} has the wrong sign", np.where(np.arange(3) == k, -right, right), "sign")
    for a, b in ((0, 1), (1, 2), (0, 2)):
        exchanged = right.copy()
        exchanged[[a, b]] = right[[b, a]]
        yield Hypothesis(f"{'xyz'[a]} and {'xyz'[b]} are exchanged", exchanged)
    yield Hypothesis("the axes are counted one on: x, y, z for z, x, y", np.roll(right, 1))
    yield Hypothesis("the axes are counted one on: x, y, z for y, z, x", np.roll(right, -1))


def _angles(right: Array) -> Iterator[Hypothesis]:
    for sentence, value in (
        ("the sense is opposite: action mistaken for reaction", right + math.pi),
        ("the angle is counted from the other axis", math.pi / 2 - right),
        ("the angle is counted clockwise", -right),
        ("the angle is counted from the negative x axis", math.pi - right),
        ("the number is in radians, not degrees", np.radians(right)),
        ("the number is in degrees, not radians", np.degrees(right)),
    ):
        yield Hypothesis(sentence, np.asarray(value))


FACTORS: tuple[tuple[float, str, tuple[str, ...]], ...] = (
    (12.0, "inches and feet", ("length", "moment", "speed", "acceleration")),
    (25.4, "millimetres and inches", ("length", "moment", "speed", "acceleration")),
    (1000.0, "a factor of 1000 (mm and m, N and kN)", ()),
    (100.0, "centimetres and metres", ("length", "moment", "speed", "acceleration")),
    (10.0, "millimetres and centimetres", ("length", "moment", "speed", "acceleration")),
    (4.4482216152605, "pounds and newtons", ("force", "moment")),
    (9.80665, "g: kilograms and newtons", ("force", "moment")),
    (32.174, "g in ft/s2: pounds and slugs", ("force", "moment")),
    (386.089, "g in in/s2: pounds and blobs", ("force", "moment")),
    (30 / math.pi, "rpm and rad/s", ("angular_speed",)),
    (180 / math.pi, "degrees and radians", ("angular_speed", "angular_acceleration")),
    (2.0, "a factor of 2", ()),
)
"""Factors that units bring in, what they are, and of which kinds of numbers (all where none is named)."""


def of_units(series: Series, right: Array) -> Iterator[Hypothesis]:
    for factor, words, kinds in FACTORS:
        if not kinds or series.kind in kinds:
            for f in (factor, 1 / factor):
                text = words if words.startswith("a factor") else f"units are mixed up: {words}"
                yield Hypothesis(text, right * f, "unit")
