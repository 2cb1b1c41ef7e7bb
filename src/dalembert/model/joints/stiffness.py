"""Stiffness of joints, which settles reactions that equilibrium leaves open."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, ValidationInfo

from dalembert.errors import ModelError
from dalembert.model.part import Part, reading
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    JsonSchema,
    ValueField,
    at_item,
    check_sign,
    numbers,
    value_text,
)

AXES = ", or [x, y, z] in the joint's axes (for a joint with two turns, the axes of its link i)"


class Stiffnesses(ValueField):
    """One number; in space also one for each of the joint's axes x, y, z."""

    def __init__(self, kind: str) -> None:
        self.kind = kind

    def read(self, value: object, info: ValidationInfo) -> float | tuple[float, ...]:
        rules = reading(info)
        if not isinstance(value, (list, tuple)):
            return check_sign(rules.quantity(value, self.kind), value, "positive")
        if rules.dimension == 2 or len(value) != 3:
            what = f"a list of {len(value)} is not a stiffness"
            raise ModelError(what, "write one number" + ("" if rules.dimension == 2 else AXES))
        components = numbers(value, self.kind, rules)
        return tuple(at_item(k, check_sign, x, value[k], "positive") for k, x in enumerate(components))

    def write(self, value: float | tuple[float, ...]) -> object:
        if isinstance(value, tuple):
            return [value_text(x, self.kind) for x in value]
        return value_text(value, self.kind)

    def json_schema(self) -> JsonSchema:
        return {
            "anyOf": [
                NUMBER_OR_TEXT,
                {"type": "array", "items": NUMBER_OR_TEXT, "minItems": 3, "maxItems": 3},
            ]
        }


class Stiffness(Part):
    """Stiffness of a joint; a direction without a value is rigid.

    >>> Stiffness(force="20 kN/mm").force
    20000000.0
    """

    force: Annotated[float | tuple[float, ...], Stiffnesses("stiffness")] | None = Field(
        None,
        description="force per length; in space also [x, y, z] along the joint's axes, "
        "for a joint with two turns along those of its link i",
    )
    moment: Annotated[float | tuple[float, ...], Stiffnesses("torsion_stiffness")] | None = Field(
        None, description="moment per angle; in space also [x, y, z] about the joint's axes"
    )
