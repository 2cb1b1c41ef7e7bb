"""Solids as triangles with normals, for 3-D files."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array
from dalembert.views.space.solids import (
    Ball,
    Block,
    GlassTube,
    Pane,
    Plate,
    Ring,
    RoundBar,
    Solid,
    across,
    circle,
    helix,
)

AROUND = 24
"""Corners of round outlines."""

WIRE = 0.12
"""Radius of wires over that of a link's bars."""


class TriangleMesh(NamedTuple):
    """Corners (n, 3), outward unit normals (n, 3) and triangles (m, 3), counter-clockwise seen from outside."""

    points: Array
    normals: Array
    triangles: Array


def join_meshes(meshes: Iterable[TriangleMesh]) -> TriangleMesh:
    """Several meshes as one."""
    points, normals, triangles, count = [], [], [], 0
    for mesh in meshes:
        points.append(mesh.points)
        normals.append(mesh.normals)
        triangles.append(mesh.triangles + count)
        count += len(mesh.points)
    return TriangleMesh(np.concatenate(points), np.concatenate(normals), np.concatenate(triangles))


def mesh(solid: Solid, rod: float) -> TriangleMesh:
    """The triangles of a solid; ``rod`` is the radius of a link's bars, which wires are thinner than."""
    if isinstance(solid, RoundBar):
        triangles = _cylinder(solid)
        if not solid.thread:
            return triangles
        return join_meshes([triangles, _wire(helix(solid, AROUND), 1.5 * WIRE * rod)])
    if isinstance(solid, Ball):
        return _ball(solid)
    if isinstance(solid, Block):
        return _block(solid)
    if isinstance(solid, Plate):
        return _plate(solid.corners, solid.thickness)
    if isinstance(solid, Ring):
        return _ring(solid)
    if isinstance(solid, GlassTube):
        return _side(
            circle(solid.start, solid.end - solid.start, solid.radius, AROUND), solid.end - solid.start
        )
    if isinstance(solid, Pane):
        return _plate(solid.corners, 0.1 * rod)
    return _wire(solid.points, WIRE * rod)


def _side(ring: Array, along: Array) -> TriangleMesh:
    """The round side of a cylinder from its first ring, whose first corner is repeated at its end."""
    count = len(ring) - 1
    middle = ring[:-1].mean(axis=0)
    out = (ring - middle) / np.linalg.norm(ring[0] - middle)
    k = np.arange(count)
    a, b, c, d = k, k + 1, k + count + 1, k + count + 2
    triangles = np.concatenate([np.stack([a, b, d], axis=-1), np.stack([a, d, c], axis=-1)])
    return TriangleMesh(np.concatenate([ring, ring + along]), np.concatenate([out, out]), triangles)


def _disc(ring: Array, normal: Array) -> TriangleMesh:
    """A flat convex polygon, its corners counter-clockwise about the normal."""
    points = np.concatenate([ring.mean(axis=0)[None], ring])
    k = np.arange(1, len(ring) + 1)
    triangles = np.stack([np.zeros_like(k), k, k % len(ring) + 1], axis=-1)
    return TriangleMesh(points, np.tile(normal, (len(points), 1)), triangles)


def _cylinder(s: RoundBar, count: int = AROUND) -> TriangleMesh:
    along = s.end - s.start
    e = along / np.linalg.norm(along)
    ring = circle(s.start, e, s.radius, count)
    return join_meshes([_side(ring, along), _disc(ring[-2::-1], -e), _disc(ring[:-1] + along, e)])


def _ball(s: Ball) -> TriangleMesh:
    rings = AROUND // 2
    polar, around = np.meshgrid(
        np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, AROUND + 1), indexing="ij"
    )
    normals = np.stack(
        [np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar)], axis=-1
    )
    triangles = _grid(rings, AROUND)
    flat = normals.reshape(-1, 3)
    return TriangleMesh(s.center + s.radius * flat, flat, triangles)


def _grid(rows: int, columns: int) -> Array:
    """Triangles of a grid of (rows + 1, columns + 1) corners; without degenerate ones in its first and last row."""
    r, c = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    a = (r * (columns + 1) + c).ravel()
    b, d = a + columns + 1, a + 1
    return np.concatenate([np.stack([a, b, b + 1], axis=-1), np.stack([a, b + 1, d], axis=-1)])


def _ring(s: Ring) -> TriangleMesh:
    e = s.axis / np.linalg.norm(s.axis)
    u, v = across(e)
    t, p = np.meshgrid(np.linspace(0, 2 * np.pi, 49), np.linspace(0, 2 * np.pi, 13), indexing="ij")
    out = np.cos(t)[..., None] * u + np.sin(t)[..., None] * v
    normals = np.cos(p)[..., None] * out + np.sin(p)[..., None] * e
    points = s.center + s.radius * out + s.thickness * normals
    return TriangleMesh(points.reshape(-1, 3), normals.reshape(-1, 3), _grid(48, 12))


def _block(s: Block) -> TriangleMesh:
    out = []
    for k in range(3):
        u, v = s.axes[(k + 1) % 3] * s.half[(k + 1) % 3], s.axes[(k + 2) % 3] * s.half[(k + 2) % 3]
        if np.linalg.det(s.axes) < 0:
            u, v = v, u
        for sign in (1.0, -1.0):
            middle = s.center + sign * s.half[k] * s.axes[k]
            corners = np.array([middle + u + v, middle - u + v, middle - u - v, middle + u - v])
            out.append(_disc(corners if sign > 0 else corners[::-1], sign * s.axes[k]))
    return join_meshes(out)


def _plate(corners: Array, thickness: float) -> TriangleMesh:
    """A flat polygon thickened to both sides."""
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    normal = normal / np.linalg.norm(normal)
    up = 0.5 * thickness * normal
    out = [_disc(corners + up, normal), _disc(corners[::-1] - up, -normal)]
    for a, b in pairwise([*corners, corners[0]]):
        aside = np.cross(b - a, normal)
        out.append(_disc(np.array([a - up, b - up, b + up, a + up]), aside / np.linalg.norm(aside)))
    return join_meshes(out)


def _wire(points: Array, radius: float) -> TriangleMesh:
    return join_meshes(
        _cylinder(RoundBar(a, b, radius), 5) for a, b in pairwise(points) if np.linalg.norm(b - a) > 0
    )
