"""Gravity: none, standard, or a vector."""

from __future__ import annotations

import math
from typing import Literal

from pydantic import ValidationInfo

from dalembert.errors import ModelError
from dalembert.model.part import reading
from dalembert.model.quantities.values import (
    JsonSchema,
    ValueField,
    Vector,
    vector,
    vector_schema,
    vector_text,
)
from dalembert.wording import quote_value

STANDARD = 9.80665
"""Standard acceleration of gravity, m/s2."""

LEAST, MOST = 1.0, 30.0
"""m/s2: the Moon's is 1.6, Jupiter's 24.8. What lies outside is likely a number without its unit."""

Gravity = Vector | Literal["standard"] | None


class GravityValue(ValueField):
    """`none`, `standard`, or a vector of accelerations."""

    def read(self, value: object, info: ValidationInfo) -> Gravity:
        if value is None or value == "none":
            return None
        if value == "standard":
            return "standard"
        if isinstance(value, str) and "@" not in value:
            raise ModelError(
                f"{quote_value(value)} is not a vector",
                "write none, standard, or a vector with its unit, gravity: [0, -9.81 m/s^2]",
            )
        return vector(value, "acceleration", reading(info))

    def write(self, value: Gravity) -> object:
        if isinstance(value, tuple):
            return vector_text(value, "acceleration")
        return value or "none"

    def json_schema(self) -> JsonSchema:
        return {"anyOf": [{"enum": ["none", "standard"]}, *vector_schema()["anyOf"]]}


def gravity_doubt(vector: Vector) -> str:
    """Why the acceleration of gravity (m/s2) is likely in another unit; empty where it is not.

    >>> gravity_doubt((0.0, -9.80665)), gravity_doubt((0.0, 0.0))
    ('', '')
    >>> gravity_doubt((0.0, -0.00981))
    '0.00981 m/s2 is not between 1 and 30 m/s2: write gravity: standard, or [0, -9.81 m/s^2]'
    """
    size = math.hypot(*vector)
    if not size or LEAST < size < MOST:
        return ""
    example = "[" + "0, " * (len(vector) - 1) + "-9.81 m/s^2]"
    return (
        f"{size:.3g} m/s2 is not between {LEAST:g} and {MOST:g} m/s2: write gravity: standard, or {example}"
    )
