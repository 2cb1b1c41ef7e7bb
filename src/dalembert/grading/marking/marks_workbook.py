"""Marks as a workbook: text stays text, whatever it begins with."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from dalembert.analysis.output.workbook import add_sheet, new_book
from dalembert.grading.marking.rubric import Rubric
from dalembert.grading.marking.student_marks import StudentMarks, named_mistakes
from dalembert.saving import check_installed, new_file


def write_workbook(
    students: Sequence[StudentMarks], rubric: Rubric, path: str | Path, overwrite: bool = False
) -> None:
    """Sheets of marks, figures, mistakes, unreadable parts, and the rubric."""
    check_installed("openpyxl", "a workbook")
    with new_file(path, overwrite) as temporary, new_book(temporary) as book:
        for name, rows in (
            ("marks", _marks(students)),
            ("figures", _figures(students)),
            ("mistakes", [("mistake", "students"), *named_mistakes(students)]),
            ("not read", _problems(students)),
            ("rubric", _rubric(rubric)),
        ):
            add_sheet(book, name, rows).freeze_panes = "B2"


def _marks(students: Sequence[StudentMarks]) -> Iterator[Sequence[object]]:
    """A row a student, a column a figure."""
    names = list(dict.fromkeys(m.quantity for s in students for m in s.marks))
    yield ["student", "variant", "marks", "of", "percent", *names]
    for s in students:
        of = {m.quantity: m.marks if m.outcome != "open" else "not judged" for m in s.marks}
        percent = round(100 * s.total / s.most, 1) if s.most else None
        yield [s.student, s.variant, round(s.total, 4), s.most, percent, *(of.get(n) for n in names)]


def _figures(students: Sequence[StudentMarks]) -> Iterator[Sequence[object]]:
    yield [
        "student",
        "variant",
        "figure",
        "given",
        "computed",
        "outcome",
        "marks",
        "of",
        "why",
        "file",
        "line",
    ]
    for s in students:
        for m in s.marks:
            outcome = m.outcome.replace("_", " ")
            values = (m.quantity, m.given, m.computed, outcome, m.marks, m.most, m.sentence)
            yield [s.student, s.variant, *values, s.file, m.line or None]


def _problems(students: Sequence[StudentMarks]) -> Iterator[Sequence[object]]:
    yield ["student", "what"]
    for s in students:
        yield from ([s.student, said] for said in s.problems)


def _rubric(r: Rubric) -> Iterator[Sequence[object]]:
    yield ["outcome", "share"]
    yield from ((name.replace("_", " "), share) for name, share in r.shares.items())
    yield from ((f"mistake: {words}", share) for words, share in r.mistakes.items())
    yield from ((f"marks of {quantity}", number) for quantity, number in r.marks.items())
