"""Whole turns of relative angles, counted at a pose of the motion that does not depend on the list of positions.

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
"""Radians beyond half a turn that rounding may cause."""

INWARD = 1e-3
"""Radians by which an angle is moved back from the end of a motion, since two marches do not end at exactly the same
point."""

MOVES = 1e-9
"""Rate of a relative turn over that of a wheel's phase below which the turn does not depend on the phase."""


def whole_turns(phi: Array, near: Array) -> Array:
    """Number of turns by which an angle differs from another by more than half a turn; exactly half a turn ahead counts
    as zero."""
    return np.asarray(np.ceil((phi - near - EDGE) / (2 * np.pi) - 0.5))


class Way(NamedTuple):
    """End of a motion towards given positions of the drives: angles of the freedoms (F,), and True if reached."""

    pose: Pose
    phi: Array
    met: bool


def straight_path(layout: Layout, pose: Pose, here: Array, goal: Array) -> Way:
    """The motion from a pose (L+1, ...) at targets (K + D,) straight to other targets of its drives."""
    g, freedoms = layout.algebra, layout.freedoms
    along = course(layout, np.stack([here, goal]))
    start = along.at(0)
    stations = march(layout, pose, along, start, backward=start > 0)
    phi = measure(g, freedoms, stations.pose)
    if start > 0:
        phi, stations = phi[::-1], stations._replace(pose=stations.pose.at(slice(None, None, -1)))
    end = phi[-1]
    if not stations.complete and len(phi) > 1:
        end = end - np.clip(phi[-1] - phi[-2], -INWARD, INWARD)
    return Way(stations.pose.at(-1), end, stations.complete)


def rigid_turns(layout: Layout) -> Ints:
    """A number for each link (L+1,), equal for links whose relative angle is fixed by constraints and drives."""
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
    """Planar links (L,) that the phases of meshing or rolling wheels turn."""
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
