"""A result as plain columns: each number named, with its kind of unit; what all writers share."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
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


OF_LINKS = {
    "angle": "angle",
    "rotation": "number",
    "speed": "angular_speed",
    "acceleration": "angular_acceleration",
    "position": "length",
    "velocity": "speed",
    "center": "length",
    "center_velocity": "speed",
    "center_acceleration": "acceleration",
}
"""What a result answers about a link, by the name of the method -> its kind."""

OF_POINTS = {"point": "length", "point_velocity": "speed", "point_acceleration": "acceleration"}
"""The same about a point of a link."""


def in_plane(result: Result) -> bool:
    """Whether a result is one of the plane."""
    return result.mechanism.dimension == 2


class Entry(NamedTuple):
    """A quantity of one thing: its keys in the JSON record, its name as a column, its kind, values in SI (P, ...)."""

    keys: tuple[str, ...]
    name: str
    kind: str
    values: Array


def drive_entries(result: Result) -> Iterator[Entry]:
    """What is prescribed."""
    for drive in result.drives:
        kinds = drive_kinds(result, drive)
        for name in ("position", "speed", "acceleration"):
            values = getattr(result, f"drive_{name}")(drive)
            yield Entry(("drives", drive, name), f"drive {drive} {name}", kinds[name], values)


def unknown_entries(result: Result) -> Iterator[Entry]:
    """What balances the machine."""
    for drive in result.drives:
        kind = drive_kinds(result, drive)["effort"]
        yield Entry(("efforts", drive), f"effort {drive}", kind, result.effort(drive))
    for load in result.unknown_loads:
        kind, values = load_kind(result, load), result.unknown_load(load)
        yield Entry(("unknown_loads", load), f"unknown load {load}", kind, values)


def joint_entries(result: Result, axes: Axes, every: bool = False) -> Iterator[Entry]:
    """Reactions, and friction's part of them in the joints that have it, or in ``every`` joint."""
    for r in reactions(result, axes):
        keys, name = ("reactions", r.joint), f"reaction {r.joint} on {r.on}"
        yield from _wrench(keys, name, r.force, r.moment)
        if r.least_norm is not None:
            yield from _wrench((*keys, "least_norm"), f"{name} least norm", *force_and_moment(r.least_norm))
    for joint in result.joints if every and result.friction is not None else friction_joints(result):
        on, of = result.mechanism.joints[joint].links[1], ("reactions", joint, "friction")
        yield from _wrench(of, f"friction {joint} on {on}", *friction_in(result, joint, axes))
        yield Entry((*of, "power_lost"), f"power lost {joint}", "power", result.power_lost(joint))


def _wrench(keys: tuple[str, ...], name: str, force: Array, moment: Array) -> Iterator[Entry]:
    yield Entry((*keys, "force"), name, "force", force)
    yield Entry((*keys, "moment"), f"{name} moment", "moment", moment)


def link_entries(result: Result) -> Iterator[Entry]:
    """How links are turned and turn, where they are, and what their mass centres do."""
    turned = "angle" if in_plane(result) else "rotation"
    for link in result.links:
        for word in (turned, "speed", "acceleration", "position", "center", "center_acceleration"):
            name = f"link {link} {word.replace('_', ' ')}"
            yield Entry(("links", link, word), name, OF_LINKS[word], getattr(result, word)(link))


def check_entries(result: Result) -> Iterator[Entry]:
    """What is left of equilibrium and of power."""
    yield Entry(("residual",), "residual", "number", result.residual)
    yield Entry(("power_balance",), "power balance", "number", result.power_balance)


def columns(result: Result, axes: Axes = "ground") -> Iterator[Column]:
    """Every number of a result: drives, efforts, unknown loads, reactions, links, residual, power balance; where some
    contact reverses also the low and the high of each that depends on friction."""
    yield from _columns(drive_entries(result))
    yield from _columns(unknown_entries(result))
    for name, kind in unknown_kinds(result).items() if result.ends else ():
        for k, end in enumerate(("low", "high")):
            yield Column(f"{name} {end} end", kind, result.interval(name)[:, k])
    yield from _columns(joint_entries(result, axes))
    yield from _columns(link_entries(result))
    yield from _columns(check_entries(result))
    if result.after is not None:
        yield from _span_columns(result, axes)


def _columns(some: Iterable[Entry]) -> Iterator[Column]:
    """A column for each component."""
    for q in some:
        for part, values in parts(q.values):
            yield Column(f"{q.name}{part}", q.kind, values)


def _span_columns(result: Result, axes: Axes) -> Iterator[Column]:
    """Low and high of everything that depends on friction: of the numbers just before and just after reversals, at
    rest the ends of what friction leaves open, elsewhere twice the number itself."""
    sides = [_columns([*unknown_entries(side), *joint_entries(side, axes)]) for side in result.sides]
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
    asked = zip(result.drives, result.compiled.known.asked, strict=True)
    kinds = {d: drive_kinds(result, d)["effort"] for d, a in asked if a}
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


def force_and_moment(wrench: Array) -> tuple[Array, Array]:
    """Force (..., d) and moment (...) or (..., 3) of wrenches (..., n)."""
    return (wrench[..., :2], wrench[..., 2]) if wrench.shape[-1] == 3 else (wrench[..., :3], wrench[..., 3:])
