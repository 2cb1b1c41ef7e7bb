"""Measures of cams: those of the mirror image, of formulas in the hand, and where nothing presses."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from tests.elements.test_cams import RISE
from tests.elements.test_cams import machine as cam_machine

HARMONIC = [
    {**RISE[0], "by": "harmonic"},
    {"dwell": "40 deg"},
    {"to": 0, "in": "60 deg", "by": "harmonic"},
    {"dwell": "rest"},
]
SPANS = {"rising": (0.0, math.pi / 2), "returning": (math.radians(130), math.pi / 3)}


def aside(offset: float, sense: str, follower: Any = None) -> da.CamDesign:
    """A harmonic cam whose follower's guide passes its axis at a distance; the return is steeper than the rise."""
    tree = cam_machine(follower or {"roller": "8 mm"}, HARMONIC, profile={"base": "52 mm", "sense": sense})
    tree["links"]["ground"]["points"]["E"] = [offset, 0]
    tree["joints"]["guide"]["at"] = ["E", "F"]
    return da.cam(da.mechanism(tree), "F", count=181)


@pytest.mark.parametrize("offset", [0.0, 0.012, -0.012])
def test_pressure_angles_of_an_offset_follower_are_those_of_the_formula_and_of_the_mirror_image(
    offset: float,
) -> None:
    """tan phi = (s' - e) / (sqrt(R^2 - e^2) + s), R = 60 mm; the larger of both signs counts."""
    there, back = aside(offset, "ccw"), aside(-offset, "cw")
    x = np.linspace(1e-8, 1 - 1e-8, 10_001)
    expected = {}
    for name, (start, length) in SPANS.items():
        sign = 1.0 if name == "rising" else -1.0
        share = (1 - sign * np.cos(math.pi * x)) / 2
        slope = sign * 0.01 * math.pi / length * np.sin(math.pi * x)
        phi = np.arctan((slope - offset) / (math.sqrt(0.06**2 - offset**2) + 0.02 * share))
        k = int(np.argmax(np.abs(phi)))
        expected[name] = float(np.abs(phi[k])), start + length * float(x[k])
    for c in (there, back):
        assert c.pressure_angle_peak == pytest.approx(expected["rising"][0], rel=1e-6)
        assert c.pressure_angle_peak_at == pytest.approx(expected["rising"][1], abs=1e-3)
        assert c.pressure_angle_return == pytest.approx(expected["returning"][0], rel=1e-6)
        assert np.degrees(c.jumps) == pytest.approx([0, 90, 130, 190])
        assert c.highest == pytest.approx((0.02, math.pi / 2), abs=1e-9)
    assert there.pressure_angle(0.7) == pytest.approx(back.pressure_angle(0.7), rel=1e-9)
    for name in ("least_convex_radius", "largest_roller"):
        assert getattr(there, name) == pytest.approx(getattr(back, name), rel=1e-9)


@pytest.mark.parametrize("sense", ["ccw", "cw"])
def test_the_acceleration_of_a_cam_jumps_up_and_down(sense: str) -> None:
    """A constant acceleration and a constant retardation: up at the start, down in the middle, up at its end."""
    parabola = [
        {"to": "20 mm", "in": "90 deg", "by": "parabolic"},
        {"dwell": "40 deg"},
        {"to": 0, "in": "110 deg", "by": "cycloidal"},
        {"dwell": "rest"},
    ]
    c = da.cam(da.mechanism(cam_machine({"roller": "8 mm"}, parabola, profile={"sense": sense})), "F")
    assert np.degrees(c.jumps) == pytest.approx([0, 45, 90])


def test_a_cam_on_which_nothing_lies_presses_with_no_force() -> None:
    tree = cam_machine({"roller": "8 mm"})
    del tree["loads"]
    tree["links"]["stem"].pop("mass")
    tree["gravity"] = "none"
    c = da.cam(da.mechanism(tree), "F")
    assert not c.force.any()
    with pytest.raises(da.ModelError, match="no force presses the follower on cam 'F' at any position"):
        c.hertz(0.01)
    known = c.hertz(0.01, force=500.0)
    inner = c.least_convex_radius - 0.008
    assert known == da.hertz_line(500.0, 0.01, (inner, 0.008))
