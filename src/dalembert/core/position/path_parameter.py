"""PositionPath of a motion: the list of positions along one parameter, smooth except at its breaks.

s  travel of the fastest drive, in radians or characteristic lengths

With one drive the course runs through its positions in order of value, whatever their order in the list: the pose
depends on the value only. With several it follows the list, and breaks where their common direction turns.

Mechanics: docs/theory.md 3.2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from dalembert.arrays import Array, Ints
from dalembert.core.layout import Layout

STRAIGHT = 0.999
"""Cosine of the largest change of direction between two positions that is not a break: an error of a few hundredths of
the travel, which the march's predictor tolerates."""

NEAR = 1e-12
"""Parameters closer than this are equal."""


@dataclass(frozen=True)
class PathSamples:
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
        place = float(np.interp(s, self.s, np.arange(len(self.s))))
        low, high = self.targets[math.floor(place)], self.targets[math.ceil(place)]
        return np.asarray(low + (place - math.floor(place)) * (high - low))[None]

    def slope(self, s: float, side: float) -> Array:
        """Derivative (1, K + D) of the targets by s, on the side of a position given by the sign of ``side``."""
        if self.end <= NEAR:
            return np.zeros_like(self.targets[:1])
        after = s < self.end - NEAR if side > 0 else s < NEAR
        high = np.searchsorted(self.s, s + NEAR, "right") if after else np.searchsorted(self.s, s - NEAR)
        step = self.targets[high] - self.targets[high - 1]
        return np.asarray(step / (self.s[high] - self.s[high - 1]))[None]

    def limit(self, s: float, sign: float) -> float:
        """The next break ahead."""
        if sign > 0:
            return float(self.breaks[self.breaks > s + NEAR].min(initial=self.end))
        return float(self.breaks[self.breaks < s - NEAR].max(initial=0.0))


def course(layout: Layout, targets: Array) -> PathSamples:
    """The course through targets (P, K + D)."""
    order, moves, s = walk(layout, targets[:, layout.constraints.count :])
    moved = np.diff(s) > 0
    directions = moves[moved] / np.linalg.norm(moves[moved], axis=1, keepdims=True)
    corner = (directions[:-1] * directions[1:]).sum(axis=1) < STRAIGHT
    return PathSamples(order, s, targets[order], np.concatenate([[0.0], s[1:][moved][:-1][corner], s[-1:]]))


def walk(layout: Layout, drives: Array) -> tuple[Ints, Array, Array]:
    """The order (P,) in which positions (P, D) of the drives are passed, the moves (P - 1, D) from one to the next in
    radians and characteristic lengths, and the parameters s (P,)."""
    order = np.arange(len(drives))
    if drives.shape[1] == 1:
        order = np.argsort(drives[:, 0], kind="stable")
    angular = layout.freedoms.angular[layout.driven]
    moves = np.diff(drives[order], axis=0) * np.where(angular, 1.0, 1 / layout.length)
    lengths = np.abs(moves[:, 0]) if drives.shape[1] == 1 else np.abs(moves).max(axis=1, initial=0.0)
    return order, moves, np.concatenate([[0.0], np.cumsum(lengths)])
