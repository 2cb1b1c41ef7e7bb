"""A link, or barrel and rod that slide in each other, as one straight column at every position.

Mechanics: docs/theory.md 10.4.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.compile.load_arrays import point_of
from dalembert.analysis.friction.bearing_ends import bearing_axis
from dalembert.analysis.methods.applied_forces import joint_place, slide_direction
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.machine.link_axes import LinkAxes, in_space
from dalembert.machine.members.end_conditions import LOAD, BucklingColumn, ColumnNode

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.machine.members.member_forces import MemberCurve, MemberForces

NEAR = 1e-9
"""Part of a column's length within which two places are one."""


class PlacedMember:
    """A member at every position: start (P, 3), axes (P, 3, 3) in rows t, y, z; joints' places (P,) on it."""

    def __init__(self, forces: MemberForces, curve: MemberCurve) -> None:
        r, e = forces.result, curve.member
        local = LinkAxes(r, forces.link)
        origin = in_space(r.position(forces.link))
        self.link, self.length = forces.link, e.length
        self.start = np.einsum("pij,j->pi", local.rotation, e.start) + origin
        self.axes = np.einsum("ki,pji->pkj", e.axes, local.rotation)
        self.joints: dict[str, Array] = {}
        for name, joint in r.mechanism.joints.items():
            if forces.link in joint.links:
                place = local.to_link(joint_place(r, name) - r.position(forces.link))
                self.joints[name] = e.foot(place)[0]
        for load in r.unknown_loads:
            described: Any = r.mechanism.loads[load]
            if described.on == forces.link:
                place = in_space(point_of(r.mechanism, forces.link, described.at or "center"))
                self.joints[LOAD.format(load)] = np.tile(e.foot(place)[0], len(origin))


NOISE = 1e-13
"""Part of the machine's largest joint force that is rounding."""


@dataclass(frozen=True)
class Strut:
    """Members that are one column: one, or the barrel's and the rod's, which slide by the joint ``inside``."""

    forces: tuple[MemberForces, ...] = field(repr=False)
    curves: tuple[MemberCurve, ...] = field(repr=False)
    inside: str = ""

    @cached_property
    def members(self) -> tuple[PlacedMember, ...]:
        """The members, placed."""
        return tuple(PlacedMember(*pair) for pair in zip(self.forces, self.curves, strict=True))

    def compression(self) -> Array:
        """Greatest compression along it (P,), N, at least 0 and without rounding; NaN where unknown."""
        compressions = [np.maximum(0.0, -curve.extremes("axial")[0]) for curve in self.curves]
        largest = np.abs(np.nan_to_num(self.forces[0].result.force_array)).max(axis=(1, 2), initial=0.0)
        greatest = np.maximum.reduce(compressions)
        return np.where(greatest <= NOISE * largest, 0.0, greatest)

    def is_bent(self, part: float) -> bool:
        """True if bending moments are more than this part of axial force times length, each the greatest."""
        for forces, curve in zip(self.forces, self.curves, strict=True):
            most = {of: np.nanmax(np.abs(curve.greatest(of)[0]), initial=0.0) for of in forces.names}
            bending = max(x for of, x in most.items() if of.startswith("bending"))
            if bending > part * most["axial"] * curve.member.length:
                return True
        return False

    def column(self, k: int) -> tuple[BucklingColumn, float]:
        """Its nodes at position k, and the distance from the start where the second member begins.

        Raises ModelError where barrel and rod do not reach each other.
        """
        first, *more = self.members
        if not more:
            return BucklingColumn(
                _nodes(first, k, 0.0, 1.0, first.length), first.start[k], first.axes[k]
            ), first.length
        (rod,) = more
        t = first.axes[k, 0]
        ends = sorted([0.0, float(t @ rod.axes[k, 0]) * rod.length])
        offset = float(t @ (rod.start[k] - first.start[k]))
        low, high = offset + ends[0], offset + ends[1]
        sense = 1.0 if low + high > first.length else -1.0
        start, far = (0.0, high) if sense > 0 else (first.length, low)
        total, gland = sense * (far - start), first.length
        inner = sense * ((low if sense > 0 else high) - start)
        if inner > gland * (1 + NEAR):
            where = f"position {k + 1}"
            what = f"{first.link!r} and {rod.link!r} do not reach each other at {where}"
            raise ModelError(what, "let their members overlap: members: [[A, B]]", ("links", rod.link))
        gland = min(gland, total)
        across = sense * first.axes[k, 1]
        axes = np.array([sense * t, across, np.cross(sense * t, across)])
        origin = first.start[k] + start * t
        turned = float(np.sign(t @ rod.axes[k, 0]))
        nodes = [*_nodes(first, k, start, sense, total, self.inside)]
        nodes += _nodes(rod, k, start - offset, sense, total, self.inside, turned)
        column = BucklingColumn(_merged(nodes, gland, total), origin, axes, self.inside)
        if min(column.spans()) <= NEAR * total:
            what = f"joints of {first.link!r} and of {rod.link!r} are at one place at position {k + 1}"
            raise ModelError(what, "give each an effective_length", ("links", rod.link))
        return column, gland


def _nodes(
    e: PlacedMember, k: int, start: float, sense: float, total: float, inside: str = "", turned: float = 1.0
) -> tuple[ColumnNode, ...]:
    """The places of a member's joints along a column that begins at ``start`` of it, and for one member its ends."""
    joints_at: dict[float, list[str]] = {} if inside else {0.0: [], total: []}
    for joint, places in e.joints.items():
        if joint != inside and np.isfinite(places[k]):
            s = sense * (turned * float(places[k]) - start)
            near = next((x for x in joints_at if abs(x - s) <= NEAR * total), s)
            joints_at.setdefault(near, []).append(joint)
    return tuple(ColumnNode(e.link, s, tuple(some)) for s, some in sorted(joints_at.items()))


def _merged(nodes: Iterable[ColumnNode], gland: float, total: float) -> tuple[ColumnNode, ...]:
    """Nodes of both members in order, with ends and the place where the second member begins."""
    known = [n for n in nodes if -NEAR * total <= n.s <= total * (1 + NEAR)]
    first, last = known[0].link, known[-1].link
    for s, link in ((0.0, first), (gland, first), (total, last)):
        if not any(abs(n.s - s) <= NEAR * total for n in known):
            known.append(ColumnNode(link, s))
    known.sort(key=lambda n: n.s)
    return tuple(known)


def slides_along(r: Result, joint: str, forces: MemberForces, rod: MemberForces) -> bool:
    """True if a joint lets two links of one member each slide along their common line at all positions."""
    described = r.mechanism.joints[joint]
    straight = described.pair.slides == "x" and {*"yz"} <= {*described.pair.moments}
    if not (described.guides or straight) or len(forces.curves) > 1 or len(rod.curves) > 1:
        return False
    a, b = (PlacedMember(f, f.curves[0]) for f in (forces, rod))
    axis = in_space(slide_direction(r, joint) if r.mechanism.dimension == 2 else bearing_axis(r, joint))
    span = b.start - a.start
    gaps = [np.cross(a.axes[:, 0], v) for v in (axis, b.axes[:, 0], span / (a.length + b.length))]
    return all(np.nanmax(np.abs(gap), initial=0.0) <= 1e3 * NEAR for gap in gaps)


def rod_of(r: Result, link: str, table: dict[str, MemberForces]) -> tuple[str, str]:
    """The joint and the link that slides by it in a link along its line, both empty where there is none."""
    for name, joint in r.mechanism.joints.items():
        i, j = joint.links
        other = j if i == link else i if j == link else ""
        if other in table and slides_along(r, name, table[link], table[other]):
            return name, other
    return "", ""
