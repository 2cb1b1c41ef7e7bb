"""Context of a report: the result, the position, the reader's notation."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from dalembert.analysis.methods.solved.step_choice import Choice
from dalembert.views.notation import Figures, Notation, Shown

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.reports.sections.as_written import AsWritten

Method = Literal["steps", "matrix", "graphical", "superposition", "virtual-work"]
METHODS: tuple[Method, ...] = ("steps", "matrix", "graphical", "superposition", "virtual-work")


@dataclass(frozen=True)
class ReportContext:
    """Context of a report: the result, the position, the reader's notation, and the methods shown.

    ``choice``: what the reader chooses of the steps, with the joint to take moments about.
    ``question``: only the given data are shown, without computed values; ``written``: as the file states them.
    """

    r: Result
    k: int
    shown: Shown
    methods: tuple[Method, ...] = METHODS
    choice: Choice = field(default_factory=Choice)
    notation: Notation = field(default_factory=Notation)
    question: bool = False
    written: AsWritten | None = None

    @property
    def about(self) -> str:
        """The joint to take moments about, where the reader names one."""
        return self.choice.about if isinstance(self.choice.about, str) else ""


def as_formula(sign: str) -> str:
    """A sign of a drawing as a formula: only its index is formatted in a drawing."""
    return f"${sign}$" if "_{" in sign or len(sign) == 1 else sign


def figure(shown: Figures, kind: str, value: float, words: str = "") -> str:
    """A number of a formula with its unit, and words behind it."""
    return f'{shown.number(kind, value)} "{shown.unit(kind)}{words}"'


def in_ground(c: ReportContext) -> str:
    """Note for a table in ground axes where the equations are in link axes."""
    return ", in ground axes" if c.notation.axes == "link" else ""
