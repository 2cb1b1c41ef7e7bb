"""Random mechanisms of all pairs changed at random: a ModelError, a status with a sentence, or numbers that balance."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.laws.mutations import mutated
from tests.laws.test_fuzz import answered_in_time, check, odd_trees, shortened
from tests.oracles.space.machines import EXAMPLES
from tests.random_space import random_drawing, tree
from tests.random_space.drawing import PAIRS
from tests.tiers import tiers

__all__ = ["answered_in_time"]


@cache
def bases() -> tuple[dict[str, Any], ...]:
    """Mechanisms that are right: those of the oracles at four positions, and random ones."""
    return (
        *(shortened(e.tree) for e in EXAMPLES.values()),
        *(tree(random_drawing(s, (2, 4))) for s in range(20)),
    )


def retyped(made: dict[str, Any], seed: int) -> dict[str, Any]:
    """Now and then a joint of another pair, its axes as they are."""
    joints, rng = made.get("joints"), np.random.default_rng(seed)
    if isinstance(joints, dict) and joints and rng.random() < 0.3:
        name = sorted(joints, key=str)[int(rng.integers(len(joints)))]
        if isinstance(joints[name], dict):
            joints[name]["type"] = str(rng.choice(list(PAIRS)))
    return made


@pytest.mark.parametrize("seed", tiers(range(1, 19), [0, *range(19, 150)]))
def test_a_changed_tree_is_refused_or_answered_honestly(seed: int) -> None:
    check(retyped(mutated(bases()[seed % len(bases())], seed), seed))


@pytest.mark.parametrize("block", tiers((), (), range(200)))
def test_fifty_thousand_changed_trees(block: int) -> None:
    for seed in range(250 * (block + 4), 250 * (block + 5)):
        check(retyped(mutated(bases()[seed % len(bases())], seed), seed))


@settings(max_examples=30)
@given(st.sampled_from(("axes", "axis", "lead", "blocked", "damping", "at", "type", "links")), odd_trees)
def test_any_value_in_a_joint(key: str, value: Any) -> None:
    made = bases()[0]
    name = next(iter(made["joints"]))
    check({**made, "joints": {**made["joints"], name: {**made["joints"][name], key: value}}})


@settings(max_examples=30)
@given(st.sampled_from(("inertia", "center", "points", "mass")), odd_trees)
def test_any_value_in_a_link(key: str, value: Any) -> None:
    made = bases()[0]
    name = next(n for n in made["links"] if n != "ground")
    check({**made, "links": {**made["links"], name: {**made["links"][name], key: value}}})


@settings(max_examples=30)
@given(st.sampled_from(("position", "axis", "angle")), odd_trees)
def test_any_value_in_the_assembly(key: str, value: Any) -> None:
    made = bases()[0]
    name = next(iter(made["assembly"]))
    check({**made, "assembly": {**made["assembly"], name: {**made["assembly"][name], key: value}}})
