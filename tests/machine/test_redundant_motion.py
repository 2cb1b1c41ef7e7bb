"""Motion under forces where constraints are redundant: accelerations and efforts are unique all the same."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import dalembert as da
from dalembert.errors import ModelError
from tests.machine.test_simulate import FOUR_BAR, simulated
from tests.random_space import random_case as space_case
from tests.random_space import tree as space_tree
from tests.tiers import tiers

CRANKS = """
gravity: standard
links:
  ground: {points: {O1: [0, 0], O2: [0.2, 0], O3: [0.1, %(offset)s]}}
  c1: {points: {O1: [0, 0], A: [0.05, 0]}, mass: 1 kg, inertia: 0.02 kg*m^2}
  c2: {points: {O2: [0, 0], B: [0.05, 0]}, mass: 0.8 kg, center: [0.02, 0], inertia: 0.004 kg*m^2}
  c3: {points: {O3: [0, 0], C: [0.05, 0]}, mass: 0.7 kg, center: [0.03, 0], inertia: 0.002 kg*m^2}
  coupler:
    points: {A: [0, 0], B: [0.2, 0], C: [0.1, %(offset)s]}
    mass: 1.2 kg
    center: [0.07, 0.01]
    inertia: 0.003 kg*m^2
joints:
  O1: {type: pin, links: [ground, c1]}
  A: {type: pin, links: [c1, coupler]}
  B: {type: pin, links: [coupler, c2]}
  O2: {type: pin, links: [ground, c2]}
  O3: {type: pin, links: [ground, c3]}
  C: {type: pin, links: [coupler, c3]%(rub)s}
drives: {O1: {effort: 0}}
start: {O1: {position: 60 deg, speed: 30 rad/s}}
assembly: {coupler: 0, c2: 60, c3: 60}
"""


def cranks(offset: float, rub: str = "") -> Any:
    """A coupler on three equal cranks, parallel."""
    return da.loads(CRANKS % {"offset": offset, "rub": rub})


def test_three_cranks_out_of_line_turn_like_a_pendulum() -> None:
    """J q'' = -(sum of m r) g cos q, where two cranks, or three in one line, have a change point."""
    s = da.simulate(cranks(0.08), "0.5 s", count=11)
    inertia = 0.02 + (0.004 + 0.8 * 0.02**2) + (0.002 + 0.7 * 0.03**2) + 1.2 * 0.05**2
    unbalance = 0.8 * 0.02 + 0.7 * 0.03 + 1.2 * 0.05
    known = solve_ivp(
        lambda _, y: [y[1], -unbalance * 9.80665 / inertia * math.cos(y[0])],
        (0, 0.5),
        [math.pi / 3, 30.0],
        method="DOP853",
        rtol=1e-12,
        atol=1e-12,
        t_eval=s.time,
    )
    assert s.position("O1") == pytest.approx(known.y[0], rel=1e-10)
    assert s.speed("O1")[-1] == pytest.approx(known.y[1, -1], rel=1e-10)
    assert set(s.result.status) == {"redundant"}
    assert max(s.energy_residual, s.law_residual) < 1e-9
    assert s.result.angle("c3") == pytest.approx(s.position("O1"), abs=1e-10)


def test_three_cranks_in_line_stop_where_they_can_go_on_in_two_ways() -> None:
    s = da.simulate(cranks(0.0), "1 s", tolerance=1e-8)
    assert "a dead centre or a change point" in s.ended
    assert s.position("O1")[-1] == pytest.approx(np.pi, abs=0.01)
    assert s.energy_residual < 1e-5


def test_many_motions_have_what_is_unique_of_redundant_machines() -> None:
    one = da.simulate(cranks(0.0), "0.03 s", count=3)
    asked = ["angle.c3.speed", "angle.coupler.acceleration"]
    found = da.compile_motion(cranks(0.0), "0.03 s", ["links.c3.mass"], asked, reduce="final")([[0.7], [0.9]])
    assert found.value("angle.c3.speed")[0] == pytest.approx(one.speed("O1")[-1], rel=1e-8)
    assert found.value("angle.c3.speed")[1] < one.speed("O1")[-1]
    with pytest.raises(
        ModelError, match=r"reaction.C.magnitude cannot be compiled: constraints are redundant"
    ):
        da.compile_motion(cranks(0.0), "0.03 s", ["links.c3.mass"], ["reaction.C.magnitude"])


def test_friction_that_follows_what_is_not_unique_is_refused() -> None:
    rub = ", friction: {coefficient: 0.1, radius: 5 mm}"
    with pytest.raises(ModelError) as refused:
        da.simulate(cranks(0.08, rub), "0.1 s")
    assert str(refused.value) == (
        "text:19: friction in C follows reactions that are not unique, as constraints are redundant: so neither the "
        "accelerations nor the efforts are; free a constraint, or leave that friction out"
    )


@pytest.mark.long
def test_friction_beside_redundant_joints_is_no_hindrance() -> None:
    """A pendulum hung on the coupler, with friction in its pin, which carries it alone."""
    text = CRANKS % {"offset": 0.08, "rub": ""}
    text = text.replace("C: [0.1, 0.08]}", "C: [0.1, 0.08], D: [0.1, 0]}").replace(
        "joints:",
        "  bob: {points: {D: [0, 0]}, mass: 1 kg, center: [0.1, 0], inertia: 0.01 kg*m^2}\njoints:\n"
        "  D: {type: pin, links: [coupler, bob], friction: {coefficient: 0.1, radius: 5 mm}}",
    )
    text = text.replace("effort: 0}}", "effort: 0}, D: {effort: 0}}")
    s = da.simulate(
        da.loads(text.replace("speed: 30 rad/s}}", "speed: 30 rad/s}, D: {position: -90 deg, speed: 0}}")),
        "0.3 s",
    )
    assert s.ended == "at 0.3 s"
    assert -s.works["friction"][-1] > 0
    assert max(s.energy_residual, s.law_residual) < 1e-9


@pytest.mark.long
def test_a_four_bar_of_revolutes_in_space_moves_as_in_its_plane() -> None:
    """Three constraints of the loop are redundant."""
    text = FOUR_BAR.replace("effort: 0", "position: 60 deg").replace(
        "start: {O2: {position: 60 deg, speed: 30 rad/s}}", ""
    )
    start = {"O2": {"position": "60 deg", "speed": "30 rad/s"}}
    plane = da.loads(text)
    one = da.simulate(plane, "0.1 s", start=start, count=5)
    other = da.simulate(da.lifted(plane, {"coupler": "20 mm"}), "0.1 s", start=start, count=5)
    assert other.position("O2") == pytest.approx(one.position("O2"), rel=1e-10)
    assert other.acceleration("O2") == pytest.approx(one.acceleration("O2"), rel=1e-8)
    assert max(other.energy_residual, other.law_residual) < 1e-9
    assert other.closure < 1e-12


PLANETS = """
gravity: none
links:
  ground: {points: {O: [0, 0]}}
  sun: {points: {O: [0, 0]}, mass: 1 kg, inertia: 0.01 kg*m^2}
  carrier:
    points: {O: [0, 0], P1: 60 mm @ 0 deg, P2: 60 mm @ 120 deg, P3: 60 mm @ 240 deg}
    mass: 1 kg
    inertia: 0.02 kg*m^2
"""


def planets(count: int) -> Any:
    """A sun wheel drives a carrier by planets that roll in a standing ring."""
    links, joints = (
        "",
        """joints:
  S: {type: pin, links: [ground, sun], at: [O, O]}
  C: {type: pin, links: [ground, carrier], at: [O, O]}
""",
    )
    teeth = ", pressure_angle: 20 deg"
    for k in range(1, count + 1):
        links += f"  p{k}: {{points: {{P{k}: [0, 0]}}, mass: 0.3 kg, inertia: 0.0005 kg*m^2}}\n"
        joints += f"""  P{k}: {{type: pin, links: [carrier, p{k}]}}
  M{k}: {{type: gear, links: [sun, p{k}], at: [O, P{k}], radii: [40 mm, 20 mm]{teeth}}}
  N{k}: {{type: gear, links: [ground, p{k}], at: [O, P{k}], radii: [80 mm, 20 mm], internal: true{teeth}}}
"""
    return da.loads(
        PLANETS + links + joints + "drives: {S: {effort: 5 N*m}}\nstart: {S: {position: 0, speed: 0}}\n"
    )


@pytest.mark.parametrize("count", tiers([3], [1]))
def test_planets_share_what_one_would_carry(count: int) -> None:
    """Two planets of three are redundant; the sun turns three times as fast as the carrier, a planet as fast."""
    s = da.simulate(planets(count), "1 s", count=3)
    planet = count * (0.0005 + 0.3 * 0.06**2) / 9
    assert s.result.speed("p1") == pytest.approx(-s.speed("S"))
    assert s.acceleration("S") == pytest.approx(
        5 / (0.01 + 0.02 / 9 + planet + count * 0.0005 * (1 - 1 / 9)), rel=1e-9
    )
    assert max(s.energy_residual, s.law_residual) < 1e-9


@pytest.mark.parametrize(
    "seed", tiers([34], [1, 27, 30, 37], [0, 12, 18, 19, 20, 22, 23, 25, 26, 39, 41, 43, 46, 51, 55])
)
def test_redundant_machines_in_space_ask_for_the_efforts_that_made_their_motion(seed: int) -> None:
    s = simulated(space_tree(space_case(seed)), 0.05)
    assert s.ended == "at 0.05 s"
    assert set(s.result.status) == {"redundant"}
    assert np.ptp(s.result.drive_position(s.drives[0])) > 1e-3
    assert max(s.law_residual, s.energy_residual) < 1e-9
