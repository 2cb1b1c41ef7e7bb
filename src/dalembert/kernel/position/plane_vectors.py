"""Plane vectors and rotations as pairs of traced scalars; a rotation is (cos, sin)."""

from __future__ import annotations

from dalembert.kernel.graph import Scalar

Pair = tuple[Scalar, Scalar]


def plus(a: Pair, b: Pair) -> Pair:
    return a[0] + b[0], a[1] + b[1]


def minus(a: Pair, b: Pair) -> Pair:
    return a[0] - b[0], a[1] - b[1]


def times(k: Scalar, a: Pair) -> Pair:
    return k * a[0], k * a[1]


def dot(a: Pair, b: Pair) -> Scalar:
    return a[0] * b[0] + a[1] * b[1]


def cross(a: Pair, b: Pair) -> Scalar:
    return a[0] * b[1] - a[1] * b[0]


def across(a: Pair) -> Pair:
    return -a[1], a[0]


def rotate(r: Pair, u: Pair) -> Pair:
    """u turned by r; the product of two rotations."""
    return r[0] * u[0] - r[1] * u[1], r[1] * u[0] + r[0] * u[1]


def rotate_back(r: Pair, u: Pair) -> Pair:
    """u turned back by r."""
    return r[0] * u[0] + r[1] * u[1], r[0] * u[1] - r[1] * u[0]
