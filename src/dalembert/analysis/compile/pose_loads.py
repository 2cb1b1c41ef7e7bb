"""Loads that depend on a link's angle or a joint coordinate; evaluated after the motion, which does not depend on
loads."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled, setting_of
from dalembert.analysis.compile.load_arrays import load_forces
from dalembert.arrays import Array, Tree
from dalembert.core.constraints import measure
from dalembert.core.layout import Pose
from dalembert.core.position.motion_path import Path
from dalembert.model.quantities.coordinates import TIME, parts

__all__ = ["TIME", "coordinates", "counted_coordinates", "with_pose_loads"]


def coordinates(c: Compiled, pose: Pose, names: Iterable[str]) -> Tree:
    """The angles and freedoms named, radians and metres, of the pose's leading shape; numbers or nodes."""
    measured = measure(c.layout.algebra, c.layout.freedoms, pose)
    return dict(_coordinates(c, pose, measured, names))


def counted_coordinates(c: Compiled, counted: Compiled, pose: Pose, names: Iterable[str]) -> Tree:
    """The same (P,) with the full turns that were counted along the motion of ``counted``."""
    return {
        name: value + counted.pose_turns.get(name, 0.0) for name, value in coordinates(c, pose, names).items()
    }


def _coordinates(c: Compiled, pose: Pose, measured: Array, names: Iterable[str]) -> Iterator[tuple[str, Any]]:
    for name in names:
        kind, of, which = parts(name) or ("", "", "")
        if kind == "links":
            yield name, pose.turn[..., c.links.index(of)][()]
        elif kind:
            yield name, measured[..., c.freedoms.index((of, which))][()]


def with_pose_loads(c: Compiled, found: Path) -> Compiled:
    """The mechanism with the values of its loads that depend on the pose, along a motion."""
    if not c.pose_names or not found.reached.any():
        return c
    at = counted_coordinates(c, c, found.pose, c.pose_names)
    known = int(np.argmax(found.reached))  # positions without a pose have no answer, whatever loads them
    at = {name: np.where(found.reached, values, values[known]) for name, values in at.items()}
    setting = setting_of(c)
    setting = replace(setting, m=c.mechanism, drives={**setting.drives, **at})
    forces, couples = load_forces(setting)
    return replace(c, forcing=replace(c.forcing, forces=forces, couples=couples))
