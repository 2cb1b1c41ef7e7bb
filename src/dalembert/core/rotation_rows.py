"""Rows in space that turn: perpendicular directions, relative angles, screws, and the spin of a link.

w   angular velocity of j against i
u, v  p . (a x b) and p . b: sine and cosine of a relative angle, times the length r of p across the axis

Mechanics: docs/theory.md 2.2.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from dalembert.algebra import space
from dalembert.algebra.protocol import Algebra
from dalembert.arrays import Array, Ints
from dalembert.core import gear_rows
from dalembert.core.geometry import arm, point_motion, span
from dalembert.core.layout import Angle, Gearing, Helix, Idle, Layout, Perpendicular, Pose


def perpendicular(g: Algebra, f: Perpendicular, pose: Pose) -> Array:
    """a . p."""
    return np.asarray(g.dot(arm(g, pose, f.i, f.a), arm(g, pose, f.j, f.p)))


def perpendicular_wrench(g: Algebra, f: Perpendicular, pose: Pose, on_i: Array, on_j: Array) -> None:
    """Couple p x a."""
    _couple(g, f.row, g.cross(arm(g, pose, f.j, f.p), arm(g, pose, f.i, f.a)), on_i, on_j)


def perpendicular_drift(g: Algebra, f: Perpendicular, pose: Pose, twist: Array) -> Array:
    """Second derivative of a . p at zero accelerations."""
    a, p = arm(g, pose, f.i, f.a), arm(g, pose, f.j, f.p)
    return _second(g, *_turning(g, twist[..., f.i, g.d :], a), *_turning(g, twist[..., f.j, g.d :], p))


def _couple(g: Algebra, row: Ints, couple: Array, on_i: Array, on_j: Array) -> None:
    on_j[..., row, g.d :] = couple
    on_i[..., row, g.d :] = -couple


def _turning(g: Algebra, w: Array, a: Array) -> tuple[Array, Array, Array]:
    """A direction, its rate, and its second rate at zero angular acceleration."""
    return a, g.spin(w, a), g.centripetal(w, a)


def _second(g: Algebra, a: Array, a1: Array, a2: Array, p: Array, p1: Array, p2: Array) -> Array:
    return np.asarray(g.dot(a2, p) + 2 * g.dot(a1, p1) + g.dot(a, p2))


class _Axes(NamedTuple):
    """Axis a, b and c = a x b of i, and the direction p of j, in ground axes."""

    a: Array
    b: Array
    c: Array
    p: Array


def _axes(g: Algebra, f: Angle | Helix, pose: Pose) -> _Axes:
    a, b = arm(g, pose, f.i, f.a), arm(g, pose, f.i, f.b)
    return _Axes(a, b, g.cross(a, b), arm(g, pose, f.j, f.p))


def angle(g: Algebra, f: Angle | Helix, pose: Pose) -> Array:
    """The relative angle, with whole turns as counted."""
    x = _axes(g, f, pose)
    raw = np.arctan2(g.dot(x.p, x.c), g.dot(x.p, x.b))
    return np.asarray(raw + 2 * np.pi * np.round((pose.turn[..., f.count] - raw) / (2 * np.pi)))


def _angle_couple(g: Algebra, f: Angle | Helix, pose: Pose) -> Array:
    """p x (v c - u b) / r^2: the axis itself where p is perpendicular to it."""
    x = _axes(g, f, pose)
    u, v = g.dot(x.p, x.c), g.dot(x.p, x.b)
    across = v[..., None] * x.c - u[..., None] * x.b
    couple: Array = g.cross(x.p, across) / (u * u + v * v)[..., None]
    return couple


def angle_wrench(g: Algebra, f: Angle, pose: Pose, on_i: Array, on_j: Array) -> None:
    """Couple along the axis."""
    _couple(g, f.row, _angle_couple(g, f, pose), on_i, on_j)


def angle_drift(g: Algebra, f: Angle | Helix, pose: Pose, twist: Array) -> Array:
    """Second derivative of the angle at zero accelerations."""
    x = _axes(g, f, pose)
    wi = twist[..., f.i, g.d :]
    p, c, b = _turning(g, twist[..., f.j, g.d :], x.p), _turning(g, wi, x.c), _turning(g, wi, x.b)
    u, v = g.dot(x.p, x.c), g.dot(x.p, x.b)
    u1, v1 = (g.dot(e[1], x.p) + g.dot(e[0], p[1]) for e in (c, b))
    u2, v2 = _second(g, *c, *p), _second(g, *b, *p)
    square = u * u + v * v
    rate = (v * u1 - u * v1) / square
    return np.asarray((v * u2 - u * v2 - 2 * rate * (u * u1 + v * v1)) / square)


def helix(g: Algebra, f: Helix, pose: Pose) -> Array:
    """Coordinate along the axis plus pitch times the angle."""
    return np.asarray(along_axis(g, f, pose) + f.pitch * angle(g, f, pose))


def along_axis(g: Algebra, f: Helix, pose: Pose) -> Array:
    """Coordinate of j's point along the axis of i."""
    return np.asarray(g.dot(arm(g, pose, f.i, f.a), span(g, f, pose)))


def helix_wrench(g: Algebra, f: Helix, pose: Pose, on_i: Array, on_j: Array) -> None:
    """Force along the axis at j's point and pitch times the angle's couple."""
    e, rj = arm(g, pose, f.i, f.a), arm(g, pose, f.j, f.uj)
    ri = pose.point[..., f.j, :] + rj - pose.point[..., f.i, :]
    couple = f.pitch[..., None] * _angle_couple(g, f, pose)
    on_j[..., f.row, : g.d], on_j[..., f.row, g.d :] = e, g.cross(rj, e) + couple
    on_i[..., f.row, : g.d], on_i[..., f.row, g.d :] = -e, -(g.cross(ri, e) + couple)


def helix_drift(g: Algebra, f: Helix, pose: Pose, twist: Array) -> Array:
    """Second derivative of the measure at zero accelerations."""
    rj = arm(g, pose, f.j, f.uj)
    vj, aj = point_motion(g, pose, twist, f.j, rj)
    vi, ai = point_motion(g, pose, twist, f.i, pose.point[..., f.j, :] + rj - pose.point[..., f.i, :])
    coriolis = 2 * g.spin(twist[..., f.i, g.d :], vj - vi)
    along = g.dot(arm(g, pose, f.i, f.a), aj - ai - coriolis)
    return np.asarray(along + f.pitch * angle_drift(g, f, pose, twist))


def idle(g: Algebra, f: Idle, pose: Pose) -> Array:
    """0: the spin is a rate, not a place."""
    return np.zeros((*pose.point.shape[:-2], len(f.j)))


def idle_wrench(g: Algebra, f: Idle, pose: Pose, on_i: Array, on_j: Array) -> None:
    """Couple along the direction."""
    _couple(g, f.row, arm(g, pose, f.j, f.p), on_i, on_j)


def idle_drift(g: Algebra, f: Idle, pose: Pose, twist: Array) -> Array:
    """0: a direction of the link turns with it, so that w . (w x p) = 0."""
    return np.zeros((*pose.point.shape[:-2], len(f.j)))


def recount_turns(layout: Layout, pose: Pose) -> Pose:
    """The pose with its relative angles recounted from near ones, and links that could spin as they are drawn."""
    g = layout.algebra
    for f in layout.constraints.families:
        if isinstance(f, Idle):
            rotation, link = pose.rotation.copy(), f.j[f.stands > 0]
            p, drawn = f.p[f.stands > 0], f.drawn[f.stands > 0]
            was, now = g.rotate(drawn, p), arm(g, pose, link, p)
            rotation[..., link, :] = space.compose(space.least_turn(was, now), drawn)
            pose = pose._replace(rotation=rotation)
    return pose._replace(turn=counted_turns(layout, pose)) if layout.counted else pose


def counted_turns(layout: Layout, pose: Pose) -> Array:
    """The relative angles (..., T) of a pose, recounted from near ones."""
    g, turn = layout.algebra, pose.turn.copy()
    for f in layout.counted:
        turn[..., f.count] = gear_rows.angles(g, f, pose) if isinstance(f, Gearing) else angle(g, f, pose)
    return turn
