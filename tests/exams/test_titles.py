"""Titles of variants, which state the numbers that vary; and the marks of questions."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import pytest

import dalembert as da
from dalembert.exams.titles import variant_title
from dalembert.exams.variants import read_marks
from tests.exams.test_variants import ENGINE, bracket


@pytest.mark.parametrize(
    ("title", "path", "value", "titled"),
    [
        ("12 apples, 300 N, 2 m (a, 0.3 kN)", "loads.F.value", "400 N @ 90 deg", "12 apples, 400 N, 2 m (a, 0.4 kN)"),
        ("300 N, 300 mm and 300 W", "loads.F.value", [0, -250], "250 N, 300 mm and 300 W"),
        ("300 N at 2 m, 2 s", "links.arm.points.P.0", "1.5 m", "300 N at 1.5 m, 2 s"),
        ("300 N", "loads.F.at", "O", "300 N"),
        ("1.300 N and 300.01 N", "loads.F.value", "400 N @ 90 deg", "1.300 N and 300.01 N"),
        ("A bracket", "loads.F.value", "400 N @ 90 deg", "A bracket"),
    ],
)  # fmt: skip
def test_a_title_has_a_number_changed_only_where_it_is_the_one_that_varies(
    title: str, path: str, value: Any, titled: str
) -> None:
    m = bracket(value="300 N @ 90 deg").with_values({"title": title})
    assert variant_title(m, m.with_values({path: value}), [path]) == titled


def test_a_title_has_the_parameter_of_its_variant(tmp_path: Path) -> None:
    (tmp_path / "engine.yaml").write_text(ENGINE.replace("Engine", "Engine, 1.2 MPa, 100 mm"))
    m = da.load(tmp_path / "engine.yaml")
    for paths in (
        {"parameters.p": "1.5 MPa", "bore": "0.12 m"},
        {"p": "1.5 MPa", "parameters.bore": "0.12 m"},
    ):
        assert variant_title(m, m.with_values(paths), list(paths)) == "Engine, 1.5 MPa, 120 mm"


@pytest.mark.parametrize(
    ("marks", "right"),
    [
        ({"effort": 1e6}, True),
        ({"reaction": 0, "default": 2.5}, True),
        ({"effort.O2": 4}, True),
        *(({"effort": worth}, False) for worth in (-1, -1e-9, True, "4", 1_000_001, math.nan, None)),
    ],
)
def test_marks_are_numbers_from_0_to_a_million(marks: Any, right: bool) -> None:
    asked = [da.Answer(quantity="effort", of="O2"), da.Answer(quantity="reaction", of="A")]
    if right:
        assert read_marks(marks, asked) == marks
        return
    said = f"marks of effort: {marks['effort']!r} is not a number of marks; write 0 or more"
    with pytest.raises(da.ModelError, match=f"^{re.escape(said)}$"):
        read_marks(marks, asked)
