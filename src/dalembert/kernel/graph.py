"""Scalars that record the operations behind them; the core computes with them when it is traced.

Every operation is entered once (equal operations are one node), constants fold, and exact zeros stay constants, so the
sparsity of A is preserved. numpy arrays of such scalars (``dtype=object``) run through the core unchanged.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Mapping
from typing import Any, SupportsFloat

import numpy as np

from dalembert.arrays import Array, Numeric
from dalembert.kernel.operations import EVALUATE, not_negative, power_by_roots

INPUTS = ("number", "common", "channel")
CONSTANT, DESIGN, POSITION = 0, 1, 2
"""Bits for the dependence of a node: constant, the design's numbers, the position of the drives."""


def _comparison(compare: Callable[[float, float], bool]) -> Callable[[Node, Scalar], bool]:
    def decided(self: Node, other: Scalar) -> bool:
        """The decision, recorded with nodes that are negative where other numbers would reverse it."""
        answer = compare(self._decision(), other._decision() if type(other) is Node else float(other))
        margin = self - other if answer == (compare in (operator.gt, operator.ge)) else other - self
        if margin.level != CONSTANT:
            self.graph.decisions.append(margin)
        return answer

    return decided


def _operation(
    name: str, neutral: int, absorbing: int | None = None
) -> Callable[[Node, Scalar | Array], Node]:
    def of(self: Node, other: Scalar | Array) -> Node:
        """The node of an operation on two values; numpy applies it to arrays element by element."""
        if type(other) is not Node:
            if isinstance(other, np.ndarray):
                return NotImplemented  # type: ignore[no-any-return]
            if other == neutral and self.level:
                return self
            if other == absorbing and self.level:
                return self.graph.zero
            other = self.graph.constant(other)
        made: Node = getattr(self.graph, name)(self, other)
        return made

    return of


class Node:
    """One operation. ``value`` is the number of a constant, or the index of an input."""

    __slots__ = ("a", "b", "graph", "index", "level", "op", "value")

    shape: tuple[int, ...] = ()
    ndim = 0
    dtype = np.dtype(object)

    def __init__(self, graph: Graph, op: str, a: Node | None, b: Node | None, value: Any, level: int) -> None:
        self.graph, self.op, self.a, self.b, self.value, self.level = graph, op, a, b, value, level
        self.index = len(graph.nodes)
        graph.nodes.append(self)

    def __repr__(self) -> str:
        return f"{self.op}#{self.index}"

    __add__ = __radd__ = _operation("add", 0)
    __sub__, __truediv__ = _operation("sub", 0), _operation("div", 1)
    __mul__ = __rmul__ = _operation("mul", 1, 0)

    def __rsub__(self, other: Scalar) -> Node:
        return self.graph.sub(self.graph.constant(other), self)

    def __rtruediv__(self, other: Scalar) -> Node:
        return self.graph.div(self.graph.constant(other), self)

    def __neg__(self) -> Node:
        return self.graph.neg(self)

    def __abs__(self) -> Node:
        return self.graph.unary("abs", self)

    def __pow__(self, power: float) -> Node:
        if power == 0.5:
            return self.sqrt()
        if power == 0:
            return self.graph.one
        if not abs(power) <= 16:
            raise TypeError(f"a traced value to the power {power}")
        out: Node = power_by_roots(self, abs(power))
        return out if power > 0 else 1.0 / out

    def sqrt(self) -> Node:
        return self.graph.unary("sqrt", self)

    def sin(self) -> Node:
        return self.graph.unary("sin", self)

    def cos(self) -> Node:
        return self.graph.unary("cos", self)

    def tan(self) -> Node:
        return self.sin() / self.cos()

    def sign(self) -> Node:
        return self.graph.unary("sign", self)

    def positive(self) -> Node:
        """1 where positive, else 0."""
        return self.graph.unary("positive", self)

    def larger(self, other: Scalar) -> Node:
        return self.graph.binary("max", self, other if type(other) is Node else self.graph.constant(other))

    def __and__(self, other: Scalar | Array) -> Node:
        """Logical and of two flags, which are 0 or 1."""
        if isinstance(other, np.ndarray):
            return NotImplemented
        return self * (other if type(other) is Node else float(other))

    def __invert__(self) -> Node:
        return 1.0 - self

    def arctan2(self, other: Scalar) -> Node:
        other = other if type(other) is Node else self.graph.constant(other)
        return self.graph.binary("atan2", self, other)

    def rint(self) -> Node:
        return self.graph.unary("rint", self)

    def conjugate(self) -> Node:
        return self

    def _decision(self) -> float:
        """Sampled value for decisions on structure (which wheel is larger), evaluated with the file's numbers."""
        if self.level & POSITION:
            raise TypeError(f"a traced value that changes along the motion has no truth: {self!r}")
        return float(self.graph.evaluate([self], {})[0])

    __lt__, __gt__ = _comparison(operator.lt), _comparison(operator.gt)
    __le__, __ge__ = _comparison(operator.le), _comparison(operator.ge)

    def __bool__(self) -> bool:
        """True if not identically zero."""
        return self.op != "const" or self.value != 0

    def __float__(self) -> float:
        if self.op != "const":
            raise TypeError("a traced value is not a number")
        return float(self.value)

    __hash__ = object.__hash__


Scalar = Node | float


class Graph:
    """All nodes of one trace, in an order in which they can be computed."""

    def __init__(self) -> None:
        self.nodes: list[Node] = []
        self.table: dict[tuple[object, ...], Node] = {}
        self.constants: dict[float, Node] = {}
        self.count = {"number": 0, "common": 0, "channel": 0}
        self.names: dict[int, str] = {}
        self.nominal: dict[int, Numeric] = {}
        self.samples: dict[int, Numeric] = {}
        self.decisions: list[Node] = []
        self.outside: list[Node] = []
        """Below zero where an argument is beyond a table's ends."""
        self.zero, self.one = self.constant(0.0), self.constant(1.0)

    def constant(self, value: SupportsFloat) -> Node:
        number = float(value)
        node = self.constants.get(number)
        if node is None or (number == 0 and math.copysign(1.0, number) < 0):
            key = ("const", math.copysign(1.0, number), number)
            node = self.table.get(key)
            if node is None:
                node = self.table[key] = Node(self, "const", None, None, number, CONSTANT)
                self.constants.setdefault(number, node)
        return node

    def input(self, kind: str, name: str, nominal: Numeric) -> Node:
        """A value given from outside: a ``number`` of each design, one ``common`` to all, or a ``channel`` along the
        positions. ``nominal`` is its value (or its values along the motion) in the file."""
        node = Node(self, kind, None, None, self.count[kind], POSITION if kind == "channel" else DESIGN)
        self.count[kind] += 1
        self.names[node.index], self.nominal[node.index] = name, nominal
        return node

    def make(self, op: str, a: Node, b: Node | None = None) -> Node:
        key = (op, a.index) if b is None else (op, a.index, b.index)
        node = self.table.get(key)
        if node is None:
            level = a.level if b is None else a.level | b.level
            node = self.table[key] = Node(self, op, a, b, None, level)
        return node

    def add(self, a: Node, b: Node) -> Node:
        if a.op == "const":
            if b.op == "const":
                return self.constant(a.value + b.value)
            if a.value == 0:
                return b
        elif b.op == "const" and b.value == 0:
            return a
        if b.op == "neg":
            assert b.a is not None
            return self.sub(a, b.a)
        if a.op == "neg":
            assert a.a is not None
            return self.sub(b, a.a)
        return self.make("add", a, b) if a.index <= b.index else self.make("add", b, a)

    def sub(self, a: Node, b: Node) -> Node:
        if a is b:
            return self.zero
        if b.op == "const":
            if a.op == "const":
                return self.constant(a.value - b.value)
            if b.value == 0:
                return a
        elif a.op == "const" and a.value == 0:
            return self.neg(b)
        if b.op == "neg":
            assert b.a is not None
            return self.add(a, b.a)
        if a.op == "neg":
            assert a.a is not None
            return self.neg(self.add(a.a, b))
        return self.make("sub", a, b)

    def mul(self, a: Node, b: Node) -> Node:
        if a.op == "const":
            a, b = b, a
        if b.op == "const":
            if a.op == "const":
                return self.constant(a.value * b.value)
            if b.value == 0:
                return self.zero
            if b.value == 1:
                return a
            if b.value == -1:
                return self.neg(a)
        if a.op == "neg":
            assert a.a is not None
            return self.neg(self.mul(a.a, b))
        if b.op == "neg":
            assert b.a is not None
            return self.neg(self.mul(a, b.a))
        return self.make("mul", a, b) if a.index <= b.index else self.make("mul", b, a)

    def div(self, a: Node, b: Node) -> Node:
        if a.op == "const" and a.value == 0:
            return self.zero
        if b.op == "const":
            return (
                self.constant(a.value / b.value)
                if a.op == "const"
                else self.mul(a, self.constant(1 / b.value))
            )
        return self.mul(a, self.inverse(b))

    def inverse(self, a: Node) -> Node:
        if a.op == "neg":
            assert a.a is not None
            return self.neg(self.inverse(a.a))
        if a.op == "sqrt":
            assert a.a is not None
            return self.unary("rsqrt", a.a)
        return self.make("inv", a)

    def neg(self, a: Node) -> Node:
        if a.op == "const":
            return self.constant(-a.value)
        if a.op == "neg":
            assert a.a is not None
            return a.a
        return self.make("neg", a)

    def assume_equal(self, node: object, same: object) -> None:
        """Makes later uses of the operation of ``node`` give ``same``, which is known to be equal."""
        if type(node) is Node and node.a is not None and type(same) is Node and node is not same:
            key = (node.op, node.a.index) if node.b is None else (node.op, node.a.index, node.b.index)
            self.table[key] = same

    def unary(self, op: str, a: Node) -> Node:
        if a.op == "const":
            return self.constant(EVALUATE[op](a.value))
        if op in ("abs", "cos") and a.op == "neg":
            assert a.a is not None
            a = a.a
        if op == "abs" and not_negative(a):
            return a
        if op == "sqrt" and a.op == "mul" and a.a is a.b:
            return self.unary("abs", a.a)  # type: ignore[arg-type]
        if op == "positive" and a.op == "neg" and not_negative(a.a):
            return self.zero
        return self.make(op, a)

    def binary(self, op: str, a: Node, b: Node) -> Node:
        if a.op == "const" and b.op == "const":
            return self.constant(EVALUATE[op](a.value, b.value))
        if op == "max" and is_zero(b) and not_negative(a):
            return a
        return self.make(op, a, b)

    def without_gradient(self, a: Node) -> Node:
        """The same value, but a constant to derivatives."""
        return a if a.level == CONSTANT else self.make("detach", a)

    def substitute(self, outputs: Iterable[Node], places: Mapping[int, Node]) -> list[Node]:
        """The outputs with some nodes replaced by others (by their index)."""
        outputs = list(outputs)
        done = dict(places)
        for node in self.order(outputs, places):
            if node.a is None:
                done[node.index] = node
            else:
                b = None if node.b is None else done[node.b.index]
                done[node.index] = self.again(node.op, done[node.a.index], b)
        return [done[node.index] for node in outputs]

    def again(self, op: str, a: Node, b: Node | None) -> Node:
        """A new operation by its name, folded where possible."""
        if b is not None:
            two = {"add": self.add, "sub": self.sub, "mul": self.mul}
            return two[op](a, b) if op in two else self.binary(op, a, b)
        one = {"neg": self.neg, "inv": self.inverse, "detach": self.without_gradient}
        return one[op](a) if op in one else self.unary(op, a)

    def evaluate(self, outputs: Iterable[Node], values: Mapping[int, Numeric]) -> list[Numeric]:
        """Numbers of nodes with numpy; ``values`` (by index of the input node) replace the nominal ones."""
        outputs = list(outputs)
        done = {} if values else self.samples
        with np.errstate(all="ignore"):
            self._evaluate(self.order(outputs, done), values, done)
        return [done[node.index] for node in outputs]

    def _evaluate(self, nodes: list[Node], values: Mapping[int, Numeric], done: dict[int, Numeric]) -> None:
        for node in nodes:
            if node.op == "const":
                done[node.index] = node.value
            elif node.op in INPUTS:
                done[node.index] = values.get(node.index, self.nominal[node.index])
            else:
                assert node.a is not None
                args = (done[node.a.index],) if node.b is None else (done[node.a.index], done[node.b.index])
                done[node.index] = EVALUATE[node.op](*args)

    def order(self, outputs: Iterable[Node], known: Mapping[int, Numeric] | None = None) -> list[Node]:
        """Every node that the outputs need, arguments first, without those already known."""
        needed: dict[int, Node] = {}
        known = known or {}
        stack = list(outputs)
        while stack:
            node = stack.pop()
            if node.index not in needed and node.index not in known:
                needed[node.index] = node
                if node.a is not None:
                    stack.append(node.a)
                if node.b is not None:
                    stack.append(node.b)
        return [needed[k] for k in sorted(needed)]


def is_zero(x: Scalar) -> bool:
    """True if identically zero, for every design and position."""
    return x.op == "const" and x.value == 0 if type(x) is Node else x == 0


def unit_value(x: Scalar) -> float:
    """1 or -1 where the value is exactly that, else 0."""
    if type(x) is Node:
        x = x.value if x.op == "const" else 0.0
    return float(x) if x in (1.0, -1.0) else 0.0


def node(graph: Graph, x: Scalar) -> Node:
    """A node as it is, a number as a constant."""
    return x if isinstance(x, Node) else graph.constant(x)


def trace_array(graph: Graph, array: object) -> Array:
    """An array of nodes: numbers become constants."""
    source = np.asarray(array)
    out = np.empty(source.size, object)
    out[:] = [x if type(x) is Node else graph.constant(x) for x in source.ravel().tolist()]
    return out.reshape(source.shape)
