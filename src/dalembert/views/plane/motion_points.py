"""Points of the links that velocity and acceleration polygons show, by the letters of the notes, and their motion."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.compile.load_arrays import point_of
from dalembert.analysis.methods.applied_forces import link_place, state
from dalembert.arrays import Array
from dalembert.model import GROUND, Joint
from dalembert.views.notation import Shown, load_sign
from dalembert.views.plane.outline import load_places

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


class PointLabel(NamedTuple):
    """A point of a link: its symbol (`B`, `G_{2}`), its letter in a polygon (`b`, `g_{2}`), its place in the link's
    axes, and whether it is a joint's, with separate arrows and sides; ``sliding``: the joint in which another link's
    point slides over it."""

    sign: str
    letter: str
    u: Array
    joint: bool = True
    sliding: str = ""


def letter(sign: str) -> str:
    """A point's letter in a polygon: b of B, g2 of G2.

    >>> letter("B"), letter("G_{2}"), letter("B2"), letter("cylinder")
    ('b', 'g_{2}', 'b_{2}', 'cylinder')
    """
    if match := re.fullmatch(r"([A-Z])(\d*)(_\{.*)?", sign):
        head, number, index = match.groups("")
        return head.lower() + (f"_{{{number}}}" if number else "") + index
    return sign


def spots(r: Result, k: int, shown: Shown) -> dict[str, list[PointLabel]]:
    """Points of each moving link: joints, points that others slide over, points of loads, mass centres; one
    per place."""
    m = r.mechanism
    out: dict[str, list[PointLabel]] = {link: [] for link in r.links}
    for name, joint in sorted(m.joints.items(), key=lambda pair: pair[1].slides):
        for link, u in zip(joint.links, m.joint_points(name), strict=True):
            if link in out and (link == _holder(joint) or not (joint.apart or joint.wheels)):
                _add(out[link], PointLabel(name, letter(name), np.asarray(u, float)))
    for name, joint in m.joints.items():
        rail = joint.links[0] if _holder(joint) == joint.links[1] else joint.links[1]
        if joint.apart and rail in out:
            place = np.asarray(
                link_place(r, _holder(joint), m.joint_points(name)[joint.links.index(_holder(joint))])[k]
            )
            sign = f"{_pin(out.get(_holder(joint), []), r, _holder(joint), place, k, name)}_{{{shown.link(rail)}}}"
            _add(out[rail], PointLabel(sign, letter(sign), _local(r, rail, place, k), sliding=name))
    for link in r.links:
        for name, u in load_places(m, link).items():
            sign = load_sign(name) if name in m.loads else name
            small = sign if name in m.loads else letter(name)
            _add(out[link], PointLabel(sign, small, np.asarray(u, float), joint=False))
        if m.mass(link):
            sign, center = f"G_{{{shown.link(link)}}}", np.asarray(point_of(m, link, "center"))
            _add(out[link], PointLabel(sign, letter(sign), center, joint=False))
    return out


def _holder(joint: Joint) -> str:
    """The link whose point of a joint slides or is the centre of a wheel: j, or i where j is the ground."""
    i, j = joint.links
    return j if j != GROUND else i


def _add(some: list[PointLabel], spot: PointLabel) -> None:
    if all(float(np.abs(other.u - spot.u).max()) > 1e-12 for other in some):
        some.append(spot)


def _pin(some: list[PointLabel], r: Result, link: str, place: Array, k: int, name: str) -> str:
    """Symbol of the sliding point: that of a pin at the same place, or the joint's."""
    near = 1e-9 * r.compiled.layout.length
    near_signs = (s.sign for s in some if float(np.abs(link_place(r, link, s.u)[k] - place).max()) < near)
    return next(near_signs, name)


def _local(r: Result, link: str, place: Array, k: int) -> Array:
    """A place of the ground in a link's axes."""
    angle = float(r.angle(link)[k])
    x, y = place - link_place(r, link, (0.0, 0.0))[k]
    return np.array([math.cos(angle) * x + math.sin(angle) * y, math.cos(angle) * y - math.sin(angle) * x])


class Rates(NamedTuple):
    """Velocity and acceleration of points at one position, and angular rates; for a drive at unit speed, no
    acceleration."""

    r: Result
    k: int
    twists: Array

    def spin(self, link: str) -> float:
        """Angular velocity, rad/s."""
        return 0.0 if link == GROUND else float(self.twists[self.r.links.index(link), 2])

    def velocity(self, link: str, u: Array) -> Array:
        """Velocity of a point (2,), m/s."""
        vx, vy, w = self.twists[n := self.r.links.index(link)]
        place = link_place(self.r, link, u)[self.k] - np.asarray(self.r.compiled.origin, float)
        x, y = place - self.r.point_array[self.k, n]
        return np.array([vx - w * y, vy + w * x])

    def acceleration(self, link: str, u: Array) -> Array:
        """Acceleration of a point (2,), m/s2."""
        return np.asarray(self.r._acceleration(link, np.asarray(u, float))[self.k])


def rates(r: Result, k: int, drive: int | None = None) -> Rates:
    """The motion at a position; for a drive, at 1 rad/s or m/s with the others at rest."""
    return Rates(r, k, r.twist_array[k] if drive is None else state(r).moving.virtual[k, drive])
