"""The equation of motion of the drives, as a function of numbers: inverse dynamics, which is affine in accelerations.

effort(q, u, a) = M_r(q) a + h(q, u): the traced analysis gives it with its exact derivative by a, which is M_r. Dry
friction is one more input of it, which ``dry_friction`` finds.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property
from importlib.util import find_spec
from itertools import pairwise
from threading import RLock
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags, Numeric
from dalembert.core.friction.contact_equations import Contacts
from dalembert.core.layout import Layout, Pose
from dalembert.core.rotation_rows import recount_turns
from dalembert.errors import AnalysisError
from dalembert.kernel.emit import llvm_text
from dalembert.kernel.graph import Node
from dalembert.kernel.memory import address
from dalembert.kernel.program import Program
from dalembert.machine.motion.coded.rate_program import Corners, MasslessError, rate_steps
from dalembert.machine.motion.coded.steps import Integrator
from dalembert.machine.motion.corners.one_sided import Sided
from dalembert.machine.motion.rest.dry_friction import Contacted, DryFriction, Linear
from dalembert.model.quantities.coordinates import TIME
from dalembert.model.quantities.expressions import Expression
from dalembert.model.quantities.tables import Table

if TYPE_CHECKING:
    from dalembert.kernel.emit.machine_code import Machine

STEPS = 40
"""Newton's steps for a pose that has no closed form."""
NEAR = 1e-7
"""Largest distance of a state's pose from the one at which Newton's steps began, for which they have converged."""
STRIDE, SHORT, STRIDES = 2.0, 1e-3, 256
"""Radians or metres by which a pose may move from one state to the next, as turns are counted; a longer motion is
followed in parts: the least motion of a drive in one of them, and the largest number of parts."""
WEIGHTLESS = 1e-12
"""Part of the greatest inertia that is rounding."""
DEAD_CENTRE = (
    "the mechanism is at a dead centre or a change point, from which it can continue on two branches, and its drives "
    "do not decide which; release a drive that places the links at this position too"
)
OPEN = "the mechanism does not close, or its drives do not place its links"


NO_CORNERS: dict[int, Corners] = {}

LOCK = RLock()
"""Held while nodes are added to a graph that others may have too."""


class StoppedError(AnalysisError):
    """Raised where the motion cannot go on, with the reason as a sentence."""


class Terms(NamedTuple):
    """At a state: efforts (D,) at no acceleration, M_r (D, D), powers of loads and dampers (2,), rates of the contacts
    (E,), a margin, negative within 0.2 deg of a dead centre or change point; for the watched freedoms (J, 3 + D) value,
    up to full turns, rate and, at no acceleration, second rate, and slope with each drive; switching variables of loads
    that depend on the pose; and the changes by friction."""

    effort: Array
    mass: Array
    power: Array
    rates: Array
    closure: Array
    freedoms: Array
    corners: Array
    linear: Linear | None


@dataclass
class LoadChannel:
    """A load that follows from the drives' positions and time, each of its corners on one side."""

    varying: Expression | Table
    names: tuple[str, ...]
    sided: Sided | None = None

    def known(self, t: float, q: Array) -> dict[str, float]:
        """Variables of its dependence at a state."""
        return {**dict(zip(self.names, q, strict=True)), TIME: t}

    def __call__(self, t: float, q: Array, _: object) -> Numeric:
        return (self.sided or self.varying).at(self.known(t, q))

    def again(self) -> LoadChannel:
        """The same for another motion."""
        return replace(self, sided=self.sided and self.sided.again())


@dataclass
class LastPose:
    """Pose of the last state, from which whole turns are counted and Newton's steps begin; a course of one.
    ``anchor``: the pose at which a step of the integration begins; states ``at`` nearer to that one start from it, as
    a trial that was refused may have led to another branch."""

    pose: Pose
    followed: Any
    layout: Layout
    at: Array | None = None
    anchor: tuple[Pose, Array] | None = None

    def start(self, q: Array) -> Array | None:
        """Begin a state from the nearer one of the last state and the anchor; returns its drives' positions."""
        from_ = self.at
        if self.anchor is not None and from_ is not None:
            pose, at = self.anchor
            if np.abs(q - at).max() <= np.abs(q - from_).max():
                self.pose, from_ = pose, at
        self.at = q.copy()
        return from_

    def moved(self, before: Pose) -> float:
        """Largest difference from another pose, in m or rad."""
        return max(float(np.abs(x - y[:1]).max(initial=0.0)) for x, y in zip(self.pose, before, strict=True))

    def follow(self, values: Array) -> float:
        """Take another pose, all its numbers in a row; how far it is, in m or rad."""
        sizes = np.cumsum([part[0].size for part in self.pose])
        parts = np.split(values, sizes[:-1])
        new = Pose(*(x.reshape(part[:1].shape) for x, part in zip(parts, self.pose, strict=True)))
        if not np.isfinite(values).all():
            return 0.0
        if self.layout.algebra.d == 3:
            new = recount_turns(self.layout, new)
        before, self.pose = self.pose, new
        return self.moved(before)


class Equation:
    """Efforts required at a state of all drives, for a mechanism whose drives are all prescribed.

    ``parts``: nodes of the terms, in their order; ``numbers``: those of speeds, then of accelerations; ``values``: of
    all numbers, those of nodes where ``places`` says; ``channels``: index of an input in positions, senses and time, or
    its function of time and positions; ``sides``: places of the values for sides of loads computed in machine code.
    ``known``: the pose, where states are followed one by one; ``dry``: the contacts, where there is friction, with the
    names of the joints of its ``own`` ones (those that slip independently); ``contacts``: the same as nodes;
    ``friction``: inputs of what is ``asked``, c z of each contact; ``pushes``: places of the values for forces of
    elastic stops, by their joint's place among those with stops. Where what acts on drives is part of it: ``stops``
    that are struck, whose numbers are outputs of the program behind the others; time constants of ``late`` motors;
    ``lost``: number of contacts that open below zero, the last outputs.
    """

    def __init__(
        self,
        names: tuple[str, ...],
        program: Program,
        parts: Sequence[Sequence[Node]],
        numbers: Sequence[Node],
        places: dict[int, int],
        values: Array,
        channels: list[Any],
    ) -> None:
        self.names, self.program, self.graph, self.channels = names, program, program.graph, channels
        self.ends, self.numbers, self.values = np.cumsum([len(part) for part in parts]), numbers, values
        bounds = [0, *self.ends.tolist()]
        self.slices = [slice(a, b) for a, b in pairwise(bounds)]
        self.places, self.rates = places, [places[n.index] for n in numbers]
        program.__dict__["places"] = program.places | places
        self.joints: list[str] = []
        self.dry: DryFriction | None = None
        self.known: LastPose | None = None
        self.by_newton = False
        self.kept: dict[object, Any] = {}
        self.kernel: Any = None
        self.asked, self.asked_channels = program, channels
        self.sides: list[int] = []
        self.pushes: dict[int, int] = {}
        self.stops: list[Any] = []
        self.late: dict[int, Node] = {}
        self.lost = 0
        self.contacts: Contacts | None = None
        self.friction: list[Node] = []

    @property
    def bends(self) -> int:
        """Number of bends of springs and dampers by tables, at the end of what switches."""
        return int(self.ends[6] - self.ends[5]) - len(self.sides)

    def again(self, values: Array | None = None) -> Equation:
        """The same equation for another motion, of other numbers; its machine code is shared."""
        new = copy(self)
        new.values = (self.values if values is None else values).copy()
        new.known, new.dry = self.known and replace(self.known), self.dry and replace(self.dry)
        new.channels = [c.again() if isinstance(c, LoadChannel) else c for c in self.channels]
        new.__dict__.pop("run", None)
        return new

    @cached_property
    def run(self) -> Callable[[Sequence[float]], Array]:
        """The program at single states, with ``values``, from its channels."""
        if find_spec("llvmlite") is None:
            return _numpy_program(self.program, self.values)
        if "terms" not in self.kept:
            from dalembert.kernel.emit.machine_code import compile_module

            self.kept["terms"] = compile_module(llvm_text.pairs(self.program, 1), 1)
        return _machine_program(
            self.kept["terms"], self.values, len(self.channels), len(self.program.outputs)
        )

    def __call__(self, t: float, q: Array, u: Array) -> Terms:
        """The terms at a state, at no accelerations and without dry friction."""
        if not self.known:
            return self._at(t, q, u)
        from_ = self.known.start(q)
        pose = self.known.pose
        terms, parts = self._at(t, q, u), 2
        most = 0.0 if from_ is None else min(float(np.abs(q - from_).max()) / SHORT, STRIDES)
        while self.known.moved(pose) > STRIDE and parts <= most:
            self.known.pose, far = pose, 0.0
            for x in from_ + np.arange(1, parts + 1)[:, None] / parts * (q - from_):
                before = self.known.pose
                terms = self._at(t, x, u)
                far = max(far, self.known.moved(before))
            if far <= STRIDE:
                break
            parts *= 2
        if not np.isfinite(terms.effort).all():
            self.known.pose = pose  # no state goes on from where the loops do not close
            if self.known.anchor is not None and self.known.anchor[0] is not pose:
                self.known.pose, self.known.at = self.known.anchor
                return self(t, q, u)
        return terms

    def _at(self, t: float, q: Array, u: Array) -> Terms:
        """The terms at a state, whose pose follows from the last one."""
        self.values[self.rates] = [*u, *np.zeros(len(u))]
        state = (*q, t)
        for _ in range(STEPS):
            along = [f(t, q, self.known) if callable(f) else state[f] for f in self.channels]
            out = self.run(along)
            if not self.known or self.known.follow(out[self.ends[-1] :]) <= NEAR or not self.by_newton:
                break
        return self.terms(out[: self.ends[-1]])

    def pushed(self, forces: Mapping[int, float], t: float, q: Array, u: Array) -> Terms:
        """The terms with forces in the freedoms of joints, by their place among those with stops."""
        places = {self.pushes[j]: force for j, force in forces.items() if j in self.pushes}
        self.values[list(places)] = list(places.values())
        try:
            return self(t, q, u)
        finally:
            self.values[list(places)] = 0.0

    def terms(self, out: Array) -> Terms:
        """The terms of all outputs, numbers or nodes."""
        d, linear = len(self.names), None
        effort, mass, power, rates, closure, freedoms, corners, *more = (out[part] for part in self.slices)
        if self.dry:
            e = self.dry.contacts.count
            shapes = (d, e), (3, e), (3, e, d), (3, e, e), (e,)
            linear = Linear(*(x.reshape(shape) for x, shape in zip(more, shapes, strict=True)))
        return Terms(
            effort, mass.reshape(d, d), power, rates, closure, freedoms.reshape(-1, 3 + d), corners, linear
        )

    def set_anchor(self) -> None:
        """Keep the last state as the one at which a step begins."""
        if self.known and self.known.at is not None:
            self.known.anchor = self.known.pose, self.known.at

    def steps(
        self, free: Flags, lanes: int = 1, works: bool = True, corners: Mapping[int, Corners] = NO_CORNERS
    ) -> Integrator | None:
        """Steps of motions side by side in machine code, where drives move by forces (``free``, (D,)) that are linear
        in the drive's speed; None where it is not smooth, or needs more than the drives' positions and the time.

        The state: positions, speeds; ``works`` of drives, of brakes, loads, dampers and friction. After ``values``
        follow, each (D,): effort at speed 0, its slope, that of the brake, acceleration of the prescribed drives; then
        of the O independent contacts the senses, and 1 where they stick. ``corners`` of drives: changes of slope of
        these lines. Watched: rates of these contacts (O,), ``margins`` (2K,) of all; where several drives move freely,
        so that contacts may stick, room and part of the limit, each (O,).
        """
        if self.known or any(callable(f) for f in self.channels) or find_spec("llvmlite") is None:
            return None
        key = (lanes, works, *free.tolist(), *corners)
        with LOCK:
            if key not in self.kept:
                try:
                    self.kept[key] = rate_steps(self, free, lanes, works, corners)
                except MasslessError as massless:
                    name = [n for n, moves in zip(self.names, free, strict=True) if moves][massless.drive]
                    raise StoppedError(no_inertia(name)) from None
        return self.kept[key]  # type: ignore[no-any-return]

    def accelerations(
        self,
        t: float,
        q: Array,
        u: Array,
        prescribed: Array,
        tau: Array,
        free: Flags,
        sense: Array,
        stuck: Flags,
        rotor: Array | float = 0.0,
        loaded: Callable[[float, Array, Array], Terms] | None = None,
    ) -> tuple[Contacted, Terms]:
        """Accelerations (D,), those of ``free`` drives (D,) from their efforts tau, with what contacts do; the terms.
        ``rotor`` (D,): inertias of what turns with the drives beside the links; ``loaded``: the terms with what else
        pushes.

        Raises StoppedError where there are none: the mechanism does not close, or is singular, or jams.
        """
        e, a = (loaded or self)(t, q, u), np.where(free, 0.0, prescribed)
        if not all(np.isfinite(x).all() for x in (e.effort, e.mass, *(e.linear or ()))):
            raise StoppedError(OPEN)
        e = e._replace(mass=e.mass + np.diag(rotor + np.zeros(len(a))))
        push = e.linear.push if e.linear else np.zeros((len(a), 0))
        m, right = e.mass[np.ix_(free, free)], np.column_stack([tau - e.effort - e.mass @ a, -push])
        ease = _solve(m, right[free], [name for name, moves in zip(self.names, free, strict=True) if moves])
        a[free], change = ease[:, 0], np.zeros_like(push)
        change[free] = ease[:, 1:]
        effort, change = e.effort + e.mass @ a, np.vstack([change, push + e.mass @ change])
        none = np.zeros(push.shape[1])
        if not self.dry or not e.linear:
            return Contacted(a, effort, *(none,) * 6), e
        contacts = self.dry.solve(e.linear, a, effort, change, self.dry.senses(e.rates, sense), stuck)
        if contacts is None:
            raise StoppedError("the machine jams: no acceleration satisfies the law of friction")
        return contacts, e


def no_inertia(name: str, where: str = "") -> str:
    """That a drive moves no mass, if only in a position."""
    return f"a part that moves has no inertia: forces that move {name} move no mass{where}; give its links masses"


def lightest(mass: Array) -> tuple[float, int]:
    """Least inertia of a motion of the drives beside what each has alone, and the drive that moves most in it."""
    size = np.sqrt(np.abs(mass.diagonal()))
    light = ~(size > WEIGHTLESS * size.max())
    if light.any():
        return 0.0, int(light.argmax())
    least, direction = np.linalg.eigh((mass + mass.T) / (2 * size * size[:, None]))
    return float(least[0]), int(np.abs(direction[:, 0]).argmax())


def _solve(mass: Array, right: Array, names: Sequence[str]) -> Array:
    with suppress(np.linalg.LinAlgError):
        if len(mass) != 1 or mass[0, 0] > 0:
            return np.asarray(np.linalg.solve(mass, right))
    raise StoppedError(no_inertia(names[lightest(mass)[1]]))


def _machine_program(
    machine: Machine, values: Array, channels: int, outputs: int
) -> Callable[[Sequence[float]], Array]:
    """Machine code of a program at single states."""
    path, out, code = np.zeros(channels + 1), np.zeros(outputs + 1), np.zeros(8, np.uint8)
    places, function = [address(a) for a in (values, path, out, code)], machine.function

    def run(along: Sequence[float]) -> Array:
        path[:channels] = along
        function(*places, len(values), channels, 0, 1)
        return out[:-1].copy()

    run.keeps = (machine, values, code)  # type: ignore[attr-defined]  # code and arrays live as long as it
    return run


def _numpy_program(program: Program, values: Array) -> Callable[[Sequence[float]], Array]:
    """The program at single states in numpy, where no compiler is available."""
    numbers, along = program.inputs_in_use("number"), program.inputs_in_use("channel")

    def run(channels: Sequence[float]) -> Array:
        inputs: dict[int, float] = {n.index: values[program.places[n.index]] for n in numbers}
        inputs |= {n.index: x for n, x in zip(along, channels, strict=True)}
        return np.array(program.graph.evaluate(program.outputs, inputs), float)

    return run
