"""The solved solution as an answer: printed, in a notebook, in a report, and a row a step in every format."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.methods.solved.carried_out import ForceSteps, SolvedStep, solved_forces
from dalembert.analysis.methods.solved.step_choice import Choice, read_choice
from dalembert.analysis.result.position_lookup import PositionChoice, has_forces, position_at
from dalembert.answer.answer import Worked
from dalembert.answer.column import WORD, Axes, Column, Scale, UnitChoice
from dalembert.arrays import Array, Tree
from dalembert.errors import AnalysisError

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism
    from dalembert.reports.sheet import ReportSheet
    from dalembert.views.notation import Notation


@dataclass(eq=False)
class PaperSolution(Worked):
    """The solution of one position as on paper; ``forces.steps`` has the numbers, ``position`` counts from 0.

    >>> import dalembert as da
    >>> s = da.solution(da.dynamics(da.four_bar()), at=1)
    >>> s.position, len(s.steps)
    (0, 10)
    """

    ROWS = "steps"

    result: Result
    position: int
    choice: Choice
    forces: ForceSteps

    @property
    def mechanism(self) -> Mechanism:
        """The description."""
        return self.result.mechanism

    @property
    def steps(self) -> list[SolvedStep]:
        """The steps of the forces in order, the check last."""
        return self.forces.steps

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """One row for each number: step, links, equation, of what, which part; force or moment; and the answer's."""
        rows = [(s, f, v) for s in self.steps for f, v in zip(s.finds, s.right, strict=True)]
        equations = [f"{s.equation.kind} {s.equation.name}".strip() for s, _, _ in rows]
        yield Column("step", WORD, [s.number for s, _, _ in rows])
        yield Column("links", WORD, [" and ".join(s.links) for s, _, _ in rows])
        yield Column("equation", WORD, equations)
        yield Column("of", WORD, [self.forces.equations.unknowns[f.of].name for _, f, _ in rows])
        yield Column("part", WORD, [f.mark for _, f, _ in rows])
        turning = np.array([f.turning for _, f, _ in rows], bool)
        for name, numbers in (("", [f.value for _, f, _ in rows]), (" computed", [v for _, _, v in rows])):
            values: Array = np.array(numbers, float)
            yield Column(f"force{name}", "force", np.where(turning, np.nan, values))
            yield Column(f"moment{name}", "moment", np.where(turning, values, np.nan))

    def record(self, to: Scale) -> Tree:
        """True if each number has an equation with no other unknown; and what equilibrium leaves open."""
        return {"single_unknowns": self.forces.single, "open": [u.name for u in self.forces.open]}

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterator[str]:
        """The steps as text."""
        yield self.text(units)

    def text(self, units: UnitChoice = "file", **choice: Any) -> str:
        """The steps without drawings."""
        from dalembert.reports.working import steps_text

        return steps_text(self, units)

    def sheet(self, notation: Notation | None = None) -> ReportSheet:
        """The steps with their free bodies."""
        from dalembert.reports.working import steps_sheet

        return steps_sheet(self, notation)

    def _repr_html_(self) -> str:
        return self.report()._repr_html_()


def solution(
    r: Result,
    at: PositionChoice = None,
    begin: str = "",
    about: str | tuple[float, ...] = "",
    along: float | str = 0,
) -> PaperSolution:
    """The solution of one position as on paper: one free body, one equation, one unknown number at a time.

    ``begin``: the link to begin with; ``about``: the joint, or the point (m), to take moments about where this is
    possible; ``along``: angle of the first axis of sums of forces (rad, or `30 deg`). The numbers come from the steps
    alone; each has the answer's beside it. Raises AnalysisError where a position has no forces.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> steps = da.solution(da.dynamics(da.load(examples()["four_bar"]))).steps
    >>> [(s.links[0], s.equation.kind, s.equation.name) for s in steps[:2]], f"{steps[4].finds[0].value:.3f} N m"
    ([('rocker', 'moments', 'O4'), ('coupler', 'moments', 'A')], '27.482 N m')
    """
    choice, k = read_choice(r, begin, about, along), position_at(r, at)
    if not has_forces(r, k):
        raise AnalysisError(f"position {k + 1} has no forces: {r.status[k]}, {r.reasons[k]}")
    return PaperSolution(r, k, choice, solved_forces(r, k, choice))
