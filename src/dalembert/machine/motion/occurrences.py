"""What ends a segment of a motion."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import nan
from typing import NamedTuple

from dalembert.arrays import Array

Value = Callable[[float, Array], float]
"""A quantity of time and state."""


class Event(NamedTuple):
    """What happened when, as a sentence; of an impact the speed before, rad/s or m/s, and the energy lost, J."""

    time: float
    name: str
    sentence: str
    speed: float = nan
    lost: float = nan


@dataclass(frozen=True)
class Condition:
    """A crossing to stop at or to note: a drive's position or speed (`what`) at a value."""

    text: str
    drive: int
    what: str
    value: float
    stops: bool

    def value_at(self, d: int) -> Value:
        """What is to pass zero, of a state of d drives."""
        place = self.drive + d * (self.what == "speed")
        return lambda t, y: float(y[place] - self.value)


@dataclass
class Guard:
    """A ``value`` of the state, by its kind and which one, whose change of sign from ``side`` is an event.

    A side of 0 is not known yet.
    """

    kind: str
    which: int
    value: Value
    side: float = 0.0
