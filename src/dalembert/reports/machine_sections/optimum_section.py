"""An optimum before and after: numbers, the aim and its conditions, the aim over the cycle, both designs drawn."""

from __future__ import annotations

from itertools import islice

import numpy as np

from dalembert.arrays import first_largest
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
    sheet.table(
        ["", "before", "after"], o.aim_rows(), "The margin is the distance to the limit of a condition"
    )
    sheet.figure(
        *optimum_scenes(o, notation), caption="Before, then after, at the position where the aim is largest."
    )
    return sheet


def optimum_scenes(o: Optimum, notation: Notation | None = None) -> list[Scene]:
    """Objective over the cycle (if it has one value for a cycle, the first condition that changes), then the designs
    before and after where it is largest, or the margin least; a design that does not close there is left out."""
    names = {o.aim.of: o.aim.of, **{c.margin: f"margin of {c.text}" for c in o.conditions}}
    of = next((text for text in names if np.ptp(o.values_of(o.after, text)) > 0), o.aim.of)
    shown, kind = Shown(o.after, notation or Notation()), o.kind_of(of)
    x, label, angle = along(o.after, shown)
    if o.instants:
        x, label, angle = np.linspace(0.0, 100.0, o.instants), "part of the motion in %", False
    both = {"before": o.before, "after": o.after}
    curves = {name: o.values_of(r, of) * shown.value(kind, 1.0) for name, r in both.items()}
    title, unit = f"{names[of]} over the {'motion' if o.instants else 'cycle'}", shown.unit(kind)
    values = o.values_of(o.after, of)
    size = np.abs(values) if of == o.aim.of else -values  # of a margin where it is least
    at = first_largest(size) if np.isfinite(size).any() else 0
    closed = [r for r in both.values() if np.isfinite(o.values_of(r, of)[at])]
    chart = curves_scene(x, curves, label, f"{names[of]} in {unit}" if unit else names[of], title, angle)
    return [chart, *(draw.mechanism(r, o.place(r, at), notation) for r in closed)]


def front_scenes(f: Front, notation: Notation | None = None) -> list[Scene]:
    """The second aim over the first, then the best design by each."""
    shown = Shown(f.designs[0].after, notation or Notation())
    x, y = (
        (c.values * shown.value(c.kind, 1.0), f"{c.name} in {shown.unit(c.kind)}")
        for c in islice(f.columns(), 2)
    )
    curve = curves_scene(x[0], {"front": y[0]}, x[1], y[1], "Front")
    return [curve, *(draw.mechanism(o.after, notation=notation) for o in (f.designs[0], f.designs[-1]))]
