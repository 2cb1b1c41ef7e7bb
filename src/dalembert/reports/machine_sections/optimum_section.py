"""An optimum before and after: numbers, the aim and its conditions, the aim over the cycle, both designs drawn."""

from __future__ import annotations

import numpy as np

from dalembert.analysis.result.named_quantities import quantity
from dalembert.errors import ModelError
from dalembert.optimization.optimum import Optimum
from dalembert.reports.sheet import Sheet
from dalembert.views import draw
from dalembert.views.charts import along
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.diagrams import curves_scene


def optimum_sheet(o: Optimum, notation: Notation | None = None) -> Sheet:
    """The page of what `da.optimize` found."""
    m, notation = o.mechanism, notation or Notation()
    sheet = Sheet(m.title or "Optimum", m.source_text)
    sheet.heading("Optimum")
    sheet.text(o.words)
    sheet.table(["number", "before", "after", "from", "to"], o.number_rows())
    sheet.table(["", "before", "after"], o.aim_rows(), "Room is what is left until a condition is broken")
    shown, kind = Shown(o.after, notation), quantity(o.after, o.aim.of).kind
    x, label, angle = along(o.after, shown)
    both = {"before": o.before, "after": o.after}
    curves = {name: r[o.aim.of] * shown.value(kind, 1.0) for name, r in both.items()}
    title, unit = f"{o.aim.of} over the cycle", shown.unit(kind)
    sheet.figure(curves_scene(x, curves, label, f"{o.aim.of} in {unit}" if unit else o.aim.of, title, angle))
    size = np.abs(o.after[o.aim.of])
    at = int(np.nanargmax(size)) + 1 if np.isfinite(size).any() else 1
    scenes = []
    for r in both.values():
        try:
            scenes.append(draw.mechanism(r, at, notation))
        except ModelError as error:  # a design that does not close there
            sheet.text(f"Not drawn: {error}.")
    sheet.figure(*scenes, caption="Before, then after, where what is least is largest in magnitude.")
    return sheet
