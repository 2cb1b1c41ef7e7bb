"""MJCF, the model files of MuJoCo: links, joints and the equalities that close loops.

Lengths in metres, angles in degrees unless the compiler says otherwise, as MuJoCo reads them (XML reference 3.x).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from dalembert.arrays import Array
from dalembert.interchange.link_graph import LinkGraph, LinkPart, plain_name
from dalembert.interchange.placements import along, from_quaternion, placement, turned
from dalembert.interchange.robots.mjcf_geoms import (
    DENSITY,
    MASSLESS,
    SIZES,
    combined,
    geom_sizes,
    principal_inertia,
    volume,
)
from dalembert.interchange.xml_tree import Element
from dalembert.model import GROUND

REFUSED = {"include", "attach", "replicate", "composite", "flexcomp", "plugin", "flex", "skin", "deformable"}
"""Elements that replace others, or bend."""

IGNORED = {"contact": "contact", "sensor": "sensors"}
"""Sections without a counterpart -> their name in a note; those that only show are left out without one."""

UNREAD = ("settotalmass", "inertiagrouprange", "balanceinertia", "boundmass", "boundinertia")
"""Keys of the compiler that change masses."""


@dataclass
class MovedJoint:
    """A joint of a body: its element's attributes, its name, and its places in qpos and qvel."""

    element: Element
    keys: dict[str, str]
    kind: str
    name: str
    q: int
    v: int


@dataclass
class TreeLink:
    """A body of the tree: its parent, its place in the parent, its joints, mass properties and sites."""

    element: Element
    name: str
    parent: str
    place: Array
    joints: list[MovedJoint] = field(default_factory=list)
    solid: LinkPart | None = None


class MjcfTree:
    """The tree of an MJCF file, with defaults resolved; `links` in the file's order, depth first."""

    def __init__(self, root: Element) -> None:
        self.root, self.graph = root, LinkGraph(root.get("model"))
        if root.tag != "mujoco":
            raise root.error(f"<{root.tag}> is not MJCF", "an MJCF file begins with <mujoco>")
        for element in root.walk():
            if element.tag in REFUSED:
                what = f"<{element.tag}> has no counterpart in a mechanism of rigid links"
                raise element.error(
                    what, "save the compiled model from MuJoCo (mj_saveLastXML), or leave it out"
                )
        self.compiler: dict[str, str] = {}
        for compiler in root.all("compiler"):
            self.compiler |= compiler.attributes
            for key in UNREAD:
                if compiler.get(key, "0") not in ("0", "false", "-1"):
                    raise compiler.error(f"{key} changes masses", "write the masses themselves")
        self.angle = 1.0 if self.compiler.get("angle") == "radian" else np.pi / 180
        self.defaults: dict[str, dict[str, dict[str, str]]] = {"main": {}}
        for default in root.all("default"):
            self._read_defaults(default, "main", {})
        self.links: dict[str, TreeLink] = {}
        self.sites: dict[str, tuple[str, Array]] = {}
        self.joints: dict[str, MovedJoint] = {}
        self.names: dict[str, str] = {"world": GROUND}
        self.nq = self.nv = 0
        for world in root.all("worldbody"):
            self._read_parts(world, GROUND, np.eye(4), "main")
        self._option()

    def _read_defaults(self, default: Element, name: str, above: dict[str, dict[str, str]]) -> None:
        own = {tag: dict(keys) for tag, keys in above.items()}
        for part in default.parts:
            if part.tag != "default":
                own[part.tag] = own.get(part.tag, {}) | part.attributes
        self.defaults[name] = own
        for part in default.all("default"):
            self._read_defaults(part, part.get("class", "main"), own)

    def keys(self, element: Element, childclass: str, tag: str = "") -> dict[str, str]:
        """Attributes of an element with those of its class."""
        name = element.get("class", childclass)
        if name not in self.defaults:
            raise element.error(f"unknown class {name!r}", "name a <default> of the file")
        return self.defaults[name].get(tag or element.tag, {}) | element.attributes

    def _read_parts(self, element: Element, link: str, place: Array, childclass: str) -> None:
        """Bodies, frames and sites inside a body, whose place in the link's axes is given."""
        for part in element.parts:
            if part.tag == "frame":
                inside = part.get("childclass", childclass)
                self._read_parts(part, link, place @ self.placed(part, part.attributes), inside)
            elif part.tag == "site":
                keys = self.keys(part, childclass)
                self._site(part, keys, link, place @ self.placed(part, keys))
            elif part.tag == "body":
                self._body(part, link, place, childclass)
            elif link != GROUND and part.tag in ("joint", "freejoint"):
                self._joint(part, self.links[link], childclass)

    def _site(self, part: Element, keys: dict[str, str], link: str, place: Array) -> None:
        text = keys.get("name", "")
        if text:
            self.sites[text] = (link, place)

    def _body(self, part: Element, parent: str, place: Array, childclass: str) -> None:
        inside = part.get("childclass", childclass)
        taken = {**self.links, GROUND: None}
        name = plain_name(part.get("name") or f"link_{len(self.links) + 1}", taken)
        if part.get("name"):
            self.names[part.get("name")] = name
        if part.get("mocap") == "true":
            self.graph.lose("a mocap body is fixed", part.line)
        if float(part.get("gravcomp", "0") or 0):
            self.graph.lose(f"gravcomp of body {name!r}", part.line)
        link = TreeLink(part, name, parent, place @ self.placed(part, part.attributes))
        self.links[name] = link
        self._read_parts(part, name, np.eye(4), inside)
        link.solid = self._mass(link, inside)

    def _joint(self, part: Element, link: TreeLink, childclass: str) -> None:
        keys = self.keys(part, childclass, "joint") if part.tag == "joint" else dict(part.attributes)
        kind = "free" if part.tag == "freejoint" else keys.get("type", "hinge")
        widths = {"hinge": (1, 1), "slide": (1, 1), "ball": (4, 3), "free": (7, 6)}
        if kind not in widths:
            raise part.error(f"unknown type of joint {kind!r}", "use hinge, slide, ball or free")
        name = keys.get("name") or f"{link.name} {kind} {len(link.joints) + 1}"
        joint = MovedJoint(part, keys, kind, name, self.nq, self.nv)
        self.nq, self.nv = self.nq + widths[kind][0], self.nv + widths[kind][1]
        link.joints.append(joint)
        self.joints[name] = joint
        for key in ("armature", "frictionloss"):
            if any(part.numbers(keys.get(key, "0"))):
                self.graph.lose(f"{key} of joint {name!r}", part.line)
        if keys.get("limited") == "true" or ("range" in keys and keys.get("limited") != "false"):
            self.graph.lose(f"range of joint {name!r}", part.line)

    def _mass(self, link: TreeLink, childclass: str) -> LinkPart:
        """Mass, centre and inertia, of <inertial> or of the geoms."""
        inertial, rule = link.element.first("inertial"), self.compiler.get("inertiafromgeom", "auto")
        if inertial is not None and rule != "true":
            mass, center, inertia = self._inertial(inertial)
        elif rule == "false":
            mass, center, inertia = combined([])
        else:
            mass, center, inertia = combined(list(self._geoms(link.element, np.eye(4), childclass)))
        return LinkPart(link.name, np.eye(4), mass, center, inertia, line=link.element.line)

    def _inertial(self, part: Element) -> tuple[float, Array, Array]:
        place = self.placed(part, part.attributes)
        if "fullinertia" in part.attributes:
            xx, yy, zz, xy, xz, yz = part.vector("fullinertia", 6)
            local = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        else:
            local = np.diag(part.vector("diaginertia", 3, [0.0, 0.0, 0.0]))
        rotation = place[:3, :3]
        return part.number("mass"), place[:3, 3], rotation @ local @ rotation.T

    def _geoms(self, element: Element, place: Array, childclass: str) -> Iterator[tuple[float, Array, Array]]:
        for part in element.parts:
            if part.tag == "frame":
                inside = part.get("childclass", childclass)
                yield from self._geoms(part, place @ self.placed(part, part.attributes), inside)
            elif part.tag == "geom":
                yield from self._geom(part, place, self.keys(part, childclass))

    def _geom(
        self, part: Element, place: Array, keys: dict[str, str]
    ) -> Iterator[tuple[float, Array, Array]]:
        kind = "mesh" if "mesh" in keys and "type" not in keys else keys.get("type", "sphere")
        known = part.numbers(keys["mass"], 1, "mass of <geom>")[0] if "mass" in keys else None
        if kind in MASSLESS or known == 0:
            return
        if kind not in SIZES or "shellinertia" in keys:
            what = f"the mass of a geom of type {kind} comes from its mesh {keys.get('mesh', '')!r}"
            raise part.error(what, "give its body an <inertial>")
        size, where = geom_sizes(part, keys, kind)
        at = place @ (self.placed(part, keys) if where is None else where)
        density = part.numbers(keys.get("density", str(DENSITY)), 1, "density of <geom>")[0]
        mass = density * volume(kind, size) if known is None else known
        if mass:
            axes = at[:3, :3]
            yield mass, at[:3, 3], axes @ np.diag(principal_inertia(kind, size, mass)) @ axes.T

    def placed(self, part: Element, keys: dict[str, str]) -> Array:
        """Place of an element by its pos and one of quat, axisangle, euler, xyaxes and zaxis."""
        position = part.numbers(keys.get("pos", "0 0 0"), 3, f"pos of <{part.tag}>")
        return placement(self._rotation(part, keys), position)

    def _rotation(self, part: Element, keys: dict[str, str]) -> Array:
        def of(key: str, count: int) -> list[float]:
            return part.numbers(keys[key], count, f"{key} of <{part.tag}>")

        if "quat" in keys:
            return from_quaternion(of("quat", 4))
        if "axisangle" in keys:
            *axis, angle = of("axisangle", 4)
            return turned(axis, angle * self.angle)
        if "euler" in keys:
            out = np.eye(3)
            for letter, turn in zip(self.compiler.get("eulerseq", "xyz"), of("euler", 3), strict=True):
                step = turned(np.eye(3)["xyz".index(letter.lower())], turn * self.angle)
                out = out @ step if letter.islower() else step @ out
            return out
        if "xyaxes" in keys:
            x, y = np.array(of("xyaxes", 6)).reshape(2, 3)
            x = x / np.linalg.norm(x)
            z = np.cross(x, y - x * (x @ y))
            z = z / np.linalg.norm(z)
            return np.array([x, np.cross(z, x), z]).T
        if "zaxis" in keys:
            return along("z", of("zaxis", 3))
        return np.eye(3)

    def _option(self) -> None:
        option = self.root.first("option")
        gravity = [0.0, 0.0, -9.81]
        if option is not None:
            gravity = option.vector("gravity", 3, gravity)
            flag = option.first("flag")
            if flag is not None and flag.get("gravity") == "disable":
                gravity = [0.0, 0.0, 0.0]
            for key in ("wind", "density", "viscosity"):
                if any(option.numbers(option.get(key, "0"))):
                    self.graph.lose(f"{key} of the medium", option.line)
        self.graph.gravity = (gravity[0], gravity[1], gravity[2])
        for section in self.root.parts:
            if section.tag in IGNORED and section.parts:
                self.graph.lose(f"{IGNORED[section.tag]} (<{section.tag}>)", section.line)
        geom = next((e for e in self.root.walk() if e.tag == "geom"), None)
        if geom is not None:
            self.graph.lose("surfaces (<geom>), with contact between them", geom.line)
