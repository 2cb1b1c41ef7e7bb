"""Command files of Adams View (.cmd): the commands of the writer, as others write them too.

Locations are in the axes of ``relative_to``, else of the default coordinate system, which is ground until it is set.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.interchange.assemblies.adams_commands import (
    KEYS,
    KINDS,
    Command,
    begins,
    note_of,
    of_time,
    read_commands,
    units_of,
)
from dalembert.interchange.assemblies.adams_writer import DRIVEN
from dalembert.interchange.assemblies.ondsel_writer import ALONG_X, X_TO_Z
from dalembert.interchange.joint_coordinates import coordinates, values
from dalembert.interchange.link_graph import (
    Connection,
    DrivenFreedom,
    LinkGraph,
    LinkPart,
    plain_name,
)
from dalembert.interchange.placements import body_313, clean, inverse
from dalembert.model import GROUND

JOINTS = {theirs: kind for kind, theirs in KINDS.items()}
"""Joint type of Adams -> ours."""


@dataclass
class _Part:
    """A part: its name, place in ground axes, line; its markers in its axes, and those that something is fixed to."""

    name: str
    place: Array
    line: int = 0
    markers: dict[str, Array] = field(default_factory=dict)
    used: set[str] = field(default_factory=set)


def read_adams(content: bytes, file: str) -> LinkGraph:
    """The graph of a command file; raises ModelError with the line for what it cannot have."""
    model = _AdamsModel()
    for command in read_commands(content, file):
        model.read(command)
    if not model.name:
        raise ModelError("the file makes no model of Adams", "begin it with `model create`", (), file, 1)
    model.finish()
    return model.graph


class _AdamsModel:
    """One model: parts and markers at once, what joins and moves them when all commands are known."""

    def __init__(self) -> None:
        self.graph, self.name = LinkGraph(), ""
        self.base: tuple[str, ...] = (GROUND,)
        self.units = {"length": 1e-3, "angle": np.pi / 180, "force": 1.0, "mass": 1.0, "time": 1.0}
        self.parts = {GROUND: _Part(GROUND, np.eye(4))}
        self.later: dict[tuple[str, str], Command] = {}
        self.is_local = False
        self.steps = {
            "constraint create joint": self._joint,
            "constraint create joint screw": self._thread,
            "constraint create motion_generator": self._motion,
            "force create direct": self._force,
            "force create body": self._gravity,
        }

    def read(self, command: Command) -> None:
        """Read one command."""
        head = command.head
        note = note_of(command)
        if note is not None:
            if note:
                self.graph.lose(note, command.line)
            return
        if head == "model create":
            self._model(command)
        elif head == "defaults units":
            if len(self.parts) > 1 or self.later:
                raise command.error("units change behind the first part", "set them before")
            self.units |= units_of(command)
        elif head == "defaults coordinate_system":
            self.base, self.is_local = self._path(command, "default_coordinate_system"), True
        elif head == "marker create":
            part, marker = self._marker_path(command, "marker_name")
            if not (self.is_local or "relative_to" in command.keys or np.array_equal(part.place, np.eye(4))):
                self.graph.lose("axes of parts: without default_coordinate_system markers are in ground axes")
            old = part.markers.get(marker, inverse(part.place))
            part.markers[marker] = self._placed(command, part, old)
        elif head.endswith("name_and_position"):
            name = self._path(command, "part_name")[-1]
            if name == GROUND:
                raise command.error("the ground part is moved", "leave it where it is")
            part = self.parts.setdefault(name, _Part(name, np.eye(4), command.line))
            part.place = self._placed(command, self.parts[GROUND], part.place)
        else:
            key = (head, self._path(command, KEYS[head].split()[0])[-1])
            if head.endswith("mass_properties") and key[1] not in self.parts:
                raise command.error(f"there is no part {key[1]!r}", "make it first")
            if key in self.later:
                command = replace(command, keys=self.later[key].keys | command.keys)
            self.later[key] = command

    def finish(self) -> None:
        """Read masses, then joints with their threads, motions, forces, gravity, and the points that are left."""
        for part in self.parts.values():
            if part.name != GROUND:
                self._link(part)
        for beginning, step in self.steps.items():
            for (head, _), command in self.later.items():
                if begins(head, beginning):
                    step(command)
        for part in self.parts.values():
            points = self.graph.ground if part.name == GROUND else self.graph.links[part.name].points
            for name, place in part.markers.items():
                if name not in part.used:
                    points[plain_name(name, points)] = place[:3, 3]  # type: ignore[index]

    def _model(self, command: Command) -> None:
        if self.name:
            raise command.error("the file makes two models", "keep one")
        self.name = command.text("model_name").strip(".")
        self.graph.title = command.text("title", self.name)

    def _path(self, command: Command, key: str) -> tuple[str, ...]:
        """The parts of a name behind the model's, as it was first written."""
        words = [word for word in command.text(key).split(".") if word]
        if len(words) > 1 and words[0].lower() == self.name.lower():
            words = words[1:]
        if not 0 < len(words) < 3 or (len(words) == 2 and words[0].lower() not in map(str.lower, self.parts)):
            raise command.error(f"{key}: {command.text(key)!r} names no part of {self.name}", "make it first")
        known = {part.lower(): part for part in self.parts}
        words[0] = known.get(words[0].lower(), words[0])
        return tuple(words)

    def _marker_path(self, command: Command, key: str) -> tuple[_Part, str]:
        """Part and name of a marker."""
        path = self._path(command, key)
        if len(path) != 2:
            raise command.error(f"{key}: {command.text(key)!r} is not a marker", "write .model.part.marker")
        part = self.parts[path[0]]
        known = {marker.lower(): marker for marker in part.markers}
        return part, known.get(path[1].lower(), path[1])

    def _marker(self, command: Command, key: str) -> tuple[_Part, Array]:
        """Part of a marker to which something is fixed, and the place of the marker in it."""
        part, name = self._marker_path(command, key)
        if name not in part.markers:
            raise command.error(f"{key}: there is no marker {command.text(key)!r}", "make it first")
        part.used.add(name)
        return part, part.markers[name]

    def _placed(self, command: Command, part: _Part, old: Array) -> Array:
        """Place in a part's axes by location and orientation, of which one that is left out stays."""
        path = self._path(command, "relative_to") if "relative_to" in command.keys else self.base
        if path[0] not in self.parts:
            raise command.error(f"there is no part {path[0]!r}", "make it first")
        base = self.parts[path[0]].place
        base = np.eye(4) if path[0] == part.name else inverse(part.place) @ base  # without rounding
        if len(path) == 2:
            base = base @ self._marker(command, "relative_to")[1]
        out: Array = inverse(base) @ old
        if "location" in command.keys:
            out[:3, 3] = np.array(command.numbers("location", 3)) * self.units["length"]
        if "orientation" in command.keys:
            out[:3, :3] = body_313(command.numbers("orientation", 3, self.units["angle"]))
        return base @ out

    def _link(self, part: _Part) -> None:
        """The link of a part: mass about the marker of its mass centre, along the axes of its inertia marker."""
        command = self.later.get(("part create rigid_body mass_properties", part.name))
        link = LinkPart(part.name, part.place, line=part.line)
        if command is None:
            self.graph.lose(f"part {part.name!r} has no mass properties: no mass", part.line)
        elif "mass" not in command.keys:
            what = f"the mass of {part.name!r} follows from its solids and material"
            raise command.error(what, "write mass and ixx, iyy, izz, as Adams lists them")
        else:
            link = replace(link, **self._mass(command, part))
        self.graph.links[part.name] = link

    def _mass(self, command: Command, part: _Part) -> dict[str, Any]:
        if any(command.number(key) for key in ("ixy", "izx", "iyz")):
            raise command.error("products of inertia are not read", "turn its marker to the principal axes")
        center = np.eye(4)
        if "center_of_mass_marker" in command.keys:
            center = self._marker(command, "center_of_mass_marker")[1]
        else:
            note = f"part {part.name!r} has no center_of_mass_marker: its mass is where the part is"
            self.graph.lose(note, command.line)
        axes = center
        if "inertia_marker" in command.keys:
            axes = self._marker(command, "inertia_marker")[1]
            if not np.allclose(axes[:3, 3], center[:3, 3], rtol=0, atol=1e-12):
                raise command.error(
                    "the inertia marker is not at the mass centre", "put it at the mass centre"
                )
        unit = self.units["mass"] * self.units["length"] ** 2
        moments = [command.number(key) * unit for key in ("ixx", "iyy", "izz")]
        inertia = axes[:3, :3] @ np.diag(moments) @ axes[:3, :3].T
        mass = command.number("mass") * self.units["mass"]
        return {"mass": mass, "center": center[:3, 3], "inertia": (inertia + inertia.T) / 2}

    def _ends(self, command: Command) -> tuple[tuple[_Part, Array], tuple[_Part, Array]]:
        """Part and place of the marker J, then I."""
        return self._marker(command, "j_marker_name"), self._marker(command, "i_marker_name")

    def _joint(self, command: Command) -> None:
        kind = JOINTS[command.head.split()[-1]]
        if kind == "screw":
            return
        (i, at_i), (j, at_j) = self._ends(command)
        if kind in ALONG_X:
            at_i, at_j = at_i @ X_TO_Z.T, at_j @ X_TO_Z.T
        name = plain_name(self._path(command, "joint_name")[-1], self.graph.joints)
        self.graph.joints[name] = Connection(name, kind, (i.name, j.name), (at_i, at_j), line=command.line)

    def _thread(self, command: Command) -> None:
        """A screw joint of Adams holds the advance alone: with a cylindrical joint of the same parts it is a screw."""
        (i, _), (j, at) = self._ends(command)
        lead = command.number("pitch") * self.units["length"]
        for name, joint in self.graph.joints.items():
            same = np.allclose((joint.places[1] @ X_TO_Z)[:3, 2], at[:3, 2], rtol=0, atol=1e-9)
            if joint.kind == "cylindrical" and joint.links == (i.name, j.name) and same:
                self.graph.joints[name] = replace(joint, kind="screw", more={"lead": lead})
                return
        what = "a screw joint of Adams holds no axis, and there is no cylindrical joint of its two parts"
        raise command.error(what, "make one on its markers, J and I alike")

    def _motion(self, command: Command) -> None:
        name = self._path(command, "joint_name")[-1]
        known = {joint.lower(): joint for joint in self.graph.joints}
        if name.lower() not in known:
            raise command.error(f"there is no joint {name!r}", "name a joint")
        joint = self.graph.joints[known[name.lower()]]
        slides = command.text("type_of_freedom").lower() == "translational"
        freedom = "slide" if slides else "turn"
        freedoms = [c.freedom for c in coordinates(joint.kind)]
        if joint.kind not in DRIVEN or freedom not in freedoms:
            raise command.error(f"joint {joint.name!r} has no such freedom", "write another type_of_freedom")
        scale = self.units["length"] if slides else 1.0
        order = command.text("time_derivative", "displacement").lower()
        rate = self.units["time"] if order == "velocity" else 1.0
        motion, exact = of_time(command, scale / rate, self.units["time"])
        if order == "velocity":
            at = values(self.graph, joint)[freedoms.index(freedom)]
            if "displacement_ic" in command.keys:
                at = command.numbers("displacement_ic", 1, scale if slides else self.units["angle"])[0]
            exact = exact and abs(motion[2]) <= 1e-12 * abs(motion[1])
            motion = [at, *motion[:2]]
        elif order != "displacement":
            raise command.error(f"a motion given by its {order} is not read", "give displacement or velocity")
        if not exact:
            self.graph.lose(f"the motion {command.text('motion_name')!r} after time 0", command.line)
        label = self._path(command, "motion_name")[-1]
        bare = label.removeprefix("motion_")
        label = plain_name(bare if bare in self.graph.joints else label, self.graph.drives)
        self.graph.drives[label] = DrivenFreedom(joint.name, freedom, *motion)

    def _force(self, command: Command) -> None:
        """A single force on the part of its marker I, along the z of J, of ground or of the same part."""
        (base, axes), (part, place) = self._ends(command)
        kind = {"translational": "force", "rotational": "couple"}.get(command.text("type_of_freedom").lower())
        if kind is None or command.text("action_only", "off").lower() != "on" or part.name == GROUND:
            what = "a force between two parts along the line of their markers is not read"
            raise command.error(what, "give a force on one part (action_only = on)")
        if base.name not in (GROUND, part.name):
            raise command.error("its direction turns with a third part", "fix J to ground or the part")
        scale = self.units["force"] * (1.0 if kind == "force" else self.units["length"])
        value, exact = of_time(command, scale, self.units["time"])
        if not exact or any(value[1:]):
            raise command.error("a force that changes with time is not read", "write its value")
        name = plain_name(self._path(command, "single_component_force_name")[-1], self.graph.loads)
        self.graph.loads[name] = {
            "type": kind,
            "on": part.name,
            "at": clean(place[:3, 3]),
            "value": clean(axes[:3, 2] * value[0]),
            "axes": "ground" if base.name == GROUND else "link",
        }

    def _gravity(self, command: Command) -> None:
        unit = self.units["length"] / self.units["time"] ** 2
        x, y, z = (command.number(f"{a}_component_gravity") * unit for a in "xyz")
        self.graph.gravity = (x, y, z)
