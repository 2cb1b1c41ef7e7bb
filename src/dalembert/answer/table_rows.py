"""An answer as a table: rows for CSV and worksheets, and a DataFrame."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator
from typing import IO, TYPE_CHECKING, Literal

import numpy as np

from dalembert.answer.column import WORD, Axes, UnitChoice
from dalembert.saving import check_installed

if TYPE_CHECKING:
    import pandas

    from dalembert.answer.answer import Answer


def rows(answer: Answer, units: UnitChoice, axes: Axes) -> Iterator[list[object]]:
    """Heads with units, then every row with its number; None for a missing value."""
    to, some = answer.scale(units), list(answer.columns(axes))
    yield [answer.ROWS[:-1], *(c.head(to) for c in some)]
    for part in answer.blocks(len(some[0].values)):
        lists = (c.cells(to, part) for c in some)
        for k, cells in enumerate(zip(*lists, strict=True), part.start + answer.FIRST):
            yield [k, *cells]


def write_csv(answer: Answer, stream: IO[str], units: UnitChoice, axes: Axes) -> None:
    """Every row into an open text file; an empty field for a missing value."""
    csv.writer(stream, lineterminator="\n").writerows(rows(answer, units, axes))


def dataframe(
    answer: Answer, units: UnitChoice, axes: Axes, index: Literal["rows", "drives"]
) -> pandas.DataFrame:
    """One line per row, one column per number, units in the names of the columns and in ``attrs["units"]``."""
    check_installed("pandas", "a DataFrame")
    import pandas

    to, some = answer.scale(units), list(answer.columns(axes))
    blocks = list(answer.blocks(len(some[0].values)))
    frame = pandas.DataFrame(
        {c.head(to): np.concatenate([to(c.kind, c.values[part]) for part in blocks]) for c in some}
    )
    numbers = [k + answer.FIRST for part in blocks for k in range(part.start, part.stop)]
    frame.index = pandas.Index(numbers, name=answer.ROWS[:-1])
    drives = [n for n in frame.columns if re.fullmatch(r"drive\.[^.]*( \[.*)?", n)]
    if index == "drives" and drives:
        frame = frame.set_index(drives)
    of = {c.head(to): to.text(c.kind) or "1" for c in some if c.kind != WORD}
    frame.attrs.update(answer.basis(), units=of)
    return frame
