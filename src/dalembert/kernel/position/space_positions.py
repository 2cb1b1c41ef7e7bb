"""Positions of traced mechanisms in space: link after link from the drives, Newton for what closes in loops.

Where no number of the geometry varies, the known motion is the solution. Else the links fall into blocks, each placed
once those before it are: a link that its joint and its drives hold to a placed one directly, the others by unrolled
Newton steps from the known motion.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from dalembert.algebra import space
from dalembert.arrays import Array
from dalembert.core.branchless import any_traced
from dalembert.core.geometry import arm
from dalembert.core.layout import Along, Angle, Family, Helix, Idle, Layout, Meet, Perpendicular, Pose
from dalembert.kernel.elimination import components, maximum_matching
from dalembert.kernel.graph import trace_array
from dalembert.kernel.position.rigid_parts import Motion, Placed
from dalembert.kernel.position.unrolled_newton import newton

OPPOSITE = 1e-4
"""One and the cosine between where a line was drawn and where it stands, below which the general executor decides how
the link is spun about it."""


def known_pose(m: Motion) -> Pose:
    """The known motion's poses of all links, with its followed angles."""
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
    """Whether some number that places joints is a symbol."""
    numbers = [a for f in layout.stack.families for a in vars(f).values()]
    return any_traced(*numbers) or any(x.op != "const" for x in target[: layout.constraints.count])


def space_positions(m: Motion) -> Placed:
    """Poses of all links from the drives' positions."""
    pose = known_pose(m)
    out = Placed(pose)
    if not varies(m.layout, m.target):
        return out
    m.placed = {m.layout.links}
    for links in blocks(m.layout):
        placed = direct(m, pose, links[0]) if len(links) == 1 else None
        if placed is not None:
            pose.point[links[0]], pose.rotation[links[0]] = placed
        else:
            found = newton(m, pose, links)
            pose, out.doubt = found.pose, [*out.doubt, *found.doubt]
            pose = as_drawn(m, pose, links, out)
        m.placed |= set(links)
    out.pose = pose
    return out


def space_correction(m: Motion) -> Placed:
    """Poses of all links where the known motion is the solution: a last step of Newton carries the derivatives."""
    pose = known_pose(m)
    if not varies(m.layout, m.target):
        return Placed(pose)
    m.placed = {m.layout.links}
    found = newton(m, pose, list(range(m.layout.links)), steps=0)
    out = Placed(pose, doubt=found.doubt)
    out.pose = as_drawn(m, found.pose, list(range(m.layout.links)), out)
    return out


def blocks(layout: Layout) -> list[list[int]]:
    """Links that can only be placed together, those that need nothing unplaced first."""
    i, j = layout.stack.ends
    wants = {
        row: {6 * link + c for link in ends if link != layout.links for c in range(6)}
        for row, ends in enumerate(zip(i.tolist(), j.tolist(), strict=True))
    }
    match = maximum_matching(wants)
    if len(match) < layout.unknowns:
        raise ValueError("the positions are not determined by the drives")
    needs: dict[int, set[int]] = {link: set() for link in range(layout.links)}
    for row, column in match.items():
        needs[column // 6] |= {c // 6 for c in wants[row]} - {column // 6}
    return [sorted(block) for block in components(needs)]


def direct(m: Motion, pose: Pose, link: int) -> tuple[Array, Array] | None:
    """Point and rotation of a link that one joint with all its freedoms driven holds to a placed link."""
    rows = [
        (f, k)
        for f in m.layout.stack.families
        for k, ends in enumerate(zip(f.i.tolist(), f.j.tolist(), strict=True))
        if link in ends and set(ends) <= m.placed | {link}
    ]
    turned, shifted = _turned(m, rows), _shifted(m, rows)
    if turned is None or shifted is None or len({(int(f.i[k]), int(f.j[k])) for f, k in rows}) > 1:
        return None
    f, k = rows[0]
    i, j, (ui, uj) = int(f.i[k]), int(f.j[k]), shifted
    if link == j:
        rotation = space.compose(pose.rotation[i], turned)
        return pose.point[i] + space.rotate(pose.rotation[i], ui) - space.rotate(rotation, uj), rotation
    rotation = space.compose(pose.rotation[j], space.matrix(turned).T.ravel())
    return pose.point[j] + space.rotate(pose.rotation[j], uj) - space.rotate(rotation, ui), rotation


def _of(rows: list[tuple[Family, int]], kind: type) -> list[tuple[Any, int]]:
    return [(f, k) for f, k in rows if isinstance(f, kind)]


def _turned(m: Motion, rows: list[tuple[Family, int]]) -> Array | None:
    """Rotation of j in i where these rows of one joint fix it: three right angles, or two and a driven turn."""
    square, turn = _of(rows, Perpendicular), _of(rows, Angle)
    if len(square) == 3 and not turn:  # as ``pair_table`` writes those about x, y and z
        (x, xk), (y, yk), (z, zk) = square
        on_i, on_j = np.array([y.a[yk], z.a[zk], x.a[xk]]), np.array([z.p[zk], x.p[xk], y.p[yk]])
    elif len(square) == 2 and len(turn) == 1:
        (f, k), (g, n) = turn[0], square[0]
        cos, sin = m.turns[int(f.row[k])]
        a, b = f.a[k], f.b[k]
        c = space.cross(a, b)
        on_i = np.array([a, cos * b + sin * c, cos * c - sin * b])
        on_j = np.array([g.p[n], f.p[k], space.cross(g.p[n], f.p[k])])
    else:
        return None
    return np.asarray((on_i.T @ on_j).ravel())


def _shifted(m: Motion, rows: list[tuple[Family, int]]) -> tuple[Array, Array] | None:
    """Arms on i and on j of one point, where these rows of one joint fix it."""
    meet, along, turn = _of(rows, Meet), [*_of(rows, Along), *_of(rows, Helix)], _of(rows, Angle)
    if meet:
        f, k = meet[0]
        return (f.ui[k], f.uj[k]) if len(meet) == 1 and not along else None
    if len(along) != 3:
        return None
    at = along[0][0].ui[along[0][1]]
    for f, k in along:
        if isinstance(f, Along):
            at = at + m.target[f.row[k]] * f.axis[k]
        elif turn:
            (g, n) = turn[0]
            at = at + (m.target[f.row[k]] - f.pitch[k] * m.target[g.row[n]]) * f.a[k]
        else:
            return None
    return at, along[0][0].uj[along[0][1]]


def as_drawn(m: Motion, pose: Pose, links: list[int], out: Placed) -> Pose:
    """The pose with links that could spin about a line turned from how they are drawn by the least angle."""
    g, rotation = m.layout.algebra, pose.rotation.copy()
    for f in m.layout.constraints.families:
        if not isinstance(f, Idle):
            continue
        for k in np.flatnonzero(np.isin(f.j, links) & (f.stands > 0)):
            was, now = g.rotate(f.drawn[k], f.p[k]), arm(g, pose, f.j[k], f.p[k])
            cosine = 1.0 + g.dot(was, now).item()
            out.doubt.append(cosine - OPPOSITE)
            half = space.cayley((2.0 / cosine) * g.cross(was, now))
            rotation[f.j[k]] = space.compose(half, f.drawn[k])
    return pose._replace(rotation=rotation)
