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
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from dalembert.algebra import space
from dalembert.analysis.compile.contacts import circle, coefficient, friction_on, resting_coefficient, rubs
from dalembert.analysis.compile.pair_table import AXES, Geometry, reaction_rows
from dalembert.analysis.compile.plane_rows import RowBuilder
from dalembert.arrays import Array, Ints
from dalembert.core.friction.contact_equations import Contacts
from dalembert.core.layout import Along, Angle, Helix, Idle, Rows
from dalembert.model import Mechanism

Read = dict[str, float]


@dataclass(frozen=True)
class Bearing:
    """One contact: its row; three arguments, each a sum of named reactions; ``group`` of contacts that share a slip."""

    kind: str
    row: tuple[type, dict[str, Any]]
    read: tuple[Read, Read, Read]
    lever: float = 1.0
    circle: bool = False
    ball: bool = False
    group: int = 0
    reckoned: float = 1.0
    """Length that turns the rate of its row into a speed."""
    around: bool = False


def space_contacts(
    m: Mechanism, constraints: Rows, ends: list[tuple[int, int]], at: tuple[Geometry, ...]
) -> tuple[Contacts, tuple[str, ...]] | None:
    """All contacts and the kind of each; None without friction."""
    if not friction_on(m):
        return None
    rows = RowBuilder(constraints.links, 3)
    found: list[tuple[int, Bearing, float, float]] = []
    for k, joint in enumerate(m.joints.values()):
        if rubs(m, joint):
            mu, resting = coefficient(m, joint), resting_coefficient(m, joint)
            for bearing in KINDS[joint.type](joint, at[k], circle(m, joint) == "sin"):
                kind, numbers = bearing.row
                rows.add(kind, k, ends[k], **numbers)
                found.append((k, bearing, mu, resting))
    read = np.zeros((3, len(found), constraints.count))
    for e, (k, bearing, _, _) in enumerate(found):
        place = reaction_rows(list(m.joints.values())[k], int(np.flatnonzero(constraints.joint == k)[0]))
        for part, sums in enumerate(bearing.read):
            for name, factor in sums.items():
                read[part, e, place[name]] += factor
    return _stack(rows.rows(), found, read), tuple(bearing.kind for _, bearing, _, _ in found)


def _stack(rows: Rows, found: list[tuple[int, Bearing, float, float]], read: Array) -> Contacts:
    count = len(found)
    none, no, zero = np.full(count, -1, np.intp), np.zeros(count, bool), np.zeros(count)
    bearings = [b for _, b, _, _ in found]
    return Contacts(
        rows=rows,
        joint=np.array([k for k, _, _, _ in found], np.intp),
        first=none,
        second=none,
        couple=none,
        tilt=np.zeros((count, 2)),
        gain=np.ones(count),
        lever=np.array([b.lever for b in bearings]),
        coefficient=np.array([mu for _, _, mu, _ in found]),
        resting=np.array([mu for _, _, _, mu in found]),
        circle=np.array([b.circle for b in bearings]),
        signed=no,
        fixed=no,
        led=np.arange(count),
        reach=zero,
        read=read,
        ball=np.array([b.ball for b in bearings]),
        group=_groups(found),
        reckoned=np.array([b.reckoned for b in bearings]),
        around=np.array([b.around for b in bearings]),
    )


def _groups(found: list[tuple[int, Bearing, float, float]]) -> Ints:
    """One number for contacts of one joint and group; contacts of group 0 stand alone."""
    keys = [(k, b.group, 0 if b.group else n) for n, (k, b, _, _) in enumerate(found)]
    return np.array([keys.index(key) for key in keys], np.intp)


def _turning(at: Geometry, axis: int) -> tuple[type, dict[str, Any]]:
    after = (axis + 1) % 3
    return Angle, {"a": at.on_i[axis], "b": at.on_i[after], "p": at.on_j[after], "count": 0}


def _sliding(at: Geometry, axis: int) -> tuple[type, dict[str, Any]]:
    return Along, {"ui": at.ui, "uj": at.uj, "axis": at.on_i[axis], "pitch": 0.0}


def _ends(guide: tuple[float, float] | None, axis: int) -> list[tuple[Read, Read]]:
    """Forces on the ends of a bearing about a local axis, by components; one in the middle without its lengths."""
    u, v = AXES[(axis + 1) % 3], AXES[(axis + 2) % 3]
    if guide is None:
        return [({f"F{u}": 1.0}, {f"F{v}": 1.0})]
    behind, ahead = guide
    whole = behind + ahead
    last = ({f"M{v}": 1 / whole, f"F{u}": behind / whole}, {f"M{u}": -1 / whole, f"F{v}": behind / whole})
    near = ({f"M{v}": -1 / whole, f"F{u}": ahead / whole}, {f"M{u}": 1 / whole, f"F{v}": ahead / whole})
    return [near, last]


def _revolute(joint: Any, at: Geometry, sine: bool) -> Iterator[Bearing]:
    f = joint.friction
    for first, second in _ends(f.guide, 2) if f.radius else ():
        yield Bearing("pin", _turning(at, 2), (first, second, {}), f.radius, sine)
    if f.thrust_radius:
        yield Bearing("collar", _turning(at, 2), ({"Fz": 1.0}, {}, {}), f.thrust_radius)


def _prismatic(joint: Any, at: Geometry, sine: bool) -> Iterator[Bearing]:
    for first, second in _ends(joint.friction.guide, 0):
        yield Bearing("guide", _sliding(at, 0), (first, second, {}))


def _cylindrical(joint: Any, at: Geometry, sine: bool) -> Iterator[Bearing]:
    """Each end's friction in two parts, along and around, in proportion to the slip's."""
    f = joint.friction
    for k, (first, second) in enumerate(_ends(f.guide, 0), start=1):
        group = k if f.radius else 0
        around, read = bool(f.radius) and sine, (first, second, Read())
        yield Bearing("guide", _sliding(at, 0), read, group=group, around=around)
        if f.radius:
            row = _turning(at, 0)
            yield Bearing("pin", row, read, f.radius, group=group, reckoned=f.radius, around=around)


def _spherical(joint: Any, at: Geometry, sine: bool) -> Iterator[Bearing]:
    """Three parts of a couple about j's axes."""
    read: tuple[Read, Read, Read] = ({"Fx": 1.0}, {"Fy": 1.0}, {"Fz": 1.0})
    for axis in np.eye(3):
        row = (Idle, {"p": axis, "drawn": space.IDENTITY, "stands": 0.0})
        yield Bearing("ball", row, read, joint.friction.radius, sine, True, 1, joint.friction.radius)


def _screw(joint: Any, at: Geometry, sine: bool) -> Iterator[Bearing]:
    """Along the helix at the mean radius: the thread's normal force, and the force across the axis."""
    f = joint.friction
    rise = joint.lead / (2 * math.pi)
    climb = math.atan2(abs(rise), f.radius)
    pitch = f.radius * f.radius / rise
    numbers = {"ui": at.ui, "uj": at.uj, "pitch": pitch, "count": 0}
    row = (Helix, {**numbers, "a": at.on_i[0], "b": at.on_i[1], "p": at.on_j[1]})
    gain = 1 / (math.cos(climb) * math.cos(f.thread_angle or 0.0))
    yield Bearing("thread", row, ({"Fx": gain}, {}, {}), math.sin(climb))
    yield Bearing("pin", row, ({"Fy": 1.0}, {"Fz": 1.0}, {}), math.sin(climb))


KINDS: dict[str, Callable[[Any, Geometry, bool], Iterator[Bearing]]] = {
    "revolute": _revolute,
    "prismatic": _prismatic,
    "cylindrical": _cylindrical,
    "spherical": _spherical,
    "screw": _screw,
}
"""Joints in space that can have friction."""
