"""Loads: forces, couples, springs and dampers, some of them unknown (docs/theory.md 4)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, ValidationInfo, field_validator, model_validator

from dalembert.arrays import Numeric
from dalembert.errors import ModelError
from dalembert.model.joints.turn_loads import TorsionDamper, TorsionSpring
from dalembert.model.part import LoadPart, ReadingRules, reading
from dalembert.model.quantities.expression_trees import Functions
from dalembert.model.quantities.figures import unit_vector
from dalembert.model.quantities.spans import ForceLaw, ForceLawValue, TwoEnds, one_force, refuse_both
from dalembert.model.quantities.values import (
    Components,
    JsonSchema,
    Name,
    Scalar,
    ValueField,
    Vector,
    at_item,
    check_vector,
    direction_vector,
    name,
    polar,
    value_text,
    vector,
    vector_schema,
    vector_text,
)
from dalembert.model.quantities.varying import Varying, value_at, varying, varying_schema, varying_tree
from dalembert.model.quantities.vectors import unit

UNKNOWN: Literal["unknown"] = "unknown"


class ForceValue(ValueField):
    """A vector whose components may change, a scalar along `direction`, or unknown."""

    kind, form, least = "force", "[x, y] or polar text r @ angle", 2

    def read(self, value: object, info: ValidationInfo) -> Varying | tuple[Varying, ...] | Literal["unknown"]:
        rules = reading(info)
        if value == UNKNOWN:
            return UNKNOWN
        if isinstance(value, (list, tuple)):
            items = check_vector(value, ReadingRules(dimension=3) if self.least == 3 else rules, self.form)
            return tuple(at_item(i, varying, item, self.kind, rules) for i, item in enumerate(items))
        return varying(value, self.kind, rules)

    def write(self, value: Any) -> object:
        if value == UNKNOWN:
            return value
        if isinstance(value, tuple):
            return [varying_tree(item, self.kind) for item in value]
        return varying_tree(value, self.kind)

    def json_schema(self) -> JsonSchema:
        one = varying_schema()
        many = {"type": "array", "items": one, "minItems": self.least, "maxItems": 3}
        return {"anyOf": [*one["anyOf"], many] if self.least == 3 else [many, *one["anyOf"]]}


class CoupleValue(ForceValue):
    """A couple that may change, or unknown; in space a vector."""

    kind, form, least = "moment", "[x, y, z]", 3


class Direction(ValueField):
    """An angle; in space a vector."""

    def read(self, value: object, info: ValidationInfo) -> float | Vector:
        if isinstance(value, (list, tuple)):
            return direction_vector(vector(value, "number", ReadingRules(dimension=3)))
        return Scalar("angle").read(value, info)

    def write(self, value: float | Vector) -> object:
        return list(value) if isinstance(value, tuple) else value_text(value, "angle")

    def json_schema(self) -> JsonSchema:
        components = {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3}
        return {"anyOf": [Scalar("angle").json_schema(), components]}


class LoadPoint(ValueField):
    """A point of the link by name, or a vector in link axes."""

    def read(self, value: object, info: ValidationInfo) -> str | Vector:
        if isinstance(value, (list, tuple)) or (isinstance(value, str) and "@" in value):
            return vector(value, "length", reading(info))
        return name(value)

    def write(self, value: str | Vector) -> object:
        return value if isinstance(value, str) else vector_text(value, "length")

    def json_schema(self) -> JsonSchema:
        return {"anyOf": [{"type": ["string", "integer"]}, vector_schema()]}


class Directed(LoadPart):
    """A load along a direction, or a vector, which needs none."""

    by: Name | None = Field(
        None,
        description="ground: the ground carries the opposite force, as a cylinder's head does "
        "of the gas force, so it is not part of the shaking force; default: exerted from outside",
    )
    if TYPE_CHECKING:
        value: Varying | tuple[Varying, ...] | Literal["unknown"]

    @field_validator("by")
    @classmethod
    def _by_the_ground(cls, by: str | None) -> str | None:
        if by not in (None, "ground"):
            remedy = "write by: ground, or leave it out; between two links, write a second load on the other"
            raise ModelError(f"a load is exerted by the ground or from outside, not by {by!r}", remedy)
        return by

    @property
    def unknown(self) -> bool:
        """True if it is unknown."""
        return isinstance(self.value, str)

    @property
    def components(self) -> tuple[Varying, ...] | None:
        """Its components in `axes`, if it is given as a vector."""
        return self.value if isinstance(self.value, tuple) else None

    @property
    def varying(self) -> tuple[Varying, ...]:
        """Its values that may change."""
        if isinstance(self.value, str):
            return ()
        return self.value if isinstance(self.value, tuple) else (self.value,)

    def at_drives(self, drives: Mapping[str, Numeric], functions: Functions | None) -> Numeric:
        """Its components, or its single value, at the drives' positions; 1 for an unknown."""
        if isinstance(self.value, tuple):
            return tuple(value_at(value, drives, functions) for value in self.value)
        return value_at(1.0 if isinstance(self.value, str) else self.value, drives, functions)

    def replaced_by(self, name: str, value: object) -> tuple[str, ...]:
        """A vector later takes the place of a single value and its direction."""
        vector = isinstance(value, (list, tuple)) or (isinstance(value, str) and "@" in value)
        return ("direction",) if name == "value" and vector else ()


class ForceLoad(Directed):
    """A force on a link: a vector, or a value along a direction; or unknown along a direction.

    >>> ForceLoad(on="rod", at="P", value="100 N @ 90 deg").force({})
    (np.float64(0.0), np.float64(100.0))
    """

    ON: ClassVar = "point"
    type: Literal["force"] = "force"
    on: Name = Field(description="the link it acts on")
    at: Annotated[str | Vector, LoadPoint()] = Field(
        description="the point it acts at: a name, center, or a vector in link axes"
    )
    value: Annotated[Varying | tuple[Varying, ...] | Literal["unknown"], ForceValue()] = Field(
        description="[x, y], polar text r @ angle, a value along `direction`, or unknown; forces"
    )
    direction: Annotated[float | Vector, Direction()] | None = Field(
        None, description="of a single value or an unknown force: an angle in `axes`; in space a vector"
    )
    axes: Literal["ground", "link"] = Field("ground", description="the axes of value and direction")

    @model_validator(mode="before")
    @classmethod
    def _polar(cls, keys: Any, info: ValidationInfo) -> Any:
        if (
            not isinstance(keys, Mapping)
            or not isinstance(keys.get("value"), str)
            or "@" not in keys["value"]
        ):
            return keys
        if keys.get("direction") is not None:
            raise ModelError(
                "both a polar value and a direction are given", "leave one of them out", ("direction",)
            )
        rules = reading(info)
        size, angle = at_item("value", polar, keys["value"], "force", rules)
        value = at_item("value", varying, size, "force", rules)
        return {**keys, "value": varying_tree(value, "force"), "direction": value_text(angle, "angle")}

    @model_validator(mode="after")
    def _one_meaning(self, info: ValidationInfo) -> Self:
        vectorial = isinstance(self.value, tuple)
        if vectorial and self.direction is not None:
            raise ModelError("a vector needs no direction", "leave the direction out", ("direction",))
        if not vectorial and self.direction is None:
            raise ModelError(
                f"{'an unknown force' if self.unknown else 'a single value'} needs a direction",
                "write direction: [0, 0, 1], or value: [x, y, z]"
                if reading(info).dimension == 3
                else "write direction: 30 deg, or value: [x, y]",
            )
        return self

    def force(self, drives: Mapping[str, Numeric], functions: Functions | None = None) -> tuple[Numeric, ...]:
        """The components (fx, fy) in `axes`, N, at the drives' positions; of an unknown force, per unit of it."""
        size = self.at_drives(drives, functions)
        if isinstance(size, tuple):
            return size
        if isinstance(self.direction, tuple):
            return tuple(size * x for x in unit(self.direction))
        assert self.direction is not None
        return tuple(size * x for x in unit_vector(self.direction))


class Couple(Directed):
    """A couple on a link, counter-clockwise positive.

    >>> Couple(on="rocker", value="120 N*m").value
    120.0
    """

    ON: ClassVar = "link"
    type: Literal["couple"] = "couple"
    on: Name = Field(description="the link it acts on")
    at: Annotated[str | Vector, LoadPoint()] | None = Field(
        None,
        description="where inside the link, for its inner forces: as of a force; left out: the mass centre",
    )
    value: Annotated[Varying | tuple[Varying, ...] | Literal["unknown"], CoupleValue()] = Field(
        description="a moment, or unknown; in space a vector"
    )
    direction: Annotated[Vector, Components("number")] | None = Field(
        None, description="in space: the axis of a single value or of an unknown couple, a vector in `axes`"
    )
    axes: Literal["ground", "link"] = Field("ground", description="in space: the axes of value and direction")

    @model_validator(mode="after")
    def _one_meaning(self) -> Self:
        if self.direction is not None and isinstance(self.value, tuple):
            raise ModelError("a vector needs no direction", "leave the direction out", ("direction",))
        if self.direction is not None:
            at_item("direction", direction_vector, self.direction)
        return self

    @property
    def axis(self) -> Vector:
        """Unit vector of a single value in space; 1 in the plane."""
        return (1.0,) if self.direction is None else unit(self.direction)

    def moment(self, drives: Mapping[str, Numeric], functions: Functions | None = None) -> Numeric:
        """The moment, N m, at the drives' positions; of an unknown couple, per unit of it."""
        return self.at_drives(drives, functions)


class SpanLoad(LoadPart):
    """A load along the line between points of two links; its numbers have the names of ``core.forcing.Springs``."""

    ON: ClassVar = "span"
    type: str
    between: TwoEnds = Field(description="[link.point, link.point]")


class Spring(SpanLoad):
    """A straight spring between points of two links.

    >>> Spring(between=("ground.A", "rod.B"), stiffness="2 kN/m", free_length="0.1 m").stiffness
    2000.0
    """

    FORCE: ClassVar = "spring"
    type: Literal["spring"] = "spring"
    stiffness: Annotated[float, Scalar("stiffness", "not negative")] = Field(description="force per length")
    free_length: Annotated[float, Scalar("length", "not negative")] = Field(
        0.0, description="its length without force; default 0"
    )
    law: Annotated[ForceLaw, ForceLawValue("length")] | None = Field(
        None, alias="force", description="instead of a stiffness: tension over length less free length"
    )

    @model_validator(mode="before")
    @classmethod
    def _one_force(cls, keys: object) -> object:
        return one_force(keys, "stiffness")

    _law_alone = model_validator(mode="after")(refuse_both)


class ConstantForceSpring(SpanLoad):
    """A strip spring that pulls points of two links together with one force, whatever their distance.

    >>> ConstantForceSpring(between=("ground.A", "rod.B"), force="40 N").force
    40.0
    """

    FORCE: ClassVar = "spring"
    type: Literal["constant_force_spring"] = "constant_force_spring"
    force: Annotated[float, Scalar("force")] = Field(
        description="its tension; negative pushes the points apart, as a gas spring nearly does"
    )


class Damper(SpanLoad):
    """A straight viscous damper between points of two links.

    >>> Damper(between=("ground.A", "rod.B"), damping="40 N*s/m").damping
    40.0
    """

    FORCE: ClassVar = "damper"
    type: Literal["damper"] = "damper"
    damping: Annotated[float, Scalar("damping", "not negative")] = Field(description="force per speed")
    rate_law: Annotated[ForceLaw, ForceLawValue("speed")] | None = Field(
        None, alias="force", description="instead of a damping: tension over the rate of its length"
    )

    @model_validator(mode="before")
    @classmethod
    def _one_force(cls, keys: object) -> object:
        return one_force(keys, "damping")

    _law_alone = model_validator(mode="after")(refuse_both)


class GasSpring(SpanLoad):
    """A gas spring that pushes points apart: F = A (p (V/(V - A x))^n - p_out), x = length - distance.

    >>> GasSpring(between=("ground.A", "lid.B"), rod="20 mm", volume="0.4 l", pressure="20 bar", length=1).exponent
    1.35
    """

    FORCE: ClassVar = "spring"
    type: Literal["gas_spring"] = "gas_spring"
    rod: Annotated[float, Scalar("length", "positive")] = Field(description="diameter of the rod, a length")
    volume: Annotated[float, Scalar("volume", "positive")] = Field(description="of the gas at that length")
    pressure: Annotated[float, Scalar("pressure", "positive")] = Field(description="absolute, at that length")
    length: Annotated[float, Scalar("length", "positive")] = Field(
        description="distance of its points at this force"
    )
    exponent: Annotated[float, Scalar("number", "positive")] = Field(
        1.35,
        description="of the change of state; default 1.35, 1 where it is so slow that its temperature stays",
    )
    outside: Annotated[float, Scalar("pressure", "not negative")] = Field(
        101325.0, description="absolute pressure outside; default 1.01325 bar"
    )

    @property
    def area(self) -> float:
        """Area of the rod, m2."""
        return self.rod * self.rod * (math.pi / 4)


Load = Annotated[
    ForceLoad | Couple | Spring | ConstantForceSpring | GasSpring | Damper | TorsionSpring | TorsionDamper,
    Field(discriminator="type", description="a load"),
]
