"""What typst is given of a sheet: every kind of block, and where drawings go on a page of 176 mm."""

from __future__ import annotations

import json
from typing import Any

import pytest

from dalembert.reports import Report
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
from dalembert.reports.writers.typst_writer import typst_bytes
from dalembert.views.paper.scene import Line, Scene


def scene(width: float, title: str = "", scales: Any = None) -> Scene:
    """A line; its file has 3 mm on each side of it."""
    return Scene((Line(((-20.0, 0.0), (width - 26.0, 0.0))),), title, scales or {})


@pytest.fixture
def given(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """What the engine is called with; it answers with a document of a few bytes."""
    engine = pytest.importorskip("typst")
    seen: dict[str, Any] = {}

    def compiled(inputs: dict[str, bytes], **options: Any) -> bytes:
        seen.update(inputs, **options)
        return b"%PDF /Suspects false end"

    monkeypatch.setattr(engine, "compile", compiled)
    return seen


def blocks(given: dict[str, Any], *some: Any) -> list[Any]:
    typst_bytes(ReportSheet("t", blocks=list(some)), "html")
    (sheet,) = json.loads(given["sheet.json"])["sheets"]
    return list(sheet["blocks"])


def test_every_kind_of_block(given: dict[str, Any]) -> None:
    assert blocks(
        given,
        Heading("Forces", 2, room=True),
        Paragraph("The force $F_{12}$ acts."),
        Equations((Working("F = m a", "2 cdot 3", '6 "N"'),)),
        SheetTable(("A", "$x_{1}$"), (("1", "2"),), "caption", total=True),
        SheetTable(("A",), (("1",),), words=True),
        Matrix((("1", "0"),), ("F_{x}", "F_{y}"), ("−3",), ("4", "5"), "words"),
        PageBreak(),
        Blanks((("Sum $F$", (("x", "N"),)),)),
    ) == [
        {"kind": "heading", "level": 2, "text": "Forces", "room": True},
        {"kind": "paragraph", "parts": ["The force ", 'F_"12"', " acts."]},
        {
            "kind": "equations",
            "lines": [{"letters": "F = m a", "numbers": "2 dot.c 3", "result": '6 upright("N")'}],
        },
        {
            "kind": "table",
            "heads": [["A"], ["", 'x_"1"', ""]],
            "rows": [[["1"], ["2"]]],
            "caption": "caption",
            "total": True,
            "words": False,
        },
        {"kind": "table", "heads": [["A"]], "rows": [[["1"]]], "caption": "", "total": False, "words": True},
        {
            "kind": "matrix",
            "caption": "words",
            "rows": [["1", "0"]],
            "unknowns": ['F_"x"', 'F_"y"'],
            "right": ["-3"],
            "values": ["4", "5"],
        },
        {"kind": "break"},
        {"kind": "blanks", "rows": [[["Sum ", "F", ""], [["x", "N"]]]]},
    ]


def test_drawings_fill_the_rows_that_have_room(given: dict[str, Any]) -> None:
    """3 mm apart. One with scales keeps its size up to the page's width, and its caption says what is left of it."""
    some = (
        scene(90, "a", {"force": 2.0}),
        scene(200, "b", {"force": 2.0}),
        scene(83, "c"),
        scene(300),
        scene(83.123, "d"),
    )
    (figure,) = blocks(given, Drawings(some, "Three of them."))
    assert figure["caption"] == "Three of them. b: printed at 88 % of its scales."
    assert [(f["title"], f["width"]) for f in figure["files"]] == [
        *(("a", 90.0), ("c", 83.0), ("b", 176.0), ("drawing", 175.99), ("d", 83.12)),
    ]
    assert [f["name"] for f in figure["files"]] == [f"figure-{k}.svg" for k in range(1, 6)]
    assert all(given[f["name"]].startswith(b"<svg") for f in figure["files"])
    (figure,) = blocks(
        given, Drawings((scene(300), scene(170, "e", {"force": 1.0}), scene(80, "f")), columns=2)
    )
    assert figure["caption"] == ""
    assert [(f["title"], f["width"]) for f in figure["files"]] == [
        ("drawing", 86.49),
        ("f", 80.0),
        ("e", 170.0),
    ]


@pytest.mark.parametrize(("width", "fits"), [(96.0, True), (96.1, False)])
def test_text_is_beside_a_narrow_drawing(width: float, fits: bool, given: dict[str, Any]) -> None:
    (beside,) = blocks(given, Beside(scene(width, "body"), (Paragraph("words"),)))
    assert beside == {
        "kind": "beside",
        "file": {"name": "figure-1.svg", "width": width, "title": "body"},
        "beside": fits,
        "blocks": [{"kind": "paragraph", "parts": ["words"]}],
    }


def test_several_sheets_are_one_document_with_one_numbering_of_its_files(given: dict[str, Any]) -> None:
    one, two = (ReportSheet(t, "by " + t, "1 of 2", [Drawings((scene(50, t),))]) for t in ("A", "B"))
    assert typst_bytes(one, "pdf", two) == b"%PDF                 end"
    assert (given["format"], given["sys_inputs"]) == ("pdf", {"target": "paged"})
    tree = json.loads(given["sheet.json"])
    assert [(s["title"], s["source"], s["subtitle"]) for s in tree["sheets"]] == [
        ("A", "by A", "1 of 2"),
        ("B", "by B", "1 of 2"),
    ]
    names = [s["blocks"][0]["files"][0]["name"] for s in tree["sheets"]]
    assert names == ["figure-1.svg", "figure-2.svg"]
    assert tree["style"]
    assert Report(one).to_bytes("html") == b"%PDF /Suspects false end"
    assert (given["format"], given["sys_inputs"]) == ("html", {"target": "html"})
