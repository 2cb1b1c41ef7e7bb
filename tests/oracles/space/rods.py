"""A crank and a rod that moves a rocker or a slider in space: RSSR, RSUR, RSSP, RSUP.

The crank turns in a revolute of ground; the rod hangs at A of the crank by a sphere, and at B of the follower by a
sphere or a universal joint; the follower turns in a revolute of ground (rocker) or slides in a prismatic (slider).
Positions: the sphere about A cuts the circle, or the line, of B. Free bodies: rod, follower, crank, in this order.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.oracles.jets import Jet, cos, sin, sqrt
from tests.oracles.reading import Array
from tests.oracles.space.moving import (
    GROUND,
    Pose,
    cross,
    dot,
    fixed,
    hinged,
    mul,
    placed,
    scale,
    stacked,
    unit,
)
from tests.oracles.space.statics import Answer, Body, Hinge, dots


@dataclass(frozen=True)
class RodMachine:
    """Joints with ground, points of the rod's ends on all links, pins of the universal (None: a sphere), bodies."""

    crank: Hinge
    follower: Hinge
    slides: bool
    crank_a: Any
    rod_a: Any
    rod_b: Any
    follower_b: Any
    bodies: dict[str, Body]
    rod_pin: Any = None
    follower_pin: Any = None
    side: int = 1
    pin_side: int = 1

    @property
    def length(self) -> float:
        return float(np.linalg.norm(np.subtract(self.rod_b, self.rod_a)))


def solve(m: RodMachine, turn: Jet, dynamic: bool = True) -> Answer:
    """Poses, reactions (`O` crank, `A`, `B`, `F` follower) and the torque of the crank, at the crank's turns."""
    crank = hinged(GROUND, m.crank.at_i, m.crank.frame_i, m.crank.at_j, m.crank.frame_j, cos(turn), sin(turn))
    a = crank.point(m.crank_a)
    follower = (_slider if m.slides else _rocker)(m, a)
    rod = (_hung if m.rod_pin is None else _pinned)(m, a, follower)
    poses = {"crank": crank, "rod": rod, "follower": follower}
    answer = Answer(poses, m.bodies, dynamic=dynamic, free=("rod",) if m.rod_pin is None else ())
    _free_bodies(m, answer, turn)
    return answer


# positions


def _rocker(m: RodMachine, a: Jet) -> Pose:
    h = m.follower
    b = h.frame_j.T @ np.subtract(m.follower_b, h.at_j)
    e1, e2, n = h.frame_i.T
    center = np.asarray(h.at_i) + b[2] * n
    p, q = b[0] * e1 + b[1] * e2, -b[1] * e1 + b[0] * e2
    gap = a - fixed(center)
    along, across = dot(gap, fixed(p)), dot(gap, fixed(q))
    given = 0.5 * (dot(gap, gap) + (b[0] ** 2 + b[1] ** 2 - m.length**2))
    square = along * along + across * across
    root = float(m.side) * sqrt(square - given * given)
    c, s = (along * given - across * root) / square, (across * given + along * root) / square
    return hinged(GROUND, h.at_i, h.frame_i, h.at_j, h.frame_j, c, s)


def _slider(m: RodMachine, a: Jet) -> Pose:
    h = m.follower
    rotation = h.frame_i @ h.frame_j.T
    start = fixed(np.asarray(h.at_i) + rotation @ np.subtract(m.follower_b, h.at_j))
    d = fixed(h.frame_i[:, 0])
    gap = start - a
    along = dot(gap, d)
    s = -along + float(m.side) * sqrt(along * along - dot(gap, gap) + m.length**2)
    return placed(fixed(rotation), m.follower_b, start + scale(s, d))


def _line(m: RodMachine, a: Jet, follower: Pose) -> Jet:
    return unit(follower.point(m.follower_b) - a)


def _hung(m: RodMachine, a: Jet, follower: Pose) -> Pose:
    """Spheres at both ends: no spin about its own line; the angle about it is arbitrary."""
    u = _line(m, a, follower)
    w, gain = np.cross(u.x, u.v), np.cross(u.x, u.a)
    local = np.subtract(m.rod_b, m.rod_a) / m.length
    x = _shortest(local, u.x)
    wx = _skew(w)
    return placed(Jet(x, wx @ x, (_skew(gain) + wx @ wx) @ x), m.rod_a, a)


def _shortest(a: Array, b: Array) -> Array:
    """The rotation that turns a to b the short way."""
    k = _skew(np.cross(a, b))
    return np.eye(3) + k + k @ k / (1.0 + np.sum(a * b, -1))[..., None, None]


def _skew(w: Array) -> Array:
    o = 0 * w[..., 0]
    x, y, z = np.moveaxis(w, -1, 0)
    return np.stack([np.stack([o, -z, y], -1), np.stack([z, o, -x], -1), np.stack([-y, x, o], -1)], -2)


def _pinned(m: RodMachine, a: Jet, follower: Pose) -> Pose:
    """The rod's pin is perpendicular to the rod and to the follower's pin."""
    u = _line(m, a, follower)
    q = float(m.pin_side) * unit(cross(follower.vector(m.follower_pin), u))
    local_u = np.subtract(m.rod_b, m.rod_a) / m.length
    local_q = np.asarray(m.rod_pin) / np.linalg.norm(m.rod_pin)
    local = np.stack([local_u, local_q, np.cross(local_u, local_q)], -1)
    return placed(mul(stacked(u, q, cross(u, q)), fixed(local.T)), m.rod_a, a)


# free bodies


def _free_bodies(m: RodMachine, answer: Answer, turn: Jet) -> None:
    a, b = answer.poses["crank"].point(m.crank_a).x, answer.poses["follower"].point(m.follower_b).x
    force, moment = _needs(answer, "rod", a)
    arm = b - a
    u = arm / m.length
    couple = _couple(m, answer, moment, u)
    f_b = np.cross(moment - couple, arm) / m.length**2
    tension = _tension(m, answer, b, f_b, couple, u)
    f_b = f_b + tension[:, None] * u
    answer.react("A", "crank", "rod", a, force - f_b)
    answer.react("B", "follower", "rod", b, f_b, couple)
    _follower(m, answer, b, f_b, couple)
    _crank(m, answer, a, force - f_b, turn)


def _needs(answer: Answer, link: str, about: Array) -> tuple[Array, Array]:
    return answer.bodies[link].needs(answer.poses[link], about, answer.dynamic)


def _couple(m: RodMachine, answer: Answer, moment: Array, u: Array) -> Array:
    """The universal's couple, along the normal of its cross, holds the rod against turning about its line."""
    if m.rod_pin is None:
        return 0 * moment
    p = answer.poses["follower"].vector(m.follower_pin).x
    q = answer.poses["rod"].vector(m.rod_pin).x
    n = np.cross(p, q)
    return n * (dots(moment, u) / dots(n, u))[:, None]


def _tension(m: RodMachine, answer: Answer, b: Array, f_b: Array, couple: Array, u: Array) -> Array:
    """The rod's force along itself, from the follower's one equation without its bearing."""
    h = m.follower
    pose = answer.poses["follower"]
    if m.slides:
        d = h.frame_i[:, 0]
        force, _ = _needs(answer, "follower", b)
        return -(force + f_b) @ d / (u @ d)
    n, at = h.frame_i[:, 2], pose.point(h.at_j).x
    _, moment = _needs(answer, "follower", at)
    return -(moment + couple + np.cross(b - at, f_b)) @ n / (np.cross(b - at, u) @ n)


def _follower(m: RodMachine, answer: Answer, b: Array, f_b: Array, couple: Array) -> None:
    at = answer.poses["follower"].point(m.follower.at_j).x + 0 * b
    force, moment = _needs(answer, "follower", at)
    answer.react("F", "ground", "follower", at, force + f_b, moment + couple + np.cross(b - at, f_b))


def _crank(m: RodMachine, answer: Answer, a: Array, f_a: Array, turn: Jet) -> None:
    n = m.crank.frame_i[:, 2]
    at = answer.poses["crank"].point(m.crank.at_j).x + 0 * a
    force, moment = _needs(answer, "crank", at)
    total = moment + np.cross(a - at, f_a)
    effort = total @ n
    answer.react("O", "ground", "crank", at, force + f_a, total - effort[:, None] * n)
    answer.drive("O", effort, n, turn.v + 0 * effort)
