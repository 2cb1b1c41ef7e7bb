"""Steps of Dormand and Prince's method of order 8: in machine code where all is smooth, else scipy's solver.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import DOP853

from dalembert.arrays import Array
from dalembert.kernel.emit.integrator import EXTRA, STAGES, WIDTH, integrator, record_size, state_size
from dalembert.kernel.memory import address
from dalembert.kernel.program import Program

LEAST = 1e-4
"""Part of the natural size of a state's number below which its errors do not count relative to itself."""
AT_ONCE, WATCHED, UNWATCHED = 16, 48, 256
"""Attempts of steps of one motion at once: an event among them makes the others useless; where all that may happen is
watched in machine code; and where nothing may."""


PARTS = ("state", "rates", "least", "time", "step", "end", "tolerance", "growth", "attempts")
"""Parts of a motion, as in ``kernel.emit.integrator``: the first three of n numbers."""


def _table() -> Array:
    """The weights, as ``kernel.emit.integrator`` has them."""
    rows = [*DOP853.A, DOP853.B, *DOP853.A_EXTRA, DOP853.E5, DOP853.E3, *DOP853.D]
    table = np.array([np.pad(row, (0, WIDTH - len(row))) for row in rows])
    table[: STAGES + EXTRA + 1, -1] = [*DOP853.C, 1.0, *DOP853.C_EXTRA]
    return table


TABLE = _table()


class Integrator:
    """Machine code for steps of motions side by side, whose rate is a program of channels (state (n,), time) and of
    numbers; its places are the index of each. Outputs of it behind the n rates are ``watched``."""

    def __init__(self, rate: Program, n: int, numbers: int, lanes: int = 1) -> None:
        from dalembert.kernel.emit.machine_code import compile_module

        self.n, self.numbers, self.lanes, self.watched = n, numbers, lanes, len(rate.outputs) - n
        self.machine = compile_module(integrator(rate, n, lanes), lanes)

    def advance(self, values: Array, motions: Array, most: int, between: bool = False) -> Array:
        """Advances motions (block, ``state_size``, lane) by at most ``most`` attempts of steps; their records (block,
        most, ``record_size``, lane), with numbers in the attempted ones only. No attempts: only the rates."""
        blocks = len(motions)
        records = np.empty((blocks, max(most, 1), record_size(self.n, self.watched), self.lanes))
        where = (address(values), address(motions), address(records), address(TABLE))
        self.machine.function(*where, self.numbers, most, int(between), blocks)
        return records

    def blocks(self, array: Array) -> Array:
        """Rows (M, ...), of motions, as lanes of blocks; the last ones are the last again."""
        from dalembert.kernel.emit.machine_code import to_blocks

        return to_blocks(array, self.lanes)

    def motions(self, y: Array, t: Array | float, end: float, tolerance: float, size: Array | float) -> Array:
        """Motions at states (M, n) of natural ``size`` (M, n) and times, before their first step."""
        n, out = self.n, np.zeros((len(y), state_size(self.n, self.watched)))
        out[:, :n], out[:, 2 * n : 3 * n], out[:, 3 * n] = y, LEAST * tolerance * size, t
        out[:, 3 * n + 2 : 3 * n + 5] = end, tolerance, 10.0
        return self.blocks(out)

    def part(self, motions: Array, count: int, name: str) -> Array:
        """One of ``PARTS`` of the first motions (M, ...)."""
        return np.asarray(motions.transpose(0, 2, 1).reshape(-1, motions.shape[1])[:count, self._place(name)])

    def put(self, motions: Array, name: str, values: Array) -> None:
        """Set one of ``PARTS`` (M,) of motions."""
        motions[:, self._place(name)] = self.blocks(values[:, None])

    def _place(self, name: str) -> slice:
        n, k = self.n, PARTS.index(name)
        return slice(k * n, (k + 1) * n) if k < 3 else slice(3 * n + k - 3, 3 * n + k - 2)

    def rates(self, values: Array, t: Array | float, y: Array) -> Array:
        """Rates (M, n) at states (M, n) of motions with the same values, one lane wide."""
        return self.rates_watched(values, t, y)[0]

    def rates_watched(self, values: Array, t: Array | float, y: Array) -> tuple[Array, Array]:
        """Those rates, and what is watched (M, W)."""
        motions = np.zeros((len(y), state_size(self.n, self.watched), 1))
        motions[:, : self.n, 0], motions[:, 3 * self.n, 0] = y, t
        self.advance(values if len(y) == 1 else np.tile(values, (len(y), 1)), motions, 0)
        return motions[:, self.n : 2 * self.n, 0], motions[:, state_size(self.n) :, 0]


def state_sizes(u: Array, a: Array, length: Array, mass: Array | None = None) -> tuple[Array, Array]:
    """Natural sizes of positions and speeds (M, 2D), with a ``mass`` (M, D) also of D + 4 works behind them; and the
    natural pace w (M,), 1/s.

    A length X (D,), 1 of a turn, is passed at w = max(u/X, sqrt(a/X)), 1/s where all rests: speeds are of the size X w,
    works of m (X w)^2. So a machine of other masses, lengths or speeds takes the same steps.
    """
    w = np.maximum(np.abs(u) / length, np.sqrt(np.abs(a) / length)).max(axis=1, keepdims=True)
    w = np.where((w > 0) & np.isfinite(w), w, 1.0)
    speed = length * w
    parts = [np.broadcast_to(length, u.shape), speed]
    if mass is not None:
        work = (np.abs(mass) * speed**2).max(axis=1, keepdims=True)
        parts.append(np.repeat(np.where((work > 0) & np.isfinite(work), work, 1.0), u.shape[1] + 4, axis=1))
    return np.concatenate(parts, axis=1), w[:, 0]


def first_step(
    y: Array, f: Array, ahead: Any, room: Array | float, tolerance: float, natural: tuple[Array, Array]
) -> Array:
    """Length (M,) of the first steps of motions with states and rates (M, n), ``natural`` sizes of the states and
    paces; ``ahead(h)``: rates behind steps h (M,) along those. Hairer, Norsett, Wanner, II.4, times in 1/pace."""
    size, pace = natural
    scale = tolerance * (LEAST * size + np.abs(y))

    def norm(x: Array) -> Array:
        return np.asarray(np.sqrt(((x / scale) ** 2).sum(axis=1) / x.shape[1]))

    with np.errstate(all="ignore"):
        room = room * pace
        d0, d1 = norm(y), norm(f) / pace
        h = np.minimum(np.where((d0 < 1e-5) | (d1 < 1e-5), 1e-6, 0.01 * d0 / d1), room)
        d2 = norm(ahead(h / pace) - f) / pace / h
        still = (d1 <= 1e-15) & (d2 <= 1e-15)
        longer = np.where(still, np.maximum(1e-6, h * 1e-3), (0.01 / np.maximum(d1, d2)) ** (1 / 8))
        return np.asarray(np.minimum(np.minimum(100 * h, longer), room) / pace)


def between(records: Array, t: Array) -> Array:
    """States (K, n) within steps, by polynomials of order 7 of their records, at times (K,)."""
    rows = records[:, 2:].reshape(len(records), 8, records.shape[1] // 8)
    y, new, f, ahead, *more = np.moveaxis(rows, 1, 0)
    h, change = records[:, 1:2], new - y
    x, out = (t[:, None] - records[:, :1]) / h, 0.0
    parts = (change, h * f - change, 2 * change - h * (ahead + f), *more)
    for k, part in enumerate(reversed(parts)):
        out = (out + part) * (x if k % 2 == 0 else 1 - x)
    return np.asarray(out + y)


@dataclass
class Between:
    """States within a step of a record."""

    record: Array

    @classmethod
    def standing(cls, t: float, y: Array) -> Between:
        """A step that stays at a state (n,)."""
        record, n = np.zeros(record_size(len(y))), len(y)
        record[:2], record[2 : 2 + n], record[2 + n : 2 + 2 * n] = (t, 1.0), y, y
        return cls(record)

    def __call__(self, t: float) -> Array:
        return np.asarray(between(self.record[None], np.array([t]))[0])


class MachineSteps:
    """Steps of one motion, taken some at a time in machine code and handed on one by one, as scipy's solvers do."""

    def __init__(
        self,
        code: Integrator,
        values: Array,
        t: float,
        y: Array,
        end: float,
        rtol: float,
        natural: tuple[Array, Array],
        between: bool,
    ) -> None:
        self.code, self.values, self.end, self.between, self.n = code, values, end, between, code.n
        self.t, self.y, self.status, self.h_previous = t, y, "running", 0.0
        n = self.n
        self.motion = code.motions(y[None], t, end, rtol, natural[0])
        f = code.rates(values, t, y[None])

        def ahead(h: Array) -> Array:
            return code.rates(values, t + h, y + h[:, None] * f)

        self.h_abs = float(first_step(y[None], f, ahead, end - t, rtol, natural)[0])
        self.motion[0, 3 * n + 1] = self.h_abs
        self.records, self.watched, self.next = np.zeros((0, record_size(n))), np.zeros((0, code.watched)), 0

    def step(self) -> str | None:
        """Take the next step; a message where there is none."""
        while True:
            if self.next == len(self.records) and not self._more():
                self.status = "failed"
                return DOP853.TOO_SMALL_STEP
            record, n = self.records[self.next], self.n
            self.next += 1
            if record[1] > 0:
                break
        self.record, self.h_previous = record, float(record[1])
        self.y = record[2 + n : 2 + 2 * n]
        self.h_abs = self.h_previous
        inner = self.next < len(self.records)
        self.t = float(self.records[self.next][0] if inner else self.motion[0, 3 * n, 0])
        if self.t >= self.end:
            self.status = "finished"
        return None

    def ahead(self, most: int = UNWATCHED) -> tuple[Array, Array]:
        """Records of the steps that come next, at most this many where none are known yet, and what is watched behind
        each."""
        if self.next == len(self.records):
            self._more(most)
        place = self._coming
        return self.records[place], self.watched[place]

    @property
    def _coming(self) -> Array:
        """Indices of the known steps that are not taken yet."""
        return self.next + np.flatnonzero(self.records[self.next :, 1] > 0)

    def take(self, count: int) -> None:
        """Take this many of the known steps."""
        coming = self._coming
        self.next = int(coming[count - 1])
        self.step()
        if count == len(coming):
            self.next = len(self.records)

    def _more(self, most: int = AT_ONCE) -> bool:
        """Further attempts in machine code; whether there are any."""
        record = self.motion[0, :, 0]
        if not record[3 * self.n + 1] > 0:
            return False
        made = self.code.advance(self.values, self.motion, most, self.between)[0, :, :, 0]
        size = record_size(self.n)
        made = made[: int(record[3 * self.n + 5])]
        self.records, self.watched, self.next = made[:, :size], made[:, size:], 0
        return True

    @property
    def ahead_rate(self) -> Array:
        """Rates at the end of the last step."""
        return np.asarray(self.record[2 + 3 * self.n : 2 + 4 * self.n])

    def dense_output(self) -> Between:
        """States within the last step."""
        if not self.between:
            motion = self.motion.copy()
            record, n = motion[0, :, 0], self.n
            record[:n], record[3 * n], record[3 * n + 1] = (
                self.record[2 : 2 + n],
                self.record[0],
                self.h_previous,
            )
            record[3 * n + 2], record[2 * n : 3 * n], record[3 * n + 3] = np.inf, 1e300, 1e300
            self.record = self.code.advance(self.values, motion, 1, True)[0, 0, : record_size(n), 0]
        return Between(self.record)


class Steps(DOP853):
    """scipy's solver, which also starts where the rate gives no step size."""

    def __init__(
        self,
        rate: Callable[[float, Array], Array],
        t: float,
        y: Array,
        end: float,
        rtol: float,
        natural: tuple[Array, Array],
        longest: float = np.inf,
    ) -> None:
        least = rtol * LEAST * natural[0][0]
        first = min(1.0, end - t, longest)
        super().__init__(rate, t, y, end, rtol=rtol, atol=least, first_step=first, max_step=longest)

        def ahead(h: Array) -> Array:
            return rate(t + float(h[0]), y + h[0] * self.f)[None]

        self.h_abs = float(first_step(y[None], self.f[None], ahead, end - t, rtol, natural)[0])

    @property
    def ahead_rate(self) -> Array:
        """Rates at the end of the last step."""
        return np.asarray(self.f)

    def _step_impl(self) -> Any:
        self.h_abs = max(10 * float(np.spacing(self.t)), self.h_abs)
        with np.errstate(all="ignore"):
            return super()._step_impl()  # type: ignore[misc]
