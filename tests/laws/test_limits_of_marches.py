"""Limits in the search for positions: touching circles, steps, breaks, halves of turns, at the limit and beside it."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.algebra import plane
from dalembert.core.layout import Pose, Turn
from dalembert.core.position import assembly_modes
from dalembert.core.position.assembly_modes import (
    NEAR,
    Wanted,
    _order,
    _wind,
    counted_links,
    distinct,
    remove_whole_turns,
    shift_from,
    sort_modes,
    wrap_angle,
)
from dalembert.core.position.continuation import STEP, Nodes, Station, _around, _passes, _safe, interpolate
from dalembert.core.position.dyads import TOUCHING, Laid, _roots
from dalembert.core.position.link_tree import Edges, spread_turns
from dalembert.core.position.motion_path import Path as MotionPath
from dalembert.core.position.motion_path import _first_reached, _separate
from dalembert.core.position.newton import distance, largest
from dalembert.core.position.path_parameter import NEAR as EQUAL
from dalembert.core.position.path_parameter import PathSamples, walk
from dalembert.core.position.whole_turns import EDGE, whole_turns

PI, TURN, NAN = math.pi, 2 * math.pi, math.nan


def polynomial(at: float, size: float, count: int) -> np.ndarray[Any, Any]:
    """size - cos(phi - at) at evenly spaced angles."""
    return size - np.cos(np.arange(count) * TURN / count - at)


@pytest.mark.parametrize("count", [3, 5])
@pytest.mark.parametrize("at", [-2.5, 0.0, 0.4, 3.0])
def test_circles_that_meet_touch_and_miss_have_two_one_and_no_angle(at: float, count: int) -> None:
    """cos(phi - at) = size: at +- acos(size), the same twice where they touch, none beyond the limit of touching.
    Samples of one polynomial more than needed are of a higher degree whose coefficients are 0."""
    sizes = [
        0.0,
        -0.6,
        1.0,
        -1.0,
        1 + 0.9 * TOUCHING,
        1 + 1.1 * TOUCHING,
        -1 - 0.9 * TOUCHING,
        -1 - 1.1 * TOUCHING,
    ]
    for size in sizes:
        (found,) = _roots(polynomial(at, size, count)[None])
        assert found.shape == (2,)
        if abs(size) > 1 + TOUCHING:
            assert np.isnan(found).all(), size
        else:
            angle = math.acos(max(-1.0, min(1.0, size)))
            assert np.cos(found - at) == pytest.approx([math.cos(angle)] * 2, abs=1e-8), size
            assert sorted(np.sin(found - at)) == pytest.approx(
                [-math.sin(angle), math.sin(angle)], abs=2e-4
            ), size
    both = _roots(np.array([polynomial(at, 0.0, count), polynomial(at, 2.0, count)]))
    assert np.isfinite(both).all(axis=1).tolist() == [True, False]


def test_the_roots_of_a_polynomial_of_the_second_degree_are_where_it_is_built_to_be_zero() -> None:
    """(a - cos(phi - p)) (b - cos(phi - q)): two angles of the first factor, two of the second, none of one beyond 1;
    also beside one of the first degree, and one without numbers."""
    phi = np.arange(5) * TURN / 5
    two = polynomial(0.3, 0.5, 5) * polynomial(-1.2, -0.2, 5)
    one = polynomial(0.3, 0.5, 5) * polynomial(-1.2, 1.5, 5)
    found = _roots(np.array([two, one, np.full(5, NAN), np.cos(phi) * 1e-3]))
    expected = [0.3 + PI / 3, 0.3 - PI / 3, -1.2 + math.acos(-0.2), -1.2 - math.acos(-0.2)]
    assert np.sort(found[0]) == pytest.approx(sorted((a + PI) % TURN - PI for a in expected))
    assert np.sort(found[1])[:2] == pytest.approx(sorted(expected[:2]))
    assert np.isnan(found[1]).sum() == 2
    assert np.isnan(found[2]).all()


@pytest.mark.parametrize(
    ("angle", "reduced"),
    [
        (PI, PI),
        (-PI, PI),
        (PI + 1e-9, 1e-9 - PI),
        (3 * PI, PI),
        (-3 * PI, PI),
        (5.0, 5 - TURN),
        (-1e-9, -1e-9),
        (0, 0),
    ],
)
def test_an_angle_is_reduced_to_half_a_turn_the_half_itself_ahead(angle: float, reduced: float) -> None:
    assert wrap_angle(np.array([angle])) == pytest.approx([reduced], abs=1e-12)
    turn = np.array([[angle, angle + 1.0, 7.0]])
    _wind(turn, np.array([0, 1]), np.array([NAN, NAN, 0.0]))
    assert turn == pytest.approx(np.array([[reduced, reduced + 1.0, 7.0]]), abs=1e-12)
    turn = np.array([[angle, angle + 1.0, 7.0]])
    _wind(turn, np.array([0, 1]), np.array([NAN, 21.0, 0.0]))  # the second is nearest to 21
    assert abs(turn[0, 1] - 21.0) <= PI + 1e-9
    assert turn[0, 1] - turn[0, 0] == pytest.approx(1.0)
    assert turn[0, 2] == 7.0


@pytest.mark.parametrize(
    ("off", "turns"),
    [
        (0, 0),
        (PI, 0),
        (PI + EDGE / 2, 0),
        (PI + 2 * EDGE, 1),
        (-PI, -1),
        (-PI + 2 * EDGE, 0),
        (3 * PI, 1),
        (TURN, 1),
    ],
)
def test_half_a_turn_ahead_is_no_turn_and_half_a_turn_behind_is_one(off: float, turns: int) -> None:
    assert whole_turns(np.array([off + 0.7]), np.array([0.7])).tolist() == [turns]
    assert 1e-8 < EDGE < 1e-6
    assert 0.3 < NEAR < 0.4


def samples(s: list[float], breaks: list[float], targets: list[list[float]]) -> PathSamples:
    return PathSamples(np.arange(len(s)), np.array(s), np.array(targets, float), np.array(breaks, float))


def test_a_course_ends_at_its_breaks_and_has_a_slope_on_each_side_of_them() -> None:
    """0 to 1 rises by 2, 1 to 3 falls by 6: slopes 2 and -3; the break at 1 is ahead from below and from above."""
    c = samples([0.0, 1.0, 3.0], [0.0, 1.0, 3.0], [[5.0], [7.0], [1.0]])
    for s, ahead, behind in (
        (0.0, 1.0, 0.0),
        (0.5, 1.0, 0.0),
        (1 - 2 * EQUAL, 1.0, 0.0),
        (1 - EQUAL / 2, 3.0, 0.0),
        (1.0, 3.0, 0.0),
        (1 + EQUAL / 2, 3.0, 0.0),
        (1 + 2 * EQUAL, 3.0, 1.0),
        (2.0, 3.0, 1.0),
        (3.0, 3.0, 1.0),
    ):
        assert (c.limit(s, 1.0), c.limit(s, -1.0)) == (ahead, behind), s
    for s, after, before in (
        *((0.0, 2.0, 2.0), (0.5, 2.0, 2.0), (1.0, -3.0, 2.0)),
        *((1 - EQUAL / 2, -3.0, 2.0), (1 + EQUAL / 2, -3.0, 2.0), (2.0, -3.0, -3.0), (3.0, -3.0, -3.0)),
    ):
        assert (c.slope(s, 1.0).tolist(), c.slope(s, -1.0).tolist()) == ([[after]], [[before]]), s
        assert c.target(s) == pytest.approx(np.array([[5 + 2 * s if s < 1 else 10 - 3 * s]]))
    assert c.end == 3.0
    none = samples([0.0, EQUAL], [0.0], [[5.0], [7.0]])
    assert none.slope(0.0, 1.0).tolist() == [[0.0]]
    assert samples([0.0, 4 * EQUAL], [0.0], [[5.0], [7.0]]).slope(0.0, 1.0) == pytest.approx(
        np.array([[0.5 / EQUAL]])
    )


def test_the_way_of_drives_is_that_of_the_one_that_travels_furthest() -> None:
    """A turn of 0.3 rad, and slides over a machine of 2 m: 0.8 m are 0.4; of one drive positions are sorted."""
    layout: Any = SimpleNamespace(
        freedoms=SimpleNamespace(angular=np.array([False, True, True])), driven=np.array([1, 0]), length=2.0
    )
    order, moves, s = walk(layout, np.array([[0.0, 0.0], [0.3, -0.8], [-0.2, -0.8]]))
    assert order.tolist() == [0, 1, 2]
    assert moves == pytest.approx(np.array([[0.3, -0.4], [-0.5, 0.0]]))
    assert s == pytest.approx([0.0, 0.4, 0.9])
    layout.driven = np.array([1])
    order, moves, s = walk(layout, np.array([[0.5], [-0.5], [0.5], [0.25]]))
    assert order.tolist() == [1, 3, 0, 2]
    assert s == pytest.approx([0.0, 0.75, 1.0, 1.0])
    layout.driven = np.array([0])
    assert walk(layout, np.array([[0.5], [-0.5]]))[2] == pytest.approx([0.0, 0.5])


def station(s: float, clear: float) -> Station:
    pose = Pose(np.zeros((1, 2)), np.zeros(1), np.zeros((1, 2)))
    return Station(s, pose, np.zeros((1, 3)), clear, None, 0.0)


@pytest.mark.parametrize(
    ("was", "now", "step"),
    [
        (4.0, 3.0, 0.75 * 0.6),  # 0.2 for 1: 0.6 are left to 0
        (-4.0, -3.0, 0.75 * 0.6),
        (3.0, 4.0, 3 * 0.8),  # 0.8 since 0
        (-1.0, 1.0, 3 * 0.1),  # passed half way
        (2.0, 2.0, math.inf),
        (-2.0, -2.0, math.inf),
        (-3.0, -4.0, 3 * 0.8),
        (0.0, 0.0, 1e-5),
        (2.0, 0.0, 1e-5),
        (0.0, 2.0, 3 * 0.2),
        (1.0, -3.0, 3 * 0.15),
        (1.0, 4e-5, 0.2 * 4e-5 / (1 - 4e-5) + 1e-5),  # within the limit: straight through
        (1.0, 6e-5, 0.75 * 0.2 * 6e-5 / (1 - 6e-5)),
        (-1.0, 1e-5, 1e-5),
    ],
)
def test_a_step_keeps_clear_of_a_singular_pose_or_passes_straight_through(
    was: float, now: float, step: float
) -> None:
    """Linear in s over stations 0.2 apart, in either direction of the march."""
    for first, last in ((1.0, 1.2), (1.2, 1.0)):
        assert _safe([station(first, was), station(last, now)]) == pytest.approx(step)
        assert _safe([station(7.0, 1.0), station(first, was), station(last, now)]) == pytest.approx(step)
    assert _safe([station(1.0, was)]) == math.inf
    assert STEP.through_singular == 1e-5


@pytest.mark.parametrize(
    ("was", "now", "step", "passes"),
    [
        (4, 3, 0.59, False),
        (4, 3, 0.61, True),
        (-4, -3, 0.59, False),
        (-4, -3, 0.61, True),
        (3, 4, 9.0, False),
    ],
)
def test_a_step_passes_a_singular_pose_if_it_is_longer_than_the_way_to_it(
    was: float, now: float, step: float, passes: bool
) -> None:
    for first, last in ((1.0, 1.2), (1.2, 1.0)):
        assert _passes([station(first, was), station(last, now)], step) is passes


@pytest.mark.parametrize(
    ("s", "k", "around"),
    [
        ([0.0], 0, [0]),
        ([0.0, 1.0], 0, [0, 1]),
        ([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0], 0, [0, 1, 2, 3, 4]),
        ([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0], 5, [2, 3, 4, 5, 6]),
        ([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0], 3, [1, 2, 3, 4, 5]),
        ([0.0, 1.0, 1.3, 1.6], 0, [0, 1, 2, 3]),  # 0.3 of the interval is not crowded
        ([0.0, 1.0, 1.29, 1.6], 0, [0, 1]),  # less is
        ([0.0, 0.3, 0.6, 1.6], 2, [0, 1, 2, 3]),
        ([0.0, 0.31, 0.6, 1.6], 2, [2, 3]),
        ([0.0, 2.0, 2.1, 3.1, 5.0, 7.0], 2, [2, 3, 4, 5]),  # crowded below, on above
        ([0.0, 2.0, 4.0, 5.0, 5.1, 7.0], 2, [0, 1, 2, 3]),
    ],
)
def test_an_interpolation_takes_the_nearest_five_stations_to_where_they_crowd(
    s: list[float], k: int, around: list[int]
) -> None:
    assert _around(np.array(s), k) == around


def test_a_polynomial_through_stations_is_met_everywhere_between_them() -> None:
    """Stations with rates of (s^3, s^2 - s): three of them fix polynomials up to the fifth degree, at any number of
    places, and also where different intervals have different numbers of stations."""
    layout: Any = SimpleNamespace(algebra=plane, constraints=SimpleNamespace(families=()))
    layout.stack, layout.counted = layout.constraints, ()
    for nodes in ([0.0, 0.5, 1.0], [0.0, 0.5, 1.0, 1.001], [0.0, 0.4, 0.8, 1.2, 1.6, 2.0, 2.4]):
        at = np.array(nodes)
        turn = np.column_stack([3 * at, 0 * at])
        point = np.stack([np.column_stack([at**3, at**2 - at]), np.zeros((len(at), 2))], axis=1)
        rate = np.zeros((len(at), 2, 3))
        rate[:, 0] = np.column_stack([3 * at**2, 2 * at - 1, 0 * at + 3])
        s = np.array([0.0, 0.1, 0.55, 0.9, 1.0, at[-1]])
        found = interpolate(layout, s, Nodes(at, Pose(point, turn, plane.rotation(turn)), rate))
        assert found.point[:, 0] == pytest.approx(np.column_stack([s**3, s**2 - s]), abs=1e-12)
        assert found.turn[:, 0] == pytest.approx(
            3 * s, abs=0.01
        )  # whole turns are those of the nearest station


def test_a_chain_of_fixed_angles_is_followed_in_any_order() -> None:
    """Ground (3) to 2 to 1 to 0, each listed before what it follows from, in either direction; 9 is unknown."""
    target = np.array([0.1, 0.2, 0.4, NAN])
    for turns in ([(1, 0, 0), (2, 1, 1), (3, 2, 2)], [(3, 2, 2), (2, 1, 1), (1, 0, 0)]):
        turn = np.array([[NAN, NAN, NAN, 0.0], [NAN, NAN, NAN, 1.0]])
        spread_turns(turn, target, Edges(turns, [], []))
        assert turn == pytest.approx(np.array([[0.7, 0.6, 0.4, 0.0], [1.7, 1.6, 1.4, 1.0]]))
    for turns in ([(0, 1, 0), (1, 2, 1), (2, 3, 2)], [(2, 3, 2), (1, 2, 1), (0, 1, 0)]):
        turn = np.array([[NAN, NAN, NAN, 0.0]])
        spread_turns(turn, target, Edges(turns, [], []))
        assert turn == pytest.approx(np.array([[-0.7, -0.6, -0.4, 0.0]]))
    turn = np.array([[NAN, NAN, NAN, 0.0]])
    spread_turns(turn, target, Edges([(3, 2, 3), (2, 1, 1)], [], []))
    assert np.isnan(turn[0, :3]).all()


def pose_of(points: list[float], turns: list[float]) -> Pose:
    """Poses of one link that lie along x, beside the ground."""
    point, turn = np.zeros((len(points), 2, 2)), np.zeros((len(points), 2))
    point[:, 0, 0], turn[:, 0] = points, turns
    return Pose(point, turn, plane.rotation(turn))


def test_modes_are_the_same_within_a_ten_thousandth_of_the_machine_and_but_for_whole_turns() -> None:
    layout: Any = SimpleNamespace(length=2.0, algebra=plane)
    for off, turn, count in (
        *(
            (0.0, 0.0, 1),
            (1.9e-4, 0.0, 1),
            (2.1e-4, 0.0, 2),
            (-2.1e-4, 0.0, 2),
            (0.0, 0.9e-4, 1),
            (0.0, 1.1e-4, 2),
        ),
        *((0.0, -1.1e-4, 2), (0.0, TURN, 1), (0.0, TURN - 1.1e-4, 2), (0.0, -TURN + 0.9e-4, 1)),
    ):
        poses = pose_of([1.0, 1.0 + off], [0.5, 0.5 + turn])
        assert len(distinct(layout, poses).turn) == count, (off, turn)
    three = distinct(layout, pose_of([1.0, 3.0, 1.0, 3.0, 2.0], [0.5] * 5))
    assert three.point[:, 0, 0].tolist() == [1.0, 3.0, 2.0]


def laid(rows: list[tuple[float, float, float]], length: float = 2.0) -> tuple[Any, Laid]:
    """Modes of two links by the side of a group, the angle of the first link and its place along x."""
    side, turn, x = np.array(rows, float).T
    point = np.zeros((len(rows), 3, 2))
    point[:, 0, 0] = x
    layout: Any = SimpleNamespace(length=length)
    return layout, Laid(point, np.stack([turn, 0 * turn, 0 * turn], axis=-1), side[:, None])


def given(angle: float, x: float = NAN, start: float | None = None) -> Wanted:
    point = np.full((3, 2), NAN)
    point[0, 0] = x
    turn = np.array([angle, NAN, 0.0])
    pose = None if start is None else Pose(np.zeros((3, 2)), np.array([start, 0.0, 0.0]), np.zeros((3, 2)))
    return Wanted(turn, point, pose)


@pytest.mark.parametrize(
    ("rows", "wanted", "order"),
    [
        # the side first, of which one that is not known is none that is wrong; then the angle; then the place
        ([(-1, 0.5, 3), (1, 0.9, 1), (1, 0.7, 2), (0, 0.6, 9)], given(0.5, 1.0), [3, 2, 1, 0]),
        ([(1, 0.6, 3), (1, 0.4, 2), (1, 0.5 + TURN, 9)], given(0.5, 1.0), [2, 1, 0]),
        ([(1, 0.6, 3), (1, 0.6, -2), (1, 0.6, 2)], given(0.6, 1.0), [2, 0, 1]),
        # the pose that Newton reaches settles what the places leave open
        ([(1, 0.6, 0.4), (1, 0.4, 0.2), (1, 0.6, 0.0)], given(0.5, NAN, 0.6), [2, 0, 1]),
        # all alike but for what the sliders and heights say: further along first, then higher
        ([(1, 0.6, 2), (1, 0.6, 2), (1, 0.4, 2), (1, 0.6, 2)], given(0.5, 1.0), [1, 3, 2, 0]),
        # without angles these decide after the sides
        ([(1, 0.6, 0.1), (-1, 0.6, 0), (1, 0.4, 0), (1, 0.6, 0)], given(NAN), [1, 3, 2, 0]),
        ([(1, 0.6, 0.1), (1, 0.6, 0), (1, 0.4, 0), (1, 0.6, 0)], given(NAN, NAN, 0.4), [1, 3, 2, 0]),
    ],
)
def test_modes_are_ordered_by_sides_then_angles_then_places_then_sliders(
    rows: list[tuple[float, float, float]], wanted: Wanted, order: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    along, height = np.array([0.1, 0.3, 0.2, 0.3]), np.array([9.0, 8.0, 7.0, 6.0])
    monkeypatch.setattr(
        assembly_modes, "measures", lambda layout, pose: (along[: len(rows)], height[: len(rows)])
    )
    monkeypatch.setattr(assembly_modes, "to_pose", lambda layout, placed: placed)
    layout, placed = laid(rows)
    stated = np.array([1.0 if wanted.any_known else 0.0, 0.0])
    assert wanted.any_known == (not math.isnan(wanted.turn[0]))
    assert _order(layout, placed, stated, wanted).tolist() == order


def test_modes_whose_groups_are_unknown_are_ordered_by_angles_then_places(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(
        assembly_modes, "measures", lambda layout, pose: (np.array([1.0, 2, 2]), np.array([9.0, 1, 5]))
    )
    layout, placed = laid([(0, 0.6, 3), (0, 0.6 - TURN, 2), (0, 0.5, 7)])
    pose = Pose(placed.point, placed.turn, placed.point)
    assert sort_modes(layout, pose, given(0.5, 1.0)).tolist() == [2, 1, 0]
    assert sort_modes(layout, pose, given(0.61, 3.0)).tolist() == [0, 1, 2]
    assert sort_modes(layout, pose, given(NAN)).tolist() == [2, 1, 0]
    assert shift_from(layout, pose, given(0.5, 1.0).point) == pytest.approx([1.0, 0.5, 3.0])


def test_whole_turns_are_kept_only_of_links_that_some_row_counts() -> None:
    one = np.array([0])
    layout: Any = SimpleNamespace(links=3, stack=SimpleNamespace(families=[Turn(one, one + 3, one + 1)]))
    assert counted_links(layout).tolist() == [False, True, False]
    turn = np.array([7.0, 7.0, -4.0, 0.0])
    pose = remove_whole_turns(layout, Pose(np.zeros((4, 2)), turn, np.zeros((4, 2))))
    assert pose.turn == pytest.approx([7 - TURN, 7.0, TURN - 4, 0.0])
    assert turn.tolist() == [7.0, 7.0, -4.0, 0.0]


def test_the_distance_of_two_poses_is_a_turn_or_a_shift_by_the_size_of_the_machine() -> None:
    layout: Any = SimpleNamespace(length=2.0, algebra=plane, wrench_scale=np.array([1.0, 1.0, 0.5]))
    a, b = pose_of([1.0, 1.0, 1.0], [0.5] * 3), pose_of([1.0, 0.2, 1.5], [0.2, 0.6, 0.5])
    assert distance(layout, a, b) == pytest.approx([0.3, 0.4, 0.25])
    dq = np.array([[[0.0, -0.8, 0.1]], [[0.2, 0.0, -0.7]]])
    assert largest(layout, dq) == pytest.approx([0.4, 0.7])


def test_of_two_paths_the_first_that_reached_a_position_says_its_pose() -> None:
    one, other = pose_of([1.0, 2.0, 3.0], [0.1] * 3), pose_of([4.0, 5.0, 6.0], [0.2] * 3)
    stretch = np.array([0, 3, 0])
    a = MotionPath(one, np.array([True, False, False]), stretch)
    b = _separate(MotionPath(other, np.array([True, True, False]), stretch), a)
    assert b.stretch.tolist() == [4, 4, 4]
    both = _first_reached(a, b)
    assert both.pose.point[:2, 0, 0].tolist() == [1.0, 5.0]
    assert both.reached.tolist() == [True, True, False]
    assert both.stretch[:2].tolist() == [0, 4]
    assert _first_reached(a._replace(reached=np.ones(3, bool)), b).pose is one
