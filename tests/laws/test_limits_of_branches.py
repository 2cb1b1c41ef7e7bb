"""Which station of a march is the next one of its branch, and which group of links has a closed form: at the limits."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.algebra import plane
from dalembert.core.layout import Pose, Turn
from dalembert.core.position import continuation
from dalembert.core.position.assur_groups import DEPENDENT, independent_rows
from dalembert.core.position.assur_plan import AssurGroup, PlacementPlan, _turns
from dalembert.core.position.continuation import STEP, Station, _bend, _is_far, _next_station


def pose(points: list[tuple[float, float]], turns: list[float]) -> Pose:
    """Links at points and angles, and the ground."""
    turn = np.array([*turns, 0.0])
    return Pose(np.array([*points, (0.0, 0.0)]), turn, plane.rotation(turn))


HERE = pose([(0.0, 0.0)], [0.0])


def station(s: float, clear: float, side: float) -> Station:
    return Station(s, HERE, np.zeros((2, 3)), clear, None, side)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize(
    ("sides", "step", "bend", "clear"),
    [
        ((1.0, 1.0), 0.4, 0.0, 0.5),
        ((-1.0, -1.0), 0.4, 0.0, 0.5),
        ((1.0, 0.0), 0.4, 0.0, 0.5),  # a side that is not known has not changed
        ((0.0, -1.0), 0.4, 0.0, 0.5),
        ((0.0, 0.0), 0.4, 0.0, 0.5),
        ((1.0, -1.0), 3.9e-5, 0.0, -0.5),  # so near to a singular pose it goes straight through
        ((-1.0, 1.0), 3.9e-5, 0.0, -0.5),
        ((1.0, -1.0), 4.1e-5, 0.0, None),  # from further on another branch may have been met
        ((1.0, 1.0), 0.4, 0.149, 0.5),
        ((1.0, 1.0), 0.4, 0.151, None),  # another direction than that of the branch
    ],
)
def test_the_next_station_is_of_the_same_branch(
    sign: float, sides: tuple[float, float], step: float, bend: float, clear: float | None,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    monkeypatch.setattr(continuation, "_bend", lambda at, a, b: bend)
    at: Any = None
    for was, before in ((0.7, None), (0.7, 0.6), (-0.7, -0.6)):
        last, new = station(1.0, was, sides[0]), station(1.0 + sign * step, 0.5, sides[1])
        recent = [last] if before is None else [station(1.0 - 0.1 * sign, before, sides[0]), last]
        found = _next_station(at, recent, new)
        if clear is None:
            assert found is None
        else:
            assert found is not None
            assert found.clear == pytest.approx(np.copysign(clear, was * clear))
    # 0.2 clearer 0.1 before: the singular pose is 0.35 ahead
    recent = [station(1.0 - 0.1 * sign, 0.9, 1.0), station(1.0, 0.7, 1.0)]
    for length, side in ((0.34, 1.0), (0.36, -1.0)):
        found = _next_station(at, recent, station(1.0 + sign * length, 0.5, 1.0))
        if bend < STEP.max_direction_change:
            assert found is not None
            assert found.clear == pytest.approx(side * 0.5)


LAYOUT: Any = SimpleNamespace(length=2.0, algebra=plane)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_link_travels_too_far_by_its_turn_or_by_its_shift_over_the_reach(sign: float) -> None:
    """1.72 rad; or 1.72 of the reach of the links, 10 m, or of the machine's length, 2 m, where that is more."""
    long, short = [(0.0, 0.0), (10.0, 0.5)], [(0.0, 0.0), (0.3, 0.2)]
    for points, reach in ((long, 10.0), (short, 2.0)):
        for part, far in ((1.71, False), (1.73, True)):
            for moved in (0, 1):
                after = [(x, y + sign * part * reach * (k == moved)) for k, (x, y) in enumerate(points)]
                assert _is_far(LAYOUT, pose(points, [0.0, 0.0]), pose(after, [0.0, 0.0])) is far
                turned = [sign * part * (k == moved) for k in (0, 1)]
                assert _is_far(LAYOUT, pose(points, [0.0, 0.0]), pose(points, turned)) is far
    assert STEP.max_travel == pytest.approx(1.72)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_bend_between_two_stations_is_what_their_mean_rate_misses(sign: float) -> None:
    """Of 0.5 m or 0.5 rad in 0.2 with rates of 2 and 3; with 0.1 more or less the part 0.1 / 0.6 of the larger rate's
    way. What a link does whose turn is not that of its rate does not count."""
    rates = np.zeros((2, 3, 3))
    places = [(0.0, 0.0), (4.0, 0.0)]
    for part in (0, 2):
        rates[:, :2], rates[:, 1, part] = 0.0, [2.0, 3.0]
        for more, bend in ((0.0, 0.0), (0.1, 1 / 6), (-0.1, 1 / 6)):
            way = sign * (0.5 + more)
            moved = [places[0], (4 + way, 0.0)] if part == 0 else places
            there = pose(moved, [0.0, way if part == 2 else 0.0])
            a = Station(1.0, pose(places, [0.0, 0.0]), sign * rates[0], 1.0, None, 1.0)
            b = Station(1.2, there, sign * rates[1], 1.0, None, 1.0)
            for counts in (True, False):
                at: Any = SimpleNamespace(layout=LAYOUT, turned=np.array([True, counts, True]))
                assert _bend(at, a, b) == pytest.approx(bend if counts or part == 0 else 0.0, abs=1e-12)


def group(angles: int, sliding: int, far: list[bool]) -> Any:
    return SimpleNamespace(
        turning=[None] * angles, sliding=sliding, conditions=SimpleNamespace(far=np.array(far))
    )


@pytest.mark.parametrize(
    ("angles", "sliding", "far", "closed"),
    [
        *((0, 0, [False], True), (1, 0, [False], True), (1, 2, [False], True), (2, 0, [False], True)),
        *((2, 1, [False], False), (3, 0, [False], False), (1, 0, [True, True], False)),
        *((1, 0, [False, True], False), (0, 0, [True], False), (2, 0, [False, True], False)),
    ],
)
def test_dyads_have_a_closed_form_and_larger_groups_and_distances_none(
    angles: int, sliding: int, far: list[bool], closed: bool
) -> None:
    some = group(angles, sliding, far)
    assert AssurGroup.closed.func(some) is closed  # type: ignore[attr-defined]
    known: Any = SimpleNamespace(closed=True)
    for others in ((), (known,), (known, known)):
        every = (*others, SimpleNamespace(closed=closed), *others)
        assert PlacementPlan(3, (), every).closed is closed  # type: ignore[arg-type]
    assert PlacementPlan(3, (), ()).closed


def test_links_that_turn_together_follow_the_first_of_them() -> None:
    """Links 0 to 4, ground 5: 0, 1, 2 in a ring of three angles, one of which is one too many; 4 with the ground."""
    i, j = np.array([0, 1, 2, 5]), np.array([1, 2, 0, 4])
    layout: Any = SimpleNamespace(links=5, stack=SimpleNamespace(families=[Turn(np.arange(4) + 10, i, j)]))
    turns, leader = _turns(layout)
    assert leader.tolist() == [0, 0, 0, 3, 5, 5]
    assert turns == ((4, 5, 1.0, 13), (1, 0, 1.0, 10), (2, 0, -1.0, 12))


@pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
def test_a_row_depends_on_others_below_a_part_of_its_size(size: float) -> None:
    one, other = size * np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])
    for part, kept in (
        (0.0, [0, 2]),
        (0.9 * DEPENDENT, [0, 2]),
        (1.1 * DEPENDENT, [0, 1, 2]),
        (-1.1 * DEPENDENT, [0, 1, 2]),
    ):
        j = np.stack([one, one + size * part * other, size * np.array([1.0, 1.0, 1.0])])
        assert independent_rows(j, np.arange(3)).tolist() == kept
    j = np.stack([one, one, size * other])
    assert independent_rows(j, np.array([2, 1, 0])).tolist() == [2, 1]
    assert independent_rows(np.zeros((1, 3)), np.arange(1)).tolist() == []
