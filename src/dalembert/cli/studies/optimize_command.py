"""`dalembert optimize`: the best design within bounds and conditions."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from dalembert.cli.options import Force, with_help
from dalembert.cli.options import output as output_to

OPTIMIZE = """Examples:
  dalembert optimize optimize.yaml
  dalembert optimize optimize.yaml -o best.yaml --report best.html

optimize.yaml:
  model: press.yaml
  vary:
    links.ground.points.O4.0: [280 mm, 360 mm]
    links.crank.mass: [1 kg, 3 kg, 0.5 kg]      (low, high, step)
  least: peak effort.O2
  where: [transmission.B >= 40 deg]

Exit status: 0 optimum computed; 1 no design keeps every condition; 2 the file is wrong."""


def optimize(
    file: Annotated[Path, with_help("File with model, vary, least and where: YAML, JSON or TOML.")],
    /,
    *,
    output: Annotated[
        Path | None, output_to("Write the model file of the best design: .yaml, .json, .toml.")
    ] = None,
    report: Annotated[
        Path | None, with_help("Write a report comparing before and after: .html, .pdf, .tex or .txt.")
    ] = None,
    force: Force = False,
) -> int:
    """Optimise numbers of a model file within bounds and constraints."""
    from dalembert.optimization.optimize_file import optimize_file
    from dalembert.reports import report as write_report
    from dalembert.saving import check_new

    for file_to_write in filter(None, (output, report)):
        check_new(file_to_write, force)
    found = optimize_file(file)
    print(found)
    if output is not None:
        found.save(output, force)
    if report is not None:
        write_report(found).save(report, force)
    return 0 if found.feasible else 1


COMMANDS = {optimize: OPTIMIZE}
"""Function of the command -> the examples under its help."""
