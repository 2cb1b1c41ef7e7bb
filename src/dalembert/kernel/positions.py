"""Positions of traced mechanisms: rigid parts joined one after the other in closed form, Newton for what is left.

A *part* is a set of links whose relative positions are known. Two parts with three conditions between them, or three
parts joined pairwise by pins and sliders (all five kinds of two-link groups), become one part, until all are one with
the ground. Of the two ways such a group closes the one of the mechanism's own motion is taken.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dalembert.core.layout import Layout, Pose
from dalembert.kernel import vectors as v
from dalembert.kernel.eliminate import components, matched
from dalembert.kernel.graph import CONSTANT, Graph, Node
from dalembert.kernel.newton import newton
from dalembert.kernel.relations import Relation, relations
from dalembert.kernel.vectors import Pair

Array = NDArray[Any]
Place = tuple[Pair, Pair]
"""Rotation and reference point of a link in the axes of its part."""
IDENTITY: Place = ((1.0, 0.0), (0.0, 0.0))


@dataclass
class Placed:
    """Poses of all links as nodes, and what must hold for them to be right.

    ``open``: below zero the linkage does not close; ``doubt``: below zero the general executor must look; ``flips``:
    a group changes its way of closing along the motion.
    """

    pose: Pose
    open: list[Node] = field(default_factory=list)
    doubt: list[Node] = field(default_factory=list)
    flips: bool = False


@dataclass
class Motion:
    """What positions are traced from: targets (K + D,) with their cosines and sines, and the known motion.

    ``path`` gives one quantity of the known motion, that of the mechanism with the file's numbers, as an input;
    ``signs`` says which of two relative rotations of two links it has.
    """

    graph: Graph
    layout: Layout
    target: Array
    turns: dict[int, Pair]
    path: Callable[[str, int], Node]
    signs: Callable[[Pair, Pair, int, int], Any]
    placed: set[int] = field(default_factory=set)


class Parts:
    """The parts as they grow together."""

    def __init__(self, motion: Motion) -> None:
        self.m, self.graph = motion, motion.graph
        self.ground = motion.layout.links
        self.part: dict[int, dict[int, Place]] = {k: {k: IDENTITY} for k in range(self.ground + 1)}
        self.owner = {k: k for k in range(self.ground + 1)}
        self.turn: dict[int, Node] = {self.ground: self.graph.zero}
        self.todo = relations(motion.layout, motion.target, motion.turns)
        self.out = Placed(Pose(np.zeros(0), np.zeros(0), np.zeros(0)))

    def grow(self) -> Placed:
        """Join parts until one is left."""
        while len(self.part) > 1:
            if not (self.pairs() or self.triples()):
                self.general()
        self.out.pose = self.pose()
        return self.out

    def between(self) -> dict[tuple[int, int], list[Relation]]:
        """Conditions between each two parts."""
        out: dict[tuple[int, int], list[Relation]] = {}
        for r in self.todo:
            a, b = sorted((self.owner[r.i], self.owner[r.j]))
            if a != b:
                out.setdefault((a, b), []).append(r)
        return out

    def point(self, link: int, u: Pair) -> Pair:
        """A point of a link in the axes of its part."""
        rotation, point = self.part[self.owner[link]][link]
        return v.plus(point, v.turned(rotation, u))

    def base(self, *parts: int) -> list[int]:
        """Ground first, else the largest part."""
        return sorted(parts, key=lambda k: (k != self.owner[self.ground], -len(self.part[k]), k))

    def merge(self, x: int, y: int, pose: Place) -> None:
        """Part y becomes part of x, at a pose in its axes."""
        for link, (rotation, point) in self.part.pop(y).items():
            self.part[x][link] = (v.turned(pose[0], rotation), v.plus(pose[1], v.turned(pose[0], point)))
            self.owner[link] = x

    def join(self, x: int, *others: tuple[int, Place]) -> None:
        """Parts with their poses in the axes of x become one with it; with the ground, if it is among them."""
        ground = self.owner[self.ground]
        at = next((pose for part, pose in others if part == ground), None)
        if at is None:
            for part, pose in others:
                self.merge(x, part, pose)
            return
        back = _inverted(at)
        self.merge(ground, x, back)
        for part, pose in others:
            if part != ground:
                self.merge(ground, part, _composed(back, pose))

    # two parts

    def pairs(self) -> bool:
        for (a, b), found in self.between().items():
            x, y = self.base(a, b)
            pose = self.pair(x, y, found)
            if pose is not None:
                self.merge(x, y, pose)
                return True
        return False

    def pair(self, x: int, y: int, found: list[Relation]) -> Place | None:
        turns = [r for r in found if r.kind == "turn"]
        meets = [r for r in found if r.kind == "meet"]
        along = [r for r in found if r.kind == "along"]
        if turns and (meets or len(along) >= 2):
            rotation = self.rotation(turns[0], y)
            return rotation, self.translation(rotation, y, meets, along)
        if meets and along:
            return self.pin_and_slot(x, y, meets[0], along[0])
        if meets and any(r.kind == "mesh" for r in found) and x == self.owner[self.ground]:
            return self.wheel(y, meets[0], next(r for r in found if r.kind == "mesh"))
        return None

    def rotation(self, r: Relation, y: int) -> Pair:
        """Rotation of part y in the axes of the other, from a fixed relative turn."""
        i, j = self.part[self.owner[r.i]][r.i][0], self.part[self.owner[r.j]][r.j][0]
        if self.owner[r.j] == y:
            self.follow(r, r.i, r.j, 1.0)
            return v.unturned(j, v.turned(i, r.turn))
        self.follow(r, r.j, r.i, -1.0)
        return v.unturned(i, v.unturned(r.turn, j))

    def follow(self, r: Relation, known: int, new: int, sign: float) -> None:
        if known in self.turn:
            self.turn[new] = self.turn[known] + sign * r.target

    def translation(self, rotation: Pair, y: int, meets: list[Relation], along: list[Relation]) -> Pair:
        if meets:
            r = meets[0]
            (lx, ux), (ly, uy) = self.ends(r, y)
            return v.minus(self.point(lx, ux), v.turned(rotation, self.point(ly, uy)))
        (n1, c1), (n2, c2) = (self.line(r, y, rotation) for r in along[:2])
        det = v.cross(n1, n2)
        self.regular(det)
        return (c1 * n2[1] - c2 * n1[1]) / det, (n1[0] * c2 - n2[0] * c1) / det

    def ends(self, r: Relation, y: int) -> tuple[tuple[int, Pair], tuple[int, Pair]]:
        """(link, point) of the end on the other part, and on part y."""
        return ((r.i, r.ui), (r.j, r.uj)) if self.owner[r.j] == y else ((r.j, r.uj), (r.i, r.ui))

    def line(self, r: Relation, y: int, rotation: Pair) -> tuple[Pair, Any]:
        """A slide's condition n . T = c on the translation T of part y, whose rotation is known."""
        axis = v.turned(self.part[self.owner[r.i]][r.i][0], r.axis)
        pi, pj = self.point(r.i, r.ui), self.point(r.j, r.uj)
        if self.owner[r.j] == y:
            return axis, r.target - v.dot(axis, v.minus(v.turned(rotation, pj), pi))
        e = v.turned(rotation, axis)
        return e, v.dot(e, v.minus(pj, v.turned(rotation, pi))) - r.target

    def pin_and_slot(self, x: int, y: int, pin: Relation, slot: Relation) -> Place:
        """A part pinned to another, and a point of one on a line of the other."""
        (lx, ux), (ly, uy) = self.ends(pin, y)
        px, py = self.point(lx, ux), self.point(ly, uy)
        axis = v.turned(self.part[self.owner[slot.i]][slot.i][0], slot.axis)
        pi, pj = self.point(slot.i, slot.ui), self.point(slot.j, slot.uj)
        on_y = self.owner[slot.j] == y

        def rotation(sign: Any) -> Pair:
            if on_y:  # the line on x, the point on y
                arm = v.minus(pj, py)
                k = slot.target - v.dot(axis, v.minus(px, pi))
                length2 = v.dot(arm, arm)
                h = self.root(length2 - k * k, length2)
                w = v.plus(v.times(k, axis), v.times(sign * h, v.across(axis)))
                return self.onto(arm, length2, w)
            d = v.minus(pj, px)
            k = slot.target + v.dot(axis, v.minus(pi, py))
            d2 = v.dot(d, d)
            h = self.root(d2 - k * k, d2)
            e = v.times(1.0 / d2, v.plus(v.times(k, d), v.times(sign * h, v.across(d))))
            return v.unturned(axis, e)

        r = self.chosen(rotation, x, y)
        return r, v.minus(px, v.turned(r, py))

    def wheel(self, y: int, pin: Relation, mesh: Relation) -> Place | None:
        """A wheel pinned at its centre, in mesh with one whose angle is known (ground axes)."""
        wheel, other = (mesh.j, mesh.i) if self.owner[mesh.j] == y else (mesh.i, mesh.j)
        (lx, ux), (ly, uy) = self.ends(pin, y)
        centre = mesh.uj if wheel == mesh.j else mesh.ui
        if ly != wheel or not all(a is b or a == b for a, b in zip(uy, centre, strict=True)):
            return None
        px = self.point(lx, ux)
        u = mesh.ui if wheel == mesh.j else mesh.uj
        line = v.minus(px, self.point(other, u))
        ri, rj = mesh.radii
        if wheel == mesh.i:
            line, (ri, rj) = v.times(-1.0, line), (rj, ri)
        phi = self.near(line, "line", mesh.rows[0])
        theta = (mesh.target + (ri + rj) * phi - ri * self.turn_of(other)) / rj
        self.turn[wheel] = theta
        r = v.unturned(self.part[y][wheel][0], (theta.cos(), theta.sin()))
        return r, v.minus(px, v.turned(r, self.point(ly, uy)))

    # three parts

    def triples(self) -> bool:
        found = self.between()
        parts = sorted(self.part, key=lambda k: k != self.owner[self.ground])
        near = {k: {b for pair in found for b in pair if k in pair and b != k} for k in parts}
        for a in parts:
            for b, c in combinations(sorted(near[a]), 2):
                if c in near[b] and self.triple(a, b, c, found):
                    return True
        return False

    def triple(self, a: int, b: int, c: int, found: dict[tuple[int, int], list[Relation]]) -> bool:
        sides = [(min(p), max(p)) for p in combinations((a, b, c), 2)]
        kinds = {pair: _kind(found[pair]) for pair in sides}
        slides = [pair for pair, kind in kinds.items() if kind == "slide"]
        if None in kinds.values() or len(slides) > 2:
            return False
        if len(slides) == 2:
            self.two_slides(slides, next(p for p in kinds if p not in slides), found)
        elif slides:
            self.one_slide(slides[0], next(k for k in (a, b, c) if k not in slides[0]), found)
        else:
            x, y, z = self.base(a, b, c)
            self.three_pins(x, y, z, found)
        return True

    def pins(self, x: int, y: int, found: dict[tuple[int, int], list[Relation]]) -> tuple[Pair, Pair]:
        """The common pin's place on x and on y."""
        a, b = sorted((x, y))
        r = next(r for r in found[a, b] if r.kind == "meet")
        (lx, ux), (ly, uy) = self.ends(r, y)
        return self.point(lx, ux), self.point(ly, uy)

    def three_pins(self, x: int, y: int, z: int, found: dict[tuple[int, int], list[Relation]]) -> None:
        (a, ya), (b, zb), (yc, zc) = self.pins(x, y, found), self.pins(x, z, found), self.pins(y, z, found)
        d, p, q = v.minus(b, a), v.minus(yc, ya), v.minus(zc, zb)
        d2, p2, q2 = v.dot(d, d), v.dot(p, p), v.dot(q, q)
        over = 1.0 / d2
        t = 0.5 * (over * (p2 - q2) + 1.0)
        h = self.root(over * p2 - t * t, 1.0)

        def sides(sign: Any) -> tuple[Pair, Pair]:
            e = v.plus(v.times(t, d), v.times(sign * h, v.across(d)))
            return self.onto(p, p2, e), self.onto(q, q2, v.minus(e, d))

        self.chosen(lambda sign: sides(sign)[0], x, y)
        ry, rz = sides(self.sign)
        self.join(x, (y, (ry, v.minus(a, v.turned(ry, ya)))), (z, (rz, v.minus(b, v.turned(rz, zb)))))

    def one_slide(self, slide: tuple[int, int], y: int, found: dict[tuple[int, int], list[Relation]]) -> None:
        """Parts x and z slide on each other; y has a pin on each."""
        x, z = self.base(*slide)
        turn = next(r for r in found[slide] if r.kind == "turn")
        along = next(r for r in found[slide] if r.kind == "along")
        rz = self.rotation(turn, z)
        n, c = self.line(along, z, rz)
        (a, ya), (b, yb) = self.pins(x, y, found), self.pins(z, y, found)
        p = v.minus(yb, ya)
        k = c + v.dot(n, v.minus(v.turned(rz, b), a))
        p2 = v.dot(p, p)
        h = self.root(p2 - k * k, p2)

        def side(sign: Any) -> Pair:
            return v.plus(v.times(k, n), v.times(sign * h, v.across(n)))

        def rotation(sign: Any) -> Pair:
            return self.onto(p, p2, side(sign))

        ry = self.chosen(rotation, x, y)
        at = v.plus(a, side(self.sign))
        self.join(x, (z, (rz, v.minus(at, v.turned(rz, b)))), (y, (ry, v.minus(a, v.turned(ry, ya)))))

    def two_slides(
        self,
        slides: list[tuple[int, int]],
        pin: tuple[int, int],
        found: dict[tuple[int, int], list[Relation]],
    ) -> None:
        """Part x slides on y and on z, which are pinned together: all turns are known, the rest is linear."""
        x = next(k for k in slides[0] if k in slides[1])
        y, z = (next(k for k in pair if k != x) for pair in slides)
        rotations, lines = [], []
        for k, pair in ((y, slides[0]), (z, slides[1])):
            rotations.append(self.rotation(next(r for r in found[pair] if r.kind == "turn"), k))
            lines.append(self.line(next(r for r in found[pair] if r.kind == "along"), k, rotations[-1]))
        yc, zc = self.pins(y, z, found)
        (n1, c1), (n2, c2) = lines  # of the translations; of the common pin:
        c1 = c1 + v.dot(n1, v.turned(rotations[0], yc))
        c2 = c2 + v.dot(n2, v.turned(rotations[1], zc))
        det = v.cross(n1, n2)
        self.regular(det)
        at = (c1 * n2[1] - c2 * n1[1]) / det, (n1[0] * c2 - n2[0] * c1) / det
        first = rotations[0], v.minus(at, v.turned(rotations[0], yc))
        second = rotations[1], v.minus(at, v.turned(rotations[1], zc))
        self.join(x, (y, first), (z, second))

    # the rest

    def onto(self, u: Pair, length2: Any, w: Pair) -> Pair:
        """The rotation that turns a vector u, of known square, into w of the same length."""
        r = v.unturned(v.times(1.0 / length2, u), w)
        for node, same in zip(v.turned(r, u), w, strict=True):
            self.graph.known(node, same)
        return r

    def root(self, square: Any, scale: Any) -> Any:
        """Square root of what is negative where the linkage does not close."""
        if not isinstance(square, Node):
            square = self.graph.constant(square)
        if square.level != CONSTANT:
            small = DEAD * scale
            self.out.open.append(square + small)
            self.out.doubt.append(square - small)
        return square.sqrt()

    def regular(self, det: Any) -> None:
        if isinstance(det, Node) and det.level != CONSTANT:
            self.out.doubt.append(det * det - DEAD)

    def chosen(self, rotation: Callable[[Any], Pair], x: int, y: int) -> Pair:
        """The rotation of y in x of the two, that the known motion has; ``sign`` is kept for the other parts."""
        lx = self.ground if self.ground in self.part[x] else min(self.part[x])
        ly = min(self.part[y])
        rx, ry = self.part[x][lx][0], self.part[y][ly][0]
        before = len(self.out.open), len(self.out.doubt)
        ways = [v.unturned(rx, v.turned(rotation(s), ry)) for s in (1.0, -1.0)]
        del self.out.open[before[0] :], self.out.doubt[before[1] :]
        self.sign: Any = self.m.signs(ways[0], ways[1], lx, ly)
        if isinstance(self.sign, Node):
            self.out.flips = self.out.flips or self.sign.level != CONSTANT
        return rotation(self.sign)

    def near(self, line: Pair, what: str, which: int) -> Any:
        """Angle of a line, whole turns counted along the known motion."""
        c, s = self.m.path(what + " cos", which), self.m.path(what + " sin", which)
        off = self.graph.binary(
            "atan2", _node(self.graph, c * line[1] - s * line[0]), _node(self.graph, v.dot((c, s), line))
        )
        return self.m.path(what, which) + off

    def turn_of(self, link: int) -> Node:
        """Angle of a link of the ground's part, whole turns counted."""
        if link not in self.turn:
            self.turn[link] = self.near(self.part[self.owner[self.ground]][link][0], "turn", link)
        return self.turn[link]

    def general(self) -> None:
        """Newton for the fewest links that can be placed together."""
        links = self.smallest()
        ground = self.owner[self.ground]
        self.m.placed = set(self.part[ground])
        found = newton(self.m, self.pose(partial=True), links)
        self.out.doubt += found.doubt
        for link in links:
            self.part.pop(self.owner[link], None)
        for link in links:
            self.owner[link] = ground
            point, rotation = found.pose.point[link], found.pose.rotation[link]
            self.part[ground][link] = ((rotation[0], rotation[1]), (point[0], point[1]))
            self.turn[link] = found.pose.turn[link]

    def smallest(self) -> list[int]:
        """Links of the first block of parts that depends on nothing unplaced."""
        ground = self.owner[self.ground]
        wants: dict[int, set[int]] = {}
        for r in self.todo:
            parts = {self.owner[r.i], self.owner[r.j]} - {ground}
            if self.owner[r.i] != self.owner[r.j]:
                for row in r.rows:
                    wants[row] = {3 * p + k for p in parts for k in range(3)}
        match = matched(wants)
        if len(match) < 3 * (len(self.part) - 1):
            raise ValueError("the positions are not determined by the drives")
        needs: dict[int, set[int]] = {p: set() for p in self.part if p != ground}
        for row, column in match.items():
            needs[column // 3] |= {c // 3 for c in wants[row]} - {column // 3}
        first = components(needs)[0]
        return sorted(link for p in first for link in self.part[p])

    def pose(self, partial: bool = False) -> Pose:
        """Poses of all links; with ``partial``, the known motion's where a link is not placed yet."""
        size = self.ground + 1
        point, rotation = np.empty((size, 2), object), np.empty((size, 2), object)
        turn = np.empty(size, object)
        placed = self.part[self.owner[self.ground]]
        for link in range(size):
            if link in placed:
                (c, s), (x, y) = placed[link]
                angle: Any = self.turn_of(link)
            else:
                assert partial
                x, y, angle, c, s = (self.m.path(k, link) for k in ("x", "y", "turn", "turn cos", "turn sin"))
            point[link] = [_node(self.graph, x), _node(self.graph, y)]
            rotation[link] = [_node(self.graph, c), _node(self.graph, s)]
            turn[link] = _node(self.graph, angle)
        return Pose(point, turn, rotation)


DEAD = 1e-5
"""Square of the sine of a group's transmission angle below which the general executor decides."""


def _node(graph: Graph, x: Any) -> Node:
    return x if type(x) is Node else graph.constant(x)


def _kind(found: list[Relation]) -> str | None:
    """pin, slide, or None where the two parts are joined otherwise."""
    kinds = sorted(r.kind for r in found)
    if "meet" in kinds:
        return "pin"
    return "slide" if "turn" in kinds and "along" in kinds else None


def _inverted(pose: Place) -> Place:
    r, t = pose
    back = (r[0], -r[1])
    return back, v.times(-1.0, v.turned(back, t))


def _composed(a: Place, b: Place) -> Place:
    return v.turned(a[0], b[0]), v.plus(a[1], v.turned(a[0], b[1]))


def positions(motion: Motion) -> Placed:
    """Poses of all links from the drives' positions."""
    return Parts(motion).grow()
