"""A link: a rigid body with named points in link axes and mass properties; it has no position and no forces."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, ClassVar, Self

from pydantic import Discriminator, Field, Tag, ValidationInfo, model_validator

from dalembert.arrays import Numeric, Tree
from dalembert.errors import ModelError
from dalembert.model.links.effective_lengths import EffectiveLength, Factors
from dalembert.model.links.sections import MassAlong, Members, Section
from dalembert.model.links.shapes import (
    MassProperties,
    Shape,
    ShapePart,
    check_densities,
    finite,
    mass_properties,
)
from dalembert.model.part import Part, mapping, reading
from dalembert.model.quantities.figures import unit_vector
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    Components,
    JsonSchema,
    Name,
    Scalar,
    ValueField,
    Vector,
    at_item,
    check_sign,
    name,
    numbers,
    object_schema,
    value_text,
    vector,
    vector_schema,
    vector_text,
)
from dalembert.wording import closest, quote_value

CENTER = "center"
"""Name of the mass centre where a point is expected."""

GROUND = "ground"
"""The reserved name of the fixed link."""


@dataclass(frozen=True, slots=True)
class Offset:
    """A point placed from another one, or from the mass centre.

    In the plane ``start`` may be turned, or reflected in a line at the angle ``mirror`` through the point ``about``
    (empty: the link's origin), before ``at`` is added (empty: nothing).

    >>> Offset("A", (0.1, 0.0)).at
    (0.1, 0.0)
    """

    start: str
    at: Vector = ()
    turn: float = 0.0
    mirror: float | None = None
    about: str = ""

    def image(self, start: Vector, about: Vector) -> Vector:
        """Image of a start, both in link axes, metres; ``start`` may be of symbols."""
        if self.turn or self.mirror is not None:
            x, y = (a - b for a, b in zip(start, about, strict=True))
            cos, sin = unit_vector(self.turn if self.mirror is None else 2 * self.mirror)
            side = 1.0 if self.mirror is None else -1.0
            start = about[0] + cos * x - side * sin * y, about[1] + sin * x + side * cos * y
        return tuple(a + b for a, b in zip(start, self.at, strict=True)) if self.at else start


Inertia = float | tuple[float, ...] | tuple[tuple[float, ...], ...]


class Place(ValueField):
    """A point: a vector in link axes, or `{from: OTHER, at: VECTOR}`."""

    def read(self, value: object, info: ValidationInfo) -> Vector | Offset:
        rules = reading(info)
        if isinstance(value, Offset):
            return value
        if not isinstance(value, Mapping):
            return vector(value, "length", rules)
        needed = ("from",) if {"turn", "mirror"} & value.keys() else ("from", "at")
        known = ["from", "at", "turn", "mirror", "about"]
        keys = mapping(value, known, "{from: center, at: [x, y]}", needed)
        if {"turn", "mirror"} <= keys.keys() or (rules.dimension == 3 and {"turn", "mirror"} & keys.keys()):
            what = "in space" if rules.dimension == 3 else "by both turn and mirror"
            raise ModelError(f"a point is placed {what}", "turn it, or mirror it, in the plane", ("from",))
        angles = {
            key: at_item(key, rules.quantity, keys[key], "angle") for key in ("turn", "mirror") if key in keys
        }
        at = at_item("at", vector, keys["at"], "length", rules) if "at" in keys else ()
        about = at_item("about", name, keys["about"]) if "about" in keys else ""
        return Offset(at_item("from", name, keys["from"]), at, **angles, about=about)

    def write(self, value: Vector | Offset) -> object:
        if isinstance(value, Offset):
            tree: Tree = {"from": value.start}
            if value.turn or (value.mirror is None and not value.at):
                tree["turn"] = value_text(value.turn, "angle")
            if value.mirror is not None:
                tree["mirror"] = value_text(value.mirror, "angle")
            if value.about:
                tree["about"] = value.about
            if value.at:
                tree["at"] = vector_text(value.at, "length")
            return tree
        return vector_text(value, "length")

    def json_schema(self) -> JsonSchema:
        relative = {
            "from": {"type": "string", "description": "another point of the link, or center"},
            "at": vector_schema() | {"description": "relative to it, in link axes, lengths"},
            "turn": NUMBER_OR_TEXT | {"description": "in the plane: that point turned by this angle"},
            "mirror": NUMBER_OR_TEXT | {"description": "or reflected in a line at this angle"},
            "about": {"type": "string", "description": "the point it is turned about; default the origin"},
        }
        return {"anyOf": [*vector_schema()["anyOf"], object_schema(relative, "from")]}


class InertiaValue(ValueField):
    """About the mass centre: one number; in space three principal values or a symmetric matrix."""

    sign = "not negative"

    def read(self, value: object, info: ValidationInfo) -> Inertia:
        rules = reading(info)
        if not isinstance(value, (list, tuple)):
            return check_sign(rules.quantity(value, "inertia"), value, self.sign)
        if rules.dimension == 2:
            remedy = "in the plane, write inertia: 0.02; in space, space: space at the top"
            raise ModelError(f"expected one number, not {quote_value(value)}", remedy)
        if len(value) != 3:
            what = f"a list of {len(value)} is not an inertia"
            raise ModelError(what, "write 3 principal values, or the 3 rows of a matrix")
        if isinstance(value[0], (list, tuple)):
            return _symmetric(
                tuple(at_item(i, numbers, row, "inertia", rules) for i, row in enumerate(value))
            )
        moments = numbers(value, "inertia", rules)
        return tuple(at_item(i, check_sign, x, value[i], self.sign) for i, x in enumerate(moments))

    def write(self, value: Inertia) -> object:
        if isinstance(value, tuple):
            return [self.write(item) for item in value]
        return value_text(value, "inertia")

    def json_schema(self) -> JsonSchema:
        row = {"anyOf": [NUMBER_OR_TEXT, {"type": "array", "items": NUMBER_OR_TEXT}]}
        rows = {"type": "array", "items": row}
        return {"anyOf": [NUMBER_OR_TEXT, rows]}


def _symmetric(rows: tuple[tuple[float, ...], ...]) -> tuple[tuple[float, ...], ...]:
    if any(len(row) != 3 for row in rows) or any(
        rows[i][j] != rows[j][i] for i in range(3) for j in range(i)
    ):
        what = "the matrix of inertia is not symmetric, 3 by 3"
        raise ModelError(what, "give [i][j] and [j][i] the same value")
    import numpy as np

    principal = np.linalg.eigvalsh(np.array(rows))
    if principal[0] < -1e-9 * principal[-1]:
        raise ModelError(
            f"the matrix of inertia has the principal value {principal[0]:.3g} kg m2, and no body has a negative one",
            "check the signs of the products of inertia",
        )
    return rows


Shapes = Annotated[
    Annotated[Shape, Tag("one")] | Annotated[tuple[Shape, ...], Tag("several")],
    Discriminator(lambda value: "several" if isinstance(value, (list, tuple)) else "one"),
]


class Link(Part):
    """A rigid body.

    >>> link = Link(points={"O": (0, 0), "A": "5 in @ 30 deg"}, mass="2 lbm", center=(0.06, 0))
    >>> link.mass
    0.90718474
    """

    INSTEAD: ClassVar = {"mass": "weight", "weight": "mass"}

    points: dict[Name, Annotated[Vector | Offset, Place()]] = Field(
        default_factory=dict, description="named points in link axes: lengths, or {from: OTHER, at: VECTOR}"
    )
    mass: Annotated[float, Scalar("mass", "not negative")] | None = Field(
        None, description="mass; or give weight; default massless"
    )
    weight: Annotated[float, Scalar("force", "not negative")] | None = Field(
        None, description="weight, a force, instead of the mass: divided by g"
    )
    center: Annotated[Vector, Components("length")] | None = Field(
        None, description="mass centre in link axes, lengths; default the link's origin"
    )
    inertia: Annotated[Inertia, InertiaValue()] = Field(
        0.0,
        description="moment of inertia about the mass centre; in space 3 principal values or a 3 x 3 matrix",
    )

    place: Annotated[float, Scalar("length")] = Field(
        0.0,
        description="in the plane: where the link lies along the normal, for couples of shaking forces; default 0",
    )
    shape: Shapes | None = Field(
        None, description="what it looks like, one shape or a list: gives mass, center and inertia"
    )
    mass_along: Annotated[str, MassAlong()] = Field(
        "lumped",
        description="for the forces inside it: mass along its members uniform, by its shape, or lumped (default)",
    )
    members: Annotated[tuple[tuple[str, str], ...], Members()] | None = Field(
        None, description="its straight members, [[A, B], [B, C]]; default the line through its joints"
    )
    section: Section | None = Field(None, description="section of its members: {rectangle: [20 mm, 40 mm]}")
    effective_length: Annotated[Factors, EffectiveLength()] | None = Field(
        None,
        description="for buckling: K of the length K L, [in the plane, across it] or by member; default by joints",
    )

    @model_validator(mode="after")
    def _place_in_the_plane(self, info: ValidationInfo) -> Self:
        if self.place and reading(info).dimension == 3:
            remedy = "leave it out: in space the points locate the link"
            raise ModelError("a place along the normal is for planar mechanisms only", remedy, ("place",))
        return self

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        if self.mass is not None and self.weight is not None:
            raise ModelError("both mass and weight are given", "leave one of them out")
        if self.shape is not None:
            self._check_shape()
        if CENTER in self.points:
            what = f"a point is named {CENTER!r}, the name of the mass centre"
            raise ModelError(what, "give it another name", ("points", CENTER))
        for point in self.points:
            self.point(point)
        self._check_members()
        return self

    def _check_members(self) -> None:
        for k, pair in enumerate(self.members or ()):
            a, b = (at_item("members", at_item, k, self.point, end) for end in pair)
            if a == b:
                what = f"points {pair[0]!r} and {pair[1]!r} are in one place"
                raise ModelError(what, "name two that are apart", ("members", k))
        for point in (self.section.notch or {}) if self.section else ():
            if point and point not in self.points:
                remedy = closest(point, [*self.points])
                raise ModelError(f"notch at an unknown point {point!r}", remedy, ("section", "notch", point))
        names = [f"{a}-{b}" for a, b in self.members or ()]
        for member in self.effective_length or {}:
            if member and member not in names:
                remedy = closest(member, names) if names else "name its members: members: [[A, B]]"
                raise ModelError(
                    f"{member!r} is not one of its members", remedy, ("effective_length", member)
                )
        if self.mass_along == "shape" and not self.shapes:
            raise ModelError("mass_along is by a shape, and there is none", "write uniform", ("mass_along",))

    @property
    def shapes(self) -> tuple[ShapePart, ...]:
        """Its shapes, none, one or several."""
        return () if self.shape is None else self.shape if isinstance(self.shape, tuple) else (self.shape,)

    def _check_shape(self) -> None:
        for key in ("center", "inertia"):
            if getattr(self, key):
                problem = f"both shape and {key} are given"
                raise ModelError(problem, "leave one of them out: a shape gives both", (key,))
        check_densities(self.shapes, self.mass is not None or self.weight is not None)
        if not finite(self.mass_properties, 1.0 if self.weight is not None else self.mass):
            what = "its mass or inertia is not a finite number"
            raise ModelError(what, "check its size and units", ("shape",))

    def mass_properties(self, mass: Numeric = None) -> MassProperties:
        """Mass, centre and inertia of its shapes; of uniform density where the total mass is given."""
        return mass_properties(self.shapes, self._marked, mass)

    def _marked(self, point: str) -> Vector:
        """A point of its shape, which is not placed from the mass centre that the shape gives."""
        if point not in self.points:
            raise ModelError(f"unknown point {point!r}", closest(point, list(self.points)))
        start = point
        for _ in self.points:
            place = self.points.get(start)
            if isinstance(place, Offset):
                start = place.start
        if start == CENTER:
            what = f"point {point!r} is placed from the mass centre, which the shape gives"
            raise ModelError(what, "place it from the origin")
        return self.point(point)

    def point(self, point: str) -> Vector:
        """A point in link axes, metres; `center` is the mass centre. Raises ModelError if there is none."""
        seen: list[str] = []
        while isinstance(place := self._place(point, seen), Offset):
            seen.append(point)
            point = place.start
        for behind in reversed(seen):
            offset = self.points[behind]
            assert isinstance(offset, Offset)
            place = offset.image(place, self._about(offset, seen))
        return place

    def _about(self, offset: Offset, seen: list[str]) -> Vector:
        if not offset.about:
            return (0.0,) * self._dimension()
        place = self._place(offset.about, seen)
        if isinstance(place, Offset):
            what = f"a point is turned about {offset.about!r}, which is placed from another"
            raise ModelError(what, "give that point a vector", ("points", seen[0], "about"))
        return place

    def _place(self, point: str, seen: list[str]) -> Vector | Offset:
        if point in seen:
            circle = " from ".join([*seen, point])
            what = f"points refer to each other in a circle: {circle}"
            raise ModelError(what, "give one of them a vector", ("points", seen[0], "from"))
        if point == CENTER:
            return self._center()
        if point not in self.points:
            path = ("points", seen[-1], "from") if seen else ("points",)
            raise ModelError(f"unknown point {point!r}", closest(point, [*self.points, CENTER]), path)
        return self.points[point]

    def _center(self) -> Vector:
        if self.center is not None:
            return self.center
        size = self._dimension()
        if not self.shapes:
            return (0.0,) * size
        weighed = self.mass is not None or self.weight is not None
        return tuple(self.mass_properties(1.0 if weighed else None).center[:size].tolist())

    def _dimension(self) -> int:
        for place in self.points.values():
            if not isinstance(place, Offset) or place.at:
                return len(place.at if isinstance(place, Offset) else place)
        return 2
