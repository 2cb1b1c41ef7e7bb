"""Loads and efforts with corners and jumps under forces, against an integration of its own with the same events."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import dalembert as da

G, MASS, ARM, J = 9.80665, 2.0, 0.5, 0.7
BAR = """
gravity: {gravity}
links: {{ground: {{points: {{O: [0, 0]}}}}, bar: {{points: {{O: [0, 0]}}, mass: 2, center: [0.5, 0], inertia: 0.2}}}}
joints: {{O: {{type: pin, links: [ground, bar]}}}}
drives: {{O: {{{drive}}}}}
{load}
start: {{O: {{position: {q} deg, speed: {u} rad/s}}}}
"""


def bar(
    load: str = "", drive: str = "effort: 0", q: float = -10, u: float = 2, gravity: str = "standard"
) -> Any:
    """A bar on a pin with a couple."""
    loads = f"loads: {{f: {{type: couple, on: bar, value: {json.dumps(load)}}}}}" if load else ""
    return da.loads(BAR.format(load=loads, drive=drive, q=q, u=u, gravity=gravity))


def own_motion(
    torque: Callable[[float, float, list[float]], float],
    switches: list[Callable[[float, float], float]],
    start: tuple[float, float],
    end: float,
    step: float = 0.01,
) -> np.ndarray:
    """State at the end: torque by the sides of all switches, each passed by an event of scipy's."""
    t, y = 0.0, np.array(start)

    def sides_at(t: float, y: np.ndarray) -> list[float]:
        ahead = y + 1e-9 * np.array([y[1], 0.0])
        return [1.0 if s(ahead[0], t + 1e-9) > 0 else -1.0 for s in switches]

    while t < end:
        sides = sides_at(t, y)

        def rate(t: float, y: np.ndarray, sides: list[float] = sides) -> list[float]:
            return [y[1], (torque(y[0], t, sides) - MASS * G * ARM * math.cos(y[0])) / J]

        def passed(s: Callable[[float, float], float], side: float) -> Any:
            def event(now: float, state: np.ndarray) -> float:
                return s(state[0], now) * side + 1e-13

            event.terminal, event.direction = True, -1  # type: ignore[attr-defined]
            return event

        events = [passed(s, side) for s, side in zip(switches, sides, strict=True)]
        found = solve_ivp(
            rate, (t, end), y, method="DOP853", rtol=1e-12, atol=1e-13, events=events, max_step=step
        )
        t, y = float(found.t[-1]), found.y[:, -1]
    return y


def test_a_load_that_jumps_with_a_position_is_met_as_an_event() -> None:
    """The issue's case; and on the other side of a load by a freedom of a joint, by time and of an effort."""
    known = own_motion(lambda q, t, s: -20 * s[0], [lambda q, t: q], (math.radians(-10), 2.0), 3.0)
    assert known == pytest.approx([-0.144951, -2.207288], abs=1e-6)
    for m in (
        bar("-20*sign(O) N*m"),
        bar("-20*sign(joints.O.turn) N*m"),
        bar(drive="effort: -20*sign(O) N*m"),
    ):
        s = da.simulate(m, "3 s")
        assert s.ended == "at 3 s"
        assert [s.position("O")[-1], s.speed("O")[-1]] == pytest.approx(known, rel=1e-8)
        assert max(s.energy_residual, s.law_residual) < 1e-9
        assert s.doubt == ""


LOADS = [
    ("-20*sign(O) - 3*sign(O - 0.1) N*m", lambda q, t, s: -20 * s[0] - 3 * s[1], [0.0, 0.1]),
    (
        "-30 N*m*(O >= -0.05 rad) - 10 N*m*(O < 0.02 rad)",
        lambda q, t, s: -30 * (s[0] > 0) - 10 * (s[1] < 0),
        [-0.05, 0.02],
    ),
    ("30*abs(O) N*m", lambda q, t, s: 30 * s[0] * q, [0.0]),
    ("max(0, -90*O) N*m", lambda q, t, s: -90 * q if s[0] < 0 else 0.0, [0.0]),
    (
        "min(2, -60*O) + 1/exp(O)^2 N*m",
        lambda q, t, s: (2 if s[0] < 0 else -60 * q) + math.exp(-2 * q),
        [-1 / 30],
    ),
]


@pytest.mark.parametrize(("text", "torque", "places"), LOADS)
def test_corners_of_all_functions_are_met(text: str, torque: Any, places: list[float]) -> None:
    known = own_motion(torque, [lambda q, t, x=x: q - x for x in places], (math.radians(-10), 2.0), 1.2)
    s = da.simulate(bar(text), "1.2 s")
    assert [s.position("O")[-1], s.speed("O")[-1]] == pytest.approx(known, rel=1e-8)
    assert max(s.energy_residual, s.law_residual) < 1e-9
    assert s.doubt == ""


def test_corners_of_a_table_over_a_position_and_of_time_are_met() -> None:
    table = {"against": "O", "x": [-180, -20, 10, 180], "y": [4, 9, -6, 2]}
    x, y = np.radians(table["x"]), np.array(table["y"], float)
    known = own_motion(
        lambda q, t, s: float(np.interp(q, x, y)),
        [lambda q, t, p=p: q - p for p in x[1:-1]],
        (math.radians(-10), 2.0),
        1.2,
    )
    s = da.simulate(_with_table(table), "1.2 s")
    assert [s.position("O")[-1], s.speed("O")[-1]] == pytest.approx(known, rel=1e-8)
    assert s.law_residual < 1e-9
    switched = own_motion(lambda q, t, s: 6.0 * s[0], [lambda q, t: t - 0.37], (math.radians(-10), 2.0), 1.2)
    s = da.simulate(bar("6*sign(time - 0.37) N*m"), "1.2 s")
    assert [s.position("O")[-1], s.speed("O")[-1]] == pytest.approx(switched, rel=1e-8)


def _with_table(table: dict[str, Any]) -> Any:
    tree = bar("1 N*m").to_tree()
    tree["loads"]["f"]["value"] = table
    return da.mechanism(tree)


def test_a_corner_passed_twice_within_a_step_is_not_stepped_over() -> None:
    """The bar comes just beyond the corner and back: 1e-5 rad, for far less than a step's time."""
    top = math.sqrt(2 * (math.sin(1e-5) - math.sin(math.radians(-10))) * MASS * G * ARM / J)
    known = own_motion(
        lambda q, t, s: -40.0 if s[0] > 0 else 0.0, [lambda q, t: q], (math.radians(-10), top), 0.5, 1e-4
    )
    s = da.simulate(bar("-20 - 20*sign(O) N*m", u=top), "0.5 s")
    assert [s.position("O")[-1], s.speed("O")[-1]] == pytest.approx(known, rel=1e-7)
    assert s.doubt == ""


def test_a_jump_that_holds_the_machine_is_named() -> None:
    s = da.simulate(bar(drive="effort: -15*sign(O.speed) N*m"), "20 s")
    assert s.status == "stopped"
    assert "jumps with a speed and pushes back from both sides, as dry friction" in s.ended
    assert s.speed("O")[-1] == pytest.approx(0, abs=1e-9)
    with pytest.raises(
        da.ModelError, match="load 'f' jumps at this state and pushes back from both sides: it holds"
    ):
        da.simulate(bar("-20*sign(O) N*m", q=0, u=0), "20 s")


@pytest.mark.parametrize("until", ["O.position = 400 deg", "O.speed = 90 rad/s"])
def test_a_condition_that_is_never_met_ends_with_what_there_is(until: str) -> None:
    s = da.simulate(bar(), until, steps=300)
    assert s.status == "not_met"
    assert s.ended.startswith(f"{until} is not met within 300 steps, to ")
    assert len(s.time) > 250
    assert s.event("not met")
    assert s.energy_residual < 1e-9
    assert da.simulate(bar(), [until, "0.5 s"], steps=1).ended == "at 0.5 s"


def test_what_coasts_or_rests_does_not_go_on_for_ever() -> None:
    s = da.simulate(bar(gravity="none"), "O.speed = 3 rad/s", steps=400)
    assert s.status == "not_met"
    assert np.isfinite(s.time).all()
    assert s.position("O")[-1] == pytest.approx(math.radians(-10) + 2 * s.time[-1], rel=1e-12)
    s = da.simulate(bar(drive="effort: 0, brake: 3 N*m"), "O.position = 400 deg")
    assert s.status == "not_met"
    assert s.ended.endswith("s on, and no force moves it any more: O.position = 400 deg is not met")
    pulled = bar("30*max(0, time - 9) N*m", drive="effort: 0, brake: 3 N*m")
    s = da.simulate(pulled, "O.position = 400 deg")
    assert s.ended.startswith("O.position = 400 deg at ")
    assert s.time[-1] > 9


def test_an_interrupt_keeps_what_there_is(monkeypatch: pytest.MonkeyPatch) -> None:
    from dalembert.machine.motion.integration import Integration

    meet, calls = Integration._segment, iter(range(3))

    def interrupted(self: Any, t: float, y: Any) -> Any:
        if next(calls) == 1:
            raise KeyboardInterrupt
        return meet(self, t, y)

    monkeypatch.setattr(Integration, "_segment", interrupted)
    s = da.simulate(bar("-20*sign(O) N*m"), "3 s")
    assert s.status == "interrupted"
    assert s.ended.startswith("interrupted at 0.0")
    assert len(s.time) > 3
    assert s.law_residual < 1e-9


def test_the_brake_of_a_prescribed_drive_is_refused_and_in_analyses_named() -> None:
    two = """
gravity: standard
links:
  ground: {points: {O: [0, 0], P: [1, 0]}}
  a: {points: {O: [0, 0]}, mass: 1, inertia: 1}
  b: {points: {P: [0, 0]}, mass: 1, inertia: 1}
joints: {O: {type: pin, links: [ground, a]}, P: {type: pin, links: [ground, b]}}
drives: {O: {effort: 1}, P: {position: 0, speed: 2 rad/s, brake: 3 N*m}}
start: {O: {position: 0, speed: 0}}
"""
    with pytest.raises(
        da.ModelError, match=r"^text:\d+: .*drive 'P' is prescribed, and its brake would have no effe"
    ):
        da.simulate(da.loads(two), "1 s")
    r = da.dynamics(da.loads(two.replace("{effort: 1}", "{position: 9 deg, stops: {to: 5 deg}}")))
    assert "the effort is the moment of motor and brake together" in r.assumptions["brake of P"]
    assert (
        r.assumptions["stops of O"] == "not counted: 1 of 1 positions is beyond them, where a stop would push"
    )
    assert "start of O" in r.assumptions
    within = da.loads(two.replace("{effort: 1}", "{position: 9 deg, stops: {to: 9 deg}}"))
    assert "stops of O" not in da.dynamics(within).assumptions
