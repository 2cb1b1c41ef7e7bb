"""Motions through dead centres of the drives that are let go: other freedoms lead on there."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import dalembert as da
from dalembert.analysis.result.joint_freedoms import freedom_motion
from dalembert.bundled import examples
from tests.machine.test_simulate import simulated
from tests.random_mechanisms import random_case
from tests.tiers import tiers

SLIDER_CRANK = """
units: {length: m, angle: deg}
gravity: %s
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [0.05, 0]}, mass: 2, center: [0.01, 0], inertia: 0.01}
  rod: {points: {A: [0, 0], B: [0.2, 0]}, mass: 0.5, center: [0.08, 0], inertia: 0.002}
  piston: {points: {B: [0, 0]}, mass: 0.8}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, piston]}
  guide: {type: slider, links: [ground, piston], at: [O, B], direction: 0 deg}
drives: %s
start: %s
assembly: {crank: 60, rod: -15}
"""

FIVE_BAR = """
units: {length: m, angle: deg}
gravity: standard
links:
  ground: {points: {O: [0, 0], C: [0.2, 0]}}
  a: {points: {O: [0, 0], A: [0.3, 0]}, mass: 1, center: [0.15, 0], inertia: 0.01}
  b: {points: {A: [0, 0], B: [0.4, 0]}, mass: 1, center: [0.2, 0.01], inertia: 0.02}
  c: {points: {D: [0, 0], B: [0.4, 0]}, mass: 1, center: [0.15, 0], inertia: 0.01}
  d: {points: {C: [0, 0], D: [0.3, 0]}, mass: 1, center: [0.15, 0], inertia: 0.01}
joints:
  O: {type: pin, links: [ground, a]}
  A: {type: pin, links: [a, b]}
  B: {type: pin, links: [b, c]}
  D: {type: pin, links: [c, d]}
  C: {type: pin, links: [ground, d]}
drives: {O: {effort: 0}, C: {effort: 0}}
start: {O: {position: 120, speed: 3 rad/s}, C: {position: 40, speed: 0}}
assembly: {b: 40, c: 140}
"""


def changes(s: da.Simulation) -> int:
    return len(s.event("coordinates"))


def crank_state(s: da.Simulation) -> tuple[float, float]:
    """Angle and speed of the crank at the start."""
    return float(s.result.angle("crank")[0]), float(s.result.twist_array[0, 0, -1])


def led_by_its_piston(effort: str) -> da.Simulation:
    start = "{guide: {position: 0.22, speed: 1 m/s}}"
    s = da.simulate(da.loads(SLIDER_CRANK % ("none", f"{{guide: {effort}}}", start)), "1 s")
    assert changes(s) == 1
    assert set(s.result.status) == {"ok"}
    assert max(s.energy_residual, s.law_residual, s.closure) < 1e-8
    return s


def test_a_piston_that_leads_goes_through_its_dead_centres() -> None:
    """The same motion as with the crank as the coordinate."""
    s = led_by_its_piston("{effort: 0 N}")
    q, u = crank_state(s)
    start = f"{{O: {{position: {q} rad, speed: {u} rad/s}}}}"
    o = da.simulate(da.loads(SLIDER_CRANK % ("none", "{O: {effort: 0}}", start)), "1 s")
    same, a, b = np.intersect1d(s.time.round(12), o.time.round(12), return_indices=True)
    assert len(same) == 201
    assert s.position("guide")[a] == pytest.approx(o.result.point("piston", "B")[b, 0], abs=1e-10)
    assert s.result.reaction("A")[a] == pytest.approx(o.result.reaction("A")[b], abs=1e-6)


def test_the_motor_of_a_piston_gives_on_what_it_gives() -> None:
    """50 N less 50/3 N s/m times the piston's speed, over its way, is the energy gained."""
    s = led_by_its_piston("{motor: {stall: 50 N, no_load: 3 m/s}}")
    given = (50 - 50 / 3 * s.speed("guide")) * s.speed("guide")
    assert s.kinetic[-1] - s.kinetic[0] == pytest.approx(CubicSpline(s.time, given).integrate(0, 1), rel=1e-5)


@pytest.mark.long
def test_an_effort_with_corners_is_followed_while_its_drive_is_led() -> None:
    """A spring that only pulls, on the piston: the energy gained is the loss of its own, at every instant."""
    s = led_by_its_piston('{effort: "max(0, 2000*(0.21 - guide)) N"}')
    x = s.position("guide")
    stored = 1000 * np.maximum(0.0, 0.21 - x) ** 2
    assert np.ptp(stored) > 1
    assert s.applied[:, 0] == pytest.approx(np.maximum(0.0, 2000 * (0.21 - x)), abs=1e-9)
    assert s.doubt == ""
    assert s.kinetic + stored == pytest.approx(np.full(len(x), s.kinetic[0] + stored[0]), abs=1e-8)


def test_a_condition_of_a_drive_that_is_led() -> None:
    start = "{guide: {position: 0.22, speed: 1 m/s}}"
    m = da.loads(SLIDER_CRANK % ("none", "{guide: {effort: 0 N}}", start))
    s = da.simulate(m, ["1 s", "guide.position = 0.16 m"])
    assert changes(s) == 1
    assert s.ended.startswith("guide.position = 0.16 m")
    assert s.position("guide")[-1] == pytest.approx(0.16, abs=1e-12)


@pytest.mark.long
def test_two_drives_tumble_with_a_five_bar() -> None:
    """Both are left and taken up again: energy stays, the found motion asks for no efforts."""
    s = da.simulate(da.loads(FIVE_BAR), "1.2 s")
    assert changes(s) >= 4
    assert max(s.energy_residual, s.law_residual) < 1e-8
    assert s.closure < 1e-12


@pytest.mark.long
def test_a_lifted_machine_goes_through_its_dead_centre_too() -> None:
    """In space its crank leads as in the plane, and its forces are the same."""
    m = da.loads(
        SLIDER_CRANK % ("none", "{guide: {effort: -40*time}}", "{guide: {position: 0.22, speed: -1}}")
    )
    flat, lifted = (da.simulate(x, "0.12 s", count=3) for x in (m, da.lifted(m)))
    assert [changes(flat), changes(lifted)] == [1, 1]
    assert lifted.events[0].time == pytest.approx(flat.events[0].time, rel=1e-3)
    assert lifted.position("guide")[-1] == pytest.approx(flat.position("guide")[-1], rel=1e-8)
    assert lifted.result.reaction("A")[-1, :2] == pytest.approx(flat.result.reaction("A")[-1], rel=1e-6)


@pytest.mark.long
def test_in_space_a_rocker_leads() -> None:
    text = Path(examples()["rssr"]).read_text(encoding="utf-8").partition("loads:")[0]
    driven = "  O: {position: {from: 0, to: 360, count: 36}, speed: 300 rpm}"
    rocker = "  C: {effort: 0}\nstart: {C: {position: -10 deg, speed: -8 rad/s}}"
    s = da.simulate(da.loads(text.replace(driven, rocker)), "0.5 s")
    assert changes(s) == 1
    turn, speed, _ = freedom_motion(s.result, "O", "turn")
    crank = f"  O: {{effort: 0}}\nstart: {{O: {{position: {turn[0]} rad, speed: {speed[0]} rad/s}}}}"
    o = da.simulate(da.loads(text.replace(driven, crank)), "0.5 s")
    same, a, b = np.intersect1d(s.time.round(12), o.time.round(12), return_indices=True)
    assert len(same) == 201
    assert s.position("C")[a] == pytest.approx(freedom_motion(o.result, "C", "turn")[0][b], abs=1e-10)
    assert s.result.reaction("A")[a] == pytest.approx(o.result.reaction("A")[b], abs=1e-6)


@pytest.mark.parametrize("seed", tiers([], [57, 63]))
def test_random_mechanisms_go_on(seed: int) -> None:
    s = simulated(random_case(seed).tree, 0.6)
    assert changes(s) >= 1
    assert not s.ended.startswith("stopped")
    assert max(s.energy_residual, s.law_residual, s.closure) < 1e-8


def test_with_friction_it_ends_there() -> None:
    """Its forces near the dead centre do not follow from the drive's motion: the friction there locks it."""
    start = "{guide: {position: 0.22, speed: 2 m/s}}"
    text = SLIDER_CRANK % ("none", "{guide: {effort: 0 N}}", start)
    rough = "friction: {coefficient: 0.1, radius: 5 mm}}\n  B"
    s = da.simulate(da.loads(text.replace("}\n  B", f", {rough}")), "0.4 s", tolerance=1e-10)
    assert "stopped" in s.ended
    assert changes(s) == 0
