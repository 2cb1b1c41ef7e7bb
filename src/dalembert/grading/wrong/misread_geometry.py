"""Geometry misread: angles counted from elsewhere, lengths exchanged, points from the other end, offsets dropped.

Each is the description with other values, assembled and solved again.

Mechanics: docs/theory.md 12.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.arrays import Array, Tree

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism


class Misread(NamedTuple):
    """A mistake: how usual it is (1 to 3), in words, and the values of the description that it puts in place."""

    order: int
    sentence: str
    values: Tree


class _Binary(NamedTuple):
    """A link with two joints: its name, the points' names and places in link axes."""

    link: str
    near: str
    far: str
    start: Array
    end: Array

    @property
    def length(self) -> float:
        return float(np.linalg.norm(self.end - self.start))


LENGTHS = (
    (0.5, "is halved: stroke for crank"),
    (2.0, "is doubled: crank for stroke"),
    (0.1, "is ten times too small"),
    (10.0, "is ten times too large"),
)


def misread_geometry(r: Result) -> Iterator[Misread]:
    """Angles of drives, lengths and points misread, one at a time."""
    m = r.mechanism
    yield from _positions(r)
    binary = list(_binary_links(m)) if m.dimension == 2 else []
    for b in binary:
        yield from _points(m, b)
    yield from _offsets(m)
    for a, b in combinations(binary, 2):
        if not math.isclose(a.length, b.length, rel_tol=1e-9):
            words = f"the lengths of {a.link} and {b.link} are exchanged"
            yield Misread(3, words, _stretched(a, b.length / a.length) | _stretched(b, a.length / b.length))
    for b in binary:
        for factor, words in LENGTHS:
            yield Misread(3, f"the length of {b.link} {words}", _stretched(b, factor))


def _positions(r: Result) -> Iterator[Misread]:
    """Positions of turning drives counted from elsewhere, or misread by ten degrees."""
    for drive in r.drives:
        if len(r.status) != 1 or drive_kinds(r, drive)["position"] != "angle":
            continue
        now = float(r.drive_position(drive)[0])
        for order, words, angle in (
            (2, "is counted from the other side: its angle has the wrong sign", -now),
            (2, "is counted from the other dead centre", math.pi - now),
            (2, "is counted from the other dead centre, turned by 180 deg", math.pi + now),
            (2, "is counted from the other axis", math.pi / 2 - now),
            (3, "is misread by 10 deg", now + math.radians(10)),
            (3, "is misread by 10 deg", now - math.radians(10)),
            (3, "is misread by 20 deg", now + math.radians(20)),
            (3, "is misread by 20 deg", now - math.radians(20)),
        ):
            path = f"drives.{drive}.position"
            yield Misread(order, f"the position of {drive} {words}", {path: f"{angle!r} rad"})


def _binary_links(m: Mechanism) -> Iterator[_Binary]:
    """Moving links by their first two joints at named points, the first of which is the origin."""
    at: dict[str, list[Array]] = {link: [] for link in m.links}
    for name, joint in m.joints.items():
        for link, at_joint in zip(joint.links, m.joint_points(name), strict=True):
            if link in at:
                at[link].append(np.asarray(at_joint, float))
    for link, places in at.items():
        if link == "ground" or len(places) < 2:
            continue
        named = []
        for place in places[:2]:
            named += [n for n, p in m.points(link).items() if np.allclose(p, place)][:1]
        if len(set(named)) == 2 and not np.allclose(places[0], places[1]):
            yield _Binary(link, named[0], named[1], places[0], places[1])


def _at(link: str, point: str, place: Array) -> Tree:
    """A point of a link, or its mass centre, at another place."""
    path = f"links.{link}.center" if point == "center" else f"links.{link}.points.{point}"
    return {path: "[" + ", ".join(f"{float(x)!r} m" for x in place) + "]"}


def _stretched(b: _Binary, factor: float) -> Tree:
    return _at(b.link, b.far, b.start + (b.end - b.start) * factor)


def _points(m: Mechanism, b: _Binary) -> Iterator[Misread]:
    """Points of a link measured from its other end, or without their distance from its line."""
    along = (b.end - b.start) / b.length
    for point in (*m.points(b.link), "center"):
        if point in (b.near, b.far) or (
            point == "center" and not (m.mass(b.link) and not m.links[b.link].shapes)
        ):
            continue
        place = np.asarray(m.center(b.link) if point == "center" else m.points(b.link)[point], float)
        what = f"the mass centre of {b.link}" if point == "center" else f"point {point} of {b.link}"
        far = float((place - b.start) @ along)
        other = place + (b.length - 2 * far) * along
        if not np.allclose(other, place):
            yield Misread(2, f"{what} is measured from the other end", _at(b.link, point, other))
        off = place - b.start - far * along
        if np.linalg.norm(off) > 1e-9 * b.length:
            yield Misread(2, f"the offset of {what} is left out", _at(b.link, point, place - off))
            yield Misread(
                2, f"the offset of {what} is on the wrong side", _at(b.link, point, place - 2 * off)
            )


def _offsets(m: Mechanism) -> Iterator[Misread]:
    """Points of the ground, in space of every link, with a coordinate left out or on the wrong side."""
    used = {
        (link, n)
        for name, joint in m.joints.items()
        for link, place in zip(joint.links, m.joint_points(name), strict=True)
        for n, p in m.points(link).items()
        if np.allclose(p, place)
    }
    for link, point in sorted(used):
        if link != "ground" and m.dimension == 2:
            continue
        place = np.asarray(m.points(link)[point], float)
        for k in range(1 if m.dimension == 2 else 0, len(place)):
            if not place[k]:
                continue
            sign = np.where(np.arange(len(place)) == k, -1.0, 1.0)
            of = f"{point}" if link == "ground" else f"{point} of {link}"
            yield Misread(2, f"the offset of {of} is left out", _at(link, point, place * (sign + 1) / 2))
            if m.dimension == 2:
                yield Misread(2, f"the offset of {of} is on the wrong side", _at(link, point, place * sign))
