"""A traced analysis as a list of instructions: those computed once per design, and those at every position."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from dalembert.kernel.graph import CONSTANT, INPUTS, POSITION, Graph, Node

SLOW = {"inv": 6, "rsqrt": 7, "sqrt": 8, "sin": 15, "cos": 15, "atan2": 30, "neg": 0, "detach": 0}
"""Cost of operations other than additions and products, in additions."""

SMALL = 2000
"""Operations below which the results of two registers side by side still fit into the first-level cache."""
ABREAST = 8
"""Number of independent operations below which two registers side by side are faster than one: one computes while the
other waits. Two units with a latency of four cycles each need eight."""
STORED = 32
"""Outputs beyond which each needs PER_STORE operations; otherwise two registers side by side take up to a quarter
longer, since stores then limit the speed."""
PER_STORE = 12

CODES = {
    "open": 1,
    "doubt": 2,
    "rest": 3,
    "jam": 7,
    "locked": 9,
    "slope": 12,
    "outside": 14,
    "contact": 15,
}
"""The mark of a position, the first of these that applies, else 0; of many positions the first too."""


@dataclass(frozen=True)
class KernelFlags:
    """Nodes that decide whether the outputs are valid, each negative where it applies.

    open: the linkage does not close. doubt (below zero, or no number): the general executor decides. rest: friction
    has no rate that gives its sense. Elsewhere ``slips``, as doubt, and so where both ``unsure`` and ``sure`` are, but
    for ``jam``, which decides it: it surely jams. turned: friction turns the power of the unknowns round; there
    ``still``, as doubt, and ``locked``: it does so without inertia too. Without ``locked`` being turned is enough.
    contact (below zero): a contact that only pushes would have to pull. outside (below zero): a table ends before.
    slope (below zero, or no number): the outputs are right, but some derivative has no value.
    """

    open: tuple[Node, ...] = ()
    doubt: tuple[Node, ...] = ()
    rest: tuple[Node, ...] = ()
    slips: tuple[Node, ...] = ()
    unsure: tuple[Node, ...] = ()
    sure: tuple[Node, ...] = ()
    jam: tuple[Node, ...] = ()
    turned: tuple[Node, ...] = ()
    still: tuple[Node, ...] = ()
    locked: tuple[Node, ...] = ()
    contact: tuple[Node, ...] = ()
    outside: tuple[Node, ...] = ()
    slope: tuple[Node, ...] = ()

    @property
    def always(self) -> list[Node]:
        """Those asked at every position."""
        first = [*self.open, *self.doubt, *self.rest, *self.slips, *self.unsure, *self.turned]
        return [*first, *self.contact, *self.outside, *self.slope]

    @property
    def seldom(self) -> list[Node]:
        """Flags evaluated only where something is unsure, or power is reversed."""
        return [*self.sure, *self.still, *self.locked]

    @property
    def names(self) -> list[str]:
        """Flags that can occur; the first takes precedence."""
        flags: dict[str, Sequence[Node]] = {
            "open": self.open,
            "doubt": [*self.doubt, *self.slips, *self.sure, *self.still],
            "rest": self.rest,
            "jam": self.jam,
            "contact": self.contact,
            "locked": self.turned,
            "slope": self.slope,
            "outside": self.outside,
        }
        return [name for name, nodes in flags.items() if nodes]


@dataclass(frozen=True)
class Program:
    """Outputs as nodes of a graph, and the flags that decide whether they are valid."""

    graph: Graph
    outputs: tuple[Node, ...]
    flags: KernelFlags = KernelFlags()

    @cached_property
    def order(self) -> list[Node]:
        """Every node needed, arguments first."""
        return self.graph.order([*self.outputs, *self.flags.always, *self.flags.seldom, *self.flags.jam])

    @cached_property
    def design(self) -> list[Node]:
        """Operations that do not change with the position."""
        return [n for n in self.order if n.a is not None and not n.level & POSITION]

    @cached_property
    def position(self) -> list[Node]:
        """Operations of every position."""
        always = self.graph.order([*self.outputs, *self.flags.always])
        return [n for n in always if n.a is not None and n.level & POSITION]

    @cached_property
    def seldom(self) -> list[Node]:
        """Operations of the rarely evaluated flags."""
        return self._beyond(self.flags.seldom, self.position)

    @cached_property
    def rare(self) -> list[Node]:
        """Operations of the proof of a jam."""
        return self._beyond(self.flags.jam, [*self.position, *self.seldom])

    def _beyond(self, nodes: Sequence[Node], done: list[Node]) -> list[Node]:
        """Operations of every position that some nodes need in addition to those done."""
        known = {n.index for n in done}
        needed = self.graph.order(nodes)
        return [n for n in needed if n.a is not None and n.level & POSITION and n.index not in known]

    @cached_property
    def inputs(self) -> list[Node]:
        """Inputs in use."""
        return [n for n in self.order if n.op in INPUTS]

    def inputs_in_use(self, kind: str) -> list[Node]:
        """Inputs of one kind in use: channel or common."""
        return [n for n in self.inputs if n.op == kind]

    @cached_property
    def places(self) -> dict[int, int]:
        """Index of each input: numbers in the order of the values, the others packed."""
        packed = {
            n.index: k for kind in ("channel", "common") for k, n in enumerate(self.inputs_in_use(kind))
        }
        return packed | {n.index: n.value for n in self.inputs if n.op == "number"}

    @cached_property
    def constants(self) -> list[Node]:
        """Constants in use."""
        return [n for n in self.order if n.level == CONSTANT and n.a is None]

    @property
    def depth(self) -> int:
        """Operations on the longest dependent chain to a result, inverses and roots counted as several."""
        ends: dict[int, int] = {}
        for n in self.position:
            before = max(ends.get(x.index, 0) for x in (n.a, n.b) if x is not None)
            ends[n.index] = before + SLOW.get(n.op, 1)
        return max(ends.values(), default=0)

    @property
    def size(self) -> int:
        """Scalar operations per position."""
        return sum(1 for n in self.position if n.op not in ("neg", "detach"))

    @property
    def waits(self) -> bool:
        """True if a program in one register would wait for its results."""
        size, stores = self.size, len(self.outputs)
        return size < min(SMALL, ABREAST * self.depth) and (stores <= STORED or size > PER_STORE * stores)
