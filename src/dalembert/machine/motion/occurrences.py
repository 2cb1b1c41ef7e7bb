"""What ends a segment of a motion, and what is kept of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array


class Event(NamedTuple):
    """What happened when, as a sentence, at which state."""

    time: float
    name: str
    sentence: str


@dataclass(frozen=True)
class Condition:
    """A crossing to stop at or to note: a drive's position or speed (`what`) at a value."""

    text: str
    drive: int
    what: str
    value: float
    stops: bool

    def __call__(self, t: float, q: Array, u: Array) -> float:
        return float((q if self.what == "position" else u)[self.drive] - self.value)


@dataclass
class Guard:
    """A quantity of the state, by its kind and which one, whose change of sign from ``side`` is an event.

    A side of 0 is not known yet.
    """

    kind: str
    which: int
    side: float = 0.0
    at: float = 0.0


@dataclass
class Track:
    """Instants that are kept: time, positions, speeds, accelerations, efforts, works."""

    rows: list[tuple[float, Array, Array, Array, Array, Array]] = field(default_factory=list)

    def columns(self) -> Iterator[Array]:
        """Each as an array (T, ...)."""
        return (np.array(column) for column in zip(*self.rows, strict=True))
