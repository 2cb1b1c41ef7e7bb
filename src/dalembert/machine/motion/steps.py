"""Steps of Dormand and Prince's method of order 8: scipy's solver, its stages in machine code where all is smooth.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.integrate import DOP853
from scipy.integrate._ivp.rk import rk_step

from dalembert.arrays import Array
from dalembert.kernel.program import Program

STAGES, ERRORS = 12, np.array([DOP853.E5, DOP853.E3])
WEIGHTS = np.column_stack([np.vstack([DOP853.A[1:], DOP853.B]), [*DOP853.C[1:], 1.0]])
"""Of the rates before each stage, and its part of the step."""


class Stages:
    """The stages of a step: a program of the channels (y (n,), t, h, parameters, rates (12, n)) and of the numbers in a
    row of ``WEIGHTS`` gives the rate at a stage."""

    def __init__(self, stage: Program, n: int, parameters: int) -> None:
        from dalembert.kernel.emit import llvm_text
        from dalembert.kernel.emit.machine_code import compile_module
        from dalembert.kernel.memory import address

        self.machine, self.n = compile_module(llvm_text.pairs(stage, 1), 1), n
        self.z, self.one, self.weights = np.zeros(n + 2 + parameters + 13 * n), np.zeros(n), WEIGHTS.copy()
        self.k, self.mark = self.z[n + 2 + parameters :].reshape(STAGES + 1, n), np.zeros(1)
        ends = [(w, out) for w, out in zip(self.weights, self.k[1:], strict=True)]
        self.calls, self.first = (
            [(address(w), address(self.z), address(out), address(self.mark), 0, 0, 0, 1) for w, out in pairs]
            for pairs in (ends, [(self.weights[0], self.one)])
        )

    def given(self, parameters: Array) -> None:
        """Take the parameters."""
        self.z[self.n + 2 : self.n + 2 + len(parameters)] = parameters

    def rate(self, t: float, y: Array) -> Array:
        """The rate (n,) at one state."""
        self._run(t, y, 0.0, self.first)
        return np.asarray(self.one.copy())

    def __call__(self, t: float, y: Array, h: float, k: Array) -> Array:
        """Fill the rates k (13, n) of a step whose first row is there; the state behind it (n,)."""
        self.k[0], self.k[1:] = k[0], 0.0
        self._run(t, y, h, self.calls)
        k[:] = self.k
        return np.asarray(y + h * (DOP853.B @ k[:STAGES]))

    def _run(self, t: float, y: Array, h: float, calls: Sequence[tuple[int, ...]]) -> None:
        n, function = self.n, self.machine.function
        self.z[:n], self.z[n], self.z[n + 1] = y, t, h
        for call in calls:
            function(*call)


class Steps(DOP853):
    """scipy's solver; ``stages`` compute a step at once, and a rate that is no number refuses it."""

    stages: Stages | None = None
    rtol: float
    atol: float

    def _step_impl(self) -> tuple[bool, str | None]:
        t, y, most = self.t, self.y, 10.0
        k: Any = self.K
        least = 10 * float(np.spacing(t))
        h = max(least, self.h_abs)  # least if there was no rate to guess one from
        while h >= least:
            h = min(t + h, self.t_bound) - t
            k[0] = self.f
            if self.stages:
                new = self.stages(t, y, h, k)
            else:
                new, _ = rk_step(self.fun, t, y, k[0], h, self.A, self.B, self.C, k)
            off = ERRORS @ k / (self.atol + self.rtol * np.maximum(np.abs(y), np.abs(new)))
            fifth, third = (off * off).sum(axis=1).tolist()
            error = h * fifth / math.sqrt((fifth + 0.01 * third) * len(y)) if fifth or third else 0.0
            factor = 0.9 * error**self.error_exponent if error > 0 else most
            if error < 1:
                self.h_previous, self.y_old, self.h_abs = h, y, h * min(most, factor)
                self.t, self.y, self.f = t + h, new, k[-1].copy()
                return True, None
            h, most = h * (max(0.2, factor) if error >= 1 else 0.2), 1.0
        return False, self.TOO_SMALL_STEP
