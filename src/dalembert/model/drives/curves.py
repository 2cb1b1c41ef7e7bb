"""Motion curves as pieces, each a polynomial and a sine wave, with exact speed, acceleration, jerk and peaks.

The rises of the textbooks are written by their acceleration over a unit rise in a unit duration; everything else
follows by integration. Source: Norton, Design of Machinery, chapter 8; Rothbart, Cams; VDI 2143.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from dalembert.arrays import Array

SAME = 1e-9
"""Part of a curve's largest rate by which two rates at a joint of pieces may differ and be equal."""

PI = math.pi
ACCELERATIONS: dict[str, tuple[float, tuple[tuple[float, float, float, float], ...]]] = {
    "constant_speed": (1.0, ((1.0, 0.0, 0.0, PI / 2),)),
    "parabolic": (0.0, ((0.5, 4.0, 0.0, PI / 2), (0.5, -4.0, 0.0, PI / 2))),
    "harmonic": (0.0, ((1.0, PI**2 / 2, PI, PI / 2),)),
    "cycloidal": (0.0, ((1.0, 2 * PI, 2 * PI, 0.0),)),
    "modified_sine": (
        0.0,
        (
            (0.125, 4 * PI**2 / (4 + PI), 4 * PI, 0.0),
            (0.75, 4 * PI**2 / (4 + PI), 4 * PI / 3, PI / 2),
            (0.125, 4 * PI**2 / (4 + PI), 4 * PI, 3.5 * PI),
        ),
    ),
    "modified_trapezoid": (
        0.0,
        (
            (0.125, 8 * PI / (2 + PI), 4 * PI, 0.0),
            (0.25, 8 * PI / (2 + PI), 0.0, PI / 2),
            (0.25, 8 * PI / (2 + PI), 4 * PI, PI / 2),
            (0.25, -8 * PI / (2 + PI), 0.0, PI / 2),
            (0.125, -8 * PI / (2 + PI), 4 * PI, PI / 2),
        ),
    ),
}
"""Speed at the start, then lengths of the pieces with their acceleration C sin(w u + phase): C, w, phase."""

POLYNOMIALS = {
    "polynomial345": (0.0, 0.0, 0.0, 10.0, -15.0, 6.0),
    "polynomial4567": (0.0, 0.0, 0.0, 0.0, 35.0, -84.0, 70.0, -20.0),
}
"""Coefficients of the unit rise, the lowest power first."""


@dataclass(frozen=True)
class CurvePiece:
    """s(u) = sum of c_k u^k + a sin(w u + p) for u from 0 to ``length``, u counted from the start of the piece."""

    length: float
    polynomial: tuple[float, ...]
    amplitude: float = 0.0
    frequency: float = 0.0
    phase: float = 0.0

    def at(self, u: Array) -> Array:
        """s and its first three derivatives (4, ...)."""
        out = []
        for order in range(4):
            c = np.polynomial.polynomial.polyder(self.polynomial, order) if order else self.polynomial
            wave = (
                self.amplitude
                * self.frequency**order
                * np.sin(self.frequency * u + self.phase + order * PI / 2)
            )
            out.append(np.polynomial.polynomial.polyval(u, c) + wave)
        return np.array(out)

    def start(self) -> Array:
        """s and its derivatives (4,) where it begins."""
        return self.at(np.array(0.0))

    def end(self) -> Array:
        """s and its derivatives (4,) where it ends."""
        return self.at(np.array(self.length))

    def scaled(self, start: float, rise: float, length: float) -> CurvePiece:
        """The same piece of a unit rise over a unit length, of a rise that begins at ``start``."""
        c = [rise * x / length**k for k, x in enumerate(self.polynomial)]
        c[0] += start
        return CurvePiece(
            self.length * length, tuple(c), rise * self.amplitude, self.frequency / length, self.phase
        )

    def extremes(self, order: int) -> list[float]:
        """Places within the piece where a derivative of this order is stationary, ascending."""
        if self.amplitude:  # beside a sine wave the polynomial is at most of second degree
            c = np.polynomial.polynomial.polyder(self.polynomial, order + 1)
            size = self.amplitude * self.frequency ** (order + 1)
            level = -float(c[0]) / size if len(c) else 0.0
            if abs(level) > 1:
                return []
            angles = [math.asin(level), PI - math.asin(level)]
            shift = self.phase + (order + 1) * PI / 2
            turns = range(-3, 2 + int(self.frequency * self.length / PI) + int(abs(shift) / PI))
            out = [(x - shift + 2 * PI * k) / self.frequency for x in angles for k in turns]
        else:
            c = np.polynomial.polynomial.polyder(self.polynomial, order + 1)
            roots = np.polynomial.polynomial.polyroots(np.trim_zeros(c, "b")) if np.any(c) else np.zeros(0)
            out = [float(x.real) for x in roots if abs(x.imag) <= 1e-9 * self.length]
        return sorted(u for u in out if 0 < u < self.length)


def integrated(speed: float, pieces: Iterable[tuple[float, float, float, float]]) -> tuple[CurvePiece, ...]:
    """Pieces from 0 of an acceleration C sin(w u + p), by (length, C, w, p), continuous in position and speed."""
    out: list[CurvePiece] = []
    position = 0.0
    for length, size, w, p in pieces:
        if w:
            a = -size / w**2
            piece = CurvePiece(length, (position - a * math.sin(p), speed - a * w * math.cos(p)), a, w, p)
        else:
            piece = CurvePiece(length, (position, speed, size * math.sin(p) / 2))
        out.append(piece)
        position, speed = (float(x) for x in piece.end()[:2])
    return tuple(out)


def unit_rise(form: str) -> tuple[CurvePiece, ...]:
    """A rise from 0 to 1 over 0 to 1, at rest at both ends but for constant speed."""
    if form in POLYNOMIALS:
        return (CurvePiece(1.0, POLYNOMIALS[form]),)
    return integrated(*ACCELERATIONS[form])


def trapezoid(parts: Sequence[float]) -> tuple[CurvePiece, ...]:
    """A unit rise that speeds up, keeps its speed and slows down evenly, for these parts of its duration."""
    up, even, down = (x / sum(parts) for x in parts)
    v = 1 / (up / 2 + even + down / 2)
    rates = ((up, v / up if up else 0.0), (even, 0.0), (down, -v / down if down else 0.0))
    return integrated(0.0 if up else v, [(length, a, 0.0, PI / 2) for length, a in rates if length])


def polynomial(length: float, start: Sequence[float], end: Sequence[float | None]) -> CurvePiece:
    """The polynomial of least degree from position, speed, acceleration and jerk ``start`` to ``end``; None of both is
    free."""
    known = [k for k, value in enumerate(end) if value is not None]
    n = 2 * len(known)
    rows = np.zeros((n, n))
    right = np.zeros(n)
    for row, k in enumerate(known):
        rows[row, k] = math.factorial(k)
        rows[len(known) + row] = [math.perm(j, k) if j >= k else 0.0 for j in range(n)]
        right[row], right[len(known) + row] = start[k] * length**k, float(end[k] or 0.0) * length**k
    c = np.linalg.solve(rows, right)
    return CurvePiece(length, tuple(x / length**k for k, x in enumerate(c.tolist())))


def s_curve(
    rise: float, speed: float, acceleration: float, jerk: float
) -> tuple[tuple[CurvePiece, ...], str]:
    """A rise from rest to rest in the least time within limits, and which limits it reaches."""
    h, v, a, j = abs(rise), speed, acceleration, jerk
    ramp, up = (a / j, v / a + a / j) if v * j >= a * a else (math.sqrt(v / j), 2 * math.sqrt(v / j))
    reached = "speed, acceleration and jerk" if v * j >= a * a else "speed and jerk"
    even = h / v - up
    if even < 0:
        even = 0.0
        if h >= 2 * a**3 / j**2:
            v = (-(a**2) / j + math.sqrt(a**4 / j**2 + 4 * a * h)) / 2
            ramp, up, reached = a / j, v / a + a / j, "acceleration and jerk"
        else:
            ramp = (h / (2 * j)) ** (1 / 3)
            up, reached = 2 * ramp, "jerk"
    hold = up - 2 * ramp
    signs = ((ramp, 1), (hold, 0), (ramp, -1), (even, 0), (ramp, -1), (hold, 0), (ramp, 1))
    pieces, state = list[CurvePiece](), np.zeros(3)
    for length, sign in signs:
        if length > 1e-12 * up:
            rate = math.copysign(j * sign, rise * sign) if sign else 0.0
            piece = CurvePiece(length, (*(state / (1, 1, 2)).tolist(), rate / 6))
            pieces.append(piece)
            state = piece.end()[:3]
    return tuple(pieces), reached


@dataclass(frozen=True)
class Curve:
    """Pieces one after the other from 0 on; ``periodic``: it begins again behind its end."""

    pieces: tuple[CurvePiece, ...]
    periodic: bool = False

    @cached_property
    def times(self) -> Array:
        """Starts of the pieces, and the end (N + 1,)."""
        return np.concatenate([[0.0], np.cumsum([p.length for p in self.pieces])])

    @property
    def duration(self) -> float:
        return float(self.times[-1])

    def at(self, x: Array | float, before: bool = False) -> Array:
        """s and its derivatives of first to third order (4, ...): behind a joint of pieces, or ``before`` it, within
        rounding. Beyond the ends of a curve that is not periodic it rests."""
        t, flat = np.asarray(x, float), np.ravel(np.asarray(x, float))
        inner = np.mod(flat, self.duration) if self.periodic else np.clip(flat, 0.0, self.duration)
        near = SAME * self.duration
        if self.periodic:  # a joint that rounding has put on its other side
            first = inner <= near if before else inner - self.duration < -near
            inner = inner + self.duration * (first if before else first - 1.0)
        which = np.searchsorted(self.times, inner + (-near if before else near)) - 1
        which = np.clip(which, 0, len(self.pieces) - 1)
        out = np.zeros((4, flat.size))
        for k in np.unique(which):
            here = which == k
            out[:, here] = self.pieces[k].at(inner[here] - self.times[k])
        if not self.periodic:
            out[1:, (flat < 0) | (flat > self.duration)] = 0.0
        return out.reshape(4, *t.shape)

    def peaks(self, order: int) -> tuple[float, float]:
        """The largest magnitude of a derivative of this order, and where it is."""
        best = (-1.0, 0.0)
        for start, piece in zip(self.times, self.pieces, strict=False):
            places = np.array([0.0, *piece.extremes(order), piece.length])
            sizes = np.abs(piece.at(places)[order])
            k = int(np.argmax(sizes > (1 - 1e-12) * sizes.max()))
            if sizes[k] > best[0] * (1 + 1e-12):
                best = (float(sizes[k]), float(start + places[k]))
        return best

    def jumps(self, order: int) -> list[float]:
        """Joints of pieces, the ends of a periodic curve among them, at which a derivative of this order jumps."""
        size = self.peaks(order)[0]
        pairs = [(a, b, t) for (a, b), t in zip(pairwise(self.pieces), self.times[1:-1], strict=True)]
        if self.periodic:
            pairs.append((self.pieces[-1], self.pieces[0], self.duration))
        ends = ((a.end()[order], b.start()[order], t) for a, b, t in pairs)
        return [float(t) for left, right, t in ends if abs(left - right) > SAME * size]
