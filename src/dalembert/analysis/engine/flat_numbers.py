"""A compiled mechanism as one list of numbers, and what it is without them: its structure."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from itertools import islice
from typing import Any, NamedTuple

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.arrays import Array, Flags, Ints, Tree
from dalembert.core.elements.belt_pulls import BeltPulls
from dalembert.core.elements.strand_limits import RopeGrips
from dalembert.core.equilibrium import Known
from dalembert.core.forcing import Couples, Inertia, PointForces, Resistances, Springs, TurningFrame
from dalembert.core.layout import Pose, Rows
from dalembert.core.position.whole_turns import rigid_turns
from dalembert.kernel.graph import Graph, Node, trace_array

RECORDS = (BeltPulls, RopeGrips, Inertia, PointForces, Couples, Springs, Resistances, Rows, TurningFrame)
"""Records inside of others."""

ALONG = {
    *((PointForces, "value"), (Couples, "value"), (Known, "effort")),
    *((TurningFrame, "square"), (TurningFrame, "effort")),
}
"""Arrays with an axis of positions; the turns of torsion springs may have one too."""

VARIES = 2.0
"""Value of a column that is not constant for its structure."""


class Numbers(NamedTuple):
    """The numbers of a mechanism by their places.

    key: data that must be equal for two mechanisms to have one structure, including which numbers are 0, 1 or -1 and
    which are equal; single (N,): different numbers, and ``which`` (F,) of them is at each place; columns (C, P):
    drives' positions, speeds, accelerations, and what changes along the positions.
    """

    key: tuple[object, ...]
    single: Array
    which: Ints
    columns: Array
    constant: Array  # (C,) the value of a column that is part of the structure, else VARIES


def flat_numbers(c: Compiled, pose: Pose | None = None) -> Numbers:
    """The numbers of a mechanism, in the order of ``with_nodes``; with its poses (P, L+1, ...) where they are known."""
    size = round(math.log10(c.layout.length))  # what is small is told by numbers of a structure of this size
    rows: list[object] = [size, c.layout.links, c.layout.joints, c.layout.driven.tobytes()]
    single, along = [c.target], [c.schedule.position, c.schedule.speed, c.schedule.acceleration]
    for part in (c.layout.constraints, c.layout.freedoms):
        known, numbers = _flat_rows(part)
        rows += known
        single += numbers
    if c.pushing is not None:
        rows += c.pushing.key
    for record in (c.forcing, c.known):
        _flatten(record, rows, single, along)
    if c.contacts is not None and pose is not None:
        _flatten(c.contacts, rows, single, along)
    for array in pose or ():
        _flatten_along(array, rows, along)
    values = np.concatenate(single)
    different, which = _by_first_place(values)
    columns = np.concatenate([a.T for a in along])
    constant = np.full(len(columns), VARIES)
    first = columns[:, 0]
    some = np.flatnonzero((first == 0) | (first != first))  # no other is all 0, or no number at any position
    constant[some[~columns[some].any(axis=1)]] = 0.0
    constant[some[np.isnan(columns[some]).all(axis=1)]] = np.nan
    constant[: len(c.schedule.names)] = VARIES
    if pose is not None:
        held = _held(c, pose)
        held_values = columns[len(columns) - len(held) :, 0]
        constant[len(columns) - len(held) :] = np.where(held & _fixed(held_values), held_values, VARIES)
    key = (
        *rows,
        which.tobytes(),
        np.where(_fixed(different), different, VARIES).tobytes(),
        constant.tobytes(),
    )
    return Numbers(key, different, which, columns, constant)


def _held(c: Compiled, pose: Pose) -> Flags:
    """True for columns of poses that never change: those of the ground, and rotations of links that cannot turn."""
    still = rigid_turns(replace(c.layout, driven=np.zeros(0, np.intp)))
    ground, turned = np.arange(len(still)) == len(still) - 1, still == still[-1]
    turns = ground if c.layout.algebra.d == 2 else np.zeros(pose.turn.shape[1], bool)
    flags = (np.repeat(ground, pose.point.shape[2]), turns, np.repeat(turned, pose.rotation.shape[2]))
    return np.concatenate(flags)


def _by_first_place(values: Array) -> tuple[Array, Ints]:
    """The different values, in the order in which they first occur, and which of them is at each place."""
    places: dict[float, int] = {}
    which = [places.setdefault(x, len(places)) for x in values.tolist()]
    return np.array(list(places)), np.array(which, np.intp)


def _fixed(different: Array) -> Flags:
    """Numbers that are part of the structure: 0, 1 and -1."""
    return np.asarray((different == 0) | (np.abs(different) == 1))


@lru_cache(maxsize=64)
def _flat_rows(part: Rows) -> tuple[list[object], list[Array]]:
    """Values that ``_flatten`` puts into lists of rows, which are kept from mechanism to mechanism."""
    rows: list[object] = []
    single: list[Array] = []
    _flatten(part, rows, single, [])
    return [tuple(rows)], [np.concatenate([*single, np.zeros(0)])]


def _flatten(record: object, rows: list[object], single: list[Array], along: list[Array]) -> None:
    """Put the numbers of a record into lists, in the order of its fields, and what else is part of the structure."""
    kind = type(record)
    rows.append(kind)
    for part in FIELDS.get(kind) or _fields(kind):
        value = getattr(record, part)
        if isinstance(value, np.ndarray):
            if value.dtype.kind != "f":
                rows.append(value.tobytes())
            elif _changes(kind, part, value):
                _flatten_along(value, rows, along)
            else:
                single.append(value.ravel())
                rows.append(value.shape)
        elif part == "families":
            for family in value:
                _flatten(family, rows, single, along)
        elif type(value) in RECORDS:
            _flatten(value, rows, single, along)
        else:
            rows.append(value)


def _flatten_along(array: Array, rows: list[object], along: list[Array]) -> None:
    along.append(array.reshape(len(array), -1))
    rows.append(array.shape[1:])


FIELDS: dict[type, tuple[str, ...]] = {}
"""Names of the fields of the records met."""


def _fields(kind: Any) -> tuple[str, ...]:
    FIELDS[kind] = tuple(part.name for part in fields(kind))
    return FIELDS[kind]


def _changes(kind: type, part: str, array: Array) -> bool:
    """True if an array of a record has an axis of positions."""
    return (kind, part) in ALONG or (kind is Resistances and part == "turns" and array.ndim > 1)


class _Nodes:
    """Hands out nodes in the order in which ``flat_numbers`` takes numbers."""

    def __init__(self, single: list[Node | float], columns: list[Node | float]) -> None:
        self.single, self.columns = iter(single), iter(columns)

    def array(self, kind: type, part: str, like: Array) -> Array:
        if like.dtype.kind != "f":
            return like
        if kind is Resistances and _changes(kind, part, like):
            return self.along(like)
        changes = _changes(kind, part, like)
        source, shape = (self.columns, (1, *like.shape[1:])) if changes else (self.single, like.shape)
        items = list(islice(source, math.prod(shape)))
        out = np.array(items, object if any(type(x) is Node for x in items) else float)
        return out.reshape(shape)

    def along(self, like: Array) -> Array:
        """One position of an array along the positions."""
        return np.array([next(self.columns) for _ in range(like[0].size)], object).reshape(like.shape[1:])

    def record(self, record: Any) -> Any:
        """The same record on nodes."""
        parts: Tree = {}
        for part in _fields(type(record)):
            value = getattr(record, part)
            if isinstance(value, np.ndarray):
                parts[part] = self.array(type(record), part, value)
            elif type(value) in RECORDS:
                parts[part] = self.record(value)
            elif part == "families":
                parts[part] = tuple(map(self.record, value))
            else:
                parts[part] = value
        return type(record)(**parts)


@dataclass(frozen=True)
class Symbols:
    """A compiled mechanism on nodes: its inputs, and those of the drives (3, D): positions, speeds, accelerations."""

    compiled: Compiled
    target: Array
    inputs: tuple[Node, ...]
    drives: Array
    pose: Pose | None


def with_nodes(graph: Graph, c: Compiled, numbers: Numbers, pose: Pose | None = None) -> Symbols:
    """The mechanism with an input for every number that is not 0, 1 or -1 (of a column: not 0)."""
    fixed = _fixed(numbers.single)
    different: list[Node | float] = [
        float(x) if same else graph.input("number", f"number {k}", float(x))
        for k, (x, same) in enumerate(zip(numbers.single, fixed, strict=True))
    ]
    columns: list[Node | float] = [
        float(kind) if kind != VARIES else graph.input("channel", f"column {k}", column)
        for k, (column, kind) in enumerate(zip(numbers.columns, numbers.constant.tolist(), strict=True))
    ]
    single = [different[k] for k in numbers.which]
    count, drives = len(c.target), len(c.schedule.names)
    nodes = _Nodes(single[count:], columns[3 * drives :])
    layout = replace(
        c.layout,
        constraints=nodes.record(c.layout.constraints),
        freedoms=nodes.record(c.layout.freedoms),
    )
    forcing, known = nodes.record(c.forcing), nodes.record(c.known)
    contacts = c.contacts if pose is None or c.contacts is None else nodes.record(c.contacts)
    symbols = replace(c, layout=layout, forcing=forcing, known=known, contacts=contacts)
    stands = None if pose is None else Pose(*(trace_array(graph, nodes.along(a)) for a in pose))
    made = tuple(x for x in (*different, *columns) if isinstance(x, Node))
    at = trace_array(graph, np.array(columns[: 3 * drives], object))
    return Symbols(symbols, np.array(single[:count], object), made, at.reshape(3, drives), stands)


def values(numbers: Numbers) -> tuple[list[float], Array]:
    """The values of the inputs that ``with_nodes`` makes: numbers, then columns (C, P)."""
    free = ~_fixed(numbers.single)
    return numbers.single[free].tolist(), numbers.columns[numbers.constant == VARIES]
