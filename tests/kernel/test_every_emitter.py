"""Every operation and every mark by every way a program is run: machine code, C, casadi, numpy."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from dalembert.arrays import Array
from dalembert.kernel.emit import c_text, casadi_function, llvm_text
from dalembert.kernel.emit.machine_code import compile_module, to_blocks
from dalembert.kernel.emit.numpy_program import NumpyProgram
from dalembert.kernel.graph import Graph, Node
from dalembert.kernel.memory import address
from dalembert.kernel.operations import EVALUATE
from dalembert.kernel.program import CODES, KernelFlags, Program
from tests.kernel.test_running import pointer, shared

Ran = tuple[Array, Array]
"""Outputs (P, K) and marks (P,)."""
PAIRS = "add", "sub", "mul", "atan2", "max", "min"
POSITIVE, INSIDE = ("sqrt", "rsqrt", "log"), ("asin", "acos")
OF_PAGES = "min", "log", "asin", "acos"
"""Operations that the sketch program of a page has, and machine code has not."""


def in_machine_code(lanes: int) -> Callable[[Program, Array, Path], Ran]:
    def ran(p: Program, x: Array, _: Path) -> Ran:
        path, blocks = np.append(to_blocks(x, lanes), 0.0), -(-len(x) // lanes)
        out, code = np.zeros((blocks, len(p.outputs), lanes)), np.zeros(blocks * lanes, np.uint8)
        run = compile_module(llvm_text.pairs(p, lanes), lanes).function
        run(*(address(a) for a in (np.zeros(1), path, out, code)), 0, x.shape[1], 0, blocks)
        return out.transpose(0, 2, 1).reshape(-1, len(p.outputs))[: len(x)], code[: len(x)]

    return ran


def in_c(p: Program, x: Array, folder: Path) -> Ran:
    run = shared(folder, c_text.function(p, "alone", "A test."), "alone").alone
    out = np.zeros((len(x), max(1, len(p.outputs))))
    code = [
        run(pointer(np.zeros(1)), pointer(np.ascontiguousarray(a)), pointer(b))
        for a, b in zip(x, out, strict=True)
    ]
    return out[:, : len(p.outputs)], np.array(code)


def in_casadi(p: Program, x: Array, _: Path) -> Ran:
    pytest.importorskip("casadi")
    f = casadi_function.function(p, "alone", 0, [("all", len(p.outputs))])
    rows = [f(np.zeros(0), a) for a in x]
    return np.array([np.array(out).ravel() for out, _ in rows]), np.array(
        [int(float(mark)) for _, mark in rows]
    )


WAYS: dict[str, Callable[[Program, Array, Path], Ran]] = {
    "scalar code": in_machine_code(1),
    "four lanes": in_machine_code(4),
    "C": in_c,
    "casadi": in_casadi,
}


def channels(graph: Graph, count: int) -> list[Node]:
    return [graph.input("channel", f"x{k}", 0.5) for k in range(count)]


@pytest.mark.parametrize("way", WAYS)
def test_every_operation_is_that_of_numpy(way: str, tmp_path: Path) -> None:
    graph, rng = Graph(), np.random.default_rng(5)
    a, b, positive, inside = inputs = channels(graph, 4)
    left_out = ("detach", *(OF_PAGES if way in ("scalar code", "four lanes") else ()))
    pairs = [op for op in PAIRS if op not in left_out]
    made = {op: graph.binary(op, a, b) for op in pairs}
    of = dict.fromkeys(POSITIVE, positive) | dict.fromkeys(INSIDE, inside)
    made |= {op: graph.unary(op, of.get(op, a)) for op in EVALUATE if op not in (*PAIRS, *left_out)}
    x = np.column_stack([*rng.uniform(-4, 4, (2, 41)), rng.uniform(0.01, 9, 41), rng.uniform(-1, 1, 41)])
    x[0, 1] = x[0, 0]
    exact = [EVALUATE[op](x[:, 0], x[:, 1]) for op in pairs]
    exact += [EVALUATE[op](x[:, inputs.index(of.get(op, a))]) for op in list(made)[len(pairs) :]]
    program = Program(graph, tuple(made.values()))
    order = [inputs.index(n) for n in program.inputs_in_use("channel")]
    out, mark = WAYS[way](program, x[:, order], tmp_path)
    assert not mark.any()
    np.testing.assert_allclose(out, np.column_stack(exact), rtol=1e-14, atol=1e-15)


@pytest.mark.parametrize("many", [True, False])
def test_numpy_too_for_one_position_and_for_many(many: bool) -> None:
    graph = Graph()
    a, b = channels(graph, 2)
    made = {op: graph.binary(op, a, b) for op in PAIRS} | {
        op: graph.unary(op, b) for op in EVALUATE if op not in (*PAIRS, "detach")
    }
    run = NumpyProgram(graph, [a, b], list(made.values()), many)
    for values in ((-0.3, 0.7), (0.7, 0.3), (0.2, 0.2)):
        out = np.zeros((len(made), 3)) if many else np.zeros(len(made))
        given: Any = [np.full(3, v) for v in values] if many else list(values)
        run(given, out, not many)
        exact = [EVALUATE[op](*(values if op in PAIRS else values[1:])) for op in made]
        np.testing.assert_allclose(out.reshape(len(made), -1)[:, -1], exact, rtol=1e-15)


FLAGS = list(KernelFlags.__dataclass_fields__)


def mark_of(given: dict[str, float]) -> int:
    """The mark by the words of ``KernelFlags``; what is not given does not occur."""
    below = {k: v < 0 for k, v in given.items()}
    unsure = {k: not v >= 0 for k, v in given.items()}

    def is_(table: dict[str, bool], name: str) -> bool:
        return table.get(name, False)

    single = is_(unsure, "unsure") and is_(unsure, "sure")
    jam, turned = single and is_(below, "jam"), is_(below, "turned")
    slips = is_(unsure, "slips") or single or (turned and is_(unsure, "still"))
    locked = turned and below.get("locked", True)
    order = [
        ("open", is_(below, "open")), ("doubt", is_(unsure, "doubt")), ("rest", is_(below, "rest")), ("jam", jam),
        ("doubt", slips), ("contact", is_(below, "contact")), ("locked", locked), ("slope", is_(unsure, "slope")),
        ("outside", is_(below, "outside")),
    ]  # fmt: skip
    return next((CODES[name] for name, holds in order if holds), 0)


@pytest.mark.parametrize(
    "without", [(), ("locked", "still"), ("unsure", "sure", "jam"), ("turned", "still", "locked")]
)
@pytest.mark.parametrize("way", WAYS)
def test_every_mark_is_the_first_that_applies(way: str, without: tuple[str, ...], tmp_path: Path) -> None:
    names = [n for n in FLAGS if n not in without]
    graph, rng = Graph(), np.random.default_rng(11)
    inputs = channels(graph, len(names))
    flags = KernelFlags(**{n: (node + 0.5,) for n, node in zip(names, inputs, strict=True)})
    program = Program(graph, (inputs[0] * 2.0,), flags)
    quiet = np.full((1, len(names)), 1.0)
    alone = [
        quiet[0] + (np.arange(len(names)) == k) * (v - 1.0)
        for k, v in product(range(len(names)), (-1.5, -0.5, math.nan))
    ]
    some = np.where(
        rng.random((300, len(names))) < 0.3, rng.choice([-1.5, -0.5, math.nan], (300, len(names))), 1.0
    )
    x = np.vstack([quiet, alone, some])
    used = program.inputs_in_use("channel")
    marks = WAYS[way](program, x[:, [inputs.index(n) for n in used]], tmp_path)[1]
    assert marks.tolist() == [mark_of(dict(zip(names, row + 0.5, strict=True))) for row in x]
    assert len(set(marks.tolist())) > 6


@pytest.mark.parametrize("compare", [operator.gt, operator.ge, operator.lt, operator.le])
@pytest.mark.parametrize("nominal", [0.5, 2.0])
@pytest.mark.parametrize("constant", [True, False])
def test_a_decision_has_a_margin_that_is_negative_where_it_would_be_another(
    compare: Callable[[Any, Any], bool], nominal: float, constant: bool
) -> None:
    graph = Graph()
    x, y = graph.input("number", "x", nominal), graph.input("number", "y", 1.0)
    other = 1.0 if constant else y
    decided = compare(x, other)
    assert decided is compare(nominal, 1.0)
    (margin,) = graph.decisions
    for value in (-3.0, 0.9, 1.1, 7.0):
        (left,) = graph.evaluate([margin], {x.index: value, y.index: 1.0})
        assert (left < 0) is (compare(value, 1.0) is not decided)
