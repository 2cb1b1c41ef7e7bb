"""Printed form of inner forces and stresses."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from dalembert.analysis.output.summary.printed_series import where
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.machine.members.member_forces import ORDER, kind_of
from dalembert.machine.whole_cycle import sampled
from dalembert.printing import Part, TextTable, number, remainder, wrap

if TYPE_CHECKING:
    from dalembert.machine.members.member_forces import MemberForces
    from dalembert.machine.members.member_table import MemberTable
    from dalembert.machine.members.stresses import Stresses

SIGNS = dict(zip(ORDER, ("N", "V", "V_z", "T", "M_y", "M"), strict=True))
NONE = 1e-11
"""Part of the largest force of a link that is nothing but rounding."""
CLOSED = 1e-8
"""Part of the largest force of a link within which forces and moments close."""


def floors(f: MemberForces) -> dict[str, float]:
    """Rounding level of each inner force, by its kind."""
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
        yield TextTable(heads, rows, 2) if rows else "The links carry no internal forces."
    yield from (_unknown(t, which, why) for which, why in t.unknown.items())
    yield from (
        table
        for f in (_stress_table, _fatigue_table, _buckling_table, _deflection_table)
        if (table := f(t, to)).rows
    )
    if notes := " ".join(_buckling_notes(t)):
        yield notes
    yield f"N tension +; the distance is from the first end of the member. {_closure(t)}".rstrip()
    yield from (f"Left out: {why}." for why in t.left_out.values())
    yield from (_brackets(link, f, to) for link, f in t.links.items() if f.brackets)
    yield from (f"Buckling of {link} is not judged: {why}." for link, why in t.not_judged.items())


def _closure(t: MemberTable) -> str:
    """Equilibrium error of forces and moments, or the link on which it is too large."""
    with np.errstate(all="ignore"):
        known = {link: float(np.nanmax(f.residual, initial=0.0)) for link, f in t.links.items()}
    if not any(np.isfinite(f.residual).any() for f in t.links.values()):
        return ""
    link = max(known, key=lambda n: known[n])
    if known[link] > CLOSED:
        what = f"{remainder(known[link])} of the largest is left over"
        return f"Check failed: forces and moments do not close on {link}, {what}; do not use these numbers."
    return f"Equilibrium of every link holds to {remainder(known[link])}."


def _brackets(link: str, f: MemberForces, to: Printed) -> str:
    """Loads off the members of a link, by a bracket that is not analysed."""
    some = ", ".join(f"{of} ({to.number('length', x)} {to.text('length')})" for of, x in f.brackets.items())
    return f"Loads off the members of {link}: {some}. Their brackets are assumed rigid and are not analysed."


def _unknown(t: MemberTable, which: str, why: str) -> str:
    """Inner forces of a link that are not known, with the reason."""
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


def _stress_table(t: MemberTable, to: Printed) -> TextTable:
    rows = []
    for link, s in known_stresses(t).items():
        k = s.position
        numbers = [number(float(to("pressure", x)), 5) for x in (s.largest, *s.parts())]
        place = number(float(to("length", float(s.place[k]))), 4)
        rows.append([link, *numbers, s.member[k], place, where(t.result, to, k), _safety(s.safety)])
    heads = ["stress\nof link", f"largest\n{to.text('pressure')}", "by N\n", "by M\n", "member\n"]
    return TextTable([*heads, f"at\n{to.text('length')}", "where\n", "safety,\nyield"], rows)


def _fatigue_table(t: MemberTable, to: Printed) -> TextTable:
    fatigues = {link: s.fatigue() for link, s in known_stresses(t).items() if len(t.result.status) > 1}
    rows = []
    for link, f in fatigues.items():
        numbers = [number(float(to("pressure", x)), 5) for x in (f.mean, f.amplitude)]
        rows.append([link, *numbers, f.member, to.number("length", f.place), _safety(f.safety)])
    heads = ["fatigue\nof link", f"mean\n{to.text('pressure')}", "amplitude\n", "member\n"]
    lost = ", ".join(link for link, f in fatigues.items() if math.isnan(f.mean))
    note = f"{lost}: not known, as the stress is not at every position. " if lost else ""
    changes = {link: f.sampling for link, f in fatigues.items()}
    note = wrap(note + sampled(t.result, changes, "Largest values, means and amplitudes")) if rows else note
    return TextTable([*heads, f"at\n{to.text('length')}", "safety,\nGoodman"], rows, note=note)


def _safety(n: float | None) -> str:
    return "-" if n is None or not math.isfinite(n) else number(n, 4)


def _buckling_table(t: MemberTable, to: Printed) -> TextTable:
    rows, seen = [], []
    for b in t.buckling.values():
        if b not in seen:
            seen.append(b)
            sizes = [
                "-" if math.isnan(x) else number(float(to("force", x)), 5)
                for x in (b.compression, b.critical)
            ]
            factors = [number(x, 4) for x in b.effective_length]
            held = "-".join(b.ends) if b.ends[0] != "given" else "given"
            numbers = [_safety(b.safety), b.formula, *factors, held, number(b.slenderness, 4)]
            rows.append([", ".join(b.links), *sizes, *numbers])
    heads = ["buckling\nof link", f"compression\n{to.text('force')}", "critical\n", "safety\n", "by\n"]
    heads += [f"K\n{plane}" for plane in t.planes] + ["ends\n", "slender-\nness"]
    return TextTable(heads, rows)


def _deflection_table(t: MemberTable, to: Printed) -> TextTable:
    rows = []
    for link, d in t.deflection.items():
        if not d.largest > 0:
            continue
        k = d.position
        slopes = {joint: float(np.nanmax(slope)) for joint, slope in d.slopes().items()}
        angles = ", ".join(f"{joint} {number(1e3 * slope, 3)}" for joint, slope in slopes.items())
        place = to.number("length", float(d.place[k]))
        rows.append(
            [link, to.number("length", d.largest), d.member[k], place, where(t.result, to, k), angles]
        )
    heads = [
        "deflection\nof link",
        f"largest\n{to.text('length')}",
        "member\n",
        f"at\n{to.text('length')}",
        "where\n",
    ]
    note = wrap(
        "Deflections are from the tangent at a weld or a driven joint, else from the chord through the outermost "
        "joints; shear is neglected."
    )
    return TextTable([*heads, "slopes\nmrad"], rows, note=note if rows else "")


def _buckling_notes(t: MemberTable) -> Iterator[str]:
    """Assumptions of the critical loads, and where they are for comparison."""
    if any(b.ends[0] != "given" for b in t.buckling.values()):
        yield (
            "K L is the effective length; the ends are those in the governing plane, as the joints hold them with "
            "the drives at rest and the other links rigid, under a force of constant direction."
        )
        if t.result.mechanism.dimension == 2:
            yield "Across the plane joints hold their places; only welds, and what holds a link alone, hold the angle."
    moved = list(dict.fromkeys(", ".join(b.links) for b in t.buckling.values() if b.moves_along))
    if moved:
        yield (
            f"{'; '.join(moved)}: a joint at an end moves across with other links. Where these push from a point close "
            "ahead, as in a toggle, the critical load is lower."
        )
    stepped = list(dict.fromkeys(", ".join(b.links) for b in t.buckling.values() if len(b.links) > 1))
    if stepped:
        yield f"{'; '.join(stepped)}: one stepped column, K with EI of the weaker part over the full length."
    bent = list(dict.fromkeys(", ".join(b.links) for b in t.buckling.values() if not b.two_force))
    if bent:
        yield f"{'; '.join(bent)}: bent as well, so that the buckling load is for comparison."
