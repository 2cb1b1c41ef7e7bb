"""Positions of an answer by their number, by the value of a drive, and by an extreme of a quantity."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.result import position_lookup
from dalembert.errors import ModelError

NAN = math.nan


@pytest.mark.parametrize(
    ("values", "wanted", "turns", "place", "near"),
    [
        ([0.0, 1.0, 2.0], 1.4, True, 1, True),
        ([0.0, 1.0, 2.0], 1.6, True, 2, True),
        ([0.0, 1.0, 2.0], 2.5, False, 2, True),
        ([0.0, 1.0, 2.0], 2.6, False, 2, False),
        ([0.0, 1.0, 2.0], 2.6, True, 2, False),
        ([0.0, 2.0, 4.0], 0.5 + 2 * math.pi, True, 0, True),
        ([0.0, 2.0, 4.0], 0.5 + 2 * math.pi, False, 2, False),
        ([0.0, 2.0, 4.0], 4.5 - 2 * math.pi, True, 2, True),
        (np.arange(8) * math.pi / 2, math.pi / 2 + 2 * math.pi, True, 5, True),
        (np.arange(8) * math.pi / 2, math.pi / 2 + 4 * math.pi, True, 1, True),
        ([3.0], 3.0 + 9e-7, False, 0, True),
        ([3.0], 3.0 + 2e-6, False, 0, False),
        ([0.0, NAN, 2.0], 2.1, False, 2, False),
    ],
)
def test_a_position_is_the_nearest_to_a_value_within_half_a_step(
    values: Any, wanted: float, turns: bool, place: int, near: bool
) -> None:
    assert position_lookup._nearest(np.array(values), wanted, turns) == (place, near)


@pytest.mark.parametrize(
    ("text", "word", "of", "value", "place"),
    [
        ("max effort.O", "max", "effort.O", 4.0, 1),
        ("greatest effort.O", "greatest", "effort.O", 4.0, 1),
        ("min effort.O", "min", "effort.O", -9.0, 2),
        ("least effort.O", "least", "effort.O", -9.0, 2),
        ("peak effort.O", "peak", "effort.O", 9.0, 2),
        ("max |effort.O|", "max", "|effort.O|", 9.0, 2),
        ("  min  | effort.O | ", "min", "| effort.O |", 3.0, 0),
        ("max (effort.O)", "max", "effort.O", 4.0, 1),
        ("min 2*effort.O", "min", "2*effort.O", -18.0, 2),
    ],
)
def test_an_extreme_is_named_by_a_word_and_a_quantity(
    text: str, word: str, of: str, value: float, place: int
) -> None:
    r = effort_of([3.0, 4.0, -9.0])
    found = position_lookup.extreme(r, text)
    assert found is not None
    assert (found.word, found.of, found.position) == (word, of, place)
    assert found.value == pytest.approx(value, rel=1e-12)
    assert position_lookup.position_at(r, text) == place


def effort_of(torques: list[float]) -> da.Result:
    """A crank that a couple of these values, one a position, is held against."""
    couple = {
        "type": "couple",
        "on": "crank",
        "value": {"against": "O", "x": [1.0, 2.0, 3.0], "y": [-t for t in torques]},
    }
    tree = {
        "links": {"ground": {"points": {"O": [0, 0]}}, "crank": {"points": {"O": [0, 0]}}},
        "joints": {"O": {"type": "pin", "links": ["ground", "crank"]}},
        "drives": {"O": {"position": [1.0, 2.0, 3.0]}},
        "loads": {"T": couple},
        "units": {"angle": "rad"},
    }
    return da.statics(da.mechanism(tree))


def test_a_position_by_no_word_is_by_its_number_or_its_drive() -> None:
    r = effort_of([3.0, 4.0, -9.0])
    for at, place in ((None, 0), (1, 0), (3, 2), (" 2 ", 1), ("2 rad", 1), (2.4, 1)):
        assert position_lookup.position_at(r, at) == place
    assert position_lookup.extreme(r, "maximum effort.O") is None
    for at, sentence in (
        (0, "position 0 does not exist; this result has 3 positions, numbered from 1"),
        ("4", "position 4 does not exist; this result has 3 positions, numbered from 1"),
        (
            "5 rad",
            "no position has O = 5 rad; the nearest is 3 rad; give the drive that position, or more positions",
        ),
    ):
        with pytest.raises(ModelError) as raised:
            position_lookup.position_at(r, at)
        assert str(raised.value) == sentence
    said = position_lookup.position_sentence
    assert said(r, 1) == "Position 2 of 3, O = 2 rad."
    assert said(r, 2, "peak effort.O") == (
        "Position 3 of 3, O = 3 rad: effort.O is largest in magnitude here, 9 N*m."
    )
