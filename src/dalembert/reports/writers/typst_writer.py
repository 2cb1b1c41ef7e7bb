"""A sheet by typst: PDF and HTML, from one template and the sheet as JSON."""

from __future__ import annotations

import json
from importlib import import_module
from importlib.resources import files
from typing import Any

from dalembert.arrays import Tree
from dalembert.reports.formula import typst, write_mixed
from dalembert.reports.sheet import Block, Equations, Figure, Heading, Matrix, Paragraph, Sheet, Table
from dalembert.views.formats.svg import MARGIN
from dalembert.views.paper.scene import Scene

WIDTH = 176.0
"""Width of the text in mm."""


def typst_bytes(sheet: Sheet, kind: str) -> bytes:
    """The report as `pdf` or `html`."""
    engine: Any = import_module("typst")
    pictures: dict[str, bytes] = {}
    tree: Tree = {
        "title": sheet.title,
        "source": sheet.source,
        "subtitle": sheet.subtitle,
        "blocks": [_block(b, pictures) for b in sheet.blocks],
    }
    template = files("dalembert.reports").joinpath("template.typ").read_text(encoding="utf-8")
    tree["style"] = files("dalembert.reports").joinpath("page.css").read_text(encoding="utf-8")
    out = engine.compile(
        {"main": template.encode(), "sheet.json": json.dumps(tree).encode(), **pictures},
        format=kind,
        sys_inputs={"target": "html" if kind == "html" else "paged"},
    )
    assert isinstance(out, bytes)
    return out


def _block(b: Block, pictures: dict[str, bytes]) -> Tree:
    if isinstance(b, Heading):
        return {"kind": "heading", "level": b.level, "text": b.text}
    if isinstance(b, Paragraph):
        return {"kind": "paragraph", "parts": _rich(b.text)}
    if isinstance(b, Equations):
        lines = [{n: typst(getattr(w, n)) for n in ("letters", "numbers", "result")} for w in b.lines]
        return {"kind": "equations", "lines": lines}
    if isinstance(b, Table):
        rows = [[_rich(cell) for cell in row] for row in b.rows]
        heads = [_rich(h) for h in b.heads]
        return {"kind": "table", "heads": heads, "rows": rows, "caption": b.caption, "total": b.total}
    if isinstance(b, Matrix):
        return {
            "kind": "matrix",
            "caption": b.caption,
            "rows": [[typst(c) for c in row] for row in b.rows],
            **{n: [typst(c) for c in getattr(b, n)] for n in ("unknowns", "right", "values")},
        }
    assert isinstance(b, Figure)
    return {"kind": "figure", "caption": b.caption, "files": _pictures(b.scenes, pictures)}


def _rich(text: str) -> list[str]:
    return write_mixed(text, typst, str)


def _pictures(scenes: tuple[Scene, ...], pictures: dict[str, bytes]) -> list[Tree]:
    out = []
    scale = 0.82 if len(scenes) > 1 else 0.95
    for scene in scenes:
        name = f"figure-{len(pictures) + 1}.svg"
        pictures[name] = scene.to_svg().encode()
        left, _, right, _ = scene.bounds
        out.append({"name": name, "width": round(right - left + 2 * MARGIN, 2), "scale": scale})
    return out
