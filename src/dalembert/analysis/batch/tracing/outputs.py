"""Outputs of a kernel, by name, as nodes of its trace."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from dalembert.algebra.protocol import Algebra
from dalembert.analysis.batch.tracing.kernel_inputs import Inputs
from dalembert.analysis.batch.tracing.traced_parameters import symbol_functions
from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.analysis.one_pass import at_schedule
from dalembert.analysis.result.joint_freedoms import freedom_rates
from dalembert.analysis.result.link_motion import LinkMotion, place_of
from dalembert.analysis.result.named_quantities import evaluated, names_of, read
from dalembert.analysis.result.result import Result
from dalembert.analysis.result.transmission_lines import ground_points
from dalembert.arrays import Array, Numeric
from dalembert.errors import ModelError
from dalembert.kernel.graph import Graph, Node, trace_array
from dalembert.kernel.trace import Traced
from dalembert.model import GROUND


class TracedShaking(NamedTuple):
    """Force (d,) and moment on the foundation, as nodes."""

    force: Array
    moment: Numeric


@dataclass(frozen=True)
class Catalogue(LinkMotion):
    """Names to nodes; ``compiled`` is the compiled description on symbols, the links' motion is that of the trace."""

    graph: Graph
    compiled: Compiled
    traced: Traced
    motion: tuple[Array, Array, Array]
    """Positions, speeds and accelerations of the drives, each (D,)."""
    inputs: Inputs
    inertia: bool

    def nodes(self, name: str) -> list[Node]:
        """The components of one output."""
        single = read(self, name)
        if single is not None:
            return list(trace_array(self.graph, np.ravel(single.values)))
        try:
            value, _ = evaluated(self, name, self.names, symbol_functions(self.graph))
        except (TypeError, ZeroDivisionError) as error:
            raise ModelError(
                f"{name!r} cannot be compiled: {error}", "use integer powers other than 0"
            ) from None
        return list(trace_array(self.graph, np.ravel(np.asarray(value, object))))

    @cached_property
    def names(self) -> list[str]:
        """Every output, without components."""
        return names_of(self, compiled=True)

    @cached_property
    def like(self) -> Result:
        """The general analysis of the file's numbers."""
        return at_schedule(self.inputs.course.mechanism, self.inputs.course.schedule, self.inertia)

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
        return (
            out
            + [f"reaction.{j}" for j in c.joints]
            + [f"reaction_moment.{j}" for j in c.joints if j in fixed]
        )

    @property
    def algebra(self) -> Algebra:
        """Algebra in two or three dimensions."""
        return self.compiled.layout.algebra

    def _counted(self, name: str) -> Numeric:
        return self.inputs.pose_turns(name)

    def effort(self, drive: str) -> Numeric:
        return self.traced.effort[place_of(self.drives, drive, "drive")]

    def drive_position(self, drive: str) -> Numeric:
        return self.motion[0][place_of(self.drives, drive, "drive")]

    def drive_speed(self, drive: str) -> Numeric:
        return self.motion[1][place_of(self.drives, drive, "drive")]

    def drive_acceleration(self, drive: str) -> Numeric:
        return self.motion[2][place_of(self.drives, drive, "drive")]

    @property
    def turning_speed(self) -> Node:
        """Speed of the turning plane."""
        speed: Node = self.traced.square[0].sqrt()
        return speed

    def unknown_load(self, name: str) -> Numeric:
        return self.traced.load[place_of(self.unknown_loads, name, "load")]

    def reaction(self, joint: str) -> Array:
        return np.asarray(self.traced.force[place_of(self.joints, joint, "joint")])

    def reaction_moment(self, joint: str) -> Numeric:
        return self.traced.moment[place_of(self.joints, joint, "joint")]

    def freedom(self, joint: str, kind: str) -> tuple[Numeric, ...]:
        """Value and rates of a joint's freedom, turns counted as along the known motion."""
        row, t = self.compiled.freedoms.index((joint, kind)), self.traced
        freedoms = self.compiled.layout.freedoms
        value, rate, second = freedom_rates(self.algebra, freedoms, t.pose, t.twist, t.acceleration)
        return value[row] + self.inputs.whole_turns(self.compiled, row), rate[row], second[row]

    def shaking(self, about: str) -> TracedShaking:
        wrench, d = _shaking(self, about), self.algebra.d
        return TracedShaking(wrench[:d], wrench[d] if len(wrench) == d + 1 else wrench[d:])

    @property
    def residual(self) -> Node:
        return self.traced.residual


def _shaking(c: Catalogue, about: str) -> Array:
    """Force and moment (n,) about a fixed point of the links on everything else, by what acts on them from outside."""
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
    kinds = [
        kind for kind in ("weight", "inertia", "turning", "force", "couple", "asked") if kind in t.sources
    ]
    parts = [(t.sources[kind], inner.get(kind)) for kind in kinds]
    for source, left_out in parts:
        for k, link in enumerate(source.link):
            if link == len(c.links) or (left_out is not None and left_out[k]):
                continue
            w, arm = source.wrench.reshape(-1, g.n)[k], t.pose.point[link] + origin - fixed
            total = total + np.concatenate([w[: g.d], w[g.d :] + g.cross(arm, w[: g.d])])
    return np.asarray(total)
