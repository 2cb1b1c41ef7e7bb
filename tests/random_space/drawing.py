"""What is drawn: everything in ground axes, in SI and radians, before any number of a link is read off.

PAIRS says how j's local axes stand in i's: slides along axes of i, then turns, the first about an axis of i, a second
about one of j. It is written here once more, from the classic table, so that the product's own is not trusted.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from dalembert.arrays import Array

AXES = "xyz"


class Pair(NamedTuple):
    """Axes of slides and of turns, and the freedoms that a drive can prescribe."""

    slides: str
    turns: str
    freedoms: tuple[str, ...]

    @property
    def count(self) -> int:
        return len(self.slides) + len(self.turns)


PAIRS = {
    "weld": Pair("", "", ()),
    "revolute": Pair("", "z", ("turn",)),
    "prismatic": Pair("x", "", ("slide",)),
    "screw": Pair("", "x", ("turn", "slide")),
    "cylindrical": Pair("x", "x", ("slide", "turn")),
    "universal": Pair("", "yz", ("turn1", "turn2")),
    "spherical": Pair("", "xyz", ("turn",)),
    "plane": Pair("yz", "x", ("slide1", "slide2", "turn")),
    "sphere_between_planes": Pair("yz", "xyz", ("slide1", "slide2", "turn")),
    "sphere_in_cylinder": Pair("x", "xyz", ("slide", "turn")),
    "cylinder_between_planes": Pair("yz", "xz", ("slide1", "slide2", "turn1", "turn2")),
    "slotted_sphere": Pair("", "yz", ("turn1", "turn2")),
    "torus": Pair("", "yz", ("turn1", "turn2")),
    "slotted_cylinder": Pair("x", "z", ("slide", "turn")),
    "slotted_sphere_in_cylinder": Pair("x", "yz", ("slide", "turn1", "turn2")),
}
"""Joint -> how j moves in i."""

BALLS = ("spherical", "sphere_between_planes", "sphere_in_cylinder")
BLOCKED = {"x": "yz", "y": "zx", "z": "xy"}
"""Blocked turn of a slotted sphere -> the turns that it leaves."""


@dataclass(frozen=True)
class Rigid:
    """A motion of the whole machine: turn about the ground's origin, then shift."""

    turn: Array = field(default_factory=lambda: np.eye(3))
    shift: Array = field(default_factory=lambda: np.zeros(3))

    def point(self, p: Array) -> Array:
        return np.asarray(self.turn @ p + self.shift)

    def vector(self, v: Array) -> Array:
        return np.asarray(self.turn @ v)


@dataclass(frozen=True)
class Joint:
    """``on_i``, ``on_j``: local axes of both links as rows, in ground axes; ``values``: of the slides, then turns.

    ``axis``: of a driven ball's turn, in ground axes, fixed in i.
    """

    type: str
    i: str
    j: str
    at_i: str
    at_j: str
    on_i: Array
    on_j: Array
    values: tuple[float, ...] = ()
    lead: float = 0.0
    blocked: str = "x"
    axis: Array | None = None
    damping: dict[str, float] = field(default_factory=dict)

    @property
    def pair(self) -> Pair:
        pair = PAIRS[self.type]
        return pair if self.blocked == "x" else pair._replace(turns=BLOCKED[self.blocked])


@dataclass(frozen=True)
class Drive:
    """``steps``: what is added to the drawn position at each of the positions."""

    joint: str
    freedom: str
    steps: tuple[float, ...]
    speed: float
    acceleration: float


@dataclass(frozen=True)
class Load:
    """``vector``: force or couple, in ground axes as drawn, turning with the link where it ``follows``.

    ``along``: written as a value and a direction; ``a, b``: (link, point).
    """

    type: str
    a: tuple[str, str] = ("", "")
    b: tuple[str, str] = ("", "")
    vector: Array = field(default_factory=lambda: np.zeros(3))
    follows: bool = False
    along: bool = False
    value: float = 0.0
    free: float = 0.0
    joint: str = ""


@dataclass(frozen=True)
class Mass:
    """Mass, mass centre and inertia about it, in ground axes as drawn."""

    mass: float
    center: Array
    inertia: Array


@dataclass
class Drawing:
    """Links' axes (rotation, origin), their points, joints, drives, loads, masses, gravity; all in ground axes.

    ``posed``: the links' axes stand anyhow and the file gives their poses; else they are parallel to ground's, the
    joints' freedoms at 0, and the file says nothing. ``rods``: links free to spin, to be loaded on their line only.
    """

    poses: dict[str, tuple[Array, Array]] = field(
        default_factory=lambda: {"ground": (np.eye(3), np.zeros(3))}
    )
    spots: dict[str, dict[str, Array]] = field(default_factory=lambda: {"ground": {}})
    joints: dict[str, Joint] = field(default_factory=dict)
    drives: dict[str, Drive] = field(default_factory=dict)
    loads: dict[str, Load] = field(default_factory=dict)
    masses: dict[str, Mass] = field(default_factory=dict)
    gravity: Array = field(default_factory=lambda: np.zeros(3))
    posed: bool = True
    rods: dict[str, tuple[Array, Array]] = field(default_factory=dict)
    seed: int = 0

    @property
    def links(self) -> tuple[str, ...]:
        return tuple(self.poses)

    def spot(self, link: str, p: Array) -> str:
        """Name a point of a link (one name a place)."""
        name = f"p{len(self.spots[link])}"
        self.spots[link][name] = np.asarray(p)
        return name

    def link(self, rng: np.random.Generator, near: Array) -> str:
        """A new link, its axes anywhere near a place, or parallel to ground's."""
        name = f"L{len(self.poses)}"
        r = rotation(rng) if self.posed else np.eye(3)
        self.poses[name] = r, near + rng.uniform(-0.5, 0.5, 3)
        self.spots[name] = {}
        return name

    def join(
        self, kind: str, i: str, j: str, p: Array, on_i: Array, values: tuple[float, ...], **more: Any
    ) -> str:
        """A joint between i's material at p, with local axes ``on_i``, and j's where the values put it."""
        pair, name = PAIRS[kind], f"J{len(self.joints)}"
        turns = BLOCKED[more["blocked"]] if more.get("blocked", "x") != "x" else pair.turns
        count = len(pair.slides)
        r = p + sum((s * on_i[AXES.index(k)] for s, k in zip(values, pair.slides, strict=False)), np.zeros(3))
        if kind == "screw":
            r = p + more["lead"] / (2 * np.pi) * values[0] * on_i[0]
        on_j = turned_frame(on_i, turns, values[count:])
        ends = self.spot(i, p), self.spot(j, r)
        self.joints[name] = Joint(kind, i, j, *ends, on_i, on_j, values, **more)
        return name


def rotation(rng: np.random.Generator) -> Array:
    """Any rotation."""
    q, r = np.linalg.qr(rng.normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return np.asarray(q if np.linalg.det(q) > 0 else q[:, ::-1])


def about(axis: Array, angle: Any) -> Array:
    """Rotations (..., 3, 3) by angles (...) about an axis."""
    u = np.asarray(axis) / np.linalg.norm(axis)
    k = np.array([[0, -u[2], u[1]], [u[2], 0, -u[0]], [-u[1], u[0], 0]])
    a = np.asarray(angle)[..., None, None]
    return np.asarray(np.eye(3) + np.sin(a) * k + (1 - np.cos(a)) * (k @ k))


def turned_frame(on_i: Array, turns: str, values: Any) -> Array:
    """Axes (rows) that are those of i turned about ``turns`` one after the other, each time about their own axis."""
    axes = np.asarray(on_i)
    for name, value in zip(turns, values, strict=True):
        axes = axes @ about(axes[AXES.index(name)], value).T
    return axes
