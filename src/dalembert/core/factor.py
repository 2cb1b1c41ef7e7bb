"""Choice of solver for a mechanism's matrix: batched inverse, singular values, or banded or sparse LU per position.

Mechanics: docs/theory.md 1.2.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.core.bands import BandedLU, Bands, bands_of
from dalembert.core.constraints import dense
from dalembert.core.layout import ConstraintRows, Layout
from dalembert.core.linear import Factor, inverse, least_squares, pseudo_inverse, solve_square

if TYPE_CHECKING:
    from scipy.sparse import csc_array

SPARSE = 120
"""Unknowns above which sparse elimination beats a batched dense inverse."""


def row_scale(layout: Layout, angular: Flags) -> Array:
    """Scale of some rows' measures: angles times the characteristic length."""
    return np.where(angular, layout.length, 1.0)


def factor(layout: Layout, rows: ConstraintRows) -> Factor:
    """Factors J of some rows with the solver that suits it."""
    if layout.solver is not None:
        result: Factor = layout.solver(layout, rows)
        return result
    row, column = row_scale(layout, rows.angular), layout.column_scale
    if layout.redundant or len(row) != layout.unknowns:
        return pseudo_inverse(dense(layout, rows), row, column)
    if layout.unknowns > SPARSE:
        return sparse(layout, rows, row, column)
    return inverse(dense(layout, rows), row, column)


def displacement(layout: Layout, rows: ConstraintRows, scaled_gap: Array) -> Array:
    """One solution of J dq = gap (gap scaled), without keeping factors: a Newton step. 0 where J is singular."""
    if _is_square(layout, rows) and layout.unknowns <= SPARSE:
        j = dense(layout, rows)
        j *= row_scale(layout, rows.angular)[:, None]
        dq = solve_square(j, scaled_gap)
    elif not _is_square(layout, rows) and layout.solver is None:
        dq = _least_squares(layout, rows, scaled_gap)
    else:
        dq = _unconditioned(layout, rows, scaled_gap)
    bad = ~np.isfinite(dq)
    if bad.any():
        dq[bad] = 0.0
    return dq


def _least_squares(layout: Layout, rows: ConstraintRows, scaled_gap: Array) -> Array:
    """Least-norm least squares of J dq = gap (gap scaled), for J of any shape and rank."""
    column = layout.column_scale
    j = dense(layout, rows)
    j *= row_scale(layout, rows.angular)[:, None] * column
    return least_squares(j, scaled_gap) * column


def _is_square(layout: Layout, rows: ConstraintRows) -> bool:
    return len(rows.i) == layout.unknowns and not layout.redundant


def _unconditioned(layout: Layout, rows: ConstraintRows, scaled_gap: Array) -> Array:
    """Solutions of J dq = gap (gap scaled), the condition of large systems not estimated."""
    scale, unsplit = row_scale(layout, rows.angular), _is_square(layout, rows) and layout.unknowns > SPARSE
    solver = sparse(layout, rows, scale, layout.column_scale, False) if unsplit else factor(layout, rows)
    return solver.motion(scaled_gap / scale)


def displacements(layout: Layout, rows: ConstraintRows, scaled_gaps: Array) -> tuple[Array, Array | None]:
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
        dq = _unconditioned(layout, rows, scaled_gaps)
    return np.asarray(np.where(np.isfinite(dq), dq, 0.0)), j


def damped_step(
    layout: Layout, rows: ConstraintRows, weight: Array, scaled_gap: Array, damping: float
) -> Array:
    """Least squares of J dq = gap (gap scaled, rows weighted) with a damping, at a single pose (1, ...)."""
    scale, column = row_scale(layout, rows.angular) * weight, layout.column_scale
    right = scaled_gap * weight
    if layout.unknowns <= SPARSE:
        j = dense(layout, rows)[0] * scale[:, None] * column
        square, right = j.T @ j + damping * np.eye(j.shape[1]), j.T @ right
        try:
            return np.linalg.solve(square, right) * column
        except np.linalg.LinAlgError:  # the damping is below the rounding error
            return np.asarray(np.linalg.lstsq(square, right)[0] * column)
    bands = bands_of(rows, layout.links, layout.algebra.n)
    if bands is not None:
        return bands.least_squares(rows, scale, column, right, damping)
    from scipy.sparse import eye_array
    from scipy.sparse.linalg import spsolve

    (matrix,) = _sparse_matrices(layout, rows, scale, column)
    normal = (matrix.T @ matrix + damping * eye_array(layout.unknowns)).tocsc()
    return np.asarray(spsolve(normal, matrix.T @ right) * column)


@dataclass(frozen=True)
class Sparse:
    """Square systems by banded or sparse LU, one per position; cost grows with the number of links."""

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


def sparse(layout: Layout, rows: ConstraintRows, row: Array, column: Array, condition: bool = True) -> Sparse:
    """Sparse LU of square systems J, position by position; without ``condition`` its number is not estimated."""
    matrices, bands = (
        _sparse_matrices(layout, rows, row, column),
        bands_of(rows, layout.links, layout.algebra.n),
    )
    factored = [_lu(matrix, bands, condition) for matrix in matrices]
    lead = rows.on_j.shape[:-2]
    solvers, rcond = tuple(lu for lu, _ in factored), np.array([reciprocal for _, reciprocal in factored])
    return Sparse(solvers, matrices, lead, row, column, rcond.reshape(lead))


def _sparse_matrices(
    layout: Layout, rows: ConstraintRows, row: Array, column: Array
) -> tuple[csc_array, ...]:
    """Scaled J (K, n L) of each position in compressed columns; ground's columns left out."""
    from scipy.sparse import csc_array

    row_of, columns, order = _columns(rows.i.tobytes(), rows.j.tobytes(), layout.links, layout.algebra.n)
    both = np.concatenate([rows.on_i, rows.on_j], axis=-2)
    data = both.reshape(-1, both.shape[-2] * both.shape[-1])[:, order] * (row[row_of] * column[columns])
    some = (data != 0).any(axis=0)
    ends = np.searchsorted(columns[some], np.arange(layout.unknowns + 1)).astype(np.intc)
    kept, shape = row_of[some], (len(rows.i), layout.unknowns)
    values = np.ascontiguousarray(data[:, some])  # row by row, as SuperLU takes them
    return tuple(csc_array((x, kept, ends), shape=shape) for x in values)


@lru_cache(maxsize=4)
def _columns(i: bytes, j: bytes, links: int, n: int) -> tuple[Ints, Ints, Ints]:
    """Entries of J by columns, without ground's: their rows, their columns, and their indices among the entries of all
    links i (bytes of indices) followed by those of all links j."""
    both = np.frombuffer(i + j, np.intp)
    row: Ints = np.repeat(np.tile(np.arange(len(both) // 2, dtype=np.intc), 2), n)
    column: Ints = (both[:, None] * n + np.arange(n)).ravel()
    order = np.lexsort((row, column))
    order = order[column[order] < links * n]
    return row[order], column[order], order


def _lu(matrix: csc_array, bands: Bands | None, condition: bool) -> tuple[Any, float]:
    """Factors and estimated reciprocal condition number; None and 0 where exactly singular."""
    from scipy.sparse.linalg import LinearOperator, onenormest, splu

    try:
        lu = splu(matrix) if bands is None else BandedLU(bands, matrix)
    except (RuntimeError, np.linalg.LinAlgError):
        return None, 0.0
    if not condition:
        return lu, 1.0
    solve: Any = lu.solve
    operator: Any = LinearOperator(
        matrix.shape, matvec=solve, rmatvec=lambda v: solve(v, "T"), matmat=solve, dtype=np.float64
    )
    norm = float(abs(matrix).sum(axis=0).max())
    with np.errstate(all="ignore"):
        return lu, float(np.nan_to_num(1 / (norm * onenormest(operator, t=1))))
