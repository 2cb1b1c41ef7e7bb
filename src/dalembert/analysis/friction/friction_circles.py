"""Friction circles: the line of action of a pin's reaction, the common tangents of two circles, and why this one.

Mechanics: docs/theory.md 6.1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.friction.joint_friction import (
    bearing_contact,
    friction_circle_radii,
    friction_circle_radius,
    friction_of,
)
from dalembert.analysis.plane_only import refuse_space
from dalembert.answer.equality import Compared
from dalembert.arrays import Array
from dalembert.model import GROUND

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

NOTHING = 1e-9
"""A force below this part of the largest on the mechanism does not count."""


@dataclass(frozen=True, eq=False)
class ActionLine(Compared):
    """A line in ground axes: a point (P, 2) and a unit vector (P, 2)."""

    point: Array
    direction: Array


@dataclass(frozen=True, eq=False)
class FrictionCircle(Compared):
    """The friction circle of a pin and the line of its reaction.

    center (P, 2), radius; radii (P,): with the coefficient at rest where the sense is not known; taken: the line on
    which the reaction acts, through the point where it touches the circle; others: where a link of the joint carries
    two pins and nothing else, the common tangents of both circles that were not taken (NaN where two circles have
    fewer); reasons (P,): the reason for this line.
    """

    center: Array
    radius: float
    radii: Array
    taken: ActionLine
    others: tuple[ActionLine, ...]
    reasons: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class TwoPins(Compared):
    """A link that two pins alone load: the link, both joints, and its pull (P,), negative in compression."""

    link: str
    joints: tuple[str, str]
    tension: Array

    def state(self, k: int) -> str:
        """`tension`, `compression` or nothing, at position k."""
        pull = float(self.tension[k])
        return "tension" if pull > 0 else "compression" if pull < 0 else ""


def friction_circles(result: Result, joint: str) -> FrictionCircle:
    """Circle, line of action, the other tangents and the reason of one pin (``joint``).

    >>> import dalembert as da
    >>> from dalembert.bundled import cases
    >>> r = da.statics(da.load(cases()["seed-002-7a-engine-friction-circles"]))
    >>> circle = friction_circles(r, "A")
    >>> round(circle.radius, 6), len(circle.others)
    (0.024, 3)
    """
    refuse_space(result.mechanism, "a friction circle", "ask friction_moment and power_lost of the joint")
    f, _ = friction_of(result)
    e = bearing_contact(result, joint, "pin")
    force, center = result.reaction(joint), pin_center(result, joint)
    size = np.hypot(force[:, 0], force[:, 1])
    least = NOTHING * np.nanmax(np.abs(result.force_array), axis=(1, 2), initial=0.0)
    safe = np.where(size > least, size, np.inf)  # nothing has no direction
    unit = force / safe[:, None]
    # a couple m with the force F is the force on a line at arm p, p x F = m
    offset = np.stack([unit[:, 1], -unit[:, 0]], axis=-1) * (f.cz[:, e] / safe)[:, None]
    two = two_pins(result, joint)
    reasons = tuple(circle_reason(result, joint, k) for k in range(len(result.status)))
    others = _tangents(result, joint, two.joints[two.joints[0] == joint]) if two is not None else ()
    radius, radii = friction_circle_radius(result, joint), friction_circle_radii(result, joint)
    return FrictionCircle(center, radius, radii, ActionLine(center + offset, unit), others, reasons)


def pin_center(result: Result, joint: str) -> Array:
    """Middle of a pin (P, 2), ground axes."""
    described = result.mechanism.joints[joint]
    j = described.links[1]
    if j == GROUND:
        point = np.array(result.mechanism.joint_points(joint)[1])
        return np.broadcast_to(point, (len(result.status), 2))
    return result.point(j, str(described.point_names(joint)[1]))


def circle_reason(result: Result, joint: str, position: int, on: str | None = None) -> str:
    """Why the reaction on one of a pin's links (default j) passes its centre on the side it does."""
    i, j = result.mechanism.joints[joint].links
    this, other, sign = (i, j, -1.0) if on == i else (j, i, 1.0)
    f, _ = friction_of(result)
    e = bearing_contact(result, joint, "pin")
    sense, rate = sign * float(f.sense[position, e]), float(f.rate[position, e])
    if not np.isfinite(sense) or sense == 0:
        return f"{this} does not turn against {other}: any line that meets the circle may be taken"
    turns, against = ("counter-clockwise", "clockwise") if sense > 0 else ("clockwise", "counter-clockwise")
    moving = bool(rate or f.reversing[position, e]) and not f.open[position, e]
    verb = "turns" if moving else "is about to turn"
    words = (
        f"{this} {verb} {turns} against {other}, so the reaction passes the pin on the side that turns {this} "
        f"{against}"
    )
    two = two_pins(result, joint)
    return f"{words}; {two.link} is in {two.state(position)}" if two and two.state(position) else words


def two_pins(result: Result, joint: str) -> TwoPins | None:
    """The link of a joint that two pins alone load at every position, with friction in them or not."""
    m = result.mechanism
    for link in m.joints[joint].links:
        pins = [n for n, d in m.joints.items() if link in d.links]
        if link == GROUND or len(pins) != 2 or not all(m.joints[n].hinge for n in pins):
            continue
        first, second = pins
        if _two_forces(result, link, first, second):
            span = pin_center(result, second) - pin_center(result, first)
            force = result.reaction(second, on=link)
            pull = np.hypot(*force.T) * np.sign((force * span).sum(axis=-1))
            return TwoPins(link, (first, second), np.asarray(pull))
    return None


def _two_forces(result: Result, link: str, first: str, second: str) -> bool:
    """True if two pins carry all loads of a link, at every position."""
    a, b = result.reaction(first, on=link), result.reaction(second, on=link)
    span = pin_center(result, second) - pin_center(result, first)
    moment = result.reaction_moment(first, on=link) + result.reaction_moment(second, on=link)
    moment = moment + span[:, 0] * b[:, 1] - span[:, 1] * b[:, 0]
    size = np.maximum(np.abs(a).max(axis=-1), 1e-300)
    off = np.maximum(np.abs(a + b).max(axis=-1), np.abs(moment) / result.compiled.layout.length)
    known = np.isfinite(off)
    least = NOTHING * float(np.nanmax(np.abs(result.force_array), initial=0.0))
    loaded = known.any() and np.abs(a[known]).max() > least
    return bool(loaded and (off / size)[known].max() <= 1e-9)


def _tangents(result: Result, joint: str, other: str) -> tuple[ActionLine, ...]:
    """Common tangents of two friction circles but the one taken, each through its point on the circle of ``joint``."""
    here, far = (pin_center(result, n) for n in (joint, other))
    r = [friction_circle_radii(result, n) for n in (joint, other)]
    span = far - here
    length = np.hypot(span[:, 0], span[:, 1])
    e = span / length[:, None]
    across = np.stack([-e[:, 1], e[:, 0]], axis=-1)
    taken = tangent_sides(result, joint, other)
    lines = []
    for sides in ((a, b) for a in _possible(r[0].max()) for b in _possible(r[1].max())):
        sine = (sides[0] * r[0] - sides[1] * r[1]) / length
        with np.errstate(invalid="ignore"):  # circles that overlap have no inner tangents
            n = sine[:, None] * e + np.sqrt(1 - sine * sine)[:, None] * across
        same = (taken[:, 0] == sides[0]) & (taken[:, 1] == sides[1])
        direction = np.stack([n[:, 1], -n[:, 0]], axis=-1)
        point = np.where(same[:, None], np.nan, here + sides[0] * r[0][:, None] * n)
        lines.append(ActionLine(point, np.where(same[:, None], np.nan, direction)))
    return _drop_taken(lines)


def _possible(radius: float) -> tuple[int, ...]:
    """Sides on which a tangent passes a circle; a point has one."""
    return (1, -1) if radius else (0,)


def _drop_taken(lines: list[ActionLine]) -> tuple[ActionLine, ...]:
    """All lines but one: at each position those that are not NaN first, in their order."""
    points, directions = np.stack([x.point for x in lines]), np.stack([x.direction for x in lines])
    order = np.argsort(np.isnan(points[:, :, 0]), axis=0, kind="stable")[:-1]
    every = np.arange(points.shape[1])
    return tuple(ActionLine(points[k, every], directions[k, every]) for k in order)


def tangent_sides(result: Result, joint: str, other: str) -> Array:
    """On which side of the line from one pin to another the reaction passes each (P, 2): 1 left, -1 right."""
    f, _ = friction_of(result)
    span = pin_center(result, other) - pin_center(result, joint)
    across = np.stack([-span[:, 1], span[:, 0]], axis=-1)
    out = []
    for name in (joint, other):
        if not friction_circle_radius(result, name):
            out.append(np.zeros(len(across)))
            continue
        force = result.reaction(name)
        arm = np.stack([force[:, 1], -force[:, 0]], axis=-1)
        arm = arm * f.cz[:, bearing_contact(result, name, "pin"), None]
        out.append(np.sign((arm * across).sum(axis=-1)))
    return np.stack(out, axis=-1)
