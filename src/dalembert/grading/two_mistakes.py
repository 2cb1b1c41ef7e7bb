"""Two mistakes of a sheet at once: sums of two changes that the answer is linear in.

Only for sheets with three independent wrong numbers or more: two mistakes in a hundred make thousands of pairs.

Mechanics: docs/theory.md 12.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from dalembert.arrays import Array
from dalembert.grading.figure import StudentValue
from dalembert.grading.value_slips import alike, coincidence, explains
from dalembert.grading.wrong.wrong_problems import WrongProblem

FEWEST = 3
"""Independent wrong numbers from which pairs are tried."""

ROUGH = 0.05
"""Relative difference up to which the sum of two changes is looked at more closely."""

PARALLEL = 1e-6
"""Difference from 1 of the cosine of two changes that are the same one, by another factor."""


class MistakePair(NamedTuple):
    """Two mistakes that together explain all wrong figures, and the expected coincidences."""

    sentence: str
    weight: str
    chance: float


def two_mistakes(
    figures: Sequence[StudentValue],
    wrong: Sequence[int],
    problems: Sequence[WrongProblem],
    values: Callable[[WrongProblem, int], tuple[Array, ...]],
    independent: int,
) -> MistakePair | None:
    """The pair of mistakes that explains all figures of a sheet; None where none does, or several that differ do.

    ``values`` of a problem for a figure; sizes and directions are not linear, so sheets with them have no pairs.
    """
    judged = [n for n, f in enumerate(figures) if f.judged]
    if independent < FEWEST or any(
        len(figures[n].right) != 1 or figures[n].answer.component in ("magnitude", "direction")
        for n in judged
    ):
        return None
    changes, known = [], []
    for problem in problems:
        each = [values(problem, n) for n in judged]
        if all(len(v) == 1 and np.isfinite(v[0]).all() for v in each):
            parts = [np.atleast_1d(v[0] - figures[n].right[0]) for n, v in zip(judged, each, strict=True)]
            changes.append(np.concatenate(parts))
            known.append(problem)
    value = _pairs(figures, judged, wrong, np.array(changes)) if len(changes) > 1 else []
    return _said(figures, wrong, known, value, len(changes), independent)


def _pairs(
    figures: Sequence[StudentValue], judged: Sequence[int], wrong: Sequence[int], changes: Array
) -> list[tuple[int, int, dict[int, Array]]]:
    """Pairs of changes with which every figure of the sheet is right, and the values of the wrong ones."""
    right = np.concatenate([np.atleast_1d(figures[n].right[0]) for n in judged])
    known = np.concatenate([np.atleast_1d(figures[n].given.value) for n in judged])
    sizes = np.concatenate(
        [np.full(figures[n].right[0].size, np.linalg.norm(figures[n].given.value) or 1.0) for n in judged]
    )
    scaled, wanted = changes / sizes, (known - right) / sizes
    norms = np.linalg.norm(scaled, axis=1)
    ends = np.cumsum([figures[n].right[0].size for n in judged])
    out = []
    for i in range(len(changes) - 1):
        rest = np.arange(i + 1, len(changes))
        near = np.abs(scaled[i] + scaled[rest] - wanted).max(axis=1) <= ROUGH
        cosine = np.abs(scaled[rest] @ scaled[i]) / np.maximum(norms[rest] * norms[i], 1e-300)
        for j in rest[near & (cosine < 1 - PARALLEL) & (norms[rest] * norms[i] > 0)]:
            each = np.split(right + changes[i] + changes[j], ends[:-1])
            both = {n: v.reshape(figures[n].right[0].shape) for n, v in zip(judged, each, strict=True)}
            if all(
                explains(figures[n], v) if n in wrong else figures[n].holds((v,)) for n, v in both.items()
            ):
                out.append((i, int(j), {n: both[n] for n in wrong}))
    return out


def _said(
    figures: Sequence[StudentValue],
    wrong: Sequence[int],
    problems: Sequence[WrongProblem],
    found: list[tuple[int, int, dict[int, Array]]],
    count: int,
    independent: int,
) -> MistakePair | None:
    """The pair of mistakes, in words; of pairs with the same figures at most two are named."""
    if not 1 <= len(found) <= 2:
        return None
    values = found[0][2]
    if any(not alike(figures[n], values[n], other[n]) for *_, other in found[1:] for n in wrong):
        return None
    each = [
        coincidence(figures[n], v, figures[n].close.off(v)) for n, v in values.items() for _ in range(v.size)
    ]
    chance = math.prod(sorted(each, reverse=True)[:independent]) * count * (count - 1) / 2
    pairs = [f"{problems[a].sentence}, and {problems[b].sentence}" for a, b, _ in found]
    return MistakePair("; or ".join(pairs), "concept", chance)
