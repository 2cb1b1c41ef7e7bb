"""Matchings and strongly connected components against those of scipy; solutions of long chains against dense ones."""

from __future__ import annotations

import numpy as np
import pytest
from benchmarks.linkages import chain
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components, maximum_bipartite_matching

import dalembert as da
from dalembert.analysis.compile.compiled_mechanism import compile_mechanism
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.core import bands
from dalembert.core.constraints import dense, stack_rows
from dalembert.core.factor import damped_step, displacement, displacements, factor, row_scale, sparse
from dalembert.core.position.assur_groups import match_columns, strong_components
from dalembert.kernel.elimination import components, maximum_matching

DENSITIES = [0.1, 0.2, 0.4]


def drawn(seed: int, density: float, count: int = 8) -> np.ndarray:
    return np.random.default_rng(seed).random((count, count)) < density


@pytest.mark.parametrize("density", DENSITIES)
def test_components_stand_behind_those_that_they_need(density: float) -> None:
    for seed in range(20):
        needs = drawn(seed, density)
        rows = [np.flatnonzero(row).tolist() for row in needs]
        _, label = connected_components(csr_array(needs), connection="strong")
        expected = {frozenset(np.flatnonzero(label == k).tolist()) for k in label}
        for found in (strong_components(rows), components({k: set(row) for k, row in enumerate(rows)})):
            assert sorted(k for part in found for k in part) == list(range(8))
            assert set(map(frozenset, found)) == expected
            placed: set[int] = set()
            for part in found:
                placed |= set(part)
                assert {other for k in part for other in rows[k]} <= placed


@pytest.mark.parametrize("density", DENSITIES)
def test_every_row_that_can_have_a_column_of_its_own_has_one(density: float) -> None:
    outcomes = set()
    for seed in range(20):
        wants = drawn(seed, density)
        rows = [np.flatnonzero(row).tolist() for row in wants]
        size = int((maximum_bipartite_matching(csr_array(wants), perm_type="column") >= 0).sum())
        own = match_columns(rows)
        found = maximum_matching({k: set(row) for k, row in enumerate(rows)})
        assert len(found) == len(set(found.values())) == size
        assert all(column in rows[row] for row, column in found.items())
        assert found == {row: column for row, column in enumerate(own) if column >= 0}
        outcomes.add(size < 8)
    assert density < 0.4 or outcomes == {True, False}


@pytest.mark.parametrize("widest", [bands.WIDEST, 0])
def test_long_chains_are_solved_in_bands_and_in_sparse_columns_as_dense_matrices_are(
    widest: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(bands, "WIDEST", widest)
    bands._bands.cache_clear()
    m = chain(24, positions=3)
    c = compile_mechanism(m, m.schedule())
    layout, first = c.layout, c.first_modes
    assert first is not None
    pose = first.pose.at(np.array([0, 0]))
    pose.point[1, 3] += 0.05  # two poses, one of them open
    rows = stack_rows(layout, pose)
    assert (bands.bands_of(rows, layout.links, 3) is None) == (widest == 0)
    j = dense(layout, rows)
    rng = np.random.default_rng(4)
    rates, wrench = rng.normal(size=(2, 2, layout.unknowns))
    found = factor(layout, rows)
    np.testing.assert_allclose((j @ found.motion(rates)[..., None])[..., 0], rates, atol=1e-11)
    np.testing.assert_allclose((j.mT @ found.forces(wrench)[..., None])[..., 0], wrench, atol=1e-11)
    one, weight = rows.at(slice(0, 1)), rng.uniform(1, 2, layout.unknowns)
    scaled = j[0] * (layout.row_scale * weight)[:, None] * layout.column_scale
    right = rates[0] * weight
    expected = np.linalg.solve(scaled.T @ scaled + 0.1 * np.eye(len(scaled)), scaled.T @ right)
    step = damped_step(layout, one, weight, rates[0], 0.1)
    np.testing.assert_allclose(step, expected * layout.column_scale, atol=1e-11)
    one.on_i[:, 5] = one.on_j[:, 5] = 0.0
    singular = factor(layout, one)
    assert singular.rcond[0] == 0
    assert np.isnan(singular.motion(rates[:1])).all()
    bands._bands.cache_clear()


@pytest.mark.parametrize("widest", [bands.WIDEST, 0])
def test_an_entry_that_is_zero_at_one_position_counts_at_the_others(
    widest: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of two positions of a chain of 48 links, each in its own pattern; Newton's steps too, at both and at one."""
    monkeypatch.setattr(bands, "WIDEST", widest)
    bands._bands.cache_clear()
    c = compile_mechanism(m := chain(24, positions=3), m.schedule())
    layout, first = c.layout, c.first_modes
    assert first is not None
    rows = stack_rows(layout, first.pose.at(np.array([0, 0])))
    for row in (4, 9, 20):
        rows.on_j[0, row, 2] = 0.0
    j, scale = dense(layout, rows), layout.row_scale
    assert ((j[0] == 0) & (j[1] != 0)).any()
    rates = np.random.default_rng(4).normal(size=(2, layout.unknowns))
    expected = np.stack([np.linalg.solve(a, b) for a, b in zip(j, rates, strict=True)])
    size = np.abs(expected).max()
    for found in (factor(layout, rows).motion(rates), displacement(layout, rows, rates * scale)):
        np.testing.assert_allclose(found, expected, atol=1e-9 * size)
    several, matrix = displacements(layout, rows.at(slice(0, 1)), rates * scale)
    np.testing.assert_allclose(several, np.linalg.solve(j[0], rates.T).T, atol=1e-9 * size)
    assert matrix is None
    bands._bands.cache_clear()


def test_steps_of_more_constraints_than_unknowns_are_the_shortest_of_least_squares() -> None:
    """A lifted four-bar has 21 rows for 18 unknowns; rows and unknowns are measured by their scales. Of a plane one,
    which is square, J is solved, and told with its rows scaled; where it is singular a step is 0."""
    for m in (da.lifted(da.four_bar(positions=1)), da.four_bar(positions=1)):
        r = da.kinematics(m)
        layout, pose = r.compiled.layout, full_pose(r, slice(0, 1))
        rows = stack_rows(layout, pose)
        j, scale, column = dense(layout, rows)[0], layout.row_scale, layout.column_scale
        gaps = np.random.default_rng(4).normal(size=(2, len(scale)))
        scaled = j * scale[:, None] * column
        expected = (np.linalg.pinv(scaled, rcond=1e-9) @ gaps.T).T * column
        np.testing.assert_allclose(displacement(layout, rows, gaps[:1])[0], expected[0], atol=1e-11)
        several, matrix = displacements(layout, rows, gaps)
        np.testing.assert_allclose(several, expected, atol=1e-11)
        assert matrix is not None
        np.testing.assert_allclose(matrix, j * scale[:, None], atol=1e-15)
        rows.on_i[:], rows.on_j[:] = 0.0, 0.0
        assert not displacement(layout, rows, gaps[:1]).any()
        assert not displacements(layout, rows, gaps)[0].any()


@pytest.mark.parametrize("links", [40, 60])
def test_condition_numbers_of_long_chains_are_estimated_unless_they_are_not_wanted(links: int) -> None:
    r = da.solve(chain(links), positions=1)
    layout, pose = r.compiled.layout, full_pose(r)
    rows, scale = stack_rows(layout, pose), row_scale(layout, layout.stack.angular)
    found = sparse(layout, rows, scale, layout.column_scale)
    matrix = dense(layout, rows)[0] * scale[:, None] * layout.column_scale
    exact = 1 / np.linalg.cond(matrix, 1)
    assert exact <= found.rcond[0] * (1 + 1e-9)
    assert found.rcond[0] < 10 * exact
    assert sparse(layout, rows, scale, layout.column_scale, condition=False).rcond.tolist() == [1.0]
