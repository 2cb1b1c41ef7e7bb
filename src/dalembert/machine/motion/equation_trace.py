"""Equations of motion from traced analyses: that of a structure, with the numbers of one mechanism, or one traced for
the mechanism.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import lru_cache, partial
from typing import Any

import numpy as np

from dalembert.analysis.batch.compiled_kernel import Kernel
from dalembert.analysis.batch.kernel_export import plain
from dalembert.analysis.batch.tracing.symbolic_model import functions
from dalembert.analysis.batch.tracing.symbolic_model import numbers as varied_numbers
from dalembert.analysis.batch.tracing.traced_analysis import Trace, trace_analysis
from dalembert.analysis.compile.compiled_mechanism import compile_mechanism
from dalembert.analysis.compile.pose_loads import TIME
from dalembert.analysis.engine.kept_program import KeptProgram
from dalembert.analysis.engine.structures import ready
from dalembert.arrays import Array, Ints, Tree
from dalembert.core.friction.contact_equations import Contacts
from dalembert.errors import ModelError
from dalembert.kernel.derivatives import gradients
from dalembert.kernel.friction_trace import TRACED, trace_contacts
from dalembert.kernel.graph import CONSTANT, Graph, Node, trace_array
from dalembert.kernel.program import Program
from dalembert.machine.motion.actuation import Actuation, joint_stops
from dalembert.machine.motion.coded.acting_nodes import ActingNodes, trace_acting
from dalembert.machine.motion.coded.traced_terms import (
    Freedoms,
    contact_terms,
    freedom_motions,
    load_powers,
    required_efforts,
    table_bends,
)
from dalembert.machine.motion.corners.one_sided import Sided, has_corners, sided
from dalembert.machine.motion.equation import LOCK, Equation, LastPose, LoadChannel
from dalembert.machine.motion.rest.dry_friction import DryFriction
from dalembert.model import Mechanism, Schedule
from dalembert.model.quantities.expression_trees import Functions
from dalembert.model.quantities.expressions import Expression

OUTSIDE = frozenset({"min", "log", "asin", "acos"})
"""Operations of expressions without machine code."""

LATEST: deque[tuple[tuple[object, Freedoms], Mechanism, Equation]] = deque(maxlen=8)
"""Equations of the mechanisms met last, by what these are made of, which they keep alive, and the freedoms watched."""


def equation_of(m: Mechanism, freedoms: Freedoms = ()) -> Equation:
    """The equation of a mechanism whose drives are all prescribed: its structure's, or one traced for it; ``freedoms``
    of joints are watched besides those with stops."""
    key = (_made_of(m), freedoms)
    with LOCK:
        equation = next((e for same, _, e in LATEST if same == key), None)
        if equation is None:
            equal = (e for (_, watched), same, e in LATEST if same == m and watched == freedoms)
            equation = _of_structure(m, freedoms) or next(equal, None) or trace_equation(m, freedoms=freedoms)
            LATEST.append((key, m, equation))
        return equation.again()


def _made_of(m: Mechanism) -> object:
    """Key of a mechanism's equation: its parts, known by their identity, and how it is driven."""
    tables = (m.links, m.joints, m.loads, m.assembly)
    parts = [list(map(id, (*t, *t.values()))) for t in tables]
    drives = [(n, d.position, d.joint, d.freedom, d.axis) for n, d in m.drives.items()]
    return parts, drives, m.dimension, m.gravity, m.g_override, id(m.friction), id(m.parameters)


def trace_equation(
    m: Mechanism,
    vary: Sequence[str] = (),
    outputs: tuple[str, ...] | None = None,
    freedoms: Freedoms = (),
    acting: Actuation | None = None,
) -> Equation:
    """The equation of one mechanism, for any numbers at the paths ``vary``; with what is ``asked`` of a state: outputs,
    then what is below zero where it is in doubt; and with the ``freedoms`` of joints that are watched. ``acting``,
    for a motion with events: what acts on the drives is part of it, and corners are on one side each."""
    names, events = tuple(m.drives), acting is not None
    moving = [f"drives.{n}.{what}" for what in ("speed", "acceleration") for n in names]
    full, varied = outputs is None or events, [*vary, *moving]
    switches: dict[Node, Node] = {}
    of: Callable[[Graph], Tree] = partial(_sided_functions, switches) if full else functions
    stops = joint_stops(m)
    pushed = tuple(joint for joint, ends in stops.items() if ends.stiffness)
    trace = trace_analysis(
        m, varied, True, moves=True, redundant=True, unsplit=full, functions_of=of, pushed=pushed
    )
    known_functions = of(trace.catalogue.graph)
    if full:
        _trace_switches(trace, names, known_functions, switches)
    met = dict(switches)  # those of loads that stay outside machine code have their own sides
    trace.unique(outputs or ())
    graph, traced, count = trace.catalogue.graph, trace.catalogue.traced, len(names)
    kernel = Kernel(m, trace, outputs or (), None, False, 1)
    numbers = kernel.number_nodes[-2 * count :]
    rubbing, *linear = contact_terms(trace, numbers[count:])
    c, watched = trace.catalogue.compiled, (*stops, *freedoms)
    moved = [rubbing, traced.closure, freedom_motions(graph, c, traced, watched, numbers[count:])]
    acts = ActingNodes(*required_efforts(trace, names, numbers[count:]))
    before = set(switches)
    trace_acting(acts, trace, acting, m, moved[2], known_functions, kernel.number_nodes)
    met |= {by: side for by, side in switches.items() if by not in before}
    parts = [acts.effort, acts.mass, load_powers(graph, c, traced), *moved]
    parts += [[*met, *table_bends(graph, c, traced)], *linear]
    parts = [graph.substitute(part, acts.pushes) for part in parts]
    slip, none = traced.friction.slip, dict[int, Node]()
    if slip is not None:
        none = dict.fromkeys((n.index for n in (*trace_array(graph, slip.cz), *numbers[count:])), graph.zero)

    def program(*more: Node) -> Program:
        nodes = graph.substitute([*(n for part in parts for n in part), *more], none)
        return plain(kernel, nodes, marked=False, without=OUTSIDE, known=known_functions)

    built = program(*(n for stop in acts.stops for n in stop.nodes))
    known = _known_inputs(built)
    if known:  # whole turns, and groups without a closed form: followed from state to state
        built = program(*(n for a in traced.pose for n in trace_array(graph, a).ravel()))
    channels = [_channel(trace, names, n) for n in built.inputs_in_use("channel")]
    pushes = [n for n in built.inputs_in_use("number") if graph.names[n.index].startswith("push ")]
    places = {n.index: k for k, n in enumerate((*kernel.number_nodes, *met.values(), *pushes))}
    values = np.concatenate([kernel.nominal, np.ones(len(met)), np.zeros(len(pushes) + 1)])
    out = Equation(names, built, parts, numbers, places, values, channels)
    out.sides = [places[side.index] for side in met.values()]
    out.pushes = {_of_push(graph, n, stops, pushed): places[n.index] for n in pushes}
    out.kernel, out.stops, out.late = kernel, acts.stops, acts.late
    if outputs is not None:
        _ask(out, trace, events, known_functions if events else None, acts)
    _set_contacts(out, trace)
    _follow(out, trace, known)
    return out


def _known_inputs(program: Program) -> list[str]:
    """Names of the inputs that are known from the state before."""
    names = (program.graph.names[n.index] for n in program.inputs_in_use("channel"))
    return [name for name in names if name.startswith("known ")]


def _follow(out: Equation, trace: Trace, known: Sequence[str]) -> None:
    """Follow states one by one where some inputs are known from the state before."""
    if known:
        followed = trace.course.followed
        out.known = LastPose(trace.course.pose, followed, followed.compiled.layout)
        out.by_newton = any(not name.startswith("known turn") for name in known)


def _of_push(graph: Graph, node: Node, stops: Iterable[tuple[str, str]], pushed: Freedoms) -> int:
    """Place among all stops of the one whose push is an input."""
    return list(stops).index(pushed[int(graph.names[node.index].split()[1])])


def _ask(out: Equation, trace: Trace, events: bool, known: Functions | None, acts: ActingNodes) -> None:
    """Give an equation what is asked of its states; with ``events`` its friction is an input."""
    graph, traced, kernel = out.graph, trace.catalogue.traced, out.kernel
    forces, slip = [*traced.contacts, *acts.lost] if events else [], traced.friction.slip
    out.lost = len(forces)
    asked = graph.substitute([*kernel.flat, *traced.closure, *traced.open, *forces], acts.pushes)
    if events and slip is not None:
        out.friction = [graph.input("number", f"friction {e}", 0.0) for e in range(len(slip.cz))]
        found = zip(trace_array(graph, slip.cz), out.friction, strict=True)
        asked = graph.substitute(asked, {n.index: x for n, x in found})
    out.asked = plain(kernel, asked, marked=False, without=OUTSIDE, known=known)
    out.asked.__dict__["places"] = out.asked.places | out.places
    names = tuple(out.names)
    out.asked_channels = [_channel(trace, names, n) for n in out.asked.inputs_in_use("channel")]


def _set_contacts(out: Equation, trace: Trace) -> None:
    """Give an equation the contacts of a machine whose joints rub."""
    of_trace, slip = trace.catalogue.compiled.contacts, trace.catalogue.traced.friction.slip
    followed, contacts = trace.course.followed, trace.course.followed.compiled.contacts
    if contacts is not None and slip is not None:
        out.dry = DryFriction(contacts, _independent(contacts, trace_array(out.graph, slip.state.sense)))
        out.contacts = of_trace and trace_contacts(out.graph, of_trace)
        out.joints = [followed.compiled.joints[contacts.joint[e]] for e in out.dry.own]


def shared_equation(m: Mechanism, vary: Sequence[str]) -> Equation | None:
    """One equation for all numbers of links, joints and loads at the paths; None where each design needs a separate
    one: one whose states are followed, or whose loads are computed outside machine code."""
    try:
        equation = trace_equation(m, vary)
    except ModelError:
        return None
    return None if equation.known or any(callable(f) for f in equation.channels) else equation


def equation_of_design(shared: Equation, m: Mechanism, vary: Sequence[str]) -> Equation | None:
    """The shared equation with the numbers of a design; None where that may be on another branch."""
    new, kernel, varied = shared.again(), shared.kernel, [n.value for n in varied_numbers(m, vary)]
    design = np.array([*varied, *kernel.nominal[len(varied) :]])
    if np.any(kernel.may_change_branch(design[None])):
        return None
    new.values[: len(varied)] = varied
    if new.dry is not None and shared.contacts is not None:
        known = {n.index: x for n, x in zip(kernel.number_nodes, design, strict=True)}
        arrays: Tree = {}
        for name in TRACED:
            nodes = getattr(shared.contacts, name)
            arrays[name] = np.array(shared.graph.evaluate(nodes.ravel(), known), float).reshape(nodes.shape)
        new.dry.contacts = replace(new.dry.contacts, **arrays)
    return new


def _sided_functions(switches: dict[Node, Node], graph: Graph) -> Tree:
    """Functions of expressions whose corners are on one side: what switches, with the input that says which."""

    def switch(x: Node | float) -> Node:
        by = x if isinstance(x, Node) else graph.constant(x)
        return switches.setdefault(by, graph.input("number", f"side {by.index}", 1.0))

    return {**functions(graph), **sided(switch)}


def _trace_switches(trace: Trace, names: Sequence[str], known: Functions, switches: dict[Node, Node]) -> None:
    """Records the switching variables of loads that depend on drives and time, where they are computed in machine
    code."""
    graph, inputs = trace.catalogue.graph, trace.inputs
    raw = {n: inputs.named["channel", f"position {n}"] for n in names} | {TIME: inputs.time()}
    for varying in inputs.varying.values():
        if isinstance(varying, Expression) and varying.names <= raw.keys():
            before, value = list(switches), varying.at(raw, known)
            if isinstance(value, Node) and any(n.op in OUTSIDE for n in graph.order([value])):
                for more in switches.keys() - set(before):
                    del switches[more]


def _channel(trace: Trace, names: tuple[str, ...], node: Node) -> Any:
    """Index of an input in positions and time, or its function of time and positions."""
    name = trace.catalogue.graph.names[node.index]
    what, _, of = name.partition(" ")
    if what == "position" and of in names:
        return names.index(of)
    if name == TIME:
        return len(names)
    if what == "known":
        lookup = trace.inputs.sources[node]
        return lambda t, q, known: np.ravel(lookup(known))[0]
    if name in trace.inputs.varying and not any("." in n for n in trace.inputs.varying[name].names):
        varying = trace.inputs.varying[name]
        of = f"load {name.split('.')[1]!r}"
        return LoadChannel(varying, names, Sided(varying, of) if has_corners(varying) else None)
    raise ModelError(
        f"the motion under forces needs {name!r}, which does not follow from the drives' positions alone",
        "choose drives that place the links in closed form, one group after the other",
    )


def _of_structure(m: Mechanism, freedoms: Freedoms) -> Equation | None:
    """The equation of a planar mechanism whose program is kept by structure, with its numbers; None where it is not
    kept: with friction, or loads that depend on positions or time."""
    if any(getattr(load, "varying", ()) for load in m.loads.values()) or joint_stops(m):
        return None
    names = tuple(m.drives)
    at, one = np.array([[d.position for d in m.drives.values()]], float), np.ones((1, len(names)))
    c = compile_mechanism(m, Schedule(names, at, one, one))
    if c.contacts is not None or c.layout.compliance is not None or c.pose_names:
        return None
    if c.forcing.springs.slopes.any():  # whose corners are events
        return None
    kept = ready(c, inertia=True)
    if kept is None or not kept.program.complete:
        return None
    values = [*kept.single, *kept.columns[:, 0], *kept.first.branches, 0.0]
    return _shared(kept.program, names, freedoms).again(np.array(values))


@lru_cache(16)
def _shared(k: KeptProgram, names: tuple[str, ...], freedoms: Freedoms) -> Equation:
    """The equation of a structure, whose values are the inputs of its program."""
    graph, (q, u, a) = k.graph, k.symbols.drives
    effort = list(k.traced.effort)
    mass = [n for row in gradients(graph, effort, list(a)) for n in row]
    moved = freedom_motions(graph, k.symbols.compiled, k.traced, freedoms, list(a))
    parts = [effort, mass, load_powers(graph, k.symbols.compiled, k.traced), [], k.traced.closure, moved, []]
    inputs = [
        n if n.op == "number" else graph.input("number", f"value {j}", 1.0) for j, n in enumerate(k.inputs)
    ]
    numbers = {n.index: x for n, x in zip(k.inputs, inputs, strict=True) if n not in list(q)}
    program = Program(graph, tuple(graph.substitute([n for part in parts for n in part], numbers)))
    channels = [list(q).index(n) for n in program.inputs_in_use("channel")]
    moving, places = [numbers[n.index] for n in (*u, *a)], {n.index: j for j, n in enumerate(inputs)}
    return Equation(names, program, parts, moving, places, np.zeros(len(inputs) + 1), channels)


def _independent(contacts: Contacts, sense: Array) -> Ints:
    """Contacts whose sense is that of their rate.

    Contacts of a common slip share a direction, and teeth are always pushed apart: these follow from the others.
    """
    alone = (contacts.group == contacts.group[:, None]).sum(axis=0) == 1
    moves = [n.level != CONSTANT for n in sense]
    return np.flatnonzero(~contacts.fixed & alone & (contacts.leader == np.arange(contacts.count)) & moves)
