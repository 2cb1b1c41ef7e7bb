"""Spatial four-bars whose axes follow from one another: RCCC, Bennett's linkage, four revolutes through one point.

Every link is described as it is drawn with the crank at 0: its axes parallel to ground's, its points where they are.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import atan2, cos, hypot, isfinite, pi, radians, sin, sqrt
from typing import TYPE_CHECKING

from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model.library.compass import FULL_TURN
from dalembert.model.library.tree_parts import build_mechanism, finite, positive, turning
from dalembert.model.quantities.vectors import Vector, cross, dot, less, plus, times

if TYPE_CHECKING:
    from dalembert.model import Mechanism


def rccc(
    *,
    axes: tuple[float, float, float, float] = (30.0, 70.0, 80.0, 75.0),
    offsets: tuple[float, float, float, float] = (0.05, 0.12, 0.15, 0.2),
    mass_per_length: float = 2.0,
    speed: float = 4 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    """A revolute and three cylindrical joints (RCCC), the general spatial four-bar.

    `axes` are the angles between neighbouring joint axes in degrees (crank, coupler, rocker, ground), `offsets` the
    crank's, coupler's, rocker's and ground's distances between the joints' points, in metres, as drawn: the turns are
    those of the spherical four-bar with the same angles, the slides follow. Links uniform and slender with
    `mass_per_length` in kg/m, gravity along -z; `speed` of the crank in rad/s, `sweep` in radians.

    >>> from dalembert.model.library import rccc
    >>> [joint.type for joint in rccc().joints.values()]
    ['revolute', 'cylindrical', 'cylindrical', 'cylindrical']
    """
    positive("rccc", **dict(zip(("crank", "coupler", "rocker", "ground"), offsets, strict=True)))
    positive("rccc", "kg/m", mass_per_length=mass_per_length)
    u = _cone_axes("rccc", axes, sweep)
    o = (0.0, 0.0, 0.0)
    a = times(offsets[0], _unit("rccc", "axes", cross(u[0], u[1])))
    b = plus(a, times(offsets[1], _unit("rccc", "axes", cross(u[1], u[2]))))
    c = plus(b, times(offsets[2], _unit("rccc", "axes", cross(u[2], u[3]))))
    c = plus(c, times(offsets[3] / 2, u[3]))
    joints = {
        "O": _on("revolute", "ground", "crank", u[0]),
        "A": _on("cylindrical", "crank", "coupler", u[1]),
        "B": _on("cylindrical", "coupler", "rocker", u[2]),
        "C": _on("cylindrical", "ground", "rocker", u[3]),
    }
    loop = _four_links("Spatial four-bar RCCC", (o, a, b, c), mass_per_length, joints)
    return build_mechanism(**loop, drives={"O": turning(sweep, positions, speed)})


def spherical_four_bar(
    *,
    arcs: tuple[float, float, float, float] = (30.0, 70.0, 80.0, 75.0),
    radius: float = 0.2,
    determinate: bool = True,
    mass_per_length: float = 2.0,
    speed: float = 4 * pi,
    sweep: tuple[float, float] = FULL_TURN,
    positions: int = 72,
) -> Mechanism:
    """Four revolutes in space whose axes pass through one point: the spherical four-bar.

    `arcs` are the angles between neighbouring axes in degrees: crank, coupler, rocker, ground; the joints lie at
    `radius` in metres from the common point. Four revolutes carry three constraints too many; `determinate` makes the
    one at B a ball and the one at C cylindrical, so that all reactions are unique. Links uniform and slender with
    `mass_per_length` in kg/m, gravity along -z; `speed` of the crank in rad/s, `sweep` in radians.

    >>> from dalembert.model.library import spherical_four_bar
    >>> [joint.type for joint in spherical_four_bar().joints.values()]
    ['revolute', 'revolute', 'spherical', 'cylindrical']
    """
    positive("spherical_four_bar", radius=radius)
    positive("spherical_four_bar", "kg/m", mass_per_length=mass_per_length)
    u = _cone_axes("spherical_four_bar", arcs, sweep)
    o, a, b, c = (times(radius, axis) for axis in u)
    loop = _four_links("Spherical four-bar", (o, a, b, c), mass_per_length, _loop(u, determinate))
    return build_mechanism(**loop, drives={"O": turning(sweep, positions, speed)})


def bennett(
    *,
    length: float = 0.2,
    twists: tuple[float, float] = (40.0, 70.0),
    start: float = 90.0,
    determinate: bool = True,
    mass_per_length: float = 2.0,
    speed: float = 4 * pi,
    sweep: tuple[float, float] = (-4 * pi / 9, 4 * pi / 9),
    positions: int = 72,
) -> Mechanism:
    """Bennett's linkage: four revolutes, neither parallel nor through one point, that can nevertheless move.

    Opposite links are equal. `length` of the crank in metres and the `twists` of crank and coupler (degrees between the
    axes at a link's ends) give the coupler: a / sin(alpha) = b / sin(beta). The crank is drawn, and its turn is
    counted, from `start` degrees from ground's line. Four revolutes have three redundant constraints; `determinate`
    makes the one at B a ball and the one at C cylindrical, which moves the same between the poses where all lies on one
    line, at 0 and 180 degrees, where it can change into another motion. Links uniform and slender with
    `mass_per_length` in kg/m, gravity along -z; `speed` in rad/s, `sweep` in radians.

    >>> from dalembert.model.library import bennett
    >>> len(bennett(determinate=False).joints)
    4
    """
    positive("bennett", length=length)
    positive("bennett", "degrees", twist=twists[0], other_twist=twists[1], start=start)
    if max(*twists, start) >= 180 or twists[0] == twists[1]:
        what = f"bennett: twists {twists[0]:g} and {twists[1]:g}, start {start:g} degrees"
        raise ModelError(what, "give two different twists and a start, all below 180 degrees")
    positive("bennett", "kg/m", mass_per_length=mass_per_length)
    finite("bennett", sweep_start=sweep[0], sweep_end=sweep[1])
    alpha, beta = (radians(t) for t in twists)
    other, theta = length * sin(beta) / sin(alpha), radians(start)
    half = sin((beta + alpha) / 2) / sin((beta - alpha) / 2) / (sin(theta / 2) / cos(theta / 2))
    turns, points, axes = (theta, 2 * atan2(half, 1.0), -theta), [(0.0, 0.0, 0.0)], [(0.0, 0.0, 1.0)]
    x: Vector = (1.0, 0.0, 0.0)
    for turn, size, twist in zip(turns, (length, other, length), (alpha, beta, alpha), strict=True):
        z = axes[-1]
        x = plus(times(cos(turn), x), times(sin(turn), cross(z, x)))
        points.append(plus(points[-1], times(size, x)))
        axes.append(plus(times(cos(twist), z), times(sin(twist), cross(x, z))))
    o, a, b, c = points
    loop = _four_links("Bennett's linkage", (o, a, b, c), mass_per_length, _loop(axes, determinate))
    return build_mechanism(**loop, drives={"O": turning(sweep, positions, speed)})


def slim(mass_per_length: float, **ends: Vector) -> Tree:
    """A uniform slender link between two points, as drawn.

    >>> slim(2.0, A=(0.0, 0.0, 0.0), B=(0.0, 0.0, 0.6))["center"]
    [0.0, 0.0, 0.3]
    """
    (first, p), (last, r) = ends.items()
    line = less(r, p)
    length = hypot(*line)
    u, mass = times(1 / length, line), mass_per_length * length
    size = mass * length**2 / 12
    inertia = [[size * ((i == j) - u[i] * u[j]) for j in range(3)] for i in range(3)]
    center = list(times(0.5, plus(p, r)))
    return {"points": {first: list(p), last: list(r)}, "mass": mass, "center": center, "inertia": inertia}


def _on(kind: str, i: str, j: str, axis: Vector) -> Tree:
    return {"type": kind, "links": [i, j], "axis": list(axis)}


def _four_links(title: str, at: Sequence[Vector], mass_per_length: float, joints: Tree) -> Tree:
    """A closed loop of slender crank, coupler and rocker between four points, under gravity."""
    o, a, b, c = at
    links = {
        "ground": {"points": {"O": list(o), "C": list(c)}},
        "crank": slim(mass_per_length, O=o, A=a),
        "coupler": slim(mass_per_length, A=a, B=b),
        "rocker": slim(mass_per_length, B=b, C=c),
    }
    return {"title": title, "gravity": "standard", "space": "space", "links": links, "joints": joints}


def _loop(axes: list[Vector], determinate: bool) -> Tree:
    """Joints of a loop of four revolutes, two of them freer where it is to be determinate."""
    o, a, b, c = axes
    ball: Tree = {"type": "spherical", "links": ["coupler", "rocker"]}
    return {
        "O": _on("revolute", "ground", "crank", o),
        "A": _on("revolute", "crank", "coupler", a),
        "B": ball if determinate else _on("revolute", "coupler", "rocker", b),
        "C": _on("cylindrical" if determinate else "revolute", "ground", "rocker", c),
    }


def _cone_axes(
    name: str, arcs: tuple[float, float, float, float], sweep: tuple[float, float]
) -> list[Vector]:
    """Axes through one point with these angles (degrees) between neighbours, as drawn: ground's in the plane x z."""
    positive(name, "degrees", **dict(zip(("crank", "coupler", "rocker", "ground"), arcs, strict=True)))
    finite(name, sweep_start=sweep[0], sweep_end=sweep[1])
    crank, coupler, rocker, ground = (radians(arc) for arc in arcs)
    last = (sin(ground), 0.0, cos(ground))

    def second(turn: float) -> Vector:
        return sin(crank) * cos(turn), sin(crank) * sin(turn), cos(crank)

    def third(turn: float) -> Vector | None:
        """The axis at the coupler's angle from the second and the rocker's from the last, on the left of both."""
        a = second(turn)
        cosine = dot(a, last)
        square = 1 - cosine**2
        if square < 1e-12:
            return None
        p = (cos(coupler) - cosine * cos(rocker)) / square
        r = (cos(rocker) - cosine * cos(coupler)) / square
        left = 1 - p**2 - r**2 - 2 * p * r * cosine
        if left < 0:
            return None
        return plus(times(p, a), times(r, last), times(sqrt(left / square), cross(a, last)))

    start = sweep[0]
    return [(0.0, 0.0, 1.0), second(0.0), _closing(name, third, (start, sweep[1]), "the angles"), last]


def _closing(
    name: str, place: Callable[[float], Vector | None], sweep: tuple[float, float], what: str
) -> Vector:
    """The place at crank 0, if there is one all over the sweep."""
    open_ = [turn for k in range(361) if place(turn := sweep[0] + (sweep[1] - sweep[0]) * k / 360) is None]
    first = place(0.0)
    if open_ or first is None:
        low, high = (round(x * 180 / pi) for x in ((open_ or [0.0])[0], (open_ or [0.0])[-1]))
        raise ModelError(
            f"{name} does not close from {low} to {high} degrees of the crank",
            f"change {what}, or give the crank a smaller range",
        )
    return first


def _unit(name: str, key: str, vector: Vector) -> Vector:
    size = hypot(*vector)
    if not (isfinite(size) and size > 0):
        raise ModelError(f"{name}: {key} has no direction", "give one component other than 0")
    return times(1 / size, vector)
