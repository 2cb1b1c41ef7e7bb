"""`dalembert check-answers`: a student's figures against ours."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from dalembert.arrays import Tree
from dalembert.cli.options import AS_IN_FILE, Changes
from dalembert.errors import ModelError
from dalembert.printing import table

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.grading.mistakes import Verdict


def grade_answers(
    file: Path,
    answers: Path | None,
    interactive: bool,
    static: bool,
    changes: Changes = AS_IN_FILE,
    tolerance: str | None = None,
) -> int:
    """Compare figures with what is computed; 1 where one is not right."""
    from dalembert.cli.model_argument import load_model
    from dalembert.grading.answer_sheet import read_sheet
    from dalembert.grading.mistakes import Problem
    from dalembert.model.files.model_files import read_file

    problem = Problem(load_model(file, changes), static)
    if interactive:
        sheet = read_sheet(_ask_figures(problem.result))
    elif answers is None:
        raise ModelError("check-answers needs a file of answers", "name one, or answer with --interactive")
    else:
        sheet = read_sheet(*read_file(answers))
    found = problem.verdicts_of(sheet, tolerance)
    print(_text(found, sheet.file))
    return 0 if all(v.right for v in found) else 1


def _ask_figures(r: Result) -> dict[str, Tree]:
    """Ask for every effort and joint force; an empty line skips one, the end of the input all that follow."""
    m = r.mechanism
    form = "size @ angle" if m.dimension == 2 else "x, y, z"
    asked = [("effort", d, f"Effort of {d} (a number, or with its unit; empty to skip): ") for d in r.drives]
    asked += [("unknown_load", name, f"Load {name}: ") for name in r.unknown_loads]
    for joint in r.joints:
        i, j = m.joints[joint].links
        asked.append(("reaction", joint, f"Joint {joint}, force of {i} on {j} ({form}): "))
    out: dict[str, Tree] = {"effort": {}, "unknown_load": {}, "reaction": {}}
    for quantity, name, question in asked:
        try:
            said = input(question).strip()
        except EOFError:
            print()
            break
        if said:
            parts = [part.strip() for part in said.strip("[]").split(",")]
            out[quantity][name] = parts if quantity == "reaction" and len(parts) > 1 else said
    return out


def _text(found: list[Verdict], file: str) -> str:
    rows = [[v.quantity, v.given, v.computed, _verdict(v)] for v in found]
    where = [f"{file}:{v.line}: " if file else "" for v in found]
    said = [f"{at}{v.quantity}: {v.mistake}." for at, v in zip(where, found, strict=True) if not v.right]
    right = sum(v.right for v in found)
    parts = [
        table(["answer", "yours", "computed", "verdict"], rows, left=1),
        *said,
        f"{right} of {len(found)} right.",
    ]
    return "\n\n".join(parts[:1]) + "\n\n" + "\n".join(parts[1:])


def _verdict(v: Verdict) -> str:
    if v.right:
        return "right"
    return "not judged" if v.kind == "open" else f"off by {100 * v.off:.2g} %"
