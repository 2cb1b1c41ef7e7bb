"""Elastic and damped stops of drives and joints: a spring and a damper that act beyond a position, and only push.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from dalembert.arrays import Array
from dalembert.machine.motion.corners.one_sided import Sided
from dalembert.machine.motion.occurrences import Words
from dalembert.model.drives.drives import kind_of
from dalembert.model.drives.end_stops import Stops
from dalembert.model.quantities.coordinates import SPEED


def stop_push(stops: Stops, side: float, x: Array, rate: Array) -> tuple[Array, Array]:
    """Depth beyond the stop on one side, rad or m, and k depth + c depth': the force of the stop where both are
    positive, N m or N."""
    depth = side * (x - (stops.least if side < 0 else stops.greatest))
    return depth, stops.stiffness * depth + stops.damping * side * rate


def stop_forces(stops: Stops, x: Array, rate: Array) -> Array:
    """Forces (T,) of elastic stops in their freedom, at its positions and rates (T,).

    >>> stop_forces(Stops(0.0, 1.0, stiffness=10.0, damping=1.0), np.array([-0.5, 0.5, 1.5]), np.array([6.0, 6.0, 6.0]))
    array([  0.,   0., -11.])
    """
    out = np.zeros_like(x)
    for side in (-1.0, 1.0):
        depth, push = stop_push(stops, side, x, rate)
        out -= side * np.where((depth > 0) & (push > 0), push, 0.0)
    return out


@dataclass
class ElasticStops(Sided):
    """Elastic ``stops`` of the ``freedom`` of a drive or joint by its ``name``: contact and pressure of each are
    switches, in this order."""

    value: Any = None
    name: str = ""
    freedom: str = ""
    stops: Stops = field(default_factory=Stops)

    @property
    def ends(self) -> list[float]:
        """The sides that have a stop."""
        stops = self.stops
        return [side for side, end in ((-1.0, stops.least), (1.0, stops.greatest)) if np.isfinite(end)]

    def at(self, known: Mapping[str, Any]) -> float:
        """Force of the stops, every switch on its side."""
        self.switches, out = [], 0.0
        for side in self.ends:
            depth, push = stop_push(self.stops, side, known[self.name], known[self.name + SPEED])
            acts = (1 + self._switch(depth)) / 2
            if self.stops.damping:
                acts *= (1 + self._switch(push)) / 2
            out -= side * acts * float(push)
        return out

    def words(self, k: int, known: Mapping[str, Any]) -> Words:
        """Description of a switch that has just gone over: the stop is met, or left."""
        each = 2 if self.stops.damping else 1
        end, which = divmod(k, each)
        other = self.sides[each * end + 1 - which] if each == 2 else 1.0
        if other < 0:
            return ()
        side, kind = self.ends[end], kind_of(self.freedom, "")
        place = self.stops.least if side < 0 else self.stops.greatest
        if self.sides[k] < 0:
            return (f"{self.name} leaves its elastic stop at ", (kind, place))
        rate = (kind_of(self.freedom, "speed"), abs(float(known[self.name + SPEED])))
        return (f"{self.name} meets its elastic stop at ", (kind, place), " with ", rate)
