"""Positions by Newton: A^T dq = closure error, many positions at once (THEORY.md 1).

target  measures to be reached (..., K + D): constants of the constraints, positions of the drives
gap     target - measure, angles times the characteristic length: a length
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from dalembert.core.constraints import stacked, stacked_measure
from dalembert.core.factor import factor, row_scale
from dalembert.core.layout import Layout, Mesh, Pose

Array = NDArray[Any]

CLOSED = 1e-9
"""Gap over characteristic length below which one more Newton step reaches rounding."""

FINE = 1e-7
"""The last step must be below this too: at a dead centre the gap vanishes long before the error of the pose."""

LONGEST_TURN = 0.5
"""No step turns a link further than this, radians, or moves it further than the characteristic length times this."""


def gap(layout: Layout, pose: Pose, target: Array) -> Array:
    """What is missing to the targets (..., K + D)."""
    missing: Array = target - stacked_measure(layout, pose)
    for family in layout.constraints.families:
        if isinstance(family, Mesh):  # the angle of the line of centres is known but for whole turns
            period = 2 * np.pi * (family.ri + family.rj)
            part = missing[..., family.row]
            missing[..., family.row] = part - period * np.round(part / period)
    return np.asarray(missing * row_scale(layout, layout.angular))


def step(layout: Layout, pose: Pose, scaled_gap: Array) -> Array:
    """Newton step (..., L, n), shortened where it is long."""
    rows = stacked(layout, pose)
    solver = factor(layout, rows)
    with np.errstate(all="ignore"):
        dq = np.nan_to_num(
            solver.motion(scaled_gap / row_scale(layout, rows.angular)), nan=0.0, posinf=0.0, neginf=0.0
        )
    dq = dq.reshape((*dq.shape[:-1], layout.links, layout.algebra.n))
    return np.asarray(
        dq * np.minimum(1.0, LONGEST_TURN / np.maximum(largest(layout, dq), 1e-300))[..., None, None]
    )


def largest(layout: Layout, dq: Array) -> Array:
    """Largest turn, or shift over characteristic length, of displacements (..., L, n)."""
    g = layout.algebra
    per_length = np.repeat([1 / layout.length, 1.0], [g.d, g.n - g.d])
    return np.asarray(np.abs(dq * per_length).max(axis=(-2, -1), initial=0.0))


def moved(layout: Layout, pose: Pose, dq: Array) -> Pose:
    """The pose after a small displacement of the moving links (..., L, n)."""
    g = layout.algebra
    point, turn, rotation = pose.point.copy(), pose.turn.copy(), pose.rotation.copy()
    point[..., :-1, :] += dq[..., : g.d]
    turn[..., :-1] += dq[..., -1]
    rotation[..., :-1, :] = g.rotation(turn[..., :-1])
    return Pose(point, turn, rotation)


def distance(layout: Layout, a: Pose, b: Pose) -> Array:
    """Largest displacement of a link between two poses: radians, or lengths over the characteristic length (...)."""
    shift = np.abs(a.point - b.point).max(axis=(-2, -1)) / layout.length
    return np.asarray(np.maximum(shift, np.abs(a.turn - b.turn).max(axis=-1)))


def closed(layout: Layout, guess: Pose, target: Array, iterations: int = 40) -> tuple[Pose, Array]:
    """Poses (P, L+1, ...) that reach the targets (P, K + D) from the guesses, and their remaining gaps (P,).

    A gap above ``CLOSED * length`` means: not reached from here. Elements are independent of each other.
    """
    pose = Pose(*(a.copy() for a in guess))
    missing = gap(layout, pose, target)
    size = np.abs(missing).max(axis=-1, initial=0.0)
    active = np.arange(len(size))
    for _ in range(iterations):
        dq = step(layout, pose.at(active), missing[active])
        last = (size[active] <= CLOSED * layout.length) & (largest(layout, dq) <= FINE)
        part = moved(layout, pose.at(active), dq)
        for whole, new in zip(pose, part, strict=True):
            whole[active] = new
        missing[active] = gap(layout, part, target[active])
        size[active] = np.abs(missing[active]).max(axis=-1, initial=0.0)
        active = active[~last]
        if not active.size:
            break
    return pose, size
