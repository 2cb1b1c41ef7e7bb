"""Compiled motions with events: all designs side by side, and what they leave open alone.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, fields
from functools import cached_property
from threading import Lock

import numpy as np
from numpy.typing import ArrayLike

from dalembert.arrays import Array
from dalembert.errors import DalembertError
from dalembert.kernel.graph import Node
from dalembert.machine.motion.actuation import Actuation
from dalembert.machine.motion.coded.shared_motion import SharedMotion
from dalembert.machine.motion.many.event_block import Ended, EventBlock
from dalembert.machine.motion.many.motion_kernel import MotionBatch, MotionKernel
from dalembert.machine.motion.many.one_design import Alone, alone
from dalembert.machine.motion.occurrences import say

DESIGNS = 512
"""Designs side by side: each event of one takes a call for all that have one."""
ONE_AT_A_TIME = Lock()


@dataclass(frozen=True)
class EventKernel(MotionKernel):
    """Compiled motions whose designs have separate events."""

    block: EventBlock = field(repr=False)  # type: ignore[assignment]
    until: tuple[str | float, ...]
    count: int
    moves: Actuation = field(repr=False)

    def __call__(self, values: ArrayLike | None = None, threads: int | None = None) -> MotionBatch:
        designs = self._values(values)
        self._refuse_too_large(len(designs))
        with ThreadPoolExecutor(threads) as pool:
            parts = list(
                pool.map(self._ended, (designs[k : k + DESIGNS] for k in range(0, len(designs), DESIGNS)))
            )
        names = self.equation.kernel.outputs
        arrays = {name: np.concatenate([p.outputs[name] for p in parts]) for name in names}
        joined = (
            np.concatenate([getattr(p, f.name) for p in parts]) for f in fields(Ended) if f.name != "outputs"
        )
        time, met, rest, state, sure = joined
        texts = [*(c.text for c in self.block.conditions), "time"]
        first = len(self.block.levels) - len(self.block.conditions)
        ended = [texts[g - first] if g >= 0 else "time" for g in met]
        for k in np.flatnonzero(np.isfinite(rest)):
            ended[k] = say(("at rest from ", ("time", float(rest[k])), " on"))
        d, again = self.lines.shape[1], np.flatnonzero(~sure)
        for x in (time, state, *arrays.values()):
            x[again] = np.nan
        for k in again:
            solved = self._alone(designs[k])
            ended[k] = solved.ended
            if solved.known:
                time[k], state[k, : 2 * d] = solved.time, np.concatenate([solved.position, solved.speed])
                for name, x in solved.outputs.items():
                    arrays[name][k] = x
        return MotionBatch(designs, time, state[:, :d], state[:, d : 2 * d], tuple(ended), arrays, len(again))

    def _ended(self, values: Array) -> Ended:
        """The ends of some designs."""
        ordered = values[:, np.argsort(self.places)] if self.places else values
        with np.errstate(all="ignore"):
            begin, inputs = self._begin(ordered)
            contacts = self.block.machine.code.contacts
            more = [np.ones((len(values), contacts)), np.zeros((len(values), contacts + 1))]
            levels = np.tile(self._levels, (len(values), 1))
            for g, column in self._level_nodes(ordered):
                levels[:, g] = column
            solved = self.block(begin, np.concatenate([inputs, *more], axis=1), levels, self._on(begin))
        solved.sure[self._other_branch(ordered)] = False
        return solved

    @cached_property
    def _levels(self) -> Array:
        return np.array([0.0 if isinstance(x, Node) else float(x) for x in self.block.levels])

    def _level_nodes(self, values: Array) -> list[tuple[int, Array]]:
        """Levels that follow from parameters, by guard."""
        nodes = {g: x for g, x in enumerate(self.block.levels) if isinstance(x, Node)}
        kernel = self.equation.kernel
        along = {n.index: column for n, column in zip(kernel.number_nodes, values.T, strict=False)}
        solved = kernel.trace.catalogue.graph.evaluate(list(nodes.values()), along)
        return list(zip(nodes, map(np.asarray, solved), strict=True))

    def _on(self, begin: Array) -> Array:
        """Motors (M, D) that are on at the start."""
        d = len(self.moves.names)
        on = np.ones((len(begin), d))
        for k, motor in self.moves.motors.items():
            if motor.on is not None:
                by, value = motor.on
                at = {"time": np.zeros(len(begin)), "position": begin[:, k], "speed": begin[:, d + k]}[by]
                on[:, k] = at == value
        return on

    @cached_property
    def _shared(self) -> SharedMotion:
        return SharedMotion(self.mechanism, self.numbers)

    def _alone(self, design: Array) -> Alone:
        """One design by `da.simulate`."""
        outputs, (end, tolerance) = self.outputs, (self.until, self.block.machine.tolerance)
        with ONE_AT_A_TIME:
            try:
                m = self.mechanism.with_values(dict(zip(self.numbers, design.tolist(), strict=True)))
                return alone(m, end, outputs, self.reduce, self.count, tolerance, self._shared)
            except DalembertError as error:
                return Alone.failed(f"failed: {error}")
