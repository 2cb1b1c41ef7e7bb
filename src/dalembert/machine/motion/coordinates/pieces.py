"""A motion as pieces, each with the coordinates that suit it, and their instants joined.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import compile_mechanism
from dalembert.analysis.compile.pose_loads import with_pose_loads
from dalembert.analysis.compile.torsion_turns import wound
from dalembert.analysis.one_pass import at_poses, at_schedule
from dalembert.analysis.result.joint_freedoms import freedom_motion, full_pose
from dalembert.analysis.result.result import Result
from dalembert.arrays import Array
from dalembert.core.position.motion_path import Path
from dalembert.machine.motion.coordinates.leading_freedoms import Led, LedCondition, lead_from
from dalembert.machine.motion.equation import StoppedError
from dalembert.machine.motion.integration import Integration
from dalembert.model import Mechanism, Schedule

Instants = tuple[Array, ...]
"""Columns of ``Integration.rows``, each (T, ...), and those of its ``parts``."""


def integrate(run: Integration) -> list[Integration]:
    """All pieces of a motion, from its first one on."""
    run.run()
    pieces, conditions = [run], run.conditions
    while pieces[-1].turned_over:
        last = pieces[-1]
        t, y = last.reached
        try:
            m, leading = lead_from(last.m, last.acting, last.travel(y), t, y[last.d : 2 * last.d])
        except StoppedError as error:
            last.stop(error)
            break
        followed = [LedCondition(**vars(c), leading=leading) for c in conditions]
        piece = Integration(m, leading, last.end, None, followed, last.tolerance, last.limits)
        piece.waiting, piece.events, piece.taken = last.waiting, last.events, last.taken
        piece.progress, piece.count = last.progress, last.count
        near, ahead = " and ".join(last.acting.names), " and ".join(leading.names)
        piece.note(t, "coordinates", f"near a dead centre of {near}: the coordinate is {ahead} from here on")
        piece.run(t, y[2 * last.d :])
        pieces.append(piece)
    return pieces


def instants(pieces: Sequence[Integration]) -> tuple[Instants, Result | None]:
    """The instants of all pieces, of an event the state after it; and the motion at them, where freedoms have led."""
    parts = [_rows(piece) for piece in pieces]
    if len(pieces) == 1:
        return parts[0], None
    motions = [_motion(piece.m, rows) for piece, rows in zip(pieces, parts, strict=True)]
    for n, (piece, motion) in enumerate(zip(pieces, motions, strict=True)):
        if isinstance(piece.acting, Led):
            parts[n] = _of_drives(piece.acting, motion, parts[n], parts[n - 1][1][-1])
    kept = np.append(np.diff(np.concatenate([x[0] for x in parts])) > 0, True)
    for n, motion in enumerate(motions[1:]):  # links turn on from where they have come to
        turned = motions[n].turn_array[-1] - motion.turn_array[0]
        turn = motion.turn_array + 2 * np.pi * np.round(turned / (2 * np.pi))
        motions[n + 1] = replace(motion, turn_array=turn)
    names = ("point_array", "turn_array", "rotation_array", "twist_array", "acceleration_array")
    along = {name: np.concatenate([getattr(x, name) for x in motions])[kept] for name in names}
    return tuple(np.concatenate(x)[kept] for x in zip(*parts, strict=True)), replace(motions[0], **along)


def _motion(m: Mechanism, rows: Instants) -> Result:
    """Poses and rates at instants."""
    t, q, u, a = rows[:4]
    schedule = Schedule(tuple(m.drives), q, u, a, time=t)
    return at_schedule(m, schedule, inertia=True, forces=False)


def _of_drives(leading: Led, motion: Result, rows: Instants, before: Array) -> Instants:
    """Instants of freedoms that lead as those of the drives, which stood so before."""
    moved = np.array([freedom_motion(motion, *name) for name in leading.freedoms])
    q, u, a = np.moveaxis(moved, 1, 0).transpose(0, 2, 1)
    turns = np.array([d.turns for d in leading.own.drives])
    q = q + np.where(turns, 2 * np.pi * np.round((before - q[0]) / (2 * np.pi)), 0.0)

    def effort(*at: Any) -> Array:
        for sided in leading.own.switched_efforts:
            sided.sides.clear()  # those at the end of the motion; here the sides at this instant
        return leading.own.effort(*at)

    efforts = np.array([effort(*at) for at in zip(rows[0], q, u, strict=True)])
    return rows[0], q, u, a, np.where(leading.free, efforts, np.nan), *rows[5:]


def _rows(piece: Integration) -> Instants:
    columns = [np.array(column) for column in zip(*piece.rows, strict=True)]
    columns.append(
        np.array(piece.parts).reshape(len(columns[0]), -1) if piece.parts else np.zeros((len(columns[0]), 0))
    )
    kept = np.append(np.diff(columns[0]) > 0, True)  # of an event the state behind it
    return tuple(x[kept] for x in columns)


def analysis_along(m: Mechanism, schedule: Schedule, motion: Result) -> Result:
    """The analysis of a motion whose poses are known."""
    first, pose = motion.compiled, full_pose(motion)
    c = replace(
        compile_mechanism(m, schedule), layout=first.layout, target=first.target
    )  # in the phase of its wheels
    path = Path(pose, np.ones(len(pose.point), bool), np.zeros(len(pose.point), np.intp))
    r = at_poses(with_pose_loads(wound(c, (0, pose.at(0)), path), path), motion, slice(None), inertia=True)
    rates = {
        name: np.where(np.isnan(getattr(r, name)), getattr(motion, name), getattr(r, name))
        for name in ("twist_array", "acceleration_array")
    }  # at a dead centre of the drives too
    return replace(r, **rates)
