"""The units of a printed answer, and what of its numbers is nothing but rounding."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.columns import Scale, UnitChoice

if TYPE_CHECKING:
    from dalembert.analysis.result import Result


class Printed(Scale):
    """The units of the file, but angular rates in rad/s: a bare angular rate has no unit in a file."""

    def text(self, kind: str) -> str:
        return super().text(kind) if self.bare(kind) else RADIANS[kind]

    def __call__(self, kind: str, values: Any) -> Any:
        return super().__call__(kind, values) if self.bare(kind) else values


RADIANS = {"angular_speed": "rad/s", "angular_acceleration": "rad/s^2"}


def printed(result: Result, units: UnitChoice) -> Printed:
    """The scale of a printed answer."""
    return Printed(None if units == "SI" else result.mechanism.units)


def without_reactions(result: Result) -> bool:
    """Whether the method has found none, as virtual work does, where there is an answer."""
    return bool(result.ok.any()) and not np.isfinite(result.force_array).any()


def motion_only(result: Result) -> bool:
    """Whether no force was asked for."""
    return without_reactions(result) and not np.isfinite(result.effort_array).any()


def significant(result: Result, kind: str, values: Any) -> Any:
    """Numbers of a kind, those that are nothing but rounding beside the largest of the whole result as 0.

    >>> from dalembert.analysis import statics
    >>> from dalembert.model.library import four_bar
    >>> significant(statics(four_bar()), "force", np.array([1e-30, 5.0]))
    array([0., 5.])
    """
    d = result.compiled.layout.algebra.d
    beside = {
        "force": (result.force_array, result.moment_array, result.effort_array),
        "moment": (result.force_array, result.moment_array, result.effort_array),
        "angular_speed": (result.twist_array[..., d:],),
        "angular_acceleration": (result.acceleration_array[..., d:],),
    }.get(kind, ())
    largest = max(
        (float(np.nanmax(np.abs(a), initial=0.0)) for a in beside if np.isfinite(a).any()), default=0.0
    )
    return np.where(np.abs(values) < ROUNDING * largest, 0.0, values)


ROUNDING = 1e-14
"""Of the largest of its kind: what is smaller is 0."""
