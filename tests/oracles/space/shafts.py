"""Shafts coupled by universal joints: Hooke's joint with or without its cross, and the double Cardan shaft.

The input shaft turns in a revolute of ground. Of a Hooke joint the output shaft runs through the joint's centre and a
bearing that takes forces across it only (sphere in cylinder); of a double Cardan shaft it runs in a cylindrical joint.
So all reactions are determinate. Pins follow from p2 = n2 x p1: across both the shaft and the other pin.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.oracles.jets import Jet, cos, sin
from tests.oracles.reading import Array
from tests.oracles.space.moving import (
    GROUND,
    Pose,
    cross,
    fixed,
    hinged,
    mul,
    placed,
    stacked,
    unit,
)
from tests.oracles.space.statics import Answer, Body, Hinge, dots


@dataclass(frozen=True)
class Shaft:
    """A shaft in link axes: its line, a pin across it, and the points of the universal joint and of the bearing."""

    axis: Any
    pin: Any
    joint: Any
    bearing: Any


@dataclass(frozen=True)
class Hooke:
    """`line` is the output shaft's direction in ground; `cross_pins` in the cross, whose centre is its origin."""

    input: Hinge
    input_joint: Any
    input_pin: Any
    line: Any
    output: Shaft
    bodies: dict[str, Body]
    cross_pins: tuple[Any, Any] | None = None
    side: int = 1


@dataclass(frozen=True)
class DoubleCardan:
    """The middle shaft's second joint is `middle.bearing`, its second pin `middle_pin`."""

    input: Hinge
    input_joint: Any
    input_pin: Any
    line_of_middle: Any
    middle: Shaft
    middle_pin: Any
    line: Any
    output: Shaft
    bodies: dict[str, Body]
    sides: tuple[int, int] = (1, 1)


def hooke(m: Hooke, turn: Jet, dynamic: bool = True) -> Answer:
    """Reactions `O`, `U` (or `P1`, `P2` of the cross) and `E`, torque of the input shaft."""
    shaft = _input(m, turn)
    center = shaft.point(m.input_joint)
    p1 = unit(shaft.vector(m.input_pin))
    output = _driven(m.output, fixed(_direction(m.line)), p1, center, m.side)
    poses = {"input": shaft, "output": output}
    if m.cross_pins is not None:
        poses["cross"] = _cross(m, p1, unit(output.vector(m.output.pin)), center)
    answer = Answer(poses, m.bodies, dynamic=dynamic)
    _hooke_bodies(m, answer, center.x + 0 * p1.x, turn)
    return answer


def double_cardan(m: DoubleCardan, turn: Jet, dynamic: bool = True) -> Answer:
    """Reactions `O`, `U1`, `U2` and `E`, torque of the input shaft."""
    shaft = _input(m, turn)
    first = shaft.point(m.input_joint)
    middle = _driven(
        m.middle, fixed(_direction(m.line_of_middle)), unit(shaft.vector(m.input_pin)), first, m.sides[0]
    )
    second = middle.point(m.middle.bearing)
    p3 = unit(middle.vector(m.middle_pin))
    output = _driven(m.output, fixed(_direction(m.line)), p3, second, m.sides[1])
    answer = Answer({"input": shaft, "middle": middle, "output": output}, m.bodies, dynamic=dynamic)
    _cardan_bodies(m, answer, first.x + 0 * p3.x, second.x + 0 * p3.x, turn)
    return answer


# positions


def _direction(line: Any) -> Array:
    line = np.asarray(line, float)
    return line / np.linalg.norm(line)


def _input(m: Hooke | DoubleCardan, turn: Jet) -> Pose:
    h = m.input
    return hinged(GROUND, h.at_i, h.frame_i, h.at_j, h.frame_j, cos(turn), sin(turn))


def _driven(shaft: Shaft, line: Jet, pin: Jet, center: Jet, side: int) -> Pose:
    """The shaft along a line of ground whose pin is across the line and the other shaft's pin."""
    p = float(side) * unit(cross(line, pin))
    n, q = _direction(shaft.axis), _direction(shaft.pin)
    local = np.stack([q, np.cross(n, q), n], -1)
    return placed(mul(stacked(p, cross(line, p), line), fixed(local.T)), shaft.joint, center)


def _cross(m: Hooke, p1: Jet, p2: Jet, center: Jet) -> Pose:
    assert m.cross_pins is not None
    q1, q2 = (_direction(pin) for pin in m.cross_pins)
    local = np.stack([q1, q2, np.cross(q1, q2)], -1)
    return placed(mul(stacked(p1, p2, cross(p1, p2)), fixed(local.T)), (0, 0, 0), center)


# free bodies


def _needs(answer: Answer, link: str, about: Array) -> tuple[Array, Array]:
    return answer.bodies[link].needs(answer.poses[link], about, answer.dynamic)


def _hooke_bodies(m: Hooke, answer: Answer, center: Array, turn: Jet) -> None:
    n2 = _direction(m.line)
    p1 = answer.poses["input"].vector(m.input_pin).x
    p2 = answer.poses["output"].vector(m.output.pin).x
    e = answer.poses["output"].point(m.output.bearing).x
    force, moment = _needs(answer, "output", center)
    if m.cross_pins is None:
        normal = np.cross(p1, p2)
        couple = normal * ((moment @ n2) / (normal @ n2))[:, None]
    else:
        cross_force, cross_moment = _needs(answer, "cross", center)
        couple = _through_cross(p1, p2, n2, cross_moment, moment @ n2)
    f_e = np.cross(moment - couple, n2) / ((e - center) @ n2)[:, None]
    answer.react("E", "ground", "output", e, f_e)
    f, k = force - f_e, couple
    if m.cross_pins is None:
        answer.react("U", "input", "output", center, f, k)
    else:
        answer.react("P2", "cross", "output", center, f, k)
        f, k = f + cross_force, k + cross_moment
        answer.react("P1", "input", "cross", center, f, k)
    _input_body(m, answer, center, f, k, turn)


def _through_cross(p1: Array, p2: Array, n2: Array, needed: Array, along: Array) -> Array:
    """The cross's couple on the output shaft: none about p2; none about p1 from the input; the given one about n2."""
    rows = np.stack([p1, p2, n2 + 0 * p1], -2)
    right = np.stack([-dots(needed, p1), 0 * along, along], -1)
    return np.linalg.solve(rows, right[..., None])[..., 0]


def _cardan_bodies(m: DoubleCardan, answer: Answer, first: Array, second: Array, turn: Jet) -> None:
    n2, u = _direction(m.line), _direction(m.line_of_middle)
    middle, output = answer.poses["middle"], answer.poses["output"]
    n_first = np.cross(answer.poses["input"].vector(m.input_pin).x, middle.vector(m.middle.pin).x)
    n_second = np.cross(middle.vector(m.middle_pin).x, output.vector(m.output.pin).x)
    e = output.point(m.output.bearing).x
    force, moment = _needs(answer, "output", second)
    k2 = n_second * ((moment @ n2) / (n_second @ n2))[:, None]
    mid_force, mid_moment = _needs(answer, "middle", first)
    k1 = n_first * (((mid_moment + k2) @ u) / (n_first @ u))[:, None]
    across = (k1 - k2 - mid_moment) / ((second - first) @ u)[:, None]
    f2 = np.cross(across, u)
    f2 = f2 + (((force - f2) @ n2) / (u @ n2))[:, None] * u
    f_e = force - f2
    answer.react("E", "ground", "output", e, f_e, moment - k2 - np.cross(e - second, f_e))
    answer.react("U2", "middle", "output", second, f2, k2)
    answer.react("U1", "input", "middle", first, mid_force + f2, k1)
    _input_body(m, answer, first, mid_force + f2, k1, turn)


def _input_body(
    m: Hooke | DoubleCardan, answer: Answer, center: Array, f: Array, k: Array, turn: Jet
) -> None:
    """The input shaft, which gives force f and couple k away at the joint."""
    n = m.input.frame_i[:, 2]
    at = answer.poses["input"].point(m.input.at_j).x + 0 * f
    force, moment = _needs(answer, "input", at)
    total = moment + k + np.cross(center - at, f)
    effort = total @ n
    answer.react("O", "ground", "input", at, force + f, total - effort[:, None] * n)
    answer.drive("O", effort, n, turn.v + 0 * effort)
