"""Expressions with reductions over the cycle inside, ``peak(effort.O) + 0.1 m*range(slide.G)``, of many designs.

Values carry their derivatives by the numbers (forward mode), exact wherever the expression is differentiable. It is not
where two positions share a peak or an extreme, or where abs, min and max change branch: the derivative is then that of
one side, which descent with a line search and SLSQP accept.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from dalembert.analysis.batch.compiled_kernel import Kernel
from dalembert.analysis.batch.over_positions import cycle_slope, reduce_cycle
from dalembert.analysis.result.named_quantities import quantity, quantity_names, quantity_tree
from dalembert.analysis.result.quantity_catalogue import CATALOGUE
from dalembert.analysis.result.result import Result
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.machine.motion.many.along_motions import AlongMotions
from dalembert.model.quantities.expression_trees import (
    REDUCTIONS,
    Apply,
    Functions,
    NameNode,
    Tree,
    evaluate,
    names_in,
    numpy_functions,
)
from dalembert.optimization.one_by_one import OneByOne

CALL = re.compile(rf"(?<![\w.])({'|'.join(REDUCTIONS)})\s*\(")
ONE_A_CYCLE = ("mass", "life", "fatigue")
"""Words of quantities that have one value for a cycle."""
QUANTITY = re.compile(
    rf"(?<![\w.])(?:{'|'.join(word for word in CATALOGUE if word not in ONE_A_CYCLE)})(?![\w(])"
)
SINGLE = re.compile(rf"(?<![\w.])(?:{'|'.join(ONE_A_CYCLE)})(?![\w(])")


def has_reductions(text: str) -> bool:
    """True if a reduction over the cycle is inside an expression."""
    return bool(CALL.search(text))


def call_end(text: str, start: int) -> int:
    """Place behind the bracket that closes the one before ``start``; the end if none does."""
    depth = 1
    for k in range(start, len(text)):
        depth += (text[k] == "(") - (text[k] == ")")
        if not depth:
            return k + 1
    return len(text)


def whole_call(text: str) -> tuple[str, str]:
    """Reduction and argument of a text that is nothing but one, or empty ones: ``peak(effort.O)``."""
    call = CALL.match(text)
    if call is None or call_end(text, call.end()) < len(text) or text[-1] != ")":
        return "", ""
    return call[1], text[call.end() : -1].strip()


def has_quantities(text: str) -> bool:
    """True if an expression has a separate value at every position: a quantity is outside of its reductions.

    >>> has_quantities("peak(effort.O) + links.rod.mass*2"), has_quantities("effort.O - mean(effort.O)")
    (False, True)
    """
    while call := CALL.search(text):
        text = text[: call.start()] + " 0 " + text[call_end(text, call.end()) :]
    return bool(QUANTITY.search(text))


def is_single(text: str) -> bool:
    """True if an expression has one value for a cycle: reductions inside, a mass, a life.

    >>> is_single("peak(effort.O) + 1"), is_single("mass"), is_single("effort.O")
    (True, True, False)
    """
    return (has_reductions(text) or bool(SINGLE.search(text))) and not has_quantities(text)


class Differentiated:
    """Values (design, P), or (design, 1) of a complete cycle, with derivatives by the numbers in a last axis."""

    __array_ufunc__ = None

    def __init__(self, value: Array, slope: Array) -> None:
        self.value, self.slope = value, slope

    def mapped(self, value: Array, rate: Array) -> Differentiated:
        return Differentiated(value, rate[..., None] * self.slope)

    def __add__(self, other: Any) -> Differentiated:
        b = _number(other)
        return Differentiated(self.value + b.value, self.slope + b.slope)

    def __mul__(self, other: Any) -> Differentiated:
        b = _number(other)
        slope = self.slope * b.value[..., None] + b.slope * self.value[..., None]
        return Differentiated(self.value * b.value, slope)

    def __pow__(self, power: Any) -> Differentiated:
        rate = power * self.value ** (power - 1.0) if power else np.zeros_like(self.value)
        return self.mapped(self.value**power, rate)

    __radd__, __rmul__ = __add__, __mul__

    def __neg__(self) -> Differentiated:
        return self * -1.0

    def __sub__(self, other: Any) -> Differentiated:
        return self + -_number(other)

    def __rsub__(self, other: Any) -> Differentiated:
        return _number(other) - self

    def __truediv__(self, other: Any) -> Differentiated:
        return self * _number(other).__pow__(-1.0)

    def __rtruediv__(self, other: Any) -> Differentiated:
        return _number(other) / self


def _number(x: Any) -> Differentiated:
    if isinstance(x, Differentiated):
        return x
    return Differentiated(np.full((1, 1), float(x)), np.zeros((1, 1, 1)))


RATES: Mapping[str, Callable[[Array], Any]] = {
    "sin": np.cos,
    "cos": lambda x: -np.sin(x),
    "tan": lambda x: np.cos(x) ** -2.0,
    "asin": lambda x: (1 - x * x) ** -0.5,
    "acos": lambda x: -((1 - x * x) ** -0.5),
    "atan": lambda x: 1 / (1 + x * x),
    "sqrt": lambda x: 0.5 / np.sqrt(x),
    "exp": np.exp,
    "log": lambda x: 1 / x,
    "abs": np.sign,
    "sign": np.zeros_like,
}
"""Function of one argument -> its derivative."""


def cycle_functions(smooth: bool = False) -> Functions:
    """The functions of expressions for values with derivatives; ``smooth`` takes norm8 for a peak."""
    known = numpy_functions()

    def one(name: str, x: Any) -> Differentiated:
        inner = _number(x)
        return inner.mapped(known[name](inner.value), RATES[name](inner.value))

    def chosen(name: str, a: Any, b: Any) -> Differentiated:
        a, b = _number(a), _number(b)
        first = (a.value >= b.value) if name == "max" else (a.value <= b.value)
        return Differentiated(known[name](a.value, b.value), np.where(first[..., None], a.slope, b.slope))

    def atan2(y: Any, x: Any) -> Differentiated:
        y, x = _number(y), _number(x)
        size = x * x + y * y
        slope = x.value[..., None] * y.slope - y.value[..., None] * x.slope
        return Differentiated(np.arctan2(y.value, x.value), slope / size.value[..., None])

    def reduction(word: str, x: Any) -> Differentiated:
        x, word = _number(x), "norm8" if smooth and word == "peak" else word
        value, slope = x.value.T, np.broadcast_to(x.slope, (*x.value.shape, x.slope.shape[-1])).swapaxes(0, 1)
        return Differentiated(reduce_cycle(word, value)[:, None], cycle_slope(word, value, slope)[:, None])

    return {
        **{name: partial(one, name) for name in RATES},
        **{name: partial(chosen, name) for name in ("min", "max")},
        **{word: partial(reduction, word) for word in REDUCTIONS},
        "atan2": atan2,
    }


def cycle_tree(text: str, r: Result) -> Tree:
    """The tree of an expression of the quantities, parameters and numbers of the file of an analysed mechanism."""
    quantity(r, text)  # raises ModelError for vectors and unlike quantities
    tree = quantity_tree(r, text, quantity_names(r))
    if not names_in(tree):
        raise ModelError(f"{text!r} names no quantity", "write one like range(slide.G)")
    return tree


def _with(tree: Tree, parts: Mapping[str, Tree]) -> Tree:
    """A tree with others in the place of names."""
    if isinstance(tree, NameNode):
        return parts.get(tree.name, tree)
    if isinstance(tree, Apply):
        return Apply(tree.function, tuple(_with(x, parts) for x in tree.arguments))
    return tree


@dataclass(frozen=True)
class CycleExpressions:
    """Expressions by their texts, and the kernel of the quantities in them at every position.

    At a reversal they have the values just before, as all numbers that are not reduced in the kernel.
    """

    trees: Mapping[str, Tree]
    kernel: Kernel | OneByOne | AlongMotions

    @classmethod
    def of(
        cls,
        texts: Sequence[str],
        r: Result,
        compiled: Callable[[Sequence[str]], Kernel | OneByOne | AlongMotions],
        functions: Collection[str] = (),
        written: Mapping[str, str] | None = None,
    ) -> CycleExpressions:
        """Expressions of the quantities, parameters and numbers of the file of an analysed mechanism, or the names of
        ``functions`` of it; ``written``: quantities that are expressions of others here."""
        parts = {name: cycle_tree(text, r) for name, text in (written or {}).items()}
        trees = {
            text: NameNode(text) if text in functions else _with(cycle_tree(text, r), parts) for text in texts
        }
        return cls(trees, compiled(sorted({name for tree in trees.values() for name in names_in(tree)})))

    def names(self, text: str) -> frozenset[str]:
        """The quantities in one of them."""
        return names_in(self.trees[text])

    def __call__(
        self,
        values: Array,
        positions: Array,
        texts: Sequence[str] | None = None,
        smooth: bool = False,
        **options: Any,
    ) -> dict[str, Differentiated]:
        """Values of many designs, in blocks, so that memory is bounded; ``smooth`` takes norm8 for a peak."""
        functions, texts = cycle_functions(smooth), list(self.trees) if texts is None else texts
        parts: dict[str, list[Differentiated]] = {text: [] for text in texts}
        for r in self.kernel.blocks(values, positions=positions, **options):
            known = {name: Differentiated(r.value(name), r.gradient(name)) for name in self.kernel.outputs}
            with np.errstate(all="ignore"):
                for text in texts:
                    parts[text].append(_number(evaluate(self.trees[text], known, functions)))
        return {
            text: Differentiated(np.concatenate([b.value for b in of]), np.concatenate([b.slope for b in of]))
            for text, of in parts.items()
        }
