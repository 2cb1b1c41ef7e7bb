"""What a kernel can be asked for, by name, as nodes of its trace."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from dalembert.algebra import plane
from dalembert.algebra.protocol import Algebra
from dalembert.analysis.batch.tracing.traced_parameters import symbol_functions
from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.analysis.result.link_motion import LinkMotion, place_of
from dalembert.analysis.result.named_quantities import bearing_areas, kind_of_name, names_of
from dalembert.analysis.result.quantity_expressions import check_units, parse_quantity
from dalembert.analysis.result.transmission_lines import (
    OfLines,
    closure_margin,
    ground_points,
    transmission_angle,
    transmission_lines,
)
from dalembert.arrays import Array, Numeric
from dalembert.errors import ModelError
from dalembert.kernel.graph import Graph, Node, trace_array
from dalembert.kernel.trace import Traced
from dalembert.model import GROUND
from dalembert.model.quantities.expressions import evaluate, names_in
from dalembert.wording import closest


@dataclass(frozen=True)
class Catalogue(LinkMotion):
    """Names to nodes; ``compiled`` is the compiled description on symbols, the links' motion is that of the trace."""

    graph: Graph
    compiled: Compiled
    traced: Traced
    speeds: Array
    """Of the drives (D,)."""

    def nodes(self, name: str) -> list[Node]:
        """The components of one output."""
        if name in self.names:
            return self._named(name)
        tree = parse_quantity(name, self.names)
        parts = {n: self._scalar(n) for n in names_in(tree)}
        whole = {n: n if n in self.names else n.rpartition(".")[0] for n in parts}
        check_units(tree, lambda n: kind_of_name(self, whole[n]))
        try:
            with np.errstate(all="ignore"):
                value = evaluate(tree, parts, symbol_functions(self.graph))
        except (TypeError, ZeroDivisionError) as error:
            raise ModelError(
                f"{name!r} cannot be compiled: {error}", "use powers of whole numbers other than 0"
            ) from None
        return list(trace_array(self.graph, np.ravel(np.asarray(value, object))))

    def _named(self, name: str) -> list[Node]:
        """Of a name without a component."""
        kind, _, of = name.partition(".")
        return list(trace_array(self.graph, np.ravel(np.asarray(KINDS[kind](self, of), object))))

    def _scalar(self, name: str) -> Node:
        """A number, or a component of a vector."""
        whole, _, part = name.rpartition(".")
        vector = self._named(name if name in self.names else whole)
        if name in self.names and len(vector) == 1:
            return vector[0]
        size = len(vector) if len(vector) in (2, 3) else 0
        there = {**dict(zip("xyz"[:size], vector, strict=False))}
        if size:
            there["magnitude"] = sum((x * x for x in vector), self.graph.zero).sqrt()
        if name in self.names:
            raise ModelError(
                f"{name} is a vector, and an expression is of numbers", f"write {name}.x or {name}.magnitude"
            )
        if part not in there:
            raise ModelError(f"{whole} has no component {part!r}", closest(part, list(there)))
        return there[part]

    @cached_property
    def names(self) -> list[str]:
        """Every output there is, without components."""
        return names_of(
            self, [word for word in KINDS if self.algebra.d == 2 or word not in ("angle", "pressure")]
        )

    @property
    def point_array(self) -> Array:  # type: ignore[override]
        return self.traced.pose.point

    @property
    def turn_array(self) -> Array:  # type: ignore[override]
        return self.traced.pose.turn

    @property
    def rotation_array(self) -> Array:  # type: ignore[override]
        return self.traced.pose.rotation

    @property
    def twist_array(self) -> Array:  # type: ignore[override]
        return self.traced.twist

    @property
    def acceleration_array(self) -> Array:  # type: ignore[override]
        return self.traced.acceleration

    @property
    def joints(self) -> tuple[str, ...]:
        return self.compiled.joints

    @property
    def drives(self) -> tuple[str, ...]:
        return tuple(self.compiled.schedule.names)

    @property
    def unknown_loads(self) -> tuple[str, ...]:
        return self.compiled.unknown_loads

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

    def load(self, name: str) -> Numeric:
        return self.traced.load[place_of(self.compiled.unknown_loads, name, "unknown load")]


def _magnitude(c: Catalogue, joint: str) -> Node:
    force = c.traced.force[c.joint(joint)]
    total: Node = (force * force).sum().sqrt()
    return total


def _hinge(c: Catalogue, of: str, value: OfLines) -> Numeric:
    """What is made of the two lines of a hinge."""
    turned_lines, lines = [], transmission_lines(c.mechanism, of)
    for line in lines:
        along = np.asarray(line.along, object)
        turned = (
            along
            if line.link == GROUND
            else plane.rotate(c.traced.pose.rotation[place_of(c.links, line.link, "link")], along)
        )
        turned_lines.append(trace_array(c.graph, turned))
    return value(turned_lines[0], turned_lines[1], lines)


def _shaking(c: Catalogue, about: str) -> Array:
    """Force and moment (n,) about a fixed point that the links exert on all else: what acts on them from outside."""
    m, t, g = c.mechanism, c.traced, c.algebra
    outside = [name for name, drive in m.drives.items() if drive.by == "outside"]
    if outside:
        raise ModelError(
            f"the shaking force with drive {outside[0]!r} by: outside is not compiled", "use da.shaking"
        )
    points = ground_points(m)
    joints = [n for n in points if n in c.joints]
    fixed = points[about or joints[0]] if about or joints else np.zeros(g.d)
    names = {"force": m.loads_on("point"), "couple": m.loads_on("link")}
    inner = {
        k: [load.by == GROUND for load in some.values() if not load.unknown] for k, some in names.items()
    }
    total, origin = trace_array(c.graph, np.zeros(g.n)), np.asarray(c.compiled.layout.reference, object)[-1]
    inner["asked"] = [getattr(m.loads[n], "by", None) == GROUND for n in c.unknown_loads]
    kinds = [kind for kind in ("weight", "inertia", "force", "couple", "asked") if kind in t.sources]
    parts = [(t.sources[kind], inner.get(kind)) for kind in kinds]
    for source, left_out in parts:
        for k, link in enumerate(source.link):
            if link == len(c.links) or (left_out is not None and left_out[k]):
                continue
            w, arm = source.wrench.reshape(-1, g.n)[k], t.pose.point[link] + origin - fixed
            total = total + np.concatenate([w[: g.d], w[g.d :] + g.cross(arm, w[: g.d])])
    return np.asarray(total)


MOTION = (
    *("angle", "rotation", "speed", "acceleration", "position", "velocity"),
    *("center", "center_velocity", "center_acceleration", "point", "point_velocity", "point_acceleration"),
)
"""Of a link or of its point: the methods of `LinkMotion`."""


def _motion(c: Catalogue, of: str, kind: str) -> Numeric:
    found: Numeric = getattr(c, kind)(*of.split(".", 1))
    return found


KINDS: dict[str, Callable[[Catalogue, str], Numeric]] = {
    "effort": lambda c, of: c.traced.effort[c.drive(of)],
    "load": lambda c, of: c.load(of),
    "reaction": lambda c, of: c.traced.force[c.joint(of)],
    "magnitude": _magnitude,
    "power": lambda c, of: c.traced.effort[c.drive(of)] * c.speeds[c.drive(of)],
    "transmission": partial(_hinge, value=transmission_angle),
    "closure": partial(_hinge, value=closure_margin),
    "pressure": lambda c, of: _magnitude(c, of) / bearing_areas(c)[of],
    "shaking": lambda c, of: _shaking(c, of)[: c.algebra.d],
    "shaking_moment": lambda c, of: _shaking(c, of)[c.algebra.d :],
    "moment": lambda c, of: c.traced.moment[c.joint(of)],
    **{kind: partial(_motion, kind=kind) for kind in MOTION},
    "residual": lambda c, of: c.traced.residual,
}
"""Output kind -> its nodes; the part of the name behind the first dot says of what."""
