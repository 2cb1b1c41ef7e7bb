"""`da.law`: the motion that a drive's law prescribes, with exact peaks of its rates and its coefficients.

Source: Norton, Design of Machinery, chapter 8.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, NamedTuple

import numpy as np

from dalembert.answer.answer import Labelled
from dalembert.answer.column import Axes, Column, Scale, UnitChoice
from dalembert.arrays import Array, Tree
from dalembert.errors import ModelError
from dalembert.model import Mechanism, ModelOrPath, as_mechanism
from dalembert.model.drives.curves import Curve, unit_rise
from dalembert.model.drives.drives import Drive, kind_of
from dalembert.model.drives.expression_laws import ExpressionLaw
from dalembert.model.drives.laws import Rise
from dalembert.model.drives.programmes import RISES, Programme, rate_kind
from dalembert.printing import Part, TextTable, number
from dalembert.wording import closest

RATES = ("speed", "acceleration", "jerk")
COEFFICIENTS = ("C_v", "C_a", "C_j")


@dataclass(frozen=True, repr=False, eq=False)
class MotionLaw(Labelled):
    """A law of motion over time, or over another drive's position (then its rates are slopes by that).

    times (N + 1,): where its pieces join, s (or rad, m). rises: its rises and returns, each a stroke h in a length b
    with C_v = v b/h, C_a = a b^2/h, C_j = j b^3/h of the largest speed, acceleration and jerk in it.

    >>> import dalembert as da
    >>> slide = {"S": {"type": "slider", "links": ["ground", "ram"], "at": ["O", "F"]}}
    >>> links = {"ground": {"points": {"O": [0, 0]}}, "ram": {"points": {"F": [0, 0]}}}
    >>> rise = {"segments": [{"to": 0.025, "in": 0.2, "by": "cycloidal"}], "count": 11}
    >>> law = da.law(da.mechanism({"links": links, "joints": slide, "drives": {"S": {"law": rise}}}), "S")
    >>> law.times.tolist()
    [0.0, 0.2]
    """

    ROWS: ClassVar[str] = "instants"

    mechanism: Mechanism
    drive: str
    curve: Curve
    over: str
    rises: tuple[MotionRise, ...]
    count: int = field(default=361)

    @property
    def coefficients(self) -> dict[str, float]:
        """C_v, C_a and C_j of its first rise; none without one."""
        return self.rises[0].coefficients if self.rises else {}

    @property
    def times(self) -> Array:
        """Joints between pieces of the curve (N + 1,)."""
        return self.curve.times

    @property
    def duration(self) -> float:
        """Its length, s, or rad or m of the drive it is over."""
        return self.curve.duration

    def at(self, t: Array | float) -> Array:
        """Position, speed, acceleration and jerk (4, ...) at times; where one jumps, just after it."""
        return self.curve.at(t)

    def _grid(self) -> Array:
        """Even instants with all joints of pieces and all extremes (T,)."""
        extremes = [
            start + u
            for start, piece in zip(self.times, self.curve.pieces, strict=False)
            for order in range(4)
            for u in piece.extremes(order)
        ]
        return np.unique([*np.linspace(0.0, self.duration, self.count), *self.times, *extremes])

    def _values(self, order: int) -> Array:
        values = self.curve.at(self._grid())
        values[:, -1] = self.curve.at(self.duration, before=True)
        return np.asarray(values[order])

    @property
    def position(self) -> Array:
        """Positions (T,) at even instants, at joints of pieces and at extremes."""
        return self._values(0)

    @property
    def speed(self) -> Array:
        """Speeds (T,) at these times."""
        return self._values(1)

    @property
    def acceleration(self) -> Array:
        """Accelerations (T,) at these times."""
        return self._values(2)

    @property
    def jerk(self) -> Array:
        """Jerks (T,) at these times."""
        return self._values(3)

    @property
    def peak_speed(self) -> float:
        """Largest magnitude of the speed."""
        return self.curve.peaks(1)[0]

    @property
    def peak_acceleration(self) -> float:
        """Largest magnitude of the acceleration."""
        return self.curve.peaks(2)[0]

    @property
    def peak_jerk(self) -> float:
        """Largest magnitude of the jerk inside the pieces."""
        return self.curve.peaks(3)[0]

    def _kinds(self) -> list[str]:
        kind = kind_of(self.mechanism.drives[self.drive].freedom, "")
        return [kind] * 4 if self.over else [kind, *(rate_kind(kind, rate) for rate in RATES)]

    def _master(self) -> str:
        if not self.over:
            return "time"
        return kind_of(self.mechanism.drives[self.over].freedom, "")

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """Time (or the other drive's position), position, speed, acceleration and jerk."""
        yield Column(f"drive.{self.over}" if self.over else "time", self._master(), self._grid())
        for order, (name, kind) in enumerate(zip(("", *RATES), self._kinds(), strict=True)):
            yield Column(f"drive.{self.drive}" + (f".{name}" if name else ""), kind, self._values(order))

    def record(self, to: Scale) -> Tree:
        """Length, coefficients, and the peaks with their places."""
        master = self._master()
        peaks = {}
        for order, (name, kind) in enumerate(zip(RATES, self._kinds()[1:], strict=True), 1):
            size, where = self.curve.peaks(order)
            peaks[name] = {"peak": float(to(kind, size)), "at": float(to(master, where))}
        found = {"duration": float(to(master, self.duration)), "coefficients": self.coefficients}
        return {"law": {"drive": self.drive, "over": self.over or "time", **found, "peaks": peaks}}

    def _row(self, x: MotionRise, to: Scale) -> list[str]:
        """A rise: its curve, where it begins, its stroke and length, its coefficients."""
        places = (number(float(to(self._master(), place))) for place in (x.start, x.length))
        begins, lasts = places
        way = number(float(to(self._kinds()[0], x.way)))
        return [x.by, begins, way, lasts, *map(number, x.coefficients.values())]

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterable[Part]:
        """Peaks with their places, and the coefficients of the first rise."""
        to = self.scale(units)
        tree = self.record(to)["law"]
        master = to.text(self._master())
        of = "time" if not self.over else self.over
        rows = [
            [name, number(peak["peak"]), to.text(kind), number(peak["at"]), master]
            for (name, peak), kind in zip(tree["peaks"].items(), self._kinds()[1:], strict=True)
        ]
        yield f"Law of {self.drive} over {of}, {number(tree['duration'])} {master} long."
        yield TextTable(["", "peak", "unit", f"at {of}", "unit"], rows)
        heads = ["rise by", "from", "way", "in", *COEFFICIENTS]
        if self.rises:
            yield TextTable(heads, [self._row(x, to) for x in self.rises])
        jumps = [number(float(to(self._master(), x))) for x in self.curve.jumps(2)]
        if jumps:
            yield f"The acceleration jumps at {', '.join(jumps)} {master}."


def law(m: ModelOrPath, drive: str, by: str | None = None) -> MotionLaw:
    """The law of motion of a drive; ``by`` replaces the curve of every rise, for a comparison.

    >>> import dalembert as da
    >>> links = {"ground": {"points": {"O": [0, 0]}}, "ram": {"points": {"F": [0, 0]}}}
    >>> slide = {"S": {"type": "slider", "links": ["ground", "ram"], "at": ["O", "F"]}}
    >>> rise = {"segments": [{"to": 0.025, "in": 0.2, "by": "cycloidal"}], "count": 101}
    >>> m = da.mechanism({"links": links, "joints": slide, "drives": {"S": {"law": rise}}})
    >>> da.law(m, "S").peak_speed, round(da.law(m, "S", by="modified_sine").coefficients["C_a"], 4)
    (0.25, 5.528)
    """
    m = as_mechanism(m)
    if drive not in m.drives:
        raise ModelError(f"unknown drive {drive!r}", closest(drive, list(m.drives)))
    if by is not None and by not in RISES:
        raise ModelError(f"unknown motion curve {by!r}", closest(by, list(RISES)))
    programme = _programme(m.drives[drive], drive)
    if by is not None:
        others = [replace(s, by=by) if s.form == "rise" else s for s in programme.segments]
        programme = replace(programme, segments=tuple(others))
    found = tuple(rises(programme))
    return MotionLaw(m, drive, programme.curve, programme.over, found)


def _programme(d: Drive, name: str) -> Programme:
    if d.law is None:
        raise ModelError(
            f"drive {name!r} has no law of motion", "write law: {segments: [...]}", ("drives", name)
        )
    if isinstance(d.law, ExpressionLaw):
        what = f"the law of drive {name!r} is an expression, which has no segments"
        raise ModelError(what, "read its motion from a result", ("drives", name, "law"))
    programme = programme_of(d)
    assert programme is not None
    return programme


class MotionRise(NamedTuple):
    """A rise or return of a programme: its curve, its stroke and the ``length`` in time or of the other drive, and the
    coefficients C_v = v b/h, C_a = a b^2/h, C_j = j b^3/h of the largest speed, acceleration and jerk inside it."""

    by: str
    start: float
    way: float
    length: float
    coefficients: dict[str, float]


def rises(p: Programme) -> Iterator[MotionRise]:
    """The rises and returns of a programme, in their order."""
    position, at = p.start, 0.0
    for s in p.segments:
        pieces = () if math.isnan(s.length) and s.form == "dwell" else s.pieces(position, s.length)
        length, way = sum(x.length for x in pieces), s.to - position
        if s.form not in ("dwell", "constant", "spline") and way:
            curve = Curve(unit_rise(s.by) if s.form == "rise" else pieces)
            h, b = (1.0, 1.0) if s.form == "rise" else (abs(way), length)
            values = {n: curve.peaks(k)[0] * b**k / h for k, n in enumerate(COEFFICIENTS, 1)}
            yield MotionRise(s.by or s.form, at, way, length, values)
        at += length or p.curve.duration - sum(x.length for x in p.segments if not math.isnan(x.length))
        position = float(pieces[-1].end()[0]) if pieces else position


def programme_of(d: Drive) -> Programme | None:
    """The programme of a drive's law; None without a law, and of an expression."""
    from dalembert.model.drives.programmes import Segment

    if isinstance(d.law, Programme):
        return d.law
    if isinstance(d.law, Rise):
        return Programme((Segment("rise", d.law.type, d.law.duration, d.law.stop),), d.law.start, d.law.count)
    if d.law is None or isinstance(d.law, ExpressionLaw):
        return None
    points = (d.law.time, d.law.position)
    spline = Segment("spline", "spline", points[0][-1] - points[0][0], points=points)
    return Programme((spline,), points[1][0], d.law.count)
