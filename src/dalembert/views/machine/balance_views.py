"""Shaking force, moment and torque before and after balancing, and the trade-off between two of them."""

from __future__ import annotations

import numpy as np

from dalembert.analysis.methods.applied_forces import magnitude
from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.machine.balance.balancing import Balance, without_weight
from dalembert.views.charts import along
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.diagrams import curves_scene, polar_scene
from dalembert.views.paper.scene import Scene

NOTHING = 1e-6
"""A trade-off that gains or costs less, in per cent, is none."""


def balance_scenes(b: Balance, notation: Notation) -> list[Scene]:
    """Force (in the plane a polar diagram, in space its size), moment and torque over the cycle, the trade-off."""
    shown = Shown(b.result, notation)
    sides = {"before": b.before, "after": b.after}
    force, moment = ({n: without_weight(s, of) for n, s in sides.items()} for of in ("force", "moment"))
    plane, out = b.problem.dimension == 2, list[Scene]()
    if plane:
        scaled = {name: values / shown.size("force") for name, values in force.items()}
        out.append(polar_scene(scaled, shown.unit("force"), "Shaking force"))
    if len(b.result.status) < 3 or not b.result.drives:
        return out
    drive, size = b.result.drives[0], "" if plane else "Size of the "
    some: dict[str, dict[str, Array]] = {} if plane else {f"{size}shaking force": force}
    some[f"{size}shaking moment about {b.before.about}"] = moment
    some[f"Torque of {drive}"] = {n: s.result.effort(drive) for n, s in sides.items()}
    x, label, angle = along(b.result, shown)
    for title, curves in some.items():
        kind = "force" if curves is force else "moment"
        series = {n: (v if v.ndim == 1 else magnitude(v)) / shown.size(kind) for n, v in curves.items()}
        unit = f"{kind.capitalize()} in {shown.unit(kind)}"
        out.append(curves_scene(x, series, label, unit, title[:1].upper() + title[1:], angle))
    other = next((n for n in ("torque", "force", "moment") if n not in b.of), None)
    if other is None:
        return out
    try:
        pairs = 100 * np.array(b.trade_off(other))
    except ModelError:  # the other asks for bounds that are not given
        return out
    if np.ptp(pairs, axis=0).min() < NOTHING:
        return out
    of = " and ".join(b.of)
    title, left = f"Trade-off: {b.least} of {of} against {other}", {other: pairs[:, 1]}
    return [*out, curves_scene(pairs[:, 0], left, f"{of} left in %", f"{other} left in %", title)]
