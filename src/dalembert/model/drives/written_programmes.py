"""Motion programmes as written in a file: reading, and the schema."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from dalembert.errors import ModelError
from dalembert.model.drives.programmes import RATES, REST, RISES, Programme, Segment, rate_kind
from dalembert.model.part import ReadingRules, mapping
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    JsonSchema,
    at_item,
    check_sign,
    list_schema,
    numbers,
    object_schema,
)
from dalembert.wording import closest, quote_value

MOST = 10_000_000
"""Positions of one analysis."""

FORMS = (*RISES, "polynomial", "spline", "trapezoidal", "s_curve")
INSTANTS = 181
"""Instants of a law over time whose count is left out."""
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


def count(value: object, least: int = 1) -> int:
    """A number of positions."""
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= MOST:
        what = f"{quote_value(value)} is not a number of positions"
        raise ModelError(what, f"write an integer from {least} to {MOST}")
    return value


def programme(value: Mapping[str, object], kind: str, rules: ReadingRules) -> Programme:
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
    turn = 2 * math.pi if over and not slides else math.nan
    periodic = value.get("periodic", not math.isnan(turn))
    if not isinstance(periodic, bool):
        raise ModelError(
            f"{quote_value(periodic)} is neither true nor false", "write periodic: true", ("periodic",)
        )
    number = at_item("count", count, value["count"], 1) if "count" in value else 1 if over else INSTANTS
    out = Programme(tuple(read), start, number, over, periodic, turn, slides)
    if out.segments[0].form == "spline" and "from" not in value:
        out = replace(out, start=out.segments[0].points[1][0])
    out.curve  # noqa: B018  # refused where it is read
    return out


def _segment(value: object, kind: str, master: str, rules: ReadingRules) -> Segment:
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
    out: dict[str, Any] = {"form": form, "by": str(value.get("by", ""))}
    if "in" in value or (form == "dwell" and value["dwell"] != REST):
        key = "in" if "in" in value else "dwell"
        out["length"] = at_item(key, rules.quantity, value[key], master)
        at_item(key, check_sign, out["length"], value[key], "positive")
    if "to" in value:
        out["to"] = at_item("to", rules.quantity, value["to"], kind)
    if form in ("constant", "s_curve", "limited"):
        out["limits"] = tuple(_limit(key, value[key], kind, form, rules) for key in RATES if key in value)
    if form == "trapezoidal":
        out["limits"] = at_item("parts", _parts, value["parts"], rules)
    if "ends" in value:
        out["ends"] = at_item("ends", _ends, value["ends"], kind, master, form, rules)
    if form == "spline":
        out["points"] = _points(value, kind, master, rules)
        out["length"] = out["points"][0][-1] - out["points"][0][0]
    return Segment(**out)


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


def _limit(key: str, value: object, kind: str, form: str, rules: ReadingRules) -> float:
    number = at_item(key, rules.quantity, value, rate_kind(kind, key))
    return number if form == "constant" else at_item(key, check_sign, number, value, "positive")


def _parts(value: object, rules: ReadingRules) -> tuple[float, ...]:
    parts = numbers(value, "number", rules)
    if len(parts) != 3 or min(parts) < 0 or parts[0] + parts[2] <= 0:
        raise ModelError(
            f"{quote_value(value)} are not the parts of speeding up, even speed and slowing down",
            "write parts: [1, 1, 1]",
        )
    return parts


def _ends(
    value: object, kind: str, master: str, form: str, rules: ReadingRules
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
            what = f"{len(pair)} {'value is' if len(pair) == 1 else 'values are'} not the rates at both ends"
            raise ModelError(what, f"write {key}: [a, b]", (key,))
        out.append((key, pair))
    return tuple(sorted(out, key=lambda item: RATES.index(item[0])))


def _points(
    value: Mapping[str, object], kind: str, master: str, rules: ReadingRules
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
        "count": {
            "type": "integer",
            "minimum": 1,
            "description": "instants, of a law over time; default 181",
        },
        "periodic": {
            "type": "boolean",
            "description": "it begins again; default true over a drive that turns",
        },
    }
    return object_schema(keys, "segments")
