"""Aims and conditions as texts, `peak effort.O2` and `transmission.B >= 33 deg`, for many designs at once."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from dalembert.analysis.batch.compiled_kernel import Kernel, compile  # noqa: A004
from dalembert.analysis.result.named_quantities import file_paths, quantity
from dalembert.analysis.result.result import Result
from dalembert.analysis.solution import solve
from dalembert.arrays import Array, Flags
from dalembert.errors import ModelError, errors_at
from dalembert.model import AtPositions, Mechanism
from dalembert.model.quantities.expression_trees import REDUCTIONS
from dalembert.optimization.cycle_expressions import (
    CycleExpressions,
    cycle_tree,
    has_quantities,
    has_reductions,
    is_single,
    whole_call,
)
from dalembert.optimization.optimizers import DEFAULT
from dalembert.wording import closest

KERNEL = ("peak", "mean", "rms", "norm8")
"""Reductions of an aim inside the kernel; the others, and sums of some, follow from the values at all positions."""

WEIGHT = 100.0
"""Weight of the mean square of a violated condition, over its usual size, relative to the aim over its
initial value."""


class Aim(NamedTuple):
    """Objective to minimize: a reduction of an expression of outputs, or an expression of reductions and no word."""

    word: str
    of: str

    @property
    def text(self) -> str:
        """The aim as it is written."""
        return f"{self.word} {self.of}".strip()

    @property
    def number(self) -> str:
        """The aim as an expression with one value for a cycle."""
        return f"{self.word}({self.of})" if self.word else self.of

    @property
    def plain(self) -> bool:
        """True if the kernel reduces it."""
        return bool(self.word) and not has_reductions(self.of)


class Constraint(NamedTuple):
    """Constraint at every position: an expression that must not be negative."""

    text: str
    margin: str

    @property
    def plain(self) -> bool:
        """True if the kernel computes it at every position."""
        return not has_reductions(self.margin)


def parse_aim(text: str) -> Aim:
    """An aim from its text; without a reduction, the peak is meant.

    >>> parse_aim("rms shaking_force.x"), parse_aim("effort.O2").word
    (Aim(word='rms', of='shaking_force.x'), 'peak')
    >>> parse_aim("peak(effort.O2) + 0.1 m*range(reaction.A.x)").word
    ''
    """
    word, of = _first_word(text)
    if not of:
        raise ModelError(f"{text!r} is not an aim", "write one like peak effort.O2")
    if not word:
        word, of = ("", of) if is_single(of) else ("peak", of)
        call, inner = whole_call(of)
        word, of = (call, inner) if call in KERNEL else (word, of)
    return Aim(word, of) if word in KERNEL else Aim("", f"{word}({of})" if word else of)


def _first_word(text: str) -> tuple[str, str]:
    """The reduction at the beginning of a text, empty if none, and the expression after it."""
    word, _, rest = text.strip().partition(" ")
    if word in REDUCTIONS and not rest.lstrip().startswith("("):
        if has_reductions(rest):
            what = f"{text.strip()!r} has a reduction beside {word!r}, and it is open where this one ends"
            raise ModelError(what, f"write {word}(...), with brackets")
        return word, rest.strip()
    if re.fullmatch(r"[a-z]\w*", word) and re.match(r"[a-z]+\.", rest.strip()):
        raise ModelError(
            f"{text!r} begins with {word!r}, which is not an aim", closest(word, list(REDUCTIONS))
        )
    return "", text.strip()


def parse_condition(text: str) -> Constraint:
    """A condition at every position: two expressions with >= or <= between. A reduction, `range(slide.G)` or `rms X`,
    is one number of the cycle; `peak X` that is bounded above by one is bounded at every position, in both signs.

    >>> parse_condition("transmission.B >= 33 deg").margin
    '(transmission.B) - (33 deg)'
    >>> parse_condition("peak effort.O2 <= 3 N*m").margin
    '(3 N*m) - (abs(effort.O2))'
    >>> parse_condition("range(slide.G) >= 60 mm").margin
    '(range(slide.G)) - (60 mm)'
    """
    parts = re.split(r"\s*(>=|<=|>|<|=)\s*", _within_brackets(text.strip()))
    if len(parts) != 3 or parts[1] == "=" or not (parts[0] and parts[2]):
        raise ModelError(
            f"{text!r} is not a condition", "write one with a single >= or <=, like transmission.B >= 33 deg"
        )
    left, sign, right = (part.translate(SHOWN) for part in parts)
    big, small = map(_side, (left, right) if sign[0] == ">" else (right, left))
    above = _at_every_position(big, {"least": ""}) if not has_quantities(small) else big
    below = _at_every_position(small, {"peak": "abs", "greatest": ""}) if not has_quantities(big) else small
    return Constraint(text.strip(), f"({above}) - ({below})")


HIDDEN, SHOWN = str.maketrans("<>=", "\x01\x02\x03"), str.maketrans("\x01\x02\x03", "<>=")
"""Signs of comparisons within brackets, which do not divide a condition."""


def _within_brackets(text: str) -> str:
    """The text with the comparisons within its brackets hidden."""
    out, depth = "", 0
    for sign in text:
        depth += (sign == "(") - (sign == ")")
        out += sign.translate(HIDDEN) if depth > 0 else sign
    return out


def _side(text: str) -> str:
    """One side of a condition, its reduction with brackets."""
    word, of = _first_word(text)
    return f"{word}({of})" if word else of


def _at_every_position(text: str, functions: Mapping[str, str]) -> str:
    """A reduction that is bounded by one number as what is bounded so at every position."""
    word, inner = whole_call(text)
    if word not in functions:
        return text
    return f"{functions[word]}({inner})" if functions[word] else inner


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

    def check(self) -> None:
        """Raises ModelError, with its key, where the aim or a condition is not valid for this mechanism."""
        with errors_at("least"):
            self._check_kinds(self.aim.of)
            name, kernel = (
                (self.aim.of, self.smooth) if self.aim.plain else (self.aim.number, self.cycle.kernel)
            )
            if self.aim.plain and len(kernel.nodes[name]) > 1:
                raise ModelError(f"{name} is a vector", f"write {name}.x or .magnitude")
            rates = [kernel.rates[n][0] for n in ([name] if self.aim.plain else self.cycle.names(name))]
            if all(rate is rate.graph.zero for of in rates for rate in of):
                what = f"{self.aim.of} does not depend on the varied numbers"
                raise ModelError(what, "vary others, or name another output")
        for k, condition in enumerate(self.conditions):
            with errors_at("where", k):
                self._check_kinds(condition.margin)
                if condition.plain:
                    kernel.trace.catalogue.nodes(condition.margin)

    def _check_kinds(self, text: str) -> None:
        """Raises ModelError for unknown names and unlike quantities, where a kernel does not know all kinds."""
        if has_reductions(text):
            cycle_tree(text, self.nominal_answer)
        elif file_paths(self.mechanism, text):
            quantity(self.nominal_answer, text)

    @cached_property
    def nominal_answer(self) -> Result:
        return solve(self.mechanism, self.static, self.requested)

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
        return self.kernel([f"max(0, -({c.margin}))^2" for c in self.conditions if c.plain], "mean")

    @cached_property
    def rows(self) -> Kernel:
        """All quantities without reductions at every position."""
        return self.kernel(list(dict.fromkeys(self._plain)), None)

    @cached_property
    def cycle(self) -> CycleExpressions:
        """The aim and the conditions that have reductions inside."""
        texts = [] if self.aim.plain else [self.aim.of, self.aim.number]
        texts += [c.margin for c in self.conditions if not c.plain]
        return CycleExpressions.of(texts, self.nominal_answer, lambda names: self.kernel(names, None))

    @property
    def _plain(self) -> list[str]:
        return [self.aim.of] * self.aim.plain + [c.margin for c in self.conditions if c.plain]

    @property
    def _has_cycle(self) -> bool:
        return not (self.aim.plain and all(c.plain for c in self.conditions))

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
        kernel = self.smooth if self.aim.plain else self.cycle.kernel
        return np.clip((kernel.nominal - self.low) / wide, 0.0, 1.0)

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
        return np.array([first | (not is_single(m)) for m in self.margins], bool).reshape(-1, len(first))

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
        if self.aim.plain:
            r = (self.smooth if smooth else self.exact)(values, self.positions, redo=False)
            return AimValue(r.value(self.aim.of), r.gradient(self.aim.of))
        of = self.cycle(values, self.positions, [self.aim.number], smooth, redo=False)[self.aim.number]
        return AimValue(of.value[:, 0], of.slope[:, 0])

    def violations(self, values: Array) -> list[AimValue]:
        """Mean squares of the violations of each condition of many designs, with their gradients."""
        texts = [c.margin for c in self.conditions if not c.plain]
        margins = self.cycle(values, self.positions, texts, redo=False) if texts else {}
        b = self.broken(values, self.positions, redo=False) if len(texts) < len(self.conditions) else None
        out, plain = [], iter(self.broken.outputs if b else ())
        for c in self.conditions:
            if b and c.plain:
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
