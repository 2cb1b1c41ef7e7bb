"""The joints of a mechanism as a program of the poses: the residual of each constraint, and its derivatives.

The core's rows are run once on nodes with the poses as inputs, so that a user of the program can close a linkage and
follow its motion without code for mechanics. Poses are those of the links' local axes, in ground axes.

Mechanics: docs/theory.md 1, 8.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from dalembert.arrays import Array
from dalembert.core.constraints import measure, wrenches
from dalembert.core.layout import Angle, Layout, Mesh, Pose, Rows
from dalembert.core.rotation_rows import counted_turns
from dalembert.kernel.graph import Graph, Node, is_zero, trace_array

PARTS = ("point", "rotation", "turn")


@dataclass(frozen=True)
class PoseInputs:
    """Poses as inputs: origins of the links' axes (L, d), rotations (L, 2 or 9), and in the plane angles (L,), in space
    the counted turns; ``core`` is the same pose (L+1, ...) about the core's reference points."""

    point: Array
    rotation: Array
    turn: Array
    core: Pose

    @property
    def nodes(self) -> list[Node]:
        """Every input, in the order point, rotation, turn."""
        return [n for part in PARTS for n in getattr(self, part).ravel()]


def origins(layout: Layout, pose: Pose) -> Array:
    """Origins (..., L, d) of the links' axes at poses of the core."""
    points = pose.point - layout.algebra.rotate(pose.rotation, layout.reference) + layout.reference[-1]
    return np.asarray(points[..., :-1, :])


def pose_inputs(graph: Graph, layout: Layout, like: Layout, known: Pose) -> PoseInputs:
    """Inputs for the poses of a layout on nodes; ``known``: poses (P, L+1, ...) of the layout ``like`` on numbers."""
    g, links = layout.algebra, layout.links
    turn = known.turn[..., :links] if g.d == 2 else known.turn
    values = {"point": origins(like, known), "rotation": known.rotation[:, :links], "turn": turn}
    made = {}
    for part, value in values.items():
        flat = value.reshape(len(value), int(np.prod(value.shape[1:])))
        nodes = [graph.input("channel", f"pose {part} {k}", column) for k, column in enumerate(flat.T)]
        made[part] = np.array([*nodes, None], object)[:-1].reshape(value.shape[1:])
    ground = g.reference_rotation(1, 1)
    rotation = np.vstack([made["rotation"], trace_array(graph, ground[1][0])])
    reference = trace_array(graph, layout.reference)
    origin = np.vstack([made["point"], trace_array(graph, np.zeros((1, g.d)))])
    point = origin + g.rotate(rotation, reference) - reference[-1]
    counted = np.concatenate([made["turn"], trace_array(graph, [0.0])]) if g.d == 2 else made["turn"]
    return PoseInputs(**made, core=Pose(trace_array(graph, point), counted, rotation))


@dataclass(frozen=True)
class SketchRow:
    """A row: its residual is its target minus ``value``. The target is 0 for a constraint, the value at which the
    wheels met for a ``phase``, and the requested value for a freedom. ``period``: the measure is defined up to integer
    multiples of it. ``count``: in space, index of the relative turn that the row counts."""

    kind: str  # "constraint" | "phase" | "freedom"
    joint: int
    ends: tuple[int, int]
    angular: bool
    value: int
    freedom: int | None = None
    period: int | None = None
    count: int | None = None


@dataclass
class Sketch:
    """Rows, the entries (row, column, output) of the Jacobian that are not always zero, and outputs as nodes.

    Column n k + c is component c of link k's displacement: of the origin of its axes, then its turn. ``turns``: outputs
    that recount the relative turns, in space.
    """

    rows: list[SketchRow] = field(default_factory=list)
    entries: list[tuple[int, int, int]] = field(default_factory=list)
    turns: list[int] = field(default_factory=list)
    outputs: list[Node] = field(default_factory=list)

    def output(self, graph: Graph, x: object) -> int:
        """Index of a number or node among the outputs."""
        self.outputs.append(trace_array(graph, x).item())
        return len(self.outputs) - 1


def sketch(graph: Graph, layout: Layout, target: Array, pose: PoseInputs, phased: set[int]) -> Sketch:
    """The rows of a layout at a pose; ``target`` (K,) of its constraints, but for those that are ``phased``."""
    out = Sketch()
    for rows, holds in ((layout.constraints, target), (layout.freedoms, None)):
        if rows.count:
            _add_rows(graph, layout, rows, pose.core, out, holds, phased)
    if layout.algebra.d == 3 and pose.turn.size:
        out.turns = [out.output(graph, x) for x in counted_turns(layout, pose.core)]
    return out


def _add_rows(
    graph: Graph, layout: Layout, rows: Rows, pose: Pose, out: Sketch, target: Array | None, phased: set[int]
) -> None:
    values = trace_array(graph, measure(layout.algebra, rows, pose))
    periods, counts = dict(_periods(rows)), dict(_counts(rows))
    entries = _entries(graph, layout, rows, pose)
    ends = np.transpose(rows.ends).tolist()
    for k in range(rows.count):
        free = target is None or k in phased
        kind = "freedom" if target is None else "phase" if k in phased else "constraint"
        out.rows.append(
            SketchRow(
                kind=kind,
                joint=int(rows.joint[k]),
                ends=(ends[k][0], ends[k][1]),
                angular=bool(rows.angular[k]),
                value=out.output(graph, values[k] if free or target is None else values[k] - target[k]),
                freedom=k if target is None else None,
                period=out.output(graph, periods[k]) if k in periods else None,
                count=counts.get(k),
            )
        )
        row = len(out.rows) - 1
        out.entries += [(row, column, out.output(graph, x)) for column, x in entries[k]]


def _counts(rows: Rows) -> Iterator[tuple[int, int]]:
    """Rows that measure a relative turn, and the turn that each counts."""
    for f in rows.families:
        if isinstance(f, Angle):
            yield from zip(f.row.tolist(), f.count.tolist(), strict=True)


def _periods(rows: Rows) -> Iterator[tuple[int, object]]:
    """Change of the measure of a mesh over a full turn of the line of centres."""
    for f in rows.families:
        if isinstance(f, Mesh):
            periods = enumerate(2 * np.pi * (f.ri + f.rj))
            yield from ((int(f.row[k]), period) for k, period in periods if not is_zero(period))


def _entries(graph: Graph, layout: Layout, rows: Rows, pose: Pose) -> list[list[tuple[int, Node]]]:
    """For each row the columns and entries that are not always zero: wrenches about the origins of the links' axes."""
    g, entries = layout.algebra, list[list[tuple[int, Node]]]([] for _ in range(rows.count))
    arms = g.rotate(pose.rotation, trace_array(graph, layout.reference))
    for links, on in zip(rows.ends, wrenches(g, rows, pose), strict=True):
        on = trace_array(graph, on)
        on[:, g.d :] = on[:, g.d :] + g.cross(arms[links], on[:, : g.d])
        for k, link in enumerate(links.tolist()):
            if link < layout.links:
                entries[k] += [(g.n * link + c, x) for c, x in enumerate(on[k]) if not is_zero(x)]
    return entries


def elimination_order(layout: Layout) -> list[int]:
    """Links in an order that keeps the profile of J^T J small (reverse Cuthill and McKee)."""
    near: list[set[int]] = [set() for _ in range(layout.links)]
    for i, j in zip(*layout.constraints.ends, strict=True):
        if i < layout.links and j < layout.links and i != j:
            near[i].add(int(j))
            near[j].add(int(i))
    out = list[int]()
    for start in sorted(range(layout.links), key=lambda k: len(near[k])):
        queue = [start]
        while queue:
            k = queue.pop(0)
            if k not in out:
                out.append(k)
                queue += sorted(near[k] - set(out), key=lambda x: len(near[x]))
    return out[::-1]
