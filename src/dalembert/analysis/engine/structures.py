"""Programs that are kept, by structure: those used last, for all threads."""

from __future__ import annotations

from collections import OrderedDict
from threading import Lock
from typing import NamedTuple

import numpy as np

from dalembert.algebra import plane
from dalembert.analysis.compile.compiled_mechanism import Compiled
from dalembert.analysis.engine.first_way import First, first_branch, remember
from dalembert.analysis.engine.flat_numbers import Numbers, flat_numbers, values
from dalembert.analysis.engine.force_program import ForceBlock, ForceProgram, force_blocks, trace_forces
from dalembert.analysis.engine.kept_program import (
    DeadCentreError,
    KeptProgram,
    TracedOutputs,
    trace_structure,
)
from dalembert.analysis.positions import mode_sentence
from dalembert.arrays import Array
from dalembert.core.factor import SPARSE
from dalembert.core.layout import Pose
from dalembert.core.position.first_pose_plane import Guess, phase_rows

BLOCK = 1024
"""Positions computed at once: their values stay in the cache."""

KEPT = 500_000
"""Largest number of operations of all kept programs, about 200 MB."""

FEW_LINKS, FEW_POSITIONS, OFTEN = 8, 50, 200
"""A structure of more links met for the first time, at fewer positions (twice as many where its matrix is not dense),
takes less time on the careful path than to trace: it is traced when it is met again, and of many links once more for
every ``OFTEN`` of them."""

TRACE = 8.0
"""Time that it takes to trace forces where poses are known, milliseconds a link."""

PIECES = 64
"""Pieces of a cam's lift beyond which its forces are not traced: each number would be an input."""

CALL, POSITION = 10.0, 0.03
"""Time of the careful path for these forces, milliseconds an analysis and a position: once it has taken as long as
tracing takes, a structure is traced."""


class _Met(NamedTuple):
    """Placeholder for a program of a structure that was met: the cost of the careful path so far, calls or
    milliseconds."""

    spent: float


Kept = KeptProgram | ForceProgram | _Met | None
"""A program, or none where a structure has none."""


class Structures:
    """Programs by structure, those used last; one lock for all threads."""

    def __init__(self) -> None:
        self.lock, self.found, self.size = Lock(), OrderedDict[object, Kept](), 0

    def get(self, key: object) -> tuple[bool, Kept]:
        with self.lock:
            try:
                self.found.move_to_end(key)
            except KeyError:
                return False, None
            return True, self.found[key]

    def put(self, key: object, program: Kept) -> None:
        with self.lock:
            self.size += _size(program) - (_size(self.found[key]) if key in self.found else 0)
            self.found[key] = program
            while self.size > KEPT and len(self.found) > 1:
                self.size -= _size(self.found.popitem(last=False)[1])


def _size(program: Kept) -> int:
    return len(program.graph.nodes) if isinstance(program, TracedOutputs) else 1


STRUCTURES = Structures()


class Ready(NamedTuple):
    """A structure's program with the numbers of one mechanism: single ones, columns (C, P), and its first pose."""

    program: KeptProgram
    single: list[float]
    columns: Array
    first: First


def ready(c: Compiled, inertia: bool) -> Ready | None:
    """The program of a planar mechanism; None where it has none, or none yet, or its first pose is in doubt."""
    if not _suits(c):
        return None
    numbers = flat_numbers(c)
    single, columns = values(numbers)
    key, inputs = (inertia, *numbers.key), [*single, *columns[:, 0].tolist()]
    met, program = STRUCTURES.get(key)
    if not met or isinstance(program, _Met):
        calls = program.spent + 1 if isinstance(program, _Met) else 0.0
        few = FEW_POSITIONS if c.layout.unknowns <= SPARSE else 2 * FEW_POSITIONS
        large = c.layout.links > FEW_LINKS and c.schedule.count < few
        if large and calls < 1 + c.layout.links // OFTEN:
            STRUCTURES.put(key, _Met(calls))
            return None
        try:
            program = _traced(c, numbers, inputs, inertia)
        except (DeadCentreError, ZeroDivisionError):  # or a length that its closed forms divide by is zero
            return None
        STRUCTURES.put(key, program)
    if not isinstance(program, KeptProgram):
        return None
    first = first_branch(program, c, inputs)
    return None if first is None else Ready(program, single, columns, first)


def _traced(c: Compiled, numbers: Numbers, inputs: list[object], inertia: bool) -> KeptProgram | None:
    """The program of a structure met for the first time: traced on the branches of its given angles, without a search,
    or in its first pose where they do not decide a branch; None where neither exists."""
    assert isinstance(c.guess, Guess)
    if np.isfinite(c.guess.turn[:-1]).any():
        turn = c.guess.angles(c.layout, c.first_target)
        try:
            program = trace_structure(c, numbers, Pose(c.guess.point, turn, plane.rotation(turn)), inertia)
        except (DeadCentreError, ZeroDivisionError):
            pass
        else:
            return program
    modes = c.first_modes
    if modes is None:
        raise DeadCentreError
    program = trace_structure(c, numbers, modes.pose.at(0), inertia)
    if program is not None:
        remember(
            program, c, inputs, First(program.branches, modes.pose.turn[0, :-1], mode_sentence(c, modes))
        )
    return program


def known_forces(c: Compiled, pose: Pose, inertia: bool) -> ForceBlock | None:
    """Motion and forces where the poses (P, L+1, ...) are known, by the structure's program; None where there is none,
    or none yet."""
    if (
        c.forcing.springs.area.any()
        or c.layout.redundant
        or not c.layout.square
        or (c.passive and c.contacts is not None)
    ):
        return None
    if c.forcing.turning is not None and c.forcing.turning.driven >= 0:
        return None
    if any(np.shape(getattr(f, "curve", ()))[1:2] > (PIECES,) for f in c.layout.constraints.families):
        return None
    if not np.isfinite(pose.point).all(axis=(1, 2)).any():
        return None
    numbers = flat_numbers(c, pose)
    key = (inertia, "forces", *numbers.key)
    met, program = STRUCTURES.get(key)
    if not met or isinstance(program, _Met):
        spent = (program.spent if isinstance(program, _Met) else 0.0) + CALL + POSITION * c.schedule.count
        if spent < TRACE * c.layout.links:
            STRUCTURES.put(key, _Met(spent))
            return None
        try:
            program = trace_forces(c, pose, numbers, inertia)
        except DeadCentreError:
            return None
        STRUCTURES.put(key, program)
    return force_blocks(c, program, numbers, BLOCK) if isinstance(program, ForceProgram) else None


def _suits(c: Compiled) -> bool:
    """True if a mechanism is of a kind whose programs are kept."""
    return (
        isinstance(c.guess, Guess)
        and not c.forcing.springs.area.any()  # whose exponents are no symbols
        and c.layout.square
        and not phase_rows(c.layout.constraints).size
        and bool(np.isfinite(c.schedule.position).all())
    )
