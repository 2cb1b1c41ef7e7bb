"""End stops: impacts by Newton's law of restitution, and rest on a stop whose force can only push.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq

from dalembert.arrays import Array
from dalembert.machine.motion.actuation import Actuation
from dalembert.machine.motion.occurrences import Event, Guard, Words
from dalembert.machine.motion.standstill import STILL, ContactState
from dalembert.model import Mechanism
from dalembert.model.drives.drives import kind_of

SLOW = 1e-8
"""What goes back from a stop with less than this part of the greatest speed there has been stays on it."""
LOOKS = 9
"""Instants of a step at which it is asked whether a stop has been met."""


class StopState(ContactState):
    """A motion whose drives may strike stops; ``losses``: when, and the energy lost, J."""

    def __init__(self, m: Mechanism, actuation: Actuation) -> None:
        super().__init__(m, actuation)
        self.fastest = np.abs(actuation.speed)
        self.losses: list[tuple[float, float]] = []
        drives = enumerate(actuation.drives)
        self.stops = {k: drive.stops for k, drive in drives if drive.stops and actuation.free[k]}

    def stop_guards(self) -> list[Guard]:
        """Distances from the stops that are not rested on; the side is that of the way in."""
        return [
            Guard("stop", k, lambda t, y, k=k, x=x: float(y[k] - x), -side)  # type: ignore[misc]
            for k, stops in self.stops.items()
            for side, x in ((-1.0, stops.least), (1.0, stops.greatest))
            if np.isfinite(x) and self.on_stop[k] != side
        ]

    def strikes(self, g: Guard, state: Callable[[float], Array], before: float, after: float) -> float | None:
        """When a stop is met within a step; one that begins on it leaves it first."""

        def room(t: float) -> float:
            return g.value(t, state(t)) * g.side

        def speed(t: float) -> float:
            return float(state(t)[self.d + g.which]) * g.side

        for low, high in pairwise(np.linspace(before, after, LOOKS).tolist()):
            if room(high) < 0:
                if room(low) <= 0 and speed(low) > 0 > speed(high):
                    low = float(brentq(speed, low, high))
                return float(brentq(room, low, high, xtol=1e-300, rtol=1e-15)) if room(low) > 0 else low
        return None

    def strike(self, k: int, side: float, t: float, y: Array) -> None:
        """u+ = u- - (1 + e) M^-1 n (n u-) / (n M^-1 n) at a stop of drive k; what friction holds is let go."""
        d, free, stops = self.d, np.flatnonzero(self.acting.free), self.stops[k]
        u = y[d : 2 * d]
        y[k] = stops.least if side < 0 else stops.greatest
        before = max(float(u[k]) * side, 0.0)
        e = stops.restitution
        e = e if e * before > SLOW * max(float(self.fastest.max()), 1e-300) else 0.0
        mass = self.equation(t, y[:d], u).mass[np.ix_(free, free)]
        ease = np.linalg.solve(mass, (free == k).astype(float))
        own = float(ease[free == k][0])
        u[free] -= (1 + e) * before * side * ease / own
        u[k] = -e * before * side
        lost = (1 - e * e) * before**2 / (2 * own)
        self.losses.append((t, lost))
        self.locked &= u == 0
        if len(self.sense):
            rates = self.own(self.equation(t, y[:d], u).rates)
            clear = np.abs(rates) > STILL * np.abs(rates).max(initial=0.0)
            self.sense = np.where(clear, np.where(rates < 0, -1.0, 1.0), self.sense)
        self.toward = np.where(u != 0, np.where(u < 0, -1.0, 1.0), self.toward)
        self._note_impact(k, t, (float(y[k]), before, e * before, lost))
        self.on_stop[k] = 0.0 if e else side
        for j in np.flatnonzero((u == 0) & (self.rubs | (self.on_stop != 0))):
            self._settle(int(j), t, y)

    def _note_impact(self, k: int, t: float, of: tuple[float, float, float, float]) -> None:
        place, before, after, lost = of
        drive, name = self.acting.drives[k], self.acting.names[k]
        kind, rate = kind_of(drive.freedom, ""), kind_of(drive.freedom, "speed")
        back: Words = ("goes back with ", (rate, after)) if after else ("does not go back",)
        said: Words = (f"{name} strikes its stop at ", (kind, place), " with ", (rate, before), " and ")
        self.events.append(
            Event(t, "impact", (*said, *back, "; ", ("energy", lost), " are lost"), name, before, lost)
        )
