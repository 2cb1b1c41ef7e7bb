"""How a random machine is written down: as drawn, in the mirror, or with other lengths and masses."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from numpy.random import Generator

Machine = tuple[dict[str, Any], list[str]]
"""The tree of a machine, and the paths of numbers that a kernel varies."""
G = (0.0, -9.80665)
OTHER = {"left": "right", "right": "left", "ccw": "cw", "cw": "ccw"}


@dataclass(frozen=True)
class Written:
    """Writes numbers in SI of a machine whose lengths and masses have these factors, and none of its times.

    ``flip`` is -1 in the mirror of the x axis: y and every turn change sign, and left is right.
    """

    flip: int = 1
    length: float = 1.0
    mass: float = 1.0

    def by(self, value: float, mass: int = 0, length: int = 0) -> float:
        """A number of a dimension with these powers of mass and length."""
        return float(value) * self.mass**mass * self.length**length

    def at(self, place: Iterable[float]) -> list[float]:
        """A point, or a vector of lengths per time."""
        return self._reflected(place, self.length)

    def force(self, vector: Iterable[float]) -> list[float]:
        """A force."""
        return self._reflected(vector, self.mass * self.length)

    def _reflected(self, vector: Iterable[float], size: float) -> list[float]:
        return [float(x) * size * (self.flip if k == 1 else 1) for k, x in enumerate(vector)]

    def turn(self, angle: float, rate: int = 0) -> str:
        """An angle, or its rate of that order, that the mirror reverses."""
        return f"{self.flip * float(angle)!r} {('rad', 'rad/s', 'rad/s^2')[rate]}"

    def couple(self, value: float) -> float:
        """A couple."""
        return self.flip * self.by(value, 1, 2)

    def side(self, word: str) -> str:
        """left, right, ccw or cw."""
        return OTHER[word] if self.flip < 0 else word

    def spins(self, position: float, speed: float, acceleration: float = 0.0) -> dict[str, Any]:
        """The drive of a turn."""
        turns = (self.turn(x, rate) for rate, x in enumerate((position, speed, acceleration)))
        return dict(zip(("position", "speed", "acceleration"), turns, strict=True))

    def slides(self, position: float, speed: float, acceleration: float = 0.0) -> dict[str, Any]:
        """The drive of a slide."""
        slides = (self.by(x, 0, 1) for x in (position, speed, acceleration))
        return dict(zip(("position", "speed", "acceleration"), slides, strict=True))


def wheel(w: Written, at: str, rng: Generator, place: Any = (0, 0)) -> dict[str, Any]:
    """A wheel or shaft about a point."""
    return {
        "points": {at: w.at(place)},
        "mass": w.by(rng.uniform(1, 4), 1),
        "inertia": w.by(rng.uniform(0.01, 0.3), 1, 2),
    }


def pin(i: str, j: str, at: Any = None) -> dict[str, Any]:
    return {"type": "pin", "links": [i, j]} | ({"at": at} if at else {})


def couple(w: Written, on: str, value: float) -> dict[str, Any]:
    return {"type": "couple", "on": on, "value": w.couple(value)}


def force(w: Written, on: str, at: str, value: Any) -> dict[str, Any]:
    return {"type": "force", "on": on, "at": at, "value": w.force(value)}
