"""Keys of exams: variants by their names, which figure answers which question, units of cells, and what is refused."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.grading.answer_sheet import named_figure, read_sheet, sheet_items, with_size
from dalembert.grading.marking.by_hand import _fits, _may_be_vector, decide_cells
from dalembert.grading.marking.class_sheets import Given, StudentSheet, _joined, class_sheets
from dalembert.grading.marking.figure_names import FigureNames
from dalembert.grading.marking.grade import _fit
from dalembert.grading.marking.key import ExamVariant, Key, cell_value, place, plain, read_key, with_units

EFFORT: dict[str, Any] = {"quantity": "effort", "of": "O2"}
FORCE: dict[str, Any] = {"quantity": "reaction", "of": "A"}


@pytest.mark.parametrize(
    ("keys", "question", "fit"),
    [
        (EFFORT, EFFORT, 0),
        (EFFORT | {"of": "O4"}, EFFORT, None),
        (EFFORT | {"quantity": "drive"}, EFFORT, None),
        (EFFORT | {"of": ""}, EFFORT, None),
        ({"quantity": "mobility", "of": ""}, {"quantity": "mobility"}, 0),
        (EFFORT | {"at": 2}, EFFORT | {"at": 2}, 0),
        (EFFORT | {"at": "2"}, EFFORT | {"at": 2}, 0),
        (EFFORT | {"at": 3}, EFFORT | {"at": 2}, None),
        (EFFORT, EFFORT | {"at": 2}, 0),
        (EFFORT | {"at": 3}, EFFORT, None),
        (EFFORT | {"extreme": "max"}, EFFORT | {"extreme": "min"}, None),
        (EFFORT, EFFORT | {"extreme": "min"}, 0),
        (FORCE, FORCE | {"component": "x"}, 1),
        (FORCE | {"component": "magnitude"}, FORCE, 2),
        (FORCE | {"component": "x"}, FORCE, None),
        (FORCE | {"component": "magnitude"}, FORCE | {"component": "x"}, None),
        (FORCE | {"component": "x"}, FORCE | {"component": "x"}, 0),
    ],
)
def test_a_figure_answers_a_question_in_full_or_in_part(
    keys: dict[str, Any], question: dict[str, Any], fit: int | None
) -> None:
    assert _fit(da.Answer(**question), keys) == fit


@pytest.mark.parametrize(
    ("name", "same"),
    [
        ("07", "7"),
        (" 7.0 ", "7"),
        ("Group A", "group a"),
        ("000", "0"),
        ("0.0", "0"),
        ("10", "10"),
        ("", "0"),
        ("7.05", "7.05"),
    ],
)
def test_names_of_variants_are_compared_without_zeros_and_case(name: str, same: str) -> None:
    assert plain(name) == same


def test_a_variant_is_that_which_a_sheet_names_or_its_student_or_the_only_one() -> None:
    one, two = ExamVariant("01"), ExamVariant("Ann")
    key = Key([one, two], "key.csv")
    assert key.variant("1.0", "ann") is one
    assert key.variant("", "ANN") is two
    assert Key([one]).variant("", "Bo") is one
    for name, student, said in (
        ("3", "Bo", "unknown variant '3'; choose among 01, Ann"),
        ("", "Bo", "the sheet does not say its variant; write variant: 01"),
    ):
        with pytest.raises(ModelError) as refused:
            key.variant(name, student)
        assert str(refused.value) == said
    with pytest.raises(ModelError, match=r"^unknown variant '3'"):
        Key([one]).variant("3", "Bo")


@pytest.mark.parametrize(
    ("value", "unit", "read"),
    [
        ("154.8 @ 220", "lbf", "154.8 lbf @ 220"),
        (" 154.8@220 deg", "lbf", "154.8 lbf @ 220 deg"),
        ("3 N", "lbf", "3 N"),
        ("3", "", "3"),
        (3.5, "N", "3.5 N"),
        ([1, "2 kN", "3 @ 4"], "N", ["1 N", "2 kN", "3 N @ 4"]),
        ("three", "N", "three"),
    ],
)
def test_a_bare_number_has_the_unit_of_its_column(value: Any, unit: str, read: Any) -> None:
    assert with_units(value, unit) == read


@pytest.mark.parametrize(
    ("text", "unit", "read"),
    [
        (" [1, 2 kN] ", "N", ["1 N", "2 kN"]),
        ("[1 ;2; 3]", "", ["1", "2", "3"]),
        ("[1, 2", "N", "[1, 2"),
        ("1, 2]", "N", "1, 2]"),
        (" 7 ", "N", "7 N"),
    ],
)
def test_a_cell_in_brackets_is_a_list(text: str, unit: str, read: Any) -> None:
    assert cell_value(text, unit) == read


@pytest.mark.parametrize(
    ("text", "read"),
    [
        ("3", 3),
        ("12345678", 12345678),
        ("123456789", "123456789"),
        ("60 deg", "60 deg"),
        ("\u0663", "\u0663"),
        ("", ""),
        (None, None),
    ],
)
def test_a_position_is_a_number_or_the_value_of_a_drive(text: str | None, read: Any) -> None:
    assert place(text) == read


ROW = {"quantity": "effort", "of": "O2", "value": "3", "unit": "N*m"}


def test_the_rows_of_a_key_are_its_questions_by_variant() -> None:
    key = read_key(
        [
            ROW | {"variant": "01", "marks": 2.5, "at": "2", "tolerance": "3 %"},
            FORCE | {"variant": "1", "on": "rod", "value": "[1, 2]", "unit": "kN", "component": ""},
            ROW | {"variant": "02", "at": "60 deg", "marks": 0},
        ]
    )
    assert list(key.variants) == ["1", "2"]
    first, second = key.variants["1"].asked
    assert (first.answer.value, first.answer.at, first.answer.tolerance) == ("3 N*m", 2, "3 %")
    assert (first.unit, first.marks, first.line) == ("N*m", 2.5, 1)
    assert (second.answer.value, second.answer.on, second.marks, second.line) == (
        ("1 kN", "2 kN"),
        "rod",
        None,
        2,
    )
    (other,) = key.variants["2"].asked
    assert (other.answer.at, other.marks, key.file, key.variants["2"].problem) == (
        "60 deg",
        0.0,
        "the key",
        None,
    )


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        ([EFFORT], "the key:1: the figure has neither a value nor a model file; give it one of them"),
        ([ROW, ROW | {"marks": -1}], "the key:2: '-1' is not a number of marks; write a number, 0 or more"),
        ([ROW | {"marks": 1_000_001}], "the key:1: '1000001' is not a number of marks; write a number, 0 or more"),
        ([ROW | {"marks": "nan"}], "the key:1: 'nan' is not a number of marks; write a number, 0 or more"),
        ([ROW | {"marks": "four"}], "the key:1: 'four' is not a number of marks; write a number, 0 or more"),
        ([EFFORT | {"file": "../m.yaml"}], "the key:1: '../m.yaml' is outside the key's folder; name a file inside it"),
        ([EFFORT | {"file": f"{k}.yaml"} for k in "ab"], "the key:2: variant '' has two files; it had 'a.yaml'"),
        ([ROW | {"quantity": "efort"}], "the key:1: unknown quantity 'efort'; did you mean 'effort'?"),
        (["effort"], "'effort' is not a figure of the key; write its quantity"),
    ],
)  # fmt: skip
def test_a_key_that_is_none_is_refused_at_its_row(rows: Any, said: str) -> None:
    with pytest.raises(ModelError) as refused:
        read_key(rows)
    assert str(refused.value) == said


def test_a_key_is_read_from_json_and_from_a_model_file(tmp_path: Path) -> None:
    (tmp_path / "key.json").write_text(json.dumps([ROW]), encoding="utf-8")
    (asked,) = read_key(tmp_path / "key.json").variants["0"].asked
    assert (asked.answer.value, asked.marks) == ("3 N*m", None)
    (tmp_path / "bad.json").write_text("[{]", encoding="utf-8")
    with pytest.raises(ModelError, match=r"bad\.json:1: the key is not JSON; write a list of figures"):
        read_key(tmp_path / "bad.json")
    m = da.four_bar(positions=1).with_values({"title": "Four bars"})
    key = read_key(m)
    names = [(a.answer.quantity, a.answer.of) for a in key.variants["four bars"].asked]
    assert names == [("effort", "O2"), *(("reaction", j) for j in ("O2", "A", "B", "O4"))]
    m.save(tmp_path / "m.yaml")
    assert [a.answer for a in read_key(tmp_path / "m.yaml").variants["four bars"].asked] == [
        a.answer for a in key.variants["four bars"].asked
    ]


def test_a_key_that_contradicts_its_model_file_is_refused() -> None:
    m = da.four_bar(positions=1).with_values({"title": "Four bars"})
    right = float(da.dynamics(m).effort("O2")[0])
    for value, met in ((right, True), (1.002 * right, True), (1.02 * right, False)):
        variant = ExamVariant("01", load=lambda: m)
        variant.asked = read_key([ROW | {"value": f"{value:.9g}", "tolerance": "5 %"}]).variants["0"].asked
        if met:
            variant.check("key.csv")
            assert variant.problem is not None
            continue
        with pytest.raises(ModelError) as refused:
            variant.check("key.csv")
        assert str(refused.value) == (
            f"key.csv:1: effort of O2 is {value:.9g} N*m in the key, and {right:.7g} by the model file; correct one "
            "of them"
        )


def given(text: str, column: str = "F", line: int = 3, unit: str = "", **keys: Any) -> Given:
    return Given(FORCE | keys | {"value": text}, line, column, unit)


def test_two_columns_of_a_vector_are_one_figure() -> None:
    size, angle = (
        given("5", "size", unit="kN", component="magnitude"),
        given("30", "dir", 4, "deg", component="direction"),
    )
    x, y = given("3", "x", unit="N", component="x"), given("4 kN", "y", unit="N", component="y")
    other = Given(EFFORT | {"value": "7"}, 3, "T", "")
    (one, last) = _joined([angle, other, size], FigureNames())
    assert (one.keys, one.line, one.column) == (FORCE | {"value": "5 kN @ 30 deg"}, 3, "size, dir")
    assert last is other
    (pair,) = _joined([y, x], FigureNames())
    assert (pair.keys["value"], pair.column) == ("3 N; 4 kN", "x, y")
    asked = FigureNames(asked=frozenset({("reaction", "A", "x")}))
    assert list(_joined([x, y], asked)) == [x, y]
    assert list(_joined([size], FigureNames())) == [size]
    apart = x._replace(keys=x.keys | {"on": "rod"})
    assert list(_joined([apart, y], FigureNames())) == [apart, y]


@pytest.mark.parametrize(
    ("one", "vector"),
    [
        (given("118,100"), True),
        (given("-1.5 +2"), True),
        (given("118,100", component="x"), False),
        (given("118,100", column=""), False),
        (given("118,100,7"), False),
        (Given(EFFORT | {"value": "118,100"}, 3, "T"), False),
    ],
)
def test_two_numbers_in_a_cell_may_be_a_vector(one: Given, vector: bool) -> None:
    assert _may_be_vector(one) is vector
    assert _fits(FORCE, one) is (one.keys["quantity"] == "reaction")
    assert not _fits(FORCE | {"of": "B"}, one)
    assert not _fits(None, one)


def test_cells_are_replaced_by_what_a_teacher_read(tmp_path: Path) -> None:
    sheets = [
        StudentSheet("Ann", "a.csv", figures=[given("?", "F"), given("?", "T"), given("?", "F")]),
        StudentSheet("Bo", "a.csv"),
    ]
    path = tmp_path / "read.csv"
    path.write_text('student,figure,value\nAnn,F,"[1, 2]"\nAnn,T,7 N\n', encoding="utf-8")
    decide_cells(sheets, path)
    assert [one.keys["value"] for one in sheets[0].figures] == [["1", "2"], "7 N", ["1", "2"]]
    for text, line, said in (
        ("student,figure,value\nCy,F,1\n", 2, "unknown student 'Cy'; there are Ann, Bo"),
        (
            "student,figure,value\nAnn,F,1\nAnn,G,1\n",
            3,
            "unknown figure 'G' on the sheet of Ann; there are F, T, F",
        ),
        ("student,figure\nAnn,F\n", 2, "the row has no value; the columns are student, figure and value"),
    ):
        path.write_text(text, encoding="utf-8")
        with pytest.raises(ModelError) as refused:
            decide_cells(sheets, path)
        assert str(refused.value) == f"{path}:{line}: {said}"


def test_sheets_of_a_folder_are_sorted_and_what_cannot_be_read_is_said(tmp_path: Path) -> None:
    (tmp_path / "cy.yaml").write_text("student: Cy Lee\nvariant: 07\ntolerance: 3 %\nefforts: {O2: 3}\n")
    (tmp_path / "ann.json").write_text('{"reactions": {"A": "5 @ 30"}}')
    (tmp_path / "bo.yaml").write_text("efforts: 7\n")
    (tmp_path / ".hidden.yaml").write_text("efforts: {O2: 3}\n")
    (tmp_path / "notes.txt").write_text("efforts")
    ann, bo, cy = class_sheets(tmp_path)
    assert (ann.student, ann.figures[0].name, ann.figures[0].keys) == (
        "ann",
        "reaction A",
        FORCE | {"value": "5 @ 30"},
    )
    assert (bo.student, bo.figures) == ("bo", [])
    assert bo.problems == [f"{tmp_path / 'bo.yaml'}:1: efforts needs names, of the things that the figures belong to; "
                           "write efforts: {NAME: 7}"]  # fmt: skip
    assert (cy.student, cy.variant, cy.tolerance, cy.figures[0].line) == ("Cy Lee", "7", "3 %", 4)
    (tmp_path / "empty").mkdir()
    with pytest.raises(
        ModelError, match=r"empty has no answer files; their names end in \.yaml, \.yml, \.json, "
    ):
        class_sheets(tmp_path / "empty")
    with pytest.raises(ModelError, match="efforts needs names"):
        class_sheets(tmp_path / "bo.yaml")


@pytest.mark.parametrize(
    ("tree", "items"),
    [
        (
            {"at": 2, "student": "Ann", "efforts": {"O2": 3}, "mobility": 1, "status": "ok"},
            [
                (("efforts", "O2"), EFFORT | {"value": 3, "at": 2}),
                (("mobility",), {"quantity": "mobility", "value": 1}),
                (("status",), {"quantity": "status", "value": "ok", "at": 2}),
            ],
        ),
        (
            {"answers": [EFFORT | {"value": 3}], "tolerance": "3 %"},
            [(("answers", 0), EFFORT | {"value": 3})],
        ),
        ([FORCE | {"value": 5}, EFFORT], [((0,), FORCE | {"value": 5}), ((1,), EFFORT)]),
        ({"reactions": {"A": 5}}, [(("reactions", "A"), {"component": "magnitude"} | FORCE | {"value": 5})]),
    ],
)
def test_the_figures_of_a_sheet_with_their_paths(tree: Any, items: list[Any]) -> None:
    assert list(sheet_items(tree)) == items


@pytest.mark.parametrize(
    ("keys", "size"),
    [
        (FORCE | {"value": 5}, True), (FORCE | {"value": "5 N"}, True), (FORCE | {"value": "5 @ 30"}, False),
        (FORCE | {"value": [1, 2]}, False), (FORCE | {"value": ""}, False), (EFFORT | {"value": 5}, False),
        ({"quantity": "center_acceleration", "of": "rod", "value": 2.5}, True),
    ],
)  # fmt: skip
def test_a_single_number_for_a_vector_is_its_size(keys: dict[str, Any], size: bool) -> None:
    assert with_size(keys) == ({"component": "magnitude"} | keys if size else keys)
    assert with_size(FORCE | {"value": 5, "component": "x"})["component"] == "x"


def test_columns_are_named_as_the_program_names_quantities() -> None:
    assert named_figure("mobility", 1) == {"quantity": "mobility", "value": 1}
    assert named_figure("moment.O4.rocker", 3) == {
        "quantity": "moment",
        "of": "O4",
        "value": 3,
        "on": "rocker",
    }
    assert named_figure("reaction.A.x", 3) == FORCE | {"component": "x", "value": 3}
    assert named_figure("point.rod.P", "[1, 2]")["of"] == "rod.P"
    (answer,) = read_sheet({"reactions": {"A": "155 N"}}).answers
    assert (answer.component, answer.value) == ("magnitude", "155 N")
