"""Coordinates of the joints of a graph of links: slides along axes of i, then turns, and their rates.

The placement of j's axes in i's is ``S(s) R_a(q1) R_b(q2)``: slides first, then the first turn about an axis fixed in
i, then a second about one fixed in j (``PAIRS``).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array
from dalembert.interchange.link_graph import Connection, LinkGraph, relative
from dalembert.interchange.placements import to_quaternion, turned
from dalembert.model.joints.pairs import PAIRS

UNITS = np.eye(3)


class Coordinate(NamedTuple):
    """A freedom of a joint, its kind (slide, hinge or ball) and its local axis."""

    freedom: str
    kind: str
    axis: Array


def coordinates(kind: str) -> list[Coordinate]:
    """Coordinates of a type of joint, slides first; of a screw its slide and its turn, which go together."""
    if kind in ("weld", "gear"):
        return []
    pair = PAIRS[kind]
    slides = [f for f in pair.freedoms if f.startswith("slide")]
    turns = [f for f in pair.freedoms if f.startswith("turn")]
    out = [
        Coordinate(freedom, "slide", UNITS["xyz".index(axis)])
        for freedom, axis in zip(slides, pair.slides or "x" * len(slides), strict=True)
    ]
    if pair.ball:
        return [*out, Coordinate("turn", "ball", np.zeros(3))]
    return out + [
        Coordinate(freedom, "hinge", UNITS["xyz".index(axis)])
        for freedom, axis in zip(turns, pair.turns, strict=True)
    ]


def values(graph: LinkGraph, joint: Connection) -> list[float]:
    """The coordinates as drawn; a ball has the four numbers w, x, y, z of its quaternion."""
    place, out = relative(graph, joint), []
    value = coordinates(joint.kind)
    out += [float(c.axis @ place[:3, 3]) for c in value if c.kind == "slide"]
    rotation = place[:3, :3]
    turns = [c.axis for c in value if c.kind == "hinge"]
    for k, axis in enumerate(turns):
        other = turns[1 - k] if len(turns) == 2 else np.roll(axis, 1)
        side, seen = np.cross(axis, other), rotation @ other
        angle = float(np.arctan2(side @ seen, other @ seen))
        out.append(angle)
        rotation = turned(axis, -angle) @ rotation
    if value and value[-1].kind == "ball":
        out += to_quaternion(rotation).tolist()
    return out


def rates(graph: LinkGraph, joint: Connection) -> list[float]:
    """Rates of the coordinates; of a ball the angular velocity in j's axes of the joint."""
    axes_i, axes_j = (graph.place(link) @ at for link, at in zip(joint.links, joint.places, strict=True))
    spins = [_spin(graph, link) for link in joint.links]
    at = axes_j[:3, 3]
    velocities = [link_velocity(graph, link, at) for link in joint.links]
    slid, spun = velocities[1] - velocities[0], spins[1] - spins[0]
    value = coordinates(joint.kind)
    out = [float((axes_i[:3, :3] @ c.axis) @ slid) for c in value if c.kind == "slide"]
    turns = [c.axis for c in value if c.kind == "hinge"]
    if turns:
        lines = [axes_i[:3, :3] @ turns[0]] + [axes_j[:3, :3] @ b for b in turns[1:]]
        out += np.linalg.lstsq(np.array(lines).T, spun, rcond=None)[0].tolist()
    if value and value[-1].kind == "ball":
        out += (axes_j[:3, :3].T @ spun).tolist()
    return out


def _spin(graph: LinkGraph, link: str) -> Array:
    return graph.links[link].spin if link in graph.links else np.zeros(3)


def link_velocity(graph: LinkGraph, link: str, at: Array) -> Array:
    """Velocity of the point of a link, or of ground, that is at a place in ground axes."""
    if link not in graph.links:
        return np.zeros(3)
    solid = graph.links[link]
    return solid.velocity + np.cross(solid.spin, at - solid.place[:3, 3])
