"""Links as shapes and joints as symbols on paper, at one position."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.methods.applied_forces import joint_place, link_angle, link_place, slide_direction
from dalembert.arrays import Array
from dalembert.model import GROUND
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import Frame
from dalembert.views.paper.scene import Item, Line, Point, Polygon
from dalembert.views.symbols import plane_symbols

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def link_points(r: Result, link: str, k: int) -> dict[str, tuple[float, float]]:
    """Places in metres of what a link's shape spans: joints, then points that carry loads."""
    m = r.mechanism
    places: dict[str, Any] = {}
    for name, joint in m.joints.items():
        for end, u in zip(joint.links, m.joint_points(name), strict=True):
            if end == link and not _slides_on(joint, end):
                places.setdefault(name, link_place(r, link, u)[k])
    for name, joint in m.joints.items():
        if joint.type in ("slider", "slot") and joint.links[0] == link != GROUND:
            places[f"{name} sliding"] = link_place(r, joint.links[1], m.joint_points(name)[1])[k]
    for name, load in m.loads.items():
        if load.type == "force" and load.on == link:
            places.setdefault(name, link_place(r, link, _spot(r, load))[k])
        if load.type in ("spring", "damper"):
            for end, u in m.load_points(name):
                if end == link:
                    places.setdefault(f"{name} {end}", link_place(r, link, u)[k])
    return {name: (float(p[0]), float(p[1])) for name, p in places.items()}


def _slides_on(joint: Any, link: str) -> bool:
    """Whether the link is the rail of a slider or slot: its point is not where the other link is."""
    return joint.type in ("slider", "slot") and joint.links[0] == link and link == GROUND


def _spot(r: Result, load: Any) -> Any:
    from dalembert.analysis.compile.load_arrays import point_of

    return point_of(r.mechanism, load.on, load.at)


def every_place(r: Result, k: int) -> list[tuple[float, float]]:
    """All places of the mechanism at a position, metres."""
    out = [p for link in (*r.links, GROUND) for p in link_points(r, link, k).values()]
    out += [tuple(joint_place(r, joint)[k]) for joint in r.joints]
    out += [tuple(r.center(link)[k]) for link in r.links if r.mechanism.mass(link)]
    for name, joint in r.mechanism.joints.items():
        for center, radius in wheels(r, name, joint, k):
            out += [(center[0] + radius, center[1] + radius), (center[0] - radius, center[1] - radius)]
    return out


def wheels(r: Result, name: str, joint: Any, k: int) -> list[tuple[tuple[float, float], float]]:
    """Pitch circles of a gear or rolling joint: centre and radius in metres."""
    if joint.type not in ("gear", "rolling"):
        return []
    (i, j), (ui, uj) = joint.links, r.mechanism.joint_points(name)
    pj = tuple(map(float, link_place(r, j, uj)[k]))
    if joint.type == "rolling" and getattr(joint, "radii", None) is None:
        return [(pj, float(joint.radius))]  # type: ignore[list-item]
    pi = tuple(map(float, link_place(r, i, ui)[k]))
    ri, rj = joint.pitch_radii if joint.type == "gear" else joint.radii
    return [(pi, float(ri)), (pj, float(rj))]  # type: ignore[list-item]


def link_shape(r: Result, link: str, k: int, frame: Frame) -> list[Item]:
    """A bar, or an area with its outline for more than two points; the block of a slider is a symbol."""
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


def rail(r: Result, name: str, k: int, frame: Frame) -> list[Item]:
    """The rail of a slider on a moving link, from that link's point to the block."""
    joint = r.mechanism.joints[name]
    if joint.type != "slider" or joint.links[0] == GROUND:
        return []
    ends = [
        frame(link_place(r, link, u)[k])
        for link, u in zip(joint.links, r.mechanism.joint_points(name), strict=True)
    ]
    return [Line(tuple(ends), "link")] if math.dist(*ends) > 0.5 else []


def draw_joint(canvas: Canvas, r: Result, name: str, k: int, frame: Frame) -> None:
    """The symbol of a joint."""
    joint = r.mechanism.joints[name]
    i, j = joint.links
    at = frame(link_place(r, j, r.mechanism.joint_points(name)[1])[k])
    if joint.type == "pin":
        grounded = GROUND in (i, j)
        canvas.add(*(plane_symbols.fixed_pin(at) if grounded else plane_symbols.pin(at)))
    elif joint.type in ("slider", "slot"):
        _draw_slide(canvas, r, name, k, frame, at)
    elif joint.type == "weld":
        canvas.add(*plane_symbols.weld(at))
    else:
        _draw_wheels(canvas, r, name, joint, k, frame)


def _draw_slide(canvas: Canvas, r: Result, name: str, k: int, frame: Frame, at: Point) -> None:
    joint = r.mechanism.joints[name]
    i, j = joint.links
    e = slide_direction(r, name)[k]
    angle = math.atan2(float(e[1]), float(e[0]))
    if joint.type == "slider":
        if GROUND in (i, j):
            side = -1.0 if math.cos(angle) > -1e-9 else 1.0
            canvas.add(*plane_symbols.guide(at, angle, 13.0, side))
        canvas.add(*plane_symbols.slider(at, angle))
        if len([n for n, d in r.mechanism.joints.items() if j in d.links and d.type == "pin"]):
            return
        return
    low, high = _slot_range(r, name, frame)
    start = np.array(link_place(r, i, r.mechanism.joint_points(name)[0])[k])
    a, b = frame(start + low * e), frame(start + high * e)
    if GROUND in (i, j):
        middle = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
        canvas.add(*plane_symbols.guide(middle, angle, math.dist(a, b) + 8.0))
    canvas.add(*plane_symbols.slot(((a[0] + b[0]) / 2, (a[1] + b[1]) / 2), angle, math.dist(a, b)))
    canvas.add(*plane_symbols.pin(at))


def _slot_range(r: Result, name: str, frame: Frame) -> tuple[float, float]:
    """Values that the slide takes over the cycle, with a little room, metres."""
    values = r.freedom(name, "slide")[0]
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    room = min(0.08 * r.compiled.layout.length, 12.0 * frame.per_mm)
    return low - room, high + room


def _draw_wheels(canvas: Canvas, r: Result, name: str, joint: Any, k: int, frame: Frame) -> None:
    for (center, radius), link in zip(wheels(r, name, joint, k)[::-1], joint.links[::-1], strict=False):
        angle = float(link_angle(r, link)[k])
        canvas.add(*plane_symbols.wheel(frame(center), frame.length(radius), angle))
    if joint.type == "rolling" and getattr(joint, "radii", None) is None:
        e = slide_direction(r, name)[k]
        at = frame(joint_place(r, name)[k])
        canvas.add(*plane_symbols.hatch(at, math.atan2(float(e[1]), float(e[0])), 22.0))


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
