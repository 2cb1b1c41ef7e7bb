"""Quantities that no compiled analysis has, `stress.rod`, `life.A`, and Python functions: designs analysed one by one.

Derivatives are differences of neighbouring designs, from the bound that is farther away.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import numpy as np

from dalembert.analysis.batch.tracing.course import in_mode_of
from dalembert.analysis.result.named_quantities import BOUNDS, quantity
from dalembert.analysis.result.quantity_catalogue import CATALOGUE
from dalembert.analysis.result.result import Result
from dalembert.analysis.solution import solve
from dalembert.arrays import Array
from dalembert.errors import DalembertError, ModelError
from dalembert.machine.design_numbers import READ
from dalembert.model import AtPositions, Mechanism
from dalembert.progress import progress

Function = Callable[[Result], Any]
"""A number, or one for each position (P,), of a result."""
STEP = 1e-6
"""Difference of neighbouring designs, as a fraction of the bounds."""
ANALYSED = re.compile(
    rf"(?<![\w.])({'|'.join(word for word, row in CATALOGUE.items() if not row.compiled or word in READ)}"
    rf"|\w+(?=\.[\w.-]*\.(?:{'|'.join(BOUNDS)})\b))"
    r"\.(\w[\w.-]*)"
)
"""Word and thing of quantities that are not compiled, or not of every machine: also the ends of what friction leaves
open."""


def analysed_names(text: str) -> list[tuple[str, str]]:
    """Word and thing of the quantities in an expression that a kernel may not have.

    >>> analysed_names("stress.rod <= 90 MPa"), analysed_names("effort.O2")
    ([('stress', 'rod')], [])
    """
    return ANALYSED.findall(text)


@dataclass(frozen=True)
class OneByOne:
    """Values of ``outputs`` with their derivatives, where a kernel has none; it is called as one."""

    mechanism: Mechanism
    vary: tuple[str, ...]
    low: Array
    high: Array
    outputs: tuple[str, ...]
    functions: Mapping[str, Function]
    static: bool
    requested: AtPositions
    nominal: Result
    known: dict[bytes, Array] = field(default_factory=dict, repr=False)

    def blocks(self, values: Array, **options: Any) -> Iterator[Any]:
        """One block of all designs (design, number)."""
        count = self._count
        value, slope = np.empty((len(values), len(self.outputs), count)), list[list[Array]]()
        many = progress("Analysing designs", len(values)) if len(values) > 1 else nullcontext(_silent)
        with many as step:
            for d, design in enumerate(np.asarray(values, float)):
                value[d] = here = self.at(design)
                slope.append(self._slope(design, here))
                step(d + 1)
        slopes: Array = np.moveaxis(np.array(slope).reshape(len(values), -1, len(self.outputs), count), 1, -1)
        place = {name: k for k, name in enumerate(self.outputs)}
        yield SimpleNamespace(
            value=lambda name: value[:, place[name]], gradient=lambda name: slopes[:, place[name]]
        )

    def _slope(self, design: Array, here: Array) -> list[Array]:
        """Differences over the steps of each number, of one design with the outputs ``here``."""
        steps = STEP * (self.high - self.low) * np.where(design > (self.low + self.high) / 2, -1.0, 1.0)
        return [
            (self.at(design + steps * one) - here) / steps[k] if steps[k] else 0.0 * here
            for k, one in enumerate(np.eye(len(design)))
        ]

    @property
    def _count(self) -> int:
        return len(self.mechanism.schedule(self.requested).position)

    def at(self, design: Array) -> Array:
        """Outputs (output, P) of one design; NaN where it has no answer."""
        key = design.tobytes()
        if key not in self.known:
            self.known[key] = self._analysed(design)
        return self.known[key]

    def _analysed(self, design: Array) -> Array:
        out = np.full((len(self.outputs), self._count), np.nan)
        try:
            one = self.mechanism.with_values(dict(zip(self.vary, design.tolist(), strict=True)))
            r = solve(in_mode_of(one, self.nominal, self.requested), self.static, self.requested)
        except DalembertError:
            return out
        if len(r.status) == out.shape[1] and r.ok.all():
            for k, name in enumerate(self.outputs):
                out[k] = value_of(r, name, self.functions)
        return out


def _silent(done: int) -> None:
    """Progress of a single design: that of the search it belongs to says more."""


def value_of(r: Result, name: str, functions: Mapping[str, Function]) -> Array:
    """A quantity, or a function, of a result at every position (P,); raises ModelError for a function that gives
    something else."""
    if name not in functions:
        return quantity(r, name).values
    try:
        known = np.asarray(functions[name](r), float)
    except (TypeError, ValueError) as error:
        raise ModelError(f"{name} gives no number: {error}", "return one number, or one a position") from None
    if known.shape not in ((), (len(r.status),)):
        shape = " x ".join(map(str, known.shape))
        raise ModelError(f"{name} gives {shape} numbers", f"return one, or {len(r.status)}, one a position")
    return np.broadcast_to(known, (len(r.status),))


def named(functions: Sequence[Any]) -> dict[str, Function]:
    """Functions by names that expressions may hold: their names, numbered where two are alike."""
    out: dict[str, Function] = {}
    for f in functions:
        name = re.sub(r"\W", "_", getattr(f, "__name__", type(f).__name__)).strip("_") or "function"
        out[name if name not in out else f"{name}_{len(out) + 1}"] = f
    return out
