"""Contacts at rest in machines of several freedoms: which of them stick, and the senses of the others.

A contact sticks while the force that keeps its rate at 0 is within the limit of its coefficient at rest. Sets of
contacts at rest that stick, and senses of the others, are tried, most sticking ones first, until one satisfies
friction's law. Of contacts that can only slip together, as those of a part of one freedom, one sticks at most, and the
others are at their limits: which of them push ahead is open.

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
from dalembert.machine.motion.rest.standstill import EVEN, STILL
from dalembert.model import Mechanism

AT_ONCE, MOST = 7, 10_000
"""Independent directions of contacts at rest whose sets are tried, 3^7 where each has one contact; sets at most."""
PARALLEL = 1e-9
"""A column is a sum of others where less than this part of it is left over."""
DIGITS = 1e-14
"""Part of what a drive at the machine's pace would have, or give to a contact, that is rounding of a speed."""


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
        self._check_inertia(t, y)
        self.find_sides(t, y)
        if self.equation.dry:
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
        alone = bool(drives) and (single or len(_parallel(push[:, resting])) > AT_ONCE)
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
        slow = np.abs(y[self.d : 2 * self.d]) <= self._slowest
        begins = slow & self.acting.free & ~(self.locked | self.bound | self._kept)
        if begins.any():
            ahead = self.at(*self.soon(t, y))[0][begins]  # where it slips the acceleration is nothing yet
            self.toward[begins] = np.where(ahead < 0, -1.0, 1.0)

    @property
    def _pace_speeds(self) -> Array:
        """Speeds (D,) that drives have at the pace of the fastest one."""
        return self.lengths * float((self.fastest / self.lengths).max(initial=0.0))

    @property
    def _slowest(self) -> Array:
        """Speeds (D,) below which a drive is at rest."""
        return np.maximum(STILL * self.fastest, DIGITS * self._pace_speeds)

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
        least = DIGITS * (self._pace_speeds[:, None] * np.abs(push)).max(axis=0, initial=0.0)
        slow = self.tied | (np.abs(rates) <= np.maximum(STILL * (self.fastest @ np.abs(push)), least))
        push = push * (self.acting.free & ~(self.locked & self._kept))[:, None]
        return np.flatnonzero(slow & push.any(axis=0)), rates, push

    def _stop(self, push: Array, rates: Array, y: Array) -> None:
        """Take from the speeds what is left of the rates of contacts at rest."""
        if not push.shape[1]:
            return
        u = y[self.d : 2 * self.d]
        u += np.linalg.lstsq(push.T, rates, rcond=PARALLEL)[0]
        u[_within(np.eye(self.d), push) & (np.abs(u) <= self._slowest)] = 0.0

    def _choose(self, resting: Ints, push: Array, t: float, y: Array, leaving: Sequence[int]) -> None:
        """Take the first set of sticking contacts, and senses of the others, that satisfies friction's law."""
        dry = self.equation.dry
        if not dry or not len(resting):
            self.stuck[:], self.tied[:], self.bound[:] = False, False, False
            return
        stuck, sense = self.stuck.copy(), self.sense.copy()
        for senses in self._options(resting, push, t, y, leaving):
            held = resting[senses == 0]
            if np.linalg.matrix_rank(push[:, held], tol=PARALLEL * np.abs(push).max()) < len(held):
                continue
            self.stuck[:] = False
            self.stuck[dry.own[held]] = True
            self.sense[resting[senses != 0]] = senses[senses != 0]
            dry.last = None
            with suppress(StoppedError, np.linalg.LinAlgError):
                loose = ~_within(push[:, resting], push[:, held])
                if self._lawful(resting, senses, loose, t, y):
                    break
        else:
            self.stuck, self.sense = stuck, sense
            names = ", ".join(self.equation.joints[e] for e in resting)
            why = "neither sticking nor slipping satisfies the law of friction"
            raise StoppedError(f"the machine jams: for {names}, at rest, {why}")
        tied, self.tied = self.tied, _within(push, push[:, held]) & np.isin(np.arange(len(sense)), resting)
        self.bound = _within(np.eye(self.d), push[:, held]) & (y[self.d : 2 * self.d] == 0)
        self._note_change(stuck[dry.own] | tied, sense, t)

    def _options(
        self, resting: Ints, push: Array, t: float, y: Array, leaving: Sequence[int]
    ) -> Iterator[Array]:
        """Senses of contacts at rest, 0 where one sticks, in the order in which they are tried; those that are
        ``leaving`` slip."""
        dry, sense = self.equation.dry, self.sense[resting]
        assert dry is not None
        solved = self.solved(t, y)[0]
        slips = {e: float(-np.sign(solved.cz[dry.own[e]])) for e in leaving}
        bound = np.array([slips.get(int(e), 0.0) for e in resting])
        groups = _parallel(push[:, resting])
        choices = [_choices(ways, np.where(bound, bound, sense), bound) for ways in groups]
        if np.prod([float(len(x)) for x in choices]) > MOST:
            what = f"{len(resting)} contacts come to rest at once, in {len(groups)} independent directions"
            raise StoppedError(f"{what}; which of them stick cannot be decided")
        sets = (np.sum(each, axis=0) for each in product(*choices))
        return iter(sorted(sets, key=np.count_nonzero))

    def _lawful(self, resting: Ints, choice: Array, loose: Flags, t: float, y: Array) -> bool:
        """True if the sticking contacts can stick, and the others that are ``loose`` move in their senses."""
        assert self.equation.dry is not None
        solved, contacts = self.solved(t, y)[0], self.equation.dry.own[resting]
        ahead, size = solved.second[contacts] * choice, solved.size[contacts]
        room, held = solved.room[contacts], np.abs(solved.cz[contacts])
        return bool((~loose | (ahead >= -EVEN * size)).all() and (room >= -EVEN * held).all())

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


def _parallel(push: Array) -> list[Array]:
    """Contacts of one direction of slip each, by their columns (D, R): the ways (R,) in which they slip together, 1 or
    -1, and 0 of the others."""
    unit, left, out = push / np.linalg.norm(push, axis=0), list(range(push.shape[1])), []
    while left:
        along = unit[:, left[0]] @ unit[:, left]
        ways = np.zeros(push.shape[1])
        ways[left] = np.where(1 - np.abs(along) <= PARALLEL, np.sign(along), 0.0)
        out.append(ways)
        left = [k for k in left if not ways[k]]
    return out


def _choices(ways: Array, sense: Array, forced: Array) -> list[Array]:
    """Senses (R,) of contacts that slip together, 0 of those of other directions: first one sticks, and is the only one
    below its limit, then all slip. On the path from all that push back to all that push ahead, by one contact after the
    other, the first case is met wherever they can hold."""
    group, away = np.flatnonzero(ways), forced * ways
    chain, now = sorted(group.tolist(), key=lambda k: -away[k]), np.where(ways, sense, 0.0)
    path = [np.where(np.isin(np.arange(len(ways)), chain[:n]), ways, -ways) for n in range(len(chain))]
    bases = [[now] * len(chain), path] if len(chain) > 1 else [[now]]
    out = []
    for senses in bases:
        for k, of in zip(chain, senses, strict=True):
            if not forced[k]:
                out.append(np.where(np.arange(len(ways)) == k, 0.0, of))
    first = float(now[group[0]] * ways[group[0]])
    slides = [w * ways for w in (first, -first) if (away[group] * w >= 0).all()]
    return [*out, *slides]


def _within(columns: Array, of: Array) -> Flags:
    """Columns (D, K), none of zeros, that are sums of others (D, N)."""
    size, left = np.abs(columns).max(axis=0), columns - of @ np.linalg.lstsq(of, columns, rcond=PARALLEL)[0]
    return np.asarray(np.abs(left).max(axis=0) <= PARALLEL * size)
