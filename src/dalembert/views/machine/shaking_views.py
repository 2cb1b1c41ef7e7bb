"""The shaking force as a polar diagram and over the cycle, with the moment and the sizes of the harmonics."""

from __future__ import annotations

import numpy as np

from dalembert.arrays import Array
from dalembert.errors import ModelError
from dalembert.machine.harmonics import Harmonics
from dalembert.machine.shaking import Shaking
from dalembert.views.charts import crank_ticks, vector_chart
from dalembert.views.machine.cycle_views import cycle_axis
from dalembert.views.not_shown import refuse_still
from dalembert.views.notation import Notation
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.diagrams import polar_scene
from dalembert.views.paper.frame import round_up
from dalembert.views.paper.scene import Line, Polygon, Scene, Text


def shaking_scenes(s: Shaking, notation: Notation) -> list[Scene]:
    """Polar diagram (in the plane), components and moment over the cycle, harmonics where it is a period."""
    refuse_still(s.result, "a chart")
    r, axis = s.result.before, cycle_axis(s.result.before, notation)
    shown = axis.shown
    force = s.force / shown.size("force")
    whose = "on the ground" if s.whole else f"of {', '.join(s.links)}"
    out = []
    if r.mechanism.dimension == 2:
        ticks = crank_ticks(r, shown)
        out.append(polar_scene({"force": force}, shown.unit("force"), f"Shaking force {whose}", labels=ticks))
    out.append(vector_chart(r, force, "force", f"Shaking force {whose}", shown))
    turning = {f"Shaking moment about {s.about}": s.moment, "Shaking couple": s.couple}
    for title, values in turning.items():
        if values is None or not np.nanmax(np.abs(values), initial=0.0) > s.floor("moment"):
            continue
        if values.ndim > 1:
            out.append(vector_chart(r, values / shown.size("moment"), "moment", title, shown))
        else:
            out.append(axis.chart("moment", {"moment": values}, title))
    try:
        harmonics = s.harmonics(6)
    except ModelError:
        return out
    title = "Harmonics of the force"
    return [*out, harmonics_scene(harmonics, 1 / shown.size("force"), shown.unit("force"), title)]


WIDTH, HEIGHT = 84.0, 40.0
"""Size of a chart of harmonics, mm."""


def harmonics_scene(h: Harmonics, factor: float, unit: str, title: str) -> Scene:
    """Amplitudes as bars, one per component, order by order; without the mean."""
    canvas, kept = Canvas(), h.order > 0
    sizes: Array = np.reshape(h.amplitude[kept] * factor, (int(kept.sum()), -1))
    step = round_up(float(sizes.max(initial=0.0)) / 4 or 1.0)
    top = step * np.ceil(float(sizes.max(initial=step)) / step - 1e-9)
    for n in range(round(top / step) + 1):
        y = HEIGHT * n * step / top
        canvas.add(Line(((0.0, y), (WIDTH, y)), "grid" if n else "axis"))
        canvas.add(Text((-1.5, y), f"{n * step:g}", 2.6, "note", "end"))
    pitch, many = WIDTH / len(sizes), sizes.shape[1]
    wide = 0.7 * pitch / many
    for k, row in enumerate(sizes):
        for c, size in enumerate(row):
            x, y = (k + 0.15) * pitch + c * wide, HEIGHT * float(size) / top
            canvas.add(Polygon(((x, 0.0), (x + wide, 0.0), (x + wide, y), (x, y)), f"curve-{c + 1}"))
        canvas.add(Text(((k + 0.5) * pitch, -3.2), f"{h.order[kept][k]:g}", 2.6, "note"))
    for c, name in enumerate("xyz"[:many] if many > 1 else ""):
        y = HEIGHT - 2.0 - 4.6 * c
        canvas.add(Line(((WIDTH + 3.0, y), (WIDTH + 10.0, y)), f"curve-{c + 1}"))
        canvas.add(Text((WIDTH + 11.5, y), name, 2.8, "text", "start"))
    canvas.add(Text((WIDTH / 2, -7.6), "order", 2.8, "note"))
    canvas.add(Text((-1.5, HEIGHT + 4.2), f"Amplitude in {unit}", 2.8, "note", "start"))
    return canvas.scene(title, numbers={"order": list(h.order[kept]), "amplitude": sizes.tolist()})
