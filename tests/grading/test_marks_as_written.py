"""Marks as they are written: sentences of feedback, tables and tabs of a class, shares of a rubric, file names."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import dalembert as da
from dalembert.grading.marking.by_hand import check_class
from dalembert.grading.marking.feedback import feedback, file_names, waits_text, write_feedback
from dalembert.grading.marking.grade import ClassMarks
from dalembert.grading.marking.marks_tabs import marks_parts, marks_tabs
from dalembert.grading.marking.rubric import Rubric, read_rubric
from dalembert.grading.marking.student_marks import Mark, StudentMarks, named_mistakes

FIGURE = "reaction of A"


def student(name: str, *marks: Mark, variant: str = "", problems: tuple[str, ...] = ()) -> StudentMarks:
    return StudentMarks(name, variant, f"answers/{name}.yaml", list(marks), list(problems))


def mark(outcome: str, marks: float = 1.5, sentence: str = "the sense is opposite", **more: Any) -> Mark:
    return Mark(FIGURE, *(more.get(k, d) for k, d in (("given", "3 N"), ("computed", "-3 N"))), outcome, sentence,
                marks, more.get("most", 4.0), more.get("line", 7))  # fmt: skip


@pytest.mark.parametrize(
    ("one", "said"),
    [
        (mark("sign"), "- Reaction of A (1.5 of 4): you have 3 N; the sense is opposite. Computed: -3 N."),
        (mark("sign", given=""), "- Reaction of A (1.5 of 4): the sense is opposite. Computed: -3 N."),
        (mark("sign", computed=""), "- Reaction of A (1.5 of 4): you have 3 N; the sense is opposite."),
        (
            mark("repeated", 4.0),
            "- Reaction of A (4 of 4): you have 3 N; the sense is opposite, as before. Computed: -3 N.",
        ),
        (mark("follow_through", 4.0, "right so"), "- Reaction of A (4 of 4): you have 3 N; right so."),
        (mark("right", 4.0, ""), "- Reaction of A (4 of 4): you have 3 N; right."),
        (
            mark("right", 2.0, "only its size"),
            "- Reaction of A (2 of 4): you have 3 N; right, but only its size.",
        ),
        (mark("missing", 0.0, "no answer is given"), "- Reaction of A (0 of 4): no answer is given."),
        (
            mark("open", 0.0, "it is a*b", computed=""),
            r"- Reaction of A (not counted): you have 3 N; it is a\*b.",
        ),
        (mark("waits", 0.0, "cell 7 <has> none"), r"- Reaction of A (waits): cell 7 \<has\> none."),
    ],
)
def test_a_figure_has_its_marks_and_the_reason(one: Mark, said: str) -> None:
    """Marks with four digits at most, and nothing that Markdown would read otherwise."""
    assert feedback(student("Ann", one)).splitlines()[4] == said


def test_the_feedback_of_a_student_in_full() -> None:
    ann = student(
        "Ann_Lee", mark("sign", 1.23456), mark("waits", 0.0, "line 3 waits", most=0.0), variant="01",
        problems=("answers/Ann_Lee.yaml:9: not asked", "line 3 waits"),
    )  # fmt: skip
    assert feedback(ann) == (
        "# Ann\\_Lee\n\nVariant 01.\n\n1.235 of 4 marks, 1 waits.\n\n"
        "- Reaction of A (1.235 of 4): you have 3 N; the sense is opposite. Computed: -3 N.\n"
        "- Reaction of A (waits): line 3 waits.\n\nNot counted:\n\n- Ann\\_Lee.yaml:9: not asked\n"
    )
    assert waits_text(student("b", mark("waits"), mark("waits"))) == ", 2 wait"
    assert waits_text(student("b", mark("open"))) == ""


def test_file_names_are_letters_digits_and_hyphens_and_none_twice() -> None:
    assert file_names(["Ann Lee", "ann-lee", "ANN  LEE", "_x_", "../..", "", "y" * 61]) == [
        *("Ann-Lee.md", "ann-lee-2.md", "ANN-LEE-3.md", "x.md", "student.md", "student-2.md"),
        f"{'y' * 60}.md",
    ]


def test_feedback_is_written_into_a_folder_that_is_new_or_may_be_written_over(tmp_path: Path) -> None:
    folder, some = (
        tmp_path / "feedback",
        [student("Ann", mark("sign")), student("Bo", mark("right", 4.0, ""))],
    )
    write_feedback(some, folder)
    assert sorted(p.name for p in folder.iterdir()) == ["Ann.md", "Bo.md"]
    assert (folder / "Bo.md").read_text(encoding="utf-8") == feedback(some[1])
    (folder / "Ann.md").write_text("mine", encoding="utf-8")
    (folder / "notes.txt").write_text("mine", encoding="utf-8")
    with pytest.raises(da.ModelError, match="has files"):
        write_feedback(some, folder)
    assert (folder / "Ann.md").read_text(encoding="utf-8") == "mine"
    write_feedback(some, folder, overwrite=True)
    assert (folder / "Ann.md").read_text(encoding="utf-8") == feedback(some[0])
    assert (folder / "notes.txt").read_text(encoding="utf-8") == "mine"


SOME = [
    student(
        "Ann", mark("sign", 1.23456), mark("waits", 0.0, "?", most=0.0), variant="01", problems=("x", "y")
    ),
    student("Bo", mark("sign", 2.0), mark("named", 2.0, "no g"), mark("sign", 2.0), variant="02"),
    student("Cy", mark("datum", 3.0, "no g"), mark("right", 4.0, "but")),
    student("Di"),
]


def test_mistakes_are_counted_by_students_and_those_of_most_are_first() -> None:
    assert named_mistakes(SOME) == [("the sense is opposite", 2), ("no g", 2)]
    assert named_mistakes(SOME[1:3]) == [("no g", 2), ("the sense is opposite", 1)]
    kinds = ("named", "sign", "unit", "datum", "concept", "may_be", "unknown", "right")
    assert [m for m, _ in named_mistakes([student("a", *(mark(k, 0.0, k) for k in kinds))])] == sorted(
        kinds[:5]
    )


def test_a_class_is_printed_with_a_row_a_student() -> None:
    marks, mistakes = marks_parts(SOME, 1)
    table: Any = marks
    assert (list(table.heads), table.left) == (["student", "variant", "marks", "of", "waits"], 2)
    assert [list(row) for row in table.rows] == [
        ["Ann", "01", "1.235", "4", "1"], ["Bo", "02", "6", "12", ""], ["Cy", "", "7", "8", ""],
        ["Di", "", "-", "-", ""],
    ]  # fmt: skip
    other: Any = mistakes
    assert (list(other.heads), other.rows) == (["mistake", "students"], [["the sense is opposite", "2"]])
    (alone,) = marks_parts(SOME[3:])
    rows: Any = alone
    assert (list(rows.heads), rows.rows) == (["student", "variant", "marks", "of"], [["Di", "", "-", "-"]])


def test_the_tabs_of_a_class_have_all_that_is_known_of_it() -> None:
    rubric = Rubric({"effort": 4.0}, {"may_be": 0.25}, {"moment arm": 0.75})
    tabs = {tab.title: [list(row) for row in tab.rows] for tab in marks_tabs(SOME, rubric)}
    assert list(tabs) == ["marks", "figures", "mistakes", "by hand", "rubric"]
    assert tabs["marks"] == [
        ["student", "variant", "marks", "of", "percent", FIGURE],
        ["Ann", "01", 1.2346, 4.0, 30.9, 0.0],
        ["Bo", "02", 6.0, 12.0, 50.0, 2.0],
        ["Cy", "", 7.0, 8.0, 87.5, 4.0],
        ["Di", "", 0, 0, None, None],
    ]
    assert tabs["figures"][1] == [
        "Ann", "01", FIGURE, "3 N", "-3 N", "sign", 1.23456, 4.0, "the sense is opposite", "answers/Ann.yaml", 7,
    ]  # fmt: skip
    assert tabs["mistakes"] == [["mistake", "students"], ["the sense is opposite", 2], ["no g", 2]]
    assert tabs["by hand"] == [["student", "what"], ["Ann", "x"], ["Ann", "y"]]
    assert tabs["rubric"] == [
        ["outcome", "share"], ["may be", 0.25], ["mistake: moment arm", 0.75], ["marks of effort", 4.0],
    ]  # fmt: skip
    (tab,) = (t for t in marks_tabs([student("a", mark("open", 0.0, line=0))], rubric) if t.title == "marks")
    assert list(tab.rows)[1][5:] == ["not judged"]
    assert all(tab.freeze == "B2" for tab in marks_tabs(SOME, rubric))


def test_a_class_as_an_answer() -> None:
    found = ClassMarks(SOME, Rubric(cap=0.25))
    assert found.text().endswith("One mistake costs at most 3 of 12 marks.")
    columns = {c.name: list(c.values) for c in found.columns()}
    assert columns["student"] == ["Ann", "Ann", "Bo", "Bo", "Bo", "Cy", "Cy"]
    assert columns["outcome"] == ["sign", "waits", "sign", "named", "sign", "datum", "right"]
    assert columns["of"] == [4.0, 0.0, *[4.0] * 5]
    record = found.record(found.scale("file"))
    assert record["students"]["Bo"] == {"variant": "02", "marks": 6.0, "of": 12.0}
    assert record["mistakes"] == {"the sense is opposite": 2, "no g": 2}
    assert record["not_read"] == {"Ann": ["x", "y"]}
    assert found.basis() == {"title": "Marks"}


@pytest.mark.parametrize(
    ("students", "refused"),
    [
        ([mark("unknown", 0.0)] * 3, 3),
        ([mark("unknown", 0.0)] * 2, 0),
        ([mark("unknown", 0.0)] * 2 + [mark("sign", 0.5)], 0),
        ([mark("unknown", 0.0)] * 2 + [mark("missing", 0.0, given="")], 0),
        ([mark("unknown", 0.0)] * 3 + [mark("missing", 0.0, given="")], 3),
        ([mark("open", 0.0, most=0.0)] * 3, 0),
    ],
)
def test_a_class_of_three_without_any_mark_is_refused(students: list[Mark], refused: int) -> None:
    some = [student(f"s{k}", m) for k, m in enumerate(students)]
    if not refused:
        check_class(some, "class.csv")
        assert len(some) > 1
        return
    with pytest.raises(da.ModelError) as error:
        check_class(some, "class.csv")
    assert str(error.value) == (
        f"class.csv: not one of {refused} figures of {len(some)} students is right; check that the key, its variants "
        "and the columns are those of these sheets"
    )


@pytest.mark.parametrize(
    ("tree", "said"),
    [
        ([], "the rubric is not a mapping; write marks: {effort: 4, reaction: 2}"),
        ({"mark": {}}, "unknown key 'mark'; did you mean 'marks'?"),
        ({"share": {"sine": 0.5}}, "share has no entry 'sine'; did you mean 'sign'?"),
        ({"share": {"sign": 1.01}}, "1.01 is not a number from 0 to 1; write one"),
        ({"share": {"sign": -0.01}}, "-0.01 is not a number from 0 to 1; write one"),
        ({"share": {"sign": True}}, "True is not a number from 0 to 1; write one"),
        ({"marks": {"effort": 1_000_001}}, "1000001 is not a number from 0 to 1e+06; write one"),
        ({"marks": 3}, "marks is not a mapping; write marks: {NAME: NUMBER}"),
        ({"cap": 1.5}, "1.5 is not a number from 0 to 1; write one"),
        (
            {"tolerance": "60 %"},
            "'60 %' is not a tolerance in percent; write one from 0 to 50 %, for example 3 %",
        ),
    ],
)
def test_a_rubric_that_is_none_is_refused(tree: Any, said: str) -> None:
    with pytest.raises(da.ModelError) as refused:
        read_rubric(tree)
    assert str(refused.value).replace("true", "True") == said


def test_a_rubric_has_what_it_says_and_its_defaults() -> None:
    found = read_rubric(
        {"marks": {"effort": 0, "default": 2}, "share": {"sign": 0, "unreadable": 1}, "tolerance": "50 %"}
    )
    assert (found.marks_of("effort"), found.marks_of("angle"), found.cap, found.tolerance) == (
        0,
        2,
        0.5,
        "50 %",
    )
    assert (found.shares["sign"], found.shares["unit"], found.shares["unreadable"]) == (0, 0.5, 1)
    assert read_rubric({"cap": 0}).cap == 0
    assert read_rubric({"share": {"named": 0.2}}).shares["concept"] == 0.2
    assert read_rubric({"share": {"named": 0.2, "datum": 0.9}}).shares["datum"] == 0.9
