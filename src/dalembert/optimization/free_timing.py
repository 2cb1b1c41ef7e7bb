"""Targets that a mechanism passes in order at unknown positions of its drive.

The positions join the other numbers in one least-squares problem. Each moves by less than half its distance to the
next, so that the order is kept; they start where a design is nearest to the targets (dynamic programming).

Mechanics: docs/theory.md 11.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from dalembert.analysis.batch.checked_input import drive_values
from dalembert.analysis.batch.compiled_kernel import Kernel
from dalembert.analysis.batch.own_positions import OwnPositions
from dalembert.arrays import Array, Flags, Ints
from dalembert.errors import ModelError
from dalembert.machine.whole_cycle import over_a_turn
from dalembert.optimization.least_squares import Errors, TargetErrors, wanted

TURN = 2 * np.pi
STATIONS = 72
"""Positions at which designs are tried, and must close; or six per target if that is more."""
NEARER = 0.45
"""Fraction of the distance to the next target's position that a position may move in one step."""
FIRST = 12
"""Number of the stations nearest to the first target that are tried for it where the drive turns fully."""
BLOCK = 1000
"""Number of designs timed at once."""


@dataclass(frozen=True)
class FreeTiming(TargetErrors):
    """A least-squares problem whose unknowns include the drive's positions, after the numbers, increasing along
    ``sense``."""

    samples: OwnPositions
    sense: float
    closed: bool
    """True if the drive turns fully, so that the first target follows the last one."""

    @classmethod
    def of(
        cls, k: Kernel, low: Array, span: Array, targets: Mapping[str, ArrayLike], positions: ArrayLike | None
    ) -> FreeTiming:
        """Timing of targets between the first and last of the given positions; default: those of the file,
        or a turn."""
        m, drives = k.mechanism, k.trace.course.schedule.names
        if len(drives) != 1:
            raise ModelError(
                f"free timing needs one drive, and the mechanism has {len(drives)}", 'give timing="given"'
            )
        q = m.schedule(over_a_turn(m)).position if positions is None else drive_values(m, positions)
        q = k.course(q).schedule.position[:, 0]
        sense = np.sign(q[-1] - q[0])
        target, spread = wanted(k, targets, None)
        closed = bool(m.drives[drives[0]].turns and goes_round(q))
        count = max(STATIONS, 6 * len(target))
        ends = (q[0], q[0] + sense * TURN) if closed else (q[0], q[-1])
        samples = OwnPositions(k, np.linspace(*ends, count, endpoint=not closed))
        return cls(
            k,
            low,
            span,
            target,
            spread,
            samples.stations[:, None],
            samples,
            float(sense or 1.0),
            closed,
        )

    def __call__(self, x: Array) -> Errors:
        n = len(self.span)
        answer = self.samples(self.low + x[:, :n] * self.span, self.sense * x[:, n:])
        count = len(self.target)
        slope = np.zeros((*answer.slope.shape[:-1], n + count))
        slope[..., :n] = answer.slope[..., :n] * self.span
        slope[:, range(count), :, range(n, n + count)] = self.sense * answer.slope[..., -1].swapaxes(0, 1)
        return self.errors(np.where(answer.ok[..., None], answer.value, np.nan), slope)

    def answers(self, u: Array) -> Flags:
        return np.asarray(self._at(u, self.positions).ok.all(axis=1))

    def moves(self, x: Array) -> Flags:
        return self.answers(x)

    def begin(self, u: Array) -> Array:
        blocks = [u[k : k + BLOCK] for k in range(0, len(u), BLOCK)]
        return np.hstack([u, np.concatenate([self._timing(block) for block in blocks])])

    def _timing(self, u: Array) -> Array:
        """Positions where designs are nearest to the targets, one after the other (design, P), in the sense of the
        drive."""
        r, count = self._at(u, self.positions), len(self.samples.stations)
        value = np.concatenate([r.value(n).reshape(len(u), count, -1) for n in self.kernel.outputs], axis=2)
        cost = (((value[:, None] - self.target[:, None]) / self.spread[:, None]) ** 2).sum(axis=3)
        best, least = np.zeros(cost.shape[:2]), np.full(len(u), np.inf)
        for first in np.argsort(cost[:, 0], axis=1)[:, : FIRST if self.closed else 1].T:
            costs, begun = cost, first[:, None] * self.closed
            if self.closed:
                costs = np.take_along_axis(cost, (begun + np.arange(count))[:, None] % count, axis=2)
                costs[:, 0, 1:] = np.inf
            total, at = _in_order(costs)
            better = total < least
            best[better], least[better] = (begun + at)[better], total[better]
        step = abs(self.samples.stations[1] - self.samples.stations[0])
        return np.asarray(self.sense * self.samples.stations[0] + best * step)

    def held(self, x: Array, down: Array) -> Flags:
        held = super().held(x, down)
        held[:, len(self.span) :] = False
        return held

    def moved(self, x: Array, step: Array) -> Array:
        n = len(self.span)
        t, low, high = x[:, n:], *np.sort(self.sense * self.samples.stations[[0, -1]])
        if self.closed:
            low, high = t[:, -1:] - TURN, t[:, :1] + TURN
        edges = np.hstack([np.broadcast_to(low, (len(t), 1)), t, np.broadcast_to(high, (len(t), 1))])
        gaps = np.diff(edges, axis=1) * NEARER
        at = t + np.clip(step[:, n:], -gaps[:, :-1], gaps[:, 1:])
        return np.hstack([super().moved(x[:, :n], step[:, :n]), at])

    def places(self, x: Array) -> Array:
        return self.sense * x[len(self.span) :, None]


def goes_round(q: Array) -> bool:
    """Whether positions are those of a whole turn, with its end or without; two of them are ends of a range.

    >>> q = np.linspace(0, TURN, 13)
    >>> goes_round(q), goes_round(q[:-1]), goes_round(q[:-2]), goes_round(q[[9, 0]]), goes_round(q[[0, 5, 10]])
    (True, True, False, False, False)
    """
    span, evenly = abs(q[-1] - q[0]), len(q) > 2
    return bool(span > 0.99 * TURN or (evenly and abs(span * len(q) / (len(q) - 1) - TURN) < 0.01 * TURN))


def _in_order(cost: Array) -> tuple[Array, Ints]:
    """Least sums (design,) of costs (design, P, S), and the stations (design, P), each after the previous one.

    Bellman's dynamic programming: the least sum up to a target at a station follows from those of the target before.
    """
    stations, total, back = np.arange(cost.shape[2]), cost[:, 0], list[Ints]()
    for k in range(1, cost.shape[1]):
        best = np.minimum.accumulate(total, axis=1)
        place = np.maximum.accumulate(np.where(total == best, stations, 0), axis=1)
        none = np.full((len(cost), 1), np.inf)
        total = cost[:, k] + np.hstack([none, best[:, :-1]])
        back.append(np.hstack([place[:, :1], place[:, :-1]]))
    at = [np.argmin(total, axis=1)]
    for place in reversed(back):
        at.append(np.take_along_axis(place, at[-1][:, None], axis=1)[:, 0])
    return total.min(axis=1), np.stack(at[::-1], axis=1)
