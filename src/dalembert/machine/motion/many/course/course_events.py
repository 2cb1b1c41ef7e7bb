"""Motions of many designs, each from event to event: their steps side by side in machine code, their events located.

A design goes on by itself: none waits for another, and none depends on what stands beside it. What a design needs
beyond this (a proof that friction has one solution fails, both ways are open at rest, events without end) makes it
``lost``: one motion alone decides it.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.kernel.emit.integrator import record_size
from dalembert.machine.motion.coded.steps import between
from dalembert.machine.motion.many.course.course_steps import CourseSteps
from dalembert.machine.motion.many.course.guards import first_root
from dalembert.machine.motion.many.event_program import look
from dalembert.machine.motion.occurrences import ROUNDING
from dalembert.machine.motion.rest.standstill import STILL

MOST_EVENTS = 2_000
"""Events after which a design is lost."""
MANY = 40
"""So many segments in turn, each of a step or two, that end at a corner: a jump that holds, or may."""


class Course(CourseSteps):
    """Motions of designs, from event to event to their ends."""

    def run(self) -> Course:
        """All motions to their ends."""
        k = np.arange(len(self.y))
        self._start(k)
        while self.live.any():
            k = np.flatnonzero(self.live)
            self._advance(k)
        return self

    def _meet(self, k: Ints, records: Array, crossed: Flags) -> None:
        """Go to the first events of designs within steps, and on behind them."""
        machine, size = self.machine, record_size(self.machine.code.steps.n)
        design, guard = np.nonzero(crossed)
        rows, values = records[design, :size], self.values[k[design]]
        side, level = self.side[k[design], guard], self.levels[k[design], guard]

        def value(t: Array, j: Ints) -> Array:
            y = between(rows[j], t)
            watched = look(machine.code.steps, values[j], t, y)[1]
            every = self.columns(y, watched, t)
            return np.asarray((every[np.arange(len(j)), guard[j]] - level[j]) * side[j])

        low, high = self.search_stops(k[design], rows, guard)
        h = rows[:, 1]
        loose = np.where(machine.guards.kind[guard] == "side", ROUNDING, 1e-15) * h
        roots = np.full(crossed.shape, np.inf)
        roots[design, guard] = first_root(value, low, high, loose)
        when = roots.min(axis=1)
        met: Flags = np.asarray(roots <= (when + 1e-13 * np.abs(when))[:, None])
        reached: Flags = self._go_to(k, records, when)
        self.lose(k[~reached])
        self._happen(k[reached], met[reached])

    def _go_to(self, k: Ints, records: Array, when: Array) -> Flags:
        """Take the exact steps to instants within steps; which have arrived."""
        n = self.machine.code.steps.n
        y, t, h = records[:, 2 : 2 + n].copy(), records[:, 0].copy(), when - records[:, 0]
        self.growth[k] = 10.0
        for _ in range(8):
            j = np.flatnonzero(t < when)
            if not len(j):
                break
            made, parts, taken = self._attempt(k[j], y[j], t[j], h[j], when[j], 4)
            self._store(k[j], made, taken)
            y[j], t[j], h[j] = parts[:, :n], parts[:, 3 * n], parts[:, 3 * n + 1]
            self.growth[k[j]] = parts[:, 3 * n + 4]
        self.y[k], self.t[k], self.h[k] = y, np.where(t < when, t, when), records[:, 1]
        return np.asarray((t >= when) & np.isfinite(y).all(axis=1))

    def _happen(self, k: Ints, met: Flags) -> None:
        """Apply the events of designs, of guards ``met`` (K, G), and begin the next segments."""
        machine, guards, d = self.machine, self.machine.guards, self.machine.drives
        self.events[k] += 1
        short = self.t[k] - self.began[k] <= 2 * self.longest[k]
        self.flickers[k] = np.where(short, self.flickers[k] + 1, 0)
        ends = met & machine.stops
        over = ends.any(axis=1)
        self.met[k[over]], self.live[k[over]] = ends[over].argmax(axis=1), False
        self.lose(k[(self.events[k] > MOST_EVENTS) & ~over])
        k, met = k[self.live[k]], met[self.live[k]]
        for g in guards.those("on", "off"):
            at = k[met[:, g]]
            self.on[at, guards.which[g]] = float(guards.kind[g] == "on")
            self.used[at, g] = True
            self._switch_lines(at)
        contacts = guards.those("contact")
        for g in contacts:
            at = k[met[:, g]]
            place = self._senses.start + guards.which[g]
            self.values[at, place] = -self.values[at, place]
        corners = guards.those("corner")
        turned = k[met[:, corners].any(axis=1)]
        before = self.values[turned]
        for g in corners:
            at = k[met[:, g]]
            self.lose(at[self.flickers[at] > MANY])
            self.values[at, machine.sides[guards.which[g]]] *= -1
        self.find_nested_sides(turned, before)
        k, met, rests = self._meet_stops(k, met)
        speed = np.abs(self.y[k, d + machine.free])
        stands = met[:, contacts].any(axis=1) & (speed <= STILL * self.fastest[k].max(axis=1))
        rest = met[:, guards.those("rest")].any(axis=1) | (stands & machine.rests) | rests
        self._settle(k[rest])
        on = self.live[k]
        k, met, noted = k[on], met[on], ~(met[on][:, guards.kind != "side"]).any(axis=1)
        gone = met & np.isin(guards.kind.astype(str), ("side", "kink", "corner"))
        self._begin(k, gone=gone)
        self._note(k[~noted & self.live[k]])

    def _meet_stops(self, k: Ints, met: Flags) -> tuple[Ints, Flags, Flags]:
        """Apply impacts, clutches that hold, and contacts that are lost; which designs go on, and which rest."""
        guards = self.machine.guards
        self.lose(k[met[:, guards.those("lost")].any(axis=1)])
        rests, stops = np.zeros(len(k), bool), guards.those("stop")
        hit = np.zeros((len(k), self.machine.code.stops), bool)
        hit[:, guards.which[stops]] = met[:, stops]
        some = hit.any(axis=1) & self.live[k]
        if some.any():
            rests[some] = self.strike(k[some], hit[some])
        for g in guards.those("clutch"):
            at = met[:, g] & self.live[k]
            if at.any():
                self.latch(k[at], np.full(int(at.sum()), guards.which[g]))
                rests |= at
        on = self.live[k]
        return k[on], met[on], rests[on]
