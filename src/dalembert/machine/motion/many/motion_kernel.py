"""Compiled motions of many designs: called with their numbers, and what they give.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from dalembert.analysis.batch import over_positions
from dalembert.analysis.batch.checked_input import numbers
from dalembert.analysis.batch.tracing.symbolic_model import VariedNumber
from dalembert.answer.equality import Compared
from dalembert.arrays import Array, Flags
from dalembert.errors import ModelError
from dalembert.kernel.graph import Node
from dalembert.kernel.memory import available
from dalembert.machine.motion.equation import Equation
from dalembert.machine.motion.many.motion_block import MotionBlock, Motions
from dalembert.model import Mechanism

AT_ONCE = 16_384
"""Instants of the designs computed at once."""
UNDECIDED = "undecided: its steps became too small, or it comes near a dead centre; da.simulate says why"
ROWS = {"effort": 0, "motor.stall": 0, "motor.no_load": 1, "position": 3, "speed": 4, "brake": 5}
"""Numbers of a drive that may vary outside the equation, as rows: effort at speed 0, speed without effort, acceleration
of a prescribed drive, position and speed at time 0, brake."""


@dataclass(frozen=True, eq=False)
class MotionBatch(Compared):
    """Motions of many designs: ``arrays`` by output, (design, instant[, component]), or without instants if reduced.

    ``time`` (design,): when each ended, s; ``ended``: by which condition; ``position``, ``speed`` (design, drive) at
    the end. NaN where the continuation of a motion is undecided, or it stops: not ``ok``; ``ended`` says why.
    ``redone``: number of designs that were simulated alone.

    >>> import dalembert as da
    >>> m = da.slider_crank(crank=0.05, rod=0.2)
    >>> start = {"O2": {"position": "30 deg", "speed": "20 rad/s"}}
    >>> k = da.compile_motion(m, "10 ms", ["links.piston.mass"], ["reaction.A"], start=start, count=5)
    >>> batch = k([[1.0], [2.0]])
    >>> batch.position.shape, bool(batch.ok.all())
    ((2, 1), True)
    """

    values: Array = field(repr=False)
    time: Array = field(repr=False)
    position: Array = field(repr=False)
    speed: Array = field(repr=False)
    ended: tuple[str, ...] = field(repr=False)
    arrays: dict[str, Array] = field(repr=False)
    redone: int = 0

    @property
    def ok(self) -> Flags:
        """True for designs that have numbers."""
        return np.isfinite(self.time)

    def value(self, output: str) -> Array:
        """An output by the name it was compiled with."""
        if output not in self.arrays:
            raise ModelError(f"{output!r} was not compiled", f"compile with outputs=[..., {output!r}]")
        return self.arrays[output]


@dataclass(frozen=True)
class MotionKernel:
    """Compiled motions; call it with values (design, number) in SI, in the order of ``numbers``.

    >>> import dalembert as da
    >>> m = da.slider_crank(crank=0.05, rod=0.2)
    >>> start = {"O2": {"position": "30 deg", "speed": "20 rad/s"}}
    >>> k = da.compile_motion(m, "10 ms", ["links.piston.mass"], ["effort.O2"], start=start)
    >>> k.numbers
    ('links.piston.mass',)
    """

    block: MotionBlock = field(repr=False)
    mechanism: Mechanism = field(repr=False)
    lines: Array = field(repr=False)
    formulas: dict[tuple[int, int], Node] = field(repr=False)
    where: tuple[VariedNumber, ...] = field(repr=False)
    places: tuple[int, ...] = field(repr=False)
    reduce: str | None

    @property
    def equation(self) -> Equation:
        """That of the drives."""
        return self.block.equation

    @property
    def numbers(self) -> tuple[str, ...]:
        """Paths of the numbers, one a column of the values."""
        return tuple(self.where[k].path for k in self.places)

    @property
    def nominal(self) -> Array:
        """Values of the numbers in the description."""
        return np.array([self.where[k].value for k in self.places])

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the outputs."""
        return tuple(self.equation.kernel.outputs)

    def __call__(self, values: ArrayLike | None = None, threads: int | None = None) -> MotionBatch:
        """Motions of many designs: values (design, number), default those of the description; ``threads``: number of
        threads, default one per core."""
        designs = self._values(values)
        self._refuse_too_large(len(designs))
        each = max(self.block.code.lanes, AT_ONCE // self.block.instants)
        self.block.machine  # noqa: B018  # compiled once, not by each thread
        with ThreadPoolExecutor(threads) as pool:
            chunks = list(
                pool.map(self._reduced, (designs[k : k + each] for k in range(0, len(designs), each)))
            )
        return self._answer(designs, Motions(*(np.concatenate(x) for x in zip(*chunks, strict=True))))

    def _refuse_too_large(self, designs: int) -> None:
        size = 8 * designs * self.block.output_count * (1 if self.reduce else self.block.instants)
        if size > available():
            raise ModelError(
                "the results are too large for memory", "reduce them, or take fewer designs at once"
            )

    def _values(self, values: ArrayLike | None) -> Array:
        count = len(self.where)
        designs = numbers("values", self.nominal if values is None else values)
        if designs.ndim < 2 and not designs.size % max(count, 1):
            designs = designs.reshape(-1, count) if count else np.zeros((1, 0))
        if (
            designs.ndim != 2
            or designs.shape[1] != count
            or not len(designs)
            or not np.isfinite(designs).all()
        ):
            raise ModelError(
                f"values of shape {designs.shape} do not fit {count} numbers, or are not all finite",
                "give (design, number) in the order of .numbers",
            )
        return designs

    def _reduced(self, values: Array) -> Motions:
        """Motions of some designs, their outputs reduced; each design's instants side by side, so that none depends on
        what others there are."""
        ordered = values[:, np.argsort(self.places)] if self.places else values
        with np.errstate(all="ignore"):
            motions = self.block(*self._begin(ordered))
            out = motions.out[:, -1] if self.reduce == "final" else motions.out
            if self.reduce not in (None, "final") and self.block.output_count:
                one = np.ascontiguousarray(np.moveaxis(out, 1, -1))
                out = over_positions.reduce_positions(self.reduce, np.moveaxis(one, -1, 0))
        return motions._replace(out=out, sure=motions.sure & ~self._other_branch(ordered))

    def _other_branch(self, values: Array) -> Flags:
        """Designs whose assembly mode may be another than the file's."""
        kernel = self.equation.kernel
        designs = np.tile(kernel.nominal, (len(values), 1))
        designs[:, : -2 * self.lines.shape[1]] = values[:, : designs.shape[1] - 2 * self.lines.shape[1]]
        changed = kernel.may_change_branch(designs)
        return np.zeros(len(values), bool) if changed is None else np.asarray(changed)

    def _begin(self, values: Array) -> tuple[Array, Array]:
        """States (M, n) at time 0, and values (M, ...) of the steps."""
        names, many = self.equation.names, (len(values), 1)
        count = len(self.equation.kernel.nominal) - 2 * len(names)
        base, parts = np.tile(self.equation.values, many), np.tile(self.lines, (len(values), 1, 1))
        base[:, :count] = values[:, :count]
        kernel, nodes = self.equation.kernel, list(self.formulas.values())
        along = {n.index: column for n, column in zip(kernel.number_nodes, values.T, strict=False)}
        for place, column in zip(
            self.formulas, kernel.trace.catalogue.graph.evaluate(nodes, along), strict=True
        ):
            parts[:, *place] = column
        for column, n in enumerate(self.where[count:], count):
            _, name, what = n.path.split(".", 2)
            parts[:, ROWS[what], names.index(name)] = values[:, column]
        first, ends, ahead, q, u, brake = parts.swapaxes(0, 1)
        return np.concatenate([q, u], axis=1), np.concatenate(
            [base, first, -first / ends, brake, ahead], axis=1
        )

    def _answer(self, designs: Array, motions: Motions) -> MotionBatch:
        d, axis, place, arrays = self.lines.shape[1], 1 if self.reduce else 2, 0, {}
        texts = [*(c.text for c in self.block.conditions), "time"]
        ended = [texts[k] if sure else UNDECIDED for k, sure in zip(motions.met, motions.sure, strict=True)]
        for x in (motions.out, motions.time, motions.state):
            x[~motions.sure] = np.nan
        for name, nodes in self.equation.kernel.nodes.items():
            part = np.take(motions.out, range(place, place + len(nodes)), axis=axis)
            arrays[name] = part if len(nodes) > 1 else part.squeeze(axis)
            place += len(nodes)
        return MotionBatch(
            designs, motions.time, motions.state[:, :d], motions.state[:, d:], tuple(ended), arrays
        )
