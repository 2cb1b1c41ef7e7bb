"""Cams: the gap between a cam and its follower, the wrench of its closing, and the drift.

rho, beta  distance and direction of the follower, as ``CamRow`` has them
q, A       its coordinate and its angle on the carrier, functions of rho; 1 and 2 their derivatives
Q          the lift over the cam's turn t = sense (A - beta)

Mechanics: docs/theory.md 2.3.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from dalembert.algebra import plane
from dalembert.algebra.protocol import Algebra
from dalembert.arrays import Array, Flags, Ints, Numeric
from dalembert.core.branchless import larger, root
from dalembert.core.elements.cam_curves import TURN, arctan2, lift, sine
from dalembert.core.elements.cam_family import FLAT, FLAT_SWINGS, SLIDES, SWINGS, CamGap, CamRow, CamSlip
from dalembert.core.geometry import arm, span, span_motion
from dalembert.core.layout import Layout, Pose, Rows

NEAR, BESIDE = 1e-9, 4e-9
"""Turn of a cam within which a place is a joint of pieces, and by how much these are then moved."""
LEAST = 1e-12
"""Least square of a sine or of a part of a length: a follower beyond the reach of its guide stays finite."""


class Follower(NamedTuple):
    """Coordinate of a follower and its angle on the carrier, each with two derivatives by rho."""

    q: tuple[Array, Array, Array]
    turn: tuple[Array, Array, Array]


class Touch(NamedTuple):
    """Data of a row at a pose: gap, its slopes by rho and beta, and their size; the follower, and the lift."""

    gap: Array
    by_rho: Array
    by_beta: Array
    size: Array
    line: Array  # from the cam's point to the follower's
    unit: Array  # of rho: along the line, or along the face's normal
    rho: Array
    follower: Follower
    at: Array  # the lift's argument: the turn of the cam
    lift: tuple[Array, Array, Array]


def _slides(f: CamRow, rho: Array) -> Follower:
    square = larger(rho * rho - f.a * f.a, LEAST * rho * rho)
    q = root(square)
    over = 1.0 / (rho * rho * q)
    angle = f.gamma - arctan2(f.a + 0.0 * q, q)
    bend = -f.a * (square + rho * rho) * over / square
    return Follower((q, rho / q, -(f.a * f.a) / (square * q)), (angle, f.a * rho * over, bend))


def _swings(f: CamRow, rho: Array) -> Follower:
    c = (f.a * f.a + f.b * f.b - rho * rho) / (2 * f.a * f.b)
    s = root(larger(1.0 - c * c, LEAST))
    first = rho / (f.a * f.b * s)
    q = arctan2(s, c), first, first / rho - c * first * first / s
    c = (f.b * f.b + rho * rho - f.a * f.a) / (2 * f.b * rho)
    s = root(larger(1.0 - c * c, LEAST))
    slope = 1.0 / f.b - c / rho
    first = -slope / s
    second = (slope / rho - c / (rho * rho)) / s - c * first * first / s
    eta = arctan2(s, c), first, second
    return Follower(q, (f.gamma - f.sigma * eta[0], -f.sigma * eta[1], -f.sigma * eta[2]))


def _flat(f: CamRow, rho: Array) -> Follower:
    none = np.zeros_like(rho)
    return Follower((rho / f.a, 1.0 / f.a + none, none), (f.gamma + none, none, none))


def _flat_swings(f: CamRow, rho: Array) -> Follower:
    c = (rho - f.a) / f.b
    s = root(larger(1.0 - c * c, LEAST))
    q = -arctan2(s, c), 1.0 / (f.b * s), c / (f.b * f.b * s * s * s)
    return Follower(q, (f.gamma + f.sigma * q[0], f.sigma * q[1], f.sigma * q[2]))


FOLLOWERS: dict[int, Callable[[CamRow, Array], Follower]] = {
    SLIDES: _slides,
    SWINGS: _swings,
    FLAT: _flat,
    FLAT_SWINGS: _flat_swings,
}


def _each(f: CamRow) -> Iterator[tuple[CamRow, Flags]]:
    """The rows of each kind, and which they are."""
    for kind in np.unique(f.form):
        which = f.form == kind
        yield (f if which.all() else type(f)(**{name: v[which] for name, v in vars(f).items()})), which


def is_flat(f: CamRow) -> bool:
    """True for rows of flat faces, all of one kind."""
    return int(f.form[0]) in (FLAT, FLAT_SWINGS)


def touch(g: Algebra, f: CamRow, pose: Pose) -> Touch:
    """Rows of one kind at a pose."""
    line = span(g, f, pose)
    if is_flat(f):
        unit = arm(g, pose, f.j, f.normal)
        rho = g.dot(unit, line)
        beta = pose.turn[..., f.j] - pose.turn[..., f.i]
    else:
        rho = root(larger(g.dot(line, line), 1e-300))
        unit = line / rho[..., None]
        beta = arctan2(line[..., 1], line[..., 0]) - pose.turn[..., f.i]
    at = FOLLOWERS[int(f.form[0])](f, rho)
    turn = f.sense * (at.turn[0] - beta)
    s = lift(f.curve, turn)
    by_rho, by_beta = at.q[1] - s[1] * f.sense * at.turn[1], s[1] * f.sense
    across = 0.0 * by_beta if is_flat(f) else by_beta / rho
    own_way = isinstance(
        f, CamGap
    )  # along its own way, of one that swings at its arm or the distance of the axes
    size = 1.0 / arm_of_swing(f) + 0.0 * rho if own_way else root(by_rho * by_rho + across * across)
    return Touch(at.q[0] - f.base - s[0], by_rho, by_beta, size, line, unit, rho, at, turn, s)


def arm_of_swing(f: CamRow) -> Array:
    """Length at which an angle of a follower is measured; 1 of one that slides."""
    lengths = {SWINGS: f.a, FLAT_SWINGS: f.b}
    return np.asarray(lengths.get(int(f.form[0]), np.ones_like(f.a)))


def normal_size(g: Algebra, f: CamRow, pose: Pose) -> Array:
    """Normal force (..., k) of a unit effort along the gap, whose wrench is not of unit size."""
    out = np.zeros((*pose.point.shape[:-2], len(f.i)), pose.point.dtype)
    for part, which in _each(f):
        out[..., which] = touch(g, part, pose).size * arm_of_swing(part)
    return out


def effort_sizes(layout: Layout, along: Rows, joints: Ints, pose: Pose) -> Iterator[tuple[Ints, Array]]:
    """Rows of sliding on cams whose gaps are freedoms, with the normal force of a unit effort; ``joints``: theirs."""
    freedoms = layout.freedoms
    gaps = [f.row for f in freedoms.families if isinstance(f, CamGap)]
    opened = freedoms.joint[np.concatenate(gaps)] if gaps else np.zeros(0, np.intp)
    for f in along.families:
        if isinstance(f, CamSlip) and opened.size:
            some = np.isin(joints[f.row], opened)
            yield f.row[some], normal_size(layout.algebra, f, pose)[..., some]


def normal(g: Algebra, f: CamRow, pose: Pose) -> Array:
    """Unit normals (..., k, 2) from the cam to the follower."""
    out = np.zeros((*pose.point.shape[:-2], len(f.i), 2), pose.point.dtype)
    for part, which in _each(f):
        out[..., which, :] = _normal(touch(g, part, pose), is_flat(part))
    return out


def _normal(t: Touch, flat: bool) -> Array:
    if flat:
        return t.unit
    along, across = t.by_rho / t.size, t.by_beta / (t.rho * t.size)
    return np.asarray(along[..., None] * t.unit + across[..., None] * plane.across(t.unit))


def measure(g: Algebra, f: CamRow, pose: Pose) -> Array:
    """The gap (..., k) along the normal, to first order."""
    out = np.zeros((*pose.point.shape[:-2], len(f.i)), pose.point.dtype)
    for part, which in _each(f):
        t = touch(g, part, pose)
        out[..., which] = t.gap / t.size
    return out


def wrench(g: Algebra, f: CamRow, pose: Pose, on_i: Array, on_j: Array) -> None:
    """A unit force along the normal: at the follower's point, or where its face touches the cam."""
    for part, _ in _each(f):
        t = touch(g, part, pose)
        n = _normal(t, is_flat(part))
        ri, rj = arm(g, pose, part.i, part.ui), arm(g, pose, part.j, part.uj)
        if is_flat(part):  # about j's point: n x line from d(rho) by j's turn, and the lift's slope by beta
            n = (t.by_rho / t.size)[..., None] * n if isinstance(f, CamGap) else n
            couple = g.cross(n, t.line) + (t.by_beta / t.size)[..., None]
            on_j[..., part.row, :2], on_j[..., part.row, 2:] = n, g.cross(rj, n) + couple
            on_i[..., part.row, :2], on_i[..., part.row, 2:] = -n, -g.cross(ri, n) - couple_on_i(t)
            continue
        on_j[..., part.row, :2], on_j[..., part.row, 2:] = n, g.cross(rj, n)
        on_i[..., part.row, :2], on_i[..., part.row, 2:] = -n, -g.cross(ri + t.line, n)


def couple_on_i(t: Touch) -> Array:
    """Moment about i's point of the force of a face on the cam, reversed."""
    return np.asarray((t.by_beta / t.size)[..., None])


def contact_place(g: Algebra, f: CamRow, pose: Pose) -> Array:
    """Point at which a face touches the cam (..., k), from j's point along the normal turned clockwise; 0 of points."""
    out = np.zeros((*pose.point.shape[:-2], len(f.i)), pose.point.dtype)
    for part, which in _each(f):
        if is_flat(part):
            t = touch(g, part, pose)
            moment = g.cross(t.unit, t.line)[..., 0] + t.by_beta / t.size
            out[..., which] = moment
    return out


def jumps(g: Algebra, f: CamRow, pose: Pose, twist: Array) -> Array:
    """1 or -1 (..., k) where the second derivative of a lift jumps at a pose, passed in the sense of its argument or
    against it; else 0."""
    out = np.zeros((*pose.point.shape[:-2], len(f.i)))
    for part, which in _each(f):
        t = touch(g, part, pose)
        off = np.abs(np.mod(t.at[..., None] - part.curve[..., 0] + np.pi, TURN) - np.pi)
        near = np.where(part.curve[..., -1] > 0, off, np.inf).min(axis=-1) < NEAR
        out[..., which] = np.where(near, np.sign(_turning(g, part, pose, twist, t)[1]), 0.0)
    return out


def jump_margins(layout: Layout, pose: Pose) -> list[Numeric]:
    """Traced values below 0 where the second derivative of some lift jumps, so that there are two answers."""
    out: list[Numeric] = []
    cams = [f for f in layout.constraints.families if isinstance(f, CamRow)]
    for part, _ in (each for f in cams for each in _each(f)):
        turn = touch(layout.algebra, part, pose).at
        for k, table in enumerate(part.curve):
            places = [row[0] for row in table if isinstance(row[-1], float) and row[-1] > 0]
            out += [
                abs(2 * sine(np.asarray((turn[..., k] - x) / 2)).item()) - NEAR for x in dict.fromkeys(places)
            ]
    return [x for x in out if getattr(x, "level", 0)]


def beside(f: CamRow, side: Array) -> CamRow:
    """The rows with lifts whose joints of pieces are moved a little, by ``side`` (k,): -1 for what is behind them."""
    curve = f.curve.copy()
    curve[..., 0] += BESIDE * np.asarray(side)[:, None]
    return replace(f, curve=curve)


def _turning(g: Algebra, part: CamRow, pose: Pose, twist: Array, t: Touch) -> tuple[tuple[Array, ...], Array]:
    """First and second rates of rho at zero accelerations, and of beta; the rate of the lift's argument."""
    rate, second = span_motion(g, part, pose, twist)
    wi, wj = twist[..., part.i, 2], twist[..., part.j, 2]
    if is_flat(part):
        aside = plane.across(t.unit) * wj[..., None]
        first = g.dot(t.unit, rate) + g.dot(aside, t.line)
        next_ = g.dot(t.unit, second) + 2 * g.dot(aside, rate) - wj * wj * t.rho
        turned, turning = wj - wi, 0.0 * wi
    else:
        first = g.dot(t.unit, rate)
        next_ = g.dot(t.unit, second) + (g.dot(rate, rate) - first * first) / t.rho
        square = t.rho * t.rho
        phi = g.cross(t.line, rate)[..., 0] / square
        turned = phi - wi
        turning = g.cross(t.line, second)[..., 0] / square - 2 * first * phi / t.rho
    return (first, next_, turning), part.sense * (t.follower.turn[1] * first - turned)


def drift(g: Algebra, f: CamRow, pose: Pose, twist: Array) -> Array:
    """Second derivative of the gap at zero accelerations, where it is closed and stays so."""
    out = np.zeros((*pose.point.shape[:-2], len(f.i)), pose.point.dtype)
    for part, which in _each(f):
        t = touch(g, part, pose)
        (first, next_, turning), rate_of_cam = _turning(g, part, pose, twist, t)
        q, a, s = t.follower.q, t.follower.turn, t.lift
        second_of_cam = part.sense * (a[2] * first * first + a[1] * next_ - turning)
        gap = q[2] * first * first + q[1] * next_ - s[1] * second_of_cam - s[2] * rate_of_cam * rate_of_cam
        out[..., which] = gap / t.size
    return out


def slip_measure(g: Algebra, f: CamRow, pose: Pose) -> Array:
    """Nothing: sliding has a rate alone."""
    return np.zeros((*pose.point.shape[:-2], len(f.i)), pose.point.dtype)


def slip_wrench(g: Algebra, f: CamRow, pose: Pose, on_i: Array, on_j: Array) -> None:
    """A unit force along the tangent, the normal turned clockwise, at the place of contact."""
    for part, _ in _each(f):
        t = touch(g, part, pose)
        tangent = -plane.across(_normal(t, is_flat(part)))
        ri, rj = arm(g, pose, part.i, part.ui), arm(g, pose, part.j, part.uj)
        on_j[..., part.row, :2], on_j[..., part.row, 2:] = tangent, g.cross(rj, tangent)
        on_i[..., part.row, :2], on_i[..., part.row, 2:] = -tangent, -g.cross(ri + t.line, tangent)


def slip_drift(g: Algebra, f: CamRow, pose: Pose, twist: Array) -> Array:
    """Rate of the sliding speed at zero accelerations."""
    out = np.zeros((*pose.point.shape[:-2], len(f.i)), pose.point.dtype)
    for part, which in _each(f):
        t = touch(g, part, pose)
        n = _normal(t, is_flat(part))
        tangent = -plane.across(n)
        rate, second = span_motion(g, part, pose, twist)
        wi, wj = twist[..., part.i, 2], twist[..., part.j, 2]
        if is_flat(part):
            height = g.dot(n, rate) + wj * g.dot(plane.across(n), t.line)
            value = g.dot(tangent, second) + wj * g.dot(n, rate) + wi * height
        else:
            value = g.dot(tangent, second - plane.across(rate) * wi[..., None])
        out[..., which] = value
    return out
