"""Helpers for messages: quoting a value and proposing a name."""

from __future__ import annotations

import math
from collections.abc import Mapping


def quote_value(value: object) -> str:
    """A value as a message quotes it, cut when long."""
    if isinstance(value, Mapping):
        return "a mapping"
    if isinstance(value, (list, tuple)):
        return "a list" if len(value) else "an empty list"
    if value is None:
        return "nothing"
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return _number(value)
    plain = repr(value) if isinstance(value, str) else str(value).lower()
    return plain if len(plain) <= 60 else plain[:57] + "..."


def _number(value: int | float) -> str:
    if isinstance(value, int) and abs(value) > 10**15:
        digits = int(math.log10(abs(value)))
        while abs(value) >= 10**digits:
            digits += 1
        return f"a number of {digits} digits"
    return repr(value)


def closest(word: str, choices: list[str], most: int = 12) -> str:
    """The choice that is meant, or the list of them.

    >>> closest("rodd", ["crank", "rod"])
    "did you mean 'rod'?"
    """
    near = nearest(word, choices)
    if near:
        return f"did you mean {near!r}?"
    if len(choices) < 2:
        return f"the only one is {choices[0]!r}" if choices else "there is none"
    return f"choose among {', '.join(choices[:most])}" + (", ..." if len(choices) > most else "")


def nearest(word: str, choices: list[str]) -> str:
    """The choice that is meant; nothing where none is near.

    >>> nearest("pni", ["slider", "pin"]), nearest("Crank", ["crank"]), nearest("beam", ["crank"])
    ('pin', 'crank', '')
    """
    import difflib

    folded = {choice.lower(): choice for choice in reversed(choices)}
    near = difflib.get_close_matches(word.lower(), list(folded), 1, 0.7)
    if near:
        return folded[near[0]]
    same = [choice for key, choice in folded.items() if sorted(key) == sorted(word.lower())]
    return same[0] if same else ""
