"""Vectors and rotations with their first and second rates, carried through formulas exactly.

A scalar jet has arrays (P,), a vector (P, 3), a rotation (P, 3, 3) whose columns are the link's axes in ground axes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.oracles.jets import Jet, sqrt
from tests.oracles.reading import Array, Tree


def fixed(value: Any) -> Jet:
    """A constant vector or rotation."""
    x = np.asarray(value, float)[None]
    return Jet(x, np.zeros_like(x), np.zeros_like(x))


def bilinear(f: Callable[[Any, Any], Any], a: Jet, b: Jet) -> Jet:
    """Leibniz' rule for any product."""
    return Jet(f(a.x, b.x), f(a.v, b.x) + f(a.x, b.v), f(a.a, b.x) + 2 * f(a.v, b.v) + f(a.x, b.a))


def dot(a: Jet, b: Jet) -> Jet:
    return bilinear(lambda p, q: np.sum(p * q, -1), a, b)


def cross(a: Jet, b: Jet) -> Jet:
    return bilinear(np.cross, a, b)


def scale(s: Jet, vector: Jet) -> Jet:
    return bilinear(lambda p, q: p[..., None] * q, s, vector)


def unit(a: Jet) -> Jet:
    return scale(1.0 / sqrt(dot(a, a)), a)


def apply(rotation: Jet, vector: Jet) -> Jet:
    return bilinear(lambda p, q: np.einsum("...ij,...j->...i", p, q), rotation, vector)


def mul(a: Jet, b: Jet) -> Jet:
    return bilinear(np.matmul, a, b)


def stacked(*parts: Jet) -> Jet:
    """The components of a vector, or the columns of a rotation, together."""
    return Jet(*(np.stack(np.broadcast_arrays(*part), -1) for part in zip(*map(_parts, parts), strict=True)))


def spun(c: Jet, s: Jet) -> Jet:
    """The rotation about z with this cosine and sine."""
    o, e = 0 * c, 0 * c + 1.0
    return stacked(stacked(c, s, o), stacked(-s, c, o), stacked(o, o, e))


def _parts(j: Jet) -> tuple[Array, Array, Array]:
    return j.x, j.v, j.a


def frame(z: Any, x: Any) -> Array:
    """The joint's axes as columns, x made perpendicular to z."""
    z, x = np.asarray(z, float), np.asarray(x, float)
    z = z / np.linalg.norm(z)
    x = x - z * (x @ z)
    x = x / np.linalg.norm(x)
    return np.stack([x, np.cross(z, x), z], -1)


def square(vector: Array, axis: Array) -> Array:
    """The unit vector across an axis nearest to a vector."""
    across = vector - axis * (vector @ axis)
    return np.asarray(across / np.linalg.norm(across))


def local_axes(joint: Tree, side: str) -> Array:
    """The joint's axes as columns, in the axes of link `side`; the other axis is any where only one is given."""
    main = "z" if joint["type"] in ("revolute", "universal") else "x"
    given = joint.get("axes", {}).get(side, {main: joint.get("axis", [1.0, 0.0, 0.0])})
    if "x" in given and "z" in given:
        return frame(given["z"], given["x"])
    u = next(iter(given.values()))
    helper = np.eye(3)[np.argmin(np.abs(u))]
    return frame(u, helper) if "z" in given else np.roll(frame(u, helper), 1, axis=-1)


@dataclass(frozen=True)
class Pose:
    """Where a link is: its origin and its axes."""

    origin: Jet
    rotation: Jet

    def point(self, local: Any) -> Jet:
        return self.origin + self.vector(local)

    def vector(self, local: Any) -> Jet:
        return apply(self.rotation, fixed(local))

    @property
    def w(self) -> Array:
        """Angular velocity, from R' = (w x) R."""
        return _axial(self.rotation.v @ _transposed(self.rotation.x))

    @property
    def alpha(self) -> Array:
        """Angular acceleration: the skew part of R'' Rᵀ."""
        return _axial(self.rotation.a @ _transposed(self.rotation.x))


GROUND = Pose(fixed([0.0, 0.0, 0.0]), fixed(np.eye(3)))


def _axial(m: Array) -> Array:
    return 0.5 * np.stack(
        [m[..., 2, 1] - m[..., 1, 2], m[..., 0, 2] - m[..., 2, 0], m[..., 1, 0] - m[..., 0, 1]], -1
    )


def _transposed(m: Array) -> Array:
    return np.swapaxes(m, -1, -2)


def placed(rotation: Jet, local: Any, spot: Jet) -> Pose:
    """The pose that brings a point of the link to a spot."""
    return Pose(spot - apply(rotation, fixed(local)), rotation)


def hinged(on: Pose, at_i: Any, frame_i: Array, at_j: Any, frame_j: Array, c: Jet, s: Jet) -> Pose:
    """Link j in a revolute of link i, turned by the angle of cosine c and sine s about z of the frames."""
    rotation = mul(mul(mul(on.rotation, fixed(frame_i)), spun(c, s)), fixed(frame_j.T))
    return placed(rotation, at_j, on.point(at_i))
