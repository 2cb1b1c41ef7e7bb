"""What a program keeps of its marks, and which parts of a mechanism it can place."""

from __future__ import annotations

import math
import re

import pytest

from dalembert.analysis.engine import force_program
from dalembert.kernel.doubts import uncertain
from dalembert.kernel.graph import Graph
from dalembert.kernel.position.placing_order import UNDETERMINED, blocks


def test_a_mark_that_never_speaks_is_left_out_and_one_that_always_does_is_not() -> None:
    graph = Graph()
    never, edge, always, unknown = (graph.constant(x) for x in (1.0, 0.0, -1.0, math.nan))
    varies = graph.input("number", "x", 3.0)
    nodes = [never, edge, always, unknown, varies]
    assert list(uncertain(nodes)) == [always, unknown, varies]
    assert list(force_program._varying(nodes)) == [always, unknown, varies]
    assert list(force_program._varying([varies, always], [never, varies])) == [varies, always]
    assert force_program._varying([never]).shape == (0,)


@pytest.mark.parametrize(
    ("ends", "found"),
    [
        ({k: {-1, 0} for k in range(3)}, [[0]]),
        ({**{k: {-1, 0} for k in range(3)}, **{k: {0, 1} for k in range(3, 6)}}, [[0], [1]]),
        ({**{k: {-1, 1} for k in range(3)}, **{k: {0, 1} for k in range(3, 6)}}, [[1], [0]]),
        (
            {0: {-1, 0}, 1: {-1, 0}, 2: {0, 1}, 3: {0, 1}, 4: {1, -1}, 5: {1, -1}},
            [[0, 1]],
        ),
        ({k: {-1, 0} for k in range(2)}, None),  # one row too few
        ({**{k: {-1, 0} for k in range(4)}, **{k: {0, 1} for k in range(4, 6)}}, None),  # enough, elsewhere
    ],
)
def test_parts_are_placed_when_what_they_need_is(
    ends: dict[int, set[int]], found: list[list[int]] | None
) -> None:
    """Three rows a part; together where neither goes first."""
    if found is None:
        with pytest.raises(ValueError, match=re.escape(UNDETERMINED)):
            blocks(ends, 3, frozenset())
    else:
        assert blocks(ends, 3, frozenset()) == found


def test_a_repeated_row_places_all_that_it_could_hold_at_once() -> None:
    ends = {**{k: {-1, 0} for k in range(3)}, **{k: {-1, 1} for k in range(3, 6)}, 6: {0, 1}}
    assert blocks(ends, 3, frozenset({6})) == [[0], [1]]  # each by one joint, which never fails
    held = {**{k: {-1, 0} for k in range(2)}, 2: {0, 1}, **{k: {-1, 1} for k in range(3, 6)}, 6: {0, 1}}
    assert blocks(held, 3, frozenset({6})) == [[1], [0]]
