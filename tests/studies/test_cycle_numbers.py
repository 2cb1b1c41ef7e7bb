"""Outputs and limits of studies that are numbers of a cycle, against `da.dynamics` and numpy of each design."""

from __future__ import annotations

import re

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch.batch_result import CODES
from dalembert.errors import ModelError
from dalembert.studies import Study
from tests.tiers import tiers

MODEL = da.four_bar(positions=9)
VARY = {"links.rocker.mass": "uniform ± 20 %", "links.ground.points.O4.0": "0.28..0.5 m"}
SUM = "peak(effort.O2) - 2 m*final(reaction.A.x)*links.rocker.mass/1 kg"


def study(reduce: str | None, **options: object) -> Study:
    limits = {"range(angle.rocker)": ">= 47 deg", "links.rocker.mass": "< 0.5 kg"}
    outputs = ["effort.O2", "links.rocker.mass", SUM]
    return da.study(MODEL, VARY, outputs, reduce, **{"designs": 40, "seed": 3, "limits": limits, **options})


@pytest.mark.parametrize("reduce", tiers(["mean"], [None]))
def test_numbers_of_a_cycle_are_those_of_each_design_whatever_the_reduction(reduce: str | None) -> None:
    """A design that does not close at each position has none, and its status says so."""
    s = study(reduce) if reduce else study(None, limits={"range(angle.rocker)": ">= 47 deg"})
    r = s.run()
    assert set(s.outputs) == {"effort.O2", "links.rocker.mass", SUM, "range(angle.rocker)"}
    kept = failed = 0
    for n in range(s.count):
        one = da.dynamics(MODEL.with_values(s.design(n)))
        e, mass = one["effort.O2"], s.design(n)["links.rocker.mass"]
        closed = bool(np.isfinite(e).all())
        failed += not closed
        swing = np.ptp(one["angle.rocker"]) if closed else np.nan
        kept += bool(swing >= np.radians(47))
        total = np.abs(e).max() - 2 * one["reaction.A.x"][-1] * mass if closed else np.nan
        np.testing.assert_allclose([r[SUM][n], r["range(angle.rocker)"][n]], [total, swing], rtol=1e-8)
        np.testing.assert_allclose(r["effort.O2"][n], e.mean() if reduce else e, rtol=1e-8, atol=1e-12)
        if reduce:
            assert (r["status"][n] == CODES.index("ok")) == closed
    assert 0 < failed < s.count
    assert 0 < kept < s.count - failed
    shares = r.shares()
    assert shares["range(angle.rocker) >= 47 deg"] == pytest.approx(kept / s.count)


def test_a_difference_of_numbers_of_a_cycle_has_contributions() -> None:
    """The range does not depend on the mass."""
    one = da.study(
        MODEL, {**VARY, "links.ground.points.O4.0": "0.29..0.31 m"}, "range(angle.rocker)", designs=8
    )
    shares = one.contributions("range(angle.rocker)").shares
    assert shares == pytest.approx({"links.rocker.mass": 0.0, "links.ground.points.O4.0": 1.0})


@pytest.mark.parametrize(
    ("output", "said"),
    [
        (
            "effort.O2 - mean(effort.O2)",
            "'effort.O2 - mean(effort.O2)' has a value at every position, and a reduction inside; "
            "reduce it too: peak(effort.O2 - mean(effort.O2))",
        ),
        ("range(effort.O9)", "unknown quantity 'effort.O9'; did you mean 'effort.O2'?"),
        ("peak(reaction.A)", "reaction.A is a vector; an expression needs numbers; write reaction.A.x"),
        ("range(effort.O2) - 3 N", "range(effort.O2) is a moment, and 3 N is a force"),
    ],
)
def test_refusals(output: str, said: str) -> None:
    with pytest.raises(ModelError, match=re.escape(said)):
        da.study(MODEL, VARY, [output], designs=3)
