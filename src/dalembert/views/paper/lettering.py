"""Width of a text: advance widths of DejaVu Sans, the widest of the common sans-serif fonts.

Boxes measured with them also hold the text in the fonts that a browser, a PDF or matplotlib may substitute.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import NamedTuple

Box = tuple[float, float, float, float]

SMALL = 0.72
"""Relative size of superscripts and subscripts."""

_ASCII = (
    "318 401 460 838 636 950 780 275 390 390 500 838 318 361 318 337 636 636 636 636 636 636 636 636 636 636 337 337 "
    "838 838 838 531 1000 684 686 698 770 632 575 775 752 295 295 656 557 863 748 787 603 787 695 635 611 732 684 989 "
    "685 611 685 390 337 390 838 500 500 613 635 550 635 615 352 635 634 278 278 579 278 974 634 612 635 635 411 521 "
    "392 634 592 818 592 592 525 636 337 636 838"
)
_WIDTHS = {chr(32 + k): int(w) / 1000 for k, w in enumerate(_ASCII.split())}
_OTHER = 0.75
_BEYOND = {
    "·": 0.318, "²": 0.401, "³": 0.401, "°": 0.5, "−": 0.838, "–": 0.5, "—": 1.0, "→": 0.838, "∠": 0.896, "∥": 0.5,
    "⊥": 0.838, "α": 0.659, "θ": 0.612, "ω": 0.837, "φ": 0.66, "μ": 0.636, "δ": 0.612, "Σ": 0.632, "Δ": 0.684,
}  # fmt: skip


class Glyphs(NamedTuple):
    """Letters at one level: 0 on the line, -1 lowered, 1 raised."""

    text: str
    level: int


def pieces(text: str) -> list[Glyphs]:
    """A text split at `_{...}` and `^{...}`.

    >>> pieces("F_{12} = 3")
    [Glyphs(text='F', level=0), Glyphs(text='12', level=-1), Glyphs(text=' = 3', level=0)]
    """
    out: list[Glyphs] = []
    for plain, sign, small in re.findall(r"([^_^]+|[_^](?!\{))|([_^])\{([^}]*)\}", text):
        if plain and out and out[-1].level == 0:
            out[-1] = Glyphs(out[-1].text + plain, 0)
        elif plain:
            out.append(Glyphs(plain, 0))
        elif small:
            out.append(Glyphs(small, -1 if sign == "_" else 1))
    return out


def plain(text: str) -> str:
    """The text without markup: F_12."""
    return re.sub(r"([_^])\{([^}]*)\}", r"\1\2", text)


def letters_width(letters: str) -> float:
    """Width of letters over their size."""
    return sum(_WIDTHS.get(c) or _BEYOND.get(c, _OTHER) for c in letters)


def text_width(text: str, size: float) -> float:
    """Width in mm of a text of a size in mm."""
    return size * _extent(text)[0]


@lru_cache(4096)
def _extent(text: str) -> tuple[float, float]:
    """Width of a text over its size, and how far it reaches below its middle: the same labels are measured often."""
    some = pieces(text)
    width = sum(letters_width(p.text) * (SMALL if p.level else 1.0) for p in some)
    return width, 0.66 if any(p.level < 0 for p in some) else 0.56


BOLD = 1.12
"""Width of bold letters over that of plain ones."""


def text_box(at: tuple[float, float], text: str, size: float, anchor: str, bold: bool = False) -> Box:
    """(left, bottom, right, top) of a text with its middle height at a point."""
    relative, below = _extent(text)
    width = size * relative * (BOLD if bold else 1.0)
    left = at[0] - {"start": 0.0, "middle": 0.5, "end": 1.0}[anchor] * width
    return (left, at[1] - size * below, left + width, at[1] + 0.52 * size)


FIXED = "\u00a0"
"""A non-breaking space."""


def unbroken(text: str) -> str:
    """A text that stays on one line."""
    return text.replace(" ", FIXED)


def break_lines(text: str, size: float, width: float) -> list[str]:
    """A text in lines no wider than a width in mm; non-breaking spaces keep words together.

    >>> break_lines("one two", 1.0, 3.0), break_lines(unbroken("one two"), 1.0, 3.0)
    (['one', 'two'], ['one two'])
    """
    lines: list[str] = []
    for word in filter(None, text.split(" ")):
        longer = f"{lines[-1]} {word}" if lines else word
        if lines and text_width(longer.replace(FIXED, " "), size) <= width:
            lines[-1] = longer
        else:
            lines.append(word)
    return [line.replace(FIXED, " ") for line in lines]
