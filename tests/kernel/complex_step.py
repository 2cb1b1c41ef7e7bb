"""Derivatives of a traced program by the complex step: no subtraction, so no digits are lost, and no rule is shared."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from dalembert.kernel.graph import INPUTS, Node

STEP = 1e-100
"""Far below what could change a real part."""


def _by_real(test: Any, a: Any, b: Any) -> Any:
    return np.where(test(np.real(a), np.real(b)), a, b)


def _angle(y: Any, x: Any) -> Any:
    """atan2 of nearly real numbers: its real part, and the first order of the rest."""
    r = np.real(x) ** 2 + np.real(y) ** 2
    rate = (np.real(x) * np.imag(y) - np.real(y) * np.imag(x)) / r
    return np.arctan2(np.real(y), np.real(x)) + 1j * rate


COMPLEX: dict[str, Callable[..., Any]] = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "neg": lambda a: -a,
    "inv": lambda a: 1 / a,
    "sqrt": np.sqrt,
    "rsqrt": lambda a: 1 / np.sqrt(a),
    "abs": lambda a: np.where(np.real(a) < 0, -a, a),
    "sign": lambda a: np.sign(np.real(a)),
    "sin": np.sin,
    "cos": np.cos,
    "atan2": _angle,
    "rint": lambda a: np.rint(np.real(a)),
    "max": lambda a, b: _by_real(np.greater, a, b),
    "min": lambda a, b: _by_real(np.less, a, b),
    "detach": lambda a: a,  # Newton's iteration is followed whole; the program takes its last step alone
}


def slopes(k: Any, output: str) -> list[np.ndarray]:
    """d output / d number at the file's own numbers, (position, component) for each number."""
    graph, nodes = k.trace.catalogue.graph, k.nodes[output]
    order, count = graph.order(nodes), len(k.trace.course.schedule.position)
    plain: dict[int, Any] = {}
    _computed(graph, order, plain)
    out = []
    for n in range(len(k.numbers)):
        given = next((node for node in order if node.op == "number" and node.value == n), None)
        done = {} if given is None else {given.index: graph.nominal[given.index] + STEP * 1j}
        _computed(graph, _changed(order, set(done)), done, plain)
        found = [done.get(node.index, 0j) for node in nodes]
        out.append(np.stack([np.broadcast_to(np.imag(x) / STEP, (count,)) for x in found], axis=-1))
    return out


def _changed(order: list[Node], from_: set[int]) -> list[Node]:
    """The nodes that change with some, which are left out."""
    out, active = [], set(from_)
    for node in order:
        if {x.index for x in (node.a, node.b) if x is not None} & active:
            active.add(node.index)
            out.append(node)
    return out


def _computed(
    graph: Any, order: list[Node], done: dict[int, Any], plain: dict[int, Any] | None = None
) -> None:
    """Values of nodes in order, into ``done``; what is not there is taken from ``plain``."""

    def value(node: Node) -> Any:
        return done[node.index] if plain is None or node.index in done else plain[node.index]

    with np.errstate(all="ignore"):
        for node in order:
            if node.op == "const":
                done[node.index] = complex(node.value)
            elif node.op in INPUTS:
                done[node.index] = graph.nominal[node.index] + 0j
            else:
                done[node.index] = COMPLEX[node.op](*(value(x) for x in (node.a, node.b) if x is not None))
