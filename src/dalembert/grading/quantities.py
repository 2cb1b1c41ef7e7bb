"""The quantities that an answer of a model file may name, and how each is read from a result."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.friction.joint_friction import guide_contact
from dalembert.analysis.output.columns import drive_kinds, load_kind
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Answer


class Series(NamedTuple):
    """Values of a quantity over the positions, SI: numbers (P,), vectors (P, d) or rotations (P, 3, 3), of a kind of
    ``units.KINDS``."""

    kind: str
    values: Array


Read = Callable[["Result", "Answer"], Series]


def _name(answer: Answer, names: Iterable[str], kind: str) -> str:
    """The name that `of` gives, if there is such a one."""
    known = list(names)
    if answer.of not in known:
        said = f"{answer.quantity} needs `of`" if answer.of is None else f"there is no {kind} {answer.of!r}"
        raise ModelError(said, closest(answer.of or "", known), ("of",) if answer.of else ())
    return answer.of


def _of_drive(number: str, method: str) -> Read:
    def read(r: Result, a: Answer) -> Series:
        drive = _name(a, r.drives, "drive")
        return Series(drive_kinds(r, drive)[number], getattr(r, method)(drive))

    return read


def _unknown_load(r: Result, a: Answer) -> Series:
    load = _name(a, r.unknown_loads, "unknown load")
    return Series(load_kind(r, load), r.unknown_load(load))


def _of_joint(kind: str, method: str) -> Read:
    """What a joint exerts on the link that the answer names, in its axes."""

    def read(r: Result, a: Answer) -> Series:
        joint = _name(a, r.joints, "joint")
        return Series(kind, getattr(r, method)(joint, _on(r, a, joint), a.axes))

    return read


def _on(r: Result, a: Answer, joint: str) -> str | None:
    """The link acted on: named by `on`, or the other one than `by`."""
    i, j = r.mechanism.joints[joint].links
    for key, link in (("on", a.on), ("by", a.by)):
        if link not in (None, i, j):
            raise ModelError(f"joint {joint!r} does not join {link!r}", f"it joins {i} and {j}", (key,))
    if a.by is not None and a.by == a.on:
        raise ModelError(f"{a.by!r} exerts no reaction on itself", "leave out on, or by", ("by",))
    return a.on if a.by is None else j if a.by == i else i


def _end(k: int, loads: bool) -> Read:
    """Low (0) or high (1) end of what friction leaves open."""

    def read(r: Result, a: Answer) -> Series:
        name = _name(a, r.unknown_loads if loads else r.drives, "unknown load" if loads else "drive")
        kind = load_kind(r, name) if loads else drive_kinds(r, name)["effort"]
        return Series(kind, r.interval(name)[:, k])

    return read


def _friction(kind: str, name: str) -> Read:
    return lambda r, a: Series(kind, getattr(r, name)(_name(a, r.joints, "joint")))


def _face(name: str) -> Read:
    return lambda r, a: Series("force", getattr(guide_contact(r, _name(a, r.joints, "joint")), name))


def _of_link(kind: str, name: str) -> Read:
    def read(r: Result, a: Answer) -> Series:
        link = _name(a, r.links, "link")
        return Series(kind, _in_axes(r, a, link, getattr(r, name)(link)))

    return read


def _in_axes(r: Result, a: Answer, link: str, values: Array) -> Array:
    """Vectors of a link, or of a point of it, in the axes that the answer names."""
    if a.axes == "ground":
        return values
    if values.ndim != 2 or a.axes == "joint":
        what = f"{a.axes} axes mean nothing for the {a.quantity.replace('_', ' ')} of {a.of}"
        raise ModelError(what, "leave them out", ("axes",))
    return np.asarray((values[:, None, :] @ r.rotation(link))[:, 0])


def _of_point(kind: str, name: str) -> Read:
    def read(r: Result, a: Answer) -> Series:
        link, _, point = (a.of or "").partition(".")
        if link not in r.links or not point:
            raise ModelError(f"{a.of!r} names no point of a moving link", "write of: link.point", ("of",))
        return Series(kind, _in_axes(r, a, link, getattr(r, name)(link, point)))

    return read


RATES = ("", "_speed", "_acceleration")
KINDS_OF_FREEDOMS = {
    "slide": ("length", "speed", "acceleration"),
    "turn": ("angle", "angular_speed", "angular_acceleration"),
}


def _of_freedom(freedom: str, order: int) -> Read:
    kind = KINDS_OF_FREEDOMS[freedom.rstrip("12")][order]
    return lambda r, a: Series(kind, r.freedom(_name(a, r.joints, "joint"), freedom)[order])


def _shaking(kind: str, name: str) -> Read:
    def read(r: Result, a: Answer) -> Series:
        from dalembert.machine.shaking import shaking

        found = getattr(shaking(r, a.of if name == "moment" else None), name)
        if found is None:
            what = "there is no shaking couple: no link has a place"
            raise ModelError(what, "write place: 90 mm", ("quantity",))
        return Series(kind, found)

    return read


def _energy_fluctuation(r: Result, a: Answer) -> Series:
    """The same at every position, as an answer names one."""
    from dalembert.machine.flywheel.flywheels import flywheel

    fluctuation = flywheel(r, _name(a, r.drives, "drive"), inertia=1.0).size.energy
    return Series("energy", np.full(len(r.status), fluctuation))


QUANTITIES: dict[str, Read] = {
    "effort": _of_drive("effort", "effort"),
    "drive": _of_drive("position", "drive_position"),
    "unknown_load": _unknown_load,
    "reaction": _of_joint("force", "reaction"),
    "moment": _of_joint("moment", "reaction_moment"),
    "position": _of_link("length", "position"),
    "velocity": _of_link("speed", "velocity"),
    "angle": _of_link("angle", "angle"),
    "rotation": _of_link("number", "rotation"),
    "speed": _of_link("angular_speed", "speed"),
    "acceleration": _of_link("angular_acceleration", "acceleration"),
    "center": _of_link("length", "center"),
    "center_velocity": _of_link("speed", "center_velocity"),
    "center_acceleration": _of_link("acceleration", "center_acceleration"),
    "point": _of_point("length", "point"),
    "point_velocity": _of_point("speed", "point_velocity"),
    "point_acceleration": _of_point("acceleration", "point_acceleration"),
    **{
        freedom + rate: _of_freedom(freedom, order)
        for freedom in ("slide", "slide1", "slide2", "turn", "turn1", "turn2")
        for order, rate in enumerate(RATES)
    },
    "effort_low": _end(0, False),
    "effort_high": _end(1, False),
    "unknown_load_low": _end(0, True),
    "unknown_load_high": _end(1, True),
    "friction_force": _friction("force", "friction_force"),
    "friction_moment": _friction("moment", "friction_moment"),
    "power_lost": _friction("power", "power_lost"),
    "lower_face": _face("lower"),
    "upper_face": _face("upper"),
    "shaking_force": _shaking("force", "force"),
    "shaking_moment": _shaking("moment", "moment"),
    "shaking_couple": _shaking("moment", "couple"),
    "energy_fluctuation": _energy_fluctuation,
    "residual": lambda r, a: Series("number", r.residual),
    "power_balance": lambda r, a: Series("number", r.power_balance),
}
"""Name -> how its values over the positions are read."""

WORDS: dict[str, Callable[[Result, int], str | None]] = {
    "status": lambda r, k: r.status[k],
    "stability": lambda r, k: r.stability[k] if r.stability else None,
}
"""Quantities of a position whose value is a word."""

WHOLE: dict[str, Callable[[Result], int | None]] = {
    "count": lambda r: len(r.status),
    "mobility": lambda r: r.mobility.freedoms if r.mobility else None,
    "redundant": lambda r: r.mobility.redundant if r.mobility else None,
}
"""Quantities of the mechanism as a whole."""


def component(series: Series, name: str | None) -> Series:
    """One component of a vector: x, y, z, magnitude, in the plane direction; the series itself without a name."""
    if name is None:
        return series
    if series.values.ndim == 1:
        if name == "magnitude":
            return Series(series.kind, np.abs(series.values))
        raise ModelError(f"a number has no component {name!r}", "leave it out", ("component",))
    if series.values.ndim == 3:
        what = f"a rotation has no component {name!r}"
        raise ModelError(what, "give all of it, a row each", ("component",))
    if name == "direction" and series.values.shape[1] == 2:
        return Series("angle", np.arctan2(series.values[:, 1], series.values[:, 0]))
    parts = dict(zip("xyz", series.values.T, strict=False)) | {"magnitude": size(series)}
    if name not in parts:
        known = [*parts, *(["direction"] if "z" not in parts else [])]
        raise ModelError(f"there is no component {name!r}", closest(name, known), ("component",))
    return Series(series.kind, parts[name])


def size(series: Series) -> Array:
    """Numbers to compare positions by: the value, or the magnitude of a vector."""
    values = series.values
    return values if values.ndim == 1 else np.sqrt((values**2).sum(axis=tuple(range(1, values.ndim))))
