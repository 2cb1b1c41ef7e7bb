"""A program as a casadi Function, for those who optimise with casadi."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType
from typing import Any

from dalembert.kernel.graph import Node
from dalembert.kernel.program import CODES, Program

Expression = Any
"""Symbolic expression of casadi; the package has no type annotations."""


def function(program: Program, name: str, numbers: int, outputs: list[tuple[str, int]]) -> Expression:
    """Function of (values, inputs) to the named outputs and ``mark``: 0, or one of the status ``CODES``."""
    import casadi as ca

    v, c = ca.SX.sym("values", numbers), ca.SX.sym("inputs", len(program.inputs_in_use("channel")))
    done: dict[int, Expression] = {}
    for node in program.order:
        done[node.index] = _value(ca, node, program, v, c, done)
    results, place = [], 0
    for _, size in outputs:
        results.append(ca.vertcat(*(done[n.index] for n in program.outputs[place : place + size])))
        place += size
    mark = _mark(ca, program, done)
    return ca.Function(
        name, [v, c], [*results, mark], ["values", "inputs"], [*(o for o, _ in outputs), "mark"]
    )


def _mark(ca: ModuleType, program: Program, done: dict[int, Expression]) -> Expression:
    m = program.flags

    def below(nodes: tuple[Node, ...]) -> Expression:
        return _any(ca, [done[n.index] < 0 for n in nodes])

    def unsure(nodes: tuple[Node, ...]) -> Expression:
        return _any(ca, [ca.logic_not(done[n.index] >= 0) for n in nodes])

    turned = below(m.turned)
    locked = ca.logic_and(turned, below(m.locked)) if m.locked else turned
    single = ca.logic_and(unsure(m.unsure), unsure(m.sure))
    slips = _any(ca, [unsure(m.slips), single, ca.logic_and(turned, unsure(m.still))])
    rest, jam = below(m.rest), ca.logic_and(single, below(m.jam))
    doubt = ca.logic_or(unsure(m.doubt), ca.logic_and(ca.logic_not(ca.logic_or(rest, jam)), slips))
    mark: Expression = ca.SX(0)
    flags = {"open": below(m.open), "doubt": doubt, "rest": rest, "jam": jam}
    flags |= {"contact": below(m.contact), "locked": locked}
    flags |= {"slope": unsure(m.slope), "outside": below(m.outside)}
    for name, test in reversed(flags.items()):
        mark = ca.if_else(test, CODES[name], mark)
    return mark


def _any(ca: ModuleType, tests: list[Expression]) -> Expression:
    total = ca.SX(0)
    for test in tests:
        total = ca.logic_or(total, test)
    return total


def _value(
    ca: ModuleType, node: Node, program: Program, v: Expression, c: Expression, done: dict[int, Expression]
) -> Expression:
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
    one: dict[str, Callable[[], Expression]] = {
        "neg": lambda: -a,
        "inv": lambda: 1 / a,
        "abs": lambda: ca.fabs(a),
        "detach": lambda: a,
    }
    one |= {"positive": lambda: a > 0, "rsqrt": lambda: 1 / ca.sqrt(a)}
    one |= {"rint": lambda: ca.floor(a + 0.5)}
    return one[node.op]() if node.op in one else getattr(ca, node.op)(a)
