"""A result as plain columns: each number named, with its kind of unit; what all writers share."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dalembert.analysis.wrenches import Axes
from dalembert.units import KINDS, file_units

if TYPE_CHECKING:
    from dalembert.analysis.result import Result

Array = NDArray[Any]
UnitChoice = Literal["SI", "file"]

LENGTHWISE = {"position": "length", "speed": "speed", "acceleration": "acceleration", "effort": "force"}
ANGULAR = {
    "position": "angle",
    "speed": "angular_speed",
    "acceleration": "angular_acceleration",
    "effort": "moment",
}


class Column(NamedTuple):
    """One number a position: its name, its kind (a key of ``units.KINDS``) and its values in SI (P,)."""

    name: str
    kind: str
    values: Array


class Reaction(NamedTuple):
    """What a joint's i exerts on its j: force (P, 2), moment (P,), NaN if not unique; then least norm (P, 3)."""

    joint: str
    on: str
    by: str
    force: Array
    moment: Array
    least_norm: Array | None


class Scale:
    """SI numbers into the units that were asked for.

    >>> scale = Scale(None)
    >>> scale.text("moment"), scale("moment", 2.0)
    ('N*m', 2.0)
    """

    def __init__(self, units: object) -> None:
        self._units = None if units is None else file_units(units)

    def text(self, kind: str) -> str:
        """The unit of a kind of number, as text."""
        return KINDS[kind].si if self._units is None else self._units.text(kind)

    def __call__(self, kind: str, values: Any) -> Any:
        """The values in that unit."""
        if self._units is None:
            return values
        unit = self._units.unit(kind)
        return values * unit.denominator / unit.numerator


def scale(result: Result, units: UnitChoice) -> Scale:
    """Scale to SI, or to the units of the file."""
    return Scale(None if units == "SI" else result.mechanism.units)


def drive_kinds(result: Result, drive: str) -> dict[str, str]:
    """Kinds of a drive's position, speed, acceleration and effort."""
    compiled = result.compiled
    row = compiled.layout.driven[result.drives.index(drive)]
    return ANGULAR if compiled.layout.freedoms.angular[row] else LENGTHWISE


def load_kind(result: Result, load: str) -> str:
    """Kind of an unknown load: force, or moment of a couple."""
    return "force" if result.mechanism.loads[load].type == "force" else "moment"


def reactions(result: Result, axes: Axes = "ground") -> Iterator[Reaction]:
    """The reaction of every joint on its j."""
    for joint in result.joints:
        by, on = result.mechanism.joints[joint].links
        force, moment = result.reaction(joint, on, axes), result.reaction_moment(joint, on)
        least = None
        if not result.unique(joint).all():
            least = in_axes(result, on, result.least_norm(joint, on), axes)
        yield Reaction(joint, on, by, force, moment, least)


def in_axes(result: Result, link: str, wrench: Array, axes: Axes) -> Array:
    """(fx, fy) or (fx, fy, m) in ground axes, or in those of a link."""
    if axes == "ground" or link == "ground":
        return wrench
    cos, sin = np.cos(result.angle(link)), np.sin(result.angle(link))
    x, y, *moment = np.moveaxis(wrench, -1, 0)
    return np.stack([cos * x + sin * y, cos * y - sin * x, *moment], axis=-1)


LINK_VECTORS: dict[str, tuple[str, Callable[[Any, str], Array]]] = {
    "position": ("length", lambda r, link: r.position(link)),
    "center": ("length", lambda r, link: r.center(link)),
    "center_acceleration": ("acceleration", lambda r, link: r.center_acceleration(link)),
}
LINK_NUMBERS: dict[str, tuple[str, Callable[[Any, str], Array]]] = {
    "angle": ("angle", lambda r, link: r.angle(link)),
    "speed": ("angular_speed", lambda r, link: r.speed(link)),
    "acceleration": ("angular_acceleration", lambda r, link: r.acceleration(link)),
}
DRIVE_NUMBERS: dict[str, Callable[[Any, str], Array]] = {
    "position": lambda r, drive: r.drive_position(drive),
    "speed": lambda r, drive: r.drive_speed(drive),
    "acceleration": lambda r, drive: r.drive_acceleration(drive),
}
EFFORT: dict[str, Callable[[Any, str], Array]] = {"effort": lambda r, drive: r.effort(drive)}


def columns(result: Result, axes: Axes = "ground") -> Iterator[Column]:
    """Every number of a result: drives, efforts, unknown loads, reactions, links, residual, power balance."""
    for drive in result.drives:
        kinds = drive_kinds(result, drive)
        for name, values in DRIVE_NUMBERS.items():
            yield Column(f"drive {drive} {name}", kinds[name], values(result, drive))
    for drive in result.drives:
        yield Column(f"effort {drive}", drive_kinds(result, drive)["effort"], result.effort(drive))
    for load in result.unknown_loads:
        yield Column(f"unknown load {load}", load_kind(result, load), result.unknown_load(load))
    for name, kind in unknown_kinds(result).items() if result.ends else ():
        for k, end in enumerate(("low", "high")):
            yield Column(f"{name} {end} end", kind, result.interval(name)[:, k])
    for reaction in reactions(result, axes):
        yield from _reaction_columns(reaction)
    for joint in rubbing_joints(result):
        yield from _friction_columns(result, joint)
    for link in result.links:
        yield from _link_columns(result, link)
    yield Column("residual", "number", result.residual)
    yield Column("power balance", "number", result.power_balance)


def unknown_kinds(result: Result) -> dict[str, str]:
    """Kind of every effort and load that was asked for."""
    asked = result.compiled.known.asked
    drives = [d for d, a in zip(result.drives, asked, strict=True) if a]
    kinds = {d: drive_kinds(result, d)["effort"] for d in drives}
    return kinds | {load: load_kind(result, load) for load in result.unknown_loads}


def rubbing_joints(result: Result) -> list[str]:
    """Joints with dry or viscous friction, where friction is on."""
    if result.friction is None:
        return []
    from dalembert.analysis.loads import joint_damping

    joints = result.mechanism.joints
    return [n for n in result.joints if getattr(joints[n], "friction", None) or joint_damping(joints[n])]


def _friction_columns(result: Result, joint: str) -> Iterator[Column]:
    force, moment = result.friction_force(joint), result.friction_moment(joint)
    name = f"friction {joint} on {result.mechanism.joints[joint].links[1]}"
    yield from _wrench_columns(name, [force[:, 0], force[:, 1], moment])
    yield Column(f"power lost {joint}", "power", result.power_lost(joint))


def _reaction_columns(reaction: Reaction) -> Iterator[Column]:
    name = f"reaction {reaction.joint} on {reaction.on}"
    wrench = [reaction.force[:, 0], reaction.force[:, 1], reaction.moment]
    yield from _wrench_columns(name, wrench)
    if reaction.least_norm is not None:
        yield from _wrench_columns(f"{name} least norm", list(np.moveaxis(reaction.least_norm, -1, 0)))


def _wrench_columns(name: str, wrench: list[Array]) -> Iterator[Column]:
    for part, kind, values in zip(("x", "y", "moment"), ("force", "force", "moment"), wrench, strict=True):
        yield Column(f"{name} {part}", kind, values)


def _link_columns(result: Result, link: str) -> Iterator[Column]:
    for name, (kind, numbers) in LINK_NUMBERS.items():
        yield Column(f"link {link} {name}", kind, numbers(result, link))
    for name, (kind, vectors) in LINK_VECTORS.items():
        values = vectors(result, link)
        for k, part in enumerate("xy"):
            yield Column(f"link {link} {name.replace('_', ' ')} {part}", kind, values[:, k])
