"""The effort of a machine's drive as a continuous curve: the analysis itself, asked wherever a number is needed.

Mechanics: docs/theory.md 10.3.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.methods.applied_forces import state
from dalembert.analysis.one_pass import at_poses, at_schedule
from dalembert.analysis.result.joint_freedoms import full_pose
from dalembert.arrays import Array
from dalembert.core.equilibrium import LinkMotions, known_sources, with_ground
from dalembert.core.forcing import WrenchSource, inertia_wrench, total_wrench
from dalembert.errors import ModelError
from dalembert.machine.harmonics import whole_turns
from dalembert.machine.whole_cycle import refuse_unknown
from dalembert.model import Schedule
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result


SURE = 1e4
"""Gap at the positions of a result, over rounding, up to which the powers at them give its effort."""


STEADY = 1e-9
"""Change of the speed, and acceleration over its square, that are the rounding of a law of the position."""


class TurningMoment:
    """Effort and reduced inertia of a machine with one turning drive, at any angle and speed.

    After an analysis at steady speed, the powers of inertia and dampers give the change at another speed, J a + J' w^2
    / 2 + S(w). Where other forces matter too, as with dry friction, the analysis is repeated in its poses.
    """

    def __init__(self, r: Result, drive: str | None = None) -> None:
        self.result, self.drive = r, _only_drive(r, drive)
        self.turns = whole_turns(r.drive_position(self.drive))
        self.speed = _steady_speed(r, self.drive)
        refuse_unknown(r, "a flywheel needs every position of the cycle", r.effort(self.drive))
        self.known, self.last = np.zeros((5, 0)), r
        self.smooth = r.friction is None and _gap(r) <= SURE * self.floor

    @property
    def edges(self) -> Array:
        """The positions of the result, and the end of the period, rising."""
        q = np.sort(self.result.drive_position(self.drive))
        return np.append(q, q[0] + 2 * np.pi * self.turns)

    @property
    def floor(self) -> float:
        """An effort that is nothing but rounding beside the forces in the joints."""
        r = self.result
        force = np.nanmax(np.abs(r.force_array), initial=0.0) * r.compiled.layout.length
        moment = np.nanmax(np.abs(r.moment_array), initial=0.0)
        return 1e-13 * float(max(force, moment, np.abs(r.effort_array).max(initial=0.0)))

    def steady(self, q: Array) -> Array:
        """Effort at angles (n,) at the steady speed."""
        result = self._required(q, self.speed, 0.0, self.result.inertia)
        effort, (inertia, change, damped) = result.effort(self.drive)[1:], powers(result)[:, 1:]
        still = effort - self.speed * (self.result.inertia * change * self.speed + damped)
        self.known = np.concatenate([self.known, [q, inertia, change, still, damped]], axis=1)
        return effort

    def effort(self, q: Array, speed: Array, acceleration: Array) -> Array:
        """Effort at angles (n,), with these speeds and accelerations."""
        reduced, change = self._parts(q)[:2]
        if self.smooth:
            inertial = reduced * acceleration + change * speed**2
            return np.asarray(inertial + self.resistance(q, speed, acceleration))
        return self._required(q, speed, acceleration, True).effort(self.drive)[1:]

    def resistance(self, q: Array, speed: Array, acceleration: Array) -> Array:
        """The effort (n,) that does not go into kinetic energy: loads, weights, springs, dampers and friction."""
        inertia, change, still, damped = self._parts(q)
        if self.smooth:
            return np.asarray(still + damped * speed)
        return np.asarray(self.effort(q, speed, acceleration) - inertia * acceleration - change * speed**2)

    def inertia(self, q: Array) -> Array:
        """Reduced inertia J (n,), kg m2."""
        return np.asarray(self._parts(q)[0])

    def _parts(self, q: Array) -> Array:
        """J, J' / 2, and what loads ask for, and dampers at a unit speed (4, n), at angles met."""
        order = np.argsort(self.known[0], kind="stable")
        place = order[np.searchsorted(self.known[0], q, sorter=order)]
        assert (self.known[0, place] == q).all()
        return self.known[1:, place]

    def _required(self, q: Array, speed: Array | float, acceleration: Array | float, inertia: bool) -> Result:
        """The analysis at other angles; the result's first position leads, so that the assembly mode is the same."""
        angle = np.append(self.result.drive_position(self.drive)[:1], q)[:, None]
        rates = (np.broadcast_to(x, q.shape) for x in (speed, acceleration))
        u, a = (np.append(x[:1], x)[:, None] for x in rates)
        schedule = Schedule((self.drive,), angle, u, a)
        if np.array_equal(self.last.schedule.position, angle):
            c = replace(self.last.compiled, schedule=schedule)
            result = at_poses(c, self.last, slice(None), inertia)
        else:
            self.last = result = at_schedule(self.result.mechanism, schedule, inertia)
        refuse_unknown(
            result, "a flywheel needs what is between the positions of the cycle", result.effort(self.drive)
        )
        return result


def powers(r: Result) -> Array:
    """Terms (3, P) of the effort of the lone drive of a result without accelerations: for a unit acceleration, the
    reduced inertia J; for the square of a unit speed, J' / 2; and for dampers at a unit speed."""
    f, pose, speed = r.compiled.forcing, full_pose(r), r.schedule.speed[..., None]
    unit, second = with_ground(r.twist_array) / speed, r.acceleration_array / speed**2

    def inertia(twist: Array, acceleration: Array) -> Array:
        return _required_by(r, unit, inertia_wrench(r.compiled.layout, f.inertia, pose, twist, acceleration))

    damped = np.zeros(len(speed))
    if f.springs.damping.any() or f.resistances.damping.any():
        damped = _loads(r, unit, unit) - _loads(r, unit, 0 * unit)
    return np.array([inertia(0 * unit, unit[:, :-1]), inertia(unit, second), damped])


def _loads(r: Result, unit: Array, twist: Array) -> Array:
    """Effort of the drive (P,) due to loads, weights, springs and dampers at twists of the links."""
    c, moving = r.compiled, LinkMotions(twist, twist, twist, np.ones(len(twist)))
    return _required_by(
        r, unit, *known_sources(c.layout, c.forcing, full_pose(r), moving, inertia=False).values()
    )


def _required_by(r: Result, unit: Array, *sources: WrenchSource) -> Array:
    """Effort of the drive (P,) due to wrenches, by their power at its unit speed."""
    return np.asarray(-(unit[:, :-1] * total_wrench(r.compiled.layout, *sources)).sum(axis=(1, 2)))


def _gap(r: Result) -> float:
    """By how much the effort of a result at steady speed is not what the powers say."""
    speed = r.schedule.speed[:, 0]
    change, unit = r.inertia * powers(r)[1], with_ground(r.twist_array) / speed[:, None, None]
    expected = change * speed**2 + _loads(r, unit, with_ground(r.twist_array))
    return float(np.nan_to_num(np.abs(expected - r.effort_array[:, 0]), nan=np.inf).max())


def reduced_inertia(r: Result, drive: str) -> Array:
    """Inertia of all links reduced to a drive (P,), kg m2 or kg: twice the kinetic energy at its unit speed alone."""
    at, layout, masses = state(r), r.compiled.layout, r.compiled.forcing.inertia
    unit = at.moving.virtual[..., r.drives.index(drive), :, :]
    return _required_by(r, unit, inertia_wrench(layout, masses, at.pose, 0 * unit, unit[..., :-1, :]))


def _only_drive(r: Result, drive: str | None) -> str:
    if drive is not None and drive not in r.drives:
        raise ModelError(f"unknown drive {drive!r}", closest(drive, list(r.drives)))
    if len(r.drives) != 1 or r.unknown_loads or not r.compiled.known.requested.all():
        raise ModelError(
            "a flywheel needs a machine with one drive, whose effort is unknown",
            "leave one drive, without effort, and no unknown load",
        )
    if not r.mechanism.drives[r.drives[0]].turns:
        raise ModelError(f"drive {r.drives[0]!r} slides, and a flywheel turns", "drive the shaft")
    return r.drives[0]


def _steady_speed(r: Result, drive: str) -> float:
    speed, acceleration = r.drive_speed(drive), r.drive_acceleration(drive)
    most = float(np.abs(speed).max())
    if not most or np.ptp(speed) > STEADY * most or np.abs(acceleration).max() > STEADY * most**2:
        raise ModelError(
            f"drive {drive!r} does not turn at constant speed, which sizing a flywheel assumes",
            "give it a speed other than 0, and no acceleration",
            ("drives", drive, "speed"),
        )
    return float(speed[0])
