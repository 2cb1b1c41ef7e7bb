"""The effort of a machine's drive as a continuous curve: the analysis itself, asked wherever a number is needed.

Mechanics: docs/theory.md 10.3.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import state
from dalembert.analysis.one_pass import at_schedule
from dalembert.arrays import Array
from dalembert.core.forcing import center_motion
from dalembert.errors import ModelError
from dalembert.machine.harmonics import whole_turns
from dalembert.machine.whole_cycle import refuse_unknown
from dalembert.model import Schedule
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result
    from dalembert.model import Mechanism


class TurningMoment:
    """Effort and reduced inertia of a machine with one turning drive, at any angle and speed."""

    def __init__(self, r: Result, drive: str | None = None) -> None:
        self.result, self.drive = r, _only_drive(r, drive)
        self.turns = whole_turns(r.drive_position(self.drive))
        self.speed = _steady_speed(r, self.drive)
        refuse_unknown(r, "a flywheel needs every position of the cycle", r.effort(self.drive))
        self.first = float(r.drive_position(self.drive)[0])
        m = r.mechanism
        self.smooth = m.with_values({"friction.enabled": False}) if r.friction is not None else None

    @property
    def edges(self) -> Array:
        """The positions of the result, and the end of the period, rising."""
        q = np.sort(self.result.drive_position(self.drive))
        return np.append(q, q[0] + 2 * np.pi * self.turns)

    def effort(
        self, q: Array, speed: Array | float, acceleration: Array | float = 0.0, inertia: bool = True
    ) -> Array:
        """Effort at angles (n,), with these speeds and accelerations."""
        return self._asked(self.result.mechanism, q, speed, acceleration, inertia).effort(self.drive)[1:]

    @property
    def floor(self) -> float:
        """An effort that is nothing but rounding beside the forces in the joints."""
        r = self.result
        force = np.nanmax(np.abs(r.force_array), initial=0.0) * r.compiled.layout.length
        moment = np.nanmax(np.abs(r.moment_array), initial=0.0)
        return 1e-13 * float(max(force, moment, np.abs(r.effort_array).max(initial=0.0)))

    def resistance(self, q: Array, speed: Array, acceleration: Array) -> Array:
        """The effort (n,) that does not go into kinetic energy: loads, weights, springs, dampers and friction."""
        if self.smooth is None:
            return self.effort(q, speed, acceleration, inertia=False)
        kinetic = [
            self._asked(self.smooth, q, speed, acceleration, on).effort(self.drive)[1:]
            for on in (True, False)
        ]
        return np.asarray(self.effort(q, speed, acceleration) - (kinetic[0] - kinetic[1]))

    def inertia(self, q: Array) -> Array:
        """Reduced inertia J (n,), kg m2."""
        return reduced_inertia(
            self._asked(self.smooth or self.result.mechanism, q, 1.0, 0.0, True), self.drive
        )[1:]

    def _asked(
        self, m: Mechanism, q: Array, speed: Array | float, acceleration: Array | float, inertia: bool
    ) -> Result:
        """The analysis at other angles; the result's own first position leads, so that the assembly mode is its own."""
        angle = np.concatenate([[self.first], q])
        rates = [np.broadcast_to(x, q.shape) for x in (speed, acceleration)]
        u, a = (np.concatenate([x[:1], x])[:, None] for x in rates)
        found = at_schedule(m, Schedule((self.drive,), angle[:, None], u, a), inertia)
        refuse_unknown(
            found, "a flywheel needs what is between the positions of the cycle", found.effort(self.drive)
        )
        return found


def reduced_inertia(r: Result, drive: str) -> Array:
    """What all links are as seen from a drive (P,), kg m2 or kg: twice the kinetic energy at its unit speed alone."""
    at, layout, masses = state(r), r.compiled.layout, r.compiled.forcing.inertia
    g, unit = layout.algebra, at.moving.virtual[..., r.drives.index(drive), :, :]
    v = center_motion(layout, masses, at.pose, unit, np.zeros_like(unit[..., :-1, :]))[1]
    w = unit[..., :-1, g.d :]
    turning = g.angular_momentum_rate(at.pose.rotation[..., :-1, :], w, masses.inertia) * w
    return np.asarray((masses.mass * (v * v).sum(axis=-1)).sum(axis=-1) + turning.sum(axis=(-2, -1)))


def _only_drive(r: Result, drive: str | None) -> str:
    if drive is not None and drive not in r.drives:
        raise ModelError(f"there is no drive {drive!r}", closest(drive, list(r.drives)))
    if len(r.drives) != 1 or r.unknown_loads or not r.compiled.known.asked.all():
        raise ModelError(
            "a flywheel steadies a machine of one drive, whose effort is asked for",
            "leave one drive, without effort, and no unknown load",
        )
    if not r.mechanism.drives[r.drives[0]].turns:
        raise ModelError(f"drive {r.drives[0]!r} slides, and a flywheel turns", "drive the shaft")
    return r.drives[0]


def _steady_speed(r: Result, drive: str) -> float:
    speed, acceleration = r.drive_speed(drive), r.drive_acceleration(drive)
    if np.ptp(speed) > 1e-9 * np.abs(speed).max() or acceleration.any() or not speed[0]:
        raise ModelError(
            f"drive {drive!r} does not turn at one speed, and a flywheel goes by the torque at a steady speed",
            "write one speed that is not 0, and no acceleration",
            ("drives", drive, "speed"),
        )
    return float(speed[0])
