"""``da.synthesize``: dimensions with which outputs reach given values at given positions of the drives.

A point's path with given or free timing, a function (angle against angle), a motion (a point and an angle): one
problem of least squares. All starts go side by side by Levenberg's and Marquardt's method, with exact derivatives.

Mechanics: docs/theory.md 11.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from dalembert.analysis.batch.checked_input import drive_values
from dalembert.analysis.batch.compiled_kernel import Kernel, compile  # noqa: A004
from dalembert.analysis.batch.tracing.symbolic_model import number_kinds
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.analysis.result.named_quantities import quantity
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.analysis.result.result import Result
from dalembert.analysis.solution import solve
from dalembert.answer.answer import Drawn, Labelled, Remade, Worked
from dalembert.answer.column import Axes, Column, Scale, UnitChoice, parts
from dalembert.arrays import Array, Tree
from dalembert.errors import ModelError
from dalembert.model import Mechanism, ModelOrPath, as_mechanism
from dalembert.optimization.free_timing import FreeTiming
from dalembert.optimization.least_squares import TargetErrors, least_squares, wanted
from dalembert.optimization.optimizing import Bounds, bounds_of, random_places
from dalembert.optimization.optimum import row_of
from dalembert.printing import TextTable, number

if TYPE_CHECKING:
    from dalembert.printing import Part
    from dalembert.views.notation import Notation
    from dalembert.views.paper.scene import Scene

EXACT = 1e-6
"""Rms error over the spread of the targets below which a design counts as meeting them."""


@dataclass(frozen=True, eq=False)
class Synthesis(Labelled, Drawn, Worked, Remade):
    """A mechanism; ``error`` its rms error over the spread of the targets, ``exact`` how many of ``started``
    designs meet them to a millionth. ``values`` (number,) in SI in the order of ``numbers``; ``positions`` (P, D) are
    those of the drives at the targets, computed where the timing is free.

    >>> import dalembert as da
    >>> wanted = {"angle.rocker": [1.65, 1.72, 1.95, 2.27]}
    >>> vary = {"links.crank.points.A.0": (0.06, 0.12)}
    >>> found = da.synthesize(da.four_bar(), vary, wanted, [0.2, 0.9, 1.7, 2.5], starts=2)
    >>> found.values.shape, found.started
    ((1,), 3)
    """

    mechanism: Mechanism
    numbers: tuple[str, ...]
    values: Array
    nominal: Array
    error: float
    exact: int
    started: int
    positions: Array = field(repr=False)
    found: dict[str, Array] = field(repr=False)  # outputs of the design at the targets' positions

    kinds: tuple[str, ...] = field(repr=False)

    @cached_property
    def result(self) -> Result:
        """The analysis of the mechanism at the positions of the targets."""
        return solve(self.mechanism, True, self.positions)

    @property
    def words(self) -> str:
        """Its error."""
        error = number(self.error, 3)
        return f"Rms error {error} of the targets' spread; of {self.started} starts {self.exact} are exact."

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """The drives at the targets, and the outputs at them."""
        for k, drive in enumerate(self.result.drives):
            yield Column(f"drive.{drive}", drive_kinds(self.result, drive)["position"], self.positions[:, k])
        for name, values in self.found.items():
            for part, numbers in parts(values):
                yield Column(f"{name}{part}", quantity(self.result, name).kind, numbers)

    def record(self, to: Scale) -> Tree:
        """Numbers before and after, and how near the outputs come."""
        columns = zip(self.numbers, self.kinds, self.nominal, self.values, strict=True)
        numbers = {n: {"before": to(kind, a), "after": to(kind, b)} for n, kind, a, b in columns}
        out = {"error": self.error, "exact": self.exact, "started": self.started}
        return {"synthesis": {"numbers": numbers, **out}}

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterator[Part]:
        """Numbers before and after, and how near the outputs come."""
        to = Printed(None if units == "SI" else self.mechanism.units)
        columns = zip(self.numbers, self.kinds, self.nominal, self.values, strict=True)
        yield TextTable(["", "before", "after"], [row_of(to, *each) for each in columns])
        yield self.words

    def drawings(self, notation: Notation | None = None) -> list[Scene]:
        """The mechanism at the first target, with the paths of its points."""
        return [self.result.draw(notation=notation)]


def synthesize(
    mechanism: ModelOrPath,
    vary: Bounds,
    targets: Mapping[str, ArrayLike],
    positions: ArrayLike | None = None,
    starts: int = 1000,
    seed: int = 0,
    timing: str = "given",
) -> Synthesis:
    """Numbers within bounds that bring outputs nearest to targets, by least squares over the targets' spread.

    targets: output or expression (`da.compile`) -> its values (P,), of a vector (P, 2), SI and radians, at the
    ``positions`` of the drives (P,) or (P, D), default the file's. With ``timing="free"`` they are unknown too, between
    the first and last of those given, in the order of the targets. The assembly mode is that of the mechanism, and each
    design closes over the full range from the first target to the last. Raises ModelError where shapes do not fit, and
    where no design in the bounds closes at all positions.

    >>> import dalembert as da
    >>> m, turned = da.four_bar(), [0.2, 0.9, 1.7, 2.5]
    >>> wanted = [1.65, 1.72, 1.95, 2.27]
    >>> found = da.synthesize(m, {"links.crank.points.A.0": (0.06, 0.12)}, {"angle.rocker": wanted}, turned, starts=4)
    >>> found.error < 0.5
    True
    """
    mechanism = as_mechanism(mechanism)
    varied, low, high, steps = bounds_of(mechanism, vary)
    if not np.isnan(steps).all():
        raise ModelError("a synthesis takes no steps", "give (low, high)")
    if not targets:
        raise ModelError("no targets are given", 'give targets={"point.coupler.P": [[x, y], ...]}')
    if timing not in ("given", "free"):
        raise ModelError(f"timing is {timing!r}", 'give "given" or "free"')
    k = compile(mechanism, tuple(vary), list(targets), derivatives=True, static=True)
    f = _misfit(k, low, high - low, targets, positions, timing == "free")
    nominal = np.clip((k.nominal - low) / np.where(high > low, high - low, 1.0), 0, 1)
    x, cost = least_squares(f, f.begin(random_places(f.answers, nominal, starts, seed)))
    cost = np.where(f.moves(x), cost, np.inf)
    best = int(np.argmin(cost))
    if not np.isfinite(cost[best]):
        raise ModelError(
            f"none of {len(x):,} designs closes over the full range from the first target to the last",
            "widen the bounds",
        )
    values, place = low + x[best, : len(low)] * (high - low), f.places(x[best])
    error = np.sqrt(2 * cost / len(f.target))
    r = k(values, place)
    design = mechanism.with_values({n.path: float(v) for n, v in zip(varied, values, strict=True)})
    return Synthesis(
        mechanism=k.trace.course.in_mode(design),
        numbers=k.numbers,
        values=values,
        nominal=k.nominal,
        error=float(error[best]),
        exact=int((error < EXACT).sum()),
        started=len(x),
        positions=k.course(place).schedule.position,
        found={name: r.value(name)[0] for name in targets},
        kinds=number_kinds(mechanism, varied),
    )


def _misfit(
    k: Kernel,
    low: Array,
    size: Array,
    targets: Mapping[str, ArrayLike],
    positions: ArrayLike | None,
    free: bool,
) -> TargetErrors:
    """Least-squares problem, with the drives' positions given or free."""
    if free:
        return FreeTiming.of(k, low, size, targets, positions)
    place = None if positions is None else drive_values(k.mechanism, positions)
    count = len(k.course(place).schedule.position)
    return TargetErrors(k, low, size, *wanted(k, targets, count), place)
