"""Contacts of cams in a result: normal force, place on the face, pressure angle.

Mechanics: docs/theory.md 2.3.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.algebra import plane
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.arrays import Array
from dalembert.core.elements import cam_rows
from dalembert.core.elements.cam_family import CamRow
from dalembert.core.layout import Pose

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


class CamContact(NamedTuple):
    """At every position (P,): the normal (P, 2) from cam to follower, the place of contact along a flat face from its
    point, and the pressure angle, NaN where no link carries both cam and follower."""

    normal: Array
    place: Array
    pressure_angle: Array


def is_cam(r: Result, joint: str) -> bool:
    """True if a joint is a cam."""
    return any(isinstance(f, CamRow) for f, _ in _rows(r, joint))


def _rows(r: Result, joint: str) -> list[tuple[object, int]]:
    rows, k = r.compiled.layout.constraints, r.joints.index(joint)
    return [(f, n) for f in rows.families for n, row in enumerate(np.ravel(f.row)) if rows.joint[row] == k]


def cam_contact(r: Result, joint: str) -> CamContact:
    """The contact of a cam along a result."""
    from dalembert.analysis.compile.elements.cam_motion import cam_motion
    from dalembert.errors import ModelError

    family, n = next((f, k) for f, k in _rows(r, joint) if isinstance(f, CamRow))
    pose, g = full_pose(r), r.compiled.layout.algebra
    normal = cam_rows.normal(g, family, pose)[:, n]
    place = cam_rows.contact_place(g, family, pose)[:, n]
    try:
        motion = cam_motion(r.mechanism, joint)
    except ModelError:
        return CamContact(normal, place, np.full(len(place), np.nan))
    on = motion.carrier
    turn = _turn(r, pose, on.link)
    way = plane.rotate(plane.rotation(turn), on.way)
    if on.swings:
        j = int(family.j[n])
        at = (
            pose.point[:, j]
            + plane.rotate(pose.rotation[:, j], family.uj[n])
            - place[:, None] * plane.across(normal)
        )
        guide = r.mechanism.joints[on.freedom]
        point = np.array(r.mechanism.joint_points(on.freedom)[guide.links.index(on.link)])
        axis = (
            point if on.link == "ground" else r.position(on.link) + plane.rotate(plane.rotation(turn), point)
        )
        way = on.sign * plane.across(at + r.compiled.origin - axis)
    angle = np.arctan2(plane.cross(way, normal)[:, 0], (way * normal).sum(axis=-1))
    return CamContact(normal, place, motion.sense * angle)


def _turn(r: Result, pose: Pose, link: str) -> Array:
    return np.zeros(len(pose.point)) if link == "ground" else np.asarray(r.angle(link))


def normal_force(r: Result, joint: str) -> Array:
    """Force (P,) of a cam on its follower along the normal, N, > 0 where it pushes."""
    force = r.force_array[:, r.joints.index(joint)]
    return np.asarray((force * cam_contact(r, joint).normal).sum(axis=-1))
