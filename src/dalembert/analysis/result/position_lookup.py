"""Finds a position of a result: by its number, or by the value of its first drive."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.arrays import Array
from dalembert.errors import STATUSES, AnalysisError, ModelError
from dalembert.units import file_units, quantity

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


PositionChoice = int | float | str | None
"""A position by its number from 1, or by a value of the first drive."""


def position_at(r: Result, at: PositionChoice = None) -> int:
    """Index from 0 of a position given by its number from 1, or nearest to a value of the first drive (`60 deg`).

    Without ``at`` the first that is ok, or else that has a pose. Raises AnalysisError, with its reason, for a position
    that has none.
    """
    k = _place(r, at)
    if r.status[k] == "not_assembled":
        raise AnalysisError(f"position {k + 1}: {r.reasons[k] or STATUSES[r.status[k]].sentence}")
    return k


def _place(r: Result, at: PositionChoice) -> int:
    if at is None:
        posed = np.array([s != "not_assembled" for s in r.status])
        good = np.flatnonzero(r.ok if r.ok.any() else posed)
        return int(good[0]) if len(good) else 0
    if isinstance(at, int) or (isinstance(at, str) and at.strip().isdigit()):
        n = int(at)
        if not 1 <= n <= len(r.status):
            raise ModelError(f"position {n} does not exist", f"use a number from 1 to {len(r.status)}")
        return n - 1
    if not r.drives:
        raise ModelError(
            "the mechanism has no drive to name a position by", "give the number of the position"
        )
    kind = drive_kinds(r, r.drives[0])["position"]
    wanted = quantity(at, kind, file_units(r.mechanism.units))
    values = r.drive_position(r.drives[0])
    k, near = _nearest(values, wanted, kind == "angle")
    if not near:
        shown = r.scale("file")
        nearest = f"{float(shown(kind, values[k])):.6g} {shown.text(kind)}"
        what = f"no position has {r.drives[0]} = {at}; the nearest is {nearest}"
        raise ModelError(what, "give the drive that position, or more positions")
    return k


def _nearest(values: Array, wanted: float, turns: bool) -> tuple[int, bool]:
    """Index of the nearest value, and whether it is within half a step; full cycles away is the same place."""
    away, step = np.abs(values - wanted), float(np.nanmax(np.abs(np.diff(values)), initial=0.0))
    near = 1e-6 + 0.5 * step
    if turns and np.nanmin(away) > near:
        swept = float(np.nanmax(values) - np.nanmin(values)) + step
        cycle = 2 * np.pi * max(1, round(swept / (2 * np.pi)))
        away = np.abs(away - cycle * np.round(away / cycle))
    k = int(np.nanargmin(away))
    return k, bool(away[k] <= near)
