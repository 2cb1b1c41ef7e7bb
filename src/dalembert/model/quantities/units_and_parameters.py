"""Reads the head of a file: units of bare numbers, and named parameters."""

from __future__ import annotations

from pydantic import ValidationInfo

from dalembert.model.part import reading
from dalembert.model.quantities.parameters import Parameters
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    JsonSchema,
    ValueField,
    list_schema,
    object_schema,
)
from dalembert.units import ALSO_CALLED, BASES, KINDS, Units, file_units


class UnitsValue(ValueField):
    """The file's units."""

    def read(self, value: object, info: ValidationInfo) -> Units:
        return file_units(value)

    def write(self, value: Units) -> object:
        return value.tree()

    def json_schema(self) -> JsonSchema:
        examples = {"length": "m", "force": "N", "mass": "kg", "time": "s", "angle": "deg"}
        for key, kind in ({kind: kind for kind in KINDS} | ALSO_CALLED).items():
            if kind not in (*BASES, "number"):
                examples[key] = f"a product of these ({KINDS[kind].si})"
        words = "unit of bare numbers; default"
        return object_schema(
            {k: {"type": "string", "description": f"{words} {u}"} for k, u in examples.items()}
        )


class ParametersValue(ValueField):
    """The file's parameters, which were read before anything else."""

    def read(self, value: object, info: ValidationInfo) -> Parameters:
        return reading(info).parameters

    def write(self, value: Parameters) -> object:
        return {name: parameter.tree() for name, parameter in value.items()}

    def json_schema(self) -> JsonSchema:
        ends = list_schema(NUMBER_OR_TEXT, 2, 2) | {"description": "between which values it makes sense"}
        properties = {
            "value": NUMBER_OR_TEXT | {"description": "a quantity, or an expression of other parameters"},
            "about": {"type": "string", "description": "what it is"},
            "range": ends,
        }
        either = [NUMBER_OR_TEXT, object_schema(properties, "value")]
        return {"type": "object", "additionalProperties": {"anyOf": either}}
