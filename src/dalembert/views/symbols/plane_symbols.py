"""Symbols of mechanisms, each a list of primitives about a place on paper, sizes in mm."""

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


def one_way(at: Point, way: float, angle: float) -> list[Item]:
    """A one-way clutch: a ring with three wedges that narrow in the sense ``way`` in which j is free."""
    out: list[Item] = [Circle(at, 3.6, "link")]
    for k in range(3):
        start = angle + k * 2 * math.pi / 3
        places = [(3.6, start), (3.6, start + 0.7 * way), (2.5, start)]
        out.append(
            Polygon(tuple((at[0] + r * math.cos(t), at[1] + r * math.sin(t)) for r, t in places), "block")
        )
    return out


def ratchet(at: Point, radius: float, teeth: int, way: float, angle: float) -> list[Item]:
    """A wheel with teeth whose steep flanks face against the sense ``way``; the first flank at ``angle``."""
    low, pitch = 0.82 * radius, 2 * math.pi / teeth * way
    places = [(r, angle + pitch * k) for k in range(teeth) for r in (low, radius)]
    return [Polygon(tuple((at[0] + r * math.cos(t), at[1] + r * math.sin(t)) for r, t in places), "block")]


def pawl(at: Point, radius: float, way: float, angle: float) -> list[Item]:
    """The pawl of such a wheel: it pushes on the flank at ``angle``, and turns about a pin behind it."""
    low, long = 0.82 * radius, max(0.7 * radius, 4.0)
    end = (low + 0.6 * long, way * long)
    shape = [(low, 0.0), (radius, 0.0), (end[0] + 0.7, end[1]), (end[0] - 0.7, end[1])]
    pin_place = _rotate([end], at, angle)[0]
    return [Polygon(_rotate(shape, at, angle), "block"), Circle(pin_place, 0.8, "pin")]


def thread(at: Point, angle: float, length: float, radius: float, lead: float) -> list[Item]:
    """A screw that ends at a point and comes from behind it, with a line for each turn of its thread."""
    edge = _rotate([(-length, -radius), (0.0, -radius), (0.0, radius), (-length, radius)], at, angle)
    turns = max(1, min(int(length / lead), int(length / 1.2)))
    step = length / turns
    lines = (_rotate([(-k * step, -radius), (-(k + 0.5) * step, radius)], at, angle) for k in range(turns))
    return [Polygon(edge, "block"), *(Line(line, "hatch") for line in lines)]


def spring(a: Point, b: Point) -> list[Item]:
    """A coil between two points, seen from the side."""
    length = math.dist(a, b)
    turns = min(max(6, round(0.3 * length)), 30) + 0.5
    angle = math.atan2(b[1] - a[1], b[0] - a[0])
    lead, wide = 0.15 * length, min(1.7, 0.2 * length)
    pitch = (length - 2 * lead) / turns
    around = [math.pi * k / 7 for k in range(round(14 * turns) + 1)]
    coil = [
        (lead + t / (2 * math.pi) * pitch - 0.35 * pitch * math.cos(t), wide * math.sin(t)) for t in around
    ]
    return [Line(_rotate([(0.0, 0.0), *coil, (length, 0.0)], a, angle), "spring")]


def torsion_spring(at: Point) -> list[Item]:
    """A spiral about a joint, with a fixed outer end."""
    turns, least, most = 2.25, PIN + 0.5, 4.2
    fractions = [k / 60 for k in range(61)]
    spiral = [
        (at[0] + r * math.cos(t), at[1] + r * math.sin(t))
        for r, t in ((least + (most - least) * f, 2 * math.pi * turns * f) for f in fractions)
    ]
    return [Line((*spiral, (spiral[-1][0] + 1.6, spiral[-1][1])), "spring")]


def torsion_damper(at: Point) -> list[Item]:
    """A vane in a round pot about a joint."""
    vane = ((at[0], at[1] + PIN), (at[0], at[1] + 3.0))
    return [Arc(at, 3.6, math.radians(20), math.radians(160), "spring"), Line(vane, "spring")]


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
    fractions = [k / 40 for k in range(41)]
    spiral = [(coil * (0.3 + 0.7 * t), math.pi / 2 - 2 * math.pi * turns * (1 - t)) for t in fractions]
    strip = [(coil + s * math.cos(turn), -coil + s * math.sin(turn)) for s, turn in spiral]
    parts: list[list[Point]] = [[(0.0, 0.0), (coil, -coil)], [*strip, (length, 0.0)]]
    return [Line(_rotate(p, a, angle), "spring") for p in parts]


def cylinder(
    base: Point, end: Point, shortest: float, longest: float, wide: float = 0.0, thick: float = 0.0
) -> list[Item]:
    """A hydraulic cylinder between its pins: barrel, piston and rod, for the shortest and longest of its lengths in mm.

    Barrel and rod are as long as the shortest length allows; the piston stays in the barrel. ``wide`` and ``thick``:
    diameters of barrel and rod in mm, where they are known; a rod thinner than a millimetre is a line.
    """
    length, angle = math.dist(base, end), math.atan2(end[1] - base[1], end[0] - base[0])
    half, mouth = barrel_half(shortest, wide), _mouth(shortest)
    head = min(max(length - rod_length(shortest, longest), 0.14 * shortest), 0.94 * mouth)
    tube, rest = barrel(base, angle, shortest, half)
    return [tube, *piston_rod(end, angle, length - head, half, thick), rest]


def barrel(base: Point, angle: float, shortest: float, half: float) -> tuple[Item, Item]:
    """A cylinder's barrel, half as wide, and the line from its pin to it; ``shortest``: between the pins, mm."""
    start, mouth = 0.1 * shortest, _mouth(shortest)
    tube: list[Point] = [(start, -half), (mouth, -half), (mouth, half), (start, half)]
    return (
        Polygon(_rotate(tube, base, angle), "block"),
        Line(_rotate([(0.0, 0.0), (start, 0.0)], base, angle), "link"),
    )


def piston_rod(end: Point, angle: float, length: float, half: float, thick: float) -> list[Item]:
    """A cylinder's piston, half as wide, and its rod up to its pin; a rod thinner than a millimetre is a line."""
    piston = Line(_rotate([(-length, -half), (-length, half)], end, angle), "link")
    if thick < 1.0:
        return [piston, Line(_rotate([(-length, 0.0), (0.0, 0.0)], end, angle), "link")]
    across = thick / 2
    sides = [(-length, -across), (0.0, -across), (0.0, across), (-length, across)]
    return [Polygon(_rotate(sides, end, angle), "block"), piston]


def barrel_half(shortest: float, wide: float) -> float:
    """Half the width of a barrel, mm, whose diameter is known or 0."""
    return wide / 2 or min(2.2, 0.16 * shortest)


def rod_length(shortest: float, longest: float) -> float:
    """Distance of a cylinder's piston from the pin of its rod, by the shortest and longest of its lengths, mm."""
    return min(0.86 * shortest, max(0.5 * shortest, longest - 0.9 * _mouth(shortest)))


def _mouth(shortest: float) -> float:
    """End of the barrel from its pin, mm."""
    return min(0.88 * shortest, shortest - PIN - 1.0)


def gas_spring(a: Point, b: Point) -> list[Item]:
    """A gas spring between its ends: a closed tube with its rod."""
    length = math.dist(a, b)
    return cylinder(a, b, 0.7 * length, length)


SPANS: dict[str, Callable[[Point, Point], list[Item]]] = {
    "spring": spring,
    "constant_force_spring": strip_spring,
    "gas_spring": gas_spring,
    "damper": damper,
}
"""Loads along a span -> their symbols."""

TURNS: dict[str, Callable[[Point], list[Item]]] = {
    "torsion_spring": torsion_spring,
    "torsion_damper": torsion_damper,
}
"""Loads in the turn of a joint -> their symbols."""


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
