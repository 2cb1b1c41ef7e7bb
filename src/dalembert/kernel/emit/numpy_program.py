"""A traced program evaluated with numpy, one operation after the other, without a compiler."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cached_property

from dalembert.arrays import Array, Numeric
from dalembert.kernel.graph import POSITION, Graph, Node
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

    Values that do not change along the positions are computed as single numbers, unless ``many`` inputs are arrays;
    with one position all are.
    """

    def __init__(
        self, graph: Graph, inputs: Sequence[Node], outputs: Sequence[Node], many: bool = False
    ) -> None:
        order = graph.order(outputs)
        start: list[object] = [None] * len(inputs)
        place = {node.index: k for k, node in enumerate(inputs)}
        last: dict[int, int] = {}
        for n in order:
            if n.a is not None:
                last[n.a.index] = last[(n.a if n.b is None else n.b).index] = n.index
        wanted: dict[int, list[int]] = {}
        for k, node in enumerate(outputs):
            wanted.setdefault(node.index, []).append(k)
        steps: list[tuple[Callable[..., Numeric], int, int, int]] = []
        free: list[int] = []
        passing: set[int] = set()  # computed values that are not outputs: their places are reused
        for n in order:
            if n.op == "const":
                place[n.index] = len(start)
                start.append(n.value)
            elif n.a is not None:
                one, two = n.a.index, -1 if n.b is None else n.b.index
                if last[one] == n.index and one in passing:
                    free.append(place[one])
                if two not in (-1, one) and last[two] == n.index and two in passing:
                    free.append(place[two])
                if not free:
                    free.append(len(start))
                    start.append(None)
                if n.index not in wanted:
                    passing.add(n.index)
                place[n.index] = target = free.pop()
                operations = EVALUATE if many or n.level & POSITION else SINGLE
                steps.append((operations[n.op], place[one], place[two] if two >= 0 else -1, target))
        self.start, self.steps = start, steps
        self.fills = [(row, place[index]) for index, rows in wanted.items() for row in rows]

    @cached_property
    def single_steps(self) -> list[tuple[Callable[..., Numeric], int, int, int]]:
        """The steps on single numbers."""
        single = {operation: SINGLE[name] for name, operation in EVALUATE.items()}
        return [(single.get(f, f), a, b, c) for f, a, b, c in self.steps]

    def __call__(self, inputs: Sequence[Numeric], out: Array, one: bool = False) -> None:
        """Fills an array with the outputs (outputs, ...) for values of the inputs; with ``one`` position all are
        floats."""
        v = self.start.copy()
        v[: len(inputs)] = inputs
        for operation, a, b, c in self.single_steps if one else self.steps:
            v[c] = operation(v[a]) if b < 0 else operation(v[a], v[b])
        for row, place in self.fills:
            out[row] = v[place]
