"""Rotations, distances and lines against their definitions."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from dalembert.algebra import plane, space
from dalembert.algebra.lines import meeting_point

ANGLES = [1e-12, 1e-7, 5e-5, 2e-4, 0.3, 2.0, np.pi - 1e-3, np.pi - 5e-5, np.pi - 1e-9]


@pytest.mark.parametrize("angle", ANGLES)
def test_rotations_about_any_axis(angle: float) -> None:
    """Rodrigues' formula, its series near no turn, quaternions, and the way back near half a turn."""
    rng = np.random.default_rng(1)
    axes = np.array([*np.eye(3), *-np.eye(3), *rng.normal(size=(8, 3))])
    turns = angle * axes / np.linalg.norm(axes, axis=1, keepdims=True)
    for w, r in zip(turns, space.exp(turns), strict=True):
        expected = Rotation.from_rotvec(w)
        assert r.reshape(3, 3) == pytest.approx(expected.as_matrix(), abs=2e-15)
        q = expected.as_quat()
        assert space.quaternion(r) == pytest.approx(q if q[3] >= 0 else -q, abs=2e-15)
        found, about = space.angle_and_axis(r.reshape(3, 3))
        assert found * about == pytest.approx(w, abs=1e-8)
        assert found == pytest.approx(angle, abs=1e-9)


def test_of_a_half_turn_the_largest_part_is_positive() -> None:
    for k in range(3):
        half = 2.0 * np.diag(np.eye(3)[k]) - np.eye(3)
        assert space.quaternion(half.ravel()).tolist() == np.eye(4)[k].tolist()


def test_no_rotation_and_none_that_is_known() -> None:
    angle, axis = space.angle_and_axis(np.eye(3))
    assert (angle, *axis) == (0, 0, 0, 0)
    for known in (
        np.full((3, 3), np.nan),
        np.where(np.eye(3) > 0, np.inf, 0.0),
        np.where(np.eye(3) > 0, 1, np.nan),
    ):
        angle, axis = space.angle_and_axis(known)
        assert np.isnan([angle, *axis]).all()


def test_poses_are_apart_whichever_comes_first() -> None:
    """In the plane whole turns count; in space the angle between two rotations."""
    one, two = np.array([0.1, 3.0]), np.array([0.4, 3.0 - 4 * np.pi])
    for a, b in ((one, two), (two, one)):
        assert plane.angle_between(plane.rotation(a), plane.rotation(b), a, b) == pytest.approx(
            [0.3, 4 * np.pi]
        )


def test_lines_meet_where_they_are_nearest() -> None:
    rng = np.random.default_rng(2)
    for d in (2, 3):
        place, along = rng.normal(size=d), rng.normal(size=(4, d))
        at = place + rng.normal(size=(4, 1)) * along
        found = meeting_point(at, along)
        assert found is not None
        assert found[0] == pytest.approx(place, abs=1e-12)
        assert found[1] < 1e-12
        assert meeting_point(at[:1], along[:1]) is None
        assert meeting_point(at[:1], 0 * along[:1]) is None
        assert meeting_point(at[:2], np.array([along[0], 0 * along[0]])) is None
        assert meeting_point(at, np.repeat(along[:1], 4, axis=0)) is None
    skew = meeting_point(np.array([[0.0, 0, 0], [0, 0, 2]]), np.array([[1.0, 0, 0], [0, 1, 0]]))
    assert skew is not None
    assert skew[0] == pytest.approx([0, 0, 1])
    assert skew[1] == pytest.approx(1.0)


def test_the_farthest_of_three_lines_counts() -> None:
    """x = 0, y = 0 and x = 3: the nearest point lies between the two that are parallel."""
    point, away = meeting_point(
        np.array([[0.0, 5.0], [2.0, 0.0], [3.0, 1.0]]), np.array([[0, 1], [1, 0], [0, 2.0]])
    )  # type: ignore[misc]
    assert point == pytest.approx([1.5, 0.0])
    assert away == pytest.approx(1.5)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("other", [1.0, -1.0])
def test_half_a_turn_is_about_an_axis_across(sign: float, other: float) -> None:
    """Of vectors onto their opposites, along each axis and oblique; the nearest turn onto another is not longer."""
    oblique = np.array([0.6 * sign, 0.0, 0.8 * other])
    for a in (*(sign * np.eye(3)), oblique):
        for b in (-a, other * np.array([0.0, 0.6, 0.8])):
            r = space.least_turn(a, b).reshape(3, 3)
            assert r @ a == pytest.approx(b, abs=1e-12)
            assert r @ r.T == pytest.approx(np.eye(3), abs=1e-12)
            assert np.linalg.det(r) == pytest.approx(1.0)
            assert (np.trace(r) - 1) / 2 == pytest.approx(float(a @ b), abs=1e-12)


def test_the_least_turn_brings_each_of_several_vectors_onto_its_own() -> None:
    """Beside others those that are opposite too, which turn by half a turn about an axis across."""
    rng = np.random.default_rng(4)
    a, b = (v / np.linalg.norm(v, axis=1)[:, None] for v in rng.normal(size=(2, 9, 3)))
    b[::4], b[1] = -a[::4], a[1]
    for some in (slice(None), slice(0, 1), slice(1, 4)):
        turn = space.least_turn(a[some], b[some])
        np.testing.assert_allclose(space.rotate(turn, a[some]), b[some], atol=1e-12)
        angle = np.arccos(np.clip((a[some] * b[some]).sum(axis=1), -1, 1))
        matrices = turn.reshape(-1, 3, 3)
        np.testing.assert_allclose(np.trace(matrices, axis1=1, axis2=2), 1 + 2 * np.cos(angle), atol=1e-12)
        np.testing.assert_allclose(np.linalg.det(matrices), 1.0, atol=1e-12)
