"""Symbols of brakes and clutches: the drum, a lining with its pressure as a field, a band as wide as its tension."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from dalembert.analysis.friction.brake_answer import brake
from dalembert.analysis.methods.applied_forces import link_place, link_speed
from dalembert.analysis.methods.band_actions import strand_directions
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.views.paper.scene import Arc, Arrow, Circle, Item, Line, Point, Polygon

JointPlace = Any
"""A joint to be drawn (``joint_drawings``)."""

FIELD, THICK = 7.0, 2.2
"""Height of the greatest pressure, and thickness of a lining, mm."""
THIN, WIDE = 0.6, 3.6
"""Width of a band without tension, and at its greatest, mm."""


def shoe(s: JointPlace) -> list[Item]:
    """The drum, the lining as an arc, and the pressure on it as a field of arrows towards the lining."""
    part: Any = s.r.mechanism.joints[s.name]
    center, radius = _drum(s, part.radius)
    line = math.atan2(s.at[1] - center[1], s.at[0] - center[0])
    if part.end is None:
        angles, sizes = np.array([line - 0.08, line, line + 0.08]), np.ones(3)
    else:
        side = _side(s, line, center)
        th = np.linspace(float(part.begin), float(part.end), 25)
        angles = line + side * th
        sizes = np.cos(th - float(part.middle)) if part.pressure == "cosine" else np.sin(th) / part.peak
    inward = -1.0 if part.internal else 1.0
    rim, back = (_ring(center, radius + inward * x, angles) for x in (0.0, THICK))
    height = FIELD * sizes * _known(s)
    tops = [_polar(center, radius + inward * (THICK + h), a) for a, h in zip(angles, height, strict=True)]
    out: list[Item] = [Polygon((*rim, *back[::-1]), "block")]
    if part.end is not None and height.any():
        out += [Line(tuple(tops), "line-of-action")]
        out += [Line((back[k], tops[k]), "line-of-action") for k in range(0, len(tops), 3) if height[k] > 0.3]
    return [*_turning(s, center, radius), *out]


def band(s: JointPlace) -> list[Item]:
    """The drum, and the band around it, as wide as its tension."""
    part: Any = s.r.mechanism.joints[s.name]
    center, radius = _drum(s, part.radius)
    first, last = (
        (s.frame(end), np.array(t))
        for end, t in ((e[s.k], t[s.k]) for e, t in strand_directions(s.r, s.name))
    )
    touch = [  # the band runs clockwise from its first end
        _polar(center, radius, math.atan2(t[1], t[0]) + turn)
        for (_, t), turn in ((first, math.pi / 2), (last, -math.pi / 2))
    ]
    start, stop = (math.atan2(p[1] - center[1], p[0] - center[0]) for p in touch)
    while stop > start:
        stop -= 2 * math.pi
    angles = np.linspace(start, stop, 41)
    ends = _tensions(s)
    widths = THIN + (WIDE - THIN) * ends[0] * (ends[1] / ends[0]) ** np.linspace(0.0, 1.0, 41)
    outer = [_polar(center, radius + w, a) for w, a in zip(widths, angles, strict=True)]
    out: list[Item] = [Polygon((*_ring(center, radius, angles), *outer[::-1]), "block")]
    for (end, _), at, size in ((first, touch[0], widths[0]), (last, touch[1], widths[-1])):
        out += [Polygon(_strip(end, at, float(size), center), "block")]
    return [*_turning(s, center, radius), *out]


def faces(s: JointPlace) -> list[Item]:
    """Rubbing faces seen along their axis: rings, or pads on both sides of the axis."""
    part: Any = s.r.mechanism.joints[s.name]
    center = s.frame(_center(s)[s.k])
    inner, outer = (s.frame.length(float(x)) for x in part.edges)
    out: list[Item] = [
        Circle(center, outer, "journal"),
        *([Circle(center, inner, "journal")] if inner else []),
    ]
    unbounded = getattr(part, "sector", None) is None
    if getattr(part, "button", None):
        middle = _polar(center, (inner + outer) / 2, math.pi / 2)
        out.append(Circle(middle, (outer - inner) / 2, "block"))
    elif not unbounded:
        half = float(part.sector) / 2
        angles = np.linspace(math.pi / 2 - half, math.pi / 2 + half, 25)
        out.append(Polygon((*_ring(center, inner, angles), *_ring(center, outer, angles)[::-1]), "block"))
    else:
        for a in np.linspace(0.0, 2 * math.pi, 24, endpoint=False):
            out.append(Line((_polar(center, inner, a), _polar(center, outer, a + 0.12)), "hatch"))
    return [*out, *_turning(s, center, outer, s.r.mechanism.joints[s.name].links[::-1])[1:]]


def _center(s: JointPlace) -> Array:
    """Places (P, 2) of the drum's axis."""
    m = s.r.mechanism
    return link_place(s.r, m.joints[s.name].links[0], m.joint_points(s.name)[0])


def _drum(s: JointPlace, radius: Any) -> tuple[Point, float]:
    return s.frame(_center(s)[s.k]), s.frame.length(float(radius))


def _turning(s: JointPlace, center: Point, radius: float, links: tuple[str, ...] | None = None) -> list[Item]:
    """The drum, and an arrow in its sense of turning against what is pressed on it."""
    i, j = links or s.r.mechanism.joints[s.name].links
    rate = float(link_speed(s.r, i)[s.k] - link_speed(s.r, j)[s.k])
    out: list[Item] = [Circle(center, radius, "pitch")]
    if rate:
        small, sign = 0.55 * radius, math.copysign(1.0, rate)
        ends = [_polar(center, small, a) for a in (sign * 0.9, sign * 1.0)]
        out += [
            Arc(center, small, min(-sign * 0.5, sign * 0.95), max(-sign * 0.5, sign * 0.95), "axis-arrow")
        ]
        out += [Arrow(ends[0], ends[1], "axis-arrow")]
    return out


def _known(s: JointPlace) -> float:
    """1 where the brake presses at this position, else 0."""
    try:
        force = float(brake(s.r, s.name).force[s.k])
    except ModelError:
        return 0.0
    return 1.0 if math.isfinite(force) and force > 0 else 0.0


def _tensions(s: JointPlace) -> tuple[float, float]:
    """Tensions of the first and the last strand over the greatest; equal where they are not known."""
    try:
        value = brake(s.r, s.name)
    except ModelError:
        return 0.5, 0.5
    tight, slack = float(value.tight[s.k]), float(value.slack[s.k])
    if not (math.isfinite(tight) and slack > 0):
        return 0.5, 0.5
    clockwise = (
        float(value.slip[s.k]) > 0
    )  # the drum against the lever: the tight end is that it moves away from
    return (1.0, slack / tight) if clockwise else (slack / tight, 1.0)


def _side(s: JointPlace, line: float, center: Point) -> float:
    """1 where the lining lies counter-clockwise of the direction of j's point."""
    part: Any = s.r.mechanism.joints[s.name]
    if part.side is not None:
        return -1.0 if part.side == "right" else 1.0
    j = part.links[1]
    for u in s.r.mechanism.points(j).values():
        at = s.frame(link_place(s.r, j, u)[s.k])
        off = math.cos(line) * (at[1] - center[1]) - math.sin(line) * (at[0] - center[0])
        if abs(off) > 0.01:
            return math.copysign(1.0, off)
    return 1.0


def _polar(center: Point, radius: float, angle: float) -> Point:
    return (center[0] + radius * math.cos(angle), center[1] + radius * math.sin(angle))


def _ring(center: Point, radius: float, angles: Array) -> list[Point]:
    return [_polar(center, radius, float(a)) for a in angles]


def _strip(end: Point, touch: Point, width: float, center: Point) -> tuple[Point, ...]:
    """A strand from its end to the drum, its width away from the drum's axis."""
    e = np.subtract(touch, center)
    out = width * e / max(float(np.hypot(*e)), 1e-9)
    thin = THIN * out / max(width, 1e-9)
    return tuple((float(x), float(y)) for x, y in (end, touch, np.add(touch, out), np.add(end, thin)))
