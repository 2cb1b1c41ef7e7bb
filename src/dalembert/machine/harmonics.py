"""Harmonics of any output over full turns: y(q) = a_0 + sum of a_k cos k q + b_k sin k q.

Mechanics: docs/theory.md 10.1.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from dalembert.answer.equality import Compared
from dalembert.arrays import Array
from dalembert.bounds import require
from dalembert.errors import ModelError
from dalembert.printing import number

EVEN = 1e-9
"""Part of a step that even positions may be off."""


@dataclass(frozen=True, eq=False)
class Harmonics(Compared):
    """Coefficients (K,) or (K, d) of some orders; a period of several turns has fractional orders.

    ``cosine`` a_k and ``sine`` b_k; the mean of order 0 is in ``cosine``. ``turns``: the period in turns. ``aliasing``:
    the largest change of a coefficient when every other position is left out, a measure of too few positions.
    """

    order: Array
    cosine: Array
    sine: Array
    turns: int
    aliasing: float = field(compare=False)

    @property
    def amplitude(self) -> Array:
        """Size of each order, the sign of the mean left out."""
        return np.hypot(self.cosine, self.sine)

    @property
    def phase(self) -> Array:
        """Angle at which each order is greatest, times its order: a cos(k q - phase), rad."""
        return np.arctan2(self.sine, self.cosine)

    @property
    def forward(self) -> Array:
        """Forward part f_k of a planar vector x + i y = sum f_k e^(ikq), which turns with the drive (K,), complex."""
        return self._turning(1)

    @property
    def backward(self) -> Array:
        """Backward part f_-k (K,), which turns against the drive; 0 for order 0, which is all in ``forward``."""
        return np.where(self.order == 0, 0.0, self._turning(-1))

    def _turning(self, sense: int) -> Array:
        if self.cosine.ndim != 2 or self.cosine.shape[1] != 2:
            raise ModelError(
                "only a vector in the plane has parts that turn", "ask for its components' amplitudes"
            )
        a, b = (c[:, 0] + 1j * c[:, 1] for c in (self.cosine, self.sine))
        return np.where(self.order == 0, a, (a - 1j * sense * b) / 2)


def harmonics(values: Array | Sequence[float], angle: Array, orders: int | Sequence[float] = 4) -> Harmonics:
    """Harmonics of values (P,) or (P, d) at even positions (P,) of an angle, rad, over one or several full turns.

    ``orders``: all up to a number, or those listed; over n turns they come in steps of 1 / n. A sum of harmonics below
    half the number of positions per period is recovered exactly (the discrete Fourier transform). Raises ModelError for
    positions that are uneven, missing, not over full turns, or too few for an order.

    >>> q = np.arange(24) * math.pi / 12
    >>> found = harmonics(3 + 2 * np.cos(2 * q - 0.5), q, orders=[0, 2])
    >>> found.amplitude.round(9), float(found.phase[1].round(9)), found.turns
    (array([3., 2.]), 0.5, 1)
    """
    turns = whole_turns(angle)
    y = np.asarray(values, float)
    if len(y) != len(angle):
        raise ModelError(
            f"{len(y)} values are given for {len(angle)} positions", "give one value per position"
        )
    if not np.isfinite(y).all():
        k = int(np.argmax(~np.isfinite(y.reshape(len(y), -1)).all(axis=1)))
        raise ModelError(
            f"position {k + 1} has no value, and harmonics need them all", "change the range or the machine"
        )
    wanted = _orders(orders, turns, len(y))
    coefficients = _coefficients(y, np.asarray(angle), wanted)
    half = len(y) % 2 == 0 and (wanted < len(y) / turns / 4).all()
    coarse = _coefficients(y[::2], np.asarray(angle)[::2], wanted) if half else np.zeros_like(coefficients)
    aliasing = float(np.abs(coefficients - coarse).max(initial=0.0)) if half else math.nan
    return Harmonics(wanted, coefficients[0], coefficients[1], turns, aliasing)


def whole_turns(angle: Array) -> int:
    """Turns of one period that even positions (P,) cover, each position once; raises ModelError where they do not."""
    q, remedy = np.asarray(angle, float), "write position: {from: 0 deg, to: 360 deg, count: 72}"
    if len(q) < 3 or not np.isfinite(q).all():
        raise ModelError("a period needs at least 3 positions, all of them solved", remedy)
    steps = np.diff(q)
    step = float(q[-1] - q[0]) / (len(q) - 1)
    if not np.allclose(steps, step, rtol=0.0, atol=EVEN * max(1.0, abs(step))) or step == 0:
        least, most = (number(math.degrees(s), 4) for s in (steps.min(), steps.max()))
        raise ModelError(f"the positions are not even: steps of {least} to {most} deg", remedy)
    turned = abs(step) * len(q) / (2 * math.pi)
    if round(turned) == 0 or abs(turned - round(turned)) > EVEN * len(q):
        raise ModelError(
            f"the positions cover {number(360 * turned)} deg, which is not a whole number of turns", remedy
        )
    return round(turned)


def _orders(orders: int | Sequence[float], turns: int, count: int) -> Array:
    """The orders asked for, multiples of one over the turns."""
    if isinstance(orders, Sequence | np.ndarray) and not isinstance(orders, str):
        for order in orders:
            require("order", order)
    else:
        require("orders", orders)
    terms = np.arange(orders * turns + 1) / turns if isinstance(orders, int) else np.array(orders, float)
    steps = terms * turns
    if not np.allclose(steps, np.round(steps)) or (terms < 0).any():
        raise ModelError(
            f"a period of {turns} turn{'s' * (turns > 1)} has no harmonic of each order in {[float(k) for k in terms]}",
            f"its orders are multiples of 1/{turns}" if turns > 1 else "its orders are integers",
        )
    most = float(terms.max(initial=0.0))
    if 2 * most * turns >= count:
        raise ModelError(
            f"order {number(most)} needs more than {number(2 * most * turns)} positions, and there are {count}",
            "give more positions, or ask for lower orders",
        )
    return np.asarray(np.round(steps) / turns)


def _coefficients(y: Array, q: Array, orders: Array) -> Array:
    """Cosine and sine coefficients (2, K, ...)."""
    waves = np.stack([np.cos(np.outer(orders, q)), np.sin(np.outer(orders, q))])
    weight = np.where(orders == 0, 1.0, 2.0) / len(q)
    sums = np.tensordot(waves, y, axes=1)
    return np.asarray(sums * weight.reshape(-1, *[1] * (y.ndim - 1)))
