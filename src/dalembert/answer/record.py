"""An answer as one mapping with everything, and as JSON with a row a line."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import IO, TYPE_CHECKING

from dalembert.answer.column import Axes, UnitChoice, plain
from dalembert.arrays import Tree

if TYPE_CHECKING:
    from dalembert.answer.answer import Answer

VERSION = 2
"""Version of the JSON answer."""


def head(answer: Answer, units: UnitChoice) -> Tree:
    """Part that precedes the rows: title, units, the assumptions, and the numbers that are not a column."""
    to, basis = answer.scale(units), answer.basis()
    assumed = {key: text for key, text in basis.items() if key not in ("title", "source", "mobility")}
    return {
        "dalembert": VERSION,
        "title": basis.get("title", ""),
        "units": to.names(),
        "assumptions": assumed,
        **plain(answer.record(to)),
    }


def column_records(answer: Answer, units: UnitChoice, axes: Axes) -> Iterator[Tree]:
    """One mapping a row: names of the columns with their values."""
    to, some = answer.scale(units), list(answer.columns(axes))
    names = [c.name for c in some]
    for part in answer.blocks(len(some[0].values)):
        for cells in zip(*(c.cells(to, part) for c in some), strict=True):
            yield dict(zip(names, map(plain, cells), strict=True))


def write_json(answer: Answer, stream: IO[str], units: UnitChoice, axes: Axes, **choice: object) -> None:
    """The record into an open text file, one row a line."""
    before = json.dumps(answer.head(units, axes), ensure_ascii=False, allow_nan=False, indent=1)
    stream.write(before.removesuffix("\n}") + f',\n "{answer.ROWS}": [')
    for k, record in enumerate(answer.records(units, axes, **choice)):
        stream.write((",\n  " if k else "\n  ") + json.dumps(record, ensure_ascii=False, allow_nan=False))
    stream.write("]}\n")
