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
    if not layout.square or layout.unknowns > LARGEST:
        return []
    size = np.abs(_scaled(layout, pose)).max(axis=0)
    filled = size > NOTHING * size.max()
    blocks = block_triangular([np.flatnonzero(row).tolist() for row in filled], layout.unknowns)
    if blocks is None:
        return []
    found = [Group(np.array(rows, np.intp), np.array(columns, np.intp)) for rows, columns in blocks]
    links = [len(np.unique(group.column // layout.algebra.n)) for group in found]
    return found if max(links) <= TOLD_APART else []


def senses(layout: Layout, found: list[Group], pose: Pose) -> Array:
    """Signs (P, G) of the groups' determinants: each tells the two sides of a dead centre of its group apart."""
    j = _scaled(layout, pose)
    return np.stack([np.linalg.slogdet(j[:, g.row[:, None], g.column])[0] for g in found], axis=1)


def _scaled(layout: Layout, pose: Pose) -> Array:
    """J (P, K + D, n L) without dimensions."""
    return dense(layout, stacked(layout, pose)) * layout.row_scale[:, None] * layout.column_scale


def block_triangular(rows: list[list[int]], columns: int) -> list[tuple[list[int], list[int]]] | None:
    """Rows and columns of the diagonal blocks of a square pattern, in the order in which they can be solved.

    A pattern is the columns that each row has; None where rows and columns cannot be paired. Rows are paired with
    columns, then those that need each other are found by depth-first search (Tarjan, 1972).

    >>> block_triangular([[0], [0, 1, 2], [1, 2]], 3)
    [([0], [0]), ([1, 2], [1, 2])]
    """
    own = _paired(rows) if len(rows) == columns else None
    if own is None:
        return None
    owner = {column: row for row, column in enumerate(own)}
    needed = [[owner[column] for column in row] for row in rows]
    return [(block, sorted(own[row] for row in block)) for block in _together(needed)]


def _paired(rows: list[list[int]]) -> list[int] | None:
    """A column of its own for each row, by augmenting paths; None where there are not enough."""
    own: list[int] = [-1] * len(rows)
    owner: dict[int, int] = {}
    for start in range(len(rows)):
        came: dict[int, int] = {}
        queue, free = [start], -1
        for row in queue:
            new = [column for column in rows[row] if column not in came]
            came.update(dict.fromkeys(new, row))
            free = next((column for column in new if column not in owner), -1)
            if free >= 0:
                break
            queue += [owner[column] for column in new]
        while free >= 0:
            row = came[free]
            own[row], owner[free], free = free, row, own[row]
        if own[start] < 0:
            return None
    return own


def _together(needed: list[list[int]]) -> list[list[int]]:
    """Strongly connected components of a graph, each behind those that it needs."""
    order: dict[int, int] = {}
    low: dict[int, int] = {}
    found, stack, done = [], [], set()
    for root in range(len(needed)):
        path = [root] if root not in order else []
        while path:
            node = path[-1]
            if node not in order:
                order[node] = low[node] = len(order)
                stack.append(node)
            new = next((other for other in needed[node] if other not in order), None)
            if new is not None:
                path.append(new)
                continue
            path.pop()
            low[node] = min([order[node], *(low[other] for other in needed[node] if other not in done)])
            if low[node] == order[node]:
                first = stack.index(node)
                found.append(stack[first:])
                done.update(stack[first:])
                del stack[first:]
    return found
