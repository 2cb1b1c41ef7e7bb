"""Followers that swing leave their cams, fly and land: against both motions written out and integrated by scipy."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import dalembert as da
from tests.tiers import tiers

FILE = """units: {length: mm, force: N, mass: kg, time: s, angle: deg}
links:
  ground: {points: {O: [0, 0], P: [-120, 60]}}
  cam: {points: {O: [0, 0]}, inertia: 0.004 kg*m^2}
  lever: {points: {P: [0, 0], F: [110, -10]}, mass: 0.8, center: [60, 0], inertia: 0.002 kg*m^2}
joints:
  O: {type: pin, links: [ground, cam]}
  P: {type: pin, links: [ground, lever]}
  F: {type: cam, links: [cam, lever], at: [O, F], follower: FOLLOWER, contact: {pushes: true, restitution: 0.4},
      profile: {base: 60, segments: [{to: 12 deg, in: 110, by: cycloidal}, {to: 0 deg, in: 120, by: cycloidal},
      {dwell: rest}]}}
drives: {O: {effort: 0}}
loads: {S: {type: torsion_spring, joint: P, stiffness: 20 N*m/rad, free_angle: -10}}
start: {O: {position: 0, speed: 130 rad/s}}
"""
CAM, LEVER, STIFFNESS, FREE, RESTITUTION = 0.004, 0.002 + 0.8 * 0.06**2, 20.0, math.radians(-10), 0.4


def lift(turn: float) -> tuple[float, float, float]:
    """Angle of the follower over its lowest one, and its two derivatives by the cam's turn."""
    height, up, down = (math.radians(x) for x in (12, 110, 120))
    turn %= 2 * math.pi
    if turn > up + down:
        return 0.0, 0.0, 0.0
    length, sign = (up, 1.0) if turn <= up else (down, -1.0)
    x = (turn if turn <= up else turn - up) / length
    w = 2 * math.pi
    value = x - math.sin(w * x) / w
    first, second = (1 - math.cos(w * x)) / length, w * math.sin(w * x) / length**2
    return height * (value if sign > 0 else 1 - value), sign * height * first, sign * height * second


@pytest.mark.parametrize("follower", tiers(["{roller: 10}"], ["flat", "knife"]))
def test_a_lever_jumps_off_its_cam_and_lands(follower: str) -> None:
    m = da.loads(FILE.replace("FOLLOWER", follower))
    s = da.simulate(m, until="0.04 s")
    lowest = float(s.result.angle("lever")[0])

    def moment(angle: float) -> float:
        return -STIFFNESS * (lowest + angle - FREE)

    def on(_: float, x: Any) -> list[float]:
        value, first, second = lift(x[0])
        push = (moment(value) - LEVER * second * x[1] ** 2) * first
        return [x[1], push / (CAM + LEVER * first**2)]

    def normal(t: float, x: Any) -> float:
        value, first, second = lift(x[0])
        return LEVER * (first * on(t, x)[1] + second * x[1] ** 2) - moment(value)

    def off(_: float, x: Any) -> list[float]:
        return [x[1], 0.0, x[3], moment(x[2]) / LEVER]

    def gap(_: float, x: Any) -> float:
        return float(x[2] - lift(x[0])[0])

    normal.terminal = gap.terminal = True  # type: ignore[attr-defined]
    gap.direction = -1  # type: ignore[attr-defined]
    exact = {"rtol": 1e-12, "atol": 1e-14, "method": "DOP853", "max_step": 1e-4}
    phase = solve_ivp(on, (0, 0.05), [0, 130], events=normal, **exact)
    expected, when, x = [phase.t[-1]], phase.t[-1], phase.y[:, -1]
    value, first, _ = lift(x[0])
    x = np.array([x[0], x[1], value, first * x[1]])
    phase = solve_ivp(off, (when, 0.2), x, events=gap, first_step=1e-6, **exact)
    when, x = phase.t[-1], phase.y[:, -1]
    first = lift(x[0])[1]
    rate = x[3] - first * x[1]
    impulse = -(1 + RESTITUTION) * rate / (1 / LEVER + first**2 / CAM)
    expected += [when, x[1] - impulse * first / CAM]
    landing = s.event("landing")[0]
    after = int(np.searchsorted(s.time, landing.time, side="right"))
    found = [s.event("lift-off")[0].time, landing.time, float(s.speed("O")[after])]
    assert found == pytest.approx(expected, rel=1e-8)
    assert s.energy_residual < 1e-9
    pushed = np.hypot(*s.result.reaction("F").T)
    assert s["normal.F"] == pytest.approx(pushed, abs=1e-9 * pushed.max())
    held = da.simulate(m.with_values({"joints.F.contact": "holds"}), "0.004 s").result
    on_cam = da.simulate(m, "0.004 s").result
    assert on_cam.force_array == pytest.approx(held.force_array, abs=1e-8 * pushed.max())
    assert on_cam.moment_array == pytest.approx(held.moment_array, abs=1e-8 * pushed.max())


def test_turns_of_a_lever_are_counted_from_zero_also_on_a_cam() -> None:
    """A torsion spring on a lever at almost half a turn, in an analysis as in a motion."""
    text = (
        FILE.replace("FOLLOWER", "{roller: 10}")
        .replace("[110, -10]", "[-110, 0]")
        .replace("[60, 0]", "[-60, 0]")
    )
    text = text.replace("base: 60", "base: 40")
    s = da.simulate(da.loads(text.replace("free_angle: -10", "free_angle: 150")), until="0.001 s")
    r = da.dynamics(da.loads(text.replace("{effort: 0}", "{position: 0, speed: 130 rad/s}")))
    assert 3 < s["turn.P"][0] < math.pi
    assert r["turn.P"][0] == pytest.approx(s["turn.P"][0], abs=1e-9)


RUBBING = """gravity: none
links:
  ground: {points: {O: [0, 0], top: [0, 0.3]}}
  cam: {points: {O: [0, 0]}, inertia: 0.05}
  stem: {points: {F: [0, 0]}, mass: 1.2}
joints:
  O: {type: pin, links: [ground, cam]}
  guide: {type: slider, links: [ground, stem], at: [O, F], direction: 90}
  F: {type: cam, links: [cam, stem], at: [O, F], follower: FOLLOWER, friction: {coefficient: 0.15},
      contact: {pushes: true, restitution: 0.4}, profile: {eccentric: 0.012, radius: 0.04}}
drives: {O: {effort: 0}}
loads: {S: {type: spring, between: [ground.top, stem.F], stiffness: 8000, free_length: 0.28}}
start: {O: {position: 0, speed: 150 rad/s}}
"""


@pytest.mark.parametrize("follower", tiers(["flat"], ["knife"]))
def test_a_follower_that_rubs_leaves_its_cam_and_lands(follower: str) -> None:
    """On the cam the normal force and the friction by Newton and Euler on both links, off it freely."""
    mass, inertia, e, radius, mu = 1.2, 0.05, 0.012, 0.04, 0.15

    def on(_: float, x: Any) -> tuple[float, float]:
        """Acceleration of the cam, and the normal force."""
        turn, rate = x[0], x[1]
        y, first, second = height(turn)
        normal = np.array([0.0, 1.0])
        if follower == "knife":
            normal = (np.array([0.0, y]) - e * np.array([math.cos(turn), math.sin(turn)])) / radius
        tangent = np.array([normal[1], -normal[0]])
        sliding = np.sign(np.array([rate * y, first * rate]) @ tangent)
        force = normal - mu * sliding * tangent  # of a unit normal force
        at = e * math.cos(turn) if follower == "flat" else 0.0
        moment = -(at * force[1] - y * force[0])
        system = [[inertia, -moment], [mass * first, -force[1]]]
        push = -8000 * (0.28 - (0.3 - y))
        alpha, n = np.linalg.solve(system, [0.0, push - mass * second * rate**2])
        return float(alpha), float(n)

    def height(turn: float) -> tuple[float, float, float]:
        s, c = e * math.sin(turn), e * math.cos(turn)
        if follower == "flat":
            return radius + s, c, -s
        q = math.sqrt(radius**2 - c * c)
        first = c * s / q
        return s + q, c + first, -s + (c * c - s * s - first * first) / q

    def normal(t: float, x: Any) -> float:
        return on(t, x)[1]

    def off(_: float, x: Any) -> list[float]:
        return [x[1], 0.0, x[3], -8000 * (0.28 - (0.3 - x[2])) / mass]

    def gap(_: float, x: Any) -> float:
        return float(x[2] - height(x[0])[0])

    normal.terminal = gap.terminal = True  # type: ignore[attr-defined]
    gap.direction = -1  # type: ignore[attr-defined]
    exact = {"rtol": 1e-12, "atol": 1e-14, "method": "DOP853"}
    phase = solve_ivp(lambda t, x: [x[1], on(t, x)[0]], (0, 0.05), [0, 150], events=normal, **exact)
    expected, when, x = [phase.t[-1]], phase.t[-1], phase.y[:, -1]
    y, first, _ = height(x[0])
    x = np.array([x[0], x[1], y, first * x[1]])
    phase = solve_ivp(off, (when, 0.2), x, events=gap, first_step=1e-6, **exact)
    expected += [phase.t[-1], height(phase.y[0, -1])[1] * phase.y[1, -1] - phase.y[3, -1]]
    s = da.simulate(da.loads(RUBBING.replace("FOLLOWER", follower)), until=f"{phase.t[-1] * 1.02} s")
    landing = s.event("landing")[0]
    assert [s.event("lift-off")[0].time, landing.time, landing.speed] == pytest.approx(expected, rel=1e-8)
    pushed = np.hypot(*s.result.reaction("F").T)
    assert pushed == pytest.approx(s["normal.F"] * math.hypot(1, mu), abs=1e-9 * pushed.max())
    assert s.energy_residual < 1e-9


@pytest.mark.parametrize("follower", tiers(["knife"], ["flat"]))
def test_a_lever_that_rubs_and_stays_is_as_if_it_were_held(follower: str) -> None:
    text = FILE.replace("FOLLOWER", f"{follower}, friction: {{coefficient: 0.12}}")
    pushes = da.simulate(da.loads(text), until="0.004 s").result
    text = text.replace("contact: {pushes: true, restitution: 0.4}", "contact: holds")
    holds = da.simulate(da.loads(text), until="0.004 s").result
    largest = np.abs(holds.force_array).max()
    assert pushes.force_array == pytest.approx(holds.force_array, abs=1e-8 * largest)
    assert pushes.moment_array == pytest.approx(holds.moment_array, abs=1e-8 * largest)


@pytest.mark.parametrize("mirrored", [False, True])
def test_a_torsion_spring_keeps_a_lever_on_its_cam(mirrored: bool) -> None:
    """Its moment P + k h has to exceed what stops the lever's rise, -J h'' w^2, at every position."""
    turn = "drives: {O: {position: {from: 0, to: 360, count: 36}, speed: 130 rad/s}}\n"
    text = re.sub("drives.*\nloads.*\nstart.*\n", turn, FILE.replace("FOLLOWER", "{roller: 10}"))
    assert "loads" not in text
    if mirrored:
        text = re.sub(
            r"P: \[-120", "P: [120", text.replace("[110, -10]", "[-110, -10]").replace("[60, 0]", "[-60, 0]")
        )
        text = (
            text.replace("speed: 130", "speed: -130")
            .replace("to: 360", "to: -360")
            .replace("12 deg", "-12 deg")
        )
    c = da.cam(da.loads(text), "F")
    value, _, bend = np.array([lift(x) for x in np.radians(np.linspace(0, 350, 36))]).T
    need = -LEVER * bend * 130**2
    stiffness, preload = c.spring_for(preload=1.0)
    on = value > 1e-9
    assert preload == 1.0
    assert stiffness == pytest.approx(((need - 1.0)[on] / value[on]).max(), rel=1e-9)
    soft, first = c.spring_for()
    assert (first + soft * value - need).min() == pytest.approx(0, abs=1e-9 * need.max())
    assert first + soft * value.max() <= 1.0 + stiffness * value.max()


def test_an_undercut_cam_of_a_flat_lever_names_no_endless_radius() -> None:
    """The radius that the face would need has a pole where the lift is steep: -3.7e48 mm."""
    steep = (
        FILE.replace("FOLLOWER", "flat")
        .replace("base: 60", "base: 30")
        .replace("to: 12 deg, in: 110", "to: 40 deg, in: 60")
    )
    with pytest.raises(da.ModelError) as caught:
        da.dynamics(da.loads(steep))
    where = "cam 'F' is undercut from 30 to 57 deg of its turn"
    assert caught.value.what == f"{where}: the outline that a flat face needs turns back on itself"
    assert caught.value.remedy == "take a smaller lift"
