"""Forces inside links worked out: how they are found."""

from __future__ import annotations

from dalembert.machine.members.member_table import MemberTable
from dalembert.machine.output.member_text import known_stresses
from dalembert.reports.sheet import Sheet, Working
from dalembert.views.notation import Shown


def member_section(sheet: Sheet, t: MemberTable, shown: Shown) -> None:
    """The equations, and of each section the stress in letters and numbers."""
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
    for link, s in known_stresses(t):
        direct, bent = (shown.number("pressure", x) for x in s.parts())
        most = f'{shown.number("pressure", s.largest)} "{shown.unit("pressure")}"'
        where = f"{link}, {shown.text('length', float(s.place[s.position]))} along {s.member[s.position]}:"
        sheet.text(f"{where} by N and by M at the fibre that is stressed most, and with torsion or shear")
        letters = "sigma = frac(N; A) + frac(M; W) quad sigma_{v}^{2} = sigma^{2} + 3 tau^{2}"
        sheet.equations([Working(letters, f"{direct} + ({bent})", f"sigma_{{v}} = {most}")])
