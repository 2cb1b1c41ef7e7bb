"""Rates of a motion in machine code, with all that is watched behind them, and outputs at its states.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from dalembert.arrays import Array, Flags
from dalembert.kernel.emit.integrator import state_size
from dalembert.kernel.graph import trace_array
from dalembert.machine.motion.coded.rate_program import Corners, at_state, rate_code, trace_rates
from dalembert.machine.motion.coded.steps import Integrator
from dalembert.machine.motion.equation import LOCK, Equation
from dalembert.machine.motion.rest.dry_friction import sided


@dataclass(frozen=True)
class EventCode:
    """``steps``: watched are rates of the independent contacts, margins of those that bear on sides; where contacts may
    stick (``sticking``) room and part of the limit of each; of each of the ``stops`` its margin, restitution and
    decrease of the margin per unit of each drive; forces of contacts that may be ``lost``, and what switches loads.
    ``asked``: watched are the outputs, then what is below zero where a state is in doubt. Behind the values of
    ``Equation.steps`` one follows: 1 at rest. ``open_``: outputs that friction at rest leaves open."""

    steps: Integrator
    outputs_code: Integrator
    drives: int
    contacts: int
    margins: int
    sticking: int
    stops: int
    lost: int
    corners: int
    outputs: int
    open_: Flags

    def place(self, what: str) -> int:
        """First of what is watched of a kind: ``margins``, ``sticking``, ``stops``, ``lost``, ``corners``."""
        sizes = {
            "contacts": self.contacts,
            "margins": self.margins,
            "sticking": self.sticking,
            "stops": self.stops * (2 + self.drives),
            "lost": self.lost,
            "corners": self.corners,
        }
        kinds = list(sizes)
        return sum(sizes[kind] for kind in kinds[: kinds.index(what)])


def event_code(
    equation: Equation, free: Flags, corners: Mapping[int, Corners], lanes: int
) -> EventCode | None:
    """None where drives must be followed from state to state, or friction makes the program too long."""
    if equation.known or any(callable(f) for f in (*equation.channels, *equation.asked_channels)):
        return None
    graph, d = equation.graph, len(equation.names)
    with LOCK:
        r = trace_rates(equation, free, 2 * d + len(equation.late), corners, at_rest=True)
        rate = [*r.slots[d : 2 * d], *r.a, *r.late]
        first, last, stops = *equation.ends[5:7], equation.ends[-1]
        rubbing = {n.index: x for n, x in zip(equation.friction, trace_array(graph, r.cz), strict=True)}
        forces = equation.asked.outputs[len(equation.asked.outputs) - equation.lost :]
        ends = at_state(equation, r.slots, r.a, equation.program.outputs[stops:])
        lost = graph.substitute(at_state(equation, r.slots, r.a, forces), rubbing)
        switching = at_state(equation, r.slots, r.a, equation.program.outputs[first:last])
        steps = rate_code(equation, r, [*rate, *r.watched, *ends, *lost, *switching], lanes)
        outputs = at_state(equation, r.slots, r.a * (1.0 - r.given[-1]), equation.asked.outputs)
        outputs_code = rate_code(equation, r, [*rate, *graph.substitute(outputs, rubbing)], lanes)
    if steps is None or outputs_code is None:
        return None
    count = sum(map(len, equation.kernel.nodes.values()))
    open_ = [any(n.index in rubbing for n in graph.order([x])) for x in outputs[:count]]
    dry = equation.dry
    contacts, margins = (len(dry.own), 2 * len(sided(dry.contacts))) if dry else (0, 0)
    sticking = 2 * contacts if free.sum() > 1 else 0
    watched = contacts, margins, sticking, len(equation.stops), equation.lost, int(last - first)
    return EventCode(steps, outputs_code, d, *watched, count, np.array(open_, bool))


def look(code: Integrator, values: Array, t: Array, y: Array) -> tuple[Array, Array]:
    """Rates (M, n) at states (M, n) and times of motions with values (M, ...), and what is watched (M, W)."""
    if not len(y):
        return np.zeros((0, code.n)), np.zeros((0, code.watched))
    motions = code.motions(y, t, 0.0, 1.0, 1.0)
    code.advance(code.blocks(values), motions, 0)
    rows = motions.transpose(0, 2, 1).reshape(-1, motions.shape[1])[: len(y)]
    n = code.n
    return rows[:, n : 2 * n], rows[:, state_size(n) :]
