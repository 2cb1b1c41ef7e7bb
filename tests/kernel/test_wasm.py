"""The WebAssembly of a kernel gives the numbers and status codes of its machine code; functions are exact to ulps."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch.kernel_export import WasmModule
from dalembert.bundled import cases, examples
from dalembert.kernel.emit.wasm.module import emit_wasm
from dalembert.kernel.graph import Graph
from dalembert.kernel.operations import EVALUATE
from dalembert.kernel.program import Program
from tests.friction.rough import rough_tree
from tests.kernel.comparing import changed, every_number
from tests.kernel.machines import ROUGH
from tests.kernel.test_bundled import compiled
from tests.kernel.wasm_runs import distance, run_wasm
from tests.random_mechanisms import random_case, tree
from tests.tiers import over, sampled, tiers

FILES = {**cases(), **examples()}
QUICK = ["4b-06-bevan-four-bar", "fr-01-pulley-on-a-fixed-shaft", "seed-002-7d-engine-at-rest", "rssr"]
TOLERANCE = 1e-13

ULPS = {"sin": 1, "cos": 1, "exp": 1, "log": 1, "atan2": 2, "tan": 3, "asin": 3, "acos": 3, "sign": 0}
"""Of elementary functions, in units of the last place of the value, but near zeros of sin and cos of 1."""
EDGES = [0.0, -0.0, 1.0, -1.0, 0.5, 2.0, 1e-310, 709.7, 745.0, -745.0, 800.0, -800.0, np.inf, -np.inf, np.nan]


@pytest.mark.parametrize("name", sampled(QUICK, FILES))
def test_every_file_that_compiles(name: str) -> None:
    m = da.load(FILES[name])
    kernels = [
        compiled(m, free=free) for free in (False, True)
    ]  # tests/kernel/test_bundled.py holds the reasons
    assert [distance(k)[1] for k in kernels if k] == [0] * sum(map(bool, kernels))
    assert max((distance(k)[0] for k in kernels if k), default=0.0) < TOLERANCE


def own_rounding(k: Any, values: Any) -> float:
    """What the last place of each number given changes in the numbers found, over their largest."""

    def found(near: Any) -> Any:
        r = k(near, redo=False)
        return np.concatenate([a[0].ravel() for a in r.arrays.values()])

    rng, here = np.random.default_rng(0), found(values)
    near = [found(values * (1 + np.finfo(float).eps * rng.integers(-1, 2, len(values)))) for _ in range(4)]
    return float(np.nanmax(np.abs(np.array(near) - here)) / np.nanmax(np.abs(here)))


@over(1, whole=1000)
def test_random_mechanisms_with_other_numbers(seed: int) -> None:
    for drawing, rough in ((tree(random_case(seed).drawing), False), (rough_tree(seed), True)):
        m = da.mechanism(drawing)
        k = da.compile(m, vary=every_number(m), lanes=1)
        values = changed(k, seed, shape=1e-5)
        off, marks, count = distance(k, values)
        assert (off < max(TOLERANCE, 0.0 if off < TOLERANCE else own_rounding(k, values)), marks) == (True, 0)
        assert rough or count > 0  # a rough one may be jammed or at rest


@pytest.mark.parametrize("name", tiers(["four_bar"], sorted(set(ROUGH) - {"four_bar"})))
def test_friction_over_a_cycle(name: str) -> None:
    m = ROUGH[name]()
    k = da.compile(m, vary=every_number(m), lanes=1)
    off, marks, count = distance(k, changed(k, 1, 0.02))
    assert (off < TOLERANCE, marks, count > 0) == (True, 0, True)


def test_derivatives_are_outputs_too() -> None:
    k = da.compile(da.four_bar(), vary=["links.crank.points.A"], outputs=["effort.O2"], derivatives=True)
    module, r = k.to_wasm(), k()
    assert module.outputs[1] == "d effort.O2 / d links.crank.points.A.0"
    from dalembert.analysis.batch.kernel_export import wasm_channels

    out = run_wasm(module, k.nominal, wasm_channels(k, module.row))[
        :, : len(k.trace.course.schedule.position)
    ]
    assert pytest.approx(r.gradient("effort.O2")[0], rel=1e-11) == out[1:3].T


@pytest.mark.parametrize("op", sorted(ULPS))
def test_elementary_functions(op: str) -> None:
    rng = np.random.default_rng(7)
    x = np.concatenate([rng.uniform(-1, 1, 4000), rng.normal(size=2000) * 100, EDGES])
    y = rng.permutation(x)
    if op == "log":
        x = np.concatenate([np.abs(x), rng.uniform(0, 3, 1000), [-1.0]])
    if op in ("asin", "acos"):
        x = np.clip(x, -1, 1)
    y = np.resize(y, len(x))
    out, (a, b) = _evaluated(op, x, y)
    with np.errstate(all="ignore"):
        exact = EVALUATE[op](a, b) if op == "atan2" else EVALUATE[op](a)
    finite = np.isfinite(exact)
    if op in ("exp", "log", "sign"):  # edges too: below the normal numbers exp keeps fewer digits
        assert np.array_equal(out[~finite], exact[~finite], equal_nan=True)
    out, exact = out[finite], exact[finite]
    size = np.maximum(np.abs(exact), 1.0 if op in ("sin", "cos") else 1e-300)
    assert (np.abs(out - exact) <= (ULPS[op] + 0.01) * np.spacing(size)).all()


def _evaluated(op: str, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, tuple[np.ndarray, np.ndarray]]:
    """Values of one operation, of arguments filled up to whole blocks."""
    graph, even = Graph(), len(x) + len(x) % 2
    x, y = (np.resize(a, even) for a in (x, y))
    nodes = [graph.input("channel", name, a) for name, a in (("x", x), ("y", y))]
    made = graph.binary(op, nodes[0], nodes[1]) if op == "atan2" else graph.unary(op, nodes[0])
    code, heap = emit_wasm(Program(graph, (made,)), even)
    module = WasmModule(code, heap, even, (), ("x", "y"), (op,))
    return run_wasm(module, [], np.stack([x, y][: 1 + (op == "atan2")]))[0], (x, y)
