"""Guides and threads in space drawn in a plane: sliding direction and bearing ends, also described in sentences."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.friction.bearing_ends import bearing_ends, thread
from dalembert.analysis.friction.lines_of_action import FaceForce
from dalembert.analysis.methods.applied_forces import slide_direction
from dalembert.arrays import Array

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.views.notation import Shown


def sliding_contact(r: Result, joint: str) -> str:
    """Kind of the contact of a joint that slides."""
    return "thread" if r.mechanism.joints[joint].pair.threaded else "guide"


def slide_on_paper(r: Result, joint: str, k: int) -> Array:
    """The slide (2,): of a screw up its thread, whose positive turn is to the right; else in space to the right."""
    if r.mechanism.dimension == 2:
        return np.asarray(slide_direction(r, joint)[k], float)
    if not r.mechanism.joints[joint].pair.threaded:
        return np.array([1.0, 0.0])
    climb = thread(r, joint).climb
    return np.array([math.copysign(math.cos(climb), climb), abs(math.sin(climb))])


def guide_layout(r: Result, joint: str) -> str:
    """Description of the projection in which a spatial guide is drawn."""
    if r.mechanism.joints[joint].pair.threaded:
        return "the thread unrolled at its mean radius, the axis upward"
    return "forces turned about the slide into the paper"


def ends_on_paper(r: Result, joint: str) -> list[FaceForce]:
    """Bearing forces of a guide: behind on the lower face, ahead on the nearer side; of a thread on its flank."""
    if r.mechanism.joints[joint].pair.threaded:
        return _flank(r, joint)
    ends = [end for end in bearing_ends(r, joint, "guide") if np.isfinite(end.force).all()]
    out = []
    for end in ends:
        side = np.where((ends[0].force * end.force).sum(axis=-1) < 0, -1.0, 1.0)
        normal, at = side * np.linalg.norm(end.force, axis=-1), np.zeros((len(side), 2))
        along = np.full(len(side), end.along)
        forces = (np.stack([0 * side, normal], axis=-1), np.stack([end.friction, 0 * side], axis=-1))
        out.append(FaceForce(end.part, at, along, *forces))
    return out


def _flank(r: Result, joint: str) -> list[FaceForce]:
    screw, e = thread(r, joint), slide_on_paper(r, joint, 0)
    up = np.array([-math.sin(screw.climb), math.cos(screw.climb)])
    normal, friction = screw.normal[:, None] * up, screw.friction[:, None] * e
    return [FaceForce("", 0 * normal, 0 * screw.normal, normal, friction)]


def ends_words(r: Result, joint: str, k: int, shown: Shown) -> list[str]:
    """Sentences on the force at each end of a guide and the angle between the two; on the lead angle of a thread."""
    if r.mechanism.joints[joint].pair.threaded:
        return _thread_words(r, joint, k, shown)
    ends = [end.force[k] for end in bearing_ends(r, joint, "guide")]
    size = [float(np.linalg.norm(v)) for v in ends]
    figures = [shown.text("force", x) for x in size]
    ahead = "Ahead is along x' of the joint."
    if len(ends) < 2:
        return [f"The guide bears with {figures[0]}.", ahead]
    words = f"The guide bears with {figures[0]} behind and {figures[1]} ahead"
    if min(size) > 1e-9 * max(size):
        angle = math.acos(np.clip(ends[0] @ ends[1] / (size[0] * size[1]), -1.0, 1.0))
        words += f", actually {shown.notation.degrees(angle)}° apart"
    return [f"{words}.", ahead]


def _thread_words(r: Result, joint: str, k: int, shown: Shown) -> list[str]:
    f: Any = getattr(r.mechanism.joints[joint], "friction", None)
    screw = thread(r, joint)
    climb, write = abs(screw.climb), shown.notation
    slope = math.atan2(abs(screw.friction[k]), abs(screw.normal[k]))
    more = [f"flanks at {write.degrees(f.thread_angle)}°"] if f.thread_angle else []
    more += ["the force across the axis"] if screw.across[k] > 1e-9 * abs(screw.normal[k]) else []
    words = f"Mean radius {shown.text('length', float(f.radius))}, lead angle λ = {write.degrees(climb)}°"
    words += f"; with {' and '.join(more)} the angle of friction is {write.degrees(slope)}°" if more else ""
    locks = "more than λ, so the axial force alone cannot turn the thread"
    turns = "less than λ, so the axial force can turn the thread"
    return [f"{words}, {locks if slope >= climb else turns}.", "Ahead is along x' of the joint."]
