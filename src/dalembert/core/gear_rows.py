"""Gear meshes in space: wheels on parallel axes, on intersecting axes (bevel) and on skew axes (worm).

a, e   axis of a wheel and direction from it to the pitch point C
t      direction in which the teeth of i move at C: a_i x e_i, or its opposite where e_i points away from C
n      direction of the force of the teeth in the tangent plane, N the normal of that plane

Mechanics: docs/theory.md 2.2.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from typing import NamedTuple

import numpy as np

from dalembert.algebra.protocol import Algebra
from dalembert.arrays import Array, Index, Ints
from dalembert.core.branchless import sign
from dalembert.core.geometry import arm
from dalembert.core.layout import Family, Gearing, Layout, Pose, Teeth, ToothCouple, ToothForce

PARALLEL = 1e-9
"""Sine of the angle between two axes below which they are parallel."""

MEETING = 1e-6
"""Distance of two axes over the sum of the radii below which they intersect."""


class _Vector(NamedTuple):
    """A vector and its rate."""

    at: Array
    rate: Array


def _fixed_direction(g: Algebra, pose: Pose, twist: Array, link: Index, u: Array) -> _Vector:
    """A direction of a link."""
    a = arm(g, pose, link, u)
    return _Vector(a, g.spin(twist[..., link, g.d :], a))


def _center(g: Algebra, pose: Pose, twist: Array, link: Index, u: Array) -> _Vector:
    """A point of a link."""
    r = arm(g, pose, link, u)
    return _Vector(pose.point[..., link, :] + r, twist[..., link, : g.d] + g.spin(twist[..., link, g.d :], r))


class _Mesh(NamedTuple):
    """Vectors of one mesh with their rates, where the links have twists."""

    e: _Vector
    n: _Vector
    normal: Array
    contact: _Vector
    slide: _Vector
    trace: _Vector


def _across(g: Algebra, q: _Vector, a: _Vector) -> _Vector:
    """The unit vector of q's part across a unit vector a."""
    along, along_rate = g.dot(q.at, a.at), g.dot(q.rate, a.at) + g.dot(q.at, a.rate)
    p = q.at - along[..., None] * a.at
    rate = q.rate - along_rate[..., None] * a.at - along[..., None] * a.rate
    size = np.sqrt(g.dot(p, p))[..., None]
    e = p / size
    return _Vector(e, (rate - g.dot(rate, e)[..., None] * e) / size)


def _cross(g: Algebra, a: _Vector, b: _Vector) -> _Vector:
    return _Vector(g.cross(a.at, b.at), g.cross(a.rate, b.at) + g.cross(a.at, b.rate))


def _towards(g: Algebra, f: Teeth, span: _Vector, axis: _Vector, other: _Vector, normal: _Vector) -> _Vector:
    """e of one wheel."""
    parts = (span, other, normal)
    at, rate = (
        sum(f.direction[:, k, None] * component[part] for k, component in enumerate(parts)) for part in (0, 1)
    )
    return _across(g, _Vector(np.asarray(at), np.asarray(rate)), axis)


def _axes(g: Algebra, f: Teeth, pose: Pose, twist: Array) -> tuple[_Vector, _Vector, _Vector, _Vector]:
    """Axis and e of i, axis and e of j."""
    ai, aj = _fixed_direction(g, pose, twist, f.i, f.ai), _fixed_direction(g, pose, twist, f.j, f.aj)
    ci, cj = _center(g, pose, twist, f.i, f.ui), _center(g, pose, twist, f.j, f.uj)
    span, normal = _Vector(cj.at - ci.at, cj.rate - ci.rate), _cross(g, ai, aj)
    return ai, _towards(g, f, span, ai, aj, normal), aj, _towards(g, f, span, aj, ai, normal)


def _mesh(g: Algebra, f: Teeth, pose: Pose, twist: Array) -> _Mesh:
    a, e, _, _ = _axes(g, f, pose, twist)
    outward = sign(f.ri)[:, None]  # towards C, where e may point away from it
    t = _cross(g, a, _Vector(outward * e.at, outward * e.rate))
    cos, sin = np.cos(f.helix)[:, None], np.sin(f.helix)[:, None]
    trace = [f.cone[:, :1] * a[k] + f.cone[:, 1:] * e[k] for k in (0, 1)]
    n = _Vector(cos * t.at - sin * trace[0], cos * t.rate - sin * trace[1])
    normal = (f.cone[:, :1] * e.at - f.cone[:, 1:] * a.at) * outward
    center = _center(g, pose, twist, f.i, f.ui)
    contact = _Vector(center.at + f.ri[:, None] * e.at, center.rate + f.ri[:, None] * e.rate)
    slide = _Vector(sin * t.at + cos * trace[0], sin * t.rate + cos * trace[1])
    return _Mesh(e, n, normal, contact, slide, _Vector(*trace))


def _still(pose: Pose) -> Array:
    return np.zeros((*pose.point.shape[:-1], 6))


def angles(g: Algebra, f: Teeth, pose: Pose) -> Array:
    """psi of both wheels (..., k, 2), whole turns included."""
    out = []
    ai, ei, aj, ej = _axes(g, f, pose, _still(pose))
    for a, e, link, b, place in ((ai, ei, f.i, f.bi, 0), (aj, ej, f.j, f.bj, 1)):
        start = arm(g, pose, link, b)
        raw = np.arctan2(g.dot(e.at, g.cross(a.at, start)), g.dot(e.at, start))
        near = pose.turn[..., f.count[:, place]]
        out.append(raw + 2 * np.pi * np.round((near - raw) / (2 * np.pi)))
    return np.stack(out, axis=-1)


def measure(g: Algebra, f: Teeth, pose: Pose) -> Array:
    """ki psi_i - kj psi_j: a length, constant as the wheels roll."""
    psi = angles(g, f, pose)
    return np.asarray(f.ki * psi[..., 0] - f.kj * psi[..., 1])


def wrench(g: Algebra, f: Teeth, pose: Pose, on_i: Array, on_j: Array) -> None:
    """Force n on j at C, the opposite on i."""
    m = _mesh(g, f, pose, _still(pose))
    on_j[..., f.row, : g.d], on_i[..., f.row, : g.d] = m.n.at, -m.n.at
    on_j[..., f.row, g.d :] = g.cross(m.contact.at - pose.point[..., f.j, :], m.n.at)
    on_i[..., f.row, g.d :] = -g.cross(m.contact.at - pose.point[..., f.i, :], m.n.at)


def force_wrench(g: Algebra, f: ToothForce, pose: Pose, on_i: Array, on_j: Array) -> None:
    """Force on j at C along the trace of the teeth, or away from i; the opposite on i."""
    m = _mesh(g, f, pose, _still(pose))
    force = f.along[:, :1] * m.slide.at + f.along[:, 1:] * m.normal * f.outward[:, None]
    on_j[..., f.row, : g.d], on_i[..., f.row, : g.d] = force, -force
    on_j[..., f.row, g.d :] = g.cross(m.contact.at - pose.point[..., f.j, :], force)
    on_i[..., f.row, g.d :] = -g.cross(m.contact.at - pose.point[..., f.i, :], force)


def couple_wrench(g: Algebra, f: ToothCouple, pose: Pose, on_i: Array, on_j: Array) -> None:
    """Couple on j along the generator, the opposite on i."""
    along = _mesh(g, f, pose, _still(pose)).trace.at
    on_j[..., f.row, g.d :], on_i[..., f.row, g.d :] = along, -along


def nothing(g: Algebra, f: ToothForce | ToothCouple, pose: Pose) -> Array:
    """0: a rate, not a place."""
    return np.zeros((*pose.point.shape[:-2], len(f.i)))


def force_drift(g: Algebra, f: ToothForce, pose: Pose, twist: Array) -> Array:
    """Rate of slide . (v_j - v_i) at C at zero accelerations of the links."""
    m = _mesh(g, f, pose, twist)
    return f.along[:, 0] * _drift(g, f, pose, twist, m, m.slide)


def couple_drift(g: Algebra, f: ToothCouple, pose: Pose, twist: Array) -> Array:
    """Rate of generator . (w_j - w_i) at zero accelerations."""
    spin = twist[..., f.j, g.d :] - twist[..., f.i, g.d :]
    return np.asarray(g.dot(_mesh(g, f, pose, twist).trace.rate, spin))


def gains(g: Algebra, f: Teeth, pose: Pose) -> tuple[Array, Array]:
    """Change (..., k) of the tangential force on either wheel with a couple along the generator."""
    m = _mesh(g, f, pose, _still(pose))
    axes = (arm(g, pose, link, a) for link, a in ((f.i, f.ai), (f.j, f.aj)))
    first, second = (g.dot(m.trace.at, a) / k for a, k in zip(axes, (f.ki, f.kj), strict=True))
    return np.asarray(first), np.asarray(second)


def drift(g: Algebra, f: Gearing, pose: Pose, twist: Array) -> Array:
    """Rate of n . (v_j - v_i) at C at zero accelerations of the links; C goes with the line of centres."""
    m = _mesh(g, f, pose, twist)
    return _drift(g, f, pose, twist, m, m.n)


def _drift(g: Algebra, f: Teeth, pose: Pose, twist: Array, m: _Mesh, n: _Vector) -> Array:
    def material(link: Index) -> tuple[Array, Array]:
        v, w = twist[..., link, : g.d], twist[..., link, g.d :]
        return v + g.spin(w, m.contact.at - pose.point[..., link, :]), g.spin(w, m.contact.rate - v)

    (vi, si), (vj, sj) = material(f.i), material(f.j)
    return np.asarray(g.dot(n.rate, vj - vi) + g.dot(n.at, sj - si))


def separation(g: Algebra, f: Teeth, pose: Pose) -> tuple[Array, Array]:
    """Direction in which separation pushes j (..., k, 3), and C."""
    m = _mesh(g, f, pose, _still(pose))
    return m.normal * f.outward[:, None], m.contact.at


def wheel_axes(g: Algebra, f: Teeth, pose: Pose) -> Array:
    """Axes of the meshes (..., k, 3, 3), one per row: radial, from the axis of wheel i to C; tangential, the direction
    in which its teeth move at C as it turns; and that axis. They follow the line of centres, not the wheels."""
    a, e, _, _ = _axes(g, f, pose, _still(pose))
    radial = e.at * sign(f.ri)[:, None]
    return np.stack([radial, g.cross(a.at, radial), a.at], axis=-2)


class MeshMisfit(NamedTuple):
    """Changes that make a mesh fit (k,): factor on the radii, minus 1; remaining gap over the radii.

    ``inside`` is positive where one wheel is within the other, 0 where one is flat.
    """

    row: Ints
    scale: Array
    gap: Array
    inside: Array


def gearings(layout: Layout) -> list[Gearing]:
    """The families of meshes in space."""
    return [f for f in layout.constraints.families if isinstance(f, Gearing)]


def mesh_wheels(layout: Layout, pose: Pose) -> tuple[Layout, list[MeshMisfit]]:
    """The layout with its wheels in mesh at a pose (L+1, ...), and how well they fit.

    The centres are moved along their axes and the radii by a common factor so that the pitch points coincide; that
    holds while the axes keep their relative places, as with bearings in one carrier.
    """
    meshes = gearings(layout)
    if not meshes:
        return layout, []
    fitted = [_fit_mesh(layout, f, pose.at(None)) for f in meshes]
    families = tuple(_swap_family(f, meshes, fitted) for f in layout.constraints.families)
    constraints = replace(layout.constraints, families=families)
    return replace(layout, constraints=constraints), [misfit for _, misfit in fitted]


def _swap_family(f: Family, meshes: list[Gearing], fitted: list[tuple[Gearing, MeshMisfit]]) -> Family:
    return next((new for old, (new, _) in zip(meshes, fitted, strict=True) if old is f), f)


def _fit_mesh(layout: Layout, f: Gearing, pose: Pose) -> tuple[Gearing, MeshMisfit]:
    g = layout.algebra
    parts = [_one(g, f, pose, k) for k in range(len(f.i))]
    changed = {name: np.array([part[name] for part, _ in parts]) for name in parts[0][0]}
    made = replace(f, **changed)
    mesh, (ai, ei, aj, ej) = _mesh(g, made, pose, _still(pose)), _axes(g, made, pose, _still(pose))
    ki = made.ri * g.dot(g.cross(ai.at, ei.at), mesh.n.at)[0]
    kj = made.rj * g.dot(g.cross(aj.at, ej.at), mesh.n.at)[0]
    outward, inside = _sides(made, mesh, ei.at, ej.at)
    scale, gap = (np.array([misfit[m] for _, misfit in parts]) for m in (0, 1))
    return replace(made, ki=ki, kj=kj, outward=outward), MeshMisfit(f.row, scale, gap, inside)


def _sides(f: Teeth, mesh: _Mesh, ei: Array, ej: Array) -> tuple[Array, Array]:
    """Sign of separation on j, 1 along the normal or -1 against it, and whether one wheel is inside the other.

    The smaller wheel is pushed to that side of the tangent plane at C on which its centre lies; the larger may be flat.
    """
    side_i, side_j = (
        np.round((-r[:, None] * e * mesh.normal).sum(axis=-1)[0] / np.abs(r), 6)
        for r, e in ((f.ri, ei), (f.rj, ej))
    )
    away = np.where(np.abs(f.rj) <= np.abs(f.ri), side_j, -side_i)
    return np.where(away < 0, -1.0, 1.0), side_i * side_j


def _one(g: Algebra, f: Teeth, pose: Pose, k: int) -> tuple[dict[str, Array], tuple[float, float]]:
    """Centres, radii, direction and cone of one mesh at a pose (1, L+1, ...)."""
    i, j = f.i[k], f.j[k]
    (ai, aj), (ui, uj) = (
        [arm(g, pose, link, u)[0] for link, u in ((i, a), (j, b))]
        for a, b in ((f.ai[k], f.aj[k]), (f.ui[k], f.uj[k]))
    )
    span = pose.point[0, j] + uj - pose.point[0, i] - ui
    radii = abs(float(f.ri[k])) + abs(float(f.rj[k]))
    normal = np.cross(ai, aj)
    parallel = np.linalg.norm(normal) < PARALLEL
    meeting = not parallel and abs(span @ normal) / np.linalg.norm(normal) < MEETING * radii
    weight = np.array([parallel, meeting, not (parallel or meeting)], float)
    ei, ej = (
        _unit(v - (v @ a) * a, 1e-9 * radii)
        for v, a in (
            (weight[0] * span + weight[1] * aj + weight[2] * normal, ai),
            (weight[0] * span + weight[1] * ai + weight[2] * normal, aj),
        )
    )
    best = min(
        (_fit(span, (ai, aj), (ei * p, ej * q), (f.ri[k], f.rj[k])), p, q)
        for p, q in product((1.0, -1.0), repeat=2)
    )
    (_, (si, sj, scale), gap), p, q = best
    gap = gap if ei.any() and ej.any() else radii  # concentric wheels, whose pitch circles do not meet
    ri, rj = float(f.ri[k]) * scale * p, float(f.rj[k]) * scale * q
    cone = _cone(ai, ei, ri, aj, span + sj * aj - si * ai) if meeting else np.array([1.0, 0.0])
    changed = {
        "ui": f.ui[k] + si * f.ai[k],
        "uj": f.uj[k] + sj * f.aj[k],
        "ri": ri,
        "rj": rj,
        "direction": weight,
        "cone": cone,
    }
    return changed, (scale - 1, gap / radii)


def _fit(
    span: Array, axes: tuple[Array, Array], e: tuple[Array, Array], radii: tuple[float, float]
) -> tuple[float, tuple[float, float, float], float]:
    """Least shifts of the centres along their axes, and factor of the radii, that bring the pitch points together."""
    columns = np.stack([axes[0], -axes[1], radii[0] * e[0] - radii[1] * e[1]], axis=1)
    size = abs(radii[0]) + abs(radii[1])
    scaled = columns * [size, size, 1.0]
    x = np.linalg.lstsq(scaled, span - columns[:, 2], rcond=1e-9)[0]
    gap = float(np.linalg.norm(span - columns[:, 2] - scaled @ x))
    shift = 0.0 if np.linalg.norm(np.cross(*axes)) < PARALLEL else float(np.abs(x[:2]).max())
    return max(shift, abs(float(x[2])), gap / size), (x[0] * size, x[1] * size, 1 + float(x[2])), gap


def _cone(ai: Array, ei: Array, ri: float, aj: Array, span: Array) -> Array:
    """Parts of the pitch cone's generator along the axis of i and e; the axes intersect h above the centre of i."""
    h = float(np.linalg.lstsq(np.stack([ai, -aj], axis=1), span, rcond=None)[0][0])
    return np.asarray(np.array([h, -ri]) / (np.hypot(h, ri) * (1.0 if h >= 0 else -1.0)))


def _unit(v: Array, least: float) -> Array:
    """Direction of a vector; zeros where it is shorter than ``least``."""
    size = np.linalg.norm(v)
    return np.asarray(v / size if size > least else np.zeros_like(v))
