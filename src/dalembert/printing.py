"""Plain columns for a person: aligned, 80 wide where they can be, the same on a terminal and in a pipe."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import groupby
from typing import NamedTuple

WIDTH = 80
GAP = 2


def number(value: float, digits: int = 6) -> str:
    """Printed form of a number; `-` for NaN.

    >>> number(243.237591), number(-0.0), number(1e-17), number(float("nan")), number(1.5e7)
    ('243.238', '0', '1e-17', '-', '1.5e+07')
    >>> number(123456.7, 5), number(-123456.7, 5), number(1e5, 5), number(-1e6, 5)
    ('123457', '-123457', '100000', '-1e+06')
    """
    if not math.isfinite(value):
        return "-"
    if 10.0**digits <= abs(value) < 1e6:
        return format(value, ".0f")
    return format(value + 0.0, f".{digits}g")


def range_text(ends: Iterable[str | None], unit: str = "") -> str:
    """'3 to 7 N', or '3 N' where both ends are; where an end is None: '3 N or more', '7 N or less', 'any value'.

    >>> range_text(("3", "3"), "N"), range_text(("3", None), "N"), range_text((None, "7")), range_text((None, None))
    ('3 N', '3 N or more', '7 or less', 'any value')
    """
    low, high = ends
    if low is None and high is None:
        return "any value"
    values = f"{low} to {high}" if low and high and low != high else low or high
    return f"{values} {unit}".rstrip() + ("" if low and high else " or more" if low else " or less")


def with_unit(value: float, unit: str, digits: int = 6) -> str:
    """A number with its unit; `-` alone where there is none.

    >>> with_unit(27.48, "N*m"), with_unit(float("nan"), "N*m")
    ('27.48 N*m', '-')
    """
    gap = "*" if unit.startswith("10^") else " "
    return f"{number(value, digits)}{gap}{unit}" if math.isfinite(value) else "-"


def remainder(value: float, decimals: int = 0) -> str:
    """Power of ten of the rounding error in a sum that should be 0.

    >>> remainder(2.3e-16), remainder(2.3e-16, 1), remainder(0.0)
    ('2e-16', '2.3e-16', '0')
    """
    return f"{value:.{decimals}e}" if value else "0"


def round_components(vector: Iterable[float], beside: float = 0.0) -> list[float]:
    """Components of a vector; what is nothing but rounding beside its largest, or beside another size, is 0.

    >>> round_components([1e-17, 3.0]), round_components([1e-17], 3.0)
    ([0.0, 3.0], [0.0])
    """
    numbers = [float(v) for v in vector]
    size = max((abs(v) for v in numbers if math.isfinite(v)), default=0.0)
    return [0.0 if abs(v) < 1e-12 * max(size, beside) else v for v in numbers]


def table(heads: Sequence[str], rows: Iterable[Sequence[str]], left: int = 1) -> str:
    """Columns under their heads; the first `left` are aligned left. A head may have two lines.

    >>> print(table(["joint", "x\\n[N]"], [["A", "12.5"], ["B", "-3"]]))
    joint     x
            [N]
    -----------
    A      12.5
    B        -3
    """
    body = [list(row) for row in rows]
    split = [head.split("\n") for head in heads]
    deep = max(len(lines) for lines in split)
    over = [[lines[k] if k < len(lines) else "" for lines in split] for k in range(deep)]
    wide = [max(len(row[k]) for row in [*over, *body]) for k in range(len(heads))]

    def line(row: Sequence[str]) -> str:
        cells = [
            cell.ljust(w) if k < left else cell.rjust(w)
            for k, (cell, w) in enumerate(zip(row, wide, strict=True))
        ]
        return (" " * GAP).join(cells).rstrip()

    rule = "-" * (sum(wide) + GAP * (len(wide) - 1))
    return "\n".join([*map(line, over), rule, *map(line, body)])


def tables(
    heads: Sequence[str],
    rows: Iterable[Sequence[str]],
    left: int,
    width: int = WIDTH,
    together: Sequence[int] = (),
) -> str:
    """The same, continued below in further tables with the left columns repeated where one is too wide; ``together``:
    how many columns at a time stay side by side, one by one if not given."""
    body = [list(row) for row in rows]
    wide = [
        max([len(line) for line in head.split("\n")] + [len(row[k]) for row in body])
        for k, head in enumerate(heads)
    ]
    fixed = sum(wide[:left]) + GAP * (left - 1)
    parts: list[list[int]] = [[]]
    room, k = width - fixed, left
    for many in together or [1] * (len(heads) - left):
        need = sum(w + GAP for w in wide[k : k + many])
        if parts[-1] and room < need:
            parts.append([])
            room = width - fixed
        parts[-1] += range(k, k + many)
        room, k = room - need, k + many
    first = list(range(left))
    chosen = [first + part for part in parts]
    return "\n\n".join(
        table([heads[k] for k in ks], [[row[k] for k in ks] for row in body], left) for ks in chosen
    )


class TextTable(NamedTuple):
    """A table before it is text: heads, cells as text, how many columns are aligned left, a note under it.

    >>> print(TextTable(["joint", "x"], [["A", "1"]], note="in N"))
    joint  x
    --------
    A      1
    in N
    """

    heads: Sequence[str]
    rows: Sequence[Sequence[str]]
    left: int = 1
    note: str = ""

    def __str__(self) -> str:
        return tables(self.heads, self.rows, self.left) + (f"\n{self.note}" if self.note else "")


def folded(rows: Sequence[Sequence[str]], lead: int = 1) -> list[list[str]]:
    """Rows of a table over time or positions; of four or more that are alike but for their first cells, the first and
    the last with dots between.

    >>> folded([["0", "5"], ["1", "7"], ["2", "7"], ["3", "7"], ["4", "7"], ["5", "8"]])
    [['0', '5'], ['1', '7'], ['...', ''], ['4', '7'], ['5', '8']]
    >>> folded([["0", "5"], ["1", "5"], ["2", "5"]])
    [['0', '5'], ['1', '5'], ['2', '5']]
    """
    out: list[list[str]] = []
    for _, run in groupby(rows, lambda row: tuple(row[lead:])):
        alike = [list(row) for row in run]
        if len(alike) > 3:
            alike = [alike[0], ["...", *[""] * (len(alike[0]) - 1)], alike[-1]]
        out += alike
    return out


Part = str | TextTable
"""A part of what a person reads: sentences or a table."""


def wrap(sentence: str, indent: str = "") -> str:
    """A sentence over lines of 80 characters."""
    from textwrap import fill

    return fill(sentence, WIDTH, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)
