"""Newton for links without a closed form, unrolled: the core's own closure equations, from the known motion."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.core.constraints import stack_rows
from dalembert.core.layout import Layout, Pose, System
from dalembert.core.position.newton import displace, gap
from dalembert.kernel.elimination import Row, Structural, structural
from dalembert.kernel.graph import Graph, Node, Scalar, is_zero

if TYPE_CHECKING:
    from dalembert.kernel.position.rigid_parts import Motion


STEPS = 6
"""Iterations before the last; from a guess within a few tenths of a radian four are enough."""

LAST = 1e-7
"""Largest turn, or shift over characteristic length, of the last step: what it leaves is its square."""

FAR = 1.0
"""A solution further than this from the known motion may be another way of closing: the general executor decides."""


@dataclass
class Found:
    """Poses of all links, those asked for placed, and what must not be negative."""

    pose: Pose
    doubt: list[Node]


def newton(m: Motion, guess: Pose, links: list[int], steps: int = STEPS) -> Found:
    """Place some links in so many steps and one; all others stand where the guess has them."""
    pose = guess
    for _ in range(steps):
        pose = _displace(m, pose, _step(m, pose, links), links)
    still = _detach(m.graph, pose, links)
    dq = _step(m, still, links)
    pose = _displace(m, still, dq, links)
    last = _size(m.layout, [dq[k] for k in links])
    far = _size(m.layout, [_difference(pose, guess, k) for k in links])
    return Found(pose, [LAST**2 - last, FAR**2 - far])


def _step(m: Motion, pose: Pose, links: list[int]) -> dict[int, list[Scalar]]:
    """Newton step of some links."""
    layout = m.layout
    rows = stack_rows(layout, pose)
    missing = gap(layout, pose, m.target) / layout.row_scale
    moving = set(links)
    kept = [
        k
        for k in range(len(rows.i))
        if moving & {int(rows.i[k]), int(rows.j[k])} and _inside(m, rows, k, moving)
    ]
    factors = factor_rows(m.graph, rows, kept, links)
    solution = factors.motion(np.array([missing[k] for k in kept], object))
    return {link: list(solution[3 * n : 3 * n + 3]) for n, link in enumerate(links)}


def _inside(m: Motion, rows: System, k: int, moving: set[int]) -> bool:
    """Both ends are moving or placed already."""
    return all(int(e) in moving or int(e) in m.placed for e in (rows.i[k], rows.j[k]))


def factor_rows(graph: Graph, rows: System, kept: list[int], links: list[int]) -> Structural:
    """Factors of some rows for the displacements of some links."""
    place = {link: 3 * n for n, link in enumerate(links)}
    out: list[Row] = []
    for k in kept:
        row: Row = {}
        for link, wrench in ((int(rows.i[k]), rows.on_i[k]), (int(rows.j[k]), rows.on_j[k])):
            if link in place:
                row |= {place[link] + c: x for c, x in enumerate(wrench) if not is_zero(x)}
        out.append(row)
    return structural(graph, out, 3 * len(links))


def solver(graph: Graph) -> Callable[[Layout, System], Structural]:
    """What the core factors its systems with while it is traced."""

    def factor(layout: Layout, rows: System) -> Structural:
        return factor_rows(graph, rows, list(range(len(rows.i))), list(range(layout.links)))

    return factor


def _displace(m: Motion, pose: Pose, dq: dict[int, list[Scalar]], links: list[int]) -> Pose:
    step = np.full((m.layout.links, 3), 0.0, object)
    for link in links:
        step[link] = dq[link]
    after = displace(m.layout, pose, step)
    others = [k for k in range(len(pose.turn)) if k not in links]
    after.rotation[others] = pose.rotation[others]
    return after


def _detach(graph: Graph, pose: Pose, links: list[int]) -> Pose:
    """The links' poses as constants to derivatives: the last step carries the derivative exactly."""
    point, turn = pose.point.copy(), pose.turn.copy()
    rotation = pose.rotation.copy()
    for k in links:
        point[k] = [graph.without_gradient(x) for x in point[k]]
        turn[k] = graph.without_gradient(turn[k])
        rotation[k] = [turn[k].cos(), turn[k].sin()]
    return Pose(point, turn, rotation)


def _difference(a: Pose, b: Pose, k: int) -> list[Scalar]:
    return [*(a.point[k] - b.point[k]), a.turn[k] - b.turn[k]]


def _size(layout: Layout, dq: list[list[Scalar]]) -> Any:
    """Sum of squares of turns, and shifts over the characteristic length."""
    scale = (1 / layout.length**2, 1 / layout.length**2, 1.0)
    return sum((s * x * x for step in dq for s, x in zip(scale, step, strict=True)), 0.0)
