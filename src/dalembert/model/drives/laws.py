"""Laws of motion: the position of a drive in time, with its speed and acceleration."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model.drives.expression_laws import ExpressionLaw, expression_law, expression_law_schema
from dalembert.model.drives.programmes import Programme
from dalembert.model.drives.written_programmes import count, programme, programme_schema
from dalembert.model.part import ReadingRules, mapping
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    JsonSchema,
    at_item,
    check_sign,
    numbers,
    object_schema,
    value_text,
)
from dalembert.wording import closest, quote_value

RISES = ("harmonic", "cycloidal", "polynomial345")
TYPES = (*RISES, "table")
EXAMPLES = {
    "rise": "{type: cycloidal, from: 0, to: 90 deg, duration: 0.2 s, count: 50}",
    "table": "{type: table, time: [...], position: [...], count: 50}",
}


@dataclass(frozen=True, slots=True)
class Rise:
    """A rise from `start` to `stop` within `duration`, at rest before and after it; u = t / duration.

    harmonic:      (1 - cos pi u) / 2
    cycloidal:     u - sin(2 pi u) / (2 pi)
    polynomial345: 10 u^3 - 15 u^4 + 6 u^5

    >>> Rise("cycloidal", 0.0, 0.02, 0.5, 101).at(0.5)[0].item()    # half of the rise at half of the time
    0.01
    """

    type: str
    start: float
    stop: float
    duration: float
    count: int

    def motion(self, count: int | None = None) -> tuple[Array, Array, Array, Array]:
        """Time, position, speed and acceleration at `count` equal steps, both ends among them."""
        import numpy as np

        u = np.linspace(0.0, 1.0, count or self.count)
        return u * self.duration, *self.at(u)

    def at(self, u: Array) -> tuple[Array, Array, Array]:
        """Position, speed and acceleration at parts u of the duration."""
        shape, slope, bend = _shape(self.type, u)
        rise, t = self.stop - self.start, self.duration
        return self.start + rise * shape, rise / t * slope, rise / t**2 * bend

    def tree(self, kind: str) -> dict[str, object]:
        """As a file says it."""
        return {
            "type": self.type,
            "from": value_text(self.start, kind),
            "to": value_text(self.stop, kind),
            "duration": value_text(self.duration, "time"),
            "count": self.count,
        }


def _shape(form: str, u: Array) -> tuple[Array, Array, Array]:
    import numpy as np

    if form == "harmonic":
        a = math.pi
        return (1 - np.cos(a * u)) / 2, a / 2 * np.sin(a * u), a**2 / 2 * np.cos(a * u)
    if form == "cycloidal":
        a = 2 * math.pi
        return u - np.sin(a * u) / a, 1 - np.cos(a * u), a * np.sin(a * u)
    return (
        u**3 * (10 - 15 * u + 6 * u**2),
        30 * u**2 * (1 - u) ** 2,
        60 * u * (1 - u) * (1 - 2 * u),
    )


@dataclass(frozen=True, slots=True)
class TimeTable:
    """Positions at given times, between them a cubic spline, so that speed and acceleration exist.

    periodic: the last position repeats the first, with its speed and acceleration; the last instant is not repeated.

    >>> import numpy as np
    >>> table = TimeTable((0.0, 1.0, 2.0), (0.0, 0.1, 0.0), 5)
    >>> table.at(np.array([1.0]))[0].tolist()
    [0.1]
    """

    time: tuple[float, ...]
    position: tuple[float, ...]
    count: int
    periodic: bool = False

    def motion(self, count: int | None = None) -> tuple[Array, Array, Array, Array]:
        """Time, position, speed and acceleration at `count` equal steps of time."""
        import numpy as np

        t = np.linspace(self.time[0], self.time[-1], count or self.count, endpoint=not self.periodic)
        return t, *self.at(t)

    def at(self, t: Array | float) -> tuple[Array, Array, Array]:
        """Position, speed and acceleration at times."""
        import numpy as np
        from scipy.interpolate import CubicSpline

        y = np.array(self.position)
        if self.periodic:
            y[-1] = y[0]
        spline = CubicSpline(self.time, y, bc_type="periodic" if self.periodic else "not-a-knot")
        return spline(t), spline(t, 1), spline(t, 2)

    def tree(self, kind: str) -> dict[str, object]:
        """As a file says it."""
        tree: dict[str, object] = {
            "type": "table",
            "time": [value_text(t, "time") for t in self.time],
            "position": [value_text(x, kind) for x in self.position],
            "count": self.count,
        }
        return tree | ({"periodic": True} if self.periodic else {})


Law = Rise | TimeTable | Programme | ExpressionLaw


def law(value: object, kind: str, rules: ReadingRules) -> Law:
    """The law that a tree describes; positions are of the kind `angle` or `length`."""
    if isinstance(value, Law):
        return value
    if not isinstance(value, Mapping):
        raise ModelError(f"{quote_value(value)} is not a law of motion", f"write {EXAMPLES['rise']}")
    if "expression" in value:
        return expression_law(value, kind, rules)
    if "segments" in value:
        return programme(value, kind, rules)
    form = value.get("type")
    if form not in TYPES:
        problem = "the key 'type' is missing" if form is None else f"unknown law {quote_value(form)}"
        raise ModelError(problem, closest(str(form), list(TYPES)), () if form is None else ("type",))
    return _table(value, kind, rules) if form == "table" else _rise(value, kind, rules)


def _rise(value: Mapping[str, object], kind: str, rules: ReadingRules) -> Rise:
    known = ["type", "from", "to", "duration", "count"]
    mapping(value, known, EXAMPLES["rise"], known)
    start, stop = (at_item(key, rules.quantity, value[key], kind) for key in ("from", "to"))
    duration = at_item("duration", rules.quantity, value["duration"], "time")
    at_item("duration", check_sign, duration, value["duration"], "positive")
    return Rise(str(value["type"]), start, stop, duration, at_item("count", count, value["count"], 2))


def _table(value: Mapping[str, object], kind: str, rules: ReadingRules) -> TimeTable:
    if value.get("interpolate", "cubic") != "cubic":
        raise ModelError(
            f"a law of motion is not interpolated {quote_value(value['interpolate'])}: "
            "its accelerations would be infinite",
            "write interpolate: cubic, or leave it out",
            ("interpolate",),
        )
    keys = {key: item for key, item in value.items() if key not in ("interpolate", "periodic")}
    known = ["type", "time", "position", "count"]
    mapping(keys, known, EXAMPLES["table"], known)
    time = at_item("time", numbers, value["time"], "time", rules)
    position = at_item("position", numbers, value["position"], kind, rules)
    periodic = value.get("periodic", False)
    _check_table(time, position, periodic)
    return TimeTable(time, position, at_item("count", count, value["count"], 1), periodic is True)


def _check_table(time: tuple[float, ...], position: tuple[float, ...], periodic: object) -> None:
    if len(time) != len(position):
        what = f"it has {len(time)} times and {len(position)} positions"
        raise ModelError(what, "give one position for each time")
    if len(time) < 4:
        raise ModelError(f"it has too few points: {len(time)}", "give at least 4, or a harmonic law")
    if any(not a < b for a, b in pairwise(time)):
        raise ModelError("its times do not increase", "sort the points", ("time",))
    if not isinstance(periodic, bool):
        problem = f"{quote_value(periodic)} is neither true nor false"
        raise ModelError(problem, "write periodic: true", ("periodic",))
    if periodic and abs(position[-1] - position[0]) > 1e-9 * max(map(abs, position)):
        words = "it does not end where it begins"
        raise ModelError(words, "repeat the first position at the end", ("periodic",))


def law_schema() -> JsonSchema:
    listed = {"type": "array", "items": NUMBER_OR_TEXT}
    rise = {
        "type": {"enum": list(RISES), "description": "form of the rise, at rest at both ends"},
        "from": NUMBER_OR_TEXT | {"description": "position at its beginning, an angle or length"},
        "to": NUMBER_OR_TEXT | {"description": "position at its end, an angle or length"},
        "duration": NUMBER_OR_TEXT | {"description": "of the rise, a time"},
        "count": {"type": "integer", "minimum": 2, "description": "instants, both ends among them"},
    }
    table = {
        "type": {"const": "table", "description": "positions at given times"},
        "time": listed | {"description": "times, increasing"},
        "position": listed | {"description": "positions then, angles or lengths"},
        "count": {"type": "integer", "minimum": 1, "description": "instants, at equal steps of time"},
        "interpolate": {"const": "cubic", "description": "a cubic spline, the default"},
        "periodic": {"type": "boolean", "description": "the last position repeats the first; default false"},
    }
    written = (object_schema(rise, *rise), object_schema(table, *list(table)[:4]))
    return {"anyOf": [*written, programme_schema(), expression_law_schema()]}
