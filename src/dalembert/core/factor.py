"""Which solver a mechanism's matrix gets: batched inverse, singular values, or sparse LU a position."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.arrays import Array, Flags
from dalembert.core.constraints import dense
from dalembert.core.layout import Layout, System
from dalembert.core.linear import Factor, inverse, pseudo_inverse, solve_square

if TYPE_CHECKING:
    from scipy.sparse import csc_array

SPARSE = 120
"""Unknowns above which sparse elimination beats a batched dense inverse."""


def row_scale(layout: Layout, angular: Flags) -> Array:
    """Scale of some rows' measures: angles times the characteristic length."""
    return np.where(angular, layout.length, 1.0)


def factor(layout: Layout, rows: System) -> Factor:
    """Factor J of some rows with the solver that suits it."""
    if layout.solver is not None:
        found: Factor = layout.solver(layout, rows)
        return found
    row, column = row_scale(layout, rows.angular), layout.column_scale
    if layout.redundant or len(row) != layout.unknowns:
        return pseudo_inverse(dense(layout, rows), row, column)
    if layout.unknowns > SPARSE:
        return sparse(layout, rows, row, column)
    return inverse(dense(layout, rows), row, column)


def displacement(layout: Layout, rows: System, scaled_gap: Array) -> Array:
    """One solution of J dq = gap (gap scaled), without keeping factors: a Newton step. 0 where J is singular."""
    square = len(rows.i) == layout.unknowns and not layout.redundant
    if square and layout.unknowns <= SPARSE:
        j = dense(layout, rows)
        j *= row_scale(layout, rows.angular)[:, None]
        dq = solve_square(j, scaled_gap)
    else:
        dq = factor(layout, rows).motion(scaled_gap / row_scale(layout, rows.angular))
    bad = ~np.isfinite(dq)
    if bad.any():
        dq[bad] = 0.0
    return dq


def displacements(layout: Layout, rows: System, scaled_gaps: Array) -> tuple[Array, Array | None]:
    """Solutions (R, n L) of J dq = gap for several gaps (R, K), scaled, at a single pose (1, ...): one elimination.

    Also J itself (K, n L), its rows scaled; None where it is too large to be handled dense.
    """
    scale, j = row_scale(layout, rows.angular), None
    if layout.unknowns <= SPARSE:
        j = dense(layout, rows)[0] * scale[:, None]
    if j is not None and layout.square:
        try:
            dq = np.linalg.solve(j, scaled_gaps.T).T
        except np.linalg.LinAlgError:
            dq = np.zeros((len(scaled_gaps), layout.unknowns))
    else:
        dq = factor(layout, rows).motion(scaled_gaps / scale)
    return np.asarray(np.where(np.isfinite(dq), dq, 0.0)), j


@dataclass(frozen=True)
class Sparse:
    """Square systems by sparse LU, one a position; cost grows with the number of links."""

    solvers: tuple[Any, ...]
    matrices: tuple[csc_array, ...]
    lead: tuple[int, ...]
    row: Array
    column: Array
    rcond: Array

    def motion(self, rates: Array) -> Array:
        return self._each(rates * self.row, "N", lambda m: m) * self.column

    def forces(self, wrench: Array) -> Array:
        return self._each(wrench * self.column, "T", lambda m: m.T) * self.row

    def _each(self, right: Array, trans: str, side: Callable[[csc_array], Any]) -> Array:
        size = right.shape[-1]
        lead = np.broadcast_shapes(self.lead, right.shape[:-1])
        which = np.broadcast_to(np.arange(len(self.solvers)).reshape(self.lead), lead).ravel()
        flat = np.broadcast_to(right, (*lead, size)).reshape(-1, size)
        out = np.full(flat.shape, np.nan)
        for k, p in enumerate(which):
            lu = self.solvers[p]
            if lu is not None:
                x = lu.solve(flat[k], trans)
                out[k] = x + lu.solve(flat[k] - side(self.matrices[p]) @ x, trans)
        return out.reshape((*lead, size))


def sparse(layout: Layout, rows: System, row: Array, column: Array) -> Sparse:
    """Sparse LU of square systems J, position by position."""
    lead = rows.on_j.shape[:-2]
    solvers, matrices, rcond = [], [], []
    for p in np.ndindex(*lead):
        matrix = _sparse_matrix(layout, rows._replace(on_i=rows.on_i[p], on_j=rows.on_j[p]), row, column)
        lu, reciprocal = _lu(matrix)
        solvers.append(lu)
        matrices.append(matrix)
        rcond.append(reciprocal)
    return Sparse(tuple(solvers), tuple(matrices), lead, row, column, np.array(rcond).reshape(lead))


def _sparse_matrix(layout: Layout, rows: System, row: Array, column: Array) -> csc_array:
    """Scaled J (K, n L) in compressed columns; ground's columns left out."""
    from scipy.sparse import csc_array

    n, count = layout.algebra.n, len(rows.i)
    links = np.concatenate([rows.i, rows.j])
    moving = links < layout.links
    k = np.repeat(np.tile(np.arange(count), 2)[moving], n)
    columns = (links[moving][:, None] * n + np.arange(n)).ravel()
    data = np.concatenate([rows.on_i, rows.on_j])[moving].ravel() * row[k] * column[columns]
    matrix = csc_array((data, (k, columns)), shape=(count, layout.unknowns))
    matrix.eliminate_zeros()
    return matrix


def _lu(matrix: csc_array) -> tuple[Any, float]:
    """Factors and estimated reciprocal condition number; None and 0 where exactly singular."""
    from scipy.sparse.linalg import LinearOperator, onenormest, splu

    try:
        lu = splu(matrix)
    except RuntimeError:
        return None, 0.0
    solve: Any = lu.solve
    operator: Any = LinearOperator(
        matrix.shape, matvec=solve, rmatvec=lambda v: solve(v, "T"), matmat=solve, dtype=np.float64
    )
    norm = float(abs(matrix).sum(axis=0).max())
    with np.errstate(all="ignore"):
        return lu, float(np.nan_to_num(1 / (norm * onenormest(operator, t=1))))
