"""The straight members of a link, and where what acts on the link has its base point.

Mechanics: docs/theory.md 10.4.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from dalembert.arrays import Array, Flags
from dalembert.errors import ModelError
from dalembert.machine.link_axes import in_space
from dalembert.model import GROUND

if TYPE_CHECKING:
    from dalembert.model import Mechanism

FLAT = 1e-9
"""Off a line by less than this part of its length is on it."""
DIGITS = 12
"""Decimals of a member's length by which places along it are distinguished."""


@dataclass(frozen=True)
class Straight:
    """A straight member in link axes: its ends by name, start (3,), length, axes (3, 3) in rows t, y, z."""

    ends: tuple[str, str]
    start: Array
    length: float
    axes: Array

    @property
    def along(self) -> Array:
        """Unit vector t (3,) from the first end to the second."""
        return np.asarray(self.axes[0])

    def foot(self, places: Array) -> tuple[Array, Array]:
        """For places (..., 3): distance of the nearest place on the member from its start, and their distance from
        it."""
        s = np.clip((places - self.start) @ self.along, 0.0, self.length)
        off = np.linalg.norm(places - self.start - s[..., None] * self.along, axis=-1)
        return self.rounded(s), off

    def rounded(self, s: Array | float) -> Array:
        """Distances without rounding noise, so that a place is on one side of a force or on the other."""
        return np.asarray(np.round(np.asarray(s) / self.length, DIGITS) * self.length)


def straight(ends: tuple[str, str], a: Array, b: Array) -> Straight:
    """The member from a to b: y is t turned by +90 degrees about the link's z axis, or y where t is along that."""
    length = float(np.linalg.norm(b - a))
    t = (b - a) / length
    across = np.cross((0.0, 0.0, 1.0), t)
    y = across / np.linalg.norm(across) if np.linalg.norm(across) > FLAT else np.array([0.0, 1.0, 0.0])
    return Straight(ends, a, length, np.array([t, y, np.cross(t, y)]))


def members_of(m: Mechanism, link: str, joints: Array) -> tuple[Straight, ...]:
    """The members of a link: as its file says, or the line through the places (N, 3) of its joints, link axes.

    Raises ModelError where these are on no line.
    """
    part = m.links[link]
    if part.members:
        lines = [straight(pair, *(in_space(m.point(link, end)) for end in pair)) for pair in part.members]
    else:
        lines = [_line(m, link, joints)]
    return tuple(lines)


def _line(m: Mechanism, link: str, joints: Array) -> Straight:
    """The line through joints, as far as named points go that are on it; of one joint through all points."""
    points = {name: in_space(p) for name, p in m.points(link).items()}
    named = np.array([*points.values()]).reshape(-1, 3)
    every = [x for name in m.links if name != GROUND for p in m.points(name).values() for x in p]
    least = FLAT * float(
        np.abs(every).max(initial=0.0)
    )  # below that joints of one place differ by rounding alone
    spread = joints if len(joints) and _size(joints) > least else np.concatenate([joints, named])
    listed = ", ".join(points) or "none"
    chain = ", ".join(f"[{a}, {b}]" for a, b in pairwise(points))
    if not len(spread) or not _size(spread) > least:
        what = f"link {link!r} has no length: its points are {listed}"
        raise ModelError(what, "give it two points that are apart", ("links", link))
    middle = spread.mean(axis=0)
    t = np.linalg.svd(spread - middle, full_matrices=False)[2][0]
    size = _size(spread)
    if (_off(spread, middle, t) > FLAT * size).any():
        what = f"the joints of link {link!r} do not lie on one line; its points are {listed}"
        remedy = f"name its straight members: members: [{chain or '[A, B], [B, C]'}]"
        raise ModelError(what, remedy, ("links", link))
    on = {n: float((p - middle) @ t) for n, p in points.items() if _off(p, middle, t) <= FLAT * size}
    s = np.concatenate([(spread - middle) @ t, [*on.values()]])
    order = [*on.values()] if len(on) > 1 else list((spread - middle) @ t)
    sign = -1.0 if order[0] > order[-1] or (order[0] == order[-1] and order[0] > s.mean()) else 1.0
    low, high = (s.min(), s.max())[:: int(sign)]
    ends = tuple(next((n for n, x in on.items() if abs(x - e) <= FLAT * size), "") for e in (low, high))
    return straight((ends[0] or "start", ends[1] or "end"), middle + low * t, middle + high * t)


def _size(places: Array) -> float:
    return float(np.linalg.norm(np.ptp(places, axis=0)))


def _off(places: Array, middle: Array, t: Array) -> Array:
    arm = places - middle
    return np.asarray(np.linalg.norm(arm - (arm @ t)[..., None] * t, axis=-1))


def beyond(members: Sequence[Straight]) -> Flags:
    """(E, E): whether member f is on the far side of member e, behind its second end."""
    out = np.zeros((len(members), len(members)), bool)
    for k, e in enumerate(members):
        met = {e.ends[1]}
        for _ in members:
            for j, f in enumerate(members):
                if j != k and met & {*f.ends}:
                    out[k, j] = True
                    met |= {*f.ends}
    return out
