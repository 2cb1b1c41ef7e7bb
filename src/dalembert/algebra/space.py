"""Spatial rigid-body algebra: twists (vx, vy, vz, wx, wy, wz), wrenches (forces, moments), rotations as matrices.

Every function takes arrays with any leading axes and the components last. A rotation (..., 9) is a matrix row by row
that turns link components into ground components. Only arithmetic, ``cos``, ``sin`` and roots are used.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from dalembert.arrays import Array

name = "space"
d = 3
"""Components of a force."""
n = 6
"""Components of a twist or wrench."""

IDENTITY = np.eye(3).ravel()
"""The identity rotation."""


FEW = 1200
"""Numbers of rotations below which one call of matmul is faster than many of arithmetic."""

ROUNDING = 1e-12
"""Twice the sine of a turn about an axis, below which it does not count as a turn about it."""


def _vector(x: Array, y: Array, z: Array) -> Array:
    """Three components as the last axis (faster than numpy.stack)."""
    out = np.empty((*np.shape(x), 3), np.result_type(x, y, z))
    out[..., 0], out[..., 1], out[..., 2] = x, y, z
    return out


def matrix(r: Array) -> Array:
    """The rotation as matrices (..., 3, 3).

    >>> matrix(IDENTITY).tolist()
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    """
    return np.asarray(r.reshape((*r.shape[:-1], 3, 3)))


def rotation(turn: Array, axis: ArrayLike = (0.0, 0.0, 1.0)) -> Array:
    """Rotation (..., 9) by an angle (...) about an axis (..., 3) of any length.

    >>> rotation(np.array(np.pi / 2)).round(12).tolist()
    [0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    """
    axis = np.asarray(axis)
    return exp(axis / np.sqrt(dot(axis, axis))[..., None] * np.asarray(turn)[..., None])


def exp(w: Array) -> Array:
    """Rotation (..., 9) by the vector w (..., 3): about its direction by its length (Rodrigues' formula).

    >>> exp(np.array([0.0, 0.0, np.pi])).round(12).tolist()[0]
    -1.0
    """
    square = dot(w, w)
    angle = np.sqrt(square)
    small = square < 1e-8
    safe = np.where(small, 1.0, angle)
    s = np.where(small, 1 - square / 6, np.sin(angle) / safe)
    c = np.where(small, 0.5, (1 - np.cos(angle)) / (safe * safe))
    x, y, z = w[..., 0], w[..., 1], w[..., 2]
    out = np.empty((*square.shape, 9), w.dtype)
    diagonal = 1 - c * square
    for k, u in enumerate((x, y, z)):
        out[..., 4 * k] = diagonal + c * u * u
    for (k, m), one, two, three in (((1, 3), x, y, z), ((5, 7), y, z, x), ((6, 2), z, x, y)):
        out[..., k] = c * one * two - s * three
        out[..., m] = c * one * two + s * three
    return out


def cayley(w: Array) -> Array:
    """Rotation (..., 9) about the vector w (..., 3) by 2 atan(|w| / 2): by its length, up to third order.

    >>> cayley(np.array([0.0, 0.0, 2.0])).tolist()
    [0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    """
    x, y, z = w[..., 0], w[..., 1], w[..., 2]
    square = dot(w, w)
    over = 1.0 / (1.0 + 0.25 * square)
    half = 0.5 * over
    out = np.empty((*np.shape(x), 9), w.dtype)
    for k, u in enumerate((x, y, z)):
        out[..., 4 * k] = 1.0 - half * (square - u * u)
    for (k, m), one, two, three in (((1, 3), x, y, z), ((5, 7), y, z, x), ((6, 2), z, x, y)):
        out[..., k] = half * one * two - over * three
        out[..., m] = half * one * two + over * three
    return out


def quaternion(r: Array) -> Array:
    """Unit quaternions (..., 4) as x, y, z, w with w not negative: (n sin(t/2), cos(t/2)) of a turn t about n.

    The largest of the four is taken from the diagonal, the others follow without loss (Shepperd 1978).

    >>> quaternion(exp(np.array([0.0, 0.0, np.pi / 2]))).round(4).tolist()
    [0.0, 0.0, 0.7071, 0.7071]
    """
    m = matrix(r)
    four = np.empty((*m.shape[:-2], 4, 4))  # 4 q_a q_b
    for a in range(3):
        b, c = (a + 1) % 3, (a + 2) % 3
        four[..., a, a] = 1 + m[..., a, a] - m[..., b, b] - m[..., c, c]
        four[..., a, b] = four[..., b, a] = m[..., a, b] + m[..., b, a]
        four[..., a, 3] = four[..., 3, a] = m[..., c, b] - m[..., b, c]
    four[..., 3, 3] = 1 + np.trace(m, axis1=-2, axis2=-1)
    largest = np.diagonal(four, axis1=-2, axis2=-1).argmax(axis=-1)
    q = np.take_along_axis(four, largest[..., None, None], axis=-2)[..., 0, :]
    q = q / np.sqrt(dot(q, q))[..., None]
    return np.where(q[..., 3:] < 0, -q, q)


def angle_and_axis(rotation: Array) -> tuple[float, Array]:
    """Angle (0 to pi) and axis (3,) of a rotation (3, 3); an axis of zeros where it turns nothing, NaN where unknown.

    >>> angle_and_axis(np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]]))
    (1.5707963267948966, array([0., 0., 1.]))

    Of a small turn, rounding beside 1 is nothing in its axis:

    >>> angle_and_axis(np.array([[1, -1e-6, 1e-16], [1e-6, 1, 0], [0, 0, 1]]))[1]
    array([0., 0., 1.])
    """
    if not np.isfinite(rotation).all():
        return float("nan"), np.full(3, np.nan)
    skew = np.array(
        [rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]]
    )
    skew[np.abs(skew) < ROUNDING] = 0.0
    angle = float(np.arctan2(np.linalg.norm(skew), np.trace(rotation) - 1))
    if angle < 1e-9:
        return 0.0, np.zeros(3)
    if np.pi - angle > 1e-4:
        return angle, skew / np.linalg.norm(skew)
    # near half a turn the symmetric part, (1 - cos) n n + cos, gives the axis up to its sign
    square = (rotation + rotation.T) / 2 + np.eye(3)
    axis = square[int(np.diag(square).argmax())]
    return angle, axis / np.linalg.norm(axis) * (1.0 if axis @ skew >= 0 else -1.0)


def rotate(r: Array, u: Array) -> Array:
    """Ground components of a vector u given in rotated axes."""
    if r.size < FEW:
        return np.asarray((matrix(r) @ u[..., None])[..., 0])
    x, y, z = u[..., 0], u[..., 1], u[..., 2]
    return _vector(*(r[..., k] * x + r[..., k + 1] * y + r[..., k + 2] * z for k in (0, 3, 6)))


def rotate_couple(r: Array, couple: Array) -> Array:
    """Ground components of a couple (..., 3) given in rotated axes."""
    return rotate(r, couple)


def unrotate(r: Array, v: Array) -> Array:
    """Components in rotated axes of a vector v given in ground axes."""
    x, y, z = v[..., 0], v[..., 1], v[..., 2]
    return _vector(*(r[..., k] * x + r[..., k + 3] * y + r[..., k + 6] * z for k in range(3)))


def least_turn(a: Array, b: Array) -> Array:
    """The rotation (..., 9) by the smallest angle that brings the unit vector a (..., 3) onto b.

    >>> least_turn(np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])).tolist()
    [0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    """
    v, c = cross(a, b), dot(a, b)
    opposite = c < -1 + 1e-9
    x, y, z = v[..., 0], v[..., 1], v[..., 2]
    zero = np.zeros_like(c)
    skew = matrix(np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=-1))
    r = np.eye(3) + skew + skew @ skew / np.where(opposite, 1.0, 1 + c)[..., None, None]
    if np.any(opposite):  # half a turn about any axis across
        e = np.eye(3)[np.abs(a).argmin(axis=-1)]
        n = e - dot(a, e)[..., None] * a
        n = n / np.sqrt(dot(n, n))[..., None]
        r = np.where(opposite[..., None, None], 2 * n[..., :, None] * n[..., None, :] - np.eye(3), r)
    return r.reshape((*r.shape[:-2], 9))


def compose(a: Array, b: Array) -> Array:
    """The rotation b followed by a: the product of their matrices."""
    out: Array = matrix(a) @ matrix(b)
    return out.reshape((*out.shape[:-2], 9))


def cross(r: Array, f: Array) -> Array:
    """Moment (..., 3) of a force f with arm r.

    >>> cross(np.array([2.0, 0.0, 0.0]), np.array([0.0, 3.0, 0.0])).tolist()
    [0.0, 0.0, 6.0]
    """
    x, y, z = r[..., 0], r[..., 1], r[..., 2]
    fx, fy, fz = f[..., 0], f[..., 1], f[..., 2]
    return _vector(y * fz - z * fy, z * fx - x * fz, x * fy - y * fx)


def spin(w: Array, r: Array) -> Array:
    """Velocity omega x r of a point with arm r on a link turning at w (..., 3)."""
    return cross(w, r)


def centripetal(w: Array, r: Array) -> Array:
    """Acceleration omega x (omega x r) towards the axis."""
    return np.asarray(dot(w, r)[..., None] * w - dot(w, w)[..., None] * r)


def gyroscopic(r: Array, w: Array, inertia: Array) -> Array:
    """Moment omega x (I omega) (..., 3); inertia (..., 9) about the mass centre in link axes, r the link's rotation."""
    return cross(w, _through(r, w, inertia))


def angular_momentum_rate(r: Array, alpha: Array, inertia: Array) -> Array:
    """I alpha about the mass centre (..., 3); inertia as in ``gyroscopic``."""
    return _through(r, alpha, inertia)


def _through(r: Array, w: Array, inertia: Array) -> Array:
    """I w in ground axes of an inertia in link axes."""
    return rotate(r, rotate(inertia, unrotate(r, w)))


def dot(a: Array, b: Array) -> Array:
    """Plain dot product of the components; of a twist and a wrench it is power."""
    return np.asarray((a * b).sum(axis=-1))


# the coordinates that a motion is interpolated in


def rotate_links(turn: Array, r: Array, w: Array) -> tuple[Array, Array]:
    """Counted angles, unchanged, and rotations (..., L+1, 9) after the moving links' turns w (..., L, 3)."""
    r = r.copy()
    r[..., :-1, :] = compose(exp(w), r[..., :-1, :])
    return turn, r


def coordinates(point: Array, turn: Array, r: Array) -> Array:
    """Coordinates (..., 12) of poses that change smoothly: points and rotations."""
    return np.concatenate([point, r], axis=-1)


def coordinate_rates(r: Array, twist: Array) -> Array:
    """Rates (..., 12) of the coordinates at twists (..., 6): those of a rotation are omega x its columns."""
    w = np.broadcast_to(twist[..., None, d:], (*twist.shape[:-1], 3, 3))
    columns = np.swapaxes(matrix(r), -1, -2)
    turning = np.swapaxes(cross(w, columns), -1, -2)
    return np.concatenate([twist[..., :d], turning.reshape((*twist.shape[:-1], 9))], axis=-1)


def from_coordinates(q: Array, turn: Array) -> tuple[Array, Array, Array]:
    """Points, followed angles (those given) and rotations of coordinates (..., 12) that are nearly rotations."""
    m = matrix(q[..., d:])
    x = _direction(m[..., 0])
    z = _direction(cross(x, m[..., 1]))
    r = np.stack([x, cross(z, x), z], axis=-1)
    return q[..., :d].copy(), turn.copy(), r.reshape((*r.shape[:-2], 9))


def _direction(v: Array) -> Array:
    return np.asarray(v / np.sqrt(dot(v, v))[..., None])


def angle_between(a: Array, b: Array, turn_a: Array, turn_b: Array) -> Array:
    """Angle (..., L+1) between rotations a and b: its chord, 2 sin of half of it."""
    return np.asarray(np.sqrt(((a - b) ** 2).sum(axis=-1) / 2))


def reference_rotation(count: int, links: int) -> tuple[Array, Array]:
    """Counted angles and rotations of ``count`` unrotated poses of ``links`` links."""
    return np.zeros((count, 0)), np.tile(IDENTITY, (count, links, 1))


def with_ground(turn: Array, r: Array) -> tuple[Array, Array]:
    """Counted angles, unchanged, and rotations of the moving links and of the ground."""
    return turn, np.concatenate([r, np.broadcast_to(IDENTITY, (*r.shape[:-2], 1, 9))], axis=-2)


def without_ground(turn: Array) -> Array:
    """Counted angles, unchanged: they belong to no link."""
    return turn
