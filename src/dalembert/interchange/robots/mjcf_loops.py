"""An MJCF file as a graph of links: the tree's joints, the loops that its equalities close, drives, springs."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from dalembert.arrays import Array, Tree
from dalembert.interchange.couplings import coupled_wheels
from dalembert.interchange.link_graph import Connection, DrivenFreedom, LinkGraph, LinkPart, plain_name
from dalembert.interchange.placements import (
    Z,
    along,
    from_quaternion,
    inverse,
    placement,
    to_quaternion,
    turned,
)
from dalembert.interchange.robots.mjcf_reader import MjcfTree, MovedJoint, TreeLink
from dalembert.interchange.xml_tree import Element, parse
from dalembert.model import GROUND

SAME = 1e-9
"""Directions and points that differ by less are the same."""


def read_mjcf(content: bytes, file: str) -> LinkGraph:
    """The graph of an MJCF file; raises ModelError with the line for what a mechanism of rigid links has not."""
    return _MjcfGraph(MjcfTree(parse(content, file))).graph


class _MjcfGraph:
    """The tree's links at the first keyframe, or as drawn, and the joints between them."""

    def __init__(self, tree: MjcfTree) -> None:
        self.tree, self.graph = tree, tree.graph
        self.freedom: dict[str, tuple[str, str]] = {}  # MJCF joint -> joint here, and its freedom
        self.home = self._coordinates(None)
        self.key = next((k for frame in tree.root.all("keyframe") for k in frame.all("key")), None)
        self.q = self._coordinates(self.key)
        self.rates = np.zeros(tree.nv)
        if self.key is not None and "qvel" in self.key.attributes:
            self.rates = np.array(self.key.vector("qvel", tree.nv))
        self.drawn: dict[str, Array] = {}
        for link in tree.links.values():
            self._link(link)
        self._points()
        balls: dict[tuple[str, str], list[Connection]] = {}
        for part in (p for e in tree.root.all("equality") for p in e.parts):
            self._equality(part, balls)
        for pairs in balls.values():
            self._balls(pairs)
        self._actuators()
        self._tendons()

    def _coordinates(self, key: Element | None) -> Array:
        """The joints' positions of a keyframe, or as the file draws them."""
        q = np.zeros(self.tree.nq)
        for link in self.tree.links.values():
            for joint in link.joints:
                if joint.kind == "ball":
                    q[joint.q] = 1.0
                elif joint.kind == "free":
                    q[joint.q : joint.q + 7] = (*link.place[:3, 3], *to_quaternion(link.place[:3, :3]))
                else:
                    q[joint.q] = self.ref(joint)
        if key is not None and "qpos" in key.attributes:
            q = np.array(key.vector("qpos", self.tree.nq))
        return q

    def ref(self, joint: MovedJoint) -> float:
        """Position of a joint as drawn."""
        value = joint.element.numbers(joint.keys.get("ref", "0"), 1)[0]
        return value * (self.tree.angle if joint.kind == "hinge" else 1.0)

    def _axes(self, joint: MovedJoint) -> Array:
        """The joint's axes in its link: z along a hinge, x along a slide."""
        at = joint.element.numbers(joint.keys.get("pos", "0 0 0"), 3, "pos of <joint>")
        if joint.kind == "ball":
            return placement(np.eye(3), at)
        axis = joint.element.numbers(joint.keys.get("axis", "0 0 1"), 3, "axis of <joint>")
        if not any(axis):
            raise joint.element.error("the axis of a joint is 0", "give its direction")
        return placement(along("z" if joint.kind == "hinge" else "x", axis), at)

    def _moved(self, joint: MovedJoint, q: Array) -> Array:
        """Placement of a link after a joint in the one before it."""
        axes = self._axes(joint)
        if joint.kind == "ball":
            step = placement(from_quaternion(q[joint.q : joint.q + 4]), [0, 0, 0])
        elif joint.kind == "hinge":
            step = placement(turned(Z, q[joint.q] - self.ref(joint)), [0, 0, 0])
        else:
            step = placement(np.eye(3), [q[joint.q] - self.ref(joint), 0, 0])
        return axes @ step @ inverse(axes)

    def _link(self, link: TreeLink) -> None:
        """A link, and links without mass between its joints where it has several that do not form a named pair."""
        above = {place: self._place_of(link.parent, place) for place in ("q", "home")}
        moves = link.joints
        if any(joint.kind == "free" for joint in moves):
            self._free(link, moves[0])
            return
        places = {"q": above["q"] @ link.place, "home": above["home"] @ link.place}
        for joint in moves:
            places = {
                "q": places["q"] @ self._moved(joint, self.q),
                "home": places["home"] @ self._moved(joint, self.home),
            }
        joints = (self._pair(link) or self._chain(link, above["q"])) if moves else [self._weld(link)]
        for connection in joints:
            self.graph.joints[connection.name] = connection
        assert link.solid is not None
        self.graph.links[link.name] = replace(link.solid, place=places["q"])
        self.drawn[link.name] = places["home"]

    def _place_of(self, link: str, when: str) -> Array:
        return np.eye(4) if link == GROUND else self.graph.place(link) if when == "q" else self.drawn[link]

    def _free(self, link: TreeLink, joint: MovedJoint) -> None:
        def place(q: Array) -> Array:
            return placement(from_quaternion(q[joint.q + 3 : joint.q + 7]), q[joint.q : joint.q + 3])

        assert link.solid is not None
        self.graph.links[link.name] = replace(link.solid, place=place(self.q))
        self.drawn[link.name] = place(self.home)

    def _new(self, text: str) -> str:
        return plain_name(text, self.graph.joints)

    def _weld(self, link: TreeLink) -> Connection:
        places = (link.place, np.eye(4))
        return Connection(
            self._new(f"{link.name} weld"), "weld", (link.parent, link.name), places, line=link.element.line
        )

    def _shifted(self, joint: MovedJoint, before: Array) -> Array:
        """Axes on the link before a joint, from which its freedom has the file's coordinate."""
        ref, axes = self.ref(joint), before @ self._axes(joint)
        if joint.kind == "ball" or not ref:
            return axes
        if joint.kind == "hinge":
            return axes @ placement(turned(Z, -ref), [0, 0, 0])
        return axes @ placement(np.eye(3), [-ref, 0, 0])

    def _chain(self, link: TreeLink, above: Array) -> list[Connection]:
        """One joint after the other, with links without mass between them."""
        out: list[Connection] = []
        parent, before, place = link.parent, link.place, above @ link.place
        for k, joint in enumerate(link.joints):
            last = k == len(link.joints) - 1
            child = link.name if last else plain_name(f"{link.name} {k + 1}", self.graph.links)
            name = plain_name(joint.name, self.graph.joints | {c.name: c for c in out})
            kind = {"hinge": "revolute", "slide": "prismatic", "ball": "spherical"}[joint.kind]
            places = (self._shifted(joint, before), self._axes(joint))
            out.append(
                Connection(name, kind, (parent, child), places, self._forces(joint), joint.element.line)
            )
            self.freedom[joint.name] = (name, {"hinge": "turn", "slide": "slide", "ball": ""}[joint.kind])
            self._spring(joint, name)
            place = place @ self._moved(joint, self.q)
            if not last:
                self.graph.links[child] = LinkPart(child, place, line=joint.element.line)
            parent, before = child, np.eye(4)
        return out

    def _pair(self, link: TreeLink) -> list[Connection]:
        """A slide and a hinge along it or across it as one joint; nothing for others."""
        if sorted(j.kind for j in link.joints) != ["hinge", "slide"] or any(map(self.ref, link.joints)):
            return []
        first, second = sorted(link.joints, key=lambda joint: joint.kind != "slide")
        one, two = self._axes(first), self._axes(second)
        a, b = one[:3, 0], two[:3, 2]
        if np.linalg.norm(a - b) < SAME:
            kind, axes = "cylindrical", placement(two[:3, :3] @ _X_ON_Z, two[:3, 3])
        elif abs(a @ b) < SAME and first is link.joints[0]:
            kind, axes = "slotted_cylinder", placement(np.array([a, np.cross(b, a), b]).T, two[:3, 3])
        else:
            return []
        name = self._new(_common(first.name, second.name) or f"{link.name} joint")
        damping: Tree = {}
        for joint, freedom in ((first, "slide"), (second, "turn")):
            damping |= self._forces(joint).get("damping", {})
            self.freedom[joint.name] = (name, freedom)
            self._spring(joint, name, freedom)
        more = {"damping": damping} if damping else {}
        places = (link.place @ axes, axes)
        return [Connection(name, kind, (link.parent, link.name), places, more, first.element.line)]

    def _forces(self, joint: MovedJoint) -> Tree:
        """Damping of a joint."""
        damping = joint.element.numbers(joint.keys.get("damping", "0"))
        if not damping or not damping[0]:
            return {}
        if joint.kind == "ball" or any(damping[1:]):
            self.graph.lose(f"damping of joint {joint.name!r}", joint.element.line)
            return {}
        return {"damping": {"slide" if joint.kind == "slide" else "turn": damping[0]}}

    def _spring(self, joint: MovedJoint, name: str, freedom: str = "turn") -> None:
        stiffness = joint.element.numbers(joint.keys.get("stiffness", "0"))
        if not stiffness or not stiffness[0]:
            return
        if joint.kind != "hinge" or any(stiffness[1:]):
            self.graph.lose(f"stiffness of joint {joint.name!r}", joint.element.line)
            return
        free = joint.element.numbers(joint.keys.get("springref", "0"), 1)[0] * self.tree.angle
        self.graph.loads[plain_name(f"spring {name}", self.graph.loads)] = {
            "type": "torsion_spring",
            "joint": name,
            "freedom": freedom,
            "stiffness": stiffness[0],
            "free_angle": free,
        }

    def _points(self) -> None:
        """Sites become points of their links."""
        for text, (link, place) in self.tree.sites.items():
            points: Any = self.graph.ground if link == GROUND else self.graph.links[link].points
            name = plain_name(text.removeprefix(f"{link}."), points)
            if link == GROUND:
                self.graph.ground[name] = place[:3, 3]
            else:
                solid = self.graph.links[link]
                self.graph.links[link] = replace(solid, points={**solid.points, name: place[:3, 3]})

    def _end(self, part: Element, key: str) -> str:
        text = part.get(key, "world")
        if text not in self.tree.names:
            raise part.error(f"unknown body {text!r}", "name a body of the file")
        return self.tree.names[text]

    def _ends(self, part: Element) -> tuple[tuple[str, str], tuple[Array, Array]]:
        """Links of an equality, and its axes on both."""
        if "site1" in part.attributes:
            for key in ("site1", "site2"):
                if part.get(key) not in self.tree.sites:
                    raise part.error(f"unknown site {part.get(key)!r}", "name a site of the file")
            (i, a), (j, b) = (self.tree.sites[part.get(key)] for key in ("site1", "site2"))
            return (i, j), (a, b)
        i, j = self._end(part, "body1"), self._end(part, "body2")
        where_i, where_j = (self._place_of(link, "home") for link in (i, j))
        if part.tag == "weld":
            pose = part.vector("relpose", 7, [0.0] * 7)
            if any(pose[3:]):
                return (i, j), (placement(from_quaternion(pose[3:]), pose[:3]), np.eye(4))
            return (i, j), (inverse(where_i) @ where_j, np.eye(4))
        a = placement(np.eye(3), part.vector("anchor", 3))
        return (i, j), (a, inverse(where_j) @ where_i @ a)

    def _equality(self, part: Element, balls: dict[tuple[str, str], list[Connection]]) -> None:
        if part.get("active") == "false":
            self.graph.lose(f"<{part.tag}> that is not active", part.line)
            return
        if part.tag in ("connect", "weld"):
            links, places = self._ends(part)
            name = self._new(part.get("name") or f"loop {len(self.graph.joints) + 1}")
            kind = "spherical" if part.tag == "connect" else "weld"
            if kind == "spherical":
                rotations = [placement(np.eye(3), place[:3, 3]) for place in places]
                places = (rotations[0], rotations[1])
                link = Connection(name, kind, links, places, line=part.line)
                balls.setdefault((min(links), max(links)), []).append(link)
            else:
                self.graph.joints[name] = Connection(name, kind, links, places, line=part.line)
        elif part.tag == "joint":
            self._coupled(part)
        else:
            raise part.error(f"an equality <{part.tag}> has no counterpart", "use connect, weld or joint")

    def _balls(self, pairs: list[Connection]) -> None:
        """One ball a loop; two between the same links are a hinge on the line through both."""
        if len(pairs) == 2 and pairs[0].links == pairs[1].links:
            first, second = pairs
            lines = [b[:3, 3] - a[:3, 3] for a, b in zip(first.places, second.places, strict=True)]
            lengths = [float(np.linalg.norm(line)) for line in lines]
            if lengths[0] > SAME and abs(lengths[0] - lengths[1]) < 1e-6 * lengths[0]:
                middle = [(a[:3, 3] + b[:3, 3]) / 2 for a, b in zip(first.places, second.places, strict=True)]
                places = [placement(along("z", line), at) for line, at in zip(lines, middle, strict=True)]
                name = self._new(_common(first.name, second.name) or first.name)
                self.graph.joints[name] = Connection(
                    name, "revolute", first.links, (places[0], places[1]), line=first.line
                )
                return
        for ball in pairs:
            self.graph.joints[ball.name] = ball

    def _coupled(self, part: Element) -> None:
        """Two joints that move in a ratio: a gear; one that is held: a drive at its position."""
        known = [self.freedom.get(part.get(key)) for key in ("joint1", "joint2")]
        values = part.numbers(part.get("polycoef", "0 1"), (1, 2, 3, 4, 5), "polycoef")
        coefficients = values + [0.0, 1.0, 0.0, 0.0, 0.0][len(values) :]
        if known[0] is None or ("joint2" in part.attributes and known[1] is None):
            raise part.error(
                "the equality names a joint that is a ball or does not exist", "name hinges or slides"
            )
        if known[1] is None:
            joint = self.tree.joints[part.get("joint1")]
            at = self.ref(joint) + coefficients[0]
            self.graph.drives[self._drive_name(known[0][0])] = DrivenFreedom(*known[0], at)
            self.graph.lose(f"joint {known[0][0]!r} is held: it has a drive here", part.line)
            return
        if any(coefficients[2:]):
            raise part.error("a ratio that changes has no counterpart", "give polycoef two numbers")
        here = self.graph.joints[known[0][0]]
        if known[0][0] == known[1][0] and here.kind == "cylindrical":
            pitch = coefficients[1] if known[0][1] == "slide" else 1 / coefficients[1]
            self.graph.joints[here.name] = replace(
                here, kind="screw", more=here.more | {"lead": 2 * np.pi * pitch}
            )
            return
        name = self._new(part.get("name") or f"gear {known[0][0]}")
        wheels = coupled_wheels(self.graph, known[1], known[0], coefficients[1], part)
        self.graph.joints[name] = replace(wheels, name=name)
        self.graph.lose(f"{name!r} is a gear of that ratio: its teeth press the axes apart", part.line)

    def _drive_name(self, joint: str) -> str:
        return plain_name(joint, self.graph.drives)

    def _actuators(self) -> None:
        for part in (p for e in self.tree.root.all("actuator") for p in e.parts):
            text = part.get("joint") or part.get("jointinparent")
            if text not in self.freedom or not self.freedom[text][1]:
                what = "cranksite" if part.get("cranksite") else "no single joint"
                self.graph.lose(f"actuator {part.get('name')!r} ({what}): a force without a loop", part.line)
                continue
            if self.freedom[text] in [(d.joint, d.freedom) for d in self.graph.drives.values()]:
                continue
            joint = self.tree.joints[text]
            name = self._drive_name(part.get("name") or self.freedom[text][0])
            self.graph.drives[name] = DrivenFreedom(
                *self.freedom[text], float(self.q[joint.q]), float(self.rates[joint.v])
            )
            if part.tag != "motor":
                self.graph.lose(f"law of actuator {name!r} ({part.tag})", part.line)

    def _tendons(self) -> None:
        for part in (p for e in self.tree.root.all("tendon") for p in e.parts):
            sites = [self.tree.sites.get(s.get("site")) for s in part.parts if s.tag == "site"]
            stiffness, damping = part.number("stiffness", 0.0), part.number("damping", 0.0)
            length = part.numbers(part.get("springlength", "-1"), (1, 2), "springlength")
            plain = part.tag == "spatial" and len(part.parts) == 2 == len(sites) and None not in sites
            if not plain or len(set(length)) > 1 or (stiffness and length[0] < 0):
                self.graph.lose(f"tendon {part.get('name')!r}", part.line)
                continue
            between = [f"{link}.{self._named(link, place)}" for link, place in sites if link]  # type: ignore[misc]
            name = plain_name(part.get("name") or "tendon", self.graph.loads)
            if stiffness:
                spring = {
                    "type": "spring",
                    "between": between,
                    "stiffness": stiffness,
                    "free_length": length[0],
                }
                self.graph.loads[name] = spring
            if damping:
                name = plain_name(name, self.graph.loads)
                self.graph.loads[name] = {"type": "damper", "between": between, "damping": damping}

    def _named(self, link: str, place: Array) -> str:
        points = self.graph.ground if link == GROUND else self.graph.links[link].points
        return next(name for name, at in points.items() if np.array_equal(at, place[:3, 3]))


_X_ON_Z = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])
"""Axes whose x is z of those before."""


def _common(one: str, two: str) -> str:
    """Common part of two names before a dot."""
    head, _, _ = one.rpartition(".")
    return head if head and two.rpartition(".")[0] == head else ""
