"""Banded matrices of long chains: joined links are numbered close to each other (Cuthill and McKee, 1969).

If the bands are narrow, LAPACK eliminates them several times as fast as sparse elimination does.

Mechanics: docs/theory.md 1.2.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.core.layout import ConstraintRows

if TYPE_CHECKING:
    from scipy.sparse import csc_array

WIDEST = 20
"""Largest width of the bands at which they beat sparse elimination."""


class Bands(NamedTuple):
    """Positions of the rows' entries in a banded matrix.

    entry (K, 2 n): unknowns that a row's entries on i and on j belong to, in the order of the bands, ground's last;
    unknown (n L,) and row (K,): their indices in that order; below, above: numbers of subdiagonals and superdiagonals.
    For J^T J: width, the number of its lower bands; low (K, 2 n, 2 n), the products of a row's entries that belong to
    them, and place, their positions.
    """

    entry: Ints
    unknown: Ints
    row: Ints
    below: int
    above: int
    width: int
    low: Flags
    place: Ints

    def least_squares(
        self, rows: ConstraintRows, scale: Array, column: Array, right: Array, damping: float
    ) -> Array:
        """Solution of (J^T J + damping) x = J^T right at a single position (1, ...), times the columns' scale; NaN
        where rounding makes it singular."""
        from scipy.linalg.lapack import dpbsv

        size = len(column)
        along = np.zeros(size + rows.on_i.shape[-1])
        along[self.unknown] = column
        j = np.concatenate([rows.on_i[0], rows.on_j[0]], axis=1) * scale[:, None] * along[self.entry]
        products = (j[:, :, None] * j[:, None, :])[self.low]
        normal = np.bincount(self.place, products, (self.width + 1) * size).reshape(-1, size)
        normal[0] += damping
        wanted = np.bincount(self.entry.ravel(), (j * right[:, None]).ravel(), len(along))[:size]
        _, solution, failed = dpbsv(normal, wanted, lower=True)
        return np.asarray(np.where(failed, np.nan, solution)[self.unknown] * column)


class BandedLU:
    """A factored square matrix, with the ``solve`` of scipy's SuperLU; LinAlgError where it is exactly singular."""

    def __init__(self, bands: Bands, matrix: csc_array) -> None:
        from scipy.linalg.lapack import dgbtrf

        self.bands, above = bands, bands.below + bands.above
        column = np.repeat(bands.unknown, np.diff(matrix.indptr))
        stored = np.zeros((len(bands.unknown), bands.below + above + 1))
        stored[column, above + bands.row[matrix.indices] - column] = matrix.data
        self.factors, self.pivots, info = dgbtrf(stored.T, bands.below, bands.above, overwrite_ab=True)
        if info:
            raise np.linalg.LinAlgError

    def solve(self, right: Array, trans: Literal["N", "T"] = "N") -> Array:
        """Solution of J x = right (K,) or (K, R), or of J^T x = right."""
        from scipy.linalg.lapack import dgbtrs

        b = self.bands
        before, after = (b.row, b.unknown) if trans == "N" else (b.unknown, b.row)
        ordered = np.empty_like(right)
        ordered[before] = right
        return np.asarray(
            dgbtrs(self.factors, b.below, b.above, ordered, self.pivots, trans == "T")[0][after]
        )


def bands_of(rows: ConstraintRows, links: int, n: int) -> Bands | None:
    """The bands of some rows; None where they are wide."""
    return _bands(rows.i.tobytes(), rows.j.tobytes(), links, n)


@lru_cache(maxsize=4)
def _bands(i: bytes, j: bytes, links: int, n: int) -> Bands | None:
    """Bands from the links i and j (bytes of indices) of the rows."""
    ends = np.stack([np.frombuffer(i, np.intp), np.frombuffer(j, np.intp)], axis=1)
    head, size = _link_order(ends, links), links * n
    entry = (head[ends][..., None] * n + np.arange(n)).reshape(len(ends), 2 * n)
    moving = entry < size
    row = np.empty(len(ends), np.intp)
    row[np.lexsort((entry.min(axis=1), np.where(moving, entry, -1).max(axis=1)))] = np.arange(len(ends))
    off = (row[:, None] - entry)[moving]
    one, other = np.broadcast_arrays(entry[:, :, None], entry[:, None, :])
    low = (one >= other) & (one < size)
    away = one[low] - other[low]
    below, above, width = (int(far.max(initial=0)) for far in (off, -off, away))
    if max(below, above, width) > WIDEST:
        return None
    unknown = (head[:links, None] * n + np.arange(n)).ravel()
    return Bands(entry, unknown, row, below, above, width, low, away * size + other[low])


def _link_order(ends: Ints, links: int) -> Ints:
    """Indices (L+1,) of the links in an order that keeps neighbours close; ground is last."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import reverse_cuthill_mckee

    i, j = ends[(ends < links).all(axis=1)].T
    graph = coo_array((np.ones(2 * len(i)), (np.append(i, j), np.append(j, i))), (links, links)).tocsr()
    return np.append(np.argsort(reverse_cuthill_mckee(graph, symmetric_mode=True)), links)
