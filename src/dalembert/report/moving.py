"""The motion by loop equations, and the inertia forces that follow from it."""

from __future__ import annotations

import math

import numpy as np

from dalembert.analysis.members import displaced_inertia, inertia_shares
from dalembert.report import kinematics
from dalembert.report.chosen import Chosen
from dalembert.report.formula import bracketed
from dalembert.report.meshes import mesh
from dalembert.report.sheet import Sheet, Working
from dalembert.views import draw


def motion(sheet: Sheet, c: Chosen) -> None:
    r, shown = c.r, c.shown
    if not r.drives:
        return
    sheet.heading("Motion")
    moving = any(np.any(r.speed(link)) or np.any(r.acceleration(link)) for link in r.links)
    for n, loop in enumerate(kinematics.loops(r, c.k)):
        names = " – ".join(shown.heading(link) for link in loop.links)
        sheet.text(f"Loop {n + 1} through links {names}: the sides sum to zero.")
        sheet.equations(kinematics.position_lines(loop, shown))
        if moving:
            sheet.equations(kinematics.velocity_lines(loop, shown))
            sheet.equations(kinematics.acceleration_lines(loop, shown))
    for name, joint in r.mechanism.joints.items() if moving else ():
        if joint.type == "gear":
            words, lines = mesh(r, c.k, name, shown)
            sheet.text(words)
            sheet.equations(lines)
    heads, rows = _motion_table(c, moving)
    sheet.table(heads, rows, "Solved for the motion of the links and of their mass centres")
    if moving:
        sheet.figure(
            draw.velocity_polygon(r, c.k + 1, c.notation), draw.acceleration_polygon(r, c.k + 1, c.notation)
        )


def _motion_table(c: Chosen, moving: bool) -> tuple[list[str], list[list[str]]]:
    r, shown, k = c.r, c.shown, c.k
    number = shown.notation.number
    heads = ["Link", "$theta$ (°)"]
    if moving:
        heads += ["$omega$ (rad/s)", "$alpha$ (rad/s²)"]
        heads += [f"$a_{{G{axis}}}$ ({shown.unit('acceleration')})" for axis in "xy"]
    rows = []
    for link in r.links:
        row = [shown.heading(link), f"{math.degrees(float(r.angle(link)[k])):.3f}".replace("-", "−")]
        if moving:
            a = r.center_acceleration(link)[k]
            row += [number(float(r.speed(link)[k])), number(float(r.acceleration(link)[k]))]
            row += [shown.number("acceleration", float(x)) for x in a]
        rows.append(row)
    return heads, rows


def inertia(sheet: Sheet, c: Chosen) -> None:
    r = c.r
    heavy = [link for link in r.links if r.mechanism.mass(link)]
    if not r.inertia or not heavy:
        return
    sheet.heading("Inertia forces")
    lines = [line for link in heavy for line in _inertia_lines(c, link)]
    sheet.equations(lines)
    displaced = [k for k in heavy if r.mechanism.inertia(k) and float(r.acceleration(k)[c.k])]
    sheet.figure(*(draw.displaced_inertia(r, k, c.k + 1, c.notation) for k in displaced[:3]))
    shares(sheet, c)


def shares(sheet: Sheet, c: Chosen) -> None:
    """Whether inertia could be left out."""
    found = inertia_shares(c.r)
    if found:
        least = max(s.share for s in found)
        worst = found[0]
        said = "could be left out" if least < 0.05 else "must not be left out"
        sheet.text(
            f"Inertia {said}: it makes up to {100 * least:.0f} % of the largest {worst.quantity} of {worst.of}"
            f"{' over the cycle' if len(c.r.status) > 1 else ''}."
        )


def _inertia_lines(c: Chosen, link: str) -> list[Working]:
    r, shown, k = c.r, c.shown, c.k
    n, m, inertia = shown.link(link), r.mechanism.mass(link), r.mechanism.inertia(link)
    a, found = r.center_acceleration(link)[k], displaced_inertia(r, link)
    fx, fy = (float(f) for f in found.force[k])
    size, angle = math.hypot(fx, fy), math.degrees(math.atan2(fy, fx))
    number = shown.number
    out = [
        Working(
            f"F_{{I{n}}} = −m_{{{n}}} a_{{G{n}}}",
            f"−{number('mass', m)} ({number('acceleration', float(a[0]))}, {number('acceleration', float(a[1]))})",
            f'({number("force", fx)}, {number("force", fy)}) = {number("force", size)} "{shown.unit("force")}"'
            + (f" angle {angle:.2f} deg".replace("-", "−") if size > 0 else ""),
        )
    ]
    if inertia and float(r.acceleration(link)[k]):
        couple = number("moment", float(found.couple[k]))
        moment = shown.unit("moment")
        alpha = shown.notation.number(float(r.acceleration(link)[k]))
        out.append(
            Working(
                f"T_{{I{n}}} = −I_{{{n}}} alpha_{{{n}}}",
                f"−{number('inertia', inertia)} cdot {bracketed(alpha)}",
                f'{couple} "{moment}"',
            )
        )
        if size > 0:
            offset = number("length", float(found.offset[k]))
            out.append(
                Working(
                    f"h_{{{n}}} = frac(I_{{{n}}} alpha_{{{n}}}; F_{{I{n}}})",
                    f"frac({couple.lstrip('−')}; {number('force', size)})",
                    f'{offset} "{shown.unit("length")}"',
                )
            )
    return out
