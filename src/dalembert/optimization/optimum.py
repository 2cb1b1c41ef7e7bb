"""What an optimisation found, before and after, as a person reads it and as a model file."""

from __future__ import annotations

import os
from dataclasses import dataclass, field

import numpy as np

from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.analysis.result.named_quantities import quantity
from dalembert.analysis.result.result import Result
from dalembert.arrays import Array
from dalembert.model import Mechanism
from dalembert.optimization.aims import Aim, Condition
from dalembert.printing import number, table, wrap


@dataclass(frozen=True)
class Optimum:
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

    def _sizes(self, r: Result) -> list[float]:
        from dalembert.analysis.batch.over_positions import reduce_positions

        aim = [float(reduce_positions(self.aim.word, r[self.aim.of])) if len(r.status) else np.nan]
        return aim + [float(r[c.margin].min()) for c in self.conditions]

    def __str__(self) -> str:
        """Before and after, in the units of the file."""
        to = Printed(self.mechanism.units)

        def row(name: str, kind: str, *values: float) -> list[str]:
            unit = to.text(kind)
            shown = [number(float(to(kind, v))) for v in values]
            return [f"{name} [{unit}]" if unit not in ("", "1") else name, *shown]

        columns = zip(self.numbers, self.kinds, self.nominal, self.values, *self.bounds.T, strict=True)
        rows = [row(name, kind, *values) for name, kind, *values in columns]
        names = [f"{self.aim.word} {self.aim.of}", *(f"room of {c.text}" for c in self.conditions)]
        kinds = [quantity(self.after, e).kind for e in (self.aim.of, *(c.margin for c in self.conditions))]
        both = zip(names, kinds, self._sizes(self.before), self._sizes(self.after), strict=True)
        judged = [row(*each) for each in both]
        words = f"{self.found} of the {self.polished} best of {self.started} starts came to this design."
        if not self.feasible:
            words = "No design was found that keeps every condition; this one lacks least."
        tables = [table(["", "before", "after", "from", "to"], rows), table(["", "before", "after"], judged)]
        return "\n\n".join([*tables, wrap(words)])
