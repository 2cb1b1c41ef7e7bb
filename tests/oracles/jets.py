"""A quantity with its first and second rate, carried through formulas exactly."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.oracles.reading import Array


@dataclass(frozen=True)
class Jet:
    """Value, rate, second rate; ``f(jet)`` follows from f, f', f''."""

    x: Array
    v: Array
    a: Array
    __array_ufunc__ = None

    def chain(self, f: Any, d: Any, dd: Any) -> Jet:
        return Jet(f, d * self.v, d * self.a + dd * self.v**2)

    def __add__(self, other: Any) -> Jet:
        o = jet(other)
        return Jet(self.x + o.x, self.v + o.v, self.a + o.a)

    def __neg__(self) -> Jet:
        return Jet(-self.x, -self.v, -self.a)

    def __sub__(self, other: Any) -> Jet:
        return self + -jet(other)

    def __rsub__(self, other: Any) -> Jet:
        return jet(other) + -self

    def __mul__(self, other: Any) -> Jet:
        o = jet(other)
        return Jet(self.x * o.x, self.v * o.x + self.x * o.v, self.a * o.x + 2 * self.v * o.v + self.x * o.a)

    def __truediv__(self, other: Any) -> Jet:
        o = jet(other)
        return self * o.chain(1 / o.x, -1 / o.x**2, 2 / o.x**3)

    def __rtruediv__(self, other: Any) -> Jet:
        return jet(other) / self

    __radd__ = __add__
    __rmul__ = __mul__


def jet(x: Any) -> Jet:
    """A constant as a jet; a jet as it is."""
    return x if isinstance(x, Jet) else Jet(np.asarray(x, float), np.zeros(()), np.zeros(()))


def sin(j: Jet) -> Jet:
    return j.chain(np.sin(j.x), np.cos(j.x), -np.sin(j.x))


def cos(j: Jet) -> Jet:
    return j.chain(np.cos(j.x), -np.sin(j.x), -np.cos(j.x))


def sqrt(j: Jet) -> Jet:
    root = np.sqrt(j.x)
    return j.chain(root, 0.5 / root, -0.25 / root**3)


def atan2(y: Jet, x: Jet) -> Jet:
    """Rates from (x y' - y x') / (x^2 + y^2), differentiated once more."""
    r2 = x.x**2 + y.x**2
    top = x.x * y.v - y.x * x.v
    rate = top / r2
    top_rate = x.x * y.a - y.x * x.a
    return Jet(np.arctan2(y.x, x.x), rate, top_rate / r2 - rate * 2 * (x.x * x.v + y.x * y.v) / r2)


Point = tuple[Any, Any]
Pose = tuple[Any, Any, Any]
Kinematics = Callable[..., dict[str, Pose]]


def at(pose: Pose, x: float, y: float) -> Point:
    """A point of a link in ground axes."""
    c, s = cos(jet(pose[2])), sin(jet(pose[2]))
    return pose[0] + x * c - y * s, pose[1] + x * s + y * c


def heading(p: Point, r: Point) -> Jet:
    return atan2(jet(r[1] - p[1]), jet(r[0] - p[0]))


def circles(p: Point, rp: Any, r: Point, rr: Any, side: int) -> Point:
    """Where circles about p and r meet; side +1 is left of p -> r."""
    dx, dy = r[0] - p[0], r[1] - p[1]
    d2 = jet(dx * dx + dy * dy)
    along = (d2 + rp * rp - rr * rr) / (2.0 * d2)
    across = side * sqrt(jet(rp * rp / d2 - along * along))
    return p[0] + along * dx - across * dy, p[1] + along * dy + across * dx


def line_circle(p: Point, length: float, start: Point, direction: float, side: int) -> Point:
    """The point of a line (start, direction in degrees) at a distance from p; side +1 is further along."""
    c, s = np.cos(np.radians(direction)), np.sin(np.radians(direction))
    dx, dy = p[0] - start[0], p[1] - start[1]
    off = -s * dx + c * dy
    t = c * dx + s * dy + side * sqrt(jet(length * length - off * off))
    return start[0] + c * t, start[1] + s * t
