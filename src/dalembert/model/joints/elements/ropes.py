"""Ropes through points and round wheels, and the strands and pulleys that they consist of (docs/theory.md 5.7)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, StrictBool, ValidationInfo, model_validator

from dalembert.errors import ModelError
from dalembert.model.joints.friction_keys import FrictionPart
from dalembert.model.joints.joint_part import JointPart, Path
from dalembert.model.part import Part, reading
from dalembert.model.quantities.values import (
    JsonSchema,
    Scalar,
    TwoNames,
    ValueField,
    name,
    value_text,
)
from dalembert.wording import quote_value

EXAMPLE = "through: [load.L, {round: ground.U, radius: 40 mm}, hand.H]"
Efficiency = Annotated[float, Scalar("number", "positive")]


class PlaceOnLink(ValueField):
    """A point of a link, `link.point`."""

    def read(self, value: object, info: ValidationInfo) -> tuple[str, str]:
        if isinstance(value, tuple):
            return value[0], value[1]
        parts = str(value).split(".") if isinstance(value, str) else []
        if len(parts) != 2 or not all(parts):
            raise ModelError(
                f"{quote_value(value)} is not a point of a link", "write link.point, such as ground.U"
            )
        return name(parts[0]), name(parts[1])

    def write(self, value: tuple[str, str]) -> object:
        return ".".join(value)

    def json_schema(self) -> JsonSchema:
        return {"type": "string", "description": "link.point"}


class RopePoint(Part):
    """A point that a rope is fixed to, an eye that it runs through, or a wheel that it goes round."""

    round: Annotated[tuple[str, str], PlaceOnLink()] = Field(
        description="link.point: its centre, or the point itself"
    )
    radius: Annotated[float, Scalar("length", "not negative")] = Field(
        0.0, description="of the wheel to the rope's middle, a length; default 0, a point"
    )
    side: Literal["left", "right"] | None = Field(
        None, description="of the wheel's centre on which the rope passes, along the rope; default left"
    )
    turns: Annotated[float, Scalar("number", "not negative", "whole turns")] = Field(
        0.0, description="whole turns of the rope round it besides what the geometry gives"
    )
    friction: FrictionPart | None = Field(
        None, description="of the rope on it: by it a fixed wheel holds, and a wheel that turns may slip"
    )
    efficiency: Efficiency | None = Field(
        None, description="of the pulley: tension that runs on over tension that runs off; default the rope's"
    )
    pulley: StrictBool | None = Field(
        None, description="true: a pulley without a link; false: the rope holds to the link, or slides on it"
    )

    @model_validator(mode="before")
    @classmethod
    def _coefficient(cls, keys: Any) -> Any:
        if not isinstance(keys, Mapping) or isinstance(keys.get("friction"), Mapping | FrictionPart | None):
            return keys
        return {**keys, "friction": {"coefficient": keys["friction"]}}

    @model_validator(mode="after")
    def _whole(self) -> Self:
        if self.efficiency is not None and self.efficiency > 1:
            raise ModelError("an efficiency is greater than 1", "write 0.95 for 95 %", ("efficiency",))
        if self.friction is not None and self.efficiency is not None:
            what = "a pulley has an efficiency, a fixed wheel friction of the rope; both are given"
            raise ModelError(what, "keep one of them", ("efficiency",))
        return self


class Parallel(ValueField):
    """True, or the angle of the strands."""

    def read(self, value: object, info: ValidationInfo) -> bool | float:
        return value if isinstance(value, bool) else reading(info).quantity(value, "angle")

    def write(self, value: bool | float) -> object:
        return value if isinstance(value, bool) else value_text(value, "angle")

    def json_schema(self) -> JsonSchema:
        return {"type": ["boolean", "number", "string"]}


def _place(point: object) -> tuple[str, ...]:
    """Link and point of a point of a rope as it is given; something else where it is neither."""
    value = point.get("round") if isinstance(point, Mapping) else getattr(point, "round", ())
    return tuple(value.split(".")) if isinstance(value, str) else tuple(value or ())


class Rope(JointPart):
    """A rope, or a cable, of constant length through points and round wheels of any links; it only pulls.

    >>> Rope(through=["load.L", {"round": "ground.U", "radius": "40 mm"}, "hand.H"]).links
    ('load', 'ground')
    """

    RING: ClassVar[bool] = False
    """True if its ends meet on its first wheel."""
    type: Literal["rope"] = "rope"
    links: TwoNames = Field(("", ""), exclude=True, description="the first two links that it touches")
    at: tuple[str, str] | None = Field(None, exclude=True, description="its points on them")
    through: tuple[RopePoint, ...] = Field(description=f"points and wheels: {EXAMPLE}")
    efficiency: Efficiency | None = Field(None, description="of each pulley; default 1")
    parallel: Annotated[bool | float, Parallel()] = Field(
        False, description="true: all strands along the slide of its ends, or an angle; default tangents"
    )

    @model_validator(mode="before")
    @classmethod
    def _ends(cls, keys: Any) -> Any:
        if not isinstance(keys, Mapping) or "through" not in keys:
            return keys
        for key in ("links", "at"):
            if keys.get(key) and not isinstance(keys["through"], tuple):
                what = f"a rope has no {key}: its points say which links it touches"
                raise ModelError(what, f"write {EXAMPLE}", (key,))
        known = keys["through"]
        if not isinstance(known, (list, tuple)) or len(known) < 2:
            raise ModelError("a rope goes through two points at least", f"write {EXAMPLE}", ("through",))
        points = [x if isinstance(x, Mapping | RopePoint) else {"round": x} for x in known]
        places = [p for p in map(_place, points) if len(p) == 2]
        other = next((p for p in places if p[0] != places[0][0]), None)
        if other is None and len(places) == len(points):
            what = f"it touches only link {places[0][0]!r}, which it cannot pull"
            raise ModelError(what, f"write {EXAMPLE}", ("through",))
        (i, u), (j, v) = (places[0], other) if other else (("i", ""), ("j", ""))
        return {**keys, "through": points, "links": (i, j), "at": (u, v)}

    def places(self, joint: str) -> Iterator[tuple[str, str, Path, Path]]:
        """Link and point of each of its points, and the keys that name them."""
        for k, point in enumerate(self.through):
            yield *point.round, ("through", k), ("through", k)

    def frictions(self) -> Iterator[tuple[FrictionPart, Path]]:
        """Friction of each of its wheels that has one, and the keys that it is at."""
        for k, point in enumerate(self.through):
            if point.friction is not None:
                yield point.friction, ("through", k, "friction")

    @model_validator(mode="after")
    def _of_wheels(self) -> Self:
        if self.efficiency is not None and self.efficiency > 1:
            raise ModelError("an efficiency is greater than 1", "write 0.95 for 95 %", ("efficiency",))
        for k, (a, b) in enumerate(zip(self.through, self.through[1:], strict=False)):
            if a.round == b.round:
                what = f"it goes from {'.'.join(a.round)} to the same point"
                raise ModelError(what, "leave one out", ("through", k + 1))
        return self


class ClosedRope(Rope):
    """A belt with idlers as a rope whose ends meet on its first wheel: made from a belt, never written."""

    RING: ClassVar = True
    wedge: float = Field(1.0, exclude=True)
    grip: FrictionPart | None = Field(None, exclude=True)


class StrandJoint(JointPart):
    """A straight strand of a rope between points or wheels of i and j: made from a rope, never written."""

    WRAPPED: ClassVar = True
    type: Literal["strand"] = "strand"
    rope: str = ""
    radii: tuple[float, float] = (0.0, 0.0)
    """Radii of the wheels of i and j, metres, positive where the strand passes on their left."""
    winds: tuple[float, float] = (0.0, 0.0)
    """Length of rope that a radian of i and of j winds: the radii, or any length of a point."""
    direction: float | None = None
    """Fixed direction of the strand, an angle in ground axes; else it is tangent to the wheels."""

    @property
    def wheels(self) -> int:
        """It joins links as a contact of wheels does: without a pin."""
        return 2

    @property
    def internal(self) -> bool:
        """Never one within the other."""
        return False

    @property
    def pitch_radii(self) -> tuple[float, float]:
        """Radii of its wheels, metres."""
        return abs(self.radii[0]), abs(self.radii[1])


class Sheave(JointPart):
    """A pulley of a rope on a link, or a fixed wheel on which the rope slides: made from a rope, never written.

    j is the rope on the wheel: a radian of it is ``lever`` of rope.
    """

    FREEDOMS: ClassVar = ("turn",)
    type: Literal["sheave"] = "sheave"
    rope: str = ""
    radius: float = 0.0
    lever: float = 1.0
    turns: float = 0.0
    side: Literal["left", "right"] = "left"
    strands: tuple[str, str] = ("", "")
    """Names of the strands before and behind it."""
    grip: FrictionPart | None = None
    efficiency: float | None = None

    @property
    def friction(self) -> FrictionPart | None:
        """Its friction: of the rope on it, or that of an efficiency e, by which the tensions differ by
        2 (1 - e)/(1 + e) of their mean."""
        if self.efficiency is None:
            return self.grip
        e = self.efficiency
        return FrictionPart.model_construct(coefficient=2 * (1 - e) / (1 + e), static=None)
