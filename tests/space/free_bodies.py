"""Every link of a drawing cut free, at the motion that a result tells: known wrenches, reactions, efforts, powers.

Written with vectors at the mass centres from the drawing alone; the product's matrices, residual and power balance are
not read. Wrenches are (force, moment about the ground's origin).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.random_space.drawing import AXES, Array, Drawing, Joint
from tests.space.screw_motion import Places, State, at_origin, effort_screw, equations, screws


class Balance:
    """Wrenches (P, L, 6) on the links about the ground's origin."""

    def __init__(self, r: Any, d: Drawing, s: State, inertia: bool = True) -> None:
        self.r, self.d, self.s = r, d, s
        self.at = Places(d, s)
        self.known = self._loads() + self._resisted()
        if inertia:
            self.known = self.known + self._momentum()
        self.joints = self._joints()
        self.efforts = self._efforts()

    @property
    def out(self) -> Array:
        """What is left of each moving link's balance."""
        return np.asarray((self.known + self.joints + self.efforts)[:, 1:])

    @property
    def scale(self) -> float:
        """Largest force or moment (over 1 m) in play."""
        parts = [self.known, self.joints, self.efforts]
        return max(float(np.max(np.abs(p))) for p in parts) or 1.0

    def _wrench(self, p: Array, force: Array, couple: Any = 0.0) -> Array:
        return np.concatenate([force, np.cross(p, force) + couple], -1)

    def _loads(self) -> Array:
        w = np.zeros((self.s.count, len(self.d.links), 6))
        for name, x in self.d.masses.items():
            w[:, self.at.number[name]] += self._wrench(
                self.at.point(name, x.center), np.broadcast_to(x.mass * self.d.gravity, (self.s.count, 3))
            )
        for load in self.d.loads.values():
            link = load.a[0]
            if load.type in ("force", "couple"):
                value = np.broadcast_to(load.vector, (self.s.count, 3))
                value = self.at.vector(link, load.vector) if load.follows else value
                p = self.at.point(link, self.d.spots[link][load.a[1]]) if load.type == "force" else 0 * value
                force, couple = (value, 0.0) if load.type == "force" else (0 * value, value)
                w[:, self.at.number[link]] += self._wrench(p, force, couple)
            elif load.b[0]:
                self._pull(w, load)
        return w

    def _pull(self, w: Array, load: Any) -> None:
        (a, pa), (b, pb) = (
            (link, self.at.point(link, self.d.spots[link][p])) for link, p in (load.a, load.b)
        )
        length = np.linalg.norm(pb - pa, axis=-1, keepdims=True)
        e = (pb - pa) / length
        rate = np.sum(e * (self.at.velocity(b, pb) - self.at.velocity(a, pa)), -1, keepdims=True)
        stretch = {"spring": length - load.free, "constant_force_spring": 1 + 0 * length, "damper": rate}
        size = load.value * stretch[load.type]
        w[:, self.at.number[a]] += self._wrench(pa, size * e)
        w[:, self.at.number[b]] += self._wrench(pb, -size * e)

    def _resisted(self) -> Array:
        """Damping in joints, torsion springs and dampers: efforts against their freedom."""
        w = np.zeros((self.s.count, len(self.d.links), 6))
        for name, j in self.d.joints.items():
            for freedom, damping in j.damping.items():
                unit = effort_screw(self.at, j, freedom)
                self._between(w, j, -damping * self._rate(j, unit)[:, None] * unit)
            for load in self.d.loads.values():
                if load.joint != name:
                    continue
                unit = effort_screw(self.at, j, "turn")
                deflection = self.turned(name) - load.free
                moment = load.value * (deflection if load.type == "torsion_spring" else self._rate(j, unit))
                self._between(w, j, -moment[:, None] * unit)
        return w

    def turned(self, name: str) -> Array:
        """Turn of a joint (P,) since it was drawn, less than half a turn, or as its drive says."""
        j, on = self.d.joints[name], self.at.frames(self.d.joints[name])
        axis, across = AXES.index(j.pair.turns[-1]), (AXES.index(j.pair.turns[-1]) + 1) % 3
        a, b, p = on[0][:, axis], on[0][:, across], on[1][:, across]
        angle = np.arctan2(np.sum(np.cross(b, p) * a, -1), np.sum(b * p, -1))
        start = j.values[-1] if j.values else 0.0
        return np.asarray(np.angle(np.exp(1j * (angle - start))))

    def _rate(self, j: Joint, unit: Array) -> Array:
        """Rate of a freedom (P,) from the links' motion."""
        return np.asarray(np.sum(unit * self.relative(j), -1))

    def relative(self, j: Joint) -> Array:
        """Motion of j in i (P, 6): velocity of j's point against i, spin."""
        p = self.at.ends(j)[1]
        v = self.at.velocity(j.j, p) - self.at.velocity(j.i, p)
        return np.concatenate([v, self.at.spin(j.j) - self.at.spin(j.i)], -1)

    def _between(self, w: Array, j: Joint, wrench: Array) -> None:
        """A force at j's point and a couple on j, the opposite on i."""
        p = self.at.ends(j)[1]
        there = self._wrench(p, wrench[:, :3], wrench[:, 3:])
        w[:, self.at.number[j.j]] += there
        w[:, self.at.number[j.i]] -= there

    def _momentum(self) -> Array:
        """Rates of momentum, with the minus sign."""
        w = np.zeros((self.s.count, len(self.d.links), 6))
        for name, x in self.d.masses.items():
            k = self.at.number[name]
            c, o, turn = self.at.point(name, x.center), self.s.origin[:, k], self.at.turn(name)
            spin, alpha = self.s.twist[:, k, 3:], self.s.rate[:, k, 3:]
            a = self.s.rate[:, k, :3] + np.cross(alpha, c - o) + np.cross(spin, np.cross(spin, c - o))
            inertia = turn @ x.inertia @ np.swapaxes(turn, -1, -2)
            angular = (inertia @ alpha[..., None])[..., 0]
            angular = angular + np.cross(spin, (inertia @ spin[..., None])[..., 0])
            w[:, k] -= self._wrench(c, x.mass * a, angular)
        return w

    def reaction(self, name: str) -> Array:
        """Force at j's point and moment about it (P, 6) on j."""
        return np.asarray(self.r.least_norm(name))

    def _joints(self) -> Array:
        w = np.zeros((self.s.count, len(self.d.links), 6))
        for name, j in self.d.joints.items():
            self._between(w, j, self.reaction(name))
        return w

    def _efforts(self) -> Array:
        w = np.zeros((self.s.count, len(self.d.links), 6))
        for name, x in self.d.drives.items():
            j = self.d.joints[x.joint]
            unit = effort_screw(self.at, j, x.freedom)
            self._between(w, j, self.r.effort(name)[:, None] * unit)
        return w

    def work(self, name: str) -> Array:
        """Power (P, F) of a joint's reaction at unit rate of each motion that the joint allows."""
        j = self.d.joints[name]
        return np.einsum("pfk,pk->pf", screws(self.at, j), self.reaction(name))

    def power(self) -> Array:
        """Power (P,) of all known wrenches and efforts; no reaction in it."""
        twists = at_origin(self.s.twist, self.s.origin)
        known = np.sum(self.known * twists, (-2, -1))
        return np.asarray(known + sum(self.r.effort(n) * x.speed for n, x in self.d.drives.items()))

    def virtual_work(self) -> dict[str, Array]:
        """Effort of each drive (P,) from virtual velocities by the joints' screws: neither matrix nor reactions."""
        found = equations(self.d, self.s)
        return {
            name: -np.sum(self.known * found.solved(self.d, {name: 1.0}), (-2, -1)) for name in self.d.drives
        }
