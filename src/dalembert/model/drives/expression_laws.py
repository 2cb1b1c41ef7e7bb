"""A law of motion as an expression of time, with its exact speed and acceleration."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model.part import ReadingRules, mapping
from dalembert.model.quantities.expression_trees import COMPARISONS, Apply, Functions, nodes
from dalembert.model.quantities.expressions import Expression
from dalembert.model.quantities.values import (
    NUMBER_OR_TEXT,
    JsonSchema,
    at_item,
    check_sign,
    object_schema,
    value_text,
)
from dalembert.model.quantities.varying import varying, varying_tree
from dalembert.wording import quote_value

EXAMPLE = "law: {expression: 20 mm*sin(2*pi*5 Hz*time)}"
TIME = "time"


@dataclass(frozen=True)
class Jet:
    """A function of time by its value and its first two derivatives, at one instant or several."""

    value: Any
    first: Any = 0.0
    second: Any = 0.0

    def __add__(self, other: Any) -> Jet:
        o = jet(other)
        return Jet(self.value + o.value, self.first + o.first, self.second + o.second)

    __radd__ = __add__

    def __neg__(self) -> Jet:
        return Jet(-self.value, -self.first, -self.second)

    def __sub__(self, other: Any) -> Jet:
        return self + -jet(other)

    def __rsub__(self, other: Any) -> Jet:
        return jet(other) - self

    def __mul__(self, other: Any) -> Jet:
        o = jet(other)
        second = self.second * o.value + 2 * self.first * o.first + self.value * o.second
        return Jet(self.value * o.value, self.first * o.value + self.value * o.first, second)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Jet:
        x = jet(other)
        return self * x.through(1 / x.value, -1 / x.value**2, 2 / x.value**3)

    def __rtruediv__(self, other: Any) -> Jet:
        return jet(other) / self

    def __pow__(self, n: Any) -> Jet:
        n = float(n.value if isinstance(n, Jet) else n)
        x = self.value
        return self.through(
            x**n, n * x ** (n - 1) if n else 0 * x, n * (n - 1) * x ** (n - 2) if n not in (0, 1) else 0 * x
        )

    def through(self, value: Any, slope: Any, bend: Any) -> Jet:
        """A function of it, by its value and derivatives at a point."""
        return Jet(value, slope * self.first, slope * self.second + bend * self.first**2)


def jet(x: Any) -> Jet:
    """A number as a function that does not change."""
    return x if isinstance(x, Jet) else Jet(x)


def _functions() -> Functions:
    import numpy as np

    def through(*parts: Callable[[Any], Any]) -> Callable[[Any], Jet]:
        return lambda x: jet(x).through(*(part(jet(x).value) for part in parts))

    return {
        "sin": through(np.sin, np.cos, lambda x: -np.sin(x)),
        "cos": through(np.cos, lambda x: -np.sin(x), lambda x: -np.cos(x)),
        "tan": through(np.tan, lambda x: 1 + np.tan(x) ** 2, lambda x: 2 * np.tan(x) * (1 + np.tan(x) ** 2)),
        "exp": through(np.exp, np.exp, np.exp),
        "log": through(np.log, lambda x: 1 / x, lambda x: -1 / x**2),
        "sqrt": through(np.sqrt, lambda x: 0.5 / np.sqrt(x), lambda x: -0.25 * x**-1.5),
        "atan": through(np.arctan, lambda x: 1 / (1 + x * x), lambda x: -2 * x / (1 + x * x) ** 2),
    }


@dataclass(frozen=True)
class ExpressionLaw:
    """The position of a drive as an expression of time; ``count`` instants from 0 to ``duration``."""

    expression: Expression
    duration: float = 0.0
    count: int = 1

    def at(self, time: Any) -> Array:
        """Position, speed and acceleration (3, ...) at times."""
        import numpy as np

        t = np.asarray(time, float)
        x = jet(self.expression.at({TIME: Jet(t, np.ones_like(t))}, _functions()))
        return np.array([np.broadcast_to(part, t.shape) for part in (x.value, x.first, x.second)])

    def motion(self, count: int | None = None) -> tuple[Array, Array, Array, Array]:
        """Time, position, speed and acceleration at `count` equal steps, both ends among them."""
        import numpy as np

        t = np.linspace(0.0, self.duration, count or self.count)
        return (t, *self.at(t))

    def tree(self, kind: str) -> dict[str, object]:
        """As a file says it."""
        out = dict(self.expression_tree(kind))
        if self.duration:
            out |= {"duration": value_text(self.duration, "time"), "count": self.count}
        return out

    def expression_tree(self, kind: str) -> Mapping[str, object]:
        """Its expression as a file says it."""
        tree = varying_tree(self.expression, kind)
        return tree if isinstance(tree, Mapping) else {"expression": tree}


def expression_law(value: Mapping[str, object], kind: str, rules: ReadingRules) -> ExpressionLaw:
    """The law of a tree with an expression of time."""
    keys = mapping(value, ["expression", "unit", "duration", "count"], EXAMPLE)
    named = {key: keys[key] for key in ("expression", "unit") if key in keys}
    read = varying(named, kind, rules)
    if not isinstance(read, Expression) or read.names != {TIME}:
        others = sorted(read.names - {TIME}) if isinstance(read, Expression) else []
        what = f"the law depends on {', '.join(others)}" if others else "the law does not depend on time"
        raise ModelError(what, f"write {EXAMPLE}", ("expression",))
    used = {n.function for n in nodes(read.tree) if isinstance(n, Apply)}
    bent = sorted(used & {"abs", "sign", "min", "max", *COMPARISONS, "asin", "acos", "atan2"})
    if bent:
        what = f"a law with {bent[0]} has no acceleration everywhere"
        raise ModelError(
            what, "write it by segments, or by sin, cos, tan, exp, log, sqrt and atan", ("expression",)
        )
    duration = at_item("duration", rules.quantity, keys["duration"], "time") if "duration" in keys else 0.0
    if duration:
        at_item("duration", check_sign, duration, keys["duration"], "positive")
    instants = keys.get("count", 1)
    if isinstance(instants, bool) or not isinstance(instants, int) or instants < 1:
        raise ModelError(f"count is {quote_value(instants)}", "write an integer from 1 on", ("count",))
    if instants > 1 and not duration:
        raise ModelError("a count is given without a duration", "write duration: 1 s beside it", ("count",))
    return ExpressionLaw(read, duration, instants)


def expression_law_schema() -> JsonSchema:
    keys = {
        "expression": {"type": "string", "description": "position as an expression of time"},
        "unit": {"type": "string", "description": "of the expression, where it is not in it"},
        "duration": NUMBER_OR_TEXT
        | {"description": "of the instants that are analysed, a time; simulate needs none"},
        "count": {
            "type": "integer",
            "minimum": 1,
            "description": "instants from 0 to duration; default 1, at time 0",
        },
    }
    return object_schema(keys, "expression")
