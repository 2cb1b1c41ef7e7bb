"""Motions in other units of mass, length and time: a watch, a crane and a planet move as a machine of 1 kg and 1 m."""

from __future__ import annotations

import re
from functools import cache
from typing import Any

import numpy as np
import pytest

import dalembert as da
from tests.tiers import crossed, tiers

CRANK = """
gravity: [0, <-9.80665 L T-2>]
links:
  ground: {points: {O: [0, 0], S: [<0.3 L>, <0.2 L>]}}
  crank: {points: {O: [0, 0], A: [<0.1 L>, 0]}, mass: <3 M>, center: [<0.04 L>, 0], inertia: <0.05 M L2>}
  rod: {points: {A: [0, 0], B: [<0.3 L>, 0]}, mass: <1.2 M>, center: [<0.1 L>, <0.01 L>], inertia: <0.01 M L2>}
  piston: {points: {B: [0, 0]}, mass: <2 M>}
joints:
  O: {type: pin, links: [ground, crank], damping: <0.01 M L2 T-1>}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, piston]}
  S: {type: slider, links: [ground, piston], at: [O, B], direction: 0 deg RUB}
drives: {O: {DRIVE}}
loads:
  spring: {type: spring, between: [ground.S, rod.B], stiffness: <40 M T-2>, free_length: <0.1 L>}
start: {O: {position: 40 deg, speed: <6 T-1> rad/s}}
assembly: {rod: -10}
"""
BLOCKS = """
gravity: none
links:
  ground: {points: {O: [0, 0], P: [<0.5 L>, 0]}}
  one: {points: {O: [0, 0]}, mass: <3 M>}
  two: {points: {O: [0, 0]}, mass: <1 M>}
joints:
  A: {type: slider, links: [ground, one], at: [O, O], direction: 0 deg, damping: <0.3 M T-1>}
  B: {type: slider, links: [one, two], at: [O, O], direction: 0 deg RUB}
drives:
  A: {effort: 0}
  B: {effort: 0, stops: {from: <-0.2 L>, to: <0.2 L>, restitution: 0.6}}
loads:
  spring: {type: spring, between: [ground.P, two.O], stiffness: <40 M T-2>, free_length: <0.3 L>}
start: {A: {position: 0, speed: <1 L T-1>}, B: {position: 0, speed: <2 L T-1>}}
"""
MACHINES = {
    "free": (CRANK, "effort: 0", ""),
    "motor": (CRANK, "motor: {stall: <9 M L2 T-2>, no_load: <20 T-1> rad/s}, brake: <0.7 M L2 T-2>", ""),
    "friction": (CRANK, "effort: <3 M L2 T-2>", ", friction: {coefficient: 0.1}"),
    "blocks": (BLOCKS, "", ""),
    "rest": (CRANK, "effort: 0, brake: <2 M L2 T-2>", ", friction: {coefficient: 0.4}"),
    "stops": (CRANK, "effort: <4 M L2 T-2>, stops: {to: 75 deg, restitution: 0.4}", ""),
}
COMPILED = ("free", "motor")


def machine(name: str, mass: float, length: float, time: float, more: str = "") -> Any:
    """One of the machines, every number times its units."""
    text, drive, rub = MACHINES[name]
    factors = {"M": mass, "L": length, "T": time}

    def scaled(found: re.Match[str]) -> str:
        number, *units = found[1].split()
        for unit in units:
            number = float(number) * factors[unit[0]] ** int(unit[1:] or 1)
        return repr(float(number))

    drive = drive if more == "" else re.sub(r", brake: <[^>]*>", "", drive)
    return da.loads(re.sub(r"<([^>]*)>", scaled, text.replace("DRIVE", drive).replace("RUB", rub)))


SCALES = [(1e-12, 1e6, 1e-3), (3e7, 4e-3, 7e-5)]
HARSH = [(1e15, 1.0, 1.0), (1e-15, 1.0, 1.0), (1e10, 1e-6, 1e3)]
HARSH += [(10.0**m, 10.0**k, 10.0**t) for m in (-15, 0, 15) for k in (-6, 0, 6) for t in (-6, 0, 6)]


def moved(name: str, scale: tuple[float, float, float]) -> da.Simulation:
    return da.simulate(machine(name, *scale), 1.5 * scale[2], count=31)


@cache
def moved_in_si(name: str) -> da.Simulation:
    return moved(name, (1.0, 1.0, 1.0))


@crossed("name, scale", MACHINES, SCALES)
def test_a_motion_has_the_same_digits_in_other_units(name: str, scale: tuple[float, float, float]) -> None:
    same_digits(name, scale)


@pytest.mark.long
@pytest.mark.parametrize("scale", HARSH)
@pytest.mark.parametrize("name", MACHINES)
def test_and_in_harsh_ones(name: str, scale: tuple[float, float, float]) -> None:
    same_digits(name, scale)


def same_digits(name: str, scale: tuple[float, float, float]) -> None:
    mass, length, time = scale
    one, other = moved_in_si(name), moved(name, scale)
    assert [e.name for e in one.events] == [e.name for e in other.events]
    assert other.doubt == one.doubt == ""
    for drive in one.drives:
        x = 1.0 if one.result.mechanism.drives[drive].turns else length
        for what, unit in (("position", x), ("speed", x / time), ("acceleration", x / time**2)):
            known, found = getattr(one, what)(drive), getattr(other, what)(drive) / unit
            assert found == pytest.approx(known, rel=1e-8, abs=1e-8 * np.abs(known).max())
    for joint in one.result.joints:
        known, found = one.result.reaction(joint), other.result.reaction(joint) / (mass * length / time**2)
        assert found == pytest.approx(known, rel=1e-7, abs=1e-7 * np.nanmax(np.abs(known)), nan_ok=True)
    works = {k: w / (mass * length**2 / time**2) for k, w in other.works.items()}
    most = max(np.abs(w).max() for w in one.works.values())
    for k, w in one.works.items():
        assert works[k] == pytest.approx(w, abs=1e-9 * most)


@pytest.mark.parametrize("scale", tiers(SCALES, HARSH))
@pytest.mark.parametrize("name", COMPILED)
def test_so_have_compiled_motions(name: str, scale: tuple[float, float, float]) -> None:
    mass, length, time = scale
    one, other = (
        da.compile_motion(
            machine(name, *s, "compiled"), 1.5 * s[2], outputs=["reaction.A.magnitude"], count=5
        )()
        for s in ((1.0, 1.0, 1.0), scale)
    )
    assert other.position == pytest.approx(one.position, rel=1e-9)
    assert other.speed * time == pytest.approx(one.speed, rel=1e-8)
    force = other.value("reaction.A.magnitude") / (mass * length / time**2)
    assert force == pytest.approx(one.value("reaction.A.magnitude"), rel=1e-7)
