"""A guide with friction at a larger scale: bearing faces or corners, their forces, the angle of friction."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.friction.joint_friction import (
    at_rest,
    bears_on_faces,
    friction_coefficient,
    friction_sense,
    guide_contact,
)
from dalembert.analysis.friction.lines_of_action import FaceForce, bearing_faces, close_by, slot_face
from dalembert.analysis.methods.applied_forces import joint_place, slide_direction
from dalembert.arrays import Array
from dalembert.model import GROUND
from dalembert.views.notation import Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import PaperFrame, force_scale, round_up
from dalembert.views.paper.scene import Arc, Arrow, Circle, Line, Point, Polygon, Scene
from dalembert.views.space.space_guides import (
    ends_on_paper,
    ends_words,
    guide_layout,
    slide_on_paper,
    sliding_contact,
)
from dalembert.views.symbols import plane_symbols

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

LONGEST = 20.0
"""Largest force on a guide, mm."""

HALF = 3.2
"""Half height of a block without a given distance of its faces, mm."""


def with_rough_guide(r: Result, joints: Sequence[str]) -> list[str]:
    """Joints that slide with dry friction, among some."""
    m = r.mechanism.joints
    some = [n for n in joints if m[n].slides]
    return [n for n in some if r.friction is not None and getattr(m[n], "friction", None) is not None]


def guide_detail(r: Result, joint: str, k: int, shown: Shown, on: str, words: bool = True) -> Scene:
    """A guide with the normal force, friction and reaction at each place that bears, on one of its links, to scale.

    In space the slide runs to the right, and the forces at each end are turned about it into the paper; the thread of a
    screw is unrolled at its mean radius, with its axis upward.
    """
    faces = faces_of(r, joint, k)
    sign = 1.0 if on == r.mechanism.joints[joint].links[1] else -1.0
    sketch = _Sketch(r, joint, k, shown, faces, slide_on_paper(r, joint, k))
    sketch.block()
    per_mm = force_scale(
        [float(np.hypot(*(f.normal[k] + f.friction[k]))) for f in faces], LONGEST, shown.size("force")
    )
    for face in faces:
        sketch.forces(face, sign, per_mm, on)
    sketch.motion(on)
    kind = f"force at {joint}"
    notes = [f"1 mm = {shown.plain('force', per_mm)}" if faces else "no force"]
    if sketch.per_mm:
        notes[0] += f", {shown.plain('length', sketch.per_mm)}"
    if not sketch.height and bears_on_faces(r, joint):
        notes[0] += "; faces drawn apart, with no half_height given"
    if r.mechanism.dimension == 3:
        notes[0] += f"; {guide_layout(r, joint)}"
    if words:
        notes = [*guide_words(r, joint, k, shown, on), *notes]
    scene = sketch.canvas.scene(f"Joint {joint}: angle of friction", notes=notes)
    scales = {kind: per_mm} | ({f"length at {joint}": sketch.per_mm} if sketch.per_mm else {})
    return Scene(scene.items, scene.title, scales)


def guide_words(r: Result, joint: str, k: int, shown: Shown, on: str) -> list[str]:
    """Sentences on the bearing faces and their forces, the angle of friction, and why friction has its sense."""
    mu = friction_coefficient(r, joint, k)
    angle = f"μ = {shown.notation.given(mu)}, φ = {shown.notation.degrees(math.atan(mu))}°"
    sense = friction_sense(r, joint, sliding_contact(r, joint), k)
    i, j = r.mechanism.joints[joint].links
    out = []
    if np.isfinite(sense) and sense != 0:
        along, against = ("ahead", "back") if sense > 0 else ("back", "ahead")
        verb = "is about to slide" if at_rest(r, joint, sliding_contact(r, joint), k) else "slides"
        words = f"{j} {verb} {along} on {i}, so friction on {j} points {against}."
        out.append(words[:1].upper() + words[1:])
    if r.mechanism.dimension == 3:
        return [f"{angle}.", *ends_words(r, joint, k, shown), *out]
    if not bears_on_faces(r, joint):
        return [f"{angle}.", *out]
    contact = guide_contact(r, joint)
    mode, low, high = contact.mode[k], float(contact.lower[k]), float(contact.upper[k])
    if not math.isfinite(low):
        return [f"{angle}.", *out]
    if slide_direction(r, joint)[k][0] < 0.5:
        out.append("Upper is left of ahead, lower right of it.")
    if mode.endswith("face"):
        load = shown.text("force", low + high)
        return [f"The {mode} bears with {load}{_place(r, joint, k, shown)}; {angle}.", *out]
    first, second = mode.split(", ")
    parts = {"lower": low, "upper": high}
    each = [f"{place} {shown.text('force', parts[place.split()[0]])}" for place in (first, second)]
    return [f"Two corners bear: {' and '.join(each)}; {angle} at each.", *out]


def guide_block(r: Result, joint: str, k: int, frame: PaperFrame) -> Polygon:
    """The block of a guide in a drawing: at its given length, at least long enough to reach the bearing places."""
    e = np.asarray(slide_direction(r, joint)[k], float)
    across = np.array([-e[1], e[0]])
    f: Any = getattr(r.mechanism.joints[joint], "friction", None)
    places = [float(face.along[k]) for face in faces_of(r, joint, k) if close_by(r, face, k)]
    length = getattr(f, "guide", None)
    behind, ahead = length or (0.0, 0.0)
    room = 0.0 if length else 1.5
    low = min(-HALF, *(frame.length(x) - room for x in (-behind, *places)))
    high = max(HALF, *(frame.length(x) + room for x in (ahead, *places)))
    half = max(2.0, frame.length(float(getattr(f, "half_height", None) or 0.0)))
    middle = np.array(frame(joint_place(r, joint)[k]))
    corners = ((low, -half), (high, -half), (high, half), (low, half))
    return Polygon(tuple(_point(middle + x * e + y * across) for x, y in corners), "block")


def guide_corners(r: Result, joint: str, k: int) -> list[Point]:
    """Corners of a guide of given length, metres; none otherwise."""
    f: Any = getattr(r.mechanism.joints[joint], "friction", None)
    if getattr(f, "guide", None) is None:
        return []
    e, middle = np.asarray(slide_direction(r, joint)[k], float), joint_place(r, joint)[k]
    across = np.array([-e[1], e[0]]) * float(f.half_height or 0.0)
    return [_point(middle + x * e + side * across) for x in (-f.guide[0], f.guide[1]) for side in (-1, 1)]


def faces_of(r: Result, joint: str, k: int) -> list[FaceForce]:
    """Bearing forces of a joint that slides with friction at a position; none where they are unknown."""
    if r.mechanism.dimension == 3:
        return ends_on_paper(r, joint)
    faces = bearing_faces(r, joint, k) if bears_on_faces(r, joint) else [slot_face(r, joint)]
    return [f for f in faces if np.isfinite(f.normal[k]).all()]


def _point(p: Point | Array) -> Point:
    return (float(p[0]), float(p[1]))


def _place(r: Result, joint: str, k: int, shown: Shown) -> str:
    """Place where a face bears: ', 0.1051 m ahead of its point'."""
    along = float(bearing_faces(r, joint, k)[0].along[k])
    if abs(along) < 1e-9 * r.compiled.layout.length:
        return ""
    return f", {shown.text('length', abs(along))} {'ahead of' if along > 0 else 'behind'} its point"


class _Sketch:
    """The block of a guide on paper, the slide in its true direction."""

    def __init__(
        self, r: Result, joint: str, k: int, shown: Shown, faces: Sequence[FaceForce], e: Array
    ) -> None:
        self.r, self.joint, self.k, self.shown = r, joint, k, shown
        self.canvas = Canvas()
        self.e = e
        self.n = np.array([-self.e[1], self.e[0]])
        f: Any = getattr(r.mechanism.joints[joint], "friction", None)
        self.ends = getattr(f, "guide", None)
        self.height = float(getattr(f, "half_height", None) or 0.0)
        self.places = [float(face.along[k]) for face in faces]
        self.per_mm = self._scale()
        self.half = self.mm(self.height) if self.height else HALF

    def _scale(self) -> float:
        """Metres per millimetre; 0 where no length is to be drawn."""
        behind, ahead = self.ends or (0.0, 0.0)
        low, high = min([-behind, *self.places]), max([ahead, *self.places])
        need = max((high - low) / 34.0, self.height / 8.0)
        size = self.shown.size("length")
        return round_up(need / size) * size if need > 1e-9 else 0.0

    @property
    def reach(self) -> tuple[float, float]:
        """Ends of the block in mm along the slide from j's point."""
        behind, ahead = self.ends or (0.0, 0.0)
        low, high = (self.mm(x) for x in (min([-behind, *self.places]), max([ahead, *self.places])))
        return (low, high) if self.ends is not None else (low - 6.0, high + 6.0)

    def at(self, along: float, across: float) -> Point:
        """A place of the guide in mm on paper."""
        return _point(along * self.e + across * self.n)

    def mm(self, metres: float) -> float:
        return metres / self.per_mm if self.per_mm else 0.0

    def block(self) -> None:
        """The block, the faces that guide it, j's point."""
        half, (low, high) = self.half, self.reach
        angle = math.atan2(self.e[1], self.e[0])
        corners = ((low, -half), (high, -half), (high, half), (low, half))
        rail = [
            Line((self.at(low - 5, y), self.at(high + 5, y)), "ground") for y in (-half - 0.3, half + 0.3)
        ]
        grounded = GROUND in self.r.mechanism.joints[self.joint].links
        middle = (low + high) / 2
        for y in (-half - 0.3, half + 0.3):
            turned = angle if y < 0 else angle + math.pi
            at, width = self.at(middle, y), high - low + 10
            self.canvas.add(*(plane_symbols.hatch(at, turned, width) if grounded else rail))
        self.canvas.add(Polygon(tuple(self.at(*c) for c in corners), "block"), *plane_symbols.pin((0.0, 0.0)))
        tip = self.at(high + 12.0, 0.0)
        self.canvas.add(Arrow(self.at(high + 6.0, 0.0), tip, "axis-arrow", self.joint, "direction"))
        self.canvas.label("ahead", tip, prefer=angle, size=2.6, role="note")

    def forces(self, face: FaceForce, sign: float, per_mm: float, on: str) -> None:
        """Normal force and friction as the sides of a triangle, the reaction as its third, pushing on the place."""
        side = -math.copysign(self.half, float(face.normal[self.k] @ self.n))
        head = self.at(self.mm(float(face.along[self.k])), side)
        normal, friction = (sign * np.asarray(v[self.k]) / per_mm for v in (face.normal, face.friction))
        corner = (head[0] - normal[0], head[1] - normal[1])
        tail = (corner[0] - friction[0], corner[1] - friction[1])
        size = [float(np.hypot(*v)) * per_mm for v in (normal, friction, normal + friction)]
        kind, sign_of = f"force at {self.joint}", self.shown.reaction(self.joint, on)
        if face.part:
            self.canvas.add(Circle(head, 0.8, "mark"))
            sign_of = f"{sign_of[:-1]},{face.part}}}"
        if not size[2] > 1e-12:
            return
        letter = self.shown.notation.letter
        self.canvas.add(
            Arrow(corner, head, "effort", self.joint, kind, size[0]),
            Arrow(tail, corner, "friction", self.joint, kind, size[1]),
            Arrow(tail, head, "joint-force", self.joint, kind, size[2]),
        )
        self._angle(head, corner, tail)
        for text, spot, role in (
            (f"N{sign_of.removeprefix(letter)} = {self.shown.text('force', size[0])}", corner, "effort"),
            (f"{sign_of} = {self.shown.text('force', size[2])}", tail, "joint-force"),
            (f"{letter}_{{f{sign_of.split('_{')[1]} = {self.shown.text('force', size[1])}", tail, "friction"),
        ):
            middle = ((spot[0] + head[0]) / 2, (spot[1] + head[1]) / 2)
            self.canvas.label(text, spot, middle, size=2.6, role=role)

    def _angle(self, head: Point, corner: Point, tail: Point) -> None:
        """An arc between normal and reaction, with its angle."""
        start, end = (math.atan2(p[1] - head[1], p[0] - head[0]) for p in (corner, tail))
        turn = (end - start + math.pi) % (2 * math.pi) - math.pi
        radius = 0.62 * math.dist(corner, head)
        if abs(turn) < 1e-6 or radius < 1.0:
            return
        arc = Arc(head, radius, start, start + turn, "construction")
        self.canvas.add(arc)
        words = f"φ = {self.shown.notation.degrees(abs(turn))}°"
        self.canvas.label(words, arc.at(start + turn / 2), size=2.6, role="note")

    def motion(self, on: str) -> None:
        """An arrow: the actual or impending sliding of the link relative to the other one."""
        i, j = self.r.mechanism.joints[self.joint].links
        contact = sliding_contact(self.r, self.joint)
        sense = friction_sense(self.r, self.joint, contact, self.k) * (1.0 if on == j else -1.0)
        if not np.isfinite(sense) or sense == 0:
            return
        low, _ = self.reach
        a, b = self.at(low - 13.0, 0.0), self.at(low - 6.0, 0.0)
        ends = (a, b) if sense > 0 else (b, a)
        self.canvas.add(Arrow(*ends, "velocity", self.joint, "direction"))
        other = i if on == j else j
        words = f"v_{{{self.shown.link(on)}/{self.shown.link(other)}}}"
        self.canvas.label(words, a, b, size=2.8, role="velocity")
