"""Quantities along the motions of many designs, with their derivatives by differences of neighbouring designs.

Mechanics: docs/theory.md 10.6, 11.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from types import SimpleNamespace
from typing import Any

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import DalembertError, ModelError
from dalembert.machine.motion.coded.shared_motion import SharedMotion
from dalembert.machine.motion.compiled_motion import compile_motion
from dalembert.machine.motion.many.motion_kernel import MotionKernel
from dalembert.machine.motion.many.one_design import alone
from dalembert.machine.motion.many.simulation_plan import SimulationPlan
from dalembert.model import Mechanism

STEP = 1e-4
"""Difference of neighbouring designs, as a fraction of the bounds: beside it the error of a motion is small."""


@dataclass(frozen=True)
class AlongMotions:
    """Values of ``outputs`` at even instants from the start to the end of each design's motion, in machine code where
    that reaches; called as a kernel is. NaN where a design has no motion."""

    mechanism: Mechanism
    vary: tuple[str, ...]
    low: Array
    high: Array
    outputs: tuple[str, ...]
    plan: SimulationPlan

    @cached_property
    def _kernel(self) -> MotionKernel | None:
        plan = self.plan
        try:
            ends = plan.until, self.vary, self._along
            return compile_motion(self.mechanism, *ends, None, None, plan.count, plan.tolerance)
        except ModelError:
            return None

    @property
    def _along(self) -> tuple[str, ...]:
        return tuple(name for name in self.outputs if name != "time")

    @cached_property
    def _shared(self) -> SharedMotion:
        return SharedMotion(self.mechanism, self.vary)

    def blocks(self, values: Array, **_: Any) -> Iterator[Any]:
        """One block of all designs (design, number)."""
        values = np.asarray(values, float)
        d, n = values.shape
        away = np.where(values > (self.low + self.high) / 2, -1.0, 1.0) * STEP * (self.high - self.low)
        near = values[:, None] + away[:, None] * np.eye(n)
        every = self._values(np.concatenate([values, near.reshape(-1, n)]))
        value, others = every[:d], every[d:].reshape(d, n, *every.shape[1:])
        step = np.where(away != 0, away, np.inf)[:, :, None, None]
        slope: Array = np.moveaxis((others - value[:, None]) / step, 1, -1)
        place = {name: k for k, name in enumerate(self.outputs)}
        yield SimpleNamespace(
            value=lambda name: value[:, place[name]], gradient=lambda name: slope[:, place[name]]
        )

    def _values(self, designs: Array) -> Array:
        """Values (design, output, instant)."""
        out = np.full((len(designs), len(self.outputs), self.plan.count), np.nan)
        if self._kernel is None:
            for k, design in enumerate(designs):
                self._alone(design, out[k])
            return out
        r, even = self._kernel(designs), np.linspace(0.0, 1.0, self.plan.count)
        for k, name in enumerate(self.outputs):
            out[:, k] = r.time[:, None] * even if name == "time" else r.value(name)
        out[~r.ok] = np.nan
        return out

    def _alone(self, design: Array, out: Array) -> None:
        """Values (output, instant) of one design by `da.simulate`."""
        plan = self.plan
        try:
            m = self.mechanism.with_values(dict(zip(self.vary, design.tolist(), strict=True)))
            r = alone(m, plan.until, self._along, None, plan.count, plan.tolerance, self._shared)
        except DalembertError:
            return
        if r.known:
            for k, name in enumerate(self.outputs):
                out[k] = np.linspace(0.0, r.time, plan.count) if name == "time" else r.outputs[name]
