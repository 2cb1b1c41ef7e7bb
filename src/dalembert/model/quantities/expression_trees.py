"""Trees of expressions: their functions, their values over anything that has operators, and their text."""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from dalembert.arrays import Numeric
from dalembert.errors import ModelError
from dalembert.unit_names import NONE
from dalembert.wording import closest

ARGUMENTS = dict.fromkeys(
    ["sin", "cos", "tan", "asin", "acos", "atan", "sqrt", "exp", "log", "abs", "sign"], 1
)
ARGUMENTS |= dict.fromkeys(("atan2", "min", "max"), 2)
"""Function -> how many arguments it takes, of those in `MANY` at least."""
MANY = ("min", "max")
REDUCTIONS = ("peak", "mean", "rms", "range", "least", "greatest", "norm8", "final")
"""Functions of all values of a cycle, where a single number is required: the largest magnitude, the mean, the root mean
square, the difference of the extremes, these, a smooth approximation of the peak, and the last value."""
COMPARISONS = (">=", "<=", ">", "<")
"""Operators worth 1 or 0, in brackets."""

Functions = Mapping[str, Callable[..., Numeric]]
OPERATORS: dict[str, Callable[[Numeric, Numeric], Numeric]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "^": operator.pow,
}
RANKS = {"+": 1, "-": 1, "*": 2, "/": 2, "^": 4}


@dataclass(frozen=True, slots=True)
class NumberNode:
    """A number, in SI where it was written with a unit; `dimension` is that of its unit, `pi` may be an angle."""

    value: float
    text: str = ""
    dimension: tuple[float, float, float, float | None] = NONE


@dataclass(frozen=True, slots=True)
class NameNode:
    name: str


@dataclass(frozen=True, slots=True)
class Apply:
    """An operator (`+ - * / ^`, one argument: the sign) or a function applied to its arguments."""

    function: str
    arguments: tuple[Tree, ...]


Tree = NumberNode | NameNode | Apply


def numpy_functions() -> Functions:
    """The functions of the grammar for numbers and arrays."""
    import numpy as np

    other = {"asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "atan2": np.arctan2}
    other |= {"min": np.minimum, "max": np.maximum}
    return {name: other.get(name) or getattr(np, name) for name in ARGUMENTS}


def evaluate(tree: Tree, drives: Mapping[str, Numeric], functions: Functions) -> Numeric:
    """The value of a tree over anything that has operators, functions from the table given."""
    if isinstance(tree, NumberNode):
        return tree.value
    if isinstance(tree, NameNode):
        if tree.name not in drives:
            raise unknown_name("an expression uses", tree.name, list(drives))
        return drives[tree.name]
    values = [evaluate(argument, drives, functions) for argument in tree.arguments]
    return apply_function(tree.function, values, functions)


def unknown_name(what: str, name: str, known: list[str]) -> ModelError:
    """Error for an expression ``what`` that depends on a name without a value."""
    if name == "time":
        remedy = "give a drive a law of motion, or let forces move the machine: simulate"
        return ModelError(
            "a quantity depends on time, but several positions without a law have no times", remedy
        )
    return ModelError(f"{what} {name!r}, which is not a drive", closest(name, known))


def apply_function(name: str, values: Sequence[Numeric], functions: Functions) -> Numeric:
    """The value of an operator or a function of its arguments."""
    if name in OPERATORS:
        return -values[0] if len(values) == 1 else _apply(name, *values)
    if name in COMPARISONS:
        return _compare(name, values[0], values[1], functions["sign"])
    return functions[name](*values)


def _apply(sign: str, a: Numeric, b: Numeric) -> Numeric:
    if isinstance(a, float) and isinstance(b, float):
        import numpy as np

        return OPERATORS[sign](np.float64(a), np.float64(b))
    return OPERATORS[sign](a, b)


def _compare(name: str, a: Numeric, b: Numeric, sign: Callable[[Numeric], Numeric]) -> Numeric:
    """1 or 0, from a single sign s of the difference: (s^2 + s)/2 is 1 where s is 1, and 0 where it is 0 or -1."""
    s = sign(_apply("-", a, b) if name in (">", "<=") else _apply("-", b, a))
    beyond = (s * s + s) / 2.0
    return beyond if name in (">", "<") else 1.0 - beyond


def names_in(tree: Tree) -> frozenset[str]:
    """The names of drives and parameters in a tree."""
    return frozenset(node.name for node in nodes(tree) if isinstance(node, NameNode))


def nodes(tree: Tree) -> Iterator[Tree]:
    """The tree and everything in it."""
    yield tree
    if isinstance(tree, Apply):
        for argument in tree.arguments:
            yield from nodes(argument)


def expression_text(tree: Tree, rank: int = 0) -> str:
    """The tree as text that parses to the same tree.

    >>> from dalembert.model.quantities.expressions import parse_expression
    >>> expression_text(parse_expression("2*( (O2) + 1)^2")[0])
    '2*(O2 + 1)^2'
    """
    if isinstance(tree, NumberNode):
        exact = tree.value == round(tree.value, 12)
        return tree.text or (repr(tree.value).removesuffix(".0") if exact else f"{tree.value:.17g}")
    if isinstance(tree, NameNode):
        return tree.name
    if tree.function in COMPARISONS:
        return f"({f' {tree.function} '.join(map(expression_text, tree.arguments))})"
    if tree.function not in OPERATORS:
        return f"{tree.function}({', '.join(expression_text(argument) for argument in tree.arguments)})"
    level = RANKS[tree.function]
    if len(tree.arguments) == 1:
        level, text = 3, "-" + expression_text(tree.arguments[0], 3)
    else:
        left, right = tree.arguments
        space = " " if level == 1 else ""
        base = level + 1 if level == 4 else level
        last = expression_text(right, 3 if level == 4 else level + 1)
        text = f"{expression_text(left, base)}{space}{tree.function}{space}{last}"
    return f"({text})" if level < rank else text
