"""Motion under forces: published and derived cases through model files, an integrator of its own, and laws."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da

ROTOR = """
links:
  ground: {points: {O: [0, 0]}}
  rotor: {points: {O: [0, 0], C: [0, 0]}, mass: 1 kg, inertia: %s kg*m^2%s}
joints:
  O: {type: pin, links: [ground, rotor]}
%s
"""

BLOCK = """
gravity: standard
links:
  ground: {points: {O: [0, 0]}}
  block: {points: {O: [0, 0]}, mass: %s kg}
joints:
  S: {type: slider, links: [ground, block], at: [O, O], direction: 0 deg%s}
drives:
  S: {effort: 0}
start: {S: {position: %s m, speed: 0}}
loads:
  spring: {type: spring, between: [ground.W, block.O], stiffness: %s N/m, free_length: 10 m}
"""


def rotor(inertia: float, rest: str, link: str = "") -> Any:
    """A rotor on a pin."""
    return da.loads(ROTOR % (inertia, link, rest))


def test_flywheel_under_a_constant_torque() -> None:
    """Khurmi, example 16.2."""
    s = da.simulate(
        rotor(2500, "drives: {O: {effort: 1500 N*m}}\nstart: {O: {position: 0, speed: 0}}"), "10 s"
    )
    assert s.acceleration("O") == pytest.approx(0.6, rel=1e-12)
    assert s.kinetic[-1] == pytest.approx(45e3, rel=1e-10)
    assert s.works["O"][-1] == pytest.approx(45e3, rel=1e-10)


def test_run_up_with_a_straight_motor_curve() -> None:
    m = rotor(0.8, "drives: {O: {motor: {stall: 40 N*m, no_load: 150 rad/s}}}\nstart: {O: {position: 0}}")
    s = da.simulate(m, "2 s")
    assert s.speed("O")[-1] == pytest.approx(72.9874321451112, rel=1e-8)
    assert s.position("O")[-1] == pytest.approx(81.0377035646664, rel=1e-8)
    assert da.simulate(m, "O.speed = 142.5 rad/s").time[-1] == pytest.approx(8.987196820661973, rel=1e-8)
    assert max(s.energy_residual, s.law_residual, s.closure) < 1e-10


def test_bar_pendulum_of_large_swing() -> None:
    """Released 120 deg from hanging: quarter periods and the force at the lowest point."""
    m = da.loads(
        """
gravity: standard
links:
  ground: {points: {O: [0, 0]}}
  bar: {points: {O: [0, 0]}, mass: 2 kg, center: [0.5, 0], inertia: %.17g kg*m^2}
joints: {O: {type: pin, links: [ground, bar]}}
drives: {O: {effort: 0}}
start: {O: {position: 30 deg, speed: 0}}
"""
        % (2 / 12)
    )
    s = da.simulate(m, ["5 s", "O.speed = 0 rad/s"], events=["O.position = -90 deg"])
    assert 2 * s.time[-1] == pytest.approx(2.249088980405481, rel=1e-8)
    k = int(np.argmin(np.abs(s.time - s.event("condition")[0].time)))
    assert abs(s.speed("O")[k]) == pytest.approx(6.6430358270899, rel=1e-8)
    force = float(np.linalg.norm(s.result.reaction("O")[k]))
    assert force / (2 * 9.80665) == pytest.approx(3.25, rel=1e-8)


def test_block_on_a_spring_with_dry_friction_stops_after_whole_half_swings() -> None:
    text = BLOCK % (2, ", friction: {coefficient: 0.3}", 0.1, 800)
    m = da.loads(text.replace("ground: {points: {O: [0, 0]}}", "ground: {points: {O: [0, 0], W: [-10, 0]}}"))
    s = da.simulate(m, "2 s")
    assert len([e for e in s.events if e.name == "reversal"]) == 6
    (rest,) = [e for e in s.events if e.name == "rest"]
    assert rest.time == pytest.approx(1.0995574287564276, rel=1e-8)
    assert s.position("S")[-1] == pytest.approx(0.0029698249999999954, rel=1e-6)
    assert -s.works["friction"][-1] == pytest.approx(3.996472055787751, rel=1e-8)


def test_mass_spring_and_damper_released() -> None:
    text = BLOCK % (1, ", damping: 3 N*s/m", 0.02, 225)
    m = da.loads(text.replace("ground: {points: {O: [0, 0]}}", "ground: {points: {O: [0, 0], W: [-10, 0]}}"))
    s = da.simulate(m, "0.5 s", events=["S.speed = 0 m/s"])
    assert s.position("S")[-1] == pytest.approx(0.004483155319559936, rel=1e-8)
    assert s.position("S").min() == pytest.approx(-0.01458495228575342, rel=1e-8)
    assert s.energy_residual < 1e-9


def test_scotch_yoke_turning_free() -> None:
    m = da.loads("""
links:
  ground: {points: {O: [0, 0], G: [0, 0]}}
  crank: {points: {O: [0, 0], A: [0.08, 0]}, mass: 1 kg, inertia: 0.05 kg*m^2}
  yoke: {points: {G: [0, 0], A: [0, 0]}, mass: 3 kg}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: slot, links: [yoke, crank], direction: 90 deg}
  G: {type: slider, links: [ground, yoke], direction: 0 deg}
drives: {O: {effort: 0}}
start: {O: {position: 0, speed: 20 rad/s}}
""")
    s = da.simulate(m, ["1 s", "O.position = 360 deg"], events=["O.position = 90 deg", "O.position = 45 deg"])
    assert s.time[-1] == pytest.approx(0.34243556249505863, rel=1e-8)
    at = {e.sentence: int(np.argmin(np.abs(s.time - e.time))) for e in s.events}
    assert s.speed("O")[at["O.position = 90 deg"]] == pytest.approx(17.000510022951147, rel=1e-8)
    assert s.speed("O")[at["O.position = 45 deg"]] == pytest.approx(18.318582636182793, rel=1e-8)


def test_clutch_brings_two_rotors_to_one_speed() -> None:
    m = da.loads("""
links:
  ground: {points: {O: [0, 0]}}
  one: {points: {O: [0, 0]}, mass: 1 kg, inertia: 2 kg*m^2}
  two: {points: {O: [0, 0]}, mass: 1 kg, inertia: 3 kg*m^2}
joints:
  O: {type: pin, links: [ground, one]}
  C: {type: pin, links: [one, two], at: O}
drives:
  O: {effort: 0}
  C: {effort: 0, brake: 60 N*m}
start:
  O: {position: 0, speed: 100 rad/s}
  C: {position: 0, speed: -100 rad/s}
""")
    s = da.simulate(m, "3 s")
    assert s.speed("O")[-1] == pytest.approx(40, rel=1e-8)
    (rest,) = [e for e in s.events if e.name == "rest"]
    assert rest.time == pytest.approx(2.0, rel=1e-8)
    assert -s.works["brakes"][-1] == pytest.approx(6000, rel=1e-8)
    assert s.result.effort("C")[50] == pytest.approx(60.0)
    assert math.isclose(s.result.effort("C")[-1], 0.0, abs_tol=1e-9)
