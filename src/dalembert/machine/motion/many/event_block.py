"""Outputs of motions with events of many designs, at even instants and events, each reduced over them.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from dalembert.arrays import Array, Flags
from dalembert.kernel.graph import Node
from dalembert.machine.motion.coded.steps import between
from dalembert.machine.motion.equation import Equation
from dalembert.machine.motion.many.course.course_events import Course
from dalembert.machine.motion.many.course.course_state import EventMachine
from dalembert.machine.motion.many.event_program import look
from dalembert.machine.motion.many.over_instants import over_instants
from dalembert.machine.motion.occurrences import EventCondition

AT_ONCE = 16_384
"""Instants computed at once."""


@dataclass(frozen=True)
class Ended:
    """Of designs (M,): time at the end, the guard that ended the motion (-1: the time), since when it rests (else NaN),
    state, outputs by name, each reduced, and which are sure."""

    time: Array
    met: Array
    rest: Array
    state: Array
    outputs: dict[str, Array]
    sure: Flags


@dataclass(frozen=True)
class EventBlock:
    """Motions until the end or a condition, with outputs of ``equation`` at ``instants`` even instants and events.

    ``levels`` (G,): values of guards, numbers or nodes.
    """

    equation: Equation
    machine: EventMachine = field(repr=False)
    conditions: tuple[EventCondition, ...]
    levels: tuple[float | Node, ...]
    instants: int
    reduce: str | None

    @property
    def output_count(self) -> int:
        """Number of values of all outputs."""
        return self.machine.code.outputs

    @property
    def text(self) -> str:
        """All that decides the bits of an answer."""
        code, machine = self.machine.code, self.machine
        programs = f"{code.steps.machine.text}{code.outputs_code.machine.text}"
        return f"{programs}{self.conditions}{machine.end}{machine.tolerance}"

    def __call__(self, begin: Array, values: Array, levels: Array, on: Array) -> Ended:
        """Motions from states (M, n) with values (M, V) of the steps, levels (M, G) of the guards and motors (M, D)
        that are on."""
        course = Course(self.machine, begin, values, levels, on).run()
        m, end = len(begin), self.machine.end
        time = np.where(np.isfinite(course.rest), end, course.t)
        outputs, sure = (
            self._outputs(course, time) if self.equation.kernel.outputs else ({}, np.ones(m, bool))
        )
        return Ended(time, course.met, course.rest, course.y, outputs, sure & ~course.lost)

    def _outputs(self, course: Course, time: Array) -> tuple[dict[str, Array], Flags]:
        """The outputs by name, (M, ...), and which designs are sure."""
        m = len(time)
        even = time[:, None] * (np.linspace(0.0, 1.0, self.instants) if self.instants > 1 else np.ones(1))
        design = np.repeat(np.arange(m), even.shape[1])
        t, version, y = self._states(course, design, even.ravel())
        if self.reduce != "final" and course.instants:
            of, when, by, state = (np.concatenate(x) for x in zip(*course.instants, strict=True))
            design, t = np.concatenate([design, of]), np.concatenate([t, when])
            version, y = np.concatenate([version, by]), np.concatenate([y, state])
            order = np.lexsort((t, design))
            design, t, version, y = design[order], t[order], version[order], y[order]
        rows = np.array(course.versions or list(course.values))
        parts = [
            self._at(rows[version[k : k + AT_ONCE]], t[k : k + AT_ONCE], y[k : k + AT_ONCE])
            for k in range(0, len(t), AT_ONCE)
        ]
        values, fine = (np.concatenate(x) for x in zip(*parts, strict=True))
        sure = np.bincount(design[~fine], minlength=m) == 0
        bounds = np.searchsorted(design, np.arange(m + 1))
        out: dict[str, list[Array]] = {name: [] for name in self.equation.kernel.nodes}
        for low, high in pairwise(bounds):
            place = 0
            for name, nodes in self.equation.kernel.nodes.items():
                part = values[low:high, place : place + len(nodes)]
                place += len(nodes)
                along = part if len(nodes) > 1 else part[:, 0]
                out[name].append(over_instants(self.reduce, along, t[low:high], self.instants))
        return {name: np.array(x) for name, x in out.items()}, sure

    def _states(self, course: Course, design: Array, t: Array) -> tuple[Array, Array, Array]:
        """Times, rows of the values and states of designs at times."""
        y, version = course.y[design].copy(), course.version[design].copy()
        if not course.rows:
            return t, version, y
        records, of, by = (np.concatenate(x) for x in (course.rows, course.of, course.by))
        order = np.argsort(of, kind="stable")
        records, of, by = records[order], of[order], by[order]
        span = 2 * self.machine.end
        place = np.searchsorted(of + records[:, 0] / span, design + t / span) - 1
        low, high = np.searchsorted(of, design), np.searchsorted(of, design + 1) - 1
        moved = high >= low
        place = np.clip(place, low, np.maximum(high, 0))
        inside = np.flatnonzero(moved & ~(t > records[place, 0] + records[place, 1] * (1 + 1e-9)))
        y[inside], version[inside] = between(records[place[inside]], t[inside]), by[place[inside]]
        return t, version, y

    def _at(self, rows: Array, t: Array, y: Array) -> tuple[Array, Flags]:
        """Outputs (K, N) at states, those open at rest without numbers, and where the others are sure."""
        code = self.machine.code
        watched, count = look(code.outputs_code, rows, t, y)[1], code.outputs
        still = rows[:, -1] > 0
        values = np.where(still[:, None] & code.open_, np.nan, watched[:, :count])
        known = np.isfinite(values) | (still[:, None] & code.open_)
        return values, np.asarray(known.all(axis=1) & (watched[:, count:] >= 0).all(axis=1))
