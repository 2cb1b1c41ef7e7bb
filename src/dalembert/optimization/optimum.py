"""Result of an optimization, before and after, as printed text and as a model file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.output.summary.printed_units import Printed, scale_for
from dalembert.analysis.result.named_quantities import quantity
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.analysis.result.result import Result
from dalembert.answer.answer import Drawn, Labelled, Remade, Worked
from dalembert.answer.column import Axes, Column, Scale, UnitChoice, parts
from dalembert.arrays import Array, Tree
from dalembert.model import Mechanism
from dalembert.optimization.aims import Aim, Constraint
from dalembert.optimization.one_by_one import Function, value_of
from dalembert.printing import TextTable

if TYPE_CHECKING:
    from dalembert.printing import Part
    from dalembert.reports.sheet import ReportSheet
    from dalembert.views.notation import Notation
    from dalembert.views.paper.scene import Scene


@dataclass(frozen=True, eq=False)
class Optimum(Labelled, Drawn, Worked, Remade):
    """The best design; ``values`` (number,) in SI in the order of ``numbers``.

    before, after: the analyses of the original description and of ``mechanism``. value: the aim, SI. found: how many
    of the polished starts came within a thousandth of the best, of ``polished``; started: number of starts that could
    be solved.

    >>> import dalembert as da
    >>> best = da.optimize(da.four_bar(), {"links.ground.points.O4.0": (0.28, 0.36)}, "peak effort.O2", starts=2)
    >>> best.numbers, best.value <= best.value_before
    (('links.ground.points.O4.0',), True)
    """

    mechanism: Mechanism
    numbers: tuple[str, ...]
    values: Array
    nominal: Array
    bounds: Array = field(repr=False)  # (number, 2)
    aim: Aim
    conditions: tuple[Constraint, ...]
    before: Result = field(repr=False)
    after: Result = field(repr=False)
    feasible: bool
    found: int
    polished: int
    started: int
    kinds: tuple[str, ...] = field(repr=False)
    functions: Mapping[str, Function] = field(default_factory=dict, repr=False)
    instants: int = 0
    """Of motions under forces: number of even instants at which all is compared."""

    def values_of(self, r: Result, text: str) -> Array:
        """An expression, or a function by its name, of a result (P,)."""
        return self.sampled(r, value_of(r, text, self.functions))

    def sampled(self, r: Result, values: Array) -> Array:
        """Values at the positions of a result, or at even instants of its motion."""
        time = r.schedule.time
        if not self.instants or time is None:
            return values
        known = np.isfinite(values)
        if not known.any():
            return np.full(self.instants, np.nan)
        return np.interp(np.linspace(0.0, time[-1], self.instants), time[known], values[known])

    def place(self, r: Result, k: int) -> int:
        """Number of the position of a result at, or nearest to, the kth of these."""
        time = r.schedule.time
        if not self.instants or time is None:
            return k + 1
        return int(np.abs(time - time[-1] * k / (self.instants - 1)).argmin()) + 1

    def kind_of(self, text: str) -> str:
        """Its kind."""
        return "number" if text in self.functions else quantity(self.after, text).kind

    @property
    def value(self) -> float:
        """Aim of the best design, SI."""
        return self._sizes(self.after)[0]

    @property
    def value_before(self) -> float:
        """The aim of the original description, SI; NaN where some position has no answer."""
        return self._sizes(self.before)[0]

    def size_of(self, aim: Aim, r: Result | None = None) -> float:
        """Any aim of the best design, or of another result, SI."""
        from dalembert.analysis.batch.over_positions import reduce_positions

        values = self.values_of(self.after if r is None else r, aim.of)
        if not (aim.word and len(values)):
            return float(values[0]) if len(values) else np.nan
        return float(reduce_positions(aim.word, values))

    def _sizes(self, r: Result) -> list[float]:
        return [
            self.size_of(self.aim, r),
            *(float(self.values_of(r, c.margin).min()) for c in self.conditions),
        ]

    @property
    def _kinds(self) -> list[str]:
        """Kinds of the aim and of the margin of each condition."""
        return [self.kind_of(e) for e in (self.aim.of, *(c.margin for c in self.conditions))]

    def number_rows(self, units: UnitChoice = "file") -> list[list[str]]:
        """Name with unit of each number, before, after, and its bounds."""
        to = self._printed(units)
        columns = zip(self.numbers, self.kinds, self.nominal, self.values, *self.bounds.T, strict=True)
        return [row_of(to, *each) for each in columns]

    def aim_rows(self, units: UnitChoice = "file") -> list[list[str]]:
        """The aim, and the margin of each condition, before and after."""
        to = self._printed(units)
        names = [self.aim.text, *(f"margin of {c.text}" for c in self.conditions)]
        both = zip(names, self._kinds, self._sizes(self.before), self._sizes(self.after), strict=True)
        return [row_of(to, *each) for each in both]

    def _printed(self, units: UnitChoice) -> Printed:
        return scale_for(None if units == "SI" else self.mechanism.units, {})

    @property
    def words(self) -> str:
        """Sentence on the reliability of the result."""
        if not self.feasible:
            return "No design meets every condition; this one violates them least."
        return f"{self.found} of the {self.polished} best of {self.started} starts converged to this design."

    # as an answer

    def basis(self) -> dict[str, str]:
        """Title, source, and what the analyses rest on."""
        return super().basis() | self.after.assumptions

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """The objective, and the margin of each condition, over the cycle before and after."""
        for drive in self.after.drives:
            kind = drive_kinds(self.after, drive)["position"]
            yield Column(f"drive.{drive}", kind, self.sampled(self.after, self.after.drive_position(drive)))
        for side, r in (("before", self.before), ("after", self.after)):
            for name, of in (
                (self.aim.of, self.aim.of),
                *((f"margin of {c.text}", c.margin) for c in self.conditions),
            ):
                for part, values in parts(self.values_of(r, of)):
                    yield Column(f"{side}.{name}{part}", self.kind_of(of), values)

    def record(self, to: Scale) -> Tree:
        """Numbers before and after with their bounds, the aim, the margins of conditions, and how sure it is."""
        columns = zip(self.numbers, self.kinds, self.nominal, self.values, *self.bounds.T, strict=True)
        names = ("before", "after", "from", "to")
        numbers = {n: dict(zip(names, (to(kind, v) for v in of), strict=True)) for n, kind, *of in columns}
        sizes = zip(*(self._sizes(r) for r in (self.before, self.after)), strict=True)
        of = [self.aim.text, *(c.text for c in self.conditions)]
        both = [
            {name: to(kind, v) for name, v in zip(names, pair, strict=False)}
            for kind, pair in zip(self._kinds, sizes, strict=True)
        ]
        out = {
            "feasible": self.feasible,
            "alike": self.found,
            "polished": self.polished,
            "started": self.started,
        }
        margins = dict(zip(of[1:], both[1:], strict=True))
        return {"optimum": {"numbers": numbers, "aim": {"of": of[0], **both[0]}, "margin": margins, **out}}

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterator[Part]:
        """Before and after, and how sure it is."""
        yield TextTable(["", "before", "after", "from", "to"], self.number_rows(units))
        yield TextTable(["", "before", "after"], self.aim_rows(units))
        yield self.words

    def drawings(self, notation: Notation | None = None) -> list[Scene]:
        """The objective over the cycle, and the designs before and after."""
        from dalembert.reports.machine_sections.optimum_section import optimum_scenes

        return optimum_scenes(self, notation)

    def sheet(self, notation: Notation | None = None) -> ReportSheet:
        """Numbers, the aim and its conditions, before and after, and the drawings."""
        from dalembert.reports.machine_sections.optimum_section import optimum_sheet

        return optimum_sheet(self, notation)


def row_of(to: Printed, name: str, kind: str, *values: float) -> list[str]:
    """A name with the unit of its kind, and numbers in that unit."""
    unit = to.text(kind)
    return [f"{name} [{unit}]" if unit not in ("", "1") else name, *(to.number(kind, v) for v in values)]
