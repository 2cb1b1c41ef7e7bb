"""The cycle of a machine: the angle it goes by, and its positions where the file has a single one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dalembert.arrays import Array
from dalembert.errors import ModelError

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


def turning_angle(r: Result) -> Array:
    """Angle of the first drive (P,), rad; raises ModelError where there is none that turns."""
    if not r.drives:
        raise ModelError("harmonics are taken over the turn of a drive, and there is none", "drive a joint")
    if not r.mechanism.drives[r.drives[0]].turns:
        raise ModelError(
            f"harmonics are taken over the turn of a drive, and {r.drives[0]} slides", "drive a crank"
        )
    return r.drive_position(r.drives[0])
