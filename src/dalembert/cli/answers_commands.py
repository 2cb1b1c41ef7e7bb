"""`dalembert check-answers` and `grade`: a student's figures against ours, and a class's answers marked."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from dalembert.cli.answer_files import NO_OUTPUTS, Outputs
from dalembert.cli.options import AS_STATED, ModelFile, Steady, flag, with_help
from dalembert.errors import ModelError
from dalembert.printing import table

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.arrays import Tree
    from dalembert.grading.mistakes import Verdict
    from dalembert.model import Mechanism


def check_answers(
    file: ModelFile,
    answers: Annotated[Path | None, with_help("File with your answers.")] = None,
    /,
    *,
    interactive: Annotated[bool, flag("Enter the answers one by one.")] = False,
    tolerance: Annotated[
        str | None,
        with_help(
            "Tolerance for answers that give none, e.g. 3% for graphical work (default: 0.5 %, or the digits given)."
        ),
    ] = None,
    of: Steady = AS_STATED,
) -> int:
    """Compare your answers with the computed ones, and name the mistakes that explain the differences."""
    from dalembert.grading.answer_sheet import read_sheet
    from dalembert.grading.mistakes import SolvedProblem
    from dalembert.model.files.model_files import read_file

    problem = SolvedProblem(of.load(file), of.static)
    if interactive:
        sheet = read_sheet(_ask_figures(problem.result))
    elif answers is None:
        raise ModelError(
            "check-answers needs a file of answers", "name one, or enter the answers with --interactive"
        )
    else:
        sheet = read_sheet(*read_file(answers))
    verdicts = problem.verdicts_of(sheet, tolerance)
    print(_text(verdicts, sheet.file))
    return 0 if all(v.right for v in verdicts) else 1


def _ask_figures(r: Result) -> dict[str, Tree]:
    """Ask for every effort and joint force; an empty line skips one, the end of the input all that follow."""
    m = r.mechanism
    form = "size @ angle" if m.dimension == 2 else "x, y, z"
    questions = [
        ("effort", d, f"Effort of {d} (a number, or with its unit; empty to skip): ") for d in r.drives
    ]
    questions += [("unknown_load", name, f"Load {name}: ") for name in r.unknown_loads]
    for joint in r.joints:
        i, j = m.joints[joint].links
        questions.append(("reaction", joint, f"Joint {joint}, force of {i} on {j} ({form}): "))
    out: dict[str, Tree] = {"effort": {}, "unknown_load": {}, "reaction": {}}
    for quantity, name, question in questions:
        try:
            reply = input(question).strip()
        except EOFError:
            print()
            break
        if reply:
            parts = [part.strip() for part in reply.strip("[]").split(",")]
            out[quantity][name] = parts if quantity == "reaction" and len(parts) > 1 else reply
    return out


def _text(verdicts: list[Verdict], file: str) -> str:
    rows = [[v.quantity, v.given, v.computed, _verdict(v)] for v in verdicts]
    where = [f"{file}:{v.line}: " if file else "" for v in verdicts]
    sentences = [
        f"{at}{v.quantity}: {v.mistake}." for at, v in zip(where, verdicts, strict=True) if not v.right
    ]
    right = sum(v.right for v in verdicts)
    parts = [
        table(["answer", "yours", "computed", "verdict"], rows, left=1),
        *sentences,
        f"{right} of {len(verdicts)} right.",
    ]
    return "\n\n".join(parts[:1]) + "\n\n" + "\n".join(parts[1:])


def _verdict(v: Verdict) -> str:
    if v.right:
        return "right"
    off = 100 * v.off
    return "not judged" if v.kind == "open" else f"off by {off:.0f} %" if off >= 10 else f"off by {off:.2g} %"


def grade(
    answers: Annotated[
        Path,
        with_help("Folder of answer sheets (.yaml, .json, .toml, .csv), one per student, or a table (.csv)."),
    ],
    /,
    *,
    key: Annotated[Path, with_help("Answer key (.csv, .json) written by `variants`, or a model file.")],
    rubric: Annotated[Path | None, with_help("Points and partial-credit shares: YAML, JSON or TOML.")] = None,
    feedback: Annotated[Path | None, with_help("Folder for the feedback, one text per student.")] = None,
    tolerance: Annotated[
        str | None,
        with_help(
            "Tolerance for quantities to which the key gives none, e.g. 3% (default: 0.5 %, or the digits given)."
        ),
    ] = None,
    columns: Annotated[
        list[str] | None,
        with_help(
            "Meaning of a heading that is not understood: HEADING=effort.O2, or HEADING=- to ignore it."
        ),
    ] = None,
    decide: Annotated[
        Path | None, with_help("Table (.csv, .xlsx) of student, figure and value for cells read by hand.")
    ] = None,
    of: Steady = AS_STATED,
    out: Outputs = NO_OUTPUTS,
) -> int:
    """Grade a class's ANSWERS against a key: mistakes named, partial credit, carried-forward errors penalised once."""
    from dalembert.grading.marking.grade import grade as graded
    from dalembert.saving import check_new_folder

    out.check(answers)
    if feedback is not None:
        check_new_folder(feedback, out.force)
    source: Path | Mechanism = key
    if of.set or of.no_friction:
        if key.suffix.lower() == ".csv":
            raise ModelError(
                "--set and --no-friction change a model file", f"name one as --key; {key} is a table"
            )
        source = of.load(key)
    meanings = _column_meanings(columns or [])
    results = graded(answers, source, rubric, tolerance, of.static, meanings, decide)
    if feedback is not None:
        results.save_feedback(feedback, out.force)
    out.deliver(results)
    for problem in (problem for s in results.students for problem in s.problems):
        print(problem, file=sys.stderr)
    return 1 if any(s.problems for s in results.students) else 0


def _column_meanings(texts: list[str]) -> dict[str, str]:
    """Meanings of headings by heading, of texts HEADING=MEANING."""
    pairs = [text.rpartition("=") for text in texts]
    for text, (head, _, meaning) in zip(texts, pairs, strict=True):
        if not head.strip() or not meaning.strip():
            raise ModelError(f"--columns {text!r} has no meaning", 'write --columns "Response 1=effort.O2"')
    return {head.strip(): meaning.strip() for head, _, meaning in pairs}


COMMANDS: dict[Callable[..., int], str] = {
    check_answers: """Examples:
  dalembert check-answers four_bar.yaml mine.yaml
  dalembert check-answers four_bar.yaml --interactive

The file of answers, or a list as in a model file:
  efforts: {O2: 243 lbf*in}
  reactions: {A: 155 @ 220 deg}
  tolerance: 3 %""",
    grade: """Examples:
  dalembert grade answers --key exam/key.csv -o marks.xlsx --feedback feedback
  dalembert grade class.csv --key four_bar.yaml --tolerance 3%
  dalembert grade answers --key exam/key.csv --rubric rubric.yaml -o marks.xlsx
  dalembert grade form.xlsx --key four_bar.yaml --columns "Response 1=effort.O2" --decide read.csv

A rubric changes what it names; here the default shares, all others are 1 or 0:
  marks: {effort: 4, reaction: 2}
  share: {rounding: 0.875, sign: 0.5, unit: 0.5, named: 0.5, datum: 0.75, concept: 0.5, part: 0.5}
  cap: 0.5
  mistakes: {weight is mistaken for mass: 0.25}""",
}
"""Function of each command -> the examples under its help."""
