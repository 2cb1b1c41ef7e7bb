"""A motion followed from its first pose: a coarse march, then all positions corrected at once.

The march goes from station to station with a predictor through the last ones, halving its step where the corrector
moves far. Where the determinant of J changes its sign smoothly the motion passed a change point, and goes on. Where
no step is small enough it has come to a dead centre, and ends. Between stations the poses are interpolated and
corrected together; a position whose correction is not small next to the spacing of the stations is not trusted.

s  parameter of the course
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dalembert.core.closure import CLOSED, closed, distance, gap, largest, moved
from dalembert.core.constraints import dense, stacked
from dalembert.core.course import Course, course
from dalembert.core.factor import SPARSE, displacement
from dalembert.core.layout import Angle, Layout, Pose, Turn
from dalembert.core.turning import settled

Array = NDArray[Any]

STRIDE = 0.43
"""Radians of a drive (or slide over characteristic length) between stations; no divisor of a quarter turn."""

NODES = 5
"""Stations in an interpolation, each with pose and rate."""

RECENT = 3
"""Stations in an extrapolation."""

CLOSE, POOR, STEPS = 0.01, 0.1, 5
"""Newton's step over the travel at which it may stop, the whole correction that is refused, most steps."""

FAR = 4 * STRIDE
"""Longest travel of a link between stations: radians, or lengths over the machine's reach."""

BLOCK = 2048
"""Positions corrected at once: enough to hide the cost of a numpy call, few enough to stay in the cache."""

TRUSTED = 0.02
"""Correction of an interpolated pose, radians or characteristic lengths, that is never suspicious."""

MOST_GAPS = 8
"""Times a motion is taken up again behind a gap."""

SHORTEST = 2.0**-14
"""Part of a stride at which the march gives up: a dead centre lies within."""


class March(NamedTuple):
    """Stations of a march: parameters (S,) ascending, their poses (S, L+1, ...), whether the course's end was met."""

    s: Array
    pose: Pose
    whole: bool


class Nodes(NamedTuple):
    """Stations with their rates: parameters (S,) ascending, poses (S, L+1, ...), twists per unit of s (S, L+1, n)."""

    s: Array
    pose: Pose
    rate: Array


def interpolated(layout: Layout, s: Array, nodes: Nodes) -> Pose:
    """Poses at s (P,) by Hermite polynomials through the ``NODES`` nearest stations; also outside them."""
    count, g = min(NODES, len(nodes.s)), layout.algebra
    first = np.clip(np.searchsorted(nodes.s, s) - count // 2, 0, len(nodes.s) - count)
    index = first[:, None] + np.arange(count)
    value, slope = _hermite(s, nodes.s[index])
    weights = np.concatenate([value, slope], axis=1)
    q, rate = g.coordinates(*nodes.pose), g.coordinate_rates(nodes.pose.rotation, nodes.rate)
    q = np.concatenate([q[index], rate[index]], axis=1)
    q = (weights[:, None] @ q.reshape((*q.shape[:2], -1))).reshape((len(s), *q.shape[2:]))
    nearest = index[np.arange(len(s)), np.abs(s[:, None] - nodes.s[index]).argmin(axis=1)]
    return settled(layout, Pose(*g.from_coordinates(q, nodes.pose.turn[nearest])))


def _hermite(s: Array, nodes: Array) -> tuple[Array, Array]:
    """Weights (P, k) of values and of slopes at nodes (P, k), for s (P,)."""
    count = nodes.shape[1]
    apart = nodes[:, :, None] - nodes[:, None, :] + np.eye(count)
    away = s[:, None] - nodes
    product = np.repeat(away[:, None, :], count, axis=1)
    product[:, np.arange(count), np.arange(count)] = 1.0
    lagrange = (product / apart).prod(axis=2)
    steep = (1 / apart).sum(axis=2) - 1.0
    square = lagrange * lagrange
    return square * (1 - 2 * steep * away), square * away


def march(layout: Layout, first: Pose, along: Course, start: float, backward: bool = False) -> March:
    """Stations from parameter ``start`` to the end of the course (or its beginning), from the pose there."""
    end, sign = (0.0, -1.0) if backward else (along.end, 1.0)
    s, poses, size, smooth, exact = [start], [first], 1.0, 0, True
    rates = [_rate(layout, along, first.at(None), start, sign)] if start != end else []
    while sign * (end - s[-1]) > 0:
        ahead = s[-1] + sign * min(size * STRIDE, abs(along.limit(s[-1], sign) - s[-1]))
        recent = slice(max(smooth, len(s) - RECENT), None)
        new = _station(layout, along, s[recent], poses[recent], rates[recent], ahead)
        if new is None:
            if not exact:  # what the corrector left of this station may be large beside a shorter step
                poses[-1] = closed(layout, poses[-1].at(None), along.target(s[-1]))[0].at(0)
                rates[-1] = _rate(layout, along, poses[-1].at(None), s[-1], sign)
                exact = True
            size /= 2
            if size < SHORTEST:
                break
            continue
        s.append(ahead)
        poses.append(new[0])
        rates.append(new[1])
        size, exact = min(2 * size, 1.0), False
        if np.abs(along.breaks - ahead).min() < 1e-12:
            smooth = len(s) - 1
            rates[-1] = _rate(layout, along, new[0].at(None), ahead, sign)
    whole = sign * (end - s[-1]) <= 0
    order = np.argsort(s)
    return March(np.array(s)[order], stack([poses[k] for k in order]), bool(whole))


def stack(poses: list[Pose]) -> Pose:
    """Single poses as one with a leading axis."""
    return Pose(*(np.stack(part) for part in zip(*poses, strict=True)))


def _rate(layout: Layout, along: Course, pose: Pose, s: float, side: float) -> Array:
    """Twists (L+1, n) of the links per unit of s at a single pose, on one side of it."""
    right = along.slope(s, side) * layout.row_scale
    with np.errstate(all="ignore"):
        rate: Array = _twist(layout, displacement(layout, stacked(layout, pose), right))[0]
    return rate


def _twist(layout: Layout, dq: Array) -> Array:
    """Displacements (..., n L) by link, ground's zeros included."""
    moving: Array = dq.reshape((*dq.shape[:-1], layout.links, layout.algebra.n))
    return np.concatenate([moving, np.zeros_like(moving[..., :1, :])], axis=-2)


def _station(
    layout: Layout, along: Course, s: list[float], poses: list[Pose], rates: list[Array], ahead: float
) -> tuple[Pose, Array] | None:
    """Pose and rate at ``ahead``, predicted from the last stations and corrected; None where that is far off.

    Newton stops when its step is small next to the travel: what it leaves is the square of that, and the whole march
    is polished later. The matrix of the last step gives the rate as well.
    """
    there, slope = along.target(ahead), along.slope(ahead, s[-1] - ahead) * layout.row_scale
    guess = pose = _predicted(layout, s, poses, rates, ahead)
    for _ in range(STEPS):
        dq = _twist(layout, _corrections(layout, pose, gap(layout, pose, there), slope))
        pose = moved(layout, pose, dq[:1, :-1])
        travel = distance(layout, pose, poses[-1].at(None))[0]
        if not distance(layout, pose, guess)[0] <= POOR * travel + 1e-6 or _is_far(
            layout, poses[-1], pose.at(0)
        ):
            return None
        if largest(layout, dq[:1])[0] <= CLOSE * travel + 1e-9:
            return settled(layout, pose).at(0), dq[1]
    return None


def _is_far(layout: Layout, before: Pose, after: Pose) -> bool:
    """Whether a link travelled too far between two poses (L+1, ...) for all branches to be told apart.

    Shifts are compared with the reach of the moving links, not with one link's length: what stands at the end of a
    long chain goes far by the chain's turns alone.
    """
    reach = max(np.ptp(before.point[:-1], axis=0).max(initial=0.0), layout.length)
    shift = np.abs(after.point - before.point).max() / reach
    turned = layout.algebra.apart(after.rotation, before.rotation, after.turn, before.turn).max()
    return bool(max(shift, turned) > FAR)


def _predicted(layout: Layout, s: list[float], poses: list[Pose], rates: list[Array], ahead: float) -> Pose:
    """Hermite polynomial through the last stations."""
    order = np.argsort(s)
    nodes = Nodes(np.array(s)[order], stack([poses[k] for k in order]), np.stack([rates[k] for k in order]))
    return interpolated(layout, np.array([ahead]), nodes)


def _corrections(layout: Layout, pose: Pose, missing: Array, slope: Array) -> Array:
    """Newton step and rate at a single pose, with one matrix."""
    both = Pose(*(np.concatenate([a, a]) for a in pose))
    with np.errstate(all="ignore"):
        return displacement(layout, stacked(layout, both), np.concatenate([missing, slope]))


class Path(NamedTuple):
    """All positions of a list: poses (P, L+1, ...), and which were reached (P,)."""

    pose: Pose
    reached: NDArray[np.bool_]


def path(layout: Layout, first: Pose, along: Course, start: float, period: Array | None = None) -> Path:
    """Poses at every position of the list, followed both ways from the pose (L+1, ...) at parameter ``start``.

    ``period`` (K + D) is what a whole cycle adds to the targets, if the list is one: then what lies behind a dead
    centre is also reached around the other way. What is still missing is looked for from the poses already known,
    on the first one's side of the dead centre (same sign of det J).
    """
    result = _both_ways(layout, first, along, start, len(along.s))
    if len(along.s) == 1 or result.reached.all():
        return result
    if period is not None and result.reached.any():
        result = _around(layout, along, period, result)
    return result if result.reached.all() else _reentered(layout, first, along, result)


def _both_ways(layout: Layout, first: Pose, along: Course, start: float, count: int) -> Path:
    """The first ``count`` positions of the list, from the pose at ``start``.

    Positions passed but not trusted, near dead centres, are marched to once more, each made a station of its own.
    """
    result, passed = _marched(layout, first, along, start, count)
    lost = passed & (along.order < count)
    lost[lost] = ~result.reached[along.order[lost]]
    if not lost.any():
        return result
    landing = replace(along, breaks=np.union1d(along.breaks, along.s[lost]))
    return _joined(result, _marched(layout, first, landing, start, count)[0])


def _marched(
    layout: Layout, first: Pose, along: Course, start: float, count: int
) -> tuple[Path, NDArray[np.bool_]]:
    """Positions reached by marching both ways, and which places of the course the marches passed."""
    ways = [False] * (start < along.end or start <= 0) + [True] * (start > 0)
    pieces = [march(layout, first, along, start, back) for back in ways]
    found = [_filled(layout, along, piece, count) for piece in pieces]
    passed = np.any([(along.s >= p.s[0]) & (along.s <= p.s[-1]) for p in pieces], axis=0)
    return (found[0] if len(found) == 1 else _joined(*found)), passed


def _around(layout: Layout, along: Course, period: Array, known: Path) -> Path:
    """Positions of the cycle before and after this one, from the first and last of the list."""
    count, listed = len(along.s), np.empty_like(along.targets)
    listed[along.order] = along.targets
    for sign, place in ((-1, 0), (1, count - 1)):
        if known.reached[place] and not known.reached.all():
            cycle = course(layout, np.concatenate([listed + sign * period, listed[place : place + 1]]))
            found = _both_ways(layout, known.pose.at(place), cycle, cycle.at(count), count)
            known = _joined(known, found._replace(pose=_counted(layout, found.pose, -sign * period)))
    return known


def _counted(layout: Layout, pose: Pose, more: Array) -> Pose:
    """The pose with its whole turns counted further by ``more`` (K + D) in the relative turns that have a target."""
    turn, known = pose.turn.copy(), {layout.links: 0.0}
    rows: list[tuple[int, int, float]] = []
    for f in layout.stack.families:
        if isinstance(f, Angle):
            turn[..., f.count] += more[f.row]
        elif isinstance(f, Turn):
            rows += zip(f.i.tolist(), f.j.tolist(), more[f.row], strict=True)
    while rows:
        i, j, add = next((row for row in rows if row[0] in known or row[1] in known), rows[0])
        rows.remove((i, j, add))
        first = known.setdefault(i, known.get(j, add) - add)
        known.setdefault(j, first + add)
    if known.keys() - {layout.links}:
        turn[..., list(known)] += list(known.values())
    return pose._replace(turn=turn)


def _filled(layout: Layout, along: Course, piece: March, count: int) -> Path:
    """The first ``count`` positions of the list, where they lie within a march, by interpolation and correction."""
    inside = (along.s >= piece.s[0] - 1e-12) & (along.s <= piece.s[-1] + 1e-12) & (along.order < count)
    nowhere = Pose(*(np.full((count, *part.shape[1:]), np.nan) for part in piece.pose))
    found = Path(nowhere, np.zeros(count, bool))
    for low, high in zip(along.breaks[:-1], along.breaks[1:], strict=True) if along.end > 0 else [(0.0, 0.0)]:
        which = np.flatnonzero((piece.s >= low - 1e-12) & (piece.s <= high + 1e-12))
        places = np.flatnonzero(inside & (along.s >= low - 1e-12) & (along.s <= high + 1e-12))
        if which.size and places.size:
            nodes = _polished(layout, along, piece.s[which], piece.pose.at(which), (low + high) / 2)
            for block in np.split(places, range(BLOCK, len(places), BLOCK)):
                _fill(layout, along, nodes, block, found)
    return found


def _polished(layout: Layout, along: Course, s: Array, pose: Pose, inside: float) -> Nodes:
    """Stations of one smooth piece corrected together, with their rates."""
    targets = np.concatenate([along.target(x) for x in s])
    pose, _ = closed(layout, pose, targets)
    slopes = np.concatenate([along.slope(x, inside - x) for x in s]) * layout.row_scale
    with np.errstate(all="ignore"):
        return Nodes(s, pose, _twist(layout, displacement(layout, stacked(layout, pose), slopes)))


def _fill(layout: Layout, along: Course, nodes: Nodes, places: NDArray[np.intp], found: Path) -> None:
    """Put corrected poses at some places of the course into the list."""
    guess = interpolated(layout, along.s[places], nodes)
    part, missing = closed(layout, guess, along.targets[places])
    near = distance(layout, part, guess) <= TRUSTED + POOR * _travel(layout, along.s[places], nodes)
    listed = along.order[places]
    for whole, new in zip(found.pose, part, strict=True):
        whole[listed] = new
    found.reached[listed] = near & (missing <= CLOSED * layout.length)


def _travel(layout: Layout, s: Array, nodes: Nodes) -> Array:
    """How far the links go between the stations on both sides of s."""
    if len(nodes.s) == 1:
        return np.zeros(len(s))
    between = distance(layout, nodes.pose.at(slice(1, None)), nodes.pose.at(slice(None, -1)))
    return np.asarray(between[np.clip(np.searchsorted(nodes.s, s) - 1, 0, len(between) - 1)])


def _joined(a: Path, b: Path) -> Path:
    """The first where it reached, else the second."""
    if a.reached.all():
        return a
    take = a.reached
    pose = Pose(*(np.where(_over(take, x), x, y) for x, y in zip(a.pose, b.pose, strict=True)))
    return Path(pose, take | b.reached)


def _over(mask: NDArray[np.bool_], array: Array) -> NDArray[np.bool_]:
    return mask.reshape(mask.shape + (1,) * (array.ndim - 1))


def _reentered(layout: Layout, first: Pose, along: Course, known: Path) -> Path:
    """Positions behind a gap: entered at some sample position from poses already known, then followed both ways."""
    sign = orientation(layout, first.at(None))[0]
    for _ in range(MOST_GAPS):
        missing = np.flatnonzero(~known.reached)
        sample = missing[np.unique(np.linspace(0, len(missing) - 1, min(len(missing), 12)).astype(int))]
        entries = ((int(k), _entry(layout, along.target(along.at(int(k)))[0], known, sign)) for k in sample)
        where, entry = next(((k, e) for k, e in entries if e is not None), (0, None))
        if entry is None:
            return known
        before = known.reached.sum()
        known = _joined(known, _both_ways(layout, entry, along, along.at(where), len(known.reached)))
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
        return np.zeros(len(pose.point))
    sign, _ = np.linalg.slogdet(dense(layout, stacked(layout, pose)))
    return np.asarray(sign)
