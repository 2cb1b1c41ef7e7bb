"""Drives: each prescribes one freedom of a joint; its effort is unknown unless given."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Literal, Self, cast

from pydantic import Field, FieldSerializationInfo, ValidationInfo, field_serializer, model_validator

from dalembert.errors import ModelError
from dalembert.model.drives.cylinders import FluidCylinder
from dalembert.model.drives.drive_screws import DriveScrew
from dalembert.model.drives.end_stops import Stops, end_stops, stops_schema
from dalembert.model.drives.laws import Law, law_schema
from dalembert.model.drives.laws import law as read_law
from dalembert.model.drives.motors import MotorCurve, motor_curve, motor_schema
from dalembert.model.drives.written_programmes import count
from dalembert.model.part import Part, ReadingRules, mapping, reading
from dalembert.model.quantities.figures import in_units
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    Components,
    JsonSchema,
    Name,
    ValueField,
    Vector,
    at_item,
    check_sign,
    direction_vector,
    list_schema,
    numbers,
    object_schema,
    value_text,
)
from dalembert.model.quantities.varying import Varying, varying, varying_schema, varying_tree
from dalembert.units import NUMBER, quantity

UNKNOWN: Literal["unknown"] = "unknown"
TURN = {"": "angle", "speed": "angular_speed", "acceleration": "angular_acceleration", "effort": "moment"}
SLIDE = {"": "length", "speed": "speed", "acceleration": "acceleration", "effort": "force"}
EXAMPLE = "{from: 0 deg, to: 360 deg, count: 72}"


@dataclass(frozen=True, slots=True)
class Range:
    """Equal steps from `start` to `stop`; a full turn does not repeat its first position.

    >>> Range(0.0, 1.0, 3).stop
    1.0
    """

    start: float
    stop: float
    count: int


Positions = float | tuple[float, ...] | Range | Literal["unknown"]
Rates = float | tuple[float, ...]


class DriveValue(ValueField):
    """A value of a drive: ``what`` it is (speed, acceleration, effort or, empty, a position), how a value of its kind
    is read, and its schema."""

    def __init__(
        self,
        parse: Callable[[object, str, ReadingRules], object],
        schema: Callable[[], JsonSchema],
        what: str = "",
    ) -> None:
        self.parse, self.schema, self.what = parse, schema, what

    def json_schema(self) -> JsonSchema:
        return self.schema()

    def read(self, value: object, info: ValidationInfo) -> object:
        return self.parse(value, kind_of(info.data.get("freedom"), self.what), reading(info))


def _positions(value: object, kind: str, rules: ReadingRules) -> Positions:
    """One value, a list, a range, or unknown."""
    if value == UNKNOWN or isinstance(value, Range):
        return cast(Positions, value)
    if isinstance(value, Mapping):
        return _range(value, kind, rules)
    if isinstance(value, (list, tuple)):
        return numbers(value, kind, rules)
    return rules.quantity(value, kind)


def _positions_schema() -> JsonSchema:
    steps = {
        "from": NUMBER_OR_TEXT | {"description": "first position"},
        "to": NUMBER_OR_TEXT | {"description": "last position; of a full turn not repeated"},
        "count": {"type": "integer", "minimum": 1, "description": "number of positions"},
    }
    return {"anyOf": [NUMBER_OR_TEXT, list_schema(), object_schema(steps, *steps)]}


def _range(value: Mapping[str, object], kind: str, rules: ReadingRules) -> Range:
    known = ["from", "to", "count"]
    mapping(value, known, EXAMPLE, known)
    start, stop = (at_item(key, rules.quantity, value[key], kind) for key in ("from", "to"))
    return Range(start, stop, at_item("count", count, value["count"]))


def _rates(value: object, kind: str, rules: ReadingRules) -> Rates:
    """Speeds or accelerations: one value or a list."""
    return numbers(value, kind, rules) if isinstance(value, (list, tuple)) else rules.quantity(value, kind)


def _rates_schema() -> JsonSchema:
    return {"anyOf": [NUMBER_OR_TEXT, list_schema()]}


def _brake(value: object, kind: str, rules: ReadingRules) -> float:
    """The size of a dry couple or force."""
    return check_sign(rules.quantity(value, kind), value, "not negative")


def _effort(value: object, kind: str, rules: ReadingRules) -> Varying:
    """A known effort, which may change along the motion."""
    if value == UNKNOWN:
        raise ModelError("an effort is unknown unless it is given", "leave it out")
    return varying(value, kind, rules)


def _interval(value: object, kind: str, rules: ReadingRules) -> tuple[float, float]:
    """`[a, b]`."""
    bounds = numbers(value, kind, rules)
    if len(bounds) != 2 or not bounds[0] < bounds[1]:
        raise ModelError("a range is two increasing positions", "write range: [0 deg, 180 deg]")
    return bounds[0], bounds[1]


def kind_of(freedom: str | None, what: str) -> str:
    """The kind of a drive's numbers; `what` is speed, acceleration, effort or, for the position, nothing."""
    return (SLIDE if slides(freedom) else TURN)[what]


def slides(freedom: str | None) -> bool:
    """True if a freedom is a length."""
    return (freedom or "").startswith(("slide", "gap", "slip"))


def implied_freedom(keys: Mapping[str, object]) -> str | None:
    """Slide or turn, if the unit of some value says so."""
    for key, what in (
        ("position", ""),
        ("range", ""),
        ("stops", ""),
        ("speed", "speed"),
        ("acceleration", "acceleration"),
    ):
        value = keys.get(key)
        value = value.get("from") if isinstance(value, Mapping) else value
        first = value[0] if isinstance(value, (list, tuple)) and value else value
        for freedom in ("turn", "slide"):
            if (
                isinstance(first, str)
                and not re.fullmatch(NUMBER, first)
                and _fits(first, kind_of(freedom, what))
            ):
                return freedom
    return None


def _fits(value: str, kind: str) -> bool:
    try:
        quantity(value, kind)
    except ModelError:
        return False
    return True


class Drive(Part):
    """A freedom of a joint that is prescribed: position, speed and acceleration, or a law of motion.

    >>> Drive(position="60 deg", speed="25 rad/s").speed
    25.0
    """

    joint: Name | None = Field(
        None, description="the joint it drives; default the joint with the drive's name"
    )
    freedom: Literal["turn", "slide", "turn1", "turn2", "slide1", "slide2"] | None = Field(
        None, description="which freedom of the joint; needed where it has several"
    )
    position: Annotated[Positions, DriveValue(_positions, _positions_schema)] | None = Field(
        None,
        description="one value, a list, {from, to, count}, or unknown; angles of a turn, lengths of a slide",
    )
    speed: Annotated[Rates, DriveValue(_rates, _rates_schema, "speed")] = Field(
        0.0,
        description="one value or a list; rad/s, deg/s or rpm of a turn, length/time of a slide; default 0",
    )
    acceleration: Annotated[Rates, DriveValue(_rates, _rates_schema, "acceleration")] = Field(
        0.0, description="one value or a list; rad/s^2 of a turn, length/time^2 of a slide; default 0"
    )
    law: Annotated[Law, DriveValue(read_law, law_schema)] | None = Field(
        None, description="a law of motion instead of position, speed and acceleration"
    )
    effort: Annotated[Varying, DriveValue(_effort, varying_schema, "effort")] | None = Field(
        None,
        description="known effort: a moment on a turn, a force on a slide; then a load must be unknown. With a "
        "motor, any further effort on its shaft, e.g. -0.02*O2.speed^2 of a fan: used by simulate",
    )
    motor: Annotated[MotorCurve, DriveValue(motor_curve, motor_schema)] | None = Field(
        None, description="effort as a function of speed, for a drive that `start` releases: used by simulate"
    )
    brake: Annotated[float, DriveValue(_brake, lambda: NUMBER_OR_TEXT, "effort")] = Field(
        0.0, description="dry effort against the motion of its freedom, which holds at rest: used by simulate"
    )
    stops: Annotated[Stops, DriveValue(end_stops, stops_schema)] | None = Field(
        None, description="least and greatest position, where forces move its freedom: used by simulate"
    )
    range: (
        Annotated[tuple[float, float], DriveValue(_interval, lambda: list_schema(NUMBER_OR_TEXT, 2, 2))]
        | None
    ) = Field(None, description="[a, b]: where an unknown position is sought; default one turn")
    axis: Annotated[Vector, Components("number")] | None = Field(
        None, description="in space: the axis of a spherical joint's turn"
    )

    cylinder: FluidCylinder | None = Field(
        None, description="a cylinder between two points, whose distance is the drive's position"
    )

    screw: DriveScrew | None = Field(None, description="a power screw that moves the slide: its torque")
    by: Literal["outside"] | None = Field(
        None,
        description="outside: its effort comes from outside the frame and counts in the shaking moment; left out, the "
        "ground or the link i takes the opposite",
    )

    @property
    def unknown(self) -> bool:
        """True if its position is unknown."""
        return isinstance(self.position, str)

    @property
    def moves(self) -> bool:
        """True if it has a speed, an acceleration or a law."""
        return self.law is not None or any(map(_nonzero, (self.speed, self.acceleration)))

    @property
    def turns(self) -> bool:
        """True if its freedom is an angle."""
        return not slides(self.freedom)

    @model_validator(mode="before")
    @classmethod
    def _freedom_of_units(cls, keys: object) -> object:
        if isinstance(keys, Mapping) and keys.get("freedom") is None:
            return {**keys, "freedom": implied_freedom(keys)}
        return keys

    @model_validator(mode="after")
    def _of_cylinder(self) -> Self:
        """Both pressures of a cylinder are its effort."""
        if self.cylinder is not None:
            self._refuse("a cylinder", "joint", "motor", "brake", "axis")
            known = self.cylinder.known_force
            if known is not None:
                self.__dict__["effort"] = known
        return self

    @model_validator(mode="after")
    def _of_screw(self) -> Self:
        if self.screw is not None:
            self._refuse("a screw", "cylinder")
            if self.freedom is not None and self.turns:
                raise ModelError("a screw moves a slide, and this drive turns", "drive the slide", ("screw",))
            if self.motor is not None:
                lead = f"2 pi over the lead of {self.screw.advance:g} m"
                remedy = (
                    f"give the motor ratio: {2 * math.pi / self.screw.advance:.6g}, {lead}, and an efficiency"
                )
                raise ModelError("a screw and a motor are given", remedy, ("motor",))
        return self

    @model_validator(mode="after")
    def _one_motion(self) -> Self:
        if self.law is not None:
            self._refuse("a law of motion", "position", "speed", "acceleration", "range", "stops")
        elif self.position is None and self.motor is None and self.effort is None:
            what = "its position is missing"
            ways = "position: 60 deg, or {from: ..., to: ..., count: ...}, or a law; effort: 0 if only loads move it"
            raise ModelError(what, f"write {ways}")
        if self.motor is not None:
            self._refuse("a motor", "law", "range")
            if self.motor.geared and self.effort is not None:
                problem = "a motor behind a gear and an effort are given"
                raise ModelError(
                    problem, "write that effort as a load; it may depend on the speed", ("effort",)
                )
            if isinstance(self.effort, (int, float)):
                problem = "a motor and a constant effort are given"
                raise ModelError(
                    problem, "write that effort as a load; a varying effort is allowed here", ("effort",)
                )
        if self.unknown:
            self._refuse("an unknown position", "speed", "acceleration")
            self._check_unknown()
        elif self.range is not None:
            problem = "a range is given and the position is known"
            raise ModelError(problem, f"write position: {EXAMPLE}", ("range",))
        self._check_counts()
        if self.axis is not None:
            at_item("axis", direction_vector, self.axis)
        return self

    def _refuse(self, reason: str, *keys: str) -> None:
        for key in keys:
            if getattr(self, key) != type(self).model_fields[key].default:
                article = "an" if key[0] in "aeiou" else "a"
                raise ModelError(f"{reason} and {article} {key} are given", "leave one of them out", (key,))

    def _check_unknown(self) -> None:
        if self.effort is None:
            what = "its position is unknown and its effort is not given"
            raise ModelError(what, "write effort: 0, or the effort that holds it")
        if self.cylinder is not None and self.cylinder.lengths and self.range is None:
            self.__dict__["range"] = self.cylinder.lengths
        if slides(self.freedom) and self.range is None:
            problem = "its position along a slide is unknown without a range"
            raise ModelError(problem, "write range: [0 mm, 100 mm]")

    def _check_counts(self) -> None:
        counts = self.counts()
        if len(set(counts.values())) > 1:
            text = " and ".join(f"{number} in {key}" for key, number in counts.items())
            what = f"its lists differ in length: {text}"
            raise ModelError(what, "give lists of equal length", (next(iter(counts)),))

    def counts(self) -> dict[str, int]:
        """Key -> number of positions, for those that say one."""
        values = {
            "position": self.position,
            "speed": self.speed,
            "acceleration": self.acceleration,
            "law": self.law,
        }
        return {
            key: len(value) if isinstance(value, tuple) else value.count
            for key, value in values.items()
            if isinstance(value, (tuple, Range, Law)) and not getattr(value, "over", "")
        }

    @field_serializer(
        "position",
        "speed",
        "acceleration",
        "law",
        "effort",
        "motor",
        "brake",
        "stops",
        "range",
        when_used="json",
        return_type=Any,
    )
    def _serialize(self, value: object, info: FieldSerializationInfo) -> object:
        what = "effort" if info.field_name == "brake" else info.field_name if info.field_name in TURN else ""
        with in_units(info.context):
            return _tree(value, kind_of(self.freedom, str(what)))


def _nonzero(rate: Rates) -> bool:
    return any(rate) if isinstance(rate, tuple) else rate != 0


def _tree(value: Any, kind: str) -> object:
    if isinstance(value, tuple):
        return [value_text(number, kind) for number in value]
    if isinstance(value, Range):
        return {
            "from": value_text(value.start, kind),
            "to": value_text(value.stop, kind),
            "count": value.count,
        }
    if isinstance(value, (Law, MotorCurve, Stops)):
        return value.tree(kind)
    return value if value is None or value == UNKNOWN else varying_tree(value, kind)
