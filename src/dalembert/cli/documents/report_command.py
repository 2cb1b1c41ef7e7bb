"""`dalembert report`: a file analysed and worked out on paper."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from dalembert.cli.documents.position_argument import announce, solve_at
from dalembert.cli.options import AS_USUAL, AT_FIRST, Force, ModelFile, OfAt, Style, flag, output, with_help
from dalembert.progress import progress
from dalembert.saving import check_new


def report(
    file: ModelFile,
    /,
    *,
    output: Annotated[
        Path, output("File to write; its extension selects the format: .pdf, .html, .tex or .txt.")
    ],
    method: Annotated[
        list[Literal["steps", "matrix", "graphical", "superposition", "virtual-work"]] | None,
        Parameter(
            negative=(), help="Methods to show, one or more (default: all); graphical only in the plane."
        ),
    ] = None,
    design: Annotated[
        bool,
        flag(
            "Write the design report instead: over the cycle, for each part that the file has data for, a verdict "
            "with its margin and the worst position."
        ),
    ] = False,
    style: Style = AS_USUAL,
    about: Annotated[str, with_help("Joint about which moments are taken, for links that have it.")] = "",
    begin: Annotated[str, with_help("Link whose forces are solved first, as far as possible.")] = "",
    along: Annotated[
        str, with_help("Angle of the first axis along which forces are summed, e.g. 30deg.")
    ] = "0",
    of: OfAt = AT_FIRST,
    force: Force = False,
) -> int:
    """Write the worked solution of FILE, step by step, with its drawings; or its design report."""
    from dalembert.reports import check_format
    from dalembert.reports import report as worked_out

    check_format(output)
    check_new(output, force)
    if design:
        return design_report(file, output, of, style, force)
    with progress(f"Working out {file}"):
        result, at = solve_at(of.load(file), of.at, of.static, of.positions)
        worked_out(result, at, method, style.notation(), about, begin, along).save(output, force)
        return announce(result, output, at)


def design_report(file: Path, output: Path, of: OfAt, style: Style, force: bool) -> int:
    """Write the design report, over a full turn where the file has one position of a drive that moves."""
    from dalembert.machine.whole_cycle import solved_over_a_turn
    from dalembert.reports import report as written

    with progress(f"Solving {file}"):
        result = solved_over_a_turn(of.load(file), of.static, of.positions)
    made = written(result, of.at, notation=style.notation(), design=True)
    with progress(f"Writing {output}"):
        made.save(output, force)
    return announce(result, output, of.at)


COMMANDS: dict[Callable[..., int], str] = {
    report: """Examples:
  dalembert report four_bar.yaml -o four_bar.pdf
  dalembert report four_bar.yaml -o four_bar.html --method virtual-work --names
  dalembert report rssr.yaml -o rssr.pdf --at 30deg
  dalembert report press.yaml --design -o press.pdf
  dalembert report engine.yaml -o engine.tex --at 60deg --units si --decimals 2""",
}
"""Function of the command -> the examples under its help."""
