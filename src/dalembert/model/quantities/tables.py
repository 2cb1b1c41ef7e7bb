"""Quantities given as a table against a coordinate of the machine or time: linear or a cubic spline, optionally
periodic."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from numpy.typing import ArrayLike

from dalembert.arrays import Array, Numeric
from dalembert.errors import ModelError
from dalembert.model.quantities.expression_trees import Functions, unknown_name

UNITS = {"angle": "deg", "length": "m", "time": "s", "angular_speed": "rad/s", "speed": "m/s"}
"""Kind of a table's x -> the unit in which messages say it."""
FAR = 1e9
"""Spans of a table that it goes on beyond its ends."""
OUTSIDE = ("refuse", "hold", "zero")
"""Value of a table beyond its ends."""

SLACK = 1e-9
"""Relative to the table's span: how far outside its ends a position is still taken as the end."""


@dataclass(frozen=True, slots=True)
class ColumnFile:
    """Two columns of a file: its name as written, the keys that say which, and the folder the name is relative to."""

    written: str
    keys: Mapping[str, object]
    folder: str = ""


@dataclass(frozen=True, slots=True)
class Table:
    """A quantity known at `x` of `against` (radians, metres or seconds): SI values `y`, times a factor.

    ``against`` is a drive, `time`, `links.NAME.angle`, a freedom of a joint, `joints.NAME.slide`, or a speed of these.
    ``outside`` its ends it holds the end value, is zero, or holds it and is refused by a status; with a `period` it
    repeats. With a `shift` it is delayed by this. ``of`` is the kind of y where
    ``times`` makes another of it, a pressure times an area; ``file`` is where the columns came from.

    >>> Table("O2", (0.0, 1.0, 2.0), (0.0, 10.0, 0.0)).at({"O2": 0.25})
    np.float64(2.5)
    """

    against: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    interpolate: str = "linear"
    period: float | None = None
    along: str = "angle"
    times: float = 1.0
    shift: float = 0.0
    of: str = ""
    file: ColumnFile | None = field(default=None, compare=False)
    outside: str = "refuse"

    def __post_init__(self) -> None:
        _check(self)

    @property
    def names(self) -> frozenset[str]:
        """Name of its variable."""
        return frozenset((self.against,))

    def closed(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """x and y with the point that closes the period, if that was left out."""
        if self.period is None or self.x[-1] - self.x[0] > self.period * (1 - SLACK):
            return self.x, self.y
        return (*self.x, self.x[0] + self.period), (*self.y, self.y[0])

    def pieces(self) -> tuple[Array, Array]:
        """Breaks (n+1,) and coefficients (k, n), highest power first, in the distance from a piece's left break."""
        import numpy as np

        x, y = (np.asarray(values, float) for values in self.closed())
        if self.interpolate == "linear":
            return x, np.stack([np.diff(y) / np.diff(x), y[:-1]])
        from scipy.interpolate import CubicSpline

        if self.period is not None:
            y[-1] = y[0]
        spline = CubicSpline(x, y, bc_type="not-a-knot" if self.period is None else "periodic")
        return x, spline.c

    def everywhere(self) -> tuple[Array, Array]:
        """The same, with a piece of 0 before and behind where it is zero outside."""
        import numpy as np

        breaks, coefficients = self.pieces()
        if self.outside != "zero" or self.period is not None:
            return breaks, coefficients
        far = FAR * (breaks[-1] - breaks[0])
        breaks = np.concatenate([[breaks[0] - far], breaks, [breaks[-1] + far]])
        return breaks, np.pad(coefficients, ((0, 0), (1, 1)))

    def beyond(self, position: ArrayLike) -> Array:
        """True at arguments beyond its ends, if these are refused."""
        import numpy as np

        place = np.asarray(position, float) - self.shift
        if self.period is not None or self.outside != "refuse":
            return np.zeros(place.shape, bool)
        slack = SLACK * (self.x[-1] - self.x[0])
        return np.asarray((place < self.x[0] - slack) | (place > self.x[-1] + slack))

    def next_point(self, position: float) -> float:
        """The next of its points beyond a position, where it bends; infinite behind the last.

        >>> Table("time", (0.0, 1.0, 2.0), (0.0, 10.0, 0.0), period=2.0, along="time").next_point(3.0)
        4.0
        """
        import numpy as np

        x = np.asarray(self.closed()[0]) + self.shift
        if self.period is not None:
            x = np.append(x, x + self.period) + self.period * np.floor((position - x[0]) / self.period)
        later = x[x > position + 4 * np.spacing(max(abs(position), float(np.abs(x).max())))]
        return float(later.min(initial=np.inf))

    def at(self, drives: Mapping[str, Numeric], functions: Functions | None = None) -> Numeric:
        """The SI value at the drives' positions; `functions["table"](table, position)` replaces numpy's."""
        if self.against not in drives:
            raise unknown_name("a table is against", self.against, list(drives))
        if functions is not None:
            return functions["table"](self, drives[self.against])
        value = self._of_numbers(drives[self.against])
        return value if self.times == 1.0 else self.times * value

    def _of_numbers(self, position: ArrayLike) -> Numeric:
        import numpy as np

        breaks, coefficients = self.pieces()
        low, high = breaks[0], breaks[-1]
        known = np.asarray(position, float) - self.shift
        place = np.clip(known, low, high) if self.period is None else low + np.mod(known - low, self.period)
        piece = np.clip(np.searchsorted(breaks, place, "right") - 1, 0, len(breaks) - 2)
        step, value = place - breaks[piece], np.zeros(place.shape)
        for row in coefficients:
            value = value * step + row[piece]
        if self.outside == "zero" and self.period is None:
            value = np.where(np.abs(known - place) > SLACK * (high - low), 0.0, value)
        return value[()]


def _describe(table: Table, position: float) -> str:
    import math

    number = math.degrees(position) if table.along == "angle" else position
    return f"{number:.6g} {UNITS[table.along]}"


def _check(table: Table) -> None:
    if len(table.x) != len(table.y):
        what = f"a table has {len(table.x)} values in x and {len(table.y)} in y"
        raise ModelError(what, "give one y for each x")
    if len(table.x) < 2:
        raise ModelError(f"a table has too few points: {len(table.x)}", "give at least 2")
    for i, (a, b) in enumerate(zip(table.x, table.x[1:], strict=False)):
        if not a < b:
            words = f"x of a table does not increase from its item {i + 1} to {i + 2}"
            raise ModelError(words, "sort the points; for a jump give two that are close", ("x", i + 1))
    if table.interpolate not in ("linear", "cubic"):
        problem = f"{table.interpolate!r} is not a valid value"
        raise ModelError(problem, "write linear or cubic", ("interpolate",))
    _check_period(table)


def _check_period(table: Table) -> None:
    if table.period is None or not all(isinstance(y, (float, int)) for y in table.y):  # symbols
        return
    span = table.x[-1] - table.x[0]
    if not table.period > 0 or span > table.period * (1 + SLACK):
        raise ModelError(
            f"a periodic table goes over {_describe(table, span)} and repeats after {_describe(table, table.period)}",
            "leave out the points beyond one period, or give a longer one, as in `periodic: 20 mm` or `720 deg`",
            ("periodic",),
        )
    size = max(abs(y) for y in table.y)
    if span > table.period * (1 - SLACK) and abs(table.y[-1] - table.y[0]) > SLACK * size:
        raise ModelError(
            "a periodic table ends with another value than it begins with",
            "give the first value again at the end, or leave the last point out",
            ("periodic",),
        )
