"""Numbers that a page shows, each a row of the kernel's outputs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np

from dalembert.arrays import Numeric
from dalembert.kernel.graph import Graph, Node, trace_array
from dalembert.model import GROUND
from dalembert.pages.symbolic_result import SymbolicResult


@dataclass
class NodeRows:
    """Nodes in the order of their first request, each once; ``requested``: the row of each request."""

    graph: Graph
    r: SymbolicResult
    nodes: list[Node] = field(default_factory=list)
    places: dict[int, int] = field(default_factory=dict)
    requested: list[int] = field(default_factory=list)
    _placed: dict[tuple[object, ...], list[int]] = field(default_factory=dict, init=False)
    """Rows of the points of links that were requested before."""

    def of(self, x: Numeric) -> int:
        """The row of a number or node."""
        node = x if isinstance(x, Node) else self.graph.constant(x)
        if node.index not in self.places:
            self.places[node.index] = len(self.nodes)
            self.nodes.append(node)
        self.requested.append(self.places[node.index])
        return self.requested[-1]

    def vector(self, v: Iterable[Numeric]) -> list[int]:
        """The rows of a vector's components."""
        return [self.of(x) for x in v]

    def place(self, link: str, u: Iterable[Numeric]) -> list[int]:
        """The rows of a point of a link, given in its axes."""
        components = [*u]
        key = (link, *(("node", x.index) if isinstance(x, Node) else float(x) for x in components))
        if key in self._placed:
            self.requested += self._placed[key]
        elif link == GROUND:
            self._placed[key] = self.vector(components)
        else:
            self._placed[key] = self.vector(self.r._place(link, np.array(components))[0])
        return self._placed[key]

    def axis(self, link: str) -> list[int]:
        """The rows of the unit vector along a link's x axis."""
        return self.vector(self.axis_nodes(link))

    def axis_nodes(self, link: str) -> Sequence[Numeric]:
        """The unit vector along a link's x axis."""
        return self.unit_vectors(link)[0]

    def along(self, link: str, u: Iterable[float]) -> list[int]:
        """The rows of a direction that is fixed in a link, given in its axes."""
        parts = [float(x) * np.array(e) for x, e in zip(u, self.unit_vectors(link), strict=True)]
        return self.vector(sum(parts[1:], parts[0]))

    def axes(self, link: str) -> list[list[int]]:
        """The rows of the unit vectors along a link's axes."""
        return [self.vector(v) for v in self.unit_vectors(link)]

    def unit_vectors(self, link: str) -> list[Sequence[Numeric]]:
        """The unit vectors along a link's axes, ground axes."""
        d = self.r._d
        if link == GROUND:
            return list(np.eye(d).tolist())
        r = self.r.rotation_array[0, self.r.links.index(link)]
        return [(r[0], r[1]), (-r[1], r[0])] if d == 2 else [r[j::3] for j in range(3)]

    def direction(self, joint: str) -> list[int]:
        """The rows of the unit vector along a joint's slide."""
        return self.vector(self.direction_nodes(joint))

    def direction_nodes(self, joint: str) -> tuple[Numeric, Numeric]:
        """The unit vector along a joint's slide, ground axes."""
        j = self.r.mechanism.joints[joint]
        angle: Numeric = trace_array(self.graph, getattr(j, "direction", None) or 0.0)[()]
        cos, sin = angle.cos(), angle.sin()
        c, s = self.axis_nodes(j.links[0])
        return c * cos - s * sin, s * cos + c * sin
