"""Force polygons to a stated scale, per link and for the chain; lines of action and their common points."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.friction_circles import friction_circles
from dalembert.analysis.friction.lines_of_action import acting_lines
from dalembert.analysis.methods.applied_forces import (
    Action,
    effort_actions,
    full_actions,
    joint_actions,
    known_actions,
    on_link,
)
from dalembert.analysis.methods.members import Member, concurrency, members, order_of_solution
from dalembert.printing import remainder
from dalembert.views.not_shown import doubts, has_reactions, on_one
from dalembert.views.notation import Figures, Notation, Shown, load_sign
from dalembert.views.paper.canvas import NO_ROOM, Canvas
from dalembert.views.paper.frame import PaperFrame, force_scale
from dalembert.views.paper.scene import Arrow, Circle, Line, Point, Scene, along
from dalembert.views.plane.circle_details import draw_circle, with_friction_circle
from dalembert.views.plane.mechanism_view import (
    draw_actions,
    draw_links,
    full_frame,
    role_of,
    scale_notes,
    unit_size,
)

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

LONGEST = 36.0
"""Largest force of a polygon, mm."""


SHORT = 0.8
"""Length in mm below which the value of a side is written below the drawing."""


def case_actions(r: Result, case: str | None = None) -> tuple[Action, ...]:
    """All actions, or those of one case of the superposition: one source and its effects."""
    if case is None:
        return full_actions(r)
    from dalembert.analysis.methods.superposition import superposition

    parts = superposition(r)
    if case not in parts.sources:
        from dalembert.errors import ModelError

        raise ModelError(f"unknown source {case!r}", f"choose one of: {', '.join(parts.sources)}")
    part = parts.case(case)
    return (*joint_actions(part), *effort_actions(part), *(a for a in known_actions(r) if a.source == case))


def forces_of(some: Sequence[Action], link: str, k: int, floor: float = 1e-9) -> list[Action]:
    """Forces on a link that are not zero, loads first, joints last."""
    largest = max((float(np.hypot(*a.force[k])) for a in some), default=0.0)
    mine = [a for a in on_link(tuple(some), link) if float(np.hypot(*a.force[k])) > floor * largest]
    return sorted(mine, key=lambda a: a.kind == "joint")


def force_polygon_scene(
    r: Result,
    link: str,
    k: int,
    notation: Notation | None = None,
    case: str | None = None,
    some: tuple[Action, ...] | None = None,
) -> Scene:
    """The forces on a link head to tail; the gap between end and start is the residual."""
    shown = Shown(r, notation or Notation(), k)
    known = has_reactions(r, link, k)
    mine = forces_of(some or case_actions(r, case), link, k) if known else []
    per_mm = force_scale(
        [float(np.hypot(*a.force[k])) for a in mine], LONGEST, unit_size(r, "force", shown.notation)
    )
    canvas = Canvas()
    gap = draw_polygon(canvas, mine, k, shown, per_mm, (0.0, 0.0))[1]
    heading = f"Force polygon of link {shown.heading(link)}" + (f": {load_sign(case)} alone" if case else "")
    if not mine:
        canvas.label("no forces" if known else "forces not known", (0.0, 0.0))
    notes, scales = scale_notes(shown, None, per_mm)
    return canvas.scene(
        heading,
        notes=[f"{notes[0]}; {_gap_text(gap, mine, k)}", *doubts(r, k, on_one(r, link))],
        scales=scales,
        numbers=_numbers(gap, mine, k),
    )


def _numbers(gap: float, mine: Sequence[Action], k: int) -> dict[str, float]:
    largest = max((float(np.hypot(*a.force[k])) for a in mine), default=0.0)
    return {"gap": gap, "largest": largest}


def _gap_text(gap: float, mine: Sequence[Action], k: int) -> str:
    largest = _numbers(gap, mine, k)["largest"]
    return f"closure gap {remainder(gap / largest)} of the largest force" if largest else "none drawn"


def draw_polygon(
    canvas: Canvas,
    mine: Sequence[Action],
    k: int,
    shown: Figures,
    per_mm: float,
    start: Point,
    skip: str = "",
) -> tuple[dict[str, tuple[Point, Point]], float]:
    """Draws forces head to tail from a start; returns the place of each (by name), and the gap in newtons."""
    at, edges = start, {}
    outline: list[Point] = [start]
    total = np.zeros(2)
    middle = _middle(mine, k, per_mm, start)
    for a in mine:
        fx, fy = map(float, a.force[k])
        total += (fx, fy)
        head = (at[0] + fx / per_mm, at[1] + fy / per_mm)
        edges[a.of] = (at, head)
        if a.of != skip:
            canvas.add(Arrow(at, head, role_of(a.kind), a.of, "force", math.hypot(fx, fy)))
            _edge_label(canvas, a, k, shown, at, head, middle)
        outline.append(head)
        at = head
    gap = float(np.hypot(*total))
    if gap / per_mm > 0.1:
        canvas.add(Arrow(at, start, "gap", "gap", "force", gap))
    return edges, gap


def _middle(mine: Sequence[Action], k: int, per_mm: float, start: Point) -> Point:
    places = np.cumsum([a.force[k] for a in mine], axis=0) / per_mm if mine else np.zeros((1, 2))
    x, y = places.mean(axis=0)
    return (start[0] + float(x), start[1] + float(y))


def _edge_label(
    canvas: Canvas, a: Action, k: int, shown: Figures, tail: Point, head: Point, middle: Point
) -> None:
    size = float(np.hypot(*a.force[k]))
    spots = along(tail, head, 0.5, 0.35, 0.65)
    away = math.atan2(spots[0][1] - middle[1], spots[0][0] - middle[0])
    text = f"{shown.symbol(a)} = {shown.text('force', size)}"
    if math.dist(tail, head) < SHORT:
        canvas.label_below(text)
        return
    canvas.label(text, *spots, prefer=away, size=2.8, role=role_of(a.kind))


CHAINS = (50.0, 80.0, 125.0)
"""Largest force of a chain, mm: the next value where a force has no room for its label."""


def force_chain_scene(r: Result, k: int, notation: Notation | None = None, case: str | None = None) -> Scene:
    """The polygons of all links in the order of solution, each on the side it shares with one before."""
    scenes = (_chain_scene(r, k, notation, case, longest) for longest in CHAINS)
    tried = []
    for scene in scenes:
        tried.append(scene)
        if not any(t.text.startswith(NO_ROOM) for t in scene.texts()):
            return scene
    return tried[0]


def _chain_scene(r: Result, k: int, notation: Notation | None, case: str | None, longest: float) -> Scene:
    shown = Shown(r, notation or Notation(), k)
    some = case_actions(r, case)
    sizes = [float(np.hypot(*a.force[k])) for a in some if a.link != "ground"]
    per_mm = force_scale(sizes, longest, unit_size(r, "force", shown.notation))
    canvas = Canvas()
    placed: dict[str, tuple[Point, Point]] = {}
    worst, bottom = 0.0, 0.0
    everything: list[Action] = []
    order = chain_order(r)
    for link in order:
        mine = forces_of(some, link, k) if has_reactions(r, link, k) else []
        shared = next((a for a in mine if a.kind == "joint" and a.of in placed), None)
        if shared is not None:
            head = placed[shared.of][1]
            mine = [shared, *(a for a in mine if a is not shared)]
            edges, gap = draw_polygon(canvas, mine, k, shown, per_mm, head, shared.of)
        else:
            low = Scene(tuple(canvas.items)).bounds[1] if canvas.items else bottom
            edges, gap = draw_polygon(
                canvas, mine, k, shown, per_mm, (0.0, low - 12.0 if canvas.items else 0.0)
            )
        placed |= {name: edge for name, edge in edges.items() if name not in placed}
        worst, everything = max(worst, gap), [*everything, *mine]
    notes, scales = scale_notes(shown, None, per_mm)
    names = " → ".join(map(shown.heading, order))
    text = f"Order of solution: {names}. A force shared by two polygons is drawn once."
    return canvas.scene(
        "Force polygons of the chain" + (f": {load_sign(case)} alone" if case else ""),
        notes=[text, f"{notes[0]}; {_gap_text(worst, everything, k)}", *doubts(r, k, r.joints)],
        scales=scales,
        numbers=_numbers(worst, everything, k),
    )


def chain_order(r: Result, by_link: dict[str, Member] | None = None) -> list[str]:
    """Links in the order of solution, two-force members where their joints come up, connected ones next.

    by_link: the classes of the links, where they are known.
    """
    by_link = members(r) if by_link is None else by_link
    out = [link for step in order_of_solution(r, by_link) for link in step.links]
    for link in r.links:
        if link not in out:
            joints = [d.links for d in r.mechanism.joints.values() if link in d.links]
            near = [out.index(n) for pair in joints for n in pair if n in out]
            out.insert(min(near, default=len(out) - 1) + 1, link)
    return out


def lines_of_action_scene(
    r: Result, link: str, k: int, notation: Notation | None = None, case: str | None = None
) -> Scene:
    """A link in the mechanism with the lines its forces act along, and the common point of three of them. Four lines
    meet in pairs; the line through the two meeting points carries both resultants.
    """
    shown = Shown(r, notation or Notation(), k)
    some = acting_lines(r, k) if case is None else case_actions(r, case)
    mine = forces_of(some, link, k)
    frame = full_frame(r, k, 76.0, 58.0)
    canvas = Canvas()
    draw_links(canvas, r, k, frame)
    for name in with_friction_circle(r, [a.of for a in mine if a.kind == "joint"]):
        draw_circle(canvas, friction_circles(r, name), k, frame)
    span = Scene(tuple(canvas.items)).bounds
    notes = _meeting(canvas, mine, k, frame, span, shown)
    for a in mine:
        canvas.add(Line(_through(frame(a.at[k]), a.force[k], span), "construction"))
    flat = [replace(a, couple=np.zeros_like(a.couple)) for a in mine]
    per_mm = draw_actions(canvas, r, flat, k, frame, shown, 20.0)
    texts, scales = scale_notes(shown, frame, per_mm)
    heading = f"Lines of action on link {shown.heading(link)}" + (
        f": {load_sign(case)} alone" if case else ""
    )
    return canvas.scene(heading, notes=[*notes, *texts, *doubts(r, k, on_one(r, link))], scales=scales)


def _meeting(
    canvas: Canvas, mine: Sequence[Action], k: int, frame: PaperFrame, span: tuple[float, ...], shown: Shown
) -> list[str]:
    """Concurrency symbols, and the note on them."""
    names = [shown.symbol(a).replace("_{", "").replace("}", "") for a in mine]
    if len(mine) == 2:
        return _arm(canvas, mine, k, frame, shown)
    if len(mine) == 3:
        point = concurrency(mine, k)
        if point is None:
            return [f"{', '.join(names)} are parallel."]
        _mark(canvas, frame(point), span, "P")
        return [f"The lines of {', '.join(names)} meet in P."]
    if len(mine) == 4:
        first, second = concurrency(mine[:2], k), concurrency(mine[2:], k)
        if first is not None and second is not None:
            return _two_meetings(canvas, frame(first), frame(second), span, names)
    return []


def _two_meetings(
    canvas: Canvas, p: Point, q: Point, span: tuple[float, ...], names: Sequence[str]
) -> list[str]:
    """The points where four lines meet in pairs, and the line through them as far as the drawing reaches."""
    ends, words = [], []
    for name, at, other in (("P", p, q), ("Q", q, p)):
        inside = _inside(at, span, 50.0)
        _mark(canvas, at, span, name)
        words.append(name if inside else f"{name} (beyond the drawing)")
        far = math.dist(p, q)
        part = 1.0 if inside or far < 40.0 else 40.0 / far
        ends.append((other[0] + part * (at[0] - other[0]), other[1] + part * (at[1] - other[1])))
    if any(_inside(at, span, 50.0) for at in (p, q)):
        canvas.add(Line((ends[0], ends[1]), "resultant"))
    first, second = f"{names[0]}, {names[1]} meet in {words[0]}", f"{names[2]}, {names[3]} in {words[1]}"
    return [f"{first}, {second}; PQ carries both resultants."]


def arm_of_couple(two: Sequence[Action], k: int) -> float:
    """Distance in metres between the lines of two equal and opposite forces."""
    (fx, fy), line = two[0].force[k], two[1].at[k] - two[0].at[k]
    size = float(np.hypot(fx, fy))
    return abs(float(line[0] * fy - line[1] * fx)) / size if size else 0.0


def _arm(canvas: Canvas, mine: Sequence[Action], k: int, frame: PaperFrame, shown: Shown) -> list[str]:
    """The arm of the couple that two parallel forces make, with its length."""
    h = arm_of_couple(mine, k)
    if frame.length(h) < 0.5:
        return []
    f = mine[0].force[k]
    across = np.array([-f[1], f[0]]) / float(np.hypot(*f))
    start = np.asarray(mine[0].at[k])
    end = start + across * float((mine[1].at[k] - start) @ across)
    canvas.add(Line((frame(end), frame(mine[1].at[k])), "construction"))
    dimension(canvas, frame(start), frame(end), f"h = {shown.text('length', h)}")
    size = float(np.hypot(*f))
    words = f"Two equal and opposite forces {shown.text('force', size)} at h = {shown.text('length', h)}"
    return [f"{words} make the couple {shown.text('moment', size * h * shown.notation.torque)}."]


def dimension(canvas: Canvas, a: Point, b: Point, text: str) -> None:
    """A dimension line between two places."""
    (middle,) = along(a, b, 0.5)
    canvas.add(*(Arrow(middle, end, "dimension", kind="dimension") for end in (a, b)))
    canvas.label(text, middle, size=2.8, role="note")


def _mark(canvas: Canvas, at: Point, span: tuple[float, ...], name: str) -> None:
    if _inside(at, span, 50.0):
        canvas.add(Circle(at, 0.8, "mark"))
        canvas.label(name, at, size=3.2, role="title")


def _inside(at: Point, span: tuple[float, ...], room: float) -> bool:
    return span[0] - room <= at[0] <= span[2] + room and span[1] - room <= at[1] <= span[3] + room


def _through(at: Point, force: np.ndarray, span: tuple[float, ...]) -> tuple[Point, Point]:
    """A line through a point along a force, to a little beyond the drawing."""
    ux, uy = (float(c) for c in force / np.hypot(*force))
    reach = [45.0, 45.0]
    for n, sign in enumerate((1, -1)):
        while reach[n] > 8 and not _inside(
            (at[0] + sign * reach[n] * ux, at[1] + sign * reach[n] * uy), span, 14.0
        ):
            reach[n] -= 2.0
    a, b = (at[0] + reach[0] * ux, at[1] + reach[0] * uy), (at[0] - reach[1] * ux, at[1] - reach[1] * uy)
    return a, b
