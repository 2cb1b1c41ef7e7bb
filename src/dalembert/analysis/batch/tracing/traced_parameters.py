"""Expressions of parameters that vary from design to design, traced: their derivatives are exact too."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from dalembert.arrays import Numeric
from dalembert.errors import ModelError
from dalembert.kernel.graph import Graph, Node, Scalar
from dalembert.model.quantities.expression_trees import (
    Apply,
    Functions,
    Tree,
    apply_function,
    expression_text,
    names_in,
    numpy_functions,
)
from dalembert.model.quantities.expression_trees import NameNode as Variable
from dalembert.model.quantities.expressions import Expression
from dalembert.model.quantities.tables import Table
from dalembert.unit_names import unit

Channel = Callable[[str, Expression | Table], Node]
"""The input of a load by its name and how it varies."""


def symbol_functions(graph: Graph) -> Functions:
    """The functions of expressions for numbers that vary; exp and log of them are refused."""

    def node(x: Scalar) -> Node:
        return x if isinstance(x, Node) else graph.constant(x)

    def refused(name: str) -> Callable[[Scalar], Numeric]:
        def one(x: Scalar) -> Numeric:
            if isinstance(x, Node):
                raise ModelError(
                    f"{name} of a number that varies is not compiled", "use da.dynamics or da.statics"
                )
            return numpy_functions()[name](x)

        return one

    return {
        "sin": lambda x: node(x).sin(),
        "cos": lambda x: node(x).cos(),
        "tan": lambda x: node(x).tan(),
        "asin": lambda x: node(x).arctan2((1.0 - node(x) * x).sqrt()),
        "acos": lambda x: (1.0 - node(x) * x).sqrt().arctan2(x),
        "atan": lambda x: node(x).arctan2(1.0),
        "atan2": lambda y, x: node(y).arctan2(x),
        "sqrt": lambda x: node(x).sqrt(),
        "abs": lambda x: abs(node(x)),
        "sign": lambda x: node(x).sign(),
        "max": lambda x, y: node(x).larger(y),
        "min": lambda x, y: -((-node(x)).larger(-y)),
        "exp": refused("exp"),
        "log": refused("log"),
    }


def varies(value: object) -> bool:
    """True if an expression or a table along the motion depends on a parameter that varies."""
    if isinstance(value, Expression):
        return any(isinstance(v, Node) for _, v in value.parameters or ())
    return isinstance(value, Table) and any(isinstance(x, Node) for x in (value.times, value.shift, *value.y))


def is_table(value: object) -> bool:
    """True if a value along the motion is a table."""
    return isinstance(value, Table)


def is_shifted(value: object) -> bool:
    """True if it is a table whose shift varies."""
    return isinstance(value, Table) and isinstance(value.shift, Node)


def traced(name: str, value: Expression | Table, graph: Graph, channel: Channel) -> Numeric:
    """The value along the motion of what follows from a parameter that varies, from inputs of the parts that do not."""
    if isinstance(value, Table):
        return _table(name, value, channel)
    inputs = dict(value.parameters or ())
    scale, known = unit(value.unit) if value.unit else None, symbol_functions(graph)

    def part(tree: Tree) -> Numeric:
        names = names_in(tree)
        if isinstance(tree, Variable) and tree.name in inputs:
            return inputs[tree.name]
        if any(isinstance(inputs.get(n), Node) for n in names):
            assert isinstance(tree, Apply)
            return apply_function(tree.function, [part(argument) for argument in tree.arguments], known)
        text = expression_text(tree)
        expression = Expression(text, "", tuple((n, v) for n, v in inputs.items() if n in names))
        return channel(f"{name} {text}", expression) if expression.names else float(expression.at({}))

    result = part(value.tree)
    return result if scale is None else scale.si(result)


def _table(name: str, table: Table, channel: Channel) -> Numeric:
    """A table is linear in its values: the sum of each times its weight at the position, times the factor."""
    times: Numeric = table.times
    table = replace(table, times=1.0)
    closed = table.closed()[1] is table.y and table.period is not None
    count = len(table.y) - closed
    total = channel(
        f"{name} numbers", replace(table, y=tuple(0.0 if isinstance(y, Node) else y for y in table.y))
    )
    for k, y in enumerate(table.y[:count]):
        if isinstance(y, Node):
            share = [0.0] * len(table.y)
            share[k] = 1.0
            if closed and k == 0:
                share[-1] = 1.0
            total = total + y * channel(f"{name} share {k + 1}", replace(table, y=tuple(share)))
    return total * times
