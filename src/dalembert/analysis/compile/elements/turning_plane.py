"""A plane that turns, as numbers for the core.

Mechanics: docs/theory.md 4.1.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from dalembert.analysis.compile.load_arrays import LoadSetting, given_effort
from dalembert.analysis.compile.plane_rows import numbers
from dalembert.arrays import Array, Index
from dalembert.core.forcing import TurningFrame
from dalembert.model import GROUND, Schedule
from dalembert.model.drives.turning import UNKNOWN, TurningPlane
from dalembert.model.drives.turning_checks import freed_drive, plane_moments
from dalembert.model.quantities.figures import unit_vector


def turning_frame(s: LoadSetting, schedule: Schedule) -> TurningFrame | None:
    """The frame in which a mechanism turns; None where it does not."""
    turning: TurningPlane | None = s.m.turning
    if turning is None:
        return None
    speed: Any = turning.speed
    axis: Any = turning.axis
    drive = freed_drive(s.m) if schedule.unknown is None else None
    square = np.nan if speed == UNKNOWN else speed * speed
    links = [name for name in s.m.links if name != GROUND]
    return TurningFrame(
        axis=numbers(unit_vector(axis) if isinstance(axis, float) else (axis.cos(), axis.sin())),
        at=numbers(turning.at) - s.reference[-1],
        square=_along(square, s.count),
        moments=numbers([plane_moments(s.m, link) for link in links]).reshape(len(links), 3),
        effort=np.zeros(s.count) if drive is None else given_effort(s, drive),
        driven=-1 if drive is None else schedule.names.index(drive),
    )


def _along(value: Any, count: int) -> Array:
    return np.broadcast_to(numbers([value])[0], (count,))


def frame_at(frame: TurningFrame | None, part: Index) -> TurningFrame | None:
    """The frame at some positions."""
    return frame and replace(frame, square=frame.square[part], effort=frame.effort[part])
