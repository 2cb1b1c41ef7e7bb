"""Gyroscopic couples of the books, by the general mechanism in space: reactions, moments, peaks over a cycle."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError

ROTOR = """
space: space
units: {angle: rad, angular_speed: rad/s, angular_acceleration: rad/s^2}
gravity: %s
links:
  ground: {points: {O: [0, 0, 0]}}
  yoke: {points: {O: [0, 0, 0], A: [%g, 0, 0], B: [%g, 0, 0]}}
  rotor: {points: {A: [%g, 0, 0], B: [%g, 0, 0]}, mass: %g, inertia: [%.17g, %.17g, %.17g]}
joints:
  O: {type: revolute, links: [ground, yoke], axis: %s}
%s
drives:
  O: {position: %s, speed: %s, acceleration: %s}
  A: {%s position: %s, speed: %.17g}
"""
HINGE = "  A: {type: revolute, links: [yoke, rotor], axis: [1, 0, 0]}"
BEARINGS = """  A: {type: spherical, links: [yoke, rotor]}
  B: {type: sphere_in_cylinder, links: [yoke, rotor], axis: [1, 0, 0]}"""


def rotor(
    gravity: Any, ends: tuple[float, float], mass: float, inertia: float, turn: str, precession: Any, spin: float,
    joints: str = HINGE, positions: Any = 0.0, second: Any = 0.0,
) -> Any:  # fmt: skip
    middle = sum(ends) / 2
    own = [end - middle for end in ends]
    freedom = "freedom: turn, axis: [1, 0, 0]," if joints is BEARINGS else ""
    still = [0.0] * len(positions) if isinstance(positions, list) else 0.0
    text = ROTOR % (
        gravity, *ends, *own, mass, inertia, inertia / 2, inertia / 2, turn, joints, positions, precession, second,
        freedom, still, spin,
    )  # fmt: skip
    return da.dynamics(da.loads(text))


def test_a_disc_on_an_arm_precesses_under_its_weight() -> None:
    """Khurmi, example 14.1 (GYR-1): at just this speed the pivot carries no moment across the arm."""
    inertia, spin = 5 * 0.15**2 / 2, 10 * math.pi
    r = rotor([0, 0, -9.81], (0.6, 0.6), 5, inertia, "[0, 0, 1]", 16.65397324513593, spin)
    g = da.gyroscopic(r, "rotor", "yoke")
    assert np.linalg.norm(g.couple) == pytest.approx(5 * 9.81 * 0.6, rel=1e-8)
    assert np.abs(g.exact - g.couple).max() < 1e-9
    turned = rotor([0, 0, -9.81], (0.6, 0.6), 5, inertia, "[0, 0, 1]", -16.65397324513593, spin)
    moments = sorted(abs(float(x.reaction_moment("O")[0, 1])) for x in (r, turned))
    assert moments[0] < 1e-7
    assert moments[1] == pytest.approx(2 * 29.43, rel=1e-8)


def test_a_disc_between_two_bearings() -> None:
    """Khurmi, example 14.2 (GYR-2): the weight's halves and the couple's pair."""
    spin, precession = 1000 * math.pi / 30, 2 * math.pi
    r = rotor([0, 0, -9.81], (-0.05, 0.05), 5, 5 * 0.075**2 / 2, "[0, 0, 1]", precession, spin, BEARINGS)
    found = sorted(float(r.reaction(joint, on="rotor")[0, 2]) for joint in "AB")
    assert found == pytest.approx([-68.0025412602127, 117.0525412602127], rel=1e-8)
    g = da.gyroscopic(r, "rotor", "yoke")
    assert g.bearing_force(0.1)[0] == pytest.approx((117.0525412602127 + 68.0025412602127) / 2, rel=1e-8)


def test_a_ship_steers_and_pitches() -> None:
    """Khurmi, chapter 14 (GYR-4): steady turning, and the greatest of a harmonic pitch."""
    inertia, spin = 3500 * 0.45**2, 100 * math.pi
    r = rotor("none", (0, 0), 3500, inertia, "[0, 0, 1]", 0.1, spin)
    couple = da.gyroscopic(r, "rotor", "yoke").couple
    assert np.linalg.norm(couple, axis=1) == pytest.approx([22266.037932317662], rel=1e-8)
    w, most, t = 2 * math.pi / 40, math.radians(6), np.linspace(0, 40, 41)
    motion = [(most * w**k * np.sin(w * t + k * math.pi / 2)).tolist() for k in range(3)]
    r = rotor(
        "none", (0, 0), 3500, inertia, "[0, 1, 0]", motion[1], spin, positions=motion[0], second=motion[2]
    )
    couple = da.gyroscopic(r, "rotor", "yoke").couple
    assert np.linalg.norm(couple, axis=1).max() == pytest.approx(3662.6164328604163, rel=1e-8)


def test_what_has_no_gyroscopic_couple_is_refused() -> None:
    with pytest.raises(ModelError, match="in the plane there is none"):
        da.gyroscopic(da.dynamics(da.four_bar()), "crank")
    r = rotor("none", (0, 0), 1, 1, "[0, 0, 1]", 0.1, 0.0)
    with pytest.raises(ModelError, match="rotor does not spin in yoke"):
        da.gyroscopic(r, "rotor", "yoke")
