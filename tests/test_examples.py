"""Every bundled example loads, is solved in every position, and gives the answers found by hand."""

from __future__ import annotations

import inspect
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis import solve
from dalembert.bundled import examples
from dalembert.grading.file_answers import check_file
from dalembert.model import load
from tests.examples_by_hand import EXAMPLES

NAMES = list(examples())


def test_every_example_by_hand_is_there() -> None:
    assert EXAMPLES.keys() <= set(NAMES)


def test_every_public_name_has_an_example_in_its_docstring() -> None:
    """All functions and classes; pytest runs the examples."""
    public = [(name, getattr(da, name)) for name in da.__all__]
    asked = [(name, value) for name, value in public if callable(value)]
    assert len(asked) > 150
    assert [name for name, value in asked if ">>> " not in (inspect.getdoc(value) or "")] == []


@pytest.mark.parametrize("name", NAMES)
def test_every_position_is_solved(name: str) -> None:
    r = solve(load(examples()[name]))
    assert set(r.status) == {"ok"}
    assert np.max(r.residual) < 1e-12
    assert np.max(r.power_balance) < 1e-12
    assert r.mobility is not None
    assert r.mobility.redundant == 0


@pytest.mark.parametrize("name", NAMES)
def test_answers_hold(name: str) -> None:
    for row in check_file(examples()[name]):
        assert row.ok, row


@pytest.mark.parametrize("name", list(EXAMPLES))
def test_answers_are_those_of_the_formulas(name: str) -> None:
    answers = load(examples()[name]).answers
    by_hand = EXAMPLES[name]()
    assert len(answers) == len(by_hand)
    for answer, value in zip(answers, by_hand, strict=True):
        assert answer.why, "says how it was found"
        expected = value if isinstance(value, str) else pytest.approx(value, rel=1e-10, abs=1e-8)
        assert plain(answer.value) == expected, answer


def plain(value: Any) -> Any:
    """The number of a text with its unit; a word stays a word."""
    if isinstance(value, str) and value[:1] in "-0123456789":
        return float(value.split()[0])
    return list(value) if isinstance(value, tuple) else value


@pytest.mark.parametrize("name", EXAMPLES)
def test_header_says_what_one_learns(name: str) -> None:
    assert "# What one learns here: " in examples()[name].read_text(encoding="utf-8")
