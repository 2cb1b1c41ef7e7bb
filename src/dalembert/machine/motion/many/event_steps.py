"""Motions of many designs, each from event to event: their steps side by side in machine code, their events located.

A design goes on by itself: none waits for another, and none depends on what stands beside it. What a design needs
beyond this (a proof that friction has one solution fails, both ways are open at rest, events without end) makes it
``lost``: one motion alone decides it.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.kernel.emit.integrator import record_size
from dalembert.machine.motion.coded.steps import LEAST, between, first_step, state_sizes
from dalembert.machine.motion.many.event_program import EventCode, look
from dalembert.machine.motion.many.guards import Guards, first_root
from dalembert.machine.motion.occurrences import ROUNDING
from dalembert.machine.motion.rest.standstill import STILL

ATTEMPTS, MOST, MOST_EVENTS = 16, 20_000, 2_000
"""Attempts of steps at once; those, and events, after which a design is lost."""
MANY = 40
"""So many segments in turn, each of a step or two, that end at a corner: a jump that holds, or may."""
FLICKERS = 10
"""Segments in turn, each of a step or two, after which a contact's change of sides ends none."""
EVEN = 1e-9
"""Part of the difference of the accelerations in both senses from rest by which one has no sign."""


@dataclass(frozen=True)
class EventMachine:
    """Data common to all designs: the ``free`` drive, which may stay at ``rest`` (by friction, or its brake), how
    the values of the steps are ``placed``, the guards, and whether loads go ``by_time``."""

    code: EventCode
    free: int
    drives: int
    rests: bool
    first: int  # of the values behind those of the equation
    sides: Ints  # places of values for sides of loads
    guards: Guards
    stops: Flags  # guards that end a motion
    by_time: bool
    end: float
    tolerance: float
    lengths: Array


class Course:
    """The motions of designs (M,) as they go on.

    ``y`` (M, n), ``t``, ``values`` (M, V) and guards' sides (M, G) are those of now; ``rows`` are records of steps,
    ``of`` their designs, ``by`` their rows of ``versions``; ``instants``: design, time, version and state behind each
    event. At the end ``met`` is the guard that has ended a motion, -1 for the time; ``rest``: since when it stays at
    rest, or NaN.
    """

    def __init__(self, machine: EventMachine, begin: Array, values: Array, levels: Array, on: Array) -> None:
        m, self.machine, self.levels = len(begin), machine, levels
        self.y, self.t, self.values = begin.copy(), np.zeros(m), values.copy()
        self.h, self.growth = np.zeros(m), np.full(m, 10.0)
        self.met, self.rest = np.full(m, -1), np.full(m, np.nan)
        self.live, self.lost = np.ones(m, bool), np.zeros(m, bool)
        count = len(machine.guards)
        self.active, self.side = np.ones((m, count), bool), np.zeros((m, count))
        self.used = np.zeros((m, count), bool)
        self.toward, self.bearing = np.ones(m), np.zeros(m)
        self.fastest = np.abs(begin[:, machine.drives :])
        self.size = np.ones((m, 2 * machine.drives))
        self.began, self.longest, self.flickers = np.zeros(m), np.zeros(m), np.zeros(m, int)
        self.events, self.attempts = np.zeros(m, int), np.zeros(m, int)
        self.lines = values[:, machine.first : machine.first + 2 * machine.drives].copy()  # of motors
        self.on = on
        self.version, self.versions = np.zeros(m, int), list[Array]()
        self.rows, self.of, self.by = list[Array](), list[Array](), list[Array]()
        self.instants: list[tuple[Ints, Array, Ints, Array]] = []

    # places of the values

    def _given(self, block: int) -> slice:
        first, d = self.machine.first, self.machine.drives
        return slice(first + block * d, first + (block + 1) * d)

    @property
    def _senses(self) -> slice:
        first = self.machine.first + 4 * self.machine.drives
        return slice(first, first + self.machine.code.contacts)

    # what is seen at a state

    def columns(self, y: Array, watched: Array, t: Array) -> Array:
        """Values (..., G) of the guards."""
        columns = np.concatenate([y, watched, t[..., None]], axis=-1)
        return np.asarray(columns[..., self.machine.guards.column])

    def _least(self, k: Ints) -> Array:
        """Amounts (K, G) by which guards are surely beyond zero."""
        side = self.machine.guards.kind == "side"
        return np.where(side, ROUNDING * self.bearing[k, None], 0.0)

    def run(self) -> Course:
        """All motions to their ends."""
        k = np.arange(len(self.y))
        self._start(k)
        while self.live.any():
            k = np.flatnonzero(self.live)
            self._advance(k)
        return self

    def lose(self, k: Ints) -> None:
        """Leave designs to motions alone."""
        self.lost[k], self.live[k] = True, False

    # the beginning of a motion, and of a segment

    def _start(self, k: Ints) -> None:
        machine, d = self.machine, self.machine.drives
        self._switch_lines(k)
        if len(machine.sides):
            self.values[np.ix_(k, machine.sides)] = 1.0
            place = slice(machine.code.contacts + machine.code.margins, None)
            for _ in machine.sides:  # the inner ones of an expression first
                switching = look(machine.code.steps, self.values[k], self.t[k], self.y[k])[1][:, place]
                sides = np.sign(switching[:, : len(machine.sides)])
                self.values[np.ix_(k, machine.sides)] = sides
            self.lose(k[(sides == 0).any(axis=1)])
        u = self.y[:, d + machine.free]
        self.toward[k] = np.where(u[k] < 0, -1.0, 1.0)
        self._brake(k)
        if machine.code.contacts:
            rates = look(machine.code.steps, self.values[k], self.t[k], self.y[k])[1][
                :, : machine.code.contacts
            ]
            self.values[k, self._senses] = np.where(rates < 0, -1.0, 1.0)
        if machine.rests:
            self._settle(k[(u[k] == 0) & self.live[k]])
        self._begin(k[self.live[k]], first=True)

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
        ways = []
        for way in (1.0, -1.0):
            self.toward[k] = way
            self._brake(k)
            values, ahead = self.values[k], 0.0 * self.y[k]
            if contacts:
                ahead[:, :d], ahead[:, d + machine.free] = self.y[k, :d], way
                pushed = look(machine.code.steps, values, self.t[k], ahead)[1][:, :contacts]
                values[:, self._senses] = np.where(pushed != 0, np.sign(pushed), values[:, self._senses])
            senses = values[:, self._senses].copy()
            values[:, -1] = 1.0
            a = look(machine.code.steps, values, self.t[k], self.y[k])[0][:, d + machine.free]
            ways.append((a, senses))
        (ahead, one), (back, other) = ways
        size = EVEN * np.abs(ahead - back)
        doubt = ~np.isfinite(ahead - back) | (np.abs(ahead) < size) | (np.abs(back) < size)
        doubt |= (ahead > 0) & (back < 0)
        held = ~doubt & (ahead <= 0) & (back >= 0)
        self.lose(k[doubt])
        self.toward[k] = np.where(ahead > 0, 1.0, -1.0)
        self._brake(k)
        self.values[k, self._senses] = np.where((ahead > 0)[:, None], one, other)
        self._hold(k[held])

    def _hold(self, k: Ints) -> None:
        """At rest for good, unless something goes by time."""
        guards, switches = self.machine.guards, self.machine.guards.those("on", "off")
        timed = switches[guards.column[switches] == 2 * self.machine.drives + self.machine.code.steps.watched]
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

    def _keep_version(self, k: Ints) -> None:
        """Keep the values of now, which the next steps have."""
        self.version[k] = len(self.versions) + np.arange(len(k))
        self.versions += list(self.values[k])

    def _note(self, k: Ints) -> None:
        """Keep an instant behind an event."""
        if len(k):
            self.instants.append((k, self.t[k].copy(), self.version[k].copy(), self.y[k].copy()))

    def _begin(self, k: Ints, first: bool = False, gone: Array | None = None) -> None:
        """Begin segments: sides of the guards, also of those that have ``gone`` over (K, G), and sizes."""
        if not len(k):
            return
        machine, d = self.machine, self.machine.drives
        self._keep_version(k)
        rates, watched = look(machine.code.steps, self.values[k], self.t[k], self.y[k])
        fine = np.isfinite(rates).all(axis=1)
        self.lose(k[~fine])
        self._see_margins(k, watched)
        value = self.columns(self.y[k], watched, self.t[k]) - self.levels[k]
        large = np.maximum(np.abs(self.y[k]).max(axis=1, keepdims=True), 1.0)
        least = self._least(k)
        small = np.abs(value) <= np.where(least > 0, least, 1e-12 * large)
        side = np.where(small, 0.0, np.sign(value))
        if gone is not None:
            side = np.where(gone, -self.side[k], side)
        rest, contact = machine.guards.those("rest"), machine.guards.those("contact")
        side[:, rest] = self.toward[k, None]
        side[:, contact] = self.values[k, self._senses]
        side[:, machine.guards.those("corner")] = self.values[np.ix_(k, machine.sides)]
        self.side[k] = side
        self.active[k] = self._waiting(k)
        u = np.maximum(np.abs(self.y[k, d:]), self.fastest[k])
        with np.errstate(all="ignore"):
            self.size[k], pace = state_sizes(u, np.nan_to_num(rates[:, d:]), machine.lengths)
        self.began[k], self.longest[k], self.growth[k] = self.t[k], 0.0, 10.0
        if first:

            def ahead(h: Array) -> Array:
                y = self.y[k] + h[:, None] * rates
                return look(machine.code.steps, self.values[k], self.t[k] + h, y)[0]

            natural = self.size[k], pace
            self.h[k] = first_step(self.y[k], rates, ahead, machine.end, machine.tolerance, natural)
            self._note(k)

    def _see_margins(self, k: Ints, watched: Array) -> None:
        """The largest margin so far."""
        code = self.machine.code
        if code.margins:
            margins = np.abs(watched[..., code.contacts : code.contacts + code.margins])
            largest = margins.reshape(len(k), -1).max(axis=1, initial=0.0)
            self.bearing[k] = np.fmax(self.bearing[k], largest)

    # steps

    def _attempt(
        self, k: Ints, y: Array, t: Array, h: Array, end: Array | float, most: int
    ) -> tuple[Array, Array, Flags]:
        """Attempts of steps: records (K, most, ...), the parts of the motions behind them, and which were taken."""
        code, n = self.machine.code.steps, self.machine.code.steps.n
        rows = np.zeros((len(k), 3 * n + 6 + code.watched))
        rows[:, :n], rows[:, 2 * n : 3 * n] = y, LEAST * self.machine.tolerance * self.size[k]
        rows[:, 3 * n], rows[:, 3 * n + 1], rows[:, 3 * n + 2] = t, h, end
        rows[:, 3 * n + 3], rows[:, 3 * n + 4] = self.machine.tolerance, self.growth[k]
        motions = code.blocks(rows)
        records = code.advance(code.blocks(self.values[k]), motions, most, True).transpose(0, 3, 1, 2)
        records = records.reshape(-1, *records.shape[2:])[: len(k)]
        parts = motions.transpose(0, 2, 1).reshape(-1, motions.shape[1])[: len(k)]
        taken = np.arange(most) < parts[:, 3 * n + 5, None]
        return records, parts, taken & (np.where(taken, records[..., 1], 0.0) > 0)

    def _store(self, k: Ints, records: Array, taken: Flags) -> None:
        """Keep the steps that are taken."""
        size = record_size(self.machine.code.steps.n)
        self.rows.append(records[taken][:, :size])
        self.of.append(np.broadcast_to(k[:, None], taken.shape)[taken])
        self.by.append(np.broadcast_to(self.version[k][:, None], taken.shape)[taken])

    def _advance(self, k: Ints) -> None:
        """Some steps of designs, each up to its next event."""
        machine, n, d = self.machine, self.machine.code.steps.n, self.machine.drives
        records, parts, taken = self._attempt(k, self.y[k], self.t[k], self.h[k], machine.end, ATTEMPTS)
        self.attempts[k] += ATTEMPTS
        after, watched = records[..., 2 + n : 2 + 2 * n], records[..., record_size(n) :]
        after, watched = np.where(taken[..., None], after, 0.0), np.where(taken[..., None], watched, 0.0)
        self._see_margins(k, watched)
        value = self.columns(after, watched, records[..., 0] + records[..., 1]) - self.levels[k][:, None]
        least = self._least(k)
        self._find_sides(k, value, taken, least)
        beyond = value * self.side[k][:, None] < -least[:, None]
        crossed = beyond & self.active[k][:, None] & (self.side[k] != 0)[:, None] & taken[..., None]
        some = crossed.any(axis=2)
        meets, which = some.any(axis=1), some.argmax(axis=1)
        kept = taken & (~meets[:, None] | (np.arange(ATTEMPTS) < which[:, None]))
        self._store(k, records, kept)
        seen = taken & (~meets[:, None] | (np.arange(ATTEMPTS) <= which[:, None]))
        self.longest[k] = np.maximum(self.longest[k], np.where(seen, records[..., 1], 0.0).max(axis=1))
        speeds = np.where(kept[..., None], np.abs(after[..., d:]), 0.0).max(axis=1)
        self.fastest[k] = np.maximum(self.fastest[k], speeds)
        on = ~meets
        self.y[k[on]], self.t[k[on]] = parts[on, :n], parts[on, 3 * n]
        self.h[k[on]], self.growth[k[on]] = parts[on, 3 * n + 1], parts[on, 3 * n + 4]
        arrived = on & (parts[:, 3 * n] >= machine.end)
        self.live[k[arrived]] = False
        stuck = on & ~arrived & (~(parts[:, 3 * n + 1] > 0) | (self.attempts[k] > MOST))
        self.lose(k[stuck])
        if meets.any():
            place = np.flatnonzero(meets)
            self._meet(k[place], records[place, which[place]], crossed[place, which[place]])

    def _find_sides(self, k: Ints, value: Array, taken: Flags, least: Array) -> None:
        """Sides of guards that began at zero, from the first step's end on."""
        first, some = taken.argmax(axis=1), np.asarray(taken.any(axis=1))
        now = value[np.arange(len(k)), first]
        clear = (self.side[k] == 0) & (np.abs(now) > least) & some[:, None]
        self.side[k] = np.where(clear, np.sign(now), self.side[k])

    # events

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

        low, h = rows[:, 0], rows[:, 1]
        loose = np.where(machine.guards.kind[guard] == "side", ROUNDING, 1e-15) * h
        roots = np.full(crossed.shape, np.inf)
        roots[design, guard] = first_root(value, low, low + h, loose)
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
        for g in guards.those("corner"):
            at = k[met[:, g]]
            self.lose(at[self.flickers[at] > MANY])
            self.values[at, machine.sides[guards.which[g]]] *= -1
        speed = np.abs(self.y[k, d + machine.free])
        stands = met[:, contacts].any(axis=1) & (speed <= STILL * self.fastest[k].max(axis=1))
        rest = met[:, guards.those("rest")].any(axis=1) | (stands & machine.rests)
        self._settle(k[rest])
        on = self.live[k]
        k, met, noted = k[on], met[on], ~(met[on][:, guards.kind != "side"]).any(axis=1)
        gone = met & np.isin(guards.kind.astype(str), ("side", "kink", "corner"))
        self._begin(k, gone=gone)
        self._note(k[~noted & self.live[k]])
