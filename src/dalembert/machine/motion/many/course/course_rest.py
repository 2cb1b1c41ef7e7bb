"""Motions of many designs at their start and at rest: what holds them, and the sense in which they go on.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.machine.motion.many.course.course_state import CourseState
from dalembert.machine.motion.many.event_program import look

EVEN = 1e-9
"""Part of the difference of the accelerations in both senses from rest by which one has no sign."""
FLICKERS = 10
"""Segments in turn, each of a step or two, after which a contact's change of sides ends none."""


SOON = 1e-9
"""Part of the time up to the end, after which the sides of what begins at a corner are taken."""


class CourseRest(CourseState):
    """Motions at their start and at rest."""

    def _start(self, k: Ints) -> None:
        machine, d = self.machine, self.machine.drives
        self._switch_lines(k)
        if len(machine.sides):
            self.values[np.ix_(k, machine.sides)] = 1.0
            place = slice(machine.code.place("corners"), None)
            for _ in machine.sides:  # the inner ones of an expression first
                switching = look(machine.code.steps, self.values[k], self.t[k], self.y[k])[1][:, place]
                sides = np.sign(switching[:, : len(machine.sides)])
                self.values[np.ix_(k, machine.sides)] = sides
            self._find_sides_ahead(k[(sides == 0).any(axis=1)])
        u = self.y[:, d + machine.free]
        self.toward[k] = np.where(u[k] < 0, -1.0, 1.0)
        self._brake(k)
        if machine.code.contacts:
            rates = look(machine.code.steps, self.values[k], self.t[k], self.y[k])[1][
                :, : machine.code.contacts
            ]
            self.values[k, self._senses] = np.where(rates < 0, -1.0, 1.0)
        holds = self._start_on_stops(k)
        if machine.rests or holds.any():
            self._settle(k[(u[k] == 0) & self.live[k] & (machine.rests | holds)])
        self._begin(k[self.live[k]], first=True)

    def _find_sides_ahead(self, k: Ints) -> None:
        """Sides of loads that begin right at their corners: those that the motion goes to."""
        if not len(k):
            return
        for _ in self.machine.sides:  # the inner ones of an expression first
            self.values[np.ix_(k, self.machine.sides)] = np.sign(self._switching_ahead(k, self.values[k]))
        self.lose(k[(self.values[np.ix_(k, self.machine.sides)] == 0).any(axis=1)])

    def find_nested_sides(self, k: Ints, before: Array) -> None:
        """Sides of switches that jump with those that have gone over, of designs with values (K, V) before that."""
        if not len(k) or len(self.machine.sides) < 2:
            return
        was = self._switching_ahead(k, before)
        for _ in self.machine.sides:
            now, sides = self._switching_ahead(k, self.values[k]), self.values[np.ix_(k, self.machine.sides)]
            self.values[np.ix_(k, self.machine.sides)] = np.where(
                (now != was) & (now * sides <= 0), np.sign(now), sides
            )
        self.lose(k[(self.values[np.ix_(k, self.machine.sides)] == 0).any(axis=1)])

    def _switching_ahead(self, k: Ints, values: Array) -> Array:
        """Switching values of loads (K, S) by values (K, V), a little later by the present ones."""
        machine, place = self.machine, self.machine.code.place("corners")
        rates, h = look(machine.code.steps, self.values[k], self.t[k], self.y[k])[0], SOON * machine.end
        d, later = machine.drives, self.y[k] + h * rates
        later[:, :d] += h**2 / 2 * rates[:, d : 2 * d]
        return look(machine.code.steps, values, self.t[k] + h, later)[1][
            :, place : place + len(machine.sides)
        ]

    def _start_on_stops(self, k: Ints) -> Flags:
        """Finds designs that begin in a clutch that holds; those on a stop, or against a clutch, are left alone."""
        code, guards, d = self.machine.code, self.machine.guards, self.machine.drives
        out, both = np.zeros(len(k), bool), guards.those("stop", "clutch")
        if not len(both):
            return out
        watched = look(code.steps, self.values[k], self.t[k], self.y[k])[1]
        margin = self.columns(self.y[k], watched, self.t[k])
        small = 1e-9 * (1 + np.abs(self.y[k, : 2 * d]).max(axis=1))
        for g in both:
            clutch = guards.kind[g] == "clutch"
            self.lose(k[margin[:, g] < (-small if clutch else small)])
            at = np.flatnonzero((margin[:, g] <= small) & clutch)
            slopes = watched[at, code.place("stops") + guards.which[g] * (2 + d) + 2 + self.machine.free]
            self.on_stop[k[at]], out[at] = np.sign(slopes), True
        return out

    def _begin(self, k: Ints, first: bool = False, gone: Array | None = None) -> None:
        """Begin segments of designs."""
        raise NotImplementedError

    def _switch_lines(self, k: Ints) -> None:
        """Efforts of motors that are on."""
        d = self.machine.drives
        place = slice(self.machine.first, self.machine.first + 2 * d)
        self.values[k, place] = self.lines[k] * np.tile(self.on[k], (1, 2))

    def _brake(self, k: Ints) -> None:
        """Brakes against the sense of motion."""
        place = self._given(2).start + self.machine.free
        self.values[k, place] = -np.abs(self.values[k, place]) * self.toward[k]

    def _settle(self, k: Ints) -> None:
        """At rest: if friction and brakes hold it, and otherwise the sense in which it accelerates."""
        if not len(k):
            return
        machine, d, contacts = self.machine, self.machine.drives, self.machine.code.contacts
        self.y[k, d + machine.free] = 0.0
        accelerations = []
        for sense in (1.0, -1.0):
            self.toward[k] = sense
            self._brake(k)
            values, ahead = self.values[k], 0.0 * self.y[k]
            if contacts:
                ahead[:, :d], ahead[:, d + machine.free] = self.y[k, :d], sense
                pushed = look(machine.code.steps, values, self.t[k], ahead)[1][:, :contacts]
                values[:, self._senses] = np.where(pushed != 0, np.sign(pushed), values[:, self._senses])
            senses = values[:, self._senses].copy()
            values[:, -1] = 1.0
            a = look(machine.code.steps, values, self.t[k], self.y[k])[0][:, d + machine.free]
            accelerations.append((a, senses))
        (ahead, one), (back, other) = accelerations
        size, stop = EVEN * np.abs(ahead - back), self.on_stop[k]
        doubt = ~np.isfinite(ahead - back) | (np.abs(ahead) < size) & (stop <= 0)
        doubt |= (np.abs(back) < size) & (stop >= 0)
        up, down = (ahead > 0) & (stop <= 0), (back < 0) & (stop >= 0)
        doubt |= up & down & (stop == 0)
        self.lose(k[doubt])
        self.toward[k] = np.where(up, 1.0, -1.0)
        self._brake(k)
        self.values[k, self._senses] = np.where(up[:, None], one, other)
        held = ~doubt & ~up & ~down
        self.on_stop[k[~held]] = 0.0
        self._hold(k[held])

    def _hold(self, k: Ints) -> None:
        """At rest for good, unless something goes by time."""
        guards, switches = self.machine.guards, self.machine.guards.those("on", "off")
        code = self.machine.code.steps
        timed = switches[guards.column[switches] == code.n + code.watched]
        by_time = self.machine.by_time | self._waiting(k)[:, timed].any(axis=1)
        self.lose(k[by_time])
        k = k[~by_time]
        self.rest[k], self.live[k] = self.t[k], False
        self.values[k, -1] = 1.0
        self._keep_version(k)
        self._note(k)

    def _waiting(self, k: Ints) -> Flags:
        """Guards (K, G) that may be met: switches once each, those that switch on where it is off."""
        guards = self.machine.guards
        waiting = ~self.used[k]
        switches = guards.those("on")
        waiting[:, switches] &= self.on[np.ix_(k, guards.which[switches])] == 0
        waiting[:, guards.those("side")] &= (self.flickers[k] < FLICKERS)[:, None]
        return waiting
