"""The cycle of a machine: the angle it goes by, and its positions where the file has a single one."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import STATUSES, AnalysisError, ModelError
from dalembert.machine.harmonics import whole_turns

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism

ENOUGH = 72
"""Positions over a turn."""


def over_a_turn(m: Mechanism, positions: int | None = None) -> int | None:
    """The number of positions to analyse: a whole turn where there is one position, which a drive can step round."""
    turning = [drive for drive in m.drives.values() if drive.turns]
    if positions is not None or len(turning) != 1 or any(d.unknown or d.counts() for d in m.drives.values()):
        return positions
    return ENOUGH


def refuse_unknown(r: Result, what: str, *needed: Array) -> None:
    """Raise AnalysisError with the sentence of a position where a number (P, ...) that is needed is not known.

    Reactions that are not unique hinder nobody who does not ask for them.
    """
    known = np.all([np.isfinite(x).reshape(len(r.status), -1).all(axis=1) for x in needed], axis=0)
    if not known.all():
        k = int(np.argmin(known))
        raise AnalysisError(f"{what}; position {k + 1}: {r.reasons[k] or STATUSES[r.status[k]].sentence}")


def durations(r: Result) -> Array:
    """Time (P,), s, that each position stands for: trapezoids over time, or over the first drive's motion.

    Even positions over whole turns stand for the same part each. Raises ModelError where the drive stands still.
    """
    if len(r.status) == 1:
        return np.ones(1)
    if r.schedule.time is not None:
        return _trapezoids(r.schedule.time)
    if not r.drives or not np.all(r.drive_speed(r.drives[0])):
        raise ModelError(
            "the time of each position is not known", "give the first drive a speed that is not 0"
        )
    q, speed = r.drive_position(r.drives[0]), np.abs(r.drive_speed(r.drives[0]))
    try:
        whole_turns(q)
    except ModelError:
        return np.asarray(_trapezoids(q) / speed)
    return np.asarray(abs(q[1] - q[0]) / speed)


def _trapezoids(x: Array) -> Array:
    steps = np.abs(np.diff(x)) / 2
    return np.asarray(np.append(steps, 0.0) + np.append(0.0, steps))


def turning_angle(r: Result) -> Array:
    """Angle of the first drive (P,), rad; raises ModelError where there is none that turns."""
    if not r.drives:
        raise ModelError("harmonics are taken over the turn of a drive, and there is none", "drive a joint")
    if not r.mechanism.drives[r.drives[0]].turns:
        raise ModelError(
            f"harmonics are taken over the turn of a drive, and {r.drives[0]} slides", "drive a crank"
        )
    return r.drive_position(r.drives[0])
