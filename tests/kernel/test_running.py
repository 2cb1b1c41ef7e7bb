"""Lanes, threads, parts, progress and interruption, reductions, memory, and the same text through a C compiler."""

from __future__ import annotations

import ctypes
import resource
import shutil
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch.kernel_export import plain
from dalembert.analysis.batch.over_positions import PARTS, reduce_positions, slope
from dalembert.arrays import Array
from dalembert.kernel import memory, parallel_runs
from dalembert.kernel.emit import c_text, cuda, llvm_text
from dalembert.kernel.emit.machine_code import compile_module, host_lanes
from dalembert.kernel.emit.reductions import width
from dalembert.kernel.graph import Graph
from dalembert.kernel.memory import aligned_array, available
from dalembert.kernel.program import Program
from tests.kernel.comparing import changed, every_number
from tests.kernel.machines import KINDS, ROUGH, four_bar, turning_arm
from tests.tiers import crossed

VARY = ["links.crank.points.A", "links.rocker.points.B", "links.coupler.mass", "drives.O2.speed"]
OUTPUTS = ["effort.O2", "reaction.A", "reaction.B.magnitude"]


def designs(k: Any, count: int) -> np.ndarray:
    return np.stack([changed(k, seed, shape=0.02) for seed in range(count)])


@crossed("lanes, kind", [1, 2, 4, 8], ["pin-pin-pin", "no closed form", "slider_crank"])
def test_lanes_give_the_same(lanes: int, kind: str) -> None:
    """Also more lanes than the processor has: the compiler splits them."""
    m = (KINDS | ROUGH)[kind]()
    drive = next(iter(m.drives))
    one = da.compile(m, outputs=[f"effort.{drive}"], lanes=1)().effort(drive)
    many = da.compile(m, outputs=[f"effort.{drive}"], lanes=lanes)().effort(drive)
    assert np.abs(one - many).max() < 1e-12 * np.abs(one).max()


def test_the_processor_s_own_lanes(monkeypatch: pytest.MonkeyPatch) -> None:
    assert host_lanes() in (2, 4, 8)
    assert da.compile(da.four_bar()).lanes == 2 * host_lanes()
    every = every_number(da.four_bar())
    assert (
        da.compile(da.four_bar(), derivatives=True, vary=every).lanes == host_lanes()
    )  # wide enough by itself
    masses = [
        f"links.{name}.{what}" for name in ("crank", "coupler", "rocker") for what in ("mass", "inertia")
    ]
    assert (
        da.compile(da.four_bar(), derivatives=True, vary=masses).lanes == host_lanes()
    )  # waits for its stores
    monkeypatch.setattr("dalembert.kernel.program.SMALL", 10)
    assert da.compile(da.four_bar()).lanes == host_lanes()


@pytest.mark.parametrize("lanes", [1, 4, 8, 16])
def test_inverses_are_good_to_two_units_in_the_last_place(lanes: int) -> None:
    """1/x and 1/sqrt(x), from the processor's estimates where it has them; no number where there is none."""
    graph = Graph()
    x = graph.input("channel", "x", np.ones(1))
    program = Program(graph, (graph.inverse(x), graph.unary("rsqrt", x)))
    rng = np.random.default_rng(5)
    given = np.exp(rng.uniform(-300, 300, 4000)) * np.where(np.arange(4000) % 4 == 3, -1, 1)
    given[[10, 20]] = [0.0, np.nan]
    path, blocks = parallel_runs.path_array(given[:, None], np.zeros(0), lanes, weighted=False)
    out = np.empty((2, parallel_runs.row_length(blocks, lanes)))
    code = np.empty(out.shape[1], np.uint8)
    compile_module(llvm_text.grid(program, lanes), lanes)(np.zeros(1), path, out, code, (0, 1, 1, blocks))
    found = out[:, :4000]
    with np.errstate(all="ignore"):
        expected = np.stack([1 / given, 1 / np.sqrt(given)])
    right = np.isfinite(expected)
    assert not np.isfinite(found[~right]).any()
    assert (np.abs(found[right] / expected[right] - 1) <= 4.5e-16).all()


TIED = [-3.0, -1.0, 2.0, 5.0, -5.0, 4.0, 5.0, -5.0, 1.0, 0.5, -4.0]
"""The largest, the least and the largest of magnitude occur more than once: first at 3, 4 and 3, counted from 0."""


@pytest.mark.parametrize(
    ("values", "extremes"),
    [
        (np.array(TIED), {"peak": (5.0, 3), "min": (-5.0, 4), "max": (5.0, 3)}),
        (np.array(TIED) * (1 + 1e-14 * np.arange(11)), {"peak": (5.0, 3), "min": (-5.0, 4), "max": (5.0, 3)}),
        (np.array(TIED) * (1 + 1e-9 * np.arange(11)), {"peak": (5.0, 7), "min": (-5.0, 7), "max": (5.0, 6)}),
        (np.zeros(7), {"peak": (0.0, 0), "min": (0.0, 0), "max": (0.0, 0)}),
        (-np.arange(9.0), {"peak": (8.0, 8), "min": (-8.0, 8), "max": (0.0, 0)}),
        (np.array([-2.0, -7.0, -2.0]), {"peak": (7.0, 1), "min": (-7.0, 1), "max": (-2.0, 0)}),
    ],
    ids=["equal", "equal within rounding", "beyond rounding", "zeros", "falling", "below zero"],
)
def test_the_place_of_an_extreme_is_the_first_of_equal_ones(
    values: Array, extremes: dict[str, tuple[float, int]], tmp_path: Path
) -> None:
    """In any number of lanes, as C for a card and in numpy; the extreme itself is the largest to its last digit."""
    graph = Graph()
    program = Program(graph, (graph.input("channel", "x", np.ones(1)),))
    slots = tuple((0, "arg" + p) for p in extremes)
    exact = {"peak": np.abs(values).max(), "min": values.min(), "max": values.max()}
    wanted = [[exact[p], place] for p, (_, place) in extremes.items()]
    assert [exact[p] for p in extremes] == pytest.approx([about for about, _ in extremes.values()], rel=1e-7)
    out, code = np.empty(6), np.empty(1, np.uint8)
    for lanes in (1, 2, 4, 8, 16):
        path, blocks = parallel_runs.path_array(values[:, None], np.zeros(0), lanes, weighted=False)
        run = compile_module(llvm_text.grid(program, lanes, slots), lanes)
        run(np.zeros(1), path, out, code, (0, 1, 1, blocks))
        assert out.reshape(-1, 2).tolist() == wanted, lanes
    card = shared(tmp_path, c_text.emit_reduced(program, slots), "card")
    given = [pointer(a) for a in (np.zeros(1), values, np.zeros(1), out, code)]
    card.reduced(*given, *map(ctypes.c_longlong, (0, 1, 1, len(values))))
    assert out.reshape(-1, 2).tolist() == wanted
    assert reduce_positions("argpeak", values) == extremes["peak"][1]
    marks = np.arange(len(values), dtype=float)[:, None, None]
    ends = slope("envelope", values[:, None], marks)  # derivatives that are the places
    assert ends.ravel().tolist() == [extremes["min"][1], extremes["max"][1]]


@pytest.mark.parametrize("count", [1, 3, 8, 21])
def test_sums_beside_extremes_count_no_position_twice(count: int, tmp_path: Path) -> None:
    """The last block of lanes is filled with the last position, which has no weight in a sum."""
    graph, values = Graph(), np.cos(1.0 + 2.0 * np.arange(count))
    program = Program(graph, (graph.input("channel", "x", np.ones(1)), graph.constant(2.0)))
    slots = ((0, "peak"), (0, "sum"), (0, "square"), (0, "power8"), (0, "min"), (0, "max"), (1, "sum"))
    wanted = [abs(values).max(), values.sum(), (values**2).sum(), (values**8).sum()]
    wanted += [values.min(), values.max(), 2.0 * count]
    out, code = np.empty(len(slots)), np.empty(1, np.uint8)
    for lanes in (1, 2, 4, 8):
        path, blocks = parallel_runs.path_array(values[:, None], np.zeros(0), lanes, weighted=True)
        run = compile_module(llvm_text.grid(program, lanes, slots), lanes)
        run(np.zeros(1), path, out, code, (0, 2, 1, blocks))
        assert out == pytest.approx(wanted, rel=1e-13, abs=1e-15), lanes
    card = shared(tmp_path, c_text.emit_reduced(program, slots), "card")
    given = [pointer(a) for a in (np.zeros(1), values, np.zeros(1), out, code)]
    card.reduced(*given, *map(ctypes.c_longlong, (0, 1, 1, count)))
    assert out == pytest.approx(wanted, rel=1e-13, abs=1e-15)


def test_a_peak_that_is_the_same_everywhere_is_at_the_first_position() -> None:
    """The reaction at the pin of an arm that turns evenly is m r w^2 in every position, and its rounding is not."""
    r = da.compile(
        turning_arm(), ["links.arm.center", "links.arm.mass"], ["reaction.O.magnitude"], reduce="argpeak"
    )
    values = r.nominal + np.random.default_rng(1).normal(size=(20, 3)) * 0.02
    assert r(values).value("reaction.O.magnitude").tolist() == [0.0] * 20
    general = [da.dynamics(r.mechanism.with_values(dict(zip(r.numbers, v, strict=True)))) for v in values[:3]]
    places = [reduce_positions("argpeak", g["reaction.O.magnitude"]) for g in general]
    assert places == [0.0] * 3


@pytest.mark.parametrize("positions", [1, 20, 33])
def test_results_begin_at_a_line_of_the_cache(positions: int) -> None:
    k = da.compile(four_bar(40), vary=VARY, outputs=OUTPUTS)
    program, machine, _ = k.runner.machine("grid")
    columns, common = k.runner.inputs(program, k.trace.course)
    path, _ = parallel_runs.path_array(columns[:positions], common, machine.lanes, weighted=False)
    for a in (path, aligned_array((3, 5)), aligned_array((7,)), k(designs(k, 2)).effort("O2")):
        assert a.__array_interface__["data"][0] % 64 == 0


def test_few_positions_fill_lanes_with_designs() -> None:
    k = da.compile(four_bar(40), vary=VARY, outputs=OUTPUTS)
    values = designs(k, 21)
    whole = k(values)
    few = k(values, positions=whole.positions[[3, 17, 30]])
    for output in OUTPUTS:
        assert (
            np.abs(few.value(output) - whole.value(output)[:, [3, 17, 30]]).max()
            < 1e-11 * np.abs(few.value(output)).max()
        )


def test_positions_that_change_are_other_positions() -> None:
    """Those given, and those of a result, are the caller's: the motion kept from the last call is not theirs."""
    k = da.compile(four_bar(40), vary=VARY, outputs=["effort.O2"])
    file, given = k(), np.linspace(0.1, 3.0, 20)[:, None]
    for positions in (file.positions, given, k(positions=given).positions):
        before = k(positions=positions).effort("O2").copy()
        positions += 0.1
        after = k(positions=positions).effort("O2")
        assert (after == k(positions=positions.copy()).effort("O2")).all()
        assert np.abs(after - before).max() > 0.01 * np.abs(before).max()
    assert (k().effort("O2") == file.effort("O2")).all()


@pytest.mark.parametrize("reduce", PARTS)
def test_reductions(reduce: str) -> None:
    m = four_bar(37)
    k, whole = (da.compile(m, vary=VARY, outputs=OUTPUTS, reduce=r) for r in (reduce, None))
    values = designs(k, 9)
    few, all_ = k(values), whole(values)
    for output in OUTPUTS:
        expected = reduce_positions(reduce, np.moveaxis(all_.value(output), 1, 0))
        assert few.value(output).shape == expected.shape
        assert np.allclose(few.value(output), expected, rtol=1e-12)


def test_a_design_that_does_not_close_is_alone() -> None:
    m = four_bar(36)
    k = da.compile(m, vary=["links.rocker.points.B"], outputs=["effort.O2"], reduce="peak")
    values = np.stack([k.nominal, [0.08, 0.0], [np.nan, 0.0], k.nominal])
    r = k(values)
    assert list(r.status) == ["ok", "not_assembled", "failed", "ok"]
    assert np.isnan(r.effort("O2")[1:3]).all()
    assert r.effort("O2")[0] == r.effort("O2")[3]
    assert r.problems()[0][:2] == (1, "not_assembled")


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_threads_parts_and_progress(threads: int, monkeypatch: pytest.MonkeyPatch) -> None:
    k = da.compile(four_bar(24), vary=VARY, outputs=OUTPUTS, reduce="peak")
    values = designs(k, 100)
    expected = k(values, threads=1)
    monkeypatch.setattr(parallel_runs, "WORK", 24 * 7)
    seen: list[tuple[int, int]] = []
    r = k(values, threads=threads, progress=lambda *done: seen.append(done))
    assert (r.effort("O2") == expected.effort("O2")).all()
    assert seen[-1] == (100, 100)
    assert seen == sorted(seen)
    assert len(seen) > 10 or threads > 1


@pytest.mark.parametrize(
    ("designs", "positions", "part"),
    [(0, 100, 1), (400, 100, 400), (401, 100, 400), (10_000, 100, 625), (10**6, 100, 4000), (10, 10**6, 1)],
)
def test_how_many_designs_are_one_part(designs: int, positions: int, part: int) -> None:
    """All where they are few, else a quarter of each of four threads' share, but 40,000 to 400,000 positions."""
    assert parallel_runs.part_size(designs, positions, 4) == part


@pytest.mark.parametrize("threads", [1, 2])
def test_interruption(threads: int, monkeypatch: pytest.MonkeyPatch) -> None:
    k = da.compile(four_bar(24), vary=VARY, outputs=OUTPUTS, reduce="peak")
    monkeypatch.setattr(parallel_runs, "WORK", 24)
    values, done = np.repeat(k.nominal[None], 5000, axis=0), []

    def stop(count: int, of: int) -> None:
        done.append(count)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        k(values, threads=threads, progress=stop)
    assert len(done) == 1


def test_an_error_on_another_thread_is_raised_here() -> None:
    seen: list[slice] = []

    def part(which: slice) -> None:
        seen.append(which)
        time.sleep(1e-3)
        if threading.current_thread() is not threading.main_thread():
            raise ValueError("there")

    with pytest.raises(ValueError, match="there"):
        parallel_runs.in_parts(part, 100, 1, 2, None)
    assert len(seen) < 100


def test_changing_numbers_does_not_compile_again(monkeypatch: pytest.MonkeyPatch) -> None:
    k = da.compile(four_bar(360), vary=VARY, outputs=OUTPUTS)
    k(designs(k, 2))
    compilations: list[object] = []
    monkeypatch.setattr(
        "dalembert.analysis.batch.runner.compile_module", lambda *given: compilations.append(given)
    )
    for seed in range(20):
        k(changed(k, seed, shape=0.02))
    assert not compilations


def test_results_in_memory_used_again_are_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory._Pages, "waiting", {})  # that of other tests' results
    k = da.compile(four_bar(33), vary=VARY, outputs=OUTPUTS)
    few = designs(k, 22)
    expected, values = k(few), np.tile(few, (200, 1))
    r = k(values)
    assert k.runner.machine.cache_info().currsize == 1
    for _ in range(2):  # the first result gives its memory back when the second is there
        del r
        r = k(values)
    assert k.runner.machine.cache_info().currsize == 2  # stores past the cache
    for output in OUTPUTS:
        there = r.value(output).reshape(200, *expected.value(output).shape)
        assert (there == expected.value(output)).all()


HOW = [{"derivatives": True}, {"reduce": "envelope"}, {"positions": [[0.3], [2.0]]}]


@pytest.mark.parametrize("how", HOW)
def test_results_go_into_arrays_that_are_given(how: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """A few designs at a time; no number where there is no answer there too."""
    monkeypatch.setattr(parallel_runs, "CACHE", 1 << 15)
    options = {name: value for name, value in how.items() if name != "positions"}
    k = da.compile(four_bar(24), vary=VARY, outputs=OUTPUTS, **options)
    values, given = designs(k, 9), {"positions": how.get("positions")}
    values[2, 0], values[4, 2] = 5.0, np.nan
    r = k(values, **given)
    assert not r.ok.all()
    expected = r.arrays | {f"gradient.{name}": rate for name, rate in r.gradients.items()}
    out = {name: np.full(array.shape, -1.0) for name, array in expected.items()}
    found = k(values, out=out, **given)
    assert (found.code == r.code).all()
    for name, array in expected.items():
        assert np.array_equal(out[name], array, equal_nan=True)
    assert found.value("effort.O2") is out["effort.O2"]


def test_results_go_to_a_file(tmp_path: Path) -> None:
    k = da.compile(four_bar(24), vary=VARY, outputs=["effort.O2"])
    values = designs(k, 3)
    file = np.lib.format.open_memmap(tmp_path / "torque.npy", "w+", shape=(3, 24))
    k(values, out=file)
    file.flush()
    assert (np.load(tmp_path / "torque.npy") == k(values).effort("O2")).all()


@pytest.fixture(scope="module")
def two() -> Any:
    return da.compile(four_bar(24), vary=VARY, outputs=["effort.O2", "reaction.A.magnitude"], lanes=1)


ONE = np.zeros((1, 24))
WRONG_OUT: list[tuple[Any, str]] = [
    (
        ONE,
        "out= is for effort.O2, and there are results of effort.O2, reaction.A.magnitude; give an array of each by its "
        "name",
    ),
    (
        {"effort.O2": ONE, "reaction.A.magnitude": ONE},
        "out= uses one array for several results; give a separate array for each",
    ),
    (
        {"effort.O2": ONE[0], "reaction.A.magnitude": ONE},
        "out= of effort.O2 has shape (24,); give one of shape (1, 24)",
    ),
    (
        {"effort.O2": ONE, "reaction.A.magnitude": ONE.astype(np.float32)},
        "out= of reaction.A.magnitude is not a writable array of floats; give np.empty((1, 24))",
    ),
]


@pytest.mark.parametrize(("out", "what"), WRONG_OUT)
def test_arrays_that_do_not_fit_are_refused(out: Any, what: str, two: Any) -> None:
    with pytest.raises(da.ModelError) as refusal:
        two(out=out)
    assert str(refusal.value) == what


def test_blocks_are_parts_of_the_whole() -> None:
    k = da.compile(four_bar(24), vary=VARY, outputs=["effort.O2"])
    values = designs(k, 7)
    parts = list(k.blocks(values, size=3))
    assert [len(part.values) for part in parts] == [3, 3, 1]
    assert (np.concatenate([part.effort("O2") for part in parts]) == k(values).effort("O2")).all()
    assert len(list(k.blocks(values))) == 1
    with pytest.raises(da.ModelError, match="size=0 is not a number of size"):
        k.blocks(values, size=0)


@pytest.mark.parametrize("positions", [None, [[0.3], [2.0]]])
def test_results_larger_than_memory_are_refused(
    positions: list[list[float]] | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Before anything is computed; the ways that the sentence names are open."""
    k = da.compile(four_bar(24), vary=VARY, outputs=["effort.O2"])
    values = designs(k, 40)
    monkeypatch.setattr("dalembert.analysis.batch.runner.available", lambda: 500.0)
    monkeypatch.setattr("dalembert.analysis.batch.runner.CHECKED", 0)
    with pytest.raises(
        da.ModelError, match=r"40 designs take .* GB, and 5e-07 GB are free; give out= .*blocks"
    ):
        k(values, positions=positions)
    out = np.empty((40, 24 if positions is None else 2))
    k(values, positions=positions, out=out)
    assert np.isfinite(out).all()
    assert len([r.effort("O2") for r in k.blocks(values, size=1, positions=positions)]) == 40
    assert 0 < available() < np.inf


def test_memory_is_that_of_values_and_answers() -> None:
    k = da.compile(four_bar(24), vary=VARY, outputs=["effort.O2"], reduce="peak")
    values = np.repeat(k.nominal[None], 400_000, axis=0)
    k(values[:1000])
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    k(values)
    grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * (
        1 if sys.platform == "darwin" else 1024
    )
    assert grown < 100e6


def shared(tmp_path: Path, text: str, name: str) -> ctypes.CDLL:
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("there is no C compiler")
    source, library = tmp_path / f"{name}.c", tmp_path / f"{name}.so"
    source.write_text(text)
    subprocess.run([compiler, "-O1", "-shared", "-fPIC", "-o", str(library), str(source), "-lm"], check=True)
    return ctypes.CDLL(str(library))


def pointer(a: np.ndarray) -> ctypes.c_void_p:
    return a.ctypes.data_as(ctypes.c_void_p)


class CardOfC:
    """What stands for cupy and a card: the same text through the C compiler, every thread in turn."""

    uint8, empty = np.uint8, staticmethod(np.empty)
    asarray = staticmethod(np.ascontiguousarray)
    asnumpy = staticmethod(np.asarray)

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def RawModule(self, code: str) -> CardOfC:
        self.library = shared(self.folder, code, "card")
        return self

    def get_function(self, name: str) -> Any:
        def entry(blocks: tuple[int], threads: tuple[int], given: tuple[Any, ...]) -> None:
            *arrays, _, _, designs, positions = given
            asked = designs if name == "reduced" else designs * positions
            assert asked <= blocks[0] * threads[0] < asked + threads[0]
            assert all(a.dtype in (float, np.uint8) for a in arrays)
            getattr(self.library, name)(
                *(ctypes.c_longlong(a) if isinstance(a, np.int64) else pointer(a) for a in given)
            )

        return entry


@crossed(
    "kind, reduce",
    ["pin-pin-pin", "no closed form", "slots", "slider_crank"],
    ["rms", None, "peak", "envelope"],
)
def test_the_card_s_text_compiled_as_c(
    kind: str, reduce: str | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The text for CUDA, compiled by the system's C compiler, gives what the machine code gives."""
    m = (KINDS | ROUGH)[kind]()
    drive = next(iter(m.drives))
    k = da.compile(m, vary=["links.ground.points.O2"], outputs=[f"effort.{drive}"], reduce=reduce)
    program, _, slots = k.runner.machine("reduce" if reduce else "grid")
    columns, common = k.runner.inputs(program, k.trace.course)
    values = np.ascontiguousarray(k.nominal[None] + np.array([[0.0, 0.0], [1e-3, -2e-3], [0.0, 1e-3]]))
    monkeypatch.setattr(cuda, "card", lambda: CardOfC(tmp_path))
    size = width(slots) if slots else len(program.outputs) * len(columns)
    monkeypatch.setattr(cuda, "PART", 2 * max(size, values.shape[1]))  # two designs at once
    done: list[tuple[int, int]] = []
    out, code = cuda.run(program, slots, values, columns, common, lambda *of: done.append(of))
    assert done == [(2, 3), (3, 3)]
    r = k(values)
    found, expected = out, r.value(f"effort.{drive}")
    assert not r.redone
    assert (code.reshape(r.code.shape) == r.code).all()
    if reduce == "rms":
        found = np.sqrt(out / len(columns))
    assert np.abs(found.ravel() - expected.ravel()).max() < 1e-11 * np.abs(expected).max()


def test_cuda_without_a_card_is_refused() -> None:
    try:
        cuda.card()
    except RuntimeError:
        with pytest.raises(da.ModelError, match="device 'cuda' cannot be used"):
            da.compile(da.four_bar())(device="cuda")
    else:
        k = da.compile(da.four_bar())
        assert np.allclose(k(device="cuda").effort("O2"), k().effort("O2"), rtol=1e-11)


def test_c_function(tmp_path: Path) -> None:
    """An exported function computes cosines and expressions itself."""
    tree = four_bar(24)
    k = da.compile(tree, vary=VARY, outputs=OUTPUTS, derivatives=True)
    program = plain(k)
    given = [program.graph.names[n.index] for n in program.inputs_in_use("channel")]
    assert "position O2" in given
    assert not [name for name in given if name.startswith(("cos", "sin", "loads.P"))]
    library = shared(tmp_path, k.to_c("four_bar"), "alone")
    r, q = k(), k.trace.course.schedule.position[7, 0]
    channels = np.array(
        [float(k.trace.inputs.sources[n](k.trace.course)[7]) for n in program.inputs_in_use("channel")]
    )
    assert q in channels
    out = np.zeros(len(program.outputs))
    assert library.four_bar(pointer(k.nominal.copy()), pointer(channels), pointer(out)) == 0
    assert abs(out[0] - r.effort("O2")[0, 7]) < 1e-12 * abs(out[0])
    assert abs(out[4] / r.gradient("effort.O2")[0, 7, 0] - 1) < 1e-9


def test_casadi_function() -> None:
    pytest.importorskip("casadi")
    k = da.compile(four_bar(24), vary=VARY, outputs=["effort.O2", "reaction.A"])
    f, r = k.to_casadi(), k()
    program = plain(k)
    channels = [float(k.trace.inputs.sources[n](k.trace.course)[5]) for n in program.inputs_in_use("channel")]
    effort, reaction, mark = f(k.nominal, channels)
    assert abs(float(effort) - r.effort("O2")[0, 5]) < 1e-10
    assert np.abs(np.array(reaction).ravel() - r.reaction("A")[0, 5]).max() < 1e-9
    assert float(mark) == 0


def test_positions_that_do_not_fit_the_drives() -> None:
    k = da.compile(da.four_bar(), vary=["links.coupler.mass"])
    with pytest.raises(da.ModelError) as error:
        k([[1.0]], positions=[[1.0, 2.0, 3.0]])
    assert str(error.value) == "positions of shape (1, 3) do not fit 1 drive(s); give (position, drive)"
