"""`dalembert check` and `dalembert validate`: answers compared, as one table."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from dalembert.cli.describe_commands import is_screen, write_or_print
from dalembert.cli.options import AS_IN_FILE, Changes, Force, flag, target, with_help
from dalembert.errors import DalembertError, ModelError
from dalembert.printing import table, wrap
from dalembert.progress import progress
from dalembert.saving import check_new

if TYPE_CHECKING:
    from dalembert.grading.file_answers import ComparedAnswer

ENDINGS = (".yaml", ".yml", ".json", ".toml")


def check(
    *files: Annotated[Path, with_help("Model files, or folders of them.")],
    every: Annotated[
        bool,
        flag(
            "Print every answer of many files (default: one line per file, and the answers that disagree).",
            "--all",
        ),
    ] = False,
    changes: Changes = AS_IN_FILE,
) -> int:
    """Compare the published answers in model files with the computed ones."""
    if not files:
        raise ModelError("check needs a file or a folder", "for example: dalembert check four_bar.yaml")
    paths = list(_model_files(files))
    rows, wrong = _compare(paths, changes)
    if rows or not wrong:
        print(_text(rows, every or len(paths) == 1))
    return 2 if wrong else 0 if all(row.ok for row in rows) else 1


def validate(
    *,
    json: Annotated[Path | None, target("Write the answer as JSON; - prints only the JSON.")] = None,
    force: Force = False,
) -> int:
    """Verify this installation: solve every bundled published problem and compare all answers."""
    from dalembert.bundled import cases

    if json is not None and not is_screen(json):
        check_new(json, force)
    started = time.perf_counter()
    problems = cases()
    rows, wrong = _compare(list(problems.values()))
    seconds = time.perf_counter() - started
    good = bool(rows) and all(row.ok for row in rows) and not wrong
    if json is not None:
        write_or_print(_json_text(rows, len(problems), wrong, seconds, good), json, force)
    if json is None or not is_screen(json):
        _print_verdict(rows, len(problems), wrong, seconds, good)
    return 0 if good else 1


def _print_verdict(
    rows: Sequence[ComparedAnswer], problems: int, unread: int, seconds: float, good: bool
) -> None:
    print(_text(rows, every=True))
    print(installation())
    counted = f"{problems} problems, {f'{unread} of them not read, ' if unread else ''}{len(rows)} answers"
    print(f"{'PASSED' if good else 'FAILED'}: {counted}, {seconds:.1f} s")


def _model_files(named: Iterable[Path]) -> Iterator[Path]:
    for path in named:
        if path.is_dir():
            inside = sorted(p for p in path.rglob("*") if p.suffix in ENDINGS)
            if not inside:
                raise ModelError(f"{path} has no model file", f"they end in {', '.join(ENDINGS)}")
            yield from inside
        else:
            yield path


def _compare(files: Sequence[Path], changes: Changes = AS_IN_FILE) -> tuple[list[ComparedAnswer], int]:
    """Rows of all files, and how many files are wrong; wrong files are reported at once."""
    from dalembert.grading.file_answers import check
    from dalembert.model.gravity import gravity_doubt

    rows: list[ComparedAnswer] = []
    wrong = 0
    with progress("Checking", len(files)) as step:
        for done, path in enumerate(files):
            step(done, path.name)
            try:
                m = changes.load(path)
                if doubt := gravity_doubt(m.gravity_vector):
                    print(f"{path}: note: the acceleration of gravity of {doubt}", file=sys.stderr)
                rows += check(m, path.stem)
            except DalembertError as error:
                print(error, file=sys.stderr)
                wrong += 1
    return rows, wrong


def _text(rows: Sequence[ComparedAnswer], every: bool) -> str:
    """One line per case, with `every` one per answer; then those that disagree, in full."""
    if not rows:
        return "No answers to compare."
    failed = [row for row in rows if not row.ok]
    parts = [_answers_table(rows) if every else _case_table(rows)]
    parts += [_failure(row) for row in failed]
    exact = sum(1 for row in rows if row.exact)
    some = f"{len(rows)} answer{'s' if len(rows) > 1 else ''}, {exact} with an exact value"
    parts.append(f"{some}; {f'{len(failed)} not met' if failed else 'all met'}.")
    return "\n\n".join(parts)


def _answers_table(rows: Sequence[ComparedAnswer]) -> str:
    """One line per answer; the names of cases are above theirs."""
    cells = []
    for row in rows:
        figures = [row.published, row.exact or "-", row.computed, row.tolerance, row.deviation]
        cells.append([row.quantity, *figures, _mark(row.ok)])
    heads = ["quantity", "published", "exact", "computed", "tolerance", "deviation", "ok"]
    head, rule, *lines = table(heads, cells, 1).splitlines()
    if len({row.case for row in rows}) == 1:
        return "\n".join([head, rule, *lines])
    shown, case = [head, rule], ""
    for row, line in zip(rows, lines, strict=True):
        if row.case != case:
            shown += ["", row.case]
            case = row.case
        shown.append(line)
    return "\n".join(shown)


def _case_table(rows: Sequence[ComparedAnswer]) -> str:
    by_case: dict[str, list[ComparedAnswer]] = {}
    for row in rows:
        by_case.setdefault(row.case, []).append(row)
    cells = []
    for case, of in by_case.items():
        counts = len(of), sum(bool(r.exact) for r in of), sum(r.ok for r in of)
        cells.append([case, *map(str, counts), _mark(all(r.ok for r in of))])
    return table(["case", "answers", "exact", "agree", "ok"], cells, 1)


def _mark(ok: bool) -> str:
    return "yes" if ok else "NO"


def _failure(row: ComparedAnswer) -> str:
    """Answers that disagree, by how much, and their places."""
    place = f"{row.case}, line {row.line}" if row.line else row.case
    sentence = f"{place}: {row.quantity}: published {row.published}, computed {row.computed}"
    sentence += f", {row.deviation} apart" if row.deviation else ""
    sentence += f", tolerance {row.tolerance}" if row.tolerance else ""
    sentence += f" ({row.why})" if row.why else ""
    sentence += f"; exact {row.exact}" if row.exact else ""
    return wrap(sentence + (f". {row.problem}" if row.problem else ""), "  ")


def _json_text(rows: Sequence[ComparedAnswer], problems: int, unread: int, seconds: float, good: bool) -> str:
    """The comparison as JSON: the verdict, the installation, and every answer."""
    import json

    record = {
        "dalembert_validation": 1,
        "passed": good,
        "installation": installation(),
        "problems": problems,
        "not_read": unread,
        "seconds": round(seconds, 3),
        "answers": [row._asdict() for row in rows],
    }
    return json.dumps(record, indent=2, ensure_ascii=False) + "\n"


def installation() -> str:
    """Versions that the numbers were computed with."""
    import platform

    import numpy

    from dalembert import __version__

    python = f"Python {platform.python_version()}, numpy {numpy.__version__}"
    return f"dalembert {__version__}, {python}, {platform.system()} {platform.machine()}"


COMMANDS: dict[Callable[..., int], str] = {
    check: """Examples:
  dalembert check four_bar.yaml
  dalembert check problems/ --all""",
    validate: """Examples:
  dalembert validate
  dalembert validate > qualification.txt
  dalembert validate --json qualification.json""",
}
"""Function of each command -> the examples under its help."""
