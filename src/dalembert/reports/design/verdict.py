"""Verdicts of a design report: what is judged, by which limit, with which margin; and why something is not."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from dalembert.analysis.output.summary.printed_series import where
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.arrays import Array, first_largest
from dalembert.errors import AnalysisError, ModelError
from dalembert.printing import number
from dalembert.reports.machine_sections import neat
from dalembert.reports.sheet import Drawings, Heading, ReportSheet
from dalembert.views.notation import Notation, Shown, pretty

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

State = Literal["ok", "exceeded", "not judged"]
HEADS = ("Item", "Verdict", "Value", "Limit / value", "At", "Remark")
LEAST = 1.0
"""Limit over value from which on something is ok."""


@dataclass(frozen=True)
class DesignVerdict:
    """One thing judged: ``margin`` is the limit over the value, NaN without a limit or a value."""

    item: str
    state: State
    value: str = ""
    margin: float = math.nan
    at: str = ""
    remark: str = ""

    @property
    def factor(self) -> str:
        """The margin as text."""
        if math.isnan(self.margin):
            return "–"
        return "∞" if math.isinf(self.margin) else number(self.margin, 3)

    @property
    def row(self) -> tuple[str, ...]:
        """Cells of its row in a table with ``HEADS``."""
        return (self.item, self.state, self.value, self.factor, self.at, self.remark)


def judged(item: str, margin: float, value: str = "", at: str = "", remark: str = "") -> DesignVerdict:
    """A verdict by a limit over a value; not judged where it is NaN."""
    if math.isnan(margin):
        return DesignVerdict(item, "not judged", value, at=at, remark=remark or "its value is not known")
    return DesignVerdict(item, "ok" if margin >= LEAST else "exceeded", value, margin, at, remark)


def not_judged(item: str, remark: str, value: str = "", at: str = "") -> DesignVerdict:
    """Something that nothing in the file limits, or that cannot be computed."""
    return DesignVerdict(item, "not judged", value, at=at, remark=remark)


@dataclass(frozen=True)
class DesignContext:
    """The result, the reader's notation, and the position at which the machine is drawn."""

    r: Result
    k: int
    notation: Notation

    @property
    def to(self) -> Printed:
        """Units of what is printed."""
        from dalembert.analysis.output.summary.printed_units import print_scale

        return print_scale(self.r, self.notation.units)

    @property
    def shown(self) -> Shown:
        """Numbers and units as drawings have them."""
        return Shown(self.r, self.notation)

    def at(self, k: int) -> str:
        """A position as text; empty where there is only one."""
        if len(self.r.status) == 1:
            return ""
        text = neat(pretty(where(self.r, self.to, k)))
        return text if text.startswith("no.") else f"{text} (no. {k + 1})"

    def text(self, kind: str, value: float) -> str:
        """A number with its unit."""
        return neat(pretty(self.to.quantity(kind, float(value)).strip())) if math.isfinite(value) else "–"

    def number(self, kind: str, value: float) -> str:
        """A number without its unit."""
        return pretty(self.to.number(kind, float(value))) if math.isfinite(value) else "–"


@dataclass
class DesignPart:
    """A section of the report: its verdicts, and what is under them."""

    title: str
    verdicts: list[DesignVerdict] = field(default_factory=list)
    sheet: ReportSheet = field(default_factory=lambda: ReportSheet(""))

    def put_on(self, sheet: ReportSheet) -> None:
        """The heading, the verdicts as a table, the rest with its headings one level lower."""
        sheet.heading(self.title)
        put_verdicts(sheet, self.verdicts)
        for block in self.sheet.blocks:
            if isinstance(block, Heading):
                block = replace(block, level=2)
            sheet.blocks.append(replace(block, columns=2) if isinstance(block, Drawings) else block)


def put_verdicts(sheet: ReportSheet, verdicts: Iterable[DesignVerdict]) -> None:
    """A table of verdicts without the columns that are empty."""
    put_used(sheet, HEADS, [v.row for v in verdicts], words=True)


def put_used(
    sheet: ReportSheet,
    heads: Sequence[str],
    rows: Sequence[Sequence[str]],
    caption: str = "",
    words: bool = False,
) -> None:
    """A table without the columns in which no row has anything."""
    used = [k for k in range(len(heads)) if any(row[k] not in ("", "–") for row in rows)]
    sheet.table([heads[k] for k in used], [[row[k] for k in used] for row in rows], caption, words=words)


Parts = Callable[[DesignContext], Iterable[DesignPart]]


def attempted(c: DesignContext, title: str, find: Parts) -> Iterator[DesignPart]:
    """The parts that a function gives; one that is not judged, with the reason, where it cannot."""
    try:
        yield from find(c)
    except (ModelError, AnalysisError) as error:
        words = f"{error.what}; {error.remedy}" if isinstance(error, ModelError) else str(error)
        yield DesignPart(title, [not_judged(title, words.rstrip("; "))])


def together(names: Iterable[str]) -> str:
    """Names in a sentence, few of many."""
    some = list(names)
    more = f" and {len(some) - 12} more" if len(some) > 12 else ""
    return ", ".join(some[:12]) + more


def least_place(values: Array) -> int:
    """Position of the smallest of values (P,), the first where none is known."""
    return first_largest(-values) if np.isfinite(values).any() else 0


def tightest_place(margins: Array) -> int:
    """Position of the smallest margin, by value over limit: margins without a load are huge or infinite.

    >>> tightest_place(np.array([30.9, 1.6, 3e17, np.inf]))
    1
    """
    with np.errstate(divide="ignore"):
        return most_place(1 / margins)


def most_place(values: Array) -> int:
    """Position of the largest of values (P,), the first where none is known."""
    return first_largest(values) if np.isfinite(values).any() else 0
