"""A mechanism in space as other programs describe it: links with placements, joints with local axes on both links.

The neutral form between a description and each format: SI and radians, placements as (4, 4) matrices.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.compile.pair_table import geometry
from dalembert.arrays import Array, Tree
from dalembert.errors import FORCED, ModelError
from dalembert.interchange.placements import angle_axis, clean, inverse, placement
from dalembert.model import GROUND, Mechanism
from dalembert.model.joints.pairs import PAIRS

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


@dataclass(frozen=True)
class LinkPart:
    """A link: where it is as drawn, in ground axes, and its mass properties in its local axes."""

    name: str
    place: Array = field(default_factory=lambda: np.eye(4))
    mass: float = 0.0
    center: Array = field(default_factory=lambda: np.zeros(3))
    inertia: Array = field(default_factory=lambda: np.zeros((3, 3)))
    """About the mass centre (3, 3)."""
    points: Mapping[str, Array] = field(default_factory=dict)
    line: int = 0
    velocity: Array = field(default_factory=lambda: np.zeros(3))
    """Position of the origin, in ground axes."""
    spin: Array = field(default_factory=lambda: np.zeros(3))
    """Angular velocity, in ground axes."""


@dataclass(frozen=True)
class Connection:
    """A joint: its kind is a type of the model file, its axes a placement on each of its two links."""

    name: str
    kind: str
    links: tuple[str, str]
    places: tuple[Array, Array]
    more: Tree = field(default_factory=dict)
    """Other keys of the joint: damping, lead, the sizes of a gear."""
    line: int = 0


@dataclass(frozen=True)
class DrivenFreedom:
    """A driven freedom: its name in the joint, position, speed and acceleration."""

    joint: str
    freedom: str
    position: float = 0.0
    speed: float = 0.0
    acceleration: float = 0.0


@dataclass
class LinkGraph:
    """Links without ground, joints, drives; loads as in a model file; what the file says that is not kept."""

    title: str = ""
    source: str = ""
    links: dict[str, LinkPart] = field(default_factory=dict)
    joints: dict[str, Connection] = field(default_factory=dict)
    drives: dict[str, DrivenFreedom] = field(default_factory=dict)
    loads: dict[str, Tree] = field(default_factory=dict)
    gravity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    ground: dict[str, Array] = field(default_factory=dict)
    """Points of the ground."""
    lost: list[str] = field(default_factory=list)
    is_plane: bool = False
    """True if it moves in the plane z = const."""

    def place(self, link: str) -> Array:
        """Placement of a link in ground axes."""
        return np.eye(4) if link == GROUND else self.links[link].place

    def lose(self, what: str, line: int = 0) -> None:
        """Note something that is not kept, once."""
        note = f"line {line}: {what}" if line else what
        if note not in self.lost:
            self.lost.append(note)


def plain_name(text: str, taken: Mapping[str, object]) -> str:
    """A name of the model file that is like a text and not taken.

    >>> plain_name("coupler.0@tip", {})
    'coupler_0_tip'
    """
    name = re.sub(r"[.@/]", "_", "".join(c if c.isprintable() else "_" for c in text)).strip() or "part"
    if name == GROUND and GROUND not in taken:
        name = "ground_link"
    k, out = 2, name
    while out in taken:
        out, k = f"{name}_{k}", k + 1
    return out


def tree_of(graph: LinkGraph) -> Tree:
    """The tree of the model file: each joint has a point of its name on both links."""
    points: dict[str, Tree] = {name: {} for name in (GROUND, *graph.links)}
    for name, place in graph.ground.items():
        points[GROUND][name] = clean(place)
    for link in graph.links.values():
        points[link.name].update({name: clean(place) for name, place in link.points.items()})
    joints = {}
    for joint in graph.joints.values():
        at: list[str] = []
        for link_name, place in zip(joint.links, joint.places, strict=True):
            at.append(_point(points[link_name], joint.name, place[:3, 3]))
        joints[joint.name] = _joint(joint, at)
    return {
        "dalembert": 1,
        "title": graph.title,
        "source": graph.source,
        "space": "space",
        "units": {"angle": "rad"},
        "gravity": list(graph.gravity) if any(graph.gravity) else "none",
        "links": {GROUND: {"points": points[GROUND]}}
        | {link.name: _link(link, points[link.name]) for link in graph.links.values()},
        "joints": joints,
        "drives": {name: _drive(drive) for name, drive in graph.drives.items()},
        "loads": graph.loads,
        "assembly": {link.name: _pose(link.place) for link in graph.links.values()},
    }


def _point(points: Tree, name: str, at: Array) -> str:
    """Name of the point of a link where a joint is: an existing one, or a new one."""
    for known, place in points.items():
        if np.allclose(place, at, rtol=0, atol=1e-15):
            return known
    new = plain_name(name, points)
    points[new] = clean(at)
    return new


def _link(link: LinkPart, points: Tree) -> Tree:
    tree: Tree = {"points": points}
    if link.mass:
        tree |= {"mass": link.mass, "center": clean(link.center)}
    if link.inertia.any():
        inertia = (link.inertia + link.inertia.T) / 2  # of a turned one the two sides differ by rounding
        diagonal = not (inertia - np.diag(np.diag(inertia))).any()
        rows = np.diag(inertia).tolist() if diagonal else inertia.tolist()
        tree |= {"inertia": rows, "center": clean(link.center)}
    return tree


def _joint(joint: Connection, at: list[str]) -> Tree:
    tree: Tree = {"type": joint.kind, "links": list(joint.links), "at": at}
    if joint.kind == "gear":
        axes = {key: {"z": clean(place[:3, 2])} for key, place in zip("ij", joint.places, strict=True)}
    else:
        axes = {
            key: {"x": clean(place[:3, 0]), "z": clean(place[:3, 2])}
            for key, place in zip("ij", joint.places, strict=True)
        }
    bare = all(np.array_equal(place[:3, :3], np.eye(3)) for place in joint.places)
    if joint.kind == "revolute" and bare:
        tree["axis"] = [0.0, 0.0, 1.0]
    elif not (joint.kind in ("weld", "spherical") and bare):
        tree["axes"] = axes
    return tree | joint.more


def _drive(drive: DrivenFreedom) -> Tree:
    rate = "m/s" if drive.freedom.startswith("slide") else "rad/s"
    tree: Tree = {"joint": drive.joint, "freedom": drive.freedom, "position": drive.position}
    if drive.speed:
        tree["speed"] = f"{drive.speed!r} {rate}"
    if drive.acceleration:
        tree["acceleration"] = f"{drive.acceleration!r} {rate}^2" if rate == "rad/s" else drive.acceleration
    return tree


def _pose(place: Array) -> Tree:
    angle, axis = angle_axis(place[:3, :3])
    return {"position": clean(place[:3, 3]), "axis": clean(axis), "angle": angle}


def graph_of(m: Mechanism) -> LinkGraph:
    """The links and joints of a mechanism at its first position; a planar one is lifted.

    Raises ModelError where that position is not solved.
    """
    from dalembert.analysis.lift import lifted
    from dalembert.analysis.solution import kinematics

    space = m if m.space == "space" else lifted(m)
    graph = drawn_graph(kinematics(space), 0)
    graph.is_plane = m.space == "plane"
    return graph


def drawn_graph(result: Result, k: int) -> LinkGraph:
    """The links and joints of a solved mechanism in space at its position of index k."""
    from dalembert.analysis.lift import in_numbers

    space = result.mechanism
    if result.status[k] not in FORCED:
        what = f"position {k + 1} has no pose to write: {result.reasons[k] or result.status[k]}"
        raise ModelError(what, "give a range of drives that begins where the linkage closes")
    graph = LinkGraph(space.title, space.source_text, gravity=_three(space.gravity_vector))
    graph.ground = {name: np.array(at) for name, at in space.points(GROUND).items()}
    for name in result.links:
        graph.links[name] = LinkPart(
            name,
            placement(result.rotation(name)[k], result.position(name)[k]),
            space.mass(name),
            np.array(space.center(name)),
            inertia_matrix(space.inertia(name)),
            {point: np.array(at) for point, at in space.points(name).items()},
            velocity=result.velocity(name)[k],
            spin=result.speed(name)[k],
        )
    for name in space.joints:
        graph.joints[name] = _connection(space, name)
    for name, drive in space.drives.items():
        joint = space.drive_joint(name)
        freedom = drive.freedom or space.joints[joint].freedoms[0]
        values = (result.drive_position, result.drive_speed, result.drive_acceleration)
        graph.drives[name] = DrivenFreedom(joint, freedom, *(float(of(name)[k]) for of in values))
    graph.loads = {name: load.model_dump(mode="json") for name, load in in_numbers(space).loads.items()}
    return graph


def inertia_matrix(value: Any) -> Array:
    """Inertia (3, 3) from none, one value about every axis, three principal values, or a matrix."""
    if value is None:
        return np.zeros((3, 3))
    rows = np.array(value, float)
    return np.asarray(rows * np.eye(3) if rows.ndim < 2 else rows)


def number(value: Any, kind: str) -> float:
    """A number in SI from a value of a tree, which may be a text with its unit."""
    from dalembert.units import quantity

    return quantity(value, kind, None)


def _three(vector: Any) -> tuple[float, float, float]:
    x, y, z = (float(c) for c in vector)
    return x, y, z


def _connection(m: Mechanism, name: str) -> Connection:
    joint: Any = m.joints[name]
    frames, points, pair = joint.frames, m.joint_points(name), getattr(joint, "pair", None)
    if pair is not None:
        frames = geometry(joint, *map(np.array, points))[2:]
    places = [placement(np.array(axes).T, at) for axes, at in zip(frames, points, strict=True)]
    keys = joint.model_dump(mode="json")
    more = {k: v for k, v in keys.items() if k not in ("type", "links", "at", "axes", "axis") and v}
    kind = joint.type
    if kind == "gear":
        more["pitch_radii"] = list(joint.pitch_radii)
    if pair is not None and pair != PAIRS.get(kind, pair):
        what = f"joint {name!r}: a {kind} joint with another blocked turn is not written"
        raise ModelError(what, "turn its axes so that x is blocked", ("joints", name))
    return Connection(name, kind, joint.links, (places[0], places[1]), more)


def relative(graph: LinkGraph, joint: Connection) -> Array:
    """Placement of the joint's axes on j in its axes on i, as drawn."""
    i, j = (graph.place(link) @ place for link, place in zip(joint.links, joint.places, strict=True))
    out: Array = inverse(i) @ j
    return out


def flipped(joint: Connection) -> Connection:
    """The same joint from j to i: its turns and slides change their signs."""
    return replace(joint, links=joint.links[::-1], places=joint.places[::-1])
