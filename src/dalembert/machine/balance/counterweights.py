"""Counterweights: where they may be and how heavy, as cones of their mass numbers m, h = int s dm and I = int s^2 dm.

About the base point, link axes; in space flat across the axis their link turns about. Masses within a radius R have
just the numbers with h^2 <= m I and I <= R^2 m: any such can be built.

Mechanics: docs/theory.md 10.2.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.compile.load_arrays import point_of
from dalembert.arrays import Array, Tree
from dalembert.bounds import require
from dalembert.errors import ModelError
from dalembert.model import GROUND
from dalembert.model.links.link import CENTER, Offset
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.model import Mechanism

Range = tuple[float, float]
NONE = (0.0, 0.0)


@dataclass(frozen=True)
class Counterweight:
    """Bounds of a counterweight on a link; SI, link axes about the point ``at`` (the link's joint with the ground).

    ``radius``: all its mass is within, m (default: the distance of the link's farthest point); ``mass``: the largest,
    kg; ``moment``: the largest m r, kg m; ``place``: its position as a point mass, then only its mass is optimised;
    ``x``, ``y``, ``z``: ranges of m x, m y and m z, kg m, (0, 0) for none; ``disc``: (density, thickness, largest
    radius) of a disc whose rim passes through ``at``, in space across the axis that the link turns about.

    >>> import dalembert as da
    >>> w = Counterweight(radius=0.1, mass=3.0)
    >>> da.balance(da.dynamics(da.slider_crank()), {"crank": w}).complete
    False
    """

    at: str | None = None
    radius: float | None = None
    mass: float | None = None
    moment: float | None = None
    place: tuple[float, ...] | None = None
    x: Range | None = None
    y: Range | None = None
    z: Range | None = None
    disc: tuple[float, float, float] | None = None

    @property
    def spans(self) -> tuple[Range | None, ...]:
        """The ranges of m x, m y and m z."""
        return self.x, self.y, self.z

    def directions(self, axis: Array | None) -> list[Array]:
        """At right angles unit vectors (3,) of what m x, m y, m z may be: across the axis, none where the range is."""
        shut = [e for e, span in zip(np.eye(3), self.spans, strict=True) if span and tuple(span) == NONE]
        fixed = shut if axis is None else [axis, *shut]
        units: list[Array] = []
        for e in [*fixed, *np.eye(3)]:
            rest = e - sum((u * (u @ e) for u in units), np.zeros(3))
            if np.linalg.norm(rest) > 1e-6:
                units.append(rest / np.linalg.norm(rest))
        return [u for u in units if not any(abs(u @ e) > 1e-6 for e in fixed)]

    @property
    def most_moment(self) -> float:
        """Largest m r that its bounds allow, kg m."""
        bounds = [math.inf if self.moment is None else self.moment]
        if self.disc is not None:
            density, thickness, radius = self.disc
            bounds.append(density * math.pi * thickness * radius**3)
        return min(bounds)

    def disc_of(self, moment: float) -> float:
        """Radius of the disc through the base point that has a moment m r: rho pi t R^3."""
        assert self.disc is not None
        return float((moment / (math.pi * self.disc[0] * self.disc[1])) ** (1 / 3))


Wanted = Sequence[str] | Mapping[str, Counterweight | Mapping[str, Any] | None]


def counterweights(m: Mechanism, wanted: Wanted) -> dict[str, Counterweight]:
    """By link, each with its base point and radius filled in."""
    named = dict(wanted) if isinstance(wanted, Mapping) else dict.fromkeys(wanted)
    out = {}
    for link, bounds in named.items():
        if link not in m.links or link == GROUND:
            moving = [name for name in m.links if name != GROUND]
            raise ModelError(
                f"{link!r} is not a moving link that can carry a counterweight", closest(link, moving)
            )
        w = bounds if isinstance(bounds, Counterweight) else Counterweight(**_known(link, bounds or {}))
        at = w.at or _pivot(m, link)
        base = base_point(m, link, at)
        reach = max([math.dist(base, u) for u in m.points(link).values()], default=0.0)
        _check(link, w, m.dimension)
        out[link] = Counterweight(**{**vars(w), "at": at, "radius": w.radius or reach or 1.0})
    if not out:
        raise ModelError("no link is to have a counterweight", 'name some: {"crank": {"radius": 0.1}}')
    return out


def base_point(m: Mechanism, link: str, at: str | None) -> Array:
    """The base point in link axes (2,)."""
    return np.zeros(m.dimension) if at is None else point_of(m, link, at)


def _known(link: str, bounds: Mapping[str, Any]) -> dict[str, Any]:
    keys = [f.name for f in fields(Counterweight)]
    for key in bounds:
        if key not in keys:
            raise ModelError(f"counterweight on {link}: unknown bound {key!r}", closest(key, keys))
    return dict(bounds)


def _check(link: str, w: Counterweight, d: int) -> None:
    sizes = {name: getattr(w, name) for name in ("radius", "mass", "moment")}
    sizes |= zip(("density", "thickness", "largest radius"), w.disc or (), strict=False)
    for name, size in sizes.items():
        require("bound", size, f"counterweight on {link}: {name}")
    if w.disc is not None and len(w.disc) != 3:
        raise ModelError(
            f"counterweight on {link}: a disc is density, thickness, largest radius", "give three numbers"
        )
    for name, ends in (("place", w.place), *zip("xyz", w.spans, strict=True)):
        for end in ends or ():
            require("place", end, f"counterweight on {link}: {name}")
    if (w.place is not None and len(w.place) != d) or (d == 2 and w.z is not None):
        raise ModelError(
            f"counterweight on {link}: a place has {d} coordinates", f"give {d} numbers, in metres"
        )
    for name, span in zip("xyz", w.spans, strict=True):
        if span is not None and not ((len(span) == 2 and span[0] < span[1]) or tuple(span) == NONE):
            raise ModelError(
                f"counterweight on {link}: the range of {name} is empty",
                f"write {name}: (low, high), or (0, 0)",
            )


def _pivot(m: Mechanism, link: str) -> str | None:
    """The link's point of its first joint with the ground, if it has one."""
    for name, joint in m.joints.items():
        if set(joint.links) == {GROUND, link}:
            return str(joint.point_names(name)[joint.links.index(link)])
    return None


def with_masses(m: Mechanism, added: Mapping[str, Sequence[tuple[float, Array, float | Array]]]) -> Mechanism:
    """The description with further masses, kg, on its links, each with centre and inertia about it, link axes."""
    values: Tree = {}
    for link, masses in added.items():
        own_inertia = np.asarray(m.inertia(link), float)
        own_inertia = (
            own_inertia
            if m.dimension == 2 or own_inertia.ndim == 2
            else np.diag(np.broadcast_to(own_inertia, 3))
        )
        parts = [(m.mass(link), np.array(m.center(link)), own_inertia), *(p for p in masses if p[0] > 0)]
        if len(parts) == 1:
            continue
        mass = sum(w for w, *_ in parts)
        center = sum((w * c for w, c, _ in parts), np.zeros(m.dimension)) / mass
        inertia = sum((i + w * _spread(c - center) for w, c, i in parts), np.zeros_like(own_inertia))
        if np.abs(inertia).max() < 1e-14 * sum(w * float(c @ c) for w, c, _ in parts):
            inertia = np.zeros_like(own_inertia)  # one mass, but for rounding
        if m.links[link].shapes:
            values |= {f"links.{link}.mass_along": "lumped"} if m.links[link].mass_along == "shape" else {}
            values |= {f"links.{link}.shape": None}
        values |= {f"links.{link}.mass": float(mass), f"links.{link}.center": center.tolist()}
        values[f"links.{link}.inertia"] = ((inertia + inertia.T) / 2).tolist()
        values |= _kept_places(m, link)
    return m.with_values(values)


BEFORE = "center_before"
"""Point of a link where its mass centre is without counterweights."""


def _kept_places(m: Mechanism, link: str) -> Tree:
    """Values that keep the points, loads and joints that are placed by a link's mass centre where they are."""
    points, centred = m.points(link), any(isinstance(p, Offset) for p in m.links[link].points.values())
    name = BEFORE
    while name in points:
        name += "_"
    values: Tree = {}
    for path, ends in _named_points(m):
        if (link, CENTER) in ends:
            values[path] = [name if end == (link, CENTER) else end[1] for end in ends]
            if not path.startswith("joints."):
                values[path] = [f"{n}.{point}" for (n, _), point in zip(ends, values[path], strict=True)]
    if values:
        points[name] = m.center(link)
    for n, load in m.loads.items():
        if getattr(load, "on", None) == link and getattr(load, "at", None) == CENTER:
            values[f"loads.{n}.at"] = list(m.center(link))
    if centred or name in points:
        values = {f"links.{link}.points": {n: list(p) for n, p in points.items()}} | values
    return values


def _named_points(m: Mechanism) -> Iterator[tuple[str, list[tuple[str, str]]]]:
    """Paths of pairs of points of joints, springs, dampers and cylinders, and these as (link, point)."""
    for name, joint in m.joints.items():
        if joint.at is not None:
            yield f"joints.{name}.at", [*zip(joint.links, joint.point_names(name), strict=True)]
    spans = {f"loads.{n}.between": getattr(load, "between", ()) for n, load in m.loads.items()}
    spans |= {f"drives.{n}.cylinder.between": d.cylinder.between for n, d in m.drives.items() if d.cylinder}
    yield from ((path, [(str(n), str(point)) for n, point in ends]) for path, ends in spans.items())


def _spread(arm: Array) -> Array:
    """Inertia of a unit mass at an arm: a number in the plane, a matrix in space."""
    square = np.asarray(arm @ arm)
    return square if len(arm) == 2 else square * np.eye(3) - np.outer(arm, arm)
