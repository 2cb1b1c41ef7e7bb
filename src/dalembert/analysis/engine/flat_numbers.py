"""A compiled mechanism as one list of numbers, and what it is without them: its structure."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.arrays import Array, Flags, Ints, Tree
from dalembert.core.equilibrium import Known
from dalembert.core.forcing import Forcing
from dalembert.core.layout import Rows
from dalembert.kernel.graph import Graph, Node

ALONG = {("forces", "value"), ("couples", "value"), ("known", "effort")}
"""Arrays with an axis of positions."""


class Numbers(NamedTuple):
    """The numbers of a mechanism by where they stand.

    key: what must be the same for two mechanisms to be one structure, also which numbers are 0, 1 or -1 and which are
    equal; single (N,): different numbers, and ``which`` (F,) of them stands at each place; columns (C, P): drives'
    positions, speeds, accelerations, and what changes along the positions.
    """

    key: tuple[Any, ...]
    single: Array
    which: Ints
    columns: Array
    constant: Array  # (C,) 0 or NaN where a column is that throughout (never of positions), else 1


def flat_numbers(c: Compiled) -> Numbers:
    """The numbers of a mechanism of the plane, in the order of ``with_nodes``."""
    size = round(math.log10(c.layout.length))  # what is small is told by numbers of a structure of this size
    rows: list[Any] = [size, c.layout.links, c.layout.joints, c.layout.driven.tobytes()]
    single, along = [c.target], [c.schedule.position, c.schedule.speed, c.schedule.acceleration]
    for name, array in _arrays(c):
        if array.dtype.kind != "f":
            rows += [name, array.shape, array.tobytes()]
        elif name in ALONG:
            along.append(array.reshape(len(array), -1))
            rows.append(array.shape[1:])
        else:
            single.append(array.ravel())
            rows.append(array.shape)
    values = np.concatenate(single)
    different, which = _by_first_place(values)
    columns = np.concatenate(along, axis=1).T
    constant = np.where((columns == 0).all(axis=1), 0.0, np.where(np.isnan(columns).all(axis=1), np.nan, 1.0))
    constant[: len(c.schedule.names)] = 1.0
    key = (*rows, which.tobytes(), np.where(_fixed(different), different, 2.0).tobytes(), constant.tobytes())
    return Numbers(key, different, which, columns, constant)


def _by_first_place(values: Array) -> tuple[Array, Ints]:
    """The different values, in the order in which they first occur, and which of them stands at each place."""
    places: dict[float, int] = {}
    which = [places.setdefault(x, len(places)) for x in values.tolist()]
    return np.array(list(places)), np.array(which, np.intp)


def _fixed(different: Array) -> Flags:
    """Numbers that are part of the structure: 0, 1 and -1."""
    return np.asarray((different == 0) | (np.abs(different) == 1))


def _arrays(c: Compiled) -> Iterator[tuple[Any, Array]]:
    """Every array of a compiled mechanism, with its place."""
    for side in (c.layout.constraints, c.layout.freedoms):
        yield "angular", side.angular
        yield "joint", side.joint
        for f in side.families:
            for name, array in vars(f).items():
                yield (type(f).__name__, name), array
    for part, whole in vars(c.forcing).items():
        if isinstance(whole, np.ndarray):
            yield part, whole
        else:
            for name, array in vars(whole).items():
                yield (part, name), array
    for name, array in vars(c.known).items():
        yield ("known", name), array


class _Nodes:
    """Hands out nodes in the order in which ``flat_numbers`` takes numbers."""

    def __init__(self, single: list[Node | float], columns: list[Node | float]) -> None:
        self.single, self.columns = iter(single), iter(columns)

    def array(self, name: Any, like: Array) -> Array:
        if like.dtype.kind != "f":
            return like
        source, shape = (self.columns, (1, *like.shape[1:])) if name in ALONG else (self.single, like.shape)
        out = np.empty(shape, object)
        for place in np.ndindex(shape):
            out[place] = next(source)
        return out

    def rows(self, rows: Rows) -> Rows:
        families = (
            type(f)(**{name: self.array((type(f).__name__, name), a) for name, a in vars(f).items()})
            for f in rows.families
        )
        return replace(rows, families=tuple(families))

    def forcing(self, forcing: Forcing) -> Forcing:
        parts: Tree = {}
        for part in fields(Forcing):
            whole: Any = getattr(forcing, part.name)
            own = vars(whole).items() if is_dataclass(whole) else ()
            inside = {name: self.array((part.name, name), array) for name, array in own}
            parts[part.name] = type(whole)(**inside) if inside else self.array(part.name, whole)
        return Forcing(**parts)


@dataclass(frozen=True)
class Symbols:
    """A compiled mechanism on nodes: its inputs, and those of the drives (3, D): positions, speeds, accelerations."""

    compiled: Compiled
    target: Array
    inputs: tuple[Node, ...]
    drives: Array


def with_nodes(graph: Graph, c: Compiled, numbers: Numbers) -> Symbols:
    """The mechanism with an input in place of every number that is not 0, 1 or -1 (of a column: not 0)."""
    fixed = _fixed(numbers.single)
    different: list[Node | float] = [
        float(x) if same else graph.input("number", f"number {k}", float(x))
        for k, (x, same) in enumerate(zip(numbers.single, fixed, strict=True))
    ]
    columns: list[Node | float] = [
        float(kind) if kind != 1.0 else graph.input("channel", f"column {k}", column)
        for k, (column, kind) in enumerate(zip(numbers.columns, numbers.constant, strict=True))
    ]
    single = [different[k] for k in numbers.which]
    count, drives = len(c.target), len(c.schedule.names)
    nodes = _Nodes(single[count:], columns[3 * drives :])
    layout = replace(
        c.layout, constraints=nodes.rows(c.layout.constraints), freedoms=nodes.rows(c.layout.freedoms)
    )
    forcing = nodes.forcing(c.forcing)
    known = Known(**{n.name: nodes.array(("known", n.name), getattr(c.known, n.name)) for n in fields(Known)})
    made = tuple(x for x in (*different, *columns) if isinstance(x, Node))
    symbols = replace(c, layout=layout, forcing=forcing, known=known)
    at = np.array(
        [graph.constant(x) if not isinstance(x, Node) else x for x in columns[: 3 * drives]], object
    )
    return Symbols(symbols, np.array(single[:count], object), made, at.reshape(3, drives))


def values(numbers: Numbers) -> tuple[list[float], Array]:
    """The values of the inputs that ``with_nodes`` makes: numbers, then columns (C, P)."""
    free = ~_fixed(numbers.single)
    return numbers.single[free].tolist(), numbers.columns[numbers.constant == 1.0]
