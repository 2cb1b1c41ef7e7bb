"""A class marked: known mistakes named, follow-through by hand, hostile sheets, files that appear whole."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import openpyxl
import pytest

import dalembert as da
from dalembert.answer.labelled import column_arrays
from dalembert.bundled import cases, examples
from dalembert.cli import main
from dalembert.grading.marking import marks_tabs
from dalembert.grading.marking.grade import ClassMarks
from dalembert.grading.marking.rubric import Rubric, read_rubric
from dalembert.grading.marking.student_marks import Mark, StudentMarks
from tests.grading.made_class import named_rate, write_class, write_variants
from tests.tiers import tiers

BUNDLED = cases() | examples()
COUNT = 8
STATIC = "seed-002-3-four-link-three-forces"
MADE = {
    "four_bar": ("loads.T_4.value", [8.0, 12.0, 16.0]),
    STATIC: ("drives.A.position", [0.9, 1.1]),
    "seed-002-7a-engine-friction-circles": ("drives.O.position", [0.7, 0.8, 0.9]),
}


@pytest.mark.parametrize("name", tiers([], sorted(MADE)[1:2], [*sorted(MADE)[:1], *sorted(MADE)[2:]]))
def test_known_mistakes_of_a_class_are_named_and_true_sheets_have_all_marks(
    name: str, tmp_path: Path
) -> None:
    """In 95 %; a whole class is measured by `benchmarks/grading.py`."""
    path, values = MADE[name]
    key = write_variants(tmp_path / "exam", da.load(BUNDLED[name]), path, values)
    students = write_class(tmp_path / "answers", key, COUNT, 3)
    marks = da.grade(tmp_path / "answers", key)
    assert [s.problems for s in marks.students] == [[]] * COUNT
    assert named_rate(marks, students) >= 0.95
    right = {s.name for s in students if not s.mistake}
    assert right
    assert all(s.total == s.most for s in marks.students if s.student in right)


def marked(tmp_path: Path, text: str, key: Any = None, name: str = "ann.yaml", **more: Any) -> Any:
    folder = tmp_path / "answers"
    folder.mkdir(exist_ok=True)
    (folder / name).write_text(text, encoding="utf-8")
    return da.grade(folder, BUNDLED[STATIC] if key is None else key, **more).students[0]


KEY = """variant,file,quantity,of,on,value,unit,marks
01,,effort,O2,,243.2376,lbf*in,4
01,,reaction,A,coupler,154.8052 @ -139.678,lbf,2
02,,effort,O2,,-27.5,N*m,
"""


def key_of(folder: Path, m: Any, **asked: str) -> Path:
    """A key that asks of a model file: quantity=names."""
    m.save(folder / "m.yaml", overwrite=True)
    rows = [f"1,m.yaml,{quantity},{name}\n" for quantity, names in asked.items() for name in names.split()]
    path = folder / "own.csv"
    path.write_text("variant,file,quantity,of\n" + "".join(rows), encoding="utf-8")
    return path


@pytest.fixture
def key(tmp_path: Path) -> Path:
    path = tmp_path / "key.csv"
    path.write_text(KEY, encoding="utf-8")
    return path


def test_what_one_mistake_costs_is_a_part_of_the_largest_sheet(tmp_path: Path, key: Path) -> None:
    rubric = read_rubric({"cap": 0.25})
    marked(tmp_path, "variant: 2\nefforts: {O2: -27.5}\n", key, "a.yaml")
    marked(tmp_path, "variant: 1\nefforts: {O2: 3}\n", key, "b.yaml")
    marks = da.grade(tmp_path / "answers", key, rubric)
    assert [s.most for s in marks.students] == [1.0, 6.0]
    assert marks.text().endswith("One mistake costs at most 1.5 of 6 marks.")
    assert ClassMarks([], rubric).text().endswith("One mistake costs at most 0 of 0 marks.")


def outcomes(student: Any) -> list[tuple[str, float]]:
    return [(m.outcome, m.marks) for m in student.marks]


def cross(a: Any, b: Any) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


def test_a_figure_right_for_own_earlier_figures_counts(tmp_path: Path) -> None:
    """The force in B of a student's own; the crank's torque and bearing from it by hand: lever arm times force."""
    m = da.load(BUNDLED[STATIC])
    crank, angle = 0.5, math.radians(60)
    own = np.array([-90.0, -150.0])  # on the coupler, by the crank
    load = 80 * np.array([math.cos(math.radians(73.5)), math.sin(math.radians(73.5))])
    arm = np.array([math.cos(angle), math.sin(angle)])
    torque = -(crank * cross(arm, -own) + 0.325 * cross(arm, load))
    bearing = own - load
    r = da.statics(m)
    assert abs(torque - float(r.effort("A")[0])) > 1
    text = f"""
efforts: {{A: {torque:.4g}}}
reactions:
  A: [{bearing[0]:.5g}, {bearing[1]:.5g}]
  B: [{own[0]}, {own[1]}]
"""
    key = key_of(tmp_path, m, effort="A", reaction="A B C D")
    student = marked(tmp_path, text, key)
    by = {m.quantity: m for m in student.marks}
    assert by["effort of A"].outcome == "follow_through"
    assert by["effort of A"].sentence == "right with your own figures, by the moments about A on crank"
    assert sorted(by[f"reaction of {j}"].outcome for j in "AB") == ["follow_through", "unknown"]
    wrong = f"efforts: {{A: {1.1 * torque:.4g}}}\nreactions:\n  B: [{own[0]}, {own[1]}]\n"
    assert "follow_through" not in {m.outcome for m in marked(tmp_path, wrong, key).marks}


def test_own_accelerations_are_followed(tmp_path: Path) -> None:
    """The rocker's angular acceleration of a student's own: the effort of virtual work, half of it more inertia."""
    m = da.load(BUNDLED["four_bar"])
    r = da.dynamics(m)
    alpha, share = float(r.acceleration("rocker")[0]), float(r.speed("rocker")[0] / r.speed("crank")[0])
    own = alpha + 400.0
    effort = float(r.effort("O2")[0]) + m.inertia("rocker") * 400.0 * share
    text = f'accelerations: {{rocker: "{own:.6g} rad/s^2"}}\nefforts: {{O2: "{effort:.6g} N*m"}}\n'
    student = marked(tmp_path, text, key_of(tmp_path, m, acceleration="rocker", effort="O2"))
    assert [m.outcome for m in student.marks] == ["unknown", "follow_through"]


def test_a_mistake_that_runs_through_a_sheet_is_charged_once(tmp_path: Path) -> None:
    m = da.load(BUNDLED[STATIC])
    wrong = da.statics(m.with_values({"loads.F3.at": "C"}))
    figures = [f"  {j}: [{x:.6g}, {y:.6g}]" for j in "ABCD" for x, y in wrong.reaction(j)]
    text = "\n".join([f"efforts: {{A: {float(wrong.effort('A')[0]):.6g}}}", "reactions:", *figures])
    key = key_of(tmp_path, m, effort="A", reaction="A B C D")
    student = marked(tmp_path, text, key)
    assert {m.outcome for m in student.marks} == {"datum"}
    assert student.total == 0.75 * 5
    same = "the moment arm of F3 is wrong: the load is applied at C, or the moment of F3 about C is left out"
    assert {m.sentence for m in student.marks} == {same}
    strict = read_rubric({"share": {"follow_through": 0}, "mistakes": {"moment arm": 0.25}})
    again = da.grade(tmp_path / "answers", key, strict).students[0]
    assert again.total == sum({"datum": 0.25, "right": 1.0}.get(m.outcome, 0.0) for m in again.marks)


def test_a_key_alone_names_slips_and_gives_its_marks(tmp_path: Path, key: Path) -> None:
    text = 'variant: "1"\nefforts: {O2: -243.2}\nreactions: {A: 154.8 @ 220.32}\n'
    assert outcomes(marked(tmp_path, text, key)) == [("sign", 2.0), ("right", 2.0)]
    assert outcomes(marked(tmp_path, "variant: 1\nreactions: {A: 154.8}\n", key)) == [
        ("missing", 0.0),
        ("right", 1.0),
    ]
    other = marked(tmp_path, "variant: 02\nefforts: {O2: -27.5 kN*m}\n", key)
    assert outcomes(other) == [("unit", 0.5)]
    bare = marked(tmp_path, "variant: 2\nefforts: {O2: -27.5}\n", key)
    assert outcomes(bare) == [("right", 1.0)]


def test_two_sheets_of_one_student_are_both_marked_and_said(tmp_path: Path, key: Path) -> None:
    marked(tmp_path, "student: Ann\nvariant: 1\nefforts: {O2: 243.2}\n", key, "a.yaml")
    marked(tmp_path, "student: Ann\nvariant: 1.0\nefforts: {O2: 1}\n", key, "b.yaml")
    first, second = da.grade(tmp_path / "answers", key).students
    assert (first.total, second.total, first.problems) == (4, 0, [])
    assert second.problems[0].endswith("b.yaml:1: there is another sheet of Ann")


def test_the_student_states_no_tolerance(tmp_path: Path, key: Path) -> None:
    text = (
        "variant: 1\ntolerance: 50 %\nanswers:\n- {quantity: effort, of: O2, value: 200, tolerance: 50 %}\n"
    )
    assert outcomes(marked(tmp_path, text, key))[0] == ("unknown", 0.0)
    assert outcomes(marked(tmp_path, text, key, tolerance="30 %"))[0] == ("right", 4.0)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "variant: 1\nefforts: {O2: =1+1}\n",
            "ann.yaml:2: effort O2: '=1+1' has no reading: it is read by hand",
        ),
        ("variant: 1\nefforts: {O2: .nan}\n", "ann.yaml:2: value: nan is not a finite number"),
        (
            "variant: 1\nefforts: {O2: about ten}\n",
            "ann.yaml:2: effort O2: 'about ten' has no reading: it is read by hand",
        ),
        ("variant: 1\nefforts: {O2: [1, 2]}\n", "ann.yaml:2: "),
        ("variant: 1\nefforts: {O2: {x: 1}}\n", "ann.yaml:2: "),
    ],
)
def test_figures_that_are_none_are_sentences(text: str, said: str, tmp_path: Path, key: Path) -> None:
    student = marked(tmp_path, text, key)
    assert (student.marks[0].outcome, student.waiting, student.most) == ("waits", 1, 2.0)
    assert said in student.marks[0].sentence + " ".join(student.problems)


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("a.yaml", "variant: 9\nefforts: {O2: 1}\n", "a.yaml:1: unknown variant '9'"),
        ("a.yaml", "efforts: {O2: 1}\n", "a.yaml:1: the sheet does not say its variant"),
        ("a.yaml", "efforts: [1\n", "a.yaml:"),
        ("a.yaml", "variant: 1\nefforts: 3\n", "a.yaml:2: efforts needs names"),
        ("a.yaml", "variant: 1\nefforts: {O9: 3}\n", "a.yaml:2: effort O9: not asked"),
        ("a.csv", "", "a.csv:1: the table has no rows"),
        (
            "a.csv",
            "student,quantity,of,value\nx,effort,O2,1\n",
            "a.csv:2: the sheet does not say its variant",
        ),
        ("a.csv", 'student,"quantity\n', "a.csv:"),
        ("a.csv", "x" * 10_000_001, "more than 10000000 bytes"),
    ],
)
def test_sheets_that_cannot_be_read_are_sentences(
    name: str, text: str, said: str, tmp_path: Path, key: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    student = marked(tmp_path, text, key, name)
    assert said in " ".join(student.problems)
    assert main(["grade", str(tmp_path / "answers"), "--key", str(key)]) == 1
    assert said in capsys.readouterr().err


def test_a_table_with_a_row_a_student(tmp_path: Path, key: Path) -> None:
    """As spreadsheets save it: semicolons, a mark at the beginning, headings with units."""
    text = "\ufeffstudent;variant;effort.O2 [lbf*in];reaction.A.coupler\n"
    text += "ann;1;243.2;154.8 @ 220.32\nbob;2;-27.5 N*m;\n;1;-243.2;\n"
    path = tmp_path / "class.csv"
    path.write_text(text, encoding="utf-8")
    ann, bob, third = da.grade(path, key).students
    assert (ann.student, outcomes(ann)) == ("ann", [("right", 4.0), ("right", 2.0)])
    assert (bob.student, outcomes(bob)) == ("bob", [("right", 1.0)])
    assert (third.student, outcomes(third)) == ("row 4", [("sign", 2.0), ("missing", 0.0)])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("variant,file,quantity,of\n1,../m.yaml,effort,O2\n", ":2: '../m.yaml' is outside the key's folder"),
        ("variant,quantity,of\n1,effort,O2\n", ":2: the figure has neither a value nor a model file"),
        ("variant,quantity,of,value,unit\n1,effort,O2,abc,N*m\n", ":2: "),
        ("variant,quantity,of,value,unit\n1,effort,O2,1,lbx\n", ":2: "),
        ("variant,quantity,of,value,marks\n1,effort,O2,1,many\n", ":2: 'many' is not a number of marks"),
        ("variant,quantity,of,value\n1,efort,O2,1\n", ":2: unknown quantity 'efort'"),
        (
            "variant,file,quantity,of,value,unit\n1,m.yaml,effort,A,30,N*m\n",
            ":2: effort of A is 30 N*m in the key",
        ),
    ],
)
def test_what_is_wrong_with_a_key_is_said_with_its_line(text: str, said: str, tmp_path: Path) -> None:
    da.load(BUNDLED[STATIC]).save(tmp_path / "m.yaml")
    path = tmp_path / "key.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(da.ModelError) as caught:
        marked(tmp_path, "variant: 1\nefforts: {O2: 3}\n", path)
    assert f"{path}{said}" in str(caught.value)


@pytest.mark.parametrize(
    ("tree", "said"),
    [
        ({"mark": 3}, "unknown key 'mark'; did you mean 'marks'?"),
        ({"share": {"signs": 1}}, "share has no entry 'signs'"),
        ({"share": {"sign": 2}}, "2 is not a number from 0 to 1"),
        ({"marks": {"effort": float("nan")}}, "is not a number from 0 to 1e+06"),
        ({"tolerance": "many"}, "'many' is not a tolerance in percent"),
    ],
)
def test_rubrics_that_are_wrong(tree: dict[str, Any], said: str) -> None:
    with pytest.raises(da.ModelError) as caught:
        read_rubric(tree)
    assert said in str(caught.value)


def test_what_is_written(tmp_path: Path, key: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Text that looks like a formula stays text; what exists is kept."""
    folder, book, feedback = tmp_path / "answers", tmp_path / "marks.xlsx", tmp_path / "feedback"
    sheet = 'student: "=1+1"\nvariant: 1\nefforts: {O2: "=HYPERLINK(1)"}\nreactions: {A: 154.8 @ 220.32}\n'
    marked(tmp_path, sheet, key)
    command = ["grade", str(folder), "--key", str(key), "-o", str(book), "--feedback", str(feedback)]
    assert main(command) == 1  # a cell waits
    assert "'=HYPERLINK(1)' has no reading: it is read by hand" in capsys.readouterr().err
    sheets = openpyxl.load_workbook(book)
    cells = [cell for sheet in sheets for row in sheet.iter_rows() for cell in row]
    assert not [cell for cell in cells if cell.data_type == "f"]
    rows = list(sheets["marks"].values)
    assert rows[0][:5] == ("student", "variant", "marks", "of", "percent")
    assert rows[1][:5] == ("=1+1", "01", 2, 2, 100)
    text = (feedback / "1-1.md").read_text(encoding="utf-8")
    assert text.startswith("# =1+1\n\nVariant 01.\n\n2 of 2 marks, 1 waits.\n")
    assert "- Reaction of A on coupler (2 of 2): you have 154.8 lbf @ 220.32; right.\n" in text
    assert "effort O2: '=HYPERLINK(1)' has no reading: it is read by hand" in text
    before = book.read_bytes()
    assert main(command) == 2
    assert f"{book} exists" in capsys.readouterr().err
    assert main([*command[:4], *command[6:]]) == 2
    assert f"{feedback} has files" in capsys.readouterr().err
    assert book.read_bytes() == before
    assert main([*command, "--force"]) == 1


def test_an_interruption_leaves_nothing(tmp_path: Path, key: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    marked(tmp_path, "variant: 1\nefforts: {O2: 1}\n", key)
    marks = da.grade(tmp_path / "answers", key)
    before = sorted(tmp_path.rglob("*"))

    def interrupted(*_: Any) -> Any:
        raise KeyboardInterrupt

    monkeypatch.setattr(marks_tabs, "_rubric", interrupted)
    with pytest.raises(KeyboardInterrupt):
        marks.to_xlsx(tmp_path / "marks.xlsx")
    monkeypatch.setattr(Path, "rename", interrupted)
    with pytest.raises(KeyboardInterrupt):
        marks.save_feedback(tmp_path / "feedback")
    assert sorted(tmp_path.rglob("*")) == before


def test_the_mistakes_of_most_students_are_printed() -> None:
    said = {"ann": "first", "ben": "first", "cem": "second"}
    students = [
        StudentMarks(n, "", "", [Mark("", "", "", "sign", words, 0.5, 1)]) for n, words in said.items()
    ]
    for most, named in ((None, ["first", "second"]), (1, ["first"]), (2, ["first", "second"])):
        _, mistakes = marks_tabs.marks_parts(students, most)
        assert [row[0] for row in mistakes.rows] == named


def test_marks_as_arrays_are_rows_of_texts_and_what_is_missing_is_empty() -> None:
    marks = ClassMarks(
        [StudentMarks("ann", "", "a.csv", [Mark("effort", "3", "", "missing", "", 0.0, 1.0)])], Rubric()
    )
    data, rows = column_arrays(marks, marks.scale("SI"), "ground")
    dimension, texts, _ = data["line"]
    assert (dimension, texts.tolist()) == ("row", [""])
    assert (data["student"][1].tolist(), rows["row"].tolist()) == (["ann"], [1])


@pytest.mark.parametrize(
    ("asked", "given", "outcome"),
    [
        ("2", "2", "right"),
        ("2", "", "right"),
        ("2", "60 deg", "right"),
        ("60 deg", "2", "right"),
        ("60 deg", "60.0 deg", "right"),
        ("60 deg", "1.047197551 rad", "right"),
        ("60 deg", "", "right"),
        ("2", "0 deg", "missing"),
        ("2", "1", "missing"),
        ("2", "70 deg", "missing"),
        ("60 deg", "3", "missing"),
    ],
)
def test_a_position_is_the_same_by_its_number_and_by_the_value_of_its_drive(
    asked: str, given: str, outcome: str, tmp_path: Path
) -> None:
    m = da.four_bar().with_values({"drives.O2.position": ["0 deg", "60 deg", "120 deg"]})
    m.save(tmp_path / "m.yaml")
    (tmp_path / "key.csv").write_text(f"quantity,of,at,file\neffort,O2,{asked},m.yaml\n")
    effort = float(da.dynamics(m).effort("O2")[1])
    (tmp_path / "ann.csv").write_text(
        f"student,quantity,of,at,value\nann,effort,O2,{given},{effort:.6g} N*m\n"
    )
    (student,) = da.grade(tmp_path / "ann.csv", tmp_path / "key.csv").students
    assert [mark.outcome for mark in student.marks] == [outcome]
    assert [problem.endswith(": not asked") for problem in student.problems] == [True] * (
        outcome == "missing"
    )


@pytest.mark.parametrize(("at", "outcome"), [("60 deg", "right"), ("2", "missing"), ("61 deg", "missing")])
def test_without_a_problem_a_position_is_the_one_that_the_key_names(
    at: str, outcome: str, tmp_path: Path
) -> None:
    """A key that is a table alone knows no drive: its words for a position are compared as they are."""
    key = [{"quantity": "effort", "of": "O2", "at": "60 deg", "value": 243.2, "unit": "lbf*in", "marks": 4}]
    found = marked(tmp_path, f"- {{quantity: effort, of: O2, at: {at}, value: 243.2 lbf*in}}", key)
    assert [m.outcome for m in found.marks] == [outcome]
    assert (found.total, found.most) == (4.0 if outcome == "right" else 0.0, 4.0)
