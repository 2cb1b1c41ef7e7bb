"""Deflection and slope of the members of a link, from their bending moments: E I v'' = M_z along y, E I w'' = -M_y.

Each member is measured from a line: the tangent at a weld or a driven joint on it, else the chord through its two
outermost joints, or where it has only one the tangent at it. Shear, stretch and what the deflection does to the forces
are neglected.

Mechanics: docs/theory.md 10.4.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from dalembert.answer.equality import Compared
from dalembert.arrays import Array, Tree, first_largest
from dalembert.errors import ModelError
from dalembert.machine.members.end_conditions import carrying_joints
from dalembert.machine.members.stresses import section_of
from dalembert.machine.members.struts import NEAR, PlacedMember
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.machine.members.member_forces import MemberCurve, MemberForces
    from dalembert.model.links.sections import Section

PLANES = ((5, 0, 1.0), (4, 1, -1.0))
"""Bending along y, then along z: row of the inner forces, second moment of area counted from the last, sign."""
SAMPLES, ROUNDS = 33, 4
"""Places on each piece of a member where the deflection is looked at, and how often, closer about the greatest."""


@dataclass(frozen=True, eq=False)
class DeflectedMember(Compared):
    """Deflection of one member; ``supports``: joints that its line goes through, ``places`` (P, 1 or 2), m."""

    curve: MemberCurve = field(repr=False)
    supports: tuple[str, ...]
    places: Array = field(repr=False)
    stiffness: tuple[float, float]

    def at(self, s: float | Array) -> Array:
        """Deflection along y and along z (P, S, 2), m, at distances s (S,) from the start of the member."""
        return self._relative(np.atleast_1d(np.asarray(s, float))[None])[0]

    def slope(self, s: float | Array) -> Array:
        """Slope in both planes (P, S, 2), rad, against the undeformed line."""
        return self._relative(np.atleast_1d(np.asarray(s, float))[None])[1]

    def slopes(self) -> Array:
        """Slope at each support (P, 1 or 2), rad, of both planes together: the angle in the bearing."""
        return np.asarray(np.linalg.norm(self._relative(self.places)[1], axis=-1))

    def greatest(self) -> tuple[Array, Array]:
        """Greatest deflection (P,), m, of both planes together, and its place (P,), m."""
        edges = self.curve.edges
        best, where = np.full(len(edges), -1.0), np.full(len(edges), np.nan)
        every = np.arange(len(edges))
        for j in range(edges.shape[1] - 1):
            low, high = edges[:, j], edges[:, j + 1]
            for _ in range(ROUNDS):
                s = low[:, None] + (high - low)[:, None] * np.linspace(0, 1, SAMPLES)
                size = np.linalg.norm(self._relative(s)[0], axis=-1)
                k = np.argmax(size, axis=1)
                better = ~(size[every, k] <= best)
                best[better], where[better] = size[every, k][better], s[every, k][better]
                low, high = s[every, np.maximum(k - 1, 0)], s[every, np.minimum(k + 1, SAMPLES - 1)]
        return best, where

    def _relative(self, s: Array) -> tuple[Array, Array]:
        """Deflection and slope (P, S, 2) at places (P or 1, S), from the line through the supports."""
        v, slope = self._free(s)
        held, turned = self._free(self.places)
        first = self.places[:, :1, None]
        if self.places.shape[1] == 2:
            tilt = (held[:, 1:] - held[:, :1]) / (self.places[:, 1:, None] - first)
        else:
            tilt = turned[:, :1]
        return v - held[:, :1] - tilt * (s[..., None] - first), slope - tilt

    def _free(self, s: Array) -> tuple[Array, Array]:
        """The same of the member clamped at its start."""
        parts = [self._in_plane(s, *plane) for plane in PLANES]
        v, slope = (np.stack([part[k] for part in parts], axis=-1) for k in (0, 1))
        return v, slope

    def _in_plane(self, s: Array, row: int, plane: int, sign: float) -> tuple[Array, Array]:
        edges, count = self.curve.edges, len(self.curve.edges)
        c = sign * self.curve.cubics[:, :, row, :] / self.stiffness[plane]
        n = np.arange(4)
        once, twice = c / (n + 1), c / ((n + 1) * (n + 2))  # of s^(n+1), of s^(n+2)
        a, b = np.zeros((count, c.shape[1])), np.zeros((count, c.shape[1]))
        slope, v = np.zeros(count), np.zeros(count)  # at the left end of a piece, both continuous
        for j in range(c.shape[1]):
            x, end = edges[:, j, None], edges[:, j + 1, None]
            a[:, j] = slope - (once[:, j] * x ** (n + 1)).sum(axis=1)
            b[:, j] = v - (twice[:, j] * x ** (n + 2)).sum(axis=1) - a[:, j] * edges[:, j]
            slope = a[:, j] + (once[:, j] * end ** (n + 1)).sum(axis=1)
            v = b[:, j] + a[:, j] * edges[:, j + 1] + (twice[:, j] * end ** (n + 2)).sum(axis=1)
        s = np.broadcast_to(s, (count, s.shape[1]))
        piece = (edges[:, 1:-1, None] <= s[:, None, :]).sum(axis=1)
        i = np.arange(count)[:, None]
        x = s[..., None]
        turned = a[i, piece] + (once[i, piece] * x ** (n + 1)).sum(axis=-1)
        return b[i, piece] + a[i, piece] * s + (twice[i, piece] * x ** (n + 2)).sum(axis=-1), turned


@dataclass(frozen=True, eq=False)
class Deflections(Compared):
    """Deflections of a link's members; ``greatest`` (P,), m, of all with its member and place (P,), m."""

    forces: MemberForces = field(repr=False)
    members: tuple[DeflectedMember, ...]
    greatest: Array = field(repr=False)
    member: tuple[str, ...] = field(repr=False)
    place: Array = field(repr=False)

    @property
    def position(self) -> int:
        """Position of the largest deflection, from 0."""
        return first_largest(self.greatest) if np.isfinite(self.greatest).any() else 0

    @property
    def largest(self) -> float:
        """The largest of the cycle, m."""
        return float(self.greatest[self.position])

    def slopes(self) -> dict[str, Array]:
        """Slope at each joint that a member's line goes through (P,), rad: the angle in its bearing."""
        return {
            name: values
            for e in self.members
            if e.supports
            for name, values in zip(e.supports, e.slopes().T, strict=True)
        }


def deflections(
    forces: MemberForces, section: Section | Tree | None = None, supports: Sequence[str] = ()
) -> Deflections:
    """Deflection and slope of each member of a link, by Young's modulus of its section.

    ``supports``: one joint, whose tangent is the line, or two, whose chord is; by default as the head of this file
    says. Raises ModelError without a section or Young's modulus, and for unknown supports.
    """
    s = section_of(forces, section)
    if s.elasticity is None:
        what = f"the section of {forces.link!r} has no elasticity"
        raise ModelError(what, "give elasticity: 210 GPa", ("links", forces.link, "section"))
    known = [n for n, j in forces.result.mechanism.joints.items() if forces.link in j.links]
    for name in supports:
        if name not in known:
            raise ModelError(f"link {forces.link!r} has no joint {name!r}", closest(name, known))
    if len(supports) > 2:
        raise ModelError(f"{len(supports)} supports do not give one line", "name one or two joints")
    stiffness = (s.elasticity * s.second_moments[1], s.elasticity * s.second_moments[0])
    members = tuple(_member(forces, curve, stiffness, supports) for curve in forces.curves)
    values, places = (np.array(some) for some in zip(*(e.greatest() for e in members), strict=True))
    k, every = np.argmax(np.nan_to_num(values, nan=np.inf), axis=0), np.arange(values.shape[1])
    names = tuple(members[j].curve.name for j in k)
    return Deflections(forces, members, values[k, every], names, places[k, every])


def _member(
    forces: MemberForces, curve: MemberCurve, stiffness: tuple[float, float], chosen: Sequence[str]
) -> DeflectedMember:
    """A member with its supports; one without joints is clamped at its first end."""
    m, placed = forces.result.mechanism, PlacedMember(forces, curve).joints
    some = {*placed} & {*m.joints} - {*carrying_joints(m, forces.link)}
    at = {n: s for n, s in placed.items() if n in some and not m.joints[n].wheels and np.isfinite(s).any()}
    driven = {d.joint or name for name, d in m.drives.items()}
    clamped = [n for n in at if n in driven or not m.joints[n].freedoms]
    order = sorted(at, key=lambda name: float(np.nanmean(at[name])))
    names = (
        [n for n in chosen if n in placed] or clamped[:1] or list(dict.fromkeys([*order[:1], *order[-1:]]))
    )
    if not names:
        return DeflectedMember(curve, (), np.zeros((len(curve.edges), 1)), stiffness)
    places = np.stack([placed[n] for n in names], axis=1)
    if len(names) == 2 and not np.nanmin(np.abs(places[:, 1] - places[:, 0])) > NEAR * curve.member.length:
        names, places = names[:1], places[:, :1]
    return DeflectedMember(curve, tuple(names), places, stiffness)
