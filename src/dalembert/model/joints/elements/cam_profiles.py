"""Profiles of cams: the lift by segments, an eccentric disc, arcs, a tangent cam, or points."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Self

from pydantic import Field, ValidationInfo, model_validator

from dalembert.errors import ModelError
from dalembert.model.drives.programmes import Programme, segment_tree
from dalembert.model.drives.written_programmes import programme, programme_schema
from dalembert.model.part import Part, ReadingRules, mapping, reading
from dalembert.model.quantities.figures import FILE_UNITS
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    JsonSchema,
    Scalar,
    ValueField,
    at_item,
    check_sign,
    list_schema,
    numbers,
    object_schema,
    value_text,
)
from dalembert.wording import quote_value

Length = Annotated[float, Scalar("length", "positive")]
FORMS = ("segments", "eccentric", "arcs", "tangent", "points")
RISE = "segments: [{to: 25 mm, in: 90 deg, by: cycloidal}, ..., {dwell: rest}]"
SAME = 1e-9
"""Part of a size by which two values may differ and be equal."""


@dataclass(frozen=True)
class CamLift:
    """The lift over a turn, 0 at its start, of one sign: a length, or an ``angle`` of a follower that swings."""

    programme: Programme
    kind: str

    @property
    def sign(self) -> float:
        """1 where the follower lifts in the sense of its freedom, else -1."""
        return 1.0 if sum(self.targets) >= 0 else -1.0

    @property
    def targets(self) -> list[float]:
        """Lifts at the ends of the segments."""
        return [s.to for s in self.programme.segments if not math.isnan(s.to)]


class Segments(ValueField):
    """Segments of the lift over a turn of the cam."""

    def read(self, value: object, info: ValidationInfo) -> CamLift:
        if isinstance(value, CamLift):
            return value
        rules = reading(info)
        kind = _lift_kind(value, rules)
        try:
            made = programme({"segments": value, "over": "cam", "periodic": False}, kind, rules)
        except ModelError as error:
            if error.path[:1] == ("segments",):
                error.path = error.path[1:]
            raise
        lift = CamLift(made, kind)
        _check_lift(lift)
        return lift

    def write(self, value: CamLift) -> object:
        segments = [segment_tree(s, value.kind, "angle") for s in value.programme.segments]
        unit = units.angle if (units := FILE_UNITS.get()) and value.kind == "angle" else ""
        for s in segments if unit else ():
            if isinstance(s.get("to"), (int, float)):  # bare it would be read as a length
                s["to"] = f"{s['to']} {unit}"
        return segments

    def json_schema(self) -> JsonSchema:
        properties: Any = programme_schema()["properties"]
        return dict(properties["segments"]) | {"description": "of the lift over a turn, in their order"}


def _lift_kind(value: object, rules: ReadingRules) -> str:
    """length, or angle where the first lift has the unit of one."""
    listed = value if isinstance(value, Sequence) and not isinstance(value, str) else []
    texts = [s["to"] for s in listed if isinstance(s, Mapping) and isinstance(s.get("to"), str)]
    for text in texts[:1]:
        try:
            rules.quantity(text, "length")
        except ModelError:
            return "angle"
    return "length"


def _check_lift(lift: CamLift) -> None:
    """Refuse a lift that does not fill a turn, does not return, or has two signs."""
    curve = lift.programme.curve
    if abs(curve.duration - 2 * math.pi) > SAME:
        raise ModelError(
            f"the segments fill {math.degrees(curve.duration):.6g} deg",
            "add {dwell: rest}" if curve.duration < 2 * math.pi else "shorten them to a turn of 360 deg",
        )
    targets = lift.targets
    if targets and abs(targets[-1]) > SAME * max(map(abs, targets)):
        last = f"{value_text(targets[-1], lift.kind)}"
        raise ModelError(f"the lift ends at {last}", "let it return: end with {to: 0, in: ..., by: ...}")
    if targets and min(targets) < 0 < max(targets):
        raise ModelError(
            "the lift goes both above and below 0, where the follower is on the base circle",
            "count it from its lowest place",
        )
    first, last = curve.pieces[0].start()[1], curve.pieces[-1].end()[1]
    if abs(first - last) > SAME * curve.peaks(1)[0]:
        raise ModelError("the slope of the lift jumps where the turn begins again", "let it end as it begins")


@dataclass(frozen=True)
class CamArc:
    """An arc of a cam: its centre and radius (negative where hollow), and the direction of its end from the axis."""

    center: tuple[float, float]
    radius: float
    to: float


class Arcs(ValueField):
    """Arcs one after the other round the cam, counter-clockwise."""

    EXAMPLE = "arcs: [{center: [0, 0], radius: 30 mm, to: 240 deg}, ...]"

    def read(self, value: object, info: ValidationInfo) -> tuple[CamArc, ...]:
        if isinstance(value, tuple):
            return value
        if isinstance(value, str) or not isinstance(value, Sequence) or len(value) < 2:
            raise ModelError(f"{quote_value(value)} is not two arcs or more", f"write {self.EXAMPLE}")
        rules = reading(info)
        result = tuple(at_item(k, self._arc, item, rules) for k, item in enumerate(value))
        if any(b.to <= a.to for a, b in pairwise(result)):
            raise ModelError("the ends of the arcs do not increase", "sort the arcs counter-clockwise")
        return result

    def _arc(self, value: object, rules: ReadingRules) -> CamArc:
        keys = mapping(value, ["center", "radius", "to"], self.EXAMPLE, ["center", "radius", "to"])
        center = at_item("center", numbers, keys["center"], "length", rules)
        if len(center) != 2:
            raise ModelError(f"{quote_value(keys['center'])} is not a point", "write [x, y]", ("center",))
        radius, to = (
            at_item(k, rules.quantity, keys[k], n) for k, n in (("radius", "length"), ("to", "angle"))
        )
        return CamArc((center[0], center[1]), radius, to)

    def write(self, value: tuple[CamArc, ...]) -> object:
        return [
            {
                "center": [value_text(x, "length") for x in arc.center],
                "radius": value_text(arc.radius, "length"),
                "to": value_text(arc.to, "angle"),
            }
            for arc in value
        ]

    def json_schema(self) -> JsonSchema:
        keys = {
            "center": list_schema(NUMBER_OR_TEXT, 2, 2)
            | {"description": "of the arc, [x, y] in the cam's axes"},
            "radius": NUMBER_OR_TEXT | {"description": "of the arc, a length; negative of a hollow one"},
            "to": NUMBER_OR_TEXT
            | {"description": "direction from the arc's centre at which it ends, an angle"},
        }
        return {"type": "array", "items": object_schema(keys, *keys), "minItems": 2}


class TangentCam(Part):
    """Straight flanks between a base circle and a round nose."""

    base: Length = Field(description="radius of the base circle, a length")
    lift: Length = Field(description="of the follower at the nose, a length")
    half_angle: Annotated[float, Scalar("angle", "positive")] = Field(
        description="of ascent: the turn of the cam from the start of the flank to the nose"
    )

    @property
    def nose_distance(self) -> float:
        """Distance of the nose's centre from the cam's axis, m."""
        return self.lift / (1 - math.cos(self.half_angle))

    @property
    def nose_radius(self) -> float:
        """Radius of the nose, m."""
        return self.base + self.lift - self.nose_distance

    @model_validator(mode="after")
    def _rounded(self) -> Self:
        if not self.half_angle < math.pi / 2:
            raise ModelError("the half angle is not below 90 deg", "write a smaller one", ("half_angle",))
        if self.nose_radius < 0:
            raise ModelError(
                f"the nose would have a radius of {self.nose_radius * 1e3:.6g} mm",
                "make the base circle or the half angle larger, or the lift smaller",
                ("lift",),
            )
        return self


@dataclass(frozen=True)
class CamPoints:
    """Radii of a cam over directions in its axes; ``file``: the file they are from."""

    angle: tuple[float, ...]
    radius: tuple[float, ...]
    file: str = ""


class Points(ValueField):
    """Radii over angles: {angle: [...], radius: [...]}, or {file: cam.csv} with columns of these names."""

    EXAMPLE = "points: {angle: [0, 30, ..., 330], radius: [30 mm, ...]}"

    def read(self, value: object, info: ValidationInfo) -> CamPoints:
        if isinstance(value, CamPoints):
            return value
        rules = reading(info)
        keys = mapping(value, ["angle", "radius", "file"], self.EXAMPLE)
        if "file" in keys:
            result = CamPoints(*at_item("file", _from_file, keys["file"], rules), file=str(keys["file"]))
        else:
            mapping(value, ["angle", "radius"], self.EXAMPLE, ["angle", "radius"])
            angle = at_item("angle", numbers, keys["angle"], "angle", rules)
            result = CamPoints(angle, at_item("radius", numbers, keys["radius"], "length", rules))
        _check_points(result)
        return result

    def write(self, value: CamPoints) -> object:
        if value.file:
            return {"file": value.file}
        return {
            "angle": [value_text(x, "angle") for x in value.angle],
            "radius": [value_text(x, "length") for x in value.radius],
        }

    def json_schema(self) -> JsonSchema:
        keys = {
            "angle": list_schema()
            | {"description": "angles in the cam's axes, ascending over less than a turn"},
            "radius": list_schema() | {"description": "lengths from the cam's axis, one for each angle"},
            "file": {"type": "string", "description": "a CSV file with these columns, or a DXF file"},
        }
        return object_schema(keys)


def _from_file(file: object, rules: ReadingRules) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Angles and radii of a CSV file, or of the closed polyline of a DXF file."""
    from dalembert.model.quantities.column_files import read_quantities

    if str(file).lower().endswith(".dxf"):
        return _from_drawing(os.path.join(rules.folder, str(file)), rules)
    path = os.path.join(rules.folder, str(file))
    columns, _ = read_quantities(path, {"angle": "angle", "radius": "length"}, rules)
    return tuple(columns["angle"]), tuple(columns["radius"])


def _from_drawing(path: str, rules: ReadingRules) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Directions and distances of the corners of the first closed polyline of a DXF file, in the file's unit."""
    import ezdxf

    if not os.path.isfile(path):
        raise ModelError(f"file {path!r} not found", "name the drawing of the cam, relative to this file")
    lines = [e for e in ezdxf.readfile(path).modelspace().query("LWPOLYLINE") if e.closed]
    if not lines:
        raise ModelError(f"{path!r} has no closed polyline", "draw the cam as one, about its axis at (0, 0)")
    corners = [(x, y) for x, y, *_ in lines[0].get_points()]
    value = sorted((math.atan2(y, x) % (2 * math.pi), math.hypot(x, y)) for x, y in corners)
    return tuple(a for a, _ in value), tuple(rules.quantity(r, "length") for _, r in value)


def _check_points(p: CamPoints) -> None:
    if len(p.angle) != len(p.radius) or len(p.angle) < 4:
        what = f"it has {len(p.angle)} angles and {len(p.radius)} radii"
        raise ModelError(what, "give at least 4 of each")
    late = next((k for k in range(1, len(p.angle)) if p.angle[k] <= p.angle[k - 1]), None)
    if late is not None:
        what = f"the angles must increase: item {late + 1} is not greater than item {late}"
        raise ModelError(what, "sort the points", ("angle", late))
    if min(p.radius) <= 0:
        raise ModelError("a radius is not positive", "give the distances from the cam's axis", ("radius",))
    span = p.angle[-1] - p.angle[0]
    if span > 2 * math.pi * (1 + SAME):
        raise ModelError(f"the points span {math.degrees(span):.6g} deg", "give one turn", ("angle",))
    if span > 2 * math.pi * (1 - SAME) and abs(p.radius[-1] - p.radius[0]) > SAME * p.radius[0]:
        raise ModelError(
            "the cam does not close: the radii at both ends of the turn differ",
            "give the last point the radius of the first, or leave it out",
            ("radius",),
        )


class CamProfile(Part):
    """Form of a cam: exactly one of segments, eccentric, arcs, tangent, points."""

    segments: Annotated[CamLift, Segments()] | None = Field(
        None, description="lift of the follower over a turn"
    )
    base: Length | None = Field(None, description="least radius of the cam, beside segments; or prime")
    prime: Length | None = Field(None, description="least radius of the roller's centre, beside segments")
    sense: str = Field(
        "ccw", pattern="^(ccw|cw)$", description="turn of the cam over which the segments follow: ccw or cw"
    )
    start: Annotated[float, Scalar("angle")] = Field(
        0.0, description="turn of the cam at which segments, or the flank of a tangent cam, begin; default 0"
    )
    eccentric: Length | None = Field(None, description="distance of a disc's centre, on the cam's x axis")
    radius: Length | None = Field(None, description="of that disc, a length")
    arcs: Annotated[tuple[CamArc, ...], Arcs()] | None = Field(None, description="arcs with common tangents")
    tangent: TangentCam | None = Field(None, description="straight flanks and a round nose")
    points: Annotated[CamPoints, Points()] | None = Field(
        None, description="radii over angles, or a file of them"
    )

    INSTEAD: ClassVar = {"base": "prime", "prime": "base"}

    @property
    def form(self) -> str:
        """The form that it has."""
        return next(name for name in FORMS if getattr(self, name) is not None)

    @property
    def size(self) -> float:
        """A radius of the cam, m."""
        if self.arcs is not None:
            return max(arc.radius for arc in self.arcs)
        if self.points is not None:
            return max(self.points.radius)
        base = self.tangent.base if self.tangent is not None else self.base or self.prime
        return base or self.radius or 0.0

    @model_validator(mode="after")
    def _one_form(self) -> Self:
        known = [name for name in FORMS if getattr(self, name) is not None]
        if len(known) != 1:
            what = f"it has {' and '.join(known)}" if known else "it has no form"
            raise ModelError(what, f"give one of {', '.join(FORMS)}")
        if self.segments is not None and (self.base is None) == (self.prime is None):
            both = "both base and prime are given" if self.base is not None else "its size is missing"
            raise ModelError(
                both, "give base, the least radius of the cam, or prime, that of the roller's centre"
            )
        if self.segments is None and not (self.base is None and self.prime is None):
            raise ModelError(f"base and prime are for segments, not for {known[0]}", "leave them out")
        if self.start and self.segments is None and self.tangent is None:
            raise ModelError(
                f"start is for segments and tangent, not for {known[0]}", "leave it out", ("start",)
            )
        if (self.eccentric is None) != (self.radius is None):
            raise ModelError("a disc needs eccentric and radius", "write eccentric: 12 mm, radius: 40 mm")
        if self.eccentric is not None and self.radius is not None and self.eccentric >= self.radius:
            raise ModelError("the cam's axis is outside its disc", "make the radius larger", ("radius",))
        return self


class FollowerValue(ValueField):
    """`knife`, `flat`, or `{roller: radius}`."""

    def read(self, value: object, info: ValidationInfo) -> FollowerShape:
        if isinstance(value, FollowerShape):
            return value
        if value in ("knife", "flat"):
            return FollowerShape(str(value))
        if not isinstance(value, Mapping):
            what = f"{quote_value(value)} is not a follower"
            raise ModelError(what, "write knife, flat, or {roller: 10 mm}")
        keys = mapping(value, ["roller"], "{roller: 10 mm}", ["roller"])
        radius = at_item("roller", reading(info).quantity, keys["roller"], "length")
        return FollowerShape("roller", at_item("roller", check_sign, radius, keys["roller"], "positive"))

    def write(self, value: FollowerShape) -> object:
        return {"roller": value_text(value.roller, "length")} if value.kind == "roller" else value.kind

    def json_schema(self) -> JsonSchema:
        return {
            "anyOf": [
                {"enum": ["knife", "flat"]},
                object_schema(
                    {"roller": NUMBER_OR_TEXT | {"description": "radius of the roller, a length"}}, "roller"
                ),
            ]
        }


@dataclass(frozen=True)
class FollowerShape:
    """Follower that touches the cam: a knife edge, a flat face or a roller, with its radius."""

    kind: str
    roller: float = 0.0
