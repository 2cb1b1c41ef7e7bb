"""Steps of a motion: by which solver and of which size, the instants that are kept, and what may end a segment.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from dalembert.arrays import Array, Flags
from dalembert.machine.motion.actuation import Actuation
from dalembert.machine.motion.coded.coded_motion import CodedState
from dalembert.machine.motion.coded.steps import (
    Between,
    Integrator,
    MachineSteps,
    Steps,
    between,
    state_sizes,
)
from dalembert.machine.motion.equation import OPEN, StoppedError
from dalembert.machine.motion.occurrences import (
    ROUNDING,
    TURNING,
    EventCondition,
    Guard,
    Value,
    Words,
    less,
)
from dalembert.machine.motion.rest.standstill import EVEN
from dalembert.machine.motion.stops.watched_quantities import watched
from dalembert.model import Mechanism
from dalembert.model.drives.motors import Switch


@dataclass(frozen=True)
class Limits:
    """Limits at which a motion that only conditions end is stopped: number of steps of the integration, and time, s."""

    steps: int = 10_000
    time: float = 1e5


NO_TIME = Limits()
FLICKERS = 10
"""Segments in turn, each of a step or two, after which a contact's change of sides, as of one without a force, ends
none."""


class StepState(CodedState):
    """A motion's steps: their solvers, the instants that are kept, and what may end a segment."""

    def __init__(
        self,
        m: Mechanism,
        actuation: Actuation,
        end: float,
        times: Array | None,
        conditions: Sequence[EventCondition],
        tolerance: float,
        limits: Limits = NO_TIME,
    ) -> None:
        super().__init__(m, actuation)
        self.limits, self.taken, self.status = limits, 0, "ended"
        self.end, self.conditions, self.tolerance = end, conditions, tolerance
        self.natural = (np.ones((1, 1)), np.ones(1))
        self.inertia = np.full(self.d, np.inf)  # least so far, reduced to each drive
        self.waiting = None if times is None else list(times)
        self.ended: Words = ()
        self.flickers, self.bears = 0, dict[int, float]()
        self.samples: list[tuple[float, Array]] = []
        self.parts: list[Array] = []
        self.ends: list[float] = []
        self.progress: Callable[[int, int], None] | None = None
        self.count = len(self.waiting or ())

    def report_progress(self) -> None:
        """Reports the instants that are reached, and their count."""
        if self.progress is not None and self.waiting is not None:
            self.progress(self.count - len(self.waiting), self.count)

    def keep(self, t: float, y: Array) -> None:
        """Keep an instant; in machine code together with those of its segment."""
        if self.samples or self.machine(t, y) is not None:
            self.samples.append((t, Between.standing(t, y).record))
        else:
            self._keep_solved(t, y)

    def _keep_solved(self, t: float, y: Array) -> None:
        """Keep an instant by the solution in numpy."""
        d = self.d
        contacts, effort, _ = self.solved(t, y)
        self.parts.append(np.where(self._determined, contacts.part, np.nan))
        q, u = y[:d].copy(), y[d : 2 * d].copy()
        on_stop = np.where(self.on_stop != 0, self.acting.effort(t, q, u), np.nan)
        works = y[2 * d : 3 * d + 4].copy()
        self.rows.append((t, q, u, contacts.a, effort, works, on_stop, self.joint_forces(t, y)))

    @property
    def _determined(self) -> Flags:
        """Contacts (E,) whose sense the motion gives where they have no rate: not those that rest within a range."""
        determined = self.stuck.copy()
        if self.equation.dry and not self.locked.any():
            determined[self.equation.dry.own] = True
        return determined

    def keep_samples(self) -> None:
        """Keep the instants of the segment that wait, all at once, before anything else happens."""
        if self.samples:
            t, records = (np.array(x) for x in zip(*self.samples, strict=True))
            self.samples, y = [], between(records, t)
            code = self.machine(t[0], y[0])
            assert code is not None
            sure = np.asarray(np.isfinite(code[0].rates(code[1], t, y)).all(axis=1))
            if sure.all():
                self._keep_rates(*code, t, y)
                return
            for k in range(len(t)):
                if sure[k]:
                    self._keep_rates(*code, t[k : k + 1], y[k : k + 1])
                else:
                    self._keep_solved(float(t[k]), y[k])

    def _keep_rates(self, code: Integrator, values: Array, t: Array, y: Array) -> None:
        """Keeps instants (M,) with the accelerations of the machine code; unknown efforts come later: NaN."""
        d, own = self.d, len(self.sense)
        rates, watched = code.rates_watched(values, t, y)
        a, (first, slope, brake, _) = (
            rates[:, d : 2 * d],
            values[len(self.equation.values) :][: 4 * d].reshape(4, d),
        )
        known = self.acting.free & ~self.locked
        if self.equation.dry:
            known = self.acting.free
            parts = np.full((len(t), len(self.stuck)), np.nan)
            if not self.locked.any():
                place = 2 * own + 2 * len(self.sided)
                part = watched[:, place : place + own] if code.watched > place else self.sense
                parts[:, self.equation.dry.own] = part
            self.parts += list(parts)
        applied = np.where(known, first + slope * y[:, d : 2 * d] + brake, np.nan)
        on_stop = np.where(self.on_stop != 0, first + slope * y[:, d : 2 * d], np.nan)
        works = y[:, 2 * d :].copy()
        stops = np.repeat(self.joint_forces(t[0], y[0])[None], len(t), axis=0)
        self.rows += zip(
            t.tolist(), y[:, :d], y[:, d : 2 * d], a, applied, works, on_stop, stops, strict=True
        )

    def _keep_within(self, records: Array, solver: MachineSteps) -> None:
        """Keep the instants that wait, within steps up to the solver's time."""
        assert self.waiting is not None
        count = bisect_right(self.waiting, solver.t)
        t, self.waiting = self.waiting[:count], self.waiting[count:]
        places = (np.searchsorted(records[:, 0], t) - 1).tolist()
        self.samples += [(x, records[k]) for x, k in zip(t, places, strict=True) if k >= 0 and x < solver.t]
        if t and t[-1] == solver.t:
            self.keep(solver.t, solver.y)

    def _solver(self, t: float, y: Array, end: float) -> Steps | MachineSteps:
        code, natural = self.machine(t, y), self._natural(t, y)
        if code is not None:
            more = bool(self.waiting and len(self.waiting) > 1)
            return MachineSteps(*code, t, y, end, self.tolerance, natural, more)
        return Steps(self.rate, t, y, end, self.tolerance, natural, self.acting.longest_step)

    def _natural(self, t: float, y: Array) -> tuple[Array, Array]:
        """Natural sizes (1, n) of the state's numbers, and pace (1,); within a segment in machine code those at its
        start."""
        if self.coded is not None:
            return self.natural
        with suppress(StoppedError):  # else those of before
            a, _, terms = self.at(t, y)
            u = np.maximum(np.abs(y[self.d : 2 * self.d]), self.fastest)
            self.inertia = np.minimum(self.inertia, np.abs(terms.mass.diagonal()))
            sizes, pace = state_sizes(u[None], a[None], self.lengths, terms.mass.diagonal()[None])
            late = [[max(map(abs, self.acting.motors[k].effort)) for k in self.acting.late]]
            self.natural = np.concatenate([sizes, np.array(late)], axis=1), pace
        return self.natural

    def pace(self, t: float, y: Array) -> float:
        """Natural pace at a state, 1/s."""
        return float(self._natural(t, y)[1][0])

    def _exactly(self, t: float, y: Array, when: float) -> Array:
        """The state at an instant within a step, integrated and not interpolated."""
        solver = self._solver(t, y, when)
        while solver.status == "running":
            solver.step()
        if solver.status == "failed" and self.coded is not None:
            self.coded, self.careful = None, True
            self.forget()
            return self._exactly(t, y, when)
        return np.asarray(solver.y).copy()

    def _keep_until(self, dense: Callable[[float], Array], before: float, end: float) -> None:
        while self.waiting and self.waiting[0] <= end:
            when = self.waiting.pop(0)
            if when > before and isinstance(dense, Between):
                self.samples.append((when, dense.record))
            elif when > before:
                self.keep(when, dense(when))

    # events

    def _guards(self, t: float, y: Array) -> list[Guard]:
        """Quantities whose change of sign may end the segment that begins."""
        d, acting = self.d, self.acting

        def speed(k: int, less: float = 0.0) -> Value:
            return lambda t, y: float(y[d + k] - less)

        def rate(c: int) -> Value:
            return lambda t, y: float(self.rubbing_rates(t, y)[c])

        def room(c: int) -> Value:
            return lambda t, y: float(self.room(t, y)[c])

        def margin(k: int) -> Value:
            return lambda t, y: float(self.margins(t, y)[k])

        def switch(k: int, of: Switch) -> Value:
            return lambda t, y: acting.switched(of, k, t, y[:d], y[d:])

        def bend(j: int) -> Value:
            return lambda t, y: float(self.equation(t, y[:d], y[d : 2 * d]).corners[j])

        rubbing = np.flatnonzero(self.rubs & ~self.locked & ~self.bound).tolist()
        n, own, sided = 3 * d + 4, len(self.sense), len(self.sided)
        self.forget()
        out = [Guard("rest", k, speed(k), float(self.toward[k]), column=d + k) for k in rubbing]
        slipping = [(c, float(s)) for c, s in enumerate(self.sense) if not self.tied[c]]
        out += [Guard("contact", c, rate(c), s, column=n + c) for c, s in slipping]
        sticking = np.flatnonzero(self.own(self.stuck)).tolist()
        least = EVEN * np.abs(self.own(self.solved(t, y)[0].cz)) if sticking else self.sense
        place = n + own + 2 * sided
        out += [Guard("slip", c, room(c), 1.0, column=place + c, least=float(least[c])) for c in sticking]
        if not self.pressed and self.flickers < FLICKERS:
            new = self.bears
            out += [Guard("side", k, margin(k), new.get(k, 0.0), column=n + own + k) for k in self._sliding()]
        for k, motor in acting.motors.items():
            out += [Guard(key, k, switch(k, of)) for key, of in self._switches(k)]
            out += [Guard("kink", k, speed(k, w), column=d + k, level=w) for w in motor.kinks]
        out += [Guard("kink", j, bend(j)) for j in range(-self.equation.bends, 0)]
        out += self.gear_guards(t, y)
        out += self.corner_guards()
        out += self.stop_guards()
        values = [less(watched(self, c.name), c.value) if c.name else c.value_at(d) for c in self.conditions]
        places = [-1 if c.name else c.place(d) for c in self.conditions]
        levels = [c.value for c in self.conditions]
        met = enumerate(zip(values, places, levels, strict=True))
        out += [Guard("condition", n, value, column=k, level=level) for n, (value, k, level) in met]
        self.take_side([g for g in out if g.kind != "side"], t, y)
        return out

    def _sliding(self) -> list[int]:
        """Margins of the contacts that slip; only one of those without a tilting force."""
        dry, count = self.equation.dry, len(self.sided)
        margins = [k for k in range(2 * count) if not self.stuck[self.sided[k % count]]]
        return [
            k for k in margins if k < count or (dry and dry.contacts.read[2, self.sided[k - count]].any())
        ]

    def take_side(self, guards: Sequence[Guard], t: float, y: Array) -> None:
        """The sides on which guards begin."""
        for g in guards:
            if g.kind == "side":
                g.value(t, y)
                g.least = ROUNDING * self.bearing
            g.side = g.side or (0.0 if g.at_zero(t, y, self.d) else float(np.sign(g.value(t, y))))

    def _crosses(self, g: Guard, t: float, y: Array) -> bool:
        value = g.value(t, y)
        if not g.side:
            g.side = float(np.sign(value)) if abs(value) > g.least else 0.0
            return False
        return value * g.side < -g.least

    def _look_within(self, guards: Sequence[Guard], solver: Steps | MachineSteps, before: float) -> None:
        """Find the first instants at which guards are beyond zero within the last step, of those whose values do not
        choose the steps."""
        for g in guards:
            if g.anywhere and g.side:
                g.look_within(solver.dense_output, before, solver.t, solver.y)

    def _dips(self, g: Guard, solver: Steps | MachineSteps, before: float) -> bool:
        """True if a corner, a condition or a tooth is passed within the last step, which ends on its first side; called
        behind ``_look_within``."""
        if g.kind not in TURNING or not g.side:
            return False
        if g.anywhere:
            return bool(np.isfinite(g.turned))
        t, y, h = solver.t, solver.y, solver.t - before
        short = 1e-6 * h
        came, g.trend = g.trend, (g.value(t, y) - g.value(t - short, y - short * solver.ahead_rate)) * g.side
        if not came < 0 < g.trend:
            return False
        dense = solver.dense_output()
        low = minimize_scalar(
            lambda t: g.value(t, dense(t)) * g.side,
            bounds=(before, t),
            method="bounded",
            options={"xatol": short},
        )
        g.turned = float(low.x) if low.fun < 0 else np.inf
        return bool(low.fun < 0)

    def _root(self, g: Guard, dense: Callable[[float], Array], before: float, after: float) -> float:
        if g.kind == "stop":
            when = self.strikes(g, dense, before, after)
            return np.inf if when is None else when

        begins = g.kind == "slip" and g.value(before, dense(before)) <= g.least
        rounding = g.least if begins else 0.0  # it begins at its limit, and leaves it first

        def value(t: float) -> float:
            return g.value(t, dense(t)) * g.side + rounding

        after = min(after, g.turned)
        first, last = value(before), value(after)
        if not np.isfinite(first + last):
            raise StoppedError(OPEN)
        if first <= 0:
            return before
        if last >= 0:  # beyond zero by the state's own rounding alone
            return after
        near = (
            1e-15 * max(after, 1e-300) + 1e-300 + (ROUNDING * (after - before) if g.kind == "side" else 0.0)
        )
        return float(brentq(value, before, after, xtol=near, rtol=1e-15))
