"""Decides which numbers of an answer are only rounding: those small beside all forces or rates at the position.

A number alone does not show it: 1e-15 N is rounding in a press and a force between molecules. So the sizes are those of
one position of one answer: the mechanism's length, its fastest turning, its largest force.
Mechanics: docs/theory.md 1.2.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import actions
from dalembert.analysis.result.kept import kept
from dalembert.arrays import Array

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


PART = 1e-12
"""Relative size below which a number is rounding. Digits are good to 2e-16, and some are lost in the computation."""


def least(r: Result, k: int) -> dict[str, float]:
    """By kind of number: what is smaller than this (SI) at a position is rounding.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> found = least(da.solve(da.load(examples()["four_bar"])), 0)
    >>> f"{found['force']:.0e} N beside 2764 N of inertia, {found['length']:.0e} m"
    '7e-10 N beside 2764 N of inertia, 5e-13 m'
    """
    return {kind: PART * float(size[k]) for kind, size in sizes(r).items()}


@kept
@np.errstate(all="ignore")
def sizes(r: Result) -> dict[str, Array]:
    """By kind of number: the largest there is at each position (P,), in SI; of forces and moments one size over the
    length. Kept with the result, as every number that is printed asks for it."""
    length, many = r.compiled.layout.length, len(r.status)
    turning, rising = _rates(r)
    everything, inertia = actions(r), r.compiled.forcing.inertia
    mass = max(
        float(np.max(inertia.mass, initial=0.0)),
        float(np.max(inertia.inertia, initial=0.0)) / length / length,
    )
    heavy = mass * length * turning**2 if r.inertia else np.zeros(many)
    force = largest(many, heavy, *(a.force for a in everything), *(a.couple / length for a in everything))
    return {
        "angle": np.ones(many),
        "number": np.ones(many),
        "length": largest(many, np.full(many, length), r.point_array + np.asarray(r.compiled.origin)),
        "angular_speed": turning,
        "speed": turning * length,
        "angular_acceleration": rising,
        "acceleration": rising * length,
        "force": force,
        "moment": force * length,
        "power": force * length * turning,
    }


def _rates(r: Result) -> tuple[Array, Array]:
    """The fastest turning, and the largest second rate, including centripetal terms of turning; slides over the
    length."""
    d, length, many = r.compiled.layout.algebra.d, r.compiled.layout.length, len(r.status)
    angular = r.compiled.layout.freedoms.angular[r.compiled.layout.driven]

    def fastest(rates: Array, drives: Array) -> Array:
        return largest(
            many, rates[..., d:], rates[..., :d] / length, np.where(angular, drives, drives / length)
        )

    turning = fastest(r.twist_array, r.schedule.speed)
    return turning, np.maximum(fastest(r.acceleration_array, r.schedule.acceleration), turning**2)


def largest(many: int, *arrays: Array) -> Array:
    """The largest number of some arrays (P, ...) at each of many positions."""
    flat = [np.nan_to_num(np.abs(a)).reshape(many, -1) for a in arrays]
    peaks: Array = np.max([a.max(axis=1, initial=0.0) for a in flat], axis=0, initial=0.0)
    return peaks
