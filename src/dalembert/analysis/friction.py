"""What friction does in each joint, read from a result: forces, losses, contact of guides, friction circles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from dalembert.analysis.contacts import circle, coefficient
from dalembert.core.friction import Contacts, strength
from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.analysis.result import Result
    from dalembert.analysis.rubbing import Friction

Array = NDArray[Any]
Loss = Literal["dry", "viscous", "all"]


def assumption(result: Result) -> str:
    """Whether there is friction, and which circle its pins have: 'on, friction circles of R sin(phi)'."""
    m = result.mechanism
    if result.friction is None:
        there = any(getattr(j, "friction", None) is not None for j in m.joints.values())
        return "off (switched off)" if there and not m.friction.enabled else "off"
    circles: dict[str, list[str]] = {}
    for name, joint in m.joints.items():
        f = getattr(joint, "friction", None)
        if getattr(f, "radius", None):
            circles.setdefault("R sin(phi)" if circle(m, joint) == "sin" else "mu R", []).append(name)
    if len(circles) == 1:
        return f"on, friction circles of {next(iter(circles))}"
    parts = [f"of {kind} in {', '.join(names)}" for kind, names in circles.items()]
    return ", ".join(["on", *(["friction circles " + " and ".join(parts)] if parts else [])])


def interval(result: Result, name: str) -> Array:
    """Low and high end (P, 2) of an effort or unknown load; equal where it is a number."""
    unknowns = _unknown_names(result)
    if name not in unknowns:
        raise ModelError(
            f"{name!r} is neither an effort nor a load that was asked for",
            f"there are: {', '.join(unknowns)}",
        )

    def value(r: Result) -> Array:
        return r.effort(name) if name in r.drives else r.unknown_load(name)

    if not result.ends:
        return np.stack([value(result)] * 2, axis=-1)
    return np.stack([value(end) for end in result.ends[unknowns.index(name)]], axis=-1)


def _unknown_names(result: Result) -> list[str]:
    asked = result.compiled.known.asked
    return [*(d for d, a in zip(result.drives, asked, strict=True) if a), *result.unknown_loads]


def joints_at_limit(result: Result, position: int = 0) -> tuple[str, ...]:
    """Joints whose friction is at its limit at one end of an interval: ask it of ``result.ends``."""
    f, contacts = _of(result)
    at_limit = (f.sense[position] != 0) & ~contacts.fixed
    return tuple(dict.fromkeys(result.joints[k] for k in contacts.joint[at_limit]))


def _of(result: Result) -> tuple[Friction, Contacts]:
    if result.friction is None or result.compiled.contacts is None:
        raise ModelError("this result has no friction", "give a joint `friction`, and do not switch it off")
    return result.friction, result.compiled.contacts


def power_lost(result: Result, joint: str, kind: Loss = "all") -> Array:
    """Power (P,) that friction takes in a joint, W; zero without friction."""
    k = result.joints.index(joint)
    f = result.friction
    if f is None:
        return np.zeros(len(result.status))
    parts = {"dry": f.dry_loss, "viscous": f.viscous_loss, "all": f.dry_loss + f.viscous_loss}
    return np.asarray(parts[kind][:, k])


def bearing_contact(result: Result, joint: str, kind: str) -> int:
    """Index of a joint's contact of a kind."""
    _, contacts = _of(result)
    for e, found in enumerate(result.compiled.contact_kinds):
        if result.joints[contacts.joint[e]] == joint and found == kind:
            return e
    raise ModelError(
        f"joint {joint!r} has no friction of a {kind}", "ask a joint that has", ("joints", joint)
    )


def bears_on_faces(result: Result, joint: str) -> bool:
    """Whether a joint is a slider with friction."""
    j = result.mechanism.joints[joint]
    return result.friction is not None and j.type == "slider" and j.friction is not None


@dataclass(frozen=True)
class GuideContact:
    """Where a guide bears, over P positions.

    normal, couple (P,): of the contact forces about j's point; lower, upper (P,): loads on the two faces, both positive
    mode: `lower face`, `upper face`, or the diagonals `lower ahead, upper behind` and `lower behind, upper ahead`
    angle (P,): of the reaction to the normal, atan of friction over normal force
    """

    normal: Array
    couple: Array
    lower: Array
    upper: Array
    mode: tuple[str, ...]
    angle: Array


def guide_contact(result: Result, joint: str) -> GuideContact:
    """Contact of a slider with friction: which faces bear, and how much.

    The lower face pushes j to the left of the direction of the slide. S = max(|N|, |2M - (l2 - l1) N| / (l1 + l2)) is
    the sum of the contact forces, lower (S + N) / 2 and upper (S - N) / 2.
    """
    f, _ = _of(result)
    e = bearing_contact(result, joint, "guide")
    normal, tilting = f.argument[:, 0, e], f.argument[:, 2, e]
    total = np.maximum(np.abs(normal), np.abs(tilting))
    couple = result.reaction_moment(joint) - result.friction_moment(joint)
    tilted = np.abs(tilting) > np.abs(normal)
    ahead = np.where(tilting > 0, "lower ahead, upper behind", "lower behind, upper ahead")
    mode = np.where(tilted, ahead, np.where(normal >= 0, "lower face", "upper face"))
    angle = np.arctan2(np.abs(f.cz[:, e]), np.abs(normal))
    lower, upper = (total + normal) / 2, (total - normal) / 2
    return GuideContact(normal, couple, lower, upper, tuple(str(m) for m in mode), angle)


@dataclass(frozen=True)
class Line:
    """A line in ground axes: a point (P, 2) and a unit vector (P, 2)."""

    point: Array
    direction: Array


@dataclass(frozen=True)
class FrictionCircle:
    """The friction circle of a pin and the line of its reaction.

    center (P, 2), radius; taken: the line on which the reaction acts, through the point where it touches the circle;
    others: where a link of the joint carries two circles and nothing else, the tangents of both that were not taken;
    reasons (P,): why this one.
    """

    center: Array
    radius: float
    taken: Line
    others: tuple[Line, ...]
    reasons: tuple[str, ...]


def friction_circle_radius(result: Result, joint: str) -> float:
    """R sin(phi) or mu R of a pin, m; 0 without friction."""
    j = result.mechanism.joints[joint]
    f = getattr(j, "friction", None)
    if result.friction is None or getattr(f, "radius", None) is None:
        return 0.0
    _, contacts = _of(result)
    return float(strength(contacts, 1.0)[bearing_contact(result, joint, "pin")])


def friction_circles(result: Result, joint: str) -> FrictionCircle:
    """Circle, line of action, the other tangents and the reason of one pin (``joint``)."""
    f, _ = _of(result)
    e = bearing_contact(result, joint, "pin")
    i, j = result.mechanism.joints[joint].links
    center = result.point(j, _point_name(result, joint)) if j != "ground" else _ground_point(result, joint)
    force, radius = result.reaction(joint), friction_circle_radius(result, joint)
    size = np.hypot(force[:, 0], force[:, 1])
    unit = force / np.where(size > 0, size, 1.0)[:, None]
    # a couple m with the force F is the force on a line at arm p, p x F = m
    offset = (
        np.stack([unit[:, 1], -unit[:, 0]], axis=-1) * (f.cz[:, e] / np.where(size > 0, size, 1.0))[:, None]
    )
    reasons = tuple(
        _reason(i, j, rate, sense) for rate, sense in zip(f.rate[:, e], f.sense[:, e], strict=True)
    )
    return FrictionCircle(center, radius, Line(center + offset, unit), _others(result, joint), reasons)


def _point_name(result: Result, joint: str) -> str:
    return str(result.mechanism.joints[joint].point_names(joint)[1])


def _ground_point(result: Result, joint: str) -> Array:
    point = np.array(result.mechanism.joint_points(joint)[1])
    return np.broadcast_to(point, (len(result.status), 2))


def _reason(i: str, j: str, rate: float, sense: float) -> str:
    if sense == 0:
        return f"{j} does not turn against {i}: any line that meets the circle may be taken"
    turns, against = ("counter-clockwise", "clockwise") if sense > 0 else ("clockwise", "counter-clockwise")
    verb = "turns" if rate else "is about to turn"
    return (
        f"{j} {verb} {turns} against {i}, so the reaction passes the pin on the side that turns {j} {against}"
    )


def _others(result: Result, joint: str) -> tuple[Line, ...]:
    """The tangents of two circles that a two-force member does not take: its other three."""
    for link in result.mechanism.joints[joint].links:
        pins = [n for n, j in result.mechanism.joints.items() if link in j.links]
        if link == "ground" or len(pins) != 2 or any(result.mechanism.joints[n].type != "pin" for n in pins):
            continue
        if _two_forces(result, link, pins[0], pins[1]):
            return _tangents(result, joint, pins[1] if pins[0] == joint else pins[0])
    return ()


def _two_forces(result: Result, link: str, first: str, second: str) -> bool:
    """Whether two pins are all that loads a link, at every position."""
    a, b = result.reaction(first, on=link), result.reaction(second, on=link)
    span = _center(result, second) - _center(result, first)
    moment = result.reaction_moment(first, on=link) + result.reaction_moment(second, on=link)
    moment = moment + span[:, 0] * b[:, 1] - span[:, 1] * b[:, 0]
    size = np.maximum(np.abs(a).max(axis=-1), 1e-300)
    off = np.maximum(np.abs(a + b).max(axis=-1), np.abs(moment) / result.compiled.layout.length)
    return bool(np.nanmax(off / size, initial=0.0) <= 1e-9)


def _tangents(result: Result, joint: str, other: str) -> tuple[Line, ...]:
    """Common tangents of two friction circles but the one taken, each through its point on the circle of ``joint``."""
    here, there = (_center(result, n) for n in (joint, other))
    r = [friction_circle_radius(result, n) for n in (joint, other)]
    span = there - here
    length = np.hypot(span[:, 0], span[:, 1])
    e = span / length[:, None]
    across = np.stack([-e[:, 1], e[:, 0]], axis=-1)
    taken = _sides(result, joint, other, across)
    lines = []
    for sides in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        sine = (sides[0] * r[0] - sides[1] * r[1]) / length
        n = sine[:, None] * e + np.sqrt(np.maximum(1 - sine * sine, 0.0))[:, None] * across
        direction = np.stack([n[:, 1], -n[:, 0]], axis=-1)
        same = (taken[:, 0] == sides[0]) & (taken[:, 1] == sides[1])
        point = np.where(same[:, None], np.nan, here + sides[0] * r[0] * n)
        lines.append(Line(point, np.where(same[:, None], np.nan, direction)))
    return _without_taken(lines)


def _without_taken(lines: list[Line]) -> tuple[Line, ...]:
    """Three lines: at each position those of the four that are not NaN, in their order."""
    points, directions = np.stack([x.point for x in lines]), np.stack([x.direction for x in lines])
    order = np.argsort(np.isnan(points[:, :, 0]), axis=0, kind="stable")[:3]
    every = np.arange(points.shape[1])
    return tuple(Line(points[k, every], directions[k, every]) for k in order)


def _sides(result: Result, joint: str, other: str, across: Array) -> Array:
    """On which side of the line of centres the line taken passes each pin: 1 left (towards across), -1 right."""
    out = []
    for name in (joint, other):
        f, _ = _of(result)
        e = bearing_contact(result, name, "pin") if friction_circle_radius(result, name) else None
        if e is None:
            out.append(np.zeros(len(across)))
            continue
        force = result.reaction(name)
        arm = np.stack([force[:, 1], -force[:, 0]], axis=-1) * f.cz[:, e, None]
        out.append(np.sign((arm * across).sum(axis=-1)))
    return np.stack(out, axis=-1)


def _center(result: Result, joint: str) -> Array:
    j = result.mechanism.joints[joint].links[1]
    return _ground_point(result, joint) if j == "ground" else result.point(j, _point_name(result, joint))


def friction_text(result: Result, joint: str) -> str:
    """The friction of a joint in words: 'mu 0.1, friction circle 2 mm'."""
    j = result.mechanism.joints[joint]
    if getattr(j, "friction", None) is None:
        return "viscous"
    text = f"mu {coefficient(result.mechanism, j):.6g}"
    radius = friction_circle_radius(result, joint)
    return f"{text}, friction circle {radius * 1e3:.6g} mm" if radius else text
