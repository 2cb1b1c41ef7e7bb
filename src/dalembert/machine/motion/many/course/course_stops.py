"""Stops in motions of many designs: when they are met, impacts, and rest on a stop or in a clutch that holds.

A design that rests on a stop while other drives move, or meets two stops at once, is left to its motion alone.

Mechanics: docs/theory.md 10.6, 10.13.
"""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.machine.motion.coded.steps import between
from dalembert.machine.motion.many.course.course_rest import CourseRest
from dalembert.machine.motion.many.course.guards import first_root
from dalembert.machine.motion.many.event_program import look
from dalembert.machine.motion.rest.standstill import STILL
from dalembert.machine.motion.stops.impacts import LEFT, SLOW, TOUCHING, UNMOVED


class CourseStops(CourseRest):
    """Motions that meet stops; ``closing`` (M, S): speeds towards them at the state of now."""

    def stop_block(self, watched: Array) -> tuple[Array, Array, Array]:
        """Margins and restitutions (..., S), and decrease of the margins per unit of each drive (..., S, D)."""
        code, d = self.machine.code, self.machine.drives
        first = code.place("stops")
        block = watched[..., first : first + code.stops * (2 + d)]
        block = block.reshape(*watched.shape[:-1], code.stops, 2 + d)
        return block[..., 0], block[..., 1], block[..., 2:]

    def closing_speeds(self, y: Array, watched: Array) -> Array:
        """Speeds towards the stops (..., S)."""
        d = self.machine.drives
        return np.asarray((self.stop_block(watched)[2] * y[..., None, d : 2 * d]).sum(axis=-1))

    def _dips(self, k: Ints, records: Array, closing: Array, crossed: Flags) -> Flags:
        """Steps (K, A, G) within which a stop is passed, although they end before it."""
        guards = self.machine.guards.those("stop")
        before = np.concatenate([self.closing[k][:, None], closing[:, :-1]], axis=1)
        which = self.machine.guards.which[guards]
        turns = (before[..., which] > 0) & (closing[..., which] < 0) & ~crossed[..., guards]
        turns &= (records[..., 1] > 0)[..., None] & self.active[k][:, None, guards]
        design, step, stop = np.nonzero(turns)
        out = np.zeros_like(crossed)
        if len(design):
            rows = records[design, step]
            nearest = self._turning(k[design], rows, which[stop], 1.0)
            margin = self._margin(k[design], rows, which[stop], nearest)
            out[design, step, guards[stop]] = margin < 0
        return out

    def _at(self, k: Ints, rows: Array, t: Array) -> tuple[Array, Array]:
        """States within steps of designs, with their watched values."""
        y = between(rows[:, : self._record], t)
        return y, look(self.machine.code.steps, self.values[k], t, y)[1]

    @property
    def _record(self) -> int:
        """Size of a step's record without what is watched."""
        return 2 + 8 * self.machine.code.steps.n

    def _margin(self, k: Ints, rows: Array, stop: Ints, t: Array) -> Array:
        """Margins (K,) of one stop each at instants within steps."""
        margin = self.stop_block(self._at(k, rows, t)[1])[0]
        return np.asarray(margin[np.arange(len(k)), stop])

    def _turning(self, k: Ints, rows: Array, stop: Ints, side: float) -> Array:
        """Instants (K,) within steps at which the speed towards a stop passes 0, from this side."""

        def value(t: Array, j: Ints) -> Array:
            y, watched = self._at(k[j], rows[j], t)
            return np.asarray(side * self.closing_speeds(y, watched)[np.arange(len(j)), stop[j]])

        low = rows[:, 0]
        return first_root(value, low, low + rows[:, 1], 1e-15 * rows[:, 1])

    def search_stops(self, k: Ints, rows: Array, guard: Ints) -> tuple[Array, Array]:
        """Parts of steps in which roots (K,) of guards are sought: for stops from the farthest point of what begins on
        one, and up to the deepest point, if a step ends before the stop again."""
        low, high = rows[:, 0].copy(), rows[:, 0] + rows[:, 1]
        at = np.flatnonzero(self.machine.guards.kind[guard] == "stop")
        if not len(at):
            return low, high
        which, ends = self.machine.guards.which[guard[at]], high[at]
        first = self._margin(k[at], rows[at], which, low[at])
        y, watched = self._at(k[at], rows[at], low[at])
        leaves = self.closing_speeds(y, watched)[np.arange(len(at)), which] < 0
        leaves &= first <= LEFT * (1 + np.abs(y[:, : self.machine.drives]).max(axis=1))
        last = self._margin(k[at], rows[at], which, ends)
        for some, side, to in ((leaves, -1.0, low), (last >= 0, 1.0, high)):
            j = np.flatnonzero(some)
            if len(j):
                to[at[j]] = self._turning(k[at[j]], rows[at[j]], which[j], side)
        return low, high

    def strike(self, k: Ints, met: Flags) -> Flags:
        """Impacts of designs on stops, ``met`` (K, S); which of them rest on one now."""
        machine, d = self.machine, self.machine.drives
        rates, watched = look(machine.code.steps, self.values[k], self.t[k], self.y[k])
        margin, restitution, slopes = self.stop_block(watched)
        each, which = np.arange(len(k)), met.argmax(axis=1)
        n, e = slopes[each, which], restitution[each, which]
        near = np.abs(margin) <= TOUCHING * (1 + np.abs(self.y[k, :d]).max(axis=1, keepdims=True))
        self.lose(k[(near | met).sum(axis=1) > 1])
        self.fastest[k] = np.maximum(self.fastest[k], np.abs(self.y[k, d : 2 * d]))
        closing = (n * self.y[k, d : 2 * d]).sum(axis=1)
        speed = np.abs(n).max(axis=1) * self.fastest[k].max(axis=1)
        back = e * np.maximum(closing, 0.0)
        slow = back <= SLOW * speed
        ease, push = self._ease(k, rates, n), np.zeros(len(k))
        self.lose(k[~(np.abs(n[:, machine.moves]).max(axis=1) > UNMOVED * np.abs(n).max(axis=1))])
        with np.errstate(all="ignore"):
            push = (closing + np.where(slow, 0.0, back)) / (n * ease).sum(axis=1)
            left = np.where(slow, back / np.maximum(1 - e, SLOW), 0.0)
        self.y[k, d : 2 * d] -= np.nan_to_num(ease * push[:, None])
        for j in np.flatnonzero([drive >= 0 for drive in machine.stop_drives]):
            at = k[which == j]
            drive = machine.stop_drives[j]
            self.y[at, drive] += (margin[each, which] * n[:, drive])[which == j]
        of_drive = np.array(machine.stop_drives)[which] >= 0
        self.lose(k[slow & ~(machine.alone & (of_drive | (machine.code.outputs == 0)))])
        rests = slow & self.live[k]
        self._rest_on(k[rests], n[rests], left[rests])
        self._turn_senses(k[self.live[k]])
        return np.asarray(rests)

    def _rest_on(self, k: Ints, n: Array, left: Array) -> None:
        """Designs come to rest on stops, whose remaining rebounds take 2 left over the acceleration towards them."""
        machine, rate = self.machine, self.machine.drives + self.machine.free
        self.y[k, rate], self.on_stop[k] = 0.0, np.sign(n[:, machine.free])
        if left.any() and not machine.code.contacts:
            a = look(machine.code.steps, self.values[k], self.t[k], self.y[k])[0][:, rate]
            toward = n[:, machine.free] * a
            self.t[k] += np.where(toward > 0, 2 * left / np.where(toward > 0, toward, 1.0), 0.0)

    def _ease(self, k: Ints, rates: Array, n: Array) -> Array:
        """Change of the drives' rates (K, D) per unit of a push against a stop."""
        machine, d = self.machine, self.machine.drives
        if machine.moves.sum() == 1:
            out = np.zeros_like(n)
            out[:, machine.free] = 1.0 / np.where(n[:, machine.free] != 0, n[:, machine.free], 1.0)
            return out
        self.lose(k if machine.code.contacts else k[:0])
        values = self.values[k]
        size = np.abs(self.lines[k, :d]).max(axis=1, keepdims=True) + 1.0
        values[:, self._given(0)] += np.where(machine.moves, n, 0.0) * size
        pushed = look(machine.code.steps, values, self.t[k], self.y[k])[0]
        return np.asarray((pushed - rates)[:, d : 2 * d] / size)

    def _turn_senses(self, k: Ints) -> None:
        """Senses of drives and contacts behind an impact."""
        machine, d = self.machine, self.machine.drives
        u = self.y[k, d + machine.free]
        self.toward[k] = np.where(u != 0, np.where(u < 0, -1.0, 1.0), self.toward[k])
        self._brake(k)
        if machine.code.contacts:
            rates = look(machine.code.steps, self.values[k], self.t[k], self.y[k])[1][
                :, : machine.code.contacts
            ]
            clear = np.abs(rates) > STILL * np.abs(rates).max(axis=1, initial=0.0, keepdims=True)
            self.values[k, self._senses] = np.where(
                clear, np.where(rates < 0, -1.0, 1.0), self.values[k, self._senses]
            )

    def latch(self, k: Ints, which: Ints) -> None:
        """Clutches of designs hold: the free drive is at rest."""
        machine, d = self.machine, self.machine.drives
        self.lose(k[:0] if machine.alone and not machine.code.outputs else k)
        slopes = self.stop_block(look(machine.code.steps, self.values[k], self.t[k], self.y[k])[1])[2]
        self.y[k, d + machine.free] = 0.0
        self.on_stop[k] = np.sign(slopes[np.arange(len(k)), which, machine.free])
