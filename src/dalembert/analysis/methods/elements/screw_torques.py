"""Torques of power screws, for numbers and nodes alike, and what a result says of one.

Mechanics: docs/theory.md 10.12. Source: Budynas and Nisbett, Shigley's Mechanical Engineering Design, section 8-2.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.answer.equality import Compared
from dalembert.arrays import Array, Numeric
from dalembert.core.branchless import sign
from dalembert.errors import ModelError
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism


@dataclass(frozen=True, eq=False)
class ScrewAnswer(Compared):
    """A screw along a result, arrays (P,) in SI, positive with the slide.

    force: on the nut, N; torque: of the screw, N m, at rest that without friction; torque_low, torque_high: at rest the
    interval in which friction holds it; turning: its speed, rad/s; efficiency: power that goes out over what goes in, 0
    where neither side gives any. self_locking: thread and collar hold any force.
    """

    name: str
    force: Array = field(repr=False)
    torque: Array = field(repr=False)
    torque_low: Array = field(repr=False)
    torque_high: Array = field(repr=False)
    turning: Array = field(repr=False)
    efficiency: Array = field(repr=False)
    locking_coefficient: float
    self_locking: bool


def screws(m: Mechanism) -> dict[str, Any]:
    """Screws of a mechanism, by their drives."""
    return {name: d.screw for name, d in m.drives.items() if d.screw is not None}


def screw_torque(s: Any, force: Numeric, sense: Numeric) -> Numeric:
    """Torque F r tan(lambda +- phi') +- mu_c |F| r_c for a force and the sign of the motion; at rest without friction.

    tan phi' = mu/cos b_n; the upper signs where the screw drives.
    """
    slope, mu = s.slope, 0.0 if s.friction is None else s.friction.coefficient / s.flank
    way = sign(np.asarray(force)) * sense
    thread = force * s.radius * (slope + way * mu) / (1.0 - slope * mu * way)
    collar = 0.0 if s.collar is None else s.collar.coefficient * s.collar.radius
    return thread + collar * np.abs(force) * sense


def drive_torque(r: Any, name: str) -> Numeric:
    """Torque of the screw of a drive."""
    return screw_torque(r.mechanism.drives[name].screw, r.effort(name), sign(np.asarray(r.drive_speed(name))))


def screw(r: Result, name: str) -> ScrewAnswer:
    """Torque, efficiency and locking of a drive's screw; raises ModelError for a drive without one.

    >>> import dalembert as da
    >>> links = {"ground": {"points": {"O": [0, 0]}}, "nut": {"points": {"N": [0, 0]}}}
    >>> guide = {"type": "slider", "links": ["ground", "nut"], "at": ["O", "N"]}
    >>> turned = {"lead": 0.008, "radius": 0.015, "friction": {"coefficient": 0.08}}
    >>> load = {"type": "force", "on": "nut", "at": "N", "value": [-6400, 0]}
    >>> drive = {"position": 0, "speed": 0.01, "screw": turned}
    >>> m = {"links": links, "joints": {"S": guide}, "drives": {"S": drive}, "loads": {"W": load}}
    >>> da.statics(da.mechanism(m)).screw("S").torque.round(4)
    array([15.937])
    """
    known = screws(r.mechanism)
    if name not in known:
        what = f"drive {name!r} has no screw"
        raise ModelError(
            what, closest(name, list(known)) if known else "write screw: {...} of a drive that slides"
        )
    s, force, speed = known[name], r.effort(name), r.drive_speed(name)
    torque = np.asarray(drive_torque(r, name))
    ends = [
        np.asarray(screw_torque(s, force, np.where(speed == 0, way, np.sign(speed)))) for way in (-1.0, 1.0)
    ]
    turning = speed * 2 * np.pi / s.advance
    screwed, moved = torque * turning, force * speed
    into, out = np.maximum(screwed, 0) + np.maximum(-moved, 0), np.maximum(moved, 0) + np.maximum(-screwed, 0)
    with np.errstate(invalid="ignore", divide="ignore"):
        efficiency = np.where(into > 0, out / into, np.nan)
    locks = bool(screw_torque(s, np.array(1.0), np.array(-1.0)) <= 0)
    low, high = np.minimum(*ends), np.maximum(*ends)
    return ScrewAnswer(name, force, torque, low, high, turning, efficiency, s.locking_coefficient, locks)
