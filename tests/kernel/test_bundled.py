"""Every bundled file compiles, also with all its numbers free, or is refused with a sentence at a line of it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from tests.kernel.comparing import difference, every_number, general
from tests.tiers import sampled

FILES = {**cases(), **examples()}

QUICK = [
    "4b-06-bevan-four-bar",
    "balance_position",
    "fr-01-pulley-on-a-fixed-shaft",
    "gear_train",
    "rssr",
    "seed-001-eb-block-sliding",
    "seed-002-7d-engine-at-rest",
    "seed-f-2d-rod-at-45-deg-12",
    "st-08-two-levers",
    "toggle_press",
]
"""With friction at rest, in motion and jammed, with forces asked for, and one of each that is refused."""

REFUSALS = (
    "equilibrium positions cannot be compiled",
    "is a list along the motion",
    "with friction an unknown speed of turning cannot be compiled",
    "acts only through friction",
)


def compiled(m: Any, free: bool) -> Any:
    """A kernel, or None where one of the known reasons is given."""
    try:
        return da.compile(m, vary=every_number(m) if free else (), lanes=1)
    except da.ModelError as error:
        refused = error
    assert any(reason in str(refused) for reason in REFUSALS), str(refused)
    assert refused.line > 0
    return None


@pytest.mark.parametrize("name", sampled(QUICK, FILES))
def test_every_file_answers_as_the_general_executor_does(name: str) -> None:
    m = da.load(FILES[name])
    for k in filter(None, (compiled(m, free=False), compiled(m, free=True))):
        r, g = k(), general(m, k, k.nominal)
        assert list(r.status[0]) == list(g.status)
        if not {"ok", "self_locking"} & set(g.status):  # no numbers, those given in the file neither
            assert all(np.isnan(value).all() for value in r.arrays.values())
        else:
            assert difference(k, r, 0, g) < 1e-10


@pytest.mark.parametrize(
    "name", ["seed-f-2a-rod-at-45-deg-03", "seed-f-2b-rod-at-45-deg-09", "seed-f-2c-rod-at-45-deg-0999"]
)
def test_one_load_free(name: str) -> None:
    """Whether there is one solution only is known before the load is: nothing is left to ask at a position."""
    k = da.compile(da.load(FILES[name]), vary=["loads.Q.value"], lanes=1)
    r = k(k.nominal * [[0.5], [1.0], [-1.0]])
    for d, value in enumerate(r.values):
        g = general(k.mechanism, k, value)
        assert list(r.status[d]) == list(g.status)
        assert difference(k, r, d, g) < 1e-12


def test_the_direction_of_an_unknown_force() -> None:
    """It varies as that of a known one does."""
    m = da.load(FILES["toggle_press"])
    name = next(n for n, load in m.loads.items() if load.unknown)
    k = da.compile(m, vary=[f"loads.{name}.direction"], lanes=1)
    r = k([[k.nominal[0]], [k.nominal[0] + 0.1]])
    for d, value in enumerate(r.values):
        assert r.unknown_load(name)[d] == pytest.approx(general(m, k, value).unknown_load(name), rel=1e-10)
