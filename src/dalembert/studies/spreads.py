"""Spread of one number from design to design: a distribution or levels, from the text of a study."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.units import NUMBER
from dalembert.wording import quote_value

CUT = 3.0
"""Standard deviations in a tolerance: a normal distribution is truncated at this many."""
MOST = 1_000_000
"""Levels that one number may have."""
FORMS = "write '± 0.05 mm', 'normal 2 %', 'uniform ± 5 %', '70..90 N', '70..90 N in 5' or a list, [70 N, 80 N, 90 N]"
RANGE = re.compile(rf"({NUMBER})\s*(.*?)\s*\.\.\s*({NUMBER})\s*(.*)")
COUNT = re.compile(r"(.*\S) in (\d+)")
PLUS_MINUS = re.compile(r"±|\+/?-")


@dataclass(frozen=True)
class Spread:
    """One number of a design, SI.

    kind: ``tolerance`` (normal of mean a, cut at a ± b, where b is three standard deviations), ``normal`` (mean a,
    standard deviation b), ``uniform`` from a to b, or ``levels``, which are equally likely.
    """

    kind: str
    a: float = 0.0
    b: float = 0.0
    levels: tuple[float, ...] = ()

    @property
    def law(self) -> tuple[float, float, float, float, bool]:
        """Low, width, a, b and whether normal of the value a + b x below which a share u (0 to 1) of the designs lies:
        x is low + width u, or the normal score of that. Of levels it is the share itself."""
        if self.kind == "tolerance":
            low = math.erfc(CUT / math.sqrt(2)) / 2
            return low, 1 - 2 * low, self.a, self.b / CUT, True
        a, b = {"uniform": (self.a, self.b - self.a), "normal": (self.a, self.b)}.get(self.kind, (0.0, 1.0))
        return 0.0, 1.0, a, b, self.kind == "normal"

    def pick(self, u: Array) -> Array:
        """The levels at shares u of them."""
        place = np.minimum((u * len(self.levels)).astype(int), len(self.levels) - 1)
        return np.asarray(np.asarray(self.levels)[place])

    @property
    def sigma(self) -> float:
        """Standard deviation."""
        if self.kind == "uniform":
            return (self.b - self.a) / math.sqrt(12)
        if self.kind == "normal":
            return self.b
        if self.kind == "levels":
            return float(np.std(self.levels))
        density = math.exp(-CUT * CUT / 2) / math.sqrt(2 * math.pi)
        return self.b / CUT * math.sqrt(1 - 2 * CUT * density / math.erf(CUT / math.sqrt(2)))

    @property
    def ends(self) -> tuple[float, float]:
        """Least and largest value; for a normal distribution three standard deviations on either side."""
        if self.kind == "uniform":
            return self.a, self.b
        if self.kind == "levels":
            return min(self.levels), max(self.levels)
        half = CUT * self.b if self.kind == "normal" else self.b
        return self.a - half, self.a + half


def read_spread(
    stated: object, nominal: float, si: Callable[[object], float], limits: tuple[float, float] | None = None
) -> Spread:
    """The spread that a text or a list says about a number that is ``nominal``; ``si`` reads a quantity.

    limits: what the word ``range`` means, the range stated with a parameter.

    >>> read_spread("± 5 %", 20.0, float)
    Spread(kind='tolerance', a=20.0, b=1.0, levels=())
    >>> read_spread("70..90 in 3", 80.0, float).levels
    (70.0, 80.0, 90.0)
    """
    if isinstance(stated, Spread):
        return stated
    if isinstance(stated, (list, tuple, np.ndarray)):
        return _levels(stated, si)
    text = " ".join(str(stated).replace("\u2212", "-").split()) if isinstance(stated, str) else ""
    if text == "range":
        if limits is None:
            raise ModelError("it states no range", "only a parameter with range: [LOW, HIGH] does; " + FORMS)
        return Spread("uniform", *limits)
    counted = COUNT.fullmatch(text)  # not the inches of "2..3 in"
    if match := RANGE.fullmatch(counted[1] if counted else text):
        return _range(match, counted[2] if counted else None, si)
    kind, rest = "tolerance", text
    for word in ("uniform", "normal"):
        if text.startswith(word):
            kind, rest = word, text.removeprefix(word).strip()
    sign = PLUS_MINUS.match(rest)
    if not rest or (kind != "normal" and not sign) or (kind == "normal" and sign):
        raise ModelError(f"{quote_value(stated)} says no spread", FORMS)
    half = _size(rest[sign.end() :] if sign else rest, nominal, si)
    return (
        Spread("uniform", nominal - half, nominal + half)
        if kind == "uniform"
        else Spread(kind, nominal, half)
    )


def _size(text: str, nominal: float, si: Callable[[object], float]) -> float:
    """A tolerance or standard deviation; a percentage is relative to the nominal value."""
    text = text.strip()
    percent = re.fullmatch(rf"({NUMBER})\s*%", text)
    size = abs(nominal) * float(percent[1]) / 100 if percent else si(text)
    if percent and nominal == 0 and float(percent[1]):
        raise ModelError(f"{text} of a number that is 0 is nothing", "give it with a unit, as ± 0.05 mm")
    if not size > 0:
        raise ModelError(f"a tolerance of {quote_value(text)} is not positive", "give one above zero")
    return size


def _range(match: re.Match[str], count: str | None, si: Callable[[object], float]) -> Spread:
    low, first, high, last = (part.strip() for part in match.groups())
    if first and last and first != last:
        raise ModelError(f"the range begins in {first} and ends in {last}", "write one unit")
    a, b = si(f"{low} {first or last}".strip()), si(f"{high} {last or first}".strip())
    if not a < b:
        raise ModelError(f"the range from {low} to {high} is empty", "write the smaller end first: 70..90 N")
    if count is None:
        return Spread("uniform", a, b)
    if not 2 <= int(count) <= MOST:
        raise ModelError(f"levels={count} is out of range", f"use 2 to {MOST}")
    return Spread("levels", levels=tuple(np.linspace(a, b, int(count)).tolist()))


def _levels(values: object, si: Callable[[object], float]) -> Spread:
    levels = tuple(si(value) for value in list(values))  # type: ignore[call-overload]
    if not levels or len(levels) > MOST:
        raise ModelError(f"a list of {len(levels)} values says no levels", f"give 1 to {MOST}")
    if len(set(levels)) < len(levels):
        raise ModelError("a value occurs twice in the list", "leave one of them out")
    return Spread("levels", levels=levels)
