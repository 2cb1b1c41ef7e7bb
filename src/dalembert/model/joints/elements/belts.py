"""Belts and chains between two wheels: their keys (docs/theory.md 5.7)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Literal, Self

import numpy as np
from pydantic import Field, StrictBool, model_validator

from dalembert.errors import ModelError
from dalembert.model.joints.elements.ropes import ClosedRope, Efficiency, PlaceOnLink, RopePoint
from dalembert.model.joints.friction_keys import FrictionPart
from dalembert.model.joints.joint_part import JointPart, Path, TwoNumbers
from dalembert.model.part import Part
from dalembert.model.quantities.values import Scalar

TENSIONS = ("tension", "tensioner", "tight", "slack")
"""Keys of which one gives what the torque leaves open: the sum of both tensions."""

Pull = Annotated[float, Scalar("force", "not negative")]


class Idler(Part):
    """A further wheel of a belt: one that turns freely on a link, or that of a link which the belt turns."""

    at: Annotated[tuple[str, str], PlaceOnLink()] = Field(description="link.point: its centre")
    radius: Annotated[float, Scalar("length", "positive")] = Field(
        description="to the belt's middle, a length"
    )
    strand: Literal["left", "right"] = Field(
        description="on which strand it is, as seen from the wheel of i towards that of j"
    )
    side: Literal["back", "inside"] = Field(
        "back", description="back: it presses on the belt's back; inside: it is within the belt"
    )
    efficiency: Efficiency | None = Field(
        None, description="tension that runs on over tension that runs off; default 1"
    )

    def place(self) -> RopePoint:
        """It as a wheel of a rope that runs clockwise."""
        side: Literal["left", "right"] = "left" if self.side == "inside" else "right"
        return RopePoint.model_construct(
            round=self.at, radius=self.radius, side=side, efficiency=self.efficiency
        )


class Belt(JointPart):
    """A belt, or a chain, round a wheel on i and one on j, about the joint's points.

    >>> Belt(links=("motor", "fan"), at=("A", "B"), radii=(0.06, 0.18), tension="350 N").signed_radii
    (0.06, -0.18)
    """

    WRAPPED: ClassVar = True
    type: Literal["belt"] = "belt"
    radii: Annotated[tuple[float, float], TwoNumbers("length")] = Field(
        description="of the wheels to the belt's middle, [of i, of j], lengths"
    )
    crossed: StrictBool = Field(
        False, description="true: the strands cross, and the wheels turn in opposite senses"
    )
    tension: Pull | None = Field(None, description="of each strand at rest, with fixed centres; a force")
    tensioner: Pull | None = Field(
        None, description="constant pull on the shaft: the sum of both strands' tensions on it; a force"
    )
    tight: Pull | None = Field(None, description="tension of the tight strand, a force")
    slack: Pull | None = Field(None, description="tension of the slack strand, a force; of a chain default 0")
    grip: FrictionPart | None = Field(
        None,
        alias="friction",
        description="friction on the wheels, by which the belt holds: {coefficient: 0.3}",
    )
    groove: Annotated[float, Scalar("angle", "positive")] | None = Field(
        None, description="full angle between the sides of a V-belt's groove; default flat"
    )
    mass_per_length: Annotated[float, Scalar("line_density", "not negative")] = Field(
        0.0, description="of the belt: it takes the centrifugal tension m v^2"
    )
    idlers: tuple[Idler, ...] = Field(
        (),
        description="further wheels, those of a strand in their order from i to j: [{at: arm.I, radius: 30 mm, strand: "
        "left, side: back}]; one on a link that moves, with a weight or a spring, gives the tension",
    )
    chain: StrictBool = Field(
        False, description="true: a chain, which cannot slip; its slack strand may not push"
    )

    def replaced_by(self, name: str, value: object) -> tuple[str, ...]:
        """Another of the four tensions, which exclude each other."""
        return tuple(t for t in TENSIONS if t != name) if name in TENSIONS and value is not None else ()

    @property
    def wheels(self) -> int:
        """Both links have one."""
        return 2

    @property
    def internal(self) -> bool:
        """Its wheels are beside each other."""
        return False

    @property
    def pitch_radii(self) -> tuple[float, float]:
        """Radii of i and j, metres."""
        return self.radii

    @property
    def signed_radii(self) -> tuple[float, float]:
        """Radii of i and j; j's negative where both wheels turn in the same sense."""
        return self.radii[0], self.radii[1] if self.crossed else -self.radii[1]

    @property
    def stated_tension(self) -> tuple[str, float]:
        """Name of the one of four tensions that is given, and its value."""
        name = next((t for t in TENSIONS if getattr(self, t) is not None), "slack")
        return name, getattr(self, name) or 0.0

    @model_validator(mode="before")
    @classmethod
    def _one_tension(cls, keys: Any) -> Any:
        if not isinstance(keys, Mapping):
            return keys
        known = [t for t in TENSIONS if keys.get(t) is not None]
        if keys.get("idlers"):
            if known:
                what = f"{known[0]} is given beside idlers, of which one gives the tension by its weight or spring"
                remedy = (
                    f"leave {known[0]} out; over fixed idlers alone it comes from the belt's stretch, which is not "
                    "computed: put one of them on an arm or a slide, with the force that presses it on the belt"
                )
                raise ModelError(what, remedy, (known[0],))
            return keys
        if len(known) > 1:
            what = f"{known[0]} and {known[1]} are both given, and each gives the sum of the tensions"
            raise ModelError(what, "keep one of them", (known[1],))
        if not known and keys.get("chain") is not True:
            raise ModelError(
                "its tension is missing: the torque gives the difference of both strands only",
                "write tension (of each strand at rest), tensioner (pull on the shaft), tight or slack",
            )
        return keys

    def closed(self, joint: str) -> ClosedRope | None:
        """It as a rope whose ends meet on the wheel of i, clockwise round both wheels; None without idlers."""
        if not self.idlers:
            return None
        (i, j), (u, v) = self.links, self.point_names(joint)
        ends = [
            RopePoint.model_construct(round=place, radius=radius, side="left", pulley=False)
            for place, radius in zip(((i, u), (j, v)), self.radii, strict=True)
        ]
        there, back = ([x.place() for x in self.idlers if x.strand == way] for way in ("left", "right"))
        through = (ends[0], *there, ends[1], *reversed(back), ends[0])
        wedge = 1.0 if self.groove is None else np.sin(self.groove / 2)
        return ClosedRope.model_construct(links=self.links, through=through, wedge=wedge, grip=self.grip)

    def places(self, joint: str) -> Iterator[tuple[str, str, Path, Path]]:
        """Its idlers besides."""
        yield from super().places(joint)
        for k, idler in enumerate(self.idlers):
            yield *idler.at, ("idlers", k, "at"), ("idlers", k, "at")

    @model_validator(mode="after")
    def _idlers(self) -> Self:
        if self.idlers and self.crossed:
            what = "a crossed belt has no idlers"
            raise ModelError(what, "leave crossed or idlers out", ("idlers",))
        return self

    @model_validator(mode="after")
    def _of_a_chain(self) -> Self:
        if self.chain and self.crossed:
            raise ModelError("a chain cannot be crossed", "leave crossed out, or use a belt", ("crossed",))
        for key in ("grip", "groove"):
            if self.chain and getattr(self, key) is not None:
                name = "friction" if key == "grip" else key
                raise ModelError(f"a chain holds by its teeth and has no {name}", "leave it out", (name,))
        if self.groove is not None and self.groove >= 3.15:
            raise ModelError(
                "the groove is wider than 180 deg",
                "38 deg is usual; leave it out for a flat belt",
                ("groove",),
            )
        return self
