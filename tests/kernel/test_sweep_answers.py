"""A sweep's answer read by designs: labels, shapes, columns, labelled arrays, reductions, problems, and refusals."""

from __future__ import annotations

from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch import design_sweep
from dalembert.analysis.batch.sweep_columns import sweep_arrays, sweep_columns
from dalembert.analysis.batch.sweep_text import sweep_parts
from dalembert.analysis.batch.tracing.symbolic_model import number_kinds
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.errors import STATUSES, ModelError
from dalembert.printing import TextTable

MASS, POINT = "links.coupler.mass", "links.crank.points.A.0"


@cache
def machine() -> da.Mechanism:
    tree = da.four_bar(positions=3).to_tree()
    return da.mechanism(tree | {"units": {"length": "mm"}})


def arm() -> float:
    """The number at POINT."""
    crank: Any = machine().links["crank"]
    return float(crank.points["A"][0])


@cache
def grid() -> da.Sweep:
    a = arm()
    return da.sweep(
        machine(), {MASS: [1.0, 2.0, "4 kg"], POINT: [a, 1.02 * a]}, outputs=["effort.O2", "reaction.A"]
    )


@cache
def paired() -> da.Sweep:
    a = arm()
    return da.sweep(machine(), {MASS: [1.0, 2.0], POINT: [a, 1.02 * a]}, outputs="effort.O2", together=True)


def answer(mass: float, factor: float = 1.0) -> da.Result:
    return da.dynamics(machine().with_values({MASS: mass, POINT: factor * arm()}))


def test_a_grid_has_an_axis_a_path_and_pairs_have_one() -> None:
    s, p = grid(), paired()
    assert (s.shape, p.shape) == ((3, 2), (2,))
    assert (len(s), len(p)) == (6, 2)
    assert s.paths == (MASS, POINT)
    for k, mass in enumerate((1.0, 2.0, 4.0)):
        for n, factor in enumerate((1.0, 1.02)):
            r = answer(mass, factor)
            assert s["effort.O2"][k, n] == pytest.approx(r.effort("O2"), rel=1e-9)
            assert s["reaction.A.y"][k, n] == pytest.approx(r["reaction.A.y"], rel=1e-9)
    assert p["effort.O2"][1] == pytest.approx(answer(2.0, 1.02).effort("O2"), rel=1e-9)
    assert s.ok.all()
    assert s.keys() == ["effort.O2", "reaction.A"]
    assert s.subject == f"{MASS}, {POINT}"
    assert s.extent == "3 x 2 designs of 3 positions"
    assert p.extent == "2 designs of 3 positions"
    with pytest.raises(ModelError) as raised:
        s["effort.O4"]
    assert str(raised.value).startswith(
        "'effort.O4' is not an output of this sweep; name it in outputs=, or "
    )


def test_designs_are_named_by_their_values_as_they_were_given() -> None:
    a = 1e3 * arm()
    masses, places = ["1 kg", "2 kg", "4 kg"], [f"{x / 1e3:.6g} m" for x in (a, 1.02 * a)]
    assert grid().designs == [(mass, place) for mass in masses for place in places]
    assert paired().designs == [("1 kg", places[0]), ("2 kg", places[1])]
    labels = grid().labels
    assert labels[MASS].values == (1.0, 2.0, 4.0)
    assert labels[MASS].inputs == (1.0, 2.0, "4 kg")
    assert (labels[MASS].kind, labels[MASS].unit, labels[POINT].unit) == ("mass", "kg", "m")
    assert grid().record(Printed(None)) == {
        "vary": {MASS: [1.0, 2.0, "4 kg"], POINT: list(labels[POINT].inputs)},
        "together": False,
    }
    assert paired().record(Printed(None))["together"] is True


def test_a_quantity_is_reduced_over_the_positions_a_vector_by_its_size() -> None:
    s = grid()
    peak = np.linalg.norm(s["reaction.A"], axis=-1).max(axis=-1)
    assert s.over("reaction.A") == pytest.approx(peak)
    assert s.over("effort.O2", "mean") == pytest.approx(s["effort.O2"].mean(axis=-1))
    envelope = s.over("effort.O2", "envelope")
    assert envelope[..., 0] == pytest.approx(s["effort.O2"].min(axis=-1))
    assert envelope[..., 1] == pytest.approx(s["effort.O2"].max(axis=-1))
    with pytest.raises(ModelError, match="unknown reduction 'most'"):
        s.over("effort.O2", "most")


def test_columns_have_a_row_a_position_of_each_design() -> None:
    found = {c.name: (c.kind, np.asarray(c.values).tolist()) for c in sweep_columns(grid())}
    head = ["design", "position", MASS, POINT, "drive.O2", "status", "effort.O2"]
    assert list(found) == [*head, "reaction.A.x", "reaction.A.y", "reason"]
    assert found["design"][1] == [k for k in range(1, 7) for _ in range(3)]
    assert found["position"][1] == [1, 2, 3] * 6
    assert found[MASS] == ("mass", [m for m in (1.0, 2.0, 4.0) for _ in range(6)])
    a = arm()
    assert found[POINT] == (
        "length",
        pytest.approx([x for _ in range(3) for x in (a, 1.02 * a) for _ in range(3)]),
    )
    assert found["effort.O2"][1] == pytest.approx(grid()["effort.O2"].ravel().tolist())
    assert found["reaction.A.y"][1] == pytest.approx(grid()["reaction.A"][..., 1].ravel().tolist())
    assert found["drive.O2"][0] == "angle"
    assert found["reason"][1] == [None] * 18
    pairs = {c.name: np.asarray(c.values).tolist() for c in sweep_columns(paired())}
    assert pairs[MASS] == [1.0] * 3 + [2.0] * 3
    assert pairs[POINT] == pytest.approx([a] * 3 + [1.02 * a] * 3)


def test_labelled_arrays_have_the_paths_as_their_axes() -> None:
    data, names = sweep_arrays(grid(), Printed(None))
    assert data["status"][0] == (MASS, POINT, "position")
    assert data["reaction.A"][0] == (MASS, POINT, "position", "component")
    assert data["reaction.A"][2] == {"units": "N"}
    assert names["position"].tolist() == [1, 2, 3]
    assert names["component"] == ["x", "y"]
    axis, shown, unit = names[MASS]
    assert (axis, shown.tolist(), unit) == (MASS, [1.0, 2.0, 4.0], {"units": "kg"})
    assert names["drive_O2"][0] == (MASS, POINT, "position")
    assert names["drive_O2"][1].shape == (3, 2, 3)
    data, names = sweep_arrays(paired(), Printed({"length": "mm"}))
    assert data["effort.O2"][0] == ("design", "position")
    axis, shown, unit = names[POINT]
    assert (axis, unit) == ("design", {"units": "mm"})
    assert shown == pytest.approx(1e3 * np.array(paired().labels[POINT].values))


def test_printed_is_a_row_a_design_with_the_largest_sizes() -> None:
    s = grid()
    head, table = sweep_parts(s, "SI")
    assert head == repr(s).strip("<>")
    assert isinstance(table, TextTable)
    assert table.heads == [MASS, POINT, "solved", "largest effort.O2\nN*m", "largest reaction.A\nN"]
    assert [row[2] for row in table.rows] == ["3 of 3"] * 6
    assert [tuple(row[:2]) for row in table.rows] == s.designs
    assert [float(row[3]) for row in table.rows] == pytest.approx(s.over("effort.O2").ravel(), rel=1e-4)
    assert [float(row[4]) for row in table.rows] == pytest.approx(s.over("reaction.A").ravel(), rel=1e-4)
    _, mm = sweep_parts(s, "file")
    assert isinstance(mm, TextTable)
    assert mm.heads[3] == "largest effort.O2\nN*mm"


def broken(statuses: list[list[str]], reasons: list[list[Any]]) -> da.Sweep:
    p = paired()
    lost = SimpleNamespace(
        **(p.answers._asdict() | {"status": np.array(statuses, object), "reasons": np.array(reasons, object)})
    )
    return da.Sweep(p.mechanism, p.labels, True, p.kinds, p.nominal, lost)  # type: ignore[arg-type]


def test_problems_are_runs_of_one_status_and_reason() -> None:
    bad = broken(
        [["ok", "jammed", "jammed"], ["jammed", "reversal", "jammed"]],
        [[None, "it jams", "it jams"], [None, None, "at the end"]],
    )
    first, second = (f"{MASS} = {mass}, {POINT} = {place}" for mass, place in bad.designs)
    assert bad.problems() == [
        (f"{first}: position 2-3", "jammed", "it jams"),
        (f"{second}: position 1", "jammed", STATUSES["jammed"].sentence),
        (f"{second}: position 3", "jammed", "at the end"),
    ]
    assert bad.ok.tolist() == [[True, False, False], [False, True, False]]
    assert broken([["mine", "ok", "ok"], ["ok"] * 3], [[None] * 3] * 2).problems()[0][1:] == ("mine", "mine")


LEAST = "a sweep needs at least one value for each path; give a list of values"


@pytest.mark.parametrize(
    ("vary", "values", "together", "sentence"),
    [
        (MASS, None, False, 'a sweep needs values for its path; da.sweep(m, "links.rod.mass", [1, 2, 3])'),
        (
            {MASS: [1]},
            [1],
            False,
            'a sweep needs values for its path; da.sweep(m, "links.rod.mass", [1, 2, 3])',
        ),
        (MASS, "1 kg", False, 'a sweep needs values for its path; da.sweep(m, "links.rod.mass", [1, 2, 3])'),
        (MASS, [], False, LEAST),
        ({MASS: [1], POINT: None}, None, False, LEAST),
        ({}, None, False, LEAST),
        (
            {MASS: [1, 2], POINT: [1, 2, 3]},
            None,
            True,
            f"values cannot be paired: 2 of {MASS}, 3 of {POINT}; give lists of equal length",
        ),
        (
            {MASS: range(4000), POINT: range(2501)},
            None,
            False,
            f"10004000 designs are too many: 4000 of {MASS}, 2501 of {POINT}; ask for at most 10000000",
        ),
    ],
)
def test_values_that_are_none_or_do_not_fit_are_refused(
    vary: Any, values: Any, together: bool, sentence: str
) -> None:
    with pytest.raises(ModelError) as raised:
        da.sweep(machine(), vary, values, together=together)
    assert str(raised.value) == sentence


def test_values_have_the_shape_of_a_grid_or_of_pairs() -> None:
    shape = design_sweep._shape
    assert shape({"a": [1, 2], "b": [3, 4, 5]}, False) == (2, 3)
    assert shape({"a": [1, 2], "b": [3, 4]}, True) == (2,)
    assert shape({"a": range(4000), "b": range(2500)}, False) == (4000, 2500)
    read = design_sweep._values_by_path
    assert read("a", [np.float64(1.5), "2 kg", 3]) == {"a": [1.5, "2 kg", 3]}
    assert type(read("a", [np.int64(2)])["a"][0]) is int
    assert [design_sweep._is_number(x) for x in (1, 1.5, True, "1", None)] == [
        True,
        True,
        False,
        False,
        False,
    ]


def test_progress_counts_the_designs() -> None:
    told: list[tuple[int, int]] = []
    da.sweep(machine(), MASS, [1.0, 2.0], outputs="effort.O2", progress=lambda *at: told.append(at))
    assert told == [(1, 2), (2, 2)]


def test_numbers_that_a_file_writes_by_name_have_their_units() -> None:
    """A slot has a damping of its slide and one of its turn; a number alone is that of the slide."""
    text = """
links:
  ground: {points: {O: [0, 0]}}
  bar: {points: {O: [0, 0], A: [0.3, 0]}, mass: 2, center: [0.1, 0], inertia: 0.1}
  yoke: {points: {O: [0, 0]}}
joints:
  O: {type: pin, links: [ground, bar]}
  Y: {type: slider, links: [ground, yoke], at: [O, O], direction: 0 deg}
  S: {type: slot, links: [yoke, bar], at: [O, A], direction: 90 deg, damping: {slide: 3, turn: 2}}
drives: {O: {position: 30 deg, speed: 5 rad/s}}
"""
    m = da.loads(text)
    paths = ["joints.S.damping", "joints.S.damping.0", "joints.S.damping.1"]
    swept = [da.sweep(m, path, [0.5, 8.0], outputs="effort.O") for path in paths]
    assert [s.labels[path].unit for s, path in zip(swept, paths, strict=True)] == [
        "N*s/m",
        "N*s/m",
        "N*m*s/rad",
    ]
    alone, slide, turn = (s["effort.O"].ravel() for s in swept)
    assert not np.allclose(slide, turn)
    k = da.compile(m, ["joints.S.damping"])
    assert number_kinds(m, k.trace.numbers) == ("damping", "torsion_damping")
    other = k([[0.5, 0.0], [8.0, 0.0]])["effort.O"].ravel()
    assert alone == pytest.approx(other, rel=1e-12)
    assert slide == pytest.approx(k([[0.5, 2.0], [8.0, 2.0]])["effort.O"].ravel(), rel=1e-12)
