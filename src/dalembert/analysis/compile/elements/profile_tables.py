"""Profiles of cams as tables of pieces: laws of the lift, discs, arcs, flanks and points."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np

from dalembert.analysis.compile.elements.point_profiles import flat_points, polar_points, roller_too_large
from dalembert.arrays import Array, Numeric
from dalembert.core.elements.cam_curves import POWERS, TURN, piece
from dalembert.errors import ModelError
from dalembert.model.joints.elements.cam_profiles import CamArc
from dalembert.model.joints.elements.cams import Cam

JOINS = 1e-6
"""Part of the radius by which arcs may fail to join, and their slopes."""


def in_mm(length: Numeric) -> str:
    """A length in a sentence."""
    return f"{float(length) * 1e3:.6g} mm"


def lift_table(curve: Any, sign: float = 1.0) -> Array:
    """Table of a motion curve over a turn, times a sign."""
    rows = []
    for start, p in zip(curve.times, curve.pieces, strict=False):
        c = {f"c{k}": sign * x for k, x in enumerate(p.polynomial[:POWERS])}
        rows.append(
            piece(float(start), **c, amplitude=sign * p.amplitude, frequency=p.frequency, phase=p.phase)
        )
    return np.array(rows)


# profiles by their form, over the direction in the cam's axes: of the follower's point, or of its face's normal


def _disc(joint: Cam, name: str, zero: float) -> Array:
    e, radius = joint.profile.eccentric, joint.profile.radius
    assert e is not None
    assert radius is not None
    if joint.flat:
        return np.array(
            [piece(0.0, c0=radius, amplitude=e, frequency=1.0, phase=math.pi / 2)], _kind(e, radius)
        )
    size = radius + joint.follower.roller
    return np.array([piece(0.0, center=e, circle=1.0, radius=size)], _kind(e, size))


def _kind(*values: object) -> type:
    return float if all(isinstance(v, (int, float)) for v in values) else object


def _arcs(joint: Cam, name: str, zero: float) -> Array:
    arcs = joint.profile.arcs
    assert arcs is not None
    _check_arcs(name, joint, arcs)
    return _arc_table(joint, name, arcs)


def _radius_at(arc: CamArc, angle: float, more: float = 0.0) -> float:
    """Distance of an arc, or of a curve ``more`` outside it, from the cam's axis in a direction."""
    far, direction = math.hypot(*arc.center), math.atan2(arc.center[1], arc.center[0])
    v, size = angle - direction, arc.radius + more
    inside = size * size - (far * math.sin(v)) ** 2
    return far * math.cos(v) + math.copysign(math.sqrt(max(inside, 0.0)), size)


def _joint_normal(arc: CamArc, angle: float) -> tuple[float, float]:
    """Outward unit normal of an arc where it is in a direction."""
    r = _radius_at(arc, angle)
    at = r * math.cos(angle) - arc.center[0], r * math.sin(angle) - arc.center[1]
    return at[0] / arc.radius, at[1] / arc.radius


def _check_arcs(name: str, joint: Cam, arcs: tuple[CamArc, ...]) -> None:
    for k, (arc, after) in enumerate(pairwise((*arcs, arcs[0]))):
        path = ("joints", name, "profile", "arcs", k)
        where = f"cam {name!r}: at {math.degrees(arc.to):.6g} deg"
        r, s = _radius_at(arc, arc.to), _radius_at(after, arc.to)
        if abs(r - s) > JOINS * abs(r):
            raise ModelError(
                f"{where} one arc ends at {in_mm(r)} and the next begins at {in_mm(s)}", "let them meet", path
            )
        n, o = _joint_normal(arc, arc.to), _joint_normal(after, arc.to)
        off = math.degrees(abs(math.asin(max(-1.0, min(1.0, n[0] * o[1] - n[1] * o[0])))))
        if off > math.degrees(1e3 * JOINS):
            what = f"{where} the tangents of two arcs differ by {off:.3g} deg"
            raise ModelError(what, "put the centres and the point where they meet on one line", path)


def _arc_table(joint: Cam, name: str, arcs: tuple[CamArc, ...]) -> Array:
    """Pieces of arcs, each from the end of the one before."""
    starts = [arcs[-1].to - TURN, *(a.to for a in arcs[:-1])]
    rows = []
    for arc, start in zip(arcs, starts, strict=True):
        far, direction = math.hypot(*arc.center), math.atan2(arc.center[1], arc.center[0])
        n = _joint_normal(arc, start)
        if joint.flat:
            if arc.radius < 0:
                what = f"cam {name!r}: a flat face does not reach its hollow arcs"
                raise ModelError(what, "take a roller or a knife edge", ("joints", name, "follower"))
            angle = math.atan2(n[1], n[0])
            phase = math.pi / 2 + angle - direction
            rows.append(piece(angle, c0=arc.radius, amplitude=far, frequency=1.0, phase=phase))
            continue
        if arc.radius < 0 and -arc.radius <= joint.follower.roller:
            raise roller_too_large(name, (start + arc.to) / 2, -arc.radius)
        size, r = arc.radius + joint.follower.roller, _radius_at(arc, start)
        at = (
            r * math.cos(start) + joint.follower.roller * n[0],
            r * math.sin(start) + joint.follower.roller * n[1],
        )
        angle = math.atan2(at[1], at[0])
        side = math.copysign(1.0, size)
        rows.append(piece(angle, center=far, shift=angle - direction, circle=side, radius=abs(size)))
    return _in_order(rows)


def _in_order(rows: list[list[Any]]) -> Array:
    """Pieces with starts that increase from the first, within a turn."""
    first = rows[0][0]
    for row in rows:
        row[0] = row[1] = first + (row[0] - first) % TURN if row is not rows[0] else first
    return np.array(rows)


def _tangent(joint: Cam, name: str, zero: float) -> Array:
    """Base circle, flank, nose, flank, with the nose in the direction ``zero``."""
    t = joint.profile.tangent
    assert t is not None
    if joint.flat:
        what = f"cam {name!r}: a flat face does not move on the flanks of a tangent cam, and jumps from end to end"
        raise ModelError(what, "take a roller", ("joints", name, "follower"))
    r, nose = t.base + joint.follower.roller, t.nose_radius + joint.follower.roller
    half, far = t.half_angle, t.nose_distance
    reach = math.atan2(far * math.sin(half), r)  # from the flank's start to its end, at the axis
    return np.array(
        [
            piece(zero - half, line=r, straight=1.0),
            piece(zero - half + reach, center=far, circle=1.0, radius=nose, shift=reach - half),
            piece(zero + half - reach, line=r, straight=1.0, shift=-reach),
            piece(zero + half, c0=r),
        ]
    )


def _points(joint: Cam, name: str, zero: float) -> Array:
    points = joint.profile.points
    assert points is not None
    if joint.flat:
        return flat_points(name, points)
    return polar_points(name, points, joint.follower.roller)


CURVES: dict[str, Callable[[Cam, str, float], Array]] = {
    "eccentric": _disc,
    "arcs": _arcs,
    "tangent": _tangent,
    "points": _points,
}
