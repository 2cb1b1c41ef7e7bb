"""Bearing life as an expression of compiled quantities, where all positions represent equal times.

L10 2 pi / mean |w| with P^e = mean(F^e |w|) / mean |w| is 2e6 pi C^e / mean(F^e |w|): the mean speed cancels.

Mechanics: docs/theory.md 10.5.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.errors import ModelError
from dalembert.machine.bearings.bearing_load import MILLION
from dalembert.machine.whole_cycle import durations
from dalembert.model import GROUND

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

EVEN = 1e-9
"""Part by which the times of positions may differ and be equal."""


def life_expression(r: Result, joint: str) -> str:
    """L10 of a joint's bearing, s, as an expression of reductions; empty where it is none: in space, where positions
    represent different times, and for parts that never turn against each other."""
    described: Any = r.mechanism.joints[joint]
    try:
        time = durations(r)
    except ModelError:
        return ""
    i, j = (np.zeros(1) if n == GROUND else r.speed(n) for n in described.links)
    moves = np.any(np.abs(j - i) > EVEN * max(np.abs(i).max(), np.abs(j).max()))
    if r.mechanism.dimension == 3 or not moves or np.ptp(time) > EVEN * time.max():
        return ""
    speeds = ["0" if n == GROUND else f"angle.{n}.speed" for n in described.links]
    e = described.bearing.exponent
    size = f"{2 * math.pi * MILLION!r}*joints.{joint}.bearing.rating^{e!r}"
    return f"{size}/mean(reaction.{joint}.magnitude^{e!r}*abs({speeds[1]} - {speeds[0]}))"
