"""Exact figures: the classic engine, the slider that jams, the collar, the four contacts of a guide, superposition."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq, fsolve

import dalembert as da
from dalembert.analysis.friction.friction_circles import friction_circles
from dalembert.analysis.friction.joint_friction import guide_contact, joints_at_limit
from tests.friction.engines import GAS, collar, engine, engine_by_hand, guided, pushed_slider


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("circle", ["tan", "sin"])
@pytest.mark.parametrize("mu", [0.4, 0.05])
def test_the_engine(mu: float, circle: str, sense: int) -> None:
    r, hand = da.statics(engine(mu, circle, speed=float(sense))), engine_by_hand(sense, mu, circle)
    assert r.effort("O")[0] == pytest.approx(hand.effort, rel=1e-10)
    assert np.hypot(*r.reaction("A")[0]) == pytest.approx(hand.rod, rel=1e-10)
    assert r.ok.all()


def test_the_engine_arm_and_angle() -> None:
    r, hand = da.statics(engine()), engine_by_hand()
    circle = friction_circles(r, "A")
    line = circle.taken
    arm = line.point[0, 0] * line.direction[0, 1] - line.point[0, 1] * line.direction[0, 0]
    assert circle.radius == pytest.approx(0.024)
    # the arm to the line of the force on the crank's own friction circle: what is left of it is the torque
    assert abs(arm) - 0.028 == pytest.approx(-hand.effort / hand.rod, rel=1e-9)
    assert math.atan2(*line.direction[0, ::-1]) == pytest.approx(-hand.angle, rel=1e-9)


def test_the_engine_within_the_printed_figure() -> None:
    assert da.statics(engine()).effort("O")[0] == pytest.approx(-4484, rel=0.01)


@pytest.mark.parametrize("guide", [0.2, 0.11, 0.1, 0.08, 0.05, 0.02, 0.01])
def test_the_engine_with_a_guide_of_finite_length(guide: float) -> None:
    r, hand = da.statics(engine(guide=guide)), engine_by_hand(half=guide)
    assert r.effort("O")[0] == pytest.approx(hand.effort, rel=1e-10)
    contact = guide_contact(r, "guide")
    found = contact.normal[0], contact.couple[0], contact.lower[0], contact.upper[0]
    assert found == pytest.approx((hand.normal, hand.couple, hand.lower, hand.upper), rel=1e-9, abs=1e-6)
    assert contact.mode[0] == ("lower face" if guide > 0.105 else "lower ahead, upper behind")


def test_the_engine_at_rest_is_a_band() -> None:
    r = da.statics(engine(speed=0.0))
    assert r.status == ("at_rest",)
    ends = [engine_by_hand(-1), engine_by_hand(1)]
    assert r.interval("O")[0] == pytest.approx([end.effort for end in ends], rel=1e-10)
    assert np.isnan(r.effort("O")[0])
    low, high = r.ends[0]
    assert joints_at_limit(low) == joints_at_limit(high) == ("O", "A", "B", "guide")
    for end, hand in zip((low, high), ends, strict=True):
        assert np.hypot(*end.reaction("A")[0]) == pytest.approx(hand.rod, rel=1e-10)


def test_the_engine_at_rest_with_a_known_torque_is_a_band_of_loads() -> None:
    driving, driven = engine_by_hand(-1).effort, engine_by_hand(1).effort
    m = engine(
        speed=0.0,
        drives={"O": {"position": 50, "effort": driven}},
        loads={"gas": {"type": "force", "on": "piston", "at": "B", "value": "unknown", "direction": 180}},
    )
    r = da.statics(m)
    assert r.status == ("at_rest",)
    low, high = r.interval("gas")[0]
    assert low == pytest.approx(GAS * driven / driving, rel=1e-9)
    assert high == pytest.approx(GAS, rel=1e-9)


def test_coefficients_at_rest_beside_those_of_motion() -> None:
    m = engine(mu=0.3, speed=0.0, friction={"coefficient": 0.3, "static": 0.4, "circle": "tan"})
    ends = [engine_by_hand(sense).effort for sense in (-1, 1)]
    assert da.statics(m).interval("O")[0] == pytest.approx(ends, rel=1e-10)


@pytest.mark.parametrize(("mu", "force"), [(0.3, 202.0305), (0.9, 1414.2136), (0.999, 141421.3562)])
def test_a_rod_at_45_degrees_pushes_a_slider(mu: float, force: float) -> None:
    r = da.statics(pushed_slider(mu))
    assert r.unknown_load("rod")[0] == pytest.approx(100 / (math.cos(math.pi / 4) * (1 - mu)), rel=1e-9)
    assert r.unknown_load("rod")[0] == pytest.approx(force, rel=1e-6)
    assert r.friction.determinant[0] == pytest.approx(1 - mu, rel=1e-9)
    assert r.ok.all()


@pytest.mark.parametrize("mu", [1.001, 1.2, 2.0])
def test_a_rod_at_45_degrees_jams_above_1(mu: float) -> None:
    r = da.statics(pushed_slider(mu))
    assert r.status == ("jammed",)
    assert np.isnan(r.unknown_load("rod")[0])
    assert np.isnan(r.reaction("guide")[0]).all()
    (position,) = r.to_dict()["positions"]
    assert position["friction_force"]["guide"] == [None, None]
    assert (position["friction_moment"]["guide"], position["power_lost"]["guide"]) == (None, None)
    assert position["contact"]["guide"] == {"mode": None, "lower": None, "upper": None}
    assert r.friction.critical[0] == pytest.approx(1 / mu, rel=1e-9)
    assert da.efficiency(r).forward[0] == 0
    assert r.reasons[0] == (
        "Friction jams the mechanism at guide = 1 m: no effort moves it in this direction, whatever its size. "
        f"It would move with less than {1 / mu:.6g} times the coefficients of friction."
    )


@pytest.mark.parametrize(
    ("mu", "force", "ratio"), [(0.3, 108.7857, 1.3), (1.001, 70.6753, 2.001), (1.2, 64.2824, 2.2)]
)
def test_the_other_sense_stays_on_the_physical_branch(mu: float, force: float, ratio: float) -> None:
    r = da.statics(pushed_slider(mu, speed=-1.0))
    assert r.unknown_load("rod")[0] == pytest.approx(force, rel=1e-6)
    assert r.friction.determinant[0] == pytest.approx(ratio, rel=1e-9)


@pytest.mark.parametrize("e", [0.0, 0.03, 0.05, 0.1, 0.15, 0.2, 0.25])
def test_an_eccentric_collar(e: float) -> None:
    r = da.statics(collar(e))
    delivered = 100 * (1 - 2 * 0.25 * e / 0.1)
    assert -r.effort("bar")[0] == pytest.approx(delivered, abs=1e-9)
    assert r.status == (("self_locking",) if e > 0.2 else ("ok",))


@pytest.mark.parametrize(
    ("normal", "couple", "mode", "lower", "upper"),
    [
        (10.0, 0.2, "lower face", 10.0, 0.0),
        (-10.0, 0.2, "upper face", 0.0, 10.0),
        (2.0, 1.0, "lower ahead, upper behind", 11.0, 9.0),
        (2.0, -1.0, "lower behind, upper ahead", 11.0, 9.0),
        (10.0, 0.5, "lower face", 10.0, 0.0),
        (0.0, 1.0, "lower ahead, upper behind", 10.0, 10.0),
    ],
)
def test_the_four_contacts_of_a_guide(
    normal: float, couple: float, mode: str, lower: float, upper: float
) -> None:
    r = da.statics(guided(normal, couple, 0.05, 0.05))
    contact = guide_contact(r, "guide")
    assert (contact.lower[0], contact.upper[0]) == pytest.approx((lower, upper), rel=1e-12, abs=1e-12)
    assert r.effort("guide")[0] == pytest.approx(0.3 * (lower + upper), rel=1e-12)
    assert contact.mode[0] == mode or abs(abs(2 * couple / 0.1) - abs(normal)) < 1e-12


def test_the_faces_of_a_guide_make_a_couple() -> None:
    """Friction mu N on the lower face, 0.04 m below the pin, turns the block; a guide off its middle."""
    r = da.statics(guided(10.0, 0.0, 0.05, 0.15, half_height=0.04))
    faces = -0.3 * 0.04 * 10.0
    assert r.friction_moment("guide")[0] == pytest.approx(faces, rel=1e-12)
    tilt = abs(2 * -faces - 0.1 * 10.0) / 0.2
    assert r.effort("guide")[0] == pytest.approx(0.3 * max(10.0, tilt), rel=1e-12)


def test_two_circles_joined_by_a_link_need_an_internal_tangent() -> None:
    """A rod between circles of 24 and 16 mm transmits nothing where it is shorter than 40 mm."""
    for length in (0.03, 0.0399, 0.0401, 0.06):
        m = engine(0.4, loads={"gas": {"type": "force", "on": "piston", "at": "B", "value": [-100, 0]}})
        m = m.with_values(
            {"links.rod.points.B": (length, 0.0), "joints.guide.friction": None, "joints.O.friction": None}
        )
        m = m.with_values({"links.crank.points.A": (0.001, 0.0), "drives.O.position": 1.5})
        jams = da.statics(m).status == ("jammed",)
        assert jams == (length < 0.04), length


def loaded(gas: float, weight: float) -> float:
    """The engine's effort at 50 deg by hand, its rod loaded at 0.6 m: two equations for the force at B."""
    r, length, t = 0.3, 1.25, np.radians(50)
    beta = np.arcsin(r * np.sin(t) / length)

    def left(p: Any) -> Any:
        at_a = np.array([-p[0], weight - p[1]])
        couples = 0.024 * np.hypot(*at_a) + 0.016 * np.hypot(*p)
        about_a = length * (np.cos(beta) * p[1] + np.sin(beta) * p[0]) - 0.6 * np.cos(beta) * weight + couples
        return [-gas - p[0] + 0.07 * abs(p[1]), about_a]

    p = fsolve(left, [-gas, gas * np.tan(beta) + weight / 2], xtol=1e-12)
    x, y = -p[0], weight - p[1]
    return float(r * (np.cos(t) * y - np.sin(t) * x) + 0.052 * np.hypot(x, y))


def test_superposition_fails_and_scaling_holds() -> None:
    def torque(k: float, weight: float) -> float:
        gas = {"type": "force", "on": "piston", "at": "B", "value": [-GAS * k, 0]}
        w = {"type": "force", "on": "rod", "at": "W", "value": [0, -weight]}
        found = float(da.statics(engine(loads={"F": gas, "W": w})).effort("O")[0])
        assert found == pytest.approx(loaded(GAS * k, weight), rel=1e-9)
        return found

    both = torque(1, 8000)
    assert abs(both - torque(1, 0) - torque(0, 8000)) > 0.07 * abs(both)
    assert torque(2, 0) == pytest.approx(2 * torque(1, 0), rel=1e-12)
    assert torque(-1, 0) == pytest.approx(-engine_by_hand(-1).effort, rel=1e-9)


def test_superposition_is_refused() -> None:
    with pytest.raises(da.ModelError, match="friction"):
        da.superposition(da.statics(engine()))


def test_the_dead_band_around_the_dead_centres() -> None:
    """Self-locking from the dead centres to where the gas does not turn the crank any more."""
    for least, most, inwards in ((5, 20, -0.001), (160, 175, 0.001)):
        edge = brentq(lambda at: engine_by_hand(position=at).effort, least, most)
        assert da.statics(engine(position=edge + inwards)).status == ("self_locking",), edge
        assert da.statics(engine(position=edge - inwards)).status == ("ok",), edge


def test_a_guide_that_reverses_has_two_numbers() -> None:
    """Just before a dead centre and just after it, each the limit of the positions there."""
    r = da.statics(engine(position=0), strict=True)
    assert r.status == ("reversal",)
    assert r.ok.all()
    assert r.problems() == []
    aside = da.statics(engine(position=[-2e-5, -1e-5, 1e-5, 2e-5])).effort("O")
    before, after = 2 * aside[1] - aside[0], 2 * aside[2] - aside[3]
    assert r.effort("O")[0] == pytest.approx(before, rel=1e-10)
    assert r.after is not None
    assert r.after.effort("O")[0] == pytest.approx(after, rel=1e-10)
    assert r.interval("O")[0].tolist() == sorted([r.effort("O")[0], r.after.effort("O")[0]])
    assert r.reasons[0] == (
        "guide reverses at O = 0 deg, so friction in it changes sense: "
        f"O is {before:.6g} N*m just before and {after:.6g} N*m just after."
    )


@pytest.mark.parametrize("speed", [1.0, -1.0])
@pytest.mark.parametrize(("left", "status"), [(0.0, "ok"), (1e-4, "self_locking")])
def test_only_a_power_that_is_not_rounding_can_be_turned_round(
    left: float, status: str, speed: float
) -> None:
    """Loads along the slide that cancel but for what is left: rounding (0.1 + 0.2 - 0.3) drives nothing."""
    m = guided(10.0, 0.0, 0.05, 0.05).to_tree()
    m["drives"]["guide"]["speed"] = speed
    for k, pull in enumerate((0.1, 0.2, -0.3, left)):
        m["loads"][f"F{k}"] = {"type": "force", "on": "block", "at": "B", "value": [speed * pull, 0]}
    r = da.statics(da.mechanism(m))
    assert r.effort("guide")[0] * speed == pytest.approx(0.3 * 10 - left, rel=1e-12)
    assert r.status == (status,)
