"""Numbers of designs that belong together: correlated, permuted, one following from another; stores that grow."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.studies.design_study import Study
from dalembert.studies.output import study_views
from dalembert.studies.sampling import permuted, sum_in_order, triangle_of
from dalembert.studies.study_result import StudyResult


@pytest.mark.parametrize(
    ("pair", "r", "said"),
    [
        (("a", "d"), 0.5, "correlation names 'd', which does not vary; there are: a, b, c"),
        (("b", "b"), 0.5, "correlation names 'b' with itself; name two paths"),
        (("a", "b"), 1, "1 is not a correlation of two numbers; give one between -1 and 1"),
        (("a", "b"), -1.0, "-1.0 is not a correlation of two numbers; give one between -1 and 1"),
        (("a", "b"), "0.5", "'0.5' is not a correlation of two numbers; give one between -1 and 1"),
    ],
)
def test_a_correlation_is_of_two_numbers_that_vary(pair: tuple[str, str], r: Any, said: str) -> None:
    with pytest.raises(ModelError) as refused:
        triangle_of("abc", {pair: r}, "random")
    assert str(refused.value) == said


def test_the_triangle_of_correlations_makes_them() -> None:
    found = triangle_of("abc", {("a", "c"): 0.6, ("c", "b"): -0.3}, "random")
    assert found is not None
    assert found @ found.T == pytest.approx(np.array([[1, 0, 0.6], [0, 1, -0.3], [0.6, -0.3, 1]]))
    assert np.triu(found, 1).any() == np.False_
    rows = np.arange(6.0).reshape(3, 2) + 1
    assert sum_in_order(found, rows) == pytest.approx(found @ rows)
    assert triangle_of("abc", {}, "table") is None


TWOFOLD = """
parameters: {heavy: 2 kg, pull: 5 N*m, twice: 2*heavy}
links: {ground: {points: {O: [0, 0]}}, arm: {points: {O: [0, 0]}, mass: heavy, center: [0.3, 0]}}
joints: {O: {type: pin, links: [ground, arm]}}
drives: {O: {position: 0.4}}
loads: {F: {type: couple, on: arm, by: ground, value: -pull}}
"""


@pytest.mark.parametrize(
    ("vary", "said"),
    [
        (
            ["heavy", "links.arm.mass"],
            "'links.arm.mass' follows from the parameter 'heavy', and both vary; leave",
        ),
        (
            ["heavy", "twice"],
            "'twice' follows from the parameter 'heavy', and both vary; leave one of them out",
        ),
        (["pull", "parameters.pull"], "'pull' is varied twice; name it once"),
    ],
)
def test_a_number_and_what_follows_from_it_do_not_both_vary(vary: list[str], said: str) -> None:
    m = da.loads(TWOFOLD)
    for names in (vary, vary[::-1]):
        with pytest.raises(ModelError) as refused:
            da.study(m, dict.fromkeys(names, "± 5 %"), ["effort.O"], designs=4)
        assert str(refused.value).startswith(said)
    assert da.study(m, dict.fromkeys(("pull", "heavy"), "± 5 %"), ["effort.O"], designs=4).count == 4


def test_a_store_whose_growth_was_cut_off_grows_on(tmp_path: Path) -> None:
    """Its arrays are longer already, and its attributes still say how many designs it had."""
    import zarr

    def study(designs: int) -> Study:
        vary = {"links.coupler.mass": "± 5 %"}
        return da.study(da.four_bar(positions=2), vary, ["effort.O2"], designs=designs, seed=2)

    place = tmp_path / "s.zarr"
    study(10).run(place)
    group: Any = zarr.open_group(str(place), mode="r+")
    for name in ("status", "effort.O2"):
        group[name].resize((25,))
    found = study(25).run(place)
    assert dict(zarr.open_group(str(place), mode="r").attrs)["designs"] == 25
    assert found["effort.O2"].tolist() == study(25).run()["effort.O2"].tolist()
    assert StudyResult.open(place).done.tolist() == [True] * 25


def test_lines_of_equal_value_are_labelled_without_lines_to_their_labels(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    labels: list[Any] = []
    monkeypatch.setattr(
        study_views.Canvas, "label", lambda _, text, *spots, **how: labels.append((text, spots, how))
    )
    vary = {"links.coupler.mass": "0.5..1 kg", "links.ground.points.O4.0": "290..310 mm"}
    s = da.study(da.four_bar(positions=2), vary, ["effort.O2"], designs=4)
    response = s.response("effort.O2", *vary, count=5)
    study_views.response_scene(s.run(), response)
    inside = [(float(text), spots, how) for text, spots, how in labels if how.get("role") == "note"]
    assert len(inside) > 2
    low, high = float(response.values.min()), float(response.values.max())
    for value, spots, how in inside:
        assert low <= value <= high
        assert 1 <= len(spots) <= 24
        assert how == {"size": 2.4, "role": "note", "leads": False}


@pytest.mark.parametrize("count", [1, 2, 3, 5, 16, 17, 100])
def test_a_permutation_has_every_place_once(count: int) -> None:
    found = permuted(np.arange(count), count, 4, "a")
    assert sorted(found.tolist()) == list(range(count))
    assert permuted(np.arange(count)[::-1], count, 4, "a").tolist() == found[::-1].tolist()
    assert count < 16 or found.tolist() != permuted(np.arange(count), count, 5, "a").tolist()
