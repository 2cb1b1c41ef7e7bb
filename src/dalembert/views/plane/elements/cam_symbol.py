"""A cam and what touches it, to scale, in a drawing of its mechanism."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.algebra import plane
from dalembert.analysis.compile.elements.cam_motion import outline
from dalembert.analysis.methods.applied_forces import joint_place, link_angle, link_place
from dalembert.analysis.methods.cam_contacts import cam_contact
from dalembert.views.paper.frame import PaperFrame
from dalembert.views.paper.scene import Circle, Item, Point, Polygon

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

FACE = 9.0
"""Least half length of a flat face on paper, mm."""
KNIFE = 3.2
"""Height of a knife edge on paper, mm."""


def cam_items(r: Result, name: str, k: int, frame: PaperFrame) -> list[Item]:
    """The outline of the cam, and the roller, the face or the edge of its follower."""
    joint: Any = r.mechanism.joints[name]
    center = link_place(r, joint.links[0], r.mechanism.joint_points(name)[0])[k]
    turned = plane.rotate(
        plane.rotation(np.array(float(link_angle(r, joint.links[0])[k]))), outline(r.mechanism, name)
    )
    shape = Polygon(tuple(frame(center + u) for u in turned), "link-area")
    return [shape, *follower_items(r, name, k, frame)]


def follower_items(r: Result, name: str, k: int, frame: PaperFrame) -> list[Item]:
    """The roller, the face or the edge of a follower."""
    joint: Any = r.mechanism.joints[name]
    at, contact = joint_place(r, name)[k], cam_contact(r, name)
    normal, place = contact.normal[k], float(np.nanmax(np.abs(contact.place)))
    return touching_items(joint, frame(at), (float(normal[0]), float(normal[1])), frame, place)


def resting_follower(r: Result, name: str, frame: PaperFrame) -> list[Item]:
    """The same about its point, in the axes of its link."""
    joint: Any = r.mechanism.joints[name]
    contact, turn = cam_contact(r, name), link_angle(r, joint.links[1])
    known = np.flatnonzero(np.isfinite(contact.normal).all(axis=1))
    k = int(known[0]) if known.size else 0
    normal = plane.rotate(plane.rotation(-np.asarray(turn[k])), contact.normal[k])
    reach = float(np.abs(contact.place[known]).max(initial=0.0))
    return touching_items(joint, (0.0, 0.0), (float(normal[0]), float(normal[1])), frame, reach)


def touching_items(joint: Any, at: Point, normal: Point, frame: PaperFrame, reach: float) -> list[Item]:
    """Follower at its point of a cam on paper, with the normal away from the cam."""
    nx, ny = normal
    if joint.follower.kind == "roller":
        return [Circle(at, frame.length(joint.follower.roller), "block"), Circle(at, 0.7, "pin")]
    if joint.flat:
        half = max(frame.length(reach) + 2.0, FACE)
        ends = [(at[0] + s * half * ny, at[1] - s * half * nx) for s in (1, -1)]
        back = [(x + 1.6 * nx, y + 1.6 * ny) for x, y in ends]
        return [Polygon((*ends, back[1], back[0]), "block")]
    return [
        Polygon(
            tuple(
                (at[0] + KNIFE * (nx + s * 0.4 * ny), at[1] + KNIFE * (ny - s * 0.4 * nx)) if s else at
                for s in (0, 1, -1)
            ),
            "block",
        )
    ]


def cam_reach(r: Result, name: str) -> float:
    """Largest radius of a cam, m."""
    return float(np.hypot(*outline(r.mechanism, name).T).max())
