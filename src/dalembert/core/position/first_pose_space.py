"""The first pose in space: as drawn and continued, or near the given poses, or from many starts at once.

As drawn, every link's axes are parallel to the ground's, its points are placed joint by joint, and the drives are at 0.
The motion continues from this pose to the first position. Where that fails, links are placed with random values of
their joint coordinates, from a fixed seed.

Mechanics: docs/theory.md 3.1.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from dalembert.algebra import space
from dalembert.algebra.protocol import Algebra
from dalembert.arrays import Array, Flags
from dalembert.core.constraints import measure
from dalembert.core.gear_rows import mesh_wheels
from dalembert.core.layout import Angle, Helix, Layout, Pose
from dalembert.core.position.assembly_modes import SAME
from dalembert.core.position.first_pose_plane import STARTS, Modes, phase_rows, with_rows
from dalembert.core.position.motion_path import path
from dalembert.core.position.newton import CLOSED, close_loops, distance
from dalembert.core.position.path_parameter import course
from dalembert.core.rotation_rows import along_axis

FEW = 16
"""Starts behind a gap, where the affected group has two assembly modes."""

ALONG = 1e-9
"""Largest deviation from 1 of the cosine between shared axes that count as parallel."""


class Hinge(NamedTuple):
    """Placement of link j from link i by their joint: local axes on both (9,), and the axes of its slides and turns in
    order.

    The local axes of j are those of i turned about ``turns`` one after the other; ``drives`` (slides, then turns) are
    the drives that prescribe them, -1 where none does; ``parallel`` is the axis that both links share, -1 for none.
    A screw advances by ``rise`` a radian of its turn; where its slide is driven, ``sliding`` is that drive, else -1.
    """

    i: int
    j: int
    ui: Array
    uj: Array
    frame_i: Array
    frame_j: Array
    slides: tuple[int, ...]
    turns: tuple[int, ...]
    drives: tuple[int, ...]
    parallel: int
    rise: float = 0.0
    sliding: int = -1


@dataclass(frozen=True)
class PoseGuess:
    """Given part of the first pose: rotations (L+1, 9) and reference points (L+1, 3), NaN where unknown.

    The rotations are by ``angle`` (L+1,), including whole turns, about unit vectors ``axis`` (L+1, 3); 0 for the
    ground.
    """

    rotation: Array
    point: Array
    hinges: tuple[Hinge, ...]
    axis: Array
    angle: Array

    @property
    def known_links(self) -> Flags:
        """True for links with a given pose (L+1,)."""
        return np.asarray(np.isfinite(self.rotation).all(axis=-1))

    def modes(self, layout: Layout, target: Array) -> Modes | None:
        """The assembly mode at a target (K + D,); None if no start closes."""
        if self.known_links.any():
            return self._near(layout, target) or self._search_modes(layout, target)
        return (
            self._as_drawn(layout, target) or self._near(layout, target) or self._search_modes(layout, target)
        )

    def closes(self, layout: Layout, target: Array) -> bool:
        """True if the linkage closes beside the given poses."""
        return self._near(layout, target) is not None

    def every(self, layout: Layout, target: Array) -> Modes | None:
        """Assembly modes reached from a few random starts."""
        return self._search_modes(layout, target, FEW)

    @property
    def stated(self) -> None:
        """None: angles are not given in space."""
        return None

    def start(self, layout: Layout, target: Array) -> Pose:
        """Links placed as drawn, given or driven (L+1, ...), before any correction."""
        return self._starting_poses(
            layout, target, np.zeros((1, self._values)), driven=bool(self.known_links.any())
        ).at(0)

    def near(self, pose: Pose) -> PoseGuess:
        """The drawing with every link given at a pose (L+1, ...)."""
        return replace(self, rotation=pose.rotation, point=pose.point)

    @property
    def _values(self) -> int:
        return sum(len(h.drives) for h in self.hinges)

    def _as_drawn(self, layout: Layout, target: Array) -> Modes | None:
        """Poses followed from the drawing at drives 0 to the target."""
        zero = target.copy()
        zero[layout.constraints.count :] = 0.0
        pose = self._close_starts(
            layout, self._starting_poses(layout, zero, np.zeros((1, self._values)), driven=False), zero
        )
        if pose is None:
            return None
        if np.any(zero != target):
            layout = mesh_wheels(layout, pose.at(0))[0]
            phased = phase_rows(layout.constraints)
            ends = np.stack([zero, target])
            ends[:, phased] = measure(layout.algebra, layout.constraints, pose.at(0))[phased]
            along = course(layout, ends)
            motion = path(layout, pose.at(0), along, along.at(0))
            if not motion.reached[1]:
                return None
            pose = motion.pose.at(slice(1, 2))
        return Modes(pose, "drawn")

    def _near(self, layout: Layout, target: Array) -> Modes | None:
        pose = self._close_starts(
            layout, self._starting_poses(layout, target, np.zeros((1, self._values)), driven=True), target
        )
        return None if pose is None else Modes(pose, "given" if self.known_links.any() else "drawn")

    def _close_starts(self, layout: Layout, start: Pose, target: Array) -> Pose | None:
        """Starts (S, ...) corrected; those that close with parallel axes parallel, None where none does."""
        layout, target = _without_phase(layout, target)
        wanted = np.broadcast_to(target, (len(start.point), len(target))).copy()
        pose, missing = close_loops(layout, start, wanted, iterations=60)
        good = (missing <= CLOSED * layout.length) & self._upright(layout, pose)
        return pose.at(np.flatnonzero(good)) if good.any() else None

    def _search_modes(self, layout: Layout, target: Array, starts: int = STARTS) -> Modes | None:
        """Every mode reached from random starts, the one with the smallest rotations from the drawn or given poses
        first."""
        steps = np.modf(np.sqrt(np.arange(2, 2 + self._values) + 0.5) * 1.6180339887)[0]
        values = np.modf(0.5 + np.arange(starts)[:, None] * steps)[0] * 2 * np.pi - np.pi
        free = replace(
            self, point=np.full_like(self.point, np.nan), rotation=np.full_like(self.rotation, np.nan)
        )
        start = free if self.known_links[:-1].all() else self  # where all are given, values would lay none
        pose = self._close_starts(layout, start._starting_poses(layout, target, values, driven=True), target)
        if pose is None:
            return None
        drawn = self.start(layout, target)
        away = ((pose.rotation - drawn.rotation) ** 2).sum(axis=(-2, -1)).round(9)
        pose = pose.at(np.argsort(away, kind="stable"))
        kept: list[int] = []
        for k in range(len(pose.point)):
            others = pose.at(np.array(kept, np.intp))
            if not kept or distance(layout, pose.at(k), others).min() > SAME:
                kept.append(k)
        return Modes(pose.at(np.array(kept)), "nearest" if self.known_links.any() else "search")

    def _upright(self, layout: Layout, pose: Pose) -> Flags:
        """True for poses whose shared axes have the same direction on both links: three right angles between axes of j
        and axes of i also hold where an axis is reversed, and where the axes are interchanged."""
        g, good = layout.algebra, np.ones(len(pose.point), bool)
        for h in self.hinges:
            for axis in range(3) if not h.turns else [h.parallel] * (h.parallel >= 0):
                on_i = g.rotate(pose.rotation[:, h.i], space.matrix(h.frame_i)[:, axis])
                on_j = g.rotate(pose.rotation[:, h.j], space.matrix(h.frame_j)[:, axis])
                good &= g.dot(on_i, on_j) > 0.5
        return good

    def _starting_poses(self, layout: Layout, target: Array, values: Array, driven: bool) -> Pose:
        """Starting poses (S, L+1, ...) by values (S, V) of the joints' freedoms, or of the drives where ``driven``."""
        g, count = layout.algebra, len(values)
        drives = target[layout.constraints.count :]
        pose = Pose(
            np.full((count, layout.links + 1, 3), np.nan), *g.reference_rotation(count, layout.links + 1)
        )
        turn = _counters(layout, count, drives if driven else np.zeros_like(drives))
        pose.point[:, -1] = 0.0
        stated = self.known_links
        pose.rotation[:, stated], pose.point[:, stated] = self.rotation[stated], self.point[stated]
        placed = {*np.flatnonzero(stated).tolist(), layout.links}
        by_values = bool(np.any(values)) or driven
        while len(placed) <= layout.links:
            grown, first = False, 0
            for h in self.hinges:
                part = values[:, first : first + len(h.drives)].copy()
                first += len(h.drives)
                if (h.i in placed) == (h.j in placed):
                    continue
                if driven:
                    wanted = np.array(h.drives, np.intp)
                    known = (wanted >= 0) & (wanted < len(drives))  # none are where the drives are left out
                    part[:, known] = drives[wanted[known]]
                    if 0 <= h.sliding < len(drives):
                        part = np.full_like(part, drives[h.sliding] / h.rise)
                _place(layout, h, pose, part, h.i in placed, by_values)
                placed |= {h.i, h.j}
                grown = True
            if not grown:
                lone = min(set(range(layout.links)) - placed)
                pose.point[:, lone] = 0.0
                placed.add(lone)
        for f in layout.constraints.families:
            if isinstance(f, Helix):
                turn[:, f.count] = -along_axis(g, f, pose) / f.pitch
        return pose._replace(turn=turn)


def _without_phase(layout: Layout, target: Array) -> tuple[Layout, Array]:
    """The layout and target without the rows whose target is their measure at the first pose."""
    phased = phase_rows(layout.constraints)
    if not phased.size:
        return layout, target
    kept = np.setdiff1d(np.arange(layout.constraints.count), phased)
    return with_rows(layout, kept, []), np.delete(target, phased)


def _counters(layout: Layout, count: int, drives: Array) -> Array:
    """Values of the counted angles (count, T): the drives' positions, 0 for the others."""
    turn = np.zeros((count, max((int(f.count.max()) + 1 for f in layout.counted), default=0)))
    for f in layout.counted:
        if isinstance(f, Angle):
            for d, row in enumerate(layout.driven):
                turn[:, f.count[f.row == row]] = drives[d]
    return turn


def _place(layout: Layout, h: Hinge, pose: Pose, values: Array, forward: bool, by_values: bool) -> None:
    """Places one link of a joint from the other; as drawn where the joint allows it, unless ``by_values``."""
    g, size = layout.algebra, layout.length / np.pi
    known, new = (h.i, h.j) if forward else (h.j, h.i)
    if by_values or not _as_drawn(g, h, pose):
        relative = np.broadcast_to(h.frame_i, (len(values), 9))
        for k, axis in enumerate(h.turns, start=len(h.slides)):
            relative = space.compose(relative, space.rotation(values[:, k], np.eye(3)[axis]))
        relative = space.compose(relative, _inverse(h.frame_j))
        if not forward:
            relative = _inverse(relative)
        pose.rotation[:, new] = space.compose(pose.rotation[:, known], relative)
    ri, rj = g.rotate(pose.rotation[:, h.i], h.ui), g.rotate(pose.rotation[:, h.j], h.uj)
    offset = np.zeros_like(ri)
    for k, axis in enumerate(h.slides):
        e = g.rotate(pose.rotation[:, h.i], space.matrix(h.frame_i)[:, axis])
        offset = offset + e * (values[:, k, None] if h.drives[k] >= 0 else values[:, k, None] * size)
    if h.rise and by_values:
        e = g.rotate(pose.rotation[:, h.i], space.matrix(h.frame_i)[:, h.turns[0]])
        offset = offset + h.rise * e * values
    if forward:
        pose.point[:, new] = pose.point[:, known] + ri + offset - rj
    else:
        pose.point[:, new] = pose.point[:, known] + rj - offset - ri


def _as_drawn(g: Algebra, h: Hinge, pose: Pose) -> bool:
    """True if the joint's axes allow its links to be as drawn."""
    axes = [h.parallel] * (h.parallel >= 0) if h.turns else [0, 1, 2]
    on_i, on_j = (
        [g.rotate(pose.rotation[0, link], space.matrix(frame)[:, axis]) for axis in axes]
        for link, frame in ((h.i, h.frame_i), (h.j, h.frame_j))
    )
    return all(g.dot(a, b) > 1 - ALONG for a, b in zip(on_i, on_j, strict=True))


def _inverse(r: Array) -> Array:
    turned: Array = np.swapaxes(space.matrix(r), -1, -2)
    return turned.reshape((*turned.shape[:-2], 9))
