"""The equation of motion of the drives, as a function of numbers: inverse dynamics, which is affine in accelerations.

effort(q, u, a) = M_r(q) a + h(q, u): the traced analysis gives it with its exact derivative by a, which is M_r. With
dry friction it is only piecewise smooth in a; then Broyden's method, which begins at M_r. The senses of the contacts
are inputs, so that between two events everything is smooth.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from importlib.util import find_spec
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from dalembert.analysis.batch.compiled_kernel import Kernel
from dalembert.analysis.batch.kernel_export import plain
from dalembert.analysis.batch.tracing.traced_analysis import Trace, trace_analysis
from dalembert.analysis.compile.pose_loads import TIME
from dalembert.arrays import Array, Flags
from dalembert.core import forcing as fc
from dalembert.core.layout import Pose
from dalembert.errors import AnalysisError, ModelError
from dalembert.kernel.derivatives import gradients
from dalembert.kernel.graph import Node, trace_array
from dalembert.kernel.memory import address
from dalembert.kernel.program import Program
from dalembert.machine.motion.steps import STAGES, Stages
from dalembert.model import Mechanism

STEPS, RENEWAL, SAME, ROUNDING = 40, 20, 1e-13, 1e-10
"""Broyden's steps for accelerations with friction; the change of one, over the largest, that ends them; and that below
which they end where it does not fall any more."""


NEAR = 1e-7
"""How far the pose of a state may be from the one that Newton's steps began at, so that they have ended."""
OUTSIDE = frozenset({"min", "exp", "log", "asin", "acos", "tan"})
"""Operations of expressions without machine code."""
OPEN = "there the mechanism does not close, or its drives do not place its links"


class StoppedError(AnalysisError):
    """Raised where the motion cannot go on, with the reason as a sentence."""


class Terms(NamedTuple):
    """At a state: efforts (D,) for the accelerations given, M_r (D, D), powers of loads, dampers and friction (3,),
    rates of the contacts (E,), and what is below zero within 0.2 deg of a dead centre or change point."""

    effort: Array
    mass: Array
    power: Array
    rates: Array
    closure: Array


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
        count, self.graph, traced = len(self.names), trace.catalogue.graph, trace.catalogue.traced
        kernel = Kernel(m, trace, (), None, False, 1)
        self.numbers = kernel.number_nodes
        effort = [n for name in self.names for n in trace.catalogue.nodes(f"effort.{name}")]
        mass = [n for row in gradients(self.graph, effort, self.numbers[count:]) for n in row]
        self.joints, senses, rates = _contacts(trace)
        self.contacts, self.rough = len(senses), trace.catalogue.compiled.contacts is not None
        inputs = [self.graph.input("channel", f"sense {k}", 1.0) for k in range(len(senses))]
        places = {n.index: new for n, new in zip(senses, inputs, strict=True) if isinstance(n, Node)}
        parts = [effort, mass, _powers(trace), rates, traced.closure]

        def program(*more: Node) -> Program:
            nodes = [*(n for part in parts for n in part), *more]
            plainly = plain(kernel, nodes, marked=False, without=OUTSIDE).outputs
            return Program(self.graph, tuple(self.graph.substitute(plainly, places)))

        self.program = program()
        known = [x for x in self._inputs() if x.startswith("known ")]
        if known:  # whole turns, and groups without a closed form: followed from state to state
            self.program = program(*(n for a in traced.pose for n in trace_array(self.graph, a).ravel()))
        self.by_newton = any(not name.startswith("known turn") for name in known)
        self.followed = bool(known)
        self.known = LastPose(trace.course.pose, trace.course.followed)
        self.ends = np.cumsum([len(part) for part in parts])
        self.channels = [self._channel(trace, n, inputs) for n in self.program.inputs_in_use("channel")]
        self.last, self.size = np.zeros(count), 1e-300
        self.slopes: dict[tuple[bool, ...], Array] = {}

    def _inputs(self) -> list[str]:
        """Names of the channels in use."""
        return [self.graph.names[n.index] for n in self.program.inputs_in_use("channel")]

    @cached_property
    def run(self) -> Callable[[list[float], list[float]], Array]:
        """The program at single states."""
        return _machine_program(self.program, len(self.numbers), len(self.channels))

    def _channel(self, trace: Trace, node: Node, senses: list[Node]) -> Any:
        """Where an input stands in positions, senses and time, or how it follows from time and positions."""
        name, count = self.graph.names[node.index], len(self.names)
        if node in senses:
            return count + senses.index(node)
        what, _, of = name.partition(" ")
        if what == "position" and of in self.names:
            return self.names.index(of)
        if name == TIME:
            return count + len(senses)
        if what == "known":
            found = trace.inputs.found[node]
            return lambda t, q: np.ravel(found(self.known))[0]  # type: ignore[arg-type]
        if name in trace.inputs.varying and not any("." in n for n in trace.inputs.varying[name].names):
            varying = trace.inputs.varying[name]
            return lambda t, q: varying.at({**dict(zip(self.names, q, strict=True)), TIME: t})
        raise ModelError(
            f"the motion under forces needs {name!r}, which does not follow from the drives' positions alone",
            "choose drives that place the links in closed form, one group after the other",
        )

    def __call__(self, t: float, q: Array, u: Array, a: Array, sense: Array) -> Terms:
        d, ends, state = len(u), self.ends, (*q, *sense, t)
        for _ in range(STEPS):
            out = self.run([*u, *a], [state[f] if type(f) is int else float(f(t, q)) for f in self.channels])
            if not self.followed or self.known.follow(out[ends[4] :]) <= NEAR or not self.by_newton:
                break
        mass, power, rates = (out[i:j] for i, j in pairwise(ends[:4]))
        return Terms(out[:d], mass.reshape(d, d), power, rates, out[ends[3] : ends[4]])

    def stages(self, free: Flags) -> Stages | None:
        """A step of the motion in machine code, where drives go by forces (``free``, (D,)) that are straight lines of
        their own speed; None where it is not smooth, or needs more than the drives' positions and the time.

        The state: positions, speeds, works of drives, of brakes, loads, dampers and friction. Parameters, each (D,):
        effort at speed 0, its slope, that of the brake, acceleration of what is prescribed.
        """
        d = len(self.names)
        uneven = self.rough or self.followed or any(callable(f) for f in self.channels)
        if uneven or find_spec("llvmlite") is None:
            return None
        n, graph, outputs = 3 * d + 4, self.graph, self.program.outputs
        slots = [graph.input("channel", f"state {k}", 1.0) for k in range(n + 2 + 4 * d + STAGES * n)]
        weights = [graph.input("number", f"weight {k}", 1.0) for k in range(STAGES + 1)]
        given = np.array(slots[n + 2 : n + 2 + 4 * d]).reshape(4, d)
        before = np.array(slots[n + 2 + 4 * d :]).reshape(STAGES, n)[:, : 2 * d]
        far = np.array(slots[: 2 * d]) + slots[n + 1] * (np.array(weights[:-1]) @ before)
        q, u, t = far[:d], far[d:], slots[n] + weights[-1] * slots[n + 1]

        def found(count: int, a: Array) -> Array:
            inputs = (*self.program.inputs_in_use("channel"), *self.numbers)
            values = (*((*q, t)[f] for f in self.channels), *u, *a)
            places = {n.index: x for n, x in zip(inputs, trace_array(graph, values), strict=True)}
            return np.array(graph.substitute(outputs[:count], places), object)

        a, applied = np.where(free, 0.0, given[3]), given[0] + given[1] * u
        effort, mass = np.split(found(self.ends[1], a), [d])
        a[free] = solve_nodes(mass.reshape(d, d)[np.ix_(free, free)], (applied + given[2] - effort)[free])
        asked, _, power = np.split(found(self.ends[2], a), self.ends[:2])
        rate = [*u, *a, *np.where(free, applied, asked) * u, (given[2] * u).sum(), *power]
        program = Program(graph, tuple(trace_array(graph, rate)))
        # all stand where the state has them, used or not
        program.__dict__["places"] = {x.index: k for part in (slots, weights) for k, x in enumerate(part)}
        return Stages(program, n, 4 * d)

    def accelerations(
        self, t: float, q: Array, u: Array, given: Array, tau: Array, free: Array, sense: Array
    ) -> tuple[Array, Array, Terms]:
        """Accelerations (D,), those of ``free`` drives (D,) from their efforts tau; efforts of all; and the terms.

        Raises StoppedError where there are none: the mechanism does not close, or is singular, or jams.
        """
        a = np.where(free, self.last if self.rough else 0.0, given)
        before, slope, step = np.inf, self.slopes.get(tuple(free)), np.zeros_like(a)
        change, left = 0.0, a[free]
        for k in range(STEPS):
            e = self(t, q, u, a, sense)
            if not (np.isfinite(e.effort).all() and np.isfinite(e.mass).all()):
                raise StoppedError(OPEN)
            if not free.any():
                return a, e.effort, e
            gap = (tau - e.effort)[free]
            if slope is None or not self.rough or k == RENEWAL:
                slope = e.mass[np.ix_(free, free)]
            elif k and change:
                slope = slope - np.outer(gap - left + slope @ step[free], step[free] / (step @ step))
            pushed = np.abs(tau).max() / max(float(np.abs(slope).max()), 1e-300)
            self.size = max(self.size, float(pushed))  # what rounding is measured by, of the whole motion
            step[free], left = _solve(slope, gap), gap
            a, effort, change = a + step, e.effort + e.mass @ step, float(np.abs(step).max())
            self.size = max(self.size, float(np.abs(a).max()))
            if not self.rough or change <= SAME * self.size or before <= change <= ROUNDING * self.size:
                self.last, self.slopes[tuple(free)] = a, slope
                return a, effort, e
            before = change
        raise StoppedError("there it jams: no acceleration satisfies the law of friction")


def solve_nodes(mass: Array, right: Array) -> Array:
    """Solution of a positive system of nodes, which needs no pivoting."""
    mass, right = mass.copy(), right.copy()
    for k in range(len(right)):
        factor = mass[:, k] / mass[k, k]
        factor[k] = (mass[k, k] - 1.0) / mass[k, k]
        mass, right = mass - np.outer(factor, mass[k]), right - factor * right[k]
    return right


def _solve(mass: Array, right: Array) -> Array:
    with suppress(np.linalg.LinAlgError):
        if len(right) > 1 or mass[0, 0] > 0:
            return np.asarray(np.linalg.solve(mass, right))
    raise StoppedError(
        "nothing there has inertia, or friction makes it negative: no acceleration is determined"
    )


def _contacts(trace: Trace) -> tuple[list[str], list[Node | float], list[Node]]:
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
    c, traced = trace.catalogue.compiled, trace.catalogue.traced
    layout, f, pose, twist = c.layout, c.forcing, traced.pose, traced.twist

    def power(*sources: fc.Source) -> Node:
        parts = [
            (k, w)
            for s in sources
            for k, w in zip(s.link, s.wrench.reshape(-1, twist.shape[-1]), strict=True)
        ]
        return sum(((w * twist[k]).sum() for k, w in parts), trace.catalogue.graph.zero)

    def elastic(at: Array) -> list[fc.Source]:
        springs = [fc.spring_wrench(layout, f.springs, pose, at)] if len(f.springs.a) else []
        return (
            [*springs, fc.resistance_wrench(layout, f.resistances, pose, at)]
            if len(f.resistances.row)
            else springs
        )

    dampers = power(*elastic(twist)) - power(*elastic(0.0 * twist))
    slip, rubbing = traced.friction.slip, trace.catalogue.graph.zero
    if slip is not None and c.contacts is not None:
        rubbing = (np.where(c.contacts.fixed, 0.0, slip.cz) * slip.state.rate).sum()
    loads = trace.catalogue.graph.zero
    if len(f.forces.link) or len(f.couples.link):  # all power less that of the others
        inertial = fc.inertia_wrench(layout, f.inertia, pose, twist, traced.acceleration[:-1])
        others = power(*elastic(twist), fc.weight(layout, f.inertia, pose), inertial)
        loads = (traced.loads * twist[:-1]).sum() - others - rubbing
    return list(trace_array(trace.catalogue.graph, np.array([loads, dampers, rubbing], object)))


def _machine_program(
    program: Program, numbers: int, channels: int
) -> Callable[[list[float], list[float]], Array]:
    """The program at single states: as machine code, or in numpy where there is no compiler."""
    try:
        from dalembert.kernel.emit import llvm_text
        from dalembert.kernel.emit.machine_code import compile_module

        machine = compile_module(llvm_text.pairs(program, 1), 1)
    except ImportError:
        return _numpy_program(program)
    values, path, out = np.zeros(numbers + 1), np.zeros(channels + 1), np.zeros(len(program.outputs) + 1)
    arrays, code = (values, path, out), np.zeros(8, np.uint8)
    places, function = [address(a) for a in (*arrays, code)], machine.function

    def run(given: list[float], along: list[float]) -> Array:
        values[:numbers], path[:channels] = given, along
        function(*places, numbers, channels, 0, 1)
        return out[:-1].copy()

    run.keeps = (machine, arrays, code)  # type: ignore[attr-defined]  # code and arrays live as long as it
    return run


def _numpy_program(program: Program) -> Callable[[list[float], list[float]], Array]:
    numbers, along = program.inputs_in_use("number"), program.inputs_in_use("channel")

    def run(given: list[float], channels: list[float]) -> Array:
        values = {n.index: given[n.value] for n in numbers}
        values |= {n.index: x for n, x in zip(along, channels, strict=True)}
        return np.array(program.graph.evaluate(program.outputs, values), float)

    return run
