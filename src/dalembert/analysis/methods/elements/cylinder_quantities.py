"""Pressures and flows of cylinders, and how far they are within their strokes; for numbers and nodes alike.

Mechanics: docs/theory.md 10.11.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.arrays import Numeric
from dalembert.core.branchless import larger, sign

if TYPE_CHECKING:
    from dalembert.model import Mechanism

ROUNDING = 1e-9
"""Part of its greatest length by which a cylinder may be out of its stroke."""


def cylinders(m: Mechanism) -> dict[str, Any]:
    """Cylinders of a mechanism, by their drives."""
    return {name: d.cylinder for name, d in m.drives.items() if d.cylinder is not None}


def hydraulic_force(c: Any, force: Numeric, speed: Numeric) -> Numeric:
    """Force of the pressures on the piston for a force of the rod: seals take their part against the motion; at rest
    none."""
    way = sign(np.asarray(force * speed))
    over, eta = 1.0 / c.efficiency, c.efficiency
    factor = 1.0 + way * ((over - eta) / 2) + way * way * ((over + eta) / 2 - 1.0)
    return force * factor + c.friction * sign(np.asarray(speed))


def pressures(c: Any, pushed: Numeric) -> tuple[Numeric, Numeric]:
    """Gauge pressures on the sides of cap and rod that together push with a force: the one that is not known."""
    cap, rod = c.areas
    if c.rod_pressure is not None:
        return (pushed + c.rod_pressure * rod) / cap, c.rod_pressure
    if c.cap_pressure is not None:
        return c.cap_pressure, (c.cap_pressure * cap - pushed) / rod
    return larger(np.asarray(pushed), 0.0) / cap, larger(np.asarray(-pushed), 0.0) / rod


def working_pressure(r: Any, name: str) -> Numeric:
    """Pressure of the chamber that is not known; with neither known, of that which carries."""
    c = r.mechanism.drives[name].cylinder
    cap, rod = pressures(c, hydraulic_force(c, r.effort(name), r.drive_speed(name)))
    if c.rod_pressure is not None or c.cap_pressure is not None:
        return cap if c.rod_pressure is not None else rod
    return cap + rod  # one of them is 0


def flow_in(r: Any, name: str) -> Numeric:
    """Flow into the chamber that grows."""
    (cap, rod), speed = r.mechanism.drives[name].cylinder.areas, r.drive_speed(name)
    return cap * larger(np.asarray(speed), 0.0) + rod * larger(np.asarray(-speed), 0.0)


def stroke_margins(m: Mechanism, names: tuple[str, ...], position: Any) -> list[Any]:
    """Below zero where some cylinder is out of its stroke: (K,) of positions (..., D) of the drives."""
    out = []
    for name, c in cylinders(m).items():
        if c.closed is not None and c.stroke is not None:
            at, most = position[..., names.index(name)], c.closed + c.stroke
            out += [at - c.closed + ROUNDING * most, most * (1 + ROUNDING) - at]
    return out
