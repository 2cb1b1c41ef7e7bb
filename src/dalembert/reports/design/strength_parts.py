"""Pins, bearings and members of a design report."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from dalembert.analysis.methods.elements.cylinder_quantities import cylinders
from dalembert.machine.bearings.bearing_load import turning_joints
from dalembert.machine.bearings.bearing_table import BearingTable, bearings
from dalembert.machine.elements.pin_stresses import PinStresses, pin
from dalembert.machine.members.member_table import MemberTable, member_table
from dalembert.model.drives.cylinders import PARTS
from dalembert.reports.design.answers_on_sheets import put_answer
from dalembert.reports.design.verdict import (
    DesignContext,
    DesignPart,
    DesignVerdict,
    judged,
    most_place,
    not_judged,
    tightest_place,
    together,
)
from dalembert.reports.machine_sections import put_parts


def pin_part(c: DesignContext) -> Iterator[DesignPart]:
    """The bolts of pins: shear and bending against yield."""
    part, joints = DesignPart("Pins"), c.r.mechanism.joints
    sized = [j for j in c.r.joints if getattr(joints[j], "pin", None) is not None]
    for joint in sized:
        p = pin(c.r, joint)
        part.verdicts.append(_bolt(c, p))
        put_parts(part.sheet, p.contents("SI" if c.notation.units == "SI" else "file"))
    others = [j for j in c.r.joints if j not in sized and joints[j].hinge]
    if others:
        part.verdicts.append(not_judged(together(others), "the file has no pin sizes for them"))
    if part.verdicts:
        yield part


def _bolt(c: DesignContext, p: PinStresses) -> DesignVerdict:
    stress = np.fmax(p.bending, math.sqrt(3) * p.peak_shear)
    k = most_place(stress)
    value = c.text("pressure", float(stress[k]))
    if not np.isfinite(p.safety).any():
        return not_judged(f"bolt of {p.joint}", "its pin has no yield_stress", value, c.at(k))
    k = tightest_place(p.safety)
    return judged(f"yield of the bolt of {p.joint}", float(p.safety[k]), value, c.at(k))


def bearing_part(c: DesignContext) -> Iterator[DesignPart]:
    """Bearings with their static safety and life; what joints without one would need."""
    part, joints, turning = DesignPart("Bearings"), c.r.mechanism.joints, turning_joints(c.r)
    if not turning:
        return
    known = [j for j in turning if getattr(joints[j], "bearing", None) is not None]
    table = bearings(c.r, known or None)
    for joint in known:
        part.verdicts += list(_bearing(c, table, joint))
    others = [j for j in turning if j not in known]
    if others:
        part.verdicts.append(not_judged(together(others), "the file has no bearing for them"))
    put_answer(part.sheet, table, c, drawn=bool(known))
    yield part


def _bearing(c: DesignContext, t: BearingTable, joint: str) -> Iterator[DesignVerdict]:
    b = t.loads[joint]
    k = most_place(b.radial)
    if b.bearing is not None and b.bearing.rating:
        if b.static_safety is None:
            yield not_judged(f"bearing {joint}, at rest", "the bearing has no static rating", at=c.at(k))
        else:
            force = c.text("force", float(b.radial[k]))
            yield judged(f"bearing {joint}, C0 over the load", float(b.static_safety), force, c.at(k))
        life = f"{b.hours:.4g} h" if math.isfinite(b.hours) else "–"
        yield not_judged(f"life of bearing {joint}", "the file requires no life", life)
    if b.sized:
        value = c.text("pressure", float(b.pressure.max()))
        yield not_judged(f"pressure of bearing {joint}", "the file has no limit of it", value, c.at(k))


def member_part(c: DesignContext) -> Iterator[DesignPart]:
    """Links with a section: yield, fatigue, buckling; the others by name."""
    part = DesignPart("Members")
    table = member_table(c.r)
    columns = {f"{name}_{half}" for name in cylinders(c.r.mechanism) for half in PARTS}  # judged as columns
    bare = [link for link in table.links if link not in table.stress and link not in columns]
    for link in table.stress:
        part.verdicts += list(_stress(c, table, link))
    for link, b in table.buckling.items():
        if b.links[0] != link:
            continue
        name = f"buckling of {' and '.join(b.links)}"
        value = "no compression" if math.isinf(b.safety) else c.text("force", b.compression)
        remark = "" if b.two_force else "bent as well: for comparison"
        part.verdicts.append(judged(name, b.safety, value, c.at(b.position), remark))
    if bare:
        part.verdicts.append(not_judged(together(bare), "the file has no section for them"))
    part.verdicts += [not_judged(link, why) for link, why in table.left_out.items() if link not in columns]
    part.verdicts += [not_judged(f"buckling of {link}", why) for link, why in table.not_judged.items()]
    put_answer(part.sheet, table, c, drawn=bool(table.stress))
    yield part


def _stress(c: DesignContext, t: MemberTable, link: str) -> Iterator[DesignVerdict]:
    s = t.stress[link]
    if math.isnan(s.largest):
        yield not_judged(f"stress of {link}", "its inner forces are not known")
        return
    value, at = c.text("pressure", s.largest), c.at(s.position)
    if s.safety is None:
        yield not_judged(f"yield of {link}", "no yield_stress in the section", value, at)
    else:
        yield judged(f"yield of {link}", s.safety, value, at)
    if len(c.r.status) > 1:
        f = s.fatigue()
        value = f"{c.text('pressure', f.mean)} ± {c.text('pressure', f.amplitude)}"
        if f.safety is None:
            yield not_judged(f"fatigue of {link}", "no endurance and ultimate stress in the section", value)
        else:
            remark = f"Goodman, {'with its' if s.section.notch else 'no'} notches"
            yield judged(f"fatigue of {link}", f.safety, value, remark=remark)
