"""A result as a workbook: every position, extremes, native charts, what the numbers rest on.

Numbers are numbers and texts are texts: a name that begins like a formula stays a name.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.output.columns import Scale, UnitChoice, scale
from dalembert.analysis.output.json_record import nan_to_none
from dalembert.analysis.output.summary.printed_series import extremes
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.analysis.result.number_kinds import drive_kinds, in_plane, unknown_kinds
from dalembert.analysis.result.reaction_axes import Axes
from dalembert.arrays import Array
from dalembert.units import KINDS

if TYPE_CHECKING:
    from openpyxl import Workbook
    from openpyxl.chart import ScatterChart
    from openpyxl.chart.axis import NumericAxis
    from openpyxl.worksheet.worksheet import Worksheet

    from dalembert.analysis.result.result import Result

MOST_CURVES, MOST_DIAGRAMS, MOST_POINTS = 12, 6, 20_000
"""Curves in a chart, those of the largest forces; polar diagrams; points of a curve, evenly taken from more."""
WIDTH, HEIGHT = 20.0, 9.5
"""Size of a chart, cm."""
SHOWN_UNITS = [
    "length",
    "angle",
    "force",
    "moment",
    "mass",
    "inertia",
    "angular_speed",
    "angular_acceleration",
]


def write_workbook(
    result: Result,
    rows: Iterable[Sequence[object]],
    about: dict[str, str],
    path: Path,
    units: UnitChoice,
    axes: Axes,
) -> None:
    """Sheets of positions (the ``rows``), extremes, charts with their numbers, assumptions, and ``about``."""
    with new_book(path) as book:
        add_sheet(book, "positions", rows).freeze_panes = "C2"
        add_sheet(book, "extremes", _extremes(result, units, axes), (34, 12, 16, 12, 18, 16, 12, 18))
        if len(result.status) > 1 and result.drives and result.stability is None:
            _charts(book, result, units, axes)
        add_sheet(book, "assumptions", _assumptions(result, units, axes), (24, 100))
        add_sheet(book, "about", about.items(), (24, 100))


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


def _extremes(result: Result, units: UnitChoice, axes: Axes) -> Iterator[list[object]]:
    """Largest and smallest value of each effort, unknown load and reaction, with their positions and drives."""
    to = Printed(None if units == "SI" else result.mechanism.units)
    kinds = {drive: drive_kinds(result, drive)["position"] for drive in result.drives}
    places = [f"{drive} [{to.text(kind)}]" for drive, kind in kinds.items()]
    yield ["over the positions", "unit", "largest", "position", *places, "smallest", "position", *places]
    where = [nan_to_none(to(kind, result.drive_position(drive))) for drive, kind in kinds.items()]
    for e in extremes(result, to, axes):
        ends = ((e.largest, e.most), (e.smallest, e.least))
        cells = (cell for value, k in ends for cell in (value, k + 1, *(of[k] for of in where)))
        yield [e.name, e.unit, *cells]


def _assumptions(result: Result, units: UnitChoice, axes: Axes) -> Iterator[tuple[str, object]]:
    """The method, what was assumed, units, and how far the numbers can be trusted."""
    inertia = ", with inertia forces" if result.inertia else ""
    yield "method", f"equilibrium of all links at once, by one matrix{inertia}"
    yield from result.assumptions.items()
    yield "reactions", f"what the joint's first link exerts on its second, in {axes} axes"
    to = scale(result, units)
    yield from ((f"unit of {KINDS[kind].phrase.partition(' ')[2]}", to.text(kind)) for kind in SHOWN_UNITS)
    yield "positions", len(result.status)
    yield "positions solved", int(result.ok.sum())
    for name in ("residual", "power_balance"):
        values = np.abs(getattr(result, name))
        largest = float(np.nanmax(values)) if np.isfinite(values).any() else None
        yield f"largest {name.replace('_', ' ')}", largest
    yield "program", f"dalembert {sys.modules['dalembert'].__version__}"


# charts


class Named(NamedTuple):
    """Numbers of a chart with their name and unit."""

    name: str
    unit: str
    values: Array

    @property
    def head(self) -> str:
        return f"{self.name} [{self.unit}]"


class Diagram(NamedTuple):
    """Curves against one axis; a polar one has the same scale along both."""

    title: str
    x: Named
    curves: list[Named]
    polar: bool = False


def _diagrams(result: Result, to: Scale, axes: Axes) -> Iterator[Diagram]:
    """Efforts and unknown loads of one unit together, sizes of the largest joint forces, polar diagrams of pins."""
    first = result.drives[0]
    kind, place = drive_kinds(result, first)["position"], result.drive_position(first)
    turned = kind == "angle"
    x = Named(first, "deg" if turned else to.text(kind), np.degrees(place) if turned else to(kind, place))
    asked = {
        n: (result.effort if n in result.drives else result.unknown_load)(n) for n in unknown_kinds(result)
    }
    unknown = _finite(Named(n, to.text(k), to(k, asked[n])) for n, k in unknown_kinds(result).items())
    for unit in dict.fromkeys(of.unit for of in unknown):
        yield Diagram("Effort", x, [of for of in unknown if of.unit == unit])
    unit = to.text("force")
    forces = {joint: to("force", result.reaction(joint, axes=axes)) for joint in result.joints}
    sizes = _finite(Named(joint, unit, np.linalg.norm(force, axis=-1)) for joint, force in forces.items())
    sizes.sort(key=lambda of: -float(np.nan_to_num(of.values).max(initial=0.0)))
    yield Diagram("Joint forces", x, sizes[:MOST_CURVES])
    pins = [of.name for of in sizes if in_plane(result) and result.mechanism.joints[of.name].hinge]
    for joint in pins[:MOST_DIAGRAMS]:
        along, up = (Named(f"{joint}, force {c}", unit, forces[joint][:, k]) for k, c in enumerate("xy"))
        yield Diagram(f"Polar diagram of {joint}", along, [up], polar=True)


def _finite(some: Iterable[Named]) -> list[Named]:
    """Those that have a value somewhere."""
    return [of for of in some if np.isfinite(of.values).any()]


def _charts(book: Workbook, result: Result, units: UnitChoice, axes: Axes) -> None:
    """The diagrams on one sheet, their numbers on another behind it: where contacts reverse those just before."""
    diagrams = [d for d in _diagrams(result, scale(result, units), axes) if d.curves]
    if not diagrams:
        return
    sheet = book.create_sheet("charts")
    sheet.sheet_properties.pageSetUpPr.fitToPage, sheet.page_setup.fitToHeight = True, 0
    columns = [column for d in diagrams for column in (d.x, *d.curves)]
    every = max(1, -(-len(result.status) // MOST_POINTS))
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
    label = d.curves[0].head if d.polar else f"{d.title} [{d.curves[0].unit}]"
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
