"""A motion under forces as segments that are smooth, each ended by an event: nothing is smoothed, nothing skipped."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq

from dalembert.arrays import Array
from dalembert.machine.motion.driving import Moving
from dalembert.machine.motion.equation import StoppedError
from dalembert.machine.motion.occurrences import Condition, Guard, Track
from dalembert.machine.motion.standstill import STILL, Contacting
from dalembert.model import Mechanism

TINY, TRIES = 1e-12, 100
"""So many steps below this part of the time are no progress."""
COARSEST = 1e-9
"""Tolerance up to which steps with friction are taken again that are refused."""
CHATTER, MANY = 1e-9, 40
"""So many events within this part of the time that has gone by are chatter."""


class Integration(Contacting):
    """One run from a start to an end."""

    def __init__(
        self,
        m: Mechanism,
        moving: Moving,
        end: float,
        times: Array | None,
        conditions: Sequence[Condition],
        tolerance: float,
    ) -> None:
        super().__init__(m, moving)
        self.end, self.conditions, self.tolerance = end, conditions, tolerance
        self.waiting = None if times is None else list(times)
        self.track, self.ended = Track(), ""
        self.fastest = np.abs(moving.speed)

    def keep(self, t: float, y: Array) -> None:
        """Keep an instant."""
        d = self.d
        a, effort, _ = self.at(t, y)
        self.track.rows.append((t, y[:d].copy(), y[d : 2 * d].copy(), a, effort, y[2 * d :].copy()))

    def run(self) -> None:
        """Integrate from the start until the end, a condition that stops, or a state from which nothing goes on."""
        start = self.moving
        t, y = 0.0, np.concatenate([start.position, start.speed, np.zeros(self.d + 4)])
        try:
            self._settle_start(t, y)
            self.keep(t, y)
            while t < self.end and not self.ended:
                if self._all_rest():
                    t = self._rest(t, y)
                else:
                    t, y = self._segment(t, y)
                self._watch_chatter()
        except StoppedError as error:
            self.ended = f"stopped at {self.track.rows[-1][0] if self.track.rows else 0.0:.6g} s: {error}"
            self.note(self.track.rows[-1][0] if self.track.rows else 0.0, "stopped", self.ended)

    def _all_rest(self) -> bool:
        """Whether what forces move is held, and what is prescribed stands."""
        others = ~self.moving.free
        moves = (self.moving.speed[others] != 0).any() or (self.moving.acceleration[others] != 0).any()
        return bool((self.locked | others).all() and not moves)

    def _watch_chatter(self) -> None:
        if len(self.events) > MANY:
            first, last = self.events[-MANY].time, self.events[-1].time
            if last - first <= CHATTER * max(last, 1e-300):
                raise StoppedError(
                    f"{MANY} events within {last - first:.1e} s: a contact that is no drive's sticks and slips; "
                    "drive its joint, so that rest there is a state of its own"
                )

    def _segment(self, t: float, y: Array) -> tuple[float, Array]:
        """To the first event, or the end."""
        guards = self._guards(t, y)
        solver, tiny = self._solver(t, y, self.end), 0
        while solver.status == "running":
            before, from_ = solver.t, solver.y.copy()
            solver.step()
            span = self.end if np.isfinite(self.end) else solver.t
            tiny = tiny + 1 if solver.step_size is not None and solver.step_size < TINY * span else 0
            if tiny > TRIES:
                raise StoppedError(
                    "there the steps become too small, as where something has next to no inertia"
                )
            if solver.status == "failed" and self.equation.rough and self.tolerance < COARSEST:
                self.tolerance *= 10  # forces with friction are found to fewer digits than that
                return before, from_
            if solver.status == "failed" or not np.isfinite(solver.y).all():
                raise StoppedError("there the steps of the integration become too small")
            dense: Any = None
            crossed = [g for g in guards if self._crossed(g, solver.t, solver.y)]
            if crossed:
                dense = solver.dense_output()
                when = min(self._root(g, dense, before, solver.t) for g in crossed)
                y = self._exactly(before, from_, when) if when > before else from_
                self._keep_until(dense, before, when)
                self._happen(when, y, [g for g in crossed if self._root(g, dense, before, solver.t) <= when])
                self.keep(when, y)
                return when, y
            if (self.locked & self.moving.free).any() and not self._still_held(solver.t, solver.y):
                return self._release(before, from_, solver.dense_output(), solver.t)
            self.fastest = np.maximum(self.fastest, np.abs(solver.y[self.d : 2 * self.d]))
            if self.waiting is None:
                self.keep(solver.t, solver.y)
            elif self.waiting and self.waiting[0] <= solver.t:
                self._keep_until(solver.dense_output(), before, solver.t)
        return solver.t, solver.y

    def _solver(self, t: float, y: Array, end: float) -> Any:
        return DOP853(self.rate, t, y, end, rtol=self.tolerance, atol=self.tolerance * 1e-4)

    def _exactly(self, t: float, y: Array, when: float) -> Array:
        """The state at an instant within a step, integrated and not interpolated."""
        solver = self._solver(t, y, when)
        while solver.status == "running":
            solver.step()
        return np.asarray(solver.y).copy()

    def _keep_until(self, dense: Any, before: float, end: float) -> None:
        while self.waiting and self.waiting[0] <= end:
            when = self.waiting.pop(0)
            if when > before:
                self.keep(when, dense(when))

    # events

    def _guards(self, t: float, y: Array) -> list[Guard]:
        """What may end the segment that begins."""
        out = [Guard("rest", int(k), float(self.toward[k])) for k in np.flatnonzero(self.rubs & ~self.locked)]
        out += [Guard("contact", c, float(s)) for c, s in enumerate(self.sense)]
        for k, motor in self.moving.motors.items():
            out += [Guard(key, k, at=s[1]) for key, s in self._switches(k)]
            out += [Guard("kink", k, at=w) for w in motor.kinks]
        out += [Guard("condition", n) for n in range(len(self.conditions))]
        size = max(float(np.abs(y[: 2 * self.d]).max()), 1.0)
        for g in out:
            value = 0.0 if g.side else self._value(g, t, y)
            g.side = g.side or (float(np.sign(value)) if abs(value) > 1e-12 * size else 0.0)
        return out

    def _value(self, g: Guard, t: float, y: Array) -> float:
        """What a guard watches the sign of."""
        q, u = y[: self.d], y[self.d : 2 * self.d]
        if g.kind == "contact":
            return float(self.at(t, y)[2].rates[g.which])
        if g.kind == "condition":
            return self.conditions[g.which](t, q, u)
        if g.kind in ("on", "off"):
            switch = getattr(self.moving.motors[g.which], g.kind)
            return self.moving.switched(switch, g.which, t, q, u)
        return float(u[g.which] - g.at)

    def _crossed(self, g: Guard, t: float, y: Array) -> bool:
        value = self._value(g, t, y)
        if not g.side:
            g.side = float(np.sign(value))
            return False
        return value * g.side < 0

    def _root(self, g: Guard, dense: Any, before: float, after: float) -> float:
        def value(t: float) -> float:
            return self._value(g, t, dense(t)) * g.side

        if value(before) <= 0:
            return before
        return float(brentq(value, before, after, xtol=1e-15 * max(after, 1e-300) + 1e-300, rtol=1e-15))

    def _happen(self, t: float, y: Array, crossed: list[Guard]) -> None:
        """What follows from events at one instant; the state may be changed."""
        d = self.d
        rests = [g.which for g in crossed if g.kind == "rest"]
        for g in crossed:
            small = STILL * max(float(self.fastest.max()), 1e-300)
            stands = [int(k) for k in np.flatnonzero(self.rubs & ~self.locked) if abs(y[d + k]) <= small]
            if g.kind == "contact" and not stands:
                self.sense[g.which] *= -1
                self.note(
                    t, "reversal", f"{self.equation.joints[g.which]} reverses: its friction turns round"
                )
            elif g.kind == "contact":
                rests += [k for k in stands if k not in rests]
            elif g.kind in ("on", "off"):
                self.moving.on[g.which] = g.kind == "on"
                self.switched.add((g.which, g.kind))
                self.note(
                    t, f"motor {g.kind}", f"the motor of {self.moving.names[g.which]} is switched {g.kind}"
                )
            elif g.kind == "condition":
                c = self.conditions[g.which]
                self.note(t, "condition", c.text)
                self.ended = f"{c.text} at {t:.6g} s" if c.stops else self.ended
        for k in dict.fromkeys(rests):
            y[d + k] = 0.0
            self._settle(k, t, y)

    def _release(self, before: float, from_: Array, dense: Any, after: float) -> tuple[float, Array]:
        """The instant at which a locked drive is let go, by halving."""
        low, high = before, after
        while high - low > 1e-13 * max(high, 1e-300):
            middle = (low + high) / 2
            if middle in (low, high):
                break
            low, high = (middle, high) if self._still_held(middle, dense(middle)) else (low, middle)
        y = self._exactly(before, from_, high)
        self._keep_until(dense, before, high)
        for k in self._held(high, y):
            self._settle(k, high, y)
        self.keep(high, y)
        return high, y

    def _rest(self, t: float, y: Array) -> float:
        """All that forces move stands: until it is no longer held, or to the end."""
        end = self.end if np.isfinite(self.end) else t
        when = self._let_go(t, end, y)
        while self.waiting and self.waiting[0] <= when:
            self.keep(self.waiting.pop(0), y)
        if when >= end:
            self.ended = f"at rest from {t:.6g} s on"
            if self.track.rows[-1][0] < end:
                self.keep(end, y)
            return self.end
        for k in self._held(when, y):
            self._settle(k, when, y)
        self.keep(when, y)
        return when
