"""Equality of answers item by item, the curves that charts of an answer have, and files that are kept."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.answer import workbook
from dalembert.answer.column import WORD
from dalembert.answer.equality import equal
from dalembert.model.library import template
from tests.answers.every_answer import made

NAN = float("nan")


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        (1.0, 1.0, True),
        (1.0, 2.0, False),
        (NAN, float("nan"), True),  # two objects
        (NAN, 1.0, False),
        (1.0, NAN, False),
        (1, 1.0, False),  # a count is no length
        ([1.0, NAN], [1.0, float("nan")], True),
        ([1.0, 2.0], [1.0, 3.0], False),
        ([1.0], [1.0, 2.0], False),
        ((1.0,), [1.0], False),
        ({"a": 1.0}, {"a": 1.0}, True),
        ({"a": 1.0}, {"a": 2.0}, False),
        ({"a": 1.0}, {"b": 1.0}, False),
        ({"a": 1.0}, {"a": 1.0, "b": 2.0}, False),
        ("ab", "ab", True),
        ("ab", "ac", False),
        (np.array([1.0, NAN]), np.array([1.0, NAN]), True),
        (np.array([1.0, NAN]), np.array([NAN, 1.0]), False),
        (np.array([1.0]), np.array([[1.0]]), False),
        (np.array([1, 2]), np.array([1.0, 2.0]), False),
        (np.array(["a", None], object), np.array(["a", None], object), True),
        (np.array(["a", None], object), np.array(["a", "b"], object), False),
        (np.array([["a"], ["b"]], object), np.array(["a", "b"], object), False),
        (np.array([1j, NAN]), np.array([1j, NAN]), True),
    ],
)
def test_values_are_equal_item_by_item_nan_as_nan(one: Any, other: Any, same: bool) -> None:
    assert equal(one, other) is same
    assert equal(other, one) is same


@pytest.mark.parametrize("analysis", [da.kinematics, da.statics])
def test_a_chart_has_every_column_with_a_value_but_the_drive_itself(analysis: Any) -> None:
    """Over the drive; without forces there are none of efforts and reactions."""
    r = analysis(da.four_bar(positions=5))
    charts = workbook.column_diagrams(r, r.scale("SI"), "ground")
    known = {
        c.name: c.kind
        for c in r.columns()
        if c.kind != WORD and np.isfinite(np.asarray(c.values[:], float)).any()
    }
    drawn = {curve.name for chart in charts for curve in chart.curves}
    assert {chart.x.head for chart in charts} == {"drive.O2 [deg]"}
    assert "drive.O2" in known
    assert "drive.O2" not in drawn
    assert drawn <= known.keys()
    assert any(name.startswith("reaction") for name in drawn) is (analysis is da.statics)
    for kind in {known[name] for name in drawn}:
        mine = [name for name, k in known.items() if k == kind and name != "drive.O2"]
        assert len(drawn & set(mine)) == min(len(mine), workbook.MOST_CURVES)


@pytest.mark.parametrize("way", ["to_csv", "to_json", "to_xlsx", "to_netcdf", "save"])
def test_a_file_that_exists_is_kept_unless_it_may_be_overwritten(way: str, tmp_path: Path) -> None:
    path = tmp_path / ("a.csv" if way == "save" else f"a.{way[3:]}")
    path.write_text("mine")
    write = getattr(made("Flywheel"), way)
    with pytest.raises(da.ModelError) as refused:
        write(path)
    assert str(refused.value).startswith(f"{path} exists; name another file, or overwrite it: --force")
    assert (path.read_text(), [p.name for p in tmp_path.iterdir()]) == ("mine", [path.name])
    write(path, overwrite=True)
    assert path.read_bytes() != b"mine"
    assert [p.name for p in tmp_path.iterdir()] == [path.name]


PARTS: dict[str, tuple[str, str, Any, Callable[[da.Result], Any]]] = {
    "shoe": ("block_brake", "loads.force.value", [0.0, -300.0], lambda r: r.brake("lining")),
    "disc": ("plate_clutch", "joints.plates.force", 500.0, lambda r: r.brake("plates")),
    "belt": ("belt_drive", "loads.work.value", -9.0, lambda r: r.belt("belt")),
    "limit of a belt": ("belt_drive", "joints.belt.tension", 300.0, lambda r: r.belt("belt").limit),
    "rope": ("hoist", "links.block.mass", 200.0, lambda r: r.rope("rope")),
    "contact": ("disc_cam", "links.follower.mass", 0.7, lambda r: r.contact("F")),
    "virtual work": ("four_bar", "loads.torque.value", -9.0, da.virtual_work),
    "superposition": ("four_bar", "loads.torque.value", -9.0, da.superposition),
    "forces inside": ("four_bar", "links.rocker.mass", 0.5, lambda r: da.member_forces(r, "rocker")),
}


@pytest.mark.parametrize("name", PARTS)
def test_what_an_answer_is_asked_for_is_compared_with_its_like(name: str) -> None:
    """Equal where all its numbers are, NaN as NaN; unequal, and no error, where one of them is another."""
    model, path, value, part = PARTS[name]
    m = template(model)
    r, other = da.dynamics(m), da.dynamics(m.with_values({path: value}))
    assert part(r) == part(r)
    assert part(r) != part(other)
    assert part(r) != name
