"""Aims and conditions as texts, `peak effort.O2` and `transmission.B >= 33 deg`, for many designs at once."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from dalembert.analysis.batch.compiled_kernel import Kernel, compile  # noqa: A004
from dalembert.arrays import Array
from dalembert.errors import ModelError, errors_at
from dalembert.model import AtPositions, Mechanism
from dalembert.optimization.optimizers import DEFAULT
from dalembert.wording import closest

WORDS = ("peak", "mean", "rms", "norm8")
"""Reductions of a quantity over the cycle: its largest magnitude, its mean, root mean square, a smooth peak."""

WEIGHT = 100.0
"""Weight of the mean square of a violated condition, over its usual size, relative to the aim over its
initial value."""


class Aim(NamedTuple):
    """Objective to minimize: a reduction of an expression of outputs."""

    word: str
    of: str


class Constraint(NamedTuple):
    """Constraint at every position: an expression that must not be negative."""

    text: str
    margin: str


def parse_aim(text: str) -> Aim:
    """An aim from its text; without a word for the reduction, the peak is meant.

    >>> parse_aim("rms shaking_force.x"), parse_aim("effort.O2").word
    (Aim(word='rms', of='shaking_force.x'), 'peak')
    """
    word, of = _first_word(text)
    if not of:
        raise ModelError(f"{text!r} is not an aim", "write one like peak effort.O2")
    return Aim(word or "peak", of)


def _first_word(text: str) -> tuple[str, str]:
    """The word of ``WORDS`` at the beginning of a text, empty if none, and the expression after it."""
    word, _, rest = text.strip().partition(" ")
    if word in WORDS:
        return word, rest.strip()
    if re.fullmatch(r"[a-z]\w*", word) and re.match(r"[a-z]+\.", rest.strip()):
        raise ModelError(f"{text!r} begins with {word!r}, which is not an aim", closest(word, list(WORDS)))
    return "", text.strip()


def parse_condition(text: str) -> Constraint:
    """A condition at every position: two expressions with >= or <= between; `peak X` is bounded above, in both signs.

    >>> parse_condition("transmission.B >= 33 deg").margin
    '(transmission.B) - (33 deg)'
    >>> parse_condition("peak effort.O2 <= 3 N*m").margin
    '(3 N*m) - (abs(effort.O2))'
    """
    parts = re.split(r"\s*(>=|<=|>|<|=)\s*", text.strip())
    if len(parts) != 3 or parts[1] == "=" or not (parts[0] and parts[2]):
        raise ModelError(
            f"{text!r} is not a condition", "write one with a single >= or <=, like transmission.B >= 33 deg"
        )
    left, sign, right = parts
    big, small = map(_first_word, (left, right) if sign[0] == ">" else (right, left))
    if big[0] == "peak":
        raise ModelError(f"{text!r}: a peak can only have an upper bound", "use <=, or leave peak out")
    word = next((word for word, _ in (big, small) if word not in ("", "peak")), "")
    if word:
        raise ModelError(
            f"{text!r} bounds a {word}", "a condition holds at every position: leave it out, or write peak"
        )
    below = f"abs({small[1]})" if small[0] else small[1]
    return Constraint(text.strip(), f"({big[1]}) - ({below})")


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
            rates = self.smooth.rates[self.aim.of]
            if len(rates) > 1:
                raise ModelError(f"{self.aim.of} is a vector", f"write {self.aim.of}.x or .magnitude")
            if all(rate is rate.graph.zero for rate in rates[0]):
                what = f"{self.aim.of} does not depend on the varied numbers"
                raise ModelError(what, "vary others, or name another output")
        for k, condition in enumerate(self.conditions):
            with errors_at("where", k):
                self.smooth.trace.catalogue.nodes(condition.margin)

    def kernel(self, outputs: Sequence[str], reduce: str | None) -> Kernel:
        return compile(self.mechanism, self.vary, list(outputs), reduce, derivatives=True, static=self.static)

    @cached_property
    def smooth(self) -> Kernel:
        """Kernel of the aim, with a peak replaced by a smooth approximation."""
        return self.kernel([self.aim.of], "norm8" if self.aim.word == "peak" else self.aim.word)

    @cached_property
    def broken(self) -> Kernel:
        """Mean squares of the violations of conditions."""
        return self.kernel([f"max(0, -({c.margin}))^2" for c in self.conditions], "mean")

    @cached_property
    def rows(self) -> Kernel:
        """All quantities at every position."""
        return self.kernel(list(dict.fromkeys([self.aim.of, *self.margins])), None)

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
        return np.clip((self.smooth.nominal - self.low) / wide, 0.0, 1.0)

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

    def __call__(self, u: Array) -> AimValue:
        """The aim and the penalties of violated conditions, for many points (design, number)."""
        values = self.numbers(u)
        r = self.smooth(values, self.positions, redo=False)
        value, slope = r.value(self.aim.of) / self.scale, r.gradient(self.aim.of) / self.scale
        if self.conditions:
            b = self.broken(values, self.positions, redo=False)
            for name, size in zip(self.broken.outputs, self.sizes, strict=True):
                value = value + WEIGHT / size**2 * b.value(name)
                slope = slope + WEIGHT / size**2 * b.gradient(name)
        slope = slope * self.span
        ok = np.isfinite(value) & np.isfinite(slope).all(axis=1)
        return AimValue(np.where(ok, value, np.inf), np.where(ok[:, None], slope, 0.0))

    def at(self, u: Array) -> Margins:
        """Quantity and margins at every position of one design; NaN where unsolved."""
        r = self.rows(self.numbers(u[None]), self.positions, threads=1)
        margin = [r.value(m)[0] for m in self.margins]
        slope = [r.gradient(m)[0] * self.span for m in self.margins]
        count, n = len(self.positions), len(self.low)
        return Margins(
            r.value(self.aim.of)[0],
            r.gradient(self.aim.of)[0] * self.span,
            np.array(margin).reshape(-1, count),
            np.array(slope).reshape(-1, count, n),
        )

    def sharp(self, u: Array) -> tuple[float, Array]:
        """Exact aim of one design, with the gradient at the position of its peak; infinite where unsolved."""
        from dalembert.analysis.batch.over_positions import reduce_positions, slope

        rows = self.at(u)
        if not np.isfinite(rows.aim).all():
            return np.inf, np.zeros(len(u))
        value = reduce_positions(self.aim.word, rows.aim[:, None])
        return float(value[0]), slope(self.aim.word, rows.aim[:, None], rows.aim_slope[:, None, :])[0]
