"""Friction in views through a camera: its forces and couples, circles of journals, sliding directions of guides."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.bearing_ends import bearing_axis
from dalembert.analysis.friction.joint_friction import friction_sense
from dalembert.analysis.methods.applied_forces import joint_place
from dalembert.arrays import Array
from dalembert.model import GROUND
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.scene import Arrow, Line, Scene
from dalembert.views.plane.guide_details import guide_detail, with_rough_guide
from dalembert.views.space.journal_details import circle_radius, journal_detail, journals
from dalembert.views.space.space_arrows import Arrows
from dalembert.views.space.space_view import Sight

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.views.notation import Shown


SLID = 9.0
"""Length of the arrow for the sliding direction of a link, mm."""


def friction_wrench(r: Result, joint: str, link: str, k: int) -> tuple[Array, Array]:
    """Friction's force and couple on a link at a position, ground axes."""
    return r.friction_force(joint, link)[k], r.friction_moment(joint, link)[k]


def draw_friction(arrows: Arrows, joint: str, link: str, k: int) -> None:
    """A joint's friction on a link: force and couple with their sizes, the circle of a journal, the direction of a
    slide."""
    r, shown = arrows.r, arrows.shown
    at, (force, couple) = arrows.s(joint_place(r, joint)[k]), friction_wrench(r, joint, link, k)
    i, j = r.mechanism.joints[joint].links
    pair = shown.pair(i if link == j else j, link)
    parts = (("force", force, shown.notation.letter), ("moment", couple, "M"))
    for turning, (kind, v, letter) in enumerate(parts):
        size = float(np.linalg.norm(v))
        if size > arrows.floor[turning]:
            text = f"{letter}_{{f{pair}}} = {shown.text(kind, size)}"
            arrows.vector(at, v, "friction", joint, text, bool(turning))
    if journals(r, k, [joint]):
        draw_circle(arrows.canvas, r, arrows.s, joint, k)
    if with_rough_guide(r, [joint]) and not r.mechanism.joints[joint].pair.threaded:
        _slide(arrows, joint, link, k)


def draw_circle(canvas: Canvas, r: Result, s: Sight, joint: str, k: int) -> None:
    """The friction circle of a journal about its axis, as projected; omitted if too small."""
    radius = circle_radius(r, joint, k)
    if radius / s.frame.per_mm < 0.4:
        return
    axis, middle = bearing_axis(r, joint)[k], joint_place(r, joint)[k]
    u = np.cross(axis, np.eye(3)[np.abs(axis).argmin()])
    u, angles = u / np.linalg.norm(u), np.linspace(0, 2 * math.pi, 49)[:, None]
    rim = middle + radius * (np.cos(angles) * u + np.sin(angles) * np.cross(axis, u))
    canvas.add(Line(tuple(s(p) for p in rim), "friction-circle"))


def _slide(arrows: Arrows, joint: str, link: str, k: int) -> None:
    """An arrow beside the joint: the actual or impending sliding of the link relative to the other one."""
    r, shown = arrows.r, arrows.shown
    i, j = r.mechanism.joints[joint].links
    sense = friction_sense(r, joint, "guide", k) * (1.0 if link == j else -1.0)
    x, y = arrows.s.camera(bearing_axis(r, joint)[k]) * math.copysign(SLID, sense)
    length = math.hypot(x, y)
    if not np.isfinite(sense) or sense == 0 or length < 1.0:
        return
    at = arrows.s(joint_place(r, joint)[k])
    tail = (at[0] - 4.0 * y / length - x / 2, at[1] + 4.0 * x / length - y / 2)
    head = (tail[0] + x, tail[1] + y)
    arrows.canvas.add(Arrow(tail, head, "velocity", joint, "direction"))
    words = f"v_{{{shown.link(link)}/{shown.link(i if link == j else j)}}}"
    arrows.canvas.label(words, head, tail, prefer=math.atan2(y, x), size=2.6, role="velocity")


def friction_details(r: Result, k: int, shown: Shown, link: str | None = None) -> list[Scene]:
    """Journals seen along their axes, guides from the side, threads unrolled; for one link, or for all with words."""
    joints = [n for n in r.joints if link is None or link in r.mechanism.joints[n].links]
    known = [n for n in with_rough_guide(r, joints) if np.isfinite(r.reaction(n)[k]).all()]
    some = [(n, journal_detail) for n in journals(r, k, joints)] + [(n, guide_detail) for n in known]
    return [detail(r, n, k, shown, link or _holder(r, n), link is None) for n, detail in some]


def _holder(r: Result, joint: str) -> str:
    """The link whose reaction a detail shows: j, unless that is ground."""
    i, j = r.mechanism.joints[joint].links
    return i if j == GROUND else j
