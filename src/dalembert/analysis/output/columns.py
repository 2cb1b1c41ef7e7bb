"""A result as plain columns: each number named, with its kind of unit; what all writers share."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from dalembert.analysis.result.reaction_axes import Axes, to_axes
from dalembert.arrays import Array, Numeric
from dalembert.units import KINDS, file_units

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

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
    """What a joint's i exerts on its j: force (P, d), moment (P,) or (P, 3), NaN if not unique; least norm (P, n)."""

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

    def bare(self, kind: str) -> bool:
        """Whether these units have one for bare numbers of this kind."""
        return self._units is None or not self._units.refuses_bare(kind)

    def text(self, kind: str) -> str:
        """The unit of a kind of number, as text."""
        return KINDS[kind].si if self._units is None else self._units.text(kind)

    def __call__(self, kind: str, values: Numeric) -> Numeric:
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
    return "force" if result.mechanism.loads[load].ON == "point" else "moment"


def reactions(result: Result, axes: Axes = "ground") -> Iterator[Reaction]:
    """The reaction of every joint on its j."""
    for joint in result.joints:
        by, on = result.mechanism.joints[joint].links
        force, moment = result.reaction(joint, on, axes), result.reaction_moment(joint, on, axes)
        least = None if result.unique(joint).all() else result.least_norm(joint, on, axes)
        yield Reaction(joint, on, by, force, moment, least)


def parts(values: Array) -> Iterator[tuple[str, Array]]:
    """Names and values (P,) of the components of numbers (P,), vectors (P, d) or matrices (P, 3, 3).

    >>> [name for name, _ in parts(np.zeros((1, 3)))]
    [' x', ' y', ' z']
    """
    if values.ndim == 1:
        yield "", values
        return
    for place in np.ndindex(values.shape[1:]):
        yield " " + "".join("xyz"[k] for k in place), values[(slice(None), *place)]


Question = Callable[["Result", str], Array]
"""What is asked of a result about something with a name."""

LINK_VECTORS: dict[str, tuple[str, Question]] = {
    "position": ("length", lambda r, link: r.position(link)),
    "center": ("length", lambda r, link: r.center(link)),
    "center_acceleration": ("acceleration", lambda r, link: r.center_acceleration(link)),
}
ANGLE: dict[str, tuple[str, Question]] = {"angle": ("angle", lambda r, link: r.angle(link))}
ROTATION: dict[str, tuple[str, Question]] = {"rotation": ("number", lambda r, link: r.rotation(link))}
RATES: dict[str, tuple[str, Question]] = {
    "speed": ("angular_speed", lambda r, link: r.speed(link)),
    "acceleration": ("angular_acceleration", lambda r, link: r.acceleration(link)),
}


def link_turning(result: Result) -> dict[str, tuple[str, Question]]:
    """Kind and values of how links are turned and turn: angles in the plane, rotations in space."""
    return (ANGLE if in_plane(result) else ROTATION) | RATES


def in_plane(result: Result) -> bool:
    """Whether a result is one of the plane."""
    return result.mechanism.dimension == 2


DRIVE_NUMBERS: dict[str, Question] = {
    "position": lambda r, drive: r.drive_position(drive),
    "speed": lambda r, drive: r.drive_speed(drive),
    "acceleration": lambda r, drive: r.drive_acceleration(drive),
}
EFFORT: dict[str, Question] = {"effort": lambda r, drive: r.effort(drive)}


def columns(result: Result, axes: Axes = "ground") -> Iterator[Column]:
    """Every number of a result: drives, efforts, unknown loads, reactions, links, residual, power balance; where some
    contact reverses also the low and the high of each that depends on friction."""
    for drive in result.drives:
        kinds = drive_kinds(result, drive)
        for name, values in DRIVE_NUMBERS.items():
            yield Column(f"drive {drive} {name}", kinds[name], values(result, drive))
    yield from _unknown_columns(result)
    for name, kind in unknown_kinds(result).items() if result.ends else ():
        for k, end in enumerate(("low", "high")):
            yield Column(f"{name} {end} end", kind, result.interval(name)[:, k])
    yield from _joint_columns(result, axes)
    for link in result.links:
        yield from _link_columns(result, link)
    yield Column("residual", "number", result.residual)
    yield Column("power balance", "number", result.power_balance)
    if result.after is not None:
        yield from _span_columns(result, axes)


def _unknown_columns(result: Result) -> Iterator[Column]:
    """What balances the machine."""
    for drive in result.drives:
        yield Column(f"effort {drive}", drive_kinds(result, drive)["effort"], result.effort(drive))
    for load in result.unknown_loads:
        yield Column(f"unknown load {load}", load_kind(result, load), result.unknown_load(load))


def _joint_columns(result: Result, axes: Axes) -> Iterator[Column]:
    """Reactions, and friction's part of them."""
    for reaction in reactions(result, axes):
        yield from _reaction_columns(reaction)
    for joint in friction_joints(result):
        yield from _friction_columns(result, joint, axes)


def _span_columns(result: Result, axes: Axes) -> Iterator[Column]:
    """Low and high of everything that depends on friction: of the numbers just before and just after reversals, at
    rest the ends of what friction leaves open, elsewhere twice the number itself."""
    sides = [[*_unknown_columns(side), *_joint_columns(side, axes)] for side in result.sides]
    open_ = {("effort " if n in result.drives else "unknown load ") + n: n for n in unknown_kinds(result)}
    for before, after in zip(*sides, strict=True):
        if before.name in open_:
            low, high = result.interval(open_[before.name]).T
        else:
            low, high = np.minimum(before.values, after.values), np.maximum(before.values, after.values)
        yield before._replace(name=f"{before.name} low", values=low)
        yield before._replace(name=f"{before.name} high", values=high)


def unknown_kinds(result: Result) -> dict[str, str]:
    """Kind of every effort and load that was asked for."""
    asked = result.compiled.known.asked
    drives = [d for d, a in zip(result.drives, asked, strict=True) if a]
    kinds = {d: drive_kinds(result, d)["effort"] for d in drives}
    return kinds | {load: load_kind(result, load) for load in result.unknown_loads}


def friction_joints(result: Result) -> list[str]:
    """Joints with dry or viscous friction, where friction is on."""
    if result.friction is None:
        return []
    from dalembert.analysis.compile.load_arrays import joint_damping

    joints = result.mechanism.joints
    return [n for n in result.joints if getattr(joints[n], "friction", None) or joint_damping(joints[n])]


def friction_in(result: Result, joint: str, axes: Axes) -> tuple[Array, Array]:
    """Dry friction's force and moment in a joint, on j, in the axes of the reactions."""
    force, moment = result.friction_force(joint), result.friction_moment(joint)
    whole = np.concatenate([force, moment.reshape((len(moment), -1))], axis=-1)
    return force_and_moment(to_axes(result, joint, None, axes, whole))


def _friction_columns(result: Result, joint: str, axes: Axes) -> Iterator[Column]:
    force, moment = friction_in(result, joint, axes)
    name = f"friction {joint} on {result.mechanism.joints[joint].links[1]}"
    yield from _wrench_columns(name, force, moment)
    yield Column(f"power lost {joint}", "power", result.power_lost(joint))


def _reaction_columns(reaction: Reaction) -> Iterator[Column]:
    name = f"reaction {reaction.joint} on {reaction.on}"
    yield from _wrench_columns(name, reaction.force, reaction.moment)
    if reaction.least_norm is not None:
        yield from _wrench_columns(f"{name} least norm", *force_and_moment(reaction.least_norm))


def force_and_moment(wrench: Array) -> tuple[Array, Array]:
    """Force (..., d) and moment (...) or (..., 3) of wrenches (..., n)."""
    return (wrench[..., :2], wrench[..., 2]) if wrench.shape[-1] == 3 else (wrench[..., :3], wrench[..., 3:])


def _wrench_columns(name: str, force: Array, moment: Array) -> Iterator[Column]:
    for part, values in parts(force):
        yield Column(f"{name}{part}", "force", values)
    for part, values in parts(moment):
        yield Column(f"{name} moment{part}", "moment", values)


def _link_columns(result: Result, link: str) -> Iterator[Column]:
    for name, (kind, read) in {**link_turning(result), **LINK_VECTORS}.items():
        for part, values in parts(read(result, link)):
            yield Column(f"link {link} {name.replace('_', ' ')}{part}", kind, values)
