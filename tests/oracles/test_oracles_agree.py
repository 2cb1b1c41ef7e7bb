"""The oracles agree with each other before they judge anything."""

from __future__ import annotations

import numpy as np
import pytest

from tests.oracles import energy, lagrange
from tests.oracles.catalogue import EXAMPLES


@pytest.mark.parametrize("name", EXAMPLES)
@pytest.mark.parametrize("inertia", [True, False])
def test_closed_form_and_virtual_power_agree_with_lagrange(name: str, inertia: bool) -> None:
    example = EXAMPLES[name]
    closed = energy.solve(example.tree, example.kinematics, inertia)
    answer = lagrange.solve(example.tree, closed.q, inertia)
    for a, b in ((closed.q, answer.q), (closed.v, answer.v), (closed.a, answer.a)):
        np.testing.assert_allclose(a, b, rtol=0, atol=1e-13 * np.max(np.abs(b)))
    for drive, effort in closed.efforts.items():
        np.testing.assert_allclose(effort, answer.efforts[drive], rtol=0, atol=1e-13 * np.max(np.abs(effort)))
