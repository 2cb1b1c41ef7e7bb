"""Motion programmes: rises, dwells and returns one after the other, over time or over another drive's position."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model.part import Reading, mapping
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    JsonSchema,
    at_item,
    check_sign,
    list_schema,
    numbers,
    object_schema,
    value_text,
)
from dalembert.wording import closest, quote_value

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
FORMS = (*RISES, "polynomial", "spline", "trapezoidal", "s_curve")
RATES = ("speed", "acceleration", "jerk")
EXAMPLE = "{segments: [{to: 25 mm, in: 0.2 s, by: cycloidal}, {dwell: 0.1 s}], count: 181}"
RISE_EXAMPLE = "{to: 25 mm, in: 0.2 s, by: cycloidal}"
KEYS = {
    "dwell": ["dwell"],
    "constant": ["speed", "in"],
    "polynomial": ["to", "in", "by", "ends"],
    "spline": ["by", "time", "position", "ends"],
    "s_curve": ["to", "by", *RATES],
    "limited": ["to", "by", "speed", "acceleration"],
    "trapezoidal": ["to", "in", "by", "parts"],
    "rise": ["to", "in", "by"],
}
"""Form of a segment -> its keys."""
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

    def motion(self, count: int | None = None) -> tuple[Array, Array, Array, Array]:
        """Time, position, speed and acceleration at `count` equal steps; a periodic law does not repeat its start."""
        import numpy as np

        t = np.linspace(0.0, self.curve.duration, count or self.count, endpoint=not self.periodic)
        s, v, a, _ = self.curve.at(t)
        if not self.periodic:
            s[-1:], v[-1:], a[-1:] = self.curve.at(t[-1:], before=True)[:3]
        return t, s, v, a

    def following(self, position: Array, speed: Array, acceleration: Array) -> tuple[Array, Array, Array]:
        """Position, speed s' w and acceleration s'' w^2 + s' alpha where the other drive has these (P,)."""
        s, first, second, _ = self.curve.at(position)
        return s, first * speed, second * speed**2 + first * acceleration

    def tree(self, kind: str) -> dict[str, object]:
        """Mapping as in a file."""
        master = ("length" if self.slides else "angle") if self.over else "time"
        out: dict[str, object] = {"over": self.over} if self.over else {}
        if self.start:
            out["from"] = value_text(self.start, kind)
        out["segments"] = [_segment_tree(s, kind, master) for s in self.segments]
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


def programme(value: Mapping[str, object], kind: str, rules: Reading) -> Programme:
    """The programme that a mapping describes; positions are of the kind `angle` or `length`."""
    known = ["over", "from", "segments", "count", "periodic"]
    mapping(value, known, EXAMPLE, ["segments"])
    over = value.get("over", "")
    if not isinstance(over, str):
        raise ModelError(f"{quote_value(over)} is not the name of a drive", "write over: O", ("over",))
    slides = bool(over) and rules.freedoms.get(over) == "slide"
    listed = value["segments"]
    if isinstance(listed, str) or not isinstance(listed, Sequence) or not listed:
        raise ModelError(
            f"{quote_value(listed)} is not a list of segments", f"write {EXAMPLE}", ("segments",)
        )
    master = ("length" if slides else "angle") if over else "time"
    read = [at_item("segments", at_item, k, _segment, s, kind, master, rules) for k, s in enumerate(listed)]
    start = at_item("from", rules.quantity, value["from"], kind) if "from" in value else 0.0
    if not over and "count" not in value:
        raise ModelError("the key 'count' is missing", f"write {EXAMPLE}")
    turn = 2 * math.pi if over and not slides else math.nan
    periodic = value.get("periodic", not math.isnan(turn))
    if not isinstance(periodic, bool):
        raise ModelError(
            f"{quote_value(periodic)} is neither true nor false", "write periodic: true", ("periodic",)
        )
    from dalembert.model.drives.laws import count

    number = at_item("count", count, value["count"], 1) if "count" in value else 1
    out = Programme(tuple(read), start, number, over, periodic, turn, slides)
    if out.segments[0].form == "spline" and "from" not in value:
        out = replace(out, start=out.segments[0].points[1][0])
    out.curve  # noqa: B018  # refused where it is read
    return out


def _segment(value: object, kind: str, master: str, rules: Reading) -> Segment:
    if not isinstance(value, Mapping):
        raise ModelError(f"{quote_value(value)} is not a segment", f"write {RISE_EXAMPLE}")
    form = _form(value)
    keys = KEYS[form]
    optional = {"ends"}
    mapping(value, keys, RISE_EXAMPLE, [k for k in keys if k not in optional])
    if master != "time" and form in ("constant", "s_curve", "limited"):
        what = f"{'a speed' if form == 'constant' else 'limits of speed'} in a law over another drive"
        raise ModelError(
            what,
            f"write {RISE_EXAMPLE.replace('0.2 s', '100 deg')}",
            ("by",) if "by" in value else ("speed",),
        )
    found: dict[str, Any] = {"form": form, "by": str(value.get("by", ""))}
    if "in" in value or (form == "dwell" and value["dwell"] != REST):
        key = "in" if "in" in value else "dwell"
        found["length"] = at_item(key, rules.quantity, value[key], master)
        at_item(key, check_sign, found["length"], value[key], "positive")
    if "to" in value:
        found["to"] = at_item("to", rules.quantity, value["to"], kind)
    if form in ("constant", "s_curve", "limited"):
        found["limits"] = tuple(_limit(key, value[key], kind, form, rules) for key in RATES if key in value)
    if form == "trapezoidal":
        found["limits"] = at_item("parts", _parts, value["parts"], rules)
    if "ends" in value:
        found["ends"] = at_item("ends", _ends, value["ends"], kind, master, form, rules)
    if form == "spline":
        found["points"] = _points(value, kind, master, rules)
        found["length"] = found["points"][0][-1] - found["points"][0][0]
    return Segment(**found)


def _form(value: Mapping[str, object]) -> str:
    if "dwell" in value:
        return "dwell"
    by = value.get("by")
    if by is None:
        if "speed" in value and "to" not in value:
            return "constant"
        raise ModelError("the key 'by' is missing", f"write {RISE_EXAMPLE}")
    if by not in FORMS:
        raise ModelError(f"unknown motion curve {quote_value(by)}", closest(str(by), list(FORMS)), ("by",))
    if by in ("polynomial", "spline", "s_curve"):
        return str(by)
    if by == "trapezoidal":
        return "limited" if "acceleration" in value or "speed" in value else "trapezoidal"
    return "rise"


def _limit(key: str, value: object, kind: str, form: str, rules: Reading) -> float:
    number = at_item(key, rules.quantity, value, rate_kind(kind, key))
    return number if form == "constant" else at_item(key, check_sign, number, value, "positive")


def _parts(value: object, rules: Reading) -> tuple[float, ...]:
    parts = numbers(value, "number", rules)
    if len(parts) != 3 or min(parts) < 0 or parts[0] + parts[2] <= 0:
        raise ModelError(
            f"{quote_value(value)} are not the parts of speeding up, even speed and slowing down",
            "write parts: [1, 1, 1]",
        )
    return parts


def _ends(
    value: object, kind: str, master: str, form: str, rules: Reading
) -> tuple[tuple[str, tuple[float, ...]], ...]:
    """Rates at both ends, by key."""
    known = ["speed"] if form == "spline" else list(RATES)
    keys = mapping(value, known, "ends: {speed: [0, 0.3 m/s], acceleration: [0, 0]}")
    if master != "time":
        raise ModelError("rates at the ends are given in a law over another drive", "leave them out")
    rates = [key in keys for key in RATES]
    if rates != sorted(rates, reverse=True):
        raise ModelError(
            "a rate is given without the one below it", "give speed, then acceleration, then jerk"
        )
    out = []
    for key in keys:
        pair = at_item(key, numbers, keys[key], rate_kind(kind, key), rules)
        if len(pair) != 2:
            raise ModelError(
                f"{quote_value(keys[key])} are not the rates at both ends", f"write {key}: [a, b]", (key,)
            )
        out.append((key, pair))
    return tuple(sorted(out, key=lambda item: RATES.index(item[0])))


def _points(
    value: Mapping[str, object], kind: str, master: str, rules: Reading
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    time = at_item("time", numbers, value["time"], master, rules)
    position = at_item("position", numbers, value["position"], kind, rules)
    if len(time) != len(position) or len(time) < 4:
        what = f"a spline has {len(time)} times and {len(position)} positions"
        raise ModelError(what, "give at least 4 points, one position for each time", ("position",))
    late = next((k for k in range(1, len(time)) if time[k] <= time[k - 1]), None)
    if late is not None:
        what = f"the times must increase: item {late + 1} is not greater than item {late}"
        raise ModelError(what, "sort the points", ("time", late))
    return time, position


def _segment_tree(s: Segment, kind: str, master: str) -> dict[str, object]:
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


def programme_schema() -> JsonSchema:
    """JSON schema of a programme."""
    pair = list_schema(NUMBER_OR_TEXT, 2, 2) | {"description": "at its start and its end"}
    parts = {
        "to": NUMBER_OR_TEXT | {"description": "position at its end, an angle or length"},
        "in": NUMBER_OR_TEXT
        | {"description": "its length: a time, or an angle or length of the drive it is over"},
        "by": {"enum": list(FORMS), "description": "curve of the segment"},
        "dwell": NUMBER_OR_TEXT | {"description": "rest for this long; rest: what a turn leaves"},
        "speed": NUMBER_OR_TEXT | {"description": "constant speed, or the limit of one"},
        "acceleration": NUMBER_OR_TEXT | {"description": "limit of the acceleration"},
        "jerk": NUMBER_OR_TEXT | {"description": "limit of the jerk"},
        "parts": {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3}
        | {"description": "parts of a trapezoidal rise: speeding up, even, slowing down"},
        "ends": object_schema(dict.fromkeys(RATES, pair)) | {"description": "rates at both ends"},
        "time": list_schema() | {"description": "of a spline's points"},
        "position": list_schema() | {"description": "of a spline's points"},
    }
    keys = {
        "segments": {
            "type": "array",
            "items": object_schema(parts),
            "minItems": 1,
            "description": "in their order",
        },
        "over": {
            "type": "string",
            "description": "another drive over whose position the law is; default time",
        },
        "from": NUMBER_OR_TEXT | {"description": "first position; default 0"},
        "count": {"type": "integer", "minimum": 1, "description": "instants, of a law over time"},
        "periodic": {
            "type": "boolean",
            "description": "it begins again; default true over a drive that turns",
        },
    }
    return object_schema(keys, "segments")
