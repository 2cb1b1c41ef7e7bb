"""Programs that are kept, by structure: those used last, for all threads."""

from __future__ import annotations

from collections import OrderedDict
from threading import Lock
from typing import Any, NamedTuple

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.analysis.engine.first_way import First, first_way, remember
from dalembert.analysis.engine.flat_numbers import flat_numbers, values
from dalembert.analysis.engine.kept_program import DeadCentreError, KeptProgram, trace_structure
from dalembert.analysis.positions import mode_sentence
from dalembert.arrays import Array
from dalembert.core.position.first_pose_plane import Guess, phase_rows

KEPT = 500_000
"""Operations of all programs that are kept: so many take about 200 MB."""

FEW_LINKS, FEW_POSITIONS = 8, 50
"""A structure of more links met for the first time, at fewer positions, takes less time on the careful path than to
trace: it is traced when it is met again."""


class _Met:
    """Stands for a program where a structure was met once."""


MET = _Met()


Kept = KeptProgram | _Met | None
"""A program, or none where a structure has none."""


class Structures:
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
            size = sum(map(_size, self.found.values()))
            while size > KEPT and len(self.found) > 1:
                size -= _size(self.found.popitem(last=False)[1])


def _size(program: Kept) -> int:
    return len(program.graph.nodes) if isinstance(program, KeptProgram) else 1


STRUCTURES = Structures()


class Ready(NamedTuple):
    """A structure's program with the numbers of one mechanism: single ones, columns (C, P), and its first pose."""

    program: KeptProgram
    single: list[float]
    columns: Array
    first: First


def ready(c: Compiled, inertia: bool) -> Ready | None:
    """The program of a mechanism of the plane; None where there is none, or none yet, or its first pose is in doubt."""
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
    first = None if program is None else first_way(program, c, given)
    return None if first is None or program is None else Ready(program, single, columns, first)


def _suits(c: Compiled) -> bool:
    """Whether a mechanism is of a kind that programs are kept of."""
    stack = c.layout.stack
    return (
        isinstance(c.guess, Guess)
        and not c.layout.redundant
        and stack.count == c.layout.unknowns
        and not phase_rows(c.layout.constraints).size
        and bool(np.isfinite(c.schedule.position).all())
    )
