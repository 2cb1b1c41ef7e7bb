"""Friction and brakes at an instant: the test of rest is the analysis of the machine at rest at that position.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import compile_mechanism
from dalembert.analysis.one_pass import at_schedule
from dalembert.analysis.result.result import Result
from dalembert.arrays import Array, Flags
from dalembert.machine.motion.actuation import Actuation, drive_lengths
from dalembert.machine.motion.corners.elastic_stops import ElasticStops
from dalembert.machine.motion.equation import WEIGHTLESS, Equation, StoppedError, Terms, lightest, no_inertia
from dalembert.machine.motion.equation_trace import equation_of
from dalembert.machine.motion.occurrences import Event, Guard, Value, Words
from dalembert.machine.motion.rest.dry_friction import Contacted
from dalembert.model import Mechanism, Schedule
from dalembert.model.drives.drives import kind_of
from dalembert.model.drives.motors import Switch
from dalembert.model.quantities.coordinates import TIME
from dalembert.model.quantities.tables import Table

STILL = 1e-9
"""A speed below this part of the greatest so far is rest, at an event where it passes zero."""
ROUNDING = 1e-9
"""Part of a motor's effort below which what its shaft gives to its gear has no sign."""
SETTLED = 1e-9
"""Part of a motor's greatest effort by which the one it has come to at rest may differ from that of its curve."""
EVEN = 1e-10
"""Part of a limit of friction, or of what it accelerates, that is rounding."""
NOTHING, ASIDE = 1e-24, 1e-2
"""Part of the inertia of all links that a drive moves by the rounding of their speeds alone; and the radians, or parts
of the machine's length, by which another position is elsewhere."""
INSTANTS = 400
"""Number of instants at which friction at rest is checked."""


def at_state(m: Mechanism, first: Array, t: float, q: Array, u: Array, a: Array) -> Result:
    """The analysis at one state (its second position), led by the start, which decides the assembly mode."""
    turns = np.array([d.turns for d in m.drives.values()])
    turned = np.where(turns, 2 * np.pi * np.round((q - first) / (2 * np.pi)), 0.0)
    position, speed, rate = (np.stack(pair) for pair in ((first + turned, q), (u, u), (a, a)))
    schedule = Schedule(tuple(m.drives), position, speed, rate, np.array([t, t]))
    return at_schedule(m, schedule, inertia=True)


def holding_efforts(r: Result, k: int) -> tuple[float, float]:
    """Least and greatest effort of a drive, at the second position, between which its contacts stay at rest."""
    name = r.drives[k]
    ends = zip(r.interval(name)[1], r.holding(name)[1], strict=True)
    low, high = (float(x if np.isnan(held) else held) for x, held in ends)
    return low, high


class ContactState:
    """A motion's contacts and brakes at the moment: senses, and which drives they hold at rest; ``on_stop`` (D,): -1
    where a drive rests on its least stop, 1 on its greatest, or on a joint's on that side, named in ``resting``."""

    def __init__(self, m: Mechanism, actuation: Actuation) -> None:
        self.m, self.acting = m, actuation
        self.equation: Equation = actuation.equation or equation_of(m)
        self.d, self.lengths = len(actuation.names), drive_lengths(m)
        self.locked: Flags = np.zeros(self.d, bool)
        self.on_stop, self.resting = np.zeros(self.d), dict[int, str]()
        self.in_contact: set[str] = set()  # joints whose stops are contacts
        self.clutches: set[str] = set()  # joints that hold against one sense
        dry = self.equation.dry
        self.sense, self.toward = np.ones(len(dry.own) if dry else 0), np.ones(self.d)
        self.stuck: Flags = np.zeros(dry.contacts.count if dry else 0, bool)
        self.rubs: Flags = actuation.free & ((dry is not None) | (actuation.brake > 0) | actuation.lossy)
        self.fastest = np.abs(actuation.speed)
        self.elastic_joints = dict[int, ElasticStops]()
        self.events: list[Event] = []
        self.switched: set[tuple[int, str]] = set()
        self.evaluations, self.refusal = 0, ""
        self.by_time = self._by_time()
        self.tables = [v for v in self.by_time if isinstance(v, Table)]
        self.slipping: tuple[tuple[float, bytes], Array] = (np.nan, b""), np.zeros(0)

    def at(self, t: float, y: Array) -> tuple[Array, Array, Terms]:
        """Accelerations (D,), efforts (D,) of the drives with their brakes, and the terms."""
        contacts, effort, terms = self.solved(t, y)
        return contacts.a, effort, terms

    def solved(self, t: float, y: Array) -> tuple[Contacted, Array, Terms]:
        """Accelerations and friction, efforts (D,) of the drives with their brakes, and the terms."""
        q, u = y[: self.d], y[self.d : 2 * self.d]
        self.evaluations += 1
        rotor = self.acting.take_ways(self.toward)
        self.take_torques(y)
        applied = self.acting.effort(t, q, u)
        tau = applied - self.acting.brake * self.toward
        free = self.acting.free & ~self.locked
        a = self.acting.accelerations(t)
        state = self.sense, self.stuck, rotor, self.loaded_terms
        contacts, terms = self.equation.accelerations(t, q, u, a, tau, free, *state)
        held, tau = applied if self.equation.dry else contacts.effort, tau - rotor * contacts.a
        return contacts, np.where(free, tau, np.where(self.acting.free, held, contacts.effort)), terms

    def rate(self, t: float, y: Array) -> Array:
        """Time derivative of positions, speeds and works; no numbers where there is none, with the reason kept."""
        try:
            contacts, effort, terms = self.solved(t, y)
        except StoppedError as error:
            self.refusal = str(error)
            return np.full_like(y, np.nan)
        u = y[self.d : 2 * self.d]
        braking = -self.acting.brake * self.toward * u * ~self.locked
        rubbing = contacts.cz @ np.where(self.stuck, 0.0, terms.rates)
        power = self.acting.powers(t, y[: self.d], u, effort)
        late = self.acting.torque_rates(u)
        return np.concatenate([u, contacts.a, power - braking, [braking.sum()], terms.power, [rubbing], late])

    def elastic_force(self, j: int, terms: Terms) -> float:
        """Force of a joint's elastic stop in its freedom, N m or N."""
        raise NotImplementedError

    def loaded_terms(self, t: float, q: Array, u: Array) -> Terms:
        """The terms with the forces of joints' elastic stops."""
        return self.equation(t, q, u)

    def loaded_model(self, t: float, q: Array, u: Array) -> Mechanism:
        """The mechanism with the forces of joints' elastic stops as loads."""
        return self.m

    def take_torques(self, y: Array) -> None:
        """Take the efforts of late motors from a state, at whose end they are."""
        self.acting.torque = y[len(y) - len(self.acting.late) :]

    def torques_change(self, y: Array) -> bool:
        """True if efforts of late motors, at rest, are not yet what they lead to, or will be switched by time."""
        self.take_torques(y)
        waits = (s[0] == "time" for k in self.acting.late for _, s in self._switches(k))
        return any(waits) or any(map(self._is_late, self.acting.late))

    def _is_late(self, k: int) -> bool:
        """True if the effort of a motor at rest has not yet come to what it leads to."""
        goal, largest = self.acting.steady(k, np.zeros(self.d)), max(map(abs, self.acting.motors[k].effort))
        return abs(self.acting.motor_effort(k, np.zeros(self.d)) - goal) > SETTLED * largest

    def rubbing_rates(self, t: float, y: Array) -> Array:
        """Rates of the contacts (E,) that slip by themselves, those of the last state kept."""
        if self.slipping[0] != (t, y.tobytes()):
            q, u = y[: self.d], y[self.d : 2 * self.d]
            self.slipping = (t, y.tobytes()), self.own(self.equation(t, q, u).rates)
        return self.slipping[1]

    def own(self, rates: Array) -> Array:
        """Rates of the contacts that slip independently."""
        return rates[self.equation.dry.own] if self.equation.dry else rates

    def note(self, t: float, name: str, *words: str | tuple[str, float], of: str = "") -> None:
        self.events.append(Event(t, name, words, of))

    def _others_move(self) -> bool:
        """True if a prescribed drive moves."""
        others = ~self.acting.free
        return bool(self.acting.laws) or bool(
            (self.acting.speed[others] != 0).any() or (self.acting.acceleration[others] != 0).any()
        )

    def _check_inertia(self, t: float, y: Array) -> None:
        """Refuse drives that move nothing with inertia; friction is left out, which could seem to be some."""
        q, u, free = y[: self.d], y[self.d : 2 * self.d], np.flatnonzero(self.acting.free)
        mass = self.equation(t, q, u).mass + np.diag(self.acting.take_ways(self.toward))
        mass = mass[np.ix_(free, free)]
        if not len(free) or not np.isfinite(mass).all():
            return
        least, k = lightest(mass)
        if self.equation.dry and least < WEIGHTLESS:
            raise StoppedError(no_inertia(self.acting.names[free[k]]))
        c = compile_mechanism(self.m, self.m.schedule())
        inertia, length = c.forcing.inertia, c.layout.length
        heavy = float(np.abs(inertia.inertia).sum() + np.abs(inertia.mass).sum() * length**2)
        arms = np.where(self.acting.turns, 1.0, length)
        none = NOTHING * heavy / arms**2
        for k in free[(np.abs(mass.diagonal()) <= none[free])]:
            beside = float(self.equation(t, q + ASIDE * arms, u).mass[k, k])
            where = " in this position" if abs(beside) > none[k] else ""
            raise StoppedError(no_inertia(self.acting.names[k], where))

    def _range(self, k: int, t: float, y: Array) -> tuple[float, float, float]:
        """Effort that acts on a drive at rest, and the least and greatest with which it stays at rest."""
        q, u = y[: self.d], y[self.d : 2 * self.d]
        held = self.locked.copy()
        self.locked[k] = True
        self.take_torques(y)
        try:
            a = self.at(t, y)[0] if not self.locked[self.acting.free].all() else np.zeros(self.d)
        finally:
            self.locked = held
        r = at_state(self.loaded_model(t, q, u), self.acting.position, t, q, u, a)
        name = self.acting.names[k]
        low, high = holding_efforts(r, k) if self.equation.dry else (float(r.effort(name)[1]),) * 2
        if np.isnan(low) or np.isnan(high):
            raise StoppedError(f"{name} is at rest: {r.reasons[1] or r.status[1]}")
        tau, half = self._held(k, t, q, u)
        low, high = low - half, high + half
        return tau, -np.inf if self.on_stop[k] < 0 else low, np.inf if self.on_stop[k] > 0 else high

    def _held(self, k: int, t: float, q: Array, u: Array) -> tuple[float, float]:
        """Effort that acts on a drive at rest, and by how much its brake, and the losses of its gear, may change it."""
        acting, ends = self.acting, []
        for way in (1.0, -1.0):
            toward = self.toward.copy()
            toward[k] = way
            if k in acting.gears:
                acting.side[k] = 1.0 if acting.shaft(k, u, np.zeros(self.d)) >= 0 else -1.0
            acting.take_ways(toward)
            ends.append(float(acting.effort(t, q, u)[k]))
        return (ends[0] + ends[1]) / 2, abs(ends[1] - ends[0]) / 2 + float(acting.brake[k])

    def gear_guards(self, t: float, y: Array) -> list[Guard]:
        """Torque of motors' shafts on their gears, on its present side; where that passes 0, their law has a corner."""

        def shaft(k: int) -> Value:
            return lambda t, y: self.acting.shaft(k, y[self.d : 2 * self.d], self.at(t, y)[0])

        out = []
        for k in np.flatnonzero(self.acting.lossy & ~self.locked):
            value, size = (
                shaft(int(k))(t, y),
                abs(self.acting.shaft(int(k), y[self.d : 2 * self.d], np.zeros(self.d))),
            )
            if value * self.acting.side[k] < -ROUNDING * size:
                self.acting.side[k] *= -1
            out.append(Guard("gear", int(k), shaft(int(k))))
        return out

    def _settle(self, k: int, t: float, y: Array) -> None:
        """Locks a drive that is at rest and held, or releases it in the sense of the end that is passed."""
        tau, low, high = self._range(k, t, y)
        name, was = self.acting.names[k], self.locked[k]
        wide = bool(self.on_stop[k]) or high - low > 1e-12 * max(abs(low), abs(high), 1e-300)
        if wide and low <= tau <= high:
            self.locked[k] = True
            if self.on_stop[k]:
                if not was:
                    self.note(t, "rest", f"{self.resting[k]} {self._holds(k)}", of=self.resting[k])
                return
            kind = kind_of(self.acting.drives[k].freedom, "effort")
            stalls = k in self.acting.motors and self.acting.on[k] and not self._is_late(k)
            why = "its motor stalls" if stalls else "friction holds it"
            ends: Words = ("; effort ", (kind, tau), ", held from ", (kind, low), " to ", (kind, high))
            self.note(t, "rest", f"{name} comes to rest and stays: {why}", *ends, of=name)
            return
        self.locked[k], left, self.on_stop[k] = False, self.on_stop[k], 0.0
        self.toward[k] = 1.0 if tau > high or (not wide and tau >= (low + high) / 2) else -1.0
        rates, ahead = self.rubbing_rates(t, y), np.zeros(self.d)
        ahead[k] = self.toward[k]
        pushed = self.own(self.equation(t, y[: self.d], ahead).rates)
        still = np.abs(rates) <= STILL * np.abs(pushed)
        self.sense = np.where(still & (pushed != 0), np.where(pushed < 0, -1.0, 1.0), self.sense)
        if t > 0 or was:
            lifts = bool(left) and self.resting[k] in self.in_contact
            name = self.resting[k] if left else name
            what = (
                "lifts off"
                if lifts
                else "turns freely"
                if left and name in self.clutches
                else "leaves its stop"
                if left
                else "starts again"
                if was
                else "turns back"
            )
            self.note(t, "lift-off" if lifts else "start" if was else "reversal", f"{name} {what}", of=name)

    def _holds(self, k: int) -> str:
        if self.resting[k] in self.in_contact:
            return "stays in contact"
        return "holds" if self.resting[k] in self.clutches else "stays on its stop"

    def _loose(self, t: float, y: Array) -> list[int]:
        """Locked drives that are no longer held."""
        ranges = {int(k): self._range(int(k), t, y) for k in np.flatnonzero(self.locked)}
        return [k for k, (tau, low, high) in ranges.items() if not low <= tau <= high]

    def leaving(self, t: float, y: Array) -> list[int]:
        """Contacts that slip by themselves, and stick, and are no longer held."""
        if not self.stuck.any():
            return []
        solved = self.solved(t, y)[0]
        return np.flatnonzero(self.own(solved.room + EVEN * np.abs(solved.cz)) < 0).tolist()

    def _yields(self, t: float, y: Array) -> bool:
        """True if a part at rest is no longer held."""
        return bool(self._loose(t, y) or self.leaving(t, y))

    def _switches(self, k: int) -> list[tuple[str, Switch]]:
        """Switches of a motor that wait."""
        pairs = (("on", self.acting.motors[k].on), ("off", self.acting.motors[k].off))
        waiting = [(key, s) for key, s in pairs if s is not None and (k, key) not in self.switched]
        return [(key, s) for key, s in waiting if key == "off" or not self.acting.on[k]]

    def _switch(self, t: float, k: int, key: str) -> None:
        """Switch a motor on or off."""
        self.acting.on[k] = key == "on"
        self.switched.add((k, key))
        self.note(t, f"motor {key}", f"the motor of {self.acting.names[k]} is switched {key}")

    def _let_go(self, t: float, end: float, y: Array) -> float:
        """Instant at which a part at rest is no longer held; for motors that are switched by time, the switching
        instant."""
        switches = [
            (s[1], k, key) for k in self.acting.motors for key, s in self._switches(k) if s[0] == "time"
        ]
        switches = [s for s in switches if s[0] > t]
        stop = min([end, *(s[0] for s in switches)])
        if self.by_time:
            steps = np.union1d(np.linspace(t, stop, INSTANTS), self._bends(t, stop))[1:]
            for before, after in zip([t, *steps[:-1]], steps, strict=True):
                if self._yields(after, y):
                    return self._loosening(before, after, lambda _: y)
        if stop < end:
            for when, k, key in switches:
                if when == stop:
                    self._switch(when, k, key)
            return stop if self._yields(stop, y) else self._let_go(stop, end, y)
        return end

    def _by_time(self) -> list[Any]:
        """Loads and efforts that depend on time."""
        acting = getattr(self.acting, "own", self.acting)
        loads = (v for load in self.m.loads.values() for v in getattr(load, "varying", ()))
        return [v for v in (*loads, *(d.effort for d in acting.drives)) if TIME in getattr(v, "names", ())]

    def next_bend(self, t: float) -> float:
        """The next instant at which a table over time has a point."""
        return min((table.next_point(t) for table in self.tables), default=self.acting.next_joint(t))

    def _bends(self, t: float, end: float) -> list[float]:
        """Instants before the end at which tables over time have points."""
        out = [t]
        while (after := self.next_bend(out[-1])) < end:
            out.append(after)
        return out

    def _loosening(self, low: float, high: float, state: Callable[[float], Array]) -> float:
        """Instant at which a locked drive is released, by halving."""
        while high - low > 1e-14 * high:
            middle = (low + high) / 2
            if middle in (low, high):
                break
            low, high = (low, middle) if self._yields(middle, state(middle)) else (middle, high)
        return float(high)
