"""MJCF from a graph of links: a tree, loops closed by equalities on sites, the first position as a keyframe."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import Any

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.interchange.joint_chains import cuttable_tree
from dalembert.interchange.joint_coordinates import Coordinate, coordinates, rates, values
from dalembert.interchange.link_graph import Connection, LinkGraph, LinkPart, flipped, number, plain_name
from dalembert.interchange.placements import inverse, placement, to_quaternion
from dalembert.interchange.xml_text import XmlText, digits
from dalembert.model import GROUND

LEAST_MASS, LEAST_INERTIA = 1e-9, 1e-12
"""Mass and inertia of links without mass: MuJoCo refuses 0."""

STIFF = "0.9999 0.9999 0.001 0.5 2"
"""Impedance of equalities, the largest that MuJoCo takes: with it loop forces are good to about 3e-5."""

ARM = 0.1
"""Distance of the two points that hold a cut revolute in space from its point, over the largest coordinate."""


def write_mjcf(graph: LinkGraph) -> str:
    """The text of an MJCF file; what it does not keep is noted in the graph."""
    return str(_MjcfText(graph).text)


def branch_coordinates(joint: Connection, is_flipped: bool) -> list[Coordinate]:
    """MuJoCo's joints of a branch; from j to i they come in the other order, about axes of opposite direction."""
    value = coordinates(joint.kind)
    return [c._replace(axis=-c.axis) for c in reversed(value)] if is_flipped else value


def branch_values(graph: LinkGraph, joint: Connection, is_flipped: bool) -> tuple[list[float], list[float]]:
    """A branch's numbers in qpos and in qvel; those of a ball in the axes of its second link."""
    balls = [c.kind for c in coordinates(joint.kind)].count("ball")
    if is_flipped and not balls:
        straight = flipped(joint)
        return values(graph, straight)[::-1], rates(graph, straight)[::-1]
    if is_flipped and joint.kind != "spherical":
        what = f"joint {joint.name!r}, a {joint.kind}, would be walked from its second link"
        raise ModelError(what, "exchange its links")
    position, rate = values(graph, joint), rates(graph, joint)
    if balls:
        axes = joint.places[1][:3, :3]
        position[-3:], rate[-3:] = (axes @ position[-3:]).tolist(), (axes @ rate[-3:]).tolist()
    return position, rate


class _MjcfText:
    """The text, part by part."""

    def __init__(self, graph: LinkGraph) -> None:
        self.graph, self.tree = graph, cuttable_tree(graph)
        self.text = XmlText("written by dalembert: SI and radians; loops are closed by equalities")
        self.children: dict[str, list[Connection]] = {}
        for joint in self.tree.branches:
            self.children.setdefault(joint.links[0], []).append(joint)
        reached = {joint.links[1] for joint in self.tree.branches}
        if loose := [name for name in graph.links if name not in reached]:
            raise ModelError(
                f"no joint reaches {', '.join(loose)} from ground", "join them, or leave them out"
            )
        self.sites: dict[str, dict[str, Array]] = {name: {} for name in (GROUND, *graph.links)}
        self.equalities: list[tuple[str, dict[str, Any]]] = []
        self.numbers: tuple[list[float], list[float]] = ([], [])
        for link, points in [(GROUND, graph.ground), *((s.name, s.points) for s in graph.links.values())]:
            for name, at in points.items():
                self._site(link, name, placement(np.eye(3), at))
        for joint in self.tree.cut:
            self._cut(joint)
        self._threads()
        self._write()

    def _write(self) -> None:
        text, graph = self.text, self.graph
        text.begin("mujoco", model=graph.title or "mechanism")
        text.add("compiler", angle="radian", autolimits="true")
        text.begin("option", gravity=digits(graph.gravity))
        text.add("flag", contact="disable")
        text.end()
        text.begin("default")
        text.add("equality", solref="0.002 1", solimp=STIFF)
        text.end()
        text.begin("worldbody")
        self._write_sites(GROUND)
        for joint in self.children.get(GROUND, ()):
            self._link(joint)
        text.end()
        self._section("equality", self.equalities)
        self._section("tendon", list(self._tendons()))
        self._section("actuator", list(self._motors()))
        text.begin("keyframe")
        text.add(
            "key", name="first", qpos=digits(self.numbers[0]) or None, qvel=digits(self.numbers[1]) or None
        )
        text.end()
        text.end()

    def _section(self, tag: str, parts: list[tuple[str, dict[str, Any]]]) -> None:
        if parts:
            self.text.begin(tag)
            for part, keys in parts:
                sites = keys.pop("sites", ())
                if sites:
                    self.text.begin(part, **keys)
                    for site in sites:
                        self.text.add("site", site=site)
                    self.text.end()
                else:
                    self.text.add(part, **keys)
            self.text.end()

    def _site(self, link: str, name: str, place: Array) -> str:
        full = plain_name(name, self.sites[link])
        self.sites[link][full] = place
        return f"{link}.{full}"

    def _write_sites(self, link: str) -> None:
        for name, place in self.sites[link].items():
            is_turned = not np.array_equal(place[:3, :3], np.eye(3))
            quat = digits(to_quaternion(place[:3, :3])) if is_turned else None
            self.text.add("site", name=f"{link}.{name}", pos=digits(place[:3, 3]), quat=quat)

    def _link(self, joint: Connection) -> None:
        graph, text, name = self.graph, self.text, joint.links[1]
        is_flipped = joint.name in self.tree.turned
        home = joint.places[0] @ inverse(joint.places[1])
        text.begin("body", name=name, pos=digits(home[:3, 3]), quat=digits(to_quaternion(home[:3, :3])))
        self._inertial(graph.links[name])
        for numbers, more in zip(self.numbers, branch_values(graph, joint, is_flipped), strict=True):
            numbers += more
        axes, at = joint.places[1][:3, :3], joint.places[1][:3, 3]
        for freedom, kind, axis in branch_coordinates(joint, is_flipped):
            keys: dict[str, Any] = {"name": coordinate_name(joint, freedom), "type": kind, "pos": digits(at)}
            if kind != "ball":
                keys["axis"] = digits(axes @ axis)
            text.add("joint", **keys, **self._resistances(joint, freedom))
        self._write_sites(name)
        for child in self.children.get(name, ()):
            self._link(child)
        text.end()

    def _resistances(self, joint: Connection, freedom: str) -> dict[str, str]:
        """Damping and torsion spring of a coordinate."""
        out, damping = {}, joint.more.get("damping", {}).get(freedom)
        if damping:
            out["damping"] = digits(number(damping, "torsion_damping" if "turn" in freedom else "damping"))
        for name, load in self.graph.loads.items():
            if load.get("joint") == joint.name and (load.get("freedom") or "turn") == freedom:
                if load["type"] != "torsion_spring" or "stiffness" in out:
                    continue
                self.kept.add(name)
                out["stiffness"] = digits(number(load["stiffness"], "torsion_stiffness"))
                out["springref"] = digits(number(load.get("free_angle", 0.0), "angle"))
        return out

    @cached_property
    def kept(self) -> set[str]:
        """Names of loads that are written."""
        return set()

    def _inertial(self, link: LinkPart) -> None:
        moments = np.linalg.eigvalsh(link.inertia)
        if moments.sum() - 2 * moments[-1] < -1e-9 * moments[-1]:
            what = f"link {link.name!r}: principal inertias {', '.join(f'{x:.4g}' for x in moments)} are of no solid"
            raise ModelError(f"{what}, and MuJoCo refuses them", "let none exceed the sum of the others")
        mass, inertia = link.mass, link.inertia
        if mass < LEAST_MASS:
            mass = LEAST_MASS
            self.graph.lose(f"link {link.name!r} without mass has {LEAST_MASS:g} kg: MuJoCo refuses 0")
        if moments[0] < LEAST_INERTIA:
            inertia = inertia + LEAST_INERTIA * np.eye(3)
            self.graph.lose(
                f"the inertia of link {link.name!r} is larger by {LEAST_INERTIA:g} kg m2: MuJoCo refuses 0"
            )
        full = [inertia[i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
        self.text.add("inertial", pos=digits(link.center), mass=digits(mass), fullinertia=digits(full))

    def _cut(self, joint: Connection) -> None:
        """The equality that closes a loop at a joint which is not in the tree."""
        if joint.kind == "gear":
            self._ratio(joint)
        elif joint.kind == "weld":
            sites = [self._site(k, joint.name, p) for k, p in zip(joint.links, joint.places, strict=True)]
            self.equalities.append(("weld", {"name": joint.name, "site1": sites[0], "site2": sites[1]}))
        elif joint.kind in ("revolute", "spherical"):
            arms = [0.0] if joint.kind == "spherical" or self.graph.is_plane else [-1.0, 1.0]
            size = max((float(np.abs(p[:3, 3]).max()) for p in joint.places), default=0.0) or 1.0
            for k, arm in enumerate(arms):
                name = joint.name if len(arms) == 1 else f"{joint.name}.{k + 1}"
                sites = []
                for link, place in zip(joint.links, joint.places, strict=True):
                    at = placement(np.eye(3), place[:3, 3] + arm * ARM * size * place[:3, 2])
                    sites.append(self._site(link, f"{joint.name} cut", at))
                self.equalities.append(("connect", {"name": name, "site1": sites[0], "site2": sites[1]}))
            if self.graph.is_plane:
                self.graph.lose(f"pin {joint.name!r} closes a loop: it becomes a ball (<connect>)")
        else:
            what = f"the loop would be cut at {joint.name!r}, a {joint.kind} joint, which no equality of MJCF has"
            raise ModelError(what, "add a pin or a ball to the loop")
        if joint.more.get("damping"):
            self.graph.lose(f"damping of {joint.name!r}, where a loop is closed")

    def _ratio(self, joint: Connection) -> None:
        """A gear as a ratio of two hinges on one carrier."""
        hinges = [self._hinge(link) for link in joint.links]
        if None in hinges or hinges[0].links[0] != hinges[1].links[0]:  # type: ignore[union-attr]
            what = f"gear {joint.name!r}: its wheels do not turn in pins on one link"
            raise ModelError(what, "let both wheels turn on one link, or leave the gear out")
        signs, at = [], []
        for hinge, place in zip(hinges, joint.places, strict=True):
            assert hinge is not None
            is_flipped = hinge.name in self.tree.turned
            axis = hinge.places[1][:3, 2] * (-1.0 if is_flipped else 1.0)
            signs.append(float(np.sign(axis @ place[:3, 2])))
            at.append(branch_values(self.graph, hinge, is_flipped)[0][0])
        radii, is_internal = joint.more["pitch_radii"], bool(joint.more.get("internal"))
        facing = float(np.sign(self._facing(joint)))
        ratio = (1.0 if is_internal else -1.0) * facing * radii[0] / radii[1] * signs[0] * signs[1]
        names = [coordinate_name(h, "turn") for h in reversed(hinges) if h is not None]
        keys = {"name": joint.name, "joint1": names[0], "joint2": names[1]}
        self.equalities.append(
            ("joint", keys | {"polycoef": digits([at[1] - ratio * at[0], ratio, 0.0, 0.0, 0.0])})
        )
        self.graph.lose(
            f"teeth of gear {joint.name!r}: MuJoCo has its ratio, not the force between the wheels"
        )

    def _facing(self, joint: Connection) -> float:
        """Cosine of the angle between the two wheels' axes."""
        a, b = (self.graph.place(link) @ place for link, place in zip(joint.links, joint.places, strict=True))
        cosine = float(a[:3, 2] @ b[:3, 2])
        if abs(abs(cosine) - 1) > 1e-9:
            raise ModelError(f"gear {joint.name!r}: its axes are not parallel", "leave it out")
        return cosine

    def _hinge(self, link: str) -> Connection | None:
        out = [j for j in self.tree.branches if j.links[1] == link and j.kind == "revolute"]
        return out[0] if out else None

    def _threads(self) -> None:
        for joint in self.tree.branches:
            if joint.kind == "screw":
                keys = {"name": joint.name, "joint1": coordinate_name(joint, "slide")}
                pitch = number(joint.more["lead"], "length") / (2 * np.pi)
                keys |= {"joint2": coordinate_name(joint, "turn"), "polycoef": digits([0, pitch, 0, 0, 0])}
                self.equalities.append(("joint", keys))

    def _motors(self) -> Iterator[tuple[str, dict[str, Any]]]:
        for name, drive in self.graph.drives.items():
            joint = self.graph.joints[drive.joint]
            if drive.freedom not in [c.freedom for c in coordinates(joint.kind) if c.kind != "ball"]:
                self.graph.lose(f"drive {name!r}, the turn of a ball about an axis")
                continue
            if drive.acceleration:
                self.graph.lose(f"acceleration of drive {name!r}")
            yield "motor", {"name": name, "joint": coordinate_name(joint, drive.freedom)}

    def _tendons(self) -> Iterator[tuple[str, dict[str, Any]]]:
        """Springs and dampers between points; the other loads are noted."""
        for name, load in self.graph.loads.items():
            keys: dict[str, Any] = {"name": name, "sites": load.get("between")}
            if load["type"] == "spring" and not load.get("force"):
                free = number(load.get("free_length") or 0.0, "length")
                yield (
                    "spatial",
                    keys
                    | {
                        "stiffness": digits(number(load["stiffness"], "stiffness")),
                        "springlength": digits(free),
                    },
                )
            elif load["type"] == "damper" and load.get("damping"):
                yield "spatial", keys | {"damping": digits(number(load["damping"], "damping"))}
            elif name not in self.kept:
                self.graph.lose(f"load {name!r} ({load['type']}): MJCF cannot state forces")


def coordinate_name(joint: Connection, freedom: str) -> str:
    """Name of a coordinate: the joint's, with its freedom where it has several."""
    return joint.name if len(coordinates(joint.kind)) == 1 else f"{joint.name}.{freedom}"
