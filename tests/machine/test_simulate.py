"""Motion under forces: published and derived cases through model files, an integrator of its own, and laws."""

from __future__ import annotations

import math
import re
from copy import copy, deepcopy
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import dalembert as da
from dalembert.errors import ModelError
from dalembert.model.drives.end_stops import Stops
from tests.random_mechanisms import random_case
from tests.random_space import random_case as space_case
from tests.random_space import tree as space_tree
from tests.tiers import tiers

ROTOR = """
links:
  ground: {points: {O: [0, 0]}}
  rotor: {points: {O: [0, 0], C: [0, 0]}, mass: 1 kg, inertia: %s kg*m^2%s}
joints:
  O: {type: pin, links: [ground, rotor]}
%s
"""


def rotor(inertia: float, rest: str, link: str = "") -> Any:
    """A rotor on a pin."""
    return da.loads(ROTOR % (inertia, link, rest))


def test_run_up_with_a_straight_motor_curve() -> None:
    m = rotor(0.8, "drives: {O: {motor: {stall: 40 N*m, no_load: 150 rad/s}}}\nstart: {O: {position: 0}}")
    s = da.simulate(m, "2 s")
    assert s.speed("O")[-1] == pytest.approx(72.9874321451112, rel=1e-8)
    assert s.position("O")[-1] == pytest.approx(81.0377035646664, rel=1e-8)
    assert da.simulate(m, "O.speed = 142.5 rad/s").time[-1] == pytest.approx(8.987196820661973, rel=1e-8)
    assert max(s.energy_residual, s.law_residual, s.closure) < 1e-10
    assert not s.doubt
    assert "Check failed" not in str(s)
    doubtful = copy(s)
    vars(doubtful).update(law_gap=np.where(s.time > 1.985, 1e-3, 0.0), energy_residual=2e-5)
    assert doubtful.law_residual == 1e-3
    assert doubtful.doubt == (
        "at 1.99 s and 1 more accelerations and forces are uncertain: prescribed, that motion asks for other "
        "efforts, by 0.001 of the largest; the energy balance has a gap of 2e-05 of the largest energy"
    )
    assert "Check failed: at 1.99 s" in str(doubtful)


FOUR_BAR = """
gravity: standard
links:
  ground: {points: {O2: [0, 0], O4: [0.2, 0]}}
  crank: {points: {O2: [0, 0], A: [0.05, 0]}, mass: 1 kg, inertia: 0.02 kg*m^2}
  coupler: {points: {A: [0, 0], B: [0.15, 0]}, mass: 1.2 kg, center: [0.07, 0], inertia: 0.003 kg*m^2}
  rocker: {points: {O4: [0, 0], B: [0.12, 0]}, mass: 0.8 kg, center: [0.06, 0], inertia: 0.004 kg*m^2}
joints:
  O2: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, coupler]}
  B: {type: pin, links: [coupler, rocker]}
  O4: {type: pin, links: [ground, rocker]}
drives: {O2: {effort: 0}}
start: {O2: {position: 60 deg, speed: 30 rad/s}}
assembly: {coupler: 40, rocker: 90}
"""


def own_energies(q: float) -> tuple[float, float]:
    """J and potential energy of that four-bar by its vector loop in complex numbers: nothing of the program's."""
    a, ground = 0.05 * np.exp(1j * q), 0.2
    d = ground - a
    far = abs(d)
    spread = math.acos((0.15**2 + far**2 - 0.12**2) / (2 * 0.15 * far))
    three = np.angle(d) + spread
    four = np.angle(a + 0.15 * np.exp(1j * three) - ground)
    rows = np.array(
        [[-0.15 * math.sin(three), 0.12 * math.sin(four)], [0.15 * math.cos(three), -0.12 * math.cos(four)]]
    )
    w3, w4 = np.linalg.solve(rows, [0.05 * math.sin(q), -0.05 * math.cos(q)])
    v3 = 1j * a + 0.07j * w3 * np.exp(1j * three)
    inertia = 0.02 + 0.003 * w3**2 + 1.2 * abs(v3) ** 2 + (0.004 + 0.8 * 0.06**2) * w4**2
    height = 1.2 * (a + 0.07 * np.exp(1j * three)).imag + 0.8 * 0.06 * math.sin(four)
    return float(inertia), float(9.80665 * height)


def test_a_four_bar_is_that_of_an_integrator_of_its_own() -> None:
    """Lagrange's equation with J and V of the loop, their slopes by differences of the eighth order."""
    step = 0.02
    weights = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280]) / step

    def rate(_: float, y: np.ndarray) -> list[float]:
        around = np.array([own_energies(y[0] + k * step) for k in range(-4, 5)])
        slope_j, slope_v = weights @ around
        return [y[1], -(slope_j * y[1] ** 2 / 2 + slope_v) / own_energies(y[0])[0]]

    known = solve_ivp(rate, (0, 0.5), [math.pi / 3, 30.0], method="DOP853", rtol=1e-11, atol=1e-12)
    s = da.simulate(da.loads(FOUR_BAR), "0.5 s", count=11)
    assert s.position("O2")[-1] == pytest.approx(known.y[0, -1], rel=1e-8)
    assert s.speed("O2")[-1] == pytest.approx(known.y[1, -1], rel=1e-8)


@pytest.mark.parametrize("turns", tiers([5], [1000]))
def test_a_conservative_four_bar_keeps_its_energy(turns: int) -> None:
    period = 0.20706295783828  # of one turn, the others are like it
    s = da.simulate(da.loads(FOUR_BAR), turns * period, tolerance=1e-13, count=turns + 1)
    assert s.position("O2") - np.pi / 3 == pytest.approx(2 * np.pi * np.arange(turns + 1), abs=1e-6)
    assert s.energy_residual < 1e-9
    assert s.closure < 1e-12


def test_a_motor_curve_is_the_same_in_machine_code_and_without(monkeypatch: pytest.MonkeyPatch) -> None:
    """Corners of the curve, a switch and a brake, by steps in machine code and by scipy's own."""
    motor = "{curve: {speed: [0, 10 rad/s, 25 rad/s, 40 rad/s], torque: [3, 5, 2, 0]}, off: 0.4 s}, brake: 0.5 N*m"
    m = da.loads(FOUR_BAR.replace("effort: 0", f"motor: {motor}").replace("30 rad/s}}", "2 rad/s}}"))
    one = da.simulate(m, "0.6 s", count=7)
    monkeypatch.setattr("dalembert.machine.motion.equation.find_spec", lambda name: None)
    other = da.simulate(m, "0.6 s", count=7)
    assert one.time == pytest.approx(other.time, rel=1e-9)
    assert one.position("O2") == pytest.approx(other.position("O2"), rel=1e-9)
    assert {k: w[-1] for k, w in one.works.items()} == pytest.approx(
        {k: w[-1] for k, w in other.works.items()}
    )
    assert {e.name for e in one.events} == {e.name for e in other.events}


def test_a_change_point_ends_the_motion_with_a_sentence() -> None:
    """A parallelogram goes on in two ways from where all its links lie in one line."""
    text = FOUR_BAR.replace("B: [0.15, 0]", "B: [0.2, 0]").replace("B: [0.12, 0]", "B: [0.05, 0]")
    s = da.simulate(
        da.loads(text.replace("{coupler: 40, rocker: 90}", "{coupler: 0, rocker: 60}")), "1 s", tolerance=1e-8
    )
    assert "a dead centre or a change point" in s.ended
    assert s.position("O2")[-1] == pytest.approx(np.pi, abs=0.01)
    assert s.result.angle("rocker") == pytest.approx(s.position("O2"), abs=1e-6)
    assert s.energy_residual < 1e-5


def test_a_motion_until_a_time_reports_the_instants_it_has_reached() -> None:
    m, reports = (
        rotor(0.8, "drives: {O: {effort: 2*time}}\nstart: {O: {position: 0}}"),
        list[tuple[int, int]](),
    )
    da.simulate(m, "2 s", count=41, progress=lambda *report: reports.append(report))
    assert reports[0] == (0, 40)
    assert [count for _, count in reports] == [40] * len(reports)
    reached = [done for done, _ in reports]
    assert reached == sorted(reached)
    assert 0 < reached[-1] <= 40
    reports.clear()
    da.simulate(m, "O.speed = 1 rad/s", progress=lambda *report: reports.append(report))
    assert not reports


def test_chosen_joint_forces_and_slides_are_drawn() -> None:
    m = da.slider_crank(crank=0.05, rod=0.2)
    s = da.simulate(m, "0.05 s", start={"O2": {"position": 0.5, "speed": 20.0}}, count=21)
    usual = [scene.title for scene in s.drawings()]
    more = replace(s, curves=("reaction.A", "slide.guide")).drawings()
    assert [scene.title for scene in more if scene.title not in usual] == ["reaction.A", "slide.guide"]
    force = next(scene for scene in more if scene.title == "reaction.A").numbers["magnitude"]
    assert force == pytest.approx(np.hypot(*s["reaction.A"].T))


@pytest.mark.long
def test_the_press_of_the_guide_comes_to_a_steady_state() -> None:
    """From rest: what the motor gives over a turn is what the work and friction take."""
    s = da.simulate(
        da.load(Path(__file__).parents[2] / "docs" / "press.yaml"), "8 s", tolerance=1e-9, count=401
    )
    q, u = s.position("O"), s.speed("O")
    works = {name: np.interp(q[-1] - 2 * np.pi * np.arange(2), q, w) for name, w in s.works.items()}
    given = {name: w[0] - w[1] for name, w in works.items()}
    assert -(given["loads"] + given["friction"]) == pytest.approx(given["O"], rel=0.02)
    turns = [np.interp(q[-1] - 2 * np.pi * k, q, u) for k in range(3)]
    assert turns == pytest.approx([turns[0]] * 3, rel=1e-3)
    assert s.energy_residual < 1e-7
    assert s.law_residual < 1e-9


def rubbing(tree: Any) -> Any:
    """The mechanism with friction in its pins and sliders; the tree given is another test's too."""
    tree = deepcopy(tree)
    for joint in tree["joints"].values():
        if joint["type"] in ("pin", "slider", "revolute", "prismatic"):
            turns = joint["type"] in ("pin", "revolute")
            joint["friction"] = {"coefficient": 0.05} | ({"radius": "4 mm"} if turns else {})
    return tree


def simulated(tree: Any, seconds: float, tolerance: float = 1e-12) -> da.Simulation:
    """All drives let go where they begin, slowly."""
    m = da.mechanism(tree)
    at = {name: np.ravel(getattr(d.position, "start", d.position))[0] for name, d in m.drives.items()}
    start = {name: {"position": float(q), "speed": 0.3} for name, q in at.items()}
    return da.simulate(m, seconds, start=start, count=4, tolerance=tolerance)


@pytest.mark.parametrize("seed", tiers([6], [1, 4, 5, 7, 8, *range(10, 13)]))
def test_the_motion_found_asks_for_the_efforts_that_made_it(seed: int) -> None:
    """Simulate, prescribe, compare: random mechanisms, of groups without a closed form too."""
    s = simulated(random_case(seed).tree, 0.05)
    assert not s.ended.startswith("stopped")
    assert s.law_residual < 1e-9
    assert s.energy_residual < 1e-9


HAMMER = Path(__file__).parents[2] / "docs" / "drop-hammer.yaml"


@pytest.mark.long
def test_a_hammer_bounces_rests_on_its_stop_and_is_lifted() -> None:
    """Impacts at t0 (1 + 2 e + 2 e^2 + ...), rest at t0 (1 + e)/(1 - e), until the rope pulls with the weight."""
    m, e, g = da.load(HAMMER), 0.4, 9.80665
    s, first = da.simulate(m, "2 s", count=401), math.sqrt(2 * 0.5 / g)
    struck = s.event("impact")
    expected = [first * (1 + 2 * sum(e**j for j in range(1, k + 1))) for k in range(6)]
    assert [x.time for x in struck[:6]] == pytest.approx(expected, rel=1e-9)
    assert [x.speed for x in struck[:6]] == pytest.approx([g * first * e**k for k in range(6)], rel=1e-9)
    assert struck[0].lost == pytest.approx((1 - e * e) * 80 * g * 0.5, rel=1e-9)
    rest, up = s.event("ram stays on its stop")[0], s.event("ram leaves its stop")[0]
    assert rest.time == pytest.approx(first * (1 + e) / (1 - e), rel=1e-6)
    assert up.time == pytest.approx(1 + 80 * g / 2000, rel=1e-9)
    at = (s.time > rest.time) & (s.time < 1)
    assert s.stop_force[at, 0] == pytest.approx(80 * g)
    assert s.result.effort("ram")[at] == pytest.approx(80 * g)
    assert -s.works["impacts"][-1] == pytest.approx(80 * g * 0.5, rel=1e-9)
    assert max(s.energy_residual, s.law_residual) < 1e-9
    other = m.with_values({"drives.ram.stops": {"from": "0 m", "restitution": 0.5}})
    assert da.mechanism(other.model_dump(mode="json")).drives["ram"].stops == Stops(0.0, math.inf, 0.5)
    with pytest.raises(
        ModelError, match=r"drop-hammer.yaml:\d+: ram starts beyond its stops, at -0.001 m; start between"
    ):
        da.simulate(m, "2 s", start={"ram": {"position": "-1 mm"}})


@pytest.mark.parametrize("rough", [False, True])
def test_two_carts_exchange_their_momentum_at_a_stop_between_them(rough: bool) -> None:
    """u+ = u- - (1 + e) M^-1 n (n u-) / (n M^-1 n) of two freedoms is Newton's law of impact of two bodies."""
    rub = ", friction: {coefficient: 0.1}" if rough else ""
    s = da.simulate(
        da.loads(f"""
links:
  ground: {{points: {{O: [0, 0]}}}}
  one: {{points: {{O: [0, 0]}}, mass: 3 kg}}
  two: {{points: {{O: [0, 0]}}, mass: 1 kg}}
joints:
  A: {{type: slider, links: [ground, one], at: [O, O], direction: 0 deg}}
  B: {{type: slider, links: [one, two], at: [O, O], direction: 0 deg{rub}}}
drives: {{A: {{effort: 0 N}}, B: {{effort: 0 N, stops: {{to: 0.2 m, restitution: 0.6}}}}}}
start: {{A: {{position: 0 m, speed: 1 m/s}}, B: {{position: 0 m, speed: 4 m/s}}}}
"""),
        "0.1 s",
        count=5,
    )
    assert [(e.name, e.time) for e in s.events] == [("impact", pytest.approx(0.05, rel=1e-9))]
    assert s.speed("B")[-1] == pytest.approx(-2.4, rel=1e-9)
    assert 3 * s.speed("A")[-1] + (s.speed("A") + s.speed("B"))[-1] == pytest.approx(8, rel=1e-9)
    assert s.events[0].lost == pytest.approx(3 / 4 * 4**2 * (1 - 0.36) / 2, rel=1e-9)
    assert max(s.energy_residual, s.law_residual) < 1e-9


@pytest.mark.parametrize(
    ("drives", "sentence"),
    [
        (
            "drives: {O: {motor: {stall: 4 N*m, no_load: 3 rad/s}}}",
            "drive 'O' has a motor and no start; write start:",
        ),
        (
            "drives: {O: {motor: {curve: {speed: [0, 9 rpm, 9 rpm], torque: [4, 2, 0]}}}}\nstart: {O: {position: 0}}",
            "must increase: point 3",
        ),
        ("drives: {O: {effort: 0, stops: {restitution: 0.5}}}", "the stops say neither from nor to"),
        ("drives: {O: {effort: 0, stops: {from: 0, to: 9 deg, restitution: 2}}}", "restitution is 2"),
        ("drives: {O: {effort: 0, stops: {from: 9 deg, to: 9 deg}}}", "the stops go from 9 deg to 9 deg"),
        ("drives: {O: {motor: {stall: 4 N*m}}}\nstart: {O: {position: 0}}", "stall and no_load, or a curve"),
        (
            "drives: {O: {effort: 0}}\nstart: {P: {position: 0}}",
            "start names the drive 'P', which does not exist",
        ),
    ],
)
def test_what_is_wrong_says_so_at_its_line(drives: str, sentence: str) -> None:
    with pytest.raises(ModelError, match=r"text:\d+: ") as caught:
        rotor(1, drives)
    assert sentence in str(caught.value)


@pytest.mark.parametrize("seed", tiers([57], [1, 2, 3]))
def test_with_friction_it_asks_for_them_too(seed: int) -> None:
    """Of seed 2 a fixed point iteration for the accelerations runs away; in 57 links are welded to the ground."""
    s = simulated(rubbing(random_case(seed).tree), 1e-3, tolerance=1e-9)
    assert s.ended == "at 0.001 s"
    assert s.law_residual < 1e-9
    assert s.energy_residual < 1e-9


WEIGHTLESS = {
    *(0, 9, 13, 21, 39, 40, 47, 52, 53, 54, 55, 68, 69, 75, 87, 90),
    *(109, 120, 136, 147, 151, 157, 158, 169, 180, 182),
}
"""Of 200 seeds those with a drive whose links have no mass."""


ENDS = ("at rest from", "dead centre or a change point", "the machine jams", "does not close")
"""Where a motion with friction may end before its time; 4, 45 and 177 at dead centres of groups that Newton closes, 42,
57 and 123 at rest."""


@pytest.mark.parametrize("seed", tiers([], [196], sorted(set(range(200)) - WEIGHTLESS)))
def test_of_200_with_friction_each_moves(seed: int) -> None:
    """Without chatter, where parts come to rest and start again too: in 100 and 196 all contacts of one freedom."""
    s = simulated(rubbing(random_case(seed).tree), 0.3, tolerance=1e-9)
    assert s.ended == "at 0.3 s" or any(why in s.ended for why in ENDS)
    assert len(s.events) < 100
    assert max(s.law_residual, s.energy_residual) < 1e-8 or s.status == "stopped" or s.doubt


@pytest.mark.parametrize("seed", tiers([], [], sorted(WEIGHTLESS)))
def test_or_says_why_not(seed: int) -> None:
    with pytest.raises(ModelError, match="a part that moves has no inertia: forces that move"):
        simulated(rubbing(random_case(seed).tree), 1e-3, tolerance=1e-9)


@pytest.mark.parametrize("rough", [False, True])
@pytest.mark.parametrize("seed", tiers([24], [3, 5, 33]))
def test_in_space_it_asks_for_them_too(seed: int, rough: bool) -> None:
    """Poses are followed from state to state there; without friction, and with it in hinges and slides."""
    made = space_tree(space_case(seed))
    s = simulated(rubbing(made) if rough else made, 0.05, 1e-10 if rough else 1e-12)
    assert s.ended == "at 0.05 s"
    assert np.ptp(s.result.drive_position(s.drives[0])) > 1e-3
    assert max(s.law_residual, s.energy_residual) < 1e-9


TWO_SLIDES = """
links: {ground: {points: {O: [0, 0]}}, a: {points: {O: [0, 0], A: [0, 0]}MASS}, b: {points: {A: [0, 0]}, mass: 2}}
joints: {S: {type: slider, links: [ground, a], at: O RUBS}, T: {type: slider, links: [a, b], at: A}}
drives: {S: {effort: 6}, T: {effort: 2}}
start: {S: {position: 0, speed: SPEED}, T: {position: 0, speed: 0}}
"""


@pytest.mark.parametrize("speed", ["0", "1"])
@pytest.mark.parametrize("rubs", ["", ", friction: {coefficient: 0.1}"])
def test_a_part_between_two_drives_needs_a_mass(rubs: str, speed: str) -> None:
    """Each drive alone moves the block b: together they move a without it. With masses, 4 N move a, and 2 N b."""
    text = TWO_SLIDES.replace("RUBS", rubs).replace("SPEED", speed)
    with pytest.raises(
        da.ModelError, match="0 s: a part that moves has no inertia: forces that move S move no mass"
    ):
        da.simulate(da.loads(text.replace("MASS", "")), "1 s")
    s = da.simulate(da.loads(text.replace("MASS", ", mass: 1")), "1 s", count=2)
    assert s.speed("S")[-1] == pytest.approx(float(speed) + 4, rel=1e-9)
    assert (s.speed("S") + s.speed("T"))[-1] == pytest.approx(float(speed) + 1, rel=1e-9)


@pytest.mark.long
def test_a_motion_that_cannot_begin_says_why() -> None:
    with pytest.raises(da.ModelError, match="the motion cannot begin: stopped at 0 s"):
        simulated(random_case(9).tree, 0.05)
    with pytest.raises(
        da.ModelError, match="the motion cannot begin: stopped at 0 s: a part that moves has no inertia"
    ):
        simulated(rubbing(random_case(0).tree), 1e-3)


HOOKE = Path(__file__).parents[2] / "cases" / "sp-06a-hooke-joint-with-flywheel.yaml"


@pytest.mark.long
def test_efforts_that_are_rounding_beside_the_machine_are_no_doubt() -> None:
    """A Hooke joint let go: it coasts, with 773 N m of its flywheel and no effort; one of 0.1 N m is no rounding."""
    m = da.load(HOOKE).with_values({"loads.T.value": [0, 0, 0]})
    s = da.simulate(m, "0.01 s", start={"O": {"position": "45 deg", "speed": "240 rpm"}}, count=3)
    assert s.doubt == ""
    other = replace(s, given=np.full_like(s.given, 0.1))
    assert "prescribed, that motion asks for other efforts" in other.doubt


SWING = """
gravity: [0, -9.80665]
links:
  ground: {points: {O: [0, 0]}}
  arm: {points: {O: [0, 0], P: [0.3, 0]}, mass: 2, center: [0.2, 0], inertia: 0.01}
joints: {O: {type: pin, links: [ground, arm]ROUGH}}
drives: {O: DRIVE}
start: {O: {position: -90 deg, speed: SPEED}}
"""


@pytest.mark.parametrize(
    ("drive", "speed", "why", "effort"),
    [
        ("{effort: 0}", "0.5 rad/s", "friction holds it", 0.0),
        ("{motor: {stall: 2 N*m, no_load: 10 rad/s}}", "1 rad/s", "its motor stalls", 2.0),
    ],
)
def test_what_comes_to_rest_says_what_holds_it(drive: str, speed: str, why: str, effort: float) -> None:
    """Its weight's moment at rest with the friction of its pin, as two oracles of one line each have them."""
    rough = ", friction: {coefficient: 0.3, radius: 0.1}"
    text = SWING.replace("ROUGH", rough).replace("DRIVE", drive).replace("SPEED", speed)
    s = da.simulate(da.loads(text), 2.0, count=5)
    (event,) = s.events
    found = re.fullmatch(
        r"O comes to rest and stays: (.*); effort (\S+) N\*m, held from (\S+) N\*m to (\S+) N\*m",
        event.sentence,
    )
    assert found, event.sentence
    assert found[1] == why
    at, low, high = (float(x) for x in found.groups()[1:])
    assert at == pytest.approx(effort)
    assert low <= at <= high
    weight = 2 * 9.80665
    level = weight * 0.2 * np.cos(float(s.position("O")[-1]))
    circle = 0.1 * np.sin(np.arctan(0.3))
    assert (low + high) / 2 == pytest.approx(level, rel=1e-4)
    assert (high - low) / 2 == pytest.approx(weight * circle, rel=1e-4)


@pytest.mark.parametrize("zero", ["0", "0 rad/s", "0.0 deg/s"])
def test_a_condition_of_zero_needs_no_unit(zero: str) -> None:
    text = SWING.replace("ROUGH", "").replace("DRIVE", "{effort: 0}").replace("SPEED", "3 rad/s")
    s = da.simulate(da.loads(text), [f"O.speed = {zero}", 5.0])
    height = (0.01 + 2 * 0.04) * 9 / 2 / (2 * 9.80665)
    assert 0.2 * (1 + np.sin(float(s.position("O")[-1]))) == pytest.approx(height, rel=1e-6)
    assert s.time[-1] < 5.0
