"""A traced program as one Python function, for numbers or for arrays along the positions: no compiler is needed.

The text holds operations and names like `v12` only; whatever a user has written comes in as arguments.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from dalembert.arrays import Array, Numeric
from dalembert.kernel.graph import INPUTS, POSITION, Graph, Node

INFIX = {
    "add": "{} + {}",
    "sub": "{} - {}",
    "mul": "{} * {}",
    "neg": "-{}",
    "inv": "1.0 / {}",
    "abs": "abs({})",
}
CALLS = {"sqrt": "sqrt", "sin": "sin", "cos": "cos", "tan": "tan", "exp": "exp", "log": "log", "rint": "rint"}
CALLS |= {
    "sign": "sign",
    "atan2": "arctan2",
    "max": "maximum",
    "min": "minimum",
    "asin": "arcsin",
    "acos": "arccos",
}
ONE: dict[str, Callable[..., float]] = {
    "sqrt": math.sqrt,
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "exp": math.exp,
    "log": math.log,
    "rint": round,
    "sign": lambda x: float(np.sign(x)),
    "arctan2": math.atan2,
    "maximum": max,
    "minimum": min,
    "arcsin": math.asin,
    "arccos": math.acos,
}
"""Of single numbers; some raise ArithmeticError or ValueError where numpy gives inf or nan."""


def numpy_function(
    graph: Graph, inputs: Sequence[Node], outputs: Sequence[Node], many: bool
) -> Callable[[Sequence[Numeric], Array], None]:
    """A function of the inputs' values and of an array (outputs, ...) that it fills.

    With ``many`` every value may be an array, else channels may (what does not change along the positions is computed
    once, as single numbers).
    """
    text = "\n    ".join(_lines(graph, inputs, outputs, many))
    names: dict[str, Any] = {name: getattr(np, name) for name in CALLS.values()}
    names |= {f"one_{name}": function for name, function in ONE.items()}
    exec(compile(f"def program(given, out):\n    {text}\n", "<traced program>", "exec"), names)
    found: Callable[[Sequence[Numeric], Array], None] = names["program"]
    return found


def _lines(graph: Graph, inputs: Sequence[Node], outputs: Sequence[Node], many: bool) -> list[str]:
    """Statements; a name is taken again when its value is not needed any more, so that little memory is in use."""
    order = graph.order(outputs)
    last = {x.index: k for k, n in enumerate(order) for x in (n.a, n.b) if x is not None}
    wanted: dict[int, list[int]] = {}
    for k, node in enumerate(outputs):
        wanted.setdefault(node.index, []).append(k)
    place = {node.index: k for k, node in enumerate(inputs)}
    name: dict[int, str] = {}
    free: list[str] = []
    lines = []
    for k, n in enumerate(order):
        if n.op == "const":
            name[n.index] = repr(n.value) if math.isfinite(n.value) else f"float('{n.value}')"
        elif n.op in INPUTS:
            name[n.index] = f"given[{place[n.index]}]"
        else:
            value = _expression(n, [name[x.index] for x in (n.a, n.b) if x is not None], many)
            free += [
                name[x]
                for x in {y.index for y in (n.a, n.b) if y is not None}
                if last[x] == k and name[x][0] == "v"
            ]
            name[n.index] = free.pop() if free else f"v{k}"
            lines.append(f"{name[n.index]} = {value}")
        lines += [f"out[{row}] = {name[n.index]}" for row in wanted.get(n.index, ())]
        if n.index not in last and name[n.index][0] == "v":
            free.append(name[n.index])
    return lines or ["pass"]


def _expression(n: Node, of: list[str], many: bool) -> str:
    single = not many and not n.level & POSITION
    call = "one_" if single else ""
    if n.op == "detach":
        return of[0]
    if n.op == "rsqrt":
        return f"1.0 / {call}sqrt({of[0]})"
    if n.op == "positive":
        return f"({of[0]} > 0) * 1.0"
    return INFIX[n.op].format(*of) if n.op in INFIX else f"{call}{CALLS[n.op]}({', '.join(of)})"
