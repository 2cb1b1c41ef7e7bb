"""End conditions of a column from its joints: drives and unknown loads hold, other links are rigid, to the first order.

The column is cut at its nodes into rigid pieces, each with its joints; neighbours keep their distance and do not twist
against each other. The motions that the mechanism's constraints leave these pieces are those of the column's nodes.

Mechanics: docs/theory.md 10.4.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.arrays import Array, Flags
from dalembert.core.constraints import stack_rows
from dalembert.core.equilibrium import load_rows
from dalembert.core.layout import ConstraintRows, Pose
from dalembert.machine.link_axes import in_space
from dalembert.machine.members.column_loads import LOOSE, column_space, is_loose
from dalembert.model import GROUND

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism

LOAD = "load {}"
"""An unknown load among the joints at a node: it holds what it acts on, as a joint does."""
RANK = 1e-9
"""Part of the largest singular value below which a motion is free."""


@dataclass(frozen=True)
class ColumnNode:
    """A place of a column at a distance s, m, from its start: a piece of a link, with its joints and unknown loads."""

    link: str
    s: float
    joints: tuple[str, ...] = ()


@dataclass(frozen=True)
class BucklingColumn:
    """A straight column at one position: nodes in order, start (3,) and axes (3, 3) in rows t, y, z, ground axes.

    ``inside``: the joint that its two links slide by.
    """

    nodes: tuple[ColumnNode, ...]
    start: Array
    axes: Array
    inside: str = ""

    def spans(self) -> list[float]:
        """Distances between neighbouring nodes, m."""
        return [b.s - a.s for a, b in zip(self.nodes[:-1], self.nodes[1:], strict=True)]


class EndConditions:
    """The rows of A of all positions of a result, and what they leave the nodes of a column."""

    def __init__(self, r: Result) -> None:
        self.r = r
        self.layout = r.compiled.layout
        self.pose: Pose = full_pose(r)
        rows = np.flatnonzero([*(self.layout.constraints.count * [True]), *r.compiled.known.requested])
        with np.errstate(all="ignore"):
            held = stack_rows(self.layout, self.pose).rows(rows)
            self.rows: ConstraintRows = held + load_rows(self.layout, r.compiled.known, self.pose)
        joints = [r.joints[j] if j >= 0 else "" for j in self.layout.stack.joint[rows]]
        self.of = [*joints, *(LOAD.format(name) for name in r.unknown_loads)]

    def motions(self, k: int, column: BucklingColumn) -> Array:
        """Motions of the nodes at position k as orthonormal columns (4 N, j): y / L and y' of each node in turn for
        bending along y, then the same along z."""
        every = np.zeros(len(self.rows.i), bool)
        if self.r.mechanism.dimension == 3:
            return self._motions(k, column, every)
        held = self._motions(k, column, self._unguided(column))
        if is_loose(held, _shares(column)):
            held = self._motions(k, column, every)
        across = self._across(column)
        out = np.zeros((2 * len(held), held.shape[1] + across.shape[1]))
        out[: len(held), : held.shape[1]], out[len(held) :, held.shape[1] :] = held, across
        return out

    def _unguided(self, column: BucklingColumn) -> Flags:
        """Rows by which a slider without the length of its guide would hold the column's angle."""
        joints = {j for node in column.nodes for j in node.joints}
        known = self.r.mechanism.joints
        loose = [j in joints and j in known and _is_short(known[j]) for j in self.of]
        return np.asarray(np.array(loose, bool) & self.rows.angular)

    def _motions(self, k: int, column: BucklingColumn, dropped: Flags) -> Array:
        g, length = self.layout.algebra, self.layout.length
        pieces = _Pieces(self, k, column)
        matrix = np.concatenate([pieces.constraints(dropped), pieces.joining()])
        scale = np.tile(np.repeat([1.0, 1 / length], [g.d, g.n - g.d]), matrix.shape[1] // g.n)
        scaled = matrix * scale
        size = np.linalg.norm(scaled, axis=1)
        scaled = scaled[size > 0] / size[size > 0, None]
        _, values, right = np.linalg.svd(scaled)
        rank = int((values > RANK * values.max(initial=0.0)).sum())
        free = right[rank:].T * scale[:, None]
        forms = pieces.deflections()
        unit = np.tile([1 / sum(column.spans()), 1.0], len(forms) // 2)[:, None]
        return column_space(forms @ free * unit)

    def _across(self, column: BucklingColumn) -> Array:
        """Across the plane a mechanism's joints hold their places; welds hold the angle, other joints do so only where
        nothing else would hold the column."""
        m = self.r.mechanism
        carrying = {j for node in column.nodes for j in carrying_joints(m, node.link)}
        known = {name: joint for name, joint in m.joints.items() if name not in carrying}
        kinds = [[known[j] for j in node.joints if j in known] for node in column.nodes]
        held = [any(not j.wheels for j in some) for some in kinds]
        clamped = [any(not (j.freedoms or j.wheels) for j in some) for some in kinds]
        if sum(held) == 1:
            clamped = held
        keep = [not x for pair in zip(held, clamped, strict=True) for x in pair]
        return np.eye(len(keep))[:, keep]


def carrying_joints(m: Mechanism, link: str) -> dict[str, str]:
    """Welds of a link to others that have no other joint, which it carries and which do not hold it: joint -> other."""
    out = {}
    for name, joint in m.joints.items():
        if link in joint.links and not joint.freedoms:
            other = next(n for n in joint.links if n != link)
            if other != GROUND and sum(other in j.links for j in m.joints.values()) == 1:
                out[name] = other
    return out


def _is_short(joint: Any) -> bool:
    """True for a planar slider without a length of its guide."""
    return joint.guides and getattr(joint.friction, "guide", None) is None


def _shares(column: BucklingColumn) -> list[float]:
    spans = column.spans()
    return [x / sum(spans) for x in spans]


class _Pieces:
    """The links of a mechanism at one position, those of a column cut at its nodes."""

    def __init__(self, of: EndConditions, k: int, column: BucklingColumn) -> None:
        self.of, self.k, self.column = of, k, column
        r, layout = of.r, of.layout
        self.n, self.d, self.count = layout.algebra.n, layout.algebra.d, layout.links
        self.width = self.n * (self.count + len(column.nodes))
        self.arms = []
        for node in column.nodes:
            origin = of.pose.point[k, r.links.index(node.link)] + r.compiled.origin
            self.arms.append(column.start + node.s * column.axes[0] - in_space(origin))

    def constraints(self, dropped: Flags) -> Array:
        """The mechanism's rows (K, n (L + N)), each on the piece that has its joint."""
        r, rows, nodes = self.of.r, self.of.rows, self.column.nodes
        joints = self.of.of
        some = np.flatnonzero(~dropped & np.array([j != self.column.inside or not j for j in joints]))
        piece = {(node.link, j): self.count + m for m, node in enumerate(nodes) for j in node.joints}
        first = {node.link: self.count + m for m, node in reversed([*enumerate(nodes)])}
        full = np.zeros((len(some), self.count + len(nodes) + 1, self.n))
        names = (*r.links, "")
        for into, row in enumerate(some):
            for ends, wrench in ((rows.i, rows.on_i), (rows.j, rows.on_j)):
                link = int(ends[row])
                at = piece.get((names[link], joints[row]), first.get(names[link], link))
                full[into, -1 if link == self.count else at] += wrench[self.k, row]
        return full[:, :-1].reshape(len(some), self.width)

    def form(self, node: int, force: Array, moment: Array) -> Array:
        """The row (n (L + N),) whose product with all twists is force . v + moment . w at a node."""
        out = np.zeros((self.width // self.n, self.n))
        about = moment + np.cross(self.arms[node], force)
        out[self.count + node] = np.concatenate([force[: self.d], about[-(self.n - self.d) :]])
        return out.ravel()

    def joining(self) -> Array:
        """Neighbours keep their distance, in space also their angle about the axis: (J, n (L + N))."""
        t, zero = self.column.axes[0], np.zeros(3)
        pairs = [(t, zero), (zero, t)][: 1 + (self.d == 3)]
        last = len(self.column.nodes) - 1
        return np.array([self.form(m + 1, *p) - self.form(m, *p) for m in range(last) for p in pairs])

    def deflections(self) -> Array:
        """Rows of y, y' of each node in turn (2 N, n (L + N)), of bending along y, in space then along z."""
        _, y, z = self.column.axes
        zero, nodes = np.zeros(3), range(len(self.column.nodes))
        planes = ((y, z), (z, -y))[: 1 + (self.d == 3)]
        rows = [self.form(m, *p) for v, turn in planes for m in nodes for p in ((v, zero), (zero, turn))]
        return np.array(rows)


WORDS = {(True, True): "fixed", (True, False): "pinned", (False, True): "guided", (False, False): "free"}
"""An end by whether its place and its angle are held."""


def end_words(free: Array) -> tuple[str, str]:
    """End conditions of the first and the last node, from the motions of one plane (2 N, k)."""
    held = np.abs(free).max(axis=1, initial=0.0) < np.sqrt(LOOSE)
    return WORDS[bool(held[0]), bool(held[1])], WORDS[bool(held[-2]), bool(held[-1])]
