"""Aims and conditions as texts, `peak effort.O2` and `transmission.B >= 33 deg`, or as Python functions of a result."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import NamedTuple

from dalembert.errors import ModelError
from dalembert.model.quantities.expression_trees import REDUCTIONS
from dalembert.optimization.cycle_expressions import has_quantities, has_reductions, is_single, whole_call
from dalembert.wording import closest

KERNEL = ("peak", "mean", "rms", "norm8")
"""Reductions of an aim inside the kernel; the others, and sums of some, follow from the values at all positions."""


class Aim(NamedTuple):
    """Objective to minimize: a reduction of an expression of outputs, or an expression of reductions and no word."""

    word: str
    of: str

    @property
    def text(self) -> str:
        """The aim as it is written."""
        return f"{self.word} {self.of}".strip()

    @property
    def number(self) -> str:
        """The aim as an expression with one value for a cycle."""
        return f"{self.word}({self.of})" if self.word else self.of

    @property
    def plain(self) -> bool:
        """True if the kernel reduces it."""
        return bool(self.word) and not has_reductions(self.of)


class Constraint(NamedTuple):
    """Constraint at every position: an expression that must not be negative."""

    text: str
    margin: str

    @property
    def plain(self) -> bool:
        """True if the kernel computes it at every position."""
        return not has_reductions(self.margin)


def parse_aim(text: str) -> Aim:
    """An aim from its text; without a reduction, the peak is meant.

    >>> parse_aim("rms shaking_force.x"), parse_aim("effort.O2").word
    (Aim(word='rms', of='shaking_force.x'), 'peak')
    >>> parse_aim("peak(effort.O2) + 0.1 m*range(reaction.A.x)").word
    ''
    """
    word, of = _first_word(text)
    if not of:
        raise ModelError(f"{text!r} is not an aim", "write one like peak effort.O2")
    if not word:
        word, of = ("", of) if is_single(of) else ("peak", of)
        call, inner = whole_call(of)
        word, of = (call, inner) if call in KERNEL else (word, of)
    return Aim(word, of) if word in KERNEL else Aim("", f"{word}({of})" if word else of)


def _first_word(text: str) -> tuple[str, str]:
    """The reduction at the beginning of a text, empty if none, and the expression after it."""
    word, _, rest = text.strip().partition(" ")
    if word in REDUCTIONS and not rest.lstrip().startswith("("):
        if has_reductions(rest):
            what = f"{text.strip()!r} has a reduction beside {word!r}, and it is open where this one ends"
            raise ModelError(what, f"write {word}(...), with brackets")
        return word, rest.strip()
    if re.fullmatch(r"[a-z]\w*", word) and re.match(r"[a-z]+\.", rest.strip()):
        raise ModelError(
            f"{text!r} begins with {word!r}, which is not an aim", closest(word, list(REDUCTIONS))
        )
    return "", text.strip()


def parse_condition(text: str) -> Constraint:
    """A condition at every position: two expressions with >= or <= between. A reduction, `range(slide.G)` or `rms X`,
    is one number of the cycle; `peak X` that is bounded above by one is bounded at every position, in both signs.

    >>> parse_condition("transmission.B >= 33 deg").margin
    '(transmission.B) - (33 deg)'
    >>> parse_condition("peak effort.O2 <= 3 N*m").margin
    '(3 N*m) - (abs(effort.O2))'
    >>> parse_condition("range(slide.G) >= 60 mm").margin
    '(range(slide.G)) - (60 mm)'
    """
    parts = re.split(r"\s*(>=|<=|>|<|=)\s*", _within_brackets(text.strip()))
    if len(parts) != 3 or parts[1] == "=" or not (parts[0] and parts[2]):
        raise ModelError(
            f"{text!r} is not a condition", "write one with a single >= or <=, like transmission.B >= 33 deg"
        )
    left, sign, right = (part.translate(SHOWN) for part in parts)
    big, small = map(_side, (left, right) if sign[0] == ">" else (right, left))
    above = _at_every_position(big, {"least": ""}) if not has_quantities(small) else big
    below = _at_every_position(small, {"peak": "abs", "greatest": ""}) if not has_quantities(big) else small
    return Constraint(text.strip(), f"({above}) - ({below})")


HIDDEN, SHOWN = str.maketrans("<>=", "\x01\x02\x03"), str.maketrans("\x01\x02\x03", "<>=")
"""Signs of comparisons within brackets, which do not divide a condition."""


def _within_brackets(text: str) -> str:
    """The text with the comparisons within its brackets hidden."""
    out, depth = "", 0
    for sign in text:
        depth += (sign == "(") - (sign == ")")
        out += sign.translate(HIDDEN) if depth > 0 else sign
    return out


def _side(text: str) -> str:
    """One side of a condition, its reduction with brackets."""
    word, of = _first_word(text)
    return f"{word}({of})" if word else of


def _at_every_position(text: str, functions: Mapping[str, str]) -> str:
    """A reduction that is bounded by one number as what is bounded so at every position."""
    word, inner = whole_call(text)
    if word not in functions:
        return text
    return f"{functions[word]}({inner})" if functions[word] else inner
