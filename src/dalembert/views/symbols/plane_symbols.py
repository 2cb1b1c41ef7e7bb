"""The field's symbols, each a list of primitives about a place on paper, sizes in mm."""

from __future__ import annotations

import math
from collections.abc import Callable

from dalembert.views.paper.scene import Arc, Arrow, Circle, Item, Line, Point, Polygon

PIN = 1.1
BLOCK = (6.4, 4.0)


def _rotate(points: list[Point], at: Point, angle: float) -> tuple[Point, ...]:
    c, s = math.cos(angle), math.sin(angle)
    return tuple((at[0] + c * x - s * y, at[1] + s * x + c * y) for x, y in points)


def pin(at: Point) -> list[Item]:
    """A revolute joint."""
    return [Circle(at, PIN, "pin")]


def fixed_pin(at: Point, down: float = -math.pi / 2) -> list[Item]:
    """A revolute joint on the ground: triangle with hatching towards ``down``."""
    angle = down + math.pi / 2
    triangle = _rotate([(0, 0), (-2.6, -4.2), (2.6, -4.2)], at, angle)
    base = _rotate([(0.0, -4.2)], at, angle)[0]
    return [Polygon(triangle, "support"), *hatch(base, angle, 8.4), *pin(at)]


def hatch(at: Point, angle: float, width: float) -> list[Item]:
    """A line of ground with its strokes below."""
    half = width / 2
    out: list[Item] = [Line(_rotate([(-half, 0), (half, 0)], at, angle), "ground")]
    count = max(3, round(width / 1.5))
    for k in range(count):
        x = -half + (k + 0.75) * width / count
        out.append(Line(_rotate([(x, 0), (x - 1.2, -1.4)], at, angle), "hatch"))
    return out


def slider(at: Point, angle: float) -> list[Item]:
    """A block along its direction."""
    w, h = BLOCK[0] / 2, BLOCK[1] / 2
    return [Polygon(_rotate([(-w, -h), (w, -h), (w, h), (-w, h)], at, angle), "block")]


def guide(at: Point, angle: float, width: float, side: float = -1.0) -> list[Item]:
    """The ground under a slider."""
    place = _rotate([(0.0, side * (BLOCK[1] / 2 + 0.25))], at, angle)[0]
    return hatch(place, angle if side < 0 else angle + math.pi, width)


def slot(middle: Point, angle: float, length: float) -> list[Item]:
    """A slot of a link, round at its ends."""
    half, r = length / 2, PIN + 0.5
    a, b = _rotate([(-half, 0), (half, 0)], middle, angle)
    up, down = angle + math.pi / 2, angle - math.pi / 2
    left = Arc(a, r, up, up + math.pi).points
    right = Arc(b, r, down, down + math.pi).points
    return [Polygon((*left, *right), "block")]


def mass_center(at: Point, size: float = 1.15) -> list[Item]:
    """A circle with two dark quarters."""
    out: list[Item] = [Circle(at, size, "center")]
    for start in (0.0, math.pi):
        edge = Arc(at, size, start, start + math.pi / 2).points
        out.append(Polygon((at, *edge), "center-dark"))
    return out


def weld(at: Point) -> list[Item]:
    """A filled square."""
    return [Polygon(_rotate([(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)], at, 0.0), "weld")]


def wheel(at: Point, radius: float, angle: float) -> list[Item]:
    """A pitch circle with a spoke that shows its turn."""
    spoke = _rotate([(0.0, 0.0), (radius, 0.0)], at, angle)
    return [Circle(at, radius, "pitch"), Line(spoke, "construction")]


def spring(a: Point, b: Point, turns: int = 6) -> list[Item]:
    """A zigzag between two points."""
    length = math.dist(a, b)
    angle = math.atan2(b[1] - a[1], b[0] - a[0])
    lead, wide = 0.18 * length, min(1.6, 0.2 * length)
    step = (length - 2 * lead) / (2 * turns)
    points: list[Point] = [(0, 0), (lead, 0)]
    points += [(lead + (k + 0.5) * step, wide if k % 2 == 0 else -wide) for k in range(2 * turns)]
    points += [(length - lead, 0), (length, 0)]
    return [Line(_rotate(points, a, angle), "spring")]


def damper(a: Point, b: Point) -> list[Item]:
    """A pot with a piston."""
    length = math.dist(a, b)
    angle = math.atan2(b[1] - a[1], b[0] - a[0])
    x, h = 0.4 * length, min(1.6, 0.2 * length)
    pot: list[Point] = [(0.66 * length, h), (x, h), (x, -h), (0.66 * length, -h)]
    middle = 0.55 * length
    parts = [
        [(0.0, 0.0), (x, 0.0)],
        pot,
        [(middle, h * 0.8), (middle, -h * 0.8)],
        [(middle, 0.0), (length, 0.0)],
    ]
    return [Line(_rotate(list(p), a, angle), "spring") for p in parts]


def strip_spring(a: Point, b: Point, turns: float = 2.5) -> list[Item]:
    """A strip that comes off its coil, which a bracket holds."""
    length = math.dist(a, b)
    angle = math.atan2(b[1] - a[1], b[0] - a[0])
    coil = min(1.8, 0.2 * length)
    way = [k / 40 for k in range(41)]
    spiral = [(coil * (0.3 + 0.7 * t), math.pi / 2 - 2 * math.pi * turns * (1 - t)) for t in way]
    strip = [(coil + s * math.cos(turn), -coil + s * math.sin(turn)) for s, turn in spiral]
    parts: list[list[Point]] = [[(0.0, 0.0), (coil, -coil)], [*strip, (length, 0.0)]]
    return [Line(_rotate(p, a, angle), "spring") for p in parts]


SPANS: dict[str, Callable[[Point, Point], list[Item]]] = {
    "spring": spring,
    "constant_force_spring": strip_spring,
    "damper": damper,
}
"""Loads along a span -> their symbols."""


def couple(
    at: Point, sign: float, radius: float, role: str, of: str = "", value: float | None = None
) -> list[Item]:
    """A curved arrow, counter-clockwise where ``sign`` is positive."""
    start, sweep = math.radians(-25.0), math.radians(230.0)
    if sign < 0:
        start, sweep = math.radians(205.0), -sweep
    return [Arc(at, radius, start, start + sweep, role, True, of, value)]


def one_head(tail: Point, head: Point, role: str, of: str, kind: str, value: float) -> list[Item]:
    """A force."""
    return [Arrow(tail, head, role, of, kind, value)]


def two_heads(tail: Point, head: Point, role: str, of: str, kind: str, value: float | None) -> list[Item]:
    """A moment in space: an arrow along its axis with two heads."""
    length = math.dist(tail, head)
    back = min(2.4, 0.4 * length) / max(length, 1e-12)
    second = (head[0] - back * (head[0] - tail[0]), head[1] - back * (head[1] - tail[1]))
    return [Arrow(tail, head, role, of, kind, value), Arrow(tail, second, role)]
