"""What a link's joints must carry, and the check of every free body and of the power.

Sums of forces and moments, written with vectors; nothing is assembled into a matrix.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from tests.oracles.reading import Array
from tests.oracles.space.moving import Pose


@dataclass(frozen=True)
class Hinge:
    """A joint: its point and its axes (columns) on link i, which is ground or the link before, and on link j."""

    at_i: Any
    frame_i: Array
    at_j: Any
    frame_j: Array


def dots(a: Array, b: Array) -> Array:
    """Dot products of vectors, position by position."""
    return np.sum(a * b, -1)


@dataclass(frozen=True)
class Body:
    """Mass, mass centre and inertia about it in link axes; forces at points and couples, in ground axes."""

    mass: float = 0.0
    center: Any = (0.0, 0.0, 0.0)
    inertia: Any = (0.0, 0.0, 0.0)
    forces: tuple[tuple[Any, Any], ...] = ()
    couples: tuple[Any, ...] = ()
    gravity: Any = (0.0, 0.0, -9.80665)

    @property
    def matrix(self) -> Array:
        given = np.asarray(self.inertia, float)
        return np.diag(given) if given.ndim == 1 else given

    def momentum_rates(self, pose: Pose, dynamic: bool) -> tuple[Array, Array]:
        """Of linear momentum, and of angular momentum about the mass centre."""
        center = pose.point(self.center)
        turned = pose.rotation.x @ self.matrix @ np.swapaxes(pose.rotation.x, -1, -2)
        spin = np.einsum("...ij,...j->...i", turned, pose.w)
        gain = np.einsum("...ij,...j->...i", turned, pose.alpha)
        both = self.mass * center.a + 0 * pose.w, gain + np.cross(pose.w, spin)
        return both if dynamic else (0 * both[0], 0 * both[1])

    def needs(self, pose: Pose, about: Array, dynamic: bool = True) -> tuple[Array, Array]:
        """Force, and moment about a spot, that joints and drives must exert on the link."""
        force, moment = self.momentum_rates(pose, dynamic)
        center = pose.point(self.center).x
        weight = self.mass * np.asarray(self.gravity, float)
        force = force - weight
        moment = moment + np.cross(center - about, force)
        for at, value in self.forces:
            force = force - value
            moment = moment - np.cross(pose.point(at).x - about, value)
        return force, moment - sum(self.couples, np.zeros(3))

    def power(self, pose: Pose, dynamic: bool = True) -> Array:
        """Of gravity and loads less the rate of kinetic energy: what the drives must make up with a minus sign."""
        center = pose.point(self.center)
        turned = pose.rotation.x @ self.matrix @ np.swapaxes(pose.rotation.x, -1, -2)
        out = self.mass * dots(center.v, np.asarray(self.gravity, float))
        for at, value in self.forces:
            out = out + dots(pose.point(at).v, value)
        for value in self.couples:
            out = out + dots(pose.w, value)
        if dynamic:
            out = out - self.mass * dots(center.v, center.a)
            out = out - np.einsum("...i,...ij,...j->...", pose.w, turned, pose.alpha)
        return out


@dataclass(frozen=True)
class Reaction:
    """Of a joint on j at j's point (ground axes), with the links' names; by i."""

    i: str
    j: str
    at: Array
    force: Array
    moment: Array


@dataclass
class Answer:
    """Poses and bodies of the links, reactions of the joints, efforts of the drives with their axes and rates.

    ``free``: links whose orientation about their own line is not determined.
    """

    poses: dict[str, Pose]
    bodies: dict[str, Body]
    reactions: dict[str, Reaction] = field(default_factory=dict)
    efforts: dict[str, Array] = field(default_factory=dict)
    drives: dict[str, tuple[str, Array, Array]] = field(default_factory=dict)
    dynamic: bool = True
    free: tuple[str, ...] = ()

    def react(self, name: str, i: str, j: str, at: Array, force: Array, moment: Any = 0.0) -> None:
        self.reactions[name] = Reaction(i, j, at, force, moment + 0 * force)

    def drive(self, joint: str, effort: Array, axis: Array, rate: Array) -> None:
        """A torque of this size on j of a joint about an axis that turns at this rate."""
        self.efforts[joint], self.drives[joint] = effort, (joint, axis, rate)

    def residual(self) -> float:
        """Largest force or moment out of balance, over the largest force (times length)."""
        force, length = self.force_scale(), self.length()
        gaps = []
        for link, body in self.bodies.items():
            pose = self.poses[link]
            about = pose.origin.x
            f, m = body.needs(pose, about, self.dynamic)
            for r in self.reactions.values():
                sign = (r.j == link) * 1.0 - (r.i == link) * 1.0
                f = f - sign * r.force
                m = m - sign * (r.moment + np.cross(r.at - about, r.force))
            for name, (joint, axis, _) in self.drives.items():
                r = self.reactions[joint]
                sign = (r.j == link) * 1.0 - (r.i == link) * 1.0
                m = m - sign * self.efforts[name][:, None] * axis
            gaps += [np.max(np.abs(f)) / force, np.max(np.abs(m)) / force / length]
        return float(np.max(gaps))

    def power_gap(self) -> float:
        """Drives' power and the loads' less the rate of kinetic energy, over the largest power of a drive."""
        given = [self.efforts[name] * rate for name, (_, _, rate) in self.drives.items()]
        gap = sum(given) + sum(
            body.power(self.poses[link], self.dynamic) for link, body in self.bodies.items()
        )
        return float(np.max(np.abs(gap)) / max(np.max(np.abs(p)) for p in given))

    def force_scale(self) -> float:
        return max(
            max(float(np.max(np.abs(r.force))), float(np.max(np.abs(r.moment))) / self.length())
            for r in self.reactions.values()
        )

    def length(self) -> float:
        spots = [r.at for r in self.reactions.values()]
        return max(float(np.max(np.abs(a - b))) for a in spots for b in spots) or 1.0
