"""The cycle of a machine where its file has a single position."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from dalembert.model import Mechanism

ENOUGH = 72
"""Positions over a turn."""


def over_a_turn(m: Mechanism, positions: int | None = None) -> int | None:
    """The number of positions to analyse: a whole turn where there is one position, which a drive can step round."""
    turning = [drive for drive in m.drives.values() if drive.turns]
    if positions is not None or len(turning) != 1 or any(d.unknown or d.counts() for d in m.drives.values()):
        return positions
    return ENOUGH
