"""A link's mass along its members, and the bodies of its shape that lie beside or beyond them.

Mechanics: docs/theory.md 10.4.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from dalembert.arrays import Array
from dalembert.machine.link_axes import in_space
from dalembert.machine.members.straight_members import FLAT, Straight
from dalembert.model import Box

if TYPE_CHECKING:
    from dalembert.model import Mechanism
    from dalembert.model.links.shapes import Points, ShapePart, Solid

Interval = tuple[float, float]
NO_INERTIA = np.zeros((3, 3))


@dataclass(frozen=True)
class MassPiece:
    """Mass per length between two distances from the start of member number ``member``, kg/m and m.

    ``inertia`` (3, 3), kg m: inertia per length of the section about its centre, in link axes.
    """

    member: int
    start: float
    end: float
    density: float
    inertia: Array = field(default_factory=lambda: NO_INERTIA, repr=False)


@dataclass(frozen=True)
class Lump:
    """A rigid body on a link: mass, centre (3,) and inertia (3, 3) about it, in link axes."""

    mass: float
    center: Array
    inertia: Array


@dataclass(frozen=True)
class MassLayout:
    """Mass along the members, and the lumps beside them; the remainder of the link's mass acts at its centre."""

    pieces: tuple[MassPiece, ...] = ()
    lumps: tuple[Lump, ...] = ()


def mass_layout(m: Mechanism, link: str, members: Sequence[Straight]) -> MassLayout:
    """The layout by the link's ``mass_along``: even, by its shape, or nothing along the members."""
    part = m.links[link]
    if part.mass_along == "uniform":
        density = m.mass(link) / sum(e.length for e in members)
        return MassLayout(tuple(MassPiece(k, 0.0, e.length, density) for k, e in enumerate(members)))
    if part.mass_along == "lumped":
        return MassLayout()
    pieces, lumps = [], []
    solids = [shape.solid(part.point) for shape in part.shapes]
    volume = sum(s.volume for s in solids)
    for shape, solid in zip(part.shapes, solids, strict=True):
        density = m.mass(link) / volume if shape.density is None else shape.density
        some, rest = _spread(shape, solid, density, part.point, members)
        pieces += some
        lumps += rest
    flat = np.array([1.0, 1.0, float(m.dimension == 3)])
    return MassLayout(tuple(pieces), tuple(Lump(x.mass, x.center * flat, x.inertia) for x in lumps))


def _spread(
    shape: ShapePart, solid: Solid, density: float, points: Points, members: Sequence[Straight]
) -> tuple[list[MassPiece], list[Lump]]:
    """A shape as pieces along members and lumps for its ends beyond them; one lump if it lies along none."""
    best: tuple[float, Array, float, list[MassPiece], list[Interval]] | None = None
    mass, center = solid.volume * density, in_space(solid.center)
    for t, length in _prisms(shape, points):
        section = _section_inertia(solid.inertia * density, mass, t, length)
        pieces, free = _along(members, center, t, length, mass / length, section)
        covered = sum(p.end - p.start for p in pieces)
        if covered > (best[0] if best else 0.0):
            best = covered, t, length, pieces, free
    if best is None:
        return [], [Lump(mass, center, solid.inertia * density)]
    _, t, length, pieces, free = best
    section = pieces[0].inertia
    across = np.eye(3) - np.outer(t, t)
    lumps = []
    for low, high in free:
        part, x = mass / length * (high - low), high - low
        lumps.append(Lump(part, center + (low + high) / 2 * t, section * x + part * x**2 / 12 * across))
    return pieces, lumps


def _along(
    members: Sequence[Straight], center: Array, t: Array, length: float, density: float, section: Array
) -> tuple[list[MassPiece], list[Interval]]:
    """Pieces of a prism on the members that it lies along, none twice, and the intervals of it that are on none."""
    free: list[Interval] = [(-length / 2, length / 2)]
    pieces = []
    for k, e in enumerate(members):
        sense = float(np.sign(t @ e.along))
        if abs(t @ e.along) < 1 - FLAT or _off(center, e) > FLAT * e.length:
            continue
        at = float((center - e.start) @ e.along)
        first, last = sorted((-at * sense, (e.length - at) * sense))
        left = []
        for low, high in free:
            a, b = max(low, first), min(high, last)
            if b - a <= FLAT * e.length:
                left.append((low, high))
                continue
            left += [x for x in ((low, a), (b, high)) if x[1] - x[0] > FLAT * e.length]
            start, end = (float(e.rounded(at + sense * x)) for x in sorted((a, b), key=lambda x: sense * x))
            pieces.append(MassPiece(k, start, end, density, section))
        free = left
    return pieces, free


def _off(place: Array, e: Straight) -> float:
    """Distance of a place (3,) from the line of a member."""
    return float(np.linalg.norm(np.cross(e.along, place - e.start)))


def _section_inertia(inertia: Array, mass: float, t: Array, length: float) -> Array:
    """Inertia per length of a prism's section, from the prism's I = j l + m l^2 / 12 across its direction t."""
    return np.asarray((inertia - mass * length**2 / 12 * (np.eye(3) - np.outer(t, t))) / length)


def _prisms(shape: ShapePart, points: Points) -> list[tuple[Array, float]]:
    """Directions along which a shape has one section, each with its length."""
    if isinstance(shape, Box):
        return [(np.array(a), x) for a, x in zip(shape.own_axes, shape.size, strict=True)]
    if hasattr(shape, "line"):
        length, _, axis = shape.line(points)
        return [(axis, float(length))]
    return []
