"""The kernel gives the answers of the general executor on random mechanisms."""

from __future__ import annotations

import numpy as np
import pytest

import dalembert as da
from tests.kernel.comparing import changed, difference, every_number, general
from tests.random_mechanisms import random_case, tree
from tests.tiers import tiers

TOLERANCE = 1e-10


def compared(seed: int) -> tuple[float, int]:
    """Largest difference over two designs of a random mechanism, and how many the general executor redid."""
    m = da.mechanism(tree(random_case(seed).drawing))
    k = da.compile(m, vary=every_number(m))
    values = np.stack([k.nominal, changed(k, seed, shape=1e-5)])
    r = k(values)
    return max(difference(k, r, d, general(m, k, values[d])) for d in range(2)), r.redone


@pytest.mark.parametrize("seed", tiers(range(2), range(2, 16), range(16, 1000)))
def test_random_mechanisms(seed: int) -> None:
    worst, _ = compared(seed)
    assert worst < TOLERANCE
