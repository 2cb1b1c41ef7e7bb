"""Rows of a drum's lining and of a band around a drum: measures, wrenches, drifts.

u   unit vector from the drum's axis O to j's point; n across it
f   unit force on j at the angle to u
t   unit vector of a strand from its end E to the drum

Their measures keep the value of the first pose: a brake is adjusted to be closed in it. Mechanics: docs/theory.md 6.4.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from dalembert.algebra.protocol import Algebra
from dalembert.arrays import Array, Ints
from dalembert.core.branchless import above, larger, root, where
from dalembert.core.elements.linings import BandStrands, Lining
from dalembert.core.geometry import arm, point_motion, span, span_motion
from dalembert.core.layout import Pose

FLAT, ENDLESS = 1e-9, 1e9
"""Sine of a line's angle that is rounding; the slope in its place."""


def _directions(g: Algebra, f: Lining, pose: Pose) -> tuple[Array, Array, Array]:
    """Span of the points, its length, and the unit force."""
    line = span(g, f, pose)
    length = root((line * line).sum(axis=-1))
    turned = np.stack([f.along, f.across], axis=-1)
    return line, length, g.rotate(line / length[..., None], turned)


def lining_measure(g: Algebra, f: Lining, pose: Pose) -> Array:
    """Distance and turn about the axis, each as much as the force has power in it."""
    line, length, _ = _directions(g, f, pose)
    around = np.arctan2(line[..., 1], line[..., 0]) - pose.turn[..., f.j]
    turn = pose.turn[..., f.j] - pose.turn[..., f.i]
    return np.asarray(length * (f.along + f.across * around) + f.couple * turn)


def period_of_line(g: Algebra, f: Lining, pose: Pose) -> Array:
    """Change of the measure with a whole turn of the line; endless where the turn does not count in it."""
    _, length, _ = _directions(g, f, pose)
    slope = np.abs(f.across)
    return np.asarray(2 * np.pi * length * larger(slope, where(above(slope, FLAT), 0.0, ENDLESS)))


def lining_wrench(g: Algebra, f: Lining, pose: Pose, on_i: Array, on_j: Array) -> None:
    """The force through the axis, and the couple."""
    line, _, force = _directions(g, f, pose)
    ri, rj = arm(g, pose, f.i, f.ui), arm(g, pose, f.j, f.uj) - line
    couple = f.couple[..., None]
    on_j[..., f.row, : g.d], on_j[..., f.row, g.d :] = force, g.cross(rj, force) + couple
    on_i[..., f.row, : g.d], on_i[..., f.row, g.d :] = -force, -g.cross(ri, force) - couple


def lining_drift(g: Algebra, f: Lining, pose: Pose, twist: Array) -> Array:
    """Row f . v - rho sin(angle) omega_j: the force turns with the line."""
    line, length, force = _directions(g, f, pose)
    rate, second = span_motion(g, f, pose, twist)
    around = g.cross(line, rate)[..., 0] / length**2
    apart = (line * rate).sum(axis=-1) / length
    turned = around * g.cross(force, rate)[..., 0]
    return np.asarray(g.dot(force, second) + turned - apart * f.across * twist[..., f.j, g.d])


def strands(
    g: Algebra, f: BandStrands, pose: Pose
) -> Iterator[tuple[Ints, Array, Array, Array, Array, Array, float]]:
    """For each strand: its end's link and arm, tension, unit vector t, span E to O, free length, and the
    side of t on which it touches the drum: 1, to its left, of the first, since the band runs clockwise from it."""
    center = pose.point[..., f.i, :] + arm(g, pose, f.i, f.ui)
    arms = [arm(g, pose, link, u) for link, u in ((f.end_a, f.ua), (f.end_b, f.ub))]
    first, last = (pose.point[..., link, :] + r for link, r in zip((f.end_a, f.end_b), arms, strict=True))
    line, middle = first - last, center - (first + last) * 0.5
    across = _left(line) / root((line * line).sum(axis=-1))[..., None]
    towards = where(above(g.dot(across, middle), 0.0), 1.0, -1.0)
    across = across * towards[..., None]
    ends = ((f.end_a, arms[0], first, f.first, 1.0), (f.end_b, arms[1], last, f.last, -1.0))
    for link, r, at, tension, way in ends:
        away = center - at
        square = (away * away).sum(axis=-1)
        free = root(np.where(f.parallel != 0, square, square - f.radius**2))
        tangent = free[..., None] * away + way * f.radius[..., None] * _left(away)
        straight = f.parallel[..., None]
        t = straight * across + (1.0 - straight) * tangent / square[..., None]
        yield link, r, tension, t, away, free, way


def _left(v: Array) -> Array:
    return np.stack([-v[..., 1], v[..., 0]], axis=-1)


def strands_measure(g: Algebra, f: BandStrands, pose: Pose) -> Array:
    """Minus the length of the band, by its strands; across the line of its ends how far the ends are from the axis."""
    total = np.zeros(1)
    first = np.array([[any(bool(x != 0) for x in axis)] for axis in f.axis.tolist()], bool)
    for _, _, tension, t, away, free, side in strands(g, f, pose):
        around = free + f.radius * side * np.arctan2(t[..., 1], t[..., 0])
        straight = np.where(first, f.axis, t)
        length = np.where(f.parallel != 0, (straight * away).sum(axis=-1), around)
        total = total - tension * length
    wound = (pose.turn[..., f.i]) * _turning(g, f, pose)
    return np.asarray(total + wound)


def with_axis(g: Algebra, f: BandStrands, first: Pose) -> BandStrands:
    """The strands of a band at the first pose, whose direction is kept where they are parallel."""
    _, _, _, t, *_ = next(strands(g, f, first))
    return BandStrands(**{**vars(f), "axis": np.where(f.parallel[:, None] != 0, t, 0.0)})


def _turning(g: Algebra, f: BandStrands, pose: Pose) -> Array:
    """Couple on the drum a unit."""
    total = np.zeros(1)
    for _, _, tension, _, _, _, side in strands(g, f, pose):
        total = total + tension * side * f.radius
    return np.asarray(total)


def strands_wrench(g: Algebra, f: BandStrands, pose: Pose, on_i: Array, on_j: Array) -> None:
    """The strands pull their ends on j towards the drum, and the drum towards the ends."""
    ri, force_i = arm(g, pose, f.i, f.ui), np.zeros(2)
    force_j, couple_j = np.zeros(2), np.zeros(1)
    for link, r, tension, t, _, _, _ in strands(g, f, pose):
        pull = tension[..., None] * t
        mine = (link == f.j)[..., None]
        force_i = force_i - pull
        force_j, couple_j = force_j + mine * pull, couple_j + mine * g.cross(r, pull)
    on_i[..., f.row, : g.d] = force_i
    on_i[..., f.row, g.d :] = g.cross(ri, force_i) + _turning(g, f, pose)[..., None]
    on_j[..., f.row, : g.d], on_j[..., f.row, g.d :] = force_j, couple_j


def strands_drift(g: Algebra, f: BandStrands, pose: Pose, twist: Array) -> Array:
    """BandStrands turn about the drum as their ends move across."""
    v, a = point_motion(g, pose, twist, f.i, arm(g, pose, f.i, f.ui))
    total = np.zeros(1)
    for link, r, tension, t, _, free, _ in strands(g, f, pose):
        ve, ae = point_motion(g, pose, twist, link, r)
        turning = g.cross(t, ve - v)[..., 0] ** 2 / free * (1.0 - f.parallel)
        total = total + tension * (g.dot(t, ae - a) - turning)
    return np.asarray(total)
