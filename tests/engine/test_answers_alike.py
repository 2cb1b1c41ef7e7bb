"""Answers of every kind are read, compared, shown and pickled in the same way."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples

COUPLER = "links.coupler.mass"


def batch(**options: Any) -> Any:
    return da.compile(da.four_bar(), [COUPLER], ["effort.O2", "reaction.A"], **options)([[1.0], [2.0]])


def simulation() -> Any:
    m = da.slider_crank(crank=0.05, rod=0.2)
    return da.simulate(m, "0.1 s", start={"O2": {"position": "30 deg", "speed": "20 rad/s"}}, count=21)


def study(**options: Any) -> Any:
    m = da.load(examples()["pump"])
    return da.study(m, {"stroke": "± 0.5 mm"}, ["effort.O"], designs=20, **options).run()


def optimum() -> Any:
    return da.optimize(da.four_bar(), {COUPLER: (0.5, 2)}, "peak effort.O2", starts=4)


def front() -> Any:
    aims = ["effort.O2", "reaction.O4.magnitude"]
    return da.pareto(da.four_bar(), {"links.rocker.points.B.0": (0.2, 0.28)}, aims, points=3, starts=4)


def reversal() -> Any:
    m = da.load(cases()["seed-002-7g-engine-guide-100-mm"])
    path = f"drives.{next(iter(m.drives))}"
    turn = {"from": 0, "to": 720, "count": 9}
    return da.dynamics(m.with_values({f"{path}.position": turn, f"{path}.speed": 10.0}))


OPEN = {"links.coupler.points.B.0": [0.3, 0.1]}
"""A sweep whose second design does not close everywhere, so that it has NaN."""

NAMED: dict[str, tuple[Callable[[], Any], str, str]] = {
    "result": (
        lambda: da.statics(da.four_bar()),
        "reaction.A",
        "<Result of 'Four-bar linkage': 72 positions, 72 ok>",
    ),
    "open": (
        lambda: da.statics(da.four_bar().with_values({"links.coupler.points.B.0": 0.1})),
        "effort.O2",
        "<Result of 'Four-bar linkage': 72 positions, 43 ok, 29 not_assembled>",
    ),
    "sweep": (
        lambda: da.sweep(da.four_bar(), OPEN),
        "reaction.A.x",
        "<Sweep of links.coupler.points.B.0: 2 designs of 72 positions, 115 ok, 29 not_assembled>",
    ),
    "grid": (
        lambda: da.sweep(da.four_bar(), {COUPLER: [1.0, 2.0], "links.rocker.mass": [1.0, 2.0, 3.0]}),
        "effort.O2",
        "<Sweep of links.coupler.mass, links.rocker.mass: 2 x 3 designs of 72 positions, 432 ok>",
    ),
    "batch": (
        batch,
        "reaction.A.x",
        "<BatchResult of 'Four-bar linkage': 2 designs of 72 positions, 144 ok>",
    ),
    "reduced": (
        lambda: batch(reduce="peak"),
        "effort.O2",
        "<BatchResult of 'Four-bar linkage': 2 designs, 2 ok>",
    ),
    "study": (
        study,
        "effort.O",
        "<StudyResult of 'Piston pump by its parameters': 20 of 20 designs, 20 ok>",
    ),
    "simulation": (
        simulation,
        "energy.kinetic",
        "<Simulation of 'Slider-crank': 21 instants, ended at 0.1 s>",
    ),
}
RECORDS: dict[str, Callable[[], Any]] = {
    "flywheel": lambda: da.flywheel(da.dynamics(da.four_bar()), Cs=0.05),
    "shaking": lambda: da.shaking(da.dynamics(da.four_bar())),
    "optimum": optimum,
    "front": front,
    "spatial": lambda: da.statics(da.load(examples()["rssr"])),
    "loaded": lambda: da.dynamics(da.load(examples()["four_bar"])),
    "reversal": reversal,
}


@cache
def made(name: str) -> Any:
    return NAMED[name][0]() if name in NAMED else RECORDS[name]()


@pytest.mark.parametrize("name", NAMED)
def test_quantities_are_read_by_name(name: str) -> None:
    r, (_, quantity, shown) = made(name), NAMED[name]
    assert repr(r) == shown
    assert quantity in r
    assert "effort.nothing" not in r
    assert 3 not in r
    assert quantity.removesuffix(".x") in list(r.keys())
    sizes = (
        np.abs(r[quantity]) if r[quantity].ndim == np.ndim(r.codes) else np.linalg.norm(r[quantity], axis=-1)
    )
    value, place = r.peak(quantity)
    assert value == np.nanmax(sizes) == sizes[place]
    if name != "grid":
        assert len(r) == len(r[quantity])
    with pytest.raises(da.ModelError, match=r"effort\.nothing"):
        r.peak("effort.nothing")


def test_a_grid_counts_all_its_designs() -> None:
    s = made("grid")
    assert len(s) == 6
    assert len(s.peak("effort.O2").place) == 3


def test_a_peak_counts_both_sides_of_a_reversal() -> None:
    r = made("reversal")
    assert r.after is not None
    for joint in r.joints:
        assert r.peak(f"reaction.{joint}") == pytest.approx(r.worst("reaction", joint), rel=1e-15)


def test_a_peak_of_nothing_is_refused() -> None:
    r = da.kinematics(da.four_bar())
    with pytest.raises(da.ModelError, match=r"effort\.O2 has no value at any position"):
        r.peak("effort.O2")
    with pytest.raises(da.ModelError, match=r"reaction\.A has 2 numbers a design; ask for one"):
        made("reduced").peak("reaction.A")


@pytest.mark.parametrize("name", [*NAMED, *RECORDS])
def test_answers_are_pickled_and_compared(name: str) -> None:
    r = made(name)
    again = pickle.loads(pickle.dumps(r))
    assert again == r
    assert (again != r) is False
    assert r != "something else"


def test_other_numbers_are_not_equal() -> None:
    r = made("result")
    other = r.force_array.copy()
    other[3, 1, 0] += 1e-9
    assert replace(r, force_array=other) != r
    assert da.statics(da.four_bar()) == r
    assert da.statics(da.four_bar().with_values({COUPLER: 2.0})) != r
    assert da.statics(da.four_bar(), positions=36) != r
    assert batch() != made("reduced")
    assert study(seed=1) != made("study")
    assert da.flywheel(da.dynamics(da.four_bar()), Cs=0.04) != made("flywheel")


def test_a_kernel_takes_values_by_name() -> None:
    k = da.compile(da.four_bar(), [COUPLER, "links.rocker.mass"], ["effort.O2"])
    named = k({"links.rocker.mass": [1.0, 2.0]})
    mass = k.nominal[0]
    assert named == k([[mass, 1.0], [mass, 2.0]])
    assert k({COUPLER: 3.0, "links.rocker.mass": [1.0]}) == k([[3.0, 1.0]])
    with pytest.raises(
        da.ModelError, match=r"does not vary 'links.rocker.mas'; did you mean 'links.rocker.mass'"
    ):
        k({"links.rocker.mas": 1.0})
    with pytest.raises(
        da.ModelError, match=r"values do not fit each other: .*give one value, or one for each design"
    ):
        k({COUPLER: [1.0, 2.0], "links.rocker.mass": [1.0, 2.0, 3.0]})


def test_given_loads_have_names_in_a_result_and_in_a_kernel() -> None:
    """An arm with every kind of given load, by its closed form."""
    m = da.loads("""
units: {angle: rad}
links:
  ground: {points: {O: [0, 0], S: [0, 3]}}
  arm: {points: {O: [0, 0], P: [2, 0]}}
joints: {O: {type: pin, links: [ground, arm]}}
drives: {O: {position: [0.3, 1.1, 2.0], speed: 2 rad/s, acceleration: 0 rad/s^2}}
loads:
  F: {type: force, on: arm, at: P, value: [5, "3*O"]}
  G: {type: force, on: arm, at: P, value: 7 @ 0.5, axes: link}
  M: {type: couple, on: arm, value: "-4*O"}
  K: {type: spring, between: [arm.P, ground.S], stiffness: 100, free_length: 1}
  T: {type: torsion_spring, joint: O, stiffness: 6, free_angle: 0.2}
  D: {type: torsion_damper, joint: O, damping: 0.5}
""")
    r = da.dynamics(m)
    turn = np.array([0.3, 1.1, 2.0])
    line = np.array([0, 3]) - 2 * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    length = np.linalg.norm(line, axis=1)
    want = {
        "load.F": np.stack([np.full(3, 5.0), 3 * turn], axis=1),
        "load.G": 7 * np.stack([np.cos(turn + 0.5), np.sin(turn + 0.5)], axis=1),
        "load.M": -4 * turn,
        "load.K": (100 * (length - 1) / length)[:, None] * line,
        "load.T": -6 * (turn - 0.2),
        "load.D": np.full(3, -1.0),
    }
    assert [name for name in r.keys() if name.startswith("load.")] == list(want)  # noqa: SIM118
    kernel = da.compile(m, outputs=[*want, "load.K.magnitude"])()
    for name, values in want.items():
        assert r[name] == pytest.approx(values, rel=1e-12, abs=1e-12), name
        assert kernel[name].reshape(values.shape) == pytest.approx(values, rel=1e-12, abs=1e-12), name
    assert kernel["load.K.magnitude"].ravel() == pytest.approx(100 * np.abs(length - 1), rel=1e-12)
    assert r.peak("load.K").value == pytest.approx(100 * np.abs(length - 1).max())
    assert not any("load." in column.name for column in r.columns())
