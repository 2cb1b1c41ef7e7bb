"""The answer of a kernel as columns, one row per design or per position of each design, and as printed text."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.batch.over_positions import PLACES
from dalembert.analysis.batch.tracing.symbolic_model import number_kinds
from dalembert.analysis.output.summary.printed_units import scale_for
from dalembert.analysis.result.named_quantities import quantity
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.answer.column import WORD, Column, Scale, UnitChoice, parts
from dalembert.arrays import Array, Tree
from dalembert.errors import ModelError
from dalembert.printing import Part, TextTable, number

if TYPE_CHECKING:
    from dalembert.analysis.batch.batch_result import BatchResult
    from dalembert.analysis.result.result import Result

MOST_SAID = 8
"""Problems that are listed one by one."""


def output_kinds(nominal: Result, outputs: Sequence[str], reduce: str | None) -> dict[str, str]:
    """Kind of each output, from `units.KINDS`; those unknown to a result are numbers."""
    kinds = {}
    for name in outputs:
        try:
            kinds[name] = "number" if reduce in PLACES else quantity(nominal, name).kind
        except ModelError:
            kinds[name] = "number"
    return kinds


def nominal_answer(b: BatchResult) -> Result:
    """The first position of the description, from which kinds of numbers are read."""
    from dalembert.analysis.solution import dynamics, statics

    return (dynamics if b.kernel.trace.inertia else statics)(b.mechanism, positions=1)


def batch_columns(b: BatchResult) -> Iterator[Column]:
    """Number of design and position, what is varied, drives, status, outputs on both sides of reversals."""
    nominal, reduced = nominal_answer(b), b.code.ndim < 2
    count, designs = 1 if reduced else b.code.shape[1], len(b.code)
    kinds = output_kinds(nominal, b.keys(), b.kernel.reduce)
    yield Column("design", WORD, np.repeat(np.arange(designs) + 1, count))
    if not reduced:
        yield Column("position", WORD, np.tile(np.arange(count) + 1, designs))
    for k, (path, kind) in enumerate(_numbers(b)):
        yield Column(path, kind, np.repeat(b.values[:, k], count))
    for k, drive in enumerate(() if reduced else nominal.drives):
        kind = drive_kinds(nominal, drive)["position"]
        yield Column(f"drive.{drive}", kind, np.tile(b.positions[:, k], designs))
    yield Column("status", WORD, b.status.reshape(-1))
    for before, side in (("", b), ("after.", b.after)):
        for name, values in {} if side is None else side.arrays.items():
            flat = values.reshape((b.code.size, *values.shape[b.code.ndim :]))
            for part, numbers in _parts(b.kernel.reduce, flat):
                yield Column(f"{before}{name}{part}", kinds[name], numbers)


def batch_arrays(b: BatchResult, to: Scale) -> tuple[Tree, Tree]:
    """Outputs over designs, positions and components; numbers by design and drives by position as coordinates."""
    nominal, over = nominal_answer(b), ("design", "position")[: b.code.ndim]
    kinds = output_kinds(nominal, b.keys(), b.kernel.reduce)
    rest = ("end",) if b.kernel.reduce == "envelope" else ("component", "link_axis")
    data: Tree = {"status": (over, b.status.astype(str))}
    for name, values in b.arrays.items():
        axes = (*over, *rest[: values.ndim - len(over)])
        data[name] = (axes, to(kinds[name], values), {"units": to.text(kinds[name])})
    names: Tree = {axis: np.arange(n) + 1 for axis, n in zip(over, b.code.shape, strict=True)}
    if any("component" in axes for axes, *_ in data.values()):
        names["component"] = list("xyz"[: b.mechanism.dimension])
    for k, (path, kind) in enumerate(_numbers(b)):
        names[path] = ("design", to(kind, b.values[:, k]), {"units": to.text(kind)})
    for k, drive in enumerate(nominal.drives if "position" in over else ()):
        kind = drive_kinds(nominal, drive)["position"]
        names[f"drive_{drive}"] = ("position", to(kind, b.positions[:, k]), {"units": to.text(kind)})
    return data, names


def _numbers(b: BatchResult) -> list[tuple[str, str]]:
    """Paths of the numbers that vary, with their kinds."""
    return list(zip(b.kernel.numbers, number_kinds(b.mechanism, b.kernel.trace.numbers), strict=True))


def _parts(reduce: str | None, values: Array) -> Iterator[tuple[str, Array]]:
    """Ends of envelopes, else components."""
    if reduce == "envelope":
        yield from ((end, values[:, k]) for k, end in enumerate((".least", ".greatest")))
    else:
        yield from parts(values)


def batch_parts(b: BatchResult, units: UnitChoice) -> Iterator[Part]:
    """Least and greatest value of each number, and the designs with a problem."""
    some = [c for c in batch_columns(b) if c.kind != WORD]
    sizes = {c.kind: 0.0 for c in some}
    for c in some:
        sizes[c.kind] = max(sizes[c.kind], float(np.nanmax(np.abs(c.values), initial=0.0)))
    to = scale_for(None if units == "SI" else b.mechanism.units, sizes)
    ends = [[to(c.kind, of(c.values, initial=first)) for of, first in ENDS] for c in some]
    rows = [[c.head(to), *(number(float(x)) for x in both)] for c, both in zip(some, ends, strict=True)]
    yield repr(b).strip("<>")
    yield TextTable(["", "least", "greatest"], rows, 1)
    yield from (f"{status}: design {design + 1}: {why}" for design, status, why in b.problems()[:MOST_SAID])


ENDS = ((np.nanmin, np.inf), (np.nanmax, -np.inf))
"""Function of an end, and the value that every number is beyond."""
