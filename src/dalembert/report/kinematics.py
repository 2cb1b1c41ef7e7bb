"""Position, velocity and acceleration by loop equations: letters, numbers, closure."""

from __future__ import annotations

import math
from collections.abc import Collection
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from dalembert.analysis.actions import link_angle, link_place, link_speed, slide_direction
from dalembert.report.sheet import Working
from dalembert.views.notation import Shown

if TYPE_CHECKING:
    from dalembert.analysis.result import Result

GROUND = "ground"
CLOSING = ("pin", "slider", "slot", "weld")


class Vector(NamedTuple):
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
    sides: tuple[Vector, ...]


Ring = list[tuple[str, str, str]]
"""Steps through a loop: the joint, the links before and after it."""


def loops(r: Result, k: int) -> list[Loop]:
    """Independent loops through pins, sliders, slots and welds; each side at position k."""
    return [_loop(r, k, ring) for ring in rings(r, CLOSING)]


def rings(r: Result, closing: Collection[str]) -> list[Ring]:
    """Independent loops through joints of some types: each of a joint outside a tree from the ground."""
    edges = {n: d.links for n, d in r.mechanism.joints.items() if d.type in closing}
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


def _ring(joint: str, i: str, j: str, parent: dict[str, Any]) -> Ring:
    """Through one joint outside the tree and back through the tree."""
    to_i, to_j = _way(i, parent), _way(j, parent)
    while to_i and to_j and to_i[0] == to_j[0]:
        to_i, to_j = to_i[1:], to_j[1:]
    return [*to_i, (joint, i, j), *((name, b, a) for name, a, b in reversed(to_j))]


def _loop(r: Result, k: int, ring: Ring) -> Loop:
    """Its sides, through links and along slides."""
    sides: list[Vector] = []
    for n, (name, before, after) in enumerate(ring):
        sides += _crossing(r, k, name, before, after)
        following = ring[(n + 1) % len(ring)][0]
        sides += _side(r, k, after, name, following)
    return Loop(tuple(after for _, _, after in ring), tuple(s for s in sides if s.length > 1e-12 or s.slide))


def _way(link: str, parent: dict[str, Any]) -> Ring:
    """Steps (joint, from, to) from the ground to a link."""
    out: Ring = []
    while parent[link] is not None:
        joint, before = parent[link]
        out.insert(0, (joint, before, link))
        link = before
    return out


def joint_end(r: Result, joint: str, link: str, k: int) -> Any:
    """A joint's point on one of its links, in ground axes, metres."""
    described = r.mechanism.joints[joint]
    return link_place(r, link, r.mechanism.joint_points(joint)[described.links.index(link)])[k]


def _side(r: Result, k: int, link: str, start: str, end: str) -> list[Vector]:
    """From one joint's point of a link to the next's."""
    span = joint_end(r, end, link, k) - joint_end(r, start, link, k)
    alpha = 0.0 if link == GROUND else float(r.acceleration(link)[k])
    angle = math.atan2(float(span[1]), float(span[0]))
    name = f"{start}{end}"
    return [Vector(name, float(np.hypot(*span)), angle, float(link_speed(r, link)[k]), alpha, None)]


def _crossing(r: Result, k: int, joint: str, before: str, after: str) -> list[Vector]:
    """The slide of a joint between its two points."""
    described = r.mechanism.joints[joint]
    if described.type not in ("slider", "slot"):
        return []
    value, rate, second = (float(v[k]) for v in r.freedom(joint, "slide"))
    e = slide_direction(r, joint)[k]
    rail = described.links[0]
    angle = math.atan2(float(e[1]), float(e[0]))
    sign = 1.0 if before == rail else -1.0
    alpha = 0.0 if rail == GROUND else float(r.acceleration(rail)[k])
    offset = 0.0 if sign > 0 else math.pi
    speed = float(link_speed(r, rail)[k])
    assert link_angle(r, rail) is not None
    return [Vector(f"s,{joint}", value, angle + offset, speed, alpha, (rate, second))]


def position_lines(loop: Loop, shown: Shown) -> list[Working]:
    """Sum of r cos theta and of r sin theta."""
    out = []
    for function, turn in (("cos", math.cos), ("sin", math.sin)):
        letters = " + ".join(f"r_{{{s.name}}} {function} theta_{{{s.name}}}" for s in loop.sides)
        numbers = " + ".join(
            f"{number_text(shown, 'length', s.length)} {function} {_degrees(s.angle)}" for s in loop.sides
        )
        total = math.fsum(s.length * turn(s.angle) for s in loop.sides)
        out.append(closed(letters, numbers, total, max(s.length for s in loop.sides), shown, "length"))
    return out


def velocity_lines(loop: Loop, shown: Shown) -> list[Working]:
    """Time derivative of the position's sums."""
    out: list[tuple[list[str], list[float]]] = []
    for axis in (0, 1):
        letters: list[str] = []
        total: list[float] = []
        for s in _moving(loop):
            c, n = math.cos(s.angle), math.sin(s.angle)
            turning = (-n if axis == 0 else c) * s.speed * s.length
            function = ("−", "sin") if axis == 0 else ("+", "cos")
            if s.speed:
                letters.append(
                    f"{function[0]} r_{{{s.name}}} omega_{{{s.name}}} {function[1]} theta_{{{s.name}}}"
                )
                total.append(turning)
            if s.slide is not None:
                along = (c if axis == 0 else n) * s.slide[0]
                letters.append(f"+ v_{{{s.name}}} {'cos' if axis == 0 else 'sin'} theta_{{{s.name}}}")
                total.append(along)
        out.append((letters, total))
    return _summed(out, shown, "speed")


def acceleration_lines(loop: Loop, shown: Shown) -> list[Working]:
    """Second derivative of the position's sums."""
    out: list[tuple[list[str], list[float]]] = []
    for axis in (0, 1):
        letters: list[str] = []
        total: list[float] = []
        for s in _moving(loop):
            for text, value in _accelerations(s, axis):
                letters.append(text)
                total.append(value)
        out.append((letters, total))
    return _summed(out, shown, "acceleration")


def _accelerations(s: Vector, axis: int) -> list[tuple[str, float]]:
    """Tangential, normal, sliding and Coriolis parts along one axis."""
    c, n = math.cos(s.angle), math.sin(s.angle)
    across, along = (-n, c) if axis == 0 else (c, n)
    f, g = ("sin", "cos") if axis == 0 else ("cos", "sin")
    sign = "−" if axis == 0 else "+"
    out = []
    if s.acceleration:
        text = f"{sign} r_{{{s.name}}} alpha_{{{s.name}}} {f} theta_{{{s.name}}}"
        out.append((text, s.length * s.acceleration * across))
    if s.speed:
        text = f"− r_{{{s.name}}} omega_{{{s.name}}}^{{2}} {g} theta_{{{s.name}}}"
        out.append((text, -s.length * s.speed**2 * along))
    if s.slide is not None:
        out.append((f"+ a_{{{s.name}}} {g} theta_{{{s.name}}}", s.slide[1] * along))
        if s.speed:
            text = f"{sign} 2 omega_{{{s.name}}} v_{{{s.name}}} {f} theta_{{{s.name}}}"
            out.append((text, 2 * s.speed * s.slide[0] * across))
    return out


def _moving(loop: Loop) -> list[Vector]:
    return [s for s in loop.sides if s.speed or s.acceleration or s.slide is not None]


def _summed(axes: list[tuple[list[str], list[float]]], shown: Shown, kind: str) -> list[Working]:
    """Terms in letters and their values along both axes, and the sums; rounding noise is 0."""
    largest = max((abs(v) for _, values in axes for v in values), default=0.0)
    out = []
    for letters, values in axes:
        kept = [v if abs(v) > 1e-9 * largest else 0.0 for v in values]
        numbers = [f"{'−' if v < 0 else '+'} {number_text(shown, kind, abs(v))}" for v in kept]
        out.append(closed(_first(letters), _first(numbers), math.fsum(values), largest, shown, kind))
    return out


def _first(parts: list[str]) -> str:
    """Terms that carry their signs, the first plus left out."""
    text = " ".join(parts)
    return text.removeprefix("+ ") or "0"


def number_text(shown: Shown, kind: str, value: float) -> str:
    return shown.notation.number(shown.value(kind, value))


def _degrees(angle: float) -> str:
    value = math.degrees(math.remainder(angle, 2 * math.pi))
    return f"{value:.2f}".replace("-", "−") + " deg" if value >= 0 else f"(−{-value:.2f} deg)"


def closed(letters: str, numbers: str, total: float, largest: float, shown: Shown, kind: str) -> Working:
    value = 0.0 if abs(total) < 1e-9 * largest else total
    return Working(f"{letters} = 0", f'{numbers} = {number_text(shown, kind, value)} "{shown.unit(kind)}"')
