"""Linear systems factored by their structure, for traced values: their solutions beside those of numpy."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from dalembert.arrays import Array
from dalembert.kernel.elimination import structural
from dalembert.kernel.graph import Graph
from dalembert.kernel.position.placing_order import UNDETERMINED, blocks
from tests.tiers import over


def block_triangular(seed: int) -> Array:
    """A random matrix of small blocks on the diagonal, coupled here and there above it, in a random order.

    Some of its entries are 1 or -1, most are not, and negative ones are as many as positive.
    """
    draw = np.random.default_rng(seed)
    sizes = draw.permutation([1, 1, 2, 2, 3, int(draw.integers(3, 6))])
    ends = np.cumsum([0, *sizes])
    matrix = np.zeros((ends[-1],) * 2)
    for a, b in pairwise(ends):
        matrix[a:b, a:b] = draw.uniform(0.3, 3, (b - a, b - a)) * draw.choice([-1, 1], (b - a, b - a))
        some = draw.random((b - a, ends[-1] - b)) < 0.15
        matrix[a:b, b:] = np.where(some, draw.normal(size=some.shape), 0.0)
    unit = draw.random(matrix.shape) < 0.1
    matrix = np.where(unit, np.sign(matrix), matrix)
    return np.asarray(matrix[np.ix_(draw.permutation(ends[-1]), draw.permutation(ends[-1]))])


def traced(graph: Graph, matrix: Array) -> list[dict[int, Any]]:
    """Its rows by column: inputs, of which the program knows these numbers, and constants where they are 1 or -1."""
    return [
        {
            c: graph.constant(x) if abs(x) == 1 else graph.input("number", f"x {r} {c}", float(x))
            for c, x in enumerate(row)
            if x
        }
        for r, row in enumerate(matrix)
    ]


def numbers(graph: Graph, values: Any) -> Array:
    nodes = [graph.constant(v) if isinstance(v, (int, float)) else v for v in values]
    return np.array([float(v) for v in np.broadcast_arrays(*graph.evaluate(nodes, {}))])


@over(12, 300)
def test_a_system_is_solved_by_its_structure(seed: int) -> None:
    matrix = block_triangular(seed)
    size, graph, draw = len(matrix), Graph(), np.random.default_rng(seed)
    factors = structural(graph, traced(graph, matrix), size)
    right = draw.normal(size=size)
    condition = np.linalg.cond(matrix)
    for found, system in ((factors.motion(right), matrix), (factors.forces(right), matrix.T)):
        wanted = np.linalg.solve(system, right)
        assert numbers(graph, found) == pytest.approx(wanted, abs=1e-14 * condition * np.abs(wanted).max())


@pytest.mark.parametrize("sign", [1, -1])
def test_no_small_number_is_divided_by_where_a_row_has_a_large_one(sign: int) -> None:
    """Of either sign: the solution keeps its figures."""
    matrix = np.array([[1e-13, -2.0 * sign, -3.0 * sign], [2.5, 0.7, 1.3], [0, 3.1, 0.9]])
    for order in ([0, 1, 2], [2, 0, 1], [1, 2, 0]):
        graph = Graph()
        factors = structural(graph, traced(graph, matrix[order]), 3)
        right = np.array([0.3, -1.7, 2.2])
        wanted = np.linalg.solve(matrix[order], right)
        assert numbers(graph, factors.motion(right)) == pytest.approx(wanted, rel=1e-13)


@over(6, 100)
def test_rows_that_repeat_others_agree_with_them(seed: int) -> None:
    """Motions agree with all rows, and forces, with the weights of the rows, are those of least norm."""
    draw = np.random.default_rng(seed)
    part = draw.normal(size=(3, 3))
    doubled = np.concatenate([part, draw.normal(size=(2, 3)) @ part])
    matrix = np.zeros((8, 6))
    matrix[:5, :3], matrix[5:, 3:] = doubled, draw.normal(size=(3, 3))
    matrix[5:, :3] = np.where(draw.random((3, 3)) < 0.5, draw.normal(size=(3, 3)), 0.0)
    order = draw.permutation(8)
    matrix, scale, graph = matrix[order], draw.uniform(0.5, 2, 8), Graph()
    factors = structural(graph, traced(graph, matrix), 6, scale)
    v = draw.normal(size=6)
    assert numbers(graph, factors.motion(matrix @ v)) == pytest.approx(v, rel=1e-8, abs=1e-8)
    wrench = draw.normal(size=6)
    x = numbers(graph, factors.forces(wrench))
    assert matrix.T @ x == pytest.approx(wrench, rel=1e-8, abs=1e-8)
    least = np.linalg.lstsq(matrix.T * scale, wrench, rcond=None)[0] * scale
    assert x == pytest.approx(least, rel=1e-7, abs=1e-7)


@pytest.mark.parametrize(("rows", "size", "says"), [
    ([[2, 3], [0, 0]], 2, "structurally singular"),
    ([[2, 0, 3], [3, 0, 2], [4, 0, 7]], 3, "structurally singular"),
    ([[2, 3]], 2, "1 equations for 2 unknowns"),
    ([[2, 3], [3, 4], [4, 7]], 2, "3 equations for 2 unknowns"),
])  # fmt: skip
def test_what_no_numbers_could_solve_is_refused(rows: list[list[float]], size: int, says: str) -> None:
    graph = Graph()
    with pytest.raises(ValueError, match=f"^{says}$"):
        structural(graph, traced(graph, np.array(rows, float)), size)


GROUND = -1
ONE_BY_ONE = {0: {GROUND, 0}, 1: {GROUND, 0}, 2: {GROUND, 1}, 3: {0, 1}, 4: {0, 2}, 5: {1, 2}}
"""Rows between parts of two coordinates each: 0 on the ground, 1 between it and the ground, 2 between both."""


@pytest.mark.parametrize(
    ("ends", "more", "placed"),
    [
        (ONE_BY_ONE, {}, [[0], [1], [2]]),
        (
            ONE_BY_ONE,
            {6: {GROUND, 2}},
            [[0], [1, 2]],
        ),  # it could hold 2 instead of a row to 1, whose row could hold 0
        (ONE_BY_ONE, {6: {GROUND, 1}}, [[0], [1], [2]]),  # of 1 alone
        (ONE_BY_ONE, {6: {GROUND, 0}}, [[0], [1], [2]]),  # held by one joint, which never fails
        (ONE_BY_ONE, {6: {1, 2}}, [[0], [1, 2]]),
        ({0: {0, 1}, 1: {0, 1}, 2: {GROUND, 0}, 3: {GROUND, 1}}, {}, [[0, 1]]),
        ({0: {1, 0}, 1: {0, 1}, 2: {GROUND, 1}, 3: {GROUND, 1}}, {}, [[1], [0]]),
    ],
)
def test_parts_are_placed_behind_those_that_hold_them(
    ends: dict[int, set[int]], more: dict[int, set[int]], placed: list[list[int]]
) -> None:
    """Those that a redundant row could hold instead of others at once; rows of other parts do not matter."""
    assert blocks(ends | more, 2, frozenset(more)) == placed
    assert blocks(ends | more, 2, frozenset(more) | {77}) == placed


def test_parts_that_too_few_rows_hold_have_no_order() -> None:
    with pytest.raises(ValueError, match=UNDETERMINED):
        blocks({0: {GROUND, 0}, 1: {0, 1}, 2: {0, 1}}, 2, frozenset())
    with pytest.raises(ValueError, match=UNDETERMINED):
        blocks(ONE_BY_ONE, 2, frozenset({5}))
