"""A result of one position whose numbers are nodes of a trace: functions of a result then give formulas."""

from __future__ import annotations

from typing import Any

import numpy as np

from dalembert.analysis.batch.compiled_kernel import Kernel
from dalembert.analysis.methods.applied_forces import (
    Action,
    State,
    effort_actions,
    joint_actions,
    known_actions,
    unknown_load_actions,
)
from dalembert.analysis.result.force_arrays import Friction
from dalembert.analysis.result.result import Result
from dalembert.arrays import Array
from dalembert.core.equilibrium import LinkMotions
from dalembert.core.layout import Pose


class SymbolicResult(Result):
    """Outputs of a kernel as a result: (1, ...) arrays of nodes. Reactions include dry friction."""

    def friction_force(self, joint: str, on: str | None = None) -> Array:
        return np.zeros((1, self._d))

    def friction_moment(self, joint: str, on: str | None = None) -> Array:
        return np.zeros(1 if self._d == 2 else (1, 3))


def symbolic_result(k: Kernel) -> SymbolicResult:
    """The result of a kernel's trace."""
    c, t = k.trace.catalogue.compiled, k.trace.catalogue.traced
    moving = slice(0, len(c.links))
    rub: Any = object()  # only its presence matters
    friction: Friction | None = rub if c.contacts is not None else None
    return SymbolicResult(
        compiled=c,
        inertia=k.trace.inertia,
        mobility=None,
        mode=None,
        status=("ok",),
        reasons=(None,),
        point_array=t.pose.point[None, moving],
        turn_array=t.pose.turn[None, moving] if c.layout.algebra.d == 2 else t.pose.turn[None],
        rotation_array=t.pose.rotation[None, moving],
        twist_array=t.twist[None, moving],
        acceleration_array=t.acceleration[None, moving],
        force_array=t.force[None],
        moment_array=t.moment[None],
        effort_array=t.effort[None],
        load_array=t.load[None],
        residual=np.array([t.residual]),
        power_balance=np.zeros(1),
        friction=friction,
    )


def symbolic_actions(r: SymbolicResult, k: Kernel) -> tuple[Action, ...]:
    """All actions on every link, in nodes, like ``whole_actions`` of a result."""
    t = k.trace.catalogue.traced
    g = r.compiled.layout.algebra
    point = np.concatenate([r.point_array, t.pose.point[None, -1:]], axis=1)
    pose = Pose(point, *g.with_ground(r.turn_array, r.rotation_array))
    nothing: Any = None  # rows and factors are not needed
    moving = LinkMotions(t.twist[None], t.acceleration[None], t.virtual[None], nothing)
    known = known_actions(r, State(pose, moving, nothing, nothing))
    return (*joint_actions(r, split=False), *effort_actions(r), *known, *unknown_load_actions(r))
