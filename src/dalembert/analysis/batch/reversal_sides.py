"""Positions where contacts reverse, in a kernel: numbers just before and just after, by a separate program.

Its additional input is the side; senses are those of the second rates, as in `core.friction.reversal`.
"""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.batch.batch_result import BLOCK, CODES, NUMBERED, among, first_mark
from dalembert.analysis.batch.careful_path import reduce_design
from dalembert.analysis.batch.sides import Sides
from dalembert.analysis.batch.tracing.course import PositionPath
from dalembert.arrays import Array, Ints

if TYPE_CHECKING:
    from dalembert.analysis.batch.compiled_kernel import Kernel

AT_REST, LOCKED, REVERSAL, UNDECIDED = map(CODES.index, ("at_rest", "self_locking", "reversal", "undecided"))
BUILDING = threading.Lock()
"""One thread compiles."""


def settle_reversals(
    k: Kernel, values: Array, course: PositionPath, answer: Sides, threads: int | None
) -> None:
    """Replaces the status `at_rest` by both sides of a reversal where the machine moves; without second rates it
    stays. Positions where the law of a drive jumps are left to the general executor."""
    moves, jumps = course.schedule.moves, course.schedule.jumps.any(axis=1)
    if k.trace.inertia and jumps.any():
        answer.code[... if k.reduce else (slice(None), jumps)] = UNDECIDED
    if k.reduce is None:
        designs, positions = np.nonzero((answer.code == AT_REST) & moves)
        if len(designs):
            _settle_pairs(k, values, course, answer, designs, positions, threads)
    elif moves.any():
        _settle_reduced(k, values, course, answer, np.flatnonzero(answer.code == AT_REST), threads)


def _settle_pairs(
    k: Kernel,
    values: Array,
    course: PositionPath,
    answer: Sides,
    designs: Ints,
    positions: Ints,
    threads: int | None,
) -> None:
    with BUILDING:
        runner, side = k.runner.sided.runner, k.runner.sided.trace.inputs.side()
        program, machine, _ = runner.machine("pairs")
        columns, common = runner.inputs(program, course)
    used = program.inputs_in_use("channel")
    if side not in used:  # no output or mark depends on it
        return
    column = used.index(side)
    both = []
    for sign in (-1.0, 1.0):
        columns_ = columns[positions]
        columns_[:, column] = sign
        both.append(runner.at_pairs(program, machine, values[designs], columns_, common, threads))
    good = np.logical_and.reduce(
        [among(code, (0, LOCKED)) & np.isfinite(out).all(axis=1) for out, code in both]
    )
    if not good.any():
        return
    locked = (both[0][1] == LOCKED) | (both[1][1] == LOCKED)
    here = designs[good], positions[good]
    answer.code[here] = np.where(locked, LOCKED, REVERSAL)[good]
    answer.open_after()
    places = ((answer.arrays, answer.rates), (answer.after, answer.after_rates))
    for wholes, (out, _) in zip(places, both, strict=True):
        for target, part in zip(wholes, runner.by_output(out[good].T[None]), strict=True):
            for name, numbers in part.items():
                target[name][here] = numbers[0]


def _settle_reduced(
    k: Kernel, values: Array, course: PositionPath, answer: Sides, designs: Ints, threads: int | None
) -> None:
    """Reductions of some designs, from both sides of all their positions."""
    plain, count = k.runner.unreduced, len(course.schedule.position)
    step = max(1, BLOCK // (8 * max(1, len(plain.flat)) * count))
    for some in np.split(designs, range(step, len(designs), step)):
        r = plain.answer(values[some], course, threads, redo=False)
        after = r.after or r
        answer.code[some] = first_mark(r.code)
        for n, d in enumerate(some):
            if answer.code[d] in NUMBERED:
                sides = [
                    {name: a[n].reshape(len(a[n]), -1) for name, a in of.arrays.items()} for of in (r, after)
                ]
                rates = [_rates(of.gradients, sides[0], n) for of in (r, after)]
                reduce_design(k, int(d), sides, rates, answer, course)


def _rates(gradients: dict[str, Array], like: dict[str, Array], n: int) -> dict[str, Array]:
    """Derivatives (position, component, number) of one design."""
    return {name: a[n].reshape(*like[name].shape, -1) for name, a in gradients.items()}
