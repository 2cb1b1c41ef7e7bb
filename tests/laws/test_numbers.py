"""Linear algebra, ranks and stations of a march against their definitions, on batches with a bad system among good."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import null_space

from dalembert.core import linear
from dalembert.core.position.continuation import _around
from dalembert.core.position.whole_turns import EDGE, whole_turns

RNG = np.random.default_rng(3)


def systems(k: int, m: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Matrices (5, k, m) with rows and columns of very different sizes, and the scales that even them out."""
    row, column = RNG.uniform(0.1, 10, k), RNG.uniform(0.1, 10, m)
    return RNG.normal(size=(5, k, m)) / row[:, None] / column, row, column


def test_an_inverse_solves_both_ways_and_knows_its_condition() -> None:
    j, row, column = systems(4, 4)
    j[3, 1] = 2 * j[3, 0] * row[0] / row[1]  # singular alone
    found = linear.inverse(j, row, column)
    good = [0, 1, 2, 4]
    scaled = row[:, None] * j * column
    own = [1 / np.linalg.cond(scaled[k], 1) for k in good]
    np.testing.assert_allclose(found.rcond[good], own, rtol=1e-9)
    assert found.rcond[3] < 1e-15
    rates, wrench = RNG.normal(size=(2, 5, 4))
    motion, forces = found.motion(rates), found.forces(wrench)
    for k in good:
        np.testing.assert_allclose(j[k] @ motion[k], rates[k], rtol=1e-9, atol=1e-10)
        np.testing.assert_allclose(j[k].T @ forces[k], wrench[k], rtol=1e-9, atol=1e-10)


def test_exactly_singular_systems_are_alone_among_others() -> None:
    j = RNG.normal(size=(5, 3, 3))
    j[[1, 4]] = 0.0
    right = RNG.normal(size=(5, 3))
    inverses, solved = linear.inverses(j), linear.solve_square(j, right)
    for k in range(5):
        if k in (1, 4):
            assert np.isnan(inverses[k]).all()
            assert np.isnan(solved[k]).all()
        else:
            np.testing.assert_allclose(inverses[k], np.linalg.inv(j[k]), rtol=1e-9)
            np.testing.assert_allclose(solved[k], np.linalg.solve(j[k], right[k]), rtol=1e-9)
    assert np.isnan(linear.inverses(np.zeros((2, 2)))).all()
    assert linear.inverse(np.zeros((1, 2, 2)), np.ones(2), np.ones(2)).rcond == 0


@pytest.mark.parametrize(("k", "m", "rank"), [(3, 5, 3), (5, 3, 3), (5, 5, 3), (4, 6, 2), (3, 3, 3)])
def test_a_pseudo_inverse_has_least_norms_and_names_what_is_free(k: int, m: int, rank: int) -> None:
    """Of any rank; the condition number is that of full column rank only."""
    row, column = RNG.uniform(0.1, 10, k), RNG.uniform(0.1, 10, m)
    scaled = RNG.normal(size=(2, k, rank)) @ RNG.normal(size=(2, rank, m))
    found = linear.pseudo_inverse(scaled / row[:, None] / column, row, column)
    assert found.rank.tolist() == [rank] * 2
    for n in range(2):
        s = np.linalg.svd(scaled[n], compute_uv=False)
        np.testing.assert_allclose(found.pinv[n], np.linalg.pinv(scaled[n], rcond=1e-9), atol=1e-9)
        assert found.rcond[n] == pytest.approx(s[rank - 1] / s[0] if rank == m else 0.0, rel=1e-9)
        free = null_space(scaled[n].T, rcond=1e-9)
        np.testing.assert_allclose(found.null[n], free @ free.T, atol=1e-9)
    np.testing.assert_allclose(linear.generalized_inverse(scaled, 1e-9), found.pinv, atol=1e-9)


@pytest.mark.parametrize(("part", "rank"), [(1.1, 3), (0.9, 2)])
def test_a_rank_is_decided_at_a_part_of_the_largest(part: float, rank: int) -> None:
    values = np.diag([7.0, 2.0, 7.0 * part * linear.RANK])
    assert linear.pseudo_inverse(values[None], np.ones(3), np.ones(3)).rank.tolist() == [rank]


def test_what_is_no_number_has_no_rank() -> None:
    j = np.stack([np.eye(3), np.eye(3)])
    j[1, 0, 0] = np.nan
    found = linear.pseudo_inverse(j, np.ones(3), np.ones(3))
    assert found.rcond.tolist() == [1.0, 0.0]
    assert found.rank.tolist() == [3, 0]
    assert not linear.generalized_inverse(j)[1].any()


def test_elastic_multipliers_have_the_least_energy() -> None:
    """Of more rows than unknowns: among all multipliers of the same wrench those of least sum c x^2."""
    j = RNG.normal(size=(1, 6, 3))
    row, column = RNG.uniform(0.5, 2, 6), RNG.uniform(0.5, 2, 3)
    compliance, wrench = RNG.uniform(0.5, 3, 6), RNG.normal(size=(1, 3))
    least = linear.pseudo_inverse(j, row, column)
    found = linear.compliant(least, compliance)
    x = found.forces(wrench)[0]
    np.testing.assert_allclose(j[0].T @ x, wrench[0], rtol=1e-9)
    free = null_space(j[0].T)
    np.testing.assert_allclose(free.T @ (compliance * x), 0, atol=1e-9 * np.abs(x).max())
    assert np.abs(found.null).max() < 1e-9  # all are settled
    some = linear.compliant(least, np.array([1.0, 0, 0, 0, 0, 0]))
    assert np.linalg.matrix_rank(some.null[0], 1e-6) == 2
    rest = some.forces(wrench)[0]
    np.testing.assert_allclose(j[0].T @ rest, wrench[0], rtol=1e-9)
    assert abs(rest[0]) < 1e-9
    rigid = linear.compliant(least, np.zeros(6))  # nothing elastic: least-norm, as before
    np.testing.assert_allclose(rigid.forces(wrench), least.forces(wrench), rtol=1e-12)
    np.testing.assert_allclose(rigid.null, least.null, atol=1e-12)
    alike = linear.compliant(least, 1e9 * compliance)  # only their ratios count
    np.testing.assert_allclose(alike.forces(wrench)[0], x, rtol=1e-9)


@pytest.mark.parametrize(
    ("s", "k", "stations"),
    [
        (range(9), 4, [3, 4, 5, 6, 2]),
        (range(9), 0, [0, 1, 2, 3, 4]),
        (range(9), 7, [4, 5, 6, 7, 8]),
        (range(3), 1, [0, 1, 2]),
        ([0.0], 0, [0]),
        ([0, 1, 2, 2.2, 2.4, 3], 1, [0, 1, 2]),  # they crowd beyond: not closer than three tenths
        ([0, 1, 2, 2.31, 2.62, 3], 1, [0, 1, 2, 3, 4]),
        ([0, 0.2, 1, 2, 3, 4, 5], 2, [1, 2, 3, 4, 5]),
        ([0, 5, 6, 7, 8, 9], 1, [1, 2, 3, 4, 5]),  # the nearer ones
    ],
)
def test_a_polynomial_goes_through_the_nearest_stations_to_where_they_crowd(
    s: list[float], k: int, stations: list[int]
) -> None:
    assert sorted(_around(np.array(s, float), k)) == sorted(stations)


@pytest.mark.parametrize(
    ("phi", "turns"),
    [(0.0, 0), (3.14, 0), (np.pi, 0), (np.pi + EDGE / 2, 0), (np.pi + 2 * EDGE, 1), (-np.pi, -1)],
)
def test_half_a_turn_ahead_is_within(phi: float, turns: int) -> None:
    """Of what an angle is counted by; behind it the turn before begins there."""
    for near in (0.0, 1.3, -20.0):
        for more in (0, 3, -2):
            assert whole_turns(np.array(phi + near + 2 * np.pi * more), np.array(near)) == turns + more
