"""Equations of motion from traced analyses: that of a structure, with the numbers of one mechanism, or one traced for
the mechanism.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

import re
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
from dalembert.analysis.compile.compiled_mechanism import Compiled, compile_mechanism
from dalembert.analysis.compile.pose_loads import TIME
from dalembert.analysis.engine.kept_program import KeptProgram
from dalembert.analysis.engine.structures import ready
from dalembert.arrays import Array, Ints, Tree
from dalembert.core import forcing as fc
from dalembert.core.constraints import drift, measure, rates, system
from dalembert.core.friction.contact_equations import Contacts
from dalembert.errors import ModelError
from dalembert.kernel.derivatives import gradients
from dalembert.kernel.friction_trace import TRACED, trace_contacts
from dalembert.kernel.graph import CONSTANT, Graph, Node, trace_array
from dalembert.kernel.program import Program
from dalembert.kernel.trace import Traced
from dalembert.machine.motion.actuation import joint_stops
from dalembert.machine.motion.corners.one_sided import Sided, has_corners, sided
from dalembert.machine.motion.equation import LOCK, Equation, LastPose, LoadChannel
from dalembert.machine.motion.rest.dry_friction import DryFriction
from dalembert.model import Mechanism, Schedule
from dalembert.model.quantities.expression_trees import Functions
from dalembert.model.quantities.expressions import Expression

OUTSIDE = frozenset({"min", "log", "asin", "acos"})
"""Operations of expressions without machine code."""

WHOLE_TURN = re.compile(r"known turn \d+")
"""Inputs that angles are counted from."""

Freedoms = tuple[tuple[str, str], ...]
"""Joints and their freedoms."""
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
    events: bool = False,
) -> Equation:
    """The equation of one mechanism, for any numbers at the paths ``vary``; with what is ``asked`` of a state: outputs,
    then what is below zero where it is in doubt; and with the ``freedoms`` of joints that are watched. ``events``:
    corners of loads are on one side each also where there are outputs."""
    names = tuple(m.drives)
    moving = [f"drives.{n}.{what}" for what in ("speed", "acceleration") for n in names]
    full, varied = outputs is None or events, [*vary, *moving]
    switches: dict[Node, Node] = {}
    of: Callable[[Graph], Tree] = partial(_sided_functions, switches) if full else functions
    stops = joint_stops(m)
    pushed = [of for of, ends in stops.items() if ends.stiffness]
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
    effort = [n for name in names for n in trace.catalogue.nodes(f"effort.{name}")]
    mass = [n for row in gradients(graph, effort, numbers[count:]) for n in row]
    if trace.redundant:  # no number where constraints that repeat others are not met
        effort = [n + 1e-300 * traced.open[-1].sqrt() for n in effort]
    rubbing, *linear = _contacts(trace, numbers[count:])
    c, watched = trace.catalogue.compiled, (*stops, *freedoms)
    moved = [rubbing, traced.closure, _motion(graph, c, traced, watched, numbers[count:])]
    parts = [effort, mass, _powers(graph, c, traced), *moved, [*met, *_bends(graph, c, traced)], *linear]
    slip, none = traced.friction.slip, dict[int, Node]()
    if slip is not None:
        none = dict.fromkeys((n.index for n in (*trace_array(graph, slip.cz), *numbers[count:])), graph.zero)

    def program(*more: Node) -> Program:
        nodes = graph.substitute([*(n for part in parts for n in part), *more], none)
        return plain(kernel, nodes, marked=False, without=OUTSIDE, known=known_functions)

    built = program()
    known = [x for n in built.inputs_in_use("channel") if (x := graph.names[n.index]).startswith("known ")]
    if known:  # whole turns, and groups without a closed form: followed from state to state
        built = program(*(n for a in traced.pose for n in trace_array(graph, a).ravel()))
    channels = [_channel(trace, names, n) for n in built.inputs_in_use("channel")]
    pushes = [n for n in built.inputs_in_use("number") if graph.names[n.index].startswith("push ")]
    places = {n.index: k for k, n in enumerate((*kernel.number_nodes, *met.values(), *pushes))}
    values = np.concatenate([kernel.nominal, np.ones(len(met)), np.zeros(len(pushes) + 1)])
    out = Equation(names, built, parts, numbers, places, values, channels)
    out.sides = [places[side.index] for side in met.values()]
    out.pushes = {_of_push(graph, n, stops, pushed): places[n.index] for n in pushes}
    out.kernel = kernel
    if outputs is not None:
        _ask(out, trace, events, known_functions if events else None)
    followed = trace.course.followed
    _set_contacts(out, trace)
    out.known = LastPose(trace.course.pose, followed, followed.compiled.layout) if known else None
    out.by_newton = any(not name.startswith("known turn") for name in known)
    return out


def _of_push(graph: Graph, node: Node, stops: Iterable[tuple[str, str]], pushed: Freedoms) -> int:
    """Place among all stops of the one whose push is an input."""
    return list(stops).index(pushed[int(graph.names[node.index].split()[1])])


def _ask(out: Equation, trace: Trace, events: bool, known: Functions | None) -> None:
    """Give an equation what is asked of its states; with ``events`` its friction is an input."""
    graph, traced, kernel = out.graph, trace.catalogue.traced, out.kernel
    asked, slip = [*kernel.flat, *traced.closure, *traced.open], traced.friction.slip
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
    moved = _motion(graph, k.symbols.compiled, k.traced, freedoms, list(a))
    parts = [effort, mass, _powers(graph, k.symbols.compiled, k.traced), [], k.traced.closure, moved, []]
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


def _contacts(trace: Trace, accelerations: Sequence[Node]) -> list[list[Node]]:
    """Rates of the contacts, and the nodes of ``Linear``."""
    c, traced, graph = trace.catalogue.compiled, trace.catalogue.traced, trace.catalogue.graph
    slip, contacts = traced.friction.slip, c.contacts
    if slip is None or contacts is None:
        return [[]]
    first = c.layout.constraints.count
    second = rates(slip.along, traced.acceleration) + drift(
        c.layout.algebra, contacts.rows, traced.pose, traced.twist
    )
    push = slip.r.change[first : first + len(accelerations)]
    ahead = gradients(graph, list(slip.r.y.ravel()), accelerations)
    arrays = (
        slip.state.rate,
        push,
        slip.r.y,
        np.array(ahead),
        slip.r.h,
        second,
    )
    return [list(trace_array(graph, a).ravel()) for a in arrays]


def _motion(
    graph: Graph, c: Compiled, traced: Traced, names: Freedoms, accelerations: Sequence[Node]
) -> list[Node]:
    """For freedoms of joints: value, without full turns, rate and second rate, and the slopes by the accelerations."""
    g, freedoms, out, pose = c.layout.algebra, c.layout.freedoms, list[Node](), traced.pose
    if g.d == 2:
        cos, sin = np.moveaxis(trace_array(graph, pose.rotation), -1, 0)
        pose = pose._replace(turn=np.arctan2(sin, cos))
    for name in names:
        row, rows = c.freedoms.index(name), system(g, freedoms, pose)
        second = rates(rows, traced.acceleration) + drift(g, freedoms, pose, traced.twist)
        motion = (measure(g, freedoms, pose), rates(rows, traced.twist), second)
        out.extend(trace_array(graph, np.array([x[..., row][()] for x in motion], object)))
        out.extend(gradients(graph, out[-1:], list(accelerations))[0])
    known = {i: x for n in graph.order(out) if (x := graph.names.get(i := n.index, "")).startswith("known ")}
    if not all(WHOLE_TURN.fullmatch(x) for x in known.values()):
        return out  # Newton's steps begin at these angles
    return graph.substitute(out, dict.fromkeys(known, graph.zero))


def _bends(graph: Graph, c: Compiled, traced: Traced) -> list[Node]:
    """Distances of springs and dampers from the bends of their tables."""
    springs = traced.forcing.springs
    if not springs.slopes.any():
        return []
    margins = fc.table_margins(c.layout, springs, traced.pose, traced.twist)
    return list(trace_array(graph, np.array(margins, object)))


def _powers(graph: Graph, c: Compiled, traced: Traced) -> list[Node]:
    """Powers of forces and couples, and of dampers, as nodes; dry friction is not included yet."""
    layout, f, pose, twist = c.layout, c.forcing, traced.pose, traced.twist

    def power(*sources: fc.WrenchSource) -> Node:
        parts = [
            (k, w)
            for s in sources
            for k, w in zip(s.link, s.wrench.reshape(-1, twist.shape[-1]), strict=True)
        ]
        return sum(((w * twist[k]).sum() for k, w in parts), graph.zero)

    def elastic(at: Array) -> list[fc.WrenchSource]:
        springs = [fc.spring_wrench(layout, f.springs, pose, at)] if len(f.springs.a) else []
        return (
            [*springs, fc.resistance_wrench(layout, f.resistances, pose, at)]
            if len(f.resistances.row)
            else springs
        )

    dampers = power(*elastic(twist)) - power(*elastic(0.0 * twist))
    loads = graph.zero
    if len(f.forces.link) or len(f.couples.link) or f.pushes is not None:  # all power less that of the others
        inertial = fc.inertia_wrench(layout, f.inertia, pose, twist, traced.acceleration[:-1])
        turning = [traced.sources["turning"]] if "turning" in traced.sources else []
        others = power(*elastic(twist), fc.weight(layout, f.inertia, pose), inertial, *turning)
        loads = (traced.loads * twist[:-1]).sum() - others
    return list(trace_array(graph, np.array([loads, dampers], object)))
