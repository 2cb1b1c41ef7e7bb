"""Demands on a cylinder along a result: pressures, flows, power, and the safety of its column.

Mechanics: docs/theory.md 10.11.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.elements.cylinder_quantities import (
    cylinders,
    hydraulic_force,
    pressures,
)
from dalembert.answer.equality import Compared
from dalembert.arrays import Array, first_largest
from dalembert.errors import ModelError
from dalembert.machine.elements.stepped_column import critical_load, euler
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model.drives.cylinders import FluidCylinder

ATMOSPHERE = 101325.0
"""Pressure of the air, Pa: no gauge pressure is lower than its opposite."""


@dataclass(frozen=True, eq=False)
class CylinderAnswer(Compared):
    """A cylinder along a result, arrays (P,) in SI; gauge pressures, a force that pushes its points apart is positive.

    force: of its rod; cap_pressure, rod_pressure: of both chambers, NaN without a force; flow_in, flow_out:
    into the chamber that grows and out of the other; pressure_low, pressure_high: of ``pressure``, at rest with
    friction of the seals an interval. critical: load at which the column buckles at its length; critical_rod,
    critical_barrel: bounds, one section all along; NaN without the sizes of a column.
    """

    name: str
    length: Array = field(repr=False)
    speed: Array = field(repr=False)
    force: Array = field(repr=False)
    cap_pressure: Array = field(repr=False)
    rod_pressure: Array = field(repr=False)
    pressure: Array = field(repr=False)
    pressure_low: Array = field(repr=False)
    pressure_high: Array = field(repr=False)
    flow_in: Array = field(repr=False)
    flow_out: Array = field(repr=False)
    critical: Array = field(repr=False)
    critical_rod: Array = field(repr=False)
    critical_barrel: Array = field(repr=False)

    @property
    def power(self) -> Array:
        """Power that it gives (P,), W."""
        return self.force * self.speed

    @property
    def safety(self) -> Array:
        """Critical load over the force (P,), where it pushes; elsewhere infinite."""
        with np.errstate(divide="ignore"):
            return np.where(self.force > 0, self.critical / np.where(self.force > 0, self.force, 1.0), np.inf)

    @property
    def worst(self) -> int:
        """Position, from 0, with the least safety against buckling."""
        return first_largest(-np.where(np.isnan(self.safety), np.inf, self.safety))

    @property
    def vacuum(self) -> Array:
        """True (P,) where a chamber would need less than no pressure: it pulls a vacuum."""
        return np.fmin(self.cap_pressure, self.rod_pressure) < -ATMOSPHERE


def cylinder(r: Result, name: str) -> CylinderAnswer:
    """Pressures, flows and column of a cylinder at every position; raises ModelError for a drive that is none.

    F = p1 A1 - p2 A2 without friction, A1 = pi D^2/4, A2 = A1 - pi d^2/4. The chamber that is not known is solved for;
    where neither is, the one that carries, and the other has no gauge pressure.

    >>> import dalembert as da
    >>> links = {"ground": {"points": {"A": [0, 0], "G": [0, 0]}}, "ram": {"points": {"B": [0, 0]}}}
    >>> guide = {"type": "slider", "links": ["ground", "ram"], "at": ["G", "B"]}
    >>> drive = {"cylinder": {"between": ["ground.A", "ram.B"], "bore": 0.1}, "position": 1.0, "speed": 0.2}
    >>> load = {"type": "force", "on": "ram", "at": "B", "value": [-7854, 0]}
    >>> m = {"links": links, "joints": {"G": guide}, "drives": {"C": drive}, "loads": {"F": load}}
    >>> c = da.statics(da.mechanism(m)).cylinder("C")
    >>> c.pressure.round(), c.flow_in.round(7)
    (array([1000002.]), array([0.0015708]))
    """
    known = cylinders(r.mechanism)
    if name not in known:
        what = f"drive {name!r} is not a cylinder"
        raise ModelError(what, closest(name, list(known)) if known else "write cylinder: {...} of a drive")
    c, force, speed, length = known[name], r.effort(name), r.drive_speed(name), r.drive_position(name)
    speed = np.where(np.isnan(force), np.nan, speed)
    cap, rod = _chambers(c, np.asarray(hydraulic_force(c, force, speed)))
    both = [_working(c, *_chambers(c, pushed)) for pushed in _resting(c, force, speed)]
    area_cap, area_rod = c.areas
    grows, shrinks = np.where(speed < 0, area_rod, area_cap), np.where(speed < 0, area_cap, area_rod)
    return CylinderAnswer(
        name,
        length,
        speed,
        force,
        cap,
        rod,
        _working(c, cap, rod),
        np.minimum(*both),
        np.maximum(*both),
        grows * np.abs(speed),
        shrinks * np.abs(speed),
        *_column(c, length),
    )


def _chambers(c: FluidCylinder, pushed: Array) -> tuple[Array, Array]:
    none = np.where(np.isnan(pushed), np.nan, 0.0)
    cap, rod = pressures(c, pushed)
    return np.asarray(cap + none), np.asarray(rod + none)


def _working(c: FluidCylinder, cap: Array, rod: Array) -> Array:
    """Pressure of the chamber that is solved for."""
    if c.rod_pressure is None and c.cap_pressure is None:
        return np.maximum(cap, rod)
    return cap if c.rod_pressure is not None else rod


def _resting(c: FluidCylinder, force: Array, speed: Array) -> tuple[Array, Array]:
    """Forces of the pressures just before it would go in, and out; where it moves, one twice."""
    ways = (np.where(speed == 0, way, speed) for way in (-1.0, 1.0))
    first, second = (np.asarray(hydraulic_force(c, force, way)) for way in ways)
    return first, second


def _column(c: FluidCylinder, length: Array) -> tuple[Array, Array, Array]:
    """Critical loads of its column, and of both sections all along."""
    none = np.full((3, len(length)), np.nan)
    if c.barrel is None or c.rod is None or c.barrel_part is None:
        return none[0], none[1], none[2]
    barrel = c.elasticity * math.pi / 64 * (c.barrel**4 - c.bore**4)
    rod = c.elasticity * math.pi / 64 * c.rod**4
    for k, total in enumerate(length.tolist()):
        if total > 0:
            first = min(c.barrel_part, total)
            none[0, k] = critical_load(first, total - first, barrel, rod, c.ends)
            none[1:, k] = euler(total, rod, c.ends), euler(total, barrel, c.ends)
    return none[0], none[1], none[2]
