"""Forces on a link in link axes, its weight and inertia distributed along its members where its mass is.

Mechanics: docs/theory.md 10.4.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.friction.bearing_ends import bearing_axis
from dalembert.analysis.methods.applied_forces import Action, full_actions, on_link, slide_direction, state
from dalembert.arrays import Array, Ints
from dalembert.core.equilibrium import shifts, statement
from dalembert.core.linear import PseudoInverse
from dalembert.machine.link_axes import LinkAxes, couple_in_space, in_space
from dalembert.machine.members.mass_along import MassLayout, MassPiece
from dalembert.machine.members.straight_members import Straight

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


BESIDE = 1e-6
"""Part of a member's length that a force may be off it and still act on it."""
COMBINATIONS = 3
"""Number of random combinations of the free unknowns: in all of them a non-unique value never changes by exactly
zero."""


@dataclass(frozen=True)
class Wrench:
    """A force and a couple (P, 3) at a place (P, 3), all in link axes; number of its member and its base point on it
    (P,)."""

    place: Array
    force: Array
    couple: Array
    member: Ints
    foot: Array

    def about(self, point: Array) -> Array:
        """Its moment (P, 3) about a point (3,)."""
        return np.asarray(self.couple + np.cross(self.place - point, self.force))


class Loads(NamedTuple):
    """Forces at base points, total effect of each piece of mass along a member, and the free part of the first."""

    seated: list[Wrench]
    spread: list[tuple[MassPiece, Wrench]]
    free: list[list[Wrench]]


def acting(r: Result) -> list[tuple[Action, ...]]:
    """All actions on the links, of least norm where not unique; then some that balance by themselves, if there are any.
    A guide whose length is given bears at its two ends.

    These are ``COMBINATIONS``, at random, of all reactions and efforts that equilibrium leaves open: what these change
    is not unique.
    """
    c, least = r.compiled, replace(r, unique_array=None, unique_unknowns=None, unique_in=None)
    out = [_at_ends(least)]
    if r.unique_array is None:
        return out
    s, zero = state(r), np.zeros((len(r.status), c.layout.links, c.layout.algebra.n))
    forces = statement(c.layout, c.known, s.pose, s.rows, s.solver, zero).forces
    assert isinstance(forces, PseudoInverse)
    free = forces.null @ np.random.default_rng(0).normal(size=(forces.null.shape[-1], COMBINATIONS))
    shift, _ = shifts(c.layout, s.pose, s.rows, free)
    force, moment = np.split(shift, [c.layout.algebra.d], axis=-2)
    first, last = c.layout.constraints.count, free.shape[1] - len(r.unknown_loads)
    for k in range(COMBINATIONS):
        effort = np.zeros_like(r.effort_array)
        effort[:, c.known.requested] = free[:, first:last, k]
        couple = moment[..., k].reshape(r.moment_array.shape)
        direction = replace(
            least, force_array=force[..., k], moment_array=couple, effort_array=effort, friction=None
        )
        some = _at_ends(replace(direction, load_array=free[:, last:, k]))
        out.append(tuple(a for a in some if a.kind in ("joint", "effort") or a.of in r.unknown_loads))
    return out


def _at_ends(r: Result) -> tuple[Action, ...]:
    return tuple(part for a in full_actions(r) for part in _guided(r, a))


def _guided(r: Result, a: Action) -> tuple[Action, ...]:
    """A reaction of a joint with `guide: [l1, l2]` as forces across its axis e, l2 ahead and l1 behind of its point.

    F_ahead + F_behind = F across e, and e x (l2 F_ahead - l1 F_behind) = M across e without friction's; the rest, along
    and about e and of friction on the faces, stays at j's point.
    """
    described = r.mechanism.joints[a.of] if a.kind == "joint" else None
    guide = getattr(getattr(described, "friction", None), "guide", None)
    if guide is None:
        return (a,)
    behind, ahead = guide
    axis = slide_direction(r, a.of) if r.mechanism.dimension == 2 else bearing_axis(r, a.of)
    across = a.force - (a.force * axis).sum(axis=1, keepdims=True) * axis
    couple = couple_in_space(a.couple - r.friction_moment(a.of, a.link))
    tilting = np.cross(couple, in_space(axis))[:, : axis.shape[1]]
    first = (behind * across + tilting) / (behind + ahead)
    ends = [
        replace(a, at=a.at + s * axis, force=force, couple=0 * a.couple, part=part)
        for part, s, force in (("ahead", ahead, first), ("behind", -behind, across - first))
    ]
    left = a.couple - sum(end.moment(a.at) for end in ends)
    return (*ends, replace(a, force=a.force - across, couple=left))


class LinkBalance(LinkAxes):
    """A link's motion and the forces on it, in link axes, with three components."""

    def __init__(self, r: Result, link: str, sets: list[tuple[Action, ...]]) -> None:
        super().__init__(r, link)
        count, d = len(r.status), r.mechanism.dimension
        self.actions, *self.free = (on_link(some, link) for some in sets)
        self.center = in_space(r.mechanism.center(link))
        gravity = np.array(r.mechanism.gravity_vector, float)
        self.gravity = self.to_link(np.broadcast_to(gravity, (count, d)))
        self.acceleration = self.to_link(r.center_acceleration(link)) if r.inertia else np.zeros((count, 3))

    def place(self, a: Action) -> Array:
        """Point where an action acts (P, 3)."""
        return self.to_link(a.at - self.r.position(self.link))

    def joints(self) -> Array:
        """Places (N, 3) of its joints over all positions."""
        some = [self.place(a) for a in self.actions if a.kind == "joint" and not a.part]
        places: Array = np.concatenate(some) if some else np.zeros((0, 3))
        return np.asarray(places[np.isfinite(places).all(axis=1)])

    def seated(self, members: tuple[Straight, ...], a: Action) -> Wrench:
        """An action at its foot."""
        return _seated(members, self.place(a), self.to_link(a.force), self.couple_to_link(a.couple))

    def brackets(self, members: tuple[Straight, ...]) -> dict[str, float]:
        """Joints and loads beside the members, whose forces need a bracket, each with its greatest distance, m."""
        out: dict[str, float] = {}
        for a in self.actions:
            off = np.min([e.foot(self.place(a))[1] for e in members], axis=0)
            loaded = np.nan_to_num(np.abs(a.force).max(axis=1)) > 0
            size = float(np.nanmax(off, where=loaded, initial=0.0))
            if a.kind not in ("weight", "inertia") and size > BESIDE * max(e.length for e in members):
                out[a.of] = max(size, out.get(a.of, 0.0))
        return out

    def distributed(self, e: Straight) -> tuple[Array, Array]:
        """Force on unit mass along a member: c0 - c1 s, both (P, 3), by gravity and acceleration."""
        at_start = self.acceleration + self.rate @ (e.start - self.center)
        return self.gravity - at_start, self.rate @ e.along

    def turning_couple(self, inertia: Array) -> Array:
        """Inertia couple (P, 3) of an inertia (3, 3) about its centre: -(I alpha + w x I w), in the plane about z.

        With S = tr(I) / 2 - I = int r r^T dm it is -int r x (R r) dm = -eps (R S), R r the acceleration of an arm r.
        """
        spread = self.rate @ (np.trace(inertia) / 2 * np.eye(3) - inertia)
        i, j, k = [0, 1, 2], [1, 2, 0], [2, 0, 1]
        couple = spread[:, j, k] - spread[:, k, j]
        couple[:, i[: 2 * (self.r.mechanism.dimension == 2)]] = 0.0
        return np.asarray(couple)

    def loads(self, members: tuple[Straight, ...], mass: MassLayout) -> Loads:
        """All that acts; what mass along and beside members does is taken off weight and inertia at the centre."""
        zero = np.zeros_like(self.acceleration)
        out = Loads([], [], [[self.seated(members, a) for a in some] for some in self.free])
        force, couple = zero, zero
        for a in self.actions:
            if a.kind in ("weight", "inertia"):
                force, couple = force + self.to_link(a.force), couple + self.couple_to_link(a.couple)
            else:
                out.seated.append(self.seated(members, a))
        for p in mass.pieces:
            e = members[p.member]
            c0, c1 = self.distributed(e)
            m0, m1, m2 = (p.density * (p.end**n - p.start**n) / n for n in (1, 2, 3))
            moment = np.cross(e.along, m1 * c0 - m2 * c1)
            moment += (p.end - p.start) * self.turning_couple(p.inertia)
            where = np.full(len(zero), p.member), np.full(len(zero), p.end)
            out.spread.append((p, Wrench(zero + e.start, m0 * c0 - m1 * c1, moment, *where)))
        for x in mass.lumps:
            pull = x.mass * (self.gravity - self.acceleration - self.rate @ (x.center - self.center))
            out.seated.append(_seated(members, zero + x.center, pull, self.turning_couple(x.inertia)))
        for w in [*(w for _, w in out.spread), *out.seated[len(out.seated) - len(mass.lumps) :]]:
            force, couple = force - w.force, couple - w.about(self.center)
        out.seated.append(_seated(members, zero + self.center, force, couple))
        return out


def _seated(members: tuple[Straight, ...], place: Array, force: Array, couple: Array) -> Wrench:
    """A wrench at its foot on the nearest member."""
    feet = [e.foot(place) for e in members]
    member = np.argmin(np.nan_to_num(np.array([off for _, off in feet])), axis=0)
    foot = np.take_along_axis(np.array([s for s, _ in feet]), member[None], axis=0)[0]
    return Wrench(place, force, couple, member, foot)
