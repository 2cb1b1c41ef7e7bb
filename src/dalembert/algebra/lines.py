"""Lines given by points and directions: their common point. Components last, in the plane or in space."""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array

PARALLEL = 1e-6
"""Least spread of directions over the largest, below which lines are parallel."""


def meeting_point(at: Array, along: Array) -> tuple[Array, float] | None:
    """The point nearest to lines through points (N, d) along vectors (N, d), and its largest distance from one.

    Least squares: sum of (1 - e e^T)(p - a) = 0. None where the lines are parallel, or there are fewer than two.

    >>> point, away = meeting_point(np.array([[0.0, 0.0], [4.0, 0.0]]), np.array([[1.0, 1.0], [-1.0, 1.0]]))
    >>> point.round(9), away < 1e-15
    (array([2., 2.]), True)
    """
    size = np.linalg.norm(along, axis=-1, keepdims=True)
    unit = (along / np.where(size > 0, size, 1.0))[size[:, 0] > 0]
    places = at[size[:, 0] > 0]
    if not len(unit):
        return None
    d = at.shape[-1]
    across = np.eye(d) - unit[:, :, None] * unit[:, None, :]
    middle = places.mean(axis=0)
    right = np.einsum("nij,nj->ni", across, places - middle)
    point, _, _, values = np.linalg.lstsq(across.reshape(-1, d), right.ravel(), rcond=None)
    if not values[-1] > PARALLEL * values[0]:
        return None
    away = np.linalg.norm(across @ point - right, axis=-1)
    return middle + point, float(away.max())
