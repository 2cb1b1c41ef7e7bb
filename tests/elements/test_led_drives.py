"""Drives that follow a law beside those that forces move; laws as expressions; ends of tables along a motion."""

from __future__ import annotations

import math

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from tests.tiers import tiers

CRANE = """
gravity: standard
links:
  ground: {points: {O: [0, 0]}}
  trolley: {points: {T: [0, 0]}, mass: 80}
  load: {points: {T: [0, 0], M: [0, -2.5]}, mass: 300, center: [0, -2.5]}
joints:
  rail: {type: slider, links: [ground, trolley], at: [O, T]}
  T: {type: pin, links: [trolley, load]}
drives: {rail: {law: %s}}
start: {T: {position: 0, speed: 0}}
"""
LAWS = (
    "{type: cycloidal, from: 0 m, to: 1 m, duration: 0.7 s, count: 5}",
    "{type: harmonic, from: 0 m, to: 1 m, duration: 0.7 s, count: 5}",
    "{type: table, time: [0 s, 0.3 s, 0.5 s, 1 s], position: [0 m, 0.2 m, 0.1 m, 0.6 m], count: 5}",
    "{segments: [{to: 0.2 m, in: 0.3 s, by: modified_sine}, {to: 0 m, in: 0.2 s, by: parabolic}], periodic: true}",
    "{expression: 0.1 m*sin(7 Hz*time)^2/(1 + exp(-time/(0.3 s)))}",
)


@pytest.mark.parametrize("law", tiers(LAWS[3:], LAWS[:3]))
def test_a_led_trolley_swings_its_load(law: str) -> None:
    """Work of the drive = energy of both; the effort is the whole mass times acceleration, along the rail."""
    s = da.simulate(da.loads(CRANE % law), "1 s", count=41)
    assert s.status == "ended"
    assert max(s.energy_residual, s.law_residual, s.closure) < 1e-10
    a = s.result.acceleration_array[:, s.result.links.index("load"), :1]
    center = s.result["point.load.center.acceleration"][:, 0]
    assert a.shape == (41, 1)
    assert s.result.effort("rail") == pytest.approx(80 * s.acceleration("rail") + 300 * center, abs=1e-9)


def test_an_expression_has_its_speed_and_acceleration() -> None:
    law = da.loads(CRANE % LAWS[-1].replace("}", ", duration: 1 s, count: 11}")).drives["rail"].law
    assert law is not None
    t, s, v, a = law.motion(100_001)
    h = t[1] - t[0]
    assert v[1:-1] == pytest.approx((s[2:] - s[:-2]) / (2 * h), abs=1e-8)
    assert a[1:-1] == pytest.approx((v[2:] - v[:-2]) / (2 * h), abs=1e-7)
    m = da.loads(CRANE % LAWS[-1])
    assert da.loads(str(m)) == m
    assert da.mechanism(m.model_dump(mode="json")) == m


@pytest.mark.parametrize(
    ("law", "words"),
    [
        ("{expression: 1 m*abs(time/(1 s))}", "a law with abs has no acceleration everywhere"),
        ("{expression: 1 m*sin(T)}", "the law depends on T; write law: {expression: 20 mm"),
        ("{expression: 1 m}", "the law does not depend on time"),
        (
            "{expression: 1 m*time/(1 s), count: 3}",
            "a count is given without a duration; write duration: 1 s",
        ),
        ("{expression: 1 deg*time/(1 s)}", "angle"),
    ],
)
def test_laws_that_make_no_sense(law: str, words: str) -> None:
    with pytest.raises(ModelError) as raised:
        da.loads(CRANE % law)
    assert words in str(raised.value)


def test_a_law_over_another_drive_is_refused_in_motion() -> None:
    m = da.loads(
        CRANE % "{over: T, segments: [{to: 1 m, in: 90 deg, by: cycloidal}, {dwell: rest}], periodic: false}"
    )
    with pytest.raises(
        ModelError, match="the law of drive 'rail' is over another drive, and forces move the machine"
    ):
        da.simulate(m, "1 s")


def test_the_end_of_a_table_is_an_event() -> None:
    """2 N to 4 N over 0.5 m, constant beyond: v^2 there from the area."""
    s = da.simulate(
        da.loads("""
links: {ground: {points: {O: [0, 0]}}, b: {points: {B: [0, 0]}, mass: 2}}
joints: {S: {type: slider, links: [ground, b], at: [O, B]}}
loads:
  F: {type: force, on: b, at: B, direction: 0, value: {against: S, x: [0 m, 0.5 m], y: [2 N, 4 N], outside: hold}}
start: {S: {position: 0, speed: 0.1}}
"""),
        "2 s",
        count=5,
    )
    (end,) = s.event("table end")
    assert end.sentence == "load 'F' is beyond the end of its table from here on"
    k = int(np.flatnonzero(s.time == end.time)[0])
    assert s.position("S")[k] == pytest.approx(0.5, rel=1e-9)
    assert s.speed("S")[k] == pytest.approx(math.sqrt(0.01 + 1.5), rel=1e-9)


LED_ONCE = """links:
  ground: {points: {O: [0, 0], S: [1, 0]}}
  a: {points: {O: [0, 0]}}
  b: {points: {S: [0, 0]}}
joints:
  O: {type: pin, links: [ground, a]}
  S: {type: slider, links: [ground, b]}
drives:
  O: {position: [-30, -1, 0, 30, 45, 90, 91, 400], speed: SPEED rad/s, acceleration: 3 rad/s^2}
  S: {law: {over: O, segments: [{to: 25 mm, in: 90 deg, by: harmonic}], periodic: false}}
"""


@pytest.mark.parametrize("speed", [2.0, -2.0])
def test_a_law_that_is_gone_through_once_rests_before_and_behind(speed: float) -> None:
    """s = h/2 (1 - cos 2 th); where it begins and ends the acceleration has two values, before and after."""
    r = da.kinematics(da.loads(LED_ONCE.replace("SPEED", str(speed))))
    th = np.clip(r.drive("O"), 0, math.pi / 2)
    assert r.drive("S") == pytest.approx(0.0125 * (1 - np.cos(2 * th)), abs=1e-15)
    assert r.drive("S", "speed") == pytest.approx(0.025 * np.sin(2 * th) * speed, abs=1e-15)
    bend = 0.05 * np.cos(2 * th) * speed**2 + 0.025 * np.sin(2 * th) * 3
    for side, ahead in ((r.before, False), (r.after, True)):
        moves = np.array([False, False, (speed > 0) == ahead, True, True, (speed < 0) == ahead, False, False])
        assert side is not None
        assert side.drive("S", "acceleration") == pytest.approx(np.where(moves, bend, 0.0), abs=1e-15)
