"""One-way clutches and ratchets as stops that move on: at the angle they have reached, or at the last tooth.

Mechanics: docs/theory.md 10.13.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.machine.motion.actuation import Actuation
from dalembert.machine.motion.occurrences import Guard
from dalembert.machine.motion.rest.standstill import STILL
from dalembert.machine.motion.stops.elastic_rest import ElasticRestState
from dalembert.model import Mechanism

ON_TOOTH = 1e-12
"""Part of a pitch by which a ratchet may start before a tooth and be on it."""


class ClutchState(ElasticRestState):
    """A motion some of whose ``stops`` are clutches."""

    def __init__(self, m: Mechanism, actuation: Actuation) -> None:
        super().__init__(m, actuation)
        self.stops: list[Any] = []

    def motion_of(self, stop: Any, t: float, y: Array) -> tuple[float, float]:
        """Position and speed of a stop's freedom."""
        raise NotImplementedError

    def _place_clutch(self, stop: Any, x: float, rate: float) -> None:
        """A clutch at the start: on its last tooth; one without teeth holds at once if it does not turn."""
        stop.looks = [(0.0, x, rate)]
        small = STILL * max(float(self.fastest.max()), 1e-300)
        if rate * stop.way < -small:
            what = f"{stop.name} starts to turn in the sense that it blocks"
            raise ModelError(what, "start with other speeds", ("joints", stop.name))
        if stop.pitch or rate * stop.way <= small:
            at = self.m.joints[stop.name].angle if stop.pitch else x  # type: ignore[union-attr]
            teeth = np.floor(stop.way * (x - at) / (stop.pitch or 1.0) + ON_TOOTH)
            self._hold_from(stop, at + stop.way * teeth * stop.pitch)

    def _hold_from(self, stop: Any, x: float) -> None:
        """Let a clutch hold at a place: against its free sense; anywhere, if that is infinite."""
        key = "least" if stop.way > 0 else "greatest"
        stop.ends = replace(stop.ends, **{key: x})

    def latch(self, k: int, t: float, y: Array) -> bool:
        """A clutch has come to rest in its free sense, or has passed a tooth; whether it holds now."""
        stop = self.stops[k]
        if stop.pitch:
            self._hold_from(stop, stop.end(-stop.way) + stop.way * stop.pitch)
            return False
        self._hold_from(stop, self.motion_of(stop, t, y)[0])
        return True

    def clutch_guards(self) -> list[Guard]:
        """Rates of clutches that turn freely, and the next teeth of ratchets."""

        def rate(stop: Any) -> Callable[[float, Array], float]:
            return lambda t, y: stop.way * self.motion_of(stop, t, y)[1]

        def tooth(stop: Any) -> Callable[[float, Array], float]:
            x = stop.end(-stop.way) + stop.way * stop.pitch
            return lambda t, y: stop.way * (x - stop.near(self.motion_of(stop, t, y)[0], x))

        clutches = [(k, s) for k, s in enumerate(self.stops) if s.way]
        free = [(k, s) for k, s in clutches if s.pitch or not np.isfinite(s.end(-s.way))]
        return [Guard("clutch", k, tooth(s) if s.pitch else rate(s), 1.0) for k, s in free]

    def _let_turn(self, stop: Any) -> None:
        """Let a stop go; a clutch without teeth holds nowhere while it turns."""
        stop.resting = 0.0
        if stop.way and not stop.pitch:
            self._hold_from(stop, -stop.way * np.inf)
