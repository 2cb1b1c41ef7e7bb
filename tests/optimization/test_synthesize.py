"""`da.synthesize`: a mechanism is found again from what it does, and misfits are least."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch.own_positions import OwnPositions
from dalembert.optimization.free_timing import FreeTiming
from dalembert.optimization.least_squares import wanted
from tests.tiers import tiers

MODEL = """dalembert: 1
gravity: none
links:
  ground: {points: {O2: [0, 0], O4: [0.3, 0.0]}}
  crank: {points: {O2: [0, 0], A: [0.1, 0]}}
  coupler: {points: {A: [0, 0], B: [0.28, 0], P: [0.14, 0.1]}}
  rocker: {points: {O4: [0, 0], B: [0.22, 0]}}
joints:
  O2: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, coupler]}
  B: {type: pin, links: [coupler, rocker]}
  O4: {type: pin, links: [ground, rocker]}
drives:
  O2: {position: {from: 0, to: 360 deg, count: 10}}
assembly: {coupler: 50 deg, rocker: 100 deg}
"""
VARY: dict[str, Any] = {
    "links.ground.points.O2": (-0.1, 0.1),
    "links.ground.points.O4": ("[0.15 m, -0.15 m]", "[0.45 m, 0.15 m]"),
    "links.crank.points.A.0": (0.05, 0.2),
    "links.coupler.points.B.0": (0.15, 0.45),
    "links.coupler.points.P": ("[0, 0]", "[0.3 m, 0.25 m]"),
    "links.rocker.points.B.0": (0.12, 0.4),
}


def made() -> da.Mechanism:
    """A four-bar in the bounds."""
    return da.loads(MODEL).with_values(
        {
            "links.ground.points.O2": (0.01, -0.02),
            "links.ground.points.O4": (0.33, 0.03),
            "links.crank.points.A.0": 0.09,
            "links.coupler.points.B.0": 0.3,
            "links.coupler.points.P": (0.17, 0.12),
            "links.rocker.points.B.0": 0.25,
        }
    )


def test_a_path_is_found_again() -> None:
    path = da.kinematics(made())["point.coupler.P"]
    found = da.synthesize(da.loads(MODEL), VARY, {"point.coupler.P": path}, starts=40)
    assert found.error < 1e-12
    assert found.exact > 10
    assert np.allclose(da.kinematics(found.mechanism)["point.coupler.P"], path, atol=1e-10)
    assert np.array_equal(
        da.synthesize(da.loads(MODEL), VARY, {"point.coupler.P": path}, starts=40).values, found.values
    )


@pytest.mark.parametrize("outputs", tiers([["point.coupler.P"]], [["point.coupler.P", "angle.coupler"]]))
@pytest.mark.parametrize("turn", tiers([0], [1, 2]))
def test_what_is_done_at_unknown_positions_is_found_again(outputs: list[str], turn: int) -> None:
    """A path, and a motion, with free timing: of drives that go round, have a range, and turn back."""
    q = np.radians([20.0, 61, 90, 130, 171, 222, 245, 280, 301, 330])
    given, q = [(None, q), ([0.2, 2.0, 4.0], q[:6]), ([4.0, 0.1], q[5::-1])][turn]
    k = da.compile(made(), outputs=outputs)
    r = k(positions=q)
    targets = {name: r.value(name)[0] for name in outputs}
    vary = VARY if given is None else dict(list(VARY.items())[2:4])
    model = da.loads(MODEL) if given is None else made()
    found = da.synthesize(model, vary, targets, given, starts=40, timing="free")
    assert found.error < 1e-10
    assert all(np.allclose(found.found[name], targets[name], atol=1e-9) for name in outputs)
    at = found.positions[:, 0]
    assert np.allclose(at, q, atol=1e-6)
    moved = da.compile(found.mechanism, outputs=outputs)(positions=at)
    assert np.allclose(moved.value(outputs[0])[0], targets[outputs[0]], atol=1e-9)


def test_derivatives_by_positions_of_their_own() -> None:
    """Beside differences, and the values beside those of the kernel itself; near stations and between them."""
    k = da.compile(made(), list(VARY), ["point.coupler.P", "angle.rocker"], derivatives=True, static=True)
    of = OwnPositions(k, np.linspace(0, 2 * np.pi, 36, endpoint=False))
    rng = np.random.default_rng(1)
    values, q = k.nominal * (1 + 0.03 * rng.standard_normal((3, 9))), rng.uniform(-0.5, 7, (3, 5))
    found, h = of(values, q), 1e-6
    assert found.ok.all()
    assert np.allclose((of(values, q + h).value - of(values, q - h).value) / (2 * h), found.slope[..., -1])
    for d in range(3):
        r = k(values[d], q[d])
        assert np.array_equal(r.value("point.coupler.P")[0], found.value[d, :, :2])
        assert np.allclose(r.gradient("angle.rocker")[0], found.slope[d, :, 2, :-1], rtol=1e-12)


def test_targets_count_by_their_spread_or_where_all_are_one_by_their_size() -> None:
    k = da.compile(made(), [], ["point.coupler.P", "angle.rocker"])
    for corners, size in ([[3, 1], [0, 5]], 5), ([[-3, 2], [-3, 2]], 3), ([[0, 0], [0, 0]], 1):
        target, spread = wanted(k, {"point.coupler.P": corners, "angle.rocker": [-2, -2]}, None)
        assert target.tolist() == [[*corners[0], -2], [*corners[1], -2]]
        assert spread.tolist() == [[size, size, 2]] * 2


def test_designs_close_between_the_targets() -> None:
    """A rocker that two positions leave whole, and that cannot go from one to the other."""
    vary: Any = {"links.coupler.points.B.0": (0.12, 0.14)}
    targets, ends = {"angle.rocker": [1.9, 1.8]}, np.radians([60.0, 300])
    m = da.loads(MODEL).with_values({"links.rocker.points.B.0": 0.14})
    k = da.compile(m.with_values({"links.coupler.points.B.0": 0.28}), list(vary), ["angle.rocker"])
    r = k([[0.13]], np.radians([60.0, 180, 300]))
    assert r.ok[0].tolist() == [True, False, True]
    with pytest.raises(da.ModelError, match="closes over the full range from the first target to the last"):
        da.synthesize(m, vary, targets, ends, starts=4)


@pytest.mark.long
def test_a_motion_at_other_positions() -> None:
    turned = np.radians([10.0, 60, 100, 170, 250])
    k = da.compile(made(), outputs=["point.coupler.P", "angle.coupler"])
    r = k(positions=turned)
    targets = {name: r.value(name)[0] for name in k.outputs}
    found = da.synthesize(da.loads(MODEL), VARY, targets, turned, starts=30)
    assert found.error < 1e-10
    assert all(np.allclose(found.found[name], targets[name], atol=1e-9) for name in targets)


def test_a_function_as_near_as_a_grid_of_designs() -> None:
    """Angles that no four-bar has: the least misfit of two numbers."""
    vary: Any = {"links.crank.points.A.0": (0.06, 0.12), "links.rocker.points.B.0": (0.18, 0.3)}
    m, turned = da.loads(MODEL), np.linspace(0.3, 2.5, 8)
    target = 1.6 + 0.2 * np.sin(turned) ** 3
    found = da.synthesize(m, vary, {"angle.rocker": target}, turned, starts=10)
    grid = np.array(np.meshgrid(*(np.linspace(*ends, 61) for ends in vary.values()))).reshape(2, -1).T
    off = da.compile(m, vary=list(vary), outputs=["angle.rocker"])(grid, turned).angle("rocker") - target
    best = float(np.sqrt(np.nanmin((off**2).mean(axis=1)))) / np.ptp(target)
    assert best * 0.9 <= found.error <= best * (1 + 1e-9)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"targets": {}}, "no targets are given"),
        ({"targets": {"point.coupler.P": [1.0]}}, "give 10 positions of 2 components"),
        ({"targets": {"angle.rocker": [np.nan] * 10}}, "not all finite"),
        ({"targets": {"angle.roker": [1.0] * 10}}, "did you mean 'angle.rocker'?"),
        ({"vary": {"links.crank.points.A.0": (0.1, 0.2, 0.01)}}, "takes no steps"),
        ({"vary": {"links.crank.points.A.0": (2.0, 2.1)}}, "can be solved at every position"),
        ({"timing": "fre"}, "timing is 'fre'"),
        ({"timing": "free", "targets": {"angle.rocker": 3.0}}, "targets of angle.rocker have shape ()"),
    ],
)
def test_wrong_targets(changed: dict[str, Any], message: str) -> None:
    given: dict[str, Any] = {"vary": VARY, "targets": {"angle.rocker": np.ones(10)}, "starts": 2, **changed}
    with pytest.raises(da.ModelError, match=re.escape(message)):
        da.synthesize(da.loads(MODEL), **given)


@pytest.mark.parametrize(
    ("ends", "turned"),
    [([0.2, 4.0], False), ([4.0, 0.2], False), ([0.0, 2 * np.pi], True), ([2 * np.pi, 0.0], True)],
)
def test_free_timing_begins_where_a_design_comes_nearest_either_way_round(
    ends: list[float], turned: bool
) -> None:
    """Positions between stations are met within half a station, in their order; of a whole turn it may go on."""
    k = da.compile(made(), ["links.rocker.points.B.0"], ["point.coupler.P"], derivatives=True, static=True)
    q = ends[0] + (ends[1] - ends[0]) * np.array([0.1, 0.34, 0.55, 0.8])
    targets = {"point.coupler.P": k([[0.25]], q).value("point.coupler.P")[0]}
    course = np.linspace(*ends, 25)
    timing = FreeTiming.of(k, np.array([0.2]), np.array([0.1]), targets, course)
    sense = 1.0 if ends[1] > ends[0] else -1.0
    assert (timing.closed, timing.sense) == (turned, sense)
    stations = timing.samples.stations
    assert stations[0] == ends[0]
    assert (stations[-1] == ends[1]) is not turned
    pitch = sense * 2 * np.pi / 72 if turned else (ends[1] - ends[0]) / 71
    assert np.diff(stations) == pytest.approx(np.full(71, pitch))
    x = timing.begin(np.array([[0.5]]))
    pitch = abs(stations[1] - stations[0])
    met = timing.places(x[0])[:, 0]
    away = np.abs((met - q + np.pi) % (2 * np.pi) - np.pi)
    assert away.max() <= 0.51 * pitch
    assert (np.diff(sense * met) > 0).all()
    assert timing.answers(np.array([[0.5]])).all()
    found = timing(np.hstack([[[0.5]], sense * q[None]]))
    assert float(found.cost[0]) < 1e-20
    assert timing(x).cost[0] > 1e-8
    far = timing.moved(x, np.full_like(x, -100.0))
    assert (np.diff(far[0, 1:]) > 0).all()
    if not turned:
        assert far[0, 1] > min(sense * np.array(ends)) - 1e-12


SHAPES: list[tuple[dict[str, Any], str]] = [
    (
        {"point.coupler.P": [1, 2, 3, 4]},
        "point.coupler.P have shape (4,), or are not all finite; give 4 positions of 2 components",
    ),
    (
        {"point.coupler.P": [[1, 2, 3]] * 4},
        "point.coupler.P have shape (4, 3), or are not all finite; give 4 positions of 2 components",
    ),
    (
        {"angle.rocker": [[1, 2]] * 4},
        "angle.rocker have shape (4, 2), or are not all finite; give 4 positions",
    ),
    (
        {"angle.rocker": [1, 2, 3, np.nan]},
        "angle.rocker have shape (4,), or are not all finite; give 4 positions",
    ),
    ({"angle.rocker": 1.0}, "angle.rocker have shape (), or are not all finite; give 4 positions"),
    (
        {"angle.rocker": [1, 2, 1, 2], "angle.coupler": [1, 2]},
        "angle.coupler have shape (2,), or are not all finite; give 4 positions",
    ),
]


@pytest.mark.parametrize(("targets", "says"), SHAPES)
def test_targets_that_do_not_fit_the_positions_are_refused(targets: dict[str, Any], says: str) -> None:
    for timing in ("given",) if targets == {"angle.rocker": 1.0} else ("given", "free"):
        with pytest.raises(da.ModelError) as refused:
            da.synthesize(made(), VARY, targets, np.radians([20.0, 60, 100, 140]), timing=timing, starts=1)
        assert str(refused.value) == f"targets of {says}"


def test_the_first_start_is_the_mechanism_itself() -> None:
    """Of many designs that do what is wanted, it is the one that is found, if it is one of them."""
    m = made()
    wave = "cos(900*links.crank.points.A.0)*cos(700*links.coupler.points.B.0)"
    targets = {wave: np.full(4, math.cos(900 * 0.09) * math.cos(700 * 0.3))}
    vary = {k: VARY[k] for k in ("links.crank.points.A.0", "links.coupler.points.B.0")}
    fixed = {**vary, "links.rocker.points.B.0": (0.25, 0.25)}
    for some in (vary, fixed):
        found = da.synthesize(m, some, targets, np.radians([20.0, 60, 100, 140]), starts=1)
        assert found.started == 2  # and a drawn one
        assert found.error < 1e-14
        assert found.values[:2] == pytest.approx([0.09, 0.3], rel=1e-14)
