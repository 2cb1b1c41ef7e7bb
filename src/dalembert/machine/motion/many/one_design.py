"""The motion of one design of many by `da.simulate`, as the designs side by side have it.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from dalembert.analysis.result.named_quantities import quantity
from dalembert.arrays import Array
from dalembert.machine.motion.coded.shared_motion import SharedMotion
from dalembert.machine.motion.many.over_instants import over_instants
from dalembert.machine.motion.simulation import motion_of
from dalembert.model import Mechanism


@dataclass(frozen=True)
class Alone:
    """Time, positions and speeds (D,) at the end, outputs by name, and by what it ended; ``known``: not stopped."""

    time: float
    position: Array
    speed: Array
    outputs: dict[str, Array]
    ended: str
    known: bool = True

    @classmethod
    def failed(cls, why: str) -> Alone:
        """One that cannot begin, or go on."""
        return cls(np.nan, np.zeros(0), np.zeros(0), {}, why, known=False)


def alone(
    m: Mechanism,
    until: Sequence[str | float],
    outputs: Sequence[str],
    reduce: str | None,
    count: int,
    tolerance: float,
    shared: SharedMotion | None,
) -> Alone:
    """The motion of a design, its outputs reduced over its instants."""
    s = motion_of(m, until, count=count, tolerance=tolerance, shared=shared)
    if s.ended.startswith("stopped"):
        return Alone.failed(s.ended)
    along = {name: quantity(s.result, name).values for name in outputs}
    reduced = {name: over_instants(reduce, values, s.time, count) for name, values in along.items()}
    at = s.schedule
    return Alone(float(s.time[-1]), at.position[-1], at.speed[-1], reduced, s.ended)
