"""End stops: impacts by Newton's law of restitution, and rest on a stop whose force can only push.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.optimize import brentq, nnls

from dalembert.answer.column import Scale
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.machine.motion.actuation import Actuation, joint_stops
from dalembert.machine.motion.equation import OPEN, StoppedError, Terms
from dalembert.machine.motion.occurrences import Event, Guard, Words, say
from dalembert.machine.motion.rest.dry_friction import Contacted
from dalembert.machine.motion.rest.standstill import STILL
from dalembert.machine.motion.stops.clutch_stops import ClutchState
from dalembert.model import Mechanism
from dalembert.model.drives.drives import kind_of
from dalembert.model.drives.end_stops import Stops

SLOW = 1e-6
"""A part that rebounds from a stop with less than this part of the greatest speed so far comes to rest on it: the
remaining bounces are smaller than the accuracy of positions."""
LOOKS = 9
"""Number of instants of a step at which stops are checked."""
TOUCHING = 1e-12
"""Distance from a stop, m or rad, that is rounding: it takes part in an impact at another."""
LEFT = 1e-14
"""Distance from a stop, m or rad, that is none where a step begins on it and leaves it."""
UNMOVED = 1e-12
"""Part of a joint's motion with the drives that is rounding."""

Look = tuple[float, float, float]
"""A time, and position and speed of a freedom then."""


@dataclass
class Stop:
    """Stops of a drive, by its number, or of a joint, by its place among ``Terms.freedoms``.

    ``resting``: -1 on the least, 1 on the greatest; ``contact``: whose gap it is; ``looks``: positions over the last
    step, full turns counted.
    """

    name: str
    freedom: str
    ends: Stops
    drive: int = -1
    joint: int = -1
    way: float = (
        0.0  # of a one-way clutch or a ratchet: the sense in which it is free, and the pitch of its teeth
    )
    pitch: float = 0.0
    resting: float = 0.0
    contact: Any = None
    looks: list[Look] = field(default_factory=lambda: [(0.0, 0.0, 0.0)])

    def end(self, side: float) -> float:
        """Position of the stop on one side."""
        return self.ends.least if side < 0 else self.ends.greatest

    def near(self, x: float, guess: float) -> float:
        """The position equal to x up to full turns, nearest to a guess; a drive counts its turns."""
        counts = self.joint >= 0 and self.freedom == "turn"
        return x + 2 * np.pi * round((guess - x) / (2 * np.pi)) if counts and np.isfinite(x) else x


class StopState(ClutchState):
    """A motion whose drives and joints may strike stops; ``losses``: when, and the energy lost, J."""

    def __init__(self, m: Mechanism, actuation: Actuation) -> None:
        super().__init__(m, actuation)
        self.losses: list[tuple[float, float]] = []
        self.pressed: list[Stop] = []
        self.pushing = np.zeros(0)
        drives = enumerate(actuation.drives)
        free = [
            (k, drive)
            for k, drive in drives
            if actuation.free[k] and drive.stops and k not in actuation.elastic
        ]
        self.stops = [Stop(actuation.names[k], str(d.freedom), d.stops, drive=k) for k, d in free if d.stops]
        joints = enumerate(joint_stops(m).items())
        for j, ((name, freedom), ends) in joints:
            if ends.stiffness:  # never struck
                ends = replace(ends, least=-np.inf, greatest=np.inf)
            way, pitch = (float(getattr(m.joints[name], key, 0.0)) for key in ("way", "pitch"))
            self.stops.append(Stop(name, freedom, ends, joint=j, way=way, pitch=pitch))
        self.clutches = {stop.name for stop in self.stops if stop.way}
        y = np.concatenate([actuation.position, actuation.speed])
        for stop in self.stops:
            self._place_at_start(stop, *self.motion_of(stop, 0.0, y))

    def _place_at_start(self, stop: Stop, x: float, rate: float) -> None:
        """Counts full turns so that a joint starts between its stops; a clutch holds from where it starts."""
        if stop.way:
            self._place_clutch(stop, x, rate)
            return
        least, greatest, small = stop.ends.least, stop.ends.greatest, 1e-9
        ends = [stop.near(x, end) for end in (0.0, least, greatest) if np.isfinite(end)]
        at = [x + n for x in ends for n in (0.0, 2 * np.pi, -2 * np.pi) if n == 0 or x != stop.near(x, x + n)]
        within = [x for x in at if least - small <= x <= greatest + small]
        if not within and np.isfinite(x):
            kind, place = kind_of(stop.freedom, ""), x if abs(x) > small else 0.0
            path = ("joints", stop.name, "stops") if stop.joint >= 0 else ("start", stop.name, "position")
            raise ModelError(
                f"{stop.name} starts beyond its stops, at {say(((kind, place),), Scale(self.m.units))}",
                "start between them",
                path,
            )
        stop.looks = [(0.0, within[0] if within else x, rate)]

    def motion_of(self, stop: Stop, t: float, y: Array) -> tuple[float, float]:
        """Position, for a joint's turn up to full turns, and speed."""
        d = self.d
        if stop.joint < 0:
            return float(y[stop.drive]), float(y[d + stop.drive])
        x, rate = self.equation(t, y[:d], y[d : 2 * d]).freedoms[stop.joint][:2]
        return float(x), float(rate)

    def stop_guards(self) -> list[Guard]:
        """Stops without contact, on the side of the approach; and forces of those in contact."""

        def beyond(stop: Stop, x: float) -> Callable[[float, Array], float]:
            return lambda t, y: stop.near(self.motion_of(stop, t, y)[0], x) - x

        self._note_leaving()
        sides = [(k, stop, side) for k, stop in enumerate(self.stops) for side in (-1.0, 1.0)]
        met = [
            Guard("stop", k, beyond(stop, stop.end(side)), -side)
            for k, stop, side in sides
            if np.isfinite(stop.end(side)) and stop.resting != side
        ]
        held = [k for k, stop in enumerate(self.stops) if stop in self.pressed]

        def pressure(stop: Stop) -> Callable[[float, Array], float]:
            return lambda t, y: -stop.resting * float(self._pushing(t, y)[self.pressed.index(stop)])

        holding = [Guard("hold", k, pressure(self.stops[k]), 1.0) for k in held]
        return met + holding + self.clutch_guards()

    def _pushing(self, t: float, y: Array) -> Array:
        self.at(t, y)
        return self.pushing

    def strikes(self, g: Guard, state: Callable[[float], Array], before: float, after: float) -> float | None:
        """When a stop is met within a step; one that begins on it leaves it first."""
        stop, x = self.stops[g.which], self.stops[g.which].end(-g.side)

        def look(t: float, last: Look) -> Look:
            place, rate = self.motion_of(stop, t, state(t))
            return t, stop.near(place, last[1] + (t - last[0]) * (rate + last[2]) / 2), rate

        if (stop.looks[0][0], stop.looks[-1][0]) != (before, after) or len(stop.looks) < LOOKS:
            looks = [look(before, stop.looks[-1])]
            for t in np.linspace(before, after, LOOKS)[1:].tolist():
                looks.append(look(t, looks[-1]))
            stop.looks = looks
        for low, high in pairwise(stop.looks):
            start, first = low[0], (low[1] - x) * g.side
            if not (high[1] - x) * g.side < min(first, 0.0):
                continue
            if first <= LEFT * (1 + abs(x)) and low[2] * g.side > 0 > high[2] * g.side:
                start = float(
                    brentq(lambda t, low=low: look(t, low)[2], low[0], high[0], xtol=1e-300, rtol=1e-15)
                )
            within = (look(start, low)[1] - x) * g.side > 0
            ends = (start, high[0])
            return (
                float(brentq(lambda t, low=low: look(t, low)[1] - x, *ends, xtol=1e-300, rtol=1e-15))
                if within
                else start
            )
        return None

    def strike(self, hit: Sequence[tuple[int, float]], t: float, y: Array) -> None:
        """Applies u+ = u- - M^-1 n I at stops that are met, each on its side: I >= 0, and where I > 0 the rebound has
        the speed of its restitution (Moreau); stops in contact push too. Parts held by friction are released."""
        d, free = self.d, np.flatnonzero(self.acting.free)
        u = y[d : 2 * d]
        self.fastest = np.maximum(self.fastest, np.abs(u))
        for k, side in hit:
            if self.stops[k].drive >= 0:
                y[self.stops[k].drive] = self.stops[k].end(side)
        others = [(k, stop) for k, stop in enumerate(self.stops) if k not in dict(hit)]
        all_ = [
            *hit,
            *((k, side) for k, stop in others for side in (-1.0, 1.0) if self._touches(stop, side, t, y)),
        ]
        terms = self.equation(t, y[:d], u)
        rows = np.array([self._row(self.stops[k], terms) * side for k, side in all_])
        closing, size = rows @ u, np.abs(rows).max(axis=1) * max(float(self.fastest.max()), 1e-300)
        e = np.array([self.stops[k].ends.restitution for k, _ in all_])
        back = e * np.maximum(closing, 0.0)
        left, back = (
            np.where(back > SLOW * size, 0.0, back / np.maximum(1 - e, SLOW)),
            back * (back > SLOW * size),
        )
        rotor, links = self.acting.take_ways(self.toward), terms.mass
        mass = links + np.diag(rotor)
        ease = np.linalg.solve(mass[np.ix_(free, free)], rows[:, free].T)
        response = rows[:, free] @ ease
        for (k, _), row, speed in zip(hit, rows, closing, strict=False):
            if np.abs(row[free]).max() <= UNMOVED * np.abs(row).max() and speed > 0:
                raise StoppedError(f"{self.stops[k].name} is driven against its stop by what is prescribed")
        impulse, before = _impulses(response, closing + back), u.copy()
        u[free] -= ease @ impulse
        if rotor.any():  # what rotors give to the links is not lost
            self.losses.append((t, -float(rotor @ (before**2 - u**2)) / 2))
        held = rows.T @ impulse - terms.mass[:, free] @ (ease @ impulse)  # impulses of what is prescribed
        y[2 * d : 3 * d] += np.where(self.acting.free, 0.0, held * u)
        after = closing - response @ impulse
        after = np.where(impulse > 0, -back, np.where(np.abs(after) <= UNMOVED * size, 0.0, after))
        for n, (k, side) in enumerate(all_):
            stop = self.stops[k]
            if stop.drive >= 0:
                u[stop.drive] = after[n] * side
            stop.resting = side if after[n] == 0 else 0.0
            if n < len(hit) and closing[n] > UNMOVED * size[n]:
                lost = impulse[n] * (closing[n] + after[n]) / 2
                self._note_impact(stop, side, t, (float(closing[n]), float(-after[n]), float(lost)))
        self.locked &= u == 0
        if len(self.sense):
            rates = self.own(self.equation(t, y[:d], u).rates)
            clear = np.abs(rates) > STILL * np.abs(rates).max(initial=0.0)
            self.sense = np.where(clear, np.where(rates < 0, -1.0, 1.0), self.sense)
        self.toward = np.where(u != 0, np.where(u < 0, -1.0, 1.0), self.toward)
        if (
            left.any() and not self.equation.dry
        ):  # speeds v, e v, e^2 v, ...: each takes 2 v over the acceleration
            drift = [s * terms.freedoms[j][2] if (j := self.stops[k].joint) >= 0 else 0.0 for k, s in all_]
            pushed = rows @ self.at(t, y)[0] + drift
            t += float(np.max(2 * left / np.where(pushed > 0, pushed, np.inf)))
        self._note_rests(t, y)
        self.stuck[:], self.tied[:], self.bound[:] = False, False, False
        self.settle(np.flatnonzero((u == 0) & (self.rubs | (self.on_stop != 0))).tolist(), t, y)

    def _touches(self, stop: Stop, side: float, t: float, y: Array) -> bool:
        end = stop.end(side)
        near = np.isfinite(end) and abs(stop.near(self.motion_of(stop, t, y)[0], end) - end) <= TOUCHING * (
            1 + abs(end)
        )
        return bool(stop.resting == side or near)

    def _row(self, stop: Stop, terms: Terms) -> Array:
        """Its motion per unit of each drive (D,)."""
        return np.asarray(
            terms.freedoms[stop.joint][3:] if stop.joint >= 0 else np.arange(self.d) == stop.drive, float
        )

    def _drive_of(self, stop: Stop) -> int:
        """The drive that is at rest while the stop is in contact; -1 where others move."""
        free = np.flatnonzero(self.acting.free)
        alone = stop.joint >= 0 and len(free) == 1 and not self._others_move()
        return int(free[0]) if alone else stop.drive

    def _plain_stops(self) -> list[Stop]:
        """Those that are not the gap of a drive."""
        return self.stops

    def _note_rests(self, t: float, y: Array) -> None:
        """Records drives at rest on a stop, and stops of joints that push while others move."""
        d, none = self.d, np.zeros(self.d)
        before = self.pressed
        self.on_stop[:], self.pressed, self.resting = 0.0, [], {}
        for stop in self._plain_stops():
            k = self._drive_of(stop)
            if stop.resting and k >= 0:
                push = self._row(stop, self.equation(t, y[:d], none))[k]
                self.on_stop[k], self.resting[k], y[d + k] = stop.resting * np.sign(push), stop.name, 0.0
            elif stop.resting and self.equation.dry:
                raise StoppedError(
                    f"{stop.name} rests on its stop while other freedoms move, with friction: "
                    "the force of the stop cannot be computed"
                )
            elif stop.resting:
                self.pressed.append(stop)
        pulling = list(self.pressed)
        while self.pressed and pulling:
            pushing = zip(self.pressed, self._pushing(t, y), strict=True)
            pulling = [s for s, force in pushing if force * s.resting > 0]
            for stop in pulling:
                self.pressed.remove(stop)
                self._let_turn(stop)
        for stop in self.pressed:
            if stop not in before:
                self.note(t, "rest", f"{stop.name} {_stays(stop)}", of=stop.name)

    def _note_leaving(self) -> None:
        """Stops that a drive does not rest on any more."""
        for stop in self._plain_stops():
            k = self._drive_of(stop)
            if k >= 0 and not self.on_stop[k] and stop.resting:
                self._let_turn(stop)

    def leave(self, k: int, t: float) -> None:
        """Let a joint go that its stop would have to pull."""
        stop = self.stops[k]
        self.pressed.remove(stop)
        stop.looks = [(t, stop.end(stop.resting), 0.0)]  # from which full turns are counted on
        self._let_turn(stop)
        leaves = (
            ("lift-off", "lifts off")
            if stop.contact
            else ("start", "turns freely" if stop.way else "leaves its stop")
        )
        self.note(t, leaves[0], f"{stop.name} {leaves[1]}", of=stop.name)

    def solved(self, t: float, y: Array) -> tuple[Contacted, Array, Terms]:
        """Those of ``ContactState``, with the forces of joints' stops that are rested on while others go on."""
        if not self.pressed:
            return super().solved(t, y)
        q, u, acting = y[: self.d], y[self.d : 2 * self.d], self.acting
        self.evaluations += 1
        f, rotor = np.flatnonzero(acting.free & ~self.locked), acting.take_ways(self.toward)
        self.take_torques(y)
        tau = acting.effort(t, q, u) - acting.brake * self.toward
        a = acting.accelerations(t)
        e = self.loaded_terms(t, q, u)
        e = e._replace(mass=e.mass + np.diag(rotor))
        rows = e.freedoms[[s.joint for s in self.pressed]]
        n, none = rows[:, 3:], np.zeros((len(rows), len(rows)))
        matrix = np.block([[e.mass[np.ix_(f, f)], -n[:, f].T], [n[:, f], none]])
        if not (np.isfinite(matrix).all() and np.isfinite(e.effort).all()):
            raise StoppedError(OPEN)
        gap = np.append((tau - e.effort - e.mass @ a)[f], -rows[:, 2] - n @ a)
        solution = np.linalg.lstsq(matrix, gap)[0]
        a[f], self.pushing = solution[: len(f)], solution[len(f) :]
        effort, no = e.effort + e.mass @ a - n.T @ self.pushing - rotor * a, np.zeros(0)
        moved = acting.free & ~self.locked
        return Contacted(a, effort, *(no,) * 6), np.where(moved, tau - rotor * a, effort), e

    def _range(self, k: int, t: float, y: Array) -> tuple[float, float, float]:
        if not self.pressed:
            return super()._range(k, t, y)
        held = self.locked.copy()
        self.locked[k] = True
        low = high = float(self.at(t, y)[1][k])
        self.locked = held
        tau, half = self._held(k, t, y[: self.d], y[self.d : 2 * self.d])
        low, high = low - half, high + half
        return tau, -np.inf if self.on_stop[k] < 0 else low, np.inf if self.on_stop[k] > 0 else high

    def joint_forces(self, t: float, y: Array) -> Array:
        """Forces of stops of joints (J, 2), once ``at`` was evaluated; and where the force is not known yet, because
        one drive is at rest with them, the slopes with that drive."""
        out = np.zeros((len(self.stops), 2))
        for k, stop in enumerate(self.stops):
            if stop.joint >= 0 and stop.resting and stop not in self.pressed:
                terms = self.equation(t, y[: self.d], np.zeros(self.d))
                out[k, 1] = self._row(stop, terms)[self._drive_of(stop)]
        for stop, force in zip(self.pressed, self.pushing, strict=False):
            out[self.stops.index(stop), 0] = force
        for k, stop in enumerate(self.stops):
            if stop.joint in self.elastic_joints:
                out[k, 0] = self.elastic_force(
                    stop.joint, self.equation(t, y[: self.d], y[self.d : 2 * self.d])
                )
        return out[[k for k, stop in enumerate(self.stops) if stop.joint >= 0]]

    def _note_impact(self, stop: Stop, side: float, t: float, of: Sequence[float]) -> None:
        before, after, lost = of
        self.losses.append((t, lost))
        kind, rate = kind_of(stop.freedom, ""), kind_of(stop.freedom, "speed")
        back: Words = ("rebounds at ", (rate, after)) if after else ("does not rebound",)
        place: Words = (f"{stop.name} strikes its stop at ", (kind, stop.end(side)))
        if stop.contact:
            place = (f"{stop.contact.joint} lands{stop.contact.where}",)
        stated: Words = (*place, " with ", (rate, before), " and ")
        rough = self.equation.dry and self.acting.free.sum() > 1
        left: Words = (" (friction during the impact is left out)",) if rough else ()
        words: Words = (*stated, *back, "; ", ("energy", lost), " are lost", *left)
        name, who = ("landing", stop.contact.name) if stop.contact else ("impact", stop.name)
        self.events.append(Event(t, name, words, who, before, lost))


def _stays(stop: Stop) -> str:
    return "stays in contact" if stop.contact else "holds" if stop.way else "stays on its stop"


def _impulses(response: Array, gap: Array) -> Array:
    """I >= 0 with own I >= gap, and I = 0 where own I > gap: own is symmetric and positive semidefinite."""
    if len(gap) == 1:
        return np.asarray(np.maximum(gap / response[0], 0.0))
    size, modes = np.linalg.eigh(response)
    some = size > UNMOVED * size.max()
    root = np.sqrt(size[some])
    return np.asarray(nnls(root[:, None] * modes[:, some].T, modes[:, some].T @ gap / root)[0])
