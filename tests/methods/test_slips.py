"""The slips that a student's figure is compared with, each by its definition; and how near two angles are."""

from __future__ import annotations

from math import cos, exp, pi, radians, sin, sqrt
from typing import Any

import numpy as np
import pytest

from dalembert.grading.explanation import explain
from dalembert.grading.figure import StudentValue, figure_of_key
from dalembert.grading.file_answers import computed_text
from dalembert.grading.quantities import Series
from dalembert.grading.tolerance import Closeness, Target
from dalembert.grading.value_errors import of_units, of_value
from dalembert.grading.value_slips import alike, coincidence, distance, width
from dalembert.model import Answer
from dalembert.units import Units


def told(slips: Any) -> list[tuple[str, Any]]:
    return [(h.sentence, h.value) for h in slips]


def test_of_a_force_in_the_plane() -> None:
    degrees = 60.0  # of (1, sqrt 3), size 2
    expected = [
        ("the sense is opposite: action mistaken for reaction", [-1, -sqrt(3)]),
        ("the angle is counted from the other axis: x and y are exchanged", [sqrt(3), 1]),
        ("the angle is counted clockwise: y has the wrong sign", [1, -sqrt(3)]),
        ("x has the wrong sign", [-1, sqrt(3)]),
        ("x and y are exchanged, one with the wrong sign", [-sqrt(3), 1]),
        ("x and y are exchanged, one with the wrong sign", [sqrt(3), -1]),
        ("degrees are mistaken for radians in sine and cosine", [2 * cos(degrees), 2 * sin(degrees)]),
    ]
    found = told(of_value(Series("force", np.zeros(0)), np.array([1.0, sqrt(3)])))
    assert [text for text, _ in found] == [text for text, _ in expected]
    for (text, value), (_, number) in zip(found, expected, strict=True):
        assert value == pytest.approx(number, abs=1e-12), text


def test_of_a_vector_in_space() -> None:
    found = told(of_value(Series("speed", np.zeros(0)), np.array([1.0, 2.0, 3.0])))
    assert [(text, value.tolist()) for text, value in found] == [
        ("the sense is opposite", [-1, -2, -3]),
        ("x has the wrong sign", [-1, 2, 3]),
        ("y has the wrong sign", [1, -2, 3]),
        ("z has the wrong sign", [1, 2, -3]),
        ("x and y are exchanged", [2, 1, 3]),
        ("y and z are exchanged", [1, 3, 2]),
        ("x and z are exchanged", [3, 2, 1]),
        ("the axes are counted one on: x, y, z for z, x, y", [3, 1, 2]),
        ("the axes are counted one on: x, y, z for y, z, x", [2, 3, 1]),
    ]


def test_of_an_angle_and_of_a_number() -> None:
    found = told(of_value(Series("angle", np.zeros(0)), np.asarray(radians(30))))
    assert [(text, round(float(np.degrees(value)), 9)) for text, value in found] == [
        ("the sense is opposite: action mistaken for reaction", 210),
        ("the angle is counted from the other axis", 60),
        ("the angle is counted clockwise", -30),
        ("the angle is counted from the negative x axis", 150),
        ("the number is in radians, not degrees", round(30 * pi / 180, 9)),
        ("the number is in degrees, not radians", round(30 * 180 / pi, 9)),
    ]
    assert told(of_value(Series("length", np.zeros(0)), np.asarray(3.0))) == [("the sense is opposite", -3.0)]


@pytest.mark.parametrize(
    ("kind", "words", "factor"),
    [
        ("length", "inches and feet", 12),
        ("speed", "millimetres and inches", 25.4),
        ("mass", "a factor of 1000 (mm and m, N and kN)", 1000),
        ("moment", "centimetres and metres", 100),
        ("length", "millimetres and centimetres", 10),
        ("force", "pounds and newtons", 0.45359237 * 9.80665),
        ("force", "g: kilograms and newtons", 9.80665),
        ("force", "g in ft/s2: pounds and slugs", 9.80665 / 0.3048),
        ("moment", "g in in/s2: pounds and blobs", 9.80665 / 0.0254),
        ("angular_speed", "rpm and rad/s", 60 / (2 * pi)),
        ("angular_acceleration", "degrees and radians", 180 / pi),
        ("mass", "a factor of 2", 2),
    ],
)
def test_of_units(kind: str, words: str, factor: float) -> None:
    text = words if words.startswith("a factor") else f"units are mixed up: {words}"
    found = [
        h.value for h in of_units(Series(kind, np.zeros(0)), np.array([3.0, -1.0])) if h.sentence == text
    ]
    assert found[0] == pytest.approx([3 * factor, -factor], rel=2e-6)
    assert found[1] == pytest.approx([3 / factor, -1 / factor], rel=2e-6)


@pytest.mark.parametrize(
    ("a", "b"), [(0.1, 0.2), (0.2, 0.1), (pi - 0.03, -pi + 0.07), (-pi + 0.07, 7 * pi - 0.03)]
)
def test_angles_differ_whichever_is_larger_and_by_no_whole_turn(a: float, b: float) -> None:
    near = Closeness(np.asarray(a), "angle", 0.05, (), False)
    assert near.off(np.asarray(b)) == pytest.approx(0.1)
    assert not near.holds(np.asarray(b))
    assert Closeness(np.asarray(a), "angle", 0.11, (), False).holds(np.asarray(b))


def test_an_angle_in_tens_of_degrees_excuses_half_a_degree() -> None:
    """Its digits excuse as much where they are finer; a rounded angle lies on the edge."""
    for half, excused in ((5.0, 0.5), (0.05, 0.05)):
        figure = Closeness(np.asarray(1.0), "angle", 1e-6, (np.radians(half),), False)
        for side in (-1, 1):
            assert figure.holds(np.asarray(1.0 + side * np.radians(excused)))
            assert not figure.holds(np.asarray(1.0 + side * np.radians(1.01 * excused)))


def test_a_vector_of_which_a_part_is_not_known_has_no_text() -> None:
    published = Target(np.array([1.0, 2.0]), "N", False)
    assert computed_text(np.array([3.0, 4.0]), published, "force", Units()) == "[3, 4]"
    assert computed_text(np.array([3.0, np.nan]), published, "force", Units()) == "-"


@pytest.mark.parametrize(
    ("quantity", "right", "given", "said"),
    [
        ("reaction", ("100 N", "100.3 N"), ("100.28 N", "-100.02 N"), "x and y are exchanged, one with the"),
        ("reaction", ("100 N", "20 N"), ("-100 N", "20 N"), "x has the wrong sign"),
        ("effort", "100 N", "981 N", "units are mixed up: g: kilograms and newtons"),
        ("effort", "100 N*m", "1000 N*m", "units are mixed up: millimetres and centimetres"),
        ("effort", "-100 N*m", "1205 N*m", "none of the usual mistakes explains it"),
    ],
)
def test_of_the_slips_that_come_near_a_figure_the_nearest_is_said(
    quantity: str, right: Any, given: Any, said: str
) -> None:
    """Of x and y that differ by 3 in a thousand the other's place and sense are not those of its own."""
    of = {"quantity": quantity, "of": "A"}
    figure = figure_of_key(Answer(**of, value=given), Answer(**of, value=right))
    assert explain([figure], None)[0].sentence.startswith(said)


def compared(given: Any, right: Any, quantity: str = "effort", **more: Any) -> StudentValue:
    of = {"quantity": quantity, "of": "A"}
    return figure_of_key(Answer(**of, value=given, **more), Answer(**of, value=right))


@pytest.mark.parametrize(
    ("given", "value", "off"),
    [
        ("110.00 N", 110.55, 0.005),  # 9 % off the right 100 N: what is near explains it
        ("110.00 N", 109.46, 0.54 / 110),
        ("110.00 N", 110.56, None),
        ("-110.00 N", -110.44, 0.004),
        ("110 N", 110.49, 0.0),  # rounded
        ("102.00 N", 102.39, 0.39 / 102),  # 2 % off: what is five times nearer
        ("102.00 N", 102.41, None),
        ("102.00 N", 101.61, 0.39 / 102),
        ("102.00 N", 101.59, None),
        ("110.00 N", float("nan"), None),
    ],
)
def test_a_value_explains_a_figure_that_it_is_near_to(given: str, value: float, off: float | None) -> None:
    figure = compared(given, "100 N")
    found = distance(figure, [np.asarray(float("nan")), np.asarray(value), np.asarray(50.0)])
    assert found == (None if off is None else pytest.approx(off, abs=1e-12))


def test_of_several_values_the_nearest_one_counts() -> None:
    assert distance(compared("110.00 N", "100 N"), [np.asarray(x) for x in (110.5, 110.1, 109.6)]) == (
        pytest.approx(0.1 / 110)
    )


def test_the_room_of_a_figure_is_its_distance_its_last_digit_or_its_tolerance() -> None:
    for given, off, room in (
        ("110 N", 0.0, 0.5 / 110),
        ("-110 N", 0.0, 0.5 / 110),
        ("110 N", 0.02, 0.02),
        ("110.00000 N", 0.0, 2e-4),
        ("[30 N, -40.0 N]", 0.0, 0.5 / 50),
        ("50 N @ 30.0 deg", 0.0, 0.5 / 50),
        ("50.000 N @ 30.0 deg", 0.0, radians(0.05)),
        ("50.000 N @ 30 deg", 0.0, radians(0.5)),
        ("50.000 N @ 3e1 deg", 0.0, 0.01),
    ):
        vector = "@" in given or "[" in given
        value = tuple(given.strip("[]").split(", ")) if "[" in given else given
        figure = compared(value, ("1 N", "2 N") if vector else "100 N", "reaction" if vector else "effort")
        assert width(figure, off) == pytest.approx(room), given
    assert width(compared("110 N", "100 N", tolerance="3 %"), 0.0) == pytest.approx(0.03)
    assert width(compared("30 deg", "60 deg"), 0.0) == 0.005


@pytest.mark.parametrize(
    ("given", "right", "value", "chance"),
    [
        ("-110.0 N", "100 N", -110.0, 2 * (0.05 / 110) * (0.93 * exp(-24.5) + 0.075 / 3.1**2)),
        ("130.00 N", "-100 N", 130.0, 2 * 2e-4 * (0.93 * exp(-((2.3 / 0.3) ** 2) / 2) + 0.075 / 3.3**2)),
        ("70.00 N", "100 N", 70.0, 2 * 2e-4 * (0.93 * exp(-0.5) + 0.075 / 1.3**2)),
        ("5 N", "0 N", 5.0, 2 * 0.1 * 0.075 / 36),
        ("-40 deg", "40 deg", radians(-40), 0.01 * (0.93 * exp(-((0.1 / 0.3) ** 2) / 2) + 0.075 / 1.21)),
        (
            "-40 deg",
            "40 deg",
            radians(-70),
            0.01 * (0.93 * exp(-((pi / 1.8) ** 2) / 2) + 0.075 / (1 + pi / 6) ** 2),
        ),
        (
            "5 N",
            "4.9 N",
            5.0,
            2 * 0.1 * (0.93 * exp(-((0.1 / 4.9 / 0.3) ** 2) / 2) + 0.075 / (1 + 0.1 / 4.9) ** 2),
        ),
    ],
)
def test_a_coincidence_is_the_room_of_a_figure_times_the_frequency_of_wrong_numbers_there(
    given: str, right: str, value: float, chance: float
) -> None:
    """Small slips are frequent, by a bell curve of 0.3; gross ones are seldom, by their square."""
    assert coincidence(compared(given, right), np.asarray(value), 0.0) == pytest.approx(chance)
    assert coincidence(compared(given, right), np.asarray(value), 1e9) == 1.0


def test_values_are_alike_within_twice_the_room() -> None:
    figure = compared("110 N", "100 N")  # 0.5 N
    for other, alike_ones in ((101.0, True), (99.0, True), (101.01, False), (98.99, False)):
        assert alike(figure, np.asarray(100.0), np.asarray(other)) is alike_ones
    nothing = compared("0 N", "100 N")
    assert alike(nothing, np.asarray(100.0), np.asarray(100.00039))
    assert not alike(nothing, np.asarray(100.0), np.asarray(100.00041))
