"""Engines for a block of designs: the compiled kernel, or where it does not apply the analyses, one by one."""

from __future__ import annotations

import hashlib
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from dalembert.analysis.batch.batch_result import CODES, NUMBERED, among, first_mark
from dalembert.analysis.batch.compiled_kernel import Kernel
from dalembert.analysis.batch.compiled_kernel import compile as compile_kernel
from dalembert.analysis.batch.over_positions import REFINED, is_cycle, reduce_sides
from dalembert.analysis.batch.tracing.course import in_mode_of
from dalembert.analysis.result.named_quantities import cycle_functions, quantity
from dalembert.analysis.result.result import Result
from dalembert.analysis.solution import solve
from dalembert.arrays import Array
from dalembert.errors import DalembertError, ModelError, errors_at
from dalembert.model import Mechanism
from dalembert.model.quantities.expression_trees import Tree, evaluate, names_in
from dalembert.optimization.cycle_expressions import cycle_tree, has_reductions, is_single

ONE_AT_A_TIME = threading.Lock()
"""The general executor keeps programs with their memory: one thread at a time."""
BLOCK_WORK = 3_000_000_000
"""Scalar operations that take a core about a tenth of a second."""
PROBED = 64
"""Number of designs whose bits are compared to decide whether two programs are the same."""
UNSURE = (CODES.index("undecided"), CODES.index("at_rest"))
"""Marks of designs that the kernel leaves to the general executor."""
Block = dict[str, Array]
"""Arrays of a block by output, its designs first, and ``status``, the codes of `batch_result.CODES`."""


class Engine(Protocol):
    """Computes blocks: the same bits for a design whatever block it is in."""

    @property
    def outputs(self) -> tuple[str, ...]: ...

    @property
    def why(self) -> str: ...

    @property
    def text(self) -> str: ...

    @property
    def positions(self) -> int: ...

    @property
    def most_at_once(self) -> int: ...

    def block(self, values: Array) -> Block: ...


@dataclass(frozen=True)
class KernelEngine:
    """The compiled kernel on one thread, and the general executor where the kernel is not sure."""

    kernel: Kernel
    at: Array | None
    why: str = ""

    @property
    def outputs(self) -> tuple[str, ...]:
        return self.kernel.outputs

    @property
    def positions(self) -> int:
        return len(self.kernel.trace.course.schedule.position if self.at is None else self.at)

    @property
    def most_at_once(self) -> int:
        """Designs of a block that takes a tenth of a second, beside which it takes little to store it."""
        return int(BLOCK_WORK // (self.positions * max(1, self._program[0].size)))

    @property
    def text(self) -> str:
        """The program before it is machine code: what is computed, whatever the version is called."""
        return str(self._program[1].text)

    @property
    def _program(self) -> Any:
        return self.kernel.runner.machine(self.kernel.runner.method(self.positions))

    def block(self, values: Array) -> Block:
        answer = self.kernel(values, self.at, threads=1, redo=False)
        parts = {name: answer.value(name) for name in self.outputs} | {"status": answer.code}
        unsure = among(answer.code, UNSURE)
        again = np.flatnonzero(unsure.any(axis=tuple(range(1, unsure.ndim))))
        if len(again):
            with ONE_AT_A_TIME:
                sure = self.kernel(values[again], self.at, threads=1)
            for name in self.outputs:
                parts[name][again] = sure.value(name)
            parts["status"][again] = sure.code
        return parts


@dataclass(frozen=True)
class AnalysisEngine:
    """`da.solve` of one design after the other."""

    mechanism: Mechanism
    numbers: tuple[str, ...]
    outputs: tuple[str, ...]
    reduce: str | None
    static: bool
    count: int | None
    why: str

    @cached_property
    def nominal(self) -> Result:
        """The analysis of the file's numbers: designs have its assembly mode."""
        return solve(self.mechanism, self.static, self.count)

    @property
    def positions(self) -> int:
        return len(self.nominal.status)

    @property
    def shape(self) -> tuple[int, ...]:
        """Axes of the status codes of a design."""
        return () if self.reduce else (self.positions,)

    @property
    def most_at_once(self) -> int:
        """Designs of a block: each takes milliseconds."""
        return 64

    @property
    def text(self) -> str:
        return f"analyses of {self.outputs}, {self.reduce}, static {self.static}, positions {self.count}"

    def _reduced(self, result: Result) -> Block:
        """Outputs of one design, at a reversal of both sides if reduced, else of the first."""
        sides = result.sides if self.reduce else result.sides[:1]
        both = {name: [quantity(side, name).values for side in sides] for name in self.outputs}
        if self.reduce is None:
            return {name: values[0] for name, values in both.items()}
        turns = [result.mechanism.drives[name].turns for name in result.drives]
        cycle = self.reduce in REFINED and is_cycle(result.schedule.position, turns)
        return {name: reduce_sides(self.reduce, values, cycle) for name, values in both.items()}

    @cached_property
    def shapes(self) -> dict[str, tuple[int, ...]]:
        return {name: np.shape(value) for name, value in self.one(self.mechanism)[0].items()}

    def one(self, m: Mechanism) -> tuple[Block, Array]:
        """Outputs and status codes of one design."""
        result = solve(in_mode_of(m, self.nominal, self.count), self.static, self.count)
        codes = [CODES.index(s) for s in result.status]
        statuses = np.array(codes, np.uint8)
        unique = among(statuses, [CODES.index("redundant")])
        for name in self.outputs if unique.any() else ():
            unique &= np.isfinite(quantity(result, name).values.reshape(len(statuses), -1)).all(axis=1)
        statuses[unique] = 0  # as a kernel's, it is the status of the outputs
        return self._reduced(result), first_mark(statuses) if self.reduce else statuses

    def block(self, values: Array) -> Block:
        parts = {name: np.full((len(values), *shape), np.nan) for name, shape in self.shapes.items()}
        statuses = np.full((len(values), *self.shape), CODES.index("failed"), np.uint8)
        with ONE_AT_A_TIME:
            for d, design in enumerate(values):
                try:
                    by_path = dict(zip(self.numbers, design.tolist(), strict=True))
                    outputs, statuses[d] = self.one(self.mechanism.with_values(by_path))
                except DalembertError:
                    continue
                good = among(np.asarray(statuses[d]), NUMBERED)
                for name, value in outputs.items():
                    parts[name][d] = np.where(
                        good.reshape(good.shape + (1,) * (value.ndim - good.ndim)), value, np.nan
                    )
        return parts | {"status": statuses}


def make_engine(
    m: Mechanism,
    paths: Sequence[str],
    outputs: Sequence[str] | None,
    reduce: str | None,
    static: bool,
    positions: int | None,
    lanes: int | None = None,
) -> Engine:
    """The kernel where it reaches, else the analyses, with the sentence why; raises ModelError where neither does."""
    try:
        at = None if positions is None else m.schedule(positions).position
        kernel = compile_kernel(m, paths, outputs, reduce, static=static, lanes=lanes)
        kernel.course(at)
    except ModelError as error:
        if reduce is None and m.schedule().unknown is not None:
            what = "designs differ in the number of their equilibrium positions"
            raise ModelError(what, 'reduce over them: reduce="peak"') from None
        try:
            names = tuple(outputs or _defaults(solve(m, static, positions)))
            engine = AnalysisEngine(m, tuple(paths), names, reduce, static, positions, error.what)
            _ = engine.shapes
        except ModelError:
            raise error from None
        return engine
    return KernelEngine(kernel, at)


def _defaults(r: Result) -> list[str]:
    return [f"effort.{d}" for d in r.drives] + [f"reaction.{j}" for j in r.joints]


Make = Callable[[Sequence[str], str | None], Engine]
"""Engine of some outputs with a reduction."""


@dataclass(frozen=True)
class CycleEngine:
    """Outputs that are single numbers of a cycle, ``range(slide.G)``, whatever the study reduces by: from quantities at
    every position (at a reversal those just before), beside the other outputs."""

    trees: Mapping[str, Tree]
    outputs: tuple[str, ...]
    inner: Engine
    other: Engine | None

    @property
    def why(self) -> str:
        return self.inner.why or (self.other.why if self.other else "")

    @property
    def text(self) -> str:
        return f"{self.inner.text} {dict(self.trees)}{self.other.text if self.other else ''}"

    @property
    def positions(self) -> int:
        return self.inner.positions

    @property
    def most_at_once(self) -> int:
        return min(engine.most_at_once for engine in (self.inner, self.other) if engine)

    def block(self, values: Array) -> Block:
        parts = self.inner.block(values)
        status = first_mark(parts["status"])
        good = among(status, NUMBERED)
        along = {name: part.T for name, part in parts.items()}
        out = self.other.block(values) if self.other else {"status": status}
        with np.errstate(all="ignore"):
            for name, tree in self.trees.items():
                number = np.broadcast_to(evaluate(tree, along, cycle_functions()), (*along["status"].shape,))[
                    0
                ]
                out[name] = np.where(good, number, np.nan)
        return {name: out[name] for name in (*self.outputs, "status")}


def with_cycle_numbers(outputs: Sequence[str], reduce: str | None, nominal: Result, make: Make) -> Engine:
    """An engine of outputs of which some have reductions inside; raises ModelError for what is not one number."""
    trees, rest = dict[str, Tree](), [name for name in outputs if not has_reductions(name)]
    for name in outputs:
        if name in rest:
            continue
        with errors_at("outputs"):
            if not is_single(name):
                what = f"{name!r} has a value at every position, and a reduction inside"
                raise ModelError(what, f"reduce it too: peak({name})")
            trees[name] = cycle_tree(name, nominal)
    leaves = sorted({name for tree in trees.values() for name in names_in(tree)})
    other = make(rest, reduce) if rest else None
    return CycleEngine(trees, tuple(outputs), make(leaves, None), other)


def program_print(engine: Engine, values: Array) -> str:
    """A print of the program and of the bits that it gives for some designs on this processor."""
    arrays: dict[str, Any] = engine.block(values[: PROBED if not engine.why else 1])
    total = hashlib.sha256(engine.text.encode())
    total.update(np.ascontiguousarray(values[:PROBED]).tobytes())
    for name in sorted(arrays):
        total.update(np.ascontiguousarray(arrays[name]).tobytes())
    return total.hexdigest()[:16]
