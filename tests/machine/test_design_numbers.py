"""Numbers of machine design by name, against the answers that they are part of and closed forms."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.machine.flywheel.turning_moment import TurningMoment

PIN = {"diameter": "20 mm", "eye": "30 mm", "cheeks": "15 mm"}
SECTION = {
    "rectangle": ["20 mm", "40 mm"],
    "elasticity": "206 GPa",
    "endurance": "120 MPa",
    "ultimate": "500 MPa",
}


def crank(**values: Any) -> Any:
    m = da.slider_crank(crank=0.05, rod=0.2)
    return da.dynamics(m.with_values({k.replace("__", "."): v for k, v in values.items()}), positions=8)


def test_numbers_by_name_are_those_of_the_answers() -> None:
    r = crank(
        joints__A__pin=PIN,
        joints__A__clearance="0.01 mm",
        joints__B__clearance="0.02 mm",
        joints__B__bearing={"rating": "12 kN", "kind": "roller"},
        links__rod__section=SECTION,
    )
    force = np.hypot(*r.reaction("A").T)
    bending = force / 2 * (30e-3 / 4 + 15e-3 / 2) / (math.pi * 20e-3**3 / 32)
    shear = math.sqrt(3) * 4 / 3 * force / (2 * math.pi * 20e-3**2 / 4)
    assert r["pin_stress.A"] == pytest.approx(np.fmax(bending, shear))
    f = da.member_forces(r, "rod").stress().fatigue()
    assert r["fatigue.rod"] == pytest.approx(np.full(8, f.amplitude / 120e6 + max(f.mean, 0) / 500e6))
    slopes = da.member_forces(r, "rod").deflection().slopes()
    assert [*slopes] == ["A", "B"]
    assert r["bearing_slope.rod"] == pytest.approx(np.maximum(*slopes.values()))
    assert r["deflection.rod"] == pytest.approx(da.member_forces(r, "rod").deflection().greatest)
    assert r["life.B"] == pytest.approx(np.full(8, 3600 * da.bearing(r, "B").hours))
    play = da.clearance_error(r, "piston", "B")
    assert r["play.piston.B.x"] == pytest.approx(play.by_force[:, 0])
    assert r["play.piston.B.worst.x"] == pytest.approx(play.worst[:, 0])


def test_a_dead_link_has_no_fatigue() -> None:
    bare = {k: v for k, v in SECTION.items() if k not in ("endurance", "ultimate")}
    r = crank(links__rod__section=bare)
    with pytest.raises(ModelError, match=r"unknown quantity 'fatigue\.rod'"):
        r["fatigue.rod"]


@pytest.mark.parametrize("rough", [False, True])
def test_the_effort_at_any_speed_is_that_of_an_analysis_with_it(rough: bool) -> None:
    """With friction it is analysed anew; without it follows from the powers."""
    values: dict[str, Any] = {"loads.load.value": [-200, 30]}
    if rough:
        values["joints.guide.friction"] = {"coefficient": 0.2}
    m = da.slider_crank(crank=0.05, rod=0.2).with_values(values)
    t = TurningMoment(da.dynamics(m, positions=8))
    assert t.smooth != rough
    q = np.array([0.3, 1.1, 4.0])
    steady = t.steady(q)
    speed, acceleration = np.array([200.0, 300.0, 350.0]), np.array([1e4, -2e4, 500.0])
    found = t.effort(q, speed, acceleration)
    resistance = t.resistance(q, speed, acceleration)
    for k in range(3):
        states = [(t.speed, 0.0, steady[k]), (speed[k], acceleration[k], found[k])]
        for u, a, effort in states:
            at = {"position": float(q[k]), "speed": float(u), "acceleration": float(a)}
            one = m.model_copy(update={"drives": {"O2": m.drives["O2"].model_copy(update=at)}})
            assert effort == pytest.approx(da.dynamics(one).effort("O2")[0], rel=1e-9)
        slow = {"position": float(q[k]), "speed": 1e-6, "acceleration": 0.0}
        still = m.model_copy(update={"drives": {"O2": m.drives["O2"].model_copy(update=slow)}})
        if not rough:
            assert resistance[k] == pytest.approx(da.dynamics(still).effort("O2")[0], rel=1e-6)


def test_a_cycloidal_rise_has_its_closed_form() -> None:
    """s = h (x - sin(2 pi x) / 2 pi) of x = t / T, and its three derivatives."""
    rise = {"segments": [{"to": 0.025, "in": 0.2, "by": "cycloidal"}], "count": 41}
    links = {"ground": {"points": {"O": [0, 0]}}, "ram": {"points": {"F": [0, 0]}}}
    slide = {"S": {"type": "slider", "links": ["ground", "ram"], "at": ["O", "F"]}}
    law = da.law(da.mechanism({"links": links, "joints": slide, "drives": {"S": {"law": rise}}}), "S")
    h, whole = 0.025, 0.2
    x = np.linspace(0, 1, len(law.position))
    turn = 2 * math.pi * x
    assert law.position == pytest.approx(h * (x - np.sin(turn) / (2 * math.pi)), abs=1e-12)
    assert law.speed == pytest.approx(h / whole * (1 - np.cos(turn)), abs=1e-12)
    assert law.acceleration == pytest.approx(2 * math.pi * h / whole**2 * np.sin(turn), abs=1e-9)
    assert law.jerk == pytest.approx(4 * math.pi**2 * h / whole**3 * np.cos(turn), abs=1e-8)
    peaks = law.peak_speed, law.peak_acceleration, law.peak_jerk
    assert peaks == pytest.approx(
        (2 * h / whole, 2 * math.pi * h / whole**2, 4 * math.pi**2 * h / whole**3), rel=1e-9
    )


def test_the_pressure_of_a_cam_is_that_of_hertz() -> None:
    """p = sqrt(F E / (2 pi (1 - nu^2) b R)) of one material, with 1/R the sum of both curvatures."""
    m = da.disc_cam(positions=12)
    cam = da.cam(m, "F")
    joint: Any = m.joints["F"]
    width, elasticity, nu = 0.012, 200e9, joint.poisson

    def pressure(force: float, convex: float) -> float:
        curved = 1 / convex + 1 / joint.follower.roller
        return math.sqrt(force * elasticity * curved / (2 * math.pi * (1 - nu**2) * width))

    sharpest = cam.least_convex_radius - joint.follower.roller
    assert cam.hertz(width, elasticity, 500.0).pressure == pytest.approx(pressure(500.0, sharpest), rel=1e-9)
    turns = cam.turns_of(cam.result)
    each = [pressure(f, r) for f, r in zip(cam.force, cam.profile_radius(turns), strict=True) if f > 0]
    assert cam.hertz(width, elasticity).pressure == pytest.approx(max(each), rel=1e-9)
    assert cam.hertz(width).pressure == pytest.approx(max(each) * math.sqrt(206 / 200), rel=1e-9)
    with pytest.raises(ModelError, match="the width of cam 'F' is not known"):
        cam.hertz()
