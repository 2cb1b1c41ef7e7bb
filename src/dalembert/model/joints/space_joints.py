"""Joints in space: their local axes on both links, and the freedoms that a drive can prescribe."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal, Self

from pydantic import Field, ValidationInfo, model_validator

from dalembert.errors import ModelError
from dalembert.model.drives.end_stops import STOPS, JointStops, Stops
from dalembert.model.joints.bearing_keys import Bearing
from dalembert.model.joints.friction_keys import SpaceFriction
from dalembert.model.joints.joint_part import JointPart
from dalembert.model.joints.pairs import AXES, PAIRS, Pair
from dalembert.model.part import Part, mapping, reading
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    Components,
    JsonSchema,
    Scalar,
    ValueField,
    Vector,
    at_item,
    check_sign,
    direction_vector,
    value_text,
)
from dalembert.model.quantities.vectors import cross, dot, unit

Matrix = tuple[Vector, Vector, Vector]
"""Three axes, a vector each."""

RIGHT = 1e-6
"""Cosine of the angle between two axes that counts as a right angle."""


class Frame(Part):
    """Local axes of a joint on one link, in space."""

    x: Annotated[Vector, Components("number")] | None = Field(None, description="direction of local x")
    z: Annotated[Vector, Components("number")] | None = Field(None, description="direction of local z")

    @model_validator(mode="after")
    def _right_angle(self) -> Self:
        for key in ("x", "z"):
            vector = getattr(self, key)
            if vector is not None:
                at_item(key, direction_vector, vector)
        if self.x is not None and self.z is not None and abs(dot(unit(self.x), unit(self.z))) > RIGHT:
            raise ModelError("x and z are not at a right angle", "turn one of them, or leave it out")
        return self


class Frames(Part):
    """Local axes of a joint on its two links."""

    i: Frame = Field(default_factory=Frame, description="in i's axes")
    j: Frame = Field(default_factory=Frame, description="in j's axes")


class Dampings(ValueField):
    """Damping of the only freedom; or `{freedom: coefficient}`."""

    def read(self, value: object, info: ValidationInfo) -> dict[str, float]:
        rules, kind = reading(info), str(info.data.get("type"))
        freedoms = PAIRS[kind].damped if kind in PAIRS else ()
        if not freedoms and value == {}:  # as it is without the key
            return {}
        if not freedoms:
            raise ModelError("this joint has no freedom about one axis to damp", "leave it out")
        keys = value if isinstance(value, dict) else {freedoms[0]: value}
        if not isinstance(value, dict) and len(freedoms) > 1:
            raise ModelError(f"it has the freedoms {', '.join(freedoms)}", f"write {{{freedoms[0]}: 0.2}}")
        mapping(keys, list(freedoms), f"{{{freedoms[0]}: 0.2}}")
        kinds = {key: "damping" if key.startswith("slide") else "torsion_damping" for key in keys}
        return {
            key: check_sign(at_item(key, rules.quantity, item, kinds[key]), item, "not negative")
            for key, item in keys.items()
        }

    def write(self, value: dict[str, float]) -> object:
        kinds = {key: "damping" if key.startswith("slide") else "torsion_damping" for key in value}
        return {key: value_text(item, kinds[key]) for key, item in value.items()}

    def json_schema(self) -> JsonSchema:
        names = sorted({name for pair in PAIRS.values() for name in pair.freedoms})
        what = {True: "force per speed", False: "moment per angular speed"}
        both = {
            "type": "object",
            "properties": {
                name: NUMBER_OR_TEXT | {"description": what[name.startswith("slide")]} for name in names
            },
            "additionalProperties": False,
        }
        return {"anyOf": [NUMBER_OR_TEXT, both]}


class SpaceJoint(JointPart):
    """A joint in space, described by its local axes.

    >>> SpaceJoint(type="revolute", links=("ground", "crank"), axis=(0, 0, 2)).frames[0][2]
    (0.0, 0.0, 1.0)
    """

    DIMENSIONS: ClassVar = (3,)
    type: Literal[
        "revolute",
        "prismatic",
        "screw",
        "cylindrical",
        "universal",
        "spherical",
        "plane",
        "sphere_between_planes",
        "sphere_in_cylinder",
        "cylinder_between_planes",
        "slotted_sphere",
        "torus",
        "slotted_cylinder",
        "slotted_sphere_in_cylinder",
    ]
    axes: Frames | None = Field(None, description="{i: {x: [...], z: [...]}, j: {...}} in link axes")
    axis: Annotated[Vector, Components("number")] | None = Field(
        None, description="the joint's axis, the same components in both links"
    )
    lead: Annotated[float, Scalar("length")] | None = Field(
        None, description="of a screw: advance of j along the axis a turn, negative for a left-hand thread"
    )
    blocked: Literal["x", "y", "z"] | None = Field(
        None, description="of a slotted sphere: the local axis about which it cannot turn; default x"
    )
    friction: SpaceFriction | None = Field(
        None, description="dry friction, of a revolute, prismatic, cylindrical, spherical or screw joint"
    )
    bearing: Bearing | None = Field(None, description="of a revolute joint: pressure and life over the cycle")
    damping: Annotated[dict[str, float], Dampings()] = Field(
        default_factory=dict, description="viscous: of the only freedom, or {freedom: coefficient}"
    )
    stops: Annotated[Stops, JointStops()] | None = Field(None, description=f"of the only freedom: {STOPS}")

    @property
    def freedoms(self) -> tuple[str, ...]:
        """The freedoms of j in i that a drive can prescribe."""
        return self.pair.freedoms

    @property
    def pair(self) -> Pair:
        """Its row of the table, with the blocked axis of a slotted sphere in its place."""
        pair, k = PAIRS[self.type], AXES.index(self.blocked or "x")
        if k == 0:
            return pair
        return pair._replace(moments=AXES[k], turns=AXES[(k + 1) % 3] + AXES[(k + 2) % 3])

    @property
    def ball(self) -> bool:
        """True if j can turn about any axis of i."""
        return self.pair.ball

    @property
    def frames(self) -> tuple[Matrix, Matrix]:
        """Its local axes in i's and in j's axes, each x, y, z."""
        return frames(self.axes, self.axis, self.pair.main)

    @model_validator(mode="after")
    def _check_keys(self, info: ValidationInfo) -> Self:
        if reading(info).dimension == 2:  # the mechanism says that it is not for the plane
            return self
        if (self.lead is None) == self.pair.threaded:
            if self.pair.threaded:
                raise ModelError("a screw needs its lead", "write lead: 5 mm, the advance a turn")
            raise ModelError(f"a {self.type} joint has no lead", "leave it out", ("lead",))
        if self.lead == 0:
            raise ModelError(
                "a screw of lead 0 does not advance", "write its lead, or type: revolute", ("lead",)
            )
        if self.blocked is not None and not self.type.startswith("slotted_sphere"):
            raise ModelError(
                f"a {self.type} joint has no blocked turn to choose", "leave it out", ("blocked",)
            )
        if self.bearing is not None and not self.hinge:
            raise ModelError(f"a {self.type} joint has no bearing", "give it to a revolute", ("bearing",))
        if self.axis is not None:
            at_item("axis", direction_vector, self.axis)
            if self.axes is not None:
                raise ModelError("both axis and axes are given", "leave one of them out", ("axis",))
        self._check_axes()
        if self.friction is not None:
            self._check_friction(self.friction)
        return self

    def _check_friction(self, friction: SpaceFriction) -> None:
        keys, needed = self.pair.friction, self.pair.radius
        if not keys:
            what = f"friction of a {self.type} joint is not analysed"
            rough = [kind for kind, pair in PAIRS.items() if pair.friction]
            raise ModelError(what, "give it to one of " + ", ".join(rough), ("friction",))
        for key in ("radius", "circle", "guide", "thrust_radius", "thread_angle"):
            if key not in keys and getattr(friction, key) is not None:
                raise ModelError(
                    f"the friction of a {self.type} joint has no {key}", "leave it out", ("friction", key)
                )
        if friction.thrust_radius is not None and friction.radius is None:
            if friction.guide is not None:
                what = "its friction has a guide, and no radius of the journal in it"
                raise ModelError(what, "write radius: 10 mm, or leave guide out", ("friction", "guide"))
        elif friction.radius is None and needed:
            what = f"its friction needs the radius of its {needed}"
            collar = ", or thrust_radius alone for a collar" if "thrust_radius" in keys else ""
            raise ModelError(what, f"write radius: 10 mm{collar}", ("friction",))

    def _check_axes(self) -> None:
        if self.pair.pins:
            pins = self.axes and (self.axes.i.z, self.axes.j.z)
            if not pins or None in pins:
                what = "a universal joint needs the directions of its two pins"
                raise ModelError(what, "write axes: {i: {z: [0, 0, 1]}, j: {z: [0, 1, 0]}}")
        elif self.axis is None and self.axes is None and (self.slides or not self.ball):
            raise ModelError(f"a {self.type} joint needs its axis", "write axis: [0, 0, 1], or axes")


def frames(axes: Frames | None, axis: Vector | None, main: str) -> tuple[Matrix, Matrix]:
    """Local axes on both links; an axis that one link leaves out has the components it has in the other,
    orthogonalised.

    An axis that neither gives is the link axis nearest to a right angle, z before x before y.
    """
    if axis is not None:
        single = {main: axis}
        return _frame(single, single, main), _frame(single, single, main)
    i, j = (
        {key: value for key in ("x", "z") if (value := getattr(part, key)) is not None}
        for part in ((axes.i, axes.j) if axes else (Frame(), Frame()))
    )
    return _frame(i, j, main), _frame(j, i, main)


def _frame(axes: dict[str, Vector], other: dict[str, Vector], main: str) -> Matrix:
    """x, y and z of one link."""
    first = next((key for key in (main, "z", "x") if key in axes), None)
    if first is None:
        axes, first = other, next((key for key in (main, "z", "x") if key in other), None)
    if first is None:
        return (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    second = "z" if first == "x" else "x"
    one = unit(axes[first])
    wanted = [v for part in (axes, other) if (v := part.get(second)) is not None]
    two = next(square for v in [*wanted, *_LINK_AXES[second]] if (square := _square(v, one)) is not None)
    x, z = (one, two) if first == "x" else (two, one)
    return x, cross(z, x), z


_LINK_AXES: dict[str, tuple[Vector, ...]] = {
    "x": ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    "z": ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
}


def _square(vector: Vector, axis: Vector) -> Vector | None:
    """The unit vector across an axis nearest to a vector; None where that is nearly along it."""
    one = unit(vector)
    along = dot(one, axis)
    if abs(along) > 0.9:
        return None
    return unit(tuple(u - along * a for u, a in zip(one, axis, strict=True)))
