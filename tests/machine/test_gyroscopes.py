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
    """The books' couple is all there is where the axis is across the precession; the other sense doubles the moment."""
    inertia, spin = 5 * 0.15**2 / 2, 10 * math.pi
    r, turned = (
        rotor([0, 0, -9.81], (0.6, 0.6), 5, inertia, "[0, 0, 1]", sense * 16.65397324513593, spin)
        for sense in (1, -1)
    )
    g = da.gyroscopic(r, "rotor", "yoke")
    assert np.linalg.norm(g.couple) == pytest.approx(5 * 9.81 * 0.6, rel=1e-8)
    assert np.abs(g.exact - g.couple).max() < 1e-9
    moments = sorted(abs(float(x.reaction_moment("O")[0, 1])) for x in (r, turned))
    assert moments[0] < 1e-7
    assert moments[1] == pytest.approx(2 * 29.43, rel=1e-8)


def test_what_has_no_gyroscopic_couple_is_refused() -> None:
    with pytest.raises(ModelError, match="a planar mechanism has none"):
        da.gyroscopic(da.dynamics(da.four_bar()), "crank")
    r = rotor("none", (0, 0), 1, 1, "[0, 0, 1]", 0.1, 0.0)
    with pytest.raises(ModelError, match="rotor does not spin in yoke"):
        da.gyroscopic(r, "rotor", "yoke")


@pytest.mark.parametrize(("spin", "turn"), [(300.0, 2.0), (-300.0, 2.0), (300.0, -2.0)])
def test_spin_precession_and_the_pair_of_bearing_forces(spin: float, turn: float) -> None:
    """A rotor along x on a yoke about z: C = I w_s w_p (z x x) = I w_s w_p y on the rotor, whichever way both turn."""
    r = rotor("none", (0.0, 0.4), 4, 0.05, "[0, 0, 1]", turn, spin)
    g = da.gyroscopic(r, "rotor", "yoke")
    assert abs(g.spin[0]) == pytest.approx(abs(spin), rel=1e-12)
    assert g.spin[0] * g.axis[0] == pytest.approx([spin, 0, 0], abs=1e-9)
    assert g.precession[0] == pytest.approx([0, 0, turn], abs=1e-12)
    assert g.couple[0] == pytest.approx([0, 0.05 * spin * turn, 0], abs=1e-9)
    assert g.exact[0] == pytest.approx(g.couple[0], abs=1e-9)
    assert g.bearing_force(0.4)[0] == pytest.approx(0.05 * 600 / 0.4, rel=1e-12)
    bearings = rotor("none", (0.0, 0.4), 4, 0.05, "[0, 0, 1]", turn, spin, BEARINGS)
    pair = [bearings.reaction(j, on="rotor")[0, 2] for j in ("A", "B")]
    assert pair == pytest.approx([0.05 * spin * turn / 0.4, -0.05 * spin * turn / 0.4], rel=1e-9)
