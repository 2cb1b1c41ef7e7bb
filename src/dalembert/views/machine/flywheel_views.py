"""The turning-moment diagram with its mean, the energy curve, and the exact speed with the flywheel."""

from __future__ import annotations

import numpy as np

from dalembert.machine.flywheel.flywheels import Flywheel
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.diagrams import curves_scene
from dalembert.views.paper.scene import Scene


def flywheel_scenes(f: Flywheel, notation: Notation) -> list[Scene]:
    """Effort and mean, energy, speeds: each over the period."""
    shown = Shown(f.result, notation)
    q = f.result.drive_position(f.drive)
    x, unit = q / shown.size("angle"), shown.unit("angle")
    label = f"{f.drive} in {unit}"
    torque = f.torque / shown.size("moment")
    series = {"effort": torque, "mean": np.full_like(torque, f.mean / shown.size("moment"))}
    out = [curves_scene(x, series, label, f"Torque in {shown.unit('moment')}", "Turning moment", unit == "°")]
    energy, title = {"E": f.energy / shown.size("energy")}, "Energy above the mean"
    out.append(curves_scene(x, energy, label, f"Energy in {shown.unit('energy')}", title, unit == "°"))
    if f.exact is not None:
        some = {"book's flywheel": f.exact} | ({"exact for Cs": f.exact_size} if f.exact_size else {})
        speeds = {n: np.interp(np.sort(q), s.angle, s.speed) for n, s in some.items()}
        percent = {n: 100 * (speed / abs(f.size.speed) - 1) for n, speed in speeds.items()}
        title = "Speed off its mean"
        out.append(curves_scene(np.sort(x), percent, label, "Speed off its mean in %", title, unit == "°"))
    return out
