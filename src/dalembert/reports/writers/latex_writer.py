"""A sheet as LaTeX source that compiles by itself, drawings included: amsmath, booktabs, geometry and tikz."""

from __future__ import annotations

from dalembert.reports import sheet as blocks
from dalembert.reports.formula import LATEX_SIGNS, latex, write_mixed
from dalembert.views.formats.svg import MARGIN
from dalembert.views.formats.tikz import tikz_picture
from dalembert.views.paper.lettering import plain as plain_sign
from dalembert.views.paper.scene import Scene

WIDTH, HEIGHT = 174.0, 240.0
"""Room on a page, mm."""

BESIDE = 96.0
"""Width of a drawing up to which text fits beside it, mm."""

LONGEST = 40
"""Rows of a table on one page."""

HEAD = r"""\documentclass[a4paper,10pt]{article}
\usepackage[utf8]{inputenc}
\usepackage[T1]{fontenc}
\IfFileExists{lmodern.sty}{\usepackage{lmodern}}{}
\usepackage{amsmath,booktabs,geometry,textcomp,tikz}
\geometry{margin=18mm}
\setcounter{MaxMatrixCols}{30}
\setlength{\parindent}{0pt}
\setlength{\emergencystretch}{3em}
\setlength{\parskip}{3pt plus 1pt}
\newcommand{\letters}[1]{\par\smallskip{\raggedright\hangindent=14mm\hspace*{3mm}$\displaystyle #1$\par}}
\newcommand{\numbers}[1]{{\nopagebreak\raggedright\hangindent=20mm\hspace*{14mm}$\displaystyle #1$\par}}
\newcommand{\fitted}[1]{\resizebox{\ifdim\width>\linewidth\linewidth\else\width\fi}{!}{#1}}
"""

_ESCAPED = {sign: f"${command}$" for sign, command in LATEX_SIGNS.items()} | {
    "\\": r"\textbackslash{}", "&": r"\&", "%": r"\%", "#": r"\#", "_": r"\_\allowbreak{}", "{": r"\{", "}": r"\}",
    "~": r"\~{}", "^": r"\^{}", "$": r"\$", **{sign: f"$^{n}$" for n, sign in enumerate("⁰¹²³⁴⁵⁶⁷⁸⁹")}, "⁻": "$^-$",
    "°": r"$^\circ$", "−": "$-$", "–": "--", "—": "---",
    "’": "'", "‘": "`", "“": "``", "”": "''", "„": ",,", "…": r"\dots{}", "\u00a0": "~",
}  # fmt: skip


def latex_text(sheet: blocks.ReportSheet) -> str:
    """The report as a LaTeX document."""
    body = "\n\n".join(_block(b) for b in sheet.blocks)
    below = r" \\ ".join(_words(line) for line in (sheet.source, sheet.subtitle) if line)
    head = rf"\title{{{_words(sheet.title)}}}\author{{}}\date{{{below}}}"
    return f"{HEAD}{head}\n\\begin{{document}}\n\\maketitle\n\n{body}\n\n\\end{{document}}\n"


def _words(text: str) -> str:
    return "".join(_ESCAPED.get(c, c) for c in text)


def _rich(text: str) -> str:
    return "".join(write_mixed(text, lambda f: f"${latex(f)}$", _words))


def _block(b: blocks.Block) -> str:
    if isinstance(b, blocks.Heading):
        room = r"\nopagebreak\vspace*{0.34\textheight}" if b.room else ""
        return rf"\{'sub' * (b.level - 1)}section{{{_words(b.text)}}}{room}"
    if isinstance(b, blocks.Paragraph):
        return _rich(b.text)
    if isinstance(b, blocks.Equations):
        return "\n".join(_equation(w) for w in b.lines)
    if isinstance(b, blocks.SheetTable):
        return _table(b)
    if isinstance(b, blocks.Matrix):
        return _matrix(b)
    if isinstance(b, blocks.PageBreak):
        return r"\clearpage"
    if isinstance(b, blocks.Blanks):
        return "\n\n".join(_blank(*row) for row in b.rows)
    if isinstance(b, blocks.Beside):
        return _beside(b)
    assert isinstance(b, blocks.Drawings)
    return _figure(b)


def _beside(b: blocks.Beside) -> str:
    """The drawing at the left, the text at its right where half the page is left of it."""
    text = "\n\n".join(_block(t) for t in b.texts)
    left, _, right, _ = b.scene.bounds
    wide = right - left + 2 * MARGIN
    if wide > BESIDE:
        return f"{_figure(blocks.Drawings((b.scene,)))}\n\n{text}"
    drawn = rf"\begin{{minipage}}[t]{{{wide:.1f}mm}}\vspace{{0pt}}{_picture(b.scene)}\end{{minipage}}\hfill"
    beside = rf"\begin{{minipage}}[t]{{{WIDTH - wide - 4:.1f}mm}}\vspace{{0pt}}"
    return f"\\par\\medskip\\noindent {drawn}{beside}\n{text}\n\\end{{minipage}}\\par\\medskip"


def _equation(w: blocks.Working) -> str:
    if w.result:
        return rf"\letters{{{' = '.join(latex(t) for t in (w.letters, w.numbers, w.result) if t)}}}"
    lines = [rf"\letters{{{latex(w.letters)}}}", *([rf"\numbers{{{latex(w.numbers)}}}"] if w.numbers else [])]
    return "\n".join(lines)


def _table(b: blocks.SheetTable) -> str:
    """Columns, made smaller where they are wider than the page; a long table in parts that fit one."""
    columns = "l" + ("r" if len(b.heads) > 5 and not b.words else "l") * (len(b.heads) - 1)
    heads = " & ".join(_rich(h) for h in b.heads) + r" \\"
    rows = [" & ".join(_rich(c) for c in row) + r" \\" for row in b.rows]
    if b.total:
        rows[-1] = f"\\midrule\n{rows[-1]}"
    parts = []
    for k in range(0, len(rows), LONGEST):
        body = [r"\toprule", heads, r"\midrule", *rows[k : k + LONGEST], r"\bottomrule"]
        head = rf"\fitted{{\small\begin{{tabular}}{{{columns}}}"
        parts.append("\n".join([head, *body, r"\end{tabular}}"]))
    caption = rf"\par\nopagebreak{{\footnotesize {_words(b.caption)}}}" if b.caption else ""
    return "\n\n\\medskip\n".join(parts) + caption + r"\par\medskip"


def _matrix(b: blocks.Matrix) -> str:
    def column(some: tuple[str, ...]) -> str:
        return r"\begin{bmatrix}" + r"\\".join(latex(s) for s in some) + r"\end{bmatrix}"

    rows = r"\\".join("&".join(latex(c) for c in row) for row in b.rows)
    product = rf"\begin{{bmatrix}}{rows}\end{{bmatrix}}{column(b.unknowns)}={column(b.right)}"
    equation = rf"{product},\quad {column(b.unknowns)}={column(b.values)}"
    return rf"{_words(b.caption)}\par\medskip\fitted{{\scriptsize ${equation}$}}\par"


def _blank(words: str, spaces: tuple[tuple[str, str], ...]) -> str:
    rooms = [rf"{_rich(name)} \rule{{27mm}}{{0.4pt}} {_words(unit)}".strip() for name, unit in spaces]
    return r" \quad ".join([rf"{_rich(words)} \hfill", *rooms])


def _figure(b: blocks.Drawings) -> str:
    """Drawings in rows as they fit; what is larger than the page is made smaller, and says so."""
    pictures = "\n\\hspace{3mm}\n".join(_picture(scene, b.columns) for scene in b.scenes)
    parts = [b.caption, *map(_smaller, b.scenes)]
    caption = " ".join(_words(part) for part in parts if part)
    return (
        rf"\begin{{center}}{pictures}"
        + (rf"\par{{\footnotesize {caption}}}" * bool(caption))
        + r"\end{center}"
    )


def _part(scene: Scene, columns: int = 1) -> float:
    """Factor by which a drawing's size is multiplied to fit the page."""
    left, bottom, right, top = scene.bounds
    width = WIDTH if scene.scales else WIDTH / columns - 4 * (columns > 1)
    return min(1.0, width / (right - left + 2 * MARGIN), HEIGHT / (top - bottom + 2 * MARGIN))


def _picture(scene: Scene, columns: int = 1) -> str:
    drawn, part = tikz_picture(scene, _words), _part(scene, columns)
    return drawn if part == 1.0 else rf"\scalebox{{{part:.3f}}}{{{drawn}}}"


def _smaller(scene: Scene) -> str:
    """That a drawing is not at the scales it states."""
    part = 100 * _part(scene)
    return (
        f"{plain_sign(scene.title)}: printed at {part:.0f} % of its scales."
        if part < 100 and scene.scales
        else ""
    )
