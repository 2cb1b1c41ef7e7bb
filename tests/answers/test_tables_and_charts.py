"""Answers as tables, records, labelled arrays and charts: heads, units, order, gaps, and scales of axes."""

from __future__ import annotations

import io
import json
import math
from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any, ClassVar

import numpy as np
import pytest

from dalembert.answer import answer as answers
from dalembert.answer import workbook
from dalembert.answer.answer import Answer, Drawn, Labelled
from dalembert.answer.column import Column, Scale, nan_to_none, parts, plain
from dalembert.answer.equality import equal
from dalembert.answer.labelled import column_arrays
from dalembert.answer.named_answer import NamedAnswer, _sizes
from dalembert.answer.record import column_records, head, write_json
from dalembert.answer.table_rows import dataframe, rows, write_csv
from dalembert.answer.workbook import Diagram, Named, _fit, _square, answer_tabs, column_diagrams, named
from dalembert.errors import ModelError
from dalembert.printing import TextTable
from dalembert.units import Units

NAN, INF = math.nan, math.inf
SUBJECT = SimpleNamespace(title="A press", source_text="A book", units=Units(length="mm", force="kN"))


class Rows(Labelled, Drawn):
    """Five rows of a drive, a force that is not always known, a length, a word; one number beside them."""

    ROWS, FIRST = "designs", 3
    described = SUBJECT
    words: Any = ("a", None, "b", "c", "=d")

    def columns(self, axes: Any = "ground") -> Iterator[Column]:
        yield Column("state", "word", np.array(self.words, object))
        yield Column("drive.O", "angle", np.radians([10.0, 20.0, 30.0, 40.0, 50.0]))
        yield Column("effort", "force", np.array([1000.0, NAN, -7000.0, INF, 5.0]))
        yield Column("load", "force", np.array([2.0, 3.0, 4.0, -9000.0, 6.0]))
        yield Column("stroke", "length", np.array([0.1, 0.2, 0.4, 0.3, 0.5]))

    def record(self, to: Scale) -> Any:
        return {"reach": to("length", np.float64(0.25)), "axes": axes_of(to)}

    def contents(self, units: Any = "file", **choice: Any) -> Any:
        return ["First line\nsecond", TextTable(("a", "b\nc"), (("1", "2\n3"),), note="a note")]

    def drawings(self, notation: Any = None) -> Any:
        return ["one"]


def axes_of(to: Scale) -> list[str]:
    return [to.text("length"), to.text("word")]


def test_a_table_has_its_number_its_heads_and_a_gap_where_nothing_is_known() -> None:
    heads, *body = rows(Rows(), "file", "ground")
    assert heads == ["design", "state", "drive.O [deg]", "effort [kN]", "load [kN]", "stroke [mm]"]
    assert [row[0] for row in body] == [3, 4, 5, 6, 7]
    assert [row[1] for row in body] == ["a", None, "b", "c", "=d"]
    assert [row[2] for row in body] == pytest.approx([10, 20, 30, 40, 50])
    assert [row[3] for row in body] == [1.0, None, -7.0, None, 0.005]
    assert [row[5] for row in body] == pytest.approx([100, 200, 400, 300, 500])
    stream = io.StringIO()
    write_csv(Rows(), stream, "SI", "ground")
    lines = stream.getvalue().split("\n")
    assert lines[0] == "design,state,drive.O [rad],effort [N],load [N],stroke [m]"
    assert lines[2].startswith("4,,0.349")
    assert lines[2].endswith(",,3.0,0.2")


def test_rows_are_written_in_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = list(rows(Rows(), "file", "ground")), list(column_records(Rows(), "file", "ground"))
    for block in (1, 2, 5, 6):
        monkeypatch.setattr(answers, "BLOCK", block)
        assert (list(rows(Rows(), "file", "ground")), list(column_records(Rows(), "file", "ground"))) == whole
    monkeypatch.setattr(answers, "BLOCK", 2)
    assert list(Rows().blocks(5)) == [slice(0, 2), slice(2, 4), slice(4, 5)]
    assert list(Rows().blocks(4)) == [slice(0, 2), slice(2, 4)]


def test_a_record_has_its_head_before_the_rows() -> None:
    assert head(Rows(), "file") == {
        "dalembert": 2, "title": "A press", "units": Scale(SUBJECT.units).names(), "assumptions": {}, "reach": 250.0,
        "axes": ["mm", ""],
    }  # fmt: skip
    assert head(Rows(), "SI")["units"] == "SI"
    stream = io.StringIO()
    write_json(Rows(), stream, "SI", "ground")
    assert json.loads(stream.getvalue()) == Rows().to_dict()
    lines = stream.getvalue().splitlines()
    assert lines[-5].startswith('  {"state": "a", ')
    assert lines[-6] == ' "designs": ['
    assert lines[-1].endswith("]}")
    assert Rows().to_dict()["designs"][3] == {
        "state": "c", "drive.O": pytest.approx(math.radians(40)), "effort": None, "load": -9000.0, "stroke": 0.3,
    }  # fmt: skip


def test_labelled_arrays_have_their_units_and_the_numbers_of_the_rows() -> None:
    data, coordinates = column_arrays(Rows(), Scale(SUBJECT.units), "ground")
    assert list(coordinates["design"]) == [3, 4, 5, 6, 7]
    row, words, attributes = data["state"]
    assert (row, list(words), attributes) == ("design", ["a", "", "b", "c", "=d"], {"units": "1"})
    assert data["stroke"][1] == pytest.approx([100, 200, 400, 300, 500])
    assert data["stroke"][2] == {"units": "mm"}


def test_a_frame_is_numbered_or_indexed_by_its_drives() -> None:
    pytest.importorskip("pandas")
    frame = dataframe(Rows(), "file", "ground", "rows")
    assert (frame.index.name, list(frame.index)) == ("design", [3, 4, 5, 6, 7])
    assert list(frame.columns)[1:3] == ["drive.O [deg]", "effort [kN]"]
    assert frame.attrs["units"] == {
        "drive.O [deg]": "deg", "effort [kN]": "kN", "load [kN]": "kN", "stroke [mm]": "mm",
    }  # fmt: skip
    assert frame.attrs["title"] == "A press"
    by_drive = dataframe(Rows(), "file", "ground", "drives")
    assert by_drive.index.name == "drive.O [deg]"
    assert "drive.O [deg]" not in by_drive.columns


def test_printed_text_has_its_title_and_what_it_rests_on() -> None:
    class Based(Rows):
        def basis(self) -> dict[str, str]:
            return {"title": "T", "source": "", "gravity": "none", "mobility": "1", "friction": "off"}

    assert Rows().text().startswith("A press\nA book\n\nFirst line\nsecond\n\n")
    assert Based().text().startswith("T\nAssumptions: gravity none, friction off\n\nFirst line")
    assert head(Based(), "SI")["assumptions"] == {"gravity": "none", "friction": "off"}
    assert Rows().draw() == "one"
    with pytest.raises(ModelError) as refused:
        Rows().save("a.yaml")
    said = (
        "a.yaml: Rows cannot be written in this format; use one of .json .csv .xlsx .nc .svg .pdf .png .dxf"
    )
    assert str(refused.value) == said
    assert list(Answer.writers(Rows())) == [".json", ".csv", ".xlsx", ".nc", ".svg", ".pdf", ".png", ".dxf"]


# charts


def test_columns_of_a_kind_are_one_diagram_the_largest_first(monkeypatch: pytest.MonkeyPatch) -> None:
    to = Scale(SUBJECT.units)
    forces, lengths = column_diagrams(Rows(), to, "ground")
    assert (forces.title, lengths.title) == ("Force", "Length")
    assert [c.head for c in forces.curves] == ["effort [kN]", "load [kN]"], (
        "where one is infinite it is largest"
    )
    assert (forces.x.head, list(forces.x.values)) == ("drive.O [deg]", pytest.approx([10, 20, 30, 40, 50]))
    assert forces.curves[1].values == pytest.approx([0.002, 0.003, 0.004, -9.0, 0.006])
    monkeypatch.setattr(workbook, "MOST_DIAGRAMS", 1)
    assert [d.title for d in column_diagrams(Rows(), to, "ground")] == ["Force"]
    monkeypatch.setattr(workbook, "MOST_CURVES", 1)
    assert [[c.name for c in d.curves] for d in column_diagrams(Rows(), to, "ground")] == [["effort"]]


def test_rows_without_a_drive_are_numbered_and_what_is_never_known_has_no_curve() -> None:
    to = Scale(None)

    class Few(Rows):
        count = 2

        def columns(self, axes: Any = "ground") -> Iterator[Column]:
            yield Column("a", "speed", np.arange(self.count) + 1.0)
            yield Column("b", "speed", np.full(self.count, NAN))
            yield Column("c", "speed", np.arange(self.count) - 9.0)

    (two,) = column_diagrams(Few(), to, "ground")
    assert (two.x.head, list(two.x.values), [c.name for c in two.curves]) == ("design", [3, 4], ["c", "a"])
    Few.count = 1
    assert column_diagrams(Few(), to, "ground") == []


def test_the_sheets_of_a_workbook_are_rows_text_and_charts() -> None:
    table, printed, charts = answer_tabs(Rows(), "file", "ground")
    assert (table.title, table.freeze, len(list(table.rows))) == ("designs", "C2", 6)
    assert (printed.title, printed.widths) == ("answer", (24,))
    assert list(printed.rows) == [["First line second"], [], ["a", "b c"], ["1", "2 3"], ["a note"], []]
    assert (charts.title, [d.title for d in charts.charts]) == ("charts", ["Force", "Length"])
    angle = named(Column("turn", "angle", np.array([math.pi, 0.5])), Scale(None))
    assert (angle.head, list(angle.values)) == ("turn [deg]", pytest.approx([180, math.degrees(0.5)]))
    length = named(Column("s", "length", np.array([2.0])), Scale(SUBJECT.units))
    assert (length.head, list(length.values)) == ("s [mm]", pytest.approx([2000]))
    assert Named("n", "", np.zeros(1)).head == "n"


@pytest.mark.parametrize(
    ("low", "high", "degrees", "ends"),
    [
        (3.0, 7.5, False, (3.0, 7.5, None)),
        (10.0, 10.0, True, (10.0, 10.0, None)),
        (7.0, 350.0, True, (0.0, 360.0, 45.0)),
        (0.0, 360.0, True, (0.0, 360.0, 45.0)),
        (0.0, 127.5, True, (0.0, 135.0, 15.0)),
        (0.0, 127.6, True, (0.0, 150.0, 30.0)),
        (-100.0, 155.0, True, (-120.0, 180.0, 30.0)),
        (0.0, 383.0, True, (0.0, 420.0, 60.0)),
        (-200.0, 512.0, True, (-270.0, 540.0, 90.0)),
        (0.0, 1530.0, True, (0.0, 1620.0, 180.0)),
        (0.0, 1531.0, True, (0.0, 1800.0, 360.0)),
    ],
)
def test_an_axis_of_degrees_has_round_steps(low: float, high: float, degrees: bool, ends: Any) -> None:
    axis: Any = SimpleNamespace(majorUnit=None, scaling=SimpleNamespace())
    _fit(axis, np.array([NAN, high, low, (low + high) / 2]), degrees)
    assert (axis.scaling.min, axis.scaling.max, axis.majorUnit) == ends


@pytest.mark.parametrize(
    ("first", "second", "end"),
    [
        ([3.0, NAN], [-7.2, 1.0], 8.0),
        ([40.0], [-12.0, 3.0], 40.0),
        ([0.0], [0.0], 1.0),
        ([0.031], [0.0], 0.04),
    ],
)
def test_a_polar_chart_has_the_pole_in_the_middle(
    first: list[float], second: list[float], end: float
) -> None:
    pytest.importorskip("openpyxl")
    chart: Any = SimpleNamespace(
        x_axis=SimpleNamespace(scaling=SimpleNamespace()), y_axis=SimpleNamespace(scaling=SimpleNamespace())
    )
    _square(chart, (np.array(first), np.array(second)))
    for axis in (chart.x_axis, chart.y_axis):
        found = axis.scaling.min, axis.scaling.max, axis.majorUnit
        assert found == pytest.approx((-end, end, end / 2))
    assert chart.width == chart.height == 12.5


def test_charts_stand_below_each_other_with_their_numbers_behind(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Any
) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    x = Named("t", "s", np.array([1.0, 2.0, 3.0]))
    a, b = Named("a", "N", np.array([4.0, NAN, 6.0])), Named("b", "N", np.array([7.0, 8.0, -9.0]))
    path = tmp_path / "a.xlsx"
    with workbook.new_book(path) as book:
        workbook.add_charts(
            book,
            "charts",
            [Diagram("Force", x, [a, b]), Diagram("Polar", a, [b], True), Diagram("Last", x, [b])],
        )
        workbook.add_sheet(book, "words", [["=1+2", "#x", "a\x07b", 5, None]], (7, 9))
    read = openpyxl.load_workbook(path)
    assert read.sheetnames == ["charts", "chart values", "words"]
    values = [list(row) for row in read["chart values"].values]
    assert values[0] == ["t [s]", "a [N]", "b [N]", "a [N]", "b [N]", "t [s]", "b [N]"]
    assert values[1:] == [[1, 4, 7, 4, 7, 1, 7], [2, None, 8, None, 8, 2, 8], [3, 6, -9, 6, -9, 3, -9]]
    charts = read["charts"]._charts
    assert [(c.anchor._from.col, c.anchor._from.row) for c in charts] == [(0, 0), (0, 21), (0, 48)]
    refs = [[(s.xVal.numRef.f, s.yVal.numRef.f) for s in c.series] for c in charts]
    at = "'chart values'!${0}$2:${0}$4".format
    assert refs == [[(at("A"), at("B")), (at("A"), at("C"))], [(at("D"), at("E"))], [(at("F"), at("G"))]]
    assert [c.legend is None for c in charts] == [False, True, False]
    assert next(iter(read["words"].values))[:4] == ("=1+2", "#x", "a?b", 5)
    assert [read["words"].column_dimensions[c].width for c in "AB"] == [7, 9]
    monkeypatch.setattr(workbook, "MOST_POINTS", 2)
    with workbook.new_book(path) as book:
        workbook.add_charts(book, "charts", [Diagram("Force", x, [a])])
    assert [row[0] for row in openpyxl.load_workbook(path)["chart values"].values] == ["t [s]", 1, 3]


def test_more_rows_than_a_sheet_holds_are_refused(monkeypatch: pytest.MonkeyPatch, tmp_path: Any) -> None:
    pytest.importorskip("openpyxl")
    monkeypatch.setattr(workbook, "MOST_ROWS", 5)
    Rows().to_xlsx(tmp_path / "a.xlsx")
    monkeypatch.setattr(workbook, "MOST_ROWS", 4)
    with pytest.raises(
        ModelError, match=r"^5 designs do not fit a worksheet of 4 rows; write CSV or netCDF$"
    ):
        Rows().to_xlsx(tmp_path / "b.xlsx")


# names and values


class Read(NamedAnswer):
    """Two rows of three positions."""

    ROW = "design"
    mechanism = SimpleNamespace(title="")
    codes = np.array([["ok", "ok", "stuck"], ["ok", "stuck", "ok"]], object)  # type: ignore[assignment]
    values: ClassVar[Any] = {
        "a": np.array([[1.0, -5.0, NAN], [2.0, 3.0, 4.0]]),
        "v": np.arange(12.0).reshape(2, 3, 2),
        "none": np.full((2, 3), NAN),
    }

    def keys(self) -> list[str]:
        return ["a", "v"]

    def __getitem__(self, name: str) -> Any:
        if name not in self.values:
            raise ModelError(f"no {name}")
        return self.values[name]


def test_a_quantity_has_its_peak_with_its_place() -> None:
    r = Read()
    assert (len(r), bool(r), r.extent, r.outcome) == (2, True, "2 designs of 3 positions", "4 ok, 2 stuck")
    assert repr(r) == "<Read of 'a mechanism': 2 designs of 3 positions, 4 ok, 2 stuck>"
    assert ("a" in r, "none" in r, "b" in r, 3 in r) == (True, True, False, False)
    assert r.peak("a") == (5.0, (0, 1))
    assert r.peak("v") == (pytest.approx(math.hypot(10, 11)), (1, 2))
    with pytest.raises(ModelError, match=r"^none has no value at any design; see status$"):
        r.peak("none")
    after: Any = Read()
    after.after = {"a": np.array([[NAN, 2.0, -6.0], [1.0, 1.0, 1.0]])}
    assert after.peak("a") == (6.0, (0, 2))
    flat = Read()
    flat.codes, flat.values = np.array(["ok", "ok", "ok"]), {"a": np.array([1.0, -3.0, 3.0])}  # type: ignore[misc]
    assert flat.peak("a") == (3.0, 1)
    assert _sizes(np.array([[3.0, -4.0], [-5.0, 12.0]]), 1) == pytest.approx([5, 13])
    assert list(_sizes(np.array([-3.0, 2.0]), 1)) == [3, 2]


def test_values_become_plain() -> None:
    assert nan_to_none(np.array([1.0, NAN, -INF, 2.0])) == [1.0, None, None, 2.0]
    assert nan_to_none(np.array([1.0, 2.0])) == [1.0, 2.0]
    assert plain(
        {"a": (1, np.float64(2.5), [NAN]), "b": np.array([[1, 2]]), "c": np.bool_(True), "d": INF, "e": "x"}
    ) == {
        "a": [1, 2.5, [None]],
        "b": [[1, 2]],
        "c": True,
        "d": None,
        "e": "x",
    }
    assert [n for n, _ in parts(np.zeros((2, 2, 3)))] == [".xx", ".xy", ".xz", ".yx", ".yy", ".yz"]
    assert [list(v) for _, v in parts(np.array([[1.0, 2.0], [3.0, 4.0]]))] == [[1, 3], [2, 4]]
    assert [n for n, _ in parts(np.zeros(3))] == [""]
    scale = Scale(SUBJECT.units)
    assert (scale("force", 2500.0), scale("word", "a"), scale.text("word")) == (2.5, "a", "")
    assert (Scale(None)("force", 2500.0), Scale(None).bare("pressure")) == (2500.0, True)


def test_values_are_equal_item_by_item() -> None:
    for a, b in (
        (np.array([1, 2]), np.array([1, 3])),
        (np.array([1, 2]), np.array([1.0, 2.0])),
        (np.array([1.0]), np.array([1.0, 1.0])),
        ({"a": 1}, {"a": 2}),
        ({"a": 1}, {"b": 1}),
        ({"a": 1}, {"a": 1, "b": 1}),
        ([1, 2], [1]),
        ([1, 2], [1, 3]),
        ((1,), [1]),
        ("ab", "ac"),
        (1, 1.0),
        (NAN, 1.0),
        (b"a", b"b"),
        (Units(), Units(length="mm")),
        (np.array([[1, None]], object), np.array([[1, 2]], object)),
    ):
        assert not equal(a, b)
        assert not equal(b, a)
    for a, b in (
        (np.array([1.0, NAN]), np.array([1.0, NAN])),
        ([NAN, "a"], [float("nan"), "a"]),
        ({"a": (1, {"b": NAN})}, {"a": (1, {"b": float("nan")})}),
        (np.array([1, "a", None], object), np.array([1, "a", None], object)),
        (Units(length="mm"), Units(length="mm")),
        (np.array(["a"]), np.array(["a"])),
    ):
        assert equal(a, b)


def test_an_answer_may_have_one_column() -> None:
    class One(Rows):
        def columns(self, axes: Any = "ground") -> Iterator[Column]:
            yield Column("stroke", "length", np.array([0.1, 0.2]))

    assert list(rows(One(), "file", "ground")) == [["design", "stroke [mm]"], [3, 100.0], [4, 200.0]]
    assert list(column_records(One(), "SI", "ground")) == [{"stroke": 0.1}, {"stroke": 0.2}]
    assert [d.title for d in column_diagrams(One(), Scale(None), "ground")] == ["Length"]
    assert list(column_arrays(One(), Scale(None), "ground")[1]["design"]) == [3, 4]
