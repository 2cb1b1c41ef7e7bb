"""Bounds of the numbers that functions and options accept: each defined once, for Python and for the command line."""

from __future__ import annotations

import math
from collections.abc import Sequence
from numbers import Integral, Real
from typing import NamedTuple

from dalembert.errors import ArgumentError
from dalembert.wording import quote_value

LARGEST, SMALLEST = 1e60, 1e-60
"""Sizes within which fourth powers are numbers: no length, mass or force of a machine is beyond."""
MILLION = 1_000_000


class Bound(NamedTuple):
    """Allowed range of a number: from ``low`` to ``high``, including the ends or not, integers only or not."""

    remedy: str
    low: float
    high: float = LARGEST
    ends: tuple[bool, bool] = (True, True)
    is_integer: bool = False

    def allows(self, value: object) -> bool:
        """True if a value is a number within the bounds; a truth value is not a number."""
        if isinstance(value, bool) or not isinstance(value, Integral if self.is_integer else Real):
            return False
        x = int(value) if isinstance(value, Integral) else float(value)
        above = self.low <= x if self.ends[0] else self.low < x
        below = x <= self.high if self.ends[1] else x < self.high
        return above and below and (x == 0 or abs(x) >= SMALLEST)

    def remedy_for(self, value: object) -> str:
        """Remedy for a value outside the bounds."""
        if self.is_integer or not isinstance(value, Real):
            return self.remedy
        size = abs(float(value))
        if not math.isfinite(size):
            return self.remedy.replace("a number", "a finite number")
        beyond = size > LARGEST or 0 < size < SMALLEST
        return self.remedy + (f", of a size from {SMALLEST:g} to {LARGEST:g}" if beyond else "")


ABOVE = Bound("give a number above 0", 0.0, ends=(False, True))
NOT_NEGATIVE = Bound("give 0 or a number above 0", 0.0)
FINITE = Bound("give a finite number", -LARGEST)
PART = Bound("give a number above 0 and below 1", 0.0, 1.0, (False, False))


def _integer(low: int, high: int) -> Bound:
    return Bound(f"give a whole number from {low} to {high}", low, high, is_integer=True)


BOUNDS: dict[str, Bound] = {
    # flywheels
    "Cs": Bound(
        "give a number above 0 and below 2: (greatest - least) / mean of the speed", 0.0, 2.0, (False, False)
    ),
    "flywheel inertia": ABOVE,
    "energy": NOT_NEGATIVE,
    "pulse": FINITE,
    "mean speed": Bound("give a finite mean speed that is not 0", -LARGEST),
    "radius of gyration": ABOVE,
    "density": ABOVE,
    "radius": ABOVE,
    "thickness": ABOVE,
    "breadth": ABOVE,
    "height": ABOVE,
    # balance
    "bound": ABOVE,
    "place": FINITE,
    "plane": FINITE,
    "weight": NOT_NEGATIVE,
    # bearings
    "hours": ABOVE,
    "factor": ABOVE,
    "safety": ABOVE,
    "reliability": PART,
    "x0": NOT_NEGATIVE,
    "theta - x0": ABOVE,
    "b": ABOVE,
    "distance of the bearings": ABOVE,
    # motors
    "efficiency": Bound("give a number above 0, at most 1", 0.0, 1.0, (False, True)),
    "ratio": ABOVE,
    "motor inertia": NOT_NEGATIVE,
    "rated torque": ABOVE,
    # counts
    "orders": _integer(0, MILLION),
    "order": NOT_NEGATIVE,
    "count": _integer(1, MILLION),
    "variants": _integer(1, 1000),
    "starts": _integer(1, MILLION),
    "points": _integer(2, 1000),
    "values": _integer(2, 1000),
    "bins": _integer(1, MILLION),
    "some": _integer(0, MILLION),
    "positions": _integer(1, 10**7),
    "steps": _integer(1, 1_000_000_000),
    "instants": _integer(2, 100_000),
    "lanes": _integer(1, 10**6),
    "threads": _integer(1, 10**5),
    "designs": _integer(1, 2**53),
    "samples": _integer(2, 2**30),
    "design": _integer(0, 2**53),
    "seed": _integer(0, 2**63 - 1),
    # percentages and tolerances
    "percentile": Bound("give a number from 0 to 100", 0.0, 100.0),
    "tolerance": Bound("give a number from 0 to 1: a part of the largest force", 0.0, 1.0),
    "length": NOT_NEGATIVE,
    "step error": Bound("give a number from 1e-14 to 1e-3", 1e-14, 1e-3),
}
"""By what the number is; the sentence of the remedy is printed for Python and the command line alike."""


def text_of(value: object) -> str:
    """A value as messages of bounds have it.

    >>> text_of(-1.0), text_of("x"), text_of(True)
    ('-1', "'x'", 'true')
    """
    return f"{value:.12g}" if isinstance(value, float) else quote_value(value)


def require(key: str, value: object, name: str = "", path: Sequence[str | int] = ()) -> None:
    """Raise ArgumentError for a value, not None, outside the bounds of what it is, under another name if it has one.

    >>> require("hours", 20000)
    >>> require("hours", -3)
    Traceback (most recent call last):
    dalembert.errors.ArgumentError: hours is -3; give a number above 0
    """
    bound = BOUNDS[key]
    if value is None or bound.allows(value):
        return
    raise ArgumentError(f"{name or key} is {text_of(value)}", bound.remedy_for(value), path)
