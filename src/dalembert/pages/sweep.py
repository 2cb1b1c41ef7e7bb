"""A cycle for a mechanism whose file has one position: its first drive moves as far as the linkage closes."""

from __future__ import annotations

import math

import numpy as np

from dalembert.analysis.batch.compiled_kernel import Kernel
from dalembert.analysis.batch.kernel_export import plain
from dalembert.analysis.batch.tracing.traced_analysis import trace_analysis
from dalembert.arrays import Array, Flags
from dalembert.errors import ModelError
from dalembert.model import Mechanism
from dalembert.model.drives.drives import Range

TURN, STROKE = 72, 40
"""Steps of a full turn and of a slide."""
NEAR = 1e-4
"""Fraction of the range at which the motion next to the file's position is traced."""


def with_cycle(m: Mechanism) -> Mechanism:
    """The mechanism with its first drive moved over a turn, or its slide to both sides, if the file has one position.

    Where the linkage does not close over the full range, as far as it closes; the file's position is included.
    """
    single = {name: d for name, d in m.drives.items() if isinstance(d.position, float)}
    steady = all(isinstance(d.speed, float) and isinstance(d.acceleration, float) for d in single.values())
    if not m.drives or len(single) < len(m.drives) or not steady:
        return m
    name, d = next(iter(single.items()))
    assert isinstance(d.position, float)
    if d.turns:
        values = d.position + np.linspace(0, 2 * np.pi, TURN + 1) - np.pi
    else:
        values = d.position + np.linspace(-1, 1, STROKE + 1) * 0.25 * _reach(m)
    middle = len(values) // 2
    closes = _closing(m, name, values, middle)
    if closes.all() and d.turns:
        return _over(m, name, d.position, d.position + 2 * np.pi, TURN)
    low = middle - int(np.argmin([*closes[middle::-1], False])) + 1
    high = middle + int(np.argmin([*closes[middle:], False])) - 1
    return _over(m, name, values[low], values[high], high - low + 1) if high > low else m


def file_place(m: Mechanism, cycle: Mechanism) -> float:
    """The place of the file's own position in the cycle: its number, the first being 0."""
    for name, d in m.drives.items():
        over = cycle.drives[name].position
        if isinstance(d.position, float) and isinstance(over, Range) and over.stop != over.start:
            return (d.position - over.start) / (over.stop - over.start) * (over.count - 1)
    return 0.0


def _over(m: Mechanism, drive: str, low: float, high: float, count: int) -> Mechanism:
    return m.with_values({f"drives.{drive}.position": Range(float(low), float(high), count)})


def _closing(m: Mechanism, drive: str, values: Array, middle: int) -> Flags:
    """True where the linkage closes on the file's branch; True everywhere if only following the motion can decide."""
    step = NEAR * (values[-1] - values[0])
    try:
        trace = trace_analysis(_over(m, drive, values[middle] - step, values[middle] + step, 3), (), False)
    except ModelError:
        return np.asarray(np.arange(len(values)) == middle)
    program = plain(Kernel(m, trace, (), None, False, 1), [], marked=True)
    channels = program.inputs_in_use("channel")
    graph = program.graph
    if [graph.names[n.index] for n in channels] != [f"position {drive}"]:
        return np.ones(len(values), bool)
    tests = graph.evaluate(program.flags.open, {channels[0].index: values})
    met = [np.broadcast_to(np.asarray(t) >= 0, len(values)) for t in tests]
    return np.asarray(np.all([np.ones(len(values), bool), *met], axis=0))


def _reach(m: Mechanism) -> float:
    """The largest distance of a link's points from its origin, m."""
    points = [m.point(name, point) for name, link in m.links.items() for point in link.points]
    return max((math.hypot(*p) for p in points), default=1.0)
