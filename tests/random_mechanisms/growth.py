"""Growing a drawing: each step adds a driven link, or a group that closes on two links and adds no freedom."""

from __future__ import annotations

from contextlib import suppress
from copy import deepcopy
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from tests.oracles import lagrange
from tests.random_mechanisms.drawing import Drawing
from tests.random_mechanisms.groups import driven, dyad, rolling, single, welded, wheels
from tests.random_mechanisms.loading import loads as loaded
from tests.random_mechanisms.loading import masses
from tests.random_mechanisms.writing import Tree, pose_array, tree

CONDITION = 300.0
"""Of the constraints' Jacobian with lengths on the machine's scale; a group that makes it worse is drawn again."""


def random_mechanism(seed: int, links: tuple[int, int] = (4, 20), loads: bool = True) -> Drawing:
    """A drawing with about as many links as drawn from ``links``; the same for the same seed."""
    rng = np.random.default_rng(seed)
    wanted = int(rng.integers(links[0], links[1] + 1))
    d = Drawing(seed=seed)
    driven(d, rng)
    while len(d.poses) - 1 < wanted:
        d = _grown(d, rng)
    masses(d, rng)
    if loads:
        loaded(d, rng)
    return d


class Case(NamedTuple):
    """A random mechanism with its tree in SI and the oracle's answer."""

    drawing: Drawing
    tree: Tree
    answer: lagrange.Answer


@lru_cache(maxsize=256)
def random_case(seed: int) -> Case:
    """The mechanism of a seed, well conditioned at all its positions (or else that of a later seed)."""
    for k in range(20):
        d = random_mechanism(seed + 1_000_000 * k)
        made = tree(d)
        with suppress(ArithmeticError, np.linalg.LinAlgError):
            answer = lagrange.solve(made, pose_array(d))
            if answer.condition < 2 * CONDITION:
                return Case(d, made, answer)
    raise RuntimeError(f"seed {seed}: no well-conditioned mechanism")


def _grown(d: Drawing, rng: np.random.Generator) -> Drawing:
    """The drawing with one more group, well conditioned at its positions."""
    steps = [driven, dyad, dyad, dyad, single, single, wheels, rolling, welded]
    for _ in range(200):
        trial = deepcopy(d)
        steps[int(rng.integers(len(steps)))](trial, rng)
        if len(trial.joints) > len(d.joints) and _sound(trial):
            return trial
    raise RuntimeError(f"seed {d.seed}: no group fits")


def _sound(d: Drawing) -> bool:
    try:
        condition, v, a = lagrange.quality(tree(d), pose_array(d)[:1])
    except np.linalg.LinAlgError:
        return False
    return condition < CONDITION and np.max(np.abs(v)) < 10 and np.max(np.abs(a)) < 100
