"""Shares of a variance by Sobol's sums written out, the rows of designs they are of, and slopes at the middle."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.errors import ModelError
from dalembert.studies import contributions as module
from dalembert.studies.contributions import _indices, _jump, _sobol, _sobol_rows, slopes
from dalembert.studies.sampling import DesignPlan
from dalembert.studies.spreads import Spread

SPREADS = (Spread("uniform", 1.0, 3.0), Spread("normal", 5.0, 0.5), Spread("levels", levels=(2.0, 7.0)))


def study(of: Any = None, count: int = 3, **more: Any) -> Any:
    """A study of which an output is a function of its numbers."""
    plan = DesignPlan(("a", "b", "c")[:count], SPREADS[:count], "random", 10, 4)
    engine = SimpleNamespace(block=lambda v: {"x": of(v)}, positions=more.pop("positions", 10))
    known = {"plan": plan, "paths": plan.paths, "engine": engine, "block_size": lambda: 7, "motion": None}
    return SimpleNamespace(**{**known, "outputs": ("x",), "reduce": "mean", "end_kinds": {}, **more})


def test_rows_are_two_samples_and_the_first_with_each_column_of_the_second() -> None:
    rows = _sobol_rows(study(), 8)
    assert rows.shape == (5 * 8, 3)
    a, b, *mixed = rows.reshape(5, 8, 3)
    assert not np.isclose(a[:, :2], b[:, :2]).any()
    for j, one in enumerate(mixed):
        for k in range(3):
            assert one[:, k].tolist() == (b if k == j else a)[:, k].tolist()
    assert rows[:, 0].min() > 1.0
    assert rows[:, 0].max() < 3.0
    assert set(rows[:, 2]) == {2.0, 7.0}
    assert _sobol_rows(study(), 1).shape == (5, 3)
    with pytest.raises(
        ModelError, match=r"^the number of designs, 6, is not a power of two; use 4096, for example$"
    ):
        _sobol_rows(study(), 6)


def test_shares_are_the_sums_of_saltelli_and_of_jansen() -> None:
    y = np.array([[1.0, -2.0, 3.0], [0.5, 2.5, -4.0], [1.5, -1.0, 2.0], [0.25, 3.0, 1.0]])
    first, total, variance = _indices(y)
    known = np.var([*y[0], *y[1]])
    assert float(variance) == pytest.approx(known)
    for k in (0, 1):
        a, b, ab = y[0], y[1], y[2 + k]
        assert first[k] == pytest.approx(sum(b * (ab - a)) / 3 / known)
        assert total[k] == pytest.approx(sum((a - ab) ** 2) / 3 / (2 * known))


def test_rows_without_an_answer_are_left_out_and_counted() -> None:
    """Of 3 a + b^2 only rows in which all five designs have b below its middle plus a sigma."""
    s = study(lambda v: np.where(v[:, 1] < 5.5, 3 * v[:, 0] + v[:, 1] ** 2, np.nan))
    rows = _sobol_rows(s, 64).reshape(5, 64, 3)
    good = (rows[..., 1] < 5.5).all(axis=0)
    found = _sobol(s, "x", 64)
    assert found.note == f"{64 - good.sum()} of 64 rows left out, in which some design has no value"
    y = (3 * rows[..., 0] + rows[..., 1] ** 2)[:, good]
    y = y - y[:2].mean()
    first, total, variance = _indices(y)
    assert found.sigma == pytest.approx(float(variance) ** 0.5)
    assert list(found.shares.values()) == pytest.approx(first)
    assert list(found.total.values()) == pytest.approx(total)
    assert found.total["c"] == 0.0
    still = _sobol(study(lambda v: 0 * v[:, 0] + 4.0), "x", 8)
    assert (still.sigma, still.note, set(still.shares.values()), set(still.total.values())) == (
        0.0,
        "",
        {0.0},
        {0.0},
    )


def test_slopes_are_differences_about_the_middle_over_a_part_of_sigma() -> None:
    asked: list[Any] = []

    def of(v: Any) -> Any:
        asked.extend(v.tolist())
        return v[:, 0] ** 2 + 3 * v[:, 1] - 2 * v[:, 2]

    found = slopes(study(of), "x")
    assert found == pytest.approx([4.0, 3.0, -2.0], rel=1e-6)
    sigma = [s.sigma for s in SPREADS]
    middle = [2.0, 5.0, 4.5]
    assert len(asked) == 6
    for k in range(3):
        assert asked[k][k] - middle[k] == pytest.approx(module.STEP * sigma[k])
        assert asked[3 + k][k] - middle[k] == pytest.approx(-module.STEP * sigma[k])
        assert [x for j, x in enumerate(asked[k]) if j != k] == [x for j, x in enumerate(middle) if j != k]
    one = Spread("levels", levels=(3.0,))
    plan = SimpleNamespace(spreads=(one, SPREADS[0]))
    still = study(lambda v: v[:, 0] + v[:, 1], plan=plan)
    assert slopes(still, "x") == pytest.approx([0.0, 1.0])


@pytest.mark.parametrize(
    ("places", "said"),
    [
        ([2] * 95 + [5] * 5, "the peak jumps between positions 3 and 6 (in 5% of 100 designs)"),
        ([2] * 99 + [5], ""),  # one in a hundred is rare
        ([2] * 98 + [5, 6], "the peak jumps between positions 3 and 6 (in 2% of 100 designs)"),
        ([2] * 60 + [3] * 40, ""),  # to the next one
        ([0] * 60 + [9] * 40, ""),  # the last is next to the first
        ([0] * 60 + [8] * 40, "the peak jumps between positions 1 and 9 (in 40% of 100 designs)"),
        ([7] * 50 + [3] * 20 + [1] * 30, "the peak jumps between positions 8 and 2 (in 50% of 100 designs)"),
        (
            [np.nan] * 90 + [2] * 6 + [5] * 4,
            "the peak jumps between positions 3 and 6 (in 4% of 100 designs)",
        ),
        ([np.nan] * 100, ""),
    ],
)
def test_a_peak_jumps_where_it_is_elsewhere_in_more_than_a_hundredth(
    places: list[float], said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "_places", lambda *_: np.array(places, float))
    values = np.zeros((len(places), 1))
    assert _jump(study(), "x", values) == said
    along = _jump(study(motion="until 2 s"), "x", values)
    assert along == said.replace("positions", "instants")
