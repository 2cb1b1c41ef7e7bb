"""Motion programmes: rises, dwells and returns one after the other, over time or over another drive's position."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model.quantities.values import value_text

if TYPE_CHECKING:
    from dalembert.model.drives.curves import Curve, CurvePiece

RISES = (
    "constant_speed",
    "parabolic",
    "harmonic",
    "cycloidal",
    "modified_sine",
    "modified_trapezoid",
    "polynomial345",
    "polynomial4567",
)
RATES = ("speed", "acceleration", "jerk")
REST = "rest"
SAME = 1e-9
"""Part of a curve's largest value by which two values may differ and be equal."""


@dataclass(frozen=True)
class Segment:
    """One segment of a programme: its form, with numbers by key, SI and radians; ``length``: of its master, a time or
    the position of another drive."""

    form: str
    by: str = ""
    length: float = math.nan
    to: float = math.nan
    limits: tuple[float, ...] = ()
    ends: tuple[tuple[str, tuple[float, ...]], ...] = ()
    points: tuple[tuple[float, ...], ...] = ()

    def pieces(self, start: float, length: float) -> tuple[CurvePiece, ...]:
        """Its curve from a position."""
        from dalembert.model.drives.curves import CurvePiece, s_curve, trapezoid, unit_rise

        rise = self.to - start
        if self.form == "dwell":
            return (CurvePiece(length, (start,)),)
        if self.form == "constant":
            return (CurvePiece(length, (start, self.limits[0])),)
        if self.form == "polynomial":
            return (self._polynomial(start, length),)
        if self.form == "spline":
            return self._spline(start)
        if self.form == "s_curve":
            unit, scale = s_curve(rise, *self.limits)[0], (1.0, 1.0)
            return tuple(p.scaled(start, *scale) for p in unit)
        if self.form == "limited":
            return tuple(
                p.scaled(start, rise, self._limited(abs(rise))[0])
                for p in trapezoid(self._limited(abs(rise))[1])
            )
        unit = trapezoid(self.limits) if self.form == "trapezoidal" else unit_rise(self.by)
        return tuple(p.scaled(start, rise, length) for p in unit)

    def _polynomial(self, start: float, length: float) -> CurvePiece:
        from dalembert.model.drives.curves import polynomial

        ends = dict(self.ends)
        first = [start, *(ends[key][0] if key in ends else 0.0 for key in RATES)]
        last = [self.to, *(ends[key][1] if key in ends else None for key in RATES)]
        return polynomial(length, first, last)

    def _spline(self, start: float) -> tuple[CurvePiece, ...]:
        import numpy as np
        from scipy.interpolate import CubicSpline

        from dalembert.model.drives.curves import CurvePiece

        time, position = self.points
        speeds = dict(self.ends).get("speed")
        ends: Any = "not-a-knot" if speeds is None else ((1, speeds[0]), (1, speeds[1]))
        c = CubicSpline(time, position, bc_type=ends)
        steps = np.diff(time).tolist()
        return tuple(CurvePiece(h, tuple(x[::-1].tolist())) for h, x in zip(steps, c.c.T, strict=True))

    def _limited(self, rise: float) -> tuple[float, tuple[float, float, float]]:
        """Duration and parts of an even speeding up and slowing down within limits of speed and acceleration."""
        v, a = self.limits
        if rise * a <= v * v:
            ramp = math.sqrt(rise / a)
            return 2 * ramp, (ramp, 0.0, ramp)
        ramp = v / a
        return rise / v + ramp, (ramp, rise / v - ramp, ramp)


@dataclass(frozen=True)
class Programme:
    """A law of motion made of segments, over time or ``over`` the position of another drive, from ``start``.

    turn: 2 pi where the other drive turns, so that {dwell: rest} fills a turn, else NaN. See docs/model-file.md.
    """

    segments: tuple[Segment, ...]
    start: float = 0.0
    count: int = 1
    over: str = ""
    periodic: bool = False
    turn: float = field(default=math.nan, compare=False)
    slides: bool = field(default=False, compare=False)

    @cached_property
    def curve(self) -> Curve:
        """The curve, checked: positions and rates join; raises ModelError."""
        from dalembert.model.drives.curves import Curve

        filled = sum(s.length for s in self.segments if not math.isnan(s.length))
        pieces, position = list["CurvePiece"](), self.start
        for k, segment in enumerate(self.segments):
            length = segment.length
            if math.isnan(length) and segment.form == "dwell":
                length = self._rest(filled, k)
            new = segment.pieces(position, length)
            if pieces:
                _check_join(pieces[-1], new[0], k, sum(p.length for p in pieces), bool(self.over))
            pieces += new
            position = float(new[-1].end()[0])
        curve = Curve(tuple(pieces), self.periodic)
        if self.periodic:
            self._check_closed(curve)
        return curve

    def _rest(self, filled: float, k: int) -> float:
        if math.isnan(self.turn):
            what = "{dwell: rest} fills a turn of another drive, and this law is over " + (
                "a length" if self.over else "time"
            )
            raise ModelError(what, "write how long it dwells", ("segments", k, "dwell"))
        if filled >= self.turn:
            what = f"the segments fill {math.degrees(filled):.6g} deg before this dwell: nothing of the turn is left"
            raise ModelError(what, "leave it out, or shorten the others", ("segments", k))
        return self.turn - filled

    def _check_closed(self, curve: Curve) -> None:
        if not math.isnan(self.turn) and abs(curve.duration - self.turn) > SAME * self.turn:
            what = f"the segments fill {math.degrees(curve.duration):.6g} deg of a turn"
            raise ModelError(what, "add {dwell: rest}, or write periodic: false", ("segments",))
        first, last = curve.pieces[0].start()[:2], curve.pieces[-1].end()[:2]
        size = max(curve.peaks(0)[0], 1e-300)
        if abs(first[0] - last[0]) > SAME * size:
            raise ModelError(
                "the law is periodic and does not end where it begins",
                "end it with {to: ...} the first position, or write periodic: false",
                ("segments",),
            )
        if abs(first[1] - last[1]) > SAME * curve.peaks(1)[0]:
            raise ModelError(
                "the speed jumps where the law begins again", "let it end as it begins", ("segments",)
            )

    def motion(self, count: int | None = None, before: bool = False) -> tuple[Array, Array, Array, Array]:
        """Time, position, speed and acceleration at `count` equal steps; a periodic law does not repeat its start.
        Where the acceleration jumps, just after it, or ``before`` it."""
        import numpy as np

        t = np.linspace(0.0, self.curve.duration, count or self.count, endpoint=not self.periodic)
        return (t, *self._beside(t, np.full(t.shape, -1.0 if before else 1.0))[:3])

    def following(
        self, position: Array, speed: Array, acceleration: Array, before: bool = False
    ) -> tuple[Array, Array, Array]:
        """Position, speed s' w and acceleration s'' w^2 + s' alpha where the other drive has these (P,)."""
        import numpy as np

        sense = np.sign(speed) * (-1 if before else 1)
        s, first, second, _ = self._beside(position, sense)
        beside = position + sense * SAME * self.curve.duration
        rests = (beside < 0) | (beside > self.curve.duration) if not self.periodic else np.False_
        first, second = (np.where(rests, 0.0, x) for x in (first, second))
        return s, first * speed, second * speed**2 + first * acceleration

    def _beside(self, x: Array, sense: Array) -> Array:
        """s and its derivatives (4, P); where the second one jumps, on the side of a sense (P,)."""
        import numpy as np

        behind, ahead = self.curve.at(x, before=True), self.curve.at(x)
        jumps = np.abs(ahead[2] - behind[2]) > SAME * self.curve.peaks(2)[0]
        ahead[2:] = np.where(jumps & (sense < 0), behind[2:], ahead[2:])
        return ahead

    def tree(self, kind: str) -> dict[str, object]:
        """Mapping as in a file."""
        master = ("length" if self.slides else "angle") if self.over else "time"
        out: dict[str, object] = {"over": self.over} if self.over else {}
        if self.start:
            out["from"] = value_text(self.start, kind)
        out["segments"] = [segment_tree(s, kind, master) for s in self.segments]
        if not self.over:
            out["count"] = self.count
        if self.periodic != bool(self.over and not math.isnan(self.turn)):
            out["periodic"] = self.periodic
        return out


def _check_join(left: CurvePiece, right: CurvePiece, k: int, at: float, over: bool) -> None:
    """Refuse a jump of speed, which would need an infinite force."""
    v, w = float(left.end()[1]), float(right.start()[1])
    if abs(v - w) > 1e-6 * max(abs(v), abs(w), 1e-300) and max(abs(v), abs(w)) > SAME * _mean_rate(
        left, right
    ):
        where = f"{math.degrees(at):.6g} deg" if over else f"{at:.6g} s"
        raise ModelError(
            f"the speed jumps from {v:.6g} to {w:.6g} (SI) at {where}, where this segment begins",
            "let a segment begin with the speed with which the one before it ends: {by: polynomial, ends: {speed: "
            "[a, b]}}",
            ("segments", k),
        )


def _mean_rate(*pieces: CurvePiece) -> float:
    return max(abs(float(p.end()[0] - p.start()[0])) / p.length for p in pieces) or 1e-300


def rate_kind(kind: str, what: str) -> str:
    """Kind of a drive's speed, acceleration or jerk."""
    return what if kind == "length" else f"angular_{what}"


def segment_tree(s: Segment, kind: str, master: str) -> dict[str, object]:
    """A segment as written in a file; ``master``: kind of the quantity that it depends on."""
    out: dict[str, object] = {}
    if s.form == "dwell":
        return {"dwell": REST if math.isnan(s.length) else value_text(s.length, master)}
    if not math.isnan(s.to):
        out["to"] = value_text(s.to, kind)
    if s.by:
        out["by"] = s.by
    if s.form == "spline":
        out["time"] = [value_text(t, master) for t in s.points[0]]
        out["position"] = [value_text(x, kind) for x in s.points[1]]
    elif not math.isnan(s.length):
        out["in"] = value_text(s.length, master)
    if s.form == "trapezoidal":
        out["parts"] = list(s.limits)
    else:
        out |= {key: value_text(x, rate_kind(kind, key)) for key, x in zip(RATES, s.limits, strict=False)}
    if s.ends:
        out["ends"] = {key: [value_text(x, rate_kind(kind, key)) for x in pair] for key, pair in s.ends}
    return out
