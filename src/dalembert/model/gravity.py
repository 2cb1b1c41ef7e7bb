"""Gravity: none, standard, or a vector."""

from __future__ import annotations

from typing import Literal

from pydantic import ValidationInfo

from dalembert.errors import ModelError
from dalembert.model.part import reading
from dalembert.model.quantities.values import JsonSchema, Value, Vector, vector, vector_schema, vector_text
from dalembert.wording import closest, quote_value

STANDARD = 9.80665
"""Standard acceleration of gravity, m/s2."""

Gravity = Vector | Literal["standard"] | None


class GravityValue(Value):
    """`none`, `standard`, or a vector of accelerations."""

    def read(self, value: object, info: ValidationInfo) -> Gravity:
        if value is None or value == "none":
            return None
        if value == "standard":
            return "standard"
        if isinstance(value, str) and "@" not in value:
            raise ModelError(
                f"{quote_value(value)} says no direction",
                closest(value, ["none", "standard"]) + "; or write a vector, gravity: [0, -9.81]",
            )
        return vector(value, "acceleration", reading(info))

    def write(self, value: Gravity) -> object:
        if isinstance(value, tuple):
            return vector_text(value, "acceleration")
        return value or "none"

    def json_schema(self) -> JsonSchema:
        return {"anyOf": [{"enum": ["none", "standard"]}, *vector_schema()["anyOf"]]}
