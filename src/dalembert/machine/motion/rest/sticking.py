"""Contacts at rest in machines of several freedoms: which of them stick, and the senses of the others.

A contact sticks while the force that keeps its rate at 0 is within the limit of its coefficient at rest. All sets of
contacts at rest that stick, and senses of the others, are tried, most sticking ones first, until one satisfies
friction's law.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from itertools import product

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.machine.motion.actuation import Actuation
from dalembert.machine.motion.corners.corner_events import CornerState
from dalembert.machine.motion.equation import StoppedError
from dalembert.machine.motion.rest.standstill import STILL
from dalembert.model import Mechanism

AT_ONCE = 7
"""Contacts at rest at once whose sets are tried: 3^7 there are."""
PARALLEL = 1e-9
"""A column is a sum of others where less than this part of it is left over."""
EVEN = 1e-9
"""Part of a limit, or of what it accelerates, that is rounding."""


class StickState(CornerState):
    """A motion's contacts and drives at rest; ``tied`` (independent contacts,) and ``bound`` (D,): those at rest
    because contacts stick."""

    def __init__(self, m: Mechanism, actuation: Actuation) -> None:
        super().__init__(m, actuation)
        self.tied: Flags = np.zeros(len(self.sense), bool)
        self.bound: Flags = np.zeros(self.d, bool)

    def _settle_start(self, t: float, y: Array) -> None:
        """Sets the senses at the start; parts at rest are held, or move in the sense in which they are pushed."""
        u = y[self.d : 2 * self.d]
        self.find_sides(t, y)
        if self.equation.dry:
            self._check_inertia(t, y)
            self.sense = np.where(self.rubbing_rates(t, y) < 0, -1.0, 1.0)
        self.toward = np.where(u < 0, -1.0, 1.0)
        self.settle(np.flatnonzero(self.rubs & (u == 0)).tolist(), t, y)

    def settle(self, drives: Sequence[int], t: float, y: Array, leaving: Sequence[int] = ()) -> list[int]:
        """Decides on drives and contacts at rest, after contacts that are ``leaving`` have slipped; returns the
        independent contacts concerned.

        In a machine of one freedom by the range of its effort, and so where there is a brake or a stop, or too many
        contacts; else by the contacts alone.
        """
        resting, rates, push = self._resting(t, y)
        single = self.acting.free.sum() == 1 and not self.stuck.any()
        alone = bool(drives) and (single or len(resting) > AT_ONCE)
        for k in drives:
            if alone or self._kept[k]:
                self._settle(k, t, y)
            elif t > 0 and not push[k, resting].any():
                name = self.acting.names[k]
                self.note(t, "reversal", f"{name} turns back", of=name)
        if not alone:
            self.locked &= self._kept
            resting, rates, push = self._resting(t, y)
            self._stop(push[:, resting], rates[resting], y)
            self._choose(resting, push, t, y, leaving)
            self._begin(t, y)
        return [int(e) for e in resting]

    def _begin(self, t: float, y: Array) -> None:
        """Sets the senses of drives that are at rest and not held."""
        slow = np.abs(y[self.d : 2 * self.d]) <= STILL * self.fastest
        begins = slow & self.acting.free & ~(self.locked | self.bound | self._kept)
        if begins.any():
            ahead = self.at(*self.soon(t, y))[0][begins]  # where it slips the acceleration is nothing yet
            self.toward[begins] = np.where(ahead < 0, -1.0, 1.0)

    @property
    def _kept(self) -> Flags:
        """Drives (D,) that rest by more than contacts: a brake, a lossy gear or a stop."""
        return np.asarray((self.acting.brake > 0) | self.acting.lossy | (self.on_stop != 0))

    def _resting(self, t: float, y: Array) -> tuple[Ints, Array, Array]:
        """Independent contacts with rates 0 that the free drives change; rates (own,), the push (D, own) on them."""
        if not self.equation.dry:
            return np.zeros(0, np.intp), np.zeros(0), np.zeros((self.d, 0))
        terms = self.equation(t, y[: self.d], y[self.d : 2 * self.d])
        assert terms.linear is not None
        rates, push = self.own(terms.rates), terms.linear.push[:, self.equation.dry.own]
        slow = self.tied | (np.abs(rates) <= STILL * (self.fastest @ np.abs(push)))
        push = push * (self.acting.free & ~(self.locked & self._kept))[:, None]
        return np.flatnonzero(slow & push.any(axis=0)), rates, push

    def _stop(self, push: Array, rates: Array, y: Array) -> None:
        """Take from the speeds what is left of the rates of contacts at rest."""
        if not push.shape[1]:
            return
        u = y[self.d : 2 * self.d]
        u += np.linalg.lstsq(push.T, rates, rcond=PARALLEL)[0]
        u[_within(np.eye(self.d), push) & (np.abs(u) <= STILL * self.fastest)] = 0.0

    def _choose(self, resting: Ints, push: Array, t: float, y: Array, leaving: Sequence[int]) -> None:
        """Take the first set of sticking contacts, and senses of the others, that satisfies friction's law."""
        dry = self.equation.dry
        if not dry or not len(resting):
            self.stuck[:], self.tied[:], self.bound[:] = False, False, False
            return
        if len(resting) > AT_ONCE:
            what = f"{len(resting)} contacts come to rest at once"
            raise StoppedError(f"{what}; which of them stick can be decided for at most {AT_ONCE}")
        stuck, sense = self.stuck.copy(), self.sense.copy()
        forced = {e: float(-np.sign(self.solved(t, y)[0].cz[dry.own[e]])) for e in leaving}
        for senses in _combinations(
            [(forced[e],) if e in forced else (0.0, sense[e], -sense[e]) for e in resting]
        ):
            held = resting[senses == 0]
            if np.linalg.matrix_rank(push[:, held], tol=PARALLEL * np.abs(push).max()) < len(held):
                continue
            self.stuck[:] = False
            self.stuck[dry.own[held]] = True
            self.sense[resting[senses != 0]] = senses[senses != 0]
            dry.last = None
            with suppress(StoppedError, np.linalg.LinAlgError):
                if self._lawful(resting, senses, t, y):
                    break
        else:
            self.stuck, self.sense = stuck, sense
            names = ", ".join(self.equation.joints[e] for e in resting)
            why = "neither sticking nor slipping satisfies the law of friction"
            raise StoppedError(f"the machine jams: for {names}, at rest, {why}")
        self.tied = _within(push, push[:, held]) & np.isin(np.arange(len(sense)), resting)
        self.bound = _within(np.eye(self.d), push[:, held]) & (y[self.d : 2 * self.d] == 0)
        self._note_change(stuck[dry.own], sense, t)

    def _lawful(self, resting: Ints, choice: Array, t: float, y: Array) -> bool:
        """True if the sticking contacts can stick, and the others move in their senses."""
        assert self.equation.dry is not None
        solved, contacts = self.solved(t, y)[0], self.equation.dry.own[resting]
        ahead, size = solved.second[contacts] * choice, solved.size[contacts]
        room, held = solved.room[contacts], np.abs(solved.cz[contacts])
        return bool(((choice == 0) | (ahead >= -EVEN * size)).all() and (room >= -EVEN * held).all())

    def _note_change(self, stuck: Flags, sense: Array, t: float) -> None:
        """Note which contacts stick now, slip again or have turned."""
        assert self.equation.dry is not None
        now = self.stuck[self.equation.dry.own]
        for e, joint in enumerate(self.equation.joints):
            if now[e] and not stuck[e]:
                self.note(t, "rest", f"{joint} sticks: its friction holds it", of=joint)
            elif stuck[e] and not now[e] and not self.tied[e]:
                self.note(t, "start", f"{joint} slips again", of=joint)
            elif sense[e] != self.sense[e] and not self.tied[e]:
                self.note(t, "reversal", f"{joint} reverses: its friction turns round", of=joint)


def _combinations(options: Sequence[Sequence[float]]) -> Iterator[Array]:
    """Choices of one option each, those of most zeros first."""
    return iter(sorted(map(np.array, product(*options)), key=np.count_nonzero))


def _within(columns: Array, of: Array) -> Flags:
    """Columns (D, K) that are sums of others (D, N)."""
    size, left = np.abs(columns).max(axis=0), columns - of @ np.linalg.lstsq(of, columns, rcond=PARALLEL)[0]
    return np.asarray((np.abs(left).max(axis=0) <= PARALLEL * size) & (size > 0))
