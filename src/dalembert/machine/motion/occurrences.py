"""Events that end a segment of a motion."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf, nan
from typing import NamedTuple

import numpy as np

from dalembert.answer.column import Scale
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model import Mechanism
from dalembert.model.drives.drives import SLIDE, TURN
from dalembert.printing import number
from dalembert.units import quantity
from dalembert.wording import closest

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
    """Event at a time, described in ``words``, of a drive or joint (``of``); of an impact the speed before, rad/s or
    m/s, and the energy lost, J."""

    time: float
    name: str
    words: Words
    of: str = ""
    speed: float = nan
    lost: float = nan

    @property
    def sentence(self) -> str:
        """Description of the event, in SI units."""
        return say(self.words)


@dataclass(frozen=True)
class EventCondition:
    """A crossing to stop at or to note: a drive's position or speed (`what`) at a value."""

    text: str
    drive: int
    what: str
    value: float
    stops: bool

    def value_at(self, d: int) -> Value:
        """Quantity that passes zero, of a state of d drives."""
        place = self.drive + d * (self.what == "speed")
        return lambda t, y: float(y[place] - self.value)


@dataclass
class Guard:
    """A ``value`` of the state, by its kind and which one, whose change of sign from ``side`` is an event.

    A side of 0 is not known yet. ``trend``: how it went on, times its side, at the end of the last step; ``turned``: an
    instant within a step at which it is beyond zero, to come back before the step ends.
    """

    kind: str
    which: int
    value: Value
    side: float = 0.0
    trend: float = 0.0
    turned: float = inf

    @property
    def known(self) -> bool:
        """True if the segment behind an event knows its side by itself."""
        return self.kind not in ("on", "off", "kink", "condition")

    def at_zero(self, t: float, y: Array, d: int) -> bool:
        """True if its value is too small for a sign, at a state of d drives."""
        return abs(self.value(t, y)) <= 1e-12 * max(float(abs(y[: 2 * d]).max()), 1.0)


CONDITION = re.compile(r"\s*(?P<drive>\S+)\.(?P<what>position|speed)\s*=\s*(?P<value>.+?)\s*")


def read_end(
    m: Mechanism, until: str | float | Sequence[str | float], events: Sequence[str]
) -> tuple[float, list[EventCondition]]:
    """The end, infinite where only conditions end it, and the conditions."""
    several = [until] if isinstance(until, (str, float, int)) else list(until)
    times = [u for u in several if not (isinstance(u, str) and re.search("[=<>]", u))]
    texts = [(str(u), True) for u in several if u not in times] + [(e, False) for e in events]
    conditions = [_condition(m, text, stops) for text, stops in texts]
    end = min((quantity(u, "time", m.units.of_texts()) for u in times), default=np.inf)
    if not end > 0 or not several:
        raise ModelError("the simulation has no end", 'write until="2 s"')
    return end, conditions


def _condition(m: Mechanism, text: str, stops: bool) -> EventCondition:
    match = CONDITION.fullmatch(text)
    if match is None:
        raise ModelError(
            f"{text!r} is not a condition", 'write "O2.speed = 0 rad/s" or "O2.position = 90 deg"'
        )
    drive = match["drive"]
    if drive not in m.drives:
        raise ModelError(f"the condition {text!r} names no drive", closest(drive, list(m.drives)))
    what, kinds = match["what"], TURN if m.drives[drive].turns else SLIDE
    kind = kinds["" if what == "position" else what]
    value = quantity(match["value"], kind, m.units.of_texts()) if match["value"] != "0" else 0.0
    return EventCondition(text.strip(), list(m.drives).index(drive), what, value, stops)
