"""Operations of a trace, evaluated with numpy."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

import numpy as np

from dalembert.arrays import Numeric

EVALUATE: dict[str, Callable[..., Numeric]] = {
    "add": operator.add,
    "sub": operator.sub,
    "mul": operator.mul,
    "neg": operator.neg,
    "inv": lambda a: np.divide(1.0, a),
    "sqrt": np.sqrt,
    "rsqrt": lambda a: np.divide(1.0, np.sqrt(a)),
    "abs": np.abs,
    "sign": np.sign,
    "positive": lambda a: (a > 0) * 1.0,
    "sin": np.sin,
    "cos": np.cos,
    "atan2": np.arctan2,
    "rint": np.rint,
    "max": np.maximum,
    "min": np.minimum,
    "exp": np.exp,
    "log": np.log,
    "asin": np.arcsin,
    "acos": np.arccos,
    "tan": np.tan,
    "detach": lambda a: a,
}
"""Operation by its name."""


def power_by_roots(x: Any, power: float) -> Any:
    """A positive power; a fractional one of a positive value, by square roots, one for each binary digit."""
    out, root, rest = None, x, power - int(power)
    for _ in range(int(power)):
        out = x if out is None else out * x
    while rest:
        root, rest = root.sqrt(), 2 * rest
        if rest >= 1:
            out, rest = root if out is None else out * root, rest - 1
    return out


def not_negative(x: Any, depth: int = 4) -> bool:
    """True if surely not negative, unless NaN; examines a limited number of operations."""
    if x.op == "mul" and x.a is x.b:
        return True
    if x.op == "max" and depth:
        return not_negative(x.a, depth - 1) or not_negative(x.b, depth - 1)
    if x.op in ("mul", "add", "inv") and depth:
        return not_negative(x.a, depth - 1) and (x.b is None or not_negative(x.b, depth - 1))
    return x.op in ("abs", "sqrt", "rsqrt", "positive") or (x.op == "const" and x.value >= 0)
