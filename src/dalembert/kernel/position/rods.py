"""Rods between two balls: a distance between the balls' centres, along which the rod is placed as drawn.

was, now   unit vectors along the rod as drawn and as placed
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from dalembert.algebra import space
from dalembert.arrays import Array, Ints
from dalembert.core.layout import Along, Distance, Family, Idle, Layout, Meet, Pose, Rows, select_rows
from dalembert.kernel.graph import Node, Scalar, trace_array
from dalembert.kernel.position.rigid_parts import TracePlan

OPPOSITE = 1e-4
"""One plus the cosine between the drawn and the present direction below which the general executor decides the spin of
the rod."""


@dataclass(frozen=True)
class Rod:
    """A link with its rotation as drawn (9,) and each of its balls: arm on it, the other link, arm on that."""

    link: int
    drawn: Array
    balls: list[tuple[Array, int, Array]]
    length: Scalar


def without_rods(m: TracePlan) -> tuple[list[Rod], TracePlan]:
    """The rods, and the motion of the other links with a distance for each of them."""
    layout = m.layout
    rods = [rod for f in layout.constraints.families if isinstance(f, Idle) for rod in _rods(layout, f)]
    spun = {rod.link for rod in rods}
    rods = [rod for rod in rods if not spun & {other for _, other, _ in rod.balls}]
    if not rods:
        return rods, m
    s = layout.stack
    gone = [rod.link for rod in rods]
    kept = np.flatnonzero(~np.isin(s.ends, gone).any(axis=0))
    families = [*select_rows(s, kept), _distances(rods, len(kept))]
    rows = Rows(
        len(kept) + len(rods),
        s.links,
        tuple(families),
        np.concatenate([s.joint[kept], np.full(len(rods), -1)]),
        np.concatenate([s.angular[kept], np.zeros(len(rods), bool)]),
    )
    target = np.concatenate([m.target[kept], trace_array(m.graph, [rod.length for rod in rods])])
    turns = {new: m.turns[old] for new, old in enumerate(kept.tolist()) if old in m.turns}
    rest = replace(layout, constraints=rows, driven=np.zeros(0, np.intp))
    return rods, replace(m, layout=rest, target=target, turns=turns)


def _distances(rods: list[Rod], first: int) -> Distance:
    (_, i, ui), (_, j, uj) = (tuple(zip(*(rod.balls[side] for rod in rods), strict=True)) for side in (0, 1))
    row = np.arange(first, first + len(rods))
    return Distance(row, np.array(i), np.array(j), np.array(ui), np.array(uj))


def _rods(layout: Layout, f: Idle) -> list[Rod]:
    """Links whose joints are two balls and nothing else."""
    out = []
    s = layout.stack
    for k, link in enumerate(f.j.tolist()):
        touching = np.isin(s.ends, [link]).any(axis=0) & (s.joint >= 0)
        held = [
            _ball(s, np.flatnonzero(touching & (s.joint == joint)), link)
            for joint in np.unique(s.joint[touching])
        ]
        balls = [ball for ball in held if ball is not None]
        if f.stands[k] > 0 and len(held) == len(balls) == 2:
            line = balls[1][0] - balls[0][0]
            out.append(Rod(link, f.drawn[k], balls, np.sqrt(space.dot(line, line).item())))
    return out


def _ball(s: Rows, rows: Ints, link: int) -> tuple[Array, int, Array] | None:
    """Rows of one joint that hold a point of a link to a point of another, and nothing else; None otherwise."""
    families: list[Family] = select_rows(s, rows)
    f: Any = families[0]
    if len(rows) != 3 or len(families) > 1 or not isinstance(f, Meet | Along):
        return None
    i, j = int(f.i[0]), int(f.j[0])
    return (f.ui[0], j, f.uj[0]) if i == link else (f.uj[0], i, f.ui[0])


def place_rod(rod: Rod, pose: Pose) -> Node:
    """Places a rod on its balls; negative where it is turned by nearly half a turn from its drawn direction."""
    (ua, x, ux), (ub, y, uy) = rod.balls
    a, b = (pose.point[k] + space.rotate(pose.rotation[k], u) for k, u in ((x, ux), (y, uy)))
    was, now = space.rotate(rod.drawn, (ub - ua) / rod.length), (b - a) / rod.length
    cosine = 1.0 + space.dot(was, now).item()
    rotation = space.compose(space.cayley((2.0 / cosine) * space.cross(was, now)), rod.drawn)
    pose.rotation[rod.link] = rotation
    pose.point[rod.link] = a - space.rotate(rotation, ua)
    doubt: Node = cosine - OPPOSITE
    return doubt
