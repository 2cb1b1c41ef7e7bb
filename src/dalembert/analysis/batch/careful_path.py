"""The general executor for the designs that a kernel is not sure of, answering by the same names.

It gives no derivatives: those are one step of the compiled equations from its solution.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from dalembert.analysis.batch import over_positions
from dalembert.analysis.batch.batch_result import CODES, NUMBERED, first_mark
from dalembert.analysis.batch.sides import Sides
from dalembert.analysis.batch.tracing.course import PositionPath
from dalembert.analysis.batch.tracing.symbolic_model import VariedNumber, with_numbers
from dalembert.analysis.one_pass import at_schedule
from dalembert.analysis.result.named_quantities import quantity as read_quantity
from dalembert.analysis.result.result import Result
from dalembert.arrays import Array, Flags
from dalembert.errors import FORCED, DalembertError
from dalembert.model import Mechanism, Schedule

if TYPE_CHECKING:
    from dalembert.analysis.batch.compiled_kernel import Kernel


AGREES = 1e-8
"""Difference of the compiled equations from the general executor's value, over the largest value of an output along the
motion, above which they are not used for its derivative."""

NOTHING = 1e-4
"""An output below this part of the largest one is compared with that."""


def redone(
    k: Kernel,
    d: int,
    values: Array,
    course: PositionPath,
    undecided: Flags,
    answer: Sides,
) -> None:
    """Put the general executor's answer for design ``d`` in its place: where it is undecided or out of reach of any
    motion, or all of it reduced."""
    code = answer.code
    codes, result = analyse_design(k.mechanism, k.trace.numbers, values, course, k.trace.inertia)
    if k.trace.redundant:  # the outputs there are unique
        codes = np.where(codes == CODES.index("redundant"), np.uint8(0), codes)
    here = undecided | (codes == CODES.index("not_assembled")) | bool(k.reduce)
    for rates in (answer.rates, answer.after_rates):
        for rate in rates.values():
            rate[d][... if k.reduce else here] = np.nan
    code[d] = first_mark(codes) if k.reduce else np.where(here, codes, code[d])
    if result is None or (k.reduce and code[d] not in NUMBERED):
        return
    sides = [{name: quantity(side, name) for name in k.outputs} for side in result.sides]
    numbered = bool(np.isin(codes[here], NUMBERED).any())
    slopes_: list[dict[str, Array]] = [{} for _ in sides]
    if answer.rates and numbered:
        schedules = (course.schedule, course.schedule.just_after)
        courses = [
            replace(course, schedule=s, result=r) for s, r in zip(schedules, result.sides, strict=False)
        ]
        slopes_ = [slopes(k, values, c, one, here) for c, one in zip(courses, sides, strict=True)]
    if k.reduce:
        reduce_design(k, d, sides, slopes_, answer, course)
        return
    if len(sides) > 1:
        answer.open_after()
    places = ((answer.arrays, answer.rates), (answer.after, answer.after_rates))
    for n, (arrays, rates) in enumerate(places[: 1 + bool(answer.after)]):
        for name, value in sides[min(n, len(sides) - 1)].items():
            arrays[name][d, here] = value[here].reshape(arrays[name][d, here].shape)
        for name, rate in slopes_[min(n, len(sides) - 1)].items():
            rates[name][d, here] = rate.reshape(rates[name][d, here].shape)


def breaks(k: Kernel) -> bool:
    """True if by the file's numbers a position closes to which no motion leads from the others, or one that closes does
    not by the kernel, of redundant constraints: then the motion of each design decides."""
    course = k.trace.course
    lost = ~np.isfinite(course.pose.point).all(axis=(1, 2))
    if not (lost.any() or k.trace.redundant):
        return False
    single = k if k.reduce is None else replace(k, reduce=None, derivatives=False)
    code = single.runner("cpu", k.nominal[None], course, None, None, None)[0][0]
    open_ = code == CODES.index("not_assembled")
    return bool((np.isin(code, NUMBERED) & lost | open_ & ~lost).any())


def reduce_design(
    k: Kernel,
    d: int,
    sides: list[dict[str, Array]],
    rates: list[dict[str, Array]],
    answer: Sides,
    course: PositionPath,
) -> None:
    """Reductions over the positions, those with two numbers taken twice."""
    assert k.reduce is not None
    cycle = k.reduce in over_positions.REFINED and course.cycle
    if course.target is not None:
        sides = [{name: side[name] - course.target[name] for name in side} for side in sides]
    for name, array in answer.arrays.items():
        values = [side[name] for side in sides]
        array[d] = over_positions.reduce_sides(k.reduce, values, cycle).reshape(array[d].shape)
        if rates[0]:
            each = [side[name] for side in rates]
            value, rate = np.concatenate(values), np.concatenate(each)
            if k.reduce in over_positions.REFINED:
                value, rate = (over_positions.larger_side(values, some) for some in (values, each))
            slope = over_positions.slope(k.reduce, value, rate, cycle)
            slope = slope / len(sides) if k.reduce == "squares" else slope
            answer.rates[name][d] = slope.reshape(answer.rates[name][d].shape)


def slopes(
    k: Kernel, values: Array, course: PositionPath, outputs: dict[str, Array], here: Flags
) -> dict[str, Array]:
    """Derivatives (position, component, number) at some positions of a course that has been solved; NaN in doubt."""
    runner = k.general_program.runner
    program, machine, _ = runner.machine("pairs")
    columns, common = runner.inputs(program, course)
    many = np.repeat(values[None], here.sum(), axis=0)
    out, doubt = runner.at_pairs(program, machine, many, columns[here], common, 1)
    again, rates = runner.by_output(out.T[None])
    largest = max(np.nanmax(np.abs(value), initial=0.0) for value in outputs.values())
    for name, value in outputs.items():
        size = max(np.nanmax(np.abs(value), initial=0.0), NOTHING * largest)
        off = np.abs(again[name].reshape(value[here].shape) - value[here]).max(axis=1)
        rates[name] = rates[name].reshape((*value[here].shape, -1))
        rates[name][~(np.isin(doubt, NUMBERED) & (off <= AGREES * size))] = np.nan
    return dict(rates)


def analyse_design(
    m: Mechanism, numbers: Sequence[VariedNumber], values: Array, course: PositionPath, inertia: bool
) -> tuple[NDArray[np.uint8], Result | None]:
    """Codes (position,) of one design, and its result; all failed, and none, where the design is refused."""
    schedule = course.schedule
    count = len(schedule.position)
    if not np.isfinite(values).all():
        return np.full(count, CODES.index("failed"), np.uint8), None
    try:
        design = course.in_mode(with_numbers(m, numbers, values.tolist()))
        result = at_schedule(design, _schedule(design, schedule), inertia, method="careful")
    except DalembertError:
        return np.full(count, CODES.index("failed"), np.uint8), None
    codes = [CODES.index(s) for s in result.status]
    return np.array(codes, np.uint8), result


def _schedule(design: Mechanism, schedule: Schedule) -> Schedule:
    """Requested positions, at the speeds of the design."""
    nominal, count = design.schedule(), len(schedule.position)
    rates = [
        a if len(a) == count else np.repeat(a[:1], count, axis=0)
        for a in (nominal.speed, nominal.acceleration)
    ]
    after = nominal.after if nominal.after is not None and len(nominal.after) == count else None
    return replace(schedule, speed=rates[0], acceleration=rates[1], after=after)


def quantity(result: Result, output: str) -> Array:
    """One output of a result (position, component)."""
    values = read_quantity(result, output).values
    return values.reshape(len(values), -1)


def solved_quantities(side: Result, names: Iterable[str]) -> list[Array]:
    """Its quantities, as of a kernel NaN where it has no forces."""
    lost = ~np.isin(side.codes, FORCED)
    values = [np.array(side[name], float) for name in names]
    for of in values:
        of[lost] = np.nan
    return values
