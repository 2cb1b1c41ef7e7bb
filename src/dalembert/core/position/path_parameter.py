"""The course of a motion: the list of positions laid out along one parameter, smooth but for its breaks.

s  how far the drives have moved, the fastest of them, in radians or characteristic lengths

With one drive the course runs through its positions in order of value, whatever their order in the list: the pose
depends on the value only. With several it follows the list, and breaks where their common direction turns.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.core.layout import Layout

STRAIGHT = 0.999
"""Cosine of the largest change of direction between two positions that is not a break: a few hundredths of the
travel, which the march's predictor may be off by."""


@dataclass(frozen=True)
class Course:
    """Positions along a course.

    order (P,) places in the list; s (P,) their parameters, ascending; targets (P, K + D) in that order; breaks (B,)
    the parameters between which the course is smooth, its ends included.
    """

    order: Ints
    s: Array
    targets: Array
    breaks: Array

    @property
    def end(self) -> float:
        """Length of the course."""
        return float(self.s[-1])

    def at(self, place: int) -> float:
        """Parameter of a position of the list."""
        return float(self.s[np.flatnonzero(self.order == place)[0]])

    def target(self, s: float) -> Array:
        """Targets (1, K + D) anywhere on the course, linear between its positions."""
        high = int(np.clip(np.searchsorted(self.s, s), 1, max(len(self.s) - 1, 1)))
        if len(self.s) == 1:
            return self.targets
        low, span = high - 1, self.s[high] - self.s[high - 1]
        part = (s - self.s[low]) / span if span > 0 else 1.0
        return np.asarray(self.targets[low] + part * (self.targets[high] - self.targets[low]))[None]

    def slope(self, s: float, side: float) -> Array:
        """Derivative (1, K + D) of the targets by s, on the side of a position that ``side`` has the sign of."""
        if self.end <= 0:
            return np.zeros_like(self.targets[:1])
        after = side > 0
        high = int(
            np.searchsorted(self.s, s + (1e-12 if after else -1e-12), side="right" if after else "left")
        )
        high = min(max(high, 1), len(self.s) - 1)
        while self.s[high] == self.s[high - 1]:
            high = high + 1 if after and high < len(self.s) - 1 else high - 1
        step = self.targets[high] - self.targets[high - 1]
        return np.asarray(step / (self.s[high] - self.s[high - 1]))[None]

    def limit(self, s: float, sign: float) -> float:
        """The next break ahead."""
        ahead = self.breaks[self.breaks > s + 1e-12] if sign > 0 else self.breaks[self.breaks < s - 1e-12]
        return (
            float(ahead.min() if sign > 0 else ahead.max()) if ahead.size else (self.end if sign > 0 else 0.0)
        )


def course(layout: Layout, targets: Array) -> Course:
    """The course through targets (P, K + D)."""
    drives = targets[:, layout.constraints.count :]
    order = np.arange(len(targets))
    if drives.shape[1] == 1:
        order = np.argsort(drives[:, 0], kind="stable")
    angular = layout.freedoms.angular[layout.driven]
    moves = np.diff(drives[order], axis=0) * np.where(angular, 1.0, 1 / layout.length)
    lengths = np.abs(moves).max(axis=1, initial=0.0)
    s = np.concatenate([[0.0], np.cumsum(lengths)])
    return Course(order, s, targets[order], np.concatenate([[0.0], s[1:-1][_turning(moves)], s[-1:]]))


def _turning(moves: Array) -> Flags:
    """Inner positions where the direction of the drives' common motion changes."""
    size = np.linalg.norm(moves, axis=1)
    product = size[:-1] * size[1:]
    cosine = (moves[:-1] * moves[1:]).sum(axis=1) / np.where(product > 0, product, 1.0)
    return np.asarray((cosine < STRAIGHT) & ((product > 0) | (size[:-1] + size[1:] > 0)))
