"""`dalembert variants`: exam variants of a problem, with question and solution sheets and a key."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from dalembert.cli.options import AS_STATED, At, Force, ModelFile, Steady, numeric, output, target
from dalembert.errors import ModelError

EXAMPLES = """Examples:
  dalembert variants four_bar.yaml --vary "loads.T_4.value=100..140" -o exam
  dalembert variants engine.yaml --vary "drives.O.position=20..60 deg" \\
    --vary "loads.gas.value=[-2 kN, -3 kN]" --ask effort.O --count 8 -o exam
  dalembert variants four_bar.yaml --vary "loads.T_4.value=100..140" --course "ME 301, 20 November" \\
    --text @intro.txt --marks effort=4 --marks default=2 -o exam

The folder: questions, solutions, answers (tables to fill in), problems (model files), key.csv and key.json;
questions.pdf and key.pdf to print."""


def variants(
    file: ModelFile,
    /,
    *,
    vary: Annotated[
        list[str],
        Parameter(
            negative=(),
            help="PATH=values, one or more: a range in round steps, 40..60 mm step 5 mm, or a list, [400 N, 500 N]; "
            "PATH as in with_values: links.crank.points.A.0, loads.P.value, drives.O2.speed.",
        ),
    ],
    output: Annotated[Path, output("Folder to write; must be new or empty.")],
    count: Annotated[int, numeric("variants", "Number of variants (default: 30).")] = 30,
    ask: Annotated[
        list[str] | None,
        Parameter(
            negative=(),
            help="Requested quantities, one or more: effort.O2, reaction.A, reaction.A.magnitude, angle.rocker.speed "
            "(default: the file's answers, else all efforts and reactions).",
        ),
    ] = None,
    seed: Annotated[
        int | None,
        numeric("seed", "Seed; repeats the same variants (default: random, printed)."),
    ] = None,
    at: At = None,
    tolerance: Annotated[
        str, target("Smallest effect of a common mistake, and the key's tolerance, e.g. 3 %.")
    ] = "",
    course: Annotated[str, target("Course and date, printed under the title of each sheet.")] = "",
    text: Annotated[
        str, target("Introduction printed before the given data; @FILE reads it from a text file.")
    ] = "",
    marks: Annotated[
        list[str] | None,
        Parameter(negative=(), help="Marks of a question, one or more: effort=4, reaction.A=2, default=1."),
    ] = None,
    of: Steady = AS_STATED,
    force: Force = False,
) -> int:
    """Make exam variants of FILE with random values, each solved and checked: question sheets, solutions and a key."""
    from dalembert.exams.choices import read_option
    from dalembert.exams.exam_folder import check_folder
    from dalembert.exams.variants import variants as drawn
    from dalembert.grading.file_answers import value_text
    from dalembert.printing import tables

    check_folder(output, force)
    worth = dict(map(_marks, marks or ()))
    choices = dict(map(read_option, vary))
    m = of.load(file)
    exam = drawn(m, choices, count, seed, ask or (), at, of.static, tolerance)
    exam.save(output, force, course, _introduction(text), worth)
    rows = [[v.name, *(value_text(v.values[path]) for path in choices)] for v in exam]
    print(tables(["variant", *choices], rows, 1))
    print(f"Written: {output}; --seed {exam.seed} draws the same again.", file=sys.stderr)
    return 0


def _introduction(text: str) -> str:
    from dalembert.model.quantities.column_files import file_text

    return file_text(Path(text[1:])).strip() if text.startswith("@") else text


def _marks(text: str) -> tuple[str, float]:
    name, _, number = text.partition("=")
    try:
        return name.strip(), float(number)
    except ValueError:
        raise ModelError(f"--marks {text}: no number of marks", "write --marks effort=4") from None


COMMANDS = {variants: EXAMPLES}
"""Function of the command -> the examples under its help."""
