"""The methods on paper that a result has by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from dalembert.analysis.methods.solved.solution_by_steps import PaperSolution
    from dalembert.analysis.result.position_lookup import PositionChoice


class OnPaper:
    """The part of a result that is solved by hand."""

    def steps(
        self,
        at: PositionChoice = None,
        begin: str = "",
        about: str | tuple[float, ...] = "",
        along: float | str = 0,
    ) -> PaperSolution:
        """The solution of one position as on paper, one unknown after the other: `da.solution`."""
        from dalembert.analysis.methods.solved.solution_by_steps import solution

        result: Any = self
        return solution(result, at, begin, about, along)
