"""Exam variants: sound, all different, the same for a seed; their sheets and key; what is refused, in its words."""

from __future__ import annotations

import csv
import importlib.util
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.cli import main
from dalembert.exams import exam_folder
from dalembert.exams.asked import figure
from dalembert.exams.choices import read_choices, read_option
from dalembert.exams.question_sheet import ExamText, key_sheet, question_sheet
from dalembert.grading.file_answers import check
from dalembert.reports.sheet import Blanks, Drawings, Heading, Paragraph, ReportSheet, SheetTable
from tests.methods.test_question import falsified
from tests.model.test_shapes import box_mesh

FOUR_BAR = {"loads.T_4.value": "100..140 lbf*in", "drives.O2.position": "[45, 60, 75]"}


def four_bar(**options: Any) -> Any:
    return da.variants(da.load(examples()["four_bar"]), **{"vary": FOUR_BAR, "count": 2, "seed": 3} | options)


def bracket(**load: object) -> da.Mechanism:
    """An arm welded to the ground, with one force at its end: the reaction is that force turned round."""
    return da.mechanism(
        {
            "links": {"ground": {"points": {"O": [0, 0]}}, "arm": {"points": {"O": [0, 0], "P": [2, 0]}}},
            "joints": {"O": {"type": "weld", "links": ["ground", "arm"]}},
            "loads": {"F": {"type": "force", "on": "arm", "at": "P", **load}},
        }
    )


@pytest.mark.parametrize(
    ("given", "values"),
    [
        ("40..60 mm step 5 mm", ["40 mm", "45 mm", "50 mm", "55 mm", "60 mm"]),
        ("0.1..0.2", ["0.1", "0.12", "0.14", "0.16", "0.18", "0.2"]),
        ("12..19 N", ["12 N", "13 N", "14 N", "15 N", "16 N", "17 N", "18 N", "19 N"]),
        ("-30..-10 deg step 10 deg", ["-30 deg", "-20 deg", "-10 deg"]),
        ("1 m..2 m step 50 cm", ["1 m", "1.5 m", "2 m"]),
        ("[400 N, 500 N]", ["400 N", "500 N"]),
        ("[[0, -8 kN], [0, -9 kN]]", [["0", "-8 kN"], ["0", "-9 kN"]]),
        ([0.1, 0.2], [0.1, 0.2]),
    ],
)
def test_values_to_draw(given: object, values: list[object]) -> None:
    assert list(read_choices({"x": given})[0].values) == values


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ("40 mm", "--vary x: '40 mm' is neither a range nor a list; write PATH=40..60 mm step 5 mm"),
        ("[40 mm]", "--vary x: there is one value only, and nothing to draw"),
        ("60..40 mm", "--vary x: the range does not increase from 60 to 40"),
        ("1 m..2 mm", "--vary x: the range begins in m and ends in mm; write one unit"),
        ("1..2 m step 1 N", "--vary x: the step is in N, the range in m; write one unit"),
        ("0..1 step 1e-9", "--vary x: 1000000001 values are more than 10000; take a larger step"),
        ("1..2 m step -1 m", "--vary x: the step -1 is not positive"),
        ("1..2 m step 0 m", "--vary x: the step 0 is not positive"),
    ],
)
def test_values_that_are_none(given: str, said: str) -> None:
    with pytest.raises(da.ModelError, match=re.escape(said)):
        read_choices({"x": given})


FORMS = "; write PATH=40..60 mm step 5 mm, or PATH=[400 N, 500 N, 600 N]"


def test_values_of_the_command_line() -> None:
    assert read_option("x = 3 ") == ("x", "3")
    assert read_option(" a.b =[1,2]") == ("a.b", "[1,2]")
    for text in ("x=", "x", "=3", " = "):
        with pytest.raises(da.ModelError, match=re.escape(f"--vary {text!r} names no values{FORMS}")):
            read_option(text)
    with pytest.raises(da.ModelError, match=re.escape(f"no number varies{FORMS}")):
        read_choices({})


def test_they_are_sound_different_and_the_same_for_a_seed() -> None:
    some = four_bar()
    drawn = [
        [
            v.values
            for v in da.variants(
                bracket(value=100, direction="30 deg"), {"loads.F.value": "100..200"}, 4, seed
            )
        ]
        for seed in (3, 3, 4)
    ]
    assert drawn[0] == drawn[1] != drawn[2]
    assert len({str(values) for values in drawn[0]}) == 4
    for v in some:
        assert v.result.ok.all()
        assert all(row.ok for row in check(v.mechanism))
        effort = next(k for k in v.key if k["quantity"] == "effort")
        again = da.solve(da.load(examples()["four_bar"]).with_values(v.values))
        assert float(effort["value"]) == pytest.approx(again.effort("O2")[0] / 0.1129848290276167, rel=1e-12)


def test_none_is_near_a_dead_centre() -> None:
    """Piston-driven, with its dead centres at 150 and 250 mm."""
    tree = da.slider_crank(crank=0.05, rod=0.2).to_tree()
    tree |= {"drives": {"guide": {"position": "0.2 m"}}, "assembly": {"crank": "80 deg"}}
    tree["loads"] = {"brake": {"type": "couple", "on": "crank", "value": "10 N*m"}}
    vary = {"drives.guide.position": [f"{x} mm" for x in (151, 200, 220, 249.9, 255)]}
    some = da.variants(da.mechanism(tree), vary, count=2, seed=1, ask=["effort.guide"])
    assert sorted(str(v.values["drives.guide.position"]) for v in some) == ["200 mm", "220 mm"]


def test_no_usual_mistake_stays_hidden() -> None:
    """At 45 degrees nobody can tell x from y: that angle is never drawn."""
    vary = {"loads.F.direction": "[20 deg, 30 deg, 45 deg, 60 deg, 70 deg]"}
    m = bracket(value=100, direction="30 deg")
    some = da.variants(m, vary, count=4, seed=1, ask=["reaction.O"])
    assert sorted(str(v.values["loads.F.direction"]) for v in some) == [
        "20 deg",
        "30 deg",
        "60 deg",
        "70 deg",
    ]
    said = (
        "4 of 5 variants were drawn from 5 sets of values, of 5 possible ones; rejected: 1 where no asked "
        "figure shows the mistake 'the angle is counted from the other axis: x and y are exchanged'"
    )
    with pytest.raises(da.ModelError, match=re.escape(said)):
        da.variants(m, vary, count=5, seed=1, ask=["reaction.O"])


def test_why_there_are_too_few_is_said_by_its_most_frequent_reasons() -> None:
    """Of 7 forces in two directions one is near zero, 100.1 N and 100.2 N are 100 N; half of them show no x for y, not
    most."""
    vary = {
        "loads.F.value": [1.0, 2.0, 90.0, 100.0, 100.1, 100.2, 110.0],
        "loads.F.direction": ["30 deg", "45 deg"],
    }
    said = (
        "8 of 12 variants were drawn from 14 sets of values, of 14 possible ones; rejected: 4 where the figures are "
        "those of another one; 2 where reaction of O on arm is near zero; give other values, or ask for fewer"
    )
    with pytest.raises(da.ModelError, match=f"^{re.escape(said)}$"):
        da.variants(bracket(value=100, direction="30 deg"), vary, count=12, seed=1, ask=["reaction.O"])


def test_values_that_make_no_problem_are_counted_with_the_others() -> None:
    """A coupler of 10 mm joins nothing; of 300 mm and of 300.1 mm they are one problem."""
    vary = {"links.coupler.points.B.0": [0.01, 0.011, 0.3, 0.3001, 0.4]}
    said = (
        "2 of 5 variants were drawn from 5 sets of values, of 5 possible ones; rejected: "
        "2 where the linkage does not close at this position, or the solver did not reach a closed pose; "
        "1 where the figures are those of another one; give other values, or ask for fewer"
    )
    m = da.four_bar(positions=1).with_values({"drives.O2.position": 1.0})
    with pytest.raises(da.ModelError, match=f"^{re.escape(said)}$"):
        da.variants(m, vary, count=5, seed=1, ask=["effort.O2"], static=True)


def test_no_figure_is_near_zero_and_none_is_there_twice() -> None:
    m = bracket(value=100, direction="30 deg")
    some = da.variants(
        m, {"loads.F.value": [1.0, 90.0, 100.0, 100.1, 110.0]}, count=3, seed=1, ask=["reaction.O"]
    )
    sizes = sorted(float(str(v.key[0]["value"]).split(" @ ")[0]) for v in some)
    assert np.round(sizes, -1).tolist() == [90.0, 100.0, 110.0]


def test_too_few_values() -> None:
    with pytest.raises(da.ModelError, match="the values allow 15 different problems, but 30 are requested"):
        four_bar(count=30)


def test_what_is_asked() -> None:
    some = four_bar(
        count=1,
        ask=["effort.O2", "reaction.A.crank", "reaction.B.x", "angle.rocker.speed", "point.coupler.P"],
    )
    rows = [(k["quantity"], k["of"], k.get("on"), k.get("component"), k["unit"]) for k in some[0].key]
    assert rows == [
        ("effort", "O2", None, None, "lbf*in"),
        ("reaction", "A", "crank", None, "lbf"),
        ("reaction", "B", "rocker", "x", "lbf"),
        ("speed", "rocker", None, None, "rad/s"),
        ("point", "coupler.P", None, None, "in"),
    ]
    with pytest.raises(
        da.ModelError, match=r"--ask efort.O2: unknown quantity 'efort'; did you mean 'effort'\?"
    ):
        four_bar(ask=["efort.O2"])


def test_the_question_sheet_says_nothing_of_the_answer() -> None:
    one = four_bar(count=1)
    r, asked = one[0].result, one.asked
    text = str(question_sheet(r, asked, "01"))
    assert text == str(question_sheet(falsified(r), asked, "01"))
    assert "Weights are divided by g = 386 in/s²" in text
    assert "Reaction of A on coupler, F_23  size ______________ lbf  direction ______________ °" in text
    numbers = {round(abs(float(x)), 2) for x in re.findall(r"\d+\.\d+|\d+", text)}
    sizes = {round(abs(float(str(k["value"]).split(" @ ")[0])), 2) for k in one[0].key}
    assert not numbers & sizes
    assert question_sheet(r, asked).sheet.blocks[-1] == Heading("Working", room=True)


def test_the_title_has_the_numbers_of_its_variant() -> None:
    """A force that the title states is that of the variant, in the title's unit; what does not vary stays."""
    m = bracket(value="300 N @ 90 deg").with_values({"title": "Bracket of 2 m, 0.3 kN"})
    found = da.variants(m, {"loads.F.value": ["400 N @ 90 deg", "0.6 kN @ 90 deg"]}, count=2, seed=1)
    titles = {v.name: v.mechanism.title for v in found}
    assert set(titles.values()) == {"Bracket of 2 m, 0.4 kN", "Bracket of 2 m, 0.6 kN"}
    for v in found:
        assert str(question_sheet(v.result, found.asked, v.name)).startswith(titles[v.name])


@pytest.mark.long
def test_the_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "exam"
    vary = [x for path, values in FOUR_BAR.items() for x in ("--vary", f"{path}={values}")]
    command = ["variants", str(examples()["four_bar"]), *vary, "--count", "2", "--seed", "3", "-o", str(out)]
    command += ["--ask", "effort.O2", "--tolerance", "3 %"]
    assert main(command) == 0
    assert {p.name for p in (out / "questions").iterdir()} == {"01.pdf", "01.html", "02.pdf", "02.html"}
    assert sorted(p.name for p in out.iterdir())[-1] == "variants.json"
    assert '<div class="working">' in (out / "questions" / "01.html").read_text(encoding="utf-8")
    assert main(["check", str(out / "problems")]) == 0
    rows = list(csv.DictReader((out / "key.csv").read_text(encoding="utf-8").splitlines()))
    assert [(r["variant"], r["file"], r["of"], r["tolerance"]) for r in rows] == [
        ("01", "problems/01.yaml", "O2", "3 %"),
        ("02", "problems/02.yaml", "O2", "3 %"),
    ]
    assert json.loads((out / "key.json").read_text(encoding="utf-8"))[1]["value"] == rows[1]["value"]
    blank = (out / "answers" / "02.csv").read_text(encoding="utf-8").splitlines()[1]
    assert blank == "02,effort,O2,,,,,,,lbf*in"
    capsys.readouterr()
    assert main(command) == 2
    assert "has files; name another folder, or overwrite: --force" in capsys.readouterr().err
    (out / "notes.txt").write_text("mine", encoding="utf-8")
    assert main([*command, "--force"]) == 2
    assert "has notes.txt, which would be lost" in capsys.readouterr().err


def test_a_folder_is_there_whole_or_not_at_all(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    some, out = four_bar(count=1, ask=["effort.O2"]), tmp_path / "exam"
    write = exam_folder._write_key

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(exam_folder, "_write_variant", lambda *_: ReportSheet("Question"))
    monkeypatch.setattr(exam_folder, "_write_key", interrupted)
    with pytest.raises(KeyboardInterrupt):
        some.save(out)
    assert list(tmp_path.iterdir()) == []
    monkeypatch.setattr(exam_folder, "_write_key", write)
    some.save(out)
    before = (out / "key.csv").stat().st_ino
    monkeypatch.setattr(exam_folder, "_write_key", interrupted)
    with pytest.raises(KeyboardInterrupt):
        some.save(out, overwrite=True)
    assert (out / "key.csv").stat().st_ino == before
    monkeypatch.setattr(exam_folder, "_write_key", write)
    some.save(out, overwrite=True)
    assert [p.name for p in tmp_path.iterdir()] == ["exam"]
    assert (out / "key.csv").stat().st_ino != before


@pytest.mark.long
@pytest.mark.skipif(importlib.util.find_spec("trimesh") is None, reason="extra cad")
def test_meshes_go_with_the_problems(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "parts").mkdir()
    box_mesh(tmp_path / "parts" / "box.stl")
    tree = bracket(value=100, direction="30 deg").to_tree()
    shape = {"type": "mesh", "file": "parts/box.stl", "density": "7850 kg/m^3"}
    tree["links"]["arm"] = {"points": {"O": [0, 0], "P": [2, 0]}, "shape": shape}
    (tmp_path / "arm.json").write_text(json.dumps(tree), encoding="utf-8")
    m = da.load(tmp_path / "arm.json")
    some = da.variants(m, {"loads.F.value": "100..200"}, count=2, seed=1, ask=["reaction.O"])
    monkeypatch.setitem(exam_folder.PARTS, "questions", ())
    monkeypatch.setitem(exam_folder.PARTS, "solutions", ())
    some.save(tmp_path / "exam")
    some.save(tmp_path / "exam", overwrite=True)
    assert da.load(tmp_path / "exam" / "problems" / "02.yaml").mass("arm") == m.mass("arm")


def test_a_key_has_the_letters_of_the_file(tmp_path: Path) -> None:
    m = bracket(value=100, direction="30 deg").with_values({"title": "Öse"})
    da.variants(m, {"loads.F.value": [80.0, 100.0]}, count=2, seed=1, ask=["reaction.O"]).save(tmp_path / "e")
    text = (tmp_path / "e" / "variants.json").read_text(encoding="utf-8")
    assert "Öse" in text


ENGINE = """
dalembert: 1
title: Engine
units: {length: mm, force: N, mass: kg, time: s, angle: deg}
gravity: none
parameters: {p: 1.2 MPa, bore: 100 mm}
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [50, 0]}, mass: 1, center: 20 @ 180, inertia: 0.01 kg*m^2}
  rod: {points: {A: [0, 0], B: [200, 0], C: {from: center, at: 30 @ 90}}, mass: 2, center: [80, 0]}
  piston: {points: {B: [0, 0]}, mass: 1.5}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, piston]}
  guide: {type: slider, links: [ground, piston], at: [O, B], direction: 0}
drives: {O: {position: 320 deg, speed: 300 rpm}}
loads:
  gas: {type: force, on: piston, at: B, value: ["-p*pi*bore^2/4", 0]}
  side: {type: force, on: rod, at: C, value: 100 @ 330}
  drag: {type: couple, on: rod, value: 2 N*m}
assembly: {rod: 10}
"""


def test_a_question_states_the_data_as_the_file_does(tmp_path: Path) -> None:
    """Its units, angles and letters, also of a value that replaces another; the figure has no product of letters."""
    (tmp_path / "engine.yaml").write_text(ENGINE, encoding="utf-8")
    m = da.load(tmp_path / "engine.yaml").with_values({"drives.O.speed": "400 rpm"})
    r = da.dynamics(m)
    exam = ExamText("ME 301", "Read all.\n\nThen begin.", {"effort.O": 4, "reaction": 2})
    asked = [da.Answer(quantity="effort", of="O"), da.Answer(quantity="reaction", of="B", on="piston")]
    sheet = question_sheet(r, asked, "07", exam=exam).sheet
    cells = [cell for b in sheet.blocks if isinstance(b, SheetTable) for row in b.rows for cell in row]
    for text in (
        "320°, 400 rpm",
        "20 ∠ 180°",
        "0.01 kg·m²",
        "(−p·π·bore²/4, 0) on 4 piston at B",
        "100 N ∠ 330° on 3 rod at C",
        "2 N·m on 3 rod",
        "A (0, 0); B (200, 0); C 30 ∠ 90° from centre",
    ):
        assert text in cells
    said = " ".join(b.text for b in sheet.blocks if isinstance(b, Paragraph))
    assert "Read all. Then begin." in said
    assert "Lengths (mm): OA = 50, AB = 200." in said
    (figure,) = (b.scenes[0] for b in sheet.blocks if isinstance(b, Drawings))
    drawn = " ".join(item.text for item in figure.items if hasattr(item, "text"))
    assert "side = 100 N" in drawn
    assert "gas = " not in drawn
    (questions,) = (b.rows for b in sheet.blocks if isinstance(b, Blanks) and len(b.rows) == 2)
    assert [words for words, _ in questions] == [
        "Driving torque at O, $T_{12}$ (4 marks)",
        "Reaction of B on piston, $F_{34}$ (2 marks)",
    ]
    assert sheet.subtitle == "ME 301 · Variant 07"


@pytest.mark.long
def test_marks_stand_on_the_key_and_every_question_in_one_file(tmp_path: Path) -> None:
    pytest.importorskip("typst")
    some, out = four_bar(ask=["effort.O2", "reaction.A"]), tmp_path / "exam"
    with pytest.raises(da.ModelError, match="no question is named 'efort'; did you mean 'effort'"):
        some.save(out, marks={"efort": 4})
    some.save(out, course="ME 301", marks={"effort": 4, "default": 2})
    with (out / "key.csv").open(encoding="utf-8") as file:
        assert [row["marks"] for row in csv.DictReader(file)] == ["4", "2"] * 2
    for name in ("questions.pdf", "key.pdf"):
        assert (out / name).read_bytes().startswith(b"%PDF")
    values = {v.name: [figure(v.result, a) for a in some.asked] for v in some}
    sheet = key_sheet(some[0].result, values, some.asked, ExamText(marks={"effort": 4})).sheet
    questions, answers = (b for b in sheet.blocks if isinstance(b, SheetTable))
    assert (questions.words, answers.words) == (True, True)
    assert [row[0] for row in questions.rows] == ["1", "2"]
    size, angle = some[1].key[1]["value"].split(" @ ")
    assert answers.rows[1][2] == f"{float(size):.4g} ∠ {float(angle):.2f}°".replace("-", "−")
    some.save(out, overwrite=True)


@pytest.mark.parametrize("weights", [["-1 lbf", "8 lbf", "9 lbf"], ["8 lbf", "9 lbf", "-1 lbf"]])
def test_values_that_no_problem_may_have_are_refused_at_both_ends(weights: list[str]) -> None:
    with pytest.raises(da.ModelError, match="weight"):
        four_bar(vary={"links.coupler.weight": weights})
