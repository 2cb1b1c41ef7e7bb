"""`dalembert solve`: a file analysed, printed and written."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

from dalembert.cli.options import (
    AS_IN_FILE,
    Changes,
    Force,
    ModelFile,
    Positions,
    PrintedUnits,
    ReactionAxes,
    Static,
    flag,
    target,
    with_help,
)
from dalembert.errors import ModelError
from dalembert.progress import progress
from dalembert.saving import check_installed, check_new

if TYPE_CHECKING:
    from dalembert.analysis import Result


EXAMPLES = """Examples:
  dalembert solve four_bar.yaml
  dalembert solve four_bar.yaml --static --units si
  dalembert solve four_bar.yaml --positions 360 --csv turn.csv --xlsx turn.xlsx
  dalembert solve four_bar.yaml --json - --units file"""

PACKAGES = {"xlsx": ("openpyxl", "a workbook"), "netcdf": ("h5netcdf", "a netCDF file")}
"""Kind of file -> the optional package that writes it, and what it is called."""


ENDINGS = {
    "json": (".json",),
    "csv": (".csv",),
    "xlsx": (".xlsx", ".xls"),
    "netcdf": (".nc", ".nc4", ".cdf"),
}
"""Kind of file -> what its name ends with."""


@Parameter(name="*")
@dataclass(frozen=True)
class Wanted:
    """Choices of what is printed and written."""

    json: Annotated[Path | None, target("Write the answer as JSON; - prints only the JSON.")] = None
    csv: Annotated[
        Path | None, target("Write a table (CSV), one row per position; - prints only the table.")
    ] = None
    xlsx: Annotated[Path | None, target("Write a workbook.")] = None
    netcdf: Annotated[Path | None, target("Write labelled arrays as netCDF, e.g. for xarray.")] = None
    method: Annotated[
        Literal["matrix", "superposition", "virtual-work", "fixed-point"],
        with_help("Method; fixed-point shows the textbook iteration for friction at the first position."),
    ] = "matrix"
    units: PrintedUnits = None
    axes: Annotated[
        ReactionAxes,
        with_help("Axes of the reactions: ground, the link they act on, or, in space, the joint."),
    ] = "ground"
    changes: Changes = AS_IN_FILE
    other_solutions: Annotated[
        bool,
        flag(
            "Search for other solutions of the friction equations where the physical one may not be unique."
        ),
    ] = False
    every: Annotated[bool, flag("Print every position.", "--all")] = False
    force: Force = False

    @property
    def written_units(self) -> Literal["SI", "file"]:
        """Units of files: SI unless specified otherwise."""
        return "file" if self.units == "file" else "SI"

    @property
    def printed_units(self) -> Literal["SI", "file"]:
        """Units of what a person reads: the file's unless specified otherwise."""
        return "SI" if self.units == "si" else "file"

    @property
    def targets(self) -> dict[str, Path | None]:
        """Kind of file -> where it goes, - for the screen."""
        return {kind: getattr(self, kind) for kind in ENDINGS}

    @property
    def files(self) -> dict[str, Path]:
        """Those that do not go to the screen."""
        return {kind: path for kind, path in self.targets.items() if path is not None and str(path) != "-"}


AS_ASKED = Wanted()


def solve(
    file: ModelFile, /, *, static: Static = False, positions: Positions = None, wanted: Wanted = AS_ASKED
) -> int:
    """Solve FILE and print drives, efforts, reactions and motion, in the units of the file."""
    _check_targets(file, wanted)
    result = _result(file, static, positions, wanted.changes)
    shown, more = by_method(wanted.method, result, wanted.printed_units)
    if wanted.other_solutions:
        from dalembert.cli.method_text import other_solutions_text

        more = "\n\n".join(filter(None, (more, other_solutions_text(result, wanted.printed_units))))
    for kind, path in wanted.files.items():  # first: a pipe that closes early ends the printing alone
        with progress(f"Writing {path}"):
            _write(shown, kind, path, wanted)
    _print_answer(shown, wanted, more)
    for path in wanted.files.values():
        print(f"Written: {path}", file=sys.stderr)
    return 0 if result.ok.all() else 1


def _check_targets(file: Path, wanted: Wanted) -> None:
    """Refused before the work, not behind it."""
    for kind, path in wanted.targets.items():
        if str(path or "").startswith("--"):
            printed = "" if kind in PACKAGES else f"or - to print it: --{kind} -"
            raise ModelError(f"--{kind} needs the name of a file", printed)
    for kind, (_, what) in PACKAGES.items():
        if str(wanted.targets[kind]) == "-":
            raise ModelError(f"--{kind} - asks for {what} on the screen, which is not text", "name a file")
    check_targets(file, wanted.targets, wanted.force)


def check_targets(file: Path, targets: Mapping[str, Path | None], force: bool) -> None:
    """Raise where two answers go to one place, or one to a file of another kind, that is there, or that needs a
    package."""
    if str(targets["json"]) == "-" and str(targets["csv"]) == "-":
        raise ModelError("--json - and --csv - both ask for the screen", "name a file for one of them")
    taken = {os.path.realpath(file): "the model file"}
    for kind, path in targets.items():
        if path is None or str(path) == "-":
            continue
        if kind in ENDINGS:
            _check_ending(kind, path)
        if os.path.realpath(path) in taken:
            raise ModelError(f"--{kind} {path}: that is {taken[os.path.realpath(path)]}", "name another file")
        taken[os.path.realpath(path)] = f"the file of --{kind} already"
        check_new(path, force)
        if kind in PACKAGES:
            check_installed(*PACKAGES[kind])


def _check_ending(kind: str, path: Path) -> None:
    """A file named like another kind would be opened as that."""
    for other, endings in ENDINGS.items():
        if other != kind and path.suffix.lower() in endings:
            raise ModelError(
                f"--{kind} {path}: that is the name of another kind of file",
                f"end it with {ENDINGS[kind][0]}, or write --{other} {path}",
            )


def _result(file: Path, static: bool, positions: int | None, changes: Changes) -> Result:
    from dalembert.analysis import solve
    from dalembert.cli.model_argument import load_model

    m = load_model(file, changes)
    with progress(f"Solving {file}"):
        return solve(m, static=static, positions=positions)


def by_method(method: str, result: Result, units: Literal["SI", "file"]) -> tuple[Result, str]:
    """The answer as the method finds it, and what it shows besides."""
    if method == "matrix":
        return result, ""
    from dalembert.cli.method_text import fixed_point_text, superposition_text, virtual_work_answer

    if method == "fixed-point":
        return result, fixed_point_text(result)

    if method == "virtual-work":
        return virtual_work_answer(result, units)
    return result, superposition_text(result, units)


def _print_answer(result: Result, wanted: Wanted, more: str) -> None:
    if str(wanted.json) == "-":
        result.to_json(sys.stdout, False, wanted.written_units, wanted.axes, others=wanted.other_solutions)
    elif str(wanted.csv) == "-":
        result.to_csv(sys.stdout, False, wanted.written_units, wanted.axes)
    else:
        from dalembert.analysis.output.summary.printed_answer import answer_text

        print(answer_text(result, wanted.printed_units, wanted.axes, wanted.every))
        if more:
            print(f"\n{more}")


def _write(result: Result, kind: str, path: Path, wanted: Wanted) -> None:
    choice = {"others": wanted.other_solutions} if kind == "json" else {}
    getattr(result, f"to_{kind}")(path, wanted.force, wanted.written_units, wanted.axes, **choice)


COMMANDS = {solve: EXAMPLES}
"""Function of the command -> the examples under its help."""
