"""Critical compression of a straight column of one or more spans, by how its nodes may move (Ritz, polynomials).

int EI y''^2 ds = P int y'^2 ds over all deflections y that the nodes allow; the force keeps its direction.

Mechanics: docs/theory.md 10.4.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache

import numpy as np
from scipy.linalg import eigh

from dalembert.arrays import Array

BUBBLES = 11
"""Polynomials of each span beside its four of the ends: critical loads to 1e-11 up to two half-waves a span."""
LOOSE = 1e-9
"""Motions that bend nothing are those within this part of a rigid one."""


@cache
def _span_forms() -> tuple[Array, Array]:
    """int f''g'' and int f'g' on the unit span, of y and y' at both ends and of polynomials that vanish at both."""
    x, weight = np.polynomial.legendre.leggauss(BUBBLES + 5)
    x, weight = (x + 1) / 2, weight / 2
    s = np.polynomial.Polynomial([0.0, 1.0])
    flat = s**2 * (1 - s) ** 2
    forms = [1 - 3 * s**2 + 2 * s**3, s * (1 - s) ** 2, 3 * s**2 - 2 * s**3, s**3 - s**2]
    legendre = [np.polynomial.Legendre.basis(k, domain=[0, 1]) for k in range(BUBBLES)]
    forms += [flat * b.convert(kind=np.polynomial.Polynomial, domain=[-1, 1]) for b in legendre]
    slope, bend = (np.array([f.deriv(n)(x) for f in forms]) for n in (1, 2))
    return (bend * weight) @ bend.T, (slope * weight) @ slope.T


def critical_load(
    lengths: Sequence[float], stiffness: Array | Sequence[Sequence[float]], free: Array
) -> float:
    """Least critical compression, N, of spans with lengths, m, and EI (planes, spans), N m2, between nodes.

    ``free`` (planes * 2 (n + 1), k): columns that span the motions of the nodes, y and y' of each in turn in one plane,
    then in the next. 0 where some of them bend nothing: the column is loose.

    >>> clamped = np.array([[0.0, 0], [0, 0], [1, 0], [0, 1]])          # the far end moves and turns
    >>> round(critical_load([2.0], [[3.0]], clamped) / (math.pi**2 * 3 / (2 * 2.0) ** 2), 10)
    1.0
    """
    each, total = np.asarray(stiffness, float), float(sum(lengths))
    spans = [x / total for x in lengths]
    planes, nodes = len(each), 2 * (len(spans) + 1)
    scale = np.tile([1 / total, 1.0], planes * nodes // 2)
    motion = column_space(np.asarray(free, float).reshape(len(scale), -1) * scale[:, None])
    if is_loose(motion, spans):
        return 0.0
    inner = planes * BUBBLES * len(spans)
    basis = np.zeros((len(scale) + inner, motion.shape[1] + inner))
    basis[: len(scale), : motion.shape[1]] = motion
    basis[len(scale) :, motion.shape[1] :] = np.eye(inner)
    bending, sway = (basis.T @ m @ basis for m in _assembled(spans, each / each.max()))
    flat = 1 / np.sqrt(np.diag(bending))
    bending, sway = (m * np.outer(flat, flat) for m in (bending, sway))
    largest = eigh(sway, bending, eigvals_only=True, subset_by_index=[len(sway) - 1] * 2)[0]
    return float(each.max() / total**2 / largest)


def _assembled(spans: Sequence[float], stiffness: Array) -> tuple[Array, Array]:
    """int EI y''^2 and int y'^2 of all planes: variables of the nodes first, plane by plane, then the polynomials."""
    planes, count = stiffness.shape
    nodes = planes * 2 * (count + 1)
    bending, sway = np.zeros((2, *(2 * [nodes + planes * BUBBLES * count])))
    unit_bend, unit_slope = _span_forms()
    for p in range(planes):
        for k, x in enumerate(spans):
            first, inner = 2 * (p * (count + 1) + k), nodes + BUBBLES * (p * count + k)
            at = np.ix_(*(2 * [[*range(first, first + 4), *range(inner, inner + BUBBLES)]]))
            size = np.array([1.0, x, 1.0, x, *(BUBBLES * [x])])
            bending[at] += stiffness[p, k] * unit_bend * np.outer(size, size) / x**3
            sway[at] += unit_slope * np.outer(size, size) / x
    return bending, sway


def is_loose(motion: Array, spans: Sequence[float]) -> bool:
    """True if some motion of the nodes, of orthonormal columns in parts of the length, bends nothing."""
    s = np.concatenate([[0.0], np.cumsum(spans)])
    rigid = (
        np.stack([np.stack([1 + 0 * s, 0 * s], axis=1), np.stack([s, 1 + 0 * s], axis=1)]).reshape(2, -1).T
    )
    rigid = np.kron(np.eye(len(motion) // len(rigid)), rigid)
    across = motion - (q := np.linalg.qr(rigid)[0]) @ (q.T @ motion)
    left = np.linalg.svd(across, compute_uv=False)
    return bool(motion.shape[1] and (motion.shape[1] > len(left) or left[-1] < LOOSE))


def within(free: Array, plane: int) -> Array:
    """The motions of two planes (4 N, k) that leave the other plane at rest, in the variables of this one (2 N, j)."""
    half = len(free) // 2
    mine, other = free[plane * half : (plane + 1) * half], free[(1 - plane) * half : (2 - plane) * half]
    _, size, right = np.linalg.svd(other)
    rank = int((size > LOOSE).sum())
    return column_space(mine @ right[rank:].T)


def column_space(vectors: Array) -> Array:
    """Orthonormal columns that span the same space; of no vectors none."""
    if not vectors.size:
        return np.zeros((len(vectors), 0))
    left, size, _ = np.linalg.svd(vectors, full_matrices=False)
    return np.asarray(left[:, size > LOOSE * max(1.0, size[0])])


def johnson(euler: float, area: float, yield_stress: float | None) -> tuple[float, str]:
    """Euler's load, or Johnson's A S_y (1 - S_y A / 4 N) where Euler's stress is above half the yield stress."""
    if yield_stress is None or euler / area <= yield_stress / 2:
        return euler, "Euler"
    return area * yield_stress * (1 - yield_stress * area / 4 / euler), "Johnson"


def effective_length(critical: float, stiffness: float, length: float) -> float:
    """K of N = pi^2 EI / (K L)^2; infinite for a loose column."""
    return math.pi * math.sqrt(stiffness / critical) / length if critical else math.inf
