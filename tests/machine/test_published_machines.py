"""Published and derived problems of machine design come out: exact values, and what the books print."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import pytest

import dalembert as da
from dalembert.grading.file_answers import check_file
from tests.cases.test_coverage import CASES, without_file
from tests.machine.published_calls import CALLS, CAR, MODELS

PROBLEMS = {p["id"]: p for p in json.loads(Path(__file__).with_name("machine_cases.json").read_text("utf-8"))}

PARTLY = {
    "CAM-1": "profiles of arcs: the distance of the flank's centre and the angle on it are given here",
    "CAM-3": "three more laws of a rise",
    "GTR-5": "worm gears: the radial force of the teeth",
}
"""Problem -> what some of its quantities wait for."""


found = cache(lambda name: CALLS[name]())
every_problem = pytest.mark.parametrize("name", CALLS)


@every_problem
def test_exact_values_come_out(name: str) -> None:
    rows = PROBLEMS[name]["quantities"]
    assert len(found(name)) == len(rows)
    got = {q["name"]: v for q, v in zip(rows, found(name), strict=True) if v is not None}
    assert got == pytest.approx(
        {q["name"]: q["exact"] for q in rows if q["name"] in got}, rel=1e-8, abs=1e-12
    )


@every_problem
def test_they_are_what_the_books_print(name: str) -> None:
    rows = zip(PROBLEMS[name]["quantities"], found(name), strict=True)
    printed = [(q, v) for q, v in rows if v is not None and "printed" in q]
    assert printed or PROBLEMS[name]["origin"] == "derived"
    off = {q["name"]: (v, q["printed"]) for q, v in printed if abs(v / q["printed"] - 1) > q["tolerance"]}
    assert not off


def test_every_problem_has_a_call_or_waits() -> None:
    assert set(CALLS) <= set(PROBLEMS)
    files = {name for name in PROBLEMS if any(CASES.glob(f"{name.lower()}-*.yaml"))}
    assert set(PROBLEMS) - set(CALLS) <= {row[0] for row in without_file()} | files
    assert {name for name in CALLS if None in found(name)} == set(PARTLY)


@pytest.mark.parametrize("path", MODELS, ids=lambda path: path.stem)
def test_answers_of_the_files_here(path: Path) -> None:
    rows = check_file(path)
    assert rows
    assert [(row.quantity, row.computed, row.published) for row in rows if not row.ok] == []


def test_a_car_that_slides_to_rest_says_nothing_of_self_locking() -> None:
    """No load has to drive it: its four wheels are locked, and without inertia nothing moves them."""
    s = da.simulate(da.loads(CAR % (0.6, 0.6)), "rear.speed = 0 ft/s", count=3)
    assert set(s.result.status) == {"ok", "at_rest"}
    assert "Self-locking" not in str(s)
