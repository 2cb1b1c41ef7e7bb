"""Stops, clutches, late motors and efforts by positions in motions of many designs: each is that of da.simulate."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from tests.machine import test_elastic_stops as elastic
from tests.machine import test_late_motors as late
from tests.machine import test_stops as rigid
from tests.machine.rubbing_machines import machine
from tests.machine.test_compiled_events import CRANKS, check
from tests.tiers import tiers

pytest.importorskip("llvmlite")


def added(seed: int, kind: str) -> da.Mechanism:
    """A random machine that rubs, or does not, with something more on its crank or in a joint."""
    tree, r = machine(seed), np.random.default_rng(seed + 1000)
    if seed % 4 < 2:
        for joint in tree["joints"].values():
            joint.pop("friction", None)
    start = float(tree["start"]["O"]["position"].split()[0])
    ends = {"from": f"{start - r.uniform(0.3, 2)} rad", "to": f"{start + r.uniform(0.3, 2)} rad"}
    push = {"stiffness": f"{r.uniform(20, 400)} N*m/rad", "damping": r.uniform(0.05, 1)}
    drive: dict[str, Any] = tree["drives"]["O"]
    match kind:
        case "rigid":
            drive["stops"] = {**ends, "restitution": r.uniform(0.3, 0.9)}
        case "elastic":
            drive["stops"] = {**ends, **push}
        case "joint":
            at = np.degrees(float(tree["assembly"]["rod"].split()[0]) - start)
            tree["joints"]["A"]["stops"] = {"from": f"{at - 40} deg", "to": f"{at + 60} deg", **push}
        case "struck":
            at = np.degrees(float(tree["assembly"]["rod"].split()[0]) - start)
            stops = {"from": f"{at - 40} deg", "to": f"{at + 60} deg", "restitution": 0.7}
            tree["joints"]["A"]["stops"] = stops
        case "late":
            motor = {"stall": "4 N*m", "no_load": "40 rad/s", "time_constant": f"{r.uniform(2, 40)} ms"}
            tree["drives"]["O"] = {"motor": motor}
        case "gear":
            motor = {"stall": "0.8 N*m", "no_load": "200 rad/s", "ratio": 5, "inertia": 1e-4}
            tree["drives"]["O"] = {"motor": motor}
        case "effort":
            tree["drives"]["O"] = {
                "effort": "2*cos(2*O) + abs(O.speed/(10 rad/s)) - 1.5*max(0, time/(1 s) - 0.1)"
            }
    return da.mechanism(tree)


KINDS = ("rigid", "elastic", "joint", "struck", "late", "gear", "effort")
OUTPUTS = ["reaction.A.magnitude", "effort.O"]
SEEDS = CRANKS[:12]


@pytest.mark.parametrize(
    "which",
    tiers(
        [(7, "rigid"), (1, "elastic"), (5, "struck"), (12, "late"), (0, "gear")],
        [(6, "joint"), (7, "effort"), *((11, kind) for kind in KINDS)],
        [(seed, kind) for seed in (0, *SEEDS) for kind in KINDS],
    ),
)
def test_random_machines_with_stops_and_motors(which: tuple[int, str]) -> None:
    """Slider-cranks, four-bars and six-bars; those that come to rest on a joint's stop are simulated alone."""
    m = added(*which)
    nominal = np.array([m.links["rod"].mass, m.links["crank"].inertia], float)
    designs = nominal * [[0.8, 1.1], [1.2, 0.9]]
    check(m, ["links.rod.mass", "links.crank.inertia"], OUTPUTS, "0.3 s", designs, most=2)


FIVE_BAR = rigid.FIVE_BAR % ("", 0.4)
CLUTCH = """
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0]}, inertia: 0.01}
joints:
  O: {type: pin, links: [ground, crank]}
  W: {type: one_way, links: [ground, crank], at: O, free: ccw}
parameters: {p: 0.05 N*m}
drives: {O: {effort: p*cos(3*O)}}
start: {O: {position: 0, speed: 3 rad/s}}
"""
MACHINES = [
    (elastic.PLAY, ["links.load.inertia"], ["effort.O"], "40 ms", [[0.3], [0.5]]),
    (elastic.LEVER, ["links.lever.inertia"], ["reaction.O"], "2 s", [[0.5], [0.7]]),
    (late.ROTOR, ["links.rotor.inertia"], ["effort.O"], "0.3 s", [[0.8], [0.5]]),
    (FIVE_BAR, ["links.a.mass"], ["reaction.C"], "0.25 s", [[2.0], [2.5]]),
    (CLUTCH, ["p"], [], "2 s", [[0.05], [0.06]]),
    (CLUTCH.replace("p*cos(3*O)", "-p"), ["p"], [], "2 s", [[0.02], [0.05]]),
]


@pytest.mark.parametrize(
    ("text", "vary", "outputs", "until", "values"),
    [*MACHINES[::2], *(pytest.param(*m, marks=pytest.mark.long) for m in MACHINES[1::2])],
)
def test_machines_with_closed_forms(
    text: str, vary: list[str], outputs: list[str], until: str, values: Any
) -> None:
    """Backlash, a lever between two stops, a flywheel that runs up, two speeds at an impact, a clutch that holds."""
    check(da.loads(text), vary, outputs, until, values)


def test_numbers_of_stops_vary_as_parameters() -> None:
    """Bounces of a flywheel that come to rest for a restitution of 0.5, and not yet for 0.7."""
    text = rigid.FLYWHEEL.replace("restitution: 0.5", "restitution: e").replace("to: 90", "to: far")
    m = da.loads(text + "parameters: {e: 0.5, far: 90 deg}\n")
    r = check(m, ["e", "far"], ["effort.O"], "4 s", [[0.5, 1.0], [0.7, 1.2]])
    assert r.ended[0].startswith("at rest from 3.75994 s")
    assert r.ended[1] == "time"
    with pytest.raises(da.ModelError, match=r"'drives\.O\.stops\.to' cannot vary by its path"):
        da.compile_motion(m, "4 s", ["drives.O.stops.to"])


@pytest.mark.long
def test_what_goes_on_from_rest_by_itself_is_simulated_alone() -> None:
    """A hammer that a rope lifts later from its anvil, and a piston that rests on the stop of a joint."""
    check(da.load(rigid.HAMMER), ["links.ram.mass"], ["effort.ram"], "2 s", [[80.0], [90.0]], most=2)
    check(da.loads(rigid.CRANK % ""), ["links.piston.mass"], ["reaction.B"], "3 s", [[4.0], [5.0]], most=2)


LADDER = """
gravity: standard
links:
  ground: {points: {O: [0, 0]}}
  ladder: {points: {F: [0, 0], W: [4, 0]}, mass: 20, center: [2, 0], inertia: 26.7}
joints:
  floor: {type: slot, links: [ground, ladder], at: [O, F], contact: pushes}
  wall: {type: slot, links: [ground, ladder], at: [O, W], direction: 90, contact: pushes, side: right}
drives: {floor: {freedom: slide, effort: 0}}
start: {floor: {position: 1.4, speed: 0}}
assembly: {ladder: 110}
"""


def test_where_a_contact_lifts_off_a_design_is_simulated_alone() -> None:
    """The wall's force on a ladder that slides down falls to 0 after 0.83 s."""
    m, outputs = da.loads(LADDER), ["reaction.floor"]
    check(m, ["links.ladder.mass"], outputs, "0.7 s", [[20.0], [21.0]])
    r = check(m, ["links.ladder.mass"], outputs, "0.9 s", [[20.0], [21.0]], most=2)
    assert r.redone == 2


def test_what_is_still_refused_says_why() -> None:
    ratchet = CLUTCH.replace("type: one_way", "type: ratchet, teeth: 12")
    with pytest.raises(da.ModelError, match="a ratchet meets its teeth one by one"):
        da.compile_motion(da.loads(ratchet), "1 s")
    lossy = late.ROTOR.replace("time_constant: 2 ms", "ratio: 3, efficiency: 0.9")
    with pytest.raises(da.ModelError, match="the gear of the motor of drive 'O' has losses"):
        da.compile_motion(da.loads(lossy), "1 s")


CART = """
gravity: standard
links: {ground: {points: {O: [0, 0]}}, cart: {points: {O: [0, 0]}, mass: 2}}
joints: {S: {type: slider, links: [ground, cart], at: O, friction: {coefficient: mu}}}
parameters: {mu: 0.1}
drives: {S: {effort: 0, stops: {from: 0 m, restitution: 0.5}}}
start: {S: {position: 0.2 m, speed: -0.8}}
"""


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_cart_that_rubs_bounces_once_and_slides_to_rest(way: float) -> None:
    """v^2 - 2 mu g s to the stop, a quarter of it back, and s = v^2/(2 mu g): friction turns round with the cart."""
    text = CART
    if way < 0:
        text = text.replace("from: 0 m", "to: 0 m").replace("0.2 m, speed: -0.8", "-0.2 m, speed: 0.8")
    mu = np.array([0.1, 0.05, 0.16])
    r = da.compile_motion(da.loads(text), "5 s", ["mu"], ["reaction.S"], "peak")(mu[:, None])
    brake = mu * 9.80665
    before = np.sqrt(0.8**2 - 2 * brake * 0.2)
    assert r.redone == 0
    assert r.position[:, 0] == pytest.approx(way * (before / 2) ** 2 / (2 * brake), rel=1e-9)
    rest = (0.8 - before) / brake + before / 2 / brake
    assert [float(text.split()[3]) for text in r.ended] == pytest.approx(rest, rel=1e-5)
    assert np.abs(r.speed).max() == 0


def test_bounces_of_many_designs_end_at_their_limits() -> None:
    """Pushed to the wall by F = m a: v (1 + e)/(1 - e)/a behind the first time there, infinitely many bounces later."""
    text = CART.replace(", friction: {coefficient: mu}", "").replace("mu: 0.1", "f: 20 N, e: 0.5")
    text = text.replace("effort: 0,", "effort: -f,").replace("restitution: 0.5", "restitution: e")
    values = np.array([[20.0, 0.5], [39.0, 0.5], [20.0, 0.7], [30.0, 0.0]])
    r = da.compile_motion(da.loads(text.replace("speed: -0.8", "speed: -0.1")), "5 s", ["f", "e"])(values)
    a, e = values[:, 0] / 2, values[:, 1]
    v = np.sqrt(0.1**2 + 2 * a * 0.2)
    rest = (v - 0.1) / a + 2 * v * e / (1 - e) / a
    assert r.ended == tuple(f"at rest from {t:.6g} s on" for t in rest)
    assert not r.position.any()
    assert r.redone == 0


@pytest.mark.parametrize("place", [0.0, -10.0])
@pytest.mark.parametrize(("off", "first", "then", "back"), [(0.1, -1, -1, 0.6), (0.0, 0, -4, 2.4)])
def test_two_stops_that_are_met_at_once_are_left_to_one_design_alone(
    place: float, off: float, first: float, then: float, back: float
) -> None:
    """Wall and cart in one instant, or a cart that stands at the wall, wherever that is: A stays, B goes back."""
    carts = rigid.TWO_CARTS.replace("stops: {from: 0 m}}", f"stops: {{from: {place} m}}}}")
    carts = carts.replace("B: {position: 0.1 m", f"B: {{position: {2 * place + 0.1} m")
    carts = carts.replace("stops: {from: 0 m, restitution", f"stops: {{from: {2 * place} m, restitution")
    m = da.loads(carts % (f"{place + off} m", f"{first} m/s", f"{then} m/s"))
    r = da.compile_motion(m, "0.15 s", ["links.one.mass"], [], "final")([[3.0], [2.0]])
    assert r.redone == 2
    gone = back * (0.15 - 0.1 / -then)
    assert r.position == pytest.approx(np.array([[place, 2 * place + gone]] * 2), abs=1e-9)
    assert r.speed == pytest.approx(np.array([[0, back]] * 2), abs=1e-9)
