"""Belts and ropes in the worked solution: wrap, tensions of the strands, the friction they need."""

from __future__ import annotations

import math
from typing import Any

from dalembert.analysis.compile.elements.belt_arrays import belts_of
from dalembert.reports.report_context import ReportContext, figure
from dalembert.reports.sheet import ReportSheet, Working

SUMS = {
    "tension": ("T_{1} + T_{2} = 2 T_{0}", "Strands at rest have the tension T_0, and their sum stays"),
    "tensioner": ("T_{1} + T_{2} = F + 2 T_{c}", "The tensioner pulls the shaft with F"),
    "tight": ("T_{1} = T", "The tension of the tight strand is given"),
    "slack": ("T_{2} = T", "The tension of the slack strand is given"),
}
"""Key of the tension that is given -> what it says of the strands, in letters and in words."""


def belts_and_ropes(sheet: ReportSheet, c: ReportContext) -> None:
    """The section on belts and ropes of a solved position; none without."""
    belts, ropes = belts_of(c.r.mechanism), c.r.mechanism.ropes
    if not belts and not ropes:
        return
    sheet.heading("Belts and ropes")
    for name, belt in belts.items():
        sheet.text(_belt_words(c, name, belt))
        sheet.equations(_belt_lines(c, name, belt))
    for name in ropes:
        rope, shown = c.r.rope(name), c.shown
        rows = []
        for k, tension in enumerate(rope.tension[c.k]):
            wheel = (rope.wheels[k], _degrees(c, rope.wrap[c.k, k])) if k < len(rope.wheels) else ("–", "–")
            rows.append([str(k + 1), shown.number("force", float(tension)), *wheel])
        sheet.text(
            f"Rope {name} only pulls, and its length is constant. Without friction its strands have one tension; over "
            "a pulley of the efficiency e the strand that runs off has 1/e of the tension, and round a fixed wheel "
            "exp(mu theta) of it."
        )
        heads = ["Strand", f"Tension ({shown.unit('force')})", "Wheel behind it", "Wrap (°)"]
        sheet.table(heads, rows, f"Strands of {name} in their order")


def _degrees(c: ReportContext, angle: float) -> str:
    return c.notation.degrees(float(angle))


def _belt_words(c: ReportContext, name: str, belt: Any) -> str:
    kind = "chain" if belt.chain else "crossed belt" if belt.crossed else "open belt"
    key, value = belt.stated_tension
    text = SUMS[key][1]
    return f"{name}, {'a' if kind != 'open belt' else 'an'} {kind}. {text}: {c.shown.text('force', float(value))}."


def _belt_lines(c: ReportContext, name: str, belt: Any) -> list[Working]:
    r, shown, k = c.r, c.shown, c.k
    b = r.belt(name)
    tight, slack, rubbed = float(b.tight[k]), float(b.slack[k]), float(b.centrifugal[k])
    sum_of = SUMS[belt.stated_tension[0]][0]

    def force(x: float) -> str:
        return shown.number("force", x)

    rj = float(belt.radii[1])
    wrap = min(float(x) for x in b.wrap)
    gamma = (math.pi - wrap) / 2
    sign = "+" if belt.crossed else "−"
    torque = abs(float(b.torque[k, 1]))
    out = [
        Working(
            f"sin gamma = (r_{{{shown.link(belt.links[0])}}} {sign} r_{{{shown.link(belt.links[1])}}})/C",
            f"theta = 180 deg {'+' if gamma < 0 else '−'} 2 cdot {_degrees(c, abs(gamma))} deg",
            f"{_degrees(c, wrap)}° on the wheel with less wrap",
        ),
        Working(
            f"M = r_{{{shown.link(belt.links[1])}}} (T_{{1}} − T_{{2}})",
            shown.with_factor(
                f"{shown.number('length', rj)} cdot {force(tight - slack)}", "moment", "length", "force"
            ),
            figure(shown, "moment", torque, f", so that T_1 − T_2 = {shown.text('force', tight - slack)}"),
        ),
    ]
    if rubbed:
        speed = abs(float(b.speed[k]))
        numbers = f"{c.notation.number(belt.mass_per_length)} kg/m cdot ({c.notation.number(speed)} m/s)^2"
        out.append(Working("T_{c} = m v^2", numbers, figure(shown, "force", rubbed)))
    out.append(Working(f"{sum_of}: T_{{1}}", "", figure(shown, "force", tight)))
    out.append(Working("T_{2}", "", figure(shown, "force", slack)))
    if belt.chain:
        return out
    ratio = f"({force(tight)} − {force(rubbed)})/({force(slack)} − {force(rubbed)})"
    wedge = "" if belt.groove is None else f" sin {_degrees(c, belt.groove / 2)} deg"
    letters = "mu = ln((T_{1} − T_{c})/(T_{2} − T_{c}))/theta"
    letters += "" if belt.groove is None else " cdot sin(beta/2)"
    has = "" if math.isnan(b.coefficient) else f", of {c.notation.number(b.coefficient)} that it has"
    needed = f"{c.notation.number(float(b.slip_coefficient[k]))} needed{has}"
    return [*out, Working(letters, f"ln({ratio})/{c.notation.number(wrap)}{wedge}", needed)]
