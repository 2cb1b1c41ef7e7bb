"""Cells of a class's sheets: read, or handed to the teacher with a sentence."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from dalembert.errors import ModelError
from dalembert.grading.answer_sheet import VECTORS, answer_of, with_size
from dalembert.grading.file_answers import value_text
from dalembert.grading.marking.class_sheets import Given, StudentSheet
from dalembert.grading.marking.figure_names import FigureNames
from dalembert.grading.marking.key import cell_value, with_units
from dalembert.grading.marking.student_marks import StudentMarks
from dalembert.grading.marking.table_files import read_table
from dalembert.grading.quantities import WHOLE, WORDS
from dalembert.grading.written_figure import WrittenFigure, readings_of, written_unit
from dalembert.wording import quote_value

if TYPE_CHECKING:
    from dalembert.model import StatedAnswer

SYMBOLS = ("f", "r", "t", "m", "ans", "answer", "result", "x")
"""Names before a value that say nothing: they fit every column."""


PAIR = re.compile(r"([-+]?\d+(?:\.\d+)?)(?:\s*,\s*|\s+)([-+]?\d+(?:\.\d+)?)")
"""Two numbers that may be components: `118,100`."""


class ReadFigure(NamedTuple):
    """A figure of a sheet: its readings, or a sentence for the teacher; its cell, its place, and how it was read."""

    answers: tuple[StatedAnswer, ...]
    problem: str
    cell: str
    where: tuple[str, int]
    notes: tuple[str, ...] = ()

    def choice(self, best: int) -> str:
        """The sentence on a cell with two readings."""
        texts = [value_text(answer.value) for answer in self.answers]
        return f"{self.cell} may be {' or '.join(texts)}: {texts[best]}, the nearer to the key, counts"


def read_figure(one: Given, sheet: StudentSheet, names: FigureNames) -> ReadFigure:
    """The readings of a figure of a sheet."""
    value, where = one.keys.get("value"), (sheet.file, one.line)
    cell = f"{sheet.file}:{one.line}: {one.name}: {quote_value(value)}"
    word = value in (None, "") or one.keys.get("quantity") in (*WORDS, *WHOLE)
    w = WrittenFigure((value,)) if word else readings_of(value, sheet.comma)
    if sheet.comma is not True and _may_be_vector(one):
        components = readings_of(PAIR.sub(r"\1; \2", str(value)), False).readings
        w = w._replace(readings=(*w.readings, *(c for c in components if c not in w.readings)))
    if w.name and w.name.lower() not in SYMBOLS and not _fits(names.keys(w.name), one):
        return ReadFigure((), f"{cell} names {w.name}: it is read by hand", cell, where)
    if not w.readings and not w.blank:
        return ReadFigure((), f"{cell} has no reading: it is read by hand", cell, where)
    try:
        answers = []
        for reading in w.readings or (None,):
            keys = one.keys | {"value": with_units(reading, written_unit(one.unit) or one.unit)}
            answers.append(answer_of(with_size(keys) if one.column else keys))
    except ModelError as error:
        return ReadFigure((), str(error.at_line(*where)), cell, where)
    return ReadFigure(tuple(answers), "", cell, where, w.notes)


def _may_be_vector(one: Given) -> bool:
    """True if a cell for a vector has two numbers with a comma or a space between, which may be one number, too."""
    vector = str(one.keys.get("quantity")).startswith(VECTORS) and not one.keys.get("component")
    return bool(one.column) and vector and PAIR.fullmatch(str(one.keys["value"])) is not None


def _fits(keys: dict[str, object] | None, one: Given) -> bool:
    """True if the name before a value is that of its column."""
    return keys is not None and all(keys.get(k) == one.keys.get(k) for k in ("quantity", "of"))


def decide_cells(sheets: Sequence[StudentSheet], path: Path) -> None:
    """Replaces cells by a teacher's readings: a table of student, figure (its column) and value."""
    for row in read_table(path):
        lacking = [name for name in ("student", "figure", "value") if name not in row.cells]
        if lacking:
            remedy = "the columns are student, figure and value"
            raise ModelError(f"the row has no {lacking[0]}", remedy, (), str(path), row.line)
        student, figure, value = (row.cells[name] for name in ("student", "figure", "value"))
        sheet = next((s for s in sheets if s.student == student), None)
        places = [] if sheet is None else [k for k, one in enumerate(sheet.figures) if one.name == figure]
        if sheet is None or not places:
            known = [s.student for s in sheets] if sheet is None else [one.name for one in sheet.figures]
            what = f"student {student!r}" if sheet is None else f"figure {figure!r} on the sheet of {student}"
            raise ModelError(f"unknown {what}", f"there are {', '.join(known)}", (), str(path), row.line)
        for k in places:
            one = sheet.figures[k]
            sheet.figures[k] = one._replace(keys=one.keys | {"value": cell_value(value)})


def check_class(students: Sequence[StudentMarks], file: str) -> None:
    """Raises ModelError where figures of a complete class are judged and none is right: the key or the columns are
    others."""
    judged = [m for s in students for m in s.marks if m.given and m.most]
    if len({s.student for s in students if any(m.given for m in s.marks)}) < LEAST or any(
        m.marks for m in judged
    ):
        return
    if judged:
        raise ModelError(
            f"not one of {len(judged)} figures of {len(students)} students is right",
            "check that the key, its variants and the columns are those of these sheets",
            (),
            file,
        )


LEAST = 3
"""Students of a class without any figure that chance could make right."""
