"""Links as shapes on paper, at one position."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.compile.load_arrays import point_of
from dalembert.analysis.methods.applied_forces import joint_place, link_place
from dalembert.arrays import Array, Tree
from dalembert.model import GROUND
from dalembert.model.joints.plane_joints import Joint
from dalembert.views.paper.frame import PaperFrame
from dalembert.views.paper.scene import Item, Line, Point, Polygon
from dalembert.views.plane.elements.cam_symbol import cam_reach
from dalembert.views.plane.elements.turning_axis import ball, is_ball
from dalembert.views.plane.elements.wedge_drawing import wedge_corners, wedge_items

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism


MASS_CENTER = "mass center"
"""Name of a mass centre that a link's shape connects."""


def link_paths(r: Result, link: str) -> dict[str, Array]:
    """Places (P, 2) in metres that a link's shape connects: joints, points that carry loads, masses that swing
    in a turning plane."""
    m = r.mechanism
    joints = {name: joint for name, joint in m.joints.items() if link in joint.links}
    places: dict[str, Array] = {}
    for name, joint in joints.items():
        for end, u in zip(joint.links, m.joint_points(name), strict=True):
            if end == link and not _slides_on(joint, end):
                places.setdefault(name, link_place(r, link, u))
    for name, joint in joints.items():
        if joint.apart and not joint.outlined and joint.links[0] == link != GROUND:
            places[f"{name} sliding"] = link_place(r, joint.links[1], m.joint_points(name)[1])
    for name, at in load_places(m, link).items():
        places.setdefault(name, link_place(r, link, at))
    if m.turning is not None and m.mass(link):  # a governor's ball is a part of its arm
        places[MASS_CENTER] = r.center(link)
    return places


def link_points(r: Result, link: str, k: int) -> dict[str, tuple[float, float]]:
    """The same at one position."""
    return {name: (float(path[k, 0]), float(path[k, 1])) for name, path in link_paths(r, link).items()}


def _slides_on(joint: Joint, link: str) -> bool:
    """True if another link slides along this one, so that its point is not at the other link."""
    return joint.apart and joint.links[0] == link and link == GROUND


def load_places(m: Mechanism, link: str) -> Tree:
    """Points of a link, in its axes, where loads act on it: by the name of the point, else by that of the load."""
    out: Tree = {}
    for name, load in m.loads.items():
        if load.ON == "point" and load.on == link:
            spot = load.at if isinstance(load.at, str) and load.at in m.points(link) else name
            out.setdefault(spot, point_of(m, link, load.at))
        for end, point in load.between if load.ON == "span" else ():
            if end == link:
                out.setdefault(point, m.point(end, point))
    return out


def every_path(r: Result) -> Array:
    """Positions of all places of the mechanism (N, P, 2), metres."""
    out = [path for link in (*r.links, GROUND) for path in link_paths(r, link).values()]
    out += [joint_place(r, joint) for joint in r.joints]
    out += [r.center(link) for link in r.links if r.mechanism.mass(link)]
    for link in r.links:
        corners = wedge_corners(r, link)
        out += [link_place(r, link, u) for u in corners] if corners is not None else []
    for name, joint in r.mechanism.joints.items():
        for _, center, radius in wheel_paths(r, name, joint):
            out += [center + radius, center - radius]
        if joint.outlined or joint.BRAKES:
            center, reach = (
                link_place(r, joint.links[0], r.mechanism.joint_points(name)[0]),
                cam_reach(r, name) if joint.outlined else float(joint.reach),
            )
            out += [center + reach, center - reach]
    return np.array(out).reshape(-1, len(r.status), 2)


def wheel_paths(r: Result, name: str, joint: Any) -> list[tuple[str, Array, float]]:
    if not joint.wheels:
        return []
    both = zip(joint.links, r.mechanism.joint_points(name), joint.pitch_radii, strict=True)
    return [(link, link_place(r, link, u), float(radius)) for link, u, radius in both if radius]


def wheels(r: Result, name: str, joint: Any, k: int) -> list[tuple[str, tuple[float, float], float]]:
    """Pitch circles of wheels in contact: link, centre and radius in metres."""
    paths = wheel_paths(r, name, joint)
    return [(link, (float(path[k, 0]), float(path[k, 1])), radius) for link, path, radius in paths]


def link_shape(r: Result, link: str, k: int, frame: PaperFrame) -> list[Item]:
    """A bar, or an area with its outline for more than two points, or a wedge; the block of a slider is a symbol. An
    arm of a governor has its ball."""
    if wedge := wedge_items(r, link, k, frame):
        return wedge
    return [*_bar(r, link, k, frame), *(ball(frame(r.center(link)[k])) if is_ball(r.mechanism, link) else [])]


def _bar(r: Result, link: str, k: int, frame: PaperFrame) -> list[Item]:
    places = list(dict.fromkeys(_round(frame(p)) for p in link_points(r, link, k).values()))
    if len(places) == 1 and r.mechanism.mass(link):
        center = frame(r.center(link)[k])
        return [Line((places[0], center), "link")] if math.dist(places[0], center) > 0.5 else []
    hull = convex(places)
    if len(hull) >= 3:
        return [Polygon(tuple(hull), "link-area")]
    return [Line(tuple(hull), "link")] if len(hull) == 2 else []


def _round(p: Point) -> Point:
    return (round(p[0], 3), round(p[1], 3))


def convex(points: list[Point]) -> list[Point]:
    """Convex hull, counter-clockwise; collinear points left out."""
    ordered = sorted(set(points))
    if len(ordered) < 3:
        return ordered

    def half(some: list[Point]) -> list[Point]:
        out: list[Point] = []
        for p in some:
            while len(out) > 1 and _turn(out[-2], out[-1], p) <= 1e-2:
                out.pop()
            out.append(p)
        return out

    lower, upper = half(ordered), half(ordered[::-1])
    return lower[:-1] + upper[:-1]


def _turn(a: Point, b: Point, c: Point) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def rail(r: Result, name: str, k: int, frame: PaperFrame) -> list[Item]:
    """The rail of a block on a moving link, from that link's point to the block."""
    joint = r.mechanism.joints[name]
    if not joint.guides or joint.links[0] == GROUND:
        return []
    ends = [
        frame(link_place(r, link, u)[k])
        for link, u in zip(joint.links, r.mechanism.joint_points(name), strict=True)
    ]
    return [Line(tuple(ends), "link")] if math.dist(*ends) > 0.5 else []


def unbroken(path: Array) -> list[Array]:
    """Runs of a point's places (P, d) without gaps, the end joined to the beginning where they are near.

    >>> [len(run) for run in unbroken(np.array([[0.0, 0], [1, 0], [np.nan, 0], [1, 1], [0, 1], [0, 0.1]]))]
    [2, 4]
    """
    known = np.asarray(np.isfinite(path).all(axis=1))
    where = np.flatnonzero(known)
    span = float(np.ptp(path[where], axis=0).max()) if where.size else 0.0
    if span <= 1e-9:
        return []
    runs = np.split(path[where], np.flatnonzero(np.diff(where) > 1) + 1)
    if known[0] and known[-1] and float(np.linalg.norm(path[0] - path[-1])) < 0.2 * span:
        runs[-1] = np.concatenate([runs[-1], path[:1]])
    return [run for run in runs if len(run) > 1]
