"""Dry friction of joints, as a file describes it; its mechanics are in docs/theory.md 6.1."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, StrictBool, ValidationInfo

from dalembert.errors import ModelError
from dalembert.model.part import Part, reading
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    JsonSchema,
    Scalar,
    ValueField,
    numbers,
    value_text,
)

Coefficient = Annotated[float, Scalar("number", "not negative")]
Circle = Literal["sin", "tan"]


class Guide(ValueField):
    """Lengths of the guide behind and ahead of j's point, `[l1, l2]`."""

    def read(self, value: object, info: ValidationInfo) -> tuple[float, float]:
        lengths = numbers(value, "length", reading(info))
        if (
            len(lengths) != 2 or not sum(lengths) > 0
        ):  # one is negative where the guide is on one side of the point
            raise ModelError(
                "a guide is two lengths, behind and ahead of the point", "write guide: [0.02, 0.03]"
            )
        return lengths[0], lengths[1]

    def write(self, value: tuple[float, float]) -> object:
        return [value_text(length, "length") for length in value]

    def json_schema(self) -> JsonSchema:
        return {"type": "array", "items": NUMBER_OR_TEXT, "minItems": 2, "maxItems": 2}


class FrictionDefaults(Part):
    """The top-level `friction`: defaults of the joints' `friction`, and whether it is on.

    >>> FrictionDefaults(coefficient=0.1).circle
    'sin'
    """

    coefficient: Coefficient | None = Field(None, description="coefficient of friction, a plain number")
    static: Coefficient | None = Field(None, description="coefficient at rest; default that of motion")
    circle: Circle = Field("sin", description="radius of the friction circle: R sin(phi), or mu R with tan")
    enabled: StrictBool = Field(True, description="false: all friction is left out")


class FrictionPart(Part):
    """Common keys of dry friction in every kind of joint: its coefficients."""

    coefficient: Coefficient | None = Field(
        None, description="coefficient of friction; default the top level's"
    )
    static: Coefficient | None = Field(
        None,
        description="coefficient at rest; default the joint's coefficient, then the top level's static",
    )


class PinFriction(FrictionPart):
    """Friction of a pin of a radius: a couple of the friction circle.

    >>> PinFriction(coefficient=0.1, radius="10 mm").radius
    0.01
    """

    radius: Annotated[float, Scalar("length", "not negative")] = Field(
        description="radius of the pin, a length"
    )
    circle: Circle | None = Field(None, description="R sin(phi), or mu R with tan; default the top level's")


class GuideFriction(FrictionPart):
    """Friction along a slide; without `guide` the normal force bears on one face.

    >>> GuideFriction(coefficient=0.1, half_height="20 mm").half_height
    0.02
    """

    guide: Annotated[tuple[float, float], Guide()] | None = Field(
        None, description="how far the guide reaches behind and ahead of j's point, two lengths"
    )
    half_height: Annotated[float, Scalar("length", "not negative")] | None = Field(
        None, description="of the guide, from its middle to a face, a length"
    )
    force: Annotated[float, Scalar("force", "not negative")] | None = Field(
        None, description="friction against the slide whatever the load, beside mu N; a force"
    )


class SlotFriction(FrictionPart):
    """Friction of a pin in a slot: along the slide, and with a radius also the pin's couple.

    >>> SlotFriction(coefficient=0.1).coefficient
    0.1
    """

    radius: Annotated[float, Scalar("length", "not negative")] | None = Field(
        None, description="radius of the pin in the slot, a length"
    )
    circle: Circle | None = Field(None, description="R sin(phi), or mu R with tan; default the top level's")


class RollingFriction(FrictionPart):
    """Friction of a wheel on its track: it rolls while the force along it is at most `static` times the normal force;
    where it slides, `coefficient` times the normal force acts against the slip."""


class GearFriction(FrictionPart):
    """Friction of teeth: a couple on each wheel against their relative turn, mu |F_n| times the arm.

    Teeth slide at the rate of the wheels' relative turn times the distance of their contact from the pitch point; the
    friction force changes its sense at the pitch point, so that what is left over a mesh is this couple. Without
    `arm`, the mean distance on the path of contact of standard full-depth teeth (needs `teeth` and `module`).

    >>> GearFriction(coefficient=0.05).coefficient
    0.05
    """

    arm: Annotated[float, Scalar("length", "positive")] | None = Field(
        None, description="mean distance of the teeth's contact from the pitch point, a length"
    )


class SpaceFriction(FrictionPart):
    """Friction of a joint in space: a journal, a guide, a ball or a thread.

    Without `guide` the bearing couple of a journal or guide is not counted; with it two ends bear.
    """

    radius: Annotated[float, Scalar("length", "positive")] | None = Field(
        None, description="of the journal, of the ball, or the mean one of the thread; a length"
    )
    circle: Circle | None = Field(None, description="R sin(phi), or mu R with tan; default the top level's")
    guide: Annotated[tuple[float, float], Guide()] | None = Field(
        None,
        description="how far the bearing reaches behind and ahead of j's point along the axis, two lengths",
    )
    thrust_radius: Annotated[float, Scalar("length", "positive")] | None = Field(
        None,
        description="of a revolute: mean radius of the collar that carries the axial force; default none",
    )
    thread_angle: Annotated[float, Scalar("angle", "not negative")] | None = Field(
        None, description="of a screw: half the angle of the thread's profile; default 0, a square thread"
    )


class MeshEfficiency(Scalar):
    """A number above 0, up to 1."""

    def __init__(self) -> None:
        super().__init__("number", "positive")

    def read(self, value: object, info: ValidationInfo) -> float:
        number = super().read(value, info)
        if number > 1:
            raise ModelError(f"an efficiency of {number:g} is above 1", "write a number above 0, up to 1")
        return number


Friction = PinFriction | GuideFriction | SlotFriction | GearFriction | SpaceFriction
