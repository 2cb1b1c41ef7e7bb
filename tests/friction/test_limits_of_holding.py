"""What friction at rest may do, at the limits of its parts: contacts without load, at their limit, faces of a guide."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.core.friction import unpowered_loads
from dalembert.core.friction.holding_range import (
    UNLOADED,
    _exact,
    _limits,
    _monotonic,
    _outward,
    _Rest,
    _scale,
    _slopes,
)
from dalembert.core.friction.losses import POWERLESS, by_joint, power_reversed
from dalembert.core.layout import ConstraintRows
from tests.friction.test_limits_of_friction import contacts, response


def rest(y: Any, h: Any, c: Any, **keys: Any) -> _Rest:
    some = contacts(np.shape(y)[-1], **keys)
    return _Rest(some, response(y, h), np.array(c, float), np.flatnonzero(~some.fixed & ~some.signed))


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_contact_without_load_may_change_sides(size: float, sign: float) -> None:
    """Beside 5 N a contact with less than 5e-9 N takes the side that it did not have; the first time that of a push."""
    h = np.zeros((1, 3, 2, 2))
    for part, loaded in ((0.9, False), (1.1, True), (-0.9, False), (-1.1, True)):
        y = size * np.array([[[sign * 5.0, 5 * UNLOADED * part], [0, 0], [0, 0]]])
        known = _slopes(rest(y, h, [1, 1]), np.zeros((1, 2)), None)[0]
        assert known[:, 0] == pytest.approx([sign, 0.0, 0.0])
        assert known[0, 1] == pytest.approx(math.copysign(1.0, part) if loaded else 1.0)
        assert known[1:, 1].tolist() == [0.0, 0.0]
        for side in (1.0, -1.0):
            before = np.array([[[1.0, side], [0.0, 0.0], [0.0, 0.0]]])
            again = _slopes(rest(y, h, [1, 1]), np.zeros((1, 2)), before)[0]
            assert again[0, 1] == pytest.approx(math.copysign(1.0, part) if loaded else -side)


def test_faces_of_a_guide_follow_the_friction_in_it() -> None:
    """4 N in the guide and a couple of -2 on its faces, by the strengths: what the guide rubs, the faces rub half of
    it, the other way; without a strength nothing, and where the guide is not loaded by the couple alone."""
    faces: dict[str, Any] = {"signed": [False, True], "leader": [0, 0]}
    h = np.zeros((1, 3, 2, 2))
    sides = np.array([[[1.0, 1.0], [0.0, 0.0], [0.0, 0.0]]])
    r = rest([[[4.0, -2.0], [0, 0], [0, 0]]], h, [1.0, 1.0], **faces)
    for guide, found in ((4.0, -0.5), (8.0, -0.25), (0.0, -2.0)):
        loaded = rest([[[guide, -2.0], [0, 0], [0, 0]]], h, [1.0, 1.0], **faces)
        assert _limits(loaded, np.zeros((1, 2)), sides)[0].tolist() == [[[1.0], [found]]]
    without = rest([[[4.0, -2.0], [0, 0], [0, 0]]], h, [1.0, 0.0], **faces)
    assert _limits(without, np.zeros((1, 2)), sides)[0].tolist() == [[[1.0], [0.0]]]
    alone = rest([[[4.0, 2.0], [0, 0], [0, 0]]], h, [1.0, 1.0])._replace(active=np.array([0]))
    assert _limits(alone, np.zeros((1, 2)), sides)[0].tolist() == [[[1.0], [0.0]]]
    ways = [
        ((1.0, 9.0), (1.0, -0.5)),
        ((-1.0, 9.0), (-1.0, 0.5)),
        ((9.0, 9.0), (4.0, -2.0)),
        ((0.0, 1.0), (0.0, 0.0)),
    ]
    for t, exact in ways:
        assert _exact(r, np.array([t])) == pytest.approx(np.array([exact]))
    free = rest([[[0.0, -2.0], [0, 0], [0, 0]]], h, [1.0, 1.0], **faces)
    assert _exact(free, np.array([[1.0, 9.0]])) == pytest.approx(np.zeros((1, 2)))
    before = np.array([[[1.0, 1.0], [0.0, 0.0], [0.0, 0.0]]])
    assert _slopes(r, np.zeros((1, 2)), before)[0][0] == pytest.approx([1.0, 1.0])


@pytest.mark.parametrize(("count", "starts"), [(1, 2), (16, 32), (17, 0)])
def test_the_search_starts_from_each_contact_up_to_sixteen(count: int, starts: int) -> None:
    some = rest(np.zeros((1, 3, count)), np.zeros((1, 3, count, count)), np.ones(count))
    assert _outward(some).shape == (starts, count)


def test_limits_of_a_change_are_what_the_linear_bearing_force_leaves() -> None:
    """S = 4 + t_1 / 2 at t = 1, c in units of t: 1 + dt <= 4.5 + dt / 2 and -(1 + dt) <= 4.5 + dt / 2."""
    h = np.zeros((1, 3, 1, 1))
    h[0, 0] = 0.5
    r = rest([[[4.0], [0.0], [0.0]]], h, [1.0])
    directions, g, limit = _limits(r, np.array([[1.0]]), np.array([[[1.0], [0.0], [0.0]]]))
    assert directions.tolist() == [[[1.0]]]
    assert g[0] == pytest.approx(np.array([[0.5], [-1.5]]))
    assert limit[0] == pytest.approx([3.5, 5.5])
    beyond = _limits(r, np.array([[9.0]]), np.array([[[1.0], [0.0], [0.0]]]))[2]
    assert beyond[0] == pytest.approx([0.0, 17.5])  # 9 > 8.5: no further, but never less than where it is
    assert _exact(r, np.array([[1.0]])).tolist() == [[1.0]]
    assert _outward(r).tolist() == [[1.0], [-1.0]]


def test_forces_are_scaled_by_the_largest_argument_and_the_strength() -> None:
    """8 N are 1, and a strength of 0.25 in t of 0.25 N; without friction the unit is 1."""
    some = contacts(3, lever=[0.25, 1.0, 1.0], resting=[1.0, 0.0, 1.0], fixed=[False, False, True])
    y = np.array([[[4.0, -8.0, 1.0], [0, 0, 0], [0, 0, 0]], np.zeros((3, 3))])
    h = np.ones((2, 3, 3, 3))
    found = _scale(some, response(y, h))
    assert found.r.y[0, 0] == pytest.approx([0.5, -1.0, 0.125])
    assert (found.r.y[1] == 0).all()
    assert found.c.tolist() == [1.0, 0.0, 1.0]
    assert found.r.h[0, 0] == pytest.approx(np.array([[0.25, 1.0, 1.0]] * 3))
    assert found.r.change[0] == pytest.approx(8 * np.array([[0.25, 1.0, 1.0]] * 2))
    assert found.active.tolist() == [0]


@pytest.mark.parametrize(
    ("k", "proved"), [(0.0, True), (0.3, True), (0.49, True), (0.51, False), (1.5, False)]
)
def test_an_effort_follows_each_contact_where_the_others_change_it_less(k: float, proved: bool) -> None:
    """Gains 1 and 1, each contact presses the other with k: by the bound 1 - k / (1 - k) > 0 below k = 1/2."""
    for sign in (1.0, -1.0):
        h = np.zeros((1, 3, 2, 2))
        h[0, 0] = sign * k * np.array([[0.0, 1.0], [1.0, 0.0]])
        r = rest([[[4.0, 4.0], [0, 0], [0, 0]]], h, [1.0, 1.0])
        for gains in ([[[1.0, 1.0]]], [[[-1.0, 1.0]]]):
            assert _monotonic(r, np.array(gains)).tolist() == [proved]
    h[0, 0] = [[0.0, 0.3], [0.3, 0.0]]  # gains 1 and 0.1: the second follows the first
    assert _monotonic(
        rest([[[4.0, 4.0], [0, 0], [0, 0]]], h, [1.0, 1.0]), np.array([[[1.0, 0.1]]])
    ).tolist() == [False]
    h[0, 0] = [[1.5, 0.0], [0.0, 0.0]]  # the first one presses itself too much
    assert _monotonic(
        rest([[[4.0, 4.0], [0, 0], [0, 0]]], h, [1.0, 1.0]), np.array([[[1.0, 1.0]]])
    ).tolist() == [False]
    h[0, 0] = k * np.array([[0.0, 1.0], [1.0, 0.0]])
    without = rest([[[4.0, 4.0], [0, 0], [0, 0]]], h, [1.0, 0.0])._replace(active=np.array([0]))
    assert _monotonic(without, np.array([[[1.0, 1.0]]])).tolist() == [True]


def test_losses_add_up_by_joint() -> None:
    assert by_joint(np.array([2, 0, 2]), 4, np.array([[1.0, 2.0, 3.0]])).tolist() == [[2.0, 0.0, 4.0, 0.0]]


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_friction_reverses_a_power_that_is_more_than_rounding(sense: float) -> None:
    """4 N at 3 m/s are 12 W: a power of the bare effort below 12e-9 W has no sign."""
    unknown = ConstraintRows(
        np.array([1, 1]), np.array([0, 0]), np.zeros(2, bool), np.zeros((2, 3)),
        np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]),
    )  # fmt: skip
    layout: Any = SimpleNamespace(
        wrench_scale=np.array([1.0, 1.0, 0.5]), constraints=SimpleNamespace(count=1), length=2.0
    )
    twist, w = np.array([[sense * 3.0, 0.0, 0.0], [0.0, 0.0, 0.0]]), np.array([[0.0, -4.0, 0.0]])
    for bare, with_friction, reverses in (
        (1.0, -1.0, True), (-1.0, 1.0, True), (1.0, 1.0, False), (1.0, 0.0, False),
        (4.1 * POWERLESS, -1.0, True), (3.9 * POWERLESS, -1.0, False), (-4.1 * POWERLESS, 1.0, True),
        (-3.9 * POWERLESS, 1.0, False),
    ):  # fmt: skip
        x, y = np.array([7.0, with_friction]), np.array([7.0, bare])
        assert bool(power_reversed(layout, unknown, twist, w, x, y)) is reverses, bare


NAN2 = (math.nan, math.nan)


@pytest.mark.parametrize(
    ("found", "loads", "solved"),
    [
        # by start: the loads where Newton ends; the first that all push forward, else the first at all
        ([(1.0, -2.0), (1.0, 2.0), (3.0, 4.0)], (1.0, 2.0), True),
        ([(-1.0, -1.0), (0.0, 2.0), (3.0, 4.0)], (0.0, 2.0), True),
        ([(3.0, 4.0), (1.0, 2.0)], (3.0, 4.0), True),
        ([(-1.0, 2.0), (-3.0, 4.0)], (-1.0, 2.0), True),
        ([None, None, (0.5, 0.25)], (0.5, 0.25), True),
        ([None, (-1.0, 2.0), None, (5.0, 6.0)], (5.0, 6.0), True),
        ([], NAN2, False),
    ],
)
def test_of_several_solutions_the_first_whose_loads_all_push_is_taken(
    found: list[tuple[float, float] | None],
    loads: tuple[float, float],
    solved: bool,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """At two positions at once: the second has the same starts the other way round."""
    starts: list[Any] = []
    both = [found + [None] * (8 - len(found)), [None] + found + [None] * (7 - len(found))]

    def newton(p: Any, u: Any) -> Any:
        here = [one[len(starts)] if len(starts) < 8 else None for one in both]
        starts.append(u.tolist())
        arrived = np.array([x is not None for x in here])
        least = np.where(arrived, 1.0 + len(starts), 0.0)
        return (
            np.array([NAN2 if x is None else x for x in here]),
            arrived,
            least,
            ~arrived & (len(starts) % 2 == 1),
        )

    monkeypatch.setattr(unpowered_loads, "_loaded", lambda *given: None)
    monkeypatch.setattr(unpowered_loads, "_size", lambda p, w: np.array([[7.0, 9.0]] * len(w)))
    monkeypatch.setattr(unpowered_loads, "_arranged", lambda p, u: u)
    monkeypatch.setattr(unpowered_loads, "_newton", newton)
    nothing: Any = None
    out = unpowered_loads.solve_unpowered(*(nothing,) * 6, np.zeros((2, 1, 3)), nothing, nothing)
    far = unpowered_loads.STARTS[0]
    assert starts[0] == [[7 * far, 9 * far]] * 2
    assert starts[3] == [[-7 * far, -9 * far]] * 2
    assert len(starts) == 4 * len(unpowered_loads.STARTS)
    assert np.array_equal(out[1], [loads, loads], equal_nan=True)
    assert out[3].tolist() == [solved, solved]
    if solved:
        assert out[2][0] == 2.0 + found.index(loads)
        assert out[2][1] == 3.0 + found.index(loads)


def test_where_every_start_jams_the_loads_are_those_of_the_first_sizes(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def newton(p: Any, u: Any) -> Any:
        return np.full((2, 1), math.nan), np.zeros(2, bool), np.zeros(2), np.array([True, bool(u[0, 0] > 0)])

    monkeypatch.setattr(unpowered_loads, "_loaded", lambda *given: None)
    monkeypatch.setattr(unpowered_loads, "_size", lambda p, w: np.array([[7.0], [9.0]]))
    monkeypatch.setattr(unpowered_loads, "_arranged", lambda p, u: u)
    monkeypatch.setattr(unpowered_loads, "_newton", newton)
    nothing: Any = None
    out = unpowered_loads.solve_unpowered(*(nothing,) * 6, np.zeros((2, 1, 3)), nothing, nothing)
    assert out[1][0].tolist() == [7.0]
    assert np.isnan(out[1][1]).all()
    assert out[2].tolist() == [1.0, 0.0]
    assert out[4].tolist() == [True, False]
