"""Positions of traced mechanisms in space: link after link from the drives, Newton for closed loops.

A rod between two balls is a distance between their centres, and is placed on them. The other links form blocks,
each placed after the previous ones: links that their joints and drives hold directly, links that turn or slide and are
held at a distance in closed form, the rest by unrolled Newton steps from the known motion. Where neither a number of
the geometry nor a drive's position varies, the known motion is the solution and no steps are needed.

Mechanics: docs/theory.md 8.
"""

from __future__ import annotations

import numpy as np

from dalembert.algebra import space
from dalembert.arrays import Array
from dalembert.core.branchless import any_traced
from dalembert.core.layout import Layout, Pose
from dalembert.kernel.graph import trace_array
from dalembert.kernel.position.held_links import closed_form, direct, held_rows
from dalembert.kernel.position.placing_order import blocks, dependent_rows
from dalembert.kernel.position.rigid_parts import PlacedPose, TracePlan
from dalembert.kernel.position.rods import place_rod, without_rods
from dalembert.kernel.position.unrolled_newton import newton

STEPS = 4
"""Newton's iterations before the last, from the known motion."""


def known_pose(m: TracePlan) -> Pose:
    """Poses of all links in the known motion, with its counted angles."""
    count = m.layout.links + 1
    counted = max((int(np.max(f.count)) + 1 for f in m.layout.counted), default=0)
    point = [[m.path(f"point {c}", k) for c in range(3)] for k in range(count - 1)]
    rotation = [[m.path(f"rotation {c}", k) for c in range(9)] for k in range(count - 1)]
    return Pose(
        trace_array(m.graph, [*point, [0.0] * 3]),
        np.array([m.path("turn", k) for k in range(counted)], object),
        trace_array(m.graph, [*rotation, list(space.IDENTITY)]),
    )


def varies(layout: Layout, target: Array) -> bool:
    """True if any number that places joints is a symbol."""
    numbers = [a for f in layout.stack.families for a in vars(f).values()]
    return any_traced(*numbers) or any(x.op != "const" for x in target[: layout.constraints.count])


def space_positions(m: TracePlan, steps: int = STEPS) -> PlacedPose:
    """Poses of all links from the drives' positions."""
    known, moves = known_pose(m), m.moves or varies(m.layout, m.target)
    if m.redundant and m.moves:
        steps = 1
    out = PlacedPose(Pose(*(a.copy() for a in known)))
    m.placed = {m.layout.links}
    rods, m = without_rods(m)
    if m.redundant:
        m.dependent = dependent_rows(m.graph, m.layout, known)
    ground = {m.layout.links}
    ends = {
        row: {-1 if k in ground else int(k) for k in of}
        for row, of in enumerate(zip(*m.layout.stack.ends, strict=True))
    }
    for links in blocks(ends, 6, m.dependent):
        rows = held_rows(m, links[0]) if len(links) == 1 else []
        pose = direct(m, out.pose, links[0], rows)
        if pose is None and steps:
            pose = closed_form(m, out, links[0], rows)
        if pose is not None:
            out.pose.point[links[0]], out.pose.rotation[links[0]] = pose
        elif not moves:
            return PlacedPose(known)
        else:
            closed = newton(m, out.pose, links, steps)
            out.pose, out.doubt = closed.pose, [*out.doubt, *closed.doubt]
        m.placed |= set(links)
    for rod in rods:
        out.doubt.append(place_rod(rod, out.pose))
    return out


def space_correction(m: TracePlan) -> PlacedPose:
    """Poses of all links where the known motion is the solution: a last step of Newton carries the derivatives."""
    return space_positions(m, steps=0)
