"""Torque, speed and loss of a motor behind a gear along a motion under forces.

Mechanics: docs/theory.md 10.6.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from dalembert.answer.equality import Compared
from dalembert.arrays import Array
from dalembert.model.drives.motors import MotorCurve


@dataclass(frozen=True, eq=False)
class MotorUse(Compared):
    """A motor at the instants of a motion, arrays (T,) in SI, on the motor's shaft.

    speed: rad/s, or m/s where it drives a slide without a gear; torque: of its curve, N m or N; gear_torque: what its
    shaft gives to the gear, the torque less what its rotor takes; loss: power lost in the gear, W; power: of the curve.
    """

    speed: Array = field(repr=False)
    torque: Array = field(repr=False)
    gear_torque: Array = field(repr=False)
    loss: Array = field(repr=False)

    @property
    def power(self) -> Array:
        """Power of its torque (T,), W."""
        return self.torque * self.speed


def motor_use(motor: MotorCurve, effort: Array, speed: Array, acceleration: Array) -> MotorUse:
    """From the effort Q that the drive gets: X = Q/(eta n) where the power goes to the machine, eta Q/n where it comes
    back; T = X + J n a. At rest the sense is that in which the drive is accelerated.

    >>> found = motor_use(MotorCurve((0.0, 9.0), (8.0, 0.0), True, ratio=2.0, efficiency=0.5), *np.ones((3, 1)))
    >>> found.gear_torque, found.loss
    (array([1.]), array([1.]))
    """
    way = np.sign(effort * np.where(speed == 0, acceleration, speed))
    shaft = effort / (motor.ratio * motor.efficiency**way)
    turning = motor.ratio * speed
    torque = shaft + motor.inertia * motor.ratio * acceleration
    return MotorUse(turning, torque, shaft, shaft * turning - effort * speed)


class WithMotors:
    """A motion under forces, some of whose drives have motors."""

    moves: Any
    applied: Any
    schedule: Any

    @cached_property
    def motor(self) -> dict[str, MotorUse]:
        """Torque, speed and losses of each motor on the motor's shaft, by drive."""
        out, s = {}, self.schedule
        for name, drive in self.moves.m.drives.items():
            if drive.motor is not None:
                k = s.names.index(name)
                out[name] = motor_use(drive.motor, self.applied[:, k], s.speed[:, k], s.acceleration[:, k])
        return out
