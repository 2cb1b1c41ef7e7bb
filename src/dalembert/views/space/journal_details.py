"""A journal in space seen along its axis: the forces on its ends touch the friction circle."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.compile.contacts import circle as circle_kind
from dalembert.analysis.friction.bearing_ends import BearingEnd, bearing_axis, bearing_ends
from dalembert.analysis.friction.joint_friction import at_rest, friction_coefficient, friction_sense
from dalembert.analysis.methods.applied_forces import joint_place, link_place
from dalembert.arrays import Array
from dalembert.model import GROUND
from dalembert.views.notation import Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import round_up
from dalembert.views.paper.scene import Arc, Arrow, Circle, Line, Point, Scene
from dalembert.views.plane.circle_details import WINDOW, chord, onward
from dalembert.views.space.camera import Camera
from dalembert.views.space.link_solids import nodes
from dalembert.views.space.space_view import triad

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def journals(r: Result, k: int, joints: Sequence[str]) -> list[str]:
    """Joints, among some, whose journal has known friction at a position."""
    return [n for n in joints if bearing_ends(r, n, "pin") and circle_radius(r, n, k) > 0]


def circle_radius(r: Result, joint: str, k: int) -> float:
    """Radius of the circle that the forces on a journal touch at a position, m; 0 without a bearing force."""
    radii = [float(np.linalg.norm(_touch(end, bearing_axis(r, joint), k))) for end in _bearing(r, joint, k)]
    return max(radii, default=0.0)


def _bearing(r: Result, joint: str, k: int) -> list[BearingEnd]:
    """Ends of a journal with a force above rounding level."""
    ends = [end for end in bearing_ends(r, joint, "pin") if np.isfinite(end.force[k]).all()]
    largest = max((float(np.linalg.norm(end.force[k])) for end in ends), default=0.0)
    return [end for end in ends if float(np.linalg.norm(end.force[k])) > 1e-9 * largest]


def _touch(end: BearingEnd, axis: Array, k: int) -> Array:
    """Vector from the axis to the line of the force (3,), where the force has the moment of friction about the axis."""
    force = end.force[k]
    return np.asarray(-end.friction[k] * np.cross(axis[k], force) / (force @ force))


def along_axis(axis: Array) -> Camera:
    """A camera towards which a direction points."""
    flat = math.hypot(float(axis[0]), float(axis[1]))
    azimuth = math.atan2(float(axis[1]), float(axis[0])) if flat > 1e-9 else -math.pi / 2
    return Camera(azimuth, math.atan2(float(axis[2]), flat))


def journal_detail(r: Result, joint: str, k: int, shown: Shown, on: str, words: bool = True) -> Scene:
    """A journal at a scale at which its friction circle is visible, its axis towards the eye.

    Lengths are to the scale stated; arrows show the lines and senses of the forces on one of its links only.
    """
    axis, ends = bearing_axis(r, joint), _bearing(r, joint, k)
    camera, radius = along_axis(axis[k]), circle_radius(r, joint, k)
    per_mm = round_up(radius / 6.0 / shown.size("length")) * shown.size("length")
    f: Any = getattr(r.mechanism.joints[joint], "friction", None)
    large = float(f.radius) / per_mm
    canvas = Canvas()
    _draw_link(canvas, r, joint, k, camera, shown, on)
    if large <= WINDOW:
        canvas.add(Circle((0.0, 0.0), large, "journal"))
    canvas.add(Circle((0.0, 0.0), radius / per_mm, "friction-circle"), Circle((0.0, 0.0), 0.5, "mark"))
    sign = 1.0 if on == r.mechanism.joints[joint].links[1] else -1.0
    directions = []
    for end in ends:
        x, y = camera(_touch(end, axis, k)) / per_mm
        e = camera(sign * end.force[k])
        directions.append(e / np.hypot(*e))
        _force(canvas, joint, shown, on, end, k, (float(x), float(y)), directions[-1])
    touch = camera(_touch(ends[0], axis, k)) / per_mm
    canvas.add(Line(((0.0, 0.0), (float(touch[0]), float(touch[1]))), "dimension"))
    canvas.label(f"r = {shown.text('length', radius)}", (float(touch[0]) / 2, float(touch[1]) / 2), size=2.6)
    _turning(canvas, r, joint, k, shown, on, directions)
    triad(canvas, camera, (-WINDOW - 16.0, -WINDOW - 2.0), 7.0)
    notes = [*(_words(r, joint, k, shown, on) if words else ()), f"1 mm = {shown.plain('length', per_mm)}"]
    scene = canvas.scene(f"Journal {joint}, seen along its axis", notes=notes)
    return Scene(scene.items, scene.title, {f"length at {joint}": per_mm})


def _draw_link(canvas: Canvas, r: Result, joint: str, k: int, camera: Camera, shown: Shown, on: str) -> None:
    """The link as lines towards its other points, as far as they are visible beside the axis."""
    if on == GROUND:
        return
    away = [link_place(r, on, u)[k] - joint_place(r, joint)[k] for u in nodes(r, on).values()]
    seen = [camera(v) for v in away if np.hypot(*camera(v)) > 0.05 * np.linalg.norm(v) > 0]
    for v in (v / np.hypot(*v) for v in seen[:3]):
        canvas.add(Line(((0.0, 0.0), onward((0.0, 0.0), v, WINDOW)), "link"))
    if seen:
        canvas.label(shown.link(on), onward((0.0, 0.0), seen[0] / np.hypot(*seen[0]), WINDOW), role="note")


def _force(
    canvas: Canvas, joint: str, shown: Shown, on: str, end: BearingEnd, k: int, touch: Point, e: Array
) -> None:
    """The force on one end, where it touches the circle."""
    chord(canvas, touch, e, "line-of-action")
    free = onward(touch, e, -WINDOW)
    canvas.add(Arrow(free, touch, "joint-force", joint, "direction"))
    sign = shown.reaction(joint, on)
    sign = f"{sign[:-1]},{end.part}}}" if end.part else sign
    text = f"{sign} = {shown.text('force', float(np.linalg.norm(end.force[k])))}"
    canvas.label(text, free, prefer=math.atan2(free[1], free[0]), size=2.8, role="joint-force")


def _turning(
    canvas: Canvas, r: Result, joint: str, k: int, shown: Shown, on: str, directions: list[Array]
) -> None:
    """A curved arrow, away from the forces: the actual or impending rotation of the link relative to the other one."""
    i, j = r.mechanism.joints[joint].links
    sense = friction_sense(r, joint, "pin", k) * (1.0 if on == j else -1.0)
    if not np.isfinite(sense) or sense == 0:
        return
    turns = np.arange(24) * math.pi / 12
    lines = np.array([math.atan2(e[1], e[0]) + side for e in directions for side in (0.0, math.pi)])
    off = np.abs((turns[:, None] - lines + math.pi) % (2 * math.pi) - math.pi).min(axis=1)
    widest = int(np.argmax(off >= off.max() - 1e-6))  # the first of equal gaps, whatever their rounding
    free, half = float(turns[widest]), math.copysign(math.radians(28), sense)
    arc = Arc((0.0, 0.0), WINDOW - 2.5, free - half, free + half, "velocity", True, joint)
    canvas.add(arc)
    words = f"ω_{{{shown.link(on)}/{shown.link(i if on == j else j)}}}"
    canvas.label(words, arc.at(free), prefer=free, size=2.8, role="velocity")


def _words(r: Result, joint: str, k: int, shown: Shown, on: str) -> list[str]:
    """Sentences on the circle's law, the link's sense of rotation, and the friction about the axis."""
    f: Any = getattr(r.mechanism.joints[joint], "friction", None)
    mu = friction_coefficient(r, joint, k)
    kind = "R sin φ" if circle_kind(r.mechanism, r.mechanism.joints[joint]) == "sin" else "μ R"
    law = f"r = {kind}" if r.mechanism.joints[joint].hinge else "r: friction around over the force"
    write = shown.notation
    sizes = f"R = {shown.text('length', float(f.radius))}, μ = {write.given(mu)}, φ = {write.degrees(math.atan(mu))}°"
    out = [f"{law}; {sizes}."]
    i, j = r.mechanism.joints[joint].links
    sense = friction_sense(r, joint, "pin", k) * (1.0 if on == j else -1.0)
    if np.isfinite(sense) and sense != 0:
        verb = "is about to turn" if at_rest(r, joint, "pin", k) else "turns"
        senses = ("counter-clockwise", "clockwise") if sense > 0 else ("clockwise", "counter-clockwise")
        other = i if on == j else j
        words = f"{on} {verb} {senses[0]} against {other}, so each force passes the axis on the side that turns it "
        out.append(f"{words[:1].upper()}{words[1:]}{senses[1]}.")
    collar = getattr(f, "thrust_radius", None)
    moment = abs(float(r.friction_moment(joint)[k] @ bearing_axis(r, joint)[k]))
    about = f"Friction about the axis: {shown.text('moment', moment)}"
    return [*out, f"{about}, with that of the collar." if collar else f"{about}."]
