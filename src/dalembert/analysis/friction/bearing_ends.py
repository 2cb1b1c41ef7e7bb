"""Bearings and guides in space with friction: what each end carries across its axis, and its friction.

Mechanics: docs/theory.md 6.1.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.friction.joint_friction import contacts_of, friction_of
from dalembert.analysis.result.reaction_axes import axes_of
from dalembert.arrays import Array
from dalembert.model.joints.pairs import AXES

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


@dataclass(frozen=True)
class BearingEnd:
    """An end of a bearing or guide, or the complete one if its lengths are not given, over P positions.

    part: `behind` or `ahead` of j's point along the axis, or empty; along: distance from that point, m
    force (P, 3): across the axis, on j, ground axes; friction (P,): couple about the axis or force along it, on j
    """

    part: str
    along: float
    force: Array
    friction: Array


def bearing_axis(r: Result, joint: str) -> Array:
    """Unit vector (P, 3) of the axis of a revolute, prismatic or cylindrical joint, ground axes."""
    return np.asarray(axes_of(r, joint, "joint")[:, AXES.index(r.mechanism.joints[joint].pair.main)])


def bearing_ends(r: Result, joint: str, kind: str) -> list[BearingEnd]:
    """Ends of a joint in space, behind first: of its journal (``pin``) or of its guide; none where it is neither.

    The forces on both ends together are the reaction across the axis, their moments the bending moment.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> tree = da.load(examples()["rssr"]).to_tree()
    >>> tree["joints"]["O"]["friction"] = {"coefficient": 0.1, "radius": "8 mm"}
    >>> r = da.statics(da.mechanism(tree))
    >>> [(end.part, end.force.shape) for end in bearing_ends(r, "O", "pin")]
    [('', (36, 3))]
    """
    described = r.mechanism.joints[joint]
    if r.friction is None or "guide" not in described.pair.friction:
        return []
    f, _ = friction_of(r)
    axes, first = axes_of(r, joint, "joint"), AXES.index(described.pair.main) + 1
    u, v = axes[:, first % 3], axes[:, (first + 1) % 3]
    guide = getattr(getattr(described, "friction", None), "guide", None)
    places = [("", 0.0)] if guide is None else [("behind", -guide[0]), ("ahead", guide[1])]
    return [
        BearingEnd(part, along, f.argument[:, 0, e, None] * u + f.argument[:, 1, e, None] * v, f.cz[:, e])
        for (part, along), e in zip(places, contacts_of(r, joint, kind), strict=False)
    ]


@dataclass(frozen=True)
class Thread:
    """The thread of a screw at its mean radius, over P positions.

    climb: lead angle, negative of a left-hand thread; normal (P,): force across the helix on j, positive with a part
    along the axis; friction (P,): along the helix on j, positive with a part along the axis; across (P,): force across
    the axis, which rubs too
    """

    climb: float
    normal: Array
    friction: Array
    across: Array


def thread(r: Result, joint: str) -> Thread:
    """Forces on the thread of a screw with friction: friction over normal force is the tangent of its angle.

    The normal force is its part in the plane of axis and turn: for a thread with inclined flanks less than the total.
    """
    screw: Any = r.mechanism.joints[joint]
    f, contacts = friction_of(r)
    mine = contacts_of(r, joint)
    climb = math.atan2(screw.lead / (2 * math.pi), screw.friction.radius)
    by_kind = {contacts.kind[e]: e for e in mine}
    normal = f.argument[:, 0, by_kind["thread"]] * math.cos(screw.friction.thread_angle or 0.0)
    across = np.hypot(f.argument[:, 0, by_kind["pin"]], f.argument[:, 1, by_kind["pin"]])
    return Thread(climb, normal, f.cz[:, mine].sum(axis=-1) / abs(math.sin(climb)), across)
