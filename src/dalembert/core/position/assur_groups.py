"""Groups of links that are solved one after another, and the assembly mode of each.

Rows and unknowns of a square J are put in block triangular form (Dulmage and Mendelsohn, 1958): each Assur group, which
closes only as a unit, is a diagonal block. J becomes singular where one block does, so between singular poses no
block's determinant changes sign, while det J, their product, keeps its sign where two of them change theirs.

Mechanics: docs/theory.md 3.1.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array, Ints
from dalembert.core.constraints import dense, stack_rows
from dalembert.core.factor import row_scale
from dalembert.core.layout import ConstraintRows, Layout, Pose
from dalembert.core.linear import Inverse, inverse

NOTHING = 1e-9
"""Part of the largest entry of J below which an entry counts as 0: cosines of right angles, rounded."""

DEPENDENT = 1e-6
"""Part of a row of J that must remain after elimination by earlier rows for it to count as independent."""

LARGEST = 600
"""Unknowns above which J is not examined."""

TOLD_APART = 3
"""Links of the largest group with two assembly modes of opposite signs: two, and one that a drive holds to one of them.
Larger groups have more modes, several of the same sign."""


class DiagonalBlock(NamedTuple):
    """Rows and columns (b,) of a diagonal block of J."""

    row: Ints
    column: Ints


def groups(layout: Layout, pose: Pose) -> list[DiagonalBlock]:
    """Diagonal blocks of J by the entries that differ from 0 at any of the poses (P, L+1, ...) of one branch.

    Where rows repeat each other, those of two choices of independent ones, the first and the last: a sign that changes
    because a choice fails, not the linkage, would have to change in both. None where J is too large, has too few rows
    or is structurally singular, where a group has too many links for its sign to distinguish all its modes, and where a
    choice already fails at one of the poses.
    """
    if layout.stack.count < layout.unknowns or layout.unknowns > LARGEST:
        return []
    j = _scaled_jacobian(layout, pose)
    filled = np.abs(j).max(axis=0) > NOTHING
    every = np.arange(layout.stack.count)
    choices = (
        [every] if layout.square else [independent_rows(j[0], every), independent_rows(j[0], every[::-1])]
    )
    parts: list[DiagonalBlock] = []
    for kept in choices:
        blocks = block_triangular([np.flatnonzero(filled[row]).tolist() for row in kept], layout.unknowns)
        if blocks is None:
            return []
        parts += [DiagonalBlock(kept[rows], np.array(columns, np.intp)) for rows, columns in blocks]
    links = [len(np.unique(group.column // layout.algebra.n)) for group in parts]
    steady = layout.square or bool((np.ptp(senses(layout, parts, pose), axis=0) == 0).all())
    return parts if max(links) <= TOLD_APART and steady else []


@dataclass(frozen=True)
class Chosen:
    """A factored system of some of the rows of J (..., K, n L): Newton steps where the others repeat them."""

    rows: Ints
    inverse: Inverse

    @property
    def rcond(self) -> Array:
        return self.inverse.rcond

    def motion(self, rates: Array) -> Array:
        return self.inverse.motion(rates[..., self.rows])


def on_independent_rows(layout: Layout, pose: Pose) -> Layout:
    """The layout with a solver by the first rows of J that do not depend on those before, at a pose (L+1, ...).

    It takes a fraction of the time of singular values; the gap shows whether the other rows hold too.
    """
    if layout.square:
        return layout
    kept = independent_rows(_scaled_jacobian(layout, pose.at(None))[0], np.arange(layout.stack.count))

    def solver(at: Layout, rows: ConstraintRows) -> Chosen:
        some = rows.rows(kept)
        return Chosen(kept, inverse(dense(at, some), row_scale(at, some.angular), at.column_scale))

    return replace(layout, solver=solver)


def independent_rows(j: Array, order: Ints) -> Ints:
    """Rows of J (K, n L), taken in an order, that do not depend on those before."""
    kept, basis = [], np.zeros((0, j.shape[1]))
    for row in order:
        rest = j[row] - (basis @ j[row]) @ basis
        rest -= (basis @ rest) @ basis
        size = float(np.linalg.norm(rest))
        if size > DEPENDENT * float(np.linalg.norm(j[row])):
            kept.append(int(row))
            basis = np.vstack([basis, rest / size])
    return np.array(kept, np.intp)


def senses(layout: Layout, blocks: list[DiagonalBlock], pose: Pose) -> Array:
    """Signs (P, G) of the groups' determinants; each distinguishes the two sides of a dead centre of its group."""
    j = _scaled_jacobian(layout, pose)
    return np.stack([np.linalg.slogdet(j[:, g.row[:, None], g.column])[0] for g in blocks], axis=1)


def _scaled_jacobian(layout: Layout, pose: Pose) -> Array:
    """J (P, K + D, n L) without dimensions."""
    return dense(layout, stack_rows(layout, pose)) * layout.row_scale[:, None] * layout.column_scale


def block_triangular(rows: list[list[int]], columns: int) -> list[tuple[list[int], list[int]]] | None:
    """Rows and columns of the diagonal blocks of a square pattern, in the order in which they can be solved.

    The pattern lists the columns of each row; None where rows and columns cannot be paired. Rows are paired with
    columns, then depth-first search (Tarjan, 1972) detects the rows that depend on each other.

    >>> block_triangular([[0], [0, 1, 2], [1, 2]], 3)
    [([0], [0]), ([1, 2], [1, 2])]
    """
    matched = match_columns(rows) if len(rows) == columns else [-1]
    if -1 in matched:
        return None
    owner = {column: row for row, column in enumerate(matched)}
    needed = [[owner[column] for column in row] for row in rows]
    return [(block, sorted(matched[row] for row in block)) for block in strong_components(needed)]


def match_columns(rows: list[list[int]]) -> list[int]:
    """Distinct column for each row, by augmenting paths, for as many rows as possible; -1 for the others."""
    match: list[int] = [-1] * len(rows)
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
            match[row], owner[free], free = free, row, match[row]
    return match


def strong_components(needed: list[list[int]]) -> list[list[int]]:
    """Strongly connected components of a graph, each after those that it depends on."""
    order: dict[int, int] = {}
    low: dict[int, int] = {}
    components, stack, done = [], [], set()
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
                components.append(stack[first:])
                done.update(stack[first:])
                del stack[first:]
    return components
