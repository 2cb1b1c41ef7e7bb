"""The one matrix A: measures, wrenches and drifts of rows (docs/theory.md 1).

r   arm of the acting point from the link's reference point, ground axes
e   axis of a row, ground axes
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from dalembert.algebra import plane
from dalembert.algebra.protocol import Algebra
from dalembert.arrays import Array
from dalembert.core import gear_rows, rotation_rows
from dalembert.core.elements import cam_rows, lining_rows, strand_rows
from dalembert.core.elements.cam_family import CamGap, CamRow, CamSlip
from dalembert.core.elements.linings import BandStrands, Lining
from dalembert.core.elements.strand_family import Strand, StrandSum
from dalembert.core.geometry import arm, point_motion, span, span_motion
from dalembert.core.layout import (
    Along,
    Angle,
    BeltMesh,
    ConstraintRows,
    Distance,
    Family,
    Gearing,
    Helix,
    Idle,
    Layout,
    Meet,
    Mesh,
    Perpendicular,
    Pose,
    Rows,
    ToothCouple,
    ToothForce,
    Turn,
)


def measure(g: Algebra, rows: Rows, pose: Pose) -> Array:
    """Value of each row (..., K): lengths and angles that constraints hold at their targets."""
    out = np.zeros((*pose.point.shape[:-2], rows.count), pose.point.dtype)
    for family in rows.families:
        out[..., family.row] = _MEASURES[type(family)](g, family, pose)
    return out


def wrenches(g: Algebra, rows: Rows, pose: Pose) -> tuple[Array, Array]:
    """Wrench of each row on i and on j per unit of multiplier, each about its link's reference point: (..., K, n)."""
    shape = (*pose.point.shape[:-2], rows.count, g.n)
    on_i, on_j = np.zeros(shape, pose.point.dtype), np.zeros(shape, pose.point.dtype)
    for family in rows.families:
        _WRENCHES[type(family)](g, family, pose, on_i, on_j)
    return on_i, on_j


def drift(g: Algebra, rows: Rows, pose: Pose, twist: Array) -> Array:
    """Second derivative of each measure at zero acceleration (..., K); ``twist`` (..., L+1, n)."""
    out = np.zeros((*pose.point.shape[:-2], rows.count), pose.point.dtype)
    for family in rows.families:
        if not isinstance(family, Turn):
            out[..., family.row] = _DRIFTS[type(family)](g, family, pose, twist)
    return out


def system(g: Algebra, rows: Rows, pose: Pose) -> ConstraintRows:
    """The rows with their wrenches at a pose."""
    return ConstraintRows(*rows.ends, rows.angular, *wrenches(g, rows, pose))


def stack_rows(layout: Layout, pose: Pose) -> ConstraintRows:
    """The constraint rows, then the drives' rows."""
    return system(layout.algebra, layout.stack, pose)


def dense(layout: Layout, rows: ConstraintRows) -> Array:
    """J, dense: (..., K, n L); its transpose is A. Velocities of the measures are J v."""
    n, k = layout.algebra.n, np.arange(len(rows.i))
    lead = rows.on_j.shape[:-2]
    full = np.zeros((*lead, len(k), layout.links + 1, n), rows.on_j.dtype)
    full[..., k, rows.i, :] = rows.on_i
    full[..., k, rows.j, :] = rows.on_j
    return full[..., : layout.links, :].reshape((*lead, len(k), layout.links * n))


def rates(rows: ConstraintRows, twist: Array) -> Array:
    """Velocities of the measures (..., K) for twists (..., L+1, n) of all links."""
    return np.asarray((rows.on_i * twist[..., rows.i, :] + rows.on_j * twist[..., rows.j, :]).sum(axis=-1))


def _relative_turn(f: Along | Turn, pose: Pose) -> Array:
    return np.asarray(pose.turn[..., f.j] - pose.turn[..., f.i])


def _unit(span: Array) -> tuple[Array, Array]:
    length = np.sqrt((span * span).sum(axis=-1))
    return span / length[..., None], length


def _mesh_measure(g: Algebra, f: Mesh, pose: Pose) -> Array:
    line = span(g, f, pose)
    phi = np.arctan2(line[..., 1], line[..., 0])
    return np.asarray(f.ri * (pose.turn[..., f.i] - phi) + f.rj * (pose.turn[..., f.j] - phi))


def _along_measure(g: Algebra, f: Along, pose: Pose) -> Array:
    along: Array = g.dot(arm(g, pose, f.i, f.axis), span(g, f, pose))
    if f.pitch.dtype != object and not f.pitch.any():
        return along
    return np.asarray(along + f.pitch * _relative_turn(f, pose))


_MEASURES: dict[type[Family], Callable[..., Array]] = {
    Meet: span,
    Along: _along_measure,
    Turn: lambda g, f, pose: _relative_turn(f, pose),
    Mesh: _mesh_measure,
    BeltMesh: _mesh_measure,
    Distance: lambda g, f, pose: _unit(span(g, f, pose))[1],
    Perpendicular: rotation_rows.perpendicular,
    Angle: rotation_rows.angle,
    Helix: rotation_rows.helix,
    Idle: rotation_rows.idle,
    Gearing: gear_rows.measure,
    Strand: strand_rows.measure,
    StrandSum: strand_rows.sum_measure,
    Lining: lining_rows.lining_measure,
    BandStrands: lining_rows.strands_measure,
    CamRow: cam_rows.measure,
    CamGap: cam_rows.measure,
    CamSlip: cam_rows.slip_measure,
    ToothForce: gear_rows.nothing,
    ToothCouple: gear_rows.nothing,
}


def _meet_wrench(g: Algebra, f: Meet, pose: Pose, on_i: Array, on_j: Array) -> None:
    ri, rj = arm(g, pose, f.i, f.ui), arm(g, pose, f.j, f.uj)
    axes = np.eye(g.d)
    on_j[..., f.row, : g.d], on_j[..., f.row, g.d :] = axes, g.cross(rj[..., None, :], axes)
    on_i[..., f.row, : g.d], on_i[..., f.row, g.d :] = -axes, -g.cross(ri[..., None, :], axes)


def _along_wrench(g: Algebra, f: Along, pose: Pose, on_i: Array, on_j: Array) -> None:
    e = arm(g, pose, f.i, f.axis)
    rj = arm(g, pose, f.j, f.uj)
    ri = pose.point[..., f.j, :] + rj - pose.point[..., f.i, :]
    pitch = f.pitch[..., None]
    on_j[..., f.row, : g.d], on_j[..., f.row, g.d :] = e, g.cross(rj, e) + pitch
    on_i[..., f.row, : g.d], on_i[..., f.row, g.d :] = -e, -(g.cross(ri, e) + pitch)


def _turn_wrench(g: Algebra, f: Turn, pose: Pose, on_i: Array, on_j: Array) -> None:
    on_j[..., f.row, -1] = 1
    on_i[..., f.row, -1] = -1


def _mesh_wrench(g: Algebra, f: Mesh, pose: Pose, on_i: Array, on_j: Array) -> None:
    e, length = _unit(span(g, f, pose))
    t = plane.across(e) * ((f.ri + f.rj) / length)[..., None]
    ri, rj = arm(g, pose, f.i, f.ui), arm(g, pose, f.j, f.uj)
    on_j[..., f.row, : g.d], on_j[..., f.row, g.d :] = -t, f.rj[..., None] - g.cross(rj, t)
    on_i[..., f.row, : g.d], on_i[..., f.row, g.d :] = t, f.ri[..., None] + g.cross(ri, t)


def _distance_wrench(g: Algebra, f: Distance, pose: Pose, on_i: Array, on_j: Array) -> None:
    e, _ = _unit(span(g, f, pose))
    ri, rj = arm(g, pose, f.i, f.ui), arm(g, pose, f.j, f.uj)
    on_j[..., f.row, : g.d], on_j[..., f.row, g.d :] = e, g.cross(rj, e)
    on_i[..., f.row, : g.d], on_i[..., f.row, g.d :] = -e, -g.cross(ri, e)


_WRENCHES: dict[type[Family], Callable[..., None]] = {
    Meet: _meet_wrench,
    Along: _along_wrench,
    Turn: _turn_wrench,
    Mesh: _mesh_wrench,
    BeltMesh: _mesh_wrench,
    Distance: _distance_wrench,
    Perpendicular: rotation_rows.perpendicular_wrench,
    Angle: rotation_rows.angle_wrench,
    Helix: rotation_rows.helix_wrench,
    Idle: rotation_rows.idle_wrench,
    Gearing: gear_rows.wrench,
    Strand: strand_rows.wrench,
    StrandSum: strand_rows.sum_wrench,
    Lining: lining_rows.lining_wrench,
    BandStrands: lining_rows.strands_wrench,
    CamRow: cam_rows.wrench,
    CamGap: cam_rows.wrench,
    CamSlip: cam_rows.slip_wrench,
    ToothForce: gear_rows.force_wrench,
    ToothCouple: gear_rows.couple_wrench,
}


def _along_drift(g: Algebra, f: Along, pose: Pose, twist: Array) -> Array:
    rj = arm(g, pose, f.j, f.uj)
    vj, aj = point_motion(g, pose, twist, f.j, rj)
    vi, ai = point_motion(g, pose, twist, f.i, pose.point[..., f.j, :] + rj - pose.point[..., f.i, :])
    coriolis = 2 * g.spin(twist[..., f.i, g.d :], vj - vi)
    return np.asarray(g.dot(arm(g, pose, f.i, f.axis), aj - ai - coriolis))


def _mesh_drift(g: Algebra, f: Mesh, pose: Pose, twist: Array) -> Array:
    line = span(g, f, pose)
    rate, second = span_motion(g, f, pose, twist)
    square = g.dot(line, line)
    phi_rate = g.cross(line, rate)[..., 0] / square
    return np.asarray(
        -(f.ri + f.rj) * (g.cross(line, second)[..., 0] - 2 * g.dot(line, rate) * phi_rate) / square
    )


def _distance_drift(g: Algebra, f: Distance, pose: Pose, twist: Array) -> Array:
    e, length = _unit(span(g, f, pose))
    rate, second = span_motion(g, f, pose, twist)
    along = g.dot(e, rate)
    return np.asarray(g.dot(e, second) + (g.dot(rate, rate) - along * along) / length)


_DRIFTS: dict[type[Family], Callable[..., Array]] = {
    Meet: lambda g, f, pose, twist: span_motion(g, f, pose, twist)[1],
    Along: _along_drift,
    Mesh: _mesh_drift,
    BeltMesh: _mesh_drift,
    Distance: _distance_drift,
    Perpendicular: rotation_rows.perpendicular_drift,
    Angle: rotation_rows.angle_drift,
    Helix: rotation_rows.helix_drift,
    Idle: rotation_rows.idle_drift,
    Gearing: gear_rows.drift,
    Strand: strand_rows.drift,
    StrandSum: strand_rows.sum_drift,
    Lining: lining_rows.lining_drift,
    BandStrands: lining_rows.strands_drift,
    CamRow: cam_rows.drift,
    CamGap: cam_rows.drift,
    CamSlip: cam_rows.slip_drift,
    ToothForce: gear_rows.force_drift,
    ToothCouple: gear_rows.couple_drift,
}
