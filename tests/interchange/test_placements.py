"""Angles, axes and quaternions of other programs against turns of vectors, also where angles are not unique."""

from __future__ import annotations

import math

import numpy as np
import pytest

from dalembert.interchange.placements import (
    along,
    angle_axis,
    body_313,
    clean,
    from_quaternion,
    inverse,
    placement,
    roll_pitch_yaw,
    to_body_313,
    to_quaternion,
    to_roll_pitch_yaw,
    turned,
)

QUARTER = math.pi / 2
X, Y, Z = np.eye(3)


def about(axis: int, angle: float) -> np.ndarray:
    """The textbook's matrix of a turn about x, y or z."""
    out = np.eye(3)
    j, k = (axis + 1) % 3, (axis + 2) % 3
    out[j, j] = out[k, k] = math.cos(angle)
    out[k, j], out[j, k] = math.sin(angle), -math.sin(angle)
    return out


def test_dust_of_components_becomes_0() -> None:
    """Below a hundred-million-millionth of the largest, of whichever sign."""
    assert clean(np.array([-1.0, 2e-15, -2e-15])) == [-1.0, 0.0, 0.0]
    assert clean(np.array([-100.0, 2e-12, -2e-12, 0.5e-12])) == [-100.0, 2e-12, -2e-12, 0.0]
    assert clean(np.array([-2e-15, -1e-15])) == [-2e-15, -1e-15]
    assert clean(np.array([0.0, -0.0])) == [0.0, 0.0]
    assert clean(np.zeros(0)) == []


@pytest.mark.parametrize("pitch", [0.4, -1.2, QUARTER, -QUARTER, QUARTER - 1e-9, 2e-12 - QUARTER])
def test_roll_pitch_and_yaw(pitch: float) -> None:
    """About the fixed x, then y, then z. Where pitch is a right angle only a sum of the others is there: yaw is 0."""
    rotation = about(2, 0.7) @ about(1, pitch) @ about(0, -0.3)
    assert roll_pitch_yaw((-0.3, pitch, 0.7)) == pytest.approx(rotation, abs=1e-15)
    roll, back, yaw = to_roll_pitch_yaw(rotation)
    assert back == pytest.approx(pitch, abs=1e-12)
    assert about(2, yaw) @ about(1, back) @ about(0, roll) == pytest.approx(rotation, abs=1e-11)
    if abs(pitch) == QUARTER:
        assert (roll, yaw) == (pytest.approx(-0.3 - math.copysign(0.7, pitch)), 0.0)
    else:
        assert (roll, yaw) == pytest.approx((-0.3, 0.7), abs=2e-3)


@pytest.mark.parametrize(("tilt", "third"), [(0.4, 0.9), (3.0, -0.9), (0.0, 0.0), (math.pi, 0.0)])
def test_angles_of_adams(tilt: float, third: float) -> None:
    """About z, the turned x, the turned z. Where both z are one line the third is 0."""
    rotation = about(2, 0.7) @ about(0, tilt) @ about(2, third)
    if tilt == math.pi:
        rotation = rotation.round(15)
    assert body_313((0.7, tilt, third)) == pytest.approx(rotation, abs=1e-15)
    assert to_body_313(rotation) == pytest.approx((0.7, tilt, third), abs=1e-15)


def test_a_tilt_that_is_small_is_kept_by_angles_of_adams() -> None:
    first, tilt, third = to_body_313(about(2, 0.7) @ about(0, 1e-9) @ about(2, 0.5))
    assert tilt == pytest.approx(1e-9, rel=1e-6)
    assert (first, third) == pytest.approx((0.7, 0.5), abs=1e-6)
    assert to_body_313(about(2, 1.2) @ about(0, 1e-15)) == (pytest.approx(1.2), 0.0, 0.0)


@pytest.mark.parametrize("angle", [0.0, 0.6, -2.0, math.pi])
def test_a_turn_about_an_axis_of_any_length(angle: float) -> None:
    """By matrix and quaternion; back with the real part not negative, and about z where nothing turns."""
    axis = np.array([2.0, -3.0, 6.0])
    rotation = turned(axis, angle)
    c, s, u = math.cos(angle), math.sin(angle), axis / 7
    cross = np.array([[0, -u[2], u[1]], [u[2], 0, -u[0]], [-u[1], u[0], 0]])
    assert rotation == pytest.approx(c * np.eye(3) + s * cross + (1 - c) * np.outer(u, u), abs=1e-15)
    q = np.array([math.cos(angle / 2), *(math.sin(angle / 2) * u)])
    assert from_quaternion(-3 * q) == pytest.approx(rotation, abs=1e-15)
    back = to_quaternion(rotation)
    assert back[0] >= 0
    assert abs(back @ q) == pytest.approx(1, abs=1e-15)
    size, line = angle_axis(rotation)
    assert (size, turned(line, size)) == (pytest.approx(abs(angle)), pytest.approx(rotation, abs=1e-14))
    if not angle:
        assert line.tolist() == [0, 0, 1]


@pytest.mark.parametrize("axis", [[0, 0, 5], [0, 3, 4], [0, 0, -2], [-6, 0, 0], [1, 1, 1]])
def test_axes_along_a_direction_are_turned_least(axis: list[float]) -> None:
    """The trace of a rotation is 1 + 2 cos of its angle, which is that between the two directions."""
    unit = np.array(axis) / math.hypot(*axis)
    for main, home in (("x", X), ("z", Z)):
        rotation = along(main, axis)
        assert rotation @ home == pytest.approx(unit, abs=1e-15)
        assert rotation @ rotation.T == pytest.approx(np.eye(3), abs=1e-15)
        assert np.trace(rotation) == pytest.approx(1 + 2 * home @ unit, abs=1e-14)


def test_the_placement_back() -> None:
    p = placement(about(0, 0.3) @ about(2, 1.0), [1, 2, 3])
    assert (p[:3, 3].tolist(), p[3].tolist()) == ([1, 2, 3], [0, 0, 0, 1])
    assert inverse(p) @ p == pytest.approx(np.eye(4), abs=1e-15)
    assert inverse(p)[:3, 3] == pytest.approx(-p[:3, :3].T @ [1, 2, 3])
