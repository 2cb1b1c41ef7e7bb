"""Instant centres of every two links: drawn, listed by coordinates beyond the drawing, at infinity by direction."""

from __future__ import annotations

import math
from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.methods.applied_forces import state
from dalembert.arrays import Array
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.lettering import FIXED, unbroken
from dalembert.views.paper.scene import Circle, Line, Point, Scene
from dalembert.views.plane.mechanism_view import draw_links, full_frame, scale_notes

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

FAR = 1e6
"""Distance, in lengths of the machine, beyond which a centre counts as at infinity, within rounding."""

ROOM = 45.0
"""Millimetres around the mechanism in which centres are drawn."""

MOST = 24
"""Centres beyond the drawing that are listed."""


class Center(NamedTuple):
    """Point where two links have the same velocity (m); at infinity only the direction's angle, rad, -90 to 90 deg."""

    place: tuple[float, float] | None
    direction: float | None = None


def instant_centers(r: Result, k: int, drive: int = 0) -> dict[tuple[str, str], tuple[float, float] | None]:
    """Instant centre (metres) of every two links when one drive moves; None at infinity or without relative motion."""
    return {pair: center.place for pair, center in all_centers(r, k, drive).items()}


def all_centers(r: Result, k: int, drive: int = 0) -> dict[tuple[str, str], Center]:
    """The same with directions: perpendicular to the sliding for links that only slide on each other; neither place nor
    direction for links without relative motion."""
    s = state(r)
    names = ("ground", *r.links)
    twist = {"ground": np.zeros(3)} | {n: s.moving.virtual[k, drive, m] for m, n in enumerate(r.links)}
    origin = np.asarray(r.compiled.origin, float)
    place = {"ground": origin} | {n: r.point_array[k, m] + origin for m, n in enumerate(r.links)}
    length = r.compiled.layout.length
    return {
        (a, b): _center(twist[a], place[a], twist[b], place[b], length) for a, b in combinations(names, 2)
    }


def _center(ta: Array, pa: Array, tb: Array, pb: Array, length: float) -> Center:
    """Point with the same velocity on both links."""
    w = tb[2] - ta[2]
    va = ta[:2] + ta[2] * np.array([pa[1], -pa[0]]) + ta[2] * np.array([-pb[1], pb[0]])  # of a's point at b's
    x, y = tb[:2] - va
    size = math.hypot(x, y)
    fastest = max(math.hypot(*ta[:2]), math.hypot(*tb[:2]), length * abs(ta[2]), length * abs(tb[2]))
    if max(size, length * abs(w)) <= 1e-9 * fastest:
        return Center(None)
    if size > FAR * length * abs(w):
        angle = math.remainder(math.atan2(x, -y), math.pi)
        return Center(None, abs(angle) if abs(angle) > math.pi / 2 - 1e-9 else angle)
    return Center((float(pb[0] - y / w), float(pb[1] + x / w)))


def instant_centers_scene(r: Result, k: int, notation: Notation | None = None) -> Scene:
    """The mechanism with the instant centres of its links and the lines on which three of them lie."""
    shown = Shown(r, notation or Notation(), k)
    frame = full_frame(r, k, 76.0, 58.0)
    canvas = Canvas()
    draw_links(canvas, r, k, frame)
    span = Scene(tuple(canvas.items)).bounds
    centers = all_centers(r, k)
    near = {pair: frame(center.place) for pair, center in centers.items() if center.place is not None}
    near = {pair: p for pair, p in near.items() if _within(p, span, ROOM)}
    for a, b, c in combinations(("ground", *r.links), 3):
        three = [near[pair] for pair in ((a, b), (a, c), (b, c)) if pair in near]
        if len(three) == 3:
            canvas.add(Line(_ends(three), "construction"))
    merged: dict[Point, list[str]] = {}
    for (a, b), p in near.items():
        merged.setdefault((round(p[0], 1), round(p[1], 1)), []).append(_sign(shown, a, b))
    for p, names in merged.items():
        canvas.add(Circle(p, 0.8, "mark"))
        canvas.label(", ".join(names), p, size=3.0, role="velocity")
    notes, scales = scale_notes(shown, frame, None)
    far = {pair: center for pair, center in centers.items() if pair not in near}
    return canvas.scene("Instant centres", notes=[*notes, *_beyond(far, shown)], scales=scales)


def _beyond(far: dict[tuple[str, str], Center], shown: Shown) -> list[str]:
    """Centres outside the drawing: coordinates, or the direction in which they are at infinity."""
    places, directions, none = [], [], []
    for (a, b), center in far.items():
        sign = _sign(shown, a, b)
        if center.place is not None:
            x, y = (shown.number("length", v) for v in center.place)
            places.append(unbroken(f"{sign} ({x}, {y}) {shown.unit('length')}"))
        elif center.direction is not None:
            directions.append(f"{sign}{FIXED}{shown.notation.degrees(center.direction)}°")
        else:
            none.append(sign)
    out = []
    for words, some in (
        ("Outside the drawing", places),
        ("At infinity, in the direction of", directions),
        ("None, as the links move as one", none),
    ):
        more = f" and {len(some) - MOST} more" if len(some) > MOST else ""
        out += [f"{words}: {', '.join(some[:MOST])}{more}."] if some else []
    return out


def _sign(shown: Shown, a: str, b: str) -> str:
    """Sign of the instant centre of two links: I_{12}."""
    return f"I_{{{shown.pair(*((a, b) if shown.notation.order == 'by-on' else (b, a)))}}}"


def _within(p: Point, span: tuple[float, ...], room: float) -> bool:
    return span[0] - room <= p[0] <= span[2] + room and span[1] - room <= p[1] <= span[3] + room


def _ends(points: list[Point]) -> tuple[Point, ...]:
    ordered = sorted(points)
    return (ordered[0], ordered[-1])
