"""Velocity and acceleration polygons with the images of the links, and instant centres."""

from __future__ import annotations

import math
from itertools import combinations
from typing import TYPE_CHECKING, Literal

import numpy as np

from dalembert.analysis.compile.load_arrays import point_of
from dalembert.analysis.methods.applied_forces import state
from dalembert.arrays import Array
from dalembert.errors import AnalysisError
from dalembert.model import GROUND, Joint
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import force_scale
from dalembert.views.paper.scene import Arrow, Circle, Line, Point, Polygon, Scene
from dalembert.views.plane.mechanism_view import canvas_names, draw_links, scale_notes, unit_size, whole_frame
from dalembert.views.plane.outline import convex

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

Order = Literal["velocity", "acceleration"]


def motion_polygon_scene(r: Result, k: int, order: Order, notation: Notation | None = None) -> Scene:
    """Velocities (or accelerations) of all joints and mass centres from one pole; each link has its image."""
    shown = Shown(r, notation or Notation(), k)
    found = _vectors(r, k, order)
    if not np.isfinite(list(found.values())).all():
        what = "velocities" if order == "velocity" else "accelerations"
        raise AnalysisError(f"position {k + 1} has no {what}: {r.reasons[k]}")
    kind = "speed" if order == "velocity" else "acceleration"
    per_mm = force_scale([math.hypot(*v) for v in found.values()], 60.0, unit_size(r, kind, shown.notation))
    heads = {name: (v[0] / per_mm, v[1] / per_mm) for name, v in found.items()}
    canvas = Canvas()
    for names in _images(r).values():
        corners = convex(list({heads[n] for n in names if n in heads}))
        if len(corners) >= 2:
            canvas.add(
                Polygon(tuple(corners), "link-area") if len(corners) > 2 else Line(tuple(corners), "trace")
            )
    letter = "v" if order == "velocity" else "a"
    canvas.add(Circle((0.0, 0.0), 0.7, "mark"))
    canvas.label("o", (0.0, 0.0), size=3.2, role="title")
    merged: dict[Point, list[str]] = {}
    for name, head in heads.items():
        merged.setdefault((round(head[0], 2), round(head[1], 2)), []).append(name)
    for head, names in merged.items():
        size = math.hypot(*found[names[0]])
        if math.hypot(*head) > 0.1:
            exact = heads[names[0]]
            canvas.add(Arrow((0.0, 0.0), exact, order, names[0], order, size))
        sign = ", ".join(f"{letter}_{{{n}}}" for n in names)
        text = f"{sign} = {shown.text(kind, size)}"
        away = math.atan2(head[1], head[0])
        canvas.label(text, head, (0.7 * head[0], 0.7 * head[1]), prefer=away, size=2.8, role=order)
    note = f"{'Velocities' if order == 'velocity' else 'Accelerations'}: 1 mm = {shown.plain(kind, per_mm)}"
    notes = [note, _turns(r, k, order, shown)]
    return canvas.scene(f"{order.capitalize()} polygon", notes=notes, scales={order: per_mm})


def _turns(r: Result, k: int, order: Order, shown: Shown) -> str:
    """Angular rates of the links in words."""
    kind, read, letter = (
        ("angular_speed", r.speed, "ω")
        if order == "velocity"
        else ("angular_acceleration", r.acceleration, "α")
    )
    parts = [
        f"{letter}_{{{shown.link(link)}}} = {shown.text(kind, float(read(link)[k]))}" for link in r.links
    ]
    return ", ".join(parts)


def _images(r: Result) -> dict[str, list[str]]:
    """Names of the points of each link."""
    m = r.mechanism
    out: dict[str, list[str]] = {link: [] for link in r.links}
    for name, joint in m.joints.items():
        own = _own(joint)
        for link in joint.links:
            if link in out and (link == own or not (joint.apart or joint.wheels)):
                out[link].append(name)
    for link in r.links:
        if m.mass(link):
            out[link].append(_center_name(r, link))
    return out


def _own(joint: Joint) -> str:
    """The link whose point of a joint is drawn: j, or i where j is the ground."""
    i, j = joint.links
    return j if j != GROUND else i


def _center_name(r: Result, link: str) -> str:
    return f"G{Shown(r, Notation()).link(link)}"


def _vectors(r: Result, k: int, order: Order) -> dict[str, tuple[float, float]]:
    """Vector of each point, by name."""
    m, out = r.mechanism, {}
    read = r._velocity if order == "velocity" else r._acceleration
    for name, joint in m.joints.items():
        link = _own(joint)
        u = m.joint_points(name)[joint.links.index(link)]
        v = read(link, np.asarray(u, float))[k]
        if "ground" not in joint.links or joint.apart:
            out[name] = (float(v[0]), float(v[1]))
    for link in r.links:
        if m.mass(link):
            v = read(link, np.asarray(point_of(m, link, "center"), float))[k]
            out[_center_name(r, link)] = (float(v[0]), float(v[1]))
    return out


def instant_centers(r: Result, k: int, drive: int = 0) -> dict[tuple[str, str], tuple[float, float] | None]:
    """Instant centre (metres) of every two links when one drive moves; None at infinity or where nothing turns."""
    s = state(r)
    names = ("ground", *r.links)
    twist = {"ground": np.zeros(3)} | {n: s.moving.virtual[k, drive, m] for m, n in enumerate(r.links)}
    origin = np.asarray(r.compiled.origin, float)
    place = {"ground": origin} | {n: r.point_array[k, m] + origin for m, n in enumerate(r.links)}
    return {(a, b): _center(twist[a], place[a], twist[b], place[b]) for a, b in combinations(names, 2)}


def _center(ta: Array, pa: Array, tb: Array, pb: Array) -> tuple[float, float] | None:
    """The point that has one velocity on both links."""
    w = tb[2] - ta[2]
    if abs(w) < 1e-9 * max(abs(ta[2]), abs(tb[2]), 1e-300):
        return None
    va = ta[:2] - ta[2] * np.array([-pa[1], pa[0]])
    vb = tb[:2] - tb[2] * np.array([-pb[1], pb[0]])
    x, y = vb - va
    return (float(-y / w), float(x / w))


def instant_centers_scene(r: Result, k: int, notation: Notation | None = None) -> Scene:
    """The mechanism with the instant centres of its links and the lines on which three of them lie."""
    shown = Shown(r, notation or Notation(), k)
    frame = whole_frame(r, k, 76.0, 58.0)
    canvas = Canvas()
    draw_links(canvas, r, k, frame)
    span = Scene(tuple(canvas.items)).bounds
    centers = instant_centers(r, k)
    near = {pair: frame(p) for pair, p in centers.items() if p is not None}
    near = {pair: p for pair, p in near.items() if _within(p, span, 70.0)}
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
    far = [_sign(shown, a, b) for (a, b) in centers if (a, b) not in near]
    notes, scales = scale_notes(shown, frame, None)
    if far:
        notes.append(f"Outside the drawing or at infinity: {', '.join(far)}.")
    return canvas.scene("Instant centres", notes=notes, scales=scales)


def _sign(shown: Shown, a: str, b: str) -> str:
    """Sign of the instant centre of two links: I_{12}."""
    return f"I_{{{shown.pair(*((a, b) if shown.notation.order == 'by-on' else (b, a)))}}}"


def _within(p: Point, span: tuple[float, ...], room: float) -> bool:
    return span[0] - room <= p[0] <= span[2] + room and span[1] - room <= p[1] <= span[3] + room


def _ends(points: list[Point]) -> tuple[Point, ...]:
    ordered = sorted(points)
    return (ordered[0], ordered[-1])


__all__ = ["canvas_names", "instant_centers", "instant_centers_scene", "motion_polygon_scene"]
