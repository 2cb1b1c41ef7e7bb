"""The two lines that meet at a hinge and make its transmission angle, and the fixed points moments are taken about.

A link's line goes from the hinge to its other joint; where that is a slider, across the slide, as if its pin stood far
away. Of several other joints the first in the file is meant, or the one that is named: ``transmission.B.A.O4``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array, Numeric
from dalembert.errors import ModelError
from dalembert.model import GROUND, Mechanism
from dalembert.model.joints.plane_joints import Pin, Slider
from dalembert.model.quantities.values import Vector
from dalembert.wording import closest


class LinkLine(NamedTuple):
    """A direction (2,) in the axes of a link, or of ground."""

    link: str
    along: Array
    slides: bool = False


OfLines = Callable[[Array, Array, Sequence[LinkLine]], Numeric]
"""Function of the two lines at a pin, turned to their directions (..., 2), and as they are on their links."""


def transmission_names(m: Mechanism) -> list[str]:
    """The hinges between moving links, by themselves and with the other joints that may be meant."""
    out = []
    for joint, part in m.joints.items():
        ends = [_others(m, link, joint) for link in part.links]
        if m.dimension == 2 and isinstance(part, Pin) and GROUND not in part.links and all(ends):
            out.append(joint)
            several = max(len(some) for some in ends) > 1
            out += [f"{joint}.{a}.{b}" for a in ends[0] for b in ends[1] if several]
    return out


def transmission_lines(m: Mechanism, of: str) -> tuple[LinkLine, LinkLine]:
    """Lines of the links i and j of a pin."""
    names = transmission_names(m)
    joint, *others = of.split(".")
    if of not in names:
        hint = (
            closest(of, names) if names else "it needs a pin between two moving links of a planar mechanism"
        )
        raise ModelError(f"{of!r} has no transmission angle", hint)
    part = m.joints[joint]
    chosen = others or [_others(m, link, joint)[0] for link in part.links]
    first, second = (
        _line(m, link, joint, at, other)
        for link, at, other in zip(part.links, m.joint_points(joint), chosen, strict=True)
    )
    return first, second


def _others(m: Mechanism, link: str, joint: str) -> list[str]:
    """Other joints of a link that a line can go to."""
    return [
        name
        for name, part in m.joints.items()
        if name != joint and link in part.links and not part.wheels and part.FREEDOMS
    ]


def _line(m: Mechanism, link: str, joint: str, at: Vector, other: str) -> LinkLine:
    part = m.joints[other]
    if isinstance(part, Slider):
        angle = part.direction
        return LinkLine(part.links[0], np.array([-np.sin(angle), np.cos(angle)]), slides=True)
    far = m.joint_points(other)[part.links.index(link)]
    return LinkLine(link, np.subtract(far, at))


def transmission_angle(a: Array, b: Array, lines: Sequence[LinkLine]) -> Numeric:
    """Acute angle of two lines (..., 2), 0 to a quarter turn."""
    across = abs(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])
    return np.arctan2(across, abs((a * b).sum(axis=-1)))


def closure_margin(a: Array, b: Array, lines: Sequence[LinkLine]) -> Numeric:
    """Distance by which the far ends of two lines (..., 2) could move apart, or together, before the lines are
    stretched or folded and the linkage opens: min(a + b - d, d - |a - b|); across a slide, a - |offset|.

    Over a full turn of a four-bar's crank its least value is the margin of Grashof's condition for that crank.
    """
    slides = [line.slides for line in lines]
    if all(slides):
        raise ModelError(
            "a pin between two links that slide has no closure margin", "take its transmission angle"
        )
    if any(slides):
        size = np.sqrt(((b if slides[0] else a) ** 2).sum(axis=-1))
        return size - abs((a * b).sum(axis=-1))
    one, two, distance = (np.sqrt((x * x).sum(axis=-1)) for x in (a, b, a - b))
    stretched, folded = one + two - distance, distance - abs(one - two)
    return (stretched + folded - abs(stretched - folded)) / 2


def ground_points(m: Mechanism) -> dict[str, Vector]:
    """Points that stand still, by name: the joints with the ground, then the points of the ground."""
    joints = {n: m.joint_points(n)[j.links.index(GROUND)] for n, j in m.joints.items() if GROUND in j.links}
    points = m.points(GROUND) if GROUND in m.links else {}
    return {**joints, **{n: at for n, at in points.items() if n not in joints}}
