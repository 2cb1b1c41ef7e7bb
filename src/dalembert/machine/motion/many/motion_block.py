"""Motions of many designs at once, each with separate step sizes, until its end; and their outputs.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.kernel.memory import address
from dalembert.machine.motion.coded.steps import Integrator, between, first_step, state_sizes
from dalembert.machine.motion.equation import Equation
from dalembert.machine.motion.occurrences import EventCondition

ATTEMPTS, MOST, SMALL, ROOTS = 24, 100_000, 0.01, 60
"""Attempts of steps at once, and those after which a motion is given up; part of the mean step below which the state is
checked for doubt; halvings that locate a condition's time."""


class Motions(NamedTuple):
    """For designs side by side: end (M,), the condition that ended it (-1: the time), state at the end, outputs (M,
    instants, N), and whether all is certain."""

    time: Array
    met: Array
    state: Array
    out: Array
    sure: Flags


@dataclass(frozen=True)
class MotionBlock:
    """Steps in machine code, and the outputs of an equation at ``instants`` even instants until the end."""

    equation: Equation
    code: Integrator
    conditions: tuple[EventCondition, ...]
    end: float
    tolerance: float
    instants: int
    lengths: Array

    @cached_property
    def output_count(self) -> int:
        """Number of values of all outputs."""
        return sum(map(len, self.equation.kernel.nodes.values()))

    @property
    def text(self) -> str:
        """All that decides the bits of an answer."""
        return f"{self.code.machine.text}{self.machine.text}{self.conditions}{self.end}{self.tolerance}"

    @cached_property
    def machine(self) -> Any:
        """The outputs, then what is below zero where a state is in doubt."""
        from dalembert.kernel.emit.llvm_text import pairs
        from dalembert.kernel.emit.machine_code import compile_module

        return compile_module(pairs(self.equation.asked, self.code.lanes), self.code.lanes)

    def __call__(self, begin: Array, values: Array) -> Motions:
        """Motions from states (M, n) with values (M, ...) of the steps."""
        records, design, failed = self._integrate(begin, values)
        if not len(records):  # no design takes a step
            records, design = np.full((1, records.shape[1]), np.nan), np.zeros(1, np.intp)
        time, met = self._ends(records, design, len(begin))
        t = time[:, None] * (np.linspace(0.0, 1.0, self.instants) if self.instants > 1 else np.ones(1))
        each = np.arange(len(t))[
            :, None
        ]  # all steps in one row: those of a design, by time, behind those before it
        place = np.searchsorted(design + records[:, 0] / (2 * self.end), each + t / (2 * self.end)) - 1
        low, high = np.searchsorted(design, each), np.searchsorted(design, each + 1) - 1
        states = between(records[np.clip(place, low, high).ravel()], t.ravel())
        sure = ~failed & np.isfinite(states).reshape(len(t), -1).all(axis=1)
        out, fine = self._at(np.repeat(values, self.instants, axis=0), states, t.ravel())
        shape = (len(t), self.instants)
        sure &= fine.reshape(shape).all(axis=1)
        return Motions(time, met, states.reshape(*shape, -1)[:, -1], out.reshape(*shape, -1), sure)

    def _integrate(self, y: Array, designs: Array) -> tuple[Array, Ints, Flags]:
        """All steps (R, ``record_size``), those of a design one after the other, the design of each, and which
        failed."""
        code, m = self.code, len(y)
        values, motions = code.blocks(designs), code.motions(y, 0.0, self.end, self.tolerance, 1.0)
        code.advance(values, motions, 0)
        f = code.part(motions, m, "rates")
        natural = state_sizes(f[:, : f.shape[1] // 2], f[:, f.shape[1] // 2 :], self.lengths)
        motions = code.motions(y, 0.0, self.end, self.tolerance, natural[0])
        code.advance(values, motions, 0)

        def ahead(h: Array) -> Array:
            trial = code.motions(y + h[:, None] * f, h, self.end, self.tolerance, natural[0])
            code.advance(values, trial, 0)
            return code.part(trial, m, "rates")

        code.put(motions, "step", first_step(y, f, ahead, self.end, self.tolerance, natural))
        rows, of, attempts, stop, lost = [], [], 0, np.full(m, self.end), np.zeros(m, bool)
        while attempts < MOST:
            records = code.advance(values, motions, ATTEMPTS, True).transpose(0, 3, 1, 2)
            records = records.reshape(-1, *records.shape[2:])[:m]
            taken = (np.arange(ATTEMPTS) < code.part(motions, m, "attempts")) & (records[..., 1] > 0)
            rows.append(records[taken])
            of.append(np.nonzero(taken)[0])
            time, step = code.part(motions, m, "time")[:, 0], code.part(motions, m, "step")[:, 0]
            attempts += ATTEMPTS
            for c in self.conditions:
                stop[of[-1][self._meets(c, rows[-1])]] = -1.0  # it goes no further
            small = np.flatnonzero((step * attempts < SMALL * time) & (time < stop))
            if len(small):
                fine = self._at(designs[small], code.part(motions, m, "state")[small], time[small])[1]
                lost[small[~fine]], stop[small[~fine]] = True, -1.0
            code.put(motions, "end", np.minimum(stop, self.end))
            if not ((time < stop) & (step > 0)).any():
                break
        design = np.concatenate(of)
        order = np.argsort(design, kind="stable")
        return np.concatenate(rows)[order], design[order], lost | (time < stop)

    def _meets(self, c: EventCondition, records: Array) -> Flags:
        """In which steps a condition is met."""
        n, place = self.code.n, c.drive + len(self.equation.names) * (c.what == "speed")
        old, new = records[:, 2 + place] - c.value, records[:, 2 + n + place] - c.value
        return np.asarray((old != 0) & (old * new <= 0))

    def _ends(self, records: Array, design: Ints, count: int) -> tuple[Array, Ints]:
        """When each design's motion ends, and by which condition: -1 by the time."""
        time, met = np.full(count, self.end), np.full(count, -1)
        for k, c in enumerate(self.conditions):
            steps = np.flatnonzero(self._meets(c, records))
            steps = steps[np.unique(design[steps], return_index=True)[1]]  # of each design the first
            place, rows = c.drive + len(self.equation.names) * (c.what == "speed"), records[steps]
            low, high = rows[:, 0].copy(), rows[:, 0] + rows[:, 1]
            side = np.sign(rows[:, 2 + place] - c.value)
            for _ in range(ROOTS):
                middle = (low + high) / 2
                before = (between(rows, middle)[:, place] - c.value) * side > 0
                low, high = np.where(before, middle, low), np.where(before, high, middle)
            sooner = high < time[design[steps]]
            time[design[steps][sooner]], met[design[steps][sooner]] = high[sooner], k
        return time, met

    def _at(self, inputs: Array, y: Array, t: Array) -> tuple[Array, Flags]:
        """Outputs (K, N) at states, and where they are sure."""
        code, d = self.code, len(self.equation.names)
        motions = code.motions(y, t, self.end, self.tolerance, 1.0)
        code.advance(code.blocks(inputs), motions, 0)
        rates, e = code.part(motions, len(y), "rates"), self.equation
        inputs[:, e.rates[:d]], inputs[:, e.rates[d:]] = y[:, d : 2 * d], rates[:, d : 2 * d]
        path = code.blocks(np.column_stack([y[:, :d], t])[:, e.asked_channels])
        lanes, blocks = code.lanes, len(motions)
        out, flags = np.empty((blocks, len(e.asked.outputs), lanes)), np.zeros(blocks * lanes, np.uint8)
        values = code.blocks(inputs[:, : len(e.values)])
        arrays = (address(a) for a in (values, path, out, flags))
        self.machine.function(*arrays, values.shape[1], path.shape[1], 0, blocks)
        rows, count = out.transpose(0, 2, 1).reshape(blocks * lanes, -1)[: len(y)], self.output_count
        fine = np.isfinite(rows[:, :count]).all(axis=1) & (rows[:, count:] >= 0).all(axis=1)
        return rows[:, :count], np.asarray(fine)
