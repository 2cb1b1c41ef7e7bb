"""An aim and conditions over numbers in a box: values and gradients for many designs at once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from dalembert.analysis.batch.compiled_kernel import Kernel, compile  # noqa: A004
from dalembert.analysis.batch.tracing.symbolic_model import numbers
from dalembert.analysis.result.named_quantities import file_paths, quantity
from dalembert.analysis.result.result import Result
from dalembert.analysis.solution import solve
from dalembert.arrays import Array, Flags
from dalembert.errors import ModelError, errors_at
from dalembert.machine.bearings.compiled_life import life_expression
from dalembert.machine.motion.many.along_motions import AlongMotions
from dalembert.machine.motion.many.simulation_plan import SimulationPlan
from dalembert.model import AtPositions, Mechanism
from dalembert.model.paths import reached
from dalembert.optimization.aims import Aim, Constraint
from dalembert.optimization.cycle_expressions import CycleExpressions, cycle_tree, has_reductions, is_single
from dalembert.optimization.one_by_one import Function, OneByOne, analysed_names, value_of
from dalembert.optimization.optimizers import DEFAULT

WEIGHT = 100.0
"""Weight of the mean square of a violated condition, over its usual size, relative to the aim over its
initial value."""


class AimValue(NamedTuple):
    """Aim of many designs over its initial value with its gradient, and the penalties of violated
    conditions on both."""

    value: Array  # (design,), infinite where there is no answer
    slope: Array  # (design, number)


class Margins(NamedTuple):
    """Aim's quantity (P,) and margins (condition, P) of one design, with their gradients in a last axis."""

    aim: Array
    aim_slope: Array
    margin: Array
    margin_slope: Array


@dataclass(frozen=True)
class DesignProblem:
    """An aim and conditions of a mechanism over numbers in a box; its designs are points u of the unit box."""

    mechanism: Mechanism
    vary: tuple[str, ...]
    low: Array
    high: Array
    aim: Aim
    conditions: tuple[Constraint, ...]
    positions: Array
    static: bool = False
    method: str = DEFAULT
    requested: AtPositions = None
    functions: Mapping[str, Function] = field(default_factory=dict)
    motion: SimulationPlan | None = None

    def check(self) -> None:
        """Raises ModelError, with its key, where the aim or a condition is not valid for this mechanism."""
        with errors_at("least"):
            self._check_kinds(self.aim.of)
            if not self.one_by_one:
                self._check_depends()
        for k, condition in enumerate(self.conditions):
            with errors_at("where", k):
                self._check_kinds(condition.margin)
                if self.is_plain(condition):
                    self._catalogue.nodes(condition.margin)

    def _check_depends(self) -> None:
        """Raises ModelError for a vector, and for an aim that the numbers do not change."""
        plain = self.is_plain(self.aim)
        name = self.aim.of if plain else self.aim.number
        kernel = self.smooth if plain else self.cycle.kernel
        assert isinstance(kernel, Kernel)
        if plain and len(kernel.nodes[name]) > 1:
            raise ModelError(f"{name} is a vector", f"write {name}.x or .magnitude")
        rates = [kernel.rates[n][0] for n in ([name] if plain else self.cycle.names(name))]
        if all(rate is rate.graph.zero for of in rates for rate in of):
            what = f"{self.aim.of} does not depend on the varied numbers"
            raise ModelError(what, "vary others, or name another output")

    @property
    def _catalogue(self) -> Any:
        kernel = self.smooth if self.is_plain(self.aim) else self.cycle.kernel
        assert isinstance(kernel, Kernel)
        return kernel.trace.catalogue

    @cached_property
    def one_by_one(self) -> bool:
        """True if designs are analysed one by one, as some quantity is not compiled, or is a Python function."""
        named = {x for text in (self.aim.of, *self.margins) for x in analysed_names(text)}
        lives = {of for word, of in named if word == "life"}
        if self.motion or self.functions or self.lives.keys() != lives:
            return True
        sized = sorted(f"{word}.{of}" for word, of in named if word != "life")
        try:
            if sized:
                self.kernel(sized, None)
        except ModelError:
            return True
        return False

    @cached_property
    def lives(self) -> dict[str, str]:
        """Joint -> the life of its bearing as an expression of compiled quantities, of those named that have one."""
        joints = {
            of for t in (self.aim.of, *self.margins) for word, of in analysed_names(t) if word == "life"
        }
        paths = [
            place for n in numbers(self.mechanism, self.vary) for place in reached(self.mechanism, n.path)
        ]
        if not joints or any(place.startswith("drives.") for place in paths):
            return {}
        known = {n: life_expression(self.nominal_answer, n) for n in joints & self.mechanism.joints.keys()}
        return {n: text for n, text in known.items() if text}

    def is_plain(self, of: Aim | Constraint) -> bool:
        """True if the kernel computes an aim or a condition itself."""
        text = of.of if isinstance(of, Aim) else of.margin
        return of.plain and not self.one_by_one and all(word != "life" for word, _ in analysed_names(text))

    def _check_kinds(self, text: str) -> None:
        """Raises ModelError for unknown names and unlike quantities, where a kernel does not know all kinds."""
        if text in self.functions:
            value_of(self.nominal_answer, text, self.functions)
        elif has_reductions(text) or self.one_by_one:
            cycle_tree(text, self.nominal_answer)
        elif file_paths(self.mechanism, text):
            quantity(self.nominal_answer, text)

    @cached_property
    def nominal_answer(self) -> Result:
        return self.answer_of(self.mechanism)

    def answer_of(self, m: Mechanism) -> Result:
        """The analysis of a design, along its motion if forces move it."""
        return self.motion.of(m).result if self.motion else solve(m, self.static, self.requested)

    def kernel(self, outputs: Sequence[str], reduce: str | None) -> Kernel:
        return compile(self.mechanism, self.vary, list(outputs), reduce, derivatives=True, static=self.static)

    @cached_property
    def smooth(self) -> Kernel:
        """Kernel of the aim, with a peak replaced by a smooth approximation."""
        return self.kernel([self.aim.of], "norm8" if self.aim.word == "peak" else self.aim.word)

    @cached_property
    def exact(self) -> Kernel:
        """Kernel of the aim itself."""
        return self.kernel([self.aim.of], self.aim.word)

    @cached_property
    def broken(self) -> Kernel:
        """Mean squares of the violations of conditions without reductions."""
        return self.kernel([f"max(0, -({c.margin}))^2" for c in self.conditions if self.is_plain(c)], "mean")

    @cached_property
    def rows(self) -> Kernel:
        """All quantities without reductions at every position."""
        return self.kernel(list(dict.fromkeys(self._plain)), None)

    @cached_property
    def cycle(self) -> CycleExpressions:
        """The aim and the conditions that have reductions inside."""
        of, number = self.aim.of, self.aim.of if self.aim.of in self.functions else self.aim.number
        texts = [] if self.is_plain(self.aim) else [of, number]
        texts += [c.margin for c in self.conditions if not self.is_plain(c)]
        lives = {} if self.one_by_one else {f"life.{n}": text for n, text in self.lives.items()}
        return CycleExpressions.of(texts, self.nominal_answer, self._leaves, self.functions, lives)

    def _leaves(self, names: Sequence[str]) -> Kernel | OneByOne | AlongMotions:
        """Quantities at every position."""
        if not self.one_by_one:
            return self.kernel(names, None)
        paths = tuple(n.path for n in numbers(self.mechanism, self.vary))
        box = self.low, self.high
        if self.motion is not None:
            return AlongMotions(self.mechanism, paths, *box, tuple(names), self.motion)
        return OneByOne(
            self.mechanism,
            paths,
            *box,
            outputs=tuple(names),
            functions=self.functions,
            static=self.static,
            requested=self.requested,
            nominal=self.nominal_answer,
        )

    @property
    def _plain(self) -> list[str]:
        return [self.aim.of] * self.is_plain(self.aim) + [
            c.margin for c in self.conditions if self.is_plain(c)
        ]

    @property
    def _has_cycle(self) -> bool:
        return not (self.is_plain(self.aim) and all(map(self.is_plain, self.conditions)))

    @property
    def margins(self) -> list[str]:
        return [c.margin for c in self.conditions]

    @property
    def span(self) -> Array:
        return self.high - self.low

    @cached_property
    def nominal(self) -> Array:
        """Numbers of the description as a point of the unit box."""
        wide = np.where(self.span > 0, self.span, 1.0)
        here = np.array([n.value for n in numbers(self.mechanism, self.vary)])
        return np.clip((here - self.low) / wide, 0.0, 1.0)

    def numbers(self, u: Array) -> Array:
        return np.asarray(self.low + u * self.span)

    @cached_property
    def scale(self) -> float:
        """Usual size of the aim's quantity: its root mean square at the description's numbers."""
        aims = self.at(self.nominal).aim
        return (float(np.sqrt(np.nanmean(aims**2))) or 1.0) if np.isfinite(aims).any() else 1.0

    @cached_property
    def sizes(self) -> Array:
        """Usual size of each margin, at the description's numbers."""
        margins = self.at(self.nominal).margin
        return np.array([np.nanmax(np.abs(m), initial=0.0) or 1.0 for m in margins])

    @property
    def rows_of_margins(self) -> Flags:
        """True (condition, P) for each margin once: at every position, or at the first where it is of the cycle."""
        first = np.arange(len(self.positions)) == 0
        single = [m in self.functions or is_single(m) for m in self.margins]
        return np.array([first | (not one) for one in single], bool).reshape(-1, len(first))

    def __call__(self, u: Array) -> AimValue:
        """The aim and the penalties of violated conditions, for many points (design, number)."""
        values = self.numbers(u)
        value, slope = self.aims(values, smooth=True)
        value, slope = value / self.scale, slope / self.scale
        for size, lack in zip(self.sizes if self.conditions else (), self.violations(values), strict=True):
            value = value + WEIGHT / size**2 * lack.value
            slope = slope + WEIGHT / size**2 * lack.slope
        slope = slope * self.span
        ok = np.isfinite(value) & np.isfinite(slope).all(axis=1)
        return AimValue(np.where(ok, value, np.inf), np.where(ok[:, None], slope, 0.0))

    def aims(self, values: Array, smooth: bool = False) -> AimValue:
        """The aim alone of many designs, and its gradient; ``smooth`` takes norm8 for a peak."""
        if self.is_plain(self.aim):
            r = (self.smooth if smooth else self.exact)(values, self.positions, redo=False)
            return AimValue(r.value(self.aim.of), r.gradient(self.aim.of))
        name = self.aim.of if self.aim.of in self.functions else self.aim.number
        of = self.cycle(values, self.positions, [name], smooth, redo=False)[name]
        return AimValue(of.value[:, 0], of.slope[:, 0])

    def violations(self, values: Array) -> list[AimValue]:
        """Mean squares of the violations of each condition of many designs, with their gradients."""
        texts = [c.margin for c in self.conditions if not self.is_plain(c)]
        margins = self.cycle(values, self.positions, texts, redo=False) if texts else {}
        b = self.broken(values, self.positions, redo=False) if len(texts) < len(self.conditions) else None
        out, plain = [], iter(self.broken.outputs if b else ())
        for c in self.conditions:
            if b and self.is_plain(c):
                name = next(plain)
                out.append(AimValue(b.value(name), b.gradient(name)))
            else:
                margin = margins[c.margin]
                lack = np.minimum(margin.value, 0.0)
                slope = 2 * (lack[..., None] * margin.slope).mean(axis=1)
                out.append(AimValue((lack**2).mean(axis=1), slope))
        return out

    def at(self, u: Array) -> Margins:
        """Quantity and margins at every position of one design; NaN where unsolved."""
        numbers, count, n = self.numbers(u[None]), len(self.positions), len(self.low)
        parts: dict[str, tuple[Array, Array]] = {}
        if self._plain:
            r = self.rows(numbers, self.positions, threads=1)
            parts = {name: (r.value(name)[0], r.gradient(name)[0]) for name in self._plain}
        if self._has_cycle:
            for name, of in self.cycle(numbers, self.positions, threads=1).items():
                slope = np.broadcast_to(of.slope[0], (count, n))
                parts[name] = np.broadcast_to(of.value[0], count), slope
        return Margins(
            parts[self.aim.of][0],
            parts[self.aim.of][1] * self.span,
            np.array([parts[m][0] for m in self.margins]).reshape(-1, count),
            np.array([parts[m][1] * self.span for m in self.margins]).reshape(-1, count, n),
        )

    def sharp(self, u: Array) -> tuple[float, Array]:
        """Exact aim of one design, with the gradient at the position of its peak; infinite where unsolved."""
        from dalembert.analysis.batch.over_positions import reduce_positions, slope

        rows = self.at(u)
        if not np.isfinite(rows.aim).all():
            return np.inf, np.zeros(len(u))
        if not self.aim.word:
            return float(rows.aim[0]), rows.aim_slope[0]
        value = reduce_positions(self.aim.word, rows.aim[:, None])
        return float(value[0]), slope(self.aim.word, rows.aim[:, None], rows.aim_slope[:, None, :])[0]
