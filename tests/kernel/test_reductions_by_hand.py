"""Reductions over the positions and their derivatives, of short columns of numbers, by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from dalembert.analysis.batch import over_positions as over
from dalembert.errors import ModelError

COLUMN = np.array([3.0, -7.0, 5.0, 2.0])
TABLE = np.stack([COLUMN, [-1.0, 4.0, 9.0, -2.0]], axis=1)
RATES = np.arange(1.0, 17.0).reshape(4, 2, 2)
"""Derivatives (position, component, number)."""


@pytest.mark.parametrize(
    ("reduce", "first", "second"),
    [
        ("peak", 7.0, 9.0),
        ("mean", 0.75, 2.5),
        ("rms", np.sqrt(87 / 4), np.sqrt(102 / 4)),
        ("envelope", (-7.0, 5.0), (-2.0, 9.0)),
        ("argpeak", 1.0, 2.0),
        (
            "norm8",
            ((3.0**8 + 7.0**8 + 5.0**8 + 2.0**8) / 4) ** 0.125,
            ((1 + 4.0**8 + 9.0**8 + 2.0**8) / 4) ** 0.125,
        ),
        ("squares", 87.0, 102.0),
    ],
)
def test_a_column_is_reduced_as_its_name_says(reduce: str, first: Any, second: Any) -> None:
    assert np.allclose(over.reduce_positions(reduce, COLUMN), first, rtol=1e-14)
    both = over.reduce_positions(reduce, TABLE)
    assert np.allclose(both, [first, second], rtol=1e-14)


@pytest.mark.parametrize(
    ("reduce", "parts", "result"),
    [
        ("envelope", [[2.0, 3.0], [5.0, 7.0]], [[2.0, 5.0], [3.0, 7.0]]),
        ("mean", [[2.0, 3.0]], [0.5, 0.75]),
        ("rms", [[36.0, 100.0]], [3.0, 5.0]),
        ("norm8", [[4.0 * 3.0**8, 4.0]], [3.0, 1.0]),
        ("squares", [[36.0, 9.0]], [36.0, 9.0]),
        ("peak", [[36.0, 9.0]], [36.0, 9.0]),
        ("argpeak", [[2.0, 3.0]], [2.0, 3.0]),
    ],
)
def test_a_reduction_is_finished_from_its_parts(
    reduce: str, parts: list[list[float]], result: list[Any]
) -> None:
    finished = over.finish_reduction(reduce, [np.array(p) for p in parts], 4)
    assert np.allclose(finished, result, rtol=1e-14)


def test_parts_are_those_of_the_kernel_and_places_are_added_for_gradients() -> None:
    assert over.with_places("peak") == ("argpeak",)
    assert over.with_places("envelope") == ("argmin", "argmax")
    assert over.with_places("rms") == ("square",)
    assert over.PARTS["norm8"] == ("power8",)
    for reduce in (None, *over.PARTS):
        over.check(reduce)
    with pytest.raises(ModelError) as raised:
        over.check("most")
    assert str(raised.value) == (
        "unknown reduction 'most'; use one of peak, mean, rms, envelope, argpeak, norm8, refined_peak, "
        "refined_place, squares"
    )


def test_a_parabola_through_three_values_has_its_vertex_between_them() -> None:
    vertex, height, bend = 0.3, 11.0, -2.0
    values = np.array([height + bend * (x - vertex) ** 2 for x in (-1.0, 0.0, 1.0)])
    peak = over.parabola(values, np.array(True))
    assert peak.place == pytest.approx(vertex, abs=1e-15)
    assert (peak.weights * values).sum() == pytest.approx(height, abs=1e-14)
    assert peak.weights == pytest.approx([0.3 * -0.7 / 2, 1 - 0.09, 0.3 * 1.3 / 2], abs=1e-15)
    for k in range(3):
        step = np.eye(3)[k] * 1e-6
        there, here = (over.parabola(values + sign * step, np.array(True)).place for sign in (1, -1))
        assert peak.place_slope[k] == pytest.approx((there - here) / 2e-6, abs=1e-8)


def test_a_parabola_without_bend_or_neighbours_is_its_middle() -> None:
    rows = np.array([[1.0, 2.0, np.inf], [2.0, 4.0, 5.0], [3.0, 4.5, 1.0]])
    peak = over.parabola(rows, np.array([True, False, True]))
    assert peak.place.tolist() == [0.0, 0.0, 0.0]
    assert peak.weights[1].tolist() == [1.0, 1.0, 1.0]
    assert not peak.place_slope.any()


def test_a_vertex_is_at_most_half_a_step_from_the_middle() -> None:
    falling, rising = np.array([10.0, 5.0, 1.0]), np.array([1.0, 5.0, 10.0])
    assert over.parabola(falling, np.array(True)).place == 0.5  # bent upwards: the least is behind
    assert over.parabola(rising, np.array(True)).place == -0.5
    assert over.parabola(-falling, np.array(True)).place == 0.5
    assert over.parabola(np.array([1.0, 5.0, 8.0]), np.array(True)).place == 0.5


def test_neighbours_are_those_of_a_cycle_or_of_a_path_with_ends() -> None:
    places, inner = over.neighbours(np.array([0, 2, 3]), 4, False)
    assert places.tolist() == [[3, 1, 2], [0, 2, 3], [1, 3, 0]]
    assert inner.tolist() == [False, True, False]
    assert over.neighbours(np.array([0, 3]), 4, True)[1].tolist() == [True, True]
    assert over.neighbours(np.array([0, 1]), 2, True)[1].tolist() == [False, False]
    assert over.neighbours(np.array([0, 1]), 3, True)[1].tolist() == [True, True]
    assert over.neighbours(np.array([1]), 3, False)[1].tolist() == [True]


WAVE = np.array([1.0, 6.0, 7.0, 2.0, -3.0])


def test_a_refined_peak_is_that_of_the_parabola_about_the_largest() -> None:
    rise, bend = 2.0 - 6.0, 6.0 - 14.0 + 2.0
    place = -rise / (2 * bend)
    height = 7.0 - rise**2 / (8 * bend)
    assert over.reduce_positions("refined_peak", WAVE) == pytest.approx(height, rel=1e-14)
    assert over.reduce_positions("refined_place", WAVE) == pytest.approx(2 + place, rel=1e-14)
    assert over.reduce_positions("refined_peak", -WAVE) == pytest.approx(height, rel=1e-14)


def test_a_peak_at_the_end_is_refined_in_a_cycle_only() -> None:
    turned = np.roll(WAVE, -2)  # the largest first: 7, 2, -3, 1, 6
    assert over.reduce_positions("refined_peak", turned) == 7.0
    assert over.reduce_positions("refined_place", turned) == 0.0
    place = -(2.0 - 6.0) / (2 * -6.0)
    assert over.reduce_positions("refined_place", turned, True) == pytest.approx(5 + place, rel=1e-14)
    assert over.reduce_positions("refined_peak", turned, True) == pytest.approx(7 + 16 / 48, rel=1e-14)


def test_a_refined_peak_of_what_is_no_number_is_none() -> None:
    table = np.stack([WAVE, np.where(WAVE == -3.0, np.nan, WAVE)], axis=1)
    assert np.isnan(over.reduce_positions("refined_peak", table)).tolist() == [False, True]


def test_of_equal_values_the_first_is_the_place_of_the_peak() -> None:
    assert over.reduce_positions("argpeak", np.array([2.0, -5.0, 5.0])) == 1.0
    assert over.reduce_positions("argpeak", np.array([2.0, 5.0 - 1e-15, 5.0])) == 1.0
    assert over.reduce_positions("argpeak", np.array([2.0, 4.99, 5.0])) == 2.0


def test_both_sides_of_reversals_are_reduced_together() -> None:
    before, after = np.array([[3.0], [-7.0], [5.0]]), np.array([[3.0], [-2.0], [9.0]])
    assert over.reduce_sides("peak", [before, after]).tolist() == [9.0]
    assert over.reduce_sides("argpeak", [before, after]).tolist() == [2.0]
    assert over.reduce_sides("squares", [before, after]).tolist() == [(83 + 94) / 2]
    assert over.reduce_sides("squares", [before]).tolist() == [83.0]
    assert over.reduce_sides("mean", [before, after]) == pytest.approx([11 / 6])
    larger = over.larger_side([before, after], [before, after])
    assert larger.ravel().tolist() == [3.0, -7.0, 9.0]
    assert over.reduce_sides("refined_peak", [before, after]).tolist() == [9.0]


def test_the_larger_side_may_be_chosen_for_arrays_with_more_axes() -> None:
    by = np.array([3.0, -7.0]), np.array([-4.0, 6.0])
    first, second = np.array([[1.0, 2.0], [3.0, 4.0]]), np.array([[5.0, 6.0], [7.0, 8.0]])
    assert over.larger_side(by, [first, second]).tolist() == [[5.0, 6.0], [3.0, 4.0]]
    assert over.larger_side(by, [first]) is first
    same = np.array([2.0]), np.array([-2.0])
    assert over.larger_side(same, same).tolist() == [2.0]  # of equal sizes the side before


@pytest.mark.parametrize(
    ("word", "value"),
    [("least", -7.0), ("greatest", 5.0), ("range", 12.0), ("final", 2.0), ("mean", 0.75), ("peak", 7.0)],
)
def test_a_word_of_expressions_reduces_a_cycle(word: str, value: float) -> None:
    assert over.reduce_cycle(word, COLUMN) == value
    single = {"range": 0.0, "peak": 3.0}.get(word, -3.0)
    assert over.reduce_cycle(word, np.array(-3.0)) == single


@pytest.mark.parametrize(
    "word",
    ["least", "greatest", "range", "final", "mean", "peak", "rms", "norm8", "squares", "refined_peak"],
)
def test_the_slope_of_a_reduction_is_that_of_differences(word: str) -> None:
    step = 1e-6
    slope = (over.slope if word == "refined_peak" else over.cycle_slope)(word, TABLE, RATES)
    reduce = over.reduce_positions if word == "refined_peak" else over.reduce_cycle
    for number in range(2):
        ends = [reduce(word, TABLE + sign * step * RATES[..., number]) for sign in (1, -1)]
        assert slope[:, number] == pytest.approx((ends[0] - ends[1]) / (2 * step), rel=1e-6)


def test_the_slope_of_a_refined_place_and_of_both_ends_is_that_of_differences() -> None:
    step, table = 1e-6, np.stack([WAVE, -np.roll(WAVE, -2)], axis=1)
    rates = np.sin(np.arange(20.0)).reshape(5, 2, 2)
    for reduce in ("refined_place", "refined_peak", "envelope"):
        slope = over.slope(reduce, table, rates, True)
        for number in range(2):
            ends = [
                over.reduce_positions(reduce, table + sign * step * rates[..., number], True)
                for sign in (1, -1)
            ]
            assert slope[..., number] == pytest.approx((ends[0] - ends[1]) / (2 * step), rel=1e-6, abs=1e-8)


def test_an_output_that_is_always_zero_has_no_slope_of_its_mean_powers() -> None:
    values, rates = np.array([[0.0, 3.0], [0.0, 4.0]]), np.zeros((2, 2, 2))
    rates[:, 1] = [[2.0, 5.0], [3.0, 7.0]]
    slope = over.slope("rms", values, rates)
    assert slope[0].tolist() == [0.0, 0.0]
    size = np.sqrt(12.5)
    assert slope[1] == pytest.approx([(6 + 12) / 2 / size, (15 + 28) / 2 / size])


@pytest.mark.parametrize(
    ("position", "turns", "cycle"),
    [
        (np.arange(4)[:, None] * np.pi / 2, [True], True),
        (np.arange(4)[:, None] * np.pi / 2, [False], False),
        (np.arange(4)[:, None] * np.pi / 2 * (1 + 1e-5), [True], False),
        (np.arange(3)[:, None] * np.pi / 2, [True], False),
        (np.arange(4)[:, None] * np.pi, [True], True),  # two turns
        (np.arange(2)[:, None] * np.pi, [True], False),
        (np.arange(4)[:, None] * np.array([np.pi / 2, 0.0]), [True, False], True),
        (np.arange(4)[:, None] * np.array([np.pi / 2, 0.25]), [True, False], False),
        (-np.arange(4)[:, None] * np.pi / 2, [True], True),
    ],
)
def test_positions_are_a_cycle_if_one_more_step_leads_to_the_first(
    position: Any, turns: list[bool], cycle: bool
) -> None:
    assert over.is_cycle(position, turns) is cycle


def test_positions_that_are_not_evenly_spaced_have_no_refined_peak() -> None:
    for last, refused in ((2.0 + 1e-5, True), (2.0 + 1e-7, False)):
        position = np.array([[0.0], [1.0], [last]])
        if not refused:
            assert not over.is_cycle(position, [False])
            continue
        with pytest.raises(ModelError) as raised:
            over.is_cycle(position, [False])
        assert str(raised.value) == (
            'the positions are not evenly spaced, and a peak is refined between even ones; reduce by "peak"'
        )
