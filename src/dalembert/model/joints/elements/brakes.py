"""Brakes and clutches: a band or a shoe on a drum, faces pressed together; mechanics: docs/theory.md 6.4."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Literal, Self

import numpy as np
from pydantic import Field, StrictBool, model_validator

from dalembert.arrays import Numeric
from dalembert.errors import ModelError
from dalembert.model.joints.contact_keys import PUSHES, ContactMode
from dalembert.model.joints.elements.brake_keys import (
    BandEnds,
    Blocks,
    Heat,
)
from dalembert.model.joints.friction_keys import FrictionPart
from dalembert.model.joints.joint_part import JointPart, Path
from dalembert.model.quantities.values import Name, Scalar

Length = Annotated[float, Scalar("length", "positive")]
Angle = Annotated[float, Scalar("angle")]
FRICTION = "dry friction of the lining: coefficient, static"
HEAT = "for the rise of temperature in a stop: {mass: 60 kg, capacity: 460 J/(kg*K)}; all heat stays in it"
Side = Literal["left", "right"]


class BrakePart(JointPart):
    """Common keys of brakes and clutches."""

    BRAKES: ClassVar = True
    friction: FrictionPart | None = Field(None, description=FRICTION)
    heat: Heat | None = Field(None, description=HEAT)


class OnDrum(BrakePart):
    """Common to a band and a shoe: j is pressed on the drum i, about i's point, and lifts off where it had to pull."""

    radius: Length = Field(description="of the drum, a length")
    width: Length | None = Field(None, description="of the lining along the axis, a length: for its pressure")

    @property
    def reach(self) -> float:
        """Radius within which it lies, m."""
        return self.radius

    @property
    def lining_area(self) -> float:
        """Area of the lining, m2; 0 where its size is not known."""
        return 0.0

    @property
    def contact(self) -> ContactMode:
        """A lining presses and a band pulls; never the reverse."""
        return PUSHES


class Shoe(OnDrum):
    """A lining of link j on the drum i: at one point of j, or along an arc.

    Without angles it touches at j's point, which is at the drum's radius. With `from` and `to`, counted at the drum's
    axis from the direction of j's point, it is long: rigid and pinned at it, with p = p_m sin(th)/sin(th_a)
    (`pressure: pinned`), or pivoted so that p = p_m cos of the angle from its middle (`cosine`).

    >>> shoe = Shoe(links=("drum", "lever"), at=("O", "Q"), radius=0.15, width=0.03, internal=True, to="126 deg")
    >>> [round(float(x), 4) for x in (*shoe.load_direction(1.0), shoe.friction_arm)]
    [-0.2377, -0.9713, 0.173]
    >>> round(shoe.lining_area / (math.radians(126) * 0.15 * 0.03), 12)
    1.0
    """

    type: Literal["shoe"] = "shoe"
    begin: Angle = Field(
        0.0, alias="from", description="where a long lining begins, an angle from j's point; default 0"
    )
    end: Angle | None = Field(
        None, alias="to", description="where it ends, an angle; left out, it touches at j's point"
    )
    internal: StrictBool = Field(False, description="true: it is inside the drum and pressed outwards")
    pressure: Literal["pinned", "cosine"] = Field(
        "pinned", description="of a long lining: pinned (default), or cosine where its pivot lets it settle"
    )
    side: Side | None = Field(
        None,
        description="side of the line from the drum's axis to j's point on which the lining lies; default that of j's "
        "other points",
    )

    @property
    def lining_area(self) -> float:
        """Area of the lining, m2; 0 where its size is not known."""
        return float(2 * self.half * self.radius * (self.width or 0.0))

    @property
    def half(self) -> Numeric:
        """Half the angle of the lining."""
        return 0.0 if self.end is None else (self.end - self.begin) / 2

    @property
    def middle(self) -> Numeric:
        """Angle of its middle from j's point."""
        return 0.0 if self.end is None else (self.begin + self.end) / 2

    @property
    def parts(self) -> tuple[Numeric, Numeric]:
        """Integrals of p/p_m or sin(th) times cos and sin of the angle from j's point: A, B of a pinned lining."""
        if self.end is None:
            return 1.0, 0.0
        if self.pressure == "cosine":
            size = self.half + np.sin(2 * self.half) / 2
            return size * np.cos(self.middle), size * np.sin(self.middle)
        a, b = self.begin, self.end
        across = (b - a) / 2 - (np.sin(2 * b) - np.sin(2 * a)) / 4
        return (np.sin(b) ** 2 - np.sin(a) ** 2) / 2, across

    @property
    def rim(self) -> Numeric:
        """Integral of p/p_m or sin(th) over the angle."""
        if self.end is None:
            return 1.0
        return 2 * np.sin(self.half) if self.pressure == "cosine" else np.cos(self.begin) - np.cos(self.end)

    def load_direction(self, side: float) -> tuple[Numeric, Numeric]:
        """Unit vector of the normal force on j, along and across the direction of j's point; side 1 of a lining on its
        left, -1 on its right."""
        along, across = self.parts
        size = (-1.0 if self.internal else 1.0) / np.sqrt(along * along + across * across)
        return along * size, side * across * size

    @property
    def friction_arm(self) -> Numeric:
        """Torque of friction over its resultant, m: the resultant acts so far from the axis."""
        along, across = self.parts
        return self.radius * self.rim / np.sqrt(along * along + across * across)

    @property
    def peak(self) -> float:
        """sin(th_a) of a pinned lining, at the place of the greatest pressure; else 1."""
        if self.end is None or self.pressure == "cosine":
            return 1.0
        return 1.0 if self.begin <= math.pi / 2 <= self.end else max(math.sin(self.begin), math.sin(self.end))

    @property
    def area(self) -> float:
        """Normal force over greatest pressure, m2; NaN at a point or without a width."""
        if self.end is None or self.width is None:
            return math.nan
        return self.width * self.radius * float(np.hypot(*self.parts)) / self.peak

    @model_validator(mode="before")
    @classmethod
    def _by_field(cls, keys: Any) -> Any:
        """A copy with other numbers has the names of the fields."""
        if not isinstance(keys, Mapping):
            return keys
        return {{"begin": "from", "end": "to"}.get(key, key): value for key, value in keys.items()}

    @model_validator(mode="after")
    def _an_arc(self) -> Self:
        if self.end is None:
            if self.begin:
                raise ModelError("a lining has from without to", "give both angles", ("from",))
            return self
        if not self.end > self.begin:
            raise ModelError(
                "the lining ends where it begins, or before", "make to larger than from", ("to",)
            )
        if self.end - self.begin > 2 * math.pi:
            raise ModelError("the lining is longer than the drum's circumference", "make to smaller", ("to",))
        if self.pressure == "pinned" and not (self.begin >= 0 and self.end <= math.pi):
            raise ModelError(
                "a pinned lining presses from 0 to 180 deg of its pin only",
                "give from and to in between, counted to the side on which the lining lies, or pressure: cosine",
                ("from" if self.begin < 0 else "to",),
            )
        if self.pressure == "cosine" and self.half > math.pi / 2:
            raise ModelError("a cosine of pressure ends 90 deg from its middle", "make to smaller", ("to",))
        return self


class Band(OnDrum):
    """A band around the drum i, with its two ends on the lever j and the ground.

    It runs clockwise round the drum from its first end to its last. The strands pull along the tangents of the drum;
    with `wrap`, the angle on the drum, or `blocks`, they pull across the line of the two ends, as books take it.

    >>> Band(links=("drum", "lever"), around="O", radius=0.2, ends=("ground.L", "lever.B"), wrap="270 deg").wound
    4.71238898038469
    """

    type: Literal["band"] = "band"
    around: Name = Field(description="the drum's point on its axis")
    ends: Annotated[tuple[str, str], BandEnds()] = Field(
        description="of the band, [ground.L, lever.B]: it runs clockwise round the drum from the first to the last"
    )
    wrap: Annotated[float, Scalar("angle", "positive")] | None = Field(
        None, description="angle on the drum; default that of the tangents from its ends"
    )
    groove: Annotated[float, Scalar("angle", "positive")] | None = Field(
        None, description="full angle of a V groove: it counts as mu / sin(groove/2); default a flat drum"
    )
    blocks: Blocks | None = Field(None, description="{count: 14, angle: 15 deg}: blocks on the band")

    def places(self, joint: str) -> Iterator[tuple[str, str, Path, Path]]:
        """The drum's axis and its two ends."""
        yield from (place for place in super().places(joint) if f"{place[0]}.{place[1]}" not in self.ends)
        for k, end in enumerate(self.ends):
            link, point = end.split(".")
            yield link, point, ("ends", k), ("ends", k)

    @property
    def lining_area(self) -> float:
        """Area of the lining, m2; 0 where its size is not known."""
        return (self.wound or 0.0) * self.radius * (self.width or 0.0)

    @property
    def wound(self) -> float | None:
        """The given angle on the drum: `wrap`, or that of its blocks; None where the tangents give it."""
        return self.blocks.count * self.blocks.angle if self.blocks else self.wrap

    def point_names(self, joint: str) -> tuple[str, str]:
        """The drum's axis, and the first end on j."""
        own = [end.split(".")[1] for end in self.ends if end.split(".")[0] == self.links[1]]
        return self.around, own[0] if own else joint

    @model_validator(mode="after")
    def _held(self) -> Self:
        links = [end.split(".")[0] for end in self.ends]
        if self.at is not None:
            raise ModelError("a band has no `at`", "write around: O and ends: [ground.L, lever.B]", ("at",))
        if self.links[1] not in links:
            what = f"no end of the band is on {self.links[1]}"
            raise ModelError(what, f"write ends: [ground.L, {self.links[1]}.B]", ("ends",))
        for link in links:
            if link not in ("ground", self.links[1]):
                what = f"an end of the band is on {link}"
                raise ModelError(what, f"put it on ground or on {self.links[1]}", ("ends",))
        if self.blocks and self.wrap is not None:
            raise ModelError("wrap is given beside blocks", "leave it out: the blocks have it", ("wrap",))
        return self
