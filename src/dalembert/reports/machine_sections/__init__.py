"""Sections of the worked solution for answers of machine design.

In: an answer of ``machine``, a notation. Out: a ``Sheet``. Imports ``machine``, ``views``.
"""

from __future__ import annotations

from importlib import import_module

from dalembert.machine.output.answer import Answer
from dalembert.reports.sheet import Sheet
from dalembert.views.machine import scenes_of
from dalembert.views.notation import Notation, Shown, pretty

OWN = {"member": "member_section", "shaking": "shaking_section"}
"""Answers with a separate file."""


def machine_sheet(answer: Answer, notation: Notation | None = None) -> Sheet:
    """The worked solution of an answer: its equations in letters and numbers, the results, its drawings."""
    shown = Shown(answer.result, notation or Notation())
    sheet = Sheet(answer.result.mechanism.title or "Machine", answer.result.mechanism.source_text)
    file = OWN.get(answer.NAME, "design_sections")
    section = import_module(f"dalembert.reports.machine_sections.{file}")
    getattr(section, f"{answer.NAME}_section")(sheet, answer, shown)
    for part in answer.contents(shown.notation.units):
        if isinstance(part, str):
            sheet.text((pretty(part) if "*" in part else part).replace("\n", "; "))
        else:
            heads = [pretty(head.replace("\n", " ")) for head in part.heads]
            rows = [[pretty(cell) for cell in row] for row in part.rows]
            sheet.table(heads, rows, part.note.replace("\n", " "))
    sheet.figure(*scenes_of(answer, shown.notation))
    return sheet
