"""Inner forces and stresses as a person reads them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from dalembert.analysis.output.summary.printed_series import where
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.machine.members.member_forces import ORDER, kind_of
from dalembert.printing import Part, Table, number, remainder

if TYPE_CHECKING:
    from dalembert.machine.members.member_forces import MemberForces
    from dalembert.machine.members.member_table import MemberTable

SIGNS = dict(zip(ORDER, ("N", "V", "V_z", "T", "M_y", "M"), strict=True))
NONE = 1e-11
"""Part of the largest force of a link that is nothing but rounding."""


def floors(f: MemberForces) -> dict[str, float]:
    """What of each inner force is nothing but rounding, by its kind."""
    force = max(abs(f.largest(of)[0]) for of in f.names if kind_of(of) == "force")
    length = sum(c.member.length for c in f.curves)
    moment = max(abs(f.largest(of)[0]) for of in f.names if kind_of(of) == "moment")
    return {"force": NONE * max(force, moment / length), "moment": NONE * max(force * length, moment)}


def member_parts(t: MemberTable, to: Printed) -> Iterator[Part]:
    """The largest inner forces of each link with place and position, stresses, buckling, and what was left out."""
    heads = ["link", "largest", "", "unit", "member", f"at\n{to.text('length')}", "where"]
    rows = _largest_rows(t, to)
    yield Table(heads, rows, 2) if rows else "Nothing is carried inside the links."
    yield from (table for table in (_stress_table(t, to), _buckling_table(t, to)) if table.rows)
    said = "N tension +; the distance is from the first end of the member. "
    known = [float(x) for f in t.links.values() for x in f.residual[f.residual == f.residual]]
    yield said + (f"Forces and moments close on every link within {remainder(max(known))}." if known else "")
    yield from (f"Left out: {why}." for why in t.left_out.values())


def _largest_rows(t: MemberTable, to: Printed) -> list[list[str]]:
    """Link, quantity, value, unit, member, place and position of the largest of each inner force."""
    rows = []
    for link, f in t.links.items():
        least = floors(f)
        for of in f.names:
            kind = kind_of(of)
            value, member, place, k = f.largest(of)
            if abs(value) > least[kind] or math.isnan(value):
                shown = [to.number(kind, value), to.text(kind), member, to.number("length", place)]
                rows.append([link, f"{SIGNS[of]} {of}", *shown, where(t.result, to, k)])
    return rows


def _stress_table(t: MemberTable, to: Printed) -> Table:
    rows = []
    for link, s in t.stress.items():
        f, k = s.fatigue(), s.position
        direct, bent = s.parts()
        numbers = [number(float(to("pressure", x)), 5) for x in (s.largest, direct, bent)]
        place = number(float(to("length", float(s.place[k]))), 4)
        swing = [number(float(to("pressure", x)), 5) for x in (f.mean, f.amplitude)]
        safety = ["-" if n is None else number(n, 4) for n in (s.safety, f.safety)]
        rows.append([link, *numbers, place, where(t.result, to, k), safety[0], *swing, safety[1]])
    unit = to.text("pressure")
    heads = ["stress\nof link", f"largest\n{unit}", "by N\n", "by M\n", f"at\n{to.text('length')}", "where\n"]
    heads += ["safety,\nyield", "fatigue:\nmean", "ampli-\ntude", "safety,\nGoodman"]
    return Table(heads, rows)


def _buckling_table(t: MemberTable, to: Printed) -> Table:
    rows = []
    for link, b in t.buckling.items():
        sizes = [number(float(to("force", x)), 5) for x in (b.compression, b.critical)]
        safety = "-" if math.isinf(b.safety) else number(b.safety, 4)
        note = "" if b.two_force else "bent as well: for comparison"
        rows.append([link, sizes[0], sizes[1], b.formula, number(b.slenderness, 4), safety, note])
    heads = ["buckling\nof link", f"compression\n{to.text('force')}", "critical\n", "by\n"]
    heads += ["slender-\nness", "safety\n", ""]
    return Table(heads, rows)
