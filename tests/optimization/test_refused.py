"""What an optimisation or a file of one refuses, word for word."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import dalembert as da
from dalembert.errors import DalembertError
from dalembert.optimization.aims import parse_aim
from dalembert.optimization.optimize_file import optimize_file
from tests.optimization.test_malformed_optimize import FILE

M = da.four_bar(positions=3)
BOX = {"links.rocker.points.B.0": (0.2, 0.28)}
FILES = {
    "no number varies; write vary: {stroke: [80 mm, 120 mm]}": ("vary", "vary: {}\n"),
    "where is 3; write a list: [transmission.B >= 33 deg]": ("where", "where: 3\n"),
    "condition 1 is 3; write one like transmission.B >= 33 deg": ("where", "where: [3]\n"),
}
AFTER = {"vary": "least", "where": "starts"}
REFUSED: dict[str, Callable[[], Any]] = {
    "'peak ' is not an aim; write one like peak effort.O2": lambda: parse_aim("peak "),
    "the bounds of 'links.rocker.points.B.0' go from 0.2 to inf; use (low, high, step) with low <= high and step > 0": (
        lambda: da.optimize(M, {"links.rocker.points.B.0": (0.2, math.inf)}, "effort.O2")
    ),
    "the bounds of 'links.rocker.points.B.0' go from nan to 0.3; use (low, high, step) with low <= high and step > 0": (
        lambda: da.optimize(M, {"links.rocker.points.B.0": (math.nan, 0.3)}, "effort.O2")
    ),
    "the bounds of 'links.rocker.points.B.0' go from 0.3 to 0.2; use (low, high, step) with low <= high and step > 0": (
        lambda: da.optimize(M, {"links.rocker.points.B.0": (0.3, 0.2)}, "effort.O2")
    ),
    "the bounds of 'links.rocker.points.B.0' go from 0.2 to 0.3; use (low, high, step) with low <= high and step > 0": (
        lambda: da.optimize(M, {"links.rocker.points.B.0": (0.2, 0.3, 0.0)}, "effort.O2")
    ),
    "a front is between two aims, of 2 points or more": lambda: da.pareto(M, BOX, ["effort.O2"], points=3),
}  # fmt: skip


@pytest.mark.parametrize("sentence", FILES)
def test_a_file_is_refused_at_its_key(sentence: str, tmp_path: Path) -> None:
    M.save(tmp_path / "four_bar.yaml")
    key, said = FILES[sentence]
    begin, end = FILE.index(f"{key}:"), FILE.index(AFTER[key])
    (tmp_path / "o.yaml").write_text(FILE[:begin] + said + FILE[end:], encoding="utf-8")
    with pytest.raises(DalembertError) as refused:
        optimize_file(tmp_path / "o.yaml")
    line = FILE[:begin].count("\n") + 1
    assert str(refused.value) == f"{tmp_path / 'o.yaml'}:{line}: {sentence}"


@pytest.mark.parametrize("sentence", REFUSED)
def test_an_aim_that_is_none_is_refused(sentence: str) -> None:
    with pytest.raises(DalembertError) as refused:
        REFUSED[sentence]()
    assert str(refused.value).startswith(sentence)


def test_a_function_that_gives_no_number_is_named() -> None:
    def words(r: Any) -> Any:
        return "many"

    with pytest.raises(
        DalembertError, match=r"words gives no number: .*; return one number, or one a position"
    ):
        da.optimize(M, BOX, words, starts=1)
