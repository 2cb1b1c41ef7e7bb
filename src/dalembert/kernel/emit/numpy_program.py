"""A traced program evaluated with numpy, one operation after the other: no compiler is needed, and nothing compiled."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from dalembert.arrays import Array, Numeric
from dalembert.kernel.graph import INPUTS, POSITION, Graph, Node

Operation = Callable[[Any, Any], Numeric]

MANY: dict[str, Operation] = {
    "add": operator.add,
    "sub": operator.sub,
    "mul": operator.mul,
    "neg": lambda a, _: -a,
    "inv": lambda a, _: 1.0 / a,
    "abs": lambda a, _: abs(a),
    "detach": lambda a, _: a,
    "positive": lambda a, _: (a > 0) * 1.0,
    "rsqrt": lambda a, _: 1.0 / np.sqrt(a),
    "atan2": np.arctan2,
    "max": np.maximum,
    "min": np.minimum,
}
"""Operations of arrays; those of one argument are given another that they leave."""
MANY |= {
    "sqrt": lambda a, _: np.sqrt(a),
    "sin": lambda a, _: np.sin(a),
    "cos": lambda a, _: np.cos(a),
    "tan": lambda a, _: np.tan(a),
    "asin": lambda a, _: np.arcsin(a),
    "acos": lambda a, _: np.arccos(a),
    "exp": lambda a, _: np.exp(a),
    "log": lambda a, _: np.log(a),
    "rint": lambda a, _: np.rint(a),
    "sign": lambda a, _: np.sign(a),
}

ONE: dict[str, Operation] = MANY | {
    "sqrt": lambda a, _: math.sqrt(a),
    "rsqrt": lambda a, _: 1.0 / math.sqrt(a),
    "sin": lambda a, _: math.sin(a),
    "cos": lambda a, _: math.cos(a),
    "atan2": math.atan2,
    "max": max,
    "min": min,
}
"""Of single numbers; some raise ArithmeticError or ValueError where numpy gives inf or nan."""


class NumpyProgram:
    """Outputs as a function of inputs, each a number or an array along the positions.

    What does not change along the positions is computed as single numbers, unless ``many`` inputs are arrays.
    """

    def __init__(
        self, graph: Graph, inputs: Sequence[Node], outputs: Sequence[Node], many: bool = False
    ) -> None:
        order = graph.order(outputs)
        self.start: list[Any] = [None] * len(inputs)
        place = {node.index: k for k, node in enumerate(inputs)}
        last = {x.index: n.index for n in order for x in (n.a, n.b) if x is not None}
        wanted: dict[int, list[int]] = {}
        for k, node in enumerate(outputs):
            wanted.setdefault(node.index, []).append(k)
        self.steps: list[tuple[Operation, int, int, int]] = []
        self.fills: list[tuple[int, int]] = []
        free: list[int] = []
        for n in order:
            if n.op == "const":
                place[n.index] = len(self.start)
                self.start.append(n.value)
            elif n.op not in INPUTS:
                assert n.a is not None
                a, b = place[n.a.index], place[(n.b or n.a).index]
                for x in {n.a.index, (n.b or n.a).index}:
                    if last[x] == n.index and x not in wanted and graph.nodes[x].a is not None:
                        free.append(place[x])
                if not free:
                    free.append(len(self.start))
                    self.start.append(None)
                place[n.index] = free.pop()
                operations = MANY if many or n.level & POSITION else ONE
                self.steps.append((operations[n.op], a, b, place[n.index]))
            self.fills += [(row, place[n.index]) for row in wanted.get(n.index, ())]

    def __call__(self, given: Sequence[Numeric], out: Array) -> None:
        """Put outputs (outputs, ...) for values of the inputs into an array."""
        v = self.start.copy()
        v[: len(given)] = given
        for operation, a, b, c in self.steps:
            v[c] = operation(v[a], v[b])
        for row, place in self.fills:
            out[row] = v[place]
