"""Sections of the worked solution for answers of machine design.

In: an answer of ``machine``, a notation. Out: a ``ReportSheet``. Imports ``machine``, ``views``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import pairwise

from dalembert.analysis.result.position_lookup import position_at
from dalembert.answer.answer import Drawn, Worked
from dalembert.machine.output.machine_answer import MachineAnswer
from dalembert.printing import WIDTH, Part
from dalembert.reports.report_context import ReportContext
from dalembert.reports.sections.given import knowns
from dalembert.reports.sheet import ReportSheet
from dalembert.views.notation import Notation, Shown, pretty


def machine_sheet(answer: MachineAnswer, notation: Notation | None = None) -> ReportSheet:
    """The worked solution of an answer: the given data with the drawing of the machine, its equations in letters and
    numbers, the results, its drawings."""
    r = answer.result
    shown = Shown(r, notation or Notation())
    sheet = ReportSheet(r.mechanism.title or "Machine", r.mechanism.source_text)
    if any(status != "not_assembled" for status in r.status):
        k = position_at(r)
        knowns(sheet, ReportContext(r, k, Shown(r, shown.notation, k), notation=shown.notation))
    answer.section(sheet, shown)
    put_parts(sheet, answer.contents(shown.notation.units))
    sheet.figure(*answer.drawings(shown.notation))
    return sheet


def answer_sheet(answer: Worked, notation: Notation | None = None) -> ReportSheet:
    """The page of an answer without equations: what is printed, and its drawings."""
    shown, basis = notation or Notation(), answer.basis()
    sheet = ReportSheet(basis["title"] or type(answer).__name__, basis.get("source", ""))
    put_parts(sheet, answer.contents(shown.units))
    sheet.figure(*(answer.drawings(shown) if isinstance(answer, Drawn) else ()))
    return sheet


def put_parts(sheet: ReportSheet, parts: Iterable[Part]) -> None:
    """Sentences and tables as an answer prints them, put on a sheet."""
    for part in parts:
        if isinstance(part, str):
            head, line, rest = part.partition("\n")
            text = f"{head}: {rest}" if line and head.isalpha() else part  # a list under its heading
            text = unwrapped(text)
            sheet.text(neat(pretty(text) if "*" in text else text))
        else:
            heads = [neat(pretty(head.replace("\n", " "))) for head in part.heads]
            rows = [[neat(pretty(cell)) for cell in row] for row in part.rows]
            sheet.table(heads, rows, part.note.replace("\n", " "))


def unwrapped(text: str) -> str:
    """One paragraph of several lines: those broken for their length go on, others are items of a list.

    >>> unwrapped("one\\ntwo"), len(unwrapped("a" * 79 + "\\n" + "two"))
    ('one; two', 83)
    """
    lines = text.split("\n")
    out = lines[0]
    for before, line in pairwise(lines):
        broken = len(before) + 1 + len(line.split(" ")[0]) > WIDTH
        out += (" " if broken else "; ") + line.strip()
    return out


def neat(text: str) -> str:
    """A text with degrees right behind their numbers.

    >>> neat("78 ° to 90 °, angle °")
    '78° to 90°, angle °'
    """
    return re.sub(r"(?<=\d) °", "°", text)
