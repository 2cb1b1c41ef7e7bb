"""A kernel's machine code: over a grid of designs and positions, over pairs of them, or reduced to one a design."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache, cached_property, partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dalembert.analysis.batch import over_positions
from dalembert.analysis.batch.tracing.course import PositionPath
from dalembert.analysis.batch.tracing.kernel_inputs import target_values
from dalembert.analysis.batch.tracing.traced_analysis import trace_analysis
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.kernel.emit import llvm_text
from dalembert.kernel.emit.machine_code import Machine, compile_module
from dalembert.kernel.emit.reductions import PLACED, SUMS, Slots, width
from dalembert.kernel.graph import CONSTANT, Node
from dalembert.kernel.memory import available, result_array
from dalembert.kernel.parallel_runs import (
    Progress,
    Store,
    path_array,
    row_length,
    run_designs,
    run_grid,
    run_pairs,
)
from dalembert.kernel.program import Program

Arrays = tuple[dict[str, Array], dict[str, Array]]
"""Outputs, and their gradients, by name."""
CHECKED = 1 << 27
"""Bytes of results above which free memory is checked."""
BY_BLOCKS = "go through k.blocks(values)"
TOO_MUCH = f"give out= (arrays on disk by np.memmap), or {BY_BLOCKS}"
"""Remedy for results that do not fit."""
FEW = 16
"""Positions below which the lanes are filled with pairs of a design and a position."""


class Job(NamedTuple):
    """One call: values (design, number), the motion they are taken along, and the arrays that outputs and gradients go
    into where they are given."""

    values: Array
    course: PositionPath
    threads: int | None
    progress: Progress | None
    into: Arrays | None


class Runner:
    """Programs and machines of one kernel."""

    def __init__(self, kernel: Any) -> None:
        self.k = kernel
        self.machine = cache(self._machine)
        self.known: dict[int, tuple[PositionPath, Array, Array]] = {}
        self.path: tuple[Array, Machine, tuple[Array, int]] | None = None
        self.places = self._places()

    def _machine(self, kind: str) -> tuple[Program, Machine, Slots]:
        """Program and machine code of one mode of running it."""
        k = self.k
        if kind == "gradient":  # derivatives alone, at chosen positions
            rates = [n for components in k.rates.values() for row in components for n in row]
            return self.pairs(k.program([*(n for nodes in k.nodes.values() for n in nodes), *rates]))
        if kind == "pairs":
            return self.pairs(k.program(k.flat))
        if kind in ("grid", "past cache"):
            program = k.program(k.flat) if kind == "grid" else self.machine("grid")[0]
            text = llvm_text.grid(program, k.lanes, past_cache=kind != "grid")
            return program, compile_module(text, k.lanes), ()
        nodes, slots = self._reduction_values()
        program = k.program(nodes)
        return program, compile_module(llvm_text.grid(program, k.lanes, slots), k.lanes), slots

    def pairs(self, program: Program) -> tuple[Program, Machine, Slots]:
        return program, compile_module(llvm_text.pairs(program, self.k.lanes), self.k.lanes), ()

    def _reduction_values(self) -> tuple[list[Node], Slots]:
        """Values to be reduced, outputs first, then what the gradients of means are made of."""
        k = self.k
        parts = over_positions.with_places(k.reduce) if k.derivatives else over_positions.PARTS[k.reduce]
        nodes = [n for components in k.nodes.values() for n in components]
        if k.reduce == "squares":
            nodes = [n - self._target(name, j) for name, of in k.nodes.items() for j, n in enumerate(of)]
        slots = [(m, p) for m in range(len(nodes)) for p in parts]
        if k.derivatives and k.reduce in over_positions.SUMS:
            power = over_positions.SUMS[k.reduce] - 1
            rates = [row for components in k.rates.values() for row in components]
            for value, row in zip(list(nodes), rates, strict=True):
                weight = value**power if power else 1.0
                nodes += [weight * rate for rate in row]
            slots += [(m, "sum") for m in range(len(rates), len(nodes))]
        return nodes, tuple(slots)

    def _target(self, name: str, component: int) -> Node:
        """Value that one component of an output is compared with."""
        value = partial(target_values, output=name, component=component)
        node: Node = self.k.trace.inputs.make("channel", f"target {component} {name}", value)
        return node

    @cached_property
    def sided(self) -> Any:
        """The kernel with the side of reversals as an input."""
        k = self.k
        trace = trace_analysis(k.mechanism, k.numbers, k.trace.inertia, sided=True, redundant=True)
        return replace(k, trace=trace, reduce=None)

    @cached_property
    def unreduced(self) -> Any:
        """The kernel that keeps all positions."""
        return replace(self.k, reduce=None)

    def method(self, positions: int) -> str:
        if self.k.reduce is not None:
            return "reduce"
        return "pairs" if positions < FEW and self.k.lanes > 1 else "grid"

    def prepare(self, positions: int) -> None:
        self.machine(self.method(positions))

    def inputs(self, program: Program, course: PositionPath) -> tuple[Array, Array]:
        """Channels (position, channel) and common inputs that a program uses; those of its last call are kept."""
        known = self.known.get(id(program))
        if known is None or known[0] is not course:
            self.known[id(program)] = known = course, *self._inputs(program, course)
        return known[1], known[2]

    def _inputs(self, program: Program, course: PositionPath) -> tuple[Array, Array]:
        sources = self.k.trace.inputs.sources
        columns = [np.asarray(sources[n](course), float) for n in program.inputs_in_use("channel")]
        common = np.array([float(sources[n](course)) for n in program.inputs_in_use("common")])
        count = len(course.schedule.position)
        return np.stack(columns, axis=1) if columns else np.zeros((count, 0)), common

    def __call__(
        self, device: str, *call: Any
    ) -> tuple[NDArray[np.uint8], dict[str, Array], dict[str, Array]]:
        """Codes, arrays by output, gradients by output, of what makes a ``Job``."""
        job = Job(*call)
        few = "grid" if device == "cuda" else self.method(len(job.course.schedule.position))
        method = "reduce" if self.k.reduce else few
        program, machine, slots = self.machine(method)
        columns, common = self.inputs(program, job.course)
        out: Array | None
        if device == "cuda":
            from dalembert.kernel.emit import cuda

            out, code = cuda.run(program, slots, job.values, columns, common, job.progress)
        elif method == "pairs":
            out, code = self._run_all_pairs(job, program, machine, columns, common)
        else:
            out, code = self._run_grid(job, program, machine, slots, columns, common)
        if out is None:
            assert job.into is not None
            return code, *job.into
        results = self._reduced_result(job, slots, out, len(columns)) if slots else self.by_output(out)
        if job.into is None:
            return code, *results
        self._store(job, slice(None), results)
        return code, *job.into

    def _store(self, job: Job, which: slice, results: Arrays) -> None:
        """Put results of some designs where they go."""
        assert job.into is not None
        for parts, wholes in zip(results, job.into, strict=True):
            for name, part in parts.items():
                for of in np.ndindex(part.shape[2:]):  # components stand side by side there, not here
                    wholes[name][(which, slice(None), *of)[: part.ndim]] = part[(..., *of)]

    def _run_grid(
        self, job: Job, program: Program, machine: Machine, slots: Slots, columns: Array, common: Array
    ) -> tuple[Array | None, NDArray[np.uint8]]:
        """Results (design, output, position) or (design, slot), none where they are stored already, and codes."""
        weighted = bool(slots) and any(p in SUMS for _, p in slots)
        kept, positions = self.path, len(columns)
        if kept is None or kept[0] is not columns or kept[1] is not machine:
            self.path = kept = columns, machine, path_array(columns, common, machine.lanes, weighted)
        path = kept[2]
        row, channels = row_length(path[1], machine.lanes), columns.shape[1] + weighted
        shape: tuple[int, ...] = (width(slots),) if slots else (len(program.outputs), row)
        code = np.empty((len(job.values),) if slots else (len(job.values), row), np.uint8)
        into: Array | tuple[tuple[int, ...], Store]
        if job.into is None or slots:
            into, again = result_array((_room(job, shape), *shape))
            out = into if slots else into[:, :, :positions]
            machine = self.machine("past cache")[1] if again and not slots else machine
        else:
            out = None
            into = (
                shape,
                lambda which, results: self._store(job, which, self.by_output(results[..., :positions])),
            )
        run_grid(machine, job.values, path, channels, into, code, job.threads, job.progress)
        return out, code if slots else code[:, :positions]

    def _run_all_pairs(
        self, job: Job, program: Program, machine: Machine, columns: Array, common: Array
    ) -> tuple[Array | None, NDArray[np.uint8]]:
        """Every design at every position; where the results go elsewhere, a part of the designs at a time."""
        designs, count, width = len(job.values), len(columns), len(program.outputs)
        if job.into is None:
            _room(job, (width, count))
            return run_designs(machine, job.values, columns, common, width, job.threads, job.progress)
        code, step = np.empty((designs, count), np.uint8), max(1, 100_000 // count)
        for k in range(0, designs, step):
            which = slice(k, min(k + step, designs))
            results, code[which] = run_designs(
                machine, job.values[which], columns, common, width, job.threads
            )
            self._store(job, which, self.by_output(results))
            if job.progress is not None:
                job.progress(which.stop, designs)
        return None, code

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
        run_pairs(machine, values, columns, common, out, code, threads)
        return out, code

    def _places(self) -> tuple[list[tuple[str, int | slice]], list[tuple[str, slice, tuple[int, ...]]]]:
        """Place of each output, and of its derivatives with their axes."""
        arrays: list[tuple[str, int | slice]] = []
        rates: list[tuple[str, slice, tuple[int, ...]]] = []
        place, n = 0, len(self.k.trace.numbers)
        for name, nodes in self.k.nodes.items():
            arrays.append((name, place if len(nodes) == 1 else slice(place, place + len(nodes))))
            place += len(nodes)
        for name, nodes in self.k.nodes.items() if self.k.derivatives else ():
            axes = (n,) if len(nodes) == 1 else (len(nodes), n)
            rates.append((name, slice(place, place + len(nodes) * n), axes))
            place += len(nodes) * n
        return arrays, rates

    def by_output(self, out: Array) -> Arrays:
        """Results (design, output, position) by output: (design, position[, component]), and gradients behind them."""
        arrays, rates = {}, {}
        for name, place in self.places[0]:
            part = out[:, place]
            arrays[name] = part.swapaxes(1, 2) if part.ndim > 2 else part
        for name, places, axes in self.places[1]:
            part = out[:, places].swapaxes(1, 2)
            rates[name] = part.reshape((*part.shape[:-1], *axes))
        return arrays, rates

    def _reduced_result(self, job: Job, slots: Slots, out: Array, count: int) -> Arrays:
        """Arrays by output: (design[, component][, side]) and gradients, from the parts of the reductions."""
        k = self.k
        parts: dict[tuple[int, str], Array] = {}
        places: dict[tuple[int, str], Array] = {}
        slot = 0
        for key in slots:
            parts[key] = out[:, slot]
            if key[1] in PLACED:
                places[key] = out[:, slot + 1]
            slot += 2 if key[1] in PLACED else 1
        if k.reduce in over_positions.REFINED:
            return self._refined(job, places)
        nodes_by_name, arrays, node = {}, {}, 0
        wanted = over_positions.with_places(k.reduce) if k.derivatives else over_positions.PARTS[k.reduce]
        for name, nodes in k.nodes.items():
            each = []
            for m in range(node, node + len(nodes)):
                source = places if k.reduce == "argpeak" else parts
                each.append(over_positions.finish_reduction(k.reduce, [source[m, p] for p in wanted], count))
            nodes_by_name[name] = range(node, node + len(nodes))
            arrays[name] = each[0].copy() if len(nodes) == 1 else np.stack(each, axis=1)
            node += len(nodes)
        if not k.derivatives:
            return arrays, {}
        return arrays, slopes(self, job, nodes_by_name, parts, places, count)

    def _refined(self, job: Job, places: dict[tuple[int, str], Array]) -> Arrays:
        """Peaks between the positions and their places, and gradients: each from three positions."""
        k, arrays, slopes_, first = self.k, {}, {}, 0
        program, machine, _ = self.machine("gradient" if k.derivatives else "pairs")
        columns, common = self.inputs(program, job.course)
        flat, n, cycle = sum(len(of) for of in k.nodes.values()), len(k.trace.numbers), job.course.cycle
        for name, nodes in k.nodes.items():
            each, rates = [], []
            for m in range(first, first + len(nodes)):
                place = places[m, "argpeak"]
                place = np.where(np.isfinite(place) & (place < len(columns)), place, 0).astype(int)
                three, inner = over_positions.neighbours(place, len(columns), cycle)
                out = np.stack(
                    [
                        self.at_pairs(program, machine, job.values, columns[at], common, job.threads)[0]
                        for at in three
                    ]
                )
                each.append(over_positions.refine(k.reduce, place, out[..., m], inner, len(columns)))
                if k.derivatives:
                    mine = out[..., flat + m * n : flat + (m + 1) * n]
                    rates.append(over_positions.refined_slope(k.reduce, out[..., m], mine, inner))
            first += len(nodes)
            arrays[name] = each[0] if len(each) == 1 else np.stack(each, axis=1)
            if k.derivatives:
                slopes_[name] = rates[0] if len(rates) == 1 else np.stack(rates, axis=1)
        return arrays, slopes_


def _room(job: Job, each: tuple[int, ...]) -> int:
    """The number of designs; raises ModelError where their results, of some numbers each, do not go into memory."""
    size, free = len(job.values) * (8 * math.prod(each) + each[-1]), math.inf
    if size > CHECKED:
        free = available()
    if size > free:
        raise ModelError(
            f"results of {len(job.values):,} designs take {size / 1e9:.3g} GB, and {free / 1e9:.3g} GB are free",
            TOO_MUCH if len(each) > 1 else BY_BLOCKS,  # what is reduced passes through memory whole
        )
    return len(job.values)


def slopes(
    runner: Runner,
    job: Job,
    ranges: dict[str, range],
    parts: dict[tuple[int, str], Array],
    places: dict[tuple[int, str], Array],
    count: int,
) -> dict[str, Array]:
    """Gradients (design[, component][, side of the envelope], number) of every reduced output."""
    k, out = runner.k, {}
    nodes_of = [n for nodes in k.nodes.values() for n in nodes]
    flat = len(nodes_of)
    for name, nodes in ranges.items():
        each = []
        for m in nodes:
            if k.reduce in ("peak", "envelope"):
                each.append(_active(runner, job, m, places))
            elif nodes_of[m].level == CONSTANT:
                each.append(np.zeros((len(job.values), len(k.trace.numbers))))
            else:
                first = flat + m * len(k.trace.numbers)
                total = np.stack([parts[first + n, "sum"] for n in range(len(k.trace.numbers))], axis=-1)
                each.append(_of_sums(k.reduce, parts, m, total, count))
        out[name] = each[0] if len(each) == 1 else np.stack(each, axis=1)
    return out


def _of_sums(reduce: str, parts: dict[tuple[int, str], Array], m: int, total: Array, count: int) -> Array:
    """Gradient of one component from the sum of its derivatives, each times a power of the value."""
    if reduce == "squares":
        return 2 * total
    total = total / count
    if reduce == "mean":
        return total
    part = over_positions.PARTS[reduce][0]
    size = over_positions.finish_reduction(reduce, [parts[m, part]], count)[:, None]
    with np.errstate(all="ignore"):
        return np.asarray(total / size ** (over_positions.POWER[reduce] - 1))


def _active(runner: Runner, job: Job, m: int, places: dict[tuple[int, str], Array]) -> Array:
    """Gradient of one component at the positions of its reduction."""
    k = runner.k
    program, machine, _ = runner.machine("gradient")
    columns, common = runner.inputs(program, job.course)
    flat, n = sum(len(nodes) for nodes in k.nodes.values()), len(k.trace.numbers)
    sides = []
    for part in over_positions.with_places(k.reduce):
        place = places[m, part]
        place = np.where(np.isfinite(place) & (place < len(columns)), place, 0).astype(int)
        out, _ = runner.at_pairs(program, machine, job.values, columns[place], common, job.threads)
        rate = out[:, flat + m * n : flat + (m + 1) * n]
        sides.append(np.sign(out[:, m])[:, None] * rate if part == "argpeak" else rate)
    return sides[0] if k.reduce == "peak" else np.stack(sides, axis=1)
