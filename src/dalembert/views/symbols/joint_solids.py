"""Wheels of joints as solids in their links' axes; a planar mechanism has its links in layers along z."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.arrays import Array
from dalembert.model import GROUND
from dalembert.views.space.solids import Plate, Ring, RoundBar, Solid, circle

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

LAYER = 2.2
"""Distance of the layers of a planar mechanism, mm."""

STEEP = 0.8
"""Helix angle in radians beyond which the first wheel of a gear is a worm."""


def lift(r: Result, link: str, u: Sequence[float] | Array, size: float = 0.0) -> Array:
    """A point of a link with three components; in the plane in the link's layer."""
    if r.mechanism.dimension == 3:
        return np.asarray(u, float)
    return np.array([*map(float, u), size * LAYER * (0 if link == GROUND else 1 + r.links.index(link))])


def wheels(r: Result, name: str, size: float = 0.0) -> list[tuple[str, Array, Array, float]]:
    """Link, centre and axis in link axes, and pitch radius, of the wheels of a gear or rolling joint."""
    joint: Any = r.mechanism.joints[name]
    axes = [np.array(f[2]) for f in joint.frames] if r.mechanism.dimension == 3 else [np.eye(3)[2]] * 2
    places = zip(joint.links, r.mechanism.joint_points(name), axes, joint.pitch_radii, strict=True)
    return [(link, lift(r, link, u, size), axis, float(radius)) for link, u, axis, radius in places if radius]


def wheel_sizes(r: Result, name: str, size: float) -> list[tuple[str, Array, Array, float, float]]:
    """Link, centre, axis, radius and half length of each wheel: a worm is twice as long as wide, others are thin."""
    joint = r.mechanism.joints[name]
    return [
        (link, at, axis, radius, 2.0 * radius if is_worm(joint, n) else 0.7 * size)
        for n, (link, at, axis, radius) in enumerate(wheels(r, name, size))
    ]


def is_worm(joint: Any, n: int) -> bool:
    """True for the first wheel of a gear whose teeth are as steep as a thread."""
    return n == 0 and abs(getattr(joint, "helix_angle", None) or 0.0) > STEEP


def wheel_solids(r: Result, name: str, size: float) -> list[tuple[str, Solid]]:
    """Discs; a ring for the wheel around an internal one; a worm has a thread."""
    joint: Any = r.mechanism.joints[name]
    discs = wheel_sizes(r, name, size)
    largest = max(radius for *_, radius, _ in discs)
    out: list[tuple[str, Solid]] = []
    for n, (link, at, axis, radius, half) in enumerate(discs):
        if joint.internal and radius == largest:
            out.append((link, Ring(at, axis, radius + 0.9 * size, 0.9 * size)))
            continue
        if is_worm(joint, n):
            lead = 2 * np.pi * radius / np.tan(joint.helix_angle)
            out.append((link, RoundBar(at - half * axis, at + half * axis, radius, thread=lead)))
            continue
        out.append((link, Plate(circle(at, axis, radius, 48)[:-1], 2 * half, spoke=True)))
    return out
