"""Newton for links without a closed form, unrolled: the core's closure equations, from the known motion.

Mechanics: docs/theory.md 8.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.algebra import space
from dalembert.arrays import Ints
from dalembert.core.constraints import stack_rows
from dalembert.core.factor import row_scale
from dalembert.core.layout import ConstraintRows, Layout, Pose, Rows, select_rows
from dalembert.core.position.newton import displace, gap
from dalembert.kernel.elimination import Row, Structural, structural
from dalembert.kernel.graph import Graph, Node, Scalar, is_zero

if TYPE_CHECKING:
    from dalembert.kernel.position.rigid_parts import TracePlan


STEPS = 6
"""Iterations before the last; from a guess within a few tenths of a radian four are enough."""

LAST = 1e-7
"""Largest turn, or shift over characteristic length, of the last step: the remaining error is its square."""

FAR = 1.0
"""Distance from the known motion beyond which a solution may be another branch: the general executor decides."""


@dataclass
class NewtonPoses:
    """Poses of all links, the requested ones placed, and nodes that must not be negative."""

    pose: Pose
    doubt: list[Node]


def newton(m: TracePlan, guess: Pose, links: list[int], steps: int = STEPS) -> NewtonPoses:
    """Places some links in ``steps`` + 1 steps; all others stay as in the guess."""
    m, pose = _block(m, links), guess
    for _ in range(steps):
        pose = _displace(m, pose, _step(m, pose, links), links)
    still = _detach(m, pose, links)
    dq = _step(m, still, links)
    pose = _displace(m, still, dq, links)
    last = _size(m.layout, [dq[k] for k in links])
    far = _size(m.layout, [_difference(m.layout, pose, guess, k) for k in links])
    return NewtonPoses(pose, [LAST**2 - last, FAR**2 - far])


def _block(m: TracePlan, links: list[int]) -> TracePlan:
    """The conditions among some links and those already placed."""
    stack, moving = m.layout.stack, set(links)
    i, j = stack.ends
    kept = [
        k
        for k in range(stack.count)
        if (ends := {int(i[k]), int(j[k])}) & moving and ends <= moving | m.placed
    ]
    return replace(m, layout=_with_stack(m.layout, np.array(kept, np.intp)), target=m.target[kept])


def _with_stack(layout: Layout, kept: Ints) -> Layout:
    """The layout with some of its stacked rows as constraints, and no drives."""
    s = layout.stack
    rows = Rows(len(kept), s.links, tuple(select_rows(s, kept)), s.joint[kept], s.angular[kept])
    return replace(layout, constraints=rows, driven=np.zeros(0, np.intp))


def _step(m: TracePlan, pose: Pose, links: list[int]) -> dict[int, list[Scalar]]:
    """Newton step of some links."""
    rows, n = stack_rows(m.layout, pose), m.layout.algebra.n
    factors = factor_rows(m.graph, m.layout, rows, links)
    solution = factors.motion(gap(m.layout, pose, m.target) / m.layout.row_scale)
    return {link: list(solution[n * k : n * (k + 1)]) for k, link in enumerate(links)}


def factor_rows(graph: Graph, layout: Layout, rows: ConstraintRows, links: list[int]) -> Structural:
    """Factors of rows for the displacements of some links."""
    n = layout.algebra.n
    place = {link: n * k for k, link in enumerate(links)}
    out: list[Row] = []
    for k in range(len(rows.i)):
        row: Row = {}
        for link, wrench in ((int(rows.i[k]), rows.on_i[k]), (int(rows.j[k]), rows.on_j[k])):
            if link in place:
                row |= {place[link] + c: x for c, x in enumerate(wrench) if not is_zero(x)}
        out.append(row)
    return structural(graph, out, n * len(links), row_scale(layout, rows.angular))


def solver(graph: Graph) -> Callable[[Layout, ConstraintRows], Structural]:
    """Factorization that the core uses while it is traced."""

    def factor(layout: Layout, rows: ConstraintRows) -> Structural:
        return factor_rows(graph, layout, rows, list(range(layout.links)))

    return factor


def _displace(m: TracePlan, pose: Pose, dq: dict[int, list[Scalar]], links: list[int]) -> Pose:
    if m.layout.algebra.d == 3:
        point, rotation = pose.point.copy(), pose.rotation.copy()
        for k in links:
            point[k] = point[k] + dq[k][:3]
            rotation[k] = space.compose(space.cayley(np.array(dq[k][3:], object)), rotation[k])
        return Pose(point, pose.turn, rotation)
    step = np.full((m.layout.links, 3), 0.0, object)
    for link in links:
        step[link] = dq[link]
    after = displace(m.layout, pose, step)
    others = [k for k in range(len(pose.turn)) if k not in links]
    after.rotation[others] = pose.rotation[others]
    return after


def _detach(m: TracePlan, pose: Pose, links: list[int]) -> Pose:
    """The links' poses as constants to derivatives: the last step carries the derivative exactly."""
    still = m.graph.without_gradient
    point, turn, rotation = (a.copy() for a in pose)
    for k in links:
        point[k] = [still(x) for x in point[k]]
        if m.layout.algebra.d == 3:
            rotation[k] = [still(x) for x in rotation[k]]
            continue
        turn[k] = still(turn[k])
        rotation[k] = [turn[k].cos(), turn[k].sin()]
    return Pose(point, turn, rotation)


def _difference(layout: Layout, a: Pose, b: Pose, k: int) -> list[Scalar]:
    """Shifts and turns between two poses of a link; in space the turns as a chord, 2 sin of half the angle."""
    shift = a.point[k] - b.point[k]
    if layout.algebra.d == 2:
        return [*shift, a.turn[k] - b.turn[k]]
    return [*shift, *(np.sqrt(0.5) * (a.rotation[k] - b.rotation[k]))]


def _size(layout: Layout, dq: list[list[Scalar]]) -> Any:
    """Sum of squares of turns, and shifts over the characteristic length."""
    over, d = 1 / layout.length**2, layout.algebra.d
    return sum(((over if c < d else 1.0) * x * x for step in dq for c, x in enumerate(step)), 0.0)
