"""Reads the few forms of the model file that the oracles need, without the product's loader.

Bare numbers are SI and degrees; text is one number and one unit of the table below.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, radians, sin
from typing import Any

import numpy as np

from dalembert.arrays import Array

Tree = dict[str, Any]

UNITS = {
    "rad": 1.0, "deg": pi / 180, "rad/s": 1.0, "rad/s^2": 1.0, "m": 1.0, "m/s": 1.0, "m/s^2": 1.0,
    "N*m/rad": 1.0, "N*m*s/rad": 1.0, "N": 1.0, "N*m": 1.0, "kg": 1.0,
}  # fmt: skip


def number(value: float | str, bare: float = 1.0) -> float:
    """A quantity in SI and radians; ``bare`` multiplies numbers without a unit."""
    if isinstance(value, str):
        text, unit = value.split()
        return float(text) * UNITS[unit]
    return float(value) * bare


def angle(value: float | str) -> float:
    return number(value, pi / 180)


def vector(value: Any) -> tuple[float, float]:
    """``[x, y]`` or ``r @ degrees``."""
    if isinstance(value, str):
        r, direction = (float(part) for part in value.split("@"))
        return r * cos(radians(direction)), r * sin(radians(direction))
    return number(value[0]), number(value[1])


@dataclass(frozen=True)
class Joint:
    name: str
    type: str
    i: int
    j: int
    at_i: tuple[float, float]
    at_j: tuple[float, float]
    tree: Tree

    def angle(self, key: str) -> float:
        return angle(self.tree.get(key, 0.0))


@dataclass(frozen=True)
class Drive:
    """One driven freedom; ``position``, ``speed`` and ``acceleration`` have one value a position."""

    name: str
    joint: str
    freedom: str
    position: Array
    speed: Array
    acceleration: Array


@dataclass(frozen=True)
class Machine:
    """The tree in numbers: links in order with ground first; P positions."""

    links: tuple[str, ...]
    points: dict[str, dict[str, tuple[float, float]]]
    mass: Array
    center: Array
    inertia: Array
    gravity: tuple[float, float]
    joints: tuple[Joint, ...]
    drives: tuple[Drive, ...]
    loads: dict[str, Tree]

    def place(self, text: str) -> tuple[int, tuple[float, float]]:
        """``link.point`` -> index of the link and the point in its axes."""
        link, point = text.split(".")
        return self.links.index(link), self.points[link][point]


def machine(tree: Tree) -> Machine:
    """The machine of a tree whose units are SI and degrees."""
    links = ("ground", *(name for name in tree["links"] if name != "ground"))
    trees = [tree["links"].get(name, {}) for name in links]
    points = {
        name: {k: vector(p) for k, p in t.get("points", {}).items()}
        for name, t in zip(links, trees, strict=True)
    }
    return Machine(
        links=links,
        points=points,
        mass=np.array([number(t.get("mass", 0.0)) for t in trees]),
        center=np.array([vector(t.get("center", (0.0, 0.0))) for t in trees]),
        inertia=np.array([number(t.get("inertia", 0.0)) for t in trees]),
        gravity=_gravity(tree.get("gravity", "none")),
        joints=tuple(_joint(name, t, links, points) for name, t in tree["joints"].items()),
        drives=_drives(tree),
        loads=tree.get("loads", {}),
    )


def _gravity(value: Any) -> tuple[float, float]:
    if value == "none":
        return 0.0, 0.0
    return (0.0, -9.80665) if value == "standard" else vector(value)


def _joint(name: str, tree: Tree, links: tuple[str, ...], points: dict[str, Any]) -> Joint:
    i, j = tree["links"]
    at = tree.get("at", name)
    at_i, at_j = (at, at) if isinstance(at, str) else at
    return Joint(name, tree["type"], links.index(i), links.index(j), points[i][at_i], points[j][at_j], tree)


def _drives(tree: Tree) -> tuple[Drive, ...]:
    drives = [drive(name, t, tree["joints"]) for name, t in tree.get("drives", {}).items()]
    count = max((len(d.position) for d in drives), default=1)
    return tuple(
        Drive(
            d.name,
            d.joint,
            d.freedom,
            *(np.broadcast_to(x, count) for x in (d.position, d.speed, d.acceleration)),
        )
        for d in drives
    )


def drive(name: str, tree: Tree, joints: Tree) -> Drive:
    joint = tree.get("joint", name)
    freedom = tree.get("freedom") or {"slider": "slide"}.get(joints[joint]["type"], "turn")
    bare = 1.0 if freedom.startswith("slide") else pi / 180
    given = [_values(tree.get(key, 0.0), bare) for key in ("position", "speed", "acceleration")]
    return Drive(name, joint, freedom, *given)


def _values(value: Any, bare: float) -> Array:
    if isinstance(value, dict):
        return _range(number(value["from"], bare), number(value["to"], bare), value["count"], bare)
    listed = value if isinstance(value, list) else [value]
    return np.array([number(x, bare) for x in listed])


def _range(start: float, end: float, count: int, bare: float) -> Array:
    """Whole turns do not repeat their first position."""
    turns = abs(end - start) / (2 * pi)
    whole = bare != 1.0 and round(turns) > 0 and abs(turns - round(turns)) < 1e-9
    return np.linspace(start, end, count, endpoint=not whole)
