"""Vectors of three numbers: axes of joints, and templates in space."""

from __future__ import annotations

import math

Vector = tuple[float, float, float]


def dot(a: tuple[float, ...], b: tuple[float, ...]) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))


def length(a: tuple[float, ...]) -> float:
    """Length of a vector of numbers or of symbols, which are not floats."""
    return math.hypot(*a) if all(isinstance(x, (float, int)) for x in a) else sum(x * x for x in a) ** 0.5


def unit(a: tuple[float, ...]) -> tuple[float, ...]:
    """The vector over its length."""
    size = length(a)
    return tuple(x / size for x in a)


def cross(a: tuple[float, ...], b: tuple[float, ...]) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def times(factor: float, a: Vector) -> Vector:
    return factor * a[0], factor * a[1], factor * a[2]


def less(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def plus(*vectors: Vector) -> Vector:
    return sum(v[0] for v in vectors), sum(v[1] for v in vectors), sum(v[2] for v in vectors)
