"""The general executor for the designs that a kernel is not sure of, answering by the same names."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dalembert.analysis.batch.answer import CODES
from dalembert.analysis.batch.symbols import Number, with_numbers
from dalembert.analysis.result import Result
from dalembert.analysis.solve import at_schedule
from dalembert.errors import DalembertError
from dalembert.model import Mechanism, Schedule

Array = NDArray[Any]


def answered(
    m: Mechanism, numbers: Sequence[Number], values: Array, schedule: Schedule, inertia: bool
) -> tuple[NDArray[np.uint8], Result | None]:
    """Codes (position,) of one design, and its result; all failed, and none, where the design is refused."""
    count = len(schedule.position)
    if not np.isfinite(values).all():
        return np.full(count, CODES.index("failed"), np.uint8), None
    try:
        design = with_numbers(m, numbers, values.tolist())
        result = at_schedule(design, _schedule(design, schedule), inertia)
    except DalembertError:
        return np.full(count, CODES.index("failed"), np.uint8), None
    marks = [CODES.index(s) if s in CODES else CODES.index("failed") for s in result.status]
    return np.array(marks, np.uint8), result


def _schedule(design: Mechanism, schedule: Schedule) -> Schedule:
    """The positions asked for, at the design's own speeds."""
    own, count = design.schedule(), len(schedule.position)
    rates = [a if len(a) == count else np.repeat(a[:1], count, axis=0) for a in (own.speed, own.acceleration)]
    return replace(schedule, speed=rates[0], acceleration=rates[1])


def quantity(result: Result, output: str) -> Array:
    """One output of a result (position, component)."""
    kind, _, of = output.partition(".")
    found = np.asarray(_KINDS[kind](result, of))
    return found.reshape(len(found), -1)


def _magnitude(r: Result, joint: str) -> Array:
    return np.asarray(np.hypot(*np.moveaxis(r.reaction(joint), -1, 0)))


_KINDS: dict[str, Callable[[Result, str], Any]] = {
    "effort": lambda r, of: r.effort(of),
    "load": lambda r, of: r.unknown_load(of),
    "reaction": lambda r, of: r.reaction(of),
    "magnitude": _magnitude,
    "moment": lambda r, of: r.reaction_moment(of),
    "angle": lambda r, of: r.angle(of),
    "speed": lambda r, of: r.speed(of),
    "acceleration": lambda r, of: r.acceleration(of),
    "position": lambda r, of: r.position(of),
    "velocity": lambda r, of: r.velocity(of),
    "center": lambda r, of: r.center(of),
    "center_velocity": lambda r, of: r.center_velocity(of),
    "center_acceleration": lambda r, of: r.center_acceleration(of),
    "point": lambda r, of: r.point(*of.split(".", 1)),
    "point_velocity": lambda r, of: r.point_velocity(*of.split(".", 1)),
    "point_acceleration": lambda r, of: r.point_acceleration(*of.split(".", 1)),
    "residual": lambda r, of: r.residual,
}
