"""A motion followed from its first pose: a coarse march, then all positions corrected at once.

s  path parameter: the place in the list of positions, 0 .. P-1, with the drives linear between neighbours

The march goes from station to station with a predictor through the last ones, halving its step where the corrector
moves far. Where the determinant of J changes its sign smoothly the motion passed a change point, and goes on. Where no
step is small enough it has come to a dead centre, and ends. Between stations the poses are interpolated and corrected
together; a position whose correction is not small next to the spacing of the stations is not trusted.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dalembert.core.closure import CLOSED, closed, distance, moved
from dalembert.core.constraints import dense, stacked
from dalembert.core.factor import SPARSE, factor
from dalembert.core.layout import Layout, Pose

Array = NDArray[Any]

STRIDE = 0.31
"""Radians of a drive (or slide over characteristic length) between stations; no divisor of a quarter turn."""

NODES = 8
"""Stations in an interpolation or extrapolation."""

BLOCK = 2048
"""Positions corrected at once: enough to hide the cost of a numpy call, few enough to stay in the cache."""

TRUSTED = 0.05
"""Largest correction of an interpolated pose, radians or characteristic lengths."""

MOST_GAPS = 8
"""Times a motion is taken up again behind a gap."""

SHORTEST = 2.0**-14
"""Part of a stride at which the march gives up: a dead centre lies within."""


class March(NamedTuple):
    """Stations of a march: parameters (S,), their poses (S, L+1, ...), and whether the end of the list was reached."""

    s: Array
    pose: Pose
    whole: bool


def target_at(targets: Array, s: Array) -> Array:
    """Targets between the positions of the list, linear in s: (S, K + D)."""
    last = len(targets) - 1
    low = np.clip(np.floor(s).astype(int), 0, max(last - 1, 0))
    part = (s - low)[:, None]
    return np.asarray(targets[low] * (1 - part) + targets[np.minimum(low + 1, last)] * part)


def interpolated(s: Array, nodes: Array, pose: Pose, layout: Layout) -> Pose:
    """Poses at s (P,) by Lagrange polynomials through the ``NODES`` nearest stations; also outside them."""
    count = min(NODES, len(nodes))
    first = np.clip(np.searchsorted(nodes, s) - count // 2, 0, len(nodes) - count)
    index = first[:, None] + np.arange(count)
    weights = _lagrange(s, nodes[index])
    point = np.einsum("pk,pkld->pld", weights, pose.point[index])
    turn = np.einsum("pk,pkl->pl", weights, pose.turn[index])
    return Pose(point, turn, layout.algebra.rotation(turn))


def _lagrange(s: Array, nodes: Array) -> Array:
    """Weights (P, k) of nodes (P, k) at s (P,)."""
    out = np.ones(nodes.shape)
    for a in range(nodes.shape[1]):
        for b in range(nodes.shape[1]):
            if a != b:
                out[:, a] *= (s - nodes[:, b]) / (nodes[:, a] - nodes[:, b])
    return out


def march(layout: Layout, first: Pose, targets: Array, start: float = 0.0, backward: bool = False) -> March:
    """Stations from position ``start`` to the end of the list (or its beginning), from the pose there (L+1, ...)."""
    end = 0.0 if backward else len(targets) - 1.0
    sign = -1.0 if backward else 1.0
    s, poses, size = [float(start)], [first], 1.0
    while sign * (end - s[-1]) > 0:
        stride = _stride(layout, targets, s[-1], sign)
        ahead = s[-1] + sign * min(size * stride, abs(end - s[-1]))
        new = _station(layout, targets, np.array(s), poses, ahead)
        if new is None:
            size /= 2
            if size < SHORTEST:
                break
            continue
        s.append(ahead)
        poses.append(new)
        size = min(2 * size, 1.0)
    order = np.argsort(s)
    whole = sign * (end - s[-1]) <= 0
    return March(np.array(s)[order], stack([poses[k] for k in order]), bool(whole))


def stack(poses: list[Pose]) -> Pose:
    """Single poses as one with a leading axis."""
    return Pose(*(np.stack(part) for part in zip(*poses, strict=True)))


def _stride(layout: Layout, targets: Array, s: float, sign: float) -> float:
    """Step in s that moves the fastest drive by ``STRIDE``, not past the next position where positions are sparse."""
    here = int(np.ceil(s) - 1 if sign < 0 else np.floor(s))
    here = min(max(here, 0), len(targets) - 2)
    rates = np.abs(targets[here + 1] - targets[here])
    scale = np.ones(len(rates))
    drives = len(layout.driven)
    angular = layout.freedoms.angular[layout.driven]
    scale[len(rates) - drives :] = np.where(angular, 1.0, 1 / layout.length)
    fastest = float((rates * scale).max(initial=0.0))
    return STRIDE / fastest if fastest > 0 else np.inf


def _station(layout: Layout, targets: Array, s: Array, poses: list[Pose], ahead: float) -> Pose | None:
    """The pose at ``ahead``, predicted from the last stations and corrected; None where the prediction is poor."""
    there = target_at(targets, np.array([ahead]))
    guess = _predicted(layout, targets, s, poses, ahead, there)
    pose, missing = closed(layout, guess, there, iterations=12, polish=False)
    if not missing[0] <= CLOSED * layout.length:
        return None
    correction = float(distance(layout, pose, guess)[0])
    travel = float(distance(layout, pose, poses[-1].at(None))[0])
    if correction > 0.15 * travel + 1e-6 or travel > 4 * STRIDE:
        return None
    return pose.at(0)


def _predicted(
    layout: Layout, targets: Array, s: Array, poses: list[Pose], ahead: float, there: Array
) -> Pose:
    """Polynomial through the last stations; along the velocity from the first."""
    if len(s) > 1:
        order = np.argsort(s[-6:])
        recent = stack([poses[-6:][k] for k in order])
        return interpolated(np.array([ahead]), s[-6:][order], recent, layout)
    here = poses[-1].at(None)
    return moved(layout, here, velocity(layout, here, there - target_at(targets, s[-1:])))


def velocity(layout: Layout, pose: Pose, rates: Array) -> Array:
    """Twists (..., L, n) of the moving links at rates (..., K + D) of the measures."""
    twist = factor(layout, stacked(layout, pose)).motion(rates)
    return np.nan_to_num(twist).reshape((*twist.shape[:-1], layout.links, layout.algebra.n))


class Path(NamedTuple):
    """All positions of a list: poses (P, L+1, ...), and which were reached (P,)."""

    pose: Pose
    reached: NDArray[np.bool_]


def path(
    layout: Layout, first: Pose, targets: Array, period: Array | None = None, start: float = 0.0
) -> Path:
    """Poses at every position of the list, followed both ways from the pose (L+1, ...) at parameter ``start``.

    ``period`` (K + D) is what a whole cycle adds to the targets, if the list is one: then what lies behind a dead
    centre is also reached backwards from the first position. What is still missing is looked for from the poses
    already known, on the first one's side of the dead centre (same sign of det J).
    """
    if len(targets) == 1:
        return Path(first.at(None), np.ones(1, bool))
    forward = march(layout, first, targets, start)
    result = _filled(layout, targets, forward)
    if start > 0:
        result = _joined(
            result, _filled(layout, targets, march(layout, first, targets, start, backward=True))
        )
    if not forward.whole and period is not None and result.reached[0]:
        cycle = np.concatenate([targets - period, targets[:1]])
        back = march(layout, result.pose.at(0), cycle, start=len(targets), backward=True)
        result = _joined(result, _filled(layout, cycle, back, count=len(targets)))
    return result if result.reached.all() else _reentered(layout, first, targets, result)


def _filled(layout: Layout, targets: Array, piece: March, count: int | None = None) -> Path:
    """The first ``count`` positions, where they lie within a march, by interpolation and correction."""
    s = np.arange(count or len(targets), dtype=float)
    inside = (s >= piece.s[0] - 1e-9) & (s <= piece.s[-1] + 1e-9)
    pose = interpolated(s, piece.s, piece.pose, layout)
    reached = np.zeros(len(s), bool)
    places = np.flatnonzero(inside)
    for block in np.split(places, range(BLOCK, len(places), BLOCK)):
        guess = pose.at(block)
        part, missing = closed(layout, guess, targets[block])
        near = distance(layout, part, guess) <= TRUSTED
        for whole, new in zip(pose, part, strict=True):
            whole[block] = new
        reached[block] = near & (missing <= CLOSED * layout.length)
    return Path(pose, reached)


def _joined(a: Path, b: Path) -> Path:
    """The first where it reached, else the second."""
    take = a.reached
    pose = Pose(*(np.where(_over(take, x), x, y) for x, y in zip(a.pose, b.pose, strict=True)))
    return Path(pose, take | b.reached)


def _over(mask: NDArray[np.bool_], array: Array) -> NDArray[np.bool_]:
    return mask.reshape(mask.shape + (1,) * (array.ndim - 1))


def _reentered(layout: Layout, first: Pose, targets: Array, known: Path) -> Path:
    """Positions behind a gap: entered at some sample position from poses already known, then followed both ways."""
    sign = orientation(layout, first.at(None))[0]
    for _ in range(MOST_GAPS):
        missing = np.flatnonzero(~known.reached)
        sample = missing[np.unique(np.linspace(0, len(missing) - 1, min(len(missing), 12)).astype(int))]
        entries = ((int(k), _entry(layout, targets[k], known, sign)) for k in sample)
        where, entry = next(((k, e) for k, e in entries if e is not None), (0, None))
        if entry is None:
            return known
        before = known.reached.sum()
        for backward in (False, True):
            piece = march(layout, entry, targets, start=where, backward=backward)
            known = _joined(known, _filled(layout, targets, piece))
        if known.reached.all() or known.reached.sum() == before:
            break
    return known


def _entry(layout: Layout, target: Array, known: Path, sign: float) -> Pose | None:
    """A pose at one target, from the nearest of the known poses that leads there with the given orientation."""
    good = np.flatnonzero(known.reached)
    good = good[np.linspace(0, len(good) - 1, min(len(good), 24)).astype(int)]
    guess = known.pose.at(good)
    pose, missing = closed(layout, guess, np.broadcast_to(target, (len(good), len(target))).copy())
    fits = (missing <= CLOSED * layout.length) & (orientation(layout, pose) * sign >= 0)
    if not fits.any():
        return None
    return pose.at(np.flatnonzero(fits)[np.argmin(distance(layout, pose, guess)[fits])])


def orientation(layout: Layout, pose: Pose) -> Array:
    """Sign of det J: it tells the two sides of a dead centre apart. 0 where J is not square or too large to ask."""
    if layout.redundant or layout.unknowns > SPARSE or layout.stack.count != layout.unknowns:
        return np.zeros(len(pose.turn))
    sign, _ = np.linalg.slogdet(dense(layout, stacked(layout, pose)))
    return np.asarray(sign)
