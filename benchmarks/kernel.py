"""Compiled analyses: nanoseconds a position against a kernel written by hand, chains, groups, gradients, studies.

Method. One thread unless said; every figure is the median of many calls of the machine code on data in the cache; the
hand-written rival (hand.c, the textbook's formulas with vector types, compiled by the system's C compiler) runs in
turns with it in the same process, and its answers are compared first. Compiling is timed after imports, whole:
following the file's motion, tracing, machine code.

    python benchmarks/kernel.py [--designs 1000000]
"""

from __future__ import annotations

import argparse
import ctypes
import resource
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import Any

import numpy as np
from benchmarks.linkages import FOUR_BAR, chain, four_bar
from tests.kernel.machines import block_in_a_yoke, block_on_a_crank, eight_bar

import dalembert as da
from dalembert.kernel.emit.machine_code import compile_module, host_lanes, to_blocks
from dalembert.kernel.emit.reductions import width
from dalembert.kernel.memory import aligned_array
from dalembert.kernel.parallel_runs import path_array, row_length

CACHE = 5e5
"""Bytes of results of one timed call: what the second cache holds, and long against the call itself."""


def runs(k: Any, way: str = "grid") -> tuple[Callable[[], None], int]:
    """A call of the machine code on designs whose results fit the cache, and how many positions it does."""
    program, machine, slots = k.runner.machine(way)
    columns, common = k.runner.inputs(program, k.trace.course)
    weighted = any(p in ("sum", "square", "power8") for _, p in slots)
    data, blocks = path_array(columns, common, machine.lanes, weighted)
    row = width(slots) if slots else len(program.outputs) * row_length(blocks, machine.lanes)
    designs = 64 if slots else max(1, int(CACHE / (8 * row)))
    values = np.ascontiguousarray(np.repeat(k.nominal[None], designs, axis=0))
    out, code = (
        aligned_array((designs * row,)),
        np.empty(designs * row_length(blocks, machine.lanes), np.uint8),
    )
    counts = (values.shape[1], columns.shape[1] + weighted, designs, blocks)
    addresses = [a.ctypes.data for a in (values, data, out, code)]

    def call(held: tuple[Any, ...] = (values, data, out, code)) -> None:
        machine.function(*addresses, *counts)

    return call, designs * len(columns)


def timed(*calls: Callable[[], object], repeat: int = 200) -> list[float]:
    """Median seconds of each call, in turns; each once before it is timed, so that it finds its data in the cache."""
    times: list[list[float]] = [[] for _ in calls]
    for _ in range(repeat):
        for call, found in zip(calls, times, strict=True):
            call()
            start = perf_counter()
            call()
            found.append(perf_counter() - start)
    return [median(t) for t in times]


def nanoseconds(k: Any, way: str = "grid") -> float:
    call, count = runs(k, way)
    return timed(call)[0] / count * 1e9


def by_hand(k: Any, folder: str) -> Callable[[], None] | None:
    """hand.c compiled and checked against the kernel's own answer; a call on as many positions."""
    compiler = shutil.which("gcc") or shutil.which("cc")
    if compiler is None:
        return None
    source, library, lanes = Path(__file__).with_name("hand.c"), Path(folder) / "hand.so", host_lanes()
    options = ["-O3", "-march=native", "-ffast-math", "-shared", "-fPIC", f"-DLANES={lanes}"]
    subprocess.run([compiler, *options, "-o", str(library), str(source)], check=True)
    hand = ctypes.CDLL(str(library)).hand
    q = k.trace.course.schedule.position[:, 0]
    path = to_blocks(np.stack([np.cos(q), np.sin(q)], axis=1), lanes)
    designs = runs(k)[1] // len(q)
    values = np.ascontiguousarray(np.repeat(k.nominal[None], designs, axis=0))
    out = aligned_array((designs, 9, len(q)))
    arguments = [ctypes.c_void_p(a.ctypes.data) for a in (values, path, out)]
    counts = [ctypes.c_long(designs), ctypes.c_long(len(q) // lanes)]

    def call(held: tuple[Any, ...] = (values, path, out)) -> None:
        hand(*arguments, *counts)

    call()
    r = k()
    for row, expected in ((0, r.effort("O2")), (3, r.reaction("A")[..., 0]), (6, r.reaction("B")[..., 1])):
        assert np.abs(out[0, row] - expected[0]).max() < 1e-10 * np.abs(expected).max()
    return call


def compiling(m: Any, vary: list[str], repeat: int = 5) -> float:
    def anew() -> None:
        compile_module.cache_clear()
        da.compile(m, vary=vary)

    return timed(anew, repeat=repeat)[0]


def four_bars() -> None:
    m = four_bar()
    k = da.compile(m, vary=list(FOUR_BAR))
    call, count = runs(k)
    with tempfile.TemporaryDirectory() as folder:
        hand = by_hand(k, folder)
        mine, other = timed(call, hand or (lambda: None), repeat=400)
        print(
            f"four-bar, 9 outputs, 24 numbers varied, {k.program(k.flat).size} operations, {k.lanes} lanes:"
        )
        mine, other = mine / count * 1e9, other / count * 1e9
        print(f"    {mine:6.2f} ns a position; by hand in C {other:.2f}; ratio {mine / other:.2f}")
    torque = da.compile(m, vary=list(FOUR_BAR), outputs=["effort.O2"])
    slopes = da.compile(m, vary=list(FOUR_BAR), outputs=["effort.O2"], derivatives=True)
    peak = da.compile(m, vary=list(FOUR_BAR), outputs=["effort.O2", "reaction.A.magnitude"], reduce="peak")
    one, all_ = nanoseconds(torque), nanoseconds(slopes)
    print(f"    torque alone {one:.2f} ns, with its 24 derivatives {all_:.2f} ns: {all_ / one:.2f} times")
    print(f"    peaks of torque and of one reaction {nanoseconds(peak, 'reduce'):.2f} ns a position")
    print(f"    compile {compiling(m, list(FOUR_BAR)) * 1e3:.0f} ms")


def calls(designs: int = 1400) -> None:
    """Whole calls, with everything around the machine code, on one thread: one design, and more than a cache holds."""
    k = da.compile(da.four_bar(), vary=["links.coupler.mass", "links.crank.points.A"])
    print(f"calls: one design at 72 positions {timed(lambda: k(threads=1), repeat=2000)[0] * 1e6:.0f} us")
    for outputs in (None, ["effort.O2"]):
        k = da.compile(four_bar(), vary=list(FOUR_BAR), outputs=outputs)
        values = np.repeat(k.nominal[None], designs, axis=0)
        out = {name: np.array(array) for name, array in k(values).arrays.items()}
        ways = (lambda k=k, v=values: k(v, threads=1), lambda k=k, v=values, o=out: k(v, threads=1, out=o))
        call, given = (t / designs / 720 * 1e9 for t in timed(*ways, repeat=20))
        print(
            f"    {designs} designs, {len(k.flat)} output(s): {call:.2f} ns a position; by out= {given:.2f}"
        )


def chains() -> None:
    print("chains of a crank and two-link groups, every reaction and the torque:")
    for groups in (1, 2, 3, 5, 9):
        m = chain(groups)
        vary = [f"links.rod{i}.mass" for i in range(groups)] + ["drives.O.speed", "drives.O.acceleration"]
        k = da.compile(m, vary=vary)
        torque = da.compile(m, vary=vary, outputs=["effort.O"])
        seconds = compiling(m, vary, repeat=3)
        print(
            f"    {2 * groups + 2:3d} links {k.program(k.flat).size:5d} operations {nanoseconds(k):6.1f} ns "
            f"({len(k.flat)} outputs), torque alone {nanoseconds(torque):6.1f} ns, compile {seconds * 1e3:.0f} ms"
        )


def groups() -> None:
    print("groups (efforts and reactions; difference from the general executor over the largest force):")
    kinds: dict[str, Any] = {
        "pin-pin-pin": da.four_bar,
        "pin-pin-slider": da.slider_crank,
        "pin-slider-pin": da.inverted_slider_crank,
        "pin-slider-slider": block_in_a_yoke,
        "slider-pin-slider": block_on_a_crank,
        "Scotch yoke, a slot": da.scotch_yoke,
        "Whitworth": da.whitworth,
        "Stephenson III": da.stephenson_3,
        "no closed form: Stephenson II": da.stephenson_2,
        "no closed form: three loops": eight_bar,
    }
    for name, make in kinds.items():
        m = make(positions=720)
        k, g = da.compile(m), da.dynamics(m)
        r = k()
        off = (
            max(np.abs(r.reaction(j)[0] - g.reaction(j)).max() for j in g.joints)
            / np.abs(g.force_array).max()
        )
        print(
            f"    {name:32s} {k.program(k.flat).size:5d} operations {nanoseconds(k):6.1f} ns, difference {off:.0e}"
        )


def study(designs: int) -> None:
    """Peaks of many four-bars over 360 positions."""
    m = four_bar(360)
    vary = ["links.coupler.mass", "links.coupler.points.B.0", "links.rocker.points.B.0"]
    k = da.compile(m, vary=vary, outputs=["reaction.A.magnitude", "effort.O2"], reduce="peak")
    rng = np.random.default_rng(1)
    values = k.nominal * (1 + 0.02 * rng.uniform(-1, 1, (designs, 3)))
    k(values[:1000])
    print(f"{designs:,} four-bar designs x 360 positions to peak reaction and peak torque:")
    found = {}
    for threads in (1, 2):
        start = perf_counter()
        r = k(values, threads=threads)
        found[threads] = perf_counter() - start
        closed = f"{r.ok.mean():.1%} ok, {r.redone} by the general executor"
        print(f"    {threads} thread(s): {found[threads]:.2f} s, {closed}")
    print(f"    two threads are {found[1] / found[2]:.2f} times as fast")
    print(
        f"    largest memory of the process {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MiB"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--designs", type=int, default=1_000_000)
    designs = parser.parse_args().designs
    four_bars()
    calls()
    chains()
    groups()
    study(designs)


if __name__ == "__main__":
    main()
