"""Free bodies: one link with everything that acts on it, to scale."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.friction_circles import friction_circles
from dalembert.analysis.friction.lines_of_action import acting_lines
from dalembert.analysis.methods.applied_forces import Action, full_actions, joint_place, link_place, on_link
from dalembert.analysis.methods.elements.belt_strands import wheel_place
from dalembert.analysis.methods.members import Member, components_along, members
from dalembert.views.not_shown import doubts, on_one
from dalembert.views.notation import Notation, Shown, load_sign
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.details import detail_scenes, with_details
from dalembert.views.paper.frame import PaperFrame, fit_frame, force_scale
from dalembert.views.paper.scene import Arrow, Line, Point, Scene
from dalembert.views.plane.circle_details import draw_circles, with_friction_circle
from dalembert.views.plane.elements.wedge_drawing import block_place, wedge_corners
from dalembert.views.plane.guide_details import guide_block, guide_corners, with_rough_guide
from dalembert.views.plane.joint_drawings import free_symbol
from dalembert.views.plane.mechanism_view import draw_actions, role_of, scale_notes, unit_size
from dalembert.views.plane.outline import link_points, link_shape, load_places, wheels
from dalembert.views.symbols import plane_symbols

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

LONGEST = 22.0
"""Largest force of a set of free bodies, mm."""


def free_body_scenes(r: Result, k: int, notation: Notation | None = None) -> list[Scene]:
    """Every link as a free body, at one force scale."""
    some, by_link = acting_lines(r, k), members(r)
    return [free_body_scene(r, link, k, notation, some, by_link[link]) for link in r.links]


def free_body_scene(
    r: Result,
    link: str,
    k: int,
    notation: Notation | None = None,
    some: tuple[Action, ...] | None = None,
    member: Member | None = None,
) -> Scene:
    """One link with all joint forces, loads, weights, inertia forces and couples at a position."""
    shown = Shown(r, notation or Notation(), k)
    everything = acting_lines(r, k) if some is None else some
    frame = _frame(r, link, k, shown, everything)
    canvas = Canvas()
    _draw_link(canvas, r, link, k, frame, shown)
    joints = on_one(r, link)
    draw_circles(canvas, r, k, frame, with_friction_circle(r, joints), link)
    mine = list(on_link(everything, link))
    per_mm = draw_actions(canvas, r, mine, k, frame, shown, LONGEST, common_scale(r, everything, k, shown))
    notes, scales = scale_notes(shown, frame, per_mm)
    member = member or members(r)[link]
    kind = " ".join(
        part for part in (member.kind, "member", member.state(k) and f"in {member.state(k)}") if part
    )
    notes = [f"{kind[0].upper()}{kind[1:]}. {_distances(r, link, k, shown)}".strip(), *notes]
    notes += doubts(r, k, joints)
    if member.touching:
        notes.insert(1, f"{member.touching[0].upper()}{member.touching[1:]}.")
    scene = canvas.scene(f"Link {shown.heading(link)}", notes=notes, scales=scales)
    return with_details(scene, detail_scenes(r, k, frame, shown, link, words=False))


def common_scale(
    r: Result, some: tuple[Action, ...], k: int, shown: Shown, longest: float = LONGEST
) -> float:
    """Newtons per millimetre for all links at a position."""
    sizes = [float(np.hypot(*a.force[k])) for a in some]
    return force_scale(sizes, longest, unit_size(r, "force", shown.notation))


def _frame(r: Result, link: str, k: int, shown: Shown, some: tuple[Action, ...]) -> PaperFrame:
    """A frame that contains the link's points, wheels, friction circles and the places of its reactions."""
    places = [*link_points(r, link, k).values()]
    if r.mechanism.mass(link):
        places.append(tuple(r.center(link)[k]))
    for center, radius in _wheels_of(r, link, k):
        places += [(center[0] - radius, center[1] - radius), (center[0] + radius, center[1] + radius)]
    places += [tuple(a.at[k]) for a in on_link(some, link) if a.kind == "joint"]
    for name in with_friction_circle(r, [n for n in r.joints if link in r.mechanism.joints[n].links]):
        (x, y), radius = friction_circles(r, name).center[k], friction_circles(r, name).radii[k]
        places += [(x - radius, y - radius), (x + radius, y + radius)]
    for name in with_rough_guide(r, [n for n in r.joints if r.mechanism.joints[n].links[1] == link]):
        places += guide_corners(r, name, k)
    return fit_frame(places, 40.0, 34.0, unit_size(r, "length", shown.notation))


def _wheels_of(r: Result, link: str, k: int) -> list[tuple[tuple[float, float], float]]:
    all_wheels = (wheel for name, joint in r.mechanism.joints.items() for wheel in wheels(r, name, joint, k))
    return [(center, radius) for on, center, radius in all_wheels if on == link]


def _draw_link(canvas: Canvas, r: Result, link: str, k: int, frame: PaperFrame, shown: Shown) -> None:
    m = r.mechanism
    for center, radius in _wheels_of(r, link, k):
        canvas.add(*plane_symbols.wheel(frame(center), frame.length(radius), float(r.angle(link)[k])))
    canvas.add(*link_shape(r, link, k, frame))
    for name, joint in m.joints.items():
        if link not in joint.links:
            continue
        place = wheel_place(r, name, link) if joint.WRAPPED else joint_place(r, name)
        end, at = joint.links.index(link), frame(place[k])
        if name in with_rough_guide(r, [name]) and end == 1 and wedge_corners(r, link) is None:
            canvas.add(guide_block(r, name, k, frame))
        elif joint.guides and end == 1 and (middle := block_place(r, name, k, at)):
            angle = float(r.angle(link)[k]) - float(getattr(joint, "angle", 0.0) or 0.0)
            canvas.add(*plane_symbols.slider(middle, angle))
        if end == 1 or not joint.apart:  # the pin of a slot or slider is j's
            canvas.add(*free_symbol(joint.type, at))
        canvas.label(name, *_corners(at), size=3.2, role="title", leads=False)
    for name, u in load_places(m, link).items():
        if name not in (*m.loads, *m.joints):
            canvas.label(
                name, *_corners(frame(link_place(r, link, u)[k])), size=3.0, role="title", leads=False
            )
    at = frame(r.center(link)[k])
    if m.mass(link):
        canvas.add(*plane_symbols.mass_center(at))
        canvas.label("G", *_corners(at), size=2.8, role="note", leads=False)


def _corners(at: Point) -> list[Point]:
    return [(at[0] + x, at[1] + y) for x in (-0.9, 0.9) for y in (-0.9, 0.9)]


def _distances(r: Result, link: str, k: int, shown: Shown) -> str:
    """Lengths between the link's joints and places, as text."""
    names = [n for n in link_points(r, link, k) if " " not in n]
    places = link_points(r, link, k)
    first = names[0] if names else ""

    def sign(name: str) -> str:
        return load_sign(name) if name in r.mechanism.loads else name

    parts, labelled = [], [places[first]] if first else []
    for name in names[1:]:
        if all(math.dist(places[name], other) > 0 for other in labelled):
            parts.append(
                f"{first}–{sign(name)} = {shown.text('length', math.dist(places[first], places[name]))}"
            )
            labelled.append(places[name])
    if r.mechanism.mass(link) and first:
        g = tuple(map(float, r.center(link)[k]))
        if math.dist(g, places[first]) > 0:
            parts.append(f"{first}–G = {shown.text('length', math.dist(g, places[first]))}")
    return ", ".join(parts)


def components_scene(r: Result, link: str, k: int, notation: Notation | None = None) -> Scene:
    """Joint forces of a link resolved along and across it."""
    shown = Shown(r, notation or Notation(), k)
    everything = full_actions(r)
    frame = _frame(r, link, k, shown, everything)
    canvas = Canvas()
    _draw_link(canvas, r, link, k, frame, shown)
    per_mm = common_scale(r, everything, k, shown)
    angle = float(r.angle(link)[k])
    along, across = (math.cos(angle), math.sin(angle)), (-math.sin(angle), math.cos(angle))
    for a in on_link(everything, link):
        if a.kind == "joint":
            _draw_components(canvas, a, k, frame, shown, per_mm, components_along(r, a, k), along, across)
    notes, scales = scale_notes(shown, frame, per_mm)
    notes += doubts(r, k, on_one(r, link))
    return canvas.scene(f"Link {shown.heading(link)}: along and across", notes=notes, scales=scales)


def _draw_components(
    canvas: Canvas,
    a: Action,
    k: int,
    frame: PaperFrame,
    shown: Shown,
    per_mm: float,
    parts: tuple[float, float],
    along: Point,
    across: Point,
) -> None:
    at = frame(a.at[k])
    head = (at[0] + float(a.force[k][0]) / per_mm, at[1] + float(a.force[k][1]) / per_mm)
    canvas.add(Arrow(at, head, role_of(a.kind), a.of, "force", float(np.hypot(*a.force[k]))))
    canvas.label(shown.symbol(a), head, size=2.8, role=role_of(a.kind))
    for value, e, mark in ((parts[0], along, "∥"), (parts[1], across, "⊥")):
        end = (at[0] + value * e[0] / per_mm, at[1] + value * e[1] / per_mm)
        canvas.add(Arrow(at, end, "effort", a.of, "force", abs(value)), Line((end, head), "construction"))
        canvas.label(
            f"{shown.symbol(a)}^{{{mark}}} = {shown.text('force', value)}", end, size=2.6, role="effort"
        )
