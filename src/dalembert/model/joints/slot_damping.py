"""Damping of a slot: of its slide, or of both its freedoms."""

from __future__ import annotations

from collections.abc import Mapping

from pydantic import ValidationInfo

from dalembert.model.part import mapping, reading
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    JsonSchema,
    ValueField,
    at_item,
    check_sign,
    value_text,
)


class SlotDamping(ValueField):
    """Damping of the slide; or `{slide:, turn:}`."""

    def read(self, value: object, info: ValidationInfo) -> tuple[float, float]:
        rules = reading(info)
        if isinstance(value, tuple):
            return value[0], value[1]
        keys = value if isinstance(value, Mapping) else {"slide": value}
        mapping(keys, ["slide", "turn"], "{slide: 30, turn: 0.2}")
        pair = (
            at_item(key, rules.quantity, keys.get(key, 0.0), kind)
            for key, kind in (("slide", "damping"), ("turn", "torsion_damping"))
        )
        slide, turn = (check_sign(number, number, "not negative") for number in pair)
        return slide, turn

    def write(self, value: tuple[float, float]) -> object:
        return {"slide": value_text(value[0], "damping"), "turn": value_text(value[1], "torsion_damping")}

    def json_schema(self) -> JsonSchema:
        both = {
            "type": "object",
            "properties": {
                "slide": NUMBER_OR_TEXT | {"description": "force per speed"},
                "turn": NUMBER_OR_TEXT | {"description": "moment per angular speed"},
            },
            "additionalProperties": False,
        }
        return {"anyOf": [NUMBER_OR_TEXT, both]}
