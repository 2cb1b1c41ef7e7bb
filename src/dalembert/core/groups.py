"""Groups of links that are solved one after another, and which way each of them is assembled.

Rows and unknowns of a square J are put in block triangular form (Dulmage and Mendelsohn, 1958): a group of links that
only closes as a whole (Assur) has a diagonal block of its own. J becomes singular where one block does, so along a
motion no block's determinant changes its sign, while det J, their product, keeps its own where two of them do.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dalembert.core.constraints import dense, stacked
from dalembert.core.layout import Layout, Pose

Array = NDArray[Any]

NOTHING = 1e-9
"""Part of the largest entry of J below which an entry counts as 0: cosines of right angles, rounded."""

LARGEST = 600
"""Unknowns above which J is not asked."""

TOLD_APART = 3
"""Links up to which a group closes in two ways, of opposite signs: two, and one that a drive holds to one of them.
Larger ones close in more ways, several of the same sign."""


class Group(NamedTuple):
    """Rows and columns (b,) of a diagonal block of J."""

    row: NDArray[np.intp]
    column: NDArray[np.intp]


def groups(layout: Layout, pose: Pose) -> list[Group]:
    """Diagonal blocks of J by the entries that differ from 0 at any of the poses (P, L+1, ...).

    None where J is not square, too large, or singular by its zeros alone, and where a group has too many links for its
    sign to tell all its ways apart.
    """
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import connected_components, maximum_bipartite_matching

    if not layout.square or layout.unknowns > LARGEST:
        return []
    size = np.abs(_scaled(layout, pose)).max(axis=0)
    filled = size > NOTHING * size.max()
    column = maximum_bipartite_matching(csr_array(filled.astype(np.int8)), perm_type="column")
    if (column < 0).any():
        return []
    count, label = connected_components(csr_array(filled[:, column].astype(np.int8)), connection="strong")
    rows = [np.flatnonzero(label == k) for k in range(count)]
    found = [Group(row, column[row].astype(np.intp)) for row in rows]
    links = [len(np.unique(group.column // layout.algebra.n)) for group in found]
    return found if max(links) <= TOLD_APART else []


def senses(layout: Layout, found: list[Group], pose: Pose) -> Array:
    """Signs (P, G) of the groups' determinants: each tells the two sides of a dead centre of its group apart."""
    j = _scaled(layout, pose)
    return np.stack([np.linalg.slogdet(j[:, g.row[:, None], g.column])[0] for g in found], axis=1)


def _scaled(layout: Layout, pose: Pose) -> Array:
    """J (P, K + D, n L) without dimensions."""
    return dense(layout, stacked(layout, pose)) * layout.row_scale[:, None] * layout.column_scale
