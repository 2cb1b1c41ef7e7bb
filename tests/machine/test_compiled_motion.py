"""Motions of many designs in machine code: each is that of da.simulate, whatever stands beside it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from tests.machine.test_simulate import FOUR_BAR, TWO_SLIDES, own_energies, rotor

pytest.importorskip("llvmlite")
VARY = ["links.coupler.mass", "links.crank.points.A", "drives.O2.effort", "start.O2.speed"]


SPRINGS = """
links: {ground: {points: {O: [0, 0]}}, mid: {points: {M: [0, 0]}}, block: {points: {B: [0, 0]}, mass: 2}}
joints:
  M: {type: slider, links: [ground, mid], at: [O, M], direction: 0}
  B: {type: slider, links: [ground, block], at: [O, B], direction: 0}
drives: {M: {effort: 0}, B: {effort: 0}}
start: {M: {position: 0.5 m}, B: {position: 1.1 m}}
loads:
  k1: {type: spring, between: [ground.O, mid.M], stiffness: 100, free_length: 0.5}
  k2: {type: spring, between: [mid.M, block.B], stiffness: 300, free_length: 0.5}
"""
"""Springs in series: nothing between them has mass."""


def designs(k: Any, count: int) -> Any:
    """Numbers about those of the description."""
    return (k.nominal + 0.01 * (k.nominal == 0)) * np.random.default_rng(3).uniform(
        0.9, 1.1, (count, len(k.numbers))
    )


def simulated(values: Any, until: Any, count: int = 201) -> Any:
    """One design by da.simulate, its numbers put in by their paths."""
    mass, x, y, effort, speed = values
    m = da.loads(FOUR_BAR).with_values(
        {"links.coupler.mass": mass, "links.crank.points.A": (x, y), "drives.O2.effort": effort}
    )
    return da.simulate(m, until, start={"O2": {"position": "60 deg", "speed": float(speed)}}, count=count)


def test_each_design_is_that_of_simulate() -> None:
    outputs = ["effort.O2", "reaction.B", "reaction.A.magnitude * 2"]
    k = da.compile_motion(da.loads(FOUR_BAR), "0.4 s", VARY, outputs, count=21, tolerance=1e-11)
    values = designs(k, 9)
    r = k(values)
    assert r.ok.all()
    assert r.value("reaction.B").shape == (9, 21, 2)
    for d in (0, 4, 8):
        s = simulated(values[d], "0.4 s", 21)
        assert r.position[d] == pytest.approx(s.position("O2")[-1:], rel=1e-9)
        assert r.value("reaction.B")[d] == pytest.approx(s.result["reaction.B"], rel=1e-6, abs=1e-6)
        assert r.value("reaction.A.magnitude * 2")[d] == pytest.approx(
            s.result["reaction.A.magnitude * 2"], rel=1e-6
        )
    peak = da.compile_motion(da.loads(FOUR_BAR), "0.4 s", VARY, outputs, "peak", count=21, tolerance=1e-11)(
        values
    )
    assert peak.value("reaction.B") == pytest.approx(np.abs(r.value("reaction.B")).max(axis=1), rel=1e-12)
    last = da.compile_motion(da.loads(FOUR_BAR), "0.4 s", VARY, outputs, "final", tolerance=1e-11)(values)
    assert last.value("reaction.B") == pytest.approx(r.value("reaction.B")[:, -1], rel=1e-7)


def test_energy_is_kept() -> None:
    k = da.compile_motion(da.loads(FOUR_BAR), "2 s", ["start.O2.speed"], tolerance=1e-12)
    r = k(np.linspace(20, 60, 11))
    for speed, q, u in zip(r.values[:, 0], r.position[:, 0], r.speed[:, 0], strict=True):
        (j, v), (j0, v0) = own_energies(q), own_energies(np.pi / 3)
        assert j * u**2 / 2 + v == pytest.approx(j0 * speed**2 / 2 + v0, rel=1e-9)


def test_no_design_depends_on_what_stands_beside_it() -> None:
    k = da.compile_motion(da.loads(FOUR_BAR), "0.3 s", VARY, ["reaction.A.magnitude", "effort.O2"], "rms")
    values = designs(k, 37)
    whole, turned, one = k(values), k(values[::-1], threads=1), k(values[20])
    for name in k.outputs:
        assert (whole.value(name) == turned.value(name)[::-1]).all()
        assert whole.value(name)[20] == one.value(name)[0]
    assert (whole.position == turned.position[::-1]).all()


def test_a_condition_ends_each_design_at_its_own_time() -> None:
    until = ["1 s", "O2.position = 500 deg"]
    k = da.compile_motion(da.loads(FOUR_BAR), until, VARY, ["reaction.A.magnitude"], "final", tolerance=1e-12)
    values = designs(k, 9)
    values[4, -1] = 2.0  # too slow to arrive
    r = k(values)
    assert r.ended[4] == "time"
    assert {*r.ended[:4]} == {"O2.position = 500 deg"}
    assert k(values[4]).ended == ("time",)
    for d in (0, 8):
        s = simulated(values[d], until)
        assert r.time[d] == pytest.approx(s.time[-1], rel=1e-9)
        assert r.value("reaction.A.magnitude")[d] == pytest.approx(
            s.result["reaction.A.magnitude"][-1], rel=1e-7
        )


def test_a_rotor_runs_up_by_its_motor() -> None:
    """w = w0 (1 - exp(-T t / (I w0)))."""
    m = rotor(0.8, "drives: {O: {motor: {stall: 40 N*m, no_load: 150 rad/s}}}\nstart: {O: {position: 0}}")
    k = da.compile_motion(m, "2 s", ["drives.O.motor.stall", "drives.O.motor.no_load", "links.rotor.inertia"])
    values = np.array([[40, 150, 0.8], [80, 150, 0.8], [40, 100, 0.4]])
    stall, free, inertia = values.T
    assert k(values).speed[:, 0] == pytest.approx(free * (1 - np.exp(-2 * stall / inertia / free)), rel=1e-7)


def test_a_motor_with_corners_is_that_of_simulate() -> None:
    """Its points follow from a parameter; designs start before, between and beyond them. Steps go over the corners."""
    curve = "{speed: [0 rad/s, 10 rad/s, 25 rad/s, 60 rad/s], torque: [0.6*torque, torque, 5 N*m, 0 N*m]}"
    text = "parameters: {torque: 8 N*m}\n" + FOUR_BAR.replace("effort: 0", f"motor: {{curve: {curve}}}")
    k = da.compile_motion(da.loads(text), "0.6 s", ["torque", "start.O2.speed"], ["effort.O2"], "final")
    values = np.array([[8.0, 0.0], [6.0, 15.0], [10.0, 40.0], [8.0, 90.0], [7.0, -20.0]])
    r = k(values)
    for (torque, speed), found, effort in zip(values, r.speed, r.value("effort.O2"), strict=True):
        m = da.loads(text).with_values({"torque": torque, "start.O2.speed": speed})
        s = da.simulate(m, "0.6 s")
        assert found == pytest.approx(s.speed("O2")[-1:], rel=1e-7)
        assert effort == pytest.approx(s.result["effort.O2"][-1], rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("masses", [[0.0], [1.0, 0.0], [0.0, 0.0]])
def test_a_design_that_cannot_begin_is_undecided_also_without_others(masses: list[float]) -> None:
    """A part between two drives that has no mass: no step can be taken. With 1 kg its drives give 4 and -3 m/s."""
    text = TWO_SLIDES.replace("RUBS", "").replace("SPEED", "0").replace("MASS", ", mass: 1")
    k = da.compile_motion(da.loads(text), "1 s", ["links.a.mass"], ["effort.S"], "final")
    r = k(np.array(masses)[:, None])
    assert r.ok.tolist() == [m > 0 for m in masses]
    for d, mass in enumerate(masses):
        known = [4.0, -3.0] if mass else [np.nan, np.nan]
        assert r.speed[d] == pytest.approx(known, rel=1e-9, nan_ok=True)
        assert r.ended[d].startswith("time" if mass else "undecided: its steps became too small")


def test_a_motion_that_cannot_go_on_is_undecided() -> None:
    """With a short coupler the crank comes to a dead centre."""
    vary = ["links.coupler.points.B.0"]
    k = da.compile_motion(da.loads(FOUR_BAR), "0.3 s", vary, ["reaction.A.magnitude"], "peak", tolerance=1e-8)
    r = k([0.15, 0.1])
    assert r.ok.tolist() == [True, False]
    assert r.ended[1].startswith("undecided")
    assert np.isnan(r.value("reaction.A.magnitude")).tolist() == [False, True]


@pytest.mark.parametrize(
    ("change", "vary", "sentence"),
    [
        (
            (
                "effort: 0",
                "motor: {curve: {speed: [0 rad/s, 9 rad/s], torque: [4 N*m, 1 N*m]}, off: 1 s}",
            ),
            [],
            "has a curve, and switches",
        ),
        (
            ("effort: 0", "effort: {x: [0 s, 1 s], y: [0, 1], against: time, outside: zero}"),
            [],
            "the table of the effort of drive 'O2' repeats, or ends at zero",
        ),
        (("", ""), ["start.O4.speed"], "is not a number of a drive that forces move"),
        (("", ""), ["drives.O2.position"], "vary 'start.O2.position'"),
        ((FOUR_BAR, SPRINGS), [], "forces that move M move no mass; give its links masses"),
    ],
)
def test_what_it_cannot_do_it_says(change: tuple[str, str], vary: list[str], sentence: str) -> None:
    with pytest.raises(ModelError, match=sentence):
        da.compile_motion(da.loads(FOUR_BAR.replace(*change)), "1 s", vary)
    with pytest.raises(ModelError, match=r"'angle\.coupler' counts full turns"):
        da.compile_motion(da.loads(FOUR_BAR), "1 s", outputs=["angle.coupler"])


def test_springs_in_series_say_what_has_no_mass() -> None:
    with pytest.raises(ModelError, match="forces that move M move no mass; give its links masses"):
        da.simulate(da.loads(SPRINGS), "1 s")


def test_nothing_need_vary() -> None:
    k = da.compile_motion(da.loads(FOUR_BAR), "0.1 s", outputs=["effort.O2"], count=3)
    r, other = k(), k(np.zeros((2, 0)))
    s = da.simulate(da.loads(FOUR_BAR), "0.1 s", count=3)
    assert r.position == pytest.approx(s.position("O2")[-1:, None], rel=1e-7)
    assert (other.position == r.position).all()
    with pytest.raises(ModelError, match="do not fit 2 numbers"):
        da.compile_motion(da.loads(FOUR_BAR), "0.1 s", VARY[:1] + VARY[2:3])([1.0, 2.0, 3.0])
