"""Targets at their limits: what is a whole turn, the order of stations, bounds that hold, errors that are not known."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import numpy as np
import pytest

from dalembert.optimization.free_timing import TURN, FreeTiming, _in_order, goes_round
from dalembert.optimization.least_squares import TargetErrors

UNKNOWN: Any = None


@pytest.mark.parametrize(
    ("positions", "round_"),
    [
        ([0.0, 0.991], True),  # the ends of a range are a whole turn from 99 parts of 100 on
        ([0.0, 0.989], False),
        ([0.991, 0.0], True),
        ([0.25, 1.25], True),
        ([0.25, -0.75], True),
        ([0.0, 0.5], False),  # two positions are ends, not every other one of even positions
        ([0.0, 1 / 3, 2 / 3], True),  # three are even ones without the end
        ([2 / 3, 1 / 3, 0.0], True),
        ([0.5, 0.5 + 1 / 3, 0.5 + 2 / 3], True),
        ([0.0, 0.2, 0.4, 0.6, 0.8 * 0.992], True),  # within a hundredth of even ones
        ([0.0, 0.2, 0.4, 0.6, 0.8 * 1.008], True),
        ([0.0, 0.2, 0.4, 0.6, 0.8 * 0.988], False),
        ([0.0, 0.2, 0.4, 0.6, 0.8 * 1.012], False),
    ],
)
def test_what_counts_as_a_whole_turn(positions: list[float], round_: bool) -> None:
    for start in (0.0, -0.4, 3.0):
        assert goes_round((np.array(positions) + start) * TURN) is round_


@pytest.mark.parametrize(("targets", "stations"), [(1, 4), (2, 5), (3, 5), (4, 4)])
def test_the_cheapest_stations_in_order_are_those_of_trying_all(targets: int, stations: int) -> None:
    """Each target has a station of its own, after that of the one before."""
    rng = np.random.default_rng(targets)
    cost = rng.integers(0, 9, (30, targets, stations)).astype(float)
    total, at = _in_order(cost)
    rows = np.arange(targets)
    every = [np.array(some) for some in combinations(range(stations), targets)]
    for k, each in enumerate(cost):
        assert total[k] == min(each[rows, some].sum() for some in every)
        assert each[rows, at[k]].sum() == total[k]
        assert (np.diff(at[k]) > 0).all()


def errors_of(target: Any, spread: Any, unknowns: int) -> TargetErrors:
    return TargetErrors(UNKNOWN, np.zeros(unknowns), np.ones(unknowns), target, spread, None)


def test_a_design_with_one_unknown_error_or_slope_costs_without_end() -> None:
    f = errors_of(np.array([[1.0, 2.0], [3.0, 4.0]]), np.array([0.5, 2.0]), 3)
    value, slope = np.tile([[2.0, 0.0], [2.0, 8.0]], (4, 1, 1)), np.ones((4, 2, 2, 3))
    value[1, 1, 0] = np.nan
    slope[2, 0, 1, 2] = np.nan
    slope[3, 1, 0, 0] = np.inf
    found = f.errors(value, slope)
    assert found.error[0].tolist() == [2.0, -1.0, -2.0, 2.0]
    assert found.cost.tolist() == [(4 + 1 + 4 + 4) / 2, np.inf, np.inf, np.inf]
    assert found.slope[0].tolist() == [[2.0] * 3, [0.5] * 3, [2.0] * 3, [0.5] * 3]
    assert not found.error[1:].any()
    assert not found.slope[1:].any()


def test_a_bound_holds_what_is_pushed_against_it_and_a_step_ends_there() -> None:
    f = errors_of(np.zeros((1, 1)), np.ones(1), 3)
    places, held = np.array([[0.0, 1e-9, 0.5], [1.0, 1 - 1e-9, 0.5]]), {1.0: [], -1.0: []}
    for way in held:  # the slope by which the cost falls against it
        held[way] = f.held(places, np.full((2, 3), way)).tolist()
    assert held == {1.0: [[True, False, False], [False] * 3], -1.0: [[False] * 3, [True, False, False]]}
    assert not f.held(places, np.zeros((2, 3))).any()
    moved = f.moved(np.array([[0.2, 0.2, 0.2, 0.9, 0.9]]), np.array([[-0.1, -0.2, -0.3, 0.1, 0.2]]))
    assert moved == pytest.approx(np.array([[0.1, 0.0, 0.0, 1.0, 1.0]]), abs=1e-15)
    assert (moved.min(), moved.max()) == (0.0, 1.0)


class _Stations:
    stations = np.array([-1.0, 4.0])


@pytest.mark.parametrize(
    ("sense", "closed", "low", "high"),
    [(1.0, False, -1.0, 4.0), (-1.0, False, -4.0, 1.0), (1.0, True, 3.0 - TURN, 1.0 + TURN)],
)
def test_a_position_moves_by_less_than_half_of_its_distance_to_the_next(
    sense: float, closed: bool, low: float, high: float
) -> None:
    """0.45 of it, between the ends of the range, or of a whole turn as far as the last and the first target."""
    places = [1.0, 1.5, 3.0] if sense > 0 else [-3.0, -1.5, -1.0]
    if closed:
        low, high = places[-1] - TURN, places[0] + TURN
    samples: Any = _Stations()
    f = FreeTiming(
        UNKNOWN, np.zeros(1), np.ones(1), np.zeros((3, 1)), np.ones(1), None, samples, sense, closed
    )
    x = np.array([[0.5, *places]])
    gaps = 0.45 * np.diff([low, *places, high])
    for way in (1.0, -1.0):
        far = f.moved(x, np.full((1, 4), 100.0 * way))[0]
        end = gaps[1:] if way > 0 else -gaps[:-1]
        assert far.tolist() == pytest.approx([max(way, 0.0), *(np.array(places) + end)])
    near = f.moved(x, np.array([[0.1, 0.1, -0.2, 0.15]]))[0]
    assert near.tolist() == pytest.approx([0.6, 1.1, 1.3, 3.15] if sense > 0 else [0.6, -2.9, -1.7, -0.85])
    held = f.held(np.array([[0.0, 0.0, 1.0, 0.0]]), np.ones((1, 4)))
    assert held.tolist() == [[True, False, False, False]]
