"""A program as a casadi Function, for those who optimise with casadi."""

from __future__ import annotations

from typing import Any

from dalembert.kernel.graph import Node
from dalembert.kernel.program import Program


def function(program: Program, name: str, numbers: int, outputs: list[tuple[str, int]]) -> Any:
    """Function of (values, inputs) to the named outputs and ``mark`` (0 right, 1 open, 2 doubtful)."""
    import casadi as ca

    v, c = ca.SX.sym("values", numbers), ca.SX.sym("inputs", len(program.used("channel")))
    done: dict[int, Any] = {}
    for node in program.order:
        done[node.index] = _value(ca, node, program, v, c, done)
    found, place = [], 0
    for _, size in outputs:
        found.append(ca.vertcat(*(done[n.index] for n in program.outputs[place : place + size])))
        place += size
    opened = ca.logic_or(*_any(ca, [done[n.index] < 0 for n in program.open]))
    doubt = ca.logic_or(*_any(ca, [ca.logic_not(done[n.index] >= 0) for n in program.doubt]))
    mark = ca.if_else(opened, 1, ca.if_else(doubt, 2, 0))
    return ca.Function(name, [v, c], [*found, mark], ["values", "inputs"], [*(o for o, _ in outputs), "mark"])


def _any(ca: Any, tests: list[Any]) -> tuple[Any, Any]:
    total = ca.SX(0)
    for test in tests:
        total = ca.logic_or(total, test)
    return total, ca.SX(0)


def _value(ca: Any, node: Node, program: Program, v: Any, c: Any, done: dict[int, Any]) -> Any:
    if node.op == "const":
        return ca.SX(node.value)
    if node.op == "number":
        return v[program.places[node.index]]
    if node.op == "channel":
        return c[program.places[node.index]]
    assert node.a is not None
    a = done[node.a.index]
    if node.b is not None:
        b = done[node.b.index]
        two = {"add": lambda: a + b, "sub": lambda: a - b, "mul": lambda: a * b}
        two |= {"atan2": lambda: ca.atan2(a, b), "max": lambda: ca.fmax(a, b), "min": lambda: ca.fmin(a, b)}
        return two[node.op]()
    one = {"neg": lambda: -a, "inv": lambda: 1 / a, "abs": lambda: ca.fabs(a), "detach": lambda: a}
    one |= {"rint": lambda: ca.floor(a + 0.5), "rsqrt": lambda: 1 / ca.sqrt(a)}
    return one[node.op]() if node.op in one else getattr(ca, node.op)(a)
