"""What a kernel can be asked for, by name, as nodes of its trace."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from dalembert.algebra import plane
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
        arm: Array = plane.rotate(self.traced.pose.rotation[link], np.asarray(u, object) - reference[link])
        return arm

    def center(self, name: str) -> Vector:
        return self.compiled.mechanism.center(name)

    def place(self, name: str, u: ArrayLike) -> Array:
        k = self.link(name)
        origin = np.asarray(self.compiled.layout.reference, object)[-1]
        return np.asarray(self.traced.pose.point[k] + self.arm(k, u) + origin)

    def velocity(self, name: str, u: ArrayLike) -> Array:
        k = self.link(name)
        twist = self.traced.twist[k]
        return np.asarray(twist[:2] + plane.spin(twist[2:], self.arm(k, u)))

    def acceleration(self, name: str, u: ArrayLike) -> Array:
        k = self.link(name)
        rate, r = self.traced.acceleration[k], self.arm(k, u)
        return np.asarray(rate[:2] + plane.spin(rate[2:], r) + plane.centripetal(self.traced.twist[k][2:], r))


ORIGIN = np.zeros(2)


def _point(c: Catalogue, of: str) -> tuple[str, Array]:
    link, _, point = of.partition(".")
    c.link(link)
    return link, point_of(c.compiled.mechanism, link, point)


def _magnitude(c: Catalogue, joint: str) -> Node:
    x, y = c.traced.force[c.joint(joint)]
    total: Node = (x * x + y * y).sqrt()
    return total


KINDS: dict[str, Callable[[Catalogue, str], Numeric]] = {
    "effort": lambda c, of: c.traced.effort[c.drive(of)],
    "load": lambda c, of: c.load(of),
    "reaction": lambda c, of: c.traced.force[c.joint(of)],
    "magnitude": _magnitude,
    "moment": lambda c, of: c.traced.moment[c.joint(of)],
    "angle": lambda c, of: c.traced.pose.turn[c.link(of)],
    "speed": lambda c, of: c.traced.twist[c.link(of), 2],
    "acceleration": lambda c, of: c.traced.acceleration[c.link(of), 2],
    "position": lambda c, of: c.place(of, ORIGIN),
    "velocity": lambda c, of: c.velocity(of, ORIGIN),
    "center": lambda c, of: c.place(of, c.center(of)),
    "center_velocity": lambda c, of: c.velocity(of, c.center(of)),
    "center_acceleration": lambda c, of: c.acceleration(of, c.center(of)),
    "point": lambda c, of: c.place(*_point(c, of)),
    "point_velocity": lambda c, of: c.velocity(*_point(c, of)),
    "point_acceleration": lambda c, of: c.acceleration(*_point(c, of)),
    "residual": lambda c, of: c.traced.residual,
}
"""Output kind -> its nodes; the part of the name behind the first dot says of what."""
