"""Simple solids in space, painted in pictures and meshed in 3-D files.

All lengths are in one unit, chosen by the caller (millimetres of paper, or metres). A role classifies a solid, as in a
Scene; transparent solids (a tube around a ball) are a Tube or a Pane.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from dalembert.arrays import Array, Tree

Rotation = Array


@dataclass(frozen=True)
class RoundBar:
    """A round bar from start to end; ``whole``: a sleeve, painted in one piece over the part inside it.

    ``thread``: advance per turn of its thread, negative if left-handed, 0 without a thread.
    """

    start: Array
    end: Array
    radius: float
    role: str = "solid"
    whole: bool = False
    thread: float = 0.0


@dataclass(frozen=True)
class Ball:
    """A sphere."""

    center: Array
    radius: float
    role: str = "solid"


@dataclass(frozen=True)
class Block:
    """A box: the rows of axes (3, 3) are unit vectors, half (3,) its half lengths along them; ``whole`` as above."""

    center: Array
    axes: Array
    half: Array
    role: str = "solid"
    whole: bool = False


@dataclass(frozen=True)
class Plate:
    """A flat convex polygon of corners (n, 3), in order, with a thickness that pictures omit. ``spoke``: a line from
    its middle to the first corner shows its rotation.
    """

    corners: Array
    thickness: float
    role: str = "solid"
    spoke: bool = False


@dataclass(frozen=True)
class Ring:
    """A round bar bent to a circle about an axis."""

    center: Array
    axis: Array
    radius: float
    thickness: float
    role: str = "solid"


@dataclass(frozen=True)
class GlassTube:
    """A transparent cylinder: its end circles and its outline."""

    start: Array
    end: Array
    radius: float
    role: str = "guide"


@dataclass(frozen=True)
class Pane:
    """A transparent flat polygon: its edges."""

    corners: Array
    role: str = "guide"


@dataclass(frozen=True)
class Wire:
    """Thin lines through points (n, 3)."""

    points: Array
    role: str = "guide"


Solid = RoundBar | Ball | Block | Plate | Ring | GlassTube | Pane | Wire

PLACES = ("start", "end", "center", "corners", "points")
DIRECTIONS = ("axes", "axis")
SIZES = ("radius", "half", "thickness", "thread")


def place_solid(solid: Solid, turn: Rotation, at: Array, scale: float = 1.0) -> Solid:
    """A solid enlarged, turned by a matrix (3, 3) and moved.

    >>> ball = place_solid(Ball(np.array([1.0, 0, 0]), 2.0), np.eye(3), np.array([0, 0, 5.0]), scale=3.0)
    >>> ball.center.tolist(), ball.radius
    ([3.0, 0.0, 5.0], 6.0)
    """
    changed: Tree = {}
    for f in fields(solid):
        value = getattr(solid, f.name)
        if f.name in PLACES:
            changed[f.name] = scale * np.asarray(value) @ turn.T + at
        elif f.name in DIRECTIONS:
            changed[f.name] = np.asarray(value) @ turn.T
        elif f.name in SIZES:
            changed[f.name] = scale * value
    return replace(solid, **changed)


def place_solids(solids: Sequence[Solid], turn: Rotation, at: Array, scale: float = 1.0) -> list[Solid]:
    """Solids enlarged, turned and moved together."""
    return [place_solid(s, turn, at, scale) for s in solids]


def across(direction: Array) -> tuple[Array, Array]:
    """Two unit vectors perpendicular to a unit vector and to each other; the three are right-handed.

    >>> [v.tolist() for v in across(np.array([0.0, 0.0, 1.0]))]
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
    """
    e = np.eye(3)[np.abs(direction).argmin()]
    first = e - (e @ direction) * direction
    first = first / np.linalg.norm(first)
    return first, np.cross(direction, first)


def helix(solid: RoundBar, count: int = 24) -> Array:
    """Points (n, 3) of a cylinder's thread, ``count`` per turn."""
    length = float(np.linalg.norm(solid.end - solid.start))
    along = (solid.end - solid.start) / length
    u, v = across(along)
    s = np.linspace(0.0, length, math.ceil(count * length / abs(solid.thread)) + 1)[:, None]
    t = 2 * np.pi * s / solid.thread
    return np.asarray(solid.start + s * along + solid.radius * (np.cos(t) * u + np.sin(t) * v))


def circle(center: Array, axis: Array, radius: float, count: int = 32) -> Array:
    """Points (count + 1, 3) of a circle about an axis, the first repeated at the end."""
    u, v = across(axis / np.linalg.norm(axis))
    t = np.linspace(0.0, 2 * np.pi, count + 1)[:, None]
    return np.asarray(center + radius * (np.cos(t) * u + np.sin(t) * v))
