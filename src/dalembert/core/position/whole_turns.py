"""Whole turns of relative angles, counted at a place of the motion that does not depend on the list of positions.

phi  a relative angle, followed through whole turns along the motion

Mechanics: docs/theory.md 3.2.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.core.constraints import measure, rates, stack_rows, system
from dalembert.core.factor import displacements
from dalembert.core.layout import Layout, Pose, Turn
from dalembert.core.position.continuation import march, twists
from dalembert.core.position.first_pose_plane import phase_rows
from dalembert.core.position.path_parameter import course

EDGE = 1e-7
"""Radians beyond half a turn that rounding may bring about."""

INWARD = 1e-3
"""Radians by which an angle is taken back from the end of a motion, which two marches do not meet at the same point."""

MOVES = 1e-9
"""Radians of a relative turn over those of a wheel's phase, below which it does not depend on the phase."""


def whole_turns(phi: Array, near: Array) -> Array:
    """How many turns an angle is beyond half a turn of another; half a turn ahead is within."""
    return np.asarray(np.ceil((phi - near - EDGE) / (2 * np.pi) - 0.5))


class Way(NamedTuple):
    """Where a motion towards given positions of the drives ends: angles of the freedoms (F,), whether it got there."""

    pose: Pose
    phi: Array
    met: bool


def way(layout: Layout, pose: Pose, here: Array, there: Array) -> Way:
    """The motion from a pose (L+1, ...) at targets (K + D,) straight to other targets of its drives."""
    g, freedoms = layout.algebra, layout.freedoms
    along = course(layout, np.stack([here, there]))
    start = along.at(0)
    found = march(layout, pose, along, start, backward=start > 0)
    phi = measure(g, freedoms, found.pose)
    if start > 0:
        phi, found = phi[::-1], found._replace(pose=found.pose.at(slice(None, None, -1)))
    end = phi[-1]
    if not found.whole and len(phi) > 1:
        end = end - np.clip(phi[-1] - phi[-2], -INWARD, INWARD)
    return Way(found.pose.at(-1), end, found.whole)


def rigid_turns(layout: Layout) -> Ints:
    """A number of each link (L+1,), the same for links whose relative angle constraints and drives give."""
    group = np.arange(layout.links + 1)
    for family in layout.stack.families:
        if isinstance(family, Turn):
            for i, j in zip(family.i, family.j, strict=True):
                group[group == group[i]] = group[j]
    return group


def phase_freedoms(layout: Layout, pose: Pose) -> Flags:
    """Freedoms (F,) that the phases of meshing or rolling wheels turn."""
    moved = _with_phase(layout, pose)
    with np.errstate(all="ignore"):
        turns = rates(system(layout.algebra, layout.freedoms, pose), moved) * layout.length
    return np.asarray((np.abs(turns) > MOVES).any(axis=0) & layout.freedoms.angular)


def phase_links(layout: Layout, pose: Pose) -> Flags:
    """Links of the plane (L,) that the phases of meshing or rolling wheels turn."""
    turns = _with_phase(layout, pose)[:, :-1, -1] * layout.length
    return np.asarray((np.abs(turns) > MOVES).any(axis=0))


def _with_phase(layout: Layout, pose: Pose) -> Array:
    """Displacements (phases, L+1, n) of the links for one unit of each phase."""
    rows = phase_rows(layout.constraints)
    if not rows.size:
        return np.zeros((0, layout.links + 1, layout.algebra.n))
    with np.errstate(all="ignore"):
        one = np.eye(layout.stack.count)[rows] * layout.row_scale[rows, None]
        return np.asarray(twists(layout, displacements(layout, stack_rows(layout, pose.at(None)), one)[0]))
