"""Brakes and clutches in the worked solution: the lining's forces, the capstan equation, the couple of faces."""

from __future__ import annotations

import math
from typing import Any

from dalembert.analysis.friction.brake_answer import BandBrake, FaceBrake, ShoeBrake, brake
from dalembert.model import GROUND
from dalembert.reports.report_context import ReportContext, figure
from dalembert.reports.sheet import ReportSheet, Working
from dalembert.views import draw


def brakes(sheet: ReportSheet, c: ReportContext) -> None:
    """A section where some joint is a brake with friction: its forces, and the force polygon of what is pressed."""
    names = [
        name for name, part in c.r.mechanism.joints.items() if part.BRAKES and getattr(part, "friction", None)
    ]
    if not names or (c.r.friction is None and not c.r.unknown_loads):
        return
    sheet.heading("Brakes and clutches")
    for name in names:
        value = brake(c.r, name)
        words, lines = _shown(c, name, value)
        sheet.text(words)
        sheet.equations(lines)
        j = c.r.mechanism.joints[name].links[1]
        if j != GROUND and not isinstance(value, FaceBrake):
            sheet.figure(draw.force_polygon(c.r, j, c.k + 1, c.notation))


def _shown(c: ReportContext, name: str, answer: Any) -> tuple[str, list[Working]]:
    """Sentences on a brake, and its equations."""
    shown, k = c.shown, c.k
    mu, force = c.notation.given(answer.coefficient), shown.number("force", float(answer.force[k]))
    torque = figure(shown, "moment", float(answer.torque[k]) * c.notation.torque)  # its size
    part: Any = c.r.mechanism.joints[name]
    helped, least = float(answer.self_energising[k]), answer.locking_coefficient
    grabs = f" It grabs from a coefficient of {least:.4g} on." if math.isfinite(least) else ""

    def product(length: float) -> str:
        return shown.with_factor(
            f"{mu} cdot {force} cdot {shown.number('length', length)}", "moment", "length", "force"
        )

    if isinstance(answer, BandBrake):
        tight, slack = (shown.number("force", float(x[k])) for x in (answer.tight, answer.slack))
        radius = shown.number("length", float(part.radius))
        pull = shown.with_factor(f"({tight} - {slack}) cdot {radius}", "moment", "length", "force")
        words = f"Band {name}: the strand that the drum moves away from is the tight one.{grabs}"
        ratio = Working("frac(T_{1}; T_{2})", f"frac({tight}; {slack})", f"{float(answer.ratio[k]):.6g}")
        return words, [ratio, Working(f"M_{{{name}}} = (T_{{1}} - T_{{2}}) r", pull, torque)]
    if isinstance(answer, FaceBrake):
        words = f"Faces {name}: their couple acts against the slip."
        return words, [Working(f"M_{{{name}}} = mu F n r_{{e}}", product(float(part.lever)), torque)]
    sense = "draws it on" if helped > 1 else "pushes it off" if helped < 1 else "has no moment about its pin"
    words = f"{name}: the resultant N of its pressure passes through the drum's axis, and friction mu N {sense}.{grabs}"
    if not isinstance(answer, ShoeBrake):
        return words, []
    return words, [Working(f"M_{{{name}}} = mu N h", product(float(part.friction_arm)), torque)]
