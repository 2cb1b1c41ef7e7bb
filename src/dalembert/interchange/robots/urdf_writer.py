"""URDF from a graph of links: its tree at zero of all joints; loops are cut, and noted."""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array
from dalembert.interchange.joint_coordinates import Coordinate, coordinates
from dalembert.interchange.link_graph import Connection, LinkGraph, LinkPart, number, plain_name
from dalembert.interchange.placements import inverse, to_roll_pitch_yaw
from dalembert.interchange.spanning_tree import spanning_tree
from dalembert.interchange.xml_text import XmlText, digits
from dalembert.model import GROUND

ENTRIES = {"ixx": (0, 0), "iyy": (1, 1), "izz": (2, 2), "ixy": (0, 1), "ixz": (0, 2), "iyz": (1, 2)}

TYPES = {"hinge": "continuous", "slide": "prismatic"}


def write_urdf(graph: LinkGraph) -> str:
    """The text of a URDF file; what it does not keep is noted in the graph.

    A URDF link has its axes at the joint to its parent: masses and joints are written in those.
    """
    tree = spanning_tree(graph)
    text = XmlText("written by dalembert: SI and radians; URDF has no loops and no positions")
    text.begin("robot", name=graph.title or "mechanism")
    text.add("link", name="world")
    axes = {GROUND: np.eye(4)}
    names: dict[str, object] = {"world": None} | dict.fromkeys(graph.links)
    for joint in tree.branches:
        axes[joint.links[1]] = joint.places[1]
        _branch(text, joint, joint.name in tree.turned, axes, names)
        _link(text, graph.links[joint.links[1]], inverse(joint.places[1]))
        if joint.kind == "screw":
            graph.lose(f"thread of {joint.name!r}: URDF has its turn and its slide, each by itself")
    text.end()
    for joint in tree.cut:
        graph.lose(f"joint {joint.name!r} ({joint.kind}), which closes a loop: URDF has none")
    graph.lose("positions: URDF is drawn at zero of all joints")
    for name in graph.drives:
        graph.lose(f"drive {name!r}")
    for name, load in graph.loads.items():
        graph.lose(f"load {name!r} ({load['type']})")
    if any(graph.gravity):
        graph.lose("gravity: that of the program that reads it")
    return str(text)


def _link(text: XmlText, link: LinkPart, to_axes: Array) -> None:
    text.begin("link", name=link.name)
    if link.mass:
        rotation = to_axes[:3, :3]
        center = rotation @ link.center + to_axes[:3, 3]
        inertia = rotation @ link.inertia @ rotation.T
        text.begin("inertial")
        text.add("origin", xyz=digits(center), rpy="0 0 0")
        text.add("mass", value=digits(link.mass))
        text.add("inertia", **{key: digits(inertia[i, j]) for key, (i, j) in ENTRIES.items()})
        text.end()
    text.end()


def steps(joint: Connection, is_flipped: bool) -> list[Coordinate]:
    """Coordinates of a branch, a ball as turns about x, y and z; from j to i in the other order, with other signs."""
    out: list[Coordinate] = []
    for one in coordinates(joint.kind):
        if one.kind == "ball":
            out += [Coordinate(f"turn {k}", "hinge", axis) for k, axis in zip("xyz", np.eye(3), strict=True)]
        else:
            out.append(one)
    return [c._replace(axis=-c.axis) for c in reversed(out)] if is_flipped else out


def _branch(
    text: XmlText, joint: Connection, is_flipped: bool, axes: dict[str, Array], names: dict[str, object]
) -> None:
    """A joint of URDF for each coordinate, with links without mass between them."""
    i, j = joint.links
    parent, home = "world" if i == GROUND else i, inverse(axes[i]) @ joint.places[0]
    chain = steps(joint, is_flipped)
    for k, coordinate in enumerate(chain or [None]):
        last = k >= len(chain) - 1
        child = j if last else plain_name(f"{joint.name} {k + 1}", names)
        names[child] = None
        if not last:
            text.add("link", name=child)
        name = joint.name if len(chain) <= 1 else f"{joint.name} {coordinate.freedom if coordinate else ''}"
        text.begin("joint", name=name, type=TYPES[coordinate.kind] if coordinate else "fixed")
        text.add("parent", link=parent)
        text.add("child", link=child)
        text.add("origin", xyz=digits(home[:3, 3]), rpy=digits(to_roll_pitch_yaw(home[:3, :3])))
        if coordinate:
            text.add("axis", xyz=digits(coordinate.axis))
            damping = joint.more.get("damping", {}).get(coordinate.freedom)
            if damping:
                kind = "torsion_damping" if coordinate.kind == "hinge" else "damping"
                text.add("dynamics", damping=digits(number(damping, kind)))
        text.end()
        parent, home = child, np.eye(4)
