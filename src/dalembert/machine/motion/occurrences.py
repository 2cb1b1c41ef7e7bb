"""What ends a segment of a motion."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import nan
from typing import NamedTuple

from dalembert.analysis.output.columns import Scale
from dalembert.arrays import Array
from dalembert.printing import number

Value = Callable[[float, Array], float]
"""A quantity of time and state."""


Words = tuple[str | tuple[str, float], ...]
"""A sentence: texts, and SI numbers with their kinds."""
SI = Scale(None)


def say(words: Words, to: Scale = SI) -> str:
    """The sentence in the units of a scale.

    >>> say(("it strikes with ", ("speed", 0.5)))
    'it strikes with 0.5 m/s'
    """
    return "".join(w if isinstance(w, str) else f"{number(float(to(*w)))} {to.text(w[0])}" for w in words)


class Event(NamedTuple):
    """What happened when, in ``words``, to which drive or joint (``of``); of an impact the speed before, rad/s or m/s,
    and the energy lost, J."""

    time: float
    name: str
    words: Words
    of: str = ""
    speed: float = nan
    lost: float = nan

    @property
    def sentence(self) -> str:
        """What happened, in SI units."""
        return say(self.words)


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
