"""The workbook: numbers as numbers, texts never formulas, extremes, native charts with gaps; tables by drives."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from zipfile import ZipFile

import numpy as np
import openpyxl
import pytest

import dalembert as da
from dalembert.answer import workbook
from dalembert.bundled import examples
from tests.tiers import tiers

FOUR_BAR = da.load(examples()["four_bar"])
GAP = da.four_bar().with_values({"links.crank.points.A": [0.9, 0.0], "links.coupler.points.B": [0.6, 0.0]})


def written(r: da.Result, folder: Path, **named: Any) -> Any:
    r.to_xlsx(folder / "r.xlsx", **named)
    return openpyxl.load_workbook(folder / "r.xlsx")


def sheet(book: Any, name: str) -> list[list[Any]]:
    return [list(row) for row in book[name].values]


def test_extremes_and_assumptions(tmp_path: Path) -> None:
    r = da.dynamics(FOUR_BAR, positions=12)
    book = written(r, tmp_path, units="file")
    heads, *rows = sheet(book, "extremes")
    assert heads[:5] == ["over the positions", "unit", "largest", "position", "O2 [deg]"]
    found = {row[0]: row for row in rows}
    effort = r.effort("O2") / 0.1129848290276167
    assert found["effort O2"][1:4] == ["lbf*in", pytest.approx(effort.max()), int(effort.argmax()) + 1]
    assert found["effort O2"][5:7] == [pytest.approx(effort.min()), int(effort.argmin()) + 1]
    assert found["|F| A"][2] * 4.4482216152605 == pytest.approx(r.worst("reaction", "A")[0])
    assert found["|F| A"][4] == pytest.approx(np.degrees(r.drive_position("O2")[found["|F| A"][3] - 1]))
    stated = dict(sheet(book, "assumptions"))
    assert stated["method"] == "equilibrium of all links at once, by one matrix, with inertia forces"
    assert (stated["gravity"], stated["friction"], stated["unit of moment"]) == ("none", "off", "lbf*in")
    assert stated["program"] == f"dalembert {da.__version__}"
    assert (stated["positions solved"], stated["largest residual"] < 1e-12) == (12, True)


def test_charts_are_native_and_have_gaps(tmp_path: Path) -> None:
    r = da.statics(GAP)
    assert 0 < r.ok.sum() < len(r.status)
    book = written(r, tmp_path)
    charts = book["charts"]._charts
    titles = ["".join(run.t for p in c.title.tx.rich.p for run in p.r) for c in charts]
    assert titles[:2] == ["Effort", "Joint forces"]
    assert {f"Polar diagram of {j}" for j in r.joints} == set(titles[2:])
    values = sheet(book, "chart values")
    effort = [row[1] for row in values[1:]]
    assert values[0][:2] == ["O2 [deg]", "O2 [N*m]"]
    assert [v is None for v in effort] == [not ok for ok in r.ok]
    assert [v for v in effort if v is not None] == pytest.approx(r.effort("O2")[r.ok])
    for chart in charts:
        assert chart.display_blanks == "gap"
        for series in chart.series:
            for of in (series.xVal.numRef.f, series.yVal.numRef.f):
                first, _, last = of.partition("!")[2].replace("$", "").partition(":")
                assert (first[1:], last[1:]) == ("2", str(len(r.status) + 1))
    (polar, *_) = charts[2:]
    assert polar.x_axis.scaling.max == polar.y_axis.scaling.max == -polar.x_axis.scaling.min
    largest = max(abs(v) for row in values[1:] for v in row[-2:] if v is not None)
    assert polar.x_axis.scaling.max >= largest


def test_no_text_of_the_user_is_a_formula(tmp_path: Path) -> None:
    title = '=HYPERLINK("x")'
    text = str(FOUR_BAR.with_values({"title": title, "source": "=1+1"}))
    text = text.replace("crank", "'=2+2'").replace("O4", "'#REF!'").replace("O2", "'=cmd|A1'")
    m = da.loads(text)
    assert {"=2+2"} <= set(m.links)
    assert {"#REF!"} <= set(m.joints)
    book = written(da.dynamics(m, positions=3), tmp_path)
    cells = [cell for s in book for row in s.rows for cell in row if cell.value is not None]
    assert {cell.data_type for cell in cells} <= {"n", "s", "inlineStr"}
    assert title in [cell.value for cell in cells]
    with ZipFile(tmp_path / "r.xlsx") as parts:
        for name in parts.namelist():
            content = parts.read(name)
            assert b"<f>" not in content or b"/charts/" in name.encode(), name
            assert b"externalLink" not in content


def test_characters_that_a_workbook_cannot_hold_are_replaced(tmp_path: Path) -> None:
    r = da.dynamics(FOUR_BAR.with_values({"title": "four\x07bar " + "x" * 40_000}))
    title = dict(sheet(written(r, tmp_path), "about"))["title"]
    assert title.startswith("four?bar xxx")
    assert len(title) == 32_767


@pytest.mark.parametrize("name", tiers(["two_drives"], ["truss", "balance_position", "rssr"]))
def test_every_sort_of_answer_has_a_workbook(name: str, tmp_path: Path) -> None:
    r = da.solve(da.load(examples()[name]))
    book = written(r, tmp_path)
    moving = len(r.status) > 1 and r.drives and r.stability is None
    assert ("charts" in book.sheetnames) == bool(moving)
    assert len(sheet(book, "positions")) == len(r.status) + 1


def test_tables_by_the_values_of_the_drives() -> None:
    r = da.solve(da.load(examples()["two_drives"]))
    frame = r.to_dataframe("file", index="drives")
    assert list(frame.index.names) == [
        f"drive.{d} [{'mm' if r.mechanism.drives[d].turns is False else 'deg'}]" for d in r.drives
    ]
    assert len(frame.index) == len(r.status)
    plain = r.to_dataframe("file")
    assert list(plain.index) == list(range(1, len(r.status) + 1))
    assert frame.attrs["units"][plain.columns[1]] == plain.columns[1].rpartition("[")[2][:-1]
    assert frame.attrs["units"]["residual"] == "1"
    data = r.to_xarray("file")
    for drive in r.drives:
        place = data.coords[f"drive_{drive}"]
        assert (place.values == plain[f"drive.{drive} [{place.attrs['units']}]"].to_numpy()).all()
    one = da.dynamics(FOUR_BAR, positions=6)
    assert list(one.to_dataframe("file", index="drives").index) == pytest.approx(
        np.degrees(one.drive_position("O2"))
    )


def test_what_has_no_value_has_no_chart(tmp_path: Path) -> None:
    r = da.kinematics(FOUR_BAR, positions=4)
    assert "charts" not in written(r, tmp_path).sheetnames


def test_charts_of_very_many_positions_are_thinned(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(workbook, "MOST_POINTS", 10)
    r = da.dynamics(FOUR_BAR, positions=36)
    values = sheet(written(r, tmp_path), "chart values")
    assert len(values) == 10
    assert [row[1] for row in values[1:]] == pytest.approx(r.effort("O2")[::4] / 0.1129848290276167)


def axes(chart: Any) -> list[tuple[str, Any, Any, Any]]:
    """Title, least, greatest and large step of both axes."""
    both = (chart.x_axis, chart.y_axis)
    titles = ["".join(run.t for p in a.title.tx.rich.p for run in p.r) for a in both]
    return [(title, a.scaling.min, a.scaling.max, a.majorUnit) for title, a in zip(titles, both, strict=True)]


RANGES = {  # of a drive's position in degrees: the ends of the axis, and its large step
    (40.0, 100.0): (30, 105, 15),
    (-25.0, 100.0): (-30, 105, 15),
    (10.0, 200.0): (0, 210, 30),
    (0.0, 330.0): (0, 360, 45),
    (-20.0, 400.0): (-60, 420, 60),
    (0.0, 700.0): (0, 720, 90),
    (50.0, 1000.0): (0, 1080, 180),
    (-90.0, 3000.0): (-360, 3240, 360),
}


@pytest.mark.parametrize("ends", RANGES)
def test_angles_have_an_axis_of_round_parts_of_a_turn(ends: tuple[float, float], tmp_path: Path) -> None:
    tree = da.four_bar().to_tree()
    tree["drives"]["O2"]["position"] = {"from": ends[0], "to": ends[1], "count": 5}
    r = da.dynamics(da.mechanism(tree))
    effort, forces, polar, *_ = written(r, tmp_path)["charts"]._charts
    for chart, name in ((effort, "Effort [N*m]"), (forces, "Joint forces [N]")):
        assert axes(chart) == [("O2 [deg]", *RANGES[ends]), (name, None, None, None)]
        assert chart.legend is not None
    largest = np.abs(r.reaction("O2")).max()
    step = 10.0 ** np.floor(np.log10(largest))
    end = np.ceil(largest / step) * step
    assert axes(polar) == [(f"O2, force {x} [N]", -end, end, end / 2) for x in "xy"]
    assert polar.legend is None
    assert [c.anchor._from.row for c in (effort, forces, polar)] == [0, 21, 42]


@pytest.mark.long
def test_what_has_no_drive_is_drawn_over_its_rows(tmp_path: Path) -> None:
    """From 1; designs of a study are numbered from 0, and lengths have an axis from the first to the last."""
    c = da.cam(da.disc_cam(positions=12), "F", count=13)
    c.save(tmp_path / "cam.xlsx")
    book = openpyxl.load_workbook(tmp_path / "cam.xlsx")
    count = len(c.turn)
    assert [axes(chart)[0] for chart in book["charts"]._charts] == [("place", 1, count, None)] * 2
    heads, *values = sheet(book, "chart values")
    assert heads[:2] == ["place", "turn [deg]"]
    assert [row[0] for row in values] == [*range(1, count + 1)]
    of = {head: [row[k] for row in values] for k, head in enumerate(heads)}
    assert of["turn [deg]"] == pytest.approx(np.degrees(c.turn))
    assert of["jerk [m]"] == pytest.approx(c.lift(c.turn)[3])
    lengths = heads[heads.index("place", 1) + 1 :]
    assert lengths == sorted(lengths, key=lambda head: -max(abs(x) for x in of[head]))
    s = da.study(
        da.four_bar(positions=3), {"links.coupler.mass": ["1 kg", "2 kg"]}, ["effort.O2"], draw="factorial"
    )
    s.run().save(tmp_path / "study.xlsx")
    first, *_ = openpyxl.load_workbook(tmp_path / "study.xlsx")["charts"]._charts
    assert axes(first)[0] == ("design", 0, 1, None)


def test_a_slide_has_an_axis_from_its_first_position_to_its_last(tmp_path: Path) -> None:
    tree = {
        "links": {"ground": {"points": {"O": [0, 0]}}, "ram": {"points": {"O": [0, 0]}, "mass": 2}},
        "joints": {"S": {"type": "slider", "links": ["ground", "ram"], "at": "O"}},
        "drives": {"S": {"position": {"from": 0.07, "to": -0.43, "count": 6}, "acceleration": 2.0}},
    }
    book = written(da.dynamics(da.mechanism(tree)), tmp_path)
    assert [axes(c)[0] for c in book["charts"]._charts] == [("S [m]", -0.43, 0.07, None)] * 2


def test_more_positions_than_a_sheet_holds_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(workbook, "MOST_ROWS", 12)
    written(da.dynamics(FOUR_BAR, positions=12), tmp_path)
    with pytest.raises(da.ModelError) as refused:
        da.dynamics(FOUR_BAR, positions=13).to_xlsx(tmp_path / "more.xlsx")
    assert str(refused.value) == "13 positions do not fit a worksheet of 12 rows; write CSV or netCDF"
    assert [path.name for path in tmp_path.iterdir()] == ["r.xlsx"]


def test_an_interrupted_workbook_leaves_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*_: Any) -> Any:
        raise KeyboardInterrupt

    monkeypatch.setattr(workbook, "_chart", interrupted)
    with pytest.raises(KeyboardInterrupt):
        da.dynamics(FOUR_BAR, positions=12).to_xlsx(tmp_path / "r.xlsx")
    assert list(tmp_path.iterdir()) == []


def test_a_chart_has_the_twelve_largest_curves_of_a_kind() -> None:
    r = da.statics(da.load(examples()["scissor_lift"]), positions=3)
    charts = {d.title: d for d in workbook.column_diagrams(r, r.scale("SI"), "ground")}
    sizes: dict[str, list[float]] = {}
    for c in r.columns("ground"):
        if c.kind in ("force", "moment") and not c.name.startswith("drive."):
            sizes.setdefault(c.kind, []).append(float(np.abs(c.values[:]).max()))
    assert len(sizes["force"]) > 12 > len(sizes["moment"])
    for title, kind in (("Force", "force"), ("Moment", "moment")):
        drawn = [float(np.abs(curve.values).max()) for curve in charts[title].curves]
        assert drawn == pytest.approx(sorted(sizes[kind], reverse=True)[:12])
    assert len(charts) == 6


def test_sheets_that_were_written_are_left_closed_where_the_last_one_is_interrupted(tmp_path: Path) -> None:
    for closed in (True, False):
        made: list[Any] = []

        def interrupted(closed: bool = closed, made: list[Any] = made) -> None:
            with workbook.new_book(tmp_path / "b.xlsx") as book:
                made.append(workbook.add_sheet(book, "a", [["1", 2.0]]))
                if closed:
                    made[0].close()
                raise KeyboardInterrupt

        with pytest.raises(KeyboardInterrupt):
            interrupted()
        assert made[0].closed
    assert list(tmp_path.iterdir()) == []
