"""The motion by loop equations, and the inertia forces that follow from it."""

from __future__ import annotations

import math

import numpy as np

from dalembert.analysis.methods.members import displaced_inertia, inertia_shares
from dalembert.analysis.output.rounding import PART
from dalembert.reports.formula import bracket_negative
from dalembert.reports.report_context import ReportContext, figure
from dalembert.reports.sections import kinematics
from dalembert.reports.sections.gear_motion import mesh
from dalembert.reports.sheet import ReportSheet, Working
from dalembert.views import draw
from dalembert.views.notation import Notation, pretty
from dalembert.views.plane.velocity_polygons import stands_still


def motion(sheet: ReportSheet, c: ReportContext) -> None:
    r, shown = c.r, c.shown
    if not r.drives:
        return
    sheet.heading("Motion by loop equations" if "steps" in c.methods else "Motion")
    moving = not stands_still(r, c.k)
    for n, loop in enumerate(kinematics.loops(r, c.k)):
        names = " – ".join(shown.heading(link) for link in loop.links)
        sheet.text(f"Loop {n + 1} through links {names}: the sides sum to zero.")
        sheet.equations(kinematics.position_lines(loop, shown))
        if moving:
            sheet.equations(kinematics.velocity_lines(loop, shown))
            sheet.equations(kinematics.acceleration_lines(loop, shown))
    for name, joint in r.mechanism.joints.items() if moving else ():
        if hasattr(joint, "signed_radii") or joint.TOOTHED:
            words, lines = mesh(r, c.k, name, shown)
            sheet.text(words)
            sheet.equations(lines)
    heads, rows = _motion_table(c, moving)
    sheet.table(heads, rows, "Motion of the links and of their mass centres")
    if moving:
        sheet.figure(
            draw.velocity_polygon(r, c.k + 1, c.notation), draw.acceleration_polygon(r, c.k + 1, c.notation)
        )


def _motion_table(c: ReportContext, moving: bool) -> tuple[list[str], list[list[str]]]:
    r, shown, k = c.r, c.shown, c.k
    heads = ["Link", "$theta$ (°)"]
    if moving:
        heads += [
            f"$omega$ ({shown.unit('angular_speed')})",
            f"$alpha$ ({shown.unit('angular_acceleration')})",
        ]
        heads += [f"$a_{{G{axis}}}$ ({shown.unit('acceleration')})" for axis in "xy"]
    rows = []
    for link in r.links:
        row = [shown.heading(link), shown.notation.degrees(float(r.angle(link)[k]))]
        if moving:
            a = r.center_acceleration(link)[k]
            row += [shown.number("angular_speed", float(r.speed(link)[k]))]
            row += [shown.number("angular_acceleration", float(r.acceleration(link)[k]))]
            row += [shown.number("acceleration", float(x)) for x in a]
        rows.append(row)
    return heads, rows


def inertia(sheet: ReportSheet, c: ReportContext) -> None:
    r = c.r
    heavy = [link for link in r.links if r.mechanism.mass(link)]
    if not r.inertia or not heavy:
        return
    sheet.heading("Inertia forces")
    if not any(np.any(r.center_acceleration(n)[c.k]) or np.any(r.acceleration(n)[c.k]) for n in heavy):
        sheet.text("No mass accelerates at this position: all inertia forces are zero.")
        shares(sheet, c)
        return
    units_of_inertia(sheet, c)
    sheet.equations([line for link in heavy for line in _inertia_lines(c, link)])
    turned = {k for k in heavy if abs(float(r.acceleration(k)[c.k])) > c.shown.least["angular_acceleration"]}
    displaced = [k for k in heavy if r.mechanism.inertia(k) and k in turned]
    sheet.figure(*(draw.displaced_inertia(r, k, c.k + 1, c.notation) for k in displaced[:3]))
    shares(sheet, c)


def units_of_inertia(sheet: ReportSheet, c: ReportContext) -> None:
    """Note on the factor between mass times acceleration and force where they differ in the reader's units."""
    shown, sentences = c.shown, []
    for words, kind, of in (
        ("masses times accelerations", "force", ("mass", "acceleration")),
        ("moments of inertia times angular accelerations", "moment", ("inertia", "angular_acceleration")),
    ):
        factor, product = shown.factor(kind, *of), "·".join(shown.unit(k).removeprefix("rad") for k in of)
        product = product.replace("·/", "/")
        if factor < 1:
            size = pretty(shown.conversion(1 / factor))
            sentences.append(f"As 1 {shown.unit(kind)} is {size} {product}, {words} are divided by {size}.")
        elif factor > 1:
            size = pretty(shown.conversion(factor))
            sentences.append(
                f"As 1 {product} is {size} {shown.unit(kind)}, {words} are multiplied by {size}."
            )
    turning = shown.factor("moment", "inertia", "angular_acceleration")
    same = math.isclose(shown.factor("force", "mass", "acceleration"), turning)
    if same and sentences:
        both = "masses times accelerations and moments of inertia times angular accelerations"
        sentences = [sentences[0].replace("masses times accelerations", both)]
    sheet.text(" ".join(sentences))


def shares(sheet: ReportSheet, c: ReportContext) -> None:
    """Shares of inertia: shows whether it could be left out."""
    parts = inertia_shares(c.r)
    if not parts:
        return
    worst, many = parts[0], " over the cycle" if len(c.r.status) > 1 else ""
    if not worst.share > PART:
        sheet.text(f"Inertia could be neglected: no mass is accelerated{many}.")
        return
    verdict = "could be neglected" if worst.share < 0.05 else "must not be neglected"
    share = Notation(figures=2).percent(worst.share)
    sheet.text(
        f"Inertia {verdict}: it accounts for up to {share} of the largest {worst.quantity} of {worst.of}{many}."
    )


def _inertia_lines(c: ReportContext, link: str) -> list[Working]:
    """F_I = -m a_G with its size and direction, T_I = -I alpha, and the offset of the force that makes both."""
    r, shown, k = c.r, c.shown, c.k
    n, m, inertia = shown.link(link), r.mechanism.mass(link), r.mechanism.inertia(link)
    a, displaced = r.center_acceleration(link)[k], displaced_inertia(r, link)
    fx, fy = (float(f) for f in displaced.force[k])
    size, alpha = math.hypot(fx, fy), float(r.acceleration(link)[k])
    number = shown.number
    ax, ay = (number("acceleration", float(x)) for x in a)
    product = f"−{number('mass', m)} ({ax}, {ay})"
    direction = f" angle {c.notation.direction(fx, fy)} deg" if size > shown.least["force"] else ""
    out = [
        Working(
            f"F_{{I{n}}} = −m_{{{n}}} a_{{G{n}}}",
            shown.with_factor(product, "force", "mass", "acceleration"),
            f"({number('force', fx)}, {number('force', fy)}) = {figure(shown, 'force', size)}{direction}",
        )
    ]
    if not inertia or abs(alpha) <= shown.least["angular_acceleration"]:
        return out
    minus = "−" if c.notation.torque > 0 else ""
    turned = bracket_negative(number("angular_acceleration", alpha))
    product = f"{minus}{number('inertia', inertia)} cdot {turned}"
    couple = float(displaced.couple[k])
    out.append(
        Working(
            f"T_{{I{n}}} = {minus}I_{{{n}}} alpha_{{{n}}}",
            shown.with_factor(product, "moment", "inertia", "angular_acceleration"),
            figure(shown, "moment", couple),
        )
    )
    if size > shown.least["force"]:
        out.append(
            Working(
                f"h_{{{n}}} = frac(|T_{{I{n}}}|; F_{{I{n}}})",
                f"frac({number('moment', couple).lstrip('−')}; {number('force', size)})",
                f'{c.notation.number(float(displaced.offset[k]) / shown.arm)} "{shown.arm_unit}"',
            )
        )
    return out
