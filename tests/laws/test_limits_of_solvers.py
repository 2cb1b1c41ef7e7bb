"""Limits of the solvers of linear systems: a part at the limit of rounding, just below it and just above; all against
values by hand."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.core.branchless import above, tanh, top, unit
from dalembert.core.factor import row_scale
from dalembert.core.linear import (
    RANK,
    SINGULAR,
    compliant,
    generalized_inverse,
    inverse,
    inverses,
    least_squares,
    pseudo_inverse,
    solve_square,
)
from dalembert.core.rank import singular_below

NAN = math.nan


@pytest.mark.parametrize(
    ("part", "rank", "rcond"),
    [(0.99 * RANK, 1, 0.0), (RANK, 1, 0.0), (1.01 * RANK, 2, 1.01 * RANK), (0.25, 2, 0.25)],
)
def test_a_singular_value_counts_above_its_part_of_the_largest(part: float, rank: int, rcond: float) -> None:
    """Of diag(8, 8 part), whose singular values are its entries; at the limit itself it does not count."""
    one = np.ones(2)
    p = pseudo_inverse(np.array([[[8.0, 0.0], [0.0, 8.0 * part]]]), one, one)
    assert p.rank.tolist() == [rank]
    assert p.rcond == pytest.approx([rcond], rel=1e-12)
    assert p.null[0] == pytest.approx(np.diag([0.0, 2.0 - rank]))
    assert p.motion(np.array([[4.0, 0.0]])) == pytest.approx(np.array([[0.5, 0.0]]))


def test_a_system_without_size_or_with_what_is_no_number_has_rank_zero() -> None:
    one = np.ones(2)
    p = pseudo_inverse(np.array([np.zeros((2, 2)), [[1.0, NAN], [0.0, 1.0]], np.eye(2)]), one, one)
    assert p.rank.tolist() == [0, 0, 2]
    assert p.rcond.tolist() == [0.0, 0.0, 1.0]
    assert np.array_equal(p.null, [np.eye(2), np.eye(2), np.zeros((2, 2))])
    assert p.forces(np.array([[1.0, 2.0]] * 3)).tolist() == [[0, 0], [0, 0], [1, 2]]


def test_bars_side_by_side_share_a_load_by_their_stiffness() -> None:
    """Three bars in parallel carry 12 N: the least sum of c x^2 has c x equal, whatever the scales of the rows."""
    j = np.ones((1, 3, 1))
    for row in (np.ones(3), np.array([2.0, 0.5, 4.0])):
        p = compliant(pseudo_inverse(j, row, np.ones(1)), np.array([1.0, 2.0, 4.0]))
        assert p.forces(np.array([[7.0]])) == pytest.approx(np.array([[4.0, 2.0, 1.0]]))
    for size in (1e-12, 1.0):  # relative: compliances of any size
        p = compliant(pseudo_inverse(j, np.ones(3), np.ones(1)), size * np.array([1.0, 1.0, 0.0]))
        assert p.forces(np.array([[7.0]])) == pytest.approx(np.array([[0.0, 0.0, 7.0]]), abs=1e-12)
    rigid = compliant(pseudo_inverse(j, np.ones(3), np.ones(1)), np.zeros(3))
    assert rigid.forces(np.array([[6.0]])) == pytest.approx(np.array([[2.0, 2.0, 2.0]]))
    assert rigid.null[0] == pytest.approx(np.eye(3) - 1 / 3)


def test_the_condition_is_that_of_the_largest_columns() -> None:
    """1-norms by hand: of [[1, -2], [3, 4]] 6, of its inverse [[4, 2], [-3, 1]]/10 0.7."""
    j = np.array([[[1.0, -2.0], [3.0, 4.0]], np.zeros((2, 2)), [[1.0, 0.0], [0.0, -1e-3]]])
    i = inverse(j, np.ones(2), np.ones(2))
    assert i.rcond == pytest.approx([1 / 4.2, 0.0, 1e-3])
    assert i.motion(np.array([[1.0, 7.0]] * 3))[0] == pytest.approx([1.8, 0.4])
    assert i.forces(np.array([[1.0, 7.0]] * 3))[0] == pytest.approx([-1.7, 0.9])


@pytest.mark.parametrize("bad", range(5))
def test_one_singular_system_of_a_batch_is_the_only_one_without_an_answer(bad: int) -> None:
    matrix = np.array([np.diag([k + 1.0, 2.0]) for k in range(5)])
    matrix[bad] = [[1.0, 2.0], [2.0, 4.0]]
    found, x = inverses(matrix), solve_square(matrix, np.array([[6.0, 4.0]] * 5))
    for k in range(5):
        if k == bad:
            assert np.isnan(found[k]).all()
            assert np.isnan(x[k]).all()
        else:
            assert found[k] == pytest.approx(np.diag([1 / (k + 1), 0.5]))
            assert x[k] == pytest.approx([6 / (k + 1), 2.0])


def test_least_squares_are_of_least_norm_and_nothing_where_a_number_is_missing() -> None:
    """x + y = 2 has (1, 1); x = 1 and x = 3 have 2; a row below the limit of rank is none."""
    matrix = np.array(
        [[[1.0, 1.0], [0, 0]], [[1.0, 0], [1.0, 0]], [[1.0, NAN], [0, 1]], [[2.0, 0], [0, RANK]]]
    )
    right = np.array([[2.0, 0.0], [1.0, 3.0], [1.0, 1.0], [2.0, 1.0]])
    assert least_squares(matrix, right) == pytest.approx(np.array([[1.0, 1], [2, 0], [0, 0], [1, 0]]))
    assert least_squares(matrix[:1], np.array([[NAN, 0.0]])).tolist() == [[0.0, 0.0]]
    assert least_squares(np.diag([2.0, 4 * RANK])[None], right[:1]) == pytest.approx(np.array([[1.0, 0.0]]))
    found = generalized_inverse(np.array([[[2.0, 0.0, 0.0], [0, 0, 0]], [[1.0, 0, NAN], [0, 1, 0]]]))
    assert found.tolist() == [[[0.5, 0], [0, 0], [0, 0]], np.zeros((3, 2)).tolist()]
    small = np.diag([1.0, 1e-14])
    assert generalized_inverse(small)[1, 1] == pytest.approx(1e14)
    assert generalized_inverse(small, RANK)[1, 1] == 0.0


@pytest.mark.parametrize(("links", "part"), [(1, 1.0), (10, 1.0), (11, 1.1**-3), (20, 1 / 8), (100, 1e-3)])
def test_a_chain_is_singular_below_a_condition_that_falls_with_the_cube_of_its_length(
    links: int, part: float
) -> None:
    layout: Any = SimpleNamespace(links=links)
    assert singular_below(layout) == pytest.approx(part * 1e-6, rel=1e-12)
    assert SINGULAR == 1e-6


def test_angles_are_scaled_by_the_length_of_the_machine() -> None:
    layout: Any = SimpleNamespace(length=0.25)
    assert row_scale(layout, np.array([True, False, True])).tolist() == [0.25, 1.0, 0.25]


def test_choices_of_mixed_values_are_those_of_numbers() -> None:
    """Arrays of objects hold traced values and plain numbers: of the plain ones the answers are those of numpy."""
    x = np.array([-7.0, -0.9, 0.0, 1e-9, 0.3, 2.0, 7.0])
    assert np.array(tanh(x.astype(object)), float) == pytest.approx(np.tanh(x), rel=3e-15, abs=1e-300)
    assert above(x.astype(object), 0.0).tolist() == [0, 0, 0, 1, 1, 1, 1]
    grid = np.array([[[3.0, -1.0], [2.0, 5.0]], [[-3.0, -1.0], [-2.0, -5.0]]])
    for kind in (float, object):
        given = grid.astype(kind)
        assert np.array(top(given, 2), float).tolist() == [5.0, 0.0]
        assert np.array(top(given, 1), float).tolist() == [[3.0, 5.0], [0.0, 0.0]]
        assert np.array(top(given, 3), float).tolist() == 5.0
    along, across, length = unit(np.array([3.0, 3.0]), np.array([4.0, 4.0]), np.array([5.0, 10.0]))
    assert np.array([along, across, length]) == pytest.approx(np.array([[0.6, 0.3], [0.8, 0.4], [5.0, 5.0]]))


def test_a_long_arm_is_not_singular_and_a_small_pivot_is() -> None:
    """A row that is a million times as long has the condition of the others; a pivot that is one does not."""
    one, part = np.ones(2), 0.5 * SINGULAR
    long_arm = np.array([[1.0, 1.0 / part], [0.0, 1.0]])
    pivot = np.array([[1.0, 1.0], [1.0, 1.0 + part]])
    rcond = inverse(np.array([long_arm, pivot, np.ones((2, 2))]), one, one).rcond
    assert rcond[0] > 0.1
    assert (rcond[1:] < SINGULAR).all()


def test_a_slider_far_from_where_it_began_is_at_no_dead_centre() -> None:
    """At 1.1 thousand times the length of its links, by the forces of a wedge as wide as it is in the books."""
    far = {"sweep": ("0 mm", "110 mm"), "positions": 2}
    r, wide = da.dynamics(da.wedge(width="0.1 mm", **far), method="careful"), da.dynamics(da.wedge(**far))
    assert r.status == ("ok", "ok")
    assert r.force_array == pytest.approx(wide.force_array, rel=1e-9)
