"""Terms of the equation of motion from a traced analysis, as nodes.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from dalembert.analysis.batch.tracing.traced_analysis import Trace
from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.arrays import Array
from dalembert.core import forcing as fc
from dalembert.core.constraints import drift, measure, rates, system
from dalembert.kernel.derivatives import gradients
from dalembert.kernel.graph import Graph, Node, trace_array
from dalembert.kernel.trace import Traced

WHOLE_TURN = re.compile(r"known turn \d+")
"""Inputs that angles are counted from."""

Freedoms = tuple[tuple[str, str], ...]
"""Joints and their freedoms."""


def required_efforts(
    trace: Trace, names: Sequence[str], accelerations: Sequence[Node]
) -> tuple[list[Node], list[Node]]:
    """Efforts (D,) required, and how they change with the accelerations (D D,)."""
    graph = trace.catalogue.graph
    effort = [n for name in names for n in trace.catalogue.nodes(f"effort.{name}")]
    mass = [n for row in gradients(graph, effort, accelerations) for n in row]
    if trace.redundant:  # no number where constraints that repeat others are not met
        doubt = 1e-300 * trace.catalogue.traced.open[-1].sqrt()
        effort = [n + doubt for n in effort]
    return effort, mass


def contact_terms(trace: Trace, accelerations: Sequence[Node]) -> list[list[Node]]:
    """Rates of the contacts, and the nodes of ``Linear``."""
    c, traced, graph = trace.catalogue.compiled, trace.catalogue.traced, trace.catalogue.graph
    slip, contacts = traced.friction.slip, c.contacts
    if slip is None or contacts is None:
        return [[]]
    first = c.layout.constraints.count
    second = rates(slip.along, traced.acceleration) + drift(
        c.layout.algebra, contacts.rows, traced.pose, traced.twist
    )
    push = slip.r.change[first : first + len(accelerations)]
    ahead = gradients(graph, list(slip.r.y.ravel()), accelerations)
    arrays = (
        slip.state.rate,
        push,
        slip.r.y,
        np.array(ahead),
        slip.r.h,
        second,
    )
    return [list(trace_array(graph, a).ravel()) for a in arrays]


def freedom_motions(
    graph: Graph, c: Compiled, traced: Traced, names: Freedoms, accelerations: Sequence[Node]
) -> list[Node]:
    """For freedoms of joints: value, without full turns, rate and second rate, and the slopes by the accelerations."""
    g, freedoms, out, pose = c.layout.algebra, c.layout.freedoms, list[Node](), traced.pose
    if g.d == 2:
        cos, sin = np.moveaxis(trace_array(graph, pose.rotation), -1, 0)
        pose = pose._replace(turn=np.arctan2(sin, cos))
    for name in names:
        row, rows = c.freedoms.index(name), system(g, freedoms, pose)
        second = rates(rows, traced.acceleration) + drift(g, freedoms, pose, traced.twist)
        motion = (measure(g, freedoms, pose), rates(rows, traced.twist), second)
        out.extend(trace_array(graph, np.array([x[..., row][()] for x in motion], object)))
        out.extend(gradients(graph, out[-1:], list(accelerations))[0])
    known = {i: x for n in graph.order(out) if (x := graph.names.get(i := n.index, "")).startswith("known ")}
    if not all(WHOLE_TURN.fullmatch(x) for x in known.values()):
        return out  # Newton's steps begin at these angles
    return graph.substitute(out, dict.fromkeys(known, graph.zero))


def table_bends(graph: Graph, c: Compiled, traced: Traced) -> list[Node]:
    """Distances of springs and dampers from the bends of their tables."""
    springs = traced.forcing.springs
    if not springs.slopes.any():
        return []
    margins = fc.table_margins(c.layout, springs, traced.pose, traced.twist)
    return list(trace_array(graph, np.array(margins, object)))


def load_powers(graph: Graph, c: Compiled, traced: Traced) -> list[Node]:
    """Powers of forces and couples, and of dampers, as nodes; dry friction is not included yet."""
    layout, f, pose, twist = c.layout, c.forcing, traced.pose, traced.twist

    def power(*sources: fc.WrenchSource) -> Node:
        parts = [
            (k, w)
            for s in sources
            for k, w in zip(s.link, s.wrench.reshape(-1, twist.shape[-1]), strict=True)
        ]
        return sum(((w * twist[k]).sum() for k, w in parts), graph.zero)

    def elastic(at: Array) -> list[fc.WrenchSource]:
        springs = [fc.spring_wrench(layout, f.springs, pose, at)] if len(f.springs.a) else []
        return (
            [*springs, fc.resistance_wrench(layout, f.resistances, pose, at)]
            if len(f.resistances.row)
            else springs
        )

    dampers = power(*elastic(twist)) - power(*elastic(0.0 * twist))
    loads = graph.zero
    if len(f.forces.link) or len(f.couples.link) or f.pushes is not None:  # all power less that of the others
        inertial = fc.inertia_wrench(layout, f.inertia, pose, twist, traced.acceleration[:-1])
        turning = [traced.sources["turning"]] if "turning" in traced.sources else []
        others = power(*elastic(twist), fc.weight(layout, f.inertia, pose), inertial, *turning)
        loads = (traced.loads * twist[:-1]).sum() - others
    return list(trace_array(graph, np.array([loads, dampers], object)))
