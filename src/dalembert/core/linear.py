"""Linear systems of a batch of positions: solved once factored, with A and its transpose; singular ones are flagged.

J   rows (velocities of measures), (..., K, n L);  A = J transposed
r, c scales of rows and columns that make J free of units: angles times the characteristic length
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from dalembert.arrays import Array

SINGULAR = 1e-6
"""Reciprocal condition number (1-norm, scaled) below which a position is singular: a rounding error of the pose, 1e-16
/ rcond, appears in the forces as 1e-16 / rcond**2, so that at worst about four digits remain correct."""


class Factor(Protocol):
    """A factored system J; ``rcond`` (...) is its scaled reciprocal condition number."""

    @property
    def rcond(self) -> Array: ...

    def motion(self, rates: Array) -> Array:
        """Solution v of J v = rates."""
        ...

    def forces(self, wrench: Array) -> Array:
        """Solution x of J^T x = wrench."""
        ...


def apply(matrix: Array, vector: Array) -> Array:
    """Matrix times vector over leading axes."""
    return np.asarray((matrix @ vector[..., None])[..., 0])


@dataclass(frozen=True)
class Inverse:
    """Square systems by their inverses, with one step of refinement: few batched calls for many positions."""

    matrix: Array
    inverse: Array
    row: Array
    column: Array
    rcond: Array

    def motion(self, rates: Array) -> Array:
        rates = rates * self.row
        first = apply(self.inverse, rates)
        first += apply(self.inverse, rates - apply(self.matrix, first))
        return first * self.column

    def forces(self, wrench: Array) -> Array:
        wrench = wrench * self.column
        inverse, matrix = np.swapaxes(self.inverse, -1, -2), np.swapaxes(self.matrix, -1, -2)
        first = apply(inverse, wrench)
        first += apply(inverse, wrench - apply(matrix, first))
        return first * self.row


def inverse(j: Array, row: Array, column: Array) -> Inverse:
    """Factors square systems J (..., m, m). Only the singular ones get NaN and rcond 0.

    A small ``rcond`` is judged again with all rows and columns of one size: an arm that is long beside the
    characteristic length, as of a slider far from where it began, loses no digits.
    """
    matrix = j * row[..., None] * column
    inv = inverses(matrix)
    rcond = _rcond(matrix, inv)
    small = (rcond > 0) & (rcond < SINGULAR)
    if small.any():
        rcond[small] = np.maximum(rcond[small], even_rcond(matrix[small]))
    return Inverse(matrix, inv, row, column, rcond)


def _rcond(matrix: Array, inv: Array) -> Array:
    """Reciprocal condition numbers (...) in the 1-norm; 0 of what has no inverse."""
    with np.errstate(all="ignore"):
        rcond = 1 / (np.abs(matrix).sum(axis=-2).max(axis=-1) * np.abs(inv).sum(axis=-2).max(axis=-1))
    return np.asarray(np.nan_to_num(rcond, nan=0.0))


def even_rcond(matrix: Array, arm: float = SINGULAR) -> Array:
    """Reciprocal condition numbers (...) of scaled matrices (..., m, m) with rows and columns of one size; what is
    below ``arm`` counts as 0."""
    even = np.nan_to_num(matrix)
    even[np.abs(even) < arm] = 0.0
    for axis in (-1, -2, -1):
        size = np.abs(even).max(axis=axis, keepdims=True, initial=0.0)
        even = even / np.where(size > 0, size, 1.0)
    return _rcond(even, inverses(even))


def inverses(matrix: Array) -> Array:
    """Inverses of a batch. numpy raises when one matrix is singular, so the batch is halved until that one is alone."""
    try:
        return np.linalg.inv(matrix)
    except np.linalg.LinAlgError:
        if matrix.ndim == 2:
            return np.full_like(matrix, np.nan)
        if len(matrix) == 1:
            return inverses(matrix[0])[None]
        half = len(matrix) // 2
        return np.concatenate([inverses(matrix[:half]), inverses(matrix[half:])])


def generalized_inverse(matrix: Array, rcond: float = 1e-15) -> Array:
    """Moore-Penrose inverses (..., m, k) of matrices (..., k, m); 0 where a matrix is not finite."""
    finite = np.isfinite(matrix).all(axis=(-2, -1), keepdims=True)
    return np.asarray(np.linalg.pinv(np.where(finite, matrix, 0.0), rcond=rcond))


def solve_square(matrix: Array, right: Array) -> Array:
    """Solution (..., m) of each square system; NaN for a singular one."""
    try:
        return np.asarray(np.linalg.solve(matrix, right[..., None])[..., 0])
    except np.linalg.LinAlgError:
        if len(matrix) == 1:
            return np.full_like(right, np.nan)
        half = len(matrix) // 2
        return np.concatenate(
            [solve_square(matrix[:half], right[:half]), solve_square(matrix[half:], right[half:])]
        )


def least_squares(matrix: Array, right: Array) -> Array:
    """Least-norm least-squares solutions (P, m) of systems (P, K, m) of any rank; 0 where one is not finite.

    By orthogonal factors with pivoting, at a fifth of the cost of singular values.
    """
    from scipy.linalg import lstsq

    out = np.zeros((len(matrix), matrix.shape[-1]))
    for k in np.flatnonzero(np.isfinite(matrix).all(axis=(-2, -1)) & np.isfinite(right).all(axis=-1)):
        out[k] = lstsq(matrix[k], right[k], RANK, lapack_driver="gelsy", check_finite=False)[0]
    return out


@dataclass(frozen=True)
class PseudoInverse:
    """Any shape and rank, by singular values: least-norm forces, least-squares motion.

    ``null`` (..., K, K) projects on multipliers that load nothing: a row of zeros belongs to a unique one.
    """

    pinv: Array
    null: Array
    row: Array
    column: Array
    rcond: Array
    rank: Array

    def motion(self, rates: Array) -> Array:
        return apply(self.pinv, rates * self.row) * self.column

    def forces(self, wrench: Array) -> Array:
        return apply(np.swapaxes(self.pinv, -1, -2), wrench * self.column) * self.row


def compliant(system: PseudoInverse, compliance: Array) -> Compliant:
    """The same system, its free multipliers x chosen so that the sum of compliance x^2 is least.

    ``compliance`` (K,) is 0 where a multiplier belongs to something rigid. Multipliers that this leaves undetermined
    stay least-norm.
    """
    weight = compliance * system.row**2
    largest = weight.max(initial=0.0)
    weight = weight / (largest if largest > 0 else 1.0)
    free = system.null
    energy = free @ (weight[..., :, None] * free)
    inverse = np.linalg.pinv(energy, rcond=1e-10, hermitian=True)
    settled = inverse @ (free * weight)  # the energy's inverse lies within the free multipliers
    values = vars(system) | {"null": free - inverse @ energy}
    return Compliant(**values, settled=settled)


@dataclass(frozen=True)
class Compliant(PseudoInverse):
    """Multipliers by least energy; ``settled`` (..., K, K) projects out the correction to a least-norm solution."""

    settled: Array

    def forces(self, wrench: Array) -> Array:
        least = apply(np.swapaxes(self.pinv, -1, -2), wrench * self.column)
        return (least - apply(self.settled, least)) * self.row


RANK = 1e-9
"""Singular values below this part of the largest count as zero in rank decisions (scaled systems)."""


def pseudo_inverse(j: Array, row: Array, column: Array, tolerance: float = RANK) -> PseudoInverse:
    """Factors systems J (..., K, m) of any rank."""
    matrix = j * row[..., None] * column
    bad = ~np.isfinite(matrix).all(axis=(-2, -1))
    u, s, vt = np.linalg.svd(np.where(bad[..., None, None], 0.0, matrix), full_matrices=False)
    top = s.max(axis=-1, keepdims=True, initial=0.0)
    kept = s > tolerance * np.where(top > 0, top, 1.0)
    with np.errstate(all="ignore"):
        scaled = np.where(kept, 1 / np.where(kept, s, 1.0), 0.0)
        rcond = np.where(kept, s, np.inf).min(axis=-1, initial=np.inf) / top[..., 0]
    range_ = u * kept[..., None, :]
    pinv = np.swapaxes(vt, -1, -2) @ (scaled[..., None] * np.swapaxes(u, -1, -2))
    null = np.eye(j.shape[-2]) - range_ @ np.swapaxes(range_, -1, -2)
    rank = kept.sum(axis=-1)
    full = (rank == j.shape[-1]) & ~bad
    return PseudoInverse(pinv, null, row, column, np.where(full, np.nan_to_num(rcond), 0.0), rank)
