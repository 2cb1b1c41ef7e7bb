"""Base of the answers in this package: numbers over the positions, others by name, printed parts, drawings, a
section."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from importlib import import_module
from typing import TYPE_CHECKING, ClassVar

from dalembert.analysis.output.columns import Column, Scale, UnitChoice
from dalembert.analysis.output.summary.printed_units import print_scale
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.answer.equality import Compared
from dalembert.arrays import Tree
from dalembert.printing import Part, wrap

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


class Answer(Compared):
    """An answer of machine design; ``NAME`` is that of its text, its drawings and its section of the report."""

    NAME: ClassVar[str]
    result: Result

    def columns(self) -> Iterator[Column]:
        """Its numbers over the positions."""
        raise NotImplementedError

    def record(self, to: Scale) -> Tree:
        """Its other numbers by name, in the units of a scale."""
        raise NotImplementedError

    def drive_columns(self) -> Iterator[Column]:
        """The drives' positions, with which every table begins."""
        r = self.result
        for drive in r.drives:
            yield Column(f"drive.{drive}", drive_kinds(r, drive)["position"], r.drive_position(drive))

    def contents(self, units: UnitChoice = "file", **choice: object) -> Iterable[Part]:
        """Printed parts: sentences and tables."""
        text = import_module(f"dalembert.machine.output.{self.NAME}_text")
        found: Iterable[Part] = getattr(text, f"{self.NAME}_parts")(
            self, print_scale(self.result, units), **choice
        )
        return found

    def text(self, units: UnitChoice = "file", **choice: object) -> str:
        """The same as the command prints it, under title, source and what the numbers rest on."""
        m, of = self.result.mechanism, ("gravity", "inertia", "friction")
        said = ", ".join(f"{key} {value}" for key, value in self.result.assumptions.items() if key in of)
        lines = [line for line in (m.title, m.source_text, wrap(f"Assumptions: {said}")) if line]
        blocks = [
            "\n".join(map(wrap, part.split("\n"))) if isinstance(part, str) else str(part)
            for part in self.contents(units, **choice)
        ]
        return "\n\n".join(["\n".join(lines), *blocks])

    def __str__(self) -> str:
        return self.text()
