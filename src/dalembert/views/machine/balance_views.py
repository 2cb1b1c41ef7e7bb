"""Shaking force, moment and torque before and after balancing, and the trade-off between two of them."""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.machine.balance.balancing import Balance, without_weight
from dalembert.views.charts import along
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.diagrams import curves_scene, polar_scene
from dalembert.views.paper.scene import Scene


def balance_scenes(b: Balance, notation: Notation) -> list[Scene]:
    """Polar diagram of the force, moment and torque over the cycle, the trade-off with the torque."""
    shown = Shown(b.result, notation)
    sides = {"before": b.before, "after": b.after}
    force = {name: without_weight(s, "force") / shown.size("force") for name, s in sides.items()}
    out = [polar_scene(force, shown.unit("force"), "Shaking force")]
    if len(b.result.status) < 3 or not b.result.drives:
        return out
    drive = b.result.drives[0]
    some: dict[str, dict[str, Array]] = {
        f"Shaking moment about {b.before.about}": {n: without_weight(s, "moment") for n, s in sides.items()},
        f"Torque of {drive}": {n: s.result.effort(drive) for n, s in sides.items()},
    }
    x, label, angle = along(b.result, shown)
    for title, curves in some.items():
        series = {name: values / shown.size("moment") for name, values in curves.items()}
        out.append(curves_scene(x, series, label, f"Moment in {shown.unit('moment')}", title, angle))
    other = "torque" if "torque" not in b.of else "force"
    try:
        pairs = 100 * np.array(b.trade_off(other))
    except ModelError:  # the other asks for bounds that are not given
        return out
    of = " and ".join(b.of)
    title, left = f"Trade-off: {b.least} of {of} against {other}", {other: pairs[:, 1]}
    return [*out, curves_scene(pairs[:, 0], left, f"{of} left in %", f"{other} left in %", title)]
