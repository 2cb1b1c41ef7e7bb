"""Wedges, to scale: links that slide on one straight face and carry another link on an inclined one."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.algebra import plane
from dalembert.analysis.methods.applied_forces import link_angle, link_place, slide_direction
from dalembert.analysis.result.kept import kept
from dalembert.arrays import Array
from dalembert.views.paper.frame import PaperFrame
from dalembert.views.paper.scene import Item, Point, Polygon
from dalembert.views.symbols import plane_symbols

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

STEEPEST = 0.87
"""Sine of the largest angle between the faces of a link that is drawn as a wedge."""


def wedge_corners(r: Result, link: str) -> Array | None:
    """Corners (n, 2) of a wedge in its axes, m: the part of its inclined face that the cycle needs, and the
    area from it to the other face; None for any other link. They are computed once for all drawings of a result."""
    corners = _wedges(r)
    if link not in corners:
        corners[link] = _corners(r, link)
    return corners[link]


@kept
def _wedges(r: Result) -> dict[str, Array | None]:
    """Links -> their corners, as far as they have been asked for."""
    return {}


def _corners(r: Result, link: str) -> Array | None:
    m = r.mechanism
    guides = [name for name, joint in m.joints.items() if joint.guides and link in joint.links]
    faces = [name for name in guides if m.joints[name].links[0] == link]
    solved = np.flatnonzero(np.isfinite(r.point_array).all(axis=(1, 2)))
    if len(guides) != 2 or len(faces) != 1 or not solved.size:
        return None
    base = next(name for name in guides if name not in faces)
    back = plane.rotation(-np.asarray(link_angle(r, link)[solved[0]]))
    (p, e), (q, d) = (
        (_point_of_joint(m, name, link), plane.rotate(back, slide_direction(r, name)[solved[0]]))
        for name in (faces[0], base)
    )
    slides = r.freedom(faces[0], "slide")[0]
    ends = np.array([p + s * e for s in (float(np.nanmin(slides)), float(np.nanmax(slides)))])
    along, across = (ends - q) @ d, (ends - q) @ np.array([-d[1], d[0]])
    flat = 1e-9 * r.compiled.layout.length
    if (
        abs(plane.cross(e, d)) > STEEPEST
        or np.ptp(across) <= flat
        or across.min() < -flat < flat < across.max()
    ):
        return None
    feet = q + along[:, None] * d
    corners = [*ends, *feet[::-1]]
    return np.array([c for k, c in enumerate(corners) if np.hypot(*(c - corners[k - 1])) > flat])


def _point_of_joint(m: Any, name: str, link: str) -> Array:
    return np.asarray(m.joint_points(name)[m.joints[name].links.index(link)], float)


def wedge_items(r: Result, link: str, k: int, frame: PaperFrame) -> list[Item]:
    """A wedge at a position; nothing for any other link."""
    corners = wedge_corners(r, link)
    if corners is None:
        return []
    turned = plane.rotate(plane.rotation(np.asarray(link_angle(r, link)[k])), corners)
    return [Polygon(tuple(frame(link_place(r, link, (0.0, 0.0))[k] + u) for u in turned), "link-area")]


def under_wedge(r: Result, name: str, k: int, frame: PaperFrame) -> list[Item]:
    """The ground under a wedge, on the side away from its inclined face."""
    joint = r.mechanism.joints[name]
    corners = wedge_corners(r, joint.links[1])
    assert corners is not None
    turned = plane.rotate(plane.rotation(np.asarray(link_angle(r, joint.links[1])[k])), corners)
    e, at = slide_direction(r, name)[k], link_place(r, joint.links[1], r.mechanism.joint_points(name)[1])[k]
    placed = turned + link_place(r, joint.links[1], (0.0, 0.0))[k] - at
    along, above = placed @ e, float(placed.mean(axis=0) @ np.array([-e[1], e[0]]))
    angle = math.atan2(e[1], e[0]) + (0.0 if above > 0 else math.pi)
    middle = frame(at + float(along.max() + along.min()) / 2 * e)
    return plane_symbols.hatch(middle, angle, frame.length(float(np.ptp(along))) + 8.0)


def block_place(r: Result, name: str, k: int, at: Point) -> Point | None:
    """Middle of a guide's block on paper: on the face of a wedge, not in it; None where the wedge itself slides."""
    i, j = r.mechanism.joints[name].links
    if wedge_corners(r, j) is not None:
        return None
    corners = wedge_corners(r, i)
    if corners is None:
        return at
    e = slide_direction(r, name)[k]
    normal = np.array([-e[1], e[0]])
    inside = plane.rotate(plane.rotation(np.asarray(link_angle(r, i)[k])), corners.mean(axis=0) - corners[0])
    shift = -np.copysign(plane_symbols.BLOCK[1] / 2, inside @ normal) * normal
    return (at[0] + float(shift[0]), at[1] + float(shift[1]))
