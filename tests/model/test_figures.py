"""Numbers as a person writes them, and what is said of wrong ones: exact values, exact words."""

from __future__ import annotations

import math
from typing import Any

import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.model import loads
from dalembert.model.quantities.expression_trees import NumberNode, expression_text
from dalembert.model.quantities.figures import (
    plain,
    plain_vector,
    polar_text,
    polar_units,
    quantity_fails,
    shortest,
    unit_vector,
    with_kept_unit,
    without_fraction,
)
from dalembert.unit_names import unit
from dalembert.units import Units
from tests.model.parts import FOUR_BAR

INCH = Units(length="in", force="lbf")


@pytest.mark.parametrize("turns", [*range(-40, 41), 1000, -1001])
def test_quarter_turns_have_exact_components(turns: int) -> None:
    """However many turns, either way; beside them nothing is moved."""
    exact = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[turns % 4]
    assert unit_vector(math.radians(90 * turns)) == exact
    assert unit_vector(turns * (math.pi / 2)) == exact
    near = turns * (math.pi / 2) + 1e-9
    assert unit_vector(near) == (math.cos(near), math.sin(near)) != exact


def test_a_vector_is_polar_where_that_is_short_and_its_components_are_not() -> None:
    polar = tuple(3.0 * c for c in unit_vector(math.radians(30)))
    assert plain_vector(polar, "length", Units()) == "3 @ 30"
    assert plain_vector((0.5, -2.0), "length", Units()) == [0.5, -2]
    noise = (1 / 3, 2 / 7)
    assert plain_vector(noise, "length", Units()) == [f"{x!r} m" for x in noise]
    assert plain_vector((0.0254, 0.0, 0.0127), "length", INCH) == [1, 0, 0.5]
    assert polar_text((0.0, -0.0508), "length", INCH) == "2 @ 270"
    assert polar_text((-0.0508, 0.0), "length", INCH, "mm", "rad") is not None


@pytest.mark.parametrize(
    ("number", "kind", "units", "written"),
    [
        (0.0254, "length", INCH, 1),
        (0.3, "length", INCH, "0.3 m"),
        (math.radians(30), "angle", Units(), 30),
        (1.0, "angle", Units(), "1 rad"),
        (25.0, "angular_speed", Units(), "25 rad/s"),
        (0.0, "angular_speed", Units(), 0),
        (50 * math.pi, "angular_speed", Units(), "1500 rpm"),
        (0.5, "number", INCH, 0.5),
        (math.inf, "length", Units(), "inf m"),
    ],
)
def test_numbers_are_bare_where_that_is_short(number: float, kind: str, units: Units, written: Any) -> None:
    assert plain(number, kind, units) == written
    assert type(plain(number, kind, units)) is type(written)


def test_whole_numbers_have_no_point() -> None:
    assert [repr(without_fraction(x)) for x in (2.0, -3.0, 0.0, -0.0, 0.5, 1e14, 1e15)] == [
        "2", "-3", "0", "-0.0", "0.5", "100000000000000", "1000000000000000.0",
    ]  # fmt: skip
    assert shortest(math.nan, unit("m")) is None


def test_the_units_of_a_text_stay() -> None:
    assert with_kept_unit(math.radians(75), "angle", "60deg", Units()) == "75deg"
    assert with_kept_unit(0.2, "length", " 100  mm", Units()) == " 200  mm"
    assert with_kept_unit(0.2, "length", "5 kg", Units()) is None
    assert with_kept_unit(0.2, "length", "a word", Units()) is None
    assert not quantity_fails("5 mm", "length", Units())
    assert quantity_fails("5 kg", "length", Units())
    assert polar_units("3 in @ 30 deg", "length", Units()) == ("in", "deg")
    assert polar_units("3 @ 30", "length", Units()) == ("", "")


def test_numbers_of_expressions_are_those_that_were_written() -> None:
    for value, written in (
        (2.0, "2"),
        (0.5, "0.5"),
        (0.1 + 0.2, "0.30000000000000004"),
        (1e-13, "1e-13"),
        (0.1, "0.1"),
    ):
        said = expression_text(NumberNode(value))
        assert float(said) == value
        assert said == written or value == 1e-13


def test_a_speed_that_was_zero_is_written_with_its_unit() -> None:
    """Bare it would not be read."""
    old = FOUR_BAR.replace("speed: 25 rad/s", "speed: 0")
    assert old != FOUR_BAR
    other = loads(old).with_values({"drives.O2.speed": math.pi / 2})
    assert str(other) == old.replace("speed: 0", "speed: 90 deg/s")
    assert loads(str(other)) == other
    added = loads(FOUR_BAR).with_values(
        {"links.crank.points": {"O2": [0, 0], "A": [0.127, 0], "X": [0.0254, 0.3]}}
    )
    assert "X: [1, 0.3 m]" in str(added)


def spring(between: Any) -> dict[str, Any]:
    return {"loads.T_4": {"type": "spring", "between": between, "stiffness": 1, "free_length": 1}}


ENDS = "write [ground.A, rod.B]"
EFFORT = {"quantity": "effort", "of": "O2", "value": 1}
REACTION = {"quantity": "reaction", "of": "A", "on": "cran", "value": [1, 2]}


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (
            {"links.crank.shape": {"type": "box", "size": [1, 2]}},
            "a list of 2 is given; 3 values are needed; ",
        ),
        (spring("crank.A"), f"expected two points, not 'crank.A'; {ENDS}"),
        (spring(["crank.A"]), f"expected two points, not a list; {ENDS}"),
        (spring({"a": "crank.A", "b": "x.y"}), f"expected two points, not a mapping; {ENDS}"),
        ({"answers": [EFFORT, REACTION]}, "answer 2 names the link 'cran', which does not exist"),
    ],
    ids=["size", "one end", "one end in a list", "a mapping", "an answer"],
)
def test_what_is_wrong_is_said_where_it_is(change: dict[str, Any], said: str) -> None:
    with pytest.raises(ModelError) as caught:
        loads(FOUR_BAR).with_values(change)
    assert said in str(caught.value)


def test_a_table_that_goes_back_is_named_at_its_number() -> None:
    with pytest.raises(ModelError) as caught:
        da.Table("O", (0.0, 2.0, 1.0, 3.0), (1.0, 2.0, 3.0, 4.0))
    assert caught.value.what == "x of a table does not increase from its item 2 to 3"
    assert caught.value.path == ("x", 2)
    with pytest.raises(ModelError) as caught:
        da.Table("O", (0.0, 1.0, 1.0), (1.0, 2.0, 3.0))
    assert caught.value.path == ("x", 2)
