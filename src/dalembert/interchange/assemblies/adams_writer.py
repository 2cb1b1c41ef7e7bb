"""Command files of Adams View (.cmd), from a graph of links.

Parts have markers whose z is the axis of a joint; a joint and its motion measure the marker I, here on j, against the
marker J; a single force acts at I along the z of J. Metres, newtons, kilograms, seconds; body-fixed 313 angles.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable

import numpy as np

from dalembert.arrays import Array, Tree
from dalembert.errors import ModelError
from dalembert.interchange.assemblies.adams_commands import KINDS, MODEL, CommandText
from dalembert.interchange.assemblies.ondsel_writer import law_of_time, marker_places, principal_inertia
from dalembert.interchange.joint_chains import split
from dalembert.interchange.link_graph import Connection, DrivenFreedom, LinkGraph, LinkPart, number
from dalembert.interchange.placements import along, placement, to_body_313
from dalembert.model import GROUND

DRIVEN = ("revolute", "prismatic", "cylindrical", "screw")
"""Types that a motion can drive."""


def write_adams(graph: LinkGraph) -> str:
    """The text of a command file; what it does not keep is noted in the graph."""
    for joint in list(graph.joints.values()):
        if joint.kind == "gear":
            what = f"gear {joint.name!r}: the gears of Adams have no teeth whose force could be the same"
            raise ModelError(what, "leave it out")
        if joint.kind not in KINDS:
            split(graph, joint)
        for key in ("damping", "stiffness"):
            if joint.more.get(key):
                graph.lose(f"{key} of {joint.name!r}")
    return str(_WrittenModel(graph))


class _WrittenModel(CommandText):
    """The commands of one model, in their order."""

    def __init__(self, graph: LinkGraph) -> None:
        super().__init__()
        self.graph = graph
        self.axes = ""
        units = {"length": "meter", "angle": "deg", "force": "newton", "mass": "kg", "time": "sec"}
        self.add("defaults units", units)
        self.add("defaults units", {"coordinate_system_type": "cartesian", "orientation_type": "body313"})
        title = re.sub(r'[^ -~]|"', "_", graph.title)
        self.add("model create", {"model_name": MODEL} | ({"title": f'"{title}"'} if title else {}))
        self.name("", GROUND)
        self.parts = {GROUND: GROUND} | {link: self.name("", link) for link in graph.links}
        self.joints = {joint: self.name("", joint) for joint in graph.joints}
        for old, new in (*self.parts.items(), *self.joints.items()):
            if old != new:
                graph.lose(f"the name {old!r}, which is {new!r} in the file")
        for link in (LinkPart(GROUND, points=graph.ground), *graph.links.values()):
            self._part(link)
        for joint in graph.joints.values():
            self._joint(joint)
        for name, drive in graph.drives.items():
            self._motion(name, drive)
        for name, load in graph.loads.items():
            self._load(name, load)
        keys = {
            f"{axis}_component_gravity": repr(float(g)) for axis, g in zip("xyz", graph.gravity, strict=True)
        }
        field = {"gravity_field_name": self.name("", "gravity")}
        self.add("force create body gravitational", field | keys)

    def part_of(self, link: str) -> str:
        """The full name of a link's part."""
        return f".{MODEL}.{self.parts[link]}"

    def marker(self, link: str, text: str, place: Array) -> str:
        """The full name of a new marker of a link, its place in the link's axes."""
        full = f"{self.part_of(link)}.{self.name(link, text)}"
        self._in_axes_of(link)
        self.add("marker create", {"marker_name": full} | _pose(place))
        return full

    def _in_axes_of(self, link: str) -> None:
        """Locations that follow are in the axes of a link's part."""
        if self.axes != link:
            self.axes = link
            self.add("defaults coordinate_system", {"default_coordinate_system": self.part_of(link)})

    def _part(self, link: LinkPart) -> None:
        if link.name != GROUND:
            self._in_axes_of(GROUND)
            part = {"part_name": self.part_of(link.name)}
            self.add("part create rigid_body name_and_position", part | _pose(link.place))
            diagonal = not (link.inertia - np.diag(np.diag(link.inertia))).any()
            moments, axes = (np.diag(link.inertia), np.eye(3)) if diagonal else principal_inertia(link)
            center = self.marker(link.name, "cm", placement(axes, link.center))
            mass = {"mass": repr(float(link.mass)), "center_of_mass_marker": center, "inertia_marker": center}
            about = {f"i{a}{a}": repr(float(moment)) for a, moment in zip("xyz", moments, strict=True)}
            self.add("part create rigid_body mass_properties", part | mass | about)
        for name, at in link.points.items():
            self.marker(link.name, name, placement(np.eye(3), at))

    def _joint(self, joint: Connection) -> None:
        """A joint between its markers; a screw holds only its advance, and a cylindrical joint the rest."""
        j, i = (
            self.marker(link, f"{joint.name}_joint", place)
            for link, place in zip(joint.links, marker_places(joint), strict=True)
        )
        ends = {"i_marker_name": i, "j_marker_name": j}
        kind = "cylindrical" if joint.kind == "screw" else KINDS[joint.kind]
        self.add(
            f"constraint create joint {kind}", {"joint_name": f".{MODEL}.{self.joints[joint.name]}"} | ends
        )
        if joint.kind == "screw":
            thread = {"joint_name": f".{MODEL}.{self.name('', f'{joint.name}_thread')}"}
            pitch = {"pitch": repr(number(joint.more["lead"], "length"))}
            self.add("constraint create joint screw", thread | ends | pitch)

    def _motion(self, name: str, drive: DrivenFreedom) -> None:
        kind = self.graph.joints[drive.joint].kind
        if kind not in DRIVEN:
            what = f"drive {name!r}: a motion of Adams drives no {kind} joint"
            raise ModelError(what, "drive a pin or a slide", ("drives", name))
        label = f"motion_{self.joints[name]}" if name in self.joints else name
        slides = drive.freedom.startswith("slide")
        keys = {
            "motion_name": f".{MODEL}.{self.name('', label)}",
            "joint_name": f".{MODEL}.{self.joints[drive.joint]}",
            "type_of_freedom": "translational" if slides else "rotational",
            "function": f'"{law_of_time(drive)}"',
        }
        self.add("constraint create motion_generator", keys)

    def _load(self, name: str, load: Tree) -> None:
        """A force or couple of constant components, along the z of a marker of ground, or of the link itself."""
        link = str(load.get("on", ""))
        kind = {"force": "force", "couple": "moment"}.get(load["type"], "")
        value = _vector(load, kind) if kind and link in self.graph.links else None
        if value is None:
            why = "its value changes or is unknown" if kind else "only forces and couples are written"
            self.graph.lose(f"load {name!r} ({load['type']}): {why}")
            return
        if load.get("by"):
            self.graph.lose(f"by of load {name!r}")
        at = self._place(link, load.get("at"))
        size = float(np.linalg.norm(value))
        axes = along("z", value) if size else np.eye(3)
        base = link if load.get("axes") == "link" else GROUND
        there = at if base == link else (self.graph.place(link) @ placement(np.eye(3), at))[:3, 3]
        i = self.marker(link, name, placement(np.eye(3), at))
        j = self.marker(base, f"{name}_line", placement(axes, there))
        keys = {
            "single_component_force_name": f".{MODEL}.{self.name('', name)}",
            "type_of_freedom": "translational" if kind == "force" else "rotational",
            "i_marker_name": i,
            "j_marker_name": j,
            "action_only": "on",
            "function": f'"{size!r}"',
        }
        self.add("force create direct single_component_force", keys)

    def _place(self, link: str, at: object) -> Array:
        """A point of a link in its axes: of a name, the mass centre, or three lengths."""
        part = self.graph.links[link]
        if at is None or at == "center":
            return part.center
        if isinstance(at, (list, tuple)):
            return np.array([number(x, "length") for x in at])
        return part.points[str(at)]


def _vector(load: Tree, kind: str) -> Array | None:
    """Components of a load in its axes; none where they change along the motion, or are unknown."""
    value = load["value"]
    try:
        if isinstance(value, list):
            return np.array([number(x, kind) for x in value])
        direction = np.array(load["direction"], float)
        return number(value, kind) * direction / np.linalg.norm(direction)
    except (ModelError, TypeError):
        return None


def _pose(place: Array) -> dict[str, str]:
    angles = (f"{math.degrees(angle)!r}D" for angle in to_body_313(place[:3, :3]))
    return {"location": _row(place[:3, 3]), "orientation": ", ".join(angles)}


def _row(numbers: Iterable[float]) -> str:
    return ", ".join(repr(float(x) + 0.0) for x in numbers)
