"""Branches of closed forms: which of the two closures of a group of links a pose has."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dalembert.arrays import Array
from dalembert.core.layout import Pose
from dalembert.kernel.graph import Node, Scalar


@dataclass(frozen=True)
class Branch:
    """A group of links with two closures: the input 1 or -1 that chooses, and the value that identifies the branch of a
    known pose: the place of link b, or its turn against link a, on both branches."""

    sign: Node
    plus: tuple[Scalar, ...]
    minus: tuple[Scalar, ...]
    a: int
    b: int

    def lead(self, pose: Pose) -> Node:
        """Above zero where a pose (L+1, ...) in nodes is on the first branch."""
        known = place_on_branch(Pose(*(part[None] for part in pose)), len(self.plus), self.a, self.b)[:, 0]
        off = [
            sum((x - w) * (x - w) for x, w in zip(known, pose, strict=True))
            for pose in (self.minus, self.plus)
        ]
        lead: Node = off[0] - off[1]
        return lead


def place_on_branch(pose: Pose, components: int, a: int, b: int) -> Array:
    """Value compared along a motion (component, P): the turn of link b against a (2), b's point (3) or its rotation."""
    r = pose.rotation
    if components == 2:
        cos = r[:, a, 0] * r[:, b, 0] + r[:, a, 1] * r[:, b, 1]
        sin = r[:, a, 0] * r[:, b, 1] - r[:, a, 1] * r[:, b, 0]
        return np.stack([cos, sin])
    return np.asarray((pose.point if components == 3 else r)[:, b].T)
