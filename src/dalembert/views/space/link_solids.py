"""Solids of a result's links in local axes: bars and plates between joints, joint symbols, supports on the ground.

Pictures in space and 3-D files use the same solids. A planar mechanism has its links in layers along z.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dalembert.arrays import Array
from dalembert.model import GROUND
from dalembert.model.joints.pairs import AXES
from dalembert.model.links.shapes import Box, Sphere
from dalembert.model.links.shapes import Cylinder as Round
from dalembert.model.links.shapes import Tube as Hollow
from dalembert.views.plane.joint_drawings import DRAWINGS
from dalembert.views.plane.outline import convex, load_places
from dalembert.views.space.solids import (
    Ball,
    Block,
    Plate,
    RoundBar,
    Solid,
    Wire,
    across,
    place_solids,
)
from dalembert.views.symbols.joint_solids import lift
from dalembert.views.symbols.pair_symbols import Symbol, SymbolSetting, symbol

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

ROD = 0.8
"""Radius of a link's bars, mm."""


@dataclass(frozen=True)
class Mount:
    """A joint on its two links: points (3,) and axes (3, 3), by rows, in link axes, metres; ends of the slides on i."""

    kind: str
    links: tuple[str, str]
    points: tuple[Array, Array]
    axes: tuple[Array, Array]
    low: Array
    high: Array
    blocked: str = "x"
    hand: float = 1.0


def link_solids(r: Result, size: float) -> dict[str, list[Solid]]:
    """Solids of all links, ground included, in link axes and metres; ``size`` is a symbol's millimetre in metres."""
    out: dict[str, list[Solid]] = {link: [] for link in (*r.links, GROUND)}
    clear: dict[tuple[str, str], float] = {}
    mounts: dict[str, Mount] = {}
    for name, joint in r.mechanism.joints.items():
        drawing = DRAWINGS.get(joint.type)
        if drawing is None or isinstance(drawing.solid, str):
            mounts[name] = mount(r, name)
            continue
        for link, solid in drawing.solid(r, name, size):
            out[link].append(solid)
    for name, m in mounts.items():
        mounted = _symbol(r, m, size)
        for end, solids in enumerate((mounted.on_i, mounted.on_j)):
            out[m.links[end]] += place_solids(solids, m.axes[end].T, m.points[end], size)
            clear[m.links[end], name] = mounted.clear * size
        if GROUND in m.links:
            height = _layers(r, m)[m.links.index(GROUND)] if r.mechanism.dimension == 2 else 0.0
            feet = _feet(r, m, mounted.clear, size)
            out[GROUND] += place_solids(feet, np.eye(3), np.array([0.0, 0.0, height * size]))
    for link in r.links:
        out[link] += _frame(r, link, clear, size)
    return out


def pose(r: Result, link: str, k: int) -> tuple[Array, Array]:
    """Rotation (3, 3) and origin (3,) of a link, ground included, at a position."""
    turn, at = np.eye(3), np.zeros(3)
    if link != GROUND:
        d = r.mechanism.dimension
        turn[:d, :d], at[:d] = r.rotation(link)[k], r.position(link)[k]
    return turn, at


def mount(r: Result, name: str) -> Mount:
    """Mounting of a joint on its links, with the range of its slides over all positions."""
    m = r.mechanism
    joint = m.joints[name]
    points = tuple(lift(r, link, u) for link, u in zip(joint.links, m.joint_points(name), strict=True))
    low, high = np.zeros(3), np.zeros(3)
    if m.dimension == 2:
        direction, angle = (
            float(getattr(joint, "direction", 0.0) or 0.0),
            float(getattr(joint, "angle", 0.0) or 0.0),
        )
        axes, slides = (_about_z(direction), _about_z(-angle)), {"slide": 0}
        kind, blocked = str(DRAWINGS[joint.type].solid), "x"
    else:
        geometry = r.compiled.geometries[r.joints.index(name)]
        axes, kind = (geometry.on_i, geometry.on_j), joint.type
        blocked = getattr(joint, "blocked", None) or "x"
        names = [n for n in getattr(joint, "freedoms", ()) if n.startswith("slide")]
        slides = {n: AXES.index(a) for n, a in zip(names, joint.pair.slides or "x", strict=False)}
    for freedom, axis in slides.items():
        if (name, freedom) in r.compiled.freedoms:
            values = r.freedom(name, freedom)[0]
            values = values[np.isfinite(values)]
            if len(values):
                low[axis], high[axis] = float(values.min()), float(values.max())
    hand = -1.0 if (getattr(joint, "lead", None) or 1.0) < 0 else 1.0
    return Mount(kind, joint.links, points, axes, low, high, blocked, hand)  # type: ignore[arg-type]


def _about_z(angle: float) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])


def _symbol(r: Result, m: Mount, size: float) -> Symbol:
    """The joint's symbol, oriented by the directions of its links; in the plane its parts reach through the layers."""
    to = [_towards(r, m, end) for end in (0, 1)]
    low, high = m.low / size, m.high / size
    if m.links[0] != GROUND:
        low, high = np.minimum(low, 0.0), np.maximum(high, 0.0)
    drawn = symbol(m.kind, SymbolSetting(to[0], to[1], low, high, m.blocked, m.hand))
    if r.mechanism.dimension == 3:
        return drawn
    shift = _layers(r, m)
    up = np.array([0.0, 0.0, 1.0])
    parts = [place_solids(part, np.eye(3), z * up) for part, z in zip(drawn[:2], shift, strict=True)]
    if m.kind in ("revolute", "slotted_cylinder"):
        ends = np.array([[min(shift) - 2.0], [max(shift) + 2.0]]) * up
        parts[1] = [RoundBar(ends[0], ends[1], 0.9, "inner")]
    return Symbol(parts[0], parts[1], drawn.clear)


def _layers(r: Result, m: Mount) -> list[float]:
    """Heights in mm of a plane joint's parts; a block and its rail are in the block's layer."""
    heights = [float(lift(r, link, (0, 0), 1.0)[2]) for link in m.links]
    return [heights[1]] * 2 if m.kind == "prismatic" else heights


def _towards(r: Result, m: Mount, end: int) -> Array:
    """Unit vector in the joint's axes to the middle of the rest of a link; away from the other link if there is not a
    rest."""
    here = m.points[end]
    rest = [p for p in nodes(r, m.links[end]).values() if np.linalg.norm(p - here) > 1e-9]
    if m.links[end] == GROUND or not rest:
        return np.array([0.0, 0.0, -1.0]) if end == 0 else np.array([1.0, 0.0, 0.0])
    away = m.axes[end] @ (np.mean(rest, axis=0) - here)
    length = float(np.linalg.norm(away))
    return np.asarray(away / length if length > 1e-12 else np.array([1.0, 0.0, 0.0]))


def nodes(r: Result, link: str) -> dict[str, Array]:
    """Points that a link connects, in its axes: joints' points, then points that carry loads; the mass centre if it has
    no others."""
    m = r.mechanism
    out: dict[str, Array] = {}
    for name, joint in m.joints.items():
        for end, u in zip(joint.links, m.joint_points(name), strict=True):
            if end == link:
                out.setdefault(name, lift(r, link, u))
    for name, u in load_places(m, link).items():
        out.setdefault(name, lift(r, link, u))
    if link != GROUND and len(out) == 1 and m.mass(link):
        out[""] = lift(r, link, m.center(link))
    return out


def _frame(r: Result, link: str, clear: dict[tuple[str, str], float], size: float) -> list[Solid]:
    """Bars along the shortest tree between a link's nodes; a plate where they are coplanar but not collinear."""
    height = lift(r, link, (0.0,) * r.mechanism.dimension, size)
    places: list[Array] = []
    free: list[float] = []
    for name, u in nodes(r, link).items():
        if all(np.linalg.norm(u - other) > 0.05 * size for other in places):
            places.append(u)
            free.append(clear.get((link, name), 0.0))
    out: list[Solid] = list(_plate(np.array(places), height, size)) if len(places) > 2 else []
    if out:
        return out
    for a, b in _tree(places):
        along = places[b] - places[a]
        length = float(np.linalg.norm(along))
        if length > free[a] + free[b] + 0.2 * size:
            e = along / length
            out.append(
                RoundBar(places[a] + free[a] * e + height, places[b] - free[b] * e + height, ROD * size)
            )
    return out


def _tree(places: list[Array]) -> list[tuple[int, int]]:
    """Pairs of places that join all with the least length."""
    joined, out = [0], []
    while len(joined) < len(places):
        a, b = min(
            ((a, b) for a in joined for b in range(len(places)) if b not in joined),
            key=lambda pair: float(np.linalg.norm(places[pair[0]] - places[pair[1]])),
        )
        joined.append(b)
        out.append((a, b))
    return out


def _plate(places: Array, height: Array, size: float) -> list[Plate]:
    """Convex outline of coplanar points; none if all are collinear."""
    middle = places.mean(axis=0)
    _, spread, axes = np.linalg.svd(places - middle)
    if spread[1] < 1e-3 * spread[0] or (len(spread) > 2 and spread[2] > 1e-3 * spread[0]):
        return []
    flat = (places - middle) @ axes[:2].T
    hull = np.array(convex([(float(x), float(y)) for x, y in flat / size])) * size
    return [Plate(middle + hull @ axes[:2] + height, 1.2 * size)]


def _feet(r: Result, m: Mount, clear: float, size: float) -> list[Solid]:
    """Supports of a joint on the ground: posts with hatched squares, at the ends of a slide's rail."""
    end = m.links.index(GROUND)
    axes, at = m.axes[end], m.points[end]
    if m.kind in ("plane", "sphere_between_planes", "cylinder_between_planes") and end == 0:
        off = {"plane": 1.0, "sphere_between_planes": 2.2, "cylinder_between_planes": 1.8}[m.kind]
        center = np.array([0.0, *((m.low + m.high) / 2)[1:]])
        return _foot(at + center @ axes - off * size * axes[0], -axes[0], 0.0, size)
    rails = (
        "prismatic",
        "cylindrical",
        "sphere_in_cylinder",
        "slotted_sphere_in_cylinder",
        "slotted_cylinder",
    )
    if m.kind in rails and end == 0:
        beyond = (3.4 if m.kind == "slotted_cylinder" else 5.0) * size
        aside = {"prismatic": 0.8, "cylindrical": 0.9, "slotted_cylinder": 0.7}.get(m.kind, 2.5)
        down = _down(r, m, axes[0])
        ends = (m.low[0] - beyond + 0.8 * size, m.high[0] + beyond - 0.8 * size)
        return [s for x in ends for s in _foot(at + x * axes[0], down, aside, size)]
    return _foot(at, _down(r, m, None), {"spherical": 3.1, "slotted_sphere": 3.1}.get(m.kind, clear), size)


def _down(r: Result, m: Mount, rail: Array | None) -> Array:
    """Direction of a post: down, unless the joint's axis, its slide or the other link is in the way."""
    other = m.links[1 - m.links.index(GROUND)]
    good = np.flatnonzero(r.ok)
    turn, at = pose(r, other, int(good[0]) if len(good) else 0)
    here = m.points[m.links.index(GROUND)]
    rest = [turn @ p + at - here for p in nodes(r, other).values()] if np.isfinite(turn).all() else []
    away = [v / np.linalg.norm(v) for v in rest if np.linalg.norm(v) > 1e-9]
    z, x, y = np.eye(3)[2], np.eye(3)[0], np.eye(3)[1]
    best, lowest = -z, np.inf
    directions: tuple[tuple[float, Array], ...] = (
        (0.0, -z),
        (0.35, -y),
        (0.35, -x),
        (0.4, x),
        (0.4, y),
        (0.8, z),
    )
    if r.mechanism.dimension == 2:
        directions = ((0.0, -y), (0.35, -x), (0.35, x), (0.8, y))
    for preference, e in directions:
        if rail is not None:
            e = e - (e @ rail) * rail
            if np.linalg.norm(e) < 0.3:
                continue
            e = e / np.linalg.norm(e)
        cost = preference + max([max(0.0, float(e @ v)) ** 4 for v in away], default=0.0)
        if cost < lowest - 1e-9:
            best, lowest = e, cost
    return np.asarray(best)


def _foot(at: Array, down: Array, start: float, size: float) -> list[Solid]:
    """A post and a square with strokes below it."""
    u, v = across(down)
    base = at + (start + 2.4) * size * down
    half = 2.8 * size
    corners = np.array([base + half * (a * u + b * v) for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))])
    strokes = []
    for a, b, away in ((u, v, 1), (u, v, -1), (v, u, 1), (v, u, -1)):
        for t in np.linspace(-0.75, 1.0, 5):
            p = base + half * (away * a + t * b)
            strokes.append(Wire(np.array([p, p + size * (1.2 * down - 0.9 * b)]), "hatch"))
    post = [RoundBar(at + start * size * down, base, 0.55 * size, "ground-solid")]
    return [*post, Plate(corners, 0.4 * size, "ground-solid"), *strokes]


def shape_solids(r: Result, link: str, size: float) -> list[Solid]:
    """Shapes in a link's description, in link axes; without slender bars and meshes from files."""
    m = r.mechanism
    height = lift(r, link, (0.0,) * m.dimension, size)
    out: list[Solid] = []
    for shape in m.links[link].shapes:
        if isinstance(shape, Box):
            out.append(
                Block(shape.middle() + height, np.array(shape.own_axes), np.array(shape.size) / 2, "shape")
            )
        elif isinstance(shape, Sphere):
            out.append(Ball(shape.middle() + height, shape.radius, "shape"))
        elif isinstance(shape, (Round, Hollow)):
            length, middle, axis = shape.line(lambda name: m.point(link, name))
            radius = shape.radius if isinstance(shape, Round) else shape.radii[1]
            ends = [middle + sign * length / 2 * axis + height for sign in (-1, 1)]
            out.append(RoundBar(ends[0], ends[1], radius, "shape"))
    return out
