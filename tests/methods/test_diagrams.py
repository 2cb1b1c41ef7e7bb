"""Curves and hodographs as drawings: what is missing, where an axis begins, which path is closed; by hand, in mm."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from dalembert.views.paper.diagrams import Field, curves_scene, inner_ticks, polar_scene, ticks
from dalembert.views.paper.scene import Circle, Line, Polygon, Scene

NAN = math.nan


def of(scene: Scene, kind: type, role: str) -> list[Any]:
    return [i for i in scene.items if isinstance(i, kind) and i.role == role]


def legend(scene: Scene) -> dict[str, float]:
    """The names in the legend and their heights."""
    return {t.text: t.at[1] for t in scene.texts() if t.at[0] == 95.5}


def levels(scene: Scene) -> list[float]:
    """The numbers along the upright axis."""
    return [float(t.text.replace("−", "-")) for t in scene.texts() if t.at[0] == -1.5 and t.anchor == "end"]


def test_what_is_missing_is_grey_and_a_single_value_is_a_dot() -> None:
    """Six positions 16.8 mm apart, values from 0 to 6 of 52 mm; a value of any curve is enough."""
    curves = {"a": [NAN, 1, 2, NAN, 6, NAN], "b": [NAN, NAN, 3, NAN, NAN, NAN]}
    series = {n: np.array(v, float) for n, v in curves.items()}
    scene = curves_scene(np.arange(6.0), series, "k", "y in N", "Gaps", levels={"limit": 4.0})
    (grey, later, last, swatch) = of(scene, Polygon, "missing-fill")
    for area, (left, right) in ((grey, (0, 16.8)), (later, (33.6, 67.2)), (last, (67.2, 84))):
        assert area.points == pytest.approx(np.array([(left, 0), (right, 0), (right, 52), (left, 52)]))
    (line, sample), (dot,) = of(scene, Line, "curve-1"), of(scene, Circle, "curve-1")
    assert line.points == pytest.approx(np.array([(16.8, 52 / 6), (33.6, 52 / 3)]))
    assert (dot.center, dot.radius) == (pytest.approx((67.2, 52)), 0.4)
    (other,) = of(scene, Circle, "curve-2")
    assert other.center == pytest.approx((33.6, 26))
    limit, named = of(scene, Line, "level")
    assert limit.points == pytest.approx(np.array([(0, 52 * 4 / 6), (84, 52 * 4 / 6)]))
    assert legend(scene) == pytest.approx({"a": 50.0, "b": 45.4, "limit": 40.8, "no answer": 36.2})
    assert sample.points == ((87.0, 50.0), (94.0, 50.0))
    assert named.points == ((87.0, pytest.approx(40.8)), (94.0, pytest.approx(40.8)))
    assert swatch.points == pytest.approx(np.array([(87, 34.8), (94, 34.8), (94, 37.6), (87, 37.6)]))
    assert levels(scene) == [0, 1, 2, 3, 4, 5, 6]
    edges, zero = of(scene, Line, "axis")[::-1]
    assert edges.points == ((0.0, 52.0), (0.0, 0.0), (84.0, 0.0))
    assert zero.points == ((0.0, 0.0), (84.0, 0.0))
    upright = [line.points for line in of(scene, Line, "grid")[:6]]
    assert upright == [((pytest.approx(16.8 * k), 0.0), (pytest.approx(16.8 * k), 52.0)) for k in range(6)]
    heads = {t.text: t.at for t in scene.texts()}
    assert heads["k"] == (42.0, -7.6)
    assert heads["y in N"] == (-1.5, 56.2)
    assert "Gaps" in heads
    assert list(scene.numbers) == ["a", "b"]
    np.testing.assert_array_equal(scene.numbers["a"], curves["a"])


@pytest.mark.parametrize(
    ("x", "left", "right"), [([2.0, 3.0, 4.0], 2, 4), ([2.0, NAN, 4.0], 2, 4), ([3.0], 2, 4), ([NAN], 0, 1)]
)
def test_a_chart_without_any_value_is_grey_as_a_whole(x: list[float], left: float, right: float) -> None:
    """A single place has one unit on both sides; without a place there is no area to be grey."""
    scene = curves_scene(np.array(x), {"a": np.full(len(x), NAN)}, "x", "y")
    drawn = of(scene, Polygon, "missing-fill")
    if math.isnan(x[0]):
        assert not drawn
        assert "no answer" not in legend(scene)
    else:
        edges = (0.0, 84.0) if len(x) > 1 else (42.0, 42.0)
        assert [p[0] for p in drawn[0].points] == [edges[0], edges[1], edges[1], edges[0]]
        assert "no answer" in legend(scene)
    assert levels(scene) == pytest.approx([0, 0.2, 0.4, 0.6, 0.8, 1])
    marks = {float(t.text.replace("−", "-")): t.at[0] for t in scene.texts() if t.at[1] == -3.2}
    assert {left, right} <= marks.keys()
    assert (marks[left], marks[right]) == (0.0, 84.0)


@pytest.mark.parametrize(
    ("values", "first", "last"),
    [
        ([10.0, 14.9], 10, 15),  # far from 0 beside its spread
        ([10.0, 15.1], 0, 20),
        ([-14.9, -10.0], -15, -10),
        ([-15.1, -10.0], -20, 0),
        ([100.0, 101.1], 100, 101.2),  # a spread of more than a hundredth
        ([100.0, 100.9], 0, 120),
        ([-3.0, 2.0], -3, 2),
        ([7.0, 7.0], 0, 8),
        ([0.0, 0.0], -1, 1),
        ([math.inf, 3.0], 0, 3),
    ],
)
def test_an_axis_begins_at_zero_where_that_is_near(values: list[float], first: float, last: float) -> None:
    scene = curves_scene(np.arange(2.0), {"a": np.array(values)}, "x", "y")
    assert levels(scene)[0] == pytest.approx(first)
    assert levels(scene)[-1] == pytest.approx(last)
    zero = of(scene, Line, "axis")
    assert len(zero) == 1 + (first <= 0 <= last)


@pytest.mark.parametrize(("way", "end"), [(1, 360), (-1, -30)])
def test_a_full_turn_is_drawn_to_its_beginning(way: int, end: float) -> None:
    """Of twelve positions, 30 degrees apart, the first is drawn once more; the numbers are as given."""
    x = 30.0 * np.arange(12)[::way]
    y = np.cos(np.radians(x)) + 2
    scene = curves_scene(x, {"a": y}, "°", "y", angle=True)
    (line, _) = of(scene, Line, "curve-1")
    low, high = min(x[0], end), max(x[0], end)
    assert [p[0] for p in line.points] == pytest.approx(84 * (np.append(x, end) - low) / (high - low))
    assert line.points[-1][1] == pytest.approx(line.points[0][1])
    assert scene.numbers["a"] == y.tolist()
    (open_, _) = of(curves_scene(x[:7], {"a": y[:7]}, "°", "y", angle=True), Line, "curve-1")
    assert len(open_.points) == 7
    (plain, _) = of(curves_scene(x, {"a": y}, "mm", "y"), Line, "curve-1")
    assert len(plain.points) == 12


def test_ticks_are_round_and_few_enough() -> None:
    """As many steps as allowed, no more; of angles a part of the turn."""
    assert ticks(0.0, 6.0) == [0, 1, 2, 3, 4, 5, 6]
    assert ticks(0.0, 6.1) == [0, 2, 4, 6, 8]
    assert ticks(-0.3, 0.7) == [-0.4, -0.2, 0, 0.2, 0.4, 0.6, 0.8]
    assert ticks(5.0, 5.0) == [4, 4.5, 5, 5.5, 6]
    for span, step in ((30, 5), (31, 10), (60, 10), (61, 15), (91, 30), (181, 45), (271, 60), (361, 90)):
        assert np.diff(ticks(0.0, span, 6, True))[0] == step
    assert np.diff(ticks(0.0, 541.0, 6, True))[0] == 180
    assert ticks(100.0, 130.0, 6, True) == [100, 105, 110, 115, 120, 125, 130]
    assert np.diff(ticks(0.0, 1081.0, 6, True))[0] == 360
    assert inner_ticks(0.5, 6.5) == [1, 2, 3, 4, 5, 6]
    assert inner_ticks(1.0 + 1e-12, 6.0) == [1, 2, 3, 4, 5, 6]


def test_the_seventh_curve_looks_as_the_first() -> None:
    series = {f"c{k}": np.arange(3.0) + k for k in range(7)}
    roles = [f"curve-{n}" for n in (1, 2, 3, 4, 5, 6, 1)]
    drawn = [
        i.role
        for i in curves_scene(np.arange(3.0), series, "x", "y").items
        if len(getattr(i, "points", ())) == 3
    ]
    assert [role for role in drawn if role.startswith("curve")] == roles
    paths = {name: np.stack([v, v * v], axis=1) for name, v in series.items()}
    drawn = [i.role for i in polar_scene(paths, "N", "t").items if len(getattr(i, "points", ())) in (3, 4)]
    assert [role for role in drawn if role.startswith("curve")] == roles


def test_a_field_holds_what_is_within_its_borders() -> None:
    field = Field.around(np.array([1.0, 3.0]), np.array([2.0, 4.0]))
    assert (field.x, field.y[0], field.y[-1]) == ((1.0, 3.0), 0.0, 4.0)
    assert field(2.0, 1.0) == (42.0, 13.0)
    for inside in ((1.0, 1.0), (83.0, 1.0), (1.0, 51.0), (83.0, 51.0)):
        assert field.holds(inside, 1.0)
    for beside in ((0.9, 9.0), (83.1, 9.0), (9.0, 0.9), (9.0, 51.1)):
        assert field.holds(beside)
        assert not field.holds(beside, 1.0)
    assert Field.around(np.array([2.0, 2.0]), np.array([2.0])).x == (1.0, 3.0)


SQUARE = [[1.0, 0], [0, 1], [-1, 0], [0, -1]]


@pytest.mark.parametrize(
    ("path", "runs"),
    [
        (SQUARE, [[0, 1, 2, 3, 0]]),
        ([[0.0, 0], [2, 0], [3, 0], [3.5, 0]], [[0, 1, 2, 3, 0]]),  # its ends within two steps
        ([[0.0, 0], [2, 0], [3, 0], [4.5, 0]], [[0, 1, 2, 3]]),
        ([[0.0, 1], [2, 0]], [[0, 1]]),  # two positions are no cycle
        ([[0.0, 1], [1, 0], [NAN, NAN], [3, 1], [NAN, NAN], [2, 2], [2, 3]], [[0, 1], [3], [5, 6]]),
    ],
)
def test_a_path_is_closed_only_where_its_ends_are_near(
    path: list[list[float]], runs: list[list[int]]
) -> None:
    """In pieces without gaps; at a scale at which its extent, that of the pole included, is 62 mm."""
    points = np.array(path, float)
    scene = polar_scene({"F": points}, "N", "Path")
    around = np.append(points[np.isfinite(points[:, 0])], [[0, 0]], axis=0)
    scale = 62 / np.ptp(around, axis=0).max()
    assert scene.scales["force"] == pytest.approx(1 / scale)
    lines = [np.array(i.points) for i in of(scene, Line, "curve-1")]
    dots = of(scene, Circle, "curve-1")
    expected = [points[run] * scale for run in runs]
    for a, b in zip(lines, [e for e in expected if len(e) > 1], strict=True):
        assert a == pytest.approx(b)
    assert [(d.center, d.radius) for d in dots] == [
        (pytest.approx(tuple(e[0])), 0.4) for e in expected if len(e) == 1
    ]
    upright, level = of(scene, Line, "axis")[::-1]
    low, high = around.min(axis=0) * scale - 6.2, around.max(axis=0) * scale + 6.2
    assert level.points == pytest.approx(np.array([(low[0], 0), (high[0], 0)]))
    assert upright.points == pytest.approx(np.array([(0, low[1]), (0, high[1])]))
    assert "Circles in N" in {t.text for t in scene.texts()}


def test_circles_of_a_hodograph_are_cut_at_its_window() -> None:
    """To the right of the pole, up to 10 N: a circle every 2.5 N, each a single arc about the x-axis."""
    path = np.array([[10.0, 0], [8, 3], [8, -3]])
    scene = polar_scene({"F": path}, "N", "Path")
    rings = [np.array(i.points) for i in of(scene, Line, "grid")]
    radii = [float(np.hypot(*r.T).mean()) for r in rings]
    step = 2.5 * 6.2
    assert radii == pytest.approx([step, 2 * step, 3 * step, 4 * step])
    low, high = np.array([-6.2, -3 * 6.2 - 6.2]), np.array([62 + 6.2, 3 * 6.2 + 6.2])
    for ring in rings:
        assert np.hypot(*ring.T) == pytest.approx(np.hypot(*ring[0]))
        assert (ring >= low - 1e-9).all()
        assert (ring <= high + 1e-9).all()
        turn = np.degrees(np.arctan2(ring[:, 1], ring[:, 0]))
        assert np.diff(turn) == pytest.approx(2.5)
        assert turn[0] == pytest.approx(-turn[-1])
    names = {t.text for t in scene.texts() if t.role == "note"}
    assert {"2.5", "5", "7.5", "10"} <= names


def test_a_circle_that_a_low_window_cuts_has_two_arcs() -> None:
    """One to the left and one to the right, about the x-axis; the largest only reaches two corners."""
    path = np.array([[10.0, 0], [-9, 3], [-9, -3]])
    scene = polar_scene({"F": path}, "N", "Path")
    scale, top = 62 / 19, 3 * 62 / 19 + 6.2
    runs = [np.array(i.points) / scale for i in of(scene, Line, "grid")]
    assert [np.hypot(*r.T).mean().round(9) for r in runs] == [2.5, 5, 5, 7.5, 7.5, 10, 10, 12.5, 12.5]
    assert len(runs[0]) == 145  # from 0 to 360 degrees
    for left, right, radius in ((*runs[1:3], 5.0), (*runs[3:5], 7.5), (*runs[5:7], 10.0)):
        steepest = np.degrees(np.arcsin(top / scale / radius))
        each = 1 + 2 * math.floor(steepest / 2.5)
        assert (len(left), len(right)) == (each, each)
        assert (left[:, 0].max() < 0) & (right[:, 0].min() > 0)
    above, below = runs[7:]  # in the corners on the right
    turn = np.radians([20.0, 22.5])
    assert above == pytest.approx(12.5 * np.stack([np.cos(turn), np.sin(turn)], axis=1))
    assert below == pytest.approx(above[::-1] * [1, -1])


def test_positions_are_marked_at_a_distance_and_paths_named() -> None:
    """Two positions within 3 mm have one mark; one without a force has none."""
    path = np.array([[0.0, 10], [0.4, 10], [NAN, NAN], [5, 0], [5, 0.6]])
    labels = [(k, f"p{k}") for k in range(5)]
    scene = polar_scene({"A": path, "B": path / 2}, "N", "Paths", labels=labels)
    texts = [t.text for t in scene.texts()]
    assert [t for t in texts if t.startswith("p")] == ["p0", "p3", "p4", "p0", "p3"]
    scale = 6.2
    marks = [c.center for c in of(scene, Circle, "mark")]
    wanted = [*path[[0, 3, 4]] * scale, *path[[0, 3]] / 2 * scale]
    assert marks == pytest.approx(np.array(wanted))
    assert {"A", "B"} <= set(texts)
    assert "A" not in [t.text for t in polar_scene({"A": path}, "N", "Path").texts()]
