"""Positions of equilibrium as roots: of functions whose roots are known, in place of efforts."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from dalembert.analysis import equilibria

Q = np.linspace(0.0, 10.0, 41)


class Scan:
    """A function of the position, in place of an effort; it counts the calls."""

    def __init__(self, g: Callable[[np.ndarray], np.ndarray]) -> None:
        self.g, self.calls, self.range = g, 0, (0.0, 10.0)

    def excess(self, q: np.ndarray) -> tuple[np.ndarray, float]:
        self.calls += 1
        return self.g(q), 1.0


def crossings(g: Callable[[np.ndarray], np.ndarray], scale: float = 1.0) -> Any:
    scan: Any = Scan(g)
    with np.errstate(all="ignore"):
        return equilibria._crossings(scan, Q, g(Q), scale)


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_roots_where_the_sign_changes(sign: float) -> None:
    roots = crossings(lambda q: sign * np.sin(q))
    assert np.sort(roots) == pytest.approx(np.pi * np.arange(4), abs=1e-15)
    exact = crossings(lambda q: sign * (q - Q[7]))
    assert exact.tolist() == [Q[7]]
    for pole in (lambda q: sign / (q - 3.1), lambda q: sign * np.where(q < 3.1, -1.0, 0.3)):
        assert crossings(pole).size == 0
    assert crossings(lambda q: 1.0 + 0 * q).size == 0
    hole = crossings(lambda q: np.where((q > 3.26) & (q < 3.3), np.nan, sign * (q - 3.4)))
    assert hole == pytest.approx([3.4], abs=1e-14)


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_roots_that_touch(sign: float) -> None:
    for g, expected in (
        (lambda q: sign * (1 - np.cos(q - 2.1)), [2.1, 2.1 + 2 * np.pi]),
        (lambda q: sign * (1.001 - np.cos(q - 2.1)), []),
        (lambda q: sign * np.sin(q), []),
        (lambda q: sign * (2 + q), []),
    ):
        scan: Any = Scan(g)
        assert equilibria._touches(scan, Q, g(Q), 1.0) == pytest.approx(expected, abs=1e-6)
        assert scan.calls < 150


def test_roots_stand_once_in_order_with_their_stability() -> None:
    roots = equilibria._distinct(np.array([3.0, 1.0, 3.0 + 1e-9, 2.0, 1.0]), -0.25)
    assert roots == pytest.approx([1, 2, 3])
    assert equilibria._distinct(np.zeros(0), 0.25).size == 0
    scan: Any = Scan(lambda q: (q - 1) * (q - 3) * (q - 5) ** 2)
    assert equilibria._stability(scan, np.array([1.0, 3.0, 5.0]), 100.0) == ("unstable", "stable", "neutral")
