"""Steps of motions of many designs, side by side in machine code, each up to its next event.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.kernel.emit.integrator import record_size
from dalembert.machine.motion.coded.steps import LEAST, between, first_step, state_sizes
from dalembert.machine.motion.many.course.course_stops import CourseStops
from dalembert.machine.motion.many.event_program import look
from dalembert.machine.motion.occurrences import FOLLOWS, LONGER, follows, lowest, off_line

ATTEMPTS, MOST = 16, 20_000
"""Attempts of steps at once, and those after which a design is lost."""

LOOKED_AT, TOUCHES = (0.2, 0.38, 0.6, 0.81), 1e-12
"""Parts of a step at which switches of loads are evaluated; part of its largest value by which one only touches 0."""


def _unclear(x: Array, v: Array) -> Flags:
    """True for functions with values v at places x, both along the first axis, that are below zero and come back, that
    may do so, or with a value that does not follow from its neighbours."""
    size = np.abs(v).max(axis=0)
    triples = [np.stack([a[:-2], a[1:-1], a[2:]]) for a in (x, v)]
    off, least = off_line(*triples), lowest(*triples)
    back = (v[1:-1] < 0) & (v[2:] >= 0)
    dips = (least < -TOUCHES * size) & (v[2:] >= 0) & (v[1:-1] >= 0) & (v[:-2] >= 0)
    return np.asarray((back | dips | (off > 2 * FOLLOWS * size)).any(axis=0))


class CourseSteps(CourseStops):
    """Motions between their events."""

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
        value = self.now[k] = self.columns(self.y[k], watched, self.t[k]) - self.levels[k]
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
        side[:, machine.guards.those("stop", "clutch", "lost")] = 1.0
        self.closing[k] = self.closing_speeds(self.y[k], watched)
        self.side[k] = side
        self.active[k] = self._waiting(k)
        u = np.maximum(np.abs(self.y[k, d : 2 * d]), self.fastest[k])
        with np.errstate(all="ignore"):
            sizes, pace = state_sizes(u, np.nan_to_num(rates[:, d : 2 * d]), machine.lengths)
        self.size[k, : 2 * d], self.size[k, 2 * d :] = sizes, machine.largest
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
            first = code.place("margins")
            margins = np.abs(watched[..., first : first + code.margins])
            largest = margins.reshape(len(k), -1).max(axis=1, initial=0.0)
            self.bearing[k] = np.fmax(self.bearing[k], largest)

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
        closing = self.closing_speeds(after, watched)
        crossed |= self._dips(k, records, closing, crossed)
        some = crossed.any(axis=2)
        meets, which = some.any(axis=1), some.argmax(axis=1)
        cut, too_long = self._first_too_long(k, records, taken, value)
        cut &= ~meets | (too_long <= which)
        meets &= ~cut
        last = np.where(cut, too_long, np.where(meets, which, ATTEMPTS))[:, None]
        kept, seen = (taken & (np.arange(ATTEMPTS) < last + more) for more in (0, 1))
        self._store(k, records, kept)
        self._keep_past(k, records, value, kept, meets)
        self.longest[k] = np.maximum(self.longest[k], np.where(seen, records[..., 1], 0.0).max(axis=1))
        speeds = np.where(kept[..., None], np.abs(after[..., d : 2 * d]), 0.0).max(axis=1)
        self.fastest[k] = np.maximum(self.fastest[k], speeds)
        on = ~meets
        self.y[k[on]], self.t[k[on]] = parts[on, :n], parts[on, 3 * n]
        self.h[k[on]], self.growth[k[on]] = parts[on, 3 * n + 1], parts[on, 3 * n + 4]
        again = records[cut, too_long[cut]]
        self.y[k[cut]], self.t[k[cut]], self.h[k[cut]] = again[:, 2 : 2 + n], again[:, 0], again[:, 1] / 2
        last = ATTEMPTS - 1 - kept[:, ::-1].argmax(axis=1)
        some = on & kept.any(axis=1)
        self.closing[k[some]] = closing[some, last[some]]
        arrived = on & ~cut & (parts[:, 3 * n] >= machine.end)
        self.live[k[arrived]] = False
        stuck = on & ~arrived & (~(self.h[k] > 0) | (self.attempts[k] > MOST))
        self.lose(k[stuck])
        if meets.any():
            place = np.flatnonzero(meets)
            self._meet(k[place], records[place, which[place]], crossed[place, which[place]])

    def _first_too_long(self, k: Ints, records: Array, taken: Flags, ends: Array) -> tuple[Flags, Ints]:
        """True for designs with a step whose end does not show all that switches their loads, and the first such step
        (K,): a switch passes zero and comes back, may do so, or does not follow from its neighbours."""
        corners = self.machine.guards.those("corner")
        out: Flags = np.zeros(taken.shape, bool)
        if len(corners):
            both = np.stack([self.past[k][:, corners], self.now[k][:, corners]], axis=1)
            v = np.concatenate([both, ends[..., corners]], axis=1)
            v *= self.side[k][:, None, corners]
            h = np.where(taken, records[..., 1], 0.0)
            t = np.column_stack([self.past_time[k], self.t[k], records[..., 0] + h])
            end = np.broadcast_to(np.arange(2, ATTEMPTS + 2), taken.shape)
            before = np.maximum.accumulate(np.where(taken, end, 1), axis=1)
            start = np.concatenate([np.ones_like(end[:, :1]), before[:, :-1]], axis=1)
            every = np.column_stack([np.zeros_like(end[:, :2]), start])  # place of the state before each
            places = (np.take_along_axis(every, start, axis=1), start, end)
            triples = (
                np.stack([np.take_along_axis(x, j[..., None], axis=1) for j in places])
                for x in (t[..., None], v)
            )
            seen = follows(*triples).all(axis=-1) & (h <= LONGER * self.looked[k, None])
            design, step = np.nonzero(taken & ~seen)
            if len(design):
                within = self._within(k[design], records[design, step], corners)
                within *= self.side[k[design]][:, corners]
                values = np.concatenate(
                    [v[design, start[design, step]][None], within, v[design, step + 2][None]]
                )
                unclear = _unclear(np.array([0.0, *LOOKED_AT, 1.0])[:, None, None], values).any(axis=-1)
                out[design, step] = unclear
                np.maximum.at(self.looked, k[design], np.where(unclear, 0.0, h[design, step]))
                self.looked[k[design[unclear]]] = 0.0
        return np.asarray(out.any(axis=1)), out.argmax(axis=1)

    def _keep_past(self, k: Ints, records: Array, value: Array, kept: Flags, meets: Flags) -> None:
        """Keep the guards' values at the last instant, and at the one before it, with its time. At an event, which is
        the last instant then, the one before it is the end of the last step."""
        each, count = np.arange(len(k)), kept.sum(axis=1)
        last = ATTEMPTS - 1 - kept[:, ::-1].argmax(axis=1)
        others = kept.copy()
        others[each, last] = False
        before = np.where(meets, last, ATTEMPTS - 1 - others[:, ::-1].argmax(axis=1))
        inside = (count > np.where(meets, 0, 1))[:, None]
        moved = (count > 0) | meets
        past = np.where(inside, value[each, before], self.now[k])
        time = np.where(inside[:, 0], (records[..., 0] + records[..., 1])[each, before], self.t[k])
        self.past[k[moved]], self.past_time[k[moved]] = past[moved], time[moved]
        self.now[k[moved]] = value[each, last][moved]

    def _within(self, k: Ints, rows: Array, guards: Ints) -> Array:
        """Values (W, K, G) of guards at instants within steps."""
        size, parts = record_size(self.machine.code.steps.n), len(LOOKED_AT)
        t = rows[:, 0] + np.array(LOOKED_AT)[:, None] * rows[:, 1]
        t, rows, of = t.ravel(), np.tile(rows[:, :size], (parts, 1)), np.tile(k, parts)
        y = between(rows, t)
        watched = look(self.machine.code.steps, self.values[of], t, y)[1]
        out = self.columns(y, watched, t)[:, guards] - self.levels[of][:, guards]
        return np.asarray(out.reshape(parts, len(k), -1))

    def _meet(self, k: Ints, records: Array, crossed: Flags) -> None:
        """Go to the first events of designs within steps, and on behind them."""
        raise NotImplementedError

    def _find_sides(self, k: Ints, value: Array, taken: Flags, least: Array) -> None:
        """Sides of guards that began at zero, from the first step's end on."""
        first, some = taken.argmax(axis=1), np.asarray(taken.any(axis=1))
        now = value[np.arange(len(k)), first]
        clear = (self.side[k] == 0) & (np.abs(now) > least) & some[:, None]
        self.side[k] = np.where(clear, np.sign(now), self.side[k])
