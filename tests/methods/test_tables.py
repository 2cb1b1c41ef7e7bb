"""Tables of the worked solution as data and as LaTeX: where a sum stands apart, how wide ones are divided."""

from __future__ import annotations

import pytest

import dalembert as da
from dalembert.reports.sections.sources import _tables
from dalembert.reports.sheet import Equations, ReportSheet, SheetTable
from dalembert.reports.space_sections.space_closure import closing_lines
from dalembert.reports.working import working
from dalembert.reports.writers.latex_writer import _table
from dalembert.views.notation import Notation, Shown
from dalembert.views.stated import joint_measures
from tests.methods.space_machines import solved


def test_the_line_stands_before_the_sum() -> None:
    lines = _table(
        SheetTable(("Part", "N"), (("one", "1"), ("two", "2"), ("sum", "3")), total=True)
    ).splitlines()
    assert [line.split(" ")[0] for line in lines[1:9]] == [
        r"\toprule", "Part", r"\midrule", "one", "two", r"\midrule", "sum", r"\bottomrule",
    ]  # fmt: skip
    plain = _table(SheetTable(("Part", "N"), (("one", "1"), ("two", "2"))))
    assert plain.count("midrule") == 1


def test_every_table_that_ends_with_a_sum_sets_it_apart() -> None:
    sheet = working(solved("rssr"), 1, ("matrix", "virtual-work", "superposition"))
    tables = [block for block in sheet.blocks if isinstance(block, SheetTable)]
    summed = [t for t in tables if t.rows[-1][0] in ("sum", "Sum", "Σ")]
    assert summed
    assert all(t.total for t in summed)


@pytest.mark.parametrize(
    ("efforts", "joints", "each", "widths"),
    [(1, 4, 4, [9, 8]), (2, 3, 4, [6, 8]), (0, 2, 4, [8]), (12, 1, 4, [12, 4]), (1, 2, 5, [6, 5])],
)
def test_wide_tables_are_divided_by_whole_joints(
    efforts: int, joints: int, each: int, widths: list[int]
) -> None:
    one, other = [("E", 0, 0)] * efforts, [[("F", k, n) for n in range(each)] for k in range(joints)]
    found = _tables([one, *other])  # type: ignore[list-item]
    assert [len(columns) for columns in found] == widths
    assert [c for columns in found for c in columns] == [*one, *(c for group in other for c in group)]


@pytest.mark.parametrize(("moving", "orders"), [(False, 1), (True, 3)])
def test_loops_close_in_lengths_and_where_it_moves_in_both_rates(moving: bool, orders: int) -> None:
    r, sheet = solved("rssr"), ReportSheet("")
    closing_lines(sheet, r, 0, Shown(r, Notation()), moving)
    assert len([b for b in sheet.blocks if isinstance(b, Equations)]) == orders  # of one loop


@pytest.mark.parametrize(
    ("joint", "words"),
    [
        (da.Pin(links=("a", "b")), ""),
        (da.Slot(links=("a", "b"), direction="30 deg"), ", along 30.00°"),
        (da.CircularSlot(links=("a", "b"), radius="0.2 m"), ", radius 200.0 mm"),
        (
            da.Gear(links=("a", "b"), radii=("40 mm", "80 mm"), internal=True),
            ", pitch radii 40.00 mm and 80.00 mm, internal, pressure angle 20.00°",
        ),
        (da.Rolling(links=("a", "b"), radii=("40 mm", "80 mm")), ", radii 40.00 mm and 80.00 mm"),
        (da.Rolling(links=("a", "b"), radius="80 mm", direction="5 deg"), ", radius 80.00 mm, along 5.000°"),
    ],
    ids=lambda given: getattr(given, "type", ""),
)
def test_joints_are_given_with_theirjoint_measures(joint: object, words: str) -> None:
    """Only teeth have a pitch; a wheel on a line has one radius."""
    assert joint_measures(Shown(solved("rssr"), Notation()), joint) == words
