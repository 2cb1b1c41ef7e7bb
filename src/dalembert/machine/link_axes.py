"""A link's motion in link axes, with three components in the plane too, so that one code serves plane and space."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from dalembert.arrays import Array

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


class LinkAxes:
    """Rotation (P, 3, 3) of a link; ``turning`` (T, 3): its angular speeds and accelerations, and ``rate`` (P, 3, 3):
    the matrix that gives the acceleration of an arm, in link axes; both 0 where the analysis is without inertia."""

    def __init__(self, r: Result, link: str) -> None:
        self.r, self.link = r, link
        count, d = len(r.status), r.mechanism.dimension
        self.rotation = np.tile(np.eye(3), (count, 1, 1))
        self.rotation[:, :d, :d] = r.rotation(link)
        self.rate, self.turning = np.zeros((count, 3, 3)), np.zeros((0, 3))
        if r.inertia:
            alpha, w = (self.couple_to_link(v) for v in (r.acceleration(link), r.speed(link)))
            self.rate = _cross(alpha) + _cross(w) @ _cross(w)
            self.turning = np.concatenate([alpha, w])

    def to_link(self, v: Array) -> Array:
        """Vectors (P, d) of ground axes in link axes (P, 3)."""
        return np.asarray(np.einsum("pji,pj->pi", self.rotation, in_space(v)))

    def couple_to_link(self, v: Array) -> Array:
        """The same of a couple or a turning: (P,) in the plane."""
        return self.to_link(couple_in_space(v))


def in_space(vector: Sequence[float] | Array) -> Array:
    """Planar vectors (..., 2), or (..., 3), with three components."""
    v = np.asarray(vector, float)
    return v if v.shape[-1] == 3 else np.concatenate([v, np.zeros((*v.shape[:-1], 1))], axis=-1)


def couple_in_space(v: Array) -> Array:
    """Planar couples or angular speeds (P,), or (P, 3), with three components."""
    return v if v.ndim > 1 else np.stack([0 * v, 0 * v, v], axis=-1)


def _cross(v: Array) -> Array:
    """Matrices (P, 3, 3) of the product with vectors (P, 3)."""
    out = np.zeros((len(v), 3, 3))
    for k in range(3):
        out[:, (k + 2) % 3, (k + 1) % 3] = v[:, k]
        out[:, (k + 1) % 3, (k + 2) % 3] = -v[:, k]
    return out
