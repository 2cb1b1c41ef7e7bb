"""Tables of text from CSV files: rows with their lines, nothing computed or guessed."""

from __future__ import annotations

import csv
import io
import re
from pathlib import Path
from typing import Any, NamedTuple

from dalembert.errors import ModelError
from dalembert.model.quantities.column_files import file_text

MOST_ROWS = 100_000
"""Rows of a table."""


class TableRow(NamedTuple):
    """Cells by column, without empty ones, and their line."""

    line: int
    cells: dict[str, str]


def read_table(path: Path) -> list[TableRow]:
    """The rows of a CSV file, its columns in lower case; `,`, `;` or tabs between them."""
    text = file_text(path)
    first = text.lstrip("\r\n").split("\n", 1)[0]
    between = max(",;\t", key=first.count)
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=between, strict=True)
    try:
        rows = _rows(reader, path)
    except csv.Error as error:
        said = f"the table cannot be read: {error}"
        raise ModelError(said, "save it as CSV, UTF-8", (), str(path), reader.line_num) from None
    if not rows:
        raise ModelError("the table has no rows", "write a heading and a row a figure", (), str(path), 1)
    return rows


def _rows(reader: Any, path: Path) -> list[TableRow]:
    heads: list[str] = []
    out: list[TableRow] = []
    for cells in reader:
        cells = [cell.strip() for cell in cells]
        if not any(cells):
            continue
        if not heads:
            heads = [re.sub(r"\s*\[.*\]$", "", cell) for cell in cells]
            heads = [head.lower() if head.lower() in COLUMNS else head for head in heads]
            continue
        named = {head: cell for head, cell in zip(heads, cells, strict=False) if head and cell}
        out.append(TableRow(reader.line_num, named))
        if len(out) > MOST_ROWS:
            said = f"the table has more than {MOST_ROWS} rows"
            raise ModelError(said, "divide it", (), str(path), reader.line_num)
    return out


KEYS = ("quantity", "of", "on", "by", "at", "extreme", "component", "axes")
"""Columns that say what a figure is of."""

COLUMNS = ("student", "variant", "file", *KEYS, "value", "unit", "tolerance", "marks")
"""Columns that are recognised in any case."""
