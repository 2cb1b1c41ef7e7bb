"""A sheet by typst: PDF and HTML, from one template and the sheet as JSON."""

from __future__ import annotations

import json
from functools import cache
from importlib import import_module
from importlib.resources import files
from typing import Any

from dalembert.arrays import Tree
from dalembert.reports.formula import typst, write_mixed
from dalembert.reports.sheet import (
    Beside,
    Blanks,
    Block,
    Drawings,
    Equations,
    Heading,
    Matrix,
    PageBreak,
    Paragraph,
    ReportSheet,
    SheetTable,
)
from dalembert.views.formats.svg import MARGIN
from dalembert.views.paper.scene import Scene

WIDTH = 176.0
"""Width of the text in mm."""

BESIDE = 96.0
"""Width of a drawing up to which text fits beside it, mm."""

DOUBT = b"/Suspects false"
"""Entry of a tagged PDF that says its default, and which some readers report as an error."""

GAP = 3.0
"""Between drawings side by side, mm."""


@cache
def _fonts() -> Any:
    """The fonts of this machine, looked for once."""
    return import_module("typst").Fonts()


def typst_bytes(sheet: ReportSheet, kind: str, *more: ReportSheet) -> bytes:
    """The report as `pdf` or `html`; with ``more`` sheets behind it, each of which begins a page."""
    engine: Any = import_module("typst")
    pictures: dict[str, bytes] = {}
    tree: Tree = {"sheets": [_sheet(one, pictures) for one in (sheet, *more)]}
    template = files("dalembert.reports").joinpath("template.typ").read_text(encoding="utf-8")
    tree["style"] = files("dalembert.reports").joinpath("page.css").read_text(encoding="utf-8")
    out = engine.compile(
        {"main": template.encode(), "sheet.json": json.dumps(tree).encode(), **pictures},
        format=kind,
        font_paths=_fonts(),
        sys_inputs={"target": "html" if kind == "html" else "paged"},
    )
    assert isinstance(out, bytes)
    return out.replace(DOUBT, b" " * len(DOUBT)) if kind == "pdf" else out


def _sheet(sheet: ReportSheet, pictures: dict[str, bytes]) -> Tree:
    blocks = [_block(b, pictures) for b in sheet.blocks]
    return {"title": sheet.title, "source": sheet.source, "subtitle": sheet.subtitle, "blocks": blocks}


def _block(b: Block, pictures: dict[str, bytes]) -> Tree:
    if isinstance(b, Heading):
        return {"kind": "heading", "level": b.level, "text": b.text, "room": b.room}
    if isinstance(b, Paragraph):
        return {"kind": "paragraph", "parts": _rich(b.text)}
    if isinstance(b, Equations):
        lines = [{n: typst(getattr(w, n)) for n in ("letters", "numbers", "result")} for w in b.lines]
        return {"kind": "equations", "lines": lines}
    if isinstance(b, SheetTable):
        rows = [[_rich(cell) for cell in row] for row in b.rows]
        heads = [_rich(h) for h in b.heads]
        return {"kind": "table", "heads": heads, "rows": rows, "caption": b.caption, "total": b.total} | {
            "words": b.words
        }
    if isinstance(b, Matrix):
        return {
            "kind": "matrix",
            "caption": b.caption,
            "rows": [[typst(c) for c in row] for row in b.rows],
            **{n: [typst(c) for c in getattr(b, n)] for n in ("unknowns", "right", "values")},
        }
    if isinstance(b, PageBreak):
        return {"kind": "break"}
    if isinstance(b, Blanks):
        return {"kind": "blanks", "rows": [[_rich(words), spaces] for words, spaces in b.rows]}
    if isinstance(b, Beside):
        picture = _pictures((b.scene,), pictures)
        wide, texts = _width(b.scene) <= BESIDE, [_block(t, pictures) for t in b.texts]
        return {"kind": "beside", "file": picture[0], "beside": wide, "blocks": texts}
    assert isinstance(b, Drawings)
    caption = " ".join(filter(None, [b.caption, *map(_printed_smaller, b.scenes)]))
    return {"kind": "figure", "caption": caption, "files": _pictures(b.scenes, pictures, b.columns)}


def _rich(text: str) -> list[str]:
    return write_mixed(text, typst, str)


def _width(scene: Scene) -> float:
    """Width of a drawing's file in mm."""
    left, _, right, _ = scene.bounds
    return right - left + 2 * MARGIN


def _printed_smaller(scene: Scene) -> str:
    """That a drawing wider than the page is not at the scales it states."""
    part = 100 * WIDTH / max(_width(scene), WIDTH)
    return f"{scene.title}: printed at {part:.0f} % of its scales." if part < 100 and scene.scales else ""


def _pictures(scenes: tuple[Scene, ...], pictures: dict[str, bytes], columns: int = 1) -> list[Tree]:
    """The files of drawings in their true size, those side by side that fit: each in the first row with room."""
    rows: list[list[tuple[float, Scene]]] = []
    for scene in scenes:
        widest = WIDTH if scene.scales else (WIDTH - GAP * (columns - 1)) / columns - 0.01
        width = min(_width(scene), widest)
        row = next((row for row in rows if sum(w + GAP for w, _ in row) + width <= WIDTH), None)
        rows += [] if row is not None else [[]]
        (rows[-1] if row is None else row).append((width, scene))
    out = []
    for width, scene in (picture for row in rows for picture in row):
        name = f"figure-{len(pictures) + 1}.svg"
        pictures[name] = scene.to_svg().encode()
        out.append({"name": name, "width": round(min(width, WIDTH), 2), "title": scene.title or "drawing"})
    return out
