"""Choices between values, for numbers and for the traced values of the kernel alike.

A traced value has no truth value: a comparison of two is itself a value, 1 where it holds and 0 elsewhere, with ``&``
and ``~`` as for flags. Arrays of traced values have the type object.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from dalembert.arrays import Array, Numeric


def any_traced(*arrays: Array) -> bool:
    """True if any array holds traced values."""
    return any(np.asarray(a).dtype == object for a in arrays)


def above(a: Array, b: Array | float) -> Array:
    """True where a is larger than b."""
    difference = np.subtract(a, b)
    return np.asarray(_POSITIVE(difference) if any_traced(difference) else difference > 0)


def where(test: Array, a: Array | float, b: Array | float) -> Array:
    """a where the test holds, else b."""
    return test * a + (1.0 - test) * b if any_traced(test) else np.where(test, a, b)


def larger(a: Array, b: Array | float) -> Array:
    """The larger of each two."""
    return np.asarray(_LARGER(a, b) if any_traced(a, np.asarray(b)) else np.maximum(a, b))


def sign(a: Array) -> Array:
    """-1, 0 or 1."""
    return np.asarray(_SIGN(a) if any_traced(a) else np.sign(a))


def hypot(a: Array, b: Array) -> Array:
    """Root of the sum of the squares."""
    return np.asarray(_HYPOT(a, b) if any_traced(a, b) else np.hypot(a, b))


def unit(a: Array, b: Array, least: Array) -> tuple[Array, Array, Array]:
    """Components of the unit vector along (a, b), shorter where the vector is below ``least``; and its length."""
    if any_traced(a, b, least):
        x, y, length = (np.asarray(part) for part in _UNIT(a, b, least))
        return x, y, length
    length = np.hypot(a, b)
    over = 1.0 / np.maximum(length, least)
    return a * over, b * over, length


def root(a: Array) -> Array:
    """Square root."""
    return np.asarray(_ROOT(a) if any_traced(a) else np.sqrt(a))


def tangent(a: Array) -> Array:
    """Tangent of each angle."""
    return np.asarray(_TANGENT(a) if any_traced(a) else np.tan(a))


def tanh(a: Array) -> Array:
    """Hyperbolic tangent of each; of traced values by doubling, which leaves the relative error as it is."""
    return np.asarray(_TANH(a) if any_traced(a) else np.tanh(a))


def top(a: Array, axes: int) -> Array:
    """Largest value over the last axes, and 0."""
    flat = a.reshape((*a.shape[: a.ndim - axes], -1))
    if not any_traced(a):
        return np.asarray(flat.max(axis=-1, initial=0.0))
    out = np.zeros(flat.shape[:-1], object)
    for k in range(flat.shape[-1]):
        out = larger(flat[..., k], out)
    return out


def _value(x: Numeric, method: str, plain: Callable[[Numeric], Numeric]) -> Numeric:
    return getattr(x, method)() if hasattr(x, method) else plain(x)


_POSITIVE = np.frompyfunc(lambda x: _value(x, "positive", lambda n: float(n > 0)), 1, 1)
_SIGN = np.frompyfunc(lambda x: _value(x, "sign", np.sign), 1, 1)
_ROOT = np.frompyfunc(lambda x: _value(x, "sqrt", np.sqrt), 1, 1)
_TANGENT = np.frompyfunc(lambda x: _value(x, "tan", np.tan), 1, 1)
_LARGER = np.frompyfunc(
    lambda x, y: x.larger(y) if hasattr(x, "larger") else y.larger(x) if hasattr(y, "larger") else max(x, y),
    2,
    1,
)


DOUBLINGS = 8
"""Traced hyperbolic tangent, from its series at 1/256 of the argument: exact to rounding up to 7."""


def _tanh(x: Numeric) -> Numeric:
    part = x * 2.0**-DOUBLINGS
    square = part * part
    value = part * (1 + square * (-1 / 3 + square * (2 / 15 + square * (-17 / 315 + square * (62 / 2835)))))
    for _ in range(DOUBLINGS):
        value = 2.0 * value / (1.0 + value * value)
    return value


_TANH = np.frompyfunc(_tanh, 1, 1)


def _unit(a: Numeric, b: Numeric, least: Numeric) -> tuple[Numeric, Numeric, Numeric]:
    """A single component keeps its sign, whatever its size."""
    if not b:
        return a.sign(), b, abs(a)
    square = a * a + b * b
    over = 1.0 / square.larger(least * least).sqrt()
    return a * over, b * over, square * over


_UNIT = np.frompyfunc(_unit, 3, 3)
_HYPOT = np.frompyfunc(lambda x, y: _value(x * x + y * y, "sqrt", np.sqrt), 2, 1)
