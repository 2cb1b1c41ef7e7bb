"""Worked solutions as LaTeX: what a compiler would stop at, found by a reader of its own; names with any sign."""

from __future__ import annotations

import importlib.util
import re
from typing import Any

import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.reports.formula import latex, plain, typst
from dalembert.reports.sheet import Beside, Drawings, Paragraph, ReportSheet
from dalembert.reports.writers.latex_writer import LONGEST, latex_text
from dalembert.views.paper.scene import Line, Scene
from tests.methods.latex_source import problems
from tests.tiers import crossed, tiers

MANY = "four_cylinder"
"""The one example of many links over many positions: its sheet takes as long as those of all others."""
SHOWN = tiers(
    [*list(examples())[::3], *list(cases())[::40]], [MANY, *list(examples())[1::3], *list(cases())[5::5]]
)
SIGNS = [
    "é",
    "ß",
    "#",
    "%",
    "&",
    "_",
    "$",
    "{",
    "}",
    "\\",
    '"',
    "'",
    "~",
    "^",
    "<",
    "μ",
    "Ω",
    "≤",
    "(",
    "–",
    " b",
]


def source(m: da.Mechanism, **options: Any) -> str:
    return str(da.report(da.solve(m), **options).to_bytes("tex").decode())


@pytest.mark.parametrize("name", SHOWN)
def test_reports_compile(name: str) -> None:
    assert problems(source(da.load((examples() | cases())[name]))) == []


@pytest.mark.parametrize(
    "notation", [da.Notation(links="name", axes="link"), da.Notation(decimals=1, torque=-1)]
)
def test_reports_compile_in_every_notation(notation: da.Notation) -> None:
    assert problems(source(da.load(examples()["four_bar"]), notation=notation)) == []


def test_force_systems_compile() -> None:
    r = da.dynamics(da.load(examples()["four_bar"]))
    assert problems(da.report(da.wrench.on(r, "coupler")).to_bytes("tex").decode()) == []


def named(sign: str) -> da.Mechanism:
    """A four-bar with the sign in its title, a link, a joint and a load."""
    rod, joint = f"rod{sign}1", f"A{sign}x"
    return da.Mechanism(
        title=f"Title {sign} of it",
        source=f"Book {sign}",
        links={
            "ground": {"points": {"O": [0, 0], "C": [0.3, 0]}},
            "crank": {"points": {"O": [0, 0], joint: [0.1, 0]}, "mass": 1.0},
            rod: {"points": {joint: [0, 0], "B": [0.3, 0]}, "mass": 2.0, "center": [0.1, 0.02]},
            "rocker": {"points": {"C": [0, 0], "B": [0.2, 0]}},
        },
        joints={
            name: {"type": "pin", "links": list(links)}
            for name, links in {
                "O": ("ground", "crank"),
                joint: ("crank", rod),
                "B": (rod, "rocker"),
                "C": ("ground", "rocker"),
            }.items()
        },
        drives={"O": {"position": 1.0, "speed": 10.0}},
        loads={f"F{sign}": {"type": "force", "on": rod, "at": "B", "value": [1e8, -30.0]}},
    )


@crossed("sign, links", SIGNS, ["number", "name"])
def test_names_may_have_any_sign(sign: str, links: Any) -> None:
    assert problems(source(named(sign), notation=da.Notation(links=links))) == []


@pytest.mark.skipif(importlib.util.find_spec("typst") is None, reason="extra report")
@pytest.mark.parametrize("signs", tiers(["é#%&", "_${"], ['}\\"', "'~^<", "μΩ≤(", "– b"]))
def test_names_may_have_any_sign_in_html(signs: str) -> None:
    for sign in signs:
        assert da.report(da.solve(named(sign.strip() or "x"))).to_bytes("html")


@pytest.mark.parametrize(
    ("size", "scaled", "columns", "part"),
    [
        ((200, 100), False, 1, 174 / 206),
        ((50, 300), False, 1, 240 / 306),
        ((100, 100), False, 2, 83 / 106),
        ((100, 100), True, 2, 1.0),
        ((168, 234), False, 1, 1.0),
        ((168.5, 99), False, 1, 174 / 174.5),
        ((99, 234.5), False, 1, 240 / 240.5),
    ],
)
def test_drawings_are_made_as_small_as_the_page_asks(
    size: tuple[float, float], scaled: bool, columns: int, part: float
) -> None:
    """The page is 174 mm by 240 mm, a drawing has 3 mm around it, two in a row are 8 mm apart."""
    scene = Scene((Line(((0, 0), size)),), "Title", scales={"length": 1.0} if scaled else {})
    text = latex_text(ReportSheet("t", blocks=[Drawings((scene,), "", columns)]))
    found = re.findall(r"\\scalebox\{([\d.]+)\}", text)
    assert [float(x) for x in found] == ([] if part == 1.0 else [round(part, 3)])


def test_text_stands_beside_a_drawing_of_half_the_page() -> None:
    for width, rooms in ((60.0, ["66.0", "104.0"]), (90.0, ["96.0", "74.0"]), (90.5, [])):
        scene = Scene((Line(((0, 0), (width, 50))),))
        text = latex_text(ReportSheet("t", blocks=[Beside(scene, (Paragraph("words"),))]))
        assert re.findall(r"minipage\}\[t\]\{([\d.]+)mm", text) == rooms


FORMULAS = {
    "F = −1.234e−14 + 1.000e+07": (
        r"F = -1.234 \cdot 10^{-14} + 1.000 \cdot 10^{7}",
        "F = -1.234 dot.c 10^(-14) + 1.000 dot.c 10^(7)",
        "F = −1.234e−14 + 1.000e+07",
    ),
    'W = 3 "lbf in" cdot x_{A1}^{2}': (
        r"W = 3 \,\mathrm{lbf\ in} \cdot x_{\mathrm{A1}}^{\mathrm{2}}",
        'W = 3 upright("lbf in") dot.c x_"A1"^"2"',
        "W = 3 lbf in · x_A1^2",
    ),
    "frac(frac(a; (b)); c) + rate'": (
        r"\frac{\frac{a}{(b)}}{c} + \mathrm{rate}'",
        'frac(frac(a, (b)), c) + "rate"\\\'',
        "((a)/((b)))/(c) + rate'",
    ),
    "[0; 2) é #": (r"[0; 2) \text{é} \#", r'\[0; 2\) "é" \#', "[0; 2) é #"),
}


@pytest.mark.parametrize("text", FORMULAS)
def test_a_formula_in_three_notations(text: str) -> None:
    assert (latex(text), typst(text), plain(text)) == FORMULAS[text]


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (r"a_b", "_ outside mathematics"),
        (r"$a_b_c$", "two of _ on one atom"),
        (r"50 % of it", "% unescaped"),
        (r"\[ a", r"never closed"),
        (r"{\small a", "document is closed, and open is {"),
        (r"\begin{tabular}{ll} a & b & c \\ \end{tabular}", "a row of tabular has 3 cells, not 2"),
        (r"\[\begin{bmatrix}1&2\\3\end{bmatrix}\]", "a row of bmatrix has 1 cells, not 2"),
        (r"\foo", r"an unknown command \foo"),
        (r"\alpha", r"\alpha outside mathematics"),
        ("$a −$", "(2212) is not in the encoding"),
        ("see \\ref{x}", "refers to {'x'}"),
    ],
)
def test_the_reader_finds_what_is_wrong(wrong: str, said: str) -> None:
    document = "\\documentclass{article}\n\\begin{document}\n" + wrong + "\n\\end{document}\n"
    assert any(said in problem for problem in problems(document)), problems(document)


def test_a_long_table_is_in_parts_with_its_heads_and_each_row_once() -> None:
    sheet = ReportSheet("Long")
    sheet.table(["row", "value"], [[f"r{k}", f"{k}"] for k in range(LONGEST + 1)], "caption", total=True)
    text = latex_text(sheet)
    assert text.count(r"\begin{tabular}{ll}") == text.count(r"row & value \\") == 2
    assert [text.count(f"r{k} & {k} ") for k in range(LONGEST + 1)] == [1] * (LONGEST + 1)
    assert text.count(r"\midrule") == 3
    assert f"\\midrule\nr{LONGEST} & " in text
