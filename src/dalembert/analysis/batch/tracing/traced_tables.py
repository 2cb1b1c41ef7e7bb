"""Tables as nodes: differentiable by what they are against, by their values, their factor and their shift.

The piece is chosen by bisection, unrolled: each half is chosen by a flag that is 0 or 1, so that all is exact and the
slope is that of the piece. Beyond its ends a table holds its value, with a flag where it
refuses that.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.kernel.graph import Graph, Node, Scalar, node
from dalembert.model.quantities.tables import SLACK, Table

MOST = 1024
"""Pieces of a table that are compiled."""


def table_function(graph: Graph) -> Callable[[Table, Scalar], Node]:
    """The value of a table at a position, as a node."""

    def value(table: Table, position: Scalar) -> Node:
        breaks, coefficients = _pieces(table)
        if len(breaks) - 1 > MOST:
            what = f"a table of {len(breaks)} points is not compiled against {table.against!r}"
            raise ModelError(what, f"give it at most {MOST + 1}, or use da.dynamics, da.statics or da.sweep")
        place = _inside(graph, table, node(graph, position) - table.shift, breaks)
        chosen = _choose(graph, place, breaks, [breaks[:-1].tolist(), *coefficients])
        step, result = place - chosen[0], chosen[1]
        for coefficient in chosen[2:]:
            result = result * step + coefficient
        if table.outside == "zero" and table.period is None:
            below, above = _ends(table, node(graph, position) - table.shift)
            result = result * ((1.0 - (-below).positive()) * (1.0 - (-above).positive()))
        return node(graph, result * table.times)

    return value


def _pieces(table: Table) -> tuple[Array, Sequence[Sequence[Scalar]]]:
    """Breaks (n+1,) and coefficients (k, n), linear in those values that vary."""
    known = replace(table, y=tuple(0.0 if isinstance(y, Node) else y for y in table.y))
    breaks, numbers = known.pieces()
    coefficients = numbers.astype(object)
    closed = table.closed()[1] is table.y and table.period is not None
    for k, y in enumerate(table.y[: len(table.y) - closed]):
        if isinstance(y, Node):
            share = np.zeros(len(table.y))
            share[[k, -1] if closed and k == 0 else k] = 1.0
            coefficients = coefficients + y * replace(table, y=tuple(share.tolist())).pieces()[1]
    return breaks, coefficients.tolist()


def _inside(graph: Graph, table: Table, place: Node, breaks: Array) -> Node:
    """A position within the table, less full periods; what is below zero outside its ends is a doubt."""
    low, high = float(breaks[0]), float(breaks[-1])
    if table.period is not None:
        turns = (place - low) / table.period
        nearest = turns.rint()
        return place - graph.without_gradient(nearest - (nearest - turns).positive()) * table.period
    graph.outside += margins(table, place)
    return -(-(place.larger(low))).larger(-high)


def margins(table: Table, place: Node) -> list[Node]:
    """Below zero where a position, less the shift, is outside a table that refuses that."""
    return [] if table.period is not None or table.outside != "refuse" else _ends(table, place)


def _ends(table: Table, place: Node) -> list[Node]:
    low, high = table.x[0], table.x[-1]
    slack = SLACK * (high - low)
    return [place - (low - slack), (high + slack) - place]


def _choose(graph: Graph, place: Node, breaks: Array, rows: Sequence[Sequence[Scalar]]) -> list[Scalar]:
    """From each row (n,) of numbers, the one of the piece that contains the position."""
    if len(rows[0]) == 1:
        return [row[0] for row in rows]
    half = len(rows[0]) // 2
    behind = 1.0 - (float(breaks[half]) - place).positive()
    low = _choose(graph, place, breaks[: half + 1], [row[:half] for row in rows])
    high = _choose(graph, place, breaks[half:], [row[half:] for row in rows])
    return [
        a if a is b or (not isinstance(a, Node) and a == b) else behind * b + (1.0 - behind) * a
        for a, b in zip(low, high, strict=True)
    ]
