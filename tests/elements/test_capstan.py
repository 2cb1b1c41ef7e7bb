"""The capstan equation as a contact's strength: difference of a band's tensions over their mean."""

from __future__ import annotations

import math

import numpy as np
import pytest

from dalembert.core.branchless import tanh
from dalembert.core.friction.capstan import capstan
from dalembert.kernel.graph import Graph, trace_array


def strength(mu: float, wrap: float, blocks: int = 0) -> float:
    """Strength of one contact."""
    return float(capstan(np.array([mu]), np.array([wrap]), np.array([float(blocks)]))[0])


def ratio(strength: float) -> float:
    """Greater over smaller tension of a strength."""
    return (2 + strength) / (2 - strength)


@pytest.mark.parametrize(("mu", "degrees"), [(0.0, 200.0), (0.1, 30.0), (0.25, 270.0), (0.6, 720.0)])
def test_a_band_has_the_ratio_of_euler_and_eytelwein(mu: float, degrees: float) -> None:
    wrap = math.radians(degrees)
    assert ratio(strength(mu, wrap)) == pytest.approx(math.exp(mu * wrap), rel=1e-12)


@pytest.mark.parametrize("count", [1, 2, 14])
def test_blocks_have_the_ratio_of_their_own_formula(count: int) -> None:
    b = math.radians(7.5)
    grip = 0.25 * math.tan(b)
    assert ratio(strength(0.25, 2 * b * count, count)) == pytest.approx(
        ((1 + grip) / (1 - grip)) ** count, rel=1e-12
    )


def test_many_blocks_tend_to_the_band() -> None:
    wrap = math.radians(210)
    band = strength(0.25, wrap)
    off = [strength(0.25, wrap, n) - band for n in (10, 20, 40)]
    assert [off[0] / off[1], off[1] / off[2]] == pytest.approx([4, 4], rel=0.01)


def test_a_block_that_grips_at_any_tension_takes_all_of_it() -> None:
    edge = 1 / math.tan(math.radians(30))
    assert strength(edge * 1.001, math.radians(120), 2) == 2.0
    assert 1.99 < strength(edge * 0.999, math.radians(120), 2) < 2.0


def test_traced_values_have_the_same_strength() -> None:
    graph = Graph()
    mu = graph.input("number", "mu", 0.3)
    wrap = trace_array(graph, np.array([3.6, 1.2]))
    traced = capstan(np.array([mu, mu], object), wrap, np.array([0.0, 3.0]))
    values = graph.evaluate(list(traced), {mu.index: 0.3})
    assert np.array(values, float) == pytest.approx([strength(0.3, 3.6), strength(0.3, 1.2, 3)], rel=1e-14)


def test_traced_hyperbolic_tangents_are_exact_to_rounding() -> None:
    graph, at = Graph(), np.linspace(1e-3, 30, 50)
    x = graph.input("number", "x", 1.0)
    (traced,) = tanh(np.array([x], object))
    values = [float(graph.evaluate([traced], {x.index: float(v)})[0]) for v in at]
    assert np.array(values) == pytest.approx(np.tanh(at), rel=2e-15)
