"""Kept programs answer what the careful path answers, to 1e-10, and take the same way of closing."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from tests.engine.comparing import both, counted, difference
from tests.random_mechanisms import random_case, tree
from tests.tiers import nth, over, tiers

TOLERANCE = 1e-10
FILES = {**cases(), **examples()}
QUICK = [
    "4b-06-bevan-four-bar",
    "balance_position",
    "bucket",
    "engine",
    "scissor_lift",
    "st-08-two-levers",
    "truss",
]


def moved(m: Any, seed: int) -> Any:
    """The same structure with other numbers: masses, loads and speeds."""
    rng = np.random.default_rng(seed)
    changes: dict[str, object] = {}
    for name, link in m.links.items():
        if link.mass is not None:
            changes[f"links.{name}.mass"] = link.mass * rng.uniform(0.5, 2)
    for name, drive in m.drives.items():
        if isinstance(drive.speed, float):
            changes[f"drives.{name}.speed"] = drive.speed * rng.uniform(0.5, 2)
    return m.with_values(changes)


def suits(seed: int) -> bool:
    """Whether a program can answer a random mechanism: no wheels in mesh, no torsion springs."""
    d = random_case(seed).drawing
    wheels = any(j["type"] in ("gear", "rolling") for j in tree(d)["joints"].values())
    return not wheels and not any(f["type"] == "torsion_spring" for f in tree(d)["loads"].values())


@over(5)
def test_random_mechanisms(seed: int) -> None:
    m = da.mechanism(tree(random_case(nth(seed, suits)).drawing))
    assert both(m)[0] < TOLERANCE
    assert both(moved(m, seed), static=True)[0] < TOLERANCE


def test_most_of_these_are_answered_by_programs() -> None:
    """All but those with a group of more than two links, which closes by Newton."""
    with counted() as ways:
        for k in range(6):
            da.dynamics(da.mechanism(tree(random_case(nth(k, suits)).drawing)))
    assert sum(ways) >= 3


@over(3)
def test_random_mechanisms_of_every_kind(seed: int) -> None:
    assert both(da.mechanism(tree(random_case(seed).drawing)))[0] < TOLERANCE


@pytest.mark.parametrize("name", tiers(QUICK, sorted(set(FILES) - set(QUICK))))
def test_bundled_files(name: str) -> None:
    m = da.load(FILES[name])
    for run in (da.statics, da.dynamics):
        error = refusal(lambda: run(m, method="careful"))  # noqa: B023
        assert refusal(lambda: run(m)) == error  # noqa: B023
        assert error or difference(run(m), run(m, method="careful")) < TOLERANCE


def refusal(call: Callable[[], object]) -> str:
    """The sentence with which something is refused; none where it is not."""
    try:
        call()
    except da.ModelError as error:
        return str(error)
    return ""
