"""Exact derivatives of nodes with respect to inputs, as nodes: by reverse or by forward mode, whichever is shorter.

Mechanics: docs/theory.md 8.
"""

from __future__ import annotations

from collections.abc import Sequence

from dalembert.kernel.graph import Graph, Node, is_zero


def gradients(graph: Graph, outputs: Sequence[Node], inputs: Sequence[Node]) -> list[list[Node]]:
    """d output / d input, one list per output."""
    if 1.5 * len(outputs) <= len(inputs):
        return [_reverse(graph, node, inputs) for node in outputs]
    return _forward(graph, outputs, inputs)


def _active(order: Sequence[Node], inputs: Sequence[Node]) -> set[int]:
    """Nodes that change with the inputs."""
    out = {n.index for n in inputs}
    for node in order:
        if node.op == "detach":
            continue
        if (node.a is not None and node.a.index in out) or (node.b is not None and node.b.index in out):
            out.add(node.index)
    return out


def _partials(graph: Graph, n: Node) -> tuple[Node | float, Node | float]:
    """Derivatives of an operation with respect to its arguments."""
    a, b = n.a, n.b
    assert a is not None
    if n.op == "add":
        return 1.0, 1.0
    if n.op == "sub":
        return 1.0, -1.0
    if n.op == "neg":
        return -1.0, 0.0
    if n.op == "inv":
        return -(n * n), 0.0
    if n.op == "sqrt":
        return 0.5 / n, 0.0
    if n.op == "rsqrt":
        return -0.5 * (n * n * n), 0.0
    if n.op == "abs":
        return a.sign(), 0.0
    if n.op == "sin":
        return a.cos(), 0.0
    if n.op == "cos":
        return -a.sin(), 0.0
    if n.op in ("sign", "positive", "rint", "detach"):
        return 0.0, 0.0
    assert b is not None
    if n.op == "mul":
        return b, a
    if n.op == "atan2":
        over = 1.0 / (a * a + b * b)
        return b * over, -(a * over)
    if n.op == "max":
        first = 0.5 + 0.5 * (a - b).sign()
        return first, 1.0 - first
    raise ValueError(f"no derivative of {n.op}")


def _reverse(graph: Graph, output: Node, inputs: Sequence[Node]) -> list[Node]:
    order = graph.order([output])
    active = _active(order, inputs)
    adjoint: dict[int, Node] = {output.index: graph.one}
    for node in reversed(order):
        seed = adjoint.get(node.index)
        if seed is None or node.a is None or node.index not in active:
            continue
        for argument, partial in zip((node.a, node.b), _partials(graph, node), strict=True):
            if argument is not None and argument.index in active and not is_zero(partial):
                term = seed * partial
                before = adjoint.get(argument.index)
                adjoint[argument.index] = term if before is None else before + term
    return [adjoint.get(n.index, graph.zero) for n in inputs]


def _forward(graph: Graph, outputs: Sequence[Node], inputs: Sequence[Node]) -> list[list[Node]]:
    order = graph.order(outputs)
    columns = []
    for variable in inputs:
        rate: dict[int, Node] = {variable.index: graph.one}
        for node in order:
            if node.a is None or node.op == "detach":
                continue
            total: Node | None = None
            if node.a.index not in rate and (node.b is None or node.b.index not in rate):
                continue
            for argument, partial in zip((node.a, node.b), _partials(graph, node), strict=True):
                if argument is not None and argument.index in rate and not is_zero(partial):
                    term = rate[argument.index] * partial
                    total = term if total is None else total + term
            if total is not None and not is_zero(total):
                rate[node.index] = total
        columns.append([rate.get(n.index, graph.zero) for n in outputs])
    return [list(row) for row in zip(*columns, strict=True)] if columns else [[] for _ in outputs]
