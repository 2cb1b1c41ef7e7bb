r"""Formulas in one small notation, written as typst, LaTeX or plain text.

`F_{12}`, `x^{2}`, Greek letters and functions by name, `"lbf·in"` for upright text, `frac(a; b)`.

>>> plain('F_{I2} = -frac(W; g) a_{G} cdot 3 "lbf"')
'F_I2 = −(W)/(g) a_G · 3 lbf'
>>> latex('theta_{3} = 20.92 deg')
'\\theta_{\\mathrm{3}} = 20.92 {}^\\circ'
>>> typst('F_{12x} cos theta')
'F_"12x" cos theta'
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import NamedTuple


class NotatedName(NamedTuple):
    """A name in the three notations."""

    typst: str
    latex: str
    plain: str


_GREEK = (
    "alpha α, beta β, gamma γ, delta δ, theta θ, lambda λ, psi ψ, omega ω, phi φ, mu μ, pi π, eta η, "
    "sigma σ, tau τ"
)

WORDS: dict[str, NotatedName] = {
    **{name: NotatedName(name, "\\" + name, sign) for name, sign in map(str.split, _GREEK.split(","))},
    **{name: NotatedName(name, "\\" + name, name) for name in ("cos", "sin", "tan", "arcsin", "arctan")},
    "sum": NotatedName("sum", "\\sum", "Σ"),
    "cdot": NotatedName("dot.c", "\\cdot", "·"),
    "times": NotatedName("times", "\\times", "×"),
    "deg": NotatedName("degree", "{}^\\circ", "°"),
    "dot": NotatedName("dot", "\\dot", "d/dt "),
    "quad": NotatedName("quad", "\\quad", "   "),
    "sqrt": NotatedName("sqrt", "\\surd", "√"),
    "angle": NotatedName("angle", "\\angle", "∠"),
}

_TOKEN = re.compile(r'"[^"]*"|[_^]\{[^}]*\}|frac\(|[^\W\d_]+|\d[\d.]*(?:e[−+-]?\d+)?|\s+|.', re.DOTALL)
"""Names are the user's: letters of any script, and signs that mean something in a notation, are written as they are."""


def _write(text: str, atom: Callable[[str], str], fraction: Callable[[str, str], str]) -> str:
    out, tokens = [], _TOKEN.findall(text)
    while tokens:
        token = tokens.pop(0)
        if token == "frac(":
            above, below = _inside(tokens)
            out.append(fraction(_write(above, atom, fraction), _write(below, atom, fraction)))
        else:
            out.append(atom(token))
    return re.sub(r" {2,}(?! )", " ", "".join(out)).strip()


def _inside(tokens: list[str]) -> tuple[str, str]:
    """The two parts of a fraction up to its closing bracket, which is taken off."""
    parts, depth = ["", ""], 1
    place = 0
    while tokens:
        token = tokens.pop(0)
        depth += (token.endswith("(")) - (token == ")")
        if not depth:
            break
        if token == ";" and depth == 1:
            place = 1
        else:
            parts[place] += token
    return parts[0].strip(), parts[1].strip()


def typst(text: str) -> str:
    """As typst's mathematics."""

    def atom(token: str) -> str:
        if token[0] == '"' and len(token) > 1:
            return f" upright({_typst_string(token[1:-1])})"
        if token[0] in "_^" and len(token) > 1:
            return f"{token[0]}{_typst_string(token[2:-1])}"
        if token in WORDS:
            return WORDS[token].typst
        if token[0].isalpha() and (len(token) > 1 or not token.isascii()):
            return _typst_string(token)
        if token[0].isdigit():
            number, power = _power_of_ten(token)
            return f"{number} dot.c 10^({power})" if power else number
        if token in loose:
            return "\\" + token
        return _TYPST.get(token, token)

    loose = {sign for a, b in ("()", "[]") if text.count(a) != text.count(b) for sign in (a, b)}
    return _write(text, atom, lambda a, b: f"frac({a}, {b})")


_TYPST = {"−": "-", "·": "dot.c"} | {sign: "\\" + sign for sign in "#/$&_^\\\"~`{}<>|'"}


def _power_of_ten(token: str) -> tuple[str, int]:
    """A number and the power of ten behind it, 0 for none."""
    number, _, power = token.replace("−", "-").partition("e")
    return number, int(power or 0)


def _typst_string(text: str) -> str:
    """Text in quotes."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def latex(text: str) -> str:
    """As LaTeX's mathematics."""

    def atom(token: str) -> str:
        if token[0] == '"' and len(token) > 1:
            words = (_latex_text(word) for word in token[1:-1].split(" "))
            return r"\,\mathrm{" + r"\ ".join(words) + "}"
        if token[0] in "_^" and len(token) > 1:
            return rf"{token[0]}{{\mathrm{{{_latex_text(token[2:-1])}}}}}"
        if token in WORDS:
            return WORDS[token].latex
        if token[0].isalpha() and len(token) > 1:
            return rf"\mathrm{{{_latex_text(token)}}}"
        if token[0].isdigit():
            number, power = _power_of_ten(token)
            return rf"{number} \cdot 10^{{{power}}}" if power else number
        return {"·": r"\cdot ", "'": "'"}.get(token) or _latex_text(token)

    return _write(text, atom, lambda a, b: rf"\frac{{{a}}}{{{b}}}")


_LETTERS = """
alpha α, beta β, gamma γ, delta δ, epsilon ε, zeta ζ, eta η, theta θ, iota ι, kappa κ, lambda λ,
mu μ, mu µ, nu ν, xi ξ, pi π, rho ρ, sigma σ, tau τ, phi φ, chi χ, psi ψ,
omega ω, Gamma Γ, Delta Δ, Theta Θ, Lambda Λ, Xi Ξ, Pi Π, Sigma Σ, Phi Φ, Psi Ψ, Omega Ω,
pm ±, times ×, le ≤, ge ≥, approx ≈, surd √, angle ∠, parallel ∥, perp ⊥, to →, cdot ·
"""

LATEX_SIGNS = {sign: "\\" + name for name, sign in map(str.split, _LETTERS.split(","))}
"""Signs that LaTeX has in its mathematics only, and their commands."""

_LATEX = {sign: f"{command} " for sign, command in LATEX_SIGNS.items()} | {
    "∓": r"\mp ", "·": r"{\cdot}", "²": "^2", "³": "^3", "°": r"^\circ", "−": "-", "'": "{}'", "\\": r"\backslash ",
    "~": r"\sim ", "^": r"\hat{}", "–": r"\text{--}", **{sign: "\\" + sign for sign in "_%&#${}"},
}  # fmt: skip


def _latex_text(text: str) -> str:
    """Text within mathematics; letters beyond ASCII only in text."""
    return "".join(_LATEX.get(c, c if c.isascii() else rf"\text{{{c}}}") for c in text)


def plain(text: str) -> str:
    """As plain text."""

    def atom(token: str) -> str:
        if token[0] == '"' and len(token) > 1:
            return f" {token[1:-1]}"
        if token[0] in "_^" and len(token) > 1:
            return f"{token[0]}{token[2:-1]}" if token[0] == "_" else f"^{token[2:-1]}"
        return WORDS[token].plain if token in WORDS else token.replace("-", "−")

    return _write(text, atom, lambda a, b: f"({a})/({b})")


def bracket_negative(number: str) -> str:
    """A number behind an operator: a negative one in brackets.

    >>> bracket_negative("−3.5"), bracket_negative("2")
    ('(−3.5)', '2')
    """
    return f"({number})" if number.startswith("−") else number


def write_mixed(text: str, formula: Callable[[str], str], words: Callable[[str], str]) -> list[str]:
    """Words and the formulas between dollar signs, each written; a dollar sign without its other is a word."""
    parts = text.split("$")
    if not len(parts) % 2:
        return [words(text)]
    return [formula(p) if n % 2 else words(p) for n, p in enumerate(parts)]
