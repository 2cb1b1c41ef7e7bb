"""The cycle of a machine: the angle it is a function of, and its positions where the file has a single one."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import numpy as np

from dalembert.arrays import Array, Ints
from dalembert.errors import STATUSES, AnalysisError, ModelError
from dalembert.machine.harmonics import whole_turns
from dalembert.printing import number

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import AtPositions, Mechanism

ENOUGH = 72
"""Positions over a turn."""
FEWEST = 6
"""Positions of which half are still a cycle."""


def over_a_turn(m: Mechanism, positions: AtPositions = None) -> AtPositions:
    """The positions to analyse: a full turn where the file has one position and a drive can be stepped round."""
    turning = [drive for drive in m.drives.values() if drive.turns]
    if positions is not None or len(turning) != 1 or any(d.unknown or d.counts() for d in m.drives.values()):
        return positions
    return ENOUGH


def solved_over_a_turn(m: Mechanism, static: bool = False, positions: AtPositions = None) -> Result:
    """The answer at the file's positions, or over a full turn where it has one, a drive that moves, and all close."""
    from dalembert.analysis import solve

    result = solve(m, static=static, positions=positions)
    if len(result.status) == 1 and result.schedule.speed.any():
        turned = solve(m, static=static, positions=over_a_turn(m))
        return turned if turned.ok.all() else result
    return result


def refuse_unknown(r: Result, what: str, *needed: Array) -> None:
    """Raise AnalysisError with the sentence of a position where a number (P, ...) that is needed is not known.

    Reactions that are not unique hinder nobody who does not ask for them.
    """
    known = np.all([np.isfinite(x).reshape(len(r.status), -1).all(axis=1) for x in needed], axis=0)
    if not known.all():
        k = int(np.argmin(known))
        raise AnalysisError(f"{what}; position {k + 1}: {r.reasons[k] or STATUSES[r.status[k]].sentence}")


def durations(r: Result, at: Ints | None = None) -> Array:
    """Time (P,), s, represented by each position, or by some: trapezoids over time, or over the motion of the first
    drive that moves at every position.

    Even positions over full turns represent equal parts. Raises ModelError where all drives are at rest.
    """
    at = np.arange(len(r.status)) if at is None else at
    if len(r.status) == 1:
        return np.ones(1)
    if r.schedule.time is not None:
        return _trapezoids(r.schedule.time[at])
    moving = next((d for d in r.drives if np.all(r.drive_speed(d)) and np.ptp(r.drive_position(d))), None)
    if moving is None:
        raise ModelError(
            "the time of each position is not known", "give a drive a range and a speed that is not 0 in it"
        )
    q, speed = r.drive_position(moving)[at], np.abs(r.drive_speed(moving)[at])
    if not is_period(r.drive_position(moving)):
        return np.asarray(_trapezoids(q) / speed)
    return np.asarray(abs(q[1] - q[0]) / speed)


def is_period(q: Array) -> bool:
    """True for even positions of a drive over full turns."""
    try:
        whole_turns(q)
    except ModelError:
        return False
    return True


def _closed(r: Result) -> bool:
    """True if the first position follows the last."""
    timed = r.schedule.time is not None
    return not timed and bool(r.drives) and is_period(r.drive_position(r.drives[0]))


def halves(r: Result) -> list[Ints]:
    """Both halves of the positions, every other from the first and from the second; the ends of a range in both.

    None below 6 positions, and for an odd number over full turns, whose halves are not even.
    """
    count = len(r.status)
    if count < FEWEST or (_closed(r) and count % 2):
        return []
    ends = [] if _closed(r) else [0, count - 1]
    return [np.union1d(np.arange(first, count, 2), np.array(ends, int)) for first in (0, 1)]


def sampled(r: Result, changes: Mapping[str, float], what: str = "Means and greatest values") -> str:
    """A sentence on values that are those of the positions: by how much half of these would change them."""
    count = len(r.status)
    if count == 1:
        return ""
    text = f"{what} are those of the {count} positions, not of the motion between them"
    worst = max(
        (name for name in changes if np.isfinite(changes[name])), key=lambda name: changes[name], default=""
    )
    if not worst:
        return f"{text}."
    return f"{text}: with every other position they differ by {number(100 * changes[worst], 2)} % at most ({worst})."


def sampling(
    r: Result, of: Callable[[Ints], Mapping[str, float]], peaks: Mapping[str, Array]
) -> dict[str, float]:
    """By how much half of the positions would change values, as parts of these; NaN without halves.

    ``of(at)`` gives them for some positions; ``peaks``: of those that are the greatest of
    values (P,), these: where a parabola through a peak and its neighbours goes further beyond it, that counts.
    """
    full, some = of(np.arange(len(r.status))), [of(at) for at in halves(r)]
    out = {}
    for name, value in full.items():
        off = max((abs(v[name] - value) for v in some), default=math.nan)
        if name in peaks and some:
            off = max(off, _beyond(np.abs(peaks[name]), _closed(r)))
        out[name] = off / abs(value) if value else off
    return out


def _beyond(y: Array, closed: bool) -> float:
    """Height of a parabola through the greatest value and its neighbours above that value; 0 at the ends of a range."""
    k = int(np.argmax(y))
    if not closed and k in (0, len(y) - 1):
        return 0.0
    before, after = y[k - 1], y[(k + 1) % len(y)]
    bend = 2 * y[k] - before - after
    return float((after - before) ** 2 / (8 * bend)) if bend > 0 else 0.0


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
