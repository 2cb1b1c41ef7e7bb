"""Hydraulic and pneumatic cylinders: a drive of the distance of two points, and the links and joints it is made of.

Mechanics: docs/theory.md 10.11.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, Literal, Self

from pydantic import Field, ValidationInfo, model_validator

from dalembert.errors import ModelError, errors_at
from dalembert.model.links.link import Link
from dalembert.model.part import Part, ReadingRules, reading
from dalembert.model.quantities.spans import TwoEnds
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    JsonSchema,
    Scalar,
    ValueField,
    at_item,
    check_sign,
    list_schema,
    numbers,
    value_text,
)
from dalembert.wording import closest

End = Literal["pin", "fixed", "free"]
COLUMNS = (("pin", "pin"), ("fixed", "free"), ("fixed", "pin"))
"""Ends of barrel and rod for which the critical load is known."""
EXAMPLE = "cylinder: {between: [ground.A, boom.B], bore: 80 mm, rod: 45 mm}"
PARTS = ("barrel", "rod")
"""Links of a cylinder, by the endings of their names."""


class Masses(ValueField):
    """Masses of barrel and rod."""

    def read(self, value: object, info: ValidationInfo) -> tuple[float, ...]:
        found = numbers(value, "mass", reading(info))
        if len(found) != 2:
            raise ModelError(f"{len(found)} masses are given", "write mass: [18 kg, 9 kg], of barrel and rod")
        for k, one in enumerate(found):
            at_item(k, check_sign, one, one, "not negative")
        return found

    def write(self, value: tuple[float, ...]) -> object:
        return [value_text(x, "mass") for x in value]

    def json_schema(self) -> JsonSchema:
        return list_schema(NUMBER_OR_TEXT, 2, 2)


Length = Annotated[float, Scalar("length", "positive")]
Pressure = Annotated[float, Scalar("pressure")]


class FluidCylinder(Part):
    """A cylinder between two points: its bore and rod, the pressures that are known, its stroke and its column.

    >>> round(FluidCylinder(between=("ground.A", "boom.B"), bore="80 mm", rod="45 mm").areas[1] * 1e4, 3)
    34.361
    """

    between: TwoEnds = Field(description="[link.point of the barrel's end, link.point of the rod's end]")
    bore: Length = Field(description="inner diameter of the barrel, a length")
    rod: Length | None = Field(
        None, description="diameter of the rod, a length; without it the other chamber is open to the air"
    )
    cap_pressure: Pressure | None = Field(
        None, description="gauge pressure in the chamber without the rod, if it is known"
    )
    rod_pressure: Pressure | None = Field(
        None, description="gauge pressure in the chamber of the rod, if it is known"
    )
    closed: Length | None = Field(None, description="distance of the points with the rod in, a length")
    stroke: Length | None = Field(None, description="by which it extends, a length")
    efficiency: Annotated[float, Scalar("number", "positive")] = Field(
        1.0, description="force of the rod over that of the pressures where it drives; default 1"
    )
    friction: Annotated[float, Scalar("force", "not negative")] = Field(
        0.0, description="of the seals, a force against the motion; instead of an efficiency"
    )
    barrel: Length | None = Field(None, description="outer diameter of the barrel, for buckling")
    barrel_length: Length | None = Field(
        None, description="part of the column that has the barrel's section; default (closed + stroke)/2"
    )
    mass: Annotated[tuple[float, ...], Masses()] | None = Field(
        None, description="masses of barrel and rod, [18 kg, 9 kg], uniform along them"
    )
    elasticity: Pressure = Field(206e9, description="modulus of elasticity, for buckling; default 206 GPa")
    ends: tuple[End, End] = Field(
        ("pin", "pin"), description="of barrel and rod, for buckling: pin (default), fixed or free"
    )

    @property
    def areas(self) -> tuple[Any, Any]:
        """Areas of the piston on the side of the cap and on that of the rod, m2."""
        cap = self.bore * self.bore * (math.pi / 4)
        return cap, cap if self.rod is None else cap - self.rod * self.rod * (math.pi / 4)

    @property
    def lengths(self) -> tuple[float, float] | None:
        """Least and greatest distance of its points, m; None without a stroke."""
        if self.closed is None or self.stroke is None:
            return None
        return self.closed, self.closed + self.stroke

    @property
    def barrel_part(self) -> float | None:
        """Length of the column that has the barrel's section, m."""
        if self.barrel_length is None and self.closed is not None and self.stroke is not None:
            return (self.closed + self.stroke) / 2
        return self.barrel_length

    @property
    def loses(self) -> bool:
        """True if its seals take a part of the force."""
        return self.efficiency < 1 or self.friction > 0

    @property
    def known_force(self) -> float | None:
        """Force of both pressures, N, where both are given; positive pushes its points apart."""
        if self.cap_pressure is None or self.rod_pressure is None:
            return None
        cap, rod = self.areas
        return float(self.cap_pressure * cap - self.rod_pressure * rod)

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        if self.rod is not None and not self.rod < self.bore:
            what = "the rod is as thick as the bore, or thicker"
            raise ModelError(what, "the bore is the inner diameter of the barrel", ("rod",))
        if self.barrel is not None and not self.barrel > self.bore:
            what = "the barrel is not thicker than its bore"
            raise ModelError(what, "barrel is its outer diameter, bore the inner one", ("barrel",))
        if self.efficiency > 1:
            what = f"an efficiency of {self.efficiency:g} would give power"
            raise ModelError(what, "write one from 0 to 1, such as 0.94", ("efficiency",))
        if self.efficiency < 1 and self.friction:
            what = "an efficiency and a friction are given"
            raise ModelError(what, "leave one of them out", ("friction",))
        if (self.closed is None) != (self.stroke is None):
            missing = "stroke" if self.stroke is None else "closed"
            raise ModelError(f"{missing} is missing", "give closed and stroke together, or neither")
        if self.closed is not None and self.stroke is not None and self.stroke >= self.closed:
            what = "its stroke is as long as the closed cylinder, or longer"
            raise ModelError(what, "closed is the distance of its ends with the rod in", ("stroke",))
        if self.barrel is not None and self.barrel_part is None:
            remedy = "give closed and stroke, or barrel_length"
            raise ModelError("the length of its barrel is not known, and is needed for its column", remedy)
        if self.mass is not None and self.lengths is None:
            what = "where the masses of barrel and rod are does not follow"
            raise ModelError(what, "give closed and stroke", ("mass",))
        if self.ends not in COLUMNS:
            allowed = ", ".join(f"[{a}, {b}]" for a, b in COLUMNS)
            raise ModelError(
                f"ends: [{', '.join(self.ends)}] is not a case that is known", f"write one of {allowed}"
            )
        return self


class CylinderLink(Link):
    """The barrel or the rod of a cylinder with masses, which follow from the cylinder's."""

    def replaced_by(self, name: str, value: object) -> tuple[str, ...]:
        raise ModelError(
            f"the {name} of a cylinder's link follows from the cylinder",
            "change the mass of the cylinder, or give it none and write the masses of its links",
        )


def with_cylinders(tree: Mapping[str, Any], rules: ReadingRules) -> Mapping[str, Any]:
    """The tree with the two links and three joints of each cylinder; links without masses may be there already."""
    drives = tree.get("drives")
    items = drives.items() if isinstance(drives, Mapping) else ()
    found = {str(name): keys for name, drive in items if (keys := _of(drive)) is not None}
    if not found:
        return tree
    parts = {key: {str(n): x for n, x in (tree.get(key) or {}).items()} for key in ("links", "joints")}
    for name, keys in found.items():
        with errors_at("drives", name, "cylinder"):
            if tree.get("space") == "space" and name in parts["joints"]:
                continue  # written out, as a lifted one is
            if tree.get("space") == "space":
                remedy = (
                    "in space, write its barrel and rod as links, and drive the prismatic joint between them"
                )
                raise ModelError("a cylinder drives plane mechanisms only", remedy)
            if isinstance(c := _read(keys, rules), FluidCylinder):
                _expand(name, c, parts["links"], parts["joints"], rules)
    return {**tree, **parts}


def _read(keys: object, rules: ReadingRules) -> FluidCylinder | None:
    """The cylinder; None if its keys are wrong, which the drive's reader reports."""
    try:
        return keys if isinstance(keys, FluidCylinder) else FluidCylinder.model_validate(keys, context=rules)
    except ModelError:
        return None


def _of(drive: object) -> object:
    return drive.get("cylinder") if isinstance(drive, Mapping) else getattr(drive, "cylinder", None)


def _expand(
    name: str, c: FluidCylinder, links: dict[str, Any], joints: dict[str, Any], rules: ReadingRules
) -> None:
    for k, end in enumerate(c.between):
        _check_end(links, *end, k)
    (i, a), (j, b) = c.between
    if i == j:
        what = f"both ends of the cylinder are on {i}, so that its length is fixed"
        raise ModelError(what, "name points of two links", ("between",))
    barrel, rod = (f"{name}_{part}" for part in PARTS)
    made = {
        f"{name}_base": {"type": "pin", "links": [i, barrel], "at": [a, "base"]},
        f"{name}_head": {"type": "pin", "links": [j, rod], "at": [b, "head"]},
        name: {"type": "slider", "links": [barrel, rod], "at": ["base", "head"]},
    }
    for joint, keys in made.items():
        there = joints.setdefault(joint, keys)
        between = there.get("links") if isinstance(there, Mapping) else there.links
        if list(between or ()) != keys["links"]:
            what = f"joint {joint!r} exists, and the cylinder has one of this name"
            raise ModelError(what, "rename that joint, or the drive")
    for k, (link, point) in enumerate(((barrel, "base"), (rod, "head"))):
        if c.mass is None:
            links.setdefault(link, Link(points={point: (0.0, 0.0)}))
            continue
        new, old = _heavy(c, k, point), links.get(link)
        if isinstance(old, Mapping) and not _alike(new, Link.model_validate(old, context=rules)):
            what = f"link {link!r} exists, and the cylinder gives its rod and barrel their masses"
            raise ModelError(what, "leave out that link, or the masses of the cylinder", ("mass",))
        links[link] = new


def _heavy(c: FluidCylinder, k: int, point: str) -> CylinderLink:
    """The barrel or the rod as a uniform bar from its end on; the rod is as long as the barrel leaves of the greatest
    length."""
    assert c.mass is not None
    whole, barrel = c.lengths, c.barrel_part
    assert whole is not None
    assert barrel is not None
    length = (barrel, whole[1] - barrel)[k]
    return CylinderLink(
        points={point: (0.0, 0.0)},
        mass=c.mass[k],
        center=((1, -1)[k] * length / 2, 0.0),
        inertia=c.mass[k] * length * length / 12,
    )


def _alike(a: Any, b: Any) -> bool:
    pairs = ((a.mass, b.mass), (a.inertia, b.inertia), *zip(a.center or (), b.center or (), strict=False))
    return b.center is not None and all(math.isclose(x or 0.0, y or 0.0, rel_tol=1e-12) for x, y in pairs)


def _check_end(links: Mapping[Any, Any], link: str, point: str, k: int) -> None:
    part = links.get(link)
    if part is None:
        what = f"the cylinder is between points of the link {link!r}, which does not exist"
        raise ModelError(what, closest(link, list(links)), ("between", k))
    points = part.get("points", {}) if isinstance(part, Mapping) else part.points
    if point not in {str(p) for p in points}:
        what = f"link {link!r} has no point {point!r}"
        raise ModelError(what, closest(point, [str(p) for p in points]), ("between", k))
