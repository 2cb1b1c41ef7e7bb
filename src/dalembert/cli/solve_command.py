"""`dalembert solve`: a file analysed, printed and written."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Annotated, Literal

from dalembert.cli.answer_files import NO_RESULT, ResultOutputs
from dalembert.cli.documents.position_argument import position_alone, solve_at
from dalembert.cli.options import AT_FIRST, ModelFile, OfAt, flag, with_help
from dalembert.progress import progress

if TYPE_CHECKING:
    from dalembert.analysis import Result


EXAMPLES = """Examples:
  dalembert solve four_bar.yaml
  dalembert solve four_bar.yaml --static --units si
  dalembert solve four_bar.yaml --positions 360 --csv turn.csv --xlsx turn.xlsx
  dalembert solve engine.yaml --at 60deg
  dalembert solve engine.yaml --at "max effort.O2"
  dalembert solve four_bar.yaml --json - --units file"""


def solve(
    file: ModelFile,
    /,
    *,
    method: Annotated[
        Literal["matrix", "steps", "superposition", "virtual-work", "fixed-point"],
        with_help(
            "Method; steps solves for one unknown at a time, as on paper; fixed-point shows the textbook iteration "
            "for friction at the first position."
        ),
    ] = "matrix",
    other_solutions: Annotated[
        bool,
        flag(
            "Search for other solutions of the friction equations where the physical one may not be unique."
        ),
    ] = False,
    every: Annotated[bool, flag("Print every position.", "--all")] = False,
    of: OfAt = AT_FIRST,
    out: ResultOutputs = NO_RESULT,
) -> int:
    """Solve FILE and print drives, efforts, reactions and motion, in the units of the file."""
    out.check(file)
    m = of.load(file)
    sentence = ""
    with progress(f"Solving {file}"):
        result, at = solve_at(m, of.at, of.static, of.positions)
        if of.at is not None:
            result, sentence = position_alone(result, at)
    shown, more = by_method(method, result, out.printed_units)
    if other_solutions:
        from dalembert.cli.method_text import other_solutions_text

        more = "\n\n".join(filter(None, (more, other_solutions_text(result, out.printed_units))))
    if sentence:
        print(sentence, end="\n\n", file=sys.stderr if out.prints_data else sys.stdout)
    out.deliver(shown, other_solutions, more=more, axes=out.axes, every=every)
    return 0 if result.ok.all() else 1


def by_method(method: str, result: Result, units: Literal["SI", "file"]) -> tuple[Result, str]:
    """The answer as the method finds it, and what it shows besides."""
    if method == "matrix":
        return result, ""
    from dalembert.cli.method_text import fixed_point_text, superposition_text, virtual_work_answer

    if method == "fixed-point":
        return result, fixed_point_text(result)

    if method == "steps":
        from dalembert.analysis.methods.solved.solution_by_steps import solution

        return result, solution(result).text(units)
    if method == "virtual-work":
        return virtual_work_answer(result, units)
    return result, superposition_text(result, units)


COMMANDS = {solve: EXAMPLES}
"""Function of the command -> the examples under its help."""
