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


def slopes(k: Any, output: str, n: int) -> np.ndarray:
    """d output / d number n at the file's own numbers, (position, component)."""
    graph, nodes = k.trace.catalogue.graph, k.nodes[output]
    done: dict[int, Any] = {}
    with np.errstate(all="ignore"):
        for node in graph.order(nodes):
            done[node.index] = _value(graph, node, n, done)
    count = len(k.trace.course.schedule.position)
    columns = [np.broadcast_to(np.imag(done[node.index]) / STEP, (count,)) for node in nodes]
    return np.stack(columns, axis=-1)


def _value(graph: Any, node: Node, n: int, done: dict[int, Any]) -> Any:
    if node.op == "const":
        return complex(node.value)
    if node.op in INPUTS:
        step = STEP * 1j if node.op == "number" and node.value == n else 0j
        return graph.nominal[node.index] + step
    assert node.a is not None
    arguments = (node.a,) if node.b is None else (node.a, node.b)
    return COMPLEX[node.op](*(done[a.index] for a in arguments))
