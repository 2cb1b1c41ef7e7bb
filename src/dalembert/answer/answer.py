"""Common abilities of every answer: printed, shown in a notebook, written in every format that makes sense for it.

A class gives columns, a record, contents to read and, where it has them, drawings and a worked solution; the methods
here, given once, make everything else of these.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, ClassVar, Literal

from dalembert.answer.column import Axes, Column, Scale, UnitChoice
from dalembert.answer.equality import Compared
from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.printing import Part, wrap
from dalembert.saving import new_file

if TYPE_CHECKING:
    import pandas
    import xarray

    from dalembert.answer.workbook import Tab
    from dalembert.reports import Report
    from dalembert.reports.sheet import ReportSheet
    from dalembert.views.notation import Notation
    from dalembert.views.paper.scene import Scene

BLOCK = 1024
"""Rows turned into Python objects at once: of a hundred thousand few are in memory together."""
DRAWINGS, MODELS = (".svg", ".pdf", ".png", ".dxf"), (".yaml", ".yml", ".toml")
REPORTS = (".html", ".tex", ".txt", ".pdf")

Target = str | os.PathLike[str] | IO[str]
"""A file to write, or an open one."""


class Answer(Compared):
    """Answer with rows of numbers; ``ROWS`` is what these are, ``FIRST`` the number of the first."""

    ROWS: ClassVar[str] = "positions"
    FIRST: ClassVar[int] = 1

    # what a class gives

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """Its numbers over the rows, each named, with its kind of unit."""
        raise NotImplementedError

    def record(self, to: Scale) -> Tree:
        """Its other numbers by name, in the units of a scale."""
        return {}

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterable[Part]:
        """Printed answer: sentences and tables."""
        raise NotImplementedError

    @property
    def described(self) -> Any:
        """Subject of the answer: something with a title, a source and units."""
        return self.mechanism  # type: ignore[attr-defined]

    def basis(self) -> dict[str, str]:
        """Title, source, and what the numbers rest on."""
        return {"title": self.described.title or "", "source": self.described.source_text or ""}

    def scale(self, units: UnitChoice) -> Scale:
        """SI numbers to SI, or to the units of the file."""
        return Scale(None if units == "SI" else self.described.units)

    def blocks(self, count: int) -> Iterator[slice]:
        """Slices of the rows that are written, a few at a time."""
        return (slice(start, min(start + BLOCK, count)) for start in range(0, count, BLOCK))

    def head(self, units: UnitChoice = "SI", axes: Axes = "ground") -> Tree:
        """Part of the JSON answer that precedes the rows."""
        from dalembert.answer.record import head

        return head(self, units)

    def records(self, units: UnitChoice = "SI", axes: Axes = "ground", **choice: Any) -> Iterator[Tree]:
        """The rows of the JSON answer."""
        from dalembert.answer.record import column_records

        return column_records(self, units, axes)

    def tabs(self, units: UnitChoice = "file", axes: Axes = "ground") -> Iterator[Tab]:
        """The sheets of its workbook."""
        from dalembert.answer.workbook import answer_tabs

        return answer_tabs(self, units, axes)

    # given once

    def text(self, units: UnitChoice = "file", **choice: Any) -> str:
        """The answer as the command prints it, under title, source and what the numbers rest on."""
        basis = self.basis()
        of = {key: text for key, text in basis.items() if key in ("gravity", "inertia", "friction")}
        lines = [basis.get("title", ""), basis.get("source", "")]
        if of:
            lines.append(wrap("Assumptions: " + ", ".join(f"{key} {text}" for key, text in of.items())))
        blocks = [
            "\n".join(map(wrap, part.split("\n"))) if isinstance(part, str) else str(part)
            for part in self.contents(units, **choice)
        ]
        return "\n\n".join(block for block in ("\n".join(filter(None, lines)), *blocks) if block)

    def __str__(self) -> str:
        return self.text()

    def _repr_html_(self) -> str:
        from dalembert.notebook.html_card import card

        title, *lines = [text for text in self.basis().values() if text][:2] or [type(self).__name__]
        drawn = [self.draw] if isinstance(self, Drawn) else []
        return card(title, *lines, *self.contents(), *drawn)

    def to_dict(self, units: UnitChoice = "SI", axes: Axes = "ground") -> Tree:
        """The JSON answer; None for a missing value."""
        return {**self.head(units, axes), self.ROWS: list(self.records(units, axes))}

    def to_dataframe(
        self, units: UnitChoice = "SI", axes: Axes = "ground", index: Literal["rows", "drives"] = "rows"
    ) -> pandas.DataFrame:
        """One row per row of the answer, one column per number; ``index="drives"``: by the values of the drives."""
        from dalembert.answer.table_rows import dataframe

        return dataframe(self, units, axes, index)

    def to_csv(
        self, path: Target, overwrite: bool = False, units: UnitChoice = "file", axes: Axes = "ground"
    ) -> None:
        """Write every row as a table, units in its heading."""
        from dalembert.answer.table_rows import write_csv

        with _opened(path, overwrite) as stream:
            write_csv(self, stream, units, axes)

    def to_json(
        self,
        path: Target,
        overwrite: bool = False,
        units: UnitChoice = "SI",
        axes: Axes = "ground",
        **choice: Any,
    ) -> None:
        """Write everything as JSON, one line per row."""
        from dalembert.answer.record import write_json

        with _opened(path, overwrite) as stream:
            write_json(self, stream, units, axes, **choice)

    def to_xlsx(
        self,
        path: str | os.PathLike[str],
        overwrite: bool = False,
        units: UnitChoice = "file",
        axes: Axes = "ground",
    ) -> None:
        """Write a workbook: every row, charts, what is printed."""
        from dalembert.answer.workbook import write_workbook

        write_workbook(self, path, overwrite, units, axes)

    def save(self, path: str | os.PathLike[str], overwrite: bool = False, theme: str = "light") -> None:
        """Write what the ending of a file names: .json, .csv, .xlsx, and what else there is of this answer.

        Raises ModelError, with the list, for another.
        """
        ending = Path(path).suffix.lower()
        writers = self.writers(theme)
        if ending not in writers:
            raise ModelError(
                f"{Path(path).name}: {type(self).__name__} cannot be written in this format",
                f"use one of {' '.join(writers)}",
            )
        writers[ending](path, overwrite)

    def writers(self, theme: str = "light") -> dict[str, Any]:
        """Ending of a file -> what writes it: function of a path and of whether it may exist."""
        out: dict[str, Any] = {".json": self.to_json, ".csv": self.to_csv, ".xlsx": self.to_xlsx}
        if isinstance(self, Labelled):
            out[".nc"] = self.to_netcdf
        if isinstance(self, Drawn):
            drawn = self
            out |= dict.fromkeys(DRAWINGS, lambda path, force: drawn.draw().save(path, force, theme))
        if isinstance(self, Worked):
            worked = self
            out |= dict.fromkeys(REPORTS, lambda path, force: worked.report().save(path, force))
        if isinstance(self, Remade):
            out |= dict.fromkeys(MODELS, self.mechanism.save)
        return out


class Labelled(Answer):
    """Answer that labelled arrays are made of."""

    def labelled(self, to: Scale, axes: Axes) -> tuple[Tree, Tree]:
        """Arrays by name as xarray takes them, and coordinates."""
        from dalembert.answer.labelled import column_arrays

        return column_arrays(self, to, axes)

    def to_xarray(self, units: UnitChoice = "SI", axes: Axes = "ground") -> xarray.Dataset:
        """Labelled arrays with units in their attributes."""
        from dalembert.answer.labelled import dataset

        return dataset(self, units, axes)

    def to_netcdf(
        self,
        path: str | os.PathLike[str],
        overwrite: bool = False,
        units: UnitChoice = "SI",
        axes: Axes = "ground",
    ) -> None:
        """Write the labelled arrays."""
        from dalembert.saving import check_installed

        check_installed("h5netcdf", "a netCDF file")
        made = self.to_xarray(units, axes)
        with new_file(path, overwrite) as temporary:
            made.to_netcdf(temporary, engine="h5netcdf")


class Drawn(Answer):
    """Answer with drawings."""

    def drawings(self, notation: Notation | None = None) -> list[Scene]:
        """Its drawings, one by one."""
        raise NotImplementedError

    def draw(self, *, notation: Notation | None = None) -> Scene:
        """All its drawings on one sheet."""
        from dalembert.views.paper.scene import stack_scenes

        scenes = self.drawings(notation)
        return (
            scenes[0] if len(scenes) == 1 else stack_scenes(scenes, title=self.described.title, width=270.0)
        )


class Worked(Answer):
    """Answer with a worked solution."""

    def sheet(self, notation: Notation | None = None) -> ReportSheet:
        """Equations in letters and numbers if there are any, the answer, and the drawings."""
        from dalembert.reports.machine_sections import answer_sheet

        return answer_sheet(self, notation)

    def report(self, notation: Notation | None = None) -> Report:
        """The worked solution: ``answer.report().save("engine.pdf")``, or .html, .tex, .txt."""
        from dalembert.reports import report

        return report(self, notation=notation)


class Remade(Answer):
    """Answer with a new ``mechanism``, to be written as a model file: .yaml, .toml."""

    mechanism: Any


@contextmanager
def _opened(path: Target, overwrite: bool) -> Iterator[IO[str]]:
    """A text file that appears when all is written; an open one as it is."""
    if not isinstance(path, (str, os.PathLike)):
        yield path
        return
    with new_file(path, overwrite) as new, open(new, "w", encoding="utf-8", newline="") as stream:
        yield stream
