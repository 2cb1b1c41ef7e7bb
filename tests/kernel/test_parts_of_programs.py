"""Parts from which programs of a mechanism are made: rows of sketches, rods, order, marks, text and memory."""

from __future__ import annotations

import ctypes
import itertools
import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.compile.compiled_mechanism import compile_mechanism
from dalembert.analysis.positions import positions
from dalembert.bundled import examples
from dalembert.core.constraints import measure
from dalembert.core.layout import Idle
from dalembert.kernel import doubts, jam_proof, memory
from dalembert.kernel.emit import c_text, machine_code
from dalembert.kernel.emit.wasm import instructions
from dalembert.kernel.graph import Graph
from dalembert.kernel.position.rods import _rods
from dalembert.kernel.program import KernelFlags, Program
from dalembert.kernel.sketch_program import elimination_order, pose_inputs, sketch


def solved(name: str) -> Any:
    m = da.load(examples()[name])
    found = positions(compile_mechanism(m, m.schedule()))
    assert found.path is not None
    return found


def test_a_row_with_a_phase_has_its_measure_and_another_what_its_target_misses() -> None:
    found = solved("gear_train")
    layout, like = found.compiled.layout, found.path.pose.at([1])
    rows, graph = layout.constraints, Graph()
    phased = {0, 1, rows.count - 1}
    s = sketch(graph, layout, found.compiled.target + 7.0, pose_inputs(graph, layout, layout, like), phased)
    values = [float(np.ravel(x)[0]) for x in graph.evaluate(s.outputs, {})]
    measured = measure(layout.algebra, rows, like)[0]
    free = measure(layout.algebra, layout.freedoms, like)[0]
    assert len(s.rows) == rows.count + layout.freedoms.count
    for k, row in enumerate(s.rows[: rows.count]):
        off = 0.0 if k in phased else found.compiled.target[k] + 7.0
        assert values[row.value] == pytest.approx(measured[k] - off, abs=1e-12)
        assert row.kind == ("phase" if k in phased else "constraint")
        assert (row.joint, row.ends) == (rows.joint[k], tuple(int(end[k]) for end in rows.ends))
        assert (row.angular, row.freedom) == (rows.angular[k], None)
    for k, row in enumerate(s.rows[rows.count :]):
        assert values[row.value] == pytest.approx(free[k], abs=1e-12)
        assert (row.kind, row.freedom, row.angular) == ("freedom", k, layout.freedoms.angular[k])
    assert any(row.period is not None for row in s.rows)
    assert s.turns == []


@pytest.mark.parametrize(
    ("ends", "links", "order"),
    [
        ([(3, 0), (0, 1), (1, 2)], 3, [2, 1, 0]),
        ([(3, 1), (1, 0), (1, 2), (2, 2)], 3, [2, 1, 0]),
        ([(0, 3), (0, 1), (0, 2), (0, 3)], 5, [3, 2, 0, 1, 4]),
        ([(0, 1), (2, 3)], 4, [3, 2, 1, 0]),
        ([(4, 2), (2, 0), (2, 1), (0, 3), (1, 3), (4, 3), (0, 4)], 4, [1, 3, 2, 0]),
    ],
)
def test_links_are_eliminated_so_that_neighbours_are_near(
    ends: list[tuple[int, int]], links: int, order: list[int]
) -> None:
    i, j = np.array(ends).T
    layout: Any = SimpleNamespace(links=links, constraints=SimpleNamespace(ends=(i, j)))
    assert sorted(elimination_order(layout)) == list(range(links))
    assert elimination_order(layout) == order


def test_a_rod_is_found_wherever_its_balls_stand_in_the_file() -> None:
    tree = da.rssr().to_tree()
    names = list(tree["joints"])
    balls = {n for n in names if "rod" in tree["joints"][n]["links"]}
    assert len(balls) == 2
    for order in itertools.permutations(names):
        m = da.mechanism(tree | {"joints": {name: tree["joints"][name] for name in order}})
        c = compile_mechanism(m, m.schedule(1))
        (idle,) = (f for f in c.layout.constraints.families if isinstance(f, Idle))
        (rod,) = _rods(c.layout, idle)
        assert c.links[rod.link] == "rod"
        others = {n: next(x for x in tree["joints"][n]["links"] if x != "rod") for n in balls}
        assert [c.links[other] for _, other, _ in rod.balls] == [others[n] for n in order if n in balls]
        assert rod.length == pytest.approx(np.linalg.norm(rod.balls[1][0] - rod.balls[0][0]))


# programs


def flagged() -> tuple[Graph, Any, Any, Any, Any]:
    g = Graph()
    return g, g.input("number", "n", 2.0), g.input("common", "m", 3.0), g.input("channel", "x", 4.0), g.input("channel", "y", 5.0)  # fmt: skip  # noqa: E501


def test_a_program_computes_each_operation_as_seldom_as_it_can() -> None:
    g, n, m, x, y = flagged()
    design, position, sure, jam = n * m, n * x, (y + n).sin(), (y * m).cos()
    flags = KernelFlags(open=(x - 3,), sure=(sure,), jam=(jam + sure,))
    p = Program(g, (design + position, g.constant(7.0)), flags)
    assert p.design == [design]
    assert p.position == [position, *sorted([design + position, x - 3], key=lambda k: k.index)]
    assert p.seldom == [y + n, sure]
    assert p.rare == sorted([y * m, jam, jam + sure], key=lambda k: k.index)
    assert p.inputs == [n, m, x, y]
    assert p.inputs_in_use("channel") == [x, y]
    assert p.places == {x.index: 0, y.index: 1, m.index: 0, n.index: 0}
    assert {c.value for c in p.constants} == {3.0, 7.0}
    assert p.order.index(jam) > p.order.index(y * m)
    assert p.size == 3
    assert p.depth == 2


@pytest.mark.parametrize(
    ("keys", "names"),
    [
        ({}, []),
        ({"open": 1, "doubt": 1, "rest": 1, "jam": 1}, ["open", "doubt", "rest", "jam"]),
        ({"slips": 1}, ["doubt"]),
        ({"sure": 1}, ["doubt"]),
        ({"still": 1}, ["doubt"]),
        ({"unsure": 1}, []),
        (
            {"outside": 1, "slope": 1, "turned": 1, "contact": 1, "locked": 1},
            ["contact", "locked", "slope", "outside"],
        ),
    ],
)
def test_marks_that_can_occur_are_in_the_order_in_which_they_count(
    keys: dict[str, int], names: list[str]
) -> None:
    x = Graph().input("channel", "x", 1.0)
    assert KernelFlags(**dict.fromkeys(keys, (x,))).names == names


def test_flags_are_asked_at_every_position_or_seldom() -> None:
    g = Graph()
    each = {name: (g.input("channel", name, 1.0),) for name in KernelFlags.__dataclass_fields__}
    flags = KernelFlags(**each)
    named = {node.index: name for name, (node,) in each.items()}
    always = ["open", "doubt", "rest", "slips", "unsure", "turned", "contact", "outside", "slope"]
    assert [named[n.index] for n in flags.always] == always
    assert [named[n.index] for n in flags.seldom] == ["sure", "still", "locked"]


@pytest.mark.parametrize(("count", "waits"), [(7, True), (8, False), (9, False)])
def test_independent_operations_fill_a_register_from_eight_on(count: int, waits: bool) -> None:
    g, n, _, x, _ = flagged()
    p = Program(g, tuple(x + float(k + 1) for k in range(count)))
    assert (p.size, p.depth, p.waits) == (count, 1, waits)
    none = Program(g, (n,))
    assert (none.size, none.depth, none.waits) == (0, 0, False)


@pytest.mark.parametrize(
    ("length", "outputs", "waits"),
    [
        (1999, 1, True),
        (2000, 1, False),
        (100, 32, True),
        (100, 33, False),
        (396, 33, False),
        (397, 33, True),
    ],
)
def test_a_chain_waits_unless_it_is_long_or_stores_much(length: int, outputs: int, waits: bool) -> None:
    g, _, _, x, y = flagged()
    chain = [x + y]
    for _ in range(length - 1):
        chain.append(chain[-1] + y)
    p = Program(g, tuple(chain[-outputs:]))
    assert (p.size, p.depth) == (length, length)
    assert p.waits is waits


@pytest.mark.parametrize(
    ("op", "cost"), [("sqrt", 8), ("sin", 15), ("cos", 15), ("inv", 6), ("neg", 0), ("detach", 0), ("abs", 1)]
)
def test_slow_operations_count_as_several(op: str, cost: int) -> None:
    g, _, _, x, y = flagged()
    p = Program(g, (g.make(op, x * y),))
    assert p.depth == 1 + cost
    assert p.size == (1 if op in ("neg", "detach") else 2)


# doubts


def test_what_may_be_negative_is_uncertain() -> None:
    g, n, *_ = flagged()
    known = [g.constant(v) for v in (2.0, 0.0, -1.0, math.nan)]
    assert doubts.uncertain([*known, n]) == (known[2], known[3], n)
    assert doubts.largest(g, np.array([n, g.constant(-5.0), g.constant(4.0)])).graph is g
    top = doubts.largest(g, np.array([g.constant(-5.0), g.constant(4.0)]))
    assert top.value == 5.0
    assert doubts.largest(g, np.zeros(0)) is g.zero


def test_a_given_effort_of_a_frame_is_met_within_a_part_of_the_largest() -> None:
    g, n, m, x, y = flagged()
    frame: Any = SimpleNamespace(driven=1, effort=[x])
    square, (margin) = doubts.unmet(frame, [m], np.array([n, y]), n)
    assert square is m
    (value,) = g.evaluate([margin], {x.index: 4.0, y.index: 4.0 + 1e-9})
    assert value == pytest.approx(2e-11 - 1e-9, rel=1e-5)
    assert doubts.unmet(None, [m], np.array([n, y]), n) == []
    frame.driven = 0
    assert len(doubts.unmet(frame, [], np.array([n, y]), n)) == 1
    (low,) = g.evaluate([margin], {x.index: 4.0, y.index: 4.0 - 1e-9})
    assert low == pytest.approx(value, rel=1e-5)
    frame.driven = -1
    assert doubts.unmet(frame, [m], np.array([n, y]), n) == []


def test_bounds_of_lengths_are_those_of_their_words() -> None:
    """0.586 of the larger and 0.415 of both, of balls of all three, else the larger of the force and the couple."""
    h = np.array([[[3.0, -1.0]], [[-4.0, 2.0]], [[9.0, 0.5]]])
    force = [0.586 * 4 + 0.415 * 7, 0.586 * 2 + 0.415 * 3]
    found = jam_proof.lever(h, np.array([False]))
    assert found.ravel() == pytest.approx([9.0, force[1]])
    ball = jam_proof.lever(h, np.array([True])).ravel()
    assert ball == pytest.approx(
        [0.586 * 9 + 0.415 * (force[0] + 9), 0.586 * force[1] + 0.415 * (force[1] + 0.5)]
    )
    angles = np.linspace(0, 2 * math.pi, 361)
    assert (jam_proof._length(np.abs(np.cos(angles)), np.abs(np.sin(angles))) >= 1.0).all()


# text


@pytest.mark.parametrize(
    ("op", "right"),
    [
        ("add", "c[0] + c[1]"),
        ("sub", "c[0] - c[1]"),
        ("mul", "c[0] * c[1]"),
        ("max", "LARGER(c[0], c[1])"),
        ("min", "SMALLER(c[0], c[1])"),
        ("atan2", "atan2(c[0], c[1])"),
        ("inv", "1 / c[0]"),
        ("rsqrt", "1 / sqrt(c[0])"),
        ("neg", "-c[0]"),
        ("detach", "c[0]"),
        ("abs", "fabs(c[0])"),
        ("sign", "SIGN(c[0])"),
        ("positive", "POSITIVE(c[0])"),
        ("exp", "exp(c[0])"),
    ],
)
def test_an_operation_is_a_declaration_in_c(op: str, right: str) -> None:
    g, _, _, x, y = flagged()
    two = op in ("add", "sub", "mul", "max", "min", "atan2")
    made = g.make(op, x, y) if two else g.make(op, x)
    program = Program(g, (g.make("add", x, y), made))
    assert c_text.statement(made, c_text.names(program)) == f"const REAL t{made.index} = {right};"


def test_names_in_c_are_by_the_arrays_of_their_inputs() -> None:
    g, n, m, x, _ = flagged()
    more = g.input("common", "k", 1.0)
    program = Program(g, (n + m + x + more + 0.1,))
    name = c_text.names(program)
    assert [name(a) for a in (n, m, more, x, g.constant(0.1))] == [
        "v[0]",
        "m[0]",
        "m[1]",
        "c[0]",
        "((REAL)0.1)",
    ]
    assert {p: c_text._start(p) for p in ("sum", "square", "argpeak", "peak", "min", "argmin", "max", "argmax")} == {
        "sum": "0",
        "square": "0",
        "argpeak": "-1",
        "peak": "-1",
        "min": "(REAL)INFINITY",
        "argmin": "(REAL)INFINITY",
        "max": "-(REAL)INFINITY",
        "argmax": "-(REAL)INFINITY",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("number", "code"),
    [
        (0, "00"),
        (63, "3f"),
        (64, "c000"),
        (-1, "7f"),
        (-64, "40"),
        (-65, "bf7f"),
        (624485, "e58e26"),
        (-123456, "c0bb78"),
    ],
)
def test_signed_numbers_of_webassembly_are_in_groups_of_seven_bits(number: int, code: str) -> None:
    """The last two from the description of LEB128."""
    assert instructions.signed(number).hex() == code


@pytest.mark.parametrize(("number", "code"), [(0, "00"), (127, "7f"), (128, "8001"), (624485, "e58e26")])
def test_unsigned_numbers_of_webassembly_are_in_groups_of_seven_bits(number: int, code: str) -> None:
    assert instructions.unsigned(number).hex() == code


# registers and memory


@pytest.mark.parametrize(
    ("features", "machine", "lanes"),
    [
        ({"avx512f": True, "avx2": True}, "x86_64", 8),
        ({"avx512f": False, "avx2": True}, "x86_64", 4),
        ({"avx2": False}, "x86_64", 2),
        ({}, "arm64", 2),
    ],
)
def test_lanes_are_those_of_the_widest_registers(
    features: dict[str, bool], machine: str, lanes: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    binding = SimpleNamespace(get_host_cpu_features=lambda: features)
    monkeypatch.setattr(machine_code, "_binding", lambda: binding)
    monkeypatch.setattr("platform.machine", lambda: machine)
    assert machine_code.host_lanes.__wrapped__() == lanes


@pytest.mark.parametrize(
    ("count", "lanes", "last"), [(5, 2, [4, 4]), (6, 2, [4, 5]), (1, 4, [0] * 4), (5, 4, [4] * 4)]
)
def test_rows_are_in_blocks_of_lanes_the_last_filled_up_with_the_last_row(
    count: int, lanes: int, last: list[int]
) -> None:
    array = np.arange(count)[:, None] * 10.0 + np.array([0.0, 1.0, 2.0])
    blocks = machine_code.to_blocks(array, lanes)
    assert blocks.shape == (-(-count // lanes), 3, lanes)
    assert blocks[0, :, 0].tolist() == [0.0, 1.0, 2.0]
    assert blocks[-1, 1].tolist() == [10.0 * k + 1 for k in last]


def test_results_begin_at_a_line_of_the_cache_and_large_ones_are_used_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for shape in ((), (3,), (7, 5), (2, 1 << 14)):
        array, again = memory.result_array(shape)
        assert array.shape == shape
        assert memory.address(array) % 64 == 0
        assert not again
    monkeypatch.setattr(memory._Pages, "waiting", {})
    count = memory.LARGE // 8
    first, again = memory.result_array((count,))
    assert not again
    start = memory.address(first)
    del first
    assert len(memory._Pages.waiting) == 1
    small, again = memory.result_array((count // 4,))  # less than half is another
    assert not again
    second, again = memory.result_array((count,))
    assert again
    assert memory.address(second) == start
    del second, small
    monkeypatch.setattr(memory, "KEPT", 8 * count // 2)
    third = memory.result_array((count,))[0]
    del third
    assert sum(kept.nbytes for kept in memory._Pages.waiting.values()) <= memory.KEPT


def test_an_address_is_that_of_the_first_byte_of_whatever_array() -> None:
    array = np.arange(6.0)
    assert memory.address(array) == array.ctypes.data
    assert memory.address(array[2:]) == array.ctypes.data + 16
    array.flags.writeable = False
    assert memory.address(array) == array.ctypes.data
    assert ctypes.c_double.from_address(memory.address(array) + 8).value == 1.0
