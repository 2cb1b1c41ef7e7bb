"""Friction of joints in space as contacts for the core: journals, collars, guides, balls, threads.

A contact reads the multipliers of its joint's constraints, which are forces along and moments about its local axes.
f is the axis of the turn or slide, u and v the two after it; ends of a bearing l1 behind and l2 ahead of j's point
along f carry N1 and N2:

    N2_u = (M_v + l1 F_u) / (l1 + l2)    N1_u = F_u - N2_u
    N2_v = (l1 F_v - M_u) / (l1 + l2)    N1_v = F_v - N2_v

The friction of a joint with several freedoms lies along its slip: in a cylindrical joint of axial speed and R times
the turn's rate; in a ball joint the couple is against the relative angular velocity.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from dalembert.algebra import space
from dalembert.analysis.compile.contacts import Contact, Kinds, Read, Row
from dalembert.analysis.compile.pair_table import Geometry, tooth_columns
from dalembert.core.layout import Along, Angle, Helix, Idle, ToothCouple, ToothForce
from dalembert.model.joints.pairs import AXES


def _turning(at: Geometry, axis: int) -> Row:
    after = (axis + 1) % 3
    return Angle, {"a": at.on_i[axis], "b": at.on_i[after], "p": at.on_j[after], "count": 0}


def _sliding(at: Geometry, axis: int) -> Row:
    return Along, {"ui": at.ui, "uj": at.uj, "axis": at.on_i[axis], "pitch": 0.0}


def _ends(guide: tuple[float, float] | None, axis: int) -> list[tuple[Read, Read]]:
    """Forces on the ends of a bearing about a local axis, by components; one in the middle without its lengths."""
    u, v = AXES[(axis + 1) % 3], AXES[(axis + 2) % 3]
    if guide is None:
        return [({f"F{u}": 1.0}, {f"F{v}": 1.0})]
    behind, ahead = guide
    length = behind + ahead
    last = ({f"M{v}": 1 / length, f"F{u}": behind / length}, {f"M{u}": -1 / length, f"F{v}": behind / length})
    near = ({f"M{v}": -1 / length, f"F{u}": ahead / length}, {f"M{u}": 1 / length, f"F{v}": ahead / length})
    return [near, last]


def _revolute(joint: Any, at: Geometry, sine: bool) -> Iterator[Contact]:
    f = joint.friction
    for first, second in _ends(f.guide, 2) if f.radius else ():
        yield Contact("pin", _turning(at, 2), (first, second), f.radius, sine)
    if f.thrust_radius:
        yield Contact("collar", _turning(at, 2), ({"Fz": 1.0},), f.thrust_radius)


def _prismatic(joint: Any, at: Geometry, sine: bool) -> Iterator[Contact]:
    for first, second in _ends(joint.friction.guide, 0):
        yield Contact("guide", _sliding(at, 0), (first, second))


def _cylindrical(joint: Any, at: Geometry, sine: bool) -> Iterator[Contact]:
    """Each end's friction in two parts, along and around, in proportion to the slip's."""
    f = joint.friction
    for k, (first, second) in enumerate(_ends(f.guide, 0), start=1):
        group = k if f.radius else 0
        around, read = bool(f.radius) and sine, (first, second)
        yield Contact("guide", _sliding(at, 0), read, group=group, around=around)
        if f.radius:
            row = _turning(at, 0)
            yield Contact("pin", row, read, f.radius, group=group, reckoned=f.radius, around=around)


def _spherical(joint: Any, at: Geometry, sine: bool) -> Iterator[Contact]:
    """Three parts of a couple about j's axes."""
    read, radius = ({"Fx": 1.0}, {"Fy": 1.0}, {"Fz": 1.0}), joint.friction.radius
    for axis in np.eye(3):
        row = (Idle, {"p": axis, "drawn": space.IDENTITY, "stands": 0.0})
        yield Contact("ball", row, read, radius, sine, ball=True, group=1, reckoned=radius)


def _screw(joint: Any, at: Geometry, sine: bool) -> Iterator[Contact]:
    """Along the helix at the mean radius: the thread's normal force, and the force across the axis."""
    f = joint.friction
    rise = joint.lead / (2 * math.pi)
    size = (rise * rise + f.radius * f.radius) ** 0.5
    climb, across = abs(rise) / size, f.radius / size  # sine and cosine of the helix's angle
    pitch = f.radius * f.radius / rise
    numbers = {"ui": at.ui, "uj": at.uj, "pitch": pitch, "count": 0}
    row = (Helix, {**numbers, "a": at.on_i[0], "b": at.on_i[1], "p": at.on_j[1]})
    gain = 1 / (across * np.cos(f.thread_angle or 0.0))
    yield Contact("thread", row, ({"Fx": gain},), climb)
    yield Contact("pin", row, ({"Fy": 1.0}, {"Fz": 1.0}), climb)


def _gear(joint: Any, at: Geometry, sine: bool | None) -> Iterator[Contact]:
    """Separation, and with friction or an efficiency what teeth lose: where they slide, or as a couple
    (``elements.teeth_in_space`` has the levers)."""
    numbers = {**tooth_columns(joint, at), "count": (0, 0)}
    if joint.pressure_angle:
        row = (ToothForce, {**numbers, "along": np.array([0.0, 1.0])})
        yield Contact("separation", row, ({"T": 1.0},), np.tan(joint.pressure_angle), fixed=True)
    if sine is None:
        return
    normal = 1 / np.cos(joint.pressure_angle)
    if joint.friction is not None:
        yield Contact("mesh", (ToothForce, {**numbers, "along": np.array([1.0, 0.0])}), ({"T": normal},))
        yield Contact("mesh", (ToothCouple, numbers), ({"T": normal},), 0.0)
    else:
        yield Contact(
            "mesh", (ToothCouple, numbers), ({"T": 1.0},), 0.0, own=1.0, coefficient=1 - joint.efficiency
        )


KINDS: Kinds = {
    "gear": _gear,
    "revolute": _revolute,
    "prismatic": _prismatic,
    "cylindrical": _cylindrical,
    "spherical": _spherical,
    "screw": _screw,
}
"""Joints in space that can have friction."""
