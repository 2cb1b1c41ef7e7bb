"""Positions by Newton: A^T dq = closure error, many positions at once (docs/theory.md 3.2).

target  measures to be reached (..., K + D): constants of the constraints, positions of the drives
gap     target - measure, angles times the characteristic length: a length
"""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array, Ints
from dalembert.core.branchless import above, where
from dalembert.core.constraints import measure, stack_rows
from dalembert.core.elements import strand_rows
from dalembert.core.elements.lining_rows import period_of_line
from dalembert.core.elements.linings import Lining
from dalembert.core.elements.strand_family import Strand
from dalembert.core.factor import damped_step, displacement
from dalembert.core.layout import BeltMesh, Layout, Mesh, Pose
from dalembert.core.rotation_rows import recount_turns

CLOSED = 1e-9
"""Gap over characteristic length above which a pose does not close."""

FINE = 3e-8
"""A step below this, radians or characteristic lengths, is the last: the remaining error is its square. At a dead
centre the gap vanishes long before the error of the pose, so the step decides."""

HELD = 1e3
"""Stiffness of drives over that of constraints in the search for the least gap."""

LONGEST_TURN = 0.5
"""No step turns a link further than this, radians, or moves it further than the characteristic length times this."""


def gap(layout: Layout, pose: Pose, target: Array) -> Array:
    """Residual of the targets (..., K + D)."""
    missing: Array = target - measure(layout.algebra, layout.stack, pose)
    for family in layout.stack.families:
        if isinstance(family, Mesh | Strand):  # an angle of a line is known but for whole turns
            period = (
                2 * np.pi * (family.ri + family.rj)
                if isinstance(family, Mesh)
                else strand_rows.period(family)
            )
            part, whole = missing[..., family.row], period
            if isinstance(family, BeltMesh | Strand):  # wheels of a belt may be equal
                whole = where(
                    above(np.abs(period), 0.0), period, 1.0
                )  # not a huge number: machine code adds it
            missing[..., family.row] = part - period * np.round(part / whole)
        elif isinstance(family, Lining):
            period = period_of_line(layout.algebra, family, pose)
            part = missing[..., family.row]
            missing[..., family.row] = part - period * np.round(part / period)
    missing *= layout.row_scale
    return missing


def step(layout: Layout, pose: Pose, scaled_gap: Array) -> tuple[Array, Array]:
    """Newton step (..., L, n), shortened where it is long, and its size before that (...)."""
    with np.errstate(all="ignore"):
        dq = displacement(layout, stack_rows(layout, pose), scaled_gap)
    dq = dq.reshape((*dq.shape[:-1], layout.links, layout.algebra.n))
    size = largest(layout, dq)
    if size.max(initial=0.0) > LONGEST_TURN:
        dq = dq * np.minimum(1.0, LONGEST_TURN / np.maximum(size, 1e-300))[..., None, None]
    return dq, size


def largest(layout: Layout, dq: Array) -> Array:
    """Largest turn, or shift over characteristic length, of displacements (..., L, n)."""
    scaled = np.abs(dq) / (layout.wrench_scale * layout.length)
    return np.asarray(scaled.max(axis=(-2, -1), initial=0.0))


def displace(layout: Layout, pose: Pose, dq: Array) -> Pose:
    """The pose after a small displacement of the moving links (..., L, n)."""
    g = layout.algebra
    point = pose.point.copy()
    point[..., :-1, :] += dq[..., : g.d]
    return Pose(point, *g.rotate_links(pose.turn, pose.rotation, dq[..., g.d :]))


def distance(layout: Layout, a: Pose, b: Pose) -> Array:
    """Largest displacement of a link between two poses: radians, or lengths over the characteristic length (...)."""
    shift = np.abs(a.point - b.point).max(axis=(-2, -1)) / layout.length
    turned = layout.algebra.angle_between(a.rotation, b.rotation, a.turn, b.turn).max(axis=-1)
    return np.asarray(np.maximum(shift, turned))


def close_loops(
    layout: Layout, guess: Pose, target: Array, iterations: int = 40, polish: bool = True
) -> tuple[Pose, Array]:
    """Poses (P, L+1, ...) that reach the targets (P, K + D) from the guesses, and their remaining gaps (P,).

    A gap above ``CLOSED * length`` means that the target is not reached. Elements are independent. Without ``polish``
    an element stops at that gap; with it a last step follows, to rounding.
    """
    with np.errstate(all="ignore"):
        return _close_loops(layout, guess, target, iterations, polish)


def _close_loops(
    layout: Layout, pose: Pose, target: Array, iterations: int, polish: bool
) -> tuple[Pose, Array]:
    missing = gap(layout, pose, target)
    size = np.abs(missing).max(axis=-1, initial=0.0)
    active = np.arange(len(size))
    for _ in range(iterations):
        every = active.size == size.size
        part, wanted, open_ = (
            (pose, target, missing) if every else (pose.at(active), target[active], missing[active])
        )
        dq, length = step(layout, part, open_)
        last = (size[active] <= 100 * CLOSED * layout.length) & (length <= FINE)
        part = displace(layout, part, dq)
        open_ = gap(layout, part, wanted)
        left = np.abs(open_).max(axis=-1, initial=0.0)
        if every:
            pose, missing, size = part, open_, left
        else:
            _replace_poses(pose, active, part)
            missing[active], size[active] = open_, left
        active = active[~last if polish else left > CLOSED * layout.length]
        if not active.size:
            break
    return recount_turns(layout, pose), size


def _replace_poses(pose: Pose, where: Ints, part: Pose) -> None:
    for array, new in zip(pose, part, strict=True):
        array[where] = new


LEAST, STILL = 1e-10, 1e-12
"""Least damping with which a singular least-squares matrix can be solved; relative change of the gap below which it
counts as minimal."""


def least_gap(layout: Layout, start: Pose, target: Array, steps: int = 200) -> Array:
    """The smallest gap (K + D) that poses near ``start`` (L+1, ...) leave, the drives held: damped least squares."""
    stiff = np.concatenate([np.ones(layout.constraints.count), np.full(len(layout.driven), HELD)])
    pose, best, damping = start.at(None), gap(layout, start.at(None), target[None])[0], 1.0
    for _ in range(steps):
        dq = damped_step(layout, stack_rows(layout, pose), stiff, best, damping)
        trial = displace(layout, pose, dq.reshape(1, layout.links, -1))
        new = gap(layout, trial, target[None])[0]
        size, least = np.linalg.norm(new * stiff), np.linalg.norm(best * stiff)
        if size < least:
            pose, best, damping = trial, new, max(damping / 3, LEAST)
        else:
            damping *= 4
        if abs(size - least) <= STILL * least:
            break
    return np.asarray(best)
