"""A sheet as LaTeX source that compiles by itself: only amsmath, booktabs and geometry; drawings as their numbers."""

from __future__ import annotations

from dalembert.reports.formula import LATEX_SIGNS, latex, write_mixed
from dalembert.reports.sheet import (
    Blanks,
    Block,
    Equations,
    Figure,
    Heading,
    Matrix,
    Paragraph,
    Sheet,
    Table,
    Working,
)
from dalembert.views.paper.lettering import plain as plain_sign

HEAD = r"""\documentclass[a4paper,10pt]{article}
\usepackage[utf8]{inputenc}
\usepackage[T1]{fontenc}
\usepackage{amsmath,booktabs,geometry,textcomp}
\geometry{margin=18mm}
\setcounter{MaxMatrixCols}{30}
\setlength{\parindent}{0pt}
"""

_ESCAPED = {sign: f"${command}$" for sign, command in LATEX_SIGNS.items()} | {
    "\\": r"\textbackslash{}", "&": r"\&", "%": r"\%", "#": r"\#", "_": r"\_", "{": r"\{", "}": r"\}", "~": r"\~{}",
    "^": r"\^{}", "$": r"\$", "²": "$^2$", "³": "$^3$", "°": r"$^\circ$", "−": "$-$", "–": "--", "—": "---",
    "’": "'", "‘": "`", "“": "``", "”": "''", "„": ",,", "…": r"\dots{}", "\u00a0": "~",
}  # fmt: skip


def latex_text(sheet: Sheet) -> str:
    """The report as a LaTeX document."""
    body = "\n\n".join(_block(b) for b in sheet.blocks)
    head = (
        rf"\title{{{_words(sheet.title)}}}\author{{{_words(sheet.source)}}}\date{{{_words(sheet.subtitle)}}}"
    )
    return f"{HEAD}{head}\n\\begin{{document}}\n\\maketitle\n\n{body}\n\n\\end{{document}}\n"


def _words(text: str) -> str:
    return "".join(_ESCAPED.get(c, c) for c in text)


def _rich(text: str) -> str:
    return "".join(write_mixed(text, lambda f: f"${latex(f)}$", _words))


def _block(b: Block) -> str:
    if isinstance(b, Heading):
        return rf"\{'sub' * (b.level - 1)}section{{{_words(b.text)}}}"
    if isinstance(b, Paragraph):
        return _rich(b.text)
    if isinstance(b, Equations):
        return "\n".join(_equation(w) for w in b.lines)
    if isinstance(b, Table):
        return _table(b)
    if isinstance(b, Matrix):
        return _matrix(b)
    if isinstance(b, Blanks):
        return "\n\n".join(_blank(*row) for row in b.rows)
    assert isinstance(b, Figure)
    return "\n\n".join(_figure(scene) for scene in b.scenes)


def _equation(w: Working) -> str:
    if w.result:
        return rf"\[ {' = '.join(latex(t) for t in (w.letters, w.numbers, w.result) if t)} \]"
    if not w.numbers:
        return rf"\[ {latex(w.letters)} \]"
    return rf"\begin{{gather*}} {latex(w.letters)} \\ {latex(w.numbers)} \end{{gather*}}"


def _table(b: Table) -> str:
    columns = "l" + ("r" if len(b.heads) > 5 else "l") * (len(b.heads) - 1)
    rows = [" & ".join(_rich(c) for c in row) + r" \\" for row in b.rows]
    if b.total:
        rows.insert(len(rows) - 1, r"\midrule")
    heads = " & ".join(_rich(h) for h in b.heads) + r" \\"
    body = "\n".join([r"\toprule", heads, r"\midrule", *rows, r"\bottomrule"])
    caption = f"\n\n{{\\footnotesize {_words(b.caption)}}}" if b.caption else ""
    return f"{{\\small\\begin{{tabular}}{{{columns}}}\n{body}\n\\end{{tabular}}}}{caption}"


def _blank(words: str, spaces: tuple[tuple[str, str], ...]) -> str:
    rooms = [rf"{_rich(name)} \rule{{27mm}}{{0.4pt}} {_words(unit)}".strip() for name, unit in spaces]
    return r" \quad ".join([rf"{_rich(words)} \hfill", *rooms])


def _matrix(b: Matrix) -> str:
    def column(some: tuple[str, ...]) -> str:
        return r"\begin{bmatrix}" + r"\\".join(latex(s) for s in some) + r"\end{bmatrix}"

    rows = r"\\".join("&".join(latex(c) for c in row) for row in b.rows)
    whole = rf"\begin{{bmatrix}}{rows}\end{{bmatrix}}{column(b.unknowns)}={column(b.right)}"
    return rf"{_words(b.caption)}{{\scriptsize\[ {whole},\quad {column(b.unknowns)}={column(b.values)} \]}}"


def _figure(scene: object) -> str:
    from dalembert.views.paper.scene import Scene

    assert isinstance(scene, Scene)
    said = "; ".join(plain_sign(t.text) for t in scene.texts() if t.text != scene.title)
    return rf"\textit{{{_words(plain_sign(scene.title))}}} (drawing): {_words(said)}."
