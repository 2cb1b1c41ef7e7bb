"""Nodes of efforts that depend on positions, speeds and time, of elastic stops, of rotors behind gears, and of stops
that are struck.

Mechanics: docs/theory.md 10.6, 10.10.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from dalembert.analysis.batch.tracing.symbolic_model import with_numbers
from dalembert.analysis.batch.tracing.traced_analysis import Trace
from dalembert.analysis.batch.tracing.traced_parameters import symbol_functions
from dalembert.kernel.graph import Graph, Node, node
from dalembert.machine.motion.actuation import Actuation, joint_stops
from dalembert.model import Mechanism
from dalembert.model.drives.end_stops import Stops
from dalembert.model.quantities.coordinates import SPEED, TIME
from dalembert.model.quantities.expression_trees import Functions
from dalembert.model.quantities.tables import Table

SIDES = (-1.0, 1.0)
ROOM = 0.1
"""Angle before half a turn, rad, from which on full turns of a joint would have to be counted."""


class StopNodes(NamedTuple):
    """A stop that is struck, or a clutch that holds: the ``margin`` left, its decrease per unit of each drive (D,), and
    the restitution; ``drive``: whose it is, or -1."""

    margin: Node
    closing: Sequence[Node]
    restitution: Node
    drive: int
    clutch: bool = False

    @property
    def nodes(self) -> list[Node]:
        """All of it in a row."""
        return [self.margin, self.restitution, *self.closing]


@dataclass
class ActingNodes:
    """A machine's efforts (D,) required, inertia (D D,), forces of elastic stops by the index of their input, stops
    that are struck, time constants of motors by drive, and what is below zero where a design is left to its motion
    alone."""

    effort: list[Node]
    mass: list[Node]
    pushes: dict[int, Node] = field(default_factory=dict)
    stops: list[StopNodes] = field(default_factory=list)
    late: dict[int, Node] = field(default_factory=dict)
    lost: list[Node] = field(default_factory=list)


def trace_acting(
    out: ActingNodes,
    trace: Trace,
    acting: Actuation | None,
    m: Mechanism,
    freedoms: Sequence[Node],
    functions: Functions,
    numbers: Sequence[Node],
) -> None:
    """Adds to efforts and inertia what acts on the drives of a machine and in its joints; ``m``: the same with all
    drives prescribed; ``freedoms``: those watched; ``numbers``: nodes of those of the trace."""
    if acting is None:
        return
    graph, names = trace.catalogue.graph, list(m.drives)
    varied = {n: x for n, x in zip(trace.numbers, numbers, strict=True) if n.parameter}
    machine, ends = acting.m, m
    if varied:
        of = symbol_functions(graph)
        machine, ends = (with_numbers(x, varied, varied.values(), of) for x in (machine, m))
    known = {name: trace.inputs.named["channel", f"position {name}"] for name in names}
    known |= dict(zip((name + SPEED for name in names), numbers[-2 * len(names) :], strict=False))
    known[TIME] = trace.inputs.time()
    for k in np.flatnonzero(acting.free).tolist():
        _add_drive(graph, out, machine, k, known, functions)
    rows = np.array(freedoms, object).reshape(-1, 3 + len(names))
    elastic = 0
    for ((joint, freedom), stops), (x, rate, _, *slopes) in zip(
        joint_stops(ends).items(), rows, strict=False
    ):
        if sign := getattr(m.joints[joint], "way", 0.0):
            away = [-sign * n for n in slopes]
            out.stops.append(StopNodes(sign * rate, away, graph.zero, -1, clutch=True))
            continue
        place = _counted(graph, out, stops, x) if freedom == "turn" else x
        if not stops.stiffness:
            out.stops += _ends(graph, stops, place, slopes, -1)
            continue
        push = next(i for i, text in graph.names.items() if text == f"push {elastic}")
        out.pushes[push] = node(graph, stop_force(stops, place, rate, functions))
        elastic += 1


def _add_drive(
    graph: Graph, out: ActingNodes, machine: Mechanism, k: int, known: Mapping[str, Any], functions: Functions
) -> None:
    """Adds what acts on one drive."""
    count, (name, drive) = len(machine.drives), list(machine.drives.items())[k]
    x, rate = known[name], known[name + SPEED]
    if hasattr(drive.effort, "at"):
        out.effort[k] = out.effort[k] - _effort(graph, drive.effort, known, functions)
    if drive.stops is not None and drive.stops.stiffness:
        out.effort[k] = out.effort[k] - stop_force(drive.stops, x, rate, functions)
    elif drive.stops is not None:
        unit = [graph.constant(float(j == k)) for j in range(count)]
        out.stops += _ends(graph, drive.stops, x, unit, k)
    motor = drive.motor
    if motor is not None and motor.inertia:
        place = k * count + k
        out.mass[place] = out.mass[place] + motor.inertia * motor.ratio**2
    if motor is not None and motor.time_constant:
        out.late[k] = node(graph, motor.time_constant)


def _counted(graph: Graph, out: ActingNodes, stops: Stops, x: Node) -> Node:
    """An angle, known up to full turns, within half a turn of the middle of its stops; where these count full
    turns, of its start: beyond that a design is lost."""
    middle: Any = (stops.least + stops.greatest) / 2
    counts = not _number(stops.greatest) - _number(stops.least) < 2 * np.pi
    if counts:
        ends = Stops(_number(stops.least), _number(stops.greatest))
        middle = within(ends, float(np.ravel(graph.evaluate([x], {})[0])[0]))
    x = x - 2 * np.pi * ((x - middle) / (2 * np.pi)).rint()
    if counts:
        out.lost.append((np.pi - ROOM) ** 2 - (x - middle) ** 2)
    return x


def stop_force(stops: Stops, x: Node, rate: Node, functions: Functions) -> Node:
    """Force of elastic stops in their freedom, each of its switches on one side."""
    out: Any = 0.0
    for side, end in zip(SIDES, (stops.least, stops.greatest), strict=True):
        if not np.isfinite(_number(end)):
            continue
        depth = side * (x - end)
        acts, push = (1.0 + functions["sign"](depth)) / 2, stops.stiffness * depth
        if _number(stops.damping):
            push = push + stops.damping * (side * rate)
            acts = acts * ((1.0 + functions["sign"](push)) / 2)
        out = out - side * (acts * push)
    return out  # type: ignore[no-any-return]


def _ends(graph: Graph, stops: Stops, x: Node, slopes: Sequence[Node], drive: int) -> list[StopNodes]:
    """The ends of stops that are struck."""
    ends = zip(SIDES, (stops.least, stops.greatest), strict=True)
    back = node(graph, stops.restitution)
    return [
        StopNodes(side * (end - x), [side * n for n in slopes], back, drive)
        for side, end in ends
        if np.isfinite(_number(end))
    ]


def _effort(graph: Graph, effort: Any, known: Mapping[str, Any], functions: Functions) -> Node:
    """An effort that depends on positions, speeds and time; a table of straight lines by its corners."""
    if not isinstance(effort, Table) or effort.interpolate != "linear":
        return node(graph, effort.at(known, functions))
    corner: Callable[[Any, Any], Any] = functions["max"]
    breaks, (slope, first) = effort.pieces()
    x, out, before = known[effort.against] - effort.shift, first[0] + 0.0, 0.0
    for at, new in zip(breaks, [*slope, 0.0], strict=True):
        out = out + (new - before) * corner(x - at, 0.0)
        before = new
    return node(graph, out * effort.times)


def _number(x: Any) -> float:
    """A number, or that of the description for a symbol."""
    return float(np.ravel(x.graph.evaluate([x], {})[0])[0]) if isinstance(x, Node) else float(x)


def within(stops: Stops, x: float) -> float:
    """The angle equal to x up to full turns that is between stops, or nearest to them.

    >>> round(within(Stops(5.0, 6.0), -1.0), 4)
    5.2832
    """
    turns = [x + 2 * np.pi * n for n in range(-2, 3)]
    return min(turns, key=lambda x: (max(stops.least - x, x - stops.greatest, 0.0), abs(x)))
