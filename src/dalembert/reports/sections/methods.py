"""The graphical method, the cycle, the checks."""

from __future__ import annotations

import numpy as np

from dalembert.analysis.methods.applied_forces import actions, magnitude, on_link
from dalembert.analysis.methods.members import ZERO, members, order_of_solution
from dalembert.analysis.result.number_kinds import drive_kinds
from dalembert.printing import remainder
from dalembert.reports.report_context import ReportContext
from dalembert.reports.sections.terms import floors
from dalembert.reports.sheet import ReportSheet
from dalembert.views import draw


def graphical(sheet: ReportSheet, c: ReportContext) -> None:
    r, shown = c.r, c.shown
    sheet.heading("Graphical solution")
    by_link = members(r)
    kinds = [f"{shown.heading(link)}: {m.kind} {m.state(c.k)}".strip() for link, m in by_link.items()]
    sheet.text(f"Classes of the links. {'; '.join(kinds)}.")
    touching = [f"{shown.heading(link)}: {m.touching}" for link, m in by_link.items() if m.touching]
    sheet.text(f"With friction: {'; '.join(touching)}." if touching else "")
    sheet.text(f"Order of solution: {'; then '.join(step.why for step in order_of_solution(r, by_link))}.")
    at = c.k + 1
    lines = [
        draw.lines_of_action(r, link, at, c.notation)
        for link, m in by_link.items()
        if m.kind in ("three-force", "four-force", "two-force with couple")
    ]
    loaded = [link for link, m in by_link.items() if len(m.forces) > 1 and m.kind != ZERO]
    polygons = [draw.force_polygon(r, link, at, c.notation) for link in loaded]
    sheet.figure(*lines, *polygons, *([draw.force_chain(r, at, c.notation)] if len(r.links) > 1 else []))


def cycle(sheet: ReportSheet, c: ReportContext) -> None:
    from dalembert.views import charts

    r = c.r
    if len(r.status) < 8 or not r.drives:
        return
    sheet.heading("Over the cycle")
    known = [j for j in r.joints if np.isfinite(r.reaction(j)).all(axis=-1).any()]
    sheet.figure(
        *charts.effort_chart(r, c.notation), *(charts.reaction_charts(r, c.notation) if known else [])
    )
    rows = []
    for d in r.drives:
        value, where = r.worst("effort", d)
        kind = drive_kinds(r, d)["effort"]
        least = floors(r, where)[kind == "moment"] if r.mechanism.dimension == 3 else 0.0
        rows.append(_largest(f"effort {d}", c.shown.text(kind, value, least), where))
    for j in known:
        value, where = r.worst("reaction", j)
        rows.append(_largest(f"joint {j}", c.shown.text("force", value), where))
    sheet.table(["Largest", "Value", "Position"], rows)


def _largest(name: str, value: str, where: int) -> list[str]:
    """A row of largest values; what is 0 is that at all positions."""
    return [name, value, "all" if value.split()[0] == "0" else str(where + 1)]


def checks(sheet: ReportSheet, c: ReportContext) -> None:
    r, k = c.r, c.k
    sheet.heading("Checks")
    links = []
    for link in r.links:
        some = on_link(actions(r), link)
        total = sum((a.force[k] for a in some), np.zeros(r.mechanism.dimension))
        largest = max((float(magnitude(a.force[k])) for a in some), default=0.0) or 1.0
        links.append(f"{c.shown.heading(link)} {remainder(float(magnitude(total)) / largest)}")
    gaps = "Closure gaps of the force polygons" if r.mechanism.dimension == 2 else "Sums of all forces"
    sheet.text(
        f"Out-of-balance force or moment over the largest force: {remainder(float(r.residual[k]))}; power balance: "
        f"{remainder(float(r.power_balance[k]))}. {gaps} over their largest force: {', '.join(links)}."
    )
    if r.mobility is not None and r.mechanism.dimension == 2:
        sheet.text(
            f"Mobility {r.mobility.freedoms}, drives {r.mobility.drives}, redundant constraints {r.mobility.redundant}."
        )
