"""Tables of text from CSV files: rows with their lines, nothing computed or guessed."""

from __future__ import annotations

import csv
import io
import re
from pathlib import Path
from typing import Any, NamedTuple

from dalembert.errors import ModelError

LARGEST, MOST_ROWS = 10_000_000, 100_000
"""Bytes and rows of a table."""


class Row(NamedTuple):
    """Cells by column, those that are empty left out, and the line they stand on."""

    line: int
    cells: dict[str, str]


def read_table(path: Path) -> list[Row]:
    """The rows of a CSV file, its columns in lower case; `,`, `;` or tabs between them."""
    text = read_text(path)
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


def _rows(reader: Any, path: Path) -> list[Row]:
    heads: list[str] = []
    out: list[Row] = []
    for cells in reader:
        cells = [cell.strip() for cell in cells]
        if not any(cells):
            continue
        if not heads:
            heads = [re.sub(r"\s*\[.*\]$", "", cell) for cell in cells]
            heads = [head.lower() if head.lower() in COLUMNS else head for head in heads]
            continue
        named = {head: cell for head, cell in zip(heads, cells, strict=False) if head and cell}
        out.append(Row(reader.line_num, named))
        if len(out) > MOST_ROWS:
            said = f"the table has more than {MOST_ROWS} rows"
            raise ModelError(said, "divide it", (), str(path), reader.line_num)
    return out


KEYS = ("quantity", "of", "on", "by", "at", "extreme", "component", "axes")
"""Columns that say what a figure is of."""

COLUMNS = ("student", "variant", "file", *KEYS, "value", "unit", "tolerance", "marks")
"""Columns that are found in whatever case."""


def read_text(path: Path) -> str:
    """The text of a file, UTF-8, of bounded size."""
    try:
        if not path.is_file():
            raise ModelError("it is no file", "name a table of text", (), str(path), 1)
        with path.open("rb") as file:
            content = file.read(LARGEST + 1)
    except OSError as error:
        said = f"it cannot be read: {(error.strerror or str(error)).lower()}"
        raise ModelError(said, "check its name and permissions", (), str(path), 1) from None
    if len(content) > LARGEST:
        raise ModelError(f"the file has more than {LARGEST} bytes", "divide it", (), str(path), 1)
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content[: error.start].count(b"\n") + 1
        raise ModelError(
            "the file is no text in UTF-8", "save it as CSV, UTF-8", (), str(path), line
        ) from None
