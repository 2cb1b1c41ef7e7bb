"""Value and rates of joints' freedoms, from the motion of their links."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.algebra.protocol import Algebra
from dalembert.arrays import Array, Index
from dalembert.core.constraints import drift, measure, rates, system
from dalembert.core.equilibrium import with_ground
from dalembert.core.layout import Pose, Rows
from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def full_pose(result: Result, part: Index = slice(None)) -> Pose:
    """Poses of the links at some positions, the ground added."""
    turn, rotation = result.turn_array[part], result.rotation_array[part]
    g = result.compiled.layout.algebra
    return Pose(with_ground(result.point_array[part]), *g.with_ground(turn, rotation))


def freedom_motion(result: Result, joint: str, kind: str) -> tuple[Array, Array, Array]:
    """Value, rate and second rate of a joint's freedom, each (P,).

    A free turn is counted as a torsion spring in it, or a load that depends on it, counts; without one it starts
    within half a turn of 0.
    """
    c = result.compiled
    if (joint, kind) not in c.freedoms:
        has = ", ".join(f"{k} of {j}" for j, k in c.freedoms if j == joint) or "no such joint, or none free"
        raise ModelError(f"joint {joint!r} has no freedom {kind!r}", f"there is: {has}")
    row = c.freedoms.index((joint, kind))
    g, freedoms = c.layout.algebra, c.layout.freedoms
    twist, acceleration = with_ground(result.twist_array), with_ground(result.acceleration_array)
    value, rate, second = (
        v[..., row] for v in freedom_rates(g, freedoms, full_pose(result), twist, acceleration)
    )
    resistances = c.forcing.resistances
    count = next((n for n in c.counts if resistances.row[n.place] == row), None)
    if count is not None:
        value = value + resistances.turns[:, count.place]
    elif (name := f"joints.{joint}.{kind}") in c.pose_turns:
        value = value + c.pose_turns[name]
    elif freedoms.angular[row] and row not in c.layout.driven:
        value = value + turns_off(value)
    return value, rate, second


def freedom_rates(
    g: Algebra, freedoms: Rows, pose: Pose, twist: Array, acceleration: Array
) -> tuple[Array, Array, Array]:
    """Values, rates and second rates of all freedoms, on numbers or on nodes; the ground is the last link."""
    rows = system(g, freedoms, pose)
    second = rates(rows, acceleration) + drift(g, freedoms, pose, twist)
    return measure(g, freedoms, pose), rates(rows, twist), second


def turns_off(value: Array) -> float:
    """Whole turns, in radians, to add to a turn (P,) so that its first known value is within half a turn of 0."""
    known = value[np.isfinite(value)]
    return float(-2 * np.pi * np.round(known[0] / (2 * np.pi))) if known.size else 0.0
