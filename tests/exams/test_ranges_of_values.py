"""Ranges of values to draw: where they begin and end, their steps in other units, and how many there may be."""

from __future__ import annotations

import re

import pytest

import dalembert as da
from dalembert.exams.choices import read_choices


def drawn(stated: object) -> list[str]:
    return [str(v) for v in read_choices({"x": stated})[0].values]


@pytest.mark.parametrize(
    ("stated", "values"),
    [
        ("42..60 mm step 5 mm", "42 mm, 47 mm, 52 mm, 57 mm"),  # with a step from its beginning
        ("42..57 mm step 5", "42 mm, 47 mm, 52 mm, 57 mm"),
        ("0.13..0.21", "0.14, 0.16, 0.18, 0.2"),  # without one in round numbers
        ("7..47 N", "10 N, 20 N, 30 N, 40 N"),
        ("7..46.9 N", "10 N, 15 N, 20 N, 25 N, 30 N, 35 N, 40 N, 45 N"),
        ("3..23", "5, 10, 15, 20"),
        ("3..22", "4, 6, 8, 10, 12, 14, 16, 18, 20, 22"),
        ("3..10.9", "3, 4, 5, 6, 7, 8, 9, 10"),
        ("3..11", "4, 6, 8, 10"),
        ("2..6", "2, 3, 4, 5, 6"),
        ("2..5.9", "2, 2.5, 3, 3.5, 4, 4.5, 5, 5.5"),
        ("-500..1500 N", "-500 N, 0 N, 500 N, 1000 N, 1500 N"),
        ("\u22123..-1 deg step 1", "-3 deg, -2 deg, -1 deg"),
        ("1 m..2 step 50 cm", "1 m, 1.5 m, 2 m"),
        ("100..400 mm step 0.1 m", "100 mm, 200 mm, 300 mm, 400 mm"),
        ("1..2 ft step 6 in", "1 ft, 1.5 ft, 2 ft"),
        ("1..3 in step 25.4 mm", "1 in, 2 in, 3 in"),
        ("0..15 deg step 0.1 rad", "0 deg, 5.72957795131 deg, 11.45915590262 deg"),
        ("1..1.3 kN step 100 N", "1 kN, 1.1 kN, 1.2 kN, 1.3 kN"),
        ("4 N..6 N step 1 N", "4 N, 5 N, 6 N"),
        ("1e3..3e3 step 1e3", "1000, 2000, 3000"),
    ],
)  # fmt: skip
def test_a_range_goes_in_its_steps_or_in_the_largest_round_ones_of_which_it_has_four(
    stated: str, values: str
) -> None:
    assert drawn(stated) == values.split(", ")


def test_ten_thousand_values_may_be_drawn_and_no_more() -> None:
    assert drawn("1..10000 step 1")[-1] == "10000"
    assert len(drawn(list(range(10_000)))) == 10_000
    for more in ("0..10000 step 1", list(range(10_001))):
        said = "--vary x: 10001 values are more than 10000; take a larger step"
        with pytest.raises(da.ModelError, match=f"^{re.escape(said)}$"):
            drawn(more)


FORMS = "write PATH=40..60 mm step 5 mm, or PATH=[400 N, 500 N, 600 N]"


@pytest.mark.parametrize(
    ("stated", "said"),
    [
        ("5..5 mm", "--vary x: the range does not increase from 5 to 5; " + FORMS),
        ("5..6 mm step 3 mm", "--vary x: there is one value only, and nothing to draw; " + FORMS),
        ([3, 3, "3"], "--vary x: there is one value only, and nothing to draw; " + FORMS),
        ("5..6 m step 1 kg", "--vary x: the step is in kg, the range in m; write one unit"),
        ("5 m..6 N", "--vary x: the range begins in m and ends in N; write one unit"),
        ("5..6 m step -0.5", "--vary x: the step -0.5 is not positive; " + FORMS),
        (7, "--vary x: 7 is neither a range nor a list; " + FORMS),
    ],
)
def test_what_is_no_range_is_refused_in_these_words(stated: object, said: str) -> None:
    with pytest.raises(da.ModelError, match=f"^{re.escape(said)}$"):
        drawn(stated)


def test_each_path_has_its_own_values_in_the_order_given() -> None:
    some = read_choices({"b": "1..2 step 1", "a": (7, 9), "c": "[2 N, 3]"})
    assert [(c.path, c.values) for c in some] == [("b", ("1", "2")), ("a", (7, 9)), ("c", ("2 N", "3"))]
    with pytest.raises(da.ModelError, match=r"^--vary a: there is one value only"):
        read_choices({"b": "1..2 step 1", "a": [7]})
