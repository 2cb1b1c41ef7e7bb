"""Belts and ropes to scale: straight strands and arcs on wheels, as bands whose width is the tension."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from dalembert.analysis.methods.applied_forces import link_angle, link_place
from dalembert.model import GROUND
from dalembert.views.paper.frame import PaperFrame
from dalembert.views.paper.scene import Circle, Item, Line, Point, Polygon, Text
from dalembert.views.symbols import plane_symbols

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

WIDEST, THINNEST = 2.4, 0.5
"""Widths, in mm of paper, of the strand with the greatest tension and of one without."""

STEP = 0.06
"""Radians between the points of an arc."""


class BandStation(NamedTuple):
    """A point of a band on paper, its direction of outside, and its width."""

    at: Point
    outward: tuple[float, float]
    width: float


def band(stations: Sequence[BandStation], role: str = "belt") -> Polygon:
    """A band about its middle line."""
    left, right = [], []
    for (x, y), (nx, ny), width in stations:
        left.append((x + nx * width / 2, y + ny * width / 2))
        right.append((x - nx * width / 2, y - ny * width / 2))
    return Polygon((*left, *reversed(right)), role)


def tangent(a: Point, b: Point, ra: float, rb: float) -> tuple[Point, Point]:
    """Points where a straight strand from circle a to circle b touches them, on its left where a radius is positive."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    along = math.sqrt(max(square - (ra - rb) ** 2, 0.0))
    across = ra - rb
    ux, uy = (along * dx + across * dy) / square, (along * dy - across * dx) / square
    return (a[0] - uy * ra, a[1] + ux * ra), (b[0] - uy * rb, b[1] + ux * rb)


def width_of(tension: float, largest: float) -> float:
    """Width of a band by its tension."""
    if not largest > 0 or not math.isfinite(tension):
        return 1.0
    return THINNEST + (WIDEST - THINNEST) * max(tension, 0.0) / largest


def arc(
    center: Point, radius: float, start: Point, end: Point, ccw: bool, ends: tuple[float, float]
) -> Polygon:
    """The band on a wheel from one point to another, its tension changing as the capstan equation says."""
    first = math.atan2(start[1] - center[1], start[0] - center[0])
    angle = (math.atan2(end[1] - center[1], end[0] - center[0]) - first) % (2 * math.pi)
    angle = angle if ccw else angle - 2 * math.pi
    stations = []
    for t in np.linspace(0, 1, 2 + int(abs(angle) / STEP)):
        n = math.cos(first + t * angle), math.sin(first + t * angle)
        width = ends[0] ** (1 - t) * ends[1] ** t
        stations.append(BandStation((center[0] + radius * n[0], center[1] + radius * n[1]), n, width))
    return band(stations)


def strand(a: Point, b: Point, width: float) -> Polygon:
    """A straight band."""
    length = math.dist(a, b) or 1.0
    n = (-(b[1] - a[1]) / length, (b[0] - a[0]) / length)
    return band([BandStation(a, n, width), BandStation(b, n, width)])


def disc(r: Result, link: str, center: Point, radius: float, k: int) -> list[Item]:
    """A wheel with a spoke that shows its turn."""
    angle = float(link_angle(r, link)[k])
    rim = (center[0] + radius * math.cos(angle), center[1] + radius * math.sin(angle))
    return [Circle(center, radius, "link-area"), Line((center, rim), "construction")]


def belt_items(r: Result, name: str, k: int, frame: PaperFrame) -> list[Item]:
    """Both wheels, the strands with their tensions as widths, T1 at the tight one."""
    belt: Any = r.mechanism.joints[name]
    forces = r.belt(name)
    ends = zip(belt.links, r.mechanism.joint_points(name), strict=True)
    a, b = (frame(link_place(r, link, u)[k]) for link, u in ends)
    ra, rb = (frame.length(radius) for radius in belt.radii)
    out: list[Item] = []
    for link, center, radius in zip(belt.links, (a, b), (ra, rb), strict=True):
        out += disc(r, link, center, radius, k)
    tight, slack = float(forces.tight[k]), float(forces.slack[k])
    sign = float(forces.torque[k, 0])
    right, left = (tight, slack) if sign > 0 else (slack, tight)
    other = -rb if belt.crossed else rb
    lower, upper = tangent(a, b, -ra, -other), tangent(a, b, ra, other)
    wide = {side: width_of(t, tight) for side, t in (("right", right), ("left", left))}
    out += [strand(*lower, wide["right"]), strand(*upper, wide["left"])]
    out.append(arc(a, ra, upper[0], lower[0], True, (wide["left"], wide["right"])))
    out.append(arc(b, rb, lower[1], upper[1], not belt.crossed, (wide["right"], wide["left"])))
    if sign:
        line, away = (lower, -1.0) if sign > 0 else (upper, 1.0)
        out.append(_tight_mark(*line, away))
    return out


def _tight_mark(a: Point, b: Point, away: float) -> Text:
    """T1 beside the middle of the tight strand."""
    length = math.dist(a, b) or 1.0
    shift = away * 3.0 / length
    middle = ((a[0] + b[0]) / 2 - shift * (b[1] - a[1]), (a[1] + b[1]) / 2 + shift * (b[0] - a[0]))
    return Text(middle, "T_{1}", 2.6, "note")


def rope_items(r: Result, name: str, k: int, frame: PaperFrame) -> list[Item]:
    """The wheels and the strands of a rope, drawn with its first strand; the strands' tensions as widths."""
    joint: Any = r.mechanism.joints[name]
    strands = [n for n, j in r.mechanism.joints.items() if getattr(j, "rope", "") == joint.rope and j.WRAPPED]
    if name != strands[0]:
        return []
    rope = r.rope(joint.rope)
    described = r.mechanism.ropes[joint.rope]
    points = described.through
    at = [frame(link_place(r, link, r.mechanism.point(link, u))[k]) for link, u in (p.round for p in points)]
    radii = [frame.length(p.radius) * (-1 if p.side == "right" else 1) for p in points]
    largest = float(np.nanmax([0.0, *np.abs(rope.tension[k])]))
    widths = [0.6 * width_of(float(t), largest) for t in rope.tension[k]]
    out: list[Item] = []
    for point, center, radius in list(zip(points, at, radii, strict=True))[int(described.RING) :]:
        if radius:
            out += disc(r, point.round[0], center, abs(radius), k)
    lines = [_strand_line(rope.direction[k, n], at[n : n + 2], radii[n : n + 2]) for n in range(len(strands))]
    out += [strand(*line, width) for line, width in zip(lines, widths, strict=True)]
    for n in range(
        int(not described.RING), len(lines)
    ):  # the wheel at which the ends of a ring meet is its first
        if radii[n]:
            out.append(
                arc(
                    at[n],
                    abs(radii[n]),
                    lines[n - 1][1],
                    lines[n][0],
                    radii[n] < 0,
                    (widths[n - 1], widths[n]),
                )
            )
    return out


def _strand_line(unit: Sequence[float], at: Sequence[Point], radii: Sequence[float]) -> tuple[Point, Point]:
    """Ends of a strand where it touches its wheels."""
    ends = [
        (x - float(unit[1]) * radius, y + float(unit[0]) * radius)
        for (x, y), radius in zip(at, radii, strict=True)
    ]
    return ends[0], ends[1]


def sheave_items(r: Result, name: str, k: int, frame: PaperFrame) -> list[Item]:
    """The axle of a pulley, its support on the ground."""
    link, _ = r.mechanism.joints[name].links
    at = frame(link_place(r, link, r.mechanism.joint_points(name)[0])[k])
    return plane_symbols.fixed_pin(at, math.pi / 2) if link == GROUND else plane_symbols.pin(at)
