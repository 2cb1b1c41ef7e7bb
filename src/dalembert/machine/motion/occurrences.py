"""Events that end a segment of a motion."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf, nan
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from dalembert.answer.column import Scale
from dalembert.arrays import Array, Flags
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
    """A crossing to stop at or to note: a drive's position or speed (`what`) at a value; or of a quantity by its
    name."""

    text: str
    drive: int
    what: str
    value: float
    stops: bool
    name: str = ""

    def place(self, d: int) -> int:
        """Its place in a state of d drives."""
        return self.drive + d * (self.what == "speed")

    def value_at(self, d: int) -> Value:
        """Quantity that passes zero, of a state of d drives."""
        place = self.place(d)
        return lambda t, y: float(y[place] - self.value)


def less(of: Value, value: float) -> Value:
    """A quantity less a value."""
    return lambda t, y: float(of(t, y)) - value


@dataclass
class Guard:
    """A ``value`` of the state, by its kind and which one, whose change of sign from ``side`` is an event.

    A side of 0 is not known yet. ``trend``: how it went on, times its side, at the end of the last step; ``turned``: an
    instant within a step at which it is beyond zero, to come back before the step ends. ``column``: where machine code
    has the value, less ``level``: a number of the state, or behind these one that is watched; -1 where it has not.
    ``least``: amount by which it is surely beyond zero. ``looked``: the longest step within which it was evaluated, and
    followed from its neighbours; ``seen``: times and values, times its side, at the ends of the last two.
    """

    kind: str
    which: int
    value: Value
    side: float = 0.0
    trend: float = 0.0
    turned: float = inf
    column: int = -1
    level: float = 0.0
    least: float = 0.0
    looked: float = 0.0
    seen: tuple[tuple[float, float], ...] = ()

    @property
    def anywhere(self) -> bool:
        """True if it may pass zero several times within a step, as the steps are not chosen by its value."""
        return self.column < 0 and self.kind in ("corner", "condition")

    def look_within(
        self, dense: Callable[[], Callable[[float], Array]], before: float, t: float, y: Array
    ) -> None:
        """Find the first instant at which it is beyond zero within a step up to a state; ``dense`` makes its states."""
        now = (t, self.value(t, y) * self.side)
        ends = np.array([*self.seen[-2:], now]).T
        self.seen, self.turned = (*self.seen[-1:], now), inf
        if t - before <= LONGER * self.looked and ends.shape[1] == 3 and follows(*ends):
            return
        state = dense()
        self.turned, at_once = first_beyond(lambda x: self.value(x, state(x)) * self.side, before, t)
        self.looked = max(self.looked, t - before) if at_once else 0.0

    @property
    def known(self) -> bool:
        """True if the segment behind an event knows its side by itself."""
        return self.kind not in ("on", "off", "kink", "side", "gear", "condition")

    def at_zero(self, t: float, y: Array, d: int) -> bool:
        """True if its value is too small for a sign, at a state of d drives."""
        return abs(self.value(t, y)) <= (self.least or 1e-12 * max(float(abs(y[: 2 * d]).max()), 1.0))


UNEVEN, FOLLOWS, FINER, LONGER = 0.38, 0.1, 12, 1.5
"""Place of another instant between two of a step; part of the largest value by which a value may differ from the
straight line between its neighbours; number of times that instants are added; and the factor by which a step may be
longer than those evaluated within so far, if its end follows from the ends before."""


def lowest(x: Array, v: Array) -> Array:
    """Minima of parabolas through values v (3, ...) at places x (3, ...); infinite for those without one between them.

    >>> float(lowest(np.array([0.0, 1.0, 3.0]), np.array([4.0, 1.0, 1.0])))
    0.0
    """
    with np.errstate(all="ignore"):  # two may be one place
        left, right = (v[1] - v[0]) / (x[1] - x[0]), (v[2] - v[1]) / (x[2] - x[1])
        bend = (right - left) / (x[2] - x[0])
        slope = left + bend * (x[1] - x[0])
        place = x[1] - slope / (2 * bend)
        inside = (bend > 0) & (x[0] <= place) & (place <= x[2])
        return np.where(inside, v[1] - slope**2 / (4 * bend), inf)


def off_line(x: Array, v: Array) -> Array:
    """Differences of the second of values v (3, ...) at places x (3, ...) from the straight lines through the others.

    >>> float(off_line(np.array([0.0, 1.0, 4.0]), np.array([0.0, 1.5, 4.0])))
    0.5
    """
    with np.errstate(all="ignore"):
        return np.asarray(np.abs(v[1] - v[0] - (x[1] - x[0]) / (x[2] - x[0]) * (v[2] - v[0])))


def follows(x: Array, v: Array) -> Flags:
    """True for functions whose values v (3, ...) at places x (3, ...) follow from each other and stay clear of zero, so
    that their sign does not change twice between two of them.

    >>> x = np.array([0.0, 1.0, 2.0])
    >>> [bool(follows(x, np.array(v))) for v in ([3.0, 2.0, 1.1], [3.0, 2.0, 4.0], [3.0, 0.1, 0.1])]
    [True, False, False]
    """
    clear = lowest(x, v) > FOLLOWS * (v.max(axis=0) - v.min(axis=0))
    return np.asarray(clear & (off_line(x, v) <= FOLLOWS * np.abs(v).max(axis=0)))


def first_beyond(value: Callable[[float], float], low: float, high: float) -> tuple[float, bool]:
    """The first instant after ``low``, up to ``high``, at which a function is below zero, or infinity; and True if its
    values followed from their neighbours at once.

    Instants are added until all values do, and minima between two of them are searched for.

    >>> first_beyond(lambda t: np.cos(40 * t), 0.0, 3.0)[0] < 3 * np.pi / 80
    True
    >>> first_beyond(lambda t: 1.001 + np.cos(40 * t), 0.0, 3.0)
    (inf, False)
    """
    t = np.linspace(low, high, 5)
    v = np.array([value(x) for x in t.tolist()])
    finer = 0
    for finer in range(FINER):  # noqa: B007
        new = t[:-1] + UNEVEN * np.diff(t)
        between = np.array([value(x) for x in new.tolist()])
        off = np.abs(between - v[:-1] - UNEVEN * np.diff(v))
        order = np.argsort(np.concatenate([t, new]), kind="stable")
        t, v = np.concatenate([t, new])[order], np.concatenate([v, between])[order]
        if not (off > FOLLOWS * np.abs(v).max()).any():
            break
    for k in range(1, len(t)):
        if v[k] < 0:
            return float(t[k]), finer == 0
        if k + 1 < len(t):
            near, size = slice(k - 1, k + 2), float(np.ptp(v[k - 1 : k + 2]))
            if float(lowest(t[near], v[near])) < FOLLOWS * size:
                least = minimize_scalar(value, bounds=(t[k - 1], t[k + 1]), method="bounded")
                if least.fun < 0:
                    return float(least.x), finer == 0
    return inf, finer == 0


ROUNDING = 1e-9
"""Part of the largest force of contacts so far by which one surely bears on a side."""
TURNING = ("corner", "condition", "clutch")
"""Guards that may pass zero and come back within a step."""
CONDITION = re.compile(r"\s*(?P<drive>\S+)\.(?P<what>position|speed)\s*=\s*(?P<value>.+?)\s*")
NAMED = re.compile(r"\s*(?P<name>[^=<>]+?)\s*=\s*(?P<value>[^=<>]+?)\s*")
KindOf = Callable[[str], str]
"""Kind of a quantity by its name; raises ModelError for one that does not exist."""


def read_end(
    m: Mechanism,
    until: str | float | Sequence[str | float],
    events: Sequence[str],
    kind_of: KindOf | None = None,
) -> tuple[float, list[EventCondition]]:
    """The end, infinite where only conditions end it, and the conditions, of quantities too where ``kind_of`` knows
    them."""
    several = [until] if isinstance(until, (str, float, int)) else list(until)
    times = [u for u in several if not (isinstance(u, str) and re.search("[=<>]", u))]
    texts = [(str(u), True) for u in several if u not in times] + [(e, False) for e in events]
    conditions = [_condition(m, text, stops, kind_of) for text, stops in texts]
    end = min((quantity(u, "time", m.units.of_texts()) for u in times), default=np.inf)
    if not end > 0 or not several:
        raise ModelError("the simulation has no end", 'write until="2 s"')
    return end, conditions


def _condition(m: Mechanism, text: str, stops: bool, kind_of: KindOf | None) -> EventCondition:
    match = CONDITION.fullmatch(text)
    named = NAMED.fullmatch(text) if kind_of is not None else None
    if named is not None and kind_of is not None and (match is None or match["drive"] not in m.drives):
        if match is not None and "." not in match["drive"]:
            raise ModelError(
                f"the condition {text!r} names no drive", closest(match["drive"], list(m.drives))
            )
        value = _value(named["value"], kind_of(named["name"]), m)
        return EventCondition(text.strip(), -1, "", value, stops, named["name"])
    if match is None:
        raise ModelError(
            f"{text!r} is not a condition", 'write "O2.speed = 0 rad/s" or "O2.position = 90 deg"'
        )
    drive = match["drive"]
    if drive not in m.drives:
        raise ModelError(f"the condition {text!r} names no drive", closest(drive, list(m.drives)))
    what, kinds = match["what"], TURN if m.drives[drive].turns else SLIDE
    value = _value(match["value"], kinds["" if what == "position" else what], m)
    return EventCondition(text.strip(), list(m.drives).index(drive), what, value, stops)


def _value(text: str, kind: str, m: Mechanism) -> float:
    return quantity(text, kind, m.units.of_texts()) if text != "0" else 0.0
