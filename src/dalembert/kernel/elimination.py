"""Elimination of traced systems by structure: A and its transpose from one set of factors.

Pivots are the entries that are exactly 1 or -1 first (the force balances: no growth, no division), least fill first.
The remainder splits into blocks; each two-link group is a 2 x 2 block whose determinant is the sine of its transmission
angle. Larger blocks are eliminated entry by entry, with pivots chosen at sampled values. Where rows are dependent, the
part with more rows than columns is a least-squares block that keeps all its rows, so it is singular only where the
mechanism is.

Mechanics: docs/theory.md 8.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from heapq import heapify, heappop, heappush

import numpy as np

from dalembert.arrays import Array
from dalembert.core.position.assur_groups import block_triangular, match_columns, strong_components
from dalembert.kernel.graph import Graph, Node, Scalar, is_zero, unit_value

Row = dict[int, Scalar]
Matrix = list[list[Scalar]]


@dataclass
class PivotBlock:
    """Pivot block: rows, columns, its inverse, and the blocks to its right and below it."""

    rows: tuple[int, ...]
    columns: tuple[int, ...]
    inverse: Matrix | LeastSquares
    right: list[Row]
    below: list[tuple[int, list[Scalar]]]

    def motion(self, right: list[Scalar]) -> list[Scalar]:
        """The inverse times a column of its rows."""
        return _times(self.inverse, right) if isinstance(self.inverse, list) else self.inverse.motion(right)

    def forces(self, right: list[Scalar]) -> list[Scalar]:
        """The transposed inverse times a column of its columns."""
        if isinstance(self.inverse, list):
            return _times(_transpose(self.inverse), right)
        return self.inverse.forces(right)


@dataclass
class LeastSquares:
    """A block S of more rows than columns, by its normal equations S^T W S, with weights W of the rows.

    Motions agree with all rows; forces are those of least norm, one of many.
    """

    rows: list[Row]
    weights: list[float]
    factors: Structural

    def motion(self, right: list[Scalar]) -> list[Scalar]:
        """Solution of S v = right, with one step of refinement."""
        first = self._fit(right)
        left = [
            b - _dot(row.values(), [first[c] for c in row]) for row, b in zip(self.rows, right, strict=True)
        ]
        return [x + y for x, y in zip(first, self._fit(left), strict=True)]

    def _fit(self, right: list[Scalar]) -> list[Scalar]:
        sums: list[Scalar] = [0.0] * self.factors.size
        for row, weight, b in zip(self.rows, self.weights, right, strict=True):
            for c, x in row.items():
                sums[c] = sums[c] + weight * x * b
        return list(self.factors.motion(np.array(sums, object)))

    def forces(self, right: list[Scalar]) -> list[Scalar]:
        """Solution of S^T x = right."""
        y = self.factors.forces(np.array(right, object))
        return [
            weight * _dot(row.values(), [y[c] for c in row])
            for row, weight in zip(self.rows, self.weights, strict=True)
        ]


@dataclass
class Structural:
    """Factors of a traced system J (K, m): the ``Factor`` of the core, for traced values.

    ``pivots``: determinants of the pivot blocks that are not +-1; one near zero makes the system singular.
    """

    size: int
    count: int
    steps: list[PivotBlock]
    pivots: list[Scalar] = field(default_factory=list)

    @property
    def rcond(self) -> Array:
        return np.array(1.0)

    def motion(self, rates: Array) -> Array:
        """Solution of J v = rates."""
        b, v = list(rates), np.full(self.size, 0.0, object)
        kept = []
        for step in self.steps:
            t = step.motion([b[r] for r in step.rows])
            kept.append(t)
            for i, factors in step.below:
                b[i] = _minus(b[i], factors, t)
        for step, t in zip(reversed(self.steps), reversed(kept), strict=True):
            if any(step.right):
                sums = [_dot(row.values(), [v[c] for c in row]) for row in step.right]
                t = [x - y for x, y in zip(t, step.motion(sums), strict=True)]
            for c, x in zip(step.columns, t, strict=True):
                v[c] = x
        return v

    def forces(self, wrench: Array) -> Array:
        """Solution of J^T x = wrench."""
        c, x = list(wrench), np.full(self.count, 0.0, object)
        kept = []
        for step in self.steps:
            y = step.forces([c[k] for k in step.columns])
            kept.append(y)
            for row, factor in zip(step.right, y, strict=True):
                for k, u in row.items():
                    c[k] = c[k] - u * factor
        for step, y in zip(reversed(self.steps), reversed(kept), strict=True):
            if step.below:
                sums = [
                    _dot([factors[k] for _, factors in step.below], [x[i] for i, _ in step.below])
                    for k in range(len(step.columns))
                ]
                y = [p - q for p, q in zip(y, step.forces(sums), strict=True)]
            for r, value in zip(step.rows, y, strict=True):
                x[r] = value
        return x


def _dot(a: Iterable[Scalar], b: Iterable[Scalar]) -> Scalar:
    total: Scalar = 0.0
    for x, y in zip(a, b, strict=True):
        if not (is_zero(x) or is_zero(y)):
            total = x * y + total
    return total


def _minus(start: Scalar, a: list[Scalar], b: list[Scalar]) -> Scalar:
    for x, y in zip(a, b, strict=True):
        if not (is_zero(x) or is_zero(y)):
            start = start - x * y
    return start


def _times(matrix: Matrix, vector: list[Scalar]) -> list[Scalar]:
    return [_dot(row, vector) for row in matrix]


def _transpose(matrix: Matrix) -> Matrix:
    return [list(column) for column in zip(*matrix, strict=True)]


def structural(graph: Graph, rows: list[Row], size: int, scale: Array | None = None) -> Structural:
    """Factors a system given by its rows {column: entry}, some of which may repeat others if ``scale`` (K,) makes them
    comparable; raises ValueError where its structure is singular."""
    if len(rows) != size and (scale is None or len(rows) < size):
        raise ValueError(f"{len(rows)} equations for {size} unknowns")
    work = _Elimination(graph, [{c: x for c, x in row.items() if not is_zero(x)} for row in rows])
    work.unit_pivots()
    if scale is not None and len(rows) > size:
        work.repeated_rows(scale)
    work.block_pivots()
    if sum(len(step.columns) for step in work.steps) != size:
        raise ValueError("structurally singular")
    return Structural(size, len(rows), work.steps, work.pivots)


class _Elimination:
    """The part not yet eliminated, and the steps taken."""

    def __init__(self, graph: Graph, rows: list[Row]) -> None:
        self.graph, self.rows = graph, dict(enumerate(rows))
        self.columns: dict[int, set[int]] = {}
        for r, row in self.rows.items():
            for c in row:
                self.columns.setdefault(c, set()).add(r)
        self.steps: list[PivotBlock] = []
        self.pivots: list[Scalar] = []

    def unit_pivots(self) -> None:
        best = {r: self.unit_pivot(r) for r in self.rows}
        least = [(pivot[0], r) for r, pivot in best.items() if pivot is not None]
        heapify(least)
        while least:
            fill, r = heappop(least)
            pivot = best[r] if r in self.rows else None
            if pivot is None or pivot[0] != fill:  # outdated: another row was removed since
                continue
            _, c, sign = pivot
            near = set().union(*(self.columns[other] for other in self.rows[r])) - {r}
            self.eliminate((r,), (c,), [[sign]])
            for i in near:
                new = best[i] = self.unit_pivot(i)
                if new is not None:
                    heappush(least, (new[0], i))

    def unit_pivot(self, r: int) -> tuple[int, int, float] | None:
        """Fill, column and value of the entry of a row that is exactly 1 or -1 and fills least."""
        row, best = self.rows[r], None
        for c, x in row.items():
            sign = unit_value(x)
            if sign:
                fill = (len(row) - 1) * (len(self.columns[c]) - 1)
                if best is None or fill < best[0]:
                    best = (fill, c, sign)
        return best

    def repeated_rows(self, scale: Array) -> None:
        """Removes the part that has more rows than columns (Dulmage and Mendelsohn, 1958), and empty rows."""
        self.rows = {r: row for r, row in self.rows.items() if row}
        match = maximum_matching({r: set(row) for r, row in self.rows.items()})
        owner = {c: r for r, c in match.items()}
        surplus = [r for r in self.rows if r not in match]
        for r in surplus:
            surplus += [owner[c] for c in self.rows[r] if owner[c] not in surplus]
        if not surplus:
            return
        columns = sorted({c for r in surplus for c in self.rows[r]})
        place = {c: k for k, c in enumerate(columns)}
        block = [{place[c]: x for c, x in self.rows[r].items()} for r in surplus]
        weights = [float(scale[r]) ** 2 for r in surplus]
        normal: list[Row] = [{} for _ in columns]
        for row, weight in zip(block, weights, strict=True):
            for a, x in row.items():
                for b, y in row.items():
                    normal[a][b] = normal[a].get(b, 0.0) + weight * (x * y)
        inner = _Elimination(self.graph, normal)
        inner.diagonal_pivots()
        self.pivots += inner.pivots
        factors = Structural(len(columns), len(columns), inner.steps)
        self.eliminate(tuple(surplus), tuple(columns), LeastSquares(block, weights, factors))

    def diagonal_pivots(self) -> None:
        """Diagonal pivots of a positive definite system, least fill first."""
        while self.rows:
            r = min(self.rows, key=lambda row: len(self.rows[row]))
            self.block([r], [r])

    def eliminate(
        self, rows: tuple[int, ...], columns: tuple[int, ...], inverse: Matrix | LeastSquares
    ) -> None:
        """Eliminates a pivot block: the remainder is its Schur complement."""
        taken = [self.rows.pop(r) for r in rows]
        right = [{c: x for c, x in row.items() if c not in columns} for row in taken]
        for r, row in zip(rows, taken, strict=True):
            for c in row:
                self.columns[c].discard(r)
        touched = sorted(set().union(*(self.columns.pop(c) for c in columns)))
        step = PivotBlock(rows, columns, inverse, right, [])
        for i in touched:
            row = self.rows[i]
            factors = [row.pop(c, 0.0) for c in columns]
            step.below.append((i, factors))
            for u, factor in zip(right, step.forces(factors), strict=True) if any(right) else ():
                if not is_zero(factor):
                    self.subtract(i, row, u, factor)
        self.steps.append(step)

    def subtract(self, i: int, row: Row, u: Row, factor: Scalar) -> None:
        for c, x in u.items():
            new = row.get(c, 0.0) - x * factor
            if is_zero(new):
                if row.pop(c, None) is not None:
                    self.columns[c].discard(i)
            else:
                row[c] = new
                self.columns[c].add(i)

    def block_pivots(self) -> None:
        for rows, columns in _blocks(self.rows):
            self.block(rows, columns)

    def block(self, rows: list[int], columns: list[int]) -> None:
        if len(rows) == 1:
            pivot = self.rows[rows[0]][columns[0]]
            self.pivots.append(pivot)
            self.eliminate((rows[0],), (columns[0],), [[1.0 / pivot]])
        elif len(rows) == 2:
            entries = [[self.rows[r].get(c, self.graph.zero) for c in columns] for r in rows]
            det, inverse = _inverse2(entries)
            self.pivots.append(det)
            self.eliminate((rows[0], rows[1]), (columns[0], columns[1]), inverse)
        else:
            self.large(rows, columns)

    def large(self, rows: list[int], columns: list[int]) -> None:
        """One scalar pivot after another: among those sampled large enough everywhere, the one with least fill."""
        left_rows, left_columns = set(rows), set(columns)
        while left_rows:
            if len(left_rows) == 2:
                self.block(sorted(left_rows), sorted(left_columns))
                return
            r, c = self.choice(left_rows, left_columns)
            pivot = self.rows[r][c]
            self.pivots.append(pivot)
            self.eliminate((r,), (c,), [[1.0 / pivot]])
            left_rows.discard(r)
            left_columns.discard(c)

    def choice(self, rows: set[int], columns: set[int]) -> tuple[int, int]:
        places = [(r, c) for r in sorted(rows) for c in self.rows[r] if c in columns]
        entries = [self.rows[r][c] for r, c in places]
        nodes = [x if type(x) is Node else self.graph.constant(x) for x in entries]
        sampled = np.broadcast_arrays(*self.graph.evaluate(nodes, {}))
        largest = {
            r: np.max([np.abs(s) for (q, _), s in zip(places, sampled, strict=True) if q == r], axis=0)
            for r in rows
        }
        best = None
        for (r, c), s in zip(places, sampled, strict=True):
            share = float(np.nanquantile(np.abs(s) / np.where(largest[r] > 0, largest[r], 1.0), 0.02))
            fill = (len(self.rows[r]) - 1) * (len(self.columns[c]) - 1)
            rank = (share < 0.05, fill if share >= 0.05 else 0, -share)
            if best is None or rank < best[0]:
                best = (rank, r, c)
        if best is None:
            raise ValueError("structurally singular")
        return best[1], best[2]


def _inverse2(m: Matrix) -> tuple[Scalar, Matrix]:
    (a, b), (c, d) = m
    det = a * d - b * c
    over = 1.0 / det
    return det, [[d * over, -(b * over)], [-(c * over), a * over]]


def _blocks(rows: dict[int, Row]) -> list[tuple[list[int], list[int]]]:
    """Block lower triangular form: rows and columns of each block, in the order in which they can be solved."""
    if not rows:
        return []
    names, columns = sorted(rows), sorted({c for row in rows.values() for c in row})
    if len(names) != len(columns):
        raise ValueError("structurally singular")
    place = {c: k for k, c in enumerate(columns)}
    blocks = block_triangular([[place[c] for c in rows[r]] for r in names], len(columns))
    if blocks is None:
        raise ValueError("structurally singular")
    return [(sorted(names[r] for r in group), [columns[c] for c in members]) for group, members in blocks]


def maximum_matching(wants: dict[int, set[int]]) -> dict[int, int]:
    """A largest matching of rows to columns."""
    match = match_columns([sorted(columns) for columns in wants.values()])
    return {r: c for r, c in zip(wants, match, strict=True) if c >= 0}


def components(graph: dict[int, set[int]]) -> list[list[int]]:
    """Strongly connected components, those that depend on nothing else first."""
    names = list(graph)
    place = {name: k for k, name in enumerate(names)}
    parts = strong_components([[place[other] for other in sorted(graph[name])] for name in names])
    return [[names[k] for k in part] for part in parts]
