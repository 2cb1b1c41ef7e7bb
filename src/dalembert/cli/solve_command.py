"""`dalembert solve`: a file analysed, printed and written."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Literal, NamedTuple

from dalembert.cli.options import Changes
from dalembert.errors import ModelError
from dalembert.progress import progress
from dalembert.saving import check_installed, check_new

if TYPE_CHECKING:
    from dalembert.analysis import Result


PACKAGES = {"xlsx": ("openpyxl", "a workbook"), "netcdf": ("h5netcdf", "a netCDF file")}
"""Kind of file -> the optional package that writes it, and what it is called."""


ENDINGS = {
    "json": (".json",),
    "csv": (".csv",),
    "xlsx": (".xlsx", ".xls"),
    "netcdf": (".nc", ".nc4", ".cdf"),
}
"""Kind of file -> what its name ends with."""


class Wanted(NamedTuple):
    """What to print and write."""

    json: Path | None
    csv: Path | None
    xlsx: Path | None
    netcdf: Path | None
    units: Literal["si", "file"] | None
    axes: Literal["ground", "link", "joint"]
    every: bool
    force: bool
    others: bool = False

    @property
    def written_units(self) -> Literal["SI", "file"]:
        """Units of files: SI unless told otherwise."""
        return "file" if self.units == "file" else "SI"

    @property
    def printed_units(self) -> Literal["SI", "file"]:
        """Units of what a person reads: the file's unless told otherwise."""
        return "SI" if self.units == "si" else "file"

    @property
    def files(self) -> dict[str, Path]:
        """Kind of file -> where, those that do not go to the screen."""
        named = {"json": self.json, "csv": self.csv, "xlsx": self.xlsx, "netcdf": self.netcdf}
        return {kind: path for kind, path in named.items() if path is not None and str(path) != "-"}


def solve_file(
    file: Path, wanted: Wanted, *, static: bool, positions: int | None, method: str, changes: Changes
) -> int:
    """Analyse a file, print or write the answer; 1 where some position has a status other than ok."""
    _check_targets(file, wanted)
    result = _result(file, static, positions, changes)
    shown, more = by_method(method, result, wanted.printed_units)
    if wanted.others:
        from dalembert.cli.method_text import other_solutions_text

        more = "\n\n".join(filter(None, (more, other_solutions_text(result, wanted.printed_units))))
    _print_answer(shown, wanted, more)
    for kind, path in wanted.files.items():
        with progress(f"Writing {path}"):
            _write(shown, kind, path, wanted)
        print(f"Written: {path}", file=sys.stderr)
    return 0 if result.ok.all() else 1


def _check_targets(file: Path, wanted: Wanted) -> None:
    """Refused before the work, not behind it."""
    for kind in ENDINGS:
        if str(getattr(wanted, kind) or "").startswith("--"):
            printed = "" if kind in PACKAGES else f"or - to print it: --{kind} -"
            raise ModelError(f"--{kind} needs the name of a file", printed)
    for kind in PACKAGES:
        if str(getattr(wanted, kind)) == "-":
            raise ModelError(
                f"--{kind} - asks for {PACKAGES[kind][1]} on the screen, which is no text", "name a file"
            )
    check_targets(file, {kind: getattr(wanted, kind) for kind in ENDINGS}, wanted.force)


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
        from dalembert.analysis.output.json_record import write_json

        write_json(result, sys.stdout, wanted.written_units, wanted.axes, wanted.others)
    elif str(wanted.csv) == "-":
        from dalembert.analysis.output.export import write_csv

        write_csv(result, sys.stdout, wanted.written_units, wanted.axes)
    else:
        from dalembert.analysis.output.summary.printed_answer import answer_text

        print(answer_text(result, wanted.printed_units, wanted.axes, wanted.every))
        if more:
            print(f"\n{more}")


def _write(result: Result, kind: str, path: Path, wanted: Wanted) -> None:
    from dalembert.analysis.output import export

    if kind == "json":
        export.to_json(result, path, wanted.force, wanted.written_units, wanted.axes, wanted.others)
        return
    writers = {"csv": export.to_csv, "xlsx": export.to_xlsx, "netcdf": export.to_netcdf}
    writers[kind](result, path, wanted.force, wanted.written_units, wanted.axes)
