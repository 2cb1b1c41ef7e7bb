"""Mobility and redundancy by rank of the constraints at a pose, not by count (docs/theory.md 3.4)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags
from dalembert.core.constraints import dense, stack_rows, system
from dalembert.core.factor import factor, row_scale
from dalembert.core.layout import Layout, Pose
from dalembert.core.linear import SINGULAR, pseudo_inverse


class Rank(NamedTuple):
    """Mobility and redundancy of the constraints.

    freedoms: dimension of the motions they allow; redundant: number of constraints beyond the rank; repeated (K,) flags
    the constraints that take part in a redundancy; loose (L,) the links and free (F,) the joint freedoms that still
    move with all drives at rest; fixed (D,) the drives that cannot move.
    """

    freedoms: int
    redundant: int
    repeated: Flags
    loose: Flags
    free: Flags


def singular_below(layout: Layout) -> float:
    """Reciprocal condition below which a position counts as singular; large chains are worse conditioned by size."""
    return SINGULAR / max(1.0, layout.links / 10) ** 3


def is_rigid(layout: Layout, pose: Pose) -> bool:
    """True if constraints and drives leave no link free at this pose."""
    rcond = factor(layout, stack_rows(layout, pose.at(None))).rcond[0]
    return bool(rcond > singular_below(layout))


def well_driven(layout: Layout, pose: Pose) -> bool:
    """True if constraints and drives fix every link exactly once: the common case, tested cheaply."""
    return layout.stack.count == layout.unknowns and is_rigid(layout, pose)


TOLERANCE = 1e-7


def rank(layout: Layout, pose: Pose) -> Rank:
    """Rank of the constraints at a pose (L+1, ...), by singular values."""
    pose = pose.at(None)
    constraints = system(layout.algebra, layout.constraints, pose)
    column = layout.column_scale
    alone = pseudo_inverse(
        dense(layout, constraints), row_scale(layout, constraints.angular), column, TOLERANCE
    )
    freedoms = layout.unknowns - int(alone.rank[0])
    redundant = layout.constraints.count - int(alone.rank[0])
    repeated = np.abs(alone.null[0]).max(axis=-1, initial=0.0) > 1e-6
    rows = stack_rows(layout, pose)
    inverse = pseudo_inverse(dense(layout, rows), row_scale(layout, rows.angular), column, TOLERANCE)
    held = inverse.pinv[0] @ (dense(layout, rows) * row_scale(layout, rows.angular)[:, None] * column)[0]
    idle = (np.eye(layout.unknowns) - held).reshape(layout.links, -1, layout.unknowns)
    loose = np.abs(idle).max(axis=(1, 2), initial=0.0) > 1e-6
    return Rank(
        freedoms, redundant, repeated, loose, _free(layout, pose, np.eye(layout.unknowns) - held, column)
    )


def _free(layout: Layout, pose: Pose, idle: Array, column: Array) -> Flags:
    """Joint freedoms that move in the motions the drives leave."""
    rows = system(layout.algebra, layout.freedoms, pose)
    j = dense(layout, rows)[0] * row_scale(layout, rows.angular)[:, None] * column
    return np.asarray(np.abs(j @ idle).max(axis=-1, initial=0.0) > 1e-6)
