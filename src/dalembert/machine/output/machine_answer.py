"""Answers of this room: numbers over the positions of a result, others by name, drawings, a worked solution."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

from dalembert.analysis.output.summary.printed_units import Printed, print_scale
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.answer.answer import Drawn, Labelled, Worked
from dalembert.answer.column import Column, UnitChoice
from dalembert.printing import Part

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism
    from dalembert.reports.sheet import ReportSheet
    from dalembert.views.notation import Notation, Shown
    from dalembert.views.paper.scene import Scene


class MachineAnswer(Labelled, Drawn, Worked):
    """An answer of machine design, computed from a ``result``."""

    result: Result

    @property
    def described(self) -> Mechanism:
        """The description of what was analysed."""
        return self.result.mechanism

    def basis(self) -> dict[str, str]:
        """Title, source and assumptions."""
        return super().basis() | self.result.assumptions

    def drive_columns(self) -> Iterator[Column]:
        """The drives' positions, with which every table begins."""
        r = self.result
        for drive in r.drives:
            yield Column(f"drive.{drive}", drive_kinds(r, drive)["position"], r.drive_position(drive))

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterable[Part]:
        """Printed answer: sentences and tables."""
        return self.printed(print_scale(self.result, units), **choice)

    def printed(self, to: Printed, **choice: Any) -> Iterable[Part]:
        """The same in the units of a scale."""
        raise NotImplementedError

    def scenes(self, notation: Notation) -> list[Scene]:
        """Its drawings in a notation."""
        raise NotImplementedError

    def drawings(self, notation: Notation | None = None) -> list[Scene]:
        """Its drawings, one by one."""
        from dalembert.views.notation import Notation as Usual

        return self.scenes(notation or Usual())

    def section(self, sheet: ReportSheet, shown: Shown) -> None:
        """Its equations in letters and numbers, put on a sheet."""
        raise NotImplementedError

    def sheet(self, notation: Notation | None = None) -> ReportSheet:
        """Its equations, the answer, and the drawings."""
        from dalembert.reports.machine_sections import machine_sheet

        return machine_sheet(self, notation)
