"""A plane that turns: its axis as a chain line through the drawing with an arrow round it, the balls on its arms."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from dalembert.arrays import Array
from dalembert.model import GROUND
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import PaperFrame
from dalembert.views.paper.scene import Arrow, Circle, Item, Line, Point

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism

BEYOND, HALF, FLAT = 8.0, 5.0, 1.6
"""Length of the line beyond what it passes, and half the axes of the ellipse of the arrow, mm."""


BALL = 3.2
"""Radius of a ball, mm: a file gives its mass, not its size."""


def is_ball(m: Mechanism, link: str) -> bool:
    """True for a link with a mass in one of its points and no guide, in a plane that turns: an arm with its ball."""
    if m.turning is None or not m.mass(link) or m.inertia(link):
        return False
    center = m.center(link)
    return any(math.dist(m.point(link, p), center) < 1e-9 for p in m.links[link].points) and not any(
        joint.guides and link in joint.links for joint in m.joints.values()
    )


def ball(at: Point) -> list[Item]:
    """A ball on an arm."""
    return [Circle(at, BALL, "block")]


def axis_ends(r: Result, positions: slice, beyond: float) -> tuple[Array, Array] | None:
    """Ends of the axis over the heights of all points at some positions and a length beyond, m; None without one."""
    m, turning = r.mechanism, r.mechanism.turning
    if turning is None:
        return None
    along, at = np.array([math.cos(turning.axis), math.sin(turning.axis)]), np.array(turning.at, float)
    places = [r.point(link, p)[positions] for link in r.links for p in m.links[link].points]
    places += [np.array(p, float)[None] for p in (m.points(GROUND) if GROUND in m.links else {}).values()]
    heights = (np.concatenate([at[None], *places]) - at) @ along
    known = heights[1:][np.isfinite(heights[1:])]
    low, high = (known.min(), known.max()) if known.size else (0.0, 0.0)
    return at + (low - beyond) * along, at + (high + beyond) * along


def draw_turning_axis(canvas: Canvas, r: Result, k: int, frame: PaperFrame) -> None:
    """The line over the heights of all points, and an arrow round its upper end."""
    ends = axis_ends(r, slice(k, k + 1), BEYOND * frame.per_mm)
    if ends is None or r.mechanism.turning is None:
        return
    angle = r.mechanism.turning.axis
    along, across = (
        np.array([math.cos(angle), math.sin(angle)]),
        np.array([math.sin(angle), -math.cos(angle)]),
    )
    low, high = (np.array(frame(end)) for end in ends)
    canvas.add(Line(((low[0], low[1]), (high[0], high[1])), "pitch"))
    angles = np.linspace(math.radians(140), math.radians(395), 18)  # behind the line it is left out
    ring = [high + HALF * math.cos(a) * across - FLAT * math.sin(a) * along * -1.0 for a in angles]
    points = [(float(p[0]), float(p[1])) for p in ring]
    canvas.add(Line(tuple(points), "axis-arrow"), Arrow(points[-4], points[-1], "axis-arrow"))
