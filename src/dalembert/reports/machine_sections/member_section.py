"""Forces inside links worked out: how they are found, the largest of each, stresses, the diagrams."""

from __future__ import annotations

from dalembert.machine.members.member_table import MemberTable
from dalembert.machine.output.member_text import largest_rows
from dalembert.reports.sheet import Sheet, Working
from dalembert.views.machine.member_views import member_scenes
from dalembert.views.notation import Notation, Shown


def member_section(sheet: Sheet, t: MemberTable, notation: Notation) -> None:
    """The equations, the largest over the cycle, the stress in letters and numbers, and diagrams."""
    shown = Shown(t.result, notation)
    sheet.heading("Forces inside the links")
    sheet.text(
        "F and M are what the part of a link beyond a cut exerts on the part before it; t points along the member, n "
        "across it, turned by +90°. The load along it is weight and inertia of its own mass."
    )
    sheet.equations(
        [
            Working("N = F t quad V = -F n"),
            Working("q = mu (g - a)"),
            Working("frac(d N; d s) = -q_{t} quad frac(d V; d s) = q_{n} quad frac(d M; d s) = V"),
        ]
    )
    heads = ["link", "largest", "value", "unit", "member", f"at {shown.unit('length')}", "where"]
    sheet.table(heads, largest_rows(t, shown.scale), "The largest over the positions")
    for link, s in t.stress.items():
        direct, bent = (shown.text("pressure", x) for x in s.parts())
        most = shown.text("pressure", s.largest)
        safety = f", {notation.number(s.safety)} below the yield stress" if s.safety is not None else ""
        said = f"{link}: at {shown.text('length', float(s.place[s.position]))} of {s.member[s.position]} the stress "
        sheet.text(f"{said}is {most}{safety}: {direct} by N, {bent} by M.")
    for link, b in t.buckling.items():
        sizes = [shown.text("force", x) for x in (b.compression, b.critical)]
        sheet.text(f"{link}: compression of {sizes[0]} at most; it buckles at {sizes[1]} by {b.formula}.")
    sheet.figure(*member_scenes(t, notation))
