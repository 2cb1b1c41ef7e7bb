"""Mobility by screws: the joints' freedoms around independent loops; single loops from Denavit-Hartenberg numbers.

A freedom is a screw (direction of the turn; velocity of the origin): a turn (u, p x u), a slide (0, u), both with a
pitch (u, p x u + h u). Around each loop the screws times the rates add to zero: with F freedoms, L loops and rank r the
mobility is F - r, and 6 L - r constraints are redundant (Hunt, Kinematic Geometry of Mechanisms, 1978, chapter 12).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Any

import numpy as np

from tests.oracles.reading import Array


@dataclass(frozen=True)
class Joint:
    """Of link j in link i, as drawn: its point and its axes in ground axes (universal: two pins; spherical: none)."""

    type: str
    i: str
    j: str
    at: Any
    axes: tuple[Any, ...] = ()
    lead: float = 0.0

    def screws(self) -> list[Array]:
        p = np.asarray(self.at, float)
        units = [np.asarray(u, float) / np.linalg.norm(u) for u in self.axes]
        turns = [np.concatenate([u, np.cross(p, u)]) for u in units]
        slides = [np.concatenate([0 * u, u]) for u in units]
        if self.type == "screw":
            return [turns[0] + self.lead / (2 * pi) * slides[0]]
        if self.type == "spherical":
            return [np.concatenate([u, np.cross(p, u)]) for u in np.eye(3)]
        return {
            "revolute": turns, "universal": turns, "prismatic": slides, "cylindrical": [*turns, *slides],
        }[self.type]  # fmt: skip


def mobility(joints: dict[str, Joint]) -> tuple[int, int, float]:
    """Freedoms, redundant constraints and the gap between the singular values counted and not counted."""
    freedoms = [(name, screw) for name, joint in joints.items() for screw in joint.screws()]
    found = loops(joints)
    points = np.array([joint.at for joint in joints.values()], float)
    middle, size = points.mean(0), float(np.max(np.ptp(points, 0)))
    rows = np.zeros((len(found), 6, len(freedoms)))
    for k, loop in enumerate(found):
        for n, (name, screw) in enumerate(freedoms):
            moved = np.concatenate([screw[:3], (screw[3:] - np.cross(middle, screw[:3])) / (size or 1.0)])
            rows[k, :, n] = loop.get(name, 0) * moved
    values = np.linalg.svd(rows.reshape(-1, len(freedoms)), compute_uv=False)
    rank = int(np.sum(values > 1e-8 * values[0]))
    left = values[rank] if rank < len(values) else 1e-16
    return len(freedoms) - rank, 6 * len(found) - rank, float(values[rank - 1] / max(left, 1e-16))


def loops(joints: dict[str, Joint]) -> list[dict[str, int]]:
    """Independent loops, each as the joints passed and their sense: one for every joint outside a spanning tree."""
    path: dict[str, dict[str, int]] = {next(iter(joints.values())).i: {}}
    waiting, found = dict(joints), []
    while waiting:
        name, joint = next((n, t) for n, t in waiting.items() if t.i in path or t.j in path)
        del waiting[name]
        if joint.i in path and joint.j in path:
            found.append(_difference({**path[joint.i], name: 1}, path[joint.j]))
        elif joint.i in path:
            path[joint.j] = {**path[joint.i], name: 1}
        else:
            path[joint.i] = {**path[joint.j], name: -1}
    return found


def _difference(there: dict[str, int], back: dict[str, int]) -> dict[str, int]:
    out = {name: there.get(name, 0) - back.get(name, 0) for name in {**there, **back}}
    return {name: sense for name, sense in out.items() if sense}


# single loops of revolutes


@dataclass(frozen=True)
class Loop:
    """Denavit-Hartenberg: link lengths a12, a23, ..., twists (degrees) and offsets R1, R2, ..."""

    a: tuple[float, ...]
    twist: tuple[float, ...]
    offset: tuple[float, ...]

    def frames(self, turns: Array) -> Array:
        """Axes and points of the joints (n + 1, 4, 4); the last is the first again where the loop closes."""
        out = [np.eye(4)]
        for a, twist, offset, turn in zip(self.a, np.radians(self.twist), self.offset, turns, strict=True):
            out.append(out[-1] @ _about(2, turn, offset) @ _about(0, twist, a))
        return np.array(out)

    def gap(self, turns: Array) -> Array:
        """Six numbers that vanish where the loop closes."""
        e = self.frames(turns)[-1]
        r = e[:3, :3]
        signs = [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], 3.0 - np.trace(r)]
        return np.concatenate([e[:3, 3], signs])

    def closed(self, first: float, start: Array | None = None, seed: int = 0) -> Array:
        """Turns of all joints with the first one given, by least squares from `start` or from random ones."""
        from scipy.optimize import least_squares

        rng = np.random.default_rng(seed)
        for _ in range(200 if start is None else 1):
            guess = rng.uniform(-pi, pi, len(self.a) - 1) if start is None else start[1:]
            found = least_squares(
                lambda rest: self.gap(np.array([first, *rest])), guess, xtol=1e-15, ftol=1e-15, gtol=1e-15
            )
            turns = np.array([first, *found.x])
            if np.max(np.abs(self.gap(turns))) < 1e-12 and self._moves(turns):
                return turns
        raise ValueError(f"the loop does not close at {np.degrees(first):g} degrees")

    def _moves(self, turns: Array) -> bool:
        """Not one of the poses in which two axes of a loop fall together and turn by themselves."""
        f = self.frames(turns)[:-1]
        for k in range(len(f)):
            for n in range(k):
                gap = f[k, :3, 3] - f[n, :3, 3]
                z = f[n, :3, 2]
                if abs(f[k, :3, 2] @ z) > 1 - 1e-9 and np.linalg.norm(gap - z * (gap @ z)) < 1e-6:
                    return False
        return True

    def joints(self, turns: Array) -> dict[str, Joint]:
        """The revolutes as drawn; the links are ground, then link2, ..."""
        f, n = self.frames(turns), len(self.a)
        names = ["ground", *(f"link{k}" for k in range(2, n + 1))]
        return {
            f"J{k + 1}": Joint("revolute", names[k - 1], names[k], f[k, :3, 3], (f[k, :3, 2],))
            for k in range(n)
        }


def _about(axis: int, turn: float, along: float) -> Array:
    """Screw motion along a coordinate axis."""
    c, s = np.cos(turn), np.sin(turn)
    m = np.eye(4)
    p, q = (axis + 1) % 3, (axis + 2) % 3
    m[p, p] = m[q, q] = c
    m[q, p], m[p, q] = s, -s
    m[axis, 3] = along
    return m
