"""Answers of machine design as parts of a report: their equations, what they print, their drawings."""

from __future__ import annotations

from dalembert.errors import AnalysisError, ModelError
from dalembert.machine.output.machine_answer import MachineAnswer
from dalembert.reports.design.verdict import DesignContext
from dalembert.reports.machine_sections import put_parts
from dalembert.reports.sheet import Heading, ReportSheet
from dalembert.views.notation import Shown


def put_answer(sheet: ReportSheet, answer: MachineAnswer, c: DesignContext, drawn: bool = True) -> None:
    """The answer's section without its heading, what it prints, and, if ``drawn``, its drawings where it has some."""
    made = ReportSheet("")
    answer.section(made, Shown(answer.result, c.notation))
    sheet.blocks += [b for n, b in enumerate(made.blocks) if n or not isinstance(b, Heading)]
    put_parts(sheet, answer.contents(c.notation.units))
    if not drawn:
        return
    try:
        sheet.figure(*answer.drawings(c.notation))
    except (ModelError, AnalysisError) as error:
        sheet.text(f"No drawing: {error}.")
