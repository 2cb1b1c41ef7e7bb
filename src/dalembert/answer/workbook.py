"""An answer as a workbook: every row, native charts, and sheets of one answer.

Numbers are numbers and texts are texts: a name that begins like a formula stays a name.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.answer.column import WORD, Axes, Column, Scale, UnitChoice, nan_to_none
from dalembert.answer.table_rows import rows
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.saving import check_installed, new_file

if TYPE_CHECKING:
    from openpyxl import Workbook
    from openpyxl.chart import ScatterChart
    from openpyxl.chart.axis import NumericAxis
    from openpyxl.worksheet.worksheet import Worksheet

    from dalembert.answer.answer import Answer

MOST_ROWS = 1_048_575
"""Rows of a worksheet, less its heading."""
MOST_CURVES, MOST_DIAGRAMS, MOST_POINTS = 12, 6, 20_000
"""Curves in a chart, the largest ones; diagrams of a sort; points of a curve, evenly taken from more."""
WIDTH, HEIGHT = 20.0, 9.5
"""Size of a chart, cm."""


class Tab(NamedTuple):
    """A sheet of a workbook: rows, widths of its first columns, the cell that stays while others scroll; or charts."""

    title: str
    rows: Iterable[Sequence[object]] = ()
    widths: Sequence[int] = ()
    freeze: str | None = None
    charts: Sequence[Diagram] = ()


def write_workbook(
    answer: Answer, path: str | os.PathLike[str], overwrite: bool, units: UnitChoice, axes: Axes
) -> None:
    """The sheets of an answer as a file; raises ModelError for more rows than a sheet holds."""
    check_installed("openpyxl", "a workbook")
    count = len(next(answer.columns(axes)).values)
    if count > MOST_ROWS:
        what = f"{count} {answer.ROWS} do not fit a worksheet of {MOST_ROWS} rows"
        raise ModelError(what, "write CSV or netCDF")
    with new_file(path, overwrite) as temporary, new_book(temporary) as book:
        for tab in answer.tabs(units, axes):
            if tab.charts:
                add_charts(book, tab.title, tab.charts)
            else:
                add_sheet(book, tab.title, tab.rows, tab.widths).freeze_panes = tab.freeze


def answer_tabs(answer: Answer, units: UnitChoice, axes: Axes) -> Iterator[Tab]:
    """A sheet of the rows, one of what is printed, and charts of the largest columns of each kind."""
    yield Tab(answer.ROWS, rows(answer, units, axes), freeze="C2")
    printed: list[Sequence[str]] = []
    for part in answer.contents(units):
        lines = [[part]] if isinstance(part, str) else [part.heads, *part.rows, [part.note]]
        printed += [*([cell.replace("\n", " ") for cell in line] for line in lines), []]
    yield Tab("answer", printed, (24,))
    charts = column_diagrams(answer, answer.scale(units), axes)
    if charts:
        yield Tab("charts", charts=charts)


def column_diagrams(answer: Answer, to: Scale, axes: Axes) -> list[Diagram]:
    """The columns of each kind over the first drive, or over the number of the row."""
    some = [c for c in answer.columns(axes) if c.kind != WORD]
    count = len(some[0].values) if some else 0
    if count < 2:
        return []
    every = [(c, np.asarray(c.values[:], float)) for c in some]
    drive = next((c for c, _ in every if c.name.startswith("drive.")), None)
    x = named(drive, to) if drive else Named(answer.ROWS[:-1], "", np.arange(count) + answer.FIRST)
    groups: dict[str, list[Named]] = {}
    for c, values in every:
        if c is not drive and np.isfinite(values).any():
            groups.setdefault(c.kind, []).append(Named(c.name, to.text(c.kind), to(c.kind, values)))
    for group in groups.values():
        group.sort(key=lambda of: -float(np.nan_to_num(np.abs(of.values)).max()))
    value = (Diagram(kind.replace("_", " ").capitalize(), x, of[:MOST_CURVES]) for kind, of in groups.items())
    return list(islice(value, MOST_DIAGRAMS))


@contextmanager
def new_book(path: Path) -> Iterator[Workbook]:
    """A workbook to put sheets in, saved at the end; if interrupted, it discards its sheets silently."""
    from openpyxl import Workbook

    book = Workbook(write_only=True)
    try:
        yield book
        book.save(path)
    except BaseException:
        for sheet in book.worksheets:  # open files of what was being written
            if not sheet.closed:
                sheet.close()
        raise


def add_sheet(
    book: Workbook, title: str, rows: Iterable[Sequence[object]], widths: Sequence[int] = ()
) -> Worksheet:
    """A sheet of rows of numbers and texts."""
    from openpyxl.utils import get_column_letter

    sheet = book.create_sheet(title)
    for k, width in enumerate(widths, 1):
        sheet.column_dimensions[get_column_letter(k)].width = width
    for row in rows:
        sheet.append([_text(sheet, cell) if isinstance(cell, str) else cell for cell in row])
    return sheet


def _text(sheet: Worksheet, text: str) -> object:
    """A cell that is text, whatever it begins with; without characters that a workbook cannot hold."""
    from openpyxl.cell import WriteOnlyCell
    from openpyxl.cell.cell import ILLEGAL_CHARACTERS_RE

    clean = ILLEGAL_CHARACTERS_RE.sub("?", text)[:32_767]
    if clean[:1] not in ("=", "#"):
        return clean
    cell = WriteOnlyCell(sheet, clean)
    cell.data_type = "s"
    return cell


# charts


class Named(NamedTuple):
    """Numbers of a chart with their name and unit."""

    name: str
    unit: str
    values: Array

    @property
    def head(self) -> str:
        return f"{self.name} [{self.unit}]" if self.unit else self.name


def named(c: Column, to: Scale) -> Named:
    """A column of numbers for a chart, angles in degrees."""
    values = np.asarray(c.values[:], float)
    if c.kind == "angle":
        return Named(c.name, "deg", np.degrees(values))
    return Named(c.name, to.text(c.kind), to(c.kind, values))


class Diagram(NamedTuple):
    """Curves against one axis; a polar one has the same scale along both."""

    title: str
    x: Named
    curves: list[Named]
    polar: bool = False


def with_values(some: Iterable[Named]) -> list[Named]:
    """Those that have a value somewhere."""
    return [of for of in some if np.isfinite(of.values).any()]


def add_charts(book: Workbook, title: str, diagrams: Sequence[Diagram]) -> None:
    """The diagrams on one sheet, their numbers on another behind it."""
    sheet = book.create_sheet(title)
    sheet.sheet_properties.pageSetUpPr.fitToPage, sheet.page_setup.fitToHeight = True, 0
    columns = [column for d in diagrams for column in (d.x, *d.curves)]
    every = max(1, -(-len(columns[0].values) // MOST_POINTS))
    lists = [nan_to_none(column.values[::every]) for column in columns]
    numbers = add_sheet(book, "chart values", [[c.head for c in columns], *zip(*lists, strict=True)])
    row, column = 1, 1
    for d in diagrams:
        sheet.add_chart(_chart(numbers, d, column, len(lists[0]) + 1), f"A{row}")
        row, column = row + (27 if d.polar else 21), column + 1 + len(d.curves)


def _chart(numbers: Worksheet, d: Diagram, column: int, rows: int) -> ScatterChart:
    """Lines through columns of numbers, the first of them along x; a gap where there is none."""
    from openpyxl.chart import Reference, ScatterChart, Series
    from openpyxl.chart.shapes import GraphicalProperties
    from openpyxl.drawing.line import LineProperties

    chart = ScatterChart(scatterStyle="lineMarker")
    chart.title, chart.width, chart.height, chart.display_blanks = d.title, WIDTH, HEIGHT, "gap"
    label = d.curves[0].head if d.polar else d.curves[0]._replace(name=d.title).head
    for axis, text in ((chart.x_axis, d.x.head), (chart.y_axis, label)):
        axis.title, axis.delete, axis.tickLblPos, axis.number_format = text, False, "low", "General"
        axis.majorGridlines.spPr = GraphicalProperties(ln=LineProperties(solidFill="D9D9D9"))
    for k, curve in enumerate(d.curves, column + 1):
        series = Series(*(Reference(numbers, c, 2, c, rows) for c in (k, column)), title=curve.name)
        series.marker.symbol, series.smooth = "none", False
        series.graphicalProperties.line.width = 19_050
        chart.series.append(series)
    if d.polar:
        _square(chart, (d.x.values, d.curves[0].values))
    else:
        _fit(chart.x_axis, d.x.values, d.x.unit == "deg")
    chart.legend = None if d.polar else chart.legend
    return chart


def _fit(axis: NumericAxis, values: Array, degrees: bool) -> None:
    """The axis from the first value to the last; of degrees in round parts of a turn."""
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    if degrees and high > low:
        step = next((s for s in (15.0, 30.0, 45.0, 60.0, 90.0, 180.0) if (high - low) / s <= 8.5), 360.0)
        low, high, axis.majorUnit = math.floor(low / step) * step, math.ceil(high / step) * step, step
    axis.scaling.min, axis.scaling.max = low, high


def _square(chart: ScatterChart, values: Sequence[Array]) -> None:
    """The same scale along both axes, the pole in the middle."""
    from openpyxl.chart.layout import Layout, ManualLayout

    largest = max(float(np.nan_to_num(np.abs(v)).max()) for v in values) or 1.0
    step = 10.0 ** math.floor(math.log10(largest))
    end = math.ceil(largest / step) * step
    inner = {"x": 0.15, "y": 0.12, "w": 0.74, "h": 0.74}
    chart.width = chart.height = 12.5
    chart.layout = Layout(ManualLayout(layoutTarget="inner", xMode="edge", yMode="edge", **inner))
    for axis in (chart.x_axis, chart.y_axis):
        axis.scaling.min, axis.scaling.max, axis.majorUnit = -end, end, end / 2
