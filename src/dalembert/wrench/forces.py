"""Force, couple and axis: the parts of a force system, in the plane (2 components) and in space (3)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from dalembert.algebra import plane, space
from dalembert.algebra.protocol import Algebra
from dalembert.arrays import Array, Numeric
from dalembert.errors import ModelError
from dalembert.wrench import reading
from dalembert.wrench.reading import Number, UnitNames, Vector, number, read_only

ALGEBRA: dict[int, Algebra] = {2: plane, 3: space}
"""Components of a force -> the algebra of its vectors."""


def value_of(moment: Array) -> Numeric:
    """A moment as users see it: a number in the plane, a vector (3,) in space."""
    return float(moment[0]) if moment.shape == (1,) else moment


@dataclass(frozen=True, eq=False, init=False)
class Axis:
    """A directed line: through a point, along a direction of any length (kept as a unit vector).

    >>> Axis.through([0, 0, 0], [0, 0, 5]).direction
    array([0., 0., 1.])
    """

    point: Array
    direction: Array

    def __init__(self, point: Vector, direction: Vector | Number, units: UnitNames = None) -> None:
        at = reading.vector(point, "length", units)
        object.__setattr__(self, "point", at)
        object.__setattr__(self, "direction", reading.direction(direction, len(at)))

    @classmethod
    def through(cls, start: Vector, end: Vector, units: UnitNames = None) -> Self:
        """The line from one point through another."""
        a = reading.vector(start, "length", units)
        return cls(a, reading.vector(end, "length", units, len(a)) - a)

    def foot(self, of: Vector) -> Array:
        """The point of the line nearest to a point."""
        arm = reading.vector(of, "length", dimension=len(self.point)) - self.point
        return read_only(self.point + (arm @ self.direction) * self.direction)

    def crossing(self, **plane: Number) -> Array:
        """Intersection of the line with a plane x = value, y = value or z = value (m).

        >>> Axis([0, 0, 4], [1, 0, 1]).crossing(z=6)
        array([2., 0., 6.])
        """
        names = "xyz"[: len(self.point)]
        if len(plane) != 1 or not set(plane) <= set(names):
            raise ModelError(f"a line is cut at one of {', '.join(names)}", "write for example crossing(y=0)")
        ((name, value),) = plane.items()
        k = names.index(name)
        if abs(self.direction[k]) < 1e-12:
            raise ModelError(f"the line runs at a constant {name}", "cut it at another coordinate")
        wanted = number(value, "length")
        place = self.point + (wanted - self.point[k]) / self.direction[k] * self.direction
        place[k] = wanted
        return read_only(place)

    def distance(self, of: Vector) -> float:
        """Distance of a point from the line, m."""
        return math.hypot(*(reading.vector(of, "length") - self.foot(of)))


@dataclass(frozen=True, eq=False, init=False)
class Force:
    """A force (N) at a point (m): components, or polar text in the plane; it may slide along its line of action.

    ``units`` says what bare numbers are in; without it they are SI, and in a text angles are in degrees. ``kind`` is
    the sort of load, for drawings: `load`, `joint`, `weight`, `inertia`, `effort`, `friction`.

    >>> f = Force("100 @ 30 N", at=[2, 1])
    >>> f.vector.round(3), round(f.moment([0, 0]), 3)       # x Fy - y Fx, counter-clockwise positive
    (array([86.603, 50.   ]), 13.397)
    """

    vector: Array
    at: Array
    name: str = ""
    kind: str = "load"

    def __init__(
        self,
        vector: Vector,
        at: Vector | None = None,
        name: str = "",
        kind: str = "load",
        units: UnitNames = None,
    ) -> None:
        force = reading.vector(vector, "force", units)
        place = np.zeros(len(force)) if at is None else reading.vector(at, "length", units, len(force))
        for key, value in (("vector", force), ("at", read_only(place)), ("name", name), ("kind", kind)):
            object.__setattr__(self, key, value)

    @classmethod
    def along(
        cls,
        size: Number,
        start: Vector,
        end: Vector,
        name: str = "",
        units: UnitNames = None,
        kind: str = "load",
    ) -> Self:
        """A force of a given size at ``start``, directed towards ``end``.

        >>> Force.along("90 N", [0, 0, 0], [2, 1, 2]).vector
        array([60., 30., 60.])
        """
        line = Axis.through(start, end, units)
        return cls(number(size, "force", units) * line.direction, line.point, name, kind)

    @classmethod
    def directed(
        cls,
        size: Number,
        along: Vector | Number,
        at: Vector | None = None,
        name: str = "",
        units: UnitNames = None,
        kind: str = "load",
    ) -> Self:
        """A force of a size along a direction: a vector of any length, in the plane also an angle.

        >>> Force.directed(10, "-90 deg", at=[3, 0]).vector
        array([  0., -10.])
        """
        force = number(size, "force", units) * reading.direction(along)
        return cls(force, None if at is None else reading.vector(at, "length", units), name, kind)

    @classmethod
    def by_angles(
        cls,
        size: Number,
        angles: Sequence[Number],
        at: Vector | None = None,
        name: str = "",
        units: UnitNames = None,
    ) -> Self:
        """A force in space by its size and its angles to the x, y and z axes.

        >>> Force.by_angles("500 N", ["60 deg", "45 deg", "120 deg"]).vector.round(1)
        array([ 250. ,  353.6, -250. ])
        """
        return cls.directed(size, reading.cosines(angles), at, name, units)

    @classmethod
    def by_elevation(
        cls,
        size: Number,
        azimuth: Number,
        elevation: Number,
        at: Vector | None = None,
        name: str = "",
        units: UnitNames = None,
    ) -> Self:
        """A force in space by its size, its angle in the xy plane from x, and its angle above that plane.

        >>> Force.by_elevation(100, "30 deg", "60 deg").vector.round(2)
        array([43.3, 25. , 86.6])
        """
        turn, rise = number(azimuth, "angle"), number(elevation, "angle")
        flat = math.cos(rise)
        along = [flat * math.cos(turn), flat * math.sin(turn), math.sin(rise)]
        return cls.directed(size, along, at, name, units)

    @property
    def dimension(self) -> int:
        """2 in the plane, 3 in space."""
        return len(self.vector)

    @property
    def size(self) -> float:
        """Magnitude, N."""
        return math.hypot(*self.vector)

    @property
    def cosines(self) -> Array:
        """Direction cosines, the components of the unit vector along the force."""
        return reading.direction(self.vector)

    @property
    def angles(self) -> Array:
        """Angles to the axes (radians, 0 to pi)."""
        return read_only(np.arccos(np.clip(self.cosines, -1.0, 1.0)))

    @property
    def angle(self) -> float:
        """Direction from the x axis in the plane (radians, counter-clockwise)."""
        if self.dimension == 3:
            raise ModelError("a force in space has no single angle", "ask for its angles, one to each axis")
        return math.atan2(float(self.vector[1]), float(self.vector[0]))

    @property
    def line(self) -> Axis:
        """Line of action."""
        return Axis(self.at, self.vector)

    def components(self, *axes: Vector | Number) -> Array:
        """Components along any axes, square or oblique, by the parallelogram law; see `components`."""
        return components(self.vector, *axes)

    def projection(self, along: Vector | Number) -> float:
        """Orthogonal projection F . e on a direction, N."""
        return float(self.vector @ reading.direction(along, self.dimension))

    def moment(self, about: Vector | Axis | None = None) -> Numeric:
        """Moment r x F about a point (default the origin) or an axis, N m.

        About a point: a number in the plane (counter-clockwise positive), a vector (3,) in space. About an axis in
        space: a number, e . (r x F), positive by the right hand along the axis.

        >>> f = Force([0, 0, 10], at=[3, 4, 0])
        >>> f.moment([0, 0, 0]), f.moment(Axis([0, 0, 0], [1, 0, 0]))
        (array([ 40., -30.,   0.]), 40.0)
        """
        return moment_about(self, about)

    def _moment(self, about: Array) -> Array:
        return np.asarray(ALGEBRA[self.dimension].cross(self.at - about, self.vector))

    def arm(self, about: Vector) -> float:
        """Distance of a point from the line of action, m: |M| = |F| arm."""
        return self.line.distance(about)

    def moved(self, at: Vector) -> tuple[Force, Couple]:
        """The same force at another point, and the couple that compensates: its moment about that point.

        >>> force, couple = Force([0, 5], at=[2, 0]).moved([0, 0])
        >>> force.at, couple.moment
        (array([0., 0.]), 10.0)
        """
        place = reading.vector(at, "length", dimension=self.dimension)
        return Force(self.vector, place, self.name, self.kind), Couple(
            self._moment(place), self.name, self.kind
        )

    def __neg__(self) -> Force:
        return Force(-self.vector, self.at, self.name, self.kind)


@dataclass(frozen=True, eq=False, init=False)
class Couple:
    """A couple (N m): a free vector, the same about every point; one number in the plane, three in space.

    >>> Couple("120 N*m").moment, Couple([0, 5, 0]).moment
    (120.0, array([0., 5., 0.]))
    """

    vector: Array
    name: str = ""
    kind: str = "load"

    def __init__(
        self, moment: Vector | Number, name: str = "", kind: str = "load", units: UnitNames = None
    ) -> None:
        value = read_only(moment_components(moment, units))
        for key, attribute in (("vector", value), ("name", name), ("kind", kind)):
            object.__setattr__(self, key, attribute)

    @classmethod
    def of_forces(cls, force: Force, at: Vector, name: str = "") -> Self:
        """The couple of a force and its opposite, which acts at another point.

        >>> Couple.of_forces(Force([0, 20], at=[0.5, 0]), at=[0, 0]).moment
        10.0
        """
        return cls(force._moment(reading.vector(at, "length", dimension=force.dimension)), name)

    @property
    def dimension(self) -> int:
        """2 in the plane, 3 in space."""
        return 3 if len(self.vector) == 3 else 2

    @property
    def moment(self) -> Numeric:
        """Moment about any point: a number in the plane, a vector (3,) in space."""
        return value_of(self.vector)

    @property
    def size(self) -> float:
        """Magnitude, N m."""
        return math.hypot(*self.vector)

    def __neg__(self) -> Couple:
        return Couple(-self.vector, self.name, self.kind)


def moment_components(moment: Numeric, units: UnitNames = None) -> list[float]:
    """A moment in SI: one number in the plane, three in space."""
    if isinstance(moment, str) and "[" in moment:
        return list(reading.vector(moment, "moment", units, 3))
    if isinstance(moment, str) or np.ndim(moment) == 0:
        return [number(moment, "moment", units)]
    if len(moment) == 1:
        return [number(moment[0], "moment", units)]
    return list(reading.vector(moment, "moment", units, 3))


def moment_about(part: Any, about: Vector | Axis | None) -> Numeric:
    """Moment of an object with `dimension` and `_moment(point)` about a point or an axis, as users see it."""
    d = part.dimension
    if isinstance(about, Axis):
        if d == 2:
            raise ModelError(
                "in the plane moments are about points", "name the point that the axis passes through"
            )
        return float(part._moment(about.point) @ about.direction)
    return value_of(
        part._moment(np.zeros(d) if about is None else reading.vector(about, "length", dimension=d))
    )


def components(force: Vector, *axes: Vector | Number) -> Array:
    """Components (N) of a force along axes, so that the sum of component times unit vector is the force.

    The axes need not be perpendicular. Raises ModelError where they are dependent, or where the force does not
    lie in their plane.

    >>> components([100, 0], "30 deg", "-45 deg").round(2)
    array([73.21, 51.76])
    """
    f = reading.vector(force, "force")
    unit = np.array([reading.direction(axis, len(f)) for axis in axes]).reshape(-1, len(f))
    if len(unit) > len(f) or not len(unit) or np.linalg.svd(unit, compute_uv=False)[-1] < 1e-9:
        raise ModelError("the axes do not point in independent directions", f"give up to {len(f)} that do")
    parts = np.linalg.lstsq(unit.T, f, rcond=None)[0]
    left = math.hypot(*(f - parts @ unit))
    if left > 1e-9 * math.hypot(*f):
        raise ModelError(
            f"the force does not lie in the axes' {'plane' if len(unit) == 2 else 'line'}: {left:.4g} N are left",
            f"give {len(f)} axes",
        )
    return read_only(parts)
