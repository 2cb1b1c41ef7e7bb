"""The motion of wheels in mesh, in the plane: letters, numbers, closure."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from dalembert.analysis.compile.plane_rows import signed_radii
from dalembert.analysis.methods.applied_forces import link_place, link_speed
from dalembert.arrays import Array
from dalembert.model import GROUND
from dalembert.reports.formula import bracket_negative
from dalembert.reports.sections.kinematics import zero_sum
from dalembert.reports.sheet import Working
from dalembert.views.notation import Shown

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def mesh(r: Result, k: int, joint: str, shown: Shown) -> tuple[str, list[Working]]:
    """Pitch circles that roll on each other, seen from the line of centres: sentence and equations."""
    described: Any = r.mechanism.joints[joint]
    wheels = [*zip(described.links, signed_radii(described), strict=True)]
    line = _Line(r, k, joint)
    out = []
    rates = [
        (letter, kind, rate if abs(rate) > shown.least[kind] else 0.0, of)
        for letter, kind, rate, of in (
            ("omega", "angular_speed", line.speed, link_speed),
            ("alpha", "angular_acceleration", line.acceleration, _link_acceleration),
        )
    ]
    for letter, kind, turning, of in rates:
        letters, numbers, values = [], [], []
        for link, radius in wheels:
            rate, sign = float(of(r, link)[k]), f"{letter}_{{{shown.link(link)}}}"
            figure, size = _radians(shown, kind, rate), bracket_negative(shown.number("length", radius))
            if turning:
                sign = f"({sign} − {letter}_{{c}})"
                figure = f"({figure} − {bracket_negative(_radians(shown, kind, turning))})"
            letters.append(f"r_{{{shown.link(link)}}} {sign}")
            numbers.append(f"{size} cdot {figure if turning else bracket_negative(figure)}")
            values.append(radius * (rate - turning))
        largest = max(map(abs, values))
        if largest:
            sums = " + ".join(letters), " + ".join(numbers), math.fsum(values), largest
            out.append(zero_sum(*sums, shown, "length", "/s" if letter == "omega" else "/s²"))
    words = f"Mesh {joint}: the pitch circles roll on each other"
    if described.WRAPPED:
        words = f"Belt {joint}: both rims have its speed, r negative where the wheels turn in the same sense"
    if any(rate for _, _, rate, _ in rates):
        parts = [f"${letter}_{{c}}$ = {shown.text(kind, rate)}" for letter, kind, rate, _ in rates if rate]
        words += f", seen from the line of centres, for which {' and '.join(parts)}"
    words += ", rates in radians" if any(shown.size(kind) != 1 for _, kind, *_ in rates) else ""
    inner = "; of an internal pair the inner radius is negative" if described.internal else ""
    return f"{words}{inner}.", out


def _radians(shown: Shown, kind: str, rate: float) -> str:
    """A rate in radians, whatever the reader's unit of rates: times a radius it is a speed."""
    return shown.notation.number(0.0 if abs(rate) < shown.least.get(kind, 0.0) else rate)


class _Line:
    """The line from centre to centre of two wheels: its angular speed and acceleration, 0 where it is at rest."""

    def __init__(self, r: Result, k: int, joint: str) -> None:
        described: Any = r.mechanism.joints[joint]
        points = r.mechanism.joint_points(joint)
        places = [link_place(r, link, u)[k] for link, u in zip(described.links, points, strict=True)]
        rates = [_point_rates(r, link, u, k) for link, u in zip(described.links, points, strict=True)]
        span, (v, a) = places[1] - places[0], (rates[1][n] - rates[0][n] for n in (0, 1))
        square = float(span @ span)
        self.speed = _cross(span, v) / square
        self.acceleration = _cross(span, a) / square - 2 * self.speed * float(span @ v) / square


def _cross(a: Array, b: Array) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


def _point_rates(r: Result, link: str, u: ArrayLike, k: int) -> tuple[Array, Array]:
    """Velocity and acceleration of a link's point."""
    if link == GROUND:
        return np.zeros(2), np.zeros(2)
    at = np.asarray(u, float)
    return r._velocity(link, at)[k], r._acceleration(link, at)[k]


def _link_acceleration(r: Result, link: str) -> Array:
    return np.zeros(len(r.status)) if link == GROUND else r.acceleration(link)
