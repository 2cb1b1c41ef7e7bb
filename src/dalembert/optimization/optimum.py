"""What an optimisation found, before and after, as a person reads it and as a model file."""

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
    """The best design that was found; ``values`` (number,) in SI in the order of ``numbers``.

    before, after: the analyses of the description as it was and of ``mechanism``. value: the aim, SI. found: how many
    of the polished starts came within a thousandth of the best, of ``polished``; started: those that had an answer.
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
        """The aim of the design found, SI."""
        return self._sizes(self.after)[0]

    @property
    def value_before(self) -> float:
        """The aim of the description as it was, SI; NaN where some position has no answer."""
        return self._sizes(self.before)[0]

    def save(self, path: str | os.PathLike[str], overwrite: bool = False) -> None:
        """Write the mechanism found as a model file, in the author's text where it came from one."""
        self.mechanism.save(path, overwrite)

    def size_of(self, aim: Aim, r: Result | None = None) -> float:
        """Any aim of the design found, or of another result, SI."""
        from dalembert.analysis.batch.over_positions import reduce_positions

        values = (self.after if r is None else r)[aim.of]
        return float(reduce_positions(aim.word, values)) if len(values) else np.nan

    def aim_text(self, text: str) -> str:
        """An aim of the design found, in words, in the unit of the file."""
        aim, to = parse_aim(text), Printed(self.mechanism.units)
        return to.quantity(quantity(self.after, aim.of).kind, self.size_of(aim))

    def _sizes(self, r: Result) -> list[float]:
        return [self.size_of(self.aim, r), *(float(r[c.margin].min()) for c in self.conditions)]

    def number_rows(self) -> list[list[str]]:
        """Name with unit of each number, before, after, and its bounds, in the units of the file."""
        columns = zip(self.numbers, self.kinds, self.nominal, self.values, *self.bounds.T, strict=True)
        return [self._row(name, kind, *values) for name, kind, *values in columns]

    def aim_rows(self) -> list[list[str]]:
        """The aim, and the room that each condition has left, before and after."""
        names = [f"{self.aim.word} {self.aim.of}", *(f"room of {c.text}" for c in self.conditions)]
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
        """How sure it is."""
        if not self.feasible:
            return "No design was found that keeps every condition; this one lacks least."
        return f"{self.found} of the {self.polished} best of {self.started} starts came to this design."

    def __str__(self) -> str:
        """Before and after, in the units of the file."""
        heads = ["", "before", "after"]
        tables = [table([*heads, "from", "to"], self.number_rows()), table(heads, self.aim_rows())]
        return "\n\n".join([*tables, wrap(self.words)])
