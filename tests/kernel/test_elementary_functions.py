"""Functions in machine code against numpy's, at their ends too."""

from __future__ import annotations

import numpy as np
import pytest

from dalembert.kernel.emit import llvm_text
from dalembert.kernel.emit.machine_code import compile_module, to_blocks
from dalembert.kernel.graph import Graph
from dalembert.kernel.memory import address
from dalembert.kernel.operations import EVALUATE
from dalembert.kernel.program import Program

ULPS = {"exp": 1, "tan": 4, "sin": 1}
ENDS = [0.0, np.nan, np.inf, -np.inf, 709.78, 709.79, 800.0, -745.1, -745.2, -800.0]


@pytest.mark.parametrize("lanes", [1, 4])
@pytest.mark.parametrize("op", sorted(ULPS))
def test_functions_of_one_number(op: str, lanes: int) -> None:
    rng = np.random.default_rng(3)
    x = np.concatenate(
        [rng.uniform(-1, 1, 500), rng.uniform(-700, 700, 500) / (1 if op == "exp" else 50), ENDS]
    )
    x = x if op == "exp" else x[np.abs(x) < 700]
    graph = Graph()
    program = Program(graph, (graph.unary(op, graph.input("channel", "x", 0.0)),))
    path = np.append(to_blocks(x[:, None], lanes), 0.0)
    blocks = -(-len(x) // lanes)
    out, code = np.zeros((blocks, 1, lanes)), np.zeros(blocks * lanes, np.uint8)
    run = compile_module(llvm_text.pairs(program, lanes), lanes).function
    run(*(address(a) for a in (np.zeros(1), path, out, code)), 0, 1, 0, blocks)
    with np.errstate(all="ignore"):
        exact = EVALUATE[op](x)
    got, normal = out.ravel()[: len(x)], np.isfinite(exact) & (np.abs(exact) > 1e-300)
    assert np.array_equal(got[~np.isfinite(exact)], exact[~np.isfinite(exact)], equal_nan=True)
    size = np.maximum(np.abs(exact[normal]), 1.0 if op == "sin" else 0.0)
    assert (np.abs(got[normal] - exact[normal]) <= ULPS[op] * np.spacing(size)).all()
    assert (got[exact == 0] == 0).all()
