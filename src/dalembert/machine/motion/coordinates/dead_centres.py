"""Detects that a motion comes near a dead centre of its drives, where other freedoms should lead.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from abc import abstractmethod

import numpy as np

from dalembert.arrays import Array
from dalembert.machine.motion.actuation import Actuation
from dalembert.machine.motion.coordinates.leading_freedoms import (
    PIVOT,
    best_freedoms,
    can_change_lead,
    unit_motions,
)
from dalembert.machine.motion.stops.touching import TouchState
from dalembert.model import Mechanism

PLACES = 100
"""Number of previous instants that define the recent path of the drives."""
WATCHED, HEAVY = 0.3, 2.0
"""A step, or a speed, below this part of the greatest may be that of a drive near its dead centre, if the inertia
reduced to the drives has grown by the second factor."""


class LeadState(TouchState):
    """A motion whose drives may come near dead centres; ``turned_over``: other freedoms should lead from here."""

    def __init__(self, m: Mechanism, actuation: Actuation) -> None:
        super().__init__(m, actuation)
        self.rows: list[tuple[float, Array, Array, Array, Array, Array, Array, Array]] = []
        self.watch, self.lightest, self.turned_over = WATCHED, np.inf, False
        self.may_turn_over = self.equation.dry is None and can_change_lead(m, actuation)

    @abstractmethod
    def keep_samples(self) -> None:
        """Keep the instants that wait."""

    def is_heavy(self, t: float, y: Array) -> bool:
        """True if the inertia reduced to the drives has become much larger than it was."""
        if not self.may_turn_over:
            return False
        mass = float(np.trace(self.equation(t, y[: self.d], y[self.d : 2 * self.d]).mass))
        self.lightest = min(self.lightest, mass)
        return mass > HEAVY * self.lightest

    def nears_dead_centre(self, t: float, y: Array, shorter: float) -> bool:
        """True if the drives place the links far worse than other freedoms. Evaluated where the steps become
        ``shorter`` or a drive slow, and the reduced inertia has become large."""
        slower = np.abs(y[self.d : 2 * self.d]) / np.maximum(self.fastest, 1e-300)
        least = min(shorter, float(slower[self.acting.free].min(initial=np.inf)))
        looks = self.may_turn_over and least <= self.watch
        self.watch = least / 2 if looks else min(WATCHED, max(self.watch, least / 2))
        if not looks or not self.is_heavy(t, y):
            return False
        r = unit_motions(self.m, self.travel(y), t)
        return r.status[-1] == "ok" and best_freedoms(r, self.acting.free)[1] < PIVOT

    def travel(self, y: Array) -> Array:
        """Positions (K, D) of the drives that have led to a state."""
        self.keep_samples()
        every = -(-len(self.rows) // PLACES)
        return np.array([*(row[1] for row in self.rows[::every]), y[: self.d]])
