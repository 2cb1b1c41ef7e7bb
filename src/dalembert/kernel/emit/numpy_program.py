"""A traced program evaluated with numpy, one operation after the other: no compiler is needed, and nothing compiled."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cached_property

from dalembert.arrays import Array, Numeric
from dalembert.kernel.graph import INPUTS, POSITION, Graph, Node
from dalembert.kernel.operations import EVALUATE

SINGLE: dict[str, Callable[..., Numeric]] = EVALUATE | {
    "inv": lambda a: 1.0 / a,
    "sqrt": math.sqrt,
    "rsqrt": lambda a: 1.0 / math.sqrt(a),
    "abs": abs,
    "sin": math.sin,
    "cos": math.cos,
    "atan2": math.atan2,
    "max": lambda a, b: a if a >= b or a != a else b,
    "min": lambda a, b: a if a <= b or a != a else b,
}
"""Operations of single numbers; some raise ArithmeticError or ValueError where numpy gives inf or nan."""


class NumpyProgram:
    """Outputs as a function of inputs, each a number or an array along the positions.

    What does not change along the positions is computed as single numbers, unless ``many`` inputs are arrays; of
    one position everything is.
    """

    def __init__(
        self, graph: Graph, inputs: Sequence[Node], outputs: Sequence[Node], many: bool = False
    ) -> None:
        order = graph.order(outputs)
        self.start: list[object] = [None] * len(inputs)
        place = {node.index: k for k, node in enumerate(inputs)}
        last = {x.index: n.index for n in order for x in (n.a, n.b) if x is not None}
        wanted: dict[int, list[int]] = {}
        for k, node in enumerate(outputs):
            wanted.setdefault(node.index, []).append(k)
        self.steps: list[tuple[Callable[..., Numeric], int, int, int]] = []
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
                operations = EVALUATE if many or n.level & POSITION else SINGLE
                self.steps.append((operations[n.op], a, -1 if n.b is None else b, place[n.index]))
            self.fills += [(row, place[n.index]) for row in wanted.get(n.index, ())]

    @cached_property
    def single_steps(self) -> list[tuple[Callable[..., Numeric], int, int, int]]:
        """The steps on single numbers."""
        single = {operation: SINGLE[name] for name, operation in EVALUATE.items()}
        return [(single.get(f, f), a, b, c) for f, a, b, c in self.steps]

    def __call__(self, given: Sequence[Numeric], out: Array, one: bool = False) -> None:
        """Put outputs (outputs, ...) for values of the inputs into an array; of ``one`` position all are floats."""
        v = self.start.copy()
        v[: len(given)] = given
        for operation, a, b, c in self.single_steps if one else self.steps:
            v[c] = operation(v[a]) if b < 0 else operation(v[a], v[b])
        for row, place in self.fills:
            out[row] = v[place]
