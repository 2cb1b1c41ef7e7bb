"""The flywheel worked out in letters and numbers, beside the exact speed."""

from __future__ import annotations

from dalembert.machine.flywheel.flywheels import Flywheel
from dalembert.reports.sheet import Sheet, Working
from dalembert.views.notation import Shown


def flywheel_section(sheet: Sheet, f: Flywheel, shown: Shown) -> None:
    """Mean torque, dE, I, limits of speed."""
    sheet.heading("Flywheel")
    sheet.text(
        f"The effort T of {f.drive} at steady speed is what the machine asks for; its mean is what a steady supply "
        "gives. Above the mean the flywheel gives, and slows down: where E is greatest the speed is least."
    )
    size, cs = f.size, shown.notation.number(f.size.fluctuation)
    most, least, fluctuation = (
        shown.number("energy", e)
        for e in (max(f.energies, default=0), min(f.energies, default=0), size.energy)
    )
    speed, *limits = (shown.number("angular_speed", w) for w in (abs(size.speed), *size.limits))
    rotating = shown.with_factor(f"frac({fluctuation}; {cs} cdot {speed}^{{2}})", "inertia", "energy")
    rotating = rotating if shown.scale.text("angular_speed") == "rad/s" else ""
    rows = [
        ("T_{m}", "", shown.number("moment", f.mean), "moment"),
        ("Δ E = E_{max} - E_{min}", f"{most} - ({least})", fluctuation, "energy"),
        ("I = frac(Δ E; C_{s} omega^{2})", rotating, shown.number("inertia", size.inertia), "inertia"),
        ("omega = omega_{m} (1 -+ C_{s} / 2)", "", " quad ".join(limits), "angular_speed"),
    ]
    sheet.equations([Working(a, b, f'{value} "{shown.unit(kind)}"') for a, b, value, kind in rows])
