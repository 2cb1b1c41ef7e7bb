"""Approximate poses of links, which choose the assembly mode."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from pydantic import ValidationInfo

from dalembert.errors import ModelError
from dalembert.model.part import ReadingRules, mapping, reading
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    JsonSchema,
    ValueField,
    Vector,
    at_item,
    direction_vector,
    value_text,
    vector,
    vector_schema,
)


@dataclass(frozen=True, slots=True)
class SpacePose:
    """A pose in space: position, and a turn about an axis."""

    position: Vector
    axis: Vector
    angle: float


Pose = float | tuple[float, float, float] | SpacePose


class PoseValue(ValueField):
    """An angle, `[x, y, angle]`, in space `{position, axis, angle}`."""

    def read(self, value: object, info: ValidationInfo) -> Pose:
        rules = reading(info)
        if isinstance(value, SpacePose):
            return value
        if isinstance(value, Mapping):
            return _in_space(
                mapping(value, ["position", "axis", "angle"], ""), type(rules)(rules.units, {}, 3)
            )
        if not isinstance(value, (list, tuple)):
            return rules.quantity(value, "angle")
        if len(value) != 3:
            raise ModelError(f"a list of {len(value)} is not a pose", "write an angle, or [x, y, angle]")
        kinds = ("length", "length", "angle")
        x, y, angle = (
            at_item(i, rules.quantity, item, kind)
            for i, (item, kind) in enumerate(zip(value, kinds, strict=True))
        )
        return x, y, angle

    def write(self, value: Pose) -> object:
        if isinstance(value, tuple):
            return [
                value_text(value[0], "length"),
                value_text(value[1], "length"),
                value_text(value[2], "angle"),
            ]
        if isinstance(value, SpacePose):
            position = [value_text(x, "length") for x in value.position]
            return {"position": position, "axis": list(value.axis), "angle": value_text(value.angle, "angle")}
        return value_text(value, "angle")

    def json_schema(self) -> JsonSchema:
        space = {
            "type": "object",
            "properties": {
                "position": vector_schema() | {"description": "of the link's origin, lengths"},
                "axis": vector_schema() | {"description": "about which it is turned"},
                "angle": NUMBER_OR_TEXT | {"description": "by which it is turned"},
            },
            "additionalProperties": False,
        }
        pose = {"type": "array", "items": NUMBER_OR_TEXT, "minItems": 3, "maxItems": 3}
        return {"anyOf": [NUMBER_OR_TEXT, pose, space]}


def _axis(value: object, rules: ReadingRules) -> Vector:
    return direction_vector(vector(value, "number", rules))


def _in_space(keys: Mapping[str, object], rules: ReadingRules) -> SpacePose:
    return SpacePose(
        at_item("position", vector, keys.get("position", (0.0, 0.0, 0.0)), "length", rules),
        at_item("axis", _axis, keys.get("axis", (0.0, 0.0, 1.0)), rules),
        at_item("angle", rules.quantity, keys.get("angle", 0.0), "angle"),
    )
