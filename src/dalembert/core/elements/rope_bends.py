"""Strength of the friction of a rope on a wheel where its angle of wrap follows from the pose.

Mechanics: docs/theory.md 5.7.
"""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array, Ints
from dalembert.core.branchless import above, where
from dalembert.core.elements import strand_rows
from dalembert.core.friction.capstan import capstan
from dalembert.core.layout import Layout, Pose


def bend_factor(layout: Layout, pose: Pose, mu: Array, bends: Ints, way: Ints, given: Array) -> Array:
    """Strength (..., E) at the wrap of a pose over that of a ``given`` wrap (E,), half a turn and full turns.

    mu (..., E): coefficients; bends (E, 2): the strands before and behind, ``way`` as in ``strand_rows.wraps``.
    """
    f, none = strand_rows.strands(layout), np.zeros(len(bends))
    if f is None:
        return np.ones_like(mu)
    turns = given / (2 * np.pi) - 0.5
    wrap = strand_rows.wraps(layout.algebra, f, pose, bends[:, 0], bends[:, 1], way, turns)
    some = above(mu, 0.0)
    reference = where(some, capstan(mu, given + 0 * wrap, none), 1.0)
    return np.asarray(where(some, capstan(mu, wrap + 0 * mu, none) / reference, 1.0))
