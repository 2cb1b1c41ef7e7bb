"""Position, velocity and acceleration by loop equations: letters, numbers, closure."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.methods.applied_forces import link_angle, link_place, link_speed, slide_direction
from dalembert.arrays import Array, Numeric, Tree
from dalembert.model import GROUND
from dalembert.reports.sections.terms import Signed, join_numbers, join_signed
from dalembert.reports.sheet import Working
from dalembert.views.notation import Shown

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


class LoopVector(NamedTuple):
    """One side of a loop: name, length (m), angle, the rates of its link, and of its length."""

    name: str
    length: float
    angle: float
    speed: float
    acceleration: float
    slide: tuple[float, float] | None


class Loop(NamedTuple):
    """Sides that sum to zero, through these links."""

    links: tuple[str, ...]
    sides: tuple[LoopVector, ...]


Ring = list[tuple[str, str, str]]
"""Steps through a loop: the joint, the links before and after it."""


def loops(r: Result, k: int) -> list[Loop]:
    """Independent loops, each side at position k; not those of joints at one point, which have no sides."""
    some = (_loop(r, k, ring) for ring in rings(r))
    return [loop for loop in some if loop.sides]


def rings(r: Result) -> list[Ring]:
    """Independent loops through joints that are not contacts of wheels, cams, brakes or clutches: one for each joint
    outside a tree from the ground."""
    some = r.mechanism.joints.items()
    edges = {
        n: d.links for n, d in some if not (d.wheels or d.outlined or d.BRAKES or hasattr(d, "RELEASED"))
    }
    parent: dict[str, tuple[str, str] | None] = {GROUND: None}
    queue, tree = [GROUND], set()
    for link in queue:
        for joint, (i, j) in edges.items():
            other = j if link == i else i if link == j else None
            if other is not None and other not in parent:
                parent[other] = (joint, link)
                tree.add(joint)
                queue.append(other)
    left = [joint for joint in edges if joint not in tree and edges[joint][0] in parent]
    return [_ring(joint, *edges[joint], parent) for joint in left]


def _ring(joint: str, i: str, j: str, parent: Tree) -> Ring:
    """Through one joint outside the tree and back through the tree."""
    to_i, to_j = _path_to_ground(i, parent), _path_to_ground(j, parent)
    while to_i and to_j and to_i[0] == to_j[0]:
        to_i, to_j = to_i[1:], to_j[1:]
    return [*to_i, (joint, i, j), *((name, b, a) for name, a, b in reversed(to_j))]


def _loop(r: Result, k: int, ring: Ring) -> Loop:
    """Its sides, through links and along slides."""
    sides: list[LoopVector] = []
    for n, (name, before, after) in enumerate(ring):
        sides += _crossing(r, k, name, before, after)
        following = ring[(n + 1) % len(ring)][0]
        sides += _side(r, k, after, name, following)
    return Loop(tuple(after for _, _, after in ring), tuple(s for s in sides if s.length > 1e-12 or s.slide))


def _path_to_ground(link: str, parent: Tree) -> Ring:
    """Steps (joint, from, to) from the ground to a link."""
    out: Ring = []
    while parent[link] is not None:
        joint, before = parent[link]
        out.insert(0, (joint, before, link))
        link = before
    return out


def joint_end(r: Result, joint: str, link: str, k: int) -> Numeric:
    """A joint's point on one of its links, in ground axes, metres."""
    described = r.mechanism.joints[joint]
    return link_place(r, link, r.mechanism.joint_points(joint)[described.links.index(link)])[k]


def _side(r: Result, k: int, link: str, start: str, end: str) -> list[LoopVector]:
    """From one joint's point of a link to the next's."""
    span = joint_end(r, end, link, k) - joint_end(r, start, link, k)
    alpha = 0.0 if link == GROUND else float(r.acceleration(link)[k])
    angle = math.atan2(float(span[1]), float(span[0]))
    name = f"{start}{end}"
    return [LoopVector(name, float(np.hypot(*span)), angle, float(link_speed(r, link)[k]), alpha, None)]


def _crossing(r: Result, k: int, joint: str, before: str, after: str) -> list[LoopVector]:
    """The slide of a joint between its two points."""
    described = r.mechanism.joints[joint]
    if not described.slides:
        return [_radius(r, k, joint, before)] if described.apart else []
    value, rate, second = (float(v[k]) for v in r.freedom(joint, "slide"))
    e = slide_direction(r, joint)[k]
    rail = described.links[0]
    angle = math.atan2(float(e[1]), float(e[0]))
    sign = 1.0 if before == rail else -1.0
    alpha = 0.0 if rail == GROUND else float(r.acceleration(rail)[k])
    offset = 0.0 if sign > 0 else math.pi
    speed = float(link_speed(r, rail)[k])
    assert link_angle(r, rail) is not None
    return [LoopVector(f"s,{joint}", value, angle + offset, speed, alpha, (rate, second))]


def _radius(r: Result, k: int, joint: str, before: str) -> LoopVector:
    """Vector from the centre of a circular slot to its pin, or back: of constant length, with its rate of turning."""
    i, j = r.mechanism.joints[joint].links
    (pi, vi, ai), (pj, vj, aj) = (_point_motion(r, k, joint, link) for link in (i, j))
    span, square = pj - pi, float((pj - pi) @ (pj - pi))
    speed, alpha = (float(span[0] * v[1] - span[1] * v[0]) / square for v in (vj - vi, aj - ai))
    angle = math.atan2(float(span[1]), float(span[0])) + (0.0 if before == i else math.pi)
    return LoopVector(f"R,{joint}", math.sqrt(square), angle, speed, alpha, None)


def _point_motion(r: Result, k: int, joint: str, link: str) -> tuple[Array, Array, Array]:
    """Place, velocity and acceleration of a joint's point on one of its links."""
    at, described = joint_end(r, joint, link, k), r.mechanism.joints[joint]
    if link == GROUND:
        return at, np.zeros(2), np.zeros(2)
    u = np.asarray(r.mechanism.joint_points(joint)[described.links.index(link)], float)
    return at, r._velocity(link, u)[k], r._acceleration(link, u)[k]


def position_lines(loop: Loop, shown: Shown) -> list[Working]:
    """Sum of r cos theta and of r sin theta."""
    out = []
    for function, turn in (("cos", math.cos), ("sin", math.sin)):
        letters = join_signed([(False, f"r_{{{s.name}}} {function} theta_{{{s.name}}}") for s in loop.sides])
        numbers = join_signed([_side_numbers(s, function, shown) for s in loop.sides])
        total = math.fsum(s.length * turn(s.angle) for s in loop.sides)
        out.append(zero_sum(letters, numbers, total, max(abs(s.length) for s in loop.sides), shown, "length"))
    return out


def _side_numbers(s: LoopVector, function: str, shown: Shown) -> Signed:
    """A side of a loop with its numbers; a slide may be negative."""
    size = shown.number("length", abs(s.length))
    return s.length < 0 and size != "0", f"{size} {function} {_degrees(s.angle, shown)}"


def velocity_lines(loop: Loop, shown: Shown) -> list[Working]:
    """Time derivative of the position's sums."""
    out: list[list[tuple[Signed, float]]] = []
    for axis in (0, 1):
        rates: list[tuple[Signed, float]] = []
        for s in _moving(loop):
            c, n = math.cos(s.angle), math.sin(s.angle)
            turning = (-n if axis == 0 else c) * s.speed * s.length
            f, g = ("sin", "cos") if axis == 0 else ("cos", "sin")
            if s.speed:
                text = f"r_{{{s.name}}} omega_{{{s.name}}} {f} theta_{{{s.name}}}"
                rates.append(((axis == 0, text), turning))
            if s.slide is not None:
                along = (c if axis == 0 else n) * s.slide[0]
                rates.append(((False, f"v_{{{s.name}}} {g} theta_{{{s.name}}}"), along))
        out.append(rates)
    return _sum_rows(out, shown, "speed")


def acceleration_lines(loop: Loop, shown: Shown) -> list[Working]:
    """Second derivative of the position's sums."""
    out = [[term for s in _moving(loop) for term in _accelerations(s, axis)] for axis in (0, 1)]
    return _sum_rows(out, shown, "acceleration")


def _accelerations(s: LoopVector, axis: int) -> list[tuple[Signed, float]]:
    """Tangential, normal, sliding and Coriolis parts along one axis."""
    c, n = math.cos(s.angle), math.sin(s.angle)
    across, along = (-n, c) if axis == 0 else (c, n)
    f, g = ("sin", "cos") if axis == 0 else ("cos", "sin")
    minus = axis == 0
    out: list[tuple[Signed, float]] = []
    if s.acceleration:
        text = f"r_{{{s.name}}} alpha_{{{s.name}}} {f} theta_{{{s.name}}}"
        out.append(((minus, text), s.length * s.acceleration * across))
    if s.speed:
        text = f"r_{{{s.name}}} omega_{{{s.name}}}^{{2}} {g} theta_{{{s.name}}}"
        out.append(((True, text), -s.length * s.speed**2 * along))
    if s.slide is not None:
        out.append(((False, f"a_{{{s.name}}} {g} theta_{{{s.name}}}"), s.slide[1] * along))
        if s.speed:
            text = f"2 omega_{{{s.name}}} v_{{{s.name}}} {f} theta_{{{s.name}}}"
            out.append(((minus, text), 2 * s.speed * s.slide[0] * across))
    return out


def _moving(loop: Loop) -> list[LoopVector]:
    return [s for s in loop.sides if s.speed or s.acceleration or s.slide is not None]


def _sum_rows(axes: list[list[tuple[Signed, float]]], shown: Shown, kind: str) -> list[Working]:
    """Terms in letters and their values along both axes, and the sums; rounding noise is 0."""
    largest = max((abs(v) for terms in axes for _, v in terms), default=0.0)
    out = []
    for terms in filter(None, axes):
        numbers = join_numbers([shown.number(kind, value) for _, value in terms])
        total = math.fsum(v for _, v in terms)
        out.append(
            zero_sum(join_signed([letters for letters, _ in terms]), numbers, total, largest, shown, kind)
        )
    return out


def _degrees(angle: float, shown: Shown) -> str:
    text = shown.notation.degrees(math.remainder(angle, 2 * math.pi)) + " deg"
    return f"({text})" if text.startswith("−") else text


def zero_sum(
    letters: str, numbers: str, total: float, largest: float, shown: Shown, kind: str, per: str = ""
) -> Working:
    """A sum that is zero; what rounding leaves of it is 0. ``per`` goes on behind the unit."""
    value = 0.0 if abs(total) < 1e-9 * largest else total
    return Working(f"{letters} = 0", f"{numbers} = {shown.with_unit(shown.number(kind, value), kind, per)}")
