"""Links in space placed one at a time in closed form, from links already placed.

Two cases: a link on one joint with all its freedoms driven; and a link that turns about an axis, or slides along a
line, with a point at a known distance from another: of its two branches, the one of the known motion.

e   axis of the turn or slide, unit vector;  L  the distance;  A, B  its ends on the placed link and on this one
"""

from __future__ import annotations

from typing import Any

import numpy as np

from dalembert.algebra import space
from dalembert.arrays import Array
from dalembert.core.layout import Along, Angle, Distance, Family, Helix, Meet, Perpendicular, Pose
from dalembert.kernel.graph import CONSTANT, Node, Scalar
from dalembert.kernel.position.rigid_parts import DEAD, PlacedPose, TracePlan

Held = list[tuple[Any, int]]
"""Rows between a link and placed ones: family and index in it."""
Place = tuple[Array, Array]
"""Point and rotation of a link."""


def held_rows(m: TracePlan, link: int) -> Held:
    """The rows between a link and those already placed."""
    return [
        (f, k)
        for f in m.layout.stack.families
        for k, ends in enumerate(zip(f.i.tolist(), f.j.tolist(), strict=True))
        if link in ends
        and set(ends) <= m.placed | {link}
        and not m.dependent & set(np.ravel(f.row[k]).tolist())
    ]


def _of(rows: Held, *kinds: type[Family]) -> Held:
    return [(f, k) for f, k in rows if isinstance(f, kinds)]


def _one_joint(rows: Held) -> bool:
    return len({(int(f.i[k]), int(f.j[k])) for f, k in rows}) == 1


def _arms(row: tuple[Any, int], link: int) -> tuple[Array, int, Array]:
    """Arm of a row on a link, the other link, and the arm on the other."""
    f, k = row
    i, j = int(f.i[k]), int(f.j[k])
    return (f.uj[k], i, f.ui[k]) if j == link else (f.ui[k], j, f.uj[k])


def _point(pose: Pose, link: int, u: Array) -> Array:
    return np.asarray(pose.point[link] + space.rotate(pose.rotation[link], u))


def direct(m: TracePlan, pose: Pose, link: int, rows: Held) -> Place | None:
    """A link that one joint with all its freedoms driven holds to a placed link."""
    if not _one_joint(rows):
        return None
    rotation, shifted = _rotation(m, pose, link, rows), _shifted(m, rows)
    if rotation is None or shifted is None:
        return None
    f, k = rows[0]
    (near, ui), (other, uj) = (int(f.j[k]), shifted[1]), (int(f.i[k]), shifted[0])
    if near != link:
        near, ui, other, uj = other, uj, near, ui
    return _point(pose, other, uj) - space.rotate(rotation, ui), rotation


def _rotation(m: TracePlan, pose: Pose, link: int, rows: Held) -> Array | None:
    """Rotation of a link that these rows of one joint fix: three perpendicularities, or two and a driven turn."""
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
    f, k = square[0]
    i, j, turned = int(f.i[k]), int(f.j[k]), on_i.T @ on_j
    if link == j:
        return space.compose(pose.rotation[i], turned.ravel())
    return space.compose(pose.rotation[j], turned.T.ravel())


def _shifted(m: TracePlan, rows: Held) -> tuple[Array, Array] | None:
    """Arms on i and on j of one point, where these rows of one joint fix it."""
    meet, along, turn = _of(rows, Meet), _of(rows, Along, Helix), _of(rows, Angle)
    if len(meet) == 1 and not along:
        f, k = meet[0]
        return f.ui[k], f.uj[k]
    if len(along) != 3 or (_of(along, Helix) and not turn):
        return None
    f, k = along[0]
    at, uj = f.ui[k], f.uj[k]
    for f, k in along:
        advance = m.target[f.row[k]]
        if isinstance(f, Helix):
            advance = advance - f.pitch[k] * m.target[turn[0][0].row[turn[0][1]]]
        at = at + advance * (f.a if isinstance(f, Helix) else f.axis)[k]
    return at, uj


def closed_form(m: TracePlan, out: PlacedPose, link: int, rows: Held) -> Place | None:
    """A link that one joint allows to turn or slide, with a point of it at a distance from a placed one."""
    distance, joint = _of(rows, Distance), [row for row in rows if not isinstance(row[0], Distance)]
    if len(distance) != 1 or not _one_joint(joint) or _of(joint, Angle, Helix):
        return None
    kinds = [len(_of(joint, kind)) for kind in (Perpendicular, Meet, Along)]
    f, k = distance[0]
    length = m.target[f.row[k]]
    ends = _arms(distance[0], link)
    if kinds in ([2, 1, 0], [2, 0, 3]):
        return _on_circle(m, out, link, joint, ends, length * length)
    return _on_line(m, out, link, joint, ends, length * length) if kinds == [3, 0, 2] else None


def _on_circle(
    m: TracePlan, out: PlacedPose, link: int, joint: Held, ends: tuple[Array, int, Array], square: Scalar
) -> Place:
    """B on a circle about e, at a distance from A: B - C = (K d + h e x d) / d.d with d from e to A."""
    ball, other, u = _arms(_of(joint, Meet, Along)[0], link)
    (f, k), (g, n) = _of(joint, Perpendicular)
    shared, normal = f.p[k], space.cross(f.a[k], g.a[n])  # the axis on j, and on i
    mine, its = (shared, normal) if int(f.j[k]) == link else (normal, shared)
    e, at = space.rotate(out.pose.rotation[other], its), _point(out.pose, other, u)
    arm = ends[0] - ball
    height = space.dot(arm, mine)
    radius = arm - height * mine
    d = _point(out.pose, *ends[1:]) - at - height * e
    r2, d2 = space.dot(radius, radius).item(), space.dot(d, d).item()
    d = d - space.dot(d, e) * e
    across2, foot = space.dot(d, d).item(), 0.5 * (r2 + d2 - square)
    h = out.root(m.graph, r2 * across2 - foot * foot, r2 * across2)
    out.doubt.append(h * h - DEAD * r2 * square)
    side = space.cross(e, d)

    def rotation(sign: Scalar) -> Array:
        r = (1.0 / across2) * (foot * d + (sign * h) * side)
        turned = np.outer(r, radius) + np.outer(space.cross(e, r), space.cross(mine, radius))
        return np.asarray((np.outer(e, mine) + (1.0 / r2) * turned).ravel())

    turned = rotation(_side(m, out, rotation(1.0), rotation(-1.0), link))
    return at - space.rotate(turned, ball), turned


def _on_line(
    m: TracePlan, out: PlacedPose, link: int, joint: Held, ends: tuple[Array, int, Array], square: Scalar
) -> Place | None:
    """B on a line along e, at a distance from A: s = -e.f +- h with f from A to B at s = 0."""
    pose, rotation = out.pose, _rotation(m, out.pose, link, joint)
    assert rotation is not None
    (f, k), (g, n) = slides = _of(joint, Along)
    ball, other, u = _arms(slides[0], link)
    r = pose.rotation[other] if int(f.j[k]) == link else rotation
    e = space.rotate(r, space.cross(f.axis[k], g.axis[n]))
    base = _point(pose, other, u) - space.rotate(rotation, ball)
    span = base + space.rotate(rotation, ends[0]) - _point(pose, *ends[1:])
    along = space.dot(span, e).item()
    h = out.root(m.graph, square - space.dot(span, span).item() + along * along, square)

    def point(sign: Scalar) -> Array:
        return np.asarray(base + (sign * h - along) * e)

    return point(_side(m, out, point(1.0), point(-1.0), link)), rotation


def _side(m: TracePlan, out: PlacedPose, plus: Array, minus: Array, link: int) -> Scalar:
    """1 or -1: which of two places of a link the known motion has."""
    sign = m.signs(tuple(plus), tuple(minus), m.layout.links, link)
    out.flips = out.flips or (isinstance(sign, Node) and sign.level != CONSTANT)
    return sign
