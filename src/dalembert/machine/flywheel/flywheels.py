"""The flywheel of a machine: what the book says, and what its speed then does.

Mechanics: docs/theory.md 10.3.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.answer.column import Axes, Column, Scale
from dalembert.arrays import Array, Tree, first_largest
from dalembert.bounds import require
from dalembert.errors import AnalysisError
from dalembert.machine.flywheel.flywheel_size import FlywheelSize, flywheel_size
from dalembert.machine.flywheel.legendre_panels import resolve
from dalembert.machine.flywheel.speed_fluctuation import SpeedFluctuation, inertia_for, speed_fluctuation
from dalembert.machine.flywheel.turning_moment import TurningMoment
from dalembert.machine.output.machine_answer import MachineAnswer

if TYPE_CHECKING:
    from dalembert.analysis.output.summary.printed_units import Printed
    from dalembert.analysis.result.result import Result
    from dalembert.printing import Part
    from dalembert.reports.sheet import ReportSheet
    from dalembert.views.notation import Notation, Shown
    from dalembert.views.paper.scene import Scene


@dataclass(frozen=True, eq=False)
class Flywheel(MachineAnswer):
    """Energy curve of a drive at steady speed, the flywheel by the book's rule, and the exact speed with it.

    ``torque`` (P,) effort of the drive, ``energy`` (P,) E(q) = int (T - T_m) dq from the first position, both at the
    positions of the result; ``zeros`` where T crosses T_m, ``energies`` E at them; ``own`` the mean of the machine's
    reduced inertia J over angle. ``exact``: the speed with the textbook flywheel; ``exact_size``: the flywheel that
    gives exactly the required C_s (None where the inertia was given, or where it is impossible). Where E is greatest
    the machine has taken most energy, and is slowest.
    """

    result: Result = field(repr=False)
    drive: str
    size: FlywheelSize
    mean: float
    torque: Array = field(repr=False)
    energy: Array = field(repr=False)
    zeros: Array
    energies: Array
    own: float
    exact: SpeedFluctuation | None = field(repr=False)
    exact_size: SpeedFluctuation | None = field(repr=False)
    reason: str = ""

    @property
    def inertia(self) -> float:
        """I of the book's flywheel, kg m2."""
        return self.size.inertia

    @property
    def slowest(self) -> float:
        """Angle of the least speed by the energy curve, rad; NaN where the speed does not change."""
        return float(self.zeros[first_largest(self.energies)]) if len(self.zeros) else float("nan")

    @property
    def fastest(self) -> float:
        """Angle of the greatest speed by the energy curve, rad."""
        return float(self.zeros[first_largest(-self.energies)]) if len(self.zeros) else float("nan")

    @property
    def coefficient_of_energy(self) -> float:
        """dE over the work of one period, of the mean torque."""
        q = self.result.drive_position(self.drive)
        work = abs(self.mean * len(q) * (q[1] - q[0]))
        return self.size.energy / work if work > 1e-9 * self.size.energy else float("nan")

    def columns(self, axes: Axes = "ground") -> Iterator[Column]:
        """Angle, effort and energy over the positions, with the exact speed."""
        r = self.result
        yield Column(f"drive.{self.drive}", "angle", r.drive_position(self.drive))
        yield Column(f"effort.{self.drive}", "moment", self.torque)
        yield Column("energy.flywheel", "energy", self.energy)
        if self.exact is not None:
            speed = np.interp(r.drive_position(self.drive), self.exact.angle, self.exact.speed)
            yield Column(f"drive.{self.drive}.speed", "angular_speed", speed)

    def record(self, to: Scale) -> Tree:
        """Its other numbers by name, in the units of a scale."""
        low, high = self.size.limits
        book = {
            "mean_torque": to("moment", self.mean),
            "pulses": [to("energy", p) for p in self.size.pulses],
            "energy_fluctuation": to("energy", self.size.energy),
            "coefficient_of_energy": self.coefficient_of_energy,
            "Cs": self.size.fluctuation,
            "inertia": to("inertia", self.size.inertia),
            "speed": [to("angular_speed", w) for w in (low, high)],
            "slowest": to("angle", self.slowest),
            "fastest": to("angle", self.fastest),
            "own_inertia": to("inertia", self.own),
        }
        exact = {
            name: _speed_record(s, to) for name, s in (("exact", self.exact), ("for_Cs", self.exact_size))
        }
        return {"flywheel": {"drive": self.drive, **book, **exact, "reason": self.reason or None}}

    def printed(self, to: Printed, **choice: Any) -> Iterator[Part]:
        """Printed answer, in the units of a scale."""
        from dalembert.machine.output.flywheel_text import flywheel_parts

        return flywheel_parts(self, to, **choice)

    def scenes(self, notation: Notation) -> list[Scene]:
        """Its drawings in a notation."""
        from dalembert.views.machine.cycle_views import flywheel_scenes

        return flywheel_scenes(self, notation)

    def section(self, sheet: ReportSheet, shown: Shown) -> None:
        """Its equations in letters and numbers, put on a sheet."""
        from dalembert.reports.machine_sections.design_sections import flywheel_section

        flywheel_section(sheet, self, shown)


def _speed_record(s: SpeedFluctuation | None, to: Scale) -> Tree | None:
    if s is None:
        return None
    return {
        "inertia": to("inertia", s.inertia),
        "Cs": s.fluctuation,
        "speed": [to("angular_speed", w) for w, _ in (s.least, s.greatest)],
        "at": [to("angle", q) for _, q in (s.least, s.greatest)],
        "residual": s.residual,
    }


def flywheel(
    r: Result,
    drive: str | None = None,
    Cs: float | None = None,
    inertia: float | None = None,
) -> Flywheel:
    """The flywheel of a machine that turns steadily over full turns, from the required C_s or from its inertia.

    E(q) = int (T - T_m) dq of the drive's effort T, dE its greatest less its least value, at the zeros of T - T_m on
    the continuous curve; I = dE / (C_s w^2). This I omits the links' inertia: the exact speed (`exact`) includes it,
    and `exact_size` is the flywheel with it. Raises ModelError where the positions are not even over full turns, the
    speed varies, or the mechanism has several drives; AnalysisError where a position is not solved.

    >>> import dalembert as da
    >>> from dalembert.bundled import examples
    >>> f = da.flywheel(da.dynamics(da.load(examples()["engine"]), positions=144), Cs=0.02)
    >>> round(f.size.energy, 2), round(f.inertia, 5), round(f.exact_size.inertia, 5)
    (441.64, 0.22374, 0.21434)
    """
    require("Cs", Cs)
    require("flywheel inertia", inertia, "inertia")
    t = TurningMoment(r, drive)
    panels, torque = resolve(t.steady, t.edges, t.floor)
    mean = panels.mean(torque)
    above = torque - mean
    above = above if np.abs(above).max() > 100 * t.floor else np.zeros_like(torque)
    zeros, energies = panels.turning_points(above, t.floor * panels.period)
    even, pulses = not len(zeros), np.diff(np.append(energies, energies[:1]))
    size = flywheel_size([*pulses], t.speed, Cs, inertia)
    starts = panels.antiderivative(above)[1]
    curve = np.interp(r.drive_position(t.drive), np.append(panels.low, t.edges[-1]), starts)
    reduced = t.inertia(panels.points.ravel()).reshape(torque.shape)
    mean_inertia = panels.mean(reduced)
    exact, for_cs, reason = None, None, "the effort never differs from its mean" if even else ""
    try:
        if even:
            raise AnalysisError(reason)
        exact = speed_fluctuation(t, panels, reduced, size.inertia)
        for_cs = inertia_for(t, panels, reduced, Cs, size.inertia - mean_inertia) if Cs is not None else None
    except AnalysisError as error:
        reason = str(error)
    parts = (r.effort(t.drive), curve - curve[0], zeros, energies - curve[0], mean_inertia)
    return Flywheel(r, t.drive, size, mean, *parts, exact, for_cs, reason)
