"""Kept programs answer what the careful path answers, to 1e-10, and take the same way of closing."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.model.library import TEMPLATES, template
from tests.engine.comparing import both, counted, difference
from tests.random_mechanisms import random_case, tree
from tests.tiers import over_seeds, tiers

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


QUICK_SEEDS = [1, 23, 25, 27, 30]
"""The first with wheels in mesh, the others without wheels and torsion springs."""


@over_seeds(QUICK_SEEDS, range(1000))
def test_random_mechanisms(seed: int) -> None:
    m = da.mechanism(tree(random_case(seed).drawing))
    assert both(m)[0] < TOLERANCE
    assert both(moved(m, seed), static=True)[0] < TOLERANCE


def test_most_of_these_are_answered_by_programs() -> None:
    """All but those with wheels in mesh, or a group of more than two links, which closes by Newton."""
    with counted() as ways:
        for seed in QUICK_SEEDS:
            da.dynamics(da.mechanism(tree(random_case(seed).drawing)))
    assert sum(ways) >= 2


def test_templates_of_the_plane_are_answered_by_programs() -> None:
    """But for the one with a group of four links, which closes by Newton; large ones when they are met again."""
    made = [template(name) for name in TEMPLATES]
    plane = [m for m in made if m.dimension == 2]
    with counted() as ways:
        for m in plane:
            da.dynamics(m)
    assert len(plane) >= 15
    assert ways.count(False) == 1


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
