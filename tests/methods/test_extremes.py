"""Peaks of either sense, at gaps and reversals, and which position an answer of a file is about."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.result.outcome import span
from dalembert.grading.file_answers import check
from tests.friction.rough import cycle


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_worst_is_the_largest_of_either_sense(sign: float) -> None:
    """An arm with a couple that goes from -9 to 3 or from 9 to -3: the drive balances it."""
    m = da.loads(f"""
units: {{angle: rad}}
links: {{ground: {{points: {{O: [0, 0]}}}}, arm: {{points: {{O: [0, 0], P: [2, 0]}}}}}}
joints: {{O: {{type: pin, links: [ground, arm]}}}}
drives: {{O: {{position: [0, 1, 2, 3, 4]}}}}
loads:
  M: {{type: couple, on: arm, value: "{sign}*(9 - 3*O)"}}
  F: {{type: force, on: arm, at: O, value: ["3*(2 - O)", "4*(O - 2)"]}}
""")
    r = da.statics(m)
    assert r.effort("O") == pytest.approx(-sign * np.array([9, 6, 3, 0, -3]))
    assert r.worst("effort", "O") == (pytest.approx(9.0), 0)
    assert r.worst("reaction", "O") == (pytest.approx(10.0), 0)
    rows = [
        {"quantity": "effort", "of": "O", "extreme": "max", "value": "9 N*m" if sign < 0 else "3 N*m"},
        {"quantity": "effort", "of": "O", "extreme": "min", "value": "-3 N*m" if sign < 0 else "-9 N*m"},
        {"quantity": "effort", "of": "O", "extreme": "maxabs", "value": f"{-sign * 9} N*m"},
        {"quantity": "effort", "of": "O", "at": 2, "value": f"{-sign * 6} N*m"},
        {"quantity": "effort", "of": "O", "at": "3 rad", "value": "0 N*m", "tolerance": "1e-9 N*m"},
    ]
    found = check(m.with_values({"answers": rows}))
    assert [row.ok for row in found] == [True] * 5, [row.computed for row in found]
    wrong = [row | {"value": "1.2345 N*m"} for row in rows]
    assert [row.ok for row in check(m.with_values({"answers": wrong}))] == [False] * 5


def test_the_worst_is_sought_among_what_is_known() -> None:
    """A rocker's range has gaps; where no position has a number there is none."""
    m = da.four_bar(ground=0.3, crank=0.2, coupler=0.15, rocker=0.12, sweep=(-0.5, 0.5))
    m = m.with_values({"drives.O2.position": tuple(np.linspace(-1.5, 1.5, 30)), "assembly": {"rocker": 1.8}})
    r = da.dynamics(m)
    assert not r.ok.all()
    values = np.abs(r.effort("O2"))
    assert r.worst("effort", "O2") == (np.nanmax(values), int(np.nanargmax(values)))
    never = da.dynamics(m.with_values({"drives.O2.position": (1.4, 1.5)}))
    worst, at = never.worst("reaction", "A")
    assert np.isnan(worst)
    assert at == -1


def test_the_worst_of_a_reversal_is_that_of_its_worse_side() -> None:
    m = cycle("slider_crank", 4)
    m = m.with_values({"drives.O2.position": tuple(np.radians([0.0, 90.0, 180.0, 270.0]))})
    r = da.dynamics(m)
    assert "reversal" in r.status
    sides = [np.abs(side.effort("O2")) for side in r.sides]
    assert len(sides) == 2
    low, high = span(r, lambda side: side.effort("O2"))
    both = np.stack([side.effort("O2") for side in r.sides])
    np.testing.assert_array_equal(low, both.min(axis=0))
    np.testing.assert_array_equal(high, both.max(axis=0))
    assert r.worst("effort", "O2")[0] == np.nanmax(sides)
    for joint in r.joints:
        for quantity, read in (("reaction", "reaction"), ("moment", "reaction_moment")):
            values = [getattr(side, read)(joint) for side in r.sides]
            sizes = [np.abs(v) if v.ndim == 1 else np.linalg.norm(v, axis=-1) for v in values]
            most = np.max(sizes, axis=0)
            assert r.worst(quantity, joint) == (most.max(), most.argmax())  # type: ignore[arg-type]


def asked(at: object, k: int) -> bool:
    """Whether the answer that names a position is the effort at the k-th."""
    m = da.four_bar().with_values({"drives.O2.position": tuple(np.radians([0.0, 60.0, 120.0]))})
    effort = da.dynamics(m).effort("O2")
    row = {"quantity": "effort", "of": "O2", "at": at, "value": f"{float(effort[k])!r} N*m"}
    return check(m.with_values({"answers": [row]}))[0].ok


@pytest.mark.parametrize(
    ("at", "place"), [(1, 0), (3, 2), ("60 deg", 1), ("420 deg", 1), ("-300 deg", 1), ("120.0 deg", 2)]
)
def test_an_answer_is_about_the_position_that_it_names(at: Any, place: int) -> None:
    assert [asked(at, k) for k in range(3)] == [k == place for k in range(3)]


@pytest.mark.parametrize(
    ("at", "said"),
    [
        (0, "position 0 does not exist; this result has 3 positions, numbered from 1"),
        (4, "position 4 does not exist; this result has 3 positions, numbered from 1"),
        ("61 deg", "no position has O2 = 61 deg; number the position"),
        ("60 mm", "60 mm"),
    ],
)
def test_a_position_that_there_is_not(at: Any, said: str) -> None:
    with pytest.raises(da.ModelError, match=said):
        asked(at, 0)


def test_runs_of_positions_with_one_sentence_are_told_together() -> None:
    m = da.four_bar(ground=0.3, crank=0.2, coupler=0.15, rocker=0.12, sweep=(-0.5, 0.5))
    m = m.with_values({"drives.O2.position": (-1.4, -1.3, -1.2, 0.0, 0.5, 1.5), "assembly": {"rocker": 1.8}})
    r = da.dynamics(m)
    assert [(which, status) for which, status, _ in r.problems()] == [
        ("1-3", "not_assembled"),
        ("6", "not_assembled"),
    ]
    assert [said for *_, said in r.problems()] == [r.reasons[0], r.reasons[5]]
