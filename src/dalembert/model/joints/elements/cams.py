"""Cams: a plate on link i that moves a follower, link j."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, model_validator

from dalembert.errors import ModelError
from dalembert.model.joints.contact_keys import PUSHES, Contact, contact_field
from dalembert.model.joints.elements.cam_profiles import CamProfile, FollowerShape, FollowerValue
from dalembert.model.joints.friction_keys import FrictionPart
from dalembert.model.joints.joint_part import JointPart
from dalembert.model.quantities.values import Scalar

Length = Annotated[float, Scalar("length", "positive")]


class CamFriction(FrictionPart):
    """Friction where a knife edge or a face slides on the cam."""


class Cam(JointPart):
    """A cam on link i, about i's point, that moves link j: its knife edge, the centre of its roller, or its flat face
    through j's point.

    >>> profile = {"eccentric": "12 mm", "radius": "40 mm"}
    >>> Cam(links=("cam", "valve"), follower={"roller": "10 mm"}, profile=profile).follower.roller
    0.01
    """

    FREEDOMS: ClassVar = ()
    type: Literal["cam"] = "cam"
    follower: Annotated[FollowerShape, FollowerValue()] = Field(
        description="knife, flat, or {roller: its radius}; its point is j's"
    )
    profile: CamProfile = Field(description="form of the cam")
    face: Annotated[float, Scalar("angle")] | None = Field(
        None,
        description="direction of a flat face, an angle in j's axes; default across the slide, or along the arm",
    )
    contact: Contact = contact_field(PUSHES)
    friction: CamFriction | None = Field(None, description="dry friction of a knife edge or a flat face")
    face_width: Length | None = Field(
        None, description="of the cam, a length: for the pressure of the contact"
    )
    elasticity: Annotated[float, Scalar("pressure", "positive")] | None = Field(
        None, description="modulus of cam and follower: for the pressure of the contact"
    )
    preload: Annotated[float, Scalar("force", "positive")] | None = Field(
        None,
        description="force with which the two rollers of conjugate cams are pressed on their discs, at rest",
    )
    poisson: Annotated[float, Scalar("number", "not negative")] = Field(
        0.3, description="Poisson's ratio of both"
    )

    @property
    def lifted(self) -> tuple[str, ...]:
        """The gap along the follower's path."""
        return ("gap",)

    @property
    def apart(self) -> bool:
        """The follower moves away from the cam's axis."""
        return True

    @property
    def outlined(self) -> bool:
        """The cam has an outline."""
        return True

    @property
    def flat(self) -> bool:
        """True if the follower has a flat face."""
        return self.follower.kind == "flat"

    @model_validator(mode="before")
    @classmethod
    def _of_a_roller(cls, keys: Any) -> Any:
        if (
            isinstance(keys, Mapping)
            and keys.get("friction") is not None
            and isinstance(keys.get("follower"), Mapping)
        ):
            raise ModelError(
                "a roller rolls on the cam and does not rub",
                "leave friction out, or let the roller be a link with friction in its pin",
                ("friction",),
            )
        return keys

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.contact.mode == "pulls":
            raise ModelError(
                "a cam pushes its follower, it does not pull it",
                "leave contact out, or write contact: holds for a roller in a groove",
                ("contact",),
            )
        if self.preload is not None and (self.contact.mode != "holds" or self.follower.kind != "roller"):
            raise ModelError(
                "a preload is that of two rollers on conjugate cams",
                "write contact: holds and follower: {roller: ...}; press a single follower on by a spring",
                ("preload",),
            )
        if self.face is not None and not self.flat:
            raise ModelError(f"a {self.follower.kind} has no face", "leave it out", ("face",))
        if self.profile.prime is not None and self.follower.kind != "roller":
            raise ModelError(
                f"prime is the least radius of a roller's centre, and the follower is {self.follower.kind}",
                "write base",
                ("profile", "prime"),
            )
        if self.profile.prime is not None and self.profile.prime <= self.follower.roller:
            raise ModelError(
                "the prime circle is not larger than the roller: the cam would have no radius",
                "make prime larger, or the roller smaller",
                ("profile", "prime"),
            )
        return self
