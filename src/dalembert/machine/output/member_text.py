"""Inner forces and stresses as a person reads them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.summary.printed_series import where
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.machine.members.member_forces import ORDER, kind_of
from dalembert.printing import Part, Table, number, remainder

if TYPE_CHECKING:
    from dalembert.machine.members.member_forces import MemberForces
    from dalembert.machine.members.member_table import MemberTable
    from dalembert.machine.members.stresses import Stresses

SIGNS = dict(zip(ORDER, ("N", "V", "V_z", "T", "M_y", "M"), strict=True))
NONE = 1e-11
"""Part of the largest force of a link that is nothing but rounding."""


def floors(f: MemberForces) -> dict[str, float]:
    """What of each inner force is nothing but rounding, by its kind."""
    force, moment = (
        max(np.nan_to_num(abs(f.largest(of)[0])) for of in f.names if kind_of(of) == kind)
        for kind in ("force", "moment")
    )
    length = sum(c.member.length for c in f.curves)
    return {"force": NONE * max(force, moment / length), "moment": NONE * max(force * length, moment)}


def member_parts(t: MemberTable, to: Printed) -> Iterator[Part]:
    """The largest inner forces of each link with place and position, stresses, buckling, and what was left out."""
    heads = ["link", "largest", "", "unit", "member", f"at\n{to.text('length')}", "where"]
    rows = _largest_rows(t, to)
    if rows or not t.unknown:
        yield Table(heads, rows, 2) if rows else "Nothing is carried inside the links."
    yield from (_unknown(t, which, why) for which, why in t.unknown.items())
    yield from (table for f in (_stress_table, _fatigue_table, _buckling_table) if (table := f(t, to)).rows)
    said = "N tension +; the distance is from the first end of the member. "
    known = [float(x) for f in t.links.values() for x in f.residual[f.residual == f.residual]]
    yield said + (f"Forces and moments close on every link within {remainder(max(known))}." if known else "")
    yield from (f"Left out: {why}." for why in t.left_out.values())


def _unknown(t: MemberTable, which: str, why: str) -> str:
    """What of which link is not known, and why."""
    lost = {link: f.unknown().get(which, []) for link, f in t.links.items()}
    if all(len(lost[link]) == len(f.names) for link, f in t.links.items()):
        return f"At position {which} forces inside links are not known: {why}"
    some = [f"{link} {', '.join(SIGNS[of] for of in names)}" for link, names in lost.items() if names]
    stress = ", nor the stress" if any(lost[link] for link in t.stress) else ""
    reason = why.partition(": reactions that")[0].rstrip(".")
    return f"At position {which} these are not known{stress}: {'; '.join(some)}. {reason}."


def _largest_rows(t: MemberTable, to: Printed) -> list[list[str]]:
    """Link, quantity, value, unit, member, place and position of the largest of each inner force."""
    rows = []
    for link, f in t.links.items():
        least = floors(f)
        for of in f.names:
            kind = kind_of(of)
            value, member, place, k = f.largest(of)
            if abs(value) > least[kind]:
                shown = [to.number(kind, value), to.text(kind), member, to.number("length", place)]
                rows.append([link, f"{SIGNS[of]} {of}", *shown, where(t.result, to, k)])
    return rows


def known_stresses(t: MemberTable) -> dict[str, Stresses]:
    """Stresses of the links where they are known."""
    return {link: s for link, s in t.stress.items() if not math.isnan(s.largest)}


def _stress_table(t: MemberTable, to: Printed) -> Table:
    rows = []
    for link, s in known_stresses(t).items():
        k = s.position
        numbers = [number(float(to("pressure", x)), 5) for x in (s.largest, *s.parts())]
        place = number(float(to("length", float(s.place[k]))), 4)
        rows.append([link, *numbers, s.member[k], place, where(t.result, to, k), _safety(s.safety)])
    heads = ["stress\nof link", f"largest\n{to.text('pressure')}", "by N\n", "by M\n", "member\n"]
    return Table([*heads, f"at\n{to.text('length')}", "where\n", "safety,\nyield"], rows)


def _fatigue_table(t: MemberTable, to: Printed) -> Table:
    found = {link: s.fatigue() for link, s in known_stresses(t).items() if len(t.result.status) > 1}
    rows = []
    for link, f in found.items():
        numbers = [number(float(to("pressure", x)), 5) for x in (f.mean, f.amplitude)]
        rows.append([link, *numbers, f.member, to.number("length", f.place), _safety(f.safety)])
    heads = ["fatigue\nof link", f"mean\n{to.text('pressure')}", "amplitude\n", "member\n"]
    lost = ", ".join(link for link, f in found.items() if math.isnan(f.mean))
    note = f"{lost}: not known, as the stress is not at every position." if lost else ""
    return Table([*heads, f"at\n{to.text('length')}", "safety,\nGoodman"], rows, note=note)


def _safety(n: float | None) -> str:
    return "-" if n is None or math.isinf(n) else number(n, 4)


def _buckling_table(t: MemberTable, to: Printed) -> Table:
    rows = []
    for link, b in t.buckling.items():
        sizes = [number(float(to("force", x)), 5) for x in (b.compression, b.critical)]
        rows.append([link, *sizes, b.formula, number(b.slenderness, 4), _safety(b.safety)])
    heads = ["buckling\nof link", f"compression\n{to.text('force')}", "critical\n", "by\n"]
    bent = ", ".join(link for link, b in t.buckling.items() if not b.two_force)
    note = f"{bent}: bent as well, so that this is for comparison." if bent else ""
    return Table([*heads, "slender-\nness", "safety\n"], rows, note=note)
