"""Kept programs give the answers of the careful path to 1e-10, on the same branch."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.model.library import TEMPLATES, template
from tests.engine.comparing import both, counted, difference
from tests.friction.rough import rough_tree
from tests.random_mechanisms import random_case, tree
from tests.random_space import random_case as random_space_case
from tests.random_space import tree as space_tree
from tests.tiers import over_seeds, sampled

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


QUICK_SEEDS = [1, 23, 27]
"""The first with wheels in mesh, the others without wheels and torsion springs."""


@over_seeds(QUICK_SEEDS, range(1000))
def test_random_mechanisms(seed: int) -> None:
    """All forces come from programs; positions of gears and of groups that close by Newton are the careful path's."""
    m = da.mechanism(tree(random_case(seed).drawing))
    off, by_program = both(m)
    assert off < TOLERANCE
    assert by_program or set(da.dynamics(m).status) != {"ok"}
    assert both(moved(m, seed), static=True)[0] < TOLERANCE


@over_seeds([0, 5, 31_002], range(300))
def test_random_mechanisms_with_friction(seed: int) -> None:
    """What slips surely is answered by programs; rest, reversals and jams are the careful path's. In the last one no
    effort depends on the friction of what is at rest."""
    m = da.mechanism(rough_tree(seed))
    assert both(m)[0] < TOLERANCE
    usual, careful = da.dynamics(m), da.dynamics(m, method="careful")
    for pair, same in zip(usual.ends, careful.ends, strict=True):
        assert all(difference(mine, other) < TOLERANCE for mine, other in zip(pair, same, strict=True))
    assert both(m, static=True)[0] < TOLERANCE
    assert both(moved(m, seed))[0] < TOLERANCE


@pytest.mark.parametrize("coefficient", [0.2, 3.0])
def test_reversals_are_the_careful_paths(coefficient: float) -> None:
    """The engine over its turn in whole degrees: at dead centres contacts reverse."""
    m = da.load(FILES["seed-002-7a-engine-friction-circles"])
    places = tuple(np.radians(np.arange(0.0, 360.0, 5.0)))
    m = m.with_values({"drives.O.position": places, "friction.coefficient": coefficient})
    with counted() as ways:
        r = da.dynamics(m)
    assert ways == [""]
    assert {"ok", "reversal", "self_locking"} == set(r.status)
    assert difference(r, da.dynamics(m, method="careful")) < TOLERANCE


@over_seeds([2, 3, 6], range(300))
def test_random_mechanisms_in_space(seed: int) -> None:
    m = da.mechanism(space_tree(random_space_case(seed)))
    off, by_program = both(m)
    assert off < TOLERANCE
    assert bool(by_program) == (not da.dynamics(m).compiled.layout.redundant)


def test_templates_are_answered_by_programs() -> None:
    """All of those of the plane but for the one with a group of four links, which closes by Newton, the wedge, whose
    block two slides place, and the eight whose belt, rope, ring drive, cam, brake or clutch has the phase or the seat
    of the first position."""
    made = [template(name) for name in TEMPLATES]
    with counted() as ways:
        redundant = [da.dynamics(m, positions=50).compiled.layout.redundant for m in made]
    assert [not way for way in ways] == redundant
    assert ways.count("all") == sum(m.dimension == 2 for m in made) - 10 >= 20


@pytest.mark.parametrize("name", sampled(QUICK, FILES))
def test_bundled_files(name: str) -> None:
    m = da.load(FILES[name])
    for run in (da.statics, da.dynamics):
        error = refusal(lambda: run(m, method="careful"))  # noqa: B023
        assert refusal(lambda: run(m)) == error  # noqa: B023
        with counted():
            assert error or difference(run(m), run(m, method="careful")) < TOLERANCE


def refusal(call: Callable[[], object]) -> str:
    """The sentence with which something is refused; none where it is not."""
    try:
        call()
    except da.ModelError as error:
        return str(error)
    return ""
