"""Solids through a camera as items of a Scene: cut into short pieces, the farthest painted first.

Long solids are cut so that an object in front of them covers only the part behind it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from dalembert.arrays import Array
from dalembert.views.paper.scene import Circle, Item, Line, Point, Polygon
from dalembert.views.space.camera import Camera
from dalembert.views.space.solids import (
    Ball,
    Block,
    GlassTube,
    Pane,
    Plate,
    Ring,
    RoundBar,
    Solid,
    circle,
    helix,
)

LONGEST = 2.5
"""Length in mm of the pieces that solids are cut into."""

LIGHT = np.array([0.35, 0.2, 0.91])
"""Direction of the light: from above, slightly to the right of the isometric eye."""


@dataclass(frozen=True)
class DepthItem:
    """Items and their nearness to the eye."""

    depth: float
    items: tuple[Item, ...]


def paint(solids: Iterable[Solid], camera: Camera) -> list[Item]:
    """Solids in mm as items on paper, the farthest first."""
    pieces = [piece for solid in solids for piece in _pieces(solid, camera)]
    return [item for piece in sorted(pieces, key=lambda p: p.depth) for item in piece.items]


def _pieces(solid: Solid, camera: Camera) -> Iterator[DepthItem]:
    if isinstance(solid, RoundBar):
        yield from _cylinder(solid, camera)
    elif isinstance(solid, Ball):
        yield DepthItem(float(camera.depth(solid.center)), tuple(_ball(solid, camera)))
    elif isinstance(solid, Block):
        yield from _block(solid, camera)
    elif isinstance(solid, Plate):
        yield from _plate(solid, camera)
    elif isinstance(solid, Ring):
        points = circle(solid.center, solid.axis, solid.radius, 36)
        for a, b in pairwise(points):
            yield from _cylinder(RoundBar(a, b, solid.thickness, solid.role), camera, capped=False)
    elif isinstance(solid, GlassTube):
        yield from _tube(solid, camera)
    elif isinstance(solid, Pane):
        yield from _wire(np.concatenate([solid.corners, solid.corners[:1]]), solid.role, camera)
    else:
        yield from _wire(solid.points, solid.role, camera)


def _at(camera: Camera, points: Array) -> tuple[Point, ...]:
    return tuple((float(x), float(y)) for x, y in camera(np.atleast_2d(points)))


def _cuts(a: Array, b: Array, uncut: bool = False) -> Array:
    """Points (n + 1, 3) that cut a straight line into short pieces."""
    count = 1 if uncut else max(1, math.ceil(float(np.linalg.norm(b - a)) / LONGEST - 1e-6))
    return np.asarray(a + np.linspace(0.0, 1.0, count + 1)[:, None] * (b - a))


def _wire(points: Array, role: str, camera: Camera) -> Iterator[DepthItem]:
    for a, b in pairwise(points):
        for c, d in pairwise(_cuts(a, b)):
            yield DepthItem(float(camera.depth((c + d) / 2)), (Line(_at(camera, np.array([c, d])), role),))


def _cylinder(s: RoundBar, camera: Camera, capped: bool = True) -> Iterator[DepthItem]:
    """Pieces of a cylinder cut across; the side nearer to the eye shows its round end."""
    far, near = sorted((s.start, s.end), key=lambda p: float(camera.depth(p)))
    length = float(np.linalg.norm(near - far))
    if length < 1e-9:
        return
    along = (near - far) / length
    seen = camera(along)
    size = float(np.hypot(*seen))
    cap = _at(camera, circle(near, along, s.radius))[:-1]
    if size < 1e-3:
        yield DepthItem(float(camera.depth(near)), (Polygon(cap, f"{s.role}-top"),))
        return
    side = s.radius * np.array([-seen[1], seen[0]]) / size
    places = _cuts(far, near, s.whole)
    turns = _thread(s, camera, far, along, len(places) - 1)
    for n, (a, b) in enumerate(pairwise(places)):
        (pa, pb), last = camera(np.array([a, b])), n == len(places) - 2
        edges = [(pa + side, pb + side), (pa - side, pb - side)]
        items: list[Item] = []
        if n == 0:
            items.append(Polygon(_at(camera, circle(far, along, s.radius))[:-1], f"{s.role}-fill"))
        quad = (*map(_point, edges[0]), *map(_point, edges[1][::-1]))
        if last and not capped:
            items.append(Polygon(cap, f"{s.role}-fill"))
        items.append(Polygon(quad, f"{s.role}-fill"))
        items += [Line(tuple(map(_point, edge)), f"{s.role}-edge") for edge in edges]
        items += turns[n]
        if n == 0 and capped:
            items.append(Line(_at(camera, _back(s, camera, far, along)), f"{s.role}-edge"))
        if last and capped:
            items.append(Polygon(cap, f"{s.role}-top"))
        yield DepthItem(_depth(camera, a, b, s.whole), tuple(items))


def _back(s: RoundBar, camera: Camera, far: Array, along: Array) -> Array:
    """Points of the half of the far end's circle that bounds the visible area."""
    u = np.cross(along, camera.eye)
    u = u / np.linalg.norm(u)
    v = np.cross(u, along)
    v = -v if float(camera(v) @ camera(along)) > 0 else v
    t = np.linspace(0.0, np.pi, 17)[:, None]
    return np.asarray(far + s.radius * (np.cos(t) * u + np.sin(t) * v))


def _thread(s: RoundBar, camera: Camera, far: Array, along: Array, count: int) -> list[list[Item]]:
    """Lines of a thread that face the eye, for each of the pieces of its cylinder."""
    out: list[list[Item]] = [[] for _ in range(count)]
    if not s.thread:
        return out
    length = float(np.linalg.norm(s.end - s.start))
    for a, b in pairwise(helix(s)):
        middle = (a + b) / 2
        x = float((middle - far) @ along)
        if float((middle - far - x * along) @ camera.eye) > 0:
            out[min(int(count * x / length), count - 1)].append(Line(_at(camera, np.array([a, b])), "thread"))
    return out


def _depth(camera: Camera, a: Array, b: Array, uncut: bool) -> float:
    """Nearness of a piece between two places: its middle, for a sleeve slightly nearer than its nearest end."""
    ends = camera.depth(np.array([a, b]))
    return float(ends.max() + 0.05 if uncut else ends.mean())


def _point(p: Array) -> Point:
    return float(p[0]), float(p[1])


def _ball(s: Ball, camera: Camera) -> Iterator[Item]:
    """A circle with a light spot."""
    at = _point(camera(s.center))
    yield Circle(at, s.radius, s.role)
    spot = camera(LIGHT / np.linalg.norm(LIGHT)) * 0.5 * s.radius
    yield Circle((at[0] + float(spot[0]), at[1] + float(spot[1])), 0.28 * s.radius, f"{s.role}-spot")


def _block(s: Block, camera: Camera) -> Iterator[DepthItem]:
    """Pieces of a block cut across its longest side; the faces towards the eye, shaded by the light."""
    axis = int(np.argmax(s.half))
    reach = s.half[axis] * s.axes[axis]
    places = _cuts(s.center - reach, s.center + reach, s.whole)
    for n, (a, b) in enumerate(pairwise(places)):
        items: list[Item] = []
        for k in range(3):
            for sign in (-1.0, 1.0):
                normal = sign * s.axes[k]
                end = {(-1.0, 0), (1.0, len(places) - 2)}
                if float(normal @ camera.eye) <= 1e-9 or (k == axis and (sign, n) not in end):
                    continue
                items += _face(s, camera, (a, b), axis, k, sign)
        yield DepthItem(_depth(camera, a, b, s.whole), tuple(items))


def _face(
    s: Block, camera: Camera, ends: tuple[Array, Array], axis: int, k: int, sign: float
) -> Iterator[Item]:
    """One face of a piece of a block, with its edges but without the cuts."""
    role = f"{s.role}-{_tone(sign * s.axes[k])}"
    others = [m for m in range(3) if m != k]
    if k == axis:
        center = ends[0] if sign < 0 else ends[1]
        u, v = (s.half[m] * s.axes[m] for m in others)
        yield Polygon(
            _at(camera, np.array([center + u + v, center - u + v, center - u - v, center + u - v])), role
        )
        return
    m = next(m for m in others if m != axis)
    out, wide = sign * s.half[k] * s.axes[k], s.half[m] * s.axes[m]
    (a, b) = ends
    corners = np.array([a + out + wide, b + out + wide, b + out - wide, a + out - wide])
    yield Polygon(_at(camera, corners), f"{role}-fill")
    for edge in (corners[:2], corners[2:]):
        yield Line(_at(camera, edge), f"{s.role}-edge")
    for place, sharp in (
        (a, s.center - s.half[axis] * s.axes[axis]),
        (b, s.center + s.half[axis] * s.axes[axis]),
    ):
        if np.linalg.norm(place - sharp) < 1e-9:
            yield Line(_at(camera, np.array([place + out + wide, place + out - wide])), f"{s.role}-edge")


def _tone(normal: Array) -> str:
    light = float(normal @ LIGHT) / float(np.linalg.norm(LIGHT))
    return "top" if light > 0.6 else "front" if light > 0.25 else "side"


def _plate(s: Plate, camera: Camera) -> Iterator[DepthItem]:
    """A plate cut into small triangles about its middle, those at the rim with their part of the edge."""
    middle, count = s.corners.mean(axis=0), len(s.corners)
    for n, (a, b) in enumerate(pairwise([*s.corners, s.corners[0]])):
        first, last = s.spoke and n == 0, s.spoke and n == count - 1
        for cell, rim in _cells((middle, a, b), (first, True, last)):
            items: list[Item] = [Polygon(_at(camera, np.array(cell)), f"{s.role}-fill")]
            for k in range(3):
                if rim[k]:
                    items.append(Line(_at(camera, np.array([cell[k], cell[(k + 1) % 3]])), f"{s.role}-edge"))
            yield DepthItem(float(camera.depth(np.mean(cell, axis=0))), tuple(items))


Corners = tuple[Array, Array, Array]
Rim = tuple[bool, bool, bool]


def _cells(corners: Corners, rim: Rim) -> Iterator[tuple[Corners, Rim]]:
    """Pieces of a triangle, at most three times as long as usual, and the sides of each that are on the rim."""
    lengths = [float(np.linalg.norm(corners[(k + 1) % 3] - corners[k])) for k in range(3)]
    k = int(
        np.argmax(np.array(lengths) >= max(lengths) - 1e-6)
    )  # the first of equal ones, whatever their rounding
    if lengths[k] <= 3 * LONGEST + 1e-6:
        yield corners, rim
        return
    a, b, c = corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]
    ab, bc, ca = rim[k], rim[(k + 1) % 3], rim[(k + 2) % 3]
    middle = (a + b) / 2
    yield from _cells((a, middle, c), (ab, False, ca))
    yield from _cells((middle, b, c), (ab, bc, False))


def _tube(s: GlassTube, camera: Camera) -> Iterator[DepthItem]:
    along = (s.end - s.start) / np.linalg.norm(s.end - s.start)
    for end in (s.start, s.end):
        yield from _wire(circle(end, along, s.radius), s.role, camera)
    seen = np.cross(along, camera.eye)
    size = float(np.linalg.norm(seen))
    if size > 1e-3:
        side = s.radius * seen / size
        for sign in (-1, 1):
            yield from _wire(np.array([s.start + sign * side, s.end + sign * side]), s.role, camera)
