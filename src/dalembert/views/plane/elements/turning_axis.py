"""The axis of a plane that turns: a chain line through the drawing, and an arrow round it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import PaperFrame
from dalembert.views.paper.scene import Arrow, Line

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

BEYOND, HALF, FLAT = 8.0, 5.0, 1.6
"""Length of the line beyond what it passes, and half the axes of the ellipse of the arrow, mm."""


def draw_turning_axis(canvas: Canvas, r: Result, k: int, frame: PaperFrame) -> None:
    """The line over the heights of all points, and an arrow round its upper end."""
    turning = r.mechanism.turning
    if turning is None:
        return
    along = np.array([math.cos(turning.axis), math.sin(turning.axis)])
    across = np.array([along[1], -along[0]])
    at = np.array(frame(np.array(turning.at)))
    places = [r.point(link, p)[k] for link in r.links for p in r.mechanism.links[link].points]
    places += (
        [np.array(p) for p in r.mechanism.points("ground").values()] if "ground" in r.mechanism.links else []
    )
    heights = [float((np.array(frame(p)) - at) @ along) for p in places if np.isfinite(p).all()] or [0.0]
    low, high = at + (min(heights) - BEYOND) * along, at + (max(heights) + BEYOND) * along
    canvas.add(Line(((low[0], low[1]), (high[0], high[1])), "pitch"))
    angles = np.linspace(math.radians(140), math.radians(395), 18)  # behind the line it is left out
    ring = [high + HALF * math.cos(a) * across - FLAT * math.sin(a) * along * -1.0 for a in angles]
    points = [(float(p[0]), float(p[1])) for p in ring]
    canvas.add(Line(tuple(points), "axis-arrow"), Arrow(points[-4], points[-1], "axis-arrow"))
