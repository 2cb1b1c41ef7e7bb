"""Wheels in mesh: pitch circles, the line of action, and the force of the teeth with its components."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.methods.applied_forces import joint_place
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.model import GROUND
from dalembert.views.not_shown import doubts
from dalembert.views.notation import Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import fit_frame, force_scale
from dalembert.views.paper.scene import Arc, Arrow, Circle, Line, Point, Scene, along, stack_scenes
from dalembert.views.plane.joint_drawings import free_symbol
from dalembert.views.plane.mechanism_view import place_title, scale_notes
from dalembert.views.plane.outline import wheels
from dalembert.views.symbols import plane_symbols

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

LONGEST, REACH = 30.0, 26.0
"""Largest force of the teeth, and half the length of the lines through the pitch point, mm."""


def meshes(r: Result) -> list[str]:
    """Joints of a planar mechanism whose wheels have teeth."""
    return [name for name, joint in r.mechanism.joints.items() if joint.TOOTHED]


def teeth_scene(r: Result, k: int, shown: Shown) -> Scene:
    """Every pair of meshing wheels with the force of its teeth, all forces to one scale."""
    names = meshes(r)
    if not names:
        raise ModelError("this mechanism has no gears to draw", "look at its free bodies: --view free-bodies")
    sizes = [float(np.hypot(*r.reaction(name)[k])) for name in names]
    per_mm = force_scale(sizes, LONGEST, shown.size("force"))
    scenes = [_mesh_scene(r, name, k, shown, per_mm) for name in names]
    return stack_scenes(scenes, title=place_title(r, k, "Forces of teeth", shown))


def tooth_force(r: Result, joint: str, k: int) -> tuple[str, Array, Array]:
    """The link that a mesh's force is drawn on, j unless that is the ground; the force on it (N); and the unit vector
    from that wheel's centre towards the pitch point, or for a ring away from it: the side from which its teeth are
    pushed."""
    i, j = r.mechanism.joints[joint].links
    on = j if j != GROUND else i
    place = {link: np.array(center) for link, center, _ in wheels(r, joint, r.mechanism.joints[joint], k)}
    line = place[on] - place[i if on == j else j]
    return on, r.reaction(joint, on)[k], np.asarray(line / np.hypot(*line))


def _mesh_scene(r: Result, joint: str, k: int, shown: Shown, per_mm: float) -> Scene:
    """Two wheels with the force on one of them, and its tangential and radial components."""
    described: Any = r.mechanism.joints[joint]
    circles = wheels(r, joint, described, k)
    corners = [(c[0] + s * radius, c[1] + s * radius) for _, c, radius in circles for s in (-1, 1)]
    frame = fit_frame(corners, 84.0, 70.0, shown.size("length"))
    on, force, e = tooth_force(r, joint, k)
    canvas, at = Canvas(), frame(joint_place(r, joint)[k])
    for link, center, radius in circles:
        angle = 0.0 if link == GROUND else float(r.angle(link)[k])
        canvas.add(*plane_symbols.wheel(frame(center), frame.length(radius), angle))
        canvas.add(Circle(frame(center), frame.length(radius * math.cos(described.pressure_angle)), "grid"))
        canvas.add(*free_symbol("pin", frame(center)))
        rim = frame((center[0] - radius * float(e[1]), center[1] + radius * float(e[0])))
        canvas.label(shown.heading(link), rim, size=3.0, role="title")
    _draw_force(canvas, shown, joint, on, at, force, e, per_mm)
    canvas.add(Circle(at, 0.6, "mark"))
    canvas.label("C", at, size=3.2, role="title")
    notes, scales = scale_notes(shown, frame, per_mm if np.isfinite(force).all() and force.any() else None)
    words = [_sizes(shown, described, [link for link, _, _ in circles]), *doubts(r, k, [joint])]
    return canvas.scene(f"Mesh {joint}: force on {shown.heading(on)}", notes=[*words, *notes], scales=scales)


def _draw_force(
    canvas: Canvas, shown: Shown, joint: str, on: str, at: Point, force: Array, e: Array, per_mm: float
) -> None:
    """The line of action, the common tangent and the angle between them; the force and its two components at C."""
    if not np.isfinite(force).all() or not force.any():
        canvas.label("no force" if np.isfinite(force).all() else "force not known", at, size=2.8)
        return
    radial = float(force @ e) * e
    around = force - radial
    size, tangent = float(np.hypot(*force)), around / np.hypot(*around)
    for direction, role in ((force / size, "line-of-action"), (tangent, "construction")):
        ends = (_ahead(at, -REACH * direction), _ahead(at, REACH * direction))
        canvas.add(Line(ends, role))
    sign = shown.reaction(joint, on)
    tip, side = _ahead(at, force / per_mm), _ahead(at, around / per_mm)
    for tail, head, v, name, away in (
        (at, tip, force, sign, radial),
        (at, side, around, f"{sign}^{{t}}", -radial),
        (side, tip, radial, f"{sign}^{{r}}", around),
    ):
        length, role = float(np.hypot(*v)), "joint-force" if v is force else "effort"
        if length / per_mm > 0.3:
            canvas.add(Arrow(tail, head, role, joint, "force", length))
            text, prefer = f"{name} = {shown.text('force', length)}", math.atan2(away[1], away[0])
            canvas.label(text, *along(tail, head, 0.85, 0.5), prefer=prefer, size=2.8, role=role)
    start, end = math.atan2(tangent[1], tangent[0]), math.atan2(force[1], force[0])
    turn = math.remainder(end - start, math.tau)
    if abs(turn) > 1e-6:
        arc = Arc(at, 0.8 * REACH, start, start + turn, "construction")
        canvas.add(arc)
        canvas.label(
            f"α = {shown.notation.degrees(abs(turn))}°", arc.at(start + turn / 2), size=2.6, role="note"
        )


def _ahead(at: Point, v: Array) -> Point:
    return at[0] + float(v[0]), at[1] + float(v[1])


def _sizes(shown: Shown, joint: Any, links: list[str]) -> str:
    """'Pitch radii: 2 sun 20 mm (20 teeth), 3 planet 16 mm (16 teeth); pressure angle 20.00°.'"""
    teeth = joint.teeth or ()
    parts = [
        f"{shown.heading(link)} {shown.text('length', radius)}" + (f" ({teeth[n]:g} teeth)" if teeth else "")
        for n, (link, radius) in enumerate(zip(links, joint.pitch_radii, strict=True))
    ]
    angle = shown.notation.degrees(joint.pressure_angle)
    words = "the force acts along the line of action, which touches both base circles (thin)"
    return f"Pitch radii: {', '.join(parts)}; pressure angle {angle}°: {words}."
