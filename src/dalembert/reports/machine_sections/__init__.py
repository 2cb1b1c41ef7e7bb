"""Sections of the worked solution for answers of machine design.

In: an answer of ``machine``, a notation. Out: a ``Sheet``. Imports ``machine``, ``views``.
"""

from __future__ import annotations

from dalembert.machine.output.machine_answer import MachineAnswer
from dalembert.reports.sheet import Sheet
from dalembert.views.notation import Notation, Shown, pretty


def machine_sheet(answer: MachineAnswer, notation: Notation | None = None) -> Sheet:
    """The worked solution of an answer: its equations in letters and numbers, what is found, its drawings."""
    shown = Shown(answer.result, notation or Notation())
    sheet = Sheet(answer.result.mechanism.title or "Machine", answer.result.mechanism.source_text)
    answer.section(sheet, shown)
    for part in answer.contents(shown.notation.units):
        if isinstance(part, str):
            sheet.text((pretty(part) if "*" in part else part).replace("\n", "; "))
        else:
            heads = [pretty(head.replace("\n", " ")) for head in part.heads]
            rows = [[pretty(cell) for cell in row] for row in part.rows]
            sheet.table(heads, rows, part.note.replace("\n", " "))
    sheet.figure(*answer.drawings(shown.notation))
    return sheet
