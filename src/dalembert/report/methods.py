"""The other methods: graphical, superposition, virtual work; the cycle; the checks."""

from __future__ import annotations

from typing import Any

import numpy as np

from dalembert.analysis.actions import actions, magnitude, on_link
from dalembert.analysis.columns import drive_kinds, load_kind
from dalembert.analysis.members import members, order_of_solution
from dalembert.errors import ModelError
from dalembert.report.chosen import Chosen, as_formula
from dalembert.report.sheet import Sheet, Working
from dalembert.views import draw
from dalembert.views.notation import Shown, own_name


def graphical(sheet: Sheet, c: Chosen) -> None:
    r, shown = c.r, c.shown
    sheet.heading("Graphical solution")
    found = members(r)
    kinds = [f"{shown.heading(link)}: {m.kind} {m.state(c.k)}".strip() for link, m in found.items()]
    sheet.text(f"Classes of the links. {'; '.join(kinds)}.")
    touching = [f"{shown.heading(link)}: {m.touching}" for link, m in found.items() if m.touching]
    sheet.text(f"With friction: {'; '.join(touching)}." if touching else "")
    sheet.text(f"Order of solution: {'; then '.join(step.why for step in order_of_solution(r, found))}.")
    at = c.k + 1
    lines = [
        draw.lines_of_action(r, link, at, c.notation)
        for link, m in found.items()
        if m.kind in ("three-force", "four-force", "two-force with couple")
    ]
    polygons = [draw.force_polygon(r, link, at, c.notation) for link, m in found.items() if len(m.forces) > 1]
    sheet.figure(*lines, *polygons, *([draw.force_chain(r, at, c.notation)] if len(r.links) > 1 else []))


def superposition(sheet: Sheet, c: Chosen) -> None:
    from dalembert.analysis.superposition import superposition as split

    r, shown, k = c.r, c.shown, c.k
    try:
        parts = split(r)
    except ModelError as error:
        sheet.heading("Superposition")
        sheet.text(f"{error.what[:1].upper()}{error.what[1:]}.")
        return
    if len(parts.sources) < 2:
        return
    sheet.heading("Superposition")
    columns = [
        (shown_name(c, "effort", d), parts.efforts[:, k, n], drive_kinds(r, d)["effort"])
        for n, d in enumerate(r.drives)
    ]
    columns += [(own_name(u), parts.loads[:, k, n], load_kind(r, u)) for n, u in enumerate(r.unknown_loads)]
    for n, joint in enumerate(r.joints[:5]):
        sign = shown.reaction(joint, r.mechanism.joints[joint].links[1])
        for axis in (0, 1):
            columns.append((f"{sign[:-1]}{'xy'[axis]}}}", parts.force[:, k, n, axis], "force"))
    columns = columns[:9]
    heads = ["Source", *(f"{as_formula(name)}" for name, _, _ in columns)]
    floor = {
        kind: 1e-10 * max((np.abs(v).max() for _, v, q in columns if q == kind), default=0.0)
        for _, _, kind in columns
    }
    rows = [
        [source_sign(c, s), *(shown.number(kind, float(v[n]), floor[kind]) for _, v, kind in columns)]
        for n, s in enumerate(parts.sources)
    ]
    rows.append(["sum", *(shown.number(kind, float(v.sum()), floor[kind]) for _, v, kind in columns)])
    units = f"Forces in {shown.unit('force')}, couples in {shown.unit('moment')}"
    sheet.table(heads, rows, f"{units}; the parts sum to the whole within {parts.gap[k]:.0e}", total=True)
    external = [s for s in parts.sources if s in r.mechanism.loads]
    if 2 <= len(external) <= 4 and "graphical" in c.methods:
        sheet.figure(*(draw.force_chain(r, k + 1, c.notation, case=s) for s in external))


def shown_name(c: Chosen, kind: str, of: str) -> str:
    """The sign of a drive's effort."""
    return c.shown.symbol(next(a for a in actions(c.r) if a.kind == kind and a.of == of))


def source_sign(c: Chosen, source: str) -> str:
    """A contribution as the reader writes it."""
    if source in c.r.mechanism.loads:
        return as_formula(own_name(source))
    for words, letter in (
        ("inertia force of ", "F_{I"),
        ("inertia couple of ", "T_{I"),
        ("weight of ", "W_{"),
    ):
        if source.startswith(words):
            return f"${letter}{c.shown.link(source.removeprefix(words))}}}$"
    return source


def virtual_work(sheet: Sheet, c: Chosen) -> None:
    from dalembert.analysis.virtual_work import virtual_work as by_virtual_work

    r, shown, k = c.r, c.shown, c.k
    if not r.drives:
        return
    found = by_virtual_work(r)
    if found.independent:
        sheet.heading("Virtual work, the independent check")
    else:
        sheet.heading("Virtual work, a check")
        sheet.text(
            "The work of friction contains the joint forces found above: with friction virtual work checks that "
            "solution, it is no independent one."
        )
    idle = "no reaction does work" if found.independent else "of the reactions friction alone does work"
    for n, drive in enumerate(r.drives):
        kind = drive_kinds(r, drive)["effort"]
        angular = kind == "moment"
        unit = "rad" if angular else shown.unit("length")
        sheet.text(f"Displacements for one {unit} of drive {drive}; {idle}.")
        length = shown.value("length", 1.0)
        move, turn = (length, 1.0) if angular else (1.0, 1.0 / length)
        rows = []
        largest = float(np.abs(found.power[:, k, n]).max(initial=0.0))
        for a, v, w, p in zip(found.actions, found.velocity, found.spin, found.power, strict=True):
            force = bool(a.force.any())
            dx, dy = (
                shown.notation.number(float(x) * move if abs(float(x)) > 1e-12 else 0.0) for x in v[k, n]
            )
            acts = [_pair_of(shown, "force", a.force[k])] if force else []
            moves = [f"({dx}, {dy})"] if force else []
            if a.couple[k] or not force:
                acts.append(shown.number("moment", float(a.couple[k])))
                moves.append(shown.notation.number(float(w[k, n]) * turn * c.notation.torque))
            work = shown.number(kind, float(p[k, n]) * c.notation.torque**angular, 1e-12 * largest)
            rows.append([source_sign(c, a.source), " and ".join(acts), " and ".join(moves), work])
        total = float(found.power[:, k, n].sum())
        rows.append(["sum", "", "", shown.number(kind, total * c.notation.torque**angular)])
        heads = ["Load", "Force or couple", "Displacement or turn", f"Work ({shown.unit(kind)})"]
        sheet.table(heads, rows, total=True)
        sign = shown_name(c, "effort", drive)
        effort = shown.number(kind, float(found.effort[k, n]))
        sheet.equations(
            [Working(f"{sign} = −sum (F cdot delta r + T delta theta)", "", f'{effort} "{shown.unit(kind)}"')]
        )
    sheet.text(f"The matrix answer agrees within {float(found.gap[k]):.0e} of the largest work.")


def _pair_of(shown: Shown, kind: str, v: Any) -> str:
    return f"({', '.join(shown.number(kind, float(x)) for x in v)})"


def cycle(sheet: Sheet, c: Chosen) -> None:
    from dalembert.views import charts

    r = c.r
    if len(r.status) < 8 or not r.drives:
        return
    sheet.heading("Over the cycle")
    scenes = [*charts.effort_chart(r, c.notation), charts.reaction_chart(r, c.notation)]
    sheet.figure(*scenes)
    rows = []
    for d in r.drives:
        value, where = r.worst("effort", d)
        rows.append([f"effort {d}", c.shown.text(drive_kinds(r, d)["effort"], value), str(where + 1)])
    for j in r.joints:
        value, where = r.worst("reaction", j)
        rows.append([f"joint {j}", c.shown.text("force", value), str(where + 1)])
    sheet.table(["Largest", "Value", "Position"], rows)


def checks(sheet: Sheet, c: Chosen) -> None:
    r, k = c.r, c.k
    sheet.heading("Checks")
    links = []
    for link in r.links:
        some = on_link(actions(r), link)
        total = sum((a.force[k] for a in some), np.zeros(2))
        largest = max((float(magnitude(a.force[k])) for a in some), default=0.0) or 1.0
        links.append(f"{c.shown.heading(link)} {float(np.hypot(*total)) / largest:.0e}")
    sheet.text(
        f"Out-of-balance force or moment over the largest force: {float(r.residual[k]):.0e}; power balance: "
        f"{float(r.power_balance[k]):.0e}. Closure gaps of the force polygons over their "
        f"largest force: {', '.join(links)}."
    )
    if r.mobility is not None:
        sheet.text(
            f"Mobility {r.mobility.freedoms}, drives {r.mobility.drives}, redundant constraints {r.mobility.redundant}."
        )
