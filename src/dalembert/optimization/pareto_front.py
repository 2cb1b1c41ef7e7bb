"""``da.pareto``: designs of which none is better by one aim without being worse by the other.

The epsilon-constraint method (Haimes, Lasdon and Wismer, 1971): the first aim is minimized while the second stays below
a bound, for some bounds between what the best designs by each aim alone have.

Mechanics: docs/theory.md 11.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.analysis.result.named_quantities import quantity
from dalembert.answer.answer import Drawn, Labelled, Worked
from dalembert.answer.column import Axes, Column, UnitChoice
from dalembert.arrays import Array
from dalembert.bounds import require
from dalembert.errors import ModelError
from dalembert.model import Mechanism, ModelOrPath, as_mechanism
from dalembert.optimization.aims import parse_aim
from dalembert.optimization.optimizers import DEFAULT, METHODS, OPEN, evolve, find_method
from dalembert.optimization.optimizing import Bounds, judge, optimize, optimum_of, problem_of, starts_of
from dalembert.optimization.optimum import Optimum
from dalembert.printing import TextTable

if TYPE_CHECKING:
    from dalembert.printing import Part
    from dalembert.views.notation import Notation
    from dalembert.views.paper.scene import Scene

DEFAULTS = {"starts": 1000, "seed": 0, "positions": None, "static": False}
"""Defaults of `da.optimize`."""
AS_GOOD = 1e-6
"""Relative difference of an aim within which a design counts as equally good."""


@dataclass(frozen=True, eq=False)
class Front(Labelled, Drawn, Worked):
    """Designs from the best by the first aim to the best by the second; ``values`` (design, aim), SI."""

    aims: tuple[str, str]
    designs: tuple[Optimum, ...]
    values: Array

    ROWS = "designs"

    @property
    def described(self) -> Mechanism:
        """The description of the first design."""
        return self.designs[0].mechanism

    def _kinds(self) -> list[str]:
        """Kinds of the two aims."""
        return [quantity(self.designs[0].after, parse_aim(aim).of).kind for aim in self.aims]

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """A row a design: both aims, and its numbers."""
        for aim, kind, values in zip(self.aims, self._kinds(), self.values.T, strict=True):
            yield Column(aim, kind, values)
        first, numbers = self.designs[0], np.stack([o.values for o in self.designs], axis=1)
        for name, kind, values in zip(first.numbers, first.kinds, numbers, strict=True):
            yield Column(name, kind, values)

    def contents(self, units: UnitChoice = "file", **choice: Any) -> Iterator[Part]:
        """Both aims and the numbers of each design."""
        to = Printed(None if units == "SI" else self.described.units)
        kinds = self._kinds()
        rows = [
            [
                *(to.quantity(k, v) for k, v in zip(kinds, both, strict=True)),
                *(r[2] for r in o.number_rows(units)),
            ]
            for o, both in zip(self.designs, self.values, strict=True)
        ]
        yield TextTable([*self.aims, *(row[0] for row in self.designs[0].number_rows(units))], rows)

    def drawings(self, notation: Notation | None = None) -> list[Scene]:
        """The second aim over the first; the first design and the last."""
        from dalembert.reports.machine_sections.optimum_section import front_scenes

        return front_scenes(self, notation)


def pareto(
    mechanism: ModelOrPath,
    vary: Bounds,
    least: Sequence[str],
    where: str | Sequence[str] = (),
    points: int = 7,
    method: str = DEFAULT,
    **options: Any,
) -> Front:
    """A Pareto front between two aims; all else as in `da.optimize`. The designs of a method that computes fronts
    itself, such as ``pymoo.nsga2``, are not polished.

    Raises ModelError where no design meets the conditions.

    >>> import dalembert as da
    >>> front = da.pareto(
    ...     da.four_bar(), {"links.rocker.points.B.0": (0.2, 0.28)},
    ...     ["effort.O2", "reaction.O4.magnitude"], points=3, starts=4,
    ... )
    >>> bool((np.diff(front.values[:, 0]) > 0).all() and (np.diff(front.values[:, 1]) < 0).all())
    True
    """
    mechanism = as_mechanism(mechanism)
    require("points", points)
    if isinstance(least, str) or len(least) != 2:
        raise ModelError(
            "a front is between two aims, of 2 points or more", 'give ["effort.O2", "reaction.A.magnitude"]'
        )
    _, second = map(parse_aim, least)
    name = find_method("pymoo.nsga2" if method == "pymoo" else method, "polish", "search", "front")
    options["method"] = name
    if METHODS[name][0] == "front":
        return _front(least, _evolved(mechanism, vary, least, where, points, {**DEFAULTS, **options}))
    bounded = second.text if second.word == "peak" and second.plain else second.number
    rules = [where] if isinstance(where, str) else list(where)
    ends = [optimize(mechanism, vary, aim, rules, **options) for aim in least]
    high, low = (end.size_of(second) for end in ends)
    between = [
        optimize(mechanism, vary, least[0], [*rules, f"{bounded} <= {float(bound)!r}"], **options)
        for bound in np.linspace(high, low, points)[1:-1]
    ]
    optima = [o for o in (ends[0], *between, ends[1]) if o.feasible]
    return _front(least, optima)


def _front(least: Sequence[str], optima: Sequence[Optimum]) -> Front:
    if not optima:
        raise ModelError("no design meets every condition", "widen the bounds, or leave a condition out")
    values = np.array([[o.size_of(parse_aim(aim)) for aim in least] for o in optima])
    kept = _undominated(values)
    return Front((least[0], least[1]), tuple(optima[k] for k in kept), values[kept])


def _evolved(
    m: Mechanism, vary: Bounds, least: Sequence[str], where: str | Sequence[str], points: int, options: Any
) -> list[Optimum]:
    """Designs at even spacing from a computed front, those that meet every condition."""
    method, positions, static = (options[key] for key in ("method", "positions", "static"))
    p, steps, numbers = problem_of(m, vary, least[0], where, positions, static)
    if not np.isnan(steps).all():
        raise ModelError(f"{method} takes no steps", "give (low, high)", ("vary",))
    aims = [parse_aim(text) for text in least]
    problems = [replace(p, aim=aim) for aim in aims]

    def of(u: Array) -> dict[str, Array]:
        values = p.numbers(u)
        outputs = [each.aims(values).value for each in problems]
        out = {"F": np.nan_to_num(np.stack(outputs, axis=1), nan=OPEN * p.scale)}
        if p.conditions:
            lacks = [np.nan_to_num(lack.value, nan=OPEN) for lack in p.violations(values)]
            out["G"] = np.stack(lacks, axis=1)
        return out

    begun = starts_of(p, options["starts"], options["seed"])
    last = evolve(method, of, 2, len(p.conditions), begun, options["seed"])
    order = last[np.argsort(of(last)["F"][:, 0])]
    some = order[np.unique(np.linspace(0, len(order) - 1, points).round().astype(int))]
    return [optimum_of(p, u, numbers, True, 1, len(some), len(begun)) for u in some if judge(p, u)[0] <= 0]


def _undominated(values: Array) -> list[int]:
    """Non-dominated rows, in the order of the first column."""
    out = list[int]()
    for k in np.lexsort((values[:, 1], values[:, 0])).tolist():
        if not out or values[k, 1] < values[out[-1], 1] * (1 - AS_GOOD):
            out.append(k)
    return out
