"""Two mistakes at once: pairs of changes whose sum is what is wrong in a sheet, made of numbers alone."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.grading.figure import figure_of_key
from dalembert.grading.two_mistakes import two_mistakes
from dalembert.grading.wrong.wrong_problems import WrongProblem

RIGHT = [100.0, -200.0, 300.0, 0.5]
A, B, C = [20.0, 30.0, 0.0, 4.0], [-5.0, 60.0, 90.0, 1.0], [-40.0, 10.0, 30.0, 7.0]
NOTHING = [0.0] * 4


def rows(*parts: list[float]) -> list[float]:
    return [float(x) for x in np.sum(parts, axis=0)]


def times(factor: float, part: list[float]) -> list[float]:
    return [factor * x for x in part]


def found(changes: dict[str, Any], off: list[float], independent: int = 3, **keys: Any) -> Any:
    """The pair that explains a sheet which is off by so much, of mistakes that change its figures by so much."""
    figures = []
    for n, (right, change) in enumerate(zip(RIGHT, off, strict=True)):
        of = {"quantity": "effort", "of": f"D{n}"} | (keys if n == 0 else {})
        given = da.Answer(**of, value=f"{right + change:.9g} N*m")
        figures.append(figure_of_key(given, da.Answer(**of, value=f"{right} N*m")))

    def values(problem: WrongProblem, n: int) -> tuple[Any, ...]:
        change = changes[problem.sentence]
        return () if change is None else (np.array(RIGHT[n] + change[n]),)

    problems = [WrongProblem(1, name, lambda: None) for name in changes]
    wrong = [n for n, f in enumerate(figures) if not f.met]
    return two_mistakes(figures, wrong, problems, values, independent)


PAIRS: dict[str, tuple[dict[str, Any], list[float], str]] = {
    "the only two": ({"a": A, "b": B}, rows(A, B), "a, and b"),
    "the first and the last": ({"a": A, "c": C, "n": NOTHING, "b": B}, rows(A, B), "a, and b"),
    "the last two": ({"c": C, "n": NOTHING, "a": A, "b": B}, rows(A, B), "a, and b"),
    "two others": ({"a": A, "b": B, "c": C}, rows(B, C), "b, and c"),
    "each in the other sense": (
        {"a": times(-1, A), "b": times(-1, B)},
        rows(times(-1, A), times(-1, B)),
        "a, and b",
    ),
    "none at all": ({}, rows(A, B), ""),
    "one alone": ({"a": A, "b": B}, A, ""),
    "one of a single one": ({"a": A}, A, ""),
    "one twice": ({"a": A}, rows(A, A), ""),
    "one beside what changes nothing": ({"a": A, "n": NOTHING}, A, ""),
    "what changes nothing beside one": ({"n": NOTHING, "a": A}, A, ""),
    "the same one by another factor": ({"a": A, "half": times(0.5, A)}, times(1.5, A), ""),
    "the same one the other way": ({"a": A, "half": times(-0.5, A)}, times(0.5, A), ""),
    "nearly": ({"a": A, "b": B}, rows(A, times(1.003, B)), "a, and b"),
    "not near enough": ({"a": A, "b": B}, rows(A, times(1.02, B)), ""),
    "all but one figure": ({"a": A, "b": B}, [15.0, 90.0, 90.0, -5.0], ""),
    "two pairs of the same sum": (
        {"a": A, "b": B, "c": C, "d": rows(A, B, times(-1, C))},
        rows(A, B),
        "a, and b; or c, and d",
    ),
    "two pairs that its digits do not tell apart": (
        {"a": A, "b": B, "c": C, "d": rows(times(1.003, A), times(1.003, B), times(-1, C))},
        rows(A, B),
        "a, and b; or c, and d",
    ),
    "two pairs that differ in a figure": (
        {"a": A, "b": B, "c": C, "d": rows(A, B, [0.0, 0.0, 1.5, 0.0], times(-1, C))},
        rows(A, B),
        "",
    ),
    "three pairs of the same sum": (
        {"a": A, "b": B, "c": C, "d": rows(A, B, times(-1, C)), "e": times(3, C), "f": rows(A, B, times(-3, C))},
        rows(A, B),
        "",
    ),
    "beside one without an answer": ({"a": A, "x": None, "b": B}, rows(A, B), "a, and b"),
    "beside one without a number": (
        {"a": A, "x": [math.nan, 1, 1, 1], "y": [1, 1, 1, math.inf], "b": B},
        rows(A, B),
        "a, and b",
    ),
    "a right figure stays": (
        {"a": [20.0, 0.0, 5.0, 4.0], "b": [-5.0, 0.5, 90.0, 1.0]},
        [15.0, 0.0, 95.0, 5.0],
        "a, and b",
    ),
    "a right figure would be moved": (
        {"a": [20.0, 0.0, 5.0, 4.0], "b": [-5.0, 3.0, 90.0, 1.0]},
        [15.0, 0.0, 95.0, 5.0],
        "",
    ),
    "a figure of zero": (
        {"a": [-120.0, 30.0, 0.0, 4.0], "b": [20.0, 60.0, 90.0, 1.0]},
        [-100.0, 90.0, 90.0, 5.0],
        "a, and b",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", PAIRS)
def test_a_pair_is_named_where_it_alone_gives_every_figure(name: str) -> None:
    changes, off, said = PAIRS[name]
    pair = found(changes, off)
    assert (pair.sentence, pair.weight) == (said, "concept") if said else pair is None


def test_a_sheet_with_few_numbers_or_with_a_size_has_no_pairs() -> None:
    changes = {"a": A, "b": B}
    assert found(changes, rows(A, B), independent=2) is None
    assert found(changes, rows(A, B), component="magnitude") is None
    assert found(changes, rows(A, B)) is not None


def test_every_pair_that_is_tried_may_be_a_coincidence() -> None:
    """Of n mistakes with a number there are n (n - 1) / 2 pairs."""
    two = found({"a": A, "b": B}, rows(A, B)).chance
    more = {"a": A, "b": B, "c": C, "n": NOTHING, "x": None, "y": [math.nan, 1, 1, 1]}
    assert found(more, rows(A, B)).chance == pytest.approx(6 * two, rel=1e-12)
