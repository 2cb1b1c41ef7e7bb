"""Wrong, odd and broken descriptions: a ModelError, a status with a sentence, or numbers that balance."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from copy import deepcopy
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import dalembert as da
from tests.laws.mutations import mutated
from tests.oracles.catalogue import EXAMPLES, assembled
from tests.random_mechanisms import random_mechanism, tree
from tests.tiers import tiers

BALANCED = 1e-6


@cache
def bases() -> tuple[dict[str, Any], ...]:
    """Mechanisms that are right: those of the oracles at four positions, and random ones."""
    return (
        *(shortened(assembled(e).tree) for e in EXAMPLES.values()),
        *(tree(random_mechanism(s, (2, 5))) for s in range(15)),
    )


def shortened(made: dict[str, Any]) -> dict[str, Any]:
    """A copy at four positions."""
    made = deepcopy(made)
    for drive in made["drives"].values():
        drive["position"]["count"] = 4
    return made


SECONDS = 60


@pytest.fixture(autouse=True)
def answered_in_time() -> Iterator[None]:
    """A description that keeps the program busy for ever is a failure too (where the system has such timers).

    Counted is the processor's time: on a busy machine the answer comes later, and is no failure.
    """
    if not hasattr(signal, "SIGPROF"):
        yield
        return
    before = signal.signal(signal.SIGPROF, _late)
    yield
    signal.setitimer(signal.ITIMER_PROF, 0)
    signal.signal(signal.SIGPROF, before)


def _late(*_: object) -> None:
    raise AssertionError(f"no answer within {SECONDS} s of the processor's time")


def check(made: dict[str, Any]) -> None:
    """The answer to any description is honest, and comes."""
    if hasattr(signal, "SIGPROF"):
        signal.setitimer(signal.ITIMER_PROF, SECONDS)
    _check(made)


def _check(made: dict[str, Any]) -> None:
    try:
        r = da.solve(da.mechanism(made))
    except da.ModelError as error:
        assert error.what  # noqa: PT017
        return
    for k, status in enumerate(r.status):
        if status == "ok":
            assert balanced(r, k), (k, r.residual[k], r.power_balance[k])
        else:
            assert status in da.STATUSES
            assert r.reasons[k]
            assert silent(r, k) or status == "redundant"


def balanced(r: Any, k: int) -> bool:
    numbers = [r.effort(d)[k] for d in r.drives] + [r.unknown_load(x)[k] for x in r.unknown_loads]
    for link in r.links:
        turn = [r.angle(link)[k]] if r.mechanism.dimension == 2 else np.ravel(r.rotation(link)[k])
        numbers += [*r.position(link)[k], *turn, *r.center(link)[k]]
    numbers += [c for joint in r.joints for c in (*r.least_norm(joint)[k],)]
    return bool(
        np.all(np.isfinite(numbers)) and r.residual[k] < BALANCED and abs(r.power_balance[k]) < BALANCED
    )


def silent(r: Any, k: int) -> bool:
    """No number where there is no answer."""
    return not any(np.isfinite(r.effort(d)[k]) for d in r.drives)


FOUND = (5124, 10552, 1198)
"""Seeds that once hung (positions 1e9 turns apart) and crashed (gaps that least squares, and no start of a group of
four links, could close)."""


@pytest.mark.parametrize("seed", tiers([*range(30), *FOUND], range(30, 300)))
def test_a_changed_tree_is_refused_or_answered_honestly(seed: int) -> None:
    check(mutated(bases()[seed % len(bases())], seed))


@pytest.mark.parametrize("block", tiers((), (), range(100)))
def test_a_hundred_thousand_changed_trees(block: int) -> None:
    for seed in range(1000 * (block + 1), 1000 * (block + 2)):
        check(mutated(bases()[seed % len(bases())], seed))


scalars = st.none() | st.booleans() | st.integers(-5, 400) | st.floats() | st.text(max_size=8)
odd_trees = st.recursive(
    scalars,
    lambda x: st.lists(x, max_size=3) | st.dictionaries(st.text(max_size=6), x, max_size=3),
    max_leaves=6,
)
KEYS = (
    "links",
    "joints",
    "drives",
    "loads",
    "assembly",
    "gravity",
    "units",
    "answers",
    "title",
    "friction",
    "g",
    "space",
)


@settings(max_examples=20)
@given(st.sampled_from(KEYS), odd_trees)
def test_any_value_under_any_key(key: str, value: Any) -> None:
    check({**bases()[0], key: value})


@settings(max_examples=40)
@given(
    st.sampled_from(sorted(("crank", "coupler", "rocker"))),
    st.sampled_from(("points", "mass", "center", "inertia")),
    odd_trees,
)
def test_any_value_in_a_link(link: str, key: str, value: Any) -> None:
    made = bases()[0]
    check({**made, "links": {**made["links"], link: {**made["links"][link], key: value}}})


@settings(max_examples=10)
@given(st.lists(st.floats(0.02, 2.0), min_size=4, max_size=4), st.floats(-360, 360), st.floats(-100, 100))
@pytest.mark.long
def test_any_four_bar_closes_or_says_why(lengths: list[float], start: float, speed: float) -> None:
    a, b, c, d = lengths
    check({
        "links": {
            "ground": {"points": {"O2": [0, 0], "O4": [d, 0]}},
            "crank": {"points": {"O2": [0, 0], "A": [a, 0]}, "mass": 1.0},
            "coupler": {"points": {"A": [0, 0], "B": [b, 0]}, "mass": 2.0, "inertia": 0.1},
            "rocker": {"points": {"O4": [0, 0], "B": [c, 0]}},
        },
        "joints": {
            "O2": {"type": "pin", "links": ["ground", "crank"]},
            "A": {"type": "pin", "links": ["crank", "coupler"]},
            "B": {"type": "pin", "links": ["coupler", "rocker"]},
            "O4": {"type": "pin", "links": ["ground", "rocker"]},
        },
        "drives": {"O2": {"position": {"from": start, "to": start + 360, "count": 12}, "speed": f"{speed!r} rad/s"}},
        "loads": {"T": {"type": "couple", "on": "rocker", "value": 5.0}},
    })  # fmt: skip
