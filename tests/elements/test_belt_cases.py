"""Visible cases of belts and ropes: to 1e-8 of the exact value, to the source's rounding."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import dalembert as da

CASES: dict[str, dict[str, Any]] = {
    c["id"]: c for c in json.loads(Path(__file__).with_name("belt_cases.json").read_text(encoding="utf-8"))
}
Read = Callable[[str], Iterator[float]]

BEVAN = """
units: {length: ft, force: lbf, mass: lbm, time: s}
links: {ground: {points: {A: [0, 0], B: [10, 0]}}, motor: {points: {A: [0, 0]}}, shaft: {points: {B: [0, 0]}}}
joints:
  A: {type: pin, links: [ground, motor]}
  B: {type: pin, links: [ground, shaft]}
  belt: {type: belt, links: [motor, shaft], at: [A, B], radii: [1, 1 + 10*sin(7.5 deg)], tension: 500,
         friction: {coefficient: 0.3}, mass_per_length: MASS}
drives: {A: {position: 0, speed: SPEED rad/s}}
"""
HP = 550 * 0.3048 * 4.4482216152605


def crossed_belt(file: str) -> Iterator[float]:
    """Its load is unknown beside the effort of its drive: the limit needs no forces."""
    b = da.kinematics(da.loads(file)).belt("belt")
    yield b.length
    yield math.degrees(b.wrap[1])
    yield b.limit.slack[0]
    yield b.limit.power[0] / 1e3


def belt_with_inertia(file: str) -> Iterator[float]:
    r = da.dynamics(da.loads(file))
    b = r.belt("belt")
    yield from (b.tight[0], b.slack[0], r.effort("A")[0], b.slip_coefficient[0])
    yield abs(r.reaction("A")[0][0])
    yield abs(r.reaction("A")[0][1])


def bevan(mass: str, speed: float) -> da.Result:
    text = BEVAN.replace("MASS", mass).replace("SPEED", str(speed))
    return da.statics(da.loads(text))


def belt_without_mass(_: str) -> Iterator[float]:
    yield bevan("0", 60).belt("belt").limit.power[0] / HP


def belt_with_mass(_: str) -> Iterator[float]:
    mass = f"{1.2 * 4.4482216152605 / (32.2 * 0.3048**2)!r} kg/m"  # the book divides by 32.2 ft/s2
    limit = bevan(mass, 60).belt("belt").limit
    yield limit.power[0] / HP
    yield limit.best_speed / 0.3048
    yield limit.best_power / HP


UPRIGHT = {"direction: 0}": "direction: -90}", "type: rope,": "type: rope, parallel: true,"}
"""ROP-1 as its words have it: the rope comes up and leaves downwards, so that the geometry gives half a turn. As
written the hand moves sideways and the load has no place."""


def bollard(file: str) -> Iterator[float]:
    for one, other in UPRIGHT.items():
        file = file.replace(one, other)
    yield from da.statics(da.loads(file)).interval("out")[0]
    hauled = file.replace("turns: 2", "turns: 0").replace("speed: 0}", "speed: 0.1}")
    yield da.statics(da.loads(hauled)).effort("out")[0]


def tackle(file: str) -> Iterator[float]:
    m = da.loads(file)
    r = da.statics(m)
    yield r.effort("pull")[0]
    yield da.statics(m.with_values({"drives.pull.speed": -0.4})).effort("pull")[0]
    yield da.efficiency(r).forward[0]
    yield r.rope("rope").tension[0][-1]
    on_ground = [n for n in r.joints if "ground" in r.mechanism.joints[n].links]
    yield math.hypot(*sum(r.reaction(n, on="ground")[0] for n in on_ground))


def atwood(file: str) -> Iterator[float]:
    s = da.simulate(da.loads(file), until="0.05 s")
    rope = s.result.rope("rope")
    yield from (s.acceleration("a")[0], *rope.tension[0], rope.slip_coefficient[0])
    locked = file.replace("friction: 0.15", "friction: 0.1").replace("O: {type: pin", "O: {type: weld")
    yield da.simulate(da.loads(locked), until="0.05 s").acceleration("a")[0]


def moving_pulley(file: str) -> Iterator[float]:
    m = da.loads(file)
    s = da.simulate(m, until="0.05 s")
    yield s.acceleration("g1")[0]
    yield s.result.rope("rope").tension[0][0]
    # upwards: the block falls by half of what the end rises
    given_up = file.split("drives:")[0] + "drives: {g2: {position: 1, speed: 0, acceleration: FAST}}"

    def tension(acceleration: float) -> float:
        r = da.dynamics(da.loads(given_up.replace("FAST", str(-acceleration))))
        assert r.status == ("ok" if acceleration < 19.6 else "slack",)
        return float(r.rope("rope").tension[0][0])

    low, high = tension(12.0), tension(24.0)
    yield 12 + 12 * low / (low - high)


READ: dict[str, Read] = {
    "ROP-1": bollard,
    "ROP-2": tackle,
    "ROP-4": atwood,
    "ROP-6": moving_pulley,
    "BLT-11": crossed_belt,
    "BLT-13": belt_with_inertia,
    "BLT-1": belt_without_mass,
    "BLT-2": belt_with_mass,
}


@pytest.mark.parametrize("case", READ)
def test_case(case: str) -> None:
    quantities = CASES[case]["quantities"]
    computed = list(READ[case](CASES[case].get("file", "")))
    assert len(computed) == len(quantities)
    for value, q in zip(computed, quantities, strict=True):
        assert value == pytest.approx(q["exact"], rel=1e-8, abs=1e-12), q["name"]
        if "printed" in q:
            assert value == pytest.approx(q["printed"], rel=q["tolerance"]), q["name"]
