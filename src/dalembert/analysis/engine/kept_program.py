"""One structure's program: traced once along a known motion, then a function of numbers.

The branch of every group is an input, 1 or -1, which the first pose decides (``first_way``).

Mechanics: docs/theory.md 8.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.analysis.engine.flat_numbers import Numbers, Symbols, with_nodes
from dalembert.arrays import Array, Flags, Ints, Numeric
from dalembert.core.equilibrium import relative, usual
from dalembert.core.layout import Layout, Pose
from dalembert.core.position.assembly_modes import counted_links
from dalembert.kernel.doubts import uncertain
from dalembert.kernel.emit.numpy_program import NumpyProgram
from dalembert.kernel.graph import CONSTANT, INPUTS, Graph, Node, Scalar, trace_array
from dalembert.kernel.trace import Drives, Traced, TracedProblem, trace

POSE = ("closure", "point", "rotation", "turn")
KEPT = (*POSE, "twist", "acceleration", "effort", "load", "force", "moment")
CHECKS = ("loads", "unbalanced", "virtual", "power", "margin")
"""Outputs of a program, in order: the pose, all that an answer keeps, and the checks.

closure: first squares of quantities that vanish at dead centres, then the other conditions of the pose; these and
``margin`` are negative, or not a number, where a position is in doubt.
"""


CACHED = 500_000
"""Outputs that are checked at once, so that they stay in the cache."""


@dataclass(frozen=True, eq=False)
class TracedOutputs:
    """A traced structure: its inputs, and arrays of nodes by name, in the order of its outputs."""

    graph: Graph
    inputs: tuple[Node, ...]
    nodes: dict[str, Array]

    @cached_property
    def rows(self) -> dict[str, slice]:
        """Rows of the outputs of each array."""
        ends = np.cumsum([0, *(a.size for a in self.nodes.values())]).tolist()
        return {name: slice(*ends[k : k + 2]) for k, name in enumerate(self.nodes)}

    @property
    def kept(self) -> int:
        """Number of outputs that an answer keeps."""
        return int(self.rows[CHECKS[0]].start)

    @cached_property
    def size(self) -> int:
        """Number of outputs."""
        return sum(a.size for a in self.nodes.values())

    @cached_property
    def run(self) -> NumpyProgram:
        """All outputs at positions."""
        return NumpyProgram(self.graph, self.inputs, self.outputs(*self.nodes))

    def outputs(self, *names: str) -> list[Node]:
        """Outputs of some arrays."""
        return [n for name in names for n in self.nodes[name].ravel()]

    @cached_property
    def moments(self) -> Flags:
        """True for rows of forces, moments and loads that are moments."""
        loads = self.nodes["loads"]
        of = [np.zeros(self.nodes["force"].shape, bool), np.ones(self.nodes["moment"].shape, bool)]
        couples = np.zeros(loads.shape, bool)
        couples[..., self.nodes["force"].shape[-1] :] = True
        return np.concatenate([a.ravel() for a in (*of, couples)])

    def part(self, name: str, out: Array) -> Array:
        """One array (P, ...) of outputs (N, P)."""
        shape = self.nodes[name].shape
        array = out[self.rows[name]].reshape(*shape, out.shape[1])
        return array.transpose(len(shape), *range(len(shape)))

    def sure(self, out: Array) -> Flags:
        """True where the squares of rates are numbers and no check is in doubt, at each place."""
        rates = out[self.rows["twist"]]
        return np.asarray(
            np.isfinite((rates * rates).sum(axis=0)) & (out[self.rows["margin"]] >= 0).all(axis=0)
        )

    def balance(self, layout: Layout, out: Array) -> tuple[Array, Array]:
        """Residual over the largest force, and virtual power over force times velocity, at each place."""
        some = max(CACHED // self.size, 1)
        parts = [self._balance(layout, out[:, k : k + some]) for k in range(0, out.shape[1], some)]
        if len(parts) == 1:
            return parts[0]
        residual, power = zip(*parts, strict=True)
        return np.concatenate(residual), np.concatenate(power)

    def _balance(self, layout: Layout, out: Array) -> tuple[Array, Array]:
        per_length = layout.wrench_scale[:, None]
        forces = np.abs(out[self.rows["force"].start : self.rows["loads"].stop])
        forces[self.moments] /= layout.length
        largest = forces.max(axis=0, initial=0.0)
        left = self._sized("unbalanced", out) * per_length
        residual = relative(left.max(axis=(0, 1), initial=0.0), largest)
        speeds = self._sized("virtual", out) / per_length
        power = relative(np.abs(out[self.rows["power"]]), largest * speeds.max(axis=(1, 2), initial=0.0))
        return residual, power.max(axis=0, initial=0.0)

    def _sized(self, name: str, out: Array) -> Array:
        return np.abs(out[self.rows[name]]).reshape(*self.nodes[name].shape, out.shape[1])


@dataclass(frozen=True, eq=False)
class KeptProgram(TracedOutputs):
    """Program of a structure from its drives' positions to all forces: inputs (numbers, columns, then branches), and
    the branches it was traced on.

    squares: number of rows of closure that are squares. whole: it gives more than the pose; false where turns of
    springs must be counted. fixed (L,): links whose angle the drives alone give; counted: those whose full turns some
    row counts; last: the last branch that a link's rotation depends on, -1 for none. driven: the drives whose positions
    are inputs, which are the first columns. symbols, traced: the mechanism on nodes, and its complete trace. known:
    recent first poses, by the numbers that decide them.
    """

    branches: tuple[float, ...]
    squares: int
    complete: bool
    fixed: Flags
    counted: Flags
    last: Ints
    driven: tuple[int, ...]
    symbols: Symbols = field(repr=False)
    traced: Traced = field(repr=False)
    known: dict[Any, Any] = field(default_factory=dict, compare=False, repr=False)

    @property
    def pose(self) -> int:
        """Number of outputs of a pose."""
        return int(self.rows[POSE[-1]].stop)

    @cached_property
    def free(self) -> Ints:
        """Links whose angle the drives alone do not give."""
        return np.flatnonzero(~self.fixed)

    @cached_property
    def run_pose(self) -> NumpyProgram:
        """The outputs of the pose at positions."""
        return NumpyProgram(self.graph, self.inputs, self.outputs(*POSE))

    @cached_property
    def try_branches(self) -> NumpyProgram:
        """Rotations, then closure, of one position for several sets of branches side by side."""
        return NumpyProgram(self.graph, self.inputs, self.outputs("rotation", "closure"), many=True)

    @cached_property
    def decisive(self) -> list[int]:
        """The places, among the values of the inputs, of those that rotations depend on."""
        needed = {n.index for n in self.graph.order(self.outputs("rotation", "closure"))}
        return [
            k for k, n in enumerate(self.inputs[: len(self.inputs) - len(self.branches)]) if n.index in needed
        ]


class DeadCentreError(Exception):
    """Raised where both branches of a group coincide, or its pose does not identify one, or has small pivots: it is
    traced in another pose."""


def trace_structure(c: Compiled, numbers: Numbers, pose: Pose, inertia: bool) -> KeptProgram | None:
    """The program of a mechanism whose first pose (L+1, ...) is known; None where it needs more than its numbers."""
    graph = Graph()
    numbers = numbers._replace(columns=numbers.columns[:, 0])
    symbols = with_nodes(graph, c, numbers)
    known: dict[tuple[str, int], Node] = {}
    branches = _Ways(graph, pose)

    def path(what: str, which: int) -> Node:
        if (what, which) not in known:
            value = _known(pose, what, which)
            if not np.isfinite(value):
                raise DeadCentreError
            known[what, which] = graph.input("channel", f"known {what} {which}", value)
        return known[what, which]

    try:
        traced = trace(problem_of(graph, symbols, c, inertia, path, branches))
    except (ValueError, TypeError, KeyError):  # no closed form, or none that its numbers alone decide
        return None
    if not usual(c.layout, c.known, _sampled(graph, traced.pose)).all():
        raise DeadCentreError
    graph.samples.clear()
    return _kept(graph, symbols, traced, branches, c)


def _sampled(graph: Graph, pose: Pose) -> Pose:
    """The first pose (1, L+1, ...), by whose pivots those of other positions are judged."""
    parts = (graph.evaluate(trace_array(graph, a).ravel(), {}) for a in pose)
    return Pose(*(np.array(x, float).reshape(1, *np.shape(a)) for x, a in zip(parts, pose, strict=True)))


def problem_of(
    graph: Graph,
    symbols: Symbols,
    c: Compiled,
    inertia: bool,
    path: Callable[[str, int], Node],
    signs: Callable[..., Node],
) -> TracedProblem:
    """Problem of a mechanism on nodes for the kernel."""
    symbolic, (position, speed, acceleration) = symbols.compiled, symbols.drives
    angular = c.layout.freedoms.angular[c.layout.driven]
    cosine, sine = (
        np.array(
            [_circular(f, q) if turns else graph.zero for q, turns in zip(position, angular, strict=True)],
            object,
        )
        for f in ("cos", "sin")
    )
    drives = Drives(position, cosine, sine, speed, acceleration)
    return TracedProblem(
        graph=graph,
        layout=symbolic.layout,
        forcing=symbolic.forcing,
        known=symbolic.known,
        target=symbols.target,
        drives=drives,
        first=drives,
        like=c.layout,
        like_target=c.first_target,
        guess=c.guess,
        inertia=inertia,
        path=path,
        first_path=path,
        signs=signs,
        contacts=None if symbols.pose is None else symbolic.contacts,
        slips=None,
        reversals=None,
        margins={},
        pushing=c.pushing,
    )


def _circular(f: str, angle: Scalar) -> Scalar:
    node: Scalar = getattr(angle, f)()
    return node


def _known(pose: Pose, what: str, which: int) -> Numeric:
    columns = {"x": pose.point[which, 0], "y": pose.point[which, 1], "turn": pose.turn[which]}
    columns |= {"turn cos": pose.rotation[which, 0], "turn sin": pose.rotation[which, 1]}
    if what not in columns:
        raise KeyError(what)
    return columns[what]


class _Ways:
    """Inputs for the branches of groups, met one after the other as the trace goes on."""

    def __init__(self, graph: Graph, pose: Pose) -> None:
        self.graph, self.pose, self.inputs = graph, pose, list[Node]()

    def __call__(self, plus: tuple[Scalar, ...], minus: tuple[Scalar, ...], a: int, b: int) -> Node:
        nodes = [n if isinstance(n, Node) else self.graph.constant(n) for n in (*plus, *minus)]
        pc, ps, mc, ms = self.graph.evaluate(nodes, {})
        (ca, sa), (cb, sb) = self.pose.rotation[[a, b]].tolist()
        cos, sin = ca * cb + sa * sb, ca * sb - sa * cb
        nearer = np.hypot(mc - cos, ms - sin) - np.hypot(pc - cos, ps - sin)
        if not abs(nearer) > 0:
            raise DeadCentreError
        self.inputs.append(self.graph.input("common", f"sense {len(self.inputs)}", float(np.sign(nearer))))
        return self.inputs[-1]


def _kept(graph: Graph, symbols: Symbols, t: Traced, branches: _Ways, c: Compiled) -> KeptProgram | None:
    inputs = (*symbols.inputs, *branches.inputs)
    needs = _needs(graph, branches.inputs, {n.index for n in inputs})
    fixed = np.array([needs[n.index] >= 0 for n in t.pose.turn[:-1]], bool)
    squares = {n.index: n for n in t.closure if n.level != CONSTANT}
    closure = squares | {n.index: n for n in uncertain((*t.open, *graph.decisions))}
    margin = {n.index: n for n in uncertain((*t.doubt, *t.contacts))}
    outputs = {
        "closure": np.array(list(closure.values()), object),
        "point": t.pose.point[:-1],
        "rotation": t.pose.rotation[:-1].T,  # cosines, then sines
        "turn": trace_array(graph, np.where(fixed, t.pose.turn[:-1], 0.0)),
        **force_nodes(t),
        "margin": np.array([n for k, n in margin.items() if k not in closure], object),
    }
    nodes = {name: outputs[name] for name in (*KEPT, *CHECKS)}
    known_all = {name: all(needs[n.index] >= 0 for n in a.ravel()) for name, a in nodes.items()}
    if not all(known_all[name] for name in POSE):
        return None
    last = [max(needs[n.index].bit_length() for n in pair) - 1 for pair in t.pose.rotation[:-1]]
    nominal = tuple(float(graph.nominal[n.index]) for n in branches.inputs)
    driven = tuple(k for k, q in enumerate(symbols.drives[0]) if q.op in INPUTS)
    return KeptProgram(
        graph=graph,
        inputs=inputs,
        nodes=nodes,
        branches=nominal,
        squares=len(squares),
        complete=all(known_all.values()),
        fixed=fixed,
        counted=counted_links(c.layout),
        last=np.array(last, np.intp),
        driven=driven,
        symbols=symbols,
        traced=t,
    )


def force_nodes(t: Traced) -> dict[str, Array]:
    """Motion, forces and what checks them, by name."""
    names = ("effort", "load", "force", "moment", "loads", "unbalanced", "power")
    motion = {"twist": t.twist[:-1], "acceleration": t.acceleration[:-1], "virtual": t.virtual[:, :-1]}
    return motion | {name: getattr(t, name) for name in names}


def _needs(graph: Graph, branches: list[Node], known: set[int]) -> list[int]:
    """The branches that each node depends on, as bits; -1 where it needs an input that is not known."""
    bits = {n.index: 1 << k for k, n in enumerate(branches)}
    out: list[int] = []
    for n in graph.nodes:
        if n.a is None:
            out.append(-1 if n.op in INPUTS and n.index not in known else bits.get(n.index, 0))
        elif n.b is None:
            out.append(out[n.a.index])
        else:
            one, two = out[n.a.index], out[n.b.index]
            out.append(-1 if one < 0 or two < 0 else one | two)
    return out
