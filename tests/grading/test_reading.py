"""What people write is read, what has two readings is listed, and what has none waits for the teacher."""

from __future__ import annotations

import json
import math
import re
import zipfile
from pathlib import Path
from typing import Any

import openpyxl
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.cli import main
from dalembert.errors import ModelError
from dalembert.grading.answer_sheet import read_sheet
from dalembert.grading.marking import table_files
from dalembert.grading.marking.figure_names import FigureNames, columns_of
from dalembert.grading.marking.table_files import read_table
from dalembert.grading.written_figure import decimal_comma, read_written, readings_of

FOUR_BAR = examples()["four_bar"]

WRITTEN: dict[str, list[Any]] = {
    "41,03": ["41.03"],
    "41.030": ["41.030"],
    "1,234": ["1.234", "1234"],
    "1.234": ["1.234"],
    "1.234,5": ["1234.5"],
    "1,234.5": ["1234.5"],
    "1 234,5 N": ["1234.5 N"],
    "12.5.3": [],
    "1,23,456": [],
    "5 5": [],
    "1e400": [],
    "nan": [],
    "\u0663": [],
    "=1+1": [],
    "3 or 4": [],
    "see page 2": [],
    "1,2*10^3 N": ["1.2e3 N"],
    "316.4 @ -163 N": ["316.4 N @ -163"],
    "344,6 \u2220 -164,8\u00b0": ["344.6 @ -164.8 deg"],
    "559 N at -60.4\u00b0": ["559 N @ -60.4 deg"],
    "450.7 / -168.9": ["450.7 @ -168.9"],
    "155 < 40": ["155 @ 40"],
    "155 N, angle 220\u00b0": ["155 N @ 220 deg"],
    "713.3 N, -158.55\u00b0": ["713.3 N @ -158.55 deg"],
    "155 N @ 0.7 rad": ["155 N @ 0.7 rad"],
    "-559 @ 119.5": ["559 @ 299.5"],
    "-559 @ 1 rad": ["559 @ 4.14159265358979 rad"],
    "155 @ 40 cw": ["155 @ -40"],
    "1 @ 2 @ 3": [],
    "11.84 Nm ccw": ["11.84 N*m"],
    "11.84 N\u00b7m cw": ["-11.84 N*m"],
    "-44.2 ccw": ["-44.2", "44.2"],
    "12 N\u00b7m\u21bb": ["-12 N*m"],
    "12 N\u00b7m(ccw)": ["12 N*m"],
    "\u221244.2": ["-44.2"],
    "about 31.48": ["31.48"],
    "12 lb-in": ["12 lbf*in"],
    "3 ft lb": ["3 ft*lbf"],
    "12 apples": [],
    "[229, -496]": [["229", "-496"]],
    "229 i - 496 j": [["229", "-496"]],
    "(229; -496) N": [["229 N", "-496 N"]],
    "229,5; -496,1": [["229.5", "-496.1"]],
    "Fx = 229 N, Fy = -496 N": [["229 N", "-496 N"]],
    "[229,5, 3,5]": [["229.5", "3.5"]],
    "[1, 2, 3]": [["1", "2", "3"]],
    "9" * 201: [],
}


@pytest.mark.parametrize("text", WRITTEN)
def test_a_cell_has_the_readings_that_a_person_would_give_it(text: str) -> None:
    assert list(read_written(text).readings) == WRITTEN[text]


LISTED: list[tuple[Any, list[Any], list[Any]]] = [
    ([1, "2 N"], [["1 N", "2 N"]], [[1, "2 N"]]),
    (["1,5", "2,5"], [["1.5", "2.5"]], [["1.5", "2.5"]]),
    ((3.5, -4), [["3.5", "-4"]], [[3.5, -4]]),
    (["?", 2], [], []),
    (["1,234", 2], [["1.234", "2"], ["1234", "2"]], []),
    ("[229,496,3]", [["229", "496", "3"]], [["229", "496", "3"]]),
    ("(229,-49) N", [["229 N", "-49 N"]], [["229 N", "-49 N"]]),
    ("155 @ 40 deg N deg", [], ["155 @ 40 deg N deg"]),
]
"""Lists and what is written like them: their readings as a cell, and as a value of a file."""


@pytest.mark.parametrize(("value", "cell", "of_file"), LISTED, ids=str)
def test_a_list_is_read_part_by_part(value: Any, cell: list[Any], of_file: list[Any]) -> None:
    assert list(read_written(value).readings) == cell
    assert list(readings_of(value).readings) == of_file


def test_the_table_tells_whether_a_comma_is_a_decimal_mark() -> None:
    assert read_written("1,234", True).readings == ("1.234",)
    assert read_written("1.234", True).readings == ("1234", "1.234")
    assert read_written("1,234", False).readings == ("1234", "1.234")
    assert decimal_comma(["1,234", "12"]) is None
    assert decimal_comma(["0,123"]) is True


@pytest.mark.parametrize("text", ["-", "", " n/a", "no time", "?", "\u2014"])
def test_what_says_nothing_is_no_answer(text: str) -> None:
    assert read_written(text).blank


NAMES = FigureNames.of(da.load(FOUR_BAR), ())


@pytest.mark.parametrize(
    ("text", "keys"),
    [
        ("F23", {"quantity": "reaction", "of": "A", "on": "coupler"}),
        ("F_{32} [lbf]", {"quantity": "reaction", "of": "A", "on": "crank"}),
        ("F23x", {"quantity": "reaction", "of": "A", "on": "coupler", "component": "x"}),
        ("T12", {"quantity": "effort", "of": "O2"}),
        ("F13", None),
        ("Force at A", {"quantity": "reaction", "of": "A"}),
        ("A magnitude", {"quantity": "reaction", "of": "A", "component": "magnitude"}),
        ("force in pin b (direction)", {"quantity": "reaction", "of": "B", "component": "direction"}),
        ("Driving torque (N m)", {"quantity": "effort", "of": "O2"}),
        ("reaction.A.x", {"quantity": "reaction", "of": "A", "component": "x"}),
        ("A.x", {"quantity": "reaction", "of": "A", "component": "x"}),  # a point, and no name of the program
        ("F23.x", {"quantity": "reaction", "of": "A", "on": "coupler", "component": "x"}),
        (
            "reaction.A.crank.magnitude",
            {"quantity": "reaction", "of": "A", "on": "crank", "component": "magnitude"},
        ),
        ("question.7", None),
        ("torque at B", None),
        ("Response 1", None),
    ],
)
def test_figures_are_known_by_the_names_of_sheets(text: str, keys: dict[str, str] | None) -> None:
    assert NAMES.keys(text) == keys


def right() -> tuple[str, float, float]:
    """Effort of O2 and the force at A on the coupler of the four-bar example, in its units: size, direction."""
    r = da.dynamics(da.load(FOUR_BAR))
    x, y = r.reaction("A", on="coupler")[0]
    size = math.hypot(x, y) / 4.4482216152605
    return f"{r.effort('O2')[0] / 0.1129848290276167:.5g}", size, math.degrees(math.atan2(y, x))


def write_form(path: Path, rows: list[list[str]]) -> Path:
    book = openpyxl.Workbook()
    for row in rows:
        book.active.append(row)
    book.save(path)
    return path


def test_the_export_of_a_form_is_graded_in_one_command(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    torque, size, angle = right()
    comma = torque.replace(".", ",")
    heads = ["Timestamp", "First name", "Surname", "Response 1", "F23 size", "F23 direction"]
    rows = [
        heads,
        [
            "2026-11-23 10:00",
            "Ann",
            "Lee",
            comma,
            f"{size:.5g}".replace(".", ","),
            f"{angle:.5g}".replace(".", ","),
        ],
        ["2026-11-23 10:01", "Bo", "Ek", f"about {torque} lbf in ccw", "no time", ""],
        ["2026-11-23 10:02", "Cy", "Ruiz", "see page 2", f"{size:.5g}", f"{angle:.5g}"],
    ]
    form = write_form(tmp_path / "form.xlsx", rows)
    command = ["grade", str(form), "--key", str(FOUR_BAR)]
    assert main(command) == 2
    assert "form.xlsx:1: no figure is known by the heading 'Response 1'" in capsys.readouterr().err
    meaning = {"Response 1": "effort.O2"}
    ann, bo, cy = da.grade(form, FOUR_BAR, columns=meaning).students
    assert [m.outcome for m in ann.marks].count("right") == 2
    assert [(m.outcome, m.sentence) for m in bo.marks if m.outcome == "right"] == [
        ("right", "written as about")
    ]
    assert cy.waiting == 1
    assert cy.problems == [f"{form}:4: Response 1: 'see page 2' has no reading: it is read by hand"]
    decisions = tmp_path / "read.csv"
    decisions.write_text(f"student,figure,value\nCy Ruiz,Response 1,{torque}\n", encoding="utf-8")
    assert main([*command, "--columns", "Response 1=effort.O2", "--decide", str(decisions)]) == 0
    assert "One mistake costs at most" in capsys.readouterr().out


def test_two_readings_are_listed_and_the_nearer_counts(tmp_path: Path) -> None:
    key = [{"quantity": "effort", "of": "O2", "value": 1234, "unit": "N*m"}]
    table = tmp_path / "class.csv"
    table.write_text('student,effort.O2\nAnn,"1,234"\nBo,T12 = 1234\nCy,M = 1234\n', encoding="utf-8")
    ann, bo, cy = da.grade(table, key).students
    assert (ann.total, ann.waiting) == (1.0, 0)
    assert ann.problems == [
        f"{table}:2: effort.O2: '1,234' may be 1.234 or 1234: 1234, the nearer to the key, counts"
    ]
    assert (bo.waiting, bo.problems) == (
        1,
        [f"{table}:3: effort.O2: 'T12 = 1234' names T12: it is read by hand"],
    )
    assert cy.total == 1.0


def test_words_and_counts_of_a_key_are_compared(tmp_path: Path) -> None:
    table = tmp_path / "class.csv"
    table.write_text("student,mobility,status\nAnn,1,ok\nBo,2,jammed\nCy,1,\n", encoding="utf-8")
    key = [{"quantity": "mobility", "value": 1, "marks": 3}, {"quantity": "status", "value": "ok", "at": 1}]
    found = da.grade(table, key).students
    assert [[(m.quantity, m.outcome, m.marks, m.sentence, m.given) for m in s.marks] for s in found] == [
        [("mobility", "right", 3, "", "1"), ("status, at no. 1", "right", 1, "", "ok")],
        [
            ("mobility", "unknown", 0, "another count", "2"),
            ("status, at no. 1", "unknown", 0, "another word", "jammed"),
        ],
        [("mobility", "right", 3, "", "1"), ("status, at no. 1", "missing", 0, "no answer is given", "")],
    ]


def test_what_is_not_asked_and_has_no_reading_is_read_by_hand(tmp_path: Path) -> None:
    (tmp_path / "ann.yaml").write_text("efforts: {O2: 1234, O9: about ten, O8: 3}\n", encoding="utf-8")
    key = [{"quantity": "effort", "of": "O2", "value": 1234, "unit": "N*m"}]
    (ann,) = da.grade(tmp_path, key).students
    assert [(m.outcome, m.marks) for m in ann.marks] == [("right", 1.0)]
    where = f"{tmp_path / 'ann.yaml'}:1: effort"
    assert ann.problems == [
        f"{where} O9: 'about ten' has no reading: it is read by hand",
        f"{where} O8: not asked",
    ]


def test_what_equilibrium_leaves_open_has_no_marks(tmp_path: Path) -> None:
    """A bar in two pins: their forces along it are not unique; those across are half the load each."""
    points = {"A": [0, 0], "B": [2, 0]}
    m = da.mechanism(
        {
            "links": {"ground": {"points": points}, "bar": {"points": points | {"C": [1, 0]}}},
            "joints": {p: {"type": "pin", "links": ["ground", "bar"]} for p in "AB"},
            "loads": {"F": {"type": "force", "on": "bar", "at": "C", "value": [0, -10]}},
        }
    )
    m.save(tmp_path / "m.yaml")
    key, table = tmp_path / "key.csv", tmp_path / "class.csv"
    key.write_text(
        "variant,file,quantity,of,component\n1,m.yaml,reaction,A,\n1,m.yaml,reaction,B,y\n", encoding="utf-8"
    )
    table.write_text('student,reaction.A,reaction.B.y\nAnn,"[3, 5]",5\n', encoding="utf-8")
    (ann,) = da.grade(table, key).students
    assert [(m.outcome, m.marks, m.most, m.given, m.computed) for m in ann.marks] == [
        ("open", 0, 0, "[3, 5]", ""),
        ("right", 1, 1, "5", "5"),
    ]
    assert ann.marks[0].sentence == (
        "it cannot be judged: 1 constraint is redundant among joints A, B: reactions that are not unique are left "
        "out, their least-norm values given beside."
    )
    assert (ann.total, ann.most) == (1, 1)


def test_a_whole_class_of_zeros_is_refused(tmp_path: Path) -> None:
    key = [{"quantity": "effort", "of": "O2", "value": 1234, "unit": "N*m"}]
    table = tmp_path / "class.csv"
    table.write_text("student,effort.O2\nAnn,17\nBo,19\nCy,23\n", encoding="utf-8")
    with pytest.raises(ModelError, match="not one of 3 figures of 3 students is right; check that the key"):
        da.grade(table, key)
    table.write_text("student,effort.O2\nAnn,17\nBo,19\n", encoding="utf-8")
    assert [s.total for s in da.grade(table, key).students] == [0, 0]


def test_the_figures_of_a_neighbour_are_noticed(tmp_path: Path) -> None:
    key = [
        {"variant": v, "quantity": q, "of": "O2", "value": n, "unit": u}
        for v, t, p in (("1", 12, 5), ("2", 31, 8))
        for q, n, u in (("effort", t, "N*m"), ("drive", p, "rad"))
    ]
    table = tmp_path / "class.csv"
    table.write_text("student,variant,effort.O2,drive.O2\nAnn,1,31,8\nBo,1,31,5\n", encoding="utf-8")
    ann, bo = da.grade(table, key).students
    assert ann.problems == [f"{table}:2: the figures are those of variant 2"]
    assert bo.problems == []
    table.write_text("student,variant,effort.O2,drive.O2\nAnn,1,31 N*m,8 rad\n", encoding="utf-8")
    for other, said in ((key[2:], 1), (key[2:3], 0), ([key[2], key[3] | {"unit": "m"}], 0)):
        (ann,) = da.grade(table, [*key[:2], *other]).students
        assert len(ann.problems) == said
        assert ann.total == 0


def test_a_sheet_for_check_answers_may_have_decimal_commas() -> None:
    (answer,) = read_sheet({"efforts": {"O2": "243,2 lbf in"}}).answers
    assert answer.value == "243.2 lbf*in"
    with pytest.raises(ModelError, match=r"'1,234' may be 1\.234 or 1234; write one of them"):
        read_sheet({"efforts": {"O2": "1,234"}})


def test_one_mistake_costs_at_most_half_a_sheet(tmp_path: Path) -> None:
    """The static answer to a dynamic problem: half of every figure."""
    m = da.load(cases()["4b-01-norton-11-3-rounded-masses"])
    r = da.dynamics(m)
    joints = list(r.joints)
    wrong = da.statics(m)
    rows = ["variant,file,quantity,of", *(f"1,m.yaml,reaction,{j}" for j in joints)]
    m.save(tmp_path / "m.yaml")
    (tmp_path / "key.csv").write_text("\n".join(rows), encoding="utf-8")
    cells = [f"[{x:.6g} N; {y:.6g} N]" for j in joints for x, y in wrong.reaction(j)[:1]]
    table = tmp_path / "class.csv"
    table.write_text(",".join(["student", *joints]) + "\nAnn," + ",".join(cells) + "\n", encoding="utf-8")
    (ann,) = da.grade(table, tmp_path / "key.csv").students
    assert {m.outcome for m in ann.marks} <= {"concept", "right"}
    assert ann.total == ann.most / 2


HEADINGS = {
    "1. Driving torque T12 in lbf in": {"quantity": "effort", "of": "O2"},
    "Driving torque at O2, T12 [N m]": {"quantity": "effort", "of": "O2"},
    "Reaction of A on coupler, F23": {"quantity": "reaction", "of": "A", "on": "coupler"},
    "Force at B on the coupler": {"quantity": "reaction", "of": "B", "on": "coupler"},
    "Direction of F23": {"quantity": "reaction", "of": "A", "on": "coupler", "component": "direction"},
    "Force at A, size": {"quantity": "reaction", "of": "A", "component": "magnitude"},
}
FOUR_BAR_NAMES = FigureNames(
    ("ground", "crank", "coupler", "rocker"),
    {"O2": ("ground", "crank"), "A": ("crank", "coupler"), "B": ("coupler", "rocker")},
    {"O2": "O2"},
)


def test_headings_of_forms_are_understood() -> None:
    """As the sheets print a question, or a teacher puts it; points and feedback of a quiz are no answers."""
    others = [
        "Which variant do you have?",
        "Start time",
        "Completion time",
        "Points - Force at A",
        "Feedback - T12",
    ]
    found = columns_of([*others, *HEADINGS], FOUR_BAR_NAMES, {})
    assert found.figures == HEADINGS
    assert found.variant == "Which variant do you have?"


@pytest.mark.parametrize(
    "heading", ["Reaction of A on coupler, F34", "What did you find hard?", "Torque on crank"]
)
def test_a_heading_that_contradicts_itself_is_refused(heading: str) -> None:
    with pytest.raises(da.ModelError, match="no figure is known by the heading"):
        columns_of([heading, "T12"], FOUR_BAR_NAMES, {})


def test_of_a_formula_in_a_workbook_its_number_is_read_and_every_row_counts(tmp_path: Path) -> None:
    """As a spreadsheet saves it: the formula with its last value beside; empty cells and rows are none."""
    book, made, saved = openpyxl.Workbook(), tmp_path / "made.xlsx", tmp_path / "saved.xlsx"
    for row in (["Student", "effort.O2 [N*m]"], ["ann", "=2*10.5"], [], ["ben", 7], ["cem", None]):
        book.active.append(row)
    book.save(made)
    with zipfile.ZipFile(made) as old, zipfile.ZipFile(saved, "w") as new:
        for name in old.namelist():
            new.writestr(name, re.sub(rb"</f><v ?/>|</f><v></v>", b"</f><v>21</v>", old.read(name)))
    rows = read_table(saved)
    assert [(row.line, row.cells) for row in rows] == [
        (2, {"student": "ann", "effort.O2": "21"}),
        (4, {"student": "ben", "effort.O2": "7"}),
        (5, {"student": "cem"}),
    ]
    assert rows[0].heads == ("student", "effort.O2")


QUOTES = "write numbers with commas in quotes, or ; between the columns"


def test_tables_that_cannot_be_read_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(table_files, "MOST_ROWS", 3)
    texts = {
        "three.csv": "a\n1\n2\n3\n",
        "four.csv": "a\n1\n2\n3\n4\n",
        "text.xlsx": "a",
        "heads.csv": "a,b\n",
        "comma.csv": "student,T12,\nann,27,48,\nben,30,,\ncem,27,48,5\n",
    }
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    assert [row.cells["a"] for row in read_table(tmp_path / "three.csv")] == ["1", "2", "3"]
    for name, said in (
        ("four.csv", "four.csv:5: the table has more than 3 rows; divide it"),
        ("text.xlsx", "text.xlsx: the file is not a workbook; save it as .xlsx or CSV"),
        ("comma.csv", f"comma.csv:4: the row has 4 cells, and the heading 3; {QUOTES}"),
        ("heads.csv", "heads.csv:1: the table has no rows; write a heading and one row per figure"),
        ("none.xlsx", "none.xlsx: file not found; name a table (.csv, .xlsx)"),
    ):
        with pytest.raises(ModelError) as refused:
            read_table(tmp_path / name)
        assert str(refused.value) == f"{tmp_path}/{said}"


UNDER_UNITS = {  # of the four-bar in lbf and inches: 27.482 N*m, 688.607 N at -139.678 degrees
    "T12 [N*m];27,48": "27.48 N*m",
    "effort.O2 [Nm];27.48": "27.48 N*m",
    "Driving torque T12 in N m;27,48": "27.48 N*m",
    "T12 (N m);27480 N mm": "27480 N mm",
    "T12 [lbf in];243.2": "243.2 lbf*in",
    "T12 (2 marks);243.2": "243.2",
    "T12 [2 marks];243.2": "243.2",
    "T12;243,2": "243.2",
    "Reaction of A on coupler, F23 [kN];0,6886 \u2220 -139,7": "0.6886 kN @ -139.7",
    "F23 (N);[-525, -445.6]": "[-525 N, -445.6 N]",
    "reaction.A.coupler in N;688.6 @ 220.3": "688.6 N @ 220.3",
    "F23 size [N];688,6;F23 direction [rad];-2,438": "688.6 N @ -2.438 rad",
    "F23 x [N];-525.01;F23 y [kN];-0.4456": "[-525.01 N, -0.4456 kN]",
}


@pytest.mark.parametrize("written", UNDER_UNITS)
def test_a_heading_gives_the_unit_of_the_numbers_under_it(written: str, tmp_path: Path) -> None:
    """The key is in the units of the file; what a cell says itself is before the heading."""
    cells = written.split(";")
    rows = [["student", *cells[::2]], ["ann", *cells[1::2]]]
    (tmp_path / "class.csv").write_text("\n".join("\t".join(row) for row in rows), encoding="utf-8")
    asked = ({"quantity": "effort", "of": "O2"}, {"quantity": "reaction", "of": "A", "on": "coupler"})
    key = [row | {"file": "four_bar.yaml"} for row in asked]
    (tmp_path / "four_bar.yaml").write_text(FOUR_BAR.read_text(encoding="utf-8"), encoding="utf-8")
    (tmp_path / "key.json").write_text(json.dumps(key), encoding="utf-8")
    (student,) = da.grade(tmp_path / "class.csv", tmp_path / "key.json").students
    (mark,) = (m for m in student.marks if m.outcome != "missing")
    assert (mark.outcome, mark.given, student.problems) == ("right", UNDER_UNITS[written], [])


@pytest.mark.parametrize(
    ("value", "unit", "outcome"),
    [
        ("27,48", "N*m", "right"),
        ("27.48", "Nm", "right"),
        ("243,2", "", "right"),
        ("27,48", "", "unknown"),
        ("243,2", "Nmn", "waits"),
        ("243.2", "kg", "waits"),
    ],
)
def test_a_table_with_a_row_a_figure_has_its_units_beside(
    value: str, unit: str, outcome: str, tmp_path: Path
) -> None:
    (tmp_path / "ann.csv").write_text(f"quantity;of;value;unit\neffort;O2;{value};{unit}\n")
    (student,) = da.grade(
        tmp_path, [{"quantity": "effort", "of": "O2", "value": 243.2376, "unit": "lbf*in"}]
    ).students
    assert [m.outcome for m in student.marks] == [outcome]


@pytest.mark.parametrize("between", [",", ";", "\t"])
def test_a_heading_may_have_commas_of_its_own(between: str, tmp_path: Path) -> None:
    """As many as there are columns behind the first: in quotes wherever they would be ends of columns."""
    heads = ["student", "Reaction of A on coupler, F23", "Reaction of B on rocker, F34"]
    quoted = heads if between == "\t" else [f'"{head}"' for head in heads]
    (tmp_path / "class.csv").write_text("\n".join(map(between.join, (quoted, ["ann", "1", "2"]))))
    (row,) = read_table(tmp_path / "class.csv")
    assert (row.heads, row.cells) == (tuple(heads), dict(zip(heads, ["ann", "1", "2"], strict=True)))


@pytest.mark.parametrize(
    ("cell", "given", "outcome", "noted"),
    [  # of [118.026, 100.172], of the size 154.805
        (
            "118,100",
            "[118 lbf, 100 lbf]",
            "right",
            "'118,100' may be 118.100 or 118100 or [118, 100]: [118, 100], the",
        ),
        ("118, 100", "[118 lbf, 100 lbf]", "right", ""),
        ("118.0,100.2", "[118.0 lbf, 100.2 lbf]", "right", ""),
        (
            "118 100",
            "[118 lbf, 100 lbf]",
            "right",
            "'118 100' may be 118100 or [118, 100]: [118, 100], the",
        ),
        ("-118,100", "[-118 lbf, 100 lbf]", "sign", "counts"),
        ("154.8", "154.8 lbf", "right", ""),
        ("154,805", "154.805 lbf", "right", "154.805, the nearer to the key, counts"),
    ],
)
def test_two_numbers_for_a_force_may_be_its_components(
    cell: str, given: str, outcome: str, noted: str, tmp_path: Path
) -> None:
    """Where the mark between them may be a decimal one, or one of thousands, the nearer reading counts."""
    (tmp_path / "class.csv").write_text(f"student;reaction.A\nann;{cell}\n", encoding="utf-8")
    right = {"of": "A", "on": "crank", "value": "[118.026, 100.172]", "unit": "lbf"}
    (student,) = da.grade(tmp_path / "class.csv", [{"quantity": "reaction"} | right]).students
    assert [(m.given, m.outcome) for m in student.marks] == [(given, outcome)]
    assert noted in " ".join(student.problems)
    assert len(student.problems) == bool(noted)
