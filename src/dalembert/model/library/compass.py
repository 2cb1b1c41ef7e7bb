"""Closing a linkage by compass and ruler: planar points as complex numbers, x + iy in metres.

Every template places its points for one value of the drive; :func:`start_points` tries that all along the sweep
and says where it fails, and with which two links.
"""

from __future__ import annotations

from cmath import exp, isfinite, phase
from collections.abc import Callable, Mapping
from math import degrees, pi, sqrt

from dalembert.errors import ModelError

Side = tuple[str, float]
"""A length and the name a person knows it by."""
Points = dict[str, complex]
SAMPLES = 361
TOUCHING = 1e-9
FULL_TURN = (0.0, 2 * pi)
"""The sweep of a crank that goes round once."""


class GapError(Exception):
    """Two links that cannot meet: what is wrong, and what would help."""

    def __init__(self, size: float, what: str, remedy: str) -> None:
        self.size, self.what, self.remedy = size, what, remedy
        super().__init__(what)


def vector_at(length: float, angle: float) -> complex:
    """The vector of that length in that direction.

    >>> vector_at(2.0, 0.0)
    (2+0j)
    """
    return length * exp(1j * angle)


def meet(a: complex, first: Side, b: complex, second: Side, left: bool = True) -> complex:
    """Point where a link from a and a link from b meet, on the left of the line from a to b or on its right.

    In one line they just meet: a change point, which is for the analysis to judge.

    >>> meet(0, ("coupler", 3.0), 5, ("rocker", 4.0))
    (1.8+2.4j)
    """
    (_, r), (_, s), d = first, second, abs(b - a)
    tolerance = TOUCHING * (r + s)
    if d > r + s + tolerance:
        raise _too_short(first, second, d)
    if d < max(abs(r - s) - tolerance, tolerance):
        raise _too_different(first, second, d)
    along = (d * d + r * r - s * s) / (2 * d)
    across = sqrt(max(0.0, r * r - along * along))
    return a + (b - a) / d * (along + 1j * (across if left else -across))


def reach(a: complex, link: Side, line: complex, direction: float = 0.0, forward: bool = True) -> complex:
    """Point where a link from a reaches the straight line through a point, forward along its direction or backward.

    >>> reach(3j, ("rod", 5.0), 0)
    (4+0j)
    """
    name, length = link
    unit = exp(1j * direction)
    local = (a - line) / unit
    gap = abs(local.imag) - length
    if gap > TOUCHING * length:
        what = f"{name} {length:g} m is {gap:.3g} m too short to reach the line of the slide"
        raise GapError(gap, what, f"lengthen the {name}")
    step = sqrt(max(0.0, length * length - local.imag * local.imag))
    return line + unit * (local.real + (step if forward else -step))


def start_points(
    template: str,
    place: Callable[[float], Points],
    sweep: tuple[float, float],
    drive: str = "crank",
    turn: bool = True,
) -> Points:
    """The points at the start of the sweep, after the linkage was seen to close all along it.

    Raises ModelError that names the part of the sweep, the links and the missing length.
    """
    if not all(isfinite(end) for end in sweep):
        unit = "radians" if turn else "metres"
        raise ModelError(
            f"{template}: the range {sweep} of the {drive} is not finite", f"give two numbers in {unit}"
        )
    start, stop = sweep
    values = [start + (stop - start) * k / (SAMPLES - 1) for k in range(SAMPLES)]
    gaps: list[tuple[float, GapError]] = []
    first: Points = {}
    for k, value in enumerate(values):
        try:
            points = place(value)
            first = first if k else points
            if gaps:
                break
        except GapError as gap:
            gaps.append((value, gap))
    if gaps:
        raise _does_not_close(template, drive, turn, gaps)
    return first


def angle(points: Mapping[str, complex], start: str, end: str) -> float:
    """The direction from one point to another in degrees, for the `assembly` of a file."""
    return round(degrees(phase(points[end] - points[start])), 6)


def _does_not_close(template: str, drive: str, turn: bool, gaps: list[tuple[float, GapError]]) -> ModelError:
    worst = max((gap for _, gap in gaps), key=lambda gap: gap.size)
    low, high = sorted(degrees(value) if turn else value for value in (gaps[0][0], gaps[-1][0]))
    where = f"at {low:.4g}" if low == high else f"from {low:.4g} to {high:.4g}"
    return ModelError(
        f"{template} does not close {where} {'degrees' if turn else 'm'} of the {drive}: {worst.what}",
        f"{worst.remedy}, or give the {drive} a smaller range",
    )


def _too_short(first: Side, second: Side, distance: float) -> GapError:
    (i, r), (j, s) = first, second
    missing = distance - (r + s)
    what = f"{i} {r:g} m and {j} {s:g} m are {missing:.3g} m too short to meet"
    return GapError(missing, what, f"lengthen the {i} or the {j}")


def _too_different(first: Side, second: Side, distance: float) -> GapError:
    (longer, r), (shorter, s) = sorted((first, second), key=lambda side: -side[1])
    excess = r - s - distance
    what = f"{longer} {r:g} m is {excess:.3g} m too long for {shorter} {s:g} m to meet it"
    if r == s:
        what = f"{longer} and {shorter}, both {r:g} m, lie on each other and are free to turn"
    return GapError(excess, what, f"shorten the {longer} or lengthen the {shorter}")
