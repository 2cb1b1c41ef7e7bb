"""The description of a mechanism: what the user, the file and the web page write, frozen."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self

from pydantic import Field, PrivateAttr, ValidationInfo, field_validator, model_validator

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model.assembly import Pose, PoseValue
from dalembert.model.drives.cylinders import with_cylinders
from dalembert.model.drives.driven_freedoms import drive_freedoms, refuse_empty, with_freedoms
from dalembert.model.drives.drives import Drive
from dalembert.model.drives.schedule import AtPositions, Schedule, schedule
from dalembert.model.drives.starting import Start, StartValue, drives_at_start
from dalembert.model.drives.turning import TurningPlane
from dalembert.model.files.copies.likeness import Likeness
from dalembert.model.files.messages import of_originals, together
from dalembert.model.files.source import FileSource
from dalembert.model.gravity import STANDARD, Gravity, GravityValue
from dalembert.model.joints.elements.written_parts import WrittenParts
from dalembert.model.joints.friction_keys import FrictionDefaults
from dalembert.model.joints.plane_joints import Joint
from dalembert.model.links.link import CENTER, GROUND, Link
from dalembert.model.links.shapes import MassProperties
from dalembert.model.load_types import Load
from dalembert.model.part import ReadingRules, reading
from dalembert.model.paths import (
    ancestors,
    as_in_file,
    fields,
    latest,
    parameter_name,
    replace_value,
    unused_parameters,
    used_parameters,
    with_dependents,
)
from dalembert.model.quantities.dependent_numbers import with_new
from dalembert.model.quantities.parameters import Parameter, change_parameters, read_parameters
from dalembert.model.quantities.units_and_parameters import ParametersValue, UnitsValue
from dalembert.model.quantities.values import Name, Scalar, Vector, at_item
from dalembert.model.stated_answers import StatedAnswer
from dalembert.units import Units, file_units
from dalembert.wording import quote_value

if TYPE_CHECKING:
    from dalembert.views.paper.scene import Scene


class Mechanism(WrittenParts):
    """Links, joints, drives and loads, in SI and radians; analyses do not change it.

    In Python bare numbers are SI and radians, texts carry their unit; `load` applies the rules of a file.

    >>> from dalembert.model import Drive, Link, Pin
    >>> mechanism = Mechanism(
    ...     links={"ground": Link(points={"O": (0, 0)}), "arm": Link(points={"O": (0, 0)}, mass=2, center=(1, 0))},
    ...     joints={"O": Pin(links=("ground", "arm"))},
    ...     drives={"O": Drive(position="30 deg")},
    ...     gravity="standard",
    ... )
    >>> mechanism.mass("arm")
    2.0
    """

    dalembert: Literal[1] = Field(1, description="version of this format")
    title: str = Field("", description="what the mechanism is")
    source_text: str = Field("", alias="source", description="where the problem comes from")
    space: Literal["plane", "space"] = Field("plane", description="plane (default) or space")
    units: Annotated[Units, UnitsValue()] = Field(
        Units(), description="units of bare numbers; those left out are SI, angles degrees"
    )
    gravity: Annotated[Gravity, GravityValue()] = Field(
        None, description="none (default), standard (9.80665 m/s^2 down), or a vector of accelerations"
    )
    g_override: Annotated[float, Scalar("acceleration", "positive")] | None = Field(
        None,
        alias="g",
        description="acceleration by which weights are divided; default gravity's, or 9.80665 m/s^2",
    )
    parameters: Annotated[Mapping[str, Parameter], ParametersValue()] = Field(
        default_factory=dict,
        description="named quantities; they may depend on one another, and any quantity may be an expression of them",
    )
    links: dict[Name, Link] = Field(description="the rigid bodies; ground is the fixed one")
    joints: dict[Name, Joint] = Field(default_factory=dict, description="how they are connected")
    drives: dict[Name, Drive] = Field(default_factory=dict, description="what is prescribed")
    loads: dict[Name, Load] = Field(default_factory=dict, description="forces, couples, springs, dampers")
    turning: TurningPlane | None = Field(None, description="the plane turns about a line in it: governors")
    friction: FrictionDefaults = Field(FrictionDefaults(), description="defaults of the joints' friction")
    assembly: dict[Name, Annotated[Pose, PoseValue()]] = Field(
        default_factory=dict,
        description="approximate angle, or [x, y, angle], of links: chooses the assembly mode",
    )
    start: Annotated[Mapping[str, Start], StartValue()] = Field(
        default_factory=dict,
        description="position and speed at time 0 of the drives that forces move: used by simulate",
    )
    answers: tuple[StatedAnswer, ...] = Field((), description="published answers, compared by `check`")
    _source: FileSource | None = PrivateAttr(None)
    _changes: Mapping[str, object] = PrivateAttr({})
    _likenesses: tuple[Likeness, ...] = PrivateAttr(())

    @classmethod
    def _rules(cls, keys: Mapping[str, object]) -> ReadingRules:
        return _reading(keys, None)

    @classmethod
    def model_validate(cls, obj: object, *, context: object = None, **options: object) -> Self:
        """The mechanism that a tree describes, by the file's rules; raises ModelError."""
        if context is None and isinstance(obj, Mapping):
            context = file_rules(obj)
        return super().model_validate(obj, context=context, **options)

    @field_validator("dalembert", mode="before")
    @classmethod
    def _version(cls, value: object) -> object:
        if value != 1 or isinstance(value, bool):
            raise ModelError(
                f"unknown format version {quote_value(value)}",
                "write dalembert: 1",
            )
        return value

    @model_validator(mode="before")
    @classmethod
    def _freedoms(cls, keys: object, info: ValidationInfo) -> object:
        if not isinstance(keys, Mapping):
            return keys
        keys = {key: value for key, value in keys.items() if value is not None}
        return with_freedoms(with_cylinders(keys, reading(info)))

    @model_validator(mode="after")
    def _names(self) -> Self:
        from dalembert.model.plane_checks import problems

        errors = problems(self)
        if errors:
            raise together(errors)
        return self

    def __eq__(self, other: object) -> bool:
        """True if the descriptions are equal, whatever their sources."""
        if not isinstance(other, Mechanism):
            return NotImplemented
        return all(getattr(self, name) == getattr(other, name) for name in type(self).model_fields)

    __hash__ = None  # type: ignore[assignment]

    def __str__(self) -> str:
        """The text of its model file, as `save` writes it."""
        from dalembert.model.files.rewriting import text_of

        return text_of(self.written, "yaml")

    def __repr__(self) -> str:
        links = len({*self.links} - {GROUND})
        drives = f"driven by {', '.join(self.drives)}" if self.drives else "no drive"
        return f"<Mechanism {self.title!r}: {links} moving links, {len(self.joints)} joints, {drives}>"

    def _ipython_display_(self) -> None:
        from dalembert.pages.widget import show_live

        show_live(self)

    def _repr_html_(self) -> str:
        from dalembert.notebook.html_views import mechanism_html

        return mechanism_html(self)

    def draw(self, positions: AtPositions = None) -> Scene:
        """The mechanism at its first position, with the paths of its points; ``da.draw`` has the other drawings."""
        from dalembert.notebook.html_views import first_pose

        return first_pose(self, positions)

    @property
    def source(self) -> FileSource | None:
        """The file it came from, which knows the line of each path."""
        return self._source

    @property
    def dimension(self) -> int:
        """Components of a vector: 2 in the plane, 3 in space."""
        return 2 if self.space == "plane" else 3

    @property
    def gravity_vector(self) -> Vector:
        """Acceleration of gravity in ground axes, m/s2."""
        if self.gravity == "standard":
            return (*(0.0,) * (self.dimension - 1), -STANDARD)
        return self.gravity if isinstance(self.gravity, tuple) else (0.0,) * self.dimension

    @property
    def g(self) -> float:
        """The acceleration by which weights are divided, m/s2."""
        return self.g_override or math.hypot(*self.gravity_vector) or STANDARD

    def point(self, link: str, point: str) -> Vector:
        """A point in link axes, metres; `center` is the mass centre."""
        return self.center(link) if point == CENTER else self.links[link].point(point)

    def points(self, link: str) -> dict[str, Vector]:
        """All points of a link in its axes, metres."""
        return {point: self.links[link].point(point) for point in self.links[link].points}

    def mass(self, link: str) -> float:
        """Mass of a link, kg: as given, its weight over g, or that of its shape."""
        part = self.links[link]
        if part.weight is None and part.mass is None and part.shapes:
            mass: float = part.mass_properties().mass
            return mass
        return part.weight / self.g if part.weight is not None else part.mass or 0.0

    def center(self, link: str) -> Vector:
        """Mass centre in link axes, metres."""
        part = self.links[link]
        if part.shapes:
            return tuple(self._of_shape(link).center[: self.dimension].tolist())
        return part.center or (0.0,) * self.dimension

    def inertia(self, link: str) -> Any:
        """Moment of inertia about the mass centre, kg m2; in space as given, or the matrix of its shape."""
        part = self.links[link]
        if not part.shapes:
            return part.inertia
        inertia = self._of_shape(link).inertia
        rows = inertia.tolist()
        return rows[2][2] if self.dimension == 2 else tuple(map(tuple, rows))

    def _of_shape(self, link: str) -> MassProperties:
        part = self.links[link]
        weighed = part.mass is not None or part.weight is not None
        return part.mass_properties(self.mass(link) if weighed else None)

    def joint_points(self, joint: str) -> tuple[Vector, Vector]:
        """A joint's points on i and on j, each in its link's axes, metres."""
        part = self.joints[joint]
        first, second = part.point_names(joint)
        return self.point(part.links[0], first), self.point(part.links[1], second)

    def loads_on(self, what: Literal["point", "link", "span", "turn"]) -> dict[str, Any]:
        """Loads that act on a point of a link, a link, the span between two points, or the turn of a joint."""
        return {name: load for name, load in self.loads.items() if what == load.ON}

    def load_points(self, load: str) -> tuple[tuple[str, Vector], tuple[str, Vector]]:
        """Link and point in its axes of both ends of a load along a span."""
        (a, first), (b, second) = self.loads[load].between  # type: ignore[union-attr]
        return (a, self.point(a, first)), (b, self.point(b, second))

    def drive_joint(self, drive: str) -> str:
        """The joint a drive prescribes a freedom of."""
        return self.drives[drive].joint or drive

    def schedule(self, positions: AtPositions = None) -> Schedule:
        """Positions, speeds and accelerations of the drives; `positions`: their number, or the drives' values."""
        return schedule(drives_at_start(self.drives, self.start), positions)

    @property
    def has_speeds(self) -> bool:
        """True if some drive has a speed, an acceleration or a law, so that inertia counts."""
        return any(drive.moves for drive in drives_at_start(self.drives, self.start).values())

    def with_values(self, values: Mapping[str, object]) -> Mechanism:
        """Another mechanism with some values replaced, each named by its path.

        Numbers are SI and radians; texts are read as in the file: `"3 @ 30"`, `"[1 in, 20]"`, `"60"` in its
        units. A parameter is named by its name, and every value that depends on it is computed again. A value that
        depends on parameters becomes a plain number once it is replaced by its path; a parameter that is no longer used
        is left out. Raises ModelError for a path that does not exist.
        """
        if self.written is not self:
            return self.written.with_values(values)
        new_values = {path: as_in_file(value, path) for path, value in values.items()}
        known = self.parameters
        named = {
            path: name for path in new_values if known and (name := parameter_name(path, known, self.keys()))
        }
        rules = self._later_rules({name: new_values[path] for path, name in named.items()})
        result = self
        if named:
            new = {name: p.value for name, p in rules.parameters.items()}
            result = with_dependents(self, lambda leaf: with_new(leaf, new), rules)
        for path in (
            path for path in new_values if path not in named
        ):  # in their order: lists' lengths must agree
            result = replace_value(result, path.split("."), new_values[path], rules)
        if known:
            names = {*used_parameters(result, rules.parameters), *unused_parameters(self)}
            kept = ancestors(names, rules.parameters)
            rules = replace(rules, parameters={n: p for n, p in rules.parameters.items() if n in kept})
        changed = Mechanism.model_validate(fields(result), context=rules)
        paths = {
            f"parameters.{named[path]}" if path in named else path: new_values[path] for path in new_values
        }
        changed._source, changed._changes = self._source, latest(self._changes, paths)
        stated = [path.split(".")[1] for path in new_values if path.startswith("assembly.")]
        ends = {name: joint.links for name, joint in self.joints.items()}
        changed._likenesses = tuple(alike.without(stated, ends) for alike in self._likenesses)
        return changed

    @property
    def likenesses(self) -> tuple[Likeness, ...]:
        """Relations of the copies of `copies` to their originals."""
        return self._likenesses

    @property
    def changes(self) -> Mapping[str, object]:
        """Path -> value of what `with_values` has replaced since the mechanism was read."""
        return self._changes

    def _later_rules(self, parameters: Mapping[str, object]) -> ReadingRules:
        """The rules by which values are read that come later, with other values of parameters."""
        freedoms = drive_freedoms({"drives": self.drives, "joints": self.joints})
        source = self._source
        folder, data = (source.folder, source.data) if source else ("", "")
        units, known = self.units.of_texts(), self.parameters
        if parameters:
            known = change_parameters(known, parameters, units, freedoms)
        return ReadingRules(units, freedoms, self.dimension, folder, known, data)

    def to_tree(self) -> Tree:
        """The description as a file's tree, every quantity as text with its SI unit; reads back equal."""
        return self.written.model_dump(mode="json", by_alias=True)

    def save(self, path: str | os.PathLike[str], overwrite: bool = False) -> None:
        """Write it to a .yaml, .json or .toml file; raises ModelError if the file exists and not `overwrite`.

        The text of a file is kept as its author wrote it: only the characters of changed values change. Tables
        whose columns are in a file of the same folder stay in it; in another folder they are written out. Suffixes of
        other programs write their files (docs/formats.md), with a warning for each thing that is not kept.
        """
        from dalembert.model.files.conversion import save

        save(self, path, overwrite)


def file_rules(tree: Mapping[str, object], folder: str = "", data: str = "") -> ReadingRules:
    """Rules of a file: its units, its drives' freedoms, plane or space, and the folders of the file and of its data."""
    return _reading(tree, at_item("units", file_units, tree.get("units", {})), folder, data)


def _reading(
    tree: Mapping[str, object], units: Units | None, folder: str = "", data: str = ""
) -> ReadingRules:
    freedoms, parameters = drive_freedoms(tree), tree.get("parameters") or {}
    drives = dict.fromkeys((str(name) for name, _ in _items(tree.get("drives"))), "turn") | freedoms
    known = read_parameters(parameters, units, drives, Mechanism.keys()) if parameters else {}
    return ReadingRules(units, freedoms, 3 if tree.get("space") == "space" else 2, folder, known, data)


def mechanism(tree: Mapping[str, object], source: FileSource | None = None) -> Mechanism:
    """The mechanism that a file's tree describes, by the file's rules: its units, angles in degrees.

    >>> mechanism({"links": {"ground": {}, "bar": {"mass": 1}}, "units": {"mass": "lbm"}}).mass("bar")
    0.45359237
    """
    if not isinstance(tree, Mapping):
        raise ModelError(
            f"expected a mapping, not {quote_value(tree)}", "write links: and joints: ..."
        ).at_source(source)
    try:
        refuse_empty(tree)
        if "links" not in tree and ("forces" in tree or "couples" in tree):
            raise ModelError(
                "this is a file of forces and couples", "use dalembert wrench, or da.wrench.load"
            )
        folders = (source.folder, source.data) if source else ()
        alike: tuple[Likeness, ...] = ()
        if "copies" in tree:
            tree, source, alike = _with_copies(tree, source, file_rules(tree, *folders))
        result = Mechanism.model_validate(tree, context=file_rules(tree, *folders))
    except ModelError as error:
        raise (of_originals(error, source.copied) if source else error).at_source(source) from None
    result._source, result._likenesses = source, alike
    return result


def _with_copies(
    tree: Mapping[str, object], source: FileSource | None, rules: ReadingRules
) -> tuple[Mapping[str, object], FileSource | None, tuple[Likeness, ...]]:
    """The tree with its copies, and the source that knows which line each is from."""
    from dalembert.model.files.copies.expansion import expand

    expanded, copied, alike = expand(tree, rules)
    return expanded, replace(source, copied=copied) if source else None, alike


def _items(value: object) -> list[tuple[object, object]]:
    return list(value.items()) if isinstance(value, Mapping) else []
