"""Speeds and torque of the shaft that turns a plane, of a result.

Mechanics: docs/theory.md 4.1.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import state
from dalembert.arrays import Array
from dalembert.core.elements.turning_frame import centrifugal, second_moment, turning_square
from dalembert.core.equilibrium import known_sources
from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


def turning_speed(r: Result) -> Array:
    """Angular speed (P,), given or solved; NaN where a position has no answer."""
    with np.errstate(all="ignore"):
        return np.sqrt(_square(r))


def turning_interval(r: Result) -> Array:
    """Low and high (P, 2) of the speeds at which friction holds the machine, else one number twice."""
    speed = turning_speed(r)
    if not r.ends:
        return np.stack([speed, speed], axis=-1)
    ends = np.array([turning_speed(end) for pair in r.ends for end in pair])
    return np.stack([ends.min(axis=0), ends.max(axis=0)], axis=-1)


def turning_torque(r: Result) -> Array:
    """dH/dt (P,) of H = J W, J that of all links about the axis."""
    square, turning, s, c = _square(r), r.mechanism.turning, state(r), r.compiled
    frame, inertia = c.forcing.turning, c.forcing.inertia
    assert frame is not None
    assert turning is not None
    unit = centrifugal(c.layout, inertia, frame, s.pose, np.ones(1))
    rate = 2 * (unit.wrench * s.moving.twist[..., :-1, :]).sum(axis=(-2, -1))  # of J
    moment = second_moment(c.layout, inertia, frame, s.pose)
    with np.errstate(all="ignore"):
        return np.asarray(moment * turning.acceleration + rate * np.sqrt(square))


def _square(r: Result) -> Array:
    """Square (P,) of the speed."""
    c = r.compiled
    frame = c.forcing.turning
    if frame is None:
        what = "the plane of this mechanism does not turn"
        raise ModelError(what, "give it turning: {axis: y, speed: 180 rpm}")
    if frame.driven < 0:
        return frame.square
    s = state(r)
    with np.errstate(all="ignore"):
        forcing = replace(c.forcing, turning=None)
        sources = known_sources(c.layout, forcing, s.pose, s.moving, r.inertia)
        square = turning_square(c.layout, c.forcing, s.pose, s.moving.virtual, sources)
    return np.where(r.ok, square, np.nan)
