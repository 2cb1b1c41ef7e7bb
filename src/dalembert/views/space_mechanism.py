"""A mechanism in space through a camera: links, joints' symbols, ground, loads, traces, names; to scale."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from dalembert.analysis.actions import Action, actions, joint_place, link_place
from dalembert.views import symbols
from dalembert.views.bearings import journals
from dalembert.views.camera import Camera
from dalembert.views.canvas import Canvas
from dalembert.views.details import with_details
from dalembert.views.frame import force_scale
from dalembert.views.link_solids import GROUND, nodes, pose, wheels
from dalembert.views.mechanism import drawn_once, place_title, ring, role_of, unit_size
from dalembert.views.notation import Notation, Shown
from dalembert.views.outline import unbroken
from dalembert.views.scene import Arrow, Line, Point, Scene
from dalembert.views.solids import across
from dalembert.views.space_friction import draw_circle, friction_details
from dalembert.views.space_view import NOTHING, Sight, end_on, seen_scales, sight, standing, triad

if TYPE_CHECKING:
    from dalembert.analysis.result import Result

Array = NDArray[Any]
WIDTH, HEIGHT = 110.0, 80.0
LONGEST = 22.0
"""Largest force and moment, mm."""


def space_mechanism_scene(
    r: Result,
    k: int,
    camera: Camera,
    notation: Notation | None = None,
    forces: bool = False,
    friction: bool = True,
) -> Scene:
    """The mechanism at one position; with ``forces`` the efforts, weights and inertia forces too.

    Lengths and forces are to scale, both stated below; vectors are seen shorter by their slope to the paper. With
    ``friction`` (where there is some) the friction circles, and journals and guides at a larger scale.
    """
    shown = Shown(r, notation or Notation())
    s = whole_sight(r, k, camera, WIDTH, HEIGHT)
    canvas = Canvas()
    draw_traces(canvas, r, s)
    draw_machine(canvas, r, k, s)
    draw_names(canvas, r, k, s, shown)
    kinds = ("load", "spring", "effort", "weight", "inertia", "damper") if forces else ("load", "effort")
    some = [a for a in actions(r) if a.kind in kinds and drawn_once(r, a)]
    arrows = Arrows(canvas, r, s, shown, some, k)
    for a in some:
        arrows.action(a, k)
    left, bottom, _, _ = Scene(tuple(canvas.items)).bounds
    triad(canvas, camera, (left - 12.0, bottom))
    for joint in journals(r, k, r.joints) if friction else ():
        draw_circle(canvas, r, s, joint, k)
    notes, scales = arrows.stated()
    title = place_title(r, k, r.mechanism.title or "Mechanism", shown)
    scene = canvas.scene(title, notes=notes, scales=scales)
    return with_details(scene, friction_details(r, k, shown) if friction else [])


def every_place(r: Result, k: int) -> list[Array]:
    """All places of the mechanism at a position, metres."""
    out = [joint_place(r, joint)[k] for joint in r.joints]
    out += [link_place(r, link, u)[k] for link in (*r.links, GROUND) for u in nodes(r, link).values()]
    out += [p for link in (*r.links, GROUND) for p in rims(r, link, k)]
    return out + [r.center(link)[k] for link in r.links if r.mechanism.mass(link)]


def rims(r: Result, link: str, k: int) -> list[Array]:
    """Places around the wheels of a link at a position, metres."""
    gears = [
        n for n in r.joints if r.mechanism.joints[n].type == "gear" and link in r.mechanism.joints[n].links
    ]
    turn, origin = pose(r, link, k)
    found = [wheel for name in gears for wheel in wheels(r, name) if wheel[0] == link]
    return [
        turn @ (at + radius * e) + origin
        for _, at, axis, radius in found
        for v in across(axis)
        for e in (v, -v)
    ]


def whole_sight(r: Result, k: int, camera: Camera, width: float, height: float) -> Sight:
    """A view that holds all positions where there are traces, else this one."""
    places = every_place(r, k)
    if len(r.status) > 2:
        some = np.unique(np.linspace(0, len(r.status) - 1, 24).astype(int))
        places += [p for n in some if np.isfinite(r.point_array[n]).all() for p in every_place(r, int(n))]
    return sight(camera, places, width, height, unit_size(r, "length"))


def draw_traces(canvas: Canvas, r: Result, s: Sight) -> None:
    """Paths of moving joints over the cycle."""
    if len(r.status) < 8 or r.stability is not None:
        return
    for joint in r.joints:
        path = joint_place(r, joint)
        canvas.add(*(Line(tuple(s(p) for p in run), "trace") for run in unbroken(path)))


def draw_machine(canvas: Canvas, r: Result, k: int, s: Sight) -> None:
    """Links with their joints, the ground, springs, mass centres."""
    canvas.add(*s.painted(standing(r, k, s.frame.per_mm)))
    m = r.mechanism
    for name, load in m.loads.items():
        if load.type in ("spring", "damper"):
            a, b = (s(link_place(r, end, u)[k]) for end, u in m.load_points(name))
            canvas.add(*(symbols.spring(a, b) if load.type == "spring" else symbols.damper(a, b)))
    joints = [s(joint_place(r, name)[k]) for name in r.joints]
    for link in r.links:
        at = s(r.center(link)[k])
        if m.mass(link) and all(math.dist(at, p) > 1.5 for p in joints):
            mark_center(canvas, at, [s(link_place(r, link, u)[k]) for u in nodes(r, link).values()])


def mark_center(canvas: Canvas, at: Point, places: list[Point]) -> None:
    """A mass centre; one beside its link has a thin line to the nearest of its places."""
    far = [math.dist(at, p) for p in places]
    beside = min((_off(at, a, b) for a, b in pairwise(places)), default=min(far, default=0.0))
    if beside > 3.0 and len(places) > 1:
        canvas.add(Line((at, places[far.index(min(far))]), "construction"))
    canvas.add(*symbols.mass_center(at))


def _off(p: Point, a: Point, b: Point) -> float:
    """Distance of a place from a straight piece."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    t = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / ((dx * dx + dy * dy) or 1.0)
    t = min(max(t, 0.0), 1.0)
    return math.dist(p, (a[0] + t * dx, a[1] + t * dy))


def draw_names(canvas: Canvas, r: Result, k: int, s: Sight, shown: Shown) -> None:
    """Names of joints and links."""
    middle = np.mean([s(p) for p in every_place(r, k)], axis=0)
    for name in r.joints:
        at = s(joint_place(r, name)[k])
        away = math.atan2(at[1] - middle[1], at[0] - middle[0])
        canvas.label(name, at, *ring(at, 2.4), prefer=away, size=3.4, role="title")
    for link in r.links:
        places = [s(link_place(r, link, u)[k]) for u in nodes(r, link).values()]
        a, b = places[0], places[min(1, len(places) - 1)]
        spots = [(a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])) for t in (0.5, 0.35, 0.65)]
        canvas.label(shown.link(link), *spots, size=3.0, role="note")


class Arrows:
    """Forces as arrows and moments as arrows with two heads, each by its scale.

    ``at``: the position, or positions, whose largest force and moment are ``longest`` mm.
    """

    def __init__(
        self,
        canvas: Canvas,
        r: Result,
        s: Sight,
        shown: Shown,
        some: list[Action],
        at: Any,
        longest: float = LONGEST,
        values: bool = True,
    ) -> None:
        self.canvas, self.r, self.s, self.shown, self.values = canvas, r, s, shown, values
        self.sizes = [_largest([a.force[at] for a in some]), _largest([a.couple[at] for a in some])]
        force, moment = self.sizes
        length = r.compiled.layout.length
        self.floor = (NOTHING * max(force, moment / length), NOTHING * max(moment, force * length))
        kinds = ("force", "moment")
        scales = [
            force_scale([size], longest, unit_size(r, kind, shown.notation))
            for size, kind in zip(self.sizes, kinds, strict=True)
        ]
        self.per_mm, self.moment_per_mm = scales
        self.drawn = [False, False]

    def action(self, a: Action, k: int) -> None:
        """The force of an action at its place and its couple; what is nothing beside the largest is left out."""
        place, role = self.s(a.at[k]), role_of(a.kind)
        force, couple = np.linalg.norm(a.force[k]), np.linalg.norm(a.couple[k])
        if float(force) > self.floor[0]:
            text = f"{self.shown.symbol(a)} = {self.shown.text('force', float(force))}" if self.values else ""
            self.vector(place, a.force[k], role, a.of, text, inward=pushes(self.r, a, k))
        if float(couple) > self.floor[1]:
            size = self.shown.text("moment", float(couple))
            text = f"{self.shown.turning_symbol(a)} = {size}" if self.values else ""
            self.vector(place, a.couple[k], role, a.of, text, turning=True)

    def vector(
        self, at: Point, v: Array, role: str, of: str, text: str, turning: bool = False, inward: bool = False
    ) -> None:
        """One arrow that leaves its place, or ends there where it pushes inwards; a moment stands a little aside."""
        if not np.isfinite(v).all():
            return
        per_mm, kind = (self.moment_per_mm, "moment-seen") if turning else (self.per_mm, "force-seen")
        self.drawn[turning] = True
        head = self.s.ahead(at, v, per_mm)
        length = math.dist(at, head)
        if length < 0.6:
            if float(np.linalg.norm(v)) > 0.6 * per_mm:
                self.canvas.add(*end_on(at, float(self.s.camera.depth(v)) > 0, role))
            self.canvas.label(text, at, *ring(at, 1.2), size=2.6, role=role)
            return
        tail = at
        if turning:
            dx, dy = 1.2 * (head[1] - at[1]) / length, 1.2 * (at[0] - head[0]) / length
            tail, head = (at[0] + dx, at[1] + dy), (head[0] + dx, head[1] + dy)
        if inward:
            tail, head = (2 * at[0] - head[0], 2 * at[1] - head[1]), at
        parts = symbols.two_heads if turning else symbols.one_head
        self.canvas.add(*parts(tail, head, role, of, kind, length * per_mm))
        far = tail if inward else head
        side = (far[0] - at[0], far[1] - at[1])
        spots = [(at[0] + t * side[0], at[1] + t * side[1]) for t in (1.0, 0.8, 0.6)]
        self.canvas.label(text, *spots, prefer=math.atan2(side[1], side[0]), size=2.6, role=role)

    def stated(self, everything: bool = False) -> tuple[list[str], dict[str, float]]:
        """The scales of what was drawn, or of all that there is, as notes and as numbers."""
        force, moment = (
            [size > least for size, least in zip(self.sizes, self.floor, strict=True)]
            if everything
            else self.drawn
        )
        return seen_scales(
            self.shown, self.s, self.per_mm if force else None, self.moment_per_mm if moment else None
        )


def _largest(vectors: list[Array]) -> float:
    """The largest of vectors (..., 3), those that are not known left out."""
    sizes = np.concatenate([np.zeros(1), *(np.ravel(np.linalg.norm(v, axis=-1)) for v in vectors)])
    return float(sizes[np.isfinite(sizes)].max())


def pushes(r: Result, a: Action, k: int) -> bool:
    """Whether a force points from its place towards the middle of its link."""
    if a.link == GROUND or a.kind in ("weight", "inertia"):
        return False
    places = [link_place(r, a.link, u)[k] for u in nodes(r, a.link).values()]
    if len(places) < 2:
        return False
    return bool(float(a.force[k] @ (np.mean(places, axis=0) - a.at[k])) > 1e-12)


__all__ = ["Arrow", "Arrows", "draw_machine", "every_place", "pushes", "space_mechanism_scene", "whole_sight"]
