"""Gears with an efficiency: fixed and epicyclic trains against products of efficiencies, both ways."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.printing import number
from tests.tiers import over

PLANETARY = {
    "units": {"length": "mm", "moment": "N*m"},
    "links": {
        "ground": {"points": {"O": [0, 0]}},
        "sun": {"points": {"O": [0, 0]}},
        "arm": {"points": {"O": [0, 0], "P": [48, 0]}},
        "planet": {"points": {"P": [0, 0]}},
        "ring": {"points": {"O": [0, 0]}},
    },
    "joints": {
        "S": {"type": "pin", "links": ["ground", "sun"], "at": "O"},
        "A": {"type": "pin", "links": ["ground", "arm"], "at": "O"},
        "R": {"type": "pin", "links": ["ground", "ring"], "at": "O"},
        "P": {"type": "pin", "links": ["arm", "planet"]},
        "SP": {"type": "gear", "links": ["sun", "planet"], "at": ["O", "P"], "teeth": [24, 24], "module": 2},
        "RP": {
            "type": "gear",
            "links": ["ring", "planet"],
            "at": ["O", "P"],
            "teeth": [72, 24],
            "module": 2,
            "internal": True,
        },
    },
}


def planetary(efficiency: dict[str, float], drives: dict[str, Any], loads: dict[str, Any]) -> da.Mechanism:
    joints = {n: {**j} for n, j in PLANETARY["joints"].items()}  # type: ignore[attr-defined]
    for name, value in efficiency.items():
        joints[name]["efficiency"] = value
    return da.mechanism({**PLANETARY, "joints": joints, "drives": drives, "loads": loads})


def train(seed: int) -> tuple[da.Mechanism, float, float]:
    """A train on fixed axes, its ratio (last speed over first), and the product of its efficiencies."""
    rng = np.random.default_rng(seed)
    x, links = 0.0, {"ground": {"points": {"C0": [0, 0]}}}
    joints: dict[str, Any] = {}
    ratio, kept = 1.0, 1.0
    for k in range(int(rng.integers(2, 6))):
        links[f"w{k}"] = {"points": {"C": [0, 0]}}
        joints[f"A{k}"] = {"type": "pin", "links": ["ground", f"w{k}"], "at": [f"C{k}", "C"]}
        teeth, eta = [int(n) for n in rng.integers(15, 60, 2)], float(rng.uniform(0.7, 1.0))
        inside = bool(rng.random() < 0.4) and teeth[0] != teeth[1]
        if k:
            gear = {"links": [f"w{k - 1}", f"w{k}"], "at": ["C", "C"], "teeth": teeth, "internal": inside}
            joints[f"G{k}"] = {"type": "gear", "module": "4 mm", "efficiency": eta, **gear}
            x += 0.002 * (abs(teeth[0] - teeth[1]) if inside else sum(teeth))
            links["ground"]["points"][f"C{k}"] = [x, 0]
            ratio *= teeth[0] / teeth[1] * (1 if inside else -1)
            kept *= eta
    drive = {"A0": {"position": 0, "speed": f"{rng.choice([-1, 1]) * 3} rad/s"}}
    last = list(links)[-1]
    load = {"T": {"type": "couple", "on": last, "value": float(rng.uniform(-5, 5))}}
    return da.mechanism({"links": links, "joints": joints, "drives": drive, "loads": load}), ratio, kept


@over(quick=5, whole=200)
def test_a_train_on_fixed_axes_loses_by_the_product_of_its_efficiencies(seed: int) -> None:
    m, ratio, kept = train(seed)
    r = da.statics(m)
    load, speed = m.loads["T"].value, float(r.drive_speed("A0")[0])
    driving = load * ratio * speed < 0  # the load resists
    assert r.effort("A0")[0] == pytest.approx(-load * ratio * (1 / kept if driving else kept), rel=1e-11)
    found = r.power_flow()
    assert (found.input - found.output)[0] == pytest.approx(found.lost[0], rel=1e-9, abs=1e-9 * abs(load))
    both = da.efficiency(r)
    assert (both.forward[0], both.reverse[0]) == pytest.approx((kept, kept), rel=1e-11)
    for k in range(1, len([n for n in m.joints if n.startswith("G")]) + 1):
        out, into = found.through[f"G{k}"][0]
        eta = m.joints[f"G{k}"].efficiency
        assert (into / out if driving else out / into) == pytest.approx(eta, rel=1e-10)


@over(quick=3, whole=100)
def test_a_planetary_gear_is_that_of_vdi_2157(seed: int) -> None:
    """Any two of three shafts drive: the sums of torques and of rolling powers are 0."""
    rng = np.random.default_rng(seed)
    e1, e2 = rng.uniform(0.8, 1.0, 2)
    ws, wr, torque = (float(v) for v in rng.uniform(-20, 20, 3))
    drives = {
        "S": {"position": 0, "speed": f"{ws} rad/s", "effort": f"{torque} N*m"},
        "R": {"position": 0, "speed": f"{wr} rad/s"},
    }
    m = planetary({"SP": e1, "RP": e2}, drives, {"load": {"type": "couple", "on": "arm", "value": "unknown"}})
    r = da.statics(m)
    arm = (ws + 3 * wr) / 4
    assert r.speed("arm")[0] == pytest.approx(arm, rel=1e-12)
    sense = 1.0 if torque * (ws - arm) > 0 else -1.0
    ring = 3 * torque * (e1 * e2) ** sense
    assert r.effort("R")[0] == pytest.approx(ring, rel=1e-10)
    assert r.unknown_load("load")[0] == pytest.approx(-torque - ring, rel=1e-10)
    assert r.power_flow().rolling[0] == pytest.approx(
        abs(torque * (ws - arm)) / (1 if sense > 0 else e1 * e2), rel=1e-10
    )


def test_machine_code_has_the_losses_and_their_slopes() -> None:
    drives = {"S": {"position": 0, "speed": "10 rad/s"}, "R": {"position": 0, "speed": 0}}
    load = {"load": {"type": "couple", "on": "arm", "value": "-40 N*m"}}
    m = planetary({"SP": 0.98, "RP": 0.97}, drives, load)
    k = da.compile(m, vary=["joints.SP.efficiency"], derivatives=True)
    found = k([[0.98], [0.9]])
    e0 = np.array([0.98, 0.9]) * 0.97
    assert found["effort.S"][:, 0] == pytest.approx(40 / (1 + 3 * e0), rel=1e-12)
    slope = np.ravel(found.gradient("effort.S"))
    assert slope == pytest.approx(-40 * 3 * 0.97 / (1 + 3 * e0) ** 2, rel=1e-9)


def reverted(e: float, carrier_drives: bool) -> da.Result:
    """Held wheel 99, planet 100 and 101, wheel 100: a ratio of 10000 from the arm to the wheel."""
    links = {
        "ground": {"points": {"O": [0, 0]}},
        "arm": {"points": {"O": [0, 0], "P": [0.2, 0]}},
        "planet": {"points": {"P": [0, 0]}},
        "fixed": {"points": {"O": [0, 0]}},
        "wheel": {"points": {"O": [0, 0]}},
    }
    gears = {
        "G1": (["fixed", "planet"], ["O", "P"], [0.2 * 99 / 199, 0.2 * 100 / 199]),
        "G2": (["planet", "wheel"], ["P", "O"], [0.2 * 101 / 201, 0.2 * 100 / 201]),
    }
    joints: dict[str, Any] = {
        n: {"type": "pin", "links": ["ground", link], "at": "O"}
        for n, link in (("A", "arm"), ("F", "fixed"), ("W", "wheel"))
    }
    joints |= {"P": {"type": "pin", "links": ["arm", "planet"]}}
    joints |= {
        n: {"type": "gear", "links": ab, "at": at, "radii": radii, "efficiency": e}
        for n, (ab, at, radii) in gears.items()
    }
    speed = "1 rad/s" if carrier_drives else "-1 rad/s"
    drives = {"A": {"position": 0, "speed": speed}, "F": {"position": 0, "speed": 0}}
    load = {"T": {"type": "couple", "on": "wheel", "value": -100}}
    return da.statics(da.mechanism({"links": links, "joints": joints, "drives": drives, "loads": load}))


def test_a_great_ratio_locks_backwards() -> None:
    """i_0 = 99*101/100^2: the wheel drives the arm only for efficiencies of both meshes together above i_0 nearly."""
    i0 = 99 * 101 / 100**2
    ahead, back = reverted(0.99, True), reverted(0.99, False)
    assert "self_locking" in (ahead.status[0], back.status[0])
    eta = da.efficiency(ahead)
    assert min(eta.forward[0], eta.reverse[0]) < 0 < max(eta.forward[0], eta.reverse[0]) < 0.01
    assert "self_locking" not in (reverted(1 - 1e-6, True).status[0], reverted(1 - 1e-6, False).status[0])
    found = ahead.power_flow()
    assert found.rolling[0] > 9000 * ahead.effort("A")[0] * (1 - i0)
    assert "times the power that is put in" in found.text()


WRONG = {
    "efficiency: 1.2": "efficiency of joint 'SP': an efficiency of 1.2 is above 1; write a number above 0, up to 1",
    "efficiency: 0": "efficiency of joint 'SP': 0 is not positive; write a positive one",
}


@pytest.mark.parametrize("value", [1.2, 0])
def test_a_wrong_efficiency_is_refused(value: float) -> None:
    with pytest.raises(da.ModelError) as refused:
        planetary({"SP": value}, {}, {})
    assert str(refused.value) == WRONG[f"efficiency: {value}"]


def test_efficiency_and_friction_exclude_each_other() -> None:
    joints = {**PLANETARY["joints"]}  # type: ignore[dict-item]
    joints["SP"] = {**joints["SP"], "efficiency": 0.9, "friction": {"coefficient": 0.1}}
    with pytest.raises(da.ModelError, match="both friction and efficiency are given; leave one of them out"):
        da.mechanism({**PLANETARY, "joints": joints})


def test_a_held_wheel_is_named_with_its_torque() -> None:
    drives = {"S": {"position": 0, "speed": "10 rad/s"}, "R": {"position": 0, "speed": 0}}
    m = planetary({}, drives, {"load": {"type": "couple", "on": "arm", "value": "-40 N*m"}})
    text = da.statics(m).text()
    assert "R holds ring with 30 N*m." in text
    assert math.isclose(da.statics(m).effort("R")[0], 30, rel_tol=1e-12)


COUPLED = """links:
  ground: {points: {O: [0, 0], L: [0.22, 0]}}
  sun: {points: {O: [0, 0]}}
  arm: {points: {O: [0, 0], P: [0.1, 0]}}
  planet: {points: {P: [0, 0]}}
  ring: {points: {O: [0, 0]}}
  lay: {points: {L: [0, 0]}}
joints:
  S: {type: pin, links: [ground, sun], at: O}
  A: {type: pin, links: [ground, arm], at: O}
  R: {type: pin, links: [ground, ring], at: O}
  L: {type: pin, links: [ground, lay]}
  P: {type: pin, links: [arm, planet]}
  SP: {type: gear, links: [sun, planet], at: [O, P], radii: [0.05, 0.05]}
  RP: {type: gear, links: [ring, planet], at: [O, P], radii: [0.15, 0.05], internal: true}
  AL: {type: gear, links: [arm, lay], at: [O, L], radii: [FIRST]}
  LR: {type: gear, links: [lay, ring], at: [L, O], radii: [SECOND]}
drives: {S: {position: 0, speed: 40 rad/s}}
loads: {load: {type: couple, on: arm, value: -200}}
"""


@pytest.mark.parametrize(("first", "second"), [((0.11, 0.11), (0.12, 0.10)), ((0.11, 0.11), (0.10, 0.12))])
def test_a_ring_geared_to_its_own_arm_lets_power_circulate(
    first: tuple[float, float], second: tuple[float, float]
) -> None:
    """With w_ring = k w_arm and torques as the radii, the ring carries 3 k/(4 - 3 k) of the input, the arm 1 more."""
    text = COUPLED.replace("FIRST", f"{first[0]}, {first[1]}").replace("SECOND", f"{second[0]}, {second[1]}")
    r = da.statics(da.loads(text))
    found, k = r.power_flow(), first[0] / first[1] * second[0] / second[1]
    arm = 40 / (4 - 3 * k)
    assert r.speed("arm") == pytest.approx([arm], rel=1e-12)
    assert found.input == pytest.approx([200 * arm], rel=1e-12)
    ring = 3 * k / (4 - 3 * k)
    assert found.links["ring"] == pytest.approx([ring * 200 * arm], rel=1e-12)
    assert found.links["arm"] == pytest.approx([(1 + ring) * 200 * arm], rel=1e-12)
    assert found.circulating == pytest.approx([ring * 200 * arm], rel=1e-12)
    assert (found.lost, found.output) == (pytest.approx([0], abs=1e-9), pytest.approx([200 * arm]))
    said = f"Power circulates: arm carries {number(1 + ring, 4)} times the power that is put in."
    assert said in found.text().splitlines()
