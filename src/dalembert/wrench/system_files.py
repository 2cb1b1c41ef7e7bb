"""Force systems in files: YAML, JSON and TOML, with the units, vectors and messages of model files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal, Self

from pydantic import Field, ValidationInfo, model_validator

from dalembert.errors import ModelError
from dalembert.model.description import file_rules
from dalembert.model.drives.driven_freedoms import refuse_empty
from dalembert.model.files.model_files import FilePath, read_file, read_text
from dalembert.model.files.source import FileSource
from dalembert.model.load_types import LoadPoint
from dalembert.model.part import Part, reading
from dalembert.model.quantities.units_and_parameters import UnitsValue
from dalembert.model.quantities.values import (
    Components,
    JsonSchema,
    Name,
    Scalar,
    ValueField,
    Vector,
    numbers,
    vector,
)
from dalembert.units import Units, quantity
from dalembert.wording import closest, quote_value
from dalembert.wrench.forces import Couple, Force
from dalembert.wrench.reading import cosines
from dalembert.wrench.reading import direction as unit_along
from dalembert.wrench.system import System


class VectorForm(ValueField):
    """A vector of any length, in the plane also an angle."""

    def read(self, value: object, info: ValidationInfo) -> Vector:
        rules = reading(info)
        if isinstance(value, (list, tuple)):
            return tuple(unit_along(vector(value, "number", rules)))
        if rules.dimension == 3:
            raise ModelError(
                f"{quote_value(value)} is not a direction in space", "write [x, y, z], or angles: [a, b, c]"
            )
        return tuple(unit_along(quantity(value, "angle", rules.units)))

    def json_schema(self) -> JsonSchema:
        return {"type": ["number", "string", "array"]}


class ToAxes(ValueField):
    """Angles to the x, y and z axes, as direction cosines."""

    def read(self, value: object, info: ValidationInfo) -> Vector:
        return tuple(cosines(numbers(value, "angle", reading(info))))

    def json_schema(self) -> JsonSchema:
        return {"type": "array", "minItems": 3, "maxItems": 3}


class Moment(ValueField):
    """A number in the plane, a vector in space."""

    def read(self, value: object, info: ValidationInfo) -> Vector:
        rules = reading(info)
        if rules.dimension == 3:
            return vector(value, "moment", rules)
        return (quantity(value, "moment", rules.units),)

    def json_schema(self) -> JsonSchema:
        return {"type": ["number", "string", "array"]}


class GivenForce(Part):
    """A force of a file: its components or polar text, or a size with a direction, angles, or two points."""

    value: Annotated[Vector, Components("force")] | None = None
    size: Annotated[float, Scalar("force")] | None = None
    direction: Annotated[Vector, VectorForm()] | None = None
    angles: Annotated[Vector, ToAxes()] | None = None
    start: Annotated[str | Vector, LoadPoint()] | None = Field(None, alias="from")
    end: Annotated[str | Vector, LoadPoint()] | None = Field(None, alias="to")
    at: Annotated[str | Vector, LoadPoint()] | None = None

    @model_validator(mode="after")
    def _one_direction(self) -> Self:
        forms = {
            "value": self.value,
            "direction": self.direction,
            "angles": self.angles,
            "from and to": None if self.start is None and self.end is None else (self.start, self.end),
        }
        stated = [form for form, description in forms.items() if description is not None]
        if len(stated) != 1:
            description = f"{' and '.join(stated)} are given" if stated else "it has no direction"
            raise ModelError(description, "give one of value, direction, angles (space), from and to")
        if (self.value is None) == (self.size is None):
            raise ModelError(
                "size and value are both given" if self.size is not None else "it has no size",
                "write value: [x, y], or size: with direction, angles, or from and to",
            )
        if stated == ["from and to"] and None in (self.start, self.end):
            raise ModelError("only one of from and to is given", "give both points")
        return self


class GivenSystem(Part):
    """A file of a force system."""

    dalembert: Literal[1] = 1
    title: str = ""
    source: str = ""
    space: Literal["plane", "space"] = "plane"
    units: Annotated[Units, UnitsValue()] = Units()
    points: dict[Name, Annotated[Vector, Components("length")]] = Field(default_factory=dict)
    forces: dict[Name, GivenForce] = Field(default_factory=dict)
    couples: dict[Name, Annotated[Vector, Moment()]] = Field(default_factory=dict)

    def place(self, at: str | Vector, path: tuple[str, ...]) -> Vector:
        """A point by name or by its components."""
        if not isinstance(at, str):
            return at
        if at not in self.points:
            where = f"force {path[1]!r}"
            raise ModelError(f"{where} names the point {at!r}", closest(at, list(self.points)), path)
        return self.points[at]

    def force(self, name: str, stated: GivenForce) -> Force:
        """One of its forces; a force along a line is at the line's first point where no `at` is given."""
        here: Any = stated.at if stated.at is not None else stated.start
        at = (
            None
            if here is None
            else self.place(here, ("forces", name, "at" if stated.at is not None else "from"))
        )
        if stated.value is not None:
            return Force(stated.value, at, name)
        along = stated.direction or stated.angles
        if along is None:
            assert stated.start is not None
            assert stated.end is not None
            start = self.place(stated.start, ("forces", name, "from"))
            end = self.place(stated.end, ("forces", name, "to"))
            along = tuple(b - a for a, b in zip(start, end, strict=True))
        try:
            return Force.directed(stated.size or 0.0, along, at, name)
        except ModelError as error:
            raise ModelError(f"force {name!r}: {error.what}", error.remedy, ("forces", name)) from None

    def system(self) -> System:
        """The system described by the file."""
        forces = [self.force(name, stated) for name, stated in self.forces.items()]
        couples = [Couple(list(value), name) for name, value in self.couples.items()]
        about = {"title": self.title, "source": self.source}
        return System(*forces, *couples, units=self.units, points=self.points, **about)


def load(path: FilePath, values: Mapping[str, object] | None = None) -> System:
    """The force system of a .yaml, .json or .toml file; raises ModelError with file and line.

    ``values`` replaces values of the file by their paths, written as in it: ``{"forces.F.value": "800 @ 60"}``.

    Keys: `title, source, space, units, points, forces, couples`. A force has `value` (components or polar text), or
    `size` with `direction` (an angle or a vector), `angles` to the axes, or `from` and `to`; and `at`, a point's name
    or its place.
    """
    tree, source = read_file(path)
    for name, value in (values or {}).items():
        tree = _replaced(tree, name.split("."), value, name)
    return _system(tree, source)


def _replaced(tree: Any, keys: Sequence[str], value: object, name: str) -> Any:
    """A tree with the value at a path that exists."""
    if not keys:
        return value
    branches = (
        dict(tree) if isinstance(tree, Mapping) else dict(enumerate(tree)) if isinstance(tree, list) else {}
    )
    key = next((k for k in branches if str(k) == keys[0]), None)
    if key is None:
        raise ModelError(f"the file has no {name!r}", closest(keys[0], [str(k) for k in branches]))
    branches[key] = _replaced(branches[key], keys[1:], value, name)
    return branches if isinstance(tree, Mapping) else list(branches.values())


def loads(text: str, form: str = "yaml", name: str = "text") -> System:
    """The force system of a text; messages name `name` as the file.

    >>> s = loads("{units: {length: mm}, points: {A: [200, 0]}, forces: {F: {value: 600 @ 90, at: A}}}")
    >>> s["F"].at, s.moment([0, 0])
    (array([0.2, 0. ]), 120.0)
    """
    return _system(*read_text(text, form, name))


def _system(tree: object, source: FileSource) -> System:
    try:
        if not isinstance(tree, Mapping):
            raise ModelError(f"{quote_value(tree)} is not a mapping", "write forces: ...")
        refuse_empty(tree)
        if "links" in tree:
            raise ModelError(
                "this is the model file of a mechanism", "use dalembert solve, or da.load", ("links",)
            )
        return GivenSystem.model_validate(tree, context=file_rules(tree)).system()
    except ModelError as error:
        raise error.at_source(source) from None
