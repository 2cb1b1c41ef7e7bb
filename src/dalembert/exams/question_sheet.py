"""The sheets of a variant: the question with room for answers, the worked solution; the printed key of all."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.solved.step_choice import Choice
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.exams.asked import ExpectedValue, blanks, figure, place_of_answer, question_words
from dalembert.grading.marking.rubric import Rubric
from dalembert.model import StatedAnswer
from dalembert.reports import Report, report
from dalembert.reports.report_context import METHODS, ReportContext
from dalembert.reports.sections.as_written import AsWritten
from dalembert.reports.sections.given import knowns
from dalembert.reports.sheet import Blanks, ReportSheet
from dalembert.views.notation import Notation, Shown, pretty
from dalembert.views.stated import as_stated

if TYPE_CHECKING:
    from collections.abc import Sequence

    from dalembert.analysis.result.result import Result


@dataclass(frozen=True)
class ExamText:
    """Texts of a teacher: the course, an introduction, and the marks of a question by its name (`effort.O2`), its
    quantity (`reaction`) or `default`.

    >>> ExamText(marks={"effort": 4, "reaction.A": 2}).marks_of(StatedAnswer(quantity="effort", of="O2"))
    4
    """

    course: str = ""
    text: str = ""
    marks: Mapping[str, float] = field(default_factory=dict)

    def marks_of(self, a: StatedAnswer) -> float | None:
        """Marks of a question; None where none are stated."""
        for name in (a.name, f"{a.quantity}.{a.of}", a.quantity, "default"):
            if name in self.marks:
                return self.marks[name]
        return None

    def subtitle(self, name: str) -> str:
        """The line under the title."""
        return " · ".join(filter(None, [self.course, f"Variant {name}" if name else ""]))


NO_TEXT = ExamText()


def question_sheet(
    r: Result,
    questions: Sequence[StatedAnswer],
    name: str = "",
    notation: Notation | None = None,
    exam: ExamText = NO_TEXT,
) -> Report:
    """Given data, the figure to scale without computed values, and the questions, with space for each number."""
    notation, k = as_stated(notation), place_of_answer(r, questions[0])
    written = AsWritten(r.mechanism)
    c = ReportContext(r, k, Shown(r, notation), METHODS, Choice(), notation, question=True, written=written)
    sheet = ReportSheet(r.mechanism.title or "Force analysis", "", exam.subtitle(name))
    sheet.blocks.append(Blanks((("", (("Name", ""), ("Date", ""))),)))
    for paragraph in exam.text.split("\n\n"):
        sheet.text(paragraph.replace("$", "").strip())
    knowns(sheet, c)
    sheet.heading("Find")
    units = r.mechanism.units
    rows = [
        (question_words(c.shown, a) + _marks_text(exam.marks_of(a)), blanks(a, figure(r, a), units))
        for a in questions
    ]
    sheet.blocks.append(Blanks(tuple(rows)))
    sheet.heading("Working", room=True)
    return Report(sheet)


def _marks_text(marks: float | None) -> str:
    return "" if marks is None else f" ({marks:g} mark{'s' if marks != 1 else ''})"


def key_sheet(
    r: Result,
    answers: Mapping[str, Sequence[ExpectedValue]],
    questions: Sequence[StatedAnswer],
    exam: ExamText,
) -> Report:
    """The answers of all variants with four digits, the marks of each question, and the rules of marking."""
    notation = Notation()
    shown, units = Shown(r, notation), Printed(r.mechanism.units)
    sheet = ReportSheet(r.mechanism.title or "Force analysis", "", exam.subtitle("") or "Key")
    heads = [question_words(shown, a) + _marks_text(exam.marks_of(a)) for a in questions]
    sheet.heading("Questions")
    sheet.table(["No.", "Question"], [[str(n), head] for n, head in enumerate(heads, 1)], words=True)
    sheet.heading("Answers")
    for start in range(0, len(questions), ACROSS):
        some = range(start, min(start + ACROSS, len(questions)))
        columns = [f"{n + 1} ({pretty(units.text(next(iter(answers.values()))[n].kind))})" for n in some]
        rows = [
            [name, *(_printed(units, values[n], notation) for n in some)] for name, values in answers.items()
        ]
        sheet.table(["Variant", *columns], rows, words=True)
    sheet.heading("Marks")
    for rule in RULES:
        sheet.text(rule.format(cap=f"{100 * Rubric().cap:g} %"))
    return Report(sheet)


ACROSS = 6
"""Columns of answers beside each other on a page."""

RULES = (
    "A figure within 0.5 %, or right in the digits that are written, has full marks; so has one that is right with the "
    "student's earlier figures.",
    "A wrong sense, sign, axis or unit costs half a question, once: the same slip again costs nothing.",
    "A mistake in one datum (a load, a mass, a length) costs a quarter of each question that it touches; one that runs "
    "through the complete problem (no gravity, no inertia, the position) costs half. All of it together costs at most "
    "{cap} of the sheet, and at least half a question.",
)
"""Rules of marking as the default rubric has them."""


def _printed(units: Printed, right: ExpectedValue, notation: Notation) -> str:
    """A figure with four digits in the file's units."""
    v = right.value
    if v.shape == (2,):
        size, angle = float(np.hypot(*v)), math.degrees(math.atan2(v[1], v[0]))
        return f"{notation.number(float(units(right.kind, size)))} ∠ {angle:.2f}°".replace("-", "−")
    numbers = [notation.number(float(units(right.kind, float(x)))) for x in v.ravel()]
    return (numbers[0] if v.ndim == 0 else f"({', '.join(numbers)})").replace("-", "−")


def solution_sheet(
    r: Result, questions: Sequence[StatedAnswer], name: str = "", notation: Notation | None = None
) -> Report:
    """The worked report of the position of the question, with the variant's name."""
    worked = report(r, place_of_answer(r, questions[0]) + 1, notation=notation).sheet
    return Report(replace(worked, subtitle=f"Variant {name}, solution. {worked.subtitle}"))
