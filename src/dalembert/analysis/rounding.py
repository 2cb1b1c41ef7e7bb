"""Which numbers of an answer are nothing but rounding: those that are small beside all that acts or moves there.

A number alone does not say so: 1e-15 N is rounding in a press and a force between molecules. So the sizes are those of
one position of one answer: the mechanism's length, its fastest turning, its largest force.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from dalembert.analysis.actions import actions

if TYPE_CHECKING:
    from dalembert.analysis.result import Result

PART = 1e-12
"""Of the size of its kind: what is smaller is rounding. Digits are good to 2e-16, and some are lost on the way."""


def least(r: Result, k: int) -> dict[str, float]:
    """By kind of number: what is smaller than this (SI) at a position is rounding.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> found = least(da.solve(da.load(examples()["four_bar"])), 0)
    >>> f"{found['force']:.0e} N beside 2764 N of inertia, {found['length']:.0e} m"
    '7e-10 N beside 2764 N of inertia, 5e-13 m'
    """
    return {kind: PART * size for kind, size in sizes(r, k).items()}


def sizes(r: Result, k: int) -> dict[str, float]:
    """By kind of number: the largest there is at a position, in SI; of forces and moments one size over the length."""
    length, origin = r.compiled.layout.length, np.asarray(r.compiled.origin)
    turning, rising = _rates(r, k)
    everything = actions(r)
    pull = _largest([a.force[k] for a in everything])
    twist = _largest([a.couple[k] for a in everything])
    given = r.compiled.forcing.inertia
    mass = max(_largest([given.mass]), _largest([given.inertia]) / length**2) if r.inertia else 0.0
    force = max(pull, twist / length, mass * length * turning**2)
    return {
        "angle": 1.0,
        "number": 1.0,
        "length": max(length, _largest([r.point_array[k] + origin])),
        "angular_speed": turning,
        "speed": turning * length,
        "angular_acceleration": rising,
        "acceleration": rising * length,
        "force": force,
        "moment": force * length,
        "power": force * length * turning,
    }


def _rates(r: Result, k: int) -> tuple[float, float]:
    """The fastest turning, and the largest second rate, a turning's own included; slides over the length."""
    d, length = r.compiled.layout.algebra.d, r.compiled.layout.length
    speeds = [r.twist_array[k, :, d:], r.twist_array[k, :, :d] / length, _drives(r, r.schedule.speed[k])]
    rates = [r.acceleration_array[k, :, d:], r.acceleration_array[k, :, :d] / length]
    turning = _largest(speeds)
    return turning, max(_largest([*rates, _drives(r, r.schedule.acceleration[k])]), turning**2)


def _drives(r: Result, rates: NDArray[Any]) -> NDArray[Any]:
    """Rates of the drives, those of slides over the length."""
    angular = r.compiled.layout.freedoms.angular[r.compiled.layout.driven]
    return np.where(angular, rates, rates / r.compiled.layout.length)


def _largest(arrays: list[NDArray[Any]]) -> float:
    return max((float(np.nan_to_num(np.abs(a)).max(initial=0.0)) for a in arrays), default=0.0)
