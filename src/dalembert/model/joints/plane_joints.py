"""Joints: what each kind is made of, and the freedoms it leaves of link j against link i (docs/theory.md 2.1)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, StrictBool, ValidationInfo, model_validator

from dalembert.errors import ModelError
from dalembert.model.drives.end_stops import STOPS, JointStops, Stops
from dalembert.model.joints.bearing_keys import Bearing
from dalembert.model.joints.contact_keys import (
    PUSHES,
    Contact,
    Side,
    check_contact,
    check_flank,
    contact_field,
    side_field,
)
from dalembert.model.joints.elements.belts import Belt
from dalembert.model.joints.elements.brakes import Band, Shoe
from dalembert.model.joints.elements.cams import Cam
from dalembert.model.joints.elements.clutches import Cone, Disc
from dalembert.model.joints.elements.one_way_joints import OneWay, Ratchet
from dalembert.model.joints.elements.pin_keys import PinSize
from dalembert.model.joints.elements.ropes import Rope
from dalembert.model.joints.friction_keys import (
    GearFriction,
    GuideFriction,
    MeshEfficiency,
    PinFriction,
    RollingFriction,
    SlotFriction,
)
from dalembert.model.joints.joint_part import JointPart, TwoNumbers, kinds_of
from dalembert.model.joints.pairs import freedoms_of
from dalembert.model.joints.slot_damping import SlotDamping
from dalembert.model.joints.space_joints import Frames, Matrix, SpaceJoint, frames
from dalembert.model.part import reading
from dalembert.model.quantities.values import (
    Components,
    Scalar,
    Vector,
)

Angle = Annotated[float, Scalar("angle")]
TurnDamping = Annotated[float, Scalar("torsion_damping", "not negative")]
SlideDamping = Annotated[float, Scalar("damping", "not negative")]
_DIRECTION = "of the slide, an angle in i's axes; default 0"


class Pin(JointPart):
    """A turning joint.

    >>> Pin(links=("ground", "crank"), damping="0.2 N*m*s").freedoms
    ('turn',)
    """

    FREEDOMS: ClassVar = ("turn",)
    type: Literal["pin"] = "pin"
    friction: PinFriction | None = Field(None, description="dry friction of the pin")
    bearing: Bearing | None = Field(None, description="its bearing: pressure and life over the cycle")
    pin: PinSize | None = Field(None, description="its bolt: shear, pressure and bending over the cycle")
    damping: TurnDamping = Field(0.0, description="viscous couple per angular speed")
    clearance: Annotated[float, Scalar("length", "not negative")] = Field(
        0.0, description="radial, of the journal in its bearing: the error of points by it"
    )
    stops: Annotated[Stops, JointStops("angle")] | None = Field(None, description=STOPS)


class Slider(JointPart):
    """A straight guide: j slides along `direction` of i and does not turn in it.

    >>> Slider(links=("ground", "piston"), direction="90 deg").freedoms
    ('slide',)
    """

    FREEDOMS: ClassVar = ("slide",)
    type: Literal["slider"] = "slider"
    direction: Angle = Field(0.0, description=_DIRECTION)
    angle: Angle = Field(0.0, description="of j's axes to the direction, default 0")
    friction: GuideFriction | None = Field(None, description="dry friction of the guide")
    damping: SlideDamping = Field(0.0, description="viscous force per speed")
    stops: Annotated[Stops, JointStops("length")] | None = Field(None, description=STOPS)
    contact: Contact = contact_field()
    side: Side = side_field()

    _sides = model_validator(mode="before")(check_contact)

    @property
    def lifted(self) -> tuple[str, ...]:
        """Gaps at the ends of a guide with lengths, else the gap along its normal."""
        return (
            ("gap",) if self.friction is None or self.friction.guide is None else ("gap_behind", "gap_ahead")
        )


class Slot(JointPart):
    """A pin of j in a straight slot of i: it slides and turns.

    >>> Slot(links=("arm", "block")).freedoms
    ('slide', 'turn')
    """

    FREEDOMS: ClassVar = ("slide", "turn")
    type: Literal["slot"] = "slot"
    direction: Angle = Field(0.0, description=_DIRECTION)
    friction: SlotFriction | None = Field(None, description="dry friction in the slot")
    damping: Annotated[tuple[float, float], SlotDamping()] = Field(
        (0.0, 0.0), description="viscous force per speed along the slot, or {slide:, turn:}"
    )
    stops: Annotated[Stops, JointStops("length")] | None = Field(None, description=f"of the slide: {STOPS}")
    contact: Contact = contact_field()
    side: Side = side_field()

    _sides = model_validator(mode="before")(check_contact)


class CircularSlot(JointPart):
    """A pin of j in a circular slot of i: it keeps its distance from the slot's centre, i's point, and turns.

    >>> CircularSlot(links=("ground", "arm"), at=("C", "P"), radius="200 mm").radius
    0.2
    """

    FREEDOMS: ClassVar = ("turn",)
    type: Literal["circular_slot"] = "circular_slot"
    radius: Annotated[float, Scalar("length", "positive")] = Field(
        description="of the slot's middle line about i's point, a length"
    )
    damping: TurnDamping = Field(0.0, description="viscous couple per angular speed of the pin")
    contact: Contact = contact_field()
    side: Side = side_field()

    _sides = model_validator(mode="before")(check_contact)

    @property
    def apart(self) -> bool:
        """The pin goes round i's point."""
        return True

    @model_validator(mode="before")
    @classmethod
    def _without_friction(cls, keys: Any) -> Any:
        if isinstance(keys, Mapping) and keys.get("friction") is not None:
            raise ModelError(
                "friction in a circular slot is not analysed as such",
                "put a link from the slot's centre to its pin, pinned at both: friction in the pin at the centre, with "
                "the slot's radius, is the slot's",
                ("friction",),
            )
        return keys


class Weld(JointPart):
    """A rigid connection.

    >>> Weld(links=("boom", "load")).freedoms
    ()
    """

    DIMENSIONS: ClassVar = (2, 3)
    type: Literal["weld"] = "weld"
    angle: Angle = Field(0.0, description="of j's axes to i's, default 0")
    axes: Frames | None = Field(
        None, description="in space: local axes on both links, which are held together"
    )

    @property
    def frames(self) -> tuple[Matrix, Matrix]:
        """In space: its local axes in i's and in j's axes, a column each."""
        return frames(self.axes, None, "")


class Gear(JointPart):
    """Two toothed wheels on i and j: their pitch circles, about the joint's points, roll on each other.

    >>> Gear(links=("pinion", "wheel"), teeth=(20, 50), module="2 mm").pitch_radii
    (0.02, 0.05)
    """

    DIMENSIONS: ClassVar = (2, 3)
    TOOTHED: ClassVar = True
    type: Literal["gear"] = "gear"
    radii: Annotated[tuple[float, float], TwoNumbers("length")] | None = Field(
        None, description="of the pitch circles, [of i, of j], lengths; or teeth and module"
    )
    teeth: Annotated[tuple[float, float], TwoNumbers("number", "teeth")] | None = Field(
        None, description="numbers of teeth, [of i, of j]"
    )
    module: Annotated[float, Scalar("length", "positive")] | None = Field(
        None, description="pitch diameter over number of teeth, a length"
    )
    pressure_angle: Angle = Field(0.3490658503988659, description="of the teeth, an angle; default 20 deg")
    helix_angle: Angle = Field(
        0.0,
        description="in space: of i's teeth to its axis (of a bevel wheel, to the cone), right-hand positive",
    )
    axes: Frames | None = Field(
        None, description="in space: {i: {z: [...]}, j: {z: [...]}}, the wheels' axes"
    )
    axis: Annotated[Vector, Components("number")] | None = Field(
        None, description="in space: the axis of both wheels, the same components in both links"
    )
    internal: StrictBool = Field(False, description="true: the larger wheel is an internal gear")
    friction: GearFriction | None = Field(None, description="dry friction of the teeth")
    efficiency: Annotated[float, MeshEfficiency()] | None = Field(
        None,
        description="of the teeth, instead of friction: power out over power in, seen from the line of centres",
    )
    contact: Contact = contact_field()
    flank: Side | None = Field(
        None,
        description="of teeth that only push: the side of the line from i's centre to j's to which they push j",
    )

    @property
    def wheels(self) -> int:
        """Both links have one."""
        return 2

    @property
    def pitch_radii(self) -> tuple[float, float]:
        """Radii of the pitch circles of i and j, metres."""
        if self.radii is not None:
            return self.radii
        assert self.teeth is not None
        assert self.module is not None
        return self.teeth[0] * self.module / 2, self.teeth[1] * self.module / 2

    @property
    def frames(self) -> tuple[Matrix, Matrix]:
        """In space: local axes in i's and in j's axes; z is the wheel's axis."""
        return frames(self.axes, self.axis, "z")

    @model_validator(mode="after")
    def _in_space(self, info: ValidationInfo) -> Self:
        dimension = reading(info).dimension
        for key in ("helix_angle", "axes", "axis"):
            if dimension == 2 and getattr(self, key):
                raise ModelError(f"a wheel of a planar mechanism takes no {key}", "leave it out", (key,))
        if dimension == 3 and (self.axes is None) == (self.axis is None):
            what = "a gear in space needs the axes of its wheels"
            raise ModelError(what, "write axis: [0, 0, 1] for both, or axes: {i: {z: ...}, j: {z: ...}}")
        if not -1.5 < self.helix_angle < 1.5:
            raise ModelError(
                "the helix angle is not between -86 and 86 deg", "write one in range", ("helix_angle",)
            )
        return self

    @model_validator(mode="after")
    def _one_flank(self) -> Self:
        flat = not (self.helix_angle or self.axes or self.axis)
        check_flank(self.contact, self.flank, flat)
        return self

    @model_validator(mode="after")
    def _one_size(self, info: ValidationInfo) -> Self:
        toothed = self.teeth is not None and self.module is not None
        half = (self.teeth is None) != (self.module is None)
        if half or toothed == (self.radii is not None):
            raise ModelError("its size is not clear", "give either radii, or both teeth and module")
        if not 0 <= self.pressure_angle < 1.2:
            raise ModelError(
                "the pressure angle is not between 0 and 68 deg", "20 deg is usual", ("pressure_angle",)
            )
        _check_internal(self.internal, self.pitch_radii)
        if self.friction is not None and self.efficiency is not None:
            what = "both friction and efficiency are given"
            raise ModelError(what, "leave one of them out: both are what the teeth lose", ("efficiency",))
        couple = self.friction is not None and reading(info).dimension != 3  # skew axes in space need none
        if couple and self.friction is not None and self.friction.arm is None and self.teeth is None:
            raise ModelError(
                "its friction needs the arm of the teeth's contact",
                "give arm, or the size as teeth and module",
                ("friction",),
            )
        return self


def _check_internal(internal: bool, radii: tuple[float, float]) -> None:
    if internal and radii[0] == radii[1]:
        raise ModelError(
            "a wheel is as large as the internal wheel around it", "make one of the radii larger"
        )


class Rolling(JointPart):
    """A wheel on j, about j's point, that rolls without slip on a line through i's point, or on a circle about it.

    >>> Rolling(links=("ground", "wheel"), radius="200 mm").radius
    0.2
    """

    FREEDOMS: ClassVar = ("turn",)
    type: Literal["rolling"] = "rolling"
    radius: Annotated[float, Scalar("length", "positive")] | None = Field(
        None, description="of the wheel on a straight line, a length; or radii"
    )
    direction: Angle = Field(
        0.0, description="of the line, an angle in i's axes; the wheel is on its left; default 0"
    )
    radii: Annotated[tuple[float, float], TwoNumbers("length")] | None = Field(
        None, description="of the circle on i and of the wheel on j, lengths"
    )
    internal: StrictBool = Field(False, description="true: one rolls inside the other")
    contact: Contact = contact_field(PUSHES)
    friction: RollingFriction | None = Field(
        None,
        description="dry friction on its track: how much it can transmit without slip, and in simulate beyond it",
    )

    @property
    def wheels(self) -> int:
        """One on a line, else two."""
        return 1 if self.radii is None else 2

    @property
    def lifted(self) -> tuple[str, ...]:
        """Off its track it slips too."""
        return ("gap", "slip")

    @property
    def pitch_radii(self) -> tuple[float, float]:
        """Radii of the circle on i, 0 of a line, and of the wheel on j, metres."""
        return self.radii or (0.0, self.radius or 0.0)

    @model_validator(mode="after")
    def _line_or_circle(self) -> Self:
        if (self.radius is None) == (self.radii is None):
            raise ModelError(
                "its size is not clear",
                "give either radius, for a wheel on a line, or radii, for one on a circle",
            )
        if self.friction is not None and self.contact.mode == "holds":
            what = "a wheel that is held on its track on both sides has no limit of friction"
            raise ModelError(what, "write contact: pushes, or leave the friction out", ("friction",))
        if self.radii is not None and self.direction:
            raise ModelError("a wheel on a circle has no direction", "leave it out", ("direction",))
        if self.radii is None and self.internal:
            raise ModelError("a wheel on a line cannot be internal", "leave it out", ("internal",))
        if self.radii is not None:
            _check_internal(self.internal, self.radii)
        return self


Joint = Annotated[
    Pin
    | Slider
    | Slot
    | CircularSlot
    | Weld
    | Gear
    | Rolling
    | Belt
    | Rope
    | Band
    | Shoe
    | Disc
    | Cone
    | Cam
    | OneWay
    | Ratchet
    | SpaceJoint,
    Field(discriminator="type", description="a joint"),
]


_FREEDOMS = {part.model_fields["type"].default: part.FREEDOMS for part in kinds_of(JointPart)}


def freedoms(kind: object) -> tuple[str, ...]:
    """The freedoms of a joint type that a drive can prescribe, none for an unknown one."""
    return (_FREEDOMS.get(kind) or freedoms_of(kind)) if isinstance(kind, str) else ()
