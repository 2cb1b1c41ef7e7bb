"""Data of motions of many designs that go on side by side, each from event to event.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.machine.motion.many.course.guards import Guards
from dalembert.machine.motion.many.event_program import EventCode
from dalembert.machine.motion.occurrences import ROUNDING


@dataclass(frozen=True)
class EventMachine:
    """Data common to all designs: the ``free`` drive, which may stay at ``rest`` (by friction, or its brake), how
    the values of the steps are ``placed``, the guards, and whether loads go ``by_time``."""

    code: EventCode
    free: int
    moves: Flags  # drives that forces move
    alone: bool  # one does, and the others are at rest
    drives: int
    rests: bool
    first: int  # of the values behind those of the equation
    sides: Ints  # places of values for sides of loads
    stop_drives: list[int]  # of each stop that is struck, its drive or -1
    guards: Guards
    stops: Flags  # guards that end a motion
    by_time: bool
    end: float
    tolerance: float
    lengths: Array
    largest: Array  # efforts of late motors


class CourseState:
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
        d, n = machine.drives, machine.code.steps.n
        self.y = np.concatenate([self.y, np.zeros((m, n - 2 * d))], axis=1)  # efforts of late motors
        self.fastest = np.abs(begin[:, d:])
        self.size, self.on_stop = np.ones((m, n)), np.zeros(m)
        self.closing = np.zeros((m, machine.code.stops))
        self.began, self.longest, self.flickers = np.zeros(m), np.zeros(m), np.zeros(m, int)
        self.events, self.attempts = np.zeros(m, int), np.zeros(m, int)
        self.looked = np.zeros(m)  # longest step within which the switches were evaluated
        self.now, self.past = np.zeros((m, count)), np.zeros((m, count))  # guards, also of an instant before
        self.past_time = np.full(m, np.nan)
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

    def lose(self, k: Ints) -> None:
        """Leave designs to motions alone."""
        self.lost[k], self.live[k] = True, False

    def _keep_version(self, k: Ints) -> None:
        """Keep the values of now, which the next steps have."""
        self.version[k] = len(self.versions) + np.arange(len(k))
        self.versions += list(self.values[k])

    def _note(self, k: Ints) -> None:
        """Keep an instant behind an event."""
        if len(k):
            self.instants.append((k, self.t[k].copy(), self.version[k].copy(), self.y[k].copy()))
