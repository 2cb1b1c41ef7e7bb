"""One structure's program: traced once along a known motion, then a function of numbers.

Every way a group closes is an input here, 1 or -1: which one it is, the first pose decides (``first_way``).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.analysis.engine.flat_numbers import Numbers, with_nodes
from dalembert.arrays import Array, Flags, Ints
from dalembert.core.layout import Pose
from dalembert.core.position.assembly_modes import counted_links
from dalembert.kernel.emit.numpy_program import NumpyProgram
from dalembert.kernel.graph import CONSTANT, INPUTS, Graph, Node, Scalar, trace_array
from dalembert.kernel.trace import Drives, Problem, Traced, trace

POSE = ("closure", "point", "rotation", "turn")
KEPT = (*POSE, "twist", "acceleration", "effort", "load", "force", "moment")
CHECKS = ("loads", "unbalanced", "virtual", "power", "margin")
"""What a program computes, in the order of its outputs: the pose, all that an answer keeps, and what only checks it.

closure: first squares of what vanishes at dead centres, then what else must hold for the pose; these and ``margin`` are
negative, or no number, where something is in doubt.
"""


@dataclass(frozen=True)
class KeptProgram:
    """A traced structure: inputs (numbers, columns, then ways), arrays of nodes by name, and the ways it was traced in.

    squares: how many rows of closure are such. whole: it gives more than the pose; not so where turns of springs are to
    be counted. fixed (L,): links whose angle the drives alone give; counted: those whose whole turns some row counts;
    last: the last way that a link's rotation depends on, -1 for none. driven: the drives whose positions are inputs,
    which are the first columns. known: first poses found lately, by what decides them.
    """

    graph: Graph
    inputs: tuple[Node, ...]
    nodes: dict[str, Array]
    ways: tuple[float, ...]
    squares: int
    whole: bool
    fixed: Flags
    counted: Flags
    last: Ints
    driven: tuple[int, ...]
    known: dict[Any, Any] = field(default_factory=dict, compare=False, repr=False)

    @cached_property
    def rows(self) -> dict[str, slice]:
        """Rows of the outputs of each array."""
        ends = np.cumsum([0, *(self.nodes[name].size for name in (*KEPT, *CHECKS))]).tolist()
        return {name: slice(*ends[k : k + 2]) for k, name in enumerate((*KEPT, *CHECKS))}

    @property
    def pose(self) -> int:
        """How many outputs a pose has."""
        return int(self.rows[POSE[-1]].stop)

    @property
    def kept(self) -> int:
        """How many outputs an answer keeps."""
        return int(self.rows[CHECKS[0]].start)

    @property
    def size(self) -> int:
        """How many outputs there are."""
        return int(self.rows[CHECKS[-1]].stop)

    @cached_property
    def run(self) -> NumpyProgram:
        """All outputs at positions."""
        return NumpyProgram(self.graph, self.inputs, self._outputs(*KEPT, *CHECKS))

    @cached_property
    def run_pose(self) -> NumpyProgram:
        """The outputs of the pose at positions."""
        return NumpyProgram(self.graph, self.inputs, self._outputs(*POSE))

    def _outputs(self, *names: str) -> list[Node]:
        return [n for name in names for n in self.nodes[name].ravel()]

    @cached_property
    def try_ways(self) -> NumpyProgram:
        """Rotations, then closure, of one position for several ways side by side."""
        return NumpyProgram(self.graph, self.inputs, self._outputs("rotation", "closure"), many=True)

    @cached_property
    def decisive(self) -> list[int]:
        """The places, among the values of the inputs, of those that rotations depend on."""
        needed = {n.index for n in self.graph.order(self._outputs("rotation", "closure"))}
        return [
            k for k, n in enumerate(self.inputs[: len(self.inputs) - len(self.ways)]) if n.index in needed
        ]

    @cached_property
    def moments(self) -> Flags:
        """Which rows of forces, moments and loads are moments."""
        of = [np.zeros(self.nodes["force"].shape, bool), np.ones(self.nodes["moment"].shape, bool)]
        couples = np.zeros(self.nodes["loads"].shape, bool)
        couples[..., 2] = True
        return np.concatenate([a.ravel() for a in (*of, couples)])

    def part(self, name: str, out: Array) -> Array:
        """One array (P, ...) of outputs (N, P)."""
        shape = self.nodes[name].shape
        whole = out[self.rows[name]].reshape(*shape, out.shape[1])
        return whole.transpose(len(shape), *range(len(shape)))


class DeadCentreError(Exception):
    """Raised where both ways of a group are one: a structure is traced in another pose."""


def trace_structure(c: Compiled, numbers: Numbers, pose: Pose, inertia: bool) -> KeptProgram | None:
    """The program of a mechanism whose first pose (1, L+1, ...) is known; None where it needs more than its numbers."""
    graph = Graph()
    numbers = numbers._replace(columns=numbers.columns[:, :1])
    symbols = with_nodes(graph, c, numbers)
    position, speed, acceleration = symbols.drives
    angular = c.layout.freedoms.angular[c.layout.driven]
    cosine, sine = (
        np.array(
            [_circular(f, q) if turns else graph.zero for q, turns in zip(position, angular, strict=True)],
            object,
        )
        for f in ("cos", "sin")
    )
    drives = Drives(position, cosine, sine, speed, acceleration)
    known: dict[tuple[str, int], Node] = {}
    ways = _Ways(graph, pose)

    def path(what: str, which: int) -> Node:
        if (what, which) not in known:
            known[what, which] = graph.input("channel", f"known {what} {which}", _known(pose, what, which))
        return known[what, which]

    symbolic = symbols.compiled
    problem = Problem(
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
        signs=ways,
        contacts=None,
        slips=None,
        reversals=None,
        margins={},
    )
    try:
        traced = trace(problem)
    except (ValueError, TypeError, KeyError):  # no closed form, or none that its numbers alone decide
        return None
    graph.samples.clear()
    return _kept(graph, (*symbols.inputs, *ways.inputs), traced, ways, position, c)


def _circular(f: str, angle: Scalar) -> Scalar:
    node: Scalar = getattr(angle, f)()
    return node


def _known(pose: Pose, what: str, which: int) -> Array:
    columns = {"x": pose.point[:, which, 0], "y": pose.point[:, which, 1], "turn": pose.turn[:, which]}
    columns |= {"turn cos": pose.rotation[:, which, 0], "turn sin": pose.rotation[:, which, 1]}
    if what not in columns:
        raise KeyError(what)
    return columns[what]


class _Ways:
    """Inputs for the ways that groups close, met one after the other as the trace goes on."""

    def __init__(self, graph: Graph, pose: Pose) -> None:
        self.graph, self.pose, self.inputs = graph, pose, list[Node]()

    def __call__(self, plus: tuple[Scalar, ...], minus: tuple[Scalar, ...], a: int, b: int) -> Node:
        nodes = [n if isinstance(n, Node) else self.graph.constant(n) for n in (*plus, *minus)]
        pc, ps, mc, ms = self.graph.evaluate(nodes, {})
        r = self.pose.rotation
        cos = r[:, a, 0] * r[:, b, 0] + r[:, a, 1] * r[:, b, 1]
        sin = r[:, a, 0] * r[:, b, 1] - r[:, a, 1] * r[:, b, 0]
        nearer = np.hypot(mc - cos, ms - sin) - np.hypot(pc - cos, ps - sin)
        if not abs(nearer[0]) > 0:
            raise DeadCentreError
        self.inputs.append(self.graph.input("common", f"way {len(self.inputs)}", float(np.sign(nearer[0]))))
        return self.inputs[-1]


def _kept(
    graph: Graph, inputs: tuple[Node, ...], t: Traced, ways: _Ways, position: Array, c: Compiled
) -> KeptProgram | None:
    needs = _needs(graph, ways.inputs, {n.index for n in inputs})
    fixed = np.array([needs[n.index] >= 0 for n in t.pose.turn[:-1]], bool)
    squares = {n.index: n for n in t.closure if n.level != CONSTANT}
    closure = squares | {n.index: n for n in (*t.open, *graph.decisions) if n.level != CONSTANT}
    margin = {n.index: n for n in t.doubt if n.level != CONSTANT}
    nodes = {
        "closure": np.array(list(closure.values()), object),
        "point": t.pose.point[:-1],
        "rotation": t.pose.rotation[:-1].T,  # cosines, then sines
        "turn": trace_array(graph, np.where(fixed, t.pose.turn[:-1], 0.0)),
        "twist": t.twist[:-1],
        "acceleration": t.acceleration[:-1],
        **{
            name: getattr(t, name)
            for name in ("effort", "load", "force", "moment", "loads", "unbalanced", "power")
        },
        "virtual": t.virtual[:, :-1],
        "margin": np.array([n for k, n in margin.items() if k not in closure], object),
    }
    known_all = {name: all(needs[n.index] >= 0 for n in a.ravel()) for name, a in nodes.items()}
    if not all(known_all[name] for name in POSE):
        return None
    last = [max(needs[n.index].bit_length() for n in pair) - 1 for pair in t.pose.rotation[:-1]]
    found = tuple(float(graph.nominal[n.index]) for n in ways.inputs)
    driven = tuple(k for k, q in enumerate(position) if q.op in INPUTS)
    return KeptProgram(
        graph=graph,
        inputs=inputs,
        nodes=nodes,
        ways=found,
        squares=len(squares),
        whole=all(known_all.values()),
        fixed=fixed,
        counted=counted_links(c.layout),
        last=np.array(last, np.intp),
        driven=driven,
    )


def _needs(graph: Graph, ways: list[Node], known: set[int]) -> list[int]:
    """The ways that each node depends on, as bits; -1 where it needs an input that is not known."""
    bits = {n.index: 1 << k for k, n in enumerate(ways)}
    out: list[int] = []
    for n in graph.nodes:
        if n.a is not None:
            a, b = out[n.a.index], out[(n.b or n.a).index]
            out.append(-1 if a < 0 or b < 0 else a | b)
        else:
            out.append(-1 if n.op in INPUTS and n.index not in known else bits.get(n.index, 0))
    return out
