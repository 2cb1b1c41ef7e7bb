"""Predictor-corrector continuation of the closure equations along the course of the drives, on one branch.

After Allgower and Georg, Numerical Continuation Methods (1990): a Hermite predictor through the last stations, a Newton
corrector, and step halving where the corrector moves far or the rates at the two ends of a step do not fit the
displacement between them. Singular poses (dead centres, change points) show by the sign of det J and by its least
singular value. Where J tends to become singular ahead, branches may cross or only come close: the steps shrink towards
that pose, so that close branches are resolved, and pass straight through only where J is singular within the accuracy
of ``through_singular``. Where no step is small enough, the march has reached a dead centre and ends.

s  parameter of the course

Mechanics: docs/theory.md 3.2.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags
from dalembert.core.constraints import stack_rows
from dalembert.core.factor import displacements
from dalembert.core.layout import Idle, Layout, Pose
from dalembert.core.linear import RANK, generalized_inverse
from dalembert.core.position.newton import close_loops, displace, distance, gap, largest
from dalembert.core.position.path_parameter import PathSamples
from dalembert.core.rotation_rows import recount_turns


class StepControl(NamedTuple):
    """Limits of the continuation. Lengths are in radians of a drive, or slides over the characteristic length."""

    step: float = 0.43
    """Step between stations; not a divisor of a quarter turn, so that stations miss dead centres at round angles."""
    min_step: float = 2.0**-20
    """Fraction of ``step`` at which the continuation stops: a dead centre is within."""
    short_step: float = 1e-3
    """Fraction of ``step`` that counts as short."""
    max_short_steps: int = 500
    """Consecutive short steps allowed: a sharp turn takes about fifty."""
    predictor_stations: int = 3
    """Stations that the predictor extrapolates from."""
    max_corrections: int = 5
    """Largest number of corrector steps."""
    corrected: float = 0.01
    """Newton's step over the travel at which the corrector may stop."""
    max_correction: float = 0.1
    """Total correction over the travel above which a step is rejected."""
    max_direction_change: float = 0.15
    """Relative difference between the displacement over a step and the mean of its end rates above which the step is
    rejected: a crossing branch has another direction, however near it is."""
    max_travel: float = 4 * 0.43
    """Longest travel of a link between stations: radians, or lengths over the machine's reach."""
    towards_singular: float = 0.75
    """Fraction of the distance to a singular pose ahead that a step may cover."""
    away_from_singular: float = 3.0
    """Step over the distance from a singular pose behind."""
    through_singular: float = 1e-5
    """Distance to a singular pose from which a step passes through it: closer branches count as crossing."""
    singular_log_determinant: float = -25.0
    """Logarithm of the determinant between two stations below which J is singular at both: its sign is meaningless."""
    interpolation_stations: int = 5
    """Stations in an interpolation, each with pose and rate."""
    crowded: float = 0.3
    """Stations nearer to each other than this fraction of an interval end the reach of its interpolation."""


STEP = StepControl()


class March(NamedTuple):
    """Stations of a march: parameters (S,) ascending, their poses (S, L+1, ...), whether the course's end was met."""

    s: Array
    pose: Pose
    complete: bool


class Nodes(NamedTuple):
    """Stations with their rates: parameters (S,) ascending, poses (S, L+1, ...), twists per unit of s (S, L+1, n)."""

    s: Array
    pose: Pose
    rate: Array


class Station(NamedTuple):
    """One pose (L+1, ...) of a march and the links' twists (L+1, n) per unit of s.

    ``clear`` measures the distance from a singular pose, like the smallest singular value of J; its sign changes where
    the march passes through one. ``side`` changes its sign where J (``matrix``) became singular since the previous
    station: it is the sign of det J, or of det(J+ J) with the pseudo-inverse of the previous station where J is not
    square; 0 where J is too large to factor.
    """

    s: float
    pose: Pose
    rate: Array
    clear: float
    matrix: Array | None
    side: float


def interpolate(layout: Layout, s: Array, nodes: Nodes) -> Pose:
    """Poses at s (P,) by Hermite polynomials through up to ``STEP.interpolation_stations`` stations around each."""
    interval = np.clip(np.searchsorted(nodes.s, s) - 1, 0, max(len(nodes.s) - 2, 0))
    around = [_around(nodes.s, k) for k in range(max(len(nodes.s) - 1, 1))]
    counts = np.array([len(index) for index in around])[interval]
    parts = []
    for count in np.unique(counts):
        which = np.flatnonzero(counts == count)
        index = np.array([around[k] for k in interval[which]])
        if which.size == s.size:
            return _through(layout, s, nodes, index)
        parts.append((which, _through(layout, s[which], nodes, index)))
    order = np.argsort(np.concatenate([which for which, _ in parts]))
    return Pose(*(np.concatenate(part)[order] for part in zip(*(pose for _, pose in parts), strict=True)))


def _around(s: Array, k: int) -> list[int]:
    """Stations around the interval from s[k] to s[k + 1], the nearest first, to where they crowd.

    They crowd where the motion bends sharply: a polynomial across such a place is inaccurate.
    """
    if len(s) == 1:
        return [0]
    low, high, spaced = k, k + 1, STEP.crowded * (s[k + 1] - s[k])
    while high - low + 1 < STEP.interpolation_stations:
        down = s[low] - s[low - 1] if low > 0 else 0.0
        up = s[high + 1] - s[high] if high + 1 < len(s) else 0.0
        if max(down, up) < max(spaced, 1e-300):
            break
        below = up < spaced or (down >= spaced and s[k] - s[low] + down <= s[high] - s[k + 1] + up)
        low, high = (low - 1, high) if below else (low, high + 1)
    return list(range(low, high + 1))


def _through(layout: Layout, s: Array, nodes: Nodes, index: Array) -> Pose:
    """Hermite polynomials at s (P,) through the stations index (P, k)."""
    g = layout.algebra
    value, slope = _hermite(s, nodes.s[index])
    weights = np.concatenate([value, slope], axis=1)
    q, rate = g.coordinates(*nodes.pose), g.coordinate_rates(nodes.pose.rotation, nodes.rate)
    q = np.concatenate([q[index], rate[index]], axis=1)
    q = (weights[:, None] @ q.reshape((*q.shape[:2], -1))).reshape((len(s), *q.shape[2:]))
    nearest = index[np.arange(len(s)), np.abs(s[:, None] - nodes.s[index]).argmin(axis=1)]
    return recount_turns(layout, Pose(*g.from_coordinates(q, nodes.pose.turn[nearest])))


def _hermite(s: Array, nodes: Array) -> tuple[Array, Array]:
    """Weights (P, k) of values and of slopes at nodes (P, k), for s (P,)."""
    count = nodes.shape[1]
    differences = nodes[:, :, None] - nodes[:, None, :] + np.eye(count)
    away = s[:, None] - nodes
    product = np.repeat(away[:, None, :], count, axis=1)
    product[:, np.arange(count), np.arange(count)] = 1.0
    lagrange = (product / differences).prod(axis=2)
    steep = (1 / differences).sum(axis=2) - 1.0
    square = lagrange * lagrange
    return square * (1 - 2 * steep * away), square * away


def march(layout: Layout, first: Pose, along: PathSamples, start: float, backward: bool = False) -> March:
    """Stations from parameter ``start`` to the end of the course (or its beginning), starting from the given pose."""
    end, sign = (0.0, -1.0) if backward else (along.end, 1.0)
    if start == end:
        return March(np.array([start]), stack([first]), True)
    at = _setting(layout, along)
    stations, size, smooth, exact, short = [_standing(at, start, first, sign)], 1.0, 0, True, 0
    while sign * (end - stations[-1].s) > 0 and short < STEP.max_short_steps:
        last, recent = stations[-1], stations[max(smooth, len(stations) - STEP.predictor_stations) :]
        ahead = abs(along.limit(last.s, sign) - last.s)
        step = min(size * STEP.step, _safe(recent), ahead)
        new = _station(at, recent, last.s + sign * step)
        if new is None:
            if not exact:  # the corrector's error at this station may be large next to a shorter step
                stations[-1] = _exact(at, last, sign)
                exact = True
            size = step / STEP.step / 2
            if size < STEP.min_step:
                break
            continue
        stations.append(new)
        short = short + 1 if step < min(STEP.short_step * STEP.step, ahead) else 0
        size, exact = min(2 * max(size, step / STEP.step), 1.0), False
        if np.abs(along.breaks - new.s).min() < 1e-12:
            smooth = len(stations) - 1
            stations[-1] = new._replace(rate=_standing(at, new.s, new.pose, sign).rate)
    complete = sign * (end - stations[-1].s) <= 0
    stations.sort(key=lambda station: station.s)
    return March(np.array([f.s for f in stations]), stack([f.pose for f in stations]), bool(complete))


def _safe(recent: list[Station]) -> float:
    """The longest step that stays clear of a singular pose ahead, or keeps its distance to one behind."""
    if len(recent) < 2:
        return np.inf
    before, last = recent[-2:]
    step, was, now = abs(last.s - before.s), before.clear, last.clear
    if np.sign(was) * np.sign(now) <= 0 or abs(now) > abs(was):
        since = step * abs(now) / max(abs(now - was), 1e-300)
        return max(STEP.away_from_singular * since, STEP.through_singular)
    if abs(was) == abs(now):
        return np.inf
    left = step * now / (was - now)
    return STEP.towards_singular * left if left > STEP.through_singular else left + STEP.through_singular


def stack(poses: list[Pose]) -> Pose:
    """Single poses as one with a leading axis."""
    return Pose(*(np.stack(part) for part in zip(*poses, strict=True)))


class _Setting(NamedTuple):
    """Data of a march: ``probes`` (2, K + D), arbitrary right-hand sides of unit size, whose solutions grow where J
    becomes singular, and ``turned`` (L+1,), the links whose rotation follows from their twists.
    """

    layout: Layout
    along: PathSamples
    probes: Array
    turned: Flags


def _setting(layout: Layout, along: PathSamples) -> _Setting:
    count = np.arange(len(layout.row_scale))
    probes = np.stack([np.cos(1.0 + 2.7 * count), np.cos(2.0 + 1.9 * count)]) * layout.length
    turned = np.ones(layout.links + 1, bool)
    for family in layout.constraints.families:
        if isinstance(family, Idle):  # such a link is as drawn: its spin is independent of its rate
            turned[family.j] = False
    return _Setting(layout, along, probes, turned)


def _standing(at: _Setting, s: float, pose: Pose, sign: float, before: Station | None = None) -> Station:
    """A station at a known pose, with its rate on one side of s."""
    (rate,), clear, matrix = _rates(at, pose.at(None), at.along.slope(s, sign) * at.layout.row_scale)
    return Station(s, pose, rate, clear, matrix, _side(at.layout, matrix, before))


def _exact(at: _Setting, old: Station, sign: float) -> Station:
    """The same station corrected to rounding; the sign of ``clear`` stays."""
    pose = close_loops(at.layout, old.pose.at(None), at.along.target(old.s))[0].at(0)
    new = _standing(at, old.s, pose, sign, old)
    return new._replace(clear=np.copysign(new.clear, old.clear))


def _rates(at: _Setting, pose: Pose, right: Array) -> tuple[Array, float, Array | None]:
    """Solutions (R, L+1, n) of J dq = right (R, K + D) at a single pose, how clear of singular J is, J itself."""
    with np.errstate(all="ignore"):
        rows = stack_rows(at.layout, pose)
        every, matrix = displacements(at.layout, rows, np.concatenate([right, at.probes]))
    solution = twists(at.layout, every)
    clear = 1 / max(largest(at.layout, solution[-2:, :-1]).max(), 1e-300)
    return solution[:-2], float(clear), matrix


def _side(layout: Layout, matrix: Array | None, before: Station | None) -> float:
    """The ``side`` of a station with this J, behind the one before it."""
    if matrix is None or not np.isfinite(matrix).all():
        return 0.0
    if layout.square:
        return float(np.linalg.slogdet(matrix)[0])
    if before is None or before.matrix is None:
        return 1.0
    scale = layout.column_scale
    back = generalized_inverse(before.matrix * scale, RANK)
    sign, size = np.linalg.slogdet(back @ (matrix * scale))
    return float(sign) * before.side if size > STEP.singular_log_determinant else 0.0


def twists(layout: Layout, dq: Array) -> Array:
    """Displacements (..., n L) by link, ground's zeros included."""
    moving: Array = dq.reshape((*dq.shape[:-1], layout.links, layout.algebra.n))
    return np.concatenate([moving, np.zeros_like(moving[..., :1, :])], axis=-2)


def _station(at: _Setting, recent: list[Station], ahead: float) -> Station | None:
    """The station at ``ahead``, predicted from the last ones and corrected; None where that is not reliable.

    Newton stops when its step is small next to the travel: its error is the square of that, and all stations are
    polished later. The matrix of the last step gives the rate as well.
    """
    layout, along, last = at.layout, at.along, recent[-1]
    target, slope = along.target(ahead), along.slope(ahead, last.s - ahead) * layout.row_scale
    guess = pose = _predict(layout, recent, ahead)
    for _ in range(STEP.max_corrections):
        (dq, rate), clear, matrix = _rates(at, pose, np.concatenate([gap(layout, pose, target), slope]))
        pose = displace(layout, pose, dq[None, :-1])
        travel = distance(layout, pose, last.pose.at(None))[0]
        if not distance(layout, pose, guess)[0] <= STEP.max_correction * travel + 1e-9 or _is_far(
            layout, last.pose, pose.at(0)
        ):
            return None
        if largest(layout, dq[None])[0] <= STEP.corrected * min(travel, clear) + 1e-12:
            pose = recount_turns(layout, pose)
            if (
                not layout.square
                and np.abs(gap(layout, pose, target)).max() > STEP.corrected * travel * layout.length
            ):
                return None  # more constraints than unknowns, and no pose satisfies them all
            side = _side(layout, matrix, last)
            return _next_station(at, recent, Station(ahead, pose.at(0), rate, clear, matrix, side))
    return None


def _next_station(at: _Setting, recent: list[Station], new: Station) -> Station | None:
    """The new station as the next one of the march; None where it seems to belong to another branch."""
    last, step = recent[-1], abs(new.s - recent[-1].s)
    changed = last.side * new.side < 0
    if (changed and step > 4 * STEP.through_singular) or _bend(at, last, new) > STEP.max_direction_change:
        return None
    through = changed or (len(recent) > 1 and _passes(recent[-2:], step))
    return new._replace(clear=np.copysign(new.clear, -last.clear if through else last.clear))


def _passes(recent: list[Station], step: float) -> bool:
    """True if a step passes through a singular pose, as ``_safe`` predicts it."""
    (before, last), length = recent, abs(recent[1].s - recent[0].s)
    change = (before.clear - last.clear) * np.sign(last.clear)
    return bool(step * change > length * abs(last.clear))


def _bend(at: _Setting, a: Station, b: Station) -> float:
    """Difference of the displacement between two stations from the mean of their rates, over the larger rate."""
    g, step = at.layout.algebra, b.s - a.s
    displacement = g.coordinates(*b.pose) - g.coordinates(*a.pose)
    first = step * g.coordinate_rates(a.pose.rotation, a.rate)
    second = step * g.coordinate_rates(b.pose.rotation, b.rate)
    all_ = np.abs(np.stack([displacement - (first + second) / 2, first, second]))
    shift, turn = all_[..., : g.d].max(axis=(1, 2)) / at.layout.length, all_[..., g.d :][:, at.turned]
    off, *rates = np.maximum(shift, turn.max(axis=(1, 2), initial=0.0))
    return float(off / max(*rates, 1e-300))


def _is_far(layout: Layout, before: Pose, after: Pose) -> bool:
    """True if a link travelled too far between two poses (L+1, ...) to distinguish all branches.

    Shifts are compared with the reach of the moving links, not with one link's length: the end of a long chain travels
    far by the turns of the chain alone.
    """
    reach = max(np.ptp(before.point[:-1], axis=0).max(initial=0.0), layout.length)
    shift = np.abs(after.point - before.point).max() / reach
    turned = layout.algebra.angle_between(after.rotation, before.rotation, after.turn, before.turn).max()
    return bool(max(shift, turned) > STEP.max_travel)


def _predict(layout: Layout, recent: list[Station], ahead: float) -> Pose:
    """Hermite polynomial through the last stations."""
    order = sorted(recent, key=lambda station: station.s)
    s, poses, rates, *_ = zip(*order, strict=True)
    nodes = Nodes(np.array(s), stack(list(poses)), np.stack(rates))
    return _through(layout, np.array([ahead]), nodes, np.arange(len(s))[None])
