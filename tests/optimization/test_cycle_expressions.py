"""Reductions and numbers of the file inside aims and conditions, against `da.dynamics` and numpy, and differences."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.optimization.aims import Aim, parse_aim, parse_condition
from dalembert.optimization.design_problem import WEIGHT, DesignProblem

VARY = ("links.ground.points.O4.0", "links.rocker.points.B.0", "links.rocker.mass")
LOW, HIGH = np.array([0.28, 0.2, 0.3]), np.array([0.36, 0.29, 0.6])
U = np.array([0.31, 0.62, 0.4])
MODEL = da.four_bar(positions=9)


def problem(aim: str, *conditions: str) -> DesignProblem:
    parsed = tuple(map(parse_condition, conditions))
    return DesignProblem(MODEL, VARY, LOW, HIGH, parse_aim(aim), parsed, MODEL.schedule().position)


def analysed(u: Any) -> tuple[Any, Any, Any, float]:
    """Effort, a reaction, an angle, and the mass, of a design."""
    values = LOW + u * (HIGH - LOW)
    r = da.dynamics(MODEL.with_values(dict(zip(VARY, values.tolist(), strict=True))))
    return r["effort.O2"], r["reaction.A.magnitude"], r["angle.rocker"], values[2]


def peak(x: Any) -> Any:
    return np.abs(x).max()


AIMS = {
    "peak(effort.O2) + 0.1 m*peak(reaction.A.magnitude)": lambda e, a, t, m: peak(e) + 0.1 * peak(a),
    "range angle.rocker": lambda e, a, t, m: np.ptp(t),
    "rms(effort.O2 - mean(effort.O2))": lambda e, a, t, m: e.std(),
    "peak(effort.O2 - least(effort.O2)/2)": lambda e, a, t, m: peak(e - e.min() / 2),
    "greatest(reaction.A.magnitude)/links.rocker.mass^2": lambda e, a, t, m: a.max() / m**2,
    "links.rocker.mass": lambda e, a, t, m: m,
    "2*final(effort.O2) - norm8(effort.O2)": lambda e, a, t, m: 2 * e[-1] - (e**8).mean() ** 0.125,
    "sqrt(rms(effort.O2)*1 N*m) + sin(range(angle.rocker))": lambda e, a, t, m: (
        (e**2).mean() ** 0.25 + np.sin(np.ptp(t))
    ),
    "max(mean(abs(effort.O2)), 1 N*m) + atan2(least(angle.rocker), 2 - 1/links.rocker.mass)": lambda e, a, t, m: (
        np.abs(e).mean() + np.arctan2(t.min(), 2 - 1 / m)
    ),
}


@pytest.mark.parametrize("aim", AIMS)
def test_an_aim_is_what_numpy_makes_of_the_analysis_and_its_slope_its_difference(aim: str) -> None:
    p = problem(aim)
    p.check()
    value, slope = p.sharp(U)
    assert value == pytest.approx(AIMS[aim](*analysed(U)), rel=1e-8)
    for k, h in enumerate(np.eye(3) * 1e-6):
        difference = (AIMS[aim](*analysed(U + h)) - AIMS[aim](*analysed(U - h))) / 2e-6
        assert slope[k] == pytest.approx(difference, rel=1e-5, abs=2e-6)


CONDITIONS = {
    "range(angle.rocker) >= 50 deg": lambda e, a, t, m: np.ptp(t) - np.radians(50),
    "effort.O2 <= 1.2*mean(effort.O2) + 1 N*m": lambda e, a, t, m: 1.2 * e.mean() + 1 - e,
    "9.81 m/s^2*links.rocker.mass <= peak(reaction.A.magnitude)": lambda e, a, t, m: peak(a) - 9.81 * m,
    "rms effort.O2 <= links.rocker.mass*(1 m^2/s^2)": lambda e, a, t, m: m - (e**2).mean() ** 0.5,
    "least(angle.rocker) >= 40 deg": lambda e, a, t, m: t - np.radians(40),
    "peak(effort.O2) <= links.rocker.mass*8": lambda e, a, t, m: 8 * m - np.abs(e),
    "reaction.A.magnitude >= peak effort.O2": lambda e, a, t, m: a - peak(e),
    "reaction.A.magnitude*(angle.rocker > 60 deg) <= 20 N": lambda e, a, t, m: 20 - a * (t > np.pi / 3),
}


@pytest.mark.long
def test_margins_are_those_of_the_analysis() -> None:
    """Where both sides are of the cycle, one row of the polish; else one at each position."""
    p = problem("effort.O2", *CONDITIONS)
    p.check()
    rows, values = p.at(U), [of(*analysed(U)) for of in CONDITIONS.values()]
    for margin, value in zip(rows.margin, values, strict=True):
        np.testing.assert_allclose(margin, np.broadcast_to(value, 9), rtol=1e-8, atol=1e-10)
    assert p.rows_of_margins.sum(axis=1).tolist() == [9 if np.ndim(v) else 1 for v in values]
    for k, h in enumerate(np.eye(3) * 1e-6):
        ends = [[of(*analysed(u)) for of in CONDITIONS.values()] for u in (U + h, U - h)]
        for slope, high, low in zip(rows.margin_slope, *ends, strict=True):
            expected = np.broadcast_to((high - low) / 2e-6, 9)
            np.testing.assert_allclose(slope[:, k], expected, rtol=1e-5, atol=1e-5)


def test_many_designs_count_what_is_broken_beside_the_smooth_aim() -> None:
    texts = list(CONDITIONS)
    p = problem("peak(effort.O2) + range(effort.O2)", *texts)
    e = analysed(U)[0]
    lacks = [np.minimum(of(*analysed(U)), 0) for of in CONDITIONS.values()]
    cost = [WEIGHT * np.mean(lack**2) / size**2 for lack, size in zip(lacks, p.sizes, strict=True)]
    assert sum(c > 0 for c in cost) >= 2
    expected = ((e**8).mean() ** 0.125 + np.ptp(e)) / p.scale + sum(cost)
    answer = p(np.stack([p.nominal, U]))
    assert answer.value[1] == pytest.approx(expected, rel=1e-8)
    ends = [p((U + h * s)[None]).value[0] for h in np.eye(3) * 1e-6 for s in (1, -1)]
    np.testing.assert_allclose(answer.slope[1], np.subtract(ends[::2], ends[1::2]) / 2e-6, rtol=1e-4)


def test_the_optimum_keeps_a_range_and_is_no_worse_than_a_grid() -> None:
    aim, where = "peak(effort.O2) + 0.1 m*peak(reaction.A.magnitude)", "range(angle.rocker) >= 44 deg"
    vary = dict(zip(VARY[:2], zip(LOW.tolist(), HIGH.tolist(), strict=False), strict=False))
    best = da.optimize(MODEL, vary, aim, where, starts=6)
    assert best.feasible
    assert np.ptp(best.after["angle.rocker"]) >= np.radians(44) * (1 - 1e-6)
    assert best.value == pytest.approx(
        float(AIMS[aim](best.after["effort.O2"], best.after["reaction.A.magnitude"], 0, 0))
    )
    x, y = (g.ravel() for g in np.meshgrid(*(np.linspace(0, 1, 21),) * 2))
    designs = np.stack([x, y, 0 * x], axis=1) * (HIGH - LOW) + LOW
    r = da.compile(MODEL, VARY[:2], ["effort.O2", "reaction.A.magnitude", "angle.rocker"], None)(
        designs[:, :2]
    )
    size = np.abs(r["effort.O2"]).max(1) + 0.1 * r["reaction.A.magnitude"].max(1)
    kept = np.ptp(r["angle.rocker"], axis=1) >= np.radians(44)
    assert best.value <= size[kept].min() * (1 + 1e-6)
    assert f"margin of {where}" in str(best)
    assert aim in str(best)


def test_a_short_form_is_that_with_brackets() -> None:
    assert parse_aim("peak effort.O2") == parse_aim("peak(effort.O2)") == Aim("peak", "effort.O2")
    assert parse_aim("range effort.O2") == Aim("", "range(effort.O2)")
    short, long = (
        parse_condition(f"{side} <= 3 N*m").margin for side in ("peak effort.O2", "peak(effort.O2)")
    )
    assert short == long == "(3 N*m) - (abs(effort.O2))"


@pytest.mark.parametrize(
    ("least", "where", "said"),
    [
        (
            "peak effort.O2 + 0.1*peak(reaction.A.x)",
            "effort.O2 <= 3",
            "'peak effort.O2 + 0.1*peak(reaction.A.x)' has a reduction beside 'peak', and it is open "
            "where this one ends; write peak(...), with brackets",
        ),
        ("peak(reaction.A)", "effort.O2 <= 3", "reaction.A is a vector; write reaction.A.x or .magnitude"),
        ("range(reaction.A)", "effort.O2 <= 3", "reaction.A is a vector; an expression needs numbers"),
        ("range(effort.O9)", "effort.O2 <= 3", "unknown quantity 'effort.O9'; did you mean 'effort.O2'?"),
        ("range(drive.O2)", "effort.O2 <= 3", "range(drive.O2) does not depend on the varied numbers"),
        ("effort.O2", "range(effort.O2) <= 3 N", "3 N is a force, and range(effort.O2) is a moment"),
        (
            "effort.O2",
            "effort.O2 <= links.rocker.mas",
            "'mas' does not exist in links.rocker; did you mean 'mass'?",
        ),
        ("effort.O2", "effort.O2 <= links.rocker.weight", "'links.rocker.weight' has no number"),
        (
            "effort.O2",
            "effort.O2 <= links.rocker.points.B",
            "'links.rocker.points.B' is not a single number; name one",
        ),
        ("effort.O2", "peak(3) >= 2", "'(peak(3)) - (2)' names no quantity; write one like range(slide.G)"),
        ("effort.O2", "links.rocker.mass <= 3 m", "3 m is a length, and links.rocker.mass is a mass"),
    ],
)
def test_refusals(least: str, where: str, said: str) -> None:
    with pytest.raises(ModelError, match=re.escape(said)):
        da.optimize(MODEL, {VARY[2]: (0.3, 0.6)}, least, where, starts=1)


def test_a_reduction_is_refused_where_each_position_has_a_value() -> None:
    with pytest.raises(
        ModelError, match=re.escape("peak(...) is a number of a complete cycle, and an output has one")
    ):
        da.compile(MODEL, [VARY[2]], ["peak(effort.O2)"])
    torque = {"loads.torque.value": "2*peak(O2)"}
    with pytest.raises(ModelError, match=re.escape("peak(...) is a number of a complete cycle")):
        MODEL.with_values(torque)


def test_a_result_has_reductions_and_numbers_of_the_file() -> None:
    e, a, _, m = analysed(U)
    r = da.dynamics(MODEL.with_values(dict(zip(VARY, (LOW + U * (HIGH - LOW)).tolist(), strict=True))))
    np.testing.assert_allclose(r["effort.O2 - mean(effort.O2)"], e - e.mean(), atol=1e-12)
    np.testing.assert_allclose(r["peak(reaction.A.magnitude) - 3 m/s^2*links.rocker.mass"], a.max() - 3 * m)
    for word in ("peak", "mean", "rms", "range", "least", "greatest", "norm8", "final"):
        np.testing.assert_allclose(r[f"{word}(2*links.rocker.mass)"], 0 if word == "range" else 2 * m)
