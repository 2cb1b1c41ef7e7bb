"""The plane of a mechanism turns about a line in it, as governors and centrifugal clutches do: the key `turning`."""

from __future__ import annotations

import math
from typing import Annotated, Literal

from pydantic import Field, ValidationInfo

from dalembert.errors import ModelError
from dalembert.model.part import Part, reading
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    Components,
    JsonSchema,
    Scalar,
    ValueField,
    Vector,
    value_text,
)
from dalembert.wording import quote_value

UNKNOWN: Literal["unknown"] = "unknown"
LINES = {"x": 0.0, "y": math.pi / 2}
"""Axes by name, and their directions."""


class AxisLine(ValueField):
    """`x`, `y`, or the direction of a line, an angle."""

    def read(self, value: object, info: ValidationInfo) -> float:
        if isinstance(value, str) and value.isalpha() and value not in LINES:
            what = f"{quote_value(value)} is not the axis of a plane that turns about a line in it"
            raise ModelError(what, "write x, y, or an angle from x such as '60 deg'")
        named = LINES.get(value) if isinstance(value, str) else None
        return reading(info).quantity(value, "angle") if named is None else named

    def write(self, value: float) -> object:
        names = {direction: name for name, direction in LINES.items()}
        return names.get(value) or value_text(value, "angle")

    def json_schema(self) -> JsonSchema:
        return NUMBER_OR_TEXT | {"description": "x, y, or a direction"}


class TurningSpeed(ValueField):
    """A speed, or `unknown`."""

    def read(self, value: object, info: ValidationInfo) -> float | str:
        return UNKNOWN if value == UNKNOWN else reading(info).quantity(value, "angular_speed")

    def write(self, value: float | str) -> object:
        return value if isinstance(value, str) else value_text(value, "angular_speed")


class TurningPlane(Part):
    """The plane turns about a line in it: the links feel centrifugal forces.

    With an unknown speed the effort of one drive is given, 0 for a free sleeve, and the speed is what balances it.

    >>> TurningPlane(axis="y", speed="180 rpm").axis == math.pi / 2
    True
    """

    axis: Annotated[float, AxisLine()] = Field(
        LINES["y"], description="direction of the axis: x, y (default) or an angle"
    )
    at: Annotated[Vector, Components("length")] = Field(
        (0.0, 0.0), description="a point of the axis in ground axes, lengths; default the origin"
    )
    speed: Annotated[float | Literal["unknown"], TurningSpeed()] = Field(
        description="angular speed, such as 180 rpm, or unknown: solved from a given effort"
    )
    acceleration: Annotated[float, Scalar("angular_acceleration")] = Field(
        0.0, description="angular acceleration: it loads the shaft alone; default 0"
    )
