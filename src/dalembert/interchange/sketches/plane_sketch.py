"""A plane linkage by its joints: where each is, and which links it joins; the tree of a model file from it."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.interchange.link_graph import plain_name
from dalembert.interchange.placements import clean
from dalembert.model import GROUND


@dataclass
class SketchJoint:
    """A joint at a place, metres: a pin of all its links, or a slider along an angle on its first link.

    speed: of the second link against the first where the joint is driven, rad/s or m/s. One link: a point of it.
    """

    name: str
    x: float
    y: float
    links: list[str]
    slides_along: float | None = None
    speed: float | None = None
    line: int = 0


@dataclass
class SketchMass:
    """Mass, inertia about its centre, and the centre, all in SI and drawn axes."""

    mass: float
    inertia: float
    x: float
    y: float


@dataclass
class PlaneSketch:
    """Joints in their order, masses by link, loads of the model file, gravity, and what is not kept."""

    title: str
    joints: list[SketchJoint] = field(default_factory=list)
    masses: dict[str, SketchMass] = field(default_factory=dict)
    forces: dict[str, tuple[str, float, float, float, float]] = field(default_factory=dict)
    """Name -> link, place x and y, force x and y."""
    gravity: bool = False
    lost: list[str] = field(default_factory=list)

    def links(self) -> dict[str, list[SketchJoint]]:
        """Joints of each link, ground first; those on the ground before the others."""
        out: dict[str, list[SketchJoint]] = {GROUND: []}
        for joint in self.joints:
            for link in joint.links:
                out.setdefault(link, []).append(joint)
        return {link: sorted(joints, key=lambda j: GROUND not in j.links) for link, joints in out.items()}


Axes = tuple[float, float, float]
"""Origin and angle of a link's axes, as drawn."""


def link_axes(joints: list[SketchJoint]) -> Axes:
    """Axes of a link: from its first joint towards the next one that is elsewhere."""
    first = joints[0]
    other = next((j for j in joints if math.hypot(j.x - first.x, j.y - first.y) > 0), first)
    return first.x, first.y, math.atan2(other.y - first.y, other.x - first.x)


def in_axes(axes: Axes, x: float, y: float) -> list[float]:
    """A drawn point in a link's axes."""
    ox, oy, angle = axes
    c, s = math.cos(angle), math.sin(angle)
    dx, dy = x - ox, y - oy
    return clean(np.array([c * dx + s * dy, c * dy - s * dx]))


def sketch_tree(sketch: PlaneSketch, file: str) -> tuple[Tree, dict[tuple[str | int, ...], int]]:
    """The tree of the model file, and lines; raises ModelError without a fixed point."""
    links = sketch.links()
    if not links[GROUND]:
        raise ModelError("no joint is on the ground", "fix at least one joint", (), file, 1)
    axes = {name: (0.0, 0.0, 0.0) if name == GROUND else link_axes(joints) for name, joints in links.items()}
    tree: Tree = {"dalembert": 1, "title": sketch.title, "gravity": "standard" if sketch.gravity else "none"}
    tree["links"] = {
        name: {"points": {j.name: in_axes(axes[name], j.x, j.y) for j in joints}}
        | _mass(sketch, name, axes[name])
        for name, joints in links.items()
    }
    tree["joints"], tree["drives"], lines = {}, {}, {}
    for joint in sketch.joints:
        for k, second in enumerate(joint.links[1:]):
            first = joint.links[0]
            name = joint.name if k == 0 else plain_name(f"{joint.name}_{k + 1}", tree["joints"])
            keys: Tree = {"type": "pin", "links": [first, second], "at": joint.name}
            if joint.slides_along is not None:
                angles = [math.degrees(axes[link][2]) for link in (first, second)]
                along = math.degrees(joint.slides_along)
                keys |= {"type": "slider", "direction": along - angles[0], "angle": angles[1] - along}
            tree["joints"][name] = keys
            lines["joints", name] = joint.line
            if k == 0 and joint.speed is not None:
                turn = math.degrees(axes[second][2] - axes[first][2])
                slides = joint.slides_along is not None
                speed = f"{joint.speed!r} {'m/s' if slides else 'rad/s'}"
                tree["drives"][name] = {"position": 0 if slides else turn} | (
                    {"speed": speed} if joint.speed else {}
                )
    tree["loads"] = {
        name: {"type": "force", "on": link, "at": in_axes(axes[link], x, y), "value": [fx, fy]}
        for name, (link, x, y, fx, fy) in sketch.forces.items()
    }
    tree["assembly"] = {n: [a[0], a[1], math.degrees(a[2])] for n, a in axes.items() if n != GROUND}
    return tree, {path: line for path, line in lines.items() if line}


def _mass(sketch: PlaneSketch, name: str, axes: Axes) -> Tree:
    of = sketch.masses.get(name)
    if of is None or name == GROUND:
        return {}
    return {"mass": of.mass, "inertia": of.inertia, "center": in_axes(axes, of.x, of.y)}
