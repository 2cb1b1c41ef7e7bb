"""``da.compile``: an analysis of one structure as machine code, for any numbers in it (docs/theory.md 8)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dalembert.analysis.batch import over_positions
from dalembert.analysis.batch.batch_result import (
    BLOCK,
    CODES,
    NUMBERED,
    BatchResult,
    among,
    mark_overflow,
    not_finite,
)
from dalembert.analysis.batch.checked_input import (
    check_positions,
    design_values,
    drive_values,
    lanes_here,
    read_target,
    targets,
)
from dalembert.analysis.batch.sides import Sides
from dalembert.analysis.batch.tracing.course import PositionPath
from dalembert.analysis.batch.tracing.symbolic_model import chooses_motion
from dalembert.analysis.batch.tracing.traced_analysis import Trace, trace_analysis
from dalembert.analysis.one_pass import at_schedule
from dalembert.arrays import Array, Flags, Ints
from dalembert.errors import ModelError
from dalembert.kernel.derivatives import gradients
from dalembert.kernel.doubts import uncertain
from dalembert.kernel.graph import CONSTANT, Node
from dalembert.kernel.program import Program
from dalembert.model import Mechanism, ModelOrPath, as_mechanism

LARGEST = float(np.finfo(float).max)
"""Largest number there is."""


def compile(  # noqa: A001
    mechanism: ModelOrPath,
    vary: Sequence[str] = (),
    outputs: Sequence[str] | None = None,
    reduce: str | None = None,
    derivatives: bool = False,
    static: bool = False,
    lanes: int | None = None,
) -> Kernel:
    """An analysis as machine code: for one structure in the plane or in space, whatever the numbers at ``vary``.

    outputs: names such as ``effort.O2``, ``reaction.A``, ``angle.coupler``; default all efforts and reactions
    that are unique. reduce: over the positions, ``peak``, ``mean``, ``rms``, ``envelope`` or others (docs/kernel.md);
    default none. derivatives: exact ones of every output with respect to every number. static: leave inertia out.
    lanes: values side by side (8 AVX-512, 4 AVX2, 2 NEON, 1 none); default those of the processor.
    Raises ModelError for cases that only the analyses support (unknown positions, reactions that
    redundant constraints leave undetermined).

    >>> import dalembert as da
    >>> k = da.compile(da.four_bar(), vary=["links.coupler.mass"], outputs=["effort.O2"])
    >>> k.numbers
    ('links.coupler.mass',)
    >>> k([[1.0], [2.0]]).effort("O2").shape
    (2, 72)
    """
    mechanism = as_mechanism(mechanism)
    over_positions.check(reduce)
    _check_count("lanes", lanes)
    try:
        inertia = mechanism.has_speeds and not static
        trace = trace_analysis(mechanism, _several(vary), inertia, redundant=True)
        names = trace.unique(None if outputs is None else _several(outputs))
    except ModelError as error:
        raise error.at_source(mechanism.source) from None
    if derivatives and reduce == "argpeak":
        raise ModelError(
            "the place of a peak has no derivative", 'leave derivatives out, or reduce by "peak"'
        )
    kernel = Kernel(mechanism, trace, names, reduce, derivatives, lanes or lanes_here())
    if lanes is None and kernel.program(kernel.flat).waits:
        kernel = replace(kernel, lanes=2 * kernel.lanes)
    kernel.warm()
    return kernel


def _several(names: Sequence[str]) -> tuple[str, ...]:
    """Names; a single one may be given without a list."""
    return (names,) if isinstance(names, str) else tuple(names)


def _check_count(name: str, count: object) -> None:
    if count is not None and (
        isinstance(count, bool) or not isinstance(count, int | np.integer) or count <= 0
    ):
        raise ModelError(f"{name}={count!r} is not a number of {name}", "give 1 or more, or leave it out")


def _products(nodes: Sequence[Node]) -> list[Node]:
    """Products of pairs of nodes: not finite where one of them is not, with half as many operations as their
    squares."""
    factors = list(dict.fromkeys(n for n in nodes if n.level != CONSTANT))
    return [a * b for a, b in zip(factors[::2], factors[1::2], strict=False)] + factors[len(factors) & ~1 :]


@dataclass(frozen=True)
class Kernel:
    """A compiled analysis; call it with values (design, number) in SI, in the order of ``numbers``, or by name.

    >>> import dalembert as da
    >>> k = da.compile(da.four_bar(), ["links.coupler.mass"], ["effort.O2"])
    >>> k.numbers, k.nominal.tolist()
    (('links.coupler.mass',), [0.6])
    """

    mechanism: Mechanism = field(repr=False)
    trace: Trace = field(repr=False)
    outputs: tuple[str, ...]
    reduce: str | None
    derivatives: bool
    lanes: int

    def __reduce__(self) -> tuple[object, ...]:  # pickled by its recipe, and compiled anew with as many lanes
        arguments = self.mechanism, self.numbers, self.outputs, self.reduce, self.derivatives
        return compile, (*arguments, not self.trace.inertia, self.lanes)

    def _repr_html_(self) -> str:
        from dalembert.notebook.html_views import kernel_html

        return kernel_html(self)

    @property
    def numbers(self) -> tuple[str, ...]:
        """Paths of the numbers, one a column of the values."""
        return tuple(n.path for n in self.trace.numbers)

    @property
    def nominal(self) -> Array:
        """Values of the numbers in the description."""
        return np.array([n.value for n in self.trace.numbers])

    @cached_property
    def nodes(self) -> dict[str, list[Node]]:
        """Components of each output."""
        return {name: self.trace.catalogue.nodes(name) for name in self.outputs}

    @cached_property
    def rates(self) -> dict[str, list[list[Node]]]:
        """Derivatives of each component of each output."""
        graph = self.trace.catalogue.graph
        inputs = self.number_nodes
        flat = [n for nodes in self.nodes.values() for n in nodes]
        rates = iter(gradients(graph, flat, inputs))
        return {name: [next(rates) for _ in nodes] for name, nodes in self.nodes.items()}

    @cached_property
    def number_nodes(self) -> list[Node]:
        graph = self.trace.catalogue.graph
        inputs = {n.value: n for n in graph.nodes if n.op == "number"}
        return [inputs[k] for k in range(len(self.trace.numbers))]

    def program(self, nodes: Sequence[Node], values: int | None = None) -> Program:
        """The program of some outputs: first values (default all requested ones), then derivatives."""
        traced = self.trace.catalogue.traced
        flags = replace(traced.friction.flags, open=tuple(traced.open), doubt=tuple(traced.doubt))
        graph = traced.graph
        flags = replace(flags, outside=uncertain(graph.outside), contact=uncertain(traced.contacts))
        values = sum(len(of) for of in self.nodes.values()) if values is None else values
        slope = [] if self.reduce else nodes[values:]
        known = self.trace.course.result is not None
        finite = () if known else self._finite(_products(nodes[:values]))
        flags = replace(flags, slips=(*flags.slips, *finite), slope=self._finite([abs(n) for n in slope]))
        return Program(self.trace.catalogue.graph, tuple(nodes), flags)

    def _finite(self, nodes: Sequence[Node]) -> tuple[Node, ...]:
        """Below zero, or no number, where some node is not finite, or their sum."""
        graph = self.trace.catalogue.graph
        total = sum((n for n in nodes if n.level != CONSTANT), graph.zero)
        return () if total is graph.zero else (LARGEST - abs(total),)

    @cached_property
    def flat(self) -> list[Node]:
        """Every value asked for at a position, derivatives behind the outputs."""
        out = [n for nodes in self.nodes.values() for n in nodes]
        if self.derivatives and self.reduce is None:
            out += [n for rates in self.rates.values() for row in rates for n in row]
        return out

    @cached_property
    def runner(self) -> Any:
        """Grid, pairs and reductions, each compiled when first used."""
        from dalembert.analysis.batch.runner import Runner

        return Runner(self)

    @cached_property
    def general_program(self) -> Kernel:
        """The same outputs and their derivatives from solutions of the general executor; compiled when first used."""
        course = self.trace.course
        solved = at_schedule(self.mechanism, course.schedule, self.trace.inertia)
        trace = trace_analysis(self.mechanism, self.numbers, self.trace.inertia, solved, redundant=True)
        return replace(self, trace=trace, reduce=None, derivatives=True)

    def warm(self) -> None:
        """Compiles now the code for the file's positions."""
        self.runner.prepare(len(self.trace.course.schedule.position))

    def course(self, positions: ArrayLike | None) -> PositionPath:
        """The mechanism at other positions than the file's; those of the last call are kept."""
        known = self.trace.course
        if positions is None:
            return known
        values = drive_values(self.mechanism, positions)
        drives = len(known.schedule.names)
        if values.ndim < 2 and values.size % max(drives, 1) == 0:
            values = values.reshape(-1, drives)
        last = self._last_course
        if last and np.array_equal(last[0].schedule.position, values):
            return last[0]
        check_positions(values, known.schedule)
        last[:] = [known.at(values.copy())]
        return last[0]

    def _course_to(
        self, positions: ArrayLike | None, target: ArrayLike | Mapping[str, ArrayLike] | None
    ) -> PositionPath:
        """The mechanism at positions, with the values that its outputs are compared with."""
        course = self.course(positions)
        shapes = {name: (len(course.schedule.position), len(of)) for name, of in self.nodes.items()}
        return course if target is None else course.with_target(read_target(target, shapes, self.reduce))

    @cached_property
    def _last_course(self) -> list[PositionPath]:
        return []

    def __call__(
        self,
        values: ArrayLike | Mapping[str, ArrayLike] | None = None,
        positions: ArrayLike | None = None,
        threads: int | None = None,
        progress: Callable[[int, int], object] | None = None,
        redo: bool = True,
        device: str = "cpu",
        out: Array | Mapping[str, Array] | None = None,
        target: ArrayLike | Mapping[str, ArrayLike] | None = None,
    ) -> BatchResult:
        """Answers for many designs.

        values: (design, number) in SI in the order of ``numbers``, default those of the description; or by name, each
        one value or one for each design, ``k({"r": 0.06})``, the others as in the description. positions: the drives'
        values (position, drive), or how many, default the file's. threads: largest number of threads, default one per
        core. progress: called with (designs done, designs). redo: use the general executor where the kernel is not
        sure. device: ``cpu``, or ``cuda`` for an NVIDIA card through cupy. out: the array that an output goes to, one
        on disk by ``np.memmap`` too, or arrays by output (of derivatives by ``gradient.`` and the output). target: what
        ``squares`` compares an output with (position[, component]), or arrays by output; default 0.
        """
        rows, course = design_values(values, self.numbers, self.nominal), self._course_to(positions, target)
        return self.answer(rows, course, threads, progress, redo, device, out)

    def blocks(
        self,
        values: ArrayLike | Mapping[str, ArrayLike] | None = None,
        size: int | None = None,
        positions: ArrayLike | None = None,
        target: ArrayLike | Mapping[str, ArrayLike] | None = None,
        **options: Any,
    ) -> Iterator[BatchResult]:
        """Answers in blocks of ``size`` designs, default as many as take 64 MB, so that memory is bounded whatever the
        number of designs. ``options`` are the other arguments of a call."""
        _check_count("size", size)
        rows, course = design_values(values, self.numbers, self.nominal), self._course_to(positions, target)
        each = 8 * max(1, len(self.flat)) * (1 if self.reduce else len(course.schedule.position))
        step = size or max(1, BLOCK // each)
        return (self.answer(rows[k : k + step], course, **options) for k in range(0, len(rows), step))

    def answer(
        self,
        designs: Array,
        course: PositionPath,
        threads: int | None = None,
        progress: Callable[[int, int], object] | None = None,
        redo: bool = True,
        device: str = "cpu",
        out: Array | Mapping[str, Array] | None = None,
    ) -> BatchResult:
        """Result of a call, for designs along a course."""
        from dalembert.analysis.batch.reversal_sides import settle_reversals

        _check_count("threads", threads)
        if device not in ("cpu", "cuda"):
            raise ModelError(f"unknown device {device!r}", "use cpu or cuda")
        into = self._targets(out, len(designs), len(course.schedule.position))
        try:
            sides = Sides(*self.runner(device, designs, course, threads, progress, into))
        except MemoryError:
            from dalembert.analysis.batch.runner import TOO_MUCH

            raise ModelError("the results are too large for memory", TOO_MUCH) from None
        except RuntimeError as error:
            if device == "cpu":  # of whoever watches the progress
                raise
            raise ModelError(f"device {device!r} cannot be used: {error}", 'use device="cpu"') from None
        code, again = sides.code, 0
        if (other := self.may_change_branch(designs)) is not None:
            code[other] = CODES.index("undecided")
        if not np.isfinite(designs).all():
            code[~np.isfinite(designs).all(axis=1)] = CODES.index("failed")
        settle_reversals(self, designs, course, sides, threads)
        if np.count_nonzero(code) or not (self.reduce is None or sides.finite):
            again = self._settle(designs, course, sides, redo)
        common = (self, designs, course.schedule.position.copy(), code)
        after = BatchResult(*common, sides.after, sides.after_rates) if sides.after else None
        return BatchResult(*common, sides.arrays, sides.rates, again, after)

    def to_c(self, name: str = "mechanism") -> str:
        """C source, needing nothing but math.h, of a function of one position: numbers, drives' quantities, outputs."""
        from dalembert.analysis.batch.kernel_export import c_source

        return c_source(self, name)

    def to_wasm(self, row: int | None = None) -> Any:
        """`WasmModule` of up to ``row`` positions a call (default: the file's); raises ModelError if reduced."""
        from dalembert.analysis.batch.kernel_export import wasm_module

        return wasm_module(self, row)

    def to_fmu(self, version: str = "2.0") -> bytes:
        """Functional mock-up unit with C sources (FMI 2.0 or 3.0): numbers are parameters, drives inputs."""
        from dalembert.interchange.targets.source_fmu import fmu_bytes

        return fmu_bytes(self, version)

    def to_casadi(self, name: str = "mechanism") -> Any:
        """casadi Function of (values, inputs) with the outputs by name; raises ModelError without casadi."""
        from dalembert.analysis.batch.kernel_export import casadi_function

        return casadi_function(self, name)

    @cached_property
    def _deciding(self) -> Ints | None:
        """Numbers that decide the branch: of `assembly`, and of the geometry where the motion passes change points."""
        from dalembert.analysis.batch.careful_path import breaks

        flips = self.trace.catalogue.traced.flips
        chosen = [chooses_motion(self.mechanism, path, flips) for path in self.numbers]
        return None if breaks(self) else np.flatnonzero(chosen)

    def may_change_branch(self, values: Array) -> Flags | None:
        """Designs whose motion may be another than the file's, each left to the general executor; None for none."""
        if self._deciding is None:
            return np.ones(len(values), bool)
        other = (values != self.nominal)[:, self._deciding].any(axis=1)
        return np.asarray(other) if self._deciding.size else None

    def _targets(
        self, out: Array | Mapping[str, Array] | None, designs: int, positions: int
    ) -> tuple[dict[str, Array], dict[str, Array]] | None:
        """The arrays that outputs and derivatives go to, by output; raises ModelError where they do not fit."""
        if out is None:
            return None
        before = (designs,) if self.reduce else (designs, positions)
        sides = (2,) if self.reduce == "envelope" else ()
        shapes = {
            name: before + ((len(nodes),) if len(nodes) > 1 else ()) + sides
            for name, nodes in self.nodes.items()
        }
        slopes = {n: (*shape, len(self.trace.numbers)) for n, shape in shapes.items() if self.derivatives}
        arrays = targets(out, shapes | {f"gradient.{n}": shape for n, shape in slopes.items()})
        return {n: arrays[n] for n in shapes}, {n: arrays[f"gradient.{n}"] for n in slopes}

    def _settle(self, values: Array, course: PositionPath, sides: Sides, redo: bool) -> int:
        """Number of designs for which the general executor was used; numbers that are not solved are removed."""
        from dalembert.analysis.batch.careful_path import redone

        code, arrays, rates = sides.code, sides.arrays, sides.rates
        if redo:
            moves = course.schedule.moves | bool(course.counted.unknown_loads)  # which may have no power
            still = (code == CODES.index("at_rest")) & (moves if code.ndim > 1 else moves.any())
            code[still] = CODES.index("undecided")
        if self.reduce is not None:  # a power or a sum may overflow where no value does
            code[not_finite(code, arrays) & among(code, NUMBERED)] = CODES.index("undecided")
        undecided = code == CODES.index("undecided")
        again = np.flatnonzero(undecided.any(axis=tuple(range(1, code.ndim)))) if redo else np.zeros(0, int)
        for d in again:
            redone(self, int(d), values[d], course, undecided[d], sides)
            if self.reduce is None:
                for side in ((arrays, rates), (sides.after, sides.after_rates)):
                    mark_overflow(code[d], *({n: a[d] for n, a in of.items()} for of in side))
        if self.reduce is not None:
            mark_overflow(code, arrays, rates)
        if np.count_nonzero(code):
            sides.blank(~among(code, NUMBERED))
        return len(again)
