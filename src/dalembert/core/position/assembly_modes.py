"""Assembly modes of a planar linkage: enumerated, distinguished and ordered by preference.

Modes with every group on the side that the given angles imply come first, then the nearest to the given angles. Without
given angles, modes with sliders farthest along their directions come first, then those with the highest links.

Mechanics: docs/theory.md 3.1.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.core.constraints import measure
from dalembert.core.layout import Layout, Meet, Pose, Turn
from dalembert.core.position.assur_plan import PlacementPlan
from dalembert.core.position.dyads import Laid, offsets, place_ground, place_group, sides

MOST = 64
"""Modes that are kept while links are placed: all modes of six groups, the first in order of more groups."""

NEAR = 0.35
"""Largest error of given angles, radians. Where two modes are within this distance, both are near a dead centre, and
the nearer one is meant."""

TRIALS = 16
"""Number of perturbations of the given angles that must all imply the same side."""

SAME = 1e-4
"""Distance between poses, radians or characteristic lengths, below which they are the same mode."""


class Wanted(NamedTuple):
    """Given part of the pose: angles (L+1,) and places (L+1, 2), NaN where unknown; the pose that Newton computes from
    them, which settles the rest, None where Newton fails."""

    turn: Array
    point: Array
    start: Pose | None

    @property
    def any_known(self) -> bool:
        """True if any angle is given."""
        return bool(np.isfinite(self.turn[:-1]).any())


def enumerate_modes(layout: Layout, plan: PlacementPlan, target: Array, wanted: Wanted) -> Pose:
    """Modes (M, L+1, ...) in which a linkage closes at a target (K + D,), group by group, in order of preference."""
    with np.errstate(all="ignore"):
        return _enumerate_modes(layout, plan, target, wanted)


def _enumerate_modes(layout: Layout, plan: PlacementPlan, target: Array, wanted: Wanted) -> Pose:
    stated = stated_sides(layout, plan, target, wanted)
    placed, off = place_ground(plan, target[None]), offsets(plan, target[None])
    for group in plan.groups:
        placed = place_group(
            group, placed, *(np.repeat(a, len(placed.turn), axis=0) for a in (target[None], off))
        )[1]
        for links in group.turning:
            _wind(placed.turn, group.links[links], wanted.turn)
        if len(placed.turn) > MOST:
            placed = placed.at(_order(layout, placed, stated, wanted)[:MOST])
    order = _order(layout, placed, stated, wanted)
    return to_pose(layout, placed.at(order))


def on_sides(
    layout: Layout, plan: PlacementPlan, targets: Array, like: Pose, turn: Array
) -> tuple[Ints, Pose]:
    """Indices of the targets (P, K + D) at which a linkage closes with every group on its side of a pose (L+1, ...),
    and the poses.

    ``turn`` (L+1,) are given angles, NaN where unknown. Where a group has several modes on that side, none is used.
    """
    with np.errstate(all="ignore"):
        here = np.full((1, targets.shape[1]), np.nan)
        side = sides(plan, like.turn[None], like.point[None], here)[0]
        off, placed, places = offsets(plan, targets), place_ground(plan, targets), np.arange(len(targets))
        for k, group in enumerate(plan.groups):
            which, placed = place_group(group, placed, targets[places], off[places])
            same = placed.side[:, k] * side[k] >= 0
            once = same & (np.bincount(which[same], minlength=len(places))[which] == 1)
            placed, places = placed.at(once), places[which[once]]
            for links in group.turning:
                _wind(placed.turn, group.links[links], turn)
        return places, to_pose(layout, placed)


def closing(plan: PlacementPlan, targets: Array) -> Ints:
    """Indices of the targets (P, K + D) at which a linkage closes in any mode, ascending."""
    with np.errstate(all="ignore"):
        off, placed, places = offsets(plan, targets), place_ground(plan, targets), np.arange(len(targets))
        for group in plan.groups:
            which, placed = place_group(group, placed, targets[places], off[places])
            places = places[which]
        return np.unique(places)


def to_pose(layout: Layout, placed: Laid) -> Pose:
    """Placed links as a pose."""
    return Pose(placed.point, placed.turn, layout.algebra.rotation(placed.turn))


def _wind(turn: Array, links: Ints, angle: Array) -> None:
    """Whole turns of links that turn together: nearest to the given angle of one of them, else the fewest."""
    known = links[np.isfinite(angle[links])]
    head = known[0] if known.size else links[0]
    wanted = angle[head] if known.size else 0.0
    turn[:, links] -= 2 * np.pi * np.ceil((turn[:, [head]] - wanted) / (2 * np.pi) - 0.5)


def stated_sides(layout: Layout, plan: PlacementPlan, target: Array, wanted: Wanted) -> Array:
    """The side (G,) of each group that the given angles imply even if each is wrong by ``NEAR``; 0 where they imply
    none. The drives' positions are not used: the angles may have been measured at others.
    """
    if not wanted.any_known:
        return np.zeros(len(plan.groups))
    target = target.copy()
    target[layout.constraints.count :] = np.nan
    off = NEAR * np.sign(np.sin(np.arange(TRIALS)[:, None] * (1 + np.arange(len(wanted.turn)) ** 2)))
    turn = wanted.turn + off
    turn[:, -1] = 0.0
    held = [entry for entry in plan.turns if entry[3] < layout.constraints.count]
    for _ in range(len(held)):
        for new, known, sign, row in held:
            if np.isnan(turn[0, new]):
                turn[:, new] = turn[:, known] + sign * target[row]
            elif np.isnan(turn[0, known]):
                turn[:, known] = turn[:, new] - sign * target[row]
    every = np.ones((TRIALS, 1))
    side = sides(plan, turn, every[:, None] * wanted.point, every * target)
    return np.where((side == side[0]).all(axis=0), side[0], 0.0)


def _order(layout: Layout, placed: Laid, stated: Array, wanted: Wanted) -> Ints:
    """Order of preference of modes, some of them only partly placed."""
    wrong = (placed.side * stated[: placed.side.shape[1]] < 0).sum(axis=1)
    off = np.sqrt(np.nansum(wrap_angle(placed.turn - wanted.turn)[:, :-1] ** 2, axis=1))
    keys = [wrong, off, shift_from(layout, placed, wanted.point)]
    if wanted.start is not None:
        away = np.nansum(wrap_angle(placed.turn - wanted.start.turn) ** 2, axis=1)
        keys.append(
            away
            + np.nansum((placed.point - wanted.start.point) ** 2, axis=(1, 2)) / layout.length / layout.length
        )
    if wanted.any_known:
        order = np.lexsort([key.round(9) for key in reversed(keys)])
        if np.any([np.diff(key[order].round(9)) for key in keys], axis=0).all():
            return order  # all different: the sliders' positions do not decide
    along, height = measures(layout, to_pose(layout, placed))
    keys[len(keys) if wanted.any_known else 3 : 0] = [-along, -height]
    return np.lexsort([key.round(9) for key in reversed(keys)])


def shift_from(layout: Layout, placed: Pose | Laid, point: Array) -> Array:
    """Distance of poses (M, L+1, ...) from given places (L+1, 2), NaN where unknown, in characteristic lengths."""
    return np.asarray(np.sqrt(np.nansum((placed.point - point)[:, :-1] ** 2, axis=(1, 2))) / layout.length)


def wrap_angle(angle: Array) -> Array:
    """Angles reduced to (-pi, pi]."""
    return np.asarray(angle - 2 * np.pi * np.ceil(angle / (2 * np.pi) - 0.5))


def remove_whole_turns(layout: Layout, pose: Pose) -> Pose:
    """Angles without whole turns, for links whose turns no row of the system counts."""
    turn = pose.turn.copy()
    free = np.flatnonzero(~counted_links(layout))
    turn[..., free] = wrap_angle(turn[..., free])
    return Pose(pose.point, turn, pose.rotation)


def counted_links(layout: Layout) -> Flags:
    """True for links (L,) whose whole turns some row of the system counts."""
    counted = np.zeros(layout.links + 1, bool)
    for f in layout.stack.families:
        if isinstance(f, Turn):
            counted[f.i] = counted[f.j] = True
    return counted[:-1]


def distinct(layout: Layout, pose: Pose) -> Pose:
    """Poses without repetitions: the first of each mode."""
    kept: list[int] = []
    for k in range(len(pose.turn)):
        others = np.array(kept, np.intp)
        shift = np.abs(pose.point[others] - pose.point[k]).max(axis=(1, 2), initial=0.0) / layout.length
        turn = np.abs(wrap_angle(pose.turn[others] - pose.turn[k])).max(axis=1, initial=0.0)
        if (np.maximum(shift, turn) > SAME).all():
            kept.append(k)
    return pose.at(np.array(kept, np.intp))


def sort_modes(layout: Layout, pose: Pose, wanted: Wanted) -> Ints:
    """Order of modes whose groups are unknown: by distance from given angles, then places, else by preference."""
    if wanted.any_known:
        off = np.sqrt(np.nansum(wrap_angle(pose.turn - wanted.turn)[:, :-1] ** 2, axis=1))
        return np.lexsort((shift_from(layout, pose, wanted.point).round(9), off.round(9)))
    along, height = measures(layout, pose)
    return np.lexsort((-height, -along))


def measures(layout: Layout, pose: Pose) -> tuple[Array, Array]:
    """Positions of sliders along their directions, and heights of the links, of the placed ones (M,)."""
    slides = np.setdiff1d(np.flatnonzero(~layout.freedoms.angular), layout.driven)
    along = np.nansum(measure(layout.algebra, layout.freedoms, pose)[:, slides], axis=1)
    height = np.nansum(pose.point[:, :-1, 1], axis=1)
    for f in layout.constraints.families:
        if isinstance(f, Meet):  # the links' far ends
            arm = layout.algebra.rotate(pose.rotation[:, f.j], f.uj)
            height = height + np.nansum(pose.point[:, f.j, 1] + arm[..., 1], axis=1)
    return np.round(along / layout.length, 6), np.round(height / layout.length, 6)
