"""Every position of an analysis from its structure's kept program; none where the careful path has to look."""

from __future__ import annotations

from collections import OrderedDict
from threading import Lock
from typing import Any, NamedTuple

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.analysis.degree_of_freedom import Mobility
from dalembert.analysis.engine.first_way import First, first_way, remember
from dalembert.analysis.engine.flat_numbers import flat_numbers, values
from dalembert.analysis.engine.kept_program import DeadCentreError, KeptProgram, trace_structure
from dalembert.analysis.positions import FARTHEST, mode_sentence
from dalembert.analysis.result.result import Result
from dalembert.analysis.status.statuses import UNBALANCED
from dalembert.arrays import Array, Ints
from dalembert.core.position.first_pose_plane import Guess, phase_rows
from dalembert.core.position.path_parameter import walk

KEPT = 64
"""Structures whose programs are kept."""

BLOCK = 1024
"""Positions computed at once: their values stay in the cache."""

STEP, FEWEST = 0.2, 8
"""Longest way of the drives between two places, radians or lengths, and how many steps a motion has at least: what
lies between two listed positions is looked at too."""

MOST = 20_000
"""Places between the listed positions that are looked at."""

MANY = 500_000
"""Angles that are counted at once, so that it takes little memory."""

TURN = 1.0
"""Largest turn of a link from place to place, radians: more, and its whole turns are not counted surely."""

LARGEST = 1e150
"""Rates whose squares are numbers."""


FEW_LINKS, FEW_POSITIONS = 8, 50
"""A structure of more links met for the first time, at fewer positions, takes less time on the careful path than to
trace: it is traced when it is met again."""


class _Met:
    """Stands for a program where a structure was met once."""


MET = _Met()


Kept = KeptProgram | _Met | None
"""A program, or none where a structure has none."""


class _Structures:
    """Programs by structure, those used last; one lock for all threads."""

    def __init__(self) -> None:
        self.lock, self.found = Lock(), OrderedDict[Any, Kept]()

    def get(self, key: Any) -> tuple[bool, Kept]:
        with self.lock:
            there = key in self.found
            if there:
                self.found.move_to_end(key)
            return there, self.found.get(key)

    def put(self, key: Any, program: Kept) -> None:
        with self.lock:
            self.found[key] = program
            while len(self.found) > KEPT:
                self.found.popitem(last=False)


STRUCTURES = _Structures()


def quick_result(c: Compiled, inertia: bool) -> Result | None:
    """The answer of a mechanism of the plane at its positions, every one of them ok; None where some may not be."""
    if not _suits(c):
        return None
    numbers = flat_numbers(c)
    single, columns = values(numbers)
    key, given = (inertia, *numbers.key), [*single, *columns[:, 0].tolist()]
    there, program = STRUCTURES.get(key)
    if not there and c.layout.links > FEW_LINKS and c.schedule.count < FEW_POSITIONS:
        STRUCTURES.put(key, MET)
        return None
    if not there or isinstance(program, _Met):
        modes = c.guess.modes(c.layout, c.first_target)
        if modes is None:
            return None
        try:
            program = trace_structure(c, numbers, modes.pose.at(slice(0, 1)), inertia)
        except DeadCentreError:
            return None
        if program is not None:
            remember(program, c, given, First(program.ways, modes.pose.turn[0, :-1], mode_sentence(c, modes)))
        STRUCTURES.put(key, program)
    del numbers  # the answer may be large
    first = None if program is None else first_way(program, c, given)
    return None if first is None or program is None else _follow(program, c, single, columns, first, inertia)


def _suits(c: Compiled) -> bool:
    """Whether a mechanism is of a kind that programs are kept of."""
    stack = c.layout.stack
    return (
        isinstance(c.guess, Guess)
        and c.contacts is None
        and c.layout.compliance is None
        and not c.layout.redundant
        and stack.count == c.layout.unknowns
        and not phase_rows(c.layout.constraints).size
        and not c.forcing.resistances.stiffness.any()
        and bool(np.isfinite(c.schedule.position).all())
    )


class _Walk(NamedTuple):
    """Places in the order in which a motion meets them: ``order`` of the list's and of those between, ``between``: the
    drives' positions there (B, D), ``before`` the listed position before each."""

    order: Ints
    between: Array
    before: Ints


def _walk(c: Compiled, step: float) -> _Walk | None:
    """The motion through a list with no step longer than ``step``; None where that would be too many."""
    drives = c.schedule.position
    count, none = len(drives), np.zeros(0, np.intp)
    if count == 1:
        return _Walk(np.zeros(1, np.intp), drives[:0], none)
    order, _, s = walk(c.layout, drives)
    way = np.diff(s)
    parts = np.ceil(way / min(step, s[-1] / FEWEST)) if s[-1] > 0 else way
    if not (way <= FARTHEST).all() or parts.sum() > MOST + count:
        return None
    more = np.maximum(parts.astype(int) - 1, 0)
    low = np.repeat(np.arange(len(way)), more)
    if not low.size:
        return _Walk(order, drives[:0], none)
    share = (np.arange(len(low)) - np.repeat(np.cumsum(more) - more, more) + 1) / (more[low] + 1)
    before = drives[order[low]]
    between = before + share[:, None] * (drives[order[low + 1]] - before)
    whole = np.insert(order, low + 1, count + np.arange(len(low)))
    return _Walk(whole, between, order[low])


def _follow(
    k: KeptProgram, c: Compiled, single: list[float], columns: Array, first: First, inertia: bool
) -> Result | None:
    """The positions of a list, and in between as close as it takes to be sure that the motion is one."""
    for step in (STEP, STEP / 8, STEP / 64):
        way = _walk(c, step)
        if way is None:
            return None
        found = _evaluate(k, c, single, _with_between(k, columns, way), first.ways)
        if found is None:
            return None
        if _count_turns(k, found.out, way, first.turn) and _steady(k, found.out, way):
            return _result(k, c, found, first.mode, inertia)
    return None


def _with_between(k: KeptProgram, columns: Array, walk: _Walk) -> Array:
    """Columns of the inputs with those of the places in between: drives' positions, else as at the one before."""
    if not len(walk.between):
        return columns
    more = columns[:, walk.before]
    for row, place in enumerate(k.driven):
        more[row] = walk.between[:, place]
    return np.concatenate([columns, more], axis=1)


class _Found(NamedTuple):
    """What an answer keeps (N, P), residual and power balance (P,), of all places."""

    out: Array
    residual: Array
    power: Array


def _evaluate(
    k: KeptProgram, c: Compiled, single: list[float], columns: Array, ways: tuple[float, ...]
) -> _Found | None:
    """All outputs, and the checks of them; None where one fails."""
    count = columns.shape[1] if len(columns) else c.schedule.count
    residual, power = np.empty(count), np.empty(count)
    work = np.empty((k.size, min(count, BLOCK)))
    out = work[: k.kept] if count <= BLOCK else np.empty((k.kept, count))
    with np.errstate(all="ignore"):
        for start in range(0, count, BLOCK):
            part = slice(start, start + BLOCK)
            here = work[:, : min(BLOCK, count - start)]
            try:
                k.run([*single, *_at(columns, part), *ways], here)
            except (ArithmeticError, ValueError):
                return None
            residual[part], power[part] = _checks(k, c, here)
            if not (_sure(k, here) and (residual[part] <= UNBALANCED).all()):
                return None
            if count > BLOCK:
                out[:, part] = here[: k.kept]
    return _Found(out, residual, power)


def _at(columns: Array, part: slice) -> list[Any]:
    """Columns at some positions; of one position single numbers, which are quicker to compute with."""
    return list(columns[:, part]) if columns.shape[1] > 1 else columns[:, 0].tolist()


def _sure(k: KeptProgram, out: Array) -> bool:
    """Whether every output is a number, and none says that something is in doubt."""
    sizes = out[k.rows["twist"]]
    fast = np.maximum(sizes.max(initial=0.0), -sizes.min(initial=0.0))
    sure = np.isfinite(out.sum()) and fast < LARGEST
    return bool(sure and (out[k.rows["closure"]] >= 0).all() and (out[k.rows["margin"]] >= 0).all())


def _checks(k: KeptProgram, c: Compiled, out: Array) -> tuple[Array, Array]:
    """Residual over the largest force, and virtual power over force times velocity, at each place."""
    per_length = c.layout.wrench_scale[:, None]
    forces = np.abs(out[k.rows["force"].start : k.rows["loads"].stop])
    forces[k.moments] /= c.layout.length
    largest = forces.max(axis=0, initial=0.0)
    left = np.abs(out[k.rows["unbalanced"]]).reshape(*k.nodes["unbalanced"].shape, out.shape[1]) * per_length
    residual = left.max(axis=(0, 1), initial=0.0) / np.where(largest > 0, largest, 1.0)
    speeds = np.abs(out[k.rows["virtual"]]).reshape(*k.nodes["virtual"].shape, out.shape[1]) / per_length
    reference = largest * speeds.max(axis=(1, 2), initial=0.0)
    balance = np.abs(out[k.rows["power"]]) / np.where(reference > 0, reference, 1.0)
    return residual, balance.max(axis=0, initial=0.0)


def _count_turns(k: KeptProgram, out: Array, way: _Walk, first: Array) -> bool:
    """Put in the links' angles, whole turns counted along the motion; not where one of them turns far at a step."""
    free = np.flatnonzero(~k.fixed)
    for links in np.array_split(free, 1 + free.size * len(way.order) // MANY):
        rows = k.rows["rotation"].start + links
        angle = np.arctan2(out[rows + len(k.fixed)], out[rows])
        turns = np.diff(angle[:, way.order], axis=1)
        step = turns.copy()
        np.rint(turns / (2 * np.pi), out=turns)
        step -= 2 * np.pi * turns
        if (np.abs(step) > TURN).any():
            return False
        whole = np.zeros_like(angle)
        whole[:, way.order[1:]] = -np.cumsum(turns, axis=1)
        whole += (np.rint((first[links] - angle[:, 0]) / (2 * np.pi)) - whole[:, 0])[:, None]
        out[k.rows["turn"].start + links] = angle + 2 * np.pi * whole
    return True


def _steady(k: KeptProgram, out: Array, way: _Walk) -> bool:
    """Whether no group passes a dead centre between two places: what vanishes there changes by less than it is."""
    sizes = (np.sqrt(row)[way.order] for row in out[k.rows["closure"]])
    return all((np.abs(np.diff(a)) <= np.minimum(a[1:], a[:-1])).all() for a in sizes)


def _result(k: KeptProgram, c: Compiled, found: _Found, mode: str | None, inertia: bool) -> Result:
    count = c.schedule.count
    out = found.out[:, :count]
    names = ("point", "turn", "twist", "acceleration", "force", "moment", "effort", "load")
    arrays: dict[str, Any] = {f"{name}_array": k.part(name, out) for name in names}
    return Result(
        compiled=c,
        inertia=inertia,
        mobility=Mobility(
            c.layout.unknowns - c.layout.constraints.count, len(c.schedule.names), 0, (), c.passive
        ),
        mode=mode,
        status=("ok",) * count,
        reasons=(None,) * count,
        rotation_array=k.part("rotation", out).swapaxes(1, 2),
        residual=found.residual[:count],
        power_balance=found.power[:count],
        **arrays,
    )
