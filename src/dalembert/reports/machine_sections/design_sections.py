"""Balance, bearings, flywheel, motor and motion under forces worked out in letters and numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.rounding import PART
from dalembert.machine.motion.occurrences import say
from dalembert.reports.sheet import ReportSheet, Working
from dalembert.views.notation import Shown

if TYPE_CHECKING:
    from dalembert.machine.balance.balancing import Balance
    from dalembert.machine.balance.rotors import RotorBalance
    from dalembert.machine.bearings.bearing_load import BearingLoad
    from dalembert.machine.bearings.bearing_table import BearingTable
    from dalembert.machine.flywheel.flywheels import Flywheel
    from dalembert.machine.motion.simulation import Simulation
    from dalembert.machine.motors.motor_choice import MotorChoice


def balance_section(sheet: ReportSheet, b: Balance, shown: Shown) -> None:
    """In letters the columns of a counterweight."""
    sheet.heading("Balance")
    where = "with m x and m y about its base point A, on a link at the angle $theta$, adds to the shaking force, in "
    where, letters = where + "complex numbers,", "(i alpha - omega^{2}) e^{iθ} (m x + i m y)"
    if b.problem.dimension == 3:
        where = "at r from its base point A adds to the shaking force"
        letters = "m (alpha times r) - m (omega times (omega times r))"
    sheet.text(f"A counterweight of mass m {where} a term that is linear in its mass parameters:")
    sheet.equations([Working(f"F = -m a_{{A}} - {letters}")])
    sheet.text("So minimising the mean square, or the largest value, over all positions is a convex problem.")


def rotor_section(sheet: ReportSheet, b: RotorBalance, shown: Shown) -> None:
    """In letters the conditions that no force and no couple turns with the shaft, and what ends them."""
    sheet.heading("Rotor balanced in two planes")
    sheet.text(
        "Each mass of the rotor has an unbalance u = m r, complex at its angle, in the plane z along the axis. "
        "The rotating load on the bearings vanishes if these sums, with the corrections a and b, are zero:"
    )
    sums = Working("S = sum u_{i} quad T = sum z_{i} u_{i}")
    sheet.equations([sums, Working("u_{b} = -frac(T - z_{a} S; z_{b} - z_{a}) quad u_{a} = -S - u_{b}")])


def bearing_section(sheet: ReportSheet, t: BearingTable, shown: Shown) -> None:
    """Pressure, equivalent load and life of each joint that has a bearing."""
    sheet.heading("Bearings")
    sheet.text(
        "The force of a joint bears on the projected area of its pin. A rolling bearing has the same life under the "
        "steady load P as under the force over the cycle, weighted by the rotation $phi$ of the joint."
    )
    sheet.equations([Working("P = (frac(∫ F^{e} |d phi|; ∫ |d phi|))^{1/e}")])
    for joint, b in t.loads.items():
        lines = _bearing_lines(b, shown)
        if lines:
            sheet.text(f"Joint {joint}:")
            sheet.equations(lines)


def _bearing_lines(b: BearingLoad, shown: Shown) -> list[Working]:
    lines, described = list[Working](), b.bearing
    if described and described.diameter and described.length:
        numbers = {
            "force": float(b.radial.max()),
            "length": described.diameter,
            "pressure": float(b.pressure.max()),
        }
        most, d, pressure = (shown.number(kind, x) for kind, x in numbers.items())
        divided = f"frac({most}; {d} cdot {shown.number('length', described.length)})"
        factor = shown.factor("force", "pressure", "length", "length")
        divided += "" if factor == 1 else f" / {shown.conversion(factor)}"
        lines.append(Working("p = frac(F; d l)", divided, f'{pressure} "{shown.unit("pressure")}"'))
    if described and described.rating:
        rating, load = (shown.number("force", x) for x in (described.rating, b.equivalent))
        e = "3" if described.kind == "ball" else "10/3"
        turns = f'{shown.notation.number(b.turns / 1e6)} cdot 10^{{6}} "turns"'
        lines.append(Working("P", "", f'{load} "{shown.unit("force")}"'))
        life = f"(frac({rating}; {load}))^{{{e}}} 10^{{6}}"
        lines.append(Working("L_{10} = (frac(C; P))^{e} 10^{6}", life, turns))
    return lines


def flywheel_section(sheet: ReportSheet, f: Flywheel, shown: Shown) -> None:
    """Mean torque, dE, I, limits of speed, beside the exact speed."""
    sheet.heading("Flywheel")
    sheet.text(
        f"The effort T of {f.drive} at steady speed is what the machine needs; its mean is what a steady supply "
        "delivers. Above the mean the flywheel delivers the rest and slows: where E is greatest, the speed is lowest."
    )
    size, cs = f.size, shown.notation.number(f.size.fluctuation)
    energies = max(f.energies, default=0), min(f.energies, default=0), size.energy
    most, least, fluctuation = (shown.number("energy", e) for e in energies)
    speed, *limits = (shown.number("angular_speed", w) for w in (abs(size.speed), *size.limits))
    rotating = shown.with_factor(f"frac({fluctuation}; {cs} cdot {speed}^{{2}})", "inertia", "energy")
    rotating = rotating if shown.scale.text("angular_speed") == "rad/s" else ""
    mean = shown.number("moment", f.mean, PART * float(np.abs(f.torque).max()))
    rows = [
        ("T_{m}", "", mean, "moment"),
        ("Δ E = E_{max} - E_{min}", f"{most} - ({least})", fluctuation, "energy"),
        ("I = frac(Δ E; C_{s} omega^{2})", rotating, shown.number("inertia", size.inertia), "inertia"),
        ("omega = omega_{m} (1 ∓ C_{s} / 2)", "", " quad ".join(limits), "angular_speed"),
    ]
    sheet.equations([Working(a, b, f'{value} "{shown.unit(kind)}"') for a, b, value, kind in rows])


def motor_section(sheet: ReportSheet, c: MotorChoice, shown: Shown) -> None:
    """The torque behind a gear, and the ratio of its least rms."""
    sheet.heading(f"Motor for {c.drive}")
    sheet.text(
        "Behind a gear of ratio n the motor turns n times as fast as the drive: it accelerates its rotor inertia and "
        "supplies the drive's effort T over n, divided by the gear efficiency where power flows to the machine."
    )
    lines, best = [Working("T_{m} = J_{m} n alpha + frac(T; n eta)")], c.least_rms()
    if best is not None:
        value = f"{shown.notation.number(best**2)} quad n = {shown.notation.number(best)}"
        lines.append(Working("n^{2} = frac(T_{rms}; J_{m} alpha_{rms})", "", value))
    sheet.equations(lines)


def simulation_section(sheet: ReportSheet, s: Simulation, shown: Shown) -> None:
    """Moving drives, and the equation of motion that is integrated."""
    sheet.heading("Motion under forces")
    sheet.text(
        f"The speeds of {', '.join(s.drives)} follow from the applied efforts: the effort required by a state is "
        "the reduced inertia times the acceleration plus the effort required without acceleration. Between events this "
        f"is integrated step by step (Dormand and Prince, order 8). It ends: {say(s.ending, shown.scale)}."
    )
