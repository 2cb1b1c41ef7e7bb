"""Nodes that are negative where the general executor decides: what a traced position assumes of its loads."""

from __future__ import annotations

from collections.abc import Iterable
from functools import reduce

from dalembert.arrays import Array
from dalembert.core.forcing import TurningFrame
from dalembert.core.layout import Layout
from dalembert.kernel.graph import CONSTANT, Graph, Node, is_zero, trace_array


def uncertain(nodes: Iterable[Node]) -> tuple[Node, ...]:
    """Those that may be negative, or no number: all but constants that are not."""
    return tuple(n for n in nodes if n.level != CONSTANT or not n.value >= 0)


HELD = 1e-7
"""Couple about a line about which a link is free, over its length and the largest load, above which the general
executor decides whether it is zero."""


def unheld(graph: Graph, layout: Layout, spins: Array, w: Array) -> list[Node]:
    """Nodes that are negative where loads turn a link about the line of its two ball joints, about which it is free."""
    if not spins.size:
        return []
    size = HELD * layout.length * largest(graph, trace_array(graph, w * layout.wrench_scale))
    return [size - abs(x) for x in spins if not is_zero(x)]


MET = 1e-11
"""An effort that differs by less from the one given, over length and the largest force, is the one given."""


def unmet(frame: TurningFrame | None, square: list[Node], effort: Array, size: Node) -> list[Node]:
    """Nodes that are negative where no speed of a frame balances a given effort, or teeth that move apart have a part
    in it."""
    if frame is None or frame.driven < 0:
        return []
    return [*square, MET * size - abs(effort[frame.driven] - frame.effort[0])]


def largest(graph: Graph, array: Array) -> Node:
    """The largest size of some nodes."""
    return reduce(lambda top, x: graph.binary("max", top, abs(x)), array.ravel(), graph.zero)
