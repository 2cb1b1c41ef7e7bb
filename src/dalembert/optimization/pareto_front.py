"""``da.pareto``: designs of which none is better by one aim without being worse by the other.

The epsilon-constraint method (Haimes, Lasdon and Wismer, 1971): the first aim is minimized while the second stays below
a bound, for some bounds between what the best designs by each aim alone have.

Mechanics: docs/theory.md 11.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.answer.answer import Drawn, Labelled, Worked
from dalembert.answer.column import Axes, Column, UnitChoice
from dalembert.arrays import Array
from dalembert.bounds import require
from dalembert.errors import ModelError
from dalembert.model import Mechanism, ModelOrPath, as_mechanism
from dalembert.optimization.aims import Aim, parse_aim
from dalembert.optimization.one_by_one import Function, named
from dalembert.optimization.optimizers import DEFAULT, METHODS, OPEN, evolve, find_method
from dalembert.optimization.optimizing import (
    Bounds,
    Rule,
    aim_of,
    judge,
    optimize,
    optimum_of,
    problem_of,
    starts_of,
)
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
    """Designs from the best by the first aim to the best by the second; ``values`` (design, aim), SI.

    >>> import dalembert as da
    >>> aims = ["effort.O2", "reaction.O4.magnitude"]
    >>> vary = {"links.rocker.points.B.0": (0.2, 0.28)}
    >>> front = da.pareto(da.four_bar(), vary, aims, points=3, starts=4)
    >>> front.aims, front.values.shape[1]
    (('peak effort.O2', 'peak reaction.O4.magnitude'), 2)
    """

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
        first = self.designs[0]
        return [first.kind_of(aim if aim in first.functions else parse_aim(aim).of) for aim in self.aims]

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
    least: Sequence[str | Function],
    where: Rule | Sequence[Rule] = (),
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
    rules: list[Any] = [where] if isinstance(where, str) or callable(where) else list(where)
    functions = named([f for f in least if callable(f)])
    aims = [aim_of(aim, functions) for aim in least]
    name = find_method("pymoo.nsga2" if method == "pymoo" else method, "polish", "search", "front")
    options["method"] = name
    if METHODS[name][0] == "front":
        optima = _evolved(mechanism, vary, least, rules, points, {**DEFAULTS, **options})
        return _front(aims, optima, functions)
    ends = [optimize(mechanism, vary, aim, rules, **options) for aim in least]
    high, low = (_with(end, functions).size_of(aims[1]) for end in ends)
    between = [
        optimize(mechanism, vary, least[0], [*rules, _bounded(least[1], aims[1], float(bound))], **options)
        for bound in np.linspace(high, low, points)[1:-1]
    ]
    return _front(aims, [o for o in (ends[0], *between, ends[1]) if o.feasible], functions)


def _bounded(least: str | Function, aim: Aim, bound: float) -> Rule:
    """The condition that an aim is below a bound."""
    if not isinstance(least, str):
        return lambda r: bound - np.asarray(least(r), float)
    text = aim.text if aim.word == "peak" and aim.plain else aim.number
    return f"{text} <= {bound!r}"


def _with(o: Optimum, functions: Mapping[str, Function]) -> Optimum:
    """An optimum that knows the functions of both aims."""
    return replace(o, functions={**o.functions, **functions}) if functions else o


def _front(aims: Sequence[Aim], optima: Sequence[Optimum], functions: Mapping[str, Function]) -> Front:
    if not optima:
        raise ModelError("no design meets every condition", "widen the bounds, or leave a condition out")
    known = [_with(o, functions) for o in optima]
    values = np.array([[o.size_of(aim) for aim in aims] for o in known])
    kept = _undominated(values)
    return Front((aims[0].text, aims[1].text), tuple(known[k] for k in kept), values[kept])


def _evolved(
    m: Mechanism,
    vary: Bounds,
    least: Sequence[str | Function],
    rules: Sequence[Rule],
    points: int,
    options: Any,
) -> list[Optimum]:
    """Designs at even spacing from a computed front, those that meet every condition."""
    method, positions, static = (options[key] for key in ("method", "positions", "static"))
    p, steps, numbers = problem_of(m, vary, least[0], rules, positions, static)
    if not np.isnan(steps).all():
        raise ModelError(f"{method} takes no steps", "give (low, high)", ("vary",))
    functions = {**p.functions, **named([f for f in least if callable(f)])}
    aims = [aim_of(aim, functions) for aim in least]
    problems = [replace(p, aim=aim, functions=functions) for aim in aims]

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
        if not out or values[k, 1] < values[out[-1], 1] - AS_GOOD * abs(values[out[-1], 1]):
            out.append(k)
    return out
