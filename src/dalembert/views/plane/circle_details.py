"""Friction circles to scale: the tangent that the reaction takes, the other tangents, and a pin at a larger scale."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.compile.contacts import circle as circle_kind
from dalembert.analysis.friction.friction_circles import (
    FrictionCircle,
    circle_reason,
    friction_circles,
    pin_center,
    two_pins,
)
from dalembert.analysis.friction.joint_friction import (
    friction_circle_radius,
    friction_coefficient,
    friction_sense,
)
from dalembert.arrays import Array
from dalembert.model import GROUND
from dalembert.views.notation import Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import PaperFrame, round_up
from dalembert.views.paper.scene import Arc, Arrow, Circle, Line, Point, Scene
from dalembert.views.plane.outline import link_points

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

SEEN = 3.0
"""Radius in mm below which a friction circle is also drawn at a larger scale."""

BEYOND = 9.0
"""Extension of lines of action beyond what they touch, mm."""

WINDOW = 15.0
"""Radius in mm of the area that a detail of a pin shows."""


def with_friction_circle(r: Result, joints: Sequence[str]) -> list[str]:
    """Joints with a friction circle, among some."""
    return [n for n in joints if friction_circle_radius(r, n)]


def draw_circles(
    canvas: Canvas, r: Result, k: int, frame: PaperFrame, joints: Sequence[str], link: str | None = None
) -> None:
    """Circles of some joints to scale, the lines of their reactions, the other tangents faint.

    With ``link`` the tangents are those of that link alone.
    """
    done: set[tuple[str, str]] = set()
    for name in joints:
        circle = friction_circles(r, name)
        draw_circle(canvas, circle, k, frame)
        two = two_pins(r, name)
        if two is None or link not in (None, two.link):
            _line_of_action(canvas, circle, k, frame)
        elif two.joints not in done:
            done.add(two.joints)
            _common_lines(canvas, r, k, frame, name, circle)


def draw_circle(canvas: Canvas, circle: FrictionCircle, k: int, frame: PaperFrame) -> None:
    """One friction circle to scale; omitted if too small."""
    radius = frame.length(float(circle.radii[k]))
    if radius > 0.4:
        canvas.add(Circle(frame(circle.center[k]), radius, "friction-circle"))


def _line_of_action(canvas: Canvas, circle: FrictionCircle, k: int, frame: PaperFrame) -> None:
    """A short line of action at the point of tangency."""
    if np.isfinite(circle.taken.direction[k]).all() and circle.taken.direction[k].any():
        at, e = frame(circle.taken.point[k]), circle.taken.direction[k]
        canvas.add(Line((onward(at, e, -BEYOND), onward(at, e, BEYOND)), "line-of-action"))


def _common_lines(
    canvas: Canvas, r: Result, k: int, frame: PaperFrame, name: str, circle: FrictionCircle
) -> None:
    """The line of a link that two pins load, from one to the other and beyond, and its other tangents."""
    two = two_pins(r, name)
    assert two is not None
    other = two.joints[two.joints[0] == name]
    toward = pin_center(r, other)[k] - circle.center[k]
    length = frame.length(float(np.hypot(*toward)))
    for line, role in [*((x, "faint") for x in circle.others), (circle.taken, "line-of-action")]:
        e = line.direction[k]
        if not np.isfinite(e).all() or not e.any():
            continue
        e = e * math.copysign(1.0, float(e @ toward))
        at = frame(line.point[k])
        canvas.add(Line((onward(at, e, -BEYOND), onward(at, e, length + BEYOND)), role))


def onward(at: Point, e: Array, distance: float) -> Point:
    return (at[0] + distance * float(e[0]), at[1] + distance * float(e[1]))


def pin_detail(r: Result, joint: str, k: int, shown: Shown, on: str, words: bool = True) -> Scene:
    """A pin at a scale at which its friction circle is seen: the reaction on one of its links, and the reason for its
    line.

    Lengths are to the scale stated; the arrow of the reaction shows its line and sense only.
    """
    circle = friction_circles(r, joint)
    per_mm = round_up(float(circle.radii[k]) / 6.0 / shown.size("length")) * shown.size("length")
    center = circle.center[k]
    frame = PaperFrame(per_mm, (float(center[0]), float(center[1])))
    canvas = Canvas()
    _draw_links(canvas, r, joint, k, shown, on, words)
    radius, journal = frame.length(float(circle.radii[k])), _journal(r, joint) / per_mm
    if journal <= WINDOW:
        canvas.add(Circle((0.0, 0.0), journal, "journal"))
    canvas.add(Circle((0.0, 0.0), radius, "friction-circle"), Circle((0.0, 0.0), 0.5, "mark"))
    for line in circle.others:
        chord(canvas, frame(line.point[k]), line.direction[k], "faint")
    touch = frame(circle.taken.point[k])
    chord(canvas, touch, circle.taken.direction[k], "line-of-action")
    canvas.add(Line(((0.0, 0.0), touch), "dimension"))
    canvas.label(
        f"r = {shown.text('length', float(circle.radii[k]))}", (touch[0] / 2, touch[1] / 2), size=2.6
    )
    _reaction(canvas, r, joint, k, shown, on, touch)
    _turning(canvas, r, joint, k, shown, on)
    notes = [f"1 mm = {shown.plain('length', per_mm)}"]
    if words:
        notes = [f"{_law(r, joint, k, shown)} {_sentence(circle_reason(r, joint, k, on))}", *notes]
    scene = canvas.scene(f"Pin {joint}: friction circle", notes=notes)
    return Scene(scene.items, scene.title, {f"length at {joint}": per_mm})


def _sentence(words: str) -> str:
    return f"{words[:1].upper()}{words[1:]}."


def _law(r: Result, joint: str, k: int, shown: Shown) -> str:
    """'r = R sin φ = 0.024 m with φ = 21.80°.'"""
    kind = "R sin φ" if circle_kind(r.mechanism, r.mechanism.joints[joint]) == "sin" else "μ R"
    radius = shown.text("length", float(friction_circles(r, joint).radii[k]))
    mu = friction_coefficient(r, joint, k)
    large, write = shown.text("length", _journal(r, joint)), shown.notation
    return (
        f"r = {kind} = {radius}; pin R = {large}, μ = {write.given(mu)}, φ = {write.degrees(math.atan(mu))}°."
    )


def _journal(r: Result, joint: str) -> float:
    """Radius of the pin, m."""
    f: Any = getattr(r.mechanism.joints[joint], "friction", None)
    return float(f.radius)


def _draw_links(canvas: Canvas, r: Result, joint: str, k: int, shown: Shown, on: str, both: bool) -> None:
    """The links of a pin as lines towards their other points."""
    center = friction_circles(r, joint).center[k]
    for link in r.mechanism.joints[joint].links:
        if link == GROUND or not (both or link == on):
            continue
        directions = [np.asarray(p) - center for p in link_points(r, link, k).values()]
        directions = [w / np.hypot(*w) for w in directions if np.hypot(*w) > 1e-9]
        for w in directions[:3]:
            canvas.add(Line(((0.0, 0.0), onward((0.0, 0.0), w, WINDOW)), "link"))
        if directions:
            canvas.label(shown.link(link), onward((0.0, 0.0), directions[0], WINDOW), size=3.0, role="note")


def chord(canvas: Canvas, at: Point, e: Array, role: str) -> None:
    """Chord of the detail's area through a point."""
    if not np.isfinite([*at, *e]).all() or not np.any(e):
        return
    foot = at[0] * float(e[0]) + at[1] * float(e[1])
    half = math.sqrt(max(WINDOW**2 - (at[0] ** 2 + at[1] ** 2 - foot**2), 1.0))
    canvas.add(Line((onward(at, e, -foot - half), onward(at, e, -foot + half)), role))


def _reaction(canvas: Canvas, r: Result, joint: str, k: int, shown: Shown, on: str, touch: Point) -> None:
    """The reaction on a link: its sense on its line, and its magnitude as text."""
    force = r.reaction(joint, on)[k]
    size = float(np.hypot(*force))
    if not friction_circles(r, joint).taken.direction[k].any():
        return
    e = force / size
    middle = np.mean([np.asarray(p) for p in link_points(r, on, k).values()] or [np.zeros(2)], axis=0)
    inward = float((middle - friction_circles(r, joint).center[k]) @ e) > 0
    free = onward(touch, e, -WINDOW if inward else WINDOW)
    ends = (free, touch) if inward else (touch, free)
    canvas.add(Arrow(*ends, "joint-force", joint, "direction"))
    text = f"{shown.reaction(joint, on)} = {shown.text('force', size)}"
    canvas.label(text, free, prefer=math.atan2(free[1], free[0]), size=2.8, role="joint-force")


def _turning(canvas: Canvas, r: Result, joint: str, k: int, shown: Shown, on: str) -> None:
    """A curved arrow: the actual or impending rotation of the link relative to the other one."""
    sense = friction_sense(r, joint, "pin", k) * (1.0 if on == r.mechanism.joints[joint].links[1] else -1.0)
    if not np.isfinite(sense) or sense == 0:
        return
    directions = [
        np.asarray(p) - friction_circles(r, joint).center[k] for p in link_points(r, on, k).values()
    ]
    away = sum((w / max(float(np.hypot(*w)), 1e-9) for w in directions), np.zeros(2))
    force = r.reaction(joint, on)[k]
    free = math.atan2(-float(away[1]), -float(away[0])) if away.any() else 0.0
    free += _clear(free, force)
    half = math.copysign(math.radians(32), sense)
    arc = Arc((0.0, 0.0), WINDOW - 2.5, free - half, free + half, "velocity", True, joint)
    canvas.add(arc)
    i, j = r.mechanism.joints[joint].links
    other = i if on == j else j
    words = f"ω_{{{shown.link(on)}/{shown.link(other)}}}"
    canvas.label(words, arc.at(free), prefer=free, size=2.8, role="velocity")


def _clear(free: float, force: Array) -> float:
    """A rotation that keeps the curved arrow off the line of the reaction."""
    if not np.isfinite(force).all() or not np.any(force):
        return 0.0
    line = math.atan2(float(force[1]), float(force[0]))
    off = (free - line + math.pi / 2) % math.pi - math.pi / 2  # -90 to 90 deg from the line
    need = math.radians(55.0)
    return 0.0 if abs(off) >= need else math.copysign(need, off) - off
