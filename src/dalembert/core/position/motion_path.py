"""A motion followed from its first pose: marched from station to station, then all positions corrected at once.

Between stations the poses are interpolated and corrected together; a position whose correction is not small next to the
spacing of the stations is rejected.

s  parameter of the course

Mechanics: docs/theory.md 3.2.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.core.constraints import stack_rows
from dalembert.core.factor import displacement
from dalembert.core.layout import Angle, Layout, Mesh, Pose, Turn
from dalembert.core.position.continuation import STEP, March, Nodes, interpolate, march, twists
from dalembert.core.position.newton import CLOSED, close_loops, distance
from dalembert.core.position.path_parameter import PathSamples, course
from dalembert.core.position.range_entries import Ways, entries

BLOCK = 2048
"""Positions corrected at once: enough to hide the cost of a numpy call, few enough to stay in the cache."""

TRUSTED = 1e-6
"""Correction of an interpolated pose, radians or characteristic lengths, that is always accepted."""

SAME = 1e-6
"""Distance over characteristic length, or change of a rotation, below which two poses are the same."""


class Path(NamedTuple):
    """All positions of a list: poses (P, L+1, ...), which were reached (P,), and by which stretch (P,) of the motion.

    From position to position of a stretch the motion is continuous; between two of them lies a gap. ``entered`` are the
    positions at which stretches begin that the motion from the first pose does not reach.
    """

    pose: Pose
    reached: Flags
    stretch: Ints
    entered: tuple[int, ...] = ()


def path(
    layout: Layout,
    first: Pose,
    along: PathSamples,
    start: float,
    period: Array | None = None,
    search: Ways | None = None,
) -> Path:
    """Poses at every position of the list, followed in both directions from the pose (L+1, ...) at parameter ``start``.

    ``period`` (K + D) is the increment of the targets over a full cycle, if the list is one: positions behind a dead
    centre are then also approached from the other direction. Positions still missing are sought from the known poses,
    on the first pose's side of every group's dead centres (``core.position.assur_groups``).
    """
    result = _both_directions(layout, first, along, start, len(along.s))
    if result.reached.all():
        return result
    if period is not None and result.reached.any():
        result = _around(layout, along, period, result)
    known = result.reached
    return (
        result if known.all() or not known.any() else _enter_behind_gap(layout, first, along, result, search)
    )


def _both_directions(layout: Layout, first: Pose, along: PathSamples, start: float, count: int) -> Path:
    """The first ``count`` positions of the list, from the pose at ``start``.

    Positions passed near dead centres, where interpolation is not reliable, are marched to again, each as a station.
    """
    result, passed = _march_both_directions(layout, first, along, start, count)
    lost = passed & (along.order < count)
    lost[lost] = ~result.reached[along.order[lost]]
    if not lost.any():
        return result
    landing = replace(along, breaks=np.union1d(along.breaks, along.s[lost]))
    return _first_reached(result, _march_both_directions(layout, first, landing, start, count)[0])


def _march_both_directions(
    layout: Layout, first: Pose, along: PathSamples, start: float, count: int
) -> tuple[Path, Flags]:
    """Positions reached by marching in both directions, and a flag for each place of the course that the marches
    passed."""
    directions = [False] * (start < along.end or start <= 0) + [True] * (start > 0)
    pieces = [march(layout, first, along, start, back) for back in directions]
    paths = [_interpolate_list(layout, along, piece, count) for piece in pieces]
    passed = np.any([(along.s >= p.s[0]) & (along.s <= p.s[-1]) for p in pieces], axis=0)
    return (paths[0] if len(paths) == 1 else _first_reached(*paths)), passed


def _around(layout: Layout, along: PathSamples, period: Array, known: Path) -> Path:
    """Positions of the cycle before and after this one, from the first and last of the list where the motion has
    reached them: the motion continues from them into the known part."""
    count, listed, followed = len(along.s), np.empty_like(along.targets), known.reached
    listed[along.order] = along.targets
    for sign, place in ((-1, 0), (1, count - 1)):
        if followed[place] and not known.reached.all():
            cycle = course(layout, np.concatenate([listed + sign * period, listed[place : place + 1]]))
            more = _both_directions(layout, known.pose.at(place), cycle, cycle.at(count), count)
            known = _first_reached(known, _separate(_same(layout, more, listed, -sign * period), known))
    return known


def _same(layout: Layout, away: Path, targets: Array, more: Array) -> Path:
    """Poses reached one cycle away, as poses of this cycle; without those whose wheels have another phase."""
    places = np.flatnonzero(away.reached)
    counted = _add_turns(layout, away.pose.at(places), more)
    pose, missing = close_loops(layout, Pose(*(part.copy() for part in counted)), targets[places])
    off = [np.abs(a - b).max(axis=(-2, -1)) for a, b in zip(pose[::2], counted[::2], strict=True)]
    same = (missing <= CLOSED * layout.length) & (off[0] <= SAME * layout.length) & (off[1] <= SAME)
    reached = away.reached.copy()
    reached[places] = same
    for target, part in zip(away.pose, pose, strict=True):
        target[places] = part
    return away._replace(reached=reached)


def _add_turns(layout: Layout, pose: Pose, more: Array) -> Pose:
    """The pose with ``more`` (K + D) added to the whole turns of the relative turns that have a target.

    Wheels in mesh with such a link are turned back by the ratio of their radii, where that gives whole turns.
    """
    turn, known = pose.turn.copy(), {layout.links: 0.0}
    rows: list[tuple[int, int, float]] = []
    meshes: list[tuple[int, int, float]] = []
    for f in layout.stack.families:
        if isinstance(f, Angle):
            turn[..., f.count] += more[f.row]
        elif isinstance(f, Turn):
            rows += zip(f.i.tolist(), f.j.tolist(), more[f.row], strict=True)
        elif isinstance(f, Mesh):
            meshes += zip(f.i.tolist(), f.j.tolist(), f.ri / f.rj, strict=True)
            meshes += zip(f.j.tolist(), f.i.tolist(), f.rj / f.ri, strict=True)
    while rows:
        i, j, add = next((row for row in rows if row[0] in known or row[1] in known), rows[0])
        rows.remove((i, j, add))
        first = known.setdefault(i, known.get(j, add) - add)
        known.setdefault(j, first + add)
    for _ in meshes:
        for i, j, ratio in meshes:
            back = -ratio * known.get(i, 0.0) / (2 * np.pi)
            if i in known and j not in known and abs(back - round(back)) < SAME:
                known[j] = 2 * np.pi * round(back)
    if known.keys() - {layout.links}:
        turn[..., list(known)] += list(known.values())
    return pose._replace(turn=turn)


def _interpolate_list(layout: Layout, along: PathSamples, piece: March, count: int) -> Path:
    """The first ``count`` positions of the list, where they lie within a march, by interpolation and correction."""
    inside = (along.s >= piece.s[0] - 1e-12) & (along.s <= piece.s[-1] + 1e-12) & (along.order < count)
    nowhere = Pose(*(np.full((count, *part.shape[1:]), np.nan) for part in piece.pose))
    result = Path(nowhere, np.zeros(count, bool), np.zeros(count, np.intp))
    for low, high in zip(along.breaks[:-1], along.breaks[1:], strict=True) if along.end > 0 else [(0.0, 0.0)]:
        which = np.flatnonzero((piece.s >= low - 1e-12) & (piece.s <= high + 1e-12))
        places = np.flatnonzero(inside & (along.s >= low - 1e-12) & (along.s <= high + 1e-12))
        if which.size and places.size:
            nodes = _correct_stations(layout, along, piece.s[which], piece.pose.at(which), (low + high) / 2)
            for block in np.split(places, range(BLOCK, len(places), BLOCK)):
                _fill(layout, along, nodes, block, result)
    return result


def _correct_stations(layout: Layout, along: PathSamples, s: Array, pose: Pose, inside: float) -> Nodes:
    """Stations of one smooth piece corrected together, with their rates."""
    targets = np.concatenate([along.target(x) for x in s])
    pose, _ = close_loops(layout, pose, targets)
    slopes = np.concatenate([along.slope(x, inside - x) for x in s]) * layout.row_scale
    rates = np.zeros((len(s), layout.unknowns))
    if slopes.any():
        with np.errstate(all="ignore"):
            rates = displacement(layout, stack_rows(layout, pose), slopes)
    return Nodes(s, pose, twists(layout, rates))


def _fill(layout: Layout, along: PathSamples, nodes: Nodes, places: Ints, into: Path) -> None:
    """Puts corrected poses at some places of the course into the list."""
    guess = interpolate(layout, along.s[places], nodes)
    part, missing = close_loops(layout, guess, along.targets[places])
    near = distance(layout, part, guess) <= TRUSTED + STEP.max_correction * _travel(
        layout, along.s[places], nodes
    )
    listed = along.order[places]
    for array, new in zip(into.pose, part, strict=True):
        array[listed] = new
    into.reached[listed] = near & (missing <= CLOSED * layout.length)


def _travel(layout: Layout, s: Array, nodes: Nodes) -> Array:
    """Travel of the links between the stations on both sides of s."""
    if len(nodes.s) == 1:
        return np.zeros(len(s))
    between = distance(layout, nodes.pose.at(slice(1, None)), nodes.pose.at(slice(None, -1)))
    return np.asarray(between[np.clip(np.searchsorted(nodes.s, s) - 1, 0, len(between) - 1)])


def _first_reached(a: Path, b: Path) -> Path:
    """The first path's pose where it reached the position, else the second's."""
    if a.reached.all():
        return a
    take = a.reached
    pose = Pose(*(np.where(_over(take, x), x, y) for x, y in zip(a.pose, b.pose, strict=True)))
    return Path(pose, take | b.reached, np.where(take, a.stretch, b.stretch))


def _separate(new: Path, known: Path) -> Path:
    """The path as a separate stretch."""
    return new._replace(stretch=np.full_like(new.stretch, known.stretch.max() + 1))


def _over(mask: Flags, array: Array) -> Flags:
    return mask.reshape(mask.shape + (1,) * (array.ndim - 1))


def _enter_behind_gap(
    layout: Layout, first: Pose, along: PathSamples, known: Path, search: Ways | None
) -> Path:
    """Positions behind a gap: entered at some of them, on the first pose's side of every group, then followed in both
    directions.

    Where no signs distinguish the branches, positions behind a gap count as not reached.
    """
    entered: list[int] = []

    def now() -> tuple[Pose, Flags]:
        return known.pose, known.reached

    for place, entry in entries(layout, first, along, now, search):
        if known.reached[place]:
            continue
        more = _both_directions(layout, entry, along, along.at(place), len(known.reached))
        if (more.reached & ~known.reached).any():
            entered.append(place)
        known = _first_reached(known, _separate(more, known))
        if known.reached.all():
            break
    return known._replace(entered=tuple(entered))
