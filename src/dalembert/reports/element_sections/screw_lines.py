"""Power screws in the worked solution: lead angle, angle of friction, torque by the force on the nut, efficiency."""

from __future__ import annotations

import math
from typing import Any

from dalembert.analysis.methods.elements.screw_torques import ScrewAnswer, screws
from dalembert.analysis.output.summary.printed_elements import locking_sentence
from dalembert.reports.report_context import ReportContext, figure
from dalembert.reports.sections.sources import shown_name
from dalembert.reports.sheet import ReportSheet, Working


def power_screws(sheet: ReportSheet, c: ReportContext) -> None:
    """The section on the screws of drives at a position; none without."""
    for n, name in enumerate(screws(c.r.mechanism)):
        if not n:
            sheet.heading("Power screws")
        s, answer = c.r.mechanism.drives[name].screw, c.r.screw(name)
        assert s is not None
        sheet.text(_words(c, name, answer))
        sheet.equations(_lines(c, name, s, answer))
        sheet.text(locking_sentence(answer))


def _words(c: ReportContext, name: str, answer: ScrewAnswer) -> str:
    words = (
        f"The effort of drive {name} is the force on the nut. The torque $M$ of its screw follows from the lead $l$, "
        "the mean radius $r$ of the thread and its friction."
    )
    if c.r.drive_speed(name)[c.k]:
        return words
    low, high = (c.shown.text("moment", float(x[c.k])) for x in (answer.torque_low, answer.torque_high))
    rubs = (
        ""
        if low == high
        else f" At rest friction holds any torque from {low} to {high}; without friction it is:"
    )
    return words + rubs


def _lines(c: ReportContext, name: str, s: Any, answer: ScrewAnswer) -> list[Working]:
    """tan lambda = l/(2 pi r), tan phi' = mu/cos beta_n, M = F (r tan(lambda +- phi') +- mu_c r_c), as it moves."""
    shown, k = c.shown, c.k
    force, speed = float(answer.force[k]), float(c.r.drive_speed(name)[k])
    way, slope = force * speed, float(s.slope)
    sign, turned = "+" if way > 0 else "−", f"{c.notation.degrees(math.atan(slope))} deg"
    lead, radius = (shown.number("length", float(x)) for x in (s.advance, s.radius))
    out = [
        Working(
            "tan lambda = frac(l; 2 pi r)", f"frac({lead}; 2 pi cdot {radius})", c.notation.number(slope)
        ),
        Working("lambda", "", turned),
    ]
    letters, numbers = "r tan lambda", f"{radius} tan {turned}"
    if s.friction is not None and way:
        lines, rubbed = _angle_of_friction(c, s, turned)
        out += lines
        letters, numbers = f"r tan (lambda {sign} phi')", f"{radius} tan ({turned} {sign} {rubbed})"
    if s.collar is not None and way:
        arm = shown.number("length", float(s.collar.radius))
        letters += f" {sign} mu_{{c}} r_{{c}}"
        numbers += f" {sign} {c.notation.given(s.collar.coefficient)} cdot {arm}"
    nut = shown_name(c, "effort", name)
    product = shown.with_factor(f"{shown.number('force', force)} ({numbers})", "moment", "length", "force")
    torque = figure(shown, "moment", float(answer.torque[k]))
    return [*out, Working(f"M = {nut} ({letters})", product, torque), *_efficiency(c, nut, s, answer)]


def _angle_of_friction(c: ReportContext, s: Any, turned: str) -> tuple[list[Working], str]:
    """Angle phi' of friction of a thread; of an inclined flank by its angle normal to the thread."""
    mu, flank = s.friction.coefficient, float(s.flank)
    rubbed = f"{c.notation.degrees(math.atan(mu / flank))} deg"
    if not s.thread_angle:
        return [Working("tan phi' = mu", "", c.notation.given(mu)), Working("phi'", "", rubbed)], rubbed
    beta, normal = (f"{c.notation.degrees(x)} deg" for x in (float(s.thread_angle), math.acos(flank)))
    steep = c.notation.number(math.tan(math.acos(flank)))
    return [
        Working("tan beta_{n} = tan beta cos lambda", f"tan {beta} cos {turned}", steep),
        Working(
            "tan phi' = frac(mu; cos beta_{n})",
            f"frac({c.notation.given(mu)}; cos {normal})",
            c.notation.number(mu / flank),
        ),
        Working("phi'", "", rubbed),
    ], rubbed


def _efficiency(c: ReportContext, nut: str, s: Any, answer: ScrewAnswer) -> list[Working]:
    """Work of the nut in a turn over that of the screw, or its inverse where the load drives the screw."""
    k, unit = c.k, c.shown.unit("moment")
    efficiency, torque = float(answer.efficiency[k]), float(answer.torque[k])
    if not math.isfinite(efficiency):
        return []
    if not efficiency:
        return [Working("eta = 0", "", '"as the load gives work too"')]
    work = c.shown.number("moment", float(answer.force[k]) * float(s.advance))
    ends = [
        (f"{nut} l", f'{work} "{unit}"'),
        ("2 pi M", f'2 pi cdot {c.shown.number("moment", torque)} "{unit}"'),
    ]
    (a, x), (b, y) = ends if torque * float(answer.turning[k]) > 0 else ends[::-1]
    return [Working(f"eta = frac({a}; {b})", f"frac({x}; {y})", c.notation.number(efficiency))]
