"""Elastic and damped stops: a mass on a spring and damper in closed form, energy, mirror, scale, copies, messages."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from tests.tiers import tiers

CART = """
gravity: none
links:
  ground: {{points: {{O: [0, 0]}}}}
  cart: {{points: {{O: [0, 0]}}, mass: 2 kg}}
joints: {{S: {{type: slider, links: [ground, cart], at: [O, O], direction: 0}}}}
drives: {{S: {{effort: {effort}, stops: {{{end}, stiffness: 800 N/m, damping: {damping} N*s/m}}}}}}
start: {{S: {{position: 0 m, speed: {speed}}}}}
"""
LEVER = """
gravity: none
links:
  ground: {points: {O: [0, 0]}}
  lever: {points: {O: [0, 0], P: [1 m, 0]}, inertia: 0.5}
joints:
  O: {type: pin, links: [ground, lever], stops: {from: -20 deg, to: 30 deg, stiffness: 90 N*m/rad, damping: 0.4}}
drives: {O: {effort: 0}}
start: {O: {position: 0, speed: 2 rad/s}}
"""
TWO = LEVER.replace(
    "joints:\n",
    "  slide: {points: {Q: [0, 0]}, mass: 1}\njoints:\n  P: {type: slider, links: [ground, slide], at: [O, Q]}\n",
)
TWO = TWO.replace(
    "drives: {O: {effort: 0}}", "drives: {P: {effort: 1, freedom: slide}, O: {position: 0, speed: 1 rad/s}}"
)
TWO = TWO.replace("start: {O", "start: {P").replace("2 rad/s", "0 m/s")
CRANK = """
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [0.1, 0]}, inertia: 0.2}
  rod: {points: {A: [0, 0], B: [0.3, 0]}}
  piston: {points: {B: [0, 0]}, mass: 4}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, piston]}
  S: {type: slider, links: [ground, piston], at: [O, B], direction: 0, stops: {from: 0.25, stiffness: 1e5}}
drives: {O: {effort: 6}}
assembly: {rod: -10}
start: {O: {position: 60 deg, speed: 0}}
"""
PLAY = """
links:
  ground: {points: {O: [0, 0]}}
  motor: {points: {O: [0, 0]}, inertia: 0.2}
  load: {points: {O: [0, 0]}, inertia: 0.3}
joints:
  O: {type: pin, links: [ground, motor]}
  C: {type: pin, links: [motor, load], at: [O, O], stops: {from: -2 deg, to: 2 deg, stiffness: 5000 N*m/rad}}
drives: {O: {effort: 0}}
start: {O: {position: 0, speed: 3 rad/s}, C: {position: 0, speed: -3 rad/s}}
"""
OUT_AND_BACK = "1 s"


def cart(damping: float, end: str = "to: 1 m", speed: str = "4 m/s", effort: str = "0 N") -> da.Simulation:
    """A cart of 2 kg that meets a stop of 800 N/m."""
    return da.simulate(
        da.loads(CART.format(damping=damping, end=end, speed=speed, effort=effort)), OUT_AND_BACK
    )


def restitution(damping: float, mass: float = 2.0, stiffness: float = 800.0) -> tuple[float, float]:
    """Time in contact, and speed after over speed before, of a mass that leaves where the force comes to zero.

    Depth x = v exp(-a t) sin(b t)/b; k x + c x' = -m x'', so x'' = 0: tan(b t) = 2 a b/(a^2 - b^2).
    """
    a = damping / (2 * mass)
    b = math.sqrt(stiffness / mass - a * a)
    t = math.atan2(2 * a * b, a * a - b * b) / b
    return t, math.exp(-a * t)  # at that instant x' = -v exp(-a t)


@pytest.mark.parametrize("damping", [1e-3, 16.0, 60.0])
def test_a_mass_leaves_a_damped_stop_as_in_closed_form(damping: float) -> None:
    s, (contact, back) = cart(damping), restitution(damping)
    met, left = s.event("stop")
    assert met.time == pytest.approx(0.25, rel=1e-12)
    assert left.time - met.time == pytest.approx(contact, rel=1e-9)
    assert s.speed("S")[-1] == pytest.approx(-4 * back, rel=1e-9)
    assert s.works["S"][-1] == pytest.approx(4**2 * (back**2 - 1), abs=1e-8)  # m v^2/2 lost in the damper
    assert met.sentence == "S meets its elastic stop at 1 m with 4 m/s"
    assert left.sentence == "S leaves its elastic stop at 1 m"
    assert s.energy_residual < 1e-9
    assert s.law_residual < 1e-9
    assert (s.stop_force <= 0).all()  # it never pulls


def test_an_undamped_stop_holds_half_a_period_and_gives_all_back() -> None:
    s = da.simulate(
        da.loads(CART.format(damping=1, end="to: 1 m", speed="4 m/s", effort="0 N")).with_values(
            {"drives.S.stops": {"to": "1 m", "stiffness": "800 N/m"}}
        ),
        OUT_AND_BACK,
        count=400,
    )
    met, left = s.event("stop")
    assert left.time - met.time == pytest.approx(math.pi * math.sqrt(2 / 800), rel=1e-11)
    assert s.speed("S")[-1] == pytest.approx(-4, rel=1e-11)
    depth = np.maximum(s.position("S") - 1, 0)
    np.testing.assert_allclose(s.kinetic + 800 * depth**2 / 2, 16, rtol=1e-10)
    np.testing.assert_allclose(s.stop_force[:, 0], -800 * depth, atol=1e-9)


def test_the_other_side_is_the_mirror_image_and_energies_scale() -> None:
    s, mirrored = cart(16), cart(16, "from: -1 m", "-4 m/s")
    np.testing.assert_allclose(mirrored.position("S"), -s.position("S"), rtol=0, atol=1e-12)
    np.testing.assert_allclose(mirrored.stop_force, -s.stop_force, rtol=0, atol=1e-9)
    large = cart(16, "to: 10 m", "40 m/s")  # linear: ten times all
    np.testing.assert_allclose(large.position("S"), 10 * s.position("S"), rtol=1e-9, atol=1e-9)


def test_a_steady_push_comes_to_rest_at_its_static_depth() -> None:
    s = da.simulate(
        da.loads(CART.format(damping=30, end="to: 0.1 m", speed="0 m/s", effort="40 N")), "9 s", count=9
    )
    assert s.position("S")[-1] == pytest.approx(0.1 + 40 / 800, rel=1e-9)
    assert s.stop_force[-1, 0] == pytest.approx(-40, rel=1e-8)
    assert s.energy_residual < 1e-9


def test_stops_of_a_turn_take_the_drive_from_side_to_side() -> None:
    m = da.loads(LEVER)
    s = da.simulate(m, "2 s")
    back = restitution(0.4, 0.5, 90.0)[1]
    speeds = [e.words[3][1] for e in s.event("stop") if "meets" in e.sentence]  # type: ignore[index]
    assert len(speeds) > 2
    assert speeds == pytest.approx([2 * back**n for n in range(len(speeds))], rel=1e-8)
    stops = m.joints["O"].stops  # type: ignore[union-attr]
    assert stops is not None
    assert (stops.stiffness, stops.damping, stops.kind) == (90.0, 0.4, "angle")
    assert da.loads(str(m)) == m
    moved = m.with_values({"joints.O.stops.stiffness": 45.0})
    assert "stiffness: 45" in str(moved)
    assert da.loads(str(moved)) == moved


@pytest.mark.parametrize(
    ("old", "new", "line", "sentence"),
    [
        (", damping: 0.4", ", restitution: 0.4", 7, "the stops have a restitution and a stiffness"),
        ("stiffness: 90 N*m/rad, ", "", 7, "the stops have a damping without a stiffness"),
        ("90 N*m/rad", "90 N/m", 7, "stiffness of stops"),
        ("stiffness: 90", "stiffness: -90", 7, "stiffness of stops"),
        ("damping: 0.4", "damping: -0.4", 7, "damping of stops"),
    ],
)
def test_wrong_stops_are_named_with_their_line(
    old: str, new: str, line: int, sentence: str, tmp_path: Path
) -> None:
    file = tmp_path / "lever.yaml"
    file.write_text(LEVER.replace(old, new))
    with pytest.raises(ModelError) as raised:
        da.load(file)
    assert f"lever.yaml:{line}: " in str(raised.value)
    assert sentence in str(raised.value)


@pytest.mark.parametrize("rough", tiers([""], [", friction: {coefficient: 0.1, radius: 9 mm}"]))
def test_a_joint_without_a_drive_has_the_stop_that_a_load_by_its_slide_is(rough: str) -> None:
    """With every joint force, also beside dry friction, which the force of the stop changes."""
    crank = CRANK.replace("links: [crank, rod]", f"links: [crank, rod]{rough}")
    force = 'value: "1e5 N/m*max(0 m, 0.25 m - joints.S.slide)"}'
    load = f"loads: {{F: {{type: force, on: piston, by: ground, at: B, direction: 0, {force}}}\n"
    plain = da.loads(crank.replace(", stops: {from: 0.25, stiffness: 1e5}", "") + load)
    s, known = da.simulate(da.loads(crank), "0.5 s"), da.simulate(plain, "0.5 s")
    speed = "0.560481" if rough else "0.560813"
    assert [e.sentence for e in s.events if "elastic" in e.sentence] == [
        f"S meets its elastic stop at 0.25 m with {speed} m/s",
        "S leaves its elastic stop at 0.25 m",
    ]
    for name in ("O", "A", "S"):
        assert s.result.reaction(name) == pytest.approx(known.result.reaction(name), rel=1e-7, abs=1e-6)
    assert s.works["loads"] == pytest.approx(known.works["loads"], abs=1e-9)
    assert s.joint_stop_force["S"].max() > 900
    assert max(s.energy_residual, s.law_residual) < 1e-9


def test_play_between_two_rotors_passes_on_their_momentum() -> None:
    """One turns by 2 deg before it meets the other: half a period of both on the spring, then as after an impact."""
    m = da.loads(PLAY)
    s = da.simulate(m, "40 ms")
    met, left = s.event("stop")
    assert met.time == pytest.approx(math.radians(2) / 3, rel=1e-9)
    assert left.time - met.time == pytest.approx(math.pi / math.sqrt(5000 * (1 / 0.2 + 1 / 0.3)), rel=1e-9)
    speeds = s.speed("O")[-1], (s.speed("O") + s.speed("C"))[-1]
    assert speeds == pytest.approx([3 * (0.2 - 0.3) / 0.5, 3 * 2 * 0.2 / 0.5], rel=1e-9)
    rigid = m.with_values({"joints.C.stops": {"from": "-2 deg", "to": "2 deg", "restitution": 1}})
    assert da.simulate(rigid, "30 ms").speed("O")[-1] == pytest.approx(speeds[0], rel=1e-9)


@pytest.mark.parametrize("seed", tiers([0], [1, 2, 3], range(4, 40)))
def test_random_stops_of_a_rocker_keep_the_laws_and_only_push(seed: int) -> None:
    """With dry friction in every second pair of seeds."""
    rng = np.random.default_rng(seed)
    a, b = np.sort(rng.uniform(1.2, 2.2, 2))
    stiffness, damping = 10 ** rng.uniform(2, 4), rng.uniform(0, 3)
    stops = f"{{from: {a} rad, to: {b + 0.1} rad, stiffness: {stiffness} N*m/rad"
    stops += f", damping: {damping} N*m*s/rad}}" if seed % 2 else "}"
    smooth = "" if seed % 4 < 2 else ", friction: {coefficient: 0.2, radius: 20 mm}"
    text = RUBBING.replace(", friction: {coefficient: 0.2, radius: 20 mm}", smooth).replace("SPEED", "6")
    text = text.replace(", stops: {from: 20 deg, to: 140 deg, stiffness: 400 N*m/rad, damping: 0.5}", "")
    s = da.simulate(da.loads(text.replace("[ground, rocker]", f"[ground, rocker], stops: {stops}")), "0.4 s")
    force, angle = s.joint_stop_force["C"], s.result["turn.C"]
    assert force.any() == ((angle < a) | (angle > b + 0.1)).any()
    assert force.any() or seed > 3
    assert (force * (np.clip(angle, a, b + 0.1) - angle) >= -1e-9).all()
    assert max(s.energy_residual, s.law_residual) < 1e-9


def test_elastic_stops_of_what_is_prescribed_are_refused() -> None:
    prescribed = da.loads(LEVER).with_values({"drives.O.effort": "1 N*m"})
    with pytest.raises(ModelError, match="drive 'O' is prescribed, and its stops would be gone through"):
        da.simulate(da.loads(TWO), "1 s")
    assert da.simulate(prescribed, "0.1 s").status == "ended"


RUBBING = """
gravity: standard
links:
  ground: {points: {O: [0, 0], C: [0.3, 0]}}
  crank: {points: {O: [0, 0], A: [0.1, 0]}, mass: 1, center: [0.05, 0], inertia: 0.01}
  rod: {points: {A: [0, 0], B: [0.3, 0]}, mass: 1, center: [0.15, 0], inertia: 0.01}
  rocker: {points: {C: [0, 0], B: [0.2, 0]}, mass: 2, center: [0.1, 0], inertia: 0.02}
joints:
  O: {type: pin, links: [ground, crank], friction: {coefficient: 0.2, radius: 20 mm}}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, rocker]}
  C: {type: pin, links: [ground, rocker]}
drives: {O: {effort: 3*cos(O) N*m, stops: {from: 20 deg, to: 140 deg, stiffness: 400 N*m/rad, damping: 0.5}}}
assembly: {rod: 30, rocker: 90}
start: {O: {position: 60 deg, speed: SPEED rad/s}}
"""


@pytest.mark.parametrize("speed", tiers([], [12, -9]))
def test_a_linkage_that_rubs_keeps_the_laws_on_its_stops(speed: int) -> None:
    s = da.simulate(da.loads(RUBBING.replace("SPEED", str(speed))), "1 s")
    assert [e for e in s.events if "meets" in e.sentence]
    assert s.energy_residual < 1e-9
    assert s.law_residual < 1e-9
    assert not s.doubt
    force, depth = (
        s.stop_force[:, 0],
        np.clip(s.position("O"), math.radians(20), math.radians(140)) - s.position("O"),
    )
    assert (force * depth >= 0).all()  # back towards the limits, and nothing between them


def test_a_brake_holds_against_a_compressed_stop() -> None:
    """At rest the stop gives k s; the brake takes it while its limit is above that, else the cart is let go."""
    text = CART.format(damping=3, end="to: 1 m", speed="4 m/s", effort="0 N").replace(
        "position: 0", "position: 0.9"
    )
    held = da.simulate(da.loads(text.replace("effort: 0 N", "effort: 0 N, brake: 60 N")), "3 s")
    depth = held.position("S")[-1] - 1
    assert 0 < 800 * depth < 60
    assert held.stop_force[-1, 0] == pytest.approx(-800 * depth, rel=1e-12)
    let_go = da.simulate(da.loads(text.replace("effort: 0 N", "effort: 0 N, brake: 20 N")), "3 s")
    assert let_go.position("S")[-1] < 1
