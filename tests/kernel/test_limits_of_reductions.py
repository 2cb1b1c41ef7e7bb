"""Reductions over the positions at their limits: ties, ends, peaks between positions, cycles; by hand."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from dalembert.analysis.batch.over_positions import (
    cycle_slope,
    finish_reduction,
    is_cycle,
    larger_side,
    neighbours,
    parabola,
    reduce_cycle,
    reduce_positions,
    reduce_sides,
    slope,
)
from dalembert.errors import ModelError

NAN, TURN = math.nan, 2 * math.pi
VALUES = np.array([[1.0, 3.0], [-4.0, 0.0], [2.0, -3.0], [1.0, 0.0]])


@pytest.mark.parametrize(
    ("word", "known"),
    [
        ("peak", [4.0, 3.0]),
        ("mean", [0.0, 0.0]),
        ("rms", [math.sqrt(22 / 4), math.sqrt(18 / 4)]),
        ("envelope", [[-4.0, 2.0], [-3.0, 3.0]]),
        ("argpeak", [1.0, 0.0]),
        ("squares", [22.0, 18.0]),
        ("norm8", [((1 + 4**8 + 2**8 + 1) / 4) ** 0.125, (2 * 3**8 / 4) ** 0.125]),
    ],
)
@pytest.mark.parametrize("size", [1e-30, 1.0, 1e60])
def test_reductions_are_those_of_their_names_at_any_size(word: str, known: Any, size: float) -> None:
    scale = {"argpeak": 1.0, "squares": size**2}.get(word, size)
    assert reduce_positions(word, size * VALUES) / scale == pytest.approx(np.array(known), rel=1e-12)
    assert (reduce_positions(word, 0 * VALUES) == 0).all()
    count, square = len(VALUES), (VALUES**2).sum(axis=0)
    parts = {
        "mean": [VALUES.sum(axis=0)],
        "rms": [square],
        "squares": [square],
        "norm8": [(VALUES**8).sum(axis=0)],
    }
    parts |= {"peak": [np.abs(VALUES).max(axis=0)], "argpeak": [np.array([1.0, 0.0])]}
    parts |= {"envelope": [VALUES.min(axis=0), VALUES.max(axis=0)]}
    assert finish_reduction(word, parts[word], count) == pytest.approx(np.array(known))


def test_of_equal_peaks_the_first_counts_within_rounding() -> None:
    for off, place in ((0.0, 0), (0.9e-12, 0), (1.1e-12, 2), (-1.1e-12, 0)):
        for sign in (1.0, -1.0):
            values = np.array([[1.0], [0.5], [sign * (1 + off)]])
            assert reduce_positions("argpeak", values).tolist() == [place]
    with pytest.raises(ModelError, match="unknown reduction 'most'"):
        reduce_positions("most", VALUES)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_peak_between_positions_is_that_of_a_parabola(sign: float) -> None:
    """5 - (x - 1.3)^2 at 0 to 3: 5 at 1.3; at an end the end itself, in a cycle by the other end's neighbours."""
    x = np.arange(4.0)
    values = sign * (5 - (x - 1.3) ** 2)[:, None]
    assert reduce_positions("refined_peak", values) == pytest.approx([5.0])
    assert reduce_positions("refined_place", values) == pytest.approx([1.3])
    rising = sign * np.array([1.0, 2.0, 3.0, 5.0])[:, None]
    assert reduce_positions("refined_peak", rising).tolist() == [5.0]
    assert reduce_positions("refined_place", rising).tolist() == [3.0]
    first = sign * np.array([5.0, 3.0, 1.0, 4.0])[:, None]
    assert reduce_positions("refined_place", first).tolist() == [0.0]
    # 4, 5, 3: vertex (4 - 3) / (2 (4 - 10 + 3)) = -1/6, that is 4 - 1/6 behind
    assert reduce_positions("refined_place", first, True) == pytest.approx([4 - 1 / 6])
    assert reduce_positions("refined_peak", first, True) == pytest.approx([5 + 1 / 24])
    for word in ("refined_peak", "refined_place"):
        assert np.isnan(reduce_positions(word, np.array([[1.0], [NAN], [0.5]]))).all()
    flat = sign * np.full((4, 1), 2.0)
    assert reduce_positions("refined_peak", flat).tolist() == [2.0]
    assert reduce_positions("refined_place", flat, True).tolist() == [0.0]


def test_a_parabola_turns_at_most_half_a_step_away() -> None:
    for values, place in (
        ([1.0, 5.0, 5.0], 0.5), ([5.0, 5.0, 1.0], -0.5), ([1.0, 5.0, 1.0], 0.0), ([1.0, 2.0, 9.0], -0.5),
        ([9.0, 2.0, 1.0], 0.5),
        ([-1.0, -5.0, -3.0], 1 / 6), ([2.0, 2.0, 2.0], 0.0), ([1.0, 2.0, 3.0], 0.0), ([NAN, 2.0, 3.0], 0.0),
    ):  # fmt: skip
        found = parabola(np.array(values), np.array(True))
        assert float(found.place) == pytest.approx(place)
        assert float(found.weights.sum()) == pytest.approx(1.0)
        ends = parabola(np.array(values), np.array(False))
        assert float(ends.place) == 0.0
        assert ends.place_slope.tolist() == [0.0, 0.0, 0.0]
    values, h = np.array([1.0, 5.0, 2.0]), 1e-6
    found = parabola(values, np.array(True))
    for k in range(3):
        more = values + h * np.eye(3)[k]
        away = (parabola(more, np.array(True)).place - found.place) / h
        assert float(away) == pytest.approx(float(found.place_slope[k]), rel=1e-4, abs=1e-7)
    three, inner = neighbours(np.array([0, 1, 3]), 4, False)
    assert three.tolist() == [[3, 0, 2], [0, 1, 3], [1, 2, 0]]
    assert inner.tolist() == [False, True, False]
    assert neighbours(np.array([0, 3]), 4, True)[1].tolist() == [True, True]
    assert neighbours(np.array([0, 1]), 2, True)[1].tolist() == [False, False]
    assert neighbours(np.array([0]), 3, True)[1].tolist() == [True]


@pytest.mark.parametrize(
    ("positions", "turns", "cycle"),
    [
        (np.arange(4) * TURN / 4, True, True),
        (np.arange(4) * TURN / 4, False, False),
        (-np.arange(4) * TURN / 4, True, True),
        (np.arange(4) * TURN / 2, True, True),  # two turns
        (np.arange(4) * TURN / 5, True, False),
        (np.arange(4) * TURN / 4 * (1 + 2e-7), True, True),  # 4 * 2e-7 of a step
        (np.arange(4) * TURN / 4 * (1 + 3e-7), True, False),
        (np.arange(4) * TURN / 4 * (1 - 3e-7), True, False),
        (np.arange(2) * TURN / 2, True, False),
        (np.arange(3) * TURN / 3, True, True),
        (np.zeros(4), False, True),
    ],
)
def test_a_cycle_leads_from_its_last_position_to_its_first(positions: Any, turns: bool, cycle: bool) -> None:
    assert is_cycle(positions[:, None], [turns]) is cycle
    both = np.stack([positions, 0 * positions], axis=-1)
    assert is_cycle(both, [turns, False]) is cycle
    assert is_cycle(np.stack([positions, np.arange(len(positions))], axis=-1), [turns, False]) is False
    if len(positions) > 2:
        with pytest.raises(ModelError, match="not evenly spaced"):
            is_cycle(np.stack([positions, np.arange(len(positions)) ** 2], axis=-1), [turns, False])


@pytest.mark.parametrize(("off", "even"), [(0.9e-6, True), (1.2e-6, False), (-1.2e-6, False)])
def test_a_peak_is_refined_between_even_positions_only(off: float, even: bool) -> None:
    positions = np.array([0.0, 1.0, 2.0 + off / 2])
    if even:
        assert is_cycle(positions[:, None], [False]) is False
    else:
        positions[2] = 2.0 + off
        with pytest.raises(ModelError, match="not evenly spaced"):
            is_cycle(positions[:, None], [False])


def test_both_sides_of_a_reversal_count() -> None:
    before, after = np.array([[1.0], [-2.0]]), np.array([[1.0], [3.0]])
    assert reduce_sides("peak", [before, after]).tolist() == [3.0]
    assert reduce_sides("argpeak", [before, after]).tolist() == [1.0]
    assert reduce_sides("mean", [before, after]).tolist() == [0.75]
    assert reduce_sides("squares", [before, after]).tolist() == [7.5]
    assert reduce_sides("squares", [before]).tolist() == [5.0]
    assert reduce_sides("envelope", [before, after]).tolist() == [[-2.0, 3.0]]
    assert reduce_sides("refined_peak", [before, after]).tolist() == [3.0]
    assert larger_side([before, after], [before, after]).tolist() == [[1.0], [3.0]]
    assert larger_side([after, before], [after, before]).tolist() == [[1.0], [3.0]]
    assert larger_side([before, -before], [before, -before]) is not None
    assert (
        larger_side([before, -before], [before, -before]).tolist() == before.tolist()
    )  # of equal ones the first
    assert larger_side([before], [before]) is before
    assert larger_side([after, -after - 1], [after, -after - 1]).tolist() == [[-2.0], [-4.0]]
    rates = np.stack([before[..., None] * 10, after[..., None] * 10])
    assert larger_side([before, after], list(rates)).tolist() == [[[10.0]], [[30.0]]]


def test_words_of_a_cycle_and_their_slopes_are_those_of_differences() -> None:
    rng = np.random.default_rng(2)
    values, rates, h = rng.normal(size=(5, 3)), rng.normal(size=(5, 3, 2)), 1e-6
    values[:, 1] = [4.0, 3.0, 9.0, -2.0, -1.0]
    values[:, 2] = [-4.0, -3.0, -2.0, -9.0, 1.0]
    rates[1] = 0.0
    for word in ("peak", "mean", "rms", "squares", "norm8", "least", "greatest", "range", "final"):
        found = cycle_slope(word, values, rates)
        for k in range(2):
            ends = [reduce_cycle(word, values + s * h * rates[..., k]) for s in (1, -1)]
            assert found[:, k] == pytest.approx((ends[0] - ends[1]) / (2 * h), rel=1e-6, abs=1e-7), word
    for word in ("refined_peak", "refined_place"):
        for cycle in (True, False):
            found = slope(word, values, rates, cycle)
            for k in range(2):
                ends = [reduce_positions(word, values + s * h * rates[..., k], cycle) for s in (1, -1)]
                assert found[:, k] == pytest.approx((ends[0] - ends[1]) / (2 * h), rel=1e-5, abs=1e-7), word
    known = {"least": -4.0, "greatest": 2.0, "range": 6.0, "final": 1.0, "peak": 4.0}
    assert {w: float(reduce_cycle(w, VALUES[:, 0])) for w in known} == known
    assert float(reduce_cycle("range", np.array(3.0))) == 0.0
    for sign, word in ((1.0, "least"), (-1.0, "greatest")):
        all_above = sign * np.array([[3.0], [1.0], [2.0]])
        assert cycle_slope(word, all_above, np.arange(3.0)[:, None, None]).tolist() == [[1.0]]
    two = [np.zeros((2, 3)), np.ones((2, 3))]
    assert finish_reduction("envelope", two, 5).shape == (2, 3, 2)
    still = slope("rms", np.zeros((4, 1)), np.zeros((4, 1, 2)))
    assert still.tolist() == [[0.0, 0.0]]
