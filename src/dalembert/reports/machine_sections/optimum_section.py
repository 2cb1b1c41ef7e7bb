"""An optimum before and after: numbers, the aim and its conditions, the aim over the cycle, both designs drawn."""

from __future__ import annotations

from itertools import islice

import numpy as np

from dalembert.analysis.result.named_quantities import quantity
from dalembert.optimization.optimum import Optimum
from dalembert.optimization.pareto_front import Front
from dalembert.reports.sheet import ReportSheet
from dalembert.views import draw
from dalembert.views.charts import along
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.diagrams import curves_scene
from dalembert.views.paper.scene import Scene


def optimum_sheet(o: Optimum, notation: Notation | None = None) -> ReportSheet:
    """The page of the optimum of `da.optimize`."""
    m, notation = o.mechanism, notation or Notation()
    sheet = ReportSheet(m.title or "Optimum", m.source_text)
    sheet.heading("Optimum")
    sheet.text(o.words)
    sheet.table(["number", "before", "after", "from", "to"], o.number_rows())
    sheet.table(["", "before", "after"], o.aim_rows(), "Room is what is left until a condition is broken")
    sheet.figure(*optimum_scenes(o, notation), caption="Before, then after, where what is least is largest.")
    return sheet


def optimum_scenes(o: Optimum, notation: Notation | None = None) -> list[Scene]:
    """Objective over the cycle, then the designs before and after at its largest magnitude; a design that does not
    close at that position is left out."""
    shown, kind = Shown(o.after, notation or Notation()), quantity(o.after, o.aim.of).kind
    x, label, angle = along(o.after, shown)
    both = {"before": o.before, "after": o.after}
    curves = {name: r[o.aim.of] * shown.value(kind, 1.0) for name, r in both.items()}
    title, unit = f"{o.aim.of} over the cycle", shown.unit(kind)
    size = np.abs(o.after[o.aim.of])
    at = int(np.nanargmax(size)) if np.isfinite(size).any() else 0
    closed = [r for r in both.values() if np.isfinite(r[o.aim.of][at])]
    chart = curves_scene(x, curves, label, f"{o.aim.of} in {unit}" if unit else o.aim.of, title, angle)
    return [chart, *(draw.mechanism(r, at + 1, notation) for r in closed)]


def front_scenes(f: Front, notation: Notation | None = None) -> list[Scene]:
    """The second aim over the first, then the best design by each."""
    shown = Shown(f.designs[0].after, notation or Notation())
    x, y = (
        (c.values * shown.value(c.kind, 1.0), f"{c.name} in {shown.unit(c.kind)}")
        for c in islice(f.columns(), 2)
    )
    curve = curves_scene(x[0], {"front": y[0]}, x[1], y[1], "Front")
    return [curve, *(draw.mechanism(o.after, notation=notation) for o in (f.designs[0], f.designs[-1]))]
