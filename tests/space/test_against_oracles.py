"""Every answer in space against the hand solutions over whole cycles: positions, rates, all reactions, efforts."""

from __future__ import annotations

import numpy as np
import pytest

import dalembert as da
from tests.oracles.space.agreement import disagreement
from tests.oracles.space.machines import EXAMPLES

TOLERANCE = 1e-11


@pytest.mark.parametrize("name", EXAMPLES)
@pytest.mark.parametrize("dynamic", [True, False])
def test_every_number_is_that_of_the_hand_solution(name: str, dynamic: bool) -> None:
    example = EXAMPLES[name]
    m = da.mechanism(example.tree)
    r = da.dynamics(m) if dynamic else da.statics(m)
    assert set(r.status) == {"ok"}, r.problems()
    found = disagreement(r, example.answer(dynamic))
    worst = max(found, key=lambda key: np.nan_to_num(found[key], nan=np.inf))
    assert found[worst] < TOLERANCE, worst
