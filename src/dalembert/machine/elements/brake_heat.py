"""Heat of brakes and clutches over a motion: their rubbing work, and the rise of temperature.

Mechanics: docs/theory.md 6.4.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.arrays import Array

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


@dataclass(frozen=True)
class StopHeat:
    """Rubbing work of a brake, J; the rise of temperature of what ``heat`` names, K, if it keeps all of the heat, NaN
    without; and the work over the area of its lining, J/m2, NaN without its size."""

    energy: float
    rise: float
    per_area: float


class BrakeHeat:
    """The heat of a simulation's brakes and clutches."""

    works: Mapping[str, Array]

    @property
    def result(self) -> Result:
        """The analysis along the motion."""
        raise NotImplementedError

    @property
    def time(self) -> Array:
        """Its instants, s."""
        raise NotImplementedError

    @cached_property
    def heat(self) -> dict[str, StopHeat]:
        """Heat of each brake and clutch by name: its rubbing work, the integral of torque times slip.

        The work of all friction is integrated with the motion; each joint has its share of it.
        """
        parts: dict[str, Any] = {n: j for n, j in self.result.mechanism.joints.items() if j.BRAKES}
        if not parts:
            return {}
        lost = {
            name: float(np.trapezoid(np.nan_to_num(self.result.power_lost(name, "dry")), self.time))
            for name in self.result.joints
        }
        total = math.fsum(lost.values())
        work = -float(self.works["friction"][-1]) if "friction" in self.works else 0.0
        scale = work / total if total > 0 else 0.0
        return {name: _heat(part, scale * lost[name]) for name, part in parts.items()}


def _heat(part: Any, energy: float) -> StopHeat:
    rise = energy / part.heat.per_kelvin if part.heat else math.nan
    return StopHeat(energy, rise, energy / part.lining_area if part.lining_area else math.nan)
