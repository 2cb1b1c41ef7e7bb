"""The slips that a student's figure is compared with, each by its definition; and how near two angles are."""

from __future__ import annotations

from math import cos, pi, radians, sin, sqrt
from typing import Any

import numpy as np
import pytest

from dalembert.grading.explanation import explain
from dalembert.grading.figure import figure_of_key
from dalembert.grading.file_answers import computed_text
from dalembert.grading.quantities import Series
from dalembert.grading.tolerance import Closeness, Target
from dalembert.grading.value_errors import of_units, of_value
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
