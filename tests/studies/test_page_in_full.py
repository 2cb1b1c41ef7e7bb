"""The page of a small study in full: its headings, tables, sentences and drawings, beside what the study answers."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.reports.sheet import Drawings, Heading, Paragraph, ReportSheet, SheetTable
from dalembert.studies import StudyResult
from dalembert.studies.output import study_report

VARY = {
    "links.coupler.mass": "± 5 %",
    "links.crank.points.A.0": "uniform ± 2 %",
    "loads.torque.value": "normal 0.001 %",
}
OUTPUTS = ["effort.O2", "reaction.A"]


@pytest.fixture(scope="module")
def page() -> tuple[StudyResult, ReportSheet]:
    """Of a four-bar with a load, and a limit."""
    m = da.four_bar(positions=2).with_values({"loads.torque.value": 7.0})
    r = da.study(m, VARY, OUTPUTS, designs=12, seed=5, limits={"effort.O2": "< 9.3 N*m"}).run()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(study_report, "SOBOL", 64)
        return r, study_report.study_sheet(r)


def test_its_headings(page: tuple[StudyResult, ReportSheet]) -> None:
    r, sheet = page
    names = ["Varied numbers", "Designs by status", "Outputs", "effort.O2"]
    assert [b.text for b in sheet.blocks if isinstance(b, Heading)] == names
    assert sheet.title == r.study.mechanism.title
    said = [b.text for b in sheet.blocks if isinstance(b, Paragraph)]
    assert said[-1] == "Not shown, as they have several numbers a design or none: reaction.A."


def test_its_tables(page: tuple[StudyResult, ReportSheet]) -> None:
    r, sheet = page
    numbers, status, outputs, limits, *rest = (b for b in sheet.blocks if isinstance(b, SheetTable))
    assert list(numbers.heads) == ["number", "unit", "spread", "from", "to", "sigma"]
    assert numbers.caption == "Standard deviation; a tolerance is a normal distribution cut at 3 of them"
    kinds = [("kg", "tolerance"), ("m", "uniform"), ("N*m", "normal")]
    for row, path, (unit, kind), s in zip(numbers.rows, VARY, kinds, r.study.plan.spreads, strict=True):
        assert list(row) == [path, unit, kind, *(f"{x:.6g}" for x in (*s.ends, s.sigma))]
    assert list(status.heads) == ["status", "designs", "share"]
    assert list(map(list, status.rows)) == [["ok", "12", "100.0000%"]]
    assert [row[0] for row in outputs.rows] == ["effort.O2"]
    assert outputs.caption == "Over the positions: peak."
    share, cpk = r.share("effort.O2", "< 9.3 N*m"), r.capability("effort.O2", "< 9.3 N*m")
    assert list(map(list, limits.rows)) == [["effort.O2 < 9.3 N*m", f"{share:.4%}", f"{cpk:.3f}"]]
    assert len(rest) == 2


def test_the_shares_of_each_output(page: tuple[StudyResult, ReportSheet]) -> None:
    """The largest total share first, and none of less than half a percent."""
    r, sheet = page
    tables = [b for b in sheet.blocks if isinstance(b, SheetTable) and b.caption.startswith("Shares")]
    for table, name in zip(tables, ("effort.O2",), strict=True):
        linear, sobol = r.study.contributions(name), r.study.contributions(name, "sobol", 64)
        order = sorted(VARY, key=lambda path: -sobol.total[path])
        columns = (linear.shares, sobol.shares, sobol.total)
        rows = [
            [p, *(f"{of[p]:.2%}" for of in columns)] for p in order if max(of[p] for of in columns) >= 0.005
        ]
        assert list(table.heads) == ["number", "linear", "Sobol", "Sobol, with interactions"]
        assert list(map(list, table.rows)) == rows
        left = len(VARY) - len(rows)
        assert left >= 1
        assert table.caption == f"Shares of the variance of {name}; {left} of less than 0.5% left out"


def test_what_is_said_of_each_output(page: tuple[StudyResult, ReportSheet]) -> None:
    r, sheet = page
    said = [
        b.text for b in sheet.blocks if isinstance(b, Paragraph) and b.text.startswith("Standard deviation")
    ]
    for text, (name, unit) in zip(said, (("effort.O2", "N*m"),), strict=True):
        linear, sobol = r.study.contributions(name), r.study.contributions(name, "sobol", 64)
        worst = r.study.worst_case(name)
        assert f"{linear.sigma:.5g} {unit} (linear) and " in text
        assert f" {unit} (Sobol)." in text
        assert text.endswith(f"Worst case {worst.value:.5g} {unit}: {worst.assumed}.")
        notes = [f"Note: {of.note}." for of in (linear, sobol) if of.note]
        assert [note for note in notes if note in text] == notes


def test_the_extremes_and_the_drawings_of_each_output(page: tuple[StudyResult, ReportSheet]) -> None:
    r, sheet = page
    tables = [b for b in sheet.blocks if isinstance(b, SheetTable) and b.caption.startswith("The least")]
    drawings = [b for b in sheet.blocks if isinstance(b, Drawings)]
    assert len(drawings) == 4
    for k, name in enumerate(("effort.O2",)):
        n, worst = r.best(name), r.worst(name)
        heads = ["number", "unit", "model file", f"least: design {n}", f"greatest: design {worst}"]
        assert (list(tables[k].heads), tables[k].caption) == (heads, f"The least and the greatest {name}")
        assert [row[0] for row in tables[k].rows] == [*VARY, name]
        first, one, two, last = drawings[4 * k : 4 * k + 4]
        total = r.study.contributions(name, "sobol", 64).total
        order = sorted(VARY, key=lambda path: -total[path])
        titles = [s.title for s in (*first.scenes, *one.scenes, *two.scenes)]
        assert titles == [
            f"Distribution of {name}",
            f"Designs: {name} over {order[0]}",
            f"Response of {name} to {order[0]}",
            f"Response of {name} to {order[0]} and {order[1]}",
        ]
        assert len(last.scenes) == 2
        assert last.caption == f"Design {n}, then design {worst}, where {name} is largest in magnitude."


def test_a_design_is_drawn_at_its_largest_or_at_the_end(
    page: tuple[StudyResult, ReportSheet], monkeypatch: pytest.MonkeyPatch
) -> None:
    r, _ = page
    drawn: list[int] = []
    monkeypatch.setattr(study_report.draw, "mechanism", lambda result, at: drawn.append(at))
    output = study_report._Output(ReportSheet(""), r, "effort.O2")
    for n in (0, 7):
        output._drawing(n)
        own = da.dynamics(r.study.mechanism_of(n)).effort("O2")
        assert drawn.pop() == int(np.abs(own).argmax()) + 1
    monkeypatch.setattr(study_report._Output, "at_end", True)
    output._drawing(7)
    assert drawn == [2]
    known: Any = output.text(2.5)
    assert known == "2.5 N*m"
