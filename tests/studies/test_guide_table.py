"""The table of contributions by position in the guide is computed again."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import dalembert as da
from dalembert.bundled import cases
from tests.tiers import tiers

PAGE = (Path(__file__).parents[2] / "docs" / "studies.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| (\d+)° \| ([\d,]+) \| (.*) \|$", PAGE, re.MULTILINE)
SHARE = "friction.coefficient"


@pytest.mark.parametrize("row", tiers(ROWS[:1], ROWS[1:]))
def test_contributions_by_position(row: tuple[str, str, str]) -> None:
    crank, torque, figures = row
    m = da.load(cases()["seed-002-7a-engine-friction-circles"])
    at = m.with_values({"drives.O.position": f"{crank} deg"})
    vary = {f"joints.{n}.friction.radius": "± 20 %" for n in "OAB"} | {SHARE: "± 20 %"}
    s = da.study(at, vary, ["effort.O"], static=True)
    linear, sampled = s.contributions("effort.O"), s.contributions("effort.O", "sobol", 1024)
    assert abs(da.statics(at).effort("O")[0]) == pytest.approx(float(torque.replace(",", "")), abs=0.5)
    sigmas, shares = (
        [float(x) for x in figures.split(" | ")[:2]],
        [float(x) for x in figures.split(" | ")[2:]],
    )
    assert [linear.sigma, sampled.sigma] == pytest.approx(sigmas, abs=0.0501)
    found = [linear.shares[SHARE], sampled.shares[SHARE], sampled.total[SHARE]]
    assert found == pytest.approx(shares, abs=0.00501)
