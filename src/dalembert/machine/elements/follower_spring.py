"""The spring that keeps a follower on its cam.

With the spring's force P + k s against the follower's motion, the normal force is N_0 + c (P + k s) at every position:
a linear programme in P and k. Mechanics: docs/theory.md 2.3.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.algebra import plane
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model.load_types import Couple, ForceLoad

if TYPE_CHECKING:
    from dalembert.machine.elements.cam_design import CamDesign

NAME = "spring of the follower"
SOME = 1e-9
"""Part of the lift below which a place counts as on the base circle."""


def spring_for(c: CamDesign, preload: float | None, least: float) -> tuple[float, float]:
    """Stiffness and preload, SI: `CamDesign.spring_for`."""
    needed, per_unit, lift = _linear(c, least)
    high = float(lift.max())
    if (per_unit <= 0).any():
        raise ModelError(
            "no spring closes the cam: its force does not press the follower on", "turn the follower"
        )
    need = needed / per_unit  # P + k s >= need
    if preload is None:
        return _softest(need, lift, high)
    low = lift <= SOME * high
    if low.any() and need[low].max() > preload * (1 + 1e-12):
        what = f"the preload {preload:.6g} does not close the cam at rest, which needs {need[low].max():.6g}"
        raise ModelError(
            what,
            "raise it, or leave it out",
        )
    stiffness = ((need - preload)[~low] / lift[~low]).max(initial=0.0)
    return max(float(stiffness), 0.0), preload


def _softest(need: Array, lift: Array, high: float) -> tuple[float, float]:
    """The spring with the least greatest force."""
    from scipy.optimize import linprog

    size = max(float(need.max()), 1e-300)
    value = linprog(
        [1.0, 1.0],
        A_ub=np.stack([-np.ones_like(lift), -lift / high], axis=1),
        b_ub=-need / size,
        bounds=(0, None),
    )
    preload, rise = np.asarray(value.x) * size
    return float(rise / high), float(preload)


def _linear(c: CamDesign, least: float) -> tuple[Array, Array, Array]:
    """Force missing to ``least`` without a spring (P,), share of a unit of its force (P,), and its travel (P,)."""
    from dalembert.analysis.methods.cam_contacts import normal_force
    from dalembert.analysis.solution import dynamics

    if c.mechanism.friction.enabled and any(
        getattr(j, "friction", None) for j in c.mechanism.joints.values()
    ):
        raise ModelError(
            "with friction the normal force is not linear in a spring's force",
            "write friction: {enabled: false}, and allow for friction in least",
        )
    on, follower = c.motion.carrier, c._joint.links[1]
    if on.swings:
        load: ForceLoad | Couple = Couple(on=follower, value=-on.sign)
    else:
        inward = -plane.rotate(plane.rotation(np.array(-float(on.turn))), on.way)
        angle = float(np.arctan2(inward[1], inward[0]))
        point = c.mechanism.joints[c.joint].point_names(c.joint)[1]
        load = ForceLoad(on=follower, at=point, value=1.0, direction=angle, axes="link")
    base = c.result.mechanism
    pressed = dynamics(base.model_copy(update={"loads": {**base.loads, NAME: load}}))
    bare = normal_force(c.result, c.joint)
    lift = np.abs(c.lift(c.turns_of(c.result))[0])
    return least - bare, normal_force(pressed, c.joint) - bare, lift
