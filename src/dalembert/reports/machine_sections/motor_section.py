"""The choice of a motor worked out in letters and numbers."""

from __future__ import annotations

from dalembert.machine.motors.motor_choice import MotorChoice
from dalembert.reports.sheet import Sheet, Working
from dalembert.views.notation import Shown


def motor_section(sheet: Sheet, c: MotorChoice, shown: Shown) -> None:
    """The torque behind a gear, and the ratio of its least rms."""
    sheet.heading(f"Motor for {c.drive}")
    sheet.text(
        "Behind a gear of ratio n the motor turns n times as fast as the drive: it accelerates its own inertia, and "
        "gives the drive's effort T over n, with the efficiency of the gear where power goes to the machine."
    )
    lines = [Working("T_{m} = J_{m} n alpha + frac(T; n eta)")]
    best = c.least_rms()
    if best is not None:
        letters = "n^{2} = frac(T_{rms}; J_{m} alpha_{rms})"
        lines.append(
            Working(letters, "", f"{shown.notation.number(best**2)} quad n = {shown.notation.number(best)}")
        )
    sheet.equations(lines)
