"""How messages quote values and propose names, and how numbers are tidied."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.model.files.json_text import read
from dalembert.model.library import bevel_differential, scissor, toggle_press
from dalembert.printing import round_components, wrap
from dalembert.wording import nearest, quote_value


def test_values_are_quoted_short() -> None:
    assert quote_value("x" * 100) == "'" + "x" * 56 + "..."
    assert quote_value("x" * 58) == "'" + "x" * 58 + "'"
    for digits in (16, 17, 21, 31, 401, 5001):
        for value in (10 ** (digits - 1) + 1, 10**digits - 1):
            assert quote_value(value) == quote_value(-value) == f"a number of {digits} digits"
    assert [quote_value(v) for v in (10**15, -3, 2.5, True, None, [], [1], {})] == [
        "1000000000000000", "-3", "2.5", "true", "nothing", "an empty list", "a list", "a mapping",
    ]  # fmt: skip


def test_of_names_that_differ_in_case_the_first_is_meant() -> None:
    assert nearest("rOd", ["Rod", "ROD"]) == "Rod"
    assert nearest("rOd", ["ROD", "Rod"]) == "ROD"


def test_what_is_nothing_beside_the_largest_is_zero() -> None:
    assert round_components([-3.0, 1e-13, -1e-13]) == [-3.0, 0.0, 0.0]
    assert round_components([3.0, 1e-11]) == [3.0, 1e-11]
    assert round_components([1e-13], beside=1.0) == [0.0]
    assert round_components([float("inf"), 1e-13])[1] == 1e-13
    assert str(round_components([-1e-13, 1.0])[0]) == "0.0"


def test_sentences_break_between_words_only() -> None:
    words = ["a slider-crank", "four-bar", "x" * 90, *["one-degree-of-freedom linkage"] * 6]
    lines = wrap(" ".join(words), "  ").split("\n")
    assert " ".join(line.removeprefix("  ") for line in lines) == " ".join(words)
    assert [len(line) for line in lines if len(line) > 80] == [92]
    assert not lines[0].startswith(" ")
    assert all(line.startswith("  ") for line in lines[1:])
    for line, after in pairwise(lines):
        assert len(line) + 1 + len(after.split()[0]) > 80


def four_bar(change: dict[str, Any]) -> da.Mechanism:
    return da.mechanism(da.four_bar().to_tree() | change)


@pytest.mark.parametrize(
    ("made", "said"),
    [
        (lambda: toggle_press(rod=-0.1), "toggle_press: rod is -0.1"),
        (lambda: scissor(drive="lift"), 'scissor: drive is \'lift\'; it is "slide" (the roller) or "turn"'),
        (
            lambda: four_bar({"loads": {"F": {"type": "force", "on": "rocker", "at": "B", "value": 3.0}}}),
            "a single value needs a direction; write direction: 30 deg, or value: [x, y]",
        ),
        *(
            (
                lambda r=r: four_bar({"drives": {"O2": {"position": "unknown", "range": r, "effort": 0}}}),
                "a range is two increasing positions; write range: [0 deg, 180 deg]",
            )
            for r in ([10, 5], [1, 2, 3], [7, 7])
        ),
    ],
)
def test_what_is_wrong_is_said_before_what_would_be_right(made: Any, said: str) -> None:
    with pytest.raises(da.ModelError) as error:
        made()
    assert said in str(error.value)


def test_whole_numbers_of_many_digits_in_json() -> None:
    """As a double from nineteen digits on, which no integer of 64 bits is sure to hold."""
    found = read('{"a": 123456789012345678, "b": 1234567890123456789, "c": -3}')
    assert [type(v) for v in found.values()] == [int, float, int]


def test_a_scissor_lift_says_its_stages() -> None:
    assert [scissor(k).title for k in (1, 2)] == [
        "Scissor lift of 1 stage",
        "Scissor lift of 2 stages",
    ]


def test_gravity_is_written_as_it_was_read() -> None:
    m = four_bar({"gravity": [0, -1.62]})
    assert da.mechanism(m.to_tree()).gravity == m.gravity == (0.0, -1.62)


def test_both_drives_of_a_differential_keep_their_times() -> None:
    """A sweep that begins elsewhere than at 0 is gone through in the time of the other."""
    m = bevel_differential(speed=20.0, sweep=(0.5, 2.5), second_sweep=(1.0, 4.0), positions=5)
    schedule = m.schedule()
    first, second = (np.ptp(schedule.position[:, k]) / schedule.speed[0, k] for k in (0, 1))
    assert first == pytest.approx(second)
    assert schedule.speed[0, 0] == pytest.approx(20.0)
