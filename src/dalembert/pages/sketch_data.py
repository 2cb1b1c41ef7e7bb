"""Data for closing the linkage and following its motion on the page: the sketch program, and quantities of a pose.

The page keeps the pose that the reader sees. After each change it closes the linkage near that pose, follows the motion
from there, and gives the kernel the branch of its closed forms at each position: ``branches`` are positive on the first
one, ``known`` are the kernel's inputs of the known motion, ``drawn`` is drawn where the linkage does not close.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from dalembert.analysis.batch.compiled_kernel import Kernel
from dalembert.analysis.batch.kernel_export import plain
from dalembert.analysis.batch.tracing.course import PositionPath
from dalembert.analysis.batch.tracing.traced_analysis import with_meshes
from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.analysis.positions import places_to_sample
from dalembert.arrays import Array, Tree
from dalembert.core.layout import Layout, Mesh
from dalembert.core.position.first_pose_plane import phase_rows
from dalembert.core.position.path_parameter import course
from dalembert.kernel.graph import INPUTS, Node, trace_array
from dalembert.kernel.program import Program
from dalembert.kernel.sketch_program import PARTS, PoseInputs, Sketch, elimination_order, pose_inputs, sketch
from dalembert.pages.modules import module
from dalembert.pages.rows import NodeRows
from dalembert.pages.symbolic_result import SymbolicResult


def pose_result(r: SymbolicResult, pose: PoseInputs) -> SymbolicResult:
    """The result with externally given poses instead of those of the closed forms."""
    links = slice(0, len(r.links))
    turn = pose.core.turn[links] if r._d == 2 else pose.core.turn
    return replace(
        r,
        point_array=pose.core.point[None, links],
        turn_array=turn[None],
        rotation_array=pose.core.rotation[None, links],
    )


def page_pose(k: Kernel) -> PoseInputs:
    """Inputs for the poses of a page's mechanism."""
    graph, layout, motion = k.trace.catalogue.graph, k.trace.catalogue.compiled.layout, k.trace.course
    return pose_inputs(graph, layout, motion.compiled.layout, motion.pose)


def sketch_data(
    k: Kernel, rows: NodeRows, shown: NodeRows, pose: PoseInputs, drawn: Mapping[int, Node], used: set[str]
) -> Tree:
    """Programs and data; ``shown`` contains what is drawn of ``rows``, at the poses that are inputs.

    drawn: that by its row; used: names of the channels of the page's other programs.
    """
    names, inputs = k.trace.catalogue.graph.names, k.trace.inputs
    layout, target, phased = _constraints(k)
    s = sketch(k.trace.catalogue.graph, layout, target, pose, phased)
    branches = {names[b.sign.index]: b.lead(pose.core) for b in inputs.branches}
    used = used | {
        names[n.index] for n in plain(k, [*branches.values()], marked=False).inputs_in_use("channel")
    }
    known = {name: node for name, node in _known(k, layout, pose) if name in used}
    ends = _ends(shown)
    nodes = [
        *branches.values(),
        *known.values(),
        *drawn.values(),
        *(n for pair in ends.values() for n in pair),
    ]
    first, d = len(nodes) - 2 * layout.algebra.d * len(ends), layout.algebra.d
    gaps = [(name, first + 2 * d * n) for n, name in enumerate(ends)]
    return {
        **_structure(k, layout, s),
        **_first(k, layout, pose),
        "assembly": assembly_paths(k),
        "closure": module(Program(k.trace.catalogue.graph, tuple(s.outputs)), 1),
        "shown": module(plain(k, nodes, marked=False), len(k.trace.course.schedule.position)),
        "branches": list(branches),
        "known": list(known),
        "drawn": list(drawn),
        "gaps": [
            {"joint": name, "p": [*range(n, n + d)], "q": [*range(n + d, n + 2 * d)]} for name, n in gaps
        ],
        "poses": [
            [*rows.place(link, np.zeros(d)), *np.ravel(rows.axes(link)).tolist()] for link in rows.r.links
        ],
    }


def _constraints(k: Kernel) -> tuple[Layout, Array, set[int]]:
    """Layout and targets (K,) on nodes, and the rows whose phase is an input; in space meshes are unchanged."""
    c, like = k.trace.catalogue.compiled, k.trace.course.followed.compiled
    layout, target = with_meshes(c.layout, like.layout), np.array(c.target, object)
    rows = phase_rows(layout.constraints)
    target[rows] = like.target[rows]
    return layout, target, set(rows.tolist()) if layout.algebra.d == 2 else set()


def _known(k: Kernel, layout: Layout, pose: PoseInputs) -> Iterator[tuple[str, Node]]:
    """The kernel's inputs of the known motion, from the pose."""
    for (kind, name), _ in k.trace.inputs.named.items():
        what = name.split()
        if kind != "channel" or what[0] != "known":
            continue
        if what[1] == "line":
            angle = _line_angle(k, layout, pose, int(what[-1]))
            yield name, {"cos": angle.cos, "sin": angle.sin}.get(what[2], lambda a=angle: a)()
            continue
        part, place = {"x": ("point", 0), "y": ("point", 1)}.get(what[1], (what[1], 0))
        if part == "turn" and what[2] in ("cos", "sin"):
            part, place = "rotation", ("cos", "sin").index(what[2])
        elif len(what) == 4:
            place = int(what[2])
        part_nodes = getattr(pose.core, part)[int(what[-1])]
        yield name, part_nodes if part == "turn" else part_nodes[place]


def _line_angle(k: Kernel, layout: Layout, pose: PoseInputs, row: int) -> Node:
    """Angle of the line of centres of a mesh, counted like the turns of its wheels."""
    graph, inputs = k.trace.catalogue.graph, k.trace.inputs.named
    f = next(f for f in layout.constraints.families if isinstance(f, Mesh) and row in f.row)
    n = int(np.flatnonzero(f.row == row)[0])
    ri, rj = trace_array(graph, f.ri)[n], trace_array(graph, f.rj)[n]
    turned = ri * pose.core.turn[f.i[n]] + rj * pose.core.turn[f.j[n]]
    angle: Node = (turned - inputs["channel", f"phase {row}"]) / (ri + rj)
    return angle


def posed_rows(rows: NodeRows, shown: NodeRows, pose: PoseInputs) -> dict[int, Node]:
    """Rows requested so far that depend on the pose and the numbers alone, each at the external pose."""
    graph, pose_nodes = rows.graph, {n.index for n in pose.nodes}
    fit = dict[int, bool]()
    for n in graph.order(shown.nodes):
        if n.op in INPUTS:
            fit[n.index] = n.op == "number" or n.index in pose_nodes
        else:
            fit[n.index] = all(fit[x.index] for x in (n.a, n.b) if x is not None)
    if len(rows.requested) != len(shown.requested):
        raise ValueError("the items drawn at a pose differ from those of the closed forms")
    pairs = dict(zip(reversed(rows.requested), reversed(shown.requested), strict=True))
    return {row: shown.nodes[other] for row, other in sorted(pairs.items()) if fit[shown.nodes[other].index]}


def _ends(shown: NodeRows) -> dict[str, list[Node]]:
    """The places of each joint on both of its links, of joints that hold points together."""
    m, by_joint = shown.r.mechanism, dict[str, list[Node]]()
    for name, joint in m.joints.items():
        if not joint.apart and not joint.wheels:
            ends = zip(joint.links, m.joint_points(name), strict=True)
            by_joint[name] = [shown.nodes[row] for link, u in ends for row in shown.place(link, u)]
    return by_joint


def _structure(k: Kernel, layout: Layout, s: Sketch) -> Tree:
    """Rows and entries by the indices of their outputs; the freedom of each drive."""
    freedoms = {row.freedom: n for n, row in enumerate(s.rows) if row.freedom is not None}
    return solver_data(k.trace.catalogue.compiled, layout, s) | {
        "drives": [freedoms[int(f)] for f in layout.driven]
    }


def solver_data(c: Compiled, layout: Layout, s: Sketch) -> Tree:
    """Data of the page's solver beside the program of a sketch."""
    rows = [
        {"kind": row.kind, "joint": c.joints[row.joint] if row.joint >= 0 else "", "angular": row.angular}
        | {"value": row.value, "ends": list(row.ends)}
        | {key: value for key, value in (("period", row.period), ("count", row.count)) if value is not None}
        for row in s.rows
    ]
    return {
        "dimension": layout.algebra.d,
        "length": layout.length,
        "links": list(c.links),
        "order": elimination_order(layout),
        "rows": rows,
        "entries": [x for entry in s.entries for x in entry],
        "turns": s.turns,
    }


def assembly_paths(k: Kernel) -> list[str]:
    """Paths of the numbers that give the links' pose at the first position: angles, in space poses."""
    parts = ("", ".position.0", ".position.1", ".position.2", ".axis.0", ".axis.1", ".axis.2", ".angle")
    every = parts[:1] if k.mechanism.dimension == 2 else parts[1:]
    return [f"assembly.{link}{part}" for link in k.trace.catalogue.compiled.links for part in every]


def _first(k: Kernel, layout: Layout, pose: PoseInputs) -> Tree:
    """The file's pose at its first position that closes, and the order in which an analysis searches for one."""
    motion, graph = k.trace.course, k.trace.catalogue.graph
    c = motion.followed.compiled
    at = {
        part: [float(graph.nominal[n.index][motion.first]) for n in getattr(pose, part).ravel()]
        for part in PARTS
    }
    along = course(c.layout, c.targets)
    first_pose: Tree = {
        "pose": at,
        "place": motion.first,
        "course": along.order.tolist(),
        "places": list(dict.fromkeys([0, *places_to_sample(along.order).tolist()])),
        "counted": dict(_counted(motion)),
    }
    period = c.period
    return first_pose | ({} if period is None else {"cycle": period[c.layout.constraints.count :].tolist()})


def _counted(motion: PositionPath) -> Iterator[tuple[str, float]]:
    """Whole turns, in radians, that a torsion spring counts beyond its links' angles, by the link that names them."""
    c = motion.counted
    turns = np.atleast_2d(c.forcing.resistances.turns)
    for n in c.counts:
        i, j = (int(end[c.forcing.resistances.row[n.place]]) for end in c.layout.freedoms.ends)
        more = 2 * np.pi * float(turns[min(motion.first, len(turns) - 1), n.place])
        if more:
            yield (c.links[j], more) if j < len(c.links) else (c.links[i], -more)
