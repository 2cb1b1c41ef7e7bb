"""Answers of this room written out: one row a position (CSV), one mapping with everything (JSON)."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import IO

import numpy as np

from dalembert.analysis.output.columns import UnitChoice, scale
from dalembert.analysis.output.json_record import nan_to_none
from dalembert.arrays import Array, Tree
from dalembert.machine.output.answer import Answer
from dalembert.units import KINDS


def to_dict(answer: Answer, units: UnitChoice = "SI") -> Tree:
    """All numbers of an answer, in SI or in the units of the file; None where unsolved."""
    r, to = answer.result, scale(answer.result, units)
    named = [(c.name, nan_to_none(np.asarray(to(c.kind, c.values)))) for c in answer.columns()]
    rows = zip(*(values for _, values in named), strict=True)
    return {
        "dalembert": 1,
        "title": r.mechanism.title,
        "units": "SI" if units == "SI" else {kind: to.text(kind) for kind in KINDS if to.text(kind)},
        "assumptions": dict(r.assumptions),
        **known(answer.record(to)),
        "positions": [dict(zip([name for name, _ in named], row, strict=True)) for row in rows],
    }


def known(value: object) -> Tree:
    """A tree with plain numbers: arrays as lists, None for what is not finite."""
    made: object = value
    if isinstance(value, dict):
        made = {key: known(item) for key, item in value.items()}
    elif isinstance(value, (list, tuple, np.ndarray)):
        made = [known(item) for item in value]
    elif isinstance(value, (float, np.floating)):
        made = float(value) if math.isfinite(value) else None
    elif isinstance(value, (np.integer, np.bool_)):
        made = value.item()
    return made  # type: ignore[return-value]


def write_json(answer: Answer, stream: IO[str], units: UnitChoice = "SI") -> None:
    """The record into an open text file."""
    json.dump(to_dict(answer, units), stream, indent=2, allow_nan=False)
    stream.write("\n")


def rows(answer: Answer, units: UnitChoice = "SI") -> Iterator[list[object]]:
    """Heads with units, then one row per position; None where unsolved."""
    to, some = scale(answer.result, units), list(answer.columns())
    yield ["position", *(f"{c.name} [{to.text(c.kind)}]" if to.text(c.kind) else c.name for c in some)]
    lists = [nan_to_none(np.asarray(to(c.kind, c.values))) for c in some]
    yield from ([k, *row] for k, row in enumerate(zip(*lists, strict=True), 1))


def write_csv(answer: Answer, stream: IO[str], units: UnitChoice = "SI") -> None:
    """Writes one row per position to an open text file; the field is empty where unsolved."""
    csv.writer(stream, lineterminator="\n").writerows(rows(answer, units))


def write_workbook(answer: Answer, path: Path, units: UnitChoice = "SI") -> None:
    """A sheet of the positions, and one of what is printed."""
    from dalembert.analysis.output.workbook import add_sheet, new_book

    with new_book(path) as book:
        add_sheet(book, "positions", rows(answer, units)).freeze_panes = "C2"
        said: list[list[str]] = []
        for part in answer.contents(units):
            lines = [[part]] if isinstance(part, str) else [part.heads, *part.rows, [part.note]]
            said += [*([cell.replace("\n", " ") for cell in line] for line in lines), []]
        add_sheet(book, "answer", said, (24,))


def rms(values: Array) -> float:
    """Root of the mean square of numbers (P,) or of the lengths of vectors (P, d)."""
    return float(np.sqrt((np.reshape(values, (len(values), -1)) ** 2).sum(axis=1).mean()))


def greatest(values: Array) -> tuple[float, int]:
    """Largest size of numbers (P,) or vectors (P, d), and the position (from 0) of it."""
    sizes = np.sqrt((np.reshape(values, (len(values), -1)) ** 2).sum(axis=1))
    k = int(np.nanargmax(sizes)) if np.isfinite(sizes).any() else 0
    return float(sizes[k]), k
