"""SDFormat: a graph of links and joints, as a mechanism is; places relative to frames are resolved first.

Lengths in metres, angles in radians (SDFormat 1.7 to 1.11).
"""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array
from dalembert.interchange.link_graph import Connection, LinkGraph, LinkPart, plain_name
from dalembert.interchange.placements import along, from_quaternion, inverse, placement, roll_pitch_yaw
from dalembert.interchange.xml_tree import Element, parse
from dalembert.model import GROUND

KINDS = {
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "prismatic",
    "ball": "spherical",
    "fixed": "weld",
    "screw": "screw",
}
"""Type of a joint -> type here; universal and revolute2 become two revolutes."""

CROSSED = ("universal", "revolute2")

REFUSED = ("include", "model", "gripper", "static")
"""Parts of a model that replace others."""


def read_sdf(content: bytes, file: str) -> LinkGraph:
    """The graph of the first model of an SDFormat file; raises ModelError with the line for what it cannot have."""
    root = parse(content, file)
    if root.tag != "sdf":
        raise root.error(f"<{root.tag}> is not SDFormat", "an SDFormat file begins with <sdf>")
    world = root.first("world")
    models = [*root.all("model"), *(world.all("model") if world else ())]
    if len(models) != 1:
        raise root.error(f"the file has {len(models)} models", "give a file with one <model>")
    graph = LinkGraph(models[0].get("name"))
    gravity = world.first("gravity") if world else None
    graph.gravity = (0.0, 0.0, -9.8)
    if gravity is not None:
        x, y, z = gravity.numbers(gravity.text, 3)
        graph.gravity = (x, y, z)
    else:
        graph.lose("no <gravity> in the file: SDFormat's default, 9.8 m/s2 along -z")
    return _SdfModel(models[0], graph).graph


class _SdfModel:
    """One model: its frames, resolved; its links and joints."""

    def __init__(self, model: Element, graph: LinkGraph) -> None:
        self.model, self.graph = model, graph
        for tag in REFUSED:
            part = model.first(tag)
            if part is not None and not (tag == "static" and part.text.strip() in ("0", "false")):
                raise part.error(f"<{tag}> has no counterpart", "write its links into the model")
        if model.get("placement_frame"):
            raise model.error("placement_frame is not read", "give the model a <pose>")
        self.elements = {part.get("name"): part for part in model.all("link", "frame", "joint")}
        self.names: dict[str, str] = {"world": GROUND}
        self.places: dict[str, Array] = {"world": np.eye(4)}
        self.pending: list[str] = []
        self.places["__model__"] = self._pose(model, "world")
        for part in model.all("link"):
            self._link(part)
        for part in model.all("frame"):
            self._frame(part)
        for part in model.all("joint"):
            self._joint(part)

    def place(self, name: str, at: Element) -> Array:
        """Placement of a frame in the world."""
        if name in self.places:
            return self.places[name]
        part = self.elements.get(name)
        if part is None:
            raise at.error(f"unknown frame {name!r}", "name a link, joint or frame of the model")
        if name in self.pending:
            raise part.error(f"the place of {name!r} depends on itself", "make it relative to another frame")
        self.pending.append(name)
        base = {"link": "__model__", "frame": part.get("attached_to") or "__model__"}.get(part.tag)
        if base is None:
            base = self._named(part, "child")
        self.places[name] = self._pose(part, base)
        self.pending.pop()
        return self.places[name]

    def _pose(self, part: Element, base: str) -> Array:
        pose = part.first("pose")
        if pose is None:
            return self.place(base, part)
        return self.place(pose.get("relative_to") or base, part) @ pose_of(pose)

    def _named(self, part: Element, tag: str) -> str:
        inner = part.first(tag)
        if inner is None or not inner.text.strip():
            raise part.error(f"<{part.tag}> has no <{tag}>", f"name its {tag}")
        return inner.text.strip()

    def attached(self, name: str, at: Element) -> str:
        """The link, or world, that a frame is fixed to."""
        seen = []
        while name not in ("world", "__model__"):
            part = self.elements.get(name)
            if part is None or name in seen:
                raise at.error(f"frame {name!r} is attached to no link", "name a link of the model")
            seen.append(name)
            if part.tag == "link":
                return self.names[name]
            name = (
                part.get("attached_to") or "__model__" if part.tag == "frame" else self._named(part, "child")
            )
        if name == "__model__":
            links = list(self.model.all("link"))
            return self.names[links[0].get("name")] if links else GROUND
        return GROUND

    def _link(self, part: Element) -> None:
        name = plain_name(part.get("name"), self.graph.links)
        self.names[part.get("name")] = name
        place = self.place(part.get("name"), part)
        inertial = part.first("inertial")
        mass, center, inertia = (1.0, np.zeros(3), np.eye(3)) if inertial is None else _inertial(inertial)
        if inertial is None:
            self.graph.lose(
                f"link {name!r} has no <inertial>: SDFormat's default, 1 kg and 1 kg m2", part.line
            )
        self.graph.links[name] = LinkPart(name, place, mass, center, inertia, line=part.line)
        for tag, what in (("collision", "surfaces"), ("sensor", "sensors"), ("visual", "")):
            if what and part.first(tag) is not None:
                self.graph.lose(f"{what} (<{tag}>)", part.line)

    def _frame(self, part: Element) -> None:
        link = self.attached(part.get("name"), part)
        at = (inverse(self.graph.place(link)) @ self.place(part.get("name"), part))[:3, 3]
        points = self.graph.ground if link == GROUND else self.graph.links[link].points
        points[plain_name(part.get("name"), points)] = at  # type: ignore[index]

    def _joint(self, part: Element) -> None:
        kind, name = part.get("type"), plain_name(part.get("name"), self.graph.joints)
        if kind not in KINDS and kind not in CROSSED:
            raise part.error(f"a {kind} joint has no counterpart", f"use {', '.join([*KINDS, *CROSSED])}")
        parent, child = (self._named(part, tag) for tag in ("parent", "child"))
        here = self.place(part.get("name"), part)
        frame = self.elements.get(parent)
        there = (
            here
            if frame is None or frame.tag == "link"
            else placement(here[:3, :3], self.place(parent, part)[:3, 3])
        )
        links = (self.attached(parent, part), self.attached(child, part))
        axes = [np.eye(3)] if kind in ("ball", "fixed") else [self._axis(part, "axis", here, kind)]
        if kind in CROSSED:
            self._crossed(part, name, links, (there, here), axes[0])
            return
        places = tuple(
            inverse(self.graph.place(link)) @ placement(axes[0], at[:3, 3])
            for link, at in zip(links, (there, here), strict=True)
        )
        more = self._more(part, name, KINDS[kind])
        self.graph.joints[name] = Connection(
            name, KINDS[kind], links, (places[0], places[1]), more, part.line
        )

    def _axis(self, part: Element, tag: str, here: Array, kind: str) -> Array:
        """Axes in the world whose main axis is that of the joint."""
        axis = part.first(tag)
        if axis is None:
            raise part.error(f"a {kind} joint needs an <{tag}>", "give its direction, <xyz>")
        xyz = axis.first("xyz")
        direction = [0.0, 0.0, 1.0] if xyz is None else xyz.numbers(xyz.text, 3)
        if not any(direction):
            raise axis.error("the axis of a joint is 0", "give its direction")
        base = here
        if xyz is not None and xyz.get("expressed_in"):
            base = self.place(xyz.get("expressed_in"), axis)
        for limit in axis.all("limit"):
            if any(inner.tag in ("lower", "upper") for inner in limit.parts):
                self.graph.lose("limits of joints", limit.line)
        return along("x" if kind in ("prismatic", "screw") else "z", base[:3, :3] @ direction)

    def _crossed(
        self, part: Element, name: str, links: tuple[str, str], at: tuple[Array, Array], first: Array
    ) -> None:
        """Two revolutes with a cross without mass between them."""
        second = self._axis(part, "axis2", at[1], "universal")
        middle = plain_name(f"{name} cross", self.graph.links)
        self.graph.links[middle] = LinkPart(middle, placement(np.eye(3), at[1][:3, 3]), line=part.line)
        cross = self.graph.place(middle)
        steps = [(links[0], middle, first, at[0], cross), (middle, links[1], second, cross, at[1])]
        for k, (i, j, axes, on_i, on_j) in enumerate(steps):
            each = plain_name(f"{name} {k + 1}", self.graph.joints)
            places = [
                inverse(self.graph.place(link)) @ placement(axes, where[:3, 3])
                for link, where in ((i, on_i), (j, on_j))
            ]
            self.graph.joints[each] = Connection(
                each, "revolute", (i, j), (places[0], places[1]), line=part.line
            )

    def _more(self, part: Element, name: str, kind: str) -> dict[str, object]:
        more: dict[str, object] = {}
        if kind == "screw":
            pitch, old = part.first("screw_thread_pitch"), part.first("thread_pitch")
            if pitch is not None:
                more["lead"] = pitch.numbers(pitch.text, 1)[0]
            elif old is not None and old.numbers(old.text, 1)[0]:
                more["lead"] = -2 * np.pi / old.numbers(old.text, 1)[0]
            else:
                raise part.error(f"screw {name!r} has no pitch", "give <screw_thread_pitch>")
        axis = part.first("axis")
        dynamics = axis.first("dynamics") if axis else None
        for inner in dynamics.parts if dynamics else ():
            value = inner.numbers(inner.text, 1)[0]
            if not value or inner.tag == "spring_reference":
                continue
            if inner.tag == "damping" and kind in ("revolute", "prismatic"):
                more["damping"] = {"turn" if kind == "revolute" else "slide": value}
            elif inner.tag == "spring_stiffness" and kind == "revolute":
                reference = dynamics.first("spring_reference") if dynamics else None
                free = reference.numbers(reference.text, 1)[0] if reference else 0.0
                spring = {"type": "torsion_spring", "joint": name, "freedom": "turn", "stiffness": value}
                self.graph.loads[f"spring {name}"] = spring | {"free_angle": free}
            else:
                self.graph.lose(f"{inner.tag} of joint {name!r}", inner.line)
        return more


def pose_of(pose: Element) -> Array:
    """A <pose>: x y z and roll pitch yaw, in radians or degrees, or a quaternion."""
    if pose.get("rotation_format") == "quat_xyzw":
        x, y, z, *quaternion = pose.numbers(pose.text, 7)
        qx, qy, qz, qw = quaternion
        return placement(from_quaternion([qw, qx, qy, qz]), [x, y, z])
    values = pose.numbers(pose.text, (6,)) if pose.text.strip() else [0.0] * 6
    unit = np.pi / 180 if pose.get("degrees") in ("true", "1") else 1.0
    return placement(roll_pitch_yaw([a * unit for a in values[3:]]), values[:3])


def _inertial(part: Element) -> tuple[float, Array, Array]:
    """Mass, centre and inertia of an <inertial>; the axes of its pose are those of the inertia."""
    pose, mass, inertia = (part.first(tag) for tag in ("pose", "mass", "inertia"))
    place = np.eye(4) if pose is None else pose_of(pose)
    if pose is not None and pose.get("relative_to"):
        raise pose.error("the pose of an <inertial> is relative to its link", "leave relative_to out")
    about = {} if inertia is None else {p.tag: p.numbers(p.text, 1)[0] for p in inertia.parts}
    xx, yy, zz = (about.get(k, 0.0 if inertia is not None else 1.0) for k in ("ixx", "iyy", "izz"))
    xy, xz, yz = (about.get(k, 0.0) for k in ("ixy", "ixz", "iyz"))
    local = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    rotation = place[:3, :3]
    value = 1.0 if mass is None else mass.numbers(mass.text, 1)[0]
    return value, place[:3, 3], rotation @ local @ rotation.T
