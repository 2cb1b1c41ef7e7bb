"""A mechanism in space through a camera: links, joint symbols, ground, loads, traces, names; to scale."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import actions, joint_place, link_place
from dalembert.analysis.result.reaction_axes import axes_of
from dalembert.arrays import Array
from dalembert.model import GROUND
from dalembert.model.joints.pairs import AXES
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.details import with_details
from dalembert.views.paper.scene import Line, Point, Scene, along
from dalembert.views.plane.mechanism_view import is_drawn, place_title, ring, unit_size
from dalembert.views.plane.outline import unbroken
from dalembert.views.space.camera import Camera
from dalembert.views.space.friction_arrows import draw_circle, friction_details
from dalembert.views.space.journal_details import journals
from dalembert.views.space.link_solids import nodes, pose
from dalembert.views.space.solids import across
from dalembert.views.space.space_arrows import Arrows
from dalembert.views.space.space_view import Sight, sight, standing, triad
from dalembert.views.symbols import plane_symbols
from dalembert.views.symbols.joint_solids import wheels

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

WIDTH, HEIGHT = 110.0, 80.0


def space_mechanism_scene(
    r: Result,
    k: int,
    camera: Camera,
    notation: Notation | None = None,
    forces: bool = False,
    friction: bool = True,
) -> Scene:
    """The mechanism at one position; with ``forces`` the efforts, weights and inertia forces too.

    Lengths and forces are to scale, both stated below; vectors are foreshortened by their slope to the paper. With
    ``friction`` (if any) the friction circles, and journals and guides at a larger scale.
    """
    shown = Shown(r, notation or Notation(), k)
    s = full_sight(r, k, camera, WIDTH, HEIGHT)
    canvas = Canvas()
    draw_traces(canvas, r, s)
    draw_machine(canvas, r, k, s)
    draw_names(canvas, r, k, s, shown)
    kinds = ("load", "spring", "effort", "weight", "inertia", "damper") if forces else ("load", "effort")
    some = [a for a in actions(r) if a.kind in kinds and is_drawn(r, a)]
    arrows = Arrows(canvas, r, s, shown, some, k)
    for a in some:
        arrows.action(a, k)
    left, bottom, _, _ = Scene(tuple(canvas.items)).bounds
    triad(canvas, camera, (left - 12.0, bottom))
    for joint in journals(r, k, r.joints) if friction else ():
        draw_circle(canvas, r, s, joint, k)
    notes, scales = arrows.scale_notes()
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
    gears = [n for n, joint in r.mechanism.joints.items() if joint.wheels and link in joint.links]
    turn, origin = pose(r, link, k)
    discs = [wheel for name in gears for wheel in wheels(r, name) if wheel[0] == link]
    return [
        turn @ (at + radius * e) + origin
        for _, at, axis, radius in discs
        for v in across(axis)
        for e in (v, -v)
    ]


def full_sight(r: Result, k: int, camera: Camera, width: float, height: float) -> Sight:
    """A view for all positions if traces are drawn, else for this one."""
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
    canvas.add(*s.paint(standing(r, k, s.frame.per_mm)))
    m = r.mechanism
    for name, load in m.loads_on("span").items():
        a, b = (s(link_place(r, end, u)[k]) for end, u in m.load_points(name))
        canvas.add(*plane_symbols.SPANS[load.type](a, b))
    for load in m.loads_on("turn").values():
        turn = axes_of(r, load.joint, "joint")[k][AXES.index(m.joints[load.joint].pair.turns[0])]
        canvas.add(
            *_turn_symbol(load.type, s(joint_place(r, load.joint)[k]), *s.camera(np.array(across(turn))))
        )
    joints = [s(joint_place(r, name)[k]) for name in r.joints]
    for link in r.links:
        at = s(r.center(link)[k])
        if m.mass(link) and all(math.dist(at, p) > 1.5 for p in joints):
            mark_center(canvas, at, [s(link_place(r, link, u)[k]) for u in nodes(r, link).values()])


def _turn_symbol(kind: str, at: Point, x: Array, y: Array) -> list[Line]:
    """The symbol of a load in a joint's turn, in projection: ``x`` and ``y`` are the axes of its plane on paper."""
    parts = [item.points for item in plane_symbols.TURNS[kind]((0.0, 0.0))]  # type: ignore[union-attr]
    seen = [[np.asarray(at) + a * x + b * y for a, b in points] for points in parts]
    return [Line(tuple((float(px), float(py)) for px, py in points), "spring") for points in seen]


def mark_center(canvas: Canvas, at: Point, places: list[Point]) -> None:
    """A mass centre; one beside its link has a thin line to the nearest of its places."""
    far = [math.dist(at, p) for p in places]
    beside = min((_off(at, a, b) for a, b in pairwise(places)), default=min(far, default=0.0))
    if beside > 3.0 and len(places) > 1:
        canvas.add(Line((at, places[far.index(min(far))]), "construction"))
    canvas.add(*plane_symbols.mass_center(at))


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
        spots = along(places[0], places[min(1, len(places) - 1)], 0.5, 0.35, 0.65)
        canvas.label(shown.link(link), *spots, size=3.0, role="note")
