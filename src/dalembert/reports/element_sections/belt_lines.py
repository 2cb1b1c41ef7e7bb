"""Belts and ropes in the worked solution: wrap, tensions of the strands, the friction they need."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from dalembert.analysis.compile.elements.belt_arrays import belts_of
from dalembert.reports.report_context import ReportContext, figure
from dalembert.reports.sections.kinematics import joint_end
from dalembert.reports.sheet import ReportSheet, Working

SUMS = {
    "tension": (
        "T_{1} + T_{2} = 2 T_{0}",
        "At rest both strands have the tension $T_{0}$, and the sum of their tensions stays the same",
    ),
    "tensioner": ("T_{1} + T_{2} = F + 2 T_{c}", "The tensioner pulls the shaft with $F$"),
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
            "a pulley of the efficiency $e$ the strand that runs off has $1/e$ of the tension, and round a fixed wheel "
            "$exp(mu theta)$ of it."
        )
        heads = ["Strand", f"Tension ({shown.unit('force')})", "Wheel behind it", "Wrap (°)"]
        sheet.table(heads, rows, f"Strands of {name} in their order")


def _degrees(c: ReportContext, angle: float) -> str:
    return c.notation.degrees(float(angle))


def _belt_words(c: ReportContext, name: str, belt: Any) -> str:
    kind = "chain" if belt.chain else "crossed belt" if belt.crossed else "open belt"
    key, value = belt.stated_tension
    given = f"{SUMS[key][1]}: {c.shown.text('force', float(value))}"
    less = ", the tension less $T_c$" if float(c.r.belt(name).centrifugal[c.k]) else ""
    return (
        f"{name} is {'a' if kind != 'open belt' else 'an'} {kind}; $C$ is the distance of its axes. {given}. A free "
        f"body shows its pull in each strand{less}; the equations have their sum."
    )


def _belt_lines(c: ReportContext, name: str, belt: Any) -> list[Working]:
    r, shown, k = c.r, c.shown, c.k
    b = r.belt(name)
    tight, slack, rubbed = float(b.tight[k]), float(b.slack[k]), float(b.centrifugal[k])

    def force(x: float) -> str:
        return shown.number("force", x)

    radius, wheel = shown.number("length", float(belt.radii[1])), shown.link(belt.links[1])
    couple = f'{shown.number("moment", abs(float(b.torque[k, 1])))} "{shown.unit("moment")}"'
    out = [
        *_wrap_lines(c, name, belt, min(float(x) for x in b.wrap)),
        Working(
            f"T_{{1}} − T_{{2}} = frac(M_{{{wheel}}}; r_{{{wheel}}})",
            f'frac({couple}; {radius} "{shown.unit("length")}")',
            figure(shown, "force", tight - slack),
        ),
    ]
    if rubbed:
        speed = abs(float(b.speed[k]))
        numbers = (
            f'{c.notation.number(belt.mass_per_length)} "kg/m" cdot ({c.notation.number(speed)} "m/s")^{{2}}'
        )
        out.append(Working("T_{c} = m v^{2}", numbers, figure(shown, "force", rubbed)))
    out.append(Working(SUMS[belt.stated_tension[0]][0]))
    out.append(Working("T_{1}", "", figure(shown, "force", tight)))
    out.append(Working("T_{2}", "", figure(shown, "force", slack)))
    if belt.chain:
        return out
    ratio = f"frac({force(tight)} − {force(rubbed)}; {force(slack)} − {force(rubbed)})"
    wedge = "" if belt.groove is None else f" sin {_degrees(c, belt.groove / 2)} deg"
    letters = "mu = frac(1; theta) ln frac(T_{1} − T_{c}; T_{2} − T_{c})"
    letters += "" if belt.groove is None else " cdot sin (beta/2)"
    has = "" if math.isnan(b.coefficient) else f"; it has {c.notation.number(b.coefficient)}"
    needed = f'{c.notation.number(float(b.slip_coefficient[k]))} "that it needs{has}"'
    return [
        *out,
        Working(letters, f"frac(1; {c.notation.number(min(map(float, b.wrap)))}) ln {ratio}{wedge}", needed),
    ]


def _wrap_lines(c: ReportContext, name: str, belt: Any, wrap: float) -> list[Working]:
    """The inclination of the strands to the line of the axes, and the least wrap."""
    shown, (i, j) = c.shown, belt.links
    (large, big), (small, little) = sorted(((float(x), n) for x, n in zip(belt.radii, (i, j), strict=True)))[
        ::-1
    ]
    sign, axes = "+" if belt.crossed else "−", joint_end(c.r, name, j, c.k) - joint_end(c.r, name, i, c.k)
    distance, gamma = float(np.hypot(*axes)), abs(math.pi - wrap) / 2
    radii, both = [shown.number("length", x) for x in (large, small, distance)], "+" if belt.crossed else "−"
    where = "on both wheels" if belt.crossed else "on the wheel with less wrap"
    return [
        Working(
            f"sin gamma = frac(r_{{{shown.link(big)}}} {sign} r_{{{shown.link(little)}}}; C)",
            f"frac({radii[0]} {sign} {radii[1]}; {radii[2]})",
            f"{c.notation.number(math.sin(gamma))}",
        ),
        Working(
            f"theta = 180 deg {both} 2 gamma",
            f"180 deg {both} 2 cdot {_degrees(c, gamma)} deg",
            f'{_degrees(c, wrap)} deg "{where}"',
        ),
    ]
