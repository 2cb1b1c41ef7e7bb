"""A class's answers: a sheet a student as YAML, JSON, TOML or CSV in a folder, or a table with a row a student."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from dalembert.errors import DalembertError, MissingFileError, ModelError
from dalembert.grading.answer_sheet import about_sheet, sheet_items
from dalembert.grading.marking.figure_names import FigureNames, columns_of, unit_of
from dalembert.grading.marking.key import cell_value, place
from dalembert.grading.marking.table_files import KEYS, TableRow, is_table, read_table
from dalembert.grading.written_figure import NUMBER, decimal_comma, written_unit

ENDINGS = (".yaml", ".yml", ".json", ".toml", ".csv", ".xlsx")
MOST = 5000
"""Sheets of a class."""


class Given(NamedTuple):
    """A figure as a student gave it: keys of an answer, its line, its column, and the unit of its bare numbers, empty
    if it is that of the key."""

    keys: dict[str, Any]
    line: int
    column: str = ""
    unit: str = ""

    @property
    def name(self) -> str:
        """The figure in a few words: its column, or its quantity and what it is of."""
        return self.column or " ".join(
            filter(None, (str(self.keys.get(k) or "") for k in ("quantity", "of")))
        )


@dataclass
class StudentSheet:
    """Answers of a student; ``problems`` are sentences on unreadable parts, ``comma`` says whether the numbers have a
    decimal comma (None: not known)."""

    student: str
    file: str
    variant: str = ""
    tolerance: str | None = None
    figures: list[Given] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    line: int = 1
    comma: bool | None = None


def class_sheets(
    path: str | Path, names: FigureNames | None = None, columns: Mapping[str, str] | None = None
) -> list[StudentSheet]:
    """The sheets of a folder, or of one file; what cannot be read is a sheet with a sentence.

    ``names`` are those of the problem, for headings such as `F23`; ``columns`` says what other headings mean.
    """
    names, known = names or FigureNames(), columns or {}
    path = Path(path)
    if not path.is_dir():
        if not path.exists():
            raise MissingFileError(str(path), "name a folder of answers, or a table")
        return list(_sheets(path, names, known, strict=True))
    files = sorted(p for p in path.iterdir() if p.suffix.lower() in ENDINGS and not p.name.startswith("."))
    if not files:
        raise ModelError(f"{path} has no answer files", f"their names end in {', '.join(ENDINGS)}")
    sheets = [sheet for file in files for sheet in _sheets(file, names, known)]
    if len(sheets) > MOST:
        raise ModelError(f"there are {len(sheets)} sheets", f"divide them: at most {MOST}")
    return sheets


def _sheets(
    path: Path, names: FigureNames, given: Mapping[str, str], strict: bool = False
) -> Iterator[StudentSheet]:
    try:
        yield from _of_table(path, names, given) if is_table(path) else [_of_file(path)]
    except DalembertError as error:
        if strict:
            raise
        yield StudentSheet(path.stem, str(path), problems=[str(error)])


def _of_file(path: Path) -> StudentSheet:
    """A sheet as `check-answers` reads it; a figure that cannot be read does not spoil the others."""
    from dalembert.model.files.model_files import read_file

    tree, source = read_file(path)
    about = about_sheet(tree)
    sheet = StudentSheet(
        about["student"] or path.stem, str(path), about["variant"], about["tolerance"] or None
    )
    try:
        sheet.figures = [Given(item, source.line(at)) for at, item in sheet_items(tree)]
    except ModelError as error:
        raise error.at_source(source) from None
    return sheet


def _of_table(path: Path, names: FigureNames, given: Mapping[str, str]) -> Iterator[StudentSheet]:
    """Sheets of a table: a row a figure (columns quantity, of, value), or a row a student (columns effort.O2 ...)."""
    rows = read_table(path)
    if any("quantity" in row.cells for row in rows):
        yield from _long(path, rows)
        return
    try:
        columns = columns_of(rows[0].heads, names, given)
    except ModelError as error:
        raise error.at_line(str(path), 1) from None
    comma = decimal_comma(text for row in rows for head, text in row.cells.items() if head in columns.figures)
    units = {h: written_unit(rows[0].units.get(h, "")) or unit_of(h) for h in columns.figures}
    for row in rows:
        student = (
            " ".join(row.cells[head] for head in columns.student if head in row.cells) or f"row {row.line}"
        )
        variant = row.cells.get(columns.variant, "") if columns.variant else ""
        figures = [
            Given(keys | {"value": row.cells[head]}, row.line, head, units[head])
            for head, keys in columns.figures.items()
            if head in row.cells
        ]
        sheet = StudentSheet(student, str(path), variant, line=row.line, comma=comma)
        sheet.figures = list(_joined(figures, names))
        yield sheet


def _long(path: Path, rows: list[TableRow]) -> Iterator[StudentSheet]:
    """Sheets of a table with a row a figure."""
    by_student: dict[str, StudentSheet] = {}
    comma = decimal_comma(row.cells.get("value", "") for row in rows)
    for row in rows:
        name = row.cells.get("student", path.stem)
        if name not in by_student:
            variant = row.cells.get("variant", "")
            by_student[name] = StudentSheet(name, str(path), variant, line=row.line, comma=comma)
        cells = row.cells
        keys: dict[str, object] = {key: cells[key] for key in KEYS if key in cells}
        value = cell_value(cells["value"]) if "value" in cells else None
        known = Given(
            keys | {"at": place(cells.get("at")), "value": value}, row.line, unit=cells.get("unit", "")
        )
        by_student[name].figures.append(known)
    yield from by_student.values()


def _joined(figures: list[Given], names: FigureNames) -> Iterator[Given]:
    """Figures with the parts of a vector that two columns give made one: size and direction, or x and y; not where
    the components are what is required."""
    by_vector: dict[tuple[object, ...], dict[str | None, Given]] = {}
    for one in figures:
        vector = tuple(one.keys.get(key) for key in ("quantity", "of", "on"))
        by_vector.setdefault(vector, {})[one.keys.get("component")] = one
    for (quantity, of, _), parts in by_vector.items():
        for written, pair in ((" @ ", ("magnitude", "direction")), ("; ", ("x", "y"))):
            requested = any((quantity, of, part) in names.asked for part in pair)
            if requested or not all(part in parts for part in pair):
                continue
            a, b = parts.pop(pair[0]), parts.pop(pair[1])
            keys = {key: value for key, value in a.keys.items() if key != "component"}
            text = f"{_in_unit(a)}{written}{_in_unit(b)}"
            parts[None] = Given(keys | {"value": text}, a.line, f"{a.column}, {b.column}")
        yield from parts.values()


def _in_unit(one: Given) -> str:
    """The cell of a figure with the unit of its column, if it is a number alone."""
    text, unit = str(one.keys["value"]), one.unit
    return f"{text} {unit}".rstrip() if re.fullmatch(NUMBER, text) else text
