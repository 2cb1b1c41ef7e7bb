"""Positions at which a prescribed acceleration jumps, of a cam or a law: motion and forces just before and just after.

Mechanics: docs/theory.md 2.3.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from dalembert.arrays import Array, Flags, Ints
from dalembert.core.elements.cam_family import CamRow
from dalembert.core.elements.cam_rows import beside, jumps
from dalembert.core.layout import Pose

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled


def jump_marks(c: Compiled, pose: Pose, twist: Array) -> Array:
    """1 or -1 (P, K + 1) of each cam at a jump, passed in the sense of its lift's argument or against it; last 1 where
    the law of a drive jumps; else 0."""
    cams = [f for f in c.layout.constraints.families if isinstance(f, CamRow)]
    led = c.schedule.jumps.any(axis=1, keepdims=True).astype(float)
    value = np.concatenate([*(jumps(c.layout.algebra, f, pose, twist) for f in cams), led], axis=-1)
    return np.where(np.isfinite(value), value, 0.0)


def both_sides(c: Compiled, marks: Array) -> Iterator[tuple[Ints, Compiled, Compiled]]:
    """Positions at jumps, with the mechanism whose accelerations are those just before, and just after."""
    for pattern in np.unique(marks[marks.any(axis=1)], axis=0):
        where = np.flatnonzero((marks == pattern).all(axis=1))
        yield where, _moved(c, pattern), _moved(just_after(c), -pattern)


def just_after(c: Compiled) -> Compiled:
    """The mechanism whose drives have the accelerations just after jumps of their laws."""
    return c if c.schedule.after is None else replace(c, schedule=c.schedule.just_after)


def _moved(c: Compiled, side: Array) -> Compiled:
    families, k = [], 0
    for f in c.layout.constraints.families:
        if isinstance(f, CamRow):
            f, k = beside(f, side[k : k + len(f.i)]), k + len(f.i)
        families.append(f)
    rows = replace(c.layout.constraints, families=tuple(families))
    return replace(c, layout=replace(c.layout, constraints=rows))


def jump_sentence(c: Compiled, run: Ints, where: str) -> str:
    """Sentence of a run of positions at jumps."""
    columns = np.flatnonzero(c.schedule.jumps[run].any(axis=0))
    names = [c.schedule.names[k] for k in columns]
    what = f"of drive {', '.join(map(repr, names))}" if names else "that a cam prescribes"
    return f"The acceleration {what} jumps{where}: the numbers are those just before and just after."


def jumping(marks: Array) -> Flags:
    """Positions (P,) at jumps."""
    return np.asarray(marks.any(axis=1))
