"""A kernel's machine code: over a grid of designs and positions, over pairs of them, or reduced to one a design."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dalembert.analysis.batch import reduction
from dalembert.analysis.batch.course import Course
from dalembert.kernel import emit_llvm
from dalembert.kernel.batch import path_array, row_length, run_grid, run_pairs
from dalembert.kernel.emit_reduce import PLACED, SUMS, Slots, width
from dalembert.kernel.graph import Node
from dalembert.kernel.machine import Machine, aligned, compiled
from dalembert.kernel.program import Program

Array = NDArray[Any]
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
            return program, compiled(emit_llvm.grid(program, k.lanes), k.lanes), ()
        nodes, slots = self._reduced()
        program = k.program(nodes)
        return program, compiled(emit_llvm.grid(program, k.lanes, slots), k.lanes), slots

    def _pairs(self, program: Program) -> tuple[Program, Machine, Slots]:
        return program, compiled(emit_llvm.pairs(program, self.k.lanes), self.k.lanes), ()

    def _reduced(self) -> tuple[list[Node], Slots]:
        """Values to be reduced, outputs first, then what the gradients of means are made of."""
        k = self.k
        parts = reduction.located(k.reduce) if k.derivatives else reduction.PARTS[k.reduce]
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
        columns = [np.asarray(found[n](course), float) for n in program.used("channel")]
        common = np.array([float(found[n](course)) for n in program.used("common")])
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
            from dalembert.kernel import cuda

            out, code = cuda.run(program, slots, values, columns, common, progress)
        elif way == "pairs":
            out, code = self._run_all_pairs(values, program, machine, columns, common, threads, progress)
        else:
            out, code = self._run_grid(values, program, machine, slots, columns, common, threads, progress)
        if way == "reduce":
            return self._reduced_result(values, course, slots, out, code, len(columns), threads)
        return self.named(out, code)

    def _run_grid(
        self,
        values: Array,
        program: Program,
        machine: Machine,
        slots: Slots,
        columns: Array,
        common: Array,
        threads: int | None,
        progress: Any,
    ) -> tuple[Array, NDArray[np.uint8]]:
        """Results (design, output, position) or (design, slot), and codes."""
        weighted = any(p in SUMS for _, p in slots)
        path = path_array(columns, common, machine.lanes, weighted)
        count, row = len(values), row_length(path[1], machine.lanes)
        shape: tuple[int, ...] = (count, width(slots)) if slots else (count, len(program.outputs), row)
        out, code = aligned(shape), np.empty((count,) if slots else (count, row), np.uint8)
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
        progress: Any,
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

    def named(self, out: Array, code: NDArray[np.uint8]) -> Found:
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
        wanted = reduction.located(k.reduce) if k.derivatives else reduction.PARTS[k.reduce]
        for name, nodes in k.nodes.items():
            each = []
            for m in range(node, node + len(nodes)):
                source = places if k.reduce == "argpeak" else parts
                each.append(reduction.finished(k.reduce, [source[m, p] for p in wanted], count))
            found[name] = range(node, node + len(nodes))
            arrays[name] = each[0].copy() if len(nodes) == 1 else np.stack(each, axis=1)
            node += len(nodes)
        if not k.derivatives:
            return code, arrays, {}
        from dalembert.analysis.batch.slopes import slopes

        return code, arrays, slopes(self, values, course, found, parts, places, count, threads)
