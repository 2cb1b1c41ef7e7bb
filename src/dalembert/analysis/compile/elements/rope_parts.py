"""A rope as what it consists of: strands between points and wheels, and a pulley for each wheel that it runs over.

A strand is a row between two links. Where the rope runs over a pulley, or slides on a fixed wheel, a link without mass
represents the rope at that place, on a pin of the wheel's link: its equilibrium says that both tensions are equal, but
for friction. Mechanics: docs/theory.md 5.7.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from dalembert.analysis.compile.plane_rows import numbers
from dalembert.arrays import Numeric
from dalembert.core.elements.strand_limits import RopeGrips
from dalembert.errors import ModelError
from dalembert.model import GROUND, Link, Mechanism
from dalembert.model.joints.elements.ropes import Rope, RopePoint, Sheave, StrandJoint
from dalembert.model.joints.elements.written_parts import as_rope
from dalembert.model.quantities.values import Vector

LEVER = 0.1
"""Metres of rope to a radian of a pulley that is a point; no force depends on it."""

CENTRE = "O"
SAME = 1e-9
"""Metres, and radians of directions, below which two are the same."""


class _End(NamedTuple):
    """A point of the rope: link and point, signed radius, and rope to a radian of the link."""

    link: str
    point: str
    radius: Numeric
    winds: Numeric


def with_rope_parts(m: Mechanism) -> Mechanism:
    """The mechanism with strands and pulleys for its ropes and belts with idlers; itself without."""
    ropes = {name: as_rope(name, joint) for name, joint in m.joints.items()}
    if not any(ropes.values()):
        return m
    links, joints = dict(m.links), dict[str, Any]()
    for name, joint in m.joints.items():
        rope = ropes[name]
        if rope is None:
            joints[name] = joint
            continue
        for part, made in _parts(m, name, rope):
            if isinstance(made, Link):
                links[part] = made
            else:
                joints[part] = made
    return m.model_copy(update={"links": links, "joints": joints}).standing_for(m)


def strand_names(m: Mechanism, name: str) -> list[str]:
    """Names of the strands of a rope."""
    return [f"{name}_{k}" for k in range(1, len(m.ropes[name].through))]


class RopeWheel(NamedTuple):
    """A wheel between two strands of a rope.

    place: among the points of the rope, 0 of the wheel on which its ends meet; wedge: by which friction is stronger in
    a groove, the sine of half its angle; way: 1 where the rope turns counter-clockwise; drives: True if the rope holds
    to it; holds: the coefficient at rest by which it does, None without a coefficient or without slip.
    """

    link: str
    point: str
    place: int
    way: int
    turns: Numeric
    drives: bool
    holds: Numeric | None
    wedge: Numeric


def rope_wheels(m: Mechanism, name: str) -> tuple[RopeWheel, ...]:
    """The wheels and eyes of a rope, without its ends unless they meet on a wheel."""
    out, rope = list[RopeWheel](), m.ropes[name]
    points, wedge, grip = rope.through, getattr(rope, "wedge", 1.0), getattr(rope, "grip", None)
    for k in [*range(1, len(points) - 1), *([0] if rope.RING else [])]:
        point = points[k]
        drives, f = not is_pulley(m, point), point.friction or grip
        holds = None
        if drives and f is not None and m.friction.enabled:
            parts = (f.static, f.coefficient, m.friction.static, m.friction.coefficient)
            mu = next((mu for mu in parts if mu is not None), None)
            holds = None if mu is None else mu / wedge
        way = 1 if point.side == "right" else -1
        link, at = point.round
        out.append(RopeWheel(link, at, k, way, point.turns, drives, holds, wedge))
    return tuple(out)


def _parts(m: Mechanism, name: str, rope: Rope) -> Iterator[tuple[str, Link | StrandJoint | Sheave]]:
    if rope.RING:
        _refuse_untensioned(m, name, rope)
    names = strand_names(m, name)
    directions = _directions(m, name, rope)
    ends: list[_End] = []
    for k, point in enumerate(rope.through):
        inside = 0 < k < len(rope.through) - 1
        if not inside or not is_pulley(m, point):
            ends.append(_End(*point.round, *(_signed(point, point.radius),) * 2))
            continue
        part, lever = f"{name}_pulley_{k}", point.radius or LEVER
        ends.append(_End(part, CENTRE, _signed(point, point.radius), _signed(point, lever)))
        yield part, Link(points={CENTRE: (0.0, 0.0)})
        fixed = point.friction is not None
        yield (
            part,
            Sheave.model_construct(
                links=(point.round[0], part),
                at=(point.round[1], CENTRE),
                rope=name,
                radius=point.radius,
                lever=lever,
                turns=point.turns,
                side=point.side or "left",
                strands=(names[k - 1], names[k]),
                grip=point.friction,
                efficiency=None if fixed else point.efficiency or rope.efficiency,
            ),
        )
    for k, strand in enumerate(names):
        i, j = ends[k], ends[k + 1]
        yield (
            strand,
            StrandJoint.model_construct(
                links=(i.link, j.link),
                at=(i.point, j.point),
                rope=name,
                radii=(i.radius, j.radius),
                winds=(i.winds, j.winds),
                direction=directions[k],
            ),
        )


def _signed(point: RopePoint, size: Numeric) -> Numeric:
    return -size if point.side == "right" else size


def is_pulley(m: Mechanism, point: RopePoint) -> bool:
    """True if the rope runs over the wheel, or slides on it: False where it holds to a link that turns about it."""
    if point.pulley is not None:
        return point.pulley
    link, at = point.round
    place = m.point(link, at)
    for name, joint in m.joints.items():
        if joint.hinge and link in joint.links and link != GROUND:
            pin = m.joint_points(name)[joint.links.index(link)]
            if _together(pin, place):
                return False
    return True


def _together(a: Vector, b: Vector) -> bool:
    """True if two points of a link are one; of symbols, if they are the same ones."""
    pairs = list(zip(a, b, strict=True))
    if all(x is y for x, y in pairs):
        return True
    numeric = all(isinstance(x, (int, float)) for pair in pairs for x in pair)
    return numeric and math.dist(a, b) < SAME


def _refuse_untensioned(m: Mechanism, name: str, rope: Rope) -> None:
    """Raise ModelError for a belt all of whose wheels keep their places: its tension follows from nothing."""
    carried = (p.round[0] for p in rope.through if p.pulley is None and is_pulley(m, p))
    if all(link == GROUND for link in carried):
        what = (
            f"belt {name!r}: none of its idlers is on a link that moves with it, so its tension is not known"
        )
        remedy = "put one on an arm or a slide, with a weight or a spring that presses it on the belt"
        raise ModelError(what, remedy, ("joints", name, "idlers"))


def _directions(m: Mechanism, name: str, rope: Rope) -> list[Numeric | None]:
    """Direction of each strand of a rope with parallel strands, one forth and the next back."""
    count = len(rope.through) - 1
    if rope.parallel is False:
        return [None] * count
    slides = _slides(m)
    touched = [slides[p.round[0]] for p in rope.through if p.round[0] in slides]
    if rope.parallel is not True:
        e: Numeric = rope.parallel
    elif not touched or any(abs(math.sin(a - touched[0])) > SAME for a in touched):
        what = f"rope {name!r}: the direction of its parallel strands is not clear"
        remedy = "its ends slide along different directions, or along none; write parallel: 90 deg"
        raise ModelError(what, remedy, ("joints", name, "parallel"))
    else:
        e = touched[0]
    back = _first_backwards(rope, slides, e)
    return [e + (math.pi if (k + back) % 2 else 0.0) for k in range(count)]


def _slides(m: Mechanism) -> dict[str, float]:
    """Links that slide on the ground, with the direction."""
    return {
        joint.links[1]: joint.direction
        for joint in m.joints.values()
        if joint.guides and joint.links[0] == GROUND and hasattr(joint, "direction")
    }


def _first_backwards(rope: Rope, slides: dict[str, float], e: Numeric) -> int:
    """1 if the first strand is against e: a link that slides is at a positive coordinate of its slide."""
    for k, (a, b) in enumerate(zip(rope.through, rope.through[1:], strict=False)):
        first, second = a.round[0] in slides, b.round[0] in slides
        if first != second:
            along = math.cos(slides[(a if first else b).round[0]] - e) > 0
            return (k + int(along == first)) % 2
    return 0


def rope_grips(m: Mechanism) -> RopeGrips | None:
    """The wheels that ropes turn by friction, strands in their order; None without ropes, or without limits."""
    if not m.ropes or not m.has_limits:
        return None
    wheels: list[tuple[int, int, RopeWheel]] = []
    first = 0
    for name, rope in m.ropes.items():
        count = len(rope.through) - 1
        held = (w for w in rope_wheels(m.written, name) if w.holds is not None)
        wheels += [(first + (w.place - 1) % count, first + w.place, w) for w in held]
        first += count
    before, after, way = (
        np.array(part, np.intp)
        for part in ([w[0] for w in wheels], [w[1] for w in wheels], [w[2].way for w in wheels])
    )
    turns, least = ([getattr(w, key) for *_, w in wheels] for key in ("turns", "holds"))
    return RopeGrips(before, after, way, numbers(turns), numbers(least))
