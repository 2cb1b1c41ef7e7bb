"""A motion under forces as segments that are smooth, each ended by an event: nothing is smoothed, nothing skipped.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any

import numpy as np
from scipy.optimize import brentq

from dalembert.arrays import Array, Flags
from dalembert.machine.motion.actuation import Actuation
from dalembert.machine.motion.coordinates.dead_centres import WATCHED, LeadState
from dalembert.machine.motion.equation import DEAD_CENTRE, StoppedError
from dalembert.machine.motion.occurrences import Condition, Guard, Value, Words
from dalembert.machine.motion.standstill import STILL
from dalembert.machine.motion.steps import LEAST, Between, Integrator, MachineSteps, Steps, between
from dalembert.model import Mechanism
from dalembert.model.drives.motors import Switch

SHORT, TRIES = 1e-6, 100
"""A step below this part of the longest has met something: a singular position; so many are no progress."""
MANY_STEPS, NEVER = 1000, 1e-9
"""A segment that after so many steps has got on by less than this part of its time a step never arrives."""
COARSEST = 1e-9
"""Tolerance up to which steps with friction are taken again that are refused."""
CHATTER, MANY = 1e-9, 40
"""So many events within this part of the time that has gone by are chatter."""


class Integration(LeadState):
    """One run from a start to an end."""

    def __init__(
        self,
        m: Mechanism,
        actuation: Actuation,
        end: float,
        times: Array | None,
        conditions: Sequence[Condition],
        tolerance: float,
    ) -> None:
        super().__init__(m, actuation)
        self.end, self.conditions, self.tolerance = end, conditions, tolerance
        self.waiting = None if times is None else list(times)
        self.ended: Words = ()
        self.samples: list[tuple[float, Array]] = []
        self.parts: list[Array] = []
        self.ends: list[float] = []

    def keep(self, t: float, y: Array) -> None:
        """Keep an instant; in machine code together with those of its segment."""
        if self.samples or self._machine(t, y) is not None:
            self.samples.append((t, Between.standing(t, y).record))
            return
        d = self.d
        found, effort, _ = self.solved(t, y)
        self.parts.append(np.where(self._told, found.part, np.nan))
        q, u = y[:d].copy(), y[d : 2 * d].copy()
        on_stop = np.where(self.on_stop != 0, self.acting.effort(t, q, u), np.nan)
        self.rows.append((t, q, u, found.a, effort, y[2 * d :].copy(), on_stop, self.joint_forces(t, y)))

    @property
    def _told(self) -> Flags:
        """Contacts (E,) whose friction the motion tells where they have no rate: not those that rest by a range."""
        told = self.stuck.copy()
        if self.equation.dry and not self.locked.any():
            told[self.equation.dry.own] = True
        return told

    def keep_samples(self) -> None:
        """Keep the instants of the segment that wait, all at once, before anything else happens."""
        if self.samples:
            t, records = (np.array(x) for x in zip(*self.samples, strict=True))
            self.samples, y = [], between(records, t)
            code = self._machine(t[0], y[0])
            assert code is not None
            self._keep_rates(*code, t, y)

    def _keep_rates(self, code: Integrator, values: Array, t: Array, y: Array) -> None:
        """Keep instants (M,) with the accelerations of the machine code; efforts that are asked for come later: NaN."""
        d = self.d
        a, (first, slope, brake, _) = code.rates(values, t, y)[:, d : 2 * d], values[-4 * d :].reshape(4, d)
        applied = np.where(self.acting.free & ~self.locked, first + slope * y[:, d : 2 * d] + brake, np.nan)
        on_stop = np.where(self.on_stop != 0, first + slope * y[:, d : 2 * d], np.nan)
        works = y[:, 2 * d :].copy()
        stops = np.repeat(self.joint_forces(t[0], y[0])[None], len(t), axis=0)
        self.rows += zip(
            t.tolist(), y[:, :d], y[:, d : 2 * d], a, applied, works, on_stop, stops, strict=True
        )

    def run(self, t: float = 0.0, works: Array | None = None) -> None:
        """Integrate from the start until the end, a condition that stops, a state from which nothing goes on, or one
        where other freedoms should lead."""
        start, done = self.acting, np.zeros(self.d + 4) if works is None else works
        self.reached = t, y = t, np.concatenate([start.position, start.speed, done])
        try:
            self._settle_start(t, y)
            self.keep(t, y)
            while t < self.end and not self.ended and not self.turned_over:
                if self._all_rest():
                    t = self._rest(t, y)
                else:
                    t, y = self._segment(t, y)
                self._watch_chatter(t)
            self.keep_samples()
        except StoppedError as error:
            self.stop(error)

    def stop(self, error: StoppedError) -> None:
        """End where nothing goes on."""
        self.keep_samples()
        if self.rows and self.reached[0] > self.rows[-1][0]:
            with suppress(StoppedError):
                self.keep(*self.reached)
                self.keep_samples()
        t = self.rows[-1][0] if self.rows else 0.0
        self.ended = ("stopped at ", ("time", t), f": {error}")
        self.note(t, "stopped", *self.ended)

    def _all_rest(self) -> bool:
        """Whether what forces move is held, and what is prescribed stands."""
        return bool((self.locked | ~self.acting.free | self.bound).all() and not self._others_move())

    def _watch_chatter(self, t: float) -> None:
        self.ends = [*self.ends[-MANY:], t]
        if len(self.ends) > MANY and t - self.ends[0] <= CHATTER * max(t, 1e-300):
            raise StoppedError(
                f"{MANY} events within {t - self.ends[0]:.1e} s: what comes to rest there starts again without end"
            )

    def _segment(self, t: float, y: Array) -> tuple[float, Array]:
        """To the first event, or the end."""
        guards, self.watch = self._guards(t, y), WATCHED
        self.is_heavy(t, y)
        solver, tiny, longest, steps = self._solver(t, y, min(self.end, self.next_bend(t))), 0, 0.0, 0
        if isinstance(solver, MachineSteps) and not guards and self.waiting is not None:
            longest = self._unwatched(solver, t)
        while solver.status == "running":
            before, from_ = self.reached = solver.t, solver.y
            steps += 1
            if steps > MANY_STEPS and before - t < steps * NEVER * (self.end - t) < np.inf:
                raise StoppedError("there the steps become too small, as where friction nearly jams")
            if solver.step():
                if self.equation.dry and self.tolerance < COARSEST and not self._near_singular(before, from_):
                    self.tolerance *= 10  # forces with friction are found to fewer digits than that
                    return before, from_
                raise StoppedError(self.refusal or "there the steps of the integration become too small")
            self.refusal, longest = "", max(longest, solver.h_previous or 0.0)
            if self.nears_dead_centre(solver.t, solver.y, (solver.h_previous or 0.0) / (longest or 1.0)):
                return self._turn_over(solver, before)
            if solver.status == "running" and solver.h_abs < SHORT * longest:
                self._near_singular(solver.t, solver.y)
                tiny += 1
                if tiny > TRIES:
                    raise StoppedError(
                        "there the steps become too small, as where something has next to no inertia"
                    )
            dense: Any = None
            crossed = [g for g in guards if g.kind == "stop" or self._crosses(g, solver.t, solver.y)]
            if crossed:
                dense = solver.dense_output()
                roots = [self._root(g, dense, before, solver.t) for g in crossed]
                earliest = min(roots)
                once = earliest + 1e-13 * solver.t
                first = [
                    g
                    for g, x in zip(crossed, roots, strict=True)
                    if x <= (once if g.kind == "stop" else earliest)
                ]
            if crossed and earliest <= solver.t:
                when, y = self._meet(first[0], earliest, before, from_)
                self._keep_until(dense, before, when)
                self._happen(when, y, first)
                self.keep(when, y)
                return when, y
            if (self.locked & self.acting.free).any() and self._loose(solver.t, solver.y):
                dense = solver.dense_output()
                when = self._loosening(before, solver.t, dense)
                y = self._exactly(before, from_, when)
                self._keep_until(dense, before, when)
                self._resume(when, y)
                return when, y
            self.fastest = np.maximum(self.fastest, np.abs(solver.y[self.d : 2 * self.d]))
            if self.waiting is None:
                self.keep(solver.t, solver.y)
            elif self.waiting and self.waiting[0] <= solver.t:
                self._keep_until(solver.dense_output(), before, solver.t)
        return solver.t, solver.y

    def _turn_over(self, solver: Steps | MachineSteps, before: float) -> tuple[float, Array]:
        """End where other freedoms should lead."""
        self._keep_until(solver.dense_output(), before, solver.t)
        self.keep_samples()
        self.turned_over, self.reached = True, (solver.t, solver.y.copy())
        if self.rows[-1][0] < solver.t:
            self.keep(*self.reached)
        return self.reached

    def _unwatched(self, solver: MachineSteps, t: float) -> float:
        """Take many steps at a time where nothing may happen, until one is short; the longest."""
        longest, d, n = 0.0, self.d, solver.n
        while solver.status == "running" and not (self.locked & self.acting.free).any():
            records = solver.ahead()
            lengths = records[:, 1]
            most = float(lengths.max(initial=longest))
            if not lengths.size or lengths.min() <= max(SHORT * most, NEVER * (self.end - t)):
                break
            longest = most
            speeds = np.abs(records[:, 2 + n + d : 2 + n + 2 * d])
            self.fastest = np.maximum(self.fastest, speeds.max(axis=0))
            slow = (speeds[:, self.acting.free] < WATCHED * self.fastest[self.acting.free]).any(axis=1)
            watched = records[slow | (lengths < WATCHED * most)] if self.may_turn_over else records[:0]
            if any(self.is_heavy(r[0], r[2 : 2 + n]) for r in watched):
                break
            solver.take_all()
            self._keep_within(records, solver)
        return longest

    def _keep_within(self, records: Array, solver: MachineSteps) -> None:
        """Keep the instants that wait, within steps up to the solver's time."""
        assert self.waiting is not None
        count = bisect_right(self.waiting, solver.t)
        t, self.waiting = self.waiting[:count], self.waiting[count:]
        places = (np.searchsorted(records[:, 0], t) - 1).tolist()
        self.samples += [(x, records[k]) for x, k in zip(t, places, strict=True) if k >= 0 and x < solver.t]
        if t and t[-1] == solver.t:
            self.keep(solver.t, solver.y)

    def _near_singular(self, t: float, y: Array) -> bool:
        """Raise StoppedError at a dead centre or change point, where two ways go on; otherwise False."""
        if (self.at(t, y)[2].closure < 0).any():
            raise StoppedError(DEAD_CENTRE)
        return False

    def _solver(self, t: float, y: Array, end: float) -> Steps | MachineSteps:
        code = self._machine(t, y)
        if code is not None:
            return MachineSteps(
                *code, t, y, end, self.tolerance, bool(self.waiting and len(self.waiting) > 1)
            )
        return Steps(self.rate, t, y, end, rtol=self.tolerance, atol=self.tolerance * LEAST)

    def _machine(self, t: float, y: Array) -> tuple[Integrator, Array] | None:
        """Machine code and its values, where the efforts are straight lines of the speeds until the next event."""
        free = self.acting.free & ~self.locked
        if self.pressed:
            return None
        ahead = self.at(t, y)[0] if self.acting.motors else np.zeros(self.d)
        lines = self.acting.lines(y[self.d : 2 * self.d], ahead)
        code = None if lines is None else self.equation.steps(free)
        if code is None or lines is None:
            return None
        brake = -self.acting.brake * self.toward * free
        given = np.where(self.acting.free, 0.0, self.acting.acceleration)
        return code, np.concatenate([self.equation.values, *lines, brake, given])

    def _exactly(self, t: float, y: Array, when: float) -> Array:
        """The state at an instant within a step, integrated and not interpolated."""
        solver = self._solver(t, y, when)
        while solver.status == "running":
            solver.step()
        return np.asarray(solver.y).copy()

    def _meet(self, g: Guard, when: float, t: float, y: Array) -> tuple[float, Array]:
        """The instant near ``when`` at which a guard passes zero, by the motion itself from (t, y), and the state."""
        there = self._exactly(t, y, when) if when > t else y.copy()
        for _ in range(2 if self.equation.dry and when > t else 0):  # else it is exact to rounding
            short = 1e-3 * (when - t)
            slope = (
                g.value(when + short, there + short * self.rate(when, there)) - g.value(when, there)
            ) / short
            later = when - g.value(when, there) / slope if slope else when
            if not t < later < self.end or abs(later - when) > short:
                break
            when, there = float(later), self._exactly(t, y, float(later))
        return when, there

    def _keep_until(self, dense: Callable[[float], Array], before: float, end: float) -> None:
        while self.waiting and self.waiting[0] <= end:
            when = self.waiting.pop(0)
            if when > before and isinstance(dense, Between):
                self.samples.append((when, dense.record))
            elif when > before:
                self.keep(when, dense(when))

    # events

    def _guards(self, t: float, y: Array) -> list[Guard]:
        """What may end the segment that begins: each a quantity whose sign is watched."""
        d, acting = self.d, self.acting

        def speed(k: int, less: float = 0.0) -> Value:
            return lambda t, y: float(y[d + k] - less)

        def rate(c: int) -> Value:
            return lambda t, y: float(self.rubbing_rates(t, y)[c])

        def room(c: int) -> Value:
            return lambda t, y: float(self.own(self.solved(t, y)[0].room)[c])

        def switch(k: int, of: Switch) -> Value:
            return lambda t, y: acting.switched(of, k, t, y[:d], y[d:])

        rubbing = np.flatnonzero(self.rubs & ~self.locked & ~self.bound).tolist()
        out = [Guard("rest", k, speed(k), float(self.toward[k])) for k in rubbing]
        out += [Guard("contact", c, rate(c), float(s)) for c, s in enumerate(self.sense) if not self.tied[c]]
        out += [Guard("slip", c, room(c), 1.0) for c in np.flatnonzero(self.own(self.stuck)).tolist()]
        for k, motor in acting.motors.items():
            out += [Guard(key, k, switch(k, of)) for key, of in self._switches(k)]
            out += [Guard("kink", k, speed(k, w)) for w in motor.kinks]
        out += self.stop_guards()
        out += [Guard("condition", n, c.value_at(d)) for n, c in enumerate(self.conditions)]
        size = max(float(np.abs(y[: 2 * d]).max()), 1.0)
        for g in out:
            value = 0.0 if g.side else g.value(t, y)
            g.side = g.side or (float(np.sign(value)) if abs(value) > 1e-12 * size else 0.0)
        return out

    def _crosses(self, g: Guard, t: float, y: Array) -> bool:
        value = g.value(t, y)
        if not g.side:
            g.side = float(np.sign(value))
            return False
        return value * g.side < 0

    def _root(self, g: Guard, dense: Callable[[float], Array], before: float, after: float) -> float:
        if g.kind == "stop":
            when = self.strikes(g, dense, before, after)
            return np.inf if when is None else when

        def value(t: float) -> float:
            return g.value(t, dense(t)) * g.side

        if value(before) <= 0:
            return before
        return float(brentq(value, before, after, xtol=1e-15 * max(after, 1e-300) + 1e-300, rtol=1e-15))

    def _happen(self, t: float, y: Array, crossed: list[Guard]) -> None:
        """What follows from events at one instant; the state may be changed."""
        self.keep_samples()
        d = self.d
        rests = [g.which for g in crossed if g.kind == "rest"]
        hit = [(g.which, -g.side) for g in crossed if g.kind == "stop"]
        if hit:
            self.strike(hit, t, y)
        touched = [g.which for g in crossed if g.kind in ("contact", "slip")]
        if touched:
            small = STILL * max(float(self.fastest.max()), 1e-300)
            stands = np.flatnonzero(self.rubs & ~self.locked & ~self.bound & (np.abs(y[d : 2 * d]) <= small))
            rests = list(dict.fromkeys([*rests, *stands.tolist()]))
        for g in crossed:
            if g.kind == "hold":
                self.leave(g.which, t)
            elif g.kind in ("on", "off"):
                self._switch(t, g.which, g.kind)
            elif g.kind == "condition":
                c = self.conditions[g.which]
                self.note(t, "condition", c.text)
                self.ended = (f"{c.text} at ", ("time", t)) if c.stops else self.ended
        y[[d + k for k in rests]] = 0.0
        if rests or touched:
            leaving = [g.which for g in crossed if g.kind == "slip"]
            decided = self.settle(rests, t, y, leaving)
            for e in set(touched) - {*decided}:
                self.sense[e] *= -1
                joint = self.equation.joints[e]
                self.note(t, "reversal", f"{joint} reverses: its friction turns round", of=joint)

    def _resume(self, t: float, y: Array) -> None:
        """Let go what is no longer held."""
        self.keep_samples()
        self.settle(self._loose(t, y), t, y, self.leaving(t, y))
        self.keep(t, y)

    def _rest(self, t: float, y: Array) -> float:
        """All that forces move stands: until it is no longer held, or to the end."""
        self.keep_samples()
        end = self.end if np.isfinite(self.end) else t
        when = self._let_go(t, end, y)
        self._keep_until(lambda _: y, t, when)
        if when < end:
            self._resume(when, y)
            return when
        self.ended = ("at rest from ", ("time", t), " on")
        self.keep_samples()
        if self.rows[-1][0] < end:
            self.keep(end, y)
        return self.end
