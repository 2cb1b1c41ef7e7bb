"""Strands of ropes as rows of A: measure, wrenches, drift, and the angles by which a rope wraps wheels.

D   vector from the point of i to that of j
u   unit vector along the strand, from i to j
v   unit vector on its left
l   length of the strand: D = l u + (ri - rj) v

Mechanics: docs/theory.md 5.7.
"""

from __future__ import annotations

import numpy as np

from dalembert.algebra import plane
from dalembert.algebra.protocol import Algebra
from dalembert.arrays import Array, Ints
from dalembert.core.branchless import above, root, where
from dalembert.core.elements.strand_family import Strand, StrandSum
from dalembert.core.geometry import arm, span, span_motion
from dalembert.core.layout import Layout, Pose


def direction(g: Algebra, f: Strand, pose: Pose) -> tuple[Array, Array]:
    """u (..., k, d) and l (..., k) of each strand; NaN where its wheels are too near."""
    line, across, parallel = span(g, f, pose), f.ri - f.rj, _is_parallel(f)
    if parallel.all():
        return np.broadcast_to(f.axis, line.shape), g.dot(f.axis, line)
    square = g.dot(line, line)
    length = root(np.where(parallel, 1.0, square - across * across))
    along = length[..., None] * line - across[..., None] * plane.across(line)
    tangent = along / np.where(parallel, 1.0, square)[..., None]
    unit = np.where(parallel[:, None], f.axis, tangent)
    return unit, np.where(parallel, g.dot(f.axis, line), length)


def _is_parallel(f: Strand) -> Array:
    """Strands (k,) that keep their direction: part of the structure, not of the numbers."""
    return np.array([any(bool(x != 0) for x in axis) for axis in f.axis.tolist()], bool)


def measure(g: Algebra, f: Strand, pose: Pose) -> Array:
    """Minus the rope in each strand, and what its ends have unwound."""
    unit, length = direction(g, f, pose)
    parallel, psi = _is_parallel(f), np.zeros_like(length)
    some = ~parallel & np.array([bool(x != 0) for x in (f.ri - f.rj).tolist()], bool)
    if some.any():
        bent = g.cross(f.zero, unit)[..., 0][..., some], g.dot(f.zero, unit)[..., some]
        psi[..., some] = np.arctan2(*bent)
    wound = f.wi * pose.turn[..., f.i] - f.wj * pose.turn[..., f.j]
    return np.asarray(-(length - (f.ri - f.rj) * psi + wound))


def period(f: Strand) -> Array:
    """Change of the measure over a full turn of the strand's direction; 0 where it has none."""
    return np.asarray(np.where(_is_parallel(f), 0.0, 2 * np.pi * (f.ri - f.rj)))


def wrench(g: Algebra, f: Strand, pose: Pose, on_i: Array, on_j: Array) -> None:
    """A unit of tension pulls j back along the strand, and i forth, where it touches them."""
    unit, _ = direction(g, f, pose)
    ri, rj = arm(g, pose, f.i, f.ui), arm(g, pose, f.j, f.uj)
    on_j[..., f.row, : g.d], on_j[..., f.row, g.d :] = -unit, f.wj[..., None] - g.cross(rj, unit)
    on_i[..., f.row, : g.d], on_i[..., f.row, g.d :] = unit, g.cross(ri, unit) - f.wi[..., None]


def drift(g: Algebra, f: Strand, pose: Pose, twist: Array) -> Array:
    """Second rate of the measure at zero link accelerations."""
    unit, length = direction(g, f, pose)
    rate, second = span_motion(g, f, pose, twist)
    aside = g.dot(plane.across(unit), rate)
    parallel = _is_parallel(f)
    turning = np.where(parallel, 0.0, aside * aside / np.where(parallel, 1.0, length))
    return np.asarray(-(g.dot(unit, second) + turning))


def strands(layout: Layout) -> Strand | None:
    """The family of strands; None without ropes."""
    return next((f for f in layout.constraints.families if isinstance(f, Strand)), None)


def with_zero(layout: Layout, f: Strand, first: Pose) -> Strand:
    """The strands at the first pose: angles count from it, and parallel strands run so that the rope is long."""
    g = layout.algebra
    _, length = direction(g, f, first)
    total = np.zeros(int(f.rope.max()) + 1)
    np.add.at(total, f.rope, np.where(_is_parallel(f), length, 1.0))
    turned = Strand(**{**vars(f), "axis": np.where(total[f.rope, None] < 0, -f.axis, f.axis)})
    unit, _ = direction(g, turned, first)
    return Strand(**{**vars(turned), "zero": np.where(np.isfinite(unit), unit, f.zero)})


def wraps(g: Algebra, f: Strand, pose: Pose, before: Ints, after: Ints, way: Array, turns: Array) -> Array:
    """Angle (..., W) by which a rope wraps a wheel between two strands, ``way`` 1 where it turns counter-clockwise.

    Between parallel strands half a turn; ``turns``: whole turns more.
    """
    unit, _ = direction(g, f, pose)
    a, b = unit[..., before, :], unit[..., after, :]
    flat = _is_parallel(f)[before] & _is_parallel(f)[after]
    angle = np.full(a.shape[:-1], np.pi, a.dtype)
    if not flat.all():
        bent = way * np.arctan2(g.cross(a, b)[..., 0], g.dot(a, b))
        angle = np.where(flat, np.pi, where(above(-bent, 0.0), bent + 2 * np.pi, bent))
    return np.asarray(angle + 2 * np.pi * turns)


def sum_measure(g: Algebra, f: StrandSum, pose: Pose) -> Array:
    """Half the length of both strands, and of what they unwind as the centres move apart."""
    line, total = span(g, f, pose), f.ri + f.rj
    length = np.sqrt(g.dot(line, line) - total * total)
    return np.asarray(length + total * np.arctan2(total + 0.0 * length, length))


def sum_wrench(g: Algebra, f: StrandSum, pose: Pose, on_i: Array, on_j: Array) -> None:
    """The force on j along the line of centres, and the opposite on i."""
    force = _along_centres(g, f, pose)
    ri, rj = arm(g, pose, f.i, f.ui), arm(g, pose, f.j, f.uj)
    on_j[..., f.row, : g.d], on_j[..., f.row, g.d :] = force, g.cross(rj, force)
    on_i[..., f.row, : g.d], on_i[..., f.row, g.d :] = -force, -g.cross(ri, force)


def _along_centres(g: Algebra, f: StrandSum, pose: Pose) -> Array:
    line, total = span(g, f, pose), f.ri + f.rj
    square = g.dot(line, line)
    return np.asarray((np.sqrt(square - total * total) / square)[..., None] * line)


def sum_drift(g: Algebra, f: StrandSum, pose: Pose, twist: Array) -> Array:
    """Second rate of the measure at zero link accelerations."""
    line, (rate, second) = span(g, f, pose), span_motion(g, f, pose, twist)
    total, square = f.ri + f.rj, g.dot(line, line)
    free, moved = np.sqrt(square - total * total), g.dot(line, rate)
    bend = (g.dot(rate, rate) + g.dot(line, second)) * free / square
    return np.asarray(bend + moved * moved * (1 / (free * square) - 2 * free / (square * square)))
