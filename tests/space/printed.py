"""Reading a worked solution as it is printed: its blocks, its numbers and their rounding, sums that must be zero."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from typing import Any

from dalembert.reports.sheet import Equations, Paragraph, ReportSheet, SheetTable, Working


def blocks(sheet: ReportSheet, kind: type) -> list[Any]:
    return [b for b in sheet.blocks if isinstance(b, kind)]


def lines(sheet: ReportSheet) -> list[Working]:
    return [line for b in blocks(sheet, Equations) for line in b.lines]


def table(sheet: ReportSheet, *heads: str) -> SheetTable:
    (found,) = (b for b in blocks(sheet, SheetTable) if b.heads[: len(heads)] == heads)
    assert isinstance(found, SheetTable)
    return found


def words(sheet: ReportSheet) -> str:
    return " ".join(b.text for b in blocks(sheet, Paragraph))


# numbers as they are printed


def value(text: str) -> float:
    """A printed number, in brackets or not."""
    return 0.0 if text in ("–", "none") else float(text.strip("()").replace("−", "-"))


def half_digit(text: str) -> float:
    """Half a unit of the last digit of a printed number."""
    size, _, power = text.strip("()").replace("−", "-").partition("e")
    if text in ("–", "none") or not float(size):
        return 0.0
    decimals = len(size.partition(".")[2])
    return 0.5 * 10.0 ** (int(power or 0) - decimals)


def close(text: str, exact: float, more: float = 0.0) -> bool:
    """Whether a printed number is a computed one rounded; what is rounding is printed as 0."""
    return abs(value(text) - exact) <= max(1.01 * half_digit(text), 1e-9 * abs(exact), more)


def printed_terms(text: str) -> Iterator[tuple[float, float]]:
    """Value and rounding error of each term of a printed sum: numbers, and products (a)(b)."""
    for sign, term in re.findall(r"(^−|^| − | \+ )((?:\([^)]*\))+|[\d.e−]+)", text):
        factors = re.findall(r"\(([^)]*)\)", term) or [term]
        size = math.prod(value(f) for f in factors)
        error = sum(
            half_digit(f) * math.prod(abs(value(g)) for n, g in enumerate(factors) if n != k)
            for k, f in enumerate(factors)
        )
        yield (-size if "−" in sign else size), error


def adds_up(text: str) -> None:
    """A printed sum is zero within the printed digits of its terms, and its total is printed as 0."""
    left, _, right = text.partition(" = ")
    found = list(printed_terms(left))
    assert found, text
    assert abs(math.fsum(v for v, _ in found)) <= 1.05 * sum(e for _, e in found) + 1e-12, text
    assert right.startswith("0 "), text
