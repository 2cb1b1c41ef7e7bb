"""Spinning links: a rotor with skew inertia in two bearings, and a chain of revolutes, each driven.

A chain of two is the spinning disk on an arm, one of three a gyroscope in gimbals.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.oracles.jets import Jet, cos, sin
from tests.oracles.reading import Array
from tests.oracles.space.moving import GROUND, Pose, hinged
from tests.oracles.space.statics import Answer, Body, Hinge


@dataclass(frozen=True)
class Rotor:
    """Fixed in place by a sphere (`A`, with the drive about z of its frames), guided by a sphere in a cylinder (`B`).

    `far`: the second bearing's point in the rotor, on the line of z through the first.
    """

    near: Hinge
    far: Any
    body: Body


def rotor(m: Rotor, turn: Jet, dynamic: bool = True) -> Answer:
    """Bearing reactions and the torque about the axis."""
    h = m.near
    pose = hinged(GROUND, h.at_i, h.frame_i, h.at_j, h.frame_j, cos(turn), sin(turn))
    answer = Answer({"rotor": pose}, {"rotor": m.body}, dynamic=dynamic)
    n = h.frame_i[:, 2]
    a, b = pose.point(h.at_j).x, pose.point(m.far).x
    force, moment = m.body.needs(pose, a, dynamic)
    effort = moment @ n
    f_b = np.cross(moment, n) / ((b - a) @ n)[:, None]
    answer.react("B", "ground", "rotor", b + 0 * f_b, f_b)
    answer.react("A", "ground", "rotor", a + 0 * f_b, force - f_b)
    answer.drive("A", effort, n, turn.v + 0 * effort)
    return answer


@dataclass(frozen=True)
class Chain:
    """Link names in order from ground, the revolute before each (`J1`, `J2`, ...), bodies."""

    hinges: dict[str, Hinge]
    bodies: dict[str, Body]


def chain(m: Chain, turns: list[Jet], dynamic: bool = True) -> Answer:
    """Reactions and torques of all revolutes, from the last link back to ground."""
    poses: dict[str, Pose] = {}
    on = GROUND
    for (link, h), turn in zip(m.hinges.items(), turns, strict=True):
        on = hinged(on, h.at_i, h.frame_i, h.at_j, h.frame_j, cos(turn), sin(turn))
        poses[link] = on
    answer = Answer(poses, m.bodies, dynamic=dynamic)
    names = list(m.hinges)
    given: tuple[Array | float, Array | float, Array | float] = (0.0, 0.0, 0.0)
    for k in reversed(range(len(names))):
        given = _cut(m, answer, names, k, turns[k], given)
    return answer


def _cut(m: Chain, answer: Answer, names: list[str], k: int, turn: Jet, given: Any) -> Any:
    """The revolute before link k carries what that link and all behind it need."""
    link = names[k]
    h, pose = m.hinges[link], answer.poses[link]
    at = pose.point(h.at_j).x + 0 * pose.w
    spot, f, moment = given
    force, needed = m.bodies[link].needs(pose, at, answer.dynamic)
    total_force = force + f
    total = needed + moment + np.cross(spot - at, f + 0 * at)
    axis = pose.vector(h.frame_j[:, 2]).x
    effort = np.sum(total * axis, -1)
    name = f"J{k + 1}"
    answer.react(name, names[k - 1] if k else "ground", link, at, total_force, total - effort[:, None] * axis)
    answer.drive(name, effort, axis, turn.v + 0 * effort)
    return at, total_force, total
