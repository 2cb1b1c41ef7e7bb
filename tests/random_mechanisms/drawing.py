"""What is drawn: everything in ground axes, in SI and radians, before any length is read off."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import atan2, cos, hypot, sin
from typing import Any

Point = tuple[float, float]


@dataclass(frozen=True)
class Rigid:
    """A motion of the whole machine: turn about the ground's origin, then shift."""

    turn: float = 0.0
    x: float = 0.0
    y: float = 0.0

    def point(self, p: Point) -> Point:
        c, s = cos(self.turn), sin(self.turn)
        return c * p[0] - s * p[1] + self.x, s * p[0] + c * p[1] + self.y

    def vector(self, v: Point) -> Point:
        c, s = cos(self.turn), sin(self.turn)
        return c * v[0] - s * v[1], s * v[0] + c * v[1]


@dataclass(frozen=True)
class Joint:
    """``direction``: of a slide, in ground axes; ``radii``: of i and j."""

    type: str
    i: str
    j: str
    at_i: str
    at_j: str
    direction: float = 0.0
    radii: tuple[float, float] = (0.0, 0.0)
    internal: bool = False
    pressure: float = 20.0
    damping: float = 0.0


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
    """``vector``: a force, in ground axes as drawn or, with ``follows``, in link axes. ``a, b``: (link, point)."""

    type: str
    a: tuple[str, str] = ("", "")
    b: tuple[str, str] = ("", "")
    vector: Point = (0.0, 0.0)
    follows: bool = False
    value: float = 0.0
    free: float = 0.0
    joint: str = ""


@dataclass
class Drawing:
    """Links' axes ``(x, y, angle)``, their points in ground axes, joints, drives, loads, masses, gravity."""

    poses: dict[str, tuple[float, float, float]] = field(default_factory=lambda: {"ground": (0.0, 0.0, 0.0)})
    spots: dict[str, dict[str, Point]] = field(default_factory=lambda: {"ground": {}})
    joints: dict[str, Joint] = field(default_factory=dict)
    drives: dict[str, Drive] = field(default_factory=dict)
    loads: dict[str, Load] = field(default_factory=dict)
    masses: dict[str, tuple[float, Point, float]] = field(default_factory=dict)
    gravity: Point = (0.0, 0.0)
    seed: int = 0

    def spot(self, link: str, p: Point) -> str:
        """Name a point of a link (one name a place)."""
        name = f"p{len(self.spots[link])}"
        self.spots[link][name] = p
        return name

    def join(self, type_: str, i: str, j: str, p: Point, r: Point | None = None, **more: Any) -> str:
        """A joint between i's material at p and j's at r (default the same place)."""
        name = f"J{len(self.joints)}"
        self.joints[name] = Joint(type_, i, j, self.spot(i, p), self.spot(j, p if r is None else r), **more)
        return name

    def ends(self, joint: Joint) -> tuple[Point, Point]:
        return self.spots[joint.i][joint.at_i], self.spots[joint.j][joint.at_j]


def gap(p: Point, r: Point) -> tuple[float, float]:
    """Distance and direction from p to r."""
    return hypot(r[0] - p[0], r[1] - p[1]), atan2(r[1] - p[1], r[0] - p[0])


def beside(p: Point, distance: float, direction: float) -> Point:
    return p[0] + distance * cos(direction), p[1] + distance * sin(direction)
