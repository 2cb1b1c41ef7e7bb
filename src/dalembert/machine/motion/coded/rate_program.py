"""Rates of a motion's state as a program: accelerations, with friction where joints rub, powers, and what is watched.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, Protocol

import numpy as np

from dalembert.arrays import Array, Flags
from dalembert.core.friction.contact_equations import Contacts
from dalembert.kernel.graph import CONSTANT, Graph, Node, trace_array
from dalembert.kernel.program import Program
from dalembert.machine.motion.coded.steps import Integrator
from dalembert.machine.motion.coded.traced_friction import TracedMotion, traced_motion, traced_senses
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
    asked: Program
    asked_channels: list[Any]
    dry: DryFriction | None
    contacts: Contacts | None
    late: dict[int, Node]

    def terms(self, out: Array) -> Any:
        """The terms of all outputs."""


class MasslessError(ArithmeticError):
    """Raised where a drive, one of those that forces move, moves no mass."""

    def __init__(self, drive: int) -> None:
        super().__init__(f"drive {drive} moves no mass")
        self.drive = drive


class RateNodes(NamedTuple):
    """A motion's rates as nodes: ``slots`` (n + 1,), the state's numbers and the time; ``given``, the numbers behind
    the equation's values; accelerations, applied and required efforts (D,); powers of brakes, loads, dampers and
    friction; friction c z of the contacts (E,), and what is watched of them; of the efforts of late motors."""

    slots: Array
    given: Array
    a: Array
    applied: Array
    required: Array
    powers: list[Node]
    cz: Array
    watched: list[Node]
    late: list[Node]


def rate_steps(
    equation: EquationNodes, free: Flags, lanes: int, works: bool, corners: Mapping[int, Corners]
) -> Integrator | None:
    """Steps of motions whose rates are those of an equation, as ``Equation.steps`` says; None where friction makes
    them too long a program."""
    d = len(equation.names)
    r = trace_rates(equation, free, 3 * d + 4 if works else 2 * d, corners)
    u = r.slots[d : 2 * d]
    rate = [*u, *r.a]
    if works:
        rate += [*np.where(free, r.applied, r.required) * u, *r.powers]
    return rate_code(equation, r, [*rate, *r.watched], lanes)


def rate_code(
    equation: EquationNodes, r: RateNodes, outputs: Sequence[Node], lanes: int
) -> Integrator | None:
    """Machine code of rates with what is watched behind them; None where friction makes it too long a program."""
    program = Program(equation.graph, tuple(trace_array(equation.graph, outputs)))
    if equation.dry and len(program.order) > MOST:
        return None
    first, slots = len(equation.values), {x.index: k for k, x in enumerate(r.slots)}
    numbers = {x.index: first + k for k, x in enumerate(r.given)}
    # all stand where the state and the values have them, used or not
    program.__dict__["places"] = equation.places | slots | numbers
    return Integrator(program, len(r.slots) - 1, first + len(r.given), lanes)


def trace_rates(
    equation: EquationNodes, free: Flags, n: int, corners: Mapping[int, Corners], at_rest: bool = False
) -> RateNodes:
    """The rates at a state of n numbers; ``at_rest``: the last given number is 1 where contacts take their coefficients
    at rest."""
    d, graph = len(equation.names), equation.graph
    own = len(equation.dry.own) if equation.dry else 0
    slots = np.array([graph.input("channel", f"state {k}", 1.0) for k in range(n + 1)], object)
    count = 4 * d + 2 * own + at_rest
    given = np.array([graph.input("number", f"given {k}", 0.0) for k in range(count)], object)
    inputs, u = given[: 4 * d].reshape(4, d), slots[d : 2 * d]

    def solve_at(count: int, a: Array) -> Array:
        return at_state(equation, slots, a, equation.program.outputs[:count])

    a, applied = np.where(free, 0.0, inputs[3]), inputs[0] + inputs[1] * u
    for k, bends in corners.items():
        applied[k] = sum(((u[k] - speed).larger(0.0) * bend for speed, bend in bends), applied[k])
    late = list[Node]()
    for torque, (k, constant) in zip(slots[2 * d :], equation.late.items() if at_rest else (), strict=False):
        late.append((applied[k] - torque) / constant)
        applied[k] = torque
    heat, cz, watched = graph.zero, np.zeros(0, object), list[Node]()
    if equation.dry:
        known, still = (a, applied + inputs[2], free), given[-1] if at_rest else None
        sense, sticking = np.split(given[4 * d : 4 * d + 2 * own], 2)
        stuck = sticking if free.sum() > 1 else None
        required, power, heat, f, watched = _rubbing(equation, solve_at, known, sense, stuck, still)
        a, cz = f.a, f.cz
    else:
        effort, mass = np.split(solve_at(equation.ends[1], a), [d])
        m = mass.reshape(d, d)[np.ix_(free, free)]
        a[free] = solve_nodes(m, (applied + inputs[2] - effort)[free])
        required, _, power = np.split(solve_at(equation.ends[2], a), equation.ends[:2])
    powers = [(inputs[2] * u).sum(), *power, heat]
    return RateNodes(slots, given, a, applied, required, powers, cz, watched, late)


def at_state(equation: EquationNodes, slots: Array, a: Array, nodes: Sequence[Node]) -> Array:
    """Nodes of an equation at the state of ``slots``, with accelerations (D,)."""
    graph, d = equation.graph, len(equation.names)
    along, values = [*slots[:d], slots[-1]], [*slots[d : 2 * d], *a]
    places = {n.index: x for n, x in zip(equation.numbers, trace_array(graph, values), strict=True)}
    for program, channels in (
        (equation.program, equation.channels),
        (equation.asked, equation.asked_channels),
    ):
        inputs = program.inputs_in_use("channel")
        places |= {n.index: along[f] for n, f in zip(inputs, channels, strict=True)}
    return np.array(graph.substitute(nodes, places), object)


def _rubbing(
    equation: EquationNodes,
    solve_at: Callable[[int, Array], Array],
    known: tuple[Array, Array, Flags],
    sense: Array,
    stuck: Array | None,
    still: Node | None,
) -> tuple[Array, Array, Node, TracedMotion, list[Node]]:
    """Efforts required, powers of loads, of friction, the motion, and what is watched, with friction."""
    assert equation.dry is not None
    assert equation.contacts is not None
    (a, applied, free), own = known, equation.dry.own
    terms, graph = equation.terms(solve_at(equation.ends[-1], 0.0 * a)), equation.graph
    assert terms.linear is not None
    senses = traced_senses(equation.contacts, own, terms.rates, sense)
    given = a, applied - terms.effort, terms.mass, free
    f = traced_motion(graph, equation.contacts, own, terms.linear, given, senses, stuck, solve_nodes, still)
    slips = 1.0 if stuck is None else np.array([1.0 - x for x in stuck], object)
    rates = terms.rates.copy()
    rates[own] = rates[own] * slips
    watched = [*terms.rates[own], *f.margins, *(() if stuck is None else (*f.room, *f.part))]
    return terms.effort + f.effort, terms.power, (f.cz * rates).sum(), f, watched


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
