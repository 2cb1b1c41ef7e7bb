"""Joints' reactions with their friction on the lines on which they act: tangent to friction circles, on bearing faces.

A free body then shows forces alone, each at a place where the links touch, and no couples of friction.
Mechanics: docs/theory.md 6.1.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.friction.friction_circles import friction_circles
from dalembert.analysis.friction.joint_friction import (
    bears_on_faces,
    friction_circle_radius,
    friction_of,
    guide_contact,
)
from dalembert.analysis.methods.applied_forces import (
    Action,
    full_actions,
    joint_actions,
    joint_place,
    magnitude,
    slide_direction,
)
from dalembert.analysis.methods.elements.belt_strands import pulls_of
from dalembert.arrays import Array

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


ROUNDING = 1e-12
"""A couple below this part of the moment of its force is rounding."""


@dataclass(frozen=True)
class FaceForce:
    """Force of a guide on j at one place: ``part`` is empty for a face in full contact, else `ahead` or `behind`.

    at (P, 2); along (P,): distance of the place from j's point along the slide, m; normal (P, 2) and friction (P, 2) on
    j
    """

    part: str
    at: Array
    along: Array
    normal: Array
    friction: Array


def acting_lines(r: Result, k: int) -> tuple[Action, ...]:
    """Everything that acts on the links, each joint's reaction unsplit and on its line of action.

    The reaction of a pin touches its friction circle; that of a slider acts on the face that bears, or, where two
    corners bear at position ``k``, as two forces; those of belts and ropes are the pulls of their strands.
    Where a guide of no given length would bear far away, its force is left at j's point with its couple. Without
    friction and belts these are ``actions(r)``.

    >>> import dalembert as da
    >>> from dalembert.bundled import cases
    >>> r = da.statics(da.load(cases()["seed-002-7a-engine-friction-circles"]))
    >>> [(a.of, float(abs(a.couple).max()) < 1e-9) for a in acting_lines(r, 0) if a.link == "rod"]
    [('A', True), ('B', True)]
    """
    return tuple(part for a in full_actions(r) for part in (_acting(r, a, k) if a.kind == "joint" else [a]))


def _acting(r: Result, a: Action, k: int) -> list[Action]:
    """One unsplit reaction on its line, at its corners, or in its strands."""
    if r.mechanism.joints[a.of].WRAPPED:
        return [*pulls_of(r, r, a)]
    if r.friction is None:
        return [a]
    if r.mechanism.joints[a.of].wheels:  # the teeth's friction is a couple
        return [part for part in joint_actions(r) if (part.of, part.link) == (a.of, a.link)]
    if friction_circle_radius(r, a.of):
        at = friction_circles(r, a.of).taken.point
        return [_shift(a, at)]
    if not r.mechanism.joints[a.of].guides:
        return [a]
    sign = 1.0 if a.link == r.mechanism.joints[a.of].links[1] else -1.0
    faces = bearing_faces(r, a.of, k) if bears_on_faces(r, a.of) else _plain(r, a.of)
    if len(faces) == 1:
        return [_shift(a, faces[0].at) if close_by(r, faces[0], k) else a]
    corners = [
        Action(a.of, "joint", "", a.link, a.by, f.at, sign * (f.normal + f.friction), 0 * a.couple, f.part)
        for f in faces
    ]
    return [*corners, *_damping(r, a, sign)]


def _damping(r: Result, a: Action, sign: float) -> list[Action]:
    """Contribution of damping to a slider's reaction, at its point: no corner bears it."""
    if r.friction is None:
        return []
    k = r.joints.index(a.of)
    force, couple = sign * r.friction.viscous_force[:, k], sign * r.friction.viscous_moment[:, k]
    named = f"damping of {a.of}"
    return [Action(a.of, "friction", named, a.link, a.by, a.at, force, couple)] if force.any() else []


def close_by(r: Result, face: FaceForce, k: int) -> bool:
    """True if a face bears no farther from j's point than the size of the mechanism."""
    return abs(float(face.along[k])) <= r.compiled.layout.length


def _shift(a: Action, at: Array) -> Action:
    """The same force at another place, with what is left of its couple; what is rounding of it counts as nothing."""
    turned = replace(a, at=at, couple=np.zeros_like(a.couple)).moment(a.at)
    left = a.couple - turned
    nothing = np.abs(left) <= ROUNDING * (np.abs(turned) + magnitude(a.force) * magnitude(a.at - at))
    return replace(a, at=at, couple=np.where(nothing, 0.0, left))


def _plain(r: Result, joint: str) -> list[FaceForce]:
    """A slider without friction: its normal force on the line where it also gives the couple."""
    e, normal = slide_direction(r, joint), r.reaction(joint)
    across = np.stack([-e[:, 1], e[:, 0]], axis=-1)
    along = _ratio(r.reaction_moment(joint), (normal * across).sum(axis=-1))
    return [FaceForce("", joint_place(r, joint) + along[:, None] * e, along, normal, np.zeros_like(normal))]


def slot_face(r: Result, joint: str) -> FaceForce:
    """Force of a slot with friction on its pin: normal force and friction at the pin."""
    f, _ = friction_of(r)
    normal = r.reaction(joint) - r.friction_force(joint) - f.viscous_force[:, r.joints.index(joint)]
    return FaceForce("", joint_place(r, joint), np.zeros(len(normal)), normal, r.friction_force(joint))


def bearing_faces(r: Result, joint: str, k: int) -> list[FaceForce]:
    """Forces of a guide with friction on j, at the face or the two corners that bear at position ``k``.

    On one face at M / N from j's point, as far as the faces are apart from it; at corners l2 ahead and l1 behind.
    """
    contact, part = guide_contact(r, joint), r.mechanism.joints[joint]
    f: Any = getattr(part, "friction", None)
    e, at, height = slide_direction(r, joint), joint_place(r, joint), float(f.half_height or 0.0)
    across = np.stack([-e[:, 1], e[:, 0]], axis=-1)
    friction = (r.friction_force(joint) * e).sum(axis=-1)
    total = contact.lower + contact.upper

    def face(part: str, along: Array, side: Array, load: Array) -> FaceForce:
        place = at + along[:, None] * e - (side * height)[:, None] * across
        share = _ratio(friction * load, total)
        return FaceForce(part, place, along, (side * load)[:, None] * across, share[:, None] * e)

    one = np.ones_like(total)
    if " ahead" not in contact.mode[k]:
        side = np.where(contact.normal < 0, -one, one)
        return [face("", _ratio(contact.couple, contact.normal), side, np.abs(contact.normal))]
    behind, ahead = f.guide
    lower_ahead = contact.mode[k].startswith("lower ahead")
    first, second = (contact.lower, contact.upper) if lower_ahead else (contact.upper, contact.lower)
    side = one if lower_ahead else -one
    return [face("ahead", ahead * one, side, first), face("behind", -behind * one, -side, second)]


def _ratio(a: Array, b: Array) -> Array:
    """a / b, 0 where b is nothing."""
    return np.asarray(np.where(b != 0, a / np.where(b != 0, b, 1.0), 0.0))
