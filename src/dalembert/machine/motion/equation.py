"""The equation of motion of the drives, as a function of numbers: inverse dynamics, which is affine in accelerations.

effort(q, u, a) = M_r(q) a + h(q, u): the traced analysis gives it with its exact derivative by a, which is M_r. With
dry friction it is only piecewise smooth in a; then Newton's method on the same numbers. The senses of the contacts are
inputs, so that between two events everything is smooth.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import Any, NamedTuple

import numpy as np

from dalembert.analysis.batch.compiled_kernel import Kernel
from dalembert.analysis.batch.kernel_export import plain
from dalembert.analysis.batch.tracing.traced_analysis import Trace, trace_analysis
from dalembert.analysis.compile.pose_loads import TIME
from dalembert.arrays import Array
from dalembert.core import forcing as fc
from dalembert.core.layout import Layout, Pose
from dalembert.errors import AnalysisError, ModelError
from dalembert.kernel.derivatives import gradients
from dalembert.kernel.graph import Node, trace_array
from dalembert.kernel.program import Program
from dalembert.model import Mechanism

STEPS, SAME, ROUNDING = 40, 1e-13, 1e-10
"""Newton's steps for accelerations with friction; the change of one, over the largest, that ends them; and that below
which they end where it does not fall any more."""


NEAR = 1e-7
"""How far the pose of a state may be from the one that Newton's steps began at, so that they have ended."""
OPEN = "there the mechanism does not close, or its drives do not place its links"


class StoppedError(AnalysisError):
    """Raised where the motion cannot go on, with the reason as a sentence."""


class Terms(NamedTuple):
    """At a state: efforts (D,) for the accelerations given, M_r (D, D), powers of loads, dampers and friction (3,),
    rates of the contacts (E,)."""

    effort: Array
    mass: Array
    power: Array
    rates: Array


@dataclass
class LastPose:
    """The pose of the last state, where whole turns are counted from and Newton's steps begin; a course of one."""

    pose: Pose
    followed: Any

    def follow(self, values: Array) -> float:
        """Take another pose, all its numbers in a row; how far it is, in m or rad."""
        sizes = np.cumsum([part[0].size for part in self.pose])
        parts = np.split(values, sizes[:-1])
        new = Pose(*(x.reshape(part[:1].shape) for x, part in zip(parts, self.pose, strict=True)))
        if not np.isfinite(values).all():
            return 0.0
        far = max(float(np.abs(x - y[:1]).max(initial=0.0)) for x, y in zip(new, self.pose, strict=True))
        self.pose = new
        return far


class Equation:
    """Efforts that a state of all drives asks for, of a mechanism whose drives are all prescribed."""

    def __init__(self, m: Mechanism) -> None:
        self.names, self.mechanism = tuple(m.drives), m
        vary = [f"drives.{n}.{what}" for what in ("speed", "acceleration") for n in self.names]
        trace = trace_analysis(m, vary, inertia=True)
        count = len(self.names)
        kernel = Kernel(m, trace, (), None, False, 1)
        graph, numbers = trace.catalogue.graph, kernel.number_nodes
        effort = [n for name in self.names for n in trace.catalogue.nodes(f"effort.{name}")]
        mass = [n for row in gradients(graph, effort, numbers[count:]) for n in row]
        own, senses, rates = _contacts(trace)
        self.known = LastPose(trace.course.pose, trace.course.followed)
        asked = [name for kind, name in trace.inputs.named if kind == "channel" and name.startswith("known ")]
        pose = (
            [n for a in trace.catalogue.traced.pose for n in trace_array(graph, a).ravel()] if asked else []
        )
        self.by_newton = any(not name.startswith("known turn") for name in asked)
        nodes = [*effort, *mass, *_powers(trace), *rates, *pose]
        inputs = [graph.input("channel", f"sense {k}", 1.0) for k in range(len(senses))]
        places = {n.index: new for n, new in zip(senses, inputs, strict=True) if isinstance(n, Node)}
        found = graph.substitute(plain(kernel, nodes, marked=False).outputs, places)
        program = Program(graph, tuple(found))
        self.joints = own
        self.contacts, self.rough = len(senses), trace.catalogue.compiled.contacts is not None
        self.channels = [self._channel(trace, n, inputs) for n in program.inputs_in_use("channel")]
        self.parts = (len(effort), len(mass), 3, len(rates), len(pose))
        self.run = _compiled(program, 2 * count, len(self.channels))
        self.last, self.size = np.zeros(count), 1e-300

    def _channel(self, trace: Trace, node: Node, senses: list[Node]) -> Callable[[float, Array, Array], Any]:
        """How an input is found from the time, the positions and the senses."""
        name = trace.catalogue.graph.names[node.index]
        if node in senses:
            k = senses.index(node)
            return lambda t, q, sense: sense[k]
        what, _, of = name.partition(" ")
        if what == "position" and of in self.names:
            k = self.names.index(of)
            return lambda t, q, sense: q[k]
        if what == "known":
            found = trace.inputs.found[node]
            return lambda t, q, sense: np.ravel(found(self.known))[0]  # type: ignore[arg-type]
        if name == TIME:
            return lambda t, q, sense: t
        if name in trace.inputs.varying and not any("." in n for n in trace.inputs.varying[name].names):
            varying = trace.inputs.varying[name]
            return lambda t, q, sense: varying.at({**dict(zip(self.names, q, strict=True)), TIME: t})
        raise ModelError(
            f"the motion under forces needs {name!r}, which does not follow from the drives' positions alone",
            "choose drives that place the links in closed form, one group after the other",
        )

    def __call__(self, t: float, q: Array, u: Array, a: Array, sense: Array) -> Terms:
        d, ends = len(u), np.cumsum(self.parts)
        for _ in range(STEPS):
            out = self.run([*u, *a], [float(f(t, q, sense)) for f in self.channels])
            if not self.parts[4] or self.known.follow(out[ends[3] :]) <= NEAR or not self.by_newton:
                break
        mass, power = out[d : ends[1]].reshape(d, d), out[ends[1] : ends[2]]
        return Terms(out[:d], mass, power, out[ends[2] : ends[3]])

    def accelerations(
        self, t: float, q: Array, u: Array, given: Array, tau: Array, free: Array, sense: Array
    ) -> tuple[Array, Array, Terms]:
        """Accelerations (D,), those of ``free`` drives (D,) from their efforts tau; efforts of all; and the terms.

        Raises StoppedError where there are none: the mechanism does not close, or is singular, or jams.
        """
        a = np.where(free, self.last if self.rough else 0.0, given)
        if len(a) == 1 and free[0] and not self.rough:
            e = self(t, q, u, a, sense)
            step = _solve(e.mass, tau - e.effort)
            if not np.isfinite(step[0]):
                raise StoppedError(OPEN)
            return a + step, tau, e
        before = np.inf
        for _ in range(STEPS):
            e = self(t, q, u, a, sense)
            inner = e.mass[np.ix_(free, free)]
            if not (np.isfinite(e.effort).all() and np.isfinite(inner).all()):
                raise StoppedError(OPEN)
            if not free.any():
                return a, e.effort, e
            pushed = np.abs(tau).max() / max(float(np.abs(inner).max()), 1e-300)
            self.size = max(self.size, float(pushed))  # what rounding is measured by, of the whole motion
            step = np.zeros_like(a)
            step[free] = _solve(inner, (tau - e.effort)[free])
            a, effort, change = a + step, e.effort + e.mass @ step, float(np.abs(step).max())
            self.size = max(self.size, float(np.abs(a).max()))
            if not self.rough or change <= SAME * self.size or before <= change <= ROUNDING * self.size:
                self.last = a
                return a, effort, e
            before = change
        raise StoppedError("there it jams: no acceleration satisfies the law of friction")


def _solve(mass: Array, right: Array) -> Array:
    if len(right) == 1:
        if not mass[0, 0] > 0:
            raise StoppedError(
                "nothing there has inertia, or friction makes it negative: the acceleration is not determined"
            )
        return np.asarray(right / mass[0, 0])
    try:
        return np.asarray(np.linalg.solve(mass, right))
    except np.linalg.LinAlgError:
        raise StoppedError("nothing there has inertia: the accelerations are not determined") from None


def _contacts(trace: Trace) -> tuple[list[str], list[Any], list[Node]]:
    """Joints, senses and rates of contacts whose sense is that of a rate of their own.

    Contacts of a common slip share a direction, and teeth are pushed apart always: they follow by themselves.
    """
    c = trace.catalogue.compiled
    slip, contacts = trace.catalogue.traced.friction.slip, c.contacts
    if slip is None or contacts is None:
        return [], [], []
    own = [
        e
        for e in range(contacts.count)
        if not contacts.fixed[e] and contacts.led[e] == e and (contacts.group == contacts.group[e]).sum() == 1
    ]
    rate = trace_array(trace.catalogue.graph, slip.state.rate)
    joints = [c.joints[contacts.joint[e]] for e in own]
    return joints, [slip.state.sense[e] for e in own], [rate[e] for e in own]


def _powers(trace: Trace) -> list[Node]:
    """Powers of forces and couples, of dampers, and of dry friction, as nodes."""
    graph, c, traced = trace.catalogue.graph, trace.catalogue.compiled, trace.catalogue.traced
    layout, pose, twist, f = c.layout, traced.pose, traced.twist, c.forcing
    damped = [s for s, kept in _resisting(f, damping_only=True) if kept]
    dampers = sum((_power(layout, pose, twist, s) for s in damped), graph.zero)
    slip, rubbing = traced.friction.slip, graph.zero
    if slip is not None and c.contacts is not None:
        rubbing = (np.where(c.contacts.fixed, 0.0, slip.cz) * slip.state.rate).sum()
    loads = graph.zero
    if len(f.forces.link) or len(f.couples.link):  # all power less that of what is known
        others = [fc.weight(layout, f.inertia, pose)]
        others.append(fc.inertia_wrench(layout, f.inertia, pose, twist, traced.acceleration[:-1]))
        known = sum((_power(layout, pose, twist, s) for s, _ in _resisting(f)), _sum(others, twist))
        loads = (traced.loads * twist[:-1]).sum() - known - rubbing
    return list(trace_array(graph, np.array([loads, dampers, rubbing], object)))


def _resisting(f: fc.Forcing, damping_only: bool = False) -> list[tuple[Any, bool]]:
    """Springs and dampers, whole or as dampers only, and whether there are any."""
    springs, turns = f.springs, f.resistances
    if damping_only:
        kept = np.flatnonzero([bool(x) for x in springs.damping])
        springs = type(springs)(*(getattr(springs, n.name)[kept] for n in fields(springs)))
        none = 0.0 * springs.damping
        springs = replace(springs, stiffness=none, force=none, free_length=none)
        turns = replace(turns, stiffness=0.0 * turns.stiffness)
    return [(springs, len(springs.a) > 0), (turns, len(turns.row) > 0)]


def _power(layout: Layout, pose: Pose, twist: Array, part: Any) -> Any:
    """Power of springs and dampers, between points or in freedoms."""
    wrench = fc.spring_wrench if isinstance(part, fc.Springs) else fc.resistance_wrench
    return _sum([wrench(layout, part, pose, twist)], twist)


def _sum(sources: list[fc.Source], twist: Array) -> Any:
    parts = [
        (k, w) for s in sources for k, w in zip(s.link, s.wrench.reshape(-1, twist.shape[-1]), strict=True)
    ]
    return sum((w * twist[k]).sum() for k, w in parts)


def _compiled(program: Program, numbers: int, channels: int) -> Callable[[list[Any], list[float]], Array]:
    """The program at single states: as machine code, or in numpy where there is no compiler."""
    count = len(program.outputs)
    try:
        from dalembert.kernel.emit import llvm_text
        from dalembert.kernel.emit.machine_code import compile_module

        machine = compile_module(llvm_text.pairs(program, 1), 1)
    except ImportError:
        return _interpreted(program)
    from dalembert.kernel.memory import address, aligned_array

    values, path = aligned_array((numbers + 1,)), aligned_array((channels + 1,))
    out, code = aligned_array((count + 1,)), np.zeros(8, np.uint8)
    arrays, counts = (values, path, out, code), (numbers, channels, 0, 1)
    places, function = [address(a) for a in arrays], machine.function

    def run(given: list[Any], along: list[float]) -> Array:
        values[:numbers], path[:channels] = given, along
        function(*places, *counts)
        return out[:count].copy()

    run.keeps = (machine, arrays)  # type: ignore[attr-defined]  # code and arrays live as long as it
    return run


def _interpreted(program: Program) -> Callable[[list[Any], list[float]], Array]:
    from dalembert.kernel.emit.numpy_program import NumpyProgram

    numbers, along = program.inputs_in_use("number"), program.inputs_in_use("channel")
    inner = NumpyProgram(program.graph, [*numbers, *along], program.outputs)

    def run(given: list[Any], channels: list[float]) -> Array:
        out = np.full(len(program.outputs), np.nan)
        try:
            inner([*(given[n.value] for n in numbers), *channels], out)
        except (ArithmeticError, ValueError):
            out[:] = np.nan
        return out

    return run
