"""A motion through a list of positions, looked at as closely as it takes to be sure that it is one."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.analysis.engine.kept_program import KeptProgram
from dalembert.analysis.positions import FARTHEST
from dalembert.arrays import Array, Ints
from dalembert.core.position.path_parameter import walk

STEP, FEWEST = 0.2, 8
"""Longest path of the drives between two places, radians or lengths, and the least number of steps of a motion: the
motion between two listed positions is checked too."""

MOST = 20_000
"""Places between the listed positions that are looked at."""

MANY = 200_000
"""Angles that are counted at once, so that it takes little memory."""

TURN = 1.0
"""Largest turn of a link from place to place, radians; above it, its full turns are not counted reliably."""


class Walk(NamedTuple):
    """Places in the order in which a motion meets them: ``order`` of the list's and of those between, ``between``: the
    drives' positions at those between (B, D), ``before`` the listed position before each."""

    order: Ints
    between: Array
    before: Ints


def walk_through(c: Compiled, step: float) -> Walk | None:
    """The motion through a list with no step longer than ``step``; None where that would be too many."""
    drives = c.schedule.position
    count, none = len(drives), np.zeros(0, np.intp)
    if count == 1:
        return Walk(np.zeros(1, np.intp), drives[:0], none)
    order, _, s = walk(c.layout, drives)
    steps = np.diff(s)
    parts = np.ceil(steps / min(step, s[-1] / FEWEST)) if s[-1] > 0 else steps
    if not (steps <= FARTHEST).all() or parts.sum() > MOST + count:
        return None
    more = np.maximum(parts.astype(int) - 1, 0)
    low = np.repeat(np.arange(len(steps)), more)
    if not low.size:
        return Walk(order, drives[:0], none)
    share = (np.arange(len(low)) - np.repeat(np.cumsum(more) - more, more) + 1) / (more[low] + 1)
    before = drives[order[low]]
    between = before + share[:, None] * (drives[order[low + 1]] - before)
    complete = np.insert(order, low + 1, count + np.arange(len(low)))
    return Walk(complete, between, order[low])


def with_between(k: KeptProgram, columns: Array, walk: Walk) -> Array:
    """Columns of the inputs with those of the places in between: drives' positions, else as at the one before."""
    if not len(walk.between):
        return columns
    more = columns[:, walk.before]
    for row, place in enumerate(k.driven):
        more[row] = walk.between[:, place]
    return np.concatenate([columns, more], axis=1)


def count_turns(k: KeptProgram, out: Array, motion: Walk, first: Array) -> bool:
    """Adds the links' angles, full turns counted along the motion; false where one of them turns too far in a step."""
    free = k.free
    if len(motion.order) == 1:
        out[k.rows["turn"].start + free] = first[free, None]
        return True
    at_once = max(1, MANY // len(motion.order))
    parts = (free[start : start + at_once] for start in range(0, len(free), at_once))
    return all(_count_turns(k, out, motion, first, links) for links in parts)


def _count_turns(k: KeptProgram, out: Array, motion: Walk, first: Array, links: Ints) -> bool:
    """Put in the angles of some links."""
    rows = k.rows["rotation"].start + links
    angle = np.arctan2(out[rows + len(k.fixed)], out[rows])
    counts = np.zeros_like(angle)
    for part in range(0, len(motion.order) - 1, MANY):
        order = motion.order[part : part + MANY + 1]
        step = np.diff(angle[:, order], axis=1)
        turns = np.rint(step / (2 * np.pi))
        turned = turns.any()
        if turned:
            step -= 2 * np.pi * turns
        if (np.abs(step, out=step) > TURN).any():
            return False
        if turned or part:
            counts[:, order[1:]] = counts[:, order[:1]] - np.cumsum(turns, axis=1)
    counts += (np.rint((first[links] - angle[:, 0]) / (2 * np.pi)) - counts[:, 0])[:, None]
    counts *= 2 * np.pi
    out[k.rows["turn"].start + links] = np.add(angle, counts, out=counts)
    return True


def is_steady(k: KeptProgram, out: Array, motion: Walk) -> bool:
    """True if no group passes a dead centre between two places: the quantity that vanishes at it changes by less than
    its value."""
    if len(motion.order) == 1:
        return True
    sizes = (np.sqrt(row)[motion.order] for row in out[: k.squares])
    return all((np.abs(np.diff(a)) <= np.minimum(a[1:], a[:-1])).all() for a in sizes)
