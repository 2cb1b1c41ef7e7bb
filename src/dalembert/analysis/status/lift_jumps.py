"""Positions at which the acceleration that a cam prescribes jumps: motion and forces just before and just after.

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


def lift_jumps(c: Compiled, pose: Pose, twist: Array) -> Array:
    """1 or -1 (P, K) of each cam at a jump, passed in the sense of its lift's argument or against it; else 0."""
    cams = [f for f in c.layout.constraints.families if isinstance(f, CamRow)]
    if not cams:
        return np.zeros((len(pose.point), 0))
    found = np.concatenate([jumps(c.layout.algebra, f, pose, twist) for f in cams], axis=-1)
    return np.where(np.isfinite(found), found, 0.0)


def both_sides(c: Compiled, marks: Array) -> Iterator[tuple[Ints, Compiled, Compiled]]:
    """Positions at jumps, with the mechanism whose lifts are those just before, and just after."""
    for pattern in np.unique(marks[marks.any(axis=1)], axis=0):
        where = np.flatnonzero((marks == pattern).all(axis=1))
        yield where, _moved(c, pattern), _moved(c, -pattern)


def _moved(c: Compiled, side: Array) -> Compiled:
    families, k = [], 0
    for f in c.layout.constraints.families:
        if isinstance(f, CamRow):
            f, k = beside(f, side[k : k + len(f.i)]), k + len(f.i)
        families.append(f)
    rows = replace(c.layout.constraints, families=tuple(families))
    return replace(c, layout=replace(c.layout, constraints=rows))


def jump_sentence(where: str) -> str:
    """Sentence of a position at a jump."""
    return f"The acceleration that a cam prescribes jumps{where}: the numbers are those just before and just after."


def jumping(marks: Array) -> Flags:
    """Positions (P,) at jumps."""
    return np.asarray(marks.any(axis=1))
