"""Loads that depend on a link's angle, a joint's freedom or their speeds: known from the motion, which loads follow."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled, setting_of
from dalembert.analysis.compile.load_arrays import load_forces
from dalembert.analysis.compile.table_ends import beyond_ends
from dalembert.arrays import Array, Flags, Tree
from dalembert.core.constraints import measure, rates, system
from dalembert.core.equilibrium import motion
from dalembert.core.layout import Pose
from dalembert.core.position.motion_path import Path
from dalembert.core.rank import singular_below
from dalembert.model.quantities.coordinates import SPEED, TIME, is_speed, parts

__all__ = ["SPEED", "TIME", "coordinates", "counted_coordinates", "parts", "with_pose_loads"]


def coordinates(c: Compiled, pose: Pose, names: Iterable[str], twist: Array | None) -> Tree:
    """The angles, freedoms and speeds named, SI, of the pose's leading shape; numbers or nodes."""
    freedoms = c.layout.freedoms
    measured = measure(c.layout.algebra, freedoms, pose)
    speeds = None if twist is None else rates(system(c.layout.algebra, freedoms, pose), twist)
    out: Tree = {}
    for name in names:
        kind, of, which = parts(name) or ("", "", "")
        if kind == "links":
            turned = pose.turn if not is_speed(name) or twist is None else twist[..., -1]
            out[name] = turned[..., c.links.index(of)][()]
        elif kind:
            values = measured if not is_speed(name) or speeds is None else speeds
            out[name] = values[..., c.freedoms.index((of, which))][()]
    return out


def counted_coordinates(c: Compiled, counted: Compiled, pose: Pose, names: Iterable[str]) -> Tree:
    """The same (P,) with the full turns that were counted along the motion of ``counted``."""
    names, twist = list(names), None
    if any(map(is_speed, names)):
        moving = motion(c.layout, pose, c.schedule.speed, np.zeros_like(c.schedule.speed))[0]
        singular = ~(moving.rcond >= singular_below(c.layout))
        twist = np.where(singular[:, None, None], np.nan, moving.twist)
    result = coordinates(c, pose, names, twist)
    return {name: value + counted.pose_turns.get(name, 0.0) for name, value in result.items()}


def _everywhere(values: Array, reached: Flags) -> Array:
    """Values (P,), another's where a position has none: it has no answer, whatever loads it."""
    known = reached & np.isfinite(values)
    return np.where(known, values, values[np.argmax(known)] if known.any() else 0.0)


def with_pose_loads(c: Compiled, path: Path) -> Compiled:
    """The mechanism with the values of its loads that depend on the pose, along a motion."""
    if not c.pose_names or not path.reached.any():
        return c
    at = counted_coordinates(c, c, path.pose, c.pose_names)
    at = {name: _everywhere(values, path.reached) for name, values in at.items()}
    setting = setting_of(c)
    setting = replace(setting, m=c.mechanism, drives={**setting.drives, **at})
    forces, couples = load_forces(setting)
    beyond = beyond_ends(c.mechanism, setting.drives)
    return replace(c, forcing=replace(c.forcing, forces=forces, couples=couples), beyond=beyond)
