"""Result of an optimization, before and after, as printed text and as a model file."""

from __future__ import annotations

import os
from dataclasses import dataclass, field

import numpy as np

from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.analysis.result.named_quantities import quantity
from dalembert.analysis.result.result import Result
from dalembert.answer.equality import Compared
from dalembert.arrays import Array
from dalembert.model import Mechanism
from dalembert.optimization.aims import Aim, Condition, parse_aim
from dalembert.printing import number, table, wrap


@dataclass(frozen=True, eq=False)
class Optimum(Compared):
    """The best design; ``values`` (number,) in SI in the order of ``numbers``.

    before, after: the analyses of the original description and of ``mechanism``. value: the aim, SI. found: how many
    of the polished starts came within a thousandth of the best, of ``polished``; started: number of starts that could
    be solved.
    """

    mechanism: Mechanism
    numbers: tuple[str, ...]
    values: Array
    nominal: Array
    bounds: Array = field(repr=False)  # (number, 2)
    aim: Aim
    conditions: tuple[Condition, ...]
    before: Result = field(repr=False)
    after: Result = field(repr=False)
    feasible: bool
    found: int
    polished: int
    started: int
    kinds: tuple[str, ...] = field(repr=False)

    @property
    def value(self) -> float:
        """Aim of the best design, SI."""
        return self._sizes(self.after)[0]

    @property
    def value_before(self) -> float:
        """The aim of the original description, SI; NaN where some position has no answer."""
        return self._sizes(self.before)[0]

    def save(self, path: str | os.PathLike[str], overwrite: bool = False) -> None:
        """Writes the best mechanism as a model file, in the author's text if it came from a file."""
        self.mechanism.save(path, overwrite)

    def size_of(self, aim: Aim, r: Result | None = None) -> float:
        """Any aim of the best design, or of another result, SI."""
        from dalembert.analysis.batch.over_positions import reduce_positions

        values = (self.after if r is None else r)[aim.of]
        return float(reduce_positions(aim.word, values)) if len(values) else np.nan

    def aim_text(self, text: str) -> str:
        """An aim of the best design as text, in the unit of the file."""
        aim, to = parse_aim(text), Printed(self.mechanism.units)
        return to.quantity(quantity(self.after, aim.of).kind, self.size_of(aim))

    def _sizes(self, r: Result) -> list[float]:
        return [self.size_of(self.aim, r), *(float(r[c.margin].min()) for c in self.conditions)]

    def number_rows(self) -> list[list[str]]:
        """Name with unit of each number, before, after, and its bounds, in the units of the file."""
        columns = zip(self.numbers, self.kinds, self.nominal, self.values, *self.bounds.T, strict=True)
        return [self._row(name, kind, *values) for name, kind, *values in columns]

    def aim_rows(self) -> list[list[str]]:
        """The aim, and the margin of each condition, before and after."""
        names = [f"{self.aim.word} {self.aim.of}", *(f"margin of {c.text}" for c in self.conditions)]
        kinds = [quantity(self.after, e).kind for e in (self.aim.of, *(c.margin for c in self.conditions))]
        both = zip(names, kinds, self._sizes(self.before), self._sizes(self.after), strict=True)
        return [self._row(*each) for each in both]

    def _row(self, name: str, kind: str, *values: float) -> list[str]:
        to = Printed(self.mechanism.units)
        unit = to.text(kind)
        shown = [number(float(to(kind, v))) for v in values]
        return [f"{name} [{unit}]" if unit not in ("", "1") else name, *shown]

    @property
    def words(self) -> str:
        """Sentence on the reliability of the result."""
        if not self.feasible:
            return "No design meets every condition; this one violates them least."
        return f"{self.found} of the {self.polished} best of {self.started} starts converged to this design."

    def __str__(self) -> str:
        """Before and after, in the units of the file."""
        heads = ["", "before", "after"]
        tables = [table([*heads, "from", "to"], self.number_rows()), table(heads, self.aim_rows())]
        return "\n\n".join([*tables, wrap(self.words)])
