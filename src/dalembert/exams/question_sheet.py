"""The sheets of a variant: the question with room for answers, and the worked solution."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from dalembert.analysis.methods.solved.step_choice import Choice
from dalembert.exams.asked import blanks, figure, place_of_answer, question_words
from dalembert.reports import Report, report
from dalembert.reports.report_context import METHODS, ReportContext
from dalembert.reports.sections.given import knowns
from dalembert.reports.sheet import Blanks, ReportSheet
from dalembert.views.notation import Notation, Shown
from dalembert.views.stated import as_stated

if TYPE_CHECKING:
    from collections.abc import Sequence

    from dalembert.analysis.result.result import Result
    from dalembert.model import StatedAnswer


def question_sheet(
    r: Result, questions: Sequence[StatedAnswer], name: str = "", notation: Notation | None = None
) -> Report:
    """Given data, the figure to scale without computed values, and the questions, with space for each number."""
    notation, k = as_stated(notation), place_of_answer(r, questions[0])
    c = ReportContext(r, k, Shown(r, notation), METHODS, Choice(), notation, question=True)
    sheet = ReportSheet(r.mechanism.title or "Force analysis", "", f"Variant {name}" if name else "")
    sheet.blocks.append(Blanks((("", (("Name", ""), ("Date", ""))),)))
    knowns(sheet, c)
    sheet.heading("Find")
    units = r.mechanism.units
    rows = [(question_words(c.shown, a), blanks(a, figure(r, a), units)) for a in questions]
    sheet.blocks.append(Blanks(tuple(rows)))
    sheet.heading("Working", room=True)
    return Report(sheet)


def solution_sheet(
    r: Result, questions: Sequence[StatedAnswer], name: str = "", notation: Notation | None = None
) -> Report:
    """The worked report of the position of the question, with the variant's name."""
    worked = report(r, place_of_answer(r, questions[0]) + 1, notation=notation).sheet
    return Report(replace(worked, subtitle=f"Variant {name}, solution. {worked.subtitle}"))
