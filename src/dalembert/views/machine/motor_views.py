"""What a drive asks for over the cycle, and the torque of its motor under the curve."""

from __future__ import annotations

import numpy as np

from dalembert.analysis.output.columns import drive_kinds
from dalembert.machine.motors.motor_choice import MotorChoice
from dalembert.views.charts import along
from dalembert.views.not_shown import refuse_still
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.diagrams import curves_scene
from dalembert.views.paper.scene import Scene


def motor_scenes(c: MotorChoice, notation: Notation) -> list[Scene]:
    """Effort, speed and power of the drive; torque of the motor for each ratio, with what the curve allows."""
    refuse_still(c.result, "a chart")
    shown, kinds = Shown(c.result, notation), drive_kinds(c.result, c.drive)
    x, label, angle = along(c.result, shown)
    out = []
    for name in ("effort", "speed", "power"):
        kind = kinds.get(name, name)
        series = {name: getattr(c, name) / shown.size(kind)}
        title = f"{name.capitalize()} of {c.drive}"
        out.append(curves_scene(x, series, label, f"{name.capitalize()} in {shown.unit(kind)}", title, angle))
    for name, need in c.needs.items():
        series = {"torque": c.torque(need.ratio)}
        if c.curve is not None:
            series["allowed"] = np.abs(np.asarray(c.curve.at(need.ratio * np.abs(c.speed))))
        size, unit = shown.size("moment"), shown.unit("moment")
        scaled = {n: v / size for n, v in series.items()}
        title = f"Motor, {name}: ratio {notation.number(need.ratio)}"
        out.append(curves_scene(x, scaled, label, f"Torque in {unit}", title, angle))
    return out
