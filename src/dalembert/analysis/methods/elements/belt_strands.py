"""Pulls of belts and ropes on their wheels, where each strand touches them: what a free body shows.

Mechanics: docs/theory.md 5.7.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.methods.applied_forces import Action, link_place
from dalembert.arrays import Array, Numeric
from dalembert.core.branchless import larger, root

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def pulls_of(r: Result, known: Result, a: Action) -> tuple[Action, ...]:
    """A joint's action, or what it consists of: the pulls of a belt's two strands, that of a rope's strand at its
    place. ``known``: the result in numbers, by which strands are named."""
    joint: Any = known.mechanism.joints[a.of]
    if not joint.WRAPPED or getattr(joint, "direction", None) is not None:
        return (a,)  # another joint, or a strand that is drawn parallel to others
    return _belt_pulls(r, known, a) if hasattr(joint, "stated_tension") else (_rope_pull(r, a),)


def wheel_place(r: Result, joint: str, link: str) -> Array:
    """The centre of a belt's or a rope's wheel on one of its links (P, 2)."""
    end = r.mechanism.joints[joint].links.index(link)
    return link_place(r, link, r.mechanism.joint_points(joint)[end])


def left_of_tangent(line: Array, difference: Numeric) -> Array:
    """Unit normal (..., 2), on its left, of the line that touches two circles; ``line``: from centre to centre,
    ``difference``: of their radii, each positive where its circle is on the right. Numbers or nodes."""
    x, y = line[..., 0], line[..., 1]
    square = x * x + y * y
    along = root(np.asarray(square - difference * difference))
    return np.asarray(
        np.stack([difference * x - along * y, along * x + difference * y], axis=-1) / square[..., None]
    )


def _rope_pull(r: Result, a: Action) -> Action:
    """The pull of a strand where it touches a wheel or ends at a point: a force without a couple."""
    joint: Any = r.mechanism.joints[a.of]
    end = joint.links.index(a.link)
    size = larger(root(np.asarray((a.force * a.force).sum(axis=-1))), 1e-300)
    left = np.stack([-a.force[..., 1] / size, a.force[..., 0] / size], axis=-1)
    arm = (1.0, -1.0)[end] * joint.radii[end]
    return replace(a, at=wheel_place(r, a.of, a.link) + arm * left, couple=0 * a.couple)


def _belt_pulls(r: Result, known: Result, a: Action) -> tuple[Action, ...]:
    """The pulls of both strands where they touch the wheel, whose sum is the action. A pull is the tension without the
    centrifugal part, which the belt takes itself."""
    belt: Any = r.mechanism.joints[a.of]
    pi, pj = (wheel_place(r, a.of, link) for link in belt.links)
    end, line = belt.links.index(a.link), pj - pi
    center, sense, radius = (pi, pj)[end], (1.0, -1.0)[end], belt.signed_radii[end]
    between = sum(belt.signed_radii)
    along = root(np.asarray((line * line).sum(axis=-1) - between * between))
    total = sense * (a.force * line).sum(axis=-1) / along
    difference = -a.moment(center) / radius
    out = []
    for side, part in zip((1.0, -1.0), _names(known, a.of), strict=True):
        left = left_of_tangent(line, side * between)
        pull = (sense * (total + side * difference) / 2)[..., None]
        force = pull * np.stack([left[..., 1], -left[..., 0]], axis=-1)
        at = center + side * sense * radius * left
        out.append(replace(a, at=at, force=force, couple=0 * a.couple, part=part))
    return tuple(out)


def _names(r: Result, joint: str) -> tuple[str, str]:
    """Names of the strand on the left of the line from i to j, and of that on its right."""
    belt: Any = r.mechanism.joints[joint]
    difference = -r.moment_array[:, r.joints.index(joint)].ravel() / belt.signed_radii[1]
    size = 1e-9 * float(np.abs(np.nan_to_num(difference)).max(initial=0.0))
    left, right = (difference > size).any(), (difference < -size).any()
    if left and right:
        return "left", "right"
    return ("tight", "slack") if left else ("slack", "tight")
