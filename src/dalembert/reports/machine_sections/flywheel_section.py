"""The flywheel worked out in letters and numbers, beside the exact speed."""

from __future__ import annotations

from dalembert.machine.flywheel.flywheels import Flywheel
from dalembert.machine.output.flywheel_text import comparison
from dalembert.reports.sheet import Sheet, Working
from dalembert.views.machine.flywheel_views import flywheel_scenes
from dalembert.views.notation import Notation, Shown


def flywheel_section(sheet: Sheet, f: Flywheel, notation: Notation) -> None:
    """Mean torque, pulses, dE, I, limits of speed, and what the rule leaves out."""
    shown = Shown(f.result, notation)
    sheet.heading("Flywheel")
    sheet.text(
        f"The effort T of {f.drive} at steady speed is what the machine asks for; its mean is what a steady supply "
        "gives. Above the mean the flywheel gives, and slows down: where E is greatest the speed is least."
    )
    rows = [
        [shown.number("angle", q), shown.number("energy", e), shown.number("energy", p)]
        for q, e, p in zip(f.zeros, f.energies, f.size.pulses, strict=True)
    ]
    units = [shown.unit(kind) for kind in ("angle", "energy", "energy")]
    heads = ["$T = T_{m}$ at", "$E$", "pulse up to the next"]
    sheet.table(
        [f"{h} {u}" for h, u in zip(heads, units, strict=True)],
        rows,
        "Where the effort crosses its mean; the pulses add up to 0",
    )
    energy, inertia = (f'"{shown.unit(kind)}"' for kind in ("energy", "inertia"))
    most, least = (
        shown.number("energy", e) for e in (max(f.energies, default=0), min(f.energies, default=0))
    )
    size, cs = f.size, shown.notation.number(f.size.fluctuation)
    fluctuation = shown.number("energy", size.energy)
    speed = shown.number("angular_speed", abs(size.speed))
    number = shown.number("inertia", size.inertia)
    low, high = (shown.number("angular_speed", w) for w in size.limits)
    rotating = shown.converted(f"frac({fluctuation}; {cs} cdot {speed}^{{2}})", "inertia", "energy")
    if shown.scale.text("angular_speed") not in ("rad/s",):
        rotating = ""
    sheet.equations(
        [
            Working("T_{m}", "", shown.text("moment", f.mean).replace(" ", ' "', 1) + '"'),
            Working("Δ E = E_{max} - E_{min}", f"{most} - ({least})", f"{fluctuation} {energy}"),
            Working("I = frac(Δ E; C_{s} omega^{2})", rotating, f"{number} {inertia}"),
            Working(
                "omega = omega_{m} (1 -+ C_{s} / 2)", "", f'{low} quad {high} "{shown.unit("angular_speed")}"'
            ),
        ]
    )
    sheet.text(comparison(f, shown.text))
    sheet.figure(*flywheel_scenes(f, notation))
