"""A class's answers: a sheet a student as YAML, JSON, TOML or CSV in a folder, or a table with a row a student."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from dalembert.errors import DalembertError, MissingFileError, ModelError
from dalembert.grading.answer_sheet import about_sheet, named_figure, sheet_items
from dalembert.grading.marking.key import cell_value, place
from dalembert.grading.marking.table_files import KEYS, TableRow, read_table

ENDINGS = (".yaml", ".yml", ".json", ".toml", ".csv")
MOST = 5000
"""Sheets of a class."""


class Given(NamedTuple):
    """A figure as a student gave it: keys of an answer, and its line."""

    keys: dict[str, Any]
    line: int


@dataclass
class StudentSheet:
    """Answers of a student; ``problems`` are sentences on unreadable parts."""

    student: str
    file: str
    variant: str = ""
    tolerance: str | None = None
    figures: list[Given] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    line: int = 1


def class_sheets(path: str | Path) -> list[StudentSheet]:
    """The sheets of a folder, or of one file; what cannot be read is a sheet with a sentence."""
    path = Path(path)
    if not path.is_dir():
        if not path.exists():
            raise MissingFileError(str(path), "name a folder of answers, or a table")
        return list(_sheets(path, strict=True))
    files = sorted(p for p in path.iterdir() if p.suffix.lower() in ENDINGS and not p.name.startswith("."))
    if not files:
        raise ModelError(f"{path} has no answer files", f"their names end in {', '.join(ENDINGS)}")
    sheets = [sheet for file in files for sheet in _sheets(file)]
    if len(sheets) > MOST:
        raise ModelError(f"there are {len(sheets)} sheets", f"divide them: at most {MOST}")
    return sheets


def _sheets(path: Path, strict: bool = False) -> Iterator[StudentSheet]:
    try:
        yield from _of_table(path) if path.suffix.lower() == ".csv" else [_of_file(path)]
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


def _of_table(path: Path) -> Iterator[StudentSheet]:
    """Sheets of a table: a row a figure (columns quantity, of, value), or a row a student (columns effort.O2 ...)."""
    rows = read_table(path)
    long = any("quantity" in row.cells for row in rows)
    by_student: dict[str, StudentSheet] = {}
    for row in rows:
        name = row.cells.get("student", path.stem if long else f"row {row.line}")
        if not long or name not in by_student:
            key = name if long else f"{name} {row.line}"
            by_student[key] = StudentSheet(name, str(path), row.cells.get("variant", ""), line=row.line)
        sheet = by_student[name if long else f"{name} {row.line}"]
        try:
            sheet.figures += [_long(row)] if long else list(_wide(row))
        except ModelError as error:
            sheet.problems.append(str(error.at_line(str(path), row.line)))
    yield from by_student.values()


def _long(row: TableRow) -> Given:
    cells = row.cells
    keys: dict[str, object] = {name: cells[name] for name in KEYS if name in cells}
    value = cell_value(cells["value"], cells.get("unit", "")) if "value" in cells else None
    return Given(keys | {"at": place(cells.get("at")), "value": value}, row.line)


def _wide(row: TableRow) -> Iterator[Given]:
    for name, text in row.cells.items():
        if name not in ("student", "variant"):
            yield Given(named_figure(name, cell_value(text)), row.line)
