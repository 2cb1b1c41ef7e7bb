"""The rubric: marks of each quantity, and the share that a figure keeps for each kind of error."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from dalembert.errors import Locator, ModelError
from dalembert.grading.answer_sheet import KNOWN
from dalembert.grading.marking.student_marks import NAMED, Mark
from dalembert.grading.tolerance import percent
from dalembert.wording import closest, quote_value

SHARES = {
    "right": 1.0,
    "follow_through": 1.0,
    "repeated": 1.0,
    "rounding": 0.875,
    "sign": 0.5,
    "unit": 0.5,
    "named": 0.5,
    "may_be": 0.25,
    "datum": 0.75,
    "concept": 0.5,
    "part": 0.5,
    "unknown": 0.0,
    "missing": 0.0,
}
"""Share of the marks that a figure keeps: right; right for the student's earlier wrong figure; wrong by a slip already
penalised in an earlier figure of the sheet; nearly right; wrong by a sense, a unit, another slip that is named; perhaps
by a mistake that is called possible; wrong by one datum of the problem (a load, a mass, a length), or by a concept
(no gravity, no inertia), each figure that it touches; a part of the required figure (the size of a force alone); wrong
without explanation; missing."""

WAITING = "unreadable"
"""A cell without a reading, which waits for the teacher unless the rubric gives it a share."""


@dataclass(frozen=True)
class Rubric:
    """Marks by quantity, shares by outcome, shares by words in the sentence of a mistake, and a tolerance.

    >>> Rubric().marks_of("effort"), Rubric().share("sign", "the sense is opposite")
    (1.0, 0.5)
    """

    marks: Mapping[str, float] = field(default_factory=dict)
    shares: Mapping[str, float] = field(default_factory=lambda: SHARES)
    mistakes: Mapping[str, float] = field(default_factory=dict)
    tolerance: str | None = None
    cap: float = 0.5

    def marks_of(self, quantity: str) -> float:
        """Marks of a figure of a quantity."""
        return self.marks.get(quantity, self.marks.get("default", 1.0))

    def share(self, kind: str, sentence: str) -> float:
        """Share of its marks that a figure keeps."""
        if kind in NAMED:
            for words, share in self.mistakes.items():
                if words.lower() in sentence.lower():
                    return share
        return self.shares[kind]

    def capped(self, marks: Sequence[Mark]) -> list[Mark]:
        """Marks of a sheet with what one mistake costs over all its figures at most ``cap`` of the sheet, and at least
        half a figure."""
        of = sum(m.most for m in marks)
        lost: dict[str, float] = {}
        for m in marks:
            if m.outcome in ("datum", "concept") and not self._stated(m.sentence):
                lost[m.sentence] = lost.get(m.sentence, 0.0) + m.most - m.marks
        factor = {
            words: min(max(cost, 0.5 * min(m.most for m in marks if m.sentence == words)), self.cap * of)
            / cost
            for words, cost in lost.items()
            if cost
        }
        return [
            m._replace(marks=m.most - (m.most - m.marks) * factor[m.sentence])
            if m.outcome in ("datum", "concept") and m.sentence in factor
            else m
            for m in marks
        ]

    def _stated(self, sentence: str) -> bool:
        """True if the rubric has a separate share for a mistake."""
        return any(words.lower() in sentence.lower() for words in self.mistakes)


KEYS = ("marks", "share", "mistakes", "tolerance", "cap")


def load_rubric(path: str | Path) -> Rubric:
    """The rubric of a YAML, JSON or TOML file; ModelError with file and line."""
    from dalembert.model.files.model_files import read_file

    tree, source = read_file(path)
    return read_rubric(tree, source)


def read_rubric(tree: object, source: Locator | None = None) -> Rubric:
    """The rubric of a tree: marks, share, mistakes, tolerance; missing keys have their defaults.

    >>> read_rubric({"marks": {"effort": 4}, "share": {"sign": 0.75}}).shares["unit"]
    0.5
    """
    try:
        if not isinstance(tree, Mapping):
            raise ModelError("the rubric is not a mapping", "write marks: {effort: 4, reaction: 2}")
        for name in tree:
            if name not in KEYS:
                remedy = closest(str(name), [*KEYS])
                raise ModelError(f"unknown key {name!r}", remedy, (name,))
        if tree.get("tolerance") is not None:
            percent(tree["tolerance"])
        points = _numbers(tree, "marks", [*KNOWN, "default"], 1e6)
        shares = _numbers(tree, "share", [*SHARES, WAITING], 1.0)
        if "named" in shares:  # of all named mistakes, where nothing else is said
            shares = {"datum": shares["named"], "concept": shares["named"]} | shares
        cap = _numbers({"cap": {"cap": tree.get("cap", 0.5)}}, "cap", None, 1.0)["cap"]
        known = _numbers(tree, "mistakes", None, 1.0)
        return Rubric(points, SHARES | shares, known, tree.get("tolerance"), cap)
    except ModelError as error:
        raise error.at_source(source) from None


def _numbers(tree: Mapping[str, object], key: str, known: list[str] | None, most: float) -> dict[str, float]:
    entries = tree.get(key) or {}
    if not isinstance(entries, Mapping):
        raise ModelError(f"{key} is not a mapping", f"write {key}: {{NAME: NUMBER}}", (key,))
    for name, value in entries.items():
        if known is not None and name not in known:
            raise ModelError(f"{key} has no entry {name!r}", closest(str(name), known, 40), (key, name))
        number = isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
        if not number or not 0 <= value <= most:
            what = f"{quote_value(value)} is not a number from 0 to {most:g}"
            raise ModelError(what, "write one", (key, name))
    return {str(name): float(value) for name, value in entries.items()}
