"""An aim and its conditions at every position, against the analyses; which bounds a front is made of."""

from __future__ import annotations

import re
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.optimization import pareto_front
from dalembert.optimization.aims import parse_aim, parse_condition
from dalembert.optimization.design_problem import WEIGHT, DesignProblem

BOX = {"links.ground.points.O4.0": (0.28, 0.36), "links.rocker.points.B.0": (0.2, 0.29)}
LOW, HIGH = np.array(list(BOX.values())).T
CONDITIONS = ("transmission.B >= 60 deg", "peak effort.O2 <= 3 N*m")


def problem(aim: str, conditions: tuple[str, ...] = CONDITIONS) -> DesignProblem:
    m = da.four_bar(positions=9)
    parsed = tuple(map(parse_condition, conditions))
    return DesignProblem(m, tuple(BOX), LOW, HIGH, parse_aim(aim), parsed, m.schedule().position)


def analysed(p: DesignProblem, u: Any) -> tuple[Any, Any]:
    """The effort, and both margins, of the analysis of a design."""
    r = da.dynamics(p.mechanism.with_values(dict(zip(BOX, (LOW + u * (HIGH - LOW)).tolist(), strict=True))))
    effort = r.effort("O2")
    return effort, np.stack([r["transmission.B"] - np.pi / 3, 3 - np.abs(effort)])


U = np.array([0.31, 0.62])


def test_rows_are_those_of_the_analysis_and_their_slopes_its_differences() -> None:
    """By places in the unit box: a number's slope times its span."""
    p = problem("mean effort.O2")
    rows = p.at(U)
    effort, margin = analysed(p, U)
    np.testing.assert_allclose(rows.aim, effort, rtol=1e-9)
    np.testing.assert_allclose(rows.margin, margin, rtol=1e-9, atol=1e-12)
    for k, h in enumerate(np.eye(2) * 1e-6):
        (high, high_margin), (low, low_margin) = analysed(p, U + h), analysed(p, U - h)
        np.testing.assert_allclose(rows.aim_slope[:, k], (high - low) / 2e-6, rtol=1e-5, atol=1e-5)
        np.testing.assert_allclose(
            rows.margin_slope[..., k], (high_margin - low_margin) / 2e-6, rtol=1e-5, atol=1e-5
        )


def test_an_aim_counts_by_its_usual_size_and_so_does_what_is_broken() -> None:
    p = problem("rms effort.O2")
    effort, margin = analysed(p, p.nominal)
    assert p.scale == pytest.approx(np.sqrt((effort**2).mean()))
    np.testing.assert_allclose(p.sizes, np.abs(margin).max(axis=1))
    assert (margin[0] < 0).any()
    here, lacks = analysed(p, U)
    cost = (np.minimum(lacks, 0) ** 2).mean(axis=1) / p.sizes**2
    value = np.sqrt((here**2).mean()) / p.scale + WEIGHT * cost.sum()
    assert p(U[None]).value[0] == pytest.approx(value)
    assert problem("rms effort.O2", ())(U[None]).value[0] == pytest.approx(
        np.sqrt((here**2).mean()) / p.scale
    )
    own = np.array([p.mechanism.links["ground"].points["O4"][0], p.mechanism.links["rocker"].points["B"][0]])
    np.testing.assert_allclose(p.nominal, np.clip((own - LOW) / (HIGH - LOW), 0, 1))
    out = DesignProblem(p.mechanism, p.vary, HIGH, HIGH + 0.1, p.aim, (), p.positions)
    assert out.nominal.tolist() == [0.0, 0.0]  # the description's own numbers are below the box


def test_a_condition_that_is_broken_everywhere_has_a_size_too() -> None:
    p = problem("rms effort.O2", ("transmission.B >= 91 deg", "drive.O2 >= drive.O2"))
    margin = analysed(p, p.nominal)[1][0] - np.radians(31)
    assert margin.max() < 0
    assert p.sizes == pytest.approx([np.abs(margin).max(), 1.0])


@pytest.mark.parametrize("text", ["transmission.B", "a.O >=", ">= 3", "a.O = 3", "a.O >= 3 >= 1"])
def test_a_condition_that_is_none(text: str) -> None:
    with pytest.raises(
        ModelError, match=re.escape(f"{text!r} is not a condition; write one with a single >=")
    ):
        parse_condition(text)


@pytest.mark.parametrize("word", ["peak", "mean", "rms"])
def test_the_aim_itself_has_the_slope_of_where_it_stands(word: str) -> None:
    p = problem(f"{word} effort.O2")
    value, slope = p.sharp(U)
    reduce = {"peak": lambda x: np.abs(x).max(), "mean": np.mean, "rms": lambda x: np.sqrt((x**2).mean())}[
        word
    ]
    assert value == pytest.approx(reduce(analysed(p, U)[0]))
    for k, h in enumerate(np.eye(2) * 1e-6):
        difference = reduce(analysed(p, U + h)[0]) - reduce(analysed(p, U - h)[0])
        assert slope[k] == pytest.approx(difference / 2e-6, rel=1e-5, abs=1e-6)


@pytest.mark.parametrize(
    ("aim", "said"),
    [
        ("reaction.A", r"reaction\.A is a vector; write reaction\.A\.x or \.magnitude"),
        ("effort.O2 - effort.O2", "does not depend on the varied numbers"),
        ("effort.O9", "effort.O9"),
    ],
)
def test_an_aim_that_is_none(aim: str, said: str) -> None:
    with pytest.raises(ModelError, match=said):
        problem(aim).check()


def test_an_aim_that_some_numbers_do_not_change_is_one() -> None:
    p = problem("peak effort.O2")
    p.check()
    vary = ("links.ground.points.O4.0", "links.rocker.mass")
    low, high = np.array([0.28, 0.1]), np.array([0.36, 0.9])
    DesignProblem(p.mechanism, vary, low, high, parse_aim("transmission.B"), (), p.positions).check()


@pytest.mark.parametrize("points", [2, 3, 5])
def test_a_front_is_bounded_evenly_between_its_ends(points: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """The best by each aim alone, and between them the first aim's best below even bounds; what breaks one is out."""
    asked: list[tuple[str, tuple[str, ...]]] = []

    def optimize(m: Any, vary: Any, aim: str, rules: Any, **options: Any) -> Any:
        asked.append((aim, tuple(rules)))
        bound = (
            float(rules[-1].rpartition("<= ")[2]) if len(rules) > 1 else {"a.O": 9.0, "peak b.O": 1.0}[aim]
        )
        values = {"a.O": 10.0 - bound, "b.O": bound}
        feasible = len(asked) != 4
        return SimpleNamespace(feasible=feasible, size_of=lambda aim: values[aim.of])

    monkeypatch.setattr(pareto_front, "optimize", optimize)
    front = da.pareto(da.four_bar(), BOX, ["a.O", "peak b.O"], where="c.O <= 4", points=points)
    bounds = np.linspace(9.0, 1.0, points)
    assert asked[:2] == [("a.O", ("c.O <= 4",)), ("peak b.O", ("c.O <= 4",))]
    assert [aim for aim, _ in asked[2:]] == ["a.O"] * (points - 2)
    assert [float(rules[1].removeprefix("peak b.O <= ")) for _, rules in asked[2:]] == pytest.approx(
        bounds[1:-1]
    )
    kept = np.delete(bounds, 2) if points == 5 else bounds
    np.testing.assert_allclose(front.values, np.stack([10 - kept, kept], axis=1))
    with pytest.raises(ModelError, match="points is 1; give a whole number from 2 to 1000"):
        da.pareto(da.four_bar(), BOX, ["a.O", "b.O"], points=1)
