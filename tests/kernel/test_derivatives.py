"""Derivatives against differences of sixth order, of values and of reductions, and against the complex step."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.kernel.derivatives import gradients
from dalembert.kernel.graph import Graph
from tests.kernel.comparing import every_number
from tests.kernel.complex_step import slopes
from tests.kernel.machines import KINDS, four_bar
from tests.random_mechanisms import random_case, tree
from tests.tiers import tiers

WEIGHTS = {1: 3 / 4, 2: -3 / 20, 3: 1 / 60}
"""Of the central difference of sixth order."""


def differences(k: Any, output: str, n: int, size: float = 1e-3) -> tuple[np.ndarray, float]:
    """d output / d number n at the description's own numbers, and how far rounding can move it."""
    at = k.nominal
    h = size * max(abs(at[n]), 2e-2)
    steps = np.stack([at + s * j * h * (np.arange(len(at)) == n) for j in WEIGHTS for s in (1, -1)])
    value = k(steps, redo=False).value(output)
    slope = sum(w * (value[2 * i] - value[2 * i + 1]) for i, w in enumerate(WEIGHTS.values())) / h
    return np.asarray(slope), 1e-14 * float(np.nanmax(np.abs(value))) / h


def checked(m: Any, outputs: list[str], reduce: str | None = None, tolerance: float = 1e-7) -> None:
    vary = every_number(m)
    k = da.compile(m, vary=vary, outputs=outputs, reduce=reduce, derivatives=True)
    plain = da.compile(m, vary=vary, outputs=outputs, reduce=reduce)
    r = k()
    for output in outputs:
        exact = r.gradient(output)[0]
        for n in range(len(k.numbers)):
            found, rounding = differences(plain, output, n)
            allowed = tolerance * np.abs(exact[..., n]).max() + rounding
            assert np.abs(found - exact[..., n]).max() <= allowed, k.numbers[n]


@pytest.mark.parametrize("kind", ["pin-pin-pin", "pin-slider-pin", "slots", "no closed form", "two drives"])
def test_kinds_of_groups(kind: str) -> None:
    m = KINDS[kind]()
    checked(m, [f"effort.{next(iter(m.drives))}"])


def test_every_load() -> None:
    checked(four_bar(8), ["effort.O2", "reaction.A", "angle.rocker"])


@pytest.mark.parametrize(
    "reduce",
    tiers(["mean", "envelope", "norm8", "refined_peak", "refined_place"], ["peak", "rms", "squares"]),
)
def test_reductions(reduce: str) -> None:
    checked(four_bar(24), ["effort.O2", "reaction.B.magnitude"], reduce, tolerance=1e-6)


@pytest.mark.parametrize("seed", tiers(range(1), range(1, 9), range(9, 60)))
def test_random_mechanisms(seed: int) -> None:
    """By the complex step, which loses no digits where a derivative is small beside the value over the number."""
    m = da.mechanism(tree(random_case(seed).drawing))
    output = f"effort.{next(iter(m.drives))}"
    k = da.compile(m, vary=every_number(m), outputs=[output], derivatives=True)
    r = k()
    exact, value = r.gradient(output)[0], np.nanmax(np.abs(r.value(output)))
    for n, (name, slope) in enumerate(zip(k.numbers, slopes(k, output), strict=True)):
        right = np.isfinite(exact[:, n])
        rounding = 1e-13 * value / max(abs(k.nominal[n]), 2e-2)
        off = np.abs(slope[:, 0] - exact[:, n])[right].max(initial=0.0)
        assert off <= 1e-9 * np.abs(exact[right, n]).max(initial=0.0) + rounding, name


@pytest.mark.parametrize(
    "op", ["add", "sub", "mul", "atan2", "max", "neg", "inv", "sqrt", "rsqrt", "abs", "sin", "cos"]
)
def test_every_operation(op: str) -> None:
    """By central differences, on both sides of where two are equal."""
    for a, b in ((0.7, 0.4), (0.3, 1.2)):
        graph = Graph()
        x, y = graph.input("number", "x", a), graph.input("number", "y", b)
        two = op in ("add", "sub", "mul", "atan2", "max")
        out = graph.again(op, x, y if two else None)
        found = [float(graph.evaluate([n], {})[0]) for n in gradients(graph, [out], [x, y])[0]]

        def value(p: float, q: float, out: Any = out, places: Any = (x.index, y.index)) -> float:
            return float(out.graph.evaluate([out], dict(zip(places, (p, q), strict=True)))[0])

        h = 1e-6
        expected = [value(a + h, b) - value(a - h, b), value(a, b + h) - value(a, b - h)]
        assert found == pytest.approx(np.array(expected) / (2 * h), abs=1e-9)
