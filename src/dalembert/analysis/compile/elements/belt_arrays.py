"""Belts and chains of a description as numbers: what gives the sum of their tensions."""

from __future__ import annotations

import numpy as np

from dalembert.analysis.compile.plane_rows import numbers
from dalembert.arrays import Numeric
from dalembert.core.elements.belt_pulls import BeltPulls
from dalembert.model import Mechanism
from dalembert.model.joints.elements.belts import Belt

SUMS: dict[str, tuple[float, float, float]] = {
    "tension": (2.0, 0.0, 1.0),
    "tensioner": (1.0, 0.0, 0.0),
    "tight": (2.0, -1.0, 1.0),
    "slack": (2.0, 1.0, 1.0),
}
"""Key -> factor of its value in N, share of the difference of the tensions, and 1 where N loses 2 m v^2."""


def belts_of(m: Mechanism) -> dict[str, Belt]:
    """The belts of a mechanism without idlers, in the order of their rows."""
    return {n: joint for n, joint in m.joints.items() if isinstance(joint, Belt) and not joint.idlers}


def belt_pulls(m: Mechanism) -> BeltPulls | None:
    """Sources of the sum of each belt's tensions; None without belts."""
    entries: list[tuple[Numeric, ...]] = []
    for belt in belts_of(m).values():
        key, value = belt.stated_tension
        factor, share, loses = SUMS[key]
        mu = grip(m, belt)
        carried = belt.mass_per_length
        entries.append((factor * value, share, loses * carried, carried, mu is not None, mu or 0.0))
    if not entries:
        return None
    *sums, gripped, least = (list(column) for column in zip(*entries, strict=True))
    constant, shares, mass, carries = map(numbers, sums)
    return BeltPulls(constant, shares, mass, carries, np.array(gripped, bool), numbers(least))


def grip(m: Mechanism, belt: Belt) -> Numeric | None:
    """Coefficient below which the belt slips: at rest, over the sine of half the groove; None without a coefficient."""
    if belt.grip is None or not m.friction.enabled:
        return None
    parts = (belt.grip.static, belt.grip.coefficient, m.friction.static, m.friction.coefficient)
    known = next((mu for mu in parts if mu is not None), None)
    return None if known is None else known / wedge(belt)


def wedge(belt: Belt) -> Numeric:
    """Sine of half the groove's angle, 1 of a flat belt."""
    return 1.0 if belt.groove is None else np.sin(belt.groove / 2)
