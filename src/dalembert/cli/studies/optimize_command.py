"""`dalembert optimize`: the best design within bounds and conditions."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from dalembert.cli.answer_files import NO_LABELLED, LabelledOutputs
from dalembert.cli.options import AS_IN_FILE, Changes, with_help

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

least: [peak effort.O2, mass] of two aims gives their Pareto front.

Exit status: 0 optimum computed; 1 no design meets every condition; 2 error in the file."""


def optimize(
    file: Annotated[Path, with_help("File with model, vary, least and where: YAML, JSON or TOML.")],
    /,
    *,
    of: Changes = AS_IN_FILE,
    out: LabelledOutputs = NO_LABELLED,
) -> int:
    """Optimise numbers of a model file within bounds and constraints."""
    from dalembert.optimization.optimize_file import optimize_file

    out.check(file, ("model",))
    best = optimize_file(file, of.changed, single=out.writes_model)
    out.deliver(best)
    return 0 if getattr(best, "feasible", True) else 1


COMMANDS = {optimize: OPTIMIZE}
"""Function of the command -> the examples under its help."""
