"""Rigid-body algebra of space: twists (vx, vy, vz, wx, wy, wz), wrenches (forces, moments).

Every function takes arrays with any leading axes and the components last. Only arithmetic is used.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

name = "space"
d = 3
"""Components of a force."""
n = 6
"""Components of a twist or wrench."""


def cross(r: Array, f: Array) -> Array:
    """Moment (..., 3) of a force f with arm r.

    >>> cross(np.array([2.0, 0.0, 0.0]), np.array([0.0, 3.0, 0.0])).tolist()
    [0.0, 0.0, 6.0]
    """
    x, y, z = r[..., 0], r[..., 1], r[..., 2]
    fx, fy, fz = f[..., 0], f[..., 1], f[..., 2]
    return np.stack([y * fz - z * fy, z * fx - x * fz, x * fy - y * fx], axis=-1)


def spin(w: Array, r: Array) -> Array:
    """Velocity omega x r of a point with arm r on a link turning at w (..., 3)."""
    return cross(w, r)
