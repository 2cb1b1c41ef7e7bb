"""Planar rigid-body algebra: twists (vx, vy, omega), wrenches (fx, fy, m), rotations as (cos, sin).

Every function takes arrays with any leading axes and the components last. Only arithmetic, ``cos`` and ``sin`` are
used, so the entries may be floats or traced symbols.
"""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array

name = "plane"
d = 2
"""Components of a force."""
n = 3
"""Components of a twist or wrench."""


def _pair(x: Array, y: Array) -> Array:
    """Two components as the last axis (faster than numpy.stack)."""
    out = np.empty((*x.shape, 2), x.dtype)
    out[..., 0], out[..., 1] = x, y
    return out


def rotation(turn: Array) -> Array:
    """Rotation (..., 2) = (cos, sin) of an angle.

    >>> rotation(np.array(0.0))
    array([1., 0.])
    """
    return _pair(np.cos(turn), np.sin(turn))


def rotate(r: Array, u: Array) -> Array:
    """Ground components of a vector u given in rotated axes."""
    c, s, x, y = r[..., 0], r[..., 1], u[..., 0], u[..., 1]
    return _pair(c * x - s * y, s * x + c * y)


def rotate_couple(r: Array, couple: Array) -> Array:
    """Ground components of a couple (..., 1) given in rotated axes: the same."""
    return couple


def unrotate(r: Array, v: Array) -> Array:
    """Components in rotated axes of a vector v given in ground axes."""
    c, s, x, y = r[..., 0], r[..., 1], v[..., 0], v[..., 1]
    return _pair(c * x + s * y, c * y - s * x)


def across(u: Array) -> Array:
    """The vector turned by 90 degrees, counter-clockwise.

    >>> across(np.array([1.0, 0.0]))
    array([-0.,  1.])
    """
    return _pair(-u[..., 1], u[..., 0])


def cross(r: Array, f: Array) -> Array:
    """Moment (..., 1) of a force f with arm r.

    >>> cross(np.array([2.0, 0.0]), np.array([0.0, 3.0]))
    array([6.])
    """
    return np.asarray(r[..., 0] * f[..., 1] - r[..., 1] * f[..., 0])[..., None]


def spin(w: Array, r: Array) -> Array:
    """Velocity omega x r of a point with arm r on a link turning at w (..., 1)."""
    return _pair(-w[..., 0] * r[..., 1], w[..., 0] * r[..., 0])


def centripetal(w: Array, r: Array) -> Array:
    """Acceleration omega x (omega x r) towards the centre."""
    return -(w * w) * r


def gyroscopic(r: Array, w: Array, inertia: Array) -> Array:
    """Moment omega x (I omega): zero in the plane. Shape (..., 1)."""
    return np.zeros_like(w)


def angular_momentum_rate(r: Array, alpha: Array, inertia: Array) -> Array:
    """I alpha about the mass centre, shape (..., 1); ``inertia`` (..., 1)."""
    return inertia * alpha


def dot(a: Array, b: Array) -> Array:
    """Plain dot product of the components; of a twist and a wrench it is power.

    >>> float(dot(np.array([1.0, 2.0, 3.0]), np.array([1.0, 0.0, 1.0])))
    4.0
    """
    return np.asarray((a * b).sum(axis=-1))


# the coordinates that a motion is interpolated in


def rotate_links(turn: Array, r: Array, w: Array) -> tuple[Array, Array]:
    """Angles (..., L+1) and rotations after the moving links' turns w (..., L, 1)."""
    turn, r = turn.copy(), r.copy()
    turn[..., :-1] += w[..., 0]
    r[..., :-1, :] = rotation(turn[..., :-1])
    return turn, r


def coordinates(point: Array, turn: Array, r: Array) -> Array:
    """Coordinates (..., 3) of poses that change smoothly: points and angles."""
    return np.concatenate([point, turn[..., None]], axis=-1)


def coordinate_rates(r: Array, twist: Array) -> Array:
    """Rates (..., 3) of the coordinates at twists (..., 3): the twists themselves."""
    return twist


def from_coordinates(q: Array, turn: Array) -> tuple[Array, Array, Array]:
    """Points, angles and rotations of coordinates (..., 3)."""
    return q[..., :d].copy(), q[..., -1].copy(), rotation(q[..., -1])


def angle_between(a: Array, b: Array, turn_a: Array, turn_b: Array) -> Array:
    """Angle (..., L+1) between poses, whole turns included; ``a`` and ``b``, their rotations, are not needed."""
    return np.asarray(np.abs(turn_a - turn_b))


def with_ground(turn: Array, r: Array) -> tuple[Array, Array]:
    """Angles and rotations of the moving links and of the ground."""
    ground = np.broadcast_to(rotation(np.zeros(1)), (*r.shape[:-2], 1, 2))
    turn = np.concatenate([turn, np.zeros_like(turn[..., :1])], axis=-1)
    return turn, np.concatenate([r, ground], axis=-2)


def without_ground(turn: Array) -> Array:
    """Angles of the moving links."""
    return np.asarray(turn[..., :-1])


def reference_rotation(count: int, links: int) -> tuple[Array, Array]:
    """Angles and rotations of ``count`` unrotated poses of ``links`` links."""
    turn = np.zeros((count, links))
    return turn, rotation(turn)
