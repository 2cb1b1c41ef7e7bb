"""Tables of text from CSV files and workbooks: rows with their lines, nothing computed or guessed."""

from __future__ import annotations

import csv
import io
import re
import zipfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

from dalembert.errors import MissingFileError, ModelError
from dalembert.model.quantities.column_files import file_text

MOST_ROWS = 100_000
"""Rows of a table."""


class TableRow(NamedTuple):
    """Cells by column, without empty ones, their line, the headings of the table, and the unit in brackets behind
    each."""

    line: int
    cells: dict[str, str]
    heads: tuple[str, ...] = ()
    units: Mapping[str, str] = MappingProxyType({})


def is_table(path: Path) -> bool:
    """True for the endings of tables."""
    return path.suffix.lower() in (".csv", ".xlsx")


def read_table(path: Path) -> list[TableRow]:
    """The rows of a CSV file (`,`, `;` or tabs between columns), or of the first sheet of a workbook."""
    rows = _rows(_of_workbook(path) if path.suffix.lower() == ".xlsx" else _of_csv(path), path)
    if not rows:
        raise ModelError("the table has no rows", "write a heading and one row per figure", (), str(path), 1)
    return rows


def _of_csv(path: Path) -> Iterator[tuple[int, list[str]]]:
    text = file_text(path)
    first = re.sub(r'"[^"]*"', "", text.lstrip("\r\n").split("\n", 1)[0])
    between = max("\t;,", key=first.count)  # a comma may be one of a heading
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=between, strict=True)
    try:
        for cells in reader:
            yield reader.line_num, cells
    except csv.Error as error:
        words = f"the table cannot be read: {error}"
        raise ModelError(words, "save it as CSV, UTF-8", (), str(path), reader.line_num) from None


def _of_workbook(path: Path) -> Iterator[tuple[int, list[str]]]:
    """Cells of the first sheet as they would be typed; what a formula gave when the file was saved."""
    try:
        import openpyxl
    except ImportError:
        remedy = "install dalembert[results], or save the table as CSV"
        raise ModelError("a workbook needs openpyxl", remedy, (), str(path)) from None
    if not path.exists():
        raise MissingFileError(str(path), "name a table (.csv, .xlsx)")
    try:
        book = openpyxl.load_workbook(path, read_only=True, data_only=True)
        for line, cells in enumerate(book.worksheets[0].iter_rows(values_only=True), 1):
            yield line, ["" if cell is None else str(cell) for cell in cells]
    except (OSError, ValueError, KeyError, IndexError, zipfile.BadZipFile) as error:
        raise ModelError("the file is not a workbook", "save it as .xlsx or CSV", (), str(path)) from error


def _rows(lines: Iterator[tuple[int, list[str]]], path: Path) -> list[TableRow]:
    heads: list[str] = []
    units: dict[str, str] = {}
    out: list[TableRow] = []
    for line, cells in lines:
        cells = [cell.strip() for cell in cells]
        if not any(cells):
            continue
        if not heads:
            heads = [re.sub(r"\s*\[.*\]$", "", cell) for cell in cells]
            heads = [head.lower() if head.lower() in COLUMNS else head for head in heads]
            units = {h: cell[len(h) :].strip(" []") for h, cell in zip(heads, cells, strict=True)}
            continue
        if any(cells[len(heads) :]) and path.suffix.lower() == ".csv":
            what = f"the row has {len(cells)} cells, and the heading {len(heads)}"
            remedy = "write numbers with commas in quotes, or ; between the columns"
            raise ModelError(what, remedy, (), str(path), line)
        named = {head: cell for head, cell in zip(heads, cells, strict=False) if head and cell}
        out.append(TableRow(line, named, tuple(filter(None, heads)), units))
        if len(out) > MOST_ROWS:
            raise ModelError(f"the table has more than {MOST_ROWS} rows", "divide it", (), str(path), line)
    return out


KEYS = ("quantity", "of", "on", "by", "at", "extreme", "component", "axes")
"""Columns that say what a figure is of."""

COLUMNS = ("student", "variant", "file", *KEYS, "value", "unit", "tolerance", "marks")
"""Columns that are recognised in any case."""
