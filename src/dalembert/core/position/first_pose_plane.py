"""First pose in the plane: links placed joint by joint, Newton from many starts at once, modes distinguished.

Each link's angle is given, follows from a joint that fixes it (slider, weld, driven pin), or is free. Free angles
are zero in the first start (as drawn) and spread evenly over the turn in the others, in a fixed sequence.

Mechanics: docs/theory.md 3.1."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array, Ints
from dalembert.core.constraints import dense, measure, stack_rows, system
from dalembert.core.elements.linings import BandStrands, Lining
from dalembert.core.elements.strand_family import Strand
from dalembert.core.layout import Along, Gearing, Layout, Meet, Mesh, Pose, Rows, Turn, select_rows
from dalembert.core.linear import generalized_inverse
from dalembert.core.position.assembly_modes import (
    NEAR,
    SAME,
    Wanted,
    distinct,
    enumerate_modes,
    remove_whole_turns,
    shift_from,
    sort_modes,
    wrap_angle,
)
from dalembert.core.position.assur_plan import plan
from dalembert.core.position.link_tree import (
    PointEdge,
    arms_of,
    edges_of,
    extend_tree,
    offset_of,
    place_link,
    spread_turns,
    turns,
)
from dalembert.core.position.newton import CLOSED, close_loops, distance
from dalembert.core.position.wheel_places import WheelPlaces, loose_places

STARTS = 64
FEW = 40
"""Largest number of links for which every start is used; beyond it, starts are few and links only placed."""

EXACT = 1e-7
"""Difference from the given angles, radians, up to which a pose is the given one, whatever the others are: what near a
dead centre the rounding of a length leaves of an angle."""

BESIDE = 12
"""Starts beside the given angles that detect a nearer mode."""

LOOSE = 1e-6
"""Part of a link's turn left by the constraints above which it can be held."""


@dataclass(frozen=True)
class Guess:
    """Given part of the first pose: angles (L+1,) and reference points (L+1, d), NaN where unknown."""

    turn: Array
    point: Array

    def modes(self, layout: Layout, target: Array) -> Modes | None:
        """Assembly modes of the linkage at a target (K + D,); None if no start closes."""
        return modes(layout, target, self)

    def every(self, layout: Layout, target: Array) -> Modes | None:
        """All modes of a layout without phases."""
        return _search_modes(layout, layout, target, Wanted(self.turn, self.point, None), self)

    @property
    def stated(self) -> Array:
        """The given angles (L+1,)."""
        return self.turn

    def start(self, layout: Layout, target: Array) -> Pose:
        """Links placed joint by joint (L+1, ...), before any correction."""
        return tree_pose(layout, target, self)

    def angles(self, layout: Layout, target: Array) -> Array:
        """The given angles (L+1,) and those that follow from them and the drives, NaN where none does."""
        turn = np.append(self.turn[:-1], 0.0)[None]
        spread_turns(turn, target, edges_of(layout))
        return np.asarray(turn[0])

    def near(self, pose: Pose) -> Guess:
        """The guess with what it leaves open taken from a pose (L+1, ...), and no points."""
        turn = np.where(np.isfinite(self.turn), self.turn, pose.turn)
        return Guess(turn, np.full_like(self.point, np.nan))


class Modes(NamedTuple):
    """Assembly modes at the first position: poses (M, L+1, ...), the chosen one first."""

    pose: Pose
    chosen_by: str  # "given" | "drawn" | "search" | "nearest" | "open": given angles do not decide


def modes(layout: Layout, target: Array, guess: Guess) -> Modes | None:
    """Modes at a target (K + D,), or None if no start closes.

    The phase of a mesh (or of a rolling wheel, or a brake) is that of this first pose: its row is left out here, and
    one wheel of it held at its given angle; where that does not close, wheels turn as little as possible.
    """
    result = _modes(layout, *without_phase(layout, target, guess, hold=True), guess)
    if result is None and phase_rows(layout.constraints).size:
        result = _modes(layout, *without_phase(layout, target, guess, hold=False), guess)
    return result


def _modes(layout: Layout, free: Layout, target: Array, guess: Guess) -> Modes | None:
    """Modes without phases. Newton from the given angles may pass by a nearer mode: its neighbours are sought."""
    drawn = _starting_poses(free, target, guess, np.zeros((1, layout.links + 1)), slides_ahead(layout, free))
    pose, missing = close_loops(free, drawn, target[None])
    known, closes = np.isfinite(guess.turn[:-1]).any(), missing[0] <= CLOSED * layout.length
    off = np.abs(_off(pose, guess)).max(initial=0.0)
    if closes and known and off < EXACT:
        return _also_agreeing(layout, free, target, remove_whole_turns(layout, pose), guess)
    if closes and not known and distance(layout, pose, drawn)[0] < SAME:
        return Modes(remove_whole_turns(layout, pose), "drawn")
    wanted = Wanted(guess.turn, guess.point, pose.at(0) if closes else None)
    if closes and known and off < NEAR:
        pose = remove_whole_turns(layout, pose)
        like = Guess(np.where(np.isfinite(guess.turn), guess.turn, pose.turn[0]), guess.point)
        beside = _search_modes(layout, free, target, wanted, like, BESIDE)
        result: Modes | None = _nearer(layout, pose, beside, guess)
    else:
        result = _search_modes(layout, free, target, wanted, guess)
    if result is None or not known:
        return result
    every = np.abs(_off(result.pose, guess)).max(axis=1)
    if every[0] < EXACT:
        return _agreeing(layout, result.pose.at(np.flatnonzero(every < EXACT)), guess)
    alone = every[0] < NEAR and (every[1:] > NEAR).all()
    return result._replace(chosen_by="given") if alone else result


def _agreeing(layout: Layout, pose: Pose, guess: Guess) -> Modes:
    """Modes (M, L+1, ...) that all have the given angles: the one nearest to the given places, which does not decide
    if another is as near."""
    away = shift_from(layout, pose, guess.point)
    order = np.argsort(away.round(9), kind="stable")
    alone = len(away) == 1 or away[order[0]] + SAME < away[order[1]]
    return Modes(pose.at(order), "given" if alone else "open")


def _also_agreeing(layout: Layout, free: Layout, target: Array, pose: Pose, guess: Guess) -> Modes:
    """A pose (1, L+1, ...) with exactly the given angles, and the other modes that have them too."""
    if np.isfinite(guess.angles(free, target)).all() and shift_from(layout, pose, guess.point)[0] < SAME:
        return Modes(pose, "given")
    found = _search_modes(layout, free, target, Wanted(guess.turn, guess.point, pose.at(0)), guess)
    if found is None:
        return Modes(pose, "given")
    alike = found.pose.at(np.flatnonzero(np.abs(_off(found.pose, guess)).max(axis=1) < EXACT))
    return _agreeing(
        layout, distinct(layout, Pose(*map(np.concatenate, zip(pose, alike, strict=True)))), guess
    )


def _nearer(layout: Layout, pose: Pose, found: Modes | None, guess: Guess) -> Modes:
    """A mode (1, L+1, ...) and those computed beside it, the nearest to the given angles first, or of those that are as
    near the nearest to the given places."""
    if found is None:
        return Modes(pose, "nearest")
    ahead, here = (np.linalg.norm(_off(p, guess)[0]) for p in (found.pose, pose))
    beyond, away = (shift_from(layout, p, guess.point)[0] for p in (found.pose, pose))
    if ahead < here - EXACT or (ahead < here + EXACT and beyond + SAME < away):
        return found
    return Modes(distinct(layout, Pose(*map(np.concatenate, zip(pose, found.pose, strict=True)))), "nearest")


def _off(pose: Pose, guess: Guess) -> Array:
    """Differences of the links' angles (P, ...) from the given ones, of the links that have one."""
    return np.asarray(wrap_angle(pose.turn - guess.turn)[:, :-1][:, np.isfinite(guess.turn[:-1])])


def stated_measures(layout: Layout, target: Array, guess: Guess) -> Array:
    """Measures of the drives (D,) where the links have the given angles and places; NaN where these leave the place of
    a link open, or where the linkage does not close with them."""
    none = np.full(len(layout.driven), np.nan)
    loose, constant = replace(layout, driven=np.zeros(0, np.intp)), target[: layout.constraints.count]
    free, wanted = without_phase(loose, constant, guess, hold=False)
    angles, count = guess.angles(free, wanted)[:-1], free.constraints.count
    if not np.isfinite(angles).all():
        return none
    free = replace(with_rows(free, np.arange(count), [*range(layout.links)]), driven=np.zeros(0, np.intp))
    wanted = np.concatenate([wanted[:count], angles])
    pose, missing = close_loops(free, tree_pose(free, wanted, guess).at(None), wanted[None])
    shift = np.nan_to_num(np.abs(pose.point[0] - guess.point)).max(initial=0.0)
    if missing[0] > CLOSED * layout.length or shift > CLOSED * layout.length:
        return none
    held = np.isfinite(np.column_stack([guess.point, guess.turn])[:-1]).ravel()
    scale = free.row_scale[:, None] * free.column_scale
    rows = np.concatenate([dense(free, stack_rows(free, pose))[0] * scale, np.diag(1.0 * held)[held]])
    idle = np.eye(layout.unknowns) - generalized_inverse(rows, rcond=1e-7) @ rows
    moved = dense(layout, system(layout.algebra, layout.freedoms, pose))[0][layout.driven]
    open_ = np.abs(moved * layout.column_scale @ idle).max(axis=1, initial=0.0) > LOOSE
    return np.where(open_, np.nan, measure(layout.algebra, layout.freedoms, pose)[0, layout.driven])


def tree_pose(layout: Layout, target: Array, guess: Guess) -> Pose:
    """Links placed joint by joint (L+1, ...): the first start, before any correction."""
    one = np.zeros((1, layout.links + 1))
    return _starting_poses(layout, target, guess, one, slides_ahead(layout, layout)).at(0)


def slides_ahead(layout: Layout, free: Layout) -> Array:
    """Distance along its axis at which each row of the free layout places a point (1, K): the characteristic length;
    for wheels that roll on a line, over the line's reference point."""
    rolling = [f.row[f.pitch != 0] for f in layout.constraints.families if isinstance(f, Along)]
    joints = layout.constraints.joint[np.concatenate([*rolling, np.zeros(0, np.intp)]).astype(np.intp)]
    return np.where(np.isin(free.constraints.joint, joints), 0.0, layout.length)[None]


def phase_rows(rows: Rows) -> Ints:
    """Rows whose target is their measure at the first pose: meshes, rolling, ropes, closed brakes."""
    phased = [
        f for f in rows.families if isinstance(f, Mesh | Along | Gearing | Strand | Lining | BandStrands)
    ]
    meshes = [f.row[f.pitch != 0] if isinstance(f, Along) else f.row for f in phased]
    return np.concatenate([*meshes, np.zeros(0, np.intp)]).astype(np.intp)


def without_phase(layout: Layout, target: Array, guess: Guess, hold: bool) -> tuple[Layout, Array]:
    """The layout and target without phase rows; with ``hold``, wheels held at their given angles, or at 0."""
    phased = phase_rows(layout.constraints)
    if not phased.size:
        return layout, target
    kept = np.setdiff1d(np.arange(layout.constraints.count), phased)
    target = np.concatenate([target[kept], target[layout.constraints.count :]])
    free = with_rows(layout, kept, [])
    if not hold:
        return free, target
    held = held_wheels(layout, free, target, phased, guess)
    known = np.concatenate([target[: len(kept)], np.nan_to_num(guess.turn[np.array(held, np.intp)])])
    places = held_places(
        layout, with_rows(layout, kept, held), np.concatenate([known, target[len(kept) :]]), guess
    )
    values = np.zeros(0) if places is None else places.value
    return with_rows(layout, kept, held, places), np.concatenate([known, values, target[len(kept) :]])


def held_places(layout: Layout, free: Layout, target: Array, guess: Guess) -> WheelPlaces | None:
    """The wheels on lines that are still free to shift with their angles held."""
    one = np.zeros((1, layout.links + 1))
    pose = _starting_poses(free, target, guess, one, slides_ahead(layout, free))
    return loose_places(layout, free, pose, guess.turn, guess.point)


def with_rows(layout: Layout, kept: Ints, held: list[int], places: WheelPlaces | None = None) -> Layout:
    """The layout with some of its constraints, and rows that hold the angles of some links and wheels on lines."""
    rows, count = layout.constraints, len(kept) + len(held)
    place, ground = np.arange(len(kept), count), np.full(len(held), layout.links)
    families = select_rows(rows, kept)
    if held:
        families.append(Turn(place, ground, np.array(held, np.intp)))
    angular = np.concatenate([rows.angular[kept], np.ones(len(held), bool)])
    joint = np.concatenate([rows.joint[kept], np.zeros(len(held), np.intp)])
    if places is not None:
        families.append(places.renumbered(count))
        angular, joint = np.append(angular, np.zeros(len(places.joint), bool)), np.append(joint, places.joint)
    return replace(layout, constraints=Rows(len(joint), rows.links, tuple(families), joint, angular))


def held_wheels(layout: Layout, free: Layout, target: Array, phased: Ints, guess: Guess) -> list[int]:
    """A link for each phase row that can still turn: j, else i, else any; links with given angles first."""
    one = np.zeros((1, layout.links + 1))
    pose = _starting_poses(free, target, guess, one, slides_ahead(layout, free))
    rows = stack_rows(free, pose)
    scaled = dense(free, rows)[0] * free.row_scale[:, None] * free.column_scale
    idle = np.eye(layout.unknowns) - generalized_inverse(scaled, rcond=1e-7) @ np.nan_to_num(scaled)
    turn = np.arange(layout.links) * layout.algebra.n + layout.algebra.d
    i, j = layout.constraints.ends
    held: list[int] = []
    for row in phased:
        wheels = sorted((int(j[row]), int(i[row])), key=lambda k: not np.isfinite(guess.turn[k]))
        loose = np.append(idle[turn, turn], 0.0)
        others = sorted(
            range(layout.links), key=lambda k: (not np.isfinite(guess.turn[k]), -round(float(loose[k]), 6))
        )
        chosen = next((k for k in [*wheels, *others] if loose[k] > LOOSE), None)
        if chosen is not None:
            held.append(chosen)
            column = idle[:, turn[chosen]]
            idle = idle - np.outer(column, column) / column[turn[chosen]]
    return held


def _search_modes(
    layout: Layout, free: Layout, target: Array, wanted: Wanted, guess: Guess, beside: int = 0
) -> Modes | None:
    """Every mode, in the order of ``assembly_modes``: group by group in closed form, else as many as starts find.

    With ``beside``, as many starts as that find those that may be nearer than a mode within ``NEAR``.
    """
    groups, starts = plan(free), STARTS if layout.links <= FEW else 8
    by = "nearest" if wanted.any_known else "search"
    if groups is None or not groups.closed:
        angles, slides = _spread(beside or starts, layout.links + 1, free.constraints.count)
        angles = angles * (2 * NEAR / np.pi) if beside else angles
        ahead = slides * slides_ahead(layout, free)
        poses = _closing(free, _starting_poses(free, target, guess, angles, ahead), target)
        if poses is not None:
            poses = remove_whole_turns(layout, poses)
            return Modes(distinct(layout, poses.at(sort_modes(layout, poses, wanted))), by)
    if groups is None:
        return None
    poses = _closing(free, enumerate_modes(free, groups, target, wanted).at(slice(starts)), target)
    return None if poses is None else Modes(distinct(layout, remove_whole_turns(layout, poses)), by)


def _closing(layout: Layout, start: Pose, target: Array) -> Pose | None:
    """Corrected starts (S, ...) that close; None where none does."""
    wanted = np.broadcast_to(target, (len(start.turn), len(target))).copy()
    pose, missing = close_loops(layout, start, wanted, iterations=60)
    good = np.flatnonzero(missing <= CLOSED * layout.length)
    return pose.at(good) if good.size else None


def _spread(starts: int, links: int, rows: int) -> tuple[Array, Array]:
    """Angles (S, L+1) and slide lengths (S, K) by a Kronecker sequence of irrational steps; always the same."""
    primes = np.arange(2, 2 + links + rows)
    steps = np.modf(np.sqrt(primes + 0.5) * 1.6180339887)[0]
    unit = np.modf(0.5 + np.arange(starts)[:, None] * steps)[0]
    return 2 * np.pi * unit[:, :links] - np.pi, 5 * unit[:, links:] - 2


def _starting_poses(layout: Layout, target: Array, guess: Guess, angles: Array, slides: Array) -> Pose:
    """Starting poses (S, L+1, ...): links placed joint by joint from the ground."""
    g, edges = layout.algebra, edges_of(layout)
    turn = turns(target, guess.turn, angles, edges)
    rotation = g.rotation(turn)
    point = np.full((*turn.shape, g.d), np.nan)
    point[:, -1] = 0.0
    known = np.isfinite(guess.point).all(axis=-1)
    point[:, known] = guess.point[known]
    placed = set(np.flatnonzero(known).tolist()) | {layout.links}
    arms = arms_of(layout, edges, rotation)

    def place(edge: PointEdge) -> None:
        place_link(edge, offset_of(g, edge, target, rotation, slides), point, *arms)

    while len(placed) <= layout.links:
        if extend_tree(placed, edges.pins, place) or extend_tree(placed, edges.others, place, one=True):
            continue
        lone = min(set(range(layout.links)) - placed)
        point[:, lone] = 0.0
        placed.add(lone)
    return _fit_translations(layout, target, Pose(point, turn, rotation))


def _fit_translations(layout: Layout, target: Array, pose: Pose) -> Pose:
    """Links translated, not turned, to the best fit of their points and slides: a linear problem at given angles."""
    linear = [f.row.ravel() for f in layout.stack.families if isinstance(f, Meet | Along)]
    if not linear or layout.links > FEW:
        return pose
    kept = np.sort(np.concatenate(linear))
    g = layout.algebra
    rows = stack_rows(layout, pose).rows(kept)
    j = dense(layout, rows).reshape(len(pose.turn), len(kept), layout.links, g.n)[..., : g.d]
    missing = (target - measure(g, layout.stack, pose))[:, kept]
    shift = generalized_inverse(j.reshape(len(pose.turn), len(kept), -1)) @ missing[..., None]
    point = pose.point.copy()
    point[:, :-1] += shift.reshape(len(pose.turn), layout.links, g.d)
    return pose._replace(point=point)
