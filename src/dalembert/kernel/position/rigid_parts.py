"""Parts: sets of links whose relative positions are known, and the operations for their closed forms."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from dalembert.arrays import Array
from dalembert.core.layout import Layout, Pose
from dalembert.kernel.graph import CONSTANT, POSITION, Graph, Node, Scalar
from dalembert.kernel.position import plane_vectors as v
from dalembert.kernel.position.placing_order import UNDETERMINED, blocks, dependent_rows
from dalembert.kernel.position.plane_vectors import Pair
from dalembert.kernel.position.relations import Relation, relations

Place = tuple[Pair, Pair]
"""Rotation and reference point of a link in the axes of its part."""
IDENTITY: Place = ((1.0, 0.0), (0.0, 0.0))
DEAD = 1e-5
"""Square of the sine of a group's transmission angle below which the general executor decides."""


@dataclass
class PlacedPose:
    """Poses of all links as nodes, and conditions for their validity.

    ``open``: below zero the linkage does not close; ``doubt``: below zero the general executor decides; ``flips``:
    a group changes its branch along the motion. ``pivots``: zero where two lines that meet are parallel, so that no
    motion leads from one sign to the other.
    """

    pose: Pose
    open: list[Node] = field(default_factory=list)
    doubt: list[Node] = field(default_factory=list)
    flips: bool = False
    pivots: list[Node] = field(default_factory=list)

    def root(self, graph: Graph, square: Scalar, scale: Scalar) -> Scalar:
        """Square root of a node that is negative where the linkage does not close; its inverse is computed with it."""
        if not isinstance(square, Node):
            square = graph.constant(square)
        if square.level == CONSTANT:
            return square.sqrt()
        small = DEAD * scale
        self.open.append(square + small)
        self.doubt.append(square - small)
        inverse = graph.unary("rsqrt", square)
        root = square * inverse
        graph.assume_equal(root * root, square)
        graph.assume_equal(1.0 / root, inverse)
        return root


@dataclass
class TracePlan:
    """Data from which positions are traced: targets (K + D,) with their cosines and sines, and the known motion.

    ``path`` gives one quantity of the known motion, that of the mechanism with the file's numbers, as an input;
    ``signs`` gives which of two relative rotations of two links that motion has; in space, which of two rotations, or
    points, of the second link, in ground axes. ``moves``: the drives' positions differ from the known motion's.
    ``redundant``: some rows, the ``dependent``, repeat others; in the plane, if ``unsplit``, links held by these are
    placed with all rows at once.
    """

    graph: Graph
    layout: Layout
    target: Array
    turns: dict[int, Pair]
    path: Callable[[str, int], Node]
    signs: Callable[[tuple[Scalar, ...], tuple[Scalar, ...], int, int], Scalar]
    placed: set[int] = field(default_factory=set)
    moves: bool = False
    redundant: bool = False
    unsplit: bool = False
    dependent: frozenset[int] = frozenset()


class Parts:
    """The parts during assembly."""

    def __init__(self, motion: TracePlan) -> None:
        self.m, self.graph = motion, motion.graph
        self.ground = motion.layout.links
        self.part: dict[int, dict[int, Place]] = {k: {k: IDENTITY} for k in range(self.ground + 1)}
        self.owner = {k: k for k in range(self.ground + 1)}
        self.turn: dict[int, Node] = {self.ground: self.graph.zero}
        self.todo = relations(motion.layout, motion.target, motion.turns)
        self.order = {id(r): k for k, r in enumerate(self.todo)}
        self.tied: set[int] = set()
        if motion.redundant:
            motion.dependent = dependent_rows(motion.graph, motion.layout, self.pose(partial=True))
        if motion.unsplit:
            repeated = {k for r in self.todo if motion.dependent & set(r.rows) for k in (r.i, r.j)}
            self.tied = {k for block in self.blocks() if repeated & set(block) for k in block}
        self.find_between()
        self.out = PlacedPose(Pose(np.zeros(0), np.zeros(0), np.zeros(0)))

    def blocks(self) -> list[list[int]]:
        """Parts that can only be placed together, those without unplaced dependencies first."""
        name = {part: -1 if part == self.owner[self.ground] else part for part in self.part}
        ends = {row: {name[self.owner[r.i]], name[self.owner[r.j]]} for r in self.todo for row in r.rows}
        conditions = {row: parts for row, parts in ends.items() if len(parts) > 1}
        if set(name.values()) - {-1} - set().union(*conditions.values()):
            raise ValueError(UNDETERMINED)
        return blocks(conditions, 3, self.m.dependent)

    def find_between(self) -> None:
        """Collects the conditions ``between`` each two parts, in order, and the parts ``near`` each; without conditions
        that others repeat, and without those of links placed all at once."""
        later = {k for k in self.tied if self.owner[k] != self.owner[self.ground]}
        self.between: dict[tuple[int, int], list[Relation]] = {}
        self.near: dict[int, set[int]] = {part: set() for part in self.part}
        for r in self.todo:
            useful = not later & {r.i, r.j} and not self.m.dependent & set(r.rows)
            if useful and self.owner[r.i] != self.owner[r.j]:
                self.add_between(self.owner[r.i], self.owner[r.j], [r])

    def add_between(self, a: int, b: int, more: list[Relation]) -> None:
        between = self.between.setdefault((min(a, b), max(a, b)), [])
        between += more
        between.sort(key=lambda r: self.order[id(r)])
        self.near[a].add(b)
        self.near[b].add(a)

    def point(self, link: int, u: Pair) -> Pair:
        """A point of a link in the axes of its part."""
        rotation, point = self.part[self.owner[link]][link]
        return v.plus(point, v.rotate(rotation, u))

    def base(self, *parts: int) -> list[int]:
        """Ground first, else the largest part."""
        return sorted(parts, key=lambda k: (k != self.owner[self.ground], -len(self.part[k]), k))

    def merge(self, x: int, y: int, pose: Place) -> None:
        """Part y becomes part of x, at a pose in its axes."""
        for z in self.near.pop(y):
            moved = self.between.pop((min(y, z), max(y, z)))
            self.near[z].discard(y)
            if z != x:
                self.add_between(x, z, moved)
        for link, (rotation, point) in self.part.pop(y).items():
            self.part[x][link] = (v.rotate(pose[0], rotation), v.plus(pose[1], v.rotate(pose[0], point)))
            self.owner[link] = x

    def join(self, x: int, *others: tuple[int, Place]) -> None:
        """Merges parts, with their poses in the axes of x, into one; into the ground's part, if it is among them."""
        ground = self.owner[self.ground]
        at = next((pose for part, pose in others if part == ground), None)
        if at is None:
            for part, pose in others:
                self.merge(x, part, pose)
            return
        back = _inverse(at)
        self.merge(ground, x, back)
        for part, pose in others:
            if part != ground:
                self.merge(ground, part, _compose(back, pose))

    def rotation(self, r: Relation, y: int) -> Pair:
        """Rotation of part y in the axes of the other, from a fixed relative turn."""
        i, j = self.part[self.owner[r.i]][r.i][0], self.part[self.owner[r.j]][r.j][0]
        if self.owner[r.j] == y:
            self.follow(r, r.i, r.j, 1.0)
            return v.rotate_back(j, v.rotate(i, r.turn))
        self.follow(r, r.j, r.i, -1.0)
        return v.rotate_back(i, v.rotate_back(r.turn, j))

    def follow(self, r: Relation, known: int, new: int, sign: float) -> None:
        if known in self.turn:
            self.turn[new] = self.turn[known] + sign * r.target

    def translation(self, rotation: Pair, y: int, meets: list[Relation], along: list[Relation]) -> Pair:
        if meets:
            r = meets[0]
            (lx, ux), (ly, uy) = self.ends(r, y)
            return v.minus(self.point(lx, ux), v.rotate(rotation, self.point(ly, uy)))
        (n1, c1), (n2, c2) = (self.line(r, y, rotation) for r in along[:2])
        det = v.cross(n1, n2)
        self.regular(det)
        return (c1 * n2[1] - c2 * n1[1]) / det, (n1[0] * c2 - n2[0] * c1) / det

    def ends(self, r: Relation, y: int) -> tuple[tuple[int, Pair], tuple[int, Pair]]:
        """(link, point) of the end on the other part, and on part y."""
        return ((r.i, r.ui), (r.j, r.uj)) if self.owner[r.j] == y else ((r.j, r.uj), (r.i, r.ui))

    def line(self, r: Relation, y: int, rotation: Pair) -> tuple[Pair, Scalar]:
        """A slide's condition n . T = c on the translation T of part y, whose rotation is known."""
        axis = v.rotate(self.part[self.owner[r.i]][r.i][0], r.axis)
        pi, pj = self.point(r.i, r.ui), self.point(r.j, r.uj)
        if self.owner[r.j] == y:
            return axis, r.target - v.dot(axis, v.minus(v.rotate(rotation, pj), pi))
        e = v.rotate(rotation, axis)
        return e, v.dot(e, v.minus(pj, v.rotate(rotation, pi))) - r.target

    def pins(self, x: int, y: int) -> tuple[Pair, Pair]:
        """The common pin's place on x and on y."""
        r = next(r for r in self.between[min(x, y), max(x, y)] if r.kind == "meet")
        (lx, ux), (ly, uy) = self.ends(r, y)
        return self.point(lx, ux), self.point(ly, uy)

    def onto(self, u: Pair, length2: Scalar, w: Pair) -> Pair:
        """The rotation that turns a vector u, of known square, into w of the same length."""
        r = v.rotate_back(v.times(1.0 / length2, u), w)
        for node, same in zip(v.rotate(r, u), w, strict=True):
            self.graph.assume_equal(node, same)
        return r

    def root(self, square: Scalar, scale: Scalar) -> Scalar:
        """Square root of a node that is negative where the linkage does not close."""
        return self.out.root(self.graph, square, scale)

    def add_doubt(self, margin: Scalar) -> None:
        """Adds a node that is negative where the general executor must decide."""
        if isinstance(margin, Node) and margin.level != CONSTANT:
            self.out.doubt.append(margin)

    def set_cross_product(self, a: Pair, b: Pair, product: Scalar) -> None:
        """Stores the products a x b and b x a, determinants of the group, which need not be computed again."""
        self.graph.assume_equal(v.cross(a, b), product)
        self.graph.assume_equal(v.cross(b, a), -product)

    def longer(self, a: Scalar, b: Scalar) -> bool:
        """True if one square is larger than another at the file's numbers; False where they change along the motion."""
        moving = any(type(x) is Node and x.level & POSITION for x in (a, b))
        return not moving and bool(a > b)

    def regular(self, det: Scalar) -> None:
        self.add_doubt(det * det - DEAD)
        if isinstance(det, Node) and det.level & POSITION:
            self.out.pivots.append(det)

    def choose_rotation(self, rotation: Callable[[Scalar], Pair], x: int, y: int) -> Pair:
        """The rotation of y in x, of two candidates, that the known motion has; ``sign`` is kept for the
        other parts."""
        lx = self.ground if self.ground in self.part[x] else min(self.part[x])
        ly = min(self.part[y])
        rx, ry = self.part[x][lx][0], self.part[y][ly][0]
        before = len(self.out.open), len(self.out.doubt)
        candidates = [v.rotate_back(rx, v.rotate(rotation(s), ry)) for s in (1.0, -1.0)]
        del self.out.open[before[0] :], self.out.doubt[before[1] :]
        self.sign: Scalar = self.m.signs(candidates[0], candidates[1], lx, ly)
        if isinstance(self.sign, Node):
            self.out.flips = self.out.flips or self.sign.level != CONSTANT
        return rotation(self.sign)

    def angle_near(self, line: Pair, what: str, which: int) -> Node:
        """Angle of a line, with whole turns counted along the known motion."""
        c, s = self.m.path(what + " cos", which), self.m.path(what + " sin", which)
        off = self.graph.binary(
            "atan2", _node(self.graph, c * line[1] - s * line[0]), _node(self.graph, v.dot((c, s), line))
        )
        return self.m.path(what, which) + off

    def turn_of(self, link: int) -> Node:
        """Angle of a link of the ground's part, with whole turns."""
        if link not in self.turn:
            self.turn[link] = self.angle_near(self.part[self.owner[self.ground]][link][0], "turn", link)
        return self.turn[link]

    def pose(self, partial: bool = False) -> Pose:
        """Poses of all links; with ``partial``, the known motion's where a link is not placed yet."""
        size = self.ground + 1
        point, rotation = np.empty((size, 2), object), np.empty((size, 2), object)
        turn = np.empty(size, object)
        placed = self.part[self.owner[self.ground]]
        for link in range(size):
            if link in placed:
                (c, s), (x, y) = placed[link]
                angle: Scalar = self.turn_of(link)
            else:
                assert partial
                x, y, angle, c, s = (self.m.path(k, link) for k in ("x", "y", "turn", "turn cos", "turn sin"))
            point[link] = [_node(self.graph, x), _node(self.graph, y)]
            rotation[link] = [_node(self.graph, c), _node(self.graph, s)]
            turn[link] = _node(self.graph, angle)
        return Pose(point, turn, rotation)


def _node(graph: Graph, x: Scalar) -> Node:
    return x if type(x) is Node else graph.constant(x)


def _inverse(pose: Place) -> Place:
    r, t = pose
    back = (r[0], -r[1])
    return back, v.times(-1.0, v.rotate(back, t))


def _compose(a: Place, b: Place) -> Place:
    return v.rotate(a[0], b[0]), v.plus(a[1], v.rotate(a[0], b[1]))
