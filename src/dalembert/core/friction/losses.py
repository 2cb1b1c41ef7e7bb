"""What friction does in each joint: its wrench, the power it takes; whether it turns the unknowns' power round."""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array, Ints
from dalembert.core.branchless import above, top
from dalembert.core.constraints import rates, system
from dalembert.core.forcing import Resistances
from dalembert.core.layout import Layout, Pose, System

POWERLESS = 1e-9
"""A power below this part of the largest load times the fastest motion has no sign: at a dead centre all powers are
rounding."""


def in_joints(
    layout: Layout, pose: Pose, along: System, joint: Ints, link: Ints, at: Array, effort: Array
) -> tuple[Array, Array]:
    """Force (..., joints, d) and moment about j's point (..., joints; in space with 3 components) on j of efforts
    (..., K) along rows; ``link`` (joints,) is the link j of each joint, ``at`` (joints, d) the arm of its point."""
    g, lead = layout.algebra, effort.shape[:-1]
    force = np.zeros((*lead, layout.joints, g.d), effort.dtype)
    couple = np.zeros((*lead, layout.joints, g.n - g.d), effort.dtype)
    for e, k in enumerate(joint):
        on_j = along.on_j if along.j[e] == link[k] else along.on_i
        wrench = effort[..., e, None] * on_j[..., e, :]
        force[..., k, :] += wrench[..., : g.d]
        if along.angular[e]:
            couple[..., k, :] += wrench[..., g.d :]
        elif g.d == 3:
            arm = g.rotate(pose.rotation[..., link[k], :], at[k])
            couple[..., k, :] += wrench[..., 3:] - g.cross(arm, wrench[..., :3])
    return force, couple[..., 0] if g.d == 2 else couple


def by_joint(joint: Ints, joints: int, values: Array) -> Array:
    """Sum (..., joints) of the values (..., K) of each joint."""
    out = np.zeros((*values.shape[:-1], joints), values.dtype)
    for e, k in enumerate(joint):
        out[..., k] += values[..., e]
    return out


def viscous(
    layout: Layout, own: Resistances, pose: Pose, twist: Array, link: Ints, at: Array
) -> tuple[Array, Array, Array]:
    """Force, moment and lost power of the joints' own damping; ``link``, ``at`` as above."""
    rows = system(layout.algebra, layout.freedoms, pose).rows(own.row)
    joint = layout.freedoms.joint[own.row]
    rate = rates(rows, twist)
    force, moment = in_joints(layout, pose, rows, joint, link, at, -own.damping * rate)
    return force, moment, by_joint(joint, layout.joints, own.damping * rate * rate)


def power_reversed(layout: Layout, unknown: System, twist: Array, w: Array, x: Array, bare: Array) -> Array:
    """Where the power (...) of the unknown efforts and loads has another sign with friction than without.

    x, bare: multipliers with and without friction; w (..., L, n) what loads the links; ``unknown`` the rows of x.
    """
    count = layout.constraints.count
    rate = rates(unknown.rows(slice(count, None)), twist)
    with_, without = (x[..., count:] * rate).sum(axis=-1), (bare[..., count:] * rate).sum(axis=-1)
    scale = layout.wrench_scale
    size = top(np.abs(w * scale), 2) * top(np.abs(twist / scale), 2)
    return above(-(with_ * without), 0.0) & above(np.abs(without), POWERLESS * size)
