"""Bearings worked out in letters and numbers."""

from __future__ import annotations

from dalembert.machine.bearings.bearing_table import BearingTable
from dalembert.reports.sheet import Sheet, Working
from dalembert.views.notation import Shown


def bearing_section(sheet: Sheet, t: BearingTable, shown: Shown) -> None:
    """Pressure, equivalent load and life of each joint that has a bearing."""
    sheet.heading("Bearings")
    sheet.text(
        "The force of a joint bears on the projected area of its pin. A rolling bearing lives as long under the steady "
        "load P as under the force over the cycle, weighted by how much the joint turns, $phi$."
    )
    sheet.equations([Working("P = (frac(∫ F^{e} |d phi|; ∫ |d phi|))^{1/e}")])
    force, pressure = (f'"{shown.unit(kind)}"' for kind in ("force", "pressure"))
    for joint, b in t.loads.items():
        lines = []
        if b.sized and b.bearing and b.bearing.diameter and b.bearing.length:
            most, d, length = (
                shown.number(kind, float(v))
                for kind, v in (
                    ("force", b.radial.max()),
                    ("length", b.bearing.diameter),
                    ("length", b.bearing.length),
                )
            )
            factor = shown.factor("force", "pressure", "length", "length")
            numbers = f"frac({most}; {d} cdot {length})"
            numbers += "" if factor == 1 else f" / {shown.conversion(factor)}"
            result = f"{shown.number('pressure', float(b.pressure.max()))} {pressure}"
            lines.append(Working("p = frac(F; d l)", numbers, result))
        if b.bearing and b.bearing.rating:
            rating, load = (shown.number("force", x) for x in (b.bearing.rating, b.equivalent))
            e = "3" if b.bearing.kind == "ball" else "10/3"
            result = f'{shown.notation.number(b.turns / 1e6)} cdot 10^{{6}} "turns"'
            lines.append(Working("P", "", f"{load} {force}"))
            lines.append(
                Working(
                    "L_{10} = (frac(C; P))^{e} 10^{6}", f"(frac({rating}; {load}))^{{{e}}} 10^{{6}}", result
                )
            )
        if lines:
            sheet.text(f"Joint {joint}:")
            sheet.equations(lines)
