"""Placements in space as matrices (4, 4): a rotation and the position of the origin, metres."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from dalembert.algebra.space import angle_and_axis, exp, least_turn, quaternion
from dalembert.arrays import Array

NEGLIGIBLE = 1e-14
"""Components of an axis below this are rounding of the other program's angles: they become 0."""

X, Y, Z = np.eye(3)
"""The axes."""


def placement(rotation: Array, position: Sequence[float] | Array) -> Array:
    """The matrix of a rotation (3, 3) and a position (3,)."""
    out = np.eye(4)
    out[:3, :3], out[:3, 3] = rotation, position
    return out


def inverse(p: Array) -> Array:
    """The placement back."""
    back = p[:3, :3].T
    return placement(back, -back @ p[:3, 3])


def turned(axis: Sequence[float] | Array, angle: float) -> Array:
    """Rotation (3, 3) about an axis of any length by an angle in radians."""
    unit = np.asarray(axis, float)
    return exp(unit / np.linalg.norm(unit) * angle).reshape(3, 3)


def roll_pitch_yaw(angles: Sequence[float]) -> Array:
    """Rotation (3, 3) about fixed x, then y, then z: URDF and SDFormat."""
    roll, pitch, yaw = angles
    return turned(Z, yaw) @ turned(Y, pitch) @ turned(X, roll)


def to_roll_pitch_yaw(rotation: Array) -> tuple[float, float, float]:
    """The angles of `roll_pitch_yaw`; where pitch is a right angle, yaw is 0."""
    across = float(np.hypot(rotation[0, 0], rotation[1, 0]))
    pitch = float(np.arctan2(-rotation[2, 0], across))
    if across < 1e-12:
        return float(np.arctan2(-rotation[1, 2], rotation[1, 1])), pitch, 0.0
    roll = float(np.arctan2(rotation[2, 1], rotation[2, 2]))
    return roll, pitch, float(np.arctan2(rotation[1, 0], rotation[0, 0]))


def body_313(angles: Sequence[float]) -> Array:
    """Rotation (3, 3) about z, then the turned x, then the turned z: Adams."""
    first, second, third = angles
    return turned(Z, first) @ turned(X, second) @ turned(Z, third)


def to_body_313(rotation: Array) -> tuple[float, float, float]:
    """The angles of `body_313`; where both z are one line, the third is 0."""
    tilt = float(np.hypot(rotation[0, 2], rotation[1, 2]))
    if tilt < 1e-14:
        return (
            float(np.arctan2(rotation[1, 0], rotation[0, 0])),
            float(np.arccos(rotation[2, 2].round())),
            0.0,
        )
    first = float(np.arctan2(rotation[0, 2], -rotation[1, 2]))
    return first, float(np.arctan2(tilt, rotation[2, 2])), float(np.arctan2(rotation[2, 0], rotation[2, 1]))


def from_quaternion(q: Sequence[float] | Array) -> Array:
    """Rotation (3, 3) of a quaternion w, x, y, z of any length."""
    w, x, y, z = np.asarray(q, float) / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def to_quaternion(rotation: Array) -> Array:
    """Quaternion w, x, y, z with w not negative."""
    x, y, z, w = quaternion(np.ascontiguousarray(rotation).reshape(9))
    return np.array([w, x, y, z])


def along(main: str, axis: Sequence[float] | Array) -> Array:
    """A rotation (3, 3) whose ``main`` local axis, x or z, has a direction; the others by the smallest turn."""
    unit = np.asarray(axis, float) / np.linalg.norm(axis)
    home = np.eye(3)["xyz".index(main)]
    return least_turn(home, unit).reshape(3, 3)


def angle_axis(rotation: Array) -> tuple[float, Array]:
    """Angle and axis of a rotation; about z where it turns nothing."""
    angle, axis = angle_and_axis(rotation)
    return (angle, axis) if angle else (0.0, np.array([0.0, 0.0, 1.0]))


def clean(numbers: Array) -> list[float]:
    """Components as floats, without rounding dust below ``NEGLIGIBLE`` of the largest."""
    flat = np.asarray(numbers, float)
    size = float(np.abs(flat).max(initial=0.0))
    return [0.0 if abs(x) <= NEGLIGIBLE * size else float(x) for x in flat]
