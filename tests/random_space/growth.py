"""Growing a drawing: each step adds a driven link, or a group that closes on two links and adds no other freedom."""

from __future__ import annotations

from contextlib import suppress
from copy import deepcopy
from functools import lru_cache

import numpy as np

from tests.random_space import groups
from tests.random_space.drawing import Drawing
from tests.random_space.loading import loads as loaded
from tests.random_space.loading import masses
from tests.space.screw_motion import gaps, moved, quality, standing

CONDITION = 300.0
"""Of the rows of all joints and drives, with lengths on the machine's scale; what makes it worse is drawn again."""

FAST = 10.0
"""Largest speed of a link."""

OPEN = 1e-4
"""Largest gap that rough steps over the positions may leave: more tells of a dead centre on the way."""


def random_drawing(
    seed: int, links: tuple[int, int] = (2, 8), loads: bool = True, redundant: bool | None = None
) -> Drawing:
    """A drawing with about as many links as drawn from ``links``; the same for the same seed."""
    rng = np.random.default_rng(seed)
    wanted = int(rng.integers(links[0], links[1] + 1))
    d = Drawing(seed=seed, posed=bool(rng.random() < 0.6))
    extra = rng.random() < 0.3 if redundant is None else redundant
    d = _grown(d, rng, [groups.flat] if extra and rng.random() < 0.5 else [groups.driven])
    while len(d.poses) - 1 < wanted:
        d = _grown(d, rng, [groups.loop] * 5 + [groups.rod] * 2 + [groups.welded, groups.driven])
    if extra:
        d = _grown(d, rng, [groups.twin, groups.flat])
    masses(d, rng)
    if loads:
        loaded(d, rng)
    return d


@lru_cache(maxsize=256)
def random_case(seed: int) -> Drawing:
    """The drawing of a seed, or of a later one where no group fits."""
    for k in range(5):
        with suppress(RuntimeError):
            return random_drawing(seed + 1_000_000 * k)
    raise RuntimeError(f"seed {seed}: no drawing")


def _grown(d: Drawing, rng: np.random.Generator, steps: list) -> Drawing:  # type: ignore[type-arg]
    """The drawing with one more group, well conditioned, with at most three drives."""
    for _ in range(300):
        trial = deepcopy(d)
        steps[int(rng.integers(len(steps)))](trial, rng)
        if len(trial.joints) > len(d.joints) and len(trial.drives) <= 3 and _sound(trial):
            return trial
    raise RuntimeError(f"seed {d.seed}: no group fits")


def _sound(d: Drawing) -> bool:
    """Well conditioned and not too fast as drawn, on the way, and a little beyond the last position."""
    s, step = standing(d), {name: drive.steps[-1] / 4 for name, drive in d.drives.items()}
    for _ in range(6):
        condition, speed = quality(d, s)
        if not (condition < CONDITION and speed < FAST and max(gaps(d, s).values()) < OPEN):
            return False
        s = moved(d, s, step)
    return True
