"""The mechanism with its symbols, loads, traces and names of joints."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.friction_circles import two_pins
from dalembert.analysis.methods.applied_forces import Action, actions, joint_place, link_place
from dalembert.arrays import Array
from dalembert.model import GROUND
from dalembert.views.notation import Figures, Notation, Shown
from dalembert.views.paper.canvas import Canvas, segments
from dalembert.views.paper.details import detail_scenes, with_details
from dalembert.views.paper.frame import PaperFrame, fit_frame, force_scale
from dalembert.views.paper.scene import Arrow, Line, Point, Scene, along, around
from dalembert.views.plane.circle_details import draw_circles, with_friction_circle
from dalembert.views.plane.elements.turning_axis import draw_turning_axis
from dalembert.views.plane.guide_details import with_rough_guide
from dalembert.views.plane.joint_drawings import draw_joint
from dalembert.views.plane.outline import (
    MASS_CENTER,
    every_path,
    link_points,
    link_shape,
    load_places,
    rail,
    unbroken,
)
from dalembert.views.symbols import plane_symbols

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

OWN = "Friction circles to scale; dash-dotted: the line of each reaction."
TAKEN = f"{OWN[:-1]}, of a two-force link on both circles; faint: the common tangents not taken."

UNLIKE = 0.2
"""Ratio of loads to the largest effort below which the loads get a separate scale."""

NOISE = 1e-12
"""Positions of drives below this, rad or m, are rounding errors."""

ROLES = {"joint": "joint-force", "spring": "load", "damper": "friction"}


def role_of(kind: str) -> str:
    """The role of an action's arrow."""
    return ROLES.get(kind, kind)


def mechanism_scene(
    r: Result,
    k: int = 0,
    notation: Notation | None = None,
    forces: bool = False,
    width: float = 112.0,
    height: float = 80.0,
    title: str | None = None,
    friction: bool = True,
    details: bool = True,
) -> Scene:
    """The mechanism at one position: links, joints, mass centres, traces, loads; with ``forces`` the efforts too.
    Lengths and forces are to scale, both stated below. With ``friction`` (if any) the friction circles with the lines
    of the reactions, and with ``details`` pins and guides at a larger scale.
    """
    shown = Shown(r, notation or Notation(), k)
    frame = full_frame(r, k, width, height)
    canvas = Canvas()
    draw_traces(canvas, r, frame)
    draw_turning_axis(canvas, r, k, frame)
    draw_links(canvas, r, k, frame)
    with_friction = friction and r.friction is not None
    if with_friction:
        draw_circles(canvas, r, k, frame, with_friction_circle(r, r.joints))
    canvas_names(canvas, r, k, frame, shown)
    kinds = ("load", "spring", "effort", "weight", "inertia", "damper") if forces else ("load", "effort")
    some = [a for a in actions(r) if a.kind in kinds and is_drawn(r, a)]
    notes, scales = scale_notes(shown, frame, None)
    for kind, group in _scale_groups(some, k, forces):
        per_mm = draw_actions(canvas, r, group, k, frame, shown, 22.0, kind=kind, clear=True)
        notes[0] += f"; {kind}s: 1 mm = {shown.plain('force', per_mm)}" if per_mm else ""
        scales |= {kind: per_mm} if per_mm else {}
    heading = title if title is not None else r.mechanism.title or "Mechanism"
    if with_friction and with_friction_circle(r, r.joints):
        notes = [TAKEN if any(two_pins(r, n) for n in with_friction_circle(r, r.joints)) else OWN, *notes]
    scene = canvas.scene(place_title(r, k, heading, shown), notes=notes, scales=scales)
    return with_details(scene, detail_scenes(r, k, frame, shown) if with_friction and details else [])


def _scale_groups(some: list[Action], k: int, all_forces: bool) -> list[tuple[str, list[Action]]]:
    """Groups of actions drawn at one scale: all, or efforts separately where loads would be too short beside them."""
    largest = {True: 0.0, False: 0.0}
    for a in some:
        size = float(np.hypot(*a.force[k]))
        largest[a.kind == "effort"] = max(largest[a.kind == "effort"], size if math.isfinite(size) else 0.0)
    if all_forces or not 0 < largest[False] < UNLIKE * largest[True]:
        return [("force", some)]
    efforts = [a for a in some if a.kind == "effort"]
    return [("load", [a for a in some if a not in efforts]), ("effort", efforts)]


def is_drawn(r: Result, a: Action) -> bool:
    """True if an action is drawn in the mechanism: not on the ground, an effort on one of its links only."""
    if a.kind != "effort" or a.by == GROUND:
        return a.link != GROUND
    return a.link != GROUND and a.link == r.mechanism.joints[r.mechanism.drives[a.of].joint or a.of].links[1]


def scale_notes(
    shown: Figures, frame: PaperFrame | None, per_mm: float | None
) -> tuple[list[str], dict[str, float]]:
    """The scales as a note and as numbers."""
    notes, scales = [], {}
    if frame is not None:
        notes.append(f"lengths: 1 mm = {shown.plain('length', frame.per_mm)}")
        scales["length"] = frame.per_mm
    if per_mm:
        notes.append(f"forces: 1 mm = {shown.plain('force', per_mm)}")
        scales["force"] = per_mm
    text = "; ".join(notes)
    return [text[:1].upper() + text[1:]], scales


def place_title(r: Result, k: int, heading: str, shown: Shown) -> str:
    """A heading with the position of the drives."""
    if not r.drives:
        return heading
    from dalembert.analysis.result.number_kinds import drive_kinds

    at = [
        f"{d} = {shown.text(drive_kinds(r, d)['position'], float(r.drive_position(d)[k]), NOISE)}"
        for d in r.drives
    ]
    return f"{heading}, {', '.join(at)}"


def unit_size(r: Result, kind: str, notation: Notation | None = None) -> float:
    """Size in SI of the reader's unit of a kind."""
    return Shown(r, notation or Notation()).size(kind)


def full_frame(r: Result, k: int, width: float, height: float) -> PaperFrame:
    """A frame for all positions if traces are drawn, else for this one."""
    shown = [k]
    if len(r.status) > 2:
        some = np.unique(np.linspace(0, len(r.status) - 1, 24).astype(int))
        shown += some[r.ok[some]].tolist()
    return fit_frame(every_path(r)[:, shown].reshape(-1, 2), width, height, unit_size(r, "length"))


def draw_traces(canvas: Canvas, r: Result, frame: PaperFrame) -> None:
    """Paths of moving joints over the cycle."""
    if len(r.status) < 8 or r.stability is not None:
        return
    for name, joint in r.mechanism.joints.items():
        if GROUND in joint.links and joint.hinge:
            continue
        path = link_place(r, joint.links[1], r.mechanism.joint_points(name)[1])
        canvas.add(*(Line(frame.line(run), "trace") for run in unbroken(path)))


def draw_links(canvas: Canvas, r: Result, k: int, frame: PaperFrame) -> None:
    """Links, springs, joints and mass centres."""
    m = r.mechanism
    for name in r.joints:
        canvas.add(*rail(r, name, k, frame))
    for link in r.links:
        canvas.add(*link_shape(r, link, k, frame))
    for name, load in m.loads_on("span").items():
        a, b = (frame(link_place(r, end, u)[k]) for end, u in m.load_points(name))
        canvas.add(*plane_symbols.SPANS[load.type](a, b))
        for (end, _), at in zip(m.load_points(name), (a, b), strict=True):
            canvas.add(*(plane_symbols.fixed_pin(at) if end == GROUND else plane_symbols.pin(at)))
    for name in sorted(r.joints, key=lambda n: (m.joints[n].hinge, not m.joints[n].WRAPPED)):
        draw_joint(canvas, r, name, k, frame)
    for load in m.loads_on("turn").values():
        canvas.add(*plane_symbols.TURNS[load.type](frame(joint_place(r, load.joint)[k])))
    places = [item for link in r.links for item in link_points(r, link, k).items()]
    joints = [frame(p) for name, p in places if name != MASS_CENTER]
    for link in r.links:
        at = frame(r.center(link)[k])
        if m.mass(link) and all(math.dist(at, p) > 1.5 for p in joints):
            canvas.add(*plane_symbols.mass_center(at))


def canvas_names(canvas: Canvas, r: Result, k: int, frame: PaperFrame, shown: Shown) -> None:
    """Names of joints and links."""
    m = r.mechanism
    middle = np.mean([frame(p) for p in every_path(r)[:, k]], axis=0)
    for name, joint in m.joints.items():
        at = frame(link_place(r, joint.links[1], m.joint_points(name)[1])[k])
        away = math.atan2(at[1] - middle[1], at[0] - middle[0])
        canvas.label(name, at, *ring(at, 1.0), prefer=away, size=3.4, role="title")
    for link in r.links:
        for name, u in load_places(m, link).items():
            if name not in (*m.loads, *m.joints):
                at = frame(link_place(r, link, u)[k])
                canvas.label(name, *ring(at, 0.6), size=3.0, role="title", leads=False)
        places = [frame(p) for p in link_points(r, link, k).values()]
        if not places:
            continue
        if len(places) == 1:
            canvas.label(shown.link(link), places[0], size=3.0, role="note")
            continue
        canvas.label(shown.link(link), *along(places[0], places[1], 0.5, 0.35, 0.65), size=3.0, role="note")


def ring(at: Point, radius: float) -> list[Point]:
    """Four places around a point."""
    return around(at, radius, 4, math.pi / 4)


def draw_actions(
    canvas: Canvas,
    r: Result,
    some: list[Action],
    k: int,
    frame: PaperFrame,
    shown: Shown,
    longest: float,
    per_mm: float | None = None,
    values: bool = True,
    kind: str = "force",
    clear: bool = False,
) -> float | None:
    """Arrows and curved arrows of actions at their places; returns newtons per millimetre, None without forces.
    ``kind``: of scale; ``clear``: a load's arrow begins or ends at its place where it covers less of what is drawn."""
    some = [a for a in some if np.isfinite(a.force[k]).all() and np.isfinite(a.couple[k])]
    sizes = [float(np.hypot(*a.force[k])) for a in some]
    largest = max(sizes, default=0.0)
    couples = [abs(float(a.couple[k])) for a in some]
    per_mm = per_mm or force_scale(sizes, longest, unit_size(r, "force", shown.notation))
    drawn = False
    for a, size in zip(some, sizes, strict=True):
        if size > 1e-9 * largest and size / per_mm > 0.05:
            draw_force(canvas, r, a, k, frame, shown, per_mm, values, kind, clear and a.kind == "load")
            drawn = True
        elif values and size > max(1e-9 * largest, shown.least["force"]):
            canvas.label_below(f"{shown.symbol(a)} = {shown.text('force', size)}")
        if abs(float(a.couple[k])) > max(1e-9 * max(couples, default=0.0), shown.least["moment"]):
            draw_couple(canvas, r, a, k, frame, shown, values)
    return per_mm if drawn else None


def draw_force(
    canvas: Canvas,
    r: Result,
    a: Action,
    k: int,
    frame: PaperFrame,
    shown: Shown,
    per_mm: float,
    values: bool | None,
    kind: str = "force",
    clear: bool = False,
) -> None:
    """An arrow that leaves its point, or ends at it where it pushes inwards; ``values`` None leaves it unnamed."""
    at, (fx, fy) = frame(a.at[k]), map(float, a.force[k])
    dx, dy = fx / per_mm, fy / per_mm
    size = math.hypot(fx, fy)
    inward = _pushes(r, a, k)
    if clear:
        strokes = segments([i for i in canvas.items if not isinstance(i, Arrow)])
        hidden = [_covered(strokes, at, (at[0] + sign * dx, at[1] + sign * dy)) for sign in (1, -1)]
        inward = inward if hidden[0] == hidden[1] else hidden[0] > hidden[1]
    tail, head = ((at[0] - dx, at[1] - dy), at) if inward else (at, (at[0] + dx, at[1] + dy))
    canvas.add(Arrow(tail, head, role_of(a.kind), a.of, kind, size))
    free = tail if inward else head
    side = (free[0] - at[0], free[1] - at[1])
    if values is None:
        return
    name = shown.symbol(a)
    text = f"{name} = {shown.text('force', size)}" if values else name
    canvas.label(
        text,
        *along(at, free, 1.0, 0.8, 0.6),
        prefer=math.atan2(side[1], side[0]),
        size=2.8,
        role=role_of(a.kind),
    )


NEAR = 0.9
"""Distance in mm within which an arrow covers a stroke."""


def _covered(strokes: Array, start: Point, end: Point) -> int:
    """Number of twelve sampled points of an arrow, excluding its start, that are on strokes (S, 2, 2)."""
    places = np.array(along(start, end, *np.linspace(0.25, 1.0, 12)))
    low, high = places.min(axis=0) - NEAR, places.max(axis=0) + NEAR
    strokes = strokes[((strokes.max(axis=1) > low) & (strokes.min(axis=1) < high)).all(axis=1)]
    first, span = strokes[:, 0], strokes[:, 1] - strokes[:, 0]
    away = places[:, None] - first
    t = np.clip((away * span).sum(axis=-1) / np.maximum((span**2).sum(axis=-1), 1e-12), 0.0, 1.0)
    off = np.hypot(*np.moveaxis(away - t[..., None] * span, -1, 0)).min(axis=1, initial=math.inf)
    return int((off < NEAR).sum())


def _pushes(r: Result, a: Action, k: int) -> bool:
    """True if a force points from its place towards the middle of its link; the force on a guide face always does."""
    if a.kind == "joint" and with_rough_guide(r, [a.of]):
        return True
    return points_inwards(a, k, list(link_points(r, a.link, k).values()))


def points_inwards(a: Action, k: int, places: Sequence[Point] | Sequence[Array]) -> bool:
    """True if a force points from its place towards the mean of other places."""
    if len(places) < 2:
        return False
    return bool(float(np.dot(a.force[k], np.mean(np.array(places), axis=0) - a.at[k])) > 1e-12)


def draw_couple(
    canvas: Canvas, r: Result, a: Action, k: int, frame: PaperFrame, shown: Shown, values: bool | None
) -> None:
    """A curved arrow about its place; it shows the sense, and the text the magnitude."""
    at, value = frame(a.at[k]), float(a.couple[k])
    radius = {"inertia": 3.4, "load": 5.8}.get(a.kind, 4.6)
    role = role_of(a.kind)
    canvas.add(*plane_symbols.couple(at, value, radius, role, a.of, value))
    if values is None:
        return
    name = shown.turning_symbol(a)
    text = f"{name} = {shown.text('moment', abs(value) * shown.notation.torque)}" if values else name
    canvas.label(text, *around(at, radius, 8), size=2.8, role=role)
