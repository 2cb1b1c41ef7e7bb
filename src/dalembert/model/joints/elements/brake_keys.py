"""Values of the keys of brakes and clutches: ends of a band, blocks, radii, what presses, heat."""

from __future__ import annotations

import math
import re
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import Field, ValidationInfo, model_validator

from dalembert.arrays import Numeric
from dalembert.errors import ModelError
from dalembert.model.part import Part, reading
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    JsonSchema,
    Scalar,
    ValueField,
    at_item,
    check_sign,
    list_schema,
    name,
    numbers,
    value_text,
)
from dalembert.wording import quote_value

Length = Annotated[float, Scalar("length", "positive")]
UNKNOWN: Literal["unknown"] = "unknown"


class BandEnds(ValueField):
    """Two points of links, `[ground.L, lever.B]`."""

    def read(self, value: object, info: ValidationInfo) -> tuple[str, str]:
        if isinstance(value, str) or not isinstance(value, (list, tuple)) or len(value) != 2:
            raise ModelError(f"expected two points, not {quote_value(value)}", "write [ground.L, lever.B]")
        first, second = (at_item(k, _point, item) for k, item in enumerate(value))
        return first, second

    def write(self, value: tuple[str, str]) -> object:
        return list(value)

    def json_schema(self) -> JsonSchema:
        return list_schema({"type": "string"}, 2, 2)


def _point(value: object) -> str:
    parts = str(value).split(".")
    if not isinstance(value, str) or len(parts) != 2:
        raise ModelError(f"{quote_value(value)} is not a point of a link", "write link.point, as lever.B")
    return ".".join(name(part) for part in parts)


class Radii(ValueField):
    """Inner and outer radius of a face."""

    def read(self, value: object, info: ValidationInfo) -> tuple[float, float]:
        pair = numbers(value, "length", reading(info))
        if len(pair) != 2:
            raise ModelError(f"a list of {len(pair)} is given; two radii are needed", "write [inner, outer]")
        for number in pair:
            check_sign(number, number, "not negative")
        return pair[0], pair[1]

    def write(self, value: tuple[float, float]) -> object:
        return [value_text(number, "length") for number in value]

    def json_schema(self) -> JsonSchema:
        return list_schema(NUMBER_OR_TEXT, 2, 2)


class ClampForce(ValueField):
    """A force, or `unknown`."""

    def read(self, value: object, info: ValidationInfo) -> float | Literal["unknown"]:
        if value == UNKNOWN:
            return UNKNOWN
        return check_sign(reading(info).quantity(value, "force"), value, "not negative")

    def write(self, value: Any) -> object:
        return value if value == UNKNOWN else value_text(value, "force")


class Capacity(ValueField):
    """A specific heat capacity, `460 J/(kg*K)`; a bare number is in this unit."""

    def read(self, value: object, info: ValidationInfo) -> float:
        if isinstance(value, str):
            match = re.fullmatch(
                r"\s*([\d.eE+-]+)\s*(k?)J\s*/\s*(?:\(\s*kg\s*\*\s*K\s*\)|kg\s*/\s*K)\s*", value
            )
            if match is None:
                raise ModelError(
                    f"{quote_value(value)} is not a specific heat capacity", "write 460 J/(kg*K)"
                )
            value = float(match[1]) * (1000 if match[2] else 1)
        return check_sign(reading(info).quantity(value, "number"), value, "positive")

    def write(self, value: float) -> object:
        return f"{value!r} J/(kg*K)"


class Heat(Part):
    """Mass that a stop warms."""

    mass: Annotated[float, Scalar("mass", "positive")] = Field(description="that takes up the heat, a mass")
    capacity: Annotated[float, Capacity()] = Field(description="heat a mass and kelvin, J/(kg*K)")

    @property
    def per_kelvin(self) -> float:
        """Heat a kelvin, J/K."""
        return self.mass * self.capacity


class Blocks(Part):
    """Blocks on a band."""

    count: Annotated[float, Scalar("number", "positive", "blocks")] = Field(description="number of blocks")
    angle: Annotated[float, Scalar("angle", "positive")] = Field(description="of a block at the drum's axis")


class Clamp(Part):
    """A cylinder or a spring that presses faces together."""

    bore: Length | None = Field(None, description="of a cylinder, a length")
    pressure: Annotated[float, Scalar("pressure", "not negative")] | None = Field(
        None, description="of its oil; left out where the force is unknown"
    )
    stiffness: Annotated[float, Scalar("stiffness", "positive")] | None = Field(
        None, description="of a spring"
    )
    compression: Annotated[float, Scalar("length", "not negative")] | None = Field(
        None, description="of the spring"
    )

    @property
    def area(self) -> Numeric:
        """Area of the bore, m2."""
        return math.pi * (self.bore or math.nan) ** 2 / 4

    @property
    def force(self) -> Numeric:
        """Force, N."""
        if self.stiffness is not None and self.compression is not None:
            return self.stiffness * self.compression
        return math.nan if self.pressure is None else self.pressure * self.area

    @model_validator(mode="after")
    def _one_kind(self) -> Self:
        spring = self.stiffness is not None
        half = spring != (self.compression is not None)
        if half or spring == (self.bore is not None):
            remedy = "write cylinder: {bore: 40 mm, pressure: 20 bar} or spring: {stiffness:, compression:}"
            raise ModelError("what presses is not clear", remedy)
        return self


class Button(Part):
    """A round pad: its radius and the distance of its centre from the axis."""

    radius: Length = Field(description="of the pad, a length")
    at: Length = Field(description="distance of its centre from the axis, a length")

    @property
    def friction_radius(self) -> float:
        """pi R^2 over the integral of dA/radius, for a pressure as 1/radius, m."""
        return math.pi * self.radius**2 / self._inverse

    def area(self, law: str) -> float:
        """Force over greatest pressure, m2; the greatest is at the inner edge."""
        return (self.at - self.radius) * self._inverse if law == "wear" else math.pi * self.radius**2

    @property
    def _inverse(self) -> float:
        """Integral of dA/radius over the pad: 2 r asin(...) across, by Gauss and Chebyshev."""
        k = np.arange(1, 401)
        x = np.cos(k * np.pi / 401)
        weight = np.pi / 401 * np.sin(k * np.pi / 401) ** 2
        r = self.at + self.radius * x
        half = np.arccos(np.clip((r * r + self.at**2 - self.radius**2) / (2 * r * self.at), -1, 1))
        return float((weight * 2 * half / np.sqrt(1 - x * x)).sum() * self.radius)

    @model_validator(mode="after")
    def _beside_axis(self) -> Self:
        if self.radius >= self.at:
            raise ModelError("the pad reaches over the axis", "make at larger than its radius", ("at",))
        return self
