"""Loads along a span: its ends, and forces as tables: tension over the change of length, or over its rate."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, Any

from pydantic import ValidationInfo

from dalembert.errors import ModelError
from dalembert.model.part import mapping, reading
from dalembert.model.quantities.values import (
    JsonSchema,
    ValueField,
    at_item,
    list_schema,
    name,
    numbers,
    object_schema,
    value_text,
)
from dalembert.wording import quote_value

EXAMPLES = {
    "length": "force: {x: [-20 mm, 0 mm, 5 mm], y: [-4000 N, 0 N, 0 N]}",
    "speed": "force: {x: [-1 m/s, 0 m/s, 1 m/s], y: [-300 N, 0 N, 900 N]}",
}


class Ends(ValueField):
    """`[link.point, link.point]`."""

    def read(self, value: object, info: ValidationInfo) -> tuple[tuple[str, str], tuple[str, str]]:
        if isinstance(value, str) or not isinstance(value, (list, tuple)) or len(value) != 2:
            raise ModelError(f"expected two points, not {quote_value(value)}", "write [ground.A, rod.B]")
        first, second = (at_item(i, _end, item) for i, item in enumerate(value))
        return first, second

    def write(self, value: Any) -> object:
        return [".".join(end) for end in value]

    def json_schema(self) -> JsonSchema:
        return {"type": "array", "items": {"type": "string"}, "minItems": 2, "maxItems": 2}


def _end(value: object) -> tuple[str, str]:
    if isinstance(value, tuple) and len(value) == 2:
        return name(value[0]), name(value[1])
    if not isinstance(value, str) or value.count(".") != 1:
        raise ModelError(
            f"{quote_value(value)} is not a point of a link", "write link.point, for example rod.B"
        )
    link, point = value.split(".")
    return name(link), name(point)


TwoEnds = Annotated[tuple[tuple[str, str], tuple[str, str]], Ends()]


@dataclass(frozen=True, slots=True)
class ForceLaw:
    """Tension ``y``, N, at ``x``, m or m/s, by straight lines; beyond both ends the last value holds."""

    x: tuple[float, ...]
    y: tuple[float, ...]

    @property
    def bends(self) -> tuple[tuple[float, float], ...]:
        """Places where the slope changes, and by how much; before the first it is 0.

        >>> ForceLaw((0.0, 1.0, 3.0), (0.0, 10.0, 14.0)).bends
        ((0.0, 10.0), (1.0, -8.0), (3.0, -2.0))
        """
        slopes = [(d - b) / (c - a) for (a, b), (c, d) in pairwise(zip(self.x, self.y, strict=True))]
        changes = [new - old for old, new in pairwise([0.0, *slopes, 0.0])]
        return tuple(zip(self.x, changes, strict=True))


class ForceLawValue(ValueField):
    """`{x: [...], y: [...]}`; ``kind``: of x, a length or a speed."""

    def __init__(self, kind: str) -> None:
        self.kind = kind

    def read(self, value: object, info: ValidationInfo) -> ForceLaw:
        if isinstance(value, ForceLaw):
            return value
        keys = mapping(value, ["x", "y"], EXAMPLES[self.kind], ("x", "y"))
        x, y = (
            at_item(key, numbers, keys[key], kind, reading(info))
            for key, kind in (("x", self.kind), ("y", "force"))
        )
        if len(x) != len(y) or len(x) < 2:
            what = f"the table has {len(x)} values in x and {len(y)} in y"
            raise ModelError(what, "give one y for each x, two points at least")
        for k, (a, b) in enumerate(pairwise(x)):
            if not a < b:
                what = f"x of the table does not increase from its item {k + 1} to {k + 2}"
                raise ModelError(what, "sort the points, each x once", ("x", k + 1))
        return ForceLaw(x, y)

    def write(self, value: ForceLaw) -> object:
        pairs = ((value.x, self.kind), (value.y, "force"))
        return {
            key: [value_text(v, kind) for v in some] for key, (some, kind) in zip("xy", pairs, strict=True)
        }

    def json_schema(self) -> JsonSchema:
        words = "change of length" if self.kind == "length" else "rate of the length"
        columns = {
            "x": list_schema(least=2) | {"description": words},
            "y": list_schema(least=2) | {"description": "tension"},
        }
        return object_schema(columns, "x", "y")


def one_force(keys: object, slope: str) -> object:
    """The keys of a spring or damper; beside a table of its force its slope is 0."""
    tabled = isinstance(keys, Mapping) and keys.get("force") is not None and slope not in keys
    return {**keys, slope: 0.0} if tabled else keys  # type: ignore[dict-item]


def refuse_both(load: Any) -> Any:
    """Refuse a spring or damper with a table of its force and a slope."""
    slope = "stiffness" if hasattr(load, "stiffness") else "damping"
    if (getattr(load, "law", None) or getattr(load, "rate_law", None)) and getattr(load, slope):
        raise ModelError(
            f"both a {slope} and a table of its force are given", "leave one of them out", ("force",)
        )
    return load
