"""A sheet as plain text, 100 columns wide."""

from __future__ import annotations

import textwrap

from dalembert.reports import sheet as blocks
from dalembert.reports.formula import plain, write_mixed
from dalembert.views.paper.lettering import plain as plain_sign

WIDTH = 100


def plain_text(sheet: blocks.ReportSheet) -> str:
    """The report as text for a terminal."""
    head = [sheet.title, "=" * len(sheet.title), *(t for t in (sheet.source, sheet.subtitle) if t)]
    numbered, count = [], 0
    for b in sheet.blocks:
        if isinstance(b, blocks.Heading) and b.level == 1:
            count += 1
            b = blocks.Heading(f"{count} {b.text}")
        numbered.append(plain_block(b))
    return "\n".join(head) + "\n\n" + "\n\n".join(t for t in numbered if t) + "\n"


def _rich(text: str) -> str:
    return "".join(write_mixed(text, plain, str))


def plain_block(b: blocks.Block) -> str:
    """One block as text."""
    if isinstance(b, blocks.Heading):
        return f"{b.text}\n{('-' if b.level == 1 else '.') * len(b.text)}"
    if isinstance(b, blocks.Paragraph):
        return textwrap.fill(_rich(b.text), WIDTH)
    if isinstance(b, blocks.Equations):
        return "\n".join(line for w in b.lines for line in _equation(w))
    if isinstance(b, blocks.SheetTable):
        return _table([[_rich(c) for c in row] for row in (b.heads, *b.rows)], b.caption, b.total)
    if isinstance(b, blocks.Matrix):
        return _matrix(b)
    if isinstance(b, blocks.PageBreak):
        return ""
    if isinstance(b, blocks.Blanks):
        rooms = [(w, "  ".join(f"{n} {'_' * 14} {u}".strip() for n, u in spaces)) for w, spaces in b.rows]
        return "\n".join(f"{_rich(words)}  {room}" for words, room in rooms)
    if isinstance(b, blocks.Beside):
        return "\n\n".join([f"[drawing: {plain_sign(b.scene.title)}]", *map(plain_block, b.texts)])
    assert isinstance(b, blocks.Drawings)
    return "\n".join(f"[drawing: {plain_sign(s.title)}]" for s in b.scenes)


def _equation(w: blocks.Working) -> list[str]:
    if w.result:
        return ["  " + " = ".join(plain(t) for t in (w.letters, w.numbers, w.result) if t)]
    return ["  " + plain(w.letters), *(["      " + plain(w.numbers)] if w.numbers else [])]


def _table(rows: list[list[str]], caption: str, total: bool) -> str:
    wide = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    lines = ["  ".join(c.ljust(w) for c, w in zip(row, wide, strict=True)).rstrip() for row in rows]
    rule = "-" * (sum(wide) + 2 * (len(wide) - 1))
    body = [lines[0], rule, *lines[1:]]
    if total:
        body.insert(len(body) - 1, rule)
    return "\n".join([*body, *([caption] if caption else [])])


def _matrix(b: blocks.Matrix) -> str:
    heads = [*(plain(u) for u in b.unknowns), "=", "unknown", "value"]
    rows = [
        [*(plain(c) for c in row), plain(right), plain(unknown), plain(value)]
        for row, right, unknown, value in zip(b.rows, b.right, b.unknowns, b.values, strict=True)
    ]
    return textwrap.fill(b.caption, WIDTH) + "\n\n" + _table([heads, *rows], "", False)
