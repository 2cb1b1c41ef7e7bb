"""The catalogue of quantities: one name for each, read from a result or from a compiled analysis alike.

A name is WORD.THING[.RATE][.COMPONENT]: `effort.O2`, `reaction.A.x`, `slide.G.speed`, `point.rod.B.velocity.magnitude`.
Only THING comes from the model. RATE is `speed`, `velocity`, `acceleration`, or `low` and `high`: both ends of what
friction leaves open. COMPONENT is x, y, z, magnitude, in the plane direction; without it a vector is complete.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

from dalembert.algebra import plane
from dalembert.analysis.methods.elements.cylinder_quantities import cylinders, flow_in, working_pressure
from dalembert.analysis.methods.elements.screw_torques import drive_torque
from dalembert.analysis.result.number_kinds import contact_kind, drive_kinds, load_kind
from dalembert.analysis.result.transmission_lines import (
    LinkLine,
    OfLines,
    closure_margin,
    transmission_angle,
    transmission_lines,
)
from dalembert.arrays import Array, Numeric
from dalembert.model import GROUND

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism


class HasQuantities(Protocol):
    """Object with quantities: a result, or a compiled analysis."""

    @property
    def mechanism(self) -> Mechanism: ...
    @property
    def compiled(self) -> Compiled: ...
    @property
    def links(self) -> tuple[str, ...]: ...
    @property
    def joints(self) -> tuple[str, ...]: ...
    @property
    def drives(self) -> tuple[str, ...]: ...
    @property
    def unknown_loads(self) -> tuple[str, ...]: ...


Read = Callable[[Any, str], Numeric]
KindOf = Callable[[Any, str], str]


class QuantityReading(NamedTuple):
    """A quantity of one thing: its kind, or the function that gives its kind, and how its value is read."""

    kind: str | KindOf
    read: Read


class QuantityWord(NamedTuple):
    """The first part of a name: of which things it can be asked, what it and its rates read, where it is defined."""

    of: str
    rates: Mapping[str, QuantityReading]
    compiled: bool = True
    space: bool = True
    friction: bool = False

    def exists(self, r: HasQuantities, compiled: bool) -> bool:
        """True if the word has a meaning for a result, or for a compiled analysis."""
        in_space = r.mechanism.dimension == 3
        return (self.compiled or not compiled) and (self.space or not in_space)


def _method(name: str, *rest: object) -> Read:
    return lambda r, of: getattr(r, name)(of, *rest)


def _value(name: str) -> Read:
    return lambda r, of: getattr(r, name)


def _drive_kind(of: str) -> KindOf:
    return lambda r, drive: drive_kinds(r, drive)[of]


def _point(rate: str) -> Read:
    """A point of a link, or its velocity or acceleration."""

    def read(r: Any, of: str) -> Numeric:
        link, point = of.split(".", 1)
        return getattr(r, f"{'point_' if rate else 'point'}{rate}")(link, point)

    return read


def _freedom(kind: str) -> dict[str, QuantityReading]:
    kinds = ("length", "speed", "acceleration") if kind.startswith("slide") else _TURNING
    rates = ("", "speed", "acceleration")
    return {rate: QuantityReading(kinds[k], _freedom_rate(kind, k)) for k, rate in enumerate(rates)}


def _freedom_rate(kind: str, order: int) -> Read:
    return lambda r, joint: r.freedom(joint, kind)[order]


def _hinge(value: OfLines) -> Read:
    """A function of the two lines of a hinge."""

    def read(r: Any, of: str) -> Numeric:
        first, second = lines = transmission_lines(r.mechanism, of)
        return value(_turned(r, first), _turned(r, second), lines)

    return read


def _turned(r: Any, line: LinkLine) -> Array:
    if line.link == GROUND:
        return np.asarray(line.along)
    rotation = r.rotation_array[..., r.links.index(line.link), :]
    return plane.rotate(rotation, line.along)


def magnitude(vectors: Array) -> Numeric:
    """Length of vectors (..., d), numbers or nodes."""
    return np.sqrt((vectors * vectors).sum(axis=-1))


def _pressure(r: Any, joint: str) -> Numeric:
    """Force across a bearing's axis over the projected area; of a cylinder, that of the chamber that is solved for."""
    from dalembert.analysis.friction.bearing_ends import bearing_axis

    if joint in cylinders(r.mechanism):
        return working_pressure(r, joint)
    force = r.reaction(joint)
    if r.mechanism.dimension == 3:
        axis = bearing_axis(r, joint)
        force = force - (force * axis).sum(axis=1, keepdims=True) * axis
    return magnitude(force) / bearing_areas(r)[joint]


def _face(name: str) -> Read:
    def read(r: Any, joint: str) -> Numeric:
        from dalembert.analysis.friction.joint_friction import guide_contact

        return getattr(guide_contact(r, joint), name)

    return read


def _normal(r: Any, joint: str) -> Array:
    """Normal force of a contact that only pushes or pulls."""
    from dalembert.analysis.result.joint_freedoms import full_pose
    from dalembert.core.elements.pushing import contact_forces

    c, own = r.compiled, r.compiled.pushing
    rows = (own.joint == r.joints.index(joint)) & ~own.slips
    forces = contact_forces(c.layout, own, full_pose(r), r.force_array, r.moment_array)
    return np.asarray(forces[:, rows].sum(axis=-1))


def _mass(r: Any, link: str) -> Numeric:
    from dalembert.machine.design_numbers import mass

    return mass(r, link)


def _sized(word: str) -> Read:
    """A number of machine design, whose answers print themselves: imported where it is read."""

    def read(r: Any, of: str) -> Numeric:
        from dalembert.machine.design_numbers import READ

        return READ[word](r, of)

    return read


def _shaking(part: str) -> Read:
    return lambda r, about: getattr(r.shaking(about), part)


def _bounded(kind: str | KindOf, read: Read) -> dict[str, QuantityReading]:
    """A quantity with both ends of what friction leaves open, and both sides of a reversal."""
    return {
        "": QuantityReading(kind, read),
        "low": QuantityReading(kind, _end(0, read)),
        "high": QuantityReading(kind, _end(1, read)),
    }


def _end(k: int, read: Read) -> Read:
    def end(r: Result, of: str) -> Array:
        known = r.drives if read is _EFFORT else r.unknown_loads if read is _LOAD else ()
        if of in known and of in _requested(r):
            return r.interval(of)[:, k]
        sides = [np.asarray(read(side, of)) for side in (*r.sides, *chain.from_iterable(r.ends))]
        return np.asarray((np.fmin, np.fmax)[k].reduce(sides))

    return end


def _requested(r: Result) -> list[str]:
    from dalembert.analysis.friction.joint_friction import unknown_names

    return unknown_names(r)


_TURNING = ("angle", "angular_speed", "angular_acceleration")


def _load(r: Any, name: str) -> Numeric:
    """Value of an unknown load; of a given one the force, or the couple."""
    from dalembert.analysis.result.force_arrays import given_load

    return r.unknown_load(name) if name in r.unknown_loads else given_load(r, name)


_EFFORT, _LOAD = _method("effort"), _load
FREEDOMS = ("slide", "slide1", "slide2", "turn", "turn1", "turn2")
"""Words of the freedoms of joints; those with numbers are of pairs in space with two slides or turns."""

CATALOGUE: dict[str, QuantityWord] = {
    "effort": QuantityWord("drives", _bounded(_drive_kind("effort"), _EFFORT)),
    "load": QuantityWord("loads", _bounded(load_kind, _LOAD)),
    "reaction": QuantityWord("joints", _bounded("force", _method("reaction"))),
    "reaction_moment": QuantityWord("joints", _bounded("moment", _method("reaction_moment"))),
    "normal": QuantityWord("contacts", {"": QuantityReading(contact_kind, _normal)}, False, False),
    "friction_force": QuantityWord(
        "joints", _bounded("force", _method("friction_force")), False, friction=True
    ),
    "friction_moment": QuantityWord(
        "joints", _bounded("moment", _method("friction_moment")), False, friction=True
    ),
    "power_lost": QuantityWord("joints", _bounded("power", _method("power_lost")), False, friction=True),
    "lower_face": QuantityWord(
        "guides", {"": QuantityReading("force", _face("lower"))}, False, False, friction=True
    ),
    "upper_face": QuantityWord(
        "guides", {"": QuantityReading("force", _face("upper"))}, False, False, friction=True
    ),
    "drive": QuantityWord(
        "drives",
        {
            rate: QuantityReading(_drive_kind(rate or "position"), _method(f"drive_{rate or 'position'}"))
            for rate in ("", "speed", "acceleration")
        },
    ),
    "power": QuantityWord("drives", _bounded("power", lambda r, of: r.effort(of) * r.drive_speed(of))),
    "turning_speed": QuantityWord("frames", _bounded("angular_speed", _value("turning_speed"))),
    "turning_torque": QuantityWord(
        "frames", {"": QuantityReading("moment", _value("turning_torque"))}, False
    ),
    **{word: QuantityWord(word, _freedom(word)) for word in FREEDOMS},
    "angle": QuantityWord(
        "links",
        {
            "": QuantityReading("angle", _method("angle")),
            "speed": QuantityReading("angular_speed", _method("speed")),
            "acceleration": QuantityReading("angular_acceleration", _method("acceleration")),
        },
    ),
    "rotation": QuantityWord("links", {"": QuantityReading("number", _method("rotation"))}),
    "point": QuantityWord(
        "points",
        {
            "": QuantityReading("length", _point("")),
            "velocity": QuantityReading("speed", _point("velocity")),
            "acceleration": QuantityReading("acceleration", _point("acceleration")),
        },
    ),
    "transmission": QuantityWord("hinges", {"": QuantityReading("angle", _hinge(transmission_angle))}),
    "closure": QuantityWord("hinges", {"": QuantityReading("length", _hinge(closure_margin))}),
    "pressure": QuantityWord("pressed", {"": QuantityReading("pressure", _pressure)}),
    "screw_torque": QuantityWord("screws", {"": QuantityReading("moment", drive_torque)}),
    "flow": QuantityWord("cylinders", {"": QuantityReading("flow", flow_in)}),
    "shaking_force": QuantityWord("", {"": QuantityReading("force", _shaking("force"))}),
    "shaking_moment": QuantityWord("fixed points", {"": QuantityReading("moment", _shaking("moment"))}),
    "shaking_couple": QuantityWord(
        "placed", {"": QuantityReading("moment", _shaking("couple"))}, False, False
    ),
    "mass": QuantityWord("masses", {"": QuantityReading("mass", _mass)}),
    **{
        word: QuantityWord(of, {"": QuantityReading(kind, _sized(word))}, word in ("stress", "buckling"))
        for word, of, kind in (
            ("stress", "sections", "pressure"),
            ("fatigue", "fatigued", "number"),
            ("buckling", "elastic", "number"),
            ("deflection", "elastic", "length"),
            ("bearing_slope", "elastic", "angle"),
            ("life", "rated", "time"),
            ("pin_stress", "bolted", "pressure"),
        )
    },
    "play": QuantityWord(
        "clear",
        {
            "": QuantityReading("length", _sized("play")),
            "worst": QuantityReading("length", _sized("play.worst")),
        },
        False,
        False,
    ),
    "residual": QuantityWord("", {"": QuantityReading("number", _value("residual"))}),
    "power_balance": QuantityWord("", {"": QuantityReading("number", _value("power_balance"))}, False),
    "time": QuantityWord("times", {"": QuantityReading("time", _value("time"))}, False),
}
"""First word of a name -> the thing it belongs to, its kind and how it is read, by rate."""


def bearing_areas(r: HasQuantities) -> dict[str, Any]:
    """Projected area of each bearing with a diameter and a length; where a number varies, a node."""
    bearings = {name: getattr(r.mechanism.joints[name], "bearing", None) for name in r.joints}
    return {name: b.area for name, b in bearings.items() if b is not None and b.area is not None}
