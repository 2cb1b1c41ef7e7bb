"""Contacts along a motion: which are closed, when one lifts off, and where it lands.

A closed contact is a freedom, its gap, that is held at 0: the effort that this takes is its normal force. Several that
touch at once are closed or open so that all forces push and all gaps open: all sets are tried, most closed ones first.

Mechanics: docs/theory.md 10.7.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from itertools import product

import numpy as np

from dalembert.arrays import Array
from dalembert.machine.motion.actuation import Actuation
from dalembert.machine.motion.equation import StoppedError
from dalembert.machine.motion.occurrences import Guard, Value, Words, say
from dalembert.machine.motion.rest.standstill import at_state
from dalembert.machine.motion.stops.contact_answer import normal_size
from dalembert.machine.motion.stops.gap_contacts import GapContact
from dalembert.machine.motion.stops.impacts import Stop, StopState
from dalembert.model import Mechanism

ROUNDING = 1e-9
"""Part of the largest force or acceleration of an instant that is rounding."""
NOISE = 1e-13
"""Part of the largest effort by which a contact's force may pass 0 and be 0."""
SLIDES = 1e-9
"""Part of the greatest speed so far below which a gap does not change."""
AT_ONCE = 10
"""Contacts that touch at once whose sets are tried: 2^10 there are."""


class TouchState(StopState):
    """A motion whose contacts may open; ``closed``: those that do not."""

    def __init__(self, m: Mechanism, actuation: Actuation) -> None:
        super().__init__(m, actuation)
        self.contacts: tuple[GapContact, ...] = tuple(c for c in actuation.contacts if c.drive >= 0)
        self.closed: set[GapContact] = set()
        self.before: set[GapContact] = set()  # closed before an impact
        self.slipped = 0.0  # energy that wheels lost when they began to roll, not counted yet
        self.gap_stops: dict[GapContact, Stop] = {}
        for c in actuation.contacts:
            if c.drive >= 0:
                self.rubs[c.drive] = False
            self.gap_stops[c] = next(s for s in self.stops if self._is_stop(s, c))
            self.gap_stops[c].contact = c
        self.in_contact = {c.joint for c in actuation.contacts}
        for c in self.contacts:
            if self.acting.position[c.drive] == c.at and self.acting.speed[c.drive] == 0:
                self._close(c)

    @staticmethod
    def _is_stop(stop: Stop, c: GapContact) -> bool:
        if c.drive >= 0:
            return stop.drive == c.drive
        return (stop.joint >= 0, stop.name, stop.freedom) == (True, c.joint, c.freedom)

    def _close(self, c: GapContact, y: Array | None = None) -> None:
        """Hold a gap at 0, and with it the slip of a wheel that rolls."""
        self.closed.add(c)
        self.gap_stops[c].resting = -c.side
        for k in (c.drive, *([c.slip] if c.slip >= 0 and not c.rough else [])):
            self.acting.free[k] = False
            self.acting.speed[k] = self.acting.acceleration[k] = 0.0
        if y is not None:
            y[c.drive], y[self.d + c.drive] = c.at, 0.0

    def _open(self, c: GapContact) -> None:
        self.closed.discard(c)
        self.gap_stops[c].resting = 0.0
        self.acting.free[[c.drive, *([c.slip] if c.slip >= 0 else [])]] = True

    def normals(self, t: float, y: Array) -> dict[GapContact, float]:
        """Normal forces of the closed contacts."""
        if not self.closed:
            return {}
        effort = self.at(t, y)[1]
        return {c: c.side * float(effort[c.drive]) for c in self.closed}

    def normal_size(self, c: GapContact, t: float, y: Array) -> float:
        """Normal force of a contact for a unit effort along its gap."""
        if not self.m.joints[c.joint].outlined:
            return 1.0
        q, u = y[: self.d], y[self.d : 2 * self.d]
        return float(normal_size(at_state(self.m, self.acting.position, t, q, u, 0 * u), c)[1])

    def contact_force(self, c: GapContact, t: float, y: Array) -> float:
        """Normal force of a contact, 0 of an open one."""
        if c.drive >= 0:
            return c.side * float(self.at(t, y)[1][c.drive]) if c in self.closed else 0.0
        stop = self.gap_stops[c]
        return c.side * float(self._pushing(t, y)[self.pressed.index(stop)]) if stop in self.pressed else 0.0

    def _settle_start(self, t: float, y: Array) -> None:
        super()._settle_start(t, y)
        if not self.contacts:
            return
        forces = self.normals(t, y)
        small = ROUNDING * max(map(abs, self.at(t, y)[1]), default=0.0)
        for c, force in forces.items():
            if force < -small:
                self.lost_at_start(c, -force * self.normal_size(c, t, y))
        if min(forces.values(), default=np.inf) <= small:
            self.decide_gaps(t, y)

    def lost_at_start(self, c: GapContact, force: float) -> None:
        """Refuse to start with a contact that would have to pull."""
        words: Words = (f"{c.joint} would have to pull{c.where} with ", ("force", force), " at the start")
        raise StoppedError(f"{say(words)}: the contact is lost")

    def _touching(self, c: GapContact, y: Array) -> bool:
        """True if a gap is closed, and neither opens nor closes."""
        still = abs(y[self.d + c.drive]) <= SLIDES * max(float(self.fastest.max()), 1e-300)
        return c in self.closed or (still and self._touches(self.gap_stops[c], -c.side, 0.0, y))

    def decide_gaps(self, t: float, y: Array) -> None:
        """Close and open the contacts that touch so that none pulls and no gap would become negative."""
        near = [c for c in self.contacts if self._touching(c, y)]
        before = set(self.closed)
        if len(near) > AT_ONCE:
            raise StoppedError(f"{len(near)} contacts touch at once; {AT_ONCE} can be decided")
        state = y.copy()
        for closed in sorted(product((True, False), repeat=len(near)), key=lambda s: -sum(s)):
            y[:] = state
            self._close_some(near, closed, y)
            with suppress(StoppedError, np.linalg.LinAlgError):
                if self._pushes_all(near, t, y):
                    break
        else:
            y[:] = state
            self._close_some(near, [c in before for c in near], y)
            names = ", ".join(c.joint + c.where for c in near)
            raise StoppedError(f"no set of the contacts {names} satisfies the signs of forces and gaps")
        self._refuse_rough_tips()
        for c in before - self.closed:
            self.note(t, "lift-off", f"{c.joint} lifts off{c.where}", of=c.joint)

    def _refuse_rough_tips(self) -> None:
        """Refuse to follow a guide with friction that tips: its friction would act beside its point."""
        dry = self.equation.dry
        rough = set[str]()
        if dry is not None:
            rubs = np.flatnonzero(dry.contacts.coefficient + dry.contacts.resting > 0)
            rough = {tuple(self.m.joints)[dry.contacts.joint[e]] for e in rubs}
        ends = {
            j: sum(c.joint == j for c in self.closed)
            for j in rough & {c.joint for c in self.contacts if c.where}
        }
        tips = [j for j, count in ends.items() if count == 1]
        if tips:
            raise StoppedError(
                f"{tips[0]} tips, and its guide has friction, which is not followed on one end; write two slots with "
                "contact: pushes and friction, one at each end"
            )

    def _close_some(self, near: Sequence[GapContact], closed: Sequence[bool], y: Array) -> None:
        for c, stays in zip(near, closed, strict=True):
            if stays:
                self._close(c, y)
            else:
                self._open(c)
        self._stop_slips(y)

    def _stop_slips(self, y: Array) -> None:
        """Take the slip from wheels that roll from now on: impulses along it, and on what is held."""
        d, free = self.d, np.flatnonzero(self.acting.free)
        rolling = [c.slip for c in self.closed if c.slip >= 0 and not c.rough]
        u = y[d : 2 * d]
        if not u[rolling].any():
            return
        mass = self.equation(0.0, y[:d], u).mass
        change = np.zeros(d)
        change[rolling] = -u[rolling]
        if len(free):
            change[free] = -np.linalg.solve(mass[np.ix_(free, free)], mass[free] @ change)
        given = np.where(self.acting.free | (change != 0), 0.0, mass @ change * u)  # by what is prescribed
        lost = (u @ mass @ u - (u + change) @ mass @ (u + change)) / 2 + given.sum()
        u += change
        y[2 * d : 3 * d] += given
        self.slipped += float(lost)

    def _pushes_all(self, near: Sequence[GapContact], t: float, y: Array) -> bool:
        """True if shortly behind a state closed contacts push and the others open."""
        a, effort, _ = self.at(*self.soon(t, y))
        forces, rates = ROUNDING * np.abs(effort).max(initial=0.0), ROUNDING * np.abs(a).max(initial=0.0)
        return all(
            c.side * effort[c.drive] >= -forces if c in self.closed else c.side * a[c.drive] >= -rates
            for c in near
        )

    # events

    def stop_guards(self) -> list[Guard]:
        """Stops, and forces of closed contacts."""
        lifting = [(n, c) for n, c in enumerate(self.contacts) if c in self.closed]

        def force(c: GapContact) -> Value:
            def value(t: float, y: Array) -> float:
                effort = self.at(t, y)[1]
                return c.side * float(effort[c.drive]) + NOISE * float(np.abs(effort).max())

            return value

        return super().stop_guards() + [Guard("lift", n, force(c), 1.0) for n, c in lifting]

    def strike(self, hit: Sequence[tuple[int, float]], t: float, y: Array) -> None:
        """Closed contacts take part in an impact as those that touch."""
        was = {c: self.gap_stops[c].resting for c in self.closed}
        self.before = set(was)
        for c in list(was):
            self._open(c)
            self.gap_stops[c].resting = was[c]
        super().strike(hit, t, y)

    def _note_rests(self, t: float, y: Array) -> None:
        resting = [c for c in self.contacts if self.gap_stops[c].resting]
        for c in resting:
            self._close(c, y)
        bounced = [c for c in resting if c.restitution and c not in self.before]
        if self.contacts:
            self.decide_gaps(t, y)
        for c in bounced:
            if c in self.closed:
                self.note(t, "rest", f"{c.joint} stays in contact{c.where}", of=c.joint)
        if self.slipped:
            self.losses.append((t, self.slipped))
            self.slipped = 0.0
        super()._note_rests(t, y)

    def _plain_stops(self) -> list[Stop]:
        return [s for s in self.stops if s.contact is None or s.contact.drive < 0]

    def _yields(self, t: float, y: Array) -> bool:
        small = ROUNDING * max(map(abs, self.at(t, y)[1]), default=0.0) if self.closed else 0.0
        return super()._yields(t, y) or any(f < -small for f in self.normals(t, y).values())

    def why_stopped(self, otherwise: str) -> str:
        """Why the motion does not go on: lost contacts whose gaps are coordinates, or the reason without these."""
        lost = dict.fromkeys(c.joint for c in self.contacts if c not in self.closed and c.freedom != "slide")
        if not lost:
            return otherwise
        return (
            f"without contact at {' and '.join(lost)} the gaps do not determine the position of the links; "
            "guide the link by joints that remain: two sliders and a pin"
        )

    def open_pulling(self, t: float, y: Array) -> None:
        """Open contacts that would have to pull, as where everything else is at rest."""
        if any(f < 0 for f in self.normals(t, y).values()):
            self.decide_gaps(t, y)
