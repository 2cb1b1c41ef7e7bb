"""Motions of many designs with events: each is that of da.simulate, whatever stands beside it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from tests.machine.rubbing_machines import machine
from tests.machine.test_simulate import FOUR_BAR
from tests.tiers import tiers

pytest.importorskip("llvmlite")
CRANKS = [seed for seed in range(200) if seed % 6 in (0, 1, 5)]
PRESS = Path(__file__).parents[2] / "docs" / "press.yaml"


def check(
    m: da.Mechanism, vary: list[str], outputs: list[str], until: Any, values: Any, most: int = 0
) -> Any:
    """Designs, each against its own simulation: the end, and the largest outputs over instants and events."""
    k = da.compile_motion(m, until, vary, outputs, "peak", tolerance=1e-11)
    r = k(values)
    assert r.redone <= most
    for d, design in enumerate(np.asarray(values)):
        own = m.with_values(dict(zip(k.numbers, design.tolist(), strict=True)))
        s = da.simulate(own, until, tolerance=1e-11)
        assert r.time[d] == pytest.approx(s.time[-1], rel=1e-9)
        assert r.position[d] == pytest.approx(s.schedule.position[-1], rel=1e-8, abs=1e-9)
        assert r.speed[d] == pytest.approx(s.schedule.speed[-1], rel=1e-8, abs=1e-9)
        for name in outputs:
            along = np.abs(s.result[name])
            known = np.isfinite(along).reshape(len(along), -1).all(axis=1)
            assert r.value(name)[d] == pytest.approx(along[known].max(axis=0), rel=1e-6, abs=1e-7)
        assert r.ended[d].startswith("at rest") == s.ended.startswith("at rest")
    return r


@pytest.mark.parametrize("seed", tiers([24], CRANKS[:6], CRANKS[6:]))
def test_random_machines_that_rub(seed: int) -> None:
    """Slider-cranks, four-bars and six-bars; in 24 the crank comes to rest."""
    m = da.mechanism(machine(seed))
    vary, outputs = ["links.rod.mass", "links.crank.inertia"], ["reaction.A.magnitude", "effort.O"]
    nominal = np.array([m.links["rod"].mass, m.links["crank"].inertia], float)
    check(m, vary, outputs, "0.3 s", nominal * [[0.8, 1.1]])


def test_a_press_from_rest() -> None:
    """It starts against friction; its load follows from the crank, and it ends at a speed."""
    until = ["0.4 s", "O.speed = 9 rad/s"]
    outputs = ["reaction.A.magnitude", "point.ram.B.velocity"]
    r = check(da.load(PRESS), ["mu", "links.ram.mass"], outputs, until, [[0.08, 60.0], [0.2, 80.0]])
    whole = da.compile_motion(
        da.load(PRESS), until, ["mu", "links.ram.mass"], outputs, "peak", tolerance=1e-11
    )
    assert (whole([[0.2, 80.0]]).time == r.time[1]).all()


STOPS = [
    (("effort: 0", "effort: -1 N*m, brake: 4 N*m"), ["drives.O2.brake"], [[4.0], [0.5], [9.0]]),
    (
        ("effort: 0", "motor: {stall: 6 N*m, no_load: 60 rad/s, off: 30 rad/s}"),
        ["links.coupler.mass"],
        [[1.0]],
    ),
    (
        ("effort: 0", "motor: {stall: 6 N*m, no_load: 60 rad/s, on: 0.05 s, off: 0.2 s}"),
        ["links.coupler.mass"],
        [[1.0]],
    ),
]


@pytest.mark.parametrize(("change", "vary", "values"), STOPS)
def test_brakes_and_switches(change: tuple[str, str], vary: list[str], values: Any) -> None:
    """A brake holds the crank where it comes to rest; motors are switched at a speed, and by time."""
    m = da.loads(FOUR_BAR.replace(*change))
    assert change[1] in FOUR_BAR.replace(*change)
    check(m, vary, ["reaction.A.magnitude"], "0.3 s", values)


SWUNG = """
links: {ground: {points: {O: [0, 0]}}, disc: {points: {O: [0, 0]}, inertia: 0.1}}
joints: {O: {type: pin, links: [ground, disc]}}
drives: {O: {motor: {stall: 3, no_load: 60 rad/s, on: 0.3 rad, off: 0.1 s}}}
start: {O: {position: 0, speed: 5 rad/s}}
loads: {T: {type: torsion_spring, joint: O, stiffness: 10, free_angle: 0}}
"""


def test_a_motor_that_was_switched_off_stays_off_where_it_was_switched_on() -> None:
    """A disc on a spring passes the angle at which its motor was switched on with every swing."""
    vary = ["links.disc.inertia"]
    r = check(da.loads(SWUNG), vary, ["effort.O"], "1.5 s", [[0.1], [0.08]])
    assert (r.value("effort.O") > 2.5).all()


TABLE = """
gravity: standard
links: {ground: {points: {O: [0, 0], W: [1, 0]}}, block: {points: {B: [0, 0]}, mass: 2}}
joints: {S: {type: slider, links: [ground, block], at: [O, B], direction: 0, friction: {coefficient: 0.1}}}
drives: {S: {effort: 0}}
start: {S: {position: 0.3 m, speed: 0}}
parameters: {push: 4 N}
loads:
  work: {type: force, on: block, at: B, value: push*sign(0.4 m - S), direction: 0 deg}
  spring:
    type: spring
    between: [ground.W, block.B]
    force: {x: [-0.2 m, 0 m, 0.1 m], y: [-40 N, 0 N, 30 N]}
    free_length: 0.6 m
"""


def test_corners_of_loads_and_tables_of_springs() -> None:
    """A block that swings over the jump of a force and the bends of a spring until friction holds it."""
    m = da.loads(TABLE)
    r = check(m, ["push", "links.block.mass"], ["reaction.S"], "2 s", [[4.0, 2.0], [1.0, 3.0]])
    assert all(text.startswith("at rest from") for text in r.ended) or (r.time == 2.0).all()


PUSHED = """
links: {ground: {points: {O: [0, 0]}}, block: {points: {B: [0, 0]}, mass: 2}}
joints: {S: {type: slider, links: [ground, block], at: [O, B]}}
drives: {S: {effort: {against: S, x: [0, 0.1, 0.3], y: [1 N, 5 N, -2 N], shift: 0.05 m}}}
start: {S: {position: -0.1, speed: 0.5}}
"""


def test_an_effort_by_a_table_is_even_beyond_its_ends() -> None:
    """Work along it: 1 N over 0.15 m, then trapezes; then 2 N against it, up to the end of the speed."""
    r = check(
        da.loads(PUSHED),
        ["links.block.mass"],
        ["effort.S"],
        ["S.speed = 0", "9 s"],
        [[2.0], [3.0]],
    )
    work = 0.15 * 1 + 0.1 * 3 + 0.2 * 1.5  # at 0.35 m
    assert r.position[:, 0] == pytest.approx(0.35 + (work + np.array([2.0, 3.0]) * 0.125) / 2, rel=1e-7)
    assert r.value("effort.S") == pytest.approx(5.0, rel=1e-3)


@pytest.mark.parametrize("reduce", [None, "envelope"])
def test_a_design_that_cannot_begin_has_no_numbers_beside_one_that_can(reduce: str | None) -> None:
    """A block without mass, and one of 1 kg, which 1 N pushes."""
    k = da.compile_motion(da.loads(PUSHED), "0.1 s", ["links.block.mass"], ["effort.S"], reduce, count=5)
    r, one = k([[0.0], [1.0]]), k([[1.0]])
    assert r.ok.tolist() == [False, True]
    assert "a part that moves has no inertia: forces that move S move no mass" in r.ended[0]
    assert np.isnan(r.value("effort.S")[0]).all()
    assert r.value("effort.S")[1] == pytest.approx(one.value("effort.S")[0])
    assert r.value("effort.S").shape == (2, 5 if reduce is None else 2)
    assert r.value("effort.S")[1] == pytest.approx(1.0)


def test_what_is_in_doubt_is_simulated_alone() -> None:
    """A design that comes to a dead centre beside one that does not says why it stops."""
    m = da.loads(FOUR_BAR.replace("effort: 0", "effort: 0, brake: 0.1 N*m"))
    k = da.compile_motion(m, "0.3 s", ["links.coupler.points.B.0"], ["reaction.A.magnitude"], "peak")
    r = k([0.15, 0.1])
    s = da.simulate(m.with_values({"links.coupler.points.B.0": 0.1}), "0.3 s", tolerance=1e-9)
    assert r.redone == 1
    assert r.ok.tolist() == [True, False]
    assert (
        r.ended[1].partition(":")[2] == s.ended.partition(":")[2]
    )  # when its steps become too small is rounding


@pytest.mark.parametrize(
    ("seed", "sentence"), [(2, "two or more drives that move"), (4, "two or more drives that move")]
)
def test_what_may_stick_several_ways_is_refused(seed: int, sentence: str) -> None:
    with pytest.raises(ModelError, match=sentence):
        da.compile_motion(da.mechanism(machine(seed)), "0.1 s")


BRAKED = """
links: {ground: {points: {O: [0, 0]}}, a: {points: {O: [0, 0]}, mass: 2}, b: {points: {O: [0, 0]}, mass: 1}}
joints:
  S: {type: slider, links: [ground, a], at: O}
  T: {type: slider, links: [ground, b], at: O, direction: 90}
parameters: {f: 3 N}
drives: {S: {effort: 1, brake: f}, T: {position: 0}}
start: {S: {position: 0, speed: 4}}
"""


def test_a_brake_beside_a_drive_that_stands_stops_in_closed_form() -> None:
    """2 kg from 4 m/s by f - 1 N: it stays behind t = 8/(f - 1) and s = 16/(f - 1)."""
    brake = np.array([3.0, 5.0, 9.0])
    r = da.compile_motion(da.loads(BRAKED), "9 s", ["f"], ["effort.S"], "final")(brake[:, None])
    assert r.redone == 0
    assert r.position == pytest.approx(np.stack([16 / (brake - 1), [0, 0, 0]], axis=1), rel=1e-9)
    assert r.ended == tuple(f"at rest from {8 / (f - 1):g} s on" for f in brake)
    assert (r.speed == 0).all()
