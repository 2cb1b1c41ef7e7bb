"""Machine elements of a design report: cylinders, cams, contacts, belts, ropes, brakes, screws."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from dalembert.analysis.methods.elements.cylinder_quantities import cylinders
from dalembert.analysis.methods.elements.screw_torques import screws
from dalembert.analysis.output.summary.printed_contacts import LEAST, contact_parts
from dalembert.analysis.output.summary.printed_elements import element_parts as printed_elements
from dalembert.analysis.result.number_kinds import contact_kind
from dalembert.machine.elements.cam_design import cam
from dalembert.model.joints.elements.belts import Belt
from dalembert.model.joints.elements.cams import Cam
from dalembert.reports.design.verdict import (
    DesignContext,
    DesignPart,
    DesignVerdict,
    attempted,
    judged,
    least_place,
    most_place,
    not_judged,
)
from dalembert.reports.machine_sections import put_parts

STEEP = {False: math.radians(30), True: math.radians(45)}
"""Customary largest pressure angle of a follower that slides, and of one that swings (Norton, chapter 8)."""


def element_parts(c: DesignContext) -> Iterator[DesignPart]:
    """A section for each kind of element that the machine has."""
    for title, find in ELEMENTS:
        yield from attempted(c, title, find)


def _cylinders(c: DesignContext) -> Iterator[DesignPart]:
    names = list(cylinders(c.r.mechanism))
    if not names:
        return
    part = DesignPart("Cylinders")
    for name in names:
        a = c.r.cylinder(name)
        k = most_place(a.pressure)
        value = c.text("pressure", float(a.pressure[k]))
        part.verdicts.append(not_judged(f"pressure of {name}", "the file has no limit of it", value, c.at(k)))
        if np.isfinite(a.critical).any():
            k = a.worst
            pushes = bool((a.force > 0).any())
            value = c.text("force", float(a.force[k])) if pushes else "only pulls"
            part.verdicts.append(
                judged(f"buckling of the column of {name}", float(a.safety[k]), value, c.at(k))
            )
        else:
            reason = "barrel, closed and stroke are not all given"
            part.verdicts.append(not_judged(f"buckling of the column of {name}", reason))
        if a.vacuum.any():
            at = c.at(int(np.argmax(a.vacuum)))
            part.verdicts.append(DesignVerdict(f"vacuum in {name}", "exceeded", at=at))
        part.verdicts.append(_stroke(c, name, a))
    put_parts(part.sheet, printed_elements(c.r, c.to))
    yield part


def _stroke(c: DesignContext, name: str, a: Any) -> DesignVerdict:
    limits = cylinders(c.r.mechanism)[name].lengths
    low, high = float(np.nanmin(a.length)), float(np.nanmax(a.length))
    value = f"{c.text('length', low)} to {c.text('length', high)}"
    if limits is None:
        return not_judged(f"stroke of {name}", "the file has no closed length and stroke", value)
    kept = limits[0] <= low * (1 + 1e-9) and high <= limits[1] * (1 + 1e-9)
    remark = f"it has {c.text('length', limits[0])} to {c.text('length', limits[1])}"
    return DesignVerdict(f"stroke of {name}", "ok" if kept else "exceeded", value, remark=remark)


def _cams(c: DesignContext) -> Iterator[DesignPart]:
    names = [n for n, j in c.r.mechanism.joints.items() if isinstance(j, Cam)]
    if not names:
        return
    part = DesignPart("Cams")
    for name in names:
        made = cam(c.r.mechanism, name)
        swings = made.motion.carrier.swings
        angle, limit = abs(made.pressure_angle_peak), STEEP[swings]
        remark = f"customary limit {math.degrees(limit):.0f} deg"
        if not made.motion.joint.flat:
            part.verdicts.append(
                judged(
                    f"pressure angle of {name}, rising", limit / angle, c.text("angle", angle), remark=remark
                )
            )
        if math.isfinite(made.least_base):
            base = made.motion.joint.profile.base
            value = f"least {c.text('length', made.least_base)}"
            if base is not None and made.least_base > 0:
                part.verdicts.append(
                    judged(f"base radius of {name}, no undercut", base / made.least_base, value)
                )
        put_parts(part.sheet, made.contents(c.notation.units))
        part.sheet.figure(*made.drawings(c.notation))
    yield part


def _contacts(c: DesignContext) -> Iterator[DesignPart]:
    pushing = c.r.compiled.pushing
    if pushing is None:
        return
    part = DesignPart("Contacts")
    for name in dict.fromkeys(c.r.joints[k] for k in pushing.joint):
        contact = c.r.contact(name)
        force = contact.needed  # below 0 where it is lost
        if not np.isfinite(force).any():
            part.verdicts.append(not_judged(f"contact {name}", "its force is not known"))
            continue
        k = least_place(force)
        kind = contact_kind(c.r, name)
        value = f"{LEAST[kind]} {c.text(kind, float(force[k]))}"
        ends = [x for x in (force, contact.behind, contact.ahead) if x is not None]
        lost = any(bool((x < 0).any()) for x in ends)
        part.verdicts.append(
            DesignVerdict(f"contact {name}", "exceeded" if lost else "ok", value, at=c.at(k))
        )
    put_parts(part.sheet, contact_parts(c.r, c.to))
    yield part


def _belts(c: DesignContext) -> Iterator[DesignPart]:
    """The coefficient of friction that belts need."""
    names = [n for n, j in c.r.mechanism.joints.items() if isinstance(j, Belt)]
    if names:
        yield DesignPart("Belts", [_belt(c, name, c.r.belt(name)) for name in names])


def _ropes(c: DesignContext) -> Iterator[DesignPart]:
    """The largest tension of ropes, and of belts with idlers."""
    part = DesignPart("Ropes")
    for name in c.r.mechanism.ropes:
        tight = np.asarray(c.r.rope(name).tension, float).reshape(len(c.r.status), -1).max(axis=1)
        k = most_place(tight)
        value = c.text("force", float(tight[k]))
        part.verdicts.append(not_judged(f"tension of {name}", "the file has no limit of it", value, c.at(k)))
    if part.verdicts:
        yield part


def _belt(c: DesignContext, name: str, a: Any) -> DesignVerdict:
    k = most_place(np.where(np.isinf(a.slip_coefficient), np.nan, a.slip_coefficient))
    value = f"tight {c.text('force', float(a.tight[k]))}, slack {c.text('force', float(a.slack[k]))}"
    if math.isnan(a.coefficient):
        return not_judged(f"{name}, slip", "it has no friction", value, c.at(k))
    margin = math.inf if not a.slip_coefficient[k] else float(a.coefficient / a.slip_coefficient[k])
    if np.isinf(a.slip_coefficient).any():
        margin = 0.0
    return judged(f"{name}, slip", margin, value, c.at(k))


def _brakes(c: DesignContext) -> Iterator[DesignPart]:
    names = [n for n, j in c.r.mechanism.joints.items() if j.BRAKES]
    if not names:
        return
    part = DesignPart("Brakes and clutches")
    for name in names:
        b = c.r.brake(name)
        torque = np.abs(b.torque)
        k = most_place(torque)
        value, at = c.text("moment", float(torque[k])), c.at(k)
        part.verdicts.append(not_judged(f"torque of {name}", "the file requires no torque", value, at))
        if math.isfinite(b.locking_coefficient) and math.isfinite(b.coefficient):
            margin = b.locking_coefficient / b.coefficient
            part.verdicts.append(judged(f"{name} does not grab", margin, f"coefficient {b.coefficient:.4g}"))
        pressure = np.asarray(b.pressure, float)
        if np.isfinite(pressure).any():
            k = most_place(pressure)
            value = c.text("pressure", float(pressure[k]))
            part.verdicts.append(
                not_judged(f"pressure of {name}", "the file has no limit of it", value, c.at(k))
            )
    yield part


def _screws(c: DesignContext) -> Iterator[DesignPart]:
    names = list(screws(c.r.mechanism))
    if not names:
        return
    part = DesignPart("Power screws")
    for name in names:
        s = c.r.screw(name)
        torque = np.fmax(np.abs(s.torque_low), np.abs(s.torque_high))
        k = most_place(torque)
        locks = "self-locking" if s.self_locking else "not self-locking"
        value = c.text("moment", float(torque[k]))
        part.verdicts.append(
            not_judged(f"torque of {name}", f"the file has no limit of it; {locks}", value, c.at(k))
        )
    yield part


ELEMENTS = (
    ("Cylinders", _cylinders),
    ("Cams", _cams),
    ("Contacts", _contacts),
    ("Belts", _belts),
    ("Ropes", _ropes),
    ("Brakes and clutches", _brakes),
    ("Power screws", _screws),
)
"""Title -> what gives the section."""
