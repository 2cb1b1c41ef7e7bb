"""SDFormat from a graph of links: every joint as it is, loops with it; places at the first position."""

from __future__ import annotations

import numpy as np

from dalembert.errors import ModelError
from dalembert.interchange.joint_chains import split
from dalembert.interchange.link_graph import Connection, LinkGraph, number, relative
from dalembert.interchange.placements import to_roll_pitch_yaw
from dalembert.interchange.xml_text import XmlText, digits
from dalembert.model import GROUND

KINDS = {
    "revolute": "revolute",
    "prismatic": "prismatic",
    "spherical": "ball",
    "weld": "fixed",
    "screw": "screw",
    "universal": "universal",
}
"""Type here -> type of SDFormat; others become chains of these."""

DAMPED = ("revolute", "prismatic")
"""Kinds whose <dynamics> is that of their one freedom."""


def write_sdf(graph: LinkGraph) -> str:
    """The text of an SDFormat file; what it does not keep is noted in the graph."""
    for joint in list(graph.joints.values()):
        if joint.kind == "gear":
            what = f"gear {joint.name!r}: SDFormat's gearbox has no teeth and is not written"
            raise ModelError(what, "leave it out")
        if joint.kind not in KINDS:
            split(graph, joint)
    text = XmlText("written by dalembert: SI and radians, at the first position")
    text.begin("sdf", version="1.9")
    text.begin("world", name="world")
    text.add("gravity", digits(graph.gravity))
    text.begin("model", name=graph.title or "mechanism")
    for name, at in graph.ground.items():
        _frame(text, f"ground.{name}", "world", [*at, 0, 0, 0])
    for link in graph.links.values():
        pose = [*link.place[:3, 3], *to_roll_pitch_yaw(link.place[:3, :3])]
        text.begin("link", name=link.name)
        text.add("pose", digits(pose))
        text.begin("inertial")
        text.add("pose", digits([*link.center, 0, 0, 0]))
        text.add("mass", digits(link.mass))
        text.begin("inertia")
        for key, (i, j) in _ENTRIES.items():
            text.add(key, digits(link.inertia[i, j]))
        for _ in range(3):
            text.end()
        for name, at in link.points.items():
            _frame(text, f"{link.name}.{name}", link.name, [*at, 0, 0, 0])
    for joint in graph.joints.values():
        _joint(text, graph, joint)
    for _ in range(3):
        text.end()
    for name in graph.drives:
        graph.lose(f"drive {name!r}: SDFormat prescribes no motion")
    springs = [_spring(graph, joint) for joint in graph.joints.values()]
    for name, load in graph.loads.items():
        if name not in springs:
            twist = load["type"] == "torsion_spring"
            why = "has one spring for a pin, and for no other joint" if twist else "cannot state forces"
            graph.lose(f"load {name!r} ({load['type']}): SDFormat {why}")
    return str(text)


_ENTRIES = {"ixx": (0, 0), "iyy": (1, 1), "izz": (2, 2), "ixy": (0, 1), "ixz": (0, 2), "iyz": (1, 2)}


def _frame(text: XmlText, name: str, link: str, pose: list[float]) -> None:
    text.begin("frame", name=name, attached_to=link)
    text.add("pose", digits(pose), relative_to=link)
    text.end()


def _joint(text: XmlText, graph: LinkGraph, joint: Connection) -> None:
    """A joint whose frame is that on its child; its zero is the drawn position, which springs are referred to."""
    i, j = joint.links
    if j == GROUND:
        joint = Connection(joint.name, joint.kind, (j, i), joint.places[::-1], joint.more)
        i, j = joint.links
    if joint.more.get("damping") and joint.kind not in DAMPED:
        graph.lose(f"damping of {joint.name!r}")
    text.begin("joint", name=joint.name, type=KINDS[joint.kind])
    text.add("parent", "world" if i == GROUND else i)
    text.add("child", j)
    place = joint.places[1]
    text.add("pose", digits([*place[:3, 3], *to_roll_pitch_yaw(place[:3, :3])]), relative_to=j)
    if joint.kind == "screw":
        text.add("screw_thread_pitch", digits(number(joint.more["lead"], "length")))
    axes = {"revolute": "z", "prismatic": "x", "screw": "x", "universal": "yz"}.get(joint.kind, "")
    for k, axis in enumerate(axes):
        unit = np.eye(3)["xyz".index(axis)]
        if joint.kind == "universal" and k == 0:
            unit = relative(graph, joint)[:3, :3].T @ unit
        text.begin("axis" if k == 0 else "axis2")
        text.add("xyz", digits(unit))
        _dynamics(text, graph, joint)
        text.end()
    text.end()


def _dynamics(text: XmlText, graph: LinkGraph, joint: Connection) -> None:
    """Damping and torsion spring of a pin, damping of a slide."""
    spring = graph.loads.get(_spring(graph, joint))
    damping = joint.more.get("damping", {}) if joint.kind in DAMPED else {}
    if not (damping or spring):
        return
    text.begin("dynamics")
    for freedom, value in damping.items():
        kind = "torsion_damping" if freedom.startswith("turn") else "damping"
        text.add("damping", digits(number(value, kind)))
    if spring:
        turn = relative(graph, joint)[:3, :3]
        drawn, free = (
            float(np.arctan2(turn[1, 0], turn[0, 0])),
            number(spring.get("free_angle", 0.0), "angle"),
        )
        turned = graph.joints[joint.name].links != joint.links
        text.add("spring_stiffness", digits(number(spring["stiffness"], "torsion_stiffness")))
        text.add("spring_reference", digits((-free if turned else free) - drawn))
    text.end()


def _spring(graph: LinkGraph, joint: Connection) -> str:
    """Name of the torsion spring of a pin; empty without one."""
    loads = graph.loads.items() if joint.kind == "revolute" else ()
    return next((n for n, x in loads if x["type"] == "torsion_spring" and x["joint"] == joint.name), "")
