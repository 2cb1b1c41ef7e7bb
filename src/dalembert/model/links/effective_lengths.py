"""Effective length factors of a link's members as a file gives them, instead of those of its joints."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import ValidationInfo

from dalembert.errors import ModelError
from dalembert.model.part import reading
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    JsonSchema,
    ValueField,
    at_item,
    check_sign,
    list_schema,
    value_text,
)

Factors = dict[str, tuple[float, float]]
"""K of buckling in the plane and across it, by member `A-B`; of all members under the empty name."""


class EffectiveLength(ValueField):
    """`2`, `[1, 2]` (in the plane, across it), or of several members `{A-B: 2, B-C: [1, 2]}`."""

    def read(self, value: Any, info: ValidationInfo) -> Factors:
        if isinstance(value, Mapping):
            if not value:
                raise ModelError("no member has an effective length", "write effective_length: {A-B: 2}")
            return {str(n): at_item(str(n), self._pair, v, info) for n, v in value.items()}
        return {"": self._pair(value, info)}

    def _pair(self, value: Any, info: ValidationInfo) -> tuple[float, float]:
        both = value if isinstance(value, (list, tuple)) else (value, value)
        if len(both) != 2:
            what = f"a list of {len(both)} is not an effective length"
            raise ModelError(what, "write a factor, or [in the plane, across it]")
        first, second = (check_sign(reading(info).quantity(x, "number"), x, "positive") for x in both)
        return first, second

    def write(self, value: Factors) -> object:
        out = {
            n: value_text(a, "number") if a == b else [value_text(x, "number") for x in (a, b)]
            for n, (a, b) in value.items()
        }
        return out[""] if [*out] == [""] else out

    def json_schema(self) -> JsonSchema:
        one: JsonSchema = {"anyOf": [NUMBER_OR_TEXT, list_schema(NUMBER_OR_TEXT, 2, 2)]}
        return {"anyOf": [*one["anyOf"], {"type": "object", "additionalProperties": one}]}
