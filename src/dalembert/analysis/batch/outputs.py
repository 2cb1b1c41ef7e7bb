"""What a kernel can be asked for, by name, as nodes of its trace."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from dalembert.algebra.protocol import Algebra
from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.analysis.compile.load_arrays import point_of
from dalembert.analysis.result.link_motion import place_of
from dalembert.arrays import Array, Numeric
from dalembert.errors import ModelError
from dalembert.kernel.graph import Graph, Node, trace_array
from dalembert.kernel.trace import Traced
from dalembert.model.quantities.values import Vector


@dataclass(frozen=True)
class Catalogue:
    """Names to nodes; ``compiled`` is the compiled description on symbols."""

    graph: Graph
    compiled: Compiled
    traced: Traced

    def nodes(self, name: str) -> list[Node]:
        """The components of one output."""
        kind, _, of = name.partition(".")
        if kind not in KINDS or (kind == "residual" and of):
            there = ", ".join(k if k == "residual" else f"{k}.NAME" for k in KINDS)
            raise ModelError(f"there is no output {name!r}", f"there are: {there}")
        return list(trace_array(self.graph, np.ravel(np.asarray(KINDS[kind](self, of), object))))

    def defaults(self) -> list[str]:
        """Every effort, unknown load and reaction."""
        c = self.compiled
        fixed = {c.joints[k] for k in c.layout.constraints.joint[c.layout.constraints.angular]}
        out = [f"effort.{n}" for n in c.schedule.names] + [f"load.{n}" for n in c.unknown_loads]
        return out + [f"reaction.{j}" for j in c.joints] + [f"moment.{j}" for j in c.joints if j in fixed]

    @property
    def algebra(self) -> Algebra:
        """Of the plane, or of space."""
        return self.compiled.layout.algebra

    def drive(self, name: str) -> int:
        return place_of(tuple(self.compiled.schedule.names), name, "drive")

    def joint(self, name: str) -> int:
        return place_of(self.compiled.joints, name, "joint")

    def link(self, name: str) -> int:
        return place_of(self.compiled.links, name, "link")

    def load(self, name: str) -> Numeric:
        return self.traced.load[place_of(self.compiled.unknown_loads, name, "unknown load")]

    def arm(self, link: int, u: ArrayLike) -> Array:
        reference = np.asarray(self.compiled.layout.reference, object)
        rotation = self.traced.pose.rotation[link]
        return self.algebra.rotate(rotation, np.asarray(u, object) - reference[link])

    def center(self, name: str) -> Vector:
        return self.compiled.mechanism.center(name)

    def place(self, name: str, u: ArrayLike) -> Array:
        k = self.link(name)
        origin = np.asarray(self.compiled.layout.reference, object)[-1]
        return np.asarray(self.traced.pose.point[k] + self.arm(k, u) + origin)

    def velocity(self, name: str, u: ArrayLike) -> Array:
        k, g = self.link(name), self.algebra
        twist = self.traced.twist[k]
        return np.asarray(twist[: g.d] + g.spin(twist[g.d :], self.arm(k, u)))

    def acceleration(self, name: str, u: ArrayLike) -> Array:
        (k, g), w = (self.link(name), self.algebra), self.turning("twist", name)
        rate, r = self.traced.acceleration[k], self.arm(k, u)
        return np.asarray(rate[: g.d] + g.spin(rate[g.d :], r) + g.centripetal(w, r))

    def turning(self, rates: str, name: str) -> Array:
        """Angular part of a link's twist or acceleration."""
        turning: Array = getattr(self.traced, rates)[self.link(name), self.algebra.d :]
        return turning

    def angle(self, name: str) -> Numeric:
        if self.algebra.d == 3:
            raise ModelError(f"link {name!r} has no single angle in space", "ask its rotation")
        return self.traced.pose.turn[self.link(name)]

    def rotation(self, name: str) -> Array:
        """A link's matrix, row by row."""
        r = self.traced.pose.rotation[self.link(name)]
        return r if self.algebra.d == 3 else np.array([r[0], -r[1], r[1], r[0]])

    @property
    def origin(self) -> Array:
        """The origin of a link's axes."""
        return np.zeros(self.algebra.d)


def _point(c: Catalogue, of: str) -> tuple[str, Array]:
    link, _, point = of.partition(".")
    c.link(link)
    return link, point_of(c.compiled.mechanism, link, point)


def _magnitude(c: Catalogue, joint: str) -> Node:
    force = c.traced.force[c.joint(joint)]
    total: Node = (force * force).sum().sqrt()
    return total


KINDS: dict[str, Callable[[Catalogue, str], Numeric]] = {
    "effort": lambda c, of: c.traced.effort[c.drive(of)],
    "load": lambda c, of: c.load(of),
    "reaction": lambda c, of: c.traced.force[c.joint(of)],
    "magnitude": _magnitude,
    "moment": lambda c, of: c.traced.moment[c.joint(of)],
    "angle": lambda c, of: c.angle(of),
    "rotation": lambda c, of: c.rotation(of),
    "speed": lambda c, of: c.turning("twist", of),
    "acceleration": lambda c, of: c.turning("acceleration", of),
    "position": lambda c, of: c.place(of, c.origin),
    "velocity": lambda c, of: c.velocity(of, c.origin),
    "center": lambda c, of: c.place(of, c.center(of)),
    "center_velocity": lambda c, of: c.velocity(of, c.center(of)),
    "center_acceleration": lambda c, of: c.acceleration(of, c.center(of)),
    "point": lambda c, of: c.place(*_point(c, of)),
    "point_velocity": lambda c, of: c.velocity(*_point(c, of)),
    "point_acceleration": lambda c, of: c.acceleration(*_point(c, of)),
    "residual": lambda c, of: c.traced.residual,
}
"""Output kind -> its nodes; the part of the name behind the first dot says of what."""
