"""Value and rates of joints' freedoms, from the motion of their links."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.arrays import Array, Index
from dalembert.core.constraints import drift, measure, rates, system
from dalembert.core.equilibrium import with_ground
from dalembert.core.layout import Pose
from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def whole_pose(result: Result, part: Index = slice(None)) -> Pose:
    """Poses of the links at some positions, the ground added."""
    turn, rotation = result.turn_array[part], result.rotation_array[part]
    g = result.compiled.layout.algebra
    return Pose(with_ground(result.point_array[part]), *g.with_ground(turn, rotation))


def freedom_motion(result: Result, joint: str, kind: str) -> tuple[Array, Array, Array]:
    """Value, rate and second rate of a joint's freedom, each (P,).

    A free turn is counted as a torsion spring in it counts; without one it starts within half a turn of 0.
    """
    c = result.compiled
    if (joint, kind) not in c.freedoms:
        has = ", ".join(f"{k} of {j}" for j, k in c.freedoms if j == joint) or "no such joint, or none free"
        raise ModelError(f"joint {joint!r} has no freedom {kind!r}", f"there is: {has}")
    row = c.freedoms.index((joint, kind))
    g, freedoms = c.layout.algebra, c.layout.freedoms
    pose = whole_pose(result)
    twist = with_ground(result.twist_array)
    rows = system(g, freedoms, pose)
    second = rates(rows, with_ground(result.acceleration_array)) + drift(g, freedoms, pose, twist)
    value, rate = measure(g, freedoms, pose)[..., row], rates(rows, twist)[..., row]
    own = c.forcing.resistances
    count = next((n for n in c.counts if own.row[n.place] == row), None)
    if count is not None:
        value = value + own.turns[:, count.place]
    elif freedoms.angular[row] and row not in c.layout.driven:
        value = value - 2 * np.pi * np.round(_first(value) / (2 * np.pi))
    return value, rate, second[..., row]


def _first(value: Array) -> float:
    """The first value there is."""
    known = value[np.isfinite(value)]
    return float(known[0]) if known.size else 0.0
