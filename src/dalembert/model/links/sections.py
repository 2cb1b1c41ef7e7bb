"""The section of a straight member: its numbers for stress and buckling, from a shape or as given."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, NamedTuple, Self

from pydantic import Field, ValidationInfo, model_validator

from dalembert.errors import ModelError
from dalembert.model.links.shapes import Lengths
from dalembert.model.part import Part, reading
from dalembert.model.quantities.values import (
    NAME_OR_NUMBER,
    NUMBER_OR_TEXT,
    JsonSchema,
    Scalar,
    ValueField,
    Vector,
    at_item,
    list_schema,
    name,
    pair_of_names,
    value_text,
)

MASS_ALONG = ("uniform", "shape", "lumped")


class MassAlong(ValueField):
    """Distribution of a link's mass along its members."""

    def read(self, value: object, info: ValidationInfo) -> str:
        if value not in MASS_ALONG:
            what = f"{value!r} is not a mass distribution along a member"
            raise ModelError(what, f"write {', '.join(MASS_ALONG)}")
        return str(value)

    def json_schema(self) -> JsonSchema:
        return {"enum": list(MASS_ALONG)}


class Members(ValueField):
    """`[[A, B], [B, C]]`: straight members by two points of the link each, or a single `[A, B]`."""

    def read(self, value: Any, info: ValidationInfo) -> tuple[tuple[str, str], ...]:
        example = "write [[A, B], [B, C]]"
        if not isinstance(value, (list, tuple)) or not value:
            raise ModelError("the list of members is empty or not a list", example)
        pairs = value if isinstance(value[0], (list, tuple)) else [value]
        members = tuple(pair_of_names(pair) for pair in pairs)
        met = [{name(members[0][0])}]
        for a, b in members:
            at_a, at_b = (next((s for s in met if end in s), {end}) for end in (a, b))
            if at_a is at_b:
                what = f"the members close a ring at {a!r} and {b!r}; its forces are statically indeterminate"
                raise ModelError(what, "leave one of them out: members are a tree")
            met = [s for s in met if s is not at_a and s is not at_b] + [at_a | at_b]
        if len(met) > 1:
            raise ModelError("the members are not connected", "let each begin at a point of another")
        return members

    def write(self, value: tuple[tuple[str, str], ...]) -> object:
        return [list(pair) for pair in value]

    def json_schema(self) -> JsonSchema:
        pair = list_schema(NAME_OR_NUMBER, 2, 2)
        return {"anyOf": [pair, list_schema(pair)]}


class NotchFactor(ValueField):
    """`1.8`, or by points of the link `{C: 1.8, D: 1.5}`."""

    def read(self, value: Any, info: ValidationInfo) -> dict[str, float]:
        if isinstance(value, Mapping):
            if not value:
                raise ModelError("no point has a notch factor", "write notch: {C: 1.8}")
            return {str(n): at_item(str(n), self._factor, v, info) for n, v in value.items()}
        return {"": self._factor(value, info)}

    def _factor(self, value: Any, info: ValidationInfo) -> float:
        factor = reading(info).quantity(value, "number")
        if not factor >= 1:
            raise ModelError(f"a notch factor of {value} is below 1", "write K_f, such as notch: 1.8")
        return factor

    def write(self, value: dict[str, float]) -> object:
        out = {n: value_text(k, "number") for n, k in value.items()}
        return out[""] if [*out] == [""] else out

    def json_schema(self) -> JsonSchema:
        return {"anyOf": [NUMBER_OR_TEXT, {"type": "object", "additionalProperties": NUMBER_OR_TEXT}]}


class Measures(NamedTuple):
    """Numbers of a section, SI, as the properties of ``Section`` say them."""

    area: float
    second_moments: tuple[float, float]
    reach: tuple[float, float]
    shear: tuple[float, float]


Stress = Annotated[float, Scalar("pressure", "positive")]


class Section(Part):
    """The section of a member, by one shape or by area, modulus and inertia; and the strength of its material.

    y is transverse to the member in the plane of bending (z its normal). ``area`` A, ``modulus`` W = I /
    e, ``inertia`` I, second moment of area.

    >>> s = Section(rectangle=("20 mm", "40 mm"))
    >>> round(s.area_of, 9), round(s.second_moments[1], 13)    # m2; m4 in the plane
    (0.0008, 1.066667e-07)
    """

    rectangle: Annotated[Vector, Lengths(2, "write rectangle: [across the plane, in the plane]")] | None = (
        Field(None, description="[across the plane, in the plane]: lengths")
    )
    circle: Annotated[float, Scalar("length", "positive")] | None = Field(None, description="diameter")
    tube: Annotated[Vector, Lengths(2, "write tube: [inner, outer diameter]")] | None = Field(
        None, description="[inner, outer] diameter"
    )
    I: Annotated[Vector, Lengths(4, "write I: [height, width, web, flange]")] | None = Field(  # noqa: E741
        None, description="[height in the plane, width, thickness of web, of flange]: lengths"
    )
    area: Annotated[float, Scalar("area", "positive")] | None = Field(None, description="A, length^2")
    modulus: Annotated[float, Scalar("section_modulus", "positive")] | None = Field(
        None, description="W = I / e, length^3"
    )
    inertia: Annotated[float, Scalar("second_moment", "positive")] | None = Field(
        None, description="second moment of area I, length^4"
    )
    yield_stress: Stress | None = Field(None, description="of the material, force per area")
    ultimate: Stress | None = Field(None, description="ultimate stress of the material")
    endurance: Stress | None = Field(None, description="endurance stress of the material")
    notch: Annotated[dict[str, float], NotchFactor()] | None = Field(
        None, description="fatigue notch factor K_f, at least 1: of all places, or by point {C: 1.8}"
    )
    elasticity: Stress | None = Field(None, description="Young's modulus of the material")

    @model_validator(mode="after")
    def _one_size(self) -> Self:
        shapes = [k for k in ("rectangle", "circle", "tube", "I") if getattr(self, k) is not None]
        stated = [k for k in ("area", "modulus", "inertia") if getattr(self, k) is not None]
        if len(shapes) + bool(stated) != 1:
            what = (
                f"{' and '.join([*shapes, *stated])} give it twice" if shapes else "the section has no size"
            )
            remedy = "write one of rectangle, circle, tube, I, or area, modulus and inertia"
            raise ModelError(what, remedy, stated[:1])
        if stated and len(stated) < 3:
            missing = next(k for k in ("area", "modulus", "inertia") if k not in stated)
            problem = f"the section has no {missing}"
            raise ModelError(problem, "give area, modulus and inertia, or a shape", ())
        if self.tube and self.tube[0] >= self.tube[1]:
            raise ModelError("the inner diameter is not smaller", "write tube: [inner, outer]", ("tube",))
        if self.I and (self.I[2] >= self.I[1] or 2 * self.I[3] >= self.I[0]):
            raise ModelError("web and flanges do not fit", "write I: [height, width, web, flange]", ("I",))
        return self

    @property
    def round(self) -> bool:
        """True if its bending stiffness is the same about every axis."""
        return self.circle is not None or self.tube is not None

    @property
    def _measures(self) -> Measures:
        if self.rectangle:
            b, h = self.rectangle
            second = h * b**3 / 12, b * h**3 / 12
            return Measures(b * h, second, (h / 2, b / 2), (1.5 / (b * h),) * 2)
        if self.I:
            h, b, web, flange = self.I
            clear = h - 2 * flange
            second = (2 * flange * b**3 + clear * web**3) / 12, (b * h**3 - (b - web) * clear**3) / 12
            shears = 1 / (web * clear), 0.75 / (b * flange)
            return Measures(2 * b * flange + clear * web, second, (h / 2, b / 2), shears)
        if self.round:
            r, R = (d / 2 for d in self.tube or (0.0, self.circle or 0.0))
            area, second_moment = math.pi * (R**2 - r**2), math.pi / 4 * (R**4 - r**4)
            shear = 4 / 3 / area * (R**2 + R * r + r**2) / (R**2 + r**2)
            return Measures(area, (second_moment,) * 2, (R, R), (shear,) * 2)
        assert self.area is not None
        assert self.inertia is not None
        assert self.modulus is not None
        reach, shear = self.inertia / self.modulus, 1.5 / self.area
        return Measures(self.area, (self.inertia,) * 2, (reach,) * 2, (shear,) * 2)

    @property
    def area_of(self) -> float:
        """A, m2."""
        return self._measures.area

    @property
    def second_moments(self) -> tuple[float, float]:
        """(about y, about z), m4: in the plane it bends about z."""
        return self._measures.second_moments

    @property
    def reach(self) -> tuple[float, float]:
        """Distances of its outermost fibres from the axis along y and z, m."""
        return self._measures.reach

    @property
    def shear(self) -> tuple[float, float]:
        """Greatest shear stress over the shear force along y, and along z, 1/m2.

        3/2 A, 4/3 A of a circle, 2/A of a thin tube; of an I 1/A of its web, and 3/2 A of both flanges.
        """
        return self._measures.shear

    @property
    def torsion(self) -> float:
        """Torque over its greatest shear stress, m3: 2 I / r, rectangles within 0.2 % (Roark), an I as thin strips."""
        if self.rectangle:
            short, long = sorted(self.rectangle)
            k = short / long
            roark = 1 + 0.6095 * k + 0.8865 * k**2 - 1.8023 * k**3 + 0.91 * k**4
            return long * short**2 / 3 / roark
        if self.I:
            h, b, web, flange = self.I
            return (2 * b * flange**3 + (h - 2 * flange) * web**3) / 3 / max(web, flange)
        if self.round:
            return 2 * self._measures.second_moments[0] / self._measures.reach[0]
        remedy = "give a rectangle, a circle, a tube or an I"
        what = "a section given by its numbers has no torsion or biaxial bending properties"
        raise ModelError(what, remedy)
