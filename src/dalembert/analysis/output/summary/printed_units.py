"""The units of what is printed and drawn, and what of its numbers is nothing but rounding."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.columns import Scale, UnitChoice, drive_kinds
from dalembert.analysis.output.rounding import PART, cached, largest, sizes
from dalembert.arrays import Array, Numeric, Tree

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


class Printed(Scale):
    """The units of the file; angular rates to which it gives no unit of their own, in radians."""

    def text(self, kind: str) -> str:
        return super().text(kind) if self.bare(kind) else RADIANS[kind]

    def __call__(self, kind: str, values: Numeric) -> Numeric:
        return super().__call__(kind, values) if self.bare(kind) else values


RADIANS = {"angular_speed": "rad/s", "angular_acceleration": "rad/s^2"}


def print_scale(result: Result, units: UnitChoice) -> Printed:
    """The scale of a printed answer."""
    return Printed(None if units == "SI" else result.mechanism.units)


def without_reactions(result: Result) -> bool:
    """Whether the method has found none, as virtual work does, where there is an answer."""
    return bool(result.ok.any()) and not np.isfinite(result.force_array).any()


def motion_only(result: Result) -> bool:
    """Whether no force was asked for."""
    return without_reactions(result) and not np.isfinite(result.effort_array).any()


def significant(result: Result, kind: str, values: Array) -> Array:
    """Numbers of a kind, (P,) or (P, ...), or of the first position; those that are nothing but rounding as 0.

    >>> from dalembert.analysis import statics
    >>> from dalembert.model.library import four_bar
    >>> significant(statics(four_bar()), "force", np.array([1e-30, 5.0]))
    array([0., 5.])
    """
    small: Array = PART * cached(result, _largest).get(kind, np.zeros(len(result.status)))
    shape = np.shape(values)
    small = small.reshape(-1, *[1] * (len(shape) - 1)) if shape[:1] == small.shape else small[0]
    return np.where(np.abs(values) < small, 0.0, values)


def _largest(result: Result) -> Tree:
    """By kind the largest number at each position (P,): quicker than all that acts there."""
    d, length, many = result.compiled.layout.algebra.d, result.compiled.layout.length, len(result.status)
    angular = [drive_kinds(result, drive)["effort"] == "moment" for drive in result.drives]
    efforts = np.where(angular, result.effort_array / length, result.effort_array)
    force = largest(many, result.force_array, result.moment_array / length, efforts)
    if many == 1 or (force < 1e-9 * force.max()).any():  # what is left where loads balance each other
        return sizes(result)
    turning = largest(many, result.twist_array[..., d:])
    sliding = largest(many, result.twist_array[..., :d])
    return {
        "power": force * np.maximum(sliding, length * turning),
        "force": force,
        "moment": force * length,
        "angular_speed": turning,
        "angular_acceleration": np.maximum(largest(many, result.acceleration_array[..., d:]), turning**2),
    }
