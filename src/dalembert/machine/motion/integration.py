"""A motion under forces as smooth segments, each ended by an event, without smoothing or skipping any.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import numpy as np

from dalembert.arrays import Array
from dalembert.machine.motion.coded.steps import (
    UNWATCHED,
    MachineSteps,
    Steps,
)
from dalembert.machine.motion.coded.steps import WATCHED as WATCHED_STEPS
from dalembert.machine.motion.coordinates.dead_centres import WATCHED
from dalembert.machine.motion.equation import DEAD_CENTRE, StoppedError
from dalembert.machine.motion.occurrences import Guard, Words
from dalembert.machine.motion.rest.standstill import STILL
from dalembert.machine.motion.stepping import StepState

SHORT, TRIES = 1e-6, 100
"""A step below this part of the longest has met a singular position; after this many of them the motion is stopped."""
MANY_STEPS, NEVER = 1000, 1e-9
"""A segment that after this many steps advances by less than this part of its time per step never arrives."""
FAR = 1e3
"""Radians, or sizes of a link, that lie between two instants at most."""
COARSEST = 1e-9
"""Tolerance up to which steps with friction are taken again that are refused."""
BEYOND = 1e-12
"""Part of a step's change of what switches a load by which it is beyond its corner for all that analyse it."""
UNBOUNDED = 1e8
"""An inertia reduced to a drive that is so many times its least is that of a dead centre: the drive moves by less than
1e-4 of what it moves elsewhere for the same speed of the links."""
LIGHT = "the integration steps become too small, as where a part has almost no inertia"
MOST_EVENTS = 10_000
"""Events of one motion at most."""
CHATTER, MANY = 1e-9, 40
"""So many events within this part of the time that has gone by are chatter."""


class Integration(StepState):
    """One run from a start to an end."""

    def run(self, t: float = 0.0, works: Array | None = None) -> None:
        """Integrate from the start until the end, a condition that stops, a state from which no motion continues, or
        one where other freedoms should lead."""
        start, done = self.acting, np.zeros(self.d + 4 + len(self.acting.late)) if works is None else works
        self.reached = t, y = t, np.concatenate([start.position, start.speed, done])
        try:
            self._settle_start(t, y)
            self.keep(t, y)
            while t < self.end and not self.ended and not self.turned_over:
                if self._all_rest() and not self.torques_change(y):
                    t = self._rest(t, y)
                else:
                    t, y = self._segment(t, y)
                if not self.ended and t < self.end:
                    self._watch_chatter(t)
            self.keep_samples()
        except StoppedError as error:
            self.stop(error)
        except KeyboardInterrupt:
            self._interrupted()

    def _interrupted(self) -> None:
        """End with what there is."""
        if not self.rows:
            raise KeyboardInterrupt
        self.parts, self.status, t = self.parts[: len(self.rows)], "interrupted", float(self.rows[-1][0])
        self.ended = ("interrupted at ", ("time", t))
        self.note(t, "interrupted", *self.ended)

    def _give_up(self, t: float, y: Array) -> None:
        """End where no condition has been met within the limits."""
        self.keep_samples()
        if self.rows[-1][0] < t:
            self.keep(t, y)
            self.keep_samples()
        end: Words = (f" within {self.taken} steps, to ", ("time", t))
        if t >= self.limits.time:
            end = (" until ", ("time", t))
        self.status, self.ended = "not_met", (f"{self._awaited} not met", *end)
        self.note(t, "not met", *self.ended)

    @property
    def _awaited(self) -> str:
        """Conditions that are to end it."""
        awaited = [c.text for c in self.conditions if c.stops]
        return " or ".join(awaited) + (" is" if len(awaited) == 1 else " are")

    def stop(self, error: StoppedError) -> None:
        """Ends the motion where it cannot continue."""
        self.keep_samples()
        if self.rows and self.reached[0] > self.rows[-1][0]:
            with suppress(StoppedError):
                self.keep(*self.reached)
                self.keep_samples()
        t = self.rows[-1][0] if self.rows else 0.0
        self.status, self.ended = "stopped", ("stopped at ", ("time", t), f": {error}")
        self.note(t, "stopped", *self.ended)

    def _all_rest(self) -> bool:
        """True if all drives moved by forces are held, and prescribed ones are at rest."""
        return bool((self.locked | ~self.acting.free | self.bound).all() and not self._others_move())

    def _watch_chatter(self, t: float) -> None:
        if len(self.events) > MOST_EVENTS:
            raise StoppedError(f"{MOST_EVENTS} events have happened; ask for a shorter time")
        self.ends = [*self.ends[-MANY:], t]
        if len(self.ends) > MANY and t - self.ends[0] <= CHATTER * max(t, 1e-300):
            raise StoppedError(
                f"{MANY} events within {t - self.ends[0]:.1e} s: a part comes to rest and starts again without end"
            )

    def _segment(self, t: float, y: Array) -> tuple[float, Array]:
        """To the first event, or the end."""
        self.coded = None
        self.acting.follow_laws(t, self.next_bend(t), y)
        guards, self.watch = self._guards(t, y), WATCHED
        self.is_heavy(t, y)
        limit = self.end if np.isfinite(self.end) else self.limits.time
        solver, tiny, steps = self._solver(t, y, min(limit, self.next_bend(t))), 0, 0
        longest, self.longest = self.longest, 0.0
        self._take_up(solver, guards, t, y)
        while solver.status == "running":
            if isinstance(solver, MachineSteps) and self.waiting is not None:
                longest = self._take_quiet(solver, guards, t, longest)
                if solver.status != "running":
                    break
            before, from_ = self.reached = solver.t, solver.y
            steps, self.taken = steps + 1, self.taken + 1
            self.report_progress()
            self.equation.set_anchor()
            self.acting.set_anchor()
            if self.end == np.inf and self.taken > self.limits.steps:
                self.taken -= 1
                self._give_up(before, from_)
                return before, from_
            if steps > MANY_STEPS and before - t < steps * NEVER * (self.end - t) < np.inf:
                what = "the integration steps become too small, as where friction nearly jams"
                raise StoppedError(f"{what}, or something has next to no inertia")
            if solver.step():
                self.longest = longest
                return self._go_on_with_care(before, from_)
            self.refusal, longest = "", max(longest, solver.h_previous or 0.0)
            if self.nears_dead_centre(solver.t, solver.y, (solver.h_previous or 0.0) / (longest or 1.0)):
                return self._turn_over(solver, before)
            if solver.status == "running" and solver.h_abs < SHORT * longest:
                self._near_singular(solver.t, solver.y)
                tiny += 1
                if tiny > TRIES:
                    raise StoppedError(self._why_too_small(solver.t, solver.y, self.why_stopped(LIGHT)))
            met = self._event(solver, guards, before, from_)
            if met is not None:
                self.flickers = self.flickers + 1 if met[0] - t <= 2 * longest else 0
                if self.flickers > 1 and (why := self._why_too_small(*met, "")):
                    raise StoppedError(why)
                return met
            self.fastest = np.maximum(self.fastest, np.abs(solver.y[self.d : 2 * self.d]))
            if self.waiting is None and not self._keep_step(solver, before, from_):
                return before, from_
            if self.waiting is None:
                self.keep(solver.t, solver.y)
            elif self.waiting and self.waiting[0] <= solver.t:
                self._keep_until(solver.dense_output(), before, solver.t)
        if limit <= solver.t < self.end:
            self._give_up(solver.t, solver.y)
        return solver.t, solver.y

    def _go_on_with_care(self, before: float, from_: Array) -> tuple[float, Array]:
        """Where another segment begins after a step that failed; raises StoppedError where no care helps."""
        if self.coded is not None and self.equation.dry:
            self.keep_samples()
            self.careful = True  # friction is not proved to have one solution: to the next event in numpy
            return before, from_
        if self.equation.dry and self.tolerance < COARSEST and not self._near_singular(before, from_):
            self.tolerance *= 10  # forces with friction are found to fewer digits than that
            return before, from_
        self._near_singular(before, from_)
        why = self.refusal or "the integration steps become too small"
        raise StoppedError(self._why_too_small(before, from_, why))

    def _take_up(self, solver: Steps | MachineSteps, guards: list[Guard], t: float, y: Array) -> None:
        """Machine code of a solver, and the sides on which contacts bear by it."""
        self.coded = (solver.code, solver.values) if isinstance(solver, MachineSteps) else None
        self.take_side([g for g in guards if g.kind == "side"], t, y)

    def _event(
        self, solver: Steps | MachineSteps, guards: list[Guard], before: float, from_: Array
    ) -> tuple[float, Array] | None:
        """The first event within the last step and the state behind it; None where there is none."""
        dense: Any = None
        self._look_within(guards, solver, before)
        crossed = [
            g
            for g in guards
            if g.kind == "stop" or self._crosses(g, solver.t, solver.y) or self._dips(g, solver, before)
        ]
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
            first += [g for g in crossed if g not in first and not g.known and g.at_zero(when, y, self.d)]
            self._keep_until(dense, before, when)
            self.reached = when, y
            self._happen(when, y, first)
            self.bears = {g.which: -g.side for g in first if g.kind == "side"}
            if any(g.kind != "side" for g in first):
                self.keep(when, y)
            return when, y
        if (self.locked & self.acting.free).any() and self._loose(solver.t, solver.y):
            dense = solver.dense_output()
            when = self._loosening(before, solver.t, dense)
            y = self._exactly(before, from_, when)
            self._keep_until(dense, before, when)
            self._resume(when, y)
            return when, y
        if self.acting.late and self._all_rest() and not self.torques_change(solver.y):
            self._keep_until(solver.dense_output(), before, solver.t)
            return solver.t, solver.y
        return None

    def _keep_step(self, solver: Steps | MachineSteps, before: float, y: Array) -> bool:
        """Keep instants within a long step, each ``FAR`` from the next at most; whether the limits allow it: it counts
        as a step for each radian."""
        d = self.d
        far = float((np.abs(solver.y - y)[:d] / self.lengths).max())
        if not self.taken + far <= self.limits.steps:
            self._give_up(before, y)
            return False
        self.taken += int(far)
        if far > FAR:
            dense, count = solver.dense_output(), int(far / FAR) + 1
            for when in np.linspace(before, solver.t, count + 1)[1:-1].tolist():
                self.keep(when, dense(when))
        return True

    def _turn_over(self, solver: Steps | MachineSteps, before: float) -> tuple[float, Array]:
        """End where other freedoms should lead."""
        self._keep_until(solver.dense_output(), before, solver.t)
        self.keep_samples()
        self.turned_over, self.reached = True, (solver.t, solver.y.copy())
        if self.rows[-1][0] < solver.t:
            self.keep(*self.reached)
        return self.reached

    def _take_quiet(self, solver: MachineSteps, guards: list[Guard], t: float, longest: float) -> float:
        """Take many steps at a time up to one in which something may happen, or that is short; the longest so far."""
        d, n = self.d, solver.n
        while solver.status == "running" and not (self.locked & self.acting.free).any():
            records, watched = solver.ahead(WATCHED_STEPS if guards else UNWATCHED)
            lengths = records[:, 1]
            most = float(lengths.max(initial=longest))
            if not lengths.size or lengths.min() <= max(SHORT * most, NEVER * (self.end - t)):
                break
            count = self.quiet(records, watched, guards)
            speeds = np.abs(records[:count, 2 + n + d : 2 + n + 2 * d])
            slow = (speeds[:, self.acting.free] < WATCHED * self.fastest[self.acting.free]).any(axis=1)
            seen = (
                records[:count][slow | (lengths[:count] < WATCHED * most)]
                if self.may_turn_over
                else records[:0]
            )
            if not count or any(self.is_heavy(r[0], r[2 : 2 + n]) for r in seen):
                break
            longest = most
            self.fastest = np.maximum(self.fastest, speeds.max(axis=0))
            solver.take(count)
            self._keep_within(records[:count], solver)
        return longest

    def _near_singular(self, t: float, y: Array) -> bool:
        """Raise StoppedError at a dead centre or change point, where two branches continue; otherwise returns False."""
        if (self.at(t, y)[2].closure < 0).any():
            raise StoppedError(self.why_stopped(DEAD_CENTRE))
        return False

    def _why_too_small(self, t: float, y: Array, otherwise: str) -> str:
        """Why steps become too small: at a dead centre of a drive all else moves without it, so that the inertia
        reduced to it grows without bound."""
        with suppress(StoppedError):
            inertia, free = np.abs(self.at(t, y)[2].mass.diagonal()), self.acting.free & ~self.locked
            if (inertia > UNBOUNDED * self.inertia)[free & (self.inertia > 0)].any():
                return DEAD_CENTRE
        return otherwise

    def _meet(self, g: Guard, when: float, t: float, y: Array) -> tuple[float, Array]:
        """The instant near ``when`` at which a guard passes zero, by the motion itself from (t, y), and the state."""
        state = self._exactly(t, y, when) if when > t else y.copy()
        if g.kind == "corner":
            return self._beyond(g, when, state, g.value(t, y))
        for _ in range(2 if when > t and g.kind != "side" else 0):
            short = 1e-3 * (when - t)
            slope = (
                g.value(when + short, state + short * self.rate(when, state)) - g.value(when, state)
            ) / short
            later = when - g.value(when, state) / slope if slope else when
            if not t < later < self.end or abs(later - when) > short:
                break
            when, state = float(later), self._exactly(t, y, float(later))
        return when, state

    def _beyond(self, g: Guard, when: float, y: Array, before: float) -> tuple[float, Array]:
        """The first instant from ``when`` on, and the state, that are clearly beyond a corner: so all see that side."""
        step = 4 * float(np.spacing(when))
        while not -g.value(when, y) * g.side > BEYOND * abs(before) and when + step < self.end:
            when, y, step = when + step, y + step * self.rate(when, y), 2 * step
        return when, y

    def _happen(self, t: float, y: Array, crossed: list[Guard]) -> None:
        """Applies the events of one instant; the state may be changed."""
        self.keep_samples()
        self.coded, self.careful = None, False
        d = self.d
        rests = [g.which for g in crossed if g.kind == "rest"]
        hit = [(g.which, -g.side) for g in crossed if g.kind == "stop"]
        latched = [g.which for g in crossed if g.kind == "clutch" and self.latch(g.which, t, y)]
        hit += [(k, -self.stops[k].way) for k in latched]
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
            elif g.kind == "lift":
                self.decide_gaps(t, y)
            elif g.kind == "corner":
                self.go_over(g, t, y)
            elif g.kind == "gear":
                self.acting.side[g.which] = -g.side
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
        self.coded, self.careful = None, False
        self.open_pulling(t, y)
        self.settle(self._loose(t, y), t, y, self.leaving(t, y))
        self.keep(t, y)

    def _rest(self, t: float, y: Array) -> float:
        """All drives moved by forces are at rest: until one is no longer held, or to the end."""
        self.keep_samples()
        end = self.end if np.isfinite(self.end) else max(t, self.limits.time if self.by_time else t)
        when = self._let_go(t, end, y)

        def standing(t: float) -> Array:
            self.take_sides(t, y)
            return y

        self._keep_until(standing, t, when)
        if when < end:
            self._resume(when, y)
            return when
        self.ended = ("at rest from ", ("time", t), " on")
        if np.isinf(self.end):
            looked: Words = (", as far as until ", ("time", end)) if self.by_time else ()
            why = "" if self.by_time else ", and no force moves it any more"
            self.status, self.ended = "not_met", (*self.ended, why, *looked, f": {self._awaited} not met")
        self.keep_samples()
        if self.rows[-1][0] < end < np.inf and np.isfinite(self.end):
            self.keep(end, y)
        return self.end
