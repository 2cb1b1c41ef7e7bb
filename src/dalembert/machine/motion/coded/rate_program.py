"""Rates of a motion's state as a program: accelerations, with friction where joints rub, powers, and what is watched.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

import numpy as np

from dalembert.arrays import Array, Flags
from dalembert.core.friction.contact_equations import Contacts
from dalembert.kernel.graph import CONSTANT, Graph, Node, trace_array
from dalembert.kernel.program import Program
from dalembert.machine.motion.coded.steps import Integrator
from dalembert.machine.motion.coded.traced_friction import traced_motion, traced_senses
from dalembert.machine.motion.rest.dry_friction import DryFriction

MOST = 40_000
"""Operations of a program with friction above which it takes longer to compile, some seconds, than most motions take
without machine code."""
Corners = Sequence[tuple[Any, Any]]
"""Corners of a drive's effort over its speed: speeds at which its slope changes, and by how much; numbers or nodes."""


class EquationNodes(Protocol):
    """An ``Equation`` as nodes."""

    names: tuple[str, ...]
    program: Program
    graph: Graph
    ends: Any
    numbers: Sequence[Node]
    values: Array
    places: dict[int, int]
    channels: list[Any]
    dry: DryFriction | None
    contacts: Contacts | None

    def terms(self, out: Array) -> Any:
        """The terms of all outputs."""


class MasslessError(ArithmeticError):
    """Raised where a drive, one of those that forces move, moves no mass."""

    def __init__(self, drive: int) -> None:
        super().__init__(f"drive {drive} moves no mass")
        self.drive = drive


def rate_steps(
    equation: EquationNodes, free: Flags, lanes: int, works: bool, corners: Mapping[int, Corners]
) -> Integrator | None:
    """Steps of motions whose rates are those of an equation, as ``Equation.steps`` says; None where friction makes
    them too long a program."""
    d, graph, outputs = len(equation.names), equation.graph, equation.program.outputs
    n, own = 3 * d + 4 if works else 2 * d, len(equation.dry.own) if equation.dry else 0
    slots = [graph.input("channel", f"state {k}", 1.0) for k in range(n + 1)]
    every = np.array([graph.input("number", f"given {k}", 0.0) for k in range(4 * d + 2 * own)], object)
    inputs = every[: 4 * d].reshape(4, d)
    q, u, t = slots[:d], np.array(slots[d : 2 * d]), slots[n]

    def solve_at(count: int, a: Array) -> Array:
        inputs = (*equation.program.inputs_in_use("channel"), *equation.numbers)
        values = (*((*q, t)[f] for f in equation.channels), *u, *a)
        places = {n.index: x for n, x in zip(inputs, trace_array(graph, values), strict=True)}
        return np.array(graph.substitute(outputs[:count], places), object)

    a, applied = np.where(free, 0.0, inputs[3]), inputs[0] + inputs[1] * u
    for k, bends in corners.items():
        applied[k] = sum(((u[k] - speed).larger(0.0) * bend for speed, bend in bends), applied[k])
    heat, watched = graph.zero, list[Node]()
    if equation.dry:
        known = a, applied + inputs[2], free
        required, power, heat, a, watched = _rubbing(equation, solve_at, known, every[4 * d :])
    else:
        effort, mass = np.split(solve_at(equation.ends[1], a), [d])
        m = mass.reshape(d, d)[np.ix_(free, free)]
        a[free] = solve_nodes(m, (applied + inputs[2] - effort)[free])
        required, _, power = np.split(solve_at(equation.ends[2], a), equation.ends[:2])
    rate = [*u, *a]
    if works:
        rate += [*np.where(free, applied, required) * u, (inputs[2] * u).sum(), *power, heat]
    program = Program(graph, tuple(trace_array(graph, [*rate, *watched])))
    if equation.dry and len(program.order) > MOST:
        return None
    first = len(equation.values)
    numbers = {x.index: first + k for k, x in enumerate(every)}
    # all stand where the state and the values have them, used or not
    program.__dict__["places"] = equation.places | {x.index: k for k, x in enumerate(slots)} | numbers
    return Integrator(program, n, first + len(every), lanes)


def _rubbing(
    equation: EquationNodes,
    solve_at: Callable[[int, Array], Array],
    known: tuple[Array, Array, Flags],
    chosen: Array,
) -> tuple[Array, Array, Node, Array, list[Node]]:
    """Efforts required, powers of loads, of friction, accelerations, and what is watched, with friction."""
    assert equation.dry is not None
    assert equation.contacts is not None
    (a, applied, free), own = known, equation.dry.own
    terms, graph = equation.terms(solve_at(equation.ends[-1], 0.0 * a)), equation.graph
    assert terms.linear is not None
    sense, sticking = np.split(chosen, 2)
    stuck = sticking if free.sum() > 1 else None
    senses = traced_senses(equation.contacts, own, terms.rates, sense)
    given = a, applied - terms.effort, terms.mass, free
    f = traced_motion(graph, equation.contacts, own, terms.linear, given, senses, stuck, solve_nodes)
    slips = 1.0 if stuck is None else np.array([1.0 - x for x in stuck], object)
    rates = terms.rates.copy()
    rates[own] = rates[own] * slips
    watched = [*terms.rates[own], *f.margins, *(() if stuck is None else (*f.room, *f.part))]
    return terms.effort + f.effort, terms.power, (f.cz * rates).sum(), f.a, watched


def solve_nodes(mass: Array, right: Array) -> Array:
    """Solution of a positive system of nodes, which needs no pivoting; MasslessError where a drive moves no mass."""
    mass, right = mass.copy(), right.copy()
    for k in range(len(mass)):
        if mass[k, k].level == CONSTANT and not mass[k, k].value:
            raise MasslessError(k)
        row, value = mass[k] / mass[k, k], right[k] / mass[k, k]
        mass, right = mass - np.outer(mass[:, k], row), right - np.multiply.outer(mass[:, k], value)
        mass[k], right[k] = row, value  # not by a difference, in which what is heavy would lose its digits
    return right
