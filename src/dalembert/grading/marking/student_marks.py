"""The marks of one student."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

NAMED = ("named", "sign", "unit", "datum", "concept")
"""Outcomes of a mistake that is named: a slip, a sense, a unit, one datum of the problem, a concept."""


class Mark(NamedTuple):
    """One required figure: as given, as computed, the outcome (a word of the rubric's shares; ``open``: not judged;
    ``waits``: for the teacher to read), the sentence, the marks, the largest marks, and its line."""

    quantity: str
    given: str
    computed: str
    outcome: str
    sentence: str
    marks: float
    most: float
    line: int = 0


@dataclass
class StudentMarks:
    """A student's marks, and sentences on unreadable or superfluous parts of the sheet."""

    student: str
    variant: str
    file: str
    marks: list[Mark] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)

    @property
    def total(self) -> float:
        """Marks of all figures."""
        return sum(m.marks for m in self.marks)

    @property
    def most(self) -> float:
        """Largest possible marks; figures that are not judged have none."""
        return sum(m.most for m in self.marks)

    @property
    def waiting(self) -> int:
        """Number of figures that a teacher must read."""
        return sum(m.outcome == "waits" for m in self.marks)


def named_mistakes(students: Sequence[StudentMarks]) -> list[tuple[str, int]]:
    """The mistakes that were named with how many students made them, those of most first."""
    named = [
        {m.sentence for m in s.marks if m.outcome in ("named", "sign", "unit", "datum", "concept")}
        for s in students
    ]
    return Counter(sentence for some in named for sentence in sorted(some)).most_common()
