"""A cam to scale with its circles, follower, normal, pressure angle and force, and charts over its turn."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from dalembert.arrays import Array
from dalembert.views.notation import Figures, Notation
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.diagrams import curves_scene
from dalembert.views.paper.frame import PaperFrame, fit_frame, force_scale, round_up
from dalembert.views.paper.scene import Arc, Arrow, Circle, Line, Polygon, Scene
from dalembert.views.plane.elements.cam_symbol import touching_items
from dalembert.views.symbols import plane_symbols

if TYPE_CHECKING:
    from dalembert.analysis.compile.elements.cam_motion import CamPlace
    from dalembert.machine.elements.cam_design import CamDesign

SPACE = (100.0, 86.0)
"""Space of the cam on paper, mm."""
TURN = "turn in °"
RATES = (
    ("Lift", "s", ""),
    ("Velocity", "s'", "/rad"),
    ("Acceleration", "s''", "/rad²"),
    ("Jerk", "s'''", "/rad³"),
)
"""Derivatives of the lift over the turn, their letters, and what their units are over."""
LONG = 26.0
"""Greatest length of the force's arrow, mm."""


def cam_scenes(c: CamDesign, notation: Notation | None = None) -> list[Scene]:
    """The cam where its pressure angle is greatest, and what goes on over a turn."""
    figures = Figures(c.mechanism.units, notation or Notation())
    return [cam_scene(c, figures), *_charts(c, figures)]


def cam_scene(c: CamDesign, figures: Figures, turn: float | None = None) -> Scene:
    """The cam at a turn, rad, default that of its greatest pressure angle: on the link that carries it."""
    at = c.pressure_angle_peak_at if turn is None else turn
    at = 0.0 if math.isnan(at) else at
    p, outline = c.motion.at(np.array([at])), c.profile(c.turn)
    pitch = c.pitch(c.turn)
    back = c.motion.joint.profile.start + c.motion.sense * at
    turned = np.array([[math.cos(back), -math.sin(back)], [math.sin(back), math.cos(back)]])
    outline, pitch, point, normal, way = (
        outline @ turned.T,
        pitch @ turned.T,
        p.point[0],
        p.normal[0],
        p.way[0],
    )
    axis = c.motion.carrier.at if c.motion.carrier.swings else point + 0.0
    frame = fit_frame([*outline, *pitch, point, axis, (0.0, 0.0)], *SPACE, figures.size("length"))
    canvas = Canvas()
    canvas.add(Polygon(tuple(frame(x) for x in outline), "link-area"))
    notes = [f"1 mm = {figures.plain('length', frame.per_mm)}"]
    notes += _circles(canvas, c, pitch, frame, figures)
    spot = frame(point)
    if c.motion.carrier.swings:
        canvas.add(Line((spot, frame(axis)), "link"), *plane_symbols.fixed_pin(frame(axis)))
    reach = float(np.abs(c.motion.at(c.turn).place).max())
    canvas.add(*touching_items(c.motion.joint, spot, (float(normal[0]), float(normal[1])), frame, reach))
    canvas.add(*plane_symbols.fixed_pin(frame((0.0, 0.0))))
    scales = {"length": frame.per_mm}
    _angle(
        canvas,
        c,
        frame(p.point[0] - p.place[0] * np.array([-normal[1], normal[0]])),
        normal,
        way,
        at,
        figures,
    )
    scales |= _force(canvas, c, at, point, p, frame, figures, notes)
    title = f"Cam {c.joint} at {figures.text('angle', at)}"
    return canvas.scene(title, notes=["; ".join(notes)], scales=scales)


def _circles(canvas: Canvas, c: CamDesign, pitch: Array, frame: PaperFrame, figures: Figures) -> list[str]:
    """Base circle, and that of the roller's centre with its curve."""
    out = []
    center = frame((0.0, 0.0))
    base = float(np.hypot(*c.profile(c.turn).T).min())
    canvas.add(Circle(center, frame.length(base), "construction"))
    out.append(f"base circle {figures.text('length', base)}")
    if c.motion.joint.follower.roller:
        prime = float(np.hypot(*pitch.T).min())
        canvas.add(Circle(center, frame.length(prime), "construction"))
        canvas.add(Line(tuple(frame(x) for x in pitch), "trace"))
        out.append(f"prime circle {figures.text('length', prime)}")
    return out


def _angle(
    canvas: Canvas,
    c: CamDesign,
    at: tuple[float, float],
    normal: Array,
    way: Array,
    turn: float,
    figures: Figures,
) -> None:
    """Normal, direction of motion, and the angle between them."""
    n, w = (math.atan2(float(v[1]), float(v[0])) for v in (normal, way))
    for angle, size in ((n, 22.0), (w, 22.0)):
        canvas.add(
            Line((at, (at[0] + size * math.cos(angle), at[1] + size * math.sin(angle))), "construction")
        )
    turned = (n - w + math.pi) % (2 * math.pi) - math.pi
    if abs(turned) > 1e-3:
        arc = Arc(at, 18.0, w, w + turned, "dimension", arrow=True)
        canvas.add(arc)
        size = abs(float(c.pressure_angle(turn)))
        canvas.label(
            f"φ = {figures.text('angle', size)}", arc.at(w + turned / 2), prefer=w + turned / 2, size=2.8
        )


def _force(
    canvas: Canvas,
    c: CamDesign,
    at: float,
    point: Array,
    p: CamPlace,
    frame: PaperFrame,
    figures: Figures,
    notes: list[str],
) -> dict[str, float]:
    """The normal force at the position nearest to this turn, where the mechanism moves through it."""
    turns = c.turns_of(c.result)
    off = np.abs((turns - at + math.pi) % (2 * math.pi) - math.pi)
    if not len(off) or np.isnan(off).all() or not np.isfinite(c.force).any():
        return {}
    k = int(np.nanargmin(off))
    force, largest = float(c.force[k]), float(np.nanmax(np.abs(c.force)))
    if off[k] > math.radians(5.0) or not largest > 0:
        return {}
    per_mm = force_scale([largest], LONG, figures.size("force"))
    normal = p.normal[0]
    touching = (
        point - p.place[0] * np.array([-normal[1], normal[0]]) - c.motion.joint.follower.roller * normal
    )
    head = frame(touching)
    tail = (head[0] - force / per_mm * float(normal[0]), head[1] - force / per_mm * float(normal[1]))
    canvas.add(Arrow(tail, head, "joint-force", c.joint, "force", force))
    canvas.label(f"N = {figures.text('force', force)}", tail, size=2.8, role="joint-force")
    notes.append(f"force: 1 mm = {figures.plain('force', per_mm)}")
    return {"force": per_mm}


def _charts(c: CamDesign, figures: Figures) -> list[Scene]:
    """s, v, a, j at the speed of the drive if it has one, else over the turn; pressure angle, curvature, force."""
    kind = "angle" if c.motion.carrier.swings else "length"
    x, s = np.degrees(c.turn), c.lift(c.turn)
    s[:, -1] = c.lift(c.turn[-1], before=True)
    out = [
        curves_scene(x, {sign: y / figures.size(kind)}, TURN, f"{sign} in {figures.unit(kind)}{over}", name)
        for (name, sign, over), y in zip(RATES, s, strict=True)
    ]
    angle = np.degrees(c.pressure_angle(c.turn))
    out.append(curves_scene(x, {"φ": angle}, TURN, "φ in °", "Pressure angle"))
    radius = c.profile_radius(c.turn)
    far = round_up(8 * float(np.hypot(*c.profile(c.turn).T).max()))
    shown = np.clip(radius, -far, far) / figures.size("length")
    title = f"Radius of the cam, up to {figures.plain('length', far)}"
    out.append(curves_scene(x, {"ρ": shown}, TURN, f"ρ in {figures.unit('length')}", title))
    if len(c.force) > 2 and np.isfinite(c.force).any():
        turns = np.degrees(c.turns_of(c.result))
        order = np.argsort(turns)
        unit = figures.unit("force")
        values = c.force[order] / figures.size("force")
        out.append(curves_scene(turns[order], {"N": values}, TURN, f"N in {unit}", "Normal force"))
    return out
