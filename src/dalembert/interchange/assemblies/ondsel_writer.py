"""Assemblies of OndselSolver, the solver of FreeCAD's Assembly workbench (.asmt), from a graph of links.

A file is a tree of lines indented by tabs: parts with markers, joints between markers whose z is the joint's axis,
motions as functions of time. SI and radians.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from dalembert.arrays import Array, first_largest
from dalembert.errors import ModelError
from dalembert.interchange.joint_chains import split
from dalembert.interchange.link_graph import Connection, DrivenFreedom, LinkGraph, LinkPart, number
from dalembert.interchange.placements import placement
from dalembert.model import GROUND
from dalembert.printing import round_components

KINDS = {
    "revolute": "RevoluteJoint",
    "prismatic": "TranslationalJoint",
    "cylindrical": "CylindricalJoint",
    "spherical": "SphericalJoint",
    "weld": "FixedJoint",
    "screw": "ScrewJoint",
}
"""Our joint type -> that of the format; others become chains of these."""

ALONG_X = ("prismatic", "cylindrical", "screw")
"""Types whose axis is x in our files and z in the format."""

X_TO_Z = placement(np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]), (0.0, 0.0, 0.0))
"""Axes whose z is the former x."""

NAME = "Assembly"
FRAMES = 73
"""Instants of one turn, or of a second."""


class AssemblyText:
    """Lines at a depth of indentation."""

    def __init__(self) -> None:
        self.lines = ["OndselSolver"]

    def add(self, depth: int, label: str, *values: str) -> None:
        """A label, and its values one tab deeper."""
        self.lines += ["\t" * depth + label, *("\t" * (depth + 1) + value for value in values)]

    def place(self, depth: int, at: Array) -> None:
        """Position and rotation matrix of a placement."""
        self.add(depth, "Position3D", row(at[:3, 3]))
        self.add(depth, "RotationMatrix", *(row(line) for line in at[:3, :3]))

    def markers(self, depth: int, markers: dict[str, Array]) -> None:
        """Markers on one reference point at the origin of the part."""
        self.add(depth, "RefPoints")
        if markers:
            self.add(depth + 1, "RefPoint")
            self.place(depth + 2, np.eye(4))
            self.add(depth + 2, "Markers")
        for name, at in markers.items():
            self.add(depth + 3, "Marker")
            self.add(depth + 4, "Name", name)
            self.place(depth + 4, at)
        self.add(depth, "RefCurves")
        self.add(depth, "RefSurfaces")

    def __str__(self) -> str:
        return "\n".join(self.lines) + "\n"


def row(values: Iterable[float]) -> str:
    """Numbers with all their digits, a tab behind each."""
    return "".join(f"{float(value)!r}\t" for value in values)


def write_asmt(graph: LinkGraph) -> str:
    """The text of an .asmt file; what it does not keep is noted in the graph."""
    for joint in list(graph.joints.values()):
        if joint.kind == "gear":
            what = (
                f"gear {joint.name!r}: the gears of OndselSolver have no teeth whose force could be the same"
            )
            raise ModelError(what, "leave it out")
        if joint.kind not in KINDS:
            split(graph, joint)
        if joint.more.get("damping"):
            graph.lose(f"damping of {joint.name!r}")
    markers = _markers(graph)
    text = AssemblyText()
    text.add(0, NAME)
    text.add(1, "Notes", "written by dalembert: SI and radians")
    text.add(1, "Name", NAME)
    _pose(text, 1, LinkPart(NAME))
    text.markers(1, markers[GROUND])
    text.add(1, "Parts")
    for link in graph.links.values():
        text.add(2, "Part")
        text.add(3, "Name", link.name)
        _pose(text, 3, link)
        text.add(3, "FeatureOrder")
        _mass(text, link)
        text.markers(3, markers[link.name])
    text.add(1, "KinematicIJs")
    text.add(1, "ConstraintSets")
    text.add(2, "Joints")
    for joint in graph.joints.values():
        _joint(text, joint)
    text.add(2, "Motions")
    for name, drive in graph.drives.items():
        _motion(text, graph, name, drive)
    text.add(2, "GeneralConstraintSets")
    text.add(1, "ForceTorques")
    text.add(1, "ConstantGravity", row(graph.gravity))
    _settings(text, max((abs(d.speed) for d in graph.drives.values()), default=0.0))
    for name, load in graph.loads.items():
        graph.lose(f"load {name!r} ({load['type']}): only gravity is written to .asmt")
    return str(text)


def _markers(graph: LinkGraph) -> dict[str, dict[str, Array]]:
    """Markers of ground and of each link: one for each joint on it, named after the joint, with z along its axis."""
    markers: dict[str, dict[str, Array]] = {name: {} for name in (GROUND, *graph.links)}
    for joint in graph.joints.values():
        for link, place in zip(joint.links, marker_places(joint), strict=True):
            markers[link][joint.name] = place
    return markers


def marker_places(joint: Connection) -> tuple[Array, Array]:
    """Places of a joint's markers on its links i and j, with z along its axis."""
    i, j = joint.places
    return (i @ X_TO_Z, j @ X_TO_Z) if joint.kind in ALONG_X else (i, j)


def _pose(text: AssemblyText, depth: int, link: LinkPart) -> None:
    text.place(depth, link.place)
    text.add(depth, "Velocity3D", row(link.velocity))
    text.add(depth, "Omega3D", row(link.spin))


def _mass(text: AssemblyText, link: LinkPart) -> None:
    """The marker of the mass centre, along the principal axes of inertia."""
    moments, axes = principal_inertia(link)
    text.add(3, "PrincipalMassMarker")
    text.add(4, "Name", "MassMarker")
    text.place(4, placement(axes, link.center))
    text.add(4, "Mass", repr(float(link.mass)))
    text.add(4, "MomentOfInertias", row(moments))
    text.add(4, "Density", "1.0")


EQUAL = 1e-9
"""Difference of two principal moments, as part of the largest, below which they are equal."""


def principal_inertia(link: LinkPart) -> tuple[Array, Array]:
    """Principal moments of inertia about the mass centre, and their axes as a rotation (3, 3).

    An axis is turned to the side of the link's axis that it is nearest to, and of equal moments the axes are nearest to
    those of the link: so a file is the same whatever computes it.
    """
    moments, axes = np.linalg.eigh(link.inertia)
    out = np.zeros((3, 0))
    for moment in moments:
        same = axes[:, np.abs(moments - moment) <= EQUAL * moments[-1]]
        left = (np.eye(3) - out @ out.T) @ same @ same.T
        size = np.linalg.norm(left, axis=0)
        k = first_largest(size)
        out = np.column_stack([out, round_components(left[:, k] / size[k])])
    return moments, out * [1.0, 1.0, np.sign(np.linalg.det(out))]


def _joint(text: AssemblyText, joint: Connection) -> None:
    """A joint between its markers; a screw holds only its advance, and a cylindrical joint the rest."""
    if joint.kind == "screw":
        _joint(text, replace(joint, kind="cylindrical", name=joint.name))
    text.add(3, KINDS[joint.kind])
    text.add(4, "Name", f"{joint.name} thread" if joint.kind == "screw" else joint.name)
    for key, link in zip(("MarkerI", "MarkerJ"), joint.links, strict=True):
        text.add(4, key, "/".join(["", NAME, *([] if link == GROUND else [link]), joint.name]))
    if joint.kind == "screw":
        text.add(4, "pitch", repr(number(joint.more["lead"], "length")))


def _motion(text: AssemblyText, graph: LinkGraph, name: str, drive: DrivenFreedom) -> None:
    """A drive as a function of time: position, speed and constant acceleration from the written position on."""
    slides = drive.freedom.startswith("slide")
    text.add(3, "TranslationalMotion" if slides else "RotationalMotion")
    text.add(4, "Name", f"motion {name}" if name in graph.joints else name)
    text.add(4, "MotionJoint", f"/{NAME}/{drive.joint}")
    text.add(4, "TranslationZ" if slides else "RotationZ", law_of_time(drive))


def law_of_time(drive: DrivenFreedom) -> str:
    """Position as a function of time: that of the first position, with its speed and constant acceleration."""
    terms = [repr(drive.position)]
    terms += [f"{drive.speed!r}*time"] if drive.speed else []
    terms += [f"{drive.acceleration / 2!r}*time*time"] if drive.acceleration else []
    return " + ".join(terms)


def _settings(text: AssemblyText, speed: float) -> None:
    """One turn of the fastest drive, or a second."""
    end = 2 * math.pi / speed if speed else 1.0
    text.add(1, "SimulationParameters")
    values = {"tstart": 0.0, "tend": end, "hmin": 1e-9, "hmax": end, "hout": end / (FRAMES - 1)}
    for key, value in (values | {"errorTol": 1e-9}).items():
        text.add(2, key, repr(value))
    text.add(1, "AnimationParameters")
    frames = {"nframe": FRAMES, "icurrent": 1, "istart": 1, "iend": FRAMES, "isForward": "true"}
    for label, frame in (frames | {"framesPerSecond": 30}).items():
        text.add(2, label, str(frame))
