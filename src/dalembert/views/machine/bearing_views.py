"""The load of bearings in the axes of the pin, where it wears, and how fast the joint turns."""

from __future__ import annotations

from dalembert.machine.bearings.bearing_table import BearingTable
from dalembert.views.charts import MOST, along, polar_chart
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.diagrams import curves_scene
from dalembert.views.paper.scene import Scene


def bearing_scenes(t: BearingTable, notation: Notation) -> list[Scene]:
    """Polar diagrams of the first joints, in ground axes and the link's, and the turning of all over the cycle."""
    r, some = t.result, [*t.loads][:MOST]
    shown = Shown(r, notation)
    out: list[Scene] = []
    if r.mechanism.dimension == 2:
        out = [polar_chart(r, [joint], axes, notation) for joint in some for axes in ("ground", "link")]
    x, label, angle = along(r, shown)
    series = {
        "Radial force in": ("force", {j: t.loads[j].radial for j in some}),
        "Turning in": ("angular_speed", {j: t.loads[j].rate for j in some}),
        "Pressure in": ("pressure", {j: t.loads[j].pressure for j in some if t.loads[j].sized}),
    }
    for said, (kind, curves) in series.items():
        if curves and len(x) > 1:
            values = {j: v / shown.size(kind) for j, v in curves.items()}
            title = f"{said.removesuffix(' in')} of the joints"
            out.append(curves_scene(x, values, label, f"{said} {shown.unit(kind)}", title, angle))
    return out
