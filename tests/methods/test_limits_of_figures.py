"""Numbers and axes of drawings at their limits: figures, powers of ten, where an axis begins, what has a place."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.analysis.methods.applied_forces import Action
from dalembert.printing import number, range_text, round_components
from dalembert.units import Units
from dalembert.views.charts import _backwards, stepped_series
from dalembert.views.notation import Figures, Notation, Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.diagrams import Field, _closed_cycle, _missing, _reach, _ring, inner_ticks, ticks
from dalembert.views.paper.frame import FINE, PaperFrame, fit_frame, force_scale, round_up
from dalembert.views.paper.scene import Arrow
from dalembert.views.plane.circle_details import WINDOW, chord
from dalembert.views.plane.force_polygons import (
    _gap_text,
    _inside,
    _middle,
    _through,
    _two_meetings,
    arm_of_couple,
    draw_polygon,
    forces_of,
)

NAN, INF = math.nan, math.inf


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (1.2344e-4, "0.0001234"),
        (0.99994e-4, "9.999e−05"),
        (0.99996e-4, "0.0001000"),  # rounded it has four zeros before it
        (9.9994e6, "9999400"),
        (9.9996e6, "1.000e+07"),
        (1.2346e7, "1.235e+07"),
        (-1.2346e7, "−1.235e+07"),
        (999.96, "1000"),
        (99.994, "99.99"),
        (99.996, "100.0"),
        (1000.4, "1000"),
        (12345.6, "12346"),
        (0.0, "0"),
        (-0.0, "0"),
        (NAN, "-"),
        (-INF, "-"),
    ],
)
def test_a_number_has_four_figures_and_a_power_of_ten_beyond_limits(value: float, text: str) -> None:
    assert Notation().number(value) == text
    if value:
        assert Notation(decimals=1).number(value) == (
            "-" if not math.isfinite(value) else f"{value:.1f}".replace("-", "−")
        )


@pytest.mark.parametrize(
    ("angle", "text"),
    [
        (math.radians(10.0), "10.00"),
        (math.radians(9.9996), "10.00"),
        (math.radians(100.0), "100.00"),  # two decimals at least: as accurate as a length
        (math.radians(1.0), "1.000"),
        (math.radians(0.1), "0.1000"),
        (math.radians(-1e-4), "−0.0001000"),
        (math.radians(0.9e-4), "9.000e−05"),
        (0.9e-12, "0"),
        (-0.9e-12, "0"),
        (1.1e-12, "6.303e−11"),
        (NAN, "-"),
    ],
)
def test_an_angle_has_as_many_decimals_as_make_it_as_accurate_as_a_length(angle: float, text: str) -> None:
    assert Notation().degrees(angle) == text
    assert Notation(decimals=1).degrees(1.0) == "57.3"


def test_a_direction_along_an_axis_is_exact() -> None:
    """A component below 1e-12 of the vector is none."""
    for size in (1.0, 1e-9, 1e9):
        for x, y, text in (
            *(
                (1.0, 0.9e-12, "0"),
                (1.0, -0.9e-12, "0"),
                (-1.0, -0.9e-12, "180.00"),
                (-1.0, 0.9e-12, "180.00"),
            ),
            *((0.9e-12, 1.0, "90.00"), (-0.9e-12, -1.0, "−90.00"), (1.0, 1.0, "45.00"), (0.0, 0.0, "0")),
            (1.0, 1.1e-12, "6.303e−11"),
        ):
            assert Notation().direction(size * x, size * y) == text


def test_factors_between_units_are_whole_numbers_or_powers() -> None:
    f = Figures(Units(length="mm", force="N"), Notation())
    for factor, text in (
        (1000.0, "1000"), (1e5, "100000"), (1e6, "10^{6}"), (1e9, "10^{9}"), (2e6, "2000000"), (32.174, "32.17"),
        (1000 * (1 + 0.9e-9), "1000"), (1000 * (1 + 2e-6), "1000"), (12.5, "12.50"),
    ):  # fmt: skip
        assert f.conversion(factor) == text
    assert f._with_factor("a b", 1.0) == "a b"
    assert f._with_factor("a b", 1 + 0.9e-9) == "a b"
    assert f._with_factor("a b", 0.001) == "a b / 1000"
    assert f._with_factor("a b", 1000.0) == "a b cdot 1000"
    assert f._with_factor("a b", 0.25) == "a b / 4"
    assert f._with_factor("a b", 1.5) == "a b cdot 1.500"
    assert f._with_factor("a b", 1 + 2e-6) == "a b cdot 1.000"
    assert f.factor("force", "mass", "acceleration") == pytest.approx(1e-3)
    assert Figures(None, Notation()).factor("force", "mass", "acceleration") == 1.0
    assert f.factor("moment", "force", "length") == 1.0
    assert f.with_factor("m a", "force", "mass", "acceleration") == "m a / 1000"
    assert f.arm_unit == "mm"
    assert Figures(Units(length="mm", force="N", derived=(("moment", "N*m"),)), Notation()).arm_unit == "m"
    assert (
        Figures(Units(length="ft", force="lbf", derived=(("moment", "lbf*in"),)), Notation()).arm_unit == "in"
    )
    odd = Figures(Units(length="mm", force="lbf", derived=(("moment", "N*m"),)), Notation())
    assert odd.arm_unit == "N·m/lbf"
    assert f.number("length", 0.02) == "20.00"
    assert f.number("length", 0.02, 0.021) == "0"
    assert f.number("length", -0.02, 0.02) == "−20.00"
    assert f.text("force", 0.0) == "0 N"
    assert f.plain("length", 0.0125) == "12.5 mm"
    assert Figures(None, Notation(torque=-1)).value("moment", 3.0) == -3.0
    assert Figures(None, Notation(torque=-1)).size("moment") == 1.0


def shown(signs: dict[str, str], joints: dict[str, tuple[str, str]], loads: tuple[str, ...] = ()) -> Shown:
    """Signs of the links, and joints between two of them each."""
    s = Shown.__new__(Shown)
    described = {name: SimpleNamespace(links=links) for name, links in joints.items()}
    s.notation = Notation()
    s.r = SimpleNamespace(
        mechanism=SimpleNamespace(joints=described, loads=dict.fromkeys(loads)), joints=tuple(joints)
    )  # type: ignore[assignment]
    vars(s)["_signs"] = signs
    return s


def test_indices_of_forces_have_a_comma_between_long_signs_and_the_joint_where_two_are_alike() -> None:
    s = shown(
        {"a": "1", "b": "2", "c": "10"}, {"A": ("a", "b"), "B": ("b", "c"), "C": ("c", "b"), "D": ("a", "c")}
    )
    assert [s.pair(*two) for two in (("a", "b"), ("a", "c"), ("c", "a"), ("c", "c"))] == [
        "12",
        "1,10",
        "10,1",
        "10,10",
    ]
    assert [s.between("A", on) for on in ("b", "a")] == ["12", "21"]
    assert [s.between("B", "c"), s.between("C", "c"), s.between("D", "c")] == ["2,10,B", "2,10,C", "1,10"]
    assert shown({"a": "1", "b": "2"}, {"A": ("a", "b")}, ("F_12",)).between("A", "b") == "12,A"
    assert shown({"a": "1", "b": "2"}, {"A": ("a", "b")}, ("M21",)).between("A", "b") == "12,A"
    assert shown({"a": "1", "b": "2"}, {"A": ("a", "b")}, ("F_13",)).between("A", "b") == "12"
    assert [s._part("F_{14}", part) for part in ("normal", "ahead", "")] == [
        "N_{14}",
        "F_{14,ahead}",
        "F_{14}",
    ]
    assert s.heading("b") == "2 b"
    assert shown({"2": "2"}, {}).heading("2") == "2"


def test_a_printed_number_has_six_figures_or_as_many_as_its_integer() -> None:
    for value, text in (
        (999999.4, "999999"), (999999.6, "1e+06"), (-999999.4, "-999999"), (123456.7, "123457"), (NAN, "-"), (INF, "-"),
    ):  # fmt: skip
        assert number(value) == text
    values = (999.4, 1000.4, 99999.0, 999999.4, 1e6)
    assert [number(v, 3) for v in values] == [
        "999",
        "1000",
        "99999",
        "999999",
        "1e+06",
    ]
    assert round_components([0.9e-12, 1.0, -1.0, -0.9e-12, 1.1e-12]) == [0.0, 1.0, -1.0, 0.0, 1.1e-12]
    assert round_components([NAN, 1e-13, 1.0])[1:] == [0.0, 1.0]
    assert round_components([2.0, 3.0], 4e12) == [0.0, 0.0]
    assert range_text(("0", "3"), "N") == "0 to 3 N"


@pytest.mark.parametrize(
    ("values", "reach"),
    [
        ((2.0, 2.99), (2.0, 2.99)),
        ((2.0, 3.0), (0.0, 3.0)),  # half of the nearer end: from zero
        ((-2.99, -2.0), (-2.99, -2.0)),
        ((-3.0, -2.0), (-3.0, 0.0)),
        ((100.0, 101.02), (100.0, 101.02)),
        ((100.0, 101.005), (0.0, 101.005)),
        ((-101.005, -100.0), (-101.005, 0.0)),
        ((100.0, 101.0), (0.0, 101.0)),  # it hardly varies: by a hundredth of the further end
        ((-101.02, -100.0), (-101.02, -100.0)),
        ((-101.0, -100.0), (-101.0, 0.0)),
        ((-2.0, 3.0), (-2.0, 3.0)),
        ((-1.0, 900.0), (-1.0, 900.0)),
        ((5.0, 5.0), (0.0, 5.0)),
        ((0.0, 0.0), (0.0, 0.0)),
        ((NAN, INF), (0.0, 1.0)),
        ((NAN, 4.0, 3.9, INF), (3.9, 4.0)),
    ],
)
def test_an_axis_begins_at_zero_unless_the_values_are_far_from_it_and_vary(
    values: tuple[float, ...], reach: tuple[float, float]
) -> None:
    assert _reach(np.array(values)) == reach


def test_ticks_cover_a_range_and_inner_ones_stay_within() -> None:
    assert ticks(0.0, 6.0) == [0, 1, 2, 3, 4, 5, 6]
    assert ticks(0.0, 6.1) == [0, 2, 4, 6, 8]
    assert ticks(-0.5, 1.0) == [-0.5, -0.25, 0, 0.25, 0.5, 0.75, 1.0]
    assert ticks(3.0, 3.0) == [2, 2.5, 3, 3.5, 4]
    assert ticks(1 - 1e-10, 2 + 1e-10, 2) == [1, 2]  # rounding needs no further tick
    assert ticks(0.0, 90.0, 6, True) == [0, 15, 30, 45, 60, 75, 90]
    assert ticks(0.0, 91.0, 6, True) == [0, 30, 60, 90, 120]
    assert ticks(0.0, 1080.0, 6, True) == [0, 180, 360, 540, 720, 900, 1080]
    assert ticks(0.0, 1440.0, 6, True) == [0, 360, 720, 1080, 1440]
    assert inner_ticks(1.0, 5.0, 4) == [1, 2, 3, 4, 5]
    assert inner_ticks(1 + 1e-10, 5 - 1e-10, 4) == [1, 2, 3, 4, 5]
    assert inner_ticks(1.002, 4.998, 4) == [2, 3, 4]
    assert ticks(0.9999, 2.0001) == [0.8, 1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.2]


def test_a_field_has_room_around_a_single_value() -> None:
    f = Field.around(np.array([3.0, 3.0]), np.array([1.0, 4.0]))
    assert (f.x, f.y) == ((2.0, 4.0), [0, 1, 2, 3, 4])
    assert f(3.0, 2.0) == pytest.approx((42.0, 26.0))
    g = Field.around(np.array([3.0, 5.0]), np.array([1.0, 4.0]))
    assert g.x == (3.0, 5.0)
    for point, edge, inside in (
        ((0.0, 0.0), 0.0, True), ((84.0, 52.0), 0.0, True), ((84.1, 52.0), 0.0, False), ((84.0, 52.1), 0.0, False),
        ((-0.1, 1.0), 0.0, False), ((1.0, -0.1), 0.0, False), ((2.0, 2.0), 2.0, True), ((82.0, 50.0), 2.0, True),
        ((82.1, 50.0), 2.0, False), ((82.0, 50.1), 2.0, False), ((1.9, 2.0), 2.0, False), ((2.0, 1.9), 2.0, False),
    ):  # fmt: skip
        assert f.holds(point, edge) is inside


def test_what_is_missing_lies_between_known_places_and_at_the_ends() -> None:
    x = np.array([0.0, 1.0, 2.0, 4.0, 5.0])
    for known, missing in (
        ([1, 1, 1, 1, 1], []),
        ([0, 1, 1, 1, 1], [(0.0, 1.0)]),
        ([1, 1, 1, 1, 0], [(4.0, 5.0)]),
        ([1, 0, 1, 1, 1], [(0.0, 2.0)]),
        ([1, 0, 0, 1, 1], [(0.0, 4.0)]),
        ([0, 0, 1, 0, 0], [(0.0, 2.0), (2.0, 5.0)]),
        ([0, 0, 0, 0, 0], [(0.0, 5.0)]),
    ):
        assert _missing(x, np.array(known, bool)) == missing
    twice = np.array([0.0, 1.0, 1.0, 2.0])  # a reversal has two values in one place
    assert _missing(twice, np.array([True, True, False, True])) == [(1.0, 2.0)]
    assert _missing(np.array([1.0, 1.0]), np.array([True, False])) == []
    assert _missing(np.array([NAN, NAN]), np.array([False, False])) == []


def test_a_cycle_is_closed_by_its_start_a_turn_on() -> None:
    series = {"a": np.arange(4.0)}
    for way, end in ((1.0, 370.0), (-1.0, -350.0)):
        x, curves = _closed_cycle(10 + way * np.array([0.0, 90.0, 180.0, 270.0]), series)
        assert x[-1] == end
        assert curves["a"].tolist() == [0, 1, 2, 3, 0]
    open_, same = _closed_cycle(np.array([0.0, 10.0, 20.0, 30.0]), series)
    assert len(open_) == 4
    assert same is series


def test_scales_are_round_and_have_the_unit_of_the_reader() -> None:
    assert [round_up(v, FINE) for v in (1.0, 1.01, 1.26, 2.51, 3.01, 6.01, 8.01)] == [
        1,
        1.25,
        1.5,
        3,
        4,
        8,
        10,
    ]
    assert round_up(2 * (1 + 0.9e-12)) == 2.0
    assert round_up(2 * (1 + 2e-12)) == 2.5
    assert round_up(1000 * (1 - 1e-13)) == 1000.0
    assert force_scale([3.0, 72.0, NAN, INF, 1.0], 36.0) == 2.0
    assert force_scale([73.0], 36.0) == 2.5
    assert force_scale([73.0], 36.0, 4.4482216) == pytest.approx(0.5 * 4.4482216)
    assert force_scale([0.36], 36.0) == 0.01
    assert force_scale([0.0, NAN], 36.0, 3.0) == 3.0
    assert fit_frame([(3.0, 10.0), (5.6, 11.0)], 100.0, 75.0) == PaperFrame(0.03, (4.3, 10.5))
    assert fit_frame([(10.0, 3.0), (11.0, 5.6)], 100.0, 75.0) == PaperFrame(0.04, (10.5, 4.3))
    assert force_scale([], 36.0, 3.0) == 3.0


def act(of: str, x: float, y: float, kind: Any = "joint", at: tuple[float, float] = (0.0, 0.0)) -> Action:
    return Action(of, kind, "", "rod", None, np.array([at]), np.array([[x, y]]), np.zeros(1))


def test_forces_below_a_billionth_of_the_largest_are_none_and_joints_come_last() -> None:
    some = (act("A", 3, 4), act("F", 0, 6e-9, "force"), act("B", 0, -4e-9), act("W", 0, -5.1e-9, "weight"))
    assert [a.of for a in forces_of(some, "rod", 0)] == ["F", "W", "A"]
    assert forces_of(some, "arm", 0) == []
    assert forces_of((), "rod", 0) == []
    assert _gap_text(0.5, [act("A", 3, 4), act("B", -6, -8)], 0) == "closure gap 5e-02 of the largest force"
    assert _gap_text(0.0, [], 0) == "none drawn"


def test_a_polygon_runs_head_to_tail_and_shows_a_gap_from_a_tenth_of_a_millimetre_on() -> None:
    units = Figures(None, Notation())
    for off, gap in ((0.0, False), (0.19, False), (0.21, True), (-0.19, False), (-0.21, True)):
        canvas = Canvas()
        forces = [act("A", 30, 0), act("B", 0, 40), act("C", -30 + off, -40)]
        edges, size = draw_polygon(canvas, forces, 0, units, 2.0, (5.0, 5.0))
        assert edges["A"] == ((5.0, 5.0), (20.0, 5.0))
        assert edges["B"] == ((20.0, 5.0), (20.0, 25.0))
        assert size == pytest.approx(abs(off))
        arrows = [i for i in canvas.items if isinstance(i, Arrow)]
        assert len(arrows) == 3 + gap
        assert not gap or arrows[-1].head == (5.0, 5.0)
    skipped = Canvas()
    draw_polygon(skipped, [act("A", 30, 0), act("B", -30, 0)], 0, units, 2.0, (0.0, 0.0), "A")
    assert [i.head for i in skipped.items if isinstance(i, Arrow)] == [(0.0, 0.0)]
    assert _middle([], 0, 2.0, (5.0, 6.0)) == (5.0, 6.0)
    assert _middle([act("A", 30, 0), act("B", 0, 40)], 0, 2.0, (5.0, 5.0)) == (20.0, 15.0)


def test_the_arm_of_a_couple_is_the_distance_of_its_lines() -> None:
    for sign in (1.0, -1.0):
        two = [act("A", 3 * sign, 4 * sign), act("B", -3 * sign, -4 * sign, at=(5.0, 0.0))]
        assert arm_of_couple(two, 0) == pytest.approx(4.0)
    assert arm_of_couple([act("A", 0, 0), act("B", 0, 0, at=(5.0, 0.0))], 0) == 0.0


SPAN = (0.0, 10.0, 100.0, 60.0)


@pytest.mark.parametrize(
    ("at", "inside"),
    [
        *(((-5.0, 30.0), True), ((-5.1, 30.0), False), ((105.0, 30.0), True), ((105.1, 30.0), False)),
        *(((50.0, 5.0), True), ((50.0, 4.9), False), ((50.0, 65.0), True), ((50.0, 65.1), False)),
    ],
)
def test_a_point_is_inside_a_drawing_with_some_room_around(at: tuple[float, float], inside: bool) -> None:
    assert _inside(at, SPAN, 5.0) is inside


def test_a_line_of_action_reaches_a_little_beyond_the_drawing() -> None:
    """45 mm both ways, shortened in steps of 2 mm until it ends within 14 mm of the drawing, or has 8 mm and less."""
    assert _through((50.0, 35.0), np.array([3.0, 0.0]), SPAN) == ((95.0, 35.0), (5.0, 35.0))
    a, b = _through((90.0, 35.0), np.array([7.0, 0.0]), SPAN)
    assert (a, b) == ((113.0, 35.0), (45.0, 35.0))
    a, b = _through((50.0, 35.0), np.array([0.0, -2.0]), SPAN)
    assert (a, b) == ((50.0, -4.0), (50.0, 74.0))
    far = _through((500.0, 35.0), np.array([1.0, 0.0]), SPAN)
    assert far == ((507.0, 35.0), (493.0, 35.0))


def test_lines_that_meet_in_pairs_are_joined_as_far_as_the_drawing_reaches() -> None:
    names = ["A", "B", "C", "D"]
    for q, far in (((90.0, 40.0), "Q"), ((150.0, 40.0), "Q"), ((151.0, 40.0), "Q (beyond the drawing)")):
        canvas = Canvas()
        (note,) = _two_meetings(canvas, (10.0, 20.0), q, SPAN, names)
        assert note == f"A, B meet in P, C, D in {far}; PQ carries both resultants."
        (line,) = [i for i in canvas.items if getattr(i, "role", "") == "resultant"]
        length = math.dist(*line.points)  # type: ignore[union-attr]
        whole = math.dist((10.0, 20.0), q)
        assert length == pytest.approx(whole if far == "Q" else 40.0)
    canvas = Canvas()
    (note,) = _two_meetings(canvas, (300.0, 20.0), (330.0, 20.0), SPAN, names)
    assert "P (beyond the drawing), C, D in Q (beyond the drawing)" in note
    assert not canvas.items
    near = Canvas()
    _two_meetings(near, (145.0, 20.0), (155.0, 20.0), SPAN, names)
    (line,) = [i for i in near.items if getattr(i, "role", "") == "resultant"]
    assert math.dist(*line.points) == pytest.approx(10.0)  # type: ignore[union-attr]


def test_a_chord_ends_at_the_window_of_a_detail() -> None:
    for at, foot in (((0.0, 0.0), 0.0), ((3.0, 0.0), 3.0), ((0.0, 4.0), 0.0), ((-3.0, 4.0), -3.0)):
        canvas = Canvas()
        chord(canvas, at, np.array([1.0, 0.0]), "faint")
        (line,) = canvas.items
        half = math.sqrt(WINDOW**2 - at[1] ** 2)
        assert line.points == pytest.approx(
            np.array([(at[0] - foot - half, at[1]), (at[0] - foot + half, at[1])])
        )  # type: ignore[union-attr]
    for at, e in (((0.0, 0.0), (0.0, 0.0)), ((NAN, 0.0), (1.0, 0.0)), ((0.0, 0.0), (NAN, 1.0))):
        canvas = Canvas()
        chord(canvas, at, np.array(e), "faint")
        assert not canvas.items
    beyond = Canvas()
    chord(beyond, (0.0, 10 * WINDOW), np.array([1.0, 0.0]), "faint")
    assert beyond.items[0].points == ((-1.0, 10 * WINDOW), (1.0, 10 * WINDOW))  # type: ignore[union-attr]


def test_circles_about_a_pole_are_cut_at_a_window() -> None:
    whole = _ring(5.0, (-6.0, -6.0, 6.0, 6.0))
    assert len(whole) == 1
    assert whole[0][0] == pytest.approx(whole[0][-1])
    (half,) = _ring(5.0, (-6.0, 0.0, 6.0, 6.0))
    assert min(p[1] for p in half) >= 0.0
    assert max(p[1] for p in half) == pytest.approx(5.0)
    (right,) = _ring(5.0, (0.0, -6.0, 6.0, 6.0))  # across the start of the circle: one piece
    assert [right[0][1], right[-1][1]] == pytest.approx([-5.0, 5.0], abs=0.3)
    frame = PaperFrame(0.5, (1.0, 2.0))
    assert frame((2.0, 1.0)) == (2.0, -2.0)
    assert frame.line(np.array([[2.0, 1.0]])) == ((2.0, -2.0),)


def listed(position: list[float], speed: float, reverses: list[bool], time: Any = None) -> Any:
    """A result whose series are the numbers of its positions, just before and just after."""
    count = len(position)
    schedule = SimpleNamespace(time=time)
    before = SimpleNamespace(values=np.arange(count, dtype=float))
    after = SimpleNamespace(values=np.arange(count) + 0.5)
    return SimpleNamespace(
        drives=("O",), status=("ok",) * count, schedule=schedule, reverses=reverses, before=before, after=after,
        drive_position=lambda name: np.array(position), drive_speed=lambda name: np.full(count, speed),
    )  # fmt: skip


def test_a_reversal_has_both_values_in_the_order_of_the_list() -> None:
    """Against the motion what is just after comes first; with a time the list is in its order."""
    for position, speed, time, back in (
        ([0.0, 1.0, 2.0], 3.0, None, False), ([0.0, 1.0, 2.0], -3.0, None, True), ([2.0, 1.0, 0.0], 3.0, None, True),
        ([2.0, 1.0, 0.0], -3.0, None, False), ([0.0, 1.0, 2.0], -3.0, np.arange(3.0), False),
        ([0.0, 1.0, 2.0], 0.0, None, False),
    ):  # fmt: skip
        r = listed(position, speed, [False, True, True], time)
        assert _backwards(r).tolist() == [back] * 3
        both = [0, 1.5, 1, 2.5, 2] if back else [0, 1, 1.5, 2, 2.5]
        assert stepped_series(r, lambda side: side.values).tolist() == both
    single = listed([1.0], -3.0, [True])
    assert _backwards(single).tolist() == [False]
    r = listed([0.0, 1.0], 3.0, [True, True])
    r.after = None
    assert stepped_series(r, lambda side: side.values).tolist() == [0, 1]
    r.drives = ()
    assert _backwards(r).tolist() == [False, False]
