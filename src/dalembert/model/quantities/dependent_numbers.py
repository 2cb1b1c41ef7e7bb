"""Numbers that follow from parameters by an expression, which they keep."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from dalembert.arrays import Numeric
from dalembert.model.quantities.expression_trees import Functions, NameNode, names_in
from dalembert.model.quantities.expressions import Expression
from dalembert.model.quantities.figures import FILE_UNITS, unit_vector
from dalembert.units import KINDS


class Dependent(float):
    """A number that follows from parameters by an expression; in all else the number itself.

    >>> r = Dependent(Expression("2*r", parameters=(("r", 0.045),)))
    >>> r, r.expression.text
    (0.09, '2*r')
    """

    __slots__ = ("expression",)
    expression: Expression

    def __new__(cls, expression: Expression) -> Dependent:
        number = super().__new__(cls, float(expression.at({})))
        number.expression = expression
        return number

    def __reduce__(self) -> tuple[type[Dependent], tuple[Expression]]:
        return Dependent, (self.expression,)

    @property
    def names(self) -> frozenset[str]:
        """The parameters it follows from."""
        return names_in(self.expression.tree)


def follows(value: object) -> bool:
    """True if a number, or some component of a vector, depends on parameters, whatever its value."""
    return isinstance(value, Dependent) or (isinstance(value, tuple) and any(map(follows, value)))


def dependent_text(number: Dependent, kind: str = "") -> str:
    """Expression that a number depends on, as in a file."""
    return expression_with_unit(number.expression, kind)


def expression_with_unit(e: Expression, kind: str = "") -> str:
    """An expression of parameters, with a unit where it has one that is not the file's."""
    units = FILE_UNITS.get()
    bare = not e.unit or (units is not None and kind != "" and e.unit == units.text(kind))
    return e.text if bare else f"({e.text}) {e.unit}"


def polar_components(size: float, angle: float, kind: str) -> tuple[float, float]:
    """The components of a vector of which the length or the angle follows from parameters."""
    used = [part.expression.parameters or () for part in (size, angle) if isinstance(part, Dependent)]
    parameters = tuple(dict(pair for pairs in used for pair in pairs).items())
    length, turn, components = factor_text(size, kind), factor_text(angle, "angle"), list[float]()
    for function, known in zip(("cos", "sin"), unit_vector(angle), strict=True):
        if isinstance(angle, Dependent):
            components.append(Dependent(Expression(f"{length}*{function}({turn})", "", parameters)))
        elif known in (0.0, 1.0):
            components.append(size if known else 0.0)
        else:
            components.append(Dependent(Expression(f"{length}*{known!r}", "", parameters)))
    return components[0], components[1]


def factor_text(value: float | Expression, kind: str) -> str:
    """A number or an expression of parameters as a factor of another expression of parameters."""
    if not isinstance(value, (Dependent, Expression)):
        return f"{value!r} {KINDS[kind].si}"
    e = value.expression if isinstance(value, Dependent) else value
    text = e.text if isinstance(e.tree, NameNode) else f"({e.text})"
    return f"{text}*1 {e.unit}" if e.unit else text


def parameters_of(value: object) -> tuple[str, ...]:
    """Parameters in the expression of a value."""
    e = value.expression if isinstance(value, Dependent) else value
    return tuple(name for name, _ in e.parameters or ()) if isinstance(e, Expression) else ()


def _same(a: Numeric, b: Numeric) -> bool:
    return a is b or (isinstance(a, float) and isinstance(b, float) and a == b)


def with_new(leaf: Any, values: Mapping[str, Numeric], functions: Functions | None = None) -> Any:
    """A number or expression that follows from parameters with their new values; any other as it is.

    With `functions`, those of symbols, a number becomes the value they give.
    """
    e = leaf.expression if isinstance(leaf, Dependent) else leaf
    if not isinstance(e, Expression) or not e.parameters or all(_same(values[n], v) for n, v in e.parameters):
        return leaf
    new = replace(e, parameters=tuple((n, values[n]) for n, _ in e.parameters))
    if leaf is e:
        return new
    return new.at({}, functions) if functions else Dependent(new)
