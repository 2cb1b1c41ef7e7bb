"""The key of many questions in full, meshes in a folder of variants, and what is asked by position and by extreme."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.exams import exam_folder
from dalembert.exams.asked import figure, requested_quantities
from dalembert.exams.question_sheet import ExamText, key_sheet
from dalembert.reports.sheet import Paragraph, ReportSheet, SheetTable
from tests.exams.test_variants import bracket, four_bar
from tests.model.test_shapes import box_mesh

LBF, INCH = 4.4482216152605, 0.0254
ASKED = ["effort.O2", "reaction.A", "reaction.B.x", "angle.rocker.speed", "point.coupler.P", "reaction.O2.magnitude",
         "angle.rocker"]  # fmt: skip


def four_digits(x: float) -> str:
    """As a key has a number: four digits, a minus as wide as a plus."""
    return f"{x:#.4g}".replace("-", "−")


def polar(vector: Any, unit: float) -> str:
    angle = math.degrees(math.atan2(vector[1], vector[0]))
    return f"{four_digits(math.hypot(*vector) / unit)} ∠ {angle:.2f}°".replace("-", "−")


def test_a_key_has_its_questions_six_columns_of_answers_beside_each_other_and_the_rules() -> None:
    some = four_bar(ask=ASKED)
    values = {v.name: [figure(v.result, a) for a in some.asked] for v in some}
    sheet = key_sheet(
        some[0].result, values, some.asked, ExamText("ME 301", marks={"effort": 4, "default": 1})
    )
    assert (sheet.sheet.title, sheet.sheet.subtitle) == ("Four-bar linkage, dynamic", "ME 301")
    questions, first, second = (b for b in sheet.sheet.blocks if isinstance(b, SheetTable))
    assert [list(row) for row in questions.rows] == [
        ["1", "Driving torque at O2, $T_{12}$ (4 marks)"],
        ["2", "Reaction of A on coupler, $F_{23}$ (1 mark)"],
        ["3", "Reaction of B on rocker, $F_{34}$: x (1 mark)"],
        ["4", "Speed of rocker (1 mark)"],
        ["5", "Point of coupler.P (1 mark)"],
        ["6", "Reaction of O2 on crank, $F_{12}$: magnitude (1 mark)"],
        ["7", "Angle of rocker (1 mark)"],
    ]
    units = ["lbf·in", "lbf", "lbf", "rad/s", "in", "lbf"]
    heads = [f"{n} ({unit})" for n, unit in enumerate(units, 1)]
    assert (list(first.heads), list(second.heads)) == (["Variant", *heads], ["Variant", "7 (°)"])
    for v, row, last in zip(some, first.rows, second.rows, strict=True):
        r = v.result
        assert list(row) == [
            v.name,
            four_digits(r.effort("O2")[0] / (LBF * INCH)),
            polar(r.reaction("A", on="coupler")[0], LBF),
            four_digits(r.reaction("B", on="rocker")[0, 0] / LBF),
            four_digits(r["angle.rocker.speed"][0]),
            polar(r["point.coupler.P"][0], INCH),
            four_digits(math.hypot(*r.reaction("O2")[0]) / LBF),
        ]
        assert list(last) == [v.name, four_digits(math.degrees(r.angle("rocker")[0]))]
    said = [b.text for b in sheet.sheet.blocks if isinstance(b, Paragraph)]
    assert len(said) == 3
    assert "All of it together costs at most 50 % of the sheet" in said[2]
    bare = key_sheet(some[0].result, values, some.asked, ExamText())
    assert bare.sheet.subtitle == "Key"
    assert next(b for b in bare.sheet.blocks if isinstance(b, SheetTable)).rows[0][1].endswith("$T_{12}$")


def test_a_key_of_a_machine_in_space_has_all_components() -> None:
    m = da.rssr().with_values({"drives.O.position": "1 rad"})
    r = da.dynamics(m)
    asked = requested_quantities(r, ["reaction.A", "effort.O"], None)
    sheet = key_sheet(r, {"01": [figure(r, a) for a in asked]}, asked, ExamText()).sheet
    _, answers = (b for b in sheet.blocks if isinstance(b, SheetTable))
    force = ", ".join(four_digits(float(x)) for x in r.reaction("A", on="rod")[0])
    assert [list(row) for row in answers.rows] == [["01", f"({force})", four_digits(r.effort("O")[0])]]


def meshed(folder: Path, file: str) -> da.Mechanism:
    """An arm with a mesh beside its file."""
    tree = bracket(value=100, direction="30 deg").to_tree()
    shape = {"type": "mesh", "file": file, "density": "7850 kg/m^3"}
    tree["links"]["arm"] = {"points": {"O": [0, 0], "P": [2, 0]}, "shape": shape}
    (folder / "arm.json").write_text(json.dumps(tree), encoding="utf-8")
    return da.load(folder / "arm.json")


def saved(m: da.Mechanism, out: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two variants, of which only the problems are written whole."""
    monkeypatch.setattr(exam_folder, "typst_bytes", lambda *_: b"%PDF")
    monkeypatch.setattr(exam_folder, "question_sheet", lambda *_, **__: Blank())
    monkeypatch.setattr(exam_folder, "solution_sheet", lambda *_, **__: Blank())
    monkeypatch.setattr(exam_folder, "key_sheet", lambda *_, **__: Blank())
    da.variants(m, {"loads.F.value": [100.0, 150.0]}, count=2, seed=1, ask=["reaction.O"]).save(out)


class Blank:
    """A sheet that writes nothing in its file."""

    sheet = ReportSheet("")

    def save(self, path: Path) -> None:
        path.touch()


@pytest.mark.parametrize("file", ["box.stl", "parts/small/box.stl"])
def test_a_mesh_beside_the_model_is_beside_every_problem(
    file: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / file).parent.mkdir(parents=True, exist_ok=True)
    box_mesh(tmp_path / file)
    m = meshed(tmp_path, file)
    saved(m, tmp_path / "exam", monkeypatch)
    assert (tmp_path / "exam" / "problems" / file).read_bytes() == (tmp_path / file).read_bytes()
    again = da.load(tmp_path / "exam" / "problems" / "02.yaml")
    assert again.mass("arm") == m.mass("arm") == pytest.approx(7850 * 6)
    exam_folder.check_folder(tmp_path / "exam", True)  # a mesh in it is nothing strange


def test_a_mesh_elsewhere_stays_there_if_its_path_says_where(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    box_mesh(tmp_path / "box.stl")
    inside = tmp_path / "models"
    inside.mkdir()
    saved(meshed(inside, str(tmp_path / "box.stl")), tmp_path / "exam", monkeypatch)
    names = sorted(p.name for p in (tmp_path / "exam" / "problems").iterdir())
    assert names == ["01.yaml", "02.yaml"]
    said = (
        "the mesh ../box.stl lies outside the folder of the problem; move it beside the model file, or give "
        "its absolute path"
    )
    with pytest.raises(da.ModelError) as refused:
        saved(meshed(inside, "../box.stl"), tmp_path / "other", monkeypatch)
    assert str(refused.value) == said
    assert not (tmp_path / "other").exists()


def test_a_position_is_asked_by_number_by_value_or_as_the_extreme() -> None:
    """Of several positions one that is not named is the first, or what `at` says; of one there is none to name."""
    m = da.four_bar(positions=5).with_values({"drives.O2.position": ["10 deg", "80 deg", "40 deg"]})
    r = da.dynamics(m)
    most = {"quantity": "effort", "of": "O2", "extreme": "max"}
    third = {"quantity": "effort", "of": "O2", "at": 3}
    ask = ["effort.O2", third, most, da.Answer(quantity="speed", of="rocker", at="40 deg")]
    for at, read in ((None, 1), (2, 2), ("2", 2), ("80 deg", "80 deg")):
        asked = requested_quantities(r, ask, at)
        assert [(a.at, a.extreme) for a in asked] == [
            (read, None),
            (3, None),
            (None, "max"),
            ("40 deg", None),
        ]
    found = [float(figure(r, a).value) for a in requested_quantities(r, ask, "80 deg")]
    effort = r.effort("O2")
    assert found == pytest.approx([effort[1], effort[2], effort.max(), r["angle.rocker.speed"][2]])
    assert np.argmax(effort) == 1
    assert requested_quantities(r, ["effort.O2", "effort.O2"], "1") == requested_quantities(
        r, ["effort.O2"], None
    )
    with pytest.raises(da.ModelError, match="position 4 does not exist; this result has 3 positions"):
        requested_quantities(r, ["effort.O2"], 4)
