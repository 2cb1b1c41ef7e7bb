"""LaTeX of every kind of block, and of drawings larger than a page."""

from __future__ import annotations

import re
from typing import Any

import pytest

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
    Working,
)
from dalembert.reports.writers.latex_writer import latex_text
from dalembert.views.paper.scene import Line, Scene


def scene(width: float, height: float = 6.0, title: str = "", scales: Any = None) -> Scene:
    """A diagonal line; its file has 3 mm on each side of it."""
    return Scene((Line(((-20.0, 5.0), (width - 26.0, height - 1.0))),), title, scales or {})


def source(*some: Block) -> str:
    """What stands between title and end, pictures by the sign [p]."""
    text = latex_text(ReportSheet("t", blocks=list(some))).partition("\\maketitle\n\n")[2]
    assert text.endswith("\n\n\\end{document}\n")
    picture = r"\\begin{tikzpicture}.*?\\end{tikzpicture}"
    return re.sub(picture, "[p]", text.removesuffix("\n\n\\end{document}\n"), flags=re.DOTALL)


def test_title_source_and_subtitle() -> None:
    text = latex_text(ReportSheet("A & B", "Norton_1", "50 %"))
    assert r"\title{A \& B}\author{}\date{Norton\_\allowbreak{}1 \\ 50 \%}" in text
    assert r"\date{50 \%}" in latex_text(ReportSheet("A", "", "50 %"))


@pytest.mark.parametrize(
    ("block", "latex"),
    [
        (Heading("Forces"), r"\section{Forces}"),
        (Heading("Forces", 2, room=True), r"\subsection{Forces}\nopagebreak\vspace*{0.34\textheight}"),
        (Paragraph("At 30° $F_{12}$ is 5 %."), r"At 30$^\circ$ $F_{\mathrm{12}}$ is 5 \%."),
        (
            Equations((Working("F = m a", "2 cdot 3", '6 "N"'), Working("a", "", "b"))),
            "\\letters{F = m a = 2 \\cdot 3 = 6 \\,\\mathrm{N}}\n\\letters{a = b}",
        ),
        (
            Equations((Working("a = b", "1 = 1"), Working("c = d"))),
            "\\letters{a = b}\n\\numbers{1 = 1}\n\\letters{c = d}",
        ),
        (PageBreak(), r"\clearpage"),
        (
            Blanks((("Sum", (("$x$", "N"), ("y", ""))), ("b", ()))),
            r"Sum \hfill \quad $x$ \rule{27mm}{0.4pt} N \quad y \rule{27mm}{0.4pt}" + "\n\n" + r"b \hfill",
        ),
        (
            Matrix((("1", "0"), ("2", "−3")), ("F_{x}", "y"), ("4", "5"), ("6", "7"), "50 %"),
            r"50 \%\par\medskip\fitted{\scriptsize $\begin{bmatrix}1&0\\2&-3\end{bmatrix}"
            r"\begin{bmatrix}F_{\mathrm{x}}\\y\end{bmatrix}=\begin{bmatrix}4\\5\end{bmatrix},\quad "
            r"\begin{bmatrix}F_{\mathrm{x}}\\y\end{bmatrix}=\begin{bmatrix}6\\7\end{bmatrix}$}\par",
        ),
    ],
)
def test_a_block(block: Block, latex: str) -> None:
    assert source(block) == latex


def table(rows: list[str], columns: str, heads: str) -> str:
    head = rf"\fitted{{\small\begin{{tabular}}{{{columns}}}" + "\n\\toprule\n" + heads + " \\\\\n\\midrule\n"
    return head + "\n".join(f"{row} \\\\" for row in rows) + "\n\\bottomrule\n\\end{tabular}}"


def test_tables() -> None:
    """Of more than five columns numbers are at the right; 40 rows are on one page, the sum apart."""
    assert source(SheetTable(("A", "$x$"), (("1", "2"), ("sum", "2")), "5 %", total=True)) == (
        table(["1 & 2", "\\midrule\nsum & 2"], "ll", "A & $x$") + "\\par\\nopagebreak{\\footnotesize 5 \\%}"
        "\\par\\medskip"
    )
    wide = tuple("ABCDEF")
    end = "\\par\\medskip"
    assert source(SheetTable(wide, (wide,))) == table([" & ".join(wide)], "lrrrrr", " & ".join(wide)) + end
    assert source(SheetTable(wide[:5], (wide[:5],))).startswith(r"\fitted{\small\begin{tabular}{lllll}")
    assert source(SheetTable(wide, (wide,), words=True)).startswith(r"\fitted{\small\begin{tabular}{llllll}")
    rows = tuple((str(k),) for k in range(81))
    parts = [table([str(k) for k in some], "l", "A") for some in (range(40), range(40, 80), (80,))]
    assert source(SheetTable(("A",), rows)) == "\n\n\\medskip\n".join(parts) + end
    assert source(SheetTable(("A",), rows[:40])) == parts[0] + end


def test_drawings_are_made_smaller_where_they_must_be() -> None:
    """Of 174 mm by 240 mm. With scales the caption says so; several columns are for drawings without."""
    scales = {"force": 2.0}
    small, wide, high = scene(100, 100, "a"), scene(200, 10, "b", scales), scene(50, 300, "c", scales)
    assert source(Drawings((small,))) == r"\begin{center}[p]\end{center}"
    assert source(Drawings((small, wide, high, scene(348, 10)), "Some.")) == (
        "\\begin{center}[p]\n\\hspace{3mm}\n\\scalebox{0.870}{[p]}\n\\hspace{3mm}\n\\scalebox{0.800}{[p]}\n"
        "\\hspace{3mm}\n\\scalebox{0.500}{[p]}\\par{\\footnotesize Some. b: printed at 87 \\% of its scales. "
        "c: printed at 80 \\% of its scales.}\\end{center}"
    )
    assert source(Drawings((small, scene(100, 100, "a", scales)), columns=2)) == (
        "\\begin{center}\\scalebox{0.830}{[p]}\n\\hspace{3mm}\n[p]\\end{center}"
    )


def test_text_is_beside_a_narrow_drawing() -> None:
    texts = Paragraph("One."), Equations((Working("a = b"),))
    written = "One.\n\n\\letters{a = b}"
    assert source(Beside(scene(96), texts)) == (
        "\\par\\medskip\\noindent \\begin{minipage}[t]{96.0mm}\\vspace{0pt}[p]\\end{minipage}\\hfill"
        f"\\begin{{minipage}}[t]{{74.0mm}}\\vspace{{0pt}}\n{written}\n\\end{{minipage}}\\par\\medskip"
    )
    assert source(Beside(scene(96.1), texts)) == f"\\begin{{center}}[p]\\end{{center}}\n\n{written}"
