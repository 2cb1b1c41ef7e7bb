"""Marks as tables: to read, and as the sheets of a workbook."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from dalembert.answer.workbook import Tab
from dalembert.grading.marking.rubric import Rubric
from dalembert.grading.marking.student_marks import StudentMarks, named_mistakes
from dalembert.printing import Part, TextTable


def marks_tabs(students: Sequence[StudentMarks], rubric: Rubric) -> Iterator[Tab]:
    """Sheets of marks, figures, mistakes, what a teacher must read, and the rubric."""
    for name, rows in (
        ("marks", _marks(students)),
        ("figures", [FIGURE, *figures(students)]),
        ("mistakes", [("mistake", "students"), *named_mistakes(students)]),
        ("by hand", _problems(students)),
        ("rubric", _rubric(rubric)),
    ):
        yield Tab(name, rows, freeze="B2")


def marks_parts(students: Sequence[StudentMarks], most: int | None = None) -> Iterator[Part]:
    """A row a student, then the mistakes of most students."""
    rows = [
        [
            s.student,
            s.variant,
            *(f"{x:.4g}" if s.marks else "-" for x in (s.total, s.most)),
            f"{s.waiting or ''}",
        ]
        for s in students
    ]
    width = 5 if any(s.waiting for s in students) else 4
    heads = ["student", "variant", "marks", "of", "waits"]
    yield TextTable(heads[:width], [row[:width] for row in rows], 2)
    named = [[sentence, str(count)] for sentence, count in named_mistakes(students)[:most]]
    if named:
        yield TextTable(["mistake", "students"], named)


def _marks(students: Sequence[StudentMarks]) -> Iterator[Sequence[object]]:
    """One row per student, one column per figure."""
    names = list(dict.fromkeys(m.quantity for s in students for m in s.marks))
    yield ["student", "variant", "marks", "of", "percent", *names]
    for s in students:
        of = {m.quantity: m.marks if m.outcome != "open" else "not judged" for m in s.marks}
        percent = round(100 * s.total / s.most, 1) if s.most else None
        yield [s.student, s.variant, round(s.total, 4), s.most, percent, *(of.get(n) for n in names)]


FIGURE = (
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
)
"""Data kept of each figure."""


def figures(students: Sequence[StudentMarks]) -> Iterator[Sequence[object]]:
    """A row a figure of every student."""
    for s in students:
        for m in s.marks:
            outcome = m.outcome.replace("_", " ")
            values = (m.quantity, m.given, m.computed, outcome, m.marks, m.most, m.sentence)
            yield [s.student, s.variant, *values, s.file, m.line or None]


def _problems(students: Sequence[StudentMarks]) -> Iterator[Sequence[object]]:
    yield ["student", "what"]
    for s in students:
        yield from ([s.student, text] for text in s.problems)


def _rubric(r: Rubric) -> Iterator[Sequence[object]]:
    yield ["outcome", "share"]
    yield from ((name.replace("_", " "), share) for name, share in r.shares.items())
    yield from ((f"mistake: {words}", share) for words, share in r.mistakes.items())
    yield from ((f"marks of {quantity}", number) for quantity, number in r.marks.items())
