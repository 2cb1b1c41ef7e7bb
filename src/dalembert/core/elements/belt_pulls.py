"""Pull of belts on the shafts of their wheels: what the sum of both strands' tensions adds to their difference.

The row of a belt (``BeltMesh``) carries the difference t = T1 - T2 of the tensions: a couple on each wheel and, of
unequal wheels, a force across the line of centres. The sum N = T1 + T2 - 2 T_c pulls the centres
together with N cos(gamma).

N   net sum of both tensions, of what is given: constant - 2 m v^2 + share |t|
T_c centrifugal tension m v^2, which no shaft feels
v   speed of the belt, r_i (w_i - phi') with phi the angle of the line of centres

Mechanics: docs/theory.md 5.7.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.core.branchless import root, sign
from dalembert.core.geometry import arm, span, span_motion
from dalembert.core.layout import BeltMesh, Layout, Pose


@dataclass(frozen=True)
class BeltPulls:
    """Sources of the sum of each belt's tensions (k,), in the order of their rows.

    constant: N at rest and without torque; share: -1, 0 or 1 of |t|; mass: per length, counted in N; carried: per
    length, of the belt itself; gripped, grip: whether friction holds it, and the coefficient of a flat wheel.
    """

    constant: Array
    share: Array
    mass: Array
    carried: Array
    gripped: Flags
    grip: Array


def belts(layout: Layout) -> BeltMesh | None:
    """The family of belts; None without."""
    return next((f for f in layout.constraints.families if isinstance(f, BeltMesh)), None)


def belt_speed(layout: Layout, f: BeltMesh, pose: Pose, twist: Array) -> Array:
    """Speed (..., k) of each belt against its line of centres, positive with the turn of i."""
    g = layout.algebra
    line, (rate, _) = span(g, f, pose), span_motion(g, f, pose, twist)
    turning = g.cross(line, rate)[..., 0] / g.dot(line, line)
    return np.asarray(f.ri * (twist[..., f.i, 2] - turning))


def net_sum(pulls: BeltPulls, speed: Array, difference: Array | None) -> Array:
    """N (..., k), without the part of the difference where that is not known."""
    known = pulls.constant - 2 * pulls.mass * speed * speed
    return np.asarray(known if difference is None else known + pulls.share * np.abs(difference))


def pull_on_j(layout: Layout, f: BeltMesh, pose: Pose, net: Array) -> Array:
    """Force (..., k, d) on the wheel of j at its centre, towards that of i; on i the opposite."""
    line = span(layout.algebra, f, pose)
    square = layout.algebra.dot(line, line)
    cosine = np.sqrt(1 - (f.ri + f.rj) ** 2 / square)
    return np.asarray(-(net * cosine / np.sqrt(square))[..., None] * line)


def tensions(net: Array, centrifugal: Array, difference: Array) -> tuple[Array, Array]:
    """Tensions (..., k) of the tight and the slack strand."""
    size = np.abs(difference)
    return np.asarray((net + size) / 2 + centrifugal), np.asarray((net - size) / 2 + centrifugal)


def wraps(layout: Layout, f: BeltMesh, pose: Pose) -> Array:
    """Angles of wrap (..., 2, k) on the wheels of i and j."""
    line, total = span(layout.algebra, f, pose), f.ri + f.rj
    length = root(layout.algebra.dot(line, line) - total * total)
    gamma = np.arctan2(total + 0.0 * length, length)
    return np.stack([np.pi + 2 * gamma, np.pi + 2 * gamma * sign(f.rj)], axis=-2)


def pull_wrench(layout: Layout, f: BeltMesh, pose: Pose, force: Array) -> tuple[Ints, Array]:
    """Links (2 k,) and wrenches (..., 2 k, n) about their reference points of forces on j."""
    g, parts = layout.algebra, []
    for link, u, side in ((f.i, f.ui, -1.0), (f.j, f.uj, 1.0)):
        at, on = arm(g, pose, link, u), side * force
        parts.append(np.concatenate([np.broadcast_to(on, at.shape), g.cross(at, on)], axis=-1))
    return np.concatenate([f.i, f.j]), np.concatenate(parts, axis=-2)
