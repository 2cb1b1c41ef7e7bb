"""Classic overconstrained linkages: the literature's mobility by two ranks, as drawn and after a finite motion.

``screws`` takes freedoms around loops, ``natural`` the derivatives of constraints in 12 coordinates a link; a linkage
that moves only instantaneously would not close along the drive.
"""

from __future__ import annotations

import numpy as np
import pytest

from tests.oracles.space import natural, screws
from tests.oracles.space.classics import CLASSICS
from tests.tiers import tiers

STEPS = 3
CLEAR = 1e9
"""Least ratio of the singular values counted to those not counted: no verdict hangs on a threshold."""


@pytest.mark.parametrize("name", CLASSICS)
def test_mobility_as_drawn_is_the_published_one(name: str) -> None:
    classic = CLASSICS[name]
    freedoms, redundant, gap = screws.mobility(classic.joints)
    assert (freedoms, redundant) == (classic.freedoms, classic.redundant)
    assert freedoms - redundant == classic.count
    assert gap > CLEAR


@pytest.mark.parametrize("name", tiers(list(CLASSICS)[::2], list(CLASSICS)[1::2]))
def test_mobility_holds_along_a_finite_motion(name: str) -> None:
    classic = CLASSICS[name]
    m, path, gaps = natural.followed(classic.tree(STEPS))
    assert max(gaps) < 5e-15
    for q in (path[0], path[-1]):
        freedoms, redundant, gap = natural.mobility(m, q)
        assert (freedoms, redundant) == (classic.freedoms, classic.redundant)
        assert gap > CLEAR
    if classic.drives:
        assert np.max(np.abs(path[-1] - path[0])) > 0.05


def test_most_of_them_would_not_move_by_the_count() -> None:
    assert sum(c.freedoms > max(c.count, 0) for c in CLASSICS.values()) >= 20


def test_a_line_symmetric_bricard_with_one_length_changed_does_not_close() -> None:
    loop = screws.Loop((1, 1.4, 0.8, 1, 1.4, 0.9), (60, 80, 110) * 2, (0.3, 0.2, 0.5) * 2)
    with pytest.raises(ValueError, match="does not close at"):
        loop.closed(0.8, np.array([0.8, -0.96, -2.97, 0.8, -0.96, -2.97]))
