"""Wrenches and power of the joints' friction, dry and viscous; reversal of the efforts' power by friction.

Mechanics: docs/theory.md 6.3.
"""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array, Ints
from dalembert.core.branchless import above, top
from dalembert.core.constraints import rates, system
from dalembert.core.friction.contact_equations import ContactResponse, Contacts, SlipState, argument
from dalembert.core.layout import ConstraintRows, Layout, Pose

POWERLESS = 1e-9
"""A power below this part of the largest load times the fastest motion has no sign: at a dead centre all powers are
rounding."""


def friction_arrays(
    layout: Layout,
    contacts: Contacts,
    pose: Pose,
    twist: Array,
    along: ConstraintRows,
    r: ContactResponse,
    state: SlipState,
    cz: Array,
) -> dict[str, Array]:
    """Effects of friction of efforts c z (..., E), by the names of ``analysis.result.force_arrays.Friction``; numbers
    or nodes."""
    dry = np.where(contacts.fixed, 0.0, cz)
    force, moment = dry_wrenches(layout, contacts, pose, along, dry)
    viscous_force, viscous_moment, viscous_loss = viscous_wrenches(layout, contacts, pose, twist)
    return {
        "force": force,
        "moment": moment,
        "viscous_force": viscous_force,
        "viscous_moment": viscous_moment,
        "dry_loss": by_joint(contacts.joint, layout.joints, -dry * state.rate),
        "viscous_loss": viscous_loss,
        "cz": dry,
        "sense": state.sense,
        "rate": state.rate,
        "argument": argument(r, cz),
    }


BESIDE = ("lining", "band")
"""Kinds of contacts in the plane whose force does not act at j's point: it has a couple about that point."""
PITCH_POINT = "mesh"
"""Kind of contacts whose force acts at the pitch point, as their joint's reaction does: it has no couple there."""


def dry_wrenches(
    layout: Layout, contacts: Contacts, pose: Pose, along: ConstraintRows, effort: Array
) -> tuple[Array, Array]:
    """Force (..., joints, d) and moment about j's point (..., joints; in space with 3 components) on j of the contacts'
    efforts (..., E)."""
    return _in_joints(layout, contacts, contacts.joint, pose, along, effort, contacts.kind)


def viscous_wrenches(
    layout: Layout, contacts: Contacts, pose: Pose, twist: Array
) -> tuple[Array, Array, Array]:
    """Force, moment and lost power of the joints' viscous damping."""
    damping = contacts.damping
    rows = system(layout.algebra, layout.freedoms, pose).rows(damping.row)
    joint, rate = layout.freedoms.joint[damping.row], rates(rows, twist)
    force, moment = _in_joints(layout, contacts, joint, pose, rows, -damping.damping * rate)
    return force, moment, by_joint(joint, layout.joints, damping.damping * rate * rate)


def _in_joints(
    layout: Layout,
    contacts: Contacts,
    joint: Ints,
    pose: Pose,
    along: ConstraintRows,
    effort: Array,
    kind: tuple[str, ...] = (),
) -> tuple[Array, Array]:
    """Forces and moments on j of efforts (..., K) along rows of some joints (K,)."""
    g, lead, link = layout.algebra, effort.shape[:-1], contacts.link
    force = np.zeros((*lead, layout.joints, g.d), effort.dtype)
    couple = np.zeros((*lead, layout.joints, g.n - g.d), effort.dtype)
    for e, k in enumerate(joint):
        on_j = along.on_j if along.j[e] == link[k] else along.on_i
        wrench = effort[..., e, None] * on_j[..., e, :]
        force[..., k, :] += wrench[..., : g.d]
        if along.angular[e]:
            couple[..., k, :] += wrench[..., g.d :]
        elif _has_couple(g.d, kind[e] if kind else ""):
            arm = g.rotate(pose.rotation[..., link[k], :], contacts.at[k])
            couple[..., k, :] += wrench[..., g.d :] - g.cross(arm, wrench[..., : g.d])
    return force, couple[..., 0] if g.d == 2 else couple


def _has_couple(d: int, kind: str) -> bool:
    """True where a force of a kind has a couple about the point at which its joint's reaction acts."""
    return kind in BESIDE if d == 2 else kind != PITCH_POINT


def by_joint(joint: Ints, joints: int, values: Array) -> Array:
    """Sum (..., joints) of the values (..., K) of each joint."""
    out = np.zeros((*values.shape[:-1], joints), values.dtype)
    for e, k in enumerate(joint):
        out[..., k] += values[..., e]
    return out


def power_reversed(
    layout: Layout, unknown: ConstraintRows, twist: Array, w: Array, x: Array, bare: Array
) -> Array:
    """True where the power (...) of the unknown efforts and loads changes sign with friction.

    x, bare: multipliers with and without friction; w (..., L, n) wrenches on the links; ``unknown`` the rows of x.
    """
    count = layout.constraints.count
    rate = rates(unknown.rows(slice(count, None)), twist)
    with_, without = (x[..., count:] * rate).sum(axis=-1), (bare[..., count:] * rate).sum(axis=-1)
    scale = layout.wrench_scale
    size = top(np.abs(w * scale), 2) * top(np.abs(twist / scale), 2)
    return above(-(with_ * without), 0.0) & above(np.abs(without), POWERLESS * size)
