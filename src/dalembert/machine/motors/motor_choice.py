"""A motor for a drive: its torque over the cycle behind a gear, T_m = J_m n alpha + T / (n eta).

T is the drive's effort, n the gear ratio (speed of the motor over that of the drive), J_m the motor's inertia. The
efficiency eta divides where the drive takes power and multiplies where it returns power. Over log n every |T_m| has one
minimum, and so has the greatest of them.

Mechanics: docs/theory.md 10.5.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.answer.column import Axes, Column, Scale
from dalembert.arrays import Array, Ints, Tree
from dalembert.bounds import require
from dalembert.errors import ModelError
from dalembert.machine.flywheel.turning_moment import reduced_inertia
from dalembert.machine.motors.motor_curves import read_curve
from dalembert.machine.output.machine_answer import MachineAnswer
from dalembert.machine.whole_cycle import durations, sampling
from dalembert.model.drives.motors import MotorCurve
from dalembert.wording import closest

if TYPE_CHECKING:
    from dalembert.analysis.output.summary.printed_units import Printed
    from dalembert.analysis.result.result import Result
    from dalembert.printing import Part
    from dalembert.reports.sheet import ReportSheet
    from dalembert.views.notation import Notation, Shown
    from dalembert.views.paper.scene import Scene

RANGE = 1e4
"""Ratios are sought so far below and above the one of least rms torque."""


@dataclass(frozen=True)
class Need:
    """Requirement on the motor behind a gear: rms and greatest torque (N m), speed (rad/s); whether the motor meets
    it."""

    ratio: float
    rms: float
    torque: float
    speed: float
    enough: bool | None


@dataclass(frozen=True, eq=False)
class MotorChoice(MachineAnswer):
    """Effort (P,) of a drive, its speed and acceleration, and the inertia (P,) of all links as seen from it.

    ``time`` (P,), s: duration represented by each position. ``motor_inertia`` J_m, kg m2; ``curve``: the greatest
    torque over the speed; ``rated``: the continuous torque, compared with the rms, N m. ``needs``: requirements by
    name, of ratios.

    >>> import dalembert as da
    >>> c = da.motor(da.dynamics(da.slider_crank()), inertia=1e-4)
    >>> c.effort.shape
    (72,)
    """

    result: Result = field(repr=False)
    drive: str
    effort: Array = field(repr=False)
    speed: Array = field(repr=False)
    acceleration: Array = field(repr=False)
    inertia: Array = field(repr=False)
    time: Array = field(repr=False)
    motor_inertia: float = 0.0
    efficiency: float = 1.0
    curve: MotorCurve | None = None
    rated: float | None = None
    needs: dict[str, Need] = field(default_factory=dict)

    @property
    def power(self) -> Array:
        """Effort times speed (P,), W."""
        return self.effort * self.speed

    def mean(self, values: Array) -> float:
        """Mean over time."""
        return float((values * self.time).sum() / self.time.sum())

    def rms(self, values: Array) -> float:
        """Root of the mean square over time."""
        return math.sqrt(self.mean(values**2))

    def sampling(self) -> dict[str, float]:
        """By how much half of the positions would change rms and greatest effort and power, as parts of these."""

        def of(at: Ints) -> dict[str, float]:
            time = durations(self.result, at)
            return replace(self, effort=self.effort[at], speed=self.speed[at], time=time)._summary()

        peaks = {"greatest effort": self.effort, "greatest power": self.power}
        return sampling(self.result, of, peaks)

    def _summary(self) -> dict[str, float]:
        """Rms and greatest values over all positions."""
        out: dict[str, float] = {}
        for name, values in (("effort", self.effort), ("power", self.power)):
            out |= {f"rms {name}": self.rms(values), f"greatest {name}": float(np.abs(values).max())}
        return out

    def torque(self, ratio: float) -> Array:
        """Torque of the motor (P,), N m, behind a gear."""
        lost = np.where(self.power >= 0, 1 / self.efficiency, self.efficiency)
        return np.asarray(self.motor_inertia * ratio * self.acceleration + self.effort * lost / ratio)

    def allowed(self, ratio: float) -> Array:
        """Torque (P,) of its curve at the motor's speed, N m, in the sense for which the curve is given; NaN beyond its
        fastest speed, and without a curve."""
        speed = ratio * np.abs(self.speed)
        if self.curve is None:
            return np.full_like(speed, np.nan)
        most = self.curve.fastest
        limit = np.abs(self.curve.at(np.copysign(speed, most)))
        return np.asarray(np.where(speed <= abs(most), limit, np.nan))

    def need(self, ratio: float) -> Need:
        """Requirement on the motor with a gear ratio."""
        require("ratio", ratio)
        torque, speed = self.torque(ratio), ratio * np.abs(self.speed)
        rms, enough = self.rms(torque), None
        if self.curve is not None:
            enough = bool((np.abs(torque) <= self.allowed(ratio) * (1 + 1e-12)).all())
        if self.rated is not None:
            enough = enough is not False and rms <= self.rated * (1 + 1e-12)
        return Need(ratio, rms, float(np.abs(torque).max()), float(speed.max()), enough)

    def least_rms(self) -> float | None:
        """The ratio of least rms torque: n^2 = rms(T) / rms(J_m alpha); None where there is none."""
        rotor = self.motor_inertia * self.acceleration
        going, load = self.rms(rotor), self.rms(self.torque(1.0) - rotor)
        return math.sqrt(load / going) if going * load > 0 else None

    def least_peak(self) -> float | None:
        """The ratio of least greatest torque."""
        from scipy.optimize import minimize_scalar

        near, reach = self.least_rms(), math.log(RANGE)
        if near is None:
            return None

        def peak(x: float) -> float:
            return self.need(near * math.exp(x)).torque

        return float(
            near * math.exp(minimize_scalar(peak, bounds=(-reach, reach), options={"xatol": 1e-10}).x)
        )

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """The drives' positions; what the drive needs, and the motor behind each ratio."""
        yield from self.drive_columns()
        kinds, drive = drive_kinds(self.result, self.drive), self.drive
        names = {"effort": f"effort.{drive}"} | {x: f"drive.{drive}.{x}" for x in ("speed", "acceleration")}
        yield from (Column(name, kinds[of], getattr(self, of)) for of, name in names.items())
        yield Column(f"power.{drive}", "power", self.power)
        yield Column(
            f"reflected_inertia.{drive}", "inertia" if kinds["effort"] == "moment" else "mass", self.inertia
        )
        for name, need in self.needs.items():
            yield Column(f"motor_torque.{name.replace(' ', '_')}", "moment", self.torque(need.ratio))

    def record(self, to: Scale) -> Tree:
        """Rms and greatest values, and the ratios, in the units of a scale."""
        kind = drive_kinds(self.result, self.drive)["effort"]
        out: Tree = {"drive": self.drive, "sampling": self.sampling()}
        for name, unit, values in (("effort", kind, self.effort), ("power", "power", self.power)):
            sizes = {"greatest": np.abs(values).max(), "rms": self.rms(values), "mean": self.mean(values)}
            out[name] = {what: to(unit, value) for what, value in sizes.items()}
        units = {"rms": "moment", "torque": "moment", "speed": "angular_speed"}
        out["ratios"] = {
            name: {k: to(units[k], v) if k in units else v for k, v in vars(need).items()}
            for name, need in self.needs.items()
        }
        return {"motor": out}

    def printed(self, to: Printed, **choice: Any) -> Iterator[Part]:
        """Printed answer, in the units of a scale."""
        from dalembert.machine.output.motor_text import motor_parts

        return motor_parts(self, to, **choice)

    def scenes(self, notation: Notation) -> list[Scene]:
        """Its drawings in a notation."""
        from dalembert.views.machine.cycle_views import motor_scenes

        return motor_scenes(self, notation)

    def section(self, sheet: ReportSheet, shown: Shown) -> None:
        """Its equations in letters and numbers, put on a sheet."""
        from dalembert.reports.machine_sections.design_sections import motor_section

        motor_section(sheet, self, shown)


def motor(
    r: Result,
    drive: str | None = None,
    inertia: float | None = None,
    ratio: float | None = None,
    efficiency: float | None = None,
    curve: MotorCurve | str | Path | None = None,
    rated: float | None = None,
) -> MotorChoice:
    """Torque that a drive requires of its motor over the cycle, and the gear ratio that needs least torque.

    ``inertia``: that of the motor, kg m2; ``ratio``: speed of the motor over that of the drive (of one that slides,
    rad/m); both, and the gear's ``efficiency``, by default those of the drive's ``motor``, if it has one; ``curve``:
    greatest torque over speed, a motor of a file or a text file with columns speed and torque, default the drive's
    ``motor``; ``rated``: the continuous torque, N m. Raises ModelError where the drive is at rest, and AnalysisError
    where a position is not solved.

    >>> import dalembert as da
    >>> found = da.motor(da.dynamics(da.slider_crank(crank=0.05, rod=0.2)), inertia=1e-4)
    >>> found.effort.shape, bool(found.rms(found.effort) < np.abs(found.effort).max())
    ((72,), True)
    """
    for key, value in (
        ("motor inertia", inertia),
        ("ratio", ratio),
        ("efficiency", efficiency),
        ("rated torque", rated),
    ):
        require(key, value)
    name = drive or next(iter(r.drives), "")
    if not name:
        raise ModelError("the machine has no drive, and a motor turns one", "drive a joint")
    if name not in r.drives:
        raise ModelError(f"unknown drive {name!r}", closest(name, list(r.drives)))
    known = r.mechanism.drives[name].motor
    if known is not None:
        inertia = known.inertia if inertia is None else inertia
        ratio = known.ratio if ratio is None and known.geared else ratio
        efficiency = known.efficiency if efficiency is None else efficiency
    inertia, efficiency = inertia or 0.0, 1.0 if efficiency is None else efficiency
    if isinstance(curve, (str, Path)):
        curve = read_curve(curve, r.mechanism.units)
    motion = r.effort(name), r.drive_speed(name), r.drive_acceleration(name), reduced_inertia(r, name)
    motor_curve = curve or known
    choice = MotorChoice(r, name, *motion, durations(r), inertia, efficiency, motor_curve, rated)
    ratios = {
        "given": ratio,
        "direct": 1.0,
        "least rms": choice.least_rms(),
        "least peak": choice.least_peak(),
    }
    choice.needs.update({n: choice.need(x) for n, x in ratios.items() if x is not None})
    return choice
