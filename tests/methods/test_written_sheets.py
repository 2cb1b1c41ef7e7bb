"""Sheets as plain text and as data for the page: headings, tables, matrices, blanks, and drawings in rows."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from dalembert.reports.formula import (
    _inside,
    _power_of_ten,
    bracket_negative,
    latex,
    plain,
    typst,
    write_mixed,
)
from dalembert.reports.sheet import (
    Beside,
    Blanks,
    Drawings,
    Equations,
    Heading,
    Matrix,
    PageBreak,
    Paragraph,
    ReportSheet,
    SheetTable,
    Working,
)
from dalembert.reports.writers import typst_writer
from dalembert.reports.writers.plain_writer import plain_block, plain_text
from dalembert.views.formats.svg import MARGIN


def scene(width: float, scales: Any = (), title: str = "") -> Any:
    """A drawing whose file has a width."""
    made = SimpleNamespace(bounds=(3.0, 1.0, 3.0 + width - 2 * MARGIN, 2.0), scales=scales, title=title)
    made.to_svg = lambda: f"<{title}>"
    return made


def test_headings_of_the_first_level_are_numbered() -> None:
    sheet = ReportSheet("A title", "A book", "A position")
    sheet.heading("Given")
    sheet.heading("Links", 2)
    sheet.text("")
    sheet.text("words $F_{A}$")
    sheet.equations([])
    sheet.table(["a"], [])
    sheet.blocks.append(PageBreak())
    sheet.heading("Forces")
    assert plain_text(sheet) == (
        "A title\n=======\nA book\nA position\n\n1 Given\n-------\n\nLinks\n.....\n\nwords F_A\n\n2 Forces\n--------\n"
    )
    assert plain_text(ReportSheet("T")) == "T\n=\n\n\n"


def test_blocks_are_written_as_text() -> None:
    lines = Equations((Working("a", "b", "c"), Working("d", "e"), Working("f"), Working("g", "", "h")))
    assert plain_block(lines) == "  a = b = c\n  d\n      e\n  f\n  g = h"
    table = SheetTable(("Link", "m"), (("crank", "1"), ("a", "22"), ("sum", "23")), "in kg", True)
    assert plain_block(table) == "Link   m\n---------\ncrank  1\na      22\n---------\nsum    23\nin kg"
    bare = SheetTable(("Link", "m"), (("a", "1"),))
    assert plain_block(bare) == "Link  m\n-------\na     1"
    matrix = Matrix((("1", "0"), ("2", "−3")), ("F_{x}", "M"), ("5", "6"), ("7", "8"), "Known terms")
    assert plain_block(matrix).split("\n") == [
        "Known terms",
        "",
        "F_x  M   =  unknown  value",
        "--------------------------",
        "1    0   5  F_x      7",
        "2    −3  6  M        8",
    ]
    blanks = Blanks((("Force $F$", (("size", "N"), ("angle", ""))),))
    assert plain_block(blanks) == f"Force F  size {'_' * 14} N  angle {'_' * 14}"
    both = Beside(scene(50, title="Rod"), (Paragraph("one"), Equations((Working("a"),))))
    assert plain_block(both) == "[drawing: Rod]\n\none\n\n  a"
    assert plain_block(Drawings((scene(5, title="A"), scene(5, title="B")))) == "[drawing: A]\n[drawing: B]"
    assert plain_block(PageBreak()) == ""
    assert max(map(len, plain_block(Paragraph("word " * 50)).split("\n"))) <= 100
    assert len(plain_block(Paragraph("x" * 50 + " " + "y" * 49)).split("\n")) == 1


def test_blocks_are_data_for_the_page() -> None:
    block = lambda b: typst_writer._block(b, {})  # noqa: E731
    assert block(Heading("a", 2, True)) == {"kind": "heading", "level": 2, "text": "a", "room": True}
    assert block(Paragraph("a $b$ c")) == {"kind": "paragraph", "parts": ["a ", "b", " c"]}
    assert block(Equations((Working("a", "1", "2"),)))["lines"] == [
        {"letters": "a", "numbers": "1", "result": "2"}
    ]
    table = block(SheetTable(("h", "$i$"), (("1", "2"),), "c", True, True))
    assert (table["heads"], table["rows"], table["caption"]) == (
        [["h"], ["", "i", ""]],
        [[["1"], ["2"]]],
        "c",
    )
    assert (table["total"], table["words"]) == (True, True)
    assert block(SheetTable(("h",), (("1",),)))["total"] is False
    matrix = block(Matrix((("1", "2"),), ("a",), ("3",), ("4",), "c"))
    assert (matrix["rows"], matrix["unknowns"], matrix["right"], matrix["values"]) == (
        [["1", "2"]],
        ["a"],
        ["3"],
        ["4"],
    )
    assert block(PageBreak()) == {"kind": "break"}
    assert block(Blanks((("w", (("n", "u"),)),))) == {"kind": "blanks", "rows": [[["w"], (("n", "u"),)]]}


@pytest.mark.parametrize(("width", "beside"), [(96.0, True), (96.01, False)])
def test_text_fits_beside_a_drawing_of_96_mm(width: float, beside: bool) -> None:
    pictures: dict[str, bytes] = {}
    made = typst_writer._block(Beside(scene(width, title="Rod"), (Paragraph("a"),)), pictures)
    assert made["beside"] is beside
    assert made["file"] == {"name": "figure-1.svg", "width": pytest.approx(width), "title": "Rod"}
    assert pictures == {"figure-1.svg": b"<Rod>"}
    assert made["blocks"] == [{"kind": "paragraph", "parts": ["a"]}]


def test_drawings_stand_in_the_first_row_with_room() -> None:
    """The text is 176 mm wide, and 3 mm are left between drawings."""
    files = typst_writer._pictures(
        tuple(scene(w, ("1:1",), t) for w, t in ((100, "a"), (90, "b"), (73, "c"), (83, "d"), (300, "e"))), {}
    )
    assert [f["title"] for f in files] == ["a", "c", "b", "d", "e"]
    assert [f["width"] for f in files] == pytest.approx([100, 73, 90, 83, 176])
    assert [f["name"] for f in files] == [f"figure-{k}.svg" for k in range(1, 6)]
    files = typst_writer._pictures(
        (scene(100, ("1:1",), "a"), scene(73.01, ("1:1",), "b"), scene(50, (), "")), {}
    )
    assert [f["title"] for f in files] == ["a", "drawing", "b"]
    two = typst_writer._pictures((scene(100), scene(100)), {"other": b""}, 2)
    assert [f["width"] for f in two] == [86.49, 86.49]
    assert [f["name"] for f in two] == ["figure-2.svg", "figure-3.svg"]
    assert typst_writer._pictures((scene(100, ("1:1",)),), {}, 2)[0]["width"] == 100
    assert typst_writer._printed_smaller(scene(352, ("1:1",), "Rod")) == "Rod: printed at 50 % of its scales."
    assert typst_writer._printed_smaller(scene(176, ("1:1",), "Rod")) == ""
    assert typst_writer._printed_smaller(scene(352, (), "Rod")) == ""
    made: Any = typst_writer._block(Drawings((scene(352, ("1:1",), "Rod"), scene(10)), "Before"), {})
    assert made["caption"] == "Before Rod: printed at 50 % of its scales."


# formulas


@pytest.mark.parametrize(
    ("text", "in_typst", "in_latex", "in_plain"),
    [
        (
            "frac(a; frac(b; c)) + d",
            "frac(a, frac(b, c)) + d",
            r"\frac{a}{\frac{b}{c}} + d",
            "(a)/((b)/(c)) + d",
        ),
        ("frac((a); b)", "frac((a), b)", r"\frac{(a)}{b}", "((a))/(b)"),
        ("x^{2} F_{12x}", 'x^"2" F_"12x"', r"x^{\mathrm{2}} F_{\mathrm{12x}}", "x^2 F_12x"),
        ("2e−6 deg", "2 dot.c 10^(-6) degree", r"2 \cdot 10^{-6} {}^\circ", "2e−6 °"),
        ("rod · −3", '"rod" dot.c -3', r"\mathrm{rod} \cdot  -3", "rod · −3"),
        ("(a", r"\(a", "(a", "(a"),
        ("[a)", r"\[a\)", "[a)", "[a)"),
    ],
)
def test_formulas_are_written_in_each_notation(
    text: str, in_typst: str, in_latex: str, in_plain: str
) -> None:
    squeeze = lambda s: " ".join(s.split())  # noqa: E731
    assert squeeze(typst(text)) == squeeze(in_typst)
    assert squeeze(latex(text)) == squeeze(in_latex)
    assert squeeze(plain(text)) == squeeze(in_plain)
    assert squeeze(plain("x-1")) == "x−1"


def test_parts_of_formulas() -> None:
    tokens = list("(a);b)c")
    assert (_inside(tokens), tokens) == (("(a)", "b"), ["c"])
    assert (_power_of_ten("2e−6"), _power_of_ten("2.5e+12"), _power_of_ten("7")) == (
        ("2", -6),
        ("2.5", 12),
        ("7", 0),
    )
    assert (bracket_negative("−3"), bracket_negative("3−")) == ("(−3)", "3−")
    up, low = str.upper, str.lower
    assert write_mixed("A$b$C$d$E", up, low) == ["a", "B", "c", "D", "e"]
    assert write_mixed("A$b$C$D", up, low) == ["a$b$c$d"]
    assert write_mixed("AB", up, low) == ["ab"]
