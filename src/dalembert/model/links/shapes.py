"""Mass, centre and inertia of a link from what it looks like: boxes, cylinders, tubes, spheres, bars and meshes."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Annotated, Any, Literal, NamedTuple, Self

import numpy as np
from pydantic import Field, ValidationInfo, model_validator

from dalembert.arrays import Array, Numeric
from dalembert.errors import ModelError
from dalembert.model.joints.space_joints import Frame, Frames, Matrix, frames
from dalembert.model.links.stl_solids import MeshFile, MeshFileValue, MeshUnit, mesh_solid
from dalembert.model.part import Part, reading
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    Components,
    JsonSchema,
    Scalar,
    TwoNames,
    ValueField,
    Vector,
    at_item,
    check_sign,
    list_schema,
    numbers,
    value_text,
)

Points = Callable[[str], Vector]


class Solid(NamedTuple):
    """Volume, centre (3,) and inertia (3, 3) about it at a density of 1, in link axes."""

    volume: Numeric
    center: Array
    inertia: Array


class MassProperties(NamedTuple):
    """Mass, centre (3,) and inertia (3, 3) about it, in link axes."""

    mass: Numeric
    center: Array
    inertia: Array


class Lengths(ValueField):
    """Some positive lengths."""

    def __init__(self, count: int, example: str) -> None:
        self.count, self.example = count, example

    def read(self, value: Any, info: ValidationInfo) -> Vector:
        lengths = numbers(value, "length", reading(info))
        if len(lengths) != self.count:
            raise ModelError(
                f"a list of {len(lengths)} is given; {self.count} values are needed", self.example
            )
        return tuple(at_item(i, check_sign, x, value[i], "positive") for i, x in enumerate(lengths))

    def write(self, value: Vector) -> object:
        return [value_text(x, "length") for x in value]

    def json_schema(self) -> JsonSchema:
        return list_schema(NUMBER_OR_TEXT, self.count, self.count)


_LINK_AXES: Matrix = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))

Length = Annotated[float, Scalar("length", "positive")]


class ShapePart(Part):
    """Common keys of all shapes."""

    density: Annotated[float, Scalar("density", "positive")] | None = Field(
        None, description="mass per volume; or give the link's mass or weight"
    )

    def solid(self, points: Points) -> Solid:
        """Volume, centre and inertia, with the link's points by name."""
        raise NotImplementedError


class CentredShape(ShapePart):
    """A shape with a middle."""

    center: Annotated[Vector, Components("length")] | None = Field(
        None, description="its middle in link axes, lengths; default the link's origin"
    )

    def middle(self) -> Array:
        """Its middle (3,)."""
        return in_three(self.center or (0.0, 0.0))


class Box(CentredShape):
    """A box.

    >>> Box(size=(1, 2, 3)).solid(lambda name: (0.0, 0.0)).inertia.diagonal().tolist()
    [6.5, 5.0, 2.5]
    """

    type: Literal["box"] = "box"
    size: Annotated[Vector, Lengths(3, "write size: [along x, along y, along z]")] = Field(
        description="[along x, along y, along z]: lengths"
    )
    axes: Frame | None = Field(None, description="in space: directions of its x and z in link axes")

    @property
    def own_axes(self) -> Matrix:
        """Its x, y and z in link axes."""
        return frames(Frames(i=self.axes, j=self.axes), None, "z")[0] if self.axes else _LINK_AXES

    def solid(self, points: Points) -> Solid:
        """V = abc, I about x = V (b^2 + c^2) / 12."""
        a, b, c = (x * x for x in self.size)
        volume = self.size[0] * self.size[1] * self.size[2]
        inertia = volume / 12 * np.diag([b + c, a + c, a + b])
        if self.axes is not None:
            axes = np.array(self.own_axes)
            inertia = axes.T @ inertia @ axes
        return Solid(volume, self.middle(), inertia)


class Sphere(CentredShape):
    """A ball: I = 2/5 V r^2.

    >>> round(Sphere(radius=1, density=3).solid(lambda name: (0.0, 0.0)).volume, 6)
    4.18879
    """

    type: Literal["sphere"] = "sphere"
    radius: Length = Field(description="a length")

    def solid(self, points: Points) -> Solid:
        """V = 4/3 pi r^3, I = 2/5 V r^2."""
        volume = 4 / 3 * math.pi * self.radius**3
        return Solid(volume, self.middle(), 0.4 * volume * self.radius**2 * np.eye(3))


class Long(CentredShape):
    """A shape along an axis: by its length, axis and middle, or between two points of the link."""

    length: Length | None = Field(None, description="along its axis; or between")
    axis: Annotated[Vector, Components("number")] | None = Field(
        None, description="direction in link axes; default across the plane, in space z"
    )
    between: TwoNames | None = Field(None, description="two points of the link that it runs between")

    @model_validator(mode="after")
    def _one_place(self) -> Self:
        if (self.length is None) == (self.between is None):
            raise ModelError("its length is not clear", "give either length, or between: [A, B]")
        if self.between is not None:
            for key in ("axis", "center"):
                if getattr(self, key) is not None:
                    raise ModelError(f"both between and {key} are given", "leave one of them out", (key,))
        if self.axis is not None and not any(self.axis):
            raise ModelError("axis has no direction", "write one of its components other than 0", ("axis",))
        return self

    def line(self, points: Points) -> tuple[Numeric, Array, Array]:
        """Length, middle and unit vector of the axis."""
        if self.between is None:
            axis = in_three(self.axis or (0.0, 0.0, 1.0))
            return self.length, self.middle(), axis / (axis @ axis) ** 0.5
        a, b = (in_three(at_item("between", points, name)) for name in self.between)
        length = ((b - a) @ (b - a)) ** 0.5
        if not length:
            first, second = self.between
            what = f"points {first!r} and {second!r} are in one place"
            raise ModelError(what, "name two that are apart", ("between",))
        return length, (a + b) / 2, (b - a) / length

    def round(self, points: Points, area: Numeric, squares: Numeric) -> Solid:
        """Solid of an area revolved about the axis, ``squares`` the sum of the squares of its radii: I = V squares / 2
        about the axis, V (3 squares + l^2) / 12 across it."""
        length, middle, axis = self.line(points)
        volume = area * length
        along, across = volume * squares / 2, volume * (3 * squares + length**2) / 12
        return Solid(volume, middle, across * np.eye(3) + (along - across) * np.outer(axis, axis))


class Cylinder(Long):
    """A full cylinder.

    >>> Cylinder(radius=1, length=2, density=3).solid(lambda name: (0.0, 0.0)).volume / math.pi
    2.0
    """

    type: Literal["cylinder"] = "cylinder"
    radius: Length = Field(description="a length")

    def solid(self, points: Points) -> Solid:
        """V = pi r^2 l, I = V r^2 / 2 about the axis, V (3 r^2 + l^2) / 12 across it."""
        return self.round(points, math.pi * self.radius**2, self.radius**2)


class Tube(Long):
    """A hollow cylinder.

    >>> round(Tube(radii=(1, 2), length=3, density=1).solid(lambda name: (0.0, 0.0)).volume, 6)
    28.274334
    """

    type: Literal["tube"] = "tube"
    radii: Annotated[Vector, Lengths(2, "write radii: [inner, outer]")] = Field(
        description="[inner, outer]: lengths"
    )

    def solid(self, points: Points) -> Solid:
        """V = pi (R^2 - r^2) l, I = V (R^2 + r^2) / 2 about the axis, V (3 (R^2 + r^2) + l^2) / 12 across it."""
        inner, outer = self.radii
        return self.round(points, math.pi * (outer**2 - inner**2), outer**2 + inner**2)

    @model_validator(mode="after")
    def _hollow(self) -> Self:
        if self.radii[0] >= self.radii[1]:
            raise ModelError(
                "the inner radius is not smaller than the outer", "write radii: [inner, outer]", ("radii",)
            )
        return self


class SlenderBar(Long):
    """A slender bar: no inertia about its axis, m l^2 / 12 across it.

    >>> SlenderBar(between=("A", "B"), area="1 cm^2", density=7850).area
    0.0001
    """

    type: Literal["bar"] = "bar"
    area: Annotated[float, Scalar("area", "positive")] | None = Field(
        None, description="of its section, length^2; not needed with the link's mass or weight"
    )

    def solid(self, points: Points) -> Solid:
        """V = A l, I = V l^2 / 12; per unit of section where the area is not given."""
        return self.round(points, 1.0 if self.area is None else self.area, 0.0)


class StlMesh(ShapePart):
    """A solid within a closed surface of triangles, from an STL file (needs the package trimesh).

    >>> from dalembert.errors import ModelError
    >>> try:
    ...     StlMesh(file="no.stl")
    ... except ModelError as error:
    ...     print(str(error).split(";")[0])
    file 'no.stl' does not exist
    """

    type: Literal["mesh"] = "mesh"
    file: Annotated[MeshFile, MeshFileValue()] = Field(
        description="an .stl file in link axes; its path is relative to the model file"
    )
    unit: Annotated[float | None, MeshUnit()] = Field(
        None,
        validate_default=True,
        description="length of 1 in the STL file, such as mm; default the file's unit of length",
    )

    def solid(self, points: Points) -> Solid:
        """Integrals over the volume within the surface."""
        volume, center, inertia = mesh_solid(self.file)
        s = self.unit or 1.0
        return Solid(volume * s**3, center * s, inertia * s**5)

    @model_validator(mode="after")
    def _close(self) -> Self:
        at_item("file", mesh_solid, self.file)
        return self


Shape = Annotated[
    Box | Cylinder | Tube | Sphere | SlenderBar | StlMesh, Field(discriminator="type", description="a shape")
]


def in_three(vector: Vector) -> Array:
    """A planar or spatial vector as three components."""
    return np.array([*vector, 0.0][:3])


def check_densities(shapes: tuple[ShapePart, ...], weighed: bool) -> None:
    """Raise where the mass of shapes is given twice or not at all."""
    if not shapes:
        raise ModelError("the list of shapes is empty", "leave it out", ("shape",))
    for k, shape in enumerate(shapes):
        path: tuple[str | int, ...] = ("shape", k) if len(shapes) > 1 else ("shape",)
        if weighed and shape.density is not None:
            what = "both the link's mass and a density are given"
            raise ModelError(what, "leave one of them out", (*path, "density"))
        if not weighed and shape.density is None:
            problem = "a shape has no density and the link no mass"
            raise ModelError(problem, "give one of them: density: 7850 kg/m^3", path)
        thin = isinstance(shape, SlenderBar) and shape.area is None
        if thin and (not weighed or len(shapes) > 1):
            raise ModelError("a bar needs the area of its section here", "give it: area: 2 cm^2", path)


def finite(properties: Callable[[Numeric], MassProperties], mass: Numeric) -> bool:
    """True if a mass, its centre and its inertia are finite numbers."""
    try:
        with np.errstate(all="ignore"):
            total, center, inertia = properties(mass)
    except (OverflowError, ZeroDivisionError):
        return False
    return all(map(math.isfinite, (total, *center, *inertia.flat)))


def mass_properties(shapes: tuple[ShapePart, ...], points: Points, mass: Numeric = None) -> MassProperties:
    """Combined mass properties of shapes (parallel axes); of uniform density where the total mass is given."""
    solids = [
        at_item("shape", shape.solid, points)
        if len(shapes) == 1
        else at_item("shape", at_item, k, shape.solid, points)
        for k, shape in enumerate(shapes)
    ]
    common = None if mass is None else mass / sum(solid.volume for solid in solids)
    masses = [
        solid.volume * (shape.density if common is None else common)
        for solid, shape in zip(solids, shapes, strict=True)
    ]
    total = sum(masses)
    if mass is not None and not mass:  # without mass the centre is that of the volume
        masses, total = [solid.volume for solid in solids], sum(solid.volume for solid in solids)
    center = sum(m * solid.center for m, solid in zip(masses, solids, strict=True)) / total
    inertia: Array = np.zeros((3, 3))
    for m, solid in zip(masses, solids, strict=True):
        r = solid.center - center
        inertia = inertia + m / solid.volume * solid.inertia + m * ((r @ r) * np.eye(3) - np.outer(r, r))
    if mass is not None and not mass:
        return MassProperties(0.0, center, 0.0 * inertia)
    return MassProperties(total, center, inertia)
