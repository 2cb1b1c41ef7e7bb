"""Worked solution of the forces inside links."""

from __future__ import annotations

from dalembert.machine.members.member_table import MemberTable
from dalembert.machine.output.member_text import known_stresses
from dalembert.reports.formula import bracket_negative
from dalembert.reports.sheet import ReportSheet, Working
from dalembert.views.notation import Shown

LAWS = (
    ("N = F t quad V = -F n", "frac(d N; d s) = -q_{t} quad frac(d V; d s) = q_{n} quad frac(d M; d s) = V"),
    (
        "N = F t quad V_{y} = -F y quad V_{z} = F z quad T = M t quad M_{y} = M y quad M_{z} = M z",
        "frac(d N; d s) = -q_{t} quad frac(d V_{y}; d s) = q_{y} quad frac(d V_{z}; d s) = -q_{z}",
        "frac(d M_{z}; d s) = V_{y} quad frac(d M_{y}; d s) = V_{z}",
    ),
)
"""Words for the plane and for space."""
ACROSS = "n across it, turned by +90°", "y and z across it, y turned by +90° about the link's z axis"
BENT = "+ frac(M; W)", "- frac(M_{z} y; I_{z}) + frac(M_{y} z; I_{y})"


def member_section(sheet: ReportSheet, t: MemberTable, shown: Shown) -> None:
    """The equations, and of each section the stress in letters and numbers."""
    sheet.heading("Forces inside the links")
    space = t.result.mechanism.dimension == 3
    sheet.text(
        "F and M are the force and couple of the part of a link beyond a cut on the part before it; t points along "
        f"the member, {ACROSS[space]}. The distributed load is the weight and inertia of the member's mass."
    )
    sheet.equations([Working(line) for line in ("q = mu (g - a)", *LAWS[space])])
    for link, s in known_stresses(t).items():
        direct, bent = s.parts()
        sigma, most = (
            f'{shown.number("pressure", x)} "{shown.unit("pressure")}"' for x in (direct + bent, s.largest)
        )
        where = f"{link}, {shown.text('length', float(s.place[s.position]))} along {s.member[s.position]}:"
        sheet.text(
            f"{where} at the fibre with the largest stress, with torsion at that fibre or shear at the axis"
        )
        numbers = f"{shown.number('pressure', direct)} + {bracket_negative(shown.number('pressure', bent))}"
        von_mises = Working("sigma_{v} = (sigma^{2} + 3 tau^{2})^{1/2}", "", most)
        sheet.equations([Working(f"sigma = frac(N; A) {BENT[space]}", numbers, sigma), von_mises])
