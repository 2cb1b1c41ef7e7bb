"""Pieces of HTML for notebooks: a card with sentences, tables and a drawing, on light and dark pages.

No script, no request; every text of the user is escaped, rules are scoped to the card. Letters take the colour of the
page; a drawing is dark where the page says that it is (Jupyter, VS Code, Colab), or the reader's system.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from html import escape

from dalembert.errors import DalembertError
from dalembert.printing import Part, TextTable
from dalembert.views.formats.svg import rule
from dalembert.views.formats.themes import BACKGROUND, THEMES
from dalembert.views.paper.scene import Scene

ROWS, COLUMNS, LETTERS = 24, 16, 400
"""Largest table and longest sentence that are shown in full."""
LARGEST_DRAWING = 150_000
"""Largest number of characters of an SVG; a larger one is left to `draw`."""

STYLE = (
    ".da-card{max-width:64em;line-height:1.4}.da-card p{margin:.3em 0}.da-card .da-title{font-weight:bold}"
    ".da-card .da-wide{overflow-x:auto;margin:.5em 0}.da-card table{border-collapse:collapse;font-size:90%}"
    ".da-card th,.da-card td{text-align:right!important;padding:.15em .6em;white-space:nowrap;"
    "border:0;border-bottom:1px solid rgba(128,128,128,.35)}"
    ".da-card .da-left{text-align:left!important}.da-card .da-note{font-size:85%;opacity:.8}"
    ".da-card svg{max-width:100%;height:auto;max-height:32em}"
)
DARK = (
    ':is([data-jp-theme-light="false"],[data-theme="dark"],[theme="dark"],.vscode-dark,.vscode-high-contrast)'
)
SYSTEM = ':root:not([data-theme="light"]) body:not([data-jp-theme-light="true"],.vscode-light)'
"""Pages that say they are dark; pages that do not say they are light, for readers whose system is dark."""


def card(title: str, *parts: Part | Scene | Callable[[], Scene]) -> str:
    """A title and its content: sentences, tables, a drawing or a function that makes one.

    >>> "<b>" in card("<b>", "one sentence")
    False
    """
    shown = "".join(map(_part, parts))
    head = f'<p class="da-title">{escape(_cut(title))}</p>' if title else ""
    return f'<div class="da-card"><style>{STYLE}</style>{head}{shown}</div>'


def _part(part: Part | Scene | Callable[[], Scene]) -> str:
    if isinstance(part, str):
        return f"<p>{escape(_cut(part))}</p>" if part else ""
    return _table(part) if isinstance(part, TextTable) else _drawing(part)


def _cut(text: str) -> str:
    """A text in one line, cut where it is long."""
    line = " ".join(text.split())
    return line if len(line) <= LETTERS else line[: LETTERS - 3] + "..."


def _table(t: TextTable) -> str:
    """First rows of a table and the last one; if it has very many columns, the first ones."""
    rows = list(t.rows)
    if len(rows) > ROWS:
        rows = [*rows[: ROWS - 5], ["..."] * len(t.heads), *rows[-4:]]
    lines = [_row("th", t.heads, t.left), *(_row("td", row, t.left) for row in rows)]
    more = len(t.heads) - COLUMNS
    note = " ".join([*([f"{more} more columns."] if more > 0 else []), *t.note.split()])
    return f'<div class="da-wide"><table>{"".join(lines)}</table></div>' + (
        f'<p class="da-note">{escape(_cut(note))}</p>' if note else ""
    )


def _row(kind: str, cells: Sequence[str], left: int) -> str:
    out = ""
    for k, cell in enumerate(cells[:COLUMNS]):
        side = ' class="da-left"' if k < left else ""
        text = escape(cell if len(cell) <= LETTERS else _cut(cell)).replace("\n", "<br>")
        out += f"<{kind}{side}>{text}</{kind}>"
    return f"<tr>{out}</tr>"


def _drawing(made: Scene | Callable[[], Scene]) -> str:
    """The drawing, or the sentence why it does not exist."""
    try:
        scene = made if isinstance(made, Scene) else made()
    except DalembertError as error:
        return f'<p class="da-note">{escape(_cut(f"No drawing: {error}"))}</p>'
    svg = scene.to_svg()
    if len(svg) > LARGEST_DRAWING:
        return '<p class="da-note">The drawing is too large for this card: .draw() shows it.</p>'
    roles = {item.role for item in scene.flat() if hasattr(item, "role")}
    looks = "".join(rule("l", role, THEMES["dark"][role]) for role in sorted(roles))
    looks += f"svg>rect{{fill:{BACKGROUND['dark']}}}"
    dark, system = (re.sub(r"([^{}]+)\{", rf"{where} .da-card \1{{", looks) for where in (DARK, SYSTEM))
    return f"<style>{dark}@media (prefers-color-scheme:dark){{{system}}}</style>{svg}"
