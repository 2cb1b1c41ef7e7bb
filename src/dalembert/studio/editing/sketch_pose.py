"""Pose of a mechanism that need not be finished: closed near where it was drawn, and pulled by the mouse.

Lengths over the characteristic length, angles in radians. Damped least squares; a step is taken only if it closes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled, compile_mechanism
from dalembert.analysis.positions import first_position
from dalembert.arrays import Array
from dalembert.core.constraints import dense, measure, stack_rows, system
from dalembert.core.factor import damped_step
from dalembert.core.layout import Pose
from dalembert.core.position.first_pose_plane import Guess, phase_rows, tree_pose
from dalembert.core.position.newton import CLOSED, displace, gap
from dalembert.errors import ModelError
from dalembert.kernel.sketch_program import origins
from dalembert.model import Mechanism

PASSES, PULLS = 60, 12
"""Steps to close a sketch, and steps of one pull."""
STIFF = 1e6
"""Weight of the constraints beside the pull."""
REACH = 0.25
"""Longest step."""
INDEPENDENT = 1e-9
"""Singular value over the largest below which constraints repeat each other."""

Placed = Mapping[str, tuple[float, float, float]]
"""Link -> x, y of the origin of its axes and its angle, ground axes, m and rad."""


@dataclass(frozen=True)
class SketchPose:
    """A compiled plane mechanism at a pose (1, L+1, ...); ``gap``: the largest residual, m; ``freedoms``: what
    the joints leave free at this pose."""

    compiled: Compiled
    pose: Pose
    gap: float
    freedoms: int

    @property
    def closed(self) -> bool:
        """True if every joint holds."""
        return self.gap <= 1e3 * CLOSED * self.compiled.layout.length

    @property
    def placed(self) -> dict[str, tuple[float, float, float]]:
        """Origins and angles of the links."""
        at = origins(self.compiled.layout, self.pose)[0]
        turn = self.pose.turn[0]
        return {
            link: (float(at[k, 0]), float(at[k, 1]), float(turn[k]))
            for k, link in enumerate(self.compiled.links)
        }

    @property
    def drive_positions(self) -> dict[tuple[str, str], float]:
        """Measure of every freedom, by joint and freedom: rad, m."""
        c = self.compiled
        values = measure(c.layout.algebra, c.layout.freedoms, self.pose)[0]
        return {name: float(x) for name, x in zip(c.freedoms, values, strict=True)}

    def pulled(self, link: str, at: tuple[float, float], to: tuple[float, float]) -> SketchPose:
        """The pose after a point of a link (link axes) is pulled towards a place, as near as the joints let it."""
        with np.errstate(all="ignore"):
            return self._pulled(link, at, to)

    def _pulled(self, link: str, at: tuple[float, float], to: tuple[float, float]) -> SketchPose:
        c = self.compiled
        k, pose, damping = c.links.index(link), self.pose, 1e-3
        g, rows = c.layout.algebra, c.layout.constraints
        for _ in range(PULLS):
            arm = g.rotate(pose.rotation[0, k], np.asarray(at) - c.layout.reference[k])
            short = (np.asarray(to) - c.origin - pose.point[0, k] - arm) / c.layout.length
            if np.hypot(*short) < 1e-7 or damping > 1e6:
                break
            j = dense(c.layout, system(g, rows, pose))[0] * c.layout.row_scale[: rows.count, None]
            j = j * c.layout.column_scale
            pull = np.zeros((2, j.shape[1]))
            pull[:, 3 * k : 3 * k + 3] = [[1, 0, -arm[1] / c.layout.length], [0, 1, arm[0] / c.layout.length]]
            wanted = short * min(1.0, 0.5 / float(np.hypot(*short)))
            square = STIFF * j.T @ j + pull.T @ pull + damping * np.eye(j.shape[1])
            step = np.linalg.solve(square, pull.T @ wanted)
            step *= min(1.0, REACH / max(float(np.abs(step).max()), 1e-300))
            dq = step * c.layout.length * c.layout.column_scale
            trial = displace(c.layout, pose, dq.reshape(1, c.layout.links, -1))
            trial, missing = settled(c, trial, drives=False)
            arm = g.rotate(trial.rotation[0, k], np.asarray(at) - c.layout.reference[k])
            left = (np.asarray(to) - c.origin - trial.point[0, k] - arm) / c.layout.length
            if missing <= CLOSED * c.layout.length and np.hypot(*left) < np.hypot(*short):
                pose, damping = trial, max(damping / 4, 1e-5)
            else:
                damping *= 8
        return replace(self, pose=pose)


def sketch_pose(m: Mechanism, known: Placed) -> SketchPose:
    """The pose of a plane mechanism that is nearest to its ``assembly`` and to what is known.

    For a finished one without known pose it is that of its analysis; no other is searched for, which may
    take seconds. Raises ModelError where it cannot be compiled.
    """
    with np.errstate(all="ignore"):
        return _sketch_pose(m, known)


def _sketch_pose(m: Mechanism, known: Placed) -> SketchPose:
    c = compile_mechanism(m, m.schedule())
    if not isinstance(c.guess, Guess):
        raise ModelError("the studio draws plane mechanisms", "edit the text of one in space")
    pose, missing = settled(
        c, tree_pose(c.layout, c.first_target, _guess(c, c.guess, known)).at(None), drives=True
    )
    freedoms = _freedoms(c, pose)
    finished = freedoms == len(c.schedule.names) > 0 and not known
    if finished and (first := first_position(c)) is not None:
        return SketchPose(c, first[1].pose.at(slice(0, 1)), 0.0, freedoms)
    if not missing <= CLOSED * c.layout.length:
        loose, open_ = settled(c, pose, drives=False)
        pose, missing = (loose, open_) if open_ <= CLOSED * c.layout.length else (pose, missing)
    return SketchPose(c, pose, missing, freedoms)


def settled(c: Compiled, pose: Pose, drives: bool) -> tuple[Pose, float]:
    """The nearest pose (1, ...) that closes, and the gap it leaves, m; the drives at their first position if asked."""
    target = c.first_target[None].copy()
    rows = c.layout.constraints.count
    weight = np.ones(target.shape[1])
    if not drives:
        weight[rows:] = 0.0
    weight[phase_rows(c.layout.constraints)] = 0.0  # wheels keep the phase that they are drawn in

    def miss(at: Pose) -> tuple[Array, float]:
        missing = gap(c.layout, at, target)[0] * weight
        return missing, float(np.abs(missing).max(initial=0.0)) if np.isfinite(missing).all() else np.inf

    missing, size = miss(pose)
    damping = 1e-9
    for _ in range(PASSES):
        if size <= 1e-12 * c.layout.length or damping > 1e8 or size == np.inf:
            break
        dq = damped_step(c.layout, stack_rows(c.layout, pose), weight, missing, damping)
        longest = float(np.abs(dq / c.layout.column_scale).max(initial=0.0)) / c.layout.length
        dq *= min(1.0, REACH / max(longest, 1e-300))
        trial = displace(c.layout, pose, dq.reshape(1, c.layout.links, -1))
        left, then = miss(trial)
        if np.linalg.norm(left) < np.linalg.norm(missing):
            done = then > 0.5 * size and then <= CLOSED * c.layout.length
            pose, missing, size, damping = trial, left, then, max(damping / 8, 1e-9)
            if done:
                break
        else:
            if size <= CLOSED * c.layout.length:
                break
            damping = max(8 * damping, 1e-6)
    return pose, size


def _guess(c: Compiled, stated: Guess, known: Placed) -> Guess:
    """The file's assembly, with what it leaves open from a known pose."""
    turn, point = stated.turn.copy(), stated.point.copy()
    for k, link in enumerate(c.links):
        if link in known:
            x, y, angle = known[link]
            if np.isnan(turn[k]):
                turn[k] = angle
            if np.isnan(point[k]).any() and link not in c.mechanism.assembly:
                arm = c.layout.algebra.rotate(
                    c.layout.algebra.rotation(np.array(turn[k])), c.layout.reference[k]
                )
                point[k] = np.array([x, y]) + arm - c.origin
    return Guess(turn, point)


def _freedoms(c: Compiled, pose: Pose) -> int:
    """Freedoms that the constraints leave at a pose."""
    rows = c.layout.constraints
    j = dense(c.layout, system(c.layout.algebra, rows, pose))[0] * c.layout.row_scale[: rows.count, None]
    if not rows.count:
        return c.layout.unknowns
    if not np.isfinite(j).all():
        return c.layout.unknowns
    values = np.linalg.svd(j * c.layout.column_scale, compute_uv=False)
    return c.layout.unknowns - int((values > INDEPENDENT * max(values.max(initial=0.0), 1e-300)).sum())
