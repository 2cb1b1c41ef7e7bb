"""Files of an answer: the same options, with the same meaning and in the same words, in every command.

A command takes those that its answer has. All are checked before the work; files are written before anything is
printed, so that a pipe that closes early takes no file with it.
"""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

from cyclopts import Parameter

from dalembert.cli.options import Drawing, Figures, Force, ReactionAxes, Report, Theme, Units, target
from dalembert.cli.options import output as output_to
from dalembert.errors import ModelError
from dalembert.progress import progress
from dalembert.saving import check_installed, check_new

if TYPE_CHECKING:
    from dalembert.answer.answer import Answer
    from dalembert.views.notation import Notation

PACKAGES = {"xlsx": ("openpyxl", "a workbook"), "netcdf": ("h5netcdf", "a netCDF file")}
"""Option -> the optional package that writes it, and what it is called."""
ENDINGS = {
    "json": (".json",),
    "csv": (".csv",),
    "xlsx": (".xlsx", ".xls"),
    "netcdf": (".nc", ".nc4", ".cdf"),
    "drawing": (".svg", ".pdf", ".png", ".dxf"),
    "report": (".pdf", ".html", ".tex", ".txt"),
    "model": (".yaml", ".yml", ".toml"),
}
"""Kind of file -> endings of its name."""
OWN = ("json", "csv", "xlsx", "netcdf")
"""Kinds with reserved endings: no other kind is written into a file of that name."""
PRINTED = ("json", "csv")
"""Kind of answer that `-` prints."""


@Parameter(name="*")
@dataclass(frozen=True)
class Outputs:
    """Files of an answer, and how they are written."""

    KINDS: ClassVar[tuple[str, ...]] = ("json", "csv", "xlsx", "report")

    json: Annotated[Path | None, target("Write the answer as JSON; - prints only the JSON.")] = None
    csv: Annotated[
        Path | None,
        target("Write a table (CSV), one row per position, design or part; - prints only the table."),
    ] = None
    xlsx: Annotated[Path | None, target("Write a workbook (Excel) with the table and charts.")] = None
    report: Report = None
    output: Annotated[
        Path | None,
        output_to(
            "Write this file in the format of its extension: .json, .csv, .xlsx, .nc, a drawing, a report, or the "
            "new model file (.yaml, .toml)."
        ),
    ] = None
    units: Units = None
    figures: Figures = 4
    force: Force = False

    @property
    def targets(self) -> dict[str, Path]:
        """Option -> where it goes, - for the screen."""
        named = {kind: getattr(self, kind, None) for kind in (*self.KINDS, "output")}
        return {kind: path for kind, path in named.items() if path is not None}

    @property
    def prints_data(self) -> bool:
        """True if standard output holds JSON or CSV, and nothing else."""
        return any(str(self.targets.get(kind)) == "-" for kind in PRINTED)

    def check(self, file: Path, kinds: tuple[str, ...] = ()) -> None:
        """Raise for what cannot be written, before the work; ``kinds``: what -o can write besides the options."""
        targets = self.targets
        for kind, path in targets.items():
            if str(path).startswith("--"):
                printed = f"or - to print it: --{kind} -" if kind in PRINTED else ""
                raise ModelError(f"--{kind} needs the name of a file", printed)
            if kind in PACKAGES and str(path) == "-":
                what = PACKAGES[kind][1]
                raise ModelError(
                    f"--{kind} - asks for {what} on the screen, which is not text", "name a file"
                )
        if all(str(targets.get(kind)) == "-" for kind in PRINTED):
            raise ModelError("--json - and --csv - both ask for the screen", "name a file for one of them")
        taken = {os.path.realpath(file): "the model file"}
        for kind, path in targets.items():
            if str(path) == "-":
                continue
            written = self._written_kind(kind, path, kinds)
            place = os.path.realpath(path)
            if place in taken:
                raise ModelError(f"--{kind} {path}: that is {taken[place]}", "name another file")
            taken[place] = f"the file of --{kind} already"
            check_new(path, self.force)
            if written in PACKAGES:
                check_installed(*PACKAGES[written])

    def _written_kind(self, option: str, path: Path, more: tuple[str, ...] = ()) -> str:
        """Kind of answer that an option writes into a file; raises ModelError if the name is that of another."""
        ending = path.suffix.lower()
        if option != "output":
            other = next((kind for kind in OWN if kind != option and ending in ENDINGS[kind]), None)
            if other:
                remedy = f"end it with {ENDINGS[option][0]}, or write --{other} {path}"
                raise ModelError(f"--{option} {path}: that is the name of another kind of file", remedy)
            if option not in OWN and ending not in ENDINGS[option]:
                what = f"--{option} {path}: the ending names no kind of {option}"
                raise ModelError(what, f"use one of {' '.join(ENDINGS[option])}")
            return option
        kinds = (*self.KINDS, *more)  # a .pdf is the report, which stands before the drawing
        kind = next((k for k in kinds if ending in ENDINGS[k]), None)
        if kind is None:
            has = dict.fromkeys(e for k in kinds for e in ENDINGS[k])
            raise ModelError(
                f"--output {path}: this answer cannot be written in this format",
                f"use one of {' '.join(has)}",
            )
        return kind

    @property
    def writes_model(self) -> bool:
        """True if the answer's description is written as a model file."""
        path = self.targets.get("output")
        return path is not None and path.suffix.lower() in ENDINGS["model"]

    @property
    def printed_units(self) -> Literal["SI", "file"]:
        """Units of what a person reads and opens: the file's unless SI is requested."""
        return "SI" if self.units == "si" else "file"

    @property
    def program_units(self) -> Literal["SI", "file"]:
        """Units of what programs read, JSON and netCDF: SI unless the file's are requested."""
        return "file" if self.units == "file" else "SI"

    @property
    def notation(self) -> Notation:
        """The notation of drawings and reports."""
        from dalembert.views.notation import Notation

        return Notation(units=self.printed_units, figures=self.figures)

    def deliver(self, answer: Answer, others: bool = False, more: str = "", **choice: Any) -> None:
        """Write every requested file, then print: what - asks for, or the answer and more text below it.

        ``others``: JSON with the other solutions of friction. ``choice``: of what is printed.
        """
        targets = self.targets
        sought = {"others": others} if others else {}
        files = {kind: path for kind, path in targets.items() if str(path) != "-"}
        for kind, path in files.items():
            with progress(f"Writing {path}"):
                self.write(answer, self._written_kind(kind, path, ("model",)), path, **sought)
        if "json" in targets and "json" not in files:
            answer.to_json(sys.stdout, True, self.program_units, self._axes, **sought)
        elif "csv" in targets and "csv" not in files:
            answer.to_csv(sys.stdout, True, self.printed_units, self._axes)
        else:
            print("\n\n".join(filter(None, (answer.text(self.printed_units, **choice), more))))
        for path in files.values():
            print(f"Written: {path}", file=sys.stderr)

    @property
    def _axes(self) -> Any:
        return getattr(self, "axes", "ground")

    def write(self, answer: Any, kind: str, path: Path, **more: Any) -> None:
        """Write one file of a kind."""
        if kind == "drawing":
            answer.draw(notation=self.notation).save(path, self.force, getattr(self, "theme", "light"))
        elif kind == "report":
            answer.report(notation=self.notation).save(path, self.force)
        elif kind == "model":
            answer.mechanism.save(path, self.force)
        elif kind == "json":
            answer.to_json(path, self.force, self.program_units, self._axes, **more)
        else:
            units = self.program_units if kind == "netcdf" else self.printed_units
            getattr(answer, f"to_{kind}")(path, self.force, units, self._axes)


@Parameter(name="*")
@dataclass(frozen=True)
class DrawnOutputs(Outputs):
    """Those of an answer with drawings."""

    KINDS: ClassVar[tuple[str, ...]] = (*Outputs.KINDS, "drawing")

    drawing: Drawing = None
    theme: Theme = "light"


@Parameter(name="*")
@dataclass(frozen=True)
class LabelledOutputs(DrawnOutputs):
    """Those of an answer with labelled arrays too."""

    KINDS: ClassVar[tuple[str, ...]] = (*DrawnOutputs.KINDS, "netcdf")

    netcdf: Annotated[Path | None, target("Write labelled arrays as netCDF, e.g. for xarray.")] = None


@Parameter(name="*")
@dataclass(frozen=True)
class ResultOutputs(LabelledOutputs):
    """Those of an analysis, whose reactions have axes."""

    axes: Annotated[
        ReactionAxes,
        Parameter(help="Axes of the reactions: ground, the link they act on, or, in space, the joint."),
    ] = "ground"


NO_OUTPUTS, NO_DRAWN, NO_LABELLED, NO_RESULT = Outputs(), DrawnOutputs(), LabelledOutputs(), ResultOutputs()
