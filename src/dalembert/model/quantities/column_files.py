"""Columns of numbers in a text file beside a model file: commas, semicolons or tabs between them, and a head.

Messages name the file and the line. A file is read as text, all at once, and only from the model's folder or an allowed
one.
"""

from __future__ import annotations

import csv
import math
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from dalembert.errors import MissingFileError, ModelError
from dalembert.model.part import ReadingRules
from dalembert.units import NUMBER
from dalembert.wording import closest, quote_value

LARGEST, MOST = 10_000_000, 100_000
"""Bytes and rows of a file."""

ENDINGS = (".csv", ".tsv", ".txt")
_HEAD = re.compile(r"(?P<name>.*?)\s*(?:\[(?P<unit>[^]]*)\]|\((?P<other>[^)]*)\))?")
_DECIMAL_COMMA = re.compile(r"([+-]?\d*),(\d+(?:[eE][+-]?\d+)?)")


@dataclass(frozen=True, slots=True)
class FileColumn:
    """Numbers of a column as written, each with its line; the unit that the head (on its line) states."""

    name: str
    unit: str
    head: int
    values: tuple[float, ...]
    lines: tuple[int, ...]


def read_columns(file: str, wanted: Sequence[str | int], rules: ReadingRules) -> list[FileColumn]:
    """The columns asked for, by names in the head or numbers from 1; raises ModelError with file and line."""
    path = find_file(file, rules)
    file = os.path.join(rules.folder, file)
    text = file_text(path, file)
    rows = _rows(text)
    if len(rows) > MOST:
        raise _error(f"more than {MOST} rows", "leave every second row out, or more", file, rows[MOST][0])
    cells = _Cells(file, rows)
    heads = cells.heads()
    places = [_place(column, k, heads, cells) for k, column in enumerate(wanted)]
    numbers = [cells.numbers(place, heads[place][0]) for place in places]
    lines = tuple(n for n, _ in cells.rows)
    return [FileColumn(*heads[k], cells.head, x, lines) for k, x in zip(places, numbers, strict=True)]


def read_quantities(
    file: str | os.PathLike[str], kinds: Mapping[str, str], rules: ReadingRules, names: str = ""
) -> tuple[dict[str, Any], tuple[int, ...]]:
    """Columns by name in SI, each of a kind, and the lines of their rows; ``names``: a column of texts besides.

    The file is one that the user names, anywhere. A head without a unit means that of the rules.
    """
    path = Path(file)
    rules = replace(rules, folder=str(path.parent))
    out: dict[str, Any] = {}
    columns = read_columns(path.name, list(kinds), rules)
    for column, kind in zip(columns, kinds.values(), strict=True):
        try:
            out[column.name] = [
                rules.quantity(f"{v!r} {column.unit}".strip() if column.unit else v, kind)
                for v in column.values
            ]
        except ModelError as error:
            raise _error(error.what, error.remedy, str(path), column.head) from None
    if names:
        cells = _Cells(str(path), _rows(file_text(path)))
        place = _place(names, 0, cells.heads(), cells)
        out[names] = [row[place] for _, row in cells.rows]
    return out, columns[0].lines


def _rows(text: str) -> list[tuple[int, str]]:
    """Lines that say something, with their numbers."""
    lines = enumerate(text.split("\n"), 1)
    return [(n, line) for n, line in lines if line.strip() and line.strip()[0] != "#"]


def find_file(file: str, rules: ReadingRules) -> Path:
    """Path of the file: in the model's folder, or in the other allowed one, links resolved."""
    if not isinstance(file, str) or not file.lower().endswith(ENDINGS):
        what = f"{quote_value(file)} is not a file of columns"
        raise ModelError(what, f"name one that ends in {', '.join(ENDINGS)}")
    try:
        folders = [
            Path(folder or ".").resolve()
            for folder in dict.fromkeys((rules.folder, rules.data or rules.folder))
        ]
        inside = [
            path
            for path in ((folder / file).resolve() for folder in folders)
            if any(path.is_relative_to(allowed) for allowed in folders)
        ]
        existing = next((path for path in inside if path.exists()), None)
    except (OSError, ValueError, RuntimeError):
        raise ModelError(f"{quote_value(file)} is not a valid path", "check the name") from None
    if not inside:
        remedy = "move it into that folder, or allow its folder: --data FOLDER, in Python da.load(..., data=FOLDER)"
        raise ModelError(f"the file {file!r} is outside the model file's folder", remedy)
    if existing is None:
        raise ModelError(f"file {file!r} does not exist", "check the name; it is relative to the model file")
    return existing


def file_text(path: Path, file: str = "") -> str:
    """The text of a file of bounded size; ModelError with ``file``, its path by default, and the line."""
    file = file or str(path)
    if not os.path.exists(path):
        raise MissingFileError(file)
    try:
        if not path.is_file():
            raise _error("no ordinary file", "name a text file of columns", file, 1)
        with path.open("rb") as stream:
            content = stream.read(LARGEST + 1)
    except OSError as error:
        raise _error(f"it cannot be read: {error.strerror}", "check its permissions", file, 1) from None
    if len(content) > LARGEST:
        raise _error(f"more than {LARGEST} bytes", "leave every second row out, or more", file, 1)
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        text, at = "", error.start
    else:
        at = text.find("\0")
    if at >= 0:
        raise _error("not UTF-8 text", "save it as text, CSV UTF-8", file, content[:at].count(b"\n") + 1)
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _error(what: str, remedy: str, file: str, line: int) -> ModelError:
    return ModelError(what, remedy, (), file, line)


class _Cells:
    """The rows of a file, cut into cells; ``head`` is the line of the head, or of the first row."""

    def __init__(self, file: str, rows: list[tuple[int, str]]) -> None:
        self.file = file
        if not rows:
            raise _error("it has no rows", "give it a head and one row for each point", file, 1)
        first = rows[0][1]
        self.between = next((sign for sign in "\t;," if sign in first), "")
        self.rows = [(n, self._cut(n, line)) for n, line in rows]
        self.head, self.width = self.rows[0][0], len(self.rows[0][1])

    def _cut(self, n: int, line: str) -> list[str]:
        if not self.between:
            return line.split()
        line = re.sub(r'" +(?=[,;\t])', '"', line.strip(" "))
        try:
            cut = next(csv.reader([line], delimiter=self.between, skipinitialspace=True, strict=True))
        except csv.Error as error:
            raise _error(f"it cannot be read: {error}", "close its quotes", self.file, n) from None
        return [cell.strip() for cell in cut]

    def heads(self) -> list[tuple[str, str]]:
        """Name and unit of each column, taken off the rows; empty without a head. Units may be in a separate row."""
        first = self.rows[0][1]
        if all(self._number(cell) is not None for cell in first):
            return [("", "")] * self.width
        self.rows = self.rows[1:]
        matches = [match for cell in first if (match := _HEAD.fullmatch(cell))]
        heads = [
            (match["name"].strip('" '), (match["unit"] or match["other"] or "").strip()) for match in matches
        ]
        below = self.rows[0][1] if self.rows else []
        if len(below) == self.width and all(re.match(r"[\[(]?[^\W\d]|[\[(]?[°%]|-$", cell) for cell in below):
            units = [cell.strip("[]() ") for cell in below]
            if not any(unit.lower() in ("nan", "inf", "infinity") for unit in units):
                self.rows = self.rows[1:]
                heads = [
                    (name, stated or unit.strip("-"))
                    for (name, stated), unit in zip(heads, units, strict=True)
                ]
        return heads

    def _number(self, cell: str) -> float | None:
        plain = cell.replace("\u2212", "-")
        if self.between != "," and (match := _DECIMAL_COMMA.fullmatch(plain)):
            plain = f"{match[1]}.{match[2]}"
        return float(plain) if re.fullmatch(NUMBER, plain) else None

    def numbers(self, place: int, name: str) -> tuple[float, ...]:
        """The numbers of a column."""
        out = []
        for n, row in self.rows:
            if len(row) < self.width or any(row[self.width :]):
                remedy = "give every row the same; where commas are decimal, put semicolons between columns"
                raise _error(f"{len(row)} columns where the first row has {self.width}", remedy, self.file, n)
            value = self._number(row[place])
            if value is None or not math.isfinite(value):
                what = f" in column {name!r}" if name else ""
                problem = f"{quote_value(row[place])}{what} is not a finite number"
                raise _error(problem, "correct it, or take the row out", self.file, n)
            out.append(value)
        return tuple(out)


def _place(column: str | int, k: int, heads: list[tuple[str, str]], cells: _Cells) -> int:
    """Index of the column that is meant."""
    names = [name for name, _ in heads]
    if isinstance(column, int) and not isinstance(column, bool) and 1 <= column <= len(heads):
        return column - 1
    if isinstance(column, str) and names.count(column) == 1:
        return names.index(column)
    twice = "twice" if isinstance(column, str) and column in names else "not"
    known = f"write its number, from 1 to {len(heads)}" if not any(names) or twice == "twice" else ""
    what = f"the column {quote_value(column)} is {twice} in its head"
    raise ModelError(what, known or closest(str(column), names), ("columns", k), cells.file, cells.head)
