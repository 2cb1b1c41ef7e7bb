"""URDF: a tree of links; loops come from a file beside it, or not at all.

Lengths in metres, angles in radians. The gravity of a URDF is its program's: here 9.81 m/s2 along -z.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.interchange.couplings import coupled_wheels
from dalembert.interchange.link_graph import Connection, DrivenFreedom, LinkGraph, LinkPart, plain_name
from dalembert.interchange.placements import along, placement, roll_pitch_yaw
from dalembert.interchange.xml_tree import Element, parse
from dalembert.model import GROUND

KINDS = {"revolute": "revolute", "continuous": "revolute", "prismatic": "prismatic", "fixed": "weld"}
"""Type of a joint -> type here; floating joints leave their link free."""

LOOPS = {"3d": "spherical", "6d": "weld"}
"""Kind of a closed loop in the file NAME.loops.yaml -> type here."""

ACTUATED = ("transmission", "ros2_control")


def read_urdf(content: bytes, file: str) -> LinkGraph:
    """The graph of a URDF file, closed by NAME.loops.yaml beside it if there is one; raises ModelError."""
    root = parse(content, file)
    if any("xacro:" in part.tag for part in root.walk()):
        raise root.error("this is a xacro file, not URDF", "expand it first: xacro FILE.xacro > FILE.urdf")
    if root.tag != "robot":
        raise root.error(f"<{root.tag}> is not URDF", "a URDF file begins with <robot>")
    graph = LinkGraph(root.get("name"), gravity=(0.0, 0.0, -9.81))
    _UrdfTree(root, graph).read()
    _read_loops(graph, Path(file))
    return graph


class _UrdfTree:
    """Links and joints of a robot; the root link is ground."""

    def __init__(self, root: Element, graph: LinkGraph) -> None:
        self.root, self.graph = root, graph
        self.links = {part.get("name"): part for part in root.all("link")}
        self.joints = [part for part in root.all("joint") if part.get("type")]
        self.names: dict[str, str] = {}
        self.joint_names: dict[str, str] = {}

    def read(self) -> None:
        """Every link from the root on."""
        children: dict[str, list[Element]] = {}
        reached = set()
        for joint in self.joints:
            parent, child = (_link_name(joint, tag) for tag in ("parent", "child"))
            for name in (parent, child):
                if name not in self.links:
                    raise joint.error(f"unknown link {name!r}", "name a <link> of the file")
            if child in reached:
                raise joint.error(
                    f"link {child!r} has two parents, which URDF does not allow", "cut the loop"
                )
            reached.add(child)
            children.setdefault(parent, []).append(joint)
        roots = [name for name in self.links if name not in reached]
        if len(roots) != 1:
            raise self.root.error(f"{len(roots)} links have no parent", "leave one root link")
        self._root(roots[0], bool(children.get(roots[0])))
        waiting = list(reversed(children.get(roots[0], [])))
        while waiting:
            joint = waiting.pop()
            self._joint(joint)
            waiting += reversed(children.get(_link_name(joint, "child"), []))
        for joint in self.joints:
            self._mimic(joint)
        for part in self.root.parts:
            if part.tag in ACTUATED:
                self.graph.lose(f"<{part.tag}>: drives are for you to name", part.line)
            elif part.tag == "gazebo" and any("joint" in inner.tag for inner in part.walk()):
                self.graph.lose("<gazebo> with a joint: a loop of Gazebo stays open", part.line)

    def _root(self, name: str, is_fixed: bool) -> None:
        self.names[name] = GROUND
        part = self.links[name]
        self.graph.lose(
            f"the root link {name!r} is ground" + (", with its mass" if part.first("inertial") else "")
        )
        if not is_fixed:
            raise part.error("the file has one link and no joint", "give joints")

    def _joint(self, part: Element) -> None:
        kind, graph = part.get("type"), self.graph
        name = plain_name(part.get("name"), graph.joints)
        self.joint_names[part.get("name")] = name
        parent, child = self.names[_link_name(part, "parent")], _link_name(part, "child")
        link = plain_name(child, graph.links)
        self.names[child] = link
        origin = _origin(part.first("origin"))
        graph.links[link] = self._solid(self.links[child], link, graph.place(parent) @ origin)
        if kind == "floating":
            return
        if kind not in (*KINDS, "planar"):
            raise part.error(f"a {kind} joint has no counterpart", f"use {', '.join(KINDS)}")
        axis = part.first("axis")
        direction = [1.0, 0.0, 0.0] if axis is None else axis.vector("xyz", 3, [1.0, 0.0, 0.0])
        if not any(direction) and kind != "fixed":
            raise part.error("the axis of a joint is 0", "give its direction")
        rotation = (
            np.eye(3)
            if kind == "fixed"
            else along("z" if kind in ("revolute", "continuous") else "x", direction)
        )
        axes = placement(rotation, [0, 0, 0])
        more: dict[str, object] = {}
        dynamics = part.first("dynamics")
        if dynamics is not None and dynamics.number("damping", 0.0) and kind != "planar":
            more["damping"] = {"slide" if kind == "prismatic" else "turn": dynamics.number("damping")}
        if dynamics is not None and dynamics.number("friction", 0.0):
            graph.lose(f"friction of joint {name!r}", dynamics.line)
        if part.first("limit") is not None and kind != "continuous":
            graph.lose("limits of joints")
        places = (origin @ axes, axes)
        kinds = {**KINDS, "planar": "plane"}
        graph.joints[name] = Connection(name, kinds[kind], (parent, link), places, more, part.line)

    def _solid(self, part: Element, name: str, place: Array) -> LinkPart:
        for tag, what in (("collision", "surfaces (<collision>)"), ("visual", "")):
            if what and part.first(tag) is not None:
                self.graph.lose(what)
        inertial = part.first("inertial")
        if inertial is None:
            return LinkPart(name, place, line=part.line)
        at, mass, about = _origin(inertial.first("origin")), inertial.first("mass"), inertial.first("inertia")
        value = 0.0 if mass is None else mass.number("value")
        local = np.zeros((3, 3))
        for key, (i, j) in _ENTRIES.items():
            local[i, j] = local[j, i] = 0.0 if about is None else about.number(key, 0.0)
        rotation = at[:3, :3]
        return LinkPart(name, place, value, at[:3, 3], rotation @ local @ rotation.T, line=part.line)

    def _mimic(self, part: Element) -> None:
        """A joint that follows another: a gear of that ratio, where there is one."""
        mimic = part.first("mimic")
        if mimic is None:
            return
        leader = self.joint_names.get(mimic.get("joint"))
        if leader is None:
            raise mimic.error(f"unknown joint {mimic.get('joint')!r}", "name a joint of the file")
        follower, ratio = self.joint_names[part.get("name")], mimic.number("multiplier", 1.0)
        name = plain_name(f"mimic {follower}", self.graph.joints)
        wheels = coupled_wheels(self.graph, (leader, "turn"), (follower, "turn"), ratio, mimic)
        self.graph.joints[name] = replace(wheels, name=name)
        self.graph.lose(f"<mimic> of {follower!r} is a gear: its teeth press the axes apart", mimic.line)
        if mimic.number("offset", 0.0):
            self.graph.lose(f"offset of {follower!r}: gears mesh as drawn", mimic.line)


_ENTRIES = {"ixx": (0, 0), "iyy": (1, 1), "izz": (2, 2), "ixy": (0, 1), "ixz": (0, 2), "iyz": (1, 2)}


def _link_name(joint: Element, tag: str) -> str:
    part = joint.first(tag)
    if part is None:
        raise joint.error(f"joint {joint.get('name')!r} has no <{tag}>", f"name its {tag} link")
    return part.get("link")


def _origin(part: Element | None) -> Array:
    if part is None:
        return np.eye(4)
    zero = [0.0, 0.0, 0.0]
    return placement(roll_pitch_yaw(part.vector("rpy", 3, zero)), part.vector("xyz", 3, zero))


def _read_loops(graph: LinkGraph, path: Path) -> None:
    """Loops of NAME.loops.yaml beside NAME.urdf: pairs of frames, a frame being the child link of the joint of its
    name."""
    from dalembert.model.files import yaml_text

    beside = path.with_suffix(".loops.yaml")
    if not beside.is_file():
        graph.lose("URDF has no loops: what is open in the file stays open")
        return
    if beside.stat().st_size > 100_000:
        raise ModelError("the file of loops is too large", "give pairs of frames", (), str(beside), 1)
    tree, _ = yaml_text.read(beside.read_text(encoding="utf-8"))
    keys = tree if isinstance(tree, dict) else {}
    pairs, kinds, motors = (keys.get(key, []) for key in ("closed_loop", "type", "name_mot"))
    if not isinstance(pairs, list) or not isinstance(kinds, list) or len(pairs) != len(kinds):
        what = "closed_loop and type are not lists of one length"
        raise ModelError(what, "write closed_loop: [[A, B]] and type: [6d]", (), str(beside), 1)
    for pair, kind in zip(pairs, kinds, strict=True):
        if str(kind) not in LOOPS or not isinstance(pair, list) or len(pair) != 2:
            raise ModelError(
                f"loop {pair} of type {kind} is not supported", "use 3d or 6d", (), str(beside), 1
            )
        ends = []
        for frame in map(str, pair):
            joint = graph.joints.get(plain_name(frame, {}))
            end = joint.links[1] if joint else plain_name(frame, {})
            if end not in graph.links:
                what = f"the robot has no joint or link {frame!r} that would be the end of a loop"
                raise ModelError(what, "name joints or links of the URDF file", (), str(beside), 1)
            ends.append(end)
        name = plain_name(f"loop {pair[0]}", graph.joints)
        graph.joints[name] = Connection(name, LOOPS[str(kind)], (ends[0], ends[1]), (np.eye(4), np.eye(4)))
    for motor in motors if isinstance(motors, list) else ():
        joint = graph.joints.get(plain_name(str(motor), {}))
        freedom = {"revolute": "turn", "prismatic": "slide"}.get(joint.kind if joint else "")
        if joint and freedom:
            graph.drives[joint.name] = DrivenFreedom(joint.name, freedom)
