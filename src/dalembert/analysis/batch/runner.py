"""A kernel's machine code: over a grid of designs and positions, over pairs of them, or reduced to one a design."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dalembert.analysis.batch import over_positions
from dalembert.analysis.batch.kernel_inputs import Course
from dalembert.arrays import Array
from dalembert.kernel.emit import llvm_text
from dalembert.kernel.emit.machine_code import Machine, aligned_array, compile_module
from dalembert.kernel.emit.reductions import PLACED, SUMS, Slots, width
from dalembert.kernel.graph import CONSTANT, Node
from dalembert.kernel.parallel_runs import path_array, row_length, run_grid, run_pairs
from dalembert.kernel.program import Program

Found = tuple[NDArray[np.uint8], dict[str, Array], dict[str, Array]]
FEW = 16
"""Positions below which the lanes are filled with pairs of a design and a position."""


class Runner:
    """Programs and machines of one kernel."""

    def __init__(self, kernel: Any) -> None:
        self.k = kernel
        self.machine = cache(self._machine)
        self.last: tuple[Program, Course, Array, Array] | None = None

    def _machine(self, kind: str) -> tuple[Program, Machine, Slots]:
        """Program and machine code of one way to run it."""
        k = self.k
        if kind == "gradient":  # derivatives alone, at chosen positions
            rates = [n for found in k.rates.values() for row in found for n in row]
            return self._pairs(k.program([*(n for nodes in k.nodes.values() for n in nodes), *rates]))
        if kind == "pairs":
            return self._pairs(k.program(k.flat))
        if kind == "grid":
            program = k.program(k.flat)
            return program, compile_module(llvm_text.grid(program, k.lanes), k.lanes), ()
        nodes, slots = self._reduction_values()
        program = k.program(nodes)
        return program, compile_module(llvm_text.grid(program, k.lanes, slots), k.lanes), slots

    def _pairs(self, program: Program) -> tuple[Program, Machine, Slots]:
        return program, compile_module(llvm_text.pairs(program, self.k.lanes), self.k.lanes), ()

    def _reduction_values(self) -> tuple[list[Node], Slots]:
        """Values to be reduced, outputs first, then what the gradients of means are made of."""
        k = self.k
        parts = over_positions.with_places(k.reduce) if k.derivatives else over_positions.PARTS[k.reduce]
        nodes = [n for found in k.nodes.values() for n in found]
        slots = [(m, p) for m in range(len(nodes)) for p in parts]
        if k.derivatives and k.reduce in ("mean", "rms", "norm8"):
            power = {"mean": 0, "rms": 1, "norm8": 7}[k.reduce]
            rates = [row for found in k.rates.values() for row in found]
            for value, row in zip(list(nodes), rates, strict=True):
                weight = value**power if power else 1.0
                nodes += [weight * rate for rate in row]
            slots += [(m, "sum") for m in range(len(rates), len(nodes))]
        return nodes, tuple(slots)

    def way(self, positions: int) -> str:
        if self.k.reduce is not None:
            return "reduce"
        return "pairs" if positions < FEW and self.k.lanes > 1 else "grid"

    def prepare(self, positions: int) -> None:
        self.machine(self.way(positions))

    def inputs(self, program: Program, course: Course) -> tuple[Array, Array]:
        """Channels (position, channel) and common inputs that a program uses; those of the last call are kept."""
        last = self.last
        if last is None or last[0] is not program or last[1] is not course:
            self.last = last = program, course, *self._inputs(program, course)
        return last[2], last[3]

    def _inputs(self, program: Program, course: Course) -> tuple[Array, Array]:
        found = self.k.trace.inputs.found
        columns = [np.asarray(found[n](course), float) for n in program.inputs_in_use("channel")]
        common = np.array([float(found[n](course)) for n in program.inputs_in_use("common")])
        count = len(course.schedule.position)
        return np.stack(columns, axis=1) if columns else np.zeros((count, 0)), common

    def __call__(
        self,
        values: Array,
        course: Course,
        threads: int | None,
        progress: Callable[[int, int], object] | None,
        device: str = "cpu",
    ) -> Found:
        """Codes, arrays by output, gradients by output."""
        few = "grid" if device == "cuda" else self.way(len(course.schedule.position))
        way = "reduce" if self.k.reduce else few
        program, machine, slots = self.machine(way)
        columns, common = self.inputs(program, course)
        if device == "cuda":
            from dalembert.kernel.emit import cuda

            out, code = cuda.run(program, slots, values, columns, common, progress)
        elif way == "pairs":
            out, code = self._run_all_pairs(values, program, machine, columns, common, threads, progress)
        else:
            out, code = self._run_grid(values, program, machine, slots, columns, common, threads, progress)
        if way == "reduce":
            return self._reduced_result(values, course, slots, out, code, len(columns), threads)
        return self.by_output(out, code)

    def _run_grid(
        self,
        values: Array,
        program: Program,
        machine: Machine,
        slots: Slots,
        columns: Array,
        common: Array,
        threads: int | None,
        progress: Callable[[int, int], object] | None,
    ) -> tuple[Array, NDArray[np.uint8]]:
        """Results (design, output, position) or (design, slot), and codes."""
        weighted = any(p in SUMS for _, p in slots)
        path = path_array(columns, common, machine.lanes, weighted)
        count, row = len(values), row_length(path[1], machine.lanes)
        shape: tuple[int, ...] = (count, width(slots)) if slots else (count, len(program.outputs), row)
        out, code = aligned_array(shape), np.empty((count,) if slots else (count, row), np.uint8)
        channels = columns.shape[1] + weighted
        run_grid(machine, program, values, path, channels, out, code, threads, progress)
        if slots:
            return out, code
        return out[:, :, : len(columns)], code[:, : len(columns)]

    def _run_all_pairs(
        self,
        values: Array,
        program: Program,
        machine: Machine,
        columns: Array,
        common: Array,
        threads: int | None,
        progress: Callable[[int, int], object] | None,
    ) -> tuple[Array, NDArray[np.uint8]]:
        """Every design at every position, a part of the designs at a time."""
        designs, count = len(values), len(columns)
        out = np.empty((designs, len(program.outputs), count))
        code = np.empty((designs, count), np.uint8)
        step = max(1, 100_000 // count)
        for k in range(0, designs, step):
            mine = values[k : k + step]
            found, marks = self.at_pairs(
                program,
                machine,
                np.repeat(mine, count, axis=0),
                np.tile(columns, (len(mine), 1)),
                common,
                threads,
            )
            out[k : k + step] = found.reshape(len(mine), count, -1).swapaxes(1, 2)
            code[k : k + step] = marks.reshape(len(mine), count)
            if progress is not None:
                progress(k + len(mine), designs)
        return out, code

    def at_pairs(
        self,
        program: Program,
        machine: Machine,
        values: Array,
        columns: Array,
        common: Array,
        threads: int | None,
    ) -> tuple[Array, NDArray[np.uint8]]:
        """Outputs (pair, output) and codes of pairs."""
        out, code = np.empty((len(values), len(program.outputs))), np.empty(len(values), np.uint8)
        run_pairs(machine, program, values, columns, common, out, code, threads)
        return out, code

    def by_output(self, out: Array, code: NDArray[np.uint8]) -> Found:
        """Arrays by output: (design, position[, component]) and gradients behind them."""
        k, arrays, rates, place = self.k, {}, {}, 0
        for name, nodes in k.nodes.items():
            part = np.moveaxis(out[:, place : place + len(nodes)], 1, -1)
            arrays[name] = part[..., 0] if len(nodes) == 1 else part
            place += len(nodes)
        if k.derivatives:
            n = len(k.trace.numbers)
            for name, nodes in k.nodes.items():
                part = np.moveaxis(out[:, place : place + len(nodes) * n], 1, -1)
                part = part.reshape((*part.shape[:-1], len(nodes), n))
                rates[name] = part[..., 0, :] if len(nodes) == 1 else part
                place += len(nodes) * n
        return code, arrays, rates

    def _reduced_result(
        self,
        values: Array,
        course: Course,
        slots: Slots,
        out: Array,
        code: NDArray[np.uint8],
        count: int,
        threads: int | None,
    ) -> Found:
        """Arrays by output: (design[, component][, side]) and gradients, from the parts of the reductions."""
        k = self.k
        parts, places, slot = {}, {}, 0
        for key in slots:
            parts[key] = out[:, slot]
            if key[1] in PLACED:
                places[key] = out[:, slot + 1]
            slot += 2 if key[1] in PLACED else 1
        found, arrays, node = {}, {}, 0
        wanted = over_positions.with_places(k.reduce) if k.derivatives else over_positions.PARTS[k.reduce]
        for name, nodes in k.nodes.items():
            each = []
            for m in range(node, node + len(nodes)):
                source = places if k.reduce == "argpeak" else parts
                each.append(over_positions.finish_reduction(k.reduce, [source[m, p] for p in wanted], count))
            found[name] = range(node, node + len(nodes))
            arrays[name] = each[0].copy() if len(nodes) == 1 else np.stack(each, axis=1)
            node += len(nodes)
        if not k.derivatives:
            return code, arrays, {}
        return code, arrays, slopes(self, values, course, found, parts, places, count, threads)


def slopes(
    runner: Runner,
    values: Array,
    course: Course,
    found: dict[str, range],
    parts: dict[tuple[int, str], Array],
    places: dict[tuple[int, str], Array],
    count: int,
    threads: int | None,
) -> dict[str, Array]:
    """Gradients (design[, component][, side of the envelope], number) of every reduced output."""
    k, out = runner.k, {}
    nodes_of = [n for nodes in k.nodes.values() for n in nodes]
    flat = len(nodes_of)
    for name, nodes in found.items():
        each = []
        for m in nodes:
            if k.reduce in ("peak", "envelope"):
                each.append(_active(runner, values, course, m, places, threads))
            elif nodes_of[m].level == CONSTANT:
                each.append(np.zeros((len(values), len(k.trace.numbers))))
            else:
                first = flat + m * len(k.trace.numbers)
                total = np.stack([parts[first + n, "sum"] for n in range(len(k.trace.numbers))], axis=-1)
                each.append(_mean(k.reduce, parts, m, total / count, count))
        out[name] = each[0] if len(each) == 1 else np.stack(each, axis=1)
    return out


def _mean(reduce: str, parts: dict[tuple[int, str], Array], m: int, total: Array, count: int) -> Array:
    if reduce == "mean":
        return total
    part = over_positions.PARTS[reduce][0]
    size = over_positions.finish_reduction(reduce, [parts[m, part]], count)[:, None]
    with np.errstate(all="ignore"):
        return np.asarray(total / size if reduce == "rms" else total / size**7)


def _active(
    runner: Runner,
    values: Array,
    course: Course,
    m: int,
    places: dict[tuple[int, str], Array],
    threads: int | None,
) -> Array:
    """Gradient of one component at the positions where its reduction stands."""
    k = runner.k
    program, machine, _ = runner.machine("gradient")
    columns, common = runner.inputs(program, course)
    flat, n = sum(len(nodes) for nodes in k.nodes.values()), len(k.trace.numbers)
    sides = []
    for part in over_positions.with_places(k.reduce):
        place = places[m, part]
        place = np.where(np.isfinite(place) & (place < len(columns)), place, 0).astype(int)
        out, _ = runner.at_pairs(program, machine, values, columns[place], common, threads)
        rate = out[:, flat + m * n : flat + (m + 1) * n]
        sides.append(np.sign(out[:, m])[:, None] * rate if part == "argpeak" else rate)
    return sides[0] if k.reduce == "peak" else np.stack(sides, axis=1)
